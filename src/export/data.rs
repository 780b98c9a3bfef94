//! What became of the files of data that a model names.

use schemars::JsonSchema;
use serde::Serialize;

use crate::features::fitted::Goal;
use crate::model::{FileSurface, SolidSpec};

/// A file of heights, and the surface that was fitted to it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DataEntry {
    /// The feature whose surface it is, or `domain.base`, `domain.top`.
    pub of: String,
    /// The file, as the model names it.
    pub file: String,
    /// The SHA-256 of what it holds.
    pub sha256: String,
    /// How it is written.
    pub format: &'static str,
    /// How many heights it has.
    pub heights: usize,
    /// How many of its nodes or points have none.
    pub nulls: usize,
    /// How many heights are near the domain: the surface is fitted to these.
    pub used: usize,
    /// How far the surface may miss a height (m); null if that was not asked for.
    pub tolerance_m: Option<f64>,
    /// How great the noise of the heights may be, as root mean square (m); null if that was not asked for.
    pub smooth_m: Option<f64>,
    /// How far the surface misses a height at most (m).
    pub most_m: f64,
    /// The root mean square of what it misses heights by (m).
    pub rms_m: f64,
    /// The control points of the surface along x and y.
    pub control_points: [usize; 2],
    /// How far apart neighbouring heights are, about (m).
    pub spacing_m: f64,
    /// How far places of the domain between the heights are from the nearest one, at most (m).
    pub filled_m: f64,
    /// How far the domain reaches beyond the convex hull of the heights (m).
    pub extrapolated_m: f64,
}

impl DataEntry {
    /// Of a feature's surface, or one of the domain's.
    pub fn of(of: &str, surface: &FileSurface) -> Self {
        let (tolerance_m, smooth_m) = match surface.goal {
            Goal::Within(tolerance) => (Some(tolerance), None),
            Goal::Noise(noise) => (None, Some(noise)),
        };
        Self {
            of: of.to_owned(),
            file: surface.file.clone(),
            sha256: surface.sha256.clone(),
            format: surface.format,
            heights: surface.heights,
            nulls: surface.nulls,
            used: surface.points.len(),
            tolerance_m,
            smooth_m,
            most_m: surface.fitted.misfit.most,
            rms_m: surface.fitted.misfit.rms,
            control_points: surface.fitted.counts,
            spacing_m: surface.coverage.spacing,
            filled_m: surface.coverage.filled,
            extrapolated_m: surface.coverage.extrapolated,
        }
    }
}

/// A solid of another program, and the file that it comes from.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ImportedEntry {
    /// The feature that it is.
    pub of: String,
    /// The file, as the model names it.
    pub file: String,
    /// The SHA-256 of what it holds.
    pub sha256: String,
    /// How it is written: STEP or BREP.
    pub format: &'static str,
    /// What it counts in: in its own words, or as the model says.
    pub unit: String,
    /// How many faces the solid has.
    pub faces: usize,
    /// Its volume as the file has it, before it is scaled and cut (m³).
    pub volume_m3: f64,
    /// How far its edges may be from its surfaces (m).
    pub tolerance_m: f64,
}

impl ImportedEntry {
    /// Of a feature.
    pub fn of(of: &str, solid: &SolidSpec) -> Self {
        Self {
            of: of.to_owned(),
            file: solid.file.clone(),
            sha256: solid.sha256.clone(),
            format: solid.format,
            unit: solid.unit.clone(),
            faces: solid.original.faces(),
            volume_m3: solid.original.volume(),
            tolerance_m: solid.original.tolerance(),
        }
    }
}
