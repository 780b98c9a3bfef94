//! Numbers of solids and faces, and what they are: for files that have no names for them.
//!
//! BREP has no names at all, and of the shared STEP most readers keep none. But both keep an order: solids follow each other as they
//! do in the report, and faces as they are met first on the way through these. Readers number them so, from 1.

use super::ExportError;
use super::report::{Report, VolumeEntry};
use super::table::{Cell, Sheet};
use crate::assembly::Assembly;
use crate::assembly::kernel::{self, BoundaryShape};

/// The tables of the solids and of the faces of a shape whose solids share their faces.
pub fn sheets(report: &Report, assembly: &Assembly) -> Result<[Sheet; 2], ExportError> {
    let boundary = assembly
        .ordered_solids()
        .and_then(|solids| kernel::boundary(&solids))
        .map_err(|error| ExportError::Kernel {
            what: "the table of faces",
            message: error.to_string(),
        })?;
    let solids: Vec<(&VolumeEntry, usize)> = report
        .volumes
        .iter()
        .flat_map(|volume| (0..volume.solids.len()).map(move |at| (volume, at)))
        .collect();
    if solids.len() != boundary.shapes.len() {
        return Err(ExportError::Table(format!(
            "the report has {} solids and the shape {}",
            solids.len(),
            boundary.shapes.len()
        )));
    }
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); boundary.faces.len()];
    for (solid, shape) in boundary.shapes.iter().enumerate() {
        let BoundaryShape::Solid(shells) = shape else {
            continue;
        };
        for (face, _) in shells.iter().flatten() {
            if !beside[*face].contains(&solid) {
                beside[*face].push(solid);
            }
        }
    }
    Ok([of_solids(&solids), of_faces(&solids, &beside)])
}

fn columns(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// What a solid is called, and its rock.
fn named((volume, at): (&VolumeEntry, usize)) -> [Cell; 5] {
    let text = |text: &str| Cell::Text(text.to_owned());
    [
        text(&volume.solids[at].name),
        text(&volume.name),
        Cell::words(volume.display_name.as_deref()),
        text(&volume.facies),
        text(&volume.color),
    ]
}

fn of_solids(solids: &[(&VolumeEntry, usize)]) -> Sheet {
    let row = |(number, solid): (usize, &(&VolumeEntry, usize))| {
        let mut row = vec![Cell::count(number + 1)];
        row.extend(named(*solid));
        row.push(Cell::volume(Some(solid.0.solids[solid.1].volume_m3)));
        row
    };
    Sheet {
        name: "solids",
        columns: columns(&[
            "number",
            "solid",
            "volume",
            "display_name",
            "facies",
            "color",
            "volume_m3",
        ]),
        rows: solids.iter().enumerate().map(row).collect(),
    }
}

fn of_faces(solids: &[(&VolumeEntry, usize)], beside: &[Vec<usize>]) -> Sheet {
    let row = |(number, beside): (usize, &Vec<usize>)| {
        let mut row = vec![Cell::count(number + 1)];
        for side in 0..2 {
            match beside.get(side) {
                Some(solid) => {
                    let [name, volume, _, facies, color] = named(solids[*solid]);
                    row.extend([Cell::count(solid + 1), name, volume, facies, color]);
                }
                // The domain's own boundary.
                None => row.extend(std::iter::repeat_n(Cell::Empty, 5)),
            }
        }
        row
    };
    let mut names = columns(&["number"]);
    for side in ["", "other_"] {
        for name in ["solid_number", "solid", "volume", "facies", "color"] {
            names.push(format!("{side}{name}"));
        }
    }
    Sheet {
        name: "faces",
        columns: names,
        rows: beside.iter().enumerate().map(row).collect(),
    }
}
