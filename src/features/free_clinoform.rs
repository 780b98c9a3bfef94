//! Clinoforms as a free template: a sigmoidal section carried along any crest in plan (\[J19\] §2.4.1, Fig. 6c).
//!
//! The section ([`sigmoid`]) falls from the crest, a height above the toe, over a length; x counts basinward from the crest. A
//! little beyond both ends the sheet goes on as a **topset** and a **bottomset** with the gradients that it has there, ruled along the direction in
//! which the set steps (so that no bend is too tight for them), as far above and below as a unit reaches, and a little more: whatever
//! bounds the unit cuts it there (\[J19\] §2.5.2). The crest goes on straight beyond its ends until the sheet has left the domain.
//! Where the crest runs aslant to the direction of stepping the topset is a little steeper across it than the slope's end; so the
//! three are sheets of their own.
//!
//! With a toe of 0 both ends are level and would never leave the unit. So they must lie on its top and its base, level ones, exactly: the sheet
//! ends there, touching them, and is divided halfway down, since each half touches one of them.
//!
//! A set steps by **translation** along one azimuth, not by offset curves: no bend is too tight for the next sheet, and what lies
//! between two sheets a distance S apart has S·H of volume for each metre across that azimuth, however the crest bends (Cavalieri).
//! All rows of control points are level, so the elevation of a sheet is exact; only its course is interpolated.

use std::convert::Infallible;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::extrusion::{ExtrusionError, Guides, Limits, PlacedSection, carry};
use super::shell::ShellError;
use super::side::Side;
use super::sigmoid::{SigmoidError, sigmoid, split};
use super::swept::Swept;
use super::trajectory::{Trajectory, azimuth_vector};
use crate::nurbs::{ExtendError, KnotError, KnotVector, RefineError, Surface, SurfaceError};

/// How far a sheet goes on above its unit and below it, as a fraction of the unit's height.
const BEYOND: f64 = 0.06;
/// How far it goes on at least, as a fraction of its own height.
const LEAST_BEYOND: f64 = 0.02;
/// How far the slope itself goes on before topset and bottomset begin, as a fraction of its length: so that these begin beside the
/// bounds of a unit that it reaches from top to base, not on them.
const STRAIGHT: f64 = 0.05;
/// How far sheets reach beyond the domain along strike, as a fraction of the domain's extent there.
const STRIKE_MARGIN: f64 = 0.1;
/// How far the sheet's course may be from the template, as a fraction of the length.
const TOLERANCE: f64 = 1e-4;
/// Most turning of the crest between two sections (rad).
const ANGLE: f64 = 0.26;
/// The crest may turn away from where the set steps by an angle with this cosine: 75°.
const MOST_TURN: f64 = 0.258_819;
/// A sigmoid whose inner control points are nearer to its ends than this fraction of its length is straight with tiny bent ends.
const LEAST_RUN: f64 = 0.02;

/// Where a sheet with level ends is divided, in u.
const HALFWAY: f64 = 0.5;
/// Level ends lie on a bound if they are this near to it, as a fraction of the height; then exactly.
const SAME_LEVEL: f64 = 1e-6;

/// Why numbers make no clinoform along a crest.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FreeClinoformError {
    /// There is no such section.
    #[error(transparent)]
    Section(#[from] SigmoidError),
    /// The section is nearly straight.
    #[error(
        "the steepest gradient {steepest:.5} is hardly more than the straight line's, {mean:.5}: the section would bend at its very ends \
         only; make it steeper, or exactly straight"
    )]
    NearlyStraight {
        /// The gradient that was asked for.
        steepest: f64,
        /// The straight line's.
        mean: f64,
    },
    /// The ends are level, and do not lie on the bounds of the unit.
    #[error(
        "with a toe of 0 the ends are level and never leave the unit, so they must lie on a level top and a level base of it: the crest is at \
         {crest} m, the toe at {toe} m, {bounds}; leave `height`, `crest` and `climb_deg` out, or give a toe above 0, such as 0.3"
    )]
    LevelEnds {
        /// Elevation of the crest (m).
        crest: f64,
        /// Elevation of the toe (m).
        toe: f64,
        /// What is known of the unit, in words.
        bounds: String,
    },
    /// The crest turns away.
    #[error(
        "{s:.0} m along the crest, basinward is {angle_deg:.0}° off the direction in which the set steps; sheets would fold over each \
         other beyond 75°: straighten the crest, choose another azimuth, or the other side as basinward"
    )]
    Turned {
        /// Arc length (m).
        s: f64,
        /// The angle (°).
        angle_deg: f64,
    },
    /// The template cannot be carried along the crest.
    #[error(transparent)]
    Extrusion(#[from] Box<ExtrusionError<Infallible>>),
    /// The section has no knots.
    #[error("the sheet has no knots: {0}")]
    Knots(#[from] KnotError),
    /// The sheet is no surface.
    #[error("the sheet is no surface: {0}")]
    Surface(#[from] SurfaceError),
    /// The sheet cannot go on beyond its ends.
    #[error("the sheet cannot go on: {0}")]
    Extend(#[from] ExtendError),
    /// The sheet cannot be divided.
    #[error("the sheet cannot be divided halfway down: {0}")]
    Divide(#[from] RefineError),
    /// The sheet has no side.
    #[error("what lies basinward of the sheet is not closed: {0}")]
    Side(#[from] ShellError),
}

/// On which side of its crest a clinoform falls, looking along the crest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basinward {
    /// To the right.
    Right,
    /// To the left.
    Left,
}

impl Basinward {
    fn sign(self) -> f64 {
        match self {
            Self::Right => 1.0,
            Self::Left => -1.0,
        }
    }

    /// The direction at right angles to the straight line from the crest's start to its end: its azimuth (rad, clockwise from
    /// north). Of a crest that ends where it starts there is none.
    pub fn azimuth(self, crest: &Trajectory) -> Option<f64> {
        let chord = crest.at(crest.length()).point - crest.at(0.0).point;
        let across = DVec2::new(chord.y, -chord.x) * self.sign();
        (across.length() > 1e-9 * crest.length()).then(|| across.x.atan2(across.y))
    }
}

/// A clinoform's section and how it steps, sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeClinoformDesign {
    /// Height of the crest above the toe (m).
    pub height: f64,
    /// Horizontal distance from crest to toe (m).
    pub length: f64,
    /// Steepest gradient, halfway down.
    pub steepest: f64,
    /// Gradient at crest and toe, as a fraction of the straight line's; 0 if these lie on level bounds of the unit.
    pub toe: f64,
    /// Elevation of the crest (m).
    pub crest: f64,
    /// The side on which it falls.
    pub basinward: Basinward,
    /// Direction in which the set steps (rad, clockwise from north).
    pub azimuth: f64,
}

/// What sheets must reach through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// The domain's lower corner (m).
    pub low: DVec3,
    /// Its upper corner (m).
    pub high: DVec3,
    /// Least and greatest elevation of the unit in the domain (m).
    pub unit: [f64; 2],
    /// Whether the unit's base and its top are level there.
    pub is_level: bool,
}

/// A section: its slope with short straight ends, x basinward from the crest, y = elevation (m); and how far topset and bottomset go
/// on from there in plan (m), with the gradient of these ends.
struct Section {
    across: KnotVector,
    slope: Vec<DVec2>,
    above: f64,
    below: f64,
    gradient: f64,
}

impl FreeClinoformDesign {
    /// The topset, the slope and the bottomset, or, with level ends, the two halves of the slope, that are a step (m) farther in the direction of stepping than the crest, and a rise
    /// (m) higher; u runs down.
    pub fn sheets(
        &self,
        crest: &Trajectory,
        step: f64,
        rise: f64,
        room: &Room,
    ) -> Result<Vec<Surface>, FreeClinoformError> {
        let ahead = azimuth_vector(self.azimuth);
        self.check_turns(crest, ahead)?;
        let section = self.section(rise, room)?;
        let sign = self.basinward.sign();
        let placed = PlacedSection {
            points: section
                .slope
                .iter()
                .map(|p| DVec2::new(sign * p.x, p.y))
                .collect(),
            tolerance: TOLERANCE * self.length,
        };
        let limits = Limits {
            angle: ANGLE,
            constant: true,
        };
        let same = |_: f64| Ok(placed.clone());
        let carried = carry(crest, limits, &[], Guides::All, &same).map_err(Box::new)?;
        let by = step * ahead;
        // Level rows, to the last bit: what is interpolated is their course.
        let rows = carried.rows.into_iter().zip(&section.slope);
        let net = rows
            .flat_map(|(row, point)| {
                let level = point.y;
                row.into_iter().map(move |p| (p.xy() + by).extend(level))
            })
            .collect();
        let slope = Surface::new(section.across, carried.along, net)?;
        let slope = self.across_domain(&slope, ahead, room, crest)?;
        if section.gradient == 0.0 {
            let (upper, lower) = slope.split_u(HALFWAY)?;
            return Ok(vec![upper, lower]);
        }
        let down = ahead.extend(-section.gradient);
        let (first, last) = slope.knots_u().domain();
        let (crest, toe) = (slope.isocurve_u(first), slope.isocurve_u(last));
        let topset = Surface::ruled(&crest.moved(-section.above * down), &crest)?;
        let bottomset = Surface::ruled(&toe, &toe.moved(section.below * down))?;
        Ok(vec![topset, slope, bottomset])
    }

    /// What lies basinward of them.
    pub fn side(&self, sheets: &[Surface], room: &Room) -> Result<Side, FreeClinoformError> {
        let ahead = azimuth_vector(self.azimuth);
        let places = sheets.iter().flat_map(Surface::net).map(|p| p.xy());
        let (first, _) = along(places, ahead);
        let (_, last) = along(corners(room).into_iter(), ahead);
        let size = (room.high - room.low).xy().length();
        let far = (last - first).max(0.0) + size;
        let swept = Swept::new("clinoform", sheets.to_vec(), (far * ahead).extend(0.0))?;
        Ok(swept.side("clinoform"))
    }

    /// The section, and how far it goes on until it has left the unit.
    fn section(&self, rise: f64, room: &Room) -> Result<Section, FreeClinoformError> {
        let Self { height, length, .. } = *self;
        let slope = sigmoid(height, length, self.steepest, self.toe)?;
        let (run, mean) = (slope[1].x, height / length);
        if run < LEAST_RUN * length {
            let steepest = self.steepest;
            return Err(FreeClinoformError::NearlyStraight { steepest, mean });
        }
        let gradient = (slope[0].y - slope[1].y) / run;
        let crest = self.crest + rise;
        let [lowest, highest] = [room.unit[0].max(room.low.z), room.unit[1].min(room.high.z)];
        if !(gradient > 0.0) {
            return self.landing(crest, [lowest, highest], room.is_level);
        }
        let margin = BEYOND * (highest - lowest);
        let least = LEAST_BEYOND * height;
        let end = STRAIGHT * length;
        let beyond = |rise: f64| (rise.max(least) - end * gradient).max(least) / gradient;
        let (above, below) = (
            beyond(highest + margin - crest),
            beyond(crest - height - lowest + margin),
        );
        // The speed at an end of the sigmoid is three times its first leg: spans in which the straight ends have it, too.
        let span = end / (3.0 * run);
        let knots = [
            vec![-span; 4],
            vec![0.0; 3],
            vec![1.0; 3],
            vec![1.0 + span; 4],
        ];
        let leg = |k: i32| DVec2::new(1.0, -gradient) * (end * f64::from(k) / 3.0);
        let slope = slope.map(|p| p + DVec2::Y * (crest - height));
        let upper = (-3..0).map(|k| slope[0] + leg(k));
        let lower = (1..=3).map(|k| slope[3] + leg(k));
        Ok(Section {
            across: KnotVector::new(3, knots.concat())?,
            slope: upper.chain(slope).chain(lower).collect(),
            above,
            below,
            gradient,
        })
    }

    /// The section from a level top to a level base (m), which it touches; halfway down, where it is to be divided, it has a knot.
    fn landing(
        &self,
        crest: f64,
        [lowest, highest]: [f64; 2],
        is_level: bool,
    ) -> Result<Section, FreeClinoformError> {
        let toe = crest - self.height;
        let same = |a: f64, b: f64| (a - b).abs() <= SAME_LEVEL * self.height;
        if !(is_level && same(crest, highest) && same(toe, lowest)) {
            let bounds = if is_level {
                format!("the unit reaches from {lowest} m to {highest} m")
            } else {
                "its base or its top is not level".to_owned()
            };
            return Err(FreeClinoformError::LevelEnds { crest, toe, bounds });
        }
        let slope = sigmoid(highest - lowest, self.length, self.steepest, 0.0)?;
        let (upper, lower) = split(&slope, HALFWAY);
        let points = upper.into_iter().chain(lower.into_iter().skip(1));
        let knots = [vec![0.0; 4], vec![HALFWAY; 3], vec![1.0; 4]];
        let mut slope: Vec<DVec2> = points.map(|p| p + DVec2::Y * lowest).collect();
        // To the last bit.
        for (at, level) in [(0, highest), (1, highest), (5, lowest), (6, lowest)] {
            slope[at].y = level;
        }
        Ok(Section {
            across: KnotVector::new(3, knots.concat())?,
            slope,
            above: 0.0,
            below: 0.0,
            gradient: 0.0,
        })
    }

    fn check_turns(&self, crest: &Trajectory, ahead: DVec2) -> Result<(), FreeClinoformError> {
        for place in crest.places() {
            let cosine = ahead.dot(place.right()) * self.basinward.sign();
            if !(cosine >= MOST_TURN) {
                let (s, angle_deg) = (place.s, cosine.clamp(-1.0, 1.0).acos().to_degrees());
                return Err(FreeClinoformError::Turned { s, angle_deg });
            }
        }
        Ok(())
    }

    /// The sheet with its ends continued straight, until no place of the domain lies ahead of a border.
    fn across_domain(
        &self,
        sheet: &Surface,
        ahead: DVec2,
        room: &Room,
        crest: &Trajectory,
    ) -> Result<Surface, FreeClinoformError> {
        // Along this, rows run from their first control point to their last.
        let strike = DVec2::new(-ahead.y, ahead.x) * self.basinward.sign();
        let (low, high) = along(corners(room).into_iter(), strike);
        let margin = STRIKE_MARGIN * (high - low);
        let (low, high) = (low - margin, high + margin);
        let knots = sheet.knots_v();
        let (q, count, all) = (knots.degree(), knots.count(), knots.as_slice());
        let mut lengths = [0.0_f64; 2];
        for row in sheet.net().chunks(count) {
            let ends = [
                (row[0], row[1], all[q + 1] - all[q], -1.0, -low),
                (
                    row[count - 1],
                    row[count - 2],
                    all[count] - all[count - 1],
                    1.0,
                    high,
                ),
            ];
            for (length, (end, inner, span, sign, limit)) in lengths.iter_mut().zip(ends) {
                let outwards = sign * strike;
                let speed = (end - inner).xy().dot(outwards) * q as f64 / span;
                let missing = limit - end.xy().dot(outwards);
                if missing > 0.0 && !(speed > 0.0) {
                    let s = if sign < 0.0 { 0.0 } else { crest.length() };
                    let angle_deg = 90.0;
                    return Err(FreeClinoformError::Turned { s, angle_deg });
                }
                *length = length.max(missing / speed);
            }
        }
        Ok(sheet.extended_v(lengths.map(|length| length.max(0.0)))?)
    }
}

/// The corners of a domain's plan.
fn corners(room: &Room) -> [DVec2; 4] {
    let (low, high) = (room.low.xy(), room.high.xy());
    [
        low,
        DVec2::new(high.x, low.y),
        high,
        DVec2::new(low.x, high.y),
    ]
}

/// Least and greatest coordinate of places along a direction.
fn along(places: impl Iterator<Item = DVec2>, direction: DVec2) -> (f64, f64) {
    let nothing = (f64::INFINITY, f64::NEG_INFINITY);
    places.fold(nothing, |(least, most), place| {
        let at = place.dot(direction);
        (least.min(at), most.max(at))
    })
}

#[cfg(test)]
#[path = "free_clinoform_tests.rs"]
mod tests;
