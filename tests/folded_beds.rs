//! Folded beds: volumes in closed form, beds upside down in the limb, beds that would reach a focus.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[allow(unused_macros, reason = "channels are not what is folded here")]
#[macro_use]
mod assembled;

use assembled::{Built, built};
use clinothem::assembly::Engine;
use glam::DVec3;

const MODEL: &str = include_str!("../models/parallel-fold/parallel-fold.toml");

/// Of the reference curve in the block, with hinges of 60 m that turn by 162° and a limb of 220 m.
fn length() -> f64 {
    let turning = 162_f64.to_radians();
    let overlap = -(120.0 * turning.sin() + 220.0 * turning.cos());
    120.0 * turning + 220.0 + 900.0 + overlap
}

fn bed(built: &Built, number: usize) -> f64 {
    built.size(&format!("nappe-{number}"))
}

#[test]
fn a_beds_volume_is_its_thickness_times_the_reference_curves_length_times_the_width() {
    let built = built(MODEL, &[], Engine::Partition);
    for (at, thickness) in [20.0, 15.0, 20.0, 15.0, 20.0].into_iter().enumerate() {
        let wanted = thickness * length() * 400.0;
        let found = bed(&built, at + 1);
        assert!(
            (found / wanted - 1.0).abs() < 1e-9,
            "{at}: {found} {wanted}"
        );
        assert_eq!(built.pieces(&format!("nappe-{}", at + 1)), 1);
    }
    assert_eq!(built.solids(), 7);
}

#[test]
fn in_the_limb_the_oldest_bed_is_on_top() {
    let built = built(MODEL, &[], Engine::Partition);
    let names: Vec<usize> = (1..=5)
        .map(|k| built.volume(&format!("nappe-{k}")))
        .collect();
    // Down through the middle of the limb, which dips 18°: beds 20, 15, 20, 15 and 20 m thick across, with the middle at 205 m.
    let upright = 18_f64.to_radians().cos();
    let mut across = 45.0;
    for (at, thickness) in [20.0, 15.0, 20.0, 15.0, 20.0].into_iter().enumerate() {
        let middle = across - 0.5 * thickness;
        let place = DVec3::new(450.0, 200.0, -205.0 + middle / upright);
        assert_eq!(built.owners.at(place), Some(names[at]), "{place}");
        across -= thickness;
    }
    // In the tails the youngest is.
    for (x, z) in [(5.0, -205.0 - 151.055_26), (895.0, -205.0 + 151.055_26)] {
        for (at, off) in [-35.0, -17.5, 0.0, 17.5, 35.0].into_iter().enumerate() {
            let place = DVec3::new(x, 200.0, z + off);
            assert_eq!(built.owners.at(place), Some(names[at]), "{place}");
        }
    }
}

#[test]
fn whatever_way_it_verges_beds_have_the_same_volume() {
    // Turned by half a turn, as seen from above, about the middle of the block.
    let turned = built(MODEL, &["feature.nappe.azimuth_deg=270"], Engine::Partition);
    for (at, thickness) in [20.0, 15.0, 20.0, 15.0, 20.0].into_iter().enumerate() {
        let wanted = thickness * length() * 400.0;
        assert!((bed(&turned, at + 1) / wanted - 1.0).abs() < 1e-9);
    }
    // Obliquely, the volumes are those of the point evaluator: the proof compares them. Beds of the same thickness are not cut alike.
    let oblique = built(MODEL, &["feature.nappe.azimuth_deg=70"], Engine::Partition);
    assert!(bed(&oblique, 1) > 1e7 && bed(&oblique, 5) > 1e7);
}

#[test]
fn the_general_fuse_makes_the_same_beds() {
    let fused = built(MODEL, &[], Engine::Occt);
    for (at, thickness) in [20.0, 15.0, 20.0, 15.0, 20.0].into_iter().enumerate() {
        let wanted = thickness * length() * 400.0;
        assert!((bed(&fused, at + 1) / wanted - 1.0).abs() < 1e-6);
    }
}
