//! The outline of a face in the plane of its parameters, by its true curves: whether a place lies within it.
//!
//! A ray crosses a Bézier piece as often, up to an even number, as its ends say, if the hull of its control points lies
//! beyond the place; so nothing is solved, and only pieces whose hull holds the place are halved. What is still there when it is
//! smaller than a given slack is the border itself: no answer.

use glam::{DVec2, DVec4};

use super::spline::Net;

/// Halvings of one piece until its hull is as small as rounding.
const MOST_HALVINGS: usize = 60;
/// Pieces this much smaller than an outline are straight, where points inside of it are looked for.
const STRAIGHT: f64 = 1e-4;

/// All loops of a face.
#[derive(Clone, Debug, Default)]
pub(super) struct Outline {
    pieces: Vec<Piece>,
    /// Where each piece is: most are told by that alone.
    hulls: Vec<Hull>,
    low: DVec2,
    high: DVec2,
}

/// The box of a piece, and the heights of its ends.
#[derive(Clone, Copy, Debug)]
struct Hull {
    low: DVec2,
    high: DVec2,
    ends: [f64; 2],
}

/// A rational Bézier piece, `(w x, w y, ·, w)`.
#[derive(Clone, Debug)]
struct Piece {
    net: Net,
    low: DVec2,
    high: DVec2,
}

fn flat(h: DVec4) -> DVec2 {
    DVec2::new(h.x, h.y) / h.w
}

impl Piece {
    fn new(net: Net) -> Self {
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = net.iter().map(|h| flat(*h)).fold(empty, |(low, high), p| {
            (low.min(p), high.max(p))
        });
        Self { net, low, high }
    }

    fn ends(&self) -> [DVec2; 2] {
        [flat(self.net[0]), flat(self.net[self.net.len() - 1])]
    }

    fn hull(&self) -> Hull {
        Hull {
            low: self.low,
            high: self.high,
            ends: self.ends().map(|end| end.y),
        }
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
        [low, high].map(Self::new)
    }
}

impl Hull {
    /// Whether its ends lie on different sides of a height.
    fn passes(&self, y: f64) -> bool {
        (self.ends[0] > y) != (self.ends[1] > y)
    }

    /// Whether a ray from a place towards growing x crosses the piece an odd number of times, if that is clear.
    fn crossed(&self, at: DVec2, slack: DVec2) -> Option<bool> {
        if at.y < self.low.y - slack.y
            || at.y > self.high.y + slack.y
            || at.x > self.high.x + slack.x
        {
            return Some(false);
        }
        if at.x < self.low.x - slack.x {
            return Some(self.passes(at.y));
        }
        None
    }
}

impl Outline {
    /// Adds a loop of pieces, each beginning where the last one ends; returns how far apart they were at most (in the plane).
    pub(super) fn add(&mut self, pieces: Vec<Net>) -> f64 {
        let Some(last) = pieces.last() else { return 0.0 };
        let mut from = flat(last[last.len() - 1]);
        let mut most: f64 = 0.0;
        for mut net in pieces {
            // What rounding leaves between two pieces would be a hole in the outline.
            most = most.max(from.distance(flat(net[0])));
            let (w, z) = (net[0].w, net[0].z);
            net[0] = DVec4::new(from.x * w, from.y * w, z, w);
            from = flat(net[net.len() - 1]);
            let piece = Piece::new(net);
            self.hulls.push(piece.hull());
            self.pieces.push(piece);
        }
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        (self.low, self.high) = self.pieces.iter().fold(empty, |(low, high), piece| {
            (low.min(piece.low), high.max(piece.high))
        });
        most
    }

    /// The corners of a box that holds it.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        (self.low, self.high)
    }

    /// Whether it holds a place; `None` if that is nearer to its border than the slack.
    pub(super) fn holds(&self, at: DVec2, slack: DVec2) -> Option<bool> {
        let beyond = at.cmplt(self.low - slack).any() || at.cmpgt(self.high + slack).any();
        if beyond {
            return Some(false);
        }
        let mut inside = false;
        let mut stack: Vec<(Piece, usize)> = Vec::new();
        for (piece, hull) in self.pieces.iter().zip(&self.hulls) {
            match hull.crossed(at, slack) {
                Some(crossed) => inside ^= crossed,
                None => stack.push((piece.clone(), 0)),
            }
            while let Some((piece, halvings)) = stack.pop() {
                let is_border = (piece.high - piece.low).cmple(slack).all();
                if is_border || halvings == MOST_HALVINGS {
                    return None;
                }
                for half in piece.halves() {
                    match half.hull().crossed(at, slack) {
                        Some(crossed) => inside ^= crossed,
                        None => stack.push((half, halvings + 1)),
                    }
                }
            }
        }
        Some(inside)
    }

    /// The middle of the widest gap within it at a height, with the gap's width.
    pub(super) fn widest(&self, y: f64) -> Option<(DVec2, f64)> {
        let small = STRAIGHT * (self.high - self.low);
        let mut crossings: Vec<f64> = Vec::new();
        let mut stack: Vec<(Piece, usize)> = Vec::new();
        for piece in &self.pieces {
            if y >= piece.low.y && y <= piece.high.y {
                stack.push((piece.clone(), 0));
            }
            while let Some((piece, halvings)) = stack.pop() {
                if y < piece.low.y || y > piece.high.y {
                    continue;
                }
                let size = piece.high - piece.low;
                if size.cmple(small).all() || halvings == MOST_HALVINGS {
                    let [a, b] = piece.ends();
                    if piece.hull().passes(y) {
                        crossings.push(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
                    }
                    continue;
                }
                stack.extend(piece.halves().map(|half| (half, halvings + 1)));
            }
        }
        crossings.sort_by(f64::total_cmp);
        crossings
            .chunks_exact(2)
            .map(|gap| (DVec2::new(0.5 * (gap[0] + gap[1]), y), gap[1] - gap[0]))
            .max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    /// A unit circle in four rational quadratics, as a loop.
    fn circle(middle: DVec2, radius: f64) -> Vec<Net> {
        let w = 0.5_f64.sqrt();
        let corner = |k: usize| {
            let all = [
                (1.0, 0.0),
                (1.0, 1.0),
                (0.0, 1.0),
                (-1.0, 1.0),
                (-1.0, 0.0),
                (-1.0, -1.0),
                (0.0, -1.0),
                (1.0, -1.0),
            ];
            let (x, y) = all[k % 8];
            let w = if k % 2 == 0 { 1.0 } else { w };
            let p = middle + radius * DVec2::new(x, y);
            DVec4::new(p.x * w, p.y * w, 0.0, w)
        };
        (0..4)
            .map(|k| (0..3).map(|i| corner(2 * k + i)).collect())
            .collect()
    }

    #[test]
    fn a_ring_holds_what_its_equation_says_and_is_silent_on_its_border() {
        let mut ring = Outline::default();
        assert!(ring.add(circle(DVec2::new(3.0, 1.0), 2.0)) < 1e-15);
        assert!(ring.add(circle(DVec2::new(2.5, 1.0), 0.7)) < 1e-15);
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
        let (middle, width) = ring.widest(1.0 + 1e-7).unwrap();
        assert!((middle.x - 4.1).abs() < 1e-3 && (width - 1.8).abs() < 1e-3);
    }
}
