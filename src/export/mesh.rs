//! Triangles of solids, for pictures.

use std::collections::BTreeMap;

use glam::DVec3;

use super::ExportError;
use crate::assembly::{Assembly, kernel};
use crate::model::plan::AssemblyPlan;

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
    let faces = faces(assembly, deflection)?;
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

/// Triangulates the sheets inside the domain, each as far as it parts two volumes, one mesh a body, named by its first
/// volume.
pub fn triangulate_sheets(
    assembly: &Assembly,
    plan: &AssemblyPlan,
    deflection: f64,
) -> Result<Vec<VolumeMesh>, ExportError> {
    let faces = faces(assembly, deflection)?;
    let mut meshes: BTreeMap<usize, VolumeMesh> = BTreeMap::new();
    for (at, face) in faces.iter().enumerate() {
        let shell = assembly.shell_of_face(at);
        let Some(body) = plan.bodies.iter().find(|body| Some(body.shell) == shell) else {
            continue;
        };
        let volume = body.volume;
        let mesh = meshes.entry(volume).or_insert_with(|| VolumeMesh {
            volume,
            ..VolumeMesh::default()
        });
        append(mesh, face, false);
    }
    Ok(meshes.into_values().collect())
}

fn faces(assembly: &Assembly, deflection: f64) -> Result<Vec<kernel::FaceMesh>, ExportError> {
    let options = kernel::MeshOptions {
        deflection,
        angle: ANGLE,
        threads: kernel::Threads::All,
    };
    kernel::triangulate_solids(&assembly.solids, &options).map_err(|error| ExportError::Kernel {
        what: "triangles",
        message: error.to_string(),
    })
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
