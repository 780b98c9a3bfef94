//! Files of triangles, of volumes and of surfaces alike.

use std::collections::BTreeSet;
use std::path::Path;

use glam::DVec3;

use super::args::finite;
use super::failure::Failure;
use crate::export::ExportError;
use crate::export::mesh::VolumeMesh;
use crate::export::part::{Part, Parts};
use crate::export::vertical::Vertical;
use crate::export::{glb, obj, ply, stl, tsurf};
use crate::mesh::Fineness;
use crate::model::Model;
use crate::model::labels;
use crate::model::plan::AssemblyPlan;
use crate::model::realisation::Realisation;

/// Largest distance of triangles from the surfaces, if none is asked for, as a fraction of the domain's diagonal.
const CHORD: f64 = 2e-4;
/// Largest angle between the surface's normals along a triangle's side (rad): 17 degrees.
const ANGLE: f64 = 0.3;

/// The least chord that may be asked for, as a fraction of the diagonal.
const LEAST: f64 = 1e-7;

/// Why triangles could not be made or written: what was asked for, or the surroundings.
pub(super) fn failed(error: &ExportError) -> Failure {
    match error {
        ExportError::Mesh(_) => Failure::Wrong(error.to_string()),
        _ => Failure::Surroundings(error.to_string()),
    }
}

/// How fine triangles are, and where they are.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct TriangleArgs {
    /// Largest distance of triangles from the exact surfaces (m); 0.0002 of the domain's diagonal if not given. Along a side of a
    /// triangle normals turn by 17 degrees at most.
    #[arg(long, value_name = "METRES", value_parser = above_zero, allow_negative_numbers = true)]
    chord: Option<f64>,
    /// How many times elevations are stretched in glb files, for looking at them.
    #[arg(long, value_name = "TIMES", value_parser = above_zero, allow_negative_numbers = true, default_value = "1")]
    exaggeration: f64,
    /// Leave ts files and grids in the model's own coordinates instead of adding the model's origin.
    #[arg(long)]
    local: bool,
}

/// Reads a number above 0.
pub(super) fn above_zero(text: &str) -> Result<f64, String> {
    match finite(text)? {
        value if value > 0.0 => Ok(value),
        value => Err(format!("{value} is not above 0")),
    }
}

impl TriangleArgs {
    /// How fine triangles of a model are.
    pub(super) fn fineness(&self, plan: &AssemblyPlan) -> Result<Fineness, Failure> {
        let diagonal = plan.low().distance(plan.high());
        let chord = self.chord.unwrap_or(CHORD * diagonal);
        if chord < LEAST * diagonal {
            return Err(Failure::Wrong(format!(
                "--chord {chord} is below a ten-millionth of the domain's diagonal ({diagonal:.1} m); exact surfaces are in STEP, \
                 for triangles take {:e} or more",
                LEAST * diagonal
            )));
        }
        Ok(Fineness {
            chord,
            angle: ANGLE,
        })
    }

    /// What is added to coordinates in files that are in the world.
    pub(super) fn origin(&self, model: &Model) -> DVec3 {
        if self.local {
            DVec3::ZERO
        } else {
            DVec3::from_array(model.origin)
        }
    }
}

/// A format of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Glb,
    Obj,
    Stl,
    Ply,
    Ts,
}

/// Named meshes as parts with the colours of their facies; a mesh without a name is its volume.
pub(super) fn parts(
    model: &Model,
    realisation: &Realisation,
    meshes: Vec<(Option<String>, VolumeMesh)>,
    fineness: &Fineness,
    origin: DVec3,
) -> Parts {
    let labels = labels::labels(model, &realisation.volumes);
    let part = |(name, mesh): (Option<String>, VolumeMesh)| {
        let rules = &realisation.volumes[mesh.volume];
        let facies = model
            .facies
            .iter()
            .find(|facies| facies.name == rules.facies);
        let label = labels[mesh.volume].as_ref().unwrap_or(&rules.name);
        let label = match &name {
            // The surface's own word stands behind its volume's name.
            Some(name) => name
                .strip_prefix(&rules.name)
                .map_or(name.clone(), |word| format!("{label}{word}")),
            None => label.clone(),
        };
        Part {
            name: plain(name.as_ref().unwrap_or(&rules.name)),
            label,
            material: plain(&rules.facies),
            color: facies.map_or([128; 3], |facies| {
                [facies.color.r, facies.color.g, facies.color.b]
            }),
            mesh,
        }
    };
    Parts {
        name: plain(&model.name),
        all: meshes.into_iter().map(part).collect(),
        chord: fineness.chord,
        angle: fineness.angle,
        origin,
    }
}

fn plain(name: &str) -> String {
    crate::export::ascii(name)
}

/// Names of files, each once: `stl/channel-3.stl`.
#[derive(Default)]
pub(super) struct Names(BTreeSet<String>);

impl Names {
    /// The name of a part's own file, in the folder of its format.
    pub(super) fn of(&mut self, part: &str, ending: &str) -> String {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.#+".contains(c);
        let plain: String = part
            .chars()
            .map(|c| if is_plain(c) { c } else { '_' })
            .collect();
        let mut name = format!("{ending}/{plain}.{ending}");
        let mut count = 1;
        while !self.0.insert(name.clone()) {
            count += 1;
            name = format!("{ending}/{plain}~{count}.{ending}");
        }
        name
    }
}

/// What a file holds.
pub(super) type Content = (String, Vec<u8>);

/// The files of a format, by their names in the folder of results.
pub(super) fn files(
    format: Format,
    stem: &str,
    parts: &Parts,
    args: &TriangleArgs,
    vertical: Vertical,
) -> Result<Vec<Content>, Failure> {
    let mut names = Names::default();
    let mut each = |ending: &str, make: &dyn Fn(&Part) -> Vec<u8>| {
        let files = parts
            .all
            .iter()
            .map(|part| (names.of(&part.name, ending), make(part)));
        files.collect()
    };
    Ok(match format {
        Format::Glb => {
            let bytes = glb::bytes(parts, args.exaggeration);
            let bytes = bytes.map_err(|error| Failure::Wrong(error.to_string()))?;
            vec![(format!("{stem}.glb"), bytes)]
        }
        Format::Obj => {
            let colors = format!("{stem}.mtl");
            vec![
                (
                    format!("{stem}.obj"),
                    obj::text(parts, &colors).into_bytes(),
                ),
                (colors, obj::colors(parts).into_bytes()),
            ]
        }
        Format::Stl => each("stl", &|part| stl::bytes(parts, part)),
        Format::Ply => each("ply", &|part| ply::bytes(parts, part)),
        Format::Ts => each("ts", &|part| {
            tsurf::text(parts, part, vertical).into_bytes()
        }),
    })
}

/// Writes files into a folder, with the folders below it that they name. Returns their names.
pub(super) fn write(folder: &Path, files: Vec<Content>) -> std::io::Result<Vec<String>> {
    let mut names = Vec::with_capacity(files.len());
    for (name, bytes) in files {
        let path = folder.join(&name);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)?;
        }
        std::fs::write(path, bytes)?;
        names.push(name);
    }
    Ok(names)
}
