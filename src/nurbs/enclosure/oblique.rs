//! Rays in any direction: patches are halved where the ray passes until what is left is close to linear.

use super::projection::{Projection, Verdict};
use super::shell::Shell;
use super::tally::{Outcome, Tally};
use crate::nurbs::bezier::{Along, Patch, Region, halves};
use glam::{DMat3, DVec2, DVec3, Vec3Swizzles};

/// Directions that no straight channel, clinoform or well is likely to have; steep ones first, since they meet fewer
/// patches of a flat shell. Not normalized.
pub(super) const DIRECTIONS: [[f64; 3]; 12] = [
    [0.417_022, 0.233_517, 1.0],
    [-0.302_333, 0.546_756, 1.0],
    [0.186_260, -0.645_561, -1.0],
    [-0.596_767, -0.338_817, -1.0],
    [0.719_195, 0.404_452, 0.5],
    [-0.478_117, 0.858_612, 0.5],
    [0.670_468, -0.717_305, -0.5],
    [-0.840_739, -0.492_348, 0.5],
    [0.998_861, 0.344_561, 0.1],
    [-0.313_424, 0.987_389, 0.1],
    [0.558_690, -0.740_397, 0.1],
    [-0.969_262, -0.519_967, -0.1],
];

/// More pieces of one patch than this mean that the ray runs along it.
const MOST_PIECES: usize = 2000;

/// The crossings of the ray from p.
pub(super) fn cast(shell: &Shell, p: DVec3, direction: DVec3) -> Outcome {
    let along = direction.normalize();
    let (x, y) = along.any_orthonormal_pair();
    let turn = DMat3::from_cols(x, y, along).transpose();
    let mut tally = Tally::default();
    for (k, piece) in shell.patches.iter().enumerate() {
        if meets_box(
            p,
            along,
            piece.low - shell.tolerance,
            piece.high + shell.tolerance,
        ) {
            let seen = piece.patch.mapped(|x| turn * (x - p));
            cross(shell, k, seen, &mut tally);
        }
    }
    tally.outcome()
}

/// Counts the crossings of one patch, whose coordinates are such that the ray is the positive z axis.
fn cross(shell: &Shell, k: usize, seen: Patch, tally: &mut Tally) {
    let mut stack = vec![(seen, Region::UNIT)];
    let mut pieces = 0;
    while let Some((patch, region)) = stack.pop() {
        let (low, high) = patch.hull();
        let (low, high) = (low - shell.tolerance, high + shell.tolerance);
        if low.x > 0.0 || high.x < 0.0 || low.y > 0.0 || high.y < 0.0 || high.z < 0.0 {
            continue;
        }
        if let Some(projection) = Projection::new(&patch, shell.tolerance) {
            cross_regular(shell, k, &patch, &region, &projection, tally);
            continue;
        }
        pieces += 1;
        let (in_u, in_v) = patch.lengths(|leg| leg.xy().length());
        if pieces > MOST_PIECES {
            tally.doubt();
            return;
        }
        if in_u.max(in_v) <= 32.0 * shell.tolerance {
            tally.doubt();
            continue;
        }
        let along = if in_u >= in_v { Along::U } else { Along::V };
        stack.extend(halves(&patch, &region, along));
    }
}

/// Counts the crossing of a part that is close to linear.
fn cross_regular(
    shell: &Shell,
    k: usize,
    patch: &Patch,
    region: &Region,
    projection: &Projection,
    tally: &mut Tally,
) {
    let piece = &shell.patches[k];
    let guess = match projection.judge(DVec3::ZERO, shell.width) {
        Verdict::Miss => return,
        Verdict::Crosses(_) if piece.outline.is_none() => return tally.cross(),
        Verdict::Crosses(guess) | Verdict::Near(guess) => guess,
    };
    let jet = |s: DVec2| patch.jet(s.x, s.y);
    if let Some(crossing) = projection.locate(DVec2::ZERO, guess, shell.tolerance, jet) {
        let outline = piece.outline.as_deref();
        tally.meet(outline, piece, region, crossing, [0.0, shell.width]);
    }
}

/// Whether the ray meets the box.
fn meets_box(p: DVec3, direction: DVec3, low: DVec3, high: DVec3) -> bool {
    let (to_low, to_high) = ((low - p) / direction, (high - p) / direction);
    let enter = to_low.min(to_high).max_element();
    let leave = to_low.max(to_high).min_element();
    enter <= leave && leave >= 0.0
}
