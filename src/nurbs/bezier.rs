//! Bézier patches on [0, 1]²: what curves and surfaces are cut into when something must be found or bounded.
//!
//! A curve is a patch of degree 0 in v. The net is homogeneous, (w x, w y, w z, w), and u-major; weights are positive, so
//! every patch lies in the hull of its control points, and halving it tightens the hull quadratically.

use super::knots::ORDER;
use super::{Curve, Surface};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// A Bézier patch, or a Bézier segment if its degree in v is 0.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    pub(super) degree_u: usize,
    pub(super) degree_v: usize,
    pub(super) net: Vec<DVec4>,
}

/// Where a patch lies in the parameters of what it was cut from: `[start, end]` in u and v.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    pub(super) u: [f64; 2],
    pub(super) v: [f64; 2],
}

impl Region {
    pub(super) const UNIT: Self = Self {
        u: [0.0, 1.0],
        v: [0.0, 1.0],
    };

    /// The parameters at (s, t) in [0, 1]².
    pub(super) fn at(&self, s: f64, t: f64) -> (f64, f64) {
        let along = |[start, end]: [f64; 2], x: f64| start * (1.0 - x) + end * x;
        (along(self.u, s), along(self.v, t))
    }

    /// How long it is in u and in v.
    pub(super) fn lengths(&self) -> (f64, f64) {
        (self.u[1] - self.u[0], self.v[1] - self.v[0])
    }

    fn halves(&self, along: Along) -> (Self, Self) {
        let (mut low, mut high) = (*self, *self);
        let (low_range, high_range) = match along {
            Along::U => (&mut low.u, &mut high.u),
            Along::V => (&mut low.v, &mut high.v),
        };
        let middle = 0.5 * (low_range[0] + low_range[1]);
        low_range[1] = middle;
        high_range[0] = middle;
        (low, high)
    }
}

/// One of the two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Along {
    U,
    V,
}

/// A point of a patch with its first derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jet {
    pub(super) point: DVec3,
    pub(super) du: DVec3,
    pub(super) dv: DVec3,
}

/// Second derivatives, in the order uu, uv, vv.
pub(super) type Second = [DVec3; 3];

/// Values and first and second derivatives of the Bernstein polynomials of one degree; `N` is how many there are, or the most.
struct Bernstein<const N: usize> {
    value: [f64; N],
    first: [f64; N],
    second: [f64; N],
}

impl<const N: usize> Bernstein<N> {
    #[inline]
    fn new(degree: usize, s: f64, second: bool) -> Self {
        let mut all = Self {
            value: [0.0; N],
            first: [0.0; N],
            second: [0.0; N],
        };
        all.value[0] = 1.0;
        for k in 1..=degree {
            if second && k + 1 == degree {
                let factor = (degree * k) as f64;
                for i in 0..=degree {
                    let at = |back: usize| if i >= back { all.value[i - back] } else { 0.0 };
                    all.second[i] = factor * (at(2) - 2.0 * at(1) + at(0));
                }
            }
            if k == degree {
                let factor = degree as f64;
                for i in 0..=degree {
                    let before = if i > 0 { all.value[i - 1] } else { 0.0 };
                    all.first[i] = factor * (before - all.value[i]);
                }
            }
            for i in (0..=k).rev() {
                let before = if i > 0 { all.value[i - 1] } else { 0.0 };
                all.value[i] = (1.0 - s) * all.value[i] + s * before;
            }
        }
        all
    }
}

impl Patch {
    /// The Bézier segments of a curve, with their parameters.
    pub(super) fn of_curve(curve: &Curve) -> Vec<(Self, Region)> {
        let patch = |segment: &Curve| {
            let (start, end) = segment.domain();
            let net = segment.homogeneous();
            let patch = Self {
                degree_u: segment.degree(),
                degree_v: 0,
                net,
            };
            (
                patch,
                Region {
                    u: [start, end],
                    v: [0.0, 0.0],
                },
            )
        };
        curve.bezier_segments().iter().map(patch).collect()
    }

    /// The Bézier patches of a surface, with their parameters.
    pub(super) fn of_surface(surface: &Surface) -> Vec<(Self, Region)> {
        let patch = |piece: Surface| {
            let (u, v) = (piece.knots_u(), piece.knots_v());
            let net = piece.homogeneous();
            let patch = Self {
                degree_u: u.degree(),
                degree_v: v.degree(),
                net,
            };
            let (u, v) = (u.domain(), v.domain());
            (
                patch,
                Region {
                    u: [u.0, u.1],
                    v: [v.0, v.1],
                },
            )
        };
        surface.bezier_patches().map(patch).collect()
    }

    /// The patch after a change of coordinates: `(w x, w)` becomes `(w change(x), w)` for a linear or affine change.
    pub(super) fn mapped(&self, change: impl Fn(DVec3) -> DVec3) -> Self {
        let moved = |h: &DVec4| (change(h.xyz() / h.w) * h.w).extend(h.w);
        Self {
            net: self.net.iter().map(moved).collect(),
            ..*self
        }
    }

    /// The control points.
    pub(super) fn points(&self) -> impl Iterator<Item = DVec3> {
        self.net.iter().map(|h| h.xyz() / h.w)
    }

    /// The control point i in u and j in v.
    pub(super) fn control(&self, i: usize, j: usize) -> DVec4 {
        self.net[i * (self.degree_v + 1) + j]
    }

    /// The box of the control points, which holds the patch.
    pub(super) fn hull(&self) -> (DVec3, DVec3) {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.points()
            .fold(empty, |(low, high), p| (low.min(p), high.max(p)))
    }

    /// The least and the greatest weight.
    pub(super) fn weight_range(&self) -> (f64, f64) {
        let empty = (f64::INFINITY, f64::NEG_INFINITY);
        self.net
            .iter()
            .fold(empty, |(low, high), h| (low.min(h.w), high.max(h.w)))
    }

    /// Point and first derivatives.
    pub(super) fn jet(&self, s: f64, t: f64) -> Jet {
        self.evaluate(s, t, false).0
    }

    /// Point, first and second derivatives.
    pub(super) fn second_jet(&self, s: f64, t: f64) -> (Jet, Second) {
        self.evaluate(s, t, true)
    }

    /// With the usual orders as constants nothing is looped over or copied.
    fn evaluate(&self, s: f64, t: f64, second: bool) -> (Jet, Second) {
        match (self.degree_u, self.degree_v, second) {
            (1, 1, false) => self.evaluate_of::<2, 2>(s, t, false),
            (1, 3, false) => self.evaluate_of::<2, 4>(s, t, false),
            (3, 1, false) => self.evaluate_of::<4, 2>(s, t, false),
            (3, 3, false) => self.evaluate_of::<4, 4>(s, t, false),
            _ => self.evaluate_of::<ORDER, ORDER>(s, t, second),
        }
    }

    #[inline]
    fn evaluate_of<const U: usize, const V: usize>(
        &self,
        s: f64,
        t: f64,
        second: bool,
    ) -> (Jet, Second) {
        let degree_u = if U == ORDER { self.degree_u } else { U - 1 };
        let degree_v = if V == ORDER { self.degree_v } else { V - 1 };
        let in_u = Bernstein::<U>::new(degree_u, s, second);
        let in_v = Bernstein::<V>::new(degree_v, t, second);
        // Homogeneous value and derivatives: h, u, v, uu, uv, vv.
        let mut sums = [DVec4::ZERO; 6];
        for (i, row) in self.net.chunks_exact(degree_v + 1).enumerate() {
            if i > degree_u {
                break;
            }
            let mut own = [DVec4::ZERO; 3];
            for (j, &h) in row.iter().enumerate() {
                own[0] += in_v.value[j] * h;
                own[1] += in_v.first[j] * h;
                if second {
                    own[2] += in_v.second[j] * h;
                }
            }
            sums[0] += in_u.value[i] * own[0];
            sums[1] += in_u.first[i] * own[0];
            sums[2] += in_u.value[i] * own[1];
            if second {
                sums[3] += in_u.second[i] * own[0];
                sums[4] += in_u.first[i] * own[1];
                sums[5] += in_u.value[i] * own[2];
            }
        }
        let [h, u, v, uu, uv, vv] = sums;
        let part = 1.0 / h.w;
        let point = h.xyz() * part;
        let du = (u.xyz() - point * u.w) * part;
        let dv = (v.xyz() - point * v.w) * part;
        if !second {
            return (Jet { point, du, dv }, [DVec3::ZERO; 3]);
        }
        let duu = (uu.xyz() - 2.0 * u.w * du - uu.w * point) * part;
        let duv = (uv.xyz() - u.w * dv - v.w * du - uv.w * point) * part;
        let dvv = (vv.xyz() - 2.0 * v.w * dv - vv.w * point) * part;
        (Jet { point, du, dv }, [duu, duv, dvv])
    }

    /// The two halves (de Casteljau).
    pub(super) fn halves(&self, along: Along) -> (Self, Self) {
        let (columns, degree) = (self.degree_v + 1, self.degree_u);
        let (mut low, mut high) = (self.clone(), self.clone());
        // The high half is made in place; its first entry of each step is the low half's next one.
        let (lines, degree, line_step, step) = match along {
            Along::U => (columns, degree, 1, columns),
            Along::V => (degree + 1, self.degree_v, columns, 1),
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
        (low, high)
    }

    /// The length of the longest control polygon in u and in v, measured by `measure` on each leg.
    pub(super) fn lengths(&self, measure: impl Fn(DVec3) -> f64) -> (f64, f64) {
        let point = |i: usize, j: usize| {
            let h = self.control(i, j);
            h.xyz() / h.w
        };
        let in_u = |j: usize| -> f64 {
            (0..self.degree_u)
                .map(|i| measure(point(i + 1, j) - point(i, j)))
                .sum()
        };
        let in_v = |i: usize| -> f64 {
            (0..self.degree_v)
                .map(|j| measure(point(i, j + 1) - point(i, j)))
                .sum()
        };
        let longest_u = (0..=self.degree_v).map(in_u).fold(0.0, f64::max);
        let longest_v = (0..=self.degree_u).map(in_v).fold(0.0, f64::max);
        (longest_u, longest_v)
    }
}

/// Both halves of a patch together with their regions.
pub(super) fn halves(patch: &Patch, region: &Region, along: Along) -> [(Patch, Region); 2] {
    let (low, high) = patch.halves(along);
    let (low_region, high_region) = region.halves(along);
    [(low, low_region), (high, high_region)]
}
