//! Patches, or parts of them, with the directions of their tangents and normals.

use std::borrow::Cow;

use super::bounds::Bounds;
use super::patch::{Cones, Patch};

/// A patch of a sheet, or a part of one.
pub(super) struct Facet<'a> {
    pub(super) patch: Cow<'a, Patch>,
    pub(super) cones: Cones,
}

impl Facet<'_> {
    /// The sine of the normals' greatest angle from their axis.
    pub(super) fn lean(&self) -> f64 {
        self.cones
            .normals
            .map_or(f64::INFINITY, |normals| normals.1)
    }

    /// Hands on those of its halves, across the longer direction or, if it is not flat, the one that bends more, of which first the box and then the patch are wanted.
    pub(super) fn halve(
        &self,
        box_is_wanted: impl Fn(&Bounds) -> bool,
        is_wanted: impl Fn(&Patch) -> bool,
        mut each: impl FnMut(&Facet<'static>),
    ) {
        let along = if self.cones.normals.is_some() {
            self.patch.longer()
        } else {
            self.patch.rounder()
        };
        self.patch.halve(along, box_is_wanted, |half| {
            if is_wanted(&half) {
                each(&Facet {
                    cones: half.cones(),
                    patch: Cow::Owned(half),
                });
            }
        });
    }
}
