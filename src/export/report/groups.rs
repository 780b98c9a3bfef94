//! Connected groups: solids of chosen volumes that share faces.

use std::collections::BTreeMap;

use super::entries::GroupEntry;
use super::parts::{Parts, solid_names};

/// Connected groups of the solids whose volumes are chosen: solids that share a face are connected.
pub(super) fn groups(parts: Parts<'_>, chosen: &dyn Fn(usize) -> bool) -> Vec<GroupEntry> {
    let Parts {
        realisation,
        assembly,
        ..
    } = parts;
    let pieces = &assembly.measured.pieces;
    // Position of each of the kernel's solids in the list of pieces.
    let mut position = vec![0; pieces.len()];
    for (at, piece) in pieces.iter().enumerate() {
        position[piece.solid] = at;
    }
    let mut group: Vec<usize> = (0..pieces.len()).collect();
    for face in assembly.solids.faces() {
        if let [a, b] = face.solids[..] {
            let (a, b) = (position[a], position[b]);
            if chosen(pieces[a].volume) && chosen(pieces[b].volume) {
                let (a, b) = (root(&group, a), root(&group, b));
                group[a.max(b)] = a.min(b);
            }
        }
    }
    let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for at in (0..pieces.len()).filter(|at| chosen(pieces[*at].volume)) {
        members.entry(root(&group, at)).or_default().push(at);
    }
    let name = |at: usize| {
        let piece = &pieces[at];
        let siblings = assembly.measured.pieces_of(piece.volume);
        let number = siblings
            .iter()
            .position(|one| one.solid == piece.solid)
            .unwrap_or(0);
        solid_names(&realisation.volumes[piece.volume].name, siblings.len()).swap_remove(number)
    };
    let mut groups: Vec<GroupEntry> = members
        .values()
        .map(|members| GroupEntry {
            solids: members.iter().map(|at| name(*at)).collect(),
            volume_m3: members.iter().map(|at| pieces[*at].size).sum(),
        })
        .collect();
    groups.sort_by(|a, b| {
        b.volume_m3
            .total_cmp(&a.volume_m3)
            .then_with(|| a.solids.cmp(&b.solids))
    });
    groups
}

fn root(group: &[usize], mut at: usize) -> usize {
    while group[at] != at {
        at = group[at];
    }
    at
}
