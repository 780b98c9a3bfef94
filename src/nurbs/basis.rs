//! B-spline basis functions `N_{i,p}(u)` and their derivatives, without allocation.
//!
//! The functions here trust their arguments; [`super::KnotVector`] is what makes them trustworthy.

/// Values of the `degree + 1` basis functions that are not zero on the given span (PT97 A2.2).
pub(super) fn values(knots: &[f64], degree: usize, span: usize, u: f64, out: &mut [f64]) {
    // With the usual degrees as constants nothing is looped over.
    match degree {
        1 => values_of::<1>(&knots[span..=span + 1], u, out),
        2 => values_of::<2>(&knots[span - 1..=span + 2], u, out),
        3 => values_of::<3>(&knots[span - 2..=span + 3], u, out),
        _ => values_by(&knots[span + 1 - degree..=span + degree], degree, u, out),
    }
}

#[inline]
fn values_of<const P: usize>(knots: &[f64], u: f64, out: &mut [f64]) {
    values_by(&knots[..2 * P], P, u, &mut out[..=P]);
}

/// The same by the `2 * degree` knots around the span.
#[expect(
    clippy::inline_always,
    reason = "a degree that is a constant is of use only here"
)]
#[inline(always)]
fn values_by(knots: &[f64], degree: usize, u: f64, out: &mut [f64]) {
    out[0] = 1.0;
    for j in 1..=degree {
        let mut saved = 0.0;
        for r in 0..j {
            let right = knots[degree + r] - u;
            let left = u - knots[degree + r - j];
            // As a fraction, so that a clamped end has its one function at one to the last bit.
            let share = out[r] * (left / (right + left));
            out[r] = saved + (out[r] - share);
            saved = share;
        }
        out[j] = saved;
    }
}

/// Derivatives of order `0..=order` of the basis functions that are not zero on the given span (PT97 A2.3):
/// `out[k][j]` is the k-th derivative of `N_{span-degree+j}`. `order` must not exceed `degree`, and `degree` must be below `N`.
pub(super) fn derivatives<const N: usize>(
    knots: &[f64],
    degree: usize,
    span: usize,
    u: f64,
    order: usize,
    out: &mut [[f64; N]; N],
) {
    let p = degree;
    // Basis functions in the upper triangle (column by column), knot differences in the lower one.
    let mut table = [[0.0; N]; N];
    table[0][0] = 1.0;
    for j in 1..=p {
        let mut saved = 0.0;
        for r in 0..j {
            let right = knots[span + r + 1] - u;
            let left = u - knots[span + 1 + r - j];
            table[j][r] = right + left;
            let share = table[r][j - 1] / table[j][r];
            table[r][j] = saved + right * share;
            saved = left * share;
        }
        table[j][j] = saved;
    }
    for j in 0..=p {
        out[0][j] = table[j][p];
    }
    for r in 0..=p {
        // Two alternating rows of the coefficients a_{k,j} of PT97 Eq. 2.10.
        let mut rows = [[0.0; N]; 2];
        let (mut old, mut new) = (0, 1);
        rows[0][0] = 1.0;
        for k in 1..=order {
            let mut sum = 0.0;
            let below = p - k;
            if r >= k {
                rows[new][0] = rows[old][0] / table[below + 1][r - k];
                sum = rows[new][0] * table[r - k][below];
            }
            let first = if r + 1 >= k { 1 } else { k - r };
            let last = if r <= below + 1 { k - 1 } else { p - r };
            for j in first..=last {
                rows[new][j] = (rows[old][j] - rows[old][j - 1]) / table[below + 1][r + j - k];
                sum += rows[new][j] * table[r + j - k][below];
            }
            if r <= below {
                rows[new][k] = -rows[old][k - 1] / table[below + 1][r];
                sum += rows[new][k] * table[r][below];
            }
            out[k][r] = sum;
            std::mem::swap(&mut old, &mut new);
        }
    }
    let mut factor = p as f64;
    for (k, row) in out.iter_mut().enumerate().take(order + 1).skip(1) {
        for value in &mut row[..=p] {
            *value *= factor;
        }
        factor *= (p - k) as f64;
    }
}
