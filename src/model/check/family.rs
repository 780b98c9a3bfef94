//! How features hang together: ids, parents, levels, numbers of instances.

use std::collections::BTreeMap;

use super::feature::RESERVED;
use crate::model::checker::Checker;
use crate::model::defects::Defect;
use crate::model::draft::{DEEPEST_LEVEL, Draft, Lineage, ids};
use crate::model::nature::{Nature, Volumes};
use crate::model::references::Host;
use crate::model::suggest;
use crate::model::tree::{NodeId, quoted};

/// A key that says what a feature goes with.
#[derive(Clone, Copy)]
struct Which {
    /// What a feature with it does, in words.
    has: &'static str,
    /// What to do where the domain is named.
    none: &'static str,
}

const PARENT: Which = Which {
    has: "has the parent",
    none: "leave `parent` out: a feature without one lies in the domain",
};
const ALONG: Which = Which {
    has: "goes along",
    none: "name a channel",
};

/// The most instances that a model may have.
const MOST_OF_ALL: u64 = 100_000;

impl Checker<'_> {
    pub(super) fn check_ids(&self, drafts: &[Draft], index: &BTreeMap<String, usize>) {
        for (i, draft) in drafts.iter().enumerate() {
            let Some((at, id)) = &draft.id else { continue };
            let first = index.get(id).and_then(|&first| drafts[first].id.as_ref());
            if index.get(id) != Some(&i)
                && let Some((first, _)) = first
            {
                let tree = self.reader.tree;
                self.reader.report(
                    Defect::new(
                        tree.span(*at),
                        format!("two features have the id {}", quoted(id)),
                        "give every feature an id of its own; for several alike write count = …",
                    )
                    .with_related(tree.span(*first), "the first one")
                    .with_path(self.reader.path(*at)),
                );
            }
        }
        self.check_instance_names(drafts, index);
    }

    /// `channel-3` may not be a feature of its own where `channel` has a count of 3 or more.
    fn check_instance_names(&self, drafts: &[Draft], index: &BTreeMap<String, usize>) {
        for draft in drafts {
            let Some((at, name)) = &draft.id else {
                continue;
            };
            let Some((prefix, number)) = name.rsplit_once('-') else {
                continue;
            };
            let Some(&other) = index.get(prefix) else {
                continue;
            };
            let count = match drafts[other].kind {
                // How many there are may depend on the draws.
                Some(Nature {
                    volumes: Volumes::Many { most, .. },
                    ..
                }) => most,
                _ => drafts[other].count.map_or(1, |(_, count)| count),
            };
            let clash = !number.starts_with(['0', '+'])
                && number.parse::<u64>().is_ok_and(|n| n <= count && count > 1);
            if clash {
                self.reader.wrong(
                    *at,
                    format!(
                        "the id {} is also the name of an instance of feature {}",
                        quoted(name),
                        quoted(prefix)
                    ),
                    "choose an id that does not end in a number of that feature's count",
                );
            }
        }
    }

    /// What each feature goes with; nothing where it has no host, or a wrong one (which is a defect).
    pub(super) fn hosts(
        &self,
        drafts: &[Draft],
        index: &BTreeMap<String, usize>,
    ) -> Vec<Option<Host>> {
        let find = |draft: &Draft, (at, id): &(NodeId, String), which: Which| {
            let found = index.get(id).copied();
            if found.is_none() {
                let remedy: String = if RESERVED.contains(&id.as_str()) {
                    which.none.to_owned()
                } else {
                    self.reader
                        .hint(|| suggest::name(id, &ids(drafts), "features"))
                };
                let message = format!(
                    "{} {} {}, which is not a feature",
                    draft.name,
                    which.has,
                    quoted(id)
                );
                self.reader.wrong(*at, message, remedy);
            }
            found
        };
        let host = |draft: &Draft| match (&draft.along, &draft.parent) {
            (Some((at, _)), Some((_, parent))) => {
                self.reader.wrong(
                    *at,
                    format!(
                        "{} has the parent {}, and `along`, too",
                        draft.name,
                        quoted(parent)
                    ),
                    "keep one: what goes along a channel lies in what that lies in",
                );
                None
            }
            (Some(along), None) => find(draft, along, ALONG).map(Host::Along),
            (None, Some(parent)) => find(draft, parent, PARENT).map(Host::In),
            (None, None) => None,
        };
        let mut hosts: Vec<Option<Host>> = drafts.iter().map(host).collect();
        self.cut_cycles(drafts, &mut hosts);
        hosts
    }

    fn cut_cycles(&self, drafts: &[Draft], hosts: &mut [Option<Host>]) {
        // 0 = not seen, 1 = on the present way up, 2 = known to lead to a root.
        let mut state = vec![0_u8; hosts.len()];
        for start in 0..hosts.len() {
            let mut way = Vec::new();
            let mut at = Some(start);
            while let Some(i) = at {
                if state[i] == 2 {
                    break;
                }
                if state[i] == 1 {
                    let begin = way.iter().position(|&j| j == i).unwrap_or(0);
                    let circle: Vec<usize> = way[begin..].to_vec();
                    self.report_cycle(drafts, hosts, &circle);
                    hosts[i] = None;
                    break;
                }
                state[i] = 1;
                way.push(i);
                at = hosts[i].map(Host::feature);
            }
            for i in way {
                state[i] = 2;
            }
        }
    }

    fn report_cycle(&self, drafts: &[Draft], hosts: &[Option<Host>], circle: &[usize]) {
        let names: Vec<&str> = circle
            .iter()
            .chain(&circle[..1])
            .map(|&at| drafts[at].id())
            .collect();
        let goes_along = circle
            .iter()
            .any(|&at| matches!(hosts[at], Some(Host::Along(_))));
        let (what, remedy) = if goes_along {
            (
                "parents and what features go along",
                "a feature cannot go along what lies in it; remove one of these",
            )
        } else {
            (
                "the parents",
                "a feature cannot lie inside itself; remove one of these parents",
            )
        };
        let first = &drafts[circle[0]];
        if let Some((node, _)) = first.along.as_ref().or(first.parent.as_ref()) {
            let way = suggest::list(&names).replace(", ", " → ");
            self.reader
                .wrong(*node, format!("{what} go round in a circle: {way}"), remedy);
        }
    }

    /// The level and the number of instances of each feature; those of a child follow from its parent's.
    pub(super) fn lineages(&mut self, drafts: &[Draft], hosts: &[Option<Host>]) -> Vec<Lineage> {
        let mut known: Vec<Option<Lineage>> = vec![None; drafts.len()];
        let lineages: Vec<Lineage> = (0..drafts.len())
            .map(|i| lineage(drafts, hosts, &mut known, i))
            .collect();
        let mut total = 0_u64;
        for (i, draft) in drafts.iter().enumerate() {
            let Lineage {
                level, instances, ..
            } = lineages[i];
            let before = total;
            total = total.saturating_add(instances);
            if before <= MOST_OF_ALL && total > MOST_OF_ALL {
                let node = draft.count.and_then(|(node, _)| node).unwrap_or(draft.node);
                self.reader.wrong(
                    node,
                    format!(
                        "with {} the model has {total} instances, more than {MOST_OF_ALL}",
                        draft.name
                    ),
                    "lower the counts (those of a child are multiplied by its parent's)",
                );
            }
            match (draft.level, hosts[i]) {
                (Some((at, _)), Some(Host::In(parent))) if level <= lineages[parent].level => {
                    let above = lineages[parent].level;
                    self.note(
                        at,
                        format!(
                            "{} is of level {level}, although it lies in a feature of level {above}",
                            draft.name
                        ),
                    );
                }
                (None, _) if level > DEEPEST_LEVEL => {
                    self.reader.wrong(
                        draft.node,
                        format!(
                            "{} is of level {level}, deeper than {DEEPEST_LEVEL}",
                            draft.name
                        ),
                        "shorten the chain of parents",
                    );
                }
                _ => {}
            }
        }
        lineages
    }

    pub(super) fn note_disabled_hosts(&mut self, drafts: &[Draft], hosts: &[Option<Host>]) {
        for (draft, host) in drafts.iter().zip(hosts) {
            let Some(host) = host.filter(|host| !drafts[host.feature()].enabled) else {
                continue;
            };
            if draft.enabled {
                let with = match host {
                    Host::In(_) => "its parent",
                    Host::Along(_) => "what it goes along",
                };
                let name = &drafts[host.feature()].name;
                self.note(
                    draft.node,
                    format!(
                        "{} is left out with {with}, {name}, which is disabled",
                        draft.name
                    ),
                );
            }
        }
    }
}

/// The lineage of feature `start`, from the first of its forebears whose own is known.
fn lineage(
    drafts: &[Draft],
    hosts: &[Option<Host>],
    known: &mut [Option<Lineage>],
    start: usize,
) -> Lineage {
    let mut way = vec![start];
    while let Some(&i) = way.last()
        && known[i].is_none()
        && let Some(host) = hosts[i]
    {
        way.push(host.feature());
    }
    let mut above = Lineage {
        level: 0,
        instances: 1,
        root: way.last().copied().unwrap_or(start),
    };
    for i in way.into_iter().rev() {
        above = known[i].unwrap_or_else(|| {
            let count = drafts[i].count.map_or(1, |(_, count)| count);
            // What goes along something is of the same level.
            let deeper = u32::from(!matches!(hosts[i], Some(Host::Along(_))));
            Lineage {
                level: drafts[i]
                    .level
                    .map_or(above.level.saturating_add(deeper), |(_, level)| level),
                instances: above.instances.saturating_mul(count),
                root: above.root,
            }
        });
        known[i] = Some(above);
    }
    above
}

/// The parent of a feature; of a companion, that of what it goes along.
pub(super) fn parent(hosts: &[Option<Host>], feature: usize) -> Option<usize> {
    let mut at = feature;
    while let Some(Host::Along(host)) = hosts[at] {
        at = host;
    }
    match hosts[at] {
        Some(Host::In(parent)) => Some(parent),
        _ => None,
    }
}

/// Where each id stands first in the list.
pub(super) fn first_of_each_id(drafts: &[Draft]) -> BTreeMap<String, usize> {
    let mut index = BTreeMap::new();
    for (i, draft) in drafts.iter().enumerate() {
        if let Some((_, id)) = &draft.id {
            index.entry(id.clone()).or_insert(i);
        }
    }
    index
}
