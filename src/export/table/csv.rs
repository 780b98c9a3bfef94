//! A table as CSV, with a header line.

use super::cell::{Cell, Sheet};
use crate::export::{ExportError, rows};

/// The table as text.
pub fn csv(sheet: &Sheet) -> Result<String, ExportError> {
    let header = std::iter::once(sheet.columns.clone());
    let below = sheet.rows.iter();
    let below = below.map(|row| row.iter().map(Cell::text).collect());
    rows::csv(header.chain(below)).map_err(|error| ExportError::Table(error.to_string()))
}
