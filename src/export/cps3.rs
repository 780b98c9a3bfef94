//! CPS-3 ASCII grids: columns from west to east, each from north to south, five heights a line.

use std::fmt::Write;

use crate::data::Grid;

/// What stands for no data.
const NULL: &str = "1.0E+30";
/// Heights a line.
const LINE: usize = 5;

/// The file of a grid that is not turned.
pub fn text(grid: &Grid, name: &str) -> String {
    let [columns, rows] = grid.counts;
    let [first, last] = [grid.first, grid.place(columns - 1, rows - 1)];
    let heights = || grid.heights.iter().flatten();
    let low = heights().copied().fold(f64::INFINITY, f64::min);
    let high = heights().copied().fold(f64::NEG_INFINITY, f64::max);
    // Formatting into a string does not fail, here and below.
    let mut out = format!("FSASCI 0 1 \"Computed\" 0 {NULL}\nFSATTR 0 0\n");
    let _ = writeln!(
        out,
        "FSLIMI {:.6} {:.6} {:.6} {:.6} {low:.4} {high:.4}\nFSNROW {rows} {columns}\nFSXINC {:.6} {:.6}\n->{name}",
        first.x, last.x, first.y, last.y, grid.step.x, grid.step.y
    );
    for column in grid.heights.chunks(rows) {
        for (at, height) in column.iter().rev().enumerate() {
            let _ = match height {
                Some(height) => write!(out, "{height:.4}"),
                None => write!(out, "{NULL}"),
            };
            out.push(if at % LINE == LINE - 1 || at + 1 == rows {
                '\n'
            } else {
                ' '
            });
        }
    }
    out
}
