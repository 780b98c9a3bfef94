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

/// The mean thickness (m) between two horizons over a domain's plan, by a number of samples along each side; an error if there
/// is none at one of them.
pub(super) fn mean(
    base: &Horizon,
    top: &Horizon,
    plan: [DVec3; 2],
    samples: usize,
) -> Result<f64, NoThickness> {
    let unit = Thickness::new(base, top, plan, samples)?;
    unit.none.map_or(Ok(unit.mean), Err)
}

/// How thick what lies between two horizons is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Thickness {
    /// The mean over the places that have a thickness (m).
    pub(super) mean: f64,
    /// The first place that has none.
    pub(super) none: Option<NoThickness>,
}

impl Thickness {
    /// By a number of samples along each side of a domain's plan; an error if none of them has any.
    pub(super) fn new(
        base: &Horizon,
        top: &Horizon,
        [low, high]: [DVec3; 2],
        samples: usize,
    ) -> Result<Self, NoThickness> {
        let steps = (samples - 1) as f64;
        let (mut sum, mut count) = (0.0, 0.0);
        let mut none = None;
        for i in 0..samples {
            for j in 0..samples {
                let part = DVec2::new(i as f64, j as f64) / steps;
                let DVec2 { x, y } = low.xy() + (high - low).xy() * part;
                let (base, top) = (base.height(x, y), top.height(x, y));
                if top > base {
                    sum += top - base;
                    count += 1.0;
                } else {
                    none = none.or(Some(NoThickness { x, y, top, base }));
                }
            }
        }
        match none {
            Some(none) if count == 0.0 => Err(none),
            _ => Ok(Self {
                mean: sum / count,
                none,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use std::f64::consts::PI;

    use super::*;

    const PLAN: [DVec3; 2] = [
        DVec3::new(100.0, -50.0, -30.0),
        DVec3::new(500.0, 150.0, 0.0),
    ];

    #[test]
    fn the_mean_thickness_between_planes_is_that_in_the_middle_of_the_plan() {
        let base = Horizon::dipping(DVec3::new(0.0, 0.0, -20.0), 0.01, 0.4).unwrap();
        let top = Horizon::dipping(DVec3::new(300.0, 50.0, -5.0), 0.02, 2.5).unwrap();
        let wanted = -5.0 - base.height(300.0, 50.0);
        let found = mean(&base, &top, PLAN, 33).unwrap();
        assert!((found - wanted).abs() < 1e-10, "{found} {wanted}");
    }

    #[test]
    fn horizons_that_touch_are_refused_with_the_place() {
        let flat = |level: f64| Horizon::flat(level).unwrap();
        let touch = mean(&flat(-10.0), &flat(-10.0), PLAN, 5).unwrap_err();
        assert_eq!((touch.x, touch.y), (100.0, -50.0));
        assert_eq!((touch.base, touch.top), (-10.0, -10.0));
        // A plane that falls northwards meets the level where the plan ends, and only there.
        let falling = Horizon::dipping(DVec3::new(0.0, 150.0, -10.0), 0.02, 0.0).unwrap();
        let NoThickness { y, .. } = mean(&flat(-9.99), &falling, PLAN, 5).unwrap_err();
        assert_eq!(y, 150.0);
        assert!(mean(&flat(-10.01), &falling, PLAN, 5).is_ok());
    }

    #[test]
    fn the_mean_thickness_of_what_ends_is_that_of_what_there_is() {
        // From 4 m above the base at the western border to 4 m below it at the eastern one.
        let base = Horizon::flat(-10.0).unwrap();
        let falling =
            Horizon::dipping(DVec3::new(300.0, 0.0, -10.0), 0.02_f64.atan(), PI / 2.0).unwrap();
        let wedge = Thickness::new(&base, &falling, PLAN, 401).unwrap();
        assert!((wedge.mean - 2.0).abs() < 0.02, "{}", wedge.mean);
        assert_eq!(wedge.none.map(|place| place.y), Some(-50.0));
        let below = Horizon::flat(-11.0).unwrap();
        let none = Thickness::new(&base, &below, PLAN, 5).unwrap_err();
        assert_eq!((none.top, none.base), (-11.0, -10.0));
    }
}
