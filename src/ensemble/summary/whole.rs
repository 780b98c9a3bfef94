//! What is said of all realisations together.

use std::collections::BTreeMap;

use serde::Serialize;

use super::columns::{Table, Told};
use crate::ensemble::member::Member;
use crate::ensemble::statistics::{FEW, Spread, rank_correlation};
use crate::ensemble::workers::End;

/// What of a realisation is preferred as its result, if it is not said: the first that all realisations have.
const RESULTS: [&str; 3] = ["pore_volume_m3", "net_volume_m3", "net_to_gross"];

/// Of how many parameters a tornado plot tells.
pub const TORNADO: usize = 15;

/// The fewest realisations over which ranks are correlated.
const LEAST_RANKED: usize = 3;

/// An ensemble's summary.
#[derive(Clone, Debug)]
pub struct Summary {
    /// What the model is called.
    pub model: String,
    /// All realisations that were made, with what their reports say.
    pub table: Table,
    /// What the plots are about.
    pub result: String,
    /// One for each scenario, in their order; a single one without a name if there are none.
    pub scenarios: Vec<OfScenario>,
    /// What was not made.
    pub unmade: Vec<Unmade>,
}

/// What is said of one scenario.
#[derive(Clone, Debug)]
pub struct OfScenario {
    /// Its name.
    pub name: Option<String>,
    /// How many of its realisations were made.
    pub made: usize,
    /// How many there are.
    pub of: usize,
    /// Of each measure, its spread.
    pub spreads: Vec<(String, Spread)>,
    /// The realisation whose result is nearest to the P50, and that result.
    pub nearest: Option<(String, f64)>,
    /// Parameters by how strongly the result's ranks go with theirs, the strongest first.
    pub correlations: Vec<Correlation>,
}

/// How the ranks of the result go with those of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Correlation {
    /// The parameter.
    pub parameter: String,
    /// Spearman's rank correlation.
    pub rank_correlation: f64,
    /// Over how many realisations.
    pub n: usize,
}

/// A realisation that was not made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Unmade {
    /// Its name.
    pub realisation: String,
    /// Its seed.
    pub seed: u64,
    /// What became of it, in a word.
    pub outcome: String,
    /// The reason.
    pub words: String,
}

/// Why there is no summary.
#[derive(Debug, thiserror::Error)]
pub enum SummaryError {
    /// There is no such measure.
    #[error("the realisations have no measure `{name}`; the measures are: {}", known.join(", "))]
    NoMeasure {
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
}

impl Summary {
    /// Of members and how they ended, those made with what their reports say; `result` is what the plots are to be about.
    pub fn new(
        model: &str,
        members: &[(&Member, &End, Option<Told>)],
        result: Option<&str>,
    ) -> Result<Self, SummaryError> {
        let made = members
            .iter()
            .filter_map(|(member, _, told)| Some((*member, told.as_ref()?)));
        let table = Table::of(made);
        let result = match result {
            Some(name) if table.measure(name).is_none() && !table.rows.is_empty() => {
                return Err(SummaryError::NoMeasure {
                    name: name.to_owned(),
                    known: table.measures().map(|(_, name)| name.to_owned()).collect(),
                });
            }
            Some(name) => name.to_owned(),
            None => table.preferred(&RESULTS),
        };
        let mut names: Vec<Option<String>> = Vec::new();
        for (member, ..) in members {
            if !names.contains(&member.scenario) {
                names.push(member.scenario.clone());
            }
        }
        let scenarios = names
            .into_iter()
            .map(|name| {
                let of = members
                    .iter()
                    .filter(|(member, ..)| member.scenario == name);
                OfScenario::new(&table, &result, name.clone(), of.count())
            })
            .collect();
        let unmade = members
            .iter()
            .filter(|(.., told)| told.is_none())
            .map(|(member, end, _)| Unmade {
                realisation: member.name(),
                seed: member.seed,
                outcome: end.word().to_owned(),
                words: end.words(),
            })
            .collect();
        Ok(Self {
            model: model.to_owned(),
            table,
            result,
            scenarios,
            unmade,
        })
    }

    /// What is to be kept in mind with these numbers.
    pub fn warnings(&self) -> Vec<String> {
        let few = self.scenarios.iter().filter(|one| one.made < FEW);
        few.map(|one| {
            let of = one
                .name
                .as_ref()
                .map_or(String::new(), |name| format!(" of {name}"));
            format!(
                "{} realisation(s){of} are too few for P90 and P10: each decides them; make {FEW} or more",
                one.made
            )
        })
        .collect()
    }

    /// The summary as JSON, without the table, with a line break at its end.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        let scenario = |one: &OfScenario| {
            let spreads: BTreeMap<&str, serde_json::Value> = one
                .spreads
                .iter()
                .map(|(name, spread)| (name.as_str(), exceedance(spread)))
                .collect();
            serde_json::json!({
                "scenario": one.name,
                "realisations": one.of,
                "made": one.made,
                "exceedance": spreads,
                "nearest_p50": one.nearest.as_ref().map(|(name, value)| {
                    serde_json::json!({ "realisation": name, "value": value })
                }),
                "rank_correlations": one.correlations,
            })
        };
        let summary = serde_json::json!({
            "schema": "clinothem-ensemble-1",
            "model": self.model,
            "result": self.result,
            "scenarios": self.scenarios.iter().map(scenario).collect::<Vec<_>>(),
            "unmade": self.unmade,
            "warnings": self.warnings(),
        });
        Ok(serde_json::to_string_pretty(&summary)? + "\n")
    }
}

fn exceedance(spread: &Spread) -> serde_json::Value {
    serde_json::json!({
        "n": spread.n,
        "min": spread.min,
        "low_p90": spread.low_p90,
        "mid_p50": spread.mid_p50,
        "high_p10": spread.high_p10,
        "max": spread.max,
        "mean": spread.mean,
        "standard_deviation": spread.deviation,
    })
}

impl OfScenario {
    fn new(table: &Table, result: &str, name: Option<String>, of: usize) -> Self {
        let rows: Vec<_> = table
            .rows
            .iter()
            .filter(|row| row.scenario == name)
            .collect();
        let column =
            |at: usize| -> Vec<Option<f64>> { rows.iter().map(|row| row.values[at]).collect() };
        let spreads = table
            .measures()
            .filter_map(|(at, measure)| {
                let values: Vec<f64> = column(at).into_iter().flatten().collect();
                Some((measure.to_owned(), Spread::of(&values)?))
            })
            .collect::<Vec<_>>();
        let results = table.measure(result).map(column).unwrap_or_default();
        let middle = spreads
            .iter()
            .find(|(measure, _)| measure == result)
            .map(|(_, spread)| spread.mid_p50);
        let nearest = middle.and_then(|middle| {
            let named = rows.iter().zip(&results);
            let named = named.filter_map(|(row, value)| Some((&row.name, (*value)?)));
            let distance = |value: f64| (value - middle).abs();
            named
                // The first of several that are equally near.
                .min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))
                .map(|(name, value)| (name.clone(), value))
        });
        let mut correlations: Vec<Correlation> = table
            .parameters()
            .filter_map(|(at, parameter)| {
                let pairs = column(at).into_iter().zip(&results);
                let pairs: Vec<(f64, f64)> = pairs.filter_map(|(x, y)| Some((x?, (*y)?))).collect();
                // What few realisations have goes with anything.
                let is_common = pairs.len() >= LEAST_RANKED && 2 * pairs.len() >= rows.len();
                let rank_correlation = rank_correlation(&pairs).filter(|_| is_common)?;
                Some(Correlation {
                    parameter: parameter.to_owned(),
                    rank_correlation,
                    n: pairs.len(),
                })
            })
            .collect();
        let strength = |one: &Correlation| -one.rank_correlation.abs();
        correlations.sort_by(|a, b| strength(a).total_cmp(&strength(b)));
        Self {
            name,
            made: rows.len(),
            of,
            spreads,
            nearest,
            correlations,
        }
    }

    /// The spread of a measure.
    pub fn spread(&self, measure: &str) -> Option<&Spread> {
        let found = self.spreads.iter().find(|(name, _)| name == measure);
        found.map(|(_, spread)| spread)
    }
}
