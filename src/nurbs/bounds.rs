//! Tight bounding boxes: those of the curve or surface, not of its control points.
//!
//! Branch and bound on each coordinate: a Bézier piece can only reach beyond the best corner found so far if one of its
//! control points does, and halving a piece brings its control points to it quadratically.

use super::bezier::{Along, Patch, Region, halves};
use super::{Curve, Surface};
use glam::DVec3;

/// The boxes hold their shape and exceed it by at most this fraction of the net's size.
const TIGHTNESS: f64 = 1e-9;

impl Curve {
    /// The least and the greatest coordinates on the curve: never inside it, and outside by at most a billionth of its
    /// size.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        tight(&Patch::of_curve(self))
    }
}

impl Surface {
    /// The least and the greatest coordinates on the surface: never inside it, and outside by at most a billionth of its
    /// size.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        tight(&Patch::of_surface(self))
    }
}

fn tight(pieces: &[(Patch, Region)]) -> (DVec3, DVec3) {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = pieces.iter().fold(empty, |(low, high), (patch, _)| {
        let own = patch.hull();
        (low.min(own.0), high.max(own.1))
    });
    let tolerance = TIGHTNESS * (high - low).length();
    let most = |axis: DVec3| greatest(pieces, tolerance, |p| p.dot(axis));
    let greatest = DVec3::new(most(DVec3::X), most(DVec3::Y), most(DVec3::Z));
    let least = -DVec3::new(most(DVec3::NEG_X), most(DVec3::NEG_Y), most(DVec3::NEG_Z));
    (least, greatest)
}

/// The greatest coordinate, too large by at most the tolerance.
fn greatest(pieces: &[(Patch, Region)], tolerance: f64, coordinate: impl Fn(DVec3) -> f64) -> f64 {
    let upper = |patch: &Patch| {
        patch
            .points()
            .map(&coordinate)
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let corners = |patch: &Patch| {
        let corner = |i: usize, j: usize| {
            let h = patch.control(i, j);
            coordinate(h.truncate() / h.w)
        };
        let (p, q) = (patch.degree_u, patch.degree_v);
        corner(0, 0)
            .max(corner(p, 0))
            .max(corner(0, q))
            .max(corner(p, q))
    };
    let mut reached = pieces
        .iter()
        .map(|(p, _)| corners(p))
        .fold(f64::NEG_INFINITY, f64::max);
    let mut bound = reached;
    let mut stack: Vec<(f64, Patch)> = pieces
        .iter()
        .map(|(patch, _)| (upper(patch), patch))
        .filter(|(upper, _)| *upper > reached)
        .map(|(upper, patch)| (upper, patch.clone()))
        .collect();
    stack.sort_by(|a, b| a.0.total_cmp(&b.0));
    while let Some((most, patch)) = stack.pop() {
        if most <= reached + tolerance {
            bound = bound.max(most);
            continue;
        }
        let (in_u, in_v) = patch.lengths(|leg| coordinate(leg).abs());
        let along = if in_u >= in_v { Along::U } else { Along::V };
        let mut parts = halves(&patch, &Region::UNIT, along).map(|(half, _)| (upper(&half), half));
        parts.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, half) in &parts {
            reached = reached.max(corners(half));
        }
        stack.extend(parts);
    }
    bound.max(reached)
}
