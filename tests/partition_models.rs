//! Bodies in every kind of contact, made by the partition kernel alone and proven in full.
//!
//! The oracles are closed forms, and that a body which nothing younger reaches is the same whatever it has removed.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use std::f64::consts::PI;

use assembled::{Built, checked, source, without};
use clinothem::assembly::{AssemblyError, Engine};
use clinothem::model::{Format, Source};

fn assemble(source: &Source, ids: &[&str], engine: Engine) -> Result<Built, AssemblyError> {
    Built::new(checked(source), &without(ids), engine)
}

fn contact(name: &str, ids: &[&str]) -> Built {
    let source = source(&format!("contacts/{name}"));
    let built = assemble(&source, ids, Engine::Partition).unwrap();
    assert_eq!(built.assembly.engine, Engine::Partition);
    // At the first attempt.
    assert!(built.assembly.failed.is_empty());
    built
}

fn assert_same(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-8 * a.abs(), "{a} is not {b}");
}

fn ellipsoid([a, b, c]: [f64; 3]) -> f64 {
    4.0 / 3.0 * PI * a * b * c
}

#[test]
fn bodies_that_end_inside_the_block_are_whole_where_nothing_younger_comes() {
    let both = contact("end-caps", &[]);
    let alone = contact("end-caps", &["older"]);
    assert_same(both.size("younger"), alone.size("younger"));
    let older = contact("end-caps", &["younger"]);
    assert!(both.size("older") < older.size("older"));
    assert_eq!(both.solids(), 3);
}

#[test]
fn banks_may_overhang() {
    let both = contact("overhang", &[]);
    let alone = contact("overhang", &["older"]);
    assert_same(both.size("younger"), alone.size("younger"));
    assert_eq!(both.solids(), 3);
}

#[test]
fn tops_may_lie_on_each_other_and_on_the_top_of_the_block() {
    let all = contact("level-tops", &[]);
    // The third is younger than the two beside it: what they are does not change it.
    let without = contact("level-tops", &["first", "second"]);
    assert_same(all.size("third"), without.size("third"));
    let uppermost = contact("level-tops", &["first", "second", "third"]);
    assert_same(all.size("uppermost"), uppermost.size("uppermost"));
    assert_eq!(all.pieces("second"), 2);
}

#[test]
fn bodies_inside_others_make_voids_and_float() {
    let all = contact("inside", &[]);
    assert_same(all.size("nodule"), ellipsoid([8.0, 5.0, 1.5]));
    assert_same(all.size("floating"), ellipsoid([20.0, 12.0, 4.0]));
    let older = contact("inside", &["younger", "nodule", "floating"]);
    let within = all.size("older") + all.size("younger") + all.size("nodule");
    assert_same(within, older.size("older"));
    assert_eq!(all.solids(), 5);
}

#[test]
fn bodies_that_touch_nothing_are_whole() {
    let all = contact("apart", &[]);
    assert_same(all.size("ball"), ellipsoid([6.0; 3]));
    assert_same(all.size("nodule"), ellipsoid([15.0, 9.0, 3.0]));
    for (name, others) in [
        ("channel", ["deep", "nodule", "ball"]),
        ("deep", ["channel", "nodule", "ball"]),
    ] {
        assert_same(all.size(name), contact("apart", &others).size(name));
    }
}

#[test]
fn a_body_may_be_cut_in_pieces_and_another_by_a_corner_of_the_block() {
    let all = contact("pieces", &[]);
    assert_eq!(all.pieces("older"), 4);
    assert_same(
        all.size("younger"),
        contact("pieces", &["older", "corner"]).size("younger"),
    );
    assert!(all.size("corner") < 0.5 * ellipsoid([24.0, 16.0, 7.0]));
}

#[test]
fn a_body_may_be_removed_altogether() {
    let all = contact("removed", &[]);
    assert_eq!([all.pieces("older"), all.pieces("nodule")], [0, 0]);
    assert_same(
        all.size("younger"),
        contact("removed", &["older", "nodule"]).size("younger"),
    );
}

/// Both engines make the same solids, and neither fails.
fn assert_engines_agree(source: &Source) {
    let [ours, theirs] =
        [Engine::Partition, Engine::Occt].map(|engine| assemble(source, &[], engine).unwrap());
    let pieces = [&ours, &theirs].map(|one| &one.assembly.measured.pieces);
    assert_eq!(pieces[0].len(), pieces[1].len());
    for (a, b) in pieces[0].iter().zip(pieces[1]) {
        assert_eq!(a.volume, b.volume);
        // The curves of a general fuse are fitted, to some 1e-5 m.
        assert!(
            (a.size - b.size).abs() < 1e-6 * a.size,
            "{} and {}",
            a.size,
            b.size
        );
    }
}

#[test]
fn two_engines_that_know_nothing_of_each_other_make_the_same_solids() {
    for seed in [3, 8] {
        let mut source = source("channel-belt/channel-belt");
        source.set("feature.channel.count=6".to_owned());
        source.set(format!("seed={seed}"));
        assert_engines_agree(&source);
    }
}

#[test]
fn two_engines_make_the_same_solids_of_horizons_in_a_domain_with_a_bent_base_and_top() {
    let text = "name = \"Units\"\n[domain]\nx = [0, 400]\ny = [0, 300]\nz = [-60, 0]\nfacies = \"mud\"\n\
        base = { grid = { x = [0, 400], y = [0, 300], heights = [[-52, -50, -51], [-51, -48, -50], [-53, -50, -52]] } }\n\
        top = { dipping = { through = [200, 150, -3], dip_deg = 0.4, azimuth_deg = 70 } }\n\
        [facies.mud]\n[facies.sand]\n\
        [[feature]]\nid = \"channel\"\nkind = \"channel\"\nfacies = \"sand\"\nwidth = 60\ndepth = 12\ntop = -20\n\
        trajectory = { kind = \"line\", from = [-20, 120], to = [420, 190] }\n\
        [[feature]]\nid = \"lower\"\nkind = \"horizon\"\nfacies = \"mud\"\n\
        surface = { grid = { x = [0, 400], y = [0, 300], heights = [[-30, -22, -27], [-26, -29, -21], [-24, -20, -28]] } }\n\
        [[feature]]\nid = \"ball\"\nkind = \"ellipsoid\"\nfacies = \"sand\"\nsemi_axes = [40, 30, 7]\ncenter = [210, 140, -17]\n\
        [[feature]]\nid = \"upper\"\nkind = \"horizon\"\nfacies = \"sand\"\nrelation = \"onlapping\"\nsurface = { level = -16 }\n";
    assert_engines_agree(&Source::from_text("units.toml", text, Format::Toml));
}

#[test]
fn two_engines_make_the_same_clinothems_and_facies_belts() {
    let text = "name = \"Set\"\n[domain]\nx = [0, 400]\ny = [0, 300]\nz = [-30, 0]\nfacies = \"mud\"\n\
        [facies.mud]\n[facies.sand]\n\
        [[feature]]\nid = \"set\"\nkind = \"clinoforms\"\nfacies = \"mud\"\nazimuth_deg = 80\nlength = 150\n\
        spacing = 120\nfirst = 60\nsheets = 1\ntoe = 0.4\n\
        belts = [{ name = \"shore\", facies = \"sand\", width = 90, interfingering = 20 }, { name = \"shelf\", facies = \"mud\" }]\n";
    assert_engines_agree(&Source::from_text("set.toml", text, Format::Toml));
}

#[test]
fn bodies_that_only_touch_are_told_apart_by_age_and_keep_their_volumes() {
    let text = "name = \"Touch\"\n[domain]\nx = [0, 400]\ny = [0, 300]\nz = [-24, 0]\nfacies = \"mud\"\n\
        [facies.mud]\n[facies.sand]\n\
        [[feature]]\nid = \"ball\"\nkind = \"ellipsoid\"\nfacies = \"sand\"\n\
        semi_axes = [10, 10, 10]\ncenter = [200, 150, -12]\n\
        [[feature]]\nid = \"beside\"\nkind = \"ellipsoid\"\nfacies = \"sand\"\n\
        semi_axes = [5, 5, 5]\ncenter = [215, 150, -12]\n";
    let source = Source::from_text("touch.toml", text, Format::Toml);
    let built = assemble(&source, &[], Engine::Partition).unwrap();
    assert_eq!(built.assembly.remedy, "contacts by age");
    assert!(
        built
            .plan
            .decisions
            .iter()
            .any(|words| words.contains("by age"))
    );
    for (name, radius) in [("ball", 10.0_f64), ("beside", 5.0)] {
        let right = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
        assert!((built.size(name) / right - 1.0).abs() < 1e-6, "{name}");
    }
}
