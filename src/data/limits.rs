//! Grids that are given by their limits and not turned, with heights in columns from west to east, each from north to south.

use glam::DVec2;

use super::error::DataError;
use super::format::Format;
use super::heights::{Grid, Heights, Layout, is_null};
use super::text::{self, Values};

/// What stands for no data whatever the header says.
const HUGE: f64 = 1e29;

/// What the header says, with the lines where it does.
pub(super) struct Limits {
    pub(super) format: Format,
    /// The outer nodes: west, east, south and north.
    pub(super) nodes: ([f64; 4], usize),
    /// Rows and columns.
    pub(super) size: ([f64; 2], usize),
    /// What stands for no data.
    pub(super) null: Option<f64>,
    /// The last line of the header.
    pub(super) last: usize,
    /// How many bytes the file has.
    pub(super) bytes: usize,
}

impl Limits {
    /// The grid whose heights these words are, each with its line.
    pub(super) fn grid<'a>(
        self,
        words: impl Iterator<Item = (usize, &'a str)>,
    ) -> Result<Heights, DataError> {
        let ([west, east, south, north], at) = self.nodes;
        let ([rows, columns], sized) = self.size;
        let counts = [
            text::count(columns, "columns", sized)?,
            text::count(rows, "rows", sized)?,
        ];
        let step = DVec2::new(
            text::step((east - west) / (columns - 1.0), "column", at)?,
            text::step((north - south) / (rows - 1.0), "row", at)?,
        );
        let values = Values {
            words,
            line: self.last,
            bytes: self.bytes,
            counts,
        };
        let is_none = |z: f64| z.abs() >= HUGE || self.null.is_some_and(|null| is_null(z, null));
        let values = values.read(is_none)?;
        let columns = values.chunks(counts[1]);
        Ok(Heights {
            format: self.format,
            layout: Layout::Grid(Grid {
                first: DVec2::new(west, south),
                step,
                rotation: 0.0,
                counts,
                heights: columns
                    .flat_map(|column| column.iter().rev().copied())
                    .collect(),
            }),
            positive: None,
        })
    }
}
