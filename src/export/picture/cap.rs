//! The curved base and top of a domain in a block diagram: what lies right under them, by facets.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec3Swizzles};
use rayon::prelude::*;

use super::scene::{Owner, Part};
use crate::features::extent::Extent;
use crate::nurbs::Surface;

/// Facets along each side of the plan.
const FACETS: u32 = 480;
/// How far below the top, or above the base, a facet's owner is asked for, as a fraction of the block's height.
const INWARD: f64 = 1e-6;

/// The base and the top of a domain where they are not level, each facet with the volume that owns its middle.
pub fn caps(extent: &Extent, owner: Owner<'_>) -> Vec<Part> {
    let bounds = extent.bounds().iter().zip([1.0, -1.0]);
    let sheets =
        bounds.filter_map(|(side, inward)| Some((side.as_deref()?.sheets().first()?, inward)));
    sheets
        .flat_map(|(sheet, inward)| cap(extent, sheet, inward, owner))
        .collect()
}

/// The facets of one sheet by volume; `inward` is 1 for a base and −1 for a top.
fn cap(extent: &Extent, sheet: &Surface, inward: f64, owner: Owner<'_>) -> Vec<Part> {
    let (low, high) = (extent.low(), extent.high());
    let net = sheet.net();
    let (first, last) = (net[0].xy(), net[net.len() - 1].xy());
    let on_sheet = |i: f64, j: f64| {
        let place = low.xy() + (high - low).xy() * DVec2::new(i, j) / f64::from(FACETS);
        (place - first) / (last - first)
    };
    let nodes: Vec<(DVec3, DVec3)> = (0..=FACETS)
        .into_par_iter()
        .flat_map_iter(|j| {
            (0..=FACETS).map(move |i| {
                let at = on_sheet(f64::from(i), f64::from(j));
                let normal = sheet.normal(at.x, at.y).unwrap_or(DVec3::Z);
                (
                    sheet.point(at.x, at.y),
                    -inward * normal * normal.z.signum(),
                )
            })
        })
        .collect();
    let step = DVec3::Z * inward * INWARD * (high.z - low.z);
    let owners: Vec<Option<u32>> = (0..FACETS * FACETS)
        .into_par_iter()
        .map(|facet| {
            let (i, j) = (facet % FACETS, facet / FACETS);
            let at = on_sheet(f64::from(i) + 0.5, f64::from(j) + 0.5);
            owner(sheet.point(at.x, at.y) + step)
        })
        .collect();
    let mut by_volume: BTreeMap<usize, Vec<[u32; 3]>> = BTreeMap::new();
    for (facet, volume) in (0..).zip(owners) {
        let Some(volume) = volume else { continue };
        let (i, j) = (facet % FACETS, facet / FACETS);
        let node = |di: u32, dj: u32| (j + dj) * (FACETS + 1) + i + di;
        let [a, b, c, d] = [node(0, 0), node(1, 0), node(1, 1), node(0, 1)];
        // Counter-clockwise as seen from outside.
        let facets = if inward < 0.0 {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, c, b], [a, d, c]]
        };
        by_volume.entry(volume as usize).or_default().extend(facets);
    }
    by_volume
        .into_iter()
        .map(|(volume, triangles)| part(volume, &triangles, &nodes))
        .collect()
}

/// Triangles with the nodes that they use.
fn part(volume: usize, triangles: &[[u32; 3]], nodes: &[(DVec3, DVec3)]) -> Part {
    let mut used: Vec<u32> = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let mut place = vec![0; nodes.len()];
    for (at, &node) in (0..).zip(&used) {
        place[node as usize] = at;
    }
    let own = used.iter().map(|&node| nodes[node as usize]);
    let (positions, normals) = own.unzip();
    Part {
        volume,
        positions,
        normals: Some(normals),
        triangles: triangles
            .iter()
            .map(|corners| corners.map(|node| place[node as usize]))
            .collect(),
        opacity: 1.0,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use crate::features::horizon::Horizon;

    #[test]
    fn a_dipping_top_has_facets_of_what_lies_under_it_and_looks_up() {
        let top = Horizon::dipping(DVec3::new(50.0, 50.0, 8.0), 0.05, 0.0).unwrap();
        let base = Horizon::dipping(DVec3::new(50.0, 50.0, -8.0), 0.05, 0.0).unwrap();
        let (low, high) = (DVec3::new(0.0, 0.0, -20.0), DVec3::new(100.0, 100.0, 20.0));
        let extent = Extent::new(low, high, Some(&base), Some(&top)).unwrap();
        let owner = |p: DVec3| extent.holds(p).then_some(u32::from(p.x > 75.0));
        let parts = caps(&extent, &owner);
        let volumes: Vec<usize> = parts.iter().map(|part| part.volume).collect();
        assert_eq!(volumes, [0, 1, 0, 1]);
        let plan = |part: &Part| -> f64 {
            let area = |corners: &[u32; 3]| {
                let [a, b, c] = corners.map(|i| part.positions[i as usize]);
                0.5 * (b - a).cross(c - a).z
            };
            part.triangles.iter().map(area).sum()
        };
        for (part, expected) in parts.iter().zip([-7500.0, -2500.0, 7500.0, 2500.0]) {
            assert!((plan(part) - expected).abs() < 1e-6, "{}", plan(part));
            let normals = part.normals.as_ref().unwrap();
            assert!(normals.iter().all(|n| n.z * expected > 0.0));
        }
    }
}
