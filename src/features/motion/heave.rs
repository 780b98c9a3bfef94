//! Slip over a fault that is a graph z = F(x′, y′): the hanging wall slides by a heave, and each of its shear lines follows the fault.
//!
//! *Vertical shear* (Verrall 1981): (x′, y′, z) ↦ (x′ + h, y′, z + F(x′ + h, y′) − F(x′, y′)). The fault maps onto itself, the Jacobian is 1,
//! the inverse is the same with −h, and h may vary along y′. *Inclined shear* (White, Jackson & `McKenzie` 1986): the same in ξ = x′ − z tan θ,
//! which is constant along lines that lean by θ from the vertical, antithetic where θ > 0, and F*(ξ) the fault's elevation on them:
//! (ξ, z) ↦ (ξ + h, z + F*(ξ + h) − F*(ξ)), x′ = ξ + z tan θ. Then h is the heave on the detachment.
//!
//! On a plane either is a translation.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::root::root;
use super::variation::Variation;
use super::{Motion, MotionError};
use crate::features::fault_surface::{FaultSurface, sin_cos};

/// Places at which the slope of a fault is looked at, to see whether shear lines cross it once.
const ASKED: usize = 200;

/// Slip over a fault that is a graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Heave {
    surface: Arc<FaultSurface>,
    /// x′: the horizontal unit vector of the heave.
    direction: DVec2,
    amount: Variation,
    /// tan θ.
    lean: f64,
}

/// What a slip over a fault is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct HeaveDesign {
    /// The fault.
    pub surface: Arc<FaultSurface>,
    /// The horizontal direction of slip, clockwise from north (rad); the fault's dip direction if absent.
    pub azimuth: Option<f64>,
    /// How far the hanging wall moves in this direction (m), by places along the direction's left-hand side from the fault's own point.
    pub heave: Variation,
    /// θ (rad): 0 is vertical shear, more is antithetic.
    pub shear: f64,
    /// The box in which shear lines have to cross the fault once.
    pub within: [DVec3; 2],
}

impl HeaveDesign {
    /// The motion.
    pub fn build(self) -> Result<Motion, MotionError> {
        let surface = self.surface;
        let direction = match self.azimuth {
            Some(azimuth) => {
                let (sin, cos) = sin_cos(azimuth);
                DVec2::new(sin, cos)
            }
            None => surface.dip_direction(),
        };
        if !(self.shear.is_finite() && direction.is_finite()) {
            return Err(MotionError::Number {
                name: "angle of shear",
                value: self.shear,
            });
        }
        if surface.height(surface.through().xy()).is_none() {
            return Err(MotionError::Upright);
        }
        let heave = Heave {
            surface,
            direction,
            amount: self.heave,
            lean: self.shear.tan(),
        };
        if let (Some(_), Some(h)) = (heave.surface.dip(), heave.amount.fixed()) {
            let from = heave.surface.through();
            return Ok(Motion::Shift(heave.slid(from, h) - from));
        }
        heave.check(self.within, self.shear)?;
        Ok(Motion::Heave(heave))
    }
}

impl Heave {
    /// The fault.
    pub fn surface(&self) -> &Arc<FaultSurface> {
        &self.surface
    }

    /// Whether all places of an upright line move as one.
    pub(super) fn keeps_uprights(&self) -> bool {
        self.lean == 0.0
    }

    /// The heave, if it is the same everywhere and shear is vertical.
    pub(super) fn plan_shift(&self) -> Option<DVec2> {
        let heave = self.amount.fixed().filter(|_| self.keeps_uprights())?;
        Some(heave * self.direction)
    }

    /// Whether shear lines lean more than the fault, in a box.
    fn check(&self, [low, high]: [DVec3; 2], shear: f64) -> Result<(), MotionError> {
        if self.lean == 0.0 {
            return Ok(());
        }
        let reach = (high - low).length();
        let middle = 0.5 * (low + high).xy();
        for k in 0..=ASKED {
            for j in 0..=10 {
                let part = |k: usize, n: usize| 2.0 * reach * (k as f64 / n as f64 - 0.5);
                let at =
                    middle + part(k, ASKED) * self.direction + part(j, 10) * self.direction.perp();
                let slope = self.slope(at);
                if !(1.0 - slope * self.lean > 0.0) {
                    return Err(MotionError::Shear {
                        shear_deg: shear.to_degrees(),
                        dip_deg: slope.abs().atan().to_degrees(),
                    });
                }
            }
        }
        Ok(())
    }

    /// dF/dx′ in the direction of the heave.
    fn slope(&self, at: DVec2) -> f64 {
        let normal = self.surface.normal(at.extend(0.0));
        -normal.xy().dot(self.direction) / normal.z
    }

    fn fault(&self, at: DVec2) -> f64 {
        // Not upright: `build` has seen to that.
        self.surface.height(at).unwrap_or(f64::NAN)
    }

    /// The elevation of the fault on the shear line through a place at the elevation 0.
    fn on_line(&self, foot: DVec2) -> f64 {
        if self.lean == 0.0 {
            return self.fault(foot);
        }
        let miss = |z: f64| z - self.fault(foot + (z * self.lean) * self.direction);
        // z − F(ξ + z tan θ) grows with z: go out from the fault's height there until the signs differ.
        let middle = self.fault(foot);
        let mut step = 1.0 + middle.abs();
        for _ in 0..60 {
            let (low, high) = (middle - step, middle + step);
            if miss(low) <= 0.0 && miss(high) >= 0.0 {
                return root(miss, low, high);
            }
            step *= 2.0;
        }
        f64::NAN
    }

    fn slid(&self, p: DVec3, heave: f64) -> DVec3 {
        if heave == 0.0 {
            return p;
        }
        let foot = p.xy() - (p.z * self.lean) * self.direction;
        let there = foot + heave * self.direction;
        let z = p.z + (self.on_line(there) - self.on_line(foot));
        let lean = (z - p.z) * self.lean;
        (p.xy() + (heave + lean) * self.direction).extend(z)
    }

    fn heave_at(&self, p: DVec3) -> f64 {
        let off = p.xy() - self.surface.through().xy();
        self.amount.value(off.dot(self.direction.perp()))
    }

    pub(super) fn forward(&self, p: DVec3) -> DVec3 {
        self.slid(p, self.heave_at(p))
    }

    pub(super) fn inverse(&self, p: DVec3) -> DVec3 {
        // The place across the direction stays, and with it the heave.
        self.slid(p, -self.heave_at(p))
    }
}
