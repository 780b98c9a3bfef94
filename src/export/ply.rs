//! PLY, binary, with coordinates of double precision: one part a file.

use glam::DVec3;

use super::part::{Part, Parts};

/// The file of a part.
pub fn bytes(parts: &Parts, part: &Part) -> Vec<u8> {
    let [r, g, b] = part.color;
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment {}\ncomment part {}; facies {}; color {r} {g} {b}\n\
         element vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        parts.words(),
        part.name,
        part.material,
        part.mesh.positions.len(),
        part.mesh.triangles.len(),
    );
    let mut out = header.into_bytes();
    out.reserve(24 * part.mesh.positions.len() + 13 * part.mesh.triangles.len());
    for number in part.mesh.positions.iter().flat_map(DVec3::to_array) {
        out.extend(number.to_le_bytes());
    }
    for triangle in part.triangles() {
        out.push(3);
        for point in triangle {
            out.extend(point.to_le_bytes());
        }
    }
    out
}
