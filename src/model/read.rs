//! serde over a [`Tree`]: tables become structs, and every defect is kept.
//!
//! A struct that stands for a table has fields of type [`Field`]. A value that does not fit becomes [`Field::Bad`] and a
//! defect, and reading goes on with the next key; so one pass finds everything. Keys that no struct asked for are found by
//! [`Reader::close`], since several structs may read the same table (what all features share, and what a kind adds).

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use serde::de::value::{BorrowedStrDeserializer, U64Deserializer};
use serde::de::{
    self, Deserialize, DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, SeqAccess,
    Visitor,
};

use super::defects::{Collector, Defect};
use super::suggest;
use super::tree::{Entry, NodeId, Tree, Value};

/// No length, elevation or ratio in a model of the Earth is larger.
const HUGE: f64 = 1e9;
/// Marks a [`Field`] to the deserializer.
const FIELD: &str = "$field";

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

    fn failed(&self, failure: Failure, node: NodeId) {
        let node = failure.node.unwrap_or(node);
        let path = self.hint(|| self.path(node));
        let message = if path.is_empty() {
            failure.message
        } else {
            format!("{}: {}", suggest::code(&path), failure.message)
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
        let known = self.known(table);
        let misspelt = self.tree.entries(table).iter().any(|entry| {
            let word = entry.key.as_str();
            !known.contains(&word) && suggest::nearest(word, &known) == Some(key)
        });
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

/// Why a value could not be read.
#[derive(Debug)]
pub(crate) struct Failure {
    node: Option<NodeId>,
    message: String,
    remedy: String,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

impl de::Error for Failure {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self {
            node: None,
            message: message.to_string(),
            remedy: "see the reference of the model file".to_owned(),
        }
    }
}

#[derive(Clone, Copy)]
struct NodeDeserializer<'r, 't> {
    reader: &'r Reader<'t>,
    node: NodeId,
}

impl<'t> NodeDeserializer<'_, 't> {
    fn value(&self) -> &'t Value {
        self.reader.tree.value(self.node)
    }

    fn failure(&self, message: String, remedy: impl Into<String>) -> Failure {
        Failure {
            node: Some(self.node),
            message,
            remedy: remedy.into(),
        }
    }

    fn expected(&self, what: &str) -> Failure {
        let found = self.reader.tree.describe(self.node);
        let remedy = match (self.value(), what) {
            (Value::Null, _) => "leave the key out instead".to_owned(),
            (Value::Text(text), "a number" | "a whole number") => number_remedy(text),
            (Value::Text(text), "true or false") if ["true", "false"].contains(&text.as_str()) => {
                format!("remove the quotes: {text}")
            }
            (Value::Table(_), "a number") => {
                "only a plain number can stand here; it cannot be drawn from a distribution"
                    .to_owned()
            }
            (Value::Integer(_) | Value::Float(_) | Value::Bool(_) | Value::Date(_), "text") => {
                "put it in double quotes".to_owned()
            }
            (Value::Table(_), "a list") => "write [ ] around the entries".to_owned(),
            _ => format!("write {what} here"),
        };
        self.failure(format!("expected {what}, found {found}"), remedy)
    }

    fn number(&self) -> Result<f64, Failure> {
        let Some(value) = self.reader.tree.number(self.node) else {
            return Err(self.expected("a number"));
        };
        if !value.is_finite() {
            Err(self.failure(
                format!("{value} is not a finite number"),
                "write a finite number",
            ))
        } else if value.abs() > HUGE {
            Err(self.failure(
                format!("the number {value:e} is beyond 1e9"),
                "lengths are in metres; check the digits",
            ))
        } else {
            Ok(value)
        }
    }

    fn whole(&self, largest: u64) -> Result<u64, Failure> {
        match self.value() {
            Value::Integer(value) => u64::try_from(*value)
                .ok()
                .filter(|value| *value <= largest)
                .ok_or_else(|| {
                    self.failure(
                        format!("{value} is not between 0 and {largest}"),
                        format!("write a whole number from 0 to {largest}"),
                    )
                }),
            Value::Float(value) => Err(self.failure(
                format!("expected a whole number, found {value}"),
                format!("write a whole number from 0 to {largest}, without a decimal point"),
            )),
            _ => Err(self.expected("a whole number")),
        }
    }
}

/// What to do about a text where a number is wanted.
pub(crate) fn number_remedy(text: &str) -> String {
    let digits: String = text
        .trim()
        .chars()
        .take_while(|c| c.is_ascii_digit() || "+-.eE".contains(*c))
        .collect();
    let digits = digits.trim_end_matches(['e', 'E']);
    if digits.parse::<f64>().is_ok() {
        format!("write the number without quotes or unit: {digits} (lengths are in metres)")
    } else {
        "write a number, without quotes".to_owned()
    }
}

impl<'t> Deserializer<'t> for NodeDeserializer<'_, 't> {
    type Error = Failure;

    fn deserialize_any<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        match self.value() {
            Value::Null => Err(self.expected("a value")),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::Integer(_) | Value::Float(_) => visitor.visit_f64(self.number()?),
            Value::Text(text) | Value::Date(text) => visitor.visit_borrowed_str(text),
            Value::List(_) => self.deserialize_seq(visitor),
            Value::Table(_) => self.deserialize_map(visitor),
        }
    }

    fn deserialize_bool<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        match self.value() {
            Value::Bool(value) => visitor.visit_bool(*value),
            _ => Err(self.expected("true or false")),
        }
    }

    fn deserialize_f64<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        visitor.visit_f64(self.number()?)
    }

    fn deserialize_u64<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        visitor.visit_u64(self.whole(u64::MAX)?)
    }

    fn deserialize_u32<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        visitor.visit_u64(self.whole(u64::from(u32::MAX))?)
    }

    fn deserialize_str<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        match self.value() {
            Value::Text(text) => visitor.visit_borrowed_str(text),
            _ => Err(self.expected("text")),
        }
    }

    fn deserialize_string<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'t>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Failure> {
        if name == FIELD {
            visitor.visit_seq(FieldAccess {
                deserializer: self,
                step: 0,
            })
        } else {
            visitor.visit_newtype_struct(self)
        }
    }

    fn deserialize_seq<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        match self.value() {
            Value::List(elements) => visitor.visit_seq(ListAccess {
                reader: self.reader,
                elements: elements.iter(),
            }),
            _ => Err(self.expected("a list")),
        }
    }

    fn deserialize_tuple<V: Visitor<'t>>(
        self,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Failure> {
        let what = format!("a list of {length} numbers");
        match self.value() {
            Value::List(elements) if elements.len() == length => self.deserialize_seq(visitor),
            Value::List(elements) => Err(self.failure(
                format!("expected {what}, found {}", elements.len()),
                format!("write exactly {length} numbers in [ ]"),
            )),
            _ => Err(self.expected(&what)),
        }
    }

    fn deserialize_map<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        match self.value() {
            Value::Table(entries) => visitor.visit_map(TableAccess {
                reader: self.reader,
                entries: entries.iter(),
                fields: None,
                current: None,
            }),
            _ => Err(self.expected("a table")),
        }
    }

    fn deserialize_struct<V: Visitor<'t>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Failure> {
        let Value::Table(entries) = self.value() else {
            return Err(self.expected("a table"));
        };
        self.reader
            .known
            .borrow_mut()
            .entry(self.node)
            .or_default()
            .extend(fields);
        visitor.visit_map(TableAccess {
            reader: self.reader,
            entries: entries.iter(),
            fields: Some(fields),
            current: None,
        })
    }

    fn deserialize_ignored_any<V: Visitor<'t>>(self, visitor: V) -> Result<V::Value, Failure> {
        match self.value() {
            Value::Null => Err(self.expected("a value")),
            _ => visitor.visit_unit(),
        }
    }

    serde::forward_to_deserialize_any! {
        <V: Visitor<'t>>
        i8 i16 i32 i64 i128 u8 u16 u128 f32 char bytes byte_buf unit unit_struct tuple_struct enum identifier
    }
}

/// A node as the two elements that a [`Field`] reads: its number, and its value if that fits.
struct FieldAccess<'r, 't> {
    deserializer: NodeDeserializer<'r, 't>,
    step: usize,
}

impl<'t> SeqAccess<'t> for FieldAccess<'_, 't> {
    type Error = Failure;

    fn next_element_seed<S: DeserializeSeed<'t>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Failure> {
        self.step += 1;
        let NodeDeserializer { reader, node } = self.deserializer;
        if self.step == 1 {
            let number: U64Deserializer<Failure> = (node.0 as u64).into_deserializer();
            return seed.deserialize(number).map(Some);
        }
        match seed.deserialize(self.deserializer) {
            Ok(value) => Ok(Some(value)),
            Err(failure) => {
                reader.failed(failure, node);
                Ok(None)
            }
        }
    }
}

struct ListAccess<'r, 't> {
    reader: &'r Reader<'t>,
    elements: std::slice::Iter<'t, NodeId>,
}

impl<'t> SeqAccess<'t> for ListAccess<'_, 't> {
    type Error = Failure;

    fn next_element_seed<S: DeserializeSeed<'t>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Failure> {
        let Some(&node) = self.elements.next() else {
            return Ok(None);
        };
        let reader = self.reader;
        seed.deserialize(NodeDeserializer { reader, node })
            .map(Some)
    }
}

struct TableAccess<'r, 't> {
    reader: &'r Reader<'t>,
    entries: std::slice::Iter<'t, Entry>,
    /// The keys that the struct has; others are left for whoever closes the table.
    fields: Option<&'static [&'static str]>,
    current: Option<NodeId>,
}

impl<'t> MapAccess<'t> for TableAccess<'_, 't> {
    type Error = Failure;

    fn next_key_seed<S: DeserializeSeed<'t>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Failure> {
        let wanted = |entry: &&Entry| {
            self.fields
                .is_none_or(|fields| fields.contains(&entry.key.as_str()))
        };
        let Some(entry) = self.entries.by_ref().find(wanted) else {
            return Ok(None);
        };
        self.current = Some(entry.node);
        seed.deserialize(BorrowedStrDeserializer::new(&entry.key))
            .map(Some)
    }

    fn next_value_seed<S: DeserializeSeed<'t>>(&mut self, seed: S) -> Result<S::Value, Failure> {
        let Some(node) = self.current.take() else {
            return Err(de::Error::custom("a value was asked for before its key"));
        };
        let reader = self.reader;
        seed.deserialize(NodeDeserializer { reader, node })
    }
}
