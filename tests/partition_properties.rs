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
    ProptestConfig {
        cases,
        failure_persistence: None,
        max_shrink_iters: 40,
        ..ProptestConfig::default()
    }
}

fn point(reach: f64) -> impl Strategy<Value = DVec3> {
    let x = move || -reach..reach;
    (x(), x(), x()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn angles() -> impl Strategy<Value = [f64; 3]> {
    (-3.0..3.0, -1.5..1.5, -3.0..3.0).prop_map(|(x, y, z)| [x, y, z])
}

fn turned([x, y, z]: [f64; 3]) -> DMat3 {
    turn(x, y, z)
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Ellipsoid,
    Can,
    Box,
}

/// A body anywhere near the origin, written down shortly for when a case fails.
#[derive(Clone, Copy, Debug)]
struct Shape {
    kind: Kind,
    size: [f64; 3],
    angles: [f64; 3],
    to: DVec3,
}

impl Shape {
    fn body(&self) -> Body {
        let size = DVec3::from_array(self.size);
        let body = match self.kind {
            Kind::Ellipsoid => mapped(&sphere(), |p| 1.3 * p * size),
            Kind::Can => cylinder(size.x, 1.2 * size.y),
            Kind::Box => cuboid(-size, size),
        };
        placed(&body, turned(self.angles), self.to)
    }
}

fn bodies(count: impl Into<prop::collection::SizeRange>) -> impl Strategy<Value = Vec<Shape>> {
    let kind = prop_oneof![Just(Kind::Ellipsoid), Just(Kind::Can), Just(Kind::Box)];
    let shape = (kind, [0.3..0.9, 0.3..0.9, 0.3..0.9], angles(), point(0.6)).prop_map(
        |(kind, size, angles, to)| Shape {
            kind,
            size,
            angles,
            to,
        },
    );
    prop::collection::vec(shape, count)
}

fn made(shapes: &[Shape]) -> Vec<Body> {
    shapes.iter().map(Shape::body).collect()
}

fn shells(bodies: &[Body]) -> Vec<Region> {
    bodies.iter().cloned().map(Region::Shell).collect()
}

fn scene(half: f64, bodies: &[Body]) -> Vec<Region> {
    [vec![block(half)], shells(bodies)].concat()
}

fn counts(made: &Partition) -> [usize; 4] {
    let all = &made.topology;
    [
        all.solids.len(),
        all.faces.len(),
        all.edges.len(),
        all.vertices.len(),
    ]
}

/// Sizes by label, sorted within each.
fn sizes(made: &Partition) -> Vec<(usize, f64)> {
    let mut all: Vec<(usize, f64)> = made
        .topology
        .solids
        .iter()
        .map(|solid| (solid.label, solid.size))
        .collect();
    all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    all
}

/// Sizes (m³) in blocks of some metres: curves may be anywhere within their tolerance, and beside a pole quadrature
/// is coarser than they are.
const SIZE: f64 = 5e-8;

fn assert_same(a: &[(usize, f64)], b: &[(usize, f64)]) {
    assert_eq!(a.len(), b.len(), "{a:?} {b:?}");
    for (a, b) in a.iter().zip(b) {
        assert_eq!(a.0, b.0);
        assert!((a.1 - b.1).abs() <= SIZE, "{a:?} {b:?}");
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
    #![proptest_config(few(40))]

    #[test]
    fn random_bodies_pass_the_audit_with_each_rule(shapes in bodies(2..5)) {
        let bodies = made(&shapes);
        let regions = scene(1.3, &bodies);
        let by_age = sound(&regions, youngest);
        let all = sound(&regions, combinations);
        // The youngest has what the combinations that it is part of have.
        let last = bodies.len();
        let with: f64 = all.topology.solids.iter().filter(|solid| solid.label >> last & 1 == 1).map(|solid| solid.size).sum();
        prop_assert!((size(&by_age, last) - with).abs() < SIZE);
    }
}

proptest! {
    #![proptest_config(few(12))]

    #[test]
    fn the_order_of_regions_does_not_matter(
        shapes in bodies(3),
        order in Just(vec![0, 1, 2]).prop_shuffle(),
    ) {
        let bodies = made(&shapes);
        let first = sound(&scene(1.6, &bodies), combinations);
        let again: Vec<Body> = order.iter().map(|at| bodies[*at].clone()).collect();
        let rule = |holds: &[bool]| reordered(&order, holds);
        let second = partition(scene(1.6, &again), &rule, &Options::default()).unwrap();
        prop_assert!(second.faults.is_none(), "{}", second.faults);
        assert_same(&sizes(&first), &sizes(&second));
        prop_assert_eq!(counts(&first)[0], counts(&second)[0]);
        prop_assert_eq!(counts(&first)[1], counts(&second)[1]);
    }

    #[test]
    fn what_bodies_share_does_not_depend_on_where_they_are(
        shapes in bodies(2),
        motion in angles(),
        to in point(0.5),
    ) {
        let bodies = made(&shapes);
        let first = sound(&scene(4.0, &bodies), combinations);
        let moved: Vec<Body> = bodies.iter().map(|body| placed(body, turned(motion), to)).collect();
        let second = sound(&scene(4.0, &moved), combinations);
        assert_same(&sizes(&first), &sizes(&second));
        prop_assert_eq!(counts(&first)[..2].to_vec(), counts(&second)[..2].to_vec());
    }

    #[test]
    fn size_does_not_matter(shapes in bodies(3)) {
        let bodies = made(&shapes);
        let first = sound(&scene(1.3, &bodies), combinations);
        for factor in [1e-3_f64, 1e3, 0.37] {
            let scaled: Vec<Body> = bodies.iter().map(|body| mapped(body, |p| factor * p)).collect();
            let second = sound(&scene(1.3 * factor, &scaled), combinations);
            let back: Vec<(usize, f64)> =
                sizes(&second).into_iter().map(|(label, size)| (label, size / factor.powi(3))).collect();
            assert_same(&sizes(&first), &back);
            prop_assert_eq!(counts(&first), counts(&second));
        }
    }

    #[test]
    fn threads_do_not_matter(shapes in bodies(3)) {
        let bodies = made(&shapes);
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
fn a_curve_beside_a_pole_is_no_contact() {
    // It passes the middle of a cap at 0.1 mm.
    let shape = |size: [f64; 3], angles: [f64; 3], to: DVec3| Shape {
        kind: Kind::Can,
        size,
        angles,
        to,
    };
    let shapes = [
        shape(
            [0.393_800_105_191_572_1, 0.488_265_351_595_448_4, 0.3],
            [
                -2.842_733_222_176_568_7,
                -0.343_962_172_180_437_95,
                -0.854_107_293_068_688_3,
            ],
            DVec3::new(
                0.250_371_114_824_332,
                -0.586_854_435_936_225_1,
                0.135_095_692_466_601_52,
            ),
        ),
        shape(
            [0.3, 0.350_995_903_936_682_06, 0.3],
            [
                1.792_391_327_670_047,
                -0.772_726_120_626_841_8,
                -0.701_027_719_065_822_7,
            ],
            DVec3::new(
                0.074_787_981_506_312_54,
                0.139_302_098_960_092_27,
                0.574_996_392_530_955_8,
            ),
        ),
    ];
    sound(&scene(1.3, &made(&shapes)), combinations);
}

#[test]
fn surfaces_seen_from_behind_or_across_bound_the_same_bodies() {
    let bodies = [
        placed(
            &cylinder(0.6, 1.0),
            turn(0.3, 0.2, 0.1),
            DVec3::new(0.2, 0.1, 0.0),
        ),
        mapped(&sphere(), |p| {
            turn(0.7, -0.4, 1.1) * p + DVec3::new(0.6, 0.5, 0.45)
        }),
    ];
    let first = sound(&scene(1.4, &bodies), combinations);
    let ways: [fn(&Surface) -> Surface; 3] = [
        Surface::transposed,
        Surface::reversed_u,
        Surface::reversed_v,
    ];
    for way in ways {
        // Every other surface, so that neighbours differ.
        let other: Vec<Body> = bodies
            .iter()
            .map(|body| {
                body.iter()
                    .enumerate()
                    .map(|(k, s)| if k % 2 == 0 { way(s) } else { s.clone() })
                    .collect()
            })
            .collect();
        let second = sound(&scene(1.4, &other), combinations);
        assert_same(&sizes(&first), &sizes(&second));
        assert_eq!(counts(&first), counts(&second));
    }
}
