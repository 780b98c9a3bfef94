//! Where a curve on a height passes through another height over the same plan: roots of the heights' difference along the
//! curve, which is one function of one variable, at any angle between the sheets.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::bounds::Bounds;
use super::heights::Heights;
use super::pair::Tolerances;
use super::pierce::{Root, Segment, meets};

/// Halving ends at this fraction of the domain's size.
const LEAST: f64 = 1e-7;
/// Most halvings of one curve with one sheet, for each of its segments.
const MOST: usize = 4_000;
/// Patches of a sheet that are looked at together.
const TOGETHER: usize = 4;
/// Differences below this many times their rounding tell nothing.
const CERTAIN: f64 = 4.0;
/// Halvings until a root is as exact as numbers are.
const HALVINGS: usize = 60;

/// All places where segments on the first of two heights pass through the second, within a box, by parameter.
pub(super) struct Along<'a> {
    heights: Heights<'a>,
    tolerances: Tolerances,
    clip: Bounds,
    /// Whether the curve, and what it passes through, make a difference at a point.
    matters: &'a dyn Fn(DVec3) -> bool,
    noise: f64,
    pub(super) roots: Vec<Root>,
    /// Places that halving did not decide: the curve touches the sheet, or runs along it.
    pub(super) undecided: usize,
    halvings: usize,
}

impl<'a> Along<'a> {
    pub(super) fn new(
        heights: Heights<'a>,
        tolerances: Tolerances,
        clip: Bounds,
        matters: &'a dyn Fn(DVec3) -> bool,
    ) -> Self {
        Self {
            heights,
            tolerances,
            clip,
            matters,
            noise: CERTAIN * heights.noise(),
            roots: Vec::new(),
            undecided: 0,
            halvings: 0,
        }
    }

    /// Only on some stretches of the curve.
    pub(super) fn within(mut self, segments: &[Segment], stretches: &[[f64; 2]]) -> Self {
        let near = *self.heights.sheets[1].bounds();
        for segment in segments {
            let wanted = meets(segment.t, stretches)
                && segment.bounds().meets(&near)
                && segment.bounds().meets(&self.clip);
            if wanted {
                self.halvings = 0;
                self.visit(segment, segment);
            }
        }
        self.roots.retain(|root| meets([root.t; 2], stretches));
        self.roots.sort_by(|a, b| a.t.total_cmp(&b.t));
        self
    }

    fn visit(&mut self, whole: &Segment, part: &Segment) {
        let bounds = part.bounds();
        if !bounds.meets(&self.clip) {
            return;
        }
        self.halvings += 1;
        let range = [[bounds.low.x, bounds.high.x], [bounds.low.y, bounds.high.y]];
        let size = (range[0][1] - range[0][0]).max(range[1][1] - range[1][0]);
        let is_small = size < LEAST * self.tolerances.scale || self.halvings > MOST;
        if let Some(patches) = self.heights.patches_over(range, TOGETHER) {
            let empty = [f64::INFINITY, f64::NEG_INFINITY];
            let and = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a.min(c), b.max(d)];
            let (mut values, mut slopes) = (empty, [empty; 2]);
            for pair in patches {
                let [a, b] = [0, 1].map(|side| self.heights.part(side, pair[side], range));
                let difference = a.minus(b);
                values = and(values, difference.values());
                if range[0][1] > range[0][0] {
                    slopes[0] = and(slopes[0], difference.slopes(0));
                }
                if range[1][1] > range[1][0] {
                    slopes[1] = and(slopes[1], difference.slopes(1));
                }
            }
            if values[0] > self.noise || values[1] < -self.noise {
                return;
            }
            let rate = [0, 1]
                .into_iter()
                .filter(|axis| range[*axis][1] > range[*axis][0])
                .map(|axis| product(slopes[axis], part.rates(axis)))
                .fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
            let certain = self.noise / (part.t[1] - part.t[0]);
            let is_monotone = rate[0] > certain || rate[1] < -certain;
            if is_monotone || is_small {
                if !self.land(whole, part.t) && !is_monotone {
                    self.doubt(whole, part);
                }
                return;
            }
        } else if self.halvings > MOST {
            self.doubt(whole, part);
            return;
        }
        for half in part.halves() {
            self.visit(whole, &half);
        }
    }

    /// A part of a curve of which nobody knows whether it passes through, unless that makes no difference there.
    fn doubt(&mut self, whole: &Segment, part: &Segment) {
        let [from, to] = part.t;
        let point = whole.evaluate(f64::midpoint(from, to)).0;
        self.undecided += usize::from((self.matters)(point));
    }

    /// The root between two parameters at which the difference has different signs; `false` if it has not.
    fn land(&mut self, segment: &Segment, [mut low, mut high]: [f64; 2]) -> bool {
        let difference = |t: f64| self.heights.difference(segment.evaluate(t).0.xy()).0;
        // 0 counts as positive: a root at a common end of two parts belongs to one of them.
        let positive = |t: f64| difference(t) >= 0.0;
        let first = positive(low);
        if positive(high) == first {
            return false;
        }
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if positive(middle) == first {
                low = middle;
            } else {
                high = middle;
            }
        }
        let t = f64::midpoint(low, high);
        let place: DVec2 = segment.evaluate(t).0.xy();
        let q = self.heights.parameters(place);
        let at = DVec2::new(q[2], q[3]);
        let sheet = self.heights.sheets[1];
        // Its patches go on beyond its borders.
        let nearest = sheet.nearest_parameters(at);
        let beyond = self.heights.place_on_second(nearest).distance(place);
        if beyond > self.tolerances.same {
            return true;
        }
        let point = sheet.point(at.x, at.y);
        let same = |other: &Root| other.point.distance(point) < self.tolerances.same;
        if self.clip.holds(point) && !self.roots.iter().any(same) {
            self.roots.push(Root { t, at, point });
        }
        true
    }
}

/// Bounds of products.
fn product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let all = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    [
        all.iter().copied().fold(f64::INFINITY, f64::min),
        all.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}
