//! Grids: which volume holds each cell, and its rock, for programs that know grids alone.
//!
//! The point evaluator fills them, so they need no kernel. A grid is a picture of the model, no part of it: cells have one owner
//! each, by their middle or by most of several samples.
//!
//! ```text
//! plan, frame, layers       where cells are: boxes, or layers between the horizons
//! labels                    which volume holds each of them
//! arrays                    the numbers that volumes stand for
//! sampled                   all of these together
//! vti, npy, gslib, grdecl   a format each
//! key                       what the numbers mean
//! ```

pub mod arrays;
pub mod format;
pub mod frame;
mod grdecl;
mod gslib;
pub mod key;
pub mod labels;
pub mod layers;
mod npy;
pub mod plan;
mod repeats;
pub mod sampled;
mod vti;

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use arrays::Arrays;
use format::Format;
use frame::Cells;
use sampled::Grid;

/// Why a grid could not be made or written.
#[derive(Debug, thiserror::Error)]
pub enum GridError {
    /// The format has boxes of one size alone.
    #[error(
        "{} holds boxes of one size, and no layers between horizons; ask for grdecl or npy, or leave out --layers",
        .0.name()
    )]
    Layers(Format),
    /// The system could not write a file.
    #[error("cannot write {path}: {source}")]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// Writes a format's files into a folder, and gives their names.
pub fn write(
    grid: &Grid<'_>,
    format: Format,
    folder: &Path,
    stem: &str,
) -> Result<Vec<String>, GridError> {
    if matches!(grid.source.cells, Cells::Layers(_)) && !format.holds_layers() {
        return Err(GridError::Layers(format));
    }
    let mut names = Vec::new();
    let mut file = |name: String, write: &dyn Fn(&mut dyn Write) -> io::Result<()>| {
        let path = folder.join(&name);
        let written = File::create_new(&path).and_then(|file| {
            let mut file = BufWriter::with_capacity(1 << 20, file);
            write(&mut file)?;
            file.flush()
        });
        names.push(name);
        written.map_err(|source| GridError::File { path, source })
    };
    match format {
        Format::Vti => file(format!("{stem}.vti"), &|to| vti::write(to, grid))?,
        Format::Gslib => file(format!("{stem}.gslib"), &|to| {
            gslib::write(to, grid, gslib::Flavour::Gslib)
        })?,
        Format::Sgems => file(format!("{stem}.sgems"), &|to| {
            gslib::write(to, grid, gslib::Flavour::Sgems)
        })?,
        Format::Grdecl => file(format!("{stem}.grdecl"), &|to| grdecl::write(to, grid))?,
        Format::Npy => {
            for array in npy::arrays(&grid.arrays) {
                let name = format!("{stem}.{}.npy", in_file_name(&array.name));
                file(name, &|to| npy::write(to, grid, &array))?;
            }
        }
    }
    Ok(names)
}

/// A property's name as a part of a file's.
fn in_file_name(name: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    name.chars()
        .map(|c| if is_plain(c) { c } else { '_' })
        .collect()
}

/// Bytes that the files of a grid take at most, with what is kept while they are made.
pub fn bytes(cells: &Cells, arrays: &Arrays, formats: &[Format]) -> f64 {
    let count = cells.len() as f64;
    let rock = arrays.rock.len() as f64;
    // The numbers that are kept while files are made.
    let kept = 4.0;
    let of = |format: &Format| match format {
        Format::Vti => 9.0 + 4.0 * rock,
        Format::Npy => 8.0 + 4.0 * rock,
        Format::Gslib | Format::Sgems => gslib::bytes_per_cell(arrays),
        Format::Grdecl => grdecl::bytes_per_cell(cells, arrays),
    };
    count * (kept + formats.iter().map(of).sum::<f64>())
}
