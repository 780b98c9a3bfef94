//! Profiles: quantities that may vary along a trajectory.
//!
//! `s` is the fraction of the way along the trajectory, 0 at its start and 1 at its end.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::json;

use super::distribution::{NAMES, keys, truncation};
use super::limits::Limits;
use super::quantity::{Quantity, quantity, wrong_shape};
use crate::model::expression::{Expression, ExpressionError};
use crate::model::formula::FUNCTIONS;
use crate::model::read::{Field, Reader};
use crate::model::suggest;
use crate::model::tables::{forms, object};
use crate::model::tree::{NodeId, Value};

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

/// A formula where a profile is wanted.
#[derive(Deserialize)]
pub(crate) struct ExpressionFile {
    pub(crate) expression: Field<String>,
}

/// A quantity, or one that varies along the trajectory.
pub(crate) fn profile(
    reader: &Reader<'_>,
    node: NodeId,
    what: &str,
    limits: Limits,
) -> Option<Profile> {
    match reader.tree.value(node) {
        Value::List(elements) => along(reader, node, elements, what, limits),
        Value::Table(_) if reader.tree.entry(node, "expression").is_some() => {
            let file: ExpressionFile = reader.table(node)?;
            reader.close(node, what);
            let (text_node, text) = file.expression.good()?;
            let parsed = expression(reader, text_node, &text, "s")?;
            values_within(reader, text_node, &parsed, what, limits).then_some(())?;
            Some(Profile::Expression(parsed))
        }
        Value::Text(_) | Value::Null | Value::Bool(_) | Value::Date(_) => {
            wrong_shape(reader, node, what, true);
            None
        }
        _ => quantity(reader, node, what, limits).map(Profile::Quantity),
    }
}

/// `[[fraction, quantity], …]`.
fn along(
    reader: &Reader<'_>,
    node: NodeId,
    elements: &[NodeId],
    what: &str,
    limits: Limits,
) -> Option<Profile> {
    if elements.is_empty() {
        reader.wrong(
            node,
            format!("the list for {what} is empty"),
            "write pairs [fraction, value], as [[0, 20], [1, 30]]",
        );
        return None;
    }
    if elements
        .iter()
        .all(|&element| reader.tree.number(element).is_some())
    {
        wrong_shape(reader, node, what, true);
        return None;
    }
    let before = reader.found();
    let mut points: Vec<(f64, Quantity)> = Vec::new();
    for &element in elements {
        let [at, value] = *reader.tree.elements(element) else {
            reader.wrong(
                element,
                format!(
                    "expected a pair [fraction, value] for {what}, found {}",
                    reader.tree.describe(element)
                ),
                "write the fraction of the trajectory (0 to 1) and the value there",
            );
            continue;
        };
        let quantity = quantity(reader, value, what, limits);
        let Some(fraction) = reader.number(at) else {
            continue;
        };
        if !(0.0..=1.0).contains(&fraction) {
            reader.wrong(
                at,
                format!("the fraction {fraction} is not between 0 and 1"),
                "give the place as a fraction of the trajectory: 0 is its start, 1 its end",
            );
        } else if let Some(&(previous, _)) = points.last()
            && fraction <= previous
        {
            reader.wrong(
                at,
                format!("the fraction {fraction} does not follow {previous}"),
                "put the pairs in rising order of their fractions, each fraction once",
            );
        } else {
            points.push((fraction, quantity.unwrap_or(Quantity::Constant(f64::NAN))));
        }
    }
    (reader.found() == before).then_some(Profile::Along(points))
}

/// A formula of one variable.
pub(crate) fn expression(
    reader: &Reader<'_>,
    node: NodeId,
    text: &str,
    variable: &'static str,
) -> Option<Expression> {
    Expression::new(text, variable)
        .map_err(|error| {
            let remedy = match &error {
                ExpressionError::Unknown { name, variable } => {
                    let mut known = vec![*variable, "pi"];
                    known.extend(FUNCTIONS);
                    match suggest::nearest(name, &known) {
                        Some(known) => format!("did you mean `{known}`?"),
                        None => format!("use `{variable}`, `pi`, and functions as {}", suggest::list(&["sin", "cos", "exp", "sqrt", "min", "max", "abs"])),
                    }
                }
                _ => format!(
                    "write a formula in `{variable}` with + - * / ^ ( ), `pi` and functions as sin, cos, exp, sqrt, min, max"
                ),
            };
            reader.wrong(node, error.to_string(), remedy);
        })
        .ok()
}

/// Tries a formula in `s` all along the trajectory.
fn values_within(
    reader: &Reader<'_>,
    node: NodeId,
    parsed: &Expression,
    what: &str,
    limits: Limits,
) -> bool {
    const STEPS: usize = 256;
    for step in 0..=STEPS {
        let s = step as f64 / STEPS as f64;
        match parsed.eval(s) {
            Ok(value) if limits.admit(value) => {}
            Ok(value) => {
                let words = limits.words;
                reader.wrong(
                    node,
                    format!("{what} is {value} at s = {s}; it {words}"),
                    "change the formula, or limit it with min( , ) and max( , )",
                );
                return false;
            }
            Err(error) => {
                reader.wrong(
                    node,
                    error.to_string(),
                    "the formula must have a finite value for every s from 0 to 1",
                );
                return false;
            }
        }
    }
    true
}

impl JsonSchema for Profile {
    fn schema_name() -> Cow<'static, str> {
        "Profile".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let quantity = generator.subschema_for::<Quantity>();
        let mut keys = keys();
        let expression = json!({
            "description": "A formula in s, the fraction of the trajectory, as \"30 + 10 * sin(2 * pi * s)\".",
            "type": "string",
        });
        keys.insert("expression".to_owned(), expression);
        let mut table = forms(
            "A quantity, or one that varies along the trajectory: a list of [fraction, quantity], or { expression = \"a formula in s\" }.",
            &keys,
            &[&NAMES[..], &[("expression", &[])]].concat(),
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
            "examples": [
                50,
                { "uniform": [40, 60] },
                [[0, 40], [0.5, 60], [1, 40]],
                { "expression": "50 + 10 * sin(2 * pi * s)" },
            ],
        })));
        table.into()
    }
}
