//! Realisations: every feature's instances, drawn and built into surfaces.
//!
//! Every number is drawn from a stream of its own, keyed by seed, feature, instance, parameter and
//! attempt, so that switching, adding or reordering features changes no other draw. Draws that make
//! no surface (bends tighter than the half-width, necks, impossible meanders) are drawn again as a
//! whole, never adjusted, and counted with their reasons.

mod apart;
mod listing;
mod making;

use std::collections::BTreeMap;

use apart::Apart;
use listing::Listing;
use listing::volumes::Volumes;

use super::draws::{self, Rejected};
use super::properties::VolumeProperties;
use super::rules::{Rules, VolumeRules};
use super::selection::Selection;
use super::spec::Model;
use crate::features::body::Body;
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
    /// The volumes' rock properties.
    pub properties: Vec<VolumeProperties>,
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
        list.list()?;
        let made = making::make_all(model, &list)?;
        let extent = list.extent()?;
        let mut counts: BTreeMap<(Option<usize>, &'static str), u32> = BTreeMap::new();
        for reason in list.rejected.iter().copied() {
            *counts.entry(reason).or_default() += 1;
        }
        let of_all = list.due.iter().zip(&made);
        for (due, made) in of_all.filter(|(due, _)| due.takes_part) {
            for reason in &made.rejected {
                *counts.entry((Some(due.feature), reason)).or_default() += 1;
            }
        }
        let Volumes {
            rules: volumes,
            mut instances,
            properties,
            decisions: told,
        } = Volumes::of(model, selection, &list, made, &extent)?;
        let Listing {
            drawn,
            mut decisions,
            levels,
            ..
        } = list;
        decisions.extend(told);
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
            properties,
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
            stratum: model.stratum,
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
