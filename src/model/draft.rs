//! What is known of the features before their own tables are read.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

use super::checker::Checker;
use super::nature::Nature;
use super::read::{Any, Field};
use super::references::Host;
use super::suggest;
use super::tree::{NodeId, quoted};
use super::values::conform::ConformFile;
use super::values::facies::FaciesList;
use super::values::property::Properties;
use super::values::selector::Selector;

/// The deepest hierarchical level.
pub(crate) const DEEPEST_LEVEL: u32 = 1000;

/// What every feature has, whatever its kind.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FeatureFile {
    /// Its name: letters, digits, `-` and `_`; unique in the model; not `background` or `domain`.
    #[schemars(regex(pattern = "^[A-Za-z0-9_-]+$"))]
    pub(crate) id: Field<String>,
    /// What it is.
    pub(crate) kind: Field<String>,
    /// Id of a feature before it in the list, all of whose keys it has that it does not have itself (but `name` and `enabled`): another one of the same definition, with draws of its own.
    pub(crate) like: Option<Field<String>>,
    /// What it is called where people read, in any alphabet; its id if left out.
    pub(crate) name: Option<Field<String>>,
    /// Whether it takes part; true if left out. False leaves it out with its children, and changes no other feature's draws.
    pub(crate) enabled: Option<Field<bool>>,
    /// How many are made, in each instance of the parent: `channel-1` (the oldest), `channel-2`, …; 1 if left out. All together at most 100 000.
    #[schemars(range(min = 1, max = 10000))]
    pub(crate) count: Option<Field<u64>>,
    /// Hierarchical level, 1 = largest; if left out, one more than the parent's, or 1.
    #[schemars(range(min = 1, max = 1000))]
    pub(crate) level: Option<Field<u64>>,
    /// Id of the feature that it lies in; it is made directly after its parent, so a younger feature also cuts it.
    pub(crate) parent: Option<Field<String>>,
    /// Id of the channel that it goes along, in place of a parent; one is made with each instance of that, directly before it, so that the channel cuts it.
    pub(crate) along: Option<Field<String>>,
    /// The facies of what it bounds.
    pub(crate) facies: Field<String>,
    /// Rock properties of its own volumes, in the place of those of its `facies`; parts with a facies of their own, such as belts and drapes, keep that one's.
    #[schemars(with = "Option<Properties>")]
    pub(crate) properties: Option<Field<Any>>,
    /// A surface that it conforms to, with all that lies in it: { to = "lower-3", depth = 2 }.
    #[schemars(with = "Option<ConformFile>")]
    pub(crate) conform: Option<Field<Any>>,
    /// What it may remove: "older" (the default), "everything", "nothing", or a list of ids, { kind = … }, { level = … }, { facies = … }.
    #[schemars(with = "Option<Selector>")]
    pub(crate) removes: Option<Field<Any>>,
    /// What may remove it: "younger" (the default), "everything", "nothing" or [], or a list as in `removes`.
    #[schemars(with = "Option<Selector>")]
    pub(crate) removed_by: Option<Field<Any>>,
    /// If true, it removes nothing but its parent and the background, so it takes only what no other feature holds; false if left out. Not together with `removes`.
    pub(crate) preserve: Option<Field<bool>>,
}

/// What is known of a feature before the list as a whole is judged.
pub(crate) struct Draft {
    pub(crate) node: NodeId,
    pub(crate) id: Option<(NodeId, String)>,
    pub(crate) name: String,
    pub(crate) enabled: bool,
    pub(crate) kind: Option<Nature>,
    pub(crate) level: Option<(NodeId, u32)>,
    pub(crate) parent: Option<(NodeId, String)>,
    pub(crate) along: Option<(NodeId, String)>,
    pub(crate) count: Option<(Option<NodeId>, u64)>,
    pub(crate) file: FeatureFile,
}

impl Draft {
    /// Its id, or nothing.
    pub(crate) fn id(&self) -> &str {
        self.id.as_ref().map_or("", |(_, id)| id.as_str())
    }

    /// The rules of what it takes that the file gives, with their places.
    pub(crate) fn taking_rules(&self) -> Vec<(&'static str, NodeId)> {
        let removes = match &self.file.removes {
            Some(Field::Good(at, Any)) => Some(("removes", *at)),
            _ => None,
        };
        let preserve = match &self.file.preserve {
            Some(Field::Good(at, _)) => Some(("preserve", *at)),
            _ => None,
        };
        removes.into_iter().chain(preserve).collect()
    }

    /// The keys that only rock has which the file gives, with their places.
    pub(crate) fn keys_of_rock(&self) -> Vec<(&'static str, NodeId)> {
        let facies = match &self.file.facies {
            Field::Good(at, _) => Some(("facies", *at)),
            _ => None,
        };
        let others = [
            ("properties", &self.file.properties),
            ("conform", &self.file.conform),
            ("removed_by", &self.file.removed_by),
        ];
        let others = others.into_iter().filter_map(|(key, field)| match field {
            Some(Field::Good(at, Any)) => Some((key, *at)),
            _ => None,
        });
        facies.into_iter().chain(others).collect()
    }

    /// Whether the file gives a parent that is no name at all.
    pub(crate) fn wrong_parent(&self) -> bool {
        matches!(self.file.parent, Some(Field::Bad))
    }

    /// The same of what it goes along.
    pub(crate) fn wrong_along(&self) -> bool {
        matches!(self.file.along, Some(Field::Bad))
    }
}

/// The other features and the facies, which the rules of one feature name.
pub(crate) struct Family<'f> {
    pub(crate) drafts: &'f [Draft],
    pub(crate) index: &'f BTreeMap<String, usize>,
    /// Which of the drafts is the feature itself.
    pub(crate) own: usize,
    pub(crate) lineages: &'f [Lineage],
    pub(crate) hosts: &'f [Option<Host>],
    pub(crate) facies: &'f FaciesList,
    /// The names of all kinds.
    pub(crate) kinds: &'f [&'static str],
}

/// What a feature has from its parents.
#[derive(Clone, Copy)]
pub(crate) struct Lineage {
    pub(crate) level: u32,
    pub(crate) instances: u64,
    /// The forebear that goes with nothing.
    pub(crate) root: usize,
}

impl<'f> Family<'f> {
    /// The feature that another one goes with.
    pub(crate) fn host(&self, feature: usize) -> Option<usize> {
        self.hosts[feature].map(Host::feature)
    }

    /// How many are made of a feature in each place; one if the file's number is wrong.
    pub(crate) fn count(&self, feature: usize) -> usize {
        let count = self.drafts[feature].count.map_or(1, |(_, count)| count);
        usize::try_from(count).unwrap_or(usize::MAX)
    }

    /// Whether a feature is the base of a unit.
    pub(crate) fn is_horizon(&self, feature: usize) -> bool {
        self.drafts[feature].kind.is_some_and(|kind| kind.is_base)
    }

    /// The horizons that have an id, in order of the list.
    pub(crate) fn horizons(&self) -> Vec<(usize, &'f str)> {
        let drafts = self.drafts.iter().enumerate();
        drafts
            .filter(|(i, _)| self.is_horizon(*i))
            .filter_map(|(i, draft)| draft.id.as_ref().map(|(_, id)| (i, id.as_str())))
            .collect()
    }

    /// Whether all of feature `other` comes before all of the feature itself; `Equal` where that is not so simple, since
    /// the instances of one family follow each other parent by parent.
    pub(crate) fn age_of(&self, other: usize) -> Ordering {
        let [other, own] = [other, self.own].map(|i| self.lineages[i].root);
        other.cmp(&own)
    }
}

pub(crate) fn ids(drafts: &[Draft]) -> Vec<&str> {
    drafts
        .iter()
        .filter_map(|draft| draft.id.as_ref().map(|(_, id)| id.as_str()))
        .collect()
}

impl Checker<'_> {
    /// The kind of that name; where there is none, a defect, and the kind whose name is nearest.
    pub(crate) fn kind_meant(
        &self,
        node: NodeId,
        kind: &str,
        known: &[&'static str],
    ) -> Option<&'static str> {
        let kinds = known;
        let known = kinds.iter().copied().find(|known| *known == kind);
        known.or_else(|| {
            let nearest = suggest::nearest(kind, kinds);
            let remedy = match nearest {
                Some(known) => format!("did you mean \"{known}\"?"),
                None => format!("the kinds are: {}", suggest::list(kinds)),
            };
            self.reader.wrong(
                node,
                format!("there is no kind of feature {}", quoted(kind)),
                remedy,
            );
            nearest
        })
    }

    pub(crate) fn known_kind(&self, node: NodeId, kind: &str, family: &Family<'_>) -> bool {
        self.kind_meant(node, kind, family.kinds) == Some(kind)
    }

    pub(crate) fn level(&self, node: NodeId, level: u64) -> Option<u32> {
        match u32::try_from(level) {
            Ok(level) if (1..=DEEPEST_LEVEL).contains(&level) => Some(level),
            _ => {
                self.reader.wrong(
                    node,
                    format!(
                        "the level is {level}; levels count from 1 (largest) to {DEEPEST_LEVEL}"
                    ),
                    "write 1 for the largest features, 2 for what lies in them, and so on",
                );
                None
            }
        }
    }
}
