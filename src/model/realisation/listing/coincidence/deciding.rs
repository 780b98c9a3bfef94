//! Horizons while it is decided which of them gives way where they coincide.

use std::collections::BTreeMap;
use std::rc::Rc;

use glam::DVec3;

use super::bed::Bed;
use super::contact::Contact;
use super::points::{Known, Points, tell_thickness};
use crate::features::horizon::{Horizon, HorizonError};
use crate::features::pinch_out::Nodes;
use crate::model::spec::Model;
use crate::model::values::surface::HorizonSurface;

/// A horizon that takes part, or the domain's top.
pub(super) struct Layer {
    pub(super) name: String,
    /// As the data say.
    pub(super) given: Horizon,
    /// As it is built.
    pub(super) sheet: Horizon,
    pub(super) nodes: Option<Nodes>,
    pub(super) points: Option<Points>,
    pub(super) is_onlapping: bool,
    /// By how much its given heights may be off those that it is built with, where it shows (m).
    pub(super) swing: f64,
    /// The layer that it lies nowhere below.
    pub(super) above: Option<usize>,
}

/// Horizons while it is decided.
pub(super) struct Deciding<'a> {
    pub(super) model: &'a Model,
    pub(super) layers: Vec<Layer>,
    /// By layer: how it meets the one before it.
    pub(super) contacts: Vec<Option<Contact>>,
    /// Heights of layers at the nodes of grids.
    pub(super) samples: BTreeMap<(usize, usize), Rc<Vec<f64>>>,
    pub(super) grids: Vec<Nodes>,
    pub(super) least: f64,
    pub(super) decisions: Vec<String>,
}

impl Deciding<'_> {
    /// Lets a horizon rest on an older one where its thickness above that is none.
    pub(super) fn isochore(
        &mut self,
        [below, at]: [usize; 2],
        bed: Bed,
    ) -> Result<(), HorizonError> {
        if let Some((nodes, thickness, absence)) = bed.none {
            self.tell_thinner(below, at, &bed.continued, &nodes, &absence);
            self.tell(below, at, &nodes, &thickness, &absence, below);
            if below + 1 == at {
                self.contacts[at] = Some(Contact {
                    nodes,
                    thickness,
                    absence,
                    rests: true,
                    is_open: false,
                });
            }
        }
        self.layers[at].sheet = self.layers[below].given.plus(&bed.continued);
        let [x, y] = [self.model.domain.x, self.model.domain.y];
        let corner = |i: usize| DVec3::new(x[i], y[i], 0.0);
        if bed.continued.range(corner(0), corner(1))?.0 <= 0.0 {
            self.layers[at].above = Some(below);
        }
        Ok(())
    }

    /// Decides for all horizons that are given by heights of their own.
    pub(super) fn coincidences(
        &mut self,
        [base, _]: &[Horizon; 2],
        base_surface: Option<&HorizonSurface>,
    ) -> Result<(), HorizonError> {
        let lowered = self.lowered(base, base_surface);
        for at in 1..self.layers.len() {
            if self.contacts[at].is_none() && self.layers[at].above != Some(at - 1) {
                self.contacts[at] = self.contact(at);
            }
        }
        self.settle();
        for at in 1..self.layers.len() {
            let contact = self.contacts[at].take();
            if let Some(contact) = contact.as_ref().filter(|one| one.rests && one.is_open) {
                self.rest(at, contact)?;
            }
            self.contacts[at] = contact;
        }
        let raised: Vec<_> = (0..self.layers.len() - 1)
            .map(|at| self.raised(at, lowered[at].as_ref()))
            .collect();
        for (at, change) in raised.into_iter().enumerate() {
            if let Some(change) = change {
                let more = change.nodes.interpolated(&change.values)?;
                self.layers[at].sheet = self.layers[at].sheet.plus(&more);
                let younger = change.other;
                self.tell(
                    at,
                    younger,
                    &change.nodes,
                    &change.thickness,
                    &change.absence,
                    younger,
                );
            }
        }
        for (at, change) in lowered.into_iter().enumerate() {
            if let Some(change) = change {
                let more = change.nodes.interpolated(&change.values)?;
                self.layers[at].sheet = self.layers[at].sheet.plus(&more);
                self.tell_of_base(at, &change);
            }
        }
        Ok(())
    }

    /// The nodes of the first of some layers that has a grid, else of the first that has points.
    pub(super) fn nodes_of(&self, layers: &[usize]) -> Option<Nodes> {
        let grid = layers.iter().find_map(|at| self.layers[*at].nodes);
        let points = |at: &usize| self.layers[*at].points.as_ref()?.nodes;
        grid.or_else(|| layers.iter().find_map(points))
    }

    /// A layer's heights at the nodes of a grid.
    pub(super) fn sample(&mut self, layer: usize, nodes: &Nodes) -> Rc<Vec<f64>> {
        let grid = self.grids.iter().position(|grid| grid == nodes);
        let grid = grid.unwrap_or_else(|| {
            self.grids.push(*nodes);
            self.grids.len() - 1
        });
        let horizon = &self.layers[layer].given;
        let sampled = || Rc::new(nodes.sample(|at| horizon.height(at.x, at.y)));
        Rc::clone(self.samples.entry((layer, grid)).or_insert_with(sampled))
    }

    /// The thickness between two layers at the nodes of a grid, as the data say.
    pub(super) fn thickness(&mut self, [older, younger]: [usize; 2], nodes: &Nodes) -> Vec<f64> {
        let mut thickness = minus(&self.sample(younger, nodes), &self.sample(older, nodes));
        let known = [older, younger].map(|at| Known::from(&self.layers[at]));
        tell_thickness(known, nodes, self.least, &mut thickness);
        thickness
    }

    /// How deep a layer lies at least behind another one where it is absent, so that no swing brings it back.
    pub(super) fn depth(&self, layers: [usize; 2]) -> f64 {
        let swings = layers.map(|at| self.layers[at].swing);
        self.least.max(2.0 * (swings[0] + swings[1]))
    }
}

pub(super) fn minus(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter().zip(other).map(|(a, b)| a - b).collect()
}
