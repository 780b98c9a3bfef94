//! On which side of each sheet its region lies.

use rayon::prelude::*;

use super::shape::Inside;
use crate::partition::PartitionError;
use crate::partition::bounds::Bounds;
use crate::partition::edge::Edge;
use crate::partition::sheet::Sheet;

/// Finds out on which side of each sheet its region lies: for one sheet of each region by points beside it,
/// for the others by the edges that they share, along which outward sides agree.
pub(super) fn orient(
    all: &mut [Sheet],
    edges: &[Edge],
    inside: &[Inside],
    bounds: &[Bounds],
) -> Result<(), PartitionError> {
    let mut signs = vec![0.0; all.len()];
    let firsts: Vec<usize> = (0..all.len())
        .filter(|at| *at == 0 || all[*at].region != all[at - 1].region)
        .collect();
    let told: Vec<Option<f64>> = firsts
        .par_iter()
        .map(|first| {
            let sheet = &all[*first];
            outward(sheet, &inside[sheet.region], &bounds[sheet.region])
        })
        .collect();
    for (first, sign) in firsts.into_iter().zip(told) {
        let region = all[first].region;
        signs[first] = sign.ok_or(PartitionError::NoSides {
            region,
            sheet: first,
        })?;
    }
    let mut changed = true;
    while changed {
        changed = false;
        for edge in edges {
            let [a, b] = &edge.sides;
            let opposite = if a.sheet_is_left() == b.sheet_is_left() {
                -1.0
            } else {
                1.0
            };
            for (from, to) in [(a, b), (b, a)] {
                if signs[from.sheet] != 0.0 && signs[to.sheet] == 0.0 {
                    signs[to.sheet] = opposite * signs[from.sheet];
                    changed = true;
                }
            }
        }
    }
    for (at, sign) in signs.into_iter().enumerate() {
        let region = all[at].region;
        if sign == 0.0 {
            return Err(PartitionError::NoSides { region, sheet: at });
        }
        all[at].outward = sign;
    }
    Ok(())
}

/// 1 if the sheet's normal points out of its region, −1 if into it, by points beside it.
fn outward(sheet: &Sheet, inside: &Inside, bounds: &Bounds) -> Option<f64> {
    // Away from symmetric places, where other sheets are likelier to be near.
    const FRACTIONS: [f64; 4] = [0.517, 0.273, 0.811, 0.094];
    let reach = 1e-6 * bounds.diagonal();
    for fu in FRACTIONS {
        for fv in FRACTIONS {
            let u = sheet.low(0) + fu * sheet.length(0);
            let v = sheet.low(1) + fv * sheet.length(1);
            let (p, pu, pv) = sheet.first_jet(u, v);
            let Some(normal) = pu.cross(pv).try_normalize() else {
                continue;
            };
            let (ahead, behind) = (
                inside.holds(p + reach * normal),
                inside.holds(p - reach * normal),
            );
            if ahead != behind {
                return Some(if behind { 1.0 } else { -1.0 });
            }
        }
    }
    None
}
