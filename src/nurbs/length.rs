//! Arc length, by adaptive Gauss–Legendre quadrature of the speed.

use super::Curve;
use super::bezier::Patch;
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
            .map(|(patch, _)| piece_length(patch, share))
            .sum()
    }
}

fn piece_length(patch: &Patch, tolerance: f64) -> f64 {
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
    let mut stack = vec![(0.0, 1.0, rule(0.0, 1.0), 0)];
    while let Some((start, end, whole, halvings)) = stack.pop() {
        let middle = 0.5 * (start + end);
        let (left, right) = (rule(start, middle), rule(middle, end));
        let error = (left + right - whole).abs();
        // The halves' own error is far smaller than this difference, so the sum stays below the tolerance.
        if error <= tolerance * (end - start) || error <= 1e-15 * whole || halvings >= MOST_HALVINGS
        {
            length += left + right;
        } else {
            stack.push((middle, end, right, halvings + 1));
            stack.push((start, middle, left, halvings + 1));
        }
    }
    length
}
