//! The outline of a face in the plane of its parameters, by its true curves: whether a place lies within it.
//!
//! A ray crosses a Bézier piece as often, up to an even number, as its ends say, if the hull of its control points lies
//! beyond the place; so nothing is solved, and only pieces whose hull holds the place are made and halved. What is still there
//! when it is smaller than a given slack is the border itself: no answer.

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};

use super::blossom::Net;
use super::spline::Spline;

/// Halvings of one piece until its hull is as small as rounding.
const MOST_HALVINGS: usize = 60;
/// Courses of fewer pieces have more points in each, where they are polygons.
const FEW: usize = 8;
/// A piece halved so often crosses a height once at most, but by accident.
const SIMPLE: usize = 3;
/// Halvings of one piece until its hull says where it is, if a box is asked for.
const LOOKED_AT: usize = 6;
/// What rounding may do to a place, as a share of an outline.
const ROUNDING: f64 = 1e-12;

/// An edge as a loop runs along it.
#[derive(Clone, Debug)]
pub(crate) struct Course<'a> {
    pub(crate) spline: Spline<'a>,
    /// The part of it.
    pub(crate) range: [f64; 2],
    /// Whether the loop runs from its end to its start.
    pub(crate) backwards: bool,
    /// Of a curve in space, the plane that it is seen in: origin and two directions.
    pub(crate) plane: Option<[DVec3; 3]>,
}

impl Course<'_> {
    /// A homogeneous point as it is seen in the plane.
    fn seen(&self, h: DVec4) -> DVec4 {
        self.plane.map_or(h, |[origin, x, y]| {
            let p = h.xyz() - origin * h.w;
            DVec4::new(p.dot(x), p.dot(y), 0.0, h.w)
        })
    }

    fn point(&self, t: f64) -> DVec2 {
        flat(self.seen(self.spline.point(t).extend(1.0)))
    }

    /// A box that holds the piece over a part of a span: that of the control points that matter there.
    fn bounds(&self, range: [f64; 2]) -> (DVec2, DVec2) {
        around(self.spline.around(range).map(|h| flat(self.seen(h))))
    }

    /// The piece over a part of a span, in the direction of the loop.
    fn net(&self, range: [f64; 2]) -> Net {
        let mut net = self.spline.piece(range);
        net.iter_mut().for_each(|h| *h = self.seen(*h));
        if self.backwards {
            net.reverse();
        }
        net
    }

    /// Its parts by spans, in the direction of the loop.
    fn parts(&self) -> Vec<[f64; 2]> {
        let breaks = self.spline.breaks(self.range);
        let mut parts: Vec<[f64; 2]> = breaks.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        if self.backwards {
            parts.reverse();
        }
        parts
    }
}

/// All loops of a face.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline<'a> {
    courses: Vec<Course<'a>>,
    pieces: Vec<Piece>,
    /// By loop: a polygon on it.
    polygons: Vec<Vec<DVec2>>,
    low: DVec2,
    high: DVec2,
}

/// Where a piece of a course is: most is told by that alone.
#[derive(Clone, Copy, Debug)]
struct Piece {
    low: DVec2,
    high: DVec2,
    ends: [DVec2; 2],
    course: usize,
    range: [f64; 2],
}

/// A Bézier piece `(w x, w y, ·, w)` with its box.
struct Part {
    net: Net,
    low: DVec2,
    high: DVec2,
    halvings: usize,
}

fn flat(h: DVec4) -> DVec2 {
    DVec2::new(h.x, h.y) / h.w
}

fn around(points: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    })
}

/// Whether a ray from a place towards growing x crosses a piece an odd number of times, if its box tells.
fn crossed((low, high): (DVec2, DVec2), ends: [f64; 2], at: DVec2, slack: DVec2) -> Option<bool> {
    if at.y < low.y - slack.y || at.y > high.y + slack.y || at.x > high.x + slack.x {
        return Some(false);
    }
    (at.x < low.x - slack.x).then_some((ends[0] > at.y) != (ends[1] > at.y))
}

impl Part {
    fn new(net: Net, halvings: usize) -> Self {
        let (low, high) = around(net.iter().map(|h| flat(*h)));
        Self {
            net,
            low,
            high,
            halvings,
        }
    }

    fn ends(&self) -> [DVec2; 2] {
        [flat(self.net[0]), flat(self.net[self.net.len() - 1])]
    }

    fn halves(&self) -> [Self; 2] {
        let order = self.net.len();
        let (mut low, mut high) = (self.net.clone(), self.net.clone());
        for round in 1..order {
            for k in 0..order - round {
                high[k] = 0.5 * (high[k] + high[k + 1]);
            }
            low[round] = high[0];
        }
        [low, high].map(|net| Self::new(net, self.halvings + 1))
    }
}

impl<'a> Outline<'a> {
    /// Adds a loop of edges.
    pub(crate) fn add(&mut self, courses: Vec<Course<'a>>) {
        let first = self.pieces.len();
        let mut polygon: Vec<DVec2> = Vec::new();
        for course in courses {
            let parts = course.parts();
            // Many pieces make a polygon of their ends; of few, points between count, too.
            let between = if parts.len() < FEW { FEW } else { 1 };
            for range in parts {
                let (low, high) = course.bounds(range);
                let [from, to] = if course.backwards {
                    [range[1], range[0]]
                } else {
                    range
                };
                let places =
                    (1..=between).map(|k| from + (to - from) * (k as f64 / between as f64));
                polygon.extend(places.map(|t| course.point(t)));
                let end = polygon[polygon.len() - 1];
                self.pieces.push(Piece {
                    low: low.min(end),
                    high: high.max(end),
                    ends: [end; 2],
                    course: self.courses.len(),
                    range,
                });
            }
            self.courses.push(course);
        }
        self.polygons.push(polygon);
        // Each begins where the last one ends: what rounding leaves between them would be a hole in the outline.
        let own = &mut self.pieces[first..];
        let Some(mut from) = own.last().map(|last| last.ends[1]) else {
            return;
        };
        for piece in own {
            piece.ends[0] = from;
            (piece.low, piece.high) = (piece.low.min(from), piece.high.max(from));
            from = piece.ends[1];
        }
        let boxes = self.pieces.iter().flat_map(|piece| [piece.low, piece.high]);
        (self.low, self.high) = around(boxes);
    }

    /// A piece as it is.
    fn part(&self, piece: &Piece) -> Part {
        let mut net = self.courses[piece.course].net(piece.range);
        let last = net.len() - 1;
        for (at, end) in [(0, piece.ends[0]), (last, piece.ends[1])] {
            let h = &mut net[at];
            (h.x, h.y) = (end.x * h.w, end.y * h.w);
        }
        Part::new(net, 0)
    }

    /// Whether the first loop is the outer one: it runs around more than any other one, and these run the other way.
    pub(crate) fn is_in_order(&self) -> bool {
        let area = |polygon: &Vec<DVec2>| -> f64 {
            let corners = polygon.iter().zip(polygon.iter().cycle().skip(1));
            let parts = corners.map(|(a, b)| (*a - polygon[0]).perp_dot(*b - polygon[0]));
            0.5 * parts.sum::<f64>()
        };
        let areas: Vec<f64> = self.polygons.iter().map(area).collect();
        areas.split_first().is_some_and(|(outer, holes)| {
            let is_hole = |hole: &f64| outer * hole < 0.0 && outer.abs() > hole.abs();
            holes.iter().all(is_hole)
        })
    }

    /// The corners of a box that holds it.
    pub(crate) fn bounds(&self) -> (DVec2, DVec2) {
        (self.low, self.high)
    }

    /// Whether it holds a place; `None` if that is nearer to its border than the slack.
    pub(crate) fn holds(&self, at: DVec2, slack: DVec2) -> Option<bool> {
        let beyond = at.cmplt(self.low - slack).any() || at.cmpgt(self.high + slack).any();
        if beyond {
            return Some(false);
        }
        let mut inside = false;
        let mut stack: Vec<Part> = Vec::new();
        for piece in &self.pieces {
            let ends = piece.ends.map(|end| end.y);
            match crossed((piece.low, piece.high), ends, at, slack) {
                Some(crossed) => inside ^= crossed,
                None => stack.push(self.part(piece)),
            }
            while let Some(part) = stack.pop() {
                let is_border = (part.high - part.low).cmple(slack).all();
                if is_border || part.halvings == MOST_HALVINGS {
                    return None;
                }
                for half in part.halves() {
                    let ends = half.ends().map(|end| end.y);
                    match crossed((half.low, half.high), ends, at, slack) {
                        Some(crossed) => inside ^= crossed,
                        None => stack.push(half),
                    }
                }
            }
        }
        Some(inside)
    }

    /// Whether it holds all of a box, or nothing of it; `None` if its border may pass through.
    pub(crate) fn over(&self, low: DVec2, high: DVec2) -> Option<bool> {
        let apart = |a: DVec2, b: DVec2| a.cmpgt(high).any() || b.cmplt(low).any();
        let mut stack: Vec<Part> = Vec::new();
        for piece in &self.pieces {
            if !apart(piece.low, piece.high) {
                stack.push(self.part(piece));
            }
            while let Some(part) = stack.pop() {
                if apart(part.low, part.high) {
                    continue;
                }
                if part.halvings == LOOKED_AT {
                    return None;
                }
                stack.extend(part.halves());
            }
        }
        self.holds(0.5 * (low + high), DVec2::ZERO)
    }

    /// A place within it: the middle of the widest gap at a height.
    pub(crate) fn widest(&self, y: f64) -> Option<DVec2> {
        // A polygon is quick, and not the outline where that is thin and bent.
        self.middle(self.of_polygons(y), y)
            .or_else(|| self.middle(self.exact(y), y))
    }

    /// The middle of the widest of some gaps, if it lies within the outline.
    fn middle(&self, mut crossings: Vec<f64>, y: f64) -> Option<DVec2> {
        crossings.sort_by(f64::total_cmp);
        let gaps = crossings.chunks_exact(2);
        let widest = gaps.max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
        let at = DVec2::new(0.5 * (widest[0] + widest[1]), y);
        let slack = ROUNDING * (self.high - self.low);
        (self.holds(at, slack) == Some(true)).then_some(at)
    }

    /// Where the polygons cross a height.
    fn of_polygons(&self, y: f64) -> Vec<f64> {
        let mut crossings = Vec::new();
        for polygon in &self.polygons {
            for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
                if (a.y > y) != (b.y > y) {
                    crossings.push(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
                }
            }
        }
        crossings
    }

    /// Where the outline itself crosses a height, by bisection.
    fn exact(&self, y: f64) -> Vec<f64> {
        let passes = |part: &Part| {
            let [a, b] = part.ends();
            (a.y > y) != (b.y > y)
        };
        let mut crossings = Vec::new();
        let mut stack: Vec<Part> = Vec::new();
        for piece in &self.pieces {
            if y >= piece.low.y && y <= piece.high.y {
                stack.push(self.part(piece));
            }
            while let Some(mut part) = stack.pop() {
                if y < part.low.y || y > part.high.y {
                    continue;
                }
                if part.halvings < SIMPLE {
                    stack.extend(part.halves());
                    continue;
                }
                if !passes(&part) {
                    continue;
                }
                while part.halvings < MOST_HALVINGS {
                    let [low, high] = part.halves();
                    part = if passes(&low) { low } else { high };
                }
                crossings.push(part.ends()[0].x);
            }
        }
        crossings
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
pub(super) mod tests {
    use super::*;
    use crate::nurbs::{Curve, KnotVector};

    /// A circle in four rational quadratics.
    pub(in crate::nurbs) fn circle(middle: DVec2, radius: f64) -> Curve {
        let w = 0.5_f64.sqrt();
        let corners = [
            (1.0, 0.0),
            (1.0, 1.0),
            (0.0, 1.0),
            (-1.0, 1.0),
            (-1.0, 0.0),
            (-1.0, -1.0),
            (0.0, -1.0),
            (1.0, -1.0),
            (1.0, 0.0),
        ];
        let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
        let points = corners.map(|(x, y)| (middle + radius * DVec2::new(x, y)).extend(7.0));
        let weights = (0..9).map(|k| if k % 2 == 0 { 1.0 } else { w }).collect();
        let knots = KnotVector::new(2, knots).unwrap();
        Curve::rational(knots, points.to_vec(), weights).unwrap()
    }

    /// A circle as a loop of one edge, or of two.
    fn courses(shape: &Curve, cut: Option<f64>, backwards: bool) -> Vec<Course<'_>> {
        let course = |range: [f64; 2]| Course {
            spline: Spline::of_curve(shape),
            range,
            backwards,
            plane: Some([DVec3::ZERO, DVec3::X, DVec3::Y]),
        };
        let Some(cut) = cut else {
            return vec![course([0.0, 4.0])];
        };
        let mut both = vec![course([0.0, cut]), course([cut, 4.0])];
        if backwards {
            both.reverse();
        }
        both
    }

    #[test]
    fn a_ring_holds_what_its_equation_says_and_is_silent_on_its_border() {
        let (outer, inner) = (
            circle(DVec2::new(3.0, 1.0), 2.0),
            circle(DVec2::new(2.5, 1.0), 0.7),
        );
        let mut ring = Outline::default();
        ring.add(courses(&outer, Some(1.3), false));
        ring.add(courses(&inner, None, true));
        let slack = DVec2::splat(1e-9);
        let mut silent = 0;
        for k in 1..5000_u32 {
            let part = DVec2::new(0.754_877_666, 0.569_840_291) * f64::from(k);
            let at = DVec2::new(0.5, -1.5) + 5.0 * part.fract();
            let outer = at.distance(DVec2::new(3.0, 1.0)) < 2.0;
            let inner = at.distance(DVec2::new(2.5, 1.0)) < 0.7;
            match ring.holds(at, slack) {
                Some(held) => assert_eq!(held, outer && !inner, "{at}"),
                None => silent += 1,
            }
        }
        assert_eq!(silent, 0);
        let (sine, cosine) = 0.4_f64.sin_cos();
        let border = DVec2::new(3.0 + 2.0 * cosine, 1.0 + 2.0 * sine);
        assert_eq!(ring.holds(border, slack), None);
        // At the height of both middles: from 2.5 + 0.7 to 3 + 2.
        let middle = ring.widest(1.0 + 1e-7).unwrap();
        assert!((middle.x - 4.1).abs() < 1e-3);
    }
}
