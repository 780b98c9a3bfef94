//! Models whose surfaces come from files: the volumes between them, beds that end, and what is said of the fits.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use assembled::{Built, checked, source};
use clinothem::assembly::Engine;
use clinothem::export::data::DataEntry;
use clinothem::model::selection::Selection;

/// Of the plan (m²).
const AREA: f64 = 4000.0 * 3000.0;

#[test]
fn layers_between_surfaces_from_files_have_the_volumes_that_the_data_were_made_with() {
    let built = Built::new(
        checked(&source("from-files/from-files")),
        &Selection::default(),
        Engine::Partition,
    )
    .unwrap();
    assert!(
        built.assembly.proof.holds(),
        "{}",
        built.assembly.proof.failures()
    );
    // By models/from-files/make.py surfaces are parallel to each other, but for the sand: 12 m thick in the west, wedging out at 2600 m.
    let sand = 12.0 * 2600.0 / 2.0 * 3000.0;
    let layers = [
        ("background", 25.0 * AREA),
        ("lower", 20.0 * AREA),
        ("sand", sand),
        ("above-sand", 23.0 * AREA - sand),
        ("middle", 15.0 * AREA),
        ("upper", 15.0 * AREA),
        ("coal", 17.0 * AREA),
    ];
    let mut wrong = Vec::new();
    for (name, expected) in layers {
        let volume = built.plan.names.iter().position(|own| own == name).unwrap();
        let found = built.assembly.measured.size_of(volume);
        // A surface within some decimetres of its data is off by some centimetres in the mean.
        if (found - expected).abs() > 0.08 * AREA {
            wrong.push(format!("{name}: {found} for {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_report_tells_how_near_each_surface_is_to_its_file() {
    let model = checked(&source("from-files/from-files"));
    let data: Vec<DataEntry> = model
        .files()
        .map(|(of, file)| DataEntry::of(of, file))
        .collect();
    let of: Vec<&str> = data.iter().map(|entry| entry.of.as_str()).collect();
    assert_eq!(
        of,
        [
            "domain.base",
            "domain.top",
            "lower",
            "sand",
            "above-sand",
            "middle",
            "upper",
            "coal"
        ]
    );
    for entry in &data {
        let [nx, ny] = entry.control_points;
        assert!(nx * ny < entry.used / 2, "{entry:?}");
        assert!(
            entry
                .tolerance_m
                .is_none_or(|tolerance| entry.most_m <= tolerance)
        );
        assert_eq!(entry.sha256.len(), 64);
    }
    // The noise of `lower` is 0.4 m, its hole 300 m around, and 14 of the 700 points of the top have no height.
    let lower = &data[2];
    assert!((lower.rms_m - 0.4).abs() < 0.015, "{lower:?}");
    assert!((lower.filled_m - 300.0).abs() < 60.0, "{lower:?}");
    assert_eq!(data[1].nulls, 14);
    assert!(
        model
            .notes
            .iter()
            .any(|note| note.message.contains("holes in its data"))
    );
}

#[test]
fn the_same_files_give_the_same_model() {
    let model = || checked(&source("from-files/from-files"));
    assert_eq!(model(), model());
}
