//! Facies boundaries: where one facies belt of a clinothem passes into the next.
//!
//! A reconstruction, after the belts of Sech et al. (2009) and \[J19\] Table 1, which gives widths and interfingering
//! ranges but no surfaces. A boundary is measured along dip from where the sheet that bounds the clinothem above (the
//! younger one) is truncated: in the coordinates of [`super::frame::ClinoformFrame`] its line is
//!
//! ```text
//! d_A(q) = d_top(q) + W + I · wander(q)
//! ```
//!
//! on that sheet, and past its toe on the base. From there it runs straight along the direction I e + h z, up and
//! basinwards, h the unit's mean height: over the height of the unit the belts interfinger across I. The line is a cubic
//! spline in q; where it passes the toe of the younger sheet, the corner is rounded within a span
//! ([`FaciesBoundary::deviation`] tells by how much).
//!
//! Rulings are straight and all parallel, and the sheets' upper and lower borders are level, so every place of a sheet
//! follows from q and z, and which side a point is on is as exact as the sheet itself.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::body::Role;
use super::clinoform::Clinoform;
use super::frame::{ClinoformFrame, ClinoformUnit};
use super::side::{Borders, Ends, Open, Side};
use crate::nurbs::interpolate::{self, InterpolateError};
use crate::nurbs::{Curve, CurveError, Function, KnotError, KnotVector, Surface, SurfaceError};

/// How far sheets reach above the highest top and below the lowest base, as a fraction of the height between them.
const OVERSHOOT: f64 = 0.05;
/// Spans between two nodes: as few as keep the line's deviation within [`ClinoformFrame::tolerance`], and no more than that.
const MOST_SPANS: usize = 8;
/// Fewest spans of a leg.
const FEWEST_SPANS: usize = 4;
/// Nodes need not reach the ends of the strikes more exactly than this fraction.
const ROUNDING: f64 = 1e-9;

/// Why numbers make no facies boundary.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BoundaryError {
    /// The distance is not positive.
    #[error(
        "the facies boundary lies {0} m from the shoreline; give a width of more than 0 to the belts landward of it"
    )]
    Distance(f64),
    /// The interfingering range is negative.
    #[error("the facies boundary's interfingering is {0} m; give 0 or more")]
    Interfingering(f64),
    /// The nodes do not run over all strikes.
    #[error(
        "the {count} nodes of the facies boundary run from q = {from} m to {to} m; at least two are needed, from \
         {low} m or less to {high} m or more"
    )]
    Nodes {
        /// Number of nodes.
        count: usize,
        /// The first (m).
        from: f64,
        /// The last (m).
        to: f64,
        /// Where sheets begin (m).
        low: f64,
        /// Where they end (m).
        high: f64,
    },
    /// A node is not beyond the one before it.
    #[error(
        "node {index} of the facies boundary is at q = {q} m, not beyond the previous at {previous} m"
    )]
    Order {
        /// Position in the list.
        index: usize,
        /// Its q (m).
        q: f64,
        /// That of the node before it (m).
        previous: f64,
    },
    /// A node's shift is not within half of the range.
    #[error("node {index} of the facies boundary wanders by {value} of the range; give −½ to ½")]
    Value {
        /// Position in the list.
        index: usize,
        /// The fraction of the interfingering range.
        value: f64,
    },
    /// The line cannot be interpolated.
    #[error("the facies boundary cannot be interpolated: {0}")]
    Interpolate(#[from] InterpolateError),
    /// The wander is no curve.
    #[error("the facies boundary's wander is no curve: {0}")]
    Curve(#[from] CurveError),
    /// The sheet has no knots.
    #[error("the facies boundary has no knots: {0}")]
    Knots(#[from] KnotError),
    /// The sheet is no surface.
    #[error("the facies boundary is no surface: {0}")]
    Surface(#[from] SurfaceError),
}

/// How a boundary's line wanders along strike: nodes (q in m, fraction of the interfingering range in [−½, ½]), q
/// growing, from −Q or less to Q or more.
#[derive(Clone, Debug, PartialEq)]
pub enum Wander {
    /// A cubic spline through the nodes, twice continuously differentiable. If it swings beyond ±½ between them, it is
    /// made smaller as a whole.
    Smooth(Vec<[f64; 2]>),
    /// Straight legs between the nodes.
    Zigzag(Vec<[f64; 2]>),
}

/// A facies boundary's parameters, sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryDesign {
    /// W, the distance from the younger sheet's truncation, along dip (m): the widths of all belts landward of it.
    pub distance: f64,
    /// I, across which the belts on both sides interfinger, along dip (m).
    pub interfingering: f64,
    /// How the line wanders.
    pub wander: Wander,
}

/// A boundary between two facies belts of a clinothem.
#[derive(Clone, Debug, PartialEq)]
pub struct FaciesBoundary {
    frame: ClinoformFrame,
    legs: Vec<Leg>,
    sheets: Vec<Surface>,
    /// Elevation of the sheets' lower border (m).
    low: f64,
    /// Change of d with z.
    slope: f64,
    deviation: f64,
}

/// A part of the line without corners.
#[derive(Clone, Debug, PartialEq)]
struct Leg {
    from: f64,
    to: f64,
    /// d at the lower border as a function of v.
    lower: Function,
}

impl Leg {
    fn q(&self, v: f64) -> f64 {
        mix(self.from, self.to, v)
    }
}

/// Exact at both ends, so that legs join.
fn mix(from: f64, to: f64, part: f64) -> f64 {
    from * (1.0 - part) + to * part
}

impl FaciesBoundary {
    /// The boundary in the clinothem below a younger sheet of a unit.
    pub fn new(
        design: &BoundaryDesign,
        younger: &Clinoform,
        unit: &ClinoformUnit,
    ) -> Result<Self, BoundaryError> {
        design.check(younger.frame().reach())?;
        let (lowest, highest) = unit.range();
        let margin = OVERSHOOT * (highest - lowest);
        let (low, high) = (lowest - margin, highest + margin);
        let line = Line {
            design,
            younger,
            unit,
            low,
            slope: design.interfingering / unit.height(),
        };
        let mut deviation: f64 = 0.0;
        let mut legs = Vec::new();
        for (leg, off) in line.legs()? {
            deviation = deviation.max(off);
            legs.push(leg);
        }
        let frame = younger.frame().clone();
        let sheets = legs
            .iter()
            .map(|leg| sheet(&frame, leg, [low, high], line.slope))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            slope: line.slope,
            frame,
            legs,
            sheets,
            low,
            deviation,
        })
    }

    /// The frame of its set.
    pub fn frame(&self) -> &ClinoformFrame {
        &self.frame
    }

    /// The sheets, in the order of growing q: u along the rulings (degree 1) from below the base (0) to above the top (1),
    /// v along strike from 0 to 1. Neighbours share their sides' control points.
    pub fn sheets(&self) -> &[Surface] {
        &self.sheets
    }

    /// d (m) of the boundary at a strike q and an elevation z (m).
    pub fn d(&self, q: f64, z: f64) -> f64 {
        let after = self.legs.partition_point(|leg| leg.to <= q);
        let leg = &self.legs[after.min(self.legs.len() - 1)];
        let v = ((q - leg.from) / (leg.to - leg.from)).clamp(0.0, 1.0);
        leg.lower.value(v) + self.slope * (z - self.low)
    }

    /// Whether a point lies basinward of the boundary.
    pub fn holds(&self, point: DVec3) -> bool {
        let DVec2 { x: d, y: q } = self.frame.local(point.xy());
        d > self.d(q, point.z)
    }

    /// How far the sheets were found to be from the line that they shall follow, along dip (m).
    pub fn deviation(&self) -> f64 {
        self.deviation
    }
}

impl BoundaryDesign {
    fn check(&self, reach: f64) -> Result<(), BoundaryError> {
        if !(self.distance > 0.0 && self.distance.is_finite()) {
            return Err(BoundaryError::Distance(self.distance));
        }
        if !(self.interfingering >= 0.0 && self.interfingering.is_finite()) {
            return Err(BoundaryError::Interfingering(self.interfingering));
        }
        let nodes = self.wander.nodes();
        let (from, to) = match (nodes.first(), nodes.last()) {
            (Some(first), Some(last)) => (first[0], last[0]),
            _ => (f64::NAN, f64::NAN),
        };
        let near = reach * (1.0 - ROUNDING);
        if nodes.len() < 2 || !(from <= -near && to >= near) {
            return Err(BoundaryError::Nodes {
                count: nodes.len(),
                from,
                to,
                low: -reach,
                high: reach,
            });
        }
        for (i, pair) in nodes.windows(2).enumerate() {
            if !(pair[1][0] > pair[0][0]) {
                return Err(BoundaryError::Order {
                    index: i + 1,
                    q: pair[1][0],
                    previous: pair[0][0],
                });
            }
        }
        match nodes.iter().position(|n| !(n[1].abs() <= 0.5)) {
            Some(index) => Err(BoundaryError::Value {
                index,
                value: nodes[index][1],
            }),
            None => Ok(()),
        }
    }
}

impl Wander {
    fn nodes(&self) -> &[[f64; 2]] {
        match self {
            Self::Smooth(nodes) | Self::Zigzag(nodes) => nodes,
        }
    }
}

/// A boundary's line before it is interpolated.
struct Line<'a> {
    design: &'a BoundaryDesign,
    younger: &'a Clinoform,
    unit: &'a ClinoformUnit,
    low: f64,
    slope: f64,
}

impl Line<'_> {
    /// d on the lower border at q, if the line wanders there by a fraction of the range.
    fn lower(&self, q: f64, wander: f64) -> f64 {
        let shoreline = self.younger.d_top(q);
        let d = shoreline + self.design.distance + self.design.interfingering * wander;
        let place = self.younger.frame().place(d, q);
        let z = if d < shoreline {
            self.unit.top().height(place.x, place.y)
        } else {
            let on_base = || self.unit.base().height(place.x, place.y);
            self.younger.elevation(d, q).unwrap_or_else(on_base)
        };
        d - self.slope * (z - self.low)
    }

    fn legs(&self) -> Result<Vec<(Leg, f64)>, BoundaryError> {
        let reach = self.younger.frame().reach();
        let tolerance = self.younger.frame().tolerance();
        match &self.design.wander {
            Wander::Smooth(nodes) => {
                let wander = Wave::through(nodes)?;
                let q = |v: f64| mix(-reach, reach, v);
                let inside = wander
                    .curve
                    .knots()
                    .distinct()
                    .into_iter()
                    .map(|knot| knot.0);
                let stops = inside
                    .map(|q| (q + reach) / (2.0 * reach))
                    .filter(|v| (ROUNDING..1.0 - ROUNDING).contains(v));
                let stops: Vec<f64> = [0.0].into_iter().chain(stops).chain([1.0]).collect();
                let lower = |v: f64| self.lower(q(v), wander.at(q(v)));
                Ok(vec![leg([-reach, reach], &stops, &lower, tolerance)?])
            }
            Wander::Zigzag(nodes) => {
                let mut legs = Vec::new();
                for pair in nodes.windows(2) {
                    let [[a, from], [b, to]] = [pair[0], pair[1]];
                    let (start, end) = (a.max(-reach), b.min(reach));
                    // A node at the very end of the strikes makes no leg of its own.
                    if !(end - start > ROUNDING * reach) {
                        continue;
                    }
                    let lower = |v: f64| {
                        let q = mix(start, end, v);
                        let part = (q - a) / (b - a);
                        self.lower(q, mix(from, to, part))
                    };
                    legs.push(leg([start, end], &[0.0, 1.0], &lower, tolerance)?);
                }
                Ok(legs)
            }
        }
    }
}

/// A smooth wander.
struct Wave {
    /// Its x over q.
    curve: Curve,
    scale: f64,
}

impl Wave {
    fn through(nodes: &[[f64; 2]]) -> Result<Self, BoundaryError> {
        let (q, values): (Vec<f64>, Vec<DVec3>) =
            nodes.iter().map(|n| (n[0], DVec3::X * n[1])).unzip();
        let degree = 3.min(nodes.len() - 1);
        let (knots, mut rows) = interpolate::with_parameters(&[values], &q, degree)?;
        let curve = Curve::new(knots, rows.swap_remove(0))?;
        let (least, most) = curve.bounds();
        let swing = most.x.max(-least.x);
        let scale = if swing > 0.5 { 0.5 / swing } else { 1.0 };
        Ok(Self { curve, scale })
    }

    fn at(&self, q: f64) -> f64 {
        self.scale * self.curve.point(q).x
    }
}

/// The leg between two strikes, without corners, with knots at the stops and between them; and its deviation.
fn leg(
    [from, to]: [f64; 2],
    stops: &[f64],
    lower: &impl Fn(f64) -> f64,
    tolerance: f64,
) -> Result<(Leg, f64), BoundaryError> {
    let mut spans = FEWEST_SPANS.div_ceil(stops.len() - 1);
    loop {
        let mut knots = vec![0.0; 3];
        for pair in stops.windows(2) {
            knots.extend((0..spans).map(|k| mix(pair[0], pair[1], k as f64 / spans as f64)));
        }
        knots.extend([1.0; 4]);
        let function = Function::interpolated(&KnotVector::new(3, knots)?, lower)?;
        let deviation = function.deviation(lower);
        if deviation <= tolerance || spans >= MOST_SPANS {
            let lower = function;
            return Ok((Leg { from, to, lower }, deviation));
        }
        spans *= 2;
    }
}

fn sheet(
    frame: &ClinoformFrame,
    leg: &Leg,
    borders: [f64; 2],
    slope: f64,
) -> Result<Surface, BoundaryError> {
    let along = leg.lower.knots();
    let mut net = Vec::with_capacity(2 * along.count());
    for z in borders {
        for (j, d) in leg.lower.coefficients().iter().enumerate() {
            let d = d + slope * (z - borders[0]);
            net.push(frame.place(d, leg.q(along.greville(j))).extend(z));
        }
    }
    let across = KnotVector::uniform(1, 2)?;
    Ok(Surface::new(across, along.clone(), net)?)
}

impl Open for FaciesBoundary {
    fn sheets(&self) -> &[Surface] {
        Self::sheets(self)
    }

    fn holds(&self, point: DVec3) -> bool {
        Self::holds(self, point)
    }
}

impl From<FaciesBoundary> for Side {
    fn from(boundary: FaciesBoundary) -> Self {
        let ends = Ends::Hanging {
            frame: boundary.frame().clone(),
            borders: Borders::Beyond,
        };
        Self::new(Role::Open("facies-boundary"), Arc::new(boundary), ends)
    }
}

#[cfg(test)]
#[path = "boundary_tests.rs"]
mod tests;
