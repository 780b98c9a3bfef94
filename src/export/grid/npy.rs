//! `NumPy` arrays (version 1.0 of the format): a file for each array, of shape (nx, ny, nz).
//!
//! `a[i, j, k]` is the cell i eastward, j northward, k upward, all from 0. The first index runs fastest (`fortran_order`), so the
//! cells follow each other as they were found. Cells outside of the domain are −1 in whole numbers and NaN elsewhere.
//!
//! The header is 40 bytes of text and the rest is memory: no crate is needed for it.

use std::io::{self, Write};

use super::arrays::{Arrays, NO_NUMBER};
use super::labels::OUTSIDE;
use super::sampled::Grid;

/// The bytes of a header are a multiple of this.
const ALIGNED: usize = 64;

/// One array.
pub(super) struct Array {
    pub(super) name: String,
    kind: &'static str,
    /// The bytes of each volume, and of cells outside.
    values: Vec<[u8; 4]>,
    outside: [u8; 4],
}

impl Array {
    /// Whether it holds whole numbers.
    pub(super) fn is_whole(&self) -> bool {
        self.kind == "<i4"
    }
}

/// The arrays of a grid.
pub(super) fn arrays(arrays: &Arrays) -> Vec<Array> {
    let whole = |name: &str, values: &[i32]| Array {
        name: name.to_owned(),
        kind: "<i4",
        values: values.iter().map(|value| value.to_le_bytes()).collect(),
        outside: NO_NUMBER.to_le_bytes(),
    };
    let mut all = vec![
        whole("volume", &arrays.volumes),
        whole("facies", &arrays.facies),
    ];
    all.extend(arrays.rock.iter().map(|rock| {
        Array {
            name: rock.name.clone(),
            kind: "<f4",
            values: rock
                .values
                .iter()
                .map(|value| value.to_le_bytes())
                .collect(),
            outside: f32::NAN.to_le_bytes(),
        }
    }));
    all
}

/// Writes one array.
pub(super) fn write(to: &mut dyn Write, grid: &Grid<'_>, array: &Array) -> io::Result<()> {
    let [nx, ny, nz] = grid.labels().counts();
    to.write_all(&header(array.kind, [nx, ny, nz])?)?;
    body(to, grid, array)
}

fn header(kind: &str, [nx, ny, nz]: [usize; 3]) -> io::Result<Vec<u8>> {
    let mut text =
        format!("{{'descr': '{kind}', 'fortran_order': True, 'shape': ({nx}, {ny}, {nz}), }}");
    // Ten bytes come before the text, and a line break ends it.
    let length = (10 + text.len() + 1).next_multiple_of(ALIGNED);
    text.extend(std::iter::repeat_n(' ', length - 10 - text.len() - 1));
    text.push('\n');
    let size = u16::try_from(text.len()).map_err(io::Error::other)?;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend_from_slice(&size.to_le_bytes());
    bytes.extend_from_slice(text.as_bytes());
    Ok(bytes)
}

/// The values of one array, cell by cell.
pub(super) fn body(to: &mut dyn Write, grid: &Grid<'_>, array: &Array) -> io::Result<()> {
    let mut bytes = Vec::new();
    grid.labels().upward(|labels| {
        bytes.clear();
        bytes.extend(labels.iter().flat_map(|label| match *label {
            OUTSIDE => array.outside,
            label => array.values[label as usize],
        }));
        to.write_all(&bytes)
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::header;

    #[test]
    fn a_header_says_its_own_length_and_fills_whole_blocks() {
        for counts in [[1, 2, 3], [100_000, 20, 3_000_000]] {
            let bytes = header("<f4", counts).unwrap();
            assert_eq!(bytes.len() % 64, 0);
            let size = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
            assert_eq!(bytes.len(), 10 + size);
            assert_eq!(bytes[..8], *b"\x93NUMPY\x01\x00");
            assert_eq!(bytes.last(), Some(&b'\n'));
        }
    }
}
