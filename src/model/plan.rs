//! The assembly plan: what the kernel has to do, decided in pure Rust.
//!
//! Coincidences that no kernel resolves reliably are decided here, by what the model means:
//!
//! - a body that does not reach into the domain takes no part;
//! - bodies with the same shell (a feature repeated without any draw) share one;
//! - *level tops that coincide*, with the domain's top or with each other, are marked as flush, so that
//!   the kernel is given one plane for all of them, or, as a remedy, no coincident faces at all: the
//!   bodies' banks are raised above their tops, and a **lid** cuts them there. Inside means then inside
//!   the raised shell and below the lid; every contact is a crossing at an angle, and nothing changes
//!   inside the bodies. The domain's own top serves as lid for bodies that reach it.

use std::sync::Arc;

use glam::DVec3;

use super::realisation::{Instance, Realisation};
use super::rules::Rules;
use crate::features::body::{Body, Trough, TroughError};
use crate::features::extent::Extent;
use crate::features::side::Side;

/// Two levels are the same within this fraction of the domain's size: far below any geology, far
/// above rounding.
const SAME_LEVEL: f64 = 1e-9;

/// What the kernel has to assemble.
#[derive(Clone, Debug)]
pub struct AssemblyPlan {
    /// The domain: a block, with the base and the top that bound it there.
    pub extent: Extent,
    /// Which volume holds what.
    pub rules: Rules,
    /// The volumes' names, for messages.
    pub names: Vec<String>,
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
            shells: Vec::new(),
            lids: Vec::new(),
            bodies: Vec::new(),
            decisions: Vec::new(),
        };
        let reaching: Vec<&Instance> = realisation
            .instances
            .iter()
            .filter(|instance| plan.reaches_domain(&instance.body, instance.volume))
            .collect();
        let tops = plan.tops(&reaching);
        let mut known: Vec<(&Body, Top, usize)> = Vec::new();
        for (instance, &top) in reaching.iter().zip(&tops) {
            let same =
                |(body, other, _): &&(&Body, Top, usize)| *other == top && **body == instance.body;
            let shell = if let Some(&(_, _, shell)) = known.iter().find(same) {
                plan.note(format!(
                    "{} has the shell of an older body",
                    plan.names[instance.volume]
                ));
                shell
            } else {
                let shell = plan.add_shell(instance, top)?;
                known.push((&instance.body, top, shell));
                shell
            };
            let below = plan.cover(top);
            plan.bodies.push(PlannedBody {
                volume: instance.volume,
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

    /// Whether anything but closed bodies takes part.
    pub fn has_sides(&self) -> bool {
        let is_side = |shell: &PlannedShell| matches!(shell.body, Body::Side(_));
        self.bounds().next().is_some() || self.shells.iter().any(is_side)
    }

    /// The base and the top of the domain that are not the block's own: each with whether it is the top.
    pub fn bounds(&self) -> impl Iterator<Item = (bool, &Arc<Side>)> {
        let bounds = self.extent.bounds().iter().zip([false, true]);
        bounds.filter_map(|(side, is_top)| side.as_ref().map(|side| (is_top, side)))
    }

    fn note(&mut self, decision: String) {
        self.decisions.push(decision);
    }

    /// Whether a body's box meets the inside of the domain.
    fn reaches_domain(&mut self, body: &Body, volume: usize) -> bool {
        let (low, high) = body.bounds();
        let reaches = low.cmplt(self.high()).all() && high.cmpgt(self.low()).all();
        if !reaches {
            self.note(format!("{} lies outside the domain", self.names[volume]));
        }
        reaches
    }

    /// Which bodies end at the domain's top or under a common lid.
    fn tops(&mut self, bodies: &[&Instance]) -> Vec<Top> {
        let size = (self.high() - self.low()).max_element();
        let same = SAME_LEVEL * size;
        let levels: Vec<Option<f64>> = bodies.iter().map(|one| one.body.level_top(same)).collect();
        let bounds: Vec<_> = bodies.iter().map(|one| one.body.bounds()).collect();
        let mut tops = vec![Top::Free; bodies.len()];
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
            let horizon = bodies.iter().position(|one| {
                let Body::Side(side) = &one.body else {
                    return false;
                };
                side.level()
                    .is_some_and(|other| (other - level).abs() <= same)
            });
            if let Some(body) = horizon {
                tops[i] = Top::UnderHorizon(body, level);
                self.note(format!(
                    "{} ends at the horizon of {}",
                    self.names[bodies[i].volume], self.names[bodies[body].volume]
                ));
                continue;
            }
            let meets = |j: &usize| {
                *j != i
                    && levels[*j].is_some_and(|other| (other - level).abs() <= same)
                    && boxes_meet_in_plan(&bounds[i], &bounds[*j])
            };
            if level < self.high().z && (0..bodies.len()).any(|j| meets(&j)) {
                // The first one's level stands for all that are the same.
                let lid = levels
                    .iter()
                    .flatten()
                    .copied()
                    .find(|other| (other - level).abs() <= same)
                    .unwrap_or(level);
                tops[i] = Top::UnderLid(lid);
                let name = &self.names[bodies[i].volume];
                self.note(format!(
                    "{name} shares its level top at {lid} m with another body"
                ));
            }
        }
        tops
    }

    fn add_shell(&mut self, instance: &Instance, top: Top) -> Result<usize, PlanError> {
        let level = match top {
            Top::Free => None,
            Top::OfDomain => Some(self.high().z),
            Top::UnderLid(level) | Top::UnderHorizon(_, level) => Some(level),
        };
        let flush = match (level, &instance.body) {
            // Only troughs have a level top.
            (None, _) | (Some(_), Body::Ellipsoid(_) | Body::Side(_)) => None,
            (Some(level), Body::Trough(trough)) => {
                let raised = trough.raised().map_err(|source| PlanError {
                    volume: self.names[instance.volume].clone(),
                    source,
                })?;
                Some(Flush { level, raised })
            }
        };
        let body = instance.body.clone();
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

fn boxes_meet_in_plan(a: &(DVec3, DVec3), b: &(DVec3, DVec3)) -> bool {
    a.0.x <= b.1.x && b.0.x <= a.1.x && a.0.y <= b.1.y && b.0.y <= a.1.y
}
