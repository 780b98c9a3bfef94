//! Where lines parallel to an axis pass through a surface: every place, or the word that a line is not clear.
//!
//! Seen along a line through (a, b) a Bézier patch is a map of the unit square into the plane,
//! `g(s, t) = w(s, t) (x(s, t) − a, y(s, t) − b)`, whose zeros are the places looked for. Its control net bounds it. A patch
//! is dropped where that net has one sign along some direction. Where all differences of the net along s lie in one cone and
//! all along t in another, and the cones are apart, g has one zero at most: Newton's method finds it, or the patch is halved.
//! What is still undecided when it is smaller than a given distance is a fold or a side that the line grazes: such a line
//! is not clear, and says nothing.

use std::borrow::Cow;

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use smallvec::{SmallVec, smallvec};

use super::bezier::{Patch, Region};
use super::blossom;
use super::knots::ORDER;
use super::{KnotVector, Surface};

/// Patches of one surface that are kept: some 2 MB.
const KEPT: usize = 4096;
/// Halvings of one patch before a line is given up.
const MOST_HALVINGS: usize = 400;
/// How far beyond the borders of a patch, in its parameters, a place still belongs to it: rounding.
const BORDER: f64 = 1e-9;

/// How far beyond its borders the cones of a patch's differences still are apart, if they are by the next number.
const BESIDE: f64 = 1e-2;
/// The greatest product of the slopes of two cones that are apart: 1 would do within the patch.
const APART: f64 = 0.8;

/// A line parallel to an axis, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The axis: 0 for x, 1 for y, 2 for z.
    pub axis: usize,
    /// A point that it passes through; the coordinate along the axis does not matter.
    pub through: DVec3,
    /// From where to where it goes along the axis.
    pub range: [f64; 2],
}

impl Line {
    /// The whole line along an axis through a point.
    pub fn whole(axis: usize, through: DVec3) -> Self {
        Self {
            axis,
            through,
            range: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// The other two axes.
    fn across(self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// Seen along the line.
    fn view(self, p: DVec3) -> DVec2 {
        let [a, b] = self.across();
        DVec2::new(p[a], p[b])
    }

    /// Its point with a coordinate along the axis.
    pub fn at(self, along: f64) -> DVec3 {
        let mut p = self.through;
        p[self.axis] = along;
        p
    }

    /// Whether it comes this near to a box.
    pub fn meets(self, (low, high): (DVec3, DVec3), near: f64) -> bool {
        let [from, to] = self.range;
        low[self.axis] <= to
            && from <= high[self.axis]
            && self
                .across()
                .into_iter()
                .all(|k| low[k] <= self.through[k] + near && self.through[k] - near <= high[k])
    }
}

/// A place where a line passes through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// The surface's parameters.
    pub at: DVec2,
    /// The point.
    pub point: DVec3,
    /// `S_u` there.
    pub u: DVec3,
    /// `S_v` there.
    pub v: DVec3,
}

/// A surface with the boxes of its Bézier patches. Of a surface with very many the patches themselves are made anew for each line
/// that comes near to one: most lines see few.
#[derive(Clone, Debug)]
pub struct Target<'a> {
    surface: &'a Surface,
    /// In u and in v.
    spans: [Vec<Span>; 2],
    boxes: Vec<(DVec3, DVec3)>,
    /// The patches, unless there are very many.
    kept: Vec<Patch>,
}

/// A span of a knot vector, and how control points of the spline make those of its Bézier piece.
#[derive(Clone, Debug)]
struct Span {
    /// The first control point that matters.
    first: usize,
    range: [f64; 2],
    /// Bézier point i is the sum of `parts[i][k]` times control point `first + k`.
    parts: SmallVec<[SmallVec<[f64; 4]>; 4]>,
}

impl Span {
    /// All spans of a knot vector.
    fn all(knots: &KnotVector) -> Vec<Self> {
        let (all, degree) = (knots.as_slice(), knots.degree());
        let is_span = |at: &usize| all[*at] < all[*at + 1];
        let span = |at: usize| {
            let range = [all[at], all[at + 1]];
            let mut parts: SmallVec<[SmallVec<[f64; 4]>; 4]> =
                (0..=degree).map(|_| smallvec![0.0; degree + 1]).collect();
            for k in 0..=degree {
                let unit = |other: usize| {
                    if other == at - degree + k {
                        DVec4::ONE
                    } else {
                        DVec4::ZERO
                    }
                };
                let own = blossom::piece(all, degree, at, range, unit);
                for (row, h) in parts.iter_mut().zip(own) {
                    row[k] = h.x;
                }
            }
            Self {
                first: at - degree,
                range,
                parts,
            }
        };
        (degree..knots.count()).filter(is_span).map(span).collect()
    }
}

impl<'a> Target<'a> {
    /// Of a whole surface.
    pub fn new(surface: &'a Surface) -> Self {
        let spans = [surface.knots_u(), surface.knots_v()].map(Span::all);
        let mut target = Self {
            surface,
            spans,
            boxes: Vec::new(),
            kept: Vec::new(),
        };
        let count = target.spans[0].len() * target.spans[1].len();
        let patches = (0..count).map(|at| target.made(at));
        if count <= KEPT {
            target.kept = patches.collect();
            target.boxes = target.kept.iter().map(Patch::hull).collect();
        } else {
            target.boxes = patches.map(|patch| patch.hull()).collect();
        }
        target
    }

    /// The spans of a patch.
    fn spans(&self, at: usize) -> [&Span; 2] {
        let columns = self.spans[1].len();
        [&self.spans[0][at / columns], &self.spans[1][at % columns]]
    }

    fn patch(&self, at: usize) -> Cow<'_, Patch> {
        match self.kept.get(at) {
            Some(patch) => Cow::Borrowed(patch),
            None => Cow::Owned(self.made(at)),
        }
    }

    /// A patch, made of the control points.
    fn made(&self, at: usize) -> Patch {
        let [u, v] = self.spans(at);
        let (net, weights) = (self.surface.net(), self.surface.weights());
        let row = self.surface.knots_v().count();
        let order = [self.surface.knots_u(), self.surface.knots_v()].map(|k| k.degree() + 1);
        // Along v first, then along u.
        let mut lines: SmallVec<[DVec4; 16]> = smallvec![DVec4::ZERO; order[0] * order[1]];
        for (i, line) in lines.chunks_exact_mut(order[1]).enumerate() {
            let from = (u.first + i) * row + v.first;
            for k in 0..order[1] {
                let w = weights[from + k];
                let h = (net[from + k] * w).extend(w);
                for (sum, parts) in line.iter_mut().zip(&v.parts) {
                    *sum += h * parts[k];
                }
            }
        }
        let mut own = Vec::with_capacity(order[0] * order[1]);
        for parts in &u.parts {
            for j in 0..order[1] {
                let terms = parts.iter().enumerate();
                let terms = terms.map(|(k, part)| lines[k * order[1] + j] * *part);
                own.push(terms.fold(DVec4::ZERO, |sum, term| sum + term));
            }
        }
        Patch {
            degree_u: order[0] - 1,
            degree_v: order[1] - 1,
            net: own,
        }
    }

    /// Its patches: the box of each, and its ranges of parameters as lower and upper corner.
    pub fn patches(&self) -> impl Iterator<Item = ((DVec3, DVec3), [DVec2; 2])> {
        self.boxes.iter().enumerate().map(move |(at, bounds)| {
            let [u, v] = self.spans(at);
            let corner = |k: usize| DVec2::new(u.range[k], v.range[k]);
            (*bounds, [corner(0), corner(1)])
        })
    }

    /// Adds where a line passes through a patch. `false` if the line is not clear of something nearer than a distance.
    pub fn pass(&self, at: usize, line: Line, near: f64, found: &mut Vec<Passage>) -> bool {
        let patch = self.patch(at);
        let region = Region {
            u: self.spans(at)[0].range,
            v: self.spans(at)[1].range,
        };
        let mut stack: SmallVec<[View; 4]> = SmallVec::new();
        stack.push(View::new(&patch, line));
        let mut halvings = 0;
        while let Some(view) = stack.pop() {
            match view.judge(near) {
                Verdict::Beside => {}
                Verdict::Passes(at) => {
                    let at = view.place(at);
                    let jet = patch.jet(at.x, at.y);
                    let (u, v) = region.at(at.x, at.y);
                    let (in_u, in_v) = region.lengths();
                    found.push(Passage {
                        at: DVec2::new(u, v),
                        point: jet.point,
                        u: jet.du / in_u,
                        v: jet.dv / in_v,
                    });
                }
                Verdict::Unknown => {
                    halvings += 1;
                    if halvings > MOST_HALVINGS || view.extent() <= near {
                        return false;
                    }
                    stack.extend(view.halves());
                }
            }
        }
        true
    }

    /// All places where a line passes through the surface, in no order; `None` if the line is not clear.
    pub fn passages(&self, line: Line, near: f64) -> Option<Vec<Passage>> {
        let mut found: Vec<Passage> = Vec::new();
        for (patch, bounds) in self.boxes.iter().enumerate() {
            if line.meets(*bounds, near) && !self.pass(patch, line, near, &mut found) {
                return None;
            }
        }
        Some(merged(found, near))
    }
}

/// Places on the border of two patches are found in both.
pub fn merged(mut found: Vec<Passage>, near: f64) -> Vec<Passage> {
    let mut kept: Vec<Passage> = Vec::with_capacity(found.len());
    for one in found.drain(..) {
        let is_known = |other: &Passage| {
            let apart = one.at - other.at;
            other.point.distance(one.point) <= near
                && (one.u * apart.x + one.v * apart.y).length() <= near
        };
        if !kept.iter().any(is_known) {
            kept.push(one);
        }
    }
    kept
}

enum Verdict {
    /// The line does not pass through it.
    Beside,
    /// It does, once, at these parameters of the view.
    Passes(DVec2),
    Unknown,
}

/// A part of a patch as seen along a line, the line at the origin.
#[derive(Clone, Debug)]
struct View {
    rows: usize,
    columns: usize,
    net: SmallVec<[DVec2; 16]>,
    /// The least weight: a distance of one is this much in the net at least.
    weight: f64,
    low: DVec2,
    size: DVec2,
}

impl View {
    fn new(patch: &Patch, line: Line) -> Self {
        let origin = line.view(line.through);
        Self {
            rows: patch.degree_u + 1,
            columns: patch.degree_v + 1,
            // First what is subtracted: far from the origin of coordinates that costs no digits.
            net: patch
                .net
                .iter()
                .map(|h| {
                    if h.w == 1.0 {
                        line.view(h.xyz()) - origin
                    } else {
                        (line.view(h.xyz() / h.w) - origin) * h.w
                    }
                })
                .collect(),
            weight: patch.weight_range().0,
            low: DVec2::ZERO,
            size: DVec2::ONE,
        }
    }

    /// Parameters of the patch at parameters of this part.
    fn place(&self, at: DVec2) -> DVec2 {
        (self.low + self.size * at).clamp(DVec2::ZERO, DVec2::ONE)
    }

    fn extent(&self) -> f64 {
        let (low, high) = hull(&self.net);
        (high - low).max_element() / self.weight
    }

    fn judge(&self, near: f64) -> Verdict {
        let near = near * self.weight;
        let (low, high) = hull(&self.net);
        if low.cmpgt(DVec2::splat(near)).any() || high.cmplt(DVec2::splat(-near)).any() {
            return Verdict::Beside;
        }
        let (middle, s, t) = self.jet(DVec2::splat(0.5));
        let determinant = s.perp_dot(t);
        if !(determinant.abs() > 1e-12 * s.length() * t.length()) {
            return Verdict::Unknown;
        }
        // In the parameters of the linear map at the middle: one there is the size of the part.
        let unskewed = |p: DVec2| DVec2::new(p.perp_dot(t), s.perp_dot(p)) / determinant;
        let straight: SmallVec<[DVec2; 16]> = self.net.iter().map(|p| unskewed(*p)).collect();
        let slack = DVec2::new(t.length(), s.length()) * (near / determinant.abs());
        let (low, high) = hull(&straight);
        if low.cmpgt(slack).any() || high.cmplt(-slack).any() {
            return Verdict::Beside;
        }
        if !self.is_injective(&straight) {
            return Verdict::Unknown;
        }
        // The linear map is a good start.
        let Some(at) = self.newton(DVec2::splat(0.5) - unskewed(middle)) else {
            return Verdict::Unknown;
        };
        let within =
            |by: f64| at.cmpge(DVec2::splat(-by)).all() && at.cmple(DVec2::splat(1.0 + by)).all();
        if within(BORDER) {
            Verdict::Passes(at)
        } else if within(BESIDE) {
            // There is one zero here, and it is the neighbour's.
            Verdict::Beside
        } else {
            Verdict::Unknown
        }
    }

    /// Whether the differences of a net along s and along t lie in two cones that are apart.
    fn is_injective(&self, net: &[DVec2]) -> bool {
        let (mut tilt_s, mut tilt_t) = (0.0_f64, 0.0_f64);
        for i in 0..self.rows {
            for j in 0..self.columns {
                let here = net[i * self.columns + j];
                if i + 1 < self.rows {
                    let leg = net[(i + 1) * self.columns + j] - here;
                    if !(leg.x > 0.0) {
                        return false;
                    }
                    tilt_s = tilt_s.max(leg.y.abs() / leg.x);
                }
                if j + 1 < self.columns {
                    let leg = net[i * self.columns + j + 1] - here;
                    if !(leg.y > 0.0) {
                        return false;
                    }
                    tilt_t = tilt_t.max(leg.x.abs() / leg.y);
                }
            }
        }
        tilt_s * tilt_t < APART
    }

    fn newton(&self, mut at: DVec2) -> Option<DVec2> {
        for _ in 0..16 {
            let (g, s, t) = self.jet(at);
            let determinant = s.perp_dot(t);
            if determinant == 0.0 {
                return None;
            }
            let step = DVec2::new(g.perp_dot(t), s.perp_dot(g)) / determinant;
            at -= step;
            if !at.is_finite() || at.abs().max_element() > 4.0 {
                return None;
            }
            // The next step would be the square of it.
            if step.abs().max_element() < 1e-8 {
                return Some(at);
            }
        }
        None
    }

    /// The value and both derivatives.
    fn jet(&self, at: DVec2) -> (DVec2, DVec2, DVec2) {
        let mut values = [DVec2::ZERO; ORDER];
        let mut slopes = [DVec2::ZERO; ORDER];
        for (i, row) in self.net.chunks_exact(self.columns).enumerate() {
            (values[i], slopes[i]) = casteljau(row, at.y);
        }
        let (value, s) = casteljau(&values[..self.rows], at.x);
        (value, s, casteljau(&slopes[..self.rows], at.x).0)
    }

    fn halves(&self) -> [Self; 2] {
        let leg = |i: usize, j: usize, step: usize| {
            (self.net[i * self.columns + j + step] - self.net[i * self.columns + j]).length()
        };
        let (mut long_s, mut long_t) = (0.0_f64, 0.0_f64);
        for j in 0..self.columns {
            long_s = long_s.max((0..self.rows - 1).map(|i| leg(i, j, self.columns)).sum());
        }
        for i in 0..self.rows {
            long_t = long_t.max((0..self.columns - 1).map(|j| leg(i, j, 1)).sum());
        }
        let along_s = long_s >= long_t;
        let (lines, order, line_step, step) = if along_s {
            (self.columns, self.rows, 1, self.columns)
        } else {
            (self.rows, self.columns, self.columns, 1)
        };
        let (mut low, mut high) = (self.clone(), self.clone());
        for line in 0..lines {
            let at = |k: usize| line * line_step + k * step;
            for round in 1..order {
                for k in 0..order - round {
                    high.net[at(k)] = 0.5 * (high.net[at(k)] + high.net[at(k + 1)]);
                }
                low.net[at(round)] = high.net[at(0)];
            }
        }
        let half = if along_s {
            DVec2::new(0.5, 1.0)
        } else {
            DVec2::new(1.0, 0.5)
        };
        high.low += high.size * (DVec2::ONE - half);
        low.size *= half;
        high.size *= half;
        [low, high]
    }
}

/// Value and derivative of a Bézier curve.
fn casteljau(points: &[DVec2], t: f64) -> (DVec2, DVec2) {
    let degree = points.len() - 1;
    if degree == 0 {
        return (points[0], DVec2::ZERO);
    }
    let mut work = [DVec2::ZERO; ORDER];
    work[..=degree].copy_from_slice(points);
    for round in 1..degree {
        for k in 0..=degree - round {
            work[k] = work[k].lerp(work[k + 1], t);
        }
    }
    (
        work[0] + (work[1] - work[0]) * t,
        (work[1] - work[0]) * degree as f64,
    )
}

fn hull(points: &[DVec2]) -> (DVec2, DVec2) {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    points
        .iter()
        .fold(empty, |(low, high), p| (low.min(*p), high.max(*p)))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    /// A quarter of a unit sphere's upper half would have folds on its rim only; the whole sphere, by rational quadratics.
    fn sphere() -> Surface {
        let w = 0.5_f64.sqrt();
        // A half circle in (r, z) from the south pole, revolved.
        let meridian = [
            (0.0, -1.0, 1.0),
            (1.0, -1.0, w),
            (1.0, 0.0, 1.0),
            (1.0, 1.0, w),
            (0.0, 1.0, 1.0),
        ];
        let round = [
            (1.0, 0.0, 1.0),
            (1.0, 1.0, w),
            (0.0, 1.0, 1.0),
            (-1.0, 1.0, w),
            (-1.0, 0.0, 1.0),
            (-1.0, -1.0, w),
            (0.0, -1.0, 1.0),
            (1.0, -1.0, w),
            (1.0, 0.0, 1.0),
        ];
        let u = KnotVector::new(
            2,
            vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0],
        )
        .unwrap();
        let v = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]).unwrap();
        let net = round.iter().flat_map(|&(x, y, _)| {
            meridian
                .iter()
                .map(move |&(r, z, _)| DVec3::new(r * x, r * y, z))
        });
        let weights = round
            .iter()
            .flat_map(|&(_, _, a)| meridian.iter().map(move |&(_, _, b)| a * b));
        Surface::rational(u, v, net.collect(), weights.collect()).unwrap()
    }

    #[test]
    fn lines_pass_through_a_sphere_where_its_equation_says_along_every_axis() {
        let sphere = sphere();
        let target = Target::new(&sphere);
        let mut clear = 0;
        for axis in 0..3 {
            for k in 1..400_u32 {
                let part = DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478) * f64::from(k);
                let through = 2.4 * part.fract() - 1.2;
                let line = Line::whole(axis, through);
                let off = line.view(through).length_squared();
                let Some(mut found) = target.passages(line, 1e-10) else {
                    continue;
                };
                clear += 1;
                found.sort_by(|a, b| a.point[axis].total_cmp(&b.point[axis]));
                let heights: Vec<f64> = found.iter().map(|one| one.point[axis]).collect();
                if off >= 1.0 {
                    assert!(heights.is_empty(), "{line:?}");
                    continue;
                }
                let half = (1.0 - off).sqrt();
                assert_eq!(heights.len(), 2, "{line:?}");
                assert!((heights[0] + half).abs() < 1e-9 && (heights[1] - half).abs() < 1e-9);
                // Derivatives are tangents of the sphere, and the places are what the surface has there.
                for one in &found {
                    assert!(one.point.dot(one.u).abs() < 1e-9 && one.point.dot(one.v).abs() < 1e-9);
                    let there = sphere.point(one.at.x, one.at.y);
                    assert!(there.distance(one.point) < 1e-12);
                }
            }
        }
        // Hardly any line grazes the sphere.
        assert!(clear > 1150, "{clear}");
    }

    #[test]
    fn patches_are_those_that_knots_inserted_into_the_surface_give() {
        let sphere = sphere();
        let target = Target::new(&sphere);
        let others = Patch::of_surface(&sphere);
        assert_eq!(target.boxes.len(), others.len());
        for (at, (other, region)) in others.iter().enumerate() {
            let patch = target.patch(at);
            assert_eq!(
                target.spans(at).map(|span| span.range),
                [region.u, region.v]
            );
            for (a, b) in patch.net.iter().zip(&other.net) {
                assert!((*a - *b).length() < 1e-14);
            }
        }
    }

    #[test]
    fn a_line_that_grazes_a_fold_is_not_clear_and_one_through_a_border_passes_once() {
        let sphere = sphere();
        let target = Target::new(&sphere);
        let line = |x: f64, y: f64| Line::whole(2, DVec3::new(x, y, 0.0));
        let (sine, cosine) = 0.7_f64.sin_cos();
        assert_eq!(target.passages(line(cosine, sine), 1e-9), None);
        // On the meridian where two quarters meet, and so near to it that only one of them has the place.
        for x in [0.0, 1e-10, 2e-9, -2e-9] {
            assert_eq!(target.passages(line(x, 0.5), 1e-7).unwrap().len(), 2, "{x}");
        }
    }

    #[test]
    fn a_height_over_its_plan_is_passed_once_everywhere_however_far_away() {
        // z = x², over a square far from the origin, in two spans.
        let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0]).unwrap();
        let far = DVec3::new(4e5, 6e6, 0.0);
        let greville = [0.0, 0.5, 1.5, 2.0];
        // Blossoms of x²: products of neighbouring knots.
        let squares = [0.0, 0.0, 2.0, 4.0];
        let net = (0..4).flat_map(|i| {
            (0..4).map(move |j| far + DVec3::new(greville[i], greville[j], squares[i]))
        });
        let surface = Surface::new(knots.clone(), knots, net.collect()).unwrap();
        let target = Target::new(&surface);
        for (x, y) in [(0.3, 0.7), (1.0, 1.0), (1.9, 0.01)] {
            let line = Line::whole(2, far + DVec3::new(x, y, 0.0));
            let found = target.passages(line, 1e-8).unwrap();
            assert_eq!(found.len(), 1);
            assert!((found[0].point.z - x * x).abs() < 1e-8);
        }
    }
}
