//! Values from a file of parameters, as engines of ensembles write it: a JSON object of names and numbers.
//!
//! Three forms are read, mixed or not: `{"NAME": 1.5}`, `{"NAME": {"value": 1.5}}`, and both of these in groups, `{"GROUP": {"NAME": 1.5}}`; a
//! table whose only key is `value` is never a group. ERT 23 writes the second one. ERT 9 wrote groups, and beside a group with
//! lognormal parameters another one with their logarithms, which is left out.
//!
//! A name is a key of the model, as an override names it (`feature.channel.width`), unless a table of names says which it is; what such a
//! table does not name is for other programs.

use std::fs;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::defects::{Defect, Span};
use super::overrides;
use super::suggest;
use super::tree::{Entry, NodeId, Tree, Value};
use super::{json_text, toml_text};

/// The key of a parameter's value where it has a table of its own.
const VALUE: &str = "value";

/// What begins the name of a group that repeats another one as decimal logarithms.
const LOGARITHMS: &str = "LOG10_";

/// Keys of a model that it need not have.
const OPTIONAL: [&str; 5] = ["description", "origin", "seed", "tops", "well"];

/// Whole numbers up to this are exact as floating-point numbers.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// A file of parameters, and the table that says which keys of the model they are; neither is looked into before the model is.
#[derive(Clone, Debug)]
pub struct Parameters {
    file: NamedText,
    names: Option<NamedText>,
}

/// A text and what it is called in messages.
#[derive(Clone, Debug)]
struct NamedText {
    name: String,
    text: String,
}

/// Why a file of parameters or a table of their names could not be read.
#[derive(Debug, Error)]
pub enum ParametersError {
    /// The system refused to read it.
    #[error("{}: {what} cannot be read: {source}; check the path", path.display())]
    Unreadable {
        /// Which of the two it is.
        what: &'static str,
        /// The path given.
        path: PathBuf,
        /// The system's words.
        source: std::io::Error,
    },
    /// It is no text.
    #[error("{}: {what} is not UTF-8 from its byte {at} on; save it as UTF-8", path.display())]
    NotUtf8 {
        /// Which of the two it is.
        what: &'static str,
        /// The path given.
        path: PathBuf,
        /// How many bytes are text.
        at: usize,
    },
}

impl Parameters {
    /// Reads a file of parameters (JSON), and a table of their names (TOML: `NAME = "feature.channel.width"`, or a list of keys).
    ///
    /// # Errors
    ///
    /// If a file cannot be read or is no text. What it says is checked with the model, by
    /// [`Model::check`](super::Model::check).
    pub fn read(path: &Path, names: Option<&Path>) -> Result<Self, ParametersError> {
        let file = read("the file of parameters", path)?;
        let names = names.map(|path| read("the table of parameters' names", path));
        let names = names.transpose()?;
        Ok(Self { file, names })
    }

    /// Its texts, with what they are called.
    pub(crate) fn texts(&self) -> impl Iterator<Item = (&str, &str)> {
        let both = std::iter::once(&self.file).chain(&self.names);
        both.map(|one| (one.name.as_str(), one.text.as_str()))
    }

    /// Puts the values into the tree below `root`; its texts have the numbers `text` and, of the names, that after it.
    pub(crate) fn apply(&self, tree: &mut Tree, root: NodeId, text: usize) -> Vec<Defect> {
        let found = match Found::in_file(tree, text, &self.file.text) {
            Ok(found) => found,
            Err(defects) => return defects,
        };
        let settings = match &self.names {
            None => found.by_themselves(tree, root),
            Some(names) => found.by_names(tree, text + 1, &names.text),
        };
        let settings = match settings.and_then(each_key_once) {
            Ok(settings) => settings,
            Err(defects) => return defects,
        };
        let mut defects = Vec::new();
        for setting in settings {
            let put = usable(tree, &setting.parameter)
                .map_err(|defect| vec![*defect])
                .and_then(|value| {
                    overrides::apply_key(tree, root, &setting.key, setting.span, value)
                });
            defects.extend(put.err().into_iter().flatten());
        }
        defects
    }
}

fn read(what: &'static str, path: &Path) -> Result<NamedText, ParametersError> {
    let bytes = fs::read(path).map_err(|source| ParametersError::Unreadable {
        what,
        path: path.to_owned(),
        source,
    })?;
    let text = String::from_utf8(bytes).map_err(|error| ParametersError::NotUtf8 {
        what,
        path: path.to_owned(),
        at: error.utf8_error().valid_up_to(),
    })?;
    Ok(NamedText {
        name: path.display().to_string(),
        text: text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned(),
    })
}

/// A key of the model that gets a value.
struct Setting {
    key: String,
    /// Where the key, or the name that stands for it, is written.
    span: Span,
    parameter: Entry,
}

/// The parameters of a file: what one holds matters only if it is taken.
struct Found(Vec<Entry>);

impl Found {
    fn in_file(tree: &mut Tree, text: usize, source: &str) -> Result<Self, Vec<Defect>> {
        let parsed = json_text::parse(tree, text, source);
        if !parsed.defects.is_empty() {
            return Err(parsed.defects);
        }
        if !matches!(tree.value(parsed.root), Value::Table(_)) {
            return Err(vec![Defect::new(
                tree.span(parsed.root),
                format!(
                    "parameters are an object of names and values, this is {}",
                    tree.describe(parsed.root)
                ),
                "write {\"feature.channel.width\": 30}",
            )]);
        }
        let mut found: Vec<Entry> = Vec::new();
        for entry in tree.entries(parsed.root) {
            let inner = tree.entries(entry.node);
            match value_of(tree, entry.node) {
                Some(node) => found.push(Entry {
                    node,
                    ..entry.clone()
                }),
                None if is_repeated(tree, parsed.root, &entry.key) => {}
                None => found.extend(inner.iter().map(|entry| Entry {
                    node: value_of(tree, entry.node).unwrap_or(entry.node),
                    ..entry.clone()
                })),
            }
        }
        Ok(Self(found))
    }

    /// Each name is a key.
    fn by_themselves(self, tree: &Tree, root: NodeId) -> Result<Vec<Setting>, Vec<Defect>> {
        let strange = |entry: &&Entry| {
            let is_word = entry.key.chars().all(|c| c.is_alphanumeric() || c == '_');
            let is_known = OPTIONAL.contains(&entry.key.as_str());
            is_word && !is_known && tree.entry(root, &entry.key).is_none()
        };
        let mut defects: Vec<Defect> = self.0.iter().filter(strange).map(no_key).collect();
        defects.extend(names_that_are_twice(&self.0));
        if !defects.is_empty() {
            return Err(defects);
        }
        let setting = |entry: Entry| Setting {
            key: entry.key.clone(),
            span: entry.key_span,
            parameter: entry,
        };
        Ok(self.0.into_iter().map(setting).collect())
    }

    /// A table says which keys the names are.
    fn by_names(
        self,
        tree: &mut Tree,
        text: usize,
        source: &str,
    ) -> Result<Vec<Setting>, Vec<Defect>> {
        let parsed = toml_text::parse(tree, text, source);
        let mut defects = parsed.defects;
        if !defects.is_empty() {
            return Err(defects);
        }
        let mut settings = Vec::new();
        for named in tree.entries(parsed.root) {
            let called = self.0.iter().filter(|entry| entry.key == named.key);
            let called: Vec<Entry> = called.cloned().collect();
            defects.extend(names_that_are_twice(&called));
            let Some(parameter) = called.first() else {
                defects.push(self.absent(named));
                continue;
            };
            match keys_of(tree, named) {
                Ok(keys) => settings.extend(keys.into_iter().map(|(key, span)| Setting {
                    key,
                    span,
                    parameter: parameter.clone(),
                })),
                Err(defect) => defects.push(*defect),
            }
        }
        if defects.is_empty() {
            Ok(settings)
        } else {
            Err(defects)
        }
    }

    fn absent(&self, named: &Entry) -> Defect {
        let names: Vec<&str> = self.0.iter().map(|entry| entry.key.as_str()).collect();
        Defect::new(
            named.key_span,
            format!("the parameters have no {}", suggest::code(&named.key)),
            match suggest::nearest(&named.key, &names) {
                Some(known) => format!("did you mean `{known}`?"),
                None if names.is_empty() => "the file holds none; remove the name".to_owned(),
                None => format!("remove the name; there are {}", suggest::list(&names)),
            },
        )
    }
}

/// Whether a group has the logarithms of another one.
fn is_repeated(tree: &Tree, root: NodeId, group: &str) -> bool {
    let of = group.strip_prefix(LOGARITHMS);
    of.is_some_and(|group| tree.entry(root, group).is_some())
}

/// The value of a parameter: itself, or what its table holds; none of a group.
fn value_of(tree: &Tree, node: NodeId) -> Option<NodeId> {
    match (tree.value(node), tree.entries(node)) {
        (Value::Table(_), [entry]) if entry.key == VALUE => Some(entry.node),
        (Value::Table(_), _) => None,
        _ => Some(node),
    }
}

/// A value as the model takes it: engines of ensembles know no whole numbers, so a number that is whole is one.
fn usable(tree: &mut Tree, entry: &Entry) -> Result<NodeId, Box<Defect>> {
    match tree.value(entry.node) {
        Value::Null | Value::Table(_) | Value::Date(_) => Err(Box::new(Defect::new(
            tree.span(entry.node),
            format!(
                "the parameter {} is {}",
                suggest::code(&entry.key),
                tree.describe(entry.node)
            ),
            "write a number, a text, true or false, or a list of them, below a name or a name in a group",
        ))),
        Value::Float(value) if value.fract() == 0.0 && value.abs() <= LARGEST_WHOLE => {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "whole, and within what is exact"
            )]
            let whole = *value as i128;
            let span = tree.span(entry.node);
            Ok(tree.add(span, Value::Integer(whole)))
        }
        // Of its own for each key.
        _ => Ok(tree.copy(entry.node)),
    }
}

/// The keys that a table of names gives for one of them.
fn keys_of(tree: &Tree, named: &Entry) -> Result<Vec<(String, Span)>, Box<Defect>> {
    let of = |node: &NodeId| Some((tree.text(*node)?.to_owned(), tree.span(*node)));
    let keys: Option<Vec<_>> = match tree.value(named.node) {
        Value::List(elements) => elements.iter().map(of).collect(),
        _ => of(&named.node).map(|key| vec![key]),
    };
    keys.filter(|keys| !keys.is_empty()).ok_or_else(|| {
        Box::new(Defect::new(
            tree.span(named.node),
            format!("{} says no key of the model", suggest::code(&named.key)),
            "write NAME = \"feature.channel.width\", or a list of such keys; a name with dots needs quotes",
        ))
    })
}

/// A word that is no key of the model.
fn no_key(entry: &Entry) -> Defect {
    Defect::new(
        entry.key_span,
        format!(
            "the parameter {} is no key of the model",
            suggest::code(&entry.key)
        ),
        "name it as the key that it sets, as feature.channel.width, or say with --parameter-names which parameters are which keys",
    )
}

fn names_that_are_twice(found: &[Entry]) -> Vec<Defect> {
    let twice = found.iter().enumerate().filter_map(|(at, entry)| {
        let first = found[..at].iter().find(|first| first.key == entry.key)?;
        Some(given_twice(
            "parameter",
            &entry.key,
            entry.key_span,
            first.key_span,
        ))
    });
    twice.collect()
}

fn each_key_once(settings: Vec<Setting>) -> Result<Vec<Setting>, Vec<Defect>> {
    let twice = settings.iter().enumerate().filter_map(|(at, setting)| {
        let first = settings[..at]
            .iter()
            .find(|first| first.key == setting.key)?;
        Some(given_twice("key", &setting.key, setting.span, first.span))
    });
    let twice: Vec<Defect> = twice.collect();
    if twice.is_empty() {
        Ok(settings)
    } else {
        Err(twice)
    }
}

fn given_twice(what: &str, word: &str, span: Span, first: Span) -> Defect {
    Defect::new(
        span,
        format!("the {what} {} is given twice", suggest::code(word)),
        "give each of them once, whatever the groups",
    )
    .with_related(first, "first given here")
}
