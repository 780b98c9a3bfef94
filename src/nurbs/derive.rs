//! From derivatives of homogeneous coordinates to derivatives of the rational curve or surface.

use super::knots::ORDER;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// Pascal's triangle as far as degrees go.
const PASCAL: [[f64; ORDER]; ORDER] = {
    let mut rows = [[0.0; ORDER]; ORDER];
    let mut n = 0;
    while n < ORDER {
        rows[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    rows
};

/// Binomial coefficient n over k.
pub(super) fn binomial(n: usize, k: usize) -> f64 {
    if let Some(row) = PASCAL.get(n) {
        return row.get(k).copied().unwrap_or(0.0);
    }
    // Only derivatives of an order far beyond any use come here.
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

/// Derivatives of A(u)/w(u) from those of the homogeneous (A, w) (PT97 Eq. 4.8, A4.2).
pub(super) fn curve_quotient(homogeneous: &[DVec4]) -> Vec<DVec3> {
    let mut result: Vec<DVec3> = Vec::with_capacity(homogeneous.len());
    for (k, derivative) in homogeneous.iter().enumerate() {
        let mut value = derivative.xyz();
        for i in 1..=k {
            value -= binomial(k, i) * homogeneous[i].w * result[k - i];
        }
        result.push(value / homogeneous[0].w);
    }
    result
}

/// Derivatives of A(u, v)/w(u, v) from those of the homogeneous (A, w) (PT97 Eq. 4.20, A4.4); row k holds the
/// derivatives k times in u and 0, 1, … times in v.
pub(super) fn surface_quotient(homogeneous: &[Vec<DVec4>]) -> Vec<Vec<DVec3>> {
    let weight = homogeneous[0][0].w;
    let mut result: Vec<Vec<DVec3>> = Vec::with_capacity(homogeneous.len());
    for (k, row) in homogeneous.iter().enumerate() {
        result.push(Vec::with_capacity(row.len()));
        for (l, derivative) in row.iter().enumerate() {
            let mut value = derivative.xyz();
            for i in 0..=k {
                for j in 0..=l {
                    if i + j > 0 {
                        let factor = binomial(k, i) * binomial(l, j) * homogeneous[i][j].w;
                        value -= factor * result[k - i][l - j];
                    }
                }
            }
            result[k].push(value / weight);
        }
    }
    result
}
