//! Scattered points that say that two horizons are equal.
//!
//! A surface through scattered points is within a tolerance of them, so two of them through the same points are not the same.
//! What counts is what the points say, at places where the other surface is known as exactly: there it is given by a point of
//! its own, or by more than points. Such places at which the bed has no thickness make an area where three that are nearest
//! to one of them are such places, too; one alone is a touch.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::deciding::Layer;
use crate::features::horizon::Horizon;
use crate::features::pinch_out::Nodes;
use crate::model::values::surface::HorizonSurface;

/// So many places nearest to one without a thickness have none either, within an area.
const WITHIN: usize = 3;
/// So many places around one are its neighbours: as around a node of a grid.
const AROUND: usize = 8;

/// The scattered points that a surface is fitted to.
pub(super) struct Points {
    all: Vec<DVec3>,
    /// How far the surface may miss them (m).
    pub(super) tolerance: f64,
    /// As fine as the points are, and as their lattice.
    pub(super) nodes: Option<Nodes>,
}

impl Points {
    pub(super) fn of(surface: Option<&HorizonSurface>, fitted: &Horizon) -> Option<Self> {
        let (points, tolerance) = match surface? {
            HorizonSurface::Points { points, tolerance } => (points, *tolerance),
            HorizonSurface::File(file) => (&file.points, file.tolerance()),
            _ => return None,
        };
        let points: Vec<DVec3> = points.iter().copied().map(DVec3::from_array).collect();
        let nodes = fitted.lattices().first().map(|lattice| {
            let (low, high) = lattice.corners();
            let counts = lattice.counts();
            let spacing = ((high - low).element_product() / points.len() as f64).sqrt();
            Nodes { low, high, counts }.as_fine_as(spacing)
        });
        Some(Self {
            all: points,
            tolerance,
            nodes,
        })
    }
}

/// A surface and what it is known from.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub(super) horizon: &'a Horizon,
    pub(super) points: Option<&'a Points>,
}

impl<'a> From<&'a Layer> for Known<'a> {
    fn from(layer: &'a Layer) -> Self {
        Self {
            horizon: &layer.given,
            points: layer.points.as_ref(),
        }
    }
}

/// Lets a thickness at nodes be nothing where points say so: at nodes whose nearest point is of an area without any.
pub(super) fn tell_thickness(
    [older, younger]: [Known<'_>; 2],
    nodes: &Nodes,
    least: f64,
    thickness: &mut [f64],
) {
    let places = Places::between(older, younger, least);
    let Some(is_of_area) = places.areas() else {
        return;
    };
    for (entry, thickness) in thickness.iter_mut().enumerate() {
        let nearest = places.nearest(nodes.place(entry), 1);
        if nearest.iter().any(|place| is_of_area[*place]) {
            *thickness = 0.0;
        }
    }
}

/// Places in plan, from west to east, and whether points say that there is nothing between two surfaces.
struct Places {
    places: Vec<(DVec2, bool)>,
}

impl Places {
    fn between(older: Known<'_>, younger: Known<'_>, least: f64) -> Self {
        let mut places = Vec::new();
        for (own, other) in [(older, younger), (younger, older)] {
            let key = |place: DVec2| place.to_array().map(f64::to_bits);
            let others = other.points.map(|points| &*points.all);
            let at_place: Option<BTreeMap<_, f64>> =
                others.map(|points| points.iter().map(|p| (key(p.xy()), p.z)).collect());
            for point in own.points.map_or(&[][..], |points| &points.all) {
                let height = match &at_place {
                    Some(others) => others.get(&key(point.xy())).copied(),
                    None => Some(other.horizon.height(point.x, point.y)),
                };
                let is_none = height.is_some_and(|height| (height - point.z).abs() <= least);
                places.push((point.xy(), is_none));
            }
        }
        places.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        // A point of each at one place says one thing.
        places.dedup();
        Self { places }
    }

    /// By place, whether it is of an area without a thickness; `None` if there is no such area.
    fn areas(&self) -> Option<Vec<bool>> {
        let is_none = |place: &usize| self.places[*place].1;
        let mut is_of_area = vec![false; self.places.len()];
        for place in (0..self.places.len()).filter(is_none) {
            let at = self.places[place].0;
            let around = self.nearest(at, AROUND + 1);
            let others: Vec<usize> = around.into_iter().filter(|other| *other != place).collect();
            if others.len() < WITHIN || !others[..WITHIN].iter().all(is_none) {
                continue;
            }
            let sides = others[..WITHIN]
                .iter()
                .map(|other| self.places[*other].0 - at);
            let sides: Vec<DVec2> = sides.collect();
            let longest = sides
                .iter()
                .map(|side| side.length_squared())
                .fold(0.0, f64::max);
            // Places in a row are none.
            let widest = |side: &DVec2| sides[0].perp_dot(*side).abs();
            if sides.iter().map(widest).fold(0.0, f64::max) > 1e-3 * longest {
                is_of_area[place] = true;
                for other in others.into_iter().filter(is_none) {
                    is_of_area[other] = true;
                }
            }
        }
        is_of_area.contains(&true).then_some(is_of_area)
    }

    /// The places nearest to one, the nearest first.
    fn nearest(&self, at: DVec2, count: usize) -> Vec<usize> {
        let mut found: Vec<(f64, usize)> = Vec::with_capacity(count + 1);
        let mut east = self.places.partition_point(|(place, _)| place.x < at.x);
        let mut west = east;
        loop {
            let to = |index: Option<usize>| {
                let place = index.and_then(|index| self.places.get(index));
                place.map_or(f64::INFINITY, |(place, _)| (place.x - at.x).abs())
            };
            let (to_west, to_east) = (to(west.checked_sub(1)), to(Some(east)));
            let reach = to_west.min(to_east);
            let farthest = found.get(count - 1).map_or(f64::INFINITY, |(far, _)| *far);
            if !(reach.is_finite() && reach * reach <= farthest) {
                break;
            }
            let next = if to_west <= to_east {
                west -= 1;
                west
            } else {
                east += 1;
                east - 1
            };
            let own = (self.places[next].0.distance_squared(at), next);
            let before = found.partition_point(|other| *other <= own);
            found.insert(before, own);
            found.truncate(count);
        }
        found.into_iter().map(|(_, place)| place).collect()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    /// Points 10 m from each other, with heights by column, and the surface that is fitted to them.
    fn surface(heights: &[f64], tolerance: f64) -> (Horizon, Points) {
        let rows = 0..heights.len();
        let points = rows.flat_map(|j| {
            let row = heights.iter().enumerate();
            row.map(move |(i, z)| [10.0 * i as f64, 10.0 * j as f64, *z])
        });
        let points: Vec<[f64; 3]> = points.collect();
        let all: Vec<DVec3> = points.iter().copied().map(DVec3::from_array).collect();
        let fitted = Horizon::points(&all, tolerance).unwrap();
        let surface = HorizonSurface::Points { points, tolerance };
        let points = Points::of(Some(&surface), &fitted).unwrap();
        (fitted, points)
    }

    fn told(older: &[f64], younger: &[f64]) -> Vec<bool> {
        let surfaces = [older, younger].map(|heights| surface(heights, 0.5));
        let nodes = Nodes {
            low: DVec2::ZERO,
            high: DVec2::splat(80.0),
            counts: [9, 9],
        };
        let mut thickness = vec![7.0; 81];
        let known = surfaces.each_ref().map(|(horizon, points)| Known {
            horizon,
            points: Some(points),
        });
        tell_thickness(known, &nodes, 0.01, &mut thickness);
        // The row in the middle.
        (0..9).map(|i| thickness[i * 9 + 4] == 0.0).collect()
    }

    #[test]
    fn points_that_are_equal_over_an_area_have_nothing_between_them_there() {
        let older = [0.0, 3.0, 1.0, 4.0, 2.0, 6.0, 4.0, 5.0, 9.0];
        let mut younger = older;
        for (k, more) in [9.0, 6.0, 3.0].into_iter().enumerate() {
            younger[k] += more;
        }
        younger[6] += 0.009;
        let wanted = [false, false, false, true, true, true, true, true, true];
        assert_eq!(told(&older, &younger), wanted);
    }

    #[test]
    fn a_row_of_equal_points_is_a_touch() {
        let older = [0.0, 3.0, 1.0, 4.0, 2.0, 6.0, 4.0, 5.0, 9.0];
        let mut younger = older.map(|z| z + 2.0);
        younger[4] = older[4];
        assert_eq!(told(&older, &younger), [false; 9]);
    }

    #[test]
    fn points_on_a_level_have_nothing_above_it() {
        let (horizon, points) = surface(&[8.0, 4.0, 0.0, 0.0, 0.0, 0.0], 0.5);
        let level = Horizon::flat(0.0).unwrap();
        let nodes = points.nodes.unwrap();
        let mut thickness = vec![7.0; nodes.counts[0] * nodes.counts[1]];
        let (points, horizon) = (Some(&points), &horizon);
        let known = [
            Known {
                horizon: &level,
                points: None,
            },
            Known { horizon, points },
        ];
        tell_thickness(known, &nodes, 0.01, &mut thickness);
        for (entry, thickness) in thickness.iter().enumerate() {
            let x = nodes.place(entry).x;
            if (x - 15.0).abs() > 1.0 {
                assert_eq!(*thickness == 0.0, x > 15.0, "at {x}");
            }
        }
    }

    #[test]
    fn the_nearest_places_are_those_of_a_search_through_all() {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            f64::from(u32::try_from(state >> 40).unwrap()) / f64::from(1 << 24)
        };
        let mut places: Vec<(DVec2, bool)> = (0..300)
            .map(|_| (DVec2::new(random(), random()), false))
            .collect();
        places.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x));
        let places = Places { places };
        for _ in 0..100 {
            let at = DVec2::new(random() * 1.4 - 0.2, random() * 1.4 - 0.2);
            let mut all: Vec<usize> = (0..300).collect();
            let distance = |k: &usize| places.places[*k].0.distance(at);
            all.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
            assert_eq!(places.nearest(at, 5), all[..5]);
        }
        assert_eq!(places.nearest(DVec2::ZERO, 400).len(), 300);
    }
}
