//! The tables as the kernel's side reads them: rows that own no memory, and one pool of numbers.

use super::tables::Tables;
use crate::ffi::bridge;
use crate::geometry::{Curve, Pcurve, Surface, pole_count, small};

/// Of checked tables.
pub(super) fn flat(tables: &Tables) -> Result<bridge::AssembledData, String> {
    let mut data = bridge::AssembledData {
        vertices: Vec::with_capacity(tables.vertices.len()),
        curves: Vec::with_capacity(tables.curves.len()),
        surfaces: Vec::with_capacity(tables.surfaces.len()),
        pcurves: Vec::with_capacity(tables.pcurves.len()),
        numbers: Vec::new(),
        edges: Vec::with_capacity(tables.edges.len()),
        on: Vec::new(),
        faces: Vec::with_capacity(tables.faces.len()),
        loops: Vec::new(),
        uses: Vec::new(),
        solids: bridge::MergeData::default(),
    };
    add_geometry(tables, &mut data)?;
    let edges = edge_tolerances(tables);
    let vertices = vertex_tolerances(tables, &edges);
    for (vertex, tolerance) in tables.vertices.iter().zip(vertices) {
        data.vertices.push(bridge::VertexRow {
            point: vertex.point,
            tolerance,
        });
    }
    add_edges(tables, &edges, &mut data)?;
    add_faces(tables, &mut data)?;
    add_solids(tables, &mut data.solids)?;
    Ok(data)
}

/// No edge is narrower than its faces.
fn edge_tolerances(tables: &Tables) -> Vec<f64> {
    let mut widest: Vec<f64> = tables.edges.iter().map(|e| e.tolerance).collect();
    for face in &tables.faces {
        for (edge, _) in face.loops.iter().flatten() {
            widest[*edge] = widest[*edge].max(face.tolerance);
        }
    }
    widest
}

/// No vertex is narrower than its edges.
fn vertex_tolerances(tables: &Tables, edges: &[f64]) -> Vec<f64> {
    let mut widest: Vec<f64> = tables.vertices.iter().map(|v| v.tolerance).collect();
    for (edge, tolerance) in tables.edges.iter().zip(edges) {
        for vertex in [edge.start, edge.end] {
            widest[vertex] = widest[vertex].max(*tolerance);
        }
    }
    widest
}

fn add_geometry(tables: &Tables, data: &mut bridge::AssembledData) -> Result<(), String> {
    for curve in &tables.curves {
        data.curves.push(match curve {
            Curve::Line { start, end } => line(&mut data.numbers, [*start, *end].as_flattened()),
            Curve::BSpline {
                degree,
                knots,
                poles,
                weights,
            } => {
                add_numbers(
                    &mut data.numbers,
                    knots,
                    poles.as_flattened(),
                    weights.as_deref(),
                );
                spline(*degree, poles.len(), weights.is_some())?
            }
        });
    }
    for surface in &tables.surfaces {
        data.surfaces
            .push(flat_surface(surface, &mut data.numbers)?);
    }
    for pcurve in &tables.pcurves {
        data.pcurves.push(match pcurve {
            Pcurve::Line { origin, direction } => {
                line(&mut data.numbers, [*origin, *direction].as_flattened())
            }
            Pcurve::BSpline {
                degree,
                knots,
                poles,
                weights,
            } => {
                add_numbers(
                    &mut data.numbers,
                    knots,
                    poles.as_flattened(),
                    weights.as_deref(),
                );
                spline(*degree, poles.len(), weights.is_some())?
            }
        });
    }
    Ok(())
}

fn add_numbers(to: &mut Vec<f64>, knots: &[f64], poles: &[f64], weights: Option<&[f64]>) {
    to.extend_from_slice(knots);
    to.extend_from_slice(poles);
    to.extend_from_slice(weights.unwrap_or_default());
}

fn line(to: &mut Vec<f64>, numbers: &[f64]) -> bridge::CurveRow {
    to.extend_from_slice(numbers);
    bridge::CurveRow {
        degree: 0,
        poles: 2,
        rational: false,
    }
}

fn spline(degree: usize, poles: usize, rational: bool) -> Result<bridge::CurveRow, String> {
    Ok(bridge::CurveRow {
        degree: small(degree)?,
        poles: small(poles)?,
        rational,
    })
}

fn flat_surface(surface: &Surface, to: &mut Vec<f64>) -> Result<bridge::SurfaceRow, String> {
    Ok(match surface {
        Surface::Plane {
            origin,
            normal,
            x_axis,
        } => {
            to.extend_from_slice([*origin, *normal, *x_axis].as_flattened());
            bridge::SurfaceRow {
                degree_u: 0,
                degree_v: 0,
                poles_u: 0,
                poles_v: 0,
                rational: false,
            }
        }
        Surface::BSpline {
            degree_u,
            degree_v,
            knots_u,
            knots_v,
            poles,
            weights,
        } => {
            to.extend_from_slice(knots_u);
            add_numbers(to, knots_v, poles.as_flattened(), weights.as_deref());
            bridge::SurfaceRow {
                degree_u: small(*degree_u)?,
                degree_v: small(*degree_v)?,
                poles_u: small(pole_count(knots_u, *degree_u))?,
                poles_v: small(pole_count(knots_v, *degree_v))?,
                rational: weights.is_some(),
            }
        }
    })
}

fn add_edges(
    tables: &Tables,
    tolerances: &[f64],
    data: &mut bridge::AssembledData,
) -> Result<(), String> {
    for (edge, tolerance) in tables.edges.iter().zip(tolerances) {
        data.edges.push(bridge::EdgeRow {
            degenerate: edge.curve.is_none(),
            curve: small(edge.curve.unwrap_or(0))?,
            first: edge.range[0],
            last: edge.range[1],
            start: small(edge.start)?,
            end: small(edge.end)?,
            tolerance: *tolerance,
            on: small(edge.on.len())?,
        });
        for on in &edge.on {
            data.on.push(bridge::OnRow {
                surface: small(on.surface)?,
                forward: small(on.forward)?,
                seam: on.reversed.is_some(),
                reversed: small(on.reversed.unwrap_or(0))?,
            });
        }
    }
    Ok(())
}

fn add_faces(tables: &Tables, data: &mut bridge::AssembledData) -> Result<(), String> {
    for face in &tables.faces {
        data.faces.push(bridge::FaceRow {
            surface: small(face.surface)?,
            tolerance: face.tolerance,
            loops: small(face.loops.len())?,
        });
        for uses in &face.loops {
            data.loops.push(small(uses.len())?);
            for (edge, reversed) in uses {
                data.uses.push(small(2 * edge + usize::from(*reversed))?);
            }
        }
    }
    Ok(())
}

fn add_solids(tables: &Tables, data: &mut bridge::MergeData) -> Result<(), String> {
    for face in 0..tables.faces.len() {
        data.faces.push(small(face)?);
    }
    for solid in &tables.solids {
        data.shells_of_solids.push(small(solid.shells.len())?);
        for shell in &solid.shells {
            data.faces_of_shells.push(small(shell.len())?);
            for (face, reversed) in shell {
                data.uses.push(small(2 * face + usize::from(*reversed))?);
            }
        }
    }
    Ok(())
}
