//! The command line: one command per file; argument parsing and printing only.
//!
//! Results go to standard output, progress and messages to standard error. Exit codes: 0 done, 1 the
//! model or the arguments are wrong, 2 the assembly could not be proven, 3 the surroundings failed (disk,
//! permissions), 130 interrupted.

mod args;
#[cfg(feature = "occt")]
mod build;
mod check;
#[cfg(feature = "occt")]
mod engine;
#[cfg(feature = "occt")]
mod ensemble;
#[cfg(feature = "occt")]
mod ensemble_worker;
mod failure;
mod files;
mod grid;
#[cfg(feature = "occt")]
mod interrupt;
mod load;
mod locate;
mod log;
#[cfg(feature = "occt")]
mod members;
mod new;
#[cfg(feature = "occt")]
mod outputs;
mod picture;
mod print;
mod progress;
#[cfg(feature = "occt")]
mod responses;
#[cfg(feature = "occt")]
mod scenarios;
mod schema;
mod section;
#[cfg(feature = "occt")]
mod summary;
#[cfg(feature = "occt")]
mod surfaces;
#[cfg(feature = "occt")]
mod tiles;
mod traces;
#[cfg(feature = "occt")]
mod triangles;
#[cfg(feature = "occt")]
mod tubes;
#[cfg(feature = "occt")]
mod view;

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::Failure;

/// Surface-based geological reservoir modelling without a grid.
///
/// A short model file becomes NURBS surfaces, and these become exact, watertight, named solids.
#[derive(Debug, Parser)]
#[command(name = "clinothem", version, max_term_width = 100, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "Examples:
  clinothem new quickstart               write quickstart.toml, a small model to start from
  clinothem check quickstart.toml        every defect of the model file, and who removes what
  clinothem build quickstart.toml        solids as STEP, with a report and a proof
  clinothem view quickstart.toml         a picture of the model
  clinothem section quickstart.toml      a vertical section through its middle";

#[derive(Debug, Subcommand)]
enum Command {
    New(new::Args),
    Check(check::Args),
    #[cfg(feature = "occt")]
    Build(build::Args),
    #[cfg(feature = "occt")]
    Ensemble(ensemble::Args),
    #[cfg(feature = "occt")]
    Surfaces(surfaces::Args),
    Locate(locate::Args),
    Log(log::Args),
    Section(section::Args),
    Grid(grid::Args),
    #[cfg(feature = "occt")]
    View(view::Args),
    Schema(schema::Args),
    /// Makes a realisation for another process of this program.
    #[cfg(feature = "occt")]
    #[command(name = crate::ensemble::workers::COMMAND, hide = true)]
    EnsembleWorker(Box<ensemble_worker::Args>),
    /// Runs a general fuse for another process of this program.
    #[cfg(feature = "occt")]
    #[command(name = crate::assembly::worker::COMMAND, hide = true)]
    FuseWorker {
        /// Where the result goes.
        result: std::path::PathBuf,
    },
}

/// Runs the program with the process's arguments.
pub fn run() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version are answers; everything else is a wrong argument, which is 1 here and 2
            // in clap.
            let printed = error.print();
            if error.use_stderr() {
                return ExitCode::from(1);
            }
            let flushed = printed.and_then(|()| std::io::stdout().flush());
            return print::told(flushed).map_or_else(print::failure, |()| ExitCode::SUCCESS);
        }
    };
    match cli.command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => print::failure(failure),
    }
}

impl Command {
    fn run(self) -> Result<(), Failure> {
        match self {
            Self::New(args) => new::run(&args),
            Self::Check(args) => check::run(&args),
            #[cfg(feature = "occt")]
            Self::Build(args) => build::run(&args),
            #[cfg(feature = "occt")]
            Self::Ensemble(args) => ensemble::run(&args),
            #[cfg(feature = "occt")]
            Self::EnsembleWorker(args) => ensemble_worker::run(&args),
            #[cfg(feature = "occt")]
            Self::Surfaces(args) => surfaces::run(&args),
            Self::Locate(args) => locate::run(&args),
            Self::Log(args) => log::run(&args),
            Self::Section(args) => section::run(&args),
            Self::Grid(args) => grid::run(&args),
            #[cfg(feature = "occt")]
            Self::View(args) => view::run(&args),
            Self::Schema(args) => schema::run(&args),
            #[cfg(feature = "occt")]
            Self::FuseWorker { result } => crate::assembly::worker::serve(&result)
                .map_err(|error| Failure::Surroundings(error.to_string())),
        }
    }
}
