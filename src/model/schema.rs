//! The JSON Schema of the model file, for editors: completion, descriptions and most checks while typing.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use super::file::{
    ChannelFile, ClinoformsFile, DippingFile, EllipsoidFile, FeatureFile, GridFile, HorizonFile,
    LineFile, ModelFile, ParametricFile, PointsFile, SineGeneratedFile, TrajectoryFile,
};
use super::profile::Profile;
use super::quantity::Quantity;
use super::read::Field;
use super::spec::{HorizonSurface, Selector};

/// The JSON Schema (2020-12) of the model file.
pub fn schema() -> Value {
    let mut schema = schemars::schema_for!(ModelFile).to_value();
    forbid_null(&mut schema);
    schema
}

/// An absent key is left out, never null: drops the null that schemars allows for every optional key.
fn forbid_null(value: &mut Value) {
    match value {
        Value::Object(object) => {
            if object.get("default") == Some(&Value::Null) {
                object.remove("default");
            }
            if let Some(Value::Array(types)) = object.get_mut("type") {
                types.retain(|name| name != "null");
                if let [only] = types.as_slice() {
                    let only = only.clone();
                    object.insert("type".to_owned(), only);
                }
            }
            if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
                choices.retain(|choice| choice != &json!({ "type": "null" }));
                if let [Value::Object(only)] = choices.as_slice() {
                    let only = only.clone();
                    object.remove("anyOf");
                    object.extend(only);
                }
            }
            object.values_mut().for_each(forbid_null);
        }
        Value::Array(values) => values.iter_mut().for_each(forbid_null),
        _ => {}
    }
}

impl<T: JsonSchema> JsonSchema for Field<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl JsonSchema for Quantity {
    fn schema_name() -> Cow<'static, str> {
        "Quantity".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let distribution = generator.subschema_for::<DistributionSchema>();
        json_schema!({
            "description": "A number, or a distribution that it is drawn from.",
            "anyOf": [{ "type": "number" }, distribution],
        })
    }
}

impl JsonSchema for Profile {
    fn schema_name() -> Cow<'static, str> {
        "Profile".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let quantity = generator.subschema_for::<Quantity>();
        let distribution = generator.subschema_for::<DistributionSchema>();
        json_schema!({
            "description": "A quantity, or one that varies along the trajectory: a list of [fraction, quantity], or { expression = \"a formula in s\" }.",
            "anyOf": [
                { "type": "number" },
                distribution,
                {
                    "description": "Linear between pairs [fraction of the trajectory from 0 to 1, quantity], in rising order.",
                    "type": "array",
                    "minItems": 1,
                    "items": {
                        "type": "array",
                        "prefixItems": [{ "type": "number", "minimum": 0, "maximum": 1 }, quantity],
                        "minItems": 2,
                        "maxItems": 2,
                    },
                },
                {
                    "description": "A formula in s, the fraction of the trajectory, as \"30 + 10 * sin(2 * pi * s)\".",
                    "type": "object",
                    "properties": { "expression": { "type": "string" } },
                    "required": ["expression"],
                    "additionalProperties": false,
                },
            ],
        })
    }
}

/// Stands for the table of a distribution.
struct DistributionSchema;

impl JsonSchema for DistributionSchema {
    fn schema_name() -> Cow<'static, str> {
        "Distribution".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let numbers = |n: usize, description: &str| {
            json!({
                "description": description, "type": "array",
                "items": { "type": "number" }, "minItems": n, "maxItems": n,
            })
        };
        let only = |name: &str, value: Value| {
            json!({
                "type": "object", "properties": { name: value },
                "required": [name], "additionalProperties": false,
            })
        };
        let truncated = |name: &str, description: &str| {
            json!({
                "type": "object",
                "properties": {
                    name: numbers(2, description),
                    "min": { "description": "Draws below are repeated.", "type": "number" },
                    "max": { "description": "Draws above are repeated.", "type": "number" },
                },
                "required": [name],
                "additionalProperties": false,
            })
        };
        json_schema!({
            "description": "A distribution that a number is drawn from.",
            "anyOf": [
                only("uniform", numbers(2, "[minimum, maximum]")),
                only("triangular", numbers(3, "[minimum, most likely, maximum]")),
                truncated("normal", "[mean, standard deviation]"),
                truncated("lognormal", "[mean, standard deviation] of the quantity itself, not of its logarithm"),
                only("discrete", json!({
                    "description": "[value, …], all equally likely, or [[value, weight], …]",
                    "type": "array",
                    "minItems": 1,
                    "items": { "anyOf": [{ "type": "number" }, numbers(2, "[value, weight]")] },
                })),
            ],
        })
    }
}

impl JsonSchema for Selector {
    fn schema_name() -> Cow<'static, str> {
        "Selector".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let pick = |key: &str, value: Value| {
            json!({
                "type": "object", "properties": { key: value },
                "required": [key], "additionalProperties": false,
            })
        };
        json_schema!({
            "anyOf": [
                { "enum": ["older", "younger", "everything", "nothing"] },
                {
                    "type": "array",
                    "items": { "anyOf": [
                        { "description": "The id of a feature, or \"background\".", "type": "string" },
                        pick("id", json!({ "type": "string" })),
                        pick("kind", json!({ "type": "string" })),
                        pick("level", json!({ "type": "integer", "minimum": 1 })),
                        pick("facies", json!({ "type": "string" })),
                    ] },
                },
            ],
        })
    }
}

impl JsonSchema for HorizonSurface {
    fn schema_name() -> Cow<'static, str> {
        "Surface".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let level = generator.subschema_for::<Quantity>();
        let dipping = generator.subschema_for::<DippingFile>();
        let grid = generator.subschema_for::<GridFile>();
        let table = |properties: Value, required: &[&str]| {
            json!({
                "type": "object", "properties": properties,
                "required": required, "additionalProperties": false,
            })
        };
        let points = json!({
            "description": "Scattered points [x, y, z], at least three, not on one line in plan.",
            "type": "array",
            "items": { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
            "minItems": 3,
        });
        let tolerance = json!({
            "description": "How far the surface may pass above or below a point, in metres.",
            "type": "number", "exclusiveMinimum": 0,
        });
        json_schema!({
            "description": "A surface over the whole domain: level, dipping, a grid of heights, or scattered points.",
            "anyOf": [
                table(json!({ "level": { "description": "Its elevation in metres.", "anyOf": [level] } }), &["level"]),
                table(json!({ "dipping": { "description": "A plane.", "anyOf": [dipping] } }), &["dipping"]),
                table(json!({ "grid": { "description": "Heights at the nodes of a regular grid.", "anyOf": [grid] } }), &["grid"]),
                table(json!({ "points": points, "tolerance": tolerance }), &["points", "tolerance"]),
            ],
        })
    }
}

/// One table made of several structs and a fixed `kind`.
fn merged(kind: &str, description: &str, parts: &[Schema]) -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    for part in parts {
        if let Some(Value::Object(more)) = part.get("properties") {
            properties.extend(more.clone());
        }
        if let Some(Value::Array(more)) = part.get("required") {
            required.extend(more.iter().cloned());
        }
    }
    properties.insert(
        "kind".to_owned(),
        json!({ "description": description, "const": kind }),
    );
    json!({
        "title": kind,
        "description": description,
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

/// One table for each kind, with what all have.
fn variants<const N: usize>(common: &Schema, kinds: [(&str, Schema); N]) -> Vec<Value> {
    kinds
        .into_iter()
        .map(|(kind, part)| {
            let about = description(&part);
            merged(kind, &about, &[common.clone(), part])
        })
        .collect()
}

fn description(schema: &Schema) -> String {
    let text = schema.get("description").and_then(Value::as_str);
    text.unwrap_or_default().to_owned()
}

pub(crate) fn features(generator: &mut SchemaGenerator) -> Schema {
    let common = FeatureFile::json_schema(generator);
    let kinds = [
        ("channel", ChannelFile::json_schema(generator)),
        ("ellipsoid", EllipsoidFile::json_schema(generator)),
        ("horizon", HorizonFile::json_schema(generator)),
        ("clinoforms", ClinoformsFile::json_schema(generator)),
    ];
    json_schema!({ "type": "array", "items": { "oneOf": variants(&common, kinds) } })
}

pub(crate) fn trajectory(generator: &mut SchemaGenerator) -> Schema {
    let common = TrajectoryFile::json_schema(generator);
    let kinds = [
        ("line", LineFile::json_schema(generator)),
        ("points", PointsFile::json_schema(generator)),
        ("sine-generated", SineGeneratedFile::json_schema(generator)),
        ("parametric", ParametricFile::json_schema(generator)),
    ];
    json_schema!({ "oneOf": variants(&common, kinds) })
}

pub(crate) fn origin(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": ["array", "null"], "items": { "type": "number" }, "minItems": 2, "maxItems": 3,
    })
}

pub(crate) fn permeability(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "anyOf": [
            { "type": "number", "minimum": 0 },
            { "type": "array", "items": { "type": "number", "minimum": 0 }, "minItems": 3, "maxItems": 3 },
            { "type": "null" },
        ],
    })
}

/// Any further rock property.
pub(crate) fn property() -> Value {
    json!({
        "anyOf": [
            { "type": "number" },
            { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
        ],
    })
}

pub(crate) fn section_origin(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["thalweg", "top-centre"] })
}

pub(crate) fn parametrization(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["centripetal", "chord-length"] })
}

pub(crate) fn relation(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["erosive", "onlapping"] })
}

pub(crate) fn interfingering(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["smooth", "zigzag"] })
}
