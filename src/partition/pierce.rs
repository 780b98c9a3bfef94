//! Where a curve passes through a sheet.

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use smallvec::SmallVec;

use super::bounds::Bounds;
use super::cone::cone;
use super::facet::Facet;
use super::pair::Tolerances;
use super::patch::{Patch, place};
use super::sheet::{NodeKind, Sheet};
use super::solve::solve;

/// A curve's Bézier piece.
#[derive(Clone, Debug)]
pub(super) struct Segment {
    /// Homogeneous control points.
    points: SmallVec<[DVec4; 8]>,
    /// Whether any weight is not 1.
    rational: bool,
    /// Its part of the curve's parameters.
    pub(super) t: [f64; 2],
    bounds: Bounds,
    /// How much larger its box is than it.
    slack: f64,
}

/// A place where a curve passes through a sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    /// On the curve.
    pub(super) t: f64,
    /// On the sheet.
    pub(super) at: DVec2,
    pub(super) point: DVec3,
}

/// Pieces that bend less than this sine are straight enough for one attempt.
const STRAIGHT: f64 = 0.35;
/// While segments and patches are halved, their sizes are kept within this factor.
const RATIO: f64 = 4.0;
/// Halving ends at this fraction of the domain's size.
const LEAST: f64 = 1e-7;
/// Most halvings of one curve with one sheet.
const MOST: usize = 100_000;
/// Undecided places after which no more are looked for: nothing is made of them anyway.
const ENOUGH: usize = 64;

/// Whether a range of a curve's parameters meets some stretches of it.
pub(super) fn meets([from, to]: [f64; 2], stretches: &[[f64; 2]]) -> bool {
    let meets = |stretch: &[f64; 2]| from <= stretch[1] && stretch[0] <= to;
    stretches.iter().any(meets)
}

/// Segments by number.
type Few = SmallVec<[usize; 16]>;

impl Segment {
    pub(super) fn new(points: impl IntoIterator<Item = DVec4>, t: [f64; 2]) -> Self {
        let points: SmallVec<[DVec4; 8]> = points.into_iter().collect();
        let rational = points.iter().any(|h| h.w != 1.0);
        Self::with(points, rational, t)
    }

    fn with(points: SmallVec<[DVec4; 8]>, rational: bool, t: [f64; 2]) -> Self {
        Self {
            bounds: Bounds::of(points.iter().map(|h| place(h, rational))),
            points,
            rational,
            t,
            slack: 0.0,
        }
    }

    /// Whether neither boxes nor the direction in which a patch is thin keep them apart.
    fn may_pass(&self, patch: &Patch) -> bool {
        if !self.bounds.meets(&patch.bounds) {
            return false;
        }
        let (thin, slab) = patch.slab();
        let range = self.range_along(thin);
        slab[0] <= range[1] && range[0] <= slab[1]
    }

    /// The same, with a box that is larger on all sides: what it only touches counts as met.
    pub(super) fn with_slack(mut self, slack: f64) -> Self {
        self.slack = slack;
        self.bounds = self.bounds.grown(slack);
        self
    }

    fn places(&self) -> impl Iterator<Item = DVec3> + Clone {
        self.points.iter().map(|h| place(h, self.rational))
    }

    /// Point and derivative by t.
    pub(super) fn evaluate(&self, t: f64) -> (DVec3, DVec3) {
        let length = self.t[1] - self.t[0];
        let s = (t - self.t[0]) / length;
        let mut work: SmallVec<[DVec4; 8]> = SmallVec::from_slice(&self.points);
        let degree = work.len() - 1;
        for round in 1..degree {
            for k in 0..=degree - round {
                work[k] = (1.0 - s) * work[k] + s * work[k + 1];
            }
        }
        let h = (1.0 - s) * work[0] + s * work[1];
        let d = (degree as f64 / length) * (work[1] - work[0]);
        let p = h.xyz() / h.w;
        (p, (d.xyz() - d.w * p) / h.w)
    }

    pub(super) fn halves(&self) -> [Self; 2] {
        let degree = self.points.len() - 1;
        let [mut low, mut high] = [0, 1].map(|_| SmallVec::from_slice(&self.points));
        for round in 1..=degree {
            for k in 0..=degree - round {
                high[k] = 0.5 * (high[k] + high[k + 1]);
            }
            low[round] = high[0];
        }
        let middle = 0.5 * (self.t[0] + self.t[1]);
        [
            Self::with(low, self.rational, [self.t[0], middle]).with_slack(self.slack),
            Self::with(high, self.rational, [middle, self.t[1]]).with_slack(self.slack),
        ]
    }

    /// Bounds of the derivative of x (0) or y (1) by t, of a piece without weights.
    pub(super) fn rates(&self, axis: usize) -> [f64; 2] {
        let rate = (self.points.len() - 1) as f64 / (self.t[1] - self.t[0]);
        let legs = self
            .points
            .windows(2)
            .map(|legs| rate * (legs[1][axis] - legs[0][axis]));
        legs.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
    }

    fn tangents(&self) -> Option<(DVec3, f64)> {
        let places = self.places().zip(self.places().skip(1));
        cone(places.map(|(a, b)| b - a))
    }

    fn range_along(&self, direction: DVec3) -> [f64; 2] {
        self.places()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
                let d = p.dot(direction);
                [low.min(d), high.max(d)]
            })
    }

    pub(super) fn bounds(&self) -> &Bounds {
        &self.bounds
    }
}

/// All places where the segments pass through a sheet, within a box, by parameter.
pub(super) struct Piercing<'a> {
    sheet: &'a Sheet,
    tolerances: Tolerances,
    clip: Bounds,
    segments: &'a [Segment],
    segment: usize,
    /// Whether it matters where the curve passes at a place; elsewhere it may graze the sheet.
    matters: &'a dyn Fn(DVec3) -> bool,
    pub(super) roots: Vec<Root>,
    /// Places that halving did not decide: the curve grazes the sheet, or runs along it.
    pub(super) undecided: usize,
    halvings: usize,
}

impl<'a> Piercing<'a> {
    pub(super) fn new(
        segments: &'a [Segment],
        sheet: &'a Sheet,
        tolerances: Tolerances,
        clip: Bounds,
        matters: &'a dyn Fn(DVec3) -> bool,
    ) -> Self {
        Self {
            matters,
            sheet,
            tolerances,
            clip,
            segments,
            segment: 0,
            roots: Vec::new(),
            undecided: 0,
            halvings: 0,
        }
    }

    pub(super) fn run(self) -> Self {
        self.within(&[[f64::NEG_INFINITY, f64::INFINITY]])
    }

    /// Only on some stretches of the curve.
    pub(super) fn within(mut self, stretches: &[[f64; 2]]) -> Self {
        let near = *self.sheet.bounds();
        let near: Vec<usize> = (0..self.segments.len())
            .filter(|at| {
                let segment = &self.segments[*at];
                meets(segment.t, stretches)
                    && segment.bounds.meets(&near)
                    && segment.bounds.meets(&self.clip)
            })
            .collect();
        self.nodes(self.sheet.root(), &near);
        self.roots.retain(|root| meets([root.t; 2], stretches));
        self.roots.sort_by(|a, b| a.t.total_cmp(&b.t));
        self
    }

    fn nodes(&mut self, at: usize, near: &[usize]) {
        let node = self.sheet.node(at);
        if !node.bounds.meets(&self.clip) {
            return;
        }
        let segments = self.segments;
        let meets = |at: &usize| node.bounds.meets(&segments[*at].bounds);
        let near: Few = near.iter().copied().filter(meets).collect();
        match node.kind {
            _ if near.is_empty() => {}
            NodeKind::Leaf(patch) => {
                self.patches(&self.sheet.facet(patch), &near);
            }
            NodeKind::Pair(a, b) => {
                self.nodes(a, &near);
                self.nodes(b, &near);
            }
        }
    }

    /// Halves a patch once for all segments that are much smaller.
    fn patches(&mut self, facet: &Facet, near: &[usize]) {
        let segments = self.segments;
        let may_pass = |at: &usize| segments[*at].may_pass(&facet.patch);
        let near: Few = near.iter().copied().filter(may_pass).collect();
        let size = |at: &usize| segments[*at].bounds.extent();
        let longest = near.iter().map(size).fold(0.0, f64::max);
        if near.len() > 1 && facet.patch.bounds.extent() > RATIO * longest {
            facet.halve(
                |bounds| near.iter().any(|at| segments[*at].bounds.meets(bounds)),
                |_| true,
                |half| self.patches(half, &near),
            );
        } else {
            for at in near {
                self.segment = at;
                self.pieces(&segments[at], facet);
            }
        }
    }

    fn pieces(&mut self, segment: &Segment, facet: &Facet) {
        if self.undecided >= ENOUGH {
            return;
        }
        self.halvings += 1;
        if self.halvings > MOST {
            self.undecided += 1;
            return;
        }
        let patch = &facet.patch;
        let tangents = segment.tangents();
        let (normals, lean) = (facet.cones().normals, facet.lean());
        let bend = tangents.map_or(f64::INFINITY, |t| t.1);
        if let (Some((along, bend)), Some((normal, lean))) = (tangents, normals)
            && bend < STRAIGHT
            && lean < STRAIGHT
            // No tangent lies in any tangent plane: at most one root.
            && along.dot(normal).abs() > bend + lean
        {
            self.land(segment, patch);
            return;
        }
        let least = LEAST * self.tolerances.scale;
        let (size_s, size_p) = (segment.bounds.extent(), patch.bounds.extent());
        if size_s < least && size_p < least {
            if !self.land(segment, patch) {
                let [u, v] = patch.middle();
                self.undecided += usize::from((self.matters)(patch.point(u, v)));
            }
            return;
        }
        // Whatever is longer, or bends more when both are small enough to compare.
        let unlike = size_s > RATIO * size_p || size_p > RATIO * size_s;
        let halve_segment = if unlike || (bend < STRAIGHT && lean < STRAIGHT) {
            size_s > size_p
        } else {
            bend > lean
        };
        if halve_segment && size_s >= least || size_p < least {
            for half in segment.halves() {
                if half.may_pass(patch) && half.bounds.meets(&self.clip) {
                    self.pieces(&half, facet);
                }
            }
        } else {
            facet.halve(
                |bounds| bounds.meets(&segment.bounds),
                |half| segment.may_pass(half),
                |half| self.pieces(segment, half),
            );
        }
    }

    /// Newton's method from the middle of both. Whether it found a root, new or known.
    fn land(&mut self, segment: &Segment, patch: &Patch) -> bool {
        let whole = &self.segments[self.segment];
        let [mut u, mut v] = patch.middle();
        let mut t = 0.5 * (segment.t[0] + segment.t[1]);
        let mut converged = false;
        for _ in 0..20 {
            let (c, dc) = whole.evaluate(t);
            let (p, pu, pv) = self.sheet.first_jet(u, v);
            let gap = c - p;
            let matrix = [
                [dc.x, -pu.x, -pv.x],
                [dc.y, -pu.y, -pv.y],
                [dc.z, -pu.z, -pv.z],
            ];
            let Some(step) = solve(matrix, [-gap.x, -gap.y, -gap.z]) else {
                return false;
            };
            t += step[0];
            u += step[1];
            v += step[2];
            let length = self.sheet.length(0).max(self.sheet.length(1));
            if !(u.is_finite() && v.is_finite() && (u - patch.u[0]).abs() < 2.0 * length) {
                return false;
            }
            let moved = (dc * step[0]).length();
            if gap.abs().element_sum() < self.tolerances.residual && moved < self.tolerances.step {
                converged = true;
                break;
            }
        }
        if !converged {
            return false;
        }
        // A root beside the patch belongs to its neighbour, which finds it too.
        let slack = |[low, high]: [f64; 2]| 1e-9 * (high - low);
        let within = |value: f64, range: [f64; 2]| {
            range[0] - slack(range) <= value && value <= range[1] + slack(range)
        };
        if !within(t, segment.t) || !within(u, patch.u) || !within(v, patch.v) {
            return false;
        }
        let point = self.sheet.point(u, v);
        if !self.clip.holds(point) {
            return true;
        }
        let at = DVec2::new(u, v);
        let root = Root { t, at, point };
        let same = |other: &Root| other.point.distance(root.point) < self.tolerances.same;
        if !self.roots.iter().any(same) {
            self.roots.push(root);
        }
        true
    }
}
