//! Which realisations an ensemble has: seeds, strata or rows of a design table, in each scenario.

use std::path::{Path, PathBuf};

use super::args::ModelArgs;
use super::failure::Failure;
use super::{load, print, scenarios};
use crate::ensemble::Member;
use crate::ensemble::design::Design;
use crate::ensemble::member::{Changes, Scenario};
use crate::model::{Model, Source, Stratum};

/// Reads `A..B`.
fn seeds(text: &str) -> Result<(u64, u64), String> {
    let ends = text
        .split_once("..")
        .and_then(|(first, last)| Some((first.parse().ok()?, last.parse().ok()?)));
    match ends {
        Some((first, last)) if first <= last && last - first < 1_000_000 => Ok((first, last)),
        _ => Err(format!(
            "`{text}` are no seeds; write the first and the last, at most a million of them, as 1..100"
        )),
    }
}

/// Which realisations are made.
#[derive(Debug, clap::Args)]
pub(super) struct MemberArgs {
    #[command(flatten)]
    pub(super) model: ModelArgs,
    /// How many realisations, with the model's seed (or --seed) and those after it.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    n: Option<u32>,
    /// The seeds, the first and the last.
    #[arg(long, value_name = "A..B", value_parser = seeds, conflicts_with_all = ["n", "seed"])]
    seeds: Option<(u64, u64)>,
    /// A table with a row for each realisation: columns are keys of the model, and seed.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["n", "seeds", "latin_hypercube"])]
    design: Option<PathBuf>,
    /// Draw each parameter once from every n-th of its distribution (a Latin hypercube), not at random.
    #[arg(long)]
    latin_hypercube: bool,
    /// A variant of the model, drawn with the same seeds: 'NAME: --without ID --set KEY=VALUE --max-level N'; repeatable.
    #[arg(long, value_name = "SCENARIO", value_parser = scenarios::read)]
    scenario: Vec<Scenario>,
}

impl MemberArgs {
    /// What is to be made: for each scenario, each seed or row.
    pub(super) fn all(&self, model: &Model) -> Result<Vec<Member>, Failure> {
        let common = Changes {
            set: self.model.set.clone(),
            without: self.model.without.clone(),
            max_level: self.model.max_level,
        };
        if self.model.stratum.is_some() {
            return Err(Failure::Wrong(
                "--stratum is of one realisation; of an ensemble write --latin-hypercube"
                    .to_owned(),
            ));
        }
        if self.model.parameters.is_some() {
            return Err(Failure::Wrong(
                "--parameters is of one realisation; of an ensemble write --design, or --set"
                    .to_owned(),
            ));
        }
        let plain = match (&self.design, self.seeds, self.n) {
            (Some(path), ..) => self.designed(path, model.seed)?,
            (None, seeds, n) => {
                let (first, count) = match (seeds, n) {
                    (Some((first, last)), _) => (first, last - first + 1),
                    (None, Some(n)) => (model.seed, u64::from(n)),
                    (None, None) => {
                        return Err(Failure::Wrong(
                            "how many realisations? write -n 100, --seeds 1..100 or --design FILE"
                                .to_owned(),
                        ));
                    }
                };
                self.drawn(first, count)?
            }
        };
        let mut scenarios: Vec<Option<&Scenario>> = self.scenario.iter().map(Some).collect();
        if scenarios.is_empty() {
            scenarios.push(None);
        }
        let of = |scenario: Option<&Scenario>| {
            let changes = scenario.map_or_else(|| common.clone(), |one| common.and(&one.changes));
            let name = scenario.map(|one| one.name.clone());
            let one = move |member: &Member| Member {
                scenario: name.clone(),
                changes: changes.and(&member.changes),
                ..member.clone()
            };
            plain.iter().map(one).collect::<Vec<_>>()
        };
        Ok(scenarios.into_iter().flat_map(of).collect())
    }

    fn drawn(&self, first: u64, count: u64) -> Result<Vec<Member>, Failure> {
        if first.checked_add(count).is_none() {
            return Err(Failure::Wrong(format!(
                "seeds end at {}; begin with a smaller one than {first}",
                u64::MAX
            )));
        }
        let member = |at: u64| Member {
            number: usize::try_from(at).unwrap_or(usize::MAX).saturating_add(1),
            scenario: None,
            seed: first + at,
            stratum: self
                .latin_hypercube
                .then(|| Stratum::new(at + 1, count))
                .flatten(),
            design: Vec::new(),
            changes: Changes::default(),
        };
        Ok((0..count).map(member).collect())
    }

    /// The members of a design table, which is checked as a whole, in each scenario's model.
    fn designed(&self, path: &Path, seed: u64) -> Result<Vec<Member>, Failure> {
        let design = Design::read(path).map_err(|error| Failure::Wrong(error.to_string()))?;
        let mut plain = self.source()?;
        for assignment in &self.model.set {
            plain.set(assignment.clone());
        }
        let mut sources = vec![plain.clone()];
        for scenario in &self.scenario {
            let mut source = plain.clone();
            for assignment in &scenario.changes.set {
                source.set(assignment.clone());
            }
            sources.push(source);
        }
        for source in &sources {
            design
                .check(source)
                .map_err(|error| Failure::Wrong(error.to_string()))?;
        }
        let member = |(at, row): (usize, &crate::ensemble::design::Row)| {
            let values = design.values(row);
            let design: Vec<(String, String)> = values
                .map(|(key, value)| (key.to_owned(), value.to_owned()))
                .collect();
            Member {
                number: at + 1,
                scenario: None,
                seed: row.seed.unwrap_or(seed),
                stratum: None,
                changes: Changes {
                    set: design
                        .iter()
                        .map(|(key, value)| format!("{key}={value}"))
                        .collect(),
                    ..Changes::default()
                },
                design,
            }
        };
        Ok(design.rows.iter().enumerate().map(member).collect())
    }

    fn source(&self) -> Result<Source, Failure> {
        Source::read(&self.model.model)
            .map(load::with_kernel)
            .map_err(|error| Failure::Wrong(error.to_string()))
    }

    /// Each scenario must be a model, and have a name of its own.
    pub(super) fn check_scenarios(&self, json: bool) -> Result<(), Failure> {
        for (at, scenario) in self.scenario.iter().enumerate() {
            let name = &scenario.name;
            if self.scenario[..at].iter().any(|other| other.name == *name) {
                return Err(Failure::Wrong(format!(
                    "two scenarios are called `{name}`; give each a name of its own"
                )));
            }
            let all = ModelArgs {
                model: self.model.model.clone(),
                seed: self.model.seed,
                stratum: None,
                parameters: None,
                parameter_names: None,
                set: [&self.model.set[..], &scenario.changes.set].concat(),
                without: [&self.model.without[..], &scenario.changes.without].concat(),
                max_level: scenario.changes.max_level.or(self.model.max_level),
            };
            load::model(&all, json).map_err(|failure| match failure {
                Failure::Wrong(text) => Failure::Wrong(format!("scenario `{name}`: {text}")),
                other => {
                    print::err(&format!("scenario `{name}`:"));
                    other
                }
            })?;
        }
        Ok(())
    }
}
