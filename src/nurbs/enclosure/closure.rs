//! Whether the sides of some surfaces meet in pairs.

use crate::nurbs::bezier::Patch;
use crate::nurbs::closest::nearest;
use crate::nurbs::{Curve, Surface};
use glam::DVec3;
use std::fmt;
use thiserror::Error;

/// One of the four sides of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Least u.
    UStart,
    /// Greatest u.
    UEnd,
    /// Least v.
    VStart,
    /// Greatest v.
    VEnd,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::UStart => "u = start",
            Self::UEnd => "u = end",
            Self::VStart => "v = start",
            Self::VEnd => "v = end",
        })
    }
}

/// Why surfaces are not a closed shell.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum EnclosureError {
    /// There are no surfaces.
    #[error("a shell needs surfaces and there are none")]
    Empty,
    /// The tolerance is not a positive number.
    #[error(
        "the tolerance is {value}; it must be above zero and far below the shell's size {size}"
    )]
    Tolerance {
        /// The tolerance.
        value: f64,
        /// The diagonal of the shell's box.
        size: f64,
    },
    /// A side of a surface is the side of no other.
    #[error(
        "the shell is open: side {side} of surface {surface}, from {from} to {to}, is no other side to within {tolerance}; add the missing surface or make the edges coincide"
    )]
    Open {
        /// Position of the surface in the list.
        surface: usize,
        /// Its side.
        side: Side,
        /// Where the side starts.
        from: DVec3,
        /// Where the side ends.
        to: DVec3,
        /// How far apart edges may be.
        tolerance: f64,
    },
}

struct Edge {
    surface: usize,
    side: Side,
    curve: Curve,
    low: DVec3,
    high: DVec3,
}

/// Pairs each side with another one, of the same surface or not; sides that are single points need no partner.
pub(super) fn check(surfaces: &[Surface], tolerance: f64) -> Result<(), EnclosureError> {
    let mut open: Vec<Edge> = Vec::new();
    for (surface, shape) in surfaces.iter().enumerate() {
        for (side, curve) in sides(shape) {
            let (low, high) = hull(&curve);
            if (high - low).length() <= tolerance {
                continue;
            }
            let edge = Edge {
                surface,
                side,
                curve,
                low,
                high,
            };
            match open.iter().position(|other| same(&edge, other, tolerance)) {
                Some(partner) => drop(open.remove(partner)),
                None => open.push(edge),
            }
        }
    }
    open.first().map_or(Ok(()), |edge| {
        let points = edge.curve.points();
        Err(EnclosureError::Open {
            surface: edge.surface,
            side: edge.side,
            from: points[0],
            to: points[points.len() - 1],
            tolerance,
        })
    })
}

fn sides(surface: &Surface) -> [(Side, Curve); 4] {
    let (u, v) = (surface.knots_u().domain(), surface.knots_v().domain());
    [
        (Side::UStart, surface.isocurve_u(u.0)),
        (Side::UEnd, surface.isocurve_u(u.1)),
        (Side::VStart, surface.isocurve_v(v.0)),
        (Side::VEnd, surface.isocurve_v(v.1)),
    ]
}

fn hull(curve: &Curve) -> (DVec3, DVec3) {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    curve
        .points()
        .iter()
        .fold(empty, |(low, high), &p| (low.min(p), high.max(p)))
}

/// Whether two edges are the same set of points.
fn same(a: &Edge, b: &Edge, tolerance: f64) -> bool {
    let apart = a.low.cmpgt(b.high + tolerance) | b.low.cmpgt(a.high + tolerance);
    if apart.any() {
        return false;
    }
    let (a, b) = (&a.curve, &b.curve);
    same_parameters(a, b, tolerance)
        || same_parameters(a, &b.reversed(), tolerance)
        || a.proportion(b, tolerance).is_some()
        || (may_cover(a, b, tolerance) && covers(a, b, tolerance) && covers(b, a, tolerance))
}

/// Whether the ends of two curves are the same. Those of closed curves, which may begin anywhere, need not be.
fn may_cover(a: &Curve, b: &Curve, tolerance: f64) -> bool {
    let ends = |curve: &Curve| {
        let (from, to) = curve.domain();
        [curve.point(from), curve.point(to)]
    };
    // Each may go on beyond the other by as much as places on them may differ.
    let near = |p: DVec3, q: DVec3| p.distance(q) <= 2.0 * tolerance;
    let ([a, b], [c, d]) = (ends(a), ends(b));
    (near(a, c) && near(b, d)) || (near(a, d) && near(b, c)) || (near(a, b) && near(c, d))
}

/// Whether two curves run alike: what edges that were made from one another do.
fn same_parameters(a: &Curve, b: &Curve, tolerance: f64) -> bool {
    a.knots() == b.knots()
        && a.weights() == b.weights()
        && a.points()
            .iter()
            .zip(b.points())
            .all(|(p, q)| p.distance(*q) <= tolerance)
}

/// Whether samples of `b` all lie on `a`. Between samples two curves of moderate degree that agree on so many points of
/// every piece agree too.
fn covers(a: &Curve, b: &Curve, tolerance: f64) -> bool {
    let pieces = Patch::of_curve(a);
    let on = |p: DVec3| {
        let patches = pieces.iter().map(|(patch, _)| patch);
        nearest(patches, p, 0.25 * tolerance, 2.0 * tolerance)
            .is_some_and(|found| found.distance <= tolerance)
    };
    let samples = 2 * (a.degree() + b.degree()) + 1;
    let along = |pair: &[(f64, usize)]| {
        let (start, end) = (pair[0].0, pair[1].0);
        (0..=samples).all(|k| on(b.point(start + (end - start) * k as f64 / samples as f64)))
    };
    b.knots().distinct().windows(2).all(along)
}
