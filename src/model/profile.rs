//! Profiles: quantities that may vary along a trajectory.
//!
//! `s` is the fraction of the way along the trajectory, 0 at its start and 1 at its end.

use super::expression::{EvaluationError, Expression};
use super::quantity::{DrawError, Quantity};
use super::stream::Stream;

/// A quantity that may vary along the trajectory, as the model file gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// The same all along.
    Quantity(Quantity),
    /// Piecewise linear between `(fraction, quantity)` pairs, whose fractions rise strictly inside [0, 1]; constant
    /// before the first and after the last.
    Along(Vec<(f64, Quantity)>),
    /// A formula in `s`.
    Expression(Expression),
}

/// A profile with its random numbers drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// The same all along.
    Constant(f64),
    /// Piecewise linear between `(fraction, value)` pairs.
    Along(Vec<(f64, f64)>),
    /// A formula in `s`.
    Expression(Expression),
}

impl Profile {
    /// Draws the random numbers, in the order of the list.
    pub fn draw(&self, stream: &mut Stream) -> Result<Course, DrawError> {
        Ok(match self {
            Self::Quantity(quantity) => Course::Constant(quantity.sample(stream)?),
            Self::Along(points) => Course::Along(
                points
                    .iter()
                    .map(|(fraction, quantity)| Ok((*fraction, quantity.sample(stream)?)))
                    .collect::<Result<_, _>>()?,
            ),
            Self::Expression(expression) => Course::Expression(expression.clone()),
        })
    }

    /// The value, if it is the same all along and never varies.
    pub fn constant(&self) -> Option<f64> {
        match self {
            Self::Quantity(quantity) => quantity.constant(),
            Self::Along(_) | Self::Expression(_) => None,
        }
    }
}

impl From<f64> for Profile {
    fn from(value: f64) -> Self {
        Self::Quantity(Quantity::Constant(value))
    }
}

impl Course {
    /// The value at the fraction `s` of the trajectory.
    pub fn at(&self, s: f64) -> Result<f64, EvaluationError> {
        match self {
            Self::Constant(value) => Ok(*value),
            Self::Along(points) => Ok(interpolate(points, s)),
            Self::Expression(expression) => expression.eval(s),
        }
    }

    /// Whether the value is the same all along.
    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Constant(_))
    }
}

fn interpolate(points: &[(f64, f64)], s: f64) -> f64 {
    let after = points.partition_point(|&(fraction, _)| fraction <= s);
    match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
        (Some((f0, v0)), Some(&(f1, v1))) => v0 + (v1 - v0) * (s - f0) / (f1 - f0),
        (Some((_, value)), None) | (None, Some(&(_, value))) => value,
        (None, None) => f64::NAN,
    }
}
