//! What the comparison of grids with surfaces (`examples/grid_or_surface`) counts: groups of cells that share faces.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "../examples/grid_or_surface/cells.rs"]
mod cells;

use cells::{Connectivity, groups};
use clinothem::model::Stream;

/// Sizes of groups, the smallest first, found by walking from cell to cell.
fn walked(counts: [usize; 3], net: &dyn Fn([usize; 3]) -> bool) -> Vec<u64> {
    let [nx, ny, nz] = counts;
    let number = |[i, j, k]: [usize; 3]| i + nx * (j + ny * k);
    let mut seen = vec![false; nx * ny * nz];
    let mut sizes = Vec::new();
    for start in 0..seen.len() {
        let mut waiting = vec![[start % nx, start / nx % ny, start / nx / ny]];
        let mut size = 0;
        while let Some(cell) = waiting.pop() {
            if seen[number(cell)] || !net(cell) {
                continue;
            }
            seen[number(cell)] = true;
            size += 1;
            for axis in 0..3 {
                if cell[axis] > 0 {
                    let mut next = cell;
                    next[axis] -= 1;
                    waiting.push(next);
                }
                if cell[axis] + 1 < counts[axis] {
                    let mut next = cell;
                    next[axis] += 1;
                    waiting.push(next);
                }
            }
        }
        if size > 0 {
            sizes.push(size);
        }
    }
    sizes.sort_unstable();
    sizes
}

#[test]
fn groups_are_those_that_walking_from_cell_to_cell_finds() {
    let shapes = [[9, 8, 7], [1, 30, 4], [25, 1, 1], [12, 12, 1], [6, 5, 20]];
    for (number, counts) in (0..).zip(shapes) {
        // Around a third of all cells groups are largest and most winding.
        for share in [0.1, 0.3, 0.35, 0.6, 1.0] {
            let [nx, ny, nz] = counts;
            let mut stream = Stream::new(3, "test", "cells", "net", number);
            let net: Vec<bool> = (0..nx * ny * nz).map(|_| stream.unit() < share).collect();
            let is_net = |[i, j, k]: [usize; 3]| net[i + nx * (j + ny * k)];
            let mut found = groups(counts, is_net);
            found.sort_unstable();
            assert_eq!(found, walked(counts, &is_net), "{counts:?} {share}");
        }
    }
}

#[test]
fn cells_that_share_an_edge_alone_are_apart_and_arms_that_meet_later_are_one() {
    let diagonal = |[i, j, _]: [usize; 3]| i == j;
    assert_eq!(groups([3, 3, 1], diagonal), [1, 1, 1]);
    // Two arms that meet in the last layer.
    let arms = |[i, _, k]: [usize; 3]| i != 1 || k == 2;
    assert_eq!(groups([3, 1, 3], arms), [7]);
}

#[test]
fn groups_of_three_to_one_are_connected_with_a_chance_of_five_eighths() {
    let found = Connectivity::of(&[10.0, 30.0], 200.0);
    assert_eq!(found.bodies, 2);
    assert_eq!(found.net_to_gross, 0.2);
    assert_eq!(found.largest_share, 0.75);
    assert_eq!(found.gamma, 0.625);
    assert_eq!(Connectivity::of(&[], 200.0).gamma, 0.0);
}
