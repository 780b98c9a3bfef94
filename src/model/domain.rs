//! The block that is modelled.

use glam::DVec3;

use super::values::surface::HorizonSurface;

/// The modelled block; its volume before any feature is called `background`.
#[derive(Clone, Debug, PartialEq)]
pub struct Domain {
    /// West and east limits.
    pub x: [f64; 2],
    /// South and north limits.
    pub y: [f64; 2],
    /// Base and top.
    pub z: [f64; 2],
    /// A base above the block's own: below it the model has nothing.
    pub base: Option<HorizonSurface>,
    /// A top below the block's own: above it the model has nothing.
    pub top: Option<HorizonSurface>,
    /// A bed thinner than this at the nodes of its horizons' grids is absent there.
    pub least_thickness: f64,
    /// Index of the background's facies.
    pub facies: usize,
}

impl Domain {
    /// [`Self::least_thickness`] if none is given, as a fraction of the domain's diagonal: far below any geology.
    pub const LEAST_THICKNESS: f64 = 1e-10;

    /// Extents in x, y and z.
    pub fn size(&self) -> [f64; 3] {
        [self.x, self.y, self.z].map(|[lo, hi]| hi - lo)
    }

    /// The lower and the upper corner.
    pub(crate) fn corners(&self) -> (DVec3, DVec3) {
        let corner = |i: usize| DVec3::new(self.x[i], self.y[i], self.z[i]);
        (corner(0), corner(1))
    }
}
