//! What tables are made of.

/// A table: named columns, and rows of as many cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Its name, which is that of its file, too.
    pub name: &'static str,
    /// The columns' names, with units: `volume_m3`.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<Cell>>,
}

/// What stands in one place of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Nothing: it is not known.
    Empty,
    /// Words.
    Text(String),
    /// A whole number.
    Whole(u64),
    /// A number with all its digits.
    Number(f64),
    /// A number with so many decimals.
    Rounded(f64, usize),
}

impl Cell {
    /// Words, or nothing.
    pub fn words(text: Option<&str>) -> Self {
        text.map_or(Self::Empty, |text| Self::Text(text.to_owned()))
    }

    /// A volume in m³, or nothing.
    pub fn volume(value: Option<f64>) -> Self {
        value.map_or(Self::Empty, |value| Self::Rounded(value, 6))
    }

    /// A share of something, or nothing.
    pub fn share(value: Option<f64>) -> Self {
        value.map_or(Self::Empty, |value| Self::Rounded(value, 9))
    }

    /// A number, or nothing.
    pub fn number(value: Option<f64>) -> Self {
        value.map_or(Self::Empty, Self::Number)
    }

    /// How many.
    pub fn count(count: usize) -> Self {
        Self::Whole(count as u64)
    }

    /// As text: of a number the fewest digits that give it back, or the decimals that it has.
    pub fn text(&self) -> String {
        match self {
            Self::Empty => String::new(),
            Self::Text(text) => text.clone(),
            Self::Whole(value) => value.to_string(),
            Self::Number(value) => format!("{value:?}"),
            Self::Rounded(value, decimals) => format!("{value:.decimals$}"),
        }
    }

    /// Its number, as its text has it.
    pub fn value(&self) -> Option<f64> {
        match self {
            Self::Empty | Self::Text(_) => None,
            Self::Number(value) => Some(*value),
            Self::Whole(_) | Self::Rounded(..) => self.text().parse().ok(),
        }
    }
}

/// The names of columns.
pub(super) fn columns(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// Words.
pub(super) fn text(text: &str) -> Cell {
    Cell::Text(text.to_owned())
}
