//! Points inside faces, for proofs.

use glam::DVec2;

use super::faces::Face;
use super::polygon::encloses;
use super::sheet::Sheet;
use super::topology::FaceSample;

/// All faces together have at least about this many sample points.
const SAMPLES: usize = 300;
/// Fewest of a face.
const LEAST_SAMPLES: usize = 2;

/// How many sample points each of some faces has.
pub(super) fn each(faces: usize) -> usize {
    SAMPLES.div_ceil(faces.max(1)).max(LEAST_SAMPLES)
}

/// Points inside a face: in the middle of the widest gaps between its loops at some heights.
pub(super) fn samples(sheet: &Sheet, face: &Face, count: usize) -> Vec<FaceSample> {
    let outer = &face.polygons[0];
    let low = outer.iter().fold(f64::INFINITY, |low, p| low.min(p.y));
    let high = outer
        .iter()
        .fold(f64::NEG_INFINITY, |high, p| high.max(p.y));
    let mut found = Vec::with_capacity(count);
    for k in 1..=count {
        // Multiples of the golden ratio: spread evenly, and on no height that symmetry prefers.
        let part = (k as f64 * 0.618_033_988_749_895).fract();
        let y = low + part * (high - low);
        let mut crossings = Vec::new();
        for polygon in &face.polygons {
            let mut b = polygon[polygon.len() - 1];
            for &a in polygon {
                if (a.y > y) != (b.y > y) {
                    crossings.push(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
                }
                b = a;
            }
        }
        crossings.sort_by(f64::total_cmp);
        let widest = crossings
            .chunks_exact(2)
            .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let Some(gap) = widest else { continue };
        let at = DVec2::new(f64::midpoint(gap[0], gap[1]), y);
        // Loops of a faulty arrangement need not lie in each other.
        if !encloses(outer, at) {
            continue;
        }
        let (point, u, v) = sheet.first_jet(at.x, at.y);
        if let Some(normal) = u.cross(v).try_normalize() {
            found.push(FaceSample { point, normal });
        }
    }
    found
}
