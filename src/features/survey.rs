//! Deviation surveys: from what is measured down a hole to stations in space.
//!
//! Three kinds: measured depth with inclination and azimuth, by minimum curvature (Taylor & Mason 1972; Sawaryn & Thorogood 2005); steps
//! along azimuth and dip (\[J19\] §2.6); points. Inclination is 0 downwards and above 90° where the hole rises; azimuths are clockwise
//! from grid north. Angles are radians here, lengths metres, z up.

use glam::DVec3;

/// A place that a well passes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Measured depth (m); of points without one it follows from the path.
    pub md: Option<f64>,
    /// Where it is.
    pub point: DVec3,
    /// Unit tangent, if it was measured.
    pub tangent: Option<DVec3>,
}

/// One row of a survey by angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Measured depth (m).
    pub md: f64,
    /// From the vertical (rad).
    pub inclination: f64,
    /// Clockwise from grid north (rad).
    pub azimuth: f64,
}

/// One straight step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Clockwise from grid north (rad).
    pub azimuth: f64,
    /// Below the horizontal (rad).
    pub dip: f64,
    /// How far (m).
    pub distance: f64,
}

/// Why a survey gives no stations.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurveyError {
    /// There are not two stations.
    #[error("it has {found} station(s), and a path needs two")]
    TooFew {
        /// How many there are.
        found: usize,
    },
    /// A number is infinite or none.
    #[error("station {station} has a number that is not finite")]
    Number {
        /// Which, from 1.
        station: usize,
    },
    /// Measured depth does not grow.
    #[error(
        "the measured depth of station {station}, {md} m, is not below that of the one before it, {previous} m"
    )]
    Order {
        /// Which, from 1.
        station: usize,
        /// Its depth.
        md: f64,
        /// The one before.
        previous: f64,
    },
    /// A step goes nowhere or back.
    #[error("the distance of step {step} is {distance} m; it must be above 0")]
    Distance {
        /// Which, from 1.
        step: usize,
        /// How far.
        distance: f64,
    },
    /// The hole turns round between two stations.
    #[error(
        "between stations {station} and {} the direction turns by {turn_deg:.1}°; no arc of less than half a circle does that", station + 1
    )]
    Turn {
        /// The first of both, from 1.
        station: usize,
        /// By how much (degrees).
        turn_deg: f64,
    },
    /// Two stations are at one place.
    #[error("stations {station} and {} are at one place", station + 1)]
    Repeated {
        /// The first of both, from 1.
        station: usize,
    },
}

/// A turn from which on an arc is none: half a circle, but for rounding.
const MOST_TURN: f64 = std::f64::consts::PI - 1e-6;
/// Below this angle the ratio factor is its series, whose next term is below rounding.
const SMALL: f64 = 1e-4;

/// The unit tangent of a hole.
pub fn direction(inclination: f64, azimuth: f64) -> DVec3 {
    let (sine, cosine) = inclination.sin_cos();
    DVec3::new(sine * azimuth.sin(), sine * azimuth.cos(), -cosine)
}

/// The angle between two directions.
pub fn turn(one: DVec3, other: DVec3) -> f64 {
    one.cross(other).length().atan2(one.dot(other))
}

/// tan(β/2)/β, the ratio factor's half of a half: the arc's control point lies so far along the tangent, in arc lengths.
pub(super) fn half_factor(turn: f64) -> f64 {
    if turn < SMALL {
        0.5 + turn * turn / 24.0
    } else {
        (0.5 * turn).tan() / turn
    }
}

/// Stations by minimum curvature: between two of them the hole is an arc of a circle.
pub fn by_angles(from: DVec3, readings: &[Reading]) -> Result<Vec<Station>, SurveyError> {
    let mut stations: Vec<Station> = Vec::with_capacity(readings.len());
    let mut point = from;
    for (at, reading) in readings.iter().enumerate() {
        if ![reading.md, reading.inclination, reading.azimuth]
            .iter()
            .all(|n| n.is_finite())
        {
            return Err(SurveyError::Number { station: at + 1 });
        }
        let tangent = direction(reading.inclination, reading.azimuth);
        if let Some(before) = at.checked_sub(1).map(|k| readings[k]) {
            let along = reading.md - before.md;
            if !(along > 0.0) {
                return Err(SurveyError::Order {
                    station: at + 1,
                    md: reading.md,
                    previous: before.md,
                });
            }
            let last = direction(before.inclination, before.azimuth);
            let turn = turn(last, tangent);
            if turn > MOST_TURN {
                return Err(SurveyError::Turn {
                    station: at,
                    turn_deg: turn.to_degrees(),
                });
            }
            point += along * half_factor(turn) * (last + tangent);
        }
        stations.push(Station {
            md: Some(reading.md),
            point,
            tangent: Some(tangent),
        });
    }
    Ok(stations)
}

/// Stations at the ends of straight steps, the start included.
pub fn by_steps(from: DVec3, md: f64, steps: &[Step]) -> Result<Vec<Station>, SurveyError> {
    let mut stations = vec![Station {
        md: Some(md),
        point: from,
        tangent: None,
    }];
    let (mut point, mut md) = (from, md);
    for (at, step) in steps.iter().enumerate() {
        if ![step.azimuth, step.dip, step.distance]
            .iter()
            .all(|n| n.is_finite())
        {
            return Err(SurveyError::Number { station: at + 1 });
        }
        if !(step.distance > 0.0) {
            return Err(SurveyError::Distance {
                step: at + 1,
                distance: step.distance,
            });
        }
        let along = direction(std::f64::consts::FRAC_PI_2 - step.dip, step.azimuth);
        point += step.distance * along;
        md += step.distance;
        stations.push(Station {
            md: Some(md),
            point,
            tangent: None,
        });
    }
    Ok(stations)
}

/// Whether stations make a path: two at least, apart, and ever deeper where they have depths.
pub fn check(stations: &[Station]) -> Result<(), SurveyError> {
    if stations.len() < 2 {
        let found = stations.len();
        return Err(SurveyError::TooFew { found });
    }
    let is_finite =
        |station: &Station| station.point.is_finite() && station.md.is_none_or(f64::is_finite);
    if let Some(at) = stations.iter().position(|station| !is_finite(station)) {
        return Err(SurveyError::Number { station: at + 1 });
    }
    for (at, pair) in stations.windows(2).enumerate() {
        if let (Some(previous), Some(md)) = (pair[0].md, pair[1].md)
            && !(md > previous)
        {
            return Err(SurveyError::Order {
                station: at + 2,
                md,
                previous,
            });
        }
        if pair[0].point == pair[1].point {
            return Err(SurveyError::Repeated { station: at + 1 });
        }
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    fn reading(md: f64, inclination: f64, azimuth: f64) -> Reading {
        Reading {
            md,
            inclination: inclination.to_radians(),
            azimuth: azimuth.to_radians(),
        }
    }

    #[test]
    fn a_build_of_constant_rate_gains_r_sin_i_in_depth_and_r_times_1_minus_cos_i_in_step_out() {
        // 3° every 30 m, up to 60°, towards the east.
        let readings: Vec<Reading> = (0..=20)
            .map(|k| reading(30.0 * f64::from(k), 3.0 * f64::from(k), 90.0))
            .collect();
        let stations = by_angles(DVec3::ZERO, &readings).unwrap();
        let radius = 1_718.873_385_392_47 / 3.0;
        for (station, reading) in stations.iter().zip(&readings) {
            let (sine, cosine) = reading.inclination.sin_cos();
            let expected = DVec3::new(radius * (1.0 - cosine), 0.0, -radius * sine);
            assert!(station.point.distance(expected) < 1e-9, "{station:?}");
        }
    }

    #[test]
    fn steps_go_down_by_the_sine_of_their_dip() {
        let step = |azimuth: f64, dip: f64, distance| Step {
            azimuth: azimuth.to_radians(),
            dip: dip.to_radians(),
            distance,
        };
        let steps = [step(0.0, 90.0, 100.0), step(90.0, 30.0, 50.0)];
        let stations = by_steps(DVec3::new(1.0, 2.0, 3.0), 0.0, &steps).unwrap();
        assert!(stations[1].point.distance(DVec3::new(1.0, 2.0, -97.0)) < 1e-12);
        let east = 50.0 * 30_f64.to_radians().cos();
        assert!(
            stations[2]
                .point
                .distance(DVec3::new(1.0 + east, 2.0, -122.0))
                < 1e-12
        );
        assert_eq!(stations[2].md, Some(150.0));
    }

    #[test]
    fn what_makes_no_path_is_refused_with_its_station() {
        let order = by_angles(
            DVec3::ZERO,
            &[
                reading(0.0, 0.0, 0.0),
                reading(30.0, 1.0, 0.0),
                reading(30.0, 2.0, 0.0),
            ],
        );
        assert!(matches!(order, Err(SurveyError::Order { station: 3, .. })));
        let back = by_angles(
            DVec3::ZERO,
            &[reading(0.0, 0.0, 0.0), reading(30.0, 180.0, 0.0)],
        );
        assert!(matches!(back, Err(SurveyError::Turn { station: 1, .. })));
        let none = by_angles(DVec3::ZERO, &[reading(0.0, f64::NAN, 0.0)]);
        assert_eq!(none, Err(SurveyError::Number { station: 1 }));
        let one = by_angles(DVec3::ZERO, &[reading(0.0, 0.0, 0.0)]).unwrap();
        assert_eq!(check(&one), Err(SurveyError::TooFew { found: 1 }));
    }
}
