//! Where two sheets may cross: halving patches until boxes, slabs and cones of normals decide.
//!
//! Where a parameter grows along all chords of two patches they cross in simple arcs, one behind the other; so one place on an arc is
//! enough where it is alone ([`Chords`]). Else the halves are asked: an attempt to land on a curve that fails says nothing, the
//! arc may be far from where it is looked for. What is neither apart nor known when it is small is counted: a curve that is missed
//! lies in such patches alone.

use glam::DVec3;

use super::alone::{self, BORDER, Chords, Frame};
use super::bounds::Bounds;
use super::facet::Facet;
use super::hermite::{Branch, End, Node};
use super::known::Known;
use super::linear::{self, Guess};
use super::pair::{Closing, PARALLEL, Pair, lies};
use super::patch::Patch;
use super::sheet::{NodeKind, Sheet};

/// Patches are halved down to this fraction of the domain's size.
const LEAST: f64 = 2e-7;
/// How far small patches beside a pole may be from a curve that passes there, as a fraction of the domain's size.
const NEAR: f64 = 2e-5;
/// Most halvings of one pair of sheets: beyond, they run along each other.
const MOST: usize = 400_000;
/// Undecided places of one pair of sheets after which no more are looked for: nothing is made of them anyway.
const ENOUGH: usize = 64;
/// Sheets that cross at more than this sine do not touch nearby.
const STEEP: f64 = 0.1;
/// Normals that lean less than this sine are flat enough for one attempt to land …
const FLAT: f64 = 0.35;
/// … and if less than this they may tell that a known curve is alone.
const BENT: f64 = 0.7;
/// A place this fraction of the patches' size beside them is on them.
const BESIDE: f64 = 0.02;
/// By this fraction of a patch's size another one beside it is looked at, too, where a curve runs along their border …
const STRIP: f64 = 0.25;
/// … if normals lean less than this sine.
const STRAIGHT: f64 = 0.05;
/// An attempt to land is given up when it leaves the patches by this fraction of their size.
const REACH: f64 = 0.5;
/// While patches are halved their sizes are kept within this factor.
const RATIO: f64 = 4.0;

/// Looks for places where two sheets cross, and hands each to `found`, which returns the branch through it.
pub(super) struct Search<'a, F> {
    pub(super) pair: Pair<'a>,
    /// What is halved: the sheets, or splines of them lifted.
    shapes: [&'a Sheet; 2],
    /// Beyond this box nothing is wanted.
    clip: Bounds,
    /// Where these may be: lifted, they are elsewhere than in the box.
    around: Bounds,
    /// Sheets nearer than curves are computed to are not apart: they touch.
    slack: f64,
    known: Vec<Known>,
    pub(super) found: F,
    /// Whether both regions may matter at a place; elsewhere sheets may come as near as they like.
    matters: &'a dyn Fn(DVec3) -> bool,
    /// Whether the sheets are known not to meet at or near equal parameters.
    pub(super) twins: bool,
    /// Places where the sheets come too near each other to decide.
    pub(super) undecided: usize,
    /// Pairs of patches with a curve that is alone there.
    pub(super) certain: usize,
    /// Smallest pairs of patches where a curve may be missed.
    pub(super) uncertain: usize,
    halvings: usize,
}

/// A common point of two sheets.
#[derive(Clone, Copy)]
enum Place {
    /// On a branch, at a parameter of it.
    On(usize, f64),
    /// On none that is known.
    New(Node),
}

/// What is known of two patches.
enum Verdict {
    /// They have nothing in common.
    Apart,
    /// All that they have in common.
    Known,
    /// They may have more in common than a curve that was found, or something where none was.
    Doubtful,
    /// Curves in them may be loops, or lie side by side.
    Open,
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
            known: branches.into_iter().map(Known::new).collect(),
            found,
            matters,
            twins: false,
            undecided: 0,
            certain: 0,
            uncertain: 0,
            halvings: 0,
        }
    }

    /// All curves that are known.
    pub(super) fn branches(self) -> Vec<Branch> {
        self.known.into_iter().map(|known| known.branch).collect()
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

    fn patches(&mut self, a: &Facet, b: &Facet) {
        self.halvings += 1;
        if self.halvings > MOST || self.undecided + self.uncertain >= ENOUGH || self.is_outside(a) {
            return;
        }
        let (size_a, size_b) = (a.patch.bounds.extent(), b.patch.bounds.extent());
        let around = self.around;
        let least = LEAST * self.pair.tolerances.scale;
        let is_small = size_a < least && size_b < least;
        let is_flat = a.lean() < FLAT && b.lean() < FLAT;
        let is_bent = a.lean() >= BENT || b.lean() >= BENT;
        if is_flat || !is_bent && !is_small {
            match self.flat(a, b, is_small) {
                Verdict::Apart | Verdict::Known => return,
                Verdict::Doubtful if is_flat && self.runs_along(a, b, is_small) => {
                    self.certain += 1;
                    return;
                }
                Verdict::Doubtful if is_small => {
                    if self.is_beside_an_end(a, b) {
                        self.certain += 1;
                    } else {
                        self.doubt(a);
                    }
                    return;
                }
                Verdict::Doubtful | Verdict::Open => {}
            }
        }
        let near = 0.5 * NEAR * self.pair.tolerances.scale;
        // Beside a pole directions say nothing; a curve that is known, and no contact, is all that there is room for.
        if !is_flat && size_a < near && size_b < near && self.passes_by(a, b) {
            self.certain += 1;
            return;
        }
        if is_small {
            let guess = linear::guess(a, b, BESIDE);
            let place = self.locate(a, b, &guess, BESIDE);
            let is_near = place.and_then(|place| self.follow(place)).is_some();
            if is_near {
                self.doubt(a);
            } else {
                self.undecided += usize::from(self.counts(a));
            }
            return;
        }
        let unlike = size_a > RATIO * size_b || size_b > RATIO * size_a;
        let too_small = size_a < least || size_b < least;
        let first = if unlike || too_small || is_flat {
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

    /// What is known of two patches that are not bent by much.
    fn flat(&mut self, a: &Facet, b: &Facet, is_small: bool) -> Verdict {
        // A curve that passes beside the smallest patches passes through what is around them.
        let beside = if is_small { BESIDE } else { BORDER };
        let guess = linear::guess(a, b, BESIDE);
        if let Guess::Apart(along) = guess {
            // Where boxes and slabs overlap they may still be apart another way.
            let [own, others] = [a, b].map(|facet| facet.patch.range_along(along));
            let slack = self.slack * along.length();
            if own[0] > others[1] + slack || others[0] > own[1] + slack {
                return Verdict::Apart;
            }
        }
        let by_cones = Chords::new(a, b, beside);
        let frame = match by_cones {
            Some(_) => None,
            None => Frame::of(a, b),
        };
        if by_cones.is_none() && frame.is_none() {
            return Verdict::Open;
        }
        let may_land = a.lean() < FLAT && b.lean() < FLAT;
        let place = match guess {
            Guess::Meet(..) if may_land => self.locate(a, b, &guess, BESIDE),
            Guess::Meet(..) => self.passing(a, b, BESIDE),
            _ => None,
        };
        // Bent ones are halved anyway, unless a known curve is seen to be alone there.
        if !may_land && place.is_none() {
            return Verdict::Open;
        }
        let by_slopes = || Chords::of_slopes(frame.as_ref()?, a, b, beside);
        let Some(place) = place else {
            // The halves of others are asked in any case.
            let may_touch = is_small && by_cones.is_none() && by_slopes().is_none();
            return if may_touch {
                Verdict::Open
            } else {
                Verdict::Doubtful
            };
        };
        let Some(chords) = by_cones.or_else(by_slopes) else {
            return Verdict::Open;
        };
        let lengths = std::array::from_fn(|k| self.pair.sheets[k / 2].length(k % 2));
        match self.follow(place) {
            Some((branch, t)) if chords.has_only(&self.known[branch].branch, t, lengths) => {
                self.certain += 1;
                Verdict::Known
            }
            _ => Verdict::Doubtful,
        }
    }

    /// Whether a curve along a border of one of two patches, on either side of it, is all that the two have in common: with a
    /// strip of the sheet behind that border it never leaves through it. Around the smallest patches it may pass beside their corners.
    fn runs_along(&self, a: &Facet, b: &Facet, is_small: bool) -> bool {
        if !(a.lean() < STRAIGHT && b.lean() < STRAIGHT) {
            return false;
        }
        let place = self
            .passing(a, b, STRIP)
            .or_else(|| self.land(a, b, &linear::guess(a, b, STRIP), STRIP));
        // What is not known yet is found in the halves.
        let Some(Place::On(branch, t)) = place else {
            return false;
        };
        let ranges = [a.patch.u, a.patch.v, b.patch.u, b.patch.v];
        let q = self.known[branch].branch.value(t);
        (0..4).any(|k| {
            let [low, high] = ranges[k];
            let reach = STRIP * (high - low);
            [(low, -reach), (high, reach)]
                .into_iter()
                .any(|(border, reach)| {
                    (q[3 + k] - border).abs() <= reach.abs()
                        && self.is_alone_beyond(
                            [a, b],
                            (k, [border, border + reach]),
                            (branch, t),
                            if is_small { STRIP } else { BORDER },
                        )
                })
        })
    }

    /// Whether a curve is alone on two patches and on a strip of a sheet behind a border, where one of the parameters ends.
    fn is_alone_beyond(
        &self,
        facets: [&Facet; 2],
        (parameter, [border, end]): (usize, [f64; 2]),
        (branch, t): (usize, f64),
        slack: f64,
    ) -> bool {
        let (side, axis) = (parameter / 2, parameter % 2);
        let own = &facets[side].patch;
        let mut middle = own.middle();
        middle[axis] = 0.5 * (border + end);
        let beside = self.shapes[side].patch_at(middle[0], middle[1]);
        let mut ranges = [own.u, own.v];
        let whole = [beside.u, beside.v][axis];
        let end = end.clamp(whole[0], whole[1]);
        ranges[axis] = [border.min(end), border.max(end)];
        // The next patch begins at the border, or this one is a part of it; behind the sheet's own border there is none.
        if !(whole[0] <= ranges[axis][0]
            && ranges[axis][1] <= whole[1]
            && ranges[axis][0] < ranges[axis][1])
        {
            return false;
        }
        let mut polynomials = [[0.0; 2]; 4];
        for (k, facet) in facets.into_iter().enumerate() {
            let [u, v] = facet.patch.middle();
            let whole = self.shapes[k].patch_at(u, v);
            (polynomials[2 * k], polynomials[2 * k + 1]) = (whole.u, whole.v);
        }
        // The strip costs most: only where the curve passes, and where without it there is such a parameter. With it there hardly ever is one
        // if without it there is none; a certificate that is not found for that is found in the halves.
        let reach = alone::reach(facets, (parameter, end), slack, polynomials);
        let q = alone::parameters(&self.known[branch].branch, t);
        let mut cones = facets.map(|facet| *facet.cones());
        if !alone::hold(&reach, &q) || Chords::going_on(cones, slack, reach).is_none() {
            return false;
        }
        let strip = beside.part(ranges[0], ranges[1]);
        cones[side] = own.cones_with(&strip);
        let lengths = std::array::from_fn(|k| self.pair.sheets[k / 2].length(k % 2));
        Chords::going_on(cones, slack, reach)
            .is_some_and(|chords| chords.has_only(&self.known[branch].branch, t, lengths))
    }

    /// Whether a known curve ends on a border so near to two of the smallest patches that these are not apart yet. Where some
    /// parameter grows along all chords there is no room for another one.
    fn is_beside_an_end(&self, a: &Facet, b: &Facet) -> bool {
        if Chords::new(a, b, BESIDE).is_none() {
            return false;
        }
        let [u, v] = a.patch.middle();
        let point = a.patch.point(u, v);
        let size = a.patch.bounds.extent() + b.patch.bounds.extent();
        let most = NEAR * self.pair.tolerances.scale;
        let is_near = |branch: &Branch, which: usize| {
            let end = branch.end(which);
            let is_root = matches!(branch.ends[which], End::AtRoot(_));
            // A border that the curve leaves at a small angle stays as near to the other sheet for as long.
            let reach = || (6.0 * self.slack / (end.sine * self.leaving(end))).min(most);
            is_root && end.point().distance(point) < size + reach()
        };
        let mut branches = self.known.iter().map(|known| &known.branch);
        branches.any(|branch| is_near(branch, 0) || is_near(branch, 1))
    }

    /// The smallest sine of the angle between a curve and a border on which it ends.
    fn leaving(&self, end: &Node) -> f64 {
        let q = end.parameters();
        let across = (0..4).filter_map(|k| {
            let (sheet, axis) = (self.pair.sheets[k / 2], k % 2);
            let left = (q[k] - sheet.low(axis)).min(sheet.high(axis) - q[k]);
            if left > BORDER * sheet.length(axis) {
                return None;
            }
            let (_, u, v) = sheet.first_jet(q[k - axis], q[k - axis + 1]);
            let (own, along) = if axis == 0 { (u, v) } else { (v, u) };
            Some(end.first[3 + k].abs() * own.cross(along.normalize_or_zero()).length())
        });
        across.fold(1.0, f64::min)
    }

    /// Counts a pair of the smallest patches of which not all is known.
    fn doubt(&mut self, a: &Facet) {
        self.uncertain += usize::from(self.counts(a));
    }

    /// Whether it matters what the sheets do at one of the smallest patches of the first.
    fn counts(&self, a: &Facet) -> bool {
        let [u, v] = a.patch.middle();
        // Where the sheet is: what is halved may be lifted.
        (self.matters)(self.pair.sheets[0].point(u, v))
    }

    /// Whether a part of the first sheet that was lifted into the box is not there itself.
    fn is_outside(&self, a: &Facet) -> bool {
        if self.pair.lifted.is_none() || a.lean() >= STRAIGHT {
            return false;
        }
        let [u, v] = [a.patch.u, a.patch.v];
        let corners = [[u[0], v[0]], [u[0], v[1]], [u[1], v[0]], [u[1], v[1]]];
        let own = Bounds::of(corners.map(|[u, v]| self.pair.sheets[0].point(u, v)));
        // It is nearly flat, and so is what was lifted.
        let bulge = own.extent().max(a.patch.bounds.extent());
        !own.grown(bulge).meets(&self.clip)
    }

    /// A place on the curve between two patches, where one is found: on a known one, or on a new one.
    fn locate(&self, a: &Facet, b: &Facet, guess: &Guess, beside: f64) -> Option<Place> {
        self.passing(a, b, beside)
            .or_else(|| self.land(a, b, guess, beside))
    }

    /// The place to which Newton's method leads from a guess.
    fn land(&self, a: &Facet, b: &Facet, guess: &Guess, beside: f64) -> Option<Place> {
        let Guess::Meet(mut q, tangent, point) = *guess else {
            return None;
        };
        let rectangles = [a.patch.u, a.patch.v, b.patch.u, b.patch.v];
        let grown = |by: f64| rectangles.map(|[low, high]| grow(low, high, by));
        let closing = Closing::Plane(tangent, point);
        let landed =
            self.pair.newton_within(&mut q, closing, 10, &grown(REACH)) && lies(&q, &grown(beside));
        if !landed {
            return None;
        }
        let [a, b] = self.pair.sheets;
        if !a.holds(q[0], q[1]) || !b.holds(q[2], q[3]) {
            return None;
        }
        let node = self.pair.node(q, None)?;
        Some(self.traced(&node).unwrap_or(Place::New(node)))
    }

    /// A node of a known curve on two patches, or else a little beside them.
    fn passing(&self, a: &Facet, b: &Facet, beside: f64) -> Option<Place> {
        let rectangles = [a.patch.u, a.patch.v, b.patch.u, b.patch.v];
        let within = rectangles.map(|[low, high]| grow(low, high, beside));
        let mut near = None;
        for (at, known) in self.known.iter().enumerate() {
            for (node, length) in known.nodes_near(&within) {
                let q = known.branch.nodes[node].parameters();
                if lies(&q, &rectangles) {
                    return Some(Place::On(at, length));
                }
                if near.is_none() && lies(&q, &within) {
                    near = Some(Place::On(at, length));
                }
            }
        }
        near
    }

    /// The branch through a place and the place's parameter on it; `None` if it cannot be followed.
    fn follow(&mut self, place: Place) -> Option<(usize, f64)> {
        let node = match place {
            Place::On(branch, t) => return Some((branch, t)),
            Place::New(node) => node,
        };
        let Some(branch) = (self.found)(node) else {
            self.undecided += usize::from((self.matters)(node.point()));
            return None;
        };
        let t = branch.project(node.point()).0;
        self.known.push(Known::new(branch));
        Some((self.known.len() - 1, t))
    }

    /// Whether two of the smallest patches are only near a known curve that is no contact: beside a pole, parameters
    /// tell little about where a place is.
    fn passes_by(&self, a: &Facet, b: &Facet) -> bool {
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
        let near = NEAR * self.pair.tolerances.scale;
        landed.is_some_and(|at| {
            at.sine > STEEP
                && at.point().distance(node.point()) < near
                && self.traced(&at).is_some()
        })
    }

    /// The known branch that passes through a point.
    fn traced(&self, node: &Node) -> Option<Place> {
        let near = (6.0 * self.pair.tolerances.curve / node.sine.max(PARALLEL))
            .max(1e2 * self.pair.tolerances.curve);
        let passes = |(at, known): (usize, &Known)| {
            let t = known.nearest(node.point(), near)?;
            Some(Place::On(at, t))
        };
        self.known.iter().enumerate().find_map(passes)
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
