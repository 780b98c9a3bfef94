//! A serde deserializer over the nodes of a tree, with messages for people.
//!
//! It judges what no struct can: that numbers are finite and not absurd, that lists have the right length, that nothing is
//! null. A [`Field`](super::read::Field) is given its node's number besides its value, and an error inside it is reported
//! and left behind.

use std::fmt;

use serde::de::value::{BorrowedStrDeserializer, U64Deserializer};
use serde::de::{
    self, DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor,
};

use super::read::Reader;
use super::tree::{Entry, NodeId, Value};

/// No length, elevation or ratio in a model of the Earth is larger.
const HUGE: f64 = 1e9;
/// Marks a field to the deserializer.
pub(super) const FIELD: &str = "$field";

/// Why a value could not be read.
#[derive(Debug)]
pub(super) struct Failure {
    pub(super) node: Option<NodeId>,
    pub(super) message: String,
    pub(super) remedy: String,
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
pub(super) struct NodeDeserializer<'r, 't> {
    pub(super) reader: &'r Reader<'t>,
    pub(super) node: NodeId,
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
            (Value::Text(text), "a number" | "a whole number") => number_remedy(text, LENGTHS),
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

/// The unit of most numbers.
pub(crate) const LENGTHS: &str = "lengths are in metres";

/// What to do about a text where a number is wanted; `unit` says in what it is written.
pub(crate) fn number_remedy(text: &str, unit: &str) -> String {
    let digits: String = text
        .trim()
        .chars()
        .take_while(|c| c.is_ascii_digit() || "+-.eE".contains(*c))
        .collect();
    let digits = digits.trim_end_matches(['e', 'E']);
    if digits.parse::<f64>().is_ok() {
        format!("write the number without quotes or unit: {digits} ({unit})")
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
        self.reader.ask(self.node, fields);
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
