//! Realisations: draws that know nothing of each other, rejections as often as theory says, banks that overhang.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "../assembled/checked.rs"]
mod checked;
mod ellipsoids;
mod identities;
mod meshing;
mod owners;
mod references;
mod rejections;
mod table_1;

use std::collections::BTreeMap;

use checked::from_text as model;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::DVec3;

fn realise(text: &str, overrides: &[&str]) -> Realisation {
    Realisation::new(&model(text, overrides), &Selection::default()).unwrap()
}

const BELT: &str = include_str!("../../models/channel-belt/channel-belt.toml");

/// A number from 0 to 1 that owes nothing to the program's streams (xorshift64*).
fn unit(state: &mut u64) -> f64 {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    #[allow(clippy::cast_precision_loss, reason = "53 bits are kept")]
    let value = (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64;
    value / 9_007_199_254_740_992.0
}

/// What was drawn, and the control points that came of it.
type Drawn = (Vec<(String, f64)>, Vec<DVec3>);

/// Every instance's draws and control points, by name.
fn instances(realisation: &Realisation) -> BTreeMap<String, Drawn> {
    realisation
        .instances
        .iter()
        .map(|one| {
            let name = realisation.volumes[one.volume].name.clone();
            let sheets = one.body.sheets().unwrap();
            let net = sheets.iter().flat_map(|sheet| sheet.1.net().to_vec());
            (name, (one.drawn.clone(), net.collect()))
        })
        .collect()
}
