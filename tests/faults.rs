//! Faults and folds, assembled and proven in full: volumes, offsets and areas in closed form.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use assembled::{Built, built, from_text, without};
use clinothem::assembly::Engine;
use clinothem::model::selection::Selection;
use glam::DVec3;

/// Three beds in a block of 1000 × 800 × 100 m.
const BEDS: &str = "name = \"beds\"\n[domain]\nx = [0, 1000]\ny = [0, 800]\nz = [-100, 0]\nfacies = \"mud\"\n[facies.mud]\n[facies.sand]\n[facies.silt]\n\
    [[feature]]\nid = \"lower\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = { level = -61 }\n\
    [[feature]]\nid = \"upper\"\nkind = \"horizon\"\nfacies = \"silt\"\nsurface = { level = -37 }\n";

fn fault(id: &str, x: f64, dip: f64, azimuth: f64, rest: &str) -> String {
    format!(
        "[[feature]]\nid = \"{id}\"\nkind = \"fault\"\nsurface = {{ dipping = {{ through = [{x}, 400, -50], dip_deg = {dip}, azimuth_deg = {azimuth} }} }}\n{rest}\n"
    )
}

fn is_near(value: f64, expected: f64, relative: f64) {
    let miss = (value - expected).abs();
    assert!(miss <= relative * expected.abs(), "{value} for {expected}");
}

/// The elevation at which a place above a point comes into a volume from below.
fn base_of(built: &Built, name: &str, x: f64, y: f64) -> f64 {
    let volume = built.volume(name);
    let holds = |z: f64| built.owners.at(DVec3::new(x, y, z)) == Some(volume);
    let lowest = built.model.domain.z[0];
    let steps = (1..20_000).map(|k| lowest + 0.1 * f64::from(k));
    let mut high = steps.into_iter().find(|z| holds(*z)).unwrap();
    let mut low = high - 0.1;
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

#[test]
fn blocks_of_one_fault_have_the_volumes_of_their_prisms() {
    const THROW: f64 = 12.0;
    let text = format!("{BEDS}{}", fault("f", 480.0, 60.0, 90.0, "throw = 12"));
    let tan = 60_f64.to_radians().tan();
    // Where the fault is at an elevation.
    let at = |z: f64| 480.0 + (-50.0 - z) / tan;
    for engine in [Engine::Partition, Engine::Occt] {
        let built = built(&text, &[], engine);
        let levels = [-100.0, -61.0, -37.0, 0.0];
        for (bed, name) in ["background", "lower", "upper"].into_iter().enumerate() {
            let [low, high] = [levels[bed], levels[bed + 1]];
            let foot = at(0.5 * (low + high)) * (high - low) * 800.0;
            let moved = |z: f64| {
                if z == -100.0 || z == 0.0 {
                    z
                } else {
                    z - THROW
                }
            };
            let [low, high] = [moved(low), moved(high)];
            let hanging = (1000.0 - at(0.5 * (low + high))) * (high - low) * 800.0;
            is_near(built.size(&format!("{name}@f.fw")), foot, 1e-9);
            is_near(built.size(&format!("{name}@f.hw")), hanging, 1e-9);
        }
        assert_eq!(built.solids(), 6);
        // Beds of 24 m with a throw of 12 m are juxtaposed over 12 m with themselves and with each other.
        let area = |height: f64| height / 60_f64.to_radians().sin() * 800.0;
        is_near(built.contact("lower@f.fw", "lower@f.hw"), area(12.0), 1e-9);
        is_near(built.contact("lower@f.fw", "upper@f.hw"), area(12.0), 1e-9);
        assert_eq!(built.contact("background@f.fw", "upper@f.hw"), 0.0);
    }
}

#[test]
fn a_conjugate_pair_moves_beds_as_the_sequence_says_and_offsets_the_older_fault() {
    let text = format!(
        "{BEDS}{}{}",
        fault("a", 430.0, 60.0, 90.0, "throw = 7"),
        fault("b", 470.0, 50.0, 270.0, "throw = 5")
    );
    let built = built(&text, &[], Engine::Partition);
    let upper = |block: &str, x: f64| base_of(&built, &format!("upper@{block}"), x, 333.0);
    let expected = [
        ("a.fw+b.hw", 100.0, -42.0),
        ("a.hw+b.fw", 900.0, -44.0),
        ("a.hw+b.hw", 452.0, -49.0),
    ];
    for (block, x, z) in expected {
        is_near(upper(block, x), z, 1e-9);
    }
    // Fault a across b, normal to itself: −D_b sin(δ_a + δ_b).
    let [dip_a, dip_b] = [60_f64, 50.0].map(f64::to_radians);
    let normal = DVec3::new(dip_a.sin(), 0.0, dip_a.cos());
    let throw = 5.0 / dip_b.sin();
    let slip = DVec3::new(-dip_b.cos(), 0.0, -dip_b.sin()) * throw;
    is_near(slip.dot(normal), -throw * (dip_a + dip_b).sin(), 1e-12);
    // Above the crossing a runs in the hanging wall of b, moved; below, where it was.
    let through = DVec3::new(430.0, 400.0, -50.0);
    for (z, moved) in [(-20.0, slip), (-95.0, DVec3::ZERO)] {
        let from = through + moved;
        let x = from.x + (from.z - z) / dip_a.tan();
        let name = |dx: f64| {
            let owner = built.owners.at(DVec3::new(x + dx, 400.0, z)).unwrap();
            built.realisation.volumes[owner].block.name.clone()
        };
        let [left, right] = [name(-1e-6), name(1e-6)];
        assert!(
            left.starts_with("a.fw") && right.starts_with("a.hw"),
            "{left} {right}"
        );
    }
}

#[test]
fn a_fault_that_has_not_moved_changes_no_volume() {
    let text = format!("{BEDS}{}", fault("f", 480.0, 60.0, 100.0, "throw = 0"));
    let whole = built(BEDS, &[], Engine::Partition);
    let parted = built(&text, &[], Engine::Partition);
    for name in ["background", "lower", "upper"] {
        let halves = ["fw", "hw"].map(|wall| parted.size(&format!("{name}@f.{wall}")));
        is_near(halves.iter().sum(), whole.size(name), 1e-9);
    }
}

#[test]
fn what_is_younger_seals_a_fault_and_takes_from_both_of_its_sides() {
    let fault = fault("f", 480.0, 60.0, 90.0, "throw = 12");
    let seal = |relation: &str| {
        format!(
            "{BEDS}{fault}[[feature]]\nid = \"seal\"\nkind = \"horizon\"\nfacies = \"mud\"\nrelation = \"{relation}\"\nsurface = {{ level = -20 }}\n\
             [[feature]]\nid = \"river\"\nkind = \"channel\"\nfacies = \"sand\"\nwidth = 60\ndepth = 8\ntop = -3\ntrajectory = {{ kind = \"line\", azimuth_deg = 90, center = [500, 400] }}\n"
        )
    };
    for relation in ["erosive", "onlapping"] {
        let built = built(&seal(relation), &[], Engine::Partition);
        let river = built.size("river");
        is_near(built.size("seal") + river, 20.0 * 8e5, 1e-9);
        assert_eq!(built.pieces("seal"), 1);
        assert_eq!(built.pieces("river"), 1);
        assert!(built.contact("seal", "upper@f.fw") > 1e5);
        assert!(built.contact("seal", "upper@f.hw") > 1e5);
    }
}

#[test]
fn a_fault_ends_on_its_master() {
    for (side, blocks) in [
        ("hanging-wall", ["a.hw+b.fw", "a.hw+b.hw"]),
        ("footwall", ["a.fw+b.fw", "a.fw+b.hw"]),
    ] {
        let x = if side == "footwall" { 380.0 } else { 560.0 };
        let ends = format!("throw = 5\nends_on = {{ fault = \"a\", side = \"{side}\" }}");
        let text = format!(
            "{BEDS}{}{}",
            fault("a", 480.0, 60.0, 90.0, "throw = 12"),
            fault("b", x, 65.0, 270.0, &ends)
        );
        let built = built(&text, &[], Engine::Partition);
        for block in blocks {
            assert!(
                built.size(&format!("upper@{block}")) > 0.0,
                "{side}: {block}"
            );
        }
        let other = if side == "footwall" { "a.hw" } else { "a.fw" };
        assert!(
            built.size(&format!("upper@{other}")) > 0.0,
            "{side}: {other}"
        );
        assert_eq!(built.pieces(&format!("upper@{other}")), 1);
    }
}

#[test]
fn both_walls_move_by_their_shares() {
    let text = format!(
        "{BEDS}{}",
        fault("f", 480.0, 60.0, 90.0, "throw = 10\nfootwall_share = 0.4")
    );
    let built = built(&text, &[], Engine::Partition);
    is_near(base_of(&built, "upper@f.fw", 100.0, 100.0), -33.0, 1e-9);
    is_near(base_of(&built, "upper@f.hw", 900.0, 100.0), -43.0, 1e-9);
}

#[test]
fn throw_varies_along_strike() {
    let text = format!(
        "{BEDS}{}",
        fault("f", 480.0, 90.0, 90.0, "throw = [[0, 4], [1, 20]]")
    );
    let built = built(&text, &[], Engine::Partition);
    // The dip is to the right of the strike: looking north, that is where fractions grow.
    for y in [10.0, 400.0, 790.0] {
        let throw = 4.0 + 16.0 * y / 800.0;
        let base = base_of(&built, "upper@f.hw", 700.0, y);
        assert!((base - (-37.0 - throw)).abs() < 0.02, "{y}: {base}");
    }
}

#[test]
fn above_a_listric_fault_the_area_lost_is_the_heave_times_the_depth_of_detachment() {
    // The bed lies above the detachment everywhere, and the fault reaches its level part within the block.
    let text = "name = \"rollover\"\n[domain]\nx = [0, 2000]\ny = [0, 100]\nz = [-500, 100]\nfacies = \"mud\"\n[facies.mud]\n[facies.sand]\n\
        [[feature]]\nid = \"bed\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = { level = 0 }\n\
        [[feature]]\nid = \"f\"\nkind = \"fault\"\nsurface = { listric = { through = [300, 50, 0], dip_deg = 60, azimuth_deg = 90, depth = 400 } }\nheave = 60\ntolerance = 1e-4\n";
    let faulted = built(text, &[], Engine::Partition);
    let plain = Built::new(from_text(text, &[]), &without(&["f"]), Engine::Partition).unwrap();
    // What lies above the bed grows by the area between its regional level and the rollover.
    let above = ["fw", "hw"].map(|wall| faulted.size(&format!("bed@f.{wall}")));
    let lost = above.iter().sum::<f64>() - plain.size("bed");
    is_near(lost, 60.0 * 400.0 * 100.0, 1e-4);
}

#[test]
fn a_similar_fold_keeps_volumes_and_lifts_its_tail() {
    let text = "name = \"fold\"\n[domain]\nx = [0, 1200]\ny = [0, 200]\nz = [-200, 0]\nfacies = \"mud\"\n[facies.mud]\n[facies.sand]\n[facies.silt]\n\
        [[feature]]\nid = \"bed\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = { level = -130 }\n\
        [[feature]]\nid = \"nodule\"\nkind = \"ellipsoid\"\nfacies = \"silt\"\ncenter = [600, 100, -120]\nsemi_axes = [60, 40, 12]\n\
        [[feature]]\nid = \"fold\"\nkind = \"fold\"\nthrough = [600, 100, -130]\nazimuth_deg = 90\naxial_dip_deg = 12\npair = { height = 50, tightness = 8 }\n";
    let built = built(text, &[], Engine::Partition);
    let ellipsoid = 4.0 / 3.0 * std::f64::consts::PI * 60.0 * 40.0 * 12.0;
    is_near(built.size("nodule"), ellipsoid, 1e-4);
    let beyond = [1190.0, 10.0].map(|x| base_of(&built, "bed", x, 77.0));
    let offset = (beyond[0] - beyond[1]).abs();
    assert!((offset - 50.0).abs() < 0.02, "{beyond:?}");
}

#[test]
fn beds_are_younger_where_they_overhang_on_the_side_that_was_up() {
    let text = "name = \"nappe\"\n[domain]\nx = [0, 1200]\ny = [0, 200]\nz = [-200, 0]\nfacies = \"mud\"\n[facies.mud]\n[facies.sand]\n\
        [[feature]]\nid = \"bed\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = { level = -130 }\n\
        [[feature]]\nid = \"fold\"\nkind = \"fold\"\nthrough = [600, 100, -105]\nazimuth_deg = 90\naxial_dip_deg = 8\npair = { height = 60 }\n";
    let built = built(text, &[], Engine::Partition);
    // Through the middle of the overturned limb the bed is met three times.
    let bed = built.volume("bed");
    let steps = (0..4000).map(|k| {
        let z = -200.0 + 0.05 * (f64::from(k) + 0.5);
        built.owners.at(DVec3::new(600.0, 100.0, z)) == Some(bed)
    });
    let sides: Vec<bool> = steps.collect();
    let changes = sides.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert_eq!(changes, 3, "the bed's base is passed three times");
}

#[test]
fn round_numbers_are_built() {
    let bed = |(at, level): (usize, i32)| {
        format!(
            "[[feature]]\nid = \"bed-{at}\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = {{ level = {level} }}\n"
        )
    };
    let beds = [-50, -40, -30, -20].into_iter().enumerate().map(bed);
    let beds = beds.collect::<Vec<_>>().concat();
    let head = "name = \"round\"\n[domain]\nx = [0, 400]\ny = [0, 300]\nz = [-60, 0]\nfacies = \"mud\"\n[facies.mud]\n[facies.sand]\n";
    for throw in [5, 10, 20] {
        let fault = format!(
            "[[feature]]\nid = \"f\"\nkind = \"fault\"\nsurface = {{ dipping = {{ through = [200, 150, -30], dip_deg = 60, azimuth_deg = 90 }} }}\nthrow = {throw}\n"
        );
        let text = format!("{head}{beds}{fault}");
        let built = Built::new(from_text(&text, &[]), &Selection::default(), Engine::Auto).unwrap();
        let total: f64 = (0..built.realisation.volumes.len())
            .map(|volume| built.assembly.measured.size_of(volume))
            .sum();
        is_near(total, 400.0 * 300.0 * 60.0, 1e-9);
        assert!(built.size("bed-1@f.hw") > 0.0);
    }
}
