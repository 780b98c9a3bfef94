//! Shapes that exported horizons, well tops and terrain have.

use super::section::Section;
use super::spline::{Grid, integral};
use super::{Report, run, table, text};

/// What deciding by age may shift, as a fraction of the largest volume.
const SHIFT: f64 = 1e-6;

/// A feature's surface in a case.
fn surface(case: &toml::Table, feature: usize) -> Grid {
    Grid::of(&case["feature"][feature]["surface"])
}

/// The volume that holds a point.
fn holder(name: &str, point: [&str; 3]) -> String {
    let arguments = [&point[..], &["--json"]].concat();
    let output = run("locate", &text("real-data", name), &arguments);
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    answer["volume"].as_str().unwrap().to_owned()
}

#[test]
fn a_closed_curve_of_two_nearly_parallel_horizons_is_not_missed() {
    let report = Report::case("real-data", "wrong-island");
    // By an integral of the fitted heights over the plan.
    let miss = report.size("t1") / 981_423_008_303.0 - 1.0;
    assert!(miss.abs() < 1e-6, "t1 misses {miss} of it");
    let sum: f64 = ["background", "t1", "t2"]
        .map(|name| report.size(name))
        .iter()
        .sum();
    assert!((sum / (300e3 * 200e3 * 4500.0) - 1.0).abs() < 1e-12);
}

#[test]
fn a_value_that_means_no_data_is_no_height() {
    let output = run(
        "build",
        &text("real-data", "nodata"),
        &["--formats", "none"],
    );
    if output.status.success() {
        // A hole, filled from its surroundings.
        assert_eq!(holder("nodata", ["700", "700", "-49"]), "top");
        assert_eq!(holder("nodata", ["700", "700", "-53"]), "background");
        assert_eq!(holder("nodata", ["900", "100", "-49"]), "top");
        assert_eq!(holder("nodata", ["900", "100", "-51"]), "background");
    } else {
        assert_eq!(output.status.code(), Some(1));
        let words = String::from_utf8_lossy(&output.stderr);
        assert!(words.contains("99999"), "{words}");
    }
}

#[test]
fn a_bed_may_end_as_a_wedge_at_the_domains_border() {
    let wedge = 1000.0 * 1000.0 / 2.0 * 2.0_f64.to_radians().tan() * 800.0;
    Report::case("real-data", "wedge-out-at-border").assert_sizes(
        &[
            ("background", 4e7),
            ("lower", wedge),
            ("middle", 4e7 - wedge),
        ],
        SHIFT,
    );
}

#[test]
fn a_bed_ends_in_a_wedge_where_the_two_heights_become_equal() {
    let report = Report::case("real-data", "pinch");
    // 20 m in the west, nothing from the middle on: a triangle. The older horizon is level, and nothing swings below it.
    let wedge = 20.0 * 500.0 / 2.0 * 800.0;
    report.assert_sizes(
        &[
            ("background", 32e6),
            ("lower", wedge),
            ("upper", 48e6 - wedge),
        ],
        1e-4,
    );
    assert!((report.size("background") / 32e6 - 1.0).abs() < 1e-9);
    assert_eq!(report.pieces("lower"), 1);
    assert!(report.decides("lower and upper is absent", "400000 m²"));
}

#[test]
fn layers_of_real_horizons_have_no_thickness_where_the_data_have_none() {
    let report = Report::case("real-data", "drogon-zero-thickness");
    let case = table("real-data", "drogon-zero-thickness");
    let base = Grid::of(&case["domain"]["base"]);
    let top = Grid::of(&case["domain"]["top"]);
    let (therys, valysar) = (surface(&case, 0), surface(&case, 1));
    let all = [&base, &therys, &valysar, &top];
    let right = [
        (
            "background",
            integral(&all, |z| (z[1].min(z[2]).min(z[3]) - z[0]).max(0.0)),
        ),
        (
            "therys",
            integral(&all, |z| (z[2].min(z[3]) - z[1].max(z[0])).max(0.0)),
        ),
        (
            "valysar",
            integral(&all, |z| (z[3] - z[2].max(z[0])).max(0.0)),
        ),
    ];
    let whole: f64 = right.iter().map(|one| one.1).sum();
    for (name, size) in right {
        // Where a thickness is nothing, splines of these heights cross each other again and again: by so little in all.
        let miss = (report.size(name) - size) / whole;
        assert!(miss.abs() < 3e-5, "{name} misses {miss} of the whole");
    }
}

#[test]
fn noise_of_exported_horizons_makes_no_beds_below_the_least_thickness() {
    let noisy = text("real-data", "drogon-zero-thickness");
    let report = Report::of(&noisy, &["--set", "domain.least_thickness=0.1"]);
    // Where the lowest layer ends the data differ by 2 to 8 cm; with these it has islands.
    assert_eq!(report.pieces("background"), 1);
    assert!(report.pieces("therys") < 10);
    let words = "what lies between the domain's base and therys is absent";
    assert!(report.decides(words, "no more than 1.00e-1 m"));
}

#[test]
fn outer_faces_cover_steep_terrain() {
    let report = Report::case("real-data", "steep-top");
    let outer = |name| report.volume(name)["outer_area_m2"].as_f64().unwrap();
    let skin = outer("background") + outer("cover");
    assert!((skin - 1_341_463.69).abs() < 0.01, "{skin}");
    let plan = 450.0 * 450.0;
    // Terraces of 300 and 600 m, antisymmetric about the middle: 450 m on the average.
    report.assert_sizes(
        &[("background", 200.0 * plan), ("cover", 250.0 * plan)],
        1e-9,
    );
}

#[test]
fn the_area_of_a_steep_horizon_is_its_integral() {
    let report = Report::case("real-data", "steep-horizon-area");
    let area = report.volume("cover")["neighbours"][0]["area_m2"]
        .as_f64()
        .unwrap();
    assert!((area - 328_963.69).abs() < 0.01, "{area}");
}

#[test]
fn a_bed_of_one_centimetre_is_a_bed() {
    let report = Report::case("real-data", "thin-1cm");
    let miss = report.size("lower") - 800_000.0;
    assert!(miss.abs() < 10.0, "{miss}");
}

#[test]
fn world_coordinates_change_no_volume() {
    let case = table("real-data", "utm");
    let grid = surface(&case, 0);
    let above = integral(&[&grid], |z| -1000.0 - z[0]);
    let report = Report::case("real-data", "utm");
    let whole = 10e3 * 8e3 * 2000.0;
    // The splines here are integrated to some 1e-8.
    report.assert_sizes(&[("background", whole - above), ("h", above)], 1e-7);
    assert_eq!((report.pieces("background"), report.pieces("h")), (1, 1));
}

#[test]
fn a_right_model_is_proven_at_every_level() {
    for level in ["fast", "full"] {
        let text = text("real-data", "full-proof-false-alarm");
        // With the distances between turns that it was made with.
        let set = "feature.set.turns=[60, 120]";
        let report = Report::of(&text, &["--proof", level, "--set", set]);
        let size = report.size("set-0/b2");
        // That value is of boundaries to a millimetre; these are to a twenty-thousandth of the unit's thickness, over 20 km.
        assert!((size / 1.226_067e9 - 1.0).abs() < 1e-4, "{size}");
        let report = Report::of(&text, &["--proof", level]);
        // By the kernel's Gauss-Kronrod integrals, which agree with ours to 1e-8.
        let miss = report.size("set-0/b2") / 1.220_568_57e9 - 1.0;
        assert!(miss.abs() < 1e-7, "{level}: {miss}");
    }
}

#[test]
fn a_channel_may_end_at_the_walls_beside_a_horizon() {
    let channel = 1000.0 * Section::new(80.0, 10.0).area();
    Report::case("real-data", "channel-border-to-border").assert_sizes(
        &[
            ("background", 80.0 * 8e5 - channel),
            ("h", 20.0 * 8e5),
            ("c1", channel),
        ],
        SHIFT,
    );
}

#[test]
fn a_thalweg_may_run_along_a_horizon_at_an_angle_to_the_walls() {
    // 1000 m east while it goes 200 m north on 1200 m.
    let way = 1000.0 * 1200.0_f64.hypot(200.0) / 1200.0;
    let channel = way * Section::new(80.0, 10.0).area();
    Report::case("real-data", "channel-base-on-horizon").assert_sizes(
        &[("background", 4e7), ("h", 4e7 - channel), ("c", channel)],
        SHIFT,
    );
}

#[test]
fn a_film_between_two_horizons_is_built_as_thin_as_it_is() {
    // Thinner than any distance that is looked at beside a face elsewhere; the block is 1 km wide.
    for (film, dip) in [
        (1e-2, 0.0),
        (1e-4, 0.0),
        (5e-6, 0.0),
        (1e-2, 3.0),
        (1e-4, 3.0),
    ] {
        let horizon = |id: &str, elevation: f64| {
            format!(
                "[[feature]]\nid = \"{id}\"\nkind = \"horizon\"\nfacies = \"mud\"\n\
                 surface = {{ dipping = {{ through = [500, 400, {elevation}], dip_deg = {dip}, azimuth_deg = 70 }} }}\n"
            )
        };
        let model = format!(
            "name = \"Film\"\n[domain]\nx = [0, 1000]\ny = [0, 800]\nz = [-100, 0]\nfacies = \"mud\"\n[facies.mud]\n{}{}",
            horizon("film", -50.0),
            horizon("above", -50.0 + film)
        );
        let report = Report::of(&model, &[]);
        let miss = report.size("film") / (film * 1000.0 * 800.0) - 1.0;
        // Elevations have 53 digits: of 50 m the last one is 7e-15 m.
        assert!(miss.abs() < 1e-7, "film {film}, dip {dip}: {miss}");
    }
}
