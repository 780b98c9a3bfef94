//! `clinothem view`: a picture of the model in three dimensions.

use std::path::PathBuf;

use glam::DVec3;

use super::args::{ModelArgs, finite, numbers};
use super::engine::{self, Built, EngineArgs};
use super::failure::Failure;
use super::load::{self, Loaded};
use super::progress::Progress;
use super::{interrupt, picture, tubes};
use crate::export::ExportError;
use crate::export::mesh::Triangulation;
use crate::export::picture::section::fitting_exaggeration;
use crate::export::picture::view::{Box3, Camera, Cut, Owner, Part, Projection, Scene};
use crate::export::picture::{PictureError, Rgb, Swatch, Volume, cap};
use crate::export::sheets::Sheets;
use crate::mesh::Fineness;
use crate::model::rules::BACKGROUND;

/// Draw the model in three dimensions as PNG: its solids, or a block coloured by the point evaluator.
///
/// Needs no display.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem view belt.toml                              bodies in the outline of the domain
  clinothem view belt.toml --below                      the same from below
  clinothem view belt.toml --style block --cut 500,500  a block diagram with a corner cut away")]
pub(super) struct Args {
    #[command(flatten)]
    model: ModelArgs,
    /// What to draw.
    #[arg(long, value_enum, default_value_t)]
    style: Style,
    /// Look from below.
    #[arg(long)]
    below: bool,
    /// Bearing from which to look, clockwise from north (180 = from the south).
    #[arg(long, value_name = "DEGREES", value_parser = finite, allow_negative_numbers = true)]
    azimuth_deg: Option<f64>,
    /// Height of the eye above the horizontal; negative looks from below.
    #[arg(long, value_name = "DEGREES", value_parser = finite, allow_negative_numbers = true, conflicts_with = "below")]
    elevation_deg: Option<f64>,
    /// How many times elevations are stretched. If not given, as often as fits a domain that is wide and low.
    #[arg(long, value_name = "TIMES", value_parser = finite, allow_negative_numbers = true)]
    exaggeration: Option<f64>,
    /// Cut away the corner nearest to the eye, to this easting and northing (m).
    #[arg(long, value_name = "X,Y", value_parser = numbers::<2>, allow_hyphen_values = true)]
    cut: Option<[f64; 2]>,
    /// Draw in perspective.
    #[arg(long)]
    perspective: bool,
    /// Where to write; MODEL-view.png if not given.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Width and height in pixels.
    #[arg(long, value_name = "WIDTH,HEIGHT", value_parser = pixels, allow_hyphen_values = true, default_value = "1600,1000")]
    size: [u32; 2],
    #[command(flatten)]
    engine: EngineArgs,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Style {
    /// The assembled solids of all bodies, the background left open.
    #[default]
    Solids,
    /// The surfaces between the volumes, as they are cut inside the domain.
    Sheets,
    /// A block whose faces are coloured by the point evaluator; no kernel is used.
    Block,
}

fn pixels(text: &str) -> Result<[u32; 2], String> {
    let wrong = || format!("`{text}` is not two whole numbers separated by a comma");
    let parts: Vec<u32> = text
        .split(',')
        .map(|part| part.trim().parse().map_err(|_| wrong()))
        .collect::<Result<_, _>>()?;
    parts.try_into().map_err(|_| wrong())
}

/// Largest distance of triangles from the surfaces, as a fraction of the domain's diagonal.
const CHORD: f64 = 2e-4;
/// Largest angle between the surface's normals along a triangle's side (rad).
const ANGLE: f64 = 0.3;
/// The eye's distance in perspective, in diagonals.
const DISTANCE: f64 = 3.0;

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let output = args
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-view.png", args.model.stem())));
    if picture::is_svg(&output)? {
        return Err(Failure::Wrong(
            "a view is a PNG; name the file .png".to_owned(),
        ));
    }
    let loaded = load::realise(&args.model, false)?;
    let (parts, loaded) = match args.style {
        Style::Block => (Vec::new(), loaded),
        Style::Solids | Style::Sheets => assembled(args, loaded)?,
    };
    let bytes = drawn(args, &loaded, parts, |scene, shown| {
        scene.png(args.size[0], args.size[1], Some(shown))
    })?;
    picture::write(&output, &bytes)
}

/// The solids that were built, as parts.
pub(super) fn solids(built: &Built) -> Result<Vec<Part>, Failure> {
    parts(Style::Solids, built)
}

/// What `clinothem view` shows of these solids if nothing else is said, without words.
pub(super) fn tile(
    model: ModelArgs,
    loaded: &Loaded,
    solids: Vec<Part>,
    size: [u32; 2],
) -> Result<Vec<u8>, Failure> {
    let args = Args {
        model,
        style: Style::Solids,
        below: false,
        azimuth_deg: None,
        elevation_deg: None,
        exaggeration: None,
        cut: None,
        perspective: false,
        output: None,
        size,
        engine: EngineArgs::default(),
    };
    drawn(&args, loaded, solids, |scene, shown| {
        scene.tile(size[0], size[1], Some(shown))
    })
}

/// A view of these parts, which `draw` makes a picture of.
fn drawn(
    args: &Args,
    loaded: &Loaded,
    parts: Vec<Part>,
    draw: impl Fn(&Scene, Owner<'_>) -> Result<Vec<u8>, PictureError>,
) -> Result<Vec<u8>, Failure> {
    let owners = loaded.owners()?;
    let (mut volumes, mut legend) = picture::key(loaded);
    let (low, high) = (owners.extent().low(), owners.extent().high());
    let exaggeration = args.exaggeration.unwrap_or_else(|| {
        let size = high - low;
        fitting_exaggeration(size.truncate().length(), size.z)
    });
    let camera = camera(args, exaggeration);
    let shown = |point: DVec3| {
        let owner = owners.at(point)?;
        // Among solids the background stays open, so that they can be seen.
        let open = match args.style {
            Style::Block => false,
            Style::Solids => owner == BACKGROUND,
            Style::Sheets => true,
        };
        if open {
            None
        } else {
            u32::try_from(owner).ok()
        }
    };
    let mut parts = match args.style {
        Style::Block => cap::caps(owners.extent(), &shown),
        Style::Solids | Style::Sheets => parts,
    };
    let domain = Box3 { low, high };
    if !loaded.model.wells.is_empty() {
        parts.extend(tubes::tubes(
            &loaded.model,
            domain,
            exaggeration,
            volumes.len(),
        ));
        volumes.push(Volume {
            name: "wells".to_owned(),
            swatch: legend.len(),
        });
        legend.push(Swatch {
            name: "wells".to_owned(),
            color: Rgb(20, 20, 20),
        });
    }
    let cut = args.cut.map(|at| corner(at, &camera, low, high));
    let scene = Scene {
        title: loaded.model.name.clone(),
        subtitle: format!("seed {}", loaded.model.seed),
        domain,
        parts,
        volumes,
        legend,
        camera,
        cut,
    };
    draw(&scene, &shown).map_err(|error| picture::refused(&error))
}

fn camera(args: &Args, exaggeration: f64) -> Camera {
    let mut camera = if args.below {
        Camera::from_below(exaggeration)
    } else {
        Camera::from_above(exaggeration)
    };
    camera.azimuth_deg = args.azimuth_deg.unwrap_or(camera.azimuth_deg);
    camera.elevation_deg = args.elevation_deg.unwrap_or(camera.elevation_deg);
    if args.perspective {
        camera.projection = Projection::Perspective { distance: DISTANCE };
    }
    camera
}

/// The corner of the domain that faces the eye, as far as a point.
fn corner(at: [f64; 2], camera: &Camera, low: DVec3, high: DVec3) -> Cut {
    let azimuth = camera.azimuth_deg.to_radians();
    let side = |towards: f64, low: f64, high: f64, at: f64| {
        if towards > 0.0 { [at, high] } else { [low, at] }
    };
    let x = side(azimuth.sin(), low.x, high.x, at[0]);
    let y = side(azimuth.cos(), low.y, high.y, at[1]);
    Cut::Corner {
        low: DVec3::new(x[0], y[0], low.z),
        high: DVec3::new(x[1], y[1], high.z),
    }
}

/// The solids of all bodies, or their sheets, as parts.
fn assembled(args: &Args, loaded: Loaded) -> Result<(Vec<Part>, Loaded), Failure> {
    let cancel = interrupt::cancel()?;
    let progress = Progress::new(args.engine.quiet);
    let built = engine::assemble(loaded, &args.engine, &cancel, &progress)?;
    progress.stage("drawing");
    let parts = parts(args.style, &built)?;
    progress.done();
    Ok((parts, built.into_loaded()))
}

fn parts(style: Style, built: &Built) -> Result<Vec<Part>, Failure> {
    let fineness = Fineness {
        chord: CHORD * built.subject.plan.low().distance(built.subject.plan.high()),
        angle: ANGLE,
    };
    let meshes = match style {
        Style::Sheets => {
            let (plan, realisation) = (&built.subject.plan, &built.subject.realisation);
            let sheets = Sheets::trimmed(&built.assembly, plan, realisation, &fineness);
            sheets.and_then(|sheets| {
                sheets
                    .all()
                    .iter()
                    .map(|sheet| sheets.mesh(sheet))
                    .collect()
            })
        }
        Style::Solids | Style::Block => Triangulation::new(&built.assembly, &fineness)
            .and_then(|triangles| triangles.volumes(&built.assembly)),
    };
    let meshes = meshes.map_err(|error: ExportError| Failure::Surroundings(error.to_string()))?;
    Ok(meshes
        .into_iter()
        .filter(|mesh| mesh.volume != BACKGROUND)
        .map(|mesh| Part {
            volume: mesh.volume,
            positions: mesh
                .corners
                .iter()
                .map(|corner| mesh.positions[corner.point as usize])
                .collect(),
            normals: Some(mesh.corners.iter().map(|corner| corner.normal).collect()),
            triangles: mesh.triangles,
            opacity: 1.0,
        })
        .collect())
}
