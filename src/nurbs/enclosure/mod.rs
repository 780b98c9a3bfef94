//! Whether a closed shell of surfaces holds a point: the geometry under every "which volume is here?".
//!
//! A ray from the point crosses the shell an odd number of times if the point is inside. The first ray goes straight up,
//! through patches cut small enough, once and for all, that most crossings are decided by a few multiplications
//! (`columns`). A ray that meets an edge of the shell, a fold or a vertical face decides nothing; then rays in a fixed
//! list of oblique directions follow (`oblique`), until one is clear of them. The answer doesn't depend on the surfaces'
//! orientations, nor on whether they overhang or are rational.
//!
//! A point on the shell, as far as rounding can tell, counts as inside.
//!
//! **Last resort.** If no direction is clear (a point on a cusp of the shell, say), the point is inside if it is on the
//! shell or if the majority of what the oblique rays counted says so.
//!
//! **Trimmed surfaces** count as far as their outlines say. Where an outline passes through a part of a patch, a crossing is located,
//! and the outline asked for its place; a ray that comes too near to an outline decides nothing, as at any edge.
//!
//! **Limits.** Edges of surfaces that are not trimmed must pair one to one, so an edge that ends in the middle of a longer one leaves the shell open. A shell
//! that crosses itself holds the points that an odd number of its sheets are above.

mod closure;
mod columns;
mod oblique;
mod projection;
mod shade;
mod shell;
mod tally;

use std::sync::Arc;

use super::closest::nearest;
use super::outline::Outline;
use super::{Surface, Trimmed};
pub use closure::{EnclosureError, Side};
use columns::Columns;
use glam::DVec3;
use shell::{Piece, Shell};
use tally::Outcome;

/// Default tolerance for edges to meet, as a fraction of the shell's size: far above rounding, far below any geology.
const CLOSURE: f64 = 1e-9;

/// A point counts as on the shell below this fraction of its size: what rounding leaves of a crossing's height.
const ON_SHELL: f64 = 1e-13;

/// A closed shell that can be asked for the points inside it.
#[derive(Clone, Debug)]
pub struct Enclosure {
    surfaces: Vec<Surface>,
    shell: Shell,
    columns: Columns,
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
        Ok(Self::of(surfaces, &[], tolerance))
    }

    /// A shell of trimmed surfaces whose edges are no farther apart than a tolerance: that they close, whoever knows them by their
    /// edges has checked.
    pub fn trimmed(faces: &[Trimmed], tolerance: f64) -> Result<Self, EnclosureError> {
        let surfaces: Vec<Surface> = faces.iter().map(|face| face.surface().clone()).collect();
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
        let outlines: Vec<_> = faces
            .iter()
            .map(|face| Arc::clone(face.outline()))
            .collect();
        let tolerance = tolerance.max(CLOSURE * size);
        Ok(Self::of(surfaces, &outlines, tolerance))
    }

    fn of(surfaces: Vec<Surface>, outlines: &[Arc<Outline<'static>>], tolerance: f64) -> Self {
        let size = size(&surfaces);
        let (low, high) = net_box(&surfaces);
        // Far from the origin the coordinates themselves are coarser.
        let reach = low.abs().max(high.abs()).max_element();
        let width = ON_SHELL * size + 2.0 * f64::EPSILON * reach;
        let centre = 0.5 * (low + high);
        let shell = Shell::new(&surfaces, outlines, centre, [tolerance, width]);
        let columns = Columns::new(&shell, size);
        Self {
            surfaces,
            shell,
            columns,
            low,
            high,
        }
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

    /// The distance from p to the shell if it is below the limit, to within a billionth of the shell's size; patches that an outline
    /// passes through count as wholes.
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

fn net_box(surfaces: &[Surface]) -> (DVec3, DVec3) {
    let points = surfaces.iter().flat_map(Surface::net);
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points.fold(empty, |(low, high), &p| (low.min(p), high.max(p)))
}

fn size(surfaces: &[Surface]) -> f64 {
    let (low, high) = net_box(surfaces);
    (high - low).length()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;
    use crate::nurbs::interpolate;
    use proptest::prelude::*;

    /// A winding gutter whose banks overhang, its ruled top and its two ends.
    fn gutter() -> Vec<Surface> {
        let section = [
            (-3.0, 0.0),
            (-7.0, -2.0),
            (-1.0, -4.0),
            (2.0, -4.0),
            (6.0, -1.0),
            (3.0, 0.0),
        ];
        let along: Vec<f64> = (0..20).map(f64::from).collect();
        let place = |y: f64, z: f64, s: f64| {
            let bend = (0.6 * s).sin();
            DVec3::new(8.0 * s - 2.0 * bend * y, y + 12.0 * bend, z + bend)
        };
        let row = |&(y, z): &(f64, f64)| along.iter().map(|&s| place(y, z, s)).collect();
        let rows: Vec<Vec<DVec3>> = section.iter().map(row).collect();
        let (v, rows) = interpolate::with_parameters(&rows, &along, 3).unwrap();
        let u = KnotVector::uniform(3, section.len()).unwrap();
        let base = Surface::new(u, v, rows.concat()).unwrap();
        let top = Surface::ruled(&base.isocurve_u(0.0), &base.isocurve_u(1.0)).unwrap();
        let end = |s: f64| Surface::ruled(&base.isocurve_v(s), &top.isocurve_v(s)).unwrap();
        let ends = [end(0.0), end(19.0)];
        [vec![base, top], ends.to_vec()].concat()
    }

    /// Asks all rays of scattered points and returns how many were inside; clear rays must agree.
    fn ask(shell: &Enclosure, points: u32) -> (usize, usize, usize) {
        let (low, high) = shell.bounds();
        let (mut clear, mut unclear, mut held) = (0, 0, 0);
        for k in 0..points {
            let part = DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478) * f64::from(k);
            let p = low + (high - low) * part.fract() - shell.shell.centre;
            let oblique =
                oblique::DIRECTIONS.map(|d| oblique::cast(&shell.shell, p, DVec3::from_array(d)));
            let all = [&[shell.columns.cast(&shell.shell, p)], oblique.as_slice()].concat();
            let parity = |outcome: &Outcome| match outcome {
                Outcome::Crossings(count) => Some(count % 2),
                Outcome::OnShell | Outcome::Unclear(_) => None,
            };
            let said: Vec<usize> = all.iter().filter_map(parity).collect();
            assert!(
                said.windows(2).all(|pair| pair[0] == pair[1]),
                "{p}: {all:?}"
            );
            assert!(!said.is_empty());
            clear += said.len();
            unclear += all.len() - said.len();
            held += said[0];
        }
        (clear, unclear, held)
    }

    #[test]
    fn all_rays_that_are_clear_say_the_same_of_a_point() {
        let shell = Enclosure::new(gutter()).unwrap();
        let (clear, unclear, held) = ask(&shell, 3000);
        assert!(held > 300, "{held}");
        // Doubt is rare, so it costs little.
        assert!(unclear * 50 < clear, "{unclear} of {clear}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn all_clear_rays_agree_about_any_closed_surface_even_if_it_crosses_itself(
            degree_u in 1..=3_usize,
            degree_v in 1..=3_usize,
            net in prop::collection::vec((-1.0..1.0, -1.0..1.0, -1.0..1.0, 0.4..2.5), 56),
        ) {
            // Closed in u by a seam, in v by two poles.
            let at = |i: usize, j: usize| {
                let (x, y, z, w) = net[match j { 0 => 0, 6 => 1, _ => (i % 7) * 7 + j + 2 }];
                (DVec3::new(x, y, z), w)
            };
            let entries = (0..8).flat_map(|i| (0..7).map(move |j| at(i, j)));
            let (points, weights): (Vec<_>, Vec<_>) = entries.unzip();
            let knots = (KnotVector::uniform(degree_u, 8).unwrap(), KnotVector::uniform(degree_v, 7).unwrap());
            let surface = Surface::rational(knots.0, knots.1, points, weights).unwrap();
            let shell = Enclosure::new(vec![surface]).unwrap();
            ask(&shell, 60);
        }
    }
}
