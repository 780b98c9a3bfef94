//! The hidden command that makes one realisation of an ensemble: a build with limits, which ends with its parent.

use super::build;
use super::failure::Failure;
use super::tiles::{self, Picture};
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
    /// Small pictures that it draws.
    #[arg(long, value_enum, value_delimiter = ',')]
    contact_sheet: Vec<Picture>,
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
    let model = &args.build.model;
    let path = &model.model;
    let bytes = std::fs::read(path).map_err(|error| Failure::file("read", path, &error))?;
    if digest(&bytes) != args.sha256 {
        // Not an answer about the model: the ensemble can go on once it is as it was.
        return Err(Failure::Surroundings(format!(
            "{} has changed since the ensemble began",
            path.display()
        )));
    }
    let (built, folder) = build::make(&args.build)?;
    tiles::write(&args.contact_sheet, model, built, &folder)
}
