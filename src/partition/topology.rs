//! Finished topology as plain tables that refer to each other by index.

use glam::{DVec2, DVec3};

use super::Label;
use super::quadrature::Integral;
use crate::nurbs::{Curve, Surface};

/// Vertices, edges, faces and solids.
#[derive(Clone, Debug, Default)]
pub struct Topology {
    /// Vertices.
    pub vertices: Vec<Vertex>,
    /// Curves that edges run along.
    pub curves: Vec<CurveShape>,
    /// Curves in the parameters of surfaces.
    pub plane_curves: Vec<PlaneCurve>,
    /// Edges.
    pub edges: Vec<Edge>,
    /// Surfaces that faces lie on.
    pub sheets: Vec<SheetShape>,
    /// Faces.
    pub faces: Vec<Face>,
    /// Solids, in order of their first faces.
    pub solids: Vec<Solid>,
}

/// A point where edges end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is (m).
    pub point: DVec3,
    /// Farthest of its edges' ends (m).
    pub gap: f64,
}

/// A curve in space.
#[derive(Clone, Debug)]
pub enum CurveShape {
    /// A side that two sheets have in common.
    Known(Curve),
    /// A computed curve of degree 5.
    Computed {
        /// Flat knots.
        knots: Vec<f64>,
        /// Control points.
        points: Vec<DVec3>,
    },
}

/// A curve in the parameters of a surface.
#[derive(Clone, Debug)]
pub enum PlaneCurve {
    /// `origin + t direction`.
    Line {
        /// At t = 0.
        origin: DVec2,
        /// Per unit of t.
        direction: DVec2,
    },
    /// A computed curve of degree 5.
    Computed {
        /// Flat knots.
        knots: Vec<f64>,
        /// Control points.
        points: Vec<DVec2>,
    },
}

/// A piece of a curve between two vertices.
#[derive(Clone, Debug)]
pub struct Edge {
    /// Its curve; `None` if it is the pole of a surface.
    pub curve: Option<usize>,
    /// The parameters of its ends, on the curve and on all plane curves.
    pub range: [f64; 2],
    /// First and last vertex.
    pub ends: [usize; 2],
    /// Farthest of the curve from its surfaces, measured (m).
    pub deviation: f64,
    /// Where it runs on the surfaces of faces beside it that are not planes.
    pub on: Vec<OnSheet>,
}

/// An edge on a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OnSheet {
    /// The surface.
    pub sheet: usize,
    /// Its plane curve where a face runs along it forwards, or the only one.
    pub forward: usize,
    /// The plane curve for the other direction, if the edge is a seam.
    pub reversed: Option<usize>,
}

/// A surface, as simple as it is.
#[derive(Clone, Debug)]
pub struct SheetShape {
    /// The region that it bounds.
    pub region: usize,
    /// Its place among the region's surfaces.
    pub place: usize,
    /// Whether `S_u × S_v` points out of the region.
    pub looks_out: bool,
    /// The surface itself.
    pub surface: Surface,
    /// A point, the normal and the direction of u, if it is flat.
    pub plane: Option<[DVec3; 3]>,
}

/// A face: a trimmed piece of a surface.
#[derive(Clone, Debug)]
pub struct Face {
    /// Its surface.
    pub sheet: usize,
    /// The outer loop, then holes; edges with whether they are run through backwards.
    pub loops: Vec<Vec<(usize, bool)>>,
    /// What holds the places behind and in front of it, seen along `S_u × S_v`.
    pub labels: [Label; 2],
    /// Area and flux.
    pub integral: Integral,
}

/// A connected piece of a volume.
#[derive(Clone, Debug)]
pub struct Solid {
    /// The volume.
    pub label: usize,
    /// The outer shell, then voids; faces with whether the solid's outward normal is against the surface's.
    pub shells: Vec<Vec<(usize, bool)>>,
    /// Its size (m³).
    pub size: f64,
    /// A box that holds it (m).
    pub bounds: (DVec3, DVec3),
}
