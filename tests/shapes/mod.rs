//! Closed bodies with known volumes, as shells of surfaces, and an audit of their partitions.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "shared by several test programs, none of which needs all of it; a test fails by panicking"
)]

pub mod audit;

use clinothem::nurbs::{Curve, KnotVector, Surface};
use clinothem::partition::Region;
use glam::{DMat3, DVec3};
use std::f64::consts::FRAC_1_SQRT_2;

/// A closed shell.
pub type Body = Vec<Surface>;

/// A turn about no axis of symmetry: seams, poles and borders of patches get out of each other's way.
pub fn askew() -> DMat3 {
    turn(0.7, -0.4, 1.1)
}

/// A turn by three angles.
pub fn turn(x: f64, y: f64, z: f64) -> DMat3 {
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
}

/// Every control point moved: exact, since rational curves and surfaces are affinely invariant.
pub fn mapped(body: &[Surface], map: impl Fn(DVec3) -> DVec3) -> Body {
    let one = |surface: &Surface| {
        let net = surface.net().iter().map(|p| map(*p)).collect();
        let (u, v) = (surface.knots_u().clone(), surface.knots_v().clone());
        Surface::rational(u, v, net, surface.weights().to_vec()).unwrap()
    };
    body.iter().map(one).collect()
}

/// A body turned about the origin, then moved.
pub fn placed(body: &[Surface], turn: DMat3, to: DVec3) -> Body {
    mapped(body, |p| turn * p + to)
}

/// The unit circle about the z axis: four rational quadratic quarters.
pub fn circle() -> Curve {
    let corners: [(f64, f64); 9] = [
        (1.0, 0.0),
        (1.0, 1.0),
        (0.0, 1.0),
        (-1.0, 1.0),
        (-1.0, 0.0),
        (-1.0, -1.0),
        (0.0, -1.0),
        (1.0, -1.0),
        (1.0, 0.0),
    ];
    let points = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let weights = (0..9)
        .map(|i| if i % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 })
        .collect();
    let knots = vec![
        0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0,
    ];
    Curve::rational(KnotVector::new(2, knots).unwrap(), points, weights).unwrap()
}

/// A quadratic profile in (distance from the axis, z, weight), turned about the z axis.
fn revolved(profile: &[(f64, f64, f64)], knots: Vec<f64>) -> Surface {
    let round = circle();
    let (mut net, mut weights) = (Vec::new(), Vec::new());
    for (p, w) in round.points().iter().zip(round.weights()) {
        for (across, z, own) in profile {
            net.push(DVec3::new(across * p.x, across * p.y, *z));
            weights.push(w * own);
        }
    }
    let v = KnotVector::new(2, knots).unwrap();
    Surface::rational(round.knots().clone(), v, net, weights).unwrap()
}

/// The unit sphere about the origin: one surface with a seam and two poles.
pub fn sphere() -> Body {
    let c = FRAC_1_SQRT_2;
    let profile = [
        (0.0, -1.0, 1.0),
        (1.0, -1.0, c),
        (1.0, 0.0, 1.0),
        (1.0, 1.0, c),
        (0.0, 1.0, 1.0),
    ];
    vec![revolved(
        &profile,
        vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0],
    )]
}

/// A sphere askew.
pub fn ball(centre: DVec3, radius: f64) -> Region {
    Region::Shell(mapped(&sphere(), |p| radius * (askew() * p) + centre))
}

/// An ellipsoid askew.
pub fn ellipsoid(centre: DVec3, radii: DVec3) -> Region {
    Region::Shell(mapped(&sphere(), |p| askew() * (p * radii) + centre))
}

/// A flat disc with a pole in its middle.
fn disc(radius: f64, z: f64) -> Surface {
    let rim = moved(&circle(), |p| radius * p + z * DVec3::Z);
    let middle = moved(&rim, |_| z * DVec3::Z);
    Surface::ruled(&rim, &middle).unwrap()
}

fn moved(curve: &Curve, map: impl Fn(DVec3) -> DVec3) -> Curve {
    let points = curve.points().iter().map(|p| map(*p)).collect();
    Curve::rational(curve.knots().clone(), points, curve.weights().to_vec()).unwrap()
}

/// A cylinder about the z axis: a side with a seam, and two discs with poles in the middle.
pub fn cylinder(radius: f64, half_length: f64) -> Body {
    let at = |z: f64| moved(&circle(), |p| radius * p + z * DVec3::Z);
    let side = Surface::ruled(&at(-half_length), &at(half_length)).unwrap();
    vec![side, disc(radius, -half_length), disc(radius, half_length)]
}

/// The same of two half sides, with caps between half circles that meet in two points.
pub fn cylinder_of_halves(radius: f64, half_length: f64) -> Body {
    let (near, far) = circle().split(0.5).unwrap();
    let far = far.reversed();
    let at = |half: &Curve, z: f64| moved(half, |p| radius * p + z * DVec3::Z);
    let side =
        |half: &Curve| Surface::ruled(&at(half, -half_length), &at(half, half_length)).unwrap();
    let cap = |z: f64| {
        // Both halves over the same parameters, so that rulings join opposite places.
        Surface::ruled(&over_unit(&at(&near, z)), &over_unit(&at(&far, z))).unwrap()
    };
    vec![side(&near), side(&far), cap(-half_length), cap(half_length)]
}

/// The same curve over [0, 1].
fn over_unit(curve: &Curve) -> Curve {
    let (from, to) = curve.domain();
    let knots = curve
        .knots()
        .as_slice()
        .iter()
        .map(|t| (t - from) / (to - from))
        .collect();
    let knots = KnotVector::new(curve.degree(), knots).unwrap();
    Curve::rational(knots, curve.points().to_vec(), curve.weights().to_vec()).unwrap()
}

/// A bowl `z = steepness (x² + y²)` up to a radius, with a flat lid: two surfaces, each with a pole.
pub fn bowl(steepness: f64, radius: f64) -> Body {
    let height = steepness * radius * radius;
    let profile = [
        (0.0, 0.0, 1.0),
        (0.5 * radius, 0.0, 1.0),
        (radius, height, 1.0),
    ];
    let wall = revolved(&profile, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    vec![wall, disc(radius, height)]
}

/// A straight channel along y, `z = depth ((x / half_width)² − 1)`, with a flat lid at z = 0 and flat ends that
/// shrink to points on both banks.
pub fn trough(half_width: f64, depth: f64, half_length: f64) -> Body {
    let (a, l) = (half_width, half_length);
    let parabola = |y: f64| {
        let points = vec![
            DVec3::new(-a, y, 0.0),
            DVec3::new(0.0, y, -2.0 * depth),
            DVec3::new(a, y, 0.0),
        ];
        Curve::new(
            KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]).unwrap(),
            points,
        )
        .unwrap()
    };
    let line = |y: f64| moved(&parabola(y), |p| DVec3::new(p.x, p.y, 0.0));
    vec![
        Surface::ruled(&parabola(-l), &parabola(l)).unwrap(),
        Surface::ruled(&line(-l), &line(l)).unwrap(),
        Surface::ruled(&parabola(-l), &line(-l)).unwrap(),
        Surface::ruled(&parabola(l), &line(l)).unwrap(),
    ]
}

/// A box of six bilinear surfaces.
pub fn cuboid(low: DVec3, high: DVec3) -> Body {
    let corner = |i: usize| {
        let pick = |axis: usize| {
            if i >> axis & 1 == 1 {
                high[axis]
            } else {
                low[axis]
            }
        };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let knots = || KnotVector::new(1, vec![0.0, 0.0, 1.0, 1.0]).unwrap();
    let side = |c: &[usize; 4]| Surface::new(knots(), knots(), c.map(corner).to_vec()).unwrap();
    [
        [0, 2, 4, 6],
        [1, 3, 5, 7],
        [0, 1, 4, 5],
        [2, 3, 6, 7],
        [0, 1, 2, 3],
        [4, 5, 6, 7],
    ]
    .iter()
    .map(side)
    .collect()
}

/// A block about the origin.
pub fn block(half: f64) -> Region {
    Region::Block {
        low: DVec3::splat(-half),
        high: DVec3::splat(half),
    }
}
