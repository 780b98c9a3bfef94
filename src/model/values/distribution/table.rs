//! The table of a distribution: one of five names, and where to truncate it.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::{Map, Value as Json, json};

use super::{Distribution, DistributionError};
use crate::model::read::{Any, Field, Reader};
use crate::model::tables::{forms, object};
use crate::model::tree::{NodeId, Value};

/// A distribution: one of the five names, and `min` and `max` to truncate a normal or lognormal one.
#[derive(Deserialize)]
pub(crate) struct DistributionFile {
    pub(crate) uniform: Option<Field<[f64; 2]>>,
    pub(crate) triangular: Option<Field<[f64; 3]>>,
    pub(crate) normal: Option<Field<[f64; 2]>>,
    pub(crate) lognormal: Option<Field<[f64; 2]>>,
    pub(crate) discrete: Option<Field<Any>>,
    pub(crate) min: Option<Field<f64>>,
    pub(crate) max: Option<Field<f64>>,
}

pub(crate) fn distribution(reader: &Reader<'_>, node: NodeId, what: &str) -> Option<Distribution> {
    let before = reader.found();
    let file: DistributionFile = reader.table(node)?;
    reader.close(node, &format!("the distribution of {what}"));
    let names: Vec<&str> = [
        ("uniform", file.uniform.is_some()),
        ("triangular", file.triangular.is_some()),
        ("normal", file.normal.is_some()),
        ("lognormal", file.lognormal.is_some()),
        ("discrete", file.discrete.is_some()),
    ]
    .iter()
    .filter(|(_, given)| *given)
    .map(|(name, _)| *name)
    .collect();
    if reader.found() > before {
        return None;
    }
    if names.len() != 1 {
        let message = if names.is_empty() {
            format!("the distribution of {what} has no name")
        } else {
            format!(
                "the distribution of {what} has {} names: {}",
                names.len(),
                names.join(", ")
            )
        };
        reader.wrong(
            node,
            message,
            "give one of uniform = [min, max], triangular = [min, mode, max], normal = [mean, sd], lognormal = [mean, sd], discrete = [value, …]",
        );
        return None;
    }
    let min = file.min.and_then(Field::good);
    let max = file.max.and_then(Field::good);
    let (name_node, made) = if let Some((at, [a, b])) = file.uniform.and_then(Field::good) {
        (at, Distribution::uniform(a, b))
    } else if let Some((at, [a, b, c])) = file.triangular.and_then(Field::good) {
        (at, Distribution::triangular(a, b, c))
    } else if let Some((at, [mean, sd])) = file.normal.and_then(Field::good) {
        (at, Distribution::normal(mean, sd))
    } else if let Some((at, [mean, sd])) = file.lognormal.and_then(Field::good) {
        (at, Distribution::lognormal(mean, sd))
    } else {
        let (at, Any) = file.discrete.and_then(Field::good)?;
        (at, Distribution::discrete(weighted(reader, at, what)?))
    };
    let limit_node = min.or(max).map_or(name_node, |(at, _)| at);
    let refused = |at: NodeId| {
        move |error: DistributionError| {
            let text = error.to_string();
            let (message, remedy) = text.split_once("; ").unwrap_or((&text, "change it"));
            reader.wrong(at, format!("{what}: {message}"), remedy);
        }
    };
    made.map_err(refused(name_node))
        .ok()?
        .truncated(min.map(|(_, value)| value), max.map(|(_, value)| value))
        .map_err(refused(limit_node))
        .ok()
}

/// `[value, …]` or `[[value, weight], …]`.
fn weighted(reader: &Reader<'_>, list: NodeId, what: &str) -> Option<Vec<(f64, f64)>> {
    let Value::List(elements) = reader.tree.value(list) else {
        reader.wrong(
            list,
            format!(
                "expected a list of values for {what}, found {}",
                reader.tree.describe(list)
            ),
            "write discrete = [value, …] or discrete = [[value, weight], …]",
        );
        return None;
    };
    let pairs: Vec<Option<(f64, f64)>> = elements
        .iter()
        .map(|&element| match reader.tree.value(element) {
            Value::List(_) => reader
                .read::<[f64; 2]>(element)
                .map(|[value, weight]| (value, weight)),
            _ => reader.number(element).map(|value| (value, 1.0)),
        })
        .collect();
    pairs.into_iter().collect()
}

/// Stands for the table of a distribution, which says nothing of what is no table.
pub(crate) struct DistributionSchema;

impl JsonSchema for DistributionSchema {
    fn schema_name() -> Cow<'static, str> {
        "Distribution".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let mut table = forms(
            "A distribution that a number is drawn from.",
            &keys(),
            &NAMES,
        );
        table.extend(truncation());
        table.into()
    }
}

/// The distributions' names.
pub(crate) const NAMES: [(&str, &[&str]); 5] = [
    ("uniform", &[]),
    ("triangular", &[]),
    ("normal", &[]),
    ("lognormal", &[]),
    ("discrete", &[]),
];

/// The keys of all distributions.
pub(crate) fn keys() -> Map<String, Json> {
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
pub(crate) fn truncation() -> Map<String, Json> {
    let endless = json!({ "anyOf": [{ "required": ["normal"] }, { "required": ["lognormal"] }] });
    object(json!({ "dependentSchemas": { "min": endless, "max": endless } }))
}
