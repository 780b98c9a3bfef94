//! Bernstein polynomials. Their number is known to the compiler wherever it matters, so that nothing is looped over
//! or copied.

use super::patch::ORDER;

/// How many polynomials there are: `N`, or as many as said where `N` is only the most.
const fn count<const N: usize>(order: usize) -> usize {
    if N == ORDER { order } else { N }
}

/// From one degree to the next, to `degree`.
#[inline]
fn raise<const N: usize>(values: &mut [f64; N], degree: usize, s: f64) {
    let r = 1.0 - s;
    for k in 0..degree {
        let i = degree - k;
        values[i] = r * values[i] + s * values[i - 1];
    }
    values[0] *= r;
}

/// Values and first derivatives on [0, 1]; zeros beyond the order.
#[inline]
pub(super) fn first<const N: usize>(order: usize, s: f64) -> [[f64; N]; 2] {
    let order = count::<N>(order);
    let mut values = [0.0; N];
    values[0] = 1.0;
    for degree in 1..order - 1 {
        raise(&mut values, degree, s);
    }
    let slopes = differences(&values, order);
    raise(&mut values, order - 1, s);
    [values, slopes]
}

/// Values only.
#[inline]
pub(super) fn values<const N: usize>(order: usize, s: f64) -> [f64; N] {
    let order = count::<N>(order);
    let mut values = [0.0; N];
    values[0] = 1.0;
    for degree in 1..order {
        raise(&mut values, degree, s);
    }
    values
}

/// Values, first and second derivatives.
#[inline]
pub(super) fn second<const N: usize>(order: usize, s: f64) -> [[f64; N]; 3] {
    let order = count::<N>(order);
    let mut values = [0.0; N];
    values[0] = 1.0;
    if order < 3 {
        let slopes = differences(&values, order);
        raise(&mut values, 1, s);
        return [values, slopes, [0.0; N]];
    }
    for degree in 1..order - 2 {
        raise(&mut values, degree, s);
    }
    let bends = differences(&differences(&values, order - 1), order);
    raise(&mut values, order - 2, s);
    let slopes = differences(&values, order);
    raise(&mut values, order - 1, s);
    [values, slopes, bends]
}

/// The derivatives of as many polynomials, by those of one degree less or by their derivatives.
#[inline]
fn differences<const N: usize>(lower: &[f64; N], order: usize) -> [f64; N] {
    let degree = (order - 1) as f64;
    let mut slopes = [0.0; N];
    slopes[0] = -degree * lower[0];
    for i in 1..order {
        slopes[i] = degree * (lower[i - 1] - lower[i]);
    }
    slopes
}
