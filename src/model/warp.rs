//! Warps: the change by which bodies conform to a surface (\[J19\] §2.5.3, Fig. 9).
//!
//! A body is built about a level of its own. Then every place of it moves vertically by the surface's elevation there, less
//! that level and a depth: so the level comes to lie as far below the surface. What lies in the body moves as it does.

use std::sync::Arc;

use glam::DVec2;

use super::draws::Reason;
use crate::features::body::Body;
use crate::features::conform::{ConformError, Target, conform};
use crate::features::shell::{Shell, ShellError};
use crate::features::side::Side;

/// What a body conforms to.
#[derive(Clone, Debug)]
pub(crate) struct Warp {
    /// The surface, as it was before anything cut it.
    pub(crate) surface: Arc<Side>,
    /// What it is called.
    pub(crate) name: String,
    /// How far below the surface the body's level comes to lie (m).
    pub(crate) depth: f64,
    /// The level in the body (m); the body's own if absent.
    pub(crate) reference: Option<f64>,
    /// How far the body may be from where it should be (m); by its size if absent.
    pub(crate) tolerance: Option<f64>,
}

/// How far a body may be from where it should be, as a fraction of its height …
const TOLERANCE: f64 = 0.01;
/// … and at most (m).
const MOST: f64 = 0.05;

/// A surface that dips by more than this is spoken of (degrees).
const STEEP: f64 = 10.0;
/// Places along the sides of a body's box at which that is looked at.
const PLACES: usize = 16;

/// A body that conforms.
pub(crate) struct Warped {
    pub(crate) body: Body,
    /// How far it is from where it should be, at most (m).
    pub(crate) deviation: f64,
    /// The steepest dip of the surface there (rad).
    pub(crate) steepest: f64,
    /// The mean slope of the surface there: how far it rises along x and along y (m/m).
    pub(crate) slope: DVec2,
}

impl Warp {
    /// The elevation at which a body's level comes to lie at a place in plan (m).
    pub(crate) fn height(&self, at: DVec2) -> Result<f64, Reason> {
        let height = self.surface.height(at);
        height.map(|height| height - self.depth).ok_or_else(|| {
            let message = format!(
                "{} has no elevation at x = {:.1} m, y = {:.1} m",
                self.name, at.x, at.y
            );
            ("nothing to conform to", message)
        })
    }

    /// The same of bodies that are built about a level (m), unless it has a reference already.
    #[must_use]
    pub(crate) fn at(self, level: f64) -> Self {
        Self {
            reference: Some(self.reference.unwrap_or(level)),
            ..self
        }
    }

    /// What was reached, in words that follow the feature's id.
    pub(crate) fn told(&self, deviation: f64, steepest: f64) -> String {
        let dip = steepest.to_degrees();
        let upright = if dip > STEEP {
            format!(
                "; that dips at up to {dip:.0}° there, so across it bodies are thinner than upwards"
            )
        } else {
            String::new()
        };
        format!(
            "conforms to {} within {deviation:.2e} m{upright}",
            self.name
        )
    }

    /// A body where it conforms.
    pub(crate) fn apply(&self, body: &Body) -> Result<Warped, Reason> {
        let wrong = |error: ConformError| {
            let reason = match error {
                ConformError::NoHeight { .. } => "nothing to conform to",
                _ => "does not conform",
            };
            (
                reason,
                format!("it does not conform to {}: {error}", self.name),
            )
        };
        let (low, high) = body.bounds();
        let tolerance = self
            .tolerance
            .unwrap_or((TOLERANCE * (high.z - low.z)).min(MOST));
        let shell = closed(body).map_err(|error| wrong(error.into()))?;
        let target = Target {
            height: &|at| self.surface.height(at),
            reference: self.reference.unwrap_or(high.z),
            depth: self.depth,
        };
        let made = conform(&shell, &target, tolerance).map_err(wrong)?;
        let (steepest, slope) = self.slopes(low.truncate(), high.truncate());
        Ok(Warped {
            steepest,
            slope,
            body: Body::Shell(made.shell),
            deviation: made.deviation,
        })
    }
}

impl Warp {
    /// The steepest dip of the surface between two corners in plan (rad), and its mean slope, over a grid of places.
    fn slopes(&self, low: DVec2, high: DVec2) -> (f64, DVec2) {
        let step = (high - low) / PLACES as f64;
        let height = |i: usize, j: usize| {
            self.surface
                .height(low + step * DVec2::new(i as f64, j as f64))
        };
        let mut steepest = 0.0_f64;
        let (mut sum, mut count) = (DVec2::ZERO, 0);
        for i in 0..PLACES {
            for j in 0..PLACES {
                if let (Some(here), Some(east), Some(north)) =
                    (height(i, j), height(i + 1, j), height(i, j + 1))
                {
                    let slope = DVec2::new(east - here, north - here) / step;
                    steepest = steepest.max(slope.length().atan());
                    sum += slope;
                    count += 1;
                }
            }
        }
        (steepest, sum / f64::from(count.max(1)))
    }
}

/// The shell of a closed body.
fn closed(body: &Body) -> Result<Shell, ShellError> {
    match body {
        Body::Shell(shell) => Ok(shell.clone()),
        // Solids of other programs are refused where they are made.
        Body::Trough(_) | Body::Ellipsoid(_) | Body::Side(_) | Body::Imported(_) => {
            Shell::new(body.sheets()?)
        }
    }
}
