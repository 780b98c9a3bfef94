//! The list of features: ids, parents, levels, counts; what a feature is goes by its kind.

use super::family::{first_of_each_id, parent};
use crate::model::checker::Checker;
use crate::model::domain::Domain;
use crate::model::draft::{Draft, Family, FeatureFile};
use crate::model::kinds;
use crate::model::kinds::keys::Keys;
use crate::model::nature::{Children, Copies, Nature, Taking, Within};
use crate::model::read::{Any, Field};
use crate::model::references::Host;
use crate::model::spec::Feature;
use crate::model::tree::{NodeId, Value, quoted};
use crate::model::values::facies::{FaciesList, is_id};
use crate::model::values::property::PropertySpec;

/// The most instances that one feature may have.
const MOST_OF_ONE: u64 = 10_000;
/// Names that mean something else already.
pub(super) const RESERVED: [&str; 2] = ["background", "domain"];

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
        let hosts = self.hosts(&drafts, &index);
        let lineages = self.lineages(&drafts, &hosts);
        self.note_disabled_hosts(&drafts, &hosts);
        let kinds = kinds::names();
        let mut features = Vec::new();
        for (i, draft) in drafts.iter().enumerate() {
            let family = Family {
                drafts: &drafts,
                index: &index,
                own: i,
                lineages: &lineages,
                hosts: &hosts,
                facies,
                kinds: &kinds,
            };
            let feature = self.feature(draft, &family, domain);
            features.extend(feature.map(|feature| Feature {
                parent: parent(&hosts, i),
                along: match hosts[i] {
                    Some(Host::Along(trunk)) => Some(trunk),
                    _ => None,
                },
                level: lineages[i].level,
                ..feature
            }));
        }
        self.check_references(&drafts, &hosts, &features);
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
            Field::Good(at, kind) => self
                .kind_meant(*at, kind, &kinds::names())
                .and_then(kinds::named)
                .map(|kind| kind.nature),
            // What it is like is told of where that cannot be followed.
            Field::Missing if file.like.is_some() => None,
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
        let along = match &file.along {
            Some(Field::Good(at, along)) => Some((*at, along.clone())),
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
            along,
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

    /// A feature may lie in what both its kind and its parent's allow.
    fn check_parent(&self, draft: &Draft, nature: Nature, family: &Family<'_>) {
        let Some((at, name)) = &draft.parent else {
            if let Within::Only { kind, .. } = nature.within
                && !draft.wrong_parent()
            {
                let example = format!("parent = \"the-{kind}\"");
                let (reader, own) = (&self.reader, &draft.name);
                reader.missing(draft.node, own, "parent", &example);
            }
            return;
        };
        let has = format!("{} has the parent {}", draft.name, quoted(name));
        let parent = family.index.get(name).map(|&parent| &family.drafts[parent]);
        // Of an unknown parent, or an unknown kind, there is a defect already.
        let of_kind = parent.and_then(|parent| Some((parent, parent.kind?)));
        let fits = |remedy: &str, fits: fn(Nature, &str) -> bool, wanted: &str| {
            if let Some((_, kind)) = of_kind
                && !fits(kind, wanted)
            {
                let message = format!("{has}, which is of the kind {}", kind.name);
                self.reader.wrong(*at, message, remedy);
            }
        };
        match nature.within {
            // Both keys are a defect already.
            Within::Along { kind, remedy } if draft.along.is_none() => {
                let message = format!("{has}, but a {} goes along a {kind}", nature.name);
                self.reader.wrong(*at, message, remedy);
            }
            Within::Along { .. } => {}
            Within::Domain { why, remedy } => {
                self.reader.wrong(*at, format!("{has}, but {why}"), remedy);
            }
            Within::Unit { remedy } => fits(remedy, |kind, _| kind.is_base, ""),
            Within::Only { kind, remedy } => fits(remedy, |kind, wanted| kind.name == wanted, kind),
            Within::Anything | Within::AnythingOrAlong { .. } => {
                if let Some((parent, Nature { children, .. })) = of_kind
                    && let Children::None { what, instead } = children
                {
                    let remedy = match &parent.parent {
                        Some((_, outer)) => format!("name {instead}: parent = {}", quoted(outer)),
                        None => format!("name {instead}"),
                    };
                    let message = format!("{has}, {what}, which can have no children");
                    self.reader.wrong(*at, message, remedy);
                }
            }
        }
    }

    /// A feature may go along what its kind says.
    fn check_along(&self, draft: &Draft, nature: Nature, family: &Family<'_>) {
        let Some((at, name)) = &draft.along else {
            if let Within::Along { kind, .. } = nature.within
                && draft.parent.is_none()
                && !draft.wrong_along()
            {
                let example = format!("along = \"the-{kind}\"");
                let (reader, own) = (&self.reader, &draft.name);
                reader.missing(draft.node, own, "along", &example);
            }
            return;
        };
        // Both keys, an unknown feature or an unknown kind are defects already.
        let other = family.index.get(name).map(|at| &family.drafts[*at]);
        let Some(other) = other.filter(|_| draft.parent.is_none()) else {
            return;
        };
        let (Within::Along { kind, remedy } | Within::AnythingOrAlong { kind, remedy }) =
            nature.within
        else {
            self.reader.wrong(
                *at,
                format!(
                    "{} goes along {}, but nothing of the kind {} does so",
                    draft.name,
                    quoted(name),
                    nature.name
                ),
                "leave `along` out",
            );
            return;
        };
        if let Some(other) = other.kind
            && other.name != kind
        {
            let message = format!(
                "{} goes along {}, which is of the kind {}",
                draft.name,
                quoted(name),
                other.name
            );
            self.reader.wrong(*at, message, remedy);
        }
    }

    /// Reports a `count` of what there is only one of, and rules that the kind itself decides.
    fn check_nature(&self, draft: &Draft, nature: Nature) {
        if let Copies::One(what) | Copies::OneEach(what) = nature.copies
            && let Some((Some(at), count)) = draft.count
            && count != 1
        {
            self.reader.wrong(
                at,
                format!(
                    "the count of {} is {count}, but there is only one of {what}",
                    draft.name
                ),
                "leave `count` out, and write a feature for each",
            );
        }
        if let Taking::ByKind { how, remedy } = nature.taking {
            for (key, node) in draft.taking_rules() {
                let message = format!("{} has `{key}`, but {how}", draft.name);
                self.reader.wrong(node, message, remedy);
            }
        }
    }

    /// The rock properties of a feature's own volumes.
    fn own_properties(&self, node: NodeId, name: &str) -> Option<Vec<(String, PropertySpec)>> {
        let what = format!("the properties of {name}");
        if matches!(self.reader.tree.value(node), Value::Table(_)) {
            return self.properties(node, &what);
        }
        let found = self.reader.tree.describe(node);
        self.reader.wrong(
            node,
            format!("expected a table for {what}, found {found}"),
            "write properties = { porosity = 0.25, permeability = { lognormal = [500, 300] } }",
        );
        None
    }

    fn feature(
        &mut self,
        draft: &Draft,
        family: &Family<'_>,
        domain: Option<&Domain>,
    ) -> Option<Feature> {
        let kind = draft.kind.and_then(|nature| {
            self.check_nature(draft, nature);
            self.check_parent(draft, nature, family);
            self.check_along(draft, nature, family);
            let read = kinds::named(nature.name)?.read;
            read(&mut Keys {
                checker: &mut *self,
                draft,
                family,
                domain,
            })
        });
        let is_event = draft.kind.is_some_and(|kind| kind.is_event());
        // Without a kind nobody knows which keys are wrong.
        if draft.kind.is_some() {
            self.reader.close(draft.node, &draft.name);
        }
        let named = match &draft.file.facies {
            Field::Missing if is_event => None,
            Field::Missing => {
                self.reader
                    .missing(draft.node, &draft.name, "facies", "facies = \"sand\"");
                None
            }
            Field::Bad => None,
            Field::Good(at, name) => Some((*at, name)),
        };
        if is_event {
            for (key, node) in draft.keys_of_rock() {
                self.reader.wrong(
                    node,
                    format!(
                        "{} has `{key}`, but a {} is no rock",
                        draft.name,
                        draft.kind.map_or("", |kind| kind.name)
                    ),
                    "leave it out",
                );
            }
        }
        let facies = named.and_then(|(at, name)| self.known_facies(at, name, family.facies));
        // What is no rock has none; it stands for that of the background.
        let facies = facies.or_else(|| domain.filter(|_| is_event).map(|domain| domain.facies));
        let conform = self.conform(draft, family);
        let properties = match draft.file.properties {
            None => Some(Vec::new()),
            Some(Field::Good(at, Any)) => self.own_properties(at, &draft.name),
            Some(_) => None,
        };
        let title = self.title(draft.file.name.as_ref(), &draft.name);
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
            title: title.ok()?,
            kind: kind?,
            enabled: draft.enabled,
            count: instances(draft)?,
            level: 0,
            parent: None,
            along: None,
            facies: facies?,
            properties: properties?,
            removes: removes?,
            removed_by: removed_by?,
            preserve,
            conform: conform.ok()?,
            place: self.place(draft.node),
        })
    }
}

/// How many instances it has in each of its parents.
fn instances(draft: &Draft) -> Option<usize> {
    match draft.kind?.copies {
        Copies::Members => Some(1),
        Copies::Any | Copies::One(_) | Copies::OneEach(_) => usize::try_from(draft.count?.1).ok(),
    }
}
