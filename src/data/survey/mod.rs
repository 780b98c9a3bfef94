//! Deviation surveys from files of other programs: rows of measured depth and angles, of steps, or of points, as the file has them.
//!
//! Three formats, one file each: Petrel's well trace (`.dev`), LAS, and tables with a header. All become columns by what they mean; which
//! unit, which datum and which origin they have, the file may say and others decide.

mod columns;
mod dev;
mod error;
mod las;
mod raw;
mod table;

pub use columns::{Column, Row, SurveyFormat, SurveyReading, SurveyTable};
pub use error::SurveyFileError;

use super::text;

/// Reads a survey.
pub fn read(bytes: &[u8], reading: &SurveyReading) -> Result<SurveyTable, SurveyFileError> {
    if bytes.contains(&0) {
        return Err(SurveyFileError::Binary);
    }
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let format = reading.format.unwrap_or_else(|| format_of(text));
    let raw = match format {
        SurveyFormat::Dev => dev::read(text),
        SurveyFormat::Las => las::read(text),
        SurveyFormat::Csv => table::read(text),
    }?;
    raw.into_table(format, reading)
}

/// A `~` begins the sections of LAS, and Petrel says who it is.
fn format_of(text: &str) -> SurveyFormat {
    let is_petrel =
        |line: &str| line.starts_with('#') && line.to_ascii_uppercase().contains("WELL");
    if text::lines(text).any(|(_, line)| line.starts_with('~')) {
        SurveyFormat::Las
    } else if text::lines(text).any(|(_, line)| is_petrel(line)) {
        SurveyFormat::Dev
    } else {
        SurveyFormat::Csv
    }
}

#[cfg(test)]
#[path = "survey_tests.rs"]
mod tests;
