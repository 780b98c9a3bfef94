//! Reaches: a channel's way and sections, in which what lies in it is placed.
//!
//! A child of a channel has sections of its own along the *channel's* trajectory, in fractions of the channel's width and depth:
//! so it fits its channel wherever that goes, and its sheets cross the channel's at an angle.

use glam::DVec2;

use super::channel::ChannelDesign;
use super::extrusion::{self, Carried, ExtrusionError, Limits, PlacedSection};
use super::section::SectionError;
use super::trajectory::Trajectory;

/// A channel's trajectory, and its sections along it.
#[derive(Clone, Debug)]
pub struct Reach {
    /// Its way in plan.
    pub trajectory: Trajectory,
    /// Its sections.
    pub channel: ChannelDesign,
}

/// A channel's section at one place.
#[derive(Clone, Debug)]
pub struct Station {
    /// The fraction of the way, 0 to 1.
    pub fraction: f64,
    /// Depth of the thalweg below the rims (m).
    pub depth: f64,
    /// Elevation of the rims (m).
    pub top: f64,
    /// Control points of the base: x to the right of the trajectory, y up from the rims (m).
    pub base: Vec<DVec2>,
}

impl Reach {
    /// The channel's section at a fraction of its length.
    pub fn station(&self, fraction: f64) -> Result<Station, SectionError> {
        let top = self.channel.top.at(fraction);
        let placed = self.channel.place(fraction)?;
        Ok(Station {
            fraction,
            depth: self.channel.depth.at(fraction),
            top,
            base: placed.points.iter().map(|p| *p - DVec2::Y * top).collect(),
        })
    }

    /// Carries a template, made of the channel's sections, along the trajectory; `constant` tells whether its own shape is the
    /// same all along. `guides` are the rows of control points that the surface shall keep to.
    pub fn carry<E: std::error::Error + From<SectionError>>(
        &self,
        constant: bool,
        guides: &[usize],
        template: &dyn Fn(&Station) -> Result<Vec<DVec2>, E>,
    ) -> Result<Carried, ExtrusionError<E>> {
        let limits = Limits {
            angle: self.channel.angle_limit,
            constant: constant && self.channel.is_constant(),
        };
        extrusion::carry(&self.trajectory, limits, guides, &|fraction| {
            let station = self.station(fraction)?;
            let up = DVec2::Y * station.top;
            let points = template(&station)?;
            Ok(PlacedSection {
                points: points.iter().map(|point| *point + up).collect(),
                tolerance: self.channel.tolerance * self.channel.width.at(fraction),
            })
        })
    }
}
