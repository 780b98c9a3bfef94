//! The tables of a summary, with commas between their values.

use super::columns::{Role, Row};
use super::whole::Summary;
use crate::ensemble::statistics::Spread;
use crate::export::{ExportError, rows};

fn csv(lines: impl IntoIterator<Item = Vec<String>>) -> Result<String, ExportError> {
    rows::csv(lines).map_err(|error| ExportError::Table(error.to_string()))
}

fn texts<const N: usize>(words: [&str; N]) -> Vec<String> {
    words.map(str::to_owned).to_vec()
}

/// A number with as many digits as give it back.
fn number(value: f64) -> String {
    format!("{value}")
}

/// A column of the table of realisations.
pub(super) struct Values<'a> {
    /// Its name. What was drawn has `drawn.` before it, so that no measure has the same.
    pub(super) name: String,
    /// A value of each realisation.
    pub(super) of: Kind<'a>,
}

/// What a column holds.
pub(super) enum Kind<'a> {
    Text(Vec<Option<&'a str>>),
    Whole(Vec<u64>),
    Number(Vec<Option<f64>>),
}

/// The table of the realisations that were made, column by column.
pub(super) fn columns(summary: &Summary) -> Vec<Values<'_>> {
    let table = &summary.table;
    let rows = || table.rows.iter();
    let mut columns = vec![
        Values {
            name: "realisation".to_owned(),
            of: Kind::Text(rows().map(|row| Some(row.name.as_str())).collect()),
        },
        Values {
            name: "scenario".to_owned(),
            of: Kind::Text(rows().map(|row| row.scenario.as_deref()).collect()),
        },
        Values {
            name: "number".to_owned(),
            of: Kind::Whole(rows().map(|row| row.number as u64).collect()),
        },
        Values {
            name: "seed".to_owned(),
            of: Kind::Whole(rows().map(|row| row.seed).collect()),
        },
    ];
    let mut keys: Vec<&str> = Vec::new();
    for (key, _) in rows().flat_map(|row| &row.design) {
        if !keys.contains(&key.as_str()) {
            keys.push(key);
        }
    }
    for key in keys {
        let of = |row: &'_ Row| row.design.iter().position(|(own, _)| own == key);
        let values = rows().map(|row| Some(row.design[of(row)?].1.as_str()));
        columns.push(Values {
            name: format!("design.{key}"),
            of: Kind::Text(values.collect()),
        });
    }
    for (at, column) in table.columns.iter().enumerate() {
        let name = match column.role {
            Role::Design => continue,
            Role::Drawn => format!("drawn.{}", column.name),
            Role::Measure => column.name.clone(),
        };
        let values = rows().map(|row| row.values[at]).collect();
        columns.push(Values {
            name,
            of: Kind::Number(values),
        });
    }
    columns
}

impl Kind<'_> {
    /// The value of a row, as it is written; nothing if it has none.
    fn written(&self, row: usize) -> String {
        match self {
            Self::Text(values) => values[row].unwrap_or_default().to_owned(),
            Self::Whole(values) => values[row].to_string(),
            Self::Number(values) => values[row].map(number).unwrap_or_default(),
        }
    }
}

/// A line for each realisation that was made.
pub fn realisations(summary: &Summary) -> Result<String, ExportError> {
    let columns = columns(summary);
    let header = columns.iter().map(|column| column.name.clone()).collect();
    let line = |row: usize| -> Vec<String> {
        let cells = columns.iter();
        cells.map(|column| column.of.written(row)).collect()
    };
    let rows = (0..summary.table.rows.len()).map(line);
    csv(std::iter::once(header).chain(rows))
}

/// A line for each measure of each scenario.
pub fn quantiles(summary: &Summary) -> Result<String, ExportError> {
    let header = texts([
        "scenario",
        "measure",
        "n",
        "min",
        "low_p90",
        "mid_p50",
        "high_p10",
        "max",
        "mean",
        "standard_deviation",
    ]);
    let rows = summary.scenarios.iter().flat_map(|scenario| {
        let name = scenario.name.clone().unwrap_or_default();
        scenario.spreads.iter().map(move |(measure, spread)| {
            let Spread {
                n,
                min,
                low_p90,
                mid_p50,
                high_p10,
                max,
                mean,
                deviation,
            } = *spread;
            let mut line = vec![name.clone(), measure.clone(), n.to_string()];
            line.extend([min, low_p90, mid_p50, high_p10, max, mean].map(number));
            line.push(deviation.map(number).unwrap_or_default());
            line
        })
    });
    csv(std::iter::once(header).chain(rows))
}

/// A line for each parameter of each scenario, the strongest first.
pub fn correlations(summary: &Summary) -> Result<String, ExportError> {
    let header = texts(["scenario", "result", "parameter", "rank_correlation", "n"]);
    let rows = summary.scenarios.iter().flat_map(|scenario| {
        scenario.correlations.iter().map(|one| {
            vec![
                scenario.name.clone().unwrap_or_default(),
                summary.result.clone(),
                one.parameter.clone(),
                number(one.rank_correlation),
                one.n.to_string(),
            ]
        })
    });
    csv(std::iter::once(header).chain(rows))
}

/// A line for each realisation that was not made.
pub fn unmade(summary: &Summary) -> Result<String, ExportError> {
    let header = texts(["realisation", "seed", "outcome", "words"]);
    let rows = summary.unmade.iter().map(|one| {
        vec![
            one.realisation.clone(),
            one.seed.to_string(),
            one.outcome.clone(),
            one.words.clone(),
        ]
    });
    csv(std::iter::once(header).chain(rows))
}
