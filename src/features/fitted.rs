//! Horizons fitted to very many heights, with noise or without: the fewest control points that are near enough.
//!
//! The plane of least squares if that is near enough, else a lattice of least squares above it: with 4, 8, 16 … cells along the longer side
//! of the plan until one is; then with 5, 6 or 7 in the place of the 4 that were too few, and with half as many along one side alone.
//! In holes of the data and beyond them it is the plate that bends least.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::horizon::{Horizon, HorizonError, OVERSHOOT, best_plane};
use crate::nurbs::{Approximation, Lattice};

/// How far beyond a plan heights count, as a fraction of the plan's extents: farther than any sheet.
const REACH: f64 = 2.0 * OVERSHOOT;
/// How far the lattice reaches: its own border, where it has no curvature, is then more than a cell away from the heights, and out of
/// sight.
const MARGIN: f64 = 5.0 * OVERSHOOT;
/// Cells along the longer side of the first lattice.
const CELLS: usize = 4;
/// What bending weighs: so little that it decides only what the data do not.
const SMOOTHNESS: f64 = 1e-7;
/// Control points at most, whatever the data.
const MOST: usize = 300_000;
/// How many control points there may be for each height, and how many in any case: those around the plan have no heights, and of a grid all
/// can be met with one for each. With many more a surface meets whatever there is, and swings between.
const FOR_EACH: usize = 2;
const ANYHOW: usize = 64;
/// Of heights with noise there must be so many for a control point, or the noise is fitted.
const NOISY: usize = 4;
/// How many times its root mean square a lattice's error is at most, while it is being solved for: 1.5 seen. A lattice that is given up too early
/// costs control points and nothing else.
const SPREAD: f64 = 4.0;

/// When a surface is near enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// No height is missed by more (m).
    Within(f64),
    /// The heights have noise: the root mean square of what they are missed by is no more (m).
    Noise(f64),
}

/// How far a surface misses heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// By how much at most (m).
    pub most: f64,
    /// The height that is missed most, in the order in which they are given.
    pub worst: usize,
    /// The root mean square (m).
    pub rms: f64,
}

/// A horizon that is near enough to heights.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The horizon.
    pub horizon: Horizon,
    /// How far it misses them.
    pub misfit: Misfit,
    /// Its control points along x and along y; 2 × 2 of a plane.
    pub counts: [usize; 2],
}

impl Goal {
    fn is_met(self, misfit: &Misfit) -> bool {
        match self {
            Self::Within(tolerance) => misfit.most <= tolerance,
            Self::Noise(noise) => misfit.rms <= noise,
        }
    }

    /// Whether what is missed by so much will never be near enough, if its heights are known to so much (root mean square).
    fn is_hopeless(self, misfit: &Misfit, known: f64) -> bool {
        match self {
            Self::Within(tolerance) => misfit.most - SPREAD * known > tolerance,
            Self::Noise(noise) => misfit.rms - known > noise,
        }
    }

    /// How many control points there may be.
    fn most(self, heights: usize) -> usize {
        match self {
            Self::Within(_) => MOST.min(ANYHOW.max(FOR_EACH * heights)),
            Self::Noise(_) => MOST.min(heights / NOISY),
        }
    }

    /// The number that was asked for.
    fn number(self) -> f64 {
        match self {
            Self::Within(number) | Self::Noise(number) => number,
        }
    }
}

impl Fitted {
    /// Fits a horizon over a plan to heights within [`Fitted::reach`] of it.
    pub fn new(heights: &[DVec3], plan: [DVec2; 2], goal: Goal) -> Result<Self, HorizonError> {
        if !(goal.number() > 0.0) {
            return Err(HorizonError::Tolerance(goal.number()));
        }
        let (through, slope) = best_plane(heights).ok_or(HorizonError::NoPoints)?;
        let plane = Horizon::plane(through, slope);
        let misfit = Misfit::of(&plane, heights);
        let mut best = Self {
            horizon: plane.clone(),
            misfit,
            counts: [2, 2],
        };
        if goal.is_met(&best.misfit) {
            return Ok(best);
        }
        let residuals: Vec<DVec3> = heights
            .iter()
            .map(|p| p.xy().extend(p.z - plane.height(p.x, p.y)))
            .collect();
        let [low, high] = around(heights, beyond(plan, MARGIN));
        let mut fitting = Fitting {
            heights,
            through,
            slope,
            extent: high - low,
            goal,
            data: Approximation::new(low, high, &residuals)?,
        };
        let mut times = 1;
        while let Some(fitted) = fitting.with(fitting.cells(CELLS, times))? {
            if goal.is_met(&fitted.misfit) {
                return fitting.fewer(fitted, times);
            }
            if fitted.misfit.rms < best.misfit.rms {
                best = fitted;
            }
            times *= 2;
        }
        Err(best.missed(heights, goal))
    }

    /// The box in plan within which heights count for a plan.
    pub fn reach(plan: [DVec2; 2]) -> [DVec2; 2] {
        beyond(plan, REACH)
    }

    fn missed(&self, heights: &[DVec3], goal: Goal) -> HorizonError {
        match goal {
            Goal::Within(tolerance) => HorizonError::Unreached {
                index: self.misfit.worst,
                point: heights[self.misfit.worst],
                reached: self.misfit.most,
                tolerance,
                cells: self.counts.into_iter().max().unwrap_or(1) - 1,
            },
            Goal::Noise(noise) => HorizonError::Rough {
                noise,
                reached: self.misfit.rms,
                nodes: self.counts,
            },
        }
    }
}

impl Misfit {
    /// Of a surface to heights.
    pub fn of(horizon: &Horizon, heights: &[DVec3]) -> Self {
        let (mut most, mut worst, mut squares) = (0.0, 0, 0.0);
        for (at, point) in heights.iter().enumerate() {
            let miss = (horizon.height(point.x, point.y) - point.z).abs();
            squares += miss * miss;
            if miss > most {
                (most, worst) = (miss, at);
            }
        }
        Self {
            most,
            worst,
            rms: (squares / heights.len() as f64).sqrt(),
        }
    }
}

/// Heights while lattices are fitted to them.
struct Fitting<'a> {
    heights: &'a [DVec3],
    through: DVec3,
    slope: DVec2,
    extent: DVec2,
    goal: Goal,
    data: Approximation<'a>,
}

impl Fitting<'_> {
    /// About square cells: so many along the longer side, that many times finer.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a length over a positive fraction of the longest is between 0 and the number of cells"
    )]
    fn cells(&self, longer: usize, times: usize) -> [usize; 2] {
        let size = self.extent.max_element() / longer as f64;
        let along = |length: f64| times * ((length / size).round() as usize).max(1);
        [along(self.extent.x), along(self.extent.y)]
    }

    /// The lattice with so many cells; nothing if that is too many.
    fn with(&mut self, cells: [usize; 2]) -> Result<Option<Fitted>, HorizonError> {
        let counts = cells.map(|count| count + 1);
        if counts[0].saturating_mul(counts[1]) > self.goal.most(self.heights.len()) {
            return Ok(None);
        }
        let (heights, through, slope, goal) = (self.heights, self.through, self.slope, self.goal);
        let above = |lattice: Lattice| {
            let horizon = Horizon::above(lattice, through, slope);
            let misfit = Misfit::of(&horizon, heights);
            (horizon, misfit)
        };
        let lattice = self.data.lattice(cells, SMOOTHNESS, |lattice, known| {
            goal.is_hopeless(&above(lattice).1, known)
        })?;
        let (horizon, misfit) = above(lattice);
        Ok(Some(Fitted {
            horizon,
            misfit,
            counts,
        }))
    }

    /// One with fewer control points than one that is near enough, so many times finer than the first.
    fn fewer(mut self, found: Fitted, times: usize) -> Result<Fitted, HorizonError> {
        let mut best = found;
        // Between half of it, which is not enough, and all: of the first lattice 2 and 4, of others 4 and 8.
        let (half, times) = if times == 1 {
            (CELLS / 2, 1)
        } else {
            (CELLS, times / 2)
        };
        let (mut too_few, mut enough) = (half - usize::from(half < CELLS), 2 * half);
        while enough - too_few > 1 {
            let middle = usize::midpoint(too_few, enough);
            match self.with(self.cells(middle, times))? {
                Some(fitted) if self.goal.is_met(&fitted.misfit) => {
                    (best, enough) = (fitted, middle);
                }
                _ => too_few = middle,
            }
        }
        for axis in 0..2 {
            loop {
                let mut cells = best.counts.map(|count| count - 1);
                // Many can only be halved, few can be any number.
                if cells[axis] == 1 || cells[axis] > 2 * CELLS && cells[axis] % 2 == 1 {
                    break;
                }
                cells[axis] /= 2;
                match self.with(cells)? {
                    Some(fitted) if self.goal.is_met(&fitted.misfit) => best = fitted,
                    _ => break,
                }
            }
        }
        Ok(best)
    }
}

/// A plan and what lies around it, by a fraction of its extents.
fn beyond([low, high]: [DVec2; 2], fraction: f64) -> [DVec2; 2] {
    let margin = fraction * (high - low);
    [low - margin, high + margin]
}

/// A box that holds all heights that lie outside of it, too.
fn around(heights: &[DVec3], [low, high]: [DVec2; 2]) -> [DVec2; 2] {
    let start = (low, high);
    let (low, high) = heights
        .iter()
        .fold(start, |(low, high), p| (low.min(p.xy()), high.max(p.xy())));
    [low, high]
}

#[cfg(test)]
#[path = "fitted_tests.rs"]
mod tests;
