//! What must not change a partition: the order of its regions, where and how large they are, and threads.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod shapes;

use clinothem::nurbs::Surface;
use clinothem::partition::{Label, Options, Partition, Region, partition};
use glam::{DMat3, DVec3};
use proptest::prelude::*;
use shapes::audit::{combinations, size, sound, youngest};
use shapes::{Body, block, cuboid, cylinder, mapped, placed, sphere, turn};

fn few(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

fn point(reach: f64) -> impl Strategy<Value = DVec3> {
    let x = move || -reach..reach;
    (x(), x(), x()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn turned() -> impl Strategy<Value = DMat3> {
    (-3.0..3.0, -1.5..1.5, -3.0..3.0).prop_map(|(x, y, z)| turn(x, y, z))
}

/// A ball, a can or a box, anywhere near the origin.
fn body() -> impl Strategy<Value = Body> {
    let shape = prop_oneof![
        (0.3..1.2, 0.3..1.2, 0.3..1.2).prop_map(|(a, b, c)| mapped(&sphere(), |p| p * DVec3::new(a, b, c))),
        (0.3..0.8, 0.3..1.1).prop_map(|(r, l)| cylinder(r, l)),
        (0.3..0.9, 0.3..0.9, 0.3..0.9).prop_map(|(a, b, c)| cuboid(-DVec3::new(a, b, c), DVec3::new(a, b, c))),
    ];
    (shape, turned(), point(0.6)).prop_map(|(body, turn, to)| placed(&body, turn, to))
}

fn shells(bodies: &[Body]) -> Vec<Region> {
    bodies.iter().cloned().map(Region::Shell).collect()
}

fn scene(half: f64, bodies: &[Body]) -> Vec<Region> {
    [vec![block(half)], shells(bodies)].concat()
}

fn counts(made: &Partition) -> [usize; 4] {
    let all = &made.topology;
    [all.solids.len(), all.faces.len(), all.edges.len(), all.vertices.len()]
}

/// Sizes by label, sorted within each.
fn sizes(made: &Partition) -> Vec<(usize, f64)> {
    let mut all: Vec<(usize, f64)> =
        made.topology.solids.iter().map(|solid| (solid.label, solid.size)).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    all
}

fn assert_same(a: &[(usize, f64)], b: &[(usize, f64)], part: f64) {
    assert_eq!(a.len(), b.len(), "{a:?} {b:?}");
    for (a, b) in a.iter().zip(b) {
        assert_eq!(a.0, b.0);
        assert!((a.1 - b.1).abs() <= part, "{a:?} {b:?}");
    }
}

/// The combination of the bodies, whatever their order in the list.
fn reordered(order: &[usize], holds: &[bool]) -> Label {
    let mut sorted = vec![holds[0]; order.len() + 1];
    for (at, body) in order.iter().enumerate() {
        sorted[body + 1] = holds[at + 1];
    }
    combinations(&sorted)
}

proptest! {
    #![proptest_config(few(24))]

    #[test]
    fn random_bodies_pass_the_audit_with_each_rule(bodies in prop::collection::vec(body(), 2..5)) {
        let regions = scene(1.3, &bodies);
        let by_age = sound(&regions, youngest);
        let all = sound(&regions, combinations);
        // The youngest has what the combinations that it is part of have.
        let last = bodies.len();
        let with: f64 = all.topology.solids.iter().filter(|solid| solid.label >> last & 1 == 1).map(|solid| solid.size).sum();
        prop_assert!((size(&by_age, last) - with).abs() < 1e-9);
    }
}

proptest! {
    #![proptest_config(few(8))]

    #[test]
    fn the_order_of_regions_does_not_matter(
        bodies in prop::collection::vec(body(), 3),
        order in Just(vec![0, 1, 2]).prop_shuffle(),
    ) {
        let first = sound(&scene(1.6, &bodies), combinations);
        let again: Vec<Body> = order.iter().map(|at| bodies[*at].clone()).collect();
        let rule = |holds: &[bool]| reordered(&order, holds);
        let second = partition(scene(1.6, &again), &rule, &Options::default()).unwrap();
        prop_assert!(second.faults.is_none(), "{}", second.faults);
        assert_same(&sizes(&first), &sizes(&second), 1e-9);
        prop_assert_eq!(counts(&first)[0], counts(&second)[0]);
        prop_assert_eq!(counts(&first)[1], counts(&second)[1]);
    }

    #[test]
    fn what_bodies_share_does_not_depend_on_where_they_are(
        bodies in prop::collection::vec(body(), 2),
        motion in turned(),
        to in point(0.5),
    ) {
        let first = sound(&scene(4.0, &bodies), combinations);
        let moved: Vec<Body> = bodies.iter().map(|body| placed(body, motion, to)).collect();
        let second = sound(&scene(4.0, &moved), combinations);
        assert_same(&sizes(&first), &sizes(&second), 1e-8);
        prop_assert_eq!(counts(&first)[..2].to_vec(), counts(&second)[..2].to_vec());
    }

    #[test]
    fn size_does_not_matter(bodies in prop::collection::vec(body(), 3)) {
        let first = sound(&scene(1.3, &bodies), combinations);
        for factor in [1e-3_f64, 1e3, 0.37] {
            let scaled: Vec<Body> = bodies.iter().map(|body| mapped(body, |p| factor * p)).collect();
            let second = sound(&scene(1.3 * factor, &scaled), combinations);
            let back: Vec<(usize, f64)> =
                sizes(&second).into_iter().map(|(label, size)| (label, size / factor.powi(3))).collect();
            assert_same(&sizes(&first), &back, 1e-9);
            prop_assert_eq!(counts(&first), counts(&second));
        }
    }

    #[test]
    fn threads_do_not_matter(bodies in prop::collection::vec(body(), 3)) {
        let regions = scene(1.3, &bodies);
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let made = pool.install(|| partition(regions.clone(), &combinations, &Options::default()).unwrap());
            format!("{:?} {:?} {:?}", made.topology, made.faults, made.crossing_regions)
        };
        let one = with(1);
        prop_assert!(one.len() > 1000);
        prop_assert!(one == with(2) && one == with(4));
    }
}

#[test]
fn surfaces_seen_from_behind_or_across_bound_the_same_bodies() {
    let bodies = [
        placed(&cylinder(0.6, 1.0), turn(0.3, 0.2, 0.1), DVec3::new(0.2, 0.1, 0.0)),
        mapped(&sphere(), |p| turn(0.7, -0.4, 1.1) * p + DVec3::new(0.6, 0.5, 0.45)),
    ];
    let first = sound(&scene(1.4, &bodies), combinations);
    let ways: [fn(&Surface) -> Surface; 3] =
        [Surface::transposed, Surface::reversed_u, Surface::reversed_v];
    for way in ways {
        // Every other surface, so that neighbours differ.
        let other: Vec<Body> = bodies
            .iter()
            .map(|body| body.iter().enumerate().map(|(k, s)| if k % 2 == 0 { way(s) } else { s.clone() }).collect())
            .collect();
        let second = sound(&scene(1.4, &other), combinations);
        assert_same(&sizes(&first), &sizes(&second), 1e-9);
        assert_eq!(counts(&first), counts(&second));
    }
}
