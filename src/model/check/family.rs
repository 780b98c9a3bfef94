//! How features hang together: ids, parents, levels, numbers of instances.

use std::collections::BTreeMap;

use super::feature::RESERVED;
use crate::model::checker::Checker;
use crate::model::defects::Defect;
use crate::model::draft::{DEEPEST_LEVEL, Draft, Lineage, ids};
use crate::model::nature::{Nature, Volumes};
use crate::model::suggest;
use crate::model::tree::quoted;

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

    /// The index of each feature's parent; none where it has none, or a wrong one (which is a defect).
    pub(super) fn parents(
        &self,
        drafts: &[Draft],
        index: &BTreeMap<String, usize>,
    ) -> Vec<Option<usize>> {
        let mut parents: Vec<Option<usize>> = Vec::new();
        for draft in drafts {
            parents.push(draft.parent.as_ref().and_then(|(at, parent)| {
                let found = index.get(parent).copied();
                if found.is_none() {
                    let remedy: String = if RESERVED.contains(&parent.as_str()) {
                        "leave `parent` out: a feature without one lies in the domain".to_owned()
                    } else {
                        self.reader
                            .hint(|| suggest::name(parent, &ids(drafts), "features"))
                    };
                    self.reader.wrong(
                        *at,
                        format!(
                            "{} has the parent {}, which is not a feature",
                            draft.name,
                            quoted(parent)
                        ),
                        remedy,
                    );
                }
                found
            }));
        }
        self.cut_cycles(drafts, &mut parents);
        parents
    }

    fn cut_cycles(&self, drafts: &[Draft], parents: &mut [Option<usize>]) {
        // 0 = not seen, 1 = on the present way up, 2 = known to lead to a root.
        let mut state = vec![0_u8; parents.len()];
        for start in 0..parents.len() {
            let mut way = Vec::new();
            let mut at = Some(start);
            while let Some(i) = at {
                if state[i] == 2 {
                    break;
                }
                if state[i] == 1 {
                    let begin = way.iter().position(|&j| j == i).unwrap_or(0);
                    let names: Vec<&str> = way[begin..]
                        .iter()
                        .chain(std::iter::once(&i))
                        .filter_map(|&j| drafts[j].id.as_ref().map(|(_, id)| id.as_str()))
                        .collect();
                    if let Some((node, _)) = &drafts[i].parent {
                        self.reader.wrong(
                            *node,
                            format!(
                                "the parents go round in a circle: {}",
                                suggest::list(&names).replace(", ", " → ")
                            ),
                            "a feature cannot lie inside itself; remove one of these parents",
                        );
                    }
                    parents[i] = None;
                    break;
                }
                state[i] = 1;
                way.push(i);
                at = parents[i];
            }
            for i in way {
                state[i] = 2;
            }
        }
    }

    /// The level and the number of instances of each feature; those of a child follow from its parent's.
    pub(super) fn lineages(&mut self, drafts: &[Draft], parents: &[Option<usize>]) -> Vec<Lineage> {
        let mut known: Vec<Option<Lineage>> = vec![None; drafts.len()];
        let lineages: Vec<Lineage> = (0..drafts.len())
            .map(|i| lineage(drafts, parents, &mut known, i))
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
            match (draft.level, parents[i]) {
                (Some((at, _)), Some(parent)) if level <= lineages[parent].level => {
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

    pub(super) fn note_disabled_parents(&mut self, drafts: &[Draft], parents: &[Option<usize>]) {
        for (i, draft) in drafts.iter().enumerate() {
            if let Some(parent) = parents[i]
                && draft.enabled
                && !drafts[parent].enabled
            {
                let name = &drafts[parent].name;
                self.note(
                    draft.node,
                    format!(
                        "{} is left out with its parent, {name}, which is disabled",
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
    parents: &[Option<usize>],
    known: &mut [Option<Lineage>],
    start: usize,
) -> Lineage {
    let mut way = vec![start];
    while let Some(&i) = way.last()
        && known[i].is_none()
        && let Some(parent) = parents[i]
    {
        way.push(parent);
    }
    let mut above = Lineage {
        level: 0,
        instances: 1,
        root: way.last().copied().unwrap_or(start),
    };
    for i in way.into_iter().rev() {
        above = known[i].unwrap_or_else(|| {
            let count = drafts[i].count.map_or(1, |(_, count)| count);
            Lineage {
                level: drafts[i]
                    .level
                    .map_or(above.level.saturating_add(1), |(_, level)| level),
                instances: above.instances.saturating_mul(count),
                root: above.root,
            }
        });
        known[i] = Some(above);
    }
    above
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
