//! Selectors read from a feature's table: what they name must be there.

use std::cmp::Ordering;

use serde::Deserialize;

use super::{Pick, Selector};
use crate::model::checker::Checker;
use crate::model::draft::{Draft, Family, ids};
use crate::model::read::{Any, Field};
use crate::model::refer::part_of;
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};

/// An entry of a selector's list that is no id.
#[derive(Deserialize)]
struct PickFile {
    id: Option<Field<String>>,
    kind: Option<Field<String>>,
    level: Option<Field<u64>>,
    facies: Option<Field<String>>,
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
                    format!(
                        "expected the id of a feature in `{}`, found {found}",
                        rule.key
                    ),
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
        let part = part_of(id, family);
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
