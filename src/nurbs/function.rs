//! Spline functions of one parameter: a knot vector with numbers instead of control points.

use super::KnotVector;
use super::interpolate::{self, InterpolateError};
use smallvec::SmallVec;

/// Where a span between two knots is compared with what it shall follow, as fractions. Uneven, so that a wave as long
/// as the span cannot hide between them.
pub(crate) const PROBES: [f64; 5] = [0.11, 0.3, 0.52, 0.71, 0.9];

/// A polynomial spline function.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    knots: KnotVector,
    coefficients: Vec<f64>,
    /// The same, span by span, for quick values.
    pieces: Vec<Piece>,
}

/// A polynomial over a span between two distinct knots.
#[derive(Clone, Debug, PartialEq)]
struct Piece {
    start: f64,
    /// One over the span's length.
    rate: f64,
    /// Coefficients of the powers of the part of the span that lies behind.
    powers: SmallVec<[f64; 4]>,
}

impl Piece {
    fn new(knots: &KnotVector, coefficients: &[f64], start: f64, end: f64) -> Self {
        let rows = knots.basis_derivatives(start, knots.degree());
        let own = &coefficients[knots.span(start) - knots.degree()..];
        let mut factor = 1.0;
        let mut powers = SmallVec::new();
        for (k, row) in rows.iter().enumerate() {
            let derivative: f64 = own.iter().zip(row).map(|(c, n)| c * n).sum();
            powers.push(derivative * factor);
            // To the next power over the next factorial.
            factor *= (end - start) / (k + 1) as f64;
        }
        Self {
            start,
            rate: 1.0 / (end - start),
            powers,
        }
    }

    fn value(&self, t: f64) -> f64 {
        let s = (t - self.start) * self.rate;
        self.powers.iter().rev().fold(0.0, |sum, c| sum * s + c)
    }
}

impl Function {
    /// The spline function on given knots that agrees with `f` at their Greville abscissae.
    pub fn interpolated(
        knots: &KnotVector,
        f: impl Fn(f64) -> f64,
    ) -> Result<Self, InterpolateError> {
        let values = (0..knots.count()).map(|i| f(knots.greville(i))).collect();
        let mut rows = [values];
        interpolate::at_greville(knots, &mut rows)?;
        let [coefficients] = rows;
        let pieces = knots
            .distinct()
            .windows(2)
            .map(|ends| Piece::new(knots, &coefficients, ends[0].0, ends[1].0))
            .collect();
        Ok(Self {
            knots: knots.clone(),
            coefficients,
            pieces,
        })
    }

    /// The knots.
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// The coefficients, one for each basis function.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The value at t, or at the nearer end of the knots.
    pub fn value(&self, t: f64) -> f64 {
        let (start, end) = self.knots.domain();
        let t = t.clamp(start, end);
        let after = self.pieces[1..].partition_point(|piece| piece.start <= t);
        self.pieces[after].value(t)
    }

    /// The largest difference from `f` at five places of every span.
    pub fn deviation(&self, f: impl Fn(f64) -> f64) -> f64 {
        spans_probed(&self.knots).fold(0.0, |worst: f64, t| {
            let miss = (self.value(t) - f(t)).abs();
            // A value that is not a number must not hide in the maximum.
            if miss > worst || miss.is_nan() {
                miss
            } else {
                worst
            }
        })
    }
}

/// Five places in every span.
pub(crate) fn spans_probed(knots: &KnotVector) -> impl Iterator<Item = f64> {
    let distinct = knots.distinct();
    let spans: Vec<[f64; 2]> = distinct.windows(2).map(|w| [w[0].0, w[1].0]).collect();
    spans
        .into_iter()
        .flat_map(|[from, to]| PROBES.map(|part| from + (to - from) * part))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    #[test]
    fn a_spline_function_on_its_own_knots_is_reproduced() {
        // Degree 3 with a double knot: (t − 0.4)₊² is in the space, with a jump in its second derivative.
        let knots = vec![0.0, 0.0, 0.0, 0.0, 0.4, 0.4, 0.7, 1.0, 1.0, 1.0, 1.0];
        let knots = KnotVector::new(3, knots).unwrap();
        let f = |t: f64| 3.0 - t.powi(3) + 5.0 * (t - 0.4).max(0.0).powi(2);
        let spline = Function::interpolated(&knots, f).unwrap();
        assert!(spline.deviation(f) < 1e-13);
        assert_eq!(spline.value(0.0), 3.0);
        assert!(spline.deviation(|t| f(t) + 0.1 * t) > 0.08);
    }

    #[test]
    fn a_deviation_that_is_no_number_is_not_hidden() {
        let knots = KnotVector::uniform(1, 2).unwrap();
        let spline = Function::interpolated(&knots, |t| t).unwrap();
        assert!(spline.deviation(|_| f64::NAN).is_nan());
    }
}
