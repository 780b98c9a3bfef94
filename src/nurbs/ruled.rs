//! Ruled surfaces: straight lines between two curves (PT97 §8.4).

use super::{Curve, KnotVector, Surface, SurfaceError};
use glam::DVec3;

impl Surface {
    /// The surface of straight lines between two sides of a quadrilateral, given by its corners at (0, 0), (0, 1), (1, 0) and (1, 1).
    pub fn bilinear([a, b, c, d]: [DVec3; 4]) -> Result<Self, SurfaceError> {
        let knots = KnotVector::uniform(1, 2)?;
        Self::new(knots.clone(), knots, vec![a, b, c, d])
    }

    /// The surface of straight lines from `a(v)` at u = 0 to `b(v)` at u = 1. The lower degree is elevated and both knot
    /// vectors are refined to their union; `b` is run over the domain of `a`. Where both have the same knots, the edges'
    /// control points are those of the curves.
    pub fn ruled(a: &Curve, b: &Curve) -> Result<Self, SurfaceError> {
        let degree = a.degree().max(b.degree());
        let raise = |curve: &Curve| curve.elevate(degree - curve.degree());
        let (a, b) = (raise(a)?, raise(b)?);
        let (start, end) = a.domain();
        let b = b.over(start, end);
        let b = b.refined(&missing(b.knots(), a.knots()));
        let a = a.refined(&missing(a.knots(), b.knots()));
        let across = KnotVector::uniform(1, 2)?;
        let net = [a.points(), b.points()].concat();
        let weights = [a.weights(), b.weights()].concat();
        let rational = a.is_rational() || b.is_rational();
        Ok(Self::trusted(
            across,
            a.knots().clone(),
            net,
            weights,
            rational,
        ))
    }
}

impl Curve {
    /// The same curve with its parameters stretched linearly to another domain.
    fn over(&self, start: f64, end: f64) -> Self {
        if self.domain() == (start, end) {
            return self.clone();
        }
        let (from, to) = self.domain();
        let degree = self.degree();
        let stretched = |&knot: &f64| start + (end - start) * ((knot - from) / (to - from));
        let mut knots: Vec<f64> = self.knots().as_slice().iter().map(stretched).collect();
        let last = knots.len() - 1 - degree;
        knots[last..].fill(end);
        let knots = KnotVector::trusted(degree, knots);
        let (points, weights) = (self.points().to_vec(), self.weights().to_vec());
        Self::trusted(knots, points, weights, self.is_rational())
    }
}

/// What `own` lacks of the interior knots of `other`. A knot of `other` that cannot be told from one of `own` counts as
/// that one.
fn missing(own: &KnotVector, other: &KnotVector) -> Vec<f64> {
    let distinct = other.distinct();
    let mut missing = Vec::new();
    for &(value, wanted) in &distinct[1..distinct.len() - 1] {
        let value = own.snapped(value);
        let present = own.multiplicity(value);
        missing.extend(std::iter::repeat_n(value, wanted.saturating_sub(present)));
    }
    missing
}
