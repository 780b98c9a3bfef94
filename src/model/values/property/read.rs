//! Reading rock properties.

use serde::Deserialize;

use super::{Graded, PropertySpec};
use crate::model::checker::Checker;
use crate::model::defects::Defect;
use crate::model::deserialize::number_remedy;
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{Entry, NodeId, Value, quoted};
use crate::model::values::distribution::distribution;
use crate::model::values::facies::is_id;
use crate::model::values::limits::{ANY, FRACTION, Limits};
use crate::model::values::quantity::{Quantity, quantity, within};

/// The rock properties that have a meaning to the program; their shapes are looked at one by one.
#[derive(Deserialize)]
pub(crate) struct PropertiesFile {
    net: Option<Field<Any>>,
    porosity: Option<Field<Any>>,
    permeability: Option<Field<Any>>,
    vsh: Option<Field<Any>>,
    sw: Option<Field<Any>>,
}

const MILLIDARCY: Limits = Limits {
    low: 0.0,
    high: f64::INFINITY,
    open: false,
    words: "cannot be negative (write millidarcy, not the logarithm)",
};
/// What a table along axes may look like, in words.
const ALONG: &str = "[x, y, z], { dip, strike, normal } or { horizontal, vertical_fraction }";

/// What a property may be.
struct Form<'a> {
    /// What it is called in messages.
    what: String,
    key: &'a str,
    limits: Limits,
    /// Whether it may differ along axes.
    has_axes: bool,
}

#[derive(Deserialize)]
struct LayersFile {
    dip: Field<Any>,
    strike: Field<Any>,
    normal: Field<Any>,
}

#[derive(Deserialize)]
struct LevelFile {
    horizontal: Field<Any>,
    vertical_fraction: Field<Any>,
}

#[derive(Deserialize)]
struct RisingFile {
    base: Field<Any>,
    top: Field<Any>,
    scale: Option<Field<String>>,
}

impl Checker<'_> {
    /// Every rock property of a table, in file order; `what` names the table, as `facies "sand"`. Whatever keys it has besides
    /// must be asked for before.
    pub(crate) fn properties(
        &self,
        table: NodeId,
        what: &str,
    ) -> Option<Vec<(String, PropertySpec)>> {
        let before = self.reader.found();
        let others = self.reader.known(table);
        let file: PropertiesFile = self.reader.table(table)?;
        let ours = [
            ("net", &file.net),
            ("porosity", &file.porosity),
            ("permeability", &file.permeability),
            ("vsh", &file.vsh),
            ("sw", &file.sw),
        ];
        let known = self.reader.known(table);
        let mut properties = Vec::new();
        for entry in self.reader.tree.entries(table) {
            let key = entry.key.as_str();
            if others.contains(&key) {
                continue;
            }
            let form = Form {
                what: format!("the {key} of {what}"),
                key,
                limits: match key {
                    "permeability" => MILLIDARCY,
                    _ if known.contains(&key) => FRACTION,
                    _ => ANY,
                },
                has_axes: key == "permeability" || !known.contains(&key),
            };
            let found = match ours.iter().find(|(ours, _)| *ours == key) {
                // What is null is a defect already.
                Some((_, Some(Field::Good(node, Any)))) => self.property(*node, &form),
                Some(_) => None,
                None => self.own_property(entry, &known, what, &form),
            };
            properties.extend(found.map(|found| (key.to_owned(), found)));
        }
        (self.reader.found() == before).then_some(properties)
    }

    /// A property that has no meaning to the program.
    fn own_property(
        &self,
        entry: &Entry,
        known: &[&str],
        what: &str,
        form: &Form<'_>,
    ) -> Option<PropertySpec> {
        if slip(&entry.key, known) || !is_id(&entry.key) {
            self.reader.unknown_key(entry, known, what);
            return None;
        }
        let value = self.reader.tree.value(entry.node);
        if matches!(
            value,
            Value::Integer(_) | Value::Float(_) | Value::List(_) | Value::Table(_)
        ) {
            return self.property(entry.node, form);
        }
        let found = self.reader.tree.describe(entry.node);
        let path = self.reader.hint(|| self.reader.path(entry.node));
        let defect = Defect::new(
            entry.key_span,
            format!(
                "unknown key {} in {what}, with {found}",
                suggest::code(&entry.key)
            ),
            format!(
                "a rock property of your own is a number or [x, y, z], given or drawn; the other keys here are {}",
                suggest::list(known)
            ),
        );
        self.reader.report(defect.with_path(path));
        None
    }

    fn property(&self, node: NodeId, form: &Form<'_>) -> Option<PropertySpec> {
        let tree = self.reader.tree;
        let has = |keys: &[&str]| keys.iter().any(|key| tree.entry(node, key).is_some());
        match tree.value(node) {
            Value::Bool(net) if form.key == "net" => {
                Some(PropertySpec::from(if *net { 1.0 } else { 0.0 }))
            }
            Value::List(elements) if form.has_axes => {
                let Ok(axes) = <[NodeId; 3]>::try_from(elements.as_slice()) else {
                    let found = elements.len();
                    self.reader.wrong(
                        node,
                        format!("expected one number or [x, y, z], found a list of {found}"),
                        "write one number, or three in [ ]",
                    );
                    return None;
                };
                let axes = axes.map(|axis| self.graded(axis, form, &form.what));
                let [x, y, z] = axes;
                Some(PropertySpec::Axes([x?, y?, z?]))
            }
            // A normal alone is a distribution.
            Value::Table(_) if form.has_axes && has(&["dip", "strike"]) => self.layers(node, form),
            Value::Table(_) if form.has_axes && has(&["horizontal", "vertical_fraction"]) => {
                self.level_property(node, form)
            }
            _ => self
                .graded(node, form, &form.what)
                .map(PropertySpec::Scalar),
        }
    }

    fn layers(&self, table: NodeId, form: &Form<'_>) -> Option<PropertySpec> {
        let file: LayersFile = self.reader.table(table)?;
        self.reader.close(table, &form.what);
        let fields = [
            ("dip", file.dip, "dip = 500"),
            ("strike", file.strike, "strike = 500"),
            ("normal", file.normal, "normal = 50"),
        ];
        let [dip, strike, normal] =
            fields.map(|(key, field, example)| self.part(table, form, key, field, example));
        Some(PropertySpec::Layers([dip?, strike?, normal?]))
    }

    fn level_property(&self, table: NodeId, form: &Form<'_>) -> Option<PropertySpec> {
        let file: LevelFile = self.reader.table(table)?;
        self.reader.close(table, &form.what);
        let horizontal = self.part(
            table,
            form,
            "horizontal",
            file.horizontal,
            "horizontal = 500",
        );
        let (key, example) = ("vertical_fraction", "vertical_fraction = 0.1");
        let field = self
            .reader
            .need(file.vertical_fraction, table, &form.what, key, example);
        let fraction = field.and_then(|(node, Any)| {
            let what = format!("the {key} of {}", form.what);
            let limits = Limits {
                words: "cannot be negative",
                ..MILLIDARCY
            };
            quantity(&self.reader, node, &what, limits)
        });
        Some(PropertySpec::Level {
            horizontal: horizontal?,
            vertical_fraction: fraction?,
        })
    }

    fn part(
        &self,
        table: NodeId,
        form: &Form<'_>,
        key: &str,
        field: Field<Any>,
        example: &str,
    ) -> Option<Graded> {
        let (node, Any) = self.reader.need(field, table, &form.what, key, example)?;
        self.graded(node, form, &format!("the {key} of {}", form.what))
    }

    /// One number: given, drawn, or from base to top.
    fn graded(&self, node: NodeId, form: &Form<'_>, what: &str) -> Option<Graded> {
        let tree = self.reader.tree;
        let is_rising = ["base", "top", "scale"]
            .iter()
            .any(|key| tree.entry(node, key).is_some());
        if is_rising {
            return self.rising(node, form, what);
        }
        self.number_or_drawn(node, form, what, form.limits)
            .map(Graded::Even)
    }

    fn rising(&self, table: NodeId, form: &Form<'_>, what: &str) -> Option<Graded> {
        let file: RisingFile = self.reader.table(table)?;
        self.reader.close(table, what);
        let scale = match file.scale {
            None => Some(form.key == "permeability"),
            Some(field) => field.good().and_then(|(node, word)| match word.as_str() {
                "log" => Some(true),
                "linear" => Some(false),
                _ => {
                    let message = format!("there is no scale {}", quoted(&word));
                    self.reader
                        .wrong(node, message, "write \"linear\" or \"log\"");
                    None
                }
            }),
        };
        let limits = match scale {
            Some(true) => Limits {
                low: 0.0,
                open: true,
                words: "must be above 0 on a logarithmic scale (or write scale = \"linear\")",
                ..form.limits
            },
            _ => form.limits,
        };
        let ends = [("base", file.base), ("top", file.top)];
        let [base, top] = ends.map(|(key, field)| {
            let example = format!("{key} = 0.2");
            let (node, Any) = self.reader.need(field, table, what, key, &example)?;
            self.number_or_drawn(node, form, &format!("the {key} of {what}"), limits)
        });
        Some(Graded::Rising {
            base: base?,
            top: top?,
            is_log: scale?,
        })
    }

    fn number_or_drawn(
        &self,
        node: NodeId,
        form: &Form<'_>,
        what: &str,
        limits: Limits,
    ) -> Option<Quantity> {
        let reader = &self.reader;
        let found = match reader.tree.value(node) {
            Value::Table(_) => Quantity::Random(distribution(reader, node, what)?),
            // Any unit is possible (a modulus in pascals, say), so the limit for lengths does not apply.
            Value::Integer(_) | Value::Float(_) => match reader.tree.number(node) {
                Some(value) if value.is_finite() => Quantity::Constant(value),
                _ => {
                    let found = reader.tree.describe(node);
                    let message = format!("expected a finite number for {what}, found {found}");
                    reader.wrong(node, message, "rock properties are finite numbers");
                    return None;
                }
            },
            _ => {
                self.no_property(node, form, what);
                return None;
            }
        };
        if let Quantity::Constant(value) = found
            && limits.high == 1.0
            && (1.0..=100.0).contains(&value)
            && value != 1.0
        {
            reader.wrong(
                node,
                format!("{what} is {value}; it {}", limits.words),
                format!("write a fraction, not percent: {}", value / 100.0),
            );
            return None;
        }
        within(reader, node, what, limits, &found).then_some(found)
    }

    /// A value that is no property at all.
    fn no_property(&self, node: NodeId, form: &Form<'_>, what: &str) {
        let (expected, unit) = match form.key {
            "net" => ("true, false or a fraction", "a fraction"),
            "permeability" => ("a number or [x, y, z]", "permeability is in millidarcy"),
            _ if form.has_axes => ("a number or [x, y, z]", "in a unit of your own"),
            _ => ("a number", "a fraction"),
        };
        let remedy = match self.reader.tree.value(node) {
            Value::Text(text) if form.key == "permeability" => {
                match text.trim_end_matches(char::is_alphabetic) {
                    bare if ["", "mD"].contains(&&text[bare.len()..]) => number_remedy(text, unit),
                    _ => "write millidarcy, without quotes or unit".to_owned(),
                }
            }
            Value::Text(text) => number_remedy(text, unit),
            _ if form.key == "permeability" => {
                format!(
                    "write one number in millidarcy, a distribution as {{ lognormal = [mean, sd] }}, or {ALONG}"
                )
            }
            _ if form.has_axes => {
                format!("write one number, a distribution as {{ normal = [mean, sd] }}, or {ALONG}")
            }
            _ => "write a number from 0 to 1, or a distribution as { uniform = [0.2, 0.3] }"
                .to_owned(),
        };
        let found = self.reader.tree.describe(node);
        let message = format!("expected {expected} for {what}, found {found}");
        self.reader.wrong(node, message, remedy);
    }
}

/// Whether an unknown key is more likely a known one, misspelt or by another name, than a property of its own.
fn slip(key: &str, known: &[&str]) -> bool {
    let is_long = key.chars().count() >= 4;
    suggest::synonym(key, known).is_some() || is_long && suggest::nearest(key, known).is_some()
}
