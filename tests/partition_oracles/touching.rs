//! What touches or lies on another is flagged, or right.

use std::f64::consts::PI;

use clinothem::nurbs::{Curve, KnotVector, Surface};
use clinothem::partition::{Options, Region, partition};
use glam::{DMat3, DVec3};

use super::cylinders::{crossed, crossing_cylinders};
use super::shapes::audit::{combinations, size, sound, youngest};
use super::shapes::{askew, ball, block, cuboid, cylinder, mapped, placed, sphere, turn};
use super::{SIZE, assert_near};

/// Regions that touch: the answer must say so.
fn assert_flagged(name: &str, regions: &[Region]) {
    let made = partition(regions.to_vec(), &combinations, &Options::default()).unwrap();
    println!("{name}: {}", made.faults);
    assert!(!made.faults.is_none(), "{name} is not flagged");
}

#[test]
fn spheres_that_touch_are_flagged() {
    for lean in 0..8 {
        let angle = 0.4 * f64::from(lean);
        let direction = DVec3::new(0.6 * angle.cos(), 0.6 * angle.sin(), 0.8);
        for gap in [0.0, 1e-12, -1e-12] {
            let regions = [
                block(2.0),
                ball(DVec3::ZERO, 0.5),
                ball((0.5 + 0.7 + gap) * direction, 0.7),
            ];
            assert_flagged(&format!("spheres side by side, {gap} m apart"), &regions);
            let regions = [
                block(2.0),
                ball(DVec3::ZERO, 0.9),
                ball((0.9 - 0.3 - gap) * direction, 0.3),
            ];
            assert_flagged(&format!("a sphere in another, {gap} m apart"), &regions);
        }
    }
}

#[test]
fn a_sphere_that_touches_a_wall_or_a_level_is_flagged() {
    let straight = |to: DVec3| Region::Shell(mapped(&sphere(), |p| p + to));
    for gap in [0.0, 1e-12, -1e-12, 1e-11] {
        for centre in [
            DVec3::new(1.0 + gap, 0.1, 0.2),
            DVec3::new(0.3, -1.0 + gap, 0.2),
        ] {
            assert_flagged(
                &format!("a sphere {gap} m beyond a wall"),
                &[block(2.0), ball(centre, 1.0)],
            );
            assert_flagged(
                &format!("a sphere {gap} m beyond a wall"),
                &[block(2.0), straight(centre)],
            );
            let level = Region::Above(centre.z + 1.0 + gap);
            assert_flagged(
                &format!("a sphere {gap} m below a level"),
                &[block(3.0), straight(centre), level],
            );
        }
    }
}

#[test]
fn cylinders_that_touch_along_a_line_are_flagged() {
    let first = cylinder(0.5, 1.0);
    let beside = |gap: f64| {
        mapped(&first, |p| {
            p + (1.0 + gap) * DVec3::new(0.6, 0.8, 0.0) + 0.3 * DVec3::Z
        })
    };
    for gap in [0.0, 1e-12, -1e-12, -1e-10] {
        let regions =
            [&first, &beside(gap)].map(|body| Region::Shell(placed(body, askew(), DVec3::ZERO)));
        let [a, b] = regions;
        assert_flagged(
            &format!("parallel cylinders {gap} m apart"),
            &[block(3.0), a, b],
        );
    }
}

#[test]
fn cylinders_of_one_radius_are_flagged_or_share_sixteen_thirds_of_its_cube() {
    for halves in [false, true] {
        assert_flagged("Steinmetz's solid", &crossed(1.0, 1.0, halves));
        // Almost the same, but without branch points.
        for less in [1e-4, 1e-6] {
            let made = sound(&crossed(1.0 - less, 1.0, halves), combinations);
            assert_near(
                size(&made, 0b110),
                crossing_cylinders(1.0 - less, 1.0),
                SIZE,
                "what they share",
            );
        }
        for less in [1e-8, 1e-10, 1e-12, 1e-14] {
            let regions = crossed(1.0 - less, 1.0, halves);
            let made = partition(regions.to_vec(), &combinations, &Options::default()).unwrap();
            let right = (size(&made, 0b110) - 16.0 / 3.0).abs() < 1e-6;
            assert!(right || !made.faults.is_none(), "1 − {less} against 1");
        }
    }
}

#[test]
fn a_cylinder_that_touches_a_sphere_from_inside_is_flagged_or_cuts_out_what_viviani_found() {
    // A cylinder of half the sphere's radius through its middle: 2/3 π − 8/9 of a half ball's 4/3 π.
    for along in [askew(), DMat3::IDENTITY] {
        let reed = Region::Shell(placed(
            &cylinder(0.5, 1.5),
            along,
            along * DVec3::new(0.3, 0.4, 0.0),
        ));
        let regions = [block(3.0), ball(DVec3::ZERO, 1.0), reed];
        let made = partition(regions.to_vec(), &combinations, &Options::default()).unwrap();
        println!("Viviani: {}, {}", made.faults, size(&made, 0b110));
        let wanted = 2.0 / 3.0 * PI - 8.0 / 9.0;
        assert!(!made.faults.is_none() || (size(&made, 0b110) - wanted).abs() < 1e-8);
    }
}

#[test]
fn faces_that_lie_on_each_other_are_flagged() {
    let first = || cuboid(DVec3::ZERO, DVec3::ONE);
    let partly = || cuboid(DVec3::new(1.0, 0.3, 0.4), DVec3::new(2.0, 1.3, 1.4));
    let shells = |bodies: [Vec<Surface>; 2], turned: DMat3| {
        let [a, b] = bodies.map(|body| Region::Shell(placed(&body, turned, DVec3::ZERO)));
        [block(3.0), a, b]
    };
    for turned in [DMat3::IDENTITY, askew()] {
        assert_flagged(
            "boxes that share a part of a face",
            &shells([first(), partly()], turned),
        );
        assert_flagged(
            "boxes that share a face",
            &shells([first(), mapped(&first(), |p| p + DVec3::X)], turned),
        );
        assert_flagged(
            "boxes with faces in one plane",
            &shells(
                [first(), mapped(&first(), |p| p + DVec3::new(0.3, 0.4, 0.0))],
                turned,
            ),
        );
        assert_flagged("a box twice", &shells([first(), first()], turned));
        let on_edge = placed(
            &first(),
            DMat3::from_rotation_z(0.6),
            DVec3::new(1.0, 0.2, 0.2),
        );
        assert_flagged("an edge on a face", &shells([first(), on_edge], turned));
        let on_corner = placed(
            &first(),
            DMat3::from_rotation_y(-0.6) * turn(0.5, 0.0, 0.3),
            DVec3::new(0.4, 0.2, 1.0),
        );
        assert_flagged(
            "a corner near a face",
            &shells([first(), on_corner], turned),
        );
    }
    let touching = |half: f64| {
        [
            block(half),
            Region::Shell(cuboid(DVec3::ZERO, DVec3::new(3.0, 1.0, 1.0))),
        ]
    };
    assert_flagged("a box on a wall", &touching(3.0));
    assert_flagged(
        "a level on a box",
        &[block(3.0), Region::Shell(first()), Region::Above(1.0)],
    );
    let twice = ball(DVec3::ZERO, 1.0);
    assert_flagged("a ball twice", &[block(3.0), twice.clone(), twice]);
}

#[test]
fn a_wall_with_a_kink_is_flagged() {
    // A gabled prism whose roof is one surface of degree 1, cut obliquely by the block's walls.
    let knots =
        |inner: &[f64]| KnotVector::new(1, [&[0.0, 0.0][..], inner, &[1.0, 1.0]].concat()).unwrap();
    let profile = |y: f64, gable: f64| {
        [(-0.8, 0.0), (0.1, gable), (0.8, 0.0)].map(|(x, z)| DVec3::new(x, y, z))
    };
    let curve = |y: f64, gable: f64| Curve::new(knots(&[0.5]), profile(y, gable).to_vec()).unwrap();
    let between = |a: Curve, b: Curve| Surface::ruled(&a, &b).unwrap();
    let body = |l: f64| {
        vec![
            between(curve(-l, 0.6), curve(l, 0.6)),
            between(curve(-l, 0.0), curve(l, 0.0)),
            between(curve(-l, 0.6), curve(-l, 0.0)),
            between(curve(l, 0.6), curve(l, 0.0)),
        ]
    };
    let inside = Region::Shell(placed(&body(1.2), askew(), DVec3::ZERO));
    let made = sound(&[block(2.0), inside], youngest);
    assert_near(size(&made, 1), 0.5 * 1.6 * 0.6 * 2.4, 1e-11, "the prism");
    let long = Region::Shell(placed(&body(4.0), DMat3::from_rotation_z(0.4), DVec3::ZERO));
    let made = partition(vec![block(2.0), long], &youngest, &Options::default()).unwrap();
    let wanted = 0.5 * 1.6 * 0.6 * 4.0 / 0.4_f64.cos();
    println!("kinked: {}, {} of {wanted}", made.faults, size(&made, 1));
    // The curve cannot be followed over the kink: the only counter of its kind.
    assert!(made.faults.tangents > 0, "{}", made.faults);
}
