//! A clinoform's parameters, and why numbers make none.

use crate::features::frame::{ClinoformFrame, ClinoformUnit, Shoreline};
use crate::nurbs::interpolate::InterpolateError;
use crate::nurbs::{KnotError, SurfaceError};

/// How far sheets go on above the top and below the base, as a fraction of the height there; more than the twentieth
/// that is needed.
const BEYOND: f64 = 0.06;
/// A sheet goes on below its toe for no more than this fraction of its length.
const MOST_BELOW: f64 = 0.5;

/// Why numbers make no clinoform.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ClinoformError {
    /// A length is not positive.
    #[error("the clinoform's {name} is {value}; give more than 0")]
    NotPositive {
        /// Which parameter.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The origin is no number.
    #[error("the clinoform's origin is {0}; give a finite number")]
    Origin(f64),
    /// The exponent is below one.
    #[error(
        "the clinoform's exponent is {0}; below 1 it would meet its base vertically, so give 1 or more"
    )]
    Exponent(f64),
    /// The toe fraction is not a fraction.
    #[error("the clinoform's toe is {0}; give 0 (tangent to the base) to 1 (straight)")]
    Toe(f64),
    /// A tangent toe on a base that is not level.
    #[error(
        "the clinoform's toe of 0 with an exponent of {exponent} makes it touch a base that is not level; give a toe \
         above 0, such as 0.3"
    )]
    Touching {
        /// The exponent.
        exponent: f64,
    },
    /// The shoreline's ellipse ends inside the strikes that sheets run over.
    #[error(
        "the shoreline's semi-extent along strike is {strike} m, but the domain reaches {reach:.1} m along strike (with \
         its margin); give more than that"
    )]
    Narrow {
        /// tS (m).
        strike: f64,
        /// Q (m).
        reach: f64,
    },
    /// The finest sheet is not near enough to the formula.
    #[error(
        "with {spans} spans the clinoform is still {reached:.4} m from its formula ({what}), more than {tolerance:.4} m; \
         make the shoreline's ellipse wider or the exponent smaller"
    )]
    Deviation {
        /// What deviates.
        what: &'static str,
        /// By how much (m).
        reached: f64,
        /// The most that is allowed (m).
        tolerance: f64,
        /// The spans in the direction that was refined.
        spans: usize,
    },
    /// Between bent horizons the finest net is not near enough to the formula.
    #[error(
        "with {points} control points the clinoform is still {reached:.4} m from its formula between its horizons at \
         x = {x:.1} m, y = {y:.1} m, more than {tolerance:.4} m; make the horizons smoother there: fewer nodes, a greater \
         `tolerance`, or heights without noise"
    )]
    TooBent {
        /// Easting of the place (m).
        x: f64,
        /// Northing of the place (m).
        y: f64,
        /// By how much the net deviates there (m).
        reached: f64,
        /// The most that is allowed (m).
        tolerance: f64,
        /// Control points of the net.
        points: usize,
    },
    /// The net cannot be interpolated.
    #[error("the clinoform cannot be interpolated: {0}")]
    Interpolate(#[from] InterpolateError),
    /// The net has no knots.
    #[error("the clinoform has no knots: {0}")]
    Knots(#[from] KnotError),
    /// The net is no surface.
    #[error("the clinoform is no surface: {0}")]
    Surface(#[from] SurfaceError),
}

/// A clinoform's parameters, sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClinoformDesign {
    /// P, the d of the ellipses' centre (m).
    pub origin: f64,
    /// tD and tS (m).
    pub shoreline: Shoreline,
    /// L, the horizontal length of the sheet down dip (m).
    pub length: f64,
    /// E, the shape exponent.
    pub exponent: f64,
    /// t, the part of the height that falls evenly: 0 is tangent to the base, 1 straight.
    pub toe: f64,
}

impl ClinoformDesign {
    /// w at s = 1 − u; below the base (s < 0) along the tangent.
    pub fn fraction(&self, s: f64) -> f64 {
        if s > 0.0 {
            (1.0 - self.toe) * s.powf(self.exponent) + self.toe * s
        } else {
            self.slope_at_toe() * s
        }
    }

    /// dw/ds at the toe.
    fn slope_at_toe(&self) -> f64 {
        if self.exponent == 1.0 { 1.0 } else { self.toe }
    }

    /// u at the upper and the lower border.
    pub(super) fn ends(&self) -> (f64, f64) {
        let mut above = BEYOND / ((1.0 - self.toe) * self.exponent + self.toe);
        while self.fraction(1.0 + above) < 1.0 + BEYOND * (1.0 - 1e-9) {
            above *= 1.5;
        }
        let slope = self.slope_at_toe();
        let below = if slope > 0.0 {
            (BEYOND / slope).min(MOST_BELOW)
        } else {
            0.0
        };
        (-above, 1.0 + below)
    }

    /// Whether there is such a sheet in the unit.
    pub(super) fn check(
        &self,
        frame: &ClinoformFrame,
        unit: &ClinoformUnit,
    ) -> Result<(), ClinoformError> {
        for (name, value) in [
            ("length", self.length),
            ("shoreline's semi-extent along dip", self.shoreline.dip),
            (
                "shoreline's semi-extent along strike",
                self.shoreline.strike,
            ),
            ("exponent", self.exponent),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ClinoformError::NotPositive { name, value });
            }
        }
        if !self.origin.is_finite() {
            return Err(ClinoformError::Origin(self.origin));
        }
        if self.exponent < 1.0 {
            return Err(ClinoformError::Exponent(self.exponent));
        }
        if !(0.0..=1.0).contains(&self.toe) {
            return Err(ClinoformError::Toe(self.toe));
        }
        if self.slope_at_toe() == 0.0 && unit.base().level().is_none() {
            let exponent = self.exponent;
            return Err(ClinoformError::Touching { exponent });
        }
        if self.shoreline.strike <= frame.reach() {
            let (strike, reach) = (self.shoreline.strike, frame.reach());
            return Err(ClinoformError::Narrow { strike, reach });
        }
        Ok(())
    }
}
