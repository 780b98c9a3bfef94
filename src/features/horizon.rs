//! Horizons: surfaces with one height over every place in plan, on which a unit begins or ends.
//!
//! A horizon is level, a dipping plane, interpolated through a lattice of heights or fitted to scattered ones. The last
//! two are twice continuously differentiable and continued by straight lines beyond their data. As a sheet, a horizon
//! has x exactly linear in u and y in v. Sums of horizons are horizons: a thickness over the plan is one as well.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::trajectory::azimuth_vector;
use crate::nurbs::interpolate::InterpolateError;
use crate::nurbs::{KnotError, KnotVector, Lattice, LatticeError, Surface, SurfaceError};

/// How far a sheet reaches beyond the plan that it has to cover, as a fraction of the plan's extents.
pub const OVERSHOOT: f64 = 0.05;
/// Cells along the longer side of the lattices that scattered points are fitted with, coarse to fine.
const CELLS: [usize; 5] = [4, 8, 16, 32, 64];
/// Weights of bending that are tried on every lattice, smooth to exact.
const SMOOTHNESS: [f64; 3] = [1e-1, 1e-3, 1e-5];

/// Why numbers make no horizon.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HorizonError {
    /// A number is infinite or not a number.
    #[error("the horizon's {name} is {value}; give a finite number")]
    Number {
        /// What the number is.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// A dip is not between level and vertical.
    #[error("the horizon dips {dip_deg}°; give at least 0° and less than 90°")]
    Dip {
        /// The dip (°).
        dip_deg: f64,
    },
    /// Rows of a grid have different lengths.
    #[error(
        "row {row} of the horizon's grid has {found} heights, the first has {needed}; rows must be equally long"
    )]
    Ragged {
        /// The row, counted from 0 in the south.
        row: usize,
        /// Its number of heights.
        found: usize,
        /// Number of heights in the first row.
        needed: usize,
    },
    /// The heights make no lattice.
    #[error("the horizon's grid: {0}")]
    Lattice(#[from] LatticeError),
    /// There are no points.
    #[error("the horizon has no points; give at least one")]
    NoPoints,
    /// The tolerance cannot be met by anything.
    #[error("the horizon's tolerance is {0} m; give more than 0")]
    Tolerance(f64),
    /// The finest lattice is not within the tolerance.
    #[error(
        "the horizon misses point {index}, {point}, by {reached:.3} m, more than the tolerance of {tolerance} m, with \
         {cells} cells along its longer side; give a greater tolerance, or look for points above one another"
    )]
    Unreached {
        /// The worst point in the list.
        index: usize,
        /// That point.
        point: DVec3,
        /// What the best lattice reached (m).
        reached: f64,
        /// The tolerance (m).
        tolerance: f64,
        /// Cells along the longer side of the finest lattice.
        cells: usize,
    },
    /// What is left over of heights with noise is more than the noise.
    #[error(
        "the horizon's heights scatter by {reached:.3} m (root mean square) about a surface of {} × {} control points, more than \
         the noise of {noise} m that they may have; give that much or more as noise, or a tolerance that every height must be within",
        nodes[0], nodes[1]
    )]
    Rough {
        /// The noise that was given (m).
        noise: f64,
        /// What is left over with as many control points as there may be (m).
        reached: f64,
        /// How many these are.
        nodes: [usize; 2],
    },
    /// A plan to be covered is empty.
    #[error("the plan from {low} to {high} is empty; its second corner must lie beyond the first")]
    Plan {
        /// First corner.
        low: DVec2,
        /// Second corner.
        high: DVec2,
    },
    /// The heights cannot be interpolated.
    #[error("the horizon's sheet cannot be interpolated: {0}")]
    Interpolate(#[from] InterpolateError),
    /// The sheet has no knots.
    #[error("the horizon's sheet has no knots: {0}")]
    Knots(#[from] KnotError),
    /// The sheet is no surface.
    #[error("the horizon's sheet is no surface: {0}")]
    Surface(#[from] SurfaceError),
}

/// A surface with one height over every place in plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Horizon {
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Level(f64),
    Plane {
        through: DVec3,
        /// Rise per metre in x and y.
        slope: DVec2,
    },
    /// Heights above a plane: the sum of lattices, no two of which have the same nodes.
    Lattice {
        lattices: Vec<Arc<Lattice>>,
        through: DVec3,
        slope: DVec2,
    },
}

impl Horizon {
    /// A level horizon at an elevation (m).
    pub fn flat(level: f64) -> Result<Self, HorizonError> {
        finite("level", level)?;
        Ok(Self {
            shape: Shape::Level(level),
        })
    }

    /// The plane through a point that dips towards an azimuth, clockwise from north (both in rad).
    pub fn dipping(through: DVec3, dip: f64, azimuth: f64) -> Result<Self, HorizonError> {
        for value in through.to_array() {
            finite("point", value)?;
        }
        finite("azimuth", azimuth)?;
        if !(0.0..std::f64::consts::FRAC_PI_2).contains(&dip) {
            let dip_deg = dip.to_degrees();
            return Err(HorizonError::Dip { dip_deg });
        }
        let slope = -dip.tan() * azimuth_vector(azimuth);
        Ok(Self::plane(through, slope))
    }

    /// Through heights (m) at nodes evenly spaced from `x[0]` to `x[1]` and from `y[0]` to `y[1]`: rows from south to
    /// north, in them heights from west to east.
    pub fn grid(x: [f64; 2], y: [f64; 2], heights: &[Vec<f64>]) -> Result<Self, HorizonError> {
        let needed = heights.first().map_or(0, Vec::len);
        if let Some((row, own)) = heights.iter().enumerate().find(|(_, h)| h.len() != needed) {
            let found = own.len();
            return Err(HorizonError::Ragged { row, found, needed });
        }
        let turned: Vec<f64> = (0..needed)
            .flat_map(|i| heights.iter().map(move |row| row[i]))
            .collect();
        let (low, high) = (DVec2::new(x[0], y[0]), DVec2::new(x[1], y[1]));
        let counts = [needed, heights.len()];
        let lattice = Lattice::interpolated(low, high, counts, &turned)?;
        if let Some(level) = turned.first().filter(|z| turned.iter().all(|y| y == *z)) {
            return Self::flat(*level);
        }
        Ok(Self::above_plane(
            vec![Arc::new(lattice)],
            DVec3::ZERO,
            DVec2::ZERO,
        ))
    }

    /// The smoothest of a series of ever finer surfaces that is within a tolerance (m) of all points: their plane, if
    /// that is, else the plane and a lattice.
    pub fn points(points: &[DVec3], tolerance: f64) -> Result<Self, HorizonError> {
        for (index, &value) in points.iter().enumerate() {
            if !value.is_finite() {
                return Err(LatticeError::Point { index, value }.into());
            }
        }
        if !(tolerance > 0.0) {
            return Err(HorizonError::Tolerance(tolerance));
        }
        let (through, slope) = best_plane(points).ok_or(HorizonError::NoPoints)?;
        let plane = Self::plane(through, slope);
        let mut best = plane.worst(points);
        if best.1 <= tolerance {
            return Ok(plane);
        }
        let (low, high) = plan_of(points);
        let residuals: Vec<DVec3> = points
            .iter()
            .map(|p| p.xy().extend(p.z - plane.height(p.x, p.y)))
            .collect();
        for cells in CELLS {
            for smoothness in SMOOTHNESS {
                let counts = counts(high - low, cells);
                let lattice = Lattice::fitted(low, high, counts, &residuals, smoothness)?;
                let horizon = Self::above_plane(vec![Arc::new(lattice)], through, slope);
                let worst = horizon.worst(points);
                if worst.1 <= tolerance {
                    return Ok(horizon);
                }
                if worst.1 < best.1 {
                    best = worst;
                }
            }
        }
        let (index, reached) = best;
        Err(HorizonError::Unreached {
            index,
            point: points[index],
            reached,
            tolerance,
            cells: CELLS[CELLS.len() - 1],
        })
    }

    /// The horizon lower by a distance (m).
    #[must_use]
    pub fn lowered(&self, by: f64) -> Self {
        let (through, slope) = self.trend();
        Self::above_plane(self.lattices().to_vec(), through - by * DVec3::Z, slope)
    }

    /// The horizon elsewhere (m).
    #[must_use]
    pub fn moved(&self, by: DVec3) -> Self {
        if let Shape::Level(level) = self.shape {
            return Self {
                shape: Shape::Level(level + by.z),
            };
        }
        let (through, slope) = self.trend();
        let lattices = self.lattices().iter();
        let lattices = lattices.map(|lattice| Arc::new(lattice.moved(by.xy())));
        Self::above_plane(lattices.collect(), through + by, slope)
    }

    /// The horizon higher by what another one tells for every place (m).
    #[must_use]
    pub fn plus(&self, more: &Self) -> Self {
        let (through, slope) = self.trend();
        let (other_through, other_slope) = more.trend();
        let rise = other_through.z + other_slope.dot(through.xy() - other_through.xy());
        let mut lattices = self.lattices().to_vec();
        for lattice in more.lattices() {
            let sum = lattices
                .iter()
                .enumerate()
                .find_map(|(at, own)| Some((at, own.plus(lattice)?)));
            match sum {
                Some((at, sum)) => lattices[at] = Arc::new(sum),
                None => lattices.push(Arc::clone(lattice)),
            }
        }
        Self::above_plane(lattices, through + rise * DVec3::Z, slope + other_slope)
    }

    /// The lattices of which its heights above a plane are the sum.
    pub fn lattices(&self) -> &[Arc<Lattice>] {
        match &self.shape {
            Shape::Lattice { lattices, .. } => lattices,
            Shape::Level(_) | Shape::Plane { .. } => &[],
        }
    }

    /// The horizon with all heights stretched from an elevation (m), by a fraction of their distance from it.
    #[must_use]
    pub fn stretched(&self, from: f64, by: f64) -> Self {
        let factor = 1.0 + by;
        let (through, slope) = self.trend();
        let scaled = |lattice: &Arc<Lattice>| Arc::new(lattice.scaled(factor));
        let lattices = self.lattices().iter().map(scaled).collect();
        let through = through.with_z(through.z + by * (through.z - from));
        Self::above_plane(lattices, through, factor * slope)
    }

    /// The height at a place (m).
    pub fn height(&self, x: f64, y: f64) -> f64 {
        let at = DVec2::new(x, y);
        let on_plane = |through: DVec3, slope: DVec2| through.z + slope.dot(at - through.xy());
        match &self.shape {
            Shape::Level(level) => *level,
            Shape::Plane { through, slope } => on_plane(*through, *slope),
            Shape::Lattice {
                lattices,
                through,
                slope,
            } => {
                let above: f64 = lattices.iter().map(|lattice| lattice.value(at)).sum();
                on_plane(*through, *slope) + above
            }
        }
    }

    /// The height of the plane below its lattices at a place (m).
    pub fn height_of_plane(&self, x: f64, y: f64) -> f64 {
        let (through, slope) = self.trend();
        through.z + slope.dot(DVec2::new(x, y) - through.xy())
    }

    /// The elevation, if the horizon is level (m).
    pub fn level(&self) -> Option<f64> {
        match self.shape {
            Shape::Level(level) => Some(level),
            _ => None,
        }
    }

    /// Bounds of the height over a box in plan (m): the least and the greatest height of control points.
    pub fn range(&self, low: DVec3, high: DVec3) -> Result<(f64, f64), HorizonError> {
        let surface = self.graph(low.xy(), high.xy())?;
        let heights = surface.net().iter().map(|p| p.z);
        Ok(
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), z| {
                (least.min(z), most.max(z))
            }),
        )
    }

    /// The sheet over a box's plan and [`OVERSHOOT`] beyond it: u runs east and v north, both from 0 to 1.
    pub fn sheet(&self, low: DVec3, high: DVec3) -> Result<Surface, HorizonError> {
        self.sheet_beyond(low, high, OVERSHOOT)
    }

    /// The sheet over a box's plan and beyond it by a fraction of its extents.
    pub fn sheet_beyond(
        &self,
        low: DVec3,
        high: DVec3,
        overshoot: f64,
    ) -> Result<Surface, HorizonError> {
        let margin = (high - low).xy() * overshoot;
        self.graph(low.xy() - margin, high.xy() + margin)
    }

    /// The horizon over a box in plan.
    fn graph(&self, low: DVec2, high: DVec2) -> Result<Surface, HorizonError> {
        if !(low.is_finite() && high.is_finite() && high.cmpgt(low).all()) {
            return Err(HorizonError::Plan { low, high });
        }
        let lattices: Vec<&Lattice> = self.lattices().iter().map(Arc::as_ref).collect();
        let (u, v, heights) = if lattices.is_empty() {
            let knots = KnotVector::uniform(1, 2)?;
            (knots.clone(), knots, vec![0.0; 4])
        } else {
            Lattice::part(&lattices, low, high)?
        };
        let (through, slope) = self.trend();
        let plane = Self::plane(through, slope);
        let nv = v.count();
        let mut net = Vec::with_capacity(heights.len());
        for (k, height) in heights.into_iter().enumerate() {
            let part = DVec2::new(u.greville(k / nv), v.greville(k % nv));
            let at = low + (high - low) * part;
            net.push(at.extend(height + plane.height(at.x, at.y)));
        }
        Ok(Surface::new(u, v, net)?)
    }

    /// A lattice above a plane.
    pub(super) fn above(lattice: Lattice, through: DVec3, slope: DVec2) -> Self {
        Self::above_plane(vec![Arc::new(lattice)], through, slope)
    }

    /// The plane through a point that rises so much per metre in x and y.
    pub(super) fn plane(through: DVec3, slope: DVec2) -> Self {
        let shape = if slope == DVec2::ZERO {
            Shape::Level(through.z)
        } else {
            Shape::Plane { through, slope }
        };
        Self { shape }
    }

    fn above_plane(lattices: Vec<Arc<Lattice>>, through: DVec3, slope: DVec2) -> Self {
        if lattices.is_empty() {
            return Self::plane(through, slope);
        }
        let shape = Shape::Lattice {
            lattices,
            through,
            slope,
        };
        Self { shape }
    }

    /// The plane below the lattices: a point of it, and its rise per metre in x and y.
    fn trend(&self) -> (DVec3, DVec2) {
        match &self.shape {
            Shape::Level(level) => (DVec3::new(0.0, 0.0, *level), DVec2::ZERO),
            Shape::Plane { through, slope } | Shape::Lattice { through, slope, .. } => {
                (*through, *slope)
            }
        }
    }

    /// The point that is missed most, and by how much.
    fn worst(&self, points: &[DVec3]) -> (usize, f64) {
        let misses = points
            .iter()
            .map(|p| (self.height(p.x, p.y) - p.z).abs())
            .enumerate();
        misses.fold(
            (0, 0.0),
            |worst, own| {
                if own.1 > worst.1 { own } else { worst }
            },
        )
    }
}

fn finite(name: &'static str, value: f64) -> Result<(), HorizonError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(HorizonError::Number { name, value })
    }
}

/// The plane of least squares, without a slope in directions in which the points do not spread.
pub(super) fn best_plane(points: &[DVec3]) -> Option<(DVec3, DVec2)> {
    if points.is_empty() {
        return None;
    }
    let centre = points.iter().sum::<DVec3>() / points.len() as f64;
    let (mut xx, mut xy, mut yy, mut z) = (0.0, 0.0, 0.0, DVec2::ZERO);
    for point in points {
        let off = *point - centre;
        xx += off.x * off.x;
        xy += off.x * off.y;
        yy += off.y * off.y;
        z += off.xy() * off.z;
    }
    // Principal directions of the plan, and the slope along each.
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let spread = xx + yy;
    let mut slope = DVec2::ZERO;
    for axis in [DVec2::from_angle(angle), DVec2::from_angle(angle).perp()] {
        let own = xx * axis.x * axis.x + 2.0 * xy * axis.x * axis.y + yy * axis.y * axis.y;
        // Narrower than a ten-thousandth of the length is a line.
        if own > 1e-8 * spread {
            slope += axis * (z.dot(axis) / own);
        }
    }
    Some((centre, slope))
}

/// The points' box in plan; no side is shorter than a tenth of the other.
fn plan_of(points: &[DVec3]) -> (DVec2, DVec2) {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = points
        .iter()
        .fold(empty, |(low, high), p| (low.min(p.xy()), high.max(p.xy())));
    let tenth = 0.1 * (high - low).max_element();
    // Points all above one place have no extent to take a part of.
    let least = if tenth > 0.0 { tenth } else { 1.0 };
    let margin = (DVec2::splat(least) - (high - low)).max(DVec2::ZERO) / 2.0;
    (low - margin, high + margin)
}

/// Nodes along x and y for about square cells.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a length over a positive fraction of the longest is between 0 and the number of cells"
)]
fn counts(extent: DVec2, cells: usize) -> [usize; 2] {
    let size = extent.max_element() / cells as f64;
    let along = |length: f64| ((length / size).round() as usize).max(1) + 1;
    [along(extent.x), along(extent.y)]
}

#[cfg(test)]
#[path = "horizon_tests.rs"]
mod tests;
