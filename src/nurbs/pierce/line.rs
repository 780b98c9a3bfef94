//! Lines parallel to an axis.

use glam::{DVec2, DVec3};

/// A line parallel to an axis, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The axis: 0 for x, 1 for y, 2 for z.
    pub axis: usize,
    /// A point that it passes through; the coordinate along the axis does not matter.
    pub through: DVec3,
    /// From where to where it goes along the axis.
    pub range: [f64; 2],
}

impl Line {
    /// The whole line along an axis through a point.
    pub fn whole(axis: usize, through: DVec3) -> Self {
        Self {
            axis,
            through,
            range: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// The other two axes.
    fn across(self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// Seen along the line.
    pub(super) fn view(self, p: DVec3) -> DVec2 {
        let [a, b] = self.across();
        DVec2::new(p[a], p[b])
    }

    /// Its point with a coordinate along the axis.
    pub fn at(self, along: f64) -> DVec3 {
        let mut p = self.through;
        p[self.axis] = along;
        p
    }

    /// Whether it comes this near to a box.
    pub fn meets(self, (low, high): (DVec3, DVec3), near: f64) -> bool {
        let [from, to] = self.range;
        low[self.axis] <= to
            && from <= high[self.axis]
            && self
                .across()
                .into_iter()
                .all(|k| low[k] <= self.through[k] + near && self.through[k] - near <= high[k])
    }
}
