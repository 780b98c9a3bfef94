//! Heights over the plan that a formula tells, as horizons: interpolated at the nodes of a lattice that is fine enough for a tolerance.
//!
//! Halfway between nodes, along x and along y, a spline is farthest from what it interpolates: there it is compared, and where it is too far off
//! along one of them, nodes get twice as many along that one.

use glam::DVec2;

use super::horizon::{Horizon, HorizonError, OVERSHOOT};

/// Cells along each side of the first lattice.
const CELLS: usize = 8;
/// Nodes at most.
const MOST: usize = 300_000;
/// How far the lattice reaches beyond the plan, as a fraction of its extents: a little farther than sheets, and so that nodes are on no round numbers.
const BEYOND: [f64; 2] = [1.237 * OVERSHOOT, 1.291 * OVERSHOOT];

/// Why heights are no horizon.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReliefError {
    /// A place has no height.
    #[error("at x = {x:.3}, y = {y:.3} there is no single height")]
    NoHeight {
        /// Easting (m).
        x: f64,
        /// Northing (m).
        y: f64,
    },
    /// The tolerance is none.
    #[error("the tolerance is {0} m: it must be above 0")]
    Tolerance(f64),
    /// The finest lattice is not within the tolerance.
    #[error(
        "heights on {} × {} nodes are {reached:.2e} m off, more than the tolerance of {tolerance} m; give a greater one",
        nodes[0], nodes[1]
    )]
    Unreached {
        /// How far it is off (m).
        reached: f64,
        /// The tolerance (m).
        tolerance: f64,
        /// Nodes along x and y.
        nodes: [usize; 2],
    },
    /// The heights make no horizon.
    #[error(transparent)]
    Horizon(#[from] HorizonError),
}

/// Heights at the nodes of a grid.
struct Grid {
    corners: [DVec2; 2],
    cells: [usize; 2],
}

impl Grid {
    fn place(&self, i: f64, j: f64) -> DVec2 {
        let [low, high] = self.corners;
        let part = DVec2::new(i / self.cells[0] as f64, j / self.cells[1] as f64);
        low + (high - low) * part
    }
}

/// The horizon that is within a tolerance (m) of heights over a plan, with how far it is off halfway between its nodes (m).
pub fn horizon(
    height: &dyn Fn(DVec2) -> Option<f64>,
    [low, high]: [DVec2; 2],
    tolerance: f64,
) -> Result<(Horizon, f64), ReliefError> {
    if !(tolerance > 0.0) {
        return Err(ReliefError::Tolerance(tolerance));
    }
    let told = |at: DVec2| {
        let none = ReliefError::NoHeight { x: at.x, y: at.y };
        height(at).filter(|height| height.is_finite()).ok_or(none)
    };
    let size = high - low;
    let mut grid = Grid {
        corners: [low - BEYOND[0] * size, high + BEYOND[1] * size],
        cells: [CELLS, CELLS],
    };
    loop {
        let [nx, ny] = grid.cells;
        let row = |j: usize| -> Result<Vec<f64>, ReliefError> {
            (0..=nx)
                .map(|i| told(grid.place(i as f64, j as f64)))
                .collect()
        };
        let rows = (0..=ny).map(row).collect::<Result<Vec<_>, _>>()?;
        let [from, to] = grid.corners;
        let horizon = Horizon::grid([from.x, to.x], [from.y, to.y], &rows)?;
        let mut worst = [0.0_f64; 2];
        for j in 0..=2 * ny {
            for i in 0..=2 * nx {
                // Odd along one of them.
                let axis = match (i % 2, j % 2) {
                    (1, 0) => 0,
                    (0, 1) => 1,
                    _ => continue,
                };
                let at = grid.place(0.5 * i as f64, 0.5 * j as f64);
                let miss = (horizon.height(at.x, at.y) - told(at)?).abs();
                worst[axis] = worst[axis].max(miss);
            }
        }
        let reached = worst[0].max(worst[1]);
        if reached <= tolerance {
            return Ok((horizon, reached));
        }
        for (cells, worst) in grid.cells.iter_mut().zip(worst) {
            if worst > 0.5 * tolerance {
                *cells *= 2;
            }
        }
        if (grid.cells[0] + 1) * (grid.cells[1] + 1) > MOST {
            return Err(ReliefError::Unreached {
                reached,
                tolerance,
                nodes: [nx + 1, ny + 1],
            });
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    #[test]
    fn heights_that_bend_along_one_axis_get_nodes_along_that_one() {
        let plan = [DVec2::new(100.0, -50.0), DVec2::new(900.0, 350.0)];
        let height = |at: DVec2| Some(20.0 * (at.x / 60.0).sin() + 0.1 * at.y);
        let (horizon, reached) = super::horizon(&height, plan, 0.01).unwrap();
        assert!(reached <= 0.01 && reached > 1e-6);
        let counts = horizon.lattices()[0].counts();
        assert!(
            counts[0] > 8 * CELLS && counts[1] == CELLS + 1,
            "{counts:?}"
        );
        for k in 0..500 {
            let part = |ratio: f64| (f64::from(k) * ratio).fract();
            let at = plan[0] + (plan[1] - plan[0]) * DVec2::new(part(0.754_877), part(0.569_84));
            assert!((horizon.height(at.x, at.y) - height(at).unwrap()).abs() < 0.012);
        }
        let holes = |at: DVec2| (at.x < 500.0).then_some(0.0);
        let error = super::horizon(&holes, plan, 0.01).unwrap_err();
        assert!(matches!(error, ReliefError::NoHeight { x, .. } if x >= 500.0));
        let cliff = |at: DVec2| Some(if at.x < 500.0 { 0.0 } else { 9.0 });
        let error = super::horizon(&cliff, plan, 0.01).unwrap_err();
        assert!(matches!(error, ReliefError::Unreached { .. }));
    }
}
