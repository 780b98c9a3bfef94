//! Bézier patches: evaluation, halving, and bounds of where a patch is and where its normals point.
//!
//! Degrees up to 7 each way, rational or not. The net is homogeneous, (w x, w y, w z, w), u-major. A
//! patch may be evaluated outside of its own parameters: its polynomial goes on.

use glam::{DVec3, DVec4, Vec4Swizzles};
use smallvec::SmallVec;

use super::bernstein;
use super::bounds::Bounds;
use super::cone::cone;

/// Most control points each way.
pub(super) const ORDER: usize = 8;

/// Most legs along v of patches whose normals' slopes are asked for: of 4 × 4 control points there are 12.
const LANES: usize = 12;

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

/// Homogeneous control points.
type Net = SmallVec<[DVec4; 16]>;

/// A Bézier patch over a rectangle of its surface's parameters.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    rows: usize,
    columns: usize,
    rational: bool,
    net: Net,
    pub(super) u: [f64; 2],
    pub(super) v: [f64; 2],
    pub(super) bounds: Bounds,
    /// The direction across which it is likely to be thin, and its range along it.
    thin: DVec3,
    slab: [f64; 2],
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
    /// A patch from its net and weights, both u-major.
    pub(super) fn new(
        rows: usize,
        net: &[DVec3],
        weights: &[f64],
        u: [f64; 2],
        v: [f64; 2],
    ) -> Self {
        let rational = weights.iter().any(|w| *w != 1.0);
        let net: Net = net
            .iter()
            .zip(weights)
            .map(|(p, w)| (*p * *w).extend(*w))
            .collect();
        let mut patch = Self {
            rows,
            columns: net.len() / rows,
            rational,
            bounds: Bounds::of(points(&net, rational)),
            net,
            u,
            v,
            thin: DVec3::ZERO,
            slab: [0.0; 2],
        };
        patch.measure();
        patch
    }

    /// Finds what it is thin across.
    fn measure(&mut self) {
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
        by_orders!(self.jet_of(u, v))
    }

    /// Point and first derivatives only.
    pub(super) fn first_jet(&self, u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
        by_orders!(self.first_jet_of(u, v))
    }

    /// The point only.
    pub(super) fn point(&self, u: f64, v: f64) -> DVec3 {
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
        if self.rational {
            h.xyz() / h.w
        } else {
            h.xyz()
        }
    }

    /// Number of control points in the direction in which the other parameter is fixed.
    pub(super) fn count(&self, fixed: Along) -> usize {
        match fixed {
            Along::U => self.columns,
            Along::V => self.rows,
        }
    }

    /// The control points of the curve at a fixed parameter, in the other direction, and of its derivative by the
    /// fixed one, both homogeneous. `N` is their [number](Self::count), or [`ORDER`].
    pub(super) fn slice<const N: usize>(&self, fixed: Along, value: f64) -> Slice<N> {
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

    /// Those of its two halves (de Casteljau) whose boxes are wanted.
    pub(super) fn halves(
        &self,
        along: Along,
        wanted: impl Fn(&Bounds) -> bool,
    ) -> [Option<Self>; 2] {
        let [u, v] = self.middle();
        let (u, v) = match along {
            Along::U => ([[self.u[0], u], [u, self.u[1]]], [self.v; 2]),
            Along::V => ([self.u; 2], [[self.v[0], v], [v, self.v[1]]]),
        };
        let half = |net: Net, u: [f64; 2], v: [f64; 2]| {
            let bounds = Bounds::of(points(&net, self.rational));
            wanted(&bounds).then(|| {
                let mut patch = Self {
                    net,
                    u,
                    v,
                    bounds,
                    ..*self
                };
                patch.measure();
                patch
            })
        };
        let [low, high] = self.half_nets(along);
        [half(low, u[0], v[0]), half(high, u[1], v[1])]
    }

    fn half_nets(&self, along: Along) -> [Net; 2] {
        let (lines, degree, line_step, step) = match along {
            Along::U => (self.columns, self.rows - 1, 1, self.columns),
            Along::V => (self.rows, self.columns - 1, self.columns, 1),
        };
        let mut low = Net::from_slice(&self.net);
        let mut high = Net::from_slice(&self.net);
        for line in 0..lines {
            let at = |k: usize| line * line_step + k * step;
            let mut work = [DVec4::ZERO; ORDER];
            for k in 0..=degree {
                work[k] = self.net[at(k)];
            }
            for round in 1..=degree {
                for k in 0..=degree - round {
                    work[k] = 0.5 * (work[k] + work[k + 1]);
                }
                low[at(round)] = work[0];
                high[at(degree - round)] = work[degree - round];
            }
        }
        [low, high]
    }

    /// The range of the slopes of its normals: how far they lean along a direction, against upright. `None` if some
    /// may be level, and for rational patches.
    ///
    /// Tangents along u are sums of legs along u, those along v of legs along v, with positive factors; so normals
    /// are such sums of the products of legs.
    pub(super) fn slopes(&self, along: DVec3, upright: DVec3) -> Option<[f64; 2]> {
        if self.rational {
            return None;
        }
        let [legs_u, legs_v] = self.legs();
        if legs_v.len() > LANES {
            return None;
        }
        // By coordinate, so that the compiler takes several at once; the last one as often as it fills up.
        let lanes: [[f64; LANES]; 3] = std::array::from_fn(|axis| {
            std::array::from_fn(|k| legs_v[k.min(legs_v.len() - 1)][axis])
        });
        let used = legs_v.len().next_multiple_of(4).min(LANES);
        let sign = legs_u[0].cross(legs_v[0]).dot(upright).signum();
        let mut least = [f64::INFINITY; LANES];
        let mut range = [[f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]];
        let smaller = |a: f64, b: f64| if a < b { a } else { b };
        for a in legs_u {
            let (lean, rise) = (along.cross(a) * sign, upright.cross(a) * sign);
            for k in 0..used {
                let [x, y, z] = [lanes[0][k], lanes[1][k], lanes[2][k]];
                let height = x * rise.x + y * rise.y + z * rise.z;
                let slope = (x * lean.x + y * lean.y + z * lean.z) / height;
                least[k] = smaller(height, least[k]);
                range[0][k] = smaller(slope, range[0][k]);
                range[1][k] = -smaller(-slope, -range[1][k]);
            }
        }
        let all = |lanes: &[f64; LANES]| lanes.iter().copied().fold(f64::INFINITY, f64::min);
        let high = range[1].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (all(&least) > 0.0).then(|| [all(&range[0]), high])
    }

    /// Steps between neighbouring control points, along u and along v.
    fn legs(&self) -> [SmallVec<[DVec3; 16]>; 2] {
        let points: SmallVec<[DVec3; 16]> = points(&self.net, self.rational).collect();
        let leg = |(from, to): (&DVec3, &DVec3)| *to - *from;
        [
            points
                .iter()
                .zip(&points[self.columns..])
                .map(leg)
                .collect(),
            points
                .chunks_exact(self.columns)
                .flat_map(|row| row.iter().zip(&row[1..]).map(leg))
                .collect(),
        ]
    }

    fn thin_direction(&self) -> DVec3 {
        let corner = |i: usize, j: usize| self.control(i * (self.rows - 1), j * (self.columns - 1));
        let along_u = (corner(1, 0) - corner(0, 0)) + (corner(1, 1) - corner(0, 1));
        let along_v = (corner(0, 1) - corner(0, 0)) + (corner(1, 1) - corner(1, 0));
        along_u.cross(along_v)
    }

    /// The range of its control points along a direction.
    fn range_along(&self, direction: DVec3) -> [f64; 2] {
        points(&self.net, self.rational).fold(
            [f64::INFINITY, f64::NEG_INFINITY],
            |[low, high], p| {
                let d = p.dot(direction);
                [low.min(d), high.max(d)]
            },
        )
    }

    /// A cone that holds all normals: its unit axis and the sine of its half-angle, if they fit a half-space.
    ///
    /// Legs of the net hold all tangents in cones about their means (hodographs lie in the hull of their
    /// control vectors), and a product of vectors of two cones leans from the product of the axes by at
    /// most `(sin α + sin β) / sin γ`-like amounts, γ the angle between the axes. Rational patches scale
    /// hodographs by positive functions, and their legs still bound the directions well enough here:
    /// cones only decide how deep to look.
    pub(super) fn normals(&self) -> Option<(DVec3, f64)> {
        let [legs_u, legs_v] = self.legs();
        let (a, alpha) = cone(&legs_u)?;
        let (b, beta) = cone(&legs_v)?;
        let cross = a.cross(b);
        let gamma = cross.length();
        let lean = (alpha + beta + alpha * beta) / gamma;
        (gamma > 1e-6 && lean < 1.0).then(|| (cross / gamma, lean))
    }
}

fn points(net: &[DVec4], rational: bool) -> impl Iterator<Item = DVec3> + Clone {
    net.iter()
        .map(move |h| if rational { h.xyz() / h.w } else { h.xyz() })
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
pub(super) struct Slice<const N: usize> {
    points: [DVec4; N],
    across: [DVec4; N],
    count: usize,
    rational: bool,
    range: [f64; 2],
}

impl<const N: usize> Slice<N> {
    /// The point, the derivative along the curve, and the derivative by the fixed parameter.
    pub(super) fn jet(&self, x: f64) -> (DVec3, DVec3, DVec3) {
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
