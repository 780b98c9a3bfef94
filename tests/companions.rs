//! What goes along a channel: levees, splays and tributaries in finished models.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use assembled::{Built, from_text, source, without};
use clinothem::assembly::Engine;
use clinothem::model::Model;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::DVec3;

/// A straight channel with its top 6 m below the block's, and a levee.
const STRAIGHT: &str = r#"
name = "Straight"
[domain]
x = [0, 300]
y = [-150, 150]
z = [-20, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[facies.silt]
[[feature]]
id = "levee"
kind = "levee"
along = "channel"
facies = "silt"
thinning = 0
[[feature]]
id = "channel"
kind = "channel"
facies = "sand"
width = 50
depth = 4.4
top = -6
trajectory = { kind = "line", from = [-50, 0], to = [350, 0] }
"#;

fn built(text: &str, overrides: &[&str], selection: &Selection) -> Built {
    Built::new(from_text(text, overrides), selection, Engine::Partition).unwrap()
}

fn all(text: &str, overrides: &[&str]) -> Built {
    built(text, overrides, &Selection::default())
}

#[test]
fn a_levee_outside_of_its_crest_has_the_section_of_the_closed_form() {
    // The block's wall stands 1 m outside of the crest, which is 1 m outside of the rim.
    for (taper, toe) in [(2, 0.3), (1, 0.3), (4, 0.6)] {
        let (width, height, depth) = (50.0, 0.44, 1.32);
        let overrides = [
            "domain.y=[27, 150]".to_owned(),
            format!("feature.levee.taper={taper}"),
            format!("feature.levee.toe={toe}"),
        ];
        let made = all(STRAIGHT, &overrides.each_ref().map(String::as_str));
        // w [h_a ((1 − t)/(P + 1) + t/2) + h_b/2], less the first metre of it.
        let rest = |power: f64, from: f64| (1.0_f64 - from / width).powf(power) / power;
        let part = |from: f64| {
            let top = (1.0 - toe) * rest(f64::from(taper) + 1.0, from) + toe * rest(2.0, from);
            width * (height * top + depth * rest(2.0, from))
        };
        let wanted = 300.0 * part(1.0);
        let found = made.size("channel/levee-left");
        // Toes are sunk by a hundredth of the depth at most.
        assert!(
            (found / wanted - 1.0).abs() < 2e-3,
            "{taper}: {found} {wanted}"
        );
        assert_eq!(made.pieces("channel/levee-left"), 1);
        // Of what lies outside of the block there is no volume.
        assert!(made.realisation.volume("channel/levee-right").is_none());
    }
}

#[test]
fn the_section_of_a_finished_model_is_the_levees() {
    let made = all(STRAIGHT, &[]);
    let levee = made.volume("channel/levee-right");
    // Looking along the channel, the right is the south: thickness in columns.
    let mut area = 0.0;
    let (steps, step) = (500, 0.1);
    for k in 0..steps {
        let y = -26.0 - step * (f64::from(k) + 0.5);
        let holds = |z: f64| made.owners.at(DVec3::new(120.0, y, z)) == Some(levee);
        let mut column = 0;
        for j in 0..4000 {
            column += i32::from(holds(-8.0 + f64::from(j) * 0.001));
        }
        area += step * 0.001 * f64::from(column);
    }
    let wanted = 50.0 * (0.44 * 0.383_333_333 + 0.66);
    assert!((area / wanted - 1.0).abs() < 2e-3, "{area} {wanted}");
    // From the crest down to the base: 0.02 widths inside of the rim at the channel's top.
    let at = |y: f64, z: f64| made.owners.at(DVec3::new(120.0, y, z)) == Some(levee);
    assert!(at(-24.1, -5.999) && !at(-23.9, -5.999));
    assert!(at(-26.0, -5.57) && !at(-26.0, -5.55));
}

/// A meander that is symmetrical about y = 0.
const BEND: &str = "feature.channel.trajectory={ kind = \"sine-generated\", amplitude = 60, wavelength = 300, azimuth_deg = 90, center = [150, 0], phase = 0.25 }";

#[test]
fn bodies_along_several_bends_are_one_volume_and_one_solid() {
    let made = all(STRAIGHT, &[BEND, "feature.levee.width=25"]);
    let names = ["channel/levee-left", "channel/levee-right"];
    for name in names {
        assert_eq!(made.pieces(name), 1, "{name}");
        let bodies = made.realisation.volumes.iter();
        assert!(bodies.filter(|one| one.name == name).count() >= 2);
    }
    // Half a turn about the middle makes one of the other, but that every second body is smaller by 3 % in width and in height.
    let [left, right] = names.map(|name| made.size(name));
    assert!((left / right - 1.0).abs() < 0.06, "{left} {right}");
    let report = made
        .realisation
        .volumes
        .iter()
        .filter(|one| one.piece_of.is_none());
    assert_eq!(report.count(), 4);
}

#[test]
fn the_channel_cuts_its_levee_and_a_younger_channel_cuts_both() {
    let crossing = format!(
        "{STRAIGHT}
[[feature]]
id = \"young\"
kind = \"channel\"
facies = \"sand\"
width = 30
depth = 4
top = -5
trajectory = {{ kind = \"line\", from = [150, -200], to = [160, 200] }}
"
    );
    let made = all(&crossing, &[]);
    assert!(made.contact("channel", "channel/levee-left") > 100.0);
    assert_eq!(made.pieces("channel/levee-left"), 2);
    assert!(made.contact("young", "channel/levee-left") > 10.0);
    let without = all(&crossing, &["feature.levee.enabled=false"]);
    let [one, other] = [&made, &without].map(|made| made.size("young"));
    assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
}

#[test]
fn each_instance_has_its_own_levees_and_takes_them_with_it() {
    let text = STRAIGHT.replace("id = \"channel\"", "id = \"channel\"\ncount = 3");
    let text = text.replace(
        "from = [-50, 0], to = [350, 0]",
        "from = [-50, { uniform = [-100, 100] }], to = [350, { uniform = [-100, 100] }]",
    );
    let text = text.replace("top = -6", "top = { uniform = [-8, -2] }");
    let whole = all(&text, &[]);
    let names = |made: &Built| -> Vec<String> {
        let volumes = made.realisation.volumes.iter();
        volumes.map(|volume| volume.name.clone()).collect()
    };
    let expected = |numbers: &[u32]| -> Vec<String> {
        let of = |number: &u32| {
            ["/levee-left", "/levee-right", ""].map(|end| format!("channel-{number}{end}"))
        };
        std::iter::once("background".to_owned())
            .chain(numbers.iter().flat_map(of))
            .collect()
    };
    assert_eq!(names(&whole), expected(&[1, 2, 3]));
    let some = built(&text, &[], &without(&["channel-2"]));
    assert_eq!(names(&some), expected(&[1, 3]));
    // What is left is as it was: the youngest is cut by nothing.
    let [one, other] = [&some, &whole].map(|made| made.size("channel-3"));
    assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    let one = built(&text, &[], &without(&["channel-2/levee-left"]));
    assert_eq!(names(&one).len(), 9);
    assert!(one.realisation.volume("channel-2/levee-left").is_none());
    assert_eq!(names(&built(&text, &[], &without(&["levee"]))).len(), 4);
    // Where it is found: under its channel.
    let third = whole.volume("channel-3");
    assert_eq!(whole.realisation.volumes[third - 1].along, Some(third));
}

/// A splay through the left bank, and a tributary from the right.
const COMPANIONS: &str = include_str!("bad_models/levee.toml");

#[test]
fn a_splay_breaches_the_levee_of_its_channel() {
    let made = all(
        COMPANIONS,
        &[
            "feature.splay.count=1",
            "feature.tributary.enabled=false",
            "feature.nodule.enabled=false",
        ],
    );
    assert!(made.contact("trunk/levee-left", "trunk/splay") > 5.0);
    assert!(made.contact("trunk", "trunk/splay") > 1.0);
    assert_eq!(made.contact("trunk/levee-right", "trunk/splay"), 0.0);
    // It flows away from the left bank, downstream: towards the north-east.
    let splay = made.volume("trunk/splay");
    let (low, high) = made.realisation.instances[splay - 1].body.bounds();
    assert!(
        high.y > 165.0 + 60.0 && low.y > 140.0 && high.x > 230.0,
        "{low} {high}"
    );
}

#[test]
fn splays_that_are_drawn_begin_at_outer_banks_inside_of_the_domain() {
    let text = COMPANIONS
        .replace("at = 0.5\n", "")
        .replace("side = \"left\"\nangle", "angle")
        .replace("kind = \"line\", from = [-50, 150], to = [450, 150]", "kind = \"sine-generated\", amplitude = 50, wavelength = 250, azimuth_deg = 90, center = [200, 150], phase = 0");
    let made = Realisation::new(
        &from_text(
            &text,
            &["feature.splay.count=12", "feature.tributary.enabled=false"],
        ),
        &Selection::default(),
    )
    .unwrap();
    for number in 1..=12 {
        let volume = made.volume(&format!("trunk/splay-{number}")).unwrap();
        let (low, high) = made.instances[volume - 1].body.bounds();
        assert!(high.x > 0.0 && low.x < 400.0);
        // The meander is between 100 and 200: outer banks are far out.
        assert!(high.y > 215.0 || low.y < 85.0, "{low} {high}");
    }
    let straight = COMPANIONS.replace("at = 0.5\nside = \"left\"\n", "");
    let error = Realisation::new(&from_text(&straight, &[]), &Selection::default()).unwrap_err();
    assert!(error.to_string().contains("set `at`"), "{error}");
}

#[test]
fn a_tributary_ends_inside_of_its_trunk() {
    let made = all(
        COMPANIONS,
        &[
            "feature.splay.enabled=false",
            "feature.levee.enabled=false",
            "feature.nodule.enabled=false",
        ],
    );
    assert_eq!(
        (made.pieces("trunk"), made.pieces("trunk/tributary")),
        (1, 1)
    );
    // It comes from the north and does not show on the other side.
    let tributary = made.volume("trunk/tributary");
    let piece = &made.assembly.measured.pieces_of(tributary)[0];
    assert!(piece.bounds.0.y > 150.0, "{:?}", piece.bounds);
    assert!(made.contact("trunk", "trunk/tributary") > 20.0);
    // The trunk is what it is without the tributary.
    let alone = all(
        COMPANIONS,
        &[
            "feature.splay.enabled=false",
            "feature.levee.enabled=false",
            "feature.nodule.enabled=false",
            "feature.tributary.enabled=false",
        ],
    );
    assert!((made.size("trunk") / alone.size("trunk") - 1.0).abs() < 1e-9);
}

#[test]
fn a_tributary_that_would_show_outside_of_its_trunk_is_refused_with_both_names() {
    for change in [
        "feature.tributary.depth=5",
        "feature.tributary.width=60",
        "feature.tributary.top=-4",
    ] {
        let model = from_text(COMPANIONS, &[change]);
        let error = Realisation::new(&model, &Selection::default())
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("trunk/tributary: its end shows outside of trunk, which it joins"),
            "{error}"
        );
    }
    let model = from_text(
        COMPANIONS,
        &["feature.tributary.joins={ at = 0.6, side = \"right\" }"],
    );
    let error = Realisation::new(&model, &Selection::default())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("on the left side of the channel that it is to join from the right"),
        "{error}"
    );
}

#[test]
fn a_tributary_has_levees_and_a_lag_of_its_own() {
    let text = format!(
        "{COMPANIONS}
[[feature]]
id = \"banks\"
kind = \"levee\"
along = \"tributary\"
facies = \"mud\"
[[feature]]
id = \"lag\"
kind = \"lag\"
parent = \"tributary\"
facies = \"sand\"
"
    );
    let made = all(
        &text,
        &[
            "feature.splay.enabled=false",
            "feature.nodule.enabled=false",
        ],
    );
    let names: Vec<&str> = made
        .realisation
        .volumes
        .iter()
        .map(|one| one.name.as_str())
        .collect();
    let tributary = [
        "trunk/tributary/banks-left",
        "trunk/tributary/banks-right",
        "trunk/tributary",
        "trunk/tributary/lag",
    ];
    assert_eq!(names[3..], [&tributary[..], &["trunk"]].concat());
    for name in tributary {
        assert_eq!(made.pieces(name), 1, "{name}");
    }
    // Its levees end at the trunk: nothing of them is on the other side.
    for name in &tributary[..2] {
        let piece = &made.assembly.measured.pieces_of(made.volume(name))[0];
        assert!(piece.bounds.0.y > 150.0, "{name} {:?}", piece.bounds);
    }
}

#[test]
fn committed_models_with_companions_are_good() {
    for name in ["levees/levees", "channel-complex/channel-complex"] {
        Model::check(&source(name)).unwrap();
    }
}
