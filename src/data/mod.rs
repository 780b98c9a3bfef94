//! Heights from files of other programs: bytes become nodes of a grid, or scattered points, as the file has them.
//!
//! Surveys of wells are read by [`survey`], picks in them by [`tops`].
//!
//! One format, one file. What a file says is read tolerantly (any blanks, line ends and comments; exponents as Fortran writes
//! them), and nothing is guessed: a number that is none, a count that does not fit and a cut-off end are errors with their line.
//! Nothing here knows of models: which way is up, which unit and which origin, the file may say and others decide.

mod cps3;
mod csv;
mod error;
mod esri;
mod format;
mod heights;
mod irap;
mod limits;
pub mod survey;
mod text;
pub mod tops;
mod tsurf;
mod xyz;
mod zmap;

pub use error::DataError;
pub use format::Format;
pub use heights::{Grid, Heights, Layout, Origin, Point, Positive, Sample};

/// What is known of a file besides what it says itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Its format; found from what it holds if not given.
    pub format: Option<Format>,
    /// The columns of x, y and z, of a table: a name of its header, or a number from 1.
    pub columns: Option<[String; 3]>,
    /// Heights that stand for no data, besides those that the format says.
    pub nulls: Vec<f64>,
}

/// Reads heights.
pub fn read(bytes: &[u8], reading: &Reading) -> Result<Heights, DataError> {
    let found = format::of(bytes);
    let format = match (reading.format, found) {
        (Some(format), _) => format,
        (None, found) => found?,
    };
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let columns = reading.columns.as_ref();
    let mut heights = match format {
        Format::Irap => irap::read(text),
        Format::Zmap => zmap::read(text),
        Format::Cps3 => cps3::read(text),
        Format::Tsurf => tsurf::read(text),
        Format::Esri => esri::read(text),
        Format::Csv => csv::read(text, columns),
        Format::Xyz => xyz::read(text, columns),
    }?;
    heights.blank(&reading.nulls);
    if heights.samples().next().is_none() {
        return Err(DataError::Nothing {
            nulls: heights.nulls(),
        });
    }
    Ok(heights)
}

#[cfg(test)]
mod tests;
