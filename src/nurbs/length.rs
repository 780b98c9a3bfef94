//! Arc length, by adaptive Gauss–Legendre quadrature of the speed; and the way back, from a length to its parameter.

use super::Curve;
use super::bezier::{Patch, Region};
use super::quadrature::EIGHT;

/// Halvings after which a piece is too short to matter, even next to a cusp.
const MOST_HALVINGS: usize = 50;

impl Curve {
    /// The length of the curve, to within the tolerance (at least rounding).
    pub fn length(&self, tolerance: f64) -> f64 {
        let pieces = Patch::of_curve(self);
        let share = tolerance / pieces.len() as f64;
        pieces
            .iter()
            .map(|(patch, _)| piece_length(patch, [0.0, 1.0], share))
            .sum()
    }
}

/// Lengths along a curve, of which any part may be asked for.
#[derive(Clone, Debug)]
pub struct ArcLength {
    pieces: Vec<(Patch, Region)>,
    /// Lengths of this curve cannot be told apart below this.
    rounding: f64,
}

/// Rounding of sums of speeds, as a fraction of what is summed: asked for more, halving would go on for ever.
const ROUNDING: f64 = 1e-14;

/// Steps of Newton's method, each of which at least halves the bracket.
const MOST_STEPS: usize = 100;

impl ArcLength {
    /// Of a curve.
    pub fn new(curve: &Curve) -> Self {
        let points = curve.points();
        let polygon: f64 = points.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
        let reach = points
            .iter()
            .map(|p| p.abs().max_element())
            .fold(0.0, f64::max);
        Self {
            pieces: Patch::of_curve(curve),
            rounding: ROUNDING * (polygon + reach),
        }
    }

    /// The length from one parameter to a later one, to within the tolerance (at least rounding).
    pub fn between(&self, from: f64, to: f64, tolerance: f64) -> f64 {
        let share = (tolerance / self.pieces.len() as f64).max(self.rounding);
        let within = |(patch, region): &(Patch, Region)| {
            let [start, end] = region.u;
            let (low, high) = (from.max(start), to.min(end));
            if !(low < high) {
                return 0.0;
            }
            let local = |u: f64| (u - start) / (end - start);
            piece_length(patch, [local(low), local(high)], share)
        };
        self.pieces.iter().map(within).sum()
    }

    /// The speed at a parameter.
    fn speed(&self, u: f64) -> f64 {
        let last = self.pieces.len() - 1;
        let at = self.pieces.partition_point(|(_, region)| region.u[1] < u);
        let (patch, region) = &self.pieces[at.min(last)];
        let (length, _) = region.lengths();
        patch.jet((u - region.u[0]) / length, 0.0).du.length() / length
    }

    /// The parameter between two others at which the curve from the first one on is so long, to within the tolerance.
    pub fn parameter(&self, [from, to]: [f64; 2], length: f64, tolerance: f64) -> f64 {
        let (mut low, mut high) = (from, to);
        let mut u = from;
        // The length up to `u`, of which only the part since the last step is computed anew.
        let mut reached = 0.0;
        for _ in 0..MOST_STEPS {
            let missing = length - reached;
            if missing.abs() <= tolerance
                || !(high - low > f64::EPSILON * high.abs().max(low.abs()))
            {
                break;
            }
            if missing > 0.0 {
                low = u;
            } else {
                high = u;
            }
            let speed = self.speed(u);
            let next = u + missing / speed;
            let next = if next > low && next < high {
                next
            } else {
                f64::midpoint(low, high)
            };
            let part = 1e-3 * tolerance;
            reached += if next > u {
                self.between(u, next, part)
            } else {
                -self.between(next, u, part)
            };
            u = next;
        }
        u
    }
}

/// The length of a part of a piece, given by its own parameters.
fn piece_length(patch: &Patch, [from, to]: [f64; 2], tolerance: f64) -> f64 {
    let rule = |start: f64, end: f64| -> f64 {
        let speed = |x: f64| patch.jet(start + (end - start) * x, 0.0).du.length();
        let sum: f64 = EIGHT
            .iter()
            .map(|&(x, w)| (0.5 - 0.5 * x, 0.5 * w))
            .map(|(x, w)| w * (speed(x) + speed(1.0 - x)))
            .sum();
        sum * (end - start)
    };
    let mut length = 0.0;
    let mut stack = vec![(from, to, rule(from, to), 0)];
    while let Some((start, end, whole, halvings)) = stack.pop() {
        let middle = 0.5 * (start + end);
        let (left, right) = (rule(start, middle), rule(middle, end));
        let error = (left + right - whole).abs();
        // The halves' own error is far smaller than this difference, so the sum stays below the tolerance.
        if error <= tolerance * (end - start) / (to - from)
            || error <= 1e-15 * whole
            || halvings >= MOST_HALVINGS
        {
            length += left + right;
        } else {
            stack.push((middle, end, right, halvings + 1));
            stack.push((start, middle, left, halvings + 1));
        }
    }
    length
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;
    use glam::DVec3;

    #[test]
    fn on_a_quarter_circle_lengths_are_angles_whatever_the_parameter_is() {
        let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]).unwrap();
        let points = vec![DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
        let weights = vec![1.0, 0.5_f64.sqrt(), 1.0];
        let circle = Curve::rational(knots, points, weights).unwrap();
        let lengths = ArcLength::new(&circle);
        for k in 0..=20 {
            let angle = f64::from(k) / 20.0 * std::f64::consts::FRAC_PI_2;
            let u = lengths.parameter([0.0, 1.0], angle, 1e-12);
            let point = circle.point(u);
            assert!((point.y.atan2(point.x) - angle).abs() < 1e-11);
            assert!((lengths.between(0.0, u, 1e-13) - angle).abs() < 1e-11);
        }
    }

    #[test]
    fn parts_of_a_spline_add_up_to_the_whole_and_ends_are_met_exactly() {
        let knots = KnotVector::uniform(3, 7).unwrap();
        let points =
            (0..7).map(|k| DVec3::new(f64::from(k), f64::from(k * k % 5), 0.3 * f64::from(k % 3)));
        let curve = Curve::new(knots, points.collect()).unwrap();
        let (lengths, whole) = (ArcLength::new(&curve), curve.length(1e-12));
        let (a, b) = curve.domain();
        let cuts = [
            a,
            a + 0.17 * (b - a),
            a + 0.5 * (b - a),
            a + 0.93 * (b - a),
            b,
        ];
        let sum: f64 = cuts
            .windows(2)
            .map(|c| lengths.between(c[0], c[1], 1e-12))
            .sum();
        assert!((sum - whole).abs() < 1e-11);
        assert_eq!(lengths.parameter([a, b], 0.0, 1e-9), a);
        assert!((lengths.parameter([a, b], whole, 1e-11) - b).abs() < 1e-10);
    }
}
