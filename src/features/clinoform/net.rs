//! From a clinoform's formula to its net: ellipses and elevations as splines, refined until they are near enough.

use glam::DVec2;

use super::design::{ClinoformDesign, ClinoformError};
use crate::features::frame::{ClinoformFrame, ClinoformUnit};
use crate::nurbs::interpolate::{self, InterpolateError};
use crate::nurbs::{Basis, Function, KnotError, KnotVector, PROBES, spans_probed};

/// Fewest spans along strike.
const STRIKE_SPANS: usize = 14;
/// Most spans of equal kind in either direction; beyond, only those are divided in which the net is not near enough.
const MOST_SPANS: usize = 64;
/// Most control points of a net. The assembly takes some kilobytes for each.
const MOST_POINTS: usize = 40_000;
/// A span is divided into no more pieces than this at once.
const MOST_PIECES: f64 = 4.0;
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
        if let Some((base, top)) = self.unit.levels() {
            return self.level(base, top - base, along, ellipses);
        }
        let tolerance = self.unit.tolerance();
        let origin = self.unit.base().level().unwrap_or(0.0);
        let (mut across, mut along) = (self.across(spans_u, 3)?, along);
        loop {
            let z = |u: f64, v: f64| self.elevation(&ellipses, u, v) - origin;
            let heights = interpolate::net(&across, &along, z)?;
            let misses = self.misses([&across, &along], &heights, &ellipses, &z);
            if misses.worst.0 <= tolerance {
                return Ok(Net {
                    heights: heights.iter().map(|z| z + origin).collect(),
                    across,
                    along,
                    ellipses,
                    deviation: misses.worst.0,
                });
            }
            // The direction to blame; both if neither is.
            let [mut in_u, mut in_v] = misses
                .spans
                .each_ref()
                .map(|own| largest(own) > tolerance / 2.0);
            if !(in_u || in_v) {
                (in_u, in_v) = (true, true);
            }
            if in_u {
                across = match finer(spans_u) {
                    Some(spans) => {
                        spans_u = spans;
                        self.across(spans, 3)?
                    }
                    None => misses.divided(0, &across, tolerance)?,
                };
            }
            if in_v {
                along = match finer(spans_v) {
                    Some(spans) => {
                        spans_v = spans;
                        KnotVector::uniform(3, spans + 3)?
                    }
                    None => misses.divided(1, &along, tolerance)?,
                };
                ellipses = self.ellipses(&along)?.0;
            }
            let points = across.count() * along.count();
            let (reached, place) = misses.worst;
            if !(heights.len() + 1..=MOST_POINTS).contains(&points) || !reached.is_finite() {
                return Err(ClinoformError::TooBent {
                    x: place.x,
                    y: place.y,
                    reached,
                    tolerance,
                    points: heights.len(),
                });
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
    fn misses(
        &self,
        knots: [&KnotVector; 2],
        heights: &[f64],
        [top, toe]: &[Function; 2],
        z: &impl Fn(f64, f64) -> f64,
    ) -> Misses {
        let columns = knots[1].count();
        let at = |in_u: &Basis, in_v: &Basis| {
            let rows = in_u.values().iter().enumerate().map(|(i, n)| {
                let first = (in_u.first() + i) * columns + in_v.first();
                let own = heights[first..].iter().zip(in_v.values());
                n * own.map(|(c, m)| c * m).sum::<f64>()
            });
            rows.sum::<f64>()
        };
        let probes = knots.map(|knots| Stations::new(knots, spans_probed(knots).collect()));
        let nodes = knots.map(|knots| {
            let greville = (0..knots.count()).map(|i| knots.greville(i));
            Stations::new(knots, greville.collect())
        });
        let mut misses = Misses {
            worst: (0.0, DVec2::ZERO),
            spans: probes.each_ref().map(|own| vec![0.0; own.spans()]),
        };
        // Which of the directions a miss tells of.
        let mut look = |us: &Stations, vs: &Stations, blamed: [bool; 2]| {
            for (i, (u, in_u)) in us.all.iter().enumerate() {
                for (j, (v, in_v)) in vs.all.iter().enumerate() {
                    let place = self.place([top, toe], *u, *v);
                    if !self.frame.is_near(place, AROUND) {
                        continue;
                    }
                    let miss = (at(in_u, in_v) - z(*u, *v)).abs();
                    if miss > misses.worst.0 || miss.is_nan() {
                        misses.worst = (miss, place);
                    }
                    for (axis, index) in [(0, i), (1, j)] {
                        if blamed[axis] {
                            let span = &mut misses.spans[axis][index / PROBES.len()];
                            *span = span.max(miss);
                        }
                    }
                }
            }
        };
        look(&probes[0], &nodes[1], [true, false]);
        look(&nodes[0], &probes[1], [false, true]);
        // Between the nodes of both directions misses add up.
        look(&probes[0], &probes[1], [false; 2]);
        misses
    }
}

/// Parameters with the basis there.
struct Stations {
    all: Vec<(f64, Basis)>,
}

impl Stations {
    fn new(knots: &KnotVector, parameters: Vec<f64>) -> Self {
        let at = |t: f64| (t, knots.basis(t));
        Self {
            all: parameters.into_iter().map(at).collect(),
        }
    }

    /// Of parameters that probe spans: the number of spans.
    fn spans(&self) -> usize {
        self.all.len() / PROBES.len()
    }
}

/// How far a net is from its formula.
struct Misses {
    /// The most (m), and where in plan.
    worst: (f64, DVec2),
    /// By span in u and in v, what that direction is to blame for (m).
    spans: [Vec<f64>; 2],
}

impl Misses {
    /// The knots of a direction with those spans divided that miss by more than a share of the tolerance: all that
    /// come near it, if none does. The error of a cubic spline falls with the fourth power of a span, with the third
    /// across the knots of a horizon.
    fn divided(
        &self,
        axis: usize,
        knots: &KnotVector,
        tolerance: f64,
    ) -> Result<KnotVector, KnotError> {
        let spans = &self.spans[axis];
        let limit = (tolerance / 2.0).min(largest(spans) / 2.0);
        let mut all = Vec::new();
        let distinct = knots.distinct();
        for (at, (knot, multiplicity)) in distinct.iter().enumerate() {
            all.extend(std::iter::repeat_n(*knot, *multiplicity));
            let (Some((next, _)), Some(miss)) = (distinct.get(at + 1), spans.get(at)) else {
                continue;
            };
            if *miss > limit {
                let pieces = (miss / (tolerance / 4.0))
                    .cbrt()
                    .ceil()
                    .clamp(2.0, MOST_PIECES);
                let mut piece = 1.0;
                while piece < pieces {
                    all.push(knot + (next - knot) * piece / pieces);
                    piece += 1.0;
                }
            }
        }
        KnotVector::new(knots.degree(), all)
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Half as many spans again, if that is not too many.
fn finer(spans: usize) -> Option<usize> {
    (spans < MOST_SPANS).then(|| (3 * spans).div_ceil(2).min(MOST_SPANS))
}

/// The same, or why not.
fn more(
    spans: usize,
    what: &'static str,
    [reached, tolerance]: [f64; 2],
) -> Result<usize, ClinoformError> {
    finer(spans).ok_or(ClinoformError::Deviation {
        what,
        reached,
        tolerance,
        spans,
    })
}
