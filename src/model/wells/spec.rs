//! Checked wells.

use glam::DVec3;

use crate::features::well::{Path, Well};
use crate::model::place::Place;

/// A unit of length in which depths of a well are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthUnit {
    /// As it stands in files: `m`, `ft` or `us-ft`.
    pub name: &'static str,
    /// One of it in metres.
    pub metres: f64,
}

/// Metres.
pub const METRE: DepthUnit = DepthUnit {
    name: "m",
    metres: 1.0,
};

/// A file that a survey comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SurveySource {
    /// The file, as the model names it.
    pub file: String,
    /// The SHA-256 of what it holds.
    pub sha256: String,
    /// How it is written.
    pub format: &'static str,
    /// How many rows it has.
    pub rows: usize,
    /// How many more had values missing.
    pub dropped: usize,
}

/// A well, or a lateral of one.
#[derive(Clone, Debug, PartialEq)]
pub struct WellSpec {
    /// Its name: its id, or that of its mother, a slash and its id.
    pub name: String,
    /// Index of the well that it leaves, of a lateral.
    pub mother: Option<usize>,
    /// Its path in the model's coordinates, with measured depths in metres.
    pub well: Well,
    /// How its stations are joined.
    pub path: Path,
    /// The elevation of its depth reference above mean sea level (m).
    pub datum: f64,
    /// The elevation of mean sea level in the model's coordinates (m).
    pub sea_level: f64,
    /// The unit in which its survey is written, and its logs are.
    pub unit: DepthUnit,
    /// Where it is open, by measured depth (m): in order, and apart.
    pub completions: Vec<[f64; 2]>,
    /// Diameter of the hole (m), if it is given.
    pub diameter: Option<f64>,
    /// The file that its survey comes from.
    pub source: Option<SurveySource>,
    /// Where the model defines it.
    pub place: Place,
}

/// A horizon picked in a well.
#[derive(Clone, Debug, PartialEq)]
pub struct TopSpec {
    /// Index of the well.
    pub well: usize,
    /// Index of the horizon among the features.
    pub horizon: usize,
    /// Measured depth (m).
    pub md: f64,
    /// The place.
    pub point: DVec3,
}

impl WellSpec {
    /// Depth below mean sea level (m).
    pub fn tvdss(&self, point: DVec3) -> f64 {
        self.sea_level - point.z
    }

    /// How much of a range of measured depth is open (m).
    pub fn open(&self, [from, to]: [f64; 2]) -> f64 {
        let common = |[top, base]: &[f64; 2]| (base.min(to) - top.max(from)).max(0.0);
        // The sum of nothing is −0.
        self.completions
            .iter()
            .map(common)
            .fold(0.0, |sum, own| sum + own)
    }
}
