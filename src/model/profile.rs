//! Profiles: quantities that may vary along a trajectory.
//!
//! `s` is the fraction of the way along the trajectory, 0 at its start and 1 at its end.

use super::expression::Expression;
use super::quantity::Quantity;

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

impl Profile {
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
