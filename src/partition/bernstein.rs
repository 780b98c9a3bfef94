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

#[cfg(test)]
mod tests {
    use super::*;

    /// `C(degree, i) sⁱ (1 − s)ᵈ⁻ⁱ`.
    fn closed(order: usize, i: usize, s: f64) -> f64 {
        let degree = order - 1;
        let binomial = (0..i).fold(1.0, |c, k| c * (degree - k) as f64 / (k + 1) as f64);
        let power = |base: f64, times: usize| (0..times).fold(1.0, |product, _| product * base);
        binomial * power(s, i) * power(1.0 - s, degree - i)
    }

    fn check<const N: usize>(order: usize) {
        let (s, h) = (0.3, 1e-4);
        let [values, slopes, bends] = second::<N>(order, s);
        assert_eq!([values, slopes], first::<N>(order, s));
        assert_eq!(values, super::values::<N>(order, s));
        for i in 0..order {
            let [before, at, after] = [s - h, s, s + h].map(|s| closed(order, i, s));
            // Rounding, and differences of step h: errors of order h², and of 1e-16 over h and h².
            assert!((values[i] - at).abs() < 1e-15);
            assert!((slopes[i] - (after - before) / (2.0 * h)).abs() < 1e-5);
            assert!((bends[i] - (after - 2.0 * at + before) / (h * h)).abs() < 1e-4);
        }
        assert!(values[order..].iter().all(|value| *value == 0.0));
    }

    #[test]
    fn all_degrees_agree_with_binomials_and_their_differences_whether_constant_or_not() {
        check::<2>(2);
        check::<4>(4);
        for order in 2..=ORDER {
            check::<ORDER>(order);
        }
    }
}
