//! Beds given by their thickness, and the nodes at which data are known.

use glam::{DVec2, DVec3};

use crate::features::fitted::Fitted;
use crate::features::horizon::{Horizon, HorizonError};
use crate::features::pinch_out::{self, Absence, Nodes};
use crate::model::spec::Feature;
use crate::model::values::surface::HorizonSurface;

/// The thickness of a bed over the plan.
pub(super) struct Bed {
    /// What the horizon above it lies above the one below it, for whatever refers to it.
    pub(super) reference: Horizon,
    /// The same, going on below 0 where there is nothing.
    pub(super) continued: Horizon,
    /// By how much the reference is off where it says nothing.
    pub(super) swing: f64,
    /// The nodes of its grid, the thicknesses there, and where they are nothing.
    pub(super) none: Option<(Nodes, Vec<f64>, Absence)>,
}

impl Bed {
    /// A thickness as drawn; no more than the least one it is nothing, and then goes on below 0 by no less than a depth.
    pub(super) fn of(
        drawn: Horizon,
        spec: &HorizonSurface,
        [least, depth]: [f64; 2],
        plan: [DVec2; 2],
    ) -> Result<Self, HorizonError> {
        let beside = |continued: Horizon| Self {
            continued,
            reference: drawn.clone(),
            swing: 0.0,
            none: None,
        };
        match (spec, nodes(spec, &[])) {
            (HorizonSurface::Points { points, tolerance }, _) => {
                let fit = |points: &[DVec3]| Horizon::points(points, *tolerance);
                pinch_out::continued_points(points, least, &drawn, &fit).map(beside)
            }
            (HorizonSurface::File(file), _) => {
                let fit = |points: &[DVec3]| Ok(Fitted::new(points, plan, file.goal)?.horizon);
                pinch_out::continued_points(&file.points, least, &drawn, &fit).map(beside)
            }
            (_, Some(nodes)) => {
                let thickness = nodes.sample(|at| drawn.height(at.x, at.y));
                let absence = Absence::at_nodes(&thickness, nodes.counts, least);
                if absence.is_empty() || absence.is_all() {
                    return Ok(Self::everywhere(drawn));
                }
                let continued = nodes.interpolated(&absence.continued(&thickness, depth))?;
                let reference = nodes.clamped(&continued)?.unwrap_or(drawn);
                Ok(Self {
                    swing: nodes.swing(&reference, &continued),
                    reference,
                    continued,
                    none: Some((nodes, thickness, absence)),
                })
            }
            _ => Ok(Self::everywhere(drawn)),
        }
    }

    fn everywhere(drawn: Horizon) -> Self {
        Self {
            reference: drawn.clone(),
            continued: drawn,
            swing: 0.0,
            none: None,
        }
    }
}

/// The nodes at which a surface's heights are data.
pub(super) fn nodes(surface: &HorizonSurface, features: &[Feature]) -> Option<Nodes> {
    match surface {
        HorizonSurface::Grid { x, y, heights } => Some(Nodes {
            low: DVec2::new(x[0], y[0]),
            high: DVec2::new(x[1], y[1]),
            counts: [heights.first()?.len(), heights.len()],
        }),
        HorizonSurface::Above { horizon, thickness } => nodes(thickness, features)
            .or_else(|| nodes(features[*horizon].kind.base()?.surface, features)),
        HorizonSurface::Level(_)
        | HorizonSurface::Dipping { .. }
        | HorizonSurface::Points { .. }
        | HorizonSurface::Net { .. }
        | HorizonSurface::File(_) => None,
    }
}

/// The same of the domain's base or top.
pub(super) fn bound_nodes(surface: Option<&HorizonSurface>) -> Option<Nodes> {
    surface.and_then(|surface| nodes(surface, &[]))
}
