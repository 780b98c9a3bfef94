//! How a horizon meets the one before it where the two are equal over an area, and how it rests on that.

use super::change::are_alike;
use super::deciding::Deciding;
use crate::features::horizon::HorizonError;
use crate::features::pinch_out::{Absence, Nodes};

/// What it means that a layer is equal to the one before it over an area.
pub(super) struct Contact {
    pub(super) nodes: Nodes,
    pub(super) thickness: Vec<f64>,
    pub(super) absence: Absence,
    /// Whether it rests on the older one; else that one is cut.
    pub(super) rests: bool,
    /// Whether that can still be changed.
    pub(super) is_open: bool,
}

impl Deciding<'_> {
    /// How a layer meets the one before it, if they are equal over an area.
    pub(super) fn contact(&mut self, at: usize) -> Option<Contact> {
        let nodes = self.nodes_of(&[at, at - 1])?;
        let (older, younger) = (self.sample(at - 1, &nodes), self.sample(at, &nodes));
        let thickness = self.thickness([at - 1, at], &nodes);
        let absence = Absence::over_areas(&thickness, nodes.counts, self.least);
        let [below, above] = [at - 1, at].map(|at| &self.layers[at].given);
        let bed = above.plus(&below.stretched(0.0, -2.0));
        self.tell_thinner(at - 1, at, &bed, &nodes, &absence);
        let alike = || are_alike(&self.layers[at - 1].given, &self.layers[at].given);
        if absence.is_empty() || absence.is_all() && alike() {
            return None;
        }
        let layer = &self.layers[at];
        let is_top = at + 1 == self.layers.len();
        // Surfaces through scattered points swing about each other within their tolerances, and cut nothing by that.
        let swings = [at - 1, at].map(|at| {
            self.layers[at]
                .points
                .as_ref()
                .map_or(0.0, |own| own.tolerance)
        });
        let deepest = -(self.least + swings[0] + swings[1]);
        let cuts_down = thickness.iter().any(|t| *t < deepest);
        let is_smoother = || absence.roughness(&older) <= absence.roughness(&younger);
        let rests =
            layer.is_onlapping || !is_top && layer.above.is_none() && !cuts_down && is_smoother();
        Some(Contact {
            nodes,
            thickness,
            absence,
            rests,
            is_open: true,
        })
    }

    /// Where a horizon rests on an older one and is itself cut, at one place, all that are equal there are cut.
    pub(super) fn settle(&mut self) {
        for at in (1..self.layers.len() - 1).rev() {
            let is_cut = self.contacts[at + 1]
                .as_ref()
                .is_some_and(|next| !next.rests);
            let Some(contact) = self.contacts[at]
                .as_ref()
                .filter(|contact| contact.rests && contact.is_open && is_cut)
            else {
                continue;
            };
            if self.layers[at].is_onlapping {
                continue;
            }
            let nodes = contact.nodes;
            let above = self.thickness([at, at + 1], &nodes);
            let least = self.least;
            if let Some(contact) = &mut self.contacts[at] {
                let meets = |k: usize| contact.absence.at(k) && above[k].abs() <= least;
                contact.rests = !(0..above.len()).any(meets);
            }
        }
    }

    /// Lets a layer go on below the one before it.
    pub(super) fn rest(&mut self, at: usize, contact: &Contact) -> Result<(), HorizonError> {
        let Contact {
            nodes,
            thickness,
            absence,
            ..
        } = contact;
        let depth = self.depth([at - 1, at]);
        let continued = nodes.interpolated(&absence.continued(thickness, depth))?;
        let reference = match nodes.clamped(&continued)? {
            Some(clamped) => clamped,
            None => nodes.interpolated(thickness)?,
        };
        let swing = nodes.swing(&reference, &continued);
        let below = &self.layers[at - 1];
        let (sheet, given) = (below.given.plus(&continued), below.given.plus(&reference));
        self.layers[at].swing = below.swing + swing;
        self.layers[at].sheet = sheet;
        // What lies above it is told from where it is built.
        self.layers[at].given = given;
        if !self.layers[at].is_onlapping {
            self.layers[at].above = Some(at - 1);
        }
        self.tell(at - 1, at, nodes, thickness, absence, at - 1);
        Ok(())
    }
}
