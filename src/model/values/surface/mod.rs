//! Surfaces over the whole domain: level, dipping, a grid of heights, scattered points, a control net, a file of heights, or a
//! thickness above another one.

mod draw;
mod file;
mod from_file;
mod heights;
mod isochore;
mod read;
mod schema;

use schemars::JsonSchema;
use serde::Deserialize;

use super::quantity::Quantity;
use crate::features::nets::NamedNet;
use crate::model::read::{Any, Field};

pub(crate) use draw::horizon;
pub use from_file::FileSurface;
pub(crate) use schema::horizon_surface;

/// How far a surface may be from its control net if that is not said (m).
pub(crate) const NET_TOLERANCE: f64 = 0.01;

/// A surface z(x, y) over the whole domain.
#[derive(Clone, Debug, PartialEq)]
pub enum HorizonSurface {
    /// Level, at this elevation.
    Level(Quantity),
    /// A plane.
    Dipping {
        /// A point of it.
        through: [Quantity; 3],
        /// Its angle below the horizontal, degrees.
        dip_deg: Quantity,
        /// The direction of its dip, clockwise from north, degrees.
        azimuth_deg: Quantity,
    },
    /// Heights at the nodes of a regular grid, interpolated exactly.
    Grid {
        /// The first and the last column.
        x: [f64; 2],
        /// The first and the last row.
        y: [f64; 2],
        /// At least two rows from south to north, of at least two values each, from west to east.
        heights: Vec<Vec<f64>>,
    },
    /// Scattered points, approximated.
    Points {
        /// At least three, not on one line in plan.
        points: Vec<[f64; 3]>,
        /// How far from a point the surface may pass, vertically.
        tolerance: f64,
    },
    /// From a control net, approximated.
    Net {
        /// The net, over the whole domain.
        net: Box<NamedNet>,
        /// How far from it the surface may be, vertically.
        tolerance: f64,
    },
    /// Heights from a file, approximated.
    File(Box<FileSurface>),
    /// As high above another horizon as a thickness says.
    Above {
        /// Index of the feature that is the other horizon; an older one.
        horizon: usize,
        /// The thickness over the plan: level, a grid, points or a file, none of them below 0.
        thickness: Box<HorizonSurface>,
    },
}

impl HorizonSurface {
    /// The file that it comes from, or its thickness.
    pub fn file(&self) -> Option<&FileSurface> {
        match self {
            Self::File(file) => Some(file),
            Self::Above { thickness, .. } => thickness.file(),
            _ => None,
        }
    }
}

/// The table of a surface: one of `level`, `dipping`, `grid`, `points`, `net`, `file` (which has more keys), or `above` with
/// `thickness`.
#[derive(Deserialize)]
pub(crate) struct SurfaceFile {
    pub(crate) above: Option<Field<String>>,
    pub(crate) thickness: Option<Field<Any>>,
    pub(crate) level: Option<Field<Any>>,
    pub(crate) dipping: Option<Field<Any>>,
    pub(crate) grid: Option<Field<Any>>,
    pub(crate) points: Option<Field<Any>>,
    pub(crate) net: Option<Field<Any>>,
    pub(crate) tolerance: Option<Field<f64>>,
}

/// The table of a thickness: one of `grid`, `points`, `file` (which has more keys).
#[derive(Deserialize)]
pub(crate) struct ThicknessFile {
    pub(crate) grid: Option<Field<Any>>,
    pub(crate) points: Option<Field<Any>>,
    pub(crate) tolerance: Option<Field<f64>>,
}

/// A plane through a point.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Dipping")]
pub(crate) struct DippingFile {
    /// A point of the plane, [x, y, z].
    #[schemars(with = "[Quantity; 3]")]
    pub(crate) through: Field<Any>,
    /// Angle below the horizontal in degrees, from 0 to 89.
    #[schemars(with = "Quantity")]
    pub(crate) dip_deg: Field<Any>,
    /// Direction of the dip in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
}

/// Heights at the nodes of a regular grid, met exactly.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Grid")]
pub(crate) struct GridFile {
    /// [west, east]: x of the first and the last value of a row.
    pub(crate) x: Field<[f64; 2]>,
    /// [south, north]: y of the first and the last row.
    pub(crate) y: Field<[f64; 2]>,
    /// Rows from south to north, each with its heights from west to east; at least 2 × 2.
    #[schemars(with = "Vec<Vec<f64>>", length(min = 2))]
    pub(crate) heights: Field<Any>,
}
