//! The tables of a [`Topology`] made flat for the kernel, and everything about them that can be checked without geometry.
//!
//! The kernel would answer most of these defects with an exception that names no entry, or with a shape that fails later.

use crate::error::{BridgeError, input};
use crate::ffi::bridge;
use crate::geometry::{
    Curve, Pcurve, Surface, check_curve, check_pcurve, check_surface, curve_domain, finite, index,
    pcurve_domain, small,
};
use crate::topology::{Edge, EdgeUse, Face, Topology};

/// Flattens the tables, checking everything that needs no geometry.
pub(crate) fn checked(
    operation: &'static str,
    topology: &Topology,
) -> Result<bridge::TopologyData, BridgeError> {
    let fail = |message: String| input(operation, message);
    if !(topology.tolerance > 0.0 && topology.tolerance.is_finite()) {
        return Err(fail(format!(
            "the tolerance is {}; it must be above 0",
            topology.tolerance
        )));
    }
    if topology.faces.is_empty() {
        return Err(fail("there are no faces".to_owned()));
    }
    finite("vertices", topology.vertices.as_flattened()).map_err(fail)?;
    let mut curves = Vec::with_capacity(topology.curves.len());
    for (i, curve) in topology.curves.iter().enumerate() {
        curves.push(flat_curve(curve).map_err(|e| fail(format!("curve {i}: {e}")))?);
    }
    let mut surfaces = Vec::with_capacity(topology.surfaces.len());
    for (i, surface) in topology.surfaces.iter().enumerate() {
        surfaces.push(flat_surface(surface).map_err(|e| fail(format!("surface {i}: {e}")))?);
    }
    let mut edges = Vec::with_capacity(topology.edges.len());
    for (i, edge) in topology.edges.iter().enumerate() {
        edges.push(flat_edge(topology, edge).map_err(|e| fail(format!("edge {i}: {e}")))?);
    }
    let mut faces = Vec::with_capacity(topology.faces.len());
    for (i, face) in topology.faces.iter().enumerate() {
        faces.push(flat_face(topology, face).map_err(|e| fail(format!("face {i}: {e}")))?);
    }
    Ok(bridge::TopologyData {
        tolerance: topology.tolerance,
        vertices: topology.vertices.as_flattened().to_vec(),
        curves,
        surfaces,
        edges,
        faces,
    })
}

/// Every edge of a closed shell is used twice, once in each direction.
pub(crate) fn check_closed(
    operation: &'static str,
    topology: &Topology,
) -> Result<(), BridgeError> {
    let mut uses = vec![(0_usize, 0_usize); topology.edges.len()];
    for face in &topology.faces {
        for edge_use in face.loops.iter().flatten() {
            if edge_use.reversed == face.reversed {
                uses[edge_use.edge].0 += 1;
            } else {
                uses[edge_use.edge].1 += 1;
            }
        }
    }
    for (i, (forward, backward)) in uses.iter().enumerate() {
        if is_degenerate(topology, &topology.edges[i]) || (*forward, *backward) == (1, 1) {
            continue;
        }
        return Err(input(
            operation,
            format!(
                "the shell is not closed: edge {i} is used {forward} times forwards and {backward} times backwards, not once each"
            ),
        ));
    }
    Ok(())
}

fn is_degenerate(topology: &Topology, edge: &Edge) -> bool {
    let near = |a: &[f64; 3], b: &[f64; 3]| {
        a.iter()
            .zip(b)
            .map(|(x, y)| (x - y).powi(2))
            .sum::<f64>()
            .sqrt()
            <= topology.tolerance
    };
    match &topology.curves[edge.curve] {
        Curve::Line { start, end } => near(start, end),
        Curve::BSpline { poles, .. } => poles.iter().all(|p| near(&poles[0], p)),
    }
}

fn flat_curve(curve: &Curve) -> Result<bridge::CurveData, String> {
    check_curve(curve)?;
    Ok(match curve {
        Curve::Line { start, end } => bridge::CurveData {
            degree: 0,
            knots: Vec::new(),
            poles: [*start, *end].as_flattened().to_vec(),
            weights: Vec::new(),
        },
        Curve::BSpline {
            degree,
            knots,
            poles,
            weights,
        } => bridge::CurveData {
            degree: small(*degree)?,
            knots: knots.clone(),
            poles: poles.as_flattened().to_vec(),
            weights: weights.clone().unwrap_or_default(),
        },
    })
}

fn flat_surface(surface: &Surface) -> Result<bridge::SurfaceData, String> {
    check_surface(surface)?;
    Ok(match surface {
        Surface::Plane {
            origin,
            normal,
            x_axis,
        } => bridge::SurfaceData {
            degree_u: 0,
            degree_v: 0,
            knots_u: Vec::new(),
            knots_v: Vec::new(),
            poles: [*origin, *normal, *x_axis].as_flattened().to_vec(),
            weights: Vec::new(),
        },
        Surface::BSpline {
            degree_u,
            degree_v,
            knots_u,
            knots_v,
            poles,
            weights,
        } => bridge::SurfaceData {
            degree_u: small(*degree_u)?,
            degree_v: small(*degree_v)?,
            knots_u: knots_u.clone(),
            knots_v: knots_v.clone(),
            poles: poles.as_flattened().to_vec(),
            weights: weights.clone().unwrap_or_default(),
        },
    })
}

fn flat_edge(topology: &Topology, edge: &Edge) -> Result<bridge::EdgeData, String> {
    index("curve", edge.curve, topology.curves.len())?;
    index("vertex", edge.start, topology.vertices.len())?;
    index("vertex", edge.end, topology.vertices.len())?;
    let [first, last] = edge.range;
    let (low, high) = curve_domain(&topology.curves[edge.curve]);
    if !(first < last && low <= first && last <= high) {
        return Err(format!(
            "its range is {first} to {last}; it must increase and stay within {low} to {high}"
        ));
    }
    Ok(bridge::EdgeData {
        curve: edge.curve,
        first,
        last,
        start: edge.start,
        end: edge.end,
    })
}

fn flat_face(topology: &Topology, face: &Face) -> Result<bridge::FaceData, String> {
    index("surface", face.surface, topology.surfaces.len())?;
    if face.loops.is_empty() || face.loops.iter().any(Vec::is_empty) {
        return Err("it needs at least one loop, and no loop may be empty".to_owned());
    }
    let on_plane = matches!(topology.surfaces[face.surface], Surface::Plane { .. });
    let mut uses = Vec::new();
    for (l, edges) in face.loops.iter().enumerate() {
        let ends = |edge_use: &EdgeUse| {
            let edge = &topology.edges[edge_use.edge];
            if edge_use.reversed {
                (edge.end, edge.start)
            } else {
                (edge.start, edge.end)
            }
        };
        for edge_use in edges {
            index("edge", edge_use.edge, topology.edges.len())?;
        }
        for (i, edge_use) in edges.iter().enumerate() {
            let next = &edges[(i + 1) % edges.len()];
            if ends(edge_use).1 != ends(next).0 {
                return Err(format!(
                    "loop {l} is not closed: edge {} ends at vertex {}, the next edge {} starts at vertex {}",
                    edge_use.edge,
                    ends(edge_use).1,
                    next.edge,
                    ends(next).0
                ));
            }
            let pcurve = match (&edge_use.pcurve, on_plane) {
                (None, true) => no_pcurve(),
                (Some(pcurve), false) => flat_pcurve(pcurve, &topology.edges[edge_use.edge])
                    .map_err(|e| format!("edge {} on it: {e}", edge_use.edge))?,
                (Some(_), true) => {
                    return Err(format!(
                        "edge {} has a curve on a plane; planes take none",
                        edge_use.edge
                    ));
                }
                (None, false) => {
                    return Err(format!(
                        "edge {} has no curve on the B-spline surface {}",
                        edge_use.edge, face.surface
                    ));
                }
            };
            uses.push(bridge::EdgeUseData {
                edge: edge_use.edge,
                reversed: edge_use.reversed,
                pcurve,
            });
        }
    }
    let loops = face
        .loops
        .iter()
        .map(|l| small(l.len()))
        .collect::<Result<_, _>>()?;
    Ok(bridge::FaceData {
        surface: face.surface,
        reversed: face.reversed,
        loops,
        uses,
    })
}

fn no_pcurve() -> bridge::PcurveData {
    bridge::PcurveData {
        has: false,
        degree: 0,
        knots: Vec::new(),
        poles: Vec::new(),
        weights: Vec::new(),
    }
}

fn flat_pcurve(pcurve: &Pcurve, edge: &Edge) -> Result<bridge::PcurveData, String> {
    check_pcurve(pcurve)?;
    if let Some((low, high)) = pcurve_domain(pcurve)
        && (low > edge.range[0] || high < edge.range[1])
    {
        return Err(format!(
            "its curve on the surface runs over {low} to {high}, the edge over {} to {}",
            edge.range[0], edge.range[1]
        ));
    }
    Ok(match pcurve {
        Pcurve::Line { origin, direction } => bridge::PcurveData {
            has: true,
            poles: [*origin, *direction].as_flattened().to_vec(),
            ..no_pcurve()
        },
        Pcurve::BSpline {
            degree,
            knots,
            poles,
            weights,
        } => bridge::PcurveData {
            has: true,
            degree: small(*degree)?,
            knots: knots.clone(),
            poles: poles.as_flattened().to_vec(),
            weights: weights.clone().unwrap_or_default(),
        },
    })
}
