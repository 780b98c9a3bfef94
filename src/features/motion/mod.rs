//! Motions: maps of space that move everything older than an event, such as a slip on a fault or a fold.
//!
//! A place p goes to D(p), and what is at p now was at D⁻¹(p). Each motion is the smooth map of *one side* of a fault, as if that side filled
//! all of space, so that sheets can be moved past the fault and cut there.

mod affine;
mod fold;
mod heave;
mod root;
mod slip;
mod variation;

use glam::{DVec2, DVec3};

pub use self::affine::Affine;
pub use self::fold::{FoldDesign, FoldShape, SimilarFold};
pub use self::heave::{Heave, HeaveDesign};
pub use self::slip::{Displacement, Law, Slip, SlipDesign};
pub use self::variation::Variation;
use super::fault_surface::corners;
use super::side::points_bounds;

/// Places along each side of a box at which it is asked where they come from.
const ASKED: usize = 17;
/// By which fraction of a box the box of where its places come from is larger than theirs.
const MARGIN: f64 = 0.02;

/// Why numbers make no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A number is infinite, not a number, or not above 0 where it must be.
    #[error("the {name} is {value}, which is none")]
    Number {
        /// What it is.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// A heave on an upright fault.
    #[error("an upright fault has no heave; give its displacement")]
    Upright,
    /// Varying displacement on a surface that is bent.
    #[error(
        "displacement that varies on its surface needs a plane; on a listric or free one give the heave"
    )]
    NotPlane,
    /// Shear lines run along the fault.
    #[error(
        "lines of shear that lean by {shear_deg:.1}° do not cross a fault that dips {dip_deg:.1}° just once: let them lean less"
    )]
    Shear {
        /// θ (°).
        shear_deg: f64,
        /// The fault's dip (°).
        dip_deg: f64,
    },
    /// What varies so fast that places would pass each other.
    #[error(
        "the displacement changes by {gradient:.3} m a metre along the slip: from 1 on, places would pass each other; give less \
         displacement or a longer fault"
    )]
    Folds {
        /// Metres of displacement a metre.
        gradient: f64,
    },
    /// An axial plane that is level.
    #[error("the axial planes dip {dip_deg}°; give more than 0° and 90° at most")]
    AxialDip {
        /// α (°).
        dip_deg: f64,
    },
    /// An axis outside of the axial plane.
    #[error(
        "the axis plunges {plunge_deg}°, steeper than its axial planes, which dip {axial_dip_deg}°; give a plunge below that"
    )]
    Plunge {
        /// The plunge (°).
        plunge_deg: f64,
        /// α (°).
        axial_dip_deg: f64,
    },
}

/// A map of space.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// A translation (m): constant slip on a plane.
    Shift(DVec3),
    /// Slip over a fault that is a graph.
    Heave(Heave),
    /// Slip on a plane that varies.
    Slip(Slip),
    /// A similar fold.
    Fold(SimilarFold),
    /// A tilt, or simple shear.
    Affine(Affine),
}

impl Motion {
    /// Where what was at a place is after it.
    pub fn forward(&self, p: DVec3) -> DVec3 {
        match self {
            Self::Shift(by) => p + *by,
            Self::Heave(heave) => heave.forward(p),
            Self::Slip(slip) => slip.forward(p),
            Self::Fold(fold) => fold.forward(p),
            Self::Affine(affine) => affine.forward(p),
        }
    }

    /// Where what is at a place after it was before.
    pub fn inverse(&self, p: DVec3) -> DVec3 {
        match self {
            Self::Shift(by) => p - *by,
            Self::Heave(heave) => heave.inverse(p),
            Self::Slip(slip) => slip.inverse(p),
            Self::Fold(fold) => fold.inverse(p),
            Self::Affine(affine) => affine.inverse(p),
        }
    }

    /// The vector by which it moves everything, if it is a translation (m).
    pub fn shift(&self) -> Option<DVec3> {
        match self {
            Self::Shift(by) => Some(*by),
            _ => None,
        }
    }

    /// Whether it is an affine map: control points move as surfaces do.
    pub fn is_affine(&self) -> bool {
        matches!(self, Self::Shift(_) | Self::Affine(_))
    }

    /// Whether upright lines stay upright: heights over the plan are heights after it.
    pub fn keeps_uprights(&self) -> bool {
        match self {
            Self::Shift(_) => true,
            Self::Heave(heave) => heave.keeps_uprights(),
            Self::Slip(slip) => slip.keeps_uprights(),
            Self::Fold(fold) => fold.keeps_uprights(),
            Self::Affine(affine) => affine.keeps_uprights(),
        }
    }

    /// The vector by which it moves every upright line in plan, if that is one and the same (m): it adds heights to heights then.
    pub fn plan_shift(&self) -> Option<DVec2> {
        match self {
            Self::Shift(by) => Some(by.truncate()),
            Self::Heave(heave) => heave.plan_shift(),
            Self::Fold(fold) => fold.lifts_only().then_some(DVec2::ZERO),
            Self::Slip(_) | Self::Affine(_) => None,
        }
    }

    /// The horizontal unit vector across which level beds stay straight, of a fold: they bend along it alone.
    pub fn bends_along(&self) -> Option<DVec2> {
        match self {
            Self::Fold(fold) => fold.bends_along(),
            Self::Shift(_) | Self::Heave(_) | Self::Slip(_) | Self::Affine(_) => None,
        }
    }

    /// A box that holds all places that come to lie in a box, and some more around them.
    pub fn before(&self, [low, high]: [DVec3; 2]) -> [DVec3; 2] {
        let (from, to) = match self {
            Self::Shift(by) => (low - *by, high - *by),
            Self::Affine(_) => {
                let places = corners(low, high).map(|p| self.inverse(p));
                points_bounds(&places)
            }
            Self::Fold(fold) => {
                let [least, most] = fold.reach();
                (low - most, high - least)
            }
            Self::Slip(slip) => {
                let reach = slip.direction_and_greatest(low, high);
                (low - reach, high + reach)
            }
            Self::Heave(_) => {
                let part = |k: usize| (k % ASKED) as f64 / (ASKED - 1) as f64;
                let places = (0..ASKED * ASKED * ASKED).map(|k| {
                    let at = DVec3::new(part(k), part(k / ASKED), part(k / ASKED / ASKED));
                    self.inverse(low + (high - low) * at)
                });
                let places: Vec<DVec3> = places.collect();
                points_bounds(&places)
            }
        };
        if let Self::Shift(_) = self {
            return [from, to];
        }
        let margin = MARGIN * (high - low).max(to - from);
        [from - margin, to + margin]
    }
}

/// Motions one after the other, the oldest first.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Motions(Vec<Motion>);

impl From<Motion> for Motions {
    fn from(motion: Motion) -> Self {
        Self::default().then(motion)
    }
}

impl Motions {
    /// None: everything stays where it is.
    pub fn none() -> Self {
        Self::default()
    }

    /// These, and then another one. Translations that follow each other are one, and none is left out.
    #[must_use]
    pub fn then(&self, later: Motion) -> Self {
        let mut all = self.0.clone();
        match (all.last_mut(), &later) {
            (Some(Motion::Shift(last)), Motion::Shift(by)) => *last += *by,
            _ => all.push(later),
        }
        if all.last().and_then(Motion::shift) == Some(DVec3::ZERO) {
            all.pop();
        }
        Self(all)
    }

    /// One by one, the oldest first.
    pub fn all(&self) -> &[Motion] {
        &self.0
    }

    /// Whether everything stays where it is.
    pub fn is_none(&self) -> bool {
        self.0.is_empty()
    }

    /// Where what was at a place is after all of them.
    pub fn forward(&self, p: DVec3) -> DVec3 {
        self.0.iter().fold(p, |p, motion| motion.forward(p))
    }

    /// Where what is at a place after all of them was before.
    pub fn inverse(&self, p: DVec3) -> DVec3 {
        self.0.iter().rev().fold(p, |p, motion| motion.inverse(p))
    }

    /// The vector by which they move everything, if they are a translation together (m).
    pub fn shift(&self) -> Option<DVec3> {
        match &self.0[..] {
            [] => Some(DVec3::ZERO),
            [one] => one.shift(),
            _ => None,
        }
    }

    /// Whether they are an affine map together.
    pub fn is_affine(&self) -> bool {
        self.0.iter().all(Motion::is_affine)
    }

    /// Whether upright lines stay upright.
    pub fn keeps_uprights(&self) -> bool {
        self.0.iter().all(Motion::keeps_uprights)
    }

    /// A box that holds all places that come to lie in a box, and some more around them.
    pub fn before(&self, [low, high]: [DVec3; 2]) -> [DVec3; 2] {
        self.0
            .iter()
            .rev()
            .fold([low, high], |places, motion| motion.before(places))
    }
}

#[cfg(test)]
mod tests;
