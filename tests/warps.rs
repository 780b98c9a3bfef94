//! Warping: bodies that conform to horizons and clinoforms.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use std::f64::consts::PI;

use assembled::{Built, from_text, without};
use clinothem::assembly::Engine;
use clinothem::features::body::{Body, Role};
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::DVec3;

/// A horizon, a set of clinoforms on another one, and bodies that conform to them.
const WARPED: &str = r#"
name = "Warped"
[domain]
x = [0, 600]
y = [0, 400]
z = [-60, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[facies.cement]
[[feature]]
id = "plane"
kind = "horizon"
facies = "mud"
surface = { dipping = { through = [300, 200, -40], dip_deg = 3, azimuth_deg = 130 } }
[[feature]]
id = "bent"
kind = "horizon"
facies = "mud"
surface = { grid = { x = [0, 600], y = [0, 400], heights = [[-22, -24, -19, -20], [-20, -23, -21, -22], [-24, -20, -22, -19]] } }
[[feature]]
id = "scour"
kind = "scour"
facies = "sand"
conform = { to = "bent", depth = 4 }
length = 200
width = [20, 60]
depth = 3
azimuth_deg = 70
center = [300, 200]
"#;

fn built(text: &str, overrides: &[&str]) -> Built {
    Built::new(
        from_text(text, overrides),
        &Selection::default(),
        Engine::Partition,
    )
    .unwrap()
}

/// What is said to be reached (m), by feature.
fn deviation(built: &Built, feature: &str) -> f64 {
    let decisions = built.realisation.decisions.iter();
    let own: Vec<f64> = decisions
        .filter_map(|text| {
            let rest = text.strip_prefix(feature)?.strip_prefix(" conforms to ")?;
            let (_, rest) = rest.split_once(" within ")?;
            rest.split(' ').next()?.parse().ok()
        })
        .collect();
    own.into_iter().reduce(f64::max).unwrap()
}

fn body<'a>(built: &'a Built, name: &str) -> &'a Body {
    &built.realisation.instances[built.volume(name) - 1].body
}

const SCOUR: f64 = 0.405_919 * 20.0 * 3.0 * 200.0 * (1.0 - 0.55 / 3.0);

#[test]
fn to_a_plane_a_body_conforms_exactly() {
    let one = built(WARPED, &["feature.scour.conform.to=\"plane\""]);
    assert!(deviation(&one, "scour") < 1e-12);
    // The rims are 4 m below the plane, and a fiftieth of the depth higher.
    let Body::Shell(shell) = body(&one, "scour") else {
        panic!("it is a shell")
    };
    let (dip, azimuth) = (3_f64.to_radians(), 130_f64.to_radians());
    let plane = |p: DVec3| {
        let along = (p.x - 300.0) * azimuth.sin() + (p.y - 200.0) * azimuth.cos();
        -40.0 - dip.tan() * along
    };
    let tops = shell.sheets().iter().filter(|sheet| sheet.0 == Role::Top);
    for p in tops.flat_map(|sheet| sheet.1.net()) {
        assert!((p.z - (plane(*p) - 4.0 + 0.06)).abs() < 1e-11, "{p}");
    }
    assert!((one.size("scour") / SCOUR - 1.0).abs() < 2e-4);
}

#[test]
fn a_warped_body_keeps_its_volume_but_for_its_deviation_over_its_plan() {
    for (tolerance, seed) in [(0.05, 1), (0.002, 2)] {
        let overrides = [
            format!("feature.scour.conform.tolerance={tolerance}"),
            format!("seed={seed}"),
        ];
        let one = built(WARPED, &overrides.each_ref().map(String::as_str));
        let flat = built(
            &WARPED.replace("conform = { to = \"bent\", depth = 4 }\n", "top = -10\n"),
            &[],
        );
        let reached = deviation(&one, "scour");
        assert!(reached <= tolerance);
        let off = (one.size("scour") - flat.size("scour")).abs();
        // Widths from 20 to 60 m over 200 m.
        assert!(off <= 2.0 * reached * 8000.0 + 1e-3, "{off} {reached}");
    }
}

#[test]
fn what_lies_in_a_body_conforms_with_it() {
    let text = WARPED.split("[[feature]]\nid = \"scour\"").next().unwrap();
    let text = format!(
        "{text}{}",
        r#"
[[feature]]
id = "channel"
kind = "channel"
facies = "sand"
conform = { to = "bent", depth = 6 }
width = 60
depth = 5
top = -10
trajectory = { kind = "sine-generated", amplitude = 30, wavelength = 400, azimuth_deg = 90, center = [300, 200], phase = 0.2 }
[[feature]]
id = "lag"
kind = "lag"
parent = "channel"
facies = "mud"
thickness_fraction = 0.2
[[feature]]
id = "nodule"
kind = "ellipsoid"
parent = "channel"
count = 3
facies = "cement"
semi_axes = [5, 4, 0.5]
removed_by = []
"#
    );
    let one = built(&text, &[]);
    let level = built(
        &text.replace("conform = { to = \"bent\", depth = 6 }\n", ""),
        &[],
    );
    for (name, plan) in [("channel", 45_000.0), ("channel/lag", 30_000.0)] {
        let off = (one.size(name) - level.size(name)).abs();
        let most = 2.0 * deviation(&one, "lag").max(deviation(&one, "channel")) * plan;
        assert!(off <= most, "{name}: {off} {most}");
    }
    // The nodules are drawn where they were drawn, in the channel before it was bent, and are bent with it.
    for number in 1..=3 {
        let name = format!("channel/nodule-{number}");
        let [a, b] = [&one, &level].map(|built| body(built, &name).bounds());
        let plan = |p: DVec3| p.truncate();
        let middle = |(low, high): (DVec3, DVec3)| 0.5 * (plan(low) + plan(high));
        assert!((middle(a) - middle(b)).length() < 1.0, "{name}");
        let off = (one.size(&name) - level.size(&name)).abs();
        // Where the channel ends them it may be off, too.
        let most = 2.0 * (deviation(&one, "nodule") + deviation(&one, "channel")) * PI * 20.0;
        assert!(off <= most + 1e-6, "{name}: {off} {most}");
    }
}

/// Clinoforms with facies belts, or without.
fn on_clinoforms(belts: &str) -> String {
    // Without belts, what is below the first one is the unit's.
    let oldest = if belts.is_empty() {
        ""
    } else {
        "\"clino-0\", "
    };
    format!(
        r#"
name = "On clinoforms"
[domain]
x = [0, 700]
y = [0, 300]
z = [-18, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[facies.cement]
[[feature]]
id = "ramp"
kind = "horizon"
facies = "mud"
surface = {{ level = -15 }}
[[feature]]
id = "clino"
kind = "clinoforms"
parent = "ramp"
facies = "mud"
azimuth_deg = 90
first = 120
spacing = 100
length = 300
sheets = 4
toe = 0.3
shoreline = [900, 900]
{belts}
[[feature]]
id = "scour"
kind = "scour"
facies = "sand"
conform = {{ to = "clino-3" }}
removes = ["ramp", {oldest}"clino-1", "clino-2"]
length = 180
width = [16, 48]
depth = 2
azimuth_deg = 95
head = [380, 160]
[[feature]]
id = "concretion"
kind = "ellipsoid"
parent = "ramp"
facies = "cement"
removed_by = []
conform = {{ to = "clino-2", depth = 3 }}
semi_axes = [14, 8, 0.8]
center = [320, 60, 0]
"#
    )
}

#[test]
fn a_scour_runs_down_a_clinoform_and_a_concretion_lies_below_one() {
    let belts = r#"belts = [{ name = "proximal", facies = "mud", width = 180 }, { name = "distal", facies = "sand" }]"#;
    for belts in ["", belts] {
        let one = built(&on_clinoforms(belts), &[]);
        let (scour, area) = (
            one.size("scour"),
            0.405_919 * 16.0 * 2.0 * 180.0 * (1.0 - 0.55 / 3.0),
        );
        // Above the clinoform is what is a fiftieth of the depth or less below the rims.
        assert!(scour < area && scour > 0.87 * area, "{scour} {area}");
        // Nothing of it is in the clinothem above, which lies on it.
        let above = if belts.is_empty() {
            "ramp/clino-3".to_owned()
        } else {
            "ramp/clino-3/proximal".to_owned()
        };
        assert!(one.contact("scour", &above) > 0.5 * 180.0 * 32.0);
        let volume = 4.0 / 3.0 * PI * 14.0 * 8.0 * 0.8;
        let off = (one.size("ramp/concretion") - volume).abs();
        let plan = PI * 14.0 * 8.0;
        assert!(off <= 2.0 * deviation(&one, "concretion") * plan + 1e-6 * volume);
        // Its middle is 3 m below the sheet: about a third of the way down it.
        let (low, high) = body(&one, "ramp/concretion").bounds();
        let z = 0.5 * (low.z + high.z);
        assert!(z < -3.0 && z > -15.0, "{z}");
    }
}

#[test]
fn bodies_stay_where_they_are_when_what_they_conform_to_is_left_out() {
    let model = from_text(&on_clinoforms(""), &["feature.scour.removes=\"older\""]);
    let whole = Built::new(model.clone(), &Selection::default(), Engine::Partition).unwrap();
    let bare = Built::new(model, &without(&["clino"]), Engine::Partition).unwrap();
    for name in ["scour", "ramp/concretion"] {
        assert_eq!(body(&whole, name), body(&bare, name), "{name}");
    }
}

#[test]
fn what_is_drawn_lies_in_its_parent_and_the_domain_once_it_conforms() {
    let text = on_clinoforms("").replace("center = [320, 60, 0]", "count = 20");
    let made = Realisation::new(&from_text(&text, &[]), &Selection::default()).unwrap();
    let own = made
        .instances
        .iter()
        .filter(|one| made.volumes[one.volume].feature == "concretion");
    let middles: Vec<f64> = own
        .map(|one| {
            let (low, high) = one.body.bounds();
            0.5 * (low.z + high.z)
        })
        .collect();
    assert_eq!(middles.len(), 20);
    // Landward of its shoreline, and basinward of its toe, a clinoform goes on, out of the domain or out of the unit.
    assert!(
        made.rejections
            .iter()
            .any(|one| one.feature == "concretion")
    );
    for z in middles {
        assert!(z > -15.5 && z < 0.5, "{z}");
    }
}

#[test]
fn the_general_fuse_makes_the_same_warped_bodies() {
    let text = format!(
        "{WARPED}{}",
        r#"
[[feature]]
id = "nodule"
kind = "ellipsoid"
facies = "cement"
conform = { to = "bent", depth = 12 }
semi_axes = [40, 25, 2]
center = [200, 150, 0]
[[feature]]
id = "lobe"
kind = "lobe"
facies = "sand"
conform = { to = "bent", depth = -3 }
length = 200
width = 130
thickness = 4
azimuth_deg = 200
center = [380, 250]
"#
    );
    let one = built(&text, &[]);
    let other = Built::new(from_text(&text, &[]), &Selection::default(), Engine::Occt).unwrap();
    for name in ["scour", "nodule", "lobe"] {
        let [a, b] = [&one, &other].map(|built| built.size(name));
        assert!((a - b).abs() < 1e-6 * a, "{name}: {a} {b}");
    }
}
