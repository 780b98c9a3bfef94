//! The shell seen from above: a tree of parts of patches, prepared so that vertical rays are decided quickly.
//!
//! Every patch is halved until its view from above is close to linear ([`Projection`]). What never becomes so (folds,
//! vertical faces, poles) ends in thin **critical** parts; a ray that meets one must be replaced by an oblique one.

use super::Shell;
use super::projection::{Projection, Verdict};
use super::tally::{Outcome, Tally};
use crate::nurbs::bezier::{Along, Jet, Patch, Region, halves};
use glam::{DVec2, DVec3, Vec3Swizzles, Vec4Swizzles};

/// Critical parts are at most this long, as a fraction of the shell's size, …
const CRITICAL_LENGTH: f64 = 1.0 / 256.0;
/// … or at most this wide.
const CRITICAL_WIDTH: f64 = 1.0 / 8192.0;
/// A part is critical at the latest after so many halvings.
const MOST_HALVINGS: usize = 40;
/// Parts in a leaf of the tree.
const PER_NODE: usize = 4;

#[derive(Clone, Debug)]
pub(super) struct Columns {
    nodes: Vec<Node>,
    parts: Vec<Part>,
}

/// A node of the tree, depth first: the left child follows its parent.
#[derive(Clone, Debug)]
struct Node {
    low: DVec2,
    high: DVec2,
    top: f64,
    /// The node to go on with when this one is done or missed.
    skip: usize,
    /// The parts of a leaf; none in an inner node.
    parts: std::ops::Range<usize>,
}

#[derive(Clone, Debug)]
struct Part {
    low: DVec2,
    high: DVec2,
    top: f64,
    patch: usize,
    region: Region,
    shape: Shape,
}

#[derive(Clone, Debug)]
enum Shape {
    Regular(Projection),
    /// Between two vertical planes.
    Critical {
        normal: DVec2,
        low: f64,
        high: f64,
    },
}

impl Columns {
    pub(super) fn new(shell: &Shell, size: f64) -> Self {
        let mut parts = Vec::new();
        for (k, piece) in shell.patches.iter().enumerate() {
            cut(shell, k, &piece.patch, size, &mut parts);
        }
        let mut nodes = Vec::new();
        grow(&mut nodes, &mut parts, 0);
        Self { nodes, parts }
    }

    /// The crossings of the ray straight up from p.
    pub(super) fn cast(&self, shell: &Shell, p: DVec3) -> Outcome {
        let mut tally = Tally::default();
        let mut k = 0;
        while let Some(node) = self.nodes.get(k) {
            if !covers(p, node.low, node.high, node.top) {
                k = node.skip;
                continue;
            }
            for part in &self.parts[node.parts.clone()] {
                if covers(p, part.low, part.high, part.top) && !part.count(shell, p, &mut tally) {
                    return tally.outcome();
                }
            }
            k += 1;
        }
        tally.outcome()
    }
}

/// Whether the ray up from p meets a box that reaches down for ever.
fn covers(p: DVec3, low: DVec2, high: DVec2, top: f64) -> bool {
    p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z <= top
}

impl Part {
    /// Counts the part's crossing; false if nothing more can come of this ray.
    fn count(&self, shell: &Shell, p: DVec3, tally: &mut Tally) -> bool {
        let projection = match &self.shape {
            Shape::Regular(projection) => projection,
            Shape::Critical { normal, low, high } => {
                let across = normal.dot(p.xy());
                let met = across >= *low && across <= *high;
                if met {
                    tally.doubt();
                }
                return !met;
            }
        };
        let guess = match projection.judge(p, shell.width) {
            Verdict::Miss => return true,
            Verdict::Crosses => {
                tally.cross();
                return true;
            }
            Verdict::Near(guess) => guess,
        };
        let piece = &shell.patches[self.patch];
        let (in_u, in_v) = self.region.lengths();
        let jet = |s: DVec2| {
            let (s, t) = self.region.at(s.x, s.y);
            let Jet { point, du, dv } = piece.patch.jet(s, t);
            Jet {
                point,
                du: du * in_u,
                dv: dv * in_v,
            }
        };
        if let Some(crossing) = projection.locate(p.xy(), guess, shell.tolerance, jet) {
            tally.add(piece, &self.region, crossing, p.z, shell.width);
        }
        !tally.on_shell()
    }
}

/// Cuts a patch into regular and critical parts.
fn cut(shell: &Shell, k: usize, patch: &Patch, size: f64, parts: &mut Vec<Part>) {
    let mut stack = vec![(patch.clone(), Region::UNIT, 0)];
    while let Some((patch, region, halvings)) = stack.pop() {
        let (low, high) = patch.hull();
        let shape = if let Some(projection) = Projection::new(&patch, shell.tolerance) {
            Shape::Regular(projection)
        } else {
            let (normal, low_across, high_across) = slab(&patch);
            let longest = (high - low).xy().length();
            let thin = high_across - low_across <= CRITICAL_WIDTH * size;
            if !thin && longest > CRITICAL_LENGTH * size && halvings < MOST_HALVINGS {
                for (half, region) in halves(&patch, &region, rougher(&patch)) {
                    stack.push((half, region, halvings + 1));
                }
                continue;
            }
            let (low, high) = (
                low_across - 2.0 * shell.tolerance,
                high_across + 2.0 * shell.tolerance,
            );
            Shape::Critical { normal, low, high }
        };
        parts.push(Part {
            low: low.xy() - 2.0 * shell.tolerance,
            high: high.xy() + 2.0 * shell.tolerance,
            top: high.z + shell.width,
            patch: k,
            region,
            shape,
        });
    }
}

/// Two parallel lines, seen from above, that the patch lies between: their normal and places. They run along the longest
/// chord between corners.
fn slab(patch: &Patch) -> (DVec2, f64, f64) {
    let (p, q) = (patch.degree_u, patch.degree_v);
    let corners = [(0, 0), (p, 0), (0, q), (p, q)].map(|(i, j)| {
        let h = patch.control(i, j);
        h.xy() / h.w
    });
    let mut chord = DVec2::ZERO;
    for a in corners {
        for b in corners {
            if (b - a).length_squared() > chord.length_squared() {
                chord = b - a;
            }
        }
    }
    let normal = chord.perp().normalize_or(DVec2::X);
    let across = patch.points().map(|point| normal.dot(point.xy()));
    let (low, high) = across.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    (normal, low, high)
}

/// The parameter along which the view from above is farther from linear.
fn rougher(patch: &Patch) -> Along {
    let (p, q) = (patch.degree_u, patch.degree_v);
    let point = |i: usize, j: usize| {
        let h = patch.control(i, j);
        h.xy() / h.w
    };
    let leg_u = |i: usize, j: usize| point(i + 1, j) - point(i, j);
    let leg_v = |i: usize, j: usize| point(i, j + 1) - point(i, j);
    let (mut longest_u, mut longest_v) = (0.0_f64, 0.0_f64);
    // Greatest change of a leg along u and along v, for legs in u and in v.
    let (mut change_u, mut change_v) = ([0.0_f64; 2], [0.0_f64; 2]);
    for i in 0..=p {
        for j in 0..=q {
            if i < p {
                longest_u = longest_u.max(leg_u(i, j).length());
            }
            if j < q {
                longest_v = longest_v.max(leg_v(i, j).length());
            }
            if i + 1 < p {
                change_u[0] = change_u[0].max((leg_u(i + 1, j) - leg_u(i, j)).length());
            }
            if j + 1 < q {
                change_v[1] = change_v[1].max((leg_v(i, j + 1) - leg_v(i, j)).length());
            }
            if i < p && j < q {
                let twist = (leg_v(i + 1, j) - leg_v(i, j)).length();
                change_u[1] = change_u[1].max(twist);
                change_v[0] = change_v[0].max(twist);
            }
        }
    }
    let relative = |change: [f64; 2]| {
        let part = |change: f64, longest: f64| if longest > 0.0 { change / longest } else { 0.0 };
        part(change[0], longest_u) + part(change[1], longest_v)
    };
    let (bent_u, bent_v) = (relative(change_u) * p as f64, relative(change_v) * q as f64);
    // Times the length, so that a wedge at a pole is not cut into ever thinner wedges, but shortened too.
    let (score_u, score_v) = (bent_u * longest_u * p as f64, bent_v * longest_v * q as f64);
    if score_u == score_v {
        return if longest_u * p as f64 >= longest_v * q as f64 {
            Along::U
        } else {
            Along::V
        };
    }
    if score_u > score_v {
        Along::U
    } else {
        Along::V
    }
}

/// Adds the tree of the parts, which it reorders; `first` is the number of the first one.
fn grow(nodes: &mut Vec<Node>, parts: &mut [Part], first: usize) {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY, f64::NEG_INFINITY);
    let (low, high, top) = parts.iter().fold(empty, |(low, high, top), part| {
        (low.min(part.low), high.max(part.high), top.max(part.top))
    });
    let own = nodes.len();
    let leaf = parts.len() <= PER_NODE;
    let held = if leaf {
        first..first + parts.len()
    } else {
        first..first
    };
    nodes.push(Node {
        low,
        high,
        top,
        skip: 0,
        parts: held,
    });
    if !leaf {
        let size = high - low;
        let middle = |part: &Part| {
            let sum = part.low + part.high;
            if size.x >= size.y { sum.x } else { sum.y }
        };
        let half = parts.len() / 2;
        parts.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
        let (left, right) = parts.split_at_mut(half);
        grow(nodes, left, first);
        grow(nodes, right, first + half);
    }
    nodes[own].skip = nodes.len();
}
