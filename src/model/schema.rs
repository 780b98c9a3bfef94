//! The JSON Schema of the model file, for editors: completion, descriptions and most checks while typing.
//!
//! A value that may have several shapes has the keywords of all of them side by side: each speaks of its own type only
//! (`properties` of tables, `items` of lists). `anyOf` and `oneOf` over tables would do, too, but of what fits none of them
//! a validator can only say so of the whole table, and editors underline a whole feature for one wrong key. For the same
//! reason an unknown key is refused at its own place, and what is missing is said of tables without unknown keys: where a
//! key is misspelt, it is the misspelling that is wrong.

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
    point_at_keys(&mut schema);
    schema
}

/// Makes closed tables refuse an unknown key at the key, and ask for what is missing only without such keys.
fn point_at_keys(value: &mut Value) {
    match value {
        Value::Object(object) => {
            object.values_mut().for_each(point_at_keys);
            if object.get("additionalProperties") != Some(&Value::Bool(false)) {
                return;
            }
            let words = "no such key here";
            // The title shows in what validators print of `not`; `errorMessage` is what VS Code says instead.
            let nothing = json!({ "not": { "title": words }, "errorMessage": words });
            object.insert("additionalProperties".to_owned(), nothing);
            let keys = object.get("properties").and_then(Value::as_object);
            let known: Vec<&String> = keys.map(|keys| keys.keys().collect()).unwrap_or_default();
            let known = json!({ "type": "object", "propertyNames": { "enum": known } });
            let demands: Map<String, Value> = ["required", "oneOf", "dependentRequired"]
                .into_iter()
                .filter_map(|demand| Some((demand.to_owned(), object.remove(demand)?)))
                .collect();
            if !demands.is_empty() {
                object.insert("if".to_owned(), known);
                object.insert("then".to_owned(), Value::Object(demands));
            }
        }
        Value::Array(values) => values.iter_mut().for_each(point_at_keys),
        _ => {}
    }
}

/// A table that has exactly one of several forms: each a key that tells it, and the keys that go with that one.
fn forms(
    description: &str,
    properties: &Map<String, Value>,
    forms: &[(&str, &[&str])],
) -> Map<String, Value> {
    let telling = forms.iter().map(|(key, _)| json!({ "required": [key] }));
    let mut table = object(json!({
        "description": description,
        "properties": properties,
        "additionalProperties": false,
        "oneOf": telling.collect::<Vec<_>>(),
    }));
    let mut together = Map::new();
    for (key, others) in forms.iter().filter(|(_, others)| !others.is_empty()) {
        together.insert((*key).to_owned(), json!(others));
        together.extend(
            others
                .iter()
                .map(|other| ((*other).to_owned(), json!([key]))),
        );
    }
    if !together.is_empty() {
        table.insert("dependentRequired".to_owned(), Value::Object(together));
    }
    table
}

/// The keys of a table's value.
fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(keys) => keys,
        _ => Map::new(),
    }
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
        let mut schema = generator.subschema_for::<DistributionSchema>();
        schema.insert(
            "description".to_owned(),
            json!("A number, or a distribution that it is drawn from."),
        );
        schema.insert("type".to_owned(), json!(["number", "object"]));
        schema
    }
}

impl JsonSchema for Profile {
    fn schema_name() -> Cow<'static, str> {
        "Profile".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let quantity = generator.subschema_for::<Quantity>();
        let mut keys = distributions();
        let expression = json!({
            "description": "A formula in s, the fraction of the trajectory, as \"30 + 10 * sin(2 * pi * s)\".",
            "type": "string",
        });
        keys.insert("expression".to_owned(), expression);
        let mut table = forms(
            "A quantity, or one that varies along the trajectory: a list of [fraction, quantity], or { expression = \"a formula in s\" }.",
            &keys,
            &[&DISTRIBUTIONS[..], &[("expression", &[])]].concat(),
        );
        table.extend(truncation());
        // Of a list: linear between its pairs, in rising order of the fractions.
        table.extend(object(json!({
            "type": ["number", "object", "array"],
            "minItems": 1,
            "items": {
                "description": "[fraction of the trajectory from 0 to 1, quantity]",
                "type": "array",
                "prefixItems": [{ "type": "number", "minimum": 0, "maximum": 1 }, quantity],
                "minItems": 2,
                "maxItems": 2,
            },
        })));
        table.into()
    }
}

/// Stands for the table of a distribution, which says nothing of what is no table.
struct DistributionSchema;

impl JsonSchema for DistributionSchema {
    fn schema_name() -> Cow<'static, str> {
        "Distribution".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let mut table = forms(
            "A distribution that a number is drawn from.",
            &distributions(),
            &DISTRIBUTIONS,
        );
        table.extend(truncation());
        table.into()
    }
}

/// The distributions' names.
const DISTRIBUTIONS: [(&str, &[&str]); 5] = [
    ("uniform", &[]),
    ("triangular", &[]),
    ("normal", &[]),
    ("lognormal", &[]),
    ("discrete", &[]),
];

/// The keys of all distributions.
fn distributions() -> Map<String, Value> {
    let numbers = |n: usize, description: &str| {
        json!({
            "description": description, "type": "array",
            "items": { "type": "number" }, "minItems": n, "maxItems": n,
        })
    };
    object(json!({
        "uniform": numbers(2, "[minimum, maximum]"),
        "triangular": numbers(3, "[minimum, most likely, maximum]"),
        "normal": numbers(2, "[mean, standard deviation]"),
        "lognormal": numbers(2, "[mean, standard deviation] of the quantity itself, not of its logarithm"),
        "discrete": {
            "description": "[value, …], all equally likely, or [[value, weight], …]",
            "type": "array",
            "minItems": 1,
            "items": { "type": ["number", "array"], "items": { "type": "number" }, "minItems": 2, "maxItems": 2 },
        },
        "min": { "description": "Draws below are repeated.", "type": "number" },
        "max": { "description": "Draws above are repeated.", "type": "number" },
    }))
}

/// Only what has no ends of its own is truncated.
fn truncation() -> Map<String, Value> {
    let endless = json!({ "anyOf": [{ "required": ["normal"] }, { "required": ["lognormal"] }] });
    object(json!({ "dependentSchemas": { "min": endless, "max": endless } }))
}

impl JsonSchema for Selector {
    fn schema_name() -> Cow<'static, str> {
        "Selector".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let words = ["older", "younger", "everything", "nothing"];
        json_schema!({
            "type": ["string", "array"],
            "anyOf": [{ "enum": words }, { "type": "array" }],
            "items": {
                "description": "The id of a feature, or \"background\"; or one of { id = … }, { kind = … }, { level = … }, { facies = … }.",
                "type": ["string", "object"],
                "properties": {
                    "id": { "description": "The feature of this id.", "type": "string" },
                    "kind": { "description": "All features of this kind.", "type": "string" },
                    "level": { "description": "All features of this level.", "type": "integer", "minimum": 1 },
                    "facies": { "description": "All features of this facies.", "type": "string" },
                },
                "additionalProperties": false,
                "minProperties": 1,
                "maxProperties": 1,
            },
        })
    }
}

impl JsonSchema for HorizonSurface {
    fn schema_name() -> Cow<'static, str> {
        "Surface".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        surface(generator, Map::new())
    }
}

/// A horizon's surface: as that of the domain's base and top, or by its thickness above another horizon.
pub(crate) fn horizon_surface(generator: &mut SchemaGenerator) -> Schema {
    let number = generator.subschema_for::<Quantity>();
    let mut thickness = forms(
        "How far above it: a number, a grid of thicknesses, or scattered points [x, y, thickness]; in metres, not below 0.",
        &heights(
            generator,
            [
                "Thicknesses at the nodes of a regular grid.",
                "Scattered points [x, y, thickness]",
            ],
        ),
        &[("grid", &[]), ("points", &["tolerance"])],
    );
    thickness.insert("type".to_owned(), json!("object"));
    let description = thickness.remove("description");
    let thickness = json!({ "description": description, "anyOf": [number, thickness] });
    let above = json!({ "description": "The id of an older horizon above which it lies.", "type": "string" });
    surface(
        generator,
        object(json!({ "above": above, "thickness": thickness })),
    )
}

/// The keys of measured heights, or of what is like them.
fn heights(generator: &mut SchemaGenerator, [grid, points]: [&str; 2]) -> Map<String, Value> {
    let grid = about(grid, generator.subschema_for::<GridFile>());
    let points = json!({
        "description": format!("{points}, at least three, not on one line in plan."),
        "type": "array",
        "items": { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
        "minItems": 3,
    });
    let tolerance = json!({
        "description": "How far the surface may pass above or below a point, in metres.",
        "type": "number", "exclusiveMinimum": 0,
    });
    object(json!({ "grid": grid, "points": points, "tolerance": tolerance }))
}

fn about(description: &str, mut schema: Schema) -> Schema {
    schema.insert("description".to_owned(), json!(description));
    schema
}

/// A surface over the whole domain, with what may be given besides.
fn surface(generator: &mut SchemaGenerator, isochore: Map<String, Value>) -> Schema {
    let level = about(
        "Its elevation in metres.",
        generator.subschema_for::<Quantity>(),
    );
    let dipping = about("A plane.", generator.subschema_for::<DippingFile>());
    let mut keys = object(json!({ "level": level, "dipping": dipping }));
    keys.extend(heights(
        generator,
        [
            "Heights at the nodes of a regular grid.",
            "Scattered points [x, y, z]",
        ],
    ));
    let mut telling: Vec<(&str, &[&str])> = vec![
        ("level", &[]),
        ("dipping", &[]),
        ("grid", &[]),
        ("points", &["tolerance"]),
    ];
    if !isochore.is_empty() {
        telling.push(("above", &["thickness"]));
    }
    keys.extend(isochore);
    let mut table = forms(
        "A surface over the whole domain: level, dipping, a grid of heights, or scattered points.",
        &keys,
        &telling,
    );
    table.insert("type".to_owned(), json!("object"));
    table.into()
}

/// A table whose `kind` says which keys it has besides those that all have.
///
/// The keys' schemas stand in the table itself, where editors look for what to complete; what is to be there, and what not,
/// depends on the kind. A key that two kinds mean differently has its schema with the kind.
fn by_kind(common: &Schema, kinds: &[(&str, Schema)]) -> Schema {
    let mut properties = keys(common);
    for (_, part) in kinds {
        for key in keys(part).keys() {
            properties.insert(key.clone(), shared(key, kinds).0);
        }
    }
    let about = kinds
        .iter()
        .map(|(kind, part)| format!("{kind}: {}", description(part)));
    let kind = json!({
        "description": about.collect::<Vec<_>>().join("\n"),
        "enum": kinds.iter().map(|(kind, _)| *kind).collect::<Vec<_>>(),
    });
    properties.insert("kind".to_owned(), kind);
    let mut table = Map::new();
    for (kind, part) in kinds.iter().rev() {
        let allowed = keys(common).into_iter().chain(keys(part));
        let allowed = allowed.map(|(key, schema)| {
            let has_it_here = keys(part).contains_key(&key) && !shared(&key, kinds).1;
            (
                key,
                if has_it_here {
                    schema
                } else {
                    Value::Bool(true)
                },
            )
        });
        let required: Vec<Value> = [common, part]
            .iter()
            .filter_map(|part| part.get("required")?.as_array().cloned())
            .flatten()
            .collect();
        let rest = std::mem::take(&mut table);
        table = object(json!({
            "if": { "properties": { "kind": { "const": kind } }, "required": ["kind"] },
            "then": {
                "title": kind,
                "properties": allowed.collect::<Map<_, _>>(),
                "required": required,
                "additionalProperties": false,
            },
            "else": rest,
        }));
    }
    table.extend(object(json!({
        "type": "object",
        "properties": properties,
        "required": ["kind"],
    })));
    table.into()
}

/// A key's schema if all kinds that have it mean the same, or no more than what each says of it; and whether they do.
fn shared(key: &str, kinds: &[(&str, Schema)]) -> (Value, bool) {
    let having: Vec<(&str, Map<String, Value>, String)> = kinds
        .iter()
        .filter_map(|(kind, part)| {
            let mut schema = object(keys(part).remove(key)?);
            let words = schema.remove("description").unwrap_or_default();
            Some((*kind, schema, words.as_str().unwrap_or_default().to_owned()))
        })
        .collect();
    let same = having.windows(2).all(|pair| pair[0].1 == pair[1].1);
    let words: Vec<String> = match having.as_slice() {
        [(_, _, words)] => vec![words.clone()],
        several => several
            .iter()
            .map(|(kind, _, words)| format!("{kind}: {words}"))
            .collect(),
    };
    let mut shown = match having.into_iter().next() {
        Some((_, schema, _)) if same => schema,
        _ => Map::new(),
    };
    shown.insert("description".to_owned(), json!(words.join("\n")));
    (Value::Object(shown), same)
}

/// The keys of a struct's table.
fn keys(schema: &Schema) -> Map<String, Value> {
    schema
        .get("properties")
        .cloned()
        .map_or_else(Map::new, object)
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
    json_schema!({ "type": "array", "items": by_kind(&common, &kinds) })
}

pub(crate) fn trajectory(generator: &mut SchemaGenerator) -> Schema {
    let common = TrajectoryFile::json_schema(generator);
    let kinds = [
        ("line", LineFile::json_schema(generator)),
        ("points", PointsFile::json_schema(generator)),
        ("sine-generated", SineGeneratedFile::json_schema(generator)),
        ("parametric", ParametricFile::json_schema(generator)),
    ];
    by_kind(&common, &kinds)
}

pub(crate) fn origin(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": ["array", "null"], "items": { "type": "number" }, "minItems": 2, "maxItems": 3,
    })
}

pub(crate) fn permeability(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": ["number", "array"], "minimum": 0,
        "items": { "type": "number", "minimum": 0 }, "minItems": 3, "maxItems": 3,
    })
}

/// Any further rock property.
pub(crate) fn property() -> Value {
    json!({ "type": ["number", "array"], "items": { "type": "number" }, "minItems": 3, "maxItems": 3 })
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
