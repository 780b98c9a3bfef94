//! The shell as rays meet it: its surfaces as Bézier patches.

use std::sync::Arc;

use crate::nurbs::Surface;
use crate::nurbs::bezier::{Patch, Region};
use crate::nurbs::outline::Outline;
use glam::{DVec2, DVec3};

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
    /// Of a surface that is trimmed, if that passes through the patch: how far it goes.
    pub(super) outline: Option<Arc<Outline<'static>>>,
}

impl Piece {
    /// Whether all of a part of the patch belongs to the shell, or nothing of it; `None` if some may.
    pub(super) fn side(&self, part: &Region) -> Option<bool> {
        let Some(outline) = &self.outline else {
            return Some(true);
        };
        let corner = |s: f64, t: f64| {
            let (s, t) = part.at(s, t);
            let (u, v) = self.region.at(s, t);
            DVec2::new(u, v)
        };
        outline.over(corner(0.0, 0.0), corner(1.0, 1.0))
    }
}

impl Shell {
    /// The patches of surfaces around a centre, as far as outlines say where there are any.
    pub(super) fn new(
        surfaces: &[Surface],
        outlines: &[Arc<Outline<'static>>],
        centre: DVec3,
        [tolerance, width]: [f64; 2],
    ) -> Self {
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
                let mut piece = Piece {
                    patch,
                    region,
                    surface: k,
                    domain,
                    low,
                    high,
                    outline: outlines.get(k).cloned(),
                };
                match piece.side(&Region::UNIT) {
                    Some(false) => continue,
                    Some(true) => piece.outline = None,
                    None => {}
                }
                patches.push(piece);
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
