//! Which of many things a vertical ray may cross: a tree of their boxes, seen from above.

use super::shell::Shell;
use glam::{DVec2, DVec3, Vec3Swizzles};

/// Things in a leaf of the tree.
const PER_NODE: usize = 4;

/// A box that reaches down for ever: a ray up from outside of it misses what it is the box of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shade {
    low: DVec2,
    high: DVec2,
    top: f64,
}

impl Shade {
    const EMPTY: Self = Self {
        low: DVec2::INFINITY,
        high: DVec2::NEG_INFINITY,
        top: f64::NEG_INFINITY,
    };

    /// Of what lies between two corners, as wide as the shell's edges may be apart.
    pub(super) fn new(shell: &Shell, low: DVec3, high: DVec3) -> Self {
        Self {
            low: low.xy() - 2.0 * shell.tolerance,
            high: high.xy() + 2.0 * shell.tolerance,
            top: high.z + shell.width,
        }
    }

    fn and(self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            top: self.top.max(other.top),
        }
    }

    fn is_over(&self, p: DVec3) -> bool {
        p.x >= self.low.x
            && p.x <= self.high.x
            && p.y >= self.low.y
            && p.y <= self.high.y
            && p.z <= self.top
    }
}

/// Things with shades.
#[derive(Clone, Debug)]
pub(super) struct Tree<T> {
    nodes: Vec<Node>,
    things: Vec<T>,
    shade: fn(&T) -> &Shade,
}

/// A node of the tree, depth first: the left child follows its parent.
#[derive(Clone, Debug)]
struct Node {
    shade: Shade,
    /// The node to go on with when this one is done or missed.
    skip: usize,
    /// The things of a leaf; none in an inner node.
    things: std::ops::Range<usize>,
}

impl<T> Tree<T> {
    pub(super) fn new(things: Vec<T>, shade: fn(&T) -> &Shade) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            things,
            shade,
        };
        tree.grow(0..tree.things.len());
        tree
    }

    /// Adds the tree of some of the things, which it reorders.
    fn grow(&mut self, range: std::ops::Range<usize>) {
        let shade = self.shade;
        let things = &mut self.things[range.clone()];
        let all = things
            .iter()
            .fold(Shade::EMPTY, |all, thing| all.and(shade(thing)));
        let own = self.nodes.len();
        let leaf = things.len() <= PER_NODE;
        self.nodes.push(Node {
            shade: all,
            skip: 0,
            things: if leaf {
                range.clone()
            } else {
                range.start..range.start
            },
        });
        if !leaf {
            let size = all.high - all.low;
            let middle = |thing: &T| {
                let Shade { low, high, .. } = shade(thing);
                let sum = *low + *high;
                if size.x >= size.y { sum.x } else { sum.y }
            };
            let half = things.len() / 2;
            things.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
            let half = range.start + half;
            self.grow(range.start..half);
            self.grow(half..range.end);
        }
        self.nodes[own].skip = self.nodes.len();
    }

    /// Hands on what the ray up from p may cross, as long as it is told to; whether it was to the end.
    pub(super) fn all_over(&self, p: DVec3, mut each: impl FnMut(&T) -> bool) -> bool {
        let mut k = 0;
        while let Some(node) = self.nodes.get(k) {
            if !node.shade.is_over(p) {
                k = node.skip;
                continue;
            }
            for thing in &self.things[node.things.clone()] {
                if (self.shade)(thing).is_over(p) && !each(thing) {
                    return false;
                }
            }
            k += 1;
        }
        true
    }
}
