//! CPS-3 ASCII grids.
//!
//! ```text
//! FSASCI 0 1 "Computed" 0 1.0E+30       the last number stands for no data
//! FSATTR 0 0
//! FSLIMI xmin xmax ymin ymax zmin zmax
//! FSNROW nrow ncol
//! FSXINC dx dy
//! ->name
//! columns from west to east, each from north to south, however they are broken into lines
//! ```

use glam::DVec2;

use super::error::DataError;
use super::format::Format;
use super::heights::{Grid, Heights, Layout, is_null};
use super::text::{self, Values};

/// What stands for no data whatever the header says.
const HUGE: f64 = 1e29;

pub(super) fn read(text: &str) -> Result<Heights, DataError> {
    let (mut null, mut limits, mut size) = (None, None, None);
    let mut last = 1;
    for (line, found) in text::uncommented(text) {
        let keyword = text::words(found).next().unwrap_or_default();
        match keyword.to_ascii_uppercase().as_str() {
            "FSASCI" => null = text::words(found).filter_map(text::number).last(),
            "FSLIMI" => {
                let values: [f64; 4] =
                    text::header((line, found), "FSLIMI xmin xmax ymin ymax zmin zmax")?;
                limits = Some((values, line));
            }
            "FSNROW" => {
                let values: [f64; 2] = text::header((line, found), "FSNROW rows columns")?;
                size = Some((values, line));
            }
            "FSATTR" | "FSXINC" => {}
            _ if found.starts_with("->") => {}
            _ if text::number(keyword).is_some() => break,
            _ => {
                return Err(DataError::Header {
                    line,
                    expected: "a line that begins with FSASCI, FSATTR, FSLIMI, FSNROW, FSXINC or ->, or heights",
                    found: found.chars().take(60).collect(),
                });
            }
        }
        last = line;
    }
    let missing = |what| DataError::Missing { line: last, what };
    let ([west, east, south, north], at) = limits.ok_or_else(|| missing("FSLIMI"))?;
    let ([rows, columns], sized) = size.ok_or_else(|| missing("FSNROW"))?;
    let counts = [
        text::count(columns, "columns", sized)?,
        text::count(rows, "rows", sized)?,
    ];
    let step = DVec2::new(
        text::step((east - west) / (columns - 1.0), "column", at)?,
        text::step((north - south) / (rows - 1.0), "row", at)?,
    );
    let values = Values {
        words: text::uncommented(text)
            .filter(|(line, _)| *line > last)
            .flat_map(|(line, words)| text::words(words).map(move |word| (line, word))),
        line: last,
        bytes: text.len(),
        counts,
    };
    let values = values.read(|z| z.abs() >= HUGE || null.is_some_and(|null| is_null(z, null)))?;
    Ok(Heights {
        format: Format::Cps3,
        layout: Layout::Grid(Grid {
            first: DVec2::new(west, south),
            step,
            rotation: 0.0,
            counts,
            heights: text::from_north(&values, counts[1]),
        }),
        positive: None,
    })
}
