//! Which cells become one solid, and which faces its shells have: decided by topology alone.
//!
//! A face between two cells of one owner is dropped. At an edge, a face of a solid continues in the face reached by turning about the
//! edge through the solid's cells: across the cell to its other face there, and through that face into the next cell if it is dropped.
//! So shells come apart correctly where a solid touches itself along an edge, with no point or angle computed.

use crate::cells::{Cell, Side};
use crate::error::{BridgeError, input};
use crate::ffi::bridge;
use crate::solids::Solid;

pub(crate) struct Merger<'a> {
    cells: &'a [Cell],
    /// Per face, its edges in order.
    edges: &'a [Vec<Side>],
}

#[derive(Default)]
pub(crate) struct Merged {
    /// Their faces by index into `faces`.
    pub(crate) solids: Vec<Solid>,
    /// Faces of the partition that are kept.
    pub(crate) faces: Vec<usize>,
    /// For the kernel, in faces of the partition.
    pub(crate) data: bridge::MergeData,
}

/// Sets of numbers that are joined one by one.
struct Sets {
    parent: Vec<usize>,
}

impl Sets {
    fn new(count: usize) -> Self {
        Self {
            parent: (0..count).collect(),
        }
    }

    /// The smallest member.
    fn find(&mut self, mut i: usize) -> usize {
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b)] = a.min(b);
    }
}

/// A face as one cell uses it.
#[derive(Clone, Copy)]
struct Use {
    cell: usize,
    face: usize,
    reversed: bool,
    /// Number of its first corner: one per edge of the face.
    corner: usize,
}

impl<'a> Merger<'a> {
    pub(crate) fn new(cells: &'a [Cell], edges: &'a [Vec<Side>]) -> Self {
        Self { cells, edges }
    }

    pub(crate) fn merge(&self, owner: &[Option<usize>]) -> Result<Merged, BridgeError> {
        let operation = "merging cells";
        if owner.len() != self.cells.len() {
            return Err(input(
                operation,
                format!(
                    "there are {} owners for {} cells",
                    owner.len(),
                    self.cells.len()
                ),
            ));
        }
        if owner.iter().all(Option::is_none) {
            return Err(input(operation, "every cell is dropped"));
        }
        let uses = self.uses(owner);
        let opposite = self.opposite(&uses, owner);
        let shells = self.shells(&uses, &opposite);
        let mut bodies = Sets::new(self.cells.len());
        for (u, other) in opposite.iter().enumerate() {
            if let Some(v) = other {
                bodies.join(uses[u].cell, uses[*v].cell);
            }
        }
        Self::collect(owner, &uses, &opposite, &shells, &mut bodies)
            .ok_or_else(|| input(operation, "a solid would have no face"))
    }

    fn uses(&self, owner: &[Option<usize>]) -> Vec<Use> {
        let mut uses = Vec::new();
        let mut corner = 0;
        for (c, cell) in self.cells.iter().enumerate() {
            if owner[c].is_none() {
                continue;
            }
            for (face, reversed) in &cell.faces {
                uses.push(Use {
                    cell: c,
                    face: *face,
                    reversed: *reversed,
                    corner,
                });
                // A face without edges (a whole torus) still needs a corner to be found by.
                corner += self.edges[*face].len().max(1);
            }
        }
        uses
    }

    /// Per use, the use of the same face by a cell of the same owner on its other side: such faces are dropped.
    fn opposite(&self, uses: &[Use], owner: &[Option<usize>]) -> Vec<Option<usize>> {
        let mut of_face: Vec<Vec<usize>> = vec![Vec::new(); self.edges.len()];
        for (u, of) in uses.iter().enumerate() {
            of_face[of.face].push(u);
        }
        let mut opposite = vec![None; uses.len()];
        for sides in &of_face {
            if let [a, b] = sides[..]
                && uses[a].reversed != uses[b].reversed
                && owner[uses[a].cell] == owner[uses[b].cell]
            {
                opposite[a] = Some(b);
                opposite[b] = Some(a);
            }
        }
        opposite
    }

    /// Per use, a number that the uses of one shell have in common.
    fn shells(&self, uses: &[Use], opposite: &[Option<usize>]) -> Vec<usize> {
        let corners = uses
            .last()
            .map_or(0, |u| u.corner + self.edges[u.face].len().max(1));
        let mut sets = Sets::new(corners);
        for (u, of) in uses.iter().enumerate() {
            let count = self.edges[of.face].len().max(1);
            for k in 0..count {
                match opposite[u] {
                    Some(v) => sets.join(of.corner + k, uses[v].corner + k),
                    None => sets.join(of.corner, of.corner + k),
                }
            }
        }
        let mut first = 0;
        while first < uses.len() {
            let cell = uses[first].cell;
            let end = first + uses[first..].iter().take_while(|u| u.cell == cell).count();
            self.join_within_cell(&uses[first..end], &mut sets);
            first = end;
        }
        uses.iter().map(|u| sets.find(u.corner)).collect()
    }

    /// Joins the corners of a cell that meet at an edge. Where more than two do the cell touches itself there: they stay together.
    fn join_within_cell(&self, uses: &[Use], sets: &mut Sets) {
        let mut corners: Vec<(usize, usize)> = Vec::new();
        for of in uses {
            for (k, (edge, _)) in self.edges[of.face].iter().enumerate() {
                corners.push((*edge, of.corner + k));
            }
        }
        corners.sort_unstable();
        for pair in corners.windows(2) {
            if pair[0].0 == pair[1].0 {
                sets.join(pair[0].1, pair[1].1);
            }
        }
    }

    fn collect(
        owner: &[Option<usize>],
        uses: &[Use],
        opposite: &[Option<usize>],
        shells: &[usize],
        sets: &mut Sets,
    ) -> Option<Merged> {
        // Kept uses by body and shell, both in order of first appearance.
        let mut bodies: Vec<Body> = Vec::new();
        let mut at_of: Vec<Option<usize>> = vec![None; owner.len()];
        for (u, of) in uses.iter().enumerate() {
            let cell = sets.find(of.cell);
            let at = *at_of[cell].get_or_insert_with(|| {
                bodies.push(Body {
                    cell,
                    shells: Vec::new(),
                });
                bodies.len() - 1
            });
            if opposite[u].is_none() {
                bodies[at].add(shells[u], u);
            }
        }
        let mut merged = Merged::default();
        let mut number = vec![None; uses.iter().map(|u| u.face + 1).max().unwrap_or(0)];
        for body in &bodies {
            let mut faces = Vec::new();
            for (_, shell) in &body.shells {
                for u in shell {
                    let of = uses[*u];
                    let at = *number[of.face].get_or_insert_with(|| {
                        merged.faces.push(of.face);
                        merged.faces.len() - 1
                    });
                    faces.push((at, of.reversed));
                    let code = 2 * of.face + usize::from(of.reversed);
                    merged.data.uses.push(u32::try_from(code).ok()?);
                }
                let count = u32::try_from(shell.len()).ok()?;
                merged.data.faces_of_shells.push(count);
            }
            if faces.is_empty() {
                return None;
            }
            let count = u32::try_from(body.shells.len()).ok()?;
            merged.data.shells_of_solids.push(count);
            merged.solids.push(Solid {
                owner: owner[body.cell]?,
                faces,
                shells: body.shells.len(),
            });
        }
        for face in &merged.faces {
            merged.data.faces.push(u32::try_from(*face).ok()?);
        }
        Some(merged)
    }
}

/// Cells that are joined.
struct Body {
    /// The first of them.
    cell: usize,
    /// Per shell, its number and its uses.
    shells: Vec<(usize, Vec<usize>)>,
}

impl Body {
    fn add(&mut self, shell: usize, of: usize) {
        match self.shells.iter_mut().find(|s| s.0 == shell) {
            Some(found) => found.1.push(of),
            None => self.shells.push((shell, vec![of])),
        }
    }
}
