//! The triangles of a part before they are drawn: their normals, and what the cut leaves of them.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{
    camera::Eye,
    halfspace::{HalfSpace, Vertex, without},
    scene::Part,
};

/// Faces that meet at less than this are drawn as one smooth surface.
const CREASE_COS: f64 = 0.766; // 40°

/// The triangles of a part, in stretched coordinates, with normals, after the cut.
pub(super) fn triangles(part: &Part, eye: &Eye, removed: &[HalfSpace]) -> Vec<[Vertex; 3]> {
    let points: Vec<DVec3> = part.positions.iter().map(|&p| eye.stretched(p)).collect();
    let normals = match &part.normals {
        Some(normals) => {
            let stretched: Vec<DVec3> = normals.iter().map(|&n| eye.stretched_normal(n)).collect();
            let corners = part.triangles.iter();
            corners
                .map(|triangle| triangle.map(|i| stretched[i as usize]))
                .collect()
        }
        None => smooth_normals(&points, &part.triangles, eye.diagonal),
    };
    let mut drawn = Vec::with_capacity(part.triangles.len());
    for (triangle, normals) in part.triangles.iter().zip(normals) {
        let world = [0, 1, 2].map(|i| Vertex {
            at: part.positions[triangle[i] as usize],
            normal: normals[i],
        });
        let pieces = if is_skin(&world.map(|vertex| vertex.at), removed, eye.diagonal) {
            vec![world.to_vec()]
        } else {
            without(world.to_vec(), removed)
        };
        for piece in pieces {
            for i in 1..piece.len() - 1 {
                drawn.push([piece[0], piece[i], piece[i + 1]].map(|vertex| Vertex {
                    at: eye.stretched(vertex.at),
                    ..vertex
                }));
            }
        }
    }
    drawn
}

/// Whether a triangle lies in a side of what is removed and bounds a body on the side that stays.
fn is_skin([a, b, c]: &[DVec3; 3], removed: &[HalfSpace], diagonal: f64) -> bool {
    let normal = (b - a).cross(c - a);
    removed.iter().any(|side| {
        normal.dot(side.normal) < 0.0
            && [a, b, c]
                .iter()
                .all(|&&p| side.height(p).abs() < 1e-9 * diagonal)
    })
}

/// Normals of the corners of each triangle: the mean, by area, over the triangles around the corner that lie within
/// the crease angle.
fn smooth_normals(points: &[DVec3], triangles: &[[u32; 3]], diagonal: f64) -> Vec<[DVec3; 3]> {
    let areas: Vec<DVec3> = triangles
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.map(|i| points[i as usize]);
            (b - a).cross(c - a)
        })
        .collect();
    // Meshes of neighbouring faces have their common points twice: they are joined when equal up to a millionth.
    let grid = 1e-6 * diagonal;
    let key = |i: u32| {
        let q = (points[i as usize] / grid).round();
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the domain is a million cells wide"
        )]
        [q.x as i64, q.y as i64, q.z as i64]
    };
    let mut around: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    for (i, triangle) in triangles.iter().enumerate() {
        for &corner in triangle {
            around.entry(key(corner)).or_default().push(i);
        }
    }
    triangles
        .iter()
        .zip(&areas)
        .map(|(triangle, area)| {
            let own = area.normalize_or_zero();
            triangle.map(|corner| {
                let sum: DVec3 = around[&key(corner)]
                    .iter()
                    .map(|&i| areas[i])
                    .filter(|other| other.normalize_or_zero().dot(own) > CREASE_COS)
                    .sum();
                sum.try_normalize().unwrap_or(own)
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_smooth_over_a_bend_and_sharp_at_a_right_angle() {
        // Three strips along y: flat, tilted by 20°, then straight up.
        let (sin, cos) = 20_f64.to_radians().sin_cos();
        let profile = [
            (0.0, 0.0),
            (1.0, 0.0),
            (1.0 + cos, sin),
            (1.0 + cos, sin + 3.0),
        ];
        let points: Vec<DVec3> = profile
            .iter()
            .flat_map(|&(x, z)| [0.0, 1.0].map(|y| DVec3::new(x, y, z)))
            .collect();
        let triangles: Vec<[u32; 3]> = (0..3)
            .flat_map(|i| {
                let a = 2 * i;
                [[a, a + 2, a + 1], [a + 1, a + 2, a + 3]]
            })
            .collect();
        let normals = smooth_normals(&points, &triangles, 10.0);
        let tilted = normals[2];
        // At the bend between flat and tilted; which triangles meet there decides between 5° and 15°.
        let lean = tilted[0].z.acos().to_degrees();
        assert!((5.0..=15.0).contains(&lean), "{lean}");
        // At the upper rim the wall does not count.
        assert!((tilted[1].z - cos).abs() < 1e-9);
        assert!(normals[4][2].z.abs() < 1e-9);
    }
}
