//! Bowls and troughs.

use std::f64::consts::PI;

use clinothem::partition::Region;
use glam::{DMat3, DVec3};

use super::shapes::audit::{combinations, size, sound, youngest};
use super::shapes::{block, bowl, cuboid, mapped, placed, trough};
use super::{SIZE, assert_near, computed};

#[test]
fn a_bowl_is_cut_by_a_level_along_a_circle() {
    let made = sound(
        &[
            block(2.0),
            Region::Shell(placed(
                &bowl(0.8, 1.2),
                DMat3::from_rotation_z(0.3),
                DVec3::NEG_Z,
            )),
            Region::Above(-0.4),
        ],
        combinations,
    );
    let all = PI * 1.44 * 0.8 * 1.44 / 2.0;
    let below = PI * 0.36 / (2.0 * 0.8);
    assert_near(size(&made, 0b010), below, SIZE, "below");
    assert_near(size(&made, 0b110), all - below, SIZE, "above");
    for p in computed(&made)
        .into_iter()
        .filter(|p| p.truncate().length() < 1.5)
    {
        assert!((p.truncate().length() - (0.6_f64 / 0.8).sqrt()).abs() < 1e-7);
    }
}

#[test]
fn a_bowl_is_cut_by_a_slope_along_an_ellipse_above_a_circle() {
    let (k, slope, height) = (0.8, 0.3, 0.5);
    // The half-space below z = slope x + height, as a large box.
    let tilt = DMat3::from_rotation_y(-f64::atan(slope));
    let below = mapped(
        &cuboid(DVec3::new(-4.0, -4.0, -8.0), DVec3::new(4.0, 4.0, 0.0)),
        |p| tilt * (DMat3::from_rotation_z(0.2) * p) + height * DVec3::Z,
    );
    let regions = [
        block(3.0),
        Region::Shell(bowl(k, 1.5)),
        Region::Shell(below),
    ];
    let made = sound(&regions, combinations);
    let centre = 0.5 * slope / k;
    let around = height / k + centre * centre;
    assert_near(
        size(&made, 0b110),
        PI * k * around * around / 2.0,
        SIZE,
        "below the slope",
    );
    let on_bowl = |p: &DVec3| (p.z - k * p.truncate().length_squared()).abs() < 1e-9;
    let curve: Vec<DVec3> = computed(&made).into_iter().filter(on_bowl).collect();
    assert!(curve.len() > 100);
    for p in curve {
        let from_axis = (p - centre * DVec3::X).truncate().length();
        assert!((from_axis - around.sqrt()).abs() < 1e-7);
    }
}

#[test]
fn a_trough_has_two_thirds_of_its_box_whether_or_not_it_ends_in_the_block() {
    let (a, depth) = (0.9, 0.6);
    for half_length in [1.2, 4.0] {
        let body = placed(
            &trough(a, depth, half_length),
            DMat3::from_rotation_z(0.4),
            DVec3::new(0.0, 0.1, 0.3),
        );
        let made = sound(&[block(2.0), Region::Shell(body)], youngest);
        if half_length < 2.0 {
            assert_near(
                size(&made, 1),
                4.0 / 3.0 * a * depth * 2.0 * half_length,
                SIZE,
                "the trough",
            );
        } else {
            assert_eq!(made.topology.solids.len(), 2);
            // Oblique ends do not change the volume between two parallel walls.
            assert_near(
                size(&made, 1),
                4.0 / 3.0 * a * depth * 4.0 / 0.4_f64.cos(),
                SIZE,
                "the trough",
            );
        }
    }
}
