//! Events: what moves all that is older, and the blocks that faults part.
//!
//! A fold moves each older body. A fault moves what lies on one side of it, its hanging wall: that side becomes the *ground* of a block, with
//! the background's part in the rules, and holds a copy of every older volume, moved. Copies take from what lies in their block alone,
//! and a block hides all that is older, so copies of different blocks never meet. Where a younger fault comes, blocks are copied like
//! anything older, with their grounds.
//!
//! What is younger than a fault and takes from the unit that is open, or from the background, finds that in several blocks: it has a *piece* for
//! each, which are one volume.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::Due;
use super::volumes::{Adding, impossible};
use crate::features::body::Body;
use crate::features::motion::{Motion, Motions};
use crate::model::kinds::made::{Event, Part, Wall};
use crate::model::realisation::{Instance, RealisationError};
use crate::model::rules::{BACKGROUND, BlockRules, VolumeRules};

/// How far what is moved may be off if that is not said, as a fraction of the domain's diagonal.
const USUAL_TOLERANCE: f64 = 1e-5;

/// The volumes that one has become: for each block, by its ground, the piece there.
pub(super) type Pieces = BTreeMap<usize, usize>;

/// Where copies go, and what they copy.
struct Block {
    /// The ground of what is copied: that of another block, or the background.
    root: usize,
    /// The volumes in it that are copied.
    members: Vec<usize>,
}

impl Adding<'_> {
    /// The pieces of a volume, by the grounds of their blocks.
    pub(super) fn pieces(&self, volume: usize) -> Pieces {
        self.pieces
            .get(&volume)
            .cloned()
            .unwrap_or_else(|| Pieces::from([(BACKGROUND, volume)]))
    }

    /// A volume's rules, once for each block in which there is what it takes from.
    pub(super) fn in_blocks(
        &mut self,
        rules: &VolumeRules,
    ) -> Result<Vec<VolumeRules>, RealisationError> {
        let Some(first) = rules.from.or(rules.parent) else {
            if let Some(above) = rules.above
                && self.pieces(above).len() > 1
            {
                return Err(impossible(&rules.name)(format!(
                    "it is given by its thickness above {}, which a fault parts that is older than it; give it a surface of its own, or list it before the fault",
                    self.volumes.rules[above].unfaulted_name(),
                )));
            }
            return Ok(vec![rules.clone()]);
        };
        let of = |volume: Option<usize>| volume.map(|volume| self.pieces(volume));
        let [parents, above] = [of(rules.parent), of(rules.above)];
        let next = self.volumes.rules.len();
        let mut all = Vec::new();
        let mut own = Pieces::new();
        for (block, piece) in self.pieces(first) {
            // What is not parted there is one for all blocks.
            let there = |pieces: &Option<Pieces>| match pieces {
                None => Some(None),
                Some(pieces) if pieces.len() == 1 => Some(pieces.values().next().copied()),
                Some(pieces) => pieces.get(&block).copied().map(Some),
            };
            if let (Some(parent), Some(above)) = (there(&parents), there(&above)) {
                own.insert(block, next + all.len());
                all.push(VolumeRules {
                    parent,
                    above,
                    from: rules.from.and(Some(piece)),
                    ..rules.clone()
                });
            }
        }
        if own.len() > 1 {
            self.pieces.insert(next, own);
        }
        Ok(all)
    }

    /// Moves all that is older than an event.
    pub(super) fn displace(
        &mut self,
        due: &Due,
        event: &Event,
        part: Option<Part>,
    ) -> Result<(), RealisationError> {
        match part {
            None => self.move_all(due, event),
            Some(part) => self.part(due, event, &part),
        }
    }

    /// Moves every body.
    fn move_all(&mut self, due: &Due, event: &Event) -> Result<(), RealisationError> {
        self.slipping = None;
        let all: Vec<usize> = (1..self.volumes.rules.len()).collect();
        let moved = self.moved(&all, event, &event.motion)?;
        let deviation = moved.deviation;
        self.put(&all, moved);
        self.told(due, deviation);
        Ok(())
    }

    /// Bodies where they have moved to, in the place of those that they were.
    fn put(&mut self, volumes: &[usize], moved: Moved) {
        for (volume, moved) in volumes.iter().zip(moved.all) {
            self.volumes.instances[volume - 1].body = moved.body;
            self.unmoved.insert(*volume, moved.from);
        }
    }

    /// Parts what is older in two blocks.
    fn part(&mut self, due: &Due, event: &Event, part: &Part) -> Result<(), RealisationError> {
        let [own, rest] =
            [Wall::Hanging, Wall::Foot].map(|wall| format!("{}.{}", due.name, wall.word()));
        let again = self.again(due, event)?;
        let (roots, outside) = self.reach(due, event);
        let mut deviation = 0.0_f64;
        let mut parted = Vec::new();
        let first = self.volumes.rules.len();
        for root in roots {
            let block = self.block(root, &outside);
            let moved = self.moved(&block.members, event, &event.motion)?;
            deviation = deviation.max(moved.deviation);
            let ground = self.add_ground(due, part, root, &outside, &own);
            // What slips again lies where it did.
            self.grounds.insert(ground, again.unwrap_or(first));
            self.copy(&block, ground, moved.all, event, (&part.body, again), &own);
            if let Some(rest) = &event.rest {
                let moved = self.moved(&block.members, event, rest)?;
                deviation = deviation.max(moved.deviation);
                self.put(&block.members, moved);
            }
            parted.push(root);
            parted.extend(block.members);
        }
        for volume in parted {
            rename(&mut self.volumes.rules[volume], &rest);
        }
        self.told(due, deviation);
        Ok(())
    }

    /// The first ground of the fault that slips again.
    fn again(&mut self, due: &Due, event: &Event) -> Result<Option<usize>, RealisationError> {
        let own = self.volumes.rules.len();
        let older = due.referents.first().copied().flatten();
        let older = older.filter(|_| event.is_again);
        let first = older.and_then(|older| self.firsts[older]);
        if first.is_some() && self.slipping != first {
            return Err(impossible(&due.name)(
                "another event comes between its slips, or it ends on another fault; list slips of one fault without other faults and folds between them"
                    .to_owned(),
            ));
        }
        self.slipping = first.or(Some(own)).filter(|_| event.ends_on.is_none());
        Ok(first)
    }

    /// The grounds in whose blocks a fault parts what is older, and those of the blocks that it does not reach into.
    fn reach(&self, due: &Due, event: &Event) -> (Vec<usize>, Vec<usize>) {
        let everywhere = (vec![BACKGROUND], Vec::new());
        let Some(wall) = event.ends_on else {
            return everywhere;
        };
        let master = due.referents.first().copied().flatten();
        let Some(ground) = master.and_then(|master| self.firsts[master]) else {
            return everywhere;
        };
        let is_copy = |one: &(&usize, &usize)| *one.1 == ground;
        let grounds: Vec<usize> = self
            .grounds
            .iter()
            .filter(is_copy)
            .map(|one| *one.0)
            .collect();
        match wall {
            Wall::Foot => (vec![BACKGROUND], grounds),
            Wall::Hanging => {
                // A block within another one of them goes with that.
                let is_outer = |own: &usize| {
                    let around = self.volumes.rules[*own].block.within;
                    !around
                        .is_some_and(|around| grounds.iter().any(|one| self.lies_in(around, *one)))
                };
                (
                    grounds.iter().copied().filter(is_outer).collect(),
                    Vec::new(),
                )
            }
        }
    }

    /// Whether a volume is the ground of a block or lies in it.
    fn lies_in(&self, volume: usize, ground: usize) -> bool {
        let mut at = Some(volume);
        while let Some(volume) = at {
            if volume == ground {
                return true;
            }
            at = self.volumes.rules[volume].block.within;
        }
        false
    }

    /// What there is in a block, but for what lies in others.
    fn block(&self, root: usize, outside: &[usize]) -> Block {
        let is_member = |volume: &usize| {
            *volume != root
                && (root == BACKGROUND || self.lies_in(*volume, root))
                && !outside.iter().any(|ground| self.lies_in(*volume, *ground))
        };
        Block {
            root,
            members: (1..self.volumes.rules.len()).filter(is_member).collect(),
        }
    }

    fn add_ground(
        &mut self,
        due: &Due,
        part: &Part,
        root: usize,
        outside: &[usize],
        name: &str,
    ) -> usize {
        let ground = self.volumes.rules.len();
        let mut rules = self.volumes.rules[root].clone();
        rules.block = BlockRules {
            is_ground: true,
            within: (root != BACKGROUND).then_some(root),
            outside: outside.to_vec(),
            name: rules.block.name.clone(),
        };
        rename(&mut rules, name);
        self.volumes.rules.push(rules);
        self.volumes
            .properties
            .push(self.volumes.properties[root].clone());
        self.volumes.instances.push(Instance {
            volume: ground,
            feature: due.feature,
            body: part.body.clone(),
            drawn: part.drawn.clone(),
            rejected: 0,
        });
        ground
    }

    /// Copies what is in a block to that of a new ground. What does not reach there is left out, with what lies in it.
    fn copy(
        &mut self,
        block: &Block,
        ground: usize,
        moved: Vec<MovedBody>,
        event: &Event,
        (wall, again): (&Body, Option<usize>),
        name: &str,
    ) {
        let mut copies: BTreeMap<usize, usize> = BTreeMap::from([(block.root, ground)]);
        for (&member, moved) in block.members.iter().zip(moved) {
            let of = &self.volumes.rules[member];
            let is_copied = |volume: Option<usize>| {
                volume.is_none_or(|volume| volume == BACKGROUND || copies.contains_key(&volume))
            };
            let belongs = is_copied(of.parent) && is_copied(of.from) && is_copied(of.above);
            // What lies below a fault that slips again, and is older, is never above it; and what lies above it has gone with the
            // slip before this one.
            let has_gone = |ground: &usize| self.lies_in(member, *ground);
            let is_below =
                again.is_some_and(|first| member < first) || self.gone.iter().any(has_gone);
            if !belongs || is_below || !self.reaches(&moved.body, wall, event) {
                continue;
            }
            let slips_again = again.is_some() && self.grounds.get(&member) == again.as_ref();
            let moved = if slips_again {
                // It moves along itself.
                MovedBody::still(wall)
            } else {
                moved
            };
            let copy = |volume: usize| copies.get(&volume).copied();
            let mut rules = VolumeRules {
                parent: of.parent.and_then(copy),
                from: of.from.and_then(copy),
                above: of.above.and_then(copy),
                along: of.along.and_then(copy),
                piece_of: of.piece_of.and_then(copy),
                block: BlockRules {
                    within: Some(of.block.within.and_then(copy).unwrap_or(ground)),
                    outside: of.block.outside.iter().copied().filter_map(copy).collect(),
                    ..of.block.clone()
                },
                ..of.clone()
            };
            rename(&mut rules, name);
            let volume = self.volumes.rules.len();
            if let (None, Some(whole)) = (rules.piece_of, of.piece_of) {
                // The whole has no copy here: this one stands for it.
                copies.insert(whole, volume);
            }
            copies.insert(member, volume);
            if let Some(first) = self.grounds.get(&member).copied() {
                self.grounds.insert(volume, first);
            }
            let instance = &self.volumes.instances[member - 1];
            let instance = Instance {
                volume,
                feature: instance.feature,
                body: moved.body,
                drawn: instance.drawn.clone(),
                rejected: 0,
            };
            self.volumes
                .properties
                .push(self.volumes.properties[member].clone());
            self.volumes.rules.push(rules);
            self.volumes.instances.push(instance);
            self.unmoved.insert(volume, moved.from);
        }
        if let Some(first) = again {
            let of_fault = copies
                .keys()
                .filter(|one| self.grounds.get(*one) == Some(&first));
            self.gone.extend(of_fault);
        }
        self.add_pieces(&copies);
        self.copies.push(copies);
    }

    /// The copies of volumes are pieces of what those are pieces of.
    fn add_pieces(&mut self, copies: &BTreeMap<usize, usize>) {
        let mut firsts: Vec<usize> = self.pieces.keys().copied().collect();
        let known: BTreeSet<usize> = self
            .pieces
            .values()
            .flat_map(BTreeMap::values)
            .copied()
            .collect();
        firsts.extend(copies.keys().filter(|one| !known.contains(*one)));
        for first in firsts {
            let mut pieces = self.pieces(first);
            for (block, piece) in pieces.clone() {
                if let (Some(block), Some(piece)) = (copies.get(&block), copies.get(&piece)) {
                    pieces.insert(*block, *piece);
                }
            }
            self.pieces.insert(first, pieces);
        }
    }

    /// Whether a body may hold anything of the domain on a fault's hanging wall.
    fn reaches(&self, body: &Body, wall: &Body, event: &Event) -> bool {
        if matches!(body, Body::Side(_)) {
            return true;
        }
        let (low, high) = body.bounds();
        let (low, high) = (low.max(self.extent.low()), high.min(self.extent.high()));
        if !low.cmplt(high).all() {
            return false;
        }
        let Body::Side(side) = wall else { return true };
        // Of a plane it is enough to ask at the corners.
        !event.is_plane
            || (0..8).any(|corner| {
                let part = |axis: usize| if corner >> axis & 1 == 1 { high } else { low }[axis];
                side.holds(DVec3::new(part(0), part(1), part(2)))
            })
    }

    fn moved(
        &self,
        volumes: &[usize],
        event: &Event,
        motion: &Motion,
    ) -> Result<Moved, RealisationError> {
        let (low, high) = (self.extent.low(), self.extent.high());
        let usual = USUAL_TOLERANCE * low.distance(high);
        let tolerance = event.tolerance.unwrap_or(usual);
        let moved = |volume: &usize| {
            let unmoved = match self.unmoved.get(volume) {
                Some(unmoved) => unmoved,
                None => &Unmoved {
                    body: Arc::new(self.volumes.instances[volume - 1].body.clone()),
                    motions: Motions::none(),
                },
            };
            let from = Unmoved {
                body: Arc::clone(&unmoved.body),
                motions: unmoved.motions.then(motion.clone()),
            };
            let moved = from
                .body
                .moved(&from.motions, [low, high], tolerance, &self.reliefs);
            let moved = moved.map(|(body, deviation)| (MovedBody { body, from }, deviation));
            moved.map_err(|error| {
                let name = &self.volumes.rules[*volume].name;
                impossible(name)(format!("it cannot be moved: {error}"))
            })
        };
        let all: Vec<(MovedBody, f64)> = volumes.par_iter().map(moved).collect::<Result<_, _>>()?;
        let deviation = all.iter().map(|one| one.1).fold(0.0, f64::max);
        let all = all.into_iter().map(|one| one.0).collect();
        Ok(Moved { all, deviation })
    }

    fn told(&mut self, due: &Due, deviation: f64) {
        if deviation > 0.0 {
            self.volumes.decisions.push(format!(
                "{} moves what is older; surfaces follow that within {deviation:.1e} m",
                due.name
            ));
        }
    }
}

/// Bodies moved, and how far they are off at most (m).
struct Moved {
    all: Vec<MovedBody>,
    deviation: f64,
}

/// A body where it is, and where it comes from.
struct MovedBody {
    body: Body,
    from: Unmoved,
}

impl MovedBody {
    /// A body that has not moved.
    fn still(body: &Body) -> Self {
        Self {
            body: body.clone(),
            from: Unmoved {
                body: Arc::new(body.clone()),
                motions: Motions::none(),
            },
        }
    }
}

/// A body as it was made, and how it has moved since: so that it is moved once, however many events there are.
pub(super) struct Unmoved {
    body: Arc<Body>,
    motions: Motions,
}

/// Gives a volume the name of its block with one more word.
fn rename(rules: &mut VolumeRules, word: &str) {
    let own = rules.unfaulted_name().to_owned();
    let block = &mut rules.block.name;
    if !block.is_empty() {
        block.push('+');
    }
    block.push_str(word);
    rules.name = format!("{own}@{block}");
}
