//! JSON text → [`Tree`].

use std::collections::BTreeMap;

use jsonc_parser::ast::{Object, Value as Json};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::defects::{Defect, Span};
use super::tree::{Entry, MAX_DEPTH, NodeId, Parsed, Tree, Value, too_deep};

/// Plain JSON, none of the parser's extensions: what is accepted here is accepted by every other JSON tool.
const STRICT: ParseOptions = ParseOptions {
    allow_comments: false,
    allow_loose_object_property_names: false,
    allow_trailing_commas: false,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// Adds the JSON document `source`, which is the text number `text`, to the tree.
pub(crate) fn parse(tree: &mut Tree, text: usize, source: &str) -> Parsed {
    let mut reader = Reader {
        tree,
        text,
        defects: Vec::new(),
    };
    let parsed = parse_to_ast(source, &CollectOptions::default(), &STRICT);
    let root = match parsed {
        Ok(document) => match document.value {
            Some(value) => reader.value(&value, 0),
            None => reader.tree.add(Span::new(text, 0, 0), Value::Null),
        },
        Err(error) => {
            let range = error.range();
            let span = Span::new(text, range.start, range.end);
            reader.defects.push(Defect::new(
                span,
                format!("not valid JSON: {}", error.kind()),
                "write \"key\": value, separated by commas, without comments or a comma before a closing bracket",
            ));
            reader.tree.add(span, Value::Null)
        }
    };
    Parsed {
        root,
        defects: reader.defects,
    }
}

struct Reader<'t> {
    tree: &'t mut Tree,
    text: usize,
    defects: Vec<Defect>,
}

impl Reader<'_> {
    fn span(&self, of: &impl Ranged) -> Span {
        Span::new(self.text, of.start(), of.end())
    }

    fn value(&mut self, json: &Json<'_>, depth: usize) -> NodeId {
        let span = self.span(json);
        if depth > MAX_DEPTH {
            self.defects.push(too_deep(span));
            return self.tree.add(span, Value::Null);
        }
        let value = match json {
            Json::NullKeyword(_) => Value::Null,
            Json::BooleanLit(literal) => Value::Bool(literal.value),
            Json::StringLit(literal) => Value::Text(literal.value.to_string()),
            Json::NumberLit(literal) => match literal.value.parse::<i128>() {
                Ok(value) => Value::Integer(value),
                Err(_) => Value::Float(literal.value.parse().unwrap_or(f64::NAN)),
            },
            Json::Array(array) => {
                let elements = array
                    .elements
                    .iter()
                    .map(|element| self.value(element, depth + 1))
                    .collect();
                Value::List(elements)
            }
            Json::Object(object) => Value::Table(self.entries(object, depth)),
        };
        self.tree.add(span, value)
    }

    fn entries(&mut self, object: &Object<'_>, depth: usize) -> Vec<Entry> {
        let mut seen: BTreeMap<String, Span> = BTreeMap::new();
        let mut entries = Vec::new();
        for property in &object.properties {
            let key = property.name.as_str().to_owned();
            let key_span = self.span(&property.name);
            if let Some(&first) = seen.get(&key) {
                self.defects.push(
                    Defect::new(
                        key_span,
                        format!("the key `{key}` is given twice"),
                        "give every key once in its object",
                    )
                    .with_related(first, "first given here"),
                );
                continue;
            }
            seen.insert(key.clone(), key_span);
            entries.push(Entry {
                key,
                key_span,
                node: self.value(&property.value, depth + 1),
            });
        }
        entries
    }
}
