//! Selectors: which features a rule speaks of, `removes` or `removed_by`.

mod read;

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

/// Which features a rule speaks of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selector {
    /// All of them.
    Everything,
    /// What any of the picks admits; none if the list is empty.
    Only(Vec<Pick>),
}

/// One entry of a [`Selector`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Pick {
    /// The feature with this id, or `background`.
    Id(String),
    /// Of a feature that makes many volumes, those whose name begins with its id and this: `-3` of a set of clinoforms.
    Part(String, String),
    /// Every feature of this kind.
    Kind(String),
    /// Every feature of this level.
    Level(u32),
    /// Everything of this facies.
    Facies(String),
}

impl JsonSchema for Selector {
    fn schema_name() -> Cow<'static, str> {
        "Selector".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let words = ["older", "younger", "everything", "nothing"];
        json_schema!({
            "type": ["string", "array"],
            "anyOf": [{ "enum": words }, { "type": "array" }],
            "examples": ["older", "nothing", ["trunk", "background"], [{ "kind": "channel" }, { "level": 2 }]],
            "items": {
                "description": "The id of a feature, of one of a set (\"lower-3\"), or \"background\"; or one of { id = … }, { kind = … }, { level = … }, { facies = … }.",
                "type": ["string", "object"],
                "properties": {
                    "id": { "description": "The feature of this id.", "type": "string" },
                    "kind": { "description": "All features of this kind.", "type": "string" },
                    "level": { "description": "All features of this level.", "type": "integer", "minimum": 1 },
                    "facies": { "description": "All features of this facies.", "type": "string" },
                },
                "additionalProperties": false,
                "minProperties": 1,
                "maxProperties": 1,
            },
        })
    }
}
