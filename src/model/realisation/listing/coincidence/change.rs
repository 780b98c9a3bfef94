//! How horizons go on where they are absent: above what cuts them, and below the domain's base.

use std::sync::Arc;

use super::bed::bound_nodes;
use super::deciding::{Deciding, minus};
use super::points::{Known, Points, tell_thickness};
use crate::features::horizon::Horizon;
use crate::features::pinch_out::{Absence, Nodes};
use crate::model::values::surface::HorizonSurface;
use crate::nurbs::Lattice;

/// How much farther a horizon goes on above what cuts it for every other one between, as a share.
const APART: f64 = 0.1;

/// How a layer goes on where it is absent.
pub(super) struct Change {
    pub(super) nodes: Nodes,
    pub(super) thickness: Vec<f64>,
    pub(super) absence: Absence,
    /// What is added to its heights at the nodes.
    pub(super) values: Vec<f64>,
    /// The layer that cuts it.
    pub(super) other: usize,
}

impl Deciding<'_> {
    /// How a layer goes on above those that cut it.
    pub(super) fn raised(&mut self, at: usize, lowered: Option<&Change>) -> Option<Change> {
        // What rests on it, directly or on what does, does not cut it.
        let rests = |younger: &usize| {
            let contact = self.contacts[*younger].as_ref();
            self.layers[*younger].above == Some(*younger - 1)
                || contact.is_some_and(|contact| contact.rests)
        };
        let resting = (at + 1..self.layers.len()).take_while(rests);
        let first = at + 1 + resting.count();
        let cutting: Vec<usize> = (first..self.layers.len())
            .filter(|younger| !self.layers[*younger].is_onlapping)
            .collect();
        let those: Vec<usize> = std::iter::once(at).chain(cutting.iter().copied()).collect();
        let nodes = self.nodes_of(&those)?;
        let own = self.sample(at, &nodes);
        // Where what cuts it lies, at every node.
        let mut cut_at = own.to_vec();
        let mut thickness = vec![f64::INFINITY; own.len()];
        let mut other = *cutting.first()?;
        let mut closest = vec![other; own.len()];
        for younger in cutting {
            let heights = self.sample(younger, &nodes);
            let above = self.thickness([at, younger], &nodes);
            for (k, least) in thickness.iter_mut().enumerate() {
                if above[k] < *least {
                    (*least, closest[k], cut_at[k]) = (above[k], younger, heights[k]);
                }
            }
        }
        let mut absence = Absence::over_areas(&thickness, nodes.counts, self.least);
        if let Some(lowered) = lowered.filter(|lowered| lowered.nodes == nodes) {
            absence = absence.without(|k| lowered.absence.at(k));
        }
        let alike = |other: usize| are_alike(&self.layers[at].given, &self.layers[other].given);
        if absence.is_empty() || absence.is_all() && alike(other) {
            return None;
        }
        if let Some(k) = (0..closest.len()).find(|k| absence.at(*k)) {
            other = closest[k];
        }
        // What more lies between is raised less, so that nothing coincides above either.
        let mut values = absence.continued(&thickness, self.depth([at, other]));
        let sheet = &self.layers[at].sheet;
        for (k, value) in values.iter_mut().enumerate() {
            let between = (closest[k] - at - 1) as f64;
            *value = if absence.at(k) {
                let place = nodes.place(k);
                let target = cut_at[k] - *value * (1.0 + APART * between);
                target - sheet.height(place.x, place.y)
            } else {
                0.0
            };
        }
        Some(Change {
            nodes,
            thickness,
            absence,
            values,
            other,
        })
    }

    /// How layers go on below the domain's base.
    pub(super) fn lowered(
        &mut self,
        base: &Horizon,
        base_surface: Option<&HorizonSurface>,
    ) -> Vec<Option<Change>> {
        let grid = bound_nodes(base_surface);
        let points = Points::of(base_surface, base);
        let mut changes = Vec::new();
        for at in 0..self.layers.len() - 1 {
            let nodes = self.layers[at].nodes.or(grid);
            let nodes = nodes.or_else(|| self.nodes_of(&[at]));
            let nodes = nodes.or_else(|| points.as_ref()?.nodes);
            let change = nodes.and_then(|nodes| {
                let floor = nodes.sample(|at| base.height(at.x, at.y));
                let above = minus(&self.sample(at, &nodes), &floor);
                let mut thickness = above.clone();
                let known = [
                    Known {
                        horizon: base,
                        points: points.as_ref(),
                    },
                    Known::from(&self.layers[at]),
                ];
                tell_thickness(known, &nodes, self.least, &mut thickness);
                let absence = Absence::over_areas(&thickness, nodes.counts, self.least);
                let alike = || absence.is_all() && are_alike(base, &self.layers[at].given);
                (!absence.is_empty() && !alike()).then(|| {
                    let mut values = minus(&absence.continued(&thickness, self.least), &above);
                    for (entry, value) in values.iter_mut().enumerate() {
                        if !absence.at(entry) {
                            *value = 0.0;
                        }
                    }
                    Change {
                        nodes,
                        thickness,
                        absence,
                        values,
                        other: at,
                    }
                })
            });
            changes.push(change);
        }
        changes
    }
}

/// Whether two horizons that are equal everywhere are so by their form: these are one to the plan.
pub(super) fn are_alike(one: &Horizon, other: &Horizon) -> bool {
    let frame = |lattice: &Arc<Lattice>| (lattice.corners(), lattice.counts());
    let frames = |horizon: &Horizon| horizon.lattices().iter().map(frame).collect::<Vec<_>>();
    frames(one) == frames(other)
}
