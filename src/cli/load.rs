//! Loading: from a model file to a realisation, with every defect told.

use std::io::{ErrorKind, IsTerminal};
use std::path::Path;
use std::time::{Duration, Instant};

use super::args::ModelArgs;
use super::failure::Failure;
use crate::model::owner::Owners;
use crate::model::realisation::Realisation;
use crate::model::selection::Selection;
use crate::model::{Model, Parameters, ParametersError, ReadError, Source};

/// A model with its draws made.
pub(super) struct Loaded {
    pub(super) model: Model,
    pub(super) realisation: Realisation,
    /// What takes part.
    #[cfg_attr(
        not(feature = "occt"),
        expect(dead_code, reason = "only builds realise a model again")
    )]
    pub(super) selection: Selection,
    /// Seconds per stage.
    #[cfg_attr(
        not(feature = "occt"),
        expect(dead_code, reason = "only builds tell their times")
    )]
    pub(super) timings: Vec<(&'static str, Duration)>,
}

/// Reads and checks a model, and finds what is to be left out of it; `json` adds the defects as JSON on standard output.
pub(super) fn model(args: &ModelArgs, json: bool) -> Result<(Model, Selection), Failure> {
    let read = if args.is_standard_input() {
        Source::read_stream("standard input", std::io::stdin().lock())
    } else {
        Source::read(&args.model)
    };
    let mut source = read.map(with_kernel).map_err(|error| match &error {
        ReadError::Io { source, .. } => Failure::Surroundings(format!("{error}: {source}")),
        _ => Failure::Wrong(error.to_string()),
    })?;
    if let Some(path) = &args.parameters {
        source.set_parameters(parameters(path, args.parameter_names.as_deref())?);
    }
    for assignment in &args.set {
        source.set(assignment.clone());
    }
    if let Some(seed) = args.seed {
        source.set(format!("seed={seed}"));
    }
    let mut model = Model::check(&source).map_err(|defects| Failure::WrongModel {
        text: defects.render(std::io::stderr().is_terminal()),
        json: json.then(|| defects.to_json().to_string()),
    })?;
    model.stratum = args.stratum;
    let selection = args
        .selection()
        .found_in(&model)
        .map_err(|error| Failure::Wrong(error.to_string()))?;
    Ok((model, selection))
}

/// A source whose solids the kernel reads, if it is there.
pub(super) fn with_kernel(source: Source) -> Source {
    #[cfg(feature = "occt")]
    let source = source.with_solids(crate::assembly::read_solid);
    source
}

fn parameters(path: &Path, names: Option<&Path>) -> Result<Parameters, Failure> {
    Parameters::read(path, names).map_err(|error| match error {
        ParametersError::Unreadable { ref source, .. } if source.kind() != ErrorKind::NotFound => {
            Failure::Surroundings(error.to_string())
        }
        _ => Failure::Wrong(error.to_string()),
    })
}

/// The same, with the draws made and the surfaces built.
pub(super) fn realise(args: &ModelArgs, json: bool) -> Result<Loaded, Failure> {
    let started = Instant::now();
    start_threads()?;
    let (model, selection) = model(args, json)?;
    let reading = started.elapsed();
    let started = Instant::now();
    let realisation =
        Realisation::new(&model, &selection).map_err(|error| Failure::Wrong(error.to_string()))?;
    let timings = vec![("model file", reading), ("surfaces", started.elapsed())];
    Ok(Loaded {
        model,
        realisation,
        selection,
        timings,
    })
}

/// Starts the worker threads: where they are started on demand, a system that has no more of them ends the program with a panic.
pub(super) fn start_threads() -> Result<(), Failure> {
    rayon::ThreadPoolBuilder::new()
        .build_global()
        .map_err(|error| {
            Failure::Surroundings(format!(
                "the system starts no threads ({error}); end other programs, or allow more processes (`ulimit -u`)"
            ))
        })
}

impl Loaded {
    /// What is worth saying of the model although it is right: what takes no part, then the notes in the order of the file.
    pub(super) fn notes(&self) -> Vec<String> {
        let decisions = self.realisation.decisions.iter().cloned();
        let notes = self.model.notes.iter();
        decisions
            .chain(notes.map(|note| format!("{}: {}", note.place, note.message)))
            .collect()
    }

    /// The point evaluator.
    pub(super) fn owners(&self) -> Result<Owners, Failure> {
        Owners::new(&self.realisation).map_err(|error| Failure::Wrong(error.to_string()))
    }
}
