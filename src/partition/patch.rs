//! Bézier patches: halving, and bounds of where a patch is and where its normals point.
//!
//! Degrees up to 7 each way, rational or not. The net is homogeneous, (w x, w y, w z, w), u-major. A
//! patch may be evaluated outside of its own parameters: its polynomial goes on.

mod evaluate;
mod normals;

use glam::{DVec3, DVec4, Vec4Swizzles};
use smallvec::SmallVec;

use super::bounds::Bounds;

pub(super) use evaluate::{Jet, Slice};
pub(super) use normals::{Cones, slopes};

/// Most control points each way.
pub(super) const ORDER: usize = 8;

/// Weights that differ by this fraction are the same.
const SAME: f64 = 1e-13;

/// Along a direction in which its legs are shorter than this, as a fraction of the others, a patch is not halved.
const THIN: f64 = 1e-3;

/// One of the two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Along {
    U,
    V,
}

/// Homogeneous control points.
pub(super) type Net = SmallVec<[DVec4; 16]>;

/// A Bézier patch over a rectangle of its surface's parameters.
#[derive(Debug)]
pub(super) struct Patch {
    rows: usize,
    columns: usize,
    rational: bool,
    /// Whether each weight is a product of one of its row and one of its column.
    has_product_weights: bool,
    net: Net,
    pub(super) u: [f64; 2],
    pub(super) v: [f64; 2],
    pub(super) bounds: Bounds,
    /// The direction across which it is likely to be thin, and its range along it.
    thin: DVec3,
    slab: [f64; 2],
}

impl Clone for Patch {
    fn clone(&self) -> Self {
        // In one piece, not point by point.
        Self {
            net: Net::from_slice(&self.net),
            ..*self
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
        let net: Net = net
            .iter()
            .zip(weights)
            .map(|(p, w)| (*p * *w).extend(*w))
            .collect();
        Self {
            rational,
            has_product_weights: are_products(weights, rows),
            ..Self::bare(rows, net, u, v)
        }
        .measured()
    }

    /// A patch without weights, from its net, u-major, of which no more than points and derivatives are known: not its box,
    /// nor what it is thin across.
    pub(super) fn bare(rows: usize, net: Net, u: [f64; 2], v: [f64; 2]) -> Self {
        Self {
            rows,
            columns: net.len() / rows,
            rational: false,
            has_product_weights: true,
            bounds: Bounds::EMPTY,
            net,
            u,
            v,
            thin: DVec3::ZERO,
            slab: [0.0; 2],
        }
    }

    /// The same with its box and what it is thin across.
    pub(super) fn measured(mut self) -> Self {
        self.bounds = Bounds::of(points(&self.net, self.rational));
        self.measure();
        self
    }

    /// Finds what it is thin across.
    pub(super) fn measure(&mut self) {
        self.thin = self.thin_direction();
        self.slab = self.range_along(self.thin);
    }

    /// Whether a plane across its thin direction separates it from another patch, by more than a distance.
    pub(super) fn is_beside(&self, other: &Self, distance: f64) -> bool {
        other.is_off(self.thin, self.slab, distance * self.thin.length())
    }

    /// Whether all of its control points are on one side of a range along a direction, by more than a slack.
    fn is_off(&self, direction: DVec3, [low, high]: [f64; 2], slack: f64) -> bool {
        let (mut below, mut above) = (true, true);
        for p in points(&self.net, self.rational) {
            let d = p.dot(direction);
            below &= low > d + slack;
            above &= d > high + slack;
            // Most are not: few points tell.
            if !below && !above {
                return false;
            }
        }
        true
    }

    /// Its thin direction, and its range along it.
    pub(super) fn slab(&self) -> (DVec3, [f64; 2]) {
        (self.thin, self.slab)
    }

    fn control(&self, i: usize, j: usize) -> DVec3 {
        place(&self.net[i * self.columns + j], self.rational)
    }

    /// Its control points, u-major.
    pub(super) fn controls(&self) -> impl Iterator<Item = DVec3> {
        points(&self.net, self.rational)
    }

    /// The elevations of its control points, u-major, with its orders.
    pub(super) fn elevations(&self) -> ([usize; 2], impl Iterator<Item = f64>) {
        let elevations = points(&self.net, self.rational).map(|p| p.z);
        ([self.rows, self.columns], elevations)
    }

    /// The parameters of its middle.
    pub(super) fn middle(&self) -> [f64; 2] {
        [0.5 * (self.u[0] + self.u[1]), 0.5 * (self.v[0] + self.v[1])]
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

    /// The direction along which its tangents turn more: beside a pole, around that. Not one along which it is next to nothing long.
    pub(super) fn rounder(&self) -> Along {
        let leg = |i: usize, j: usize, along: Along| {
            let to = match along {
                Along::U => self.control(i + 1, j),
                Along::V => self.control(i, j + 1),
            };
            to - self.control(i, j)
        };
        // Vanishing legs say nothing.
        let turn = |one: DVec3, other: DVec3| match (one.try_normalize(), other.try_normalize()) {
            (Some(one), Some(other)) => 1.0 - one.dot(other),
            _ => 0.0,
        };
        let (mut turns, mut lengths) = ([0.0; 2], [0.0_f64; 2]);
        for i in 0..self.rows {
            for j in 0..self.columns {
                let has = [i + 1 < self.rows, j + 1 < self.columns];
                // From this leg to the next one along u, and along v; legs of both directions.
                if has[0] {
                    lengths[0] = lengths[0].max(leg(i, j, Along::U).length());
                    if i + 2 < self.rows {
                        turns[0] += turn(leg(i, j, Along::U), leg(i + 1, j, Along::U));
                    }
                    if has[1] {
                        turns[1] += turn(leg(i, j, Along::U), leg(i, j + 1, Along::U));
                    }
                }
                if has[1] {
                    lengths[1] = lengths[1].max(leg(i, j, Along::V).length());
                    if j + 2 < self.columns {
                        turns[1] += turn(leg(i, j, Along::V), leg(i, j + 1, Along::V));
                    }
                    if has[0] {
                        turns[0] += turn(leg(i, j, Along::V), leg(i + 1, j, Along::V));
                    }
                }
            }
        }
        let by_u = turns[0] > turns[1];
        let [own, other] = if by_u {
            lengths
        } else {
            [lengths[1], lengths[0]]
        };
        let is_thin = own < THIN * other;
        if by_u == is_thin { Along::V } else { Along::U }
    }

    /// Hands on those of its two halves (de Casteljau) whose boxes are wanted.
    pub(super) fn halve(
        &self,
        along: Along,
        wanted: impl Fn(&Bounds) -> bool,
        mut each: impl FnMut(Self),
    ) {
        for mut half in self.bare_halves(along) {
            if wanted(&half.bounds) {
                half.measure();
                each(half);
            }
        }
    }

    /// Its two halves.
    pub(super) fn halves(&self, along: Along) -> [Self; 2] {
        self.bare_halves(along).map(|mut half| {
            half.measure();
            half
        })
    }

    /// Its halves with their boxes; what they are thin across is not known yet.
    pub(super) fn bare_halves(&self, along: Along) -> [Self; 2] {
        let [u, v] = self.middle();
        let (mut low, mut high) = (self.clone(), self.clone());
        match along {
            Along::U => (low.u[1], high.u[0]) = (u, u),
            Along::V => (low.v[1], high.v[0]) = (v, v),
        }
        self.half_nets(along, [&mut low.net, &mut high.net]);
        for half in [&mut low, &mut high] {
            half.bounds = Bounds::of(points(&half.net, half.rational));
        }
        [low, high]
    }

    /// The part of it over a rectangle of its parameters; of its box nothing is known.
    pub(super) fn part(&self, u: [f64; 2], v: [f64; 2]) -> Self {
        let mut net = self.net.clone();
        let local = |x: f64, [low, high]: [f64; 2]| (x - low) / (high - low);
        self.cut(&mut net, Along::U, u.map(|u| local(u, self.u)));
        self.cut(&mut net, Along::V, v.map(|v| local(v, self.v)));
        Self {
            net,
            u,
            v,
            bounds: Bounds::EMPTY,
            ..*self
        }
    }

    /// Cuts a net to a range of one parameter, in fractions of its own: what lies before its end, and of that what lies behind
    /// its start (de Casteljau).
    fn cut(&self, net: &mut Net, along: Along, [start, end]: [f64; 2]) {
        let (lines, degree, line_step, step) = self.lines(along);
        for line in 0..lines {
            let at = |k: usize| line * line_step + k * step;
            let mut work = [DVec4::ZERO; ORDER];
            for (k, h) in work.iter_mut().take(degree + 1).enumerate() {
                *h = net[at(k)];
            }
            // By blossoms: with `round` arguments at the end and the others at the start.
            for round in 0..=degree {
                let mut row = work;
                for k in 0..degree {
                    let to = if k < round { end } else { start };
                    for i in 0..degree - k {
                        row[i] = row[i].lerp(row[i + 1], to);
                    }
                }
                net[at(round)] = row[0];
            }
        }
    }

    /// How the control points along a parameter lie in the net: lines, degree, and the steps from line to line and along one.
    fn lines(&self, along: Along) -> (usize, usize, usize, usize) {
        match along {
            Along::U => (self.columns, self.rows - 1, 1, self.columns),
            Along::V => (self.rows, self.columns - 1, self.columns, 1),
        }
    }

    /// Makes two copies of its net those of its halves (de Casteljau).
    fn half_nets(&self, along: Along, halves: [&mut [DVec4]; 2]) {
        match self.lines(along).1 {
            1 => self.half_nets_of::<2>(along, halves),
            3 => self.half_nets_of::<4>(along, halves),
            _ => self.half_nets_of::<ORDER>(along, halves),
        }
    }

    fn half_nets_of<const N: usize>(&self, along: Along, [low, high]: [&mut [DVec4]; 2]) {
        let (lines, degree, line_step, step) = self.lines(along);
        let degree = if N == ORDER { degree } else { N - 1 };
        let net = &self.net[..];
        for line in 0..lines {
            let at = |k: usize| line * line_step + k * step;
            let mut work = [DVec4::ZERO; N];
            for (k, h) in work.iter_mut().take(degree + 1).enumerate() {
                *h = net[at(k)];
            }
            for round in 1..=degree {
                for k in 0..=degree - round {
                    work[k] = 0.5 * (work[k] + work[k + 1]);
                }
                low[at(round)] = work[0];
                high[at(degree - round)] = work[degree - round];
            }
        }
    }

    fn thin_direction(&self) -> DVec3 {
        let corner = |i: usize, j: usize| self.control(i * (self.rows - 1), j * (self.columns - 1));
        let along_u = (corner(1, 0) - corner(0, 0)) + (corner(1, 1) - corner(0, 1));
        let along_v = (corner(0, 1) - corner(0, 0)) + (corner(1, 1) - corner(1, 0));
        along_u.cross(along_v)
    }

    /// The range of its control points along a direction.
    pub(super) fn range_along(&self, direction: DVec3) -> [f64; 2] {
        points(&self.net, self.rational).fold(
            [f64::INFINITY, f64::NEG_INFINITY],
            |[low, high], p| {
                let d = p.dot(direction);
                [low.min(d), high.max(d)]
            },
        )
    }
}

/// Whether weights are products, up to rounding.
fn are_products(weights: &[f64], rows: usize) -> bool {
    let columns = weights.len() / rows;
    weights.iter().enumerate().all(|(at, weight)| {
        let (row, column) = (weights[at - at % columns], weights[at % columns]);
        let (one, other) = (weight * weights[0], row * column);
        (one - other).abs() <= SAME * other.abs()
    })
}

fn points(net: &[DVec4], rational: bool) -> impl Iterator<Item = DVec3> + Clone {
    net.iter().map(move |h| place(h, rational))
}

/// The place of a homogeneous control point.
pub(super) fn place(h: &DVec4, rational: bool) -> DVec3 {
    if rational { h.xyz() / h.w } else { h.xyz() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_that_winds_is_halved_across_and_not_along_its_rulings() {
        // Its first leg and its last one are parallel.
        let winding = [[0.0, 0.0], [3.0, 1.0], [-2.0, 2.0], [1.0, 3.0]];
        let net: Vec<DVec3> = (0..8)
            .map(|k| DVec3::new(winding[k / 2][0], (k % 2) as f64, winding[k / 2][1]))
            .collect();
        let patch = Patch::new(4, &net, &[1.0; 8], [0.0, 1.0], [0.0, 1.0]);
        assert_eq!(patch.rounder(), Along::U);
    }

    #[test]
    fn a_part_is_the_patch_over_its_rectangle() {
        let net: Vec<DVec3> = (0..12)
            .map(|k| (f64::from(k / 3), f64::from(k % 3)))
            .map(|(x, y)| DVec3::new(x + 0.1 * y * y, y - 0.2 * x, 0.3 * x * x - 0.7 * x * y))
            .collect();
        for weight in [1.0, 1.5] {
            let weights: Vec<f64> = (0..12).map(|k| if k == 4 { weight } else { 1.0 }).collect();
            let whole = Patch::new(4, &net, &weights, [2.0, 3.0], [-1.0, 1.0]);
            let part = whole.part([2.25, 2.5], [-0.75, 1.0]);
            for (u, v) in [
                (2.25, -0.75),
                (2.3, 0.1),
                (2.5, 1.0),
                (2.5, -0.75),
                (2.4, 0.9),
            ] {
                assert!(part.point(u, v).distance(whole.point(u, v)) < 1e-14);
            }
            // Its corners are control points.
            let corners = [part.control(0, 0), part.control(3, 2)];
            let places = [whole.point(2.25, -0.75), whole.point(2.5, 1.0)];
            assert!((0..2).all(|k| corners[k].distance(places[k]) < 1e-14));
        }
    }
}
