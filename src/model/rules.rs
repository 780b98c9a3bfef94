//! The rules: which volume holds a place, given the volumes whose side the place lies on.
//!
//! One function serves the point evaluator, the assembly's cells and the reports, so they cannot
//! disagree. It knows nothing of geometry: `inside` is a question to the caller.
//!
//! Every place starts as background. The bodies are asked in order of evaluation (oldest first,
//! children directly after their parent); the *holder* is the volume that holds the place so far. A
//! body takes the place if the place is inside the body's shell, the holder is the body's parent or
//! descends from it (without a parent: anything), the body's `removes` admits the holder, and the
//! holder's `removed_by` admits the body. `preserve` takes nothing but the parent and the background.
//!
//! Horizons, clinoforms and facies boundaries are asked like bodies; their inside is the side that they
//! hold. What they divide off is said by `from`: such a volume takes the place only from that holder or
//! what descends from it. Dividing is not removing, so the `removed_by` of that one holder is not asked.
//!
//! A volume may have several bodies, such as a levee along several bends; the younger ones are pieces of the oldest one, and what
//! they hold is that one's.
//!
//! A horizon given by its thickness above another one lies nowhere below that one, whatever its surface does where the
//! thickness is none: such a volume holds a place only where what it lies `above` does, too.
//!
//! A fault parts all that is older in two *blocks*. Its hanging wall is a volume with the background's part in the rules, which takes all
//! that lies on its side whatever protects that: a fault removes nothing, it moves. What is older exists once more as copies in that
//! block, moved: they take from what is in the block alone. So a block's volume is to them what the background is to what is in no block.

mod meeting;
mod takers;

use std::sync::atomic::AtomicU64;

use serde::{Deserialize, Serialize};

use super::values::selector::{Pick, Selector};
pub(super) use takers::Takers;

/// The volume that every place belongs to first.
pub const BACKGROUND: usize = 0;

/// One volume's part in the rules.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeRules {
    /// The volume's name: a path such as `channel-7/lag`.
    pub name: String,
    /// Id of the feature that it is an instance of.
    pub feature: String,
    /// The feature's kind.
    pub kind: String,
    /// Hierarchical level.
    pub level: u32,
    /// Facies name.
    pub facies: String,
    /// The volume that it is a child of; an older one.
    pub parent: Option<usize>,
    /// What it may remove.
    pub removes: Selector,
    /// What may remove it.
    pub removed_by: Selector,
    /// Whether it takes only from its parent and the background.
    pub preserve: bool,
    /// The older volume that it divides: it takes only from this one and what descends from it.
    pub from: Option<usize>,
    /// The older volume that it lies above: it takes only what lies within this one's body, too.
    pub above: Option<usize>,
    /// The older volume, of the same name and rules, that it is a piece of: what it holds is that one's.
    pub piece_of: Option<usize>,
    /// The younger volume that it goes along as a companion: no rule, but where people look for it.
    pub along: Option<usize>,
    /// Where it lies among the blocks that faults part.
    pub block: BlockRules,
}

/// A volume's part in the rules of blocks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BlockRules {
    /// Whether it is what a block holds where nothing else does: its ground, as the background is everywhere else.
    pub is_ground: bool,
    /// The ground of the block that it lies in: it takes from this and from what lies in that block alone.
    pub within: Option<usize>,
    /// The grounds of blocks that it does not reach into.
    pub outside: Vec<usize>,
    /// The block's name, such as `a.hw+b.fw`; empty if no fault parts what it is a piece of.
    pub name: String,
}

/// All volumes' rules, resolved: volume 0 is the background, then in order of evaluation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rules {
    volumes: Vec<Resolved>,
    /// By volume: the younger ones that lie above it, or above what lies above it.
    upon: Vec<Vec<usize>>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Resolved {
    parent: Option<usize>,
    from: Option<usize>,
    above: Option<usize>,
    piece_of: Option<usize>,
    within: Option<usize>,
    outside: Vec<usize>,
    is_ground: bool,
    preserve: bool,
    removes: Chosen,
    removed_by: Chosen,
    past: meeting::Past,
}

/// The first and the last of some volumes that follow each other.
type Run = (usize, usize);

/// Sorted volumes as runs: instances of a feature are neighbours, so few do.
fn runs(volumes: impl Iterator<Item = usize>) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for volume in volumes {
        match runs.last_mut() {
            Some(last) if last.1 + 1 == volume => last.1 = volume,
            _ => runs.push((volume, volume)),
        }
    }
    runs
}

/// A selector as volumes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Chosen {
    Everything,
    Runs(Vec<Run>),
}

/// What a body did to the holder of a place inside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It took the place.
    Takes,
    /// The holder is neither its parent nor descends from it.
    OutsideParent,
    /// The holder is neither what it divides nor descends from that.
    NotOpen,
    /// The holder lies in another block.
    OtherBlock,
    /// It preserves, and the holder is neither its parent nor the background.
    Preserves,
    /// Its `removes` does not admit the holder.
    DoesNotRemove,
    /// The holder's `removed_by` does not admit it.
    Protected,
}

impl Verdict {
    /// Why, in words that follow the body's name.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Takes => "takes it",
            Self::OutsideParent => "leaves it: the holder is not in its parent",
            Self::NotOpen => "leaves it: the unit that it lies on is not open there",
            Self::OtherBlock => "leaves it: the holder lies in another block",
            Self::Preserves => "leaves it: it preserves what is there",
            Self::DoesNotRemove => "leaves it: its `removes` does not admit the holder",
            Self::Protected => "leaves it: the holder's `removed_by` does not admit it",
        }
    }
}

impl Chosen {
    fn resolve(selector: &Selector, volumes: &[VolumeRules]) -> Self {
        let Selector::Only(picks) = selector else {
            return Self::Everything;
        };
        let admits = |volume: &VolumeRules| picks.iter().any(|pick| volume.is_picked_by(pick));
        let chosen = volumes.iter().enumerate().filter(|(_, v)| admits(v));
        Self::Runs(runs(chosen.map(|(index, _)| index)))
    }

    fn admits(&self, volume: usize) -> bool {
        match self {
            Self::Everything => true,
            Self::Runs(runs) => {
                let after = runs.partition_point(|run| run.0 <= volume);
                after > 0 && volume <= runs[after - 1].1
            }
        }
    }
}

impl VolumeRules {
    /// Its name without that of its block: all pieces of what faults part have the same.
    pub fn unfaulted_name(&self) -> &str {
        let block = &self.block.name;
        let own = self.name.strip_suffix(block.as_str());
        own.and_then(|own| own.strip_suffix('@'))
            .unwrap_or(&self.name)
    }

    fn is_picked_by(&self, pick: &Pick) -> bool {
        let name = self.unfaulted_name();
        match pick {
            Pick::Id(id) => self.feature == *id || name == *id,
            Pick::Part(feature, part) => {
                let named = format!("{feature}{part}");
                let mut ends = name.match_indices(&named);
                self.feature == *feature
                    && ends.any(|(at, _)| {
                        let rest = &name[at + named.len()..];
                        (at == 0 || name[..at].ends_with('/'))
                            && (rest.is_empty() || rest.starts_with('/'))
                    })
            }
            Pick::Kind(kind) => self.kind == *kind,
            Pick::Level(level) => self.level == *level,
            Pick::Facies(facies) => self.facies == *facies,
        }
    }
}

impl Rules {
    /// Resolves the rules of all volumes, background first, parents before their children.
    pub fn new(volumes: &[VolumeRules]) -> Self {
        // Instances of a feature have the same selectors: each is resolved once.
        let mut known: Vec<(&Selector, Chosen)> = Vec::new();
        let mut chosen = |selector| {
            if let Some((_, chosen)) = known.iter().find(|one| one.0 == selector) {
                return chosen.clone();
            }
            let chosen = Chosen::resolve(selector, volumes);
            known.push((selector, chosen.clone()));
            chosen
        };
        let mut resolved = Vec::with_capacity(volumes.len());
        for volume in volumes {
            resolved.push(Resolved {
                parent: volume.parent,
                from: volume.from,
                above: volume.above,
                piece_of: volume.piece_of,
                within: volume.block.within,
                outside: volume.block.outside.clone(),
                is_ground: volume.block.is_ground,
                preserve: volume.preserve,
                removes: chosen(&volume.removes),
                removed_by: chosen(&volume.removed_by),
                past: meeting::Past::default(),
            });
        }
        let mut rules = Self {
            volumes: resolved,
            upon: vec![Vec::new(); volumes.len()],
        };
        for volume in 0..volumes.len() {
            let mut at = rules.volumes[volume].above;
            while let Some(below) = at {
                rules.upon[below].push(volume);
                at = rules.volumes[below].above;
            }
        }
        rules.look_back();
        rules
    }

    /// Number of volumes, the background included.
    pub fn len(&self) -> usize {
        self.volumes.len()
    }

    /// Whether there is not even a background.
    pub fn is_empty(&self) -> bool {
        self.volumes.is_empty()
    }

    /// What a body does to a holder of a place inside it.
    pub fn verdict(&self, body: usize, holder: usize) -> Verdict {
        let rules = &self.volumes[body];
        if rules
            .within
            .is_some_and(|ground| !self.lies_in(holder, ground))
            || rules
                .outside
                .iter()
                .any(|ground| self.lies_in(holder, *ground))
        {
            Verdict::OtherBlock
        } else if rules.is_ground {
            Verdict::Takes
        } else if rules
            .parent
            .is_some_and(|parent| !self.descends(holder, parent))
        {
            Verdict::OutsideParent
        } else if rules.from.is_some_and(|from| !self.descends(holder, from)) {
            Verdict::NotOpen
        } else if rules.preserve && !self.is_ground(holder) && Some(holder) != rules.parent {
            Verdict::Preserves
        } else if !rules.removes.admits(holder) {
            Verdict::DoesNotRemove
        } else if rules.from != Some(holder) && !self.volumes[holder].removed_by.admits(body) {
            Verdict::Protected
        } else {
            Verdict::Takes
        }
    }

    /// The volume that holds a place in the end; `inside(volume)` tells whether the place is inside that body's shell.
    /// It is asked only of bodies that would take the place, and of what they lie above.
    pub fn owner(&self, inside: impl FnMut(usize) -> bool) -> usize {
        self.owner_since(BACKGROUND, 1..self.len(), inside)
    }

    /// The same of a place that is known to be held by some volume first, where only these younger ones, oldest first, may hold it
    /// after that.
    pub fn owner_since(
        &self,
        first: usize,
        younger: impl IntoIterator<Item = usize>,
        inside: impl FnMut(usize) -> bool,
    ) -> usize {
        self.owner_by(&Takers::new(0), first, younger, inside)
    }

    /// The same, by verdicts that are remembered.
    pub(super) fn owner_by(
        &self,
        takers: &Takers,
        first: usize,
        younger: impl IntoIterator<Item = usize>,
        mut inside: impl FnMut(usize) -> bool,
    ) -> usize {
        let (mut holder, mut row) = (first, takers.of(first));
        for body in younger {
            if self.takes(row, body, holder) && self.holds(body, &mut inside) {
                (holder, row) = (body, takers.of(body));
            }
        }
        self.whole(holder)
    }

    /// Whether a body takes a place inside it from a holder of whom so much is remembered.
    #[inline]
    fn takes(&self, known: Option<&[AtomicU64]>, body: usize, holder: usize) -> bool {
        takers::remembered(known, body, || self.verdict(body, holder) == Verdict::Takes)
    }

    /// The volume that a body is a piece of: most often the body's own.
    pub fn whole(&self, body: usize) -> usize {
        self.volumes[body].piece_of.unwrap_or(body)
    }

    /// Whether a body takes every place inside it, whatever holds that.
    pub fn takes_everything(&self, body: usize) -> bool {
        let volume = &self.volumes[body];
        volume.from.is_none()
            && volume.above.is_none()
            && volume.within.is_none()
            && volume.past.covers_since.is_some()
    }

    /// Every body that has a say about a place, and what it does to the holder so far.
    pub fn history(&self, mut inside: impl FnMut(usize) -> bool) -> Vec<(usize, Verdict)> {
        let mut holder = BACKGROUND;
        let mut steps = Vec::new();
        for body in 1..self.volumes.len() {
            if !self.holds(body, &mut inside) {
                continue;
            }
            let verdict = self.verdict(body, holder);
            if verdict == Verdict::Takes {
                holder = body;
            }
            steps.push((body, verdict));
        }
        steps
    }

    /// Whether a place lies within a body, and within all that it lies above.
    fn holds(&self, body: usize, inside: &mut impl FnMut(usize) -> bool) -> bool {
        let mut at = Some(body);
        while let Some(body) = at {
            if !inside(body) {
                return false;
            }
            at = self.volumes[body].above;
        }
        true
    }

    /// A volume, and those that lie above it: whatever else a place is in, they do not hold it outside of this one's body.
    fn resting(&self, volume: usize) -> impl Iterator<Item = usize> {
        std::iter::once(volume).chain(self.upon[volume].iter().copied())
    }

    /// Whether a volume is the ground of a block, or of everything.
    pub fn is_ground(&self, volume: usize) -> bool {
        volume == BACKGROUND || self.volumes[volume].is_ground
    }

    /// Whether a volume is the ground of a block or lies in it, perhaps in a block within that.
    fn lies_in(&self, volume: usize, ground: usize) -> bool {
        let mut at = Some(volume);
        while let Some(volume) = at {
            if volume == ground {
                return true;
            }
            at = self.volumes[volume].within;
        }
        false
    }

    fn descends(&self, volume: usize, ancestor: usize) -> bool {
        let mut at = Some(volume);
        while let Some(volume) = at {
            if volume == ancestor {
                return true;
            }
            at = self.volumes[volume].parent;
        }
        false
    }
}

#[cfg(test)]
mod tests;
