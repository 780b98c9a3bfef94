//! Design tables: a row a realisation, a column a key of the model, as `--set` names it.
//!
//! A column `seed` gives each row its seed. A table is checked as a whole before anything is made: every row must be a model.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::model::{Defect, Model, Source};

/// The column that is a row's seed.
const SEED: &str = "seed";

/// The most rows that a table may have.
const MOST_ROWS: usize = 1_000_000;

/// One row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its line in the file.
    pub line: u64,
    /// Its seed, if the table says one.
    pub seed: Option<u64>,
    /// Its value of each column but that of the seed.
    pub values: Vec<String>,
}

/// A table that was read; whether its rows are models [`Design::check`] tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Design {
    path: PathBuf,
    /// The keys of the model.
    pub keys: Vec<String>,
    /// The rows.
    pub rows: Vec<Row>,
}

/// What is wrong with a design table.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// It cannot be read.
    #[error("{}: the design table cannot be read: {source}; check the path", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's words.
        source: std::io::Error,
    },
    /// It is no table of values with commas between them.
    #[error("{}, line {line}: {message}; write values with commas between them, each row as many as the first", path.display())]
    NoTable {
        /// The file.
        path: PathBuf,
        /// Where.
        line: u64,
        /// What is wrong.
        message: String,
    },
    /// It has no rows, or too many.
    #[error("{}: the table has {rows} rows below its first, which names the keys; write 1 to {MOST_ROWS}", path.display())]
    Rows {
        /// The file.
        path: PathBuf,
        /// How many.
        rows: usize,
    },
    /// A column has no name, or that of another one.
    #[error("{}, line 1: column {column} {what}; name a key of the model, as feature.channel.width, or seed", path.display())]
    Column {
        /// The file.
        path: PathBuf,
        /// Its number.
        column: usize,
        /// What is wrong with its name.
        what: String,
    },
    /// A value is wrong.
    #[error("{}, row {row} (line {line}), column `{column}`: {message}; {remedy}", path.display())]
    Cell {
        /// The file.
        path: PathBuf,
        /// Number of the row, from 1, the first line not counted.
        row: usize,
        /// Its line.
        line: u64,
        /// The column.
        column: String,
        /// What is wrong.
        message: String,
        /// What to do.
        remedy: String,
    },
    /// Values of a row do not go together, or with the model.
    #[error("{}, row {row} (line {line}): its values together are no model: {message}; {remedy}", path.display())]
    Together {
        /// The file.
        path: PathBuf,
        /// Number of the row.
        row: usize,
        /// Its line.
        line: u64,
        /// What is wrong.
        message: String,
        /// What to do.
        remedy: String,
    },
}

impl Design {
    /// Reads a table.
    pub fn read(path: &Path) -> Result<Self, DesignError> {
        let bytes = std::fs::read(path).map_err(|source| DesignError::Unreadable {
            path: path.to_owned(),
            source,
        })?;
        Self::from_bytes(path, &bytes)
    }

    /// The table that these bytes hold; `path` stands in messages.
    pub fn from_bytes(path: &Path, bytes: &[u8]) -> Result<Self, DesignError> {
        let no_table = |error: &csv::Error| DesignError::NoTable {
            path: path.to_owned(),
            line: error.position().map_or(1, csv::Position::line),
            message: error.to_string(),
        };
        // A byte order mark, as spreadsheets write it, is no part of the first name.
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .comment(Some(b'#'))
            .from_reader(bytes);
        let names: Vec<String> = {
            let header = reader.headers().map_err(|error| no_table(&error))?;
            header.iter().map(str::to_owned).collect()
        };
        check_names(path, &names)?;
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| no_table(&error))?;
            let line = record.position().map_or(0, |start| line_of(bytes, start));
            rows.push(row(path, &names, rows.len() + 1, line, &record)?);
        }
        if rows.is_empty() || rows.len() > MOST_ROWS {
            let (path, rows) = (path.to_owned(), rows.len());
            return Err(DesignError::Rows { path, rows });
        }
        Ok(Self {
            path: path.to_owned(),
            keys: names.into_iter().filter(|name| name != SEED).collect(),
            rows,
        })
    }

    /// The keys and values of a row.
    pub fn values<'a>(&'a self, row: &'a Row) -> impl Iterator<Item = (&'a str, &'a str)> {
        let keys = self.keys.iter().map(String::as_str);
        keys.zip(row.values.iter().map(String::as_str))
    }

    /// Checks that each row makes a model of `source`; of the first one that does not it tells the column.
    pub fn check(&self, source: &Source) -> Result<(), DesignError> {
        let rows: Vec<(usize, &Row)> = self.rows.iter().enumerate().collect();
        let wrong = rows.par_iter().find_map_first(|(at, row)| {
            let values: Vec<_> = self.values(row).collect();
            let together = defect(source, &values)?;
            let cell = values.iter().find_map(|one| {
                let alone = defect(source, std::slice::from_ref(one))?;
                Some((one.0, alone))
            });
            let (path, row, line) = (self.path.clone(), at + 1, row.line);
            Some(match cell {
                Some((column, defect)) => DesignError::Cell {
                    path,
                    row,
                    line,
                    column: column.to_owned(),
                    message: defect.message().to_owned(),
                    remedy: defect.remedy().to_owned(),
                },
                None => DesignError::Together {
                    path,
                    row,
                    line,
                    message: together.message().to_owned(),
                    remedy: together.remedy().to_owned(),
                },
            })
        });
        wrong.map_or(Ok(()), Err)
    }
}

/// The first defect of a model with these values.
fn defect(source: &Source, values: &[(&str, &str)]) -> Option<Defect> {
    let mut source = source.clone();
    for (key, value) in values {
        source.set(format!("{key}={value}"));
    }
    let defects = Model::check(&source).err()?;
    defects.iter().next().cloned()
}

/// The line on which a record stands whose reading began here: what is left out before it counts, too.
fn line_of(bytes: &[u8], start: &csv::Position) -> u64 {
    let at = usize::try_from(start.byte()).unwrap_or(usize::MAX);
    let rest = bytes.get(at..).unwrap_or_default();
    let is_none = |line: &&[u8]| line.starts_with(b"#") || line.trim_ascii().is_empty();
    let before = rest.split(|byte| *byte == b'\n').take_while(is_none);
    start.line() + before.count() as u64
}

fn check_names(path: &Path, names: &[String]) -> Result<(), DesignError> {
    for (at, name) in names.iter().enumerate() {
        let what = if name.is_empty() {
            "has no name".to_owned()
        } else if let Some(first) = names[..at].iter().position(|other| other == name) {
            format!("has the name of column {}, `{name}`", first + 1)
        } else if name.contains('=') {
            format!("is named `{name}`, which is no key")
        } else {
            continue;
        };
        return Err(DesignError::Column {
            path: path.to_owned(),
            column: at + 1,
            what,
        });
    }
    Ok(())
}

fn row(
    path: &Path,
    names: &[String],
    number: usize,
    line: u64,
    record: &csv::StringRecord,
) -> Result<Row, DesignError> {
    let wrong = |column: &str, message: String, remedy: &str| DesignError::Cell {
        path: path.to_owned(),
        row: number,
        line,
        column: column.to_owned(),
        message,
        remedy: remedy.to_owned(),
    };
    let mut row = Row {
        line,
        seed: None,
        values: Vec::new(),
    };
    for (name, value) in names.iter().zip(record) {
        if value.is_empty() {
            let remedy = "write a value in each row, that of the model where it is not to change";
            return Err(wrong(name, "the cell is empty".to_owned(), remedy));
        }
        if name == SEED {
            let seed = value.parse().map_err(|_| {
                let message = format!("`{value}` is no seed");
                wrong(name, message, "write a whole number from 0")
            })?;
            row.seed = Some(seed);
        } else {
            row.values.push(value.to_owned());
        }
    }
    Ok(row)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::model::{Format, Template};

    fn design(text: &str) -> Result<Design, String> {
        Design::from_bytes(Path::new("design.csv"), text.as_bytes()).map_err(|e| e.to_string())
    }

    fn source() -> Source {
        let text = Template::find("quickstart").unwrap().text;
        Source::from_text("quickstart.toml", text, Format::Toml)
    }

    #[test]
    fn a_row_has_its_seed_and_a_value_of_each_key() {
        let text = "\u{feff}seed, feature.old-channel.width ,domain.z\r\n# of the wells\r\n7,30,\"[-40, 0]\"\r\n8,35,\"[-20, 0]\"\r\n";
        let design = design(text).unwrap();
        assert_eq!(design.keys, ["feature.old-channel.width", "domain.z"]);
        assert_eq!(design.rows[0].seed, Some(7));
        assert_eq!(design.rows[1].values, ["35", "[-20, 0]"]);
        assert_eq!(design.rows[1].line, 4);
        design.check(&source()).unwrap();
    }

    #[test]
    fn what_is_no_table_is_told_with_its_line() {
        for (text, told) in [
            ("", "has 0 rows"),
            ("a,b\n", "has 0 rows"),
            ("a,,c\n1,2,3\n", "column 2 has no name"),
            ("a,b,a\n1,2,3\n", "column 3 has the name of column 1, `a`"),
            ("a=3,b\n1,2\n", "column 1 is named `a=3`"),
            ("a,b\n1,2\n3\n", "line 3"),
            (
                "seed,b\n1,2\n-3,4\n",
                "row 2 (line 3), column `seed`: `-3` is no seed",
            ),
            (
                "a,b\n1,2\n3,\n",
                "row 2 (line 3), column `b`: the cell is empty",
            ),
        ] {
            let error = design(text).unwrap_err();
            assert!(error.contains(told), "{text:?}: {error}");
        }
    }

    #[test]
    fn what_is_no_model_is_told_with_row_and_column() {
        let told = |text: &str| {
            design(text)
                .unwrap()
                .check(&source())
                .unwrap_err()
                .to_string()
        };
        let unknown = told("feature.old-chanel.width\n30\n");
        assert!(
            unknown.starts_with("design.csv, row 1 (line 2), column `feature.old-chanel.width`:")
                && unknown.contains("did you mean \"old-channel\"?"),
            "{unknown}"
        );
        let wrong =
            told("feature.old-channel.width,feature.old-channel.depth\n30,4\n31,-5\n32,x\n");
        assert!(
            wrong.starts_with("design.csv, row 2 (line 3), column `feature.old-channel.depth`:"),
            "{wrong}"
        );
        // Each by itself is right: a domain from -10 to 0, or from -20 to -12.
        let together = told("domain.z.1,domain.z.2\n-30,5\n-10,-12\n");
        let start = "design.csv, row 2 (line 3): its values together are no model:";
        assert!(together.starts_with(start), "{together}");
    }
}
