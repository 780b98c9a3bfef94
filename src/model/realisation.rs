//! Realisations: every feature's instances, drawn and built into surfaces.
//!
//! Every number is drawn from a stream of its own, keyed by seed, feature, instance, parameter and
//! attempt, so that switching, adding or reordering features changes no other draw. Draws that make
//! no surface (bends tighter than the half-width, necks, impossible meanders) are drawn again as a
//! whole, never adjusted, and counted with their reasons.

mod listing;

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;
use rayon::prelude::*;

use listing::{Listing, Planned, extent};

use super::draws::{self, Drawn, Rejected, Surroundings};
use super::interior::Interior;
use super::rules::{Rules, VolumeRules};
use super::selection::Selection;
use super::spec::Model;
use crate::features::body::{Body, Nudge};
use crate::features::extent::Extent;

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
    /// The feature's id; `domain` for the domain's own base and top.
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
    /// What was drawn for the domain's own base and top, by parameter.
    pub drawn: Vec<(String, f64)>,
    /// What was decided because something takes no part, in words for the report.
    pub decisions: Vec<String>,
    /// The step by which contacts that coincide are decided by age (m); 0 if they are not.
    pub step: f64,
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

impl Realisation {
    /// Draws and builds all instances of the selected features.
    pub fn new(model: &Model, selection: &Selection) -> Result<Self, RealisationError> {
        Self::by_age(model, selection, 0.0)
    }

    /// The same, in which contacts that coincide are decided by age: each horizon lies one step (m) lower than it would
    /// below the one before it, so that a bed of no thickness is absent; each body is a step shallower than the older ones
    /// that it may meet, and as much longer.
    pub fn by_age(
        model: &Model,
        selection: &Selection,
        step: f64,
    ) -> Result<Self, RealisationError> {
        let mut list = Listing::new(model, selection, step)?;
        list.instances(None, "", "")?;
        let Listing {
            volumes,
            planned,
            rejected,
            bounds,
            drawn,
            decisions,
            levels,
            ..
        } = list;
        let extent = extent(&model.domain, &bounds)?;
        let made = realise_all(model, &planned, &volumes)?;
        let mut instances = Vec::with_capacity(made.len());
        let mut counts: BTreeMap<(Option<usize>, &'static str), u32> = BTreeMap::new();
        for reason in rejected {
            *counts.entry(reason).or_default() += 1;
        }
        for (instance, rejected) in made {
            for reason in rejected {
                let whose = Some(instance.feature);
                *counts.entry((whose, reason)).or_default() += 1;
            }
            instances.push(instance);
        }
        if step > 0.0 {
            let apart = Apart {
                step,
                levels: &levels,
                same: extent.same_level(),
            };
            apart.move_bodies(&mut instances, &volumes)?;
        }
        let rejections = counts
            .into_iter()
            .map(|((feature, reason), count)| Rejection {
                feature: feature
                    .map_or("domain", |at| &model.features[at].id)
                    .to_owned(),
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
            drawn,
            decisions,
            step,
        })
    }

    /// The index of the volume with this name.
    pub fn volume(&self, name: &str) -> Option<usize> {
        self.volumes.iter().position(|volume| volume.name == name)
    }
}

/// How bodies come apart whose contacts coincide.
struct Apart<'a> {
    /// The step of age (m).
    step: f64,
    /// Of level horizons: where they were, and where they are now (m).
    levels: &'a [[f64; 2]],
    /// Levels nearer than this are the same (m).
    same: f64,
}

impl Apart<'_> {
    /// Gives each body a change of its own among those that it may meet; but the same to bodies that are the same, which then
    /// share a shell: a repeated body leaves no skin of the older one.
    fn move_bodies(
        &self,
        instances: &mut [Instance],
        volumes: &[VolumeRules],
    ) -> Result<(), RealisationError> {
        let boxes: Vec<_> = instances.iter().map(|one| one.body.bounds()).collect();
        let repeated = repeated(instances);
        let mut ranks = vec![0_u32; instances.len()];
        for at in 0..instances.len() {
            if matches!(instances[at].body, Body::Side(_)) {
                continue;
            }
            if let Some(first) = repeated[at] {
                ranks[at] = ranks[first];
                instances[at].body = instances[first].body.clone();
                continue;
            }
            let (low, high) = boxes[at];
            let meets = |older: &usize| {
                let (from, to) = boxes[*older];
                let slack = self.step * f64::from(ranks[*older] + 2);
                from.cmple(high + slack).all() && (low - slack).cmple(to).all()
            };
            let older = (0..at).filter(meets).map(|older| ranks[older]).max();
            ranks[at] = older.unwrap_or(0) + 1;
            let body = &instances[at].body;
            let body = body.nudged(&self.nudge(body, ranks[at]));
            instances[at].body = body.map_err(|error| RealisationError::Impossible {
                volume: volumes[instances[at].volume].name.clone(),
                reason: error.to_string(),
            })?;
        }
        Ok(())
    }

    /// The change of the body of a rank.
    fn nudge(&self, body: &Body, rank: u32) -> Nudge {
        /// Turns of neighbouring ranks, as far from each other as they can be (the golden angle, rad).
        const TURN: f64 = 2.399_963_229_728_653;
        /// How far bodies move in plan, in steps; their ends move farther.
        const ASIDE: f64 = 0.3;
        /// Horizons move by whole steps; bodies shall not move with them.
        const BETWEEN: f64 = 0.381_966_011_250_105;
        let rank = f64::from(rank);
        // A body that ends at a level horizon still does.
        let level = body.level_top(self.same);
        let ends = |[from, _]: &&[f64; 2]| level.is_some_and(|top| (top - from).abs() <= self.same);
        let lowest = self.levels.iter().filter(ends).map(|[from, to]| to - from);
        Nudge {
            rise: (rank + BETWEEN) * self.step,
            reach: (rank + BETWEEN) * self.step,
            shift: (ASIDE * self.step * DVec2::from_angle(rank * TURN))
                .extend(lowest.reduce(f64::min).unwrap_or(0.0)),
        }
    }
}

/// By instance: the first one with the same body, if that is older.
fn repeated(instances: &[Instance]) -> Vec<Option<usize>> {
    let mut by_box: BTreeMap<[u64; 6], Vec<usize>> = BTreeMap::new();
    let mut first = Vec::with_capacity(instances.len());
    for (at, one) in instances.iter().enumerate() {
        let alike = by_box.entry(one.body.bounds_bits()).or_default();
        let same = alike
            .iter()
            .copied()
            .find(|older| instances[*older].body == one.body);
        if same.is_none() {
            alike.push(at);
        }
        first.push(same);
    }
    first
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
