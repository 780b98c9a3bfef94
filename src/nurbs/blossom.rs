//! Blossoms: what a spline is on one span, as a symmetric function of as many arguments as its degree.
//!
//! With all arguments equal it is the spline's value; with ends of the span as arguments, one after the other replaced, it
//! is the control points of the Bézier piece there. So pieces, and parts of them, are had without inserting a knot.

use std::array::from_fn;

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
    let own = &knots[span + 1 - degree..=span + degree];
    let local = |k: usize| control(span - degree + k);
    // With the usual degrees as constants nothing is looped over, and nothing needs room but registers.
    match degree {
        1 => reduced(own, arguments, &mut from_fn::<_, 2, _>(local)),
        3 => reduced(own, arguments, &mut from_fn::<_, 4, _>(local)),
        5 => reduced(own, arguments, &mut from_fn::<_, 6, _>(local)),
        _ => reduced(
            own,
            arguments,
            &mut (0..=degree).map(local).collect::<Net>(),
        ),
    }
}

/// The same by the knots around the span, twice as many as the degree, and by the control points that matter.
#[expect(
    clippy::inline_always,
    reason = "a degree that is a constant is of use only here"
)]
#[inline(always)]
fn reduced(knots: &[f64], arguments: impl Iterator<Item = f64>, work: &mut [DVec4]) -> DVec4 {
    let degree = work.len() - 1;
    let knots = &knots[..2 * degree];
    for (round, t) in arguments.take(degree).enumerate() {
        for k in 0..degree - round {
            let (low, high) = (knots[round + k], knots[degree + k]);
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
