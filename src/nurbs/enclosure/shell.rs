//! The shell as rays meet it: its surfaces as Bézier patches.

use crate::nurbs::Surface;
use crate::nurbs::bezier::{Patch, Region};
use glam::DVec3;

/// The Bézier patches of the surfaces, relative to the middle of the shell so that far-away coordinates cost no digits.
#[derive(Clone, Debug)]
pub(super) struct Shell {
    pub(super) centre: DVec3,
    pub(super) patches: Vec<Piece>,
    /// How far apart edges may be.
    pub(super) tolerance: f64,
    /// How near the shell a point counts as on it.
    pub(super) width: f64,
}

/// A Bézier patch of the shell.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) patch: Patch,
    pub(super) region: Region,
    pub(super) surface: usize,
    /// The whole surface's parameters.
    pub(super) domain: Region,
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Shell {
    /// The patches of surfaces around a centre.
    pub(super) fn new(surfaces: &[Surface], centre: DVec3, tolerance: f64, width: f64) -> Self {
        let mut patches = Vec::new();
        for (k, surface) in surfaces.iter().enumerate() {
            let (u, v) = (surface.knots_u().domain(), surface.knots_v().domain());
            let domain = Region {
                u: [u.0, u.1],
                v: [v.0, v.1],
            };
            for (patch, region) in Patch::of_surface(surface) {
                let patch = patch.mapped(|x| x - centre);
                let (low, high) = patch.hull();
                patches.push(Piece {
                    patch,
                    region,
                    surface: k,
                    domain,
                    low,
                    high,
                });
            }
        }
        Self {
            centre,
            patches,
            tolerance,
            width,
        }
    }
}
