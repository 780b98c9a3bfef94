//! Instances made: drawn and built, each after its host and all that it refers to.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::listing::{Due, Listing};
use super::{RealisationError, draw_whole};
use crate::model::draws::{Key, attempt};
use crate::model::interior::Interior;
use crate::model::kinds::made::{Frame, Made, Part, Site};
use crate::model::spec::Model;

/// What was made of an instance.
pub(super) struct Built {
    pub(super) made: Made,
    /// The reasons of its rejected attempts.
    pub(super) rejected: Vec<&'static str>,
}

/// Makes all instances, in the order of their list.
pub(super) fn make_all(model: &Model, list: &Listing<'_>) -> Result<Vec<Built>, RealisationError> {
    let due = &list.due;
    let highest = due.iter().map(|one| one.rank).max().unwrap_or(0);
    let domain = Frame::Unit(list.domain_bound(false)?);
    let mut built: Vec<Option<Built>> = due.iter().map(|_| None).collect();
    for rank in 0..=highest {
        let generation: Vec<usize> = (0..due.len()).filter(|at| due[*at].rank == rank).collect();
        let interiors = interiors(model, due, &generation, &built)?;
        let make = |at: usize| {
            let one = &due[at];
            let host = one.along.or(one.parent);
            let host =
                host.and_then(|host| Some((due[host].name.as_str(), &built[host].as_ref()?.made)));
            let refers = model.features[one.feature].kind.refers();
            let of = |other: Option<usize>| Some(&built[other?].as_ref()?.made);
            let others: Vec<_> = refers
                .into_iter()
                .zip(&one.referents)
                .filter_map(|(reference, other)| Some((reference, of(*other)?)))
                .collect();
            let site = Site {
                domain: &model.domain,
                interior: one.parent.and_then(|parent| interiors.get(&parent)),
                surface: list.surface(one.feature),
                frame: host.map_or(&domain, |host| &host.1.frame),
                host,
                others: &others,
                top: one.top.as_ref(),
                nudge: one.nudge,
            };
            Ok((at, build(model, one, &site)?))
        };
        let generation: Vec<Result<_, RealisationError>> =
            generation.into_par_iter().map(make).collect();
        for result in generation {
            let (at, one) = result?;
            built[at] = Some(one);
        }
    }
    Ok(built.into_iter().flatten().collect())
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
fn build(model: &Model, due: &Due, site: &Site<'_>) -> Result<Built, RealisationError> {
    let feature = &model.features[due.feature];
    let draw = |key: Key<'_>| attempt(key, |draws| feature.kind.make(site, draws));
    let ((made, _), rejected) =
        draw_whole(model, &feature.id, &due.number, draw).map_err(|error| error.of(&due.name))?;
    Ok(Built { made, rejected })
}
