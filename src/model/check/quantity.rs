//! Quantities and profiles: their shapes, their distributions, and whether what they can give is possible.

use crate::model::deserialize::{LENGTHS, number_remedy};
use crate::model::distribution::{Distribution, DistributionError};
use crate::model::expression::{Expression, ExpressionError};
use crate::model::file::{DistributionFile, ExpressionFile};
use crate::model::formula::FUNCTIONS;
use crate::model::profile::Profile;
use crate::model::quantity::Quantity;
use crate::model::read::{Any, Field, Reader};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};

/// What a number may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    low: f64,
    high: f64,
    /// Whether the limits themselves are excluded.
    open: bool,
    words: &'static str,
}

pub(crate) const ANY: Limits = Limits {
    low: f64::NEG_INFINITY,
    high: f64::INFINITY,
    open: false,
    words: "can be any number",
};
pub(crate) const POSITIVE: Limits = Limits {
    low: 0.0,
    high: f64::INFINITY,
    open: true,
    words: "must be above 0",
};
pub(crate) const CONCAVE: Limits = Limits {
    low: 1.0,
    high: f64::INFINITY,
    open: false,
    words: "must be 1 (straight) or more (concave upwards)",
};
pub(crate) const ASYMMETRY: Limits = Limits {
    low: -0.5,
    high: 0.5,
    open: true,
    words: "must lie between -0.5 and 0.5 (a fraction of the width, 0 in the middle)",
};
pub(crate) const BANK_ANGLE: Limits = Limits {
    low: 0.0,
    high: 180.0,
    open: true,
    words: "must lie between 0 and 180 degrees",
};
pub(crate) const AZIMUTH: Limits = Limits {
    low: -360.0,
    high: 360.0,
    open: false,
    words: "must lie between -360 and 360 degrees, clockwise from north",
};
pub(crate) const PLUNGE: Limits = Limits {
    low: -90.0,
    high: 90.0,
    open: false,
    words: "must lie between -90 and 90 degrees, downwards from the horizontal",
};

pub(crate) const NOT_NEGATIVE: Limits = Limits {
    low: 0.0,
    high: f64::INFINITY,
    open: false,
    words: "must not be below 0",
};
pub(crate) const DIP: Limits = Limits {
    low: 0.0,
    high: 89.0,
    open: false,
    words: "must lie between 0 and 89 degrees, downwards along the azimuth",
};
pub(crate) const FRACTION: Limits = Limits {
    low: 0.0,
    high: 1.0,
    open: false,
    words: "must lie between 0 and 1",
};

impl Limits {
    fn too_low(&self, value: f64, reached: bool) -> bool {
        value < self.low || (self.open && reached && value == self.low)
    }

    fn too_high(&self, value: f64) -> bool {
        value > self.high || (self.open && value == self.high && value.is_finite())
    }

    fn admit(&self, value: f64) -> bool {
        !self.too_low(value, true) && !self.too_high(value)
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

/// Whether a text was meant as a formula: it can be read as one, and depends on `s`.
fn formula_in_s(text: &str) -> bool {
    Expression::new(text, "s").is_ok_and(|formula| formula.eval(0.25) != formula.eval(0.75))
}

fn wrong_shape(reader: &Reader<'_>, node: NodeId, what: &str, varies: bool) {
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

fn within(
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

fn distribution(reader: &Reader<'_>, node: NodeId, what: &str) -> Option<Distribution> {
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
