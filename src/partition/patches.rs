//! The patches of a sheet: kept, or, of a large height field, made where they are asked for.
//!
//! A patch with its boxes takes some 800 bytes, for nine new heights of 8 bytes where x and y are functions of one parameter
//! each. Of a grid of 500 × 500 heights that is 170 MB or 20.

use std::borrow::Cow;

use glam::{DVec3, DVec4};
use smallvec::SmallVec;

use super::bounds::Bounds;
use super::facet::Facet;
use super::patch::{self, Patch};
use crate::nurbs::Surface;

/// Height fields with more patches than this are not kept as patches.
const MANY: usize = 20_000;

/// The patches of a sheet, u-major.
#[derive(Clone, Debug)]
pub(super) enum Patches {
    /// All of them.
    Kept(Vec<Facet>),
    /// Control points from which they are made.
    Made(Heights),
}

/// The control points of a height field cut into patches, without those that neighbours have in common twice.
#[derive(Clone, Debug)]
pub(super) struct Heights {
    x: Vec<f64>,
    y: Vec<f64>,
    /// Of `x[i]` and `y[j]` entry `i * y.len() + j`.
    z: Vec<f64>,
    /// Degrees along u and v.
    degrees: [usize; 2],
    /// Distinct knots.
    knots: [Vec<f64>; 2],
}

/// A net of the usual orders, without a place on the heap.
type Net = SmallVec<[DVec3; 16]>;

impl Patches {
    /// Cuts a surface with these distinct knots, which may be a height over its plan.
    pub(super) fn of(surface: &Surface, knots: &[Vec<f64>; 2], is_height: bool) -> Self {
        let degrees = [surface.knots_u().degree(), surface.knots_v().degree()];
        let spans = [knots[0].len() - 1, knots[1].len() - 1];
        if is_height && spans[0] * spans[1] > MANY {
            return Self::Made(Heights::of(surface, degrees, knots));
        }
        let mut patches = Vec::with_capacity(spans[0] * spans[1]);
        for (strip, u) in surface.bezier_strips().zip(knots[0].windows(2)) {
            let columns = strip.knots_v().count();
            for (j, v) in knots[1].windows(2).enumerate() {
                let own = j * degrees[1]..(j + 1) * degrees[1] + 1;
                let part = |row: usize| row * columns + own.start..row * columns + own.end;
                let rows = 0..=degrees[0];
                let net: Net = rows
                    .clone()
                    .flat_map(|row| &strip.net()[part(row)])
                    .copied()
                    .collect();
                let weights: SmallVec<[f64; 16]> = rows
                    .flat_map(|row| &strip.weights()[part(row)])
                    .copied()
                    .collect();
                let (u, v) = ([u[0], u[1]], [v[0], v[1]]);
                let patch = Patch::new(degrees[0] + 1, &net, &weights, u, v);
                patches.push(Facet::new(patch));
            }
        }
        Self::Kept(patches)
    }

    pub(super) fn get(&self, at: usize) -> Cow<'_, Patch> {
        match self {
            Self::Kept(patches) => Cow::Borrowed(&patches[at].patch),
            Self::Made(heights) => Cow::Owned(heights.patch(at).measured()),
        }
    }

    /// A patch of which only points and derivatives are asked for.
    pub(super) fn bare(&self, at: usize) -> Cow<'_, Patch> {
        match self {
            Self::Kept(patches) => Cow::Borrowed(&patches[at].patch),
            Self::Made(heights) => Cow::Owned(heights.patch(at)),
        }
    }

    /// A patch with the directions of its tangents and normals.
    pub(super) fn facet(&self, at: usize) -> Cow<'_, Facet> {
        match self {
            Self::Kept(patches) => Cow::Borrowed(&patches[at]),
            Self::Made(heights) => Cow::Owned(Facet::new(heights.patch(at).measured())),
        }
    }

    /// The box of a patch.
    pub(super) fn bounds(&self, at: usize) -> Bounds {
        match self {
            Self::Kept(patches) => patches[at].patch.bounds,
            Self::Made(heights) => heights.patch(at).measured().bounds,
        }
    }
}

impl Heights {
    fn of(surface: &Surface, degrees: [usize; 2], knots: &[Vec<f64>; 2]) -> Self {
        let mut made = Self {
            x: Vec::new(),
            y: Vec::new(),
            z: Vec::new(),
            degrees,
            knots: knots.clone(),
        };
        for strip in surface.bezier_strips() {
            let columns = strip.knots_v().count();
            if made.y.is_empty() {
                made.y = strip.net()[..columns].iter().map(|p| p.y).collect();
            }
            // The first row is the last one of the strip before.
            let known = usize::from(!made.x.is_empty());
            for row in strip.net().chunks(columns).skip(known) {
                made.x.push(row[0].x);
                made.z.extend(row.iter().map(|p| p.z));
            }
        }
        made
    }

    fn patch(&self, at: usize) -> Patch {
        let columns = self.knots[1].len() - 1;
        let place = [at / columns, at % columns];
        let [i, j] = [0, 1].map(|axis| place[axis] * self.degrees[axis]);
        let mut net = patch::Net::new();
        for a in i..=i + self.degrees[0] {
            let first = a * self.y.len() + j;
            let heights = &self.z[first..=first + self.degrees[1]];
            let row = self.y[j..].iter().zip(heights);
            net.extend(row.map(|(y, z)| DVec4::new(self.x[a], *y, *z, 1.0)));
        }
        let range = |axis: usize| {
            let own = &self.knots[axis][place[axis]..];
            [own[0], own[1]]
        };
        Patch::bare(self.degrees[0] + 1, net, range(0), range(1))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;

    #[test]
    fn patches_made_where_they_are_asked_for_are_those_that_are_kept() {
        let knots = |inner: usize| {
            let inner = (1..inner).map(|k| k as f64 / inner as f64);
            let all = [0.0; 4].into_iter().chain(inner).chain([1.0; 4]);
            KnotVector::new(3, all.collect()).unwrap()
        };
        let (u, v) = (knots(150), knots(140));
        let point = |k: usize| {
            let (i, j) = (k / v.count(), k % v.count());
            let z = (i as f64 * 0.37).sin() * (j as f64 * 0.21).cos();
            DVec3::new(100.0 * u.greville(i), -50.0 + 80.0 * v.greville(j), z)
        };
        let net = (0..u.count() * v.count()).map(point).collect();
        let surface = Surface::new(u.clone(), v.clone(), net).unwrap();
        let distinct =
            |knots: &KnotVector| -> Vec<f64> { knots.distinct().iter().map(|k| k.0).collect() };
        let distinct = [distinct(&u), distinct(&v)];
        let made = Patches::of(&surface, &distinct, true);
        let kept = Patches::of(&surface, &distinct, false);
        assert!(matches!(made, Patches::Made(_)) && matches!(kept, Patches::Kept(_)));
        for at in [0, 139, 140, 8_888, 150 * 140 - 1] {
            let [made, kept] = [&made, &kept].map(|patches| patches.facet(at));
            let [made_normals, kept_normals] =
                [&made, &kept].map(|facet| facet.cones().normals.unwrap());
            let [made, kept] = [&made.patch, &kept.patch];
            assert_eq!((made.u, made.v), (kept.u, kept.v));
            assert!(made.slab().0.distance(kept.slab().0) < 1e-12);
            assert!(made_normals.0.distance(kept_normals.0) < 1e-13);
            assert!((made_normals.1 - kept_normals.1).abs() < 1e-13);
            let (u, v) = (
                0.3 * made.u[0] + 0.7 * made.u[1],
                0.6 * made.v[0] + 0.4 * made.v[1],
            );
            assert!(made.point(u, v).distance(kept.point(u, v)) < 1e-13);
            assert!(surface.point(u, v).distance(made.point(u, v)) < 1e-12);
        }
    }
}
