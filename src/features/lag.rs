//! Channel lags: what lies on the floor of a channel, below a sheet that sags between level and parallel to the base.
//!
//! \[J19\] Fig. 8a draws one surface, the lag's top, which ends on the channel's base. Ours has the base's control points at
//! the same places across, and heights that are an affine function of theirs,
//!
//! ```text
//! L_i = (x_i, −(1 − f)(1 − g) D + (1 − f) g y_i)
//! ```
//!
//! f the lag's thickness at the thalweg as a fraction of the depth D, g how much of the base's relief it has (our
//! reconstruction). It passes exactly f D above the thalweg; its borders are lower than the channel's rims by
//! (1 − f)(1 − g) D, so outside of the channel, and the channel's base cuts it. What is below it down to a hidden floor
//! under the channel is the lag's body: it takes from its channel what it holds.

use glam::DVec2;

use super::body::Role;
use super::extrusion::ExtrusionError;
use super::profile::Profile;
use super::reach::{Part, Reach, Station};
use super::section::SectionError;
use super::shell::{Shell, ShellError, Tube};
use super::trajectory::TrajectoryError;
use crate::nurbs::{KnotError, KnotVector};

/// Thickest lag, as a fraction of the channel's depth.
pub const THICKEST: f64 = 0.6;
/// Thinnest lag where the thickness varies: a sheet that comes down to the floor would touch it.
pub const THINNEST: f64 = 0.02;
/// Least distance of the sheet's borders below the rims, as a fraction of the depth: three sheets in one edge are no model.
pub const CLEARANCE: f64 = 0.1;
/// The hidden floor of the first lag below the rims, in depths; each further one lies lower.
const FLOOR: f64 = 1.3;
/// By how much hidden sheets of lags in one channel are apart, in depths and widths.
const STAGGER: f64 = 0.02;
/// How far its ends go on beyond the channel's, in widths: no other feature's ends are there.
const OVERSHOOT: f64 = 0.1;

/// A lag's parameters, sampled.
#[derive(Clone, Debug)]
pub struct LagDesign {
    /// Thickness at the thalweg as a fraction of the channel's depth.
    pub thickness: Profile,
    /// How much of the base's relief its top has: 0 is level, 1 would be parallel.
    pub sag: Profile,
    /// Which of several lags of one channel it is, from 0: hidden sheets of two must not coincide.
    pub order: usize,
}

/// Why numbers make no lag.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LagError {
    /// The thickness is nothing, or too much.
    #[error(
        "{s:.0} m along the channel the lag is {value} of the channel's depth thick: keep it within {least} to {THICKEST}"
    )]
    Thickness {
        /// Arc length (m).
        s: f64,
        /// Fraction of the depth.
        value: f64,
        /// The least that is possible.
        least: f64,
    },
    /// The sheet would meet the channel's rims.
    #[error(
        "a lag of {thickness} of the depth with a sag of {sag} ends at its channel's rims: \
         (1 − thickness)(1 − sag) must be at least {CLEARANCE}"
    )]
    Sag {
        /// Fraction of the depth.
        thickness: f64,
        /// Of the base's relief.
        sag: f64,
    },
    /// A level sheet over banks that reach out and back.
    #[error(
        "{0:.0} m along the channel its banks reach out and back below the rims, where a level top would fold: give it a sag above 0"
    )]
    Folded(f64),
    /// The channel has no such part.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// The channel has no section.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// The sheets cannot be carried along the channel.
    #[error(transparent)]
    Extrusion(#[from] Box<ExtrusionError<LagError>>),
    /// It has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// It has no closed shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

/// The sheet's control points above those of a base (section coordinates): `thickness` and `sag` as in [`LagDesign`].
pub fn section(base: &[DVec2], depth: f64, thickness: f64, sag: f64) -> Vec<DVec2> {
    let rest = 1.0 - thickness;
    let lift = |p: &DVec2| DVec2::new(p.x, -rest * (1.0 - sag) * depth + rest * sag * p.y);
    base.iter().map(lift).collect()
}

/// Whether control points do not go from left to right: of a level line they would run back along it.
pub(super) fn turns_back(points: &[DVec2]) -> bool {
    points.windows(2).any(|pair| pair[1].x < pair[0].x)
}

impl LagDesign {
    /// The lag of a channel. Its top is [`Role::Top`], all the rest is hidden.
    pub fn build(&self, reach: &Reach) -> Result<Shell, LagError> {
        let across = [reach.across()?, KnotVector::uniform(1, 2)?.into()];
        let template = |station: &Station| self.sheets(reach, station);
        let sheets = if self.thickness.is_constant() && self.sag.is_constant() {
            reach.sheets_at_sections(&across, &template)
        } else {
            let part = Part::new(reach, [0.0, 1.0], reach.sections())?;
            reach.sheets(&part, &across, &template)
        };
        let sheets = sheets.map_err(Box::new)?;
        // The ends of two lags must not coincide either.
        let overshoot = OVERSHOOT + STAGGER * self.order as f64;
        let beyond =
            |fraction: f64| overshoot * reach.station(fraction).width / reach.trajectory().length();
        let tube = Tube {
            sheets,
            roles: [Role::Top, Role::Hidden],
            sides: [Role::Hidden; 2],
        };
        Ok(tube.continued([beyond(0.0), beyond(1.0)])?.close()?)
    }

    /// Control points of the top and of the hidden floor.
    fn sheets(&self, reach: &Reach, station: &Station) -> Result<[Vec<DVec2>; 2], LagError> {
        let thickness = self.thickness.at(station.fraction);
        let least = if self.thickness.is_constant() {
            0.0
        } else {
            THINNEST
        };
        // Written so that a number that is none fails too.
        if !(thickness > 0.0 && thickness >= least && thickness <= THICKEST) {
            return Err(LagError::Thickness {
                s: station.place.s,
                value: thickness,
                least,
            });
        }
        let sag = self.sag.at(station.fraction);
        let clears = (1.0 - thickness) * (1.0 - sag) >= CLEARANCE;
        if !(sag >= 0.0 && clears) {
            return Err(LagError::Sag { thickness, sag });
        }
        let base = reach.base(station.fraction)?;
        let mut top = section(&base, station.depth, thickness, sag);
        let order = self.order as f64;
        let last = top.len() - 1;
        // The borders stand outside of the channel: outside of banks that overhang, too.
        let widest = base.iter().fold([0.0_f64; 2], |[left, right], p| {
            [left.min(p.x), right.max(p.x)]
        });
        let out = STAGGER * station.width;
        let overhang = |rim: f64, widest: f64| {
            if widest.abs() > rim.abs() { out } else { 0.0 }
        };
        top[0].x = widest[0] - out * order - overhang(base[0].x, widest[0]);
        top[last].x = widest[1] + out * order + overhang(base[last].x, widest[1]);
        if sag == 0.0 && turns_back(&top) {
            return Err(LagError::Folded(station.place.s));
        }
        let floor = -(FLOOR + STAGGER * order) * station.depth;
        let bottom = [top[0], top[last]].map(|p| DVec2::new(p.x, floor));
        Ok([top, bottom.to_vec()])
    }
}

#[cfg(test)]
#[path = "lag_tests.rs"]
mod tests;
