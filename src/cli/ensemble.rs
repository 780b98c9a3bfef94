//! `clinothem ensemble`: many realisations, each in a process of its own, and what they are as a whole.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::ValueEnum;
use indicatif::ProgressBar;
use rayon::prelude::*;

use super::engine::{Engine, ProofLevel};
use super::failure::Failure;
use super::members::MemberArgs;
use super::outputs::Format;
use super::tiles::{self, Picture};
use super::{interrupt, load, print, progress};
use crate::ensemble::Member;
use crate::ensemble::folder::{Folder, FolderError, Manifest, Settled};
use crate::ensemble::member::digest;
use crate::ensemble::summary::{self, Summary, Told};
use crate::ensemble::workers::{self, End, Ended, Job, WorkersError};
use crate::export::picture::contact::{ContactSheet, Tile};
use crate::export::picture::{Rgb, Swatch};
use crate::model::Model;

/// Make many realisations of a model, and say what they are as a whole.
///
/// Each is made by a process of its own, with limits of time and memory, as many at a time as there are processors. Writes to DIR:
/// a folder for each realisation, realisations.csv with all that was drawn and measured, quantiles.csv, correlations.csv,
/// plots, summary.json and summary.html. Interrupted or killed, the same command goes on where it was. The same model, seeds
/// and version give the same bytes, whatever the number of workers.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem ensemble case-study.toml -n 100
  clinothem ensemble case-study.toml --seeds 1..1000 -o thousand --workers 8
  clinothem ensemble case-study.toml -n 200 --latin-hypercube
  clinothem ensemble belt.toml --design design.csv --write tables,step
  clinothem ensemble case-study.toml -n 40 --contact-sheet section,view
  clinothem ensemble case-study.toml -n 50 --scenario 'all:' --scenario 'no-lags: --without lag'
  clinothem ensemble case-study.toml -n 100 --of facies.channel-sand.volume_m3

A design table has a row for each realisation and keys as --set names them for columns:
  seed,feature.channel.count,feature.channel.width
  1,10,\"{ uniform = [20, 60] }\"
  2,20,40")]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is an option of the command line"
)]
pub(super) struct Args {
    #[command(flatten)]
    members: MemberArgs,
    /// What each realisation writes beside its tables: formats as of build; tables for nothing else.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "tables")]
    write: Vec<Format>,
    /// Draw small pictures of each realisation, and sheets of them: contact-section.png, contact-map.png, contact-view.png.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "PICTURE")]
    contact_sheet: Vec<Picture>,
    /// The folder for the results; MODEL-ensemble if not given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Write into a folder that holds other things, or replace another ensemble.
    #[arg(long)]
    force: bool,
    /// How many realisations are made at a time; as many as there are processors if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    workers: Option<u16>,
    /// Stop a realisation that takes longer (s).
    #[arg(long, value_name = "SECONDS", default_value = "1800", value_parser = seconds)]
    time_limit: Duration,
    /// Stop a realisation that wants more memory (MiB of address space); its share of nine tenths of the machine's if not given.
    #[arg(long, value_name = "MIB", value_parser = clap::value_parser!(u64).range(1..=1 << 24))]
    memory_limit: Option<u64>,
    /// What the plots and correlations are about: a column of realisations.csv; the pore volume if not given.
    #[arg(long, value_name = "MEASURE")]
    of: Option<String>,
    /// What makes the solids, as of build.
    #[arg(long, value_enum, default_value_t)]
    engine: Engine,
    /// How thorough the proof of each realisation is.
    #[arg(long, value_enum, default_value_t)]
    proof: ProofLevel,
    /// No progress, no notes and no summary.
    #[arg(long)]
    quiet: bool,
    /// Print the summary as JSON.
    #[arg(long)]
    json: bool,
}

/// The least memory that a realisation gets if it is not said (bytes of address space).
const LEAST_MEMORY: u64 = 1 << 30;

/// What is said if it is interrupted.
const INTERRUPTED: &str =
    "interrupted; what was finished is kept, and the same command goes on from there";

/// Reads a time that is not nothing.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds| *seconds > 0.0);
    seconds
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| format!("`{text}` is no time in seconds above 0"))
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let started = Instant::now();
    if args.members.model.is_standard_input() {
        return Err(Failure::Wrong(
            "an ensemble reads its model many times; save it as a file and name that".to_owned(),
        ));
    }
    load::start_threads()?;
    let (model, _) = load::model(&args.members.model, args.json)?;
    let members = args.members.all(&model)?;
    args.members.check_scenarios(args.json)?;
    let manifest = manifest(args, &model)?;
    let job = job(args, &manifest, members.len())?;
    let output = args
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-ensemble", args.members.model.stem())));
    let cancel = interrupt::cancel_saying(INTERRUPTED)?;
    let folder = Folder::open(&output, &manifest, args.force).map_err(|error| match error {
        FolderError::Io { .. } => Failure::Surroundings(error.to_string()),
        _ => Failure::Wrong(error.to_string()),
    })?;
    let kept: Vec<Option<Settled>> = members
        .par_iter()
        .map(|member| Some(folder.settled(member, &member.key(&job.common))?.outcome))
        .collect();
    let due: Vec<usize> = (0..members.len())
        .filter(|at| kept[*at].is_none())
        .collect();
    let progress = Progress::new(args.quiet || args.json, members.len(), due.len());
    let ended = workers::make(&members, &due, &job, &folder, &cancel, &|end| {
        progress.tell(end);
    });
    progress.done();
    let ended = ended.map_err(|error| match error {
        WorkersError::Cancelled => Failure::Interrupted(INTERRUPTED),
        _ => Failure::Surroundings(format!(
            "{error} (what was finished is kept, and the same command goes on from there)"
        )),
    })?;
    let ends: Vec<End> = ends(kept, &ended);
    let summary = summarise(args, &model, &members, &ends, &folder)?;
    let again: Vec<String> = ended
        .iter()
        .filter(|one| one.attempts > 1)
        .map(|one| members[one.member].name())
        .collect();
    let run = serde_json::json!({
        "seconds": started.elapsed().as_secs_f64(),
        "workers": job.workers,
        "made_now": due.len(),
        "kept": members.len() - due.len(),
        "tried_again": again,
        "seconds_of_each": ended.iter().map(|one| (members[one.member].name(), one.took.as_secs_f64()))
            .collect::<std::collections::BTreeMap<_, _>>(),
    });
    write(&folder, "run.json", format!("{run:#}\n").as_bytes())?;
    tell(args, &summary, &folder, members.len() - due.len())
}

/// The last words, and the exit code.
fn tell(args: &Args, summary: &Summary, folder: &Folder, kept: usize) -> Result<(), Failure> {
    let wrong = |error: serde_json::Error| Failure::Surroundings(error.to_string());
    if args.json {
        print::out(summary.to_json().map_err(wrong)?.trim_end())?;
    } else if !args.quiet {
        for warning in summary.warnings() {
            print::err(&format!("note: {warning}"));
        }
        print::out(words(summary, folder.path(), kept).trim_end())?;
    }
    if summary.unmade.is_empty() {
        return Ok(());
    }
    let first = &summary.unmade[0];
    Err(Failure::Unproven(format!(
        "{} of {} realisations could not be made (the others are whole); the first, {}: {}: {}\n(unmade.csv has them all)",
        summary.unmade.len(),
        summary.unmade.len() + summary.table.rows.len(),
        first.realisation,
        first.outcome,
        first.words
    )))
}

/// What is printed of a summary.
fn words(summary: &Summary, folder: &Path, kept: usize) -> String {
    let mut lines = Vec::new();
    for one in &summary.scenarios {
        let name = one
            .name
            .as_ref()
            .map_or(String::new(), |name| format!("{name}: "));
        lines.push(format!("{name}{} of {} realisations", one.made, one.of));
        if let (Some(spread), Some((nearest, _))) = (one.spread(&summary.result), &one.nearest) {
            lines.push(format!(
                "  {}: P90 {:.6e}, P50 {:.6e}, P10 {:.6e}; nearest to the P50: {nearest}",
                summary.result, spread.low_p90, spread.mid_p50, spread.high_p10
            ));
        }
        if let Some(strongest) = one.correlations.first() {
            lines.push(format!(
                "  goes most with {} (rank correlation {:.2})",
                strongest.parameter, strongest.rank_correlation
            ));
        }
    }
    if kept > 0 {
        lines.push(format!("{kept} were there from before"));
    }
    let path = folder.join("summary.html");
    lines.push(format!("{} has all of it", path.display()));
    lines.join("\n")
}

/// What all realisations have in common.
fn manifest(args: &Args, model: &Model) -> Result<Manifest, Failure> {
    let path = &args.members.model.model;
    let bytes = std::fs::read(path).map_err(|error| Failure::file("read", path, &error))?;
    let files: Vec<_> = model
        .files()
        .map(|(of, file)| (of, &file.sha256))
        .chain(model.solids().map(|(of, solid)| (of, &solid.sha256)))
        .map(|(of, sha256)| serde_json::json!({ "of": of, "sha256": sha256 }))
        .collect();
    let common = [
        ("schema", serde_json::json!("clinothem-ensemble-1")),
        ("version", serde_json::json!(env!("CARGO_PKG_VERSION"))),
        ("model", serde_json::json!(digest(&bytes))),
        ("name", serde_json::json!(model.name)),
        ("files", serde_json::json!(files)),
        ("build", serde_json::json!(build_arguments(args))),
        ("set", serde_json::json!(args.members.model.set)),
        ("without", serde_json::json!(args.members.model.without)),
        ("max_level", serde_json::json!(args.members.model.max_level)),
    ];
    Ok(common.map(|(key, value)| (key.to_owned(), value)).into())
}

/// What `build` is told of all realisations.
fn build_arguments(args: &Args) -> Vec<String> {
    fn word(value: &impl ValueEnum) -> String {
        let value = value.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
    let formats: Vec<String> = args.write.iter().map(word).collect();
    let mut arguments = vec![
        format!("--formats={}", formats.join(",")),
        format!("--engine={}", word(&args.engine)),
        format!("--proof={}", word(&args.proof)),
        "--quiet".to_owned(),
        "--force".to_owned(),
    ];
    if !args.contact_sheet.is_empty() {
        let pictures: Vec<String> = pictures(args).iter().map(word).collect();
        arguments.push(format!("--contact-sheet={}", pictures.join(",")));
    }
    arguments
}

/// What contact sheets show, each once.
fn pictures(args: &Args) -> Vec<Picture> {
    let mut pictures = args.contact_sheet.clone();
    pictures.sort_unstable();
    pictures.dedup();
    pictures
}

fn job(args: &Args, manifest: &Manifest, members: usize) -> Result<Job, Failure> {
    let program = std::env::current_exe().map_err(|error| {
        Failure::Surroundings(format!("the program cannot find itself: {error}"))
    })?;
    let processors = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let workers = args
        .workers
        .map_or(processors, usize::from)
        .min(members)
        .max(1);
    let share = || {
        let all = workers::memory_of_the_machine()?;
        Some((all / 10 * 9 / workers as u64).max(LEAST_MEMORY))
    };
    let memory_limit = match args.memory_limit {
        Some(mebibytes) => Some(mebibytes << 20),
        None => share(),
    };
    let failed = |error: serde_json::Error| Failure::Surroundings(error.to_string());
    Ok(Job {
        program,
        model: args.members.model.model.clone(),
        sha256: manifest["model"].as_str().unwrap_or_default().to_owned(),
        arguments: build_arguments(args),
        common: serde_json::to_string(manifest).map_err(failed)?,
        time_limit: args.time_limit,
        memory_limit,
        workers,
        threads: (processors / workers).max(1),
    })
}

/// How each member ended: before, or now.
fn ends(kept: Vec<Option<Settled>>, ended: &[Ended]) -> Vec<End> {
    let mut now = ended.iter();
    kept.into_iter()
        .map(|settled| match settled {
            Some(settled) => End::Settled(settled),
            None => now.next().map_or_else(
                || End::Crashed("it was not made".to_owned()),
                |one| one.end.clone(),
            ),
        })
        .collect()
}

/// What the report in a realisation's folder says.
fn told(folder: &Path) -> Result<Told, Failure> {
    let path = folder.join("report.json");
    let failed = |error: &std::io::Error| Failure::file("read", &path, error);
    let bytes = std::fs::read(&path).map_err(|error| failed(&error))?;
    let report: serde_json::Value =
        serde_json::from_slice(&bytes).map_err(|error| failed(&error.into()))?;
    Ok(Told::by(&report))
}

/// Reads the reports and writes what they say together.
fn summarise(
    args: &Args,
    model: &Model,
    members: &[Member],
    ends: &[End],
    folder: &Folder,
) -> Result<Summary, Failure> {
    // Of each report the numbers alone are kept; the order is that of the members.
    let told = |(member, end): (&Member, &End)| match end {
        End::Settled(Settled::Made) => told(&folder.of(member)).map(Some),
        _ => Ok(None),
    };
    let pairs = members.par_iter().zip(ends);
    let told: Vec<Option<Told>> = pairs.map(told).collect::<Result<_, Failure>>()?;
    let all: Vec<_> = members
        .iter()
        .zip(ends)
        .zip(told)
        .map(|((member, end), told)| (member, end, told))
        .collect();
    let summary = Summary::new(&model.name, &all, args.of.as_deref())
        .map_err(|error| Failure::Wrong(error.to_string()))?;
    let failed = |error: &dyn std::fmt::Display| Failure::Surroundings(error.to_string());
    let tables = [
        ("realisations.csv", summary::realisations(&summary)),
        ("quantiles.csv", summary::quantiles(&summary)),
        ("correlations.csv", summary::correlations(&summary)),
        ("unmade.csv", summary::unmade(&summary)),
    ];
    for (name, table) in tables {
        write(
            folder,
            name,
            table.map_err(|error| failed(&error))?.as_bytes(),
        )?;
    }
    let parquet = summary::parquet(&summary).map_err(|error| failed(&error))?;
    write(folder, "realisations.parquet", &parquet)?;
    let json = summary.to_json().map_err(|error| failed(&error))?;
    write(folder, "summary.json", json.as_bytes())?;
    let plots = summary::plots(&summary).map_err(|error| failed(&error))?;
    for plot in &plots {
        write(folder, &format!("{}.svg", plot.name), plot.svg.as_bytes())?;
        let png = plot.png().map_err(|error| failed(&error))?;
        write(folder, &format!("{}.png", plot.name), &png)?;
    }
    let sheets = contact_sheets(args, model, members, &summary, folder)?;
    for sheet in &sheets {
        write(folder, &format!("{}.png", sheet.name), &sheet.png)?;
    }
    write(
        folder,
        "summary.html",
        summary::page(&summary, &plots, &sheets).as_bytes(),
    )?;
    Ok(summary)
}

/// A sheet of each kind of small picture, of as many realisations as one can hold.
fn contact_sheets(
    args: &Args,
    model: &Model,
    members: &[Member],
    summary: &Summary,
    folder: &Folder,
) -> Result<Vec<summary::Sheet>, Failure> {
    let rows = &summary.table.rows;
    let result = summary.table.measure(&summary.result);
    let legend: Vec<Swatch> = model
        .facies
        .iter()
        .map(|facies| Swatch {
            name: facies.name.clone(),
            color: Rgb(facies.color.r, facies.color.g, facies.color.b),
        })
        .collect();
    let chosen = tiles::chosen(rows.len());
    let some = if chosen.len() < rows.len() {
        format!("{} of ", chosen.len())
    } else {
        String::new()
    };
    let sheet = |picture: Picture| {
        let tile = |at: &usize| {
            let row = &rows[*at];
            let value = result.and_then(|result| row.values[result]);
            let member = members.iter().find(|member| member.name() == row.name);
            let path = member.map_or_else(PathBuf::new, |member| folder.of(member));
            let path = path.join(picture.file());
            let png = std::fs::read(&path).map_err(|error| Failure::file("read", &path, &error))?;
            let value = value.map_or_else(String::new, |value| format!(" · {value:.4e}"));
            let caption = format!("{}{value}", row.name);
            Ok(Tile { png, caption })
        };
        let caption = format!("{}: {}", model.name, picture.words());
        let png = ContactSheet {
            title: caption.clone(),
            subtitle: format!(
                "{some}{} realisations, with their {}",
                rows.len(),
                summary.result.replace('_', " ").replace(" m3", " (m³)")
            ),
            tiles: chosen.iter().map(tile).collect::<Result<_, Failure>>()?,
            legend: legend.clone(),
        }
        .png()
        .map_err(|error| Failure::Surroundings(error.to_string()))?;
        let name = format!("contact-{}", picture.name());
        Ok(summary::Sheet { name, caption, png })
    };
    pictures(args).into_iter().map(sheet).collect()
}

fn write(folder: &Folder, name: &str, bytes: &[u8]) -> Result<(), Failure> {
    let written = folder.write(name, bytes);
    written.map_err(|error| Failure::file("write", &folder.path().join(name), &error))
}

/// How far it is, on a terminal.
struct Progress {
    bar: ProgressBar,
}

impl Progress {
    fn new(quiet: bool, of: usize, due: usize) -> Self {
        let words =
            format!("[{{bar:30}}] {{pos}}/{{len}} of {of}  {{elapsed}}, {{eta}} to go  {{msg}}");
        Self {
            bar: progress::bar(quiet, due as u64, &words),
        }
    }

    fn tell(&self, ended: &Ended) {
        self.bar.inc(1);
        if ended.end != End::Settled(Settled::Made) {
            self.bar
                .set_message(format!("the last that failed: {}", ended.end.word()));
        }
    }

    fn done(&self) {
        self.bar.finish_and_clear();
    }
}
