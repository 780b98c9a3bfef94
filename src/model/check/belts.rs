//! Facies belts of clinoform sets.

use super::Checker;
use super::facies::is_id;
use super::family::Family;
use super::feature::Draft;
use super::quantity::{Limits, NOT_NEGATIVE, POSITIVE, quantity};
use crate::model::defects::Defect;
use crate::model::file::BeltFile;
use crate::model::quantity::Quantity;
use crate::model::read::{Any, Field};
use crate::model::spec::Belt;
use crate::model::tree::{NodeId, Value, quoted};

impl Checker<'_> {
    pub(super) fn belts(
        &self,
        field: Option<Field<Any>>,
        draft: &Draft,
        family: &Family<'_>,
    ) -> Option<Vec<Belt>> {
        let Some(field) = field else {
            return Some(Vec::new());
        };
        let (list, Any) = field.good()?;
        let remedy = "write belts = [{ name = \"near\", facies = \"sand\", width = 100 }, { name = \"far\", facies = \"mud\" }], or leave them out";
        match self.reader.tree.value(list) {
            Value::List(nodes) if nodes.is_empty() => {
                self.reader.wrong(
                    list,
                    format!("the belts of {} are empty", draft.name),
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
                        self.belt(node, last, draft, family, &mut names)
                    })
                    .collect();
                belts.into_iter().collect()
            }
            _ => {
                let found = self.reader.tree.describe(list);
                self.reader.wrong(
                    list,
                    format!("expected a list of belts for {}, found {found}", draft.name),
                    remedy,
                );
                None
            }
        }
    }

    fn belt(
        &self,
        node: NodeId,
        last: bool,
        draft: &Draft,
        family: &Family<'_>,
        names: &mut Vec<(NodeId, String)>,
    ) -> Option<Belt> {
        let file: BeltFile = self.reader.table(node)?;
        let what = match &file.name {
            Field::Good(_, name) => format!("belt {} of {}", quoted(name), draft.name),
            _ => format!("a belt of {}", draft.name),
        };
        self.reader.close(node, &what);
        let name = self
            .reader
            .need(file.name, node, &what, "name", "name = \"usf\"")
            .and_then(|(at, name)| self.belt_name(at, name, draft, names));
        let facies = self
            .reader
            .need(file.facies, node, &what, "facies", "facies = \"sand\"")
            .and_then(|(at, name)| self.known_facies(at, &name, family.facies));
        if last {
            for (key, field) in [
                ("width", &file.width),
                ("interfingering", &file.interfingering),
            ] {
                if let Some(Field::Good(at, Any)) = field {
                    self.reader.wrong(
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
            quantity(&self.reader, at, &format!("the {key} of {what}"), limits)
        };
        let width = match file.width {
            None => {
                self.reader.missing(
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
        draft: &Draft,
        names: &mut Vec<(NodeId, String)>,
    ) -> Option<String> {
        if !is_id(&name) {
            self.reader.wrong(
                node,
                format!("{} is not a name for a belt", quoted(&name)),
                "use letters, digits, `-` and `_`",
            );
            return None;
        }
        if let Some((first, _)) = names.iter().find(|(_, other)| *other == name) {
            let tree = self.reader.tree;
            self.reader.report(
                Defect::new(
                    tree.span(node),
                    format!(
                        "two belts of {} have the name {}",
                        draft.name,
                        quoted(&name)
                    ),
                    "give every belt a name of its own; their facies may be the same",
                )
                .with_related(tree.span(*first), "the first one")
                .with_path(self.reader.path(node)),
            );
            return None;
        }
        names.push((node, name.clone()));
        Some(name)
    }
}
