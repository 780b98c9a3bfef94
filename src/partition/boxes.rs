//! Boxes that hold faces.

use glam::DVec2;

use super::bounds::Bounds;
use super::faces::Face;
use super::patch::{Along, Patch};
use super::sheet::Sheet;

/// A box that holds a face: of the hulls of those parts of its patches that its outer loop surrounds.
pub(super) fn of_face(sheet: &Sheet, traced: &Face) -> Bounds {
    let outer = &traced.polygons[0];
    let mut bounds = Bounds::of(outer.iter().map(|place| sheet.point(place.x, place.y)));
    if sheet.plane.is_none() {
        let low = outer.iter().fold(DVec2::INFINITY, |low, p| low.min(*p));
        let high = outer
            .iter()
            .fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
        for patch in sheet.patches() {
            bounds = bounds.and(hull(&patch, [low, high], HALVINGS));
        }
    }
    bounds
}

/// How often a patch that a face covers in part is halved each way for its box.
const HALVINGS: usize = 2;

fn hull(patch: &Patch, [low, high]: [DVec2; 2], halvings: usize) -> Bounds {
    let (from, to) = (
        DVec2::new(patch.u[0], patch.v[0]),
        DVec2::new(patch.u[1], patch.v[1]),
    );
    if from.cmpge(high).any() || to.cmple(low).any() {
        return Bounds::EMPTY;
    }
    if halvings == 0 || (from.cmpge(low).all() && to.cmple(high).all()) {
        return patch.bounds;
    }
    let mut all = Bounds::EMPTY;
    patch.halve(
        Along::U,
        |_| true,
        |half| {
            half.halve(
                Along::V,
                |_| true,
                |quarter| {
                    all = all.and(hull(&quarter, [low, high], halvings - 1));
                },
            );
        },
    );
    all
}
