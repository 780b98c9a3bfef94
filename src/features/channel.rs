//! Channels: a cubic base carried along a trajectory, closed by a ruled top (\[J19\] Fig. 4a, 4c, 5).
//!
//! Of the default section the base has degree 3 across and 3 along (1 along a straight, constant channel); seven control
//! points across, the middle three collinear, so that the surface passes exactly through the thalweg.

use std::sync::Arc;

use glam::DVec2;

use super::body::Trough;
use super::extrusion::{self, Across, ExtrusionError, Guides, Limits, PlacedSection};
use super::own_section::OwnSection;
use super::profile::Profile;
use super::section::{CONTROL_POINTS, ChannelSection, SectionError};
use super::trajectory::Trajectory;
use crate::nurbs::{KnotError, KnotVector, SurfaceError};

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
    /// Depth of the thalweg below the rims (m); of a section of one's own what 1 is along its y.
    pub depth: Profile,
    /// The section's shape, if it is one's own: asymmetry and side angles count for nothing then.
    pub own: Option<Arc<OwnSection>>,
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
    /// The section has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A closed section makes no shell.
    #[error("the channel's skin does not close: {0}")]
    Conduit(String),
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
            Self::Extrusion(_) | Self::Top(_) | Self::Knots(_) | Self::Conduit(_) => {
                "surface out of tolerance"
            }
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
        let (base, sections) = extrusion::extrude(
            trajectory,
            &self.across()?,
            limits,
            self.guides(),
            &|fraction| self.place(fraction),
        )?;
        Ok(Trough::new(base, sections)?)
    }

    /// What its section is across.
    pub fn across(&self) -> Result<Across, KnotError> {
        Ok(match &self.own {
            None => KnotVector::uniform(3, CONTROL_POINTS)?.into(),
            Some(own) => Across {
                knots: own.curve().knots().clone(),
                weights: own
                    .curve()
                    .is_rational()
                    .then(|| own.curve().weights().to_vec()),
            },
        })
    }

    fn guides(&self) -> Guides {
        match self.own {
            None => Guides::Outline,
            Some(_) => Guides::All,
        }
    }

    /// The control points of the section at a fraction of the length: x to the right from the middle between the rims, y up
    /// from them.
    pub fn points(&self, fraction: f64) -> Result<Vec<DVec2>, SectionError> {
        let section = self.section(fraction);
        match &self.own {
            None => section.control_points().map(|points| points.to_vec()),
            Some(own) => {
                section.check_size()?;
                Ok(own.points(section.width, section.depth))
            }
        }
    }

    /// The place of the thalweg at a fraction of the length: x to the right from the middle between the rims, y up from them.
    pub fn thalweg(&self, fraction: f64) -> DVec2 {
        let size = DVec2::new(self.width.at(fraction), self.depth.at(fraction));
        match &self.own {
            None => DVec2::new(self.asymmetry.at(fraction), -1.0) * size,
            Some(own) => own.deepest() * size,
        }
    }

    /// The default section at a fraction of the length.
    fn section(&self, fraction: f64) -> ChannelSection {
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
    pub(super) fn place(&self, fraction: f64) -> Result<PlacedSection, SectionError> {
        let shift = self.offset(fraction);
        let points = self.points(fraction)?;
        Ok(PlacedSection {
            points: points.into_iter().map(|point| point + shift).collect(),
            tolerance: self.tolerance * self.width.at(fraction),
        })
    }

    /// Where the middle between the rims is at a fraction of the length: x to the right of the trajectory, y = elevation (m).
    pub(super) fn offset(&self, fraction: f64) -> DVec2 {
        let origin = match self.origin {
            Origin::TopCentre => 0.0,
            Origin::Thalweg => self.thalweg(fraction).x,
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
