//! The patches of a sheet: kept, or, of a large height field, made where they are asked for.
//!
//! A patch with its boxes takes some 700 bytes, for nine new heights of 8 bytes where x and y are functions of one parameter
//! each. Of a grid of 500 × 500 heights that is 170 MB or 20.

use std::borrow::Cow;

use glam::DVec3;
use smallvec::SmallVec;

use super::bounds::Bounds;
use super::patch::Patch;
use crate::nurbs::Surface;

/// Height fields with more patches than this are not kept as patches.
const MANY: usize = 20_000;

/// The patches of a sheet, u-major.
#[derive(Clone, Debug)]
pub(super) enum Patches {
    /// All of them, with cones that hold their normals.
    Kept(Vec<Patch>, Vec<Option<(DVec3, f64)>>),
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
        let whole = surface.in_patches();
        let degrees = [surface.knots_u().degree(), surface.knots_v().degree()];
        let columns = whole.knots_v().count();
        let spans = [knots[0].len() - 1, knots[1].len() - 1];
        if is_height && spans[0] * spans[1] > MANY {
            let net = whole.net();
            return Self::Made(Heights {
                x: net.iter().step_by(columns).map(|p| p.x).collect(),
                y: net[..columns].iter().map(|p| p.y).collect(),
                z: net.iter().map(|p| p.z).collect(),
                degrees,
                knots: knots.clone(),
            });
        }
        let mut patches = Vec::with_capacity(spans[0] * spans[1]);
        for i in 0..spans[0] {
            for j in 0..spans[1] {
                let rows = i * degrees[0]..=(i + 1) * degrees[0];
                let own = j * degrees[1]..(j + 1) * degrees[1] + 1;
                let range = |row: usize| row * columns + own.start..row * columns + own.end;
                let net: Net = rows
                    .clone()
                    .flat_map(|row| &whole.net()[range(row)])
                    .copied()
                    .collect();
                let weights: SmallVec<[f64; 16]> = rows
                    .flat_map(|row| &whole.weights()[range(row)])
                    .copied()
                    .collect();
                let (u, v) = (&knots[0], &knots[1]);
                let (u, v) = ([u[i], u[i + 1]], [v[j], v[j + 1]]);
                patches.push(Patch::new(degrees[0] + 1, &net, &weights, u, v));
            }
        }
        let normals = patches.iter().map(Patch::normals).collect();
        Self::Kept(patches, normals)
    }

    pub(super) fn get(&self, at: usize) -> Cow<'_, Patch> {
        match self {
            Self::Kept(patches, _) => Cow::Borrowed(&patches[at]),
            Self::Made(heights) => Cow::Owned(heights.patch(at).measured()),
        }
    }

    /// A patch of which only points and derivatives are asked for.
    pub(super) fn bare(&self, at: usize) -> Cow<'_, Patch> {
        match self {
            Self::Kept(patches, _) => Cow::Borrowed(&patches[at]),
            Self::Made(heights) => Cow::Owned(heights.patch(at)),
        }
    }

    /// A patch with a cone that holds its normals.
    pub(super) fn with_normals(&self, at: usize) -> (Cow<'_, Patch>, Option<(DVec3, f64)>) {
        let patch = self.get(at);
        let normals = match self {
            Self::Kept(_, normals) => normals[at],
            Self::Made(_) => patch.normals(),
        };
        (patch, normals)
    }

    /// The box of a patch.
    pub(super) fn bounds(&self, at: usize) -> Bounds {
        match self {
            Self::Kept(patches, _) => patches[at].bounds,
            Self::Made(heights) => heights.patch(at).bounds,
        }
    }
}

impl Heights {
    fn patch(&self, at: usize) -> Patch {
        let columns = self.knots[1].len() - 1;
        let place = [at / columns, at % columns];
        let [i, j] = [0, 1].map(|axis| place[axis] * self.degrees[axis]);
        let row = |a: usize| {
            (j..=j + self.degrees[1])
                .map(move |b| DVec3::new(self.x[a], self.y[b], self.z[a * self.y.len() + b]))
        };
        let net: Net = (i..=i + self.degrees[0]).flat_map(row).collect();
        let [u, v] = [0, 1].map(|axis| {
            [
                self.knots[axis][place[axis]],
                self.knots[axis][place[axis] + 1],
            ]
        });
        Patch::polynomial(self.degrees[0] + 1, &net, u, v)
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
        assert!(matches!(made, Patches::Made(_)) && matches!(kept, Patches::Kept(..)));
        for at in [0, 139, 140, 8_888, 150 * 140 - 1] {
            let (made, made_normals) = made.with_normals(at);
            let (kept, kept_normals) = kept.with_normals(at);
            assert_eq!((made.u, made.v), (kept.u, kept.v));
            assert_eq!(made.slab().0, kept.slab().0);
            assert_eq!(made_normals, kept_normals);
            let (u, v) = (
                0.3 * made.u[0] + 0.7 * made.u[1],
                0.6 * made.v[0] + 0.4 * made.v[1],
            );
            assert_eq!(made.point(u, v), kept.point(u, v));
            assert!(surface.point(u, v).distance(made.point(u, v)) < 1e-12);
        }
    }
}
