//! Facies belts of clinoform sets.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::defects::Defect;
use crate::model::kinds::keys::Keys;
use crate::model::read::{Any, Field};
use crate::model::tree::{NodeId, Value, quoted};
use crate::model::values::facies::is_id;
use crate::model::values::limits::{Limits, NOT_NEGATIVE, POSITIVE};
use crate::model::values::quantity::{Quantity, quantity};

/// A facies belt of a clinothem.
#[derive(Clone, Debug, PartialEq)]
pub struct Belt {
    /// Its name, unique in its set.
    pub name: String,
    /// Index of its facies.
    pub facies: usize,
    /// Width along dip; absent in the last belt only.
    pub width: Option<Quantity>,
    /// How far its basinward boundary swings, from peak to peak; absent in the last belt only.
    pub interfingering: Option<Quantity>,
}

/// A facies belt.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Belt")]
pub(crate) struct BeltFile {
    /// Its name: letters, digits, `-` and `_`; unique in the set.
    #[schemars(regex(pattern = "^[A-Za-z0-9_-]+$"))]
    pub(crate) name: Field<String>,
    /// Its facies.
    pub(crate) facies: Field<String>,
    /// Width along dip in metres; every belt but the last has one.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) width: Option<Field<Any>>,
    /// How far its basinward boundary swings, from peak to peak, in metres; 0 if left out. The last belt has no such boundary.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) interfingering: Option<Field<Any>>,
}

impl Keys<'_, '_> {
    pub(crate) fn belts(&self, field: Option<Field<Any>>) -> Option<Vec<Belt>> {
        let Some(field) = field else {
            return Some(Vec::new());
        };
        let (list, Any) = field.good()?;
        let remedy = "write belts = [{ name = \"near\", facies = \"sand\", width = 100 }, { name = \"far\", facies = \"mud\" }], or leave them out";
        match self.checker.reader.tree.value(list) {
            Value::List(nodes) if nodes.is_empty() => {
                self.checker.reader.wrong(
                    list,
                    format!("the belts of {} are empty", self.draft.name),
                    remedy,
                );
                None
            }
            Value::List(nodes) => {
                let mut names: Vec<(NodeId, String)> = Vec::new();
                let belts: Vec<Option<Belt>> = nodes
                    .iter()
                    .enumerate()
                    .map(|(i, &node)| {
                        let last = i + 1 == nodes.len();
                        self.belt(node, last, &mut names)
                    })
                    .collect();
                belts.into_iter().collect()
            }
            _ => {
                let found = self.checker.reader.tree.describe(list);
                self.checker.reader.wrong(
                    list,
                    format!(
                        "expected a list of belts for {}, found {found}",
                        self.draft.name
                    ),
                    remedy,
                );
                None
            }
        }
    }

    fn belt(&self, node: NodeId, last: bool, names: &mut Vec<(NodeId, String)>) -> Option<Belt> {
        let file: BeltFile = self.checker.reader.table(node)?;
        let what = match &file.name {
            Field::Good(_, name) => format!("belt {} of {}", quoted(name), self.draft.name),
            _ => format!("a belt of {}", self.draft.name),
        };
        self.checker.reader.close(node, &what);
        let name = self
            .checker
            .reader
            .need(file.name, node, &what, "name", "name = \"usf\"")
            .and_then(|(at, name)| self.belt_name(at, name, names));
        let facies = self
            .checker
            .reader
            .need(file.facies, node, &what, "facies", "facies = \"sand\"")
            .and_then(|(at, name)| self.checker.known_facies(at, &name, self.family.facies));
        if last {
            for (key, field) in [
                ("width", &file.width),
                ("interfingering", &file.interfingering),
            ] {
                if let Some(Field::Good(at, Any)) = field {
                    self.checker.reader.wrong(
                        *at,
                        format!("{what} is the last one and has a `{key}`"),
                        "leave it out: the last belt reaches to the clinothem's end",
                    );
                }
            }
            return Some(Belt {
                name: name?,
                facies: facies?,
                width: None,
                interfingering: None,
            });
        }
        let of = |key: &str, at: NodeId, limits: Limits| {
            quantity(
                &self.checker.reader,
                at,
                &format!("the {key} of {what}"),
                limits,
            )
        };
        let width = match file.width {
            None => {
                self.checker.reader.missing(
                    node,
                    &what,
                    "width",
                    "width = 100; only the last belt has none",
                );
                None
            }
            Some(field) => field.good().and_then(|(at, Any)| of("width", at, POSITIVE)),
        };
        let interfingering = match file.interfingering {
            None => Some(Quantity::Constant(0.0)),
            Some(field) => field
                .good()
                .and_then(|(at, Any)| of("interfingering", at, NOT_NEGATIVE)),
        };
        Some(Belt {
            name: name?,
            facies: facies?,
            width: Some(width?),
            interfingering: Some(interfingering?),
        })
    }

    /// A name that no belt before it has.
    fn belt_name(
        &self,
        node: NodeId,
        name: String,
        names: &mut Vec<(NodeId, String)>,
    ) -> Option<String> {
        if !is_id(&name) {
            self.checker.reader.wrong(
                node,
                format!("{} is not a name for a belt", quoted(&name)),
                "use letters, digits, `-` and `_`",
            );
            return None;
        }
        if let Some((first, _)) = names.iter().find(|(_, other)| *other == name) {
            let tree = self.checker.reader.tree;
            self.checker.reader.report(
                Defect::new(
                    tree.span(node),
                    format!(
                        "two belts of {} have the name {}",
                        self.draft.name,
                        quoted(&name)
                    ),
                    "give every belt a name of its own; their facies may be the same",
                )
                .with_related(tree.span(*first), "the first one")
                .with_path(self.checker.reader.path(node)),
            );
            return None;
        }
        names.push((node, name.clone()));
        Some(name)
    }
}
