//! Which volume holds each cell: by its middle, or by most of several samples.
//!
//! All cores ask the point evaluator, row by row, and what they find goes to a file without a name as it is found: so there may be
//! more cells than fit in memory, and every format reads them as often as it has arrays. Cells follow each other eastward, then
//! northward, then upward.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use glam::DVec3;
use rayon::prelude::*;

use super::frame::Cells;
use crate::model::owner::Owners;

/// Stands for a cell that lies outside of the domain, or has no thickness.
pub const OUTSIDE: u32 = u32::MAX;

/// Cells that are asked for, or read, at once: some megabytes.
const BATCH: usize = 1 << 20;

/// The volume of every cell, by its number among the realisation's volumes.
#[derive(Debug)]
pub struct Labels {
    file: File,
    counts: [usize; 3],
    /// Cells of each volume.
    pub cells: Vec<u64>,
    /// Volume of these cells (m³).
    pub sizes: Vec<f64>,
    /// Cells outside of the domain, or without thickness.
    pub outside: u64,
}

/// What labels cells.
#[derive(Clone, Copy)]
pub(super) struct Sampler<'a> {
    pub(super) cells: &'a Cells,
    pub(super) owners: &'a Owners,
    /// The facies' number of each volume.
    pub(super) facies: &'a [i32],
    /// Samples along each side of a cell.
    pub(super) samples: usize,
}

impl Sampler<'_> {
    fn owner(&self, cell: [usize; 3], part: DVec3) -> u32 {
        let place = self.cells.at(cell, part);
        let owner = place.and_then(|place| self.owners.at(place));
        owner.map_or(OUTSIDE, |volume| u32::try_from(volume).unwrap_or(OUTSIDE))
    }

    /// The volume of a cell.
    fn label(&self, cell: [usize; 3], votes: &mut Vec<(u32, u32)>) -> u32 {
        if self.samples == 1 {
            return self.owner(cell, DVec3::splat(0.5));
        }
        votes.clear();
        let per_side = self.samples as f64;
        let at = |number: usize| (number as f64 + 0.5) / per_side;
        for z in 0..self.samples {
            for y in 0..self.samples {
                for x in 0..self.samples {
                    let part = DVec3::new(at(x), at(y), at(z));
                    let owner = self.owner(cell, part);
                    match votes.iter_mut().find(|(label, _)| *label == owner) {
                        Some((_, count)) => *count += 1,
                        None => votes.push((owner, 1)),
                    }
                }
            }
        }
        self.most(votes)
    }

    /// The volume that most samples of the commonest facies belong to; nothing if most lie outside. Of equals the youngest.
    fn most(&self, votes: &[(u32, u32)]) -> u32 {
        let outside: u32 = votes
            .iter()
            .filter(|(label, _)| *label == OUTSIDE)
            .map(|(_, count)| *count)
            .sum();
        let all: u32 = votes.iter().map(|(_, count)| *count).sum();
        if 2 * outside > all {
            return OUTSIDE;
        }
        let facies_of = |label: u32| self.facies[label as usize];
        let inside = || votes.iter().filter(|(label, _)| *label != OUTSIDE);
        let of_facies = |facies: i32| -> u32 {
            let own = inside().filter(|(label, _)| facies_of(*label) == facies);
            own.map(|(_, count)| *count).sum()
        };
        let best = inside().max_by_key(|(label, count)| {
            let facies = facies_of(*label);
            // Equal facies are told apart by their youngest volume, so that all volumes of one facies stand together.
            let youngest = inside().filter(|(one, _)| facies_of(*one) == facies);
            let youngest = youngest.map(|(one, _)| *one).max();
            (of_facies(facies), youngest, *count, *label)
        });
        best.map_or(OUTSIDE, |(label, _)| *label)
    }
}

impl Labels {
    /// Labels all cells; the file is made in `folder` and goes with the labels. `told` hears of the share that is done.
    pub(super) fn new(sampler: Sampler<'_>, folder: &Path, told: &dyn Fn(f64)) -> io::Result<Self> {
        let counts @ [nx, ny, nz] = sampler.cells.counts();
        let mut labels = Self {
            file: tempfile::tempfile_in(folder)?,
            counts,
            cells: vec![0; sampler.facies.len()],
            sizes: vec![0.0; sampler.facies.len()],
            outside: 0,
        };
        let rows = ny * nz;
        let at_once = rows_at_once(nx);
        let mut bytes = Vec::new();
        for first in (0..rows).step_by(at_once) {
            let last = (first + at_once).min(rows);
            let found: Vec<u32> = (first..last)
                .into_par_iter()
                .flat_map_iter(|row| {
                    let (j, k) = (row % ny, row / ny);
                    let mut votes = Vec::new();
                    (0..nx).map(move |i| sampler.label([i, j, k], &mut votes))
                })
                .collect();
            labels.count(sampler.cells, first, &found);
            bytes.clear();
            bytes.extend(found.iter().flat_map(|label| label.to_le_bytes()));
            labels.file.write_all(&bytes)?;
            told(last as f64 / rows as f64);
        }
        Ok(labels)
    }

    /// Adds rows to the sums, in the order of the cells: whatever the number of threads, the sums are the same.
    fn count(&mut self, cells: &Cells, first: usize, found: &[u32]) {
        let [nx, ny, _] = self.counts;
        for (number, labels) in found.chunks(nx).enumerate() {
            let (j, k) = ((first + number) % ny, (first + number) / ny);
            for (i, label) in labels.iter().enumerate() {
                if *label == OUTSIDE {
                    self.outside += 1;
                } else {
                    self.cells[*label as usize] += 1;
                    self.sizes[*label as usize] += cells.volume([i, j, k]);
                }
            }
        }
    }

    /// Cells along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// All cells from the base up, some rows at a time.
    pub fn upward(&self, mut to: impl FnMut(&[u32]) -> io::Result<()>) -> io::Result<()> {
        let [nx, ny, nz] = self.counts;
        let at_once = rows_at_once(nx);
        (0..ny * nz).step_by(at_once).try_for_each(|first| {
            let last = (first + at_once).min(ny * nz);
            to(&self.rows(first, last)?)
        })
    }

    /// All rows from the top down, and from north to south; each from west to east.
    pub fn downward(&self, mut to: impl FnMut(&[u32]) -> io::Result<()>) -> io::Result<()> {
        let [nx, ny, nz] = self.counts;
        let at_once = rows_at_once(nx);
        let mut last = ny * nz;
        while last > 0 {
            let first = last.saturating_sub(at_once);
            let found = self.rows(first, last)?;
            found.rchunks(nx).try_for_each(&mut to)?;
            last = first;
        }
        Ok(())
    }

    /// The cells of some rows.
    fn rows(&self, first: usize, last: usize) -> io::Result<Vec<u32>> {
        let nx = self.counts[0];
        let mut file = &self.file;
        file.seek(SeekFrom::Start(4 * (first * nx) as u64))?;
        let mut bytes = vec![0; 4 * (last - first) * nx];
        file.read_exact(&mut bytes)?;
        let (words, _) = bytes.as_chunks::<4>();
        Ok(words.iter().map(|word| u32::from_le_bytes(*word)).collect())
    }
}

fn rows_at_once(nx: usize) -> usize {
    (BATCH / nx).max(1)
}
