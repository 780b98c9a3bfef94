//! Facies belts, and whole models of them.

use clinothem::assembly::Engine;
use clinothem::assembly::measure::Piece;
use glam::DVec3;

use super::{SET, belts, built, from_text, of_file};

#[test]
fn belts_change_at_their_widths_from_the_shoreline_of_the_younger_sheet() {
    let made = built(from_text(&belts()));
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
fn belts_as_wide_as_clinoforms_are_apart_end_where_the_next_one_begins() {
    // The second belt of a clinothem reaches from its own shoreline to the next one.
    let belts = "belts = [{ name = \"near\", facies = \"sand\", width = 40 }, { name = \"far\", facies = \"sand\", width = 40 }, \
                 { name = \"rest\", facies = \"sand\" }]\n";
    let text = SET
        .replace("AZIMUTH", "270")
        .replace("spacing = { uniform = [40, 120] }", "spacing = 80")
        .replace("first = { uniform = [100, 150] }", "first = 200");
    let plain = built(from_text(&text));
    let made = built(from_text(&(text + belts)));
    for k in 1..=4 {
        let parts = ["near", "far", "rest"].map(|belt| made.size(&format!("set-{k}/{belt}")));
        let wanted = plain.size(&format!("set-{k}"));
        // By age clinoforms are moved by a millionth of the domain's size at most.
        assert!((parts.iter().sum::<f64>() - wanted).abs() < 1e-6 * wanted + 20.0 * 400.0 * 1e-3);
        assert!(parts.iter().all(|part| *part > 1e3), "{parts:?}");
    }
}
