//! Thickness: how far a top horizon is above a base, at places spread evenly over a plan.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::horizon::Horizon;

/// A place where a top is not above its base.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("at x = {x:.1} m, y = {y:.1} m it is at {top:.3} m, not above its base at {base:.3} m")]
pub struct NoThickness {
    /// Easting (m).
    pub x: f64,
    /// Northing (m).
    pub y: f64,
    /// Elevation of the top there (m).
    pub top: f64,
    /// Elevation of the base there (m).
    pub base: f64,
}

/// The mean thickness (m) between two horizons over a domain's plan, by a number of samples along each side; the first
/// of them at which there is none ends the sum.
pub(super) fn mean(
    base: &Horizon,
    top: &Horizon,
    [low, high]: [DVec3; 2],
    samples: usize,
) -> Result<f64, NoThickness> {
    let steps = (samples - 1) as f64;
    let mut sum = 0.0;
    for i in 0..samples {
        for j in 0..samples {
            let part = DVec2::new(i as f64, j as f64) / steps;
            let DVec2 { x, y } = low.xy() + (high - low).xy() * part;
            let (base, top) = (base.height(x, y), top.height(x, y));
            if !(top > base) {
                return Err(NoThickness { x, y, top, base });
            }
            sum += top - base;
        }
    }
    Ok(sum / (samples * samples) as f64)
}
