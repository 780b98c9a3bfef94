//! A table as CSV, with a header line.

use super::cell::{Cell, Sheet};
use crate::export::rows;

/// The table as text.
pub fn csv(sheet: &Sheet) -> Result<String, csv::Error> {
    let header = std::iter::once(sheet.columns.clone());
    let below = sheet.rows.iter();
    let below = below.map(|row| row.iter().map(Cell::text).collect());
    rows::csv(header.chain(below))
}
