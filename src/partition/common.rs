//! The common point of three sheets, by Newton's method.

use glam::{DVec2, DVec3};

use super::heights::Heights;
use super::pair::Tolerances;
use super::sheet::Sheet;
use super::solve::solve;

/// Most steps.
const STEPS: usize = 12;

/// Three sheets with parameters near a point that they have in common.
pub(super) struct Common<'a> {
    pub(super) sheets: [&'a Sheet; 3],
    /// (u, v) on each.
    pub(super) q: [f64; 6],
}

impl Common<'_> {
    /// Moves the parameters to the common point, and returns it; `None` if that does not converge. Of sheets that are heights
    /// over one plan the difference of heights counts, not their distance in space: nearly parallel ones have as good a
    /// common point as others.
    pub(super) fn find(&mut self, tolerances: &Tolerances) -> Option<DVec3> {
        let heights: Vec<usize> = (0..3).filter(|k| self.sheets[*k].plan.is_some()).collect();
        match heights[..] {
            [_, _, _] => self.of_heights(tolerances),
            [a, b] => self.of_two_heights([a, b, 3 - a - b], tolerances),
            _ => self.in_space(tolerances),
        }
    }

    /// Two differences over the plan vanish.
    fn of_heights(&mut self, tolerances: &Tolerances) -> Option<DVec3> {
        let pairs = [1, 2].map(|other| Heights::of([self.sheets[0], self.sheets[other]]));
        let [Some(first), Some(second)] = pairs else {
            return None;
        };
        let own = [self.q[0], self.q[1], 0.0, 0.0];
        let mut at = first.place(&own);
        for _ in 0..STEPS {
            let rows = [first, second].map(|pair| {
                let (d, slope) = pair.difference(at);
                let size = slope.length();
                (slope / size, -d / size, pair.noise() / size)
            });
            let step = solve(rows.map(|row| row.0.to_array()), rows.map(|row| row.1))?;
            let step = DVec2::from_array(step);
            at += step;
            // Curves that cross at a small angle have a point as good as that.
            let angle = rows[0].0.perp_dot(rows[1].0).abs();
            let rounding = 4.0 * rows.iter().fold(0.0, |most: f64, row| most.max(row.2)) / angle;
            if step.length() < tolerances.step.max(rounding) {
                let [a, b] = [first, second].map(|pair| pair.parameters(at));
                self.q = [a[0], a[1], a[2], a[3], b[2], b[3]];
                return Some(at.extend(first.first(0, at).0));
            }
        }
        None
    }

    /// The difference of two heights vanishes where a third sheet meets the first.
    fn of_two_heights(
        &mut self,
        [a, b, third]: [usize; 3],
        tolerances: &Tolerances,
    ) -> Option<DVec3> {
        let pair = Heights::of([self.sheets[a], self.sheets[b]])?;
        let own = [self.q[2 * a], self.q[2 * a + 1], 0.0, 0.0];
        let mut at = pair.place(&own);
        let mut on = DVec2::new(self.q[2 * third], self.q[2 * third + 1]);
        for _ in 0..STEPS {
            let (d, across) = pair.difference(at);
            let size = across.length();
            let (z, slope) = pair.first(0, at);
            let (p, pu, pv) = self.sheets[third].first_jet(on.x, on.y);
            let gap = p - at.extend(z);
            let matrix = [
                [-1.0, 0.0, pu.x, pv.x],
                [0.0, -1.0, pu.y, pv.y],
                [-slope.x, -slope.y, pu.z, pv.z],
                [across.x / size, across.y / size, 0.0, 0.0],
            ];
            let step = solve(matrix, [-gap.x, -gap.y, -gap.z, -d / size])?;
            at += DVec2::new(step[0], step[1]);
            on += DVec2::new(step[2], step[3]);
            let moved = DVec2::new(step[0], step[1]).length();
            if moved < tolerances.step.max(4.0 * pair.noise() / size) {
                let q = pair.parameters(at);
                (self.q[2 * a], self.q[2 * a + 1]) = (q[0], q[1]);
                (self.q[2 * b], self.q[2 * b + 1]) = (q[2], q[3]);
                (self.q[2 * third], self.q[2 * third + 1]) = (on.x, on.y);
                return Some(at.extend(pair.first(0, at).0));
            }
        }
        None
    }

    /// The first sheet's gaps to both others vanish.
    fn in_space(&mut self, tolerances: &Tolerances) -> Option<DVec3> {
        for _ in 0..STEPS {
            let q = self.q;
            let jets = [0, 1, 2].map(|k| self.sheets[k].first_jet(q[2 * k], q[2 * k + 1]));
            let (matrix, right) = equations(&jets);
            let step = solve(matrix, right)?;
            for (own, step) in self.q.iter_mut().zip(step) {
                *own += step;
            }
            let residual: f64 = right.iter().map(|r| r.abs()).sum();
            let moved = (jets[0].1 * step[0] + jets[0].2 * step[1]).length();
            if residual < 2.0 * tolerances.residual && moved < tolerances.step {
                return Some(self.sheets[0].point(self.q[0], self.q[1]));
            }
        }
        None
    }
}

/// Newton's system for the common point of three sheets: the first one's gaps to both others.
fn equations(jets: &[(DVec3, DVec3, DVec3); 3]) -> ([[f64; 6]; 6], [f64; 6]) {
    let mut matrix = [[0.0; 6]; 6];
    let mut right = [0.0; 6];
    for (block, other) in [1, 2].into_iter().enumerate() {
        let gap = jets[0].0 - jets[other].0;
        for i in 0..3 {
            let row = 3 * block + i;
            matrix[row][0] = jets[0].1[i];
            matrix[row][1] = jets[0].2[i];
            matrix[row][2 * other] = -jets[other].1[i];
            matrix[row][2 * other + 1] = -jets[other].2[i];
            right[row] = -gap[i];
        }
    }
    (matrix, right)
}
