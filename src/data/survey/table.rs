//! Tables with a header, their cells between semicolons, tabs, commas or blanks; comments begin with `#` or `!`.

use super::error::SurveyFileError;
use super::raw::Raw;
use crate::data::text;

pub(super) fn read(text: &str) -> Result<Raw, SurveyFileError> {
    let mut lines = text::uncommented(text);
    let Some((header_line, names)) = lines.next() else {
        return Err(SurveyFileError::Empty);
    };
    let delimiter = [';', '\t', ',']
        .into_iter()
        .find(|one| names.contains(*one));
    let cells = |line: &str| -> Vec<String> {
        let tidy = |cell: &str| cell.trim().trim_matches('"').trim().to_owned();
        match delimiter {
            Some(delimiter) => line.split(delimiter).map(tidy).collect(),
            None => line.split_whitespace().map(tidy).collect(),
        }
    };
    let mut header = cells(names);
    // A comma at the end of a line makes no column.
    while header.last().is_some_and(String::is_empty) {
        header.pop();
    }
    Ok(Raw {
        head: None,
        datum: None,
        unit: None,
        null: None,
        header_line,
        header,
        rows: lines.map(|(line, row)| (line, cells(row))).collect(),
    })
}
