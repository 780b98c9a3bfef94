//! Tables as one workbook (XLSX, Office Open XML), a sheet each, with a header that stays and filters.
//!
//! A workbook says when it was made; ours says the first day that one can say, so that the same model gives the same bytes.

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, Worksheet, XlsxError};

use super::cell::{Cell, Sheet};
use crate::export::ExportError;

/// Most rows of a sheet, its header among them.
const MOST_ROWS: usize = 1_048_576;
/// Widest column, in characters.
const WIDEST: usize = 40;

/// The tables as a workbook.
pub fn xlsx(sheets: &[Sheet]) -> Result<Vec<u8>, ExportError> {
    if let Some(sheet) = sheets.iter().find(|sheet| sheet.rows.len() >= MOST_ROWS) {
        return Err(ExportError::Table(format!(
            "the table of {} has {} rows, and a sheet holds {MOST_ROWS} at most; write CSV instead (--formats csv)",
            sheet.name,
            sheet.rows.len()
        )));
    }
    workbook(sheets).map_err(|error| ExportError::Table(format!("the workbook: {error}")))
}

fn workbook(sheets: &[Sheet]) -> Result<Vec<u8>, XlsxError> {
    let mut workbook = Workbook::new();
    let made = ExcelDateTime::from_ymd(1980, 1, 1)?;
    workbook.set_properties(
        &DocProperties::new()
            .set_creation_datetime(&made)
            .set_author(env!("CARGO_PKG_NAME")),
    );
    let header = Format::new().set_bold();
    for sheet in sheets {
        let page = workbook.add_worksheet();
        page.set_name(sheet.name)?;
        fill(page, sheet, &header)?;
    }
    workbook.save_to_buffer()
}

fn fill(page: &mut Worksheet, sheet: &Sheet, header: &Format) -> Result<(), XlsxError> {
    page.set_freeze_panes(1, 0)?;
    for (at, name) in sheet.columns.iter().enumerate() {
        let column = u16::try_from(at).map_err(|_| XlsxError::RowColumnLimitError)?;
        page.write_string_with_format(0, column, name, header)?;
        let cells = sheet.rows.iter().map(|row| row[at].text().chars().count());
        let widest = cells.chain([name.chars().count()]).max().unwrap_or(0);
        page.set_column_width(column, (widest.min(WIDEST) + 2) as f64)?;
    }
    for (at, cells) in sheet.rows.iter().enumerate() {
        let row = u32::try_from(at + 1).map_err(|_| XlsxError::RowColumnLimitError)?;
        for (column, cell) in (0_u16..).zip(cells) {
            match (cell, cell.value()) {
                (Cell::Text(text), _) => page.write_string(row, column, text)?,
                (_, Some(value)) => page.write_number(row, column, value)?,
                (_, None) => page,
            };
        }
    }
    if let (Ok(last_row), Ok(columns)) = (
        u32::try_from(sheet.rows.len()),
        u16::try_from(sheet.columns.len()),
    ) && columns > 0
    {
        page.autofilter(0, 0, last_row, columns - 1)?;
    }
    Ok(())
}
