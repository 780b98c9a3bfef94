//! Channels: a cubic base carried along a trajectory, closed by a ruled top (\[J19\] Fig. 4a, 4c, 5).
//!
//! The base has degree 3 across and 3 along (1 along a straight, constant channel); seven control
//! points across, the middle three collinear, so that the surface passes exactly through the thalweg.

use glam::DVec2;

use super::body::Trough;
use super::extrusion::{self, ExtrusionError, Limits, PlacedSection};
use super::profile::Profile;
use super::section::{ChannelSection, SectionError};
use super::trajectory::Trajectory;
use crate::nurbs::SurfaceError;

/// Where the trajectory crosses the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Above the deepest point.
    Thalweg,
    /// In the middle between the rims.
    TopCentre,
}

/// A channel's parameters, sampled, each a function of the fraction of its length.
#[derive(Clone, Debug)]
pub struct ChannelDesign {
    /// Width between the rims (m).
    pub width: Profile,
    /// Depth of the thalweg below the rims (m).
    pub depth: Profile,
    /// Thalweg's offset to the right, as a fraction of the width.
    pub asymmetry: Profile,
    /// Side angle of the left bank (rad).
    pub left_angle: Option<Profile>,
    /// Side angle of the right bank (rad).
    pub right_angle: Option<Profile>,
    /// Elevation of the rims (m).
    pub top: Profile,
    /// Where the trajectory crosses the section.
    pub origin: Origin,
    /// Most turning between two sections (rad).
    pub angle_limit: f64,
    /// How far thalweg and rims may leave the trajectory and its offsets, as a fraction of the width.
    pub tolerance: f64,
}

/// Why numbers make no channel.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChannelError {
    /// The base cannot be carried along the trajectory.
    #[error(transparent)]
    Extrusion(#[from] ExtrusionError<SectionError>),
    /// The top cannot be ruled.
    #[error("the channel's top cannot be ruled between its rims: {0}")]
    Top(#[from] SurfaceError),
}

impl ChannelError {
    /// The reason in two or three words, for counts of rejected draws.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::Extrusion(ExtrusionError::Section(..)) => "impossible section",
            Self::Extrusion(ExtrusionError::Fold { .. }) => "bend tighter than the half-width",
            Self::Extrusion(ExtrusionError::Neck { .. }) => "meander neck narrower than the width",
            Self::Extrusion(_) | Self::Top(_) => "surface out of tolerance",
        }
    }
}

impl ChannelDesign {
    /// The channel along a trajectory.
    pub fn build(&self, trajectory: &Trajectory) -> Result<Trough, ChannelError> {
        let limits = Limits {
            angle: self.angle_limit,
            constant: self.is_constant(),
        };
        let (base, sections) =
            extrusion::extrude(trajectory, 3, limits, &|fraction| self.place(fraction))?;
        Ok(Trough::new(base, sections)?)
    }

    /// The section at a fraction of the length.
    pub fn section(&self, fraction: f64) -> ChannelSection {
        let at = |profile: &Profile| profile.at(fraction);
        ChannelSection {
            width: at(&self.width),
            depth: at(&self.depth),
            asymmetry: at(&self.asymmetry),
            left_angle: self.left_angle.as_ref().map(at),
            right_angle: self.right_angle.as_ref().map(at),
        }
    }

    /// The section at a fraction of the length, placed: x to the right of the trajectory, y = elevation.
    fn place(&self, fraction: f64) -> Result<PlacedSection, SectionError> {
        let section = self.section(fraction);
        let shift = self.offset(fraction);
        let points = section
            .control_points()?
            .iter()
            .map(|point| *point + shift)
            .collect();
        Ok(PlacedSection {
            points,
            tolerance: self.tolerance * section.width,
        })
    }

    /// Where the middle between the rims is at a fraction of the length: x to the right of the trajectory, y = elevation (m).
    pub(super) fn offset(&self, fraction: f64) -> DVec2 {
        let origin = match self.origin {
            Origin::TopCentre => 0.0,
            Origin::Thalweg => self.asymmetry.at(fraction) * self.width.at(fraction),
        };
        DVec2::new(-origin, self.top.at(fraction))
    }

    /// Whether its section is the same all along.
    pub(super) fn is_constant(&self) -> bool {
        [&self.width, &self.depth, &self.asymmetry, &self.top]
            .into_iter()
            .chain(self.left_angle.iter())
            .chain(self.right_angle.iter())
            .all(Profile::is_constant)
    }
}

#[cfg(test)]
#[path = "channel_tests.rs"]
mod tests;
