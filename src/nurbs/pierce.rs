//! Where lines parallel to an axis pass through a surface: every place, or the word that a line is not clear.
//!
//! Seen along a line through (a, b) a Bézier patch is a map of the unit square into the plane,
//! `g(s, t) = w(s, t) (x(s, t) − a, y(s, t) − b)`, whose zeros are the places looked for. Its control net bounds it. A patch
//! is dropped where that net has one sign along some direction. Where all differences of the net along s lie in one cone and
//! all along t in another, and the cones are apart, g has one zero at most: Newton's method finds it, or the patch is halved.
//! What is still undecided when it is smaller than a given distance is a fold or a side that the line grazes: such a line
//! is not clear, and says nothing.

mod line;
mod view;

use std::borrow::Cow;

use glam::{DVec2, DVec3, DVec4};
use smallvec::{SmallVec, smallvec};

use super::bezier::{Patch, Region};
use super::blossom;
use super::{KnotVector, Surface};
pub use line::Line;
use view::{Verdict, View};

/// Patches of one surface that are kept: some 2 MB.
const KEPT: usize = 4096;
/// Halvings of one patch before a line is given up.
const MOST_HALVINGS: usize = 400;
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

    /// A patch by its number.
    pub(super) fn patch(&self, at: usize) -> Cow<'_, Patch> {
        match self.kept.get(at) {
            Some(patch) => Cow::Borrowed(patch),
            None => Cow::Owned(self.made(at)),
        }
    }

    /// Where a patch lies in the surface's parameters.
    pub(super) fn region(&self, at: usize) -> Region {
        let [u, v] = self.spans(at);
        Region {
            u: u.range,
            v: v.range,
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
        let region = self.region(at);
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
