//! The clinothems of a set, and their belts, as volumes.

use super::{Listing, impossible_domain};
use crate::features::body::Body;
use crate::features::horizon::Horizon;
use crate::features::side::Side;
use crate::model::draws::strata::{DrawnSide, Unit};
use crate::model::draws::{self, strata};
use crate::model::realisation::{RealisationError, draw_whole};
use crate::model::rules::BACKGROUND;
use crate::model::selection::Selection;
use crate::model::spec::{Belt, Bound, ClinoformsSpec, Feature, FeatureKind};

impl Listing<'_> {
    /// The horizon that bounds the domain: its own, or the block's.
    pub(super) fn domain_bound(&self, top: bool) -> Result<Horizon, RealisationError> {
        let at = usize::from(top);
        match &self.bounds[at] {
            Some(horizon) => Ok(horizon.clone()),
            None => {
                Horizon::flat(self.model.domain.z[at]).map_err(|error| impossible_domain(&error))
            }
        }
    }

    /// The horizons that bound the unit which a set divides.
    fn unit(
        &mut self,
        feature: &Feature,
        spec: &ClinoformsSpec,
        parent: Option<usize>,
    ) -> Result<[Horizon; 2], RealisationError> {
        let base = match parent {
            Some(unit) => self.horizons.get(&unit).map(|drawn| drawn.0.clone()),
            None => Some(self.domain_bound(false)?),
        };
        let top = match self.top(feature, spec) {
            Bound::Horizon(unit) => self.horizons.get(&unit).map(|drawn| drawn.0.clone()),
            Bound::Domain => Some(self.domain_bound(true)?),
        };
        match (base, top) {
            (Some(base), Some(top)) => Ok([base, top]),
            _ => Err(RealisationError::Impossible {
                volume: feature.id.clone(),
                reason: "its base or its top is no horizon".to_owned(),
            }),
        }
    }

    /// What bounds a set's unit above: its top, or, if that takes no part, the next horizon that does, or the domain's top.
    /// So it is for a set without a `top` of its own, too.
    fn top(&mut self, feature: &Feature, spec: &ClinoformsSpec) -> Bound {
        let Bound::Horizon(own) = spec.top else {
            return Bound::Domain;
        };
        let features = &self.model.features;
        let stands = |at: &usize| {
            let horizon = &features[*at];
            matches!(horizon.kind, FeatureKind::Horizon(_)) && self.selection.keeps_feature(horizon)
        };
        let top = (own..features.len()).find(stands);
        if top != Some(own) {
            let above = top.map_or("the domain's top", |top| features[top].id.as_str());
            self.decisions.push(format!(
                "{} reaches up to {above}: {}, its top, takes no part",
                feature.id, features[own].id
            ));
        }
        top.map_or(Bound::Domain, Bound::Horizon)
    }

    /// Lists the clinothems of a set, and their belts: all sheets first, then the belts of each clinothem.
    pub(super) fn clinoforms(
        &mut self,
        index: usize,
        spec: &ClinoformsSpec,
        parent: Option<(usize, usize)>,
        path: &str,
    ) -> Result<(), RealisationError> {
        let feature = &self.model.features[index];
        let [base, top] = self.unit(feature, spec, parent.map(|parent| parent.0))?;
        let domain = &self.model.domain;
        self.sets += 1;
        // Landwards: of a toe that touched a wall nothing is left beyond it, where the sheet would be flatter than numbers tell.
        // The oldest set moves farthest: each younger one lies basinward of where it would lie by the one before.
        let is_set = |feature: &&Feature| matches!(feature.kind, FeatureKind::Clinoforms(_));
        let sets = self.model.features.iter().filter(is_set).count();
        let nudge = (f64::from(self.sets) - sets as f64 - 1.0) * self.step;
        let draw =
            |key: draws::Key<'_>| strata::clinoforms(spec, domain, [&base, &top], nudge, key);
        let (set, reasons) = draw_whole(self.model, &feature.id, "1", draw)?;
        let rejected = reasons.into_iter().map(|reason| (Some(index), reason));
        self.rejected.extend(rejected);
        let id = &feature.id;
        match &set.unit {
            Unit::Through => {}
            Unit::Nowhere(place) => self.decisions.push(format!(
                "{id} has no clinoforms: its unit is nowhere in the domain, since its top is too low; {place}"
            )),
        }
        let names = Names {
            start: format!("{path}{}-", feature.id),
            belts: &spec.belts,
            selection: self.selection,
        };
        names.check(&feature.id, set.sheets.len())?;
        let parts = Parts {
            feature: index,
            spec,
            parent: parent.map(|parent| parent.1),
        };
        let firsts = self.firsts(&parts, &names, set.sheets);
        for (clinothem, (first, boundaries)) in firsts.into_iter().zip(set.boundaries).enumerate() {
            let Some(mut from) = first else { continue };
            for (at, boundary) in boundaries.into_iter().enumerate() {
                let name = names.volume(clinothem, at + 1);
                if self.selection.keeps_volume(&name) {
                    from = self.part(&parts, name, at + 1, from, boundary);
                }
            }
        }
        Ok(())
    }

    /// Lists the first volume of each clinothem that takes part. What does not leaves its place to what it would divide.
    fn firsts(
        &mut self,
        parts: &Parts<'_>,
        names: &Names<'_>,
        sheets: Vec<DrawnSide>,
    ) -> Vec<Option<usize>> {
        let unit = parts.parent.unwrap_or(BACKGROUND);
        let mut firsts = Vec::with_capacity(sheets.len() + 1);
        let mut from = unit;
        let oldest = if parts.spec.belts.is_empty() {
            // Below the first sheet it stays the unit's.
            firsts.push(Some(unit));
            None
        } else {
            Some(DrawnSide {
                side: Side::Everywhere.into(),
                drawn: Vec::new(),
            })
        };
        for side in oldest.into_iter().chain(sheets) {
            let clinothem = firsts.len();
            let first = names.keeps(clinothem).then(|| {
                let name = names.volume(clinothem, 0);
                self.part(parts, name, 0, from, side)
            });
            from = first.unwrap_or(from);
            firsts.push(first);
        }
        firsts
    }

    /// Lists a clinothem, or a belt of one, by what it takes from.
    fn part(
        &mut self,
        parts: &Parts<'_>,
        name: String,
        belt: usize,
        from: usize,
        DrawnSide { side, drawn }: DrawnSide,
    ) -> usize {
        let model = self.model;
        let mut rules = self.rules_of(&model.features[parts.feature], &name, parts.parent);
        rules.from = Some(from);
        if let Some(belt) = parts.spec.belts.get(belt) {
            rules.facies.clone_from(&model.facies[belt.facies].name);
        }
        let ready = Some((Body::Side(side), drawn));
        self.push(rules, parts.feature, "", name, ready)
    }
}

/// What the volumes of a set have in common.
struct Parts<'a> {
    feature: usize,
    spec: &'a ClinoformsSpec,
    /// The unit's volume.
    parent: Option<usize>,
}

/// The names of a set's volumes, and which of them take part.
struct Names<'a> {
    /// What stands before a clinothem's number.
    start: String,
    belts: &'a [Belt],
    selection: &'a Selection,
}

impl Names<'_> {
    fn clinothem(&self, number: usize) -> String {
        format!("{}{number}", self.start)
    }

    /// The name of a belt's volume, or of a clinothem without belts.
    fn volume(&self, clinothem: usize, belt: usize) -> String {
        let clinothem = self.clinothem(clinothem);
        match self.belts.get(belt) {
            None => clinothem,
            Some(belt) => format!("{clinothem}/{}", belt.name),
        }
    }

    /// Whether a clinothem takes part.
    fn keeps(&self, clinothem: usize) -> bool {
        self.selection.keeps_volume(&self.clinothem(clinothem))
    }

    /// Of what is to be left out, nothing may be of a clinothem that was not drawn.
    fn check(&self, id: &str, sheets: usize) -> Result<(), RealisationError> {
        let number = |name: &str| {
            let rest = name.strip_prefix(&self.start)?;
            rest.split('/').next()?.parse::<usize>().ok()
        };
        let missing = |name: &&String| number(name).is_some_and(|number| number > sheets);
        match self.selection.without.iter().find(missing) {
            None => Ok(()),
            Some(name) => Err(RealisationError::Impossible {
                volume: id.to_owned(),
                reason: format!(
                    "there is no `{name}` to leave out: with this seed its last clinothem is `{}`",
                    self.clinothem(sheets)
                ),
            }),
        }
    }
}
