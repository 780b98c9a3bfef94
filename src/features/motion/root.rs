//! Roots of equations in one unknown that is held between two places.

/// How often a bracket is narrowed, at most: bisection alone ends after fewer.
const STEPS: usize = 200;

/// A place between `low` and `high` at which `f` is zero, to the last bits; `f` has different signs there (or is zero).
///
/// Newton's method with slopes by secants, inside a bracket: where a step would leave it, or does not halve it, the bracket is halved.
/// Where the signs are not different, the end with the smaller value.
pub(super) fn root(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let (mut a, mut b) = (low, high);
    let (mut fa, mut fb) = (f(a), f(b));
    if fa == 0.0 {
        return a;
    }
    if fb == 0.0 {
        return b;
    }
    if fa.signum() == fb.signum() {
        return if fa.abs() <= fb.abs() { a } else { b };
    }
    // The best place so far and the one before it: the secant.
    let (mut best, mut f_best) = if fa.abs() < fb.abs() {
        (a, fa)
    } else {
        (b, fb)
    };
    let (mut last, mut f_last) = if fa.abs() < fb.abs() {
        (b, fb)
    } else {
        (a, fa)
    };
    let mut width = (b - a).abs();
    for _ in 0..STEPS {
        let least = 2.0 * f64::EPSILON * best.abs().max(f64::MIN_POSITIVE);
        if (b - a).abs() <= least {
            break;
        }
        let secant = best - f_best * (best - last) / (f_best - f_last);
        let middle = f64::midpoint(a, b);
        let (inner, outer) = (a.min(b), a.max(b));
        let is_slow = (b - a).abs() > 0.5 * width;
        width = (b - a).abs();
        let next = if secant.is_finite() && secant > inner && secant < outer && !is_slow {
            secant
        } else {
            middle
        };
        let f_next = f(next);
        (last, f_last) = (best, f_best);
        if f_next == 0.0 || (next - best).abs() <= 0.25 * least {
            return next;
        }
        (best, f_best) = (next, f_next);
        if f_next.signum() == fa.signum() {
            (a, fa) = (next, f_next);
        } else {
            (b, fb) = (next, f_next);
        }
    }
    if fa.abs() < fb.abs() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn roots_are_found_to_the_last_bits() {
        type Case = (fn(f64) -> f64, f64, f64, f64);
        let cases: [Case; 4] = [
            (|x| x * x - 2.0, 0.0, 2.0, 2.0_f64.sqrt()),
            (|x| x.cos() - x, -3.0, 5.0, 0.739_085_133_215_160_6),
            // Flat at first, then steep.
            (|x| x.powi(9) - 1e-9, -1.0, 1.0, 0.1),
            (|x| (x - 0.3).cbrt(), -10.0, 11.0, 0.3),
        ];
        for (f, low, high, wanted) in cases {
            let found = root(f, low, high);
            assert!((found - wanted).abs() < 1e-13, "{found} {wanted}");
        }
    }

    #[test]
    fn an_end_that_is_a_root_is_found() {
        assert_eq!(root(|x| x, 0.0, 1.0), 0.0);
        assert_eq!(root(|x| x - 1.0, 0.0, 1.0), 1.0);
    }
}
