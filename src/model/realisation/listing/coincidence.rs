//! Horizons that coincide over an area: what that means, by their age and their rules.
//!
//! Where data say that two horizons are equal, the bed between them is absent. Splines through equal heights are equal only
//! at the nodes, and a kernel finds no line along which the bed ends. So the thickness is the function that counts: it goes
//! below 0 where the data say 0 ([`Absence::continued`]), and its zero line is where the bed ends. Which of the two surfaces
//! gives way there is decided so that none shows that was not meant:
//!
//! - a horizon that *rests* on an older one goes on below it: its unit is what lies above both (`VolumeRules::above`), or, if
//!   it is onlapping, takes from the unit above the older one alone. The older surface stays as it is. So it is for horizons
//!   given by their thickness, for onlapping ones, and wherever the younger data have the kink where the bed ends;
//! - else the older one *is cut*: it goes on above the younger one, which takes all there. So it is where the younger one
//!   cuts down elsewhere, or the older data have the kink: exported horizons follow the unconformity that has cut them.
//!
//! The domain's top cuts likewise, and horizons go on below its base.

mod bed;
mod told;

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use glam::DVec3;

use bed::{Bed, bound_nodes, nodes};

use crate::features::horizon::{Horizon, HorizonError};
use crate::features::pinch_out::{Absence, Nodes};
use crate::model::realisation::RealisationError;
use crate::model::selection::Selection;
use crate::model::spec::Model;
use crate::model::values::surface::HorizonSurface;
use crate::nurbs::Lattice;

/// Heights are equal within this fraction of the domain's diagonal, whatever the least thickness: what rounding leaves.
const ROUNDING: f64 = 1e-12;

/// How much farther a horizon goes on above what cuts it for every other one between, as a share.
const APART: f64 = 0.1;

/// The horizons of a model, decided.
pub(super) struct Strata {
    /// All of them, by feature.
    pub(super) horizons: BTreeMap<usize, Horizon>,
    /// By feature: the older horizon that it lies nowhere below.
    pub(super) above: BTreeMap<usize, usize>,
    /// What was decided.
    pub(super) decisions: Vec<String>,
}

impl Strata {
    /// Decides for horizons as drawn (of those above another one the thickness), and the domain's base and top.
    pub(super) fn of(
        model: &Model,
        selection: &Selection,
        drawn: BTreeMap<usize, Horizon>,
        bounds: &[Horizon; 2],
    ) -> Result<Self, RealisationError> {
        let least = model.domain.least_thickness.max(ROUNDING * diagonal(model));
        let mut given: BTreeMap<usize, Horizon> = BTreeMap::new();
        let mut beds: BTreeMap<usize, Bed> = BTreeMap::new();
        let mut swings: BTreeMap<usize, f64> = BTreeMap::new();
        for (feature, horizon) in drawn {
            let id = &model.features[feature].id;
            let own = match surface(model, feature) {
                Some(HorizonSurface::Above {
                    horizon: below,
                    thickness,
                }) => {
                    let swing = swings.get(below).copied().unwrap_or(0.0);
                    let bed = Bed::of(horizon, thickness, [least, least.max(2.0 * swing)]);
                    let bed = bed.map_err(|error| impossible(id, &error))?;
                    let reference = &bed.reference;
                    let own = given
                        .get(below)
                        .map_or_else(|| reference.clone(), |below| below.plus(reference));
                    swings.insert(feature, swing + bed.swing);
                    beds.insert(feature, bed);
                    own
                }
                _ => horizon,
            };
            given.insert(feature, own);
        }
        let kept = |feature: &usize| {
            let own = &model.features[*feature];
            selection.keeps_feature(own) && selection.keeps_volume(&own.id)
        };
        let features: Vec<usize> = given.keys().copied().filter(kept).collect();
        let top = bound_nodes(model.domain.top.as_ref());
        let mut layers: Vec<Layer> = Vec::with_capacity(features.len() + 1);
        for &feature in &features {
            let Some(base) = model.features[feature].kind.base() else {
                continue;
            };
            layers.push(Layer {
                name: model.features[feature].id.clone(),
                given: given[&feature].clone(),
                sheet: given[&feature].clone(),
                nodes: nodes(base.surface, &model.features),
                is_onlapping: base.is_onlapping,
                swing: swings.get(&feature).copied().unwrap_or(0.0),
                above: None,
            });
        }
        layers.push(Layer {
            name: "the domain's top".to_owned(),
            given: bounds[1].clone(),
            sheet: bounds[1].clone(),
            nodes: top,
            is_onlapping: false,
            swing: 0.0,
            above: None,
        });
        let mut decided = Deciding {
            model,
            contacts: layers.iter().map(|_| None).collect(),
            layers,
            samples: BTreeMap::new(),
            grids: Vec::new(),
            least,
            decisions: Vec::new(),
        };
        for (at, feature) in features.iter().enumerate() {
            let Some(HorizonSurface::Above { horizon, .. }) = surface(model, *feature) else {
                continue;
            };
            // What is left out has no side on which anything could rest: its surface is a reference.
            if let Some(below) = features.iter().position(|other| other == horizon)
                && let Some(bed) = beds.remove(feature)
            {
                let made = decided.isochore([below, at], bed);
                made.map_err(|error| impossible(&model.features[*feature].id, &error))?;
            }
        }
        decided
            .coincidences(bounds, model.domain.base.as_ref())
            .map_err(|error| impossible("domain", &error))?;
        let mut strata = Self {
            horizons: given,
            above: BTreeMap::new(),
            decisions: decided.decisions,
        };
        for (feature, layer) in features.iter().zip(decided.layers) {
            strata.horizons.insert(*feature, layer.sheet);
            if let Some(below) = layer.above {
                strata.above.insert(*feature, features[below]);
            }
        }
        Ok(strata)
    }
}

fn impossible(volume: &str, error: &HorizonError) -> RealisationError {
    RealisationError::Impossible {
        volume: volume.to_owned(),
        reason: error.to_string(),
    }
}

fn diagonal(model: &Model) -> f64 {
    model
        .domain
        .size()
        .iter()
        .map(|length| length * length)
        .sum::<f64>()
        .sqrt()
}

/// The surface of a feature that is a base.
fn surface(model: &Model, feature: usize) -> Option<&HorizonSurface> {
    Some(model.features[feature].kind.base()?.surface)
}

/// A horizon that takes part, or the domain's top.
struct Layer {
    name: String,
    /// As the data say.
    given: Horizon,
    /// As it is built.
    sheet: Horizon,
    nodes: Option<Nodes>,
    is_onlapping: bool,
    /// By how much its given heights may be off those that it is built with, where it shows (m).
    swing: f64,
    /// The layer that it lies nowhere below.
    above: Option<usize>,
}

/// What it means that a layer is equal to the one before it over an area.
struct Contact {
    nodes: Nodes,
    thickness: Vec<f64>,
    absence: Absence,
    /// Whether it rests on the older one; else that one is cut.
    rests: bool,
    /// Whether that can still be changed.
    is_open: bool,
}

/// Horizons while it is decided.
struct Deciding<'a> {
    model: &'a Model,
    layers: Vec<Layer>,
    /// By layer: how it meets the one before it.
    contacts: Vec<Option<Contact>>,
    /// Heights of layers at the nodes of grids.
    samples: BTreeMap<(usize, usize), Rc<Vec<f64>>>,
    grids: Vec<Nodes>,
    least: f64,
    decisions: Vec<String>,
}

impl Deciding<'_> {
    /// Lets a horizon rest on an older one where its thickness above that is none.
    fn isochore(&mut self, [below, at]: [usize; 2], bed: Bed) -> Result<(), HorizonError> {
        if let Some((nodes, thickness, absence)) = bed.none {
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
    fn coincidences(
        &mut self,
        [base, _]: &[Horizon; 2],
        base_surface: Option<&HorizonSurface>,
    ) -> Result<(), HorizonError> {
        let lowered = self.lowered(base, bound_nodes(base_surface));
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

    /// A layer's heights at the nodes of a grid.
    fn sample(&mut self, layer: usize, nodes: &Nodes) -> Rc<Vec<f64>> {
        let grid = self.grids.iter().position(|grid| grid == nodes);
        let grid = grid.unwrap_or_else(|| {
            self.grids.push(*nodes);
            self.grids.len() - 1
        });
        let horizon = &self.layers[layer].given;
        let sampled = || Rc::new(nodes.sample(|at| horizon.height(at.x, at.y)));
        Rc::clone(self.samples.entry((layer, grid)).or_insert_with(sampled))
    }

    /// How a layer meets the one before it, if they are equal over an area.
    fn contact(&mut self, at: usize) -> Option<Contact> {
        let nodes = self.layers[at].nodes.or(self.layers[at - 1].nodes)?;
        let (older, younger) = (self.sample(at - 1, &nodes), self.sample(at, &nodes));
        let thickness = minus(&younger, &older);
        let absence = Absence::over_areas(&thickness, nodes.counts, self.least);
        let alike = || are_alike(&self.layers[at - 1].given, &self.layers[at].given);
        if absence.is_empty() || absence.is_all() && alike() {
            return None;
        }
        let layer = &self.layers[at];
        let is_top = at + 1 == self.layers.len();
        let cuts_down = thickness.iter().any(|t| *t < -self.least);
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
    fn settle(&mut self) {
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
            let (own, next) = (self.sample(at, &nodes), self.sample(at + 1, &nodes));
            let least = self.least;
            if let Some(contact) = &mut self.contacts[at] {
                let meets = |k: usize| contact.absence.at(k) && (next[k] - own[k]).abs() <= least;
                contact.rests = !(0..own.len()).any(meets);
            }
        }
    }

    /// Lets a layer go on below the one before it.
    fn rest(&mut self, at: usize, contact: &Contact) -> Result<(), HorizonError> {
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

    /// How deep a layer lies at least behind another one where it is absent, so that no swing brings it back.
    fn depth(&self, layers: [usize; 2]) -> f64 {
        let swings = layers.map(|at| self.layers[at].swing);
        self.least.max(2.0 * (swings[0] + swings[1]))
    }

    /// How a layer goes on above those that cut it.
    fn raised(&mut self, at: usize, lowered: Option<&Change>) -> Option<Change> {
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
        let own_nodes = self.layers[at].nodes;
        let mut younger = cutting.iter();
        let nodes = younger.find_map(|younger| self.layers[*younger].nodes);
        let nodes = own_nodes.or(nodes)?;
        let own = self.sample(at, &nodes);
        let mut thickness = vec![f64::INFINITY; own.len()];
        let mut other = *cutting.first()?;
        let mut closest = vec![other; own.len()];
        for younger in cutting {
            let heights = self.sample(younger, &nodes);
            for (k, least) in thickness.iter_mut().enumerate() {
                let own = heights[k] - own[k];
                if own < *least {
                    (*least, closest[k]) = (own, younger);
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
                let target = own[k] + thickness[k] - *value * (1.0 + APART * between);
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
    fn lowered(&mut self, base: &Horizon, base_nodes: Option<Nodes>) -> Vec<Option<Change>> {
        let mut changes = Vec::new();
        for at in 0..self.layers.len() - 1 {
            let change = self.layers[at].nodes.or(base_nodes).and_then(|nodes| {
                let floor = nodes.sample(|at| base.height(at.x, at.y));
                let thickness = minus(&self.sample(at, &nodes), &floor);
                let absence = Absence::over_areas(&thickness, nodes.counts, self.least);
                let alike = || absence.is_all() && are_alike(base, &self.layers[at].given);
                (!absence.is_empty() && !alike()).then(|| {
                    let values = minus(&absence.continued(&thickness, self.least), &thickness);
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

/// How a layer goes on where it is absent.
struct Change {
    nodes: Nodes,
    thickness: Vec<f64>,
    absence: Absence,
    /// What is added to its heights at the nodes.
    values: Vec<f64>,
    /// The layer that cuts it.
    other: usize,
}

/// Whether two horizons that are equal everywhere are so by their form: these are one to the plan.
fn are_alike(one: &Horizon, other: &Horizon) -> bool {
    let frame = |lattice: &Arc<Lattice>| (lattice.corners(), lattice.counts());
    let frames = |horizon: &Horizon| horizon.lattices().iter().map(frame).collect::<Vec<_>>();
    frames(one) == frames(other)
}

fn minus(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter().zip(other).map(|(a, b)| a - b).collect()
}
