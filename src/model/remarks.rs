//! What is worth saying of a realisation although it is right: children that miss their parents, volumes that hold nothing.
//!
//! Both are sampled: points inside each body, and beside the sheets of what divides. Few are needed, since only those of
//! which not one point is where it should be are spoken of.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use rayon::prelude::*;

use super::interior::Interior;
use super::kinds;
use super::owner::Owners;
use super::realisation::{Instance, Realisation};
use super::rules::VolumeRules;
use crate::features::body::{Body, Trough};
use crate::nurbs::Surface;

/// Names in a list of volumes; what comes after is counted.
const MOST_NAMES: usize = 6;
/// Points across a trough, and between its base and its top.
const ACROSS: [usize; 2] = [9, 6];
/// Points along a trough.
const ALONG: usize = 192;
/// Distances from an ellipsoid's centre, as fractions of its semi-axes.
const SHELLS: [f64; 3] = [0.3, 0.6, 0.9];
/// Points of an open sheet in u and v: most of it may lie beyond the domain.
const OF_SHEET: usize = 96;
/// How far beside a sheet, as a fraction of the domain's diagonal: less than any bed is thick.
const BESIDE: f64 = 1e-7;
/// Points of the domain in x, y and z.
const OF_DOMAIN: [usize; 3] = [20, 20, 40];
/// Realisations of more bodies than this are not sampled: a build says what is empty.
const MOST_BODIES: usize = 3000;

/// What is to be said of some volumes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// The volumes.
    pub volumes: Vec<usize>,
    /// What, with what to set.
    pub text: String,
}

/// Features whose instances lie outside of the parents that they are drawn for.
pub fn outside_parents(realisation: &Realisation) -> Vec<Remark> {
    // By feature, in the order of their first instances.
    let mut features: Vec<Vec<&Instance>> = Vec::new();
    let mut places: BTreeMap<usize, usize> = BTreeMap::new();
    for instance in &realisation.instances {
        let is_child = realisation.volumes[instance.volume].parent.is_some();
        if !is_child || matches!(instance.body, Body::Side(_)) {
            continue;
        }
        let place = *places.entry(instance.feature).or_insert(features.len());
        if place == features.len() {
            features.push(Vec::new());
        }
        features[place].push(instance);
    }
    features
        .iter()
        .filter_map(|instances| misses(realisation, instances))
        .collect()
}

/// What is to be said of one feature's instances.
fn misses(realisation: &Realisation, instances: &[&Instance]) -> Option<Remark> {
    let parent_of = |child: &Instance| {
        let parent = realisation.volumes[child.volume].parent?;
        Some(&realisation.instances[parent.checked_sub(1)?])
    };
    let mut parents: BTreeMap<usize, Option<Interior>> = BTreeMap::new();
    for child in instances {
        if let Some(parent) = parent_of(child) {
            // A body without an inside is told of where it is looked for.
            let interior = || Interior::of(&parent.body).ok();
            parents.entry(parent.volume).or_insert_with(interior);
        }
    }
    let missing: Vec<&&Instance> = instances
        .par_iter()
        .filter(|child| {
            let Some(parent) = parent_of(child) else {
                return false;
            };
            // Of a shell that shows nothing the parent's own surface is all that is seen.
            if let Body::Shell(shell) = &child.body
                && !shell.sheets().iter().any(|sheet| sheet.0.is_geological())
            {
                return false;
            }
            let (low, high) = child.body.bounds();
            let (from, to) = parent.body.bounds();
            if !(low.cmple(to).all() && from.cmple(high).all()) {
                return true;
            }
            let Some(Some(parent)) = parents.get(&parent.volume) else {
                return false;
            };
            !points_within(&child.body).any(|point| parent.contains(point))
        })
        .collect();
    let (first, count) = (missing.first()?, instances.len());
    let parent = parent_of(first)?;
    let (feature, whose) = (
        &realisation.volumes[first.volume].feature,
        &realisation.volumes[parent.volume].feature,
    );
    let (low, high) = parent.body.bounds();
    let (low, high) = (
        low.max(realisation.extent.low()),
        high.min(realisation.extent.high()),
    );
    let kind = &realisation.volumes[first.volume].kind;
    let what = kinds::named(kind).map_or("move it", |kind| kind.nature.placed_by);
    let [low, high] = [low, high].map(|corner| corner.to_array().map(tidy));
    let volumes: Vec<usize> = missing.iter().map(|child| child.volume).collect();
    let list = names(realisation, &volumes);
    let missed = if count == 1 {
        format!("{list} lies outside of its parent {whose} and holds nothing")
    } else {
        format!(
            "{} of {count} volumes of {feature} lie outside of their parent {whose} and hold nothing ({list})",
            volumes.len()
        )
    };
    let text = format!(
        "{missed}; {what} within the parent: x {} to {}, y {} to {}, z {} to {}",
        low[0], high[0], low[1], high[1], low[2], high[2]
    );
    Some(Remark { volumes, text })
}

/// Volumes of which not one point was found, though some thousand were tried.
pub fn empty(realisation: &Realisation, owners: &Owners) -> Vec<usize> {
    if realisation.instances.len() > MOST_BODIES {
        return Vec::new();
    }
    let mut found = vec![false; realisation.volumes.len()];
    for owner in over_the_domain(owners) {
        found[owner] = true;
    }
    let rest: Vec<&Instance> = realisation
        .instances
        .iter()
        .filter(|instance| !found[realisation.rules.whole(instance.volume)])
        .collect();
    let diagonal = owners.extent().low().distance(owners.extent().high());
    // Of what is a piece of another volume any will do.
    let whole = |instance: &Instance| realisation.rules.whole(instance.volume);
    let shown: BTreeSet<usize> = rest
        .par_iter()
        .filter(|instance| {
            let holds = |point: DVec3| owners.at(point) == Some(whole(instance));
            match &instance.body {
                Body::Side(side) => side
                    .sheets()
                    .iter()
                    .any(|sheet| beside(sheet, BESIDE * diagonal).any(holds)),
                body => points_within(body).any(holds),
            }
        })
        .map(|instance| whole(instance))
        .collect();
    let wholes: BTreeSet<usize> = rest.iter().map(|instance| whole(instance)).collect();
    wholes.difference(&shown).copied().collect()
}

/// How it is known that volumes hold nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// No point was found in them; a piece may have been missed if it is small.
    ByPoints,
    /// They have no solids.
    BySolids,
}

/// Which volumes hold nothing, feature by feature, if none of the remarks has told of them. A unit that something divides into many
/// is meant to have nothing left.
pub fn say_empty(
    realisation: &Realisation,
    empty: &[usize],
    how: Known,
    told: &[Remark],
) -> Vec<String> {
    let [one_holds, many_hold] = match how {
        Known::ByPoints => ["seems to hold", "seem to hold"],
        Known::BySolids => ["holds", "hold"],
    };
    let volumes = &realisation.volumes;
    let is_set = |volume: &VolumeRules| {
        let kind = kinds::named(&volume.kind);
        kind.is_some_and(|kind| kind.nature.is_many())
    };
    let parts = volumes.iter().filter(|part| is_set(part));
    let divided: BTreeSet<usize> = parts
        .filter_map(|part| part.from)
        .filter(|from| !is_set(&volumes[*from]))
        .collect();
    let is_told: BTreeSet<usize> = told
        .iter()
        .flat_map(|remark| remark.volumes.iter().copied())
        .collect();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let is_counted = |one: &&VolumeRules| one.piece_of.is_none() && one.block.within.is_none();
    for volume in volumes.iter().filter(is_counted) {
        *counts.entry(&volume.feature).or_default() += 1;
    }
    // By feature, in the order of their first volumes.
    let mut features: Vec<(&str, Vec<usize>)> = Vec::new();
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    let is_empty: BTreeSet<usize> = empty.iter().copied().collect();
    // By name, whether some block has something of what faults part.
    let mut in_blocks: BTreeMap<&str, bool> = BTreeMap::new();
    for (volume, rules) in volumes.iter().enumerate() {
        if !rules.block.name.is_empty() && rules.piece_of.is_none() {
            *in_blocks.entry(rules.unfaulted_name()).or_default() |= !is_empty.contains(&volume);
        }
    }
    for volume in empty {
        let rules = &volumes[*volume];
        let is_elsewhere = in_blocks.get(rules.unfaulted_name()) == Some(&true);
        if is_elsewhere || rules.block.within.is_some() || rules.block.is_ground {
            continue;
        }
        if divided.contains(volume) || is_told.contains(volume) {
            continue;
        }
        let feature = volumes[*volume].feature.as_str();
        let place = *places.entry(feature).or_insert(features.len());
        if place == features.len() {
            features.push((feature, Vec::new()));
        }
        features[place].1.push(*volume);
    }
    let say = |(feature, ours): (&str, Vec<usize>)| {
        let all = counts[feature];
        let list = names(realisation, &ours);
        if all == 1 {
            format!("{list} {one_holds} nothing: it lies outside, or others hold all of it")
        } else {
            format!(
                "{} of {all} volumes of {feature} {many_hold} nothing: they lie outside, or others hold all of them ({list})",
                ours.len()
            )
        }
    };
    features.into_iter().map(say).collect()
}

fn names(realisation: &Realisation, volumes: &[usize]) -> String {
    let shown = &volumes[..volumes.len().min(MOST_NAMES)];
    let mut list: Vec<&str> = shown
        .iter()
        .map(|volume| realisation.volumes[*volume].name.as_str())
        .collect();
    if shown.len() < volumes.len() {
        list.push("…");
    }
    list.join(", ")
}

/// Owners at the middles of cells of the domain.
fn over_the_domain(owners: &Owners) -> Vec<usize> {
    let (low, size) = (
        owners.extent().low(),
        owners.extent().high() - owners.extent().low(),
    );
    let [nx, ny, nz] = OF_DOMAIN;
    let middle = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    (0..nx * ny)
        .into_par_iter()
        .flat_map_iter(|column| {
            let (x, y) = (middle(column % nx, nx), middle(column / nx, ny));
            (0..nz).filter_map(move |k| owners.at(low + size * DVec3::new(x, y, middle(k, nz))))
        })
        .collect()
}

/// Points inside a closed body; none of a side.
fn points_within(body: &Body) -> Box<dyn Iterator<Item = DVec3> + '_> {
    match body {
        Body::Trough(trough) => Box::new(points_of_trough(trough)),
        Body::Ellipsoid(ellipsoid) => {
            let (center, axes) = (ellipsoid.center(), ellipsoid.axes());
            let directions = super::interior::around(DVec3::ZERO, 1.0).map(DVec3::normalize);
            let at = move |direction: DVec3, reach: f64| {
                let step = direction * reach;
                center + axes[0] * step.x + axes[1] * step.y + axes[2] * step.z
            };
            let shells = directions.flat_map(move |direction| {
                SHELLS.into_iter().map(move |reach| at(direction, reach))
            });
            Box::new(std::iter::once(center).chain(shells))
        }
        Body::Shell(shell) => {
            let (low, high) = shell.bounds();
            let geological = shell
                .sheets()
                .iter()
                .filter(|sheet| sheet.0.is_geological());
            let distance = BESIDE * low.distance(high);
            let points = geological.flat_map(move |sheet| beside(&sheet.1, distance));
            Box::new(points.filter(|point| shell.contains(*point)))
        }
        Body::Imported(imported) => {
            let (low, high) = imported.bounds();
            let distance = BESIDE * low.distance(high);
            let surfaces = imported.surfaces().iter();
            let points = surfaces.flat_map(move |surface| beside(surface, distance));
            Box::new(points.filter(|point| imported.inside().contains(*point)))
        }
        Body::Side(_) => Box::new(std::iter::empty()),
    }
}

/// Between base and top, at equal fractions of both from rim to rim.
fn points_of_trough(trough: &Trough) -> impl Iterator<Item = DVec3> + '_ {
    let (base, top) = (trough.base(), trough.top());
    let ((u0, u1), (t0, t1)) = (base.knots_u().domain(), top.knots_u().domain());
    let (v0, v1) = base.knots_v().domain();
    let part = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let [across, up] = ACROSS;
    scattered(ALONG * across).flat_map(move |at| {
        let v = v0 + (v1 - v0) * part(at / across, ALONG);
        let u = part(at % across, across);
        let (low, high) = (
            base.point(u0 + (u1 - u0) * u, v),
            top.point(t0 + (t1 - t0) * u, v),
        );
        (0..up).map(move |k| low.lerp(high, part(k, up)))
    })
}

/// Points a little to either side of a sheet.
fn beside(sheet: &Surface, distance: f64) -> impl Iterator<Item = DVec3> + '_ {
    let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
    let part = |i: usize| (i as f64 + 0.5) / OF_SHEET as f64;
    scattered(OF_SHEET * OF_SHEET).flat_map(move |at| {
        let (u, v) = (
            u0 + (u1 - u0) * part(at % OF_SHEET),
            v0 + (v1 - v0) * part(at / OF_SHEET),
        );
        let point = sheet.point(u, v);
        let normal = sheet.normal(u, v).unwrap_or(DVec3::Z) * distance;
        [point - normal, point + normal]
    })
}

/// All numbers below one, each once, and those that follow each other far apart. The count is a product of twos and threes.
fn scattered(count: usize) -> impl Iterator<Item = usize> {
    // About the golden section of it, and without a divisor in common.
    let least = count * 618 / 1000;
    let step = 6 * (least / 6) + 1;
    (0..count).map(move |k| k * step % count)
}

/// To a millimetre, and without a negative zero.
fn tidy(length: f64) -> f64 {
    (length * 1e3).round() / 1e3 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scattered_numbers_are_all_there_and_soon_everywhere() {
        for count in [ALONG * ACROSS[0], OF_SHEET * OF_SHEET] {
            let all: Vec<usize> = scattered(count).collect();
            let mut sorted = all.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..count));
            let tenths: BTreeSet<usize> = all[..20].iter().map(|at| at * 10 / count).collect();
            assert_eq!(tenths.len(), 10);
        }
    }
}
