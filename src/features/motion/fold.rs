//! Similar folds (class 2 of Ramsay 1967): every place moves along the axial plane, by an amount that depends on its distance from that plane.
//!
//! The axial plane dips by α towards an azimuth, the hinterland; v is the horizontal direction of vergence, away from it. Then
//! â = v cos α + ẑ sin α points up the axial plane, b̂ = −v sin α + ẑ cos α is its normal, and **F(p) = p + f(p·b̂) â**. p·b̂ stays, so
//! F⁻¹(p) = p − f(p·b̂) â, and the Jacobian is 1: volumes are kept, and so is the thickness along â. A plunging axis leaves b̂ and turns â in the
//! axial plane, by β with sin(plunge) = sin α sin β.
//!
//! - *Train*: f = A sin(2π(b + phase)/λ), or with limbs as of a sine-generated curve, which are rounder where they turn.
//! - *Pair* of an antiform and a synform: f = ΔF S(b/w + ½), S(t) = 3t² − 2t³ between 0 and 1. Of level beds the tails stay level, the upper
//!   one ΔF sin α higher; they overhang where 1.5 ΔF/w > 1/(sin α cos α).

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, DVec3};

use super::{Motion, MotionError};
use crate::features::fault_surface::sin_cos;

/// f, by the distance b from the axial plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FoldShape {
    /// Waves.
    Train {
        /// A (m).
        amplitude: f64,
        /// λ, across the axial planes (m).
        wavelength: f64,
        /// Where a wave begins, before the fold's own point (m).
        phase: f64,
    },
    /// One step.
    Pair {
        /// ΔF (m).
        step: f64,
        /// w, across the axial planes (m).
        width: f64,
    },
}

impl FoldShape {
    /// The pair that lifts level beds by a height (m), with the greatest f′ of `tightness`, for axial planes that dip by `axial_dip` (rad).
    pub fn pair(height: f64, axial_dip: f64, tightness: f64) -> Self {
        let step = height / axial_dip.sin();
        Self::Pair {
            step,
            width: 1.5 * step / tightness,
        }
    }

    fn value(self, b: f64) -> f64 {
        match self {
            Self::Train {
                amplitude,
                wavelength,
                phase,
            } => amplitude * (TAU * (b + phase) / wavelength).sin(),
            Self::Pair { step, width } => {
                let t = (b / width + 0.5).clamp(0.0, 1.0);
                step * t * t * (3.0 - 2.0 * t)
            }
        }
    }

    /// Least and greatest value (m).
    fn range(self) -> [f64; 2] {
        match self {
            Self::Train { amplitude, .. } => [-amplitude.abs(), amplitude.abs()],
            Self::Pair { step, .. } => [step.min(0.0), step.max(0.0)],
        }
    }

    /// The greatest |f′|.
    pub fn steepest(self) -> f64 {
        match self {
            Self::Train {
                amplitude,
                wavelength,
                ..
            } => (TAU * amplitude / wavelength).abs(),
            Self::Pair { step, width } => (1.5 * step / width).abs(),
        }
    }
}

/// What a similar fold is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoldDesign {
    /// A place on an axial plane: of a pair, the one in the middle of its limb (m).
    pub through: DVec3,
    /// Where the axial plane dips to, clockwise from north (rad).
    pub azimuth: f64,
    /// α (rad).
    pub axial_dip: f64,
    /// How steeply the axis plunges, to the left of the direction of dip (rad).
    pub plunge: f64,
    /// f.
    pub shape: FoldShape,
}

/// A similar fold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimilarFold {
    through: DVec3,
    /// â.
    along: DVec3,
    /// b̂.
    across: DVec3,
    shape: FoldShape,
}

impl FoldDesign {
    /// The motion.
    pub fn build(&self) -> Result<Motion, MotionError> {
        let angles = [
            ("azimuth", self.azimuth),
            ("axial dip", self.axial_dip),
            ("plunge", self.plunge),
        ];
        for (name, value) in angles {
            if !value.is_finite() {
                return Err(MotionError::Number { name, value });
            }
        }
        if !(self.axial_dip > 0.0 && self.axial_dip <= FRAC_PI_2) {
            return Err(MotionError::AxialDip {
                dip_deg: self.axial_dip.to_degrees(),
            });
        }
        let length = match self.shape {
            FoldShape::Train { wavelength, .. } => wavelength,
            FoldShape::Pair { width, .. } => width,
        };
        if !(length > 0.0 && length.is_finite() && self.shape.steepest().is_finite()) {
            return Err(MotionError::Number {
                name: "width",
                value: length,
            });
        }
        let pitch = self.plunge.sin() / self.axial_dip.sin();
        if !(pitch.abs() < 1.0) {
            return Err(MotionError::Plunge {
                plunge_deg: self.plunge.to_degrees(),
                axial_dip_deg: self.axial_dip.to_degrees(),
            });
        }
        let (x, y) = sin_cos(self.azimuth);
        let towards = DVec2::new(x, y);
        let (sin, cos) = sin_cos(self.axial_dip);
        let up = (-cos * towards).extend(sin);
        let strike = towards.perp().extend(0.0);
        let across = (sin * towards).extend(cos);
        Ok(Motion::Fold(SimilarFold {
            through: self.through,
            along: (1.0 - pitch * pitch).sqrt() * up + pitch * strike,
            across,
            shape: self.shape,
        }))
    }
}

impl SimilarFold {
    fn by(&self, p: DVec3) -> DVec3 {
        self.shape.value((p - self.through).dot(self.across)) * self.along
    }

    pub(super) fn forward(&self, p: DVec3) -> DVec3 {
        p + self.by(p)
    }

    pub(super) fn inverse(&self, p: DVec3) -> DVec3 {
        p - self.by(p)
    }

    /// Whether all places of an upright line move as one: if the axial planes are upright.
    pub(super) fn keeps_uprights(&self) -> bool {
        self.across.z == 0.0
    }

    /// Whether the same is so, and they stay where they are in plan.
    pub(super) fn lifts_only(&self) -> bool {
        self.keeps_uprights() && self.along.x == 0.0 && self.along.y == 0.0
    }

    /// The horizontal direction across its axial planes.
    pub(super) fn bends_along(&self) -> Option<DVec2> {
        self.across.truncate().try_normalize()
    }

    /// The box of all that it moves a place by.
    pub(super) fn reach(&self) -> [DVec3; 2] {
        let [a, b] = self.shape.range().map(|f| f * self.along);
        [a.min(b), a.max(b)]
    }
}
