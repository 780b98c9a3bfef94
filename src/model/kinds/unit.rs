//! The unit that sheets divide: that of a horizon, or the background; and what bounds it above.

use super::keys::Keys;
use super::made::Bound;
use crate::model::checker::Reported;
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::Field;
use crate::model::suggest;
use crate::model::tree::quoted;

/// The most clinoforms of one set.
pub(super) const MOST_SHEETS: u64 = 500;

/// What all sets of clinoforms are; names, copies and places are each kind's own.
pub(super) const CLINOFORMS: Nature = Nature {
    name: "",
    copies: Copies::One("a set of clinoforms"),
    within: Within::Unit {
        remedy: "clinoforms divide the unit of a horizon: name a feature of kind = \"horizon\"",
    },
    children: Children::None {
        what: "a set of clinoforms",
        instead: "the horizon of its unit",
    },
    taking: Taking::ByKind {
        how: "clinoforms divide their parent and remove nothing",
        remedy: "leave it out",
    },
    volumes: Volumes::Many {
        most: MOST_SHEETS,
        one: "clinothem",
    },
    is_base: false,
    placed_by: "",
    apart: "",
};

/// What a set of sheets divides.
#[derive(Clone, Copy)]
pub(crate) enum Unit {
    /// What there is before any feature.
    Background,
    /// That of a horizon.
    Of(usize),
}

impl Keys<'_, '_> {
    /// The parent, which must be a base; the background if there is none.
    pub(crate) fn unit(&self) -> Option<Unit> {
        let Some((_, name)) = &self.draft.parent else {
            return (!self.draft.wrong_parent()).then_some(Unit::Background);
        };
        let &parent = self.family.index.get(name)?;
        self.family.is_horizon(parent).then_some(Unit::Of(parent))
    }

    /// How many sheets a set has, if that is said; with what to do about a number that is too small or too large.
    pub(crate) fn number_of_sheets(
        &self,
        field: Option<Field<u64>>,
        remedy: impl Fn(u64) -> &'static str,
    ) -> Result<Option<usize>, Reported> {
        let Some(field) = field else { return Ok(None) };
        let (node, sheets) = field.good().ok_or(Reported)?;
        if (1..=MOST_SHEETS).contains(&sheets) {
            return usize::try_from(sheets).map(Some).map_err(|_| Reported);
        }
        self.checker.reader.wrong(
            node,
            format!(
                "the number of sheets of {} is {sheets}; it must lie between 1 and {MOST_SHEETS}",
                self.draft.name
            ),
            remedy(sheets),
        );
        Err(Reported)
    }

    /// What bounds the unit above.
    pub(crate) fn top(
        &mut self,
        field: Option<Field<String>>,
        unit: Option<Unit>,
    ) -> Option<Bound> {
        let Some(field) = field else {
            let next = unit.and_then(|unit| {
                let mut horizons = self.family.horizons().into_iter().map(|(i, _)| i);
                let above = |i: usize| match unit {
                    Unit::Background => true,
                    Unit::Of(unit) => i > unit,
                };
                horizons.find(|&i| above(i) && self.family.drafts[i].enabled)
            });
            return Some(next.map_or(Bound::Domain, Bound::Horizon));
        };
        let (node, name) = field.good()?;
        if name == "domain" {
            return Some(Bound::Domain);
        }
        let Some(&top) = self.family.index.get(&name) else {
            let remedy = self.checker.reader.hint(|| {
                let mut known: Vec<&str> =
                    self.family.horizons().iter().map(|&(_, id)| id).collect();
                known.push("domain");
                suggest::name(&name, &known, "horizons")
            });
            self.checker.reader.wrong(
                node,
                format!(
                    "{} has the top {}, which is not a feature",
                    self.draft.name,
                    quoted(&name)
                ),
                remedy,
            );
            return None;
        };
        if !self.family.is_horizon(top) {
            if let Some(Nature { name: kind, .. }) = self.family.drafts[top].kind {
                self.checker.reader.wrong(
                    node,
                    format!(
                        "{} has the top {}, which is of the kind {kind}",
                        self.draft.name,
                        quoted(&name)
                    ),
                    "name the horizon that bounds the unit above, or \"domain\"",
                );
            }
            return None;
        }
        if let Some(Unit::Of(unit)) = unit
            && top <= unit
        {
            let own = &self.family.drafts[unit].name;
            let relation = if top == unit {
                "its base, too"
            } else {
                "older than its base"
            };
            self.checker.reader.wrong(
                node,
                format!(
                    "{} has the top {}, which is {relation}: the unit is that of {own}",
                    self.draft.name,
                    quoted(&name)
                ),
                "name a horizon that comes after the parent in the list, or \"domain\"",
            );
            return None;
        }
        if !self.family.drafts[top].enabled {
            self.checker
                .note(node, format!("`top` names `{name}`, which is disabled"));
        }
        Some(Bound::Horizon(top))
    }
}
