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
//! points; else z is interpolated, with cubic splines that are refined until the sheet is within [`TOLERANCE`] of the
//! formula in the domain. \[J19\] measures radially instead of along dip; for its Table 1 the difference is some
//! millimetres in z.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::frame::{ClinoformFrame, ClinoformUnit, Shoreline};
use crate::nurbs::interpolate::{self, InterpolateError};
use crate::nurbs::{Function, KnotError, KnotVector, Surface, SurfaceError, spans_probed};

/// How far a sheet may leave its formula, in plan along dip and in elevation (m).
pub const TOLERANCE: f64 = 1e-3;
/// Fewest spans along strike.
const STRIKE_SPANS: usize = 14;
/// Most spans in either direction.
const MOST_SPANS: usize = 64;
/// How far sheets go on above the top and below the base, as a fraction of the height there; more than the twentieth
/// that is needed.
const BEYOND: f64 = 0.06;
/// A sheet goes on below its toe for no more than this fraction of its length.
const MOST_BELOW: f64 = 0.5;
/// How far around the domain the deviation is measured, as a fraction of its extents.
const AROUND: f64 = 0.05;

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
        "with {spans} spans the clinoform is still {reached:.4} m from its formula ({what}), more than {TOLERANCE} m; \
         make the horizons smoother, the shoreline's ellipse wider or the exponent smaller"
    )]
    Deviation {
        /// What deviates.
        what: &'static str,
        /// By how much (m).
        reached: f64,
        /// The spans in the direction that was refined.
        spans: usize,
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
        let (across, along, heights, deviation, [top, toe]) = Fit {
            design,
            frame,
            unit,
        }
        .refined()?;
        let mut net = Vec::with_capacity(heights.len());
        let reach = frame.reach();
        for i in 0..across.count() {
            let u = across.greville(i);
            for j in 0..along.count() {
                let q = reach * (2.0 * along.greville(j) - 1.0);
                let d = between(top.coefficients()[j], toe.coefficients()[j], u);
                net.push(frame.place(d, q).extend(heights[net.len()]));
            }
        }
        Ok(Self {
            frame: frame.clone(),
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

fn between(top: f64, toe: f64, u: f64) -> f64 {
    top + (toe - top) * u
}

/// Knots across and along, elevations of the net, their deviation, and d of the two ellipses.
type Net = (KnotVector, KnotVector, Vec<f64>, f64, [Function; 2]);

/// A design on its way to a net.
struct Fit<'a> {
    design: &'a ClinoformDesign,
    frame: &'a ClinoformFrame,
    unit: &'a ClinoformUnit,
}

impl Fit<'_> {
    /// The coarsest net that is within the tolerance.
    fn refined(&self) -> Result<Net, ClinoformError> {
        let (mut spans_u, mut spans_v) = (1, STRIKE_SPANS);
        let (along, mut ellipses) = loop {
            let along = KnotVector::uniform(3, spans_v + 3)?;
            let (ellipses, reached) = self.ellipses(&along)?;
            if reached <= TOLERANCE {
                break (along, ellipses);
            }
            spans_v = more(spans_v, "its ellipses", reached)?;
        };
        let mut along = along;
        if let Some((base, top)) = self.unit.levels() {
            return self.level(base, top - base, along, ellipses);
        }
        loop {
            let across = self.across(spans_u, 3)?;
            let origin = self.unit.base().level().unwrap_or(0.0);
            let z = |u: f64, v: f64| self.elevation(&ellipses, u, v) - origin;
            let heights = interpolate::net(&across, &along, z)?;
            let [off_u, off_v, off] = self.deviations(&across, &along, &heights, &ellipses, &z);
            let heights: Vec<f64> = heights.iter().map(|z| z + origin).collect();
            if off <= TOLERANCE {
                return Ok((across, along, heights, off, ellipses));
            }
            // The direction to blame; both if neither is.
            let both = !(off_u > TOLERANCE / 2.0 || off_v > TOLERANCE / 2.0);
            if both || off_u > TOLERANCE / 2.0 {
                spans_u = more(spans_u, "elevations down dip", off)?;
            }
            if both || off_v > TOLERANCE / 2.0 {
                spans_v = more(spans_v, "elevations along strike", off)?;
                along = KnotVector::uniform(3, spans_v + 3)?;
                ellipses = self.ellipses(&along)?.0;
            }
        }
    }

    /// Between level horizons z depends on u alone.
    fn level(
        &self,
        base: f64,
        height: f64,
        along: KnotVector,
        ellipses: [Function; 2],
    ) -> Result<Net, ClinoformError> {
        let degree = if self.design.exponent == 2.0 { 2 } else { 3 };
        let z = |u: f64| height * self.design.fraction(1.0 - u);
        let mut spans = 1;
        loop {
            let across = self.across(spans, degree)?;
            let profile = Function::interpolated(&across, z)?;
            let deviation = profile.deviation(z);
            if deviation <= TOLERANCE {
                let heights = profile
                    .coefficients()
                    .iter()
                    .flat_map(|own| std::iter::repeat_n(base + own, along.count()))
                    .collect();
                return Ok((across, along, heights, deviation, ellipses));
            }
            spans = more(spans, "elevations down dip", deviation)?;
        }
    }

    /// Knots in u: spans from the upper border to the toe, of which those near the toe are shorter the less smooth the
    /// profile is there; and one below the toe.
    fn across(&self, spans: usize, degree: usize) -> Result<KnotVector, KnotError> {
        let (first, last) = self.design.ends();
        let exponent = self.design.exponent;
        let grading = if exponent.fract() == 0.0 {
            1.0
        } else {
            (4.0 / exponent).max(1.0)
        };
        let mut knots = vec![first; degree + 1];
        for step in (1..spans).rev() {
            let part = (step as f64 / spans as f64).powf(grading);
            knots.push(1.0 - (1.0 - first) * part);
        }
        if last > 1.0 {
            // The profile's slope goes on over the toe, its curvature ends there.
            knots.extend(std::iter::repeat_n(1.0, degree - 1));
        }
        knots.extend(std::iter::repeat_n(last, degree + 1));
        KnotVector::new(degree, knots)
    }

    /// d of both ellipses as functions of v, and how far they are from them.
    fn ellipses(&self, along: &KnotVector) -> Result<([Function; 2], f64), InterpolateError> {
        let reach = self.frame.reach();
        let design = self.design;
        let q = |v: f64| reach * (2.0 * v - 1.0);
        let toe = design.shoreline.widened(design.length);
        let exact_top = |v: f64| design.shoreline.at(design.origin, q(v));
        let exact_toe = |v: f64| toe.at(design.origin, q(v));
        let top = Function::interpolated(along, exact_top)?;
        let toe = Function::interpolated(along, exact_toe)?;
        let reached = top.deviation(exact_top).max(toe.deviation(exact_toe));
        Ok(([top, toe], reached))
    }

    /// The formula's z at (u, v).
    fn elevation(&self, [top, toe]: &[Function; 2], u: f64, v: f64) -> f64 {
        let place = self.place([top, toe], u, v);
        let base = self.unit.base().height(place.x, place.y);
        let above = self.unit.top().height(place.x, place.y);
        base + self.design.fraction(1.0 - u) * (above - base)
    }

    fn place(&self, [top, toe]: [&Function; 2], u: f64, v: f64) -> DVec2 {
        let d = between(top.value(v), toe.value(v), u);
        self.frame.place(d, self.frame.reach() * (2.0 * v - 1.0))
    }

    /// How far the net's surface is from the formula in the domain: at the places that tell of u, of v, and anywhere.
    fn deviations(
        &self,
        across: &KnotVector,
        along: &KnotVector,
        heights: &[f64],
        [top, toe]: &[Function; 2],
        z: &impl Fn(f64, f64) -> f64,
    ) -> [f64; 3] {
        let at = |u: f64, v: f64| {
            let (in_u, in_v) = (across.basis(u), along.basis(v));
            let rows = in_u.values().iter().enumerate().map(|(i, n)| {
                let first = (in_u.first() + i) * along.count() + in_v.first();
                let own = heights[first..].iter().zip(in_v.values());
                n * own.map(|(c, m)| c * m).sum::<f64>()
            });
            rows.sum::<f64>()
        };
        let greville = |knots: &KnotVector| {
            (0..knots.count())
                .map(|i| knots.greville(i))
                .collect::<Vec<_>>()
        };
        let (probes_u, probes_v): (Vec<f64>, Vec<f64>) = (
            spans_probed(across).collect(),
            spans_probed(along).collect(),
        );
        let worst = |us: &[f64], vs: &[f64]| {
            let mut worst = 0.0;
            for &u in us {
                for &v in vs {
                    if self.frame.is_near(self.place([top, toe], u, v), AROUND) {
                        let miss = (at(u, v) - z(u, v)).abs();
                        if miss > worst || miss.is_nan() {
                            worst = miss;
                        }
                    }
                }
            }
            worst
        };
        let off_u = worst(&probes_u, &greville(along));
        let off_v = worst(&greville(across), &probes_v);
        let off = worst(&probes_u, &probes_v);
        [off_u, off_v, off.max(off_u).max(off_v)]
    }
}

/// Twice as many spans, if that is not too many.
fn more(spans: usize, what: &'static str, reached: f64) -> Result<usize, ClinoformError> {
    if spans < MOST_SPANS {
        Ok((2 * spans).min(MOST_SPANS))
    } else {
        Err(ClinoformError::Deviation {
            what,
            reached,
            spans,
        })
    }
}

#[cfg(test)]
#[path = "clinoform_tests.rs"]
mod tests;
