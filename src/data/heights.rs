//! Heights as a file has them: on the nodes of a grid, which may be turned, or at scattered points.

use glam::{DVec2, DVec3};

use super::format::Format;

/// Two heights are one within this fraction: numbers that stand for no data are rounded by single precision on their way.
const SAME: f64 = 1e-6;

/// Which way a file's heights grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Positive {
    /// Elevations.
    Up,
    /// Depths.
    Down,
}

/// The heights of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Heights {
    /// How the file is written.
    pub format: Format,
    /// Where they are.
    pub layout: Layout,
    /// Which way they grow, if the file says so.
    pub positive: Option<Positive>,
}

/// Where heights are.
#[derive(Clone, Debug, PartialEq)]
pub enum Layout {
    /// On a regular grid.
    Grid(Grid),
    /// At scattered points.
    Points(Vec<Point>),
}

/// Heights at the nodes of a regular grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The node (0, 0).
    pub first: DVec2,
    /// From one column to the next, and from one row to the next, before the grid is turned.
    pub step: DVec2,
    /// By how much the grid is turned about its first node, counter-clockwise (rad).
    pub rotation: f64,
    /// Columns and rows.
    pub counts: [usize; 2],
    /// The height of column i and row j is entry `i * counts[1] + j`; nothing where there are no data.
    pub heights: Vec<Option<f64>>,
}

/// A scattered point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Where it is, and how high.
    pub at: DVec2,
    /// How high; nothing if there are no data.
    pub height: Option<f64>,
    /// Its line in the file, from 1.
    pub line: u32,
}

/// Where in a file a sample comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A node: column and row from the south-west (of a grid that is turned: from its first node), from 1.
    Node([usize; 2]),
    /// A line.
    Line(u32),
}

/// A height with its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The place and the height, as the file has them.
    pub at: DVec3,
    /// Where it comes from.
    pub origin: Origin,
}

impl std::fmt::Display for Origin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Node([i, j]) => write!(f, "column {i}, row {j}"),
            Self::Line(line) => write!(f, "line {line}"),
        }
    }
}

impl Grid {
    /// The place of a node.
    pub fn place(&self, i: usize, j: usize) -> DVec2 {
        let along = self.step * DVec2::new(i as f64, j as f64);
        if self.rotation == 0.0 {
            return self.first + along;
        }
        self.first + DVec2::from_angle(self.rotation).rotate(along)
    }
}

impl Heights {
    /// All heights with their places; of grids column by column.
    pub fn samples(&self) -> impl Iterator<Item = Sample> + '_ {
        let (grid, points) = match &self.layout {
            Layout::Grid(grid) => (Some(grid), &[][..]),
            Layout::Points(points) => (None, points.as_slice()),
        };
        let of_grid = grid.into_iter().flat_map(|grid| {
            let rows = grid.counts[1];
            let entries = grid.heights.iter().enumerate();
            entries.filter_map(move |(entry, height)| {
                let (i, j) = (entry / rows, entry % rows);
                Some(Sample {
                    at: grid.place(i, j).extend((*height)?),
                    origin: Origin::Node([i + 1, j + 1]),
                })
            })
        });
        let of_points = points.iter().filter_map(|point| {
            Some(Sample {
                at: point.at.extend(point.height?),
                origin: Origin::Line(point.line),
            })
        });
        of_grid.chain(of_points)
    }

    /// How many nodes or points have no height.
    pub fn nulls(&self) -> usize {
        match &self.layout {
            Layout::Grid(grid) => grid.heights.iter().filter(|z| z.is_none()).count(),
            Layout::Points(points) => points.iter().filter(|p| p.height.is_none()).count(),
        }
    }

    /// Takes away the heights that stand for no data.
    pub(super) fn blank(&mut self, nulls: &[f64]) {
        let blank = |height: &mut Option<f64>| {
            if height.is_some_and(|z| nulls.iter().any(|null| is_null(z, *null))) {
                *height = None;
            }
        };
        match &mut self.layout {
            Layout::Grid(grid) => grid.heights.iter_mut().for_each(blank),
            Layout::Points(points) => points.iter_mut().for_each(|p| blank(&mut p.height)),
        }
    }
}

/// Whether a height is one that stands for no data.
pub(super) fn is_null(height: f64, null: f64) -> bool {
    (height - null).abs() <= SAME * null.abs()
}
