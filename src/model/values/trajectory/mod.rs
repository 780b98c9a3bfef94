//! Trajectories: the way that a feature takes in plan.

mod draw;
mod read;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::quantity::Quantity;
use crate::model::expression::Expression;
use crate::model::read::{Any, Field};
use crate::model::tables::by_kind;
use crate::nurbs::interpolate::Parametrization;

pub(crate) use draw::{extent, rejection, trajectory};

/// The way that a feature takes, in plan.
#[derive(Clone, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "a model has one for each feature, not for each instance"
)]
pub enum TrajectorySpec {
    /// A straight line between two points.
    Line {
        /// Start.
        from: [Quantity; 2],
        /// End.
        to: [Quantity; 2],
    },
    /// A straight line in a direction.
    Heading {
        /// Direction, clockwise from north, degrees.
        azimuth_deg: Quantity,
        /// A point of the line, its middle if a length is given; uniform over the domain if absent.
        center: Option<[Quantity; 2]>,
        /// Length; right across the domain if absent.
        length: Option<Quantity>,
    },
    /// A curve through points.
    Points {
        /// The points, in order, no two neighbours alike.
        points: Vec<[f64; 2]>,
        /// How the curve's parameter is spread over the points.
        parametrization: Parametrization,
        /// Degree of the curve, below the number of points.
        degree: usize,
    },
    /// A sine-generated (meandering) curve.
    SineGenerated {
        /// Half of peak to peak across the mean direction.
        amplitude: Quantity,
        /// Length of one meander along the mean direction.
        wavelength: Quantity,
        /// Mean direction, clockwise from north, degrees.
        azimuth_deg: Quantity,
        /// Middle of the curve; uniform over the domain if absent.
        center: Option<[Quantity; 2]>,
        /// Where the curve is in its meander at the centre, as a fraction of a wavelength.
        phase: Option<Quantity>,
        /// Length along the mean direction; right across the domain if absent.
        length: Option<Quantity>,
    },
    /// Two formulas in `t`.
    Parametric {
        /// x of t.
        x: Expression,
        /// y of t.
        y: Expression,
        /// From which t to which.
        range: [f64; 2],
    },
}

/// What every trajectory has.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TrajectoryFile {
    /// What it is.
    pub(crate) kind: Field<String>,
}

/// A straight line: either `from` and `to`, or `azimuth_deg` with an optional `center` and `length`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LineFile {
    /// Start, [x, y].
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) from: Option<Field<Any>>,
    /// End, [x, y].
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) to: Option<Field<Any>>,
    /// Direction in degrees, clockwise from north.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) azimuth_deg: Option<Field<Any>>,
    /// A point of the line, its middle if a length is given; uniform over the domain if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Length in metres; right across the domain if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) length: Option<Field<Any>>,
}

/// A curve through points.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PointsFile {
    /// The points [x, y] in order, at least two.
    #[schemars(with = "Vec<[f64; 2]>", length(min = 2))]
    pub(crate) points: Field<Any>,
    /// How the curve's parameter is spread over the points: "centripetal" (the default) or "chord-length".
    #[schemars(schema_with = "parametrization")]
    #[serde(default)]
    pub(crate) parametrization: Option<Field<String>>,
    /// Degree of the curve, 1 (straight pieces) to 3 (the default), below the number of points.
    #[schemars(range(min = 1, max = 3))]
    pub(crate) degree: Option<Field<u64>>,
}

/// A sine-generated curve: the direction swings as a sine along the way, as meanders do.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SineGeneratedFile {
    /// Half of peak to peak, in metres.
    #[schemars(with = "Quantity")]
    pub(crate) amplitude: Field<Any>,
    /// Length of one meander along the mean direction, in metres.
    #[schemars(with = "Quantity")]
    pub(crate) wavelength: Field<Any>,
    /// Mean direction in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
    /// Middle of the curve, [x, y]; uniform over the domain if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Where the curve is in its meander at the centre, as a fraction of a wavelength; uniform if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) phase: Option<Field<Any>>,
    /// Length along the mean direction in metres; right across the domain if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) length: Option<Field<Any>>,
}

/// Two formulas in `t`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ParametricFile {
    /// x in metres, a formula in t as "1000 * t".
    pub(crate) x: Field<String>,
    /// y in metres, a formula in t as "500 + 80 * sin(2 * pi * t)".
    pub(crate) y: Field<String>,
    /// From which t to which; [0, 1] if left out.
    pub(crate) range: Option<Field<[f64; 2]>>,
}

pub(crate) fn schema(generator: &mut SchemaGenerator) -> Schema {
    let common = TrajectoryFile::json_schema(generator);
    let kinds = [
        ("line", LineFile::json_schema(generator)),
        ("points", PointsFile::json_schema(generator)),
        ("sine-generated", SineGeneratedFile::json_schema(generator)),
        ("parametric", ParametricFile::json_schema(generator)),
    ];
    by_kind(&common, &kinds)
}

fn parametrization(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["centripetal", "chord-length"] })
}
