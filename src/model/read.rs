//! serde over a [`Tree`]: tables become structs, and every defect is kept.
//!
//! A struct that stands for a table has fields of type [`Field`]. A value that does not fit becomes [`Field::Bad`] and a
//! defect, and reading goes on with the next key; so one pass finds everything. Keys that no struct asked for are found by
//! [`Reader::close`], since several structs may read the same table (what all features share, and what a kind adds).

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};

use super::defects::{Collector, Defect};
use super::deserialize::{FIELD, Failure, NodeDeserializer};
use super::suggest;
use super::tree::{Entry, NodeId, Tree};

/// What a key of a table holds.
#[derive(Clone, Debug)]
pub(crate) enum Field<T> {
    /// The key is not there.
    Missing,
    /// The value does not fit; a defect says why.
    Bad,
    /// The value and its node.
    Good(NodeId, T),
}

impl<T> Field<T> {
    pub(crate) fn good(self) -> Option<(NodeId, T)> {
        match self {
            Self::Good(node, value) => Some((node, value)),
            Self::Missing | Self::Bad => None,
        }
    }
}

/// A value of any shape: only its node is wanted.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Any;

impl<'de> Deserialize<'de> for Any {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        de::IgnoredAny::deserialize(deserializer).map(|_| Self)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Field<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        // serde offers an absent key as "none", through deserialize_option alone.
        deserializer.deserialize_option(FieldVisitor(PhantomData))
    }
}

/// The last steps of a path that is too long for a message: what is meant is at its end.
fn end_of(path: &str) -> String {
    const LONGEST: usize = 44;
    let mut rest = path;
    while rest.chars().count() > LONGEST
        && let Some((_, below)) = rest.split_once('.')
    {
        rest = below;
    }
    if rest.len() == path.len() {
        path.to_owned()
    } else {
        format!("….{rest}")
    }
}

struct FieldVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for FieldVisitor<T> {
    type Value = Field<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_none<E>(self) -> Result<Self::Value, E> {
        Ok(Field::Missing)
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_newtype_struct(FIELD, self)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let node = seq.next_element::<usize>()?;
        let value = seq.next_element::<T>()?;
        Ok(match (node, value) {
            (Some(node), Some(value)) => Field::Good(NodeId(node), value),
            _ => Field::Bad,
        })
    }
}

/// Unknown keys of a table among which a missing one is looked for: each is compared with all that are known.
const MOST_MISSPELT: usize = 100;

/// Reads the tables of a tree and gathers what is wrong.
pub(crate) struct Reader<'t> {
    pub(crate) tree: &'t Tree,
    holders: Vec<Option<NodeId>>,
    defects: RefCell<Collector>,
    /// The keys that some struct asked for, by table.
    known: RefCell<BTreeMap<NodeId, Vec<&'static str>>>,
    found: Cell<usize>,
}

impl<'t> Reader<'t> {
    pub(crate) fn new(tree: &'t Tree, defects: Collector) -> Self {
        Self {
            tree,
            holders: tree.holders(),
            defects: RefCell::new(defects),
            known: RefCell::default(),
            found: Cell::new(0),
        }
    }

    pub(crate) fn into_defects(self) -> Collector {
        self.defects.into_inner()
    }

    /// How many defects were found so far.
    pub(crate) fn found(&self) -> usize {
        self.found.get()
    }

    pub(crate) fn report(&self, defect: Defect) {
        self.found.set(self.found.get() + 1);
        self.defects.borrow_mut().add(defect);
    }

    /// Reports a defect of the value `node`.
    pub(crate) fn wrong(
        &self,
        node: NodeId,
        message: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let defect = Defect::new(self.tree.span(node), message, remedy);
        self.report(if self.is_full() {
            defect
        } else {
            defect.with_path(self.path(node))
        });
    }

    /// Whether further defects are only counted, so that no remedy need be found for them.
    pub(crate) fn is_full(&self) -> bool {
        self.defects.borrow().is_full()
    }

    /// A remedy that costs a search, unless nobody will read it.
    pub(crate) fn hint(&self, remedy: impl FnOnce() -> String) -> String {
        if self.is_full() {
            String::new()
        } else {
            remedy()
        }
    }

    /// Notes that a struct reads these keys of a table.
    pub(super) fn ask(&self, table: NodeId, keys: &'static [&'static str]) {
        self.known
            .borrow_mut()
            .entry(table)
            .or_default()
            .extend(keys);
    }

    /// The keys that lead to a node, as `feature.channel.width`.
    pub(crate) fn path(&self, node: NodeId) -> String {
        let mut steps = Vec::new();
        let mut at = node;
        while let Some(Some(holder)) = self.holders.get(at.0) {
            steps.push(self.tree.step(*holder, at));
            at = *holder;
        }
        steps.reverse();
        steps.join(".")
    }

    /// Reads the table `node` as a struct; `None` if it is no table (which is then a defect).
    pub(crate) fn table<T: Deserialize<'t>>(&self, node: NodeId) -> Option<T> {
        self.read(node)
    }

    /// Reads any node; `None` if it does not fit (which is then a defect).
    pub(crate) fn read<T: Deserialize<'t>>(&self, node: NodeId) -> Option<T> {
        let deserializer = NodeDeserializer { reader: self, node };
        match T::deserialize(deserializer) {
            Ok(value) => Some(value),
            Err(failure) => {
                self.failed(failure, node);
                None
            }
        }
    }

    pub(super) fn failed(&self, failure: Failure, node: NodeId) {
        let node = failure.node.unwrap_or(node);
        let path = self.hint(|| self.path(node));
        let message = if path.is_empty() {
            failure.message
        } else {
            format!("{}: {}", suggest::code(&end_of(&path)), failure.message)
        };
        self.wrong(node, message, failure.remedy);
    }

    /// Reads a finite number.
    pub(crate) fn number(&self, node: NodeId) -> Option<f64> {
        self.read(node)
    }

    /// The value of a key that must be there; its absence is a defect of `table`, which messages call `name`.
    pub(crate) fn need<T>(
        &self,
        field: Field<T>,
        table: NodeId,
        name: &str,
        key: &str,
        example: &str,
    ) -> Option<(NodeId, T)> {
        if matches!(field, Field::Missing) {
            self.missing(table, name, key, example);
        }
        field.good()
    }

    /// Reports that a key is missing, unless it is there but misspelt (which closing the table reports).
    pub(crate) fn missing(&self, table: NodeId, name: &str, key: &str, example: &str) {
        // What a feature has not by being like another one is told of that one, or of what names it.
        let has = |key: &str| self.tree.entry(table, key).is_some();
        if key != "id" && has("id") && has("like") {
            return;
        }
        let known = self.known(table);
        let unknown = self.tree.entries(table).iter();
        let mut unknown = unknown
            .map(|entry| entry.key.as_str())
            .filter(|word| !known.contains(word))
            .take(MOST_MISSPELT);
        let misspelt = unknown.any(|word| suggest::nearest(word, &known) == Some(key));
        if !misspelt {
            self.wrong(
                table,
                format!("{name} has no `{key}`"),
                format!("add it, for example: {example}"),
            );
        }
    }

    /// The entries of a table that no struct asked for.
    pub(crate) fn unknown(&self, table: NodeId) -> Vec<&'t Entry> {
        let known = self.known.borrow();
        let known = known.get(&table).map_or(&[][..], Vec::as_slice);
        self.tree
            .entries(table)
            .iter()
            .filter(|entry| !known.contains(&entry.key.as_str()))
            .collect()
    }

    /// The keys that may stand in a table.
    pub(crate) fn known(&self, table: NodeId) -> Vec<&'static str> {
        self.known.borrow().get(&table).cloned().unwrap_or_default()
    }

    /// Reports the keys of a table that no struct asked for; `what` names the table.
    pub(crate) fn close(&self, table: NodeId, what: &str) {
        let known = self.known(table);
        for entry in self.unknown(table) {
            self.unknown_key(entry, &known, what);
        }
    }

    pub(crate) fn unknown_key(&self, entry: &Entry, known: &[&str], what: &str) {
        let remedy = self.hint(|| suggest::key(&entry.key, known));
        let message = format!("unknown key {} in {what}", suggest::code(&entry.key));
        let path = self.hint(|| self.path(entry.node));
        self.report(Defect::new(entry.key_span, message, remedy).with_path(path));
    }
}
