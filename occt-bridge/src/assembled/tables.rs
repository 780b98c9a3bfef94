//! Solids whose topology is known, as tables.

use crate::cells::FaceOrigin;
use crate::geometry::{Curve, Pcurve, Surface};

/// Solids whose topology is known: tables that refer to each other by index.
///
/// Tolerances are metres, above 0, and 1e-7 is usual. The kernel wants a vertex to be as wide as its edges and an edge as wide as its
/// faces: what is narrower is widened.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tables {
    /// Where edges end.
    pub vertices: Vec<TableVertex>,
    /// Curves that edges run along.
    pub curves: Vec<Curve>,
    /// Surfaces that faces lie on.
    pub surfaces: Vec<Surface>,
    /// Curves in the parameters of surfaces; several edges may share one.
    pub pcurves: Vec<Pcurve>,
    /// Edges.
    pub edges: Vec<TableEdge>,
    /// Faces, each there once, whether one solid uses it or two.
    pub faces: Vec<TableFace>,
    /// Solids.
    pub solids: Vec<TableSolid>,
}

/// A point where edges end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableVertex {
    /// The point, m.
    pub point: [f64; 3],
    /// How far it may be from the ends of its edges.
    pub tolerance: f64,
}

/// A piece of a curve between two vertices.
#[derive(Debug, Clone, PartialEq)]
pub struct TableEdge {
    /// Index of its curve; `None` if all of it is one point (a pole of an ellipsoid), and `start` is `end`.
    pub curve: Option<usize>,
    /// Parameters at its start and end, increasing: of the curve and of all its pcurves.
    pub range: [f64; 2],
    /// Index of its first vertex.
    pub start: usize,
    /// Index of its last vertex; the first one if it is closed.
    pub end: usize,
    /// How far it may be from its surfaces.
    pub tolerance: f64,
    /// Where it runs on each B-spline surface that a face beside it lies on; planes take none.
    pub on: Vec<OnSurface>,
}

/// Where an edge runs on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OnSurface {
    /// Index of the surface.
    pub surface: usize,
    /// Index of the pcurve.
    pub forward: usize,
    /// A seam of a closed surface has two pcurves: `forward` where a loop runs along the edge, this one where a loop runs against it.
    pub reversed: Option<usize>,
}

/// A piece of a surface, bounded by loops.
#[derive(Debug, Clone, PartialEq)]
pub struct TableFace {
    /// Index of its surface.
    pub surface: usize,
    /// Edges and whether the loop runs from their end to their start. The outer loop first, counter-clockwise about the surface's
    /// normal; then holes, clockwise.
    pub loops: Vec<Vec<(usize, bool)>>,
    /// Its own tolerance.
    pub tolerance: f64,
    /// What becomes [`SolidFace::origins`](crate::SolidFace::origins).
    pub origins: Vec<FaceOrigin>,
}

/// One of the solids.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableSolid {
    /// What becomes [`Solid::owner`](crate::Solid::owner).
    pub owner: usize,
    /// Faces, and whether the solid uses them against their surface's normal: they look out of it. The outer shell first; then voids.
    pub shells: Vec<Vec<(usize, bool)>>,
}
