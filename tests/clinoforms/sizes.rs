//! Sizes of clinothems by the formula of their sheets.

use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::{DVec2, DVec3};

use super::assembled::Built;
use super::formula::{Sheet, TD, TS, by_formula, sheets, sheets_of};
use super::{SET, built, from_text};

/// The clinothems of [`SET`] have the sizes that the formula of its sheets gives, and were built at the first attempt.
fn assert_sizes(made: &Built, sheets: &[Sheet], azimuth: f64, [low, high]: [DVec3; 2]) {
    let seed = made.model.seed;
    let wanted = by_formula(sheets, azimuth.to_radians(), low, high);
    let names = ["background", "set-1", "set-2", "set-3", "set-4"];
    let block = (high - low).element_product();
    for (name, wanted) in names.iter().zip(wanted) {
        let size = made.size(name);
        // The sum over points is good to about 1e-6 of the block.
        assert!(
            (size - wanted).abs() < 5e-6 * block,
            "seed {seed}, {azimuth}°: {name} is {size}, not {wanted}"
        );
    }
    assert!(made.assembly.failed.is_empty(), "seed {seed}, {azimuth}°");
}

#[test]
fn clinothems_have_the_sizes_that_their_formula_gives_for_any_direction() {
    let mut landings = 0;
    for azimuth in [0.0_f64, 90.0, 137.0, 180.0, 270.0, 320.0] {
        let made = built(from_text(&SET.replace("AZIMUTH", &azimuth.to_string())));
        let (sheets, low, high) = sheets(&made, azimuth);
        let toe = |sheet: &Sheet| sheet.origin + sheet.length;
        landings += sheets
            .windows(2)
            .filter(|two| toe(&two[1]) < toe(&two[0]))
            .count();
        assert_sizes(&made, &sheets, azimuth, [low, high]);
    }
    assert!(
        landings > 5,
        "too few sheets that land on older ones: {landings}"
    );
}

/// Whether the toes of two sheets cross at a strike that the domain has at that place.
fn toes_cross(sheets: &[Sheet], azimuth: f64, [low, high]: [DVec3; 2]) -> bool {
    let dip = DVec2::new(azimuth.sin(), azimuth.cos());
    let strike = DVec2::new(dip.y, -dip.x);
    let half = (high - low).truncate() / 2.0;
    let toe = |sheet: &Sheet, q: f64| {
        sheet.origin + (TD + sheet.length) * (1.0 - (q / (TS + sheet.length)).powi(2)).sqrt()
    };
    let reach = half.length();
    let steps = 2000;
    let crosses = |a: &Sheet, b: &Sheet| {
        (0..steps).any(|k| {
            let q = |k: i32| reach * (2.0 * f64::from(k) / f64::from(steps) - 1.0);
            let off = |q: f64| toe(a, q) - toe(b, q);
            let place = toe(a, q(k)) * dip + q(k) * strike;
            place.abs().cmplt(0.98 * half).all() && off(q(k)) * off(q(k + 1)) < 0.0
        })
    };
    (0..sheets.len()).any(|i| (0..i).any(|j| crosses(&sheets[i], &sheets[j])))
}

#[test]
fn clinothems_whose_toes_cross_on_their_base_have_the_sizes_that_their_formula_gives() {
    let mut crossing = 0;
    for seed in 1..400 {
        let azimuth = f64::from(seed * 37 % 360);
        let text = SET
            .replace("seed = 5", &format!("seed = {seed}"))
            .replace("x = [0, 900]", "x = [0, 6000]")
            .replace("y = [0, 400]", "y = [0, 5000]")
            .replace("[100, 150]", "[2500, 3000]")
            .replace("AZIMUTH", &azimuth.to_string());
        let model = from_text(&text);
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let (low, high) = (realisation.extent.low(), realisation.extent.high());
        let sheets = sheets_of(&realisation, azimuth, [low, high]);
        if !toes_cross(&sheets, azimuth.to_radians(), [low, high]) {
            continue;
        }
        crossing += 1;
        let made = built(model);
        assert_sizes(&made, &sheets, azimuth, [low, high]);
        if crossing == 6 {
            return;
        }
    }
    panic!("only {crossing} sets have toes that cross");
}

#[test]
fn sheets_flatter_than_can_be_told_apart_are_refused() {
    let set = SET.replace("AZIMUTH", "90");
    let flat = from_text(&(set.clone() + "exponent = 3\ntoe = 0"));
    let flat = Realisation::new(&flat, &Selection::default()).unwrap_err();
    assert!(flat.to_string().contains("give a toe above 0"), "{flat}");
    // Left out, the toe is not tangent then.
    let steeper = built(from_text(&(set + "exponent = 3")));
    assert!(steeper.assembly.failed.is_empty());
}
