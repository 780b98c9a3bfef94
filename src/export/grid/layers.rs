//! Layers of cells that follow a model's horizons: upright pillars, and layers that divide what lies between two of these evenly.
//!
//! At each pillar the horizons are put in order from oldest to youngest, as rocks lie: an erosive one cuts all older ones there, one
//! that onlaps, or is given by its thickness above another one, lies no lower than that; the domain's base and top bound all. What
//! lies between two that coincide has no thickness there. Which volume holds a cell is asked of the point evaluator in any case:
//! layers only say where the cells are.

use glam::{DVec2, DVec3, Vec3Swizzles};
use rayon::prelude::*;

use super::plan::Plan;
use crate::features::body::Body;
use crate::features::extent::Extent;
use crate::features::side::Side;
use crate::model::realisation::Realisation;

/// Layers of one interval at most.
pub const MOST_LAYERS: usize = 100_000;

/// Why a model has no such layers.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LayersError {
    /// There is no layer between two horizons.
    #[error("there are {count} layers in {interval}; give 1 to {MOST_LAYERS} for each interval")]
    Count {
        /// What is divided.
        interval: String,
        /// How many were asked for.
        count: usize,
    },
    /// There are not as many numbers as intervals.
    #[error(
        "there are {given} numbers of layers and {needed} intervals, from the base up: {names}; \
         give a number for each, or one for all"
    )]
    Intervals {
        /// How many numbers were given.
        given: usize,
        /// How many intervals there are.
        needed: usize,
        /// Their names.
        names: String,
    },
    /// A horizon is no height over the plan.
    #[error(
        "the horizon of {volume} has no one height at {x}, {y}: layers cannot follow it; leave out --layers for a grid of boxes"
    )]
    NoHeight {
        /// The volume above the horizon.
        volume: String,
        /// Easting (m).
        x: f64,
        /// Northing (m).
        y: f64,
    },
    /// Nothing has any thickness.
    #[error(
        "no two horizons are apart at any of the grid's pillars; take more cells along x and y"
    )]
    Nothing,
}

/// What lies between two successive surfaces, and its layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    /// The unit that it is: that of the horizon below.
    pub name: String,
    /// How many layers divide it.
    pub layers: usize,
    /// The surfaces at the pillars (m): below, then above.
    below: usize,
    above: usize,
}

/// The layers of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    plan: Plan,
    /// Elevations at the pillars, eastward, then northward (m): of each surface.
    surfaces: Vec<Vec<f64>>,
    /// From the base up.
    intervals: Vec<Interval>,
    /// For each layer from the base up: its interval, and its number in that.
    in_interval: Vec<(usize, usize)>,
    /// What is thinner has no thickness (m).
    least: f64,
}

/// A horizon as it bounds units.
struct Bound<'a> {
    volume: usize,
    side: &'a Side,
    /// Whether it cuts what is older.
    is_erosive: bool,
    /// The volume that it lies no lower than.
    above: Option<usize>,
}

impl Layers {
    /// Layers between a realisation's horizons: one number of layers for all intervals, or one for each from the base up.
    /// Intervals that have no thickness at any pillar are none.
    pub fn new(
        realisation: &Realisation,
        plan: Plan,
        numbers: &[usize],
    ) -> Result<Self, LayersError> {
        let extent = &realisation.extent;
        let bounds = bounds(realisation);
        let surfaces = surfaces(realisation, extent, &plan, &bounds)?;
        let least = extent.same_level();
        let name = |at: usize| match at.checked_sub(1) {
            None => realisation.volumes[0].name.clone(),
            Some(at) => realisation.volumes[bounds[at].volume].name.clone(),
        };
        let is_thick = |pair: &[Vec<f64>]| {
            let mut apart = pair[0].iter().zip(&pair[1]);
            apart.any(|(below, above)| above - below > least)
        };
        let thick: Vec<usize> = (0..surfaces.len() - 1)
            .filter(|at| is_thick(&surfaces[*at..at + 2]))
            .collect();
        if thick.is_empty() {
            return Err(LayersError::Nothing);
        }
        if numbers.len() != 1 && numbers.len() != thick.len() {
            let names: Vec<String> = thick.iter().map(|at| name(*at)).collect();
            return Err(LayersError::Intervals {
                given: numbers.len(),
                needed: thick.len(),
                names: names.join(", "),
            });
        }
        let mut intervals = Vec::with_capacity(thick.len());
        for (number, below) in thick.into_iter().enumerate() {
            let layers = numbers[number.min(numbers.len() - 1)];
            if layers == 0 || layers > MOST_LAYERS {
                return Err(LayersError::Count {
                    interval: name(below),
                    count: layers,
                });
            }
            intervals.push(Interval {
                name: name(below),
                layers,
                below,
                above: below + 1,
            });
        }
        let each = intervals.iter().enumerate();
        let in_interval = each
            .flat_map(|(at, interval)| (0..interval.layers).map(move |number| (at, number)))
            .collect();
        Ok(Self {
            plan,
            surfaces,
            intervals,
            in_interval,
            least,
        })
    }

    /// Their plan.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// How many layers there are.
    pub fn count(&self) -> usize {
        self.in_interval.len()
    }

    /// What they divide, from the base up.
    pub fn intervals(&self) -> &[Interval] {
        &self.intervals
    }

    /// The elevation at a pillar of a layer's base (`false`) or top (m).
    pub(super) fn elevation(&self, [i, j]: [usize; 2], layer: usize, part: f64) -> f64 {
        let (at, number) = self.in_interval[layer];
        let interval = &self.intervals[at];
        let pillar = j * (self.plan.counts[0] + 1) + i;
        let below = self.surfaces[interval.below][pillar];
        let above = self.surfaces[interval.above][pillar];
        let part = (number as f64 + part) / interval.layers as f64;
        // Exactly the surfaces at both ends, and never beyond them.
        if part >= 1.0 {
            above
        } else {
            (below + (above - below) * part).min(above)
        }
    }

    /// The lowest and the highest elevation of a pillar (m).
    pub(super) fn pillar(&self, at: [usize; 2]) -> [f64; 2] {
        [
            self.elevation(at, 0, 0.0),
            self.elevation(at, self.count() - 1, 1.0),
        ]
    }

    /// Over a cell's plan at fractions of it, by the four pillars.
    fn bilinear(&self, [i, j, k]: [usize; 3], part: DVec3) -> f64 {
        let at = |di: usize, dj: usize| self.elevation([i + di, j + dj], k, part.z);
        let south = at(0, 0) + (at(1, 0) - at(0, 0)) * part.x;
        let north = at(0, 1) + (at(1, 1) - at(0, 1)) * part.x;
        south + (north - south) * part.y
    }

    /// The mean thickness of a cell (m).
    pub(super) fn thickness(&self, cell: [usize; 3]) -> f64 {
        let middle = DVec2::splat(0.5);
        self.bilinear(cell, middle.extend(1.0)) - self.bilinear(cell, middle.extend(0.0))
    }

    /// The place at fractions of a cell; none if the cell has no thickness.
    pub(super) fn at(&self, [i, j, k]: [usize; 3], part: DVec3) -> Option<DVec3> {
        if !(self.thickness([i, j, k]) > self.least) {
            return None;
        }
        let z = self.bilinear([i, j, k], part);
        Some(self.plan.at(i, j, part.xy()).extend(z))
    }
}

/// The horizons of a realisation, from the oldest to the youngest.
fn bounds(realisation: &Realisation) -> Vec<Bound<'_>> {
    let horizons = realisation.instances.iter().filter_map(|instance| {
        let rules = &realisation.volumes[instance.volume];
        let Body::Side(side) = &instance.body else {
            return None;
        };
        (rules.kind == "horizon" && !side.is_everywhere()).then_some(Bound {
            volume: instance.volume,
            side,
            is_erosive: rules.from.is_none(),
            above: rules.above,
        })
    });
    horizons.collect()
}

/// The elevations of the domain's base, of the horizons and of the domain's top at all pillars.
fn surfaces(
    realisation: &Realisation,
    extent: &Extent,
    plan: &Plan,
    bounds: &[Bound<'_>],
) -> Result<Vec<Vec<f64>>, LayersError> {
    let [nx, ny] = plan.counts;
    let [base, top] = extent.bounds();
    let height = |side: &Side, at: DVec2, volume: &str| {
        side.height(at).ok_or_else(|| LayersError::NoHeight {
            volume: volume.to_owned(),
            x: at.x,
            y: at.y,
        })
    };
    let pillar = |number: usize| -> Result<Vec<f64>, LayersError> {
        let (i, j) = (number % (nx + 1), number / (nx + 1));
        let at = plan.at(i, j, DVec2::ZERO);
        let limit = |side: Option<&Side>, level: f64, name: &str| match side {
            None => Ok(level),
            Some(side) => height(side, at, name),
        };
        let low = limit(base.as_deref(), extent.low().z, "the domain's base")?;
        let high = limit(top.as_deref(), extent.high().z, "the domain's top")?;
        // The base is the oldest of all.
        let mut column = Vec::with_capacity(bounds.len() + 2);
        column.push(low);
        for (number, bound) in bounds.iter().enumerate() {
            let name = &realisation.volumes[bound.volume].name;
            let mut own = height(bound.side, at, name)?.max(low);
            let of = |volume: usize| bounds[..number].iter().position(|one| one.volume == volume);
            if let Some(below) = bound.above.and_then(of) {
                own = own.max(column[below + 1]);
            }
            if bound.is_erosive {
                for older in &mut column[1..] {
                    *older = older.min(own);
                }
            } else if let Some(last) = column.last() {
                own = own.max(*last);
            }
            column.push(own);
        }
        column.push(high);
        // Monotone by construction but for the top, which bounds all.
        for z in &mut column {
            *z = z.min(high);
        }
        Ok(column)
    };
    let columns = (0..(nx + 1) * (ny + 1))
        .into_par_iter()
        .map(pillar)
        .collect::<Result<Vec<_>, _>>()?;
    let of = |surface: usize| columns.iter().map(|column| column[surface]).collect();
    Ok((0..bounds.len() + 2).map(of).collect())
}
