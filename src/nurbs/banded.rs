//! Linear systems whose matrix is zero away from its diagonal.

/// An LU factorization, without pivoting, of a banded matrix. Interpolation's matrices are totally positive, for which
/// elimination without pivoting is the most accurate order (de Boor & Pinkus 1977).
pub(super) struct Banded {
    size: usize,
    reach: usize,
    rows: Vec<f64>,
}

impl Banded {
    /// A zero matrix whose entries are at most `reach` away from the diagonal.
    pub(super) fn zeros(size: usize, reach: usize) -> Self {
        Self {
            size,
            reach,
            rows: vec![0.0; size * (2 * reach + 1)],
        }
    }

    fn at(&self, row: usize, column: usize) -> usize {
        row * (2 * self.reach + 1) + column + self.reach - row
    }

    /// Sets an entry, which must be within reach of the diagonal.
    pub(super) fn set(&mut self, row: usize, column: usize, value: f64) {
        let at = self.at(row, column);
        self.rows[at] = value;
    }

    /// Adds to an entry, which must be within reach of the diagonal.
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.at(row, column);
        self.rows[at] += value;
    }

    /// Factors in place; the row whose pivot vanishes if the matrix is singular.
    pub(super) fn factor(&mut self) -> Result<(), usize> {
        for pivot in 0..self.size {
            let divisor = self.rows[self.at(pivot, pivot)];
            if divisor.abs() < 1e-14 || !divisor.is_finite() {
                return Err(pivot);
            }
            let last = (pivot + self.reach).min(self.size - 1);
            for row in pivot + 1..=last {
                let at = self.at(row, pivot);
                let factor = self.rows[at] / divisor;
                self.rows[at] = factor;
                for column in pivot + 1..=last {
                    let (to, from) = (self.at(row, column), self.at(pivot, column));
                    self.rows[to] -= factor * self.rows[from];
                }
            }
        }
        Ok(())
    }

    /// Solves for one right-hand side with the factors.
    pub(super) fn solve<T>(&self, right: &mut [T])
    where
        T: Copy + std::ops::Mul<f64, Output = T> + std::ops::SubAssign,
    {
        for row in 0..self.size {
            for column in row.saturating_sub(self.reach)..row {
                let known = right[column] * self.rows[self.at(row, column)];
                right[row] -= known;
            }
        }
        for row in (0..self.size).rev() {
            for column in row + 1..=(row + self.reach).min(self.size - 1) {
                let known = right[column] * self.rows[self.at(row, column)];
                right[row] -= known;
            }
            right[row] = right[row] * (1.0 / self.rows[self.at(row, row)]);
        }
    }
}
