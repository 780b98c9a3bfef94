//! ZMAP+ grids: columns from west to east, each from north to south and on lines of its own, in fields of 20.

use std::fmt::Write;

use crate::data::Grid;

/// What stands for no data.
const NULL: f64 = -99999.0;
/// Heights a line.
const LINE: usize = 5;

/// The file of a grid that is not turned.
pub fn text(grid: &Grid, name: &str, comment: &str) -> String {
    let [columns, rows] = grid.counts;
    let [first, last] = [grid.first, grid.place(columns - 1, rows - 1)];
    // Formatting into a string does not fail, here and below.
    let mut out = String::new();
    let name: String = name
        .chars()
        .map(|c| {
            if c == ',' || c.is_whitespace() {
                '_'
            } else {
                c
            }
        })
        .collect();
    let _ = writeln!(
        out,
        "! {comment}\n@{name} HEADER, GRID, {LINE}\n20, {NULL:.4}, , 4, 1"
    );
    let _ = writeln!(
        out,
        "{rows}, {columns}, {:.6}, {:.6}, {:.6}, {:.6}",
        first.x, last.x, first.y, last.y
    );
    out.push_str("0.0, 0.0, 0.0\n@\n");
    for column in grid.heights.chunks(rows) {
        for (at, height) in column.iter().rev().enumerate() {
            let _ = write!(out, "{:20.4}", height.unwrap_or(NULL));
            if at % LINE == LINE - 1 || at + 1 == rows {
                out.push('\n');
            }
        }
    }
    out
}
