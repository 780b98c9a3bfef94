//! `clinothem build`: solids, report, proof.

use std::path::PathBuf;
use std::time::Instant;

use super::args::{ModelArgs, finite};
use super::engine::{self, Built, EngineArgs};
use super::failure::Failure;
use super::load;
use super::outputs::{OutputArgs, Outputs};
use super::progress::Progress;
use super::{interrupt, print, summary};
use crate::export::report::{LEAST_AREA, Parts, Report};
use crate::export::wells::entries::{WellEntry, Wells};
use crate::model::remarks;
use crate::model::wells::log::Logger;

/// Build watertight solids and write them as STEP, with a report and the proof that they are right.
///
/// Writes to DIR: MODEL.step (and what --formats adds), volumes.csv, wells.csv where there are wells, report.json and run.json. The same
/// model, seed and version give the same bytes; run.json holds what differs from run to run.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem build channel-belt.toml
  clinothem build channel-belt.toml --seed 12 -o belt-12
  clinothem build channel-belt.toml --without channel-3 --formats step,step-shared,brep
  clinothem build channel-belt.toml --formats none,xlsx,csv --least-area 10
  clinothem build channel-belt.toml --formats step,glb,stl,obj,ply,ts --chord 0.5
  clinothem build channel-belt.toml --parameters parameters.json --responses pore_volume_m3,net_to_gross
  clinothem build channel-belt.toml --set feature.channel.width=30 --json")]
pub(super) struct Args {
    #[command(flatten)]
    pub(super) model: ModelArgs,
    #[command(flatten)]
    outputs: OutputArgs,
    /// Report between what the permeability as a whole lies, whatever the arrangement: the harmonic and the arithmetic mean.
    #[arg(long)]
    bounds: bool,
    /// What two net solids share at least to count as connected (m²).
    #[arg(long, value_name = "M2", value_parser = finite, default_value_t = LEAST_AREA, allow_negative_numbers = true)]
    least_area: f64,
    #[command(flatten)]
    pub(super) engine: EngineArgs,
    /// Print the report as JSON instead of tables.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    make(args).map(drop)
}

/// The same; returns what was built, and the folder with its files.
pub(super) fn make(args: &Args) -> Result<(Built, PathBuf), Failure> {
    let started = Instant::now();
    if args.least_area < 0.0 {
        return Err(Failure::Wrong(format!(
            "the least area is {} m²; it must be 0 or more",
            args.least_area
        )));
    }
    // Before the work: a folder that cannot be used is told at once.
    let outputs = Outputs::new(&args.outputs, args.model.stem())?;
    let loaded = load::realise(&args.model, args.json)?;
    let say = |notes: &[String]| {
        if !args.engine.quiet {
            for note in notes {
                print::err(&format!("note: {note}"));
            }
        }
    };
    say(&loaded.notes());
    let outside = remarks::outside_parents(&loaded.realisation);
    say(&outside
        .into_iter()
        .map(|remark| remark.text)
        .collect::<Vec<_>>());
    let cancel = interrupt::cancel()?;
    let progress = Progress::new(args.engine.quiet || args.json);
    let built = engine::assemble(loaded, &args.engine, &cancel, &progress)?;
    let wells = wells(&built)?;
    let report = Report::new(Parts {
        model: &built.model,
        realisation: &built.subject.realisation,
        plan: &built.subject.plan,
        assembly: &built.assembly,
        wells: &wells,
        level: args.engine.level(),
        with_bounds: args.bounds,
        least_area: args.least_area,
    });
    progress.stage("writing");
    progress.aside(|| say(&report.empty));
    let writing = Instant::now();
    let written = outputs.write(&built, &report, writing, started)?;
    progress.done();
    if args.json {
        let json = report
            .to_json()
            .map_err(|error| Failure::Surroundings(error.to_string()))?;
        print::out(json.trim_end())?;
    } else if !args.engine.quiet {
        print::out(summary::text(&report, outputs.folder(), &written).trim_end())?;
    }
    let folder = outputs.folder().to_path_buf();
    Ok((built, folder))
}

/// What the model's wells pass through.
fn wells(built: &Built) -> Result<Vec<WellEntry>, Failure> {
    if built.model.wells.is_empty() {
        return Ok(Vec::new());
    }
    let realisation = &built.subject.realisation;
    let logger = Logger::new(realisation, &built.subject.owners)
        .map_err(|error| Failure::Wrong(error.to_string()))?;
    let wells = Wells {
        model: &built.model,
        realisation,
    };
    Ok(wells.all(&logger))
}
