//! The topology that the partition kernel found, as the bridge's tables.

use glam::DVec3;

use crate::assembly::kernel::{
    Curve, DOMAIN, FaceOrigin, OnSurface, Pcurve, Surface, TableEdge, TableFace, TableSolid,
    TableVertex, Tables,
};
use crate::assembly::splines::{self, EXACT};
use crate::partition::{CurveShape, PlaneCurve, SheetShape, Topology};

/// Degree of computed curves.
const DEGREE: usize = 5;

/// The topology as the bridge's tables. What bounds the domain has the domain's own argument.
pub(super) fn tables(topology: &Topology, first_bound: usize) -> Tables {
    let argument = |region: usize| {
        if region < first_bound { region } else { DOMAIN }
    };
    Tables {
        vertices: topology
            .vertices
            .iter()
            .map(|vertex| TableVertex {
                point: vertex.point.to_array(),
                tolerance: EXACT.max(1.1 * vertex.gap),
            })
            .collect(),
        curves: topology.curves.iter().map(curve).collect(),
        surfaces: topology.sheets.iter().map(surface).collect(),
        pcurves: topology.plane_curves.iter().map(pcurve).collect(),
        edges: topology
            .edges
            .iter()
            .map(|edge| TableEdge {
                curve: edge.curve,
                range: edge.range,
                start: edge.ends[0],
                end: edge.ends[1],
                // Between the samples a curve is a little farther off.
                tolerance: EXACT.max(2.0 * edge.deviation),
                on: edge
                    .on
                    .iter()
                    .map(|on| OnSurface {
                        surface: on.sheet,
                        forward: on.forward,
                        reversed: on.reversed,
                    })
                    .collect(),
            })
            .collect(),
        faces: topology
            .faces
            .iter()
            .map(|face| {
                let sheet = &topology.sheets[face.sheet];
                TableFace {
                    surface: face.sheet,
                    loops: face.loops.clone(),
                    tolerance: EXACT,
                    origins: vec![FaceOrigin {
                        argument: argument(sheet.region),
                        face: sheet.place,
                        same_orientation: sheet.looks_out,
                    }],
                }
            })
            .collect(),
        solids: topology
            .solids
            .iter()
            .map(|solid| TableSolid {
                owner: solid.label,
                shells: solid.shells.clone(),
            })
            .collect(),
    }
}

fn curve(shape: &CurveShape) -> Curve {
    match shape {
        CurveShape::Known(curve) => splines::curve(curve),
        CurveShape::Computed { knots, points } => Curve::BSpline {
            degree: DEGREE,
            knots: knots.clone(),
            poles: points.iter().map(DVec3::to_array).collect(),
            weights: None,
        },
    }
}

fn pcurve(shape: &PlaneCurve) -> Pcurve {
    match shape {
        PlaneCurve::Line { origin, direction } => Pcurve::Line {
            origin: origin.to_array(),
            direction: direction.to_array(),
        },
        PlaneCurve::Computed { knots, points } => Pcurve::BSpline {
            degree: DEGREE,
            knots: knots.clone(),
            poles: points.iter().map(glam::DVec2::to_array).collect(),
            weights: None,
        },
    }
}

fn surface(sheet: &SheetShape) -> Surface {
    match sheet.plane {
        Some([origin, normal, x_axis]) => Surface::Plane {
            origin: origin.to_array(),
            normal: normal.to_array(),
            x_axis: x_axis.to_array(),
        },
        None => splines::spline(&sheet.surface),
    }
}
