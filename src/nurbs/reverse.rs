//! Reversal and transposition: the same shape, other parameters.

use super::{Curve, KnotVector, Surface};

impl KnotVector {
    /// The knots mirrored about the middle of the domain, which stays as it is.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let (start, end) = self.domain();
        let (degree, knots) = (self.degree(), self.as_slice());
        let mut mirrored: Vec<f64> = knots
            .iter()
            .rev()
            .map(|&knot| start + (end - knot))
            .collect();
        // Rounding must not move the ends.
        mirrored[..=degree].fill(start);
        let last = mirrored.len() - 1 - degree;
        mirrored[last..].fill(end);
        Self::trusted(degree, mirrored)
    }
}

impl Curve {
    /// The same curve run backwards.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let points = self.points().iter().rev().copied().collect();
        let weights = self.weights().iter().rev().copied().collect();
        Self::trusted(self.knots().reversed(), points, weights, self.is_rational())
    }
}

impl Surface {
    /// The same surface with u and v swapped; its normal turns over.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let (nu, nv) = (self.knots_u().count(), self.knots_v().count());
        Self::trusted(
            self.knots_v().clone(),
            self.knots_u().clone(),
            transposed(self.net(), nu, nv),
            transposed(self.weights(), nu, nv),
            self.is_rational(),
        )
    }

    /// The same surface with u run backwards; its normal turns over.
    #[must_use]
    pub fn reversed_u(&self) -> Self {
        let nv = self.knots_v().count();
        Self::trusted(
            self.knots_u().reversed(),
            self.knots_v().clone(),
            self.net().chunks(nv).rev().flatten().copied().collect(),
            self.weights().chunks(nv).rev().flatten().copied().collect(),
            self.is_rational(),
        )
    }

    /// The same surface with v run backwards; its normal turns over.
    #[must_use]
    pub fn reversed_v(&self) -> Self {
        let nv = self.knots_v().count();
        Self::trusted(
            self.knots_u().clone(),
            self.knots_v().reversed(),
            self.net()
                .chunks(nv)
                .flat_map(|row| row.iter().rev())
                .copied()
                .collect(),
            self.weights()
                .chunks(nv)
                .flat_map(|row| row.iter().rev())
                .copied()
                .collect(),
            self.is_rational(),
        )
    }
}
/// A net of rows as a net of columns.
fn transposed<T: Copy>(net: &[T], rows: usize, columns: usize) -> Vec<T> {
    let mut turned = Vec::with_capacity(net.len());
    for j in 0..columns {
        turned.extend((0..rows).map(|i| net[i * columns + j]));
    }
    turned
}
