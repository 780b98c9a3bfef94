//! Solids: faces joined through the sectors between them into shells, shells into solids with their voids.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::Label;
use super::arcs::Arc;
use super::bounds::Bounds;
use super::check::Faults;
use super::faces::Face;
use super::pair::Tolerances;
use super::pierce::{Piercing, Segment};
use super::polygon::encloses;
use super::quadrature::Integral;
use super::tracks::{Geometry, Tracks};

/// One side of a face: 2 × face for the inner side, + 1 for the outer.
type HalfFace = usize;

/// A connected piece of a volume: shells of faces, the outer one first. `true` = the solid's outward normal is
/// against the face's.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub(super) label: usize,
    pub(super) shells: Vec<Vec<(usize, bool)>>,
    pub(super) volume: f64,
}

struct Shell {
    label: usize,
    halves: Vec<HalfFace>,
    volume: f64,
}

/// Sets that are joined.
struct Sets(Vec<usize>);

impl Sets {
    fn find(&mut self, mut at: usize) -> usize {
        while self.0[at] != at {
            self.0[at] = self.0[self.0[at]];
            at = self.0[at];
        }
        at
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        // The smaller stands for both, so that the result does not depend on the order.
        self.0[a.max(b)] = a.min(b);
    }
}

/// Everything that solids are made from.
pub(super) struct Parts<'a> {
    pub(super) geometry: Geometry<'a>,
    pub(super) tracks: &'a Tracks,
    pub(super) arcs: &'a [Arc],
    pub(super) faces: &'a [Face],
    pub(super) integrals: &'a [Integral],
    pub(super) tolerances: Tolerances,
}

impl Parts<'_> {
    pub(super) fn solids(&self, faults: &mut Faults) -> Vec<Solid> {
        let of_flap = self.faces_of_flaps();
        let mut sets = Sets((0..2 * self.faces.len()).collect());
        for (arc, own) in self.arcs.iter().zip(&of_flap) {
            if arc.flaps.len() < 2 {
                continue;
            }
            for k in 0..arc.flaps.len() {
                let next = (k + 1) % arc.flaps.len();
                if let (Some(a), Some(b)) = (own[k], own[next]) {
                    let (after, before) = (arc.flaps[k].facing[1], arc.flaps[next].facing[0]);
                    sets.join(2 * a + after, 2 * b + before);
                }
            }
        }
        let shells = self.shells(&mut sets, faults);
        self.check_closed(&shells, &of_flap, faults);
        self.gather(shells, faults)
    }

    fn faces_of_flaps(&self) -> Vec<Vec<Option<usize>>> {
        let mut of_flap: Vec<Vec<Option<usize>>> = self
            .arcs
            .iter()
            .map(|arc| vec![None; arc.flaps.len()])
            .collect();
        for (index, face) in self.faces.iter().enumerate() {
            for half in face.loops.iter().flatten() {
                of_flap[half.arc][half.flap] = Some(index);
            }
        }
        of_flap
    }

    fn label(&self, half: HalfFace) -> Label {
        self.faces[half / 2].labels[half % 2]
    }

    fn shells(&self, sets: &mut Sets, faults: &mut Faults) -> Vec<Shell> {
        let mut by_root: BTreeMap<usize, Vec<HalfFace>> = BTreeMap::new();
        for half in 0..2 * self.faces.len() {
            by_root.entry(sets.find(half)).or_default().push(half);
        }
        let mut shells = Vec::new();
        for halves in by_root.into_values() {
            let label = self.label(halves[0]);
            faults.mixed_shells +=
                usize::from(halves.iter().any(|half| self.label(*half) != label));
            let Some(label) = label else { continue };
            let volume = halves.iter().map(|half| self.signed(*half)).sum();
            shells.push(Shell {
                label,
                halves,
                volume,
            });
        }
        shells
    }

    /// A half-face's part of the volume of what it bounds.
    fn signed(&self, half: HalfFace) -> f64 {
        let face = &self.faces[half / 2];
        let out = self.geometry.regions.sheets[face.sheet].outward;
        let flux = out * self.integrals[half / 2].flux;
        if half.is_multiple_of(2) { flux } else { -flux }
    }

    /// Along every arc, a shell comes in as often as it goes out.
    fn check_closed(&self, shells: &[Shell], of_flap: &[Vec<Option<usize>>], faults: &mut Faults) {
        let mut shell_of = vec![usize::MAX; 2 * self.faces.len()];
        for (index, shell) in shells.iter().enumerate() {
            for half in &shell.halves {
                shell_of[*half] = index;
            }
        }
        for (arc, own) in self.arcs.iter().zip(of_flap) {
            if arc.flaps.len() < 2 {
                continue;
            }
            let mut passes: Vec<(usize, i32)> = Vec::with_capacity(2 * own.len());
            for (flap, face) in arc.flaps.iter().zip(own) {
                let Some(face) = face else {
                    faults.open_shells += 1;
                    continue;
                };
                // Seen from outside the region's inner solid the loop runs one way, for the outer solid the other.
                let out = self.geometry.regions.sheets[self.faces[*face].sheet].outward;
                let way = if flap.left == (out > 0.0) { 1 } else { -1 };
                passes.push((shell_of[2 * face], way));
                passes.push((shell_of[2 * face + 1], -way));
            }
            passes.sort_unstable();
            let open = passes
                .chunk_by(|a, b| a.0 == b.0)
                .filter(|own| {
                    own[0].0 != usize::MAX && own.iter().map(|pass| pass.1).sum::<i32>() != 0
                })
                .count();
            faults.open_shells += open;
        }
    }

    /// Shells that enclose a volume become solids; the others are voids of the solids around them.
    fn gather(&self, shells: Vec<Shell>, faults: &mut Faults) -> Vec<Solid> {
        let (outer, voids): (Vec<Shell>, Vec<Shell>) =
            shells.into_iter().partition(|shell| shell.volume > 0.0);
        let mut solids: Vec<Solid> = outer
            .iter()
            .map(|shell| Solid {
                label: shell.label,
                shells: vec![self.oriented(&shell.halves)],
                volume: shell.volume,
            })
            .collect();
        for void in voids {
            match self.home(&void, &outer) {
                Some(home) => {
                    solids[home].shells.push(self.oriented(&void.halves));
                    solids[home].volume += void.volume;
                }
                None => faults.homeless_voids += 1,
            }
        }
        solids
    }

    fn oriented(&self, halves: &[HalfFace]) -> Vec<(usize, bool)> {
        let reversed = |half: &HalfFace| {
            let out = self.geometry.regions.sheets[self.faces[half / 2].sheet].outward;
            (out > 0.0) != half.is_multiple_of(2)
        };
        halves
            .iter()
            .map(|half| (half / 2, reversed(half)))
            .collect()
    }

    /// The smallest shell of the same label that a void lies in, by a ray from the void.
    fn home(&self, void: &Shell, outer: &[Shell]) -> Option<usize> {
        // Askew, so that it meets no edge but by accident.
        const DIRECTION: DVec3 = DVec3::new(0.013_7, 0.029_1, 1.0);
        let candidates: Vec<usize> = (0..outer.len())
            .filter(|at| outer[*at].label == void.label && outer[*at].volume > -void.volume)
            .collect();
        // Even a single candidate is asked: a thin solid whose volume is lost in rounding is nobody's void.
        let face = &self.faces[void.halves[0] / 2];
        let half = face.loops.first()?.first()?;
        let arc = &self.arcs[half.arc];
        let source = self.tracks.tracks[arc.track].source;
        let start = self
            .geometry
            .point(source, arc.t[0] + 0.5171 * (arc.t[1] - arc.t[0]));
        let reach = 2.0 * self.geometry.regions.domain.diagonal();
        let ray = [Segment::new(
            [start.extend(1.0), (start + reach * DIRECTION).extend(1.0)],
            [0.0, 1.0],
        )];
        let crossed = self.crossed(&ray);
        candidates
            .into_iter()
            .filter(|at| {
                let toggles = |face: &&usize| {
                    let halves = [2 * **face, 2 * **face + 1];
                    halves
                        .iter()
                        .filter(|half| outer[*at].halves.binary_search(half).is_ok())
                        .count()
                        == 1
                };
                crossed.iter().filter(toggles).count() % 2 == 1
            })
            .min_by(|a, b| outer[*a].volume.total_cmp(&outer[*b].volume))
    }

    /// The faces that a line passes through.
    fn crossed(&self, line: &[Segment]) -> Vec<usize> {
        let clip: Bounds = self.geometry.regions.domain.grown(self.tolerances.same);
        let mut crossed = Vec::new();
        for (sheet, own) in self.geometry.regions.sheets.iter().enumerate() {
            for root in Piercing::new(line, own, self.tolerances, clip, &|_| true)
                .run()
                .roots
            {
                let on = |face: &Face| face.sheet == sheet && face_holds(face, root.at);
                crossed.extend(self.faces.iter().position(on));
            }
        }
        crossed
    }
}

/// Whether a place of its sheet lies on a face.
fn face_holds(face: &Face, at: DVec2) -> bool {
    let within = face
        .polygons
        .iter()
        .filter(|polygon| encloses(polygon, at))
        .count();
    within % 2 == 1
}
