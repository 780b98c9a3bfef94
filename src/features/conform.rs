//! Warping: shells built about a level are made to conform to a surface (\[J19\] §2.5.3, Fig. 9).
//!
//! Every place moves vertically by T(x, y) − reference − depth, T the surface's elevation: [`super::displace`] says how sheets do that, and
//! why sheets that shared an edge share it afterwards.

use glam::{DVec2, DVec3};

use super::displace::{DisplaceError, Displacement};
use super::shell::{Shell, ShellError};
use crate::nurbs::SurfaceError;
use crate::nurbs::interpolate::InterpolateError;

/// Least degree: straight rulings cannot follow a curved surface.
const LEAST_DEGREE: usize = 2;

/// What a shell is to conform to.
pub struct Target<'a> {
    /// The surface's elevation at a place in plan (m); none where it has not exactly one.
    pub height: &'a dyn Fn(DVec2) -> Option<f64>,
    /// The level in the shell that comes to lie on the surface (m).
    pub reference: f64,
    /// How far below the surface it comes to lie (m).
    pub depth: f64,
}

/// A shell that conforms.
#[derive(Clone, Debug, PartialEq)]
pub struct Conformed {
    /// The shell.
    pub shell: Shell,
    /// How far its sheets are from where they should be, at most, measured vertically in every patch (m).
    pub deviation: f64,
}

/// Why a shell cannot conform to a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConformError {
    /// The surface has no elevation there.
    #[error(
        "at x = {x:.1} m, y = {y:.1} m the surface to conform to has no elevation, or more than one"
    )]
    NoHeight {
        /// Easting (m).
        x: f64,
        /// Northing (m).
        y: f64,
    },
    /// The tolerance is none.
    #[error("the tolerance is {0} m: it must be above 0")]
    Tolerance(f64),
    /// The tolerance is not met with the largest number of control points.
    #[error(
        "the shell follows the surface to {deviation:.4} m only, not to {tolerance} m: make the surface smoother or the tolerance greater"
    )]
    Unreached {
        /// What was reached (m).
        deviation: f64,
        /// What was to be (m).
        tolerance: f64,
    },
    /// Elevations cannot be interpolated.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The sheets make no shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

/// A shell made to conform to a surface, within a tolerance (m).
pub fn conform(
    shell: &Shell,
    target: &Target<'_>,
    tolerance: f64,
) -> Result<Conformed, ConformError> {
    let displacement = Displacement {
        by: &|place| target.shift(place),
        tolerance: &|_| tolerance,
        degree: LEAST_DEGREE,
    };
    let made = displacement.of(shell.sheets())?;
    Ok(Conformed {
        shell: Shell::new(made.sheets)?,
        deviation: made.deviation,
    })
}

impl Target<'_> {
    /// How a place of the shell moves.
    fn shift(&self, place: DVec3) -> Result<DVec3, ConformError> {
        let at = place.truncate();
        let height = (self.height)(at).filter(|height| height.is_finite());
        let none = ConformError::NoHeight { x: at.x, y: at.y };
        Ok((height.ok_or(none)? - self.reference - self.depth) * DVec3::Z)
    }
}

impl From<DisplaceError<Self>> for ConformError {
    fn from(error: DisplaceError<Self>) -> Self {
        match error {
            DisplaceError::By(error) => error,
            DisplaceError::Tolerance(tolerance) => Self::Tolerance(tolerance),
            DisplaceError::Unreached {
                deviation,
                tolerance,
            } => Self::Unreached {
                deviation,
                tolerance,
            },
            DisplaceError::Interpolate(error) => Self::Interpolate(error),
            DisplaceError::Surface(error) => Self::Surface(error),
            DisplaceError::Shell(error) => Self::Shell(error),
        }
    }
}

#[cfg(test)]
#[path = "conform_tests.rs"]
mod tests;
