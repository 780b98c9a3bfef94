//! Bodies that touch: each other, the domain's faces, or themselves twice. What users write first is full of
//! such coincidences, and no two of these are resolved in the same way.
#![cfg(feature = "occt")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use assert_cmd::Command;
use serde_json::Value;

/// A straight channel: width, depth, top, from, to, more keys.
type Channel = (f64, f64, f64, [f64; 2], [f64; 2], &'static str);

const WEST_EAST: ([f64; 2], [f64; 2]) = ([-50.0, 150.0], [450.0, 150.0]);
const SLANTED: ([f64; 2], [f64; 2]) = ([-50.0, 100.0], [450.0, 180.0]);
const SOUTH_NORTH: ([f64; 2], [f64; 2]) = ([180.0, -50.0], [220.0, 350.0]);

fn channel(width: f64, depth: f64, top: f64, way: ([f64; 2], [f64; 2])) -> Channel {
    (width, depth, top, way.0, way.1, "")
}

fn model(channels: &[Channel]) -> String {
    use std::fmt::Write;
    let mut text = String::from(
        "name = \"Contacts\"\n[domain]\nx = [0, 400]\ny = [0, 300]\nz = [-24, 0]\nfacies = \"mud\"\n\
         [facies.mud]\n[facies.sand]\n",
    );
    for (i, (width, depth, top, from, to, more)) in channels.iter().enumerate() {
        write!(
            text,
            "[[feature]]\nid = \"c{}\"\nkind = \"channel\"\nfacies = \"sand\"\nwidth = {width}\n\
             depth = {depth}\ntop = {top}\n{more}\n\
             trajectory = {{ kind = \"line\", from = {from:?}, to = {to:?} }}\n",
            i + 1
        )
        .unwrap();
    }
    text
}

/// Builds, and gives the report. The program refuses what it cannot prove, so an answer is right.
fn report(channels: &[Channel]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.toml"), model(channels)).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_clinothem"))
        .current_dir(folder.path())
        .args(["build", "model.toml", "--json"])
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}\n{}",
        model(channels),
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

fn volume(report: &Value, name: &str) -> f64 {
    let volumes = report["volumes"].as_array().unwrap();
    let found = volumes.iter().find(|volume| volume["name"] == name);
    found.unwrap()["volume_m3"].as_f64().unwrap()
}

#[test]
fn tops_on_one_level_may_cross_overlap_and_meet_in_a_point() {
    let crossing = [
        channel(60.0, 6.0, -5.0, WEST_EAST),
        channel(60.0, 5.0, -5.0, ([200.0, -50.0], [200.0, 350.0])),
        channel(50.0, 4.0, -5.0, ([-50.0, -100.0], [450.0, 400.0])),
    ];
    let two = report(&crossing[..2]);
    let three = report(&crossing);
    // The younger is whole whatever is below it.
    assert!(volume(&three, "c3") > 0.0);
    assert!(volume(&two, "c2") > volume(&three, "c2"));
    let overlapping = report(&[
        channel(60.0, 6.0, -5.0, WEST_EAST),
        channel(60.0, 6.0, -5.0, ([-50.0, 170.0], [450.0, 170.0])),
    ]);
    assert!(volume(&overlapping, "c1") < volume(&overlapping, "c2"));
    report(&[
        channel(60.0, 6.0, 0.0, SLANTED),
        channel(50.0, 5.0, 0.0, SOUTH_NORTH),
        channel(40.0, 4.0, 0.0, ([-50.0, 250.0], [450.0, 40.0])),
    ]);
}

#[test]
fn channels_side_by_side_that_share_a_rim_keep_their_volumes() {
    let alone = report(&[channel(60.0, 6.0, -5.0, WEST_EAST)]);
    let both = report(&[
        channel(60.0, 6.0, -5.0, ([-50.0, 120.0], [450.0, 120.0])),
        channel(60.0, 6.0, -5.0, ([-50.0, 180.0], [450.0, 180.0])),
    ]);
    for name in ["c1", "c2"] {
        // Micrometres of the shared rim: 400 m long.
        let miss = volume(&both, name) - volume(&alone, "c1");
        assert!(miss.abs() < 0.05, "{name}: {miss}");
    }
}

#[test]
fn a_channel_may_touch_the_domains_base_its_walls_and_end_on_them() {
    report(&[channel(60.0, 8.0, -16.0, SLANTED)]);
    report(&[channel(60.0, 6.0, -5.0, ([-50.0, 30.0], [450.0, 30.0]))]);
    report(&[channel(60.0, 6.0, -5.0, ([0.0, 0.0], [400.0, 300.0]))]);
    let on_the_walls = report(&[channel(60.0, 6.0, -5.0, ([0.0, 150.0], [400.0, 150.0]))]);
    let beyond = report(&[channel(60.0, 6.0, -5.0, WEST_EAST)]);
    // Where contacts are decided by age, bodies are narrower by a billionth of the domain's size.
    let miss = volume(&on_the_walls, "c1") / volume(&beyond, "c1") - 1.0;
    assert!(miss.abs() < 1e-6, "{miss}");
}

#[test]
fn a_channel_may_lie_in_the_very_place_of_an_older_one() {
    let same = channel(60.0, 6.0, -5.0, SLANTED);
    let alone = report(&[same]);
    let twice = report(&[same, same]);
    assert_eq!(volume(&twice, "c1"), 0.0);
    let miss = volume(&twice, "c2") - volume(&alone, "c1");
    assert!(miss.abs() < 1e-3, "{miss}");
    let deeper = report(&[same, channel(60.0, 6.0, -7.0, SLANTED)]);
    assert!(volume(&deeper, "c1") > 0.0);
    let narrower = report(&[same, channel(30.0, 6.0, -5.0, SLANTED)]);
    assert!(volume(&narrower, "c1") > 0.0);
    let child = (40.0, 3.0, -7.0, SLANTED.0, SLANTED.1, "parent = \"c1\"");
    let with_child = report(&[same, child]);
    let sum = volume(&with_child, "c1") + volume(&with_child, "c1/c2");
    let miss = sum - volume(&alone, "c1");
    assert!(miss.abs() < 1e-3, "a child takes from its parent: {miss}");
}

#[test]
fn a_top_may_touch_an_older_base() {
    report(&[
        channel(60.0, 6.0, -5.0, SLANTED),
        channel(60.0, 6.0, -11.0, SOUTH_NORTH),
    ]);
    report(&[
        channel(60.0, 6.0, -5.0, WEST_EAST),
        channel(60.0, 6.0, -11.0, WEST_EAST),
    ]);
}

#[test]
fn storeys_may_have_a_level_at_which_others_meet_far_from_them() {
    let row = |y: f64| ([-50.0, y], [450.0, y]);
    let made = report(&[
        channel(30.0, 6.0, -12.0, row(60.0)),
        channel(30.0, 6.0, -6.0, row(60.0)),
        channel(40.0, 5.0, -12.0, row(200.0)),
        channel(40.0, 5.0, -12.0, row(240.0)),
    ]);
    assert_eq!(made["assembly"]["engine"], "partition");
    let alone =
        |width: f64, depth: f64| volume(&report(&[channel(width, depth, -12.0, row(60.0))]), "c1");
    let sizes = [alone(30.0, 6.0), alone(40.0, 5.0)];
    for (name, wanted) in [("c1", 0), ("c2", 0), ("c3", 1), ("c4", 1)] {
        // Micrometres along 400 m of rims and thalwegs.
        let miss = volume(&made, name) - sizes[wanted];
        assert!(miss.abs() < 0.1, "{name}: {miss}");
    }
}

#[test]
fn banks_that_overhang_and_ends_inside_may_lie_at_the_domains_top() {
    let (from, to) = SLANTED;
    report(&[
        (60.0, 6.0, 0.0, from, to, "left_angle_deg = 120"),
        (
            50.0,
            5.0,
            -2.0,
            SOUTH_NORTH.0,
            SOUTH_NORTH.1,
            "right_angle_deg = 110",
        ),
    ]);
    report(&[
        channel(60.0, 6.0, 0.0, ([-50.0, 100.0], [200.0, 150.0])),
        channel(50.0, 5.0, -2.0, ([200.0, 150.0], [450.0, 200.0])),
    ]);
}

#[test]
fn a_body_outside_the_domain_leaves_only_the_background() {
    let report = report(&[channel(60.0, 6.0, -5.0, ([-500.0, 900.0], [900.0, 900.0]))]);
    assert_eq!(volume(&report, "c1"), 0.0);
    assert_eq!(report["assembly"]["solids"], 1);
    assert!((volume(&report, "background") - 400.0 * 300.0 * 24.0).abs() < 1e-3);
}
