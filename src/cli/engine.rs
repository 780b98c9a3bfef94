//! Solids, as every command that wants them makes them: how, and what comes of it.

use std::time::{Duration, Instant};

use super::failure::Failure;
use super::load::Loaded;
use super::progress::Progress;
use crate::assembly::{self, Assembly, AssemblyError, Cancel, Subject, proof, worker};
use crate::model::Model;
use crate::model::realisation::Realisation;
use crate::model::selection::Selection;

/// How solids are assembled.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct EngineArgs {
    /// What makes the solids. auto takes the partition, and the general fuse where the partition is in doubt.
    #[arg(long, value_enum, default_value_t)]
    engine: Engine,
    /// How thorough the proof is; fast is always made.
    #[arg(long, value_enum, default_value_t)]
    proof: ProofLevel,
    /// Worker threads; all of the machine's if not given.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Stop a general fuse that takes longer (s). If not given, auto lets it take 20 s and 0.1 s for each pair of bodies, and at
    /// most 1800 s; occt 1800 s.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(1..))]
    time_limit: Option<u64>,
    /// Where a model is refused, tell what every engine tried and what went wrong in it.
    #[arg(short, long)]
    verbose: bool,
    /// No progress bars, no notes and no summary.
    #[arg(long)]
    pub(super) quiet: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Engine {
    /// The partition; where it is in doubt or not proven, the general fuse.
    #[default]
    Auto,
    /// The partition kernel alone.
    Partition,
    /// OpenCASCADE's general fuse alone.
    Occt,
}

impl From<Engine> for assembly::Engine {
    fn from(engine: Engine) -> Self {
        match engine {
            Engine::Auto => Self::Auto,
            Engine::Partition => Self::Partition,
            Engine::Occt => Self::Occt,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum ProofLevel {
    #[default]
    Fast,
    Full,
}

impl EngineArgs {
    pub(super) fn level(&self) -> proof::Level {
        match self.proof {
            ProofLevel::Fast => proof::Level::Fast,
            ProofLevel::Full => proof::Level::Full,
        }
    }
}

/// A model with its proven solids.
pub(super) struct Built {
    pub(super) model: Model,
    /// What was assembled.
    pub(super) subject: Subject,
    pub(super) assembly: Assembly,
    selection: Selection,
    /// Seconds per stage.
    pub(super) timings: Vec<(&'static str, Duration)>,
}

impl Built {
    /// What was assembled, without the solids.
    pub(super) fn into_loaded(self) -> Loaded {
        Loaded {
            model: self.model,
            realisation: self.subject.realisation,
            selection: self.selection,
            timings: self.timings,
        }
    }
}

/// Plans, assembles and proves.
pub(super) fn assemble(
    loaded: Loaded,
    engine: &EngineArgs,
    cancel: &Cancel,
    progress: &Progress,
) -> Result<Built, Failure> {
    let started = Instant::now();
    let Loaded {
        model,
        realisation,
        mut timings,
        selection,
    } = loaded;
    let subject = Subject::new(realisation).map_err(|error| Failure::Wrong(error.to_string()))?;
    timings.push(("plan", started.elapsed()));
    worker::clear_abandoned();
    let program = std::env::current_exe().map_err(|error| {
        Failure::Surroundings(format!("the program cannot find itself: {error}"))
    })?;
    let options = assembly::Options {
        engine: engine.engine.into(),
        child: Some(worker::Child {
            program,
            time_limit: engine.time_limit.map(Duration::from_secs),
        }),
        threads: engine.threads.map_or(0, usize::from),
        proof: engine.level(),
        seed: model.seed,
    };
    let again = |step: f64| Realisation::by_age(&model, &selection, step);
    let assembled = assembly::assemble(subject, &again, &options, cancel, &|stage, fraction| {
        progress.share(stage, fraction);
    });
    match assembled {
        Ok((subject, assembly)) => {
            timings.extend_from_slice(&assembly.timings);
            Ok(Built {
                model,
                subject,
                assembly,
                selection,
                timings,
            })
        }
        Err(error) => {
            progress.done();
            Err(match error {
                AssemblyError::Cancelled => Failure::Interrupted(Failure::INTERRUPTED),
                AssemblyError::Threads(_)
                | AssemblyError::Worker {
                    source: worker::WorkerError::Io(_),
                    ..
                } => Failure::Surroundings(error.to_string()),
                AssemblyError::NotProven { ref failed, .. } => {
                    let tried = if engine.verbose {
                        let line = |(i, failed): (usize, &assembly::Failed)| {
                            format!("\n  {}. {failed}", i + 1)
                        };
                        let lines: String = failed.iter().enumerate().map(line).collect();
                        format!("\nwhat was tried:{lines}")
                    } else {
                        "\n(--verbose tells what was tried)".to_owned()
                    };
                    Failure::Unproven(format!("{error}{tried}"))
                }
                _ => Failure::Unproven(error.to_string()),
            })
        }
    }
}
