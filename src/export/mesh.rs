//! Triangles of solids, for pictures and for files of triangles.

use glam::DVec3;

use super::ExportError;
use crate::assembly::Assembly;
use crate::assembly::boundary::tables;
use crate::assembly::kernel::{self, BoundaryShape};
use crate::mesh::{self, Fineness, Mesh, Tables, Used};

/// Triangles of one volume's solids, or of a sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VolumeMesh {
    /// The volume.
    pub volume: usize,
    /// Points (m).
    pub positions: Vec<DVec3>,
    /// Corners of triangles: a point has one for each face that meets there.
    pub corners: Vec<Corner>,
    /// Three corners each: of solids counter-clockwise seen from outside, of sheets seen against their normal.
    pub triangles: Vec<[u32; 3]>,
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Its point.
    pub point: u32,
    /// The unit normal of the exact surface there.
    pub normal: DVec3,
}

/// All faces of an assembly as triangles, each once.
pub struct Triangulation {
    tables: Tables,
    mesh: Mesh,
    /// By face of the solids: the triangles' face, and whether it is turned.
    faces: Vec<Used>,
}

pub(super) fn failed(message: impl std::fmt::Display) -> ExportError {
    ExportError::Kernel {
        what: "triangles",
        message: message.to_string(),
    }
}

impl Triangulation {
    /// Triangulates all faces.
    pub fn new(assembly: &Assembly, fineness: &Fineness) -> Result<Self, ExportError> {
        let count = assembly.solids.faces().len();
        let shapes = (0..count).map(|face| assembly.solids.face_shape(face));
        let boundary = shapes
            .collect::<Result<Vec<_>, _>>()
            .and_then(|shapes| kernel::boundary(&shapes))
            .map_err(failed)?;
        let faces = boundary
            .shapes
            .iter()
            .map(only_face)
            .collect::<Result<_, _>>()?;
        let tables = tables(&boundary).map_err(failed)?;
        let mesh = mesh::triangulate(&tables, fineness)?;
        Ok(Self {
            tables,
            mesh,
            faces,
        })
    }

    /// What was triangulated.
    pub fn tables(&self) -> &Tables {
        &self.tables
    }

    /// The triangles.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The faces of one of the assembly's pieces, by its place in the list of all.
    pub fn faces_of(&self, assembly: &Assembly, piece: usize) -> Vec<Used> {
        let solid = assembly.measured.pieces[piece].solid;
        let faces = assembly.solids.solids()[solid].faces.iter();
        faces
            .map(|(face, reversed)| {
                let (at, turned) = self.faces[*face];
                (at, turned != *reversed)
            })
            .collect()
    }

    /// The solids, one mesh a volume.
    ///
    /// # Errors
    /// If the triangles of a solid do not close: that is a defect of this program.
    pub fn volumes(&self, assembly: &Assembly) -> Result<Vec<VolumeMesh>, ExportError> {
        let mut faces: Vec<(usize, Vec<Used>)> = Vec::new();
        for (at, piece) in assembly.measured.pieces.iter().enumerate() {
            let own = self.faces_of(assembly, at);
            self.mesh.closed(&own).map_err(failed)?;
            match faces.last_mut() {
                Some((volume, faces)) if *volume == piece.volume => faces.extend(own),
                _ => faces.push((piece.volume, own)),
            }
        }
        let meshes = faces
            .iter()
            .map(|(volume, faces)| collect(&self.mesh, *volume, faces));
        meshes.collect()
    }

    /// What was triangulated, and its triangles.
    pub(super) fn into_parts(self) -> (Tables, Mesh) {
        (self.tables, self.mesh)
    }

    /// A face of the assembly.
    pub(super) fn face(&self, face: usize) -> Used {
        self.faces[face]
    }
}

/// The face of a shape that consists of one.
fn only_face(shape: &BoundaryShape) -> Result<Used, ExportError> {
    match shape {
        BoundaryShape::Faces(faces) if faces.len() == 1 => Ok(faces[0]),
        _ => Err(failed("a face of the solids is not one face")),
    }
}

/// The triangles of some faces, with the points that they use.
pub(super) fn collect(
    mesh: &Mesh,
    volume: usize,
    faces: &[Used],
) -> Result<VolumeMesh, ExportError> {
    let mut own = VolumeMesh {
        volume,
        ..VolumeMesh::default()
    };
    let number = |count: usize| {
        u32::try_from(count)
            .map_err(|_| failed("more than 4 000 000 000 points; take a larger chord tolerance"))
    };
    let mut points: Vec<Option<u32>> = vec![None; mesh.points.len()];
    for (face, reversed) in faces {
        let face = &mesh.faces[*face];
        let first = number(own.corners.len() + face.corners.len())? - number(face.corners.len())?;
        for corner in &face.corners {
            let point = if let Some(point) = points[corner.point] {
                point
            } else {
                let next = number(own.positions.len())?;
                own.positions.push(mesh.points[corner.point]);
                *points[corner.point].insert(next)
            };
            let normal = if *reversed {
                -corner.normal
            } else {
                corner.normal
            };
            own.corners.push(Corner { point, normal });
        }
        for triangle in &face.triangles {
            let [a, b, c] = *triangle;
            let [b, c] = if *reversed { [c, b] } else { [b, c] };
            own.triangles
                .push([first + number(a)?, first + number(b)?, first + number(c)?]);
        }
    }
    Ok(own)
}
