//! What of a realisation is hard to mesh with tetrahedra, and what to try.
//!
//! Measured with Gmsh; `docs/meshing.md` has the figures. No size of elements is promised: how narrow the strips are that
//! bodies leave of each other is known only when they are cut, and the figures know models that no size tried would do for.

use super::realisation::{Instance, Realisation};
use crate::features::body::Body;
use crate::features::side::Side;

/// A `toe` that gives good tetrahedra.
const TOE: f64 = 0.3;

/// A sentence for each kind of hard place.
pub fn advice(realisation: &Realisation) -> Vec<String> {
    [channels(realisation), toes(realisation)]
        .into_iter()
        .flatten()
        .collect()
}

/// Channels thin out to nothing at their banks, and leave strips of what they cut: facets on both sides cut each other
/// unless they are small.
fn channels(realisation: &Realisation) -> Option<String> {
    let width = |instance: &Instance| {
        let Body::Trough(trough) = &instance.body else {
            return None;
        };
        let [left, right] = trough.rims();
        let across = |v: &f64| left.point(*v).distance(right.point(*v));
        let narrowest = trough
            .sections()
            .iter()
            .map(across)
            .min_by(f64::total_cmp)?;
        Some((narrowest, instance.volume))
    };
    let (width, volume) = realisation
        .instances
        .iter()
        .filter_map(width)
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    let name = &realisation.volumes[volume].name;
    let size = 0.5 * width;
    Some(format!(
        "channels thin out to nothing at their banks and cut narrow strips off each other; Gmsh fails there (“overlapping facets”, \
         “a segment and a facet intersect”) while its elements are too large. Set `Mesh.Algorithm = 1`, begin with \
         `Mesh.MeshSizeMax = {size:.1}` (half the width of the narrowest one, {name}), and halve it while Gmsh fails; no size is \
         sure to do"
    ))
}

/// Sheets that meet their base at no angle leave cusps between them.
fn toes(realisation: &Realisation) -> Option<String> {
    let mut features: Vec<&str> = Vec::new();
    for instance in &realisation.instances {
        let Body::Side(side) = &instance.body else {
            continue;
        };
        let feature = realisation.volumes[instance.volume].feature.as_str();
        if matches!(&**side, Side::Clinoform(sheet) if sheet.is_tangent_to_base())
            && !features.contains(&feature)
        {
            features.push(feature);
        }
    }
    (!features.is_empty()).then(|| {
        format!(
            "{}: the sheets meet their base at no angle, which leaves cusps; some tetrahedra there will be flat, `toe = {TOE}` \
             avoids them",
            features.join(", ")
        )
    })
}
