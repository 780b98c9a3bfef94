//! Wells in views: tubes along their paths, as far as they are in the domain.

use glam::DVec3;

use crate::export::picture::view::{Box3, Part};
use crate::model::Model;

/// Places of a path.
const PLACES: usize = 1500;
/// Sides of a tube.
const SIDES: u32 = 12;
/// Its radius, as a fraction of the domain's diagonal as it is drawn.
const RADIUS: f64 = 0.0025;

/// The tubes of all wells, as parts of a volume of this number; they are round where elevations are stretched so many times.
pub(super) fn tubes(model: &Model, domain: Box3, stretch: f64, volume: usize) -> Vec<Part> {
    let size = domain.high - domain.low;
    let radius = RADIUS * size.with_z(size.z * stretch).length();
    let mut parts = Vec::new();
    for spec in &model.wells {
        let (first, last) = spec.well.range();
        let mut line: Vec<DVec3> = Vec::new();
        for k in 0..=PLACES {
            let place = spec
                .well
                .point(first + (last - first) * k as f64 / PLACES as f64);
            if place.cmpge(domain.low).all() && place.cmple(domain.high).all() {
                line.push(place);
                continue;
            }
            parts.extend(tube(&std::mem::take(&mut line), radius, stretch, volume));
        }
        parts.extend(tube(&line, radius, stretch, volume));
    }
    parts
}

/// A tube along a line, with its ends closed.
fn tube(line: &[DVec3], radius: f64, stretch: f64, volume: usize) -> Option<Part> {
    if line.len() < 2 {
        return None;
    }
    // As it is drawn.
    let drawn: Vec<DVec3> = line.iter().map(|p| p.with_z(p.z * stretch)).collect();
    let mut side = DVec3::X;
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for (k, place) in drawn.iter().enumerate() {
        let (before, after) = (
            drawn[k.saturating_sub(1)],
            drawn[(k + 1).min(drawn.len() - 1)],
        );
        let along = (after - before).normalize_or(DVec3::NEG_Z);
        // The last side, turned as little as the line turns.
        side = (side - side.dot(along) * along)
            .try_normalize()
            .unwrap_or_else(|| along.any_orthonormal_vector());
        let other = along.cross(side);
        for n in 0..SIDES {
            let (sine, cosine) =
                (std::f64::consts::TAU * f64::from(n) / f64::from(SIDES)).sin_cos();
            let normal = cosine * side + sine * other;
            let point = *place + radius * normal;
            positions.push(point.with_z(point.z / stretch));
            normals.push(normal.with_z(normal.z * stretch).normalize_or(DVec3::Z));
        }
    }
    let rings = u32::try_from(line.len()).ok()?;
    for ring in 0..rings - 1 {
        for n in 0..SIDES {
            let [a, b] = [ring * SIDES + n, ring * SIDES + (n + 1) % SIDES];
            triangles.extend([[a, b, a + SIDES], [b, b + SIDES, a + SIDES]]);
        }
    }
    let last = (rings - 1) * SIDES;
    for n in 1..SIDES - 1 {
        triangles.extend([[0, n + 1, n], [last, last + n, last + n + 1]]);
    }
    Some(Part {
        volume,
        positions,
        normals: Some(normals),
        triangles,
        opacity: 1.0,
    })
}
