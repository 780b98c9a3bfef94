//! What a grid makes of net rock: cells that are net by their middle, and connected where they share a face.
//!
//! Layer by layer, so that memory does not grow with the number of layers: provisional numbers of groups, joined where two of them
//! meet (Hoshen & Kopelman 1976).

use std::collections::BTreeMap;

use rayon::prelude::*;

/// How net rock hangs together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Connectivity {
    /// Groups of net rock.
    pub(crate) bodies: usize,
    /// Net volume over all volume.
    pub(crate) net_to_gross: f64,
    /// The largest group's share of all net volume.
    pub(crate) largest_share: f64,
    /// The chance that two places in net rock lie in one group: Σ V² / (Σ V)².
    pub(crate) gamma: f64,
}

impl Connectivity {
    /// Of groups by their sizes, in a block of this size.
    pub(crate) fn of(sizes: &[f64], block: f64) -> Self {
        let all: f64 = sizes.iter().sum();
        let squares: f64 = sizes.iter().map(|size| size * size).sum();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        // Where there is no net rock none is connected.
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        Self {
            bodies: sizes.len(),
            net_to_gross: all / block,
            largest_share: share(largest, all),
            gamma: share(squares, all * all),
        }
    }
}

/// Numbers of groups, of which some stand for others.
#[derive(Default)]
struct Groups {
    parent: Vec<u32>,
    cells: Vec<u64>,
}

impl Groups {
    fn new_group(&mut self) -> u32 {
        let group = u32::try_from(self.parent.len()).unwrap_or(u32::MAX);
        self.parent.push(group);
        self.cells.push(0);
        group
    }

    fn root(&mut self, mut group: u32) -> u32 {
        while self.parent[group as usize] != group {
            // Halves the way for the next one who asks.
            let above = self.parent[self.parent[group as usize] as usize];
            self.parent[group as usize] = above;
            group = above;
        }
        group
    }

    fn join(&mut self, a: u32, b: u32) -> u32 {
        let (a, b) = (self.root(a), self.root(b));
        let (older, younger) = (a.min(b), a.max(b));
        self.parent[younger as usize] = older;
        older
    }

    fn sizes(&mut self) -> Vec<u64> {
        let mut sizes: BTreeMap<u32, u64> = BTreeMap::new();
        for group in 0..u32::try_from(self.parent.len()).unwrap_or(u32::MAX) {
            let root = self.root(group);
            *sizes.entry(root).or_default() += self.cells[group as usize];
        }
        sizes.into_values().collect()
    }
}

/// Cells in each connected group of those for which `is_net` holds, by their place along x, y and z.
pub(crate) fn groups(
    [nx, ny, nz]: [usize; 3],
    is_net: impl Fn([usize; 3]) -> bool + Sync,
) -> Vec<u64> {
    const NONE: u32 = u32::MAX;
    let mut groups = Groups::default();
    let mut below = vec![NONE; nx * ny];
    for k in 0..nz {
        let net: Vec<bool> = (0..ny)
            .into_par_iter()
            .flat_map_iter(|j| {
                let is_net = &is_net;
                (0..nx).map(move |i| is_net([i, j, k]))
            })
            .collect();
        let mut here = vec![NONE; nx * ny];
        for (at, _) in net.iter().enumerate().filter(|(_, net)| **net) {
            let west = if at % nx > 0 { here[at - 1] } else { NONE };
            let south = if at >= nx { here[at - nx] } else { NONE };
            let mut beside = [west, south, below[at]]
                .into_iter()
                .filter(|group| *group != NONE);
            let group = match beside.next() {
                Some(first) => beside.fold(first, |joined, one| groups.join(joined, one)),
                None => groups.new_group(),
            };
            here[at] = group;
            groups.cells[group as usize] += 1;
        }
        below = here;
    }
    groups.sizes()
}
