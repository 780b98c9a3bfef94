//! Cells with their volumes: what all formats are written from.

use std::io;
use std::path::Path;

use glam::DVec3;

use super::arrays::Arrays;
use super::frame::Cells;
use super::labels::{Labels, Sampler};
use crate::model::Model;
use crate::model::owner::Owners;
use crate::model::realisation::Realisation;

/// What a grid is made of.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its realisation.
    pub realisation: &'a Realisation,
    /// The point evaluator.
    pub owners: &'a Owners,
    /// The cells.
    pub cells: &'a Cells,
    /// Samples along each side of a cell.
    pub samples: usize,
    /// What is added to coordinates (m): the model's origin, for world coordinates.
    pub shift: DVec3,
}

/// Cells with their volumes.
pub struct Grid<'a> {
    pub(super) source: Source<'a>,
    pub(super) arrays: Arrays,
    pub(super) labels: Labels,
}

impl<'a> Grid<'a> {
    /// Asks which volume holds each cell. What is found is kept in a file without a name in `folder`; `told` hears of the share
    /// that is done.
    pub fn new(source: Source<'a>, folder: &Path, told: &dyn Fn(f64)) -> io::Result<Self> {
        let arrays = Arrays::new(source.model, source.realisation);
        let sampler = Sampler {
            cells: source.cells,
            owners: source.owners,
            facies: &arrays.facies,
            samples: source.samples,
        };
        let labels = Labels::new(sampler, folder, told)?;
        Ok(Self {
            source,
            arrays,
            labels,
        })
    }

    /// Which volume holds each cell.
    pub fn labels(&self) -> &Labels {
        &self.labels
    }

    /// The numbers that volumes stand for.
    pub fn arrays(&self) -> &Arrays {
        &self.arrays
    }

    /// The lower south-western corner of the cells, as files have it (m).
    pub(super) fn corner(&self) -> DVec3 {
        let plan = self.source.cells.plan();
        let base = match self.source.cells {
            Cells::Boxes { base, .. } => *base,
            Cells::Layers(_) => self.source.realisation.extent.low().z,
        };
        plan.low.extend(base) + self.source.shift
    }

    /// A cell's extents, if all are boxes of one size (m).
    pub(super) fn size(&self) -> Option<DVec3> {
        match self.source.cells {
            Cells::Boxes { plan, height, .. } => Some(plan.cell.extend(*height)),
            Cells::Layers(_) => None,
        }
    }
}
