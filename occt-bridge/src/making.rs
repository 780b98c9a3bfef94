//! Shapes from plain tables, for geometry whose topology is known: no Boolean operation, no sewing.

use crate::error::{BridgeError, from_kernel, input};
use crate::ffi::bridge;
use crate::geometry::{Curve, Surface};
use crate::shape::Shape;
use crate::tables::{check_closed, checked};
use crate::topology::{Edge, EdgeUse, Face, Topology};

/// One closed shell as a solid.
///
/// The faces must agree with each other in orientation; if they all look inwards they are all turned (by the sign of the exact
/// volume). The result is validated.
///
/// # Errors
/// [`BridgeError::Input`] names the table entry: an index out of range, a value that is not finite, knots that are not clamped, a
/// loop that does not close, an edge that is not used exactly twice, a curve that leaves its surface, an invalid result.
pub fn solid(topology: &Topology) -> Result<Shape, BridgeError> {
    let operation = "making a solid";
    let data = checked(operation, topology)?;
    check_closed(operation, topology)?;
    bridge::build_solid(&data)
        .map(Shape::new)
        .map_err(|e| from_kernel(operation, &e))
}

/// Every face by itself, in a compound: for surfaces without a volume.
///
/// # Errors
/// As [`solid`], but the edges need not be shared.
pub fn faces(topology: &Topology) -> Result<Shape, BridgeError> {
    let operation = "making faces";
    let data = checked(operation, topology)?;
    bridge::build_faces(&data)
        .map(Shape::new)
        .map_err(|e| from_kernel(operation, &e))
}

/// A box with faces in the order −x, +x, −y, +y, −z, +z.
///
/// # Errors
/// [`BridgeError::Input`] if a number is not finite or `max` is not above `min` on every axis.
pub fn box_solid(min: [f64; 3], max: [f64; 3]) -> Result<Shape, BridgeError> {
    let operation = "making a box";
    for axis in 0..3 {
        let (low, high) = (min[axis], max[axis]);
        if !(low.is_finite() && high.is_finite() && low < high) {
            let name = ["x", "y", "z"][axis];
            return Err(input(
                operation,
                format!(
                    "{name} runs from {low} to {high}; two finite numbers in increasing order are needed"
                ),
            ));
        }
    }
    solid(&box_topology(min, max))
}

/// Corner `i` has bit 0 for x, bit 1 for y, bit 2 for z.
fn box_topology(min: [f64; 3], max: [f64; 3]) -> Topology {
    let corner = |i: usize| -> [f64; 3] {
        std::array::from_fn(|axis| {
            if i >> axis & 1 == 1 {
                max[axis]
            } else {
                min[axis]
            }
        })
    };
    let mut topology = Topology {
        vertices: (0..8).map(corner).collect(),
        tolerance: 1e-7,
        ..Topology::default()
    };
    let mut edge_between = [[None; 8]; 8];
    for axis in 0..3 {
        for start in (0..8).filter(|i| i >> axis & 1 == 0) {
            let end = start | 1 << axis;
            edge_between[start][end] = Some((topology.edges.len(), false));
            edge_between[end][start] = Some((topology.edges.len(), true));
            topology.edges.push(Edge {
                curve: topology.curves.len(),
                range: [0.0, 1.0],
                start,
                end,
            });
            topology.curves.push(Curve::Line {
                start: corner(start),
                end: corner(end),
            });
        }
    }
    for axis in 0..3 {
        for side in 0..2 {
            // (a, b) turn counter-clockwise seen from +axis; seen from outside the lower side they turn the other way.
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            let at = side << axis;
            let mut turn = [at, at | 1 << a, at | 1 << a | 1 << b, at | 1 << b];
            if side == 0 {
                turn.reverse();
            }
            let mut normal = [0.0; 3];
            normal[axis] = if side == 0 { -1.0 } else { 1.0 };
            let mut x_axis = [0.0; 3];
            x_axis[a] = 1.0;
            let uses = (0..4).filter_map(|i| edge_between[turn[i]][turn[(i + 1) % 4]]);
            topology.faces.push(Face {
                surface: topology.surfaces.len(),
                reversed: false,
                loops: vec![
                    uses.map(|(edge, reversed)| EdgeUse {
                        edge,
                        reversed,
                        pcurve: None,
                    })
                    .collect(),
                ],
            });
            topology.surfaces.push(Surface::Plane {
                origin: corner(at),
                normal,
                x_axis,
            });
        }
    }
    topology
}
