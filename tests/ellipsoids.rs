//! Ellipsoids whose shares have closed forms: cut by the block's faces, overlapping, touching, one in another.
#![cfg(feature = "occt")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::PI;

use assert_cmd::Command;
use serde_json::Value;

const WHOLE: f64 = 4.0 / 3.0 * PI * 6.0 * 4.0 * 2.0;

/// Builds nodules from (semi-axes, centre, more keys), and gives the report. The program refuses what it cannot
/// prove, so an answer is right.
fn report(nodules: &[([f64; 3], [f64; 3], &str)]) -> Value {
    use std::fmt::Write;
    let mut text = String::from(
        "name = \"Ellipsoids\"\n[domain]\nx = [0, 100]\ny = [0, 80]\nz = [-30, 0]\nfacies = \"mud\"\n\
         [facies.mud]\n[facies.cement]\n",
    );
    for (i, (semi_axes, center, more)) in nodules.iter().enumerate() {
        write!(
            text,
            "[[feature]]\nid = \"n{i}\"\nkind = \"ellipsoid\"\nfacies = \"cement\"\n\
             semi_axes = {semi_axes:?}\ncenter = {center:?}\n{more}\n"
        )
        .unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.toml"), &text).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_clinothem"))
        .current_dir(folder.path())
        .args(["build", "model.toml", "--json"])
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{text}\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

fn volume(report: &Value, index: usize) -> f64 {
    let volumes = report["volumes"].as_array().unwrap();
    let name = format!("n{index}");
    let found = volumes
        .iter()
        .find(|volume| volume["name"] == name.as_str());
    found.unwrap()["volume_m3"].as_f64().unwrap()
}

/// A curve where two surfaces cross is fitted to 10⁻⁷ m, so a volume of 50 m³ on 100 m² is right to 2 · 10⁻⁷; the
/// faces' integrals leave about as much.
fn assert_close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() < 1e-6 * expected,
        "{found} instead of {expected}"
    );
}

#[test]
fn the_blocks_faces_cut_an_ellipsoid_into_halves_quarters_and_eighths() {
    let axes = [6.0, 4.0, 2.0];
    let report = report(&[
        (axes, [30.0, 30.0, 0.0], "azimuth_deg = 25"),
        (
            axes,
            [100.0, 40.0, -12.0],
            "azimuth_deg = 70\nplunge_deg = 20",
        ),
        (
            axes,
            [60.0, 0.0, -30.0],
            "azimuth_deg = 90\nplunge_deg = 35",
        ),
        (axes, [0.0, 0.0, -30.0], ""),
        // It touches the block's top with its pole, and a wall with its second axis.
        (axes, [4.0, 60.0, -2.0], ""),
    ]);
    // Each plane through the centre halves it, whatever its direction …
    assert_close(volume(&report, 0), WHOLE / 2.0);
    assert_close(volume(&report, 1), WHOLE / 2.0);
    // … and the two planes here hold the second axis or are at right angles to it.
    assert_close(volume(&report, 2), WHOLE / 4.0);
    assert_close(volume(&report, 3), WHOLE / 8.0);
    assert_close(volume(&report, 4), WHOLE);
}

#[test]
fn the_younger_of_two_ellipsoids_takes_the_lens_that_they_have_in_common() {
    // Stretched unit spheres at a distance d have π (4 + d) (2 − d)² / 12 in common.
    let lens = |d: f64| PI * (4.0 + d) * (2.0 - d).powi(2) / 12.0 * 48.0;
    let axes = [6.0, 4.0, 2.0];
    let report = report(&[
        // Along the first axis, to the north.
        (axes, [20.0, 20.0, -10.0], ""),
        (axes, [20.0, 26.0, -10.0], ""),
        // Pole above pole.
        (axes, [60.0, 20.0, -10.0], ""),
        (axes, [60.0, 20.0, -13.0], ""),
        // They touch in one point.
        (axes, [20.0, 60.0, -10.0], ""),
        (axes, [28.0, 60.0, -10.0], ""),
        // One in the other, touching it from inside at the pole.
        (axes, [60.0, 60.0, -10.0], ""),
        ([3.0, 2.0, 1.0], [60.0, 60.0, -9.0], ""),
        // The same shell twice, the younger removing nothing.
        (axes, [85.0, 60.0, -10.0], ""),
        (axes, [85.0, 60.0, -10.0], "removes = []"),
    ]);
    assert_close(volume(&report, 0), WHOLE - lens(1.0));
    assert_close(volume(&report, 1), WHOLE);
    assert_close(volume(&report, 2), WHOLE - lens(1.5));
    assert_close(volume(&report, 3), WHOLE);
    assert_close(volume(&report, 4), WHOLE);
    assert_close(volume(&report, 5), WHOLE);
    assert_close(volume(&report, 6), WHOLE * 7.0 / 8.0);
    assert_close(volume(&report, 7), WHOLE / 8.0);
    assert_close(volume(&report, 8), WHOLE);
    assert!(volume(&report, 9) == 0.0);
}
