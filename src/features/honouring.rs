//! Horizons that pass through given points as well, such as tops picked in wells.
//!
//! To the horizon is added a sum of bumps, one about each point, that vanish at a reach from it: Wendland's
//! `φ(r) = (1 − r)⁴ (4 r + 1)` with r the distance over the reach, which is twice continuously differentiable and positive definite, so
//! there is one sum that takes away all that is missed. It is given at the nodes of a lattice of an eighth of the reach, so the result is a
//! horizon like any other. Between its nodes a lattice is not quite that sum; what that leaves at the points is taken away again, until
//! nothing is left.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::horizon::Horizon;
use crate::nurbs::{Lattice, LatticeError};

/// Nodes of the lattice to a reach.
const FINE: f64 = 8.0;
/// Most nodes along a side.
const MOST_NODES: f64 = 600.0;
/// What may be left at a point (m): far below what any survey knows.
pub const LEFT: f64 = 1e-6;
/// Rounds: each leaves some hundredths of what was left before.
const ROUNDS: usize = 40;

/// Why a horizon cannot pass through its points.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HonouringError {
    /// The lattice would have too many nodes.
    #[error(
        "a reach of {reach} m is too short for a domain of {size} m; give {least:.0} m or more"
    )]
    Reach {
        /// The reach (m).
        reach: f64,
        /// The longer side of what is covered (m).
        size: f64,
        /// The least reach (m).
        least: f64,
    },
    /// Two points are over each other, or nearly so.
    #[error(
        "two points almost over each other, {one} and {other}, want different heights; leave one of them out"
    )]
    Contradiction {
        /// One of them.
        one: DVec3,
        /// The other.
        other: DVec3,
    },
    /// The rounds do not come to an end.
    #[error(
        "after {ROUNDS} rounds {left} m are left at a point; give a longer reach, or leave out points that are very near to each other"
    )]
    Unreached {
        /// What is left (m).
        left: f64,
    },
    /// There is no lattice.
    #[error(transparent)]
    Lattice(#[from] LatticeError),
}

/// The horizon that passes through points, too, and is unchanged a reach (m) away from all of them; over a plan.
pub fn honouring(
    horizon: &Horizon,
    points: &[DVec3],
    reach: f64,
    [low, high]: [DVec2; 2],
) -> Result<Horizon, HonouringError> {
    let missed = |horizon: &Horizon| -> Vec<f64> {
        points
            .iter()
            .map(|p| p.z - horizon.height(p.x, p.y))
            .collect()
    };
    let most = |left: &[f64]| left.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    let mut left = missed(horizon);
    if most(&left) <= LEFT {
        return Ok(horizon.clone());
    }
    // Sheets reach a little beyond the plan.
    let margin = 0.1 * (high - low);
    let (low, high) = (low - margin, high + margin);
    let size = high - low;
    let counts = (size / (reach / FINE)).ceil() + 1.0;
    if counts.max_element() > MOST_NODES {
        let size = size.max_element();
        let least = size * FINE / (MOST_NODES - 1.0);
        return Err(HonouringError::Reach { reach, size, least });
    }
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 2 and the most that may be"
    )]
    let counts = [(counts.x as usize).max(4), (counts.y as usize).max(4)];
    let kernel = Kernel::new(points, reach)?;
    let step = size / DVec2::new((counts[0] - 1) as f64, (counts[1] - 1) as f64);
    let mut corrected = horizon.clone();
    for _ in 0..ROUNDS {
        let weights = kernel.weights(&left);
        let mut heights = vec![0.0; counts[0] * counts[1]];
        for (at, height) in heights.iter_mut().enumerate() {
            let node = DVec2::new((at / counts[1]) as f64, (at % counts[1]) as f64);
            *height = kernel.sum(&weights, low + step * node);
        }
        let lattice = Lattice::interpolated(low, high, counts, &heights)?;
        corrected = corrected.plus(&Horizon::above(lattice, DVec3::ZERO, DVec2::ZERO));
        left = missed(&corrected);
        if most(&left) <= LEFT {
            return Ok(corrected);
        }
    }
    Err(HonouringError::Unreached { left: most(&left) })
}

/// The bumps about points, and their values at each other's middles, factored (Cholesky).
struct Kernel {
    middles: Vec<DVec2>,
    reach: f64,
    /// Rows of the lower triangle.
    factor: Vec<Vec<f64>>,
}

/// A pivot below this says that two points are at one place.
const SINGULAR: f64 = 1e-10;

impl Kernel {
    fn new(points: &[DVec3], reach: f64) -> Result<Self, HonouringError> {
        let middles: Vec<DVec2> = points.iter().map(|p| p.xy()).collect();
        let mut factor: Vec<Vec<f64>> = Vec::with_capacity(middles.len());
        for (i, own) in middles.iter().enumerate() {
            let mut row = Vec::with_capacity(i + 1);
            for j in 0..=i {
                let known: f64 = if i == j {
                    0.0
                } else {
                    dot(&row, &factor[j][..j])
                };
                if i == j {
                    let pivot = 1.0 - dot(&row, &row);
                    if !(pivot > SINGULAR) {
                        return Err(contradiction(points, i));
                    }
                    row.push(pivot.sqrt());
                } else {
                    let value = bump(own.distance(middles[j]) / reach) - known;
                    row.push(value / factor[j][j]);
                }
            }
            factor.push(row);
        }
        Ok(Self {
            middles,
            reach,
            factor,
        })
    }

    /// The weights with which the bumps have these values at their middles.
    fn weights(&self, values: &[f64]) -> Vec<f64> {
        let mut weights = values.to_vec();
        for i in 0..weights.len() {
            let known = dot(&weights[..i], &self.factor[i][..i]);
            weights[i] = (weights[i] - known) / self.factor[i][i];
        }
        for i in (0..weights.len()).rev() {
            let known: f64 = (i + 1..weights.len())
                .map(|k| self.factor[k][i] * weights[k])
                .sum();
            weights[i] = (weights[i] - known) / self.factor[i][i];
        }
        weights
    }

    fn sum(&self, weights: &[f64], at: DVec2) -> f64 {
        let bumps = self
            .middles
            .iter()
            .map(|middle| bump(at.distance(*middle) / self.reach));
        bumps.zip(weights).map(|(bump, weight)| bump * weight).sum()
    }
}

fn bump(r: f64) -> f64 {
    let rest = (1.0 - r).max(0.0);
    rest.powi(4) * (4.0 * r + 1.0)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The point before one that is nearest to it.
fn contradiction(points: &[DVec3], at: usize) -> HonouringError {
    let one = points[at];
    let apart = |p: &&DVec3| p.xy().distance(one.xy());
    let nearest = points[..at]
        .iter()
        .min_by(|a, b| apart(a).total_cmp(&apart(b)));
    HonouringError::Contradiction {
        one: nearest.copied().unwrap_or(one),
        other: one,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    const PLAN: [DVec2; 2] = [DVec2::ZERO, DVec2::new(4000.0, 3000.0)];

    fn tops() -> Vec<DVec3> {
        vec![
            DVec3::new(500.0, 600.0, -98.0),
            DVec3::new(700.0, 650.0, -103.0),
            DVec3::new(1900.0, 2200.0, -91.5),
            DVec3::new(3500.0, 400.0, -120.0),
        ]
    }

    #[test]
    fn a_horizon_passes_through_its_tops_and_is_unchanged_a_reach_away() {
        let dipping = Horizon::dipping(DVec3::new(0.0, 0.0, -90.0), 0.01, 1.0).unwrap();
        let honouring = honouring(&dipping, &tops(), 500.0, PLAN).unwrap();
        for top in tops() {
            assert!((honouring.height(top.x, top.y) - top.z).abs() <= LEFT);
        }
        let mut far = 0;
        for k in 0..2000 {
            let part = |ratio: f64| (f64::from(k) * ratio).fract();
            let at = PLAN[1] * DVec2::new(part(0.754_877_666), part(0.569_840_291));
            let nearest = tops()
                .iter()
                .map(|top| top.xy().distance(at))
                .fold(f64::INFINITY, f64::min);
            // The lattice's spline dies out within some of its cells.
            if nearest > 900.0 {
                far += 1;
                let change = honouring.height(at.x, at.y) - dipping.height(at.x, at.y);
                assert!(change.abs() < 1e-3, "{at}: {change}");
            }
        }
        assert!(far > 300);
    }

    #[test]
    fn one_top_raises_the_horizon_by_the_bump_about_it() {
        let level = Horizon::flat(-100.0).unwrap();
        let top = DVec3::new(2000.0, 1500.0, -90.0);
        let honouring = honouring(&level, &[top], 800.0, PLAN).unwrap();
        for k in 0..=16 {
            let r = f64::from(k) / 16.0;
            let expected = -100.0 + 10.0 * (1.0 - r).powi(4) * (4.0 * r + 1.0);
            let height = honouring.height(2000.0 + 800.0 * r, 1500.0);
            assert!((height - expected).abs() < 0.02, "{r}: {height} {expected}");
        }
    }

    #[test]
    fn tops_over_each_other_and_reaches_that_are_too_short_are_refused() {
        let level = Horizon::flat(-100.0).unwrap();
        let twice = [DVec3::new(10.0, 10.0, -90.0), DVec3::new(10.0, 10.0, -95.0)];
        let contradiction = honouring(&level, &twice, 500.0, PLAN);
        assert!(matches!(
            contradiction,
            Err(HonouringError::Contradiction { .. })
        ));
        assert!(matches!(
            honouring(&level, &tops(), 10.0, PLAN),
            Err(HonouringError::Reach { .. })
        ));
    }
}
