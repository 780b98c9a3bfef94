//! Whether a closed shell of surfaces holds a point: the geometry under every "which volume is here?".
//!
//! A ray from the point crosses the shell an odd number of times if the point is inside. The first ray goes straight up,
//! through patches cut small enough, once and for all, that most crossings are decided by a few multiplications
//! ([`columns`]). A ray that meets an edge of the shell, a fold or a vertical face decides nothing; then rays in a fixed
//! list of oblique directions follow ([`oblique`]), until one is clear of them. The answer doesn't depend on the surfaces'
//! orientations, nor on whether they overhang or are rational.
//!
//! A point on the shell, as far as rounding can tell, counts as inside.
//!
//! **Last resort.** If no direction is clear (a point on a cusp of the shell, say), the point is inside if it is on the
//! shell or if the majority of what the oblique rays counted says so.
//!
//! **Limits.** Edges must pair one to one, so an edge that ends in the middle of a longer one leaves the shell open. A shell
//! that crosses itself holds the points that an odd number of its sheets are above.

mod closure;
mod columns;
mod oblique;
mod projection;
mod tally;

use super::Surface;
use super::bezier::{Patch, Region};
use super::closest::nearest;
use columns::Columns;
use glam::DVec3;
use std::fmt;
use tally::Outcome;
use thiserror::Error;

/// Default tolerance for edges to meet, as a fraction of the shell's size: far above rounding, far below any geology.
const CLOSURE: f64 = 1e-9;

/// A point counts as on the shell below this fraction of its size: what rounding leaves of a crossing's height.
const ON_SHELL: f64 = 1e-13;

/// One of the four sides of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Least u.
    UStart,
    /// Greatest u.
    UEnd,
    /// Least v.
    VStart,
    /// Greatest v.
    VEnd,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::UStart => "u = start",
            Self::UEnd => "u = end",
            Self::VStart => "v = start",
            Self::VEnd => "v = end",
        })
    }
}

/// Why surfaces are not a closed shell.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum EnclosureError {
    /// There are no surfaces.
    #[error("a shell needs surfaces and there are none")]
    Empty,
    /// The tolerance is not a positive number.
    #[error(
        "the tolerance is {value}; it must be above zero and far below the shell's size {size}"
    )]
    Tolerance {
        /// The tolerance.
        value: f64,
        /// The diagonal of the shell's box.
        size: f64,
    },
    /// A side of a surface is the side of no other.
    #[error(
        "the shell is open: side {side} of surface {surface}, from {from} to {to}, is no other side to within {tolerance}; add the missing surface or make the edges coincide"
    )]
    Open {
        /// Position of the surface in the list.
        surface: usize,
        /// Its side.
        side: Side,
        /// Where the side starts.
        from: DVec3,
        /// Where the side ends.
        to: DVec3,
        /// How far apart edges may be.
        tolerance: f64,
    },
}

/// A closed shell that can be asked for the points inside it.
#[derive(Clone, Debug)]
pub struct Enclosure {
    surfaces: Vec<Surface>,
    shell: Shell,
    columns: Columns,
    low: DVec3,
    high: DVec3,
}

/// The Bézier patches of the surfaces, relative to the middle of the shell so that far-away coordinates cost no digits.
#[derive(Clone, Debug)]
struct Shell {
    centre: DVec3,
    patches: Vec<Piece>,
    /// How far apart edges may be.
    tolerance: f64,
    /// How near the shell a point counts as on it.
    width: f64,
}

/// A Bézier patch of the shell.
#[derive(Clone, Debug)]
struct Piece {
    patch: Patch,
    region: Region,
    surface: usize,
    /// The whole surface's parameters.
    domain: Region,
    low: DVec3,
    high: DVec3,
}

impl Enclosure {
    /// A shell of surfaces whose sides meet in pairs, to within a billionth of its size.
    pub fn new(surfaces: Vec<Surface>) -> Result<Self, EnclosureError> {
        let size = size(&surfaces);
        Self::with_tolerance(surfaces, CLOSURE * size)
    }

    /// A shell of surfaces whose sides meet in pairs to within a distance of one's own.
    pub fn with_tolerance(surfaces: Vec<Surface>, tolerance: f64) -> Result<Self, EnclosureError> {
        if surfaces.is_empty() {
            return Err(EnclosureError::Empty);
        }
        let size = size(&surfaces);
        if !(tolerance > 0.0 && tolerance < 1e-2 * size) {
            return Err(EnclosureError::Tolerance {
                value: tolerance,
                size,
            });
        }
        closure::check(&surfaces, tolerance)?;
        let (low, high) = net_box(&surfaces);
        // Far from the origin the coordinates themselves are coarser.
        let reach = low.abs().max(high.abs()).max_element();
        let width = ON_SHELL * size + 2.0 * f64::EPSILON * reach;
        let shell = Shell::new(&surfaces, 0.5 * (low + high), tolerance, width);
        let columns = Columns::new(&shell, size);
        Ok(Self {
            surfaces,
            shell,
            columns,
            low,
            high,
        })
    }

    /// Whether p is inside the shell or on it.
    pub fn contains(&self, p: DVec3) -> bool {
        // Also false where a coordinate is not a number.
        let near = self.shell.width;
        if !(p.cmpge(self.low - near).all() && p.cmple(self.high + near).all()) {
            return false;
        }
        let p = p - self.shell.centre;
        match self.columns.cast(&self.shell, p) {
            Outcome::OnShell => return true,
            Outcome::Crossings(count) => return count % 2 == 1,
            Outcome::Unclear(_) => {}
        }
        self.contains_by_oblique_rays(p)
    }

    fn contains_by_oblique_rays(&self, p: DVec3) -> bool {
        let (mut inside, mut outside) = (0, 0);
        for direction in oblique::DIRECTIONS {
            match oblique::cast(&self.shell, p, DVec3::from_array(direction)) {
                Outcome::OnShell => return true,
                Outcome::Crossings(count) => return count % 2 == 1,
                Outcome::Unclear(count) if count % 2 == 1 => inside += 1,
                Outcome::Unclear(_) => outside += 1,
            }
        }
        let patches = self.shell.patches.iter().map(|piece| &piece.patch);
        inside > outside || nearest(patches, p, self.shell.width, 2.0 * self.shell.width).is_some()
    }

    /// The distance from p to the shell if it is below the limit, to within a billionth of the shell's size.
    pub fn distance(&self, p: DVec3, limit: f64) -> Option<f64> {
        let p = p - self.shell.centre;
        let tolerance = CLOSURE * (self.high - self.low).length();
        // Boxes first: most pieces are beyond the limit.
        let within = |piece: &&Piece| (p - p.clamp(piece.low, piece.high)).length() < limit;
        let near = self
            .shell
            .patches
            .iter()
            .filter(within)
            .map(|piece| &piece.patch);
        nearest(near, p, tolerance, limit).map(|found| found.distance)
    }

    /// The box of the control points, which holds the shell.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        (self.low, self.high)
    }

    /// The surfaces, in the order in which they were given.
    pub fn surfaces(&self) -> &[Surface] {
        &self.surfaces
    }
}

impl Shell {
    fn new(surfaces: &[Surface], centre: DVec3, tolerance: f64, width: f64) -> Self {
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

fn net_box(surfaces: &[Surface]) -> (DVec3, DVec3) {
    let points = surfaces.iter().flat_map(Surface::net);
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points.fold(empty, |(low, high), &p| (low.min(p), high.max(p)))
}

fn size(surfaces: &[Surface]) -> f64 {
    let (low, high) = net_box(surfaces);
    (high - low).length()
}
