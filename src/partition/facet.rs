//! Patches, or parts of them, with the directions of their tangents and normals.

use std::sync::OnceLock;

use glam::DVec3;

use super::bounds::Bounds;
use super::patch::{Along, Cones, Patch};

/// Halves are kept down to this many halvings of a sheet's patch. One patch crosses many others, and parts of it are asked for
/// again and again; below, there are so many that few are asked for twice.
const KEPT: u8 = 5;

/// A patch of a sheet, or a part of one.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    pub(super) patch: Patch,
    /// Once they were asked for: boxes keep most patches apart.
    cones: OnceLock<Cones>,
    /// The point and the tangents in its middle, once they were asked for.
    middle: OnceLock<[DVec3; 3]>,
    /// How many halvings below a sheet's patch it is.
    depth: u8,
    halves: OnceLock<Box<[Self; 2]>>,
}

impl Facet {
    /// A patch of a sheet.
    pub(super) fn new(patch: Patch) -> Self {
        Self::at(0, patch)
    }

    fn at(depth: u8, patch: Patch) -> Self {
        Self {
            cones: OnceLock::new(),
            middle: OnceLock::new(),
            patch,
            depth,
            halves: OnceLock::new(),
        }
    }

    /// The directions of its tangents and normals.
    pub(super) fn cones(&self) -> &Cones {
        self.cones.get_or_init(|| self.patch.cones())
    }

    /// The point and the tangents along u and v in its middle.
    pub(super) fn middle(&self) -> &[DVec3; 3] {
        self.middle.get_or_init(|| {
            let [u, v] = self.patch.middle();
            self.patch.first_jet(u, v).into()
        })
    }

    /// The sine of the normals' greatest angle from their axis.
    pub(super) fn lean(&self) -> f64 {
        self.cones()
            .normals
            .map_or(f64::INFINITY, |normals| normals.1)
    }

    /// Hands on those of its halves, across the longer direction or, if it is not flat, the one that bends more, of which first the box and then the patch are wanted.
    pub(super) fn halve(
        &self,
        box_is_wanted: impl Fn(&Bounds) -> bool,
        is_wanted: impl Fn(&Patch) -> bool,
        mut each: impl FnMut(&Self),
    ) {
        if self.depth < KEPT {
            for half in self.halves() {
                if box_is_wanted(&half.patch.bounds) && is_wanted(&half.patch) {
                    each(half);
                }
            }
        } else {
            // As `Patch::halve`, but measured where they stay: they are large, and moved once more they cost the case study a twentieth of its time.
            let halves = self.patch.bare_halves(self.along());
            for mut half in halves.map(|half| Self::at(KEPT, half)) {
                if box_is_wanted(&half.patch.bounds) {
                    half.patch.measure();
                    if is_wanted(&half.patch) {
                        each(&half);
                    }
                }
            }
        }
    }

    fn along(&self) -> Along {
        if self.cones().normals.is_some() {
            self.patch.longer()
        } else {
            self.patch.rounder()
        }
    }

    fn halves(&self) -> &[Self; 2] {
        self.halves.get_or_init(|| {
            let halves = self.patch.halves(self.along());
            Box::new(halves.map(|half| Self::at(self.depth + 1, half)))
        })
    }
}
