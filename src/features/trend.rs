//! Gradual trends: a volume in layers, between surfaces that nothing was deposited on (\[J19\] §4.1: "extra surfaces with
//! stepped properties").
//!
//! n surfaces make n + 1 layers, 1 the lowest. In a channel the surfaces are those of a lag, with i/(n + 1) of the depth for its
//! thickness: level, or sagging with the base. Each is the visible side of a tube whose other sides are hidden outside of the
//! channel, tube in tube; the last one holds all of the channel. Between two horizons they are a part of the way from one to the
//! other, or parallel to one of them.

use glam::DVec2;

use super::body::Role;
use super::extrusion::ExtrusionError;
use super::horizon::Horizon;
use super::lag;
use super::reach::{Reach, Station};
use super::section::SectionError;
use super::shell::{Shell, ShellError, Tube};
use crate::nurbs::{KnotError, KnotVector};

/// Most that surfaces sag with the channel's base.
pub const MOST_SAG: f64 = 0.8;
/// How far below the rims the borders of the highest surface must be, in depths.
const CLEARANCE: f64 = 0.005;
/// The top of the tube that holds all of the channel, above the rims in depths.
const ABOVE: f64 = 0.13;
/// The hidden floor of the lowest tube below the rims, in depths: below those of lags.
const FLOOR: f64 = 1.9;
/// How far outside of the banks the sides of the lowest tube are, in widths: not where those of lags are.
const OUT: f64 = 0.013;
/// By how much hidden sides of neighbouring tubes are apart, in depths and widths.
const STAGGER: f64 = 0.003;
/// How far the ends of the lowest tube go on beyond the channel's, in widths.
const OVERSHOOT: f64 = 0.211;

/// The layer's place in its volume, from 0 at the base to 1 at the top: in the middle of what it takes of the way. Properties that follow
/// a linear trend have their exact mean so.
pub fn fraction(layer: usize, surfaces: usize) -> f64 {
    (layer as f64 - 0.5) / (surfaces + 1) as f64
}

/// Layers of a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelsDesign {
    /// Surfaces between layers.
    pub surfaces: usize,
    /// How much of the base's relief they have: 0 is level.
    pub sag: f64,
}

/// Why a channel has no layers.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LevelsError {
    /// Surfaces that sag too much.
    #[error("the layers' sag is {0}: keep it within 0 to {MOST_SAG}")]
    Sag(f64),
    /// The highest surface would meet the channel's rims.
    #[error(
        "with {surfaces} surfaces and a sag of {sag} the highest one ends at its channel's rims: make the sag smaller or the \
         surfaces fewer"
    )]
    Rims {
        /// Surfaces.
        surfaces: usize,
        /// The sag.
        sag: f64,
    },
    /// Level surfaces over banks that reach out and back.
    #[error(
        "the channel's banks reach out and back below its rims, where level surfaces would fold: give them a sag above 0"
    )]
    Folded,
    /// The channel has no section.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// The surfaces cannot be carried along the channel.
    #[error(transparent)]
    Extrusion(#[from] Box<ExtrusionError<SectionError>>),
    /// They have no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// They have no closed shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

impl LevelsDesign {
    /// The tubes of a channel, lowest first: each holds its layer and those below it, the last one all of the channel.
    pub fn build(&self, reach: &Reach) -> Result<Vec<Shell>, LevelsError> {
        // Written so that a number that is none fails too.
        if !(self.sag >= 0.0 && self.sag <= MOST_SAG) {
            return Err(LevelsError::Sag(self.sag));
        }
        let highest = self.thickness(self.surfaces);
        if !((1.0 - highest) * (1.0 - self.sag) >= CLEARANCE) {
            return Err(LevelsError::Rims {
                surfaces: self.surfaces,
                sag: self.sag,
            });
        }
        (1..=self.surfaces + 1)
            .map(|layer| self.tube(reach, layer))
            .collect()
    }

    fn thickness(&self, surface: usize) -> f64 {
        surface as f64 / (self.surfaces + 1) as f64
    }

    /// What is below surface `layer`, or all.
    fn tube(&self, reach: &Reach, layer: usize) -> Result<Shell, LevelsError> {
        let across = [reach.across()?, KnotVector::uniform(1, 2)?.into()];
        let template = |station: &Station| self.sheets(reach, station, layer);
        let sheets = reach
            .sheets_at_sections(&across, &template)
            .map_err(Box::new)?;
        let overshoot = OVERSHOOT + STAGGER * layer as f64;
        let beyond =
            |fraction: f64| overshoot * reach.station(fraction).width / reach.trajectory().length();
        let is_last = layer > self.surfaces;
        // Level ones run along one line across.
        let start = self.sheets(reach, &reach.station(0.0), layer)?;
        if !is_last && self.sag == 0.0 && lag::turns_back(&start[0]) {
            return Err(LevelsError::Folded);
        }
        let tube = Tube {
            sheets,
            roles: [if is_last { Role::Hidden } else { Role::Top }, Role::Hidden],
            sides: [Role::Hidden; 2],
        };
        Ok(tube.continued([beyond(0.0), beyond(1.0)])?.close()?)
    }

    fn sheets(
        &self,
        reach: &Reach,
        station: &Station,
        layer: usize,
    ) -> Result<[Vec<DVec2>; 2], SectionError> {
        let Station { width, depth, .. } = *station;
        let base = reach.base(station.fraction)?;
        let last = base.len() - 1;
        let widest = base.iter().fold([0.0_f64; 2], |[left, right], p| {
            [left.min(p.x), right.max(p.x)]
        });
        let mut top: Vec<DVec2> = if layer > self.surfaces {
            // Above all of the channel, evenly from side to side.
            let x = |i: usize| widest[0] + (widest[1] - widest[0]) * i as f64 / last as f64;
            (0..=last)
                .map(|i| DVec2::new(x(i), ABOVE * depth))
                .collect()
        } else {
            lag::section(&base, depth, self.thickness(layer), self.sag)
        };
        let out = (OUT + STAGGER * layer as f64) * width;
        top[0].x = widest[0] - out;
        top[last].x = widest[1] + out;
        let floor = -(FLOOR + STAGGER * layer as f64) * depth;
        let bottom = [top[0], top[last]].map(|p| DVec2::new(p.x, floor));
        Ok([top, bottom.to_vec()])
    }
}

/// How surfaces run between a unit's base and its top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course {
    /// A part of the way from base to top.
    Proportional,
    /// Parallel to the base, this far from each other (m); they end at the top.
    ParallelToBase(f64),
    /// Parallel to the top, this far from each other (m); they end on the base.
    ParallelToTop(f64),
}

/// The surfaces of a unit, lowest first.
pub fn between(base: &Horizon, top: &Horizon, surfaces: usize, course: Course) -> Vec<Horizon> {
    let one = |at: usize| match course {
        Course::Proportional => {
            let part = at as f64 / (surfaces + 1) as f64;
            base.stretched(0.0, -part)
                .plus(&top.stretched(0.0, part - 1.0))
        }
        Course::ParallelToBase(step) => base.lowered(-step * at as f64),
        Course::ParallelToTop(step) => top.lowered(step * (surfaces + 1 - at) as f64),
    };
    (1..=surfaces).map(one).collect()
}

#[cfg(test)]
#[path = "trend_tests.rs"]
mod tests;
