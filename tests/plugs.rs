//! Abandonment plugs: how much of their channels they hold, and where.
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
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;

/// A straight channel through a block, with a lag and a plug.
const STRAIGHT: &str = straight!(
    r#"[[feature]]
id = "lag"
kind = "lag"
parent = "channel"
facies = "gravel"
[[feature]]
id = "plug"
kind = "plug"
parent = "channel"
facies = "mud"
"#
);

/// A meander with five apices in the block.
const MEANDER: &str = "feature.channel.trajectory={ kind = \"sine-generated\", amplitude = 60, wavelength = 300, azimuth_deg = 90, center = [150, 50], phase = 0 }";

/// Area of the default section as a fraction of width times depth.
const SECTION: f64 = 0.764_563;

#[test]
fn a_plugs_section_is_its_fractions_of_the_channels() {
    for (depth, width) in [(0.5, 0.7), (0.3, 0.9), (0.9, 0.4)] {
        let overrides = [
            format!("feature.plug.depth_fraction={depth}"),
            format!("feature.plug.width_fraction={width}"),
        ];
        let overrides = overrides.each_ref().map(String::as_str);
        let built = built(STRAIGHT, &overrides, Engine::Partition);
        let sizes = ["channel", "channel/lag", "channel/plug"].map(|name| built.size(name));
        let whole = SECTION * 50.0 * 4.4 * 300.0;
        assert!((sizes.iter().sum::<f64>() / whole - 1.0).abs() < 1e-6);
        assert!(
            (sizes[2] / whole - depth * width).abs() < 1e-6,
            "{depth} {width}: {}",
            sizes[2] / whole
        );
    }
}

#[test]
fn the_general_fuse_makes_the_same_plug_in_a_long_channel() {
    // Its section with the domain's wall is one long spline: planes within such edges were integrated to 1e-5 only.
    let overrides = [
        "domain.x=[0, 900]",
        "domain.y=[0, 300]",
        "domain.z=[-30, 0]",
        "feature.channel.width=80",
        "feature.channel.depth=8",
        "feature.channel.top=-10",
        "feature.channel.trajectory={ kind = \"line\", from = [-100, 220], to = [1000, 140] }",
    ];
    let [one, other] =
        [Engine::Partition, Engine::Occt].map(|engine| built(STRAIGHT, &overrides, engine));
    for name in ["channel", "channel/lag", "channel/plug"] {
        let (own, its) = (one.size(name), other.size(name));
        assert!((own / its - 1.0).abs() < 1e-6, "{name}: {own} {its}");
    }
}

#[test]
fn a_plug_that_ends_within_its_channel_has_that_part_of_it() {
    let overrides = ["feature.plug.from=0.25", "feature.plug.to=0.5"];
    let built = built(STRAIGHT, &overrides, Engine::Partition);
    // The channel begins at x = −50 and is 400 m long.
    let whole = SECTION * 50.0 * 4.4 * 0.25 * 400.0;
    let plug = built.size("channel/plug");
    assert!((plug / whole - 0.35).abs() < 1e-6, "{}", plug / whole);
    assert_eq!(built.pieces("channel"), 1);
}

#[test]
fn a_bend_that_was_cut_off_is_filled_between_its_inflections() {
    let overrides = [MEANDER, "domain.y=[-50, 150]", "feature.plug.bend=2"];
    let built = built(STRAIGHT, &overrides, Engine::Partition);
    // The channel goes on around it, in one piece.
    let pieces = ["channel", "channel/plug"].map(|name| built.pieces(name));
    assert_eq!(pieces, [1, 1]);
    assert!(built.size("channel/plug") > 0.0);
    // By the mean of sin² over half a wave a bend's plug would have half of a whole one's volume at most.
    let bare = Built::new(
        from_text(STRAIGHT, &overrides),
        &without(&["plug"]),
        Engine::Partition,
    )
    .unwrap();
    {
        let name = "background";
        let (one, other) = (built.size(name), bare.size(name));
        assert!((one - other).abs() < 1e-6 * other, "{name}: {one} {other}");
    }
    let without_plug = bare.size("channel") + bare.size("channel/lag");
    let with_plug = ["channel", "channel/lag", "channel/plug"].map(|name| built.size(name));
    assert!((with_plug.iter().sum::<f64>() / without_plug - 1.0).abs() < 1e-6);
}

#[test]
fn a_bend_that_the_channel_does_not_have_is_refused_with_their_number() {
    let refused = |overrides: &[&str]| {
        let model = from_text(STRAIGHT, overrides);
        let error = Realisation::new(&model, &Selection::default()).unwrap_err();
        error.to_string()
    };
    let error = refused(&["feature.plug.bend=1"]);
    assert!(
        error.contains("has 0 bends") && error.contains("no bend 1"),
        "{error}"
    );
    let error = refused(&[MEANDER, "feature.plug.bend=70"]);
    assert!(error.contains("no bend 70"), "{error}");
}
