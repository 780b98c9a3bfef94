//! Tests of what may be left out.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

use super::*;
use crate::model::{Format, Source};

const MODEL: &str = r#"
name = "names"
[domain]
x = [0, 100]
y = [0, 100]
z = [-20, 0]
facies = "mud"
[facies.mud]
[[feature]]
id = "trunk"
kind = "channel"
count = 3
facies = "mud"
width = 20
depth = 3
trajectory = { kind = "line", azimuth_deg = 0 }
[[feature]]
id = "nodule"
kind = "ellipsoid"
parent = "trunk"
facies = "mud"
semi_axes = [1, 1, 1]
[[feature]]
id = "shore"
kind = "horizon"
facies = "mud"
surface = { level = -10 }
[[feature]]
id = "lower"
kind = "clinoforms"
parent = "shore"
facies = "mud"
azimuth_deg = 0
length = 100
spacing = 20
first = 10
sheets = 4
belts = [
  { name = "near", facies = "mud", width = 20 },
  { name = "far", facies = "mud" },
]
"#;

const BARE: &str = r#"
[[feature]]
id = "bare"
kind = "clinoforms"
top = "shore"
facies = "mud"
azimuth_deg = 0
length = 100
spacing = 20
first = 10
"#;

fn found(name: &str) -> Result<String, SelectionError> {
    let source = Source::from_text("m.toml", &(MODEL.to_owned() + BARE), Format::Toml);
    let model = Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
    let selection = Selection {
        without: vec![name.to_owned()],
        max_level: None,
    };
    selection
        .found_in(&model)
        .map(|found| found.without[0].clone())
}

fn refused(name: &str) -> Option<String> {
    found(name).err().map(|error| error.to_string())
}

#[test]
fn features_their_volumes_clinothems_and_belts_can_be_left_out() {
    for name in [
        "trunk",
        "trunk-1",
        "trunk-3",
        "nodule",
        "trunk-2/nodule",
        "shore",
        "lower",
        "shore/lower-0",
        "shore/lower-4",
        "shore/lower-1/far",
        "bare",
        "bare-1",
        "bare-7",
    ] {
        assert_eq!(refused(name), None, "{name}");
    }
}

#[test]
fn what_cannot_be_left_out_is_told_with_what_can() {
    for (name, words) in [
        ("trunk-0", "as `trunk-1`"),
        (
            "trunk-4",
            "leave out all of `trunk`, or a volume of it, as `trunk-1`",
        ),
        ("trunk-01", "as `trunk-1`"),
        ("trunk-+1", "as `trunk-1`"),
        ("nodule-1", "as `trunk-1/nodule`"),
        ("trunk-4/nodule", "as `trunk-1"),
        ("trnk", "as `trunk-1`"),
        ("shore-1", "did you mean `shore`?"),
        ("shore/lower-5", "as `shore/lower-1`"),
        ("shore/lower-1/farther", "as `shore/lower-1`"),
        ("shore/lower-1/near/x", "as `shore/lower-1`"),
        // Without belts, what is below the first sheet is the unit's.
        ("bare-0", "as `bare-1`"),
        ("bare-1/far", "as `bare-1`"),
        (
            "zebra",
            "its features are trunk, nodule, shore, lower, bare",
        ),
        (
            "shore/lower-3/near",
            "the other belts of `shore/lower-3` are divided from it; leave out `shore/lower-3`",
        ),
    ] {
        let reason = refused(name).unwrap_or_else(|| panic!("{name} can be left out"));
        assert!(
            reason.contains(words) && reason.contains(&format!("`{name}`")),
            "{reason}"
        );
    }
    let reason = refused("lower-3/near").unwrap();
    assert!(reason.contains("`shore/lower-3/near` cannot be left out alone"));
}

#[test]
fn what_lies_in_one_place_is_found_there() {
    for (name, whole) in [
        ("lower-1", "shore/lower-1"),
        ("lower-0/far", "shore/lower-0/far"),
        ("shore/lower-1", "shore/lower-1"),
        ("nodule", "nodule"),
        ("crystal", "crystal"),
        ("crystal-2", "lens/crystal-2"),
        ("inclusion-3", "lens/crystal/inclusion-3"),
    ] {
        // Another tree: a lens with crystals, the first of which has inclusions.
        let lens = r#"
[[feature]]
id = "lens"
kind = "ellipsoid"
facies = "mud"
semi_axes = [9, 9, 3]
[[feature]]
id = "crystal"
kind = "ellipsoid"
parent = "lens"
count = COUNT
facies = "mud"
semi_axes = [2, 2, 1]
[[feature]]
id = "inclusion"
kind = "ellipsoid"
parent = "crystal"
count = 3
facies = "mud"
semi_axes = [0.1, 0.1, 0.1]
"#;
        let is_deep = name.starts_with("inclusion");
        let text = MODEL.to_owned() + &lens.replace("COUNT", if is_deep { "1" } else { "2" });
        let source = Source::from_text("m.toml", &text, Format::Toml);
        let model = Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
        let selection = Selection {
            without: vec![name.to_owned()],
            max_level: None,
        };
        assert_eq!(selection.found_in(&model).unwrap().without, [whole]);
    }
}

#[test]
fn what_lies_in_several_places_is_refused_with_all_of_them() {
    let text = MODEL.replace("parent = \"trunk\"", "parent = \"trunk\"\ncount = 2");
    let source = Source::from_text("m.toml", &text, Format::Toml);
    let model = Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
    let selection = Selection {
        without: vec!["nodule-2".to_owned()],
        max_level: None,
    };
    let error = selection.found_in(&model).unwrap_err();
    let places = ["trunk-1/nodule-2", "trunk-2/nodule-2", "trunk-3/nodule-2"];
    assert_eq!(
        error,
        SelectionError::Ambiguous {
            name: "nodule-2".to_owned(),
            candidates: places.map(str::to_owned).to_vec(),
        }
    );
    assert!(error.to_string().contains(&places.join(", ")), "{error}");
}
