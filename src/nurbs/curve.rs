//! Rational B-spline curves (J19 Eq. 1): `C(u) = Σ N_{i,p}(u) w_i P_i / Σ N_{i,p}(u) w_i`.
//!
//! Degrees 1, 2 and 3 are the useful ones; conics need degree 2 and weights (a quarter of an ellipse: middle weight
//! √2/2). Other files of this module add refinement, elevation, splitting, reversal, bounds and closest points.

use super::KnotVector;
use super::basis;
use super::derive::curve_quotient;
use super::knots::ORDER;
use glam::{DVec3, DVec4, Vec4Swizzles};
use thiserror::Error;

/// Why control points and weights do not make a curve.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CurveError {
    /// The number of control points does not fit the knot vector.
    #[error("there are {found} control points; the knot vector belongs to {needed}")]
    PointCount {
        /// Number of control points.
        found: usize,
        /// The number that fits the knots.
        needed: usize,
    },
    /// The number of weights is not that of the control points.
    #[error("there are {found} weights for {needed} control points; give one for each")]
    WeightCount {
        /// Number of weights.
        found: usize,
        /// Number of control points.
        needed: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("control point {index} is {value}; coordinates must be finite")]
    Point {
        /// Position in the list.
        index: usize,
        /// The control point.
        value: DVec3,
    },
    /// A weight is zero, negative, infinite or not a number.
    #[error("weight {index} is {value}; weights must be positive and finite")]
    Weight {
        /// Position in the list.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// There is no control point of this number.
    #[error("there is no control point {index}; the curve has {count}, counted from 0")]
    Index {
        /// The number asked for.
        index: usize,
        /// Number of control points.
        count: usize,
    },
}

/// A rational B-spline curve; all weights are one when it is polynomial.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    knots: KnotVector,
    points: Vec<DVec3>,
    weights: Vec<f64>,
    rational: bool,
}

impl Curve {
    /// A polynomial curve: every weight is one.
    pub fn new(knots: KnotVector, points: Vec<DVec3>) -> Result<Self, CurveError> {
        let weights = vec![1.0; points.len()];
        Self::rational(knots, points, weights)
    }

    /// A curve from control points and their weights.
    pub fn rational(
        knots: KnotVector,
        points: Vec<DVec3>,
        weights: Vec<f64>,
    ) -> Result<Self, CurveError> {
        let needed = knots.count();
        if points.len() != needed {
            return Err(CurveError::PointCount {
                found: points.len(),
                needed,
            });
        }
        if weights.len() != needed {
            return Err(CurveError::WeightCount {
                found: weights.len(),
                needed,
            });
        }
        for (index, &value) in points.iter().enumerate() {
            check_point(index, value)?;
        }
        for (index, &value) in weights.iter().enumerate() {
            check_weight(index, value)?;
        }
        let rational = weights.iter().any(|&w| w != 1.0);
        Ok(Self {
            knots,
            points,
            weights,
            rational,
        })
    }

    /// From homogeneous control points whose weights are positive; trusts its caller that counts fit.
    pub(super) fn from_homogeneous(knots: KnotVector, net: &[DVec4], rational: bool) -> Self {
        debug_assert_eq!(knots.count(), net.len());
        let (points, weights) = from_homogeneous(net, rational);
        Self {
            knots,
            points,
            weights,
            rational,
        }
    }

    /// The control points as (w x, w y, w z, w).
    pub(super) fn homogeneous(&self) -> Vec<DVec4> {
        to_homogeneous(&self.points, &self.weights)
    }

    /// Trusts its caller that the numbers fit and that the weights are one unless `rational`.
    pub(super) fn trusted(
        knots: KnotVector,
        points: Vec<DVec3>,
        weights: Vec<f64>,
        rational: bool,
    ) -> Self {
        debug_assert!(knots.count() == points.len() && points.len() == weights.len());
        Self {
            knots,
            points,
            weights,
            rational,
        }
    }

    /// The same curve elsewhere.
    #[must_use]
    pub fn moved(&self, by: DVec3) -> Self {
        let mut curve = self.clone();
        for point in &mut curve.points {
            *point += by;
        }
        curve
    }

    /// The knot vector.
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// The polynomial degree.
    pub fn degree(&self) -> usize {
        self.knots.degree()
    }

    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        self.knots.domain()
    }

    /// The control points.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The weights, one for each control point.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Whether any weight differs from one.
    pub fn is_rational(&self) -> bool {
        self.rational
    }

    /// The point at u.
    pub fn point(&self, u: f64) -> DVec3 {
        let u = self.knots.clamp(u);
        let (span, degree) = (self.knots.span(u), self.degree());
        let mut values = [0.0; ORDER];
        basis::values(self.knots.as_slice(), degree, span, u, &mut values);
        let own = span - degree..=span;
        let points = &self.points[own.clone()];
        if !self.rational {
            return points
                .iter()
                .zip(&values)
                .fold(DVec3::ZERO, |sum, (&p, &n)| sum + n * p);
        }
        let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
        for ((&p, &w), &n) in points.iter().zip(&self.weights[own]).zip(&values) {
            sum += n * w * p;
            weight += n * w;
        }
        sum / weight
    }

    /// The point and its derivatives up to the given order, exact to rounding (PT97 A3.2, A4.2).
    pub fn derivatives(&self, u: f64, order: usize) -> Vec<DVec3> {
        let mut homogeneous = vec![DVec4::ZERO; order + 1];
        self.knots
            .with_basis_derivatives(u, order, |first, k, values| {
                for (j, &n) in values.iter().enumerate() {
                    let w = self.weights[first + j];
                    homogeneous[k] += n * (self.points[first + j] * w).extend(w);
                }
            });
        if self.rational {
            curve_quotient(&homogeneous)
        } else {
            homogeneous.iter().map(|h| h.xyz()).collect()
        }
    }

    /// The unit tangent, in the direction of growing parameters; where the first derivative vanishes, its limit. `None`
    /// when all derivatives vanish: the curve is a point there.
    pub fn tangent(&self, u: f64) -> Option<DVec3> {
        let derivatives = self.derivatives(u, self.degree());
        let scale = extent(&self.points);
        let (start, end) = self.domain();
        let at_end = self.knots.clamp(u) == end;
        let mut unit = end - start;
        for (k, &derivative) in derivatives.iter().enumerate().skip(1) {
            // Rounding leaves about 1e-14 of the net's size; a tangent below that is noise.
            if (derivative * unit).length() > 1e-12 * scale {
                // From the left end of the domain C' has the sign of the first derivative left, from the right it alternates.
                let sign = if at_end && k % 2 == 0 { -1.0 } else { 1.0 };
                return Some(sign * derivative.normalize());
            }
            unit *= end - start;
        }
        None
    }

    /// How the parameter of another curve follows from this one's, if both are the same to within a tolerance at
    /// parameters in proportion, as a curve and its elevated, refined or reversed copy are: shift and scale.
    pub(crate) fn proportion(&self, other: &Self, tolerance: f64) -> Option<(f64, f64)> {
        let ((a0, a1), (b0, b1)) = (self.domain(), other.domain());
        let forward = (b1 - b0) / (a1 - a0);
        let ways = [(b0 - forward * a0, forward), (b1 + forward * a0, -forward)];
        ways.into_iter().find(|(shift, scale)| {
            // Ends first: they tell most curves apart.
            let same = |t: f64| self.point(t).distance(other.point(shift + scale * t)) <= tolerance;
            if !(same(a0) && same(a1)) {
                return false;
            }
            let samples = 2 * (self.degree() + other.degree()) + 1;
            self.knots().distinct().windows(2).all(|pair| {
                let (from, to) = (pair[0].0, pair[1].0);
                (0..=samples).all(|k| same(from + (to - from) * k as f64 / samples as f64))
            })
        })
    }

    /// The same curve with control point i at p; changes it only for u in `[u_i, u_{i+p+1})`.
    pub fn with_control_point(&self, i: usize, p: DVec3) -> Result<Self, CurveError> {
        self.check_index(i)?;
        check_point(i, p)?;
        let mut changed = self.clone();
        changed.points[i] = p;
        Ok(changed)
    }

    /// The same curve with weight i at w; changes it only for u in `[u_i, u_{i+p+1})`.
    pub fn with_weight(&self, i: usize, w: f64) -> Result<Self, CurveError> {
        self.check_index(i)?;
        check_weight(i, w)?;
        let mut changed = self.clone();
        changed.weights[i] = w;
        changed.rational = changed.weights.iter().any(|&w| w != 1.0);
        Ok(changed)
    }

    fn check_index(&self, index: usize) -> Result<(), CurveError> {
        let count = self.points.len();
        if index < count {
            Ok(())
        } else {
            Err(CurveError::Index { index, count })
        }
    }
}

fn check_point(index: usize, value: DVec3) -> Result<(), CurveError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(CurveError::Point { index, value })
    }
}

fn check_weight(index: usize, value: f64) -> Result<(), CurveError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(CurveError::Weight { index, value })
    }
}

/// (w x, w y, w z, w) of each control point.
pub(super) fn to_homogeneous(points: &[DVec3], weights: &[f64]) -> Vec<DVec4> {
    points
        .iter()
        .zip(weights)
        .map(|(&p, &w)| (p * w).extend(w))
        .collect()
}

/// Control points and weights; the weights of what is polynomial stay exactly one.
pub(super) fn from_homogeneous(net: &[DVec4], rational: bool) -> (Vec<DVec3>, Vec<f64>) {
    if rational {
        net.iter().map(|h| (h.xyz() / h.w, h.w)).unzip()
    } else {
        net.iter().map(|h| (h.xyz(), 1.0)).unzip()
    }
}

/// The diagonal of the points' box: the size that tolerances are scaled with.
pub(super) fn extent(points: &[DVec3]) -> f64 {
    let low = points.iter().fold(DVec3::INFINITY, |low, &p| low.min(p));
    let high = points
        .iter()
        .fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
    if points.is_empty() {
        0.0
    } else {
        (high - low).length()
    }
}
