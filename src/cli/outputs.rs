//! The files of a build: which are asked for, and how they come into their folder, all of them or none.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::engine::Built;
use super::failure::Failure;
use super::triangles::{self, TriangleArgs};
use super::{files, interrupt, print, responses};
use crate::assembly::unfinished::{self, Unfinished};
use crate::export::mesh::Triangulation;
use crate::export::report::Report;
use crate::export::vertical::Vertical;
use crate::export::{ExportError, brep, numbers, step, table};

/// What is written, and where.
#[derive(Debug, clap::Args)]
pub(super) struct OutputArgs {
    /// The folder for the results; MODEL-out if not given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Write into a folder that holds other things than a build's results.
    #[arg(long)]
    force: bool,
    /// Files to write: step (named, coloured parts), step-shared (one shape with common faces), brep,
    /// step-wells (the wells as curves split where they pass from one volume to another); closed triangles as glb and obj
    /// (all volumes), stl, ply and ts (a file each, in a folder of that name); xlsx (all tables as one workbook), csv (each table
    /// as a file); none for volumes.csv and the report only.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "step")]
    formats: Vec<Format>,
    /// The application protocol that STEP files declare.
    #[arg(long, value_enum, default_value_t)]
    step_schema: Schema,
    /// Write measures as files of a number each, responses/NAME.txt; names are the columns of an ensemble's table, and one that
    /// there is not tells those that there are.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    responses: Vec<String>,
    #[command(flatten)]
    triangles: TriangleArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Format {
    Step,
    StepShared,
    StepWells,
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
            Self::Step
            | Self::StepShared
            | Self::StepWells
            | Self::Brep
            | Self::Xlsx
            | Self::Csv
            | Self::None => None,
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

/// What the names of folders of unfinished files begin with.
const UNFINISHED: &str = ".unfinished-";

/// Parts of the stage of files, in `run.json`: the STEP file of parts, and triangles of all solids before they are written.
const FILES_STEP: &str = "files, step";
const FILES_TRIANGLES: &str = "files, triangles";

/// What differs from run to run; its presence marks a folder of results.
const RUN: &str = "run.json";

/// A folder that may be written into, and what is to come there.
pub(super) struct Outputs<'a> {
    folder: PathBuf,
    stem: String,
    args: &'a OutputArgs,
}

impl<'a> Outputs<'a> {
    /// Of a model whose file has this stem. Fails if the folder cannot be used.
    pub(super) fn new(args: &'a OutputArgs, stem: String) -> Result<Self, Failure> {
        let folder = args
            .output
            .clone()
            .unwrap_or_else(|| PathBuf::from(format!("{stem}-out")));
        check_folder(&folder, args.force)?;
        Ok(Self { folder, stem, args })
    }

    /// Where the files come.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Writes everything into a folder of unfinished files, then renames file by file.
    pub(super) fn write(
        &self,
        built: &Built,
        report: &Report,
        writing: Instant,
        started: Instant,
    ) -> Result<Vec<String>, Failure> {
        let failed = |error: std::io::Error| Failure::file("write to", &self.folder, &error);
        let is_new = !self.folder.exists();
        std::fs::create_dir_all(&self.folder).map_err(failed)?;
        let staging = Unfinished::new(&self.folder, UNFINISHED).map_err(failed)?;
        interrupt::unfinished_in(Some(if is_new { &self.folder } else { staging.path() }));
        let mut parts = Vec::new();
        let result = self
            .write_files(staging.path(), built, report, &mut parts)
            .and_then(|mut names| {
                let mut timings = built.timings.clone();
                timings.push(("files", writing.elapsed()));
                timings.append(&mut parts);
                let run = run_json(&timings, started.elapsed());
                std::fs::write(staging.path().join(RUN), run).map_err(failed)?;
                names.push(RUN.to_owned());
                files::publish(staging.path(), &self.folder, &names)?;
                Ok(names)
            });
        drop(staging);
        if result.is_err() && is_new {
            drop(std::fs::remove_dir(&self.folder));
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
        timings: &mut Vec<(&'static str, Duration)>,
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
                Format::StepWells if report.wells.is_empty() => {
                    print::err("note: the model has no wells, so there is no file of them");
                    continue;
                }
                Format::StepWells => format!("{}.wells.step", self.stem),
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
            let started = Instant::now();
            match format {
                Format::Step => {
                    step::write_assembly(&path, model, realisation, &built.assembly, protocol)
                }
                Format::StepShared => {
                    step::write_shared(&path, model, realisation, &built.assembly, protocol)
                }
                Format::StepWells => {
                    let wells: Vec<_> = model.wells.iter().zip(&report.wells).collect();
                    step::write_wells(&path, model, realisation, &wells, protocol)
                }
                _ => brep::write(&path, &built.assembly),
            }
            .map_err(|error: ExportError| Failure::Surroundings(error.to_string()))?;
            if *format == Format::Step {
                timings.push((FILES_STEP, started.elapsed()));
            }
            names.push(name);
        }
        names.extend(self.write_triangles(staging, built, timings)?);
        // Only shapes whose solids share faces need numbers: parts have names.
        if has_shared {
            let failed = |error: &dyn std::fmt::Display| Failure::Surroundings(error.to_string());
            let sheets = numbers::sheets(report, &built.assembly);
            for sheet in sheets.map_err(|error| failed(&error))? {
                let name = format!("{}.{}.csv", self.stem, sheet.name);
                let text = table::csv(&sheet).map_err(|error| failed(&error))?;
                std::fs::write(staging.join(&name), text)
                    .map_err(|error| Failure::file("write to", &self.folder, &error))?;
                names.push(name);
            }
        }
        for (name, bytes) in self.tables(report)? {
            std::fs::write(staging.join(&name), bytes)
                .map_err(|error| Failure::file("write to", &self.folder, &error))?;
            names.push(name);
        }
        for response in responses {
            response
                .write(staging)
                .map_err(|error| Failure::file("write to", &self.folder, &error))?;
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
                // Those of volumes and of wells are always there.
                let is_other =
                    |sheet: &&table::Sheet| ![table::VOLUMES, table::WELLS].contains(&sheet.name);
                let others = sheets.iter().filter(is_other);
                for sheet in others {
                    files.push(csv(sheet)?);
                }
            }
        }
        files.push(csv(&table::volumes(report))?);
        if !report.wells.is_empty() {
            files.push(csv(&table::wells(&report.wells))?);
        }
        let json = report.to_json().map_err(|error| failed(&error))?;
        files.push(("report.json".to_owned(), json.into_bytes()));
        Ok(files)
    }

    /// The volumes as closed triangles, in the formats of these. Returns the files' names.
    fn write_triangles(
        &self,
        staging: &Path,
        built: &Built,
        timings: &mut Vec<(&'static str, Duration)>,
    ) -> Result<Vec<String>, Failure> {
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
        let fineness = args.fineness(&built.subject.plan)?;
        let started = Instant::now();
        let meshes = Triangulation::new(&built.assembly, &fineness)
            .and_then(|triangles| triangles.volumes(&built.assembly))
            .map_err(|error| triangles::failed(&error))?;
        timings.push((FILES_TRIANGLES, started.elapsed()));
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
            names.extend(written.map_err(|error| Failure::file("write to", &self.folder, &error))?);
        }
        Ok(names)
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
