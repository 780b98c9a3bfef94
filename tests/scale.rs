//! A model is the same in metres and in kilometres, and whichever way it is turned: random models, built as they are and
//! changed, have the same solids and volumes. Every length in the code that does not grow with the domain shows here.
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

use assembled::{Built, from_text, without};
use clinothem::assembly::{Engine, Options, proof};
use models::{Kind, Way, changed, model};
use toml::Table;

/// Models of bodies, of strata and of both, all of which are built as they are.
const GENERIC: [u64; 10] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10];
/// Nearly parallel horizons from wells.
const WELL_TOPS: [u64; 2] = [1, 2];
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
