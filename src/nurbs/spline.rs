//! Curves as rational Bézier pieces, read from their knots and control points by blossoms.
//!
//! Any part of a span is a piece as well, so nothing has to be split; and nothing is stored, since most pieces are never
//! looked at closely.

use std::borrow::Cow;

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};

use super::Curve;
use super::blossom::{self, Net};

/// A B-spline curve, of whoever has its numbers.
#[derive(Clone, Debug)]
pub(crate) struct Spline<'a> {
    degree: usize,
    knots: Knots<'a>,
    points: Points<'a>,
}

#[derive(Clone, Debug)]
enum Knots<'a> {
    Of(Cow<'a, [f64]>),
    Line([f64; 4]),
}

#[derive(Clone, Debug)]
enum Points<'a> {
    Space(&'a [DVec3]),
    Rational(Cow<'a, [DVec3]>, Cow<'a, [f64]>),
    Plane(&'a [DVec2]),
    Line([DVec2; 2]),
}

impl<'a> Spline<'a> {
    /// A curve in space.
    pub(crate) fn of_curve(curve: &'a Curve) -> Self {
        Self {
            degree: curve.degree(),
            knots: Knots::Of(Cow::Borrowed(curve.knots().as_slice())),
            points: Points::Rational(
                Cow::Borrowed(curve.points()),
                Cow::Borrowed(curve.weights()),
            ),
        }
    }

    /// A curve of its own.
    pub(crate) fn from_curve(curve: &Curve) -> Spline<'static> {
        Spline {
            degree: curve.degree(),
            knots: Knots::Of(Cow::Owned(curve.knots().as_slice().to_vec())),
            points: Points::Rational(
                Cow::Owned(curve.points().to_vec()),
                Cow::Owned(curve.weights().to_vec()),
            ),
        }
    }

    /// Without weights, in space.
    pub(crate) fn of_points(degree: usize, knots: &'a [f64], points: &'a [DVec3]) -> Self {
        Self {
            degree,
            knots: Knots::Of(Cow::Borrowed(knots)),
            points: Points::Space(points),
        }
    }

    /// Without weights, in a plane; the third coordinate is zero.
    pub(crate) fn of_plane_points(degree: usize, knots: &'a [f64], points: &'a [DVec2]) -> Self {
        Self {
            degree,
            knots: Knots::Of(Cow::Borrowed(knots)),
            points: Points::Plane(points),
        }
    }

    /// A straight line in a plane between two places, with the parameters that it has there.
    pub(crate) fn of_line(range: [f64; 2], ends: [DVec2; 2]) -> Self {
        Self {
            degree: 1,
            knots: Knots::Line([range[0], range[0], range[1], range[1]]),
            points: Points::Line(ends),
        }
    }

    fn knots(&self) -> &[f64] {
        match &self.knots {
            Knots::Of(knots) => knots,
            Knots::Line(knots) => knots,
        }
    }

    fn count(&self) -> usize {
        match &self.points {
            Points::Space(points) => points.len(),
            Points::Rational(points, _) => points.len(),
            Points::Plane(points) => points.len(),
            Points::Line(_) => 2,
        }
    }

    /// A homogeneous control point.
    fn control(&self, k: usize) -> DVec4 {
        match &self.points {
            Points::Space(points) => points[k].extend(1.0),
            Points::Rational(points, weights) => (points[k] * weights[k]).extend(weights[k]),
            Points::Plane(points) => points[k].extend(0.0).extend(1.0),
            Points::Line(ends) => ends[k].extend(0.0).extend(1.0),
        }
    }

    /// Whether there are as many control points as the knots ask for, and all are numbers.
    pub(crate) fn is_sound(&self) -> bool {
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
    pub(crate) fn point(&self, t: f64) -> DVec3 {
        let arguments = (0..self.degree).map(|_| t);
        let h = blossom::blossom(self.knots(), self.span(t), arguments, |k| self.control(k));
        h.xyz() / h.w
    }

    /// The knots within a range, and its ends.
    pub(crate) fn breaks(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let mut breaks = vec![from];
        let within = |knot: &&f64| **knot > from && **knot < to;
        breaks.extend(self.knots().iter().filter(within));
        breaks.push(to);
        breaks.dedup();
        breaks
    }

    /// The control points that matter over a part of a span.
    pub(crate) fn around(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = DVec4> {
        let span = self.span(0.5 * (from + to));
        (span - self.degree..=span).map(|k| self.control(k))
    }

    /// The Bézier piece over a part of a span.
    pub(crate) fn piece(&self, [from, to]: [f64; 2]) -> Net {
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
    use crate::nurbs::KnotVector;

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
        let spline = Spline::of_curve(&curve);
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
        let ends = [DVec2::new(2.0, 0.0), DVec2::new(4.0, -4.0)];
        let spline = Spline::of_line([2.0, 6.0], ends);
        assert_eq!(spline.breaks([2.0, 6.0]), [2.0, 6.0]);
        let piece = spline.piece([2.0, 6.0]);
        assert_eq!(piece[0].xyz(), DVec3::new(2.0, 0.0, 0.0));
        assert_eq!(piece[1].xyz(), DVec3::new(4.0, -4.0, 0.0));
    }
}
