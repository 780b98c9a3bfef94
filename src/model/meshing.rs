//! What of a realisation is hard to mesh with tetrahedra, and what to set.
//!
//! Measured with Gmsh; `docs/meshing.md` has the figures.

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

/// Channels thin out to nothing at their banks: facets of base and top cut each other unless they are small.
fn channels(realisation: &Realisation) -> Option<String> {
    let width = |instance: &Instance| {
        let drawn = instance.drawn.iter().find(|(name, _)| name == "width")?;
        Some((drawn.1, instance.volume))
    };
    let (width, volume) = realisation
        .instances
        .iter()
        .filter(|instance| matches!(instance.body, Body::Trough(_)))
        .filter_map(width)
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    let name = &realisation.volumes[volume].name;
    let size = 0.5 * width;
    Some(format!(
        "channels thin out to nothing at their banks: Gmsh needs elements of about half the narrowest one's width \
         ({size:.1} m for {name}: `Mesh.MeshSizeMax`) and `Mesh.Algorithm = 1`"
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
