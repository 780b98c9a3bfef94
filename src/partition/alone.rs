//! Whether a known curve is all that two patches have in common: the certificate that no other one is missed there.
//!
//! Let P and Q be two common points of patches a and b. Along the straight line between their parameters on a, the chord is
//! `Q − P = Δu Ū + Δv V̄`, with means Ū and V̄ that lie in the cones of a's tangents; so it is normal to `Ū × V̄`, which lies in the cone
//! of a's normals, and likewise for b. Where no normals of a and b are parallel, all chords lie in one double cone around the product
//! of the axes: common points are ordered along it, and there is no second curve beside one.
//!
//! There may be one behind its end, where it leaves a patch and comes back. Where it leaves through u = const and no chord is
//! parallel to a tangent along v, u grows (or falls) along all chords: behind that end there is nothing. If both ends are so, the
//! curve is alone. Else the halves of the patches are asked, whose cones are narrower.
//!
//! Legs of rational patches bound tangents well, but not strictly.

use glam::DVec3;

use super::facet::Facet;
use super::hermite::{Branch, End, Node};

/// How far beyond a patch its border still is, as a fraction of its parameters: curves may run along borders.
pub(super) const BORDER: f64 = 1e-9;
/// Bisections for where a curve leaves a patch.
const BISECTIONS: usize = 30;

/// Ranges of the four parameters on two patches.
type Ranges = [[f64; 2]; 4];

/// The parameters of which each grows, or falls, along all chords of common points of two patches.
pub(super) struct Chords {
    ranges: Ranges,
    /// By how much the ranges are wider than the patches.
    slack: f64,
    is_monotone: [bool; 4],
}

impl Chords {
    /// Of two patches and a little around them, as a fraction of their parameters; `None` if normals may be parallel.
    pub(super) fn new(a: &Facet<'_>, b: &Facet<'_>, slack: f64) -> Option<Self> {
        let ((normal_a, lean_a), (normal_b, lean_b)) = (a.normals?, b.normals?);
        let along = normal_a.cross(normal_b);
        let sine = along.length();
        let lean = (lean_a + lean_b + lean_a * lean_b) / sine;
        if !(lean < 1.0) {
            return None;
        }
        let along = along / sine;
        let mut is_monotone = [false; 4];
        for (side, facet) in [a, b].into_iter().enumerate() {
            let tangents = facet.patch.tangents();
            for axis in 0..2 {
                let is_apart =
                    |(other, width): (DVec3, f64)| along.cross(other).length() > lean + width;
                is_monotone[2 * side + axis] = tangents[1 - axis].is_some_and(is_apart);
            }
        }
        let (a, b) = (&a.patch, &b.patch);
        let ranges = [a.u, a.v, b.u, b.v].map(|[low, high]| {
            let more = slack * (high - low);
            [low - more, high + more]
        });
        Some(Self {
            ranges,
            slack,
            is_monotone,
        })
    }

    /// Whether a curve that passes through the patches at a parameter of its own is all that they have in common.
    pub(super) fn has_only(&self, branch: &Branch, t: f64) -> bool {
        self.is_inside(branch, t) && self.ends(branch, t, true) && self.ends(branch, t, false)
    }

    fn parameters(branch: &Branch, t: f64) -> [f64; 4] {
        let value = branch.value(t);
        std::array::from_fn(|k| value[3 + k])
    }

    fn beyond(&self, q: &[f64; 4]) -> [bool; 4] {
        std::array::from_fn(|k| !(self.ranges[k][0] <= q[k] && q[k] <= self.ranges[k][1]))
    }

    fn is_inside(&self, branch: &Branch, t: f64) -> bool {
        self.beyond(&Self::parameters(branch, t)) == [false; 4]
    }

    /// Whether nothing lies behind the end of a curve's part in the patches, one way from a place in it.
    fn ends(&self, branch: &Branch, from: f64, forward: bool) -> bool {
        let count = branch.nodes.len();
        let mut at = branch.lengths.partition_point(|length| *length <= from);
        if !forward {
            at = branch.lengths.partition_point(|length| *length < from);
        }
        let mut inside = from;
        for _ in 0..count {
            let is_last = if forward { at == count } else { at == 0 };
            if is_last {
                match branch.ends[usize::from(forward)] {
                    End::Closed => {
                        (at, inside) = if forward {
                            (1, 0.0)
                        } else {
                            (count - 1, branch.length())
                        };
                        continue;
                    }
                    // On the border of its sheet.
                    End::AtRoot(_) | End::AtBorder(..) => {
                        return self.ends_at(branch.end(usize::from(forward)), forward);
                    }
                    // Beyond what is wanted, or counted as a contact.
                    End::Outside | End::Tangent => return true,
                }
            }
            let node = if forward { at } else { at - 1 };
            if self.beyond(&branch.nodes[node].parameters()) != [false; 4] {
                return self.leaves(branch, [inside, branch.lengths[node]]);
            }
            inside = branch.lengths[node];
            at = if forward { at + 1 } else { at - 1 };
        }
        false
    }

    /// Whether a curve leaves through a border behind which nothing lies, between a place inside and one outside.
    fn leaves(&self, branch: &Branch, [mut inside, mut outside]: [f64; 2]) -> bool {
        let monotone = |beyond: &[bool; 4]| (0..4).all(|k| !beyond[k] || self.is_monotone[k]);
        let mut beyond = self.beyond(&Self::parameters(branch, outside));
        for _ in 0..BISECTIONS {
            if monotone(&beyond) {
                return true;
            }
            let middle = 0.5 * (inside + outside);
            let there = self.beyond(&Self::parameters(branch, middle));
            if there == [false; 4] {
                inside = middle;
            } else {
                (outside, beyond) = (middle, there);
            }
        }
        monotone(&beyond)
    }

    /// Whether a curve's end on a border of its sheet has nothing behind it: a parameter that grows along all chords ends there,
    /// too, the way that the curve goes.
    fn ends_at(&self, end: &Node, forward: bool) -> bool {
        let q = end.parameters();
        (0..4).any(|k| {
            let [low, high] = self.ranges[k];
            let near = 3.0 * self.slack * (high - low);
            let grows = (end.first[3 + k] > 0.0) == forward;
            let left = if grows { high - q[k] } else { q[k] - low };
            self.is_monotone[k] && left <= near
        })
    }
}
