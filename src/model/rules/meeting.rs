//! Which volumes' sides can matter at one place, by the rules alone.
//!
//! The sides of two volumes *meet* if there is a setting of all other sides at which changing the one
//! changes the owner (for some side of the other), and changing the other does too. Where they cannot,
//! their surfaces need not be intersected: whatever lies between them has one owner on both sides.
//!
//! What is known of a volume a without trying settings is its **gates**: a takes only from its parent or
//! what descends from it, and from its `from` or what descends from that, and what descends was itself
//! taken from there. So a place that a takes was held by a's gate before, by the gate's gate before
//! that, and so on. Let b be older than a.
//!
//! - A gate younger than b that takes whatever can hold the place then leaves no trace of b.
//! - A gate g older than b, of a volume v younger than b that takes from g alone: b then meets a place
//!   that g holds and must leave to v, so they meet only if b takes from g.
//!
//! The ground of a block is a gate of all that lies in it.
//!
//! In doubt, sides meet. Where a volume lies `above` another one, that one's side is a side of both.
//!
//! A volume *hides* another one where its body holds a place, or where it does not, if the other's side makes no
//! difference there, whatever the rest: what a needs is not there, or something younger has taken all.

use serde::{Deserialize, Serialize};

use super::{BACKGROUND, Chosen, Rules, Verdict};

/// What the rules say of the holders that a volume finds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Past {
    /// The older volume that held every place which this one takes.
    gate: Option<usize>,
    /// The older volumes that have all held every place which this one takes, in order.
    needs: Vec<usize>,
    /// Whether it takes from the gate alone, not from what descends from it.
    directly: bool,
    /// The volumes from this one on make no difference to it: it takes from all that can hold a place then.
    pub(super) covers_since: Option<usize>,
}

impl Rules {
    /// Whether there can be a place beside which both volumes' sides matter. `false` is certain; `true` may be doubt.
    pub fn may_meet(&self, one: usize, other: usize) -> bool {
        // A side matters to what lies above its volume as well.
        self.resting(one).any(|one| {
            self.resting(other)
                .any(|other| self.may_both_hold(one, other))
        })
    }

    /// The same of what volumes hold: within their own bodies, and within all that they lie above.
    fn may_both_hold(&self, one: usize, other: usize) -> bool {
        let (b, a) = (one.min(other), one.max(other));
        if a == b {
            return true;
        }
        if b == BACKGROUND {
            return false;
        }
        let mut v = a;
        loop {
            if v != a && self.covers(v, b) {
                return false;
            }
            let past = &self.volumes[v].past;
            match past.gate {
                Some(gate) if gate > b => v = gate,
                Some(gate) if gate < b && past.directly => {
                    return self.verdict(b, gate) == Verdict::Takes;
                }
                _ => return true,
            }
        }
    }

    /// Whether a volume's side makes no difference to who holds a place, wherever another volume's body holds the place,
    /// or does not hold it. `true` is certain.
    pub fn hides(&self, other: usize, holds: bool, volume: usize) -> bool {
        if volume == BACKGROUND || other == volume {
            return volume == BACKGROUND;
        }
        // Within its body a volume holds a place only if what it lies above does.
        if holds && self.volumes[other].above.is_some() {
            return false;
        }
        self.resting(volume).all(|own| {
            if holds {
                self.makes_idle(other, true, own)
            } else {
                self.resting(other)
                    .any(|other| other == own || self.makes_idle(other, false, own))
            }
        })
    }

    /// The same of what volumes hold, in the end.
    fn makes_idle(&self, other: usize, holds: bool, volume: usize) -> bool {
        if other == volume {
            return false;
        }
        if !holds {
            return self.needs(volume, other);
        }
        let past = &self.volumes[volume].past;
        let takes_from_gate = |gate: usize| {
            (gate + 1..volume).contains(&other) && self.verdict(other, gate) == Verdict::Takes
        };
        // Within its body, what lies in a block holds a place only if that block does; but so does the volume, if it lies there, too.
        let block = self.volumes[other].within;
        let is_in_block = block.is_none_or(|ground| self.lies_in(volume, ground));
        other > volume && is_in_block && self.covers(other, volume)
            || past.directly && past.gate.is_some_and(takes_from_gate)
    }

    /// Whether a volume takes no place that another one has not held.
    fn needs(&self, volume: usize, other: usize) -> bool {
        self.volumes[volume]
            .past
            .needs
            .binary_search(&other)
            .is_ok()
    }

    /// Whether v takes a place that b found, whether b took it or not.
    fn covers(&self, v: usize, b: usize) -> bool {
        let volume = &self.volumes[v];
        volume.past.covers_since.is_some_and(|since| since <= b)
            && volume.within.is_none_or(|ground| self.lies_in(b, ground))
            && (volume.is_ground || volume.from.is_none_or(|from| self.descends(b, from)))
    }

    /// Fills in what the rules say of each volume's past.
    pub(super) fn look_back(&mut self) {
        let mut is_parent = vec![false; self.volumes.len()];
        for parent in self.volumes.iter().filter_map(|volume| volume.parent) {
            is_parent[parent] = true;
        }
        // What protects older volumes, each once: instances of a feature have the same.
        let mut protections: Vec<Chosen> = Vec::new();
        for v in 0..self.volumes.len() {
            let volume = &self.volumes[v];
            let gates = if volume.is_ground {
                [volume.within, None, None]
            } else {
                [volume.parent, volume.from, volume.within]
            };
            let gate = gates.into_iter().max().flatten();
            let takes_all = volume.outside.is_empty()
                && (volume.is_ground
                    || volume.parent.is_none()
                        && !volume.preserve
                        && volume.removes == Chosen::Everything
                        && protections.iter().all(|admitted| admitted.admits(v)));
            let mut needs: Vec<usize> = Vec::new();
            for gate in gates.into_iter().flatten() {
                needs.push(gate);
                needs.extend(&self.volumes[gate].past.needs);
            }
            needs.sort_unstable();
            needs.dedup();
            let past = Past {
                gate,
                needs,
                directly: !volume.is_ground
                    && gate.is_some_and(|gate| volume.from == gate.into() && !is_parent[gate]),
                covers_since: takes_all.then(|| self.run_before(v)),
            };
            if volume.removed_by != Chosen::Everything && !protections.contains(&volume.removed_by)
            {
                protections.push(volume.removed_by.clone());
            }
            self.volumes[v].past = past;
        }
    }

    /// See [`Past::covers_since`], for a volume that takes all that descends from its `from`, or everything.
    fn run_before(&self, v: usize) -> usize {
        let volume = &self.volumes[v];
        // It takes nothing that has left its block.
        let in_block = volume.within.map_or(0, |ground| {
            let is_in = |older: &usize| self.lies_in(*older, ground);
            v - (ground + 1..v).rev().take_while(is_in).count()
        });
        let Some(from) = volume.from.filter(|_| !volume.is_ground) else {
            return in_block;
        };
        // What descends from `from` keeps the place there; what takes everything leaves no trace of anything.
        let harmless = |&older: &usize| {
            let one = &self.volumes[older];
            self.descends(older, from)
                || one.from.is_none()
                    && (one.within.is_none() || one.within == volume.within)
                    && one.past.covers_since.is_some()
        };
        in_block.max(v - (from + 1..v).rev().take_while(harmless).count())
    }
}

#[cfg(test)]
#[path = "meeting_tests.rs"]
mod tests;
