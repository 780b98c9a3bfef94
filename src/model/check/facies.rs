//! Facies and their rock properties.

use std::collections::BTreeMap;

use crate::model::checker::Checker;
use crate::model::colours;
use crate::model::defects::Defect;
use crate::model::domain::Domain;
use crate::model::facies::{Facies, Rgb};
use crate::model::file::FaciesFile;
use crate::model::read::{Any, Field};
use crate::model::spec::Feature;
use crate::model::suggest;
use crate::model::tree::{Entry, NodeId, Value, quoted};
use crate::model::values::facies::{FaciesList, is_id};

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
        let keys: Vec<&str> = entries.iter().map(|entry| entry.key.as_str()).collect();
        let colors = colours::of_facies(&keys);
        for (number, entry) in entries.iter().enumerate() {
            list.names.push(entry.key.clone());
            list.index.insert(entry.key.clone(), number);
            list.nodes.push(entry.node);
            list.read.push(self.facies(entry, colors[number]));
        }
        list
    }

    fn facies(&self, entry: &Entry, default_color: Rgb) -> Option<Facies> {
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
            None => Some(default_color),
            Some(given) => given.and_then(|(at, text)| self.color(at, &text)),
        };
        let title = self.title(file.name.as_ref(), &format!("facies {}", quoted(key)));
        let properties = self.properties(*node, &format!("facies {}", quoted(key)));
        (self.reader.found() == before).then_some(())?;
        Some(Facies {
            name: key.clone(),
            title: title.ok()?,
            color: color?,
            description: file.description.and_then(Field::good).map(|(_, text)| text),
            properties: properties?,
        })
    }

    fn color(&self, node: NodeId, text: &str) -> Option<Rgb> {
        let color = parse_color(text).or_else(|| colours::named(text));
        if color.is_none() {
            let remedy = self.reader.hint(|| {
                let plain = text.to_lowercase().replace([' ', '-', '_'], "");
                match suggest::nearest(&plain, &colours::names()) {
                    Some(name) if !text.starts_with('#') => format!("did you mean \"{name}\"?"),
                    _ => "write red, green and blue as hexadecimal digits, \"#e6c25c\", or a colour's name in one word, as \"darkgrey\""
                        .to_owned(),
                }
            });
            let message = format!("{} is not a colour", quoted(text));
            self.reader.wrong(node, message, remedy);
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
