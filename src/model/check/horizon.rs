//! Horizons.

use super::Checker;
use super::family::Family;
use super::feature::Draft;
use super::surface::Extent;
use crate::model::file::HorizonFile;
use crate::model::read::{Any, Field};
use crate::model::spec::{Domain, HorizonSpec};
use crate::model::tree::{NodeId, quoted};

impl Checker<'_> {
    pub(super) fn horizon(
        &mut self,
        draft: &Draft,
        family: &Family<'_>,
        domain: Option<&Domain>,
    ) -> Option<HorizonSpec> {
        let file: HorizonFile = self.reader.table(draft.node)?;
        if let Some((at, parent)) = &draft.parent {
            self.reader.wrong(
                *at,
                format!(
                    "{} has the parent {}, but a horizon runs through the whole domain",
                    draft.name,
                    quoted(parent)
                ),
                "leave `parent` out; to take from the open unit alone write relation = \"onlapping\"",
            );
        }
        self.only_one(draft, "a horizon");
        self.takes_by_its_kind(
            draft,
            "a horizon takes what lies above it",
            "leave it out; to spare what is older write relation = \"onlapping\"",
        );
        let surface = self
            .reader
            .need(
                file.surface,
                draft.node,
                &draft.name,
                "surface",
                "surface = { level = -20 }",
            )
            .and_then(|(node, Any)| {
                let what = format!("the surface of {}", draft.name);
                self.surface(node, &what, Extent::from(domain), Some(family))
            });
        let onlapping = match file.relation.map(Field::good) {
            None => Some(false),
            Some(word) => word.and_then(|(node, word)| self.relation(node, &word)),
        };
        Some(HorizonSpec {
            surface: surface?,
            onlapping: onlapping?,
        })
    }

    /// Whether it is onlapping.
    fn relation(&self, node: NodeId, word: &str) -> Option<bool> {
        match word {
            "erosive" => Some(false),
            "onlapping" => Some(true),
            _ => {
                self.reader.wrong(
                    node,
                    format!("there is no relation {}", quoted(word)),
                    "write \"erosive\" or \"onlapping\"",
                );
                None
            }
        }
    }

    /// What divides has no copies: reports a `count`.
    pub(super) fn only_one(&self, draft: &Draft, what: &str) {
        if let Some((Some(at), count)) = draft.count
            && count != 1
        {
            self.reader.wrong(
                at,
                format!(
                    "the count of {} is {count}, but there is only one of {what}",
                    draft.name
                ),
                "leave `count` out, and write a feature for each",
            );
        }
    }

    /// Reports rules that the kind itself decides.
    pub(super) fn takes_by_its_kind(&self, draft: &Draft, what: &str, remedy: &str) {
        for (key, node) in draft.taking_rules() {
            self.reader.wrong(
                node,
                format!("{} has `{key}`, but {what}", draft.name),
                remedy,
            );
        }
    }
}
