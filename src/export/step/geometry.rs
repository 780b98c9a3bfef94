//! Points, curves and surfaces, each written once: both copies of a face that two products have refer to the same ones.
//!
//! A face has a surface entity of its own, even where several lie on one surface: readers tell by it which curve on a
//! surface belongs to which face. The control points below it are common.
//!
//! On planes the curves on the surface are those in space, projected: the kernel keeps none there.

use std::ops::Range;

use super::part21::{Block, Exchange, Id};
use super::shapes::{Piece, Plane, write_surface};
use crate::assembly::kernel::{Boundary, Surface};

/// The entities of all geometry.
pub(super) struct Geometry {
    /// A point by vertex.
    pub(super) vertices: Vec<Id>,
    /// Curves in space.
    pub(super) curves: Vec<Id>,
    /// Faces.
    pub(super) faces: Vec<FaceGeometry>,
}

/// The entities of a face's geometry.
pub(super) struct FaceGeometry {
    pub(super) surface: Id,
    pub(super) is_plane: bool,
    /// By loop and use; `None` if the edge is a point.
    pub(super) pcurves: Vec<Vec<Option<Id>>>,
}

impl Geometry {
    pub(super) fn write(to: &mut Exchange, boundary: &Boundary) -> Self {
        let mut blocks: Vec<Piece<'_>> = Vec::new();
        let vertices = place(&mut blocks, boundary.vertices.iter().map(Piece::Point));
        let curves = place(&mut blocks, boundary.curves.iter().map(Piece::Curve));
        let pcurves = place(&mut blocks, boundary.pcurves.iter().map(Piece::Pcurve));
        let surfaces = place(&mut blocks, boundary.surfaces.iter().map(Piece::Below));
        let projected = place(&mut blocks, projections(boundary));
        let firsts = to.blocks(&blocks);
        // A curve comes after its points, a placement after its axes.
        let last = |at: usize| firsts[at].after(blocks[at].entities() - 1);

        let mut projected = projected.map(last);
        let by_pcurve: Vec<Id> = pcurves.map(last).collect();
        let faces = boundary
            .faces
            .iter()
            .map(|face| {
                let surface = &boundary.surfaces[face.surface];
                let below = surfaces.start + face.surface;
                let is_plane = matches!(surface, Surface::Plane { .. });
                let surface = match surface {
                    Surface::Plane { .. } => to.add(format_args!("PLANE('',{})", last(below))),
                    Surface::BSpline { .. } => {
                        to.write(|text| write_surface(surface, firsts[below], text))
                    }
                };
                let mut curve_of = |pcurve: Option<usize>, edge: usize| {
                    // Of a plane's edges, those with a curve have a projection.
                    match pcurve {
                        Some(pcurve) => Some(by_pcurve[pcurve]),
                        None if is_plane && boundary.edges[edge].curve.is_some() => {
                            projected.next()
                        }
                        None => None,
                    }
                };
                let curves: Vec<Vec<Option<Id>>> = face
                    .loops
                    .iter()
                    .map(|uses| {
                        let uses = uses.iter();
                        uses.map(|of| curve_of(of.pcurve, of.edge)).collect()
                    })
                    .collect();
                FaceGeometry {
                    surface,
                    is_plane,
                    pcurves: write_pcurves(to, surface, &curves),
                }
            })
            .collect();
        Self {
            vertices: vertices.map(|at| firsts[at]).collect(),
            curves: curves.map(last).collect(),
            faces,
        }
    }
}

/// Adds blocks; returns where they are.
fn place<'a>(
    blocks: &mut Vec<Piece<'a>>,
    more: impl IntoIterator<Item = Piece<'a>>,
) -> Range<usize> {
    let start = blocks.len();
    blocks.extend(more);
    start..blocks.len()
}

/// Of each face on a plane, loop by loop, its edges.
fn projections(boundary: &Boundary) -> impl Iterator<Item = Piece<'_>> {
    let flat = boundary.faces.iter().filter_map(|face| {
        let plane = Plane::of(&boundary.surfaces[face.surface])?;
        Some((plane, face.loops.iter().flatten()))
    });
    flat.flat_map(move |(plane, uses)| {
        let curves = uses.filter_map(move |of| boundary.edges[of.edge].curve);
        curves.map(move |curve| Piece::Projected(plane, &boundary.curves[curve]))
    })
}

/// The curves on a face's surface as its edges refer to them. They share the space of its parameters.
fn write_pcurves(
    to: &mut Exchange,
    surface: Id,
    curves: &[Vec<Option<Id>>],
) -> Vec<Vec<Option<Id>>> {
    let space = to.add(format_args!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(2)PARAMETRIC_REPRESENTATION_CONTEXT()REPRESENTATION_CONTEXT('2D SPACE',''))"
    ));
    let mut pcurve = |curve: &Option<Id>| {
        curve.map(|curve| {
            let alone = to.add(format_args!(
                "DEFINITIONAL_REPRESENTATION('',({curve}),{space})"
            ));
            to.add(format_args!("PCURVE('',{surface},{alone})"))
        })
    };
    let each = curves.iter();
    each.map(|of_loop| of_loop.iter().map(&mut pcurve).collect())
        .collect()
}
