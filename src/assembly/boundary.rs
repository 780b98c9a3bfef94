//! The kernel's tables of faces as our own.

use glam::DVec3;

use super::kernel::{Boundary, BoundaryEdge, Path, Surface};
use crate::mesh;
use crate::nurbs::{self, Curve, KnotVector};

/// The faces of a boundary, by the same numbers.
pub(crate) fn tables(boundary: &Boundary) -> Result<mesh::Tables, String> {
    let edge = |edge: &BoundaryEdge| mesh::Edge {
        curve: edge.curve,
        range: edge.range,
        start: edge.start,
        end: edge.end,
    };
    let faces = boundary.faces.iter().map(|face| mesh::Face {
        surface: face.surface,
        loops: face
            .loops
            .iter()
            .map(|uses| {
                let uses = uses.iter().map(|of| mesh::Use {
                    edge: of.edge,
                    reversed: of.reversed,
                    pcurve: of.pcurve,
                });
                uses.collect()
            })
            .collect(),
    });
    Ok(mesh::Tables {
        vertices: boundary
            .vertices
            .iter()
            .copied()
            .map(DVec3::from_array)
            .collect(),
        curves: boundary.curves.iter().map(path).collect::<Result<_, _>>()?,
        pcurves: boundary
            .pcurves
            .iter()
            .map(path)
            .collect::<Result<_, _>>()?,
        surfaces: boundary
            .surfaces
            .iter()
            .map(support)
            .collect::<Result<_, _>>()?,
        edges: boundary.edges.iter().map(edge).collect(),
        faces: faces.collect(),
    })
}

/// In space, or with z = 0.
fn point<const N: usize>(numbers: &[f64; N]) -> DVec3 {
    let at = |k: usize| numbers.get(k).copied().unwrap_or(0.0);
    DVec3::new(at(0), at(1), at(2))
}

fn path<const N: usize>(path: &Path<N>) -> Result<mesh::Path, String> {
    match path {
        Path::Line { origin, direction } => Ok(mesh::Path::Line {
            origin: point(origin),
            direction: point(direction),
        }),
        Path::BSpline {
            degree,
            knots,
            poles,
            weights,
        } => {
            let knots =
                KnotVector::new(*degree, knots.clone()).map_err(|error| error.to_string())?;
            let points: Vec<DVec3> = poles.iter().map(point).collect();
            let curve = match weights {
                Some(weights) => Curve::rational(knots, points, weights.clone()),
                None => Curve::new(knots, points),
            };
            curve
                .map(mesh::Path::Spline)
                .map_err(|error| error.to_string())
        }
    }
}

fn support(surface: &Surface) -> Result<mesh::Support, String> {
    match surface {
        Surface::Plane {
            origin,
            normal,
            x_axis,
        } => {
            let [origin, normal, x_axis] =
                [origin, normal, x_axis].map(|numbers| DVec3::from_array(*numbers));
            let y_axis = normal.cross(x_axis);
            let [x_axis, y_axis] = [x_axis, y_axis].map(DVec3::normalize);
            Ok(mesh::Support::Plane {
                origin,
                x_axis,
                y_axis,
            })
        }
        Surface::BSpline {
            degree_u,
            degree_v,
            knots_u,
            knots_v,
            poles,
            weights,
        } => {
            let knots = |degree: &usize, knots: &Vec<f64>| {
                KnotVector::new(*degree, knots.clone()).map_err(|error| error.to_string())
            };
            let (u, v) = (knots(degree_u, knots_u)?, knots(degree_v, knots_v)?);
            let net: Vec<DVec3> = poles.iter().map(point).collect();
            let surface = match weights {
                Some(weights) => nurbs::Surface::rational(u, v, net, weights.clone()),
                None => nurbs::Surface::new(u, v, net),
            };
            surface
                .map(mesh::Support::Spline)
                .map_err(|error| error.to_string())
        }
    }
}
