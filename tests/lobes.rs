//! Lobes: their volumes, what they take from, and how they stack.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use std::f64::consts::PI;

use assembled::{Built, built, from_text, without};
use clinothem::assembly::Engine;
use clinothem::features::body::Body;
use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::DVec3;

/// A lobe in a block.
const ONE: &str = r#"
name = "Lobe"
[domain]
x = [0, 500]
y = [0, 400]
z = [-20, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "lobe"
kind = "lobe"
facies = "sand"
length = 300
width = 180
thickness = 6
azimuth_deg = 60
center = [250, 200]
base = -12
"#;

/// The height of the template over its thickness, by trying: the thickness is the greatest value of (1 − X²)(1 − λX).
fn height(skew: f64) -> f64 {
    let values = (-1000..=1000).map(|k| {
        let x = f64::from(k) / 1000.0;
        (1.0 - x * x) * (1.0 - skew * x)
    });
    1.0 / values.fold(0.0, f64::max)
}

/// π/2 a b H (1 − λτ/6).
fn volume(length: f64, width: f64, thickness: f64, taper: f64, skew: f64) -> f64 {
    PI / 8.0 * length * width * thickness * height(skew) * (1.0 - skew * taper / 6.0)
}

#[test]
fn walls_through_the_middle_of_a_lobe_leave_a_half_of_it_and_through_a_round_one_a_quarter() {
    // Without taper and skew it is the same on both sides of its middle.
    let whole = volume(300.0, 180.0, 6.0, 0.0, 0.0);
    for (center, azimuth, width, part) in [
        ("[250, 0]", 45, 180, 0.5),
        ("[250, 0]", 90, 180, 0.5),
        ("[0, 200]", 20, 180, 0.5),
        ("[500, 400]", 45, 300, 0.25 / 0.6),
        ("[0, 0]", 0, 300, 0.25 / 0.6),
    ] {
        let overrides = [
            "feature.lobe.taper=0".to_owned(),
            "feature.lobe.skew=0".to_owned(),
            format!("feature.lobe.center={center}"),
            format!("feature.lobe.azimuth_deg={azimuth}"),
            format!("feature.lobe.width={width}"),
        ];
        let built = built(
            ONE,
            &overrides.each_ref().map(String::as_str),
            Engine::Partition,
        );
        let found = built.size("lobe") / whole;
        assert!((found - part).abs() < 1e-5, "{center} {azimuth}: {found}");
        assert_eq!(built.solids(), 2);
    }
}

#[test]
fn a_lobes_volume_is_that_of_its_closed_form_whatever_its_taper_and_skew() {
    for (taper, skew, azimuth) in [
        (0.5, 0.3, 60),
        (0.0, 0.0, 0),
        (0.9, -0.9, 133),
        (-0.6, 0.7, 270),
    ] {
        let overrides = [
            format!("feature.lobe.taper={taper}"),
            format!("feature.lobe.skew={skew}"),
            format!("feature.lobe.azimuth_deg={azimuth}"),
        ];
        let built = built(
            ONE,
            &overrides.each_ref().map(String::as_str),
            Engine::Partition,
        );
        let wanted = volume(300.0, 180.0, 6.0, taper, skew);
        let found = built.size("lobe");
        assert!((found / wanted - 1.0).abs() < 2e-6, "{found} {wanted}");
        assert_eq!(built.solids(), 2);
    }
}

#[test]
fn by_its_apex_or_its_middle_a_lobe_is_the_same_and_a_wall_along_its_axis_halves_it() {
    let whole = volume(300.0, 180.0, 6.0, 0.5, 0.3);
    let by_apex = ONE.replace("center = [250, 200]", "apex = [100, 200]");
    let east = "feature.lobe.azimuth_deg=90";
    let one = built(&by_apex, &[east], Engine::Partition);
    assert!((one.size("lobe") / whole - 1.0).abs() < 2e-6);
    let half = built(&by_apex, &[east, "domain.y=[200, 400]"], Engine::Partition);
    let half = half.size("lobe") / whole;
    // Its seam lies on the wall: it is decided by age, by less than a millimetre.
    assert!((half - 0.5).abs() < 2e-4, "{half}");
    // Its apex is on the wall, or beyond it.
    for x in [0, -40] {
        let cut = built(
            &by_apex,
            &[east, &format!("feature.lobe.apex=[{x}, 200]")],
            Engine::Auto,
        );
        assert!(cut.size("lobe") <= whole * (1.0 + 1e-6));
    }
}

/// A channel that ends in the block, wider and shallower there, and a bar at its mouth.
const MOUTH: &str = r#"
name = "Mouth"
[domain]
x = [0, 1000]
y = [0, 600]
z = [-20, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "bar"
kind = "lobe"
facies = "sand"
mouth_of = "trunk"
[[feature]]
id = "trunk"
kind = "channel"
facies = "sand"
width = [[0, 40], [1, 60]]
depth = [[0, 4], [1, 3]]
top = -5
trajectory = { kind = "points", points = [[-50, 150], [150, 320], [400, 300]] }
"#;

#[test]
fn a_mouth_bar_is_as_its_channel_says_and_begins_in_its_end() {
    // 5 W long, 3.2 W wide and D thick, with the width and the depth at the end; the channel left out says so, too.
    let model = from_text(MOUTH, &[]);
    let alone = Built::new(model, &without(&["trunk"]), Engine::Partition).unwrap();
    let expected = volume(300.0, 192.0, 3.0, 0.5, 0.3);
    assert!((alone.size("bar") / expected - 1.0).abs() < 1e-8);
    // Its axis goes on in the channel's: from a tenth of the width inside, and 300 m from there. The bar's base is at −8.06 m.
    let both = built(MOUTH, &[], Engine::Partition);
    let realised = &both.realisation;
    let way = realised.instances.iter().find_map(|one| match &one.body {
        Body::Trough(trough) => Some(trough.base().clone()),
        _ => None,
    });
    let base = way.unwrap();
    let (across, along) = (base.knots_u().domain(), base.knots_v().domain());
    let rims = [across.0, across.1].map(|u| base.point(u, along.1));
    let end = 0.5 * (rims[0] + rims[1]).truncate();
    let right = (rims[1] - rims[0]).truncate().normalize();
    let ahead = glam::DVec2::new(-right.y, right.x);
    assert!((end - glam::DVec2::new(400.0, 300.0)).length() < 1e-6);
    assert!(ahead.x > 0.5, "downstream: {ahead}");
    let bar = alone.volume("bar");
    for (way, height, is_bar) in [
        (-6.1, 0.02, false),
        (-5.0, 0.02, true),
        (1.0, 0.1, true),
        (100.0, 2.5, true),
        (100.0, 3.1, false),
        (293.0, 0.01, true),
        (294.5, 0.01, false),
    ] {
        let at = (end + way * ahead).extend(-8.06 + height);
        assert_eq!(alone.owners.at(at) == Some(bar), is_bar, "{way} {height}");
    }
    // A third of it across on each side where it is widest.
    let widest = |x: f64| 96.0 * (1.0 - x * x).sqrt() * (1.0 + 0.5 * x);
    let at = |x: f64, y: f64| {
        let place = end + (144.0 + 150.0 * x) * ahead + y * right;
        alone.owners.at(place.extend(-8.06 + 0.001)) == Some(bar)
    };
    for x in [-0.5, 0.0, 0.366, 0.8] {
        for sign in [-1.0, 1.0] {
            assert!(
                at(x, sign * (widest(x) - 1.0)) && !at(x, sign * (widest(x) + 1.0)),
                "{x}"
            );
        }
    }
    // The younger channel takes what of it lies in its end, and nothing has to be moved for that.
    assert_eq!(both.assembly.remedy, "none");
    let left = both.size("bar");
    assert!(
        left < alone.size("bar") && left > 0.9 * alone.size("bar"),
        "{left}"
    );
    assert!(both.contact("bar", "trunk") > 0.0);
    // What is given is kept.
    let given = [
        "feature.bar.length=200",
        "feature.bar.thickness=2",
        "feature.bar.taper=0",
    ];
    let model = from_text(MOUTH, &given);
    let other = Built::new(model, &without(&["trunk"]), Engine::Partition).unwrap();
    let expected = volume(200.0, 192.0, 2.0, 0.0, 0.3);
    assert!((other.size("bar") / expected - 1.0).abs() < 1e-8);
}

#[test]
fn on_a_horizon_a_lobe_loses_what_is_sunk_below_it() {
    let text = ONE.replace(
        "[[feature]]",
        "[[feature]]\nid = \"floor\"\nkind = \"horizon\"\nfacies = \"mud\"\nsurface = { level = -12 }\n[[feature]]",
    )
    .replace("base = -12", "parent = \"floor\"");
    for sunk in [0.02, 0.3] {
        let one = built(
            &text,
            &[&format!("feature.lobe.sunk_fraction={sunk}")],
            Engine::Partition,
        );
        // Above the level s of its thickness: for λ = 0 it is what is left of a paraboloid, H (1 − r² − s).
        let plain = built(
            &text,
            &[
                &format!("feature.lobe.sunk_fraction={sunk}"),
                "feature.lobe.skew=0",
            ],
            Engine::Partition,
        );
        let wanted = volume(300.0, 180.0, 6.0, 0.5, 0.0) * (1.0_f64 - sunk).powi(2);
        let found = plain.size("floor/lobe");
        assert!((found / wanted - 1.0).abs() < 2e-6, "{found} {wanted}");
        assert!(one.size("floor/lobe") > 0.0);
        assert!(one.contact("floor/lobe", "background") > 0.0);
    }
}

#[test]
fn younger_lobes_with_flat_bases_cut_older_ones_wherever_they_lie() {
    let two = |x: i32, y: i32, base: f64, azimuth: i32| {
        format!(
            "{ONE}{}",
            format_args!(
                r#"
[[feature]]
id = "younger"
kind = "lobe"
facies = "mud"
length = 200
width = 150
thickness = 5
azimuth_deg = {azimuth}
center = [{x}, {y}]
base = {base}
"#
            )
        )
    };
    let (whole, younger) = (
        volume(300.0, 180.0, 6.0, 0.5, 0.3),
        volume(200.0, 150.0, 5.0, 0.5, 0.3),
    );
    for (x, y, base, azimuth) in [
        (300, 220, -10.0, 120),
        (180, 150, -14.0, 10),
        (250, 200, -7.5, 300),
    ] {
        let one = built(&two(x, y, base, azimuth), &[], Engine::Partition);
        assert!((one.size("younger") / younger - 1.0).abs() < 2e-6);
        let left = one.size("lobe") / whole;
        assert!(left > 0.05 && left < 1.0, "{left}");
    }
}

#[test]
fn the_general_fuse_makes_the_same_lobe() {
    let [one, other] =
        [Engine::Partition, Engine::Occt].map(|engine| built(ONE, &[], engine).size("lobe"));
    assert!((one - other).abs() < 1e-6 * one, "{one} {other}");
}

/// Lobes on a floor.
const STACK: &str = r#"
name = "Stack"
[domain]
x = [0, 1200]
y = [0, 1000]
z = [-40, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[facies.drape]
[[feature]]
id = "floor"
kind = "horizon"
facies = "drape"
surface = { level = -35 }
[[feature]]
id = "lobes"
kind = "lobes"
parent = "floor"
count = 8
facies = "sand"
length = { uniform = [300, 420] }
width = { uniform = [200, 280] }
thickness = { uniform = [3, 5] }
azimuth_deg = { uniform = [60, 120] }
region = { x = [300, 900], y = [300, 700] }
"#;

#[test]
fn stacked_lobes_keep_what_they_have_and_leave_nothing_between() {
    let one = built(STACK, &["feature.lobes.compensation=20"], Engine::Partition);
    // The oldest one lies on a level floor: what stands out of that is the whole, but for the skew of what is sunk.
    let instance = &one.realisation.instances[one.volume("floor/lobes-1") - 1];
    let drawn = |key: &str| {
        let found = instance.drawn.iter().find(|one| one.0 == key);
        found.map(|one| one.1).unwrap()
    };
    let whole = volume(
        drawn("length"),
        drawn("width"),
        drawn("thickness"),
        0.5,
        0.3,
    );
    let kept = one.size("floor/lobes-1") / whole;
    assert!((kept - 1.0).abs() < 2e-3, "{kept}");
    // What is around them is one piece above the lobes, and nothing is below or between.
    assert_eq!(one.pieces("floor"), 1);
    for number in 1..=8 {
        assert!(one.size(&format!("floor/lobes-{number}")) > 0.0);
    }
}

/// Of a set of lobes: thickness by intervals of equal numbers of lobes, at places in plan.
fn intervals(seed: u64, compensation: f64, count: usize, of: usize) -> Vec<Vec<f64>> {
    let overrides = [
        format!("seed={seed}"),
        format!("feature.lobes.compensation={compensation}"),
        format!("feature.lobes.count={count}"),
    ];
    let model = from_text(STACK, &overrides.each_ref().map(String::as_str));
    let made = Realisation::new(&model, &Selection::default()).unwrap();
    let owners = Owners::new(&made).unwrap();
    let number = |name: &str| name.strip_prefix("floor/lobes-")?.parse::<usize>().ok();
    let numbers: Vec<Option<usize>> = made.volumes.iter().map(|one| number(&one.name)).collect();
    let places = (0..12 * 8).map(|k| (350 + 45 * (k % 12), 340 + 45 * (k / 12)));
    let step = 0.1;
    places
        .map(|(x, y)| {
            let mut thickness = vec![0.0; count / of];
            for k in 0..400 {
                let z = -39.95 + step * f64::from(k);
                let owner = owners.at(DVec3::new(f64::from(x), f64::from(y), z));
                if let Some(number) = owner.and_then(|owner| numbers[owner]) {
                    thickness[(number - 1) / of] += step;
                }
            }
            thickness
        })
        .collect()
}

/// The coefficient of variation of the thickness over the plan, of intervals of some numbers of lobes (Straub et al. 2009).
fn variation(intervals: &[Vec<f64>], of: usize) -> f64 {
    let all = intervals[0].len() / of;
    let sum = (0..all).map(|at| {
        let sums: Vec<f64> = intervals
            .iter()
            .map(|one| one[at * of..(at + 1) * of].iter().sum())
            .collect();
        let mean = sums.iter().sum::<f64>() / sums.len() as f64;
        let square = sums.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / sums.len() as f64;
        square.sqrt() / mean
    });
    sum.sum::<f64>() / all as f64
}

#[test]
fn the_compensation_index_of_the_model_is_greater_where_lobes_prefer_hollows() {
    // The index is the slope by which the variation falls with the number of lobes.
    let index = |compensation: f64| {
        let seeds = [1, 2, 3];
        let slopes = seeds.map(|seed| {
            let made = intervals(seed, compensation, 24, 3);
            (variation(&made, 1) / variation(&made, 8)).ln() / 8_f64.ln()
        });
        slopes.iter().sum::<f64>() / 3.0
    };
    let [random, compensated] = [0.0, 20.0].map(index);
    assert!(
        compensated > random + 0.15 && random > 0.2 && compensated < 1.1,
        "{random} {compensated}"
    );
}

#[test]
fn without_compensation_lobes_cover_what_a_boolean_model_does() {
    let mut covered = [0.0; 2];
    for seed in 1..=8 {
        let overrides = [
            format!("seed={seed}"),
            "feature.lobes.compensation=0".to_owned(),
            "feature.lobes.count=10".to_owned(),
            "feature.lobes.length=150".to_owned(),
            "feature.lobes.width=100".to_owned(),
            "feature.lobes.thickness=4".to_owned(),
            "feature.lobes.region={ x = [100, 700], y = [100, 600] }".to_owned(),
        ];
        let model = from_text(STACK, &overrides.each_ref().map(String::as_str));
        let made = Realisation::new(&model, &Selection::default()).unwrap();
        let owners = Owners::new(&made).unwrap();
        for k in 0..45 * 35 {
            let at = (180 + 10 * (k % 45), 180 + 10 * (k / 45));
            // A hundredth of the thickness above the floor.
            let owner = owners.at(DVec3::new(f64::from(at.0), f64::from(at.1), -35.0 + 0.04));
            let is_lobe = owner.is_some_and(|owner| made.volumes[owner].name.contains("lobes"));
            covered[usize::from(is_lobe)] += 1.0;
        }
    }
    let share = covered[1] / (covered[0] + covered[1]);
    // Of a paraboloid, what is higher than a hundredth covers 1 % less.
    let plan = PI / 4.0 * 150.0 * 100.0 * 0.99;
    let wanted = 1.0 - (-10.0 * plan / (600.0 * 500.0)).exp();
    // Eight sets of ten: the share of one varies by some 0.05.
    assert!((share - wanted).abs() < 0.05, "{share} {wanted}");
}

#[test]
fn eroding_lobes_take_from_older_ones() {
    let eroding = ["feature.lobes.erosion=0.3", "feature.lobes.count=5"];
    let plain = ["feature.lobes.count=5"];
    let [one, other] = [&eroding[..], &plain[..]].map(|all| built(STACK, all, Engine::Partition));
    let older = |built: &Built| -> f64 {
        let sizes = (1..=4).map(|number| built.size(&format!("floor/lobes-{number}")));
        sizes.sum()
    };
    // The youngest loses nothing; older ones lose by it and by each other.
    let [youngest, whole] = [&one, &other].map(|built| built.size("floor/lobes-5"));
    assert!(youngest > 0.99 * whole, "{youngest} {whole}");
    let [left, all] = [older(&one), older(&other)];
    assert!(left < all && left > 0.5 * all, "{left} {all}");
}

#[test]
fn a_lobe_that_is_left_out_leaves_its_place_to_the_unit() {
    let selection = assembled::without(&["floor/lobes-2"]);
    let model = from_text(STACK, &["feature.lobes.count=3"]);
    let whole = Built::new(model.clone(), &Selection::default(), Engine::Partition).unwrap();
    let bare = Built::new(model, &selection, Engine::Partition).unwrap();
    let [one, other] = ["floor/lobes-1", "floor/lobes-3"];
    assert!((whole.size(one) - bare.size(one)).abs() < 1e-6 * whole.size(one));
    // What it lay on is gone; it takes that place, too.
    assert!(bare.size(other) >= whole.size(other) * (1.0 - 1e-6));
    assert!(bare.realisation.volume("floor/lobes-2").is_none());
}
