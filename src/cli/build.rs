//! `clinothem build`: solids, report, proof.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::args::{ModelArgs, finite};
use super::failure::Failure;
use super::load::{self, Loaded};
use super::progress::Progress;
use super::triangles::{self, TriangleArgs};
use super::{interrupt, print, responses, summary};
use crate::assembly::unfinished::{self, Unfinished};
use crate::assembly::{self, Assembly, AssemblyError, Cancel, Subject, proof, worker};
use crate::export::mesh::Triangulation;
use crate::export::report::{LEAST_AREA, Parts, Report};
use crate::export::vertical::Vertical;
use crate::export::wells::entries::{WellEntry, Wells};
use crate::export::{ExportError, brep, numbers, step, table, wells};
use crate::model::realisation::Realisation;
use crate::model::selection::Selection;
use crate::model::wells::log::Logger;
use crate::model::{Model, remarks};

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
    /// The folder for the results; MODEL-out if not given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Write into a folder that holds other things than a build's results.
    #[arg(long)]
    force: bool,
    /// Files to write: step (named, coloured parts), step-shared (one shape with common faces), brep; closed triangles as glb and obj
    /// (all volumes), stl, ply and ts (a file each, in a folder of that name); xlsx (all tables as one workbook), csv (each table
    /// as a file); none for volumes.csv and the report only.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "step")]
    formats: Vec<Format>,
    /// The application protocol that STEP files declare.
    #[arg(long, value_enum, default_value_t)]
    step_schema: Schema,
    /// Report between what the permeability as a whole lies, whatever the arrangement: the harmonic and the arithmetic mean.
    #[arg(long)]
    bounds: bool,
    /// What two net solids share at least to count as connected (m²).
    #[arg(long, value_name = "M2", value_parser = finite, default_value_t = LEAST_AREA, allow_negative_numbers = true)]
    least_area: f64,
    /// Write measures as files of a number each, responses/NAME.txt; names are the columns of an ensemble's table, and one that
    /// there is not tells those that there are.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    responses: Vec<String>,
    #[command(flatten)]
    triangles: TriangleArgs,
    #[command(flatten)]
    pub(super) engine: EngineArgs,
    /// Print the report as JSON instead of tables.
    #[arg(long)]
    json: bool,
}

/// How solids are assembled.
#[derive(Clone, Debug, clap::Args)]
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

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Format {
    Step,
    StepShared,
    Brep,
    Glb,
    Obj,
    Stl,
    Ply,
    Ts,
    Xlsx,
    Csv,
    /// Tables only.
    #[value(alias = "tables")]
    None,
}

impl Format {
    fn triangles(self) -> Option<triangles::Format> {
        match self {
            Self::Glb => Some(triangles::Format::Glb),
            Self::Obj => Some(triangles::Format::Obj),
            Self::Stl => Some(triangles::Format::Stl),
            Self::Ply => Some(triangles::Format::Ply),
            Self::Ts => Some(triangles::Format::Ts),
            Self::Step | Self::StepShared | Self::Brep | Self::Xlsx | Self::Csv | Self::None => {
                None
            }
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Schema {
    /// Automotive design: read by everything.
    #[default]
    Ap214,
    /// Managed model based engineering.
    Ap242,
}

impl From<Schema> for step::Protocol {
    fn from(schema: Schema) -> Self {
        match schema {
            Schema::Ap214 => Self::Ap214,
            Schema::Ap242 => Self::Ap242,
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
    timings: Vec<(&'static str, Duration)>,
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

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let started = Instant::now();
    if args.least_area < 0.0 {
        return Err(Failure::Wrong(format!(
            "the least area is {} m²; it must be 0 or more",
            args.least_area
        )));
    }
    let folder = args
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-out", args.model.stem())));
    // Before the work: a folder that cannot be used is told at once.
    check_folder(&folder, args.force)?;
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
    let built = assemble(loaded, &args.engine, &cancel, &progress)?;
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
    let output = Output {
        folder: &folder,
        stem: args.model.stem(),
        args,
    };
    let written = output.write(&built, &report, writing, started)?;
    progress.done();
    if args.json {
        let json = report
            .to_json()
            .map_err(|error| Failure::Surroundings(error.to_string()))?;
        print::out(json.trim_end())
    } else if args.engine.quiet {
        Ok(())
    } else {
        print::out(summary::text(&report, &folder, &written).trim_end())
    }
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

/// A folder may be new, empty or an earlier build's; another one needs force. What builds that were killed have left in it
/// is removed.
fn check_folder(folder: &Path, force: bool) -> Result<(), Failure> {
    if !folder.exists() {
        return Ok(());
    }
    if !folder.is_dir() {
        let shown = folder.display();
        return Err(Failure::Wrong(format!(
            "{shown} is a file; name a folder with -o"
        )));
    }
    let failed = |error: std::io::Error| Failure::file("read", folder, &error);
    let found = unfinished::clear(folder, UNFINISHED).map_err(failed)?;
    let entries = std::fs::read_dir(folder).map_err(failed)?.count();
    let ours = folder.join(RUN).is_file();
    if force || ours || entries == 0 {
        return Ok(());
    }
    if entries == found.in_use {
        return Err(Failure::Wrong(format!(
            "another build is writing to the folder {}; wait until it has ended, or name another one with -o",
            folder.display()
        )));
    }
    Err(Failure::Wrong(format!(
        "the folder {} holds things that are no build of this program; \
         name another one with -o, or add --force (nothing but the results is replaced)",
        folder.display()
    )))
}

/// What the names of folders of unfinished files begin with.
const UNFINISHED: &str = ".unfinished-";

/// What differs from run to run; its presence marks a folder of results.
const RUN: &str = "run.json";

struct Output<'a> {
    folder: &'a Path,
    stem: String,
    args: &'a Args,
}

impl Output<'_> {
    /// Writes everything into a folder of unfinished files, then renames file by file.
    fn write(
        &self,
        built: &Built,
        report: &Report,
        writing: Instant,
        started: Instant,
    ) -> Result<Vec<String>, Failure> {
        let failed = |error: std::io::Error| Failure::file("write to", self.folder, &error);
        let is_new = !self.folder.exists();
        std::fs::create_dir_all(self.folder).map_err(failed)?;
        let staging = Unfinished::new(self.folder, UNFINISHED).map_err(failed)?;
        interrupt::unfinished_in(Some(if is_new { self.folder } else { staging.path() }));
        let result = self
            .write_files(staging.path(), built, report)
            .and_then(|mut names| {
                let mut timings = built.timings.clone();
                timings.push(("files", writing.elapsed()));
                let run = run_json(&timings, started.elapsed());
                std::fs::write(staging.path().join(RUN), run).map_err(failed)?;
                names.push(RUN.to_owned());
                triangles::publish(staging.path(), self.folder, &names)?;
                Ok(names)
            });
        drop(staging);
        if result.is_err() && is_new {
            drop(std::fs::remove_dir(self.folder));
        }
        interrupt::unfinished_in(None);
        result
    }

    /// The formats asked for. Shared STEP holds closed shells, which cannot tell a void from a body, so
    /// BREP takes its place where a volume encloses another.
    fn formats(&self, built: &Built) -> Vec<Format> {
        let mut formats = self.args.formats.clone();
        if let (Some(volume), true) = (
            built.assembly.enclosing_volume(),
            formats.contains(&Format::StepShared),
        ) {
            let name = &built.subject.plan.names[volume];
            print::err(&format!(
                "note: {name} wholly encloses another volume, which shared STEP cannot express; BREP is written instead"
            ));
            formats.retain(|format| *format != Format::StepShared);
            formats.push(Format::Brep);
        }
        formats
    }

    fn write_files(
        &self,
        staging: &Path,
        built: &Built,
        report: &Report,
    ) -> Result<Vec<String>, Failure> {
        let (model, realisation) = (&built.model, &built.subject.realisation);
        let protocol = self.args.step_schema.into();
        // First of all: a name that there is not costs no files.
        let responses = responses::of(report, &self.args.responses)?;
        let mut names = Vec::new();
        let formats = self.formats(built);
        let has_shared = [Format::StepShared, Format::Brep]
            .iter()
            .any(|format| formats.contains(format));
        for format in &formats {
            let name = match format {
                Format::Step => format!("{}.step", self.stem),
                Format::StepShared => format!("{}.shared.step", self.stem),
                Format::Brep => format!("{}.brep", self.stem),
                Format::Glb
                | Format::Obj
                | Format::Stl
                | Format::Ply
                | Format::Ts
                | Format::Xlsx
                | Format::Csv
                | Format::None => continue,
            };
            if names.contains(&name) {
                continue;
            }
            let path = staging.join(&name);
            match format {
                Format::Step => {
                    step::write_assembly(&path, model, realisation, &built.assembly, protocol)
                }
                Format::StepShared => {
                    step::write_shared(&path, model, realisation, &built.assembly, protocol)
                }
                _ => brep::write(&path, &built.assembly),
            }
            .map_err(|error: ExportError| Failure::Surroundings(error.to_string()))?;
            names.push(name);
        }
        names.extend(self.write_triangles(staging, built)?);
        // Only shapes whose solids share faces need numbers: parts have names.
        if has_shared {
            let failed = |error: ExportError| Failure::Surroundings(error.to_string());
            for sheet in numbers::sheets(report, &built.assembly).map_err(failed)? {
                let name = format!("{}.{}.csv", self.stem, sheet.name);
                let text = table::csv(&sheet).map_err(failed)?;
                std::fs::write(staging.join(&name), text)
                    .map_err(|error| Failure::file("write to", self.folder, &error))?;
                names.push(name);
            }
        }
        for (name, bytes) in self.tables(report)? {
            std::fs::write(staging.join(&name), bytes)
                .map_err(|error| Failure::file("write to", self.folder, &error))?;
            names.push(name);
        }
        for response in responses {
            response
                .write(staging)
                .map_err(|error| Failure::file("write to", self.folder, &error))?;
            names.push(response.file);
        }
        Ok(names)
    }

    /// The tables and the report, by the names of their files.
    fn tables(&self, report: &Report) -> Result<Vec<(String, Vec<u8>)>, Failure> {
        let failed = |error: &dyn std::fmt::Display| Failure::Surroundings(error.to_string());
        let asked = |format: Format| self.args.formats.contains(&format);
        let csv = |sheet: &table::Sheet| -> Result<(String, Vec<u8>), Failure> {
            let text = table::csv(sheet).map_err(|error| failed(&error))?;
            Ok((format!("{}.csv", sheet.name), text.into_bytes()))
        };
        let mut files = Vec::new();
        if asked(Format::Csv) || asked(Format::Xlsx) {
            let sheets = table::sheets(report);
            if asked(Format::Xlsx) {
                let bytes = table::xlsx(&sheets).map_err(|error| failed(&error))?;
                files.push((format!("{}.xlsx", self.stem), bytes));
            }
            if asked(Format::Csv) {
                // That of volumes is always there.
                let others = sheets.iter().filter(|sheet| sheet.name != table::VOLUMES);
                for sheet in others {
                    files.push(csv(sheet)?);
                }
            }
        }
        files.push(csv(&table::volumes(report))?);
        if !report.wells.is_empty() {
            let text = wells::table::csv(&report.wells).map_err(|error| failed(&error))?;
            files.push(("wells.csv".to_owned(), text.into_bytes()));
        }
        let json = report.to_json().map_err(|error| failed(&error))?;
        files.push(("report.json".to_owned(), json.into_bytes()));
        Ok(files)
    }
}

impl Output<'_> {
    /// The volumes as closed triangles, in the formats of these. Returns the files' names.
    fn write_triangles(&self, staging: &Path, built: &Built) -> Result<Vec<String>, Failure> {
        let mut formats: Vec<triangles::Format> = Vec::new();
        for format in self
            .args
            .formats
            .iter()
            .filter_map(|format| format.triangles())
        {
            if !formats.contains(&format) {
                formats.push(format);
            }
        }
        if formats.is_empty() {
            return Ok(Vec::new());
        }
        let args = &self.args.triangles;
        let fineness = args.fineness(&built.subject.plan);
        let meshes = Triangulation::new(&built.assembly, &fineness)
            .and_then(|triangles| triangles.volumes(&built.assembly))
            .map_err(|error| Failure::Surroundings(error.to_string()))?;
        let meshes = meshes.into_iter().map(|mesh| (None, mesh)).collect();
        let origin = args.origin(&built.model);
        let parts = triangles::parts(
            &built.model,
            &built.subject.realisation,
            meshes,
            &fineness,
            origin,
        );
        let mut names = Vec::new();
        for format in formats {
            let files = triangles::files(format, &self.stem, &parts, args, Vertical::Elevation)?;
            let written = triangles::write(staging, files);
            names.extend(written.map_err(|error| Failure::file("write to", self.folder, &error))?);
        }
        Ok(names)
    }
}

/// Seconds per stage, peak memory and the machine.
fn run_json(timings: &[(&'static str, Duration)], total: Duration) -> String {
    let mut seconds = serde_json::Map::new();
    for (stage, time) in timings {
        seconds.insert((*stage).to_owned(), serde_json::json!(time.as_secs_f64()));
    }
    seconds.insert("total".to_owned(), serde_json::json!(total.as_secs_f64()));
    let run = serde_json::json!({
        "seconds": seconds,
        "peak_memory_mib": peak_memory_mib(),
        "processors": std::thread::available_parallelism().map_or(0, usize::from),
    });
    format!("{run:#}\n")
}

/// Peak resident memory of this process, where the system tells (Linux).
fn peak_memory_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim()
        .strip_suffix("kB")?
        .trim()
        .parse::<f64>()
        .ok()
        .map(|kib| kib / 1024.0)
}
