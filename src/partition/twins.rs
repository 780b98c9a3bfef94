//! Twins: sheets with the same knots that run beside each other, such as a channel's repeated without any draw, or one on the
//! same course. They are much nearer to each other than they bend, so no boxes or slabs keep them apart; their difference at
//! equal parameters does.
//!
//! Suppose that `A(p) = B(q)`, with `D(q) = B(q) − A(q)`. Then `A(p) − A(q) = D(q)`: a chord of A that is as short as D. Where
//! all normals of A lean less than α from n, a short chord has `|n·c| ≤ sin α |c|`; so if `|n·D| > 2 sin α |D|`, with one sign,
//! A and B do not meet there. The control vectors of D hold it in their hull, and say so for a whole patch.

use std::collections::BTreeSet;

use super::bounds::Bounds;
use super::patch::Patch;
use super::sheet::Sheet;

/// Twins are nearer to each other than this fraction of a patch.
const NEAR: f64 = 1e-3;
/// Halvings of a patch each way before it is given up.
const DEEPEST: usize = 10;
/// How much more a difference must point along the normal than chords may.
const MARGIN: f64 = 2.0;

/// Pairs of sheets, the smaller number first, that do not meet at or near equal parameters in a box.
pub(super) fn apart(sheets: &[Sheet], clip: &Bounds) -> BTreeSet<[usize; 2]> {
    let mut twins = BTreeSet::new();
    let first = |sheet: &Sheet| sheet.surface.net()[0];
    // Twins have their first control points beside each other: by the axis along which these are spread most.
    let all = Bounds::of(sheets.iter().map(first));
    let spread = (all.high - all.low).to_array();
    let axis = (0..3)
        .max_by(|a, b| spread[*a].total_cmp(&spread[*b]))
        .unwrap_or(0);
    let mut sorted: Vec<(f64, usize)> =
        sheets.iter().map(|one| first(one)[axis]).zip(0..).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (i, a) in sheets.iter().enumerate() {
        let (at, near) = (first(a)[axis], NEAR * a.bounds().extent());
        let from = sorted.partition_point(|one| one.0 < at - near);
        let beside = sorted[from..].iter().take_while(|one| one.0 <= at + near);
        for (j, b) in beside
            .map(|(_, j)| (*j, &sheets[*j]))
            .filter(|one| one.0 > i)
        {
            if a.region != b.region && are_alike(a, b) && are_apart(a, b, clip) {
                twins.insert([i, j]);
            }
        }
    }
    twins
}

/// Whether two sheets have the same knots and weights, and control points beside each other.
fn are_alike(a: &Sheet, b: &Sheet) -> bool {
    let near = NEAR * a.bounds().extent();
    let [one, other] = [a, b].map(|sheet| &sheet.surface);
    let mut pairs = one.net().iter().zip(other.net());
    one.net().len() == other.net().len()
        && one.net()[0].distance(other.net()[0]) <= near
        && pairs.all(|(p, q)| p.distance(*q) <= near)
        && one.knots_u() == other.knots_u()
        && one.knots_v() == other.knots_v()
        && one.weights() == other.weights()
}

fn are_apart(a: &Sheet, b: &Sheet, clip: &Bounds) -> bool {
    let mut pairs = a.patches().zip(b.patches());
    pairs.all(|(a, b)| patches_are_apart(&a, &b, clip, DEEPEST))
}

fn patches_are_apart(a: &Patch, b: &Patch, clip: &Bounds, left: usize) -> bool {
    let is_wanted = a.bounds.meets(clip) && b.bounds.meets(clip);
    if !is_wanted || differ_across(a, b) {
        return true;
    }
    if left == 0 {
        return false;
    }
    let along = a.longer();
    let halves = |patch: &Patch| {
        let mut halves = Vec::with_capacity(2);
        patch.halve(along, |_| true, |half| halves.push(half));
        halves
    };
    let pairs = halves(a).into_iter().zip(halves(b));
    pairs
        .into_iter()
        .all(|(a, b)| patches_are_apart(&a, &b, clip, left - 1))
}

/// Whether the difference at equal parameters points away from one of the patches all over.
fn differ_across(a: &Patch, b: &Patch) -> bool {
    let Some((normal, lean)) = a.normals() else {
        return false;
    };
    let near = NEAR * a.bounds.extent();
    let mut sign = 0.0;
    a.controls().zip(b.controls()).all(|(p, q)| {
        let difference = q - p;
        let (across, length) = (difference.dot(normal), difference.length());
        if sign == 0.0 {
            sign = across.signum();
        }
        // Written so that NaN fails too.
        sign * across > MARGIN * lean * length && length < near
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::nurbs::{KnotVector, Surface};

    /// A quarter of a parabolic trough, moved.
    fn trough(region: usize, by: DVec3) -> Sheet {
        let across = KnotVector::uniform(2, 3).unwrap();
        let along = KnotVector::uniform(1, 2).unwrap();
        let net = [(-1.0, 1.0), (0.0, -1.0), (1.0, 1.0)]
            .iter()
            .flat_map(|(x, z)| [0.0, 10.0].map(|y| DVec3::new(*x, y, *z) + by))
            .collect();
        Sheet::new(Surface::new(across, along, net).unwrap(), region).unwrap()
    }

    const ALL: Bounds = Bounds {
        low: DVec3::splat(-20.0),
        high: DVec3::splat(20.0),
    };

    #[test]
    fn a_trough_above_its_twin_is_apart_from_it_and_one_beside_it_crosses_it() {
        let twins = |by: DVec3| apart(&[trough(1, DVec3::ZERO), trough(2, by)], &ALL);
        for height in [1e-9, -1e-5, 1e-4] {
            assert!(twins(height * DVec3::Z).contains(&[0, 1]), "{height}");
        }
        // Moved across, the troughs cross along their lowest line; moved along, they are the same.
        for by in [1e-5 * DVec3::X, 1e-5 * DVec3::Y, DVec3::ZERO] {
            assert!(twins(by).is_empty(), "{by}");
        }
        // Too far from each other to be twins.
        assert!(twins(0.5 * DVec3::Z).is_empty());
    }
}
