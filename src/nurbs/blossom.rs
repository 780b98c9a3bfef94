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
    let mut work: Net = (span - degree..=span).map(control).collect();
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
