//! Banks of a channel: which of them, looking along it.

use schemars::{Schema, SchemaGenerator, json_schema};

use crate::features::levee::Bank;
use crate::model::checker::{Checker, Reported};
use crate::model::read::Field;
use crate::model::tree::quoted;

/// A bank of a channel, looking along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left one.
    Left,
    /// The right one.
    Right,
}

impl Side {
    /// Both, from the left.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// The bank.
    pub(crate) fn bank(self) -> Bank {
        match self {
            Self::Left => Bank::Left,
            Self::Right => Bank::Right,
        }
    }

    /// What it is called in the model file and in names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

pub(crate) fn side_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["left", "right"] })
}

pub(crate) fn sides_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["both", "left", "right"] })
}

impl Checker<'_> {
    /// One bank, or none if that is left out.
    pub(crate) fn side(&self, field: Option<Field<String>>) -> Result<Option<Side>, Reported> {
        let Some(field) = field else {
            return Ok(None);
        };
        let (node, word) = field.good().ok_or(Reported)?;
        let found = Side::BOTH.into_iter().find(|side| side.name() == word);
        found.map(Some).ok_or_else(|| {
            self.reader.wrong(
                node,
                format!("a channel has no bank {}", quoted(&word)),
                "write \"left\" or \"right\", looking along the channel",
            );
            Reported
        })
    }

    /// One bank or both; both if that is left out.
    pub(crate) fn sides(&self, field: Option<Field<String>>) -> Option<Vec<Side>> {
        let Some(field) = field else {
            return Some(Side::BOTH.to_vec());
        };
        let (node, word) = field.good()?;
        match word.as_str() {
            "both" => Some(Side::BOTH.to_vec()),
            "left" => Some(vec![Side::Left]),
            "right" => Some(vec![Side::Right]),
            _ => {
                self.reader.wrong(
                    node,
                    format!("a channel has no bank {}", quoted(&word)),
                    "write \"both\", \"left\" or \"right\", looking along the channel",
                );
                None
            }
        }
    }
}
