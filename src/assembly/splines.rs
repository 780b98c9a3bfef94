//! Our curves and surfaces as the kernel's, and edges on isoparametric lines.

use glam::{DVec2, DVec3};

use super::kernel::{Curve, EdgeUse, Pcurve, Surface};
use crate::nurbs;

/// Topological tolerance of shells built from their own control nets (m).
pub(crate) const EXACT: f64 = 1e-7;

/// An edge on the isoparametric line at this v: its own parameter is u.
pub(super) fn along_u(edge: usize, v: f64, reversed: bool) -> EdgeUse {
    line(edge, reversed, DVec2::new(0.0, v), DVec2::X)
}

/// An edge on the isoparametric line at this u: its own parameter is v.
pub(super) fn along_v(edge: usize, u: f64, reversed: bool) -> EdgeUse {
    line(edge, reversed, DVec2::new(u, 0.0), DVec2::Y)
}

fn line(edge: usize, reversed: bool, origin: DVec2, direction: DVec2) -> EdgeUse {
    let pcurve = Pcurve::Line {
        origin: origin.to_array(),
        direction: direction.to_array(),
    };
    EdgeUse {
        edge,
        reversed,
        pcurve: Some(pcurve),
    }
}

fn weights(weights: &[f64]) -> Option<Vec<f64>> {
    weights
        .iter()
        .any(|weight| *weight != weights[0])
        .then(|| weights.to_vec())
}

pub(super) fn curve(curve: &nurbs::Curve) -> Curve {
    Curve::BSpline {
        degree: curve.knots().degree(),
        knots: curve.knots().as_slice().to_vec(),
        poles: curve.points().iter().map(DVec3::to_array).collect(),
        weights: weights(curve.weights()),
    }
}

pub(super) fn spline(surface: &nurbs::Surface) -> Surface {
    Surface::BSpline {
        degree_u: surface.knots_u().degree(),
        degree_v: surface.knots_v().degree(),
        knots_u: surface.knots_u().as_slice().to_vec(),
        knots_v: surface.knots_v().as_slice().to_vec(),
        poles: surface.net().iter().map(DVec3::to_array).collect(),
        weights: weights(surface.weights()),
    }
}
