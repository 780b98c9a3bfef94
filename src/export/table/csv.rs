//! A table as CSV, with a header line.

use super::cell::{Cell, Sheet};
use crate::export::ExportError;

/// The table as text.
pub fn csv(sheet: &Sheet) -> Result<String, ExportError> {
    let failed = |error: &dyn std::fmt::Display| ExportError::Table(error.to_string());
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record(&sheet.columns)
        .map_err(|error| failed(&error))?;
    for row in &sheet.rows {
        writer
            .write_record(row.iter().map(Cell::text))
            .map_err(|error| failed(&error))?;
    }
    let bytes = writer.into_inner().map_err(|error| failed(&error))?;
    String::from_utf8(bytes).map_err(|error| failed(&error))
}
