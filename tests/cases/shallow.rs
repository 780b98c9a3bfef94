//! Sheets that cross at a small angle, a hundredth and less: their curve is as near to both as any other, and much farther from its
//! place.

use super::Report;

/// A model that the partition makes as it is, with volumes that add up to the domain's.
fn assert_is_built_as_it_is(name: &str) {
    let report = Report::of(&super::text("shallow", name), &["--engine", "partition"]);
    let assembly = &report.0["assembly"];
    assert_eq!(assembly["remedy"], "none", "{name}");
    assert!(assembly["failed_attempts"].as_array().unwrap().is_empty());
    let volumes = report.0["volumes"].as_array().unwrap();
    let sum: f64 = volumes
        .iter()
        .map(|one| one["volume_m3"].as_f64().unwrap())
        .sum();
    let domain = report.0["domain"]["volume_m3"].as_f64().unwrap();
    assert!((sum / domain - 1.0).abs() < 1e-9, "{name}: {sum} {domain}");
}

#[test]
fn gentle_toes_end_at_a_wall() {
    // The crossings of clinoforms with the horizons below and above them pass through the walls.
    for name in ["toes-at-a-wall", "toes-at-a-wall-with-bodies"] {
        assert_is_built_as_it_is(name);
    }
}
