//! Counting the crossings of one ray.

use super::projection::Crossing;
use super::shell::Piece;
use crate::nurbs::bezier::Region;
use crate::nurbs::outline::Outline;
use glam::DVec2;

/// What one ray says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// The ray starts on the shell.
    OnShell,
    /// The ray crosses the shell so many times.
    Crossings(usize),
    /// The ray meets an edge, a fold or a face edge-on; the number is a guess.
    Unclear(usize),
}

/// A crossing on the side of a part of a patch, which the neighbouring part reports too.
struct Seam {
    surface: usize,
    parameters: (f64, f64),
    reach: (f64, f64),
    upward: bool,
}

/// The crossings of one ray so far.
#[derive(Default)]
pub(super) struct Tally {
    count: usize,
    on_shell: bool,
    unclear: bool,
    seams: Vec<Seam>,
}

impl Tally {
    /// A crossing inside a part of a patch.
    pub(super) fn cross(&mut self) {
        self.count += 1;
    }

    /// A crossing with a part of a patch that may be cut by an outline: there it counts if that holds the place.
    pub(super) fn meet(
        &mut self,
        outline: Option<&Outline<'_>>,
        piece: &Piece,
        part: &Region,
        crossing: Crossing,
        ray: [f64; 2],
    ) {
        let Some(outline) = outline else {
            return self.add(piece, part, crossing, ray);
        };
        let [start, width] = ray;
        let above = crossing.height - start;
        if above < -width {
            return;
        }
        let (in_u, in_v) = part.lengths();
        let (s, t) = part.at(crossing.parameters.0, crossing.parameters.1);
        let (u, v) = piece.region.at(s, t);
        let (patch_u, patch_v) = piece.region.lengths();
        let slack = DVec2::new(
            crossing.reach.0 * in_u * patch_u,
            crossing.reach.1 * in_v * patch_v,
        );
        match outline.holds(DVec2::new(u, v), slack) {
            Some(true) => self.add(piece, part, crossing, ray),
            Some(false) => {}
            None if above <= width => self.on_shell = true,
            None => self.doubt(),
        }
    }

    /// A crossing with a part of a patch, for a ray that starts at a height; below a width the two can't be told apart.
    pub(super) fn add(
        &mut self,
        piece: &Piece,
        part: &Region,
        mut crossing: Crossing,
        [start, width]: [f64; 2],
    ) {
        let above = crossing.height - start;
        if above.abs() <= width {
            self.on_shell = true;
        } else if above > 0.0 && crossing.on_side {
            crossing.place(part);
            self.seam(piece, &crossing);
        } else if above > 0.0 {
            self.cross();
        }
    }

    /// Whether the ray starts on the shell.
    pub(super) fn on_shell(&self) -> bool {
        self.on_shell
    }

    /// The ray meets something that it can't count.
    pub(super) fn doubt(&mut self) {
        self.unclear = true;
    }

    /// A crossing on the side of a part of a patch.
    fn seam(&mut self, piece: &Piece, crossing: &Crossing) {
        let range = |[start, end]: [f64; 2]| end - start;
        let (u, v) = piece
            .region
            .at(crossing.parameters.0, crossing.parameters.1);
        let reach = (
            crossing.reach.0 * range(piece.region.u),
            crossing.reach.1 * range(piece.region.v),
        );
        let near =
            |x: f64, [start, end]: [f64; 2], reach: f64| x - start <= reach || end - x <= reach;
        if near(u, piece.domain.u, reach.0) || near(v, piece.domain.v, reach.1) {
            self.unclear = true;
        }
        let own = Seam {
            surface: piece.surface,
            parameters: (u, v),
            reach,
            upward: crossing.upward,
        };
        if let Some(other) = self.seams.iter().find(|other| other.is(&own)) {
            // Neighbours that disagree about the direction meet in a crease that the ray touches.
            self.unclear |= other.upward != own.upward;
        } else {
            self.count += 1;
            self.seams.push(own);
        }
    }

    pub(super) fn outcome(&self) -> Outcome {
        if self.on_shell {
            Outcome::OnShell
        } else if self.unclear {
            Outcome::Unclear(self.count)
        } else {
            Outcome::Crossings(self.count)
        }
    }
}

impl Seam {
    fn is(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64, reach: f64| (a - b).abs() <= reach;
        self.surface == other.surface
            && near(
                self.parameters.0,
                other.parameters.0,
                self.reach.0 + other.reach.0,
            )
            && near(
                self.parameters.1,
                other.parameters.1,
                self.reach.1 + other.reach.1,
            )
    }
}
