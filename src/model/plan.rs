//! The assembly plan: what the kernel has to do, decided in pure Rust.
//!
//! Coincidences that no kernel resolves reliably are decided here, by what the model means:
//!
//! - a body that does not reach into the domain takes no part; nor does a horizon on the domain's top, while one on the
//!   domain's base holds all of the domain;
//! - bodies with the same shell (a feature repeated without any draw) share one;
//! - *level tops that coincide*, with the domain's top or with each other, are marked as flush, so that
//!   the kernel is given one plane for all of them, or, as a remedy, no coincident faces at all: the
//!   bodies' banks are raised above their tops, and a **lid** cuts them there. Inside means then inside
//!   the raised shell and below the lid; every contact is a crossing at an angle, and nothing changes
//!   inside the bodies. The domain's own top serves as lid for bodies that reach it.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use super::kinds;
use super::nature::Nature;
use super::realisation::{Instance, Realisation};
use super::rules::Rules;
use crate::features::body::{Body, Trough, TroughError};
use crate::features::extent::Extent;
use crate::features::side::Side;

/// What the kernel has to assemble.
#[derive(Clone, Debug)]
pub struct AssemblyPlan {
    /// The domain: a block, with the base and the top that bound it there.
    pub extent: Extent,
    /// Which volume holds what.
    pub rules: Rules,
    /// The volumes' names, for messages.
    pub names: Vec<String>,
    /// What they are; none of the background.
    pub natures: Vec<Option<&'static Nature>>,
    /// The shells, each once.
    pub shells: Vec<PlannedShell>,
    /// Elevations at which bodies end under a lid inside the domain.
    pub lids: Vec<f64>,
    /// Bodies that take part, in order of evaluation.
    pub bodies: Vec<PlannedBody>,
    /// What was decided, in words for the report.
    pub decisions: Vec<String>,
}

/// A shell, and how it meets what its level top coincides with.
#[derive(Clone, Debug)]
pub struct PlannedShell {
    /// The shell as the model means it.
    pub body: Body,
    /// Set if its level top coincides with the domain's top, a level horizon or another body's top.
    pub flush: Option<Flush>,
}

/// A level top that coincides with something.
#[derive(Clone, Debug)]
pub struct Flush {
    /// The common elevation (m).
    pub level: f64,
    /// The shell with its banks raised above it, to be cut there by a lid.
    pub raised: Trough,
}

/// How a volume's inside is told from its shells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct PlannedBody {
    /// The volume.
    pub volume: usize,
    /// Its shell.
    pub shell: usize,
    /// What it must stay below.
    pub below: Option<Cover>,
}

/// What ends bodies at a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Cover {
    /// A lid, by its index.
    Lid(usize),
    /// A level horizon, by its shell.
    Horizon(usize),
}

/// Why no plan can be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{volume}: its banks cannot be raised: {source}")]
pub struct PlanError {
    /// The volume's name.
    pub volume: String,
    /// Why.
    pub source: TroughError,
}

/// An instance as far as it takes part.
struct Reaching<'a> {
    volume: usize,
    body: Cow<'a, Body>,
}

/// How a body's level top is handled.
#[derive(Clone, Copy, PartialEq)]
enum Top {
    /// As it is.
    Free,
    /// Cut by the domain's own top.
    OfDomain,
    /// Cut by the lid at this elevation.
    UnderLid(f64),
    /// Cut by the level horizon of this body.
    UnderHorizon(usize, f64),
}

impl AssemblyPlan {
    /// Decides what the kernel has to do for a realisation.
    pub fn new(realisation: &Realisation) -> Result<Self, PlanError> {
        let mut plan = Self {
            extent: realisation.extent.clone(),
            rules: realisation.rules.clone(),
            names: realisation
                .volumes
                .iter()
                .map(|volume| volume.name.clone())
                .collect(),
            natures: realisation
                .volumes
                .iter()
                .map(|volume| kinds::named(&volume.kind).map(|kind| &kind.nature))
                .collect(),
            shells: Vec::new(),
            lids: Vec::new(),
            bodies: Vec::new(),
            decisions: realisation.decisions.clone(),
        };
        let reaching: Vec<Reaching<'_>> = realisation
            .instances
            .iter()
            .filter_map(|instance| plan.reaching(instance))
            .collect();
        let tops = plan.tops(&reaching, realisation.step > 0.0);
        // By box: bodies that are one have the same, but sides are within a tolerance.
        let mut known: BTreeMap<Option<[u64; 6]>, Vec<(Top, usize)>> = BTreeMap::new();
        for (reaching, &top) in reaching.iter().zip(&tops) {
            let volume = reaching.volume;
            let same = |(other, shell): &&(Top, usize)| {
                *other == top && plan.are_one(&plan.shells[*shell].body, &reaching.body)
            };
            let alike = known.entry(box_of(&reaching.body)).or_default();
            let shell = if let Some(&(_, shell)) = alike.iter().find(same) {
                let name = &plan.names[volume];
                plan.note(format!("{name} has the shell of an older body"));
                shell
            } else {
                let shell = plan.add_shell(reaching, top)?;
                alike.push((top, shell));
                shell
            };
            let below = plan.cover(top);
            plan.bodies.push(PlannedBody {
                volume,
                shell,
                below,
            });
        }
        // Horizons may come after the bodies below them.
        for at in 0..plan.bodies.len() {
            if let Some(Cover::Horizon(body)) = plan.bodies[at].below {
                plan.bodies[at].below = Some(Cover::Horizon(plan.bodies[body].shell));
            }
        }
        Ok(plan)
    }

    /// Lower corner of the domain's block.
    pub fn low(&self) -> DVec3 {
        self.extent.low()
    }

    /// Upper corner of the domain's block.
    pub fn high(&self) -> DVec3 {
        self.extent.high()
    }

    /// The base and the top of the domain that are not the block's own: each with whether it is the top.
    pub fn bounds(&self) -> impl Iterator<Item = (bool, &Arc<Side>)> {
        let bounds = self.extent.bounds().iter().zip([false, true]);
        bounds.filter_map(|(side, is_top)| side.as_ref().map(|side| (is_top, side)))
    }

    /// Whether it has a solid of another program: those the general fuse alone can take.
    pub fn has_imported(&self) -> bool {
        let mut shells = self.shells.iter();
        shells.any(|shell| matches!(shell.body, Body::Imported(_)))
    }

    fn note(&mut self, decision: String) {
        self.decisions.push(decision);
    }

    /// Two elevations nearer to each other than this (m) are the same.
    pub(crate) fn same_level(&self) -> f64 {
        self.extent.same_level()
    }

    /// What an instance holds of the domain; `None`, with a note, if it takes no part.
    fn reaching<'a>(&mut self, instance: &'a Instance) -> Option<Reaching<'a>> {
        let name = &self.names[instance.volume];
        let mut body = Cow::Borrowed(&instance.body);
        if let Body::Side(side) = &instance.body {
            if self.is_at_bound(side, true) {
                self.note(format!(
                    "{name} lies on the domain's top: nothing is above it"
                ));
                return None;
            }
            if self.is_at_bound(side, false) {
                self.note(format!(
                    "{name} lies on the domain's base: all of the domain is above it"
                ));
                body = Cow::Owned(Body::Side(Arc::new(Side::everywhere())));
            }
        }
        let heights = match &*body {
            Body::Side(side) => side.heights(),
            Body::Trough(_) | Body::Ellipsoid(_) | Body::Shell(_) | Body::Imported(_) => None,
        };
        if heights.is_some_and(|[_, highest]| highest <= self.low().z) {
            let name = &self.names[instance.volume];
            self.note(format!(
                "{name} lies below the domain: all of it is above it"
            ));
            return Some(Reaching {
                volume: instance.volume,
                body: Cow::Owned(Body::Side(Arc::new(Side::everywhere()))),
            });
        }
        let (low, high) = body.bounds();
        if !(low.cmplt(self.high()).all() && high.cmpgt(self.low()).all()) {
            let name = &self.names[instance.volume];
            self.note(format!("{name} lies outside the domain"));
            return None;
        }
        Some(Reaching {
            volume: instance.volume,
            body,
        })
    }

    /// Whether a side is that of the horizon that bounds the domain above or below.
    fn is_at_bound(&self, side: &Side, is_top: bool) -> bool {
        let same = self.same_level();
        let at = if is_top { self.high() } else { self.low() }.z;
        let is_level = side.level().is_some_and(|level| (level - at).abs() <= same);
        let bound = &self.extent.bounds()[usize::from(is_top)];
        is_level || bound.as_ref().is_some_and(|one| one.is_at(side, same))
    }

    /// Whether two bodies hold the same: a feature repeated without any draw, or two horizons at one place.
    fn are_one(&self, one: &Body, other: &Body) -> bool {
        match (one, other) {
            (Body::Side(one), Body::Side(other)) => one.is_at(other, self.same_level()),
            _ => one == other,
        }
    }

    /// Which bodies end at the domain's top or under a common lid.
    ///
    /// Where contacts are decided by age, those also end under a lid that a bent horizon may run along: the two are heights over
    /// one plan, and where these cross is found however near they are.
    fn tops(&mut self, bodies: &[Reaching<'_>], by_age: bool) -> Vec<Top> {
        let same = self.same_level();
        let levels: Vec<Option<f64>> = bodies.iter().map(|one| one.body.level_top(same)).collect();
        let bounds: Vec<_> = bodies.iter().map(|one| one.body.bounds()).collect();
        let mut tops = vec![Top::Free; bodies.len()];
        let level_of = |body: &Body| match body {
            Body::Side(side) => side.level(),
            Body::Trough(_) | Body::Ellipsoid(_) | Body::Shell(_) | Body::Imported(_) => None,
        };
        let level_horizons: Vec<Option<f64>> =
            bodies.iter().map(|one| level_of(&one.body)).collect();
        let (horizons, of_bodies) = (Sorted::new(&level_horizons), Sorted::new(&levels));
        // A lid reaches through the whole domain: all tops at its level end under it, wherever they are.
        let meets = |i: usize, j: usize| j != i && boxes_meet_in_plan(&bounds[i], &bounds[j]);
        let share = |i: usize, level: f64| of_bodies.near(level, same).any(|j| meets(i, j));
        let shared: Vec<Option<f64>> = levels
            .iter()
            .enumerate()
            .map(|(i, level)| level.filter(|level| share(i, *level)))
            .collect();
        let of_lids = Sorted::new(&shared);
        for (i, level) in levels.iter().enumerate() {
            let Some(level) = *level else { continue };
            if (level - self.high().z).abs() <= same {
                tops[i] = Top::OfDomain;
                self.note(format!(
                    "{} ends at the domain's top",
                    self.names[bodies[i].volume]
                ));
                continue;
            }
            if let Some(body) = horizons.near(level, same).min() {
                tops[i] = Top::UnderHorizon(body, level);
                self.note(format!(
                    "{} ends at the horizon of {}",
                    self.names[bodies[i].volume], self.names[bodies[body].volume]
                ));
                continue;
            }
            let is_shared = of_lids.near(level, same).next().is_some();
            let runs_along = |one: &Reaching<'_>| match &*one.body {
                Body::Side(side) => side.heights().is_some_and(|[lowest, highest]| {
                    lowest - same <= level && level <= highest + same
                }),
                Body::Trough(_) | Body::Ellipsoid(_) | Body::Shell(_) | Body::Imported(_) => false,
            };
            if by_age && !is_shared && level < self.high().z && bodies.iter().any(runs_along) {
                tops[i] = Top::UnderLid(level);
                continue;
            }
            if level < self.high().z && is_shared {
                // The first one's level stands for all that are the same.
                let first = of_bodies.near(level, same).min();
                let lid = first.and_then(|first| levels[first]).unwrap_or(level);
                tops[i] = Top::UnderLid(lid);
                let name = &self.names[bodies[i].volume];
                self.note(format!(
                    "{name} shares its level top at {lid} m with another body"
                ));
            }
        }
        tops
    }

    fn add_shell(&mut self, reaching: &Reaching<'_>, top: Top) -> Result<usize, PlanError> {
        let level = match top {
            Top::Free => None,
            Top::OfDomain => Some(self.high().z),
            Top::UnderLid(level) | Top::UnderHorizon(_, level) => Some(level),
        };
        let flush = match (level, &*reaching.body) {
            // Only troughs have a level top.
            (None, _)
            | (Some(_), Body::Ellipsoid(_) | Body::Shell(_) | Body::Side(_) | Body::Imported(_)) => {
                None
            }
            (Some(level), Body::Trough(trough)) => {
                let raised = trough.raised().map_err(|source| PlanError {
                    volume: self.names[reaching.volume].clone(),
                    source,
                })?;
                Some(Flush { level, raised })
            }
        };
        let body = reaching.body.clone().into_owned();
        let shell = PlannedShell { body, flush };
        self.shells.push(shell);
        Ok(self.shells.len() - 1)
    }

    /// What ends a body with such a top; of a horizon its body for now.
    fn cover(&mut self, top: Top) -> Option<Cover> {
        match top {
            Top::Free | Top::OfDomain => None,
            Top::UnderHorizon(body, _) => Some(Cover::Horizon(body)),
            Top::UnderLid(level) => {
                let known = self.lids.iter().position(|lid| *lid == level);
                Some(Cover::Lid(known.unwrap_or_else(|| {
                    self.lids.push(level);
                    self.lids.len() - 1
                })))
            }
        }
    }
}

/// Bodies by elevations that they have.
struct Sorted(Vec<(f64, usize)>);

impl Sorted {
    fn new(elevations: &[Option<f64>]) -> Self {
        let known = elevations.iter().enumerate();
        let mut known: Vec<(f64, usize)> = known.filter_map(|(at, z)| Some(((*z)?, at))).collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self(known)
    }

    /// The bodies within a distance of an elevation, the lowest first.
    fn near(&self, elevation: f64, distance: f64) -> impl Iterator<Item = usize> {
        // A little lower, for what rounding leaves out.
        let from = elevation - 2.0 * distance;
        let first = self.0.partition_point(|one| one.0 < from);
        self.0[first..]
            .iter()
            .take_while(move |one| one.0 <= elevation + 2.0 * distance)
            .filter(move |one| (one.0 - elevation).abs() <= distance)
            .map(|one| one.1)
    }
}

/// The box of a closed body, bit by bit.
fn box_of(body: &Body) -> Option<[u64; 6]> {
    (!matches!(body, Body::Side(_))).then(|| body.bounds_bits())
}

fn boxes_meet_in_plan(a: &(DVec3, DVec3), b: &(DVec3, DVec3)) -> bool {
    a.0.x <= b.1.x && b.0.x <= a.1.x && a.0.y <= b.1.y && b.0.y <= a.1.y
}
