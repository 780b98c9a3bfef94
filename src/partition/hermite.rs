//! Computed curves: pieces of degree 5 through points of an intersection, with its first and second
//! derivatives by arc length. One parameter serves the curve in space and its images on both sheets.

use std::ops::Range;

use glam::{DVec2, DVec3};

/// What runs along a curve: x, y, z, then (u, v) on the first sheet, then (u, v) on the second.
pub(super) const PARTS: usize = 7;

/// A point of an intersection curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) value: [f64; PARTS],
    /// First derivative by arc length.
    pub(super) first: [f64; PARTS],
    /// Second derivative by arc length.
    pub(super) second: [f64; PARTS],
    /// Sine of the angle between the sheets.
    pub(super) sine: f64,
}

impl Node {
    pub(super) fn point(&self) -> DVec3 {
        space(&self.value)
    }

    pub(super) fn tangent(&self) -> DVec3 {
        space(&self.first)
    }

    pub(super) fn curvature(&self) -> DVec3 {
        space(&self.second)
    }

    /// The parameters on both sheets.
    pub(super) fn parameters(&self) -> [f64; 4] {
        std::array::from_fn(|i| self.value[3 + i])
    }

    /// The same point, run through the other way.
    pub(super) fn reversed(mut self) -> Self {
        for d in &mut self.first {
            *d = -*d;
        }
        self
    }
}

pub(super) fn space(parts: &[f64; PARTS]) -> DVec3 {
    DVec3::new(parts[0], parts[1], parts[2])
}

pub(super) fn on_sheet(parts: &[f64; PARTS], side: usize) -> DVec2 {
    DVec2::new(parts[3 + 2 * side], parts[4 + 2 * side])
}

/// The six control points of the piece from one node to the next, `length` long.
pub(super) fn control(a: &Node, b: &Node, length: f64) -> [[f64; PARTS]; 6] {
    control_of(a, b, length, 0)
}

/// The same, of `K` parts from the `first` on.
#[inline]
fn control_of<const K: usize>(a: &Node, b: &Node, length: f64, first: usize) -> [[f64; K]; 6] {
    let (h, k) = (length / 5.0, length * length / 20.0);
    // The node's quadratic Taylor polynomial as one of degree 5.
    let taylor = |node: &Node, once: f64, twice: f64| {
        std::array::from_fn(|i| {
            let i = first + i;
            node.value[i] + once * node.first[i] + twice * node.second[i]
        })
    };
    [
        taylor(a, 0.0, 0.0),
        taylor(a, h, 0.0),
        taylor(a, 2.0 * h, k),
        taylor(b, -2.0 * h, k),
        taylor(b, -h, 0.0),
        taylor(b, 0.0, 0.0),
    ]
}

/// The parts of a place in space, and of one on a sheet.
const SPACE: usize = 0;
const SHEETS: [usize; 2] = [3, 5];

/// The piece's value at a fraction of its length.
#[inline]
pub(super) fn at<const K: usize>(points: &[[f64; K]; 6], s: f64) -> [f64; K] {
    let r = 1.0 - s;
    let (r2, s2) = (r * r, s * s);
    let weights = [
        r2 * r2 * r,
        5.0 * r2 * r2 * s,
        10.0 * r2 * r * s2,
        10.0 * r2 * s2 * s,
        5.0 * r * s2 * s2,
        s2 * s2 * s,
    ];
    let mut sum = [0.0; K];
    for (weight, point) in weights.iter().zip(points) {
        for (sum, part) in sum.iter_mut().zip(point) {
            *sum += weight * part;
        }
    }
    sum
}

/// The piece's derivative by the fraction of its length.
#[inline]
fn slope<const K: usize>(points: &[[f64; K]; 6], s: f64) -> [f64; K] {
    let r = 1.0 - s;
    let (r2, s2) = (r * r, s * s);
    let weights = [
        r2 * r2,
        4.0 * r2 * r * s,
        6.0 * r2 * s2,
        4.0 * r * s2 * s,
        s2 * s2,
    ];
    let mut sum = [0.0; K];
    for (weight, legs) in weights.iter().zip(points.windows(2)) {
        for (i, sum) in sum.iter_mut().enumerate() {
            *sum += 5.0 * weight * (legs[1][i] - legs[0][i]);
        }
    }
    sum
}

/// The control points of a part of a piece, between fractions of its length.
pub(super) fn part<const K: usize>(points: &[[f64; K]; 6], [from, to]: [f64; 2]) -> [[f64; K]; 6] {
    let mut whole = *points;
    if to < 1.0 {
        whole = lower(whole, to);
    }
    if from > 0.0 {
        // The lower part of the reverse.
        whole.reverse();
        whole = lower(whole, 1.0 - from / to);
        whole.reverse();
    }
    whole
}

/// The control points up to a fraction (de Casteljau).
fn lower<const K: usize>(mut points: [[f64; K]; 6], s: f64) -> [[f64; K]; 6] {
    for round in 1..6 {
        for k in (round..6).rev() {
            let before = points[k - 1];
            for (own, before) in points[k].iter_mut().zip(before) {
                *own = (1.0 - s) * before + s * *own;
            }
        }
    }
    points
}

/// Nearer to a node than this fraction of a piece, the piece is as good as exact: its error grows with the third power.
const BESIDE: f64 = 1e-2;

/// A curve on two sheets, computed.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    pub(super) nodes: Vec<Node>,
    /// Arc length at each node, from 0.
    pub(super) lengths: Vec<f64>,
    /// Farthest from both sheets between nodes, measured (m).
    pub(super) deviation: f64,
    /// How its two ends end; the same for a closed one.
    pub(super) ends: [End; 2],
}

/// A piece of a branch on one of its sheets.
pub(super) struct PieceOn {
    points: [[f64; 2]; 6],
    range: [f64; 2],
}

impl PieceOn {
    /// The place on the sheet, and its derivative by arc length.
    pub(super) fn at(&self, t: f64) -> (DVec2, DVec2) {
        let length = self.range[1] - self.range[0];
        let s = (t - self.range[0]) / length;
        let place = DVec2::from_array(at(&self.points, s));
        (place, DVec2::from_array(slope(&self.points, s)) / length)
    }
}

/// How a branch ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    /// On a border of one of its sheets, at a root of an edge.
    AtRoot(usize),
    /// On a border where no root of its edge is known.
    AtBorder(usize, super::sheet::Border),
    /// Where it began.
    Closed,
    /// Beyond where anything is wanted.
    Outside,
    /// Where the sheets touch.
    Tangent,
}

impl Branch {
    pub(super) fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    pub(super) fn is_closed(&self) -> bool {
        self.ends[0] == End::Closed
    }

    /// The node at its start (0) or end (1).
    pub(super) fn end(&self, which: usize) -> &Node {
        &self.nodes[which * (self.nodes.len() - 1)]
    }

    /// Number of pieces.
    pub(super) fn pieces(&self) -> usize {
        self.nodes.len() - 1
    }

    pub(super) fn control(&self, piece: usize) -> [[f64; PARTS]; 6] {
        let length = self.lengths[piece + 1] - self.lengths[piece];
        control(&self.nodes[piece], &self.nodes[piece + 1], length)
    }

    /// The control points of the images of a piece on both sheets.
    pub(super) fn images(&self, piece: usize) -> [[f64; 4]; 6] {
        let length = self.lengths[piece + 1] - self.lengths[piece];
        control_of(
            &self.nodes[piece],
            &self.nodes[piece + 1],
            length,
            SHEETS[0],
        )
    }

    /// Parameters as fractions of a piece's length.
    pub(super) fn fractions(&self, piece: usize, range: [f64; 2]) -> [f64; 2] {
        let start = self.lengths[piece];
        let length = self.lengths[piece + 1] - start;
        range.map(|t| ((t - start) / length).clamp(0.0, 1.0))
    }

    fn locate(&self, t: f64) -> (usize, f64) {
        let inner = &self.lengths[1..self.lengths.len() - 1];
        let piece = inner.partition_point(|length| *length <= t);
        let (from, to) = (self.lengths[piece], self.lengths[piece + 1]);
        (piece, (t - from) / (to - from))
    }

    pub(super) fn value(&self, t: f64) -> [f64; PARTS] {
        let (piece, s) = self.locate(t);
        at(&self.control(piece), s)
    }

    /// The point, and its derivative by arc length.
    pub(super) fn in_space(&self, t: f64) -> [DVec3; 2] {
        self.both(t, SPACE).map(DVec3::from_array)
    }

    /// The place on one of its sheets, and its derivative by arc length.
    pub(super) fn image(&self, side: usize, t: f64) -> [DVec2; 2] {
        self.both(t, SHEETS[side]).map(DVec2::from_array)
    }

    /// The piece that holds a parameter, on one of its sheets.
    pub(super) fn piece_on(&self, side: usize, t: f64) -> PieceOn {
        let piece = self.locate(t).0;
        let range = [self.lengths[piece], self.lengths[piece + 1]];
        let (a, b) = (&self.nodes[piece], &self.nodes[piece + 1]);
        PieceOn {
            points: control_of(a, b, range[1] - range[0], SHEETS[side]),
            range,
        }
    }

    /// Value and derivative by arc length of `K` parts from the `first` on.
    fn both<const K: usize>(&self, t: f64, first: usize) -> [[f64; K]; 2] {
        let (piece, s) = self.locate(t);
        let length = self.lengths[piece + 1] - self.lengths[piece];
        let points = control_of(&self.nodes[piece], &self.nodes[piece + 1], length, first);
        [at(&points, s), slope(&points, s).map(|d| d / length)]
    }

    /// Makes a point of the exact curve a node, unless it is beside one.
    pub(super) fn insert(&mut self, t: f64, node: Node) {
        let (piece, s) = self.locate(t);
        if (BESIDE..1.0 - BESIDE).contains(&s) {
            self.nodes.insert(piece + 1, node);
            self.lengths.insert(piece + 1, t);
        }
    }

    /// The parameter of the nearest point to one that lies near the branch, and its distance.
    pub(super) fn project(&self, p: DVec3) -> (f64, f64) {
        self.nearest(p, f64::INFINITY)
            .unwrap_or((0.0, f64::INFINITY))
    }

    /// The parameter of the nearest point to one, and its distance, if that is less than a given one.
    pub(super) fn nearest(&self, p: DVec3, within: f64) -> Option<(f64, f64)> {
        self.nearest_of(0..self.pieces(), p, within)
    }

    /// The same of some pieces.
    pub(super) fn nearest_of(
        &self,
        pieces: Range<usize>,
        p: DVec3,
        within: f64,
    ) -> Option<(f64, f64)> {
        let mut best = (f64::NAN, within);
        for piece in pieces {
            let length = self.lengths[piece + 1] - self.lengths[piece];
            let from = self.nodes[piece].point();
            let reach = best.1 + 1.5 * length;
            if from.distance_squared(p) > reach * reach {
                continue;
            }
            let (s, distance) = project(&self.nodes[piece], &self.nodes[piece + 1], length, p);
            if distance < best.1 {
                best = (self.lengths[piece] + s * length, distance);
            }
        }
        (best.1 < within).then_some(best)
    }

    /// The pieces that hold a range of parameters, as flat knots and control points: C2, knots of multiplicity 3.
    pub(super) fn spline(&self, range: [f64; 2]) -> (Vec<f64>, Vec<[f64; PARTS]>) {
        let first = self.locate(range[0]).0;
        let end = self.locate(range[1]).0 + 1;
        // A range that ends at a node needs no piece beyond it.
        let last = if end - 1 > first && self.lengths[end - 1] >= range[1] {
            end - 1
        } else {
            end
        };
        let mut knots = vec![self.lengths[first]; 6];
        for length in &self.lengths[first + 1..last] {
            knots.extend([*length; 3]);
        }
        knots.extend([self.lengths[last]; 6]);
        let mut points = Vec::with_capacity(3 * (last + 1 - first));
        for i in first..=last {
            let back = if i > first {
                self.lengths[i - 1] - self.lengths[i]
            } else {
                0.0
            };
            let ahead = if i < last {
                self.lengths[i + 1] - self.lengths[i]
            } else {
                0.0
            };
            // Blossoms of the node's Taylor polynomial at the knots around it.
            let arguments = if i == first {
                [
                    [0.0; 5],
                    [0.0, 0.0, 0.0, 0.0, ahead],
                    [0.0, 0.0, 0.0, ahead, ahead],
                ]
            } else if i == last {
                [
                    [back, back, 0.0, 0.0, 0.0],
                    [back, 0.0, 0.0, 0.0, 0.0],
                    [0.0; 5],
                ]
            } else {
                [
                    [back, back, 0.0, 0.0, 0.0],
                    [back, 0.0, 0.0, 0.0, ahead],
                    [0.0, 0.0, 0.0, ahead, ahead],
                ]
            };
            points.extend(arguments.map(|at| blossom(&self.nodes[i], at)));
        }
        (knots, points)
    }
}

/// The symmetric multi-affine form of a node's quadratic Taylor polynomial, taken as one of degree 5.
fn blossom(node: &Node, at: [f64; 5]) -> [f64; PARTS] {
    let sum: f64 = at.iter().sum();
    let squares: f64 = at.iter().map(|x| x * x).sum();
    let first = sum / 5.0;
    let second = (sum * sum - squares) / 2.0 / 10.0;
    std::array::from_fn(|i| node.value[i] + first * node.first[i] + 0.5 * second * node.second[i])
}

/// The fraction of a piece that is nearest to a point, and its distance.
pub(super) fn project(a: &Node, b: &Node, length: f64, p: DVec3) -> (f64, f64) {
    let points = control_of(a, b, length, SPACE);
    let chord = b.point() - a.point();
    let mut s = ((p - a.point()).dot(chord) / chord.length_squared()).clamp(0.0, 1.0);
    for _ in 0..8 {
        let here = DVec3::from_array(at(&points, s));
        let along = DVec3::from_array(slope(&points, s));
        let step = (p - here).dot(along) / along.length_squared();
        let next = (s + step).clamp(0.0, 1.0);
        if (next - s).abs() < 1e-15 {
            break;
        }
        s = next;
    }
    (s, DVec3::from_array(at(&points, s)).distance(p))
}
