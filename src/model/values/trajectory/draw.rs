//! Trajectories: their quantities drawn, and how far they run where no length is given.

use glam::DVec2;

use super::TrajectorySpec;
use crate::features::meander::SineGenerated;
use crate::features::trajectory::{Trajectory, TrajectoryError, azimuth_vector};
use crate::model::domain::Domain;
use crate::model::draws::{Draws, Reason};
use crate::model::expression::Expression;
use crate::model::kinds::made::Site;
use crate::model::values::quantity::Quantity;

/// The trajectory of an instance; one without a length runs as far past the domain as the overshoot says (m).
pub(crate) fn trajectory(
    spec: &TrajectorySpec,
    site: &Site<'_>,
    overshoot: f64,
    draws: &mut Draws<'_>,
) -> Result<Trajectory, Reason> {
    let domain = site.domain;
    let made = match spec {
        TrajectorySpec::Like { other, offset } => {
            let other = site.other_reach(other)?.trajectory();
            let offset = draws.quantity(offset, "trajectory.offset")?;
            other.beside(offset)
        }
        TrajectorySpec::Line { from, to } => {
            let from = draws.point(from, "trajectory.from")?;
            let to = draws.point(to, "trajectory.to")?;
            Trajectory::line(from, to)
        }
        TrajectorySpec::Heading {
            azimuth_deg,
            center,
            length,
        } => {
            let azimuth = draws
                .quantity(azimuth_deg, "trajectory.azimuth_deg")?
                .to_radians();
            let center = draws.center(center.as_ref(), domain, "trajectory.center")?;
            let extent = extent(length.as_ref(), domain, center, azimuth, overshoot, draws)?;
            let axis = azimuth_vector(azimuth);
            Trajectory::line(center + axis * extent[0], center + axis * extent[1])
        }
        TrajectorySpec::Points {
            points,
            parametrization,
            degree,
        } => {
            let points: Vec<DVec2> = points.iter().map(|p| DVec2::from_array(*p)).collect();
            Trajectory::through(&points, *degree, *parametrization)
        }
        TrajectorySpec::SineGenerated {
            amplitude,
            wavelength,
            azimuth_deg,
            center,
            phase,
            length,
        } => {
            let amplitude = draws.quantity(amplitude, "trajectory.amplitude")?;
            let wavelength = draws.quantity(wavelength, "trajectory.wavelength")?;
            let azimuth = draws
                .quantity(azimuth_deg, "trajectory.azimuth_deg")?
                .to_radians();
            let center = draws.center(center.as_ref(), domain, "trajectory.center")?;
            let phase = match phase {
                Some(phase) => draws.quantity(phase, "trajectory.phase")?,
                None => draws.uniform(0.0, 1.0, "trajectory.phase")?,
            };
            let extent = extent(length.as_ref(), domain, center, azimuth, overshoot, draws)?;
            Trajectory::sine_generated(&SineGenerated {
                amplitude,
                wavelength,
                azimuth,
                center,
                phase,
                extent,
            })
        }
        TrajectorySpec::Parametric { x, y, range } => {
            let at = |t: f64| {
                let value = |expression: &Expression| expression.eval(t).unwrap_or(f64::NAN);
                DVec2::new(value(x), value(y))
            };
            Trajectory::parametric(&at, *range)
        }
    };
    made.map_err(|error| (rejection(&error), error.to_string()))
}

pub(crate) fn rejection(error: &TrajectoryError) -> &'static str {
    match error {
        TrajectoryError::Folds { .. } => "the offset folds in a bend",
        TrajectoryError::NoMeander { .. } => "amplitude too large for the wavelength",
        TrajectoryError::TooManyMeanders { .. } => "wavelength too short for the extent",
        _ => "impossible trajectory",
    }
}

/// From and to along an axis: the given length about the centre, or all across the domain and beyond.
pub(crate) fn extent(
    length: Option<&Quantity>,
    domain: &Domain,
    center: DVec2,
    azimuth: f64,
    overshoot: f64,
    draws: &mut Draws<'_>,
) -> Result<[f64; 2], Reason> {
    if let Some(length) = length {
        let length = draws.quantity(length, "trajectory.length")?;
        return Ok([-length / 2.0, length / 2.0]);
    }
    let axis = azimuth_vector(azimuth);
    let corners = domain
        .x
        .iter()
        .flat_map(|&x| domain.y.iter().map(move |&y| DVec2::new(x, y)));
    let (low, high) = corners
        .map(|corner| (corner - center).dot(axis))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), along| {
            (low.min(along), high.max(along))
        });
    Ok([low - overshoot, high + overshoot])
}
