//! Contacts as they are found and as they are said.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use super::*;
use crate::assembly::{AssemblyError, Engine, Failed, Subject};
use crate::model::realisation::Realisation;
use crate::model::selection::Selection;
use crate::model::{Format, Model, Source};

const HEAD: &str = "name = \"Contacts\"\n[domain]\nx = [0, 400]\ny = [0, 300]\nz = [-24, 0]\nfacies = \"mud\"\n[facies.mud]\n";

fn channel(id: &str, top: f64, from: [f64; 2], to: [f64; 2]) -> String {
    format!(
        "[[feature]]\nid = \"{id}\"\nkind = \"channel\"\nfacies = \"mud\"\nwidth = 40\ndepth = 6\ntop = {top}\n\
         trajectory = {{ kind = \"line\", from = {from:?}, to = {to:?} }}\n"
    )
}

fn subject(features: &[String]) -> Subject {
    let text = format!("{HEAD}{}", features.concat());
    let model = Model::check(&Source::from_text("model.toml", &text, Format::Toml));
    let model = model.unwrap_or_else(|defects| panic!("{defects}"));
    Subject::new(Realisation::new(&model, &Selection::default()).unwrap()).unwrap()
}

fn found(features: &[String]) -> Vec<Contact> {
    let subject = subject(features);
    search(&subject.plan, &subject.owners, &[])
}

fn names(contact: &Contact) -> [String; 2] {
    contact.parties.each_ref().map(ToString::to_string)
}

#[test]
fn two_channels_on_one_course_a_millimetre_apart_run_along_each_other() {
    let way = ([-50.0, 150.0], [450.0, 150.0]);
    let all = found(&[
        channel("a", -4.0, way.0, way.1),
        channel("b", -4.001, way.0, way.1),
    ]);
    let contact = &all[0];
    assert_eq!(names(contact), ["a", "b"]);
    // Over the whole length of the domain and the width of the channels, and nowhere beyond.
    let size = contact.high - contact.low;
    assert!(size.x > 350.0 && size.x <= 400.0, "{size}");
    assert!((size.y - 40.0).abs() < 1.0, "{size}");
    // The tops are 1 mm apart, and the bases no farther.
    assert!((1e-3..6e-3).contains(&contact.gap), "{}", contact.gap);
}

#[test]
fn two_channels_that_cross_at_a_right_angle_run_along_nothing() {
    let all = found(&[
        channel("a", -4.0, [-50.0, 150.0], [450.0, 150.0]),
        channel("b", -5.0, [200.0, -50.0], [200.0, 350.0]),
    ]);
    assert_eq!(all, []);
}

#[test]
fn a_bank_along_a_wall_of_the_domain_is_told_with_that_wall() {
    // The channel is 40 m wide, so its left bank lies on y = 300.
    let all = found(&[channel("a", -4.0, [-50.0, 280.0], [450.0, 280.0])]);
    assert_eq!(names(&all[0]), ["the domain's north wall", "a"]);
}

/// Clinoforms that are tangent to the base of their unit, which lies on another horizon or is the domain's own.
fn clinoforms(id: &str, within: &str) -> String {
    format!(
        "[[feature]]\nid = \"{id}\"\nkind = \"clinoforms\"\nfacies = \"mud\"\n{within}azimuth_deg = 70\nfirst = 80\n\
         spacing = 60\nlength = 250\n"
    )
}

#[test]
fn clinoforms_that_meet_the_base_and_the_top_of_their_unit_are_not_blamed_for_that() {
    let way = ([-50.0, 150.0], [450.0, 150.0]);
    let horizon = |id: &str, level: f64| {
        format!(
            "[[feature]]\nid = \"{id}\"\nkind = \"horizon\"\nfacies = \"mud\"\nsurface = {{ level = {level} }}\n"
        )
    };
    let within = "parent = \"lower\"\ntop = \"upper\"\n";
    let mut features = vec![
        horizon("lower", -18.0),
        horizon("upper", -12.0),
        clinoforms("set", within),
        channel("a", -4.0, way.0, way.1),
        channel("b", -4.001, way.0, way.1),
    ];
    let said = |features: &[String]| found(features).iter().map(names).collect::<Vec<_>>();
    assert_eq!(said(&features), [["a", "b"]]);
    // Nor where the domain's base and top are those of the unit.
    assert_eq!(said(&[clinoforms("set", "")]), [[""; 2]; 0]);
    // Another horizon, which happens to run along their lower ends, is.
    features.insert(2, horizon("stray", -17.999));
    assert!(
        said(&features)
            .iter()
            .any(|names| names[0].contains("lower"))
    );
}

#[test]
fn a_doubt_of_the_partition_is_told_by_what_its_regions_stand_for() {
    let way = ([-50.0, 150.0], [450.0, 150.0]);
    let subject = subject(&[
        channel("a", -4.0, way.0, way.1),
        channel("b", -8.0, way.0, way.1),
    ]);
    assert!(subject.plan.lids.is_empty());
    let doubt = |regions: [usize; 2]| Doubt {
        regions,
        low: DVec3::new(0.0, 130.0, -7.0),
        high: DVec3::new(200.0, 170.0, -7.0),
        gap: 0.003,
        what: "run along each other",
    };
    // Regions: the block, then the shells.
    let told = of_doubts(&subject.plan, &[doubt([2, 1]), doubt([0, 2])]);
    assert_eq!(names(&told[0]), ["a", "b"]);
    // The middle of the place is nearest to the domain's top.
    assert_eq!(names(&told[1]), ["the domain's top", "b"]);
    let said = told[0].to_string();
    assert!(
        said.starts_with("a and b run along each other within 3.0 mm over 200 m × 40 m × 0 m around (100, 150, -7); change `top`"),
        "{said}"
    );
}

#[test]
fn a_refusal_names_the_bodies_the_place_and_the_remedy_and_counts_no_faults_of_the_kernel() {
    let way = ([-50.0, 150.0], [450.0, 150.0]);
    let contacts = found(&[
        channel("a", -4.0, way.0, way.1),
        channel("b", -4.001, way.0, way.1),
    ]);
    let why = "it contradicts itself (at a, b): 7 undecided contacts".to_owned();
    let failed = Failed::new(Engine::Partition, "none", why);
    let refusal = |contacts: Vec<Contact>| AssemblyError::NotProven {
        failed: vec![failed.clone()],
        contacts,
        names: "a, b".to_owned(),
    };
    let known = refusal(contacts).to_string();
    for words in [
        "a and b run along each other within",
        "change `top`",
        "nothing is written",
    ] {
        assert!(known.contains(words), "{known}");
    }
    // Where no place is known, at least the bodies and a way to find out.
    let unknown = refusal(Vec::new()).to_string();
    for words in ["in doubt: a, b", "--without"] {
        assert!(unknown.contains(words), "{unknown}");
    }
    assert!(!format!("{known}{unknown}").contains("undecided"));
}

#[test]
fn lengths_are_told_in_the_unit_that_suits_them() {
    for (metres, said) in [
        (86_000.0, "86 km"),
        (200.0, "200 m"),
        (2.5, "2.5 m"),
        (0.25, "25 cm"),
        (0.003, "3.0 mm"),
        (4e-5, "40 µm"),
        (1e-9, "less than 1 µm"),
        (0.0, "0 m"),
    ] {
        assert_eq!(length(metres), said);
    }
}
