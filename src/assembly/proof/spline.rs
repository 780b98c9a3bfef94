//! Curves of finished topology as rational Bézier pieces, read from their knots and control points by blossoms.
//!
//! Any part of a span is a piece as well, so nothing has to be split; and nothing is stored, since most pieces are never
//! looked at closely.

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};

use crate::nurbs::blossom;
pub(super) use crate::nurbs::blossom::Net;
use crate::partition::{CurveShape, PlaneCurve};

/// Degree of computed curves.
const COMPUTED: usize = 5;

/// A B-spline curve.
pub(super) struct Spline<'a> {
    degree: usize,
    knots: Knots<'a>,
    points: Points<'a>,
}

enum Knots<'a> {
    Of(&'a [f64]),
    Line([f64; 4]),
}

#[derive(Clone, Copy)]
enum Points<'a> {
    Space(&'a [DVec3]),
    Rational(&'a [DVec3], &'a [f64]),
    Plane(&'a [DVec2]),
    Line([DVec2; 2]),
}

impl<'a> Spline<'a> {
    pub(super) fn of_space(shape: &'a CurveShape) -> Self {
        match shape {
            CurveShape::Known(curve) => Self {
                degree: curve.degree(),
                knots: Knots::Of(curve.knots().as_slice()),
                points: Points::Rational(curve.points(), curve.weights()),
            },
            CurveShape::Computed { knots, points } => Self {
                degree: COMPUTED,
                knots: Knots::Of(knots),
                points: Points::Space(points),
            },
        }
    }

    /// In the parameters of a surface; the third coordinate is zero.
    pub(super) fn of_plane(shape: &'a PlaneCurve, range: [f64; 2]) -> Self {
        match shape {
            PlaneCurve::Line { origin, direction } => Self {
                degree: 1,
                knots: Knots::Line([range[0], range[0], range[1], range[1]]),
                points: Points::Line(range.map(|t| *origin + *direction * t)),
            },
            PlaneCurve::Computed { knots, points } => Self {
                degree: COMPUTED,
                knots: Knots::Of(knots),
                points: Points::Plane(points),
            },
        }
    }

    fn knots(&self) -> &[f64] {
        match &self.knots {
            Knots::Of(knots) => knots,
            Knots::Line(knots) => knots,
        }
    }

    fn count(&self) -> usize {
        match self.points {
            Points::Space(points) | Points::Rational(points, _) => points.len(),
            Points::Plane(points) => points.len(),
            Points::Line(_) => 2,
        }
    }

    /// A homogeneous control point.
    fn control(&self, k: usize) -> DVec4 {
        match self.points {
            Points::Space(points) => points[k].extend(1.0),
            Points::Rational(points, weights) => (points[k] * weights[k]).extend(weights[k]),
            Points::Plane(points) => points[k].extend(0.0).extend(1.0),
            Points::Line(ends) => ends[k].extend(0.0).extend(1.0),
        }
    }

    /// Whether there are as many control points as the knots ask for, and all are numbers.
    pub(super) fn is_sound(&self) -> bool {
        let (knots, count) = (self.knots(), self.count());
        let mut controls = (0..count).map(|k| self.control(k));
        count > self.degree
            && knots.len() == count + self.degree + 1
            && knots.windows(2).all(|pair| pair[0] <= pair[1])
            && controls.all(|h| h.is_finite() && h.w > 0.0)
    }

    /// The span that holds a parameter: the last knot not above it that is below the last one of all.
    fn span(&self, t: f64) -> usize {
        let inner = &self.knots()[self.degree + 1..self.count()];
        self.degree + inner.partition_point(|knot| *knot <= t)
    }

    /// The point at a parameter.
    pub(super) fn point(&self, t: f64) -> DVec3 {
        let arguments = (0..self.degree).map(|_| t);
        let h = blossom::blossom(self.knots(), self.span(t), arguments, |k| self.control(k));
        h.xyz() / h.w
    }

    /// The knots within a range, and its ends.
    pub(super) fn breaks(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let mut breaks = vec![from];
        let within = |knot: &&f64| **knot > from && **knot < to;
        breaks.extend(self.knots().iter().filter(within));
        breaks.push(to);
        breaks.dedup();
        breaks
    }

    /// The control points that matter over a part of a span.
    pub(super) fn around(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = DVec4> {
        let span = self.span(0.5 * (from + to));
        (span - self.degree..=span).map(|k| self.control(k))
    }

    /// The Bézier piece over a part of a span.
    pub(super) fn piece(&self, [from, to]: [f64; 2]) -> Net {
        let span = self.span(0.5 * (from + to));
        blossom::piece(self.knots(), self.degree, span, [from, to], |k| {
            self.control(k)
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::nurbs::{Curve, KnotVector};

    fn bezier(net: &Net, t: f64) -> DVec3 {
        let mut work = net.clone();
        for round in 1..work.len() {
            for k in 0..work.len() - round {
                work[k] = work[k] * (1.0 - t) + work[k + 1] * t;
            }
        }
        work[0].xyz() / work[0].w
    }

    #[test]
    fn pieces_over_a_range_are_the_curve_there() {
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.5, 2.5, 4.0, 4.0, 4.0, 4.0];
        let points: Vec<DVec3> = (0..7)
            .map(|i| {
                let x = f64::from(i);
                DVec3::new(x, (1.7 * x).sin(), (0.9 * x).cos())
            })
            .collect();
        let weights = vec![1.0, 0.5, 2.0, 1.0, 0.8, 1.3, 1.0];
        let knots = KnotVector::new(3, knots).unwrap();
        let curve = Curve::rational(knots, points, weights).unwrap();
        let shape = CurveShape::Known(curve.clone());
        let spline = Spline::of_space(&shape);
        assert!(spline.is_sound());
        let range = [0.4, 3.1];
        let breaks = spline.breaks(range);
        assert_eq!(breaks, [0.4, 1.0, 2.5, 3.1]);
        for ends in breaks.windows(2) {
            let piece = spline.piece([ends[0], ends[1]]);
            for k in 0..=4 {
                let part = 0.25 * f64::from(k);
                let t = ends[0] + part * (ends[1] - ends[0]);
                assert!(bezier(&piece, part).distance(curve.point(t)) < 1e-13);
                assert!(spline.point(t).distance(curve.point(t)) < 1e-13);
            }
        }
    }

    #[test]
    fn a_line_is_one_piece_from_end_to_end() {
        let line = PlaneCurve::Line {
            origin: DVec2::new(1.0, 2.0),
            direction: DVec2::new(0.5, -1.0),
        };
        let spline = Spline::of_plane(&line, [2.0, 6.0]);
        assert_eq!(spline.breaks([2.0, 6.0]), [2.0, 6.0]);
        let piece = spline.piece([2.0, 6.0]);
        assert_eq!(piece[0].xyz(), DVec3::new(2.0, 0.0, 0.0));
        assert_eq!(piece[1].xyz(), DVec3::new(4.0, -4.0, 0.0));
    }
}
