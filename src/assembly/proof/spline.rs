//! Curves of finished topology as rational Bézier pieces, read from their knots and control points by blossoms.
//!
//! The polynomial that a spline of degree p is on a span is determined by its blossom: the value at p arguments, of which
//! the piece's control points are those with ends of the piece as arguments. Any part of a span is a piece as well, so
//! nothing has to be split.

use glam::{DVec3, DVec4, Vec4Swizzles};
use smallvec::{SmallVec, smallvec};

use crate::partition::{CurveShape, PlaneCurve};

/// Degree of computed curves.
const COMPUTED: usize = 5;

/// Homogeneous control points.
pub(super) type Net = SmallVec<[DVec4; 6]>;

/// A B-spline curve with homogeneous control points.
pub(super) struct Spline {
    degree: usize,
    knots: Vec<f64>,
    net: Vec<DVec4>,
}

impl Spline {
    pub(super) fn of_space(shape: &CurveShape) -> Self {
        match shape {
            CurveShape::Known(curve) => Self {
                degree: curve.degree(),
                knots: curve.knots().as_slice().to_vec(),
                net: curve
                    .points()
                    .iter()
                    .zip(curve.weights())
                    .map(|(p, w)| (*p * *w).extend(*w))
                    .collect(),
            },
            CurveShape::Computed { knots, points } => Self {
                degree: COMPUTED,
                knots: knots.clone(),
                net: points.iter().map(|p| p.extend(1.0)).collect(),
            },
        }
    }

    /// In the parameters of a surface; the third coordinate is zero.
    pub(super) fn of_plane(shape: &PlaneCurve, range: [f64; 2]) -> Self {
        match shape {
            PlaneCurve::Line { origin, direction } => Self {
                degree: 1,
                knots: vec![range[0], range[0], range[1], range[1]],
                net: range
                    .map(|t| (*origin + *direction * t).extend(0.0).extend(1.0))
                    .to_vec(),
            },
            PlaneCurve::Computed { knots, points } => Self {
                degree: COMPUTED,
                knots: knots.clone(),
                net: points.iter().map(|p| p.extend(0.0).extend(1.0)).collect(),
            },
        }
    }

    /// Whether there are as many control points as the knots ask for, and all are numbers.
    pub(super) fn is_sound(&self) -> bool {
        self.net.len() > self.degree
            && self.knots.len() == self.net.len() + self.degree + 1
            && self.knots.windows(2).all(|pair| pair[0] <= pair[1])
            && self.net.iter().all(|h| h.is_finite() && h.w > 0.0)
    }

    /// The span that holds a parameter: the last knot not above it that is below the last one of all.
    fn span(&self, t: f64) -> usize {
        let inner = &self.knots[self.degree + 1..self.net.len()];
        self.degree + inner.partition_point(|knot| *knot <= t)
    }

    /// The blossom of a span's polynomial (de Boor's algorithm with an argument of its own in each round).
    fn blossom(&self, span: usize, arguments: &[f64]) -> DVec4 {
        let p = self.degree;
        let mut work: Net = SmallVec::from_slice(&self.net[span - p..=span]);
        for (round, t) in arguments.iter().enumerate() {
            for k in 0..p - round {
                let low = self.knots[span - p + 1 + round + k];
                let high = self.knots[span + 1 + k];
                let part = (t - low) / (high - low);
                work[k] = work[k] * (1.0 - part) + work[k + 1] * part;
            }
        }
        work[0]
    }

    /// The point at a parameter.
    pub(super) fn point(&self, t: f64) -> DVec3 {
        let arguments: SmallVec<[f64; 8]> = smallvec![t; self.degree];
        let h = self.blossom(self.span(t), &arguments);
        h.xyz() / h.w
    }

    /// The knots within a range, and its ends.
    pub(super) fn breaks(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let mut breaks = vec![from];
        let within = |knot: &&f64| **knot > from && **knot < to;
        breaks.extend(self.knots.iter().filter(within));
        breaks.push(to);
        breaks.dedup();
        breaks
    }

    /// The Bézier pieces over a range.
    pub(super) fn pieces(&self, range: [f64; 2]) -> impl Iterator<Item = Net> {
        let breaks = self.breaks(range);
        (1..breaks.len()).map(move |k| {
            let (from, to) = (breaks[k - 1], breaks[k]);
            let span = self.span(0.5 * (from + to));
            let control = |i: usize| {
                let arguments: SmallVec<[f64; 8]> = (0..self.degree)
                    .map(|k| if k < self.degree - i { from } else { to })
                    .collect();
                self.blossom(span, &arguments)
            };
            (0..=self.degree).map(control).collect()
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use glam::DVec2;

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
        let spline = Spline::of_space(&CurveShape::Known(curve.clone()));
        assert!(spline.is_sound());
        let range = [0.4, 3.1];
        let breaks = spline.breaks(range);
        assert_eq!(breaks, [0.4, 1.0, 2.5, 3.1]);
        for (piece, ends) in spline.pieces(range).zip(breaks.windows(2)) {
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
        let pieces: Vec<Net> = spline.pieces([2.0, 6.0]).collect();
        assert_eq!(pieces.len(), 1);
        assert_eq!(pieces[0][0].xyz(), DVec3::new(2.0, 0.0, 0.0));
        assert_eq!(pieces[0][1].xyz(), DVec3::new(4.0, -4.0, 0.0));
    }
}
