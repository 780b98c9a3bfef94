//! Abandonment plugs: mud that fills what a river left, in the upper part of its channel.
//!
//! The base of a plug is the channel's own section, narrower and shallower, and nearer to the outer bank in bends. Its banks go
//! on above the channel's top, to a hidden lid: the channel ends it there. It takes from its channel, and from all that lies
//! in that, what it holds.

use glam::DVec2;

use super::bends::Bend;
use super::body::{Role, Trough, TroughError};
use super::extrusion::ExtrusionError;
use super::reach::{Part, Reach, Station};
use super::section::SectionError;
use super::shell::{Shell, ShellError, Tube};
use super::trajectory::TrajectoryError;
use crate::nurbs::KnotError;

/// Deepest plug as a fraction of the channel's depth: one that reaches the floor would touch it along a line.
pub const DEEPEST: f64 = 0.95;
/// How far above the channel's top the base ends, at an end of a bend, as a fraction of the plug's depth.
const ABOVE: f64 = 0.05;
/// How far ends go on beyond the channel's, in widths.
const OVERSHOOT: f64 = 0.0871;

/// Which part of a channel was abandoned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Abandoned {
    /// From one fraction of its length to another; a part that ends within the channel ends in an upright face.
    Between(f64, f64),
    /// One bend, cut off: from inflection to inflection, where it thins out to nothing.
    Bend(Bend),
}

/// A plug's parameters, sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlugDesign {
    /// Depth as a fraction of the channel's.
    pub depth: f64,
    /// Width as a fraction of the channel's.
    pub width: f64,
    /// How much nearer to the outer bank it is in the sharpest bend, as a fraction of the channel's width.
    pub offset: f64,
    /// Where it is.
    pub part: Abandoned,
}

/// Why numbers make no plug.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlugError {
    /// A fraction that is none.
    #[error("the plug's {name} is {value} of its channel's: keep it above 0 and at most {most}")]
    Fraction {
        /// `depth` or `width`.
        name: &'static str,
        /// The fraction.
        value: f64,
        /// The greatest.
        most: f64,
    },
    /// It would leave the channel.
    #[error("the plug's offset is {0} of the channel's width: keep it within 0 to 0.5")]
    Offset(f64),
    /// The channel has no such part.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// The channel has no section.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// The base cannot be carried along the channel.
    #[error(transparent)]
    Extrusion(#[from] Box<ExtrusionError<SectionError>>),
    /// It has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// Its banks cannot be raised.
    #[error(transparent)]
    Trough(#[from] TroughError),
    /// It has no closed shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

impl PlugDesign {
    /// The plug of a channel. Its base is [`Role::Base`]; the lid is hidden, and so are ends at the channel's own or of a bend.
    pub fn build(&self, reach: &Reach) -> Result<Shell, PlugError> {
        self.check()?;
        let (ends, bend) = match self.part {
            Abandoned::Between(from, to) => ([from, to], None),
            Abandoned::Bend(bend) => {
                let length = reach.trajectory().length();
                ([bend.from / length, bend.to / length], Some(bend))
            }
        };
        let part = Part::new(reach, ends, reach.sections())?;
        let across = [reach.across()?];
        let template = |station: &Station| Ok([self.section(reach, station, bend)?]);
        let [base] = reach.sheets(&part, &across, &template).map_err(Box::new)?;
        let domain = base.knots_v().domain();
        let raised = Trough::new(base, vec![domain.0, domain.1])
            .map_err(ShellError::from)?
            .raised()?;
        let beyond = |end: f64, is_last: bool| {
            let is_end = if is_last { end >= 1.0 } else { end <= 0.0 };
            let width = reach.station(end).width;
            if is_end {
                OVERSHOOT * width / part.length()
            } else {
                0.0
            }
        };
        let tube = Tube {
            sheets: [raised.base().clone(), raised.top().clone()],
            roles: [Role::Base, Role::Hidden],
            sides: [Role::Hidden; 2],
        };
        let tube = tube.continued([beyond(ends[0], false), beyond(ends[1], true)])?;
        Ok(tube.close_at_rims()?)
    }

    fn check(&self) -> Result<(), PlugError> {
        // Written so that numbers that are none fail too.
        for (name, value, most) in [("depth", self.depth, DEEPEST), ("width", self.width, 1.0)] {
            if !(value > 0.0 && value <= most) {
                return Err(PlugError::Fraction { name, value, most });
            }
        }
        if !(self.offset >= 0.0 && self.offset <= 0.5) {
            return Err(PlugError::Offset(self.offset));
        }
        Ok(())
    }

    fn section(
        &self,
        reach: &Reach,
        station: &Station,
        bend: Option<Bend>,
    ) -> Result<Vec<DVec2>, SectionError> {
        let base = reach.base(station.fraction)?;
        // At the ends of a bend all of the section is above the channel's top.
        let rise = bend.map_or(0.0, |bend| {
            let out = 1.0 - bend.bulge(station.place.s, 0.5);
            out * (1.0 + ABOVE) * self.depth * station.depth
        });
        let shift = DVec2::new(self.offset * station.bend * station.width, rise);
        let scale = DVec2::new(self.width, self.depth);
        Ok(base.iter().map(|p| *p * scale + shift).collect())
    }
}

#[cfg(test)]
#[path = "plug_tests.rs"]
mod tests;
