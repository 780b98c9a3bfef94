//! Profiles: quantities that may vary along a trajectory.
//!
//! `s` is the fraction of the way along the trajectory, 0 at its start and 1 at its end.

use super::distribution::DrawError;
use super::expression::{EvaluationError, Expression};
use super::quantity::Quantity;
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::{Course, Profile};
    use crate::model::{Distribution, Expression, Quantity, Stream};

    #[test]
    fn a_list_is_linear_between_its_points_and_constant_outside() {
        let course = Course::Along(vec![(0.2, 10.0), (0.6, 30.0), (0.8, 20.0)]);
        for (s, value) in [
            (0.0, 10.0),
            (0.2, 10.0),
            (0.3, 15.0),
            (0.6, 30.0),
            (0.7, 25.0),
            (0.8, 20.0),
            (1.0, 20.0),
        ] {
            assert!((course.at(s).unwrap() - value).abs() < 1e-12, "{s}");
        }
    }

    #[test]
    fn a_drawn_list_keeps_its_fractions_and_draws_every_value_once() {
        let random = Quantity::Random(Distribution::uniform(0.0, 1.0).unwrap());
        let profile = Profile::Along(vec![
            (0.0, random.clone()),
            (0.5, Quantity::Constant(7.0)),
            (1.0, random),
        ]);
        let mut stream = Stream::new(1, "a", 0, "width", 0);
        let mut same = stream.clone();
        let Course::Along(points) = profile.draw(&mut stream).unwrap() else {
            unreachable!()
        };
        assert_eq!(points, [(0.0, same.unit()), (0.5, 7.0), (1.0, same.unit())]);
    }

    #[test]
    fn a_formula_is_evaluated_at_the_fraction() {
        let formula = Expression::new("20 + 10 * s", "s").unwrap();
        let mut stream = Stream::new(1, "a", 0, "width", 0);
        let course = Profile::Expression(formula).draw(&mut stream).unwrap();
        assert_eq!(course.at(0.5), Ok(25.0));
        assert!(!course.is_constant());
    }
}
