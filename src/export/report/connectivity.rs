//! How net rock hangs together: groups of net solids that share enough area, and by how much volumes differ.
//!
//! ```text
//! Γ = Σ V_g² / (Σ V_g)²         chance that two places in net rock, drawn at random, lie in one group
//! L = 2 (∫ F dΦ − ½)            Lorenz: F the share of Σ k V, Φ that of Σ φ V, in the order of falling k/φ
//! V_DP = 1 − k₈₄ / k₅₀          Dykstra and Parsons: k₈₄ is exceeded by 84 % of the rock
//! ```
//! A volume is net by its `net`, of which a fraction weighs its volume; volumes that do not say take no part, and are named.

use std::collections::BTreeMap;

use super::entries::{ConnectivityEntry, HeterogeneityEntry, NetGroupEntry, UnitEntry};
use super::parts::{Parts, names_of_solids};
use super::totals::{Share, part_of};
use crate::model::Property;

/// Two bodies that share less than this are not connected, unless something else is asked for (m²).
pub const LEAST_AREA: f64 = 1.0;

/// A body with its net volume, and what it shares with others.
struct Web {
    /// Net volume of each (m³); none of what is not net, or does not say.
    net: Vec<Option<f64>>,
    /// Pairs with the area that they share (m²).
    contacts: Vec<(usize, usize, f64)>,
}

impl Web {
    /// Groups of those that hang together by contacts of some area at least, largest first.
    fn groups(&self, least_area: f64) -> Vec<Vec<usize>> {
        let mut group: Vec<usize> = (0..self.net.len()).collect();
        for (a, b, area) in &self.contacts {
            if *area >= least_area && self.net[*a].is_some() && self.net[*b].is_some() {
                let (a, b) = (root(&group, *a), root(&group, *b));
                group[a.max(b)] = a.min(b);
            }
        }
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for at in (0..self.net.len()).filter(|at| self.net[*at].is_some()) {
            members.entry(root(&group, at)).or_default().push(at);
        }
        let mut groups: Vec<Vec<usize>> = members.into_values().collect();
        groups.sort_by(|a, b| self.size(b).total_cmp(&self.size(a)).then_with(|| a.cmp(b)));
        groups
    }

    fn size(&self, members: &[usize]) -> f64 {
        members.iter().filter_map(|at| self.net[*at]).sum()
    }

    /// Of the area of all contacts of net bodies, each counted once, the share that lies between two of them.
    fn amalgamation(&self) -> Option<f64> {
        let (mut between, mut all) = (0.0, 0.0);
        for (a, b, area) in &self.contacts {
            match (self.net[*a], self.net[*b]) {
                (Some(_), Some(_)) => {
                    between += area;
                    all += area;
                }
                (None, None) => {}
                _ => all += area,
            }
        }
        (all > 0.0).then(|| between / all)
    }
}

fn root(group: &[usize], mut at: usize) -> usize {
    while group[at] != at {
        at = group[at];
    }
    at
}

/// Γ of groups by their sizes.
fn gamma(sizes: &[f64]) -> Option<f64> {
    let all: f64 = sizes.iter().sum();
    (all > 0.0).then(|| sizes.iter().map(|size| size * size).sum::<f64>() / (all * all))
}

/// Rock with its permeability (mD), porosity and volume (m³).
type Rock = (f64, f64, f64);

/// The Lorenz coefficient: 0 of what is all the same, towards 1 where little rock carries all flow.
fn lorenz(rock: &[Rock]) -> Option<f64> {
    let mut rock: Vec<Rock> = rock.iter().copied().filter(|one| one.2 > 0.0).collect();
    rock.sort_by(|a, b| (b.0 * a.1).total_cmp(&(a.0 * b.1)));
    let flow: f64 = rock.iter().map(|(k, _, size)| k * size).sum();
    let store: f64 = rock.iter().map(|(_, porosity, size)| porosity * size).sum();
    if !(flow > 0.0 && store > 0.0) {
        return None;
    }
    let (mut under, mut carried) = (0.0, 0.0);
    for (k, porosity, size) in rock {
        let more = k * size / flow;
        under += (carried + 0.5 * more) * porosity * size / store;
        carried += more;
    }
    Some((2.0 * under - 1.0).max(0.0))
}

/// The coefficient of Dykstra and Parsons, by volume.
fn dykstra_parsons(rock: &[Rock]) -> Option<f64> {
    let mut rock: Vec<Rock> = rock.iter().copied().filter(|one| one.2 > 0.0).collect();
    rock.sort_by(|a, b| b.0.total_cmp(&a.0));
    let all: f64 = rock.iter().map(|one| one.2).sum();
    let exceeded_by = |share: f64| {
        let mut sum = 0.0;
        let reached = |one: &&Rock| {
            sum += one.2;
            sum >= share * all * (1.0 - 1e-12)
        };
        rock.iter().find(reached).map(|one| one.0)
    };
    let (low, middle) = (exceeded_by(0.84)?, exceeded_by(0.5)?);
    (middle > 0.0).then(|| 1.0 - low / middle)
}

/// How the net solids of an assembly hang together.
pub(super) fn connectivity(parts: Parts<'_>) -> ConnectivityEntry {
    let measured = &parts.assembly.measured;
    let pieces = &measured.pieces;
    let properties = &parts.realisation.properties;
    let mut position = vec![0; pieces.len()];
    for (at, piece) in pieces.iter().enumerate() {
        position[piece.solid] = at;
    }
    let net = |volume: usize| properties[volume].scalar("net");
    let web = Web {
        net: pieces
            .iter()
            .map(|piece| Some(net(piece.volume)? * piece.size).filter(|size| *size > 0.0))
            .collect(),
        contacts: measured
            .shared
            .iter()
            .map(|((a, b), area)| (position[*a], position[*b], *area))
            .collect(),
    };
    let names = names_of_solids(parts);
    let found = web.groups(parts.least_area);
    let sizes: Vec<f64> = found.iter().map(|members| web.size(members)).collect();
    let all: f64 = sizes.iter().sum();
    let silent = pieces.iter().filter(|piece| net(piece.volume).is_none());
    ConnectivityEntry {
        least_area_m2: parts.least_area,
        unknown_net: facies_of(parts, silent.map(|piece| piece.volume)),
        largest_share: sizes.first().map(|largest| largest / all),
        gamma: gamma(&sizes),
        amalgamation: web.amalgamation(),
        groups: found
            .iter()
            .zip(&sizes)
            .map(|(members, size)| NetGroupEntry {
                solids: members.iter().map(|at| names[*at].clone()).collect(),
                net_volume_m3: *size,
                share: size / all,
            })
            .collect(),
    }
}

/// The facies of some volumes, each once.
fn facies_of(parts: Parts<'_>, volumes: impl Iterator<Item = usize>) -> Vec<String> {
    let facies = |volume: usize| parts.realisation.volumes[volume].facies.clone();
    let mut names: Vec<String> = volumes.map(facies).collect();
    names.sort();
    names.dedup();
    names
}

/// The net rock of each unit: that of each horizon with all that lies in it, and the background with all else.
pub(super) fn units(parts: Parts<'_>) -> Vec<UnitEntry> {
    let volumes = &parts.realisation.volumes;
    let unit_of = |volume: usize| {
        let mut at = volume;
        // What goes along something lies where that does.
        while let Some(above) = volumes[at].along.or(volumes[at].parent) {
            at = above;
        }
        if volumes[at].kind == "horizon" { at } else { 0 }
    };
    // A unit that faults part is one.
    let mut wholes: BTreeMap<&str, usize> = BTreeMap::new();
    for (volume, rules) in volumes.iter().enumerate() {
        wholes.entry(rules.unfaulted_name()).or_insert(volume);
    }
    let unit_of = |volume: usize| {
        let unit = unit_of(volume);
        wholes
            .get(volumes[unit].unfaulted_name())
            .copied()
            .unwrap_or(unit)
    };
    let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for volume in 0..volumes.len() {
        members.entry(unit_of(volume)).or_default().push(volume);
    }
    let entry = |(unit, members): (&usize, &Vec<usize>)| {
        let measured = &parts.assembly.measured;
        let present = members
            .iter()
            .copied()
            .filter(|at| measured.size_of(*at) > 0.0);
        let shares: Vec<Share<'_>> = present
            .clone()
            .map(|volume| Share {
                facies: &volumes[volume].facies,
                size: measured.size_of(volume),
                rock: &parts.realisation.properties[volume],
            })
            .collect();
        let size: f64 = shares.iter().map(|one| one.size).sum();
        let net: Option<f64> = shares.iter().map(|one| part_of(one, &["net"])).sum();
        let silent = present.filter(|at| parts.realisation.properties[*at].scalar("net").is_none());
        UnitEntry {
            unit: volumes[*unit].unfaulted_name().to_owned(),
            volume_m3: size,
            net_volume_m3: net,
            net_to_gross: net.filter(|_| size > 0.0).map(|net| net / size),
            unknown_net: facies_of(parts, silent),
        }
    };
    members.iter().map(entry).collect()
}

/// How much the net volumes differ; nothing where one of them lacks permeability or porosity.
pub(super) fn heterogeneity(parts: Parts<'_>) -> HeterogeneityEntry {
    let measured = &parts.assembly.measured;
    let each = parts.realisation.properties.iter().enumerate();
    let net = each.filter_map(|(volume, rock)| {
        let size = measured.size_of(volume) * rock.scalar("net")?;
        (size > 0.0).then_some((rock, size))
    });
    let rock: Option<Vec<Rock>> = net
        .map(|(rock, size)| {
            let k = level_permeability(&rock.get("permeability")?);
            Some((k, rock.scalar("porosity")?, size))
        })
        .collect();
    let rock = rock.unwrap_or_default();
    HeterogeneityEntry {
        lorenz: lorenz(&rock),
        dykstra_parsons: dykstra_parsons(&rock),
    }
}

/// The mean permeability along the level axes (mD): the root of their product.
fn level_permeability(permeability: &Property) -> f64 {
    let tensor = permeability.tensor();
    (tensor[0][0] * tensor[1][1]).sqrt()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    /// Bodies of 1, 2, … m³ in a row, with these areas from one to the next.
    fn row(net: &[f64], areas: &[f64]) -> Web {
        let contacts = areas.iter().enumerate();
        Web {
            net: net.iter().map(|one| (*one > 0.0).then_some(*one)).collect(),
            contacts: contacts.map(|(at, area)| (at, at + 1, *area)).collect(),
        }
    }

    #[test]
    fn groups_of_three_to_one_are_connected_with_a_chance_of_five_eighths() {
        let web = row(&[1.0, 2.0, 0.0, 1.0], &[5.0, 9.0, 9.0]);
        let groups = web.groups(1.0);
        assert_eq!(groups, [vec![0, 1], vec![3]]);
        let sizes: Vec<f64> = groups.iter().map(|one| web.size(one)).collect();
        assert_eq!(gamma(&sizes), Some(0.625));
        assert_eq!(sizes[0] / sizes.iter().sum::<f64>(), 0.75);
    }

    #[test]
    fn contacts_below_the_least_area_connect_nothing() {
        let web = row(&[1.0, 1.0, 1.0], &[0.99, 1.0]);
        assert_eq!(web.groups(1.0), [vec![1, 2], vec![0]]);
        assert_eq!(web.groups(0.5), [vec![0, 1, 2]]);
        assert_eq!(gamma(&[]), None);
    }

    #[test]
    fn a_chain_of_contacts_in_any_order_is_one_group() {
        let mut web = row(&[1.0; 6], &[2.0; 5]);
        web.contacts.reverse();
        assert_eq!(web.groups(1.0).len(), 1);
        web.contacts.rotate_left(2);
        assert_eq!(web.groups(1.0).len(), 1);
    }

    #[test]
    fn amalgamation_is_the_share_of_contacts_between_net_bodies() {
        assert_eq!(
            row(&[1.0, 1.0, 0.0, 0.0], &[3.0, 1.0, 50.0]).amalgamation(),
            Some(0.75)
        );
        assert_eq!(row(&[0.0, 0.0], &[3.0]).amalgamation(), None);
    }

    #[test]
    fn two_equal_layers_of_nine_to_one_have_a_lorenz_coefficient_of_two_fifths() {
        let rock = [(1.0, 0.2, 10.0), (9.0, 0.2, 10.0)];
        assert!((lorenz(&rock).unwrap() - 0.4).abs() < 1e-15);
        assert!(lorenz(&[(5.0, 0.1, 1.0), (10.0, 0.2, 7.0)]).unwrap() < 1e-15);
        assert_eq!(lorenz(&[]), None);
    }

    #[test]
    fn dykstra_parsons_of_a_lognormal_is_one_less_the_exponential_of_its_deviation() {
        // Quantiles of a lognormal with a deviation of 1, by the rational approximation of Hastings to 5e-4.
        let quantile = |p: f64| {
            let tail = p.min(1.0 - p);
            let t = (-2.0 * tail.ln()).sqrt();
            let z = t
                - (2.515_517 + 0.802_853 * t + 0.010_328 * t * t)
                    / (1.0 + 1.432_788 * t + 0.189_269 * t * t + 0.001_308 * t * t * t);
            if p < 0.5 { -z } else { z }
        };
        let rock: Vec<Rock> = (0..10_000)
            .map(|at| (quantile((f64::from(at) + 0.5) / 1e4).exp(), 0.2, 1.0))
            .collect();
        // Exactly 1 − exp(−0.9945): 84 % lie above −0.9945 deviations.
        assert!((dykstra_parsons(&rock).unwrap() - (1.0 - (-0.9945_f64).exp())).abs() < 1e-3);
        assert_eq!(dykstra_parsons(&[(7.0, 0.2, 1.0); 3]), Some(0.0));
    }
}
