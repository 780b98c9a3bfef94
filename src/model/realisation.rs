//! Realisations: every feature's instances, drawn and built into surfaces.
//!
//! Every number is drawn from a stream of its own, keyed by seed, feature, instance, parameter and
//! attempt, so that switching, adding or reordering features changes no other draw. Draws that make
//! no surface (bends tighter than the half-width, necks, impossible meanders) are drawn again as a
//! whole, never adjusted, and counted with their reasons.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use rayon::prelude::*;

use super::draws::{self, Drawn, Rejected, Surroundings, strata};
use super::interior::Interior;
use super::rules::{BACKGROUND, Rules, VolumeRules};
use super::selection::Selection;
use super::spec::{
    Bound, ClinoformsSpec, Domain, Feature, FeatureKind, HorizonSurface, Model, Selector,
};
use crate::features::body::Body;
use crate::features::extent::Extent;
use crate::features::horizon::Horizon;
use crate::features::side::Side;

/// Most attempts at one instance before its distributions are called impossible.
pub const MOST_ATTEMPTS: u32 = 1000;

/// One volume of a realisation; volume 0 is the background and has no body.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Index of the volume.
    pub volume: usize,
    /// Index of its feature in the model.
    pub feature: usize,
    /// What it holds.
    pub body: Body,
    /// What was drawn, by parameter.
    pub drawn: Vec<(String, f64)>,
    /// Attempts that were rejected before this one.
    pub rejected: u32,
}

/// Draws of a feature that were rejected for one reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// The feature's id.
    pub feature: String,
    /// Why, in a few words.
    pub reason: String,
    /// How many.
    pub count: u32,
}

/// A model with its draws made and its surfaces built.
#[derive(Clone, Debug)]
pub struct Realisation {
    /// The volumes' parts in the rules; the first is the background.
    pub volumes: Vec<VolumeRules>,
    /// The rules, resolved.
    pub rules: Rules,
    /// The bodies, in order of evaluation: instance `i` is volume `i + 1`.
    pub instances: Vec<Instance>,
    /// Rejected draws, by feature and reason.
    pub rejections: Vec<Rejection>,
    /// What is modelled: the block, between the domain's own base and top.
    pub extent: Extent,
}

/// Why a model has no realisation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RealisationError {
    /// Nothing is drawn, so nothing else can be tried.
    #[error("{volume}: {reason}")]
    Impossible {
        /// The volume's name.
        volume: String,
        /// What is wrong and what to do.
        reason: String,
    },
    /// No attempt made a surface.
    #[error(
        "{volume}: none of {attempts} draws makes a surface ({reasons}); \
         the last one: {last}"
    )]
    Exhausted {
        /// The volume's name.
        volume: String,
        /// How many attempts were made.
        attempts: u32,
        /// Reasons with their counts.
        reasons: String,
        /// The last attempt's reason, in full.
        last: String,
    },
}

impl RealisationError {
    /// The same, of a volume.
    fn of(self, name: &str) -> Self {
        let mut error = self;
        let (Self::Impossible { volume, .. } | Self::Exhausted { volume, .. }) = &mut error;
        name.clone_into(volume);
        error
    }
}

/// A volume that is to be realised.
struct Planned {
    volume: usize,
    feature: usize,
    /// The parent's volume.
    parent: Option<usize>,
    /// How many ancestors it has.
    depth: usize,
    /// Numbers of the instance and its ancestors, outermost first: the key of its draws.
    number: String,
    /// What it holds and what was drawn, if that was drawn before.
    ready: Option<(Body, Vec<(String, f64)>)>,
}

impl Realisation {
    /// Draws and builds all instances of the selected features.
    pub fn new(model: &Model, selection: &Selection) -> Result<Self, RealisationError> {
        let mut list = Listing::new(model, selection)?;
        list.instances(None, "", "")?;
        let Listing {
            volumes,
            planned,
            rejected,
            bounds,
            ..
        } = list;
        let extent = extent(&model.domain, &bounds)?;
        let made = realise_all(model, &planned, &volumes)?;
        let mut instances = Vec::with_capacity(made.len());
        let mut counts: BTreeMap<(usize, &'static str), u32> = BTreeMap::new();
        for reason in rejected {
            *counts.entry(reason).or_default() += 1;
        }
        for (instance, rejected) in made {
            for reason in rejected {
                *counts.entry((instance.feature, reason)).or_default() += 1;
            }
            instances.push(instance);
        }
        let rejections = counts
            .into_iter()
            .map(|((feature, reason), count)| Rejection {
                feature: model.features[feature].id.clone(),
                reason: reason.to_owned(),
                count,
            })
            .collect();
        Ok(Self {
            rules: Rules::new(&volumes),
            volumes,
            instances,
            rejections,
            extent,
        })
    }

    /// The index of the volume with this name.
    pub fn volume(&self, name: &str) -> Option<usize> {
        self.volumes.iter().position(|volume| volume.name == name)
    }
}

/// Lists the volumes in order of evaluation: depth first, children directly after their parent.
struct Listing<'a> {
    model: &'a Model,
    selection: &'a Selection,
    volumes: Vec<VolumeRules>,
    planned: Vec<Planned>,
    /// The horizons by feature, of those features that are one, whether or not they take part.
    horizons: BTreeMap<usize, DrawnHorizon>,
    /// The domain's own base and top.
    bounds: [Option<Horizon>; 2],
    /// The unit above the last horizon so far.
    open: usize,
    /// Draws that were rejected, by feature.
    rejected: Vec<(usize, &'static str)>,
}

type DrawnHorizon = (Horizon, Vec<(String, f64)>);

impl<'a> Listing<'a> {
    fn new(model: &'a Model, selection: &'a Selection) -> Result<Self, RealisationError> {
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
    fn instances(
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

    /// Lists the clinothems of a set, and their belts: all sheets first, then the belts of each clinothem.
    fn clinoforms(
        &mut self,
        index: usize,
        spec: &ClinoformsSpec,
        parent: Option<(usize, usize)>,
        path: &str,
    ) -> Result<(), RealisationError> {
        let feature = &self.model.features[index];
        let base = match parent {
            Some((unit, _)) => self.horizons.get(&unit).map(|drawn| drawn.0.clone()),
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
        let (Some(base), Some(top)) = (base, top) else {
            return Err(RealisationError::Impossible {
                volume: feature.id.clone(),
                reason: "its base or its top is no horizon".to_owned(),
            });
        };
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
fn extent(domain: &Domain, bounds: &[Option<Horizon>; 2]) -> Result<Extent, RealisationError> {
    let corner = |i: usize| DVec3::new(domain.x[i], domain.y[i], domain.z[i]);
    let [base, top] = bounds.each_ref().map(Option::as_ref);
    Extent::new(corner(0), corner(1), base, top).map_err(|error| impossible_domain(&error))
}

/// Draws something that is no single instance, again and again until it is possible; with the reasons of what was
/// rejected.
fn draw_whole<T>(
    model: &Model,
    id: &str,
    instance: &str,
    draw: impl Fn(draws::Key<'_>) -> Result<T, Rejected>,
) -> Result<(T, Vec<&'static str>), RealisationError> {
    let mut reasons = Vec::new();
    let mut last = String::new();
    for attempt in 0..MOST_ATTEMPTS {
        let key = draws::Key {
            seed: model.seed,
            feature: id,
            instance,
            attempt,
        };
        match draw(key) {
            Ok(made) => return Ok((made, reasons)),
            Err(rejected) if rejected.drawn == 0 => {
                return Err(RealisationError::Impossible {
                    volume: id.to_owned(),
                    reason: rejected.message,
                });
            }
            Err(rejected) => {
                reasons.push(rejected.reason);
                last = rejected.message;
            }
        }
    }
    Err(RealisationError::Exhausted {
        volume: id.to_owned(),
        attempts: MOST_ATTEMPTS,
        reasons: counted(&reasons),
        last,
    })
}

/// An instance, with the reasons of its rejected attempts.
type Made = (Instance, Vec<&'static str>);

/// Draws and builds all instances, parents before their children.
fn realise_all(
    model: &Model,
    planned: &[Planned],
    volumes: &[VolumeRules],
) -> Result<Vec<Made>, RealisationError> {
    let deepest = planned.iter().map(|one| one.depth).max().unwrap_or(0);
    let mut made: Vec<Option<Made>> = vec![None; planned.len()];
    for depth in 0..=deepest {
        let generation: Vec<&Planned> = planned.iter().filter(|one| one.depth == depth).collect();
        let parents = parents(model, &generation, &made, volumes)?;
        let generation: Vec<_> = generation
            .into_par_iter()
            .map(|one| {
                let place = Surroundings {
                    domain: &model.domain,
                    parent: one.parent.and_then(|parent| parents.get(&parent)),
                };
                realise(model, one, &volumes[one.volume].name, place)
            })
            .collect();
        for result in generation {
            let one = result?;
            let at = one.0.volume - 1;
            made[at] = Some(one);
        }
    }
    Ok(made.into_iter().flatten().collect())
}

/// What those parents hold by which their children are placed.
fn parents(
    model: &Model,
    children: &[&Planned],
    made: &[Option<Made>],
    volumes: &[VolumeRules],
) -> Result<BTreeMap<usize, Interior>, RealisationError> {
    let wanted: BTreeSet<usize> = children
        .iter()
        .filter(|one| draws::wants_parent(&model.features[one.feature].kind))
        .filter_map(|one| one.parent)
        .collect();
    let bodies: Vec<&Instance> = wanted
        .iter()
        .filter_map(|volume| made[volume - 1].as_ref().map(|(parent, _)| parent))
        .collect();
    let interior = |parent: &Instance| {
        let interior =
            Interior::of(&parent.body).map_err(|error| RealisationError::Impossible {
                volume: volumes[parent.volume].name.clone(),
                reason: format!("no child can be placed in it: {error}"),
            })?;
        Ok((parent.volume, interior))
    };
    bodies.into_par_iter().map(interior).collect()
}

/// Draws and builds one instance.
fn realise(
    model: &Model,
    planned: &Planned,
    name: &str,
    place: Surroundings<'_>,
) -> Result<Made, RealisationError> {
    if let Some((body, drawn)) = &planned.ready {
        let instance = Instance {
            volume: planned.volume,
            feature: planned.feature,
            body: body.clone(),
            drawn: drawn.clone(),
            rejected: 0,
        };
        return Ok((instance, Vec::new()));
    }
    let feature = &model.features[planned.feature];
    let draw = |key: draws::Key<'_>| {
        let rejected = key.attempt;
        draws::body(&feature.kind, place, key).map(|Drawn { body, drawn }| Instance {
            volume: planned.volume,
            feature: planned.feature,
            body,
            drawn,
            rejected,
        })
    };
    draw_whole(model, &feature.id, &planned.number, draw).map_err(|error| error.of(name))
}

/// Reasons with how often each occurred, most frequent first.
fn counted(reasons: &[&'static str]) -> String {
    let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
    for reason in reasons {
        *counts.entry(reason).or_default() += 1;
    }
    let mut counts: Vec<_> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let parts: Vec<String> = counts
        .iter()
        .map(|(reason, count)| format!("{reason}: {count}"))
        .collect();
    parts.join(", ")
}
