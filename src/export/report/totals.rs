//! Totals of rock: net volume, pores, means over the volume, and between what permeabilities can act together.

use std::collections::BTreeMap;

use glam::DMat3;

use super::entries::{BoundsEntry, TotalsEntry};
use crate::model::Property;
use crate::model::properties::VolumeProperties;

/// A volume as its rock is summed.
#[derive(Clone, Copy)]
pub(super) struct Share<'a> {
    /// Its facies.
    pub(super) facies: &'a str,
    /// Volume (m³).
    pub(super) size: f64,
    pub(super) rock: &'a VolumeProperties,
}

impl Share<'_> {
    /// The volume times some fractions; what is none of it needs no other fraction. Nothing if one is not known.
    fn part(&self, fractions: &[Option<f64>]) -> Option<f64> {
        if fractions.contains(&Some(0.0)) {
            return Some(0.0);
        }
        fractions
            .iter()
            .copied()
            .product::<Option<f64>>()
            .map(|part| part * self.size)
    }
}

/// A volume times those of its properties that are fractions: see [`Share::part`].
pub(super) fn part_of(share: &Share<'_>, fractions: &[&str]) -> Option<f64> {
    let known: Vec<Option<f64>> = fractions
        .iter()
        .map(|name| share.rock.scalar(name))
        .collect();
    share.part(&known)
}

/// The totals of some volumes; those without solids do not count.
pub(super) fn totals(shares: &[Share<'_>], with_bounds: bool) -> TotalsEntry {
    let shares: Vec<Share<'_>> = shares
        .iter()
        .copied()
        .filter(|one| one.size > 0.0)
        .collect();
    let total: f64 = shares.iter().map(|one| one.size).sum();
    let sum = |of: &dyn Fn(&Share<'_>) -> Option<f64>| {
        let sum: Option<f64> = shares.iter().map(of).sum();
        sum.filter(|_| !shares.is_empty())
    };
    let net = |one: &Share<'_>| one.rock.scalar("net");
    let porosity = |one: &Share<'_>| one.rock.scalar("porosity");
    let oil = |one: &Share<'_>| one.rock.scalar("sw").map(|water| 1.0 - water);
    let (means, unknown) = means(&shares, total);
    TotalsEntry {
        net_volume_m3: sum(&|one| one.part(&[net(one)])),
        pore_volume_m3: sum(&|one| one.part(&[porosity(one)])),
        net_pore_volume_m3: sum(&|one| one.part(&[porosity(one), net(one)])),
        hydrocarbon_volume_m3: sum(&|one| one.part(&[porosity(one), net(one), oil(one)])),
        means,
        unknown,
        permeability_bounds: if with_bounds {
            bounds(&shares, total)
        } else {
            None
        },
    }
}

type Means = BTreeMap<String, serde_json::Value>;
type Unknown = BTreeMap<String, Vec<String>>;

/// The mean of each property that all of the volume has; and of the others the facies that have none.
fn means(shares: &[Share<'_>], total: f64) -> (Means, Unknown) {
    let (mut means, mut unknown) = (Means::new(), Unknown::new());
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in shares.iter().flat_map(|one| &one.rock.values) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    for name in names {
        let lacking = shares.iter().filter(|one| one.rock.get(name).is_none());
        let mut lacking: Vec<String> = lacking.map(|one| one.facies.to_owned()).collect();
        if !lacking.is_empty() {
            lacking.sort();
            lacking.dedup();
            unknown.insert(name.to_owned(), lacking);
            continue;
        }
        let values: Vec<(f64, Property)> = shares
            .iter()
            .filter_map(|one| Some((one.size / total, one.rock.get(name)?)))
            .collect();
        means.insert(name.to_owned(), mean(&values).to_json());
    }
    (means, unknown)
}

/// The mean of values with weights that sum to 1, in the least form that holds all of them.
fn mean(values: &[(f64, Property)]) -> Property {
    let mut sum = [[0.0; 3]; 3];
    for (weight, value) in values {
        for (row, more) in sum.iter_mut().zip(value.tensor()) {
            for (entry, more) in row.iter_mut().zip(more) {
                *entry += weight * more;
            }
        }
    }
    let all = |is: fn(&Property) -> bool| values.iter().all(|(_, value)| is(value));
    if all(|value| matches!(value, Property::Scalar(_))) {
        Property::Scalar(sum[0][0])
    } else if all(|value| !matches!(value, Property::Tensor(_))) {
        Property::Vector([sum[0][0], sum[1][1], sum[2][2]])
    } else {
        Property::Tensor(sum)
    }
}

/// Whatever the arrangement of the volumes, their permeability as a whole lies between the harmonic and the arithmetic mean
/// (Wiener 1912): of tensors, the inverse of the mean inverse, and the mean.
fn bounds(shares: &[Share<'_>], total: f64) -> Option<BoundsEntry> {
    let matrix = |one: &Share<'_>| {
        let [x, y, z] = one.rock.get("permeability")?.tensor();
        // Symmetric: rows are columns.
        Some(DMat3::from_cols_array_2d(&[x, y, z]))
    };
    let all: Option<Vec<(f64, DMat3)>> = shares
        .iter()
        .map(|one| Some((one.size / total, matrix(one)?)))
        .collect();
    let all = all.filter(|all| !all.is_empty())?;
    let diagonal = |m: &DMat3| [m.x_axis.x, m.y_axis.y, m.z_axis.z];
    let arithmetic = all
        .iter()
        .fold(DMat3::ZERO, |sum, (part, k)| sum + *k * *part);
    let is_along_axes = all
        .iter()
        .all(|(_, k)| *k == DMat3::from_diagonal(diagonal(k).into()));
    let harmonic = if is_along_axes {
        // One impermeable layer lets nothing through.
        let along = |axis: usize| {
            let resistance = all.iter().map(|(part, k)| part / diagonal(k)[axis]);
            1.0 / resistance.sum::<f64>()
        };
        Some([along(0), along(1), along(2)])
    } else if all.iter().any(|(_, k)| k.determinant() <= 0.0) {
        None
    } else {
        let inverse = all
            .iter()
            .fold(DMat3::ZERO, |sum, (part, k)| sum + k.inverse() * *part);
        Some(diagonal(&inverse.inverse()))
    };
    Some(BoundsEntry {
        arithmetic_md: diagonal(&arithmetic),
        harmonic_md: harmonic,
    })
}

#[cfg(test)]
#[path = "totals_tests.rs"]
mod tests;
