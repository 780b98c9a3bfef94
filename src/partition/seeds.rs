//! Where two sheets may cross: halving patches until boxes, slabs and cones of normals decide.
//!
//! A pair of patches whose normals have no direction in common crosses in simple arcs, one behind the other: a loop, or two
//! side by side, would need parallel normals somewhere. So one place on an arc is enough where it is alone ([`Chords`]); else the
//! halves are asked. An attempt to land on it that fails says nothing either: the arc may be far from where it is looked for.

use glam::DVec3;

use super::alone::{BORDER, Chords};
use super::bounds::Bounds;
use super::facet::Facet;
use super::hermite::{Branch, Node};
use super::pair::{Closing, PARALLEL, Pair, Step, lies};
use super::patch::Patch;
use super::sheet::{NodeKind, Sheet};

/// Patches are halved down to this fraction of the domain's size.
const LEAST: f64 = 1e-5;
/// Most halvings of one pair of sheets: beyond, they run along each other.
const MOST: usize = 400_000;
/// Undecided places of one pair of sheets after which no more are looked for: nothing is made of them anyway.
const ENOUGH: usize = 64;
/// Sheets that cross at more than this sine do not touch nearby.
const STEEP: f64 = 0.1;
/// Normals that lean less than this sine are flat enough for one attempt.
const FLAT: f64 = 0.35;
/// A place this fraction of the patches' size beside them is on them.
const BESIDE: f64 = 0.02;
/// An attempt to land is given up when it leaves the patches by this fraction of their size.
const REACH: f64 = 0.5;
/// While patches are halved their sizes are kept within this factor.
const RATIO: f64 = 4.0;

/// Looks for places where two sheets cross, and hands each to `found`, which returns the branch through it.
pub(super) struct Search<'a, F> {
    pub(super) pair: Pair<'a>,
    pub(super) clip: Bounds,
    /// What is halved: the sheets, or splines of them lifted.
    shapes: [&'a Sheet; 2],
    /// Where these may be.
    around: Bounds,
    /// Sheets nearer than curves are computed to are not apart: they touch.
    slack: f64,
    pub(super) branches: Vec<Branch>,
    pub(super) found: F,
    /// Whether both regions may matter at a place; elsewhere sheets may come as near as they like.
    matters: &'a dyn Fn(DVec3) -> bool,
    /// Whether the sheets are known not to meet at or near equal parameters.
    pub(super) twins: bool,
    /// Places where the sheets come too near each other to decide.
    pub(super) undecided: usize,
    /// Pairs of patches with a curve that is alone there.
    pub(super) certain: usize,
    /// Smallest pairs of patches with a curve where another one is not excluded.
    pub(super) uncertain: usize,
    halvings: usize,
}

/// Where an attempt to land has ended.
#[derive(Clone, Copy)]
enum Landing {
    /// On a branch, at a parameter of it.
    On(usize, f64),
    /// On a curve that cannot be followed.
    Lost,
}

impl<'a, F: FnMut(Node) -> Option<Branch>> Search<'a, F> {
    pub(super) fn new(
        pair: Pair<'a>,
        clip: Bounds,
        branches: Vec<Branch>,
        found: F,
        matters: &'a dyn Fn(DVec3) -> bool,
    ) -> Self {
        let lifted = pair.lifted;
        Self {
            shapes: lifted.map_or(pair.sheets, |lifted| lifted.shapes()),
            around: lifted.map_or(clip, |lifted| lifted.around(&clip)),
            slack: pair.tolerances.curve + lifted.map_or(0.0, |lifted| lifted.slack()),
            pair,
            clip,
            branches,
            found,
            matters,
            twins: false,
            undecided: 0,
            certain: 0,
            uncertain: 0,
            halvings: 0,
        }
    }

    pub(super) fn run(&mut self) {
        let [a, b] = self.shapes;
        self.nodes(a.root(), b.root());
    }

    fn nodes(&mut self, i: usize, j: usize) {
        let [a, b] = self.shapes;
        let (x, y) = (a.node(i), b.node(j));
        let apart_by_boxes = !x.bounds.grown(self.slack).meets(&y.bounds);
        if apart_by_boxes || !self.around.meets(&x.bounds) || !self.around.meets(&y.bounds) {
            return;
        }
        match (x.kind, y.kind) {
            (NodeKind::Leaf(p), NodeKind::Leaf(q)) => {
                let (one, other) = (a.patch(p), b.patch(q));
                let beside = self.twins && are_beside(&one, &other);
                if !beside && !apart(&one, &other, self.slack) {
                    self.patches(&a.facet(p), &b.facet(q));
                }
            }
            (NodeKind::Pair(first, second), NodeKind::Leaf(_)) => {
                self.nodes(first, j);
                self.nodes(second, j);
            }
            (NodeKind::Leaf(_), NodeKind::Pair(first, second)) => {
                self.nodes(i, first);
                self.nodes(i, second);
            }
            (NodeKind::Pair(p, q), NodeKind::Pair(r, s)) => {
                if x.bounds.extent() >= y.bounds.extent() {
                    self.nodes(p, j);
                    self.nodes(q, j);
                } else {
                    self.nodes(i, r);
                    self.nodes(i, s);
                }
            }
        }
    }

    fn patches(&mut self, a: &Facet<'_>, b: &Facet<'_>) {
        self.halvings += 1;
        if self.halvings > MOST || self.undecided >= ENOUGH {
            return;
        }
        let (size_a, size_b) = (a.patch.bounds.extent(), b.patch.bounds.extent());
        let (clip, around) = (self.clip, self.around);
        let flat = a.lean() < FLAT && b.lean() < FLAT;
        let least = LEAST * self.pair.tolerances.scale;
        let is_small = size_a < least && size_b < least;
        // Where boxes and slabs overlap they may still be apart along the line of their planes.
        if flat && a.is_past(b, self.slack) {
            return;
        }
        if flat && a.is_askew(b) {
            let landing = self.land(a, b, |_| true);
            // A curve that passes beside the smallest patches passes through what is around them.
            let around = if is_small { BESIDE } else { BORDER };
            let is_done = landing.is_some_and(|landing| self.is_all(a, b, landing, around));
            if is_done {
                self.certain += 1;
                return;
            }
            if is_small {
                let [u, v] = a.patch.middle();
                let counts = landing.is_some() && (self.matters)(a.patch.point(u, v));
                self.uncertain += usize::from(counts);
                return;
            }
        } else {
            if flat && a.leans_from(b) && self.land(a, b, |node| clip.holds(node.point())).is_some()
            {
                return;
            }
            if is_small {
                if self.land(a, b, |_| true).is_none() && !self.passes_by(a, b) {
                    let [u, v] = a.patch.middle();
                    let point = self.pair.sheets[0].point(u, v);
                    self.undecided += usize::from((self.matters)(point));
                }
                return;
            }
        }
        let unlike = size_a > RATIO * size_b || size_b > RATIO * size_a;
        let too_small = size_a < least || size_b < least;
        let first = if unlike || too_small || (a.lean() < FLAT && b.lean() < FLAT) {
            size_a > size_b
        } else {
            a.lean() > b.lean()
        };
        let (halved, other) = if first { (a, b) } else { (b, a) };
        let (slack, twins) = (self.slack, self.twins);
        halved.halve(
            |bounds| bounds.grown(slack).meets(&other.patch.bounds) && around.meets(bounds),
            |half| {
                let beside = twins && are_beside(half, &other.patch);
                !beside && !apart(half, &other.patch, slack)
            },
            |half| {
                if first {
                    self.patches(half, b);
                } else {
                    self.patches(a, half);
                }
            },
        );
    }

    /// Whether the curve that an attempt has landed on is all that two patches have in common.
    fn is_all(&self, a: &Facet<'_>, b: &Facet<'_>, landing: Landing, around: f64) -> bool {
        match landing {
            Landing::Lost => true,
            Landing::On(branch, t) => {
                let branch = &self.branches[branch];
                Chords::new(a, b, around).is_some_and(|chords| chords.has_only(branch, t))
            }
        }
    }

    /// Tries to land on the curve between two patches: on a known one, or on a new one that is wanted.
    fn land(
        &mut self,
        a: &Facet<'_>,
        b: &Facet<'_>,
        wanted: impl Fn(&Node) -> bool,
    ) -> Option<Landing> {
        let rectangles = [a.patch.u, a.patch.v, b.patch.u, b.patch.v];
        let grown = |by: f64| rectangles.map(|[low, high]| grow(low, high, by));
        let within = grown(BESIDE);
        let known = |(at, branch): (usize, &Branch)| {
            let passes = |ranges: &[[f64; 2]; 4]| {
                let inside = |node: &Node| lies(&node.parameters(), ranges);
                branch.nodes.iter().position(inside)
            };
            // Rather a node well inside than one beside.
            let node = passes(&rectangles).or_else(|| passes(&within))?;
            Some(Landing::On(at, branch.lengths[node]))
        };
        if let Some(landing) = self.branches.iter().enumerate().find_map(known) {
            return Some(landing);
        }
        // From the middle of the smaller patch, and the place on the larger one that is nearest to it.
        let a_is_smaller = a.patch.bounds.extent() <= b.patch.bounds.extent();
        let (small, large) = if a_is_smaller { (a, b) } else { (b, a) };
        let [u, v] = small.patch.middle();
        let small = small.patch.first_jet(u, v);
        let [s, t] = nearest(&large.patch, small.0);
        let large = large.patch.first_jet(s, t);
        let normals = [small, large].map(|(_, u, v)| u.cross(v));
        let tangent = normals[0].cross(normals[1]).try_normalize()?;
        let (mut q, jets) = if a_is_smaller {
            ([u, v, s, t], [small, large])
        } else {
            ([s, t, u, v], [large, small])
        };
        let closing = Closing::Plane(tangent, small.0);
        let around = grown(REACH);
        // Most attempts end with the first step, for which both patches are known.
        let step = Step::new(&jets, &q, closing)?;
        step.apply(&mut q);
        let landed = lies(&q, &around)
            && self.pair.newton_within(&mut q, closing, 10, &around)
            && lies(&q, &within);
        if !landed {
            return None;
        }
        let [a, b] = self.pair.sheets;
        if !a.holds(q[0], q[1]) || !b.holds(q[2], q[3]) {
            return None;
        }
        let node = self.pair.node(q, None)?;
        if let Some(landing) = self.traced(&node) {
            return Some(landing);
        }
        if !wanted(&node) {
            return None;
        }
        let Some(branch) = (self.found)(node) else {
            // A point of a curve that cannot be followed.
            self.undecided += usize::from((self.matters)(node.point()));
            return Some(Landing::Lost);
        };
        let t = branch.project(node.point()).0;
        self.branches.push(branch);
        Some(Landing::On(self.branches.len() - 1, t))
    }

    /// Whether two of the smallest patches are only near a known curve that is no contact: beside a pole, parameters
    /// tell little about where a place is.
    fn passes_by(&self, a: &Facet<'_>, b: &Facet<'_>) -> bool {
        let ([u, v], [s, t]) = (a.patch.middle(), b.patch.middle());
        let mut q = [u, v, s, t];
        let Some(node) = self.pair.node(q, None) else {
            return false;
        };
        let closing = Closing::Plane(node.tangent(), node.point());
        let landed = self
            .pair
            .newton(&mut q, closing, 10)
            .then(|| self.pair.node(q, None))
            .flatten();
        let near = 2.0 * LEAST * self.pair.tolerances.scale;
        landed.is_some_and(|at| {
            at.sine > STEEP
                && at.point().distance(node.point()) < near
                && self.traced(&at).is_some()
        })
    }

    /// The known branch that passes through a point.
    fn traced(&self, node: &Node) -> Option<Landing> {
        let near = (6.0 * self.pair.tolerances.curve / node.sine.max(PARALLEL))
            .max(1e2 * self.pair.tolerances.curve);
        let passes = |(at, branch): (usize, &Branch)| {
            let (t, distance) = branch.project(node.point());
            (distance < near).then_some(Landing::On(at, t))
        };
        self.branches.iter().enumerate().find_map(passes)
    }

    /// Whether the search was given up.
    pub(super) fn gave_up(&self) -> bool {
        self.halvings > MOST
    }
}

/// A range with a fraction of its length more at both ends.
fn grow(low: f64, high: f64, by: f64) -> [f64; 2] {
    let slack = by * (high - low);
    [low - slack, high + slack]
}

/// About where a nearly flat patch is nearest to a point.
fn nearest(patch: &Patch, point: DVec3) -> [f64; 2] {
    let [mut u, mut v] = patch.middle();
    for _ in 0..2 {
        let (p, pu, pv) = patch.first_jet(u, v);
        let offset = point - p;
        let (uu, uv, vv) = (pu.dot(pu), pu.dot(pv), pv.dot(pv));
        let determinant = uu * vv - uv * uv;
        if !(determinant > 0.0) {
            break;
        }
        let (ru, rv) = (offset.dot(pu), offset.dot(pv));
        u = (u + (vv * ru - uv * rv) / determinant).clamp(patch.u[0], patch.u[1]);
        v = (v + (uu * rv - uv * ru) / determinant).clamp(patch.v[0], patch.v[1]);
    }
    [u, v]
}

/// Whether the parameters of patches overlap or touch.
fn are_beside(a: &Patch, b: &Patch) -> bool {
    let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
        let slack = 1e-9 * (b - a).max(d - c);
        a <= d + slack && c <= b + slack
    };
    near(a.u, b.u) && near(a.v, b.v)
}

/// Whether a plane along either patch separates both, by more than the slack.
fn apart(a: &Patch, b: &Patch, slack: f64) -> bool {
    a.is_beside(b, slack) || b.is_beside(a, slack)
}
