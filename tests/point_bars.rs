//! Point bars: how much of a bend their packages hold, which takes from which, and their names.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use std::f64::consts::FRAC_PI_2;

use assembled::{Built, from_text, without};
use clinothem::assembly::Engine;
use clinothem::features::bends::bends;
use clinothem::features::meander::SineGenerated;
use clinothem::features::trajectory::Trajectory;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::DVec2;

/// A meander through a block that holds one of its bends as a whole, with a level lag.
const MEANDER: &str = r#"
name = "Meander"
[domain]
x = [-20, 600]
y = [-250, 250]
z = [-20, 0]
facies = "silt"
[facies.silt]
[facies.mud]
[facies.sand]
[facies.gravel]
[[feature]]
id = "channel"
kind = "channel"
facies = "sand"
width = 50
depth = 4.4
top = -5
tolerance_fraction = 0.001
trajectory = { kind = "sine-generated", amplitude = 100, wavelength = 475, azimuth_deg = 90, center = [0, 0], phase = 0.25, length = 1900 }
[[feature]]
id = "lag"
kind = "lag"
parent = "channel"
facies = "gravel"
thickness_fraction = 0.1
sag_fraction = 0
[[feature]]
id = "bar"
kind = "point-bars"
parent = "channel"
facies = "sand"
"#;

/// Area of the default section as a fraction of width times depth.
const SECTION: f64 = 0.764_563;

fn built(overrides: &[&str], selection: &Selection) -> Built {
    Built::new(from_text(MEANDER, overrides), selection, Engine::Partition).unwrap()
}

/// The bars of which all four packages lie in the block's middle, by their names.
fn whole_bars(built: &Built) -> Vec<String> {
    let names = built.plan.names.iter();
    let bars = names.filter_map(|name| name.strip_suffix("/accretion-4"));
    let whole = |bar: &&str| built.size(&format!("{bar}/accretion-1")) > 500.0;
    bars.filter(whole).map(str::to_owned).collect()
}

#[test]
fn packages_have_the_shares_of_their_bend_that_sums_over_strips_of_sections_tell() {
    let built = built(&[], &Selection::default());
    let line = Trajectory::sine_generated(&SineGenerated {
        amplitude: 100.0,
        wavelength: 475.0,
        azimuth: FRAC_PI_2,
        center: DVec2::ZERO,
        phase: 0.25,
        extent: [-950.0, 950.0],
    });
    let bend = bends(&line.unwrap(), 50.0, 0.3)[2];
    let whole = SECTION * 50.0 * 4.4 * (bend.to - bend.from);
    let bars = whole_bars(&built);
    assert!(bars.len() >= 2, "{bars:?}");
    for bar in &bars[..2] {
        let mut sum = 0.0;
        // Numbers of another program, to four digits.
        for (package, wanted) in [0.1079, 0.1563, 0.2103, 0.2676].into_iter().enumerate() {
            sum += built.size(&format!("{bar}/accretion-{}", package + 1));
            assert!(
                (sum / whole - wanted).abs() < 2e-4,
                "{bar} {package}: {}",
                sum / whole
            );
        }
    }
}

#[test]
fn what_is_left_out_goes_to_the_next_younger_package_and_the_youngest_to_the_channel() {
    let all = built(&[], &Selection::default());
    let bar = whole_bars(&all)[0].clone();
    let sum =
        |built: &Built, names: &[String]| names.iter().map(|name| built.size(name)).sum::<f64>();
    for (out, heir) in [(2, format!("{bar}/accretion-3")), (4, "channel".to_owned())] {
        let out = format!("{bar}/accretion-{out}");
        let less = built(&[], &without(&[&out]));
        let wanted = sum(&all, &[out.clone(), heir.clone()]);
        let found = less.size(&heir);
        assert!(
            (found / wanted - 1.0).abs() < 1e-8,
            "{out}: {found} {wanted}"
        );
    }
}

#[test]
fn drapes_lie_on_their_surfaces_as_thick_as_asked() {
    let drape = ["feature.bar.drape={ thickness = 0.15, facies = \"mud\" }"];
    let built = built(&drape, &Selection::default());
    let bar = whole_bars(&built)[0].clone();
    for package in 1..=4 {
        let on = format!("{bar}/accretion-{package}");
        let drape = format!("{on}/drape");
        let thickness = built.size(&drape) / built.contact(&drape, &on);
        assert!(
            (thickness / 0.15 - 1.0).abs() < 0.03,
            "{drape}: {thickness}"
        );
    }
}

#[test]
fn packages_have_facies_of_their_own_from_the_oldest_and_names_in_every_channel() {
    let overrides = [
        "feature.channel.count=2",
        "feature.channel.top={ uniform = [-14, -1] }",
        "feature.bar.package_facies=[\"gravel\", \"sand\", \"sand\", \"mud\"]",
    ];
    let model = from_text(MEANDER, &overrides);
    let names = |out: &[&str]| -> Vec<(String, String)> {
        let made = Realisation::new(&model, &without(out)).unwrap();
        let volumes = made.volumes.iter();
        volumes
            .map(|one| (one.name.clone(), one.facies.clone()))
            .collect()
    };
    let all = names(&[]);
    for (package, facies) in [(1, "gravel"), (2, "sand"), (4, "mud")] {
        let end = format!("/accretion-{package}");
        assert!(all.iter().filter(|one| one.0.ends_with(&end)).count() >= 6);
        assert!(
            all.iter()
                .filter(|one| one.0.ends_with(&end))
                .all(|one| one.1 == facies)
        );
    }
    let bar = all
        .iter()
        .find(|one| one.0.starts_with("channel-2/bar-"))
        .unwrap();
    let bar = bar.0.rsplit_once('/').unwrap().0;
    for (out, fewer) in [(format!("{bar}/accretion-2"), 1), (bar.to_owned(), 4)] {
        let left = names(&[&out]);
        assert_eq!(left.len() + fewer, all.len(), "{out}");
    }
    assert!(
        names(&["channel-2/bar"])
            .iter()
            .all(|one| !one.0.starts_with("channel-2/bar"))
    );
}

#[test]
fn a_channel_without_bends_has_no_point_bars() {
    let line = "feature.channel.trajectory={ kind = \"line\", from = [-100, 0], to = [700, 10] }";
    let model = from_text(MEANDER, &[line]);
    let error = Realisation::new(&model, &Selection::default()).unwrap_err();
    assert!(error.to_string().contains("no bend"), "{error}");
}
