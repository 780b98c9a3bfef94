//! Blocks, walls and bodies that cut nothing: which solids there are.

use std::f64::consts::PI;

use clinothem::nurbs::{KnotVector, Surface};
use clinothem::partition::{Options, Region, partition};
use glam::{DMat3, DVec3};

use super::cylinders::crossing_cylinders;
use super::shapes::audit::{combinations, size, sound, youngest};
use super::shapes::{askew, ball, block, cuboid, cylinder, placed, turn};
use super::spheres::ball_size;
use super::{SIZE, assert_near};

#[test]
fn a_block_alone_is_one_solid_with_six_faces_and_eight_vertices() {
    let made = sound(&[block(2.0)], youngest);
    let topology = &made.topology;
    assert_eq!((topology.solids.len(), topology.faces.len()), (1, 6));
    assert_eq!((topology.edges.len(), topology.vertices.len()), (12, 8));
    assert_near(size(&made, 0), 64.0, 1e-14, "the block");
}

#[test]
fn a_body_outside_the_block_changes_nothing() {
    let made = sound(
        &[block(2.0), ball(DVec3::new(5.0, 0.0, 0.0), 1.0)],
        youngest,
    );
    assert_eq!(
        (made.topology.solids.len(), made.topology.faces.len()),
        (1, 6)
    );
    let around = sound(&[block(2.0), ball(DVec3::ZERO, 9.0)], youngest);
    assert_eq!(
        (
            around.topology.solids.len(),
            around.topology.solids[0].label
        ),
        (1, 1)
    );
}

#[test]
fn voids_find_their_own_solids_among_many_of_one_label() {
    // Eight balls of one label, each around a smaller one.
    let mut regions = vec![block(4.0)];
    for corner in 0..8 {
        let sign = |axis: usize| if corner >> axis & 1 == 1 { 1.9 } else { -1.9 };
        let centre = DVec3::new(sign(0), sign(1), sign(2));
        regions.push(ball(centre, 1.0 + 0.05 * f64::from(corner)));
    }
    for corner in 0..8 {
        let sign = |axis: usize| if corner >> axis & 1 == 1 { 1.8 } else { -1.9 };
        regions.push(ball(DVec3::new(sign(0), sign(1), sign(2)), 0.5));
    }
    let rule = |holds: &[bool]| {
        let which = youngest(holds)?;
        Some(which.div_ceil(8))
    };
    let made = sound(&regions, rule);
    assert_eq!(made.topology.solids.len(), 17);
    for corner in 0..8 {
        let wanted = ball_size(1.0 + 0.05 * f64::from(corner)) - ball_size(0.5);
        let found = made.topology.solids.iter().filter(|solid| solid.label == 1);
        let near = found
            .filter(|solid| (solid.size - wanted).abs() < SIZE * wanted)
            .count();
        assert_eq!(near, 1, "hollow ball {corner}");
    }
}

#[test]
fn a_younger_wall_cuts_a_body_in_two() {
    // A bar along x, cut by a younger cylinder along y.
    let bar = Region::Shell(placed(
        &cylinder(0.4, 1.5),
        turn(0.0, PI / 2.0, 0.3),
        DVec3::ZERO,
    ));
    let cut = Region::Shell(placed(
        &cylinder(0.6, 1.2),
        turn(PI / 2.0, 0.0, 0.3),
        DVec3::ZERO,
    ));
    let made = sound(&[block(2.0), bar, cut], youngest);
    let pieces: Vec<f64> = made
        .topology
        .solids
        .iter()
        .filter(|solid| solid.label == 1)
        .map(|solid| solid.size)
        .collect();
    assert_eq!(pieces.len(), 2);
    let each = (PI * 0.16 * 3.0 - crossing_cylinders(0.4, 0.6)) / 2.0;
    for piece in pieces {
        assert_near(piece, each, SIZE, "a half");
    }
}

#[test]
fn a_wall_with_knots_that_its_neighbours_lack_keeps_its_volume() {
    // A box's wall as a surface with a kink inside itself in its parameters, not in space.
    let mut body = cuboid(DVec3::new(-1.0, -0.7, -0.5), DVec3::new(0.9, 0.6, 0.8));
    let knots = |inner: &[f64]| {
        let all = [&[0.0, 0.0][..], inner, &[1.0, 1.0]].concat();
        KnotVector::new(1, all).unwrap()
    };
    let at = |x: f64, y: f64| DVec3::new(-1.0 + 1.9 * x, -0.7 + 1.3 * y, -0.5);
    let rows = [
        [at(0.0, 0.0), at(0.3, 0.0), at(1.0, 0.0)],
        [at(0.0, 0.3), at(0.6, 0.5), at(1.0, 0.3)],
        [at(0.0, 1.0), at(0.3, 1.0), at(1.0, 1.0)],
    ];
    let net = rows.concat();
    body[4] = Surface::new(knots(&[0.3]), knots(&[0.3]), net).unwrap();
    for turned in [DMat3::IDENTITY, askew()] {
        let inside = Region::Shell(placed(&body, turned, DVec3::ZERO));
        let made = sound(&[block(2.0), inside], youngest);
        assert_near(size(&made, 1), 1.9 * 1.3 * 1.3, 1e-12, "the box");
    }
}

#[test]
fn a_solid_too_thin_to_have_a_volume_is_never_lost_in_another_of_its_label() {
    // The cap has the label of a ball elsewhere.
    let rule = |holds: &[bool]| match combinations(holds)? {
        0b110 | 0b1000 => Some(1),
        other => Some(other),
    };
    for h in [1e-7, 5e-8, 3e-8, 2e-8, 1e-8, 5e-9, 2e-9, 1e-9] {
        let regions = [
            block(2.0),
            ball(DVec3::ZERO, 1.3),
            Region::Above(1.3 - h),
            ball(DVec3::new(-1.4, 1.4, -1.4), 0.5),
        ];
        let made = partition(regions.to_vec(), &rule, &Options::default()).unwrap();
        let whole = made.topology.solids.len() == 5;
        assert!(whole || !made.faults.is_none(), "a cap {h} m high is lost");
    }
}
