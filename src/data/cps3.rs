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

use super::error::DataError;
use super::format::Format;
use super::heights::Heights;
use super::limits::Limits;
use super::text;

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
                return Err(DataError::header(
                    (line, found),
                    "a line that begins with FSASCI, FSATTR, FSLIMI, FSNROW, FSXINC or ->, or heights",
                ));
            }
        }
        last = line;
    }
    let missing = |what| DataError::Missing { line: last, what };
    let header = Limits {
        format: Format::Cps3,
        nodes: limits.ok_or_else(|| missing("FSLIMI"))?,
        size: size.ok_or_else(|| missing("FSNROW"))?,
        null,
        last,
        bytes: text.len(),
    };
    header.grid(text::words_after(text, last))
}
