//! Rock properties as a model file gives them: numbers or distributions, along axes, along layers, or changing from base to top.
//!
//! They stand in the tables of facies and in the `properties` of features. A facies' are drawn for every volume of it; those of a feature
//! come before them in its own volumes. Each draw has the identity of its volume and the name of the property.

mod read;
mod schema;

use super::quantity::Quantity;
use crate::features::fabric::Fabric;
use crate::model::draws::{Draws, Reason};
use crate::model::properties::Property;

pub(crate) use schema::{Properties, any_property};

/// A rock property.
#[derive(Clone, Debug, PartialEq)]
pub enum PropertySpec {
    /// One number, the same in all directions.
    Scalar(Graded),
    /// Along x, y and z.
    Axes([Graded; 3]),
    /// Along dip, strike and normal of the layers.
    Layers([Graded; 3]),
    /// Along x and y, and along z as a fraction of that.
    Level {
        /// Along x and y.
        horizontal: Graded,
        /// Along z, as a fraction of the horizontal one.
        vertical_fraction: Quantity,
    },
}

/// A number of a volume, or one that changes from the base to the top of what is divided into layers.
#[derive(Clone, Debug, PartialEq)]
pub enum Graded {
    /// The same everywhere.
    Even(Quantity),
    /// From base to top.
    Rising {
        /// At the base.
        base: Quantity,
        /// At the top.
        top: Quantity,
        /// Whether its logarithm is linear in between, not itself.
        is_log: bool,
    },
}

impl PropertySpec {
    /// Whether it depends on which way the layers lie.
    pub(crate) fn needs_fabric(&self) -> bool {
        matches!(self, Self::Layers(_))
    }

    /// The value in a volume that lies at a fraction of the way from the base to the top of what it is a layer of, and whose
    /// layers lie like that. What is one number or three is kept so; `is_tensor` asks for three in place of one.
    pub(crate) fn draw(
        &self,
        draws: &mut Draws<'_>,
        parameter: &str,
        fraction: f64,
        fabric: &Fabric,
        is_tensor: bool,
    ) -> Result<Property, Reason> {
        let mut three = |values: &[Graded; 3], names: [&str; 3]| -> Result<[f64; 3], Reason> {
            let mut drawn = [0.0; 3];
            for ((drawn, value), name) in drawn.iter_mut().zip(values).zip(names) {
                *drawn = value.draw(draws, &format!("{parameter}.{name}"), fraction)?;
            }
            Ok(drawn)
        };
        Ok(match self {
            Self::Axes(values) => Property::Vector(three(values, ["x", "y", "z"])?),
            Self::Layers(values) => {
                Property::Tensor(fabric.tensor(three(values, ["dip", "strike", "normal"])?))
            }
            Self::Scalar(value) => {
                let value = value.draw(draws, parameter, fraction)?;
                if is_tensor {
                    Property::Vector([value; 3])
                } else {
                    Property::Scalar(value)
                }
            }
            Self::Level {
                horizontal,
                vertical_fraction,
            } => {
                let level = horizontal.draw(draws, &format!("{parameter}.horizontal"), fraction)?;
                let name = format!("{parameter}.vertical_fraction");
                let part = draws.quantity(vertical_fraction, &name)?;
                Property::Vector([level, level, part * level])
            }
        })
    }
}

impl Graded {
    fn draw(&self, draws: &mut Draws<'_>, parameter: &str, fraction: f64) -> Result<f64, Reason> {
        match self {
            Self::Even(quantity) => draws.quantity(quantity, parameter),
            Self::Rising { base, top, is_log } => {
                let base = draws.quantity(base, &format!("{parameter}.base"))?;
                let top = draws.quantity(top, &format!("{parameter}.top"))?;
                Ok(if *is_log {
                    base.powf(1.0 - fraction) * top.powf(fraction)
                } else {
                    base + (top - base) * fraction
                })
            }
        }
    }
}

impl From<f64> for PropertySpec {
    fn from(value: f64) -> Self {
        Self::Scalar(Graded::Even(Quantity::Constant(value)))
    }
}

impl From<[f64; 3]> for PropertySpec {
    fn from(values: [f64; 3]) -> Self {
        Self::Axes(values.map(|value| Graded::Even(Quantity::Constant(value))))
    }
}
