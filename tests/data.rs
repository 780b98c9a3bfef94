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
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};

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

/// The surfaces of models/field, as models/field/make.py has them: what is true, and what the data are too high by.
mod field {
    fn tilted(x: f64, y: f64) -> f64 {
        -2205.0 + 0.04 * (x - 2000.0) + 25.0 * (-((y - 1500.0).powi(2)) / 1.2e6).exp()
    }

    fn unconformity(x: f64, y: f64) -> f64 {
        -2162.0 + 7.0 * (x / 1300.0).cos() + 4.0 * (y / 800.0).sin()
    }

    fn miss(x: f64, y: f64) -> f64 {
        3.0 + 0.0008 * (x - 2000.0) + 2.0 * (x / 900.0).sin() * (y / 1100.0).cos()
    }

    /// Thickness of each volume at a place, from the oldest on, with that part of what the data are too high by.
    fn thicknesses(x: f64, y: f64, part: f64) -> [f64; 6] {
        let (tilted, cut, miss) = (tilted(x, y), unconformity(x, y), part * miss(x, y));
        let bottoms = [
            tilted - 100.0,
            tilted - 62.0 + miss,
            tilted - 30.0 - 4.0 * (y / 600.0).sin() + miss,
            tilted + miss,
            tilted + 34.0 - 0.002 * x + miss,
        ];
        let top = -2104.0 - 0.004 * (y - 1500.0) + 3.0 * (x / 1500.0).sin();
        let mut thicknesses = [0.0; 6];
        for (at, bottom) in bottoms.iter().enumerate() {
            let above = bottoms.get(at + 1).map_or(cut, |above| above.min(cut));
            thicknesses[at] = (above - bottom.min(cut)).max(0.0);
        }
        thicknesses[5] = top - cut;
        thicknesses
    }

    /// The volumes, by the midpoints of cells of 5 m.
    pub(super) fn volumes(part: f64) -> [f64; 6] {
        let mut volumes = [0.0; 6];
        for i in 0..800 {
            for j in 0..600 {
                let (x, y) = (5.0 * f64::from(i) + 2.5, 5.0 * f64::from(j) + 2.5);
                for (volume, thickness) in volumes.iter_mut().zip(thicknesses(x, y, part)) {
                    *volume += 25.0 * thickness;
                }
            }
        }
        volumes
    }
}

/// Of the volumes of models/field, in the order of the file.
fn sizes(model: Model) -> Vec<f64> {
    let built = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
    let proof = &built.assembly.proof;
    assert!(proof.holds(), "{}", proof.failures());
    let names = [
        "background",
        "lower-sand",
        "coal-measures",
        "upper-sand",
        "marine-shale",
        "unconformity",
    ];
    names.map(|name| built.size(name)).to_vec()
}

#[test]
fn a_field_whose_horizons_wells_and_tops_are_files_has_the_volumes_of_its_data_and_nears_the_true_ones_by_its_tops()
 {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("models/field");
    let text = std::fs::read_to_string(folder.join("field.toml")).unwrap();
    let plain = text.replace("honours_tops = { reach = 900 }\n", "");
    let read = |text: &str| Source::from_text("field.toml", text, Format::Toml).in_folder(&folder);
    // As the data have them: surfaces fitted to 0.1 m are off by some millimetres in the mean, those with noise by centimetres.
    let seen = sizes(checked(&read(&plain)));
    for (found, expected) in seen.iter().zip(field::volumes(1.0)) {
        let off = (found - expected).abs();
        assert!(off < 0.05 * AREA, "{found} for {expected}");
    }
    // Wells take away what the data are too high by within their reach, which is a part of the field.
    let with_tops = sizes(checked(&read(&text)));
    let (miss, truth) = (field::volumes(1.0)[0], field::volumes(0.0)[0]);
    let left = (with_tops[0] - truth) / (miss - truth);
    assert!((0.7..0.95).contains(&left), "{left}");
}

#[test]
fn the_fields_tops_are_met_and_the_report_knows_how_far_off_they_were() {
    let model = checked(&source("field/field"));
    assert_eq!(model.wells.len(), 5);
    let realisation = Realisation::new(&model, &Selection::default()).unwrap();
    for top in &model.tops {
        let off = top.misfit(&realisation).above.unwrap();
        let honours = model.features[top.horizon].id != "unconformity";
        // The unconformity has no tops to honour: it is as near as its data, along a slope of 1 in 100.
        let most = if honours { 1e-5 } else { 0.15 };
        assert!(off.abs() < most, "{off} {top:?}");
    }
    let decisions = realisation.decisions.join("\n");
    for horizon in [
        "lower-sand passes through 4",
        "coal-measures passes through 4",
    ] {
        assert!(decisions.contains(horizon), "{decisions}");
    }
}

#[test]
fn beds_whose_thickness_comes_from_a_file_have_that_and_end_where_it_is_nothing() {
    let folder = tempfile::tempdir().unwrap();
    // In the world and in feet: a bed of 12 m in the west that wedges out at x = 600 m, and one of 10 to 18 m above it.
    let file = |name: &str, thickness: &dyn Fn(f64, f64) -> f64| {
        let mut lines = Vec::new();
        for i in -2..=22 {
            for j in -2..=17 {
                let (x, y) = (50.0 * f64::from(i), 50.0 * f64::from(j));
                let (east, north) = (456_000.0 + x, 6_782_000.0 + y);
                lines.push(format!("{east} {north} {:.4}\n", thickness(x, y) / 0.3048));
            }
        }
        std::fs::write(folder.path().join(name), lines.concat()).unwrap();
    };
    file("wedge.xyz", &|x, _| (12.0 * (1.0 - x / 600.0)).max(0.0));
    file("sheet.xyz", &|x, y| 10.0 + 0.004 * x + 0.005 * y);
    let text = r#"
name = "Isochores"
origin = [456000, 6782000, 100]
[domain]
x = [0, 1000]
y = [0, 800]
z = [-120, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "base"
kind = "horizon"
facies = "sand"
surface = { dipping = { through = [500, 400, -70], dip_deg = 1, azimuth_deg = 60 } }
[[feature]]
id = "shale"
kind = "horizon"
facies = "mud"
surface = { above = "base", thickness = { file = "wedge.xyz", tolerance = 0.05, unit = "ft" } }
[[feature]]
id = "cover"
kind = "horizon"
facies = "sand"
surface = { above = "shale", thickness = { file = "sheet.xyz", tolerance = 0.01, unit = "ft" } }
"#;
    let source = Source::from_text("isochores.toml", text, Format::Toml).in_folder(folder.path());
    let model = checked(&source);
    let of: Vec<&str> = model.files().map(|(of, _)| of).collect();
    assert_eq!(of, ["shale", "cover"]);
    let built = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
    let proof = &built.assembly.proof;
    assert!(proof.holds(), "{}", proof.failures());
    // Between the base and the shale: the wedge; a surface within 0.05 m of it is off by less in the mean.
    let wedge = 12.0 * 600.0 / 2.0 * 800.0;
    assert!(
        (built.size("base") - wedge).abs() < 0.03 * 800_000.0,
        "{} for {wedge}",
        built.size("base")
    );
    let sheet = (10.0 + 0.004 * 500.0 + 0.005 * 400.0) * 800_000.0;
    assert!(
        (built.size("shale") - sheet).abs() < 0.03 * 800_000.0,
        "{} for {sheet}",
        built.size("shale")
    );
    // East of where it ends there is nothing of it.
    for (x, within) in [(550.0, true), (700.0, false), (900.0, false)] {
        let z = |x: f64| {
            -70.0 - (1.0_f64.to_radians()).tan() * (x - 500.0) * 60.0_f64.to_radians().sin()
        };
        let at = glam::DVec3::new(x, 400.0, z(x) + 0.3);
        let is_wedge = built.owners.at(at) == Some(built.volume("base"));
        assert_eq!(is_wedge, within, "{x}");
    }
}
