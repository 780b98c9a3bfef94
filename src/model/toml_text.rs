//! TOML text → [`Tree`].

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::defects::{Defect, Span};
use super::tree::{Entry, MAX_DEPTH, NodeId, Parsed, Tree, Value, too_deep};

/// A text with more syntax errors is no model file; what follows them is noise.
const MOST_ERRORS: usize = 20;

/// Adds the TOML document `source`, which is the text number `text`, to the tree.
pub(crate) fn parse(tree: &mut Tree, text: usize, source: &str) -> Parsed {
    let (document, errors) = DeTable::parse_recoverable(source);
    let whole = Span::new(text, 0, 0);
    let mut reader = Reader {
        tree,
        text,
        defects: worth_telling(&errors)
            .iter()
            .map(|error| syntax_defect(text, error))
            .collect(),
    };
    let root = reader.table(document.get_ref(), whole, 0);
    Parsed {
        root,
        defects: reader.defects,
    }
}

/// The errors up to the first that leaves a bracket open: from there on the parser takes keys for elements.
fn worth_telling(errors: &[toml::de::Error]) -> &[toml::de::Error] {
    let leaves_open = |error: &toml::de::Error| {
        ["array", "inline table", "string"]
            .iter()
            .any(|what| error.message().contains(what))
    };
    let last = errors.iter().position(leaves_open);
    &errors[..last.map_or(errors.len(), |last| last + 1).min(MOST_ERRORS)]
}

struct Reader<'t> {
    tree: &'t mut Tree,
    text: usize,
    defects: Vec<Defect>,
}

impl Reader<'_> {
    fn span<T>(&self, spanned: &Spanned<T>) -> Span {
        let range = spanned.span();
        Span::new(self.text, range.start, range.end)
    }

    fn table(&mut self, table: &DeTable<'_>, span: Span, depth: usize) -> NodeId {
        let mut entries: Vec<Entry> = table
            .iter()
            .map(|(key, value)| Entry {
                key: key.get_ref().to_string(),
                key_span: self.span(key),
                node: self.value(value, depth + 1),
            })
            .collect();
        entries.sort_by_key(|entry| entry.key_span);
        self.tree.add(span, Value::Table(entries))
    }

    fn value(&mut self, spanned: &Spanned<DeValue<'_>>, depth: usize) -> NodeId {
        let span = self.span(spanned);
        if depth > MAX_DEPTH {
            self.defects.push(too_deep(span));
            return self.tree.add(span, Value::Null);
        }
        let value = match spanned.get_ref() {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(integer) => {
                match i128::from_str_radix(integer.as_str(), integer.radix()) {
                    Ok(value) => Value::Integer(value),
                    Err(_) => Value::Float(float(integer.as_str())),
                }
            }
            DeValue::Float(number) => Value::Float(float(number.as_str())),
            DeValue::Boolean(value) => Value::Bool(*value),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(elements) => {
                let elements = elements
                    .iter()
                    .map(|element| self.value(element, depth + 1))
                    .collect();
                Value::List(elements)
            }
            DeValue::Table(table) => return self.table(table, span, depth),
        };
        self.tree.add(span, value)
    }
}

/// Numbers that have no value here (out of range) become NaN, which no check lets through.
fn float(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}

fn syntax_defect(text: usize, error: &toml::de::Error) -> Defect {
    let span = error.span().unwrap_or(0..0);
    let message = error.message().to_owned();
    let remedy = remedy_for(&message);
    Defect::new(
        Span::new(text, span.start, span.end),
        format!("not valid TOML: {message}"),
        remedy,
    )
}

fn remedy_for(message: &str) -> &'static str {
    if message.contains("duplicate key") {
        "give every key once in its table; repeat [[feature]] (double brackets) for the next feature"
    } else if message.contains("string values must be quoted") {
        "put text in double quotes: key = \"text\""
    } else if message.contains("array") {
        "separate the entries of a list with commas and close it with ]; perhaps the ] is missing on a line above"
    } else if message.contains("recursion limit") {
        "values are nested too deeply; check for missing closing brackets"
    } else if message.contains("basic string") || message.contains("literal string") {
        "close the text with a quote on the same line; write \\\\ for a backslash"
    } else {
        "write one `key = value` on a line; text in double quotes, lists in [ ], tables in { }"
    }
}
