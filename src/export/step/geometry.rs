//! Points, curves and surfaces: what is referred to, once. Both copies of a face that two products have refer to the same.
//!
//! A face has a surface entity of its own, even where several lie on one surface: readers tell by it which curve on a
//! surface belongs to which face, and in the shared flavour which face is which. The control points below it are common.
//!
//! On planes the curves on the surface are those in space, projected: the kernel keeps none there.

use std::collections::HashMap;

use super::draft::Draft;
use super::part21::Id;
use super::shapes::{Piece, Plane, write_surface};
use crate::assembly::kernel::{Boundary, Surface};

/// A use of an edge by a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Side {
    pub(super) face: usize,
    /// Which of its loops, and which use in that.
    pub(super) at: (usize, usize),
}

/// The geometry that has been written, by index.
pub(super) struct Geometry<'a> {
    pub(super) boundary: &'a Boundary,
    points: HashMap<usize, Id>,
    curves: HashMap<usize, Id>,
    pcurves: HashMap<usize, Id>,
    /// First entities of what surfaces are written with.
    below: HashMap<usize, Id>,
    /// By face.
    surfaces: HashMap<usize, Id>,
    /// The space of a face's parameters.
    spaces: HashMap<usize, Id>,
    sides: HashMap<Side, Id>,
}

impl<'a> Geometry<'a> {
    pub(super) fn new(boundary: &'a Boundary) -> Self {
        Self {
            boundary,
            points: HashMap::new(),
            curves: HashMap::new(),
            pcurves: HashMap::new(),
            below: HashMap::new(),
            surfaces: HashMap::new(),
            spaces: HashMap::new(),
            sides: HashMap::new(),
        }
    }

    /// Whether a face lies on a plane.
    pub(super) fn is_plane(&self, face: usize) -> bool {
        let surface = self.boundary.faces[face].surface;
        matches!(self.boundary.surfaces[surface], Surface::Plane { .. })
    }

    /// The point of a vertex.
    pub(super) fn point(&mut self, to: &mut Draft<'a>, vertex: usize) -> Id {
        let boundary = self.boundary;
        let write = || to.defer(Piece::Point(&boundary.vertices[vertex]));
        *self.points.entry(vertex).or_insert_with(write)
    }

    /// A curve in space.
    pub(super) fn curve(&mut self, to: &mut Draft<'a>, curve: usize) -> Id {
        let boundary = self.boundary;
        let write = || last(to, Piece::Curve(&boundary.curves[curve]));
        *self.curves.entry(curve).or_insert_with(write)
    }

    /// The surface of a face.
    pub(super) fn surface(&mut self, to: &mut Draft<'a>, face: usize) -> Id {
        if let Some(written) = self.surfaces.get(&face) {
            return *written;
        }
        let index = self.boundary.faces[face].surface;
        let surface = &self.boundary.surfaces[index];
        let piece = Piece::Below(surface);
        let entities = piece.entities();
        let first = *self.below.entry(index).or_insert_with(|| to.defer(piece));
        let entity = match surface {
            Surface::Plane { .. } => {
                to.add(format_args!("PLANE('',{})", first.after(entities - 1)))
            }
            Surface::BSpline { .. } => to.write(|text| write_surface(surface, first, text)),
        };
        self.surfaces.insert(face, entity);
        entity
    }

    /// Where an edge with this curve in space runs on the surface of a face.
    pub(super) fn pcurve(&mut self, to: &mut Draft<'a>, side: Side, curve: usize) -> Option<Id> {
        if let Some(written) = self.sides.get(&side) {
            return Some(*written);
        }
        let boundary = self.boundary;
        let face = &boundary.faces[side.face];
        let on = if let Some(plane) = Plane::of(&boundary.surfaces[face.surface]) {
            last(to, Piece::Projected(plane, &boundary.curves[curve]))
        } else {
            let pcurve = face.loops[side.at.0][side.at.1].pcurve?;
            let write = || last(to, Piece::Pcurve(&boundary.pcurves[pcurve]));
            *self.pcurves.entry(pcurve).or_insert_with(write)
        };
        let surface = self.surface(to, side.face);
        let space = *self.spaces.entry(side.face).or_insert_with(|| {
            to.add(format_args!(
                "(GEOMETRIC_REPRESENTATION_CONTEXT(2)PARAMETRIC_REPRESENTATION_CONTEXT()REPRESENTATION_CONTEXT('2D SPACE',''))"
            ))
        });
        let alone = to.add(format_args!(
            "DEFINITIONAL_REPRESENTATION('',({on}),{space})"
        ));
        let pcurve = to.add(format_args!("PCURVE('',{surface},{alone})"));
        self.sides.insert(side, pcurve);
        Some(pcurve)
    }
}

/// Adds geometry; returns the last of its entities, to which others refer.
fn last<'a>(to: &mut Draft<'a>, piece: Piece<'a>) -> Id {
    let entities = piece.entities();
    to.defer(piece).after(entities - 1)
}
