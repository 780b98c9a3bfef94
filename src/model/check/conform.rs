//! What features conform to.

use crate::model::checker::{Checker, Reported};
use crate::model::draft::{Draft, Family};
use crate::model::kinds;
use crate::model::nature::Gives;
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::suggest;
use crate::model::tree::NodeId;
use crate::model::values::conform::{ConformFile, ConformSpec};
use crate::model::values::limits::ANY;
use crate::model::values::quantity::{Quantity, quantity};

impl Checker<'_> {
    /// What a feature conforms to, which may be left out.
    pub(super) fn conform(
        &self,
        draft: &Draft,
        family: &Family<'_>,
    ) -> Result<Option<ConformSpec>, Reported> {
        let node = match &draft.file.conform {
            None => return Ok(None),
            Some(Field::Good(node, Any)) => *node,
            Some(_) => return Err(Reported),
        };
        let read = || {
            let what = format!("the conform of {}", draft.name);
            self.may_conform(node, draft, family)?;
            let file: ConformFile = self.reader.table(node)?;
            self.reader.close(node, &what);
            let to = self
                .reader
                .need(file.to, node, &what, "to", "to = \"lower-3\"")
                .and_then(|(at, text)| {
                    let to = self.refer(at, &text, &what, Gives::Sheets, family)?;
                    self.is_one_sheet(at, &text, &to, &what, family)?;
                    Some((to, text))
                });
            let number = |field: Option<Field<Any>>, key: &str| match field {
                None => Ok(None),
                Some(field) => {
                    let given = field.good();
                    let what = format!("the {key} of {what}");
                    given
                        .and_then(|(at, Any)| quantity(&self.reader, at, &what, ANY))
                        .map(Some)
                        .ok_or(Reported)
                }
            };
            let depth = number(file.depth, "depth");
            let reference = number(file.reference, "reference");
            let tolerance = match file.tolerance.map(Field::good) {
                None => Some(None),
                Some(Some((at, tolerance))) => {
                    if !(tolerance > 0.0) {
                        self.reader.wrong(
                            at,
                            format!("the tolerance of {what} is {tolerance}; it must be above 0"),
                            "write how far the body may be from where it should be, in metres, as 0.02",
                        );
                    }
                    (tolerance > 0.0).then_some(Some(tolerance))
                }
                Some(None) => None,
            };
            let (to, name) = to?;
            Some(ConformSpec {
                to,
                name,
                depth: depth.ok()?.unwrap_or(Quantity::Constant(0.0)),
                reference: reference.ok()?,
                tolerance: tolerance?,
            })
        };
        read().map(Some).ok_or(Reported)
    }

    /// Of a set, one sheet must be named.
    fn is_one_sheet(
        &self,
        node: NodeId,
        text: &str,
        to: &Reference,
        what: &str,
        family: &Family<'_>,
    ) -> Option<()> {
        let is_many = family.drafts[to.feature].kind?.is_many();
        if !is_many || !to.part.is_empty() {
            return Some(());
        }
        self.reader.wrong(
            node,
            format!("{what} names \"{text}\", which has many sheets"),
            format!("name one of them, as \"{text}-3\""),
        );
        None
    }

    /// Only bodies conform that do not do so with what they lie in.
    fn may_conform(&self, node: NodeId, draft: &Draft, family: &Family<'_>) -> Option<()> {
        let kind = draft.kind?.name;
        if !kinds::named(kind)?.conforms {
            self.reader.wrong(
                node,
                format!("{} has `conform`, but it is of the kind {kind}", draft.name),
                format!(
                    "what conforms is of the kinds {}; what lies in it does so with it",
                    suggest::list(&kinds::conforming())
                ),
            );
            return None;
        }
        let mut at = family.host(family.own);
        while let Some(host) = at {
            let host_draft = &family.drafts[host];
            if host_draft.file.conform.is_some() {
                self.reader.wrong(
                    node,
                    format!(
                        "{} has `conform`, and so has {}, with which it conforms already",
                        draft.name, host_draft.name
                    ),
                    "leave one of them out",
                );
                return None;
            }
            at = family.host(host);
        }
        Some(())
    }
}
