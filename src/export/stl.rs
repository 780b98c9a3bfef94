//! STL, binary: one part a file, for it has neither names nor colours.
//!
//! Coordinates have single precision. Of a model far from its origin they are counted from a round point that the header
//! tells: at UTM northings neighbouring numbers of single precision are half a metre apart. Readers join points
//! that are equal, so what is closed by its indices is closed as they see it, unless points are closer than that precision.

use glam::{DVec3, Vec3};

use super::part::{Part, Parts};

/// A facet: its normal, three points and two unused bytes.
const FACET: usize = 50;
const HEADER: usize = 80;

/// The file of a part, counted from a point.
pub fn bytes(parts: &Parts, part: &Part) -> Vec<u8> {
    let base = parts.base();
    let mut header = format!("{} {}; metres", env!("CARGO_PKG_NAME"), part.name);
    if base != DVec3::ZERO {
        header = format!("metres from {} {} {}; {header}", base.x, base.y, base.z);
    }
    let mut out = Vec::with_capacity(HEADER + 4 + FACET * part.mesh.triangles.len());
    out.extend(header.bytes().chain(std::iter::repeat(b' ')).take(HEADER));
    let count = u32::try_from(part.mesh.triangles.len()).unwrap_or(u32::MAX);
    out.extend(count.to_le_bytes());
    for triangle in part.triangles() {
        let corners = triangle.map(|point| part.mesh.positions[point as usize] - base);
        let normal = (corners[1] - corners[0])
            .cross(corners[2] - corners[0])
            .normalize_or_zero();
        let all = [normal, corners[0], corners[1], corners[2]];
        for number in all.iter().flat_map(|point| single(*point).to_array()) {
            out.extend(number.to_le_bytes());
        }
        out.extend([0, 0]);
    }
    out
}

/// The nearest numbers of single precision.
pub(super) fn single(point: DVec3) -> Vec3 {
    // Without a negative zero.
    point.as_vec3() + Vec3::ZERO
}

#[cfg(test)]
mod tests {
    use super::super::part::tests::tetrahedron;
    use super::*;

    #[test]
    fn a_tetrahedron_is_four_facets_with_its_volume_wherever_it_lies() {
        for at in [DVec3::ZERO, DVec3::new(456_789.25, 6_782_123.5, -2000.0)] {
            let parts = tetrahedron(at);
            let file = bytes(&parts, &parts.all[0]);
            assert_eq!(file.len(), HEADER + 4 + 4 * FACET);
            assert!(!file.starts_with(b"solid"));
            let number = |at: usize| {
                f32::from_le_bytes([file[at], file[at + 1], file[at + 2], file[at + 3]])
            };
            let point = |facet: usize, corner: usize| {
                let from = HEADER + 4 + FACET * facet + 12 * (corner + 1);
                DVec3::new(
                    number(from).into(),
                    number(from + 4).into(),
                    number(from + 8).into(),
                )
            };
            let volume: f64 = (0..4)
                .map(|facet| point(facet, 0).dot(point(facet, 1).cross(point(facet, 2))) / 6.0)
                .sum();
            assert!((volume - 36.0).abs() < 0.1, "{volume}");
            assert_eq!(
                file.starts_with(b"metres from 456704 6781952 0;"),
                at.x != 0.0
            );
        }
    }
}
