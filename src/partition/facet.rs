//! Patches, or parts of them, with the directions of their normals.

use std::borrow::Cow;

use glam::DVec3;

use super::bounds::Bounds;
use super::patch::Patch;

/// Keeps a share defined where neither of two ranges has a width.
const TINY: f64 = 1e-12;

/// A patch of a sheet, or a part of one.
pub(super) struct Facet<'a> {
    pub(super) patch: Cow<'a, Patch>,
    /// A cone that holds its normals: axis and sine of the half-angle, if they fit a half-space.
    pub(super) normals: Option<(DVec3, f64)>,
}

impl<'a> Facet<'a> {
    /// A whole patch, whose normals are known.
    pub(super) fn whole(patch: Cow<'a, Patch>, normals: Option<(DVec3, f64)>) -> Self {
        Self { patch, normals }
    }

    /// The sine of the normals' greatest angle from their axis.
    pub(super) fn lean(&self) -> f64 {
        self.normals.map_or(f64::INFINITY, |normals| normals.1)
    }

    /// Hands on those of its halves, across the longer direction, of which first the box and then the patch are wanted.
    pub(super) fn halve(
        &self,
        box_is_wanted: impl Fn(&Bounds) -> bool,
        is_wanted: impl Fn(&Patch) -> bool,
        mut each: impl FnMut(&Facet<'static>),
    ) {
        self.patch
            .halve(self.patch.longer(), box_is_wanted, |half| {
                if is_wanted(&half) {
                    each(&Facet {
                        normals: half.normals(),
                        patch: Cow::Owned(half),
                    });
                }
            });
    }

    /// Whether no normal of one facet is parallel to one of another, by their cones.
    pub(super) fn is_askew(&self, other: &Facet<'_>) -> bool {
        match (self.normals, other.normals) {
            (Some((a, lean_a)), Some((b, lean_b))) => a.cross(b).length() > lean_a + lean_b,
            _ => false,
        }
    }

    /// Whether a plane across the direction that is in both tangent planes keeps both apart, by more than a distance.
    pub(super) fn is_past(&self, other: &Facet<'_>, distance: f64) -> bool {
        let (Some((a, _)), Some((b, _))) = (self.normals, other.normals) else {
            return false;
        };
        let along = a.cross(b);
        let [own, others] = [self, other].map(|facet| facet.patch.range_along(along));
        let slack = distance * along.length();
        own[0] > others[1] + slack || others[0] > own[1] + slack
    }

    /// Whether no normal of one facet is parallel to one of another, as far as products of legs tell on both sides of a
    /// plane between their corners' normals.
    pub(super) fn leans_from(&self, other: &Facet<'_>) -> bool {
        let (Some((a, _)), Some((b, _))) = (self.normals, other.normals) else {
            return false;
        };
        let b = if a.dot(b) < 0.0 { -b } else { b };
        let (along, upright) = (a - b, a + b);
        let slopes = |facet: &Facet<'_>| facet.patch.corner_slopes(along, upright);
        let (Some(own), Some(others)) = (slopes(self), slopes(other)) else {
            return false;
        };
        let (steep, [high, most], flat, [least, low]) = if own[0] > others[1] {
            (self, own, other, others)
        } else {
            (other, others, self, own)
        };
        // Written so that NaN fails too.
        if !(high > low) {
            return false;
        }
        // Nearer to the one whose normals vary less.
        let (above, below) = (most - high, low - least);
        let share = (below + TINY) / (above + below + 2.0 * TINY);
        let between = along - (low + share * (high - low)) * upright;
        steep.patch.all_lean(between, upright) && flat.patch.all_lean(-between, upright)
    }
}
