//! The published schema admits what the program admits, and refuses the commonest slips.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "assembled/checked.rs"]
mod checked;

use clinothem::model::{Model, schema};
use serde_json::Value;

const GOOD: &str = include_str!("bad_models/good.toml");

/// One of everything that the format has.
const FULL: &str = include_str!("bad_models/full.toml");

/// Horizons and clinoforms.
const SHOREFACE: &str = include_str!("bad_models/shoreface.toml");

fn as_json(toml: &str) -> Value {
    let value: toml::Value = toml::from_str(toml).unwrap();
    serde_json::to_value(value).unwrap()
}

fn check(text: &str) -> Model {
    checked::from_text(text, &[])
}

#[test]
fn the_schema_admits_every_committed_model() {
    let validator = jsonschema::validator_for(&schema()).unwrap();
    let mut models = 0;
    for entry in std::fs::read_dir("models").unwrap() {
        for file in std::fs::read_dir(entry.unwrap().path()).unwrap() {
            let path = file.unwrap().path();
            if path
                .extension()
                .is_some_and(|extension| extension == "toml")
            {
                let text = std::fs::read_to_string(&path).unwrap();
                check(&text);
                let errors: Vec<String> = validator
                    .iter_errors(&as_json(&text))
                    .map(|e| e.to_string())
                    .collect();
                assert!(errors.is_empty(), "{}: {errors:?}", path.display());
                models += 1;
            }
        }
    }
    assert!(models >= 2);
}

#[test]
fn the_schema_and_the_program_admit_one_of_everything() {
    let validator = jsonschema::validator_for(&schema()).unwrap();
    for text in [GOOD, FULL, SHOREFACE] {
        check(text);
        let errors: Vec<String> = validator
            .iter_errors(&as_json(text))
            .map(|e| e.to_string())
            .collect();
        assert!(errors.is_empty(), "{errors:#?}");
    }
}

#[test]
fn the_schema_refuses_the_commonest_slips() {
    let validator = jsonschema::validator_for(&schema()).unwrap();
    for (find, replace) in [
        ("name = \"Test\"", ""),
        ("seed = 7", "seed = -7"),
        ("seed = 7", "seeds = 7"),
        ("x = [0, 1000]", "x = [0, 500, 1000]"),
        ("x = [0, 1000]", "x = 1000"),
        ("porosity = 0.08", "porosity = 8"),
        ("color = \"#9a8f78\"", "color = \"grey\""),
        ("width = 50", ""),
        ("width = 50", "width = \"50 m\""),
        ("width = 50", "width = { triangular = [1, 2] }"),
        ("width = 50", "width = { uniform = [1, 2], min = 3 }"),
        ("width = 50", "widht = 50"),
        ("id = \"channel\"", "id = \"main channel\""),
        ("kind = \"channel\"", "kind = \"chanel\""),
        ("kind = \"line\"", "kind = \"lime\""),
        ("count = 3", "count = 0"),
        ("count = 3", "count = 2.5"),
        ("count = 3", "removes = \"second\""),
        ("azimuth_deg = 80", "azimuth = 80"),
    ] {
        assert!(GOOD.contains(find), "{find}");
        let broken = GOOD.replacen(find, replace, 1);
        assert!(
            !validator.is_valid(&as_json(&broken)),
            "admitted: {replace}"
        );
    }
}

#[test]
fn the_schema_tells_ellipsoids_from_channels() {
    const NODULE: &str = include_str!("bad_models/nodule.toml");
    let validator = jsonschema::validator_for(&schema()).unwrap();
    assert!(validator.is_valid(&as_json(NODULE)));
    for (find, replace) in [
        ("semi_axes = [6, 4, 2]", ""),
        ("semi_axes = [6, 4, 2]", "semi_axes = [6, 4]"),
        ("semi_axes = [6, 4, 2]", "semi_axes = 6"),
        (
            "semi_axes = [6, 4, 2]",
            "semi_axes = [6, 4, { uniform = 2 }]",
        ),
        ("center = [50, 50, -15]", "center = [50, 50]"),
        ("center = [50, 50, -15]", "width = 50"),
        ("kind = \"ellipsoid\"", "kind = \"channel\""),
        ("plunge_deg = 10", "plunge = 10"),
    ] {
        assert!(NODULE.contains(find), "{find}");
        let broken = NODULE.replacen(find, replace, 1);
        assert!(
            !validator.is_valid(&as_json(&broken)),
            "admitted: {replace}"
        );
    }
}

#[test]
fn the_schema_refuses_slips_in_horizons_and_clinoforms() {
    let validator = jsonschema::validator_for(&schema()).unwrap();
    for (find, replace) in [
        ("base = { level = -55 }", "base = -55"),
        ("base = { level = -55 }", "base = { lvel = -55 }"),
        ("base = { level = -55 }", "base = { level = \"-55\" }"),
        ("dip_deg = 1", "dip = 1"),
        ("through = [0, 0, -1], ", ""),
        ("y = [-10, 700], ", ""),
        ("heights = [[", "heights = [[[0], "),
        ("[400, 0, -20]", "[400, 0]"),
        (", tolerance = 0.1", ""),
        ("tolerance = 0.1", "tolerance = 0"),
        ("\"onlapping\"", "\"conformable\""),
        ("length = { uniform = [150, 900] }", ""),
        ("shoreline = [3000, ", "shoreline = [3000, 3000, "),
        ("sheets = 6", "sheets = 501"),
        ("\"zigzag\"", "\"zig-zag\""),
        ("name = \"lsf\"", "name = \"lower shoreface\""),
        ("name = \"lsf\", ", ""),
        ("width = 120", "widht = 120"),
    ] {
        assert!(SHOREFACE.contains(find), "{find}");
        let broken = SHOREFACE.replacen(find, replace, 1);
        assert!(
            !validator.is_valid(&as_json(&broken)),
            "admitted: {replace}"
        );
    }
}

#[test]
fn every_key_of_the_schema_has_a_description() {
    fn walk(value: &Value, path: &str, bare: &mut Vec<String>) {
        match value {
            Value::Object(object) => {
                if let Some(Value::Object(properties)) = object.get("properties") {
                    for (key, property) in properties {
                        // The keys of distributions and selectors are described by the table they stand in.
                        let described = property.get("description").is_some();
                        let small = ["id", "kind", "level", "facies", "expression"]
                            .contains(&key.as_str())
                            && properties.len() == 1;
                        if !described && !small {
                            bare.push(format!("{path}/{key}"));
                        }
                    }
                }
                for (key, inner) in object {
                    walk(inner, &format!("{path}/{key}"), bare);
                }
            }
            Value::Array(values) => values.iter().for_each(|inner| walk(inner, path, bare)),
            _ => {}
        }
    }
    let mut bare = Vec::new();
    walk(&schema(), "", &mut bare);
    assert!(bare.is_empty(), "{bare:#?}");
}
