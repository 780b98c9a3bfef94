//! Points and derivatives of patches, with the usual orders as constants.

use glam::{DVec3, DVec4, Vec4Swizzles};

use super::{Along, ORDER, Patch, place};
use crate::partition::bernstein;

/// A point of a surface with its first and second derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::partition) struct Jet {
    pub(in crate::partition) p: DVec3,
    pub(in crate::partition) u: DVec3,
    pub(in crate::partition) v: DVec3,
    pub(in crate::partition) uu: DVec3,
    pub(in crate::partition) uv: DVec3,
    pub(in crate::partition) vv: DVec3,
}

impl Jet {
    /// The normal `S_u × S_v`, not of unit length.
    pub(in crate::partition) fn normal(&self) -> DVec3 {
        self.u.cross(self.v)
    }
}

/// A call with the orders of a patch as constants, where they are usual ones.
macro_rules! by_orders {
    ($patch:ident.$function:ident($($argument:expr),*)) => {
        match ($patch.rows, $patch.columns) {
            (2, 2) => $patch.$function::<2, 2>($($argument),*),
            (2, 4) => $patch.$function::<2, 4>($($argument),*),
            (4, 2) => $patch.$function::<4, 2>($($argument),*),
            (4, 4) => $patch.$function::<4, 4>($($argument),*),
            _ => $patch.$function::<ORDER, ORDER>($($argument),*),
        }
    };
}

impl Patch {
    /// Point and derivatives in the surface's parameters.
    pub(in crate::partition) fn jet(&self, u: f64, v: f64) -> Jet {
        by_orders!(self.jet_of(u, v))
    }

    /// Point and first derivatives only.
    pub(in crate::partition) fn first_jet(&self, u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
        by_orders!(self.first_jet_of(u, v))
    }

    /// The point only.
    pub(in crate::partition) fn point(&self, u: f64, v: f64) -> DVec3 {
        by_orders!(self.point_of(u, v))
    }

    /// The orders: constants unless `R` and `C` are only the most.
    const fn orders<const R: usize, const C: usize>(&self) -> [usize; 2] {
        if R == ORDER {
            [self.rows, self.columns]
        } else {
            [R, C]
        }
    }

    /// Parameters as fractions of the patch's, and what one unit of the surface's parameters is in them.
    fn local(&self, u: f64, v: f64) -> ([f64; 2], [f64; 2]) {
        let (du, dv) = (1.0 / (self.u[1] - self.u[0]), 1.0 / (self.v[1] - self.v[0]));
        ([(u - self.u[0]) * du, (v - self.v[0]) * dv], [du, dv])
    }

    fn jet_of<const R: usize, const C: usize>(&self, u: f64, v: f64) -> Jet {
        let [rows, columns] = self.orders::<R, C>();
        let ([s, t], [du, dv]) = self.local(u, v);
        let in_u = bernstein::second::<R>(rows, s);
        let in_v = bernstein::second::<C>(columns, t);
        let mut h = [DVec4::ZERO; 6];
        for (i, row) in self.net.chunks_exact(columns).take(rows).enumerate() {
            let mut own = [DVec4::ZERO; 3];
            for (j, point) in row.iter().enumerate() {
                own[0] += in_v[0][j] * *point;
                own[1] += in_v[1][j] * *point;
                own[2] += in_v[2][j] * *point;
            }
            h[0] += in_u[0][i] * own[0];
            h[1] += in_u[1][i] * own[0];
            h[2] += in_u[0][i] * own[1];
            h[3] += in_u[2][i] * own[0];
            h[4] += in_u[1][i] * own[1];
            h[5] += in_u[0][i] * own[2];
        }
        let mut jet = Jet {
            p: h[0].xyz(),
            u: h[1].xyz(),
            v: h[2].xyz(),
            uu: h[3].xyz(),
            uv: h[4].xyz(),
            vv: h[5].xyz(),
        };
        if self.rational {
            // The quotient rule (PT97 A4.4).
            let w = 1.0 / h[0].w;
            jet.p *= w;
            jet.u = (jet.u - h[1].w * jet.p) * w;
            jet.v = (jet.v - h[2].w * jet.p) * w;
            jet.uu = (jet.uu - 2.0 * h[1].w * jet.u - h[3].w * jet.p) * w;
            jet.uv = (jet.uv - h[1].w * jet.v - h[2].w * jet.u - h[4].w * jet.p) * w;
            jet.vv = (jet.vv - 2.0 * h[2].w * jet.v - h[5].w * jet.p) * w;
        }
        jet.u *= du;
        jet.v *= dv;
        jet.uu *= du * du;
        jet.uv *= du * dv;
        jet.vv *= dv * dv;
        jet
    }

    fn first_jet_of<const R: usize, const C: usize>(
        &self,
        u: f64,
        v: f64,
    ) -> (DVec3, DVec3, DVec3) {
        let [rows, columns] = self.orders::<R, C>();
        let ([s, t], [du, dv]) = self.local(u, v);
        let in_u = bernstein::first::<R>(rows, s);
        let in_v = bernstein::first::<C>(columns, t);
        let mut h = [DVec4::ZERO; 3];
        for (i, row) in self.net.chunks_exact(columns).take(rows).enumerate() {
            let mut own = [DVec4::ZERO; 2];
            for (j, point) in row.iter().enumerate() {
                own[0] += in_v[0][j] * *point;
                own[1] += in_v[1][j] * *point;
            }
            h[0] += in_u[0][i] * own[0];
            h[1] += in_u[1][i] * own[0];
            h[2] += in_u[0][i] * own[1];
        }
        let (p, pu, pv) = places(h, self.rational);
        (p, pu * du, pv * dv)
    }

    fn point_of<const R: usize, const C: usize>(&self, u: f64, v: f64) -> DVec3 {
        let [rows, columns] = self.orders::<R, C>();
        let ([s, t], _) = self.local(u, v);
        let in_u = bernstein::values::<R>(rows, s);
        let in_v = bernstein::values::<C>(columns, t);
        let mut h = DVec4::ZERO;
        for (i, row) in self.net.chunks_exact(columns).take(rows).enumerate() {
            let mut own = DVec4::ZERO;
            for (j, point) in row.iter().enumerate() {
                own += in_v[j] * *point;
            }
            h += in_u[i] * own;
        }
        place(&h, self.rational)
    }

    /// Number of control points in the direction in which the other parameter is fixed.
    pub(in crate::partition) fn count(&self, fixed: Along) -> usize {
        match fixed {
            Along::U => self.columns,
            Along::V => self.rows,
        }
    }

    /// The control points of the curve at a fixed parameter, in the other direction, and of its derivative by the
    /// fixed one, both homogeneous. `N` is their [number](Self::count), or [`ORDER`].
    pub(in crate::partition) fn slice<const N: usize>(&self, fixed: Along, value: f64) -> Slice<N> {
        let order = match fixed {
            Along::U => self.rows,
            Along::V => self.columns,
        };
        match order {
            2 => self.slice_of::<2, N>(fixed, value),
            4 => self.slice_of::<4, N>(fixed, value),
            _ => self.slice_of::<ORDER, N>(fixed, value),
        }
    }

    fn slice_of<const F: usize, const N: usize>(&self, fixed: Along, value: f64) -> Slice<N> {
        let (range, order, steps) = match fixed {
            Along::U => (self.u, self.rows, [self.columns, 1]),
            Along::V => (self.v, self.columns, [1, self.columns]),
        };
        let order = if F == ORDER { order } else { F };
        let count = if N == ORDER { self.count(fixed) } else { N };
        let unit = 1.0 / (range[1] - range[0]);
        let [values, slopes] = bernstein::first::<F>(order, (value - range[0]) * unit);
        let mut slice = Slice {
            points: [DVec4::ZERO; N],
            across: [DVec4::ZERO; N],
            count,
            rational: self.rational,
            range: if fixed == Along::U { self.v } else { self.u },
        };
        for k in 0..count {
            let (mut point, mut across) = (DVec4::ZERO, DVec4::ZERO);
            for i in 0..order {
                let h = self.net[i * steps[0] + k * steps[1]];
                point += values[i] * h;
                across += slopes[i] * h;
            }
            slice.points[k] = point;
            slice.across[k] = unit * across;
        }
        slice
    }
}

/// A point and two derivatives from homogeneous ones (PT97 A4.2).
fn places(h: [DVec4; 3], rational: bool) -> (DVec3, DVec3, DVec3) {
    let (p, a, b) = (h[0].xyz(), h[1].xyz(), h[2].xyz());
    if !rational {
        return (p, a, b);
    }
    let w = 1.0 / h[0].w;
    let p = p * w;
    (p, (a - h[1].w * p) * w, (b - h[2].w * p) * w)
}

/// A curve of a patch at a fixed parameter, with its derivative across.
pub(in crate::partition) struct Slice<const N: usize> {
    points: [DVec4; N],
    across: [DVec4; N],
    count: usize,
    rational: bool,
    range: [f64; 2],
}

impl<const N: usize> Slice<N> {
    /// The point, the derivative along the curve, and the derivative by the fixed parameter.
    pub(in crate::partition) fn jet(&self, x: f64) -> (DVec3, DVec3, DVec3) {
        let count = if N == ORDER { self.count } else { N };
        let unit = 1.0 / (self.range[1] - self.range[0]);
        let [values, slopes] = bernstein::first::<N>(count, (x - self.range[0]) * unit);
        let mut h = [DVec4::ZERO; 3];
        for k in 0..count {
            h[0] += values[k] * self.points[k];
            h[1] += slopes[k] * self.points[k];
            h[2] += values[k] * self.across[k];
        }
        let (p, along, across) = places(h, self.rational);
        (p, along * unit, across)
    }
}
