//! How thin a bed gets between the nodes at which its thickness is known.
//!
//! On each cell a spline lies between its Bernstein coefficients. Cells on which all of these are thick enough are so
//! everywhere; others are quartered until a place is found that is not, or all parts are.

use glam::DVec2;

use super::horizon::Horizon;
use super::pinch_out::{Absence, Nodes};

/// How often a cell is quartered; what then is still undecided misses the thickness that is asked for by next to nothing.
const QUARTERINGS: u32 = 6;

/// The Bernstein coefficients of a bicubic function: along x, then along y.
type Cell = [[f64; 4]; 4];

/// Where a bed is thinner between nodes than at them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thinner {
    /// The least thickness that was found (m); below 0 where the surfaces cross.
    pub thickness: f64,
    /// Lower corner of a box in plan that holds the cells.
    pub low: DVec2,
    /// Upper corner.
    pub high: DVec2,
    /// How many there are.
    pub cells: usize,
}

/// The cells that meet a plan and have a bed thicker than `least` at all four nodes, but not everywhere between them. `None`
/// if there are none, or if the thickness is no spline on these nodes.
pub fn thinner(
    thickness: &Horizon,
    nodes: &Nodes,
    absence: &Absence,
    least: f64,
    [low, high]: [DVec2; 2],
) -> Option<Thinner> {
    let [nx, ny] = nodes.counts;
    let mut found: Option<Thinner> = None;
    for (i, j) in (0..nx - 1).flat_map(|i| (0..ny - 1).map(move |j| (i, j))) {
        let first = i * ny + j;
        let corners = [first, first + 1, first + ny, first + ny + 1];
        let (from, to) = (nodes.place(first), nodes.place(first + ny + 1));
        if to.cmple(low).any() || from.cmpge(high).any() || corners.iter().any(|k| absence.at(*k)) {
            continue;
        }
        let cell = cell(thickness, nodes, [i, j])?;
        let is_thick = [cell[0][0], cell[0][3], cell[3][0], cell[3][3]]
            .iter()
            .all(|corner| *corner > least);
        if !is_thick {
            continue;
        }
        let Some(own) = thinnest(&cell, least, QUARTERINGS) else {
            continue;
        };
        let so_far = found.unwrap_or(Thinner {
            thickness: own,
            low: from,
            high: to,
            cells: 0,
        });
        found = Some(Thinner {
            thickness: so_far.thickness.min(own),
            low: so_far.low.min(from),
            high: so_far.high.max(to),
            cells: so_far.cells + 1,
        });
    }
    found
}

/// A cell of a function that is one spline on these nodes.
fn cell(function: &Horizon, nodes: &Nodes, [i, j]: [usize; 2]) -> Option<Cell> {
    let [lattice] = function.lattices() else {
        return None;
    };
    if lattice.corners() != (nodes.low, nodes.high) || lattice.counts() != nodes.counts {
        return None;
    }
    let first = i * nodes.counts[1] + j;
    let (from, to) = (nodes.place(first), nodes.place(first + nodes.counts[1] + 1));
    let mut cell = lattice.cell([i, j]);
    for (a, row) in cell.iter_mut().enumerate() {
        for (b, value) in row.iter_mut().enumerate() {
            let at = from + (to - from) * DVec2::new(a as f64, b as f64) / 3.0;
            *value += function.height_of_plane(at.x, at.y);
        }
    }
    Some(cell)
}

/// The least value at a corner of a part, if there is one that is no more than `least`.
fn thinnest(cell: &Cell, least: f64, quarterings: u32) -> Option<f64> {
    if cell.iter().flatten().all(|value| *value > least) {
        return None;
    }
    let corners = [cell[0][0], cell[0][3], cell[3][0], cell[3][3]];
    let lowest = corners.into_iter().fold(f64::INFINITY, f64::min);
    let own = (lowest <= least).then_some(lowest);
    if quarterings == 0 {
        return own;
    }
    let parts = quarters(cell);
    let found = parts
        .iter()
        .filter_map(|part| thinnest(part, least, quarterings - 1));
    found.chain(own).min_by(f64::total_cmp)
}

fn quarters(cell: &Cell) -> [Cell; 4] {
    let [west, east] = halves_along_x(cell);
    let [a, b] = halves_along_x(&turned(&west)).map(|half| turned(&half));
    let [c, d] = halves_along_x(&turned(&east)).map(|half| turned(&half));
    [a, b, c, d]
}

fn halves_along_x(cell: &Cell) -> [Cell; 2] {
    let mut halves = [*cell; 2];
    for j in 0..4 {
        let [p, q, r, s] = [0, 1, 2, 3].map(|i| cell[i][j]);
        let (pq, qr, rs) = (0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + s));
        let (pqr, qrs) = (0.5 * (pq + qr), 0.5 * (qr + rs));
        let middle = 0.5 * (pqr + qrs);
        for (i, (west, east)) in [(p, middle), (pq, qrs), (pqr, rs), (middle, s)]
            .into_iter()
            .enumerate()
        {
            (halves[0][i][j], halves[1][i][j]) = (west, east);
        }
    }
    halves
}

fn turned(cell: &Cell) -> Cell {
    [0, 1, 2, 3].map(|j| [0, 1, 2, 3].map(|i| cell[i][j]))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    const PLAN: [DVec2; 2] = [DVec2::ZERO, DVec2::new(600.0, 300.0)];

    fn bed(along: [f64; 7]) -> (Nodes, Horizon, Absence) {
        let nodes = Nodes {
            low: PLAN[0],
            high: PLAN[1],
            counts: [7, 4],
        };
        let thickness: Vec<f64> = along.iter().flat_map(|t| [*t; 4]).collect();
        let absence = Absence::at_nodes(&thickness, nodes.counts, 0.05);
        (nodes, nodes.interpolated(&thickness).unwrap(), absence)
    }

    #[test]
    fn a_spline_that_swings_below_the_least_thickness_beside_a_bend_is_found_with_its_minimum() {
        let (nodes, spline, absence) = bed([20.0, 10.0, 0.06, 0.06, 0.06, 0.06, 0.06]);
        let found = thinner(&spline, &nodes, &absence, 0.05, PLAN).unwrap();
        let lowest = (0..=60_000)
            .map(|k| spline.height(0.01 * f64::from(k), 130.0))
            .fold(f64::INFINITY, f64::min);
        assert!(lowest < -0.3, "{lowest}");
        assert!(
            found.thickness >= lowest && found.thickness < lowest + 1e-3,
            "{found:?} {lowest}"
        );
        // It swings below in the cell behind the bend, about 0.05 two cells on, and hardly any more after.
        assert_eq!(
            (found.low.x, found.low.y, found.high.y),
            (200.0, 0.0, 300.0)
        );
        assert!(
            (300.0..=600.0).contains(&found.high.x) && found.cells.is_multiple_of(3),
            "{found:?}"
        );
    }

    #[test]
    fn what_stays_thick_between_nodes_and_where_there_is_nothing_at_a_node_is_not_told() {
        let (nodes, spline, absence) = bed([3.0, 2.0, 1.0, 1.0, 1.5, 2.0, 3.0]);
        assert_eq!(thinner(&spline, &nodes, &absence, 0.05, PLAN), None);
        let (nodes, spline, absence) = bed([20.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(thinner(&spline, &nodes, &absence, 0.05, PLAN), None);
        // Nor beyond the plan.
        let (nodes, spline, absence) = bed([20.0, 10.0, 0.06, 0.06, 0.06, 0.06, 0.06]);
        let west = [DVec2::ZERO, DVec2::new(200.0, 300.0)];
        assert_eq!(thinner(&spline, &nodes, &absence, 0.05, west), None);
    }

    #[test]
    fn a_cell_is_the_function_and_its_quarters_are_too() {
        let heights: Vec<f64> = (0..28).map(|k| (f64::from(k) * 1.7).sin()).collect();
        let nodes = bed([1.0; 7]).0;
        let plane = Horizon::dipping(glam::DVec3::new(10.0, 20.0, 5.0), 0.1, 0.7).unwrap();
        let spline = nodes.interpolated(&heights).unwrap().plus(&plane);
        let bernstein = |t: f64| {
            let s = 1.0 - t;
            [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
        };
        let value = |cell: &Cell, u: f64, v: f64| -> f64 {
            let (a, b) = (bernstein(u), bernstein(v));
            let rows = cell.iter().zip(a);
            rows.map(|(row, a)| a * row.iter().zip(b).map(|(c, b)| c * b).sum::<f64>())
                .sum()
        };
        for at in [[0, 0], [3, 1], [5, 2]] {
            let cell = super::cell(&spline, &nodes, at).unwrap();
            let place =
                |u: f64, v: f64| DVec2::new(100.0 * (at[0] as f64 + u), 100.0 * (at[1] as f64 + v));
            for (u, v) in [(0.0, 0.0), (0.3, 0.9), (0.5, 0.5), (1.0, 0.2)] {
                let exact = spline.height(place(u, v).x, place(u, v).y);
                assert!((value(&cell, u, v) - exact).abs() < 1e-12, "{at:?} {u} {v}");
            }
            for (k, part) in quarters(&cell).iter().enumerate() {
                let (u, v) = (0.25 + 0.5 * (k / 2) as f64, 0.25 + 0.5 * (k % 2) as f64);
                let exact = spline.height(place(u, v).x, place(u, v).y);
                assert!((value(part, 0.5, 0.5) - exact).abs() < 1e-12, "{at:?} {k}");
            }
        }
        // On other nodes there are other cells.
        assert_eq!(super::cell(&spline, &nodes.as_fine_as(60.0), [0, 0]), None);
    }
}
