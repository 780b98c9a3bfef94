//! GSLIB (Geo-EAS) and `SGeMS` text: a line for each cell, x running fastest, then y, then z from the base upward.
//!
//! Neither format has coordinates, so the title of a GSLIB file says where the cells are: their number, the middle of the first
//! one, and their size. What is not known, and cells outside of the domain, are −999, in `SGeMS` −9966699.

use std::io::{self, Write};

use super::arrays::Arrays;
use super::labels::OUTSIDE;
use super::sampled::Grid;
use crate::export::text::ascii;

/// The two flavours of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flavour {
    /// GSLIB's.
    Gslib,
    /// `SGeMS`'s.
    Sgems,
}

impl Flavour {
    /// What stands for no value.
    pub(super) fn null(self) -> &'static str {
        match self {
            Self::Gslib => "-999",
            Self::Sgems => "-9966699",
        }
    }
}

/// Writes a grid of boxes.
pub(super) fn write(to: &mut dyn Write, grid: &Grid<'_>, flavour: Flavour) -> io::Result<()> {
    let [nx, ny, nz] = grid.labels().counts();
    let name = ascii(&grid.source.model.name);
    match flavour {
        Flavour::Gslib => {
            let size = grid.size().unwrap_or_default();
            let first = grid.corner() + 0.5 * size;
            writeln!(
                to,
                "{name}: nx={nx} ny={ny} nz={nz} middle of the first cell={} {} {} size={} {} {} m; \
                 x fastest, then y, then z upward; null {}",
                first.x,
                first.y,
                first.z,
                size.x,
                size.y,
                size.z,
                flavour.null()
            )?;
        }
        Flavour::Sgems => writeln!(to, "{} ({nx}x{ny}x{nz})", name.replace(['(', ')'], "_"))?,
    }
    let arrays = &grid.arrays;
    writeln!(to, "{}", 2 + arrays.rock.len())?;
    writeln!(to, "volume\nfacies")?;
    for rock in &arrays.rock {
        writeln!(to, "{}", ascii(&rock.name))?;
    }
    let rows: Vec<String> = (0..arrays.volumes.len())
        .map(|volume| row(arrays, volume, flavour))
        .collect();
    let outside = format!(
        "{}\n",
        vec![flavour.null(); 2 + arrays.rock.len()].join(" ")
    );
    grid.labels().upward(|labels| {
        labels.iter().try_for_each(|label| match *label {
            OUTSIDE => to.write_all(outside.as_bytes()),
            label => to.write_all(rows[label as usize].as_bytes()),
        })
    })
}

/// The line of a volume's cells.
fn row(arrays: &Arrays, volume: usize, flavour: Flavour) -> String {
    let mut row = format!("{} {}", arrays.volumes[volume], arrays.facies[volume]);
    for rock in &arrays.rock {
        row.push(' ');
        let value = rock.values[volume];
        if value.is_nan() {
            row.push_str(flavour.null());
        } else {
            row.push_str(&number(value));
        }
    }
    row.push('\n');
    row
}

/// The fewest digits that give the same number back.
pub(super) fn number(value: f32) -> String {
    format!("{value:?}")
}

/// Bytes of the longest line.
pub(super) fn bytes_per_cell(arrays: &Arrays) -> f64 {
    let volumes = 0..arrays.volumes.len();
    let longest = volumes
        .map(|volume| row(arrays, volume, Flavour::Sgems).len())
        .max();
    longest.unwrap_or(0) as f64
}
