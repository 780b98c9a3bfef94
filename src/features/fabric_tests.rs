//! Tests of fabrics, in closed form.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use glam::{DVec2, DVec3};

use super::Fabric;
use crate::features::extent::Extent;
use crate::features::horizon::Horizon;
use crate::features::meander::SineGenerated;
use crate::features::trajectory::Trajectory;

fn near(found: DVec3, expected: DVec3, tolerance: f64) {
    assert!(found.distance(expected) < tolerance, "{found} {expected}");
}

#[test]
fn a_tensor_has_its_values_along_its_axes_and_none_between_them() {
    let fabric = Fabric::of_plane(DVec3::new(0.3, -0.2, 0.9), DVec2::Y);
    let tensor = fabric.tensor([5.0, 3.0, 0.5]);
    let times = |v: DVec3| {
        let row = |i: usize| DVec3::from_array(tensor[i]).dot(v);
        DVec3::new(row(0), row(1), row(2))
    };
    for (axis, k) in [
        (fabric.dip, 5.0),
        (fabric.strike, 3.0),
        (fabric.normal, 0.5),
    ] {
        near(times(axis), k * axis, 1e-14);
    }
    let trace = tensor[0][0] + tensor[1][1] + tensor[2][2];
    assert!((trace - 8.5).abs() < 1e-14);
    assert!((tensor[0][1] - tensor[1][0]).abs() < 1e-15);
}

#[test]
fn a_dipping_horizon_lies_as_it_dips() {
    let (low, high) = (DVec3::ZERO, DVec3::new(700.0, 300.0, 100.0));
    let extent = Extent::block(low, high);
    let (dip, azimuth) = (3.0_f64.to_radians(), 120.0_f64.to_radians());
    let horizon = Horizon::dipping(DVec3::new(0.0, 0.0, 50.0), dip, azimuth).unwrap();
    let fabric = Fabric::of_horizon(&horizon, &extent);
    let along = DVec3::new(
        azimuth.sin() * dip.cos(),
        azimuth.cos() * dip.cos(),
        -dip.sin(),
    );
    near(fabric.dip, along, 1e-12);
    near(fabric.strike, along.cross(fabric.normal), 1e-12);
    assert!((fabric.normal.z - dip.cos()).abs() < 1e-12);
    let flat = Horizon::flat(20.0).unwrap();
    assert_eq!(Fabric::of_horizon(&flat, &extent), Fabric::LEVEL);
}

#[test]
fn a_bowl_is_level_in_the_mean() {
    let extent = Extent::block(DVec3::ZERO, DVec3::new(400.0, 400.0, 100.0));
    let at = |i: usize| 100.0 * i as f64 - 200.0;
    let bowl = |tilt: f64| -> Vec<Vec<f64>> {
        let height = |x: f64, y: f64| 20.0 + (x * x + y * y) / 4000.0 - tilt * x;
        (0..5)
            .map(|j| (0..5).map(|i| height(at(i), at(j))).collect())
            .collect()
    };
    let grid = |tilt: f64| Horizon::grid([0.0, 400.0], [0.0, 400.0], &bowl(tilt)).unwrap();
    near(
        Fabric::of_horizon(&grid(0.0), &extent).normal,
        DVec3::Z,
        1e-12,
    );
    // Tilted, it dips as its rims do.
    let fabric = Fabric::of_horizon(&grid(0.05), &extent);
    near(fabric.normal, DVec3::new(0.05, 0.0, 1.0).normalize(), 1e-12);
    near(fabric.dip, DVec3::new(1.0, 0.0, -0.05).normalize(), 1e-12);
}

#[test]
fn a_way_leads_where_its_part_in_the_rectangle_does() {
    let (low, high) = (DVec2::ZERO, DVec2::new(100.0, 100.0));
    let line = Trajectory::line(DVec2::new(-50.0, 20.0), DVec2::new(150.0, 60.0)).unwrap();
    let along = line.mean_direction(low, high).unwrap();
    assert!(along.distance(DVec2::new(5.0, 1.0).normalize()) < 1e-12);
    // A bend of a quarter of a circle leads along its chord: around (0, 0) from (0, 80) to (80, 0).
    let circle = |t: f64| 80.0 * DVec2::new(t.sin(), t.cos());
    let bend = Trajectory::parametric(&circle, [0.0, PI / 2.0]).unwrap();
    let along = bend.mean_direction(low, high).unwrap();
    let chord = DVec2::new(FRAC_1_SQRT_2, -FRAC_1_SQRT_2);
    assert!(along.distance(chord) < 1e-6, "{along}");
    // Half of it lies in the left half of the rectangle: from (0, 80) to (40, 40 √3).
    let along = bend.mean_direction(low, DVec2::new(40.0, 100.0)).unwrap();
    let part = DVec2::new(40.0, 40.0 * 3.0_f64.sqrt() - 80.0).normalize();
    assert!(along.distance(part) < 1e-4, "{along} {part}");
    // What misses the rectangle leads where all of it does.
    let along = bend.mean_direction(DVec2::splat(500.0), DVec2::splat(600.0));
    assert!(along.unwrap().distance(chord) < 1e-6);
    let round = Trajectory::parametric(&circle, [0.0, 2.0 * PI]).unwrap();
    assert_eq!(round.mean_direction(-high, high), None);
}

#[test]
fn a_meander_leads_along_its_belt() {
    let azimuth = 70.0_f64.to_radians();
    let curve = SineGenerated {
        amplitude: 90.0,
        wavelength: 300.0,
        azimuth,
        center: DVec2::new(500.0, 500.0),
        phase: 0.0,
        extent: [-1500.0, 1500.0],
    };
    let meander = Trajectory::sine_generated(&curve).unwrap();
    let everything = DVec2::splat(1e4);
    let along = meander.mean_direction(-everything, everything).unwrap();
    let belt = DVec2::new(azimuth.sin(), azimuth.cos());
    assert!(along.distance(belt) < 1e-6, "{along} {belt}");
}
