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
mod change;
mod contact;
mod deciding;
mod points;
mod told;

use std::collections::BTreeMap;

use bed::{Bed, bound_nodes, nodes};
use deciding::{Deciding, Layer};
use points::Points;

use glam::Vec3Swizzles;

use crate::features::horizon::{Horizon, HorizonError};
use crate::model::realisation::RealisationError;
use crate::model::selection::Selection;
use crate::model::spec::Model;
use crate::model::values::surface::HorizonSurface;

/// Heights are equal within this fraction of the domain's diagonal, whatever the least thickness: what rounding leaves.
const ROUNDING: f64 = 1e-12;

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
                    let (low, high) = model.domain.corners();
                    let plan = [low.xy(), high.xy()];
                    let bed = Bed::of(horizon, thickness, [least, least.max(2.0 * swing)], plan);
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
                points: Points::of(Some(base.surface), &given[&feature]),
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
            points: Points::of(model.domain.top.as_ref(), &bounds[1]),
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
