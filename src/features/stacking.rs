//! Compensational stacking: later lobes prefer the hollows between older ones (Straub et al. 2009).
//!
//! A lobe's centre is drawn with a probability proportional to exp(−C (T(x) − min T)/H), T the relief that older lobes have
//! made, H the lobe's thickness and C the strength of compensation: 0 places lobes at random, and with 20 or more each lies at
//! the lowest place. Each lobe lies on a smooth surface through what is there, lowered a little so that nothing stays between.

use glam::DVec2;
use rayon::prelude::*;

use super::body::Role;
use super::horizon::{Horizon, HorizonError};
use super::lobe::Lobe;
use super::shell::{Shell, ShellError};
use crate::nurbs::Surface;

/// Cells of the grid of possible centres in a lobe's width.
const CELLS: f64 = 20.0;
/// Places along a cell at which a floor's deviation is measured.
const PROBES: usize = 5;
/// How far a lobe's floor is lowered, in deviations of the surface through what is there.
const LOWERED: f64 = 2.0;
/// Most cells along a side of the region.
const MOST_CELLS: f64 = 400.0;

/// Where centres of lobes may be: a polygon in plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    corners: Vec<DVec2>,
    low: DVec2,
    high: DVec2,
}

/// Why corners make no region.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionError {
    /// Too few corners.
    #[error("a region has {0} corners: give at least 3")]
    Corners(usize),
    /// A corner that is no place.
    #[error("corner {index} of the region is {value}: coordinates must be finite")]
    NotFinite {
        /// Which, from 0.
        index: usize,
        /// The corner.
        value: DVec2,
    },
    /// It has no area.
    #[error("the region has no area")]
    Empty,
}

impl Region {
    /// The inside of a polygon.
    pub fn new(corners: Vec<DVec2>) -> Result<Self, RegionError> {
        if corners.len() < 3 {
            return Err(RegionError::Corners(corners.len()));
        }
        if let Some((index, &value)) = corners.iter().enumerate().find(|(_, p)| !p.is_finite()) {
            return Err(RegionError::NotFinite { index, value });
        }
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = corners
            .iter()
            .fold(empty, |(low, high), p| (low.min(*p), high.max(*p)));
        let region = Self { corners, low, high };
        if region.area() > 0.0 {
            Ok(region)
        } else {
            Err(RegionError::Empty)
        }
    }

    /// A rectangle along the axes.
    pub fn rectangle(low: DVec2, high: DVec2) -> Result<Self, RegionError> {
        let corners = [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ];
        Self::new(corners.to_vec())
    }

    /// Its area (m²).
    pub fn area(&self) -> f64 {
        let next = self.corners.iter().cycle().skip(1);
        let sides = self.corners.iter().zip(next);
        0.5 * sides
            .map(|(a, b)| (*a - self.low).perp_dot(*b - self.low))
            .sum::<f64>()
            .abs()
    }

    /// Whether it holds a place.
    pub fn contains(&self, at: DVec2) -> bool {
        let next = self.corners.iter().cycle().skip(1);
        let crossings = self.corners.iter().zip(next).filter(|(a, b)| {
            let is_between = (a.y > at.y) != (b.y > at.y);
            is_between && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y)
        });
        crossings.count() % 2 == 1
    }
}

/// A lobe filled down to a level (m): its cap, walls below the rim, and a flat base. A younger lobe takes nothing from older ones, so
/// what of it lies in these may be anything; a base that follows them would run along them, hardly ever crossing, for nothing.
pub fn filled(lobe: &Shell, level: f64) -> Result<Shell, ShellError> {
    let mut sheets = Vec::with_capacity(lobe.sheets().len() * 3 / 2);
    for (role, cap) in lobe.sheets() {
        if *role != Role::Top {
            continue;
        }
        let base = cap.mapped(|p| p.with_z(level))?;
        let rim = cap.knots_u().domain().1;
        let wall = Surface::ruled(&cap.isocurve_u(rim), &base.isocurve_u(rim))?;
        sheets.push((*role, cap.clone()));
        sheets.extend([base, wall].map(|sheet| (Role::Hidden, sheet)));
    }
    Shell::new(sheets)
}

/// Lobes that lie on each other and on a datum.
pub struct Pile<'a> {
    /// The elevation of what the oldest ones lie on (m).
    datum: &'a (dyn Fn(DVec2) -> f64 + Sync),
    laid: Vec<Laid>,
}

/// A lobe where it lies.
struct Laid {
    lobe: Lobe,
    floor: Floor,
    /// The corners of its box in plan.
    plan: [DVec2; 2],
}

/// What a lobe lies on: a smooth surface through what is there, lowered a little.
#[derive(Clone, Debug)]
pub struct Floor {
    surface: Horizon,
    /// How far the surface is from what is there, at most, between its nodes (m).
    deviation: f64,
    /// How far it lies below the surface (m).
    lowered: f64,
}

impl Floor {
    /// Its elevation at a place (m): nowhere above what is there, so that no slivers stay between.
    pub fn height(&self, at: DVec2) -> f64 {
        self.surface.height(at.x, at.y) - self.lowered
    }

    /// How far the surface through what is there is off, at most (m).
    pub fn deviation(&self) -> f64 {
        self.deviation
    }

    /// How far it lies below that surface (m).
    pub fn lowered(&self) -> f64 {
        self.lowered
    }

    /// The same floor, lowered by no less than that (m).
    #[must_use]
    pub fn lowered_by(self, least: f64) -> Self {
        Self {
            lowered: self.lowered.max(least),
            ..self
        }
    }
}

impl<'a> Pile<'a> {
    /// No lobes yet, on a datum (m).
    pub fn new(datum: &'a (dyn Fn(DVec2) -> f64 + Sync)) -> Self {
        Self {
            datum,
            laid: Vec::new(),
        }
    }

    /// The elevation of what is there (m): the upper envelope of the datum and the lobes.
    pub fn height(&self, at: DVec2) -> f64 {
        let over = |laid: &Laid| at.cmpge(laid.plan[0]).all() && at.cmple(laid.plan[1]).all();
        let tops = self
            .laid
            .iter()
            .filter(|laid| over(laid))
            .filter_map(|laid| {
                let thickness = laid.lobe.thickness_at(at);
                (thickness > 0.0).then(|| laid.floor.height(at) + thickness)
            });
        tops.fold((self.datum)(at), f64::max)
    }

    /// How high what is there stands above the datum at a place (m).
    pub fn relief(&self, at: DVec2) -> f64 {
        self.height(at) - (self.datum)(at)
    }

    /// What the next lobe lies on over a plan, with nodes a distance apart (m).
    pub fn floor(&self, [low, high]: [DVec2; 2], spacing: f64) -> Result<Floor, HorizonError> {
        // Written so that a number that is none fails too.
        if !(spacing > 0.0) {
            return Err(HorizonError::Number {
                name: "distance between nodes",
                value: spacing,
            });
        }
        let counts = ((high - low) / spacing).ceil().max(DVec2::ONE);
        let step = (high - low) / counts;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at least one"
        )]
        let [columns, rows] = [counts.x as usize + 1, counts.y as usize + 1];
        let node = |i: usize, j: usize| low + step * DVec2::new(i as f64, j as f64);
        let heights: Vec<Vec<f64>> = (0..rows)
            .into_par_iter()
            .map(|j| (0..columns).map(|i| self.height(node(i, j))).collect())
            .collect();
        let surface = Horizon::grid([low.x, high.x], [low.y, high.y], &heights)?;
        let off = |i: usize| {
            let mut farthest = 0.0_f64;
            for j in 0..rows - 1 {
                for k in 0..PROBES * PROBES {
                    let part = DVec2::new((k % PROBES) as f64, (k / PROBES) as f64) / PROBES as f64;
                    let at = node(i, j) + step * part;
                    let off = surface.height(at.x, at.y) - self.height(at);
                    farthest = farthest.max(off.abs());
                }
            }
            farthest
        };
        let deviation = (0..columns - 1)
            .into_par_iter()
            .map(off)
            .reduce(|| 0.0, f64::max);
        Ok(Floor {
            surface,
            deviation,
            lowered: LOWERED * deviation,
        })
    }

    /// Lays a lobe on a floor.
    pub fn lay(&mut self, lobe: Lobe, floor: Floor) {
        let plan = lobe.plan();
        self.laid.push(Laid { lobe, floor, plan });
    }
}

/// Lobes of about one size in a region, and where the next one is likely to be.
#[derive(Clone, Debug)]
pub struct Stack {
    region: Region,
    /// Size of a cell.
    step: DVec2,
    /// Middles of the cells that lie in the region, with the relief there.
    places: Vec<(DVec2, f64)>,
}

impl Stack {
    /// No lobes yet; they will be about so wide (m).
    pub fn new(region: Region, width: f64) -> Result<Self, RegionError> {
        let size = region.high - region.low;
        let cell = (width / CELLS).max(size.max_element() / MOST_CELLS);
        let counts = (size / cell).ceil().max(DVec2::ONE);
        let step = size / counts;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 1 and the most cells"
        )]
        let [columns, rows] = [counts.x as usize, counts.y as usize];
        let middle = |k: usize| {
            let at = DVec2::new((k % columns) as f64 + 0.5, (k / columns) as f64 + 0.5);
            region.low + step * at
        };
        let all = (0..columns * rows).map(middle);
        let places: Vec<_> = all
            .filter(|at| region.contains(*at))
            .map(|at| (at, 0.0))
            .collect();
        if places.is_empty() {
            return Err(RegionError::Empty);
        }
        Ok(Self {
            region,
            step,
            places,
        })
    }

    /// Takes note of a lobe, with what the relief is now (m).
    pub fn lay(&mut self, lobe: &Lobe, relief: impl Fn(DVec2) -> f64) {
        for (at, height) in &mut self.places {
            if lobe.thickness_at(*at) > 0.0 {
                *height = relief(*at);
            }
        }
    }

    /// The centre of the next lobe, of a thickness (m), by three numbers from 0 to 1.
    pub fn next_center(&self, thickness: f64, compensation: f64, draws: [f64; 3]) -> DVec2 {
        let heights = self.places.iter().map(|place| place.1);
        let lowest = heights.fold(f64::INFINITY, f64::min);
        let weight = |height: f64| (-compensation * (height - lowest) / thickness).exp();
        let all: f64 = self.places.iter().map(|place| weight(place.1)).sum();
        let mut rest = draws[0] * all;
        let chosen = self.places.iter().position(|place| {
            rest -= weight(place.1);
            rest < 0.0
        });
        // Rounding may leave nothing for the last one.
        let at = self.places[chosen.unwrap_or(self.places.len() - 1)].0;
        let within = at + self.step * (DVec2::new(draws[1], draws[2]) - 0.5);
        if self.region.contains(within) {
            within
        } else {
            at
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use std::f64::consts::PI;

    use super::*;
    use crate::features::lobe::LobeDesign;

    fn lobe(center: DVec2) -> Lobe {
        let design = LobeDesign {
            center: center.extend(0.0),
            length: 135.0,
            width: 90.0,
            thickness: 4.0,
            azimuth: 0.7,
            taper: 0.3,
            skew: 0.2,
        };
        design.build().unwrap()
    }

    /// Numbers without pattern (splitmix64), another series for each stack.
    fn draws(k: u32, of: u32) -> [f64; 3] {
        [0, 1, 2].map(|which| {
            let seed = (u64::from(of) << 40) + (u64::from(k) << 8) + which;
            let mut z = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((z ^ (z >> 31)) >> 11) as f64 / 2.0_f64.powi(53)
        })
    }

    const LEVEL: f64 = -30.0;

    fn level(_: DVec2) -> f64 {
        LEVEL
    }

    /// Lays a lobe on what is there.
    fn lay(pile: &mut Pile<'_>, lobe: Lobe) {
        let floor = pile.floor(lobe.plan(), 4.5).unwrap();
        pile.lay(lobe, floor);
    }

    fn stack(count: u32, compensation: f64, of: u32) -> Pile<'static> {
        let region = Region::rectangle(DVec2::ZERO, DVec2::new(1000.0, 800.0)).unwrap();
        let mut stack = Stack::new(region, 90.0).unwrap();
        let mut pile = Pile::new(&level);
        for k in 0..count {
            let one = lobe(stack.next_center(4.0, compensation, draws(k, of)));
            lay(&mut pile, one);
            stack.lay(&one, |at| pile.relief(at));
        }
        pile
    }

    /// Mean of the relief, and its standard deviation as a fraction, in the middle of the region.
    fn spread(pile: &Pile<'_>) -> [f64; 2] {
        let places = (0..80 * 60).map(|k| {
            let at = DVec2::new(f64::from(k % 80), f64::from(k / 80));
            pile.relief(DVec2::splat(100.0) + 10.0 * at)
        });
        let all: Vec<f64> = places.collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let square = all.iter().map(|z| (z - mean).powi(2)).sum::<f64>() / all.len() as f64;
        [mean, square.sqrt() / mean]
    }

    #[test]
    fn without_compensation_lobes_cover_what_a_boolean_model_does() {
        let (count, plan) = (60, PI / 4.0 * 135.0 * 90.0);
        let mut covered = [0; 2];
        for of in 0..20 {
            let lobes = stack(count, 0.0, of);
            for k in 0..1200 {
                // Far enough from the region's border.
                let at = DVec2::new(f64::from(k % 40), f64::from(k / 40));
                let at = DVec2::new(100.0, 100.0) + at * DVec2::new(20.0, 20.0);
                covered[usize::from(lobes.relief(at) > 0.0)] += 1;
            }
        }
        let share = f64::from(covered[1]) / f64::from(covered[0] + covered[1]);
        let wanted = 1.0 - (-f64::from(count) * plan / 8e5).exp();
        assert!((share - wanted).abs() < 0.03, "{share} {wanted}");
    }

    #[test]
    fn the_stronger_the_compensation_the_more_even_the_relief() {
        let of = |compensation: f64| {
            let all = (0..3).map(|of| spread(&stack(150, compensation, of))[1]);
            all.sum::<f64>() / 3.0
        };
        let spreads = [0.0, 2.0, 20.0].map(of);
        assert!(
            spreads[0] > 1.1 * spreads[1] && spreads[1] > 1.1 * spreads[2],
            "{spreads:?}"
        );
    }

    #[test]
    fn with_strong_compensation_a_lobe_lies_in_the_hollow() {
        let region = Region::rectangle(DVec2::ZERO, DVec2::new(300.0, 40.0)).unwrap();
        let mut stack = Stack::new(region, 90.0).unwrap();
        let mut pile = Pile::new(&level);
        // All but the east is high.
        for k in 0..6 {
            let one = lobe(DVec2::new(f64::from(k) * 40.0, 20.0));
            lay(&mut pile, one);
            stack.lay(&one, |at| pile.relief(at));
        }
        for k in 0..50 {
            let at = stack.next_center(4.0, 50.0, draws(k, 3));
            assert!(at.x > 240.0, "{at}");
        }
    }

    #[test]
    fn a_floor_is_nowhere_above_what_is_there_and_nearer_to_it_with_more_nodes() {
        let mut pile = Pile::new(&level);
        for center in [DVec2::ZERO, DVec2::new(60.0, 20.0)] {
            lay(&mut pile, lobe(center));
        }
        let plan = [DVec2::splat(-100.0), DVec2::splat(120.0)];
        let [coarse, fine] = [20.0, 4.0].map(|spacing| pile.floor(plan, spacing).unwrap());
        let deviation = fine.deviation();
        assert!(
            deviation < 0.5 * coarse.deviation() && deviation < 0.3,
            "{} {deviation}",
            coarse.deviation()
        );
        for k in 0..3000 {
            let [x, y, _] = draws(k, 1);
            let at = plan[0] + (plan[1] - plan[0]) * DVec2::new(x, y);
            let below = pile.height(at) - fine.height(at);
            // Probes are a fifth of a cell apart.
            assert!(
                below > 0.8 * deviation && below < 3.2 * deviation,
                "{at}: {below} {deviation}"
            );
        }
        assert!(pile.floor(plan, f64::NAN).is_err());
        assert!(fine.clone().lowered_by(9.0).lowered() == 9.0);
    }

    #[test]
    fn a_pile_is_as_high_as_its_lobes_where_they_lie_on_each_other() {
        let mut pile = Pile::new(&level);
        let one = lobe(DVec2::ZERO);
        lay(&mut pile, one);
        let once = pile.relief(DVec2::new(3.0, 4.0));
        let thickness = one.thickness_at(DVec2::new(3.0, 4.0));
        assert!(
            (once - thickness).abs() < 1e-9,
            "a level datum is fitted exactly"
        );
        lay(&mut pile, one);
        let twice = pile.relief(DVec2::new(3.0, 4.0));
        // Lowered by two deviations of a surface that has a crease at the rim.
        assert!(
            twice < 2.0 * thickness && twice > 1.9 * thickness,
            "{twice} {thickness}"
        );
        assert!(pile.relief(DVec2::new(300.0, 0.0)).abs() < 1e-12);
    }

    #[test]
    fn centres_lie_in_the_region_and_the_same_draws_give_the_same() {
        let corners = [
            (0.0, 0.0),
            (400.0, 0.0),
            (400.0, 50.0),
            (50.0, 50.0),
            (50.0, 300.0),
            (0.0, 300.0),
        ]
        .map(|(x, y)| DVec2::new(x, y));
        let region = Region::new(corners.to_vec()).unwrap();
        assert!((region.area() - 32_500.0).abs() < 1e-9);
        let stack = Stack::new(region.clone(), 90.0).unwrap();
        let mut beyond = 0.0;
        for k in 0..500 {
            let at = stack.next_center(4.0, 1.0, draws(k, 0));
            assert!(region.contains(at), "{at}");
            beyond += f64::from(at.x > 100.0);
            assert_eq!(at, stack.next_center(4.0, 1.0, draws(k, 0)));
        }
        // As often as its share of the area.
        assert!(
            (beyond / 500.0 - 15_000.0 / 32_500.0_f64).abs() < 0.06,
            "{beyond}"
        );
        assert!(Region::new(vec![DVec2::ZERO, DVec2::X]).is_err());
        assert!(Region::new(vec![DVec2::ZERO, DVec2::X, 2.0 * DVec2::X]).is_err());
        assert!(Region::rectangle(DVec2::ZERO, DVec2::new(f64::NAN, 1.0)).is_err());
    }
}
