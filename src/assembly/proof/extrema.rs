//! Where the difference of a surface and a height has an extremum, the least differences first.
//!
//! Where a surface crosses a horizon in a closed curve, their difference in elevation has an extremum within it. On a lattice as
//! fine as the surface's patches every larger curve holds one; the smaller the difference there, the more a curve needs
//! looking for. Of two horizons the lattice is one of the plan.

use glam::{DVec2, DVec3, Vec3Swizzles};
use rayon::prelude::*;

use crate::features::body::Body;
use crate::features::side::{HorizonSheet, Side};
use crate::model::plan::AssemblyPlan;
use crate::nurbs::{KnotVector, Surface};

/// Fewest and most cells of the lattice each way.
const CELLS: [usize; 2] = [8, 64];
/// Up to so many heights all pairs are compared; of more, neighbours by their mean elevation.
const ALL_PAIRS: usize = 12;
/// Extrema of each pair.
const OF_PAIR: usize = 12;

/// How often the steps towards an extremum between the places of a lattice are halved.
const HALVINGS: u32 = 6;

/// A place in plan, and how far around it is the same cell (m).
pub(super) type Place = (DVec2, f64);

/// Values on a lattice: rows of a length; NaN where there is none.
struct Lattice {
    row: usize,
    values: Vec<f64>,
}

/// A place of a lattice that none of those around exceeds, or falls below.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Extremum {
    at: usize,
    value: f64,
    is_high: bool,
}

/// Elevations of one surface above a height, by parameters of the first.
#[derive(Clone, Copy)]
struct Above<'a> {
    /// None where parameters are places in plan.
    surface: Option<&'a Surface>,
    lower: &'a HorizonSheet,
    /// What is above, where it is a height, too.
    upper: Option<&'a HorizonSheet>,
}

/// An extremum of a difference: where it is known to be near to, and how far around.
struct Candidate<'a> {
    of: Above<'a>,
    extremum: Extremum,
    start: DVec2,
    step: DVec2,
}

impl Above<'_> {
    fn place(&self, at: DVec2) -> DVec2 {
        self.surface
            .map_or(at, |surface| surface.point(at.x, at.y).xy())
    }

    fn value(&self, at: DVec2) -> f64 {
        match (self.surface, self.upper) {
            (Some(surface), _) => {
                let p = surface.point(at.x, at.y);
                p.z - self.lower.height(p.xy())
            }
            (None, Some(upper)) => upper.height(at) - self.lower.height(at),
            (None, None) => f64::NAN,
        }
    }
}

impl Candidate<'_> {
    /// The extremum itself, by steps that are halved where none leads farther.
    fn place(&self) -> Place {
        let sign = if self.extremum.is_high { 1.0 } else { -1.0 };
        let (mut at, mut best) = (self.start, sign * self.extremum.value);
        let mut step = 0.5 * self.step;
        for _ in 0..HALVINGS {
            for way in [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y] {
                let next = at + way * step;
                let value = sign * self.of.value(next);
                if value > best {
                    (at, best) = (next, value);
                }
            }
            step *= 0.6;
        }
        let place = self.of.place(at);
        let beside = [DVec2::X, DVec2::Y]
            .map(|way| self.of.place(at + way * self.step * 0.1).distance(place));
        (place, beside[0].min(beside[1]))
    }
}

/// Places in plan where columns should pass.
pub(super) fn columns(plan: &AssemblyPlan, surfaces: &[Surface], most: usize) -> Vec<Place> {
    let sides = plan.shells.iter().filter_map(|shell| match &shell.body {
        Body::Side(side) => Some(side.as_ref()),
        _ => None,
    });
    let heights: Vec<&HorizonSheet> = sides
        .chain(plan.bounds().map(|(_, side)| side.as_ref()))
        .filter_map(Side::plan)
        .collect();
    let mut found = between_heights(plan, &heights);
    found.extend(of_surfaces(plan, surfaces, &heights));
    found.sort_by(|a, b| a.extremum.value.abs().total_cmp(&b.extremum.value.abs()));
    found.truncate(most);
    let places: Vec<Place> = found.par_iter().map(Candidate::place).collect();
    let (low, high) = (plan.low().xy(), plan.high().xy());
    let slack = 1e-4 * (high - low);
    let inside = |(at, reach): Place| (at.clamp(low + slack, high - slack), reach);
    places.into_iter().map(inside).collect()
}

/// Extrema of the differences of horizons.
fn between_heights<'a>(plan: &AssemblyPlan, sheets: &[&'a HorizonSheet]) -> Vec<Candidate<'a>> {
    let spans = |sheet: &&HorizonSheet| {
        let of = |knots: &KnotVector| knots.count() - knots.degree();
        of(sheet.surface().knots_u()).max(of(sheet.surface().knots_v()))
    };
    let cells = sheets.iter().map(spans).max().unwrap_or(0);
    let cells = cells.clamp(CELLS[0], CELLS[1]);
    let (low, high) = (plan.low().xy(), plan.high().xy());
    let cell = (high - low) / cells as f64;
    let place = |k: usize| low + cell * (DVec2::new((k % cells) as f64, (k / cells) as f64) + 0.5);
    let heights: Vec<Vec<f64>> = sheets
        .par_iter()
        .map(|sheet| {
            let all = (0..cells * cells).map(|k| sheet.height(place(k)));
            all.collect()
        })
        .collect();
    let mut order: Vec<usize> = (0..sheets.len()).collect();
    let mean = |k: &usize| heights[*k].iter().sum::<f64>();
    order.sort_by(|a, b| mean(a).total_cmp(&mean(b)));
    let mut found = Vec::new();
    for (k, &a) in order.iter().enumerate() {
        let all = sheets.len() <= ALL_PAIRS;
        let others = if all { sheets.len() } else { 1 };
        for &b in order[k + 1..].iter().take(others) {
            let pairs = heights[a].iter().zip(&heights[b]);
            let lattice = Lattice {
                row: cells,
                values: pairs.map(|(a, b)| b - a).collect(),
            };
            found.extend(lattice.extrema().into_iter().map(|extremum| Candidate {
                of: Above {
                    surface: None,
                    lower: sheets[a],
                    upper: Some(sheets[b]),
                },
                extremum,
                start: place(extremum.at),
                step: cell,
            }));
        }
    }
    found
}

/// Extrema of the elevations of surfaces above horizons.
fn of_surfaces<'a>(
    plan: &AssemblyPlan,
    surfaces: &'a [Surface],
    heights: &[&'a HorizonSheet],
) -> Vec<Candidate<'a>> {
    let (low, high) = (plan.low(), plan.high());
    let range = |surface: &Surface| {
        let points = surface.net().iter();
        points.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
            [low.min(p.z), high.max(p.z)]
        })
    };
    let heights: Vec<(&'a HorizonSheet, [f64; 2])> = heights
        .iter()
        .map(|one| (*one, range(one.surface())))
        .collect();
    let of_surface = |surface: &'a Surface| {
        let [least, most] = range(surface);
        if heights
            .iter()
            .any(|(height, _)| height.surface() == surface)
        {
            // Horizons are compared over their plan.
            return Vec::new();
        }
        let beside = heights
            .iter()
            .filter(|(_, [from, to])| least <= *to && *from <= most);
        let beside: Vec<&'a HorizonSheet> = beside.map(|one| one.0).collect();
        if beside.is_empty() {
            return Vec::new();
        }
        let [u, v] = [surface.knots_u(), surface.knots_v()].map(|knots| {
            let knots = knots.distinct();
            let middle =
                |pair: &[(f64, usize)]| (0.5 * (pair[0].0 + pair[1].0), pair[1].0 - pair[0].0);
            knots.windows(2).map(middle).collect::<Vec<(f64, f64)>>()
        });
        let at = |k: usize| (u[k / v.len()], v[k % v.len()]);
        let point = |k: usize| {
            let ((u, _), (v, _)) = at(k);
            let p = surface.point(u, v);
            let within = p.cmpge(low).all() && p.cmple(high).all();
            if within { p } else { DVec3::NAN }
        };
        let points: Vec<DVec3> = (0..u.len() * v.len()).map(point).collect();
        let mut found = Vec::new();
        for lower in beside {
            let above = |p: &DVec3| {
                if p.is_nan() {
                    f64::NAN
                } else {
                    p.z - lower.height(p.xy())
                }
            };
            let lattice = Lattice {
                row: v.len(),
                values: points.iter().map(above).collect(),
            };
            found.extend(lattice.extrema().into_iter().map(|extremum| {
                let (u, v) = at(extremum.at);
                Candidate {
                    of: Above {
                        surface: Some(surface),
                        lower,
                        upper: None,
                    },
                    extremum,
                    start: DVec2::new(u.0, v.0),
                    step: DVec2::new(u.1, v.1),
                }
            }));
        }
        found
    };
    surfaces.par_iter().flat_map_iter(of_surface).collect()
}

impl Lattice {
    /// Its extrema: those with the smallest values.
    fn extrema(&self) -> Vec<Extremum> {
        let rows = self.values.len() / self.row;
        let around = |k: usize| {
            let (i, j) = (k % self.row, k / self.row);
            let lines = j.saturating_sub(1)..=(j + 1).min(rows - 1);
            let all = lines.flat_map(move |line| {
                let places = i.saturating_sub(1)..=(i + 1).min(self.row - 1);
                places.map(move |place| line * self.row + place)
            });
            all.filter(move |other| *other != k && !self.values[*other].is_nan())
        };
        let extremum = |at: usize| {
            let value = self.values[at];
            let is_high = around(at).all(|other| self.values[other] < value);
            let is_low = around(at).all(|other| self.values[other] > value);
            (!value.is_nan() && is_high != is_low).then_some(Extremum { at, value, is_high })
        };
        let mut found: Vec<Extremum> = (0..self.values.len()).filter_map(extremum).collect();
        found.sort_by(|a, b| a.value.abs().total_cmp(&b.value.abs()));
        found.truncate(OF_PAIR);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::{Extremum, Lattice};

    #[test]
    fn every_dip_and_every_rise_of_a_lattice_is_found_with_its_size() {
        let (row, rows) = (40, 36);
        let bump = |x: f64, y: f64, at: (f64, f64)| {
            (-((x - at.0).powi(2) + (y - at.1).powi(2)) / 9.0).exp()
        };
        let value = |k: usize| {
            let (x, y) = ((k % row) as f64, (k / row) as f64);
            2.0 + 0.01 * x - 2.5 * bump(x, y, (11.0, 30.0)) + bump(x, y, (28.0, 9.0))
        };
        let lattice = Lattice {
            row,
            values: (0..row * rows).map(value).collect(),
        };
        let found = lattice.extrema();
        for (at, is_high) in [(30 * row + 11, false), (9 * row + 28, true)] {
            let value = lattice.values[at];
            assert!(found.contains(&Extremum { at, value, is_high }));
        }
        // Corners where the slope begins and ends may be extrema, too; nothing else is.
        assert!(found.len() <= 6, "{found:?}");
        assert!(found.is_sorted_by(|a, b| a.value.abs() <= b.value.abs()));
    }
}
