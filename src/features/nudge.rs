//! Tiny changes of bodies.

use glam::DVec3;

/// A tiny change of a body, by which contacts that coincide come apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nudge {
    /// How much the lowest point rises, and each side moves in; a level top stays level (m).
    pub rise: f64,
    /// How much farther out the ends of the longest side in plan are (m).
    pub reach: f64,
    /// By how much all of it moves (m).
    pub shift: DVec3,
}
