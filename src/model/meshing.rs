//! What of a realisation is hard to mesh with tetrahedra, and what to try.
//!
//! Measured with Gmsh; `docs/meshing.md` has the figures. No size of elements is promised: how narrow the strips are that
//! bodies leave of each other is known only when they are cut, and the figures know models that no size tried would do for.

use super::kinds::KINDS;
use super::kinds::made::Outcome;
use super::realisation::Realisation;

/// A sentence for each kind of hard place.
pub fn advice(realisation: &Realisation) -> Vec<String> {
    let advice = KINDS.iter().map(|kind| {
        let made: Vec<Outcome<'_>> = realisation
            .instances
            .iter()
            .map(|instance| (&realisation.volumes[instance.volume], &instance.body))
            .filter(|(rules, _)| rules.kind == kind.nature.name)
            .map(|(rules, body)| Outcome {
                feature: &rules.feature,
                name: &rules.name,
                body,
            })
            .collect();
        (kind.meshing)(&made)
    });
    advice.flatten().collect()
}
