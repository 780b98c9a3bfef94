//! Half-spaces, and convex polygons cut by them.

use glam::DVec3;

/// A half-space: the points with `normal · p ≤ offset`.
#[derive(Debug, Clone, Copy)]
pub(super) struct HalfSpace {
    pub(super) normal: DVec3,
    pub(super) offset: f64,
}

impl HalfSpace {
    /// Above zero outside.
    pub(super) fn height(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.offset
    }

    fn flipped(&self) -> Self {
        Self {
            normal: -self.normal,
            offset: -self.offset,
        }
    }
}

/// A point of a surface with its normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub(super) at: DVec3,
    pub(super) normal: DVec3,
}

impl Vertex {
    fn between(self, other: Self, fraction: f64) -> Self {
        Self {
            at: self.at.lerp(other.at, fraction),
            normal: self.normal.lerp(other.normal, fraction),
        }
    }
}

/// The part of a convex polygon inside a half-space (Sutherland & Hodgman 1974).
pub(super) fn clipped(polygon: &[Vertex], to: &HalfSpace) -> Vec<Vertex> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let (ha, hb) = (to.height(a.at), to.height(b.at));
        if ha <= 0.0 {
            kept.push(a);
        }
        if (ha < 0.0 && hb > 0.0) || (ha > 0.0 && hb < 0.0) {
            kept.push(a.between(b, ha / (ha - hb)));
        }
    }
    if kept.len() < 3 { Vec::new() } else { kept }
}

/// A convex polygon without what the half-spaces have in common: convex pieces that don't overlap.
pub(super) fn without(polygon: Vec<Vertex>, removed: &[HalfSpace]) -> Vec<Vec<Vertex>> {
    if removed.is_empty() {
        return vec![polygon];
    }
    let mut pieces = Vec::new();
    let mut rest = polygon;
    for side in removed {
        // What lies in the side's plane goes with the rest: it is on the removed body's skin.
        if rest.iter().any(|vertex| side.height(vertex.at) > 0.0) {
            let outside = clipped(&rest, &side.flipped());
            if !outside.is_empty() {
                pieces.push(outside);
            }
            rest = clipped(&rest, side);
        }
        if rest.is_empty() {
            return pieces;
        }
    }
    pieces
}
