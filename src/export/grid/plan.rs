//! How a plan, or a height, is divided into cells: by their number, or by their size.

use glam::{DVec2, Vec3Swizzles};

use crate::features::extent::Extent;

/// Cells along an axis at most: more are a slip of the hand.
pub const MOST_ALONG: usize = 1_000_000;

/// Why numbers make no cells.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// No cells along an axis.
    #[error("there are 0 cells along {axis}; give 1 or more")]
    NoCells {
        /// The axis.
        axis: char,
    },
    /// Far too many.
    #[error(
        "there are {count} cells along {axis}; give {MOST_ALONG} at most along each axis, or larger cells"
    )]
    TooMany {
        /// The axis.
        axis: char,
        /// How many.
        count: f64,
    },
    /// A cell of no size.
    #[error("the cells' size along {axis} is {size} m; give a number above 0")]
    Size {
        /// The axis.
        axis: char,
        /// The size (m).
        size: f64,
    },
}

const AXES: [char; 3] = ['x', 'y', 'z'];

/// What a grid is asked to be along one, two or three axes.
#[derive(Clone, Debug, PartialEq)]
pub enum Division {
    /// So many cells.
    Counts(Vec<usize>),
    /// Cells of this size (m), from the lower corner of the domain on; the last ones may reach beyond it.
    Sizes(Vec<f64>),
}

impl Division {
    /// Along how many axes.
    pub fn axes(&self) -> usize {
        match self {
            Self::Counts(counts) => counts.len(),
            Self::Sizes(sizes) => sizes.len(),
        }
    }

    /// Cells along an axis of this length (m), and their size.
    pub(super) fn along(&self, at: usize, length: f64) -> Result<(usize, f64), FrameError> {
        let axis = AXES[at];
        match self {
            Self::Counts(counts) => match counts[at] {
                0 => Err(FrameError::NoCells { axis }),
                count if count > MOST_ALONG => Err(FrameError::TooMany {
                    axis,
                    count: count as f64,
                }),
                count => Ok((count, length / count as f64)),
            },
            Self::Sizes(sizes) => {
                let size = sizes[at];
                if !(size > 0.0 && size.is_finite()) {
                    return Err(FrameError::Size { axis, size });
                }
                // What rounding leaves over is no cell.
                let count = (length / size * (1.0 - 1e-12)).ceil().max(1.0);
                if count > MOST_ALONG as f64 {
                    return Err(FrameError::TooMany { axis, count });
                }
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "between 1 and a million"
                )]
                Ok((count as usize, size))
            }
        }
    }
}

/// A plan of rectangles over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The south-western corner (m).
    pub low: DVec2,
    /// A cell's extents (m).
    pub cell: DVec2,
    /// Cells along x and y.
    pub counts: [usize; 2],
}

impl Plan {
    /// Over the plan of a domain; a division may say more than is asked of it here.
    pub fn new(extent: &Extent, division: &Division) -> Result<Self, FrameError> {
        let length = (extent.high() - extent.low()).xy();
        let (nx, dx) = division.along(0, length.x)?;
        let (ny, dy) = division.along(1, length.y)?;
        Ok(Self {
            low: extent.low().xy(),
            cell: DVec2::new(dx, dy),
            counts: [nx, ny],
        })
    }

    /// The place in plan at fractions of a cell.
    pub(super) fn at(&self, i: usize, j: usize, part: DVec2) -> DVec2 {
        self.low + self.cell * (DVec2::new(i as f64, j as f64) + part)
    }
}
