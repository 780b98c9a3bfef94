//! Spheres and ellipsoids: caps, lenses, voids.

use std::f64::consts::PI;

use clinothem::partition::Region;
use glam::DVec3;

use super::shapes::audit::{combinations, size, sound, youngest};
use super::shapes::{ball, block, cuboid, ellipsoid};
use super::{SIZE, assert_near, computed};

/// The cap of height h of a sphere of radius r.
fn cap(r: f64, h: f64) -> f64 {
    PI * h * h * (3.0 * r - h) / 3.0
}

pub(super) fn ball_size(r: f64) -> f64 {
    4.0 / 3.0 * PI * r * r * r
}

#[test]
fn a_sphere_inside_the_block_is_a_void_of_what_is_around_it() {
    let made = sound(
        &[block(2.0), ball(DVec3::new(0.3, -0.2, 0.1), 1.2)],
        youngest,
    );
    let around = made
        .topology
        .solids
        .iter()
        .find(|solid| solid.label == 0)
        .unwrap();
    assert_eq!(around.shells.len(), 2);
    assert_eq!(made.topology.solids.len(), 2);
    assert_near(size(&made, 1), ball_size(1.2), SIZE, "the ball");
    assert_near(size(&made, 0), 64.0 - ball_size(1.2), SIZE, "the rest");
}

#[test]
fn an_ellipsoid_has_four_thirds_pi_times_its_radii() {
    let radii = DVec3::new(1.4, 0.3, 0.8);
    let made = sound(&[block(2.0), ellipsoid(DVec3::ZERO, radii)], youngest);
    assert_near(
        size(&made, 1),
        4.0 / 3.0 * PI * radii.element_product(),
        SIZE,
        "the ellipsoid",
    );
}

#[test]
fn a_level_cuts_a_cap_from_a_sphere_along_a_circle() {
    let (r, centre) = (1.3, DVec3::new(0.2, 0.1, -0.3));
    for level in [-1.1, -0.3, 0.4, 0.999] {
        let made = sound(
            &[block(2.0), ball(centre, r), Region::Above(level)],
            combinations,
        );
        let h = centre.z + r - level;
        assert_near(
            size(&made, 0b110),
            cap(r, h),
            SIZE.max(3e-10 / h),
            "the cap",
        );
        assert_near(
            size(&made, 0b010),
            ball_size(r) - cap(r, h),
            SIZE,
            "the rest of the ball",
        );
        let around = (r * r - (level - centre.z).powi(2)).sqrt();
        let on_wall = |p: &DVec3| p.abs().max_element() > 2.0 - 1e-9;
        for p in computed(&made).into_iter().filter(|p| !on_wall(p)) {
            assert!((p.z - level).abs() < 1e-10);
            let from_axis = (p - centre).truncate().length();
            assert!(
                (from_axis - around).abs() < 1e-7,
                "{from_axis} for {around}"
            );
        }
    }
}

#[test]
fn thin_caps_are_not_missed() {
    let r = 1.3;
    for h in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let made = sound(
            &[block(2.0), ball(DVec3::ZERO, r), Region::Above(r - h)],
            combinations,
        );
        // The circle may be beside its place by 1e-11 of the block's diagonal, on each of both surfaces.
        let strip = 2.0 * PI * (2.0 * r * h).sqrt() * 2e-11 * 48.0_f64.sqrt();
        let error = (size(&made, 0b110) - cap(r, h)).abs();
        assert!(error < strip * r, "{error} m³ of {}", cap(r, h));
    }
}

#[test]
fn a_wall_cuts_a_cap_from_a_sphere() {
    let r = 1.0;
    let made = sound(&[block(2.0), ball(DVec3::new(1.6, 0.1, -0.2), r)], youngest);
    assert_near(
        size(&made, 1),
        ball_size(r) - cap(r, r - 0.4),
        SIZE,
        "what is inside",
    );
    for p in computed(&made) {
        assert!((p.x - 2.0).abs() < 1e-10);
        let from_axis = (p - DVec3::new(2.0, 0.1, -0.2)).length();
        assert!((from_axis - (r * r - 0.16).sqrt()).abs() < 1e-7);
    }
}

#[test]
fn a_sphere_about_an_edge_or_a_corner_of_the_block_keeps_a_quarter_or_an_eighth() {
    let edge = sound(
        &[block(2.0), ball(DVec3::new(2.0, 2.0, 0.1), 1.1)],
        youngest,
    );
    assert_near(size(&edge, 1), ball_size(1.1) / 4.0, SIZE, "the quarter");
    let corner = sound(
        &[block(2.0), ball(DVec3::new(-2.0, 2.0, -2.0), 1.1)],
        youngest,
    );
    assert_near(size(&corner, 1), ball_size(1.1) / 8.0, SIZE, "the eighth");
    assert_eq!(corner.topology.solids.len(), 2);
}

#[test]
fn two_spheres_share_a_lens() {
    let (a, b) = (DVec3::new(-0.3, 0.1, 0.0), DVec3::new(0.6, -0.2, 0.4));
    let (p, q, d) = (1.1, 0.9, a.distance(b));
    let lens =
        PI * (p + q - d).powi(2) * (d * d + 2.0 * d * (p + q) - 3.0 * (p - q).powi(2)) / (12.0 * d);
    let made = sound(&[block(2.0), ball(a, p), ball(b, q)], combinations);
    assert_near(size(&made, 0b110), lens, SIZE, "the lens");
    assert_near(
        size(&made, 0b010),
        ball_size(p) - lens,
        SIZE,
        "the first's rest",
    );
    assert_near(
        size(&made, 0b100),
        ball_size(q) - lens,
        SIZE,
        "the second's rest",
    );
    // The circle lies in the plane of equal powers.
    let along = (b - a) / d;
    let middle = a + 0.5 * (d * d + p * p - q * q) / d * along;
    let around = (p * p - (middle - a).length_squared()).sqrt();
    for at in computed(&made) {
        assert!((at - middle).dot(along).abs() < 1e-9);
        assert!((at.distance(middle) - around).abs() < 1e-7);
    }
}

#[test]
fn a_sphere_in_a_sphere_is_its_void() {
    let regions = [
        block(2.0),
        ball(DVec3::ZERO, 1.5),
        ball(DVec3::new(0.2, 0.3, -0.1), 0.7),
    ];
    let made = sound(&regions, youngest);
    assert_eq!(made.topology.solids.len(), 3);
    assert!(
        made.topology
            .solids
            .iter()
            .all(|solid| solid.shells.len() == if solid.label == 2 { 1 } else { 2 })
    );
    assert_near(
        size(&made, 1),
        ball_size(1.5) - ball_size(0.7),
        SIZE,
        "the outer one",
    );
    assert_near(size(&made, 2), ball_size(0.7), SIZE, "the inner one");
}

#[test]
fn a_younger_sphere_around_an_older_one_removes_it() {
    let regions = [
        block(2.0),
        ball(DVec3::new(0.2, 0.3, -0.1), 0.7),
        ball(DVec3::ZERO, 1.5),
    ];
    let made = sound(&regions, youngest);
    assert_eq!(made.topology.solids.len(), 2);
    assert_near(size(&made, 2), ball_size(1.5), SIZE, "the younger one");
    assert_eq!(size(&made, 1), 0.0);
}

#[test]
fn a_slab_cuts_a_sphere_in_two_caps() {
    let slab = Region::Shell(cuboid(
        DVec3::new(-3.0, -3.0, -0.2),
        DVec3::new(3.0, 3.0, 0.3),
    ));
    let made = sound(&[block(2.0), ball(DVec3::ZERO, 1.2), slab], youngest);
    let mut pieces: Vec<f64> = made
        .topology
        .solids
        .iter()
        .filter(|solid| solid.label == 1)
        .map(|solid| solid.size)
        .collect();
    pieces.sort_by(f64::total_cmp);
    assert_eq!(pieces.len(), 2);
    assert_near(pieces[0], cap(1.2, 0.9), SIZE, "the upper cap");
    assert_near(pieces[1], cap(1.2, 1.0), SIZE, "the lower cap");
    // Below, in, and above the slab.
    assert_eq!(made.topology.solids.len(), 5);
}
