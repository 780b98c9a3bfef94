//! Where in a plan heights are known: how far the rest is from them.

use glam::{DVec2, DVec3, Vec3Swizzles};

/// Places along each side of the plan at which the distance from the nearest height is looked for.
const PLACES: usize = 65;
/// Cells in which heights are sorted, along each side.
const CELLS: usize = 256;

/// How far a plan is from heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// From a place between the heights to the nearest one, at most (m): how far holes are filled. Sampled.
    pub filled: f64,
    /// From a place of the plan to the convex hull of the heights, at most (m): how far they are extrapolated.
    pub extrapolated: f64,
    /// What two neighbouring heights are apart, of as many over as large an area (m).
    pub spacing: f64,
    /// The plan's diagonal (m).
    pub diagonal: f64,
}

impl Coverage {
    /// Of a plan by heights, of which there is at least one.
    pub fn of(heights: &[DVec3], [low, high]: [DVec2; 2]) -> Self {
        let places: Vec<DVec2> = heights.iter().map(|p| p.xy()).collect();
        let hull = hull(&places);
        let corners = [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ];
        let beyond = |at: DVec2| outside(&hull, at);
        // How far it is to something convex is greatest at a corner.
        let extrapolated = corners.into_iter().map(beyond).fold(0.0, f64::max);
        let cells = Cells::of(&places);
        let mut filled: f64 = 0.0;
        for i in 0..PLACES {
            for j in 0..PLACES {
                let part = DVec2::new(i as f64, j as f64) / (PLACES - 1) as f64;
                let at = low + (high - low) * part;
                if beyond(at) == 0.0 {
                    filled = filled.max(cells.nearest(at));
                }
            }
        }
        let area = hull_area(&hull);
        Self {
            filled,
            extrapolated,
            spacing: (area / places.len() as f64).sqrt(),
            diagonal: low.distance(high),
        }
    }

    /// Whether it is extrapolated by more than what everybody leaves at the border: a step of the data.
    pub fn reaches_beyond(&self) -> bool {
        self.extrapolated > self.spacing.min(0.02 * self.diagonal)
    }

    /// Whether there are holes: places farther from all heights than those are from each other, as a rule.
    pub fn has_holes(&self) -> bool {
        self.filled > 3.0 * self.spacing
    }
}

/// The convex hull, counter-clockwise (Andrew 1979).
fn hull(places: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    let chain = |places: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for place in places {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(place - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(place);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter().copied());
    hull.extend(chain(&mut sorted.iter().rev().copied()));
    if hull.is_empty() {
        hull.extend(sorted.first());
    }
    hull
}

/// The sides of a hull; of a point or a line that there and back.
fn sides(hull: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    (0..hull.len()).map(|k| (hull[k], hull[(k + 1) % hull.len()]))
}

fn hull_area(hull: &[DVec2]) -> f64 {
    let start = hull.first().copied().unwrap_or_default();
    0.5 * sides(hull)
        .map(|(a, b)| (a - start).perp_dot(b - start))
        .sum::<f64>()
}

/// How far a place lies outside of a hull; 0 inside.
fn outside(hull: &[DVec2], at: DVec2) -> f64 {
    let is_inside = hull.len() > 2 && sides(hull).all(|(a, b)| (b - a).perp_dot(at - a) >= 0.0);
    if is_inside {
        return 0.0;
    }
    let to_side = |(a, b): (DVec2, DVec2)| {
        let along = (b - a).length_squared();
        let part = if along > 0.0 {
            ((at - a).dot(b - a) / along).clamp(0.0, 1.0)
        } else {
            0.0
        };
        at.distance(a + part * (b - a))
    };
    sides(hull).map(to_side).fold(f64::INFINITY, f64::min)
}

/// Places in plan, sorted into cells.
struct Cells<'a> {
    places: &'a [DVec2],
    low: DVec2,
    size: DVec2,
    /// By cell, x-major: places in it.
    within: Vec<Vec<u32>>,
}

impl<'a> Cells<'a> {
    fn of(places: &'a [DVec2]) -> Self {
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = places
            .iter()
            .fold(empty, |(low, high), p| (low.min(*p), high.max(*p)));
        let size = ((high - low) / CELLS as f64).max(DVec2::splat(1e-9));
        let mut cells = Self {
            places,
            low,
            size,
            within: vec![Vec::new(); CELLS * CELLS],
        };
        for (index, place) in places.iter().enumerate() {
            let [i, j] = cells.cell(*place);
            cells.within[i * CELLS + j].push(u32::try_from(index).unwrap_or(u32::MAX));
        }
        cells
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the numbers of cells"
    )]
    fn cell(&self, at: DVec2) -> [usize; 2] {
        let cell =
            ((at - self.low) / self.size).clamp(DVec2::ZERO, DVec2::splat((CELLS - 1) as f64));
        [cell.x as usize, cell.y as usize]
    }

    /// How far the nearest place is (m): by rings of cells around that of the place, until no farther ring can be nearer.
    fn nearest(&self, at: DVec2) -> f64 {
        let [i, j] = self.cell(at);
        let mut nearest = f64::INFINITY;
        for ring in 0..CELLS {
            // What is beyond a ring is at least as far as the ring before is wide.
            let near = (ring as f64 - 1.0) * self.size.min_element();
            if near > nearest {
                break;
            }
            let (west, east) = (i.saturating_sub(ring), (i + ring).min(CELLS - 1));
            let (south, north) = (j.saturating_sub(ring), (j + ring).min(CELLS - 1));
            for column in west..=east {
                let is_side = column + ring == i || column == i + ring;
                let step = if is_side || north == south {
                    1
                } else {
                    north - south
                };
                for row in (south..=north).step_by(step) {
                    let is_end = row + ring == j || row == j + ring;
                    if !(is_side || is_end) {
                        continue;
                    }
                    for index in &self.within[column * CELLS + row] {
                        nearest = nearest.min(at.distance(self.places[*index as usize]));
                    }
                }
            }
        }
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: [DVec2; 2] = [DVec2::ZERO, DVec2::new(100.0, 60.0)];

    fn grid(step: u32, keeps: impl Fn(DVec2) -> bool) -> Vec<DVec3> {
        let places = (0..=100 / step).flat_map(|i| (0..=60 / step).map(move |j| (i, j)));
        let places = places.map(|(i, j)| DVec2::new(f64::from(i * step), f64::from(j * step)));
        places
            .filter(|at| keeps(*at))
            .map(|at| at.extend(0.0))
            .collect()
    }

    #[test]
    fn a_grid_over_the_plan_has_no_holes_and_is_not_extrapolated() {
        let coverage = Coverage::of(&grid(5, |_| true), PLAN);
        assert_eq!(coverage.extrapolated, 0.0);
        // Half of a diagonal at most; places need not lie in the middle.
        assert!(coverage.filled <= 12.5_f64.sqrt() + 1e-9 && !coverage.has_holes());
    }

    #[test]
    fn a_hole_is_filled_from_its_border_to_its_middle() {
        let middle = DVec2::new(50.0, 30.0);
        let coverage = Coverage::of(&grid(2, |at| at.distance(middle) > 20.0), PLAN);
        assert!((coverage.filled - 20.0).abs() < 1.5, "{}", coverage.filled);
        assert!(coverage.has_holes() && coverage.extrapolated == 0.0);
    }

    #[test]
    fn the_farthest_corner_tells_how_far_data_are_extrapolated() {
        // From (100, 60) to the corner (70, 20) of the data.
        let coverage = Coverage::of(&grid(10, |at| at.x <= 70.0 && at.y <= 20.0), PLAN);
        assert!((coverage.extrapolated - 50.0).abs() < 1e-9);
        let line: Vec<DVec3> = (0..9)
            .map(|k| DVec3::new(12.5 * f64::from(k), 0.0, 0.0))
            .collect();
        assert!((Coverage::of(&line, PLAN).extrapolated - 60.0).abs() < 1e-9);
        let point = Coverage::of(&[DVec3::new(97.0, 64.0, 0.0)], PLAN);
        assert!((point.extrapolated - 97.0_f64.hypot(64.0)).abs() < 1e-9);
    }
}
