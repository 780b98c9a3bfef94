//! Clinoforms: the sheets of a set that steps into a basin (\[J19\] §3.5, after Graham et al. 2015).
//!
//! In the coordinates d and q of [`ClinoformFrame`] a sheet with origin P runs from the ellipse at which it is truncated
//! by the top, `d_top(q) = P + tD √(1 − q²/tS²)`, to the one at which it laps down on the base, `d_toe(q)`, of which both
//! semi-extents are larger by the length L. v = (q + Q)/2Q and u, from 0 to 1 between the ellipses, are linear in plan.
//! With s = 1 − u, exponent E and toe fraction t,
//!
//! ```text
//! w = (1 − t) s^E + t s          z = z_base + w (z_top − z_base)
//! ```
//!
//! where `z_base` and `z_top` are the horizons' heights at the same place. Above the top the formula goes on; below the
//! base a sheet goes on along its tangent, unless it touches a level base: then it ends there.
//!
//! The ellipses are cubic splines in v. Between level horizons with E = 2 the net is exact in u, with three control
//! points; else z is interpolated, with cubic splines that are refined until the sheet is near enough to the
//! formula in the domain ([`ClinoformFrame::tolerance`] in plan, [`ClinoformUnit::tolerance`] in elevation): evenly at
//! first, then where it is not. \[J19\] measures radially instead of along dip; for its Table 1 this makes a difference
//! of less than 3 mm in z.

mod net;

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use self::net::{Fit, Net, between};
use super::body::Role;
use super::frame::{ClinoformFrame, ClinoformUnit, Shoreline};
use super::side::{Borders, Ends, Open, Side};
use crate::nurbs::interpolate::InterpolateError;
use crate::nurbs::{Function, KnotError, Surface, SurfaceError};

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
    fn ends(&self) -> (f64, f64) {
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

    fn check(&self, frame: &ClinoformFrame, unit: &ClinoformUnit) -> Result<(), ClinoformError> {
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

/// A sheet of a clinoform set.
#[derive(Clone, Debug, PartialEq)]
pub struct Clinoform {
    frame: ClinoformFrame,
    surface: Surface,
    top: Function,
    toe: Function,
    /// Landward of the first d (m) there is no sheet at any strike, basinward of the second neither.
    dips: [f64; 2],
    deviation: f64,
}

impl Clinoform {
    /// The sheet of a design in a unit.
    pub fn new(
        design: &ClinoformDesign,
        frame: &ClinoformFrame,
        unit: &ClinoformUnit,
    ) -> Result<Self, ClinoformError> {
        design.check(frame, unit)?;
        let fit = Fit {
            design,
            frame,
            unit,
        };
        let Net {
            across,
            along,
            heights,
            ellipses: [top, toe],
            deviation,
        } = fit.refined()?;
        let mut net = Vec::with_capacity(heights.len());
        for i in 0..across.count() {
            let u = across.greville(i);
            for j in 0..along.count() {
                let q = frame.reach() * (2.0 * along.greville(j) - 1.0);
                let d = between(top.coefficients()[j], toe.coefficients()[j], u);
                net.push(frame.place(d, q).extend(heights[net.len()]));
            }
        }
        // A spline function lies between its coefficients.
        let (first, last) = across.domain();
        let ends = top.coefficients().iter().zip(toe.coefficients());
        let dips = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (a, b)| {
            let [start, end] = [first, last].map(|u| between(*a, *b, u));
            [low.min(start), high.max(end)]
        });
        Ok(Self {
            frame: frame.clone(),
            dips,
            surface: Surface::new(across, along, net)?,
            top,
            toe,
            deviation,
        })
    }

    /// The frame of its set.
    pub fn frame(&self) -> &ClinoformFrame {
        &self.frame
    }

    /// The sheet: u from above the top (below 0) through the top's ellipse (0) to the toe's (1) or below it, v along
    /// strike from 0 to 1.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// How far the sheet was found to be from its formula in the domain, at the most (m).
    pub fn deviation(&self) -> f64 {
        self.deviation
    }

    /// d (m) at which the sheet leaves the top, at a strike q (m).
    pub fn d_top(&self, q: f64) -> f64 {
        self.top.value(self.v(q))
    }

    /// d (m) at which the sheet reaches the base, at a strike q (m).
    pub fn d_toe(&self, q: f64) -> f64 {
        self.toe.value(self.v(q))
    }

    /// Whether a point lies above the sheet, or basinward of all of it.
    pub fn holds(&self, point: DVec3) -> bool {
        let DVec2 { x: d, y: q } = self.frame.local(point.xy());
        if d < self.dips[0] || d > self.dips[1] {
            return d > self.dips[1];
        }
        let (u, v) = self.parameters(d, q);
        let (first, last) = self.surface.knots_u().domain();
        if u <= first {
            false
        } else {
            u >= last || point.z > self.surface.point(u, v).z
        }
    }

    /// The sheet's elevation (m) at d and q (m); `None` past its toe and landward of its upper border.
    pub fn elevation(&self, d: f64, q: f64) -> Option<f64> {
        let (u, v) = self.parameters(d, q);
        let (first, _) = self.surface.knots_u().domain();
        (first..=1.0)
            .contains(&u)
            .then(|| self.surface.point(u, v).z)
    }

    /// Whether the sheet meets its base at no angle, as without a toe.
    pub fn is_tangent_to_base(&self) -> bool {
        let height = |u: f64| self.surface.point(u, 0.5).z;
        // A thousandth up the profile a straight toe has risen by a thousandth of its share of the height, a curved one by less.
        let part = (height(0.999) - height(1.0)) / (height(0.0) - height(1.0));
        part < 5e-5
    }

    fn v(&self, q: f64) -> f64 {
        let reach = self.frame.reach();
        ((q + reach) / (2.0 * reach)).clamp(0.0, 1.0)
    }

    fn parameters(&self, d: f64, q: f64) -> (f64, f64) {
        let v = self.v(q);
        let (top, toe) = (self.top.value(v), self.toe.value(v));
        ((d - top) / (toe - top), v)
    }
}

impl Open for Clinoform {
    fn sheets(&self) -> &[Surface] {
        std::slice::from_ref(self.surface())
    }

    fn holds(&self, point: DVec3) -> bool {
        Self::holds(self, point)
    }
}

impl From<Clinoform> for Side {
    fn from(clinoform: Clinoform) -> Self {
        let ends = Ends::Hanging {
            frame: clinoform.frame().clone(),
            borders: Borders::Unit {
                is_tangent: clinoform.is_tangent_to_base(),
            },
        };
        Self::new(Role::Open("clinoform"), Arc::new(clinoform), ends)
    }
}

#[cfg(test)]
mod tests;
