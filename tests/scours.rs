//! Scours: their volumes, where they cross the domain's faces and each other, and what they take from.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use assembled::{Built, from_text};
use clinothem::assembly::Engine;
use clinothem::model::selection::Selection;
use glam::DVec3;

/// A straight scour in a block.
const STRAIGHT: &str = r#"
name = "Straight"
[domain]
x = [0, 240]
y = [0, 160]
z = [-12, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "scour"
kind = "scour"
facies = "sand"
length = 200
width = [20, 60]
depth = 3
azimuth_deg = 70
center = [120, 80]
top = -2
"#;

fn built(overrides: &[&str], engine: Engine) -> Built {
    Built::new(
        from_text(STRAIGHT, overrides),
        &Selection::default(),
        engine,
    )
    .unwrap()
}

#[test]
fn a_scours_volume_is_that_of_its_sections_over_its_length() {
    // The sections' areas in width times depth, by another program; over head and tail the depth is that of a parabola.
    for (pit, wing, head, tail, area) in [
        (0.35, 0.25, 0.15, 0.4, 0.405_919),
        (0.5, 0.25, 0.3, 0.2, 0.485_130),
        (0.25, 0.15, 0.1, 0.9, 0.297_652),
    ] {
        let overrides = [
            format!("feature.scour.pit_fraction={pit}"),
            format!("feature.scour.wing_depth_fraction={wing}"),
            format!("feature.scour.head_fraction={head}"),
            format!("feature.scour.tail_fraction={tail}"),
        ];
        let built = built(&overrides.each_ref().map(String::as_str), Engine::Partition);
        let wanted = area * 20.0 * 3.0 * 200.0 * (1.0 - (head + tail) / 3.0);
        let found = built.size("scour");
        // Six digits of the area, and the depth within 2 mm of 3 m along the thalweg.
        assert!((found / wanted - 1.0).abs() < 2e-4, "{found} {wanted}");
        assert_eq!((built.pieces("scour"), built.solids()), (1, 2));
    }
}

#[test]
fn it_is_as_deep_and_as_wide_as_its_keys_say() {
    let overrides = ["feature.scour.azimuth_deg=90", "feature.scour.depth=[3, 1]"];
    let built = built(&overrides, Engine::Partition);
    let scour = built.volume("scour");
    let holds =
        |x: f64, y: f64, z: f64| built.owners.at(DVec3::new(20.0 + x, 80.0 + y, z)) == Some(scour);
    // Between head and tail: 30 % and 50 % of the way.
    for fraction in [0.3, 0.5] {
        let (x, depth) = (200.0 * fraction, 3.0 - 2.0 * fraction);
        let width = 20.0 + 40.0 * fraction;
        assert!(holds(x, 0.0, -2.0 - 0.99 * depth) && !holds(x, 0.0, -2.0 - 1.01 * depth));
        for side in [-0.5, 0.5] {
            assert!(holds(x, 0.99 * side * width, -2.001));
            assert!(!holds(x, 1.01 * side * width, -2.001));
            // The wings are no deeper than a quarter of the pit.
            assert!(!holds(x, 0.75 * side * width, -2.0 - 0.251 * depth));
        }
    }
    assert!(!holds(-1.0, 0.0, -2.01) && !holds(201.0, 0.0, -2.01));
}

#[test]
fn by_its_head_or_its_middle_or_along_a_line_it_is_the_same() {
    let whole = built(&[], Engine::Partition).size("scour");
    let axis = (70_f64.to_radians().sin(), 70_f64.to_radians().cos());
    let (head, toe) = (
        (120.0 - 100.0 * axis.0, 80.0 - 100.0 * axis.1),
        (120.0 + 100.0 * axis.0, 80.0 + 100.0 * axis.1),
    );
    let by_head = STRAIGHT.replace(
        "center = [120, 80]",
        &format!("head = [{}, {}]", head.0, head.1),
    );
    let along = STRAIGHT
        .replace("center = [120, 80]\n", "")
        .replace("length = 200\n", "")
        .replace("azimuth_deg = 70\n", "")
        + &format!(
            "trajectory = {{ kind = \"line\", from = [{}, {}], to = [{}, {}] }}",
            head.0, head.1, toe.0, toe.1
        );
    for text in [by_head, along] {
        let built = Built::new(
            from_text(&text, &[]),
            &Selection::default(),
            Engine::Partition,
        )
        .unwrap();
        assert!((built.size("scour") - whole).abs() < 1e-7 * whole);
    }
}

#[test]
fn the_wall_along_its_axis_halves_it_and_top_and_base_of_the_domain_cut_it() {
    let whole = built(&["feature.scour.azimuth_deg=90"], Engine::Partition).size("scour");
    let half = built(
        &["feature.scour.azimuth_deg=90", "domain.y=[80, 160]"],
        Engine::Partition,
    );
    assert!((half.size("scour") - 0.5 * whole).abs() < 1e-6 * whole);
    for (top, cuts) in [(1.2, "top"), (-11.5, "base")] {
        let cut = built(
            &[
                "feature.scour.azimuth_deg=90",
                &format!("feature.scour.top={top}"),
            ],
            Engine::Partition,
        );
        let size = cut.size("scour");
        assert!(size > 0.05 * whole && size < 0.95 * whole, "{cuts}: {size}");
    }
    // Its top in the domain's.
    let flush = built(
        &["feature.scour.azimuth_deg=90", "feature.scour.top=0"],
        Engine::Auto,
    );
    assert!((flush.size("scour") - whole).abs() < 1e-5 * whole);
}

#[test]
fn the_general_fuse_makes_the_same_scour() {
    let [one, other] =
        [Engine::Partition, Engine::Occt].map(|engine| built(&[], engine).size("scour"));
    assert!((one - other).abs() < 1e-6 * one, "{one} {other}");
}

#[test]
fn random_scours_that_overlap_are_proven_and_the_younger_takes_from_the_older() {
    let random = STRAIGHT
        .replace(
            "length = 200",
            "count = 5\nlength = { uniform = [60, 220] }",
        )
        .replace(
            "width = [20, 60]",
            "width = [{ uniform = [10, 40] }, { uniform = [20, 90] }]",
        )
        .replace("depth = 3", "depth = { uniform = [1, 5] }")
        .replace("azimuth_deg = 70", "azimuth_deg = { uniform = [0, 360] }")
        .replace("center = [120, 80]\n", "")
        .replace("top = -2", "top = { uniform = [-9, 1] }");
    for seed in 1..=6 {
        let model = from_text(&random, &[&format!("seed={seed}")]);
        let built = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
        assert!(built.size("scour-5") > 0.0, "the youngest is there");
    }
}

#[test]
fn a_child_without_a_place_lies_in_its_parent() {
    let child = format!(
        "{STRAIGHT}{}",
        r#"
[[feature]]
id = "small"
kind = "scour"
parent = "scour"
count = 8
facies = "mud"
length = 30
width = [4, 9]
depth = 0.4
azimuth_deg = 70
"#
    );
    let model = from_text(&child, &["seed=3"]);
    let built = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
    for number in 1..=8 {
        let size = built.size(&format!("scour/small-{number}"));
        assert!(size > 0.0, "{number}");
    }
}
