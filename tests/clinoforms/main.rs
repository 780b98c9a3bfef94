//! Clinoform sets as solids, made by the partition kernel alone and proven in full.
//!
//! The oracle is the formula of the sheets itself (two ellipses, a power in between), integrated on a grid of points
//! from the numbers that were drawn: no spline and no kernel.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "../assembled/mod.rs"]
mod assembled;
mod belts;
mod formula;
mod left_out;
mod sizes;
mod stacked;

use assembled::{Built, checked, source};
use clinothem::assembly::Engine;
use clinothem::model::Model;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;

fn built(model: Model) -> Built {
    Built::new(model, &Selection::default(), Engine::Partition).unwrap()
}

fn from_text(text: &str) -> Model {
    assembled::from_text(text, &[])
}

fn of_file(name: &str, seed: u64) -> Model {
    let mut model = checked(&source(&format!("{name}/{name}")));
    model.seed = seed;
    model
}

fn drawn(realisation: &Realisation, parameter: &str) -> f64 {
    let all = realisation.instances.iter().flat_map(|one| &one.drawn);
    let mut found = all.filter(|(name, _)| name == parameter);
    found
        .next()
        .unwrap_or_else(|| panic!("{parameter} was not drawn"))
        .1
}

const SET: &str = r#"
name = "set"
seed = 5
[domain]
x = [0, 900]
y = [0, 400]
z = [-20, 0]
facies = "sand"
[facies.sand]
[[feature]]
id = "set"
kind = "clinoforms"
facies = "sand"
azimuth_deg = AZIMUTH
sheets = 4
first = { uniform = [100, 150] }
spacing = { uniform = [40, 120] }
length = { uniform = [150, 700] }
"#;

/// Sheets 120 apart, the first one 130 from the west, each 400 long, with three belts.
fn belts() -> String {
    let belts = r#"
belts = [
  { name = "near", facies = "sand", width = 60 },
  { name = "middle", facies = "sand", width = 50 },
  { name = "far", facies = "sand" },
]"#;
    let text = SET
        .replace("AZIMUTH", "90")
        .replace("{ uniform = [40, 120] }", "120")
        .replace("{ uniform = [100, 150] }", "130")
        .replace("{ uniform = [150, 700] }", "400");
    text + belts
}
