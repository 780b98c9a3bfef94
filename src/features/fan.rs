//! Fans: flat faces bounded by any number of curves, as one sheet for each curve with a common pole.
//!
//! A sheet has four sides, and one sheet's side is another one's as a whole. So where a flat face has more sides than that (the end
//! of a channel whose section has corners), a place inside it that sees all of its border is the pole of as many sheets.

use glam::{DVec2, DVec3};

use crate::nurbs::{Curve, KnotVector, Surface, SurfaceError};

/// Places along each axis among which a pole is looked for first.
const GRID: usize = 32;
/// Rounds in which the best one is moved by less and less.
const ROUNDS: usize = 40;
/// How far from the line of the nearest side a pole must be, as a fraction of the face's size.
const CLEAR: f64 = 1e-3;

/// The place inside a polygon (in order, not closed, either way around) that is farthest from the lines of all of its sides; none
/// if no place sees all of them.
pub(super) fn centre(polygon: &[DVec2]) -> Option<DVec2> {
    let (low, high) = polygon
        .iter()
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| {
            (low.min(*p), high.max(*p))
        });
    let size = high - low;
    let sides: Vec<(DVec2, DVec2)> = polygon
        .iter()
        .zip(polygon.iter().cycle().skip(1))
        .filter(|(a, b)| a.distance(**b) > 1e-12 * size.length())
        .map(|(a, b)| (*a, (*b - *a).normalize()))
        .collect();
    let area: f64 = polygon
        .iter()
        .zip(polygon.iter().cycle().skip(1))
        .map(|(a, b)| a.perp_dot(*b))
        .sum();
    // As a fraction of the polygon's own size across: sections are flat.
    let clear = |p: DVec2| {
        sides
            .iter()
            .map(|(at, along)| {
                let normal = along.perp() * area.signum();
                (p - *at).dot(normal) / (size * normal).abs().element_sum()
            })
            .fold(f64::INFINITY, f64::min)
    };
    let at =
        |i: usize, j: usize| low + size * DVec2::new(i as f64 + 0.5, j as f64 + 0.5) / GRID as f64;
    let places = (0..GRID).flat_map(|i| (0..GRID).map(move |j| (i, j)));
    let (mut best, mut room) = places
        .map(|(i, j)| at(i, j))
        .map(|p| (p, clear(p)))
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    let mut step = size / GRID as f64;
    for _ in 0..ROUNDS {
        let around = [DVec2::X, DVec2::Y, DVec2::ONE, DVec2::new(1.0, -1.0)];
        let moved = around
            .iter()
            .flat_map(|way| [best + step * *way, best - step * *way])
            .map(|p| (p, clear(p)))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        match moved {
            Some((p, more)) if more > room => (best, room) = (p, more),
            _ => step *= 0.5,
        }
    }
    (room > CLEAR).then_some(best)
}

/// The sheet between a curve and a pole: u from the curve to the pole, v along the curve.
pub(super) fn sheet(side: &Curve, pole: DVec3) -> Result<Surface, SurfaceError> {
    let across = KnotVector::uniform(1, 2)?;
    let count = side.points().len();
    let net = [side.points(), &vec![pole; count]].concat();
    if side.is_rational() {
        let weights = [side.weights(), side.weights()].concat();
        Surface::rational(across, side.knots().clone(), net, weights)
    } else {
        Surface::new(across, side.knots().clone(), net)
    }
}

/// The flat face inside curves that follow each other around it (each either way), in an upright plane; none if no place sees all
/// of it.
pub(super) fn face(sides: &[Curve]) -> Option<Result<Vec<Surface>, SurfaceError>> {
    /// Points of each curve by which the pole is chosen.
    const SAMPLES: usize = 12;
    let ends = |curve: &Curve| {
        let (from, to) = curve.domain();
        [curve.point(from), curve.point(to)]
    };
    let [first, last] = ends(sides.first()?);
    // The first curve is run through so that it ends where the second one is.
    let next = ends(sides.get(1)?);
    let meets = |p: DVec3| next[0].distance(p).min(next[1].distance(p));
    let mut at = if meets(last) <= meets(first) {
        first
    } else {
        last
    };
    let mut points = Vec::new();
    for curve in sides {
        let (from, to) = curve.domain();
        let forwards = at.distance(curve.point(from)) <= at.distance(curve.point(to));
        for i in 0..SAMPLES {
            let part = i as f64 / SAMPLES as f64;
            let part = if forwards { part } else { 1.0 - part };
            points.push(curve.point(from + (to - from) * part));
        }
        at = curve.point(if forwards { to } else { from });
    }
    // Coordinates in the plane: along its level direction, and up.
    let origin = points[0];
    let farthest = points
        .iter()
        .map(|p| (*p - origin).truncate())
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
    let level = farthest.try_normalize()?;
    let flat = |p: &DVec3| DVec2::new((*p - origin).truncate().dot(level), p.z - origin.z);
    let polygon: Vec<DVec2> = points.iter().map(flat).collect();
    let pole = centre(&polygon)?;
    let pole = (origin.truncate() + level * pole.x).extend(origin.z + pole.y);
    Some(sides.iter().map(|side| sheet(side, pole)).collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    fn polygon(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|(x, y)| DVec2::new(*x, *y)).collect()
    }

    #[test]
    fn a_place_that_sees_a_whole_polygon_is_found_whichever_way_around_it_is_given() {
        // A deep pit between shallow wings: only what is near the top of the pit sees all.
        let mut wings = polygon(&[
            (-0.5, 0.0),
            (-0.3, -0.3),
            (-0.1, -0.3),
            (0.0, -1.0),
            (0.1, -0.3),
            (0.3, -0.3),
            (0.5, 0.0),
        ]);
        for _ in 0..2 {
            let pole = centre(&wings).unwrap();
            assert!(
                pole.x.abs() < 0.02 && pole.y < 0.0 && pole.y > -0.3,
                "{pole}"
            );
            wings.reverse();
        }
        // Two basins with upright walls between them: no place sees both.
        let two = polygon(&[
            (-0.5, 0.0),
            (-0.4, -1.0),
            (-0.1, -1.0),
            (-0.1, -0.3),
            (0.1, -0.3),
            (0.1, -1.0),
            (0.4, -1.0),
            (0.5, 0.0),
        ]);
        assert!(centre(&two).is_none());
    }
}
