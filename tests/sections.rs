//! Channels with sections of their own: areas of closed forms, corners, what lies in them, and tubes.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[macro_use]
mod assembled;

use std::f64::consts::{FRAC_PI_4, TAU};

use assembled::{Built, MEANDER, WIDER, built, from_text};
use clinothem::assembly::Engine;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::nurbs::quadrature::{TEN, between};

/// A straight channel through a block; its section is given by overrides.
const STRAIGHT: &str = straight!("");

const TRAPEZOID: &str = "feature.channel.section={ degree = 1, points = [[-0.5, 0], [-0.25, -1], [0.25, -1], [0.5, 0]] }";
const PARABOLA: &str =
    "feature.channel.section={ degree = 2, points = [[-0.5, 0], [0, -2], [0.5, 0]] }";
const HALF_ELLIPSE: &str = "feature.channel.section={ degree = 2, points = [[-0.5, 0], [-0.5, -1], [0, -1], [0.5, -1], [0.5, 0]], weights = [1, 0.7071067811865476, 1, 0.7071067811865476, 1], knots = [0, 0, 0, 0.5, 0.5, 1, 1, 1] }";
const PIPE: &str = "feature.channel.section={ close = \"closed\", degree = 2, points = [[-0.5, -0.5], [-0.5, 0], [0, 0], [0.5, 0], [0.5, -0.5], [0.5, -1], [0, -1], [-0.5, -1], [-0.5, -0.5]], weights = [1, 0.7071067811865476, 1, 0.7071067811865476, 1, 0.7071067811865476, 1, 0.7071067811865476, 1], knots = [0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1] }";
/// Tops at the block's own.
const FLUSH: &str = "feature.channel.top=0";

const IN_IT: &str = r#"
[[feature]]
id = "lag"
kind = "lag"
parent = "channel"
facies = "gravel"
thickness_fraction = 0.2
sag_fraction = 0.5
[[feature]]
id = "bar"
kind = "point-bars"
parent = "channel"
facies = "sand"
[[feature]]
id = "plug"
kind = "plug"
parent = "channel"
facies = "silt"
"#;

#[test]
fn a_straight_channel_has_its_sections_area_times_its_length() {
    for (section, area) in [
        (TRAPEZOID, 0.75),
        // Its control point lies twice as deep as the curve, which is as deep as the channel.
        (PARABOLA, 2.0 / 3.0),
        (HALF_ELLIPSE, FRAC_PI_4),
    ] {
        for more in ["domain.z=[-20, 0]", FLUSH] {
            let built = built(STRAIGHT, &[section, more], Engine::Partition);
            let share = built.size("channel") / (50.0 * 4.4 * 300.0);
            assert!((share - area).abs() < 1e-9, "{section} {more}: {share}");
        }
    }
}

#[test]
fn a_channel_along_bends_has_the_volume_of_pappus() {
    // Symmetrical sections count by the length of the way of their middle, here within the block's walls.
    let text = STRAIGHT.replace(
        "trajectory = { kind = \"line\", from = [-50, 50], to = [350, 50] }",
        "tolerance_fraction = 0.0001\ntrajectory = { kind = \"parametric\", x = \"150 * sin(t) + 150\", y = \"150 * cos(t) - 60\", range = [-1.6, 1.6] }",
    );
    // The whole of the channel above y = −60: a half circle.
    let overrides = ["domain.x=[-60, 360]", "domain.y=[-60, 120]"];
    for (section, area) in [(TRAPEZOID, 0.75), (HALF_ELLIPSE, FRAC_PI_4)] {
        let built = built(
            &text,
            &[&overrides[..], &[section]].concat(),
            Engine::Partition,
        );
        let expected = area * 50.0 * 4.4 * 150.0 * TAU / 2.0;
        let volume = built.size("channel");
        assert!(
            (volume / expected - 1.0).abs() < 1e-4,
            "{section}: {volume} {expected}"
        );
    }
}

#[test]
fn what_lies_in_a_channel_lies_in_any_section_with_rims() {
    let text = format!("{STRAIGHT}{IN_IT}");
    for section in [TRAPEZOID, PARABOLA] {
        let overrides = [section, MEANDER, WIDER];
        let whole = built(STRAIGHT, &overrides, Engine::Partition).size("channel");
        let built = built(&text, &overrides, Engine::Partition);
        let names = built.realisation.volumes.iter().map(|one| one.name.clone());
        let inside: Vec<String> = names.filter(|name| name.starts_with("channel")).collect();
        let sum: f64 = inside.iter().map(|name| built.size(name)).sum();
        assert!((sum / whole - 1.0).abs() < 1e-7, "{section}: {sum} {whole}");
        for name in ["channel/lag", "channel/plug", "channel/bar-2/accretion-4"] {
            assert!(built.size(name) > 0.0, "{section}: {name}");
        }
    }
}

#[test]
fn a_lag_in_a_trapezoid_has_the_area_that_lines_tell() {
    let text = format!("{STRAIGHT}{IN_IT}");
    let selection = assembled::without(&["bar", "plug"]);
    let model = from_text(&text, &[TRAPEZOID]);
    let built = Built::new(model, &selection, Engine::Partition).unwrap();
    // Base −1 between ±¼, rising to 0 at ±½; the lag's top 0.8 (0.5 y − 0.5).
    let base = |x: f64| (-1.0_f64).max(-4.0 * (0.5 - x.abs()));
    let top = |x: f64| 0.8 * (0.5 * base(x) - 0.5);
    // They meet where 4 (½ − x) = 0.4 + 1.6 (½ − x): 1/6 from the rims.
    let pieces = [[-1.0 / 3.0, -0.25], [-0.25, 0.25], [0.25, 1.0 / 3.0]];
    let area: f64 = pieces
        .iter()
        .flat_map(|[from, to]| between(TEN, *from, *to))
        .map(|(x, weight)| weight * (top(x) - base(x)))
        .sum();
    let share = built.size("channel/lag") / (50.0 * 4.4 * 300.0);
    assert!((share - area).abs() < 1e-9, "{share} {area}");
}

#[test]
fn a_closed_section_makes_a_tube_in_which_nothing_lies() {
    let built = built(STRAIGHT, &[PIPE], Engine::Partition);
    let share = built.size("channel") / (50.0 * 4.4 * 300.0);
    assert!((share - FRAC_PI_4).abs() < 1e-9, "{share}");
    let model = from_text(&format!("{STRAIGHT}{IN_IT}"), &[PIPE]);
    let error = Realisation::new(&model, &Selection::default()).unwrap_err();
    let said = error.to_string();
    assert!(
        said.contains("no channel with a floor and a top between rims"),
        "{said}"
    );
}

#[test]
fn a_tube_with_corners_and_a_trajectory_that_ends_in_the_block_are_closed_there() {
    let diamond = "feature.channel.section={ close = \"closed\", degree = 1, points = [[0.1, 0], [0.5, -0.5], [0, -1], [-0.5, -0.5], [0.1, 0]] }";
    let ends = "feature.channel.trajectory={ kind = \"line\", from = [40, 50], to = [240, 50] }";
    for (section, area) in [(diamond, 0.5), (TRAPEZOID, 0.75), (PIPE, FRAC_PI_4)] {
        let built = built(STRAIGHT, &[section, ends], Engine::Partition);
        let share = built.size("channel") / (50.0 * 4.4 * 200.0);
        assert!((share - area).abs() < 1e-9, "{section}: {share}");
    }
}
