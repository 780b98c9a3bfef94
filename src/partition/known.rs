//! A curve that is known, with boxes around groups of its pieces: most of what is asked of it is far from most of it.

use std::ops::Range;

use glam::DVec3;

use super::bounds::Bounds;
use super::hermite::{Branch, Node};

/// Pieces in a group.
const GROUP: usize = 12;

/// A branch in groups of pieces.
pub(super) struct Known {
    pub(super) branch: Branch,
    groups: Vec<Group>,
}

/// Some pieces, one behind the other.
struct Group {
    pieces: Range<usize>,
    /// Of their nodes.
    bounds: Bounds,
    /// Of their nodes' parameters on both sheets.
    parameters: [[f64; 2]; 4],
    /// The longest piece.
    longest: f64,
}

impl Known {
    pub(super) fn new(branch: Branch) -> Self {
        let starts = (0..branch.pieces()).step_by(GROUP);
        let groups = starts.map(|start| {
            let pieces = start..(start + GROUP).min(branch.pieces());
            let nodes = &branch.nodes[pieces.start..=pieces.end];
            let mut parameters = [[f64::INFINITY, f64::NEG_INFINITY]; 4];
            for q in nodes.iter().map(Node::parameters) {
                for (range, x) in parameters.iter_mut().zip(q) {
                    *range = [range[0].min(x), range[1].max(x)];
                }
            }
            let lengths = branch.lengths[pieces.start..=pieces.end].windows(2);
            Group {
                bounds: Bounds::of(nodes.iter().map(Node::point)),
                parameters,
                longest: lengths.map(|pair| pair[1] - pair[0]).fold(0.0, f64::max),
                pieces,
            }
        });
        let groups = groups.collect();
        Self { branch, groups }
    }

    /// Its nodes, each with its parameter, that may lie in ranges of the parameters on both sheets.
    pub(super) fn nodes_near<'a>(
        &'a self,
        ranges: &'a [[f64; 2]; 4],
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let meets = move |group: &&Group| {
            let mut both = group.parameters.iter().zip(ranges);
            both.all(|(own, other)| own[0] <= other[1] && other[0] <= own[1])
        };
        let groups = self.groups.iter().filter(meets);
        groups.flat_map(move |group| {
            (group.pieces.start..=group.pieces.end).map(|at| (at, self.branch.lengths[at]))
        })
    }

    /// The parameter of the nearest point to one, if that is nearer than a distance.
    pub(super) fn nearest(&self, point: DVec3, within: f64) -> Option<f64> {
        let mut best = (f64::NAN, within);
        for group in &self.groups {
            // A piece is not much longer than its chord.
            let reach = best.1 + 1.5 * group.longest;
            if group.bounds.grown(reach).holds(point)
                && let Some(nearer) = self.branch.nearest_of(group.pieces.clone(), point, best.1)
            {
                best = nearer;
            }
        }
        (best.1 < within).then_some(best.0)
    }
}
