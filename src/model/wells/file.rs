//! The tables of wells in a model file, as they are written.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::data::survey::{Column, SurveyFormat};
use crate::model::read::{Any, Field};
use crate::model::values::unit::UNITS;

/// Words for paths.
pub(super) const PATHS: [&str; 2] = ["spline", "minimum-curvature"];
/// Words for how parameters of a spline are spread.
pub(super) const SPACINGS: [&str; 2] = ["chord-length", "centripetal"];

/// A well: a curve through the stations of its survey.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Well")]
pub(crate) struct WellFile {
    /// Its name in all results: letters, digits, `-` and `_`.
    #[schemars(regex(pattern = "^[A-Za-z0-9_-]+$"))]
    pub(crate) id: Field<String>,
    /// Easting and northing of the wellhead in metres (`plan_unit`); the survey's own if left out.
    pub(crate) head: Option<Field<[f64; 2]>>,
    /// Elevation of the depth reference (Kelly bushing, rotary table) above mean sea level, in `unit`; the file's own, or 0, if left out.
    pub(crate) datum: Option<Field<f64>>,
    /// Unit of all depths, elevations and distances of the well: "m", "ft" (0.3048 m) or "us-ft" (1200/3937 m); "m" if left out.
    #[schemars(schema_with = "units")]
    #[serde(default)]
    pub(crate) unit: Option<Field<String>>,
    /// Unit of eastings and northings; "m" if left out.
    #[schemars(schema_with = "units")]
    #[serde(default)]
    pub(crate) plan_unit: Option<Field<String>>,
    /// Whether coordinates are those of the world, from which the model's `origin` is subtracted; if left out, true of those in a file and false of those in the model file.
    pub(crate) world: Option<Field<bool>>,
    /// The stations: a list of tables `{ md, inc_deg, azi_deg }`, `{ azi_deg, dip_deg, distance }` or `{ x, y, z }`; or a file of them.
    #[schemars(schema_with = "survey")]
    pub(crate) survey: Field<Any>,
    /// How stations are joined: "spline", a NURBS curve through all of them, or "minimum-curvature", arcs of circles; "spline" if left out.
    #[schemars(schema_with = "paths")]
    #[serde(default)]
    pub(crate) path: Option<Field<String>>,
    /// How the parameters of a spline are spread over its stations: "chord-length" or "centripetal", which is calmer at sharp turns; "chord-length" if left out.
    #[schemars(schema_with = "spacings")]
    #[serde(default)]
    pub(crate) parametrization: Option<Field<String>>,
    /// Where the well is open to the rock, [[from, to], …] by measured depth in `unit`.
    #[schemars(with = "Option<Vec<[f64; 2]>>")]
    pub(crate) completions: Option<Field<Any>>,
    /// Diameter of the hole in metres.
    pub(crate) diameter: Option<Field<f64>>,
    /// Laterals and side-tracks, which leave the well at a measured depth and share a control point with it.
    #[schemars(with = "Option<Vec<LateralFile>>")]
    pub(crate) laterals: Option<Field<Any>>,
}

/// A lateral or side-track of a well, or of another one; units, datum and origin are its mother's.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Lateral")]
pub(crate) struct LateralFile {
    /// Its name: letters, digits, `-` and `_`. In results it stands after the well's, as `A-1/north`.
    #[schemars(regex(pattern = "^[A-Za-z0-9_-]+$"))]
    pub(crate) id: Field<String>,
    /// The measured depth of the well at which it leaves that; its own measured depth goes on from there.
    pub(crate) at_md: Field<f64>,
    /// Its stations below that, as those of a well.
    #[schemars(schema_with = "survey")]
    pub(crate) survey: Field<Any>,
    /// How stations are joined; as the well's if left out.
    #[schemars(schema_with = "paths")]
    #[serde(default)]
    pub(crate) path: Option<Field<String>>,
    /// How the parameters of a spline are spread; as the well's if left out.
    #[schemars(schema_with = "spacings")]
    #[serde(default)]
    pub(crate) parametrization: Option<Field<String>>,
    /// Where it is open to the rock, [[from, to], …] by measured depth.
    #[schemars(with = "Option<Vec<[f64; 2]>>")]
    pub(crate) completions: Option<Field<Any>>,
    /// Diameter of the hole in metres.
    pub(crate) diameter: Option<Field<f64>>,
    /// Laterals of its own.
    #[schemars(with = "Option<Vec<Self>>")]
    pub(crate) laterals: Option<Field<Any>>,
}

/// One station: measured depth with directions, a step, or a point. All of a survey are of one kind.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Station")]
pub(crate) struct StationFile {
    /// Measured depth from the depth reference; of points it may be left out, and is then the length of the path.
    pub(crate) md: Option<Field<f64>>,
    /// Inclination in degrees: 0 downwards, 90 level, more where the hole rises.
    #[schemars(range(min = 0, max = 180))]
    pub(crate) inc_deg: Option<Field<f64>>,
    /// Azimuth in degrees, clockwise from grid north.
    pub(crate) azi_deg: Option<Field<f64>>,
    /// Dip of a step below the horizontal in degrees.
    #[schemars(range(min = -90, max = 90))]
    pub(crate) dip_deg: Option<Field<f64>>,
    /// Length of a step.
    pub(crate) distance: Option<Field<f64>>,
    /// Easting of a point.
    pub(crate) x: Option<Field<f64>>,
    /// Northing of a point.
    pub(crate) y: Option<Field<f64>>,
    /// Elevation of a point.
    pub(crate) z: Option<Field<f64>>,
}

/// A survey from a file: a Petrel well trace, LAS, or a table with a header.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SurveyFile")]
pub(crate) struct SurveyOfFile {
    /// The file; its path begins at the model file's folder.
    pub(crate) file: Field<String>,
    /// How it is written: "dev", "las" or "csv"; found from what it holds if left out.
    #[schemars(schema_with = "formats")]
    #[serde(default)]
    pub(crate) format: Option<Field<String>>,
    /// What its columns are called, by what they mean: `{ md = "DEPTH", inc_deg = "DEVI", azi_deg = "HAZI" }`, or their numbers from 1. They are found by their usual names if left out.
    #[schemars(schema_with = "columns")]
    #[serde(default)]
    pub(crate) columns: Option<Field<Any>>,
}

fn words(words: &[&str]) -> Schema {
    json_schema!({ "enum": words })
}

fn units(_: &mut SchemaGenerator) -> Schema {
    words(&UNITS.map(|(name, _)| name))
}

fn paths(_: &mut SchemaGenerator) -> Schema {
    words(&PATHS)
}

fn spacings(_: &mut SchemaGenerator) -> Schema {
    words(&SPACINGS)
}

fn formats(_: &mut SchemaGenerator) -> Schema {
    words(&SurveyFormat::ALL.map(SurveyFormat::word))
}

fn columns(_: &mut SchemaGenerator) -> Schema {
    let one = |column: &Column| {
        let word = column.word();
        let told = format!("What the column of {word} is called, or its number from 1.");
        let called = json!({ "description": told, "type": ["string", "integer"], "minimum": 1 });
        (word.to_owned(), called)
    };
    let keys: Map<String, Value> = Column::ALL.iter().map(one).collect();
    json_schema!({ "type": "object", "properties": keys, "additionalProperties": false })
}

/// A list of stations, or a file.
fn survey(generator: &mut SchemaGenerator) -> Schema {
    let station = generator.subschema_for::<StationFile>();
    let file = generator.subschema_for::<SurveyOfFile>();
    json_schema!({
        "type": ["array", "object"],
        "if": { "type": "array" },
        "then": { "items": station, "minItems": 1 },
        "else": file,
    })
}
