//! Whether a known curve is all that two patches have in common: the certificate that no other one is missed there.
//!
//! Let P and Q be two common points of patches a(u, v) and b(s, t). Along the straight lines between their parameters the chord is
//! `Q − P = Δu Ū + Δv V̄ = Δs S̄ + Δt T̄`, with means of the tangents on these lines. Were Δu = 0, then `Δv V̄` would be normal
//! to `S̄ × T̄`. So where **no tangent of a along v lies in a tangent plane of b** (`V · (S × T)` has one sign for all V, S and T,
//! not of one place only) u grows, or falls, along all chords: to each u there is one common point at most. There is no loop then, and
//! no second curve beside one; likewise for v, s and t. Where several parameters are so, their orders agree: products of the
//! chord with `V̄ × T̄` give `Δu (T̄ · Ū × V̄) = −Δs (V̄ · S̄ × T̄)`.
//!
//! There may be another curve behind a curve's end, where it leaves a patch and comes back. Where it leaves through u = const, and u is
//! such a parameter, there is not: behind that end u would go on beyond the patch. If both ends are so, the curve is alone. Else
//! the halves of the patches are asked, whose tangents and normals vary less.
//!
//! Signs are told from cones, or, where sheets are nearly parallel, from slopes. With normals as `up + slope`, V̄ is normal to its own
//! one, and so `V̄ · (S̄ × T̄)` is V̄ along the *difference* of the slopes; that may have a sign where either varies by more.

use glam::DVec3;

use super::facet::Facet;
use super::hermite::{self, Branch, End, Node};
use super::patch::{Cones, slopes};

/// How far beyond a patch its border still is, as a fraction of its parameters: curves may run along borders.
pub(super) const BORDER: f64 = 1e-9;
/// And beyond a sheet: ends of curves are computed.
const END: f64 = 1e-12;
/// Bisections for where a curve leaves a patch.
const BISECTIONS: usize = 8;
/// What rounding, and the border, may add to the sine of an angle.
const ROUNDING: f64 = 1e-7;
/// And to the slope of nearly parallel sheets against each other.
const ROUNDING_OF_SLOPES: f64 = 1e-9;
/// Where curves beside patches count, directions there do, too: by so much cones are wider.
const WIDER: f64 = 4.0;
/// And legs may turn by this sine.
const BESIDE_OF_LEGS: f64 = 1e-3;

/// Ranges of the four parameters on two patches.
pub(super) type Ranges = [[f64; 2]; 4];

/// The parameters of which each grows, or falls, along all chords of common points of two patches.
pub(super) struct Chords {
    ranges: Ranges,
    /// By how much the ranges are wider than the patches.
    slack: f64,
    is_monotone: [bool; 4],
}

impl Chords {
    /// Of two patches, and of a little around them as a fraction of their parameters; `None` if no parameter is known to be one.
    pub(super) fn new(a: &Facet, b: &Facet, slack: f64) -> Option<Self> {
        let is_monotone = by_cones([a, b].map(|facet| *facet.cones()), slack);
        Self::with(is_monotone, [a, b], slack)
    }

    /// Of two patches one of which goes on behind a border: with the cones of all of both, and [how far](reach) they go on.
    pub(super) fn going_on(cones: [Cones; 2], slack: f64, ranges: Ranges) -> Option<Self> {
        let is_monotone = by_cones(cones, slack);
        (is_monotone != [false; 4]).then_some(Self {
            ranges,
            slack: BORDER,
            is_monotone,
        })
    }

    /// The same by slopes: for sheets that are nearly parallel.
    pub(super) fn of_slopes(frame: &Frame, a: &Facet, b: &Facet, slack: f64) -> Option<Self> {
        let is_monotone = by_slopes(frame, [a, b], slack)?;
        Self::with(is_monotone, [a, b], slack)
    }

    fn with(is_monotone: [bool; 4], [a, b]: [&Facet; 2], slack: f64) -> Option<Self> {
        if is_monotone == [false; 4] {
            return None;
        }
        Some(Self {
            ranges: ranges([a, b], slack),
            slack,
            is_monotone,
        })
    }

    /// Whether a curve that passes through the patches at a parameter of its own is all that they have in common; with the
    /// lengths of the sheets' parameters.
    pub(super) fn has_only(&self, branch: &Branch, t: f64, lengths: [f64; 4]) -> bool {
        self.holds(&parameters(branch, t))
            && self.ends(branch, t, true, lengths)
            && self.ends(branch, t, false, lengths)
    }

    fn beyond(&self, q: &[f64; 4]) -> [bool; 4] {
        beyond(&self.ranges, q)
    }

    fn holds(&self, q: &[f64; 4]) -> bool {
        hold(&self.ranges, q)
    }

    /// Whether nothing lies behind the end of a curve's part in the patches, one way from a place in it.
    fn ends(&self, branch: &Branch, from: f64, forward: bool, lengths: [f64; 4]) -> bool {
        let pieces = branch.pieces();
        let mut piece = if forward {
            let after = branch.lengths.partition_point(|length| *length <= from);
            after.saturating_sub(1)
        } else {
            let before = branch.lengths.partition_point(|length| *length < from);
            before.min(pieces)
        };
        // From here on `piece` is the next one, or behind the last one, in the direction of the walk.
        let mut inside = from;
        for _ in 0..=pieces {
            let is_last = if forward { piece == pieces } else { piece == 0 };
            if is_last {
                match branch.ends[usize::from(forward)] {
                    End::Closed => {
                        (piece, inside) = if forward {
                            (0, 0.0)
                        } else {
                            (pieces, branch.length())
                        };
                        continue;
                    }
                    // On the border of its sheet, or of what is followed. What is behind a contact is not known.
                    End::AtRoot(_) | End::AtBorder(..) | End::Outside => {
                        return self.ends_at(branch.end(usize::from(forward)), forward, lengths);
                    }
                    End::Tangent => return false,
                }
            }
            let (at, node) = if forward {
                (piece, piece + 1)
            } else {
                (piece - 1, piece - 1)
            };
            let range = [inside, branch.lengths[node]];
            if !self.holds(&branch.nodes[node].parameters()) {
                return self.leaves(branch, at, range);
            }
            if !self.keeps(&branch.images(at), branch.fractions(at, range), [true; 4]) {
                return false;
            }
            inside = range[1];
            piece = if forward { piece + 1 } else { piece - 1 };
        }
        false
    }

    /// Whether a curve leaves through a border behind which nothing lies, on a piece of it between a place inside and one outside.
    fn leaves(&self, branch: &Branch, piece: usize, range: [f64; 2]) -> bool {
        let images = branch.images(piece);
        let [mut inside, mut outside] = branch.fractions(piece, range);
        let is_free = self.is_monotone.map(|is_monotone| !is_monotone);
        let mut beyond = self.beyond(&hermite::at(&images, outside));
        for _ in 0..BISECTIONS {
            // Of the others none may leave and come back before.
            if (0..4).all(|k| !beyond[k] || self.is_monotone[k])
                && self.keeps(&images, [inside, outside], is_free)
            {
                return true;
            }
            let middle = 0.5 * (inside + outside);
            let there = self.beyond(&hermite::at(&images, middle));
            if there == [false; 4] {
                if !self.keeps(&images, [inside, middle], [true; 4]) {
                    return false;
                }
                inside = middle;
            } else {
                (outside, beyond) = (middle, there);
            }
        }
        false
    }

    /// Whether some parameters stay in their ranges on a part of a piece, by its control points.
    fn keeps(&self, images: &[[f64; 4]; 6], part: [f64; 2], which: [bool; 4]) -> bool {
        let part = [part[0].min(part[1]), part[0].max(part[1])];
        let images = hermite::part(images, part);
        let holds = |k: usize| {
            let [low, high] = self.ranges[k];
            images.iter().all(|q| low <= q[k] && q[k] <= high)
        };
        (0..4).all(|k| !which[k] || holds(k))
    }

    /// Whether a curve's end on a border of its sheet has nothing behind it: a parameter that grows along all chords ends there,
    /// too, the way that the curve goes.
    fn ends_at(&self, end: &Node, forward: bool, lengths: [f64; 4]) -> bool {
        let q = end.parameters();
        (0..4).any(|k| {
            let [low, high] = self.ranges[k];
            let near = (3.0 * self.slack * (high - low)).max(END * lengths[k]);
            let grows = (end.first[3 + k] > 0.0) == forward;
            let left = if grows { high - q[k] } else { q[k] - low };
            self.is_monotone[k] && left <= near
        })
    }
}

/// The ranges of two patches, and of a little around them as a fraction of their parameters.
fn ranges([a, b]: [&Facet; 2], slack: f64) -> Ranges {
    let (a, b) = (&a.patch, &b.patch);
    [a.u, a.v, b.u, b.v].map(|[low, high]| {
        let more = slack * (high - low);
        [low - more, high + more]
    })
}

/// The same of two patches one of which goes on behind a border, where one of the four parameters ends. Of the other
/// parameters a little around the patches counts, too, as far as their polynomials reach.
pub(super) fn reach(
    facets: [&Facet; 2],
    (parameter, end): (usize, f64),
    slack: f64,
    polynomials: Ranges,
) -> Ranges {
    let mut ranges = ranges(facets, BORDER);
    for (k, range) in ranges.iter_mut().enumerate() {
        let more = slack * (range[1] - range[0]);
        let ends = if k == parameter {
            [end, end]
        } else {
            let [low, high] = polynomials[k];
            [(range[0] - more).max(low), (range[1] + more).min(high)]
        };
        *range = [range[0].min(ends[0]), range[1].max(ends[1])];
    }
    ranges
}

/// The four parameters of a curve at its own.
pub(super) fn parameters(branch: &Branch, t: f64) -> [f64; 4] {
    let value = branch.value(t);
    std::array::from_fn(|k| value[3 + k])
}

/// Which parameters are beyond their ranges; written so that NaN is.
fn beyond(ranges: &Ranges, q: &[f64; 4]) -> [bool; 4] {
    std::array::from_fn(|k| !(ranges[k][0] <= q[k] && q[k] <= ranges[k][1]))
}

/// Whether ranges hold parameters.
pub(super) fn hold(ranges: &Ranges, q: &[f64; 4]) -> bool {
    beyond(ranges, q) == [false; 4]
}

/// By how much cones are wider where curves a little beside patches count.
fn wider(slack: f64) -> f64 {
    if slack > BORDER { WIDER } else { 1.0 }
}

fn by_cones(cones: [Cones; 2], slack: f64) -> [bool; 4] {
    let wider = wider(slack);
    std::array::from_fn(|k| {
        let (side, axis) = (k / 2, k % 2);
        let tangent = cones[side].tangents[1 - axis];
        let normal = cones[1 - side].normals;
        let own = cones[side].normals;
        match (own, tangent, normal) {
            (Some(_), Some((tangent, width)), Some((normal, lean))) => {
                tangent.dot(normal).abs() > wider * (width + lean) + ROUNDING
            }
            _ => false,
        }
    })
}

/// Directions against which normals of nearly parallel patches slope.
pub(super) struct Frame {
    upright: DVec3,
    /// From normals of one patch to those of the other.
    along: DVec3,
}

impl Frame {
    /// Of two patches; `None` if normals at their corners tell that none of their parameters would be found so.
    pub(super) fn of(a: &Facet, b: &Facet) -> Option<Self> {
        let [(one, _), (other, _)] = [a.cones().normals?, b.cones().normals?];
        let other = if one.dot(other) < 0.0 { -other } else { other };
        let upright = (one + other).try_normalize()?;
        let along = (one - other).try_normalize()?;
        let [own, others] = [a, b].map(|facet| facet.patch.corner_slopes(along, upright));
        let (own, others) = (own?, others?);
        (own[0] > others[1] || others[0] > own[1]).then_some(Self { upright, along })
    }
}

fn by_slopes(
    &Frame { upright, along }: &Frame,
    facets: [&Facet; 2],
    slack: f64,
) -> Option<[bool; 4]> {
    let across = upright.cross(along);
    let wider = wider(slack) - 1.0;
    let legs = facets.map(|facet| facet.patch.legs());
    // How the slopes differ along a direction.
    let difference = |direction: DVec3| {
        let [own, other] = [0, 1].map(|side| slopes(&legs[side], direction, upright));
        let ([low, high], [least, most]) = (own?, other?);
        let more = 0.5 * wider * ((high - low) + (most - least));
        Some([low - most - more, high - least + more])
    };
    let apart = difference(along)?;
    if apart[0] <= 0.0 && apart[1] >= 0.0 {
        return None;
    }
    let difference = [apart, difference(across)?];
    let steepest = difference
        .as_flattened()
        .iter()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    let rounding = ROUNDING_OF_SLOPES + wider * BESIDE_OF_LEGS * steepest;
    let has_sign = |legs: &[DVec3]| {
        let mut sign = 0.0;
        // Vanishing legs say nothing.
        let mut legs = legs.iter().filter(|leg| **leg != DVec3::ZERO);
        legs.all(|leg| {
            let leg = [leg.dot(along), leg.dot(across)];
            let least = rounding * leg[0].hypot(leg[1]);
            difference[0].iter().all(|x| {
                difference[1].iter().all(|y| {
                    let turn = leg[0] * x + leg[1] * y;
                    if sign == 0.0 {
                        sign = turn.signum();
                    }
                    // Written so that NaN fails too.
                    sign * turn > least
                })
            })
        })
    };
    let mut is_monotone = [false; 4];
    for (side, [u, v]) in legs.iter().enumerate() {
        is_monotone[2 * side] = has_sign(v);
        is_monotone[2 * side + 1] = has_sign(u);
    }
    Some(is_monotone)
}

#[cfg(test)]
#[path = "alone_tests.rs"]
mod tests;
