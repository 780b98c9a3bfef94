//! What files of triangles hold: named, coloured triangles, and where their coordinates are counted from.

use glam::DVec3;

use super::mesh::VolumeMesh;

/// A volume, or a sheet, as triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its name: printable ASCII.
    pub name: String,
    /// What it is called where people read.
    pub label: String,
    /// What it consists of: its facies.
    pub material: String,
    /// Red, green, blue (sRGB).
    pub color: [u8; 3],
    /// Its triangles.
    pub mesh: VolumeMesh,
}

/// Parts, and what is to be said of all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Parts {
    /// The model's name: printable ASCII.
    pub name: String,
    /// The parts.
    pub all: Vec<Part>,
    /// Largest distance of triangles from the exact surfaces (m).
    pub chord: f64,
    /// Largest angle between normals along a side of a triangle (rad).
    pub angle: f64,
    /// What is to be added to the model's coordinates to get those in the world (m).
    pub origin: DVec3,
}

/// Coordinates beyond this (m) are written from another point, where a format has single precision alone: there it keeps a
/// hundredth of a metre.
const NEAR: f64 = 65_536.0;
/// Such points are multiples of this (m).
const STEP: f64 = 1024.0;

impl Parts {
    /// What the files say of themselves, in a line.
    pub(super) fn words(&self) -> String {
        format!(
            "{} {}: {}; metres, z up; triangles within {} m of the surfaces, normals within {:.1} degrees along a side",
            env!("CARGO_PKG_NAME"),
            env!("CARGO_PKG_VERSION"),
            self.name,
            self.chord,
            self.angle.to_degrees(),
        )
    }

    /// Where coordinates of single precision are counted from: the model's own zero, unless all is far from it.
    pub(super) fn base(&self) -> DVec3 {
        let points = || self.all.iter().flat_map(|part| &part.mesh.positions);
        let low = points().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let largest = low.abs().max(high.abs());
        let base = |axis: usize| {
            if largest[axis] > NEAR && largest[axis].is_finite() {
                (low[axis] / STEP).floor() * STEP
            } else {
                0.0
            }
        };
        DVec3::new(base(0), base(1), base(2))
    }
}

impl Part {
    /// A triangle's points.
    pub(super) fn points(&self, triangle: [u32; 3]) -> [u32; 3] {
        triangle.map(|corner| self.mesh.corners[corner as usize].point)
    }

    /// All triangles by points.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.mesh
            .triangles
            .iter()
            .map(|triangle| self.points(*triangle))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::mesh::Corner;
    use super::*;

    /// A tetrahedron with the corners of a cube's origin: 1/6 of its side to the third.
    pub(in crate::export) fn tetrahedron(at: DVec3) -> Parts {
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let positions = vec![
            at,
            at + 6.0 * DVec3::X,
            at + 6.0 * DVec3::Y,
            at + 6.0 * DVec3::Z,
        ];
        let normals = [-DVec3::Z, -DVec3::Y, -DVec3::X, DVec3::ONE.normalize()];
        let corners = faces.iter().zip(normals);
        let corners = corners.flat_map(|(face, normal)| face.map(|point| Corner { point, normal }));
        let part = Part {
            name: "body".to_owned(),
            label: "Körper".to_owned(),
            material: "sand".to_owned(),
            color: [230, 194, 92],
            mesh: VolumeMesh {
                volume: 1,
                positions,
                corners: corners.collect(),
                triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11]],
            },
        };
        Parts {
            name: "Test".to_owned(),
            all: vec![part],
            chord: 0.5,
            angle: 0.3,
            origin: DVec3::ZERO,
        }
    }

    #[test]
    fn coordinates_near_the_origin_are_as_they_are_and_far_ones_are_counted_from_a_round_place() {
        assert_eq!(
            tetrahedron(DVec3::new(-9.0, 50_000.0, 3.0)).base(),
            DVec3::ZERO
        );
        let base = tetrahedron(DVec3::new(456_789.0, 6_782_123.0, -2000.0)).base();
        assert_eq!(base, DVec3::new(456_704.0, 6_781_952.0, 0.0));
    }
}
