//! Bodies and horizons that touch, coincide or are alike: decided by age, and right.

use std::f64::consts::PI;

use super::section::Section;
use super::spline::at;
use super::{Report, text};

/// The domain: 1 km × 1 km × 40 m (m³).
const BLOCK: f64 = 4e7;
/// What deciding by age may shift, as a fraction of the largest volume.
const SHIFT: f64 = 1e-6;

/// Section of all channels here but the narrower one: 60 m by 8 m.
fn section() -> Section {
    Section::new(60.0, 8.0)
}

/// The bodies' sizes in a case without horizons (m³); the rest is background.
fn bodies(name: &str) -> Vec<(&'static str, f64)> {
    let across = 1000.0 * section().area();
    let diagonal = 1000.0 * 2.0_f64.sqrt() * section().area() - 2.0 * section().moment();
    let nodule = 4.0 / 3.0 * PI * 20.0 * 20.0 * 5.0;
    match name {
        "bottom-at-base" => vec![("a", across)],
        "wall-to-wall" => vec![("c", across)],
        "corner-to-corner" | "through-corner" => vec![("a", diagonal)],
        // Made by OpenCASCADE's general fuse, which has nothing of the partition.
        "count-on-one-course" => vec![
            ("c-1", 145_189.322_7),
            ("c-2", 122_012.375_3),
            ("c-3", 36_669.206_6),
            ("c-4", 299_322.283_1),
            ("c-5", 294_661.321_6),
        ],
        "cross-90-equal" => vec![("a", across - section().crossing()), ("b", across)],
        // The younger runs 600 m east on 1200 m north.
        "cross-60-equal-tops" => {
            let longer = 5.0_f64.sqrt() / 2.0;
            let common = section().crossing() * longer;
            vec![("a", across - common), ("b", across * longer)]
        }
        "ellipsoids-touch" => vec![("m", nodule), ("n", nodule)],
        "end-to-end" => vec![("a", across / 2.0), ("b", across / 2.0)],
        "parallel-rims-touch" => vec![("a", across), ("b", across)],
        "same-course-narrower" => {
            let narrower = 1000.0 * Section::new(30.0, 8.0).area();
            vec![("a", across - narrower), ("b", narrower)]
        }
        other => panic!("no case {other}"),
    }
}

fn assert_right(name: &str) {
    let mut right = bodies(name);
    let sum: f64 = right.iter().map(|one| one.1).sum();
    right.push(("background", BLOCK - sum));
    let alone = text("contacts", name);
    Report::of(&alone, &[]).assert_sizes(&right, SHIFT);
    // The same beside a horizon that touches nothing.
    let over = format!(
        "{alone}\n[[feature]]\nid = \"over\"\nkind = \"horizon\"\nfacies = \"silt\"\nsurface = {{ level = -4 }}\n"
    );
    right.pop();
    right.extend([("background", BLOCK - 4e6 - sum), ("over", 4e6)]);
    Report::of(&over, &[]).assert_sizes(&right, SHIFT);
}

#[test]
fn a_thalweg_may_lie_on_the_domains_base() {
    assert_right("bottom-at-base");
}

#[test]
fn a_channel_may_end_exactly_at_the_domains_walls() {
    assert_right("wall-to-wall");
}

#[test]
fn a_channel_may_end_exactly_in_the_domains_corners() {
    assert_right("corner-to-corner");
}

#[test]
fn a_channel_may_pass_through_the_domains_corners() {
    assert_right("through-corner");
}

#[test]
fn channels_on_one_course_take_from_the_older_ones_what_is_theirs() {
    assert_right("count-on-one-course");
}

#[test]
fn equal_channels_cross_at_right_angles_in_squares_at_every_depth() {
    assert_right("cross-90-equal");
}

#[test]
fn equal_channels_cross_at_an_angle_in_parallelograms_at_every_depth() {
    assert_right("cross-60-equal-tops");
}

#[test]
fn ellipsoids_may_touch_in_a_point() {
    assert_right("ellipsoids-touch");
}

#[test]
fn channels_may_meet_end_to_end() {
    assert_right("end-to-end");
}

#[test]
fn channels_side_by_side_may_share_a_rim() {
    assert_right("parallel-rims-touch");
}

#[test]
fn a_narrower_channel_on_the_same_course_lies_in_the_older_one() {
    assert_right("same-course-narrower");
}

#[test]
fn a_thalweg_may_lie_on_a_horizon() {
    let channel = 1000.0 * section().area();
    Report::case("contacts", "bottom-at-horizon").assert_sizes(
        &[("background", 22e6), ("h", 18e6 - channel), ("a", channel)],
        SHIFT,
    );
}

#[test]
fn an_ellipsoid_may_touch_a_horizon() {
    let nodule = 4.0 / 3.0 * PI * 20.0 * 20.0 * 5.0;
    Report::case("contacts", "ellipsoid-touches-horizon").assert_sizes(
        &[("background", 20e6), ("h", 20e6 - nodule), ("n", nodule)],
        SHIFT,
    );
}

#[test]
fn a_horizon_may_pass_through_two_edges_of_the_block() {
    // It reaches the base 40 m / tan 2.29061° from the western edge, a hair from the eastern one.
    let tangent = 2.290_610_f64.to_radians().tan();
    let reach = (40.0 / tangent).min(1000.0);
    let above = 1000.0 * (tangent * reach * reach / 2.0 + 40.0 * (1000.0 - reach));
    Report::case("contacts", "horizon-diagonal-of-block")
        .assert_sizes(&[("background", BLOCK - above), ("h", above)], SHIFT);
}

#[test]
fn a_horizon_may_meet_the_domains_top_along_an_edge() {
    Report::case("contacts", "horizon-meets-top-along-edge")
        .assert_sizes(&[("background", BLOCK - 6e6), ("h", 6e6)], SHIFT);
}

#[test]
fn a_horizon_may_touch_an_older_one_at_a_node() {
    // Through 0, 1, 0 the spline has an average of 5/8; both ways: 25/64 of the 5 m between the two are missing.
    let bed = 5e6 * (1.0 - 25.0 / 64.0);
    Report::case("contacts", "horizon-node-at-level")
        .assert_sizes(&[("background", 20e6), ("h", bed), ("g", 20e6 - bed)], 1e-4);
}

#[test]
fn a_horizon_may_be_equal_to_an_older_one_over_an_area() {
    let report = Report::case("contacts", "horizon-grid-partly-level");
    // The level stays what it is, below the younger horizon too.
    assert!((report.size("background") / 20e6 - 1.0).abs() < 1e-9);
    // The bed begins at the second column, from where its spline rises to 4 m as if it came from 4 m below.
    let mean: f64 = (0..30_000)
        .map(|k| at(&[-4.0, 0.0, 4.0, 4.0], (f64::from(k) + 0.5) / 1e4).max(0.0))
        .sum::<f64>()
        / 3e4;
    let bed = 1e6 * mean;
    report.assert_sizes(&[("background", 20e6), ("h", bed), ("g", 20e6 - bed)], 2e-4);
    assert_eq!((report.pieces("h"), report.pieces("background")), (1, 1));
}

/// What lies basinward of a clinoform in the domain (m³): its shoreline and its toe are ellipses, of which the second has
/// semi-extents 400 m larger, and its dip profile is a parabola.
fn basinward(apex: f64) -> f64 {
    let strips = 1000;
    let strip = |k: i32| {
        let q = f64::from(k) + 0.5 - f64::from(strips) / 2.0;
        let ellipse = |more: f64| (3000.0 + more) * (1.0 - (q / (6000.0 + more)).powi(2)).sqrt();
        let (shoreline, toe) = (apex - 3000.0 + ellipse(0.0), apex - 3000.0 + ellipse(400.0));
        // From the shoreline to the eastern wall, and how much of the sheet's own length that is.
        let (way, length) = ((1000.0 - shoreline).max(0.0), toe - shoreline);
        let fallen = (way / length).clamp(0.0, 1.0);
        40.0 * (way - length / 3.0 * (1.0 - (1.0 - fallen).powi(3)))
    };
    (0..strips).map(strip).sum()
}

/// Five clinoforms whose shorelines have their apexes there, of which the last may be hardly in the domain.
fn assert_clinothems(report: &Report, apexes: [f64; 5]) {
    let beyond: Vec<f64> = apexes.into_iter().map(basinward).chain([0.0]).collect();
    let names = ["s-1", "s-2", "s-3", "s-4", "s-5"];
    let mut right = vec![("background", BLOCK - beyond[0])];
    right.extend(
        names
            .iter()
            .enumerate()
            .map(|(i, name)| (*name, beyond[i] - beyond[i + 1])),
    );
    // A sheet is within a millimetre of its formula.
    report.assert_sizes(&right, 1e-5);
}

#[test]
fn clinoforms_may_prograde_along_an_axis() {
    let report = Report::case("contacts", "clinoforms-along-x");
    assert_clinothems(&report, [100.0, 300.0, 500.0, 700.0, 900.0]);
}

#[test]
fn a_toe_and_a_shoreline_may_touch_a_wall() {
    let text = text("contacts", "clinoforms-along-x");
    let report = Report::of(&text, &["--set", "feature.s.first=200"]);
    assert_clinothems(&report, [200.0, 400.0, 600.0, 800.0, 1000.0]);
}
