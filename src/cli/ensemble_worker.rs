//! The hidden command that makes one realisation of an ensemble: a build with limits, which ends with its parent.

use super::build;
use super::failure::Failure;
use crate::assembly::worker;
use crate::ensemble::member::digest;
use crate::ensemble::workers;

/// A build for an ensemble.
#[derive(Debug, clap::Args)]
#[group(skip)]
pub(super) struct Args {
    /// The most address space that it may have, in bytes.
    #[arg(long)]
    memory_limit: Option<u64>,
    /// The SHA-256 of the model file.
    #[arg(long)]
    sha256: String,
    #[command(flatten)]
    build: build::Args,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if let Some(bytes) = args.memory_limit {
        workers::limit_memory(bytes).map_err(|error| {
            Failure::Surroundings(format!(
                "the memory cannot be limited to {bytes} bytes: {error}"
            ))
        })?;
    }
    worker::end_with_the_parent()
        .map_err(|error| Failure::Surroundings(format!("no thread can be started: {error}")))?;
    let model = &args.build.model.model;
    let bytes = std::fs::read(model).map_err(|error| Failure::file("read", model, &error))?;
    if digest(&bytes) != args.sha256 {
        // Not an answer about the model: the ensemble can go on once it is as it was.
        return Err(Failure::Surroundings(format!(
            "{} has changed since the ensemble began",
            model.display()
        )));
    }
    build::run(&args.build)
}
