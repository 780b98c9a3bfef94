//! The unit that sheets divide: that of a horizon, or the background; and what bounds it above.

use super::keys::Keys;
use super::made::Bound;
use crate::model::nature::Nature;
use crate::model::read::Field;
use crate::model::suggest;
use crate::model::tree::quoted;

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
