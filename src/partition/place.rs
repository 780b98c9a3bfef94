//! Where a partition is made: about the middle of the domain, if that is far from the origin.
//!
//! Curves are computed to 1e-11 of the domain's diagonal. In world coordinates neighbouring numbers are farther apart than that
//! (1e-9 m at 6e6 m), so roots are not found as exactly as the search for them expects. Surfaces are moved by whole kilometres in the
//! binary sense, which rounds no control point; what is computed near the origin is moved back, and rounded once.

use std::sync::Arc;

use glam::DVec3;

use super::topology::{CurveShape, Topology};
use super::{Doubt, Membership, Region};
use crate::nurbs::Surface;

/// A domain whose middle is so many diagonals away is far.
const FAR: f64 = 16.0;
/// What the way is a multiple of (m).
const STRIDE: f64 = 1024.0;

/// By how much the domain, the first region, is to be moved; none if it is near the origin.
pub(super) fn way(regions: &[Region]) -> Option<DVec3> {
    let Some(Region::Block { low, high }) = regions.first() else {
        return None;
    };
    let middle = 0.5 * (*low + *high);
    let far = FAR * low.distance(*high).max(STRIDE);
    let way = middle.to_array().map(|at| {
        if at.abs() > far {
            -(at / STRIDE).round() * STRIDE
        } else {
            0.0
        }
    });
    way.iter()
        .any(|way| *way != 0.0)
        .then(|| DVec3::from_array(way))
}

/// A membership elsewhere.
#[derive(Debug)]
struct Moved {
    inside: Arc<dyn Membership>,
    by: DVec3,
}

impl Membership for Moved {
    fn holds(&self, point: DVec3) -> bool {
        self.inside.holds(point - self.by)
    }
}

/// A region elsewhere.
pub(super) fn moved(region: Region, by: DVec3) -> Region {
    let all = |surfaces: Vec<Surface>| surfaces.iter().map(|one| one.moved(by)).collect();
    let elsewhere = |inside: Arc<dyn Membership>| Arc::new(Moved { inside, by });
    match region {
        Region::Shell(surfaces) => Region::Shell(all(surfaces)),
        Region::PartOf { surfaces, shell } => Region::Side {
            surfaces: all(surfaces),
            inside: elsewhere(shell),
        },
        Region::Side { surfaces, inside } => Region::Side {
            surfaces: all(surfaces),
            inside: elsewhere(inside),
        },
        Region::Block { low, high } => Region::Block {
            low: low + by,
            high: high + by,
        },
        Region::Above(level) => Region::Above(level + by.z),
    }
}

/// Moves what was found.
pub(super) fn restore(topology: &mut Topology, doubts: &mut [Doubt], by: DVec3) {
    for vertex in &mut topology.vertices {
        vertex.point += by;
    }
    for curve in &mut topology.curves {
        match curve {
            CurveShape::Known(known) => *known = known.moved(by),
            CurveShape::Computed { points, .. } => points.iter_mut().for_each(|point| *point += by),
        }
    }
    for sheet in &mut topology.sheets {
        sheet.surface = sheet.surface.moved(by);
        if let Some([point, ..]) = &mut sheet.plane {
            *point += by;
        }
    }
    for solid in &mut topology.solids {
        solid.bounds.0 += by;
        solid.bounds.1 += by;
    }
    for doubt in doubts {
        doubt.low += by;
        doubt.high += by;
    }
}
