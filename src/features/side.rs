//! Sides: open sheets that reach through the domain, and what lies on their younger side.
//!
//! A body holds what is inside its closed shell; a side holds what is above or basinward of its sheets. Whether it holds
//! a point is computed from the same splines as its sheets, so both agree to rounding wherever a sheet is in the domain.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::boundary::FaciesBoundary;
use super::clinoform::Clinoform;
use super::horizon::{Horizon, HorizonError};
use crate::nurbs::Surface;

/// What lies on the younger side of open sheets.
#[derive(Clone, Debug, PartialEq)]
pub enum Side {
    /// Above a horizon.
    Horizon(HorizonSheet),
    /// Above and basinward of a clinoform.
    Clinoform(Clinoform),
    /// Basinward of a facies boundary.
    Boundary(FaciesBoundary),
    /// Everywhere: no sheet.
    Everywhere,
}

impl Side {
    /// The side above a horizon, with a sheet that covers a domain's plan.
    pub fn horizon(horizon: Horizon, low: DVec3, high: DVec3) -> Result<Self, HorizonError> {
        Ok(Self::Horizon(HorizonSheet::new(horizon, low, high)?))
    }

    /// The sheets. Their borders lie outside of the domain, or above the top or below the base of their unit; or join
    /// another of them exactly; or, of a clinoform that touches a level base, lie on that base.
    pub fn sheets(&self) -> &[Surface] {
        match self {
            Self::Horizon(horizon) => std::slice::from_ref(&horizon.sheet),
            Self::Clinoform(clinoform) => std::slice::from_ref(clinoform.surface()),
            Self::Boundary(boundary) => boundary.sheets(),
            Self::Everywhere => &[],
        }
    }

    /// Whether a point lies on the younger side; points on a sheet do not.
    pub fn holds(&self, point: DVec3) -> bool {
        match self {
            Self::Horizon(horizon) => horizon.holds(point),
            Self::Clinoform(clinoform) => clinoform.holds(point),
            Self::Boundary(boundary) => boundary.holds(point),
            Self::Everywhere => true,
        }
    }

    /// The corners of a box that holds the sheets: that of their control points. Empty (infinite, the wrong way round) if
    /// there are none.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let points = self.sheets().iter().flat_map(Surface::net);
        points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
            (low.min(*p), high.max(*p))
        })
    }

    /// The elevation of a level horizon (m).
    pub fn level(&self) -> Option<f64> {
        match self {
            Self::Horizon(horizon) => horizon.horizon.level(),
            _ => None,
        }
    }
}

/// A horizon with its sheet over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct HorizonSheet {
    horizon: Horizon,
    sheet: Surface,
    low: DVec2,
    extent: DVec2,
}

impl HorizonSheet {
    /// The sheet that covers a domain's plan.
    pub fn new(horizon: Horizon, low: DVec3, high: DVec3) -> Result<Self, HorizonError> {
        let sheet = horizon.sheet(low, high)?;
        let net = sheet.net();
        let (first, last) = (net[0].xy(), net[net.len() - 1].xy());
        Ok(Self {
            horizon,
            sheet,
            low: first,
            extent: last - first,
        })
    }

    /// The horizon.
    pub fn horizon(&self) -> &Horizon {
        &self.horizon
    }

    /// The sheet: u runs east and v north, both from 0 to 1.
    pub fn surface(&self) -> &Surface {
        &self.sheet
    }

    /// Whether a point lies above the horizon.
    pub fn holds(&self, point: DVec3) -> bool {
        let part = (point.xy() - self.low) / self.extent;
        let inside = part.cmpge(DVec2::ZERO).all() && part.cmple(DVec2::ONE).all();
        let height = if inside {
            self.sheet.point(part.x, part.y).z
        } else {
            self.horizon.height(point.x, point.y)
        };
        point.z > height
    }
}
