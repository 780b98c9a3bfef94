//! What became of a file of heights.

use std::fmt::Write as _;

use glam::DVec2;

use crate::features::coverage::Coverage;
use crate::features::fitted::{Fitted, Goal};

/// A surface fitted to the heights of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct FileSurface {
    /// The file, as the model names it.
    pub file: String,
    /// The SHA-256 of what it holds, in hexadecimal.
    pub sha256: String,
    /// How it is written.
    pub format: &'static str,
    /// How many heights it has.
    pub heights: usize,
    /// How many of its nodes or points have none.
    pub nulls: usize,
    /// The heights near the domain, to which the surface is fitted, in the model's coordinates.
    pub points: Vec<[f64; 3]>,
    /// How near to them it is to be.
    pub goal: Goal,
    /// The surface.
    pub fitted: Fitted,
    /// How far the domain is from them.
    pub coverage: Coverage,
}

impl FileSurface {
    /// How far the surface may be from what it is fitted to, at a place (m): of noise three times its root mean square.
    pub fn tolerance(&self) -> f64 {
        match self.goal {
            Goal::Within(tolerance) => tolerance,
            Goal::Noise(noise) => 3.0 * noise,
        }
    }

    /// What became of it, in words; of holes, and of how far it goes on beyond its data, there are notes.
    pub fn described(&self) -> String {
        let [nx, ny] = self.fitted.counts;
        let misfit = self.fitted.misfit;
        let mut text = format!(
            "{} ({}, SHA-256 {}…): {} of {} heights near the domain; {nx} × {ny} control points miss them by {:.3} m at most, {:.3} m \
             as root mean square",
            self.file,
            self.format,
            &self.sha256[..12],
            self.points.len(),
            self.heights,
            misfit.most,
            misfit.rms,
        );
        if self.coverage.extrapolated >= 0.5 && !self.coverage.reaches_beyond() {
            let _ = write!(
                text,
                "; extrapolated by {:.0} m",
                self.coverage.extrapolated
            );
        }
        text
    }
}

/// The corners of a plan.
pub(super) fn plan([west, east]: [f64; 2], [south, north]: [f64; 2]) -> [DVec2; 2] {
    [DVec2::new(west, south), DVec2::new(east, north)]
}
