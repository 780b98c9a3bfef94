//! `clinothem section`: a vertical section, a fence or a map.

use std::path::PathBuf;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::args::{ModelArgs, finite, numbers};
use super::failure::Failure;
use super::load::{self, Loaded};
use super::{picture, traces};
use crate::export::picture::section::{
    Extent, Kind, LabelRaster, SectionFigure, fitting_exaggeration,
};
use crate::model::owner::Owners;

/// Draw a vertical section, a fence or a map, coloured by facies, as PNG or SVG.
///
/// Needs no kernel: the point evaluator colours every pixel. Without a line, the section runs through
/// the middle of the domain from west to east.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem section belt.toml
  clinothem section belt.toml --from 0,0 --to 1000,1000 -o diagonal.svg
  clinothem section belt.toml --fence 0,200 --fence 500,800 --fence 1000,500
  clinothem section belt.toml --map -20")]
pub(super) struct Args {
    #[command(flatten)]
    model: ModelArgs,
    /// Start of a straight section: easting,northing (m).
    #[arg(long, value_name = "X,Y", value_parser = numbers::<2>, requires = "to", allow_hyphen_values = true)]
    from: Option<[f64; 2]>,
    /// End of a straight section (m).
    #[arg(long, value_name = "X,Y", value_parser = numbers::<2>, requires = "from", allow_hyphen_values = true)]
    to: Option<[f64; 2]>,
    /// A point of a fence (m); give at least two.
    #[arg(long, value_name = "X,Y", value_parser = numbers::<2>, conflicts_with_all = ["from", "map"], allow_hyphen_values = true)]
    fence: Vec<[f64; 2]>,
    /// A map at this elevation (m).
    #[arg(long, value_name = "Z", value_parser = finite, conflicts_with = "from", allow_negative_numbers = true)]
    map: Option<f64>,
    /// Show the model's wells within this distance of the section, or of the map's elevation (m), projected onto it.
    #[arg(long, value_name = "METRES", value_parser = finite, allow_negative_numbers = true)]
    wells: Option<f64>,
    /// How many times elevations are stretched; chosen to fit if not given.
    #[arg(long, value_name = "TIMES", value_parser = finite, allow_negative_numbers = true)]
    exaggeration: Option<f64>,
    /// Where to write; the name's ending, .png or .svg, decides the format.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Width of a PNG in pixels.
    #[arg(
        long,
        value_name = "PIXELS",
        default_value_t = 1600,
        allow_negative_numbers = true
    )]
    width: u32,
}

/// How finely a section is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    /// Cells across the raster.
    pub(super) columns: usize,
    /// Rows of a section's raster.
    pub(super) rows: usize,
}

const CELLS: Cells = Cells {
    columns: 2000,
    rows: 700,
};

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let output = args.output.clone().unwrap_or_else(|| {
        let what = if args.map.is_some() { "map" } else { "section" };
        PathBuf::from(format!("{}-{what}.png", args.model.stem()))
    });
    let svg = picture::is_svg(&output)?;
    let loaded = load::realise(&args.model, false)?;
    let owners = loaded.owners()?;
    let figure = match args.map {
        Some(elevation) => map(args, &loaded, &owners, elevation, CELLS)?,
        None => section(args, &loaded, &owners, CELLS)?,
    };
    let bytes = if svg {
        figure.svg().map(String::into_bytes)
    } else {
        figure.png(args.width)
    };
    picture::write(&output, &bytes.map_err(|error| picture::refused(&error))?)
}

#[cfg(feature = "occt")]
impl Args {
    /// What is drawn of a model if nothing else is said; a map at this elevation.
    pub(super) fn usual(model: ModelArgs, map: Option<f64>) -> Self {
        Self {
            model,
            from: None,
            to: None,
            fence: Vec::new(),
            map,
            wells: None,
            exaggeration: None,
            output: None,
            width: 0,
        }
    }
}

pub(super) fn section(
    args: &Args,
    loaded: &Loaded,
    owners: &Owners,
    cells: Cells,
) -> Result<SectionFigure, Failure> {
    let domain = &loaded.model.domain;
    let line: Vec<DVec2> = match (args.from, args.to, &args.fence[..]) {
        (Some(from), Some(to), _) => vec![DVec2::from_array(from), DVec2::from_array(to)],
        (_, _, []) => {
            let middle = f64::midpoint(domain.y[0], domain.y[1]);
            vec![
                DVec2::new(domain.x[0], middle),
                DVec2::new(domain.x[1], middle),
            ]
        }
        (_, _, [_]) => {
            return Err(Failure::Wrong(
                "a fence needs at least two points".to_owned(),
            ));
        }
        (_, _, points) => points
            .iter()
            .map(|point| DVec2::from_array(*point))
            .collect(),
    };
    let length: f64 = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    if line.windows(2).any(|pair| pair[0] == pair[1]) {
        return Err(Failure::Wrong(
            "two neighbouring points of the line are the same".to_owned(),
        ));
    }
    let height = domain.z[1] - domain.z[0];
    let extent = Extent {
        horizontal: [0.0, length],
        vertical: domain.z,
    };
    let raster = raster(cells.columns, cells.rows, extent, |distance, elevation| {
        owners.at(along(&line, distance).extend(elevation))
    });
    if shows_nothing(&raster) {
        let points: Vec<String> = line.iter().map(|p| format!("({}, {})", p.x, p.y)).collect();
        return Err(Failure::Wrong(format!(
            "the section from {} meets nothing of the model, whose domain is x {:?}, y {:?}; choose a line through it",
            points.join(" to "),
            domain.x,
            domain.y
        )));
    }
    let (volumes, legend) = picture::key(loaded);
    let wells = args.wells.map_or_else(Vec::new, |within| {
        traces::on_section(&loaded.model, &line, extent, within)
    });
    Ok(SectionFigure {
        wells,
        title: loaded.model.name.clone(),
        subtitle: format!("seed {}{}", loaded.model.seed, said(args)),
        kind: Kind::Section {
            line,
            ends: ["A".to_owned(), "A′".to_owned()],
            vertical_exaggeration: args
                .exaggeration
                .unwrap_or_else(|| fitting_exaggeration(length, height)),
        },
        extent,
        raster,
        volumes,
        legend,
    })
}

pub(super) fn map(
    args: &Args,
    loaded: &Loaded,
    owners: &Owners,
    elevation: f64,
    cells: Cells,
) -> Result<SectionFigure, Failure> {
    let domain = &loaded.model.domain;
    if !(domain.z[0]..=domain.z[1]).contains(&elevation) {
        return Err(Failure::Wrong(format!(
            "the map's elevation {elevation} m is outside the domain's {} to {} m",
            domain.z[0], domain.z[1]
        )));
    }
    let extent = Extent {
        horizontal: domain.x,
        vertical: domain.y,
    };
    let aspect = (domain.y[1] - domain.y[0]) / (domain.x[1] - domain.x[0]);
    // Between a tenth and ten times as many rows as columns: beyond that a map is a line.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped"
    )]
    let rows = (cells.columns as f64 / 2.0 * aspect.clamp(0.1, 10.0)) as usize;
    let raster = raster(cells.columns / 2, rows, extent, |x, y| {
        owners.at(DVec3::new(x, y, elevation))
    });
    if shows_nothing(&raster) {
        return Err(Failure::Wrong(format!(
            "the map at {elevation} m meets nothing of the model: it lies above the domain's top or below its base"
        )));
    }
    let (volumes, legend) = picture::key(loaded);
    let wells = args.wells.map_or_else(Vec::new, |within| {
        traces::on_map(&loaded.model, elevation, extent, within)
    });
    Ok(SectionFigure {
        wells,
        title: loaded.model.name.clone(),
        subtitle: format!(
            "map at {elevation} m, seed {}{}",
            loaded.model.seed,
            said(args)
        ),
        kind: Kind::Map { traces: Vec::new() },
        extent,
        raster,
        volumes,
        legend,
    })
}

/// Which wells are shown, in words.
fn said(args: &Args) -> String {
    args.wells
        .map_or_else(String::new, |within| format!(", wells within {within} m"))
}

/// Owners at the middles of the cells of a raster whose rows run down from the top.
fn raster(
    width: usize,
    height: usize,
    extent: Extent,
    owner: impl Fn(f64, f64) -> Option<usize> + Sync,
) -> LabelRaster {
    let at = |[low, high]: [f64; 2], part: f64| low + (high - low) * part;
    let cells = (0..height).into_par_iter().flat_map_iter(|row| {
        let vertical = at(extent.vertical, 1.0 - (row as f64 + 0.5) / height as f64);
        let owner = &owner;
        (0..width).map(move |column| {
            let horizontal = at(extent.horizontal, (column as f64 + 0.5) / width as f64);
            owner(horizontal, vertical)
                .and_then(|volume| u32::try_from(volume).ok())
                .unwrap_or(LabelRaster::NONE)
        })
    });
    LabelRaster {
        width,
        height,
        cells: cells.collect(),
    }
}

/// Whether all of it lies outside of the domain.
fn shows_nothing(raster: &LabelRaster) -> bool {
    raster.cells.iter().all(|cell| *cell == LabelRaster::NONE)
}

/// The point at a distance along a line.
fn along(line: &[DVec2], distance: f64) -> DVec2 {
    let mut left = distance;
    for pair in line.windows(2) {
        let length = pair[0].distance(pair[1]);
        if left <= length {
            return pair[0].lerp(pair[1], left / length);
        }
        left -= length;
    }
    line[line.len() - 1]
}
