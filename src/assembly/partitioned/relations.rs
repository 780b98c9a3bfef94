//! What the rules say of regions without asking where they are.

use crate::model::plan::{AssemblyPlan, Cover};

/// The volumes behind the regions of a plan. The block, the domain's base and top, and lids have none.
pub(super) struct Relations<'a> {
    plan: &'a AssemblyPlan,
    /// By region: the volumes that ask for it.
    volumes: Vec<Vec<usize>>,
    /// By region, outside and inside of it: the volumes that certainly hold a place there, or certainly do not.
    told: Vec<[Vec<(usize, bool)>; 2]>,
    /// The first of the domain's base and top.
    first_bound: usize,
    /// On which side of them the domain is.
    within: Vec<bool>,
}

impl<'a> Relations<'a> {
    pub(super) fn new(plan: &'a AssemblyPlan) -> Self {
        let first_shell = 1 + plan.lids.len();
        let first_bound = first_shell + plan.shells.len();
        let within: Vec<bool> = plan.bounds().map(|(is_top, _)| !is_top).collect();
        let count = first_bound + within.len();
        let mut volumes = vec![Vec::new(); count];
        let mut told = vec![[Vec::new(), Vec::new()]; count];
        for body in &plan.bodies {
            let own = first_shell + body.shell;
            volumes[own].push(body.volume);
            told[own][0].push((body.volume, false));
            match body.below {
                None => told[own][1].push((body.volume, true)),
                Some(Cover::Lid(lid)) => told[1 + lid][1].push((body.volume, false)),
                // What a horizon ends asks for it too.
                Some(Cover::Horizon(shell)) => {
                    volumes[first_shell + shell].push(body.volume);
                    told[first_shell + shell][1].push((body.volume, false));
                }
            }
        }
        Self {
            plan,
            volumes,
            told,
            first_bound,
            within,
        }
    }

    /// Whether a place is above the domain's base and below its top, given the regions that hold it.
    pub(super) fn are_within(&self, inside: &[bool]) -> bool {
        inside[self.first_bound..] == self.within
    }

    /// Whether both regions may matter near some place.
    pub(super) fn meet(&self, one: usize, other: usize) -> bool {
        match (self.volumes[one].as_slice(), self.volumes[other].as_slice()) {
            // What has no volumes matters everywhere.
            ([], _) | (_, []) => true,
            (one, other) => one
                .iter()
                .any(|a| other.iter().any(|b| self.plan.rules.may_meet(*a, *b))),
        }
    }

    /// Whether another region's side makes no difference inside, or outside, of a region.
    pub(super) fn hides(&self, region: usize, inside: bool, other: usize) -> bool {
        let bound = region.checked_sub(self.first_bound);
        if bound.is_some_and(|bound| inside != self.within[bound]) {
            // Nothing matters outside of the domain.
            return true;
        }
        let facts = &self.told[region][usize::from(inside)];
        let is_hidden = |volume: &usize| {
            facts.iter().any(|(by, holds)| {
                by == volume && !holds || self.plan.rules.hides(*by, *holds, *volume)
            })
        };
        !self.volumes[other].is_empty() && self.volumes[other].iter().all(is_hidden)
    }
}
