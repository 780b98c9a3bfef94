//! A file's columns by their names, before it is known what they mean.

use super::columns::{Column, Row, SurveyFormat, SurveyReading, SurveyTable};
use super::error::SurveyFileError;
use crate::data::text;

/// A file's columns by their names.
pub(super) struct Raw {
    pub(super) head: Option<[f64; 2]>,
    pub(super) datum: Option<f64>,
    pub(super) unit: Option<String>,
    pub(super) null: Option<f64>,
    pub(super) header_line: usize,
    pub(super) header: Vec<String>,
    /// Lines with their cells.
    pub(super) rows: Vec<(usize, Vec<String>)>,
}

/// Cells that stand for no data.
const NONE: [&str; 5] = ["", "nan", "null", "none", "-"];

impl Raw {
    /// The columns that mean something, and the rows that have a value in all of them.
    pub(super) fn into_table(
        self,
        format: SurveyFormat,
        reading: &SurveyReading,
    ) -> Result<SurveyTable, SurveyFileError> {
        let mut columns: Vec<(Column, usize)> = Vec::new();
        for column in Column::ALL {
            let given = reading.columns.iter().find(|(own, _)| *own == column);
            let place = match given {
                None => column.place(&self.header),
                Some((_, name)) => Some(self.named(name)?),
            };
            columns.extend(place.map(|place| (column, place)));
        }
        if columns.is_empty() {
            return Err(SurveyFileError::NoColumns {
                line: self.header_line,
                found: self.header.join(", "),
            });
        }
        let is_true_north = columns.iter().any(|(column, at)| {
            *column == Column::Azimuth && self.header[*at].eq_ignore_ascii_case("azim_tn")
        });
        let (mut rows, mut dropped) = (Vec::with_capacity(self.rows.len()), 0);
        for (line, cells) in &self.rows {
            let mut values = Vec::with_capacity(columns.len());
            for (column, at) in &columns {
                let Some(cell) = cells.get(*at) else {
                    return Err(SurveyFileError::Row {
                        line: *line,
                        found: cells.len(),
                        needed: self.header.len(),
                    });
                };
                values.extend(self.number(*line, *column, cell)?);
            }
            if values.len() == columns.len() {
                rows.push(Row {
                    line: *line,
                    values,
                });
            } else {
                dropped += 1;
            }
        }
        if rows.is_empty() {
            return Err(SurveyFileError::NoRows { dropped });
        }
        Ok(SurveyTable {
            format,
            head: self.head,
            datum: self.datum,
            unit: self.unit,
            is_true_north,
            columns: columns.into_iter().map(|(column, _)| column).collect(),
            rows,
            dropped,
        })
    }

    /// The place of a column by its name, or by its number from 1.
    fn named(&self, name: &str) -> Result<usize, SurveyFileError> {
        let by_name = self
            .header
            .iter()
            .position(|own| own.eq_ignore_ascii_case(name));
        let number = name.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
        by_name
            .or(number.filter(|at| *at < self.header.len()))
            .ok_or_else(|| SurveyFileError::Column {
                line: self.header_line,
                column: name.to_owned(),
                found: self.header.join(", "),
            })
    }

    /// What a cell holds; nothing if it stands for no data.
    fn number(
        &self,
        line: usize,
        column: Column,
        cell: &str,
    ) -> Result<Option<f64>, SurveyFileError> {
        if NONE.iter().any(|none| cell.eq_ignore_ascii_case(none)) {
            return Ok(None);
        }
        let decimal = if cell.contains('.') {
            cell.to_owned()
        } else {
            cell.replace(',', ".")
        };
        match text::number(&decimal) {
            Some(value) => Ok((self.null != Some(value)).then_some(value)),
            None => Err(SurveyFileError::Number {
                line,
                column: column.word(),
                found: cell.chars().take(40).collect(),
            }),
        }
    }
}
