//! Rock properties: what is drawn and for which volume, and tensors along layers, in closed form.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "assembled/checked.rs"]
mod checked;

use clinothem::model::Property;
use clinothem::model::properties::VolumeProperties;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::{DMat3, DVec3};

const MODEL: &str = r#"
name = "Rock"
[domain]
x = [0, 2000]
y = [0, 1000]
z = [-60, 0]
facies = "mud"
[facies.mud]
porosity = 0.1
[facies.sand]
net = true
porosity = { normal = [0.25, 0.02], min = 0.2, max = 0.3 }
permeability = { horizontal = { lognormal = [500, 250] }, vertical_fraction = 0.1 }
[facies.gravel]
net = 0.8
vsh = { uniform = [0.02, 0.1] }
density = [2.6, 2.5, 2.4]
"#;

/// Fifty straight channels with lags.
const CHANNELS: &str = r#"
[[feature]]
id = "channel"
kind = "channel"
count = 50
facies = "sand"
width = 40
depth = 4
trajectory = { kind = "line", azimuth_deg = 30 }
[[feature]]
id = "lag"
kind = "lag"
parent = "channel"
facies = "gravel"
"#;

fn realise(text: &str, overrides: &[&str]) -> Realisation {
    realise_without(text, overrides, &[])
}

fn realise_without(text: &str, overrides: &[&str], without: &[&str]) -> Realisation {
    let model = checked::from_text(text, overrides);
    let selection = checked::without(without);
    Realisation::new(&model, &selection).unwrap()
}

fn rock<'a>(realisation: &'a Realisation, volume: &str) -> &'a VolumeProperties {
    let at = realisation.volume(volume);
    &realisation.properties[at.unwrap_or_else(|| panic!("no volume {volume}"))]
}

/// K = R diag(k) Rᵀ with the axes as columns of R.
fn tensor(axes: [DVec3; 3], k: [f64; 3]) -> DMat3 {
    let axes = DMat3::from_cols(axes[0], axes[1], axes[2]);
    axes * DMat3::from_diagonal(k.into()) * axes.transpose()
}

fn assert_tensor(rock: &VolumeProperties, axes: [DVec3; 3], k: [f64; 3], tolerance: f64) {
    let Some(Property::Tensor(rows)) = rock.get("permeability") else {
        panic!("no tensor: {rock:?}");
    };
    let found = DMat3::from_cols_array_2d(&rows).transpose();
    let expected = tensor(axes, k);
    let largest = k.into_iter().fold(0.0, f64::max);
    assert!(
        found.abs_diff_eq(expected, tolerance * largest),
        "{found} is not {expected}"
    );
}

/// Dip, strike and normal of layers that fall by an angle towards an azimuth.
fn dipping(dip: f64, azimuth_deg: f64) -> [DVec3; 3] {
    let azimuth = azimuth_deg.to_radians();
    let down = DVec3::new(
        azimuth.sin() * dip.cos(),
        azimuth.cos() * dip.cos(),
        -dip.sin(),
    );
    let up = DVec3::new(
        azimuth.sin() * dip.sin(),
        azimuth.cos() * dip.sin(),
        dip.cos(),
    );
    [down, down.cross(up), up]
}

#[test]
fn every_volume_has_the_properties_of_its_facies_drawn_for_itself() {
    let found = realise(&format!("{MODEL}{CHANNELS}"), &[]);
    assert_eq!(found.properties.len(), 101);
    let background = rock(&found, "background");
    assert_eq!(
        background.values,
        [("porosity".to_owned(), Property::Scalar(0.1))]
    );
    let mut porosities = Vec::new();
    for number in 1..=50 {
        let channel = rock(&found, &format!("channel-{number}"));
        let porosity = channel.scalar("porosity").unwrap();
        assert!((0.2..=0.3).contains(&porosity));
        assert!(!porosities.contains(&porosity), "drawn for each by itself");
        porosities.push(porosity);
        let Some(Property::Vector([x, y, z])) = channel.get("permeability") else {
            panic!("{channel:?}");
        };
        assert!(x == y && (z / x - 0.1).abs() < 1e-15 && x > 0.0);
        assert_eq!(channel.scalar("net"), Some(1.0));
        let names: Vec<&str> = channel
            .drawn
            .iter()
            .map(|(name, _)| name.as_str())
            .collect();
        assert_eq!(
            names,
            ["properties.porosity", "properties.permeability.horizontal"]
        );
        assert_eq!(channel.drawn[0].1, porosity);
        let lag = rock(&found, &format!("channel-{number}/lag"));
        assert_eq!(lag.scalar("net"), Some(0.8));
        assert!((0.02..=0.1).contains(&lag.scalar("vsh").unwrap()));
        assert_eq!(lag.get("density"), Some(Property::Vector([2.6, 2.5, 2.4])));
        assert_eq!(lag.get("porosity"), None);
    }
}

#[test]
fn drawn_permeabilities_have_the_mean_and_the_spread_that_are_asked_for() {
    let text = format!("{MODEL}{CHANNELS}");
    let found = realise(
        &text,
        &["feature.channel.count=2000", "feature.lag.enabled=false"],
    );
    let n = 2000.0;
    let values: Vec<f64> = (1..=2000)
        .map(|number| {
            let channel = rock(&found, &format!("channel-{number}"));
            channel.get("permeability").unwrap().numbers()[0]
        })
        .collect();
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|k| (k - mean).powi(2)).sum::<f64>() / (n - 1.0);
    // Four standard errors of the mean; of the spread, with the kurtosis of a lognormal of 0.5, some 5 %.
    assert!((mean - 500.0).abs() < 4.0 * 250.0 / n.sqrt(), "{mean}");
    assert!(
        (variance.sqrt() / 250.0 - 1.0).abs() < 0.2,
        "{}",
        variance.sqrt()
    );
}

#[test]
fn a_draw_is_the_same_whatever_else_is_in_the_model_and_another_one_with_another_seed() {
    let text = format!("{MODEL}{CHANNELS}");
    let alone = realise(&text, &[]);
    let more = "[[feature]]\nid = \"nodule\"\nkind = \"ellipsoid\"\nfacies = \"sand\"\nsemi_axes = [9, 5, 2]\n";
    let together = realise(
        &text.replace(
            "[[feature]]\nid = \"channel\"",
            &format!("{more}[[feature]]\nid = \"channel\""),
        ),
        &[
            "feature.channel.width={ uniform = [30, 40] }",
            "facies.sand.sw=0.3",
        ],
    );
    let fewer = realise_without(&text, &["feature.channel.count=9"], &["channel-3", "lag"]);
    let seeded = realise(&text, &["seed=2"]);
    let by_age = {
        let model = checked::from_text(&text, &[]);
        Realisation::by_age(&model, &Selection::default(), 1e-6).unwrap()
    };
    for number in [1, 2, 4, 9] {
        let name = format!("channel-{number}");
        let of = |one: &Realisation| rock(one, &name).clone();
        assert_eq!(of(&alone), of(&fewer), "{name}");
        assert_eq!(of(&alone), of(&by_age), "{name}");
        assert_eq!(of(&alone).drawn, of(&together).drawn, "{name}");
        assert_ne!(of(&alone).drawn, of(&seeded).drawn, "{name}");
    }
}

#[test]
fn a_features_own_properties_come_before_those_of_its_facies_and_leave_parts_of_other_facies_alone()
{
    let own = "properties = { porosity = 0.33, sw = { uniform = [0.2, 0.4] }, age = 65 }";
    let text = format!("{MODEL}{CHANNELS}").replace("count = 50", &format!("count = 2\n{own}"));
    let found = realise(&text, &[]);
    let channel = rock(&found, "channel-2");
    assert_eq!(channel.scalar("porosity"), Some(0.33));
    assert_eq!(channel.scalar("age"), Some(65.0));
    assert!((0.2..=0.4).contains(&channel.scalar("sw").unwrap()));
    assert!(
        channel.get("permeability").is_some(),
        "what it does not say is that of the facies"
    );
    let lag = rock(&found, "channel-2/lag");
    assert_eq!(lag.get("sw"), None);
    // Belts are rock of their own facies.
    let belts = format!("{MODEL}{SET}").replace(
        "kind = \"clinoforms\"",
        &format!("kind = \"clinoforms\"\n{own}"),
    );
    let found = realise(&belts, &[]);
    assert_eq!(rock(&found, "set-2/near").get("age"), None);
    assert_eq!(rock(&found, "set-2/near").scalar("net"), Some(1.0));
    assert_eq!(rock(&found, "set-2/far").scalar("porosity"), Some(0.1));
}

/// Clinoforms of one length in a unit of one thickness, along straight shorelines but for a curvature of a hundred kilometres.
const SET: &str = r#"
[[feature]]
id = "set"
kind = "clinoforms"
facies = "mud"
azimuth_deg = 90
length = 600
spacing = 250
first = 300
sheets = 3
shoreline = [100000, 100000]
belts = [
  { name = "near", facies = "sand", width = 200 },
  { name = "far", facies = "mud" },
]
"#;

const LAYERS: &str = "facies.sand.permeability={ dip = 500, strike = 200, normal = 10 }";

#[test]
fn a_clinothem_and_its_belts_lie_as_the_chord_of_their_clinoform() {
    // From top to base the sheet falls by 60 m over 600 m, whatever its profile: that is the mean of its slope.
    let slope = (60.0_f64 / 600.0).atan();
    for exponent in ["1", "2"] {
        let exponent = format!("feature.set.exponent={exponent}");
        let mud = "facies.mud.permeability={ dip = 500, strike = 200, normal = 10 }";
        let found = realise(&format!("{MODEL}{SET}"), &[LAYERS, mud, &exponent]);
        for name in ["set-1/near", "set-1/far", "set-2/near", "set-2/far"] {
            assert_tensor(
                rock(&found, name),
                dipping(slope, 90.0),
                [500.0, 200.0, 10.0],
                2e-3,
            );
        }
        // What lies below the first sheet lies as the base of its unit: level, and level layers dip to the north.
        assert_tensor(
            rock(&found, "set-0/near"),
            dipping(0.0, 0.0),
            [500.0, 200.0, 10.0],
            1e-12,
        );
    }
}

#[test]
fn a_channel_and_its_lag_lie_along_their_mean_direction() {
    let text = format!("{MODEL}{CHANNELS}");
    let lag = "facies.gravel.permeability={ dip = 900, strike = 90, normal = 9 }";
    let line = realise(&text, &[LAYERS, lag, "feature.channel.count=2"]);
    assert_tensor(
        rock(&line, "channel-2"),
        dipping(0.0, 30.0),
        [500.0, 200.0, 10.0],
        1e-12,
    );
    assert_tensor(
        rock(&line, "channel-1/lag"),
        dipping(0.0, 30.0),
        [900.0, 90.0, 9.0],
        1e-12,
    );
    // A meander whose domain has whole wavelengths of it leads along its belt.
    let way = "feature.channel.trajectory={ kind = \"sine-generated\", amplitude = 100, wavelength = 500, azimuth_deg = 90, center = [1000, 500], phase = 0.25 }";
    let found = realise(&text, &[LAYERS, way, "feature.channel.count=1"]);
    assert_tensor(
        rock(&found, "channel"),
        dipping(0.0, 90.0),
        [500.0, 200.0, 10.0],
        1e-3,
    );
}

#[test]
fn a_unit_lies_as_its_horizon_and_a_nodule_as_its_axes() {
    let features = r#"
[[feature]]
id = "unit"
kind = "horizon"
facies = "sand"
surface = { dipping = { through = [1000, 500, -30], dip_deg = 1.5, azimuth_deg = 210 } }
[[feature]]
id = "nodule"
kind = "ellipsoid"
facies = "sand"
semi_axes = [9, 5, 2]
center = [900, 500, -30]
azimuth_deg = 40
plunge_deg = 20
"#;
    let found = realise(&format!("{MODEL}{features}"), &[LAYERS]);
    let dip = 1.5_f64.to_radians();
    assert_tensor(
        rock(&found, "unit"),
        dipping(dip, 210.0),
        [500.0, 200.0, 10.0],
        1e-12,
    );
    // Plunging along its first axis, it is what a layer is that dips so.
    let plunge = 20.0_f64.to_radians();
    assert_tensor(
        rock(&found, "nodule"),
        dipping(plunge, 40.0),
        [500.0, 200.0, 10.0],
        1e-12,
    );
}

/// A lobe, a scour and a bent scour, a nodule and a channel on a plane, each conforming to it or not.
const BODIES: &str = r#"
[[feature]]
id = "floor"
kind = "horizon"
facies = "mud"
surface = { dipping = { through = [1000, 500, -30], dip_deg = 3, azimuth_deg = 60 } }
[[feature]]
id = "lobe"
kind = "lobe"
parent = "floor"
facies = "sand"
length = 300
width = 200
thickness = 4
azimuth_deg = 110
center = [500, 500]
[[feature]]
id = "scour"
kind = "scour"
facies = "sand"
width = [20, 40]
depth = 2
length = 200
azimuth_deg = 20
center = [1000, 300]
top = -20
[[feature]]
id = "bent"
kind = "scour"
facies = "sand"
width = 15
depth = 1
top = -20
trajectory = { kind = "points", points = [[1200, 600], [1300, 640], [1500, 600]] }
[[feature]]
id = "nodule"
kind = "ellipsoid"
facies = "sand"
semi_axes = [30, 20, 3]
azimuth_deg = 40
center = [1500, 300, -20]
[[feature]]
id = "channel"
kind = "channel"
facies = "sand"
width = 30
depth = 3
top = -20
trajectory = { kind = "line", from = [300, 100], to = [1700, 200] }
"#;

/// Directions in the plane of `BODIES`' floor above one in plan, across it in the plane, and the plane's normal.
fn on_the_floor(azimuth_deg: f64) -> [DVec3; 3] {
    let [_, _, normal] = dipping(3.0_f64.to_radians(), 60.0);
    let azimuth = azimuth_deg.to_radians();
    let plan = DVec3::new(azimuth.sin(), azimuth.cos(), 0.0);
    let dip = (plan - DVec3::Z * normal.dot(plan) / normal.z).normalize();
    [dip, dip.cross(normal), normal]
}

const VALUES: [f64; 3] = [500.0, 200.0, 10.0];

#[test]
fn lobes_and_scours_lie_along_their_own_way() {
    let found = realise(&format!("{MODEL}{BODIES}"), &[LAYERS]);
    assert_tensor(
        rock(&found, "floor/lobe"),
        dipping(0.0, 110.0),
        VALUES,
        1e-12,
    );
    assert_tensor(rock(&found, "scour"), dipping(0.0, 20.0), VALUES, 1e-12);
    // From its first to its last point.
    let azimuth_deg = 90.0_f64;
    assert_tensor(
        rock(&found, "bent"),
        dipping(0.0, azimuth_deg),
        VALUES,
        1e-12,
    );
}

#[test]
fn what_conforms_to_a_plane_lies_in_it() {
    let conform = ["lobe", "scour", "bent", "nodule", "channel"]
        .map(|id| format!("feature.{id}.conform={{ to = \"floor\" }}"));
    let conform: Vec<&str> = conform.iter().map(String::as_str).collect();
    let found = realise(
        &format!("{MODEL}{BODIES}"),
        &[&[LAYERS], &conform[..]].concat(),
    );
    let channel = (1400.0_f64).atan2(100.0).to_degrees();
    for (name, azimuth_deg) in [
        ("floor/lobe", 110.0),
        ("scour", 20.0),
        ("bent", 90.0),
        ("nodule", 40.0),
        ("channel", channel),
    ] {
        assert_tensor(rock(&found, name), on_the_floor(azimuth_deg), VALUES, 1e-9);
    }
}

#[test]
fn a_lobe_on_a_slope_and_a_splay_lie_along_their_axes() {
    // The first one of a stack on a plane; one that was laid on it lies less steeply or more.
    let features = r#"
[[feature]]
id = "floor"
kind = "horizon"
facies = "mud"
surface = { dipping = { through = [1000, 500, -30], dip_deg = 3, azimuth_deg = 60 } }
[[feature]]
id = "stack"
kind = "lobes"
parent = "floor"
facies = "sand"
count = 2
length = 300
width = 200
thickness = 4
azimuth_deg = 110
region = { x = [400, 500], y = [400, 500] }
[[feature]]
id = "trunk"
kind = "channel"
facies = "gravel"
width = 30
depth = 3
top = -5
trajectory = { kind = "line", from = [-100, 800], to = [2100, 800] }
[[feature]]
id = "splay"
kind = "splay"
along = "trunk"
facies = "sand"
at = 0.5
side = "right"
angle_deg = 60
"#;
    let found = realise(&format!("{MODEL}{features}"), &[LAYERS]);
    assert_tensor(
        rock(&found, "floor/stack-1"),
        on_the_floor(110.0),
        VALUES,
        1e-9,
    );
    // 60° to the right of east.
    assert_tensor(
        rock(&found, "trunk/splay"),
        dipping(0.0, 150.0),
        VALUES,
        1e-12,
    );
}

#[test]
fn clinoforms_along_a_crest_and_sheets_lie_on_their_mean_plane() {
    let features = r#"
[[feature]]
id = "delta"
kind = "clinoform"
facies = "sand"
height = 40
crest = -10
length = 600
sheets = 2
spacing = 300
trajectory = { kind = "line", from = [500, 1200], to = [500, -200] }
basinward = "left"
[[feature]]
id = "fold"
kind = "sheet"
facies = "sand"
nets = { degree = 1, points = [[[-100, -100, -20], [-100, 1100, -20]], [[2100, -100, -31], [2100, 1100, -31]]] }
"#;
    let found = realise(&format!("{MODEL}{features}"), &[LAYERS]);
    // Straight ends go on with 0.3 of the mean gradient, 1 in 50: up from the crest to the domain's top 500 m landward, down from the toe to
    // its base 500 m basinward. So the sheet falls by 60 m over 1600 m.
    let dip = (60.0_f64 / 1600.0).atan();
    assert_tensor(rock(&found, "delta-1"), dipping(dip, 90.0), VALUES, 2e-3);
    let slope = (11.0_f64 / 2200.0).atan();
    assert_tensor(rock(&found, "fold"), dipping(slope, 90.0), VALUES, 1e-9);
}

#[test]
fn what_rises_from_base_to_top_has_the_value_of_the_middle_in_a_volume_that_is_no_layer() {
    let text = format!("{MODEL}{CHANNELS}");
    let found = realise(
        &text,
        &[
            "facies.sand.porosity={ base = 0.3, top = 0.2 }",
            "facies.sand.permeability={ base = 1000, top = 10 }",
            "facies.sand.vsh={ base = { uniform = [0.1, 0.2] }, top = 0.5 }",
            "feature.channel.count=3",
        ],
    );
    let channel = rock(&found, "channel-3");
    assert!((channel.scalar("porosity").unwrap() - 0.25).abs() < 1e-15);
    // Permeability on a logarithmic scale: the geometric mean.
    let k = channel.get("permeability").unwrap().numbers();
    assert!(k.iter().all(|k| (k - 100.0).abs() < 1e-12), "{k:?}");
    let base = channel.drawn[0].1;
    assert_eq!(channel.drawn[0].0, "properties.vsh.base");
    assert_eq!(channel.scalar("vsh"), Some(base + (0.5 - base) * 0.5));
}
