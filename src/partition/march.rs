//! Following an intersection curve: steps along its tangent, each corrected by Newton's method and kept only
//! if the piece that it adds stays on both sheets.

use glam::DVec3;

use super::bounds::Bounds;
use super::crossings::MATCH;
use super::hermite::{self, Branch, End, Node, PARTS};
use super::pair::{Closing, Pair};
use super::sheet::Border;

/// Most steps of one branch.
const MOST_STEPS: usize = 20_000;
/// Where a piece is measured while it is tried, in fractions of its length.
const TRIED: [f64; 3] = [0.25, 0.5, 0.75];
/// Where else a piece is measured once it is taken.
const TAKEN: [f64; 4] = [0.125, 0.375, 0.625, 0.875];
/// Smallest step, as a fraction of the domain's size.
const LEAST_STEP: f64 = 1e-8;
/// First step, as a fraction of the domain's size.
const FIRST_STEP: f64 = 1e-3;

/// Follows the curves of one pair of sheets within a box.
pub(super) struct March<'a> {
    pub(super) pair: Pair<'a>,
    /// Beyond this box curves are not followed.
    pub(super) far: Bounds,
    /// Beyond this box nobody asks where a curve ends.
    pub(super) clip: Bounds,
    /// Where edges of one sheet pass through the other: a branch ends there, even where a long step would
    /// leave the sheet and come back to it.
    pub(super) stops: Vec<Stop>,
}

/// A known end of branches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    pub(super) point: DVec3,
    pub(super) q: [f64; 4],
    pub(super) side: usize,
    pub(super) border: Border,
}

/// One direction's worth of nodes after the start, with the lengths between them.
struct Run {
    nodes: Vec<Node>,
    lengths: Vec<f64>,
    /// Farthest of any piece from the sheets.
    deviation: f64,
    end: End,
}

/// A piece of a curve from where it is followed: its end, its length, and its deviation where it is tried.
struct Piece {
    node: Node,
    length: f64,
    deviation: f64,
}

impl Piece {
    /// Its end as the place to go on from, `before` being its start.
    fn place(&self, before: &Node) -> Place {
        let rate = |i: usize| (self.node.second[i] - before.second[i]) / self.length;
        let third = if self.length > 0.0 {
            std::array::from_fn(rate)
        } else {
            [0.0; PARTS]
        };
        Place {
            node: self.node,
            third,
        }
    }
}

/// Where a curve is followed on from.
struct Place {
    node: Node,
    /// About the third derivative by arc length, from the piece before: it makes guesses better.
    third: [f64; PARTS],
}

enum Step {
    To(Piece, Option<(usize, Border)>),
    Closes(Piece),
    Stuck,
}

impl March<'_> {
    /// The whole branch through a point inside both sheets.
    pub(super) fn through(&self, start: Node) -> Option<Branch> {
        let forward = self.run(start, start);
        if forward.end == End::Closed {
            let ends = [End::Closed; 2];
            return Some(branch(vec![start], vec![], 0.0, forward, ends));
        }
        let back = self.run(start.reversed(), start);
        let ends = [back.end, forward.end];
        let nodes: Vec<Node> = back
            .nodes
            .iter()
            .rev()
            .map(|node| node.reversed())
            .collect();
        let lengths: Vec<f64> = back.lengths.iter().rev().copied().collect();
        let nodes = [nodes, vec![start]].concat();
        Some(branch(nodes, lengths, back.deviation, forward, ends))
            .filter(|branch| branch.nodes.len() > 1)
    }

    /// The branch that starts at a root on a border and runs inwards.
    pub(super) fn inwards_from(&self, start: Node, root: usize) -> Option<Branch> {
        let run = self.run(start, start);
        let ends = [End::AtRoot(root), run.end];
        Some(branch(vec![start], vec![], 0.0, run, ends)).filter(|branch| branch.nodes.len() > 1)
    }

    fn run(&self, start: Node, origin: Node) -> Run {
        let mut run = Run {
            nodes: Vec::new(),
            lengths: Vec::new(),
            deviation: 0.0,
            end: End::Tangent,
        };
        let mut here = Place {
            node: start,
            third: [0.0; PARTS],
        };
        let mut step = FIRST_STEP * self.pair.tolerances.scale;
        for count in 0..MOST_STEPS {
            match self.advance(&here, &origin, &mut step, count) {
                Step::Stuck => return run,
                Step::Closes(piece) => {
                    self.take(&mut run, &here.node, &piece);
                    run.end = End::Closed;
                    return run;
                }
                Step::To(piece, border) => {
                    if let Some((piece, stop)) = self.stopped(&here.node, &piece) {
                        self.take(&mut run, &here.node, &piece);
                        run.end = End::AtBorder(stop.side, stop.border);
                        return run;
                    }
                    if piece.length > self.pair.tolerances.same * 0.01 {
                        self.take(&mut run, &here.node, &piece);
                    }
                    let wanted = self.clip.holds(piece.node.point());
                    if let Some((side, border)) = border {
                        let is_open = self.pair.sheets[side].open.contains(&border);
                        run.end = if wanted && !is_open {
                            End::AtBorder(side, border)
                        } else {
                            End::Outside
                        };
                        return run;
                    }
                    if !wanted && !self.far.holds(piece.node.point()) {
                        run.end = End::Outside;
                        return run;
                    }
                    here = piece.place(&here.node);
                }
            }
        }
        run
    }

    /// Adds a piece, measured once more between where it was tried.
    fn take(&self, run: &mut Run, here: &Node, piece: &Piece) {
        let between = self.pair.deviation(here, &piece.node, piece.length, &TAKEN);
        run.deviation = run.deviation.max(piece.deviation).max(between);
        run.nodes.push(piece.node);
        run.lengths.push(piece.length);
    }

    /// One accepted step; `step` is the length to try, and then the next one's.
    fn advance(&self, here: &Place, origin: &Node, step: &mut f64, count: usize) -> Step {
        let tolerances = &self.pair.tolerances;
        let (here, third) = (&here.node, &here.third);
        for _ in 0..40 {
            if *step < LEAST_STEP * tolerances.scale {
                return Step::Stuck;
            }
            let h = *step;
            let mut q = here.parameters();
            for (i, value) in q.iter_mut().enumerate() {
                let bend = here.second[3 + i] + h / 3.0 * third[3 + i];
                *value += h * (here.first[3 + i] + 0.5 * h * bend);
            }
            let (tangent, point) = (here.tangent(), here.point());
            let target = point + h * tangent + 0.5 * h * h * here.curvature();
            if !self.pair.newton(&mut q, Closing::Plane(tangent, target), 8) {
                *step *= 0.5;
                continue;
            }
            let border = match self.border(here, &mut q) {
                Crossing::None => None,
                Crossing::At(side, border) => Some((side, border)),
                Crossing::Failed => {
                    *step *= 0.5;
                    continue;
                }
            };
            let Some(node) = self.pair.node(q, Some(tangent)) else {
                *step *= 0.5;
                continue;
            };
            let chord = node.point() - point;
            let length = chord.length();
            if border.is_some() && length < 0.01 * tolerances.same {
                let piece = Piece {
                    node,
                    length: 0.0,
                    deviation: 0.0,
                };
                return Step::To(piece, border);
            }
            if chord.dot(tangent) < 0.8 * length || node.tangent().dot(tangent) < 0.7 {
                *step *= 0.5;
                continue;
            }
            let length = arc(here, &node);
            let deviation = self.pair.deviation(here, &node, length, &TRIED);
            let ratio = (tolerances.curve / deviation.max(1e-300)).powf(1.0 / 6.0);
            if !(deviation <= tolerances.curve) {
                *step = (0.7 * h).min(length.min(h) * (0.85 * ratio).max(0.25));
                continue;
            }
            if count > 1
                && let Some(closing) = self.closes(here, &node, length, origin)
            {
                return closing;
            }
            *step = length * (0.9 * ratio).clamp(0.5, 2.0);
            let piece = Piece {
                node,
                length,
                deviation,
            };
            return Step::To(piece, border);
        }
        Step::Stuck
    }

    /// The first known end that a piece passes through before its own end, with the piece up to there.
    fn stopped(&self, here: &Node, piece: &Piece) -> Option<(Piece, &Stop)> {
        let length = piece.length;
        let same = self.pair.tolerances.same;
        let passes = |stop: &'_ &Stop| {
            let reach = 1.5 * length;
            if stop.point.distance_squared(here.point()) > reach * reach {
                return None;
            }
            let (s, distance) = hermite::project(here, &piece.node, length, stop.point);
            let inside = s * length > 10.0 * same && (1.0 - s) * length > 10.0 * same;
            (inside && distance < MATCH * self.pair.tolerances.scale).then_some(s)
        };
        let first = self
            .stops
            .iter()
            .filter_map(|stop| passes(&stop).map(|s| (s, stop)))
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        let node = self.pair.node(first.1.q, Some(here.tangent()))?;
        let length = arc(here, &node);
        let deviation = self.pair.deviation(here, &node, length, &TRIED);
        let piece = Piece {
            node,
            length,
            deviation,
        };
        Some((piece, first.1))
    }

    /// Whether the piece from here to the next node passes through where the branch began.
    fn closes(&self, here: &Node, next: &Node, length: f64, origin: &Node) -> Option<Step> {
        let offset = origin.point() - here.point();
        if offset.length_squared() > 4.0 * length * length {
            return None;
        }
        let (s, distance) = hermite::project(here, next, length, origin.point());
        let near = distance < 1e3 * self.pair.tolerances.curve;
        // The same start may be given reversed.
        let end = if origin.tangent().dot(here.tangent()) < 0.0 {
            origin.reversed()
        } else {
            *origin
        };
        let at = hermite::at(&hermite::control(here, next, length), s);
        let same_place = (0..4).all(|i| {
            let at = at[3 + i];
            let sheet = self.pair.sheets[i / 2];
            (at - end.value[3 + i]).abs() < 1e-3 * sheet.length(i % 2)
        });
        if !(near && same_place && s > 0.0 && end.tangent().dot(here.tangent()) > 0.5) {
            return None;
        }
        let length = arc(here, &end);
        let tolerances = &self.pair.tolerances;
        if length < tolerances.same {
            return None;
        }
        let deviation = self.pair.deviation(here, &end, length, &TRIED);
        (deviation <= tolerances.curve).then_some(Step::Closes(Piece {
            node: end,
            length,
            deviation,
        }))
    }

    /// Pulls parameters beyond a border back onto it.
    fn border(&self, here: &Node, q: &mut [f64; 4]) -> Crossing {
        let from = here.parameters();
        let sheets = self.pair.sheets;
        // Where two landings cross a curve ends on both.
        let beside = if self.pair.lifted.is_some() {
            1e-9
        } else {
            1e-12
        };
        let overshoot = |q: &[f64; 4], except: Option<usize>| {
            let mut first: Option<(f64, usize, bool)> = None;
            for i in (0..4).filter(|i| Some(*i) != except) {
                let (sheet, axis) = (sheets[i / 2], i % 2);
                let slack = beside * sheet.length(axis);
                let high = q[i] > sheet.high(axis) + slack;
                if !high && q[i] >= sheet.low(axis) - slack {
                    continue;
                }
                let bound = if high {
                    sheet.high(axis)
                } else {
                    sheet.low(axis)
                };
                let part = (bound - from[i]) / (q[i] - from[i]);
                if first.is_none_or(|(least, _, _)| part < least) {
                    first = Some((part, i, high));
                }
            }
            first
        };
        let Some(mut crossing) = overshoot(q, None) else {
            return Crossing::None;
        };
        for _ in 0..4 {
            let (part, i, high) = crossing;
            let (sheet, axis) = (sheets[i / 2], i % 2);
            let bound = if high {
                sheet.high(axis)
            } else {
                sheet.low(axis)
            };
            let part = part.clamp(0.0, 1.0);
            let mut at: [f64; 4] = std::array::from_fn(|k| from[k] + part * (q[k] - from[k]));
            if !self.pair.newton(&mut at, Closing::Fixed(i, bound), 14) {
                return Crossing::Failed;
            }
            match overshoot(&at, Some(i)) {
                None => {
                    *q = at;
                    return Crossing::At(i / 2, Border::of(axis, high));
                }
                Some(earlier) => crossing = earlier,
            }
        }
        Crossing::Failed
    }
}

/// A branch of nodes that are known and those of a run that follows them.
fn branch(
    mut nodes: Vec<Node>,
    mut between: Vec<f64>,
    deviation: f64,
    run: Run,
    ends: [End; 2],
) -> Branch {
    nodes.extend(run.nodes);
    between.extend(run.lengths);
    let mut lengths = Vec::with_capacity(nodes.len());
    lengths.push(0.0);
    for (i, length) in between.iter().enumerate() {
        lengths.push(lengths[i] + length);
    }
    Branch {
        nodes,
        lengths,
        deviation: deviation.max(run.deviation),
        ends,
    }
}

enum Crossing {
    None,
    At(usize, Border),
    Failed,
}

/// Arc length between two nodes from chord and tangents, as on a circle.
fn arc(a: &Node, b: &Node) -> f64 {
    let chord = a.point().distance(b.point());
    let turn = a.tangent().dot(b.tangent()).clamp(-1.0, 1.0).acos();
    if turn < 1e-6 {
        chord
    } else {
        chord * (0.5 * turn) / (0.5 * turn).sin()
    }
}
