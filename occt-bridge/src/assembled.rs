//! Solids from finished tables: a whole assembly, whose solids share faces, edges and vertices, in one call.
//!
//! Nothing is intersected, sewn or measured, so that thousands of faces take milliseconds. [`crate::solid`] makes one solid and checks
//! its geometry as well.

mod check;
mod flat;
mod tables;

use crate::error::{BridgeError, from_kernel, input};
use crate::ffi::bridge;
use crate::solids::{Solid, SolidFace, Solids};
pub use tables::{OnSurface, TableEdge, TableFace, TableSolid, TableVertex, Tables};

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
