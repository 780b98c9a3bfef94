//! Triangles of solids, for pictures.

use glam::DVec3;

use super::ExportError;
use crate::assembly::{Assembly, kernel};

/// Triangles of one volume's solids, looking outwards.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VolumeMesh {
    /// The volume.
    pub volume: usize,
    /// Points (m).
    pub positions: Vec<DVec3>,
    /// Unit normals of the exact surfaces at the points.
    pub normals: Vec<DVec3>,
    /// Three points each, counterclockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Fineness of a picture's triangles: largest angle between neighbours (rad).
const ANGLE: f64 = 0.3;

/// Triangulates all solids, to within a distance of the exact surfaces (m), one mesh a volume.
pub fn triangulate(assembly: &Assembly, deflection: f64) -> Result<Vec<VolumeMesh>, ExportError> {
    let options = kernel::MeshOptions {
        deflection,
        angle: ANGLE,
        threads: kernel::Threads::All,
    };
    let faces = kernel::triangulate_solids(&assembly.solids, &options).map_err(|error| {
        ExportError::Kernel {
            what: "triangles",
            message: error.to_string(),
        }
    })?;
    let mut meshes: Vec<VolumeMesh> = Vec::new();
    for piece in &assembly.measured.pieces {
        if meshes.last().is_none_or(|mesh| mesh.volume != piece.volume) {
            meshes.push(VolumeMesh {
                volume: piece.volume,
                ..VolumeMesh::default()
            });
        }
        let Some(mesh) = meshes.last_mut() else {
            continue;
        };
        for &(face, reversed) in &assembly.solids.solids()[piece.solid].faces {
            append(mesh, &faces[face], reversed);
        }
    }
    Ok(meshes)
}

fn append(mesh: &mut VolumeMesh, face: &kernel::FaceMesh, reversed: bool) {
    // A picture's mesh stays far below 2³² points: the kernel indexes faces with u32 itself.
    let Ok(first) = u32::try_from(mesh.positions.len()) else {
        return;
    };
    mesh.positions
        .extend(face.vertices.iter().map(|p| DVec3::from_array(*p)));
    let sign = if reversed { -1.0 } else { 1.0 };
    mesh.normals
        .extend(face.normals.iter().map(|n| DVec3::from_array(*n) * sign));
    mesh.triangles
        .extend(face.triangles.iter().map(|&[a, b, c]| {
            let [b, c] = if reversed { [c, b] } else { [b, c] };
            [a + first, b + first, c + first]
        }));
}
