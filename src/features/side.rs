//! Sides: open sheets that reach through the domain, and what lies on their younger side.
//!
//! A body holds what is inside its closed shell; a side holds what is above or basinward of its sheets. Whether it holds
//! a point is computed from the same splines as its sheets, so both agree to rounding wherever a sheet is in the domain.

use std::fmt;
use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::body::Role;
use super::frame::ClinoformFrame;
use super::horizon::{Horizon, HorizonError};
use super::shell::Shell;
use crate::nurbs::Surface;

/// What lies on the younger side of open sheets.
#[derive(Clone, Debug)]
pub struct Side {
    role: Role,
    open: Arc<dyn Open>,
    ends: Ends,
}

/// Open sheets with a younger side.
pub trait Open: fmt::Debug + Send + Sync {
    /// The sheets. Their borders lie outside of the domain, or above the top or below the base of their unit; or join
    /// another of them exactly; or, of a sheet that touches a level base, lie on that base.
    fn sheets(&self) -> &[Surface];

    /// Whether a point lies on the younger side; points on a sheet do not.
    fn holds(&self, point: DVec3) -> bool;

    /// The elevation (m) of the sheets at a place in plan, and beyond their borders that of their tangent planes there; none if they
    /// are no heights over the plan.
    fn height(&self, at: DVec2) -> Option<f64> {
        let _ = at;
        None
    }
}

/// How the sheets of a side end, and go on for whoever needs them closed.
#[derive(Clone, Debug, PartialEq)]
pub enum Ends {
    /// There is no sheet.
    NoSheet,
    /// They are heights over the plan, and go on in all directions.
    Plan(Arc<HorizonSheet>),
    /// They are part of a shell that closes far outside of the domain.
    Closed(Shell),
    /// They hang side by side along the strike of a frame; what they hold lies basinward.
    Hanging {
        /// The frame.
        frame: ClinoformFrame,
        /// Where their upper and their lower borders are.
        borders: Borders,
    },
}

/// Where the upper and the lower borders of hanging sheets are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Borders {
    /// At the top and at the base of the unit or beyond: upright walls go on from there. u runs down.
    Unit {
        /// Whether they meet the base at no angle.
        is_tangent: bool,
    },
    /// Wherever the sheets were cut off, far enough. u runs up.
    Beyond,
}

impl PartialEq for Side {
    fn eq(&self, other: &Self) -> bool {
        self.role == other.role && self.sheets() == other.sheets() && self.ends == other.ends
    }
}

impl Side {
    /// The side of open sheets that do this in a model, and end like that.
    pub fn new(role: Role, open: Arc<dyn Open>, ends: Ends) -> Self {
        Self { role, open, ends }
    }

    /// The side above a horizon, with a sheet that covers a domain's plan.
    pub fn horizon(horizon: Horizon, low: DVec3, high: DVec3) -> Result<Self, HorizonError> {
        let sheet = Arc::new(HorizonSheet::new(horizon, low, high)?);
        let open = Arc::clone(&sheet) as Arc<dyn Open>;
        Ok(Self::new(Role::Open("horizon"), open, Ends::Plan(sheet)))
    }

    /// Everything: there is no sheet.
    pub fn everywhere() -> Self {
        Self::new(
            Role::Open("everywhere"),
            Arc::new(Everywhere),
            Ends::NoSheet,
        )
    }

    /// What its sheets are.
    pub fn role(&self) -> Role {
        self.role
    }

    /// How its sheets end.
    pub fn ends(&self) -> &Ends {
        &self.ends
    }

    /// The sheets: see [`Open::sheets`].
    pub fn sheets(&self) -> &[Surface] {
        self.open.sheets()
    }

    /// Whether a point lies on the younger side; points on a sheet do not.
    pub fn holds(&self, point: DVec3) -> bool {
        self.open.holds(point)
    }

    /// The elevation of its sheets: see [`Open::height`].
    pub fn height(&self, at: DVec2) -> Option<f64> {
        self.open.height(at)
    }

    /// The corners of a box that holds the sheets: that of their control points. Empty (infinite, the wrong way round) if
    /// there are none.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        points_bounds(self.sheets().iter().flat_map(Surface::net))
    }

    /// Whether this and another one are the same: heights that run within a tolerance of each other (m), with sheets of
    /// one shape; or exactly alike.
    pub fn is_at(&self, other: &Self, tolerance: f64) -> bool {
        let (Some(one), Some(other)) = (self.plan(), other.plan()) else {
            return self == other;
        };
        let mut heights = one.heights.iter().zip(other.heights);
        let (one, other) = (&one.sheet, &other.sheet);
        let mut pairs = one.net().iter().zip(other.net());
        heights.all(|(a, b)| (a - b).abs() <= tolerance)
            && one.knots_u() == other.knots_u()
            && one.knots_v() == other.knots_v()
            && pairs.all(|(a, b)| (*a - *b).abs().max_element() <= tolerance)
    }

    /// Its sheet, if that is one of heights over the plan.
    pub fn plan(&self) -> Option<&HorizonSheet> {
        match &self.ends {
            Ends::Plan(sheet) => Some(sheet),
            Ends::NoSheet | Ends::Closed(_) | Ends::Hanging { .. } => None,
        }
    }

    /// Least and greatest elevation of heights over the plan, within the plan of their sheet, or beyond them (m).
    pub fn heights(&self) -> Option<[f64; 2]> {
        self.plan().map(|sheet| sheet.heights)
    }

    /// The elevation of heights that are level (m).
    pub fn level(&self) -> Option<f64> {
        self.plan()?.horizon.level()
    }

    /// Whether it holds everything.
    pub fn is_everywhere(&self) -> bool {
        self.ends == Ends::NoSheet
    }
}

/// No sheet at all.
#[derive(Debug)]
struct Everywhere;

impl Open for Everywhere {
    fn sheets(&self) -> &[Surface] {
        &[]
    }

    fn holds(&self, _: DVec3) -> bool {
        true
    }
}

impl Open for HorizonSheet {
    fn sheets(&self) -> &[Surface] {
        std::slice::from_ref(&self.sheet)
    }

    fn holds(&self, point: DVec3) -> bool {
        Self::holds(self, point)
    }

    fn height(&self, at: DVec2) -> Option<f64> {
        Some(Self::height(self, at))
    }
}

/// The box of control points: by the convex hull property it holds their surface.
pub(super) fn points_bounds<'a>(points: impl IntoIterator<Item = &'a DVec3>) -> (DVec3, DVec3) {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points
        .into_iter()
        .fold(empty, |(low, high), p| (low.min(*p), high.max(*p)))
}

/// A horizon with its sheet over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct HorizonSheet {
    horizon: Horizon,
    sheet: Surface,
    low: DVec2,
    extent: DVec2,
    /// Least and greatest elevation of the sheet's control points (m): what is above or below all of them needs no evaluation.
    heights: [f64; 2],
}

impl HorizonSheet {
    /// The sheet that covers a domain's plan.
    pub fn new(horizon: Horizon, low: DVec3, high: DVec3) -> Result<Self, HorizonError> {
        let sheet = horizon.sheet(low, high)?;
        let net = sheet.net();
        let (first, last) = (net[0].xy(), net[net.len() - 1].xy());
        let (lowest, highest) = points_bounds(net);
        Ok(Self {
            heights: [lowest.z, highest.z],
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

    /// Least and greatest elevation of the sheet's control points (m).
    pub fn heights(&self) -> [f64; 2] {
        self.heights
    }

    /// Its elevation (m).
    pub fn height(&self, at: DVec2) -> f64 {
        let part = (at - self.low) / self.extent;
        let inside = part.cmpge(DVec2::ZERO).all() && part.cmple(DVec2::ONE).all();
        if inside {
            self.sheet.point(part.x, part.y).z
        } else {
            self.horizon.height(at.x, at.y)
        }
    }

    /// Whether a point lies above the horizon.
    pub fn holds(&self, point: DVec3) -> bool {
        let [lowest, highest] = self.heights;
        let part = (point.xy() - self.low) / self.extent;
        let inside = part.cmpge(DVec2::ZERO).all() && part.cmple(DVec2::ONE).all();
        if inside && (point.z <= lowest || point.z > highest) {
            return point.z > highest;
        }
        point.z > self.height(point.xy())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    const LOW: DVec3 = DVec3::new(0.0, 0.0, -30.0);
    const HIGH: DVec3 = DVec3::new(400.0, 700.0, 0.0);

    #[test]
    fn a_horizon_holds_what_is_above_it_to_a_nanometre_in_the_domain_and_beyond() {
        let rows = [
            vec![-20.0, -18.0, -21.0, -19.0],
            vec![-22.0, -20.0, -19.0, -18.0],
            vec![-20.0, -17.0, -22.0, -21.0],
        ];
        let horizon = Horizon::grid([0.0, 300.0], [0.0, 700.0], &rows).unwrap();
        let side = Side::horizon(horizon.clone(), LOW, HIGH).unwrap();
        let sheet = &side.sheets()[0];
        for k in 0..200 {
            let part = |ratio: f64| (f64::from(k) * ratio).fract();
            let on = sheet.point(part(0.754_877_666), part(0.569_840_291));
            assert!(side.holds(on + 1e-9 * DVec3::Z));
            assert!(!side.holds(on - 1e-9 * DVec3::Z));
        }
        let far = DVec2::new(900.0, -300.0);
        let height = horizon.height(far.x, far.y);
        assert!(side.holds(far.extend(height + 1e-9)));
        assert!(!side.holds(far.extend(height - 1e-9)));
        let (low, high) = side.bounds();
        assert!((low.truncate() - DVec2::new(-20.0, -35.0)).length() < 1e-9);
        assert!((high.truncate() - DVec2::new(420.0, 735.0)).length() < 1e-9);
        assert!(low.z < -21.9 && high.z > -17.1);
        assert_eq!(side.level(), None);
    }

    #[test]
    fn a_level_horizon_knows_its_level_and_everywhere_has_no_sheet() {
        let side = Side::horizon(Horizon::flat(-21.3).unwrap(), LOW, HIGH).unwrap();
        assert_eq!(side.level(), Some(-21.3));
        assert!(side.sheets()[0].net().iter().all(|p| p.z == -21.3));
        assert!(!side.holds(DVec3::new(1.0, 1.0, -21.3)));
        assert!(side.holds(DVec3::new(1.0, 1.0, -21.299_999)));
        assert!(Side::everywhere().sheets().is_empty());
        assert!(Side::everywhere().holds(LOW));
        let (low, high) = Side::everywhere().bounds();
        assert!(low.cmpgt(high).all());
    }
}
