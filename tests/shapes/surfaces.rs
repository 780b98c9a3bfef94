//! Surfaces in closed form, and what turns and joins them.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "shared by several test programs, none of which needs all of it; a test fails by panicking"
)]

use clinothem::nurbs::{Curve, KnotVector, Surface};
use glam::DVec3;
use std::f64::consts::FRAC_1_SQRT_2;

/// A closed shell.
pub type Body = Vec<Surface>;

/// Every control point moved: exact, since rational curves and surfaces are affinely invariant.
pub fn mapped(body: &[Surface], map: impl Fn(DVec3) -> DVec3) -> Body {
    let one = |surface: &Surface| {
        let net = surface.net().iter().map(|p| map(*p)).collect();
        let (u, v) = (surface.knots_u().clone(), surface.knots_v().clone());
        Surface::rational(u, v, net, surface.weights().to_vec()).unwrap()
    };
    body.iter().map(one).collect()
}

/// The same of a curve.
pub fn moved(curve: &Curve, map: impl Fn(DVec3) -> DVec3) -> Curve {
    let points = curve.points().iter().map(|p| map(*p)).collect();
    Curve::rational(curve.knots().clone(), points, curve.weights().to_vec()).unwrap()
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
pub fn revolved(profile: &[(f64, f64, f64)], knots: Vec<f64>) -> Surface {
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
pub fn sphere() -> Surface {
    let c = FRAC_1_SQRT_2;
    let profile = [
        (0.0, -1.0, 1.0),
        (1.0, -1.0, c),
        (1.0, 0.0, 1.0),
        (1.0, 1.0, c),
        (0.0, 1.0, 1.0),
    ];
    revolved(&profile, vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0])
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
