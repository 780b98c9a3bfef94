//! Bézier patches: evaluation, halving, and bounds of where a patch is and where its normals point.
//!
//! Degrees up to 7 each way, rational or not. The net is homogeneous, (w x, w y, w z, w), u-major. A
//! patch may be evaluated outside of its own parameters: its polynomial goes on.

use glam::{DVec3, DVec4, Vec4Swizzles};
use smallvec::SmallVec;

use super::bounds::Bounds;

/// Most control points each way.
pub(super) const ORDER: usize = 8;

/// A point of a surface with its first and second derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Jet {
    pub(super) p: DVec3,
    pub(super) u: DVec3,
    pub(super) v: DVec3,
    pub(super) uu: DVec3,
    pub(super) uv: DVec3,
    pub(super) vv: DVec3,
}

impl Jet {
    /// The normal `S_u × S_v`, not of unit length.
    pub(super) fn normal(&self) -> DVec3 {
        self.u.cross(self.v)
    }
}

/// One of the two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Along {
    U,
    V,
}

/// A Bézier patch over a rectangle of its surface's parameters.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    rows: usize,
    columns: usize,
    rational: bool,
    net: SmallVec<[DVec4; 16]>,
    pub(super) u: [f64; 2],
    pub(super) v: [f64; 2],
    pub(super) bounds: Bounds,
    /// The direction across which it is likely to be thin, and its range along it.
    thin: DVec3,
    slab: [f64; 2],
}

/// Values, first and second derivatives of the Bernstein polynomials of one degree on [0, 1].
#[derive(Clone, Copy)]
struct Basis {
    value: [f64; ORDER],
    first: [f64; ORDER],
    second: [f64; ORDER],
}

impl Basis {
    fn new(order: usize, s: f64) -> Self {
        let mut all = Self {
            value: [0.0; ORDER],
            first: [0.0; ORDER],
            second: [0.0; ORDER],
        };
        let r = 1.0 - s;
        match order {
            2 => {
                all.value[0] = r;
                all.value[1] = s;
                all.first[0] = -1.0;
                all.first[1] = 1.0;
            }
            4 => {
                all.value[..4].copy_from_slice(&[
                    r * r * r,
                    3.0 * r * r * s,
                    3.0 * r * s * s,
                    s * s * s,
                ]);
                all.first[..4].copy_from_slice(&[
                    -3.0 * r * r,
                    3.0 * r * (r - 2.0 * s),
                    3.0 * s * (2.0 * r - s),
                    3.0 * s * s,
                ]);
                all.second[..4].copy_from_slice(&[
                    6.0 * r,
                    6.0 * (s - 2.0 * r),
                    6.0 * (r - 2.0 * s),
                    6.0 * s,
                ]);
            }
            _ => all.raise(order, s),
        }
        all
    }

    /// By raising the degree; derivatives are differences of the polynomials one and two degrees lower.
    fn raise(&mut self, order: usize, s: f64) {
        let before = |of: &[f64; ORDER], i: usize, back: usize| {
            if i >= back { of[i - back] } else { 0.0 }
        };
        self.value[0] = 1.0;
        for degree in 1..order {
            let lower = self.value;
            if degree + 2 == order {
                // `lower` has degree p − 2 here.
                let factor = ((order - 1) * (order - 2)) as f64;
                for i in 0..order {
                    let sum = before(&lower, i, 2) - 2.0 * before(&lower, i, 1) + lower[i];
                    self.second[i] = factor * sum;
                }
            }
            if degree + 1 == order {
                for i in 0..order {
                    self.first[i] = (order - 1) as f64 * (before(&lower, i, 1) - lower[i]);
                }
            }
            for i in (0..=degree).rev() {
                self.value[i] = (1.0 - s) * lower[i] + s * before(&lower, i, 1);
            }
        }
    }
}

impl Patch {
    /// A patch from its net and weights, both u-major.
    pub(super) fn new(
        rows: usize,
        net: &[DVec3],
        weights: &[f64],
        u: [f64; 2],
        v: [f64; 2],
    ) -> Self {
        let rational = weights.iter().any(|w| *w != 1.0);
        let net: SmallVec<[DVec4; 16]> = net
            .iter()
            .zip(weights)
            .map(|(p, w)| (*p * *w).extend(*w))
            .collect();
        let mut patch = Self {
            rows,
            columns: net.len() / rows,
            rational,
            net,
            u,
            v,
            bounds: Bounds::EMPTY,
            thin: DVec3::ZERO,
            slab: [0.0; 2],
        };
        patch.measure();
        patch
    }

    /// Finds what is kept about where it is.
    fn measure(&mut self) {
        self.bounds = Bounds::of(self.points());
        self.thin = self.thin_direction();
        self.slab = self.range_along(self.thin);
    }

    /// Whether a plane across its thin direction separates it from another patch, by more than a distance.
    pub(super) fn is_beside(&self, other: &Self, distance: f64) -> bool {
        let range = other.range_along(self.thin);
        let slack = distance * self.thin.length();
        self.slab[0] > range[1] + slack || range[0] > self.slab[1] + slack
    }

    /// Its thin direction, and its range along it.
    pub(super) fn slab(&self) -> (DVec3, [f64; 2]) {
        (self.thin, self.slab)
    }

    fn points(&self) -> impl Iterator<Item = DVec3> {
        let rational = self.rational;
        self.net
            .iter()
            .map(move |h| if rational { h.xyz() / h.w } else { h.xyz() })
    }

    fn control(&self, i: usize, j: usize) -> DVec3 {
        let h = self.net[i * self.columns + j];
        if self.rational {
            h.xyz() / h.w
        } else {
            h.xyz()
        }
    }

    /// The parameters of its middle.
    pub(super) fn middle(&self) -> [f64; 2] {
        [0.5 * (self.u[0] + self.u[1]), 0.5 * (self.v[0] + self.v[1])]
    }

    /// Point and derivatives in the surface's parameters.
    pub(super) fn jet(&self, u: f64, v: f64) -> Jet {
        let (du, dv) = (1.0 / (self.u[1] - self.u[0]), 1.0 / (self.v[1] - self.v[0]));
        let in_u = Basis::new(self.rows, (u - self.u[0]) * du);
        let in_v = Basis::new(self.columns, (v - self.v[0]) * dv);
        let mut h = [DVec4::ZERO; 6];
        for (i, row) in self.net.chunks_exact(self.columns).enumerate() {
            let mut own = [DVec4::ZERO; 3];
            for (j, point) in row.iter().enumerate() {
                own[0] += in_v.value[j] * *point;
                own[1] += in_v.first[j] * *point;
                own[2] += in_v.second[j] * *point;
            }
            h[0] += in_u.value[i] * own[0];
            h[1] += in_u.first[i] * own[0];
            h[2] += in_u.value[i] * own[1];
            h[3] += in_u.second[i] * own[0];
            h[4] += in_u.first[i] * own[1];
            h[5] += in_u.value[i] * own[2];
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

    /// Point and first derivatives only.
    pub(super) fn first_jet(&self, u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
        let (du, dv) = (1.0 / (self.u[1] - self.u[0]), 1.0 / (self.v[1] - self.v[0]));
        let in_u = Basis::new(self.rows, (u - self.u[0]) * du);
        let in_v = Basis::new(self.columns, (v - self.v[0]) * dv);
        let mut h = [DVec4::ZERO; 3];
        for (i, row) in self.net.chunks_exact(self.columns).enumerate() {
            let mut own = [DVec4::ZERO; 2];
            for (j, point) in row.iter().enumerate() {
                own[0] += in_v.value[j] * *point;
                own[1] += in_v.first[j] * *point;
            }
            h[0] += in_u.value[i] * own[0];
            h[1] += in_u.first[i] * own[0];
            h[2] += in_u.value[i] * own[1];
        }
        let (mut p, mut pu, mut pv) = (h[0].xyz(), h[1].xyz(), h[2].xyz());
        if self.rational {
            let w = 1.0 / h[0].w;
            p *= w;
            pu = (pu - h[1].w * p) * w;
            pv = (pv - h[2].w * p) * w;
        }
        (p, pu * du, pv * dv)
    }

    /// The control points of the curve at a fixed parameter, in the other direction, and of its derivative by the
    /// fixed one, both homogeneous.
    pub(super) fn slice(&self, fixed: Along, value: f64) -> Slice {
        let (range, order, count) = match fixed {
            Along::U => (self.u, self.rows, self.columns),
            Along::V => (self.v, self.columns, self.rows),
        };
        let unit = 1.0 / (range[1] - range[0]);
        let basis = Basis::new(order, (value - range[0]) * unit);
        let mut slice = Slice {
            points: [DVec4::ZERO; ORDER],
            across: [DVec4::ZERO; ORDER],
            count,
            rational: self.rational,
            range: if fixed == Along::U { self.v } else { self.u },
        };
        for k in 0..count {
            for i in 0..order {
                let h = match fixed {
                    Along::U => self.net[i * self.columns + k],
                    Along::V => self.net[k * self.columns + i],
                };
                slice.points[k] += basis.value[i] * h;
                slice.across[k] += basis.first[i] * unit * h;
            }
        }
        slice
    }

    /// The direction in which its net is longer.
    pub(super) fn longer(&self) -> Along {
        let corner = |i: usize, j: usize| self.control(i * (self.rows - 1), j * (self.columns - 1));
        let along_u = (corner(1, 0) - corner(0, 0)) + (corner(1, 1) - corner(0, 1));
        let along_v = (corner(0, 1) - corner(0, 0)) + (corner(1, 1) - corner(1, 0));
        if along_u.length_squared() > along_v.length_squared() {
            Along::U
        } else {
            Along::V
        }
    }

    /// The two halves (de Casteljau).
    pub(super) fn halves(&self, along: Along) -> [Self; 2] {
        let (mut low, mut high) = (self.clone(), self.clone());
        let (lines, degree, line_step, step) = match along {
            Along::U => (self.columns, self.rows - 1, 1, self.columns),
            Along::V => (self.rows, self.columns - 1, self.columns, 1),
        };
        for line in 0..lines {
            let at = |k: usize| line * line_step + k * step;
            for round in 1..=degree {
                for k in 0..=degree - round {
                    high.net[at(k)] = 0.5 * (high.net[at(k)] + high.net[at(k + 1)]);
                }
                low.net[at(round)] = high.net[at(0)];
            }
        }
        let [u, v] = self.middle();
        match along {
            Along::U => {
                low.u[1] = u;
                high.u[0] = u;
            }
            Along::V => {
                low.v[1] = v;
                high.v[0] = v;
            }
        }
        low.measure();
        high.measure();
        [low, high]
    }

    fn thin_direction(&self) -> DVec3 {
        let corner = |i: usize, j: usize| self.control(i * (self.rows - 1), j * (self.columns - 1));
        let along_u = (corner(1, 0) - corner(0, 0)) + (corner(1, 1) - corner(0, 1));
        let along_v = (corner(0, 1) - corner(0, 0)) + (corner(1, 1) - corner(1, 0));
        along_u.cross(along_v)
    }

    /// The range of its control points along a direction.
    fn range_along(&self, direction: DVec3) -> [f64; 2] {
        self.points()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
                let d = p.dot(direction);
                [low.min(d), high.max(d)]
            })
    }

    /// A cone that holds all normals: its unit axis and the sine of its half-angle, if they fit a half-space.
    ///
    /// Legs of the net hold all tangents in cones about their means (hodographs lie in the hull of their
    /// control vectors), and a product of vectors of two cones leans from the product of the axes by at
    /// most `(sin α + sin β) / sin γ`-like amounts, γ the angle between the axes. Rational patches scale
    /// hodographs by positive functions, and their legs still bound the directions well enough here:
    /// cones only decide how deep to look.
    pub(super) fn normals(&self) -> Option<(DVec3, f64)> {
        let legs_u = (0..self.rows - 1).flat_map(|i| (0..self.columns).map(move |j| (i, j)));
        let legs_v = (0..self.rows).flat_map(|i| (0..self.columns - 1).map(move |j| (i, j)));
        let (a, alpha) = cone(legs_u.map(|(i, j)| self.control(i + 1, j) - self.control(i, j)))?;
        let (b, beta) = cone(legs_v.map(|(i, j)| self.control(i, j + 1) - self.control(i, j)))?;
        let cross = a.cross(b);
        let gamma = cross.length();
        let lean = (alpha + beta + alpha * beta) / gamma;
        (gamma > 1e-6 && lean < 1.0).then(|| (cross / gamma, lean))
    }
}

/// A curve of a patch at a fixed parameter, with its derivative across.
pub(super) struct Slice {
    points: [DVec4; ORDER],
    across: [DVec4; ORDER],
    count: usize,
    rational: bool,
    range: [f64; 2],
}

impl Slice {
    /// The point, the derivative along the curve, and the derivative by the fixed parameter.
    pub(super) fn jet(&self, x: f64) -> (DVec3, DVec3, DVec3) {
        let unit = 1.0 / (self.range[1] - self.range[0]);
        let basis = Basis::new(self.count, (x - self.range[0]) * unit);
        let mut h = [DVec4::ZERO; 3];
        for k in 0..self.count {
            h[0] += basis.value[k] * self.points[k];
            h[1] += basis.first[k] * self.points[k];
            h[2] += basis.value[k] * self.across[k];
        }
        let (mut p, mut along, mut across) = (h[0].xyz(), h[1].xyz(), h[2].xyz());
        if self.rational {
            let w = 1.0 / h[0].w;
            p *= w;
            along = (along - h[1].w * p) * w;
            across = (across - h[2].w * p) * w;
        }
        (p, along * unit, across)
    }
}

/// A cone that holds some vectors: unit axis and sine of the half-angle. Vanishing vectors say nothing.
pub(super) fn cone(vectors: impl Iterator<Item = DVec3> + Clone) -> Option<(DVec3, f64)> {
    let axis = vectors
        .clone()
        .fold(DVec3::ZERO, |sum, v| sum + v)
        .try_normalize()?;
    let mut sine: f64 = 0.0;
    for v in vectors {
        let length = v.length();
        if length == 0.0 {
            continue;
        }
        let along = v.dot(axis);
        if along <= 0.0 {
            return None;
        }
        sine = sine.max((v - along * axis).length() / length);
    }
    Some((axis, sine))
}
