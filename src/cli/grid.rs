//! `clinothem grid`: cells with their volumes and rock.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use glam::DVec3;

use super::args::{ModelArgs, finite};
use super::failure::Failure;
use super::load::{self, Loaded};
use super::progress::Progress;
use super::{files, print};
use crate::export::grid::arrays::Arrays;
use crate::export::grid::format::Format;
use crate::export::grid::frame::Cells;
use crate::export::grid::key::Key;
use crate::export::grid::layers::Layers;
use crate::export::grid::plan::{Division, Plan};
use crate::export::grid::sampled::{Grid, Source};
use crate::export::grid::{self, GridError};

/// Sample the model on a grid: volume, facies and rock of each cell, for programs that know grids alone.
///
/// Needs no kernel: the point evaluator fills the cells, on all cores. Writes to DIR a file for each format (npy: for each array),
/// and MODEL.grid.json and MODEL.grid.csv, which say what the numbers mean. Coordinates are world coordinates: the model's origin is
/// added. Cells count eastward, northward and upward; in grdecl eastward, southward and downward, with depths positive down.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem grid belt.toml                                       100 x 100 x 50 cells as VTK ImageData
  clinothem grid belt.toml --cells 200x200x100 --formats vti,npy
  clinothem grid belt.toml --cell 25x25x1 --samples 8 --formats gslib,sgems -o grids
  clinothem grid belt.toml --cells 100x80x50 --formats grdecl    boxes as corner points
  clinothem grid coast.toml --cells 100x80 --layers 10           10 layers between successive horizons")]
pub(super) struct Args {
    #[command(flatten)]
    model: ModelArgs,
    /// Cells along x, y and z; with --layers along x and y. [default: 100x100x50]
    #[arg(long, value_name = "NXxNYxNZ", value_parser = counts, conflicts_with = "cell", allow_hyphen_values = true)]
    cells: Option<Division>,
    /// Size of a cell along x, y and z (m); with --layers along x and y. From the lower corner of the domain on: the last cells
    /// may reach beyond it.
    #[arg(long, value_name = "DXxDYxDZ", value_parser = sizes, allow_hyphen_values = true)]
    cell: Option<Division>,
    /// Layers between successive horizons, the domain's base and top among them: one number for all, or one for each interval
    /// from the base up. The cells' corners follow the horizons.
    #[arg(
        long,
        value_name = "N[,N…]",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    layers: Vec<usize>,
    /// Samples in each cell: 1 (its middle), 8, 27 or another cube up to 1000. The facies with most of them has the cell.
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        value_parser = samples,
        allow_negative_numbers = true
    )]
    samples: usize,
    /// Files to write: vti (VTK), npy (NumPy), gslib, sgems, grdecl (Eclipse). [default: vti; grdecl with --layers]
    #[arg(long, value_enum, value_delimiter = ',')]
    formats: Vec<FormatName>,
    /// The folder for the results; MODEL-grid if not given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Keep the model's own coordinates: do not add its origin.
    #[arg(long)]
    local: bool,
    /// Refuse grids whose files would take more than this (GB).
    #[arg(long, value_name = "GB", value_parser = finite, default_value = "8", allow_negative_numbers = true)]
    most_gb: f64,
    /// Print what the numbers mean as JSON instead of a table.
    #[arg(long)]
    json: bool,
    /// No progress bar, no notes and no table.
    #[arg(long)]
    quiet: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum FormatName {
    Vti,
    Npy,
    Gslib,
    Sgems,
    Grdecl,
}

impl From<FormatName> for Format {
    fn from(name: FormatName) -> Self {
        match name {
            FormatName::Vti => Self::Vti,
            FormatName::Npy => Self::Npy,
            FormatName::Gslib => Self::Gslib,
            FormatName::Sgems => Self::Sgems,
            FormatName::Grdecl => Self::Grdecl,
        }
    }
}

/// What stands between the numbers of two or three axes.
const BETWEEN: [char; 3] = ['x', 'X', '×'];

/// Reads `100x80x50`.
fn counts(text: &str) -> Result<Division, String> {
    let wrong =
        || format!("`{text}` is not two or three whole numbers with x between them, as 100x80x50");
    let counts: Vec<usize> = text
        .split(BETWEEN)
        .map(|part| part.trim().parse().map_err(|_| wrong()))
        .collect::<Result<_, _>>()?;
    match counts.len() {
        2 | 3 => Ok(Division::Counts(counts)),
        _ => Err(wrong()),
    }
}

/// Reads `25x25x0.5`.
fn sizes(text: &str) -> Result<Division, String> {
    let sizes: Vec<f64> = text.split(BETWEEN).map(finite).collect::<Result<_, _>>()?;
    match sizes.len() {
        2 | 3 => Ok(Division::Sizes(sizes)),
        _ => Err(format!(
            "`{text}` is not two or three lengths with x between them, as 25x25x0.5"
        )),
    }
}

/// Samples along a side of as many in all.
fn samples(text: &str) -> Result<usize, String> {
    let found = text.trim().parse::<usize>().ok();
    found
        .and_then(|all| (1..=10).find(|side: &usize| side.pow(3) == all))
        .ok_or_else(|| {
            format!("`{text}` is no cube of a whole number: write 1, 8, 27, 64, … up to 1000")
        })
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let formats = formats(args)?;
    let folder = args
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-grid", args.model.stem())));
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::Wrong(format!(
            "{} is a file; name a folder with -o",
            folder.display()
        )));
    }
    let loaded = load::realise(&args.model, args.json)?;
    let say = |note: &str| {
        if !args.quiet {
            print::err(&format!("note: {note}"));
        }
    };
    for note in loaded.notes() {
        say(&note);
    }
    let cells = cells(args, &loaded)?;
    let arrays = Arrays::new(&loaded.model, &loaded.realisation);
    affordable(
        args,
        &cells,
        grid::bytes(&cells, &arrays, &formats),
        &formats,
    )?;
    let owners = loaded.owners()?;
    let source = Source {
        model: &loaded.model,
        realisation: &loaded.realisation,
        owners: &owners,
        cells: &cells,
        samples: args.samples,
        shift: if args.local {
            DVec3::ZERO
        } else {
            DVec3::from_array(loaded.model.origin)
        },
    };
    let progress = Progress::new(args.quiet || args.json);
    let written = write(source, &formats, &folder, &args.model.stem(), &progress);
    progress.done();
    let (key, names) = written?;
    for note in notes(&key, &formats) {
        say(&note);
    }
    if args.json {
        let json = key
            .to_json()
            .map_err(|error| Failure::Surroundings(error.to_string()))?;
        print::out(json.trim_end())
    } else if args.quiet {
        Ok(())
    } else {
        print::out(summary(&key, &folder, &names).trim_end())
    }
}

/// The formats asked for, each once.
fn formats(args: &Args) -> Result<Vec<Format>, Failure> {
    let mut formats: Vec<Format> = args.formats.iter().map(|name| (*name).into()).collect();
    formats.sort_unstable();
    formats.dedup();
    if formats.is_empty() {
        formats.push(if args.layers.is_empty() {
            Format::Vti
        } else {
            Format::Grdecl
        });
    }
    match formats.iter().find(|format| !format.holds_layers()) {
        Some(format) if !args.layers.is_empty() => {
            Err(Failure::Wrong(GridError::Layers(*format).to_string()))
        }
        _ => Ok(formats),
    }
}

/// The cells asked for.
fn cells(args: &Args, loaded: &Loaded) -> Result<Cells, Failure> {
    let wrong = |error: &dyn std::fmt::Display| Failure::Wrong(error.to_string());
    let extent = &loaded.realisation.extent;
    let (follows, needed) = (
        !args.layers.is_empty(),
        if args.layers.is_empty() { 3 } else { 2 },
    );
    let usual = || Division::Counts(vec![100, 100, 50][..needed].to_vec());
    let division = args.cells.as_ref().or(args.cell.as_ref());
    let division = division.cloned().unwrap_or_else(usual);
    if division.axes() != needed {
        let remedy = if follows {
            "with --layers cells are given along x and y alone, as 100x80"
        } else {
            "cells are given along x, y and z, as 100x80x50; for layers that follow the horizons add --layers"
        };
        return Err(Failure::Wrong(format!(
            "there are numbers along {} axes: {remedy}",
            division.axes()
        )));
    }
    if follows {
        let plan = Plan::new(extent, &division).map_err(|error| wrong(&error))?;
        // Before anything is made of so many pillars.
        let layers = args
            .layers
            .iter()
            .fold(0_usize, |sum, one| sum.saturating_add(*one));
        let count = plan
            .counts
            .iter()
            .fold(layers.max(1) as f64, |n, one| n * *one as f64);
        affordable_count(args, count, 12.0 * count)?;
        Layers::new(&loaded.realisation, plan, &args.layers)
            .map(Cells::Layers)
            .map_err(|error| wrong(&error))
    } else {
        Cells::boxes(extent, &division).map_err(|error| wrong(&error))
    }
}

/// Refuses a grid whose files would be too large.
fn affordable(args: &Args, cells: &Cells, bytes: f64, formats: &[Format]) -> Result<(), Failure> {
    affordable_count(args, cells.len() as f64, bytes).map_err(|failure| match failure {
        Failure::Wrong(text) if formats.len() > 1 => {
            Failure::Wrong(format!("{text}; or ask for fewer formats"))
        }
        other => other,
    })
}

fn affordable_count(args: &Args, count: f64, bytes: f64) -> Result<(), Failure> {
    const GB: f64 = 1e9;
    if bytes <= args.most_gb * GB {
        return Ok(());
    }
    Err(Failure::Wrong(format!(
        "a grid of {count:.3e} cells would take up to {:.3} GB, more than the {} GB of --most-gb; take larger cells, or \
         raise --most-gb if the disk has room",
        bytes / GB,
        args.most_gb
    )))
}

/// What the names of folders of unfinished files begin with.
const UNFINISHED: &str = ".unfinished-grid-";

/// Samples, and writes everything into a folder of unfinished files, from which it is renamed file by file.
fn write(
    source: Source<'_>,
    formats: &[Format],
    folder: &Path,
    stem: &str,
    progress: &Progress,
) -> Result<(Key, Vec<String>), Failure> {
    let failed = |error: std::io::Error| Failure::file("write to", folder, &error);
    let is_new = !folder.exists();
    std::fs::create_dir_all(folder).map_err(failed)?;
    let staging = tempfile::Builder::new()
        .prefix(UNFINISHED)
        .tempdir_in(folder)
        .map_err(failed)?;
    #[cfg(feature = "occt")]
    super::interrupt::cancel()?;
    #[cfg(feature = "occt")]
    super::interrupt::unfinished_in(Some(if is_new { folder } else { staging.path() }));
    let result =
        write_files(source, formats, staging.path(), stem, progress).and_then(|(key, names)| {
            files::publish(staging.path(), folder, &names)?;
            Ok((key, names))
        });
    drop(staging);
    if result.is_err() && is_new {
        drop(std::fs::remove_dir(folder));
    }
    #[cfg(feature = "occt")]
    super::interrupt::unfinished_in(None);
    result
}

fn write_files(
    source: Source<'_>,
    formats: &[Format],
    staging: &Path,
    stem: &str,
    progress: &Progress,
) -> Result<(Key, Vec<String>), Failure> {
    let failed = |error: &dyn std::fmt::Display| Failure::Surroundings(error.to_string());
    progress.stage("sampling");
    let grid = Grid::new(source, staging, &|done| progress.part(done))
        .map_err(|error| Failure::file("write to", staging, &error))?;
    let mut names = Vec::new();
    for format in formats {
        progress.stage(format.name());
        names.extend(grid::write(&grid, *format, staging, stem).map_err(|error| failed(&error))?);
    }
    let key = Key::new(&grid, formats, stem);
    let csv = key.to_csv().map_err(|error| failed(&error))?;
    let json = key.to_json().map_err(|error| failed(&error))?;
    for (ending, bytes) in [("csv", csv), ("json", json.into_bytes())] {
        let name = format!("{stem}.grid.{ending}");
        let path = staging.join(&name);
        std::fs::write(&path, bytes).map_err(|error| Failure::file("write", &path, &error))?;
        names.push(name);
    }
    Ok((key, names))
}

/// What is worth saying of a grid.
fn notes(key: &Key, formats: &[Format]) -> Vec<String> {
    let mut notes = Vec::new();
    let has = |format: Format| formats.contains(&format);
    for array in &key.arrays {
        if !array.unknown_in.is_empty() {
            let instead = if has(Format::Grdecl) {
                "; grdecl has 0 there"
            } else {
                ""
            };
            notes.push(format!(
                "{} is not known of {}{instead}",
                array.name,
                array.unknown_in.join(", ")
            ));
        }
        if array.keyword.is_none() && has(Format::Grdecl) {
            notes.push(format!(
                "{} is not in grdecl, which has permeabilities along x, y and z alone",
                array.name
            ));
        }
    }
    notes
}

/// The readable summary: facies by cells.
fn summary(key: &Key, folder: &Path, names: &[String]) -> String {
    let [nx, ny, nz] = key.cells;
    let mut out = String::new();
    let total: u64 = key.facies.iter().map(|facies| facies.cells).sum();
    let _ = write!(out, "{nx} × {ny} × {nz} cells");
    if let Some([dx, dy, dz]) = key.size {
        let _ = write!(out, " of {dx} m × {dy} m × {dz} m");
    }
    for layers in &key.layers {
        let _ = write!(out, "\n{}: {} layers", layers.unit, layers.layers);
    }
    let _ = writeln!(
        out,
        "\n{total} in the domain, {} outside of it or without thickness",
        key.cells_outside
    );
    for facies in &key.facies {
        let _ = writeln!(
            out,
            "{}: {} cells, {:.0} m³, {:.2} %",
            facies.facies,
            facies.cells,
            facies.volume_m3,
            100.0 * facies.fraction
        );
    }
    let _ = writeln!(out, "wrote to {}: {}", folder.display(), names.join(", "));
    out
}
