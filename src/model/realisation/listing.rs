//! The list of volumes, in order of evaluation. What is drawn as a whole (horizons, clinoform sets) is drawn here: how many
//! volumes there are depends on it.

mod clinothems;
mod coincidence;

use std::collections::BTreeMap;

use glam::DVec3;

use super::{RealisationError, draw_whole};
use crate::features::body::Body;
use crate::features::extent::Extent;
use crate::features::horizon::Horizon;
use crate::model::draws::{self, strata};
use crate::model::rules::{BACKGROUND, VolumeRules};
use crate::model::selection::Selection;
use crate::model::spec::{Domain, Feature, FeatureKind, HorizonSurface, Model, Selector};
use coincidence::Strata;

/// A volume that is to be realised.
pub(super) struct Planned {
    pub(super) volume: usize,
    pub(super) feature: usize,
    /// The parent's volume.
    pub(super) parent: Option<usize>,
    /// How many ancestors it has.
    pub(super) depth: usize,
    /// Numbers of the instance and its ancestors, outermost first: the key of its draws.
    pub(super) number: String,
    /// What it holds and what was drawn, if that was drawn before.
    pub(super) ready: Option<(Body, Vec<(String, f64)>)>,
}

/// Lists the volumes in order of evaluation: depth first, children directly after their parent.
pub(super) struct Listing<'a> {
    model: &'a Model,
    selection: &'a Selection,
    pub(super) volumes: Vec<VolumeRules>,
    pub(super) planned: Vec<Planned>,
    /// The horizons by feature, of those features that are one, whether or not they take part.
    horizons: BTreeMap<usize, DrawnHorizon>,
    /// By feature: the horizon that lies nowhere below this other one.
    above: BTreeMap<usize, usize>,
    /// The volumes of those horizons so far that take part, by feature.
    units: BTreeMap<usize, usize>,
    /// The domain's own base and top.
    pub(super) bounds: [Option<Horizon>; 2],
    /// What was drawn for them.
    pub(super) drawn: Vec<(String, f64)>,
    /// By how much contacts that coincide are moved apart for each step in age (m).
    step: f64,
    /// Of level horizons that were moved: from where, and to where (m).
    pub(super) levels: Vec<[f64; 2]>,
    /// Clinoform sets so far.
    sets: u32,
    /// The unit above the last horizon so far.
    open: usize,
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
        let background = VolumeRules {
            name: "background".to_owned(),
            feature: "background".to_owned(),
            kind: "background".to_owned(),
            level: 0,
            facies: model.facies[model.domain.facies].name.clone(),
            parent: None,
            removes: Selector::Everything,
            removed_by: Selector::Everything,
            preserve: false,
            from: None,
            above: None,
        };
        let mut list = Self {
            rejected: Vec::new(),
            decisions: Vec::new(),
            model,
            selection,
            volumes: vec![background],
            planned: Vec::new(),
            horizons: BTreeMap::new(),
            above: BTreeMap::new(),
            units: BTreeMap::new(),
            bounds: [None, None],
            drawn: Vec::new(),
            step,
            sets: 0,
            open: BACKGROUND,
            levels: Vec::new(),
        };
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
            if let FeatureKind::Horizon(spec) = &feature.kind {
                let draw = |key: draws::Key<'_>| strata::horizon(&spec.surface, key);
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
        let draw = |key: draws::Key<'_>| strata::horizon(surface, key);
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

    /// Adds the instances of all features with this parent (feature, volume).
    pub(super) fn instances(
        &mut self,
        parent: Option<(usize, usize)>,
        path: &str,
        numbers: &str,
    ) -> Result<(), RealisationError> {
        for (index, feature) in self.model.features.iter().enumerate() {
            if feature.parent != parent.map(|parent| parent.0)
                || !self.selection.keeps_feature(feature)
            {
                continue;
            }
            if let FeatureKind::Clinoforms(spec) = &feature.kind {
                self.clinoforms(index, spec, parent, path)?;
                continue;
            }
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
                let mut rules = self.rules_of(feature, &name, parent.map(|parent| parent.1));
                let ready = match &feature.kind {
                    FeatureKind::Horizon(spec) => {
                        rules.from = spec.onlapping.then_some(self.open);
                        let below = self.above.get(&index);
                        rules.above = below.and_then(|below| self.units.get(below)).copied();
                        self.open = self.volumes.len();
                        self.units.insert(index, self.open);
                        Some(self.horizon(index)?)
                    }
                    _ => None,
                };
                let key = format!("{numbers}{number}");
                let volume = self.push(rules, index, numbers, key.clone(), ready);
                self.instances(
                    Some((index, volume)),
                    &format!("{name}/"),
                    &format!("{key}."),
                )?;
            }
        }
        Ok(())
    }

    fn push(
        &mut self,
        rules: VolumeRules,
        feature: usize,
        numbers: &str,
        number: String,
        ready: Option<(Body, Vec<(String, f64)>)>,
    ) -> usize {
        let volume = self.volumes.len();
        self.planned.push(Planned {
            volume,
            feature,
            parent: rules.parent,
            depth: numbers.matches('.').count(),
            number,
            ready,
        });
        self.volumes.push(rules);
        volume
    }

    /// What lies above a horizon, with what was drawn for it.
    fn horizon(&self, feature: usize) -> Result<(Body, Vec<(String, f64)>), RealisationError> {
        let impossible = |reason: String| RealisationError::Impossible {
            volume: self.model.features[feature].id.clone(),
            reason,
        };
        let (horizon, drawn) = self
            .horizons
            .get(&feature)
            .ok_or_else(|| impossible("it is no horizon".to_owned()))?;
        let side = strata::above(horizon, &self.model.domain).map_err(impossible)?;
        Ok((Body::Side(side), drawn.clone()))
    }

    fn rules_of(&self, feature: &Feature, name: &str, parent: Option<usize>) -> VolumeRules {
        VolumeRules {
            name: name.to_owned(),
            feature: feature.id.clone(),
            kind: feature.kind.name().to_owned(),
            level: feature.level,
            facies: self.model.facies[feature.facies].name.clone(),
            parent,
            removes: feature.removes.clone(),
            removed_by: feature.removed_by.clone(),
            preserve: feature.preserve,
            from: None,
            above: None,
        }
    }
}

fn impossible_domain(error: &impl ToString) -> RealisationError {
    RealisationError::Impossible {
        volume: "domain".to_owned(),
        reason: error.to_string(),
    }
}

/// The domain's block between its own base and top.
pub(super) fn extent(
    domain: &Domain,
    bounds: &[Option<Horizon>; 2],
) -> Result<Extent, RealisationError> {
    let corner = |i: usize| DVec3::new(domain.x[i], domain.y[i], domain.z[i]);
    let [base, top] = bounds.each_ref().map(Option::as_ref);
    Extent::new(corner(0), corner(1), base, top).map_err(|error| impossible_domain(&error))
}
