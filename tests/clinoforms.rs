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

mod assembled;

use assembled::{Built, checked, source, without};
use clinothem::assembly::{Engine, measure::Piece};
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};
use glam::{DVec2, DVec3};

fn built(model: Model) -> Built {
    Built::new(model, &Selection::default(), Engine::Partition).unwrap()
}

fn from_text(text: &str) -> Model {
    checked(&Source::from_text("set.toml", text, Format::Toml))
}

fn of_file(name: &str, seed: u64) -> Model {
    let mut model = checked(&source(&format!("{name}/{name}")));
    model.seed = seed;
    model
}

fn drawn(made: &Built, parameter: &str) -> f64 {
    let all = made.realisation.instances.iter().flat_map(|one| &one.drawn);
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

/// A sheet's formula.
struct Sheet {
    origin: f64,
    length: f64,
}

const TD: f64 = 3000.0;
const TS: f64 = 6000.0;

impl Sheet {
    /// The sheet's part of the unit's height.
    fn height(&self, d: f64, q: f64) -> f64 {
        let ellipse = |td: f64, ts: f64| self.origin + td * (1.0 - (q / ts).powi(2)).sqrt();
        let (top, toe) = (ellipse(TD, TS), ellipse(TD + self.length, TS + self.length));
        let u = ((d - top) / (toe - top)).clamp(0.0, 1.0);
        (1.0 - u).powi(2)
    }
}

/// Sizes of all clinothems, oldest first, by sums over a grid of points.
fn by_formula(sheets: &[Sheet], azimuth: f64, low: DVec3, high: DVec3) -> Vec<f64> {
    const CELLS: [u32; 2] = [1800, 800];
    let dip = DVec2::new(azimuth.sin(), azimuth.cos());
    let strike = DVec2::new(dip.y, -dip.x);
    let middle = (low + high).truncate() / 2.0;
    let size = high - low;
    let cell = size.x * size.y / f64::from(CELLS[0] * CELLS[1]);
    let mut sums = vec![0.0; sheets.len() + 1];
    for i in 0..CELLS[0] {
        for j in 0..CELLS[1] {
            let part = DVec2::new(
                (f64::from(i) + 0.5) / f64::from(CELLS[0]),
                (f64::from(j) + 0.5) / f64::from(CELLS[1]),
            );
            let at = low.truncate() + part * size.truncate() - middle;
            let (d, q) = (at.dot(dip), at.dot(strike));
            let mut below = 0.0_f64;
            for (k, sheet) in sheets.iter().enumerate() {
                // A younger sheet ends where it meets an older one.
                let above = sheet.height(d, q).max(below);
                sums[k] += (above - below) * size.z * cell;
                below = above;
            }
            sums[sheets.len()] += (1.0 - below) * size.z * cell;
        }
    }
    sums
}

#[test]
fn clinothems_have_the_sizes_that_their_formula_gives_for_any_direction() {
    let mut landings = 0;
    for azimuth in [0.0_f64, 90.0, 137.0, 180.0, 270.0, 320.0] {
        let made = built(from_text(&SET.replace("AZIMUTH", &azimuth.to_string())));
        let extent = made.owners.extent();
        let (low, high) = (extent.low(), extent.high());
        let dip = DVec2::new(azimuth.to_radians().sin(), azimuth.to_radians().cos());
        let half = (high - low).truncate() / 2.0;
        let up_dip = -(half.x * dip.x.abs() + half.y * dip.y.abs());
        let mut origin = up_dip - TD;
        let sheets: Vec<Sheet> = (1..=4)
            .map(|k| {
                origin += match k {
                    1 => drawn(&made, "first"),
                    _ => drawn(&made, &format!("spacing-{k}")),
                };
                let length = drawn(&made, &format!("length-{k}"));
                Sheet { origin, length }
            })
            .collect();
        let toe = |sheet: &Sheet| sheet.origin + sheet.length;
        landings += sheets
            .windows(2)
            .filter(|two| toe(&two[1]) < toe(&two[0]))
            .count();
        let wanted = by_formula(&sheets, azimuth.to_radians(), low, high);
        let names = ["background", "set-1", "set-2", "set-3", "set-4"];
        let block = (high - low).element_product();
        for (name, wanted) in names.iter().zip(wanted) {
            let size = made.size(name);
            // The sum over points is good to about 1e-6 of the block.
            assert!(
                (size - wanted).abs() < 5e-6 * block,
                "{azimuth}°: {name} is {size}, not {wanted}"
            );
        }
        assert!(made.assembly.failed.is_empty());
    }
    assert!(
        landings > 5,
        "too few sheets that land on older ones: {landings}"
    );
}

#[test]
fn belts_change_at_their_widths_from_the_shoreline_of_the_younger_sheet() {
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
    let made = built(from_text(&(text + belts)));
    // Eastwards: the shoreline's apex is at x = 130, in the middle of y; the sheets are 120 apart.
    for (clinothem, shoreline) in [(0, 130.0), (1, 250.0), (2, 370.0), (3, 490.0)] {
        for (width, belt, next) in [(60.0, "near", "middle"), (110.0, "middle", "far")] {
            let x = shoreline + width;
            let u = (x - shoreline) / 400.0;
            // Just below the younger sheet.
            let z = -20.0 + 20.0 * (1.0 - u) * (1.0 - u) - 0.01;
            for (x, belt) in [(x - 0.01, belt), (x + 0.01, next)] {
                let owner = made.owners.at(DVec3::new(x, 200.0, z)).unwrap();
                let name = &made.realisation.volumes[owner].name;
                assert_eq!(*name, format!("set-{clinothem}/{belt}"), "x = {x}");
            }
        }
    }
}

#[test]
fn facies_belts_and_clinoforms_of_table_1_are_proven_in_full() {
    for seed in [7, 11] {
        let made = built(of_file("parasequence", seed));
        assert_eq!(made.assembly.engine, Engine::Partition);
        assert!(made.assembly.failed.is_empty(), "seed {seed}");
        // Belts of one clinothem, whichever of them are in the domain, and every solid, are something.
        assert!(made.assembly.measured.pieces.len() > 8, "seed {seed}");
    }
}

#[test]
fn the_coastal_model_is_proven_in_full_and_its_plain_stays_below_its_parasequences() {
    let made = built(of_file("coastal", 2));
    assert!(made.assembly.failed.is_empty());
    let [x, y, z] = made.model.domain.size();
    let (plain, shore): (Vec<_>, Vec<_>) = made
        .assembly
        .measured
        .pieces
        .iter()
        .partition(|piece| !made.realisation.volumes[piece.volume].name.contains('/'));
    let sum = |pieces: &[&Piece]| pieces.iter().map(|p| p.size).sum::<f64>();
    let of_shore = x * y * 21.336;
    assert!((sum(&shore) - of_shore).abs() < 1e-8 * of_shore);
    assert!((sum(&plain) - x * y * (z - 21.336)).abs() < 1e-8 * of_shore);
    // What lies under the transgression is seen from above it: channels and belts share parts of it.
    let between = made.assembly.measured.contacts.keys().filter(|(a, b)| {
        let kind = |volume: &usize| made.realisation.volumes[*volume].kind.as_str();
        [kind(a), kind(b)] == ["channel", "clinoforms"]
    });
    assert!(between.count() > 0);
}

#[test]
fn sheets_flatter_than_can_be_told_apart_and_sets_without_their_top_are_refused() {
    let refused = |model: &Model, ids: &[&str]| {
        Realisation::new(model, &without(ids))
            .unwrap_err()
            .to_string()
    };
    let set = SET.replace("AZIMUTH", "90");
    let flat = refused(&from_text(&(set.clone() + "exponent = 3\ntoe = 0")), &[]);
    assert!(flat.contains("give a toe above 0"), "{flat}");
    // Left out, the toe is not tangent then.
    let steeper = built(from_text(&(set + "exponent = 3")));
    assert!(steeper.assembly.failed.is_empty());
    let topless = refused(&of_file("coastal", 7), &["flooding"]);
    assert!(
        topless.contains("\"flooding\", which does not take part"),
        "{topless}"
    );
}
