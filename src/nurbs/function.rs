//! Spline functions of one parameter: a knot vector with numbers instead of control points.

use super::KnotVector;
use super::interpolate::{self, InterpolateError};

/// Where a span between two knots is compared with what it shall follow, as fractions. Uneven, so that a wave as long
/// as the span cannot hide between them.
const PROBES: [f64; 5] = [0.11, 0.3, 0.52, 0.71, 0.9];

/// A polynomial spline function.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    knots: KnotVector,
    coefficients: Vec<f64>,
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
        Ok(Self {
            knots: knots.clone(),
            coefficients,
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

    /// The value at t.
    pub fn value(&self, t: f64) -> f64 {
        let basis = self.knots.basis(t);
        let own = &self.coefficients[basis.first()..];
        own.iter().zip(basis.values()).map(|(c, n)| c * n).sum()
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
