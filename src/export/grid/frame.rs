//! The cells of a grid: boxes of one size, or layers between surfaces over a plan of rectangles.
//!
//! Inside, cells are counted from the south-western corner of the base: i eastward, j northward, k upward. A format that counts
//! otherwise turns them as it writes.

use glam::{DVec3, Vec3Swizzles};

use super::layers::Layers;
use super::plan::{Division, FrameError, Plan};
use crate::features::extent::Extent;

/// The cells of a grid.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Boxes of one size.
    Boxes {
        /// Their plan.
        plan: Plan,
        /// The elevation of the lowest cells' base (m).
        base: f64,
        /// A cell's height (m).
        height: f64,
        /// Cells above each other.
        count: usize,
    },
    /// Layers between surfaces.
    Layers(Layers),
}

impl Cells {
    /// Boxes that fill a domain's block, by a division along three axes.
    pub fn boxes(extent: &Extent, division: &Division) -> Result<Self, FrameError> {
        let plan = Plan::new(extent, division)?;
        let (count, height) = division.along(2, extent.high().z - extent.low().z)?;
        Ok(Self::Boxes {
            plan,
            base: extent.low().z,
            height,
            count,
        })
    }

    /// Their plan.
    pub fn plan(&self) -> &Plan {
        match self {
            Self::Boxes { plan, .. } => plan,
            Self::Layers(layers) => layers.plan(),
        }
    }

    /// Cells along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        let [nx, ny] = self.plan().counts;
        let nz = match self {
            Self::Boxes { count, .. } => *count,
            Self::Layers(layers) => layers.count(),
        };
        [nx, ny, nz]
    }

    /// How many there are.
    pub fn len(&self) -> u64 {
        self.counts().iter().map(|count| *count as u64).product()
    }

    /// Whether there are none; there always are some.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The place at fractions of a cell; none if the cell has no thickness.
    pub(super) fn at(&self, [i, j, k]: [usize; 3], part: DVec3) -> Option<DVec3> {
        match self {
            Self::Boxes {
                plan, base, height, ..
            } => {
                let z = base + height * (k as f64 + part.z);
                Some(plan.at(i, j, part.xy()).extend(z))
            }
            Self::Layers(layers) => layers.at([i, j, k], part),
        }
    }

    /// A cell's volume (m³).
    pub(super) fn volume(&self, [i, j, k]: [usize; 3]) -> f64 {
        let area = self.plan().cell.element_product();
        match self {
            Self::Boxes { height, .. } => area * height,
            Self::Layers(layers) => area * layers.thickness([i, j, k]),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    fn extent() -> Extent {
        Extent::block(DVec3::new(10.0, 20.0, -30.0), DVec3::new(40.0, 60.0, 0.0))
    }

    #[test]
    fn cells_of_a_size_that_does_not_fit_reach_beyond_the_domain() {
        let cells = |sizes: [f64; 3]| Cells::boxes(&extent(), &Division::Sizes(sizes.to_vec()));
        assert_eq!(cells([10.0, 10.0, 1.0]).unwrap().counts(), [3, 4, 30]);
        assert_eq!(cells([7.0, 41.0, 0.1]).unwrap().counts(), [5, 1, 300]);
    }

    #[test]
    fn places_count_from_the_south_western_corner_of_the_base() {
        let cells = Cells::boxes(&extent(), &Division::Counts(vec![3, 8, 5])).unwrap();
        let middle = cells.at([2, 1, 4], DVec3::splat(0.5)).unwrap();
        assert_eq!(middle, DVec3::new(35.0, 27.5, -3.0));
        assert_eq!(cells.volume([0, 0, 0]), 10.0 * 5.0 * 6.0);
    }

    #[test]
    fn no_cells_and_cells_of_no_size_are_refused_by_axis() {
        let counts = Division::Counts(vec![3, 0, 5]);
        let error = Cells::boxes(&extent(), &counts).unwrap_err();
        assert_eq!(error, FrameError::NoCells { axis: 'y' });
        for size in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let sizes = Division::Sizes(vec![1.0, 1.0, size]);
            let error = Cells::boxes(&extent(), &sizes).unwrap_err();
            assert!(error.to_string().contains("along z"), "{error}");
        }
        let tiny = Division::Sizes(vec![1e-300, 1.0, 1.0]);
        let error = Cells::boxes(&extent(), &tiny).unwrap_err();
        assert!(error.to_string().contains("along x"), "{error}");
    }
}
