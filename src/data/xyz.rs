//! Columns of numbers without names: x, y, z and whatever else.
//!
//! Headers of Petrel's points (`VERSION`, `BEGIN HEADER` … `END HEADER`) are passed over.

use glam::DVec2;

use super::error::DataError;
use super::format::Format;
use super::heights::{Heights, Layout, Point};
use super::text;

/// Words that stand for no data.
const NONE: [&str; 4] = ["nan", "null", "none", "*"];

pub(super) fn read(text: &str, columns: Option<&[String; 3]>) -> Result<Heights, DataError> {
    let columns = columns.map_or(Ok([0, 1, 2]), numbered)?;
    let widest = columns.iter().max().map_or(0, |most| most + 1);
    let mut points = Vec::new();
    let mut is_header = false;
    for (line, found) in text::uncommented(text) {
        if is_header || found.eq_ignore_ascii_case("BEGIN HEADER") {
            is_header = !found.eq_ignore_ascii_case("END HEADER");
            continue;
        }
        let words: Vec<&str> = text::words(found).collect();
        if words[0].eq_ignore_ascii_case("VERSION") {
            continue;
        }
        if words.len() < widest {
            return Err(DataError::header((line, found), "x, y and z"));
        }
        let [x, y, z] = columns.map(|column| words[column]);
        let is_none = NONE.iter().any(|none| z.eq_ignore_ascii_case(none));
        points.push(Point {
            at: DVec2::new(text::need(x, line)?, text::need(y, line)?),
            height: if is_none {
                None
            } else {
                Some(text::need(z, line)?)
            },
            line: u32::try_from(line).unwrap_or(u32::MAX),
        });
    }
    Ok(Heights {
        format: Format::Xyz,
        layout: Layout::Points(points),
        positive: None,
    })
}

/// Columns by their numbers from 1.
fn numbered(columns: &[String; 3]) -> Result<[usize; 3], DataError> {
    let mut found = [0; 3];
    for (at, column) in found.iter_mut().zip(columns) {
        let number = column.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
        *at = number.ok_or_else(|| DataError::Column {
            line: 1,
            column: column.clone(),
            found: "numbers alone, without names: columns are counted from 1".to_owned(),
        })?;
    }
    Ok(found)
}
