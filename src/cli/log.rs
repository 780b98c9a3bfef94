//! `clinothem log`: what wells pass through.

use std::path::PathBuf;

use glam::DVec3;

use super::args::{ModelArgs, finite, numbers};
use super::failure::Failure;
use super::files;
use super::load::{self, Loaded};
use super::print;
use crate::export::table;
use crate::export::wells::entries::{WellEntry, Wells};
use crate::export::wells::gocad::GocadWell;
use crate::export::wells::las::Las;
use crate::export::wells::pline;
use crate::features::survey::Station;
use crate::features::well::{Path, Well};
use crate::model::realisation::Realisation;
use crate::model::wells::log::{Logger, WellLog};
use crate::model::wells::spec::{METRE, WellSpec};
use crate::model::{Model, Place};
use crate::nurbs::interpolate::Parametrization;

/// Tell what the model's wells pass through, or a vertical line anywhere: volumes by measured depth, or a log.
///
/// Needs no kernel: paths are met with the surfaces themselves, and the point evaluator names what lies between. A table is
/// printed, or written as CSV; a file whose name ends in .las is a log at even steps. Paths are written as curves that are split where they
/// pass from one volume to another (.step), or as lines (.pl, .wl).
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem log coastal.toml --at 180,330
  clinothem log fig02-wells.toml
  clinothem log fig02-wells.toml --well A-1 -o A-1.las --step 0.25
  clinothem log fig02-wells.toml -o wells.csv
  clinothem log fig02-wells.toml -o wells.step")]
pub(super) struct Args {
    #[command(flatten)]
    model: ModelArgs,
    /// One well of the model, by its id, or a lateral of it (A-1/north); repeatable. All if not given.
    #[arg(long, value_name = "ID", conflicts_with = "at")]
    well: Vec<String>,
    /// A vertical line: easting,northing (m).
    #[arg(long, value_name = "X,Y", value_parser = numbers::<2>, allow_hyphen_values = true)]
    at: Option<[f64; 2]>,
    /// From line to line of a log, in the unit of the well's depths.
    #[arg(long, value_name = "LENGTH", value_parser = finite, default_value = "0.1", allow_negative_numbers = true)]
    step: f64,
    /// Where to write; the name's ending decides the format: .csv, .las (a log), .wl (a GOCAD well: the path with markers), .pl (GOCAD
    /// lines, of all wells), .step (exact curves, of all wells). Printed as CSV if not given.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print JSON: what a build's report says of wells.
    #[arg(long, conflicts_with = "output")]
    json: bool,
}

/// What a file is to be.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Csv,
    Las,
    Gocad,
    Pline,
    Step,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let format = format(args)?;
    let loaded = load::realise(&args.model, args.json)?;
    let owners = loaded.owners()?;
    let logger = Logger::new(&loaded.realisation, &owners)
        .map_err(|error| Failure::Wrong(error.to_string()))?;
    let chosen = match args.at {
        Some(at) => vec![vertical(at, &loaded)?],
        None => wells(args, &loaded)?,
    };
    let logs: Vec<WellLog> = chosen.iter().map(|spec| spec.log(&logger)).collect();
    if let (Format::Las | Format::Gocad, Some(path)) = (format, &args.output) {
        let ([spec], [log]) = (&chosen[..], &logs[..]) else {
            return Err(Failure::Wrong(format!(
                "such a file holds one well, and there are {}; choose one with --well",
                chosen.len()
            )));
        };
        return files::write(path, of_one(args, format, &loaded, spec, log)?.as_bytes());
    }
    if let (Format::Pline, Some(path)) = (format, &args.output) {
        let wells: Vec<GocadWell<'_>> = chosen
            .iter()
            .zip(&logs)
            .map(|(spec, log)| gocad(&loaded, spec, log))
            .collect();
        return files::write(path, pline::text(&wells).as_bytes());
    }
    let wells = Wells {
        model: &loaded.model,
        realisation: &loaded.realisation,
    };
    let entries: Vec<WellEntry> = chosen
        .iter()
        .zip(&logs)
        .map(|(spec, log)| wells.entry(spec, log))
        .collect();
    if args.json {
        let json = serde_json::to_string(&entries)
            .map_err(|error| Failure::Surroundings(error.to_string()))?;
        return print::out(&json);
    }
    if let (Format::Step, Some(path)) = (format, &args.output) {
        let pairs: Vec<_> = chosen.iter().zip(&entries).collect();
        let (model, realisation) = (&loaded.model, &loaded.realisation);
        return write_step(path, model, realisation, &pairs);
    }
    let csv = table::csv(&table::wells(&entries))
        .map_err(|error| Failure::Surroundings(error.to_string()))?;
    match &args.output {
        Some(path) => files::write(path, csv.as_bytes()),
        None => print::out(csv.trim_end()),
    }
}

#[cfg(feature = "occt")]
fn write_step(
    path: &std::path::Path,
    model: &Model,
    realisation: &Realisation,
    wells: &[(&WellSpec, &WellEntry)],
) -> Result<(), Failure> {
    use crate::export::step;
    step::write_wells(path, model, realisation, wells, step::Protocol::default())
        .map_err(|error| Failure::Surroundings(error.to_string()))
}

#[cfg(not(feature = "occt"))]
fn write_step(
    path: &std::path::Path,
    _: &Model,
    _: &Realisation,
    _: &[(&WellSpec, &WellEntry)],
) -> Result<(), Failure> {
    Err(Failure::Wrong(format!(
        "{}: STEP is written by a program that is built with OpenCASCADE; this one writes .pl, .wl, .las and .csv",
        path.display()
    )))
}

/// A file of one well.
fn of_one(
    args: &Args,
    format: Format,
    loaded: &Loaded,
    spec: &WellSpec,
    log: &WellLog,
) -> Result<String, Failure> {
    if format == Format::Gocad {
        return Ok(gocad(loaded, spec, log).text());
    }
    let las = Las {
        model: &loaded.model,
        realisation: &loaded.realisation,
        spec,
        log,
        step: args.step,
    };
    las.text()
        .map_err(|error| Failure::Wrong(error.to_string()))
}

fn gocad<'a>(loaded: &'a Loaded, spec: &'a WellSpec, log: &'a WellLog) -> GocadWell<'a> {
    GocadWell {
        model: &loaded.model,
        realisation: &loaded.realisation,
        spec,
        log,
    }
}

/// What the output's name asks for.
fn format(args: &Args) -> Result<Format, Failure> {
    let Some(path) = &args.output else {
        return Ok(Format::Csv);
    };
    let ending = path
        .extension()
        .map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("csv") => Ok(Format::Csv),
        Some("las") => Ok(Format::Las),
        Some("wl") => Ok(Format::Gocad),
        Some("pl") => Ok(Format::Pline),
        Some("step" | "stp") => Ok(Format::Step),
        _ => Err(Failure::Wrong(format!(
            "{}: a log's name ends in .csv, .las, .wl, .pl or .step",
            path.display()
        ))),
    }
}

/// The wells that were asked for.
fn wells(args: &Args, loaded: &Loaded) -> Result<Vec<WellSpec>, Failure> {
    let all = &loaded.model.wells;
    if all.is_empty() {
        return Err(Failure::Wrong(
            "the model has no wells; give a place in plan with --at X,Y, or add a [[well]]"
                .to_owned(),
        ));
    }
    if args.well.is_empty() {
        return Ok(all.clone());
    }
    let mut chosen = Vec::with_capacity(args.well.len());
    for name in &args.well {
        let Some(found) = all.iter().find(|well| well.name == *name) else {
            let names: Vec<&str> = all.iter().map(|well| well.name.as_str()).collect();
            return Err(Failure::Wrong(format!(
                "there is no well {name:?}; there are {}",
                names.join(", ")
            )));
        };
        chosen.push(found.clone());
    }
    Ok(chosen)
}

/// A vertical line through the domain. Its depths are below mean sea level, or below the domain's top where that is higher.
fn vertical([x, y]: [f64; 2], loaded: &Loaded) -> Result<WellSpec, Failure> {
    let domain = &loaded.model.domain;
    let within = |at: f64, [low, high]: [f64; 2]| low <= at && at <= high;
    if !(within(x, domain.x) && within(y, domain.y)) {
        return Err(Failure::Wrong(format!(
            "the place {x}, {y} lies outside the domain: x {:?}, y {:?}",
            domain.x, domain.y
        )));
    }
    let [base, top] = domain.z;
    let sea_level = -loaded.model.origin[2];
    let reference = top.max(sea_level);
    let station = |z: f64| Station {
        md: Some(reference - z),
        point: DVec3::new(x, y, z),
        tangent: None,
    };
    let path = Path::Spline(Parametrization::ChordLength);
    let well = Well::new(vec![station(top), station(base)], path)
        .map_err(|error| Failure::Wrong(error.to_string()))?;
    Ok(WellSpec {
        name: format!("{x} {y}"),
        mother: None,
        well,
        path,
        datum: reference - sea_level,
        sea_level,
        unit: METRE,
        completions: Vec::new(),
        diameter: None,
        source: None,
        place: Place::default(),
    })
}
