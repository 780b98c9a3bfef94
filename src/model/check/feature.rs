//! The list of features: ids, parents, levels, counts; what a feature is goes by its kind.

use super::Checker;
use super::facies::{FaciesList, is_id};
use super::family::{Family, first_of_each_id};
use crate::model::file::FeatureFile;
use crate::model::read::{Any, Field};
use crate::model::spec::{Domain, Feature, FeatureKind};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};

/// The most instances that one feature may have.
const MOST_OF_ONE: u64 = 10_000;
/// The deepest hierarchical level.
pub(super) const DEEPEST_LEVEL: u32 = 1000;
/// Names that mean something else already.
pub(super) const RESERVED: [&str; 2] = ["background", "domain"];

/// What is known of a feature before the list as a whole is judged.
pub(super) struct Draft {
    pub(super) node: NodeId,
    pub(super) id: Option<(NodeId, String)>,
    pub(super) name: String,
    pub(super) enabled: bool,
    pub(super) kind: Option<&'static str>,
    pub(super) level: Option<(NodeId, u32)>,
    pub(super) parent: Option<(NodeId, String)>,
    pub(super) count: Option<(Option<NodeId>, u64)>,
    file: FeatureFile,
}

impl Draft {
    /// The rules of what it takes that the file gives, with their places.
    pub(super) fn taking_rules(&self) -> Vec<(&'static str, NodeId)> {
        let removes = match &self.file.removes {
            Some(Field::Good(at, Any)) => Some(("removes", *at)),
            _ => None,
        };
        let preserve = match &self.file.preserve {
            Some(Field::Good(at, _)) => Some(("preserve", *at)),
            _ => None,
        };
        removes.into_iter().chain(preserve).collect()
    }

    /// Whether the file gives a parent that is no name at all.
    pub(super) fn wrong_parent(&self) -> bool {
        matches!(self.file.parent, Some(Field::Bad))
    }
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
            // What was probably meant is checked too, so that one slip hides no other.
            Field::Good(at, kind) => self.kind_meant(*at, kind),
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

    /// The kind of that name; where there is none, a defect, and the kind whose name is nearest.
    fn kind_meant(&self, node: NodeId, kind: &str) -> Option<&'static str> {
        let known = FeatureKind::NAMES.into_iter().find(|known| *known == kind);
        known.or_else(|| {
            let nearest = suggest::nearest(kind, &FeatureKind::NAMES);
            let remedy = match nearest {
                Some(known) => format!("did you mean \"{known}\"?"),
                None => format!("the kinds are: {}", suggest::list(&FeatureKind::NAMES)),
            };
            self.reader.wrong(
                node,
                format!("there is no kind of feature {}", quoted(kind)),
                remedy,
            );
            nearest
        })
    }

    pub(super) fn known_kind(&self, node: NodeId, kind: &str) -> bool {
        self.kind_meant(node, kind) == Some(kind)
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

    /// Nothing can lie in a set of clinoforms: its clinothems are not known before the draws.
    fn check_parent_divides_not(&self, draft: &Draft, family: &Family<'_>) {
        let Some((at, name)) = &draft.parent else {
            return;
        };
        let parent = family.index.get(name).map(|&parent| &family.drafts[parent]);
        // Horizons and clinoforms have said already what their parent may be.
        let own = draft
            .kind
            .is_some_and(|kind| ["horizon", "clinoforms"].contains(&kind));
        if let Some(parent) = parent
            && parent.kind == Some("clinoforms")
            && !own
        {
            let remedy = match &parent.parent {
                Some((_, unit)) => {
                    format!("name the horizon of its unit: parent = {}", quoted(unit))
                }
                None => "name the horizon of its unit".to_owned(),
            };
            self.reader.wrong(
                *at,
                format!(
                    "{} has the parent {}, a set of clinoforms, which can have no children",
                    draft.name,
                    quoted(name)
                ),
                remedy,
            );
        }
    }

    fn feature(
        &mut self,
        draft: &Draft,
        family: &Family<'_>,
        domain: Option<&Domain>,
    ) -> Option<Feature> {
        let kind = match draft.kind {
            Some("channel") => self.channel(draft, domain).map(FeatureKind::Channel),
            Some("ellipsoid") => self.ellipsoid(draft, domain).map(FeatureKind::Ellipsoid),
            Some("horizon") => self
                .horizon(draft, family, domain)
                .map(FeatureKind::Horizon),
            Some("clinoforms") => self.clinoforms(draft, family).map(FeatureKind::Clinoforms),
            _ => None,
        };
        self.check_parent_divides_not(draft, family);
        // Without a kind nobody knows which keys are wrong.
        if draft.kind.is_some() {
            self.reader.close(draft.node, &draft.name);
        }
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
