//! Channel lags: how much of their channels they hold, and what they do in contact with others.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[macro_use]
mod assembled;

use assembled::{Built, built, from_text, without};
use clinothem::assembly::Engine;
use glam::DVec3;

/// A straight channel through a block, with a lag.
const STRAIGHT: &str = straight!(
    r#"[[feature]]
id = "lag"
kind = "lag"
parent = "channel"
facies = "gravel"
"#
);

/// Area of the default section as a fraction of width times depth.
const SECTION: f64 = 0.764_563;

#[test]
fn shares_of_a_channels_section_are_those_of_numerical_integration() {
    // To five digits, from sums over the section's control points by another program.
    for (f, g, share) in [
        (0.1, 0.0, 0.047_09),
        (0.1, 0.5, 0.057_88),
        (0.1, 0.8, 0.072_44),
        (0.2, 0.0, 0.119_58),
        (0.2, 0.5, 0.141_68),
        (0.2, 0.8, 0.166_71),
    ] {
        let overrides = [
            format!("feature.lag.thickness_fraction={f}"),
            format!("feature.lag.sag_fraction={g}"),
        ];
        let overrides = overrides.each_ref().map(String::as_str);
        let built = built(STRAIGHT, &overrides, Engine::Partition);
        let (lag, rest) = (built.size("channel/lag"), built.size("channel"));
        let whole = SECTION * 50.0 * 4.4 * 300.0;
        assert!((lag + rest - whole).abs() < 1e-6 * whole, "{}", lag + rest);
        assert!(
            (lag / whole - share).abs() < 6e-6,
            "{f} {g}: {}",
            lag / whole
        );
        assert_eq!((built.pieces("channel/lag"), built.solids()), (1, 3));
    }
}

#[test]
fn the_general_fuse_makes_the_same_lag() {
    let [one, other] = [Engine::Partition, Engine::Occt].map(|engine| {
        let built = built(STRAIGHT, &[], engine);
        (
            built.size("channel/lag"),
            built.contact("channel", "channel/lag"),
        )
    });
    assert!((one.0 - other.0).abs() < 1e-6 * one.0, "{one:?} {other:?}");
    assert!((one.1 - other.1).abs() < 1e-6 * one.1, "{one:?} {other:?}");
}

#[test]
fn a_lag_reaches_a_fraction_of_the_depth_above_the_thalweg_along_every_bend() {
    let bends = "feature.channel.trajectory={ kind = \"sine-generated\", amplitude = 25, wavelength = 300, azimuth_deg = 90, center = [150, 50], phase = 0 }";
    let varied = "feature.lag.thickness_fraction=[[0, 0.1], [1, 0.5]]";
    let overrides = [
        bends,
        varied,
        "domain.y=[-50, 150]",
        "feature.channel.asymmetry=0.2",
    ];
    let built = built(STRAIGHT, &overrides, Engine::Partition);
    let [lag, channel] = ["channel/lag", "channel"].map(|name| built.volume(name));
    let clinothem::features::body::Body::Trough(trough) =
        &built.realisation.instances[channel - 1].body
    else {
        panic!("a channel is a trough")
    };
    let (base, (u0, u1)) = (trough.base(), trough.base().knots_u().domain());
    let mut seen = 0;
    for k in 1..200 {
        let v = f64::from(k) / 200.0;
        let thalweg = base.point(f64::midpoint(u0, u1), v);
        let top = 4.4 * (0.1 + 0.4 * v);
        // The thalweg and the lag's top are within the tolerance of their sections, a hundredth of the width in plan.
        for (height, expected) in [(top - 0.05, lag), (top + 0.05, channel)] {
            if let Some(owner) = built.owners.at(thalweg + DVec3::Z * height) {
                assert_eq!(owner, expected, "{v} {height}");
                seen += 1;
            }
        }
    }
    assert!(seen > 150, "{seen}");
}

#[test]
fn a_lag_takes_nothing_but_its_channel_and_a_younger_channel_cuts_both() {
    let crossing = r#"
[[feature]]
id = "younger"
kind = "channel"
facies = "sand"
width = 40
depth = 5
top = -6.5
trajectory = { kind = "line", from = [150, -50], to = [160, 150] }
"#;
    let text = format!("{STRAIGHT}{crossing}");
    let whole = built(&text, &[], Engine::Partition);
    assert_eq!(whole.pieces("channel/lag"), 2);
    // Without the lag nothing else changes but the channel, which has it all.
    let model = from_text(&text, &[]);
    let bare = Built::new(model, &without(&["lag"]), Engine::Partition).unwrap();
    for name in ["background", "younger"] {
        let (one, other) = (whole.size(name), bare.size(name));
        assert!((one - other).abs() < 1e-6 * other, "{name}: {one} {other}");
    }
    let both = whole.size("channel") + whole.size("channel/lag");
    assert!((both - bare.size("channel")).abs() < 1e-6 * both);
    // Its hidden sheet and its ends lie outside of the channel: it touches the channel, the mud and what cuts it.
    for (name, touches) in [("channel", true), ("background", true), ("younger", true)] {
        assert_eq!(whole.contact("channel/lag", name) > 0.0, touches, "{name}");
    }
}

#[test]
fn every_channel_has_a_lag_with_draws_of_its_own() {
    let overrides = [
        "feature.channel.count=3",
        "feature.channel.top={ uniform = [-12, -4] }",
        "feature.lag.thickness_fraction={ uniform = [0.1, 0.5] }",
    ];
    let model = from_text(STRAIGHT, &overrides);
    let drawn = |without: &[&str]| -> Vec<(String, f64)> {
        let selection = assembled::without(without);
        let made = clinothem::model::realisation::Realisation::new(&model, &selection).unwrap();
        let lags = made.instances.iter().filter(|one| one.feature == 1);
        lags.map(|one| (made.volumes[one.volume].name.clone(), one.drawn[0].1))
            .collect()
    };
    let all = drawn(&[]);
    assert_eq!(all.len(), 3);
    assert_eq!(all[2].0, "channel-3/lag");
    assert!(all[0].1 != all[1].1 && all[1].1 != all[2].1);
    // Leaving one out changes no other.
    assert_eq!(drawn(&["channel-2"]), [all[0].clone(), all[2].clone()]);
    assert_eq!(drawn(&["channel-1/lag"]), all[1..]);
}
