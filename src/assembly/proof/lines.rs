//! One solid per point: along lines through the finished topology solids follow each other, and each is what the point
//! evaluator finds there.
//!
//! The topology is located as a [`Scene`], from its tables. Along a *thorough* line the boundaries of all bodies, whole and
//! untrimmed, are found as well: between two of them the owner cannot change, so its middle speaks for all of a stretch,
//! however thin, and nothing that the line meets can hide. Such lines are
//!
//! - columns, one in each cell of a grid over the plan;
//! - through patches of every body's surfaces, so that a small body is met;
//! - columns where the difference of a surface and a horizon has an extremum ([`super::extrema`]): a closed curve in which they
//!   cross has one inside.
//!
//! Through every face go two shorter lines, roughly across it; there only what lies next to the face is asked for. Two points on either
//! side, one of them near, never farther than the bed beside the face is thick.

mod aims;

use rayon::prelude::*;

use self::aims::{Aim, TRIES, across};
use super::scene::{Broken, Scene, Stretch, stretches};
use super::tree::Tree;
use super::{Check, ProofError, Prover};
use crate::nurbs::pierce::{Line, Target};
use crate::nurbs::{Surface, SurfaceError};

/// Lines through each face …
const OF_FACE: usize = 2;
/// … or as many of all.
const OF_FACES: usize = 250;
/// How far lines through faces go each way, as a share of the domain's size along them.
const BESIDE: f64 = 0.1;
/// One face of so many may be without a clear line.
const UNSEEN: usize = 4;
/// The least width of faces that must have a clear line, in distances that lines must be clear of edges.
const THIN: f64 = 20.0;

/// The surfaces of all bodies and of the domain's own base and top, whole.
struct Bodies<'a> {
    targets: Vec<Target<'a>>,
    tree: Tree<(usize, usize)>,
}

impl<'a> Bodies<'a> {
    fn new(surfaces: &'a [Surface]) -> Self {
        let targets: Vec<Target<'a>> = surfaces.par_iter().map(Target::new).collect();
        let items = targets.iter().enumerate().flat_map(|(index, target)| {
            let patches = target.patches().enumerate();
            patches.map(move |(patch, (bounds, _))| (bounds, (index, patch)))
        });
        Self {
            tree: Tree::new(items.collect()),
            targets,
        }
    }

    /// Where a line may pass through the boundary of a body (m along it), in no order.
    fn along(&self, line: Line, near: f64) -> Vec<f64> {
        let mut found = Vec::new();
        self.tree.along(line, near, |&(target, patch)| {
            // What the line grazes is passed by: it adds nothing that must be known.
            self.targets[target].pass(patch, line, near, &mut found);
            true
        });
        found
            .iter()
            .map(|passage| passage.point[line.axis])
            .collect()
    }
}

/// What a line was drawn for.
#[derive(Clone, Copy, Debug)]
enum Purpose {
    /// Everything along it.
    All,
    /// What lies beside a face.
    Face(usize),
}

/// What lines have found.
#[derive(Default)]
struct Findings {
    lines: usize,
    redrawn: usize,
    points: usize,
    /// Places where solids do not follow each other.
    broken: Vec<String>,
    /// Points that belong elsewhere.
    wrong: Vec<String>,
    /// Faces without a clear line.
    unseen: Vec<String>,
}

impl Findings {
    fn and(mut self, other: Self) -> Self {
        self.lines += other.lines;
        self.redrawn += other.redrawn;
        self.points += other.points;
        self.broken.extend(other.broken);
        self.wrong.extend(other.wrong);
        self.unseen.extend(other.unseen);
        self
    }
}

/// Some words of many.
fn some(words: &[String]) -> String {
    words.iter().take(5).cloned().collect::<Vec<_>>().join(", ")
}

impl Prover<'_> {
    /// Follows lines through finished topology.
    pub(super) fn lines(&self, scene: &Scene<'_>) -> Result<Vec<Check>, ProofError> {
        let surfaces = self
            .surfaces()
            .map_err(|error| ProofError::Kernel(error.to_string()))?;
        let bodies = Bodies::new(&surfaces);
        let lines = self.thorough_lines(&surfaces);
        let thorough = lines
            .par_iter()
            .map(|aim| self.first_clear(scene, &bodies, aim))
            .reduce(Findings::default, Findings::and);
        let faces = 0..scene.topology.faces.len();
        let each = OF_FACES.div_ceil(faces.len().max(1)).max(OF_FACE);
        let of_faces = faces
            .into_par_iter()
            .map(|face| self.through_face(scene, &bodies, face, each))
            .reduce(Findings::default, Findings::and);
        let all = thorough.and(of_faces);
        let count = format!(
            "{} lines, {} drawn again for an edge or a fold nearby",
            all.lines, all.redrawn
        );
        let check = |name: &'static str, count: String, wrong: &[String]| Check {
            name,
            measured: wrong.len() as f64,
            bound: 0.0,
            detail: if wrong.is_empty() {
                count
            } else {
                format!("{count}: {}", some(wrong))
            },
        };
        Ok(vec![
            check(
                "lines along which solids do not follow each other",
                count,
                &all.broken,
            ),
            check(
                "points along lines that belong to another volume than their solid",
                format!("{} points", all.points),
                &all.wrong,
            ),
            Check {
                // Faces thinner than lines must be clear of edges have none; what is beside them has.
                bound: (scene.topology.faces.len() / UNSEEN) as f64,
                ..check(
                    "faces that no line passes through clearly",
                    format!("{} faces", scene.topology.faces.len()),
                    &all.unseen,
                )
            },
        ])
    }

    /// All surfaces that owners depend on.
    fn surfaces(&self) -> Result<Vec<Surface>, SurfaceError> {
        let mut surfaces = Vec::new();
        for shell in &self.plan.shells {
            surfaces.extend(shell.body.sheets()?.into_iter().map(|sheet| sheet.1));
        }
        for (_, side) in self.plan.bounds() {
            surfaces.extend(side.sheets().iter().cloned());
        }
        Ok(surfaces)
    }

    /// What the first clear line of some finds.
    fn first_clear(&self, scene: &Scene<'_>, bodies: &Bodies<'_>, aim: &Aim<'_>) -> Findings {
        let mut found = Findings::default();
        for line in (0..TRIES).filter_map(|k| aim.line(k)) {
            if self.follow(scene, bodies, line, Purpose::All, &mut found) {
                break;
            }
            found.redrawn += 1;
        }
        found
    }

    /// What lines through a face find.
    fn through_face(
        &self,
        scene: &Scene<'_>,
        bodies: &Bodies<'_>,
        face: usize,
        each: usize,
    ) -> Findings {
        let mut found = Findings::default();
        for (point, normal) in scene.inside(face).take(each + TRIES) {
            if found.lines == each {
                break;
            }
            let mut line = across(point, normal);
            let size = (self.plan.high() - self.plan.low())[line.axis];
            line.range = [-BESIDE, BESIDE].map(|part| point[line.axis] + part * size);
            if !self.follow(scene, bodies, line, Purpose::Face(face), &mut found) {
                found.redrawn += 1;
            }
        }
        // A face that is about as thin as lines must be clear of edges has none.
        if found.lines == 0 && scene.width(face) > THIN * scene.near {
            found.unseen.push(self.face_name(scene, face));
        }
        found
    }

    /// Follows a line; `false` if it is not clear.
    fn follow(
        &self,
        scene: &Scene<'_>,
        bodies: &Bodies<'_>,
        line: Line,
        purpose: Purpose,
        found: &mut Findings,
    ) -> bool {
        let Some(crossings) = scene.along(line) else {
            return false;
        };
        found.lines += 1;
        if let Purpose::Face(face) = purpose
            && !crossings.iter().any(|crossing| crossing.face == face)
        {
            let name = self.face_name(scene, face);
            found.broken.push(format!(
                "a face of {name} is not where its edges are, at {:.4}",
                line.through
            ));
            return true;
        }
        match stretches(scene, line, crossings) {
            Err(broken) => found.broken.push(self.words(scene, line, broken)),
            Ok(stretches) => match purpose {
                Purpose::All => self.ask_all(scene, bodies, line, &stretches, found),
                Purpose::Face(face) => self.ask_beside(scene, line, face, &stretches, found),
            },
        }
        true
    }

    /// Asks for the owner in the middle of each part of a line between all that may change it.
    fn ask_all(
        &self,
        scene: &Scene<'_>,
        bodies: &Bodies<'_>,
        line: Line,
        stretches: &[Stretch],
        found: &mut Findings,
    ) {
        let mut changes = bodies.along(line, scene.near);
        changes.sort_by(f64::total_cmp);
        let (low, high) = (self.plan.low(), self.plan.high());
        let beyond = 0.01 * (high - low)[line.axis];
        for stretch in stretches {
            let from = stretch.range[0].max(low[line.axis] - beyond);
            let to = stretch.range[1].min(high[line.axis] + beyond);
            let first = changes.partition_point(|change| *change <= from);
            let last = changes.partition_point(|change| *change < to);
            let mut start = from;
            let own = changes.get(first..last).unwrap_or_default();
            for end in own.iter().copied().chain([to]) {
                if end - start > 4.0 * self.hidden() {
                    self.ask(scene, line, 0.5 * (start + end), stretch.solid, found);
                }
                start = end;
            }
        }
    }

    /// Asks for the owners beside a face.
    fn ask_beside(
        &self,
        scene: &Scene<'_>,
        line: Line,
        face: usize,
        stretches: &[Stretch],
        found: &mut Findings,
    ) {
        // Every other line from as near as can be; for the others a golden-section sequence over two decades.
        let spread = if found.lines % 2 == 1 {
            0.0
        } else {
            (face as f64 * 0.618_033_988_749_895).fract()
        };
        let reach = (10.0 * self.tolerance()).max(8.0 * self.hidden()) * 100_f64.powf(spread);
        for stretch in stretches {
            let [from, to] = stretch.range;
            for (side, end) in [(1.0, from), (-1.0, to)] {
                let is_beside = stretch.faces[usize::from(side < 0.0)] == Some(face);
                // Where a bed is thinner than owners are told apart nobody can say more.
                if !is_beside || !(to - from > 4.0 * self.hidden()) {
                    continue;
                }
                let near = reach.min(0.25 * (to - from));
                self.ask(scene, line, end + side * near, stretch.solid, found);
                self.ask(scene, line, 0.5 * (from + to), stretch.solid, found);
            }
        }
    }

    /// Compares the owner of a point with the solid that it lies in.
    fn ask(
        &self,
        scene: &Scene<'_>,
        line: Line,
        along: f64,
        solid: Option<usize>,
        found: &mut Findings,
    ) {
        let point = line.at(along);
        found.points += 1;
        let (owner, label) = (self.owners.at(point), scene.label(solid));
        if owner == label {
            return;
        }
        // Levels that are the same for the plan need not be so for the point evaluator.
        let hidden = self.hidden();
        let is_on_boundary = self.plan.extent.is_near_skin(point, hidden)
            || self.owners.near(point, hidden).next().is_some();
        if !is_on_boundary
            || owner.is_some() != label.is_some() && !self.plan.extent.is_near_skin(point, hidden)
        {
            let [owner, label] = [owner, label].map(|one| self.whose(one));
            found
                .wrong
                .push(format!("{owner} at {point:.4}, in a solid of {label}"));
        }
    }

    /// How far boundaries may be from where the point evaluator has them (m): the plan takes levels for the same up to half
    /// of this.
    fn hidden(&self) -> f64 {
        2.0 * self.plan.same_level()
    }

    fn whose(&self, volume: Option<usize>) -> &str {
        volume.map_or("outside", |volume| self.name(volume))
    }

    /// The volumes on both sides of a face.
    fn face_name(&self, scene: &Scene<'_>, face: usize) -> String {
        let [a, b] = scene.sides[face].map(|solid| self.whose(scene.label(solid)));
        let place = scene.inside(face).next();
        let at = place.map_or(String::new(), |(point, _)| format!(" at {point:.4}"));
        format!("{a} / {b}{at}")
    }

    fn words(&self, scene: &Scene<'_>, line: Line, broken: Broken) -> String {
        let [within, leaves] =
            [broken.within, broken.leaves].map(|solid| self.whose(scene.label(solid)));
        let point = line.at(broken.along);
        if within == leaves {
            return format!("from one solid of {within} into another at {point:.4}");
        }
        format!("in a solid of {within}, out of one of {leaves}, at {point:.4}")
    }
}
