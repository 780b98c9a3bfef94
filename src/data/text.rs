//! Lines and numbers as files of many programs have them.

use super::error::DataError;

/// The lines that say something, with their numbers from 1: neither blank nor comments (`!`, `#`).
pub(super) fn uncommented(text: &str) -> impl Iterator<Item = (usize, &str)> {
    lines(text).filter(|(_, line)| !line.starts_with(['!', '#']))
}

/// The lines that are not blank, without blanks around, with their numbers from 1.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    // Files of old systems end lines with a carriage return alone; those have no line feeds.
    let separator = if text.contains('\n') { '\n' } else { '\r' };
    text.split(separator)
        .enumerate()
        .map(|(at, line)| (at + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty())
}

/// A finite number; exponents may be written with a D, as Fortran does.
pub(super) fn number(word: &str) -> Option<f64> {
    let plain = word.parse::<f64>().or_else(|_| {
        let exponent = |c: char| if matches!(c, 'D' | 'd') { 'E' } else { c };
        word.chars().map(exponent).collect::<String>().parse()
    });
    plain.ok().filter(|number: &f64| number.is_finite())
}

/// All numbers of a line between blanks, commas or semicolons; `None` if a word is none.
pub(super) fn numbers(line: &str) -> Option<Vec<f64>> {
    words(line).map(number).collect()
}

/// The words of a line.
pub(super) fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split([' ', '\t', ',', ';'])
        .filter(|word| !word.is_empty())
}

/// The words of the uncommented lines after one, with their lines.
pub(super) fn words_after(text: &str, last: usize) -> impl Iterator<Item = (usize, &str)> {
    uncommented(text)
        .filter(move |(line, _)| *line > last)
        .flat_map(|(line, found)| words(found).map(move |word| (line, word)))
}

/// The number that a word is, or an error with its line.
pub(super) fn need(word: &str, line: usize) -> Result<f64, DataError> {
    number(word).ok_or_else(|| DataError::Number {
        line,
        found: word.chars().take(40).collect(),
    })
}

/// What a header line should have: so many numbers, after whatever words.
pub(super) fn header<const N: usize>(
    line: (usize, &str),
    expected: &'static str,
) -> Result<[f64; N], DataError> {
    let wrong = || DataError::header(line, expected);
    let mut values = [0.0; N];
    let mut rest = words(line.1).filter_map(number);
    for value in &mut values {
        *value = rest.next().ok_or_else(wrong)?;
    }
    Ok(values)
}

/// A number of columns or rows: a whole number of at least 2.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be a whole number between 2 and 2^32"
)]
pub(super) fn count(value: f64, what: &str, line: usize) -> Result<usize, DataError> {
    if value.fract() == 0.0 && (2.0..4_294_967_296.0).contains(&value) {
        return Ok(value as usize);
    }
    let what = format!("the number of {what} is {value}; a grid has at least 2");
    Err(DataError::Geometry { line, what })
}

/// From one node to the next: above 0.
pub(super) fn step(value: f64, what: &str, line: usize) -> Result<f64, DataError> {
    if value > 0.0 {
        return Ok(value);
    }
    let what = format!("from one {what} to the next it is {value}, which must be above 0");
    Err(DataError::Geometry { line, what })
}

/// Heights of a grid that follow its header, however they are broken into lines: as many as there are nodes, and no more.
pub(super) struct Values<'a, I: Iterator<Item = (usize, &'a str)>> {
    /// Words with their lines.
    pub(super) words: I,
    /// The line after which they begin.
    pub(super) line: usize,
    /// How many bytes there are: no file has more heights than that.
    pub(super) bytes: usize,
    /// Columns and rows.
    pub(super) counts: [usize; 2],
}

impl<'a, I: Iterator<Item = (usize, &'a str)>> Values<'a, I> {
    /// The heights in the order of the file; `is_null` tells which stand for no data.
    pub(super) fn read(
        mut self,
        is_null: impl Fn(f64) -> bool,
    ) -> Result<Vec<Option<f64>>, DataError> {
        let [columns, rows] = self.counts;
        let needed = columns.saturating_mul(rows);
        let mut heights = Vec::with_capacity(needed.min(self.bytes));
        let mut last = self.line;
        while heights.len() < needed {
            let Some((line, word)) = self.words.next() else {
                return Err(DataError::Short {
                    line: last,
                    found: heights.len(),
                    needed: format!("{needed} heights ({columns} columns, {rows} rows)"),
                });
            };
            last = line;
            if word.eq_ignore_ascii_case("nan") {
                heights.push(None);
                continue;
            }
            let value = need(word, line)?;
            heights.push((!is_null(value)).then_some(value));
        }
        match self.words.next() {
            None => Ok(heights),
            Some((line, word)) => Err(DataError::Long {
                line,
                needed,
                found: word.chars().take(40).collect(),
            }),
        }
    }
}
