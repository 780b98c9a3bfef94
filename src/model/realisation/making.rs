//! Instances made: drawn and built, each after its host and all that it refers to.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use rayon::prelude::*;

use super::listing::{Due, Listing};
use super::{RealisationError, draw_whole};
use crate::features::body::Body;
use crate::features::fabric::Fabric;
use crate::model::domain::Domain;
use crate::model::draws::{Draws, Key, attempt};
use crate::model::interior::Interior;
use crate::model::kinds::made::{Frame, Made, Part, Site};
use crate::model::spec::Model;
use crate::model::warp::{Warp, Warped};

/// What was made of an instance.
pub(super) struct Built {
    pub(super) made: Made,
    /// The reasons of its rejected attempts.
    pub(super) rejected: Vec<&'static str>,
    /// What it conforms to, by itself or with its host, with the level that comes to lie there.
    warp: Option<Arc<Warp>>,
    /// Its parts' bodies where they conform.
    warped: Vec<Warped>,
}

impl Built {
    /// The same with its bodies where they conform, and what was reached, for the report.
    fn conforming(mut self) -> Self {
        let Some(warp) = self.warp.take() else {
            return self;
        };
        let (mut deviation, mut steepest) = (0.0_f64, 0.0_f64);
        for (part, warped) in self
            .made
            .parts
            .iter_mut()
            .zip(std::mem::take(&mut self.warped))
        {
            deviation = deviation.max(warped.deviation);
            steepest = steepest.max(warped.steepest);
            // As a shell it does not tell its axes any more.
            if let Body::Ellipsoid(ellipsoid) = &part.body {
                part.fabric.get_or_insert(Fabric::of_ellipsoid(ellipsoid));
            }
            part.slope = warped.slope;
            part.body = warped.body;
        }
        self.made.decisions.push(warp.told(deviation, steepest));
        self
    }
}

/// Makes all instances, in the order of their list.
pub(super) fn make_all(model: &Model, list: &Listing<'_>) -> Result<Vec<Built>, RealisationError> {
    let due = &list.due;
    let highest = due.iter().map(|one| one.rank).max().unwrap_or(0);
    let base = list.domain_bound(false)?;
    let mut built: Vec<Option<Built>> = due.iter().map(|_| None).collect();
    for rank in 0..=highest {
        let generation: Vec<usize> = (0..due.len()).filter(|at| due[*at].rank == rank).collect();
        let interiors = interiors(model, due, &generation, &built)?;
        let make = |at: usize| {
            let one = &due[at];
            let host = one.along.or(one.parent);
            let host = host.and_then(|host| Some((due[host].name.as_str(), built[host].as_ref()?)));
            let refers = model.features[one.feature].refers();
            let of = |other: Option<usize>| Some(&built[other?].as_ref()?.made);
            let others: Vec<_> = refers
                .into_iter()
                .zip(&one.referents)
                .filter_map(|(reference, other)| Some((reference, of(*other)?)))
                .collect();
            let room = room(model, due, one, &built);
            let [lower, higher] = [room.z[0] - model.domain.z[0], room.z[1] - model.domain.z[1]];
            // What bounds the domain bounds nothing of what comes into it from beyond.
            let top = match &one.top {
                Some(top) if one.is_top_of_domain => Some(top.lowered(-higher)),
                other => other.clone(),
            };
            let lowest = Frame::Unit(base.lowered(-lower));
            let site = Site {
                domain: &model.domain,
                room: &room,
                interior: one.parent.and_then(|parent| interiors.get(&parent)),
                surface: list.surface(one.feature),
                is_child: one.parent.is_some(),
                frame: host.map_or(&lowest, |host| &host.1.made.frame),
                host: host.map(|(name, host)| (name, &host.made)),
                others: &others,
                top: top.as_ref(),
                nudge: one.nudge,
                warp: None,
            };
            let inherited = host.and_then(|host| host.1.warp.as_ref());
            Ok((at, build(model, one, &site, inherited)?))
        };
        let generation: Vec<Result<_, RealisationError>> =
            generation.into_par_iter().map(make).collect();
        for result in generation {
            let (at, one) = result?;
            built[at] = Some(one);
        }
    }
    Ok(built.into_iter().flatten().map(Built::conforming).collect())
}

/// The domain, and whatever comes to lie in it by the events that move an instance.
fn room(model: &Model, due: &[Due], one: &Due, built: &[Option<Built>]) -> Domain {
    let mut room = model.domain.clone();
    let (mut low, mut high) = room.corners();
    for event in one.events.iter().rev() {
        let of_feature = due
            .iter()
            .zip(built)
            .rev()
            .filter(|(due, _)| due.feature == *event);
        for (_, made) in of_feature.filter(|(due, _)| due.takes_part) {
            let event = made.as_ref().and_then(|made| made.made.event.as_ref());
            if let Some(event) = event {
                let [from, to] = event.motion.before([low, high]);
                (low, high) = (low.min(from), high.max(to));
            }
        }
    }
    for (axis, range) in [&mut room.x, &mut room.y, &mut room.z]
        .into_iter()
        .enumerate()
    {
        *range = [low[axis], high[axis]];
    }
    room
}

/// What those parents hold by which their children are placed.
fn interiors(
    model: &Model,
    due: &[Due],
    children: &[usize],
    built: &[Option<Built>],
) -> Result<BTreeMap<usize, Interior>, RealisationError> {
    let wanted: BTreeSet<usize> = children
        .iter()
        .map(|at| &due[*at])
        .filter(|one| model.features[one.feature].kind.wants_interior())
        .filter_map(|one| one.parent)
        .collect();
    let parents: Vec<_> = wanted
        .into_iter()
        .filter_map(|at| Some((at, built[at].as_ref()?.made.parts.first()?)))
        .collect();
    let interior = |(at, parent): (usize, &Part)| {
        let interior =
            Interior::of(&parent.body).map_err(|error| RealisationError::Impossible {
                volume: due[at].name.clone(),
                reason: format!("no child can be placed in it: {error}"),
            })?;
        Ok((at, interior))
    };
    parents.into_par_iter().map(interior).collect()
}

/// Draws and builds one instance.
fn build(
    model: &Model,
    due: &Due,
    site: &Site<'_>,
    inherited: Option<&Arc<Warp>>,
) -> Result<Built, RealisationError> {
    let feature = &model.features[due.feature];
    let make = |draws: &mut Draws<'_>| {
        let own = match &feature.conform {
            Some(conform) => Some(draws.warp(conform, site.sheet(&conform.to)?)?),
            None => None,
        };
        let site = Site {
            warp: own.as_ref(),
            ..*site
        };
        let made = feature.kind.make(&site, draws)?;
        // What lies in it moves with it, whatever its own level is.
        let level = made.parts.first().map_or(0.0, Part::level);
        let own = own.map(|warp| Arc::new(warp.at(level)));
        let warp = own.or_else(|| inherited.cloned());
        let warped = match &warp {
            Some(warp) => {
                let parts = made.parts.iter();
                parts
                    .map(|part| warp.apply(&part.body))
                    .collect::<Result<_, _>>()?
            }
            None => Vec::new(),
        };
        Ok((made, warp, warped))
    };
    let draw = |key: Key<'_>| attempt(key, make);
    let (((made, warp, warped), _), rejected) =
        draw_whole(model, &feature.id, &due.number, draw).map_err(|error| error.of(&due.name))?;
    Ok(Built {
        made,
        rejected,
        warp,
        warped,
    })
}
