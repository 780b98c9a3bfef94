//! Quantities: numbers that are given, or drawn from a distribution.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::json;

use super::distribution::{Distribution, DistributionSchema, DrawError, distribution};
use super::limits::Limits;
use crate::model::deserialize::{LENGTHS, number_remedy};
use crate::model::expression::Expression;
use crate::model::read::Reader;
use crate::model::stream::Stream;
use crate::model::tree::{NodeId, Value, quoted};

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

/// A number, or the table of a distribution.
pub(crate) fn quantity(
    reader: &Reader<'_>,
    node: NodeId,
    what: &str,
    limits: Limits,
) -> Option<Quantity> {
    let quantity = match reader.tree.value(node) {
        Value::Integer(_) | Value::Float(_) => Quantity::Constant(reader.number(node)?),
        Value::Table(_) => Quantity::Random(distribution(reader, node, what)?),
        _ => {
            wrong_shape(reader, node, what, false);
            return None;
        }
    };
    within(reader, node, what, limits, &quantity).then_some(quantity)
}

/// Whether a text was meant as a formula: it can be read as one, and depends on `s`.
fn formula_in_s(text: &str) -> bool {
    Expression::new(text, "s").is_ok_and(|formula| formula.eval(0.25) != formula.eval(0.75))
}

pub(crate) fn wrong_shape(reader: &Reader<'_>, node: NodeId, what: &str, varies: bool) {
    let found = reader.tree.describe(node);
    let remedy = match reader.tree.value(node) {
        Value::Text(text) if varies && formula_in_s(text) => {
            format!(
                "write {{ expression = {} }} for a formula in s",
                quoted(text)
            )
        }
        Value::Text(text) => number_remedy(text, LENGTHS),
        Value::List(elements) => match elements.len() {
            2 => "write { uniform = [minimum, maximum] } for a range".to_owned(),
            3 => "write { triangular = [minimum, most likely, maximum] }".to_owned(),
            _ => "write one number, or a distribution".to_owned(),
        },
        Value::Null => "leave the key out instead".to_owned(),
        _ => "write a number, or a distribution as { uniform = [10, 90] }".to_owned(),
    };
    reader.wrong(
        node,
        format!("expected a number or a distribution for {what}, found {found}"),
        remedy,
    );
}

pub(crate) fn within(
    reader: &Reader<'_>,
    node: NodeId,
    what: &str,
    limits: Limits,
    quantity: &Quantity,
) -> bool {
    let words = limits.words;
    let distribution = match quantity {
        Quantity::Constant(value) => {
            let admitted = limits.admit(*value);
            if !admitted {
                reader.wrong(
                    node,
                    format!("{what} is {value}; it {words}"),
                    "change the number",
                );
            }
            return admitted;
        }
        Quantity::Random(distribution) => distribution,
    };
    let (low, high) = distribution.support();
    let (side, value, key) = if limits.too_low(low, distribution.reaches_minimum()) {
        ("small", low, "min")
    } else if limits.too_high(high) {
        ("large", high, "max")
    } else {
        return true;
    };
    let (message, remedy) = if value.is_infinite() {
        (
            format!("the distribution of {what} has no limit on one side; {what} {words}"),
            format!("truncate it with {key} = …"),
        )
    } else {
        (
            format!("{what} can be as {side} as {value}; it {words}"),
            "change the limits of the distribution".to_owned(),
        )
    };
    reader.wrong(node, message, remedy);
    false
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
        let examples = json!([
            50,
            { "uniform": [40, 60] },
            { "triangular": [40, 50, 60] },
            { "normal": [50, 5], "min": 40, "max": 60 },
        ]);
        schema.insert("examples".to_owned(), examples);
        schema
    }
}
