//! `clinothem surfaces`: STEP of the NURBS surfaces alone.

use std::path::PathBuf;

use super::args::ModelArgs;
use super::build::Schema;
use super::failure::Failure;
use super::files;
use super::{interrupt, load, print};
use crate::export::{file, step};

/// Write the NURBS surfaces of all bodies as STEP, untrimmed, without assembling solids.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:
  clinothem surfaces channel-belt.toml -o belt-surfaces.step")]
pub(super) struct Args {
    #[command(flatten)]
    model: ModelArgs,
    /// Where to write; MODEL-surfaces.step if not given.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The application protocol that the file declares.
    #[arg(long, value_enum, default_value_t)]
    step_schema: Schema,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = load::realise(&args.model, false)?;
    if loaded.realisation.instances.is_empty() {
        return Err(Failure::Wrong(
            "the model has no features left, so no surfaces".to_owned(),
        ));
    }
    let path = args
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-surfaces.step", args.model.stem())));
    let staging = tempfile::Builder::new()
        .prefix(".clinothem-")
        .tempdir_in(files::folder_of(&path)?)
        .map_err(|error| Failure::file("write", &path, &error))?;
    // The handler removes the folder when the program is stopped; there is nothing to cancel here.
    let _cancel = interrupt::cancel()?;
    interrupt::unfinished_in(Some(staging.path()));
    let unfinished = staging.path().join("surfaces.step");
    step::write_surfaces(
        &unfinished,
        &loaded.model,
        &loaded.realisation,
        args.step_schema.into(),
    )
    .map_err(|error| Failure::Surroundings(error.to_string()))?;
    file::readable(&unfinished)
        .and_then(|()| std::fs::rename(&unfinished, &path))
        .map_err(|error| Failure::file("write", &path, &error))?;
    interrupt::unfinished_in(None);
    let count = loaded.realisation.instances.len();
    print::out(&format!(
        "wrote {}: the surfaces of {count} bodies",
        path.display()
    ))
}
