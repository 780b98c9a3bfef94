//! Curves of finished topology as splines.

use crate::nurbs::spline::Spline;
use crate::partition::{CurveShape, PlaneCurve};

/// Degree of computed curves.
const COMPUTED: usize = 5;

/// A curve in space.
pub(super) fn of_space(shape: &CurveShape) -> Spline<'_> {
    match shape {
        CurveShape::Known(curve) => Spline::of_curve(curve),
        CurveShape::Computed { knots, points } => Spline::of_points(COMPUTED, knots, points),
    }
}

/// A curve in the parameters of a surface; its third coordinate is zero.
pub(super) fn of_plane(shape: &PlaneCurve, range: [f64; 2]) -> Spline<'_> {
    match shape {
        PlaneCurve::Line { origin, direction } => {
            Spline::of_line(range, range.map(|t| *origin + *direction * t))
        }
        PlaneCurve::Computed { knots, points } => Spline::of_plane_points(COMPUTED, knots, points),
    }
}
