//! Rational B-spline surfaces (J19 Eq. 3–6): tensor products of two knot vectors over one net of control points.
//!
//! The net is u-major: the control point i in u and j in v is entry `i * nv + j`. Degrees may differ between u and v.

use super::curve::{extent, from_homogeneous, to_homogeneous};
use super::derive::surface_quotient;
use super::knots::ORDER;
use super::{Basis, Curve, ElevateError, KnotError, KnotVector};
use glam::{DVec3, DVec4, Vec4Swizzles};
use thiserror::Error;

/// Why control points and weights do not make a surface.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SurfaceError {
    /// The number of control points does not fit the knot vectors.
    #[error("there are {found} control points; the knot vectors belong to {u} × {v}")]
    PointCount {
        /// Number of control points.
        found: usize,
        /// Number of control points in u.
        u: usize,
        /// Number of control points in v.
        v: usize,
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
    #[error("control point ({i}, {j}) is {value}; coordinates must be finite")]
    Point {
        /// Position in u.
        i: usize,
        /// Position in v.
        j: usize,
        /// The control point.
        value: DVec3,
    },
    /// A weight is zero, negative, infinite or not a number.
    #[error("weight ({i}, {j}) is {value}; weights must be positive and finite")]
    Weight {
        /// Position in u.
        i: usize,
        /// Position in v.
        j: usize,
        /// The weight.
        value: f64,
    },
    /// There is no control point of this number.
    #[error("there is no control point ({i}, {j}); the net has {u} × {v}, counted from 0")]
    Index {
        /// Position in u that was asked for.
        i: usize,
        /// Position in v that was asked for.
        j: usize,
        /// Number of control points in u.
        u: usize,
        /// Number of control points in v.
        v: usize,
    },
    /// A knot vector cannot be made.
    #[error("the knot vector of the surface is invalid")]
    Knots(#[from] KnotError),
    /// Two curves cannot be brought to one degree.
    #[error("the curves' degrees cannot be made equal")]
    Elevate(#[from] ElevateError),
}

/// A rational B-spline surface; all weights are one when it is polynomial.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    u: KnotVector,
    v: KnotVector,
    net: Vec<DVec3>,
    weights: Vec<f64>,
    rational: bool,
}

impl Surface {
    /// A polynomial surface: every weight is one.
    pub fn new(u: KnotVector, v: KnotVector, net: Vec<DVec3>) -> Result<Self, SurfaceError> {
        let weights = vec![1.0; net.len()];
        Self::rational(u, v, net, weights)
    }

    /// A surface from control points and their weights, both u-major.
    pub fn rational(
        u: KnotVector,
        v: KnotVector,
        net: Vec<DVec3>,
        weights: Vec<f64>,
    ) -> Result<Self, SurfaceError> {
        let (nu, nv) = (u.count(), v.count());
        if net.len() != nu * nv {
            return Err(SurfaceError::PointCount {
                found: net.len(),
                u: nu,
                v: nv,
            });
        }
        if weights.len() != net.len() {
            return Err(SurfaceError::WeightCount {
                found: weights.len(),
                needed: net.len(),
            });
        }
        for (k, (&point, &weight)) in net.iter().zip(&weights).enumerate() {
            check_point(k / nv, k % nv, point)?;
            check_weight(k / nv, k % nv, weight)?;
        }
        let rational = weights.iter().any(|&w| w != 1.0);
        Ok(Self {
            u,
            v,
            net,
            weights,
            rational,
        })
    }

    /// Trusts its caller that the numbers fit and that the weights are positive, and one unless `rational`.
    pub(super) fn trusted(
        u: KnotVector,
        v: KnotVector,
        net: Vec<DVec3>,
        weights: Vec<f64>,
        rational: bool,
    ) -> Self {
        debug_assert_eq!(net.len(), u.count() * v.count());
        debug_assert_eq!(net.len(), weights.len());
        Self {
            u,
            v,
            net,
            weights,
            rational,
        }
    }

    /// From homogeneous control points whose weights are positive; trusts its caller that counts fit.
    pub(super) fn from_homogeneous(
        u: KnotVector,
        v: KnotVector,
        net: &[DVec4],
        rational: bool,
    ) -> Self {
        let (net, weights) = from_homogeneous(net, rational);
        Self::trusted(u, v, net, weights, rational)
    }

    /// The control points as (w x, w y, w z, w).
    pub(super) fn homogeneous(&self) -> Vec<DVec4> {
        to_homogeneous(&self.net, &self.weights)
    }

    /// The same surface elsewhere.
    #[must_use]
    pub fn moved(&self, by: DVec3) -> Self {
        let mut surface = self.clone();
        for point in &mut surface.net {
            *point += by;
        }
        surface
    }

    /// The same surface with every control point at another place: exactly what an affine map makes of it.
    pub fn mapped(&self, map: impl Fn(&DVec3) -> DVec3) -> Result<Self, SurfaceError> {
        let net = self.net.iter().map(map).collect();
        let (u, v) = (self.u.clone(), self.v.clone());
        if self.is_rational() {
            Self::rational(u, v, net, self.weights.clone())
        } else {
            Self::new(u, v, net)
        }
    }

    /// The knot vector in u.
    pub fn knots_u(&self) -> &KnotVector {
        &self.u
    }

    /// The knot vector in v.
    pub fn knots_v(&self) -> &KnotVector {
        &self.v
    }

    /// The control points, u-major.
    pub fn net(&self) -> &[DVec3] {
        &self.net
    }

    /// The weights, u-major.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Whether any weight differs from one.
    pub fn is_rational(&self) -> bool {
        self.rational
    }

    /// The control point i in u and j in v.
    pub fn control_point(&self, i: usize, j: usize) -> Result<DVec3, SurfaceError> {
        Ok(self.net[self.index(i, j)?])
    }

    /// The point at (u, v).
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.point_by(&self.u.basis(u), &self.v.basis(v))
    }

    /// The point where these are the basis functions of the knots in u and in v: of many points in rows and columns, those of
    /// each row and column are needed once.
    pub fn point_by(&self, in_u: &Basis, in_v: &Basis) -> DVec3 {
        let (first, nv) = (in_u.first() * self.v.count() + in_v.first(), self.v.count());
        if !self.rational {
            // With the usual number of functions as a constant nothing is looped over.
            return match (in_u.usual(), in_v.usual()) {
                (Some(u), Some(v)) => polynomial(&self.net[first..], nv, u, v),
                _ => polynomial(&self.net[first..], nv, in_u.values(), in_v.values()),
            };
        }
        let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
        for (i, &n) in in_u.values().iter().enumerate() {
            let own = first + i * nv..;
            let (points, weights) = (&self.net[own.clone()], &self.weights[own]);
            let (mut row, mut row_weight) = (DVec3::ZERO, 0.0);
            for ((&point, &w), &m) in points.iter().zip(weights).zip(in_v.values()) {
                row += m * w * point;
                row_weight += m * w;
            }
            weight += n * row_weight;
            sum += n * row;
        }
        sum / weight
    }

    /// The point and its derivatives, exact to rounding (PT97 A3.6, A4.4): entry `[k][l]`, `k + l ≤ order`, is the
    /// derivative k times in u and l times in v.
    pub fn derivatives(&self, u: f64, v: f64, order: usize) -> Vec<Vec<DVec3>> {
        let nv = self.v.count();
        let mut homogeneous: Vec<Vec<DVec4>> = (0..=order)
            .map(|k| vec![DVec4::ZERO; order - k + 1])
            .collect();
        let mut rows = [DVec4::ZERO; ORDER];
        self.v.with_basis_derivatives(v, order, |first_v, l, in_v| {
            let first_u = self.u.span(self.u.clamp(u)) - self.u.degree();
            for (i, row) in rows[..=self.u.degree()].iter_mut().enumerate() {
                let first = (first_u + i) * nv + first_v;
                *row = DVec4::ZERO;
                for (j, &n) in in_v.iter().enumerate() {
                    let w = self.weights[first + j];
                    *row += n * (self.net[first + j] * w).extend(w);
                }
            }
            self.u.with_basis_derivatives(u, order - l, |_, k, in_u| {
                for (&n, &row) in in_u.iter().zip(&rows) {
                    homogeneous[k][l] += n * row;
                }
            });
        });
        if self.rational {
            surface_quotient(&homogeneous)
        } else {
            homogeneous
                .iter()
                .map(|row| row.iter().map(|h| h.xyz()).collect())
                .collect()
        }
    }

    /// The unit normal `S_u × S_v`; where an edge of the net has shrunk to a point (the pole of a sphere), its limit from
    /// inside. `None` where the surface has no tangent plane that first and mixed derivatives can tell.
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        let derivatives = self.derivatives(u, v, 2);
        let (start_u, end_u) = self.u.domain();
        let (start_v, end_v) = self.v.domain();
        let (unit_u, unit_v) = (end_u - start_u, end_v - start_v);
        let mut along_u = derivatives[1][0] * unit_u;
        let mut along_v = derivatives[0][1] * unit_v;
        let mixed = derivatives[1][1] * (unit_u * unit_v);
        // Rounding leaves about 1e-14 of the net's size; a derivative below that is noise.
        let least = 1e-12 * extent(&self.net);
        if along_u.length() <= least {
            along_u = if self.v.clamp(v) == end_v {
                -mixed
            } else {
                mixed
            };
        } else if along_v.length() <= least {
            along_v = if self.u.clamp(u) == end_u {
                -mixed
            } else {
                mixed
            };
        }
        let product = along_u.cross(along_v);
        let flat = 1e-12 * along_u.length() * along_v.length();
        if product.length() > flat.max(least * least) {
            Some(product.normalize())
        } else {
            None
        }
    }

    /// The curve that runs in v at fixed u.
    pub fn isocurve_u(&self, u: f64) -> Curve {
        let (nv, u) = (self.v.count(), self.u.clamp(u));
        let (start, end) = self.u.domain();
        // The edges are copied, not computed, so that neighbours share them to the last bit.
        for (at, row) in [(start, 0), (end, self.u.count() - 1)] {
            if u == at {
                let own = row * nv..(row + 1) * nv;
                return self.edge(&self.v, own);
            }
        }
        let basis = self.u.basis(u);
        let mut points = vec![DVec4::ZERO; nv];
        for (i, &n) in basis.values().iter().enumerate() {
            for (j, point) in points.iter_mut().enumerate() {
                let k = (basis.first() + i) * nv + j;
                *point += n * (self.net[k] * self.weights[k]).extend(self.weights[k]);
            }
        }
        Curve::from_homogeneous(self.v.clone(), &points, self.rational)
    }

    /// The curve that runs in u at fixed v.
    pub fn isocurve_v(&self, v: f64) -> Curve {
        let (nv, v) = (self.v.count(), self.v.clamp(v));
        let (start, end) = self.v.domain();
        for (at, column) in [(start, 0), (end, nv - 1)] {
            if v == at {
                return self.edge(&self.u, (0..self.u.count()).map(|i| i * nv + column));
            }
        }
        let basis = self.v.basis(v);
        let mut points = vec![DVec4::ZERO; self.u.count()];
        for (i, point) in points.iter_mut().enumerate() {
            for (j, &n) in basis.values().iter().enumerate() {
                let k = i * nv + basis.first() + j;
                *point += n * (self.net[k] * self.weights[k]).extend(self.weights[k]);
            }
        }
        Curve::from_homogeneous(self.u.clone(), &points, self.rational)
    }

    fn edge(&self, knots: &KnotVector, entries: impl Iterator<Item = usize>) -> Curve {
        let (points, weights): (Vec<_>, Vec<_>) =
            entries.map(|k| (self.net[k], self.weights[k])).unzip();
        let rational = weights.iter().any(|&w| w != 1.0);
        Curve::trusted(knots.clone(), points, weights, rational)
    }

    /// The same surface with control point (i, j) at p; changes it only for u in `[u_i, u_{i+p+1})` and v in
    /// `[v_j, v_{j+q+1})`.
    pub fn with_control_point(&self, i: usize, j: usize, p: DVec3) -> Result<Self, SurfaceError> {
        let index = self.index(i, j)?;
        check_point(i, j, p)?;
        let mut changed = self.clone();
        changed.net[index] = p;
        Ok(changed)
    }

    /// The same surface with weight (i, j) at w; changes it only for u in `[u_i, u_{i+p+1})` and v in
    /// `[v_j, v_{j+q+1})`.
    pub fn with_weight(&self, i: usize, j: usize, w: f64) -> Result<Self, SurfaceError> {
        let index = self.index(i, j)?;
        check_weight(i, j, w)?;
        let mut changed = self.clone();
        changed.weights[index] = w;
        changed.rational = changed.weights.iter().any(|&w| w != 1.0);
        Ok(changed)
    }

    fn index(&self, i: usize, j: usize) -> Result<usize, SurfaceError> {
        let (u, v) = (self.u.count(), self.v.count());
        if i < u && j < v {
            Ok(i * v + j)
        } else {
            Err(SurfaceError::Index { i, j, u, v })
        }
    }
}

/// The sum of basis functions in u and v times control points, of which rows begin `row` apart.
#[inline]
fn polynomial<U, V>(net: &[DVec3], row: usize, in_u: &U, in_v: &V) -> DVec3
where
    U: AsRef<[f64]> + ?Sized,
    V: AsRef<[f64]> + ?Sized,
{
    let mut sum = DVec3::ZERO;
    for (i, &n) in in_u.as_ref().iter().enumerate() {
        let points = &net[i * row..][..in_v.as_ref().len()];
        let mut own = DVec3::ZERO;
        for (&point, &m) in points.iter().zip(in_v.as_ref()) {
            own += m * point;
        }
        sum += n * own;
    }
    sum
}

fn check_point(i: usize, j: usize, value: DVec3) -> Result<(), SurfaceError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(SurfaceError::Point { i, j, value })
    }
}

fn check_weight(i: usize, j: usize, value: f64) -> Result<(), SurfaceError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(SurfaceError::Weight { i, j, value })
    }
}
