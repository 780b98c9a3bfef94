//! Clinoforms along a crest, and sheets and bodies from control nets: volumes against closed forms, both engines, draws.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use std::f64::consts::PI;

use assembled::{Built, built, from_text};
use clinothem::assembly::Engine;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;

/// Four clinoforms of 20 m in a unit as high, along a crest that swings; basinward is east.
const DELTA: &str = r#"
name = "Delta"
[domain]
x = [0, 1000]
y = [0, 400]
z = [-20, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "delta"
kind = "clinoform"
facies = "sand"
length = 250
dip_deg = 8
sheets = 4
spacing = 110
azimuth_deg = 90
trajectory = { kind = "points", points = [[150, -50], [190, 100], [240, 250], [200, 450]] }
"#;

/// A net over a block whose control points lie evenly, and another level.
const SHEET: &str = r#"
name = "Sheet"
[domain]
x = [0, 300]
y = [0, 200]
z = [-50, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "sheet"
kind = "sheet"
facies = "sand"
[feature.nets]
degree = [2, 1]
points = [
  [[0, 0, -20], [0, 200, -30]],
  [[150, 0, -10], [150, 200, -36]],
  [[300, 0, -25], [300, 200, -20]],
]
"#;

#[test]
fn between_clinoforms_lies_spacing_times_height_for_each_metre_of_strike() {
    let straight =
        "feature.delta.trajectory={ kind = \"line\", from = [150, -10], to = [150, 410] }";
    for overrides in [&[][..], &[straight]] {
        let built = built(DELTA, overrides, Engine::Partition);
        let expected = 110.0 * 20.0 * 400.0;
        for number in 1..=3 {
            let volume = built.size(&format!("delta-{number}"));
            assert!((volume - expected).abs() < 1e-6 * expected, "{volume}");
        }
        assert_eq!(built.solids(), 5);
    }
    // Landward of the first one: as the section is symmetrical, half of what is above the slope.
    let built = built(DELTA, &[straight], Engine::Partition);
    let landward = built.size("background");
    let expected = (150.0 + 125.0) * 20.0 * 400.0;
    assert!((landward - expected).abs() < 1e-9 * expected, "{landward}");
}

#[test]
fn clinoforms_with_level_ends_touch_the_top_and_the_base_of_their_unit() {
    // The same volumes as of others, along a bent crest and a straight one; all of a sheet lies between its crest and its toe.
    let straight =
        "feature.delta.trajectory={ kind = \"line\", from = [150, -10], to = [150, 410] }";
    for more in [&[][..], &[straight]] {
        let overrides = [&["feature.delta.toe=0"], more].concat();
        let built = built(DELTA, &overrides, Engine::Partition);
        assert_eq!(built.assembly.remedy, "none");
        let expected = 110.0 * 20.0 * 400.0;
        for number in 1..=3 {
            let volume = built.size(&format!("delta-{number}"));
            assert!((volume - expected).abs() < 1e-6 * expected, "{volume}");
        }
        assert_eq!(built.solids(), 5);
    }
    let overrides = ["feature.delta.toe=0", straight];
    let built = built(DELTA, &overrides, Engine::Partition);
    let landward = built.size("background");
    let expected = (150.0 + 125.0) * 20.0 * 400.0;
    assert!((landward - expected).abs() < 1e-9 * expected, "{landward}");
    // (0, H), (ℓ, H), (L − ℓ, 0), (L, 0) with ℓ = L − H/tan δ; steepest halfway down.
    let (length, height) = (250.0, 20.0);
    let run = length - height / 8.0_f64.to_radians().tan();
    let bezier = |u: f64, p: [f64; 4]| {
        let v = 1.0 - u;
        v * v * v * p[0] + 3.0 * v * v * u * p[1] + 3.0 * v * u * u * p[2] + u * u * u * p[3]
    };
    let first = built.volume("delta-1");
    for u in [0.1, 0.25, 0.5, 0.75, 0.9] {
        let x = 150.0 + bezier(u, [0.0, run, length - run, length]);
        let z = bezier(u, [0.0, 0.0, -height, -height]);
        for (off, is_in) in [(0.01, true), (-0.01, false)] {
            let at = glam::DVec3::new(x, 200.0, z + off);
            let owner = built.owners.at(at);
            assert_eq!(owner == Some(first), is_in, "{u} {off}");
        }
    }
}

#[test]
fn level_ends_are_refused_where_a_unit_has_no_level_bounds() {
    for (more, words) in [
        (
            "feature.delta.height=12",
            "the crest is at -8 m, the toe at -20 m",
        ),
        (
            "feature.delta.climb_deg=0.5",
            "the unit reaches from -20 m to 0 m",
        ),
        (
            "domain.base={ dipping = { through = [500, 200, -18], dip_deg = 0.1, azimuth_deg = 90 } }",
            "its base or its top is not level",
        ),
    ] {
        let model = from_text(DELTA, &["feature.delta.toe=0", more]);
        let error = Realisation::new(&model, &Selection::default()).unwrap_err();
        let said = error.to_string();
        assert!(
            said.contains(words) && said.contains("such as 0.3"),
            "{said}"
        );
    }
}

#[test]
fn the_general_fuse_makes_the_same_clinoforms_and_sheets() {
    let two = DELTA.replace("sheets = 4", "sheets = 2");
    for (text, names) in [(&*two, &["delta-1", "delta-2"][..]), (SHEET, &["sheet"])] {
        let [one, other] = [Engine::Partition, Engine::Occt].map(|engine| built(text, &[], engine));
        assert_eq!(one.solids(), other.solids());
        for name in names {
            let (a, b) = (one.size(name), other.size(name));
            assert!((a - b).abs() < 1e-6 * a, "{name}: {a} {b}");
        }
    }
}

#[test]
fn clinoforms_divide_a_unit_between_bent_horizons() {
    let horizons = r#"
[[feature]]
id = "shelf"
kind = "horizon"
facies = "mud"
surface = { grid = { x = [0, 1000], y = [0, 400], heights = [[-16, -17, -18], [-17, -15, -18.5]] } }
[[feature]]
id = "flood"
kind = "horizon"
facies = "mud"
surface = { dipping = { through = [0, 0, -3], dip_deg = 0.1, azimuth_deg = 90 } }
"#;
    let text = DELTA.replace(
        "kind = \"clinoform\"",
        "kind = \"clinoform\"\nparent = \"shelf\"",
    );
    let (head, delta) = text.split_at(text.find("[[feature]]").unwrap());
    let text = format!("{head}{horizons}{delta}");
    let built = built(&text, &[], Engine::Partition);
    let all: f64 = (1..=4)
        .map(|number| built.size(&format!("shelf/delta-{number}")))
        .sum();
    assert!(all > 0.0 && built.size("shelf") > 0.0);
    // What they have and what the shelf keeps is what the shelf has without them.
    let alone = Built::new(
        from_text(&text, &["feature.delta.enabled=false"]),
        &Selection::default(),
        Engine::Partition,
    );
    let whole = alone.unwrap().size("shelf");
    assert!((all + built.size("shelf") - whole).abs() < 1e-8 * whole);
}

#[test]
fn a_crest_that_climbs_or_falls_is_proven_too() {
    for (height, crest, climb) in [(10, -8, 1.5), (10, -2, -1.0), (14, -5, 0.4)] {
        let overrides = [
            format!("feature.delta.height={height}"),
            format!("feature.delta.crest={crest}"),
            format!("feature.delta.climb_deg={climb}"),
            "feature.delta.dip_deg=6".to_owned(),
        ];
        let overrides = overrides.each_ref().map(String::as_str);
        let built = built(DELTA, &overrides, Engine::Partition);
        assert!(built.size("delta-1") > 0.0 && built.size("delta-4") > 0.0);
    }
}

/// The mean height of the sheet: of evenly placed control points that of their heights, since all Bernstein polynomials of a degree have
/// one integral.
#[test]
fn above_a_bezier_sheet_lies_what_its_control_points_say() {
    let built_with = |overrides: &[&str]| built(SHEET, overrides, Engine::Partition).size("sheet");
    let mean = (-20.0 - 30.0 - 10.0 - 36.0 - 25.0 - 20.0) / 6.0;
    let plan = 300.0 * 200.0;
    let volume = built_with(&[]);
    assert!((volume + mean * plan).abs() < 1e-9 * volume, "{volume}");
    // One control point by 6 m: a sixth of that all over.
    let raised = built_with(&["feature.sheet.nets.points.2.2.3=-30"]);
    assert!((volume - raised - 1.0 * plan).abs() < 1e-9 * volume);
    // Of degree 1 each way: trapezia.
    let straight = built_with(&["feature.sheet.nets.degree=1"]);
    let ends = [-25.0, -23.0, -22.5];
    let mean = (0.5 * ends[0] + ends[1] + 0.5 * ends[2]) / 2.0;
    assert!((straight + mean * plan).abs() < 1e-9 * volume, "{straight}");
}

#[test]
fn a_horizon_follows_its_control_net_and_has_a_unit_above_it() {
    // The same net, to a millimetre; a bed of 3 m lies on it, and a set of clinoforms in that.
    let text = SHEET
        .replace("kind = \"sheet\"", "kind = \"horizon\"")
        .replace(
            "[feature.nets]",
            "[feature.surface]\ntolerance = 0.001\n[feature.surface.net]",
        );
    let bed = "[[feature]]\nid = \"bed\"\nkind = \"horizon\"\nfacies = \"mud\"\nsurface = { above = \"sheet\", thickness = 3 }\n";
    let found = built(&format!("{text}{bed}"), &[], Engine::Partition);
    let plan = 300.0 * 200.0;
    let control = [-20.0, -30.0, -10.0, -36.0, -25.0, -20.0];
    let mean = control.iter().sum::<f64>() / 6.0;
    assert!((found.size("sheet") - 3.0 * plan).abs() < 1e-6 * plan);
    assert!((found.size("bed") - (-mean - 3.0) * plan).abs() < 0.001 * plan);
    let told = found.realisation.decisions.iter();
    assert!(
        told.clone()
            .any(|one| one == "sheet follows its control net within 0.001 m"),
        "{:?}",
        found.realisation.decisions
    );
}

#[test]
fn weights_and_knots_of_a_horizons_net_count() {
    // An arc of a circle over the chord, from 20 m below the top to 20 m below the top: its middle weight is the cosine of half its angle. A knot
    // inserted across changes nothing.
    let angle = 0.2_f64.atan();
    let radius = 150.0 / angle.sin();
    let net = format!(
        "feature.sheet.surface={{ tolerance = 0.002, net = {{ degree = [2, 1], \
         points = [[[0, 0, -20], [0, 90, -20], [0, 200, -20]], [[150, 0, 10], [150, 90, 10], [150, 200, 10]], [[300, 0, -20], [300, 90, -20], [300, 200, -20]]], \
         weights = [[1, 1, 1], [{0}, {0}, {0}], [1, 1, 1]], knots = [[], [0, 0, 0.3, 1, 1]] }} }}",
        angle.cos()
    );
    let text = SHEET.replace("kind = \"sheet\"", "kind = \"horizon\"");
    let text = &text[..text.find("[feature.nets]").unwrap()];
    let found = built(text, &[&net], Engine::Partition);
    let segment = radius * radius * (angle - angle.sin() * angle.cos());
    let expected = 200.0 * (20.0 * 300.0 - segment);
    let off = found.size("sheet") - expected;
    assert!(off.abs() < 0.002 * 300.0 * 200.0, "{off}");
    // Without the weights it is a parabola, which is higher: its area above the chord is two thirds of height times length.
    let parabola = 200.0 * (20.0 * 300.0 - 2.0 / 3.0 * 15.0 * 300.0);
    assert!((expected - parabola).abs() > 0.05 * 300.0 * 200.0);
}

#[test]
fn a_net_with_kinks_is_no_horizon_and_one_that_ends_neither() {
    let text = SHEET.replace("kind = \"sheet\"", "kind = \"horizon\"");
    let text = &text[..text.find("[feature.nets]").unwrap()];
    for (points, words) in [
        (
            "[[[-10, -10, -20], [-10, 210, -30]], [[150, -10, -10], [150, 210, -36]], [[310, -10, -25], [310, 210, -20]]]",
            ["degree = 1, ", "feature of the kind sheet"],
        ),
        (
            "[[[0, 0, -20], [0, 150, -30]], [[300, 0, -10], [300, 150, -36]]]",
            ["", "ends inside of the domain"],
        ),
    ] {
        let net = format!(
            "feature.sheet.surface={{ net = {{ {}points = {points} }} }}",
            words[0]
        );
        let model = from_text(text, &[&net]);
        let error = Realisation::new(&model, &Selection::default()).unwrap_err();
        let said = error.to_string();
        assert!(said.contains("sheet") && said.contains(words[1]), "{said}");
    }
}

#[test]
fn a_sheet_of_several_nets_is_proven_and_tells_how_they_join() {
    for (smooth, is_smooth) in [("false", false), ("true", true)] {
        let nets = format!(
            r#"feature.sheet.nets=[{{ name = "west", degree = 2, points = [[[-9, -9, -20], [-9, 100, -22], [-9, 209, -25]], [[60, -9, -15], [60, 100, -22], [60, 209, -25]], [[140, -9, -25], [140, 100, -20], [140, 209, -21]]] }}, {{ degree = 3, points = [[[150, -9, -20], [150, 60, -22], [150, 120, -25], [150, 209, -20]], [[200, -9, -20], [200, 60, -12], [200, 120, -25], [200, 209, -28]], [[240, -9, -30], [240, 60, -22], [240, 120, -25], [240, 209, -20]], [[309, -9, -20], [309, 60, -22], [309, 120, -35], [309, 209, -20]]], joins = {{ to = "west", smooth = {smooth} }} }}]"#
        );
        let built = built(SHEET, &[&nets], Engine::Partition);
        assert_eq!(built.solids(), 2);
        let told = &built.realisation.decisions;
        let line = told
            .iter()
            .find(|line| line.contains("joined to west"))
            .unwrap();
        assert_eq!(line.contains("up to 0.0000°"), is_smooth, "{line}");
    }
}

/// A ball of one closed net, and a lens between two nets with one rim.
#[test]
fn bodies_from_nets_have_the_volumes_of_their_closed_forms() {
    let w = 0.5_f64.sqrt();
    let half = [
        (0.0, -1.0, 1.0),
        (1.0, -1.0, w),
        (1.0, 0.0, 1.0),
        (1.0, 1.0, w),
        (0.0, 1.0, 1.0),
    ];
    let around = [
        (1, 0),
        (1, 1),
        (0, 1),
        (-1, 1),
        (-1, 0),
        (-1, -1),
        (0, -1),
        (1, -1),
        (1, 0),
    ];
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for (k, (x, y)) in around.into_iter().enumerate() {
        let own = if k % 2 == 0 { 1.0 } else { w };
        let (x, y) = (f64::from(x), f64::from(y));
        points.push(half.map(|(r, z, _)| [12.0 * x * r, 12.0 * y * r, 12.0 * z]));
        weights.push(half.map(|(_, _, weight)| own * weight));
    }
    let body = format!(
        "feature.sheet={{}}\nkind = \"body\"\nat = [150, 100, -20]\nnets = {{ degree = 2, points = {points:?}, weights = {weights:?}, \
         knots = [[0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], [0, 0, 0, 1, 1, 2, 2, 2]] }}\n"
    );
    let head = &SHEET[..SHEET.find("kind = \"sheet\"").unwrap()];
    let body = body.replace("feature.sheet={}\n", "");
    let ball = format!("{head}facies = \"sand\"\n{body}");
    for engine in [Engine::Partition, Engine::Occt] {
        let volume = built(&ball, &[], engine).size("sheet");
        let expected = 4.0 / 3.0 * PI * 12.0_f64.powi(3);
        assert!((volume - expected).abs() < 1e-6 * expected, "{volume}");
    }
    let lens = format!(
        "{head}facies = \"sand\"\nkind = \"body\"\nat = [150, 100, -25]\nazimuth_deg = 30\nnets = [{{ degree = 2, points = {} }}, {{ degree = 2, points = {} }}]\n",
        rectangle(-18.0),
        rectangle(9.0)
    );
    // The middle one of nine control points has a ninth of all, over 80 m × 50 m.
    let expected = (18.0 + 9.0) / 9.0 * 80.0 * 50.0;
    for engine in [Engine::Partition, Engine::Occt] {
        let volume = built(&lens, &[], engine).size("sheet");
        assert!((volume - expected).abs() < 1e-6 * expected, "{volume}");
    }
}

/// Nine points, of which only the middle one is not level.
fn rectangle(middle: f64) -> String {
    let row = |x: f64, z: f64| [[x, -25.0, 0.0], [x, 0.0, z], [x, 25.0, 0.0]];
    format!("{:?}", [row(-40.0, 0.0), row(0.0, middle), row(40.0, 0.0)])
}
