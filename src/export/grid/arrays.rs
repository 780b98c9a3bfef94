//! What cells hold: the numbers of their volume and facies, and the rock properties of these.

use crate::model::realisation::Realisation;
use crate::model::{Model, Property};

/// Stands in whole numbers for cells that lie outside of the domain.
pub const NO_NUMBER: i32 = -1;

/// A rock property of volumes, one number each.
#[derive(Clone, Debug, PartialEq)]
pub struct RockArray {
    /// Its name: the property's, with its direction if it has one.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Whether it is a permeability between two axes, which is 0 unless layers dip.
    pub is_mixed: bool,
    /// By volume; not a number where the volume does not have it. Single precision, as grids hold it.
    pub values: Vec<f32>,
}

/// The numbers that stand in grids, by volume.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrays {
    /// The volume's number: its place in the tables of a build, the background being 0.
    pub volumes: Vec<i32>,
    /// The number of its facies: its place in the model file, from 1.
    pub facies: Vec<i32>,
    /// Rock properties.
    pub rock: Vec<RockArray>,
}

impl Arrays {
    /// Of a realisation's volumes.
    pub fn new(model: &Model, realisation: &Realisation) -> Self {
        let mut next = 0;
        let mut volumes: Vec<i32> = Vec::with_capacity(realisation.volumes.len());
        for volume in 0..realisation.volumes.len() {
            // A piece of an older volume is that volume.
            let whole = realisation.rules.whole(volume);
            if whole == volume {
                volumes.push(next);
                next += 1;
            } else {
                volumes.push(volumes[whole]);
            }
        }
        let number = |name: &str| {
            let at = model.facies.iter().position(|facies| facies.name == name);
            at.and_then(|at| i32::try_from(at + 1).ok())
                .unwrap_or(NO_NUMBER)
        };
        let facies = realisation.volumes.iter();
        Self {
            volumes,
            facies: facies.map(|volume| number(&volume.facies)).collect(),
            rock: rock(realisation),
        }
    }
}

/// All rock properties, in the order in which volumes name them first.
fn rock(realisation: &Realisation) -> Vec<RockArray> {
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in realisation.properties.iter().flat_map(|one| &one.values) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    let mut arrays = Vec::new();
    for name in names {
        let values = realisation.properties.iter();
        let values: Vec<Option<Property>> = values.map(|one| one.get(name)).collect();
        add(&mut arrays, name, &values);
    }
    arrays
}

/// The unit of a property that has a meaning.
fn unit(name: &str) -> &'static str {
    match name {
        "permeability" => "mD",
        "porosity" | "net" | "vsh" | "sw" => "fraction",
        _ => "",
    }
}

/// Adds one array, or one for each axis, and where layers dip one for each pair of axes.
fn add(arrays: &mut Vec<RockArray>, name: &str, values: &[Option<Property>]) {
    const AXES: [&str; 3] = ["x", "y", "z"];
    let is_scalar = |value: &Option<Property>| matches!(value, None | Some(Property::Scalar(_)));
    let of = |entry: &dyn Fn(&Property) -> f64| -> Vec<f32> {
        let value = |value: &Option<Property>| value.as_ref().map_or(f64::NAN, entry);
        #[allow(
            clippy::cast_possible_truncation,
            reason = "grids are single precision"
        )]
        values.iter().map(|one| value(one) as f32).collect()
    };
    let unit = unit(name);
    let mut push = |name: String, is_mixed: bool, values: Vec<f32>| {
        arrays.push(RockArray {
            name,
            unit,
            is_mixed,
            values,
        });
    };
    if name != "permeability" && values.iter().all(is_scalar) {
        push(name.to_owned(), false, of(&|value| value.tensor()[0][0]));
        return;
    }
    for (at, axis) in AXES.iter().enumerate() {
        let own = of(&|value| value.tensor()[at][at]);
        push(format!("{name}_{axis}"), false, own);
    }
    let pairs = [(0, 1), (1, 2), (0, 2)];
    let mixed = |value: &Option<Property>| {
        let tensor = value.as_ref().map(Property::tensor);
        tensor.is_some_and(|tensor| {
            pairs
                .iter()
                .any(|(row, column)| tensor[*row][*column] != 0.0)
        })
    };
    if values.iter().any(mixed) {
        for (row, column) in pairs {
            let own = of(&|value| value.tensor()[row][column]);
            push(format!("{name}_{}{}", AXES[row], AXES[column]), true, own);
        }
    }
}
