//! Wells on sections and maps: what of their paths is near enough, projected.

use glam::{DVec2, DVec3, Vec3Swizzles};

use crate::export::picture::section::{Extent, Trace};
use crate::model::Model;

/// Places of a path that are projected.
const PLACES: usize = 2000;

/// The parts of all wells that are within a distance (m) of a section's line, as distances along that and elevations.
pub(super) fn on_section(model: &Model, line: &[DVec2], extent: Extent, within: f64) -> Vec<Trace> {
    traces(model, extent, |point| {
        let (along, apart) = nearest(line, point.xy());
        (apart <= within).then(|| DVec2::new(along, point.z))
    })
}

/// The parts of all wells that are within a distance (m) of an elevation, in plan.
pub(super) fn on_map(model: &Model, elevation: f64, extent: Extent, within: f64) -> Vec<Trace> {
    traces(model, extent, |point| {
        ((point.z - elevation).abs() <= within).then(|| point.xy())
    })
}

/// How far along a line its place is that is nearest to a point, and how far that is.
fn nearest(line: &[DVec2], point: DVec2) -> (f64, f64) {
    let (mut best, mut before) = ((0.0, f64::INFINITY), 0.0);
    for leg in line.windows(2) {
        let (way, length) = (leg[1] - leg[0], leg[0].distance(leg[1]));
        let part = ((point - leg[0]).dot(way) / (length * length)).clamp(0.0, 1.0);
        let apart = point.distance(leg[0] + part * way);
        if apart < best.1 {
            best = (before + part * length, apart);
        }
        before += length;
    }
    best
}

/// The paths as far as they are shown and lie in the frame; the end of each has its name.
fn traces(model: &Model, extent: Extent, project: impl Fn(DVec3) -> Option<DVec2>) -> Vec<Trace> {
    let (low, high) = (
        DVec2::new(extent.horizontal[0], extent.vertical[0]),
        DVec2::new(extent.horizontal[1], extent.vertical[1]),
    );
    let mut traces = Vec::new();
    for spec in &model.wells {
        let (first, last) = spec.well.range();
        let mut parts: Vec<Vec<DVec2>> = vec![Vec::new()];
        for k in 0..=PLACES {
            let md = first + (last - first) * k as f64 / PLACES as f64;
            let shown =
                project(spec.well.point(md)).filter(|p| p.cmpge(low).all() && p.cmple(high).all());
            match (shown, parts.last_mut()) {
                (Some(place), Some(part)) if part.last() != Some(&place) => part.push(place),
                (None, Some(part)) if !part.is_empty() => parts.push(Vec::new()),
                _ => {}
            }
        }
        let own = traces.len();
        traces.extend(
            parts
                .into_iter()
                .filter(|part| part.len() > 1)
                .map(|line| Trace {
                    ends: [String::new(), String::new()],
                    line,
                }),
        );
        // A lateral begins where its mother is.
        if let Some(last) = traces[own..].last_mut() {
            last.ends[1].clone_from(&spec.name);
        }
    }
    traces
}

#[cfg(test)]
mod tests {
    use super::nearest;
    use glam::DVec2;

    #[test]
    fn the_nearest_place_of_a_fence_is_counted_along_it() {
        let line = [(0.0, 0.0), (10.0, 0.0), (10.0, 20.0)].map(|(x, y)| DVec2::new(x, y));
        assert_eq!(nearest(&line, DVec2::new(4.0, 3.0)), (4.0, 3.0));
        assert_eq!(nearest(&line, DVec2::new(12.0, 5.0)), (15.0, 2.0));
        assert_eq!(nearest(&line, DVec2::new(-3.0, -4.0)), (0.0, 5.0));
    }
}
