//! Surfaces that go on beyond their ends, straight along their own tangents.

use glam::DVec4;
use thiserror::Error;

use super::{KnotError, KnotVector, Surface};

/// Why a surface cannot go on.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ExtendError {
    /// A length is none.
    #[error("a surface cannot go on by {0}; give 0 or more")]
    Length(f64),
    /// A weight would not stay positive.
    #[error(
        "a rational surface that goes on straight by {0} would run out of weight: its weights fall too fast towards that end"
    )]
    Weight(f64),
    /// The longer knot vector is none.
    #[error(transparent)]
    Knots(#[from] KnotError),
}

impl Surface {
    /// The surface with straight pieces of v before and after it, along its own tangents. The surface as it was is a part of it,
    /// control points and all: its ends become knots of multiplicity q. Of a rational surface the weight goes on linearly, too.
    pub fn extended_v(&self, [before, after]: [f64; 2]) -> Result<Self, ExtendError> {
        for length in [before, after] {
            if !(length >= 0.0 && length.is_finite()) {
                return Err(ExtendError::Length(length));
            }
        }
        let knots = self.knots_v();
        let (q, count) = (knots.degree(), knots.count());
        let old = knots.as_slice();
        let (start, end) = knots.domain();
        let mut along = old[1..old.len() - 1].to_vec();
        let net = self.homogeneous();
        let mut rows: Vec<Vec<DVec4>> = net.chunks(count).map(<[DVec4]>::to_vec).collect();
        // The speed at a clamped end is q times the first leg over the knot span.
        if before > 0.0 {
            let step = before / (old[q + 1] - old[q]);
            for row in &mut rows {
                let (first, leg) = (row[0], row[0] - row[1]);
                let beyond = (1..=q).rev().map(|k| first + leg * (step * k as f64));
                *row = beyond.chain(row.iter().copied()).collect();
            }
            along.splice(0..0, vec![start - before; q + 1]);
        } else {
            along.insert(0, start);
        }
        if after > 0.0 {
            let step = after / (old[count] - old[count - 1]);
            for row in &mut rows {
                let n = row.len();
                let (last, leg) = (row[n - 1], row[n - 1] - row[n - 2]);
                row.extend((1..=q).map(|k| last + leg * (step * k as f64)));
            }
            along.extend(vec![end + after; q + 1]);
        } else {
            along.push(end);
        }
        if rows.iter().flatten().any(|h| !(h.w > 0.0)) {
            return Err(ExtendError::Weight(before.max(after)));
        }
        let along = KnotVector::new(q, along)?;
        let (u, rational) = (self.knots_u().clone(), self.is_rational());
        Ok(Self::from_homogeneous(u, along, &rows.concat(), rational))
    }

    /// The same along u.
    pub fn extended_u(&self, lengths: [f64; 2]) -> Result<Self, ExtendError> {
        Ok(self.transposed().extended_v(lengths)?.transposed())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use glam::DVec3;

    use super::*;

    #[test]
    fn a_surface_goes_on_along_its_tangents_and_is_itself_between() {
        let (u, v) = (
            KnotVector::uniform(2, 4).unwrap(),
            KnotVector::uniform(3, 5).unwrap(),
        );
        let mut net = Vec::new();
        let mut weights = Vec::new();
        for i in 0..4 {
            for j in 0..5 {
                let (x, y) = (f64::from(i), f64::from(j));
                net.push(DVec3::new(x, y + 0.1 * x, (x + 2.0 * y).sin()));
                weights.push(1.0 + 0.2 * (x * y).cos());
            }
        }
        let surface = Surface::rational(u, v, net, weights).unwrap();
        let longer = surface.extended_v([0.25, 0.5]).unwrap();
        let longer = longer.extended_u([0.0, 0.3]).unwrap();
        assert_eq!(longer.knots_v().domain(), (-0.25, 1.5));
        assert_eq!(longer.knots_u().domain(), (0.0, 1.3));
        for k in 0..30 {
            let (a, b) = (f64::from(k) / 30.0, f64::from(k * 7 % 30) / 30.0);
            assert!(surface.point(a, b).distance(longer.point(a, b)) < 1e-13);
            // Beyond an end a line: the direction there is that of the tangent at the end.
            let [before, at] = [-0.2, 0.0].map(|v| longer.derivatives(a, v, 1)[0][1].normalize());
            assert!(before.distance(at) < 1e-12);
            let tangent = surface.derivatives(a, 0.0, 1)[0][1].normalize();
            assert!(tangent.distance(at) < 1e-12);
        }
        assert!(surface.extended_v([-1.0, 0.0]).is_err());
        let steep = Surface::rational(
            KnotVector::uniform(1, 2).unwrap(),
            KnotVector::uniform(1, 2).unwrap(),
            vec![DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::X + DVec3::Y],
            vec![1.0, 3.0, 1.0, 3.0],
        );
        let refused = steep.unwrap().extended_v([1.0, 0.0]);
        assert!(matches!(refused, Err(ExtendError::Weight(_))));
    }
}
