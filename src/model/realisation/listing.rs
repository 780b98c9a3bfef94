//! The list of instances, in order of evaluation; and the surfaces through the whole domain, which are decided together
//! before anything is made.

mod coincidence;
mod rock;
pub(super) mod volumes;

use std::collections::BTreeMap;

use super::{RealisationError, draw_whole};
use crate::features::extent::Extent;
use crate::features::horizon::Horizon;
use crate::model::draws::Key;
use crate::model::kinds::made::Bound;
use crate::model::nature::Copies;
use crate::model::selection::Selection;
use crate::model::spec::{Feature, Model};
use crate::model::values::surface::{self, HorizonSurface};
use coincidence::Strata;

/// An instance that is to be made.
pub(super) struct Due {
    pub(super) feature: usize,
    /// Its name, with those of its ancestors.
    pub(super) name: String,
    /// Numbers of the instance and its ancestors, outermost first: the key of its draws.
    pub(super) number: String,
    /// The parent's place in the list.
    pub(super) parent: Option<usize>,
    /// How many ancestors it has.
    pub(super) depth: usize,
    /// What bounds its unit above, if it asked for that.
    pub(super) top: Option<Horizon>,
    /// How far it moves so that contacts which coincide are decided by age (m).
    pub(super) nudge: f64,
}

/// Lists the instances in order of evaluation; before that, all surfaces through the whole domain are drawn and decided.
pub(super) struct Listing<'a> {
    model: &'a Model,
    selection: &'a Selection,
    pub(super) due: Vec<Due>,
    /// The horizons by feature, of those features that are one, whether or not they take part.
    horizons: BTreeMap<usize, DrawnHorizon>,
    /// By feature: the horizon that lies nowhere below this other one.
    above: BTreeMap<usize, usize>,
    /// The domain's own base and top.
    bounds: [Option<Horizon>; 2],
    /// What was drawn for them.
    pub(super) drawn: Vec<(String, f64)>,
    /// By how much contacts that coincide are moved apart for each step in age (m).
    step: f64,
    /// Of level horizons that were moved: from where, and to where (m).
    pub(super) levels: Vec<[f64; 2]>,
    /// By kind: instances so far, and features in all.
    kinds: BTreeMap<&'static str, [u32; 2]>,
    /// Draws that were rejected, by feature; those of the domain have none.
    pub(super) rejected: Vec<(Option<usize>, &'static str)>,
    /// What was decided, in words for the report.
    pub(super) decisions: Vec<String>,
}

type DrawnHorizon = (Horizon, Vec<(String, f64)>);

impl<'a> Listing<'a> {
    pub(super) fn new(
        model: &'a Model,
        selection: &'a Selection,
        step: f64,
    ) -> Result<Self, RealisationError> {
        let mut list = Self {
            rejected: Vec::new(),
            decisions: Vec::new(),
            model,
            selection,
            due: Vec::new(),
            horizons: BTreeMap::new(),
            above: BTreeMap::new(),
            bounds: [None, None],
            drawn: Vec::new(),
            step,
            kinds: BTreeMap::new(),
            levels: Vec::new(),
        };
        for feature in &model.features {
            list.kinds.entry(feature.kind.name()).or_default()[1] += 1;
        }
        list.bounds = [
            list.bound("base", model.domain.base.as_ref())?,
            list.bound("top", model.domain.top.as_ref())?,
        ];
        list.strata()?;
        if step > 0.0 {
            list.move_horizons_apart();
        }
        Ok(list)
    }

    /// Lowers each horizon by a step for every older one, and the domain's top most. Level bounds of the domain are given by
    /// numbers, and stay; so everything else is stretched from the middle of the domain, by so much that what lies on its top
    /// ends above it, and what lies on its base below.
    fn move_horizons_apart(&mut self) {
        let [low, high] = self.model.domain.z;
        let steps = self.horizons.len() + 1;
        let (middle, reach) = (0.5 * (low + high), steps as f64 * self.step);
        let stretch = reach / (0.5 * (high - low));
        let moved = |horizon: &Horizon, age: usize| {
            horizon
                .stretched(middle, stretch)
                .lowered(age as f64 * self.step)
        };
        for (age, (horizon, _)) in self.horizons.values_mut().enumerate() {
            let apart = moved(horizon, age + 1);
            if let (Some(from), Some(to)) = (horizon.level(), apart.level()) {
                self.levels.push([from, to]);
            }
            *horizon = apart;
        }
        for (bound, age) in self.bounds.iter_mut().zip([0, steps]) {
            if let Some(bound) = bound.as_mut().filter(|bound| bound.level().is_none()) {
                *bound = moved(bound, age);
            }
        }
    }

    /// Draws all horizons; where they coincide over an area it is decided what that means.
    fn strata(&mut self) -> Result<(), RealisationError> {
        let mut drawn = BTreeMap::new();
        let mut parameters = Vec::new();
        for (index, feature) in self.model.features.iter().enumerate() {
            if let Some(base) = feature.kind.base() {
                let draw = |key: Key<'_>| surface::horizon(base.surface, key);
                let ((horizon, own), reasons) = draw_whole(self.model, &feature.id, "1", draw)?;
                let rejected = reasons.into_iter().map(|reason| (Some(index), reason));
                self.rejected.extend(rejected);
                drawn.insert(index, horizon);
                parameters.push(own);
            }
        }
        let bounds = [self.domain_bound(false)?, self.domain_bound(true)?];
        let strata = Strata::of(self.model, self.selection, drawn, &bounds)?;
        self.decisions.extend(strata.decisions);
        self.above = strata.above;
        for ((index, horizon), own) in strata.horizons.into_iter().zip(parameters) {
            self.horizons.insert(index, (horizon, own));
        }
        Ok(())
    }

    /// Draws the domain's own base or top.
    fn bound(
        &mut self,
        which: &str,
        surface: Option<&HorizonSurface>,
    ) -> Result<Option<Horizon>, RealisationError> {
        let Some(surface) = surface else {
            return Ok(None);
        };
        let draw = |key: Key<'_>| surface::horizon(surface, key);
        let ((horizon, drawn), reasons) = draw_whole(self.model, "domain", which, draw)?;
        let rejected = reasons.into_iter().map(|reason| (None, reason));
        self.rejected.extend(rejected);
        // `surface.level` of a horizon is `base.level` here, as in the model file.
        let named = drawn.into_iter().map(|(parameter, value)| {
            let own = parameter.trim_start_matches("surface.");
            (format!("{which}.{own}"), value)
        });
        self.drawn.extend(named);
        Ok(Some(horizon))
    }

    /// Lists the instances of all features with this parent (feature, place in the list): depth first, children directly after
    /// their parent.
    pub(super) fn instances(
        &mut self,
        parent: Option<(usize, usize)>,
        path: &str,
        numbers: &str,
    ) -> Result<(), RealisationError> {
        let model = self.model;
        for (index, feature) in model.features.iter().enumerate() {
            if feature.parent != parent.map(|parent| parent.0)
                || !self.selection.keeps_feature(feature)
            {
                continue;
            }
            let nature = feature.kind.nature();
            for number in 1..=feature.count {
                let own = if feature.count == 1 {
                    feature.id.clone()
                } else {
                    format!("{}-{number}", feature.id)
                };
                let name = format!("{path}{own}");
                if !self.selection.keeps_volume(&name) {
                    continue;
                }
                // Of what there is only one, the draws are the same wherever it lies.
                let key = match nature.copies {
                    Copies::One(_) => number.to_string(),
                    Copies::Any | Copies::OneEach(_) => format!("{numbers}{number}"),
                };
                let top = feature.kind.top().map(|top| self.top(feature, top));
                let due = Due {
                    feature: index,
                    name: name.clone(),
                    number: key,
                    parent: parent.map(|parent| parent.1),
                    depth: numbers.matches('.').count(),
                    top: top.transpose()?,
                    nudge: self.nudge(nature.name),
                };
                let at = self.due.len();
                self.due.push(due);
                self.instances(
                    Some((index, at)),
                    &format!("{name}/"),
                    &format!("{numbers}{number}."),
                )?;
            }
        }
        Ok(())
    }

    /// How far the next instance of a kind moves so that contacts which coincide are decided by age. The oldest one moves
    /// farthest: each younger one lies basinward of where it would lie by the one before.
    fn nudge(&mut self, kind: &'static str) -> f64 {
        let [so_far, all] = self.kinds.entry(kind).or_default();
        *so_far += 1;
        (f64::from(*so_far) - f64::from(*all) - 1.0) * self.step
    }

    /// What bounds a unit above: the base that a feature names, or, if that takes no part, the next one that does, or the
    /// domain's top. So it is for a feature that names none, too.
    fn top(&mut self, feature: &Feature, top: Bound) -> Result<Horizon, RealisationError> {
        let Bound::Horizon(own) = top else {
            return self.domain_bound(true);
        };
        let features = &self.model.features;
        let stands = |at: &usize| {
            let base = &features[*at];
            base.kind.base().is_some() && self.selection.keeps_feature(base)
        };
        let top = (own..features.len()).find(stands);
        if top != Some(own) {
            let above = top.map_or("the domain's top", |top| features[top].id.as_str());
            self.decisions.push(format!(
                "{} reaches up to {above}: {}, its top, takes no part",
                feature.id, features[own].id
            ));
        }
        match top.and_then(|top| self.horizons.get(&top)) {
            Some((horizon, _)) => Ok(horizon.clone()),
            None => self.domain_bound(true),
        }
    }

    /// The surface of a feature that is a base, with what was drawn for it.
    pub(super) fn surface(&self, feature: usize) -> Option<(&Horizon, &[(String, f64)])> {
        let (horizon, drawn) = self.horizons.get(&feature)?;
        Some((horizon, drawn))
    }

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

    /// The domain's block between its own base and top.
    pub(super) fn extent(&self) -> Result<Extent, RealisationError> {
        let (low, high) = self.model.domain.corners();
        let [base, top] = self.bounds.each_ref().map(Option::as_ref);
        Extent::new(low, high, base, top).map_err(|error| impossible_domain(&error))
    }
}

fn impossible_domain(error: &impl ToString) -> RealisationError {
    RealisationError::Impossible {
        volume: "domain".to_owned(),
        reason: error.to_string(),
    }
}
