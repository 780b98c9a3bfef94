//! Horizons from control nets of one's own: their heights at the nodes of a lattice, fine enough for a tolerance.
//!
//! A horizon has one height over every place, and sums with others (a bed's thickness above it, what it gives way by). A net has neither, since
//! weights and knots bend its plan; so its heights are asked for along upright lines, and interpolated. Each lattice is held to the net
//! halfway between its nodes, where a cubic spline is farthest from what it interpolates, and has half the spacing of the one before it.
//! What has kinks converges too slowly, and is refused.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::horizon::{Horizon, HorizonError};
use super::nets::{Nets, NetsError};
use crate::nurbs::pierce::{Line, Target};

/// Cells along the longer side of the coarsest and of the finest lattice.
const CELLS: [usize; 2] = [4, 64];
/// How far the lattice reaches beyond the domain, as a fraction of its extents: less far than the sheets do, and so that nodes are on no
/// round numbers, where control nets have their seams.
const BEYOND: [f64; 2] = [0.013_7, 0.014_9];
/// What is nearer than this fraction of the domain's diagonal to a sheet's border is not clear of it.
const NEAR: f64 = 1e-10;

/// Why a net is no horizon.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NetHorizonError {
    /// The net is no sheet over the domain.
    #[error(transparent)]
    Nets(#[from] NetsError),
    /// An upright line does not pass through it just once.
    #[error("it has no single elevation at ({:.3}, {:.3})", at.x, at.y)]
    NoHeight {
        /// The place in plan.
        at: DVec2,
    },
    /// The finest lattice is not within the tolerance.
    #[error(
        "at ({:.3}, {:.3}) a smooth surface with {cells} cells along its longer side is {reached:.2e} m from it, more than the tolerance of \
         {tolerance} m: give a greater `tolerance`, or, where it has kinks, divide the domain by a feature of the kind sheet", at.x, at.y
    )]
    Unreached {
        /// The worst place.
        at: DVec2,
        /// How far it is off there (m).
        reached: f64,
        /// The tolerance (m).
        tolerance: f64,
        /// Cells along the longer side.
        cells: usize,
    },
    /// The heights make no horizon.
    #[error(transparent)]
    Horizon(#[from] HorizonError),
}

/// The horizon that is within a tolerance (m) of a net that covers a domain, with how far it is off halfway between nodes (m).
pub fn horizon(
    nets: &Nets,
    [low, high]: [DVec3; 2],
    tolerance: f64,
) -> Result<(Horizon, f64), NetHorizonError> {
    let side = nets.above(low, high)?;
    let targets: Vec<Target<'_>> = side.sheets().iter().map(Target::new).collect();
    let size = high - low;
    let near = NEAR * size.length();
    let height = |at: DVec2| {
        let line = Line::whole(2, at.extend(0.0));
        let mut found = Vec::new();
        for target in &targets {
            let passages = target.passages(line, near);
            found.extend(passages.ok_or(NetHorizonError::NoHeight { at })?);
        }
        match found.as_slice() {
            [one] => Ok(one.point.z),
            _ => Err(NetHorizonError::NoHeight { at }),
        }
    };
    let from = low.xy() - BEYOND[0] * size.xy();
    let to = high.xy() + BEYOND[1] * size.xy();
    let mut cells = coarsest(to - from);
    let mut heights = Grid::asked([from, to], cells, &height)?;
    loop {
        let horizon = heights.horizon()?;
        cells = cells.map(|along| 2 * along);
        let finer = Grid::asked([from, to], cells, &height)?;
        let (at, reached) = finer.farthest(&horizon);
        if reached <= tolerance {
            return Ok((horizon, reached));
        }
        let finest = cells[0].max(cells[1]);
        if finest > CELLS[1] {
            return Err(NetHorizonError::Unreached {
                at,
                reached,
                tolerance,
                cells: CELLS[1],
            });
        }
        heights = finer;
    }
}

/// About square cells of the coarsest lattice over a plan, along x and y.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a part of a small positive number is between 0 and that"
)]
fn coarsest(size: DVec2) -> [usize; 2] {
    let along = |length: f64| (length / size.max_element() * CELLS[0] as f64).ceil() as usize;
    [along(size.x).max(1), along(size.y).max(1)]
}

/// Heights at the nodes of a grid.
struct Grid {
    corners: [DVec2; 2],
    /// Rows from south to north, each from west to east.
    heights: Vec<Vec<f64>>,
}

impl Grid {
    /// As `height` tells them, with this many cells along x and y.
    fn asked(
        corners: [DVec2; 2],
        cells: [usize; 2],
        height: &dyn Fn(DVec2) -> Result<f64, NetHorizonError>,
    ) -> Result<Self, NetHorizonError> {
        let size = corners[1] - corners[0];
        let part = |k: usize, along: usize| k as f64 / along as f64;
        let place = |i: usize, j: usize| {
            corners[0] + size * DVec2::new(part(i, cells[0]), part(j, cells[1]))
        };
        let row = |j: usize| (0..=cells[0]).map(|i| height(place(i, j))).collect();
        let heights: Result<Vec<Vec<f64>>, NetHorizonError> = (0..=cells[1]).map(row).collect();
        Ok(Self {
            corners,
            heights: heights?,
        })
    }

    fn horizon(&self) -> Result<Horizon, HorizonError> {
        let [low, high] = self.corners;
        Horizon::grid([low.x, high.x], [low.y, high.y], &self.heights)
    }

    /// The node from which a horizon is farthest, and how far that is (m).
    fn farthest(&self, horizon: &Horizon) -> (DVec2, f64) {
        let [low, high] = self.corners;
        let (rows, columns) = (self.heights.len(), self.heights[0].len());
        let mut worst = (low, 0.0);
        for (j, row) in self.heights.iter().enumerate() {
            for (i, z) in row.iter().enumerate() {
                let part = DVec2::new(
                    i as f64 / (columns - 1) as f64,
                    j as f64 / (rows - 1) as f64,
                );
                let at = low + (high - low) * part;
                let off = (horizon.height(at.x, at.y) - z).abs();
                // Written so that a number that is none counts.
                if !(off <= worst.1) {
                    worst = (at, off);
                }
            }
        }
        worst
    }
}
