//! Petrel's well trace (`.dev`): comments that say head and datum, a line with the columns' names between rules of `=`, rows of numbers.
//!
//! `MD X Y Z TVD DX DY AZIM_TN INCL DLS AZIM_GN`: Z is an elevation, TVD is below the datum.

use super::error::SurveyFileError;
use super::raw::Raw;
use crate::data::text;

pub(super) fn read(text: &str) -> Result<Raw, SurveyFileError> {
    let mut raw = Raw {
        head: None,
        datum: None,
        unit: None,
        null: None,
        header_line: 0,
        header: Vec::new(),
        rows: Vec::new(),
    };
    let (mut x, mut y) = (None, None);
    let mut last = 0;
    for (line, words) in text::lines(text) {
        last = line;
        if let Some(comment) = words.strip_prefix('#') {
            let upper = comment.to_ascii_uppercase();
            let value = comment.rsplit_once(':').map_or("", |(_, value)| value);
            let said = || value.split_whitespace().next().and_then(text::number);
            if upper.contains("HEAD X") {
                x = said();
            } else if upper.contains("HEAD Y") {
                y = said();
            } else if let Some(datum) = said().filter(|_| upper.contains("WELL DATUM")) {
                raw.datum = Some(datum);
                let unit = value
                    .split_once('(')
                    .and_then(|(_, rest)| rest.split_once(')'));
                raw.unit = unit.map(|(unit, _)| unit.trim().to_owned());
            }
            continue;
        }
        let cells = || text::words(words).map(str::to_owned).collect::<Vec<_>>();
        let is_names = text::words(words)
            .next()
            .is_some_and(|first| first.starts_with(|c: char| c.is_ascii_alphabetic()));
        if raw.header.is_empty() && is_names {
            raw.header_line = line;
            raw.header = cells();
        } else if !raw.header.is_empty() {
            raw.rows.push((line, cells()));
        }
    }
    if raw.header.is_empty() {
        return Err(SurveyFileError::Missing {
            line: last,
            what: "the line with the columns' names (MD X Y Z …)",
        });
    }
    if let (Some(x), Some(y)) = (x, y) {
        raw.head = Some([x, y]);
    }
    Ok(raw)
}
