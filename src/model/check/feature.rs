//! The list of features: ids, parents, levels, counts; what a feature is goes by its kind.

use std::collections::BTreeMap;

use super::Checker;
use super::rock::{FaciesList, is_id};
use crate::model::defects::Defect;
use crate::model::file::FeatureFile;
use crate::model::read::{Any, Field};
use crate::model::spec::{Domain, Feature, FeatureKind};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};

/// The most instances that one feature may have.
const MOST_OF_ONE: u64 = 10_000;
/// The most instances that a model may have.
const MOST_OF_ALL: u64 = 100_000;
/// The deepest hierarchical level.
const DEEPEST_LEVEL: u32 = 1000;
/// Names that mean something else already.
const RESERVED: [&str; 2] = ["background", "domain"];

/// What is known of a feature before the list as a whole is judged.
pub(super) struct Draft {
    pub(super) node: NodeId,
    pub(super) id: Option<(NodeId, String)>,
    pub(super) name: String,
    pub(super) enabled: bool,
    pub(super) kind: Option<String>,
    pub(super) level: Option<(NodeId, u32)>,
    pub(super) parent: Option<(NodeId, String)>,
    count: Option<(Option<NodeId>, u64)>,
    file: FeatureFile,
}

/// The other features and the facies, which the rules of one feature name.
pub(super) struct Family<'f> {
    pub(super) drafts: &'f [Draft],
    pub(super) index: &'f BTreeMap<String, usize>,
    /// Which of the drafts is the feature itself.
    pub(super) own: usize,
    lineages: &'f [Lineage],
    pub(super) facies: &'f FaciesList,
}

impl Checker<'_> {
    pub(super) fn features(
        &mut self,
        field: Option<Field<Any>>,
        domain: Option<&Domain>,
        facies: &FaciesList,
    ) -> Option<Vec<Feature>> {
        let Some(field) = field else {
            return Some(Vec::new());
        };
        let (list, Any) = field.good()?;
        let Value::List(nodes) = self.reader.tree.value(list) else {
            let found = self.reader.tree.describe(list);
            self.reader.wrong(
                list,
                format!("expected a list of features, found {found}"),
                "write [[feature]], with double brackets, before each feature",
            );
            return None;
        };
        let before = self.reader.found();
        if nodes.len() as u64 > MOST_OF_ONE {
            self.reader.wrong(
                list,
                format!(
                    "the model has {} features, more than {MOST_OF_ONE}",
                    nodes.len()
                ),
                "for several alike write one feature with count = …",
            );
            return None;
        }
        let drafts: Vec<Draft> = nodes.iter().filter_map(|&node| self.draft(node)).collect();
        let index = first_of_each_id(&drafts);
        self.check_ids(&drafts, &index);
        let parents = self.parents(&drafts, &index);
        let lineages = self.lineages(&drafts, &parents);
        self.note_disabled_parents(&drafts, &parents);
        let mut features = Vec::new();
        for (i, draft) in drafts.iter().enumerate() {
            let family = Family {
                drafts: &drafts,
                index: &index,
                own: i,
                lineages: &lineages,
                facies,
            };
            let feature = self.feature(draft, &family, domain);
            features.extend(feature.map(|feature| Feature {
                parent: parents[i],
                level: lineages[i].level,
                ..feature
            }));
        }
        (self.reader.found() == before).then_some(features)
    }

    fn draft(&self, node: NodeId) -> Option<Draft> {
        let file: FeatureFile = self.reader.table(node)?;
        let name = match &file.id {
            Field::Good(_, id) => format!("feature {}", quoted(id)),
            _ => "this feature".to_owned(),
        };
        let id = self.id(&file.id, node);
        let kind = match &file.kind {
            Field::Good(at, kind) => self.known_kind(*at, kind).then(|| kind.clone()),
            Field::Missing => {
                self.reader.wrong(
                    node,
                    format!("{name} has no `kind`"),
                    "add it, for example: kind = \"channel\"",
                );
                None
            }
            Field::Bad => None,
        };
        let enabled = match file.enabled {
            Some(Field::Good(_, enabled)) => enabled,
            _ => true,
        };
        let count = match file.count {
            None => Some((None, 1)),
            Some(Field::Good(at, count)) => self.count(at, count, &name),
            Some(_) => None,
        };
        let level = match file.level {
            Some(Field::Good(at, level)) => self.level(at, level).map(|level| (at, level)),
            _ => None,
        };
        let parent = match &file.parent {
            Some(Field::Good(at, parent)) => Some((*at, parent.clone())),
            _ => None,
        };
        Some(Draft {
            node,
            id,
            name,
            enabled,
            kind,
            level,
            parent,
            count,
            file,
        })
    }

    fn id(&self, field: &Field<String>, node: NodeId) -> Option<(NodeId, String)> {
        match field {
            Field::Missing => {
                self.reader.wrong(
                    node,
                    "this feature has no `id`",
                    "add it, for example: id = \"channel\"",
                );
                None
            }
            Field::Bad => None,
            Field::Good(at, id) => {
                let remedy = "use letters, digits, `-` and `_`, as \"main-channel\"";
                if id.is_empty() {
                    self.reader.wrong(*at, "the id is empty", remedy);
                } else if !is_id(id) {
                    self.reader
                        .wrong(*at, format!("{} is not an id", quoted(id)), remedy);
                } else if RESERVED.contains(&id.as_str()) {
                    self.reader.wrong(
                        *at,
                        format!("the id {} is reserved for the block itself", quoted(id)),
                        "choose another id",
                    );
                }
                Some((*at, id.clone()))
            }
        }
    }

    pub(super) fn known_kind(&self, node: NodeId, kind: &str) -> bool {
        let known = FeatureKind::NAMES.contains(&kind);
        if !known {
            self.reader.wrong(
                node,
                format!("there is no kind of feature {}", quoted(kind)),
                match suggest::nearest(kind, &FeatureKind::NAMES) {
                    Some(known) => format!("did you mean \"{known}\"?"),
                    None => format!("the kinds are: {}", suggest::list(&FeatureKind::NAMES)),
                },
            );
        }
        known
    }

    fn count(&self, node: NodeId, count: u64, name: &str) -> Option<(Option<NodeId>, u64)> {
        if (1..=MOST_OF_ONE).contains(&count) {
            return Some((Some(node), count));
        }
        let remedy = match count {
            0 => "to leave the feature out, write enabled = false".to_owned(),
            _ => format!("write a number from 1 to {MOST_OF_ONE}"),
        };
        self.reader.wrong(
            node,
            format!("the count of {name} is {count}; it must lie between 1 and {MOST_OF_ONE}"),
            remedy,
        );
        None
    }

    pub(super) fn level(&self, node: NodeId, level: u64) -> Option<u32> {
        match u32::try_from(level) {
            Ok(level) if (1..=DEEPEST_LEVEL).contains(&level) => Some(level),
            _ => {
                self.reader.wrong(
                    node,
                    format!(
                        "the level is {level}; levels count from 1 (largest) to {DEEPEST_LEVEL}"
                    ),
                    "write 1 for the largest features, 2 for what lies in them, and so on",
                );
                None
            }
        }
    }

    fn check_ids(&self, drafts: &[Draft], index: &BTreeMap<String, usize>) {
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
            let count = drafts[other].count.map_or(1, |(_, count)| count);
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
    fn parents(&self, drafts: &[Draft], index: &BTreeMap<String, usize>) -> Vec<Option<usize>> {
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
    fn lineages(&mut self, drafts: &[Draft], parents: &[Option<usize>]) -> Vec<Lineage> {
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

    fn note_disabled_parents(&mut self, drafts: &[Draft], parents: &[Option<usize>]) {
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

    fn feature(
        &mut self,
        draft: &Draft,
        family: &Family<'_>,
        domain: Option<&Domain>,
    ) -> Option<Feature> {
        let kind = match draft.kind.as_deref() {
            Some("channel") => {
                let spec = self.channel(draft, domain);
                self.reader.close(draft.node, &draft.name);
                spec.map(FeatureKind::Channel)
            }
            _ => None,
        };
        let named = match &draft.file.facies {
            Field::Missing => {
                self.reader
                    .missing(draft.node, &draft.name, "facies", "facies = \"sand\"");
                None
            }
            Field::Bad => None,
            Field::Good(at, name) => Some((*at, name)),
        };
        let facies = named.and_then(|(at, name)| self.known_facies(at, name, family.facies));
        let removes = self.removes(draft, draft.file.removes.as_ref(), family);
        let removed_by = self.removed_by(draft, draft.file.removed_by.as_ref(), family);
        let preserve = match &draft.file.preserve {
            Some(Field::Good(at, true)) if draft.file.removes.is_some() => {
                self.reader.wrong(
                    *at,
                    format!("{} has both `preserve` and `removes`", draft.name),
                    "keep one: preserve = true removes nothing but the parent and the background",
                );
                true
            }
            Some(Field::Good(_, preserve)) => *preserve,
            _ => false,
        };
        Some(Feature {
            id: draft.id.as_ref().map(|(_, id)| id.clone())?,
            kind: kind?,
            enabled: draft.enabled,
            count: usize::try_from(draft.count?.1).ok()?,
            level: 0,
            parent: None,
            facies: facies?,
            removes: removes?,
            removed_by: removed_by?,
            preserve,
            place: self.place(draft.node),
        })
    }
}

/// What a feature has from its parents.
#[derive(Clone, Copy)]
struct Lineage {
    level: u32,
    instances: u64,
    /// The forebear without a parent.
    root: usize,
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

impl Family<'_> {
    /// Whether all of feature `other` comes before all of the feature itself; `Equal` where that is not so simple, since
    /// the instances of one family follow each other parent by parent.
    pub(super) fn age_of(&self, other: usize) -> std::cmp::Ordering {
        let [other, own] = [other, self.own].map(|i| self.lineages[i].root);
        other.cmp(&own)
    }
}

/// Where each id stands first in the list.
fn first_of_each_id(drafts: &[Draft]) -> BTreeMap<String, usize> {
    let mut index = BTreeMap::new();
    for (i, draft) in drafts.iter().enumerate() {
        if let Some((_, id)) = &draft.id {
            index.entry(id.clone()).or_insert(i);
        }
    }
    index
}

pub(super) fn ids(drafts: &[Draft]) -> Vec<&str> {
    drafts
        .iter()
        .filter_map(|draft| draft.id.as_ref().map(|(_, id)| id.as_str()))
        .collect()
}
