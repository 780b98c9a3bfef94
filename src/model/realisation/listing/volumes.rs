//! The volumes of what was made, in order of evaluation, and what each of them takes from.

use std::collections::BTreeMap;

use super::blocks::{Pieces, Unmoved};
use super::rock::{Layers, Place, needs_fabric};
use super::{Due, Listing};
use crate::features::extent::Extent;
use crate::features::fabric::Fabric;
use crate::features::moved::Reliefs;
use crate::model::kinds::made::{Frame, Made, Part, TakesFrom};
use crate::model::nature::{self, Nature};
use crate::model::properties::VolumeProperties;
use crate::model::realisation::making::Built;
use crate::model::realisation::{Instance, RealisationError};
use crate::model::rules::{BACKGROUND, BlockRules, VolumeRules};
use crate::model::selection::Selection;
use crate::model::spec::{Feature, Model};
use crate::model::values::selector::Selector;

/// The volumes of a realisation.
pub(in crate::model::realisation) struct Volumes {
    /// Their parts in the rules; the first is the background.
    pub(in crate::model::realisation) rules: Vec<VolumeRules>,
    /// Their bodies: instance `i` is volume `i + 1`.
    pub(in crate::model::realisation) instances: Vec<Instance>,
    /// Their rock properties, by volume.
    pub(in crate::model::realisation) properties: Vec<VolumeProperties>,
    /// What was decided about them.
    pub(in crate::model::realisation) decisions: Vec<String>,
}

impl Volumes {
    /// The volumes of all instances, depth first: children directly after their parent.
    pub(in crate::model::realisation) fn of(
        model: &Model,
        selection: &Selection,
        list: &Listing<'_>,
        built: Vec<Built>,
        extent: &Extent,
    ) -> Result<Self, RealisationError> {
        let background_rock = Place {
            feature: "background",
            number: "",
            part: "",
            facies: model.domain.facies,
            own: &[],
            fraction: None,
            fabric: extent.bounds()[0]
                .as_ref()
                .and_then(|base| base.plan())
                .map(|base| Fabric::of_horizon(base.horizon(), extent)),
        };
        let rock = background_rock
            .properties(model)
            .map_err(impossible("background"))?;
        let asks = model
            .features
            .iter()
            .any(|one| needs_fabric(model, &one.properties));
        let frames = if asks {
            built.iter().map(|one| one.made.frame.clone()).collect()
        } else {
            Vec::new()
        };
        let mut adding = Adding {
            model,
            selection,
            above: &list.above,
            volumes: Self {
                rules: vec![background(model)],
                instances: Vec::new(),
                properties: vec![rock],
                decisions: Vec::new(),
            },
            extent,
            firsts: Vec::with_capacity(built.len()),
            frames,
            ends: Vec::with_capacity(built.len()),
            units: BTreeMap::new(),
            open: BACKGROUND,
            pieces: BTreeMap::new(),
            grounds: BTreeMap::new(),
            copies: Vec::new(),
            unmoved: BTreeMap::new(),
            slipping: None,
            gone: Vec::new(),
            reliefs: Reliefs::default(),
        };
        for (due, built) in list.due.iter().zip(built) {
            if due.takes_part {
                adding.add(due, built)?;
            } else {
                adding.firsts.push(None);
                adding.ends.push(adding.volumes.rules.len());
            }
        }
        Ok(adding.along(&list.due))
    }
}

/// Volumes while they are listed.
pub(super) struct Adding<'a> {
    model: &'a Model,
    selection: &'a Selection,
    /// By feature: the base that it lies nowhere below.
    above: &'a BTreeMap<usize, usize>,
    pub(super) volumes: Volumes,
    pub(super) extent: &'a Extent,
    /// By instance, by what its children are placed; empty if nothing asks how layers lie.
    frames: Vec<Frame>,
    /// By instance so far, its first volume; none of what takes no part.
    pub(super) firsts: Vec<Option<usize>>,
    /// By instance so far, what comes after its volumes.
    ends: Vec<usize>,
    /// The volumes of those bases so far that take part, by feature.
    units: BTreeMap<usize, usize>,
    /// The unit above the last base so far.
    open: usize,
    /// The pieces of volumes that there are in several blocks.
    pub(super) pieces: BTreeMap<usize, Pieces>,
    /// The grounds of blocks, each with that of which it is a copy.
    pub(super) grounds: BTreeMap<usize, usize>,
    /// What was copied, block by block, with the copies.
    pub(super) copies: Vec<BTreeMap<usize, usize>>,
    /// Of volumes that have moved, where they come from.
    pub(super) unmoved: BTreeMap<usize, Unmoved>,
    /// Grounds of faults that have slipped again: all that lay there has moved on.
    pub(super) gone: Vec<usize>,
    /// The ground of the fault that may slip again: nothing has moved it since.
    pub(super) slipping: Option<usize>,
    /// What events add to heights.
    pub(super) reliefs: Reliefs,
}

impl Adding<'_> {
    /// Lists the volumes of an instance. What of it takes no part leaves its place to what it would take from.
    fn add(&mut self, due: &Due, built: Built) -> Result<(), RealisationError> {
        let feature = &self.model.features[due.feature];
        let nature = feature.kind.nature();
        let Made {
            parts,
            frame,
            decisions,
            event,
        } = built.made;
        let decisions = decisions.into_iter();
        self.volumes
            .decisions
            .extend(decisions.map(|text| format!("{} {text}", feature.id)));
        let oldest = self.volumes.rules.len();
        let parts = match event {
            None => parts,
            Some(event) => {
                let mut parts = parts.into_iter();
                self.displace(due, &event, parts.next())?;
                parts.collect()
            }
        };
        self.check_left_out(due, nature, &parts)?;
        let parent = due.parent.and_then(|parent| self.firsts[parent]);
        let above = self.above.get(&due.feature);
        let above = above.and_then(|below| self.units.get(below)).copied();
        let rejected = match nature.volumes {
            nature::Volumes::One => u32::try_from(built.rejected.len()).unwrap_or(u32::MAX),
            // They are counted by feature alone.
            nature::Volumes::Many { .. } | nature::Volumes::None => 0,
        };
        let fabrics = self.fabrics(due, feature, &parts, &frame)?;
        let first = self.volumes.rules.len();
        self.firsts.push(Some(oldest));
        // By part, its volume, or of what takes no part what it would take from.
        let mut places: Vec<Option<usize>> = Vec::with_capacity(parts.len());
        for (at, part) in parts.into_iter().enumerate() {
            let from = match part.from {
                TakesFrom::Anything => None,
                TakesFrom::Parent | TakesFrom::ParentItself => Some(parent.unwrap_or(BACKGROUND)),
                TakesFrom::OpenUnit => Some(self.open),
                TakesFrom::Part(older) => places[older],
            };
            if !self.keeps(&due.name, &part.name) {
                places.push(from);
                continue;
            }
            let volume = self.volumes.rules.len();
            places.push(Some(volume));
            let mut rules = self.rules_of(feature, format!("{}{}", due.name, part.name), parent);
            rules.from = from;
            rules.above = above;
            rules.preserve |= part.from == TakesFrom::ParentItself;
            if let Some(facies) = part.facies {
                rules.facies.clone_from(&self.model.facies[facies].name);
            }
            let rock = Place {
                feature: &feature.id,
                number: &due.number,
                part: &part.name,
                facies: part.facies.unwrap_or(feature.facies),
                // What has a facies of its own is rock of another kind.
                own: match part.facies {
                    None => &feature.properties,
                    Some(_) => &[],
                },
                fraction: part.fraction,
                fabric: fabrics.get(at).copied(),
            };
            let rock = rock
                .properties(self.model)
                .map_err(impossible(&rules.name))?;
            let in_blocks = self.in_blocks(&rules)?;
            for mut rules in in_blocks {
                // Parts of one name are one volume.
                rules.piece_of = self.volumes.rules[first..]
                    .iter()
                    .position(|other| other.name == rules.name)
                    .map(|at| first + at);
                let volume = self.volumes.rules.len();
                self.volumes.properties.push(rock.clone());
                self.volumes.rules.push(rules);
                self.volumes.instances.push(Instance {
                    volume,
                    feature: due.feature,
                    body: part.body.clone(),
                    drawn: part.drawn.clone(),
                    rejected,
                });
            }
            if nature.is_base {
                self.open = volume;
                self.units.insert(due.feature, volume);
            }
        }
        self.ends.push(self.volumes.rules.len());
        Ok(())
    }

    /// How the layers of each part lie; nothing if no property asks for that.
    fn fabrics(
        &self,
        due: &Due,
        feature: &Feature,
        parts: &[Part],
        frame: &Frame,
    ) -> Result<Vec<Fabric>, RealisationError> {
        if !needs_fabric(self.model, &feature.properties) {
            return Ok(Vec::new());
        }
        let layers = Layers {
            extent: self.extent,
            own: frame,
            // A companion lies along what it goes along.
            host: due.along.or(due.parent).map(|host| &self.frames[host]),
            top: due.top.as_ref(),
        };
        layers.of(parts).map_err(impossible(&due.name))
    }

    /// The volumes, of which companions now know what they go along: it comes after them.
    fn along(mut self, due: &[Due]) -> Volumes {
        for (at, due) in due.iter().enumerate() {
            if let (Some(first), Some(along)) = (self.firsts[at], due.along) {
                for rules in &mut self.volumes.rules[first..self.ends[at]] {
                    rules.along = self.firsts[along];
                }
            }
        }
        // A copy goes along the copy in its own block.
        for copies in &self.copies {
            for (volume, copy) in copies {
                let along = self.volumes.rules[*volume].along;
                let along = along.and_then(|along| copies.get(&along));
                self.volumes.rules[*copy].along = along.copied();
            }
        }
        self.volumes
    }

    /// Whether a part takes part: neither it nor what it is a part of is left out.
    fn keeps(&self, name: &str, part: &str) -> bool {
        let ends = part.match_indices('/').map(|(at, _)| at);
        ends.chain([part.len()]).all(|end| {
            self.selection
                .keeps_volume(&format!("{name}{}", &part[..end]))
        })
    }

    /// Of what is to be left out, nothing may be of a part that was not drawn.
    fn check_left_out(
        &self,
        due: &Due,
        nature: Nature,
        parts: &[Part],
    ) -> Result<(), RealisationError> {
        let nature::Volumes::Many { one, .. } = nature.volumes else {
            return Ok(());
        };
        let number = |name: &str| {
            let own = name.strip_prefix('-')?.split('/').next()?;
            own.parse::<usize>().ok()
        };
        let last = parts.iter().filter_map(|part| number(&part.name)).max();
        let last = last.unwrap_or(0);
        let is_missing = |name: &&String| {
            let part = name.strip_prefix(due.name.as_str());
            part.and_then(number).is_some_and(|number| number > last)
        };
        match self.selection.without.iter().find(is_missing) {
            None => Ok(()),
            Some(name) => Err(RealisationError::Impossible {
                volume: self.model.features[due.feature].id.clone(),
                reason: format!(
                    "there is no `{name}` to leave out: with this seed its last {one} is `{}-{last}`",
                    due.name
                ),
            }),
        }
    }

    fn rules_of(&self, feature: &Feature, name: String, parent: Option<usize>) -> VolumeRules {
        VolumeRules {
            name,
            feature: feature.id.clone(),
            kind: feature.kind.name().to_owned(),
            level: feature.level,
            facies: self.model.facies[feature.facies].name.clone(),
            parent,
            removes: feature.removes.clone(),
            removed_by: feature.removed_by.clone(),
            preserve: feature.preserve,
            from: None,
            above: None,
            piece_of: None,
            along: None,
            block: BlockRules::default(),
        }
    }
}

/// The error of a volume that is refused for some reason.
pub(super) fn impossible(volume: &str) -> impl Fn(String) -> RealisationError + '_ {
    move |reason| RealisationError::Impossible {
        volume: volume.to_owned(),
        reason,
    }
}

/// What every place belongs to first.
fn background(model: &Model) -> VolumeRules {
    VolumeRules {
        name: "background".to_owned(),
        feature: "background".to_owned(),
        kind: "background".to_owned(),
        level: 0,
        facies: model.facies[model.domain.facies].name.clone(),
        parent: None,
        removes: Selector::Everything,
        removed_by: Selector::Everything,
        preserve: false,
        from: None,
        above: None,
        piece_of: None,
        along: None,
        block: BlockRules::default(),
    }
}
