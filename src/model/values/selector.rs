//! Selectors: which features a rule speaks of, `removes` or `removed_by`.

use std::borrow::Cow;
use std::cmp::Ordering;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use crate::model::checker::Checker;
use crate::model::draft::{Draft, Family, ids};
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};

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

/// An entry of a selector's list that is no id.
#[derive(Deserialize)]
pub(crate) struct PickFile {
    pub(crate) id: Option<Field<String>>,
    pub(crate) kind: Option<Field<String>>,
    pub(crate) level: Option<Field<u64>>,
    pub(crate) facies: Option<Field<String>>,
}

/// One of the two rules, and the word for its default.
#[derive(Clone, Copy)]
struct Rule {
    key: &'static str,
    default: &'static str,
    other_default: &'static str,
}

const REMOVES: Rule = Rule {
    key: "removes",
    default: "older",
    other_default: "younger",
};
const REMOVED_BY: Rule = Rule {
    key: "removed_by",
    default: "younger",
    other_default: "older",
};

impl Checker<'_> {
    pub(crate) fn removes(
        &mut self,
        draft: &Draft,
        field: Option<&Field<Any>>,
        family: &Family<'_>,
    ) -> Option<Selector> {
        self.selector(field, draft, REMOVES, family)
    }

    pub(crate) fn removed_by(
        &mut self,
        draft: &Draft,
        field: Option<&Field<Any>>,
        family: &Family<'_>,
    ) -> Option<Selector> {
        self.selector(field, draft, REMOVED_BY, family)
    }

    fn selector(
        &mut self,
        field: Option<&Field<Any>>,
        draft: &Draft,
        rule: Rule,
        family: &Family<'_>,
    ) -> Option<Selector> {
        let node = match field {
            None => return Some(Selector::Everything),
            Some(Field::Good(node, Any)) => *node,
            Some(_) => return None,
        };
        match self.reader.tree.value(node) {
            Value::Text(word) if word == rule.default || word == "everything" => {
                Some(Selector::Everything)
            }
            Value::Text(word) if word == "nothing" => Some(Selector::Only(Vec::new())),
            Value::Text(word) => {
                let remedy = if ids(family.drafts).contains(&word.as_str()) {
                    format!("write a list: {} = [{word:?}]", rule.key)
                } else if word == rule.other_default {
                    format!("`{}` can be \"{}\"", rule.key, rule.default)
                } else {
                    format!(
                        "write \"{}\", \"everything\", \"nothing\", or a list of ids",
                        rule.default
                    )
                };
                self.reader.wrong(
                    node,
                    format!("{} has `{}` = {}", draft.name, rule.key, quoted(word)),
                    remedy,
                );
                None
            }
            Value::List(elements) => {
                let picks: Vec<Option<Pick>> = elements
                    .iter()
                    .map(|&element| self.pick(element, rule, family))
                    .collect();
                Some(Selector::Only(picks.into_iter().collect::<Option<_>>()?))
            }
            _ => {
                let found = self.reader.tree.describe(node);
                self.reader.wrong(
                    node,
                    format!(
                        "expected a selector for `{}` of {}, found {found}",
                        rule.key, draft.name
                    ),
                    format!(
                        "write \"{}\", \"nothing\", or a list as [\"some-id\", {{ level = 2 }}]",
                        rule.default
                    ),
                );
                None
            }
        }
    }

    fn pick(&mut self, node: NodeId, rule: Rule, family: &Family<'_>) -> Option<Pick> {
        match self.reader.tree.value(node) {
            Value::Text(id) => self.pick_id(node, id, rule, family),
            Value::Table(_) => self.pick_table(node, rule, family),
            _ => {
                let found = self.reader.tree.describe(node);
                self.reader.wrong(
                    node,
                    format!("expected the id of a feature, found {found}"),
                    "write an id in quotes, or { kind = … }, { level = … }, { facies = … }",
                );
                None
            }
        }
    }

    fn pick_table(&mut self, node: NodeId, rule: Rule, family: &Family<'_>) -> Option<Pick> {
        let before = self.reader.found();
        let file: PickFile = self.reader.table(node)?;
        self.reader.close(node, "this selector");
        (self.reader.found() == before).then_some(())?;
        let id = file.id.and_then(Field::good);
        let kind = file.kind.and_then(Field::good);
        let level = file.level.and_then(Field::good);
        let facies = file.facies.and_then(Field::good);
        match (id, kind, level, facies) {
            (Some((at, id)), None, None, None) => self.pick_id(at, &id, rule, family),
            (None, Some((at, kind)), None, None) => self
                .known_kind(at, &kind, family)
                .then_some(Pick::Kind(kind)),
            (None, None, Some((at, level)), None) => self.level(at, level).map(Pick::Level),
            (None, None, None, Some((at, name))) => self
                .known_facies(at, &name, family.facies)
                .map(|_| Pick::Facies(name)),
            _ => {
                self.reader.wrong(
                    node,
                    "a selector has exactly one of `id`, `kind`, `level`, `facies`",
                    "write one table for each: [{ kind = \"channel\" }, { level = 2 }]",
                );
                None
            }
        }
    }

    fn pick_id(&mut self, node: NodeId, id: &str, rule: Rule, family: &Family<'_>) -> Option<Pick> {
        let key = rule.key;
        if id == "background" {
            if rule.key == REMOVED_BY.key {
                self.note(
                    node,
                    "the background removes nothing, so this has no effect",
                );
            }
            return Some(Pick::Id(id.to_owned()));
        }
        let part = self.part_of(id, family);
        let target = family.index.get(id).copied();
        let Some(target) = target.or(part.as_ref().map(|part| part.0)) else {
            let remedy = self.reader.hint(|| {
                let mut known = ids(family.drafts);
                known.push("background");
                suggest::name(id, &known, "features")
            });
            self.reader.wrong(
                node,
                format!("`{key}` names {}, which is not a feature", quoted(id)),
                remedy,
            );
            return None;
        };
        let (without_effect, age) = if rule.key == REMOVES.key {
            (Ordering::Greater, "younger")
        } else {
            (Ordering::Less, "older")
        };
        if !family.drafts[target].enabled {
            self.note(node, format!("`{key}` names `{id}`, which is disabled"));
        } else if family.age_of(target) == without_effect {
            self.note(
                node,
                format!("`{key}` names `{id}`, which is {age}, so this has no effect"),
            );
        }
        Some(match part {
            Some((feature, part)) => Pick::Part(family.drafts[feature].id().to_owned(), part),
            None => Pick::Id(id.to_owned()),
        })
    }
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
