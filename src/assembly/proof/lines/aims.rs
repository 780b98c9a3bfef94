//! Which lines are followed, each with others to take if it is not clear.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::assembly::proof::{Prover, extrema};
use crate::model::Stream;
use crate::nurbs::Surface;
use crate::nurbs::pierce::Line;

/// Columns each way over the plan.
const COLUMNS: usize = 10;
/// Lines through patches of bodies.
const OF_BODIES: usize = 128;
/// How often a line that is not clear is drawn again.
pub(super) const TRIES: usize = 6;
/// Questions to the point evaluator, in bodies that each of them asks at most: with more bodies there are fewer columns, …
const QUESTIONS: usize = 2_000_000;
/// … but never fewer than this each way.
const LEAST_COLUMNS: usize = 5;

/// Lines of which the first clear one is followed.
pub(super) enum Aim<'a> {
    Columns(Vec<Line>),
    /// Across a patch of a surface, given by its parameters, near its middle.
    Patch(&'a Surface, [[f64; 2]; 2]),
}

impl Aim<'_> {
    pub(super) fn line(&self, k: usize) -> Option<Line> {
        match self {
            Self::Columns(lines) => lines.get(k).copied(),
            Self::Patch(surface, patch) => {
                let [u, v] = place(*patch, k);
                Some(across(surface.point(u, v), surface.normal(u, v)?))
            }
        }
    }
}

/// Parameters near the middle of a patch, others for each try.
fn place([[u0, u1], [v0, v1]]: [[f64; 2]; 2], k: usize) -> [f64; 2] {
    let part = 0.43 + 0.037 * k as f64;
    [u0 + part * (u1 - u0), v0 + (0.97 - part) * (v1 - v0)]
}

impl Prover<'_> {
    /// Lines that everything along is asked for, each with others to take if it is not clear.
    pub(super) fn thorough_lines<'b>(&self, surfaces: &'b [Surface]) -> Vec<Aim<'b>> {
        let bodies = self.plan.bodies.len() + 1;
        let affordable = (QUESTIONS / (bodies * bodies)).isqrt();
        let each = affordable.clamp(LEAST_COLUMNS, COLUMNS);
        let (low, size) = (self.plan.low(), self.plan.high() - self.plan.low());
        let mut stream = Stream::new(self.options.seed, "proof", "all", "columns", 0);
        let mut lines = Vec::with_capacity(each * each + OF_BODIES);
        for i in 0..each * each {
            let cell = DVec2::new((i % each) as f64, (i / each) as f64);
            let column = |_: usize| {
                let part = (cell + DVec2::new(stream.unit(), stream.unit())) / each as f64;
                Line::whole(2, low + size * part.extend(0.0))
            };
            lines.push(Aim::Columns((0..TRIES).map(column).collect()));
        }
        let extrema = extrema::columns(self.plan, surfaces, each * each);
        lines.extend(extrema.iter().map(|(place, reach)| {
            let column = |k: usize| {
                let turn = DVec2::from_angle(2.4 * k as f64) * *reach * (k as f64 / TRIES as f64);
                Line::whole(2, (*place + turn).extend(0.0))
            };
            Aim::Columns((0..TRIES).map(column).collect())
        }));
        lines.extend(self.through_bodies(surfaces, (2 * each * each).min(OF_BODIES)));
        lines
    }

    /// Lines across patches of surfaces, near their middles.
    fn through_bodies<'b>(&self, surfaces: &'b [Surface], most: usize) -> Vec<Aim<'b>> {
        let (low, high) = (self.plan.low(), self.plan.high());
        let mut places = Vec::new();
        for surface in surfaces {
            let [u, v] = [surface.knots_u(), surface.knots_v()].map(|knots| {
                knots
                    .distinct()
                    .iter()
                    .map(|knot| knot.0)
                    .collect::<Vec<_>>()
            });
            for u in u.windows(2) {
                for v in v.windows(2) {
                    places.push((surface, [[u[0], u[1]], [v[0], v[1]]]));
                }
            }
        }
        // Patches outside of the domain are none; a subset that is spread evenly stands for very many.
        let thinned = |places: Vec<(&'b Surface, [[f64; 2]; 2])>, most: usize| {
            let step = places.len().div_ceil(most.max(1)).max(1);
            places.into_iter().step_by(step).collect::<Vec<_>>()
        };
        let is_within = |(surface, patch): &(&Surface, [[f64; 2]; 2])| {
            let [u, v] = place(*patch, 0);
            let point = surface.point(u, v);
            point.cmpge(low).all() && point.cmple(high).all()
        };
        let within: Vec<_> = thinned(places, 8 * most)
            .into_par_iter()
            .filter(is_within)
            .collect();
        let aims = thinned(within, most).into_iter();
        aims.map(|(surface, patch)| Aim::Patch(surface, patch))
            .collect()
    }
}

/// The line through a point along the axis that its normal is nearest to.
pub(super) fn across(point: DVec3, normal: DVec3) -> Line {
    let size = normal.abs();
    let axis = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
    Line::whole(axis, point)
}
