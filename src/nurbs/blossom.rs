//! Blossoms: what a spline is on one span, as a symmetric function of as many arguments as its degree.
//!
//! With all arguments equal it is the spline's value; with ends of the span as arguments, one after the other replaced, it
//! is the control points of the Bézier piece there. So pieces, and parts of them, are had without inserting a knot.

use glam::DVec4;
use smallvec::SmallVec;

/// Homogeneous control points of a piece.
pub(crate) type Net = SmallVec<[DVec4; 6]>;

/// The blossom of a span (the index of the knot it begins at), by de Boor's algorithm with an argument of its own in each round.
pub(crate) fn blossom(
    knots: &[f64],
    span: usize,
    arguments: impl ExactSizeIterator<Item = f64>,
    control: impl Fn(usize) -> DVec4,
) -> DVec4 {
    let degree = arguments.len();
    let local = |k: usize| control(span - degree + k);
    // With the usual degrees as constants nothing is looped over, and nothing needs room but registers.
    match degree {
        1 => usual::<2>(&knots[span..=span + 1], arguments, local),
        3 => usual::<4>(&knots[span - 2..=span + 3], arguments, local),
        5 => usual::<6>(&knots[span - 4..=span + 5], arguments, local),
        _ => any(knots, span, arguments, local),
    }
}

/// The same by the knots around the span, twice as many as the degree, and by the control points that matter, of which `N` is the number.
#[inline]
fn usual<const N: usize>(
    knots: &[f64],
    mut arguments: impl Iterator<Item = f64>,
    control: impl Fn(usize) -> DVec4,
) -> DVec4 {
    let degree = N - 1;
    let knots = &knots[..2 * degree];
    let mut work: [DVec4; N] = std::array::from_fn(control);
    for round in 0..degree {
        let Some(t) = arguments.next() else {
            break;
        };
        for k in 0..degree - round {
            let (low, high) = (knots[round + k], knots[degree + k]);
            let part = (t - low) / (high - low);
            work[k] = work[k] * (1.0 - part) + work[k + 1] * part;
        }
    }
    work[0]
}

fn any(
    knots: &[f64],
    span: usize,
    arguments: impl ExactSizeIterator<Item = f64>,
    control: impl Fn(usize) -> DVec4,
) -> DVec4 {
    let degree = arguments.len();
    let mut work: Net = (0..=degree).map(control).collect();
    for (round, t) in arguments.enumerate() {
        for k in 0..degree - round {
            let low = knots[span - degree + 1 + round + k];
            let high = knots[span + 1 + k];
            let part = (t - low) / (high - low);
            work[k] = work[k] * (1.0 - part) + work[k + 1] * part;
        }
    }
    work[0]
}

/// The control points of the Bézier piece of a span from one place to another.
pub(crate) fn piece(
    knots: &[f64],
    degree: usize,
    span: usize,
    [from, to]: [f64; 2],
    control: impl Fn(usize) -> DVec4,
) -> Net {
    let argument = |i: usize| move |k: usize| if k < degree - i { from } else { to };
    (0..=degree)
        .map(|i| blossom(knots, span, (0..degree).map(argument(i)), &control))
        .collect()
}
