//! Topology as plain tables: vertices, edges and faces on curves and surfaces.
//!
//! Vertices, edges and surfaces are shared by index. Several faces may lie on one surface, and on a closed surface an edge may be a
//! seam, used twice by one face or by two, with one curve per direction.

use crate::geometry::{Curve, Pcurve, Surface};

/// Tables of vertices, curves, surfaces, edges and faces that refer to each other by index.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Topology {
    /// Points, metres.
    pub vertices: Vec<[f64; 3]>,
    /// Curves that edges run along.
    pub curves: Vec<Curve>,
    /// Surfaces that faces lie on.
    pub surfaces: Vec<Surface>,
    /// Edges.
    pub edges: Vec<Edge>,
    /// Faces.
    pub faces: Vec<Face>,
    /// How far a vertex may be from its edges, and an edge from its surfaces; metres, 1e-7 is usual.
    pub tolerance: f64,
}

/// A piece of a curve between two vertices.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Index of its curve.
    pub curve: usize,
    /// Parameters at its start and end, increasing.
    pub range: [f64; 2],
    /// Index of its first vertex.
    pub start: usize,
    /// Index of its last vertex; the first one if it is closed or degenerate.
    pub end: usize,
}

/// A piece of a surface, bounded by loops.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Index of its surface.
    pub surface: usize,
    /// Whether the face looks against its surface's normal.
    pub reversed: bool,
    /// The outer loop first, counter-clockwise seen against the surface's normal (whatever `reversed` says); then holes, clockwise.
    pub loops: Vec<Vec<EdgeUse>>,
}

/// An edge of a loop.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeUse {
    /// Index of the edge.
    pub edge: usize,
    /// Whether the loop runs from the edge's end to its start.
    pub reversed: bool,
    /// Where the edge runs in the surface's (u, v), at equal parameters; `None` on planes.
    pub pcurve: Option<Pcurve>,
}
