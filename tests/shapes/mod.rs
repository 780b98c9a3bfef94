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
mod surfaces;

use clinothem::nurbs::{Curve, KnotVector, Surface};
use clinothem::partition::Region;
use glam::{DMat3, DVec3};

#[allow(unused_imports, reason = "not every test program needs all of it")]
pub use surfaces::{Body, circle, cuboid, mapped};
use surfaces::{moved, revolved};

/// A turn about no axis of symmetry: seams, poles and borders of patches get out of each other's way.
pub fn askew() -> DMat3 {
    turn(0.7, -0.4, 1.1)
}

/// A turn by three angles.
pub fn turn(x: f64, y: f64, z: f64) -> DMat3 {
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
}

/// A body turned about the origin, then moved.
pub fn placed(body: &[Surface], turn: DMat3, to: DVec3) -> Body {
    mapped(body, |p| turn * p + to)
}

/// The unit sphere about the origin: one surface with a seam and two poles.
pub fn sphere() -> Body {
    vec![surfaces::sphere()]
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

/// A block about the origin.
pub fn block(half: f64) -> Region {
    Region::Block {
        low: DVec3::splat(-half),
        high: DVec3::splat(half),
    }
}
