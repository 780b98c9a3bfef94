//! Solids from files: keys, files that are not there or are something else, and what the kernel refuses.

use std::path::Path;

use clinothem::model::{Defects, Format, Model, Source};

use super::edited;

const MODEL: &str = r#"
name = "Solid"
[domain]
x = [0, 4000]
y = [0, 4000]
z = [-3000, 0]
facies = "mud"
[facies.mud]
[facies.salt]
[[feature]]
id = "salt"
kind = "solid"
facies = "salt"
file = "salt.step"
at = [2000, 2000, 0]
[[feature]]
id = "cavern"
kind = "solid"
parent = "salt"
facies = "mud"
file = "cavern.brep"
unit = "m"
at = [2250, 1900, -1500]
"#;

const DOME: &str = include_str!("../../models/salt/salt.step");
const CAVERN: &str = include_str!("../../models/salt/cavern.brep");

/// The keys that are broken here alone.
pub(crate) const KEYS_OF_SOLIDS: &[&str] = &["scale"];

fn check(folder: &Path, text: &str, dome: &str) -> Result<Model, Defects> {
    std::fs::write(folder.join("salt.step"), dome).unwrap();
    std::fs::write(folder.join("cavern.brep"), CAVERN).unwrap();
    let source = Source::from_text("solid.toml", text, Format::Toml).in_folder(folder);
    #[cfg(feature = "occt")]
    let source = source.with_solids(clinothem::assembly::read_solid);
    Model::check(&source)
}

fn words(defects: &Defects) -> String {
    let all = defects.iter();
    let words: Vec<&str> = all.flat_map(|one| [one.message(), one.remedy()]).collect();
    words.join("\n")
}

/// Finds this in the model, puts that in its place, expects these words.
#[rustfmt::skip]
const KEYS: &[(&str, &str, &[&str])] = &[
    ("file = \"salt.step\"", "", &["feature \"salt\" has no `file`", "file = \"salt.step\""]),
    ("\"salt.step\"", "▸\"nowhere.step\"", &["the solid of feature \"salt\": \"nowhere.step\": there is no such file", "begins at the model file's folder"]),
    ("\"salt.step\"", "▸\".\"", &["this is no file"]),
    ("\"salt.step\"", "▸7", &["expected text", "double quotes"]),
    ("\"salt.step\"", "▸\"solid.toml\"", &["there is no such file"]),
    ("file = \"salt.step\"", "file = \"salt.step\"\nunit = ▸\"m\"", &["the unit of feature \"salt\" is given, and its file is STEP", "`scale`: 1000 where metres"]),
    ("unit = \"m\"", "", &["feature \"cavern\" has no `unit`", "unit = \"mm\""]),
    ("unit = \"m\"", "unit = ▸\"metres\"", &["there is no unit \"metres\"", "mm"]),
    ("at = [2000, 2000, 0]", "at = ▸[2000, 2000]", &["expected a list of three for the at of feature \"salt\", found a list of 2", "three coordinates"]),
    ("at = [2000, 2000, 0]", "scale = ▸0", &["the scale of feature \"salt\" is 0", "must be above 0"]),
    ("at = [2000, 2000, 0]", "scale = ▸{ uniform = [-1, 2] }", &["the scale of feature \"salt\"", "as small as -1"]),
    ("at = [2000, 2000, 0]", "azimuth_deg = ▸400", &["the azimuth_deg of feature \"salt\" is 400", "clockwise from north"]),
    ("at = [2000, 2000, 0]", "world = ▸1", &["`feature.salt.world`", "found the number 1"]),
    ("at = [2000, 2000, 0]", "▸center = [2000, 2000, 0]", &["unknown key `center` in feature \"salt\""]),
];

#[test]
fn every_broken_solid_is_refused_with_place_value_and_remedy() {
    let mut wrong = Vec::new();
    for (find, replace, expected) in KEYS {
        let (text, place) = edited(MODEL, find, replace);
        let folder = tempfile::tempdir().unwrap();
        let defects = check(folder.path(), &text, DOME).expect_err(&text);
        // Without the kernel the other one is refused, too.
        let of_key = defects
            .iter()
            .filter(|one| !one.message().contains("which is not there"));
        let all: Vec<_> = of_key.collect();
        let said = words(&defects);
        let is_right = all.len() == 1
            && place.is_none_or(|place| place == (all[0].place().line, all[0].place().column))
            && expected.iter().all(|word| said.contains(word));
        if !is_right {
            wrong.push(format!(
                "== {replace}\nexpected {place:?} {expected:?}\n{defects}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_is_no_file_of_a_solid_is_told_without_the_kernel() {
    for (file, expected) in [
        ("", ["the file is empty", "export the solid again"]),
        (
            "solid dome\n facet normal 0 0 1\n",
            ["a mesh of triangles, no solid", "as STEP"],
        ),
        (
            "x,y,z\n1,2,3\n",
            [
                "begins with \"x,y,z\", which is neither STEP nor BREP",
                "export the solid as STEP",
            ],
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let defects = check(folder.path(), MODEL, file).expect_err(file);
        let said = words(&defects);
        assert!(expected.iter().all(|word| said.contains(word)), "{said}");
    }
}

#[test]
fn without_a_reader_a_solid_is_a_defect_that_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("salt.step"), DOME).unwrap();
    std::fs::write(folder.path().join("cavern.brep"), CAVERN).unwrap();
    let source = Source::from_text("solid.toml", MODEL, Format::Toml).in_folder(folder.path());
    let defects = Model::check(&source).unwrap_err();
    assert_eq!(defects.iter().count(), 2);
    let said = words(&defects);
    assert!(
        said.contains("solids are read by the CAD kernel, which is not there")
            && said.contains("the feature `occt`"),
        "{said}"
    );
}

/// The dome without the last face of its shell.
#[cfg(feature = "occt")]
fn open() -> String {
    let shell = DOME.lines().find(|line| line.contains("CLOSED_SHELL"));
    let last = shell.unwrap().rsplit_once(",#").unwrap().1;
    let last = last.trim_end_matches("));");
    DOME.replace(&format!(",#{last}));"), "));")
}

#[cfg(feature = "occt")]
#[test]
fn what_is_no_closed_solid_is_told_with_the_readers_reason() {
    let two = include_str!("../../occt-bridge/tests/cadquery.step");
    let headless = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n";
    for (file, expected) in [
        (&DOME[..DOME.len() / 2], ["\"salt.step\": ", "export"]),
        (headless, ["it holds no shape", "export the solid itself"]),
        (two, ["it holds 2 solids", "one solid a file"]),
        (
            &open(),
            [
                "it is not closed: 1 edge has a face on one side only, one near (",
                "sew its faces",
            ],
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let defects = check(folder.path(), MODEL, file).expect_err("broken");
        assert_eq!(defects.iter().count(), 1, "{defects}");
        let said = words(&defects);
        assert!(
            said.starts_with("the solid of feature \"salt\": \"salt.step\": ")
                && expected.iter().all(|word| said.contains(word)),
            "{said}"
        );
    }
}

#[cfg(feature = "occt")]
#[test]
fn the_good_file_is_good() {
    let folder = tempfile::tempdir().unwrap();
    let model = check(folder.path(), MODEL, DOME).unwrap_or_else(|defects| panic!("{defects}"));
    let solids: Vec<_> = model.solids().collect();
    assert_eq!(solids.len(), 2);
    assert_eq!(
        (solids[0].1.format, solids[0].1.unit.as_str()),
        ("STEP", "millimetre")
    );
    assert_eq!(
        (solids[1].1.format, solids[1].1.unit.as_str()),
        ("BREP", "m")
    );
    assert!(
        model
            .notes
            .iter()
            .any(|note| note.message.contains("the general fuse makes the model"))
    );
}
