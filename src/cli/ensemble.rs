//! `clinothem ensemble`: many realisations, each in a process of its own, and what they are as a whole.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::args::ModelArgs;
use super::engine::{Engine, ProofLevel};
use super::failure::Failure;
use super::outputs::Format;
use super::{interrupt, load, print, scenarios};
use crate::ensemble::Member;
use crate::ensemble::design::Design;
use crate::ensemble::folder::{Folder, FolderError, Manifest, Settled};
use crate::ensemble::member::{Changes, Scenario, digest};
use crate::ensemble::summary::{self, Summary};
use crate::ensemble::workers::{self, End, Ended, Job, WorkersError};
use crate::model::{Model, Source, Stratum};

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
    model: ModelArgs,
    /// How many realisations, with the model's seed (or --seed) and those after it.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    n: Option<u32>,
    /// The seeds, the first and the last.
    #[arg(long, value_name = "A..B", value_parser = seeds, conflicts_with_all = ["n", "seed"])]
    seeds: Option<(u64, u64)>,
    /// A table with a row for each realisation: columns are keys of the model, and seed.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["n", "seeds", "latin_hypercube"])]
    design: Option<PathBuf>,
    /// Draw each parameter once from every n-th of its distribution (a Latin hypercube), not at random.
    #[arg(long)]
    latin_hypercube: bool,
    /// A variant of the model, drawn with the same seeds: 'NAME: --without ID --set KEY=VALUE --max-level N'; repeatable.
    #[arg(long, value_name = "SCENARIO", value_parser = scenarios::read)]
    scenario: Vec<Scenario>,
    /// What each realisation writes beside its tables: formats as of build; tables for nothing else.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "tables")]
    write: Vec<Format>,
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

/// Reads `A..B`.
fn seeds(text: &str) -> Result<(u64, u64), String> {
    let ends = text
        .split_once("..")
        .and_then(|(first, last)| Some((first.parse().ok()?, last.parse().ok()?)));
    match ends {
        Some((first, last)) if first <= last && last - first < 1_000_000 => Ok((first, last)),
        _ => Err(format!(
            "`{text}` are no seeds; write the first and the last, at most a million of them, as 1..100"
        )),
    }
}

/// Reads a time that is not nothing.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds| *seconds > 0.0);
    seconds
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| format!("`{text}` is no time in seconds above 0"))
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let started = Instant::now();
    if args.model.is_standard_input() {
        return Err(Failure::Wrong(
            "an ensemble reads its model many times; save it as a file and name that".to_owned(),
        ));
    }
    load::start_threads()?;
    let (model, _) = load::model(&args.model, args.json)?;
    let members = members(args, &model)?;
    check_scenarios(args)?;
    let manifest = manifest(args, &model)?;
    let job = job(args, &manifest, members.len())?;
    let output = args
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-ensemble", args.model.stem())));
    let cancel = interrupt::cancel_saying(INTERRUPTED)?;
    let folder = Folder::open(&output, &manifest, args.force).map_err(|error| match error {
        FolderError::Io { .. } => Failure::Surroundings(error.to_string()),
        _ => Failure::Wrong(error.to_string()),
    })?;
    let kept: Vec<Option<Settled>> = members
        .iter()
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

/// What is to be made: for each scenario, each seed or row.
fn members(args: &Args, model: &Model) -> Result<Vec<Member>, Failure> {
    let common = Changes {
        set: args.model.set.clone(),
        without: args.model.without.clone(),
        max_level: args.model.max_level,
    };
    if args.model.stratum.is_some() {
        return Err(Failure::Wrong(
            "--stratum is of one realisation; of an ensemble write --latin-hypercube".to_owned(),
        ));
    }
    if args.model.parameters.is_some() {
        return Err(Failure::Wrong(
            "--parameters is of one realisation; of an ensemble write --design, or --set"
                .to_owned(),
        ));
    }
    let plain = match (&args.design, args.seeds, args.n) {
        (Some(path), ..) => designed(args, path, model.seed)?,
        (None, seeds, n) => {
            let (first, count) = match (seeds, n) {
                (Some((first, last)), _) => (first, last - first + 1),
                (None, Some(n)) => (model.seed, u64::from(n)),
                (None, None) => {
                    return Err(Failure::Wrong(
                        "how many realisations? write -n 100, --seeds 1..100 or --design FILE"
                            .to_owned(),
                    ));
                }
            };
            drawn(args, first, count)?
        }
    };
    let mut scenarios: Vec<Option<&Scenario>> = args.scenario.iter().map(Some).collect();
    if scenarios.is_empty() {
        scenarios.push(None);
    }
    let of = |scenario: Option<&Scenario>| {
        let changes = scenario.map_or_else(|| common.clone(), |one| common.and(&one.changes));
        let name = scenario.map(|one| one.name.clone());
        let one = move |member: &Member| Member {
            scenario: name.clone(),
            changes: changes.and(&member.changes),
            ..member.clone()
        };
        plain.iter().map(one).collect::<Vec<_>>()
    };
    Ok(scenarios.into_iter().flat_map(of).collect())
}

fn drawn(args: &Args, first: u64, count: u64) -> Result<Vec<Member>, Failure> {
    if first.checked_add(count).is_none() {
        return Err(Failure::Wrong(format!(
            "seeds end at {}; begin with a smaller one than {first}",
            u64::MAX
        )));
    }
    let member = |at: u64| Member {
        number: usize::try_from(at).unwrap_or(usize::MAX).saturating_add(1),
        scenario: None,
        seed: first + at,
        stratum: args
            .latin_hypercube
            .then(|| Stratum::new(at + 1, count))
            .flatten(),
        design: Vec::new(),
        changes: Changes::default(),
    };
    Ok((0..count).map(member).collect())
}

/// The members of a design table, which is checked as a whole, in each scenario's model.
fn designed(args: &Args, path: &Path, seed: u64) -> Result<Vec<Member>, Failure> {
    let design = Design::read(path).map_err(|error| Failure::Wrong(error.to_string()))?;
    let mut plain = source(args)?;
    for assignment in &args.model.set {
        plain.set(assignment.clone());
    }
    let mut sources = vec![plain.clone()];
    for scenario in &args.scenario {
        let mut source = plain.clone();
        for assignment in &scenario.changes.set {
            source.set(assignment.clone());
        }
        sources.push(source);
    }
    for source in &sources {
        design
            .check(source)
            .map_err(|error| Failure::Wrong(error.to_string()))?;
    }
    let member = |(at, row): (usize, &crate::ensemble::design::Row)| {
        let values = design.values(row);
        let design: Vec<(String, String)> = values
            .map(|(key, value)| (key.to_owned(), value.to_owned()))
            .collect();
        Member {
            number: at + 1,
            scenario: None,
            seed: row.seed.unwrap_or(seed),
            stratum: None,
            changes: Changes {
                set: design
                    .iter()
                    .map(|(key, value)| format!("{key}={value}"))
                    .collect(),
                ..Changes::default()
            },
            design,
        }
    };
    Ok(design.rows.iter().enumerate().map(member).collect())
}

fn source(args: &Args) -> Result<Source, Failure> {
    Source::read(&args.model.model).map_err(|error| Failure::Wrong(error.to_string()))
}

/// Each scenario must be a model, and have a name of its own.
fn check_scenarios(args: &Args) -> Result<(), Failure> {
    for (at, scenario) in args.scenario.iter().enumerate() {
        let name = &scenario.name;
        if args.scenario[..at].iter().any(|other| other.name == *name) {
            return Err(Failure::Wrong(format!(
                "two scenarios are called `{name}`; give each a name of its own"
            )));
        }
        let all = ModelArgs {
            model: args.model.model.clone(),
            seed: args.model.seed,
            stratum: None,
            parameters: None,
            parameter_names: None,
            set: [&args.model.set[..], &scenario.changes.set].concat(),
            without: [&args.model.without[..], &scenario.changes.without].concat(),
            max_level: scenario.changes.max_level.or(args.model.max_level),
        };
        load::model(&all, args.json).map_err(|failure| match failure {
            Failure::Wrong(text) => Failure::Wrong(format!("scenario `{name}`: {text}")),
            other => {
                print::err(&format!("scenario `{name}`:"));
                other
            }
        })?;
    }
    Ok(())
}

/// What all realisations have in common.
fn manifest(args: &Args, model: &Model) -> Result<Manifest, Failure> {
    let path = &args.model.model;
    let bytes = std::fs::read(path).map_err(|error| Failure::file("read", path, &error))?;
    let files: Vec<_> = model
        .files()
        .map(|(of, file)| serde_json::json!({ "of": of, "sha256": file.sha256 }))
        .collect();
    let common = [
        ("schema", serde_json::json!("clinothem-ensemble-1")),
        ("version", serde_json::json!(env!("CARGO_PKG_VERSION"))),
        ("model", serde_json::json!(digest(&bytes))),
        ("name", serde_json::json!(model.name)),
        ("files", serde_json::json!(files)),
        ("build", serde_json::json!(build_arguments(args))),
        ("set", serde_json::json!(args.model.set)),
        ("without", serde_json::json!(args.model.without)),
        ("max_level", serde_json::json!(args.model.max_level)),
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
    vec![
        format!("--formats={}", formats.join(",")),
        format!("--engine={}", word(&args.engine)),
        format!("--proof={}", word(&args.proof)),
        "--quiet".to_owned(),
        "--force".to_owned(),
    ]
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
        model: args.model.model.clone(),
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

/// Reads the reports and writes what they say together.
fn summarise(
    args: &Args,
    model: &Model,
    members: &[Member],
    ends: &[End],
    folder: &Folder,
) -> Result<Summary, Failure> {
    let mut all = Vec::new();
    for (member, end) in members.iter().zip(ends) {
        let report = match end {
            End::Settled(Settled::Made) => {
                let path = folder.of(member).join("report.json");
                let failed = |error: &std::io::Error| Failure::file("read", &path, error);
                let bytes = std::fs::read(&path).map_err(|error| failed(&error))?;
                let report: serde_json::Value =
                    serde_json::from_slice(&bytes).map_err(|error| failed(&error.into()))?;
                Some(report)
            }
            _ => None,
        };
        all.push((member, end, report));
    }
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
    let json = summary.to_json().map_err(|error| failed(&error))?;
    write(folder, "summary.json", json.as_bytes())?;
    let plots = summary::plots(&summary).map_err(|error| failed(&error))?;
    for plot in &plots {
        write(folder, &format!("{}.svg", plot.name), plot.svg.as_bytes())?;
        let png = plot.png().map_err(|error| failed(&error))?;
        write(folder, &format!("{}.png", plot.name), &png)?;
    }
    write(
        folder,
        "summary.html",
        summary::page(&summary, &plots).as_bytes(),
    )?;
    Ok(summary)
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
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(due as u64), target);
        let words =
            format!("[{{bar:30}}] {{pos}}/{{len}} of {of}  {{elapsed}}, {{eta}} to go  {{msg}}");
        let style = ProgressStyle::with_template(&words);
        bar.set_style(
            style
                .unwrap_or_else(|_| ProgressStyle::default_bar())
                .progress_chars("=> "),
        );
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(250));
        }
        Self { bar }
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
