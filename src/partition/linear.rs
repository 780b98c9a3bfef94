//! Two nearly flat patches as parallelograms: in which direction they are apart, or where both are crossed by their planes' line.
//!
//! With `x` in −1..1 over each of the four ranges of parameters, `A(u, v) − B(s, t)` is nearly `r + J x`. Either the line on which that
//! vanishes passes through the box of `x`, or a product of two columns of `J` is a direction along which the parallelograms
//! are apart (what is left of their difference along it depends on the other two columns only).

use glam::DVec3;

use super::facet::Facet;

/// Pairs of columns, each with the other two.
const PAIRS: [[usize; 4]; 6] = [
    [0, 1, 2, 3],
    [2, 3, 0, 1],
    [0, 2, 1, 3],
    [0, 3, 1, 2],
    [1, 2, 0, 3],
    [1, 3, 0, 2],
];
/// The pairs that are no normals of a patch: along those two patches have been compared before.
const MIXED: std::ops::Range<usize> = 2..6;

/// What two patches do as far as they are flat.
pub(super) enum Guess {
    /// They are apart along this direction.
    Apart(DVec3),
    /// They have a common line through these parameters: with its direction and its point.
    Meet([f64; 4], DVec3, DVec3),
    /// They may be apart along a normal of one of them, or are parallel.
    Unknown,
}

/// What two patches do, a fraction of their sizes beside them included.
pub(super) fn guess(one: &Facet, other: &Facet, beside: f64) -> Guess {
    let (a, b) = (&one.patch, &other.patch);
    let ([u, v], [s, t]) = (a.middle(), b.middle());
    let half = [a.u, a.v, b.u, b.v].map(|[low, high]| 0.5 * (high - low));
    let ([p, pu, pv], [q, qs, qt]) = (*one.middle(), *other.middle());
    let gap = p - q;
    let columns = [half[0] * pu, half[1] * pv, -half[2] * qs, -half[3] * qt];
    let most = 1.0 + 2.0 * beside;
    let across = PAIRS.map(|[i, j, ..]| columns[i].cross(columns[j]));
    let offset = across.map(|w| w.dot(gap));
    let reach: [[f64; 2]; 6] = std::array::from_fn(|at| {
        let [_, _, k, l] = PAIRS[at];
        [across[at].dot(columns[k]), across[at].dot(columns[l])]
    });
    let mut best = (0.0, None);
    for at in 0..6 {
        let apart = offset[at].abs() - most * (reach[at][0].abs() + reach[at][1].abs());
        if apart > 0.0 {
            if !MIXED.contains(&at) {
                return Guess::Unknown;
            }
            let distance = apart / across[at].length();
            if distance > best.0 {
                best = (distance, Some(across[at]));
            }
        }
    }
    if let (_, Some(direction)) = best {
        return Guess::Apart(direction);
    }
    // The column without which the others span most: the line runs most along its parameter.
    let spanned = [reach[1][1], reach[1][0], reach[0][1], reach[0][0]].map(f64::abs);
    let free = (1..4).fold(
        0,
        |free, k| if spanned[k] > spanned[free] { k } else { free },
    );
    if !(spanned[free] > 0.0) {
        return Guess::Unknown;
    }
    // Every other parameter is linear in the free one, and cuts a piece out of its range.
    let mut lines = [[0.0, 1.0]; 4];
    let (mut low, mut high) = (-most, most);
    for (at, [_, _, k, l]) in PAIRS.into_iter().enumerate() {
        let (other, slope, own) = if k == free {
            (l, reach[at][0], reach[at][1])
        } else if l == free {
            (k, reach[at][1], reach[at][0])
        } else {
            continue;
        };
        let line = [-offset[at] / own, -slope / own];
        lines[other] = line;
        if line[1] != 0.0 {
            let ends = [(-most - line[0]) / line[1], (most - line[0]) / line[1]];
            low = low.max(ends[0].min(ends[1]));
            high = high.min(ends[0].max(ends[1]));
        }
    }
    let x = 0.5 * (low + high);
    let at = lines.map(|[constant, slope]| constant + slope * x);
    let middle = [u, v, s, t];
    let place = std::array::from_fn(|k| middle[k] + half[k] * at[k]);
    let along = lines[0][1] * columns[0] + lines[1][1] * columns[1];
    let point = p + at[0] * columns[0] + at[1] * columns[1];
    match along.try_normalize() {
        Some(along) => Guess::Meet(place, along, point),
        None => Guess::Unknown,
    }
}
