//! Quantities: numbers that are given, or drawn from a distribution.

use super::distribution::{Distribution, DrawError};
use super::stream::Stream;

/// A number: given, or drawn anew for every instance.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// The same number for every instance.
    Constant(f64),
    /// Drawn for every instance.
    Random(Distribution),
}

impl Quantity {
    /// The constant, or the next number of the distribution.
    pub fn sample(&self, stream: &mut Stream) -> Result<f64, DrawError> {
        match self {
            Self::Constant(value) => Ok(*value),
            Self::Random(distribution) => distribution.sample(stream),
        }
    }

    /// The expected value.
    pub fn mean(&self) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Random(distribution) => distribution.mean(),
        }
    }

    /// The smallest and the largest possible value; infinite where nothing limits it.
    pub fn support(&self) -> (f64, f64) {
        match self {
            Self::Constant(value) => (*value, *value),
            Self::Random(distribution) => distribution.support(),
        }
    }

    /// The value, if it never varies.
    pub fn constant(&self) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            Self::Random(_) => None,
        }
    }
}

impl From<f64> for Quantity {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}
