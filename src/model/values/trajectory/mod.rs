//! Trajectories: the way that a feature takes in plan.

mod draw;
mod read;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde_json::json;

use super::quantity::Quantity;
use crate::model::expression::Expression;
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::tables::{by_kind, or_form};
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
    /// That of another feature, or beside it.
    Like {
        /// The other feature.
        other: Reference,
        /// How far to the right of it, looking along it.
        offset: Quantity,
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

impl TrajectorySpec {
    /// What it refers to.
    pub(crate) fn refers(&self) -> Vec<&Reference> {
        match self {
            Self::Like { other, .. } => vec![other],
            _ => Vec::new(),
        }
    }
}

/// What every trajectory has that is like no other.
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

/// The trajectory of another feature, or one beside it; in place of `kind`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LikeFile {
    /// Name of another feature whose trajectory it has: its id, or that of one of its instances, as "valley-2".
    pub(crate) like: Field<String>,
    /// How far to the right of it, looking along it, in metres; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) offset: Option<Field<Any>>,
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
    let mut schema = or_form(
        by_kind(&common, &kinds),
        "like",
        &LikeFile::json_schema(generator),
    );
    let examples = json!([
        { "kind": "line", "azimuth_deg": 45 },
        { "kind": "line", "from": [0, 300], "to": [1000, 600] },
        { "kind": "points", "points": [[0, 400], [500, 600], [1000, 500]] },
        { "kind": "sine-generated", "amplitude": 100, "wavelength": 500, "azimuth_deg": 45 },
        { "kind": "parametric", "x": "1000 * t", "y": "500 + 80 * sin(2 * pi * t)" },
    ]);
    schema.insert("examples".to_owned(), examples);
    schema
}

fn parametrization(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["centripetal", "chord-length"] })
}
