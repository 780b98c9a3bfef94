//! Meander belts: who removes whom, names, and what of a belt is drawn.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use assembled::{Built, from_text, without};
use clinothem::assembly::Engine;
use clinothem::features::body::Body;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;

const BELT: &str = r#"
name = "Belt"
[domain]
x = [0, 600]
y = [0, 400]
z = [-16, 0]
facies = "silt"
[facies.silt]
[facies.sand]
[[feature]]
id = "belt"
kind = "meander-belt"
facies = "sand"
width = 50
depth = 5
top = -6
steps = 4
amplitude = [40, 100]
wavelength = 475
shift = 60
azimuth_deg = 90
center = [300, 200]
phase = 0
"#;

fn built(overrides: &[&str], selection: &Selection) -> Built {
    Built::new(from_text(BELT, overrides), selection, Engine::Partition).unwrap()
}

/// Area of the default section as a fraction of width times depth.
const SECTION: f64 = 0.764_563;

#[test]
fn the_last_position_is_whole_and_older_ones_are_what_younger_ones_leave() {
    let all = built(&[], &Selection::default());
    let names: Vec<&str> = all.realisation.volumes[1..]
        .iter()
        .map(|volume| volume.name.as_str())
        .collect();
    assert_eq!(names, ["belt-1", "belt-2", "belt-3", "belt-4"]);
    // Alone, each position is a channel of its own; the last one is as large in the belt.
    let alone = |number: usize| {
        let others: Vec<String> = (1..=4)
            .filter(|other| *other != number)
            .map(|other| format!("belt-{other}"))
            .collect();
        let others: Vec<&str> = others.iter().map(String::as_str).collect();
        built(&[], &without(&others)).size(&format!("belt-{number}"))
    };
    let last = alone(4);
    assert!((all.size("belt-4") / last - 1.0).abs() < 1e-7);
    for number in 1..4 {
        let left = all.size(&format!("belt-{number}")) / alone(number);
        assert!(left > 0.01 && left < 0.9, "{number}: {left}");
    }
    // A symmetrical section counts by the length of its way: here between the walls, at which the line is not upright.
    let Body::Trough(trough) = &all.realisation.instances[3].body else {
        panic!("a position is a trough")
    };
    let (from, to) = trough.base().knots_v().domain();
    let mut length = 0.0;
    let middle = |v: f64| {
        let [left, right] = trough.rims().map(|rim| rim.point(v));
        left.midpoint(right)
    };
    let steps = 20_000;
    for k in 0..steps {
        let v = |k: i32| from + (to - from) * f64::from(k) / f64::from(steps);
        let (a, b) = (middle(v(k)), middle(v(k + 1)));
        if a.midpoint(b).x > 0.0 && a.midpoint(b).x < 600.0 {
            length += a.distance(b);
        }
    }
    // Of what the walls cut off askew a part of a width is on either side.
    let share = last / (SECTION * 50.0 * 5.0 * length);
    assert!((share - 1.0).abs() < 0.02, "{share}");
}

#[test]
fn scrolls_lie_at_inner_banks() {
    let all = built(&[], &Selection::default());
    // Phase 0 turns left at the centre, so the valley's side of that apex is to the north: the oldest position is nearest to the axis.
    let at = |x: f64, y: f64| {
        let owner = all.owners.at(glam::DVec3::new(x, y, -7.0)).unwrap();
        all.realisation.volumes[owner].name.clone()
    };
    let along: Vec<String> = (0..120).map(|k| at(320.0, 60.0 + f64::from(k))).collect();
    let mut seen: Vec<&str> = along.iter().map(String::as_str).collect();
    seen.dedup();
    let belt: Vec<&&str> = seen
        .iter()
        .filter(|name| name.starts_with("belt"))
        .collect();
    let mut sorted = belt.clone();
    sorted.sort_by(|a, b| b.cmp(a));
    assert_eq!(belt, sorted, "{seen:?}");
    assert!(belt.len() >= 3, "{seen:?}");
}

#[test]
fn both_engines_make_the_same_belt() {
    let few = ["feature.belt.steps=2"];
    let [one, other] = [Engine::Partition, Engine::Occt].map(|engine| {
        let built = Built::new(from_text(BELT, &few), &Selection::default(), engine).unwrap();
        [
            built.size("belt-1"),
            built.size("belt-2"),
            built.contact("belt-1", "belt-2"),
        ]
    });
    for (one, other) in one.into_iter().zip(other) {
        assert!((one - other).abs() < 1e-6 * one, "{one} {other}");
    }
}

#[test]
fn a_belt_that_cannot_be_is_refused_with_its_position() {
    let refused = |overrides: &[&str]| {
        let model = from_text(BELT, overrides);
        let error = Realisation::new(&model, &Selection::default()).unwrap_err();
        error.to_string()
    };
    let error = refused(&["feature.belt.amplitude=[40, 160]", "feature.belt.width=260"]);
    assert!(error.contains("position "), "{error}");
    let model = from_text(BELT, &[]);
    let error = Realisation::new(&model, &without(&["belt-5"])).unwrap_err();
    assert!(error.to_string().contains("belt-5"), "{error}");
}
