//! Triangles before they are drawn: normals and the cut-away.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{
    camera::Eye,
    view::{Box3, Cut, Part},
};

/// Faces that meet at less than this are drawn as one smooth surface.
const CREASE_COS: f64 = 0.766; // 40°

/// A half-space: the points with `normal · p ≤ offset`.
#[derive(Debug, Clone, Copy)]
pub(super) struct HalfSpace {
    pub(super) normal: DVec3,
    pub(super) offset: f64,
}

impl HalfSpace {
    /// Above zero outside.
    pub(super) fn height(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.offset
    }

    fn flipped(&self) -> Self {
        Self {
            normal: -self.normal,
            offset: -self.offset,
        }
    }
}

/// What a cut removes, as the common part of half-spaces. Sides of the removed box on or beyond the domain's are left out.
pub(super) fn removed(cut: &Cut, domain: &Box3) -> Vec<HalfSpace> {
    match *cut {
        Cut::Plane { point, removes } => {
            let normal = -removes.normalize_or_zero();
            vec![HalfSpace {
                normal,
                offset: normal.dot(point),
            }]
        }
        Cut::Corner { low, high } => {
            let mut sides = Vec::new();
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                if high.dot(axis) < domain.high.dot(axis) {
                    sides.push(HalfSpace {
                        normal: axis,
                        offset: high.dot(axis),
                    });
                }
                if low.dot(axis) > domain.low.dot(axis) {
                    sides.push(HalfSpace {
                        normal: -axis,
                        offset: -low.dot(axis),
                    });
                }
            }
            sides
        }
    }
}

/// A point of a surface with its normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub(super) at: DVec3,
    pub(super) normal: DVec3,
}

impl Vertex {
    fn between(self, other: Self, fraction: f64) -> Self {
        Self {
            at: self.at.lerp(other.at, fraction),
            normal: self.normal.lerp(other.normal, fraction),
        }
    }
}

/// The part of a convex polygon inside a half-space (Sutherland & Hodgman 1974).
pub(super) fn clipped(polygon: &[Vertex], to: &HalfSpace) -> Vec<Vertex> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let (ha, hb) = (to.height(a.at), to.height(b.at));
        if ha <= 0.0 {
            kept.push(a);
        }
        if (ha < 0.0 && hb > 0.0) || (ha > 0.0 && hb < 0.0) {
            kept.push(a.between(b, ha / (ha - hb)));
        }
    }
    if kept.len() < 3 { Vec::new() } else { kept }
}

/// A convex polygon without what the half-spaces have in common: convex pieces that don't overlap.
pub(super) fn without(polygon: Vec<Vertex>, removed: &[HalfSpace]) -> Vec<Vec<Vertex>> {
    if removed.is_empty() {
        return vec![polygon];
    }
    let mut pieces = Vec::new();
    let mut rest = polygon;
    for side in removed {
        // What lies in the side's plane goes with the rest: it is on the removed body's skin.
        if rest.iter().any(|vertex| side.height(vertex.at) > 0.0) {
            let outside = clipped(&rest, &side.flipped());
            if !outside.is_empty() {
                pieces.push(outside);
            }
            rest = clipped(&rest, side);
        }
        if rest.is_empty() {
            return pieces;
        }
    }
    pieces
}

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
    use proptest::prelude::*;

    const DOMAIN: Box3 = Box3 {
        low: DVec3::ZERO,
        high: DVec3::ONE,
    };

    fn area(polygon: &[Vertex]) -> f64 {
        (1..polygon.len().saturating_sub(1))
            .map(|i| {
                let [a, b, c] = [polygon[0].at, polygon[i].at, polygon[i + 1].at];
                (b - a).cross(c - a).length() / 2.0
            })
            .sum()
    }

    fn vertex(at: [f64; 3]) -> Vertex {
        Vertex {
            at: DVec3::from(at),
            normal: DVec3::Z,
        }
    }

    fn inside(p: DVec3, removed: &[HalfSpace]) -> bool {
        removed.iter().all(|side| side.height(p) < -1e-9)
    }

    #[test]
    fn a_square_without_a_quarter_has_three_quarters_of_its_area() {
        let square = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]].map(|[x, y]| vertex([x, y, 1.0]));
        let cut = Cut::Corner {
            low: DVec3::new(0.5, 0.5, -1.0),
            high: DVec3::splat(2.0),
        };
        let pieces = without(square.to_vec(), &removed(&cut, &DOMAIN));
        let sum: f64 = pieces.iter().map(|piece| area(piece)).sum();
        assert!((sum - 0.75).abs() < 1e-12);
    }

    #[test]
    fn a_plane_removes_the_side_it_points_to() {
        let cut = Cut::Plane {
            point: DVec3::splat(0.5),
            removes: DVec3::new(3.0, 0.0, 0.0),
        };
        let removed = removed(&cut, &DOMAIN);
        let square = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]].map(|[x, y]| vertex([x, y, 1.0]));
        let pieces = without(square.to_vec(), &removed);
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].iter().all(|vertex| vertex.at.x <= 0.5));
        assert!((area(&pieces[0]) - 0.5).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn pieces_are_what_lies_outside_the_removed_box(
            corners in prop::array::uniform3(prop::array::uniform3(0.0..1.0_f64)),
            low in prop::array::uniform3(0.05..0.5_f64),
            weights in prop::collection::vec(prop::array::uniform3(0.01..1.0_f64), 40),
        ) {
            let triangle = corners.map(vertex);
            let cut = Cut::Corner { low: DVec3::from(low), high: DVec3::new(0.8, 2.0, 0.9) };
            let removed = removed(&cut, &DOMAIN);
            let pieces = without(triangle.to_vec(), &removed);
            for piece in &pieces {
                for vertex in piece {
                    prop_assert!(!inside(vertex.at, &removed));
                }
            }
            // The area kept is the share of random points that are outside, checked through the areas' sum.
            let total = area(&triangle);
            let kept: f64 = pieces.iter().map(|piece| area(piece)).sum();
            prop_assert!(kept <= total * (1.0 + 1e-9));
            let any_inside = weights.iter().any(|w| {
                let sum = w[0] + w[1] + w[2];
                let p = (triangle[0].at * w[0] + triangle[1].at * w[1] + triangle[2].at * w[2]) / sum;
                inside(p, &removed)
            });
            if any_inside {
                prop_assert!(kept < total);
            } else if pieces.is_empty() {
                prop_assert!(total < 1e-9);
            }
        }
    }

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
