//! ZMAP+ grids.
//!
//! ```text
//! ! comments
//! @name HEADER, GRID, 5
//! 20, -99999.0, , 7, 1            width of a field, null, null as text, decimals, first column
//! NROW, NCOL, XMIN, XMAX, YMIN, YMAX
//! 0.0, 0.0, 0.0
//! @
//! columns from west to east, each from north to south, in fields of that width
//! ```

use super::error::DataError;
use super::format::Format;
use super::heights::Heights;
use super::limits::Limits;
use super::text;

/// What a blank field stands for.
const BLANK: &str = "1e30";

pub(super) fn read(text: &str) -> Result<Heights, DataError> {
    let mut lines = text::uncommented(text);
    let title = next(&mut lines, 1, "a line that begins with @")?;
    let mut parts = title.1.split(',').map(str::trim);
    if !title.1.starts_with('@') || !parts.any(|part| part.eq_ignore_ascii_case("GRID")) {
        return Err(DataError::header(
            title,
            "@name, GRID, and the number of heights a line",
        ));
    }
    let fields = next(&mut lines, title.0, "the width of a field and the null")?;
    let parts: Vec<&str> = fields.1.split(',').map(str::trim).collect();
    let width = parts.first().and_then(|word| word.parse::<usize>().ok());
    let width = width.filter(|width| *width > 0);
    let width = width.ok_or_else(|| DataError::header(fields, "the width of a field"))?;
    let null = parts
        .iter()
        .skip(1)
        .take(2)
        .find_map(|word| text::number(word));
    let extent = next(&mut lines, fields.0, "rows, columns and limits")?;
    let expected = "NROW, NCOL, XMIN, XMAX, YMIN, YMAX";
    let [rows, columns, west, east, south, north] = text::header(extent, expected)?;
    let mut last = extent.0;
    loop {
        let (line, rest) = next(&mut lines, last, "the @ that ends the header")?;
        last = line;
        if rest.starts_with('@') {
            break;
        }
    }
    // Fields may touch each other, or be blank; else blanks are enough.
    let raw = text.lines().enumerate().skip(last);
    let words = raw.flat_map(move |(at, line)| {
        let line = line.trim_end();
        let plain: Vec<&str> = text::words(line).collect();
        let is_plain = plain.iter().all(|word| text::number(word).is_some());
        let fields: Vec<&str> = fixed(line, width).collect();
        let filled = fields.iter().filter(|field| **field != BLANK);
        let words = if line.starts_with('!') {
            Vec::new()
        } else if is_plain && !filled.eq(&plain) {
            plain
        } else {
            fields
        };
        words.into_iter().map(move |word| (at + 1, word))
    });
    let header = Limits {
        format: Format::Zmap,
        nodes: ([west, east, south, north], extent.0),
        size: ([rows, columns], extent.0),
        null,
        last,
        bytes: text.len(),
    };
    header.grid(words)
}

/// The fields of a line; one that is blank stands for no data.
fn fixed(line: &str, width: usize) -> impl Iterator<Item = &str> {
    let fields = (0..line.len()).step_by(width);
    fields.map(move |from| {
        let field = line.get(from..(from + width).min(line.len()));
        match field.map(str::trim) {
            Some("") => BLANK,
            Some(field) => field,
            None => line,
        }
    })
}

fn next<'a>(
    lines: &mut impl Iterator<Item = (usize, &'a str)>,
    line: usize,
    what: &'static str,
) -> Result<(usize, &'a str), DataError> {
    lines.next().ok_or(DataError::Missing { line, what })
}
