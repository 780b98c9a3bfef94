//! Clinoform sets.

use super::family::Family;
use super::feature::Draft;
use super::quantity::{AZIMUTH, CONCAVE, FRACTION, Limits, POSITIVE, quantity};
use super::tuple::Tuple;
use super::{Checker, Reported};
use crate::model::file::ClinoformsFile;
use crate::model::quantity::Quantity;
use crate::model::read::{Any, Field};
use crate::model::spec::{Bound, ClinoformsSpec, Interfingering};
use crate::model::suggest;
use crate::model::tree::quoted;

/// The most clinoforms of one set.
pub(super) const MOST_SHEETS: u64 = 500;
/// Semi-extents of a shoreline along dip and strike, if left out.
const SHORELINE: [f64; 2] = [3000.0, 6000.0];
const EXPONENT: f64 = 2.0;

/// What a set of clinoforms divides.
#[derive(Clone, Copy)]
enum Unit {
    Background,
    /// That of a horizon.
    Of(usize),
}

impl Checker<'_> {
    pub(super) fn clinoforms(
        &mut self,
        draft: &Draft,
        family: &Family<'_>,
    ) -> Option<ClinoformsSpec> {
        let file: ClinoformsFile = self.reader.table(draft.node)?;
        self.only_one(draft, "a set of clinoforms in its unit");
        self.takes_by_its_kind(
            draft,
            "clinoforms divide their parent and remove nothing",
            "leave it out",
        );
        let unit = self.unit(draft, family);
        let top = self.top(file.top, draft, family, unit);
        let need = |field: Field<Any>, key: &str, example: &str, limits: Limits| {
            let (node, Any) = self
                .reader
                .need(field, draft.node, &draft.name, key, example)?;
            quantity(
                &self.reader,
                node,
                &format!("the {key} of {}", draft.name),
                limits,
            )
        };
        let azimuth = need(
            file.azimuth_deg,
            "azimuth_deg",
            "azimuth_deg = 320",
            AZIMUTH,
        );
        let length = need(
            file.length,
            "length",
            "length = { uniform = [150, 900] }",
            POSITIVE,
        );
        let spacing = need(
            file.spacing,
            "spacing",
            "spacing = { uniform = [105, 390] }",
            POSITIVE,
        );
        let first = need(file.first, "first", "first = 55", POSITIVE);
        let shoreline = self.shoreline(file.shoreline, draft);
        let exponent = self.quantity_or_none(file.exponent, draft, "exponent", CONCAVE);
        let toe = self.quantity_or_none(file.toe, draft, "toe", FRACTION);
        let sheets = self.sheets(file.sheets, draft);
        let belts = self.belts(file.belts, draft, family);
        let interfingering = self.interfingering(file.interfingering);
        let turns = self.turns(file.turns, draft);
        unit?;
        Some(ClinoformsSpec {
            top: top?,
            azimuth_deg: azimuth?,
            shoreline: shoreline?,
            length: length?,
            spacing: spacing?,
            first: first?,
            exponent: exponent.ok()?.unwrap_or(Quantity::Constant(EXPONENT)),
            toe: toe.ok()?,
            sheets: sheets.ok()?,
            belts: belts?,
            interfingering: interfingering?,
            turns: turns.ok()?,
        })
    }

    /// The parent, which must be a horizon; the background if there is none.
    fn unit(&self, draft: &Draft, family: &Family<'_>) -> Option<Unit> {
        let Some((at, name)) = &draft.parent else {
            return (!draft.wrong_parent()).then_some(Unit::Background);
        };
        let &parent = family.index.get(name)?;
        if family.is_horizon(parent) {
            return Some(Unit::Of(parent));
        }
        // An unknown kind is a defect of its own.
        if let Some(kind) = family.drafts[parent].kind {
            self.reader.wrong(
                *at,
                format!(
                    "{} has the parent {}, which is of the kind {kind}",
                    draft.name,
                    quoted(name)
                ),
                "clinoforms divide the unit of a horizon: name a feature of kind = \"horizon\"",
            );
        }
        None
    }

    /// What bounds the unit above.
    fn top(
        &mut self,
        field: Option<Field<String>>,
        draft: &Draft,
        family: &Family<'_>,
        unit: Option<Unit>,
    ) -> Option<Bound> {
        let Some(field) = field else {
            let next = unit.and_then(|unit| {
                let mut horizons = family.horizons().into_iter().map(|(i, _)| i);
                let above = |i: usize| match unit {
                    Unit::Background => true,
                    Unit::Of(unit) => i > unit,
                };
                horizons.find(|&i| above(i) && family.drafts[i].enabled)
            });
            return Some(next.map_or(Bound::Domain, Bound::Horizon));
        };
        let (node, name) = field.good()?;
        if name == "domain" {
            return Some(Bound::Domain);
        }
        let Some(&top) = family.index.get(&name) else {
            let remedy = self.reader.hint(|| {
                let mut known: Vec<&str> = family.horizons().iter().map(|&(_, id)| id).collect();
                known.push("domain");
                suggest::name(&name, &known, "horizons")
            });
            self.reader.wrong(
                node,
                format!(
                    "{} has the top {}, which is not a feature",
                    draft.name,
                    quoted(&name)
                ),
                remedy,
            );
            return None;
        };
        if !family.is_horizon(top) {
            if let Some(kind) = family.drafts[top].kind {
                self.reader.wrong(
                    node,
                    format!(
                        "{} has the top {}, which is of the kind {kind}",
                        draft.name,
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
            let own = &family.drafts[unit].name;
            let relation = if top == unit {
                "its base, too"
            } else {
                "older than its base"
            };
            self.reader.wrong(
                node,
                format!(
                    "{} has the top {}, which is {relation}: the unit is that of {own}",
                    draft.name,
                    quoted(&name)
                ),
                "name a horizon that comes after the parent in the list, or \"domain\"",
            );
            return None;
        }
        if !family.drafts[top].enabled {
            self.note(node, format!("`top` names `{name}`, which is disabled"));
        }
        Some(Bound::Horizon(top))
    }

    fn shoreline(&self, field: Option<Field<Any>>, draft: &Draft) -> Option<[Quantity; 2]> {
        let Some(field) = field else {
            return Some(SHORELINE.map(Quantity::Constant));
        };
        let (node, Any) = field.good()?;
        let extents = Tuple {
            what: format!("the shoreline of {}", draft.name),
            names: ["semi-extent along dip", "semi-extent along strike"],
            limits: POSITIVE,
            remedy: "write the ellipse's semi-extents [along dip, along strike], as [3000, 6000]",
        };
        extents.read(&self.reader, node)
    }

    fn turns(
        &self,
        field: Option<Field<Any>>,
        draft: &Draft,
    ) -> Result<Option<[Quantity; 2]>, Reported> {
        let Some(field) = field else { return Ok(None) };
        let (node, Any) = field.good().ok_or(Reported)?;
        let distances = Tuple {
            what: format!("the turns of {}", draft.name),
            names: ["least distance", "greatest distance"],
            limits: POSITIVE,
            remedy: "write the distances between turns [least, greatest], as [60, 120]",
        };
        let read = distances.read(&self.reader, node).ok_or(Reported)?;
        let [least, most] = &read;
        if least.support().1 > most.support().0 {
            self.reader.wrong(
                node,
                format!(
                    "the turns of {} may be at least {} m and at most {} m apart",
                    draft.name,
                    least.support().1,
                    most.support().0
                ),
                "write the distances between turns [least, greatest], as [60, 120]",
            );
            return Err(Reported);
        }
        Ok(Some(read))
    }

    fn quantity_or_none(
        &self,
        field: Option<Field<Any>>,
        draft: &Draft,
        key: &str,
        limits: Limits,
    ) -> Result<Option<Quantity>, Reported> {
        let Some(field) = field else { return Ok(None) };
        let (node, Any) = field.good().ok_or(Reported)?;
        let what = format!("the {key} of {}", draft.name);
        quantity(&self.reader, node, &what, limits)
            .map(Some)
            .ok_or(Reported)
    }

    fn sheets(&self, field: Option<Field<u64>>, draft: &Draft) -> Result<Option<usize>, Reported> {
        let Some(field) = field else { return Ok(None) };
        let (node, sheets) = field.good().ok_or(Reported)?;
        if (1..=MOST_SHEETS).contains(&sheets) {
            return usize::try_from(sheets).map(Some).map_err(|_| Reported);
        }
        let remedy = match sheets {
            0 => "leave it out for as many as have their shoreline in the domain",
            _ => {
                "widen the spacing, or leave it out for as many as have their shoreline in the domain"
            }
        };
        self.reader.wrong(
            node,
            format!(
                "the number of sheets of {} is {sheets}; it must lie between 1 and {MOST_SHEETS}",
                draft.name
            ),
            remedy,
        );
        Err(Reported)
    }

    fn interfingering(&self, field: Option<Field<String>>) -> Option<Interfingering> {
        let Some(field) = field else {
            return Some(Interfingering::Smooth);
        };
        let (node, word) = field.good()?;
        match word.as_str() {
            "smooth" => Some(Interfingering::Smooth),
            "zigzag" => Some(Interfingering::Zigzag),
            _ => {
                self.reader.wrong(
                    node,
                    format!("there is no interfingering {}", quoted(&word)),
                    "write \"smooth\" or \"zigzag\"; how far it swings is a key of each belt",
                );
                None
            }
        }
    }
}
