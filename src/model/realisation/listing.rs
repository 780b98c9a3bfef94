//! The list of volumes, in order of evaluation. What is drawn as a whole (horizons, clinoform sets) is drawn here: how many
//! volumes there are depends on it.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{RealisationError, draw_whole};
use crate::features::body::Body;
use crate::features::extent::Extent;
use crate::features::horizon::Horizon;
use crate::features::side::Side;
use crate::model::draws::{self, strata};
use crate::model::rules::{BACKGROUND, VolumeRules};
use crate::model::selection::Selection;
use crate::model::spec::{
    Bound, ClinoformsSpec, Domain, Feature, FeatureKind, HorizonSurface, Model, Selector,
};

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
    /// The domain's own base and top.
    pub(super) bounds: [Option<Horizon>; 2],
    /// The unit above the last horizon so far.
    open: usize,
    /// Draws that were rejected, by feature.
    pub(super) rejected: Vec<(usize, &'static str)>,
}

type DrawnHorizon = (Horizon, Vec<(String, f64)>);

impl<'a> Listing<'a> {
    pub(super) fn new(
        model: &'a Model,
        selection: &'a Selection,
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
        };
        let mut horizons = BTreeMap::new();
        let mut rejected = Vec::new();
        for (index, feature) in model.features.iter().enumerate() {
            if let FeatureKind::Horizon(spec) = &feature.kind {
                let draw = |key: draws::Key<'_>| strata::horizon(&spec.surface, key);
                let (drawn, reasons) = draw_whole(model, &feature.id, "1", draw)?;
                rejected.extend(reasons.into_iter().map(|reason| (index, reason)));
                horizons.insert(index, drawn);
            }
        }
        Ok(Self {
            rejected,
            model,
            selection,
            volumes: vec![background],
            planned: Vec::new(),
            horizons,
            bounds: [
                bound(model, "base", model.domain.base.as_ref())?,
                bound(model, "top", model.domain.top.as_ref())?,
            ],
            open: BACKGROUND,
        })
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
                        self.open = self.volumes.len();
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

    /// The horizon that bounds the domain: its own, or the block's.
    fn domain_bound(&self, top: bool) -> Result<Horizon, RealisationError> {
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
        &self,
        feature: &Feature,
        spec: &ClinoformsSpec,
        parent: Option<usize>,
    ) -> Result<[Horizon; 2], RealisationError> {
        let base = match parent {
            Some(unit) => self.horizons.get(&unit).map(|drawn| drawn.0.clone()),
            None => Some(self.domain_bound(false)?),
        };
        let top = match spec.top {
            Bound::Horizon(unit) => self.horizons.get(&unit).map(|drawn| drawn.0.clone()),
            Bound::Domain => Some(self.domain_bound(true)?),
        };
        if let Bound::Horizon(unit) = spec.top
            && !self.selection.keeps_feature(&self.model.features[unit])
        {
            let id = &self.model.features[unit].id;
            return Err(RealisationError::Impossible {
                volume: feature.id.clone(),
                reason: format!(
                    "its top is the horizon \"{id}\", which does not take part: keep that, or leave {} out, too",
                    feature.id
                ),
            });
        }
        match (base, top) {
            (Some(base), Some(top)) => Ok([base, top]),
            _ => Err(RealisationError::Impossible {
                volume: feature.id.clone(),
                reason: "its base or its top is no horizon".to_owned(),
            }),
        }
    }

    /// Lists the clinothems of a set, and their belts: all sheets first, then the belts of each clinothem.
    fn clinoforms(
        &mut self,
        index: usize,
        spec: &ClinoformsSpec,
        parent: Option<(usize, usize)>,
        path: &str,
    ) -> Result<(), RealisationError> {
        let feature = &self.model.features[index];
        let [base, top] = self.unit(feature, spec, parent.map(|parent| parent.0))?;
        let domain = &self.model.domain;
        let draw = |key: draws::Key<'_>| strata::clinoforms(spec, domain, &base, &top, key);
        let (set, reasons) = draw_whole(self.model, &feature.id, "1", draw)?;
        let rejected = reasons.into_iter().map(|reason| (index, reason));
        self.rejected.extend(rejected);
        let unit = parent.map_or(BACKGROUND, |parent| parent.1);
        let name = |clinothem: usize, belt: Option<&str>| match belt {
            None => format!("{path}{}-{clinothem}", feature.id),
            Some(belt) => format!("{path}{}-{clinothem}/{belt}", feature.id),
        };
        let volume = |list: &mut Self, name: &str, from: usize, belt: usize, body: Body, drawn| {
            let mut rules = list.rules_of(feature, name, parent.map(|parent| parent.1));
            rules.from = Some(from);
            if let Some(belt) = spec.belts.get(belt) {
                rules
                    .facies
                    .clone_from(&list.model.facies[belt.facies].name);
            }
            list.push(rules, index, "", name.to_owned(), Some((body, drawn)))
        };
        let landward = spec.belts.first().map(|belt| belt.name.as_str());
        let mut firsts = Vec::with_capacity(set.sheets.len() + 1);
        let mut from = unit;
        if landward.is_some() {
            let everywhere = Body::Side(Side::Everywhere.into());
            from = volume(self, &name(0, landward), from, 0, everywhere, Vec::new());
        }
        firsts.push(from);
        for (at, sheet) in set.sheets.into_iter().enumerate() {
            let body = Body::Side(sheet.side);
            from = volume(self, &name(at + 1, landward), from, 0, body, sheet.drawn);
            firsts.push(from);
        }
        for (clinothem, (first, boundaries)) in firsts.into_iter().zip(set.boundaries).enumerate() {
            let mut from = first;
            for (at, boundary) in boundaries.into_iter().enumerate() {
                let belt = spec.belts.get(at + 1).map(|belt| belt.name.as_str());
                let body = Body::Side(boundary.side);
                from = volume(
                    self,
                    &name(clinothem, belt),
                    from,
                    at + 1,
                    body,
                    boundary.drawn,
                );
            }
        }
        Ok(())
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
        }
    }
}

fn impossible_domain(error: &impl ToString) -> RealisationError {
    RealisationError::Impossible {
        volume: "domain".to_owned(),
        reason: error.to_string(),
    }
}

/// Draws the domain's own base or top.
fn bound(
    model: &Model,
    which: &str,
    surface: Option<&HorizonSurface>,
) -> Result<Option<Horizon>, RealisationError> {
    let drawn = surface.map(|surface| {
        let draw = |key: draws::Key<'_>| strata::horizon(surface, key);
        draw_whole(model, "domain", which, draw)
    });
    Ok(drawn.transpose()?.map(|((horizon, _), _)| horizon))
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
