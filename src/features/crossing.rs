//! Plane curves that cross themselves.
//!
//! A curve is cut into pieces whose control polygons run one way: such a piece meets each line across that way once (variation
//! diminishes, with weights above 0 too), so it never crosses itself. Two pieces are compared by the boxes of their control
//! points, halved until these are apart or too small to be told apart.

use glam::DVec2;

use crate::nurbs::Curve;

/// Halvings until a piece must run one way: what still turns back then stops and turns there.
const TURNS: usize = 24;
/// Halvings until two pieces must be apart.
const HALVINGS: usize = 32;
/// How near pieces may come, as a fraction of the size of a section.
const NEAR: f64 = 1e-9;
/// Less than a half turn by this angle (rad) is told from a reversal.
const REVERSAL: f64 = 1e-6;
/// Pieces of a curve at least, so that no two of a closed one meet at both ends.
const LEAST: usize = 4;

/// The parameters of two places at which a plane curve (z is not asked) meets itself, the same twice where it stops and turns.
/// Of a closed curve the ends do not count.
pub(super) fn crossing(curves: &[Curve], is_closed: bool) -> Option<[(usize, f64); 2]> {
    let mut pieces = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        for segment in curve.bezier_segments() {
            let segment = Piece {
                index,
                curve: segment,
            };
            if let Err(at) = one_way(segment, TURNS, &mut pieces) {
                return Some([(index, at); 2]);
            }
        }
    }
    while pieces.len() < LEAST {
        pieces = pieces.iter().flat_map(Piece::halves).collect();
    }
    let last = pieces.len() - 1;
    for (i, one) in pieces.iter().enumerate() {
        for (j, other) in pieces.iter().enumerate().skip(i + 1) {
            let found = if j == i + 1 {
                after(one, other, HALVINGS)
            } else if is_closed && i == 0 && j == last {
                after(other, one, HALVINGS)
            } else {
                apart(one, other, HALVINGS)
            };
            if found.is_some() {
                return found;
            }
        }
    }
    None
}

/// A Bézier piece of one of several curves.
#[derive(Clone)]
struct Piece {
    index: usize,
    curve: Curve,
}

impl Piece {
    fn middle(&self) -> f64 {
        let (from, to) = self.curve.domain();
        f64::midpoint(from, to)
    }

    fn place(&self) -> (usize, f64) {
        (self.index, self.middle())
    }

    fn halves(&self) -> Vec<Self> {
        let of = |curve| Self {
            index: self.index,
            curve,
        };
        match self.curve.split(self.middle()) {
            Ok((one, other)) => vec![of(one), of(other)],
            // Too short to have a middle.
            Err(_) => vec![self.clone()],
        }
    }

    fn legs(&self) -> impl Iterator<Item = DVec2> {
        let points = self.curve.points();
        points
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).truncate())
            .filter(|leg| *leg != DVec2::ZERO)
    }

    fn is_apart(&self, other: &Self) -> bool {
        let [(a, b), (c, d)] = [&self.curve, &other.curve].map(Curve::bounds);
        let gap = (c - b).max(a - d).truncate();
        gap.max_element() > NEAR
    }
}

/// Whether all legs are within less than a half turn.
fn run_one_way(mut legs: impl Iterator<Item = DVec2>) -> bool {
    let Some(first) = legs.next() else {
        return true;
    };
    let (low, high) = legs.fold((0.0_f64, 0.0_f64), |(low, high), leg| {
        let turn = first.angle_to(leg);
        (low.min(turn), high.max(turn))
    });
    high - low < std::f64::consts::PI - REVERSAL
}

/// Cuts a piece into some that run one way; the parameter where it does not, however short.
fn one_way(piece: Piece, depth: usize, found: &mut Vec<Piece>) -> Result<(), f64> {
    if run_one_way(piece.legs()) {
        found.push(piece);
        return Ok(());
    }
    if depth == 0 {
        return Err(piece.middle());
    }
    piece
        .halves()
        .into_iter()
        .try_for_each(|half| one_way(half, depth - 1, found))
}

/// Where two pieces that are no neighbours meet.
fn apart(one: &Piece, other: &Piece, depth: usize) -> Option<[(usize, f64); 2]> {
    if one.is_apart(other) {
        return None;
    }
    if depth == 0 {
        return Some([one.place(), other.place()]);
    }
    let others = other.halves();
    one.halves()
        .iter()
        .find_map(|half| others.iter().find_map(|own| apart(half, own, depth - 1)))
}

/// Where two pieces of which one begins where the other ends meet besides.
fn after(one: &Piece, other: &Piece, depth: usize) -> Option<[(usize, f64); 2]> {
    if run_one_way(one.legs().chain(other.legs())) {
        return None;
    }
    if depth == 0 {
        return Some([one.place(), other.place()]);
    }
    let (ones, others) = (one.halves(), other.halves());
    let ([.., near], [next, ..]) = (ones.as_slice(), others.as_slice()) else {
        return None;
    };
    let far = ones[..ones.len() - 1]
        .iter()
        .find_map(|half| others.iter().find_map(|own| apart(half, own, depth - 1)));
    far.or_else(|| {
        others[1..]
            .iter()
            .find_map(|own| apart(near, own, depth - 1))
    })
    .or_else(|| after(near, next, depth - 1))
}
