//! A model file as a tree of values that know where they stand.
//!
//! TOML and JSON become the same tree, so everything after this module is written once. Nodes live in one list and refer to
//! each other by number, so a deep tree costs no stack; what nests deeper than [`MAX_DEPTH`] is refused.

use super::defects::{Defect, Span};

/// The deepest nesting that a model file may have; real ones stay below 6.
pub(crate) const MAX_DEPTH: usize = 32;

/// Number of a node in its tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct NodeId(pub(crate) usize);

/// The tree of a model file, with the overrides already in it.
#[derive(Debug, Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
}

/// A value and its place.
#[derive(Debug)]
struct Node {
    span: Span,
    value: Value,
}

/// What a node holds.
#[derive(Debug)]
pub(crate) enum Value {
    Null,
    Bool(bool),
    Integer(i128),
    Float(f64),
    Text(String),
    Date(String),
    List(Vec<NodeId>),
    Table(Vec<Entry>),
}

/// A key of a table and what it holds.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_span: Span,
    pub(crate) node: NodeId,
}

impl Tree {
    pub(crate) fn add(&mut self, span: Span, value: Value) -> NodeId {
        self.nodes.push(Node { span, value });
        NodeId(self.nodes.len() - 1)
    }

    /// Adds entries to a table.
    pub(crate) fn extend(&mut self, table: NodeId, more: Vec<Entry>) {
        if let Value::Table(entries) = self.value_mut(table) {
            entries.extend(more);
        }
    }

    /// A copy of a node with all that it holds, each at the place where the first stands.
    pub(crate) fn copy(&mut self, id: NodeId) -> NodeId {
        let value = match self.value(id) {
            Value::Null => Value::Null,
            Value::Bool(value) => Value::Bool(*value),
            Value::Integer(value) => Value::Integer(*value),
            Value::Float(value) => Value::Float(*value),
            Value::Text(text) => Value::Text(text.clone()),
            Value::Date(text) => Value::Date(text.clone()),
            Value::List(elements) => {
                let elements = elements.clone();
                Value::List(elements.into_iter().map(|node| self.copy(node)).collect())
            }
            Value::Table(entries) => {
                let mut entries = entries.clone();
                for entry in &mut entries {
                    entry.node = self.copy(entry.node);
                }
                Value::Table(entries)
            }
        };
        self.add(self.span(id), value)
    }

    pub(crate) fn value(&self, id: NodeId) -> &Value {
        &self.nodes[id.0].value
    }

    pub(crate) fn value_mut(&mut self, id: NodeId) -> &mut Value {
        &mut self.nodes[id.0].value
    }

    pub(crate) fn span(&self, id: NodeId) -> Span {
        self.nodes[id.0].span
    }

    /// The entries of a table; none if the node is no table.
    pub(crate) fn entries(&self, id: NodeId) -> &[Entry] {
        match self.value(id) {
            Value::Table(entries) => entries,
            _ => &[],
        }
    }

    /// The elements of a list; none if the node is no list.
    pub(crate) fn elements(&self, id: NodeId) -> &[NodeId] {
        match self.value(id) {
            Value::List(elements) => elements,
            _ => &[],
        }
    }

    pub(crate) fn entry(&self, table: NodeId, key: &str) -> Option<&Entry> {
        self.entries(table).iter().find(|entry| entry.key == key)
    }

    pub(crate) fn text(&self, id: NodeId) -> Option<&str> {
        match self.value(id) {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    pub(crate) fn number(&self, id: NodeId) -> Option<f64> {
        match self.value(id) {
            Value::Integer(value) => Some(*value as f64),
            Value::Float(value) => Some(*value),
            _ => None,
        }
    }

    /// For every node, the one that holds it; of several, which features that are like each other may be, the first.
    pub(crate) fn holders(&self) -> Vec<Option<NodeId>> {
        let mut holders = vec![None; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate() {
            match &node.value {
                Value::List(elements) => {
                    for element in elements {
                        holders[element.0].get_or_insert(NodeId(i));
                    }
                }
                Value::Table(entries) => {
                    for entry in entries {
                        holders[entry.node.0].get_or_insert(NodeId(i));
                    }
                }
                _ => {}
            }
        }
        holders
    }

    /// What a node is called within its holder: its key, its id if it is one of a list of features, or its number from 1.
    pub(crate) fn step(&self, holder: NodeId, node: NodeId) -> String {
        match self.value(holder) {
            Value::Table(entries) => entries
                .iter()
                .find(|entry| entry.node == node)
                .map(|entry| entry.key.clone())
                .unwrap_or_default(),
            Value::List(elements) => {
                let id = self
                    .entry(node, "id")
                    .and_then(|entry| self.text(entry.node));
                let number = elements.iter().position(|&element| element == node);
                match (id, number) {
                    (Some(id), _) => id.to_owned(),
                    (None, Some(number)) => (number + 1).to_string(),
                    (None, None) => String::new(),
                }
            }
            _ => String::new(),
        }
    }

    /// The node in words, for "expected …, found …".
    pub(crate) fn describe(&self, id: NodeId) -> String {
        match self.value(id) {
            Value::Null => "null".to_owned(),
            Value::Bool(value) => format!("`{value}`"),
            Value::Integer(value) => format!("the number {value}"),
            Value::Float(value) => format!("the number {value}"),
            Value::Text(text) => format!("the text {}", quoted(text)),
            Value::Date(text) => format!("the date {text}"),
            Value::List(elements) if elements.is_empty() => "an empty list".to_owned(),
            Value::List(elements) => format!("a list of {}", elements.len()),
            Value::Table(_) => "a table".to_owned(),
        }
    }
}

/// A text from the file, quoted, escaped and cut to a length that fits a message.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 48;
    if text.chars().count() > LONGEST {
        let start: String = text.chars().take(LONGEST).collect();
        format!("{:?}", format!("{start}…"))
    } else {
        format!("{text:?}")
    }
}

/// What could be read of a text, and what is wrong with it.
pub(crate) struct Parsed {
    pub(crate) root: NodeId,
    pub(crate) defects: Vec<Defect>,
}

/// The defect of a text that nests too deeply.
pub(crate) fn too_deep(span: Span) -> Defect {
    Defect::new(
        span,
        format!("values are nested more than {MAX_DEPTH} deep"),
        "no model needs that; check for missing closing brackets",
    )
}
