//! Motions that are affine maps: tilts and simple shear. Of these control points make exactly what surfaces make.

use glam::{DMat3, DVec2, DVec3};

use super::{Motion, MotionError};
use crate::features::fault_surface::sin_cos;

/// An affine map about a place that stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    through: DVec3,
    map: DMat3,
    back: DMat3,
}

impl Affine {
    /// Everything rotated about a level axis through a place, so that what is level dips by an angle towards an azimuth (rad).
    pub fn tilt(through: DVec3, dip: f64, azimuth: f64) -> Result<Motion, MotionError> {
        for (name, value) in [("dip", dip), ("azimuth", azimuth)] {
            if !value.is_finite() {
                return Err(MotionError::Number { name, value });
            }
        }
        let (x, y) = sin_cos(azimuth);
        let towards = DVec2::new(x, y);
        let map = DMat3::from_axis_angle(towards.perp().extend(0.0), dip);
        Ok(Motion::Affine(Self {
            through,
            map,
            back: map.transpose(),
        }))
    }

    /// Simple shear: planes across a unit normal slide over one another, each by a vector in the planes times its distance from the one
    /// through a place.
    pub fn shear(through: DVec3, normal: DVec3, by: DVec3) -> Result<Motion, MotionError> {
        if !(normal.is_finite() && by.is_finite() && (normal.length() - 1.0).abs() < 1e-9) {
            return Err(MotionError::Number {
                name: "shear",
                value: by.length(),
            });
        }
        let by = by - by.dot(normal) * normal;
        let outer = DMat3::from_cols(normal.x * by, normal.y * by, normal.z * by);
        Ok(Motion::Affine(Self {
            through,
            map: DMat3::IDENTITY + outer,
            back: DMat3::IDENTITY - outer,
        }))
    }

    pub(super) fn forward(&self, p: DVec3) -> DVec3 {
        self.through + self.map * (p - self.through)
    }

    pub(super) fn inverse(&self, p: DVec3) -> DVec3 {
        self.through + self.back * (p - self.through)
    }

    /// Whether upright lines stay upright.
    pub(super) fn keeps_uprights(&self) -> bool {
        let up = self.map.z_axis;
        up.x == 0.0 && up.y == 0.0
    }
}
