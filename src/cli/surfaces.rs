//! `clinothem surfaces`: the surfaces of a model, as NURBS, triangles and grids.

use std::path::{Path, PathBuf};

use super::args::ModelArgs;
use super::engine::{self, EngineArgs};
use super::failure::Failure;
use super::files;
use super::load::{self, Loaded};
use super::outputs::Schema;
use super::progress::Progress;
use super::triangles::{self, Content, Names, TriangleArgs, above_zero};
use super::{interrupt, print};
use crate::assembly::Cancel;
use crate::export::heights::{self, Frame};
use crate::export::sheets::Sheets;
use crate::export::vertical::Vertical;
use crate::export::{cps3, file, irap, step, zmap};
use crate::mesh::Fineness;
use crate::model::Model;
use crate::model::plan::AssemblyPlan;
use crate::model::realisation::Realisation;

/// Write the surfaces of all bodies: as NURBS, as triangles, or as grids of heights.
///
/// STEP has them whole, as they are before anything is assembled. Triangles and grids are trimmed as in the assembled model,
/// to what parts two volumes; --whole leaves them as they are. STEP alone is one file; with other formats all go to a folder:
/// MODEL.step, MODEL.glb and MODEL.obj hold all surfaces; of stl, ply, ts, irap, zmap and cps3 each surface has a file, in a
/// folder of that name.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem surfaces channel-belt.toml -o belt-surfaces.step
  clinothem surfaces coastal.toml --formats ts,glb --exaggeration 5
  clinothem surfaces from-files.toml --formats irap,zmap,cps3 --spacing 25 --z depth
  clinothem surfaces coastal.toml --formats irap --only shoreface --whole -o grids")]
pub(super) struct Args {
    #[command(flatten)]
    model: ModelArgs,
    /// Where to write: a file for step alone, MODEL-surfaces.step if not given; else a folder, MODEL-surfaces if not given.
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Files to write: step; triangles as glb, obj, stl, ply, ts (for GOCAD); grids as irap (IRAP classic), zmap (ZMAP+), cps3 (CPS-3).
    #[arg(long, value_enum, value_delimiter = ',', default_value = "step")]
    formats: Vec<Format>,
    /// Triangles and grids of whole surfaces, not only of what parts two volumes.
    #[arg(long)]
    whole: bool,
    /// Triangles and grids of these surfaces alone: by their volume (shoreface) or by their own name (channel-3/base); repeatable.
    #[arg(long, value_name = "NAME", num_args = 1..)]
    only: Vec<String>,
    /// Largest distance between the nodes of grids (m); a hundredth of the domain's longer side if not given.
    #[arg(long, value_name = "METRES", value_parser = above_zero, allow_negative_numbers = true)]
    spacing: Option<f64>,
    /// What z is in ts files and grids.
    #[arg(long, value_enum, default_value_t)]
    z: Z,
    /// The application protocol that a STEP file declares.
    #[arg(long, value_enum, default_value_t)]
    step_schema: Schema,
    #[command(flatten)]
    triangles: TriangleArgs,
    #[command(flatten)]
    engine: EngineArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    Step,
    Glb,
    Obj,
    Stl,
    Ply,
    Ts,
    Irap,
    Zmap,
    Cps3,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Z {
    /// Up.
    #[default]
    Elevation,
    /// Down.
    Depth,
}

impl From<Z> for Vertical {
    fn from(z: Z) -> Self {
        match z {
            Z::Elevation => Self::Elevation,
            Z::Depth => Self::Depth,
        }
    }
}

impl Format {
    fn triangles(self) -> Option<triangles::Format> {
        match self {
            Self::Glb => Some(triangles::Format::Glb),
            Self::Obj => Some(triangles::Format::Obj),
            Self::Stl => Some(triangles::Format::Stl),
            Self::Ply => Some(triangles::Format::Ply),
            Self::Ts => Some(triangles::Format::Ts),
            Self::Step | Self::Irap | Self::Zmap | Self::Cps3 => None,
        }
    }
}

/// Nodes along the longer side of the domain, if no spacing is asked for.
const NODES: f64 = 100.0;

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = load::realise(&args.model, false)?;
    if loaded.realisation.instances.is_empty() {
        return Err(Failure::Wrong(
            "the model has no features left, so no surfaces".to_owned(),
        ));
    }
    // The handler removes the folder of unfinished files when the program is stopped.
    let cancel = interrupt::cancel()?;
    if args.formats.iter().all(|format| *format == Format::Step) {
        return alone(args, &loaded);
    }
    folder(args, loaded, &cancel)
}

/// STEP alone: one file.
fn alone(args: &Args, loaded: &Loaded) -> Result<(), Failure> {
    let path = args
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-surfaces.step", args.model.stem())));
    let staging = staging(files::folder_of(&path)?, &path)?;
    let unfinished = staging.path().join("surfaces.step");
    write_step(&unfinished, &loaded.model, &loaded.realisation, args)?;
    file::readable(&unfinished)
        .and_then(|()| std::fs::rename(&unfinished, &path))
        .map_err(|error| Failure::file("write", &path, &error))?;
    interrupt::unfinished_in(None);
    let count = loaded.realisation.instances.len();
    print::out(&format!(
        "wrote {}: the surfaces of {count} bodies",
        path.display()
    ))
}

fn staging(folder: &Path, path: &Path) -> Result<tempfile::TempDir, Failure> {
    let staging = tempfile::Builder::new()
        .prefix(".clinothem-")
        .tempdir_in(folder)
        .map_err(|error| Failure::file("write", path, &error))?;
    interrupt::unfinished_in(Some(staging.path()));
    Ok(staging)
}

fn write_step(
    path: &Path,
    model: &Model,
    realisation: &Realisation,
    args: &Args,
) -> Result<(), Failure> {
    step::write_surfaces(path, model, realisation, args.step_schema.into())
        .map_err(|error| Failure::Surroundings(error.to_string()))
}

/// Several formats: a folder.
fn folder(args: &Args, loaded: Loaded, cancel: &Cancel) -> Result<(), Failure> {
    let folder = args
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-surfaces", args.model.stem())));
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::Wrong(format!(
            "{} is a file; with these formats name a folder with -o",
            folder.display()
        )));
    }
    files::folder_of(&folder)?;
    let made = Made::new(args, loaded, cancel)?;
    let contents = made.contents(args)?;
    let is_new = !folder.exists();
    std::fs::create_dir_all(&folder).map_err(|error| Failure::file("write to", &folder, &error))?;
    let written = write(args, &made, contents, &folder);
    if written.is_err() && is_new {
        drop(std::fs::remove_dir(&folder));
    }
    interrupt::unfinished_in(None);
    let names = written?;
    print::out(&format!(
        "wrote {} files of {} surfaces to {}",
        names.len(),
        made.sheets.all().len(),
        folder.display()
    ))
}

fn write(
    args: &Args,
    made: &Made,
    contents: Vec<Content>,
    folder: &Path,
) -> Result<Vec<String>, Failure> {
    let staging = staging(folder, folder)?;
    let mut names = triangles::write(staging.path(), contents)
        .map_err(|error| Failure::file("write to", folder, &error))?;
    if args.formats.contains(&Format::Step) {
        let name = format!("{}.step", args.model.stem());
        write_step(
            &staging.path().join(&name),
            &made.model,
            &made.realisation,
            args,
        )?;
        names.push(name);
    }
    files::publish(staging.path(), folder, &names)?;
    Ok(names)
}

/// The surfaces that are asked for.
struct Made {
    model: Model,
    realisation: Realisation,
    plan: AssemblyPlan,
    sheets: Sheets,
    fineness: Fineness,
}

impl Made {
    fn new(args: &Args, loaded: Loaded, cancel: &Cancel) -> Result<Self, Failure> {
        let failed = |error: crate::export::ExportError| triangles::failed(&error);
        let mut made = if args.whole {
            let Loaded {
                model, realisation, ..
            } = loaded;
            let plan = AssemblyPlan::new(&realisation)
                .map_err(|error| Failure::Wrong(error.to_string()))?;
            let fineness = args.triangles.fineness(&plan)?;
            Self {
                sheets: Sheets::whole(&realisation, &fineness).map_err(failed)?,
                model,
                realisation,
                plan,
                fineness,
            }
        } else {
            let progress = Progress::new(args.engine.quiet);
            let built = engine::assemble(loaded, &args.engine, cancel, &progress)?;
            progress.stage("writing");
            let (realisation, plan) = (built.subject.realisation, built.subject.plan);
            let fineness = args.triangles.fineness(&plan)?;
            let sheets =
                Sheets::trimmed(&built.assembly, &plan, &realisation, &fineness).map_err(failed)?;
            progress.done();
            Self {
                sheets,
                model: built.model,
                realisation,
                plan,
                fineness,
            }
        };
        made.choose(&args.only)?;
        Ok(made)
    }

    /// Leaves what `--only` names.
    fn choose(&mut self, only: &[String]) -> Result<(), Failure> {
        let volumes = &self.realisation.volumes;
        let is = |sheet: &crate::export::sheets::Sheet, name: &String| {
            let rules = &volumes[sheet.volume];
            sheet.name == *name || rules.name == *name || rules.feature == *name
        };
        let missing = only
            .iter()
            .find(|name| !self.sheets.all().iter().any(|sheet| is(sheet, name)));
        if let Some(name) = missing {
            let names: Vec<&str> = self
                .sheets
                .all()
                .iter()
                .map(|sheet| sheet.name.as_str())
                .collect();
            return Err(Failure::Wrong(format!(
                "there is no surface `{name}`; there are {}",
                names.join(", ")
            )));
        }
        if !only.is_empty() {
            self.sheets
                .retain(|sheet| only.iter().any(|name| is(sheet, name)));
        }
        if self.sheets.all().is_empty() {
            return Err(Failure::Wrong(
                "no body of the model has a surface of its own in the domain".to_owned(),
            ));
        }
        Ok(())
    }

    /// All files but STEP.
    fn contents(&self, args: &Args) -> Result<Vec<Content>, Failure> {
        let stem = args.model.stem();
        let origin = args.triangles.origin(&self.model);
        let mut contents = Vec::new();
        let formats: Vec<_> = args
            .formats
            .iter()
            .filter_map(|format| format.triangles())
            .collect();
        if !formats.is_empty() {
            let meshes = self.sheets.all().iter();
            let meshes =
                meshes.map(|sheet| Ok((Some(sheet.name.clone()), self.sheets.mesh(sheet)?)));
            let meshes = meshes.collect::<Result<_, _>>();
            let meshes = meshes.map_err(|error: crate::export::ExportError| {
                Failure::Surroundings(error.to_string())
            })?;
            let parts = triangles::parts(
                &self.model,
                &self.realisation,
                meshes,
                &self.fineness,
                origin,
            );
            for format in formats {
                contents.extend(triangles::files(
                    format,
                    &stem,
                    &parts,
                    &args.triangles,
                    args.z.into(),
                )?);
            }
        }
        let (low, high) = (self.plan.low(), self.plan.high());
        let frame = Frame {
            low,
            high,
            spacing: args
                .spacing
                .unwrap_or((high - low).truncate().max_element() / NODES),
            origin,
            vertical: args.z.into(),
            chord: self.fineness.chord,
        };
        let mut names = Names::default();
        let is_grid =
            |format: &&Format| matches!(format, Format::Irap | Format::Zmap | Format::Cps3);
        let formats: Vec<&Format> = args.formats.iter().filter(is_grid).collect();
        if formats.is_empty() {
            return Ok(contents);
        }
        for sheet in self.sheets.all() {
            let grid = heights::grid(&self.sheets, sheet, &frame)
                .map_err(|error| Failure::Wrong(error.to_string()))?;
            for format in &formats {
                let (ending, text) = match format {
                    Format::Irap => ("irap", irap::text(&grid)),
                    Format::Zmap => (
                        "zmap",
                        zmap::text(&grid, &sheet.name, &self.model.name.replace('\n', " ")),
                    ),
                    _ => ("cps3", cps3::text(&grid, &sheet.name)),
                };
                contents.push((names.of(&sheet.name, ending), text.into_bytes()));
            }
        }
        Ok(contents)
    }
}
