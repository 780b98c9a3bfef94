//! Triangles, for pictures.

use crate::error::{BridgeError, from_kernel};
use crate::ffi::bridge;
use crate::shape::Shape;
use crate::solids::Solids;
use crate::threads::Threads;

/// How fine triangles are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshOptions {
    /// Largest distance from the surface, m.
    pub deflection: f64,
    /// Largest angle between neighbours, radians.
    pub angle: f64,
    /// Threads.
    pub threads: Threads,
}

/// Triangles of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceMesh {
    /// Points, m.
    pub vertices: Vec<[f64; 3]>,
    /// Unit normals of the exact surface at the points.
    pub normals: Vec<[f64; 3]>,
    /// Three points each, counter-clockwise seen against the normals.
    pub triangles: Vec<[u32; 3]>,
}

/// Triangles per face of a shape, in the order of its faces, looking the way the faces do: out of a solid.
///
/// # Errors
/// [`BridgeError::Input`] if the deflection or the angle is not above 0.
pub fn triangulate(shape: &Shape, options: &MeshOptions) -> Result<Vec<FaceMesh>, BridgeError> {
    bridge::mesh_shape(
        shape.handle(),
        options.deflection,
        options.angle,
        options.threads.parallel(),
    )
    .map(convert)
    .map_err(|e| from_kernel("triangulating", &e))
}

/// Triangles per face of [`Solids::faces`], for the face that is not reversed. Faces meet without gaps.
///
/// # Errors
/// As [`triangulate`].
pub fn triangulate_solids(
    solids: &Solids,
    options: &MeshOptions,
) -> Result<Vec<FaceMesh>, BridgeError> {
    bridge::mesh_solids(
        &solids.handle,
        options.deflection,
        options.angle,
        options.threads.parallel(),
    )
    .map(convert)
    .map_err(|e| from_kernel("triangulating", &e))
}

fn convert(meshes: Vec<bridge::MeshData>) -> Vec<FaceMesh> {
    meshes
        .into_iter()
        .map(|mesh| FaceMesh {
            vertices: mesh.vertices.as_chunks().0.to_vec(),
            normals: mesh.normals.as_chunks().0.to_vec(),
            triangles: mesh.triangles.as_chunks().0.to_vec(),
        })
        .collect()
}
