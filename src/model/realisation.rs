//! Realisations: every feature's instances, drawn and built into surfaces.
//!
//! Every number is drawn from a stream of its own, keyed by seed, feature, instance, parameter and
//! attempt, so that switching, adding or reordering features changes no other draw. Draws that make
//! no surface (bends tighter than the half-width, necks, impossible meanders) are drawn again as a
//! whole, never adjusted, and counted with their reasons.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::draws::{self, Drawn, Rejected, Surroundings};
use super::rules::{Rules, VolumeRules};
use super::selection::Selection;
use super::spec::{Feature, Model, Selector};
use crate::features::body::Body;
use crate::nurbs::enclosure::Enclosure;

/// Most attempts at one instance before its distributions are called impossible.
pub const MOST_ATTEMPTS: u32 = 1000;

/// One volume of a realisation; volume 0 is the background and has no body.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Index of the volume.
    pub volume: usize,
    /// Index of its feature in the model.
    pub feature: usize,
    /// Its closed shell.
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
}

impl Realisation {
    /// Draws and builds all instances of the selected features.
    pub fn new(model: &Model, selection: &Selection) -> Result<Self, RealisationError> {
        if model.domain.base.is_some() || model.domain.top.is_some() {
            return Err(RealisationError::Impossible {
                volume: "background".to_owned(),
                reason: "the domain's own `base` and `top` cannot be built by this version; \
                         leave them out"
                    .to_owned(),
            });
        }
        let mut list = Listing::new(model, selection);
        list.instances(None, "", "");
        let Listing {
            volumes, planned, ..
        } = list;
        let made = realise_all(model, &planned, &volumes)?;
        let mut instances = Vec::with_capacity(made.len());
        let mut counts: BTreeMap<(usize, &'static str), u32> = BTreeMap::new();
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
}

impl<'a> Listing<'a> {
    fn new(model: &'a Model, selection: &'a Selection) -> Self {
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
        Self {
            model,
            selection,
            volumes: vec![background],
            planned: Vec::new(),
        }
    }

    /// Adds the instances of all features with this parent (feature, volume).
    fn instances(&mut self, parent: Option<(usize, usize)>, path: &str, numbers: &str) {
        for (index, feature) in self.model.features.iter().enumerate() {
            if feature.parent != parent.map(|parent| parent.0)
                || !self.selection.keeps_feature(feature)
            {
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
                let volume = self.volumes.len();
                self.volumes
                    .push(self.rules_of(feature, &name, parent.map(|parent| parent.1)));
                let key = format!("{numbers}{number}");
                self.planned.push(Planned {
                    volume,
                    feature: index,
                    parent: parent.map(|parent| parent.1),
                    depth: numbers.matches('.').count(),
                    number: key.clone(),
                });
                self.instances(
                    Some((index, volume)),
                    &format!("{name}/"),
                    &format!("{key}."),
                );
            }
        }
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

/// The shells of those parents by which their children are placed.
fn parents(
    model: &Model,
    children: &[&Planned],
    made: &[Option<Made>],
    volumes: &[VolumeRules],
) -> Result<BTreeMap<usize, Enclosure>, RealisationError> {
    let wanted: BTreeSet<usize> = children
        .iter()
        .filter(|one| draws::wants_parent(&model.features[one.feature].kind))
        .filter_map(|one| one.parent)
        .collect();
    let bodies: Vec<&Instance> = wanted
        .iter()
        .filter_map(|volume| made[volume - 1].as_ref().map(|(parent, _)| parent))
        .collect();
    let shell = |parent: &Instance| {
        let open = |reason: String| RealisationError::Impossible {
            volume: volumes[parent.volume].name.clone(),
            reason: format!("its shell is not closed, so no child can be placed in it: {reason}"),
        };
        let sheets = parent
            .body
            .sheets()
            .map_err(|error| open(error.to_string()))?;
        let shell = Enclosure::new(sheets.into_iter().map(|sheet| sheet.1).collect())
            .map_err(|error| open(error.to_string()))?;
        Ok((parent.volume, shell))
    };
    bodies.into_par_iter().map(shell).collect()
}

/// Draws and builds one instance.
fn realise(
    model: &Model,
    planned: &Planned,
    name: &str,
    place: Surroundings<'_>,
) -> Result<Made, RealisationError> {
    let feature = &model.features[planned.feature];
    let mut reasons: Vec<&'static str> = Vec::new();
    let mut last = String::new();
    for attempt in 0..MOST_ATTEMPTS {
        let key = draws::Key {
            seed: model.seed,
            feature: &feature.id,
            instance: &planned.number,
            attempt,
        };
        match draws::body(&feature.kind, place, key) {
            Ok(Drawn { body, drawn }) => {
                let rejected = attempt;
                let instance = Instance {
                    volume: planned.volume,
                    feature: planned.feature,
                    body,
                    drawn,
                    rejected,
                };
                return Ok((instance, reasons));
            }
            Err(Rejected {
                reason,
                message,
                drawn,
            }) => {
                if drawn == 0 {
                    return Err(RealisationError::Impossible {
                        volume: name.to_owned(),
                        reason: message,
                    });
                }
                reasons.push(reason);
                last = message;
            }
        }
    }
    Err(RealisationError::Exhausted {
        volume: name.to_owned(),
        attempts: MOST_ATTEMPTS,
        reasons: counted(&reasons),
        last,
    })
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
