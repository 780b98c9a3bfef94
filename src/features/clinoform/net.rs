//! From a clinoform's formula to its net: ellipses and elevations as splines, refined until they are near enough.

use glam::DVec2;

use super::{ClinoformDesign, ClinoformError};
use crate::features::frame::{ClinoformFrame, ClinoformUnit};
use crate::nurbs::interpolate::{self, InterpolateError};
use crate::nurbs::{Function, KnotError, KnotVector, spans_probed};

/// Fewest spans along strike.
const STRIKE_SPANS: usize = 14;
/// Most spans in either direction.
const MOST_SPANS: usize = 64;
/// How far around the domain the deviation is measured, as a fraction of its extents.
const AROUND: f64 = 0.05;

/// d at u from those of the two ellipses.
pub(super) fn between(top: f64, toe: f64, u: f64) -> f64 {
    top + (toe - top) * u
}

/// A net, but for its places in plan, which are linear in u and v.
pub(super) struct Net {
    pub(super) across: KnotVector,
    pub(super) along: KnotVector,
    /// Elevations, u-major (m).
    pub(super) heights: Vec<f64>,
    /// d of the top's and the toe's ellipse as functions of v (m).
    pub(super) ellipses: [Function; 2],
    /// How far z was found to be from the formula in the domain, at the most (m).
    pub(super) deviation: f64,
}

/// A design on its way to a net.
pub(super) struct Fit<'a> {
    pub(super) design: &'a ClinoformDesign,
    pub(super) frame: &'a ClinoformFrame,
    pub(super) unit: &'a ClinoformUnit,
}

impl Fit<'_> {
    /// The coarsest net that is within the tolerance.
    pub(super) fn refined(&self) -> Result<Net, ClinoformError> {
        let (mut spans_u, mut spans_v) = (1, STRIKE_SPANS);
        let in_plan = self.frame.tolerance();
        let (along, mut ellipses) = loop {
            let along = KnotVector::uniform(3, spans_v + 3)?;
            let (ellipses, reached) = self.ellipses(&along)?;
            if reached <= in_plan {
                break (along, ellipses);
            }
            spans_v = more(spans_v, "its ellipses", [reached, in_plan])?;
        };
        let mut along = along;
        if let Some((base, top)) = self.unit.levels() {
            return self.level(base, top - base, along, ellipses);
        }
        let tolerance = self.unit.tolerance();
        loop {
            let across = self.across(spans_u, 3)?;
            let origin = self.unit.base().level().unwrap_or(0.0);
            let z = |u: f64, v: f64| self.elevation(&ellipses, u, v) - origin;
            let heights = interpolate::net(&across, &along, z)?;
            let [off_u, off_v, off] = self.deviations(&across, &along, &heights, &ellipses, &z);
            let heights: Vec<f64> = heights.iter().map(|z| z + origin).collect();
            if off <= tolerance {
                return Ok(Net {
                    across,
                    along,
                    heights,
                    ellipses,
                    deviation: off,
                });
            }
            // The direction to blame; both if neither is.
            let both = !(off_u > tolerance / 2.0 || off_v > tolerance / 2.0);
            if both || off_u > tolerance / 2.0 {
                spans_u = more(spans_u, "elevations down dip", [off, tolerance])?;
            }
            if both || off_v > tolerance / 2.0 {
                spans_v = more(spans_v, "elevations along strike", [off, tolerance])?;
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
            if deviation <= self.unit.tolerance() {
                let heights = profile
                    .coefficients()
                    .iter()
                    .flat_map(|own| std::iter::repeat_n(base + own, along.count()))
                    .collect();
                return Ok(Net {
                    across,
                    along,
                    heights,
                    ellipses,
                    deviation,
                });
            }
            spans = more(
                spans,
                "elevations down dip",
                [deviation, self.unit.tolerance()],
            )?;
        }
    }

    /// Knots in u: spans from the upper border to the toe, of which those near the toe are shorter the less smooth the
    /// profile is there; and spans below the toe.
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
            // Below it the sheet follows the base, over spans that are no longer than those above.
            let mut steps = 1.0;
            while (last - 1.0) * spans as f64 > (1.0 - first) * steps {
                steps += 1.0;
            }
            let mut step = 1.0;
            while step < steps {
                knots.push(1.0 + (last - 1.0) * step / steps);
                step += 1.0;
            }
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

/// Half as many spans again, if that is not too many.
fn more(
    spans: usize,
    what: &'static str,
    [reached, tolerance]: [f64; 2],
) -> Result<usize, ClinoformError> {
    if spans < MOST_SPANS {
        Ok((3 * spans).div_ceil(2).min(MOST_SPANS))
    } else {
        Err(ClinoformError::Deviation {
            what,
            reached,
            tolerance,
            spans,
        })
    }
}
