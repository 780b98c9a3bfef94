//! Patches, or parts of them, with the directions of their normals.

use std::borrow::Cow;

use glam::DVec3;

use super::bounds::Bounds;
use super::patch::Patch;

/// A patch of a sheet, or a part of one.
pub(super) struct Facet<'a> {
    pub(super) patch: Cow<'a, Patch>,
    /// A cone that holds its normals: axis and sine of the half-angle, if they fit a half-space.
    pub(super) normals: Option<(DVec3, f64)>,
}

impl<'a> Facet<'a> {
    /// A whole patch, whose normals are known.
    pub(super) fn whole(patch: &'a Patch, normals: Option<(DVec3, f64)>) -> Self {
        Self {
            patch: Cow::Borrowed(patch),
            normals,
        }
    }

    /// The sine of the normals' greatest angle from their axis.
    pub(super) fn lean(&self) -> f64 {
        self.normals.map_or(f64::INFINITY, |normals| normals.1)
    }

    /// Those of its halves, across the longer direction, of which first the box and then the patch are wanted.
    pub(super) fn halves(
        &self,
        box_is_wanted: impl Fn(&Bounds) -> bool,
        is_wanted: impl Fn(&Patch) -> bool,
    ) -> impl Iterator<Item = Facet<'static>> {
        self.patch
            .halves(self.patch.longer(), box_is_wanted)
            .into_iter()
            .flatten()
            .filter(move |half| is_wanted(half))
            .map(|half| Facet {
                normals: half.normals(),
                patch: Cow::Owned(half),
            })
    }

    /// Whether no normal of one facet is parallel to one of another, by their cones.
    pub(super) fn is_askew(&self, other: &Facet<'_>) -> bool {
        match (self.normals, other.normals) {
            (Some((a, lean_a)), Some((b, lean_b))) => a.cross(b).length() > lean_a + lean_b,
            _ => false,
        }
    }

    /// Whether no normal of one facet is parallel to one of another, as far as their extremes tell along the
    /// direction in which their axes lean from each other.
    pub(super) fn leans_from(&self, other: &Facet<'_>) -> bool {
        let (Some((a, _)), Some((b, _))) = (self.normals, other.normals) else {
            return false;
        };
        let b = if a.dot(b) < 0.0 { -b } else { b };
        let upright = a + b;
        let along = a - b;
        let slopes = |facet: &Facet<'_>| facet.patch.slopes(along, upright);
        match (slopes(self), slopes(other)) {
            (Some(own), Some(others)) => own[0] > others[1] || others[0] > own[1],
            _ => false,
        }
    }
}
