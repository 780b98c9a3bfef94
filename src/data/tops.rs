//! Tops picked in wells: a table of well, horizon and measured depth, with a header; cells between semicolons, tabs, commas or blanks.

use super::text;

/// A top as it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Top {
    /// The line, from 1.
    pub line: usize,
    /// The well.
    pub well: String,
    /// The horizon.
    pub horizon: String,
    /// Measured depth, in the unit of the well.
    pub md: f64,
}

/// Why a file holds no tops.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TopsError {
    /// The file has no header.
    #[error("the file is empty")]
    Empty,
    /// A column is missing.
    #[error("line {line}: there is no column of the {column}; there are {found}")]
    Column {
        /// The header's line.
        line: usize,
        /// What is looked for.
        column: &'static str,
        /// The columns.
        found: String,
    },
    /// A row has too few cells.
    #[error("line {line} has {found} of {needed} columns")]
    Row {
        /// The line.
        line: usize,
        /// How many there are.
        found: usize,
        /// How many the header has.
        needed: usize,
    },
    /// A depth is no number.
    #[error("line {line}: {found:?} is no measured depth")]
    Number {
        /// The line.
        line: usize,
        /// What stands there.
        found: String,
    },
}

/// Names of the three columns, the likeliest first.
const NAMES: [(&str, &[&str]); 3] = [
    (
        "well",
        &["well", "wellname", "well_name", "well name", "borehole"],
    ),
    (
        "horizon",
        &["horizon", "surface", "top", "marker", "pick", "zone"],
    ),
    (
        "measured depth",
        &["md", "measured_depth", "measured depth", "depth"],
    ),
];

/// Reads tops.
pub fn read(bytes: &[u8]) -> Result<Vec<Top>, TopsError> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = text::uncommented(text);
    let Some((header_line, names)) = lines.next() else {
        return Err(TopsError::Empty);
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
    let header = cells(names);
    let mut places = [0; 3];
    for ((column, known), place) in NAMES.iter().zip(&mut places) {
        let find = |name: &&str| header.iter().position(|own| own.eq_ignore_ascii_case(name));
        *place = known
            .iter()
            .find_map(find)
            .ok_or_else(|| TopsError::Column {
                line: header_line,
                column,
                found: header.join(", "),
            })?;
    }
    let mut tops = Vec::new();
    for (line, row) in lines {
        let row = cells(row);
        let cell = |at: usize| {
            row.get(at).map(String::as_str).ok_or(TopsError::Row {
                line,
                found: row.len(),
                needed: header.len(),
            })
        };
        let (well, horizon, depth) = (cell(places[0])?, cell(places[1])?, cell(places[2])?);
        let decimal = if depth.contains('.') {
            depth.to_owned()
        } else {
            depth.replace(',', ".")
        };
        tops.push(Top {
            line,
            well: well.to_owned(),
            horizon: horizon.to_owned(),
            md: text::number(&decimal).ok_or_else(|| TopsError::Number {
                line,
                found: depth.chars().take(40).collect(),
            })?,
        });
    }
    Ok(tops)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    #[test]
    fn tops_are_read_whatever_stands_between_their_cells() {
        for text in [
            "Well,Surface,MD\nA-1,top sand,2010.5\n",
            "# picks\r\nMD;Well;Horizon\r\n2010,5;A-1;top sand\r\n",
            "well\tmarker\tdepth\nA-1\ttop sand\t2010.5",
        ] {
            let tops = read(text.as_bytes()).unwrap();
            assert_eq!(
                (tops[0].well.as_str(), tops[0].horizon.as_str(), tops[0].md),
                ("A-1", "top sand", 2010.5)
            );
        }
    }

    #[test]
    fn what_holds_no_tops_is_refused_with_its_line() {
        assert_eq!(read(b""), Err(TopsError::Empty));
        assert!(matches!(
            read(b"well,md\nA,1"),
            Err(TopsError::Column {
                line: 1,
                column: "horizon",
                ..
            })
        ));
        assert!(matches!(
            read(b"well,top,md\nA,h"),
            Err(TopsError::Row { line: 2, .. })
        ));
        assert!(matches!(
            read(b"well,top,md\nA,h,x"),
            Err(TopsError::Number { line: 2, .. })
        ));
    }
}
