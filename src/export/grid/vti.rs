//! VTK `ImageData` (`.vti`): arrays over cells, in binary behind the text (`appended`, `raw`, little endian, sizes of 64 bits).
//!
//! The names of volumes and facies are field data, so the file explains itself: the number of a volume is its place among
//! `volume_names`, from 0; that of a facies its place among `facies_names`, whose first is for none. Cells outside of the domain
//! are −1 and NaN, and hidden (`vtkGhostType` 32).

use std::io::{self, Write};

use super::key::Key;
use super::labels::OUTSIDE;
use super::npy;
use super::sampled::Grid;

/// What VTK calls a cell that is not to be seen.
const HIDDEN: u8 = 32;

/// Writes a grid of boxes.
pub(super) fn write(to: &mut dyn Write, grid: &Grid<'_>) -> io::Result<()> {
    let [nx, ny, nz] = grid.labels().counts();
    let corner = grid.corner();
    let size = grid.size().unwrap_or_default();
    let arrays = npy::arrays(&grid.arrays);
    let cells = grid.source.cells.len();
    writeln!(
        to,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <ImageData WholeExtent=\"0 {nx} 0 {ny} 0 {nz}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">\n<FieldData>",
        corner.x, corner.y, corner.z, size.x, size.y, size.z
    )?;
    let key = Key::new(grid, &[], "");
    let volumes = key.volumes.iter().map(|volume| volume.volume.as_str());
    names(to, "volume_names", volumes)?;
    let facies = key.facies.iter().map(|facies| facies.facies.as_str());
    names(to, "facies_names", std::iter::once("").chain(facies))?;
    let model = &grid.source.model;
    let about = [model.name.as_str()];
    names(to, "model", about.into_iter())?;
    writeln!(
        to,
        "</FieldData>\n<Piece Extent=\"0 {nx} 0 {ny} 0 {nz}\">\n<PointData/>\n<CellData Scalars=\"facies\">"
    )?;
    let mut offset = 0;
    for array in &arrays {
        let kind = if array.is_whole() { "Int32" } else { "Float32" };
        writeln!(
            to,
            "<DataArray type=\"{kind}\" Name=\"{}\" format=\"appended\" offset=\"{offset}\"/>",
            escaped(&array.name)
        )?;
        offset += 8 + 4 * cells;
    }
    let is_partial = grid.labels().outside > 0;
    if is_partial {
        writeln!(
            to,
            "<DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"appended\" offset=\"{offset}\"/>"
        )?;
    }
    write!(
        to,
        "</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_"
    )?;
    for array in &arrays {
        to.write_all(&(4 * cells).to_le_bytes())?;
        npy::body(to, grid, array)?;
    }
    if is_partial {
        to.write_all(&cells.to_le_bytes())?;
        let ghost = |label: &u32| if *label == OUTSIDE { HIDDEN } else { 0 };
        grid.labels().upward(|labels| {
            let ghosts: Vec<u8> = labels.iter().map(ghost).collect();
            to.write_all(&ghosts)
        })?;
    }
    write!(to, "\n</AppendedData>\n</VTKFile>\n")
}

/// An array of texts: the bytes of each as numbers, ended by a 0.
fn names<'a>(
    to: &mut dyn Write,
    name: &str,
    texts: impl Iterator<Item = &'a str> + Clone,
) -> io::Result<()> {
    let count = texts.clone().count();
    writeln!(
        to,
        "<Array type=\"String\" Name=\"{name}\" NumberOfTuples=\"{count}\" format=\"ascii\">"
    )?;
    for text in texts {
        for byte in text.bytes() {
            write!(to, "{byte} ")?;
        }
        writeln!(to, "0")?;
    }
    writeln!(to, "</Array>")
}

/// A name as it may stand in an attribute.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}
