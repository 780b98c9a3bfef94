//! Surfaces of faults: planes, listric surfaces with a straight trace, and any horizon.
//!
//! Frame: h = (sin α, cos α, 0) is the direction of dip, α its azimuth clockwise from north, d = h cos δ − ẑ sin δ points down dip,
//! t = (−cos α, sin α, 0) along strike (the dip to the right of it), n = h sin δ + ẑ cos δ is normal, towards the hanging wall, which is the
//! side above. A place's local coordinates are x′ = (p − C)·h and y′ = (p − C)·t, C a place on the fault. All but a plane are heights
//! z = F(x′, y′) over the plan: overhanging faults have no side above them.
//!
//! Whether a place is above a fault is computed from the same numbers as its sheet, so both agree to rounding. So an exponential is a spline
//! here: the fault is that spline.

mod profile;

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use self::profile::Profile;
pub use self::profile::ProfileError;
use super::body::Role;
use super::horizon::{Horizon, HorizonError};
use super::shell::ShellError;
use super::side::{Ends, HorizonSheet, Open, Side};
use super::swept::Swept;
use crate::nurbs::{KnotError, KnotVector, RefineError, Surface, SurfaceError};

/// What faults are called as sheets.
const NAME: &str = "fault";
/// How many times the diagonal of what it covers a sheet is moved to close the side above it.
const FAR: f64 = 2.0;
/// How far beside a place of a horizon its slope is measured, as a fraction of the place's distance from the origin, and at least (m).
const STEP: f64 = 1e-6;
/// Sines and cosines below this are those of right angles.
const RIGHT: f64 = 1e-15;

/// Why numbers make no fault.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaultError {
    /// A number is infinite or not a number.
    #[error("the fault's {name} is {value}; give a finite number")]
    Number {
        /// What the number is.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// A dip is not between level and upright.
    #[error("the fault dips {dip_deg}°; give more than 0° and {}", if *is_listric { "less than 90°" } else { "90° at most" })]
    Dip {
        /// The dip (°).
        dip_deg: f64,
        /// Whether it is listric.
        is_listric: bool,
    },
    /// A depth is none.
    #[error("the fault is level {0} m below where it begins; give more than 0 m")]
    Depth(f64),
    /// The profile is none.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The horizon has no sheet.
    #[error(transparent)]
    Horizon(#[from] HorizonError),
    /// The sheet has no knots.
    #[error("the fault's sheet has no knots: {0}")]
    Knots(#[from] KnotError),
    /// The sheet is no surface.
    #[error("the fault's sheet is no surface: {0}")]
    Surface(#[from] SurfaceError),
    /// The sheet cannot be cut.
    #[error("the fault's sheet cannot be cut: {0}")]
    Cut(#[from] RefineError),
    /// The side above it cannot be closed.
    #[error("the side above the fault cannot be closed: {0}")]
    Shell(#[from] ShellError),
}

/// The surface of a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultSurface {
    /// C (m).
    through: DVec3,
    /// h.
    dip_direction: DVec2,
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// δ (rad); up to upright.
    Plane(f64),
    /// F depends on x′ alone.
    Profile(Profile),
    /// Heights over the plan.
    Graph(Horizon),
}

/// Sine and cosine of an angle, of which what is only rounding is zero: right angles are right.
pub(super) fn sin_cos(angle: f64) -> (f64, f64) {
    let snapped = |x: f64| if x.abs() < RIGHT { 0.0 } else { x };
    let (sin, cos) = angle.sin_cos();
    (snapped(sin), snapped(cos))
}

fn finite(name: &'static str, value: f64) -> Result<(), FaultError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(FaultError::Number { name, value })
    }
}

impl FaultSurface {
    fn new(through: DVec3, azimuth: f64, shape: Shape) -> Result<Self, FaultError> {
        for value in through.to_array() {
            finite("point", value)?;
        }
        finite("azimuth", azimuth)?;
        let (sin, cos) = sin_cos(azimuth);
        let dip_direction = DVec2::new(sin, cos);
        Ok(Self {
            through,
            dip_direction,
            shape,
        })
    }

    /// The plane through a point that dips towards an azimuth (both in rad).
    pub fn planar(through: DVec3, dip: f64, azimuth: f64) -> Result<Self, FaultError> {
        if !(dip > 0.0 && dip <= std::f64::consts::FRAC_PI_2) {
            return Err(FaultError::Dip {
                dip_deg: dip.to_degrees(),
                is_listric: false,
            });
        }
        Self::new(through, azimuth, Shape::Plane(dip))
    }

    fn listric(dip: f64, depth: f64) -> Result<(), FaultError> {
        if !(dip > 0.0 && dip < std::f64::consts::FRAC_PI_2) {
            return Err(FaultError::Dip {
                dip_deg: dip.to_degrees(),
                is_listric: true,
            });
        }
        if !(depth > 0.0 && depth.is_finite()) {
            return Err(FaultError::Depth(depth));
        }
        Ok(())
    }

    /// Straight down to a point, where it dips towards an azimuth (both in rad), then an arc that is level at a depth below that point (m).
    pub fn circular(
        through: DVec3,
        dip: f64,
        azimuth: f64,
        depth: f64,
    ) -> Result<Self, FaultError> {
        Self::listric(dip, depth)?;
        let profile = Profile::circular(dip, depth);
        Self::new(through, azimuth, Shape::Profile(profile))
    }

    /// The same with an exponential, which comes ever nearer to the depth, instead of the arc.
    pub fn exponential(
        through: DVec3,
        dip: f64,
        azimuth: f64,
        depth: f64,
    ) -> Result<Self, FaultError> {
        Self::listric(dip, depth)?;
        let profile = Profile::exponential(dip, depth)?;
        Self::new(through, azimuth, Shape::Profile(profile))
    }

    /// Through places of a section in the direction of dip: distances from a point along it, growing, and heights above that point (m).
    pub fn profile(through: DVec3, azimuth: f64, places: &[[f64; 2]]) -> Result<Self, FaultError> {
        if places.len() < 2 {
            return Err(ProfileError::Empty.into());
        }
        let profile = Profile::through(places)?;
        Self::new(through, azimuth, Shape::Profile(profile))
    }

    /// A horizon that dips towards an azimuth (rad) on the whole; `through` is a place in plan near the middle of what is looked at.
    pub fn graph(horizon: Horizon, through: DVec2, azimuth: f64) -> Result<Self, FaultError> {
        let height = horizon.height(through.x, through.y);
        Self::new(through.extend(height), azimuth, Shape::Graph(horizon))
    }

    /// A place on it (m).
    pub fn through(&self) -> DVec3 {
        self.through
    }

    /// The horizontal unit vector towards which it dips.
    pub fn dip_direction(&self) -> DVec2 {
        self.dip_direction
    }

    /// The horizontal unit vector along strike, the dip to the right of it.
    pub fn strike(&self) -> DVec2 {
        self.dip_direction.perp()
    }

    /// The dip, if it is a plane (rad).
    pub fn dip(&self) -> Option<f64> {
        match self.shape {
            Shape::Plane(dip) => Some(dip),
            Shape::Profile(_) | Shape::Graph(_) => None,
        }
    }

    /// The unit vector down dip, if it is a plane.
    pub fn down_dip(&self) -> Option<DVec3> {
        let (sin, cos) = sin_cos(self.dip()?);
        Some((self.dip_direction * cos).extend(-sin))
    }

    /// The slip of the hanging wall against the footwall, D (cos λ t − sin λ d), if it is a plane: with a rake λ of −90° normal, 90°
    /// reverse, 0 left-lateral and 180° right-lateral (rad).
    pub fn slip(&self, displacement: f64, rake: f64) -> Option<DVec3> {
        let (sin, cos) = sin_cos(rake);
        let along = self.strike().extend(0.0);
        Some(displacement * (cos * along - sin * self.down_dip()?))
    }

    /// The horizon that it is, if it is one.
    pub fn horizon(&self) -> Option<&Horizon> {
        match &self.shape {
            Shape::Graph(horizon) => Some(horizon),
            Shape::Plane(_) | Shape::Profile(_) => None,
        }
    }

    /// Whether F depends on x′ alone: it is straight along strike.
    pub fn is_straight(&self) -> bool {
        !matches!(self.shape, Shape::Graph(_))
    }

    /// Its elevation at a place in plan (m); an upright plane has none.
    pub fn height(&self, at: DVec2) -> Option<f64> {
        let x = (at - self.through.xy()).dot(self.dip_direction);
        match &self.shape {
            Shape::Plane(dip) if *dip >= std::f64::consts::FRAC_PI_2 => None,
            Shape::Plane(dip) => Some(self.through.z - x * dip.tan()),
            Shape::Profile(profile) => Some(self.through.z + profile.value(x)),
            Shape::Graph(horizon) => Some(horizon.height(at.x, at.y)),
        }
    }

    /// How steeply it falls towards the dip direction there, as dz/dx′; an upright plane infinitely.
    pub fn slope(&self, at: DVec2) -> f64 {
        let x = (at - self.through.xy()).dot(self.dip_direction);
        match &self.shape {
            Shape::Plane(dip) => -dip.tan(),
            Shape::Profile(profile) => profile.slope(x),
            Shape::Graph(_) => self.gradient(at).dot(self.dip_direction),
        }
    }

    /// The gradient of a horizon's height, by differences.
    fn gradient(&self, at: DVec2) -> DVec2 {
        let Shape::Graph(horizon) = &self.shape else {
            return self.slope(at) * self.dip_direction;
        };
        let step = STEP * at.abs().max_element().max(1e3);
        let along = |axis: DVec2| {
            let [before, after] = [at - step * axis, at + step * axis];
            (horizon.height(after.x, after.y) - horizon.height(before.x, before.y)) / (2.0 * step)
        };
        DVec2::new(along(DVec2::X), along(DVec2::Y))
    }

    /// The unit normal at a place's plan, towards the hanging wall.
    pub fn normal(&self, at: DVec3) -> DVec3 {
        if let Shape::Plane(dip) = self.shape {
            let (sin, cos) = sin_cos(dip);
            return (self.dip_direction * sin).extend(cos);
        }
        (-self.gradient(at.xy())).extend(1.0).normalize()
    }

    /// Whether a place lies in the hanging wall; places on the fault do not.
    pub fn is_above(&self, point: DVec3) -> bool {
        match &self.shape {
            Shape::Plane(_) => self.normal(point).dot(point - self.through) > 0.0,
            Shape::Profile(_) | Shape::Graph(_) => self
                .height(point.xy())
                .is_some_and(|height| point.z > height),
        }
    }

    /// The sheet that reaches beyond a box by a margin (m): u down dip and v along strike; of a horizon u east and v north.
    pub fn sheet(&self, low: DVec3, high: DVec3, margin: f64) -> Result<Surface, FaultError> {
        let corners = corners(low, high);
        let strike = self.strike();
        let along = |axis: DVec3| {
            let places = corners.iter().map(|p| (*p - self.through).dot(axis));
            let (least, most) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
                (a.min(x), b.max(x))
            });
            [least - margin, most + margin]
        };
        let across = along(strike.extend(0.0));
        match &self.shape {
            Shape::Plane(dip) => {
                let (sin, cos) = sin_cos(*dip);
                let down = (self.dip_direction * cos).extend(-sin);
                let place = |q: f64, s: f64| self.through + q * down + (s * strike).extend(0.0);
                let [first, last] = along(down);
                Ok(Surface::bilinear([
                    place(first, across[0]),
                    place(first, across[1]),
                    place(last, across[0]),
                    place(last, across[1]),
                ])?)
            }
            Shape::Profile(profile) => {
                let [first, last] = along(self.dip_direction.extend(0.0));
                // Upwards it need not reach farther than above the box.
                let steep = -profile.slope(profile.bent()[0]);
                let above = high.z + margin - self.through.z - profile.value(profile.bent()[0]);
                let first = if steep > 0.0 {
                    first.max(profile.bent()[0] - above.max(margin) / steep)
                } else {
                    first
                };
                let net = profile.net(first, last)?;
                let mut points = Vec::with_capacity(2 * net.points.len());
                let mut weights = Vec::with_capacity(2 * net.points.len());
                for ([x, z], weight) in net.points.iter().zip(&net.weights) {
                    for s in across {
                        let plan = *x * self.dip_direction + s * strike;
                        points.push(self.through + plan.extend(*z));
                        weights.push(*weight);
                    }
                }
                let v = KnotVector::uniform(1, 2)?;
                let sheet = Surface::rational(net.knots, v, points, weights)?;
                Ok(match profile {
                    Profile::Circular { .. } => sheet,
                    // x′ is its parameter: what is bent far from the box is left out.
                    Profile::Spline { .. } => within(sheet, first, last)?,
                })
            }
            Shape::Graph(horizon) => {
                let wide = DVec3::new(margin, margin, 0.0);
                Ok(horizon.sheet_beyond(low - wide, high + wide, 0.0)?)
            }
        }
    }

    /// The hanging wall: what lies above its sheet, which reaches beyond a box by a margin (m).
    pub fn side(
        self: &Arc<Self>,
        low: DVec3,
        high: DVec3,
        margin: f64,
    ) -> Result<Side, FaultError> {
        if let Shape::Graph(horizon) = &self.shape {
            let wide = DVec3::new(margin, margin, 0.0);
            let sheet = HorizonSheet::new(horizon.clone(), low - wide, high + wide)?;
            let open = Arc::new(sheet);
            let ends = Ends::Plan(Arc::clone(&open));
            return Ok(Side::new(Role::Open(NAME), open, ends));
        }
        let sheet = self.sheet(low, high, margin)?;
        let far = FAR * (high - low).length();
        let by = match self.shape {
            Shape::Plane(_) => far * self.normal(low),
            Shape::Profile(_) | Shape::Graph(_) => far * DVec3::Z,
        };
        let swept = Swept::new(NAME, vec![sheet.clone()], by)?;
        let ends = Ends::Closed(swept.shell().clone());
        let open = FaultSide {
            surface: Arc::clone(self),
            sheet,
        };
        Ok(Side::new(Role::Open(NAME), Arc::new(open), ends))
    }
}

/// The part of a sheet between two u, as far as they are inside.
fn within(sheet: Surface, from: f64, to: f64) -> Result<Surface, RefineError> {
    let (first, last) = sheet.knots_u().domain();
    let mut part = sheet;
    if from > first {
        part = part.split_u(from)?.1;
    }
    if to < last {
        part = part.split_u(to)?.0;
    }
    Ok(part)
}

/// The corners of a box.
pub(super) fn corners(low: DVec3, high: DVec3) -> [DVec3; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|k| {
        let pick = |axis: usize| if k >> axis & 1 == 0 { low } else { high };
        DVec3::new(pick(0).x, pick(1).y, pick(2).z)
    })
}

/// The hanging wall of a fault.
#[derive(Debug)]
struct FaultSide {
    surface: Arc<FaultSurface>,
    sheet: Surface,
}

impl Open for FaultSide {
    fn sheets(&self) -> &[Surface] {
        std::slice::from_ref(&self.sheet)
    }

    fn holds(&self, point: DVec3) -> bool {
        self.surface.is_above(point)
    }

    fn height(&self, at: DVec2) -> Option<f64> {
        self.surface.height(at)
    }
}

#[cfg(test)]
mod tests;
