//! Lines of equal u and v that are close enough for a grid of their crossings to carry triangles: as far apart along each
//! parameter as curves of the surface along it allow. What bends across both is left to refinement.

use glam::DVec3;

use super::fineness::{Limits, nearest_on_segment};
use crate::nurbs::{KnotVector, Surface};

/// Curves along a parameter that are asked.
const CURVES: usize = 9;
/// Places on each, per span of knots, at least and at most.
const PLACES: (usize, usize) = (2, 8);
/// Places of all spans that are enough.
const ENOUGH: usize = 32;
/// Places between the ends of a chord that are compared with it.
const BETWEEN: usize = 8;
/// Into how many parts one stretch between two places may be divided.
const PARTS: usize = 64;

/// Lines of equal u, and of equal v, first and last on the box's sides.
pub(super) fn lines(surface: &Surface, u: [f64; 2], v: [f64; 2], limits: &Limits) -> [Vec<f64>; 2] {
    let along_u = Along {
        range: u,
        knots: surface.knots_u(),
        across: across(surface.knots_v(), v),
        point: &|u, v| surface.point(u, v),
        limits,
    };
    let along_v = Along {
        range: v,
        knots: surface.knots_v(),
        across: across(surface.knots_u(), u),
        point: &|v, u| surface.point(u, v),
        limits,
    };
    [along_u.lines(), along_v.lines()]
}

/// Knots within a range, with its ends.
fn within(knots: &KnotVector, [from, to]: [f64; 2]) -> Vec<f64> {
    let mut all = vec![from];
    let distinct = knots.distinct().into_iter().map(|(knot, _)| knot);
    all.extend(distinct.filter(|knot| from < *knot && *knot < to));
    all.push(to);
    all
}

/// Where curves along the other parameter are asked: at the ends, and in the middles of spans.
fn across(knots: &KnotVector, range: [f64; 2]) -> Vec<f64> {
    let knots = within(knots, range);
    let middles: Vec<f64> = knots
        .windows(2)
        .map(|pair| 0.5 * (pair[0] + pair[1]))
        .collect();
    let step = middles.len().div_ceil(CURVES - 2).max(1);
    let mut all = vec![range[0]];
    all.extend(middles.iter().skip(step / 2).step_by(step));
    all.push(range[1]);
    all
}

struct Along<'a> {
    range: [f64; 2],
    knots: &'a KnotVector,
    across: Vec<f64>,
    /// Of this parameter and the other one.
    point: &'a dyn Fn(f64, f64) -> DVec3,
    limits: &'a Limits,
}

impl Along<'_> {
    fn row(&self, at: f64) -> Vec<DVec3> {
        self.across
            .iter()
            .map(|other| (self.point)(at, *other))
            .collect()
    }

    fn lines(&self) -> Vec<f64> {
        let knots = within(self.knots, self.range);
        let pieces = ENOUGH.div_ceil(knots.len() - 1).clamp(PLACES.0, PLACES.1);
        let mut places = vec![self.range[0]];
        for pair in knots.windows(2) {
            let step = (pair[1] - pair[0]) / pieces as f64;
            places.extend((1..pieces).map(|k| pair[0] + step * k as f64));
            places.push(pair[1]);
        }
        let rows: Vec<Vec<DVec3>> = places.iter().map(|at| self.row(*at)).collect();
        let mut lines = vec![places[0]];
        let mut from = 0;
        while from + 1 < places.len() {
            let mut to = from + 1;
            while to + 1 < places.len() && self.fits(&rows[from..=to + 1]) {
                to += 1;
            }
            if to == from + 1 {
                lines.extend(self.parts([places[from], places[to]]));
            }
            lines.push(places[to]);
            from = to;
        }
        lines
    }

    /// Lines between two places that are too far apart; none if they are not.
    fn parts(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let mut count = 1;
        loop {
            let at = |k: usize| from + (to - from) * k as f64 / (2 * count) as f64;
            let rows: Vec<Vec<DVec3>> = (0..=2 * count).map(|k| self.row(at(k))).collect();
            let fit = (0..count).all(|k| self.fits(&rows[2 * k..=2 * k + 2]));
            if fit || count >= PARTS {
                return (1..count).map(|k| at(2 * k)).collect();
            }
            count *= 2;
        }
    }

    /// Whether chords from the first row to the last one are near enough to those between, and turn little.
    fn fits(&self, rows: &[Vec<DVec3>]) -> bool {
        let last = rows.len() - 1;
        let step = (last - 1).div_ceil(BETWEEN).max(1);
        (0..self.across.len()).all(|s| {
            let (a, b) = (rows[0][s], rows[last][s]);
            let is_near = |row: &Vec<DVec3>| {
                row[s].distance(nearest_on_segment(row[s], a, b)) <= self.limits.chord
            };
            let start = (rows[1][s] - a).try_normalize();
            let end = (b - rows[last - 1][s]).try_normalize();
            rows[1..last].iter().step_by(step).all(is_near)
                && self.limits.turns_little(a.distance(b), start, end)
        })
    }
}
