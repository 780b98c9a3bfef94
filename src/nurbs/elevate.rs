//! Degree elevation: a higher degree, the same shape.
//!
//! By polar forms (Prautzsch 1984, *Degree elevation of B-spline curves*): the elevated control point that belongs to
//! the knots `t_1 … t_{p+1}` is the mean of the blossom over all ways to leave one of them out. Costs more arithmetic
//! than PT97 A5.9 (Piegl & Tiller 1994, Huang 2005), which only matters for nets far larger than geology's.

use super::{Curve, ElevateError, KnotVector, MAX_DEGREE, Surface};
use glam::DVec4;

impl KnotVector {
    /// Degree and the multiplicity of every knot raised by one.
    fn elevated(&self) -> Self {
        let repeated = |(value, count): (f64, usize)| std::iter::repeat_n(value, count + 1);
        let knots = self.distinct().into_iter().flat_map(repeated).collect();
        Self::trusted(self.degree() + 1, knots)
    }
}

/// The polar form of the piece on `span` at as many arguments as the degree (PT97 has it as A5.2 without the name).
fn blossom(knots: &KnotVector, points: &[DVec4], span: usize, arguments: &[f64]) -> DVec4 {
    let p = knots.degree();
    let u = knots.as_slice();
    let mut own = points[span - p..=span].to_vec();
    for (r, &argument) in arguments.iter().enumerate() {
        for j in (r + 1..=p).rev() {
            let low = u[span - p + j];
            let high = u[span + j - r];
            own[j] = own[j - 1].lerp(own[j], (argument - low) / (high - low));
        }
    }
    own[p]
}

/// Control points of the same shape one degree higher.
fn elevated(knots: &KnotVector, points: &[DVec4], target: &KnotVector) -> Vec<DVec4> {
    let degree = target.degree();
    let mut arguments = Vec::with_capacity(degree);
    let control_point = |i: usize| {
        let own = &target.as_slice()[i + 1..=i + degree];
        // Every span between the outer arguments gives the same blossom; the middle one extrapolates least.
        let span = knots.span(0.5 * (own[0] + own[degree - 1]));
        let mut sum = DVec4::ZERO;
        for omitted in 0..degree {
            arguments.clear();
            arguments.extend_from_slice(&own[..omitted]);
            arguments.extend_from_slice(&own[omitted + 1..]);
            sum += blossom(knots, points, span, &arguments);
        }
        sum / degree as f64
    };
    let mut result: Vec<DVec4> = (0..target.count()).map(control_point).collect();
    // Clamped ends stay where they are, to the last bit.
    let last = result.len() - 1;
    result[0] = points[0];
    result[last] = points[points.len() - 1];
    result
}

fn check(degree: usize, times: usize) -> Result<(), ElevateError> {
    if times <= MAX_DEGREE && degree + times <= MAX_DEGREE {
        Ok(())
    } else {
        Err(ElevateError::Degree { degree, times })
    }
}

impl Curve {
    /// The same curve with its degree raised by `times`.
    pub fn elevate(&self, times: usize) -> Result<Self, ElevateError> {
        check(self.degree(), times)?;
        let mut curve = self.clone();
        for _ in 0..times {
            let knots = curve.knots().elevated();
            let points = elevated(curve.knots(), &curve.homogeneous(), &knots);
            curve = Self::from_homogeneous(knots, &points, self.is_rational());
        }
        Ok(curve)
    }
}

impl Surface {
    /// The same surface with its degree in u raised by `times`.
    pub fn elevate_u(&self, times: usize) -> Result<Self, ElevateError> {
        Ok(self.transposed().elevate_v(times)?.transposed())
    }

    /// The same surface with its degree in v raised by `times`.
    pub fn elevate_v(&self, times: usize) -> Result<Self, ElevateError> {
        check(self.knots_v().degree(), times)?;
        let mut surface = self.clone();
        for _ in 0..times {
            let knots = surface.knots_v().elevated();
            let source = surface.knots_v();
            surface = surface.with_rows(knots.clone(), |row| elevated(source, row, &knots));
        }
        Ok(surface)
    }
}
