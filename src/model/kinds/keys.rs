//! The table of one feature while its kind reads it.

use serde::de::Deserialize;

use crate::model::checker::{Checker, Reported};
use crate::model::domain::Domain;
use crate::model::draft::{Draft, Family};
use crate::model::read::{Any, Field};
use crate::model::tree::{NodeId, Value, quoted};
use crate::model::values::bent::{BentProfile, bent_profile};
use crate::model::values::limits::Limits;
use crate::model::values::profile::{Profile, profile};
use crate::model::values::quantity::{Quantity, quantity};

/// The table of one feature, and what its keys may refer to.
pub(crate) struct Keys<'a, 't> {
    pub(crate) checker: &'a mut Checker<'t>,
    pub(crate) draft: &'a Draft,
    pub(crate) family: &'a Family<'a>,
    /// The domain, if that is right.
    pub(crate) domain: Option<&'a Domain>,
}

impl<'t> Keys<'_, 't> {
    /// The keys that a kind has of its own.
    pub(crate) fn table<T: Deserialize<'t>>(&self) -> Option<T> {
        self.checker.reader.table(self.draft.node)
    }

    /// What a key is called in messages.
    pub(crate) fn what(&self, key: &str) -> String {
        format!("the {key} of {}", self.draft.name)
    }

    /// The value of a key that must be there.
    pub(crate) fn need<T>(&self, field: Field<T>, key: &str, example: &str) -> Option<(NodeId, T)> {
        let Draft { node, name, .. } = self.draft;
        self.checker.reader.need(field, *node, name, key, example)
    }

    /// How many features of the same kind, with the same parent or along the same, come before it.
    pub(crate) fn elder_siblings(&self) -> usize {
        let named = |draft: &Draft| {
            let host = draft.along.as_ref().or(draft.parent.as_ref());
            (
                draft.kind.map(|kind| kind.name),
                host.map(|(_, id)| id.clone()),
            )
        };
        let own = named(self.draft);
        let elder = &self.family.drafts[..self.family.own];
        elder.iter().filter(|draft| named(draft) == own).count()
    }

    /// No other feature may have the id of the feature with one of these words behind it: so its volumes are called.
    pub(crate) fn free_names(&self, words: &[&str]) -> Option<()> {
        let id = self.draft.id();
        for word in words {
            let name = format!("{id}-{word}");
            if let Some((node, _)) = self
                .family
                .index
                .get(&name)
                .and_then(|at| self.family.drafts[*at].id.as_ref())
            {
                self.checker.reader.wrong(
                    *node,
                    format!(
                        "the id {} is also the name of a volume of {}",
                        quoted(&name),
                        self.draft.name
                    ),
                    "choose another id",
                );
                return None;
            }
        }
        Some(())
    }

    /// A profile that must be there, with its place.
    pub(crate) fn profile(
        &self,
        field: Field<Any>,
        key: &str,
        example: &str,
        limits: Limits,
    ) -> Option<(NodeId, Profile)> {
        let (node, Any) = self.need(field, key, example)?;
        profile(&self.checker.reader, node, &self.what(key), limits).map(|profile| (node, profile))
    }

    /// The same of one that may be left out.
    pub(crate) fn optional_profile(
        &self,
        field: Option<Field<Any>>,
        key: &str,
        limits: Limits,
    ) -> Result<Option<(NodeId, Profile)>, Reported> {
        optional(field, |field| self.profile(field, key, "", limits))
    }

    /// One that may follow the bends of a trajectory, and may be left out.
    pub(crate) fn optional_bent_profile(
        &self,
        field: Option<Field<Any>>,
        key: &str,
        limits: Limits,
    ) -> Result<Option<BentProfile>, Reported> {
        optional(field, |field| {
            let (node, Any) = self.need(field, key, "")?;
            bent_profile(&self.checker.reader, node, &self.what(key), limits)
        })
    }

    /// A quantity that must be there.
    pub(crate) fn quantity(
        &self,
        field: Field<Any>,
        key: &str,
        example: &str,
        limits: Limits,
    ) -> Option<Quantity> {
        let (node, Any) = self.need(field, key, example)?;
        quantity(&self.checker.reader, node, &self.what(key), limits)
    }

    /// The same of one that may be left out.
    pub(crate) fn optional_quantity(
        &self,
        field: Option<Field<Any>>,
        key: &str,
        limits: Limits,
    ) -> Result<Option<Quantity>, Reported> {
        optional(field, |field| self.quantity(field, key, "", limits))
    }

    /// Names of facies; none if left out.
    pub(crate) fn facies_list(&self, field: Option<Field<Any>>, key: &str) -> Option<Vec<usize>> {
        let Some(field) = field else {
            return Some(Vec::new());
        };
        let (list, Any) = field.good()?;
        let reader = &self.checker.reader;
        let remedy = "write names of facies in [ ], or leave it out";
        let nodes = match reader.tree.value(list) {
            Value::List(nodes) if !nodes.is_empty() => nodes,
            _ => {
                let (what, found) = (self.what(key), reader.tree.describe(list));
                reader.wrong(
                    list,
                    format!("expected a list of facies for {what}, found {found}"),
                    remedy,
                );
                return None;
            }
        };
        let one = |node: &NodeId| {
            if let Value::Text(name) = reader.tree.value(*node) {
                return self.checker.known_facies(*node, name, self.family.facies);
            }
            let found = reader.tree.describe(*node);
            reader.wrong(
                *node,
                format!(
                    "expected the name of a facies in {}, found {found}",
                    self.what(key)
                ),
                remedy,
            );
            None
        };
        // All are looked at, so that one slip hides no other.
        let all: Vec<Option<usize>> = nodes.iter().map(one).collect();
        all.into_iter().collect()
    }

    /// A number within limits, both included.
    pub(crate) fn number_in(
        &self,
        field: Option<Field<f64>>,
        default: f64,
        [least, largest]: [f64; 2],
        what: &str,
    ) -> Option<f64> {
        let Some(field) = field else {
            return Some(default);
        };
        let (node, value) = field.good()?;
        if value >= least && value <= largest {
            return Some(value);
        }
        self.checker.reader.wrong(
            node,
            format!("the {what} is {value}; it must lie between {least} and {largest}"),
            format!("leave it out for the usual {default}"),
        );
        None
    }
}

/// What a key that may be left out holds.
pub(super) fn optional<T>(
    field: Option<Field<Any>>,
    read: impl FnOnce(Field<Any>) -> Option<T>,
) -> Result<Option<T>, Reported> {
    match field {
        None => Ok(None),
        Some(field) => read(field).map(Some).ok_or(Reported),
    }
}
