//! The list of features: ids, parents, levels, counts; what a feature is goes by its kind.

use super::Checker;
use super::rock::{FaciesList, is_id};
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
        let drafts: Vec<Draft> = nodes.iter().filter_map(|&node| self.draft(node)).collect();
        self.check_ids(&drafts);
        let parents = self.parents(&drafts);
        let levels = self.levels(&drafts, &parents);
        self.check_totals(&drafts, &parents);
        self.note_disabled_parents(&drafts, &parents);
        let mut features = Vec::new();
        for (i, draft) in drafts.iter().enumerate() {
            let feature = self.feature(draft, &drafts, i, domain, facies);
            features.extend(feature.map(|feature| Feature {
                parent: parents[i],
                level: levels[i],
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

    fn check_ids(&self, drafts: &[Draft]) {
        let mut seen: std::collections::BTreeMap<&str, NodeId> = std::collections::BTreeMap::new();
        for draft in drafts {
            let Some((at, id)) = &draft.id else { continue };
            if let Some(first) = seen.get(id.as_str()) {
                let tree = self.reader.tree;
                self.reader.report(
                    crate::model::defects::Defect::new(
                        tree.span(*at),
                        format!("two features have the id {}", quoted(id)),
                        "give every feature an id of its own; for several alike write count = …",
                    )
                    .with_related(tree.span(*first), "the first one"),
                );
            } else {
                seen.insert(id, *at);
            }
        }
        for draft in drafts {
            let Some((_, id)) = &draft.id else { continue };
            let count = draft.count.map_or(1, |(_, count)| count);
            for other in drafts {
                if let Some((at, name)) = &other.id
                    && let Some(number) = name
                        .strip_prefix(id.as_str())
                        .and_then(|rest| rest.strip_prefix('-'))
                    && !number.starts_with('0')
                    && number.parse::<u64>().is_ok_and(|n| n <= count && count > 1)
                {
                    self.reader.wrong(
                        *at,
                        format!(
                            "the id {} is also the name of an instance of feature {}",
                            quoted(name),
                            quoted(id)
                        ),
                        "choose an id that does not end in a number of that feature's count",
                    );
                }
            }
        }
    }

    /// The index of each feature's parent; none where it has none, or a wrong one (which is a defect).
    fn parents(&self, drafts: &[Draft]) -> Vec<Option<usize>> {
        let index = |id: &str| {
            drafts
                .iter()
                .position(|draft| draft.id.as_ref().is_some_and(|(_, known)| known == id))
        };
        let mut parents: Vec<Option<usize>> = Vec::new();
        for draft in drafts {
            parents.push(draft.parent.as_ref().and_then(|(at, parent)| {
                let found = index(parent);
                if found.is_none() {
                    let remedy = if RESERVED.contains(&parent.as_str()) {
                        "leave `parent` out: a feature without one lies in the domain".to_owned()
                    } else {
                        suggest::name(parent, &ids(drafts), "features")
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

    fn levels(&mut self, drafts: &[Draft], parents: &[Option<usize>]) -> Vec<u32> {
        let mut levels: Vec<u32> = vec![0; drafts.len()];
        for start in 0..drafts.len() {
            // Up to the first feature whose level is known, then down again.
            let mut way = vec![start];
            while let Some(&i) = way.last()
                && levels[i] == 0
                && let Some(parent) = parents[i]
            {
                way.push(parent);
            }
            for i in way.into_iter().rev() {
                if levels[i] == 0 {
                    let above = parents[i].map_or(0, |parent| levels[parent]);
                    levels[i] = drafts[i].level.map_or(above + 1, |(_, level)| level);
                }
            }
        }
        for (i, draft) in drafts.iter().enumerate() {
            if let (Some((at, level)), Some(parent)) = (draft.level, parents[i])
                && level <= levels[parent]
            {
                let above = levels[parent];
                self.note(
                    at,
                    format!(
                        "{} is of level {level}, although it lies in a feature of level {above}",
                        draft.name
                    ),
                );
            }
        }
        levels
    }

    fn check_totals(&self, drafts: &[Draft], parents: &[Option<usize>]) {
        let mut total = 0_u64;
        for draft in drafts.iter().enumerate() {
            let (i, draft) = draft;
            let mut instances = 1_u64;
            let mut at = Some(i);
            while let Some(j) = at {
                let count = drafts[j].count.map_or(1, |(_, count)| count);
                instances = instances.saturating_mul(count);
                at = parents[j];
            }
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
        }
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
        drafts: &[Draft],
        index: usize,
        domain: Option<&Domain>,
        facies: &FaciesList,
    ) -> Option<Feature> {
        let kind = match draft.kind.as_deref() {
            Some("channel") => {
                let spec = self.channel(draft, domain);
                self.reader.close(draft.node, &draft.name);
                spec.map(FeatureKind::Channel)
            }
            _ => None,
        };
        let facies_index = match &draft.file.facies {
            Field::Good(at, name) => self.known_facies(*at, name, facies),
            Field::Missing => {
                self.reader.wrong(
                    draft.node,
                    format!("{} has no `facies`", draft.name),
                    "add it, for example: facies = \"sand\"",
                );
                None
            }
            Field::Bad => None,
        };
        let removes = self.removes(draft, &draft.file.removes, drafts, index, facies);
        let removed_by = self.removed_by(draft, &draft.file.removed_by, drafts, index, facies);
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
            facies: facies_index?,
            removes: removes?,
            removed_by: removed_by?,
            preserve,
            place: self.place(draft.node),
        })
    }
}

pub(super) fn ids(drafts: &[Draft]) -> Vec<&str> {
    drafts
        .iter()
        .filter_map(|draft| draft.id.as_ref().map(|(_, id)| id.as_str()))
        .collect()
}
