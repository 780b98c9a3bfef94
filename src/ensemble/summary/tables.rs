//! The tables of a summary, with commas between their values.

use super::columns::Role;
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

/// A line for each realisation that was made. What was drawn has `drawn.` before its name, so that no measure has the same.
pub fn realisations(summary: &Summary) -> Result<String, ExportError> {
    let table = &summary.table;
    let mut header = texts(["realisation", "scenario", "number", "seed"]);
    let mut keys: Vec<&str> = Vec::new();
    for row in &table.rows {
        for (key, _) in &row.design {
            if !keys.contains(&key.as_str()) {
                keys.push(key);
            }
        }
    }
    header.extend(keys.iter().map(|key| format!("design.{key}")));
    let numbers: Vec<usize> = (0..table.columns.len())
        .filter(|at| table.columns[*at].role != Role::Design)
        .collect();
    header.extend(numbers.iter().map(|at| match &table.columns[*at] {
        column if column.role == Role::Drawn => format!("drawn.{}", column.name),
        column => column.name.clone(),
    }));
    let rows = table.rows.iter().map(|row| {
        let mut line = vec![
            row.name.clone(),
            row.scenario.clone().unwrap_or_default(),
            row.number.to_string(),
            row.seed.to_string(),
        ];
        line.extend(keys.iter().map(|key| {
            let found = row.design.iter().find(|(own, _)| own == key);
            found.map(|(_, value)| value.clone()).unwrap_or_default()
        }));
        line.extend(
            numbers
                .iter()
                .map(|at| row.values[*at].map(number).unwrap_or_default()),
        );
        line
    });
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
