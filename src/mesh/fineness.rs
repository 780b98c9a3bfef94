//! How far chords and triangles may be from surfaces, and how much a surface may turn between their ends.

use glam::{DVec2, DVec3};

use super::tables::Support;

/// How fine triangles are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Largest distance of triangles from their surfaces, and of chords from their edges (m).
    pub chord: f64,
    /// Largest angle between the surface's normals at the two ends of a triangle's side, and between an edge's directions at
    /// the two ends of its chord (rad). Sides shorter than a ten-thousandth of `chord` may turn by more.
    pub angle: f64,
}

/// Triangles are asked at four places inside and three of each side; elsewhere they may be a little farther away.
const SHARE: f64 = 0.75;
/// Sides shorter than this share of the chord are fine.
const LEAST: f64 = 1e-4;
/// Where a side is asked.
const PLACES: [f64; 3] = [0.5, 0.25, 0.75];
/// Where a triangle is asked: shares of its corners.
const INNER: [[f64; 3]; 4] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];
/// A chord may miss its surface's middle by this share of its length within the surface: more would fold it.
const SLIDE: f64 = 0.2;

/// The same as numbers to compare with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    pub(super) chord: f64,
    pub(super) cosine: f64,
    /// Shorter sides are fine.
    pub(super) least: f64,
}

impl Limits {
    pub(super) fn new(fineness: &Fineness) -> Self {
        Self {
            chord: SHARE * fineness.chord,
            cosine: fineness.angle.cos(),
            least: LEAST * fineness.chord,
        }
    }

    /// Whether two directions are close enough, for a chord of some length.
    pub(super) fn turns_little(&self, length: f64, a: Option<DVec3>, b: Option<DVec3>) -> bool {
        match (a, b) {
            (Some(a), Some(b)) => length <= self.least || a.dot(b) >= self.cosine,
            _ => true,
        }
    }

    /// Whether the straight line between two places of an edge, in the parameters of a surface, is near enough to their chord in
    /// space. Across it, too: else what lies inside of the line would lie beyond the edge.
    pub(super) fn edge_holds(&self, on: &Support, [a, b]: [(DVec2, DVec3); 2]) -> bool {
        if matches!(on, Support::Plane { .. }) {
            return true;
        }
        PLACES.into_iter().all(|share| {
            let point = on.point(a.0.lerp(b.0, share));
            point.distance(nearest_on_segment(point, a.1, b.1)) <= self.chord
        })
    }

    /// Whether the chord of two places of a surface is near enough to it.
    pub(super) fn chord_holds(&self, on: &Support, [a, b]: [(DVec2, DVec3); 2]) -> bool {
        let length = a.1.distance(b.1);
        if matches!(on, Support::Plane { .. }) {
            return true;
        }
        let is_near = |share: f64| {
            let uv = a.0.lerp(b.0, share);
            let point = on.point(uv);
            let offset = point - nearest_on_segment(point, a.1, b.1);
            if offset.length() <= self.chord {
                return true;
            }
            if length <= self.least {
                // Both ends are one place, and the surface is elsewhere between: around a seam, or at a pole.
                return false;
            }
            let normal = on.normal(uv);
            let across = normal.map_or(offset.length(), |normal| offset.dot(normal).abs());
            across <= self.chord && offset.length() <= SLIDE * length
        };
        PLACES.into_iter().all(is_near)
    }

    /// Whether a triangle is near enough to its surface in its middle.
    pub(super) fn middle_holds(&self, on: &Support, corners: [(DVec2, DVec3); 3]) -> bool {
        if matches!(on, Support::Plane { .. }) {
            return true;
        }
        let [a, b, c] = corners.map(|corner| corner.1);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let normal = (b - a).cross(c - a).try_normalize();
        INNER.into_iter().all(|[p, q, r]| {
            let uv = p * corners[0].0 + q * corners[1].0 + r * corners[2].0;
            let offset = on.point(uv) - (p * a + q * b + r * c);
            let is_across = |normal: DVec3| {
                offset.dot(normal).abs() <= self.chord && offset.length() <= SLIDE * longest
            };
            offset.length() <= self.chord || normal.is_some_and(is_across)
        })
    }
}

/// The point of a segment that is nearest to another one.
pub(super) fn nearest_on_segment(point: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let along = b - a;
    let square = along.length_squared();
    if square == 0.0 {
        return a;
    }
    a + ((point - a).dot(along) / square).clamp(0.0, 1.0) * along
}
