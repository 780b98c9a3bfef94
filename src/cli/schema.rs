//! `clinothem schema`: JSON Schemas for editors and programs.

use super::failure::Failure;
use super::print;

/// Print the JSON Schema of model files, for editors that complete and check as you type.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:
  clinothem schema > clinothem.schema.json
and as first line of a model file, for editors with a TOML language server:
  #:schema ./clinothem.schema.json")]
pub(super) struct Args {
    /// Print the schema of report.json instead.
    #[cfg(feature = "occt")]
    #[arg(long)]
    report: bool,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    #[cfg(feature = "occt")]
    let schema = if args.report {
        crate::export::report::Report::schema()
    } else {
        crate::model::schema()
    };
    #[cfg(not(feature = "occt"))]
    let schema = {
        let Args {} = args;
        crate::model::schema()
    };
    let text = serde_json::to_string_pretty(&schema)
        .map_err(|error| Failure::Surroundings(error.to_string()))?;
    print::out(&text)
}
