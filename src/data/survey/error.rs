//! Why a file holds no survey: with the line, what was found there, and what to do.

/// Why a survey could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SurveyFileError {
    /// The file is empty, or has comments alone.
    #[error("the file is empty")]
    Empty,
    /// The file is no text.
    #[error("the file is no text")]
    Binary,
    /// A part of the format is missing.
    #[error("{what} is missing; the file ends at line {line}")]
    Missing {
        /// The last line.
        line: usize,
        /// What should be there.
        what: &'static str,
    },
    /// No column of the header is known.
    #[error("line {line}: none of its columns is one of a survey: {found}")]
    NoColumns {
        /// The header's line, from 1.
        line: usize,
        /// Its columns.
        found: String,
    },
    /// A column that was named is not there.
    #[error("line {line}: no column is {column:?}; there are {found}")]
    Column {
        /// The header's line, from 1.
        line: usize,
        /// What is looked for.
        column: String,
        /// The columns.
        found: String,
    },
    /// A row has too few cells.
    #[error("line {line} has {found} of {needed} columns")]
    Row {
        /// The line, from 1.
        line: usize,
        /// How many there are.
        found: usize,
        /// How many the header has.
        needed: usize,
    },
    /// A word stands where a number should.
    #[error("line {line}: {found:?} is no number ({column})")]
    Number {
        /// The line, from 1.
        line: usize,
        /// What the column means.
        column: &'static str,
        /// The word.
        found: String,
    },
    /// There are no rows.
    #[error("the file has no row that is complete ({dropped} with values missing)")]
    NoRows {
        /// How many rows are incomplete.
        dropped: usize,
    },
}

impl SurveyFileError {
    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Empty | Self::NoRows { .. } => "export it again",
            Self::Binary => "export it as text: a Petrel well trace, LAS, or a table",
            Self::Missing { .. } | Self::Row { .. } => {
                "the file was cut off: export or copy it again"
            }
            Self::NoColumns { .. } | Self::Column { .. } => {
                "name the columns, for example: columns = { md = \"MD\", inc_deg = \"INCL\", azi_deg = \"AZIM_GN\" }"
            }
            Self::Number { .. } => {
                "write numbers with a decimal point, and leave cells empty where there is no value"
            }
        }
    }
}
