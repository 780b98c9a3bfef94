//! ESRI ASCII grids: a header of key and value, then rows from north to south, each from west to east.
//!
//! `xllcorner` and `yllcorner` are of a cell, in the middle of which the node is; `xllcenter` and `yllcenter` are of the node.

use glam::DVec2;

use super::error::DataError;
use super::format::Format;
use super::heights::{Grid, Heights, Layout, is_null};
use super::text::{self, Values};

/// What a header may say, with its line.
type Said = Option<(f64, usize)>;

pub(super) fn read(text: &str) -> Result<Heights, DataError> {
    let keys = [
        "NCOLS",
        "NROWS",
        "XLLCORNER",
        "XLLCENTER",
        "YLLCORNER",
        "YLLCENTER",
        "CELLSIZE",
        "DX",
        "DY",
        "NODATA_VALUE",
    ];
    let mut said: [Said; 10] = [None; 10];
    let mut last = 0;
    for (line, found) in text::uncommented(text) {
        let mut words = text::words(found);
        let key = words.next().unwrap_or_default();
        if text::number(key).is_some() {
            break;
        }
        let at = keys
            .iter()
            .position(|known| key.eq_ignore_ascii_case(known));
        let (Some(at), Some(value)) = (at, words.next()) else {
            return Err(DataError::header(
                (line, found),
                "a key of an ESRI ASCII grid (ncols, nrows, xllcorner, yllcorner, cellsize, NODATA_value) with its value",
            ));
        };
        said[at] = Some((text::need(value, line)?, line));
        last = line;
    }
    let [
        ncols,
        nrows,
        west,
        west_node,
        south,
        south_node,
        cell,
        dx,
        dy,
        null,
    ] = said;
    let need =
        |value: Said, what: &'static str| value.ok_or(DataError::Missing { line: last, what });
    let (columns, rows) = (need(ncols, "ncols")?, need(nrows, "nrows")?);
    let counts = [
        text::count(columns.0, "columns", columns.1)?,
        text::count(rows.0, "rows", rows.1)?,
    ];
    let steps = [
        need(dx.or(cell), "cellsize")?,
        need(dy.or(cell), "cellsize")?,
    ];
    let step = DVec2::new(
        text::step(steps[0].0, "column", steps[0].1)?,
        text::step(steps[1].0, "row", steps[1].1)?,
    );
    let node = |corner: Said, centre: Said, step: f64, key: &'static str| match (corner, centre) {
        (_, Some((centre, _))) => Ok(centre),
        (corner, None) => Ok(need(corner, key)?.0 + step / 2.0),
    };
    let first = DVec2::new(
        node(west, west_node, step.x, "xllcorner")?,
        node(south, south_node, step.y, "yllcorner")?,
    );
    let values = Values {
        words: text::words_after(text, last),
        line: last,
        bytes: text.len(),
        counts,
    };
    let null = null.map_or(-9999.0, |(null, _)| null);
    let values = values.read(|z| is_null(z, null))?;
    let [nx, ny] = counts;
    let heights = (0..nx * ny).map(|entry| {
        let (i, j) = (entry / ny, entry % ny);
        values[(ny - 1 - j) * nx + i]
    });
    Ok(Heights {
        format: Format::Esri,
        layout: Layout::Grid(Grid {
            first,
            step,
            rotation: 0.0,
            counts,
            heights: heights.collect(),
        }),
        positive: None,
    })
}
