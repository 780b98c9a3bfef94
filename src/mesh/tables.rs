//! What is triangulated: vertices, edges, curves, surfaces and faces as tables that refer to each other by index.
//!
//! Neighbours share their edges and vertices by index, whatever the numbers say: that is what makes triangles fit.

use glam::{DVec2, DVec3, Vec3Swizzles};

use crate::nurbs::{Curve, Surface};

/// A curve in space, or in the parameters of a surface: then z is 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Path {
    /// `origin + t direction`.
    Line {
        /// At t = 0.
        origin: DVec3,
        /// For one unit of t.
        direction: DVec3,
    },
    /// A spline.
    Spline(Curve),
}

impl Path {
    /// The point at a parameter.
    pub fn point(&self, t: f64) -> DVec3 {
        match self {
            Self::Line { origin, direction } => *origin + t * *direction,
            Self::Spline(curve) => curve.point(t),
        }
    }

    /// The direction in which it runs, of unit length; none where it stands still.
    pub(super) fn tangent(&self, t: f64) -> Option<DVec3> {
        match self {
            Self::Line { direction, .. } => direction.try_normalize(),
            Self::Spline(curve) => curve.tangent(t),
        }
    }

    /// Where its pieces meet, between two parameters.
    pub(super) fn knots(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        match self {
            Self::Line { .. } => Vec::new(),
            Self::Spline(curve) => {
                let distinct = curve.knots().distinct();
                let knots = distinct.into_iter().map(|(knot, _)| knot);
                knots.filter(|knot| from < *knot && *knot < to).collect()
            }
        }
    }
}

/// A surface that faces lie on.
#[derive(Clone, Debug, PartialEq)]
pub enum Support {
    /// `origin + u x_axis + v y_axis`, the axes of unit length and at right angles.
    Plane {
        /// At (0, 0).
        origin: DVec3,
        /// Along u.
        x_axis: DVec3,
        /// Along v.
        y_axis: DVec3,
    },
    /// A spline; its normal is `∂u × ∂v`.
    Spline(Surface),
}

/// Two directions span no plane if the sine of the angle between them is less.
const PARALLEL: f64 = 1e-9;
/// A derivative vanishes if it is so much shorter than the other one.
const VANISHED: f64 = 1e-9;

impl Support {
    /// The point at (u, v).
    pub fn point(&self, uv: DVec2) -> DVec3 {
        match self {
            Self::Plane {
                origin,
                x_axis,
                y_axis,
            } => *origin + uv.x * *x_axis + uv.y * *y_axis,
            Self::Spline(surface) => surface.point(uv.x, uv.y),
        }
    }

    /// The unit normal at (u, v); none where the surface has no tangent plane that derivatives tell.
    pub fn normal(&self, uv: DVec2) -> Option<DVec3> {
        match self {
            Self::Plane { x_axis, y_axis, .. } => Some(x_axis.cross(*y_axis)),
            Self::Spline(surface) => {
                let derivatives = surface.derivatives(uv.x, uv.y, 1);
                // In units of the whole surface, so that neither is short only for its parameter's sake.
                let size = |(from, to): (f64, f64)| to - from;
                let along_u = derivatives[1][0] * size(surface.knots_u().domain());
                let along_v = derivatives[0][1] * size(surface.knots_v().domain());
                let lengths = [along_u.length(), along_v.length()];
                let product = along_u.cross(along_v);
                let is_flat = product.length() <= PARALLEL * lengths[0] * lengths[1];
                let has_vanished =
                    lengths[0].min(lengths[1]) <= VANISHED * lengths[0].max(lengths[1]);
                if is_flat || has_vanished {
                    // A pole: second derivatives may tell.
                    return surface.normal(uv.x, uv.y);
                }
                Some(product.normalize())
            }
        }
    }

    /// The parameters of a point on a plane; none of a spline.
    pub(super) fn flat(&self, point: DVec3) -> Option<DVec2> {
        match self {
            Self::Plane {
                origin,
                x_axis,
                y_axis,
            } => {
                let from = point - *origin;
                Some(DVec2::new(from.dot(*x_axis), from.dot(*y_axis)))
            }
            Self::Spline(_) => None,
        }
    }
}

/// A piece of a curve between two vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Its curve; none if it is a point, the pole of a surface.
    pub curve: Option<usize>,
    /// The piece of the curve that it is, as parameters.
    pub range: [f64; 2],
    /// Its first vertex.
    pub start: usize,
    /// Its last vertex.
    pub end: usize,
}

/// An edge of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Use {
    /// The edge.
    pub edge: usize,
    /// Whether the loop runs from the edge's end to its start.
    pub reversed: bool,
    /// Where it runs in the surface's parameters, by the edge's own parameter; none on planes.
    pub pcurve: Option<usize>,
}

/// A face, as it lies on its surface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Face {
    /// Its surface.
    pub surface: usize,
    /// Loops from end to end: around the face counter-clockwise seen against the surface's normal, around holes clockwise.
    pub loops: Vec<Vec<Use>>,
}

/// Faces with what they consist of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tables {
    /// Where edges end (m).
    pub vertices: Vec<DVec3>,
    /// Curves in space.
    pub curves: Vec<Path>,
    /// Curves in the parameters of surfaces.
    pub pcurves: Vec<Path>,
    /// Surfaces.
    pub surfaces: Vec<Support>,
    /// Edges.
    pub edges: Vec<Edge>,
    /// Faces.
    pub faces: Vec<Face>,
}

/// A side of an edge: a face's surface, and where the edge runs on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<'a> {
    pub(super) support: &'a Support,
    pub(super) pcurve: Option<&'a Path>,
}

impl Side<'_> {
    /// The parameters of the edge's point at t.
    pub(super) fn at(&self, t: f64, point: DVec3) -> DVec2 {
        match (self.support.flat(point), self.pcurve) {
            (Some(uv), _) => uv,
            (None, Some(path)) => path.point(t).xy(),
            (None, None) => DVec2::ZERO,
        }
    }
}

impl Tables {
    /// The side of an edge on which a face uses it.
    pub(super) fn side(&self, face: usize, of: &Use) -> Side<'_> {
        Side {
            support: &self.surfaces[self.faces[face].surface],
            pcurve: of.pcurve.map(|pcurve| &self.pcurves[pcurve]),
        }
    }

    /// The first reference to something that is not there, in words.
    pub fn dangling(&self) -> Option<String> {
        let wrong =
            |what: &str, at: usize| Some(format!("{what} {at} refers to what is not there"));
        for (at, edge) in self.edges.iter().enumerate() {
            let ends = [edge.start, edge.end];
            if edge.curve.is_some_and(|curve| curve >= self.curves.len())
                || ends.iter().any(|end| *end >= self.vertices.len())
            {
                return wrong("edge", at);
            }
        }
        for (at, face) in self.faces.iter().enumerate() {
            let Some(surface) = self.surfaces.get(face.surface) else {
                return wrong("face", at);
            };
            for of in face.loops.iter().flatten() {
                let Some(edge) = self.edges.get(of.edge) else {
                    return wrong("face", at);
                };
                let is_there = match (of.pcurve, surface) {
                    (Some(pcurve), _) => pcurve < self.pcurves.len(),
                    (None, Support::Plane { .. }) => true,
                    (None, Support::Spline(_)) => edge.curve.is_none(),
                };
                if !is_there {
                    return wrong("face", at);
                }
            }
        }
        None
    }
}
