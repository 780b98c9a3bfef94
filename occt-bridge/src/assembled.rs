//! Solids from finished tables: a whole assembly, whose solids share faces, edges and vertices, in one call.
//!
//! Nothing is intersected, sewn or measured, so that thousands of faces take milliseconds. [`crate::solid`] makes one solid and checks
//! its geometry as well.

mod check;
mod flat;

use crate::error::{BridgeError, from_kernel, input};
use crate::ffi::bridge;
use crate::partition::FaceOrigin;
use crate::solids::{Solid, SolidFace, Solids};
use crate::topology::{Curve, Pcurve, Surface};

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
    /// What becomes [`SolidFace::origins`].
    pub origins: Vec<FaceOrigin>,
}

/// One of the solids.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableSolid {
    /// What becomes [`Solid::owner`].
    pub owner: usize,
    /// Faces, and whether the solid uses them against their surface's normal: they look out of it. The outer shell first; then voids.
    pub shells: Vec<Vec<(usize, bool)>>,
}

impl Solids {
    /// Solids as the tables say, in their order: [`Self::solids`] and [`Self::faces`] have the tables' indices.
    ///
    /// Only what needs no geometry is checked. Whether curves run where their surfaces are, loops turn the right way, faces look
    /// outwards and shells lie within each other is the caller's business: [`crate::defects`] finds most of it, [`crate::face_integrals`]
    /// the sign of a volume.
    ///
    /// # Errors
    /// [`BridgeError::Input`] names the table entry: an index out of range, a value that is not finite, a tolerance that is not above
    /// 0, knots that are not clamped, a range outside its curve, a loop that does not close, an edge without a pcurve on a face's
    /// surface, a face that no solid or more than two use, or two on the same side, and a shell that does not close or touches itself
    /// along an edge (what only touches is two shells, of two solids).
    pub fn from_tables(tables: &Tables) -> Result<Self, BridgeError> {
        let operation = "assembling solids";
        check::check(tables).map_err(|message| input(operation, message))?;
        let data = flat::flat(tables).map_err(|message| input(operation, message))?;
        let handle = bridge::build_assembled(&data).map_err(|e| from_kernel(operation, &e))?;
        let mut faces: Vec<_> = tables
            .faces
            .iter()
            .map(|f| SolidFace {
                origins: f.origins.clone(),
                solids: Vec::new(),
            })
            .collect();
        let mut solids = Vec::with_capacity(tables.solids.len());
        for (s, solid) in tables.solids.iter().enumerate() {
            let uses = solid.shells.concat();
            for (f, _) in &uses {
                if faces[*f].solids.last() != Some(&s) {
                    faces[*f].solids.push(s);
                }
            }
            solids.push(Solid {
                owner: solid.owner,
                faces: uses,
                shells: solid.shells.len(),
            });
        }
        Ok(Self::new(handle, solids, faces))
    }
}
