//! A model is the same in metres and in kilometres, whichever way it is turned, and in one piece or two: random models, built
//! as they are and changed, have the same solids and volumes. Every length in the code that does not grow with the domain
//! shows here, and everything that depends on where the domain ends.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;
#[path = "../examples/random_models/models/mod.rs"]
mod models;

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use assembled::{Built, from_text, without};
use clinothem::assembly::{Engine, Options, proof};
use models::{Kind, Way, changed, model, number};
use toml::{Table, Value};

/// Models of bodies, of strata and of both, all of which are built as they are.
const GENERIC: [u64; 10] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10];
/// Nearly parallel horizons from wells.
const WELL_TOPS: [u64; 2] = [1, 2];
/// Seeds of models that are split in two; those that depend on the domain's extent are passed over.
const SPLIT: RangeInclusive<u64> = 1..=24;
/// Where they are split, as a share of the extent along x: nowhere that a model has anything by design.
const SPLIT_AT: f64 = 0.437_19;
/// How far volumes may differ, as a share of the domain's.
const SAME: f64 = 1e-9;

/// What must not change: by volume, how many solids there are and how large it is (m³).
struct Result {
    volumes: BTreeMap<String, (usize, f64)>,
    domain: f64,
    remedy: &'static str,
}

fn built(table: &Table) -> Result {
    let text = toml::to_string(table).unwrap();
    let options = Options {
        engine: Engine::Partition,
        child: None,
        threads: 0,
        proof: proof::Level::Fast,
        seed: 1,
    };
    let built = Built::with(from_text(&text, &[]), &without(&[]), &options)
        .unwrap_or_else(|error| panic!("{error}\n{text}"));
    let names = built.realisation.volumes.iter().map(|volume| &volume.name);
    Result {
        volumes: names
            .map(|name| (name.clone(), (built.pieces(name), built.size(name))))
            .collect(),
        domain: built.plan.extent.volume(),
        remedy: built.assembly.remedy,
    }
}

fn nothing_changes(way: Way) {
    let generic = GENERIC.map(|seed| (Kind::Generic, seed));
    let well_tops = WELL_TOPS.map(|seed| (Kind::WellTops, seed));
    let mut compared = 0;
    for (kind, seed) in generic.into_iter().chain(well_tops) {
        let given = model(kind, seed, true);
        let Some(other) = changed(&given, way) else {
            continue;
        };
        let (given, other) = (built(&given), built(&other));
        let cubed = way.scale().powi(3);
        let what = format!("{kind:?} {seed}, {way:?}");
        assert_eq!(given.remedy, other.remedy, "{what}");
        for (name, (solids, size)) in &given.volumes {
            let (found, its) = other.volumes[name];
            assert_eq!(found, *solids, "{what}: solids of {name}");
            let miss = (its / cubed - size) / given.domain;
            assert!(
                miss.abs() < SAME,
                "{what}: {name} by {miss:e} of the domain"
            );
        }
        compared += 1;
    }
    assert!(compared >= 8, "{compared} models are too few");
}

#[test]
fn a_model_in_kilometres_is_that_in_metres() {
    nothing_changes(Way::Thousandth);
}

#[test]
fn a_model_in_millimetres_is_that_in_metres() {
    nothing_changes(Way::Thousandfold);
}

#[test]
fn a_model_turned_by_a_right_angle_has_the_same_volumes() {
    nothing_changes(Way::Turned);
}

#[test]
fn a_mirrored_model_has_the_same_volumes() {
    nothing_changes(Way::Mirrored);
}

#[test]
fn the_two_parts_of_a_model_that_is_split_have_the_volumes_of_the_whole() {
    let generic = SPLIT.map(|seed| (Kind::Generic, seed));
    let well_tops = WELL_TOPS.map(|seed| (Kind::WellTops, seed));
    let (mut compared, mut in_both) = (0, 0);
    for (kind, seed) in generic.chain(well_tops) {
        let Some(given) = in_its_own_lengths(model(kind, seed, true)) else {
            continue;
        };
        let what = format!("{kind:?} {seed}");
        let whole = built(&given);
        let parts = split(&given).map(|part| built(&part));
        let sum = parts[0].domain + parts[1].domain;
        assert!(
            (sum / whole.domain - 1.0).abs() < SAME,
            "{what}: the domain"
        );
        for (name, (_, size)) in &whole.volumes {
            let sizes = parts.each_ref().map(|part| part.volumes[name].1);
            let miss = (sizes[0] + sizes[1] - size) / whole.domain;
            assert!(
                miss.abs() < SAME,
                "{what}: {name} by {miss:e} of the domain"
            );
            if name != "background" && sizes.iter().all(|size| *size > 0.0) {
                in_both += 1;
            }
        }
        compared += 1;
    }
    assert!(compared >= 8, "{compared} models are too few");
    assert!(in_both >= 16, "{in_both} volumes in both parts are too few");
}

/// A model with everything written out that is told from the domain's extent when it is left out. None if it has clinoforms,
/// whose distances are measured from the domain's corner and whose shorelines are centred on it.
fn in_its_own_lengths(mut model: Table) -> Option<Table> {
    let domain = model["domain"].as_table_mut().unwrap();
    let extents = ["x", "y", "z"].map(|axis| {
        let [low, high] = range(domain, axis);
        high - low
    });
    let diagonal = extents.iter().map(|extent| extent * extent).sum::<f64>();
    domain
        .entry("least_thickness")
        .or_insert((1e-10 * diagonal.sqrt()).into());
    for feature in model["feature"].as_array_mut().unwrap() {
        if feature["kind"].as_str() == Some("clinoforms") {
            return None;
        }
        let Some(course) = feature.get_mut("trajectory").and_then(Value::as_table_mut) else {
            continue;
        };
        let needs_length =
            course["kind"].as_str() == Some("sine-generated") || course.contains_key("azimuth_deg");
        if needs_length {
            let across = 2.5 * extents[0].hypot(extents[1]);
            course.entry("length").or_insert(across.into());
        }
    }
    Some(model)
}

/// The parts of a model west and east of a plane, which is a wall of both.
fn split(model: &Table) -> [Table; 2] {
    let [west, east] = range(model["domain"].as_table().unwrap(), "x");
    let plane = west + SPLIT_AT * (east - west);
    [[west, plane], [plane, east]].map(|x| {
        let mut part = model.clone();
        let domain = part["domain"].as_table_mut().unwrap();
        domain.insert("x".to_owned(), x.to_vec().into());
        part
    })
}

fn range(table: &Table, key: &str) -> [f64; 2] {
    let ends = &table[key];
    [0, 1].map(|at| number(&ends[at]).unwrap())
}
