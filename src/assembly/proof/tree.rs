//! A tree of boxes, asked for what a line parallel to an axis comes near to.

use glam::DVec3;

use crate::nurbs::pierce::Line;

/// Corners of a box.
pub(super) type Bounds = (DVec3, DVec3);

/// Most items of a leaf.
const LEAF: usize = 4;

/// Boxes with what they hold.
#[derive(Debug)]
pub(super) struct Tree<T> {
    items: Vec<(Bounds, T)>,
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// Items of a leaf; otherwise the second child, the first one being the next node.
    items: Option<(usize, usize)>,
    second: usize,
}

fn around(items: impl Iterator<Item = Bounds>) -> Bounds {
    items.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |all, one| {
        (all.0.min(one.0), all.1.max(one.1))
    })
}

impl<T> Tree<T> {
    pub(super) fn new(items: Vec<(Bounds, T)>) -> Self {
        let mut tree = Self {
            nodes: Vec::with_capacity(items.len()),
            items,
        };
        if !tree.items.is_empty() {
            tree.grow(0, tree.items.len());
        }
        tree
    }

    fn grow(&mut self, from: usize, to: usize) {
        let bounds = around(self.items[from..to].iter().map(|item| item.0));
        let at = self.nodes.len();
        let is_leaf = to - from <= LEAF;
        self.nodes.push(Node {
            bounds,
            items: is_leaf.then_some((from, to)),
            second: 0,
        });
        if is_leaf {
            return;
        }
        let middle = |one: &Bounds| one.0 + one.1;
        let spread = around(self.items[from..to].iter().map(|item| {
            let p = middle(&item.0);
            (p, p)
        }));
        let size = spread.1 - spread.0;
        let axis = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
        let half = from + (to - from) / 2;
        self.items[from..to].select_nth_unstable_by(half - from, |a, b| {
            middle(&a.0)[axis].total_cmp(&middle(&b.0)[axis])
        });
        self.grow(from, half);
        self.nodes[at].second = self.nodes.len();
        self.grow(half, to);
    }

    /// Hands on what a line comes this near to, until it is told to stop.
    pub(super) fn along(&self, line: Line, near: f64, mut each: impl FnMut(&T) -> bool) {
        let mut stack = Vec::with_capacity(32);
        if !self.nodes.is_empty() {
            stack.push(0);
        }
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at];
            if !line.meets(node.bounds, near) {
                continue;
            }
            let Some((from, to)) = node.items else {
                stack.extend([node.second, at + 1]);
                continue;
            };
            for (bounds, item) in &self.items[from..to] {
                if line.meets(*bounds, near) && !each(item) {
                    return;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_gets_exactly_the_boxes_that_it_comes_near_to() {
        let items: Vec<(Bounds, usize)> = (0..300)
            .map(|k| {
                let part = DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478) * k as f64;
                let low = 10.0 * part.fract();
                ((low, low + DVec3::new(0.5, 1.0, 0.1)), k)
            })
            .collect();
        let tree = Tree::new(items.clone());
        for k in 0..60 {
            let mut line = Line::whole(k % 3, DVec3::splat(0.18 * k as f64));
            if k > 30 {
                line.range = [2.0, 5.0];
            }
            let mut found = Vec::new();
            tree.along(line, 0.05, |item| {
                found.push(*item);
                true
            });
            found.sort_unstable();
            let all = items.iter().filter(|item| line.meets(item.0, 0.05));
            assert_eq!(found, all.map(|item| item.1).collect::<Vec<_>>());
        }
    }
}
