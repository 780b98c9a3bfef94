//! Where the difference of two heights has an extremum, the least differences first.
//!
//! Two horizons that cross in a closed curve have an extremum of their difference within it. On a lattice as fine as
//! their patches every larger curve holds one; the smaller the difference there, the more a curve needs looking for.

use glam::{DVec2, Vec3Swizzles};
use rayon::prelude::*;

use crate::features::body::Body;
use crate::features::side::{HorizonSheet, Side};
use crate::model::plan::AssemblyPlan;

/// Fewest and most cells of the lattice each way.
const CELLS: [usize; 2] = [8, 64];
/// Up to so many heights all pairs are compared; of more, neighbours by their mean elevation.
const ALL_PAIRS: usize = 12;
/// Extrema of each pair.
const OF_PAIR: usize = 12;

/// Places in plan, each with how far around it still is the same cell (m).
pub(super) fn columns(plan: &AssemblyPlan, most: usize) -> Vec<(DVec2, f64)> {
    let sides = plan.shells.iter().filter_map(|shell| match &shell.body {
        Body::Side(side) => Some(side.as_ref()),
        _ => None,
    });
    let sheets: Vec<&HorizonSheet> = sides
        .chain(plan.bounds().map(|(_, side)| side.as_ref()))
        .filter_map(|side| match side {
            Side::Horizon(sheet) => Some(sheet),
            _ => None,
        })
        .collect();
    if sheets.len() < 2 {
        return Vec::new();
    }
    let spans = |sheet: &&HorizonSheet| {
        let surface = sheet.surface();
        let of = |knots: &crate::nurbs::KnotVector| knots.count() - knots.degree();
        of(surface.knots_u()).max(of(surface.knots_v()))
    };
    let cells = sheets.iter().map(spans).max().unwrap_or(0);
    let cells = cells.clamp(CELLS[0], CELLS[1]);
    let (low, high) = (plan.low().xy(), plan.high().xy());
    let cell = (high - low) / cells as f64;
    let place = |i: usize, j: usize| low + cell * (DVec2::new(i as f64, j as f64) + 0.5);
    let heights: Vec<Vec<f64>> = sheets
        .par_iter()
        .map(|sheet| {
            let all = (0..cells * cells).map(|k| sheet.height(place(k % cells, k / cells)));
            all.collect()
        })
        .collect();
    let mut order: Vec<usize> = (0..sheets.len()).collect();
    let mean = |k: &usize| heights[*k].iter().sum::<f64>();
    order.sort_by(|a, b| mean(a).total_cmp(&mean(b)));
    let mut found: Vec<(f64, usize)> = Vec::new();
    for (k, &a) in order.iter().enumerate() {
        let beside = if sheets.len() <= ALL_PAIRS {
            sheets.len()
        } else {
            k + 2
        };
        for &b in &order[(k + 1).min(order.len())..beside.min(order.len())] {
            let difference: Vec<f64> = heights[a]
                .iter()
                .zip(&heights[b])
                .map(|(a, b)| b - a)
                .collect();
            let mut own = extrema(&difference, cells);
            own.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            found.extend(own.into_iter().take(OF_PAIR));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut cells_found: Vec<usize> = Vec::new();
    for (_, at) in found {
        if cells_found.len() < most && !cells_found.contains(&at) {
            cells_found.push(at);
        }
    }
    let reach = 0.4 * cell.min_element();
    cells_found
        .into_iter()
        .map(|k| (place(k % cells, k / cells), reach))
        .collect()
}

/// Cells of a square lattice that none of the cells around exceeds, or falls below: with the size of their values.
fn extrema(values: &[f64], cells: usize) -> Vec<(f64, usize)> {
    let around = |k: usize| {
        let (i, j) = (k % cells, k / cells);
        let rows = j.saturating_sub(1)..=(j + 1).min(cells - 1);
        rows.flat_map(move |row| {
            let columns = i.saturating_sub(1)..=(i + 1).min(cells - 1);
            columns.map(move |column| row * cells + column)
        })
        .filter(move |other| *other != k)
    };
    let is_extremum = |k: &usize| {
        let here = values[*k];
        around(*k).all(|other| values[other] < here) || around(*k).all(|other| values[other] > here)
    };
    (0..cells * cells)
        .filter(is_extremum)
        .map(|k| (values[k].abs(), k))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::extrema;

    #[test]
    fn every_dip_and_every_rise_of_a_lattice_is_found_with_its_size() {
        let cells = 40;
        let bump = |x: f64, y: f64, at: (f64, f64)| {
            (-((x - at.0).powi(2) + (y - at.1).powi(2)) / 9.0).exp()
        };
        let value = |k: usize| {
            let (x, y) = ((k % cells) as f64, (k / cells) as f64);
            2.0 + 0.01 * x - 2.5 * bump(x, y, (11.0, 30.0)) + bump(x, y, (28.0, 9.0))
        };
        let values: Vec<f64> = (0..cells * cells).map(value).collect();
        let found = extrema(&values, cells);
        for at in [30 * cells + 11, 9 * cells + 28] {
            assert!(found.contains(&(values[at].abs(), at)));
        }
        // Corners where the slope begins and ends may be extrema, too; nothing else is.
        assert!(found.len() <= 6, "{found:?}");
    }
}
