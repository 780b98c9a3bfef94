//! The frame that all sheets of a clinoform set share, and the unit between two horizons that they divide.
//!
//! θ is the azimuth of progradation, clockwise from north; e = (sin θ, cos θ) points down dip (basinwards) and
//! n = (cos θ, −sin θ) along strike. A place in plan is centre + d·e + q·n, with the plan centre of the domain as centre.
//! All sheets run over the same strikes −Q ≤ q ≤ Q, so that neighbours have their rulings in the same vertical planes.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::horizon::{Horizon, HorizonError};
use super::thickness::{NoThickness, Thickness};
use super::trajectory::azimuth_vector;

/// How far the common strikes reach beyond the domain, as a fraction of its half extent along strike.
pub const STRIKE_MARGIN: f64 = 0.1;
/// How far sheets may leave their formulas in plan, as a fraction of the plan's diagonal: a millimetre in a kilometre.
const EXACT: f64 = 1e-6;
/// How far they may leave them in elevation, as a fraction of their unit's mean thickness.
const EXACT_UP: f64 = 5e-5;
/// Of a nudged frame: how far it moves along strike, and its borders by being turned, against how far it moves basinwards.
const ASIDE: f64 = 0.43;
const TURNED: f64 = 0.31;
/// Samples along each side of the plan when the thickness of a unit is looked at.
const SAMPLES: usize = 65;

/// Why a domain has no frame or two horizons bound no unit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// The azimuth of progradation is no number.
    #[error("the azimuth of progradation is {0}; give a finite number")]
    Azimuth(f64),
    /// The domain is empty.
    #[error(
        "the domain from {low} to {high} is empty; its second corner must lie beyond the first"
    )]
    Domain {
        /// First corner.
        low: DVec2,
        /// Second corner.
        high: DVec2,
    },
    /// The top is not above the base.
    #[error(
        "the top of the unit lies too low: {0}; the horizons of a clinoform set must not meet inside the domain"
    )]
    TopBelowBase(NoThickness),
    /// The top is nowhere above the base.
    #[error("the top of the unit is nowhere above its base: {0}")]
    Nowhere(NoThickness),
    /// A horizon has no bounds over the domain.
    #[error(transparent)]
    Horizon(#[from] HorizonError),
}

/// Coordinates down dip (d) and along strike (q) over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct ClinoformFrame {
    centre: DVec2,
    dip: DVec2,
    strike: DVec2,
    /// The domain's corners in plan as (d, q).
    corners: [DVec2; 4],
    reach: f64,
    low: DVec2,
    high: DVec2,
}

impl ClinoformFrame {
    /// The frame over a domain's plan for an azimuth of progradation (rad, clockwise from north).
    pub fn new(low: DVec3, high: DVec3, azimuth: f64) -> Result<Self, FrameError> {
        Self::nudged(low, high, azimuth, 0.0)
    }

    /// The same, moved basinwards by a tiny distance (m), and as little aside and around: where a shoreline lies along a wall
    /// of the domain, or a set is symmetrical about something else, it is not any more.
    pub fn nudged(low: DVec3, high: DVec3, azimuth: f64, by: f64) -> Result<Self, FrameError> {
        let (low, high) = (low.xy(), high.xy());
        let azimuth = azimuth + TURNED * by / (high - low).max_element();
        if !azimuth.is_finite() {
            return Err(FrameError::Azimuth(azimuth));
        }
        if !(low.is_finite() && high.is_finite() && high.cmpgt(low).all()) {
            return Err(FrameError::Domain { low, high });
        }
        let dip = azimuth_vector(azimuth);
        let strike = DVec2::new(dip.y, -dip.x);
        let middle = (low + high) / 2.0;
        let mut frame = Self {
            centre: middle,
            dip,
            strike,
            corners: [DVec2::ZERO; 4],
            reach: 0.0,
            low,
            high,
        };
        let plan = [
            low,
            DVec2::new(high.x, low.y),
            DVec2::new(low.x, high.y),
            high,
        ];
        // Seen from where the frame was: what begins at a corner is moved with it.
        frame.corners = plan.map(|corner| frame.local(corner));
        frame.centre = middle + by * (dip + ASIDE * strike);
        let half = frame.corners.iter().map(|c| c.y.abs()).fold(0.0, f64::max);
        frame.reach = half * (1.0 + STRIKE_MARGIN);
        Ok(frame)
    }

    /// A place's coordinates: d down dip and q along strike (m).
    pub fn local(&self, place: DVec2) -> DVec2 {
        let off = place - self.centre;
        DVec2::new(off.dot(self.dip), off.dot(self.strike))
    }

    /// The place with coordinates d and q (m).
    pub fn place(&self, d: f64, q: f64) -> DVec2 {
        self.centre + self.dip * d + self.strike * q
    }

    /// How far sheets may leave their formulas in plan (m).
    pub fn tolerance(&self) -> f64 {
        EXACT * (self.high - self.low).length()
    }

    /// The unit vector down dip.
    pub fn dip(&self) -> DVec2 {
        self.dip
    }

    /// The unit vector along strike.
    pub fn strike(&self) -> DVec2 {
        self.strike
    }

    /// Q, the greatest strike that sheets run to (m): half of the domain's extent along strike, and a margin.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Least and greatest d in the domain (m).
    pub fn dip_range(&self) -> (f64, f64) {
        let d = self.corners.iter().map(|corner| corner.x);
        d.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), d| {
            (least.min(d), most.max(d))
        })
    }

    /// The origin `O_0` (its d, m) with which the apex of the first shoreline lies at the domain's most up-dip corner.
    pub fn first_origin(&self, shoreline: Shoreline) -> f64 {
        self.dip_range().0 - shoreline.dip
    }

    /// Whether the shoreline of a sheet with this origin has left the domain: all of the domain is landward of it.
    pub fn is_beyond(&self, origin: f64, shoreline: Shoreline) -> bool {
        // d − d_top(q) is convex, so over a rectangle it is greatest at a corner.
        self.corners
            .iter()
            .all(|corner| corner.x < shoreline.at(origin, corner.y))
    }

    /// Whether a place lies in the domain's plan, or beyond it by no more than a fraction of its extents.
    pub(super) fn is_near(&self, place: DVec2, margin: f64) -> bool {
        let margin = (self.high - self.low) * margin;
        place.cmpge(self.low - margin).all() && place.cmple(self.high + margin).all()
    }
}

/// The ellipse in plan at which a sheet meets the top of its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shoreline {
    /// Semi-extent down dip, tD (m).
    pub dip: f64,
    /// Semi-extent along strike, tS (m).
    pub strike: f64,
}

impl Shoreline {
    /// d (m) of the ellipse about an origin (its d, m) at a strike q (m): `P + tD √(1 − q²/tS²)`. Not a number beyond tS.
    pub fn at(&self, origin: f64, q: f64) -> f64 {
        let part = q / self.strike;
        origin + self.dip * (1.0 - part * part).sqrt()
    }

    /// The ellipse that is larger by a length (m) in both directions: where a sheet meets the base of its unit.
    #[must_use]
    pub fn widened(self, length: f64) -> Self {
        Self {
            dip: self.dip + length,
            strike: self.strike + length,
        }
    }
}

/// What lies between a base and a top horizon in a domain; the top is above the base.
#[derive(Clone, Debug, PartialEq)]
pub struct ClinoformUnit {
    base: Horizon,
    top: Horizon,
    height: f64,
    lowest: f64,
    highest: f64,
}

impl ClinoformUnit {
    /// The unit between two horizons over a domain's plan.
    pub fn new(base: Horizon, top: Horizon, low: DVec3, high: DVec3) -> Result<Self, FrameError> {
        let thickness =
            Thickness::new(&base, &top, [low, high], SAMPLES).map_err(FrameError::Nowhere)?;
        if let Some(place) = thickness.none {
            return Err(FrameError::TopBelowBase(place));
        }
        let height = thickness.mean;
        let (lowest, _) = base.range(low, high)?;
        let (_, highest) = top.range(low, high)?;
        Ok(Self {
            base,
            top,
            height,
            lowest,
            highest,
        })
    }

    /// The horizon on which the unit lies.
    pub fn base(&self) -> &Horizon {
        &self.base
    }

    /// The horizon that bounds the unit above.
    pub fn top(&self) -> &Horizon {
        &self.top
    }

    /// The mean height of the unit in the domain (m).
    pub fn height(&self) -> f64 {
        self.height
    }

    /// How far sheets may leave their formulas in elevation (m).
    pub fn tolerance(&self) -> f64 {
        EXACT_UP * self.height
    }

    /// The lowest base and the highest top in the domain (m), by control heights.
    pub fn range(&self) -> (f64, f64) {
        (self.lowest, self.highest)
    }

    /// The elevations of base and top, if both are level (m).
    pub fn levels(&self) -> Option<(f64, f64)> {
        Some((self.base.level()?, self.top.level()?))
    }
}
