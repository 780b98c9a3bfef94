//! Figures: what a section or a map shows, and whether it can be drawn.

use glam::DVec2;

use super::{
    PictureError, Swatch, Volume,
    check::{check_swatches, finite, range, within},
};

/// Most cells of a raster: 4096 by 4096.
pub const MOST_CELLS: usize = 1 << 24;

/// Who owns each cell, row by row **from the top** (a section's highest elevation, a map's north), each row from the
/// left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LabelRaster {
    /// Cells in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// An index into [`SectionFigure::volumes`], or [`LabelRaster::NONE`].
    pub cells: Vec<u32>,
}

impl LabelRaster {
    /// The cell is nobody's (beyond the model): left white.
    pub const NONE: u32 = u32::MAX;
}

/// The trace of a section, drawn on a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Names of its two ends: A and A′.
    pub ends: [String; 2],
    /// Its points, easting and northing.
    pub line: Vec<DVec2>,
}

/// What the raster shows.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// A vertical section along a straight line (two points) or a fence along several. `horizontal` of the extent is
    /// then the distance along the line, from 0 at its first point.
    Section {
        /// Points of the line, easting and northing.
        line: Vec<DVec2>,
        /// Names of the two ends, such as A and A′; compass letters are added to them.
        ends: [String; 2],
        /// How many times elevations are stretched against distances.
        vertical_exaggeration: f64,
    },
    /// A plan view at one elevation, or of a surface.
    Map {
        /// Sections to be marked on it.
        traces: Vec<Trace>,
    },
}

/// Which part of the world the raster covers, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Left and right edge: distance along the section, or easting.
    pub horizontal: [f64; 2],
    /// Lower and upper edge: elevation, or northing.
    pub vertical: [f64; 2],
}

/// A figure to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionFigure {
    /// The first line, bold.
    pub title: String,
    /// A line below it; empty for none. Exaggeration and course of a section are added by the figure.
    pub subtitle: String,
    /// A section or a map.
    pub kind: Kind,
    /// Paths to be drawn over it, in the extent's coordinates; names that are not empty are written at their ends.
    pub wells: Vec<Trace>,
    /// What the raster covers.
    pub extent: Extent,
    /// The owner of each cell.
    pub raster: LabelRaster,
    /// What the raster's labels mean.
    pub volumes: Vec<Volume>,
    /// Facies and their colours; the legend shows those that occur in the raster, in this order.
    pub legend: Vec<Swatch>,
}

impl SectionFigure {
    pub(super) fn check(&self) -> Result<(), PictureError> {
        range("the extent's horizontal range", self.extent.horizontal)?;
        range("the extent's vertical range", self.extent.vertical)?;
        let LabelRaster {
            width,
            height,
            ref cells,
        } = self.raster;
        within("the raster's width in cells", width as f64, 1.0, 65_536.0)?;
        within("the raster's height in cells", height as f64, 1.0, 65_536.0)?;
        within(
            "the raster's number of cells",
            width as f64 * height as f64,
            1.0,
            MOST_CELLS as f64,
        )?;
        if width * height != cells.len() {
            return Err(PictureError::RasterSize {
                width,
                height,
                cells: cells.len(),
            });
        }
        for (i, &label) in cells.iter().enumerate() {
            if label != LabelRaster::NONE && label as usize >= self.volumes.len() {
                return Err(PictureError::NoSuchEntry {
                    what: format!("cell {} of row {} of the raster", i % width, i / width),
                    index: label as usize,
                    count: self.volumes.len(),
                });
            }
        }
        check_swatches(&self.volumes, &self.legend)?;
        for well in &self.wells {
            check_line(&format!("the path of {}", well.ends[0]), &well.line)?;
        }
        match &self.kind {
            Kind::Section {
                line,
                vertical_exaggeration,
                ..
            } => {
                within(
                    "the vertical exaggeration",
                    *vertical_exaggeration,
                    1e-6,
                    1e6,
                )?;
                check_line("the section's line", line)
            }
            Kind::Map { traces } => traces.iter().try_for_each(|trace| {
                check_line(
                    &format!("the trace {}–{}", trace.ends[0], trace.ends[1]),
                    &trace.line,
                )
            }),
        }
    }

    /// The swatches whose facies occur in the raster.
    pub(super) fn swatches(&self) -> Vec<&Swatch> {
        let mut owners = vec![false; self.volumes.len()];
        for &label in &self.raster.cells {
            if let Some(owner) = owners.get_mut(label as usize) {
                *owner = true;
            }
        }
        let occurs = |swatch: usize| {
            let mut volumes = self.volumes.iter().zip(&owners);
            volumes.any(|(volume, occurs)| *occurs && volume.swatch == swatch)
        };
        let swatches = self.legend.iter().enumerate();
        swatches
            .filter(|(i, _)| occurs(*i))
            .map(|(_, swatch)| swatch)
            .collect()
    }
}

impl Extent {
    /// Width and height.
    pub(super) fn spans(&self) -> [f64; 2] {
        [self.horizontal, self.vertical].map(|[low, high]| high - low)
    }
}

fn check_line(what: &str, line: &[DVec2]) -> Result<(), PictureError> {
    for (i, point) in line.iter().enumerate() {
        finite(&format!("easting of point {i} of {what}"), point.x)?;
        finite(&format!("northing of point {i} of {what}"), point.y)?;
    }
    let problem = if line.len() < 2 {
        "has fewer than two points; give at least its two ends"
    } else if line.windows(2).any(|pair| pair[0] == pair[1]) {
        "has two equal points in a row; remove one of them"
    } else {
        return Ok(());
    };
    Err(PictureError::Shape {
        what: what.to_owned(),
        problem,
    })
}
