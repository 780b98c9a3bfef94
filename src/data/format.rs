//! Formats, and how they are told from what a file holds.

use super::error::DataError;
use super::text::{numbers, uncommented};

/// How a file of heights is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// IRAP classic ASCII grid.
    Irap,
    /// ZMAP+ grid.
    Zmap,
    /// CPS-3 ASCII grid.
    Cps3,
    /// GOCAD triangulated surface.
    Tsurf,
    /// ESRI ASCII grid.
    Esri,
    /// Table with a header.
    Csv,
    /// Columns of numbers.
    Xyz,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 7] = [
        Self::Irap,
        Self::Zmap,
        Self::Cps3,
        Self::Tsurf,
        Self::Esri,
        Self::Csv,
        Self::Xyz,
    ];

    /// The word for it in model files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Irap => "irap",
            Self::Zmap => "zmap",
            Self::Cps3 => "cps3",
            Self::Tsurf => "tsurf",
            Self::Esri => "esri",
            Self::Csv => "csv",
            Self::Xyz => "xyz",
        }
    }

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Irap => "IRAP classic",
            Self::Zmap => "ZMAP+",
            Self::Cps3 => "CPS-3",
            Self::Tsurf => "GOCAD TSurf",
            Self::Esri => "ESRI ASCII grid",
            Self::Csv => "CSV",
            Self::Xyz => "XYZ",
        }
    }

    /// The format that a word means.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.word() == word)
    }
}

/// Files that are no text, by how they begin.
const BINARY: [(&[u8], &str, &str); 6] = [
    (
        b"II*\0",
        "a GeoTIFF",
        "write it as text: gdal_translate -of AAIGrid FILE.tif FILE.asc",
    ),
    (
        b"MM\0*",
        "a GeoTIFF",
        "write it as text: gdal_translate -of AAIGrid FILE.tif FILE.asc",
    ),
    (
        b"\0\0\0 \0\0\x03\xfc",
        "a binary IRAP grid",
        "export it as IRAP classic ASCII",
    ),
    (
        b"PK\x03\x04",
        "a ZIP archive or a spreadsheet",
        "unpack it, or save the table as CSV",
    ),
    (b"\x1f\x8b", "compressed by gzip", "unpack it with gunzip"),
    (b"DSBB", "a binary Surfer grid", "save it as XYZ"),
];

/// The format that a file has.
pub(super) fn of(bytes: &[u8]) -> Result<Format, DataError> {
    for (start, what, remedy) in BINARY {
        if bytes.starts_with(start) {
            return Err(DataError::Foreign { what, remedy });
        }
    }
    // A header is short; the rest is none of our business here.
    let head = &bytes[..bytes.len().min(1 << 16)];
    if head.contains(&0) {
        return Err(DataError::Foreign {
            what: "a binary file",
            remedy: "export the surface as text, such as IRAP classic ASCII",
        });
    }
    let text = String::from_utf8_lossy(head);
    let text = text.trim_start_matches('\u{feff}');
    let first = uncommented(text).next();
    let Some((line, first)) = first else {
        return Err(DataError::Empty);
    };
    let word = first.split([' ', '\t', ',']).next().unwrap_or_default();
    let upper = word.to_ascii_uppercase();
    if upper == "GOCAD" {
        let kind = first.split_whitespace().nth(1).unwrap_or_default();
        return if kind.eq_ignore_ascii_case("TSurf") {
            Ok(Format::Tsurf)
        } else {
            Err(DataError::Header {
                line,
                expected: "a GOCAD TSurf",
                found: first.to_owned(),
            })
        };
    }
    if upper.starts_with("FSASCI") || upper.starts_with("FSATTR") || upper.starts_with("FSLIMI") {
        return Ok(Format::Cps3);
    }
    if first.starts_with('@') {
        return Ok(Format::Zmap);
    }
    if word == "-996" {
        return Ok(Format::Irap);
    }
    if ["NCOLS", "NROWS", "XLLCORNER", "XLLCENTER"].contains(&upper.as_str()) {
        return Ok(Format::Esri);
    }
    if upper == "VERSION" || first.eq_ignore_ascii_case("BEGIN HEADER") {
        return Ok(Format::Xyz);
    }
    if numbers(first).is_some_and(|numbers| numbers.len() >= 3) {
        return Ok(Format::Xyz);
    }
    // A header: at least three names, and numbers below them.
    let mut rest = uncommented(text).skip(1);
    let has_names = first
        .split([',', ';', '\t', ' '])
        .filter(|w| !w.is_empty())
        .count()
        >= 3;
    if has_names
        && rest
            .next()
            .is_some_and(|(_, row)| row.contains(|c: char| c.is_ascii_digit()))
    {
        return Ok(Format::Csv);
    }
    Err(DataError::Unknown {
        line,
        found: first.chars().take(40).collect(),
    })
}
