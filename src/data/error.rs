//! Why a file holds no heights: with the line, what was found there, and what to do.

/// Why a file could not be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DataError {
    /// Nobody knows this format.
    #[error("line {line}: {found:?} begins no format that is known")]
    Unknown {
        /// The first line that says anything.
        line: usize,
        /// What it begins with.
        found: String,
    },
    /// A format that is known and not read.
    #[error("this is {what}, which is not read")]
    Foreign {
        /// The format.
        what: &'static str,
        /// How to make of it something that is read.
        remedy: &'static str,
    },
    /// The file is empty, or has comments alone.
    #[error("the file is empty")]
    Empty,
    /// A line of the header is not what the format has there.
    #[error("line {line}: expected {expected}, found {found:?}")]
    Header {
        /// The line, from 1.
        line: usize,
        /// What the format has there.
        expected: &'static str,
        /// What is there.
        found: String,
    },
    /// The header says something that no grid can be.
    #[error("line {line}: {what}")]
    Geometry {
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        what: String,
    },
    /// A word stands where a number should.
    #[error("line {line}: {found:?} is no number")]
    Number {
        /// The line, from 1.
        line: usize,
        /// The word.
        found: String,
    },
    /// The file ends before it is complete.
    #[error("the file ends at line {line} with {found} of {needed}")]
    Short {
        /// The last line.
        line: usize,
        /// How many there are.
        found: usize,
        /// How many are needed, and of what.
        needed: String,
    },
    /// The file ends before its header, or its last line.
    #[error("the file ends at line {line}, and {what} is missing")]
    Missing {
        /// The last line.
        line: usize,
        /// What should be there.
        what: &'static str,
    },
    /// There is more than the header says.
    #[error("line {line}: after {needed} heights there is more: {found:?}")]
    Long {
        /// The line, from 1.
        line: usize,
        /// The number of heights that the header says.
        needed: usize,
        /// What comes next.
        found: String,
    },
    /// A table has no such column.
    #[error("line {line}: no column is {column:?}; there are {found}")]
    Column {
        /// The line, from 1.
        line: usize,
        /// What is looked for.
        column: String,
        /// The columns.
        found: String,
    },
    /// A triangle refers to a vertex that is not there.
    #[error("line {line}: there is no vertex {vertex}")]
    Vertex {
        /// The line, from 1.
        line: usize,
        /// Its number.
        vertex: u64,
    },
    /// All heights are nulls.
    #[error("the file has no height: {nulls} nulls and nothing else")]
    Nothing {
        /// How many nulls there are.
        nulls: usize,
    },
}

impl DataError {
    /// A line that is not what the format has there.
    pub(super) fn header((line, found): (usize, &str), expected: &'static str) -> Self {
        Self::Header {
            line,
            expected,
            found: found.chars().take(60).collect(),
        }
    }

    /// What to do about it.
    pub fn remedy(&self) -> String {
        match self {
            Self::Unknown { .. } => {
                "export it as IRAP classic, ZMAP+, CPS-3, GOCAD TSurf, ESRI ASCII, CSV or XYZ; if it is one of these, say which: \
                 format = \"irap\", \"zmap\", \"cps3\", \"tsurf\", \"esri\", \"csv\" or \"xyz\""
                    .to_owned()
            }
            Self::Foreign { remedy, .. } => (*remedy).to_owned(),
            Self::Empty => "export it again".to_owned(),
            Self::Header { .. } => {
                "export it again, or correct the line; if it has another format, say which, for example: format = \"xyz\"".to_owned()
            }
            Self::Geometry { .. } => "correct the header".to_owned(),
            Self::Number { .. } => {
                "write numbers with a decimal point, and what stands for no data as the format has it".to_owned()
            }
            Self::Short { .. } | Self::Missing { .. } => {
                "the file was cut off, or its header counts wrongly: export or copy it again".to_owned()
            }
            Self::Long { .. } => "its header counts wrongly: export it again".to_owned(),
            Self::Column { .. } => {
                "name the columns, for example: columns = { x = \"X\", y = \"Y\", z = \"Z\" }".to_owned()
            }
            Self::Vertex { .. } => "the surface is not complete: export it again".to_owned(),
            Self::Nothing { .. } => "export another region, or look at what stands for no data".to_owned(),
        }
    }
}
