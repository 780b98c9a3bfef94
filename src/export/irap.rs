//! IRAP classic ASCII grids: rows from south to north, each from west to east.

use std::fmt::Write;

use crate::data::Grid;

/// What stands for no data.
const NULL: &str = "9999900.0000";
/// Heights a line.
const LINE: usize = 6;

/// The file of a grid that is not turned.
pub fn text(grid: &Grid) -> String {
    let [columns, rows] = grid.counts;
    let [first, last] = [grid.first, grid.place(columns - 1, rows - 1)];
    // Formatting into a string does not fail, here and below.
    let mut out = String::new();
    let _ = writeln!(out, "-996 {rows} {:.6} {:.6}", grid.step.x, grid.step.y);
    let _ = writeln!(
        out,
        "{:.6} {:.6} {:.6} {:.6}",
        first.x, last.x, first.y, last.y
    );
    let _ = writeln!(
        out,
        "{columns} {:.6} {:.6} {:.6}\n0 0 0 0 0 0 0",
        0.0, first.x, first.y
    );
    for at in 0..columns * rows {
        let height = grid.heights[at % columns * rows + at / columns];
        let _ = match height {
            Some(height) => write!(out, "{height:.4}"),
            None => write!(out, "{NULL}"),
        };
        out.push(if at % LINE == LINE - 1 || at + 1 == columns * rows {
            '\n'
        } else {
            ' '
        });
    }
    out
}
