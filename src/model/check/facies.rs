//! Facies and their rock properties.

use std::collections::BTreeMap;

use crate::model::checker::Checker;
use crate::model::defects::Defect;
use crate::model::deserialize::number_remedy;
use crate::model::domain::Domain;
use crate::model::facies::{Facies, Property, Rgb};
use crate::model::file::FaciesFile;
use crate::model::read::{Any, Field};
use crate::model::spec::Feature;
use crate::model::suggest;
use crate::model::tree::{Entry, NodeId, Value, quoted};
use crate::model::values::facies::{FaciesList, is_id};

/// Colours of facies that have none of their own, in turn: muted, and told apart without red against green.
const PALETTE: [Rgb; 8] = [
    Rgb {
        r: 0xe6,
        g: 0xc2,
        b: 0x5c,
    },
    Rgb {
        r: 0x9a,
        g: 0x8f,
        b: 0x78,
    },
    Rgb {
        r: 0x5b,
        g: 0x8a,
        b: 0xa6,
    },
    Rgb {
        r: 0xb8,
        g: 0x6b,
        b: 0x4b,
    },
    Rgb {
        r: 0x7d,
        g: 0x9b,
        b: 0x5f,
    },
    Rgb {
        r: 0x8a,
        g: 0x6f,
        b: 0x9e,
    },
    Rgb {
        r: 0xd8,
        g: 0xa4,
        b: 0x87,
    },
    Rgb {
        r: 0x4f,
        g: 0x5d,
        b: 0x6b,
    },
];

impl Checker<'_> {
    pub(super) fn all_facies(&self, field: Field<Any>, root: NodeId) -> FaciesList {
        let mut list = FaciesList {
            names: Vec::new(),
            index: BTreeMap::new(),
            nodes: Vec::new(),
            read: Vec::new(),
            whole: false,
        };
        let example = "a table [facies.sand] with color = \"#e6c25c\"";
        let Some((node, Any)) = self
            .reader
            .need(field, root, "the model", "facies", example)
        else {
            return list;
        };
        let Value::Table(entries) = self.reader.tree.value(node) else {
            self.reader.wrong(
                node,
                format!(
                    "expected a table of facies, found {}",
                    self.reader.tree.describe(node)
                ),
                "write a table for each facies: [facies.sand], [facies.mud]",
            );
            return list;
        };
        if entries.is_empty() {
            self.reader
                .wrong(node, "the model has no facies", format!("add {example}"));
            return list;
        }
        list.whole = true;
        for (number, entry) in entries.iter().enumerate() {
            list.names.push(entry.key.clone());
            list.index.insert(entry.key.clone(), number);
            list.nodes.push(entry.node);
            list.read.push(self.facies(entry, number));
        }
        list
    }

    fn facies(&self, entry: &Entry, number: usize) -> Option<Facies> {
        let Entry { key, node, .. } = entry;
        let before = self.reader.found();
        if !is_id(key) {
            self.reader.report(Defect::new(
                entry.key_span,
                format!("{} is not a name for a facies", quoted(key)),
                "use letters, digits, `-` and `_`",
            ));
        }
        let file: FaciesFile = self.reader.table(*node)?;
        let color = match file.color.map(Field::good) {
            None => Some(PALETTE[number % PALETTE.len()]),
            Some(given) => given.and_then(|(at, text)| self.color(at, &text)),
        };
        let properties = self.properties(*node, key);
        if let Some((at, value)) = file.porosity.and_then(Field::good)
            && !(0.0..=1.0).contains(&value)
        {
            self.reader.wrong(
                at,
                format!(
                    "the porosity of facies {} is {value}; it must lie between 0 and 1",
                    quoted(key)
                ),
                if (1.0..=100.0).contains(&value) {
                    format!("write a fraction, not percent: {}", value / 100.0)
                } else {
                    "write a fraction of the rock's volume".to_owned()
                },
            );
        }
        let permeability = properties.iter().find(|(key, _)| key == "permeability");
        if let Some((at, Any)) = file.permeability.and_then(Field::good)
            && let Some((_, Property::Vector(values))) = permeability
        {
            let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
            if lowest < 0.0 {
                self.reader.wrong(
                    at,
                    format!(
                        "the permeability of facies {} is {lowest}; it cannot be negative",
                        quoted(key)
                    ),
                    "write millidarcy (not the logarithm): one number, or [x, y, z]",
                );
            }
        }
        (self.reader.found() == before).then_some(())?;
        Some(Facies {
            name: key.clone(),
            color: color?,
            description: file.description.and_then(Field::good).map(|(_, text)| text),
            net: file.net.and_then(Field::good).map(|(_, net)| net),
            properties,
        })
    }

    /// Every number of the facies, in file order.
    fn properties(&self, facies: NodeId, name: &str) -> Vec<(String, Property)> {
        let known = self.reader.known(facies);
        let mut properties = Vec::new();
        for entry in self.reader.tree.entries(facies) {
            let key = entry.key.as_str();
            let value = self.reader.tree.value(entry.node);
            let numeric = matches!(value, Value::Integer(_) | Value::Float(_) | Value::List(_));
            if !known.contains(&key) {
                if !numeric || slip(key, &known) || !is_id(key) {
                    self.unknown_property(entry, &known, name);
                    continue;
                }
            } else if !["porosity", "permeability"].contains(&key) {
                continue;
            }
            let value = if numeric {
                self.property(entry.node)
            } else {
                // A porosity of a wrong type is reported where the known keys are read, and so is what is null.
                if key == "permeability" && !matches!(value, Value::Null) {
                    self.no_permeability(entry.node, name);
                }
                None
            };
            match (key, value) {
                ("permeability", Some(Property::Scalar(k))) => {
                    properties.push((key.to_owned(), Property::Vector([k; 3])));
                }
                (_, Some(value)) => properties.push((key.to_owned(), value)),
                (_, None) => {}
            }
        }
        properties
    }

    /// A key that is neither known nor has a rock property's value.
    fn unknown_property(&self, entry: &Entry, known: &[&str], facies: &str) {
        let what = format!("facies {}", quoted(facies));
        if slip(&entry.key, known) || !is_id(&entry.key) {
            self.reader.unknown_key(entry, known, &what);
            return;
        }
        let found = self.reader.tree.describe(entry.node);
        let key = suggest::code(&entry.key);
        let path = self.reader.hint(|| self.reader.path(entry.node));
        let defect = Defect::new(
            entry.key_span,
            format!("unknown key {key} in {what}, with {found}"),
            format!(
                "a rock property of your own is a number or [x, y, z]; the other keys here are {}",
                suggest::list(known)
            ),
        );
        self.reader.report(defect.with_path(path));
    }

    fn no_permeability(&self, node: NodeId, name: &str) {
        const FORM: &str = "a number or [x, y, z]";
        let remedy = match self.reader.tree.value(node) {
            Value::Text(text) => match text.trim_end_matches(char::is_alphabetic) {
                bare if ["", "mD"].contains(&&text[bare.len()..]) => {
                    number_remedy(text, "permeability is in millidarcy")
                }
                _ => "write millidarcy, without quotes or unit".to_owned(),
            },
            Value::Table(_) => {
                "rock properties are not drawn; write one number in millidarcy, or [x, y, z]"
                    .to_owned()
            }
            _ => "write one number in millidarcy, or [x, y, z]".to_owned(),
        };
        let (facies, found) = (quoted(name), self.reader.tree.describe(node));
        self.reader.wrong(
            node,
            format!("expected {FORM} for the permeability of facies {facies}, found {found}"),
            remedy,
        );
    }

    fn property(&self, node: NodeId) -> Option<Property> {
        let numbers = match self.reader.tree.value(node) {
            Value::List(elements) => elements.as_slice(),
            _ => &[node],
        };
        // Any unit is possible (a modulus in pascals, say), so the limit for lengths does not apply.
        let mut values = Vec::new();
        for &number in numbers {
            match self.reader.tree.number(number) {
                Some(value) if value.is_finite() => values.push(value),
                _ => {
                    let found = self.reader.tree.describe(number);
                    self.reader.wrong(
                        number,
                        format!("expected a finite number, found {found}"),
                        "rock properties are numbers: one, or [x, y, z]",
                    );
                    return None;
                }
            }
        }
        match (self.reader.tree.value(node), values.as_slice()) {
            (Value::List(_), &[x, y, z]) => Some(Property::Vector([x, y, z])),
            (Value::List(_), _) => {
                self.reader.wrong(
                    node,
                    format!(
                        "expected one number or [x, y, z], found a list of {}",
                        values.len()
                    ),
                    "write one number, or three in [ ]",
                );
                None
            }
            (_, &[value]) => Some(Property::Scalar(value)),
            _ => None,
        }
    }

    fn color(&self, node: NodeId, text: &str) -> Option<Rgb> {
        let color = parse_color(text);
        if color.is_none() {
            self.reader.wrong(
                node,
                format!("{} is not a colour", quoted(text)),
                "write red, green and blue as hexadecimal digits: \"#e6c25c\"",
            );
        }
        color
    }

    pub(super) fn note_unused_facies(
        &mut self,
        facies: &FaciesList,
        domain: &Domain,
        features: &[Feature],
    ) {
        let mut used = vec![false; facies.names.len()];
        used[domain.facies] = true;
        for feature in features {
            used[feature.facies] = true;
            for facies in feature.kind.more_facies() {
                used[facies] = true;
            }
        }
        for (i, name) in facies.names.iter().enumerate() {
            if !used[i] {
                self.note(
                    facies.nodes[i],
                    format!("nothing is of the facies `{name}`"),
                );
            }
        }
    }
}

/// Whether an unknown key is more likely a known one misspelt than a property of its own.
fn slip(key: &str, known: &[&str]) -> bool {
    key.chars().count() >= 4 && suggest::nearest(key, known).is_some()
}

fn parse_color(text: &str) -> Option<Rgb> {
    let digits = text.strip_prefix('#')?;
    if !digits.chars().all(|c| c.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    let channel = |shift: u32, mask: u32, scale: u32| {
        u8::try_from(((number >> shift) & mask) * scale).unwrap_or(u8::MAX)
    };
    match digits.len() {
        3 => Some(Rgb {
            r: channel(8, 0xf, 17),
            g: channel(4, 0xf, 17),
            b: channel(0, 0xf, 17),
        }),
        6 => Some(Rgb {
            r: channel(16, 0xff, 1),
            g: channel(8, 0xff, 1),
            b: channel(0, 0xff, 1),
        }),
        _ => None,
    }
}
