//! The published schema admits what the program admits, and refuses the commonest slips.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "assembled/checked.rs"]
mod checked;
#[path = "assembled/underlined.rs"]
mod underlined;

use std::path::Path;

use clinothem::model::{Format, Model, Source, schema};
use serde_json::Value;

use underlined::underlined;

const GOOD: &str = include_str!("bad_models/good.toml");

/// One of everything that the format has.
const FULL: &str = include_str!("bad_models/full.toml");

/// Several slips at once.
const SLIPS: &str = include_str!("bad_models/slips.toml");

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
                // Solids of other programs the kernel reads.
                if cfg!(feature = "occt") || !text.contains("\"solid\"") {
                    checked::checked(&Source::read(path.clone()).unwrap());
                }
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
fn the_schema_and_the_program_tell_a_normal_distribution_from_the_normal_of_layers() {
    let validator = jsonschema::validator_for(&schema()).unwrap();
    for permeability in [
        "{ normal = [500, 100], min = 1 }",
        "{ dip = 500, strike = 300, normal = 10 }",
        "{ dip = { normal = [500, 100], min = 1 }, strike = 300, normal = { normal = [9, 1], min = 1 } }",
    ] {
        let text = GOOD.replace("[0.5, 0.5, 0.01]", permeability);
        check(&text);
        let errors: Vec<String> = validator
            .iter_errors(&as_json(&text))
            .map(|e| e.to_string())
            .collect();
        assert!(errors.is_empty(), "{permeability}: {errors:#?}");
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
        ("color = \"#9a8f78\"", "color = \"greyish\""),
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

/// In a good file, this in the place of that, and what a validator should point at.
#[rustfmt::skip]
const POINTED: &[(&str, &str, &str, &str)] = &[
    (GOOD, "seed = 7", "seeds = 7", "/seeds"),
    (GOOD, "seed = 7", "seed = -7", "/seed"),
    (GOOD, "x = [0, 1000]", "xx = [0, 1000]", "/domain/xx"),
    (GOOD, "x = [0, 1000]", "x = [0, \"1 km\"]", "/domain/x/1"),
    (GOOD, "color = \"#9a8f78\"", "colour = \"#9a8f78\"", "/facies/mud/colour"),
    (GOOD, "color = \"#9a8f78\"", "color = \"greyish\"", "/facies/mud/color"),
    (GOOD, "color = \"#9a8f78\"", "color = 7", "/facies/mud/color"),
    (GOOD, "count = 3", "name = 7", "/feature/0/name"),
    (GOOD, "porosity = 0.08", "porosity = 8", "/facies/mud/porosity"),
    (GOOD, "[0.5, 0.5, 0.01]", "\"500 mD\"", "/facies/mud/permeability"),
    (GOOD, "[0.5, 0.5, 0.01]", "{ lognormal = [500] }", "/facies/mud/permeability/lognormal"),
    (GOOD, "[0.5, 0.5, 0.01]", "{ dip = 500, strike = 500 }", "/facies/mud/permeability"),
    (GOOD, "[0.5, 0.5, 0.01]", "{ dip = 500, strike = 500, normal = \"5 mD\" }", "/facies/mud/permeability/normal"),
    (GOOD, "[0.5, 0.5, 0.01]", "{ horizontal = 500, vertical = 5 }", "/facies/mud/permeability/vertical"),
    (GOOD, "[0.5, 0.5, 0.01]", "{ base = 5, top = 500, scale = \"ln\" }", "/facies/mud/permeability/scale"),
    (GOOD, "[0.5, 0.5, 0.01]", "{ normal = 5 }", "/facies/mud/permeability/normal"),
    (GOOD, "[0.5, 0.5, 0.01]", "{ dip = 500, strike = 500, normal = [5, 1] }", "/facies/mud/permeability/normal"),
    (GOOD, "porosity = 0.08", "net = \"yes\"", "/facies/mud/net"),
    (GOOD, "porosity = 0.08", "sw = 30", "/facies/mud/sw"),
    (GOOD, "porosity = 0.08", "porosity = [0.1, 0.1, 0.1]", "/facies/mud/porosity"),
    (GOOD, "porosity = 0.08", "density = \"2.65\"", "/facies/mud/density"),
    (GOOD, "count = 3", "properties = { porosity = 8 }", "/feature/0/properties/porosity"),
    (GOOD, "count = 3", "properties = 7", "/feature/0/properties"),
    (GOOD, "[0.5, 0.5, 0.01]", "[0.5, -0.5, 0.01]", "/facies/mud/permeability/1"),
    (GOOD, "kind = \"channel\"", "kind = \"chanel\"", "/feature/0/kind"),
    (GOOD, "width = 50", "widht = 50", "/feature/0/widht"),
    (GOOD, "width = 50", "", "/feature/0"),
    (GOOD, "kind = \"channel\"", "", "/feature/0"),
    (GOOD, "width = 50", "width = \"50 m\"", "/feature/0/width"),
    (GOOD, "width = 50", "width = {}", "/feature/0/width"),
    (GOOD, "width = 50", "width = { unifrom = [1, 2] }", "/feature/0/width/unifrom"),
    (GOOD, "width = 50", "width = { triangular = [1, 2] }", "/feature/0/width/triangular"),
    (GOOD, "width = 50", "width = { uniform = [1, 2], min = 1 }", "/feature/0/width"),
    (GOOD, "width = 50", "width = { uniform = [1, 2], normal = [1, 2] }", "/feature/0/width"),
    (GOOD, "width = 50", "width = { expression = 5 }", "/feature/0/width/expression"),
    (GOOD, "width = 50", "width = [[0, 40], [0.5, \"x\"]]", "/feature/0/width/1/1"),
    (GOOD, "width = 50", "width = [[0, 40], [1.5, 40]]", "/feature/0/width/1/0"),
    (GOOD, "count = 3", "count = 2.5", "/feature/0/count"),
    (GOOD, "count = 3", "removes = \"second\"", "/feature/0/removes"),
    (GOOD, "count = 3", "removes = [\"a\", { knid = \"channel\" }]", "/feature/0/removes/1/knid"),
    (GOOD, "count = 3", "removes = [{ level = 0 }]", "/feature/0/removes/0/level"),
    (GOOD, "count = 3", "semi_axes = [1, 2, 3]", "/feature/0/semi_axes"),
    (GOOD, "azimuth_deg = 80", "azimuth = 80", "/feature/1/trajectory/azimuth"),
    (GOOD, "kind = \"line\"", "kind = \"lime\"", "/feature/0/trajectory/kind"),
    (GOOD, "from = [0, 500]", "from = [0, 500], range = [0, 1]", "/feature/0/trajectory/range"),
    (SHOREFACE, "base = { level = -55 }", "base = -55", "/domain/base"),
    (SHOREFACE, "relation = \"onlapping\"", "parent = \"lower\"", "/feature/3/parent"),
    (SHOREFACE, "relation = \"onlapping\"", "removes = \"older\"", "/feature/3/removes"),
    (SHOREFACE, "base = { level = -55 }", "base = { lvel = -55 }", "/domain/base/lvel"),
    (SHOREFACE, "base = { level = -55 }", "base = { level = \"-55\" }", "/domain/base/level"),
    (SHOREFACE, "dip_deg = 1", "dip = 1", "/domain/top/dipping/dip"),
    (SHOREFACE, "y = [-10, 700], ", "", "/feature/0/surface/grid"),
    (SHOREFACE, "heights = [[-42", "heights = [[\"-42\"", "/feature/0/surface/grid/heights/0/0"),
    (SHOREFACE, ", tolerance = 0.1", "", "/feature/3/surface"),
    (SHOREFACE, "{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = \"lower\" }", "/feature/3/surface"),
    (SHOREFACE, "{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = 5, thickness = 5 }", "/feature/3/surface/above"),
    (SHOREFACE, "{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = \"lower\", thickness = \"5 m\" }", "/feature/3/surface/thickness"),
    (SHOREFACE, "base = { level = -55 }", "base = { level = -55 }\nleast_thickness = -1", "/domain/least_thickness"),
    (SHOREFACE, "top = \"upper\"", "top = 5", "/feature/2/top"),
    (SHOREFACE, "length = { uniform = [150, 900] }", "", "/feature/2"),
    (SHOREFACE, "\"onlapping\"", "\"conformable\"", "/feature/3/relation"),
    (SHOREFACE, "\"zigzag\"", "\"zig-zag\"", "/feature/2/interfingering"),
    (SHOREFACE, "name = \"lsf\", ", "", "/feature/2/belts/1"),
    (SHOREFACE, "width = 120", "widht = 120", "/feature/2/belts/1/widht"),
];

#[test]
fn a_validator_points_at_the_wrong_key_or_value_and_at_nothing_else() {
    // Editors underline what a validator points at.
    for &(good, find, replace, place) in POINTED {
        assert!(good.contains(find), "{find}");
        assert_eq!(
            underlined(&good.replacen(find, replace, 1)),
            [place],
            "{replace}"
        );
    }
}

#[test]
fn of_several_slips_each_has_its_own_place_in_schema_and_program_alike() {
    let expected = [
        ("/facies/mud/colour", "colour"),
        ("/facies/mud/permeability", "permeability"),
        ("/facies/mud/porosity", "porosity"),
        ("/feature/0/trajectory/amplitud", "amplitud"),
        ("/feature/0/widht", "widht"),
    ];
    assert_eq!(underlined(SLIPS), expected.map(|(place, _)| place));
    let source = Source::from_text("slips.toml", SLIPS, Format::Toml);
    let found = Model::check(&source).unwrap_err().to_json();
    let lines: Vec<u64> = found["defects"]
        .as_array()
        .unwrap()
        .iter()
        .map(|defect| defect["line"].as_u64().unwrap())
        .collect();
    for (_, key) in expected {
        let line = SLIPS.lines().position(|line| line.contains(key)).unwrap() + 1;
        assert!(lines.contains(&(line as u64)), "{key}: {found:#}");
    }
}

/// The keys of a table. Features have a key `properties` themselves: where that stands is no schema.
fn keys_of(object: &serde_json::Map<String, Value>) -> Option<&serde_json::Map<String, Value>> {
    let keys = object.get("properties")?.as_object()?;
    (!object.contains_key("id")).then_some(keys)
}

#[test]
fn every_key_of_the_schema_has_a_description() {
    fn walk(value: &Value, path: &str, bare: &mut Vec<String>) {
        match value {
            Value::Object(object) => {
                if let Some(properties) = keys_of(object) {
                    for (key, property) in properties {
                        // The keys of distributions and selectors are described by the table they stand in.
                        // What is merely allowed is described where its schema is.
                        let described =
                            property.get("description").is_some() || *property == Value::Bool(true);
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

/// The models that the reference makes of its own example and one feature of each kind.
fn one_of_each_kind() -> Vec<(String, Value)> {
    let reference = include_str!("../docs/model-file.md");
    let blocks = reference.split("```toml\n").skip(1);
    let blocks: Vec<&str> = blocks
        .map(|rest| rest.split("```").next().unwrap())
        .collect();
    let whole = blocks.iter().find(|block| block.starts_with("name"));
    let whole = whole.unwrap();
    let features = blocks
        .iter()
        .filter(|block| block.starts_with("[[feature]]"))
        .map(|block| format!("{whole}\n{block}"));
    let models: Vec<Value> = features
        .chain([(*whole).to_owned()])
        .map(|text| as_json(&text))
        .collect();
    let last = |model: &Value| model["feature"].as_array().unwrap().last().unwrap().clone();
    models
        .into_iter()
        .map(|model| {
            let kind = last(&model)["kind"].as_str().unwrap().to_owned();
            (kind, model)
        })
        .collect()
}

/// A model from JSON, without the places of its features in that text.
fn from_json(model: &Value) -> Result<Model, String> {
    from_json_in(Path::new(""), model)
}

/// A model whose files stand in a folder.
fn from_json_in(folder: &Path, model: &Value) -> Result<Model, String> {
    let source = Source::from_text("model.json", model.to_string(), Format::Json).in_folder(folder);
    let mut model = Model::check(&source).map_err(|defects| defects.to_string())?;
    for feature in &mut model.features {
        feature.place = clinothem::model::Place::default();
    }
    model.notes.clear();
    Ok(model)
}

/// The keys that a kind may have, with what the schema says of them.
fn keys_of_kind(table: &Value, kind: &str) -> Vec<(String, Value)> {
    let mut at = table;
    while at["then"]["title"] != *kind {
        at = at.get("else").unwrap_or_else(|| panic!("no kind {kind}"));
    }
    let own = at["then"]["properties"].as_object().unwrap();
    let keys = own.iter().map(|(key, schema)| match schema {
        Value::Bool(true) => (key.clone(), table["properties"][key].clone()),
        schema => (key.clone(), schema.clone()),
    });
    keys.collect()
}

/// Whether a key of a table says that it does not go together with this one.
fn excluded(keys: &[(String, Value)], table: &Value, key: &str) -> bool {
    let there = keys.iter().filter(|(other, _)| table.get(other).is_some());
    let mut words = there.filter_map(|(_, schema)| schema["description"].as_str());
    words.any(|words| {
        let rest = words.split_once("Not together with");
        rest.is_some_and(|(_, rest)| rest.contains(&format!("`{key}`")))
    })
}

/// A model, the place of a table in it, and what may stand there.
type Tried = (Value, Vec<Value>, Vec<(String, Value)>);

#[test]
fn a_default_of_the_schema_is_what_a_key_that_is_left_out_means() {
    let schema = schema();
    let table = &schema["properties"]["feature"]["items"];
    let mut tried = Vec::new();
    // Where a table stands in the model, by keys and numbers; and what may stand in it.
    let mut places: Vec<Tried> = Vec::new();
    for (kind, model) in one_of_each_kind() {
        let last = model["feature"].as_array().unwrap().len() - 1;
        let feature = vec![Value::from("feature"), Value::from(last)];
        places.push((model.clone(), feature.clone(), keys_of_kind(table, &kind)));
        if let Some(way) = model["feature"][last]["trajectory"]["kind"].as_str() {
            let keys = keys_of_kind(&table["properties"]["trajectory"], way);
            let place = [feature, vec![Value::from("trajectory")]].concat();
            places.push((model.clone(), place, keys));
        }
    }
    let model = places[0].0.clone();
    for (place, keys) in [
        (vec![], &schema["properties"]),
        (
            vec![Value::from("domain")],
            &schema["$defs"]["Domain"]["properties"],
        ),
    ] {
        let keys = keys.as_object().unwrap().clone().into_iter().collect();
        places.push((model.clone(), place, keys));
    }
    for (model, place, keys) in places {
        let without = from_json(&model).unwrap();
        for (key, schema) in keys.clone() {
            let mut with = model.clone();
            let mut at = &mut with;
            for step in &place {
                at = match step.as_u64() {
                    Some(number) => &mut at[usize::try_from(number).unwrap()],
                    None => &mut at[step.as_str().unwrap()],
                };
            }
            let Some(default) = schema.get("default") else {
                continue;
            };
            // What another key that is there excludes means something else then.
            if excluded(&keys, at, &key) {
                continue;
            }
            if at.get(&key).is_none() {
                at[&key] = default.clone();
                let with = from_json(&with);
                assert_eq!(with.as_ref(), Ok(&without), "{place:?} {key} = {default}");
                tried.push(key);
            }
        }
    }
    assert!(tried.len() > 30, "{tried:?}");
    for key in [
        "count",
        "enabled",
        "removes",
        "asymmetry",
        "exponent",
        "shape",
    ] {
        assert!(tried.contains(&key.to_owned()), "{key}: {tried:?}");
    }
}

#[test]
fn the_examples_of_the_schema_are_admitted_where_they_stand() {
    fn walk(value: &Value, found: &mut Vec<Value>) {
        match value {
            Value::Object(object) => {
                if object.get("examples").is_some_and(Value::is_array) {
                    found.push(value.clone());
                }
                object.values().for_each(|inner| walk(inner, found));
            }
            Value::Array(values) => values.iter().for_each(|inner| walk(inner, found)),
            _ => {}
        }
    }
    let schema = schema();
    let mut found = Vec::new();
    walk(&schema, &mut found);
    let mut examples = 0;
    for mut place in found {
        let here = place["examples"].take();
        place["$defs"] = schema["$defs"].clone();
        place.as_object_mut().unwrap().remove("examples");
        let validator = jsonschema::validator_for(&place).unwrap();
        for example in here.as_array().unwrap() {
            assert!(validator.is_valid(example), "{example}");
            examples += 1;
        }
    }
    assert!(examples >= 20, "{examples}");
}

#[test]
fn the_examples_of_the_schema_are_what_the_program_takes() {
    let schema = schema();
    let mut places = vec![
        ("feature.channel.width", schema["$defs"]["Profile"].clone()),
        (
            "feature.channel.removes",
            schema["$defs"]["Selector"].clone(),
        ),
        ("domain.base", schema["$defs"]["Surface"].clone()),
        (
            "feature.second.trajectory.amplitude",
            schema["$defs"]["Quantity"].clone(),
        ),
    ];
    for (place, keys) in [
        ("facies.mud", &schema["$defs"]["Facies"]["properties"]),
        (
            "feature.channel",
            &schema["properties"]["feature"]["items"]["properties"],
        ),
    ] {
        for (key, value) in keys.as_object().unwrap() {
            if value.get("examples").is_some() && ["color", "trajectory"].contains(&key.as_str()) {
                places.push((
                    Box::leak(format!("{place}.{key}").into_boxed_str()),
                    value.clone(),
                ));
            }
        }
    }
    // The file that the examples speak of: 3 × 3 depths over the same plan.
    let folder = tempfile::tempdir().unwrap();
    let grid = "-996 3 200 350\n0 400 0 700\n3 0 0 0\n0 0 0 0 0 0 0\n";
    let grid = format!("{grid}{}\n", ["30"; 9].join(" "));
    std::fs::write(folder.path().join("top.irap"), grid).unwrap();
    let mut tried = 0;
    for (place, schema) in places {
        for example in schema["examples"].as_array().unwrap() {
            // Names of features are those of another model.
            let text = example.to_string().replace("trunk", "second");
            let mut model = as_json(GOOD);
            // The examples of surfaces are as large as this, and that of a file has no coordinates in the world.
            model.as_object_mut().unwrap().remove("origin");
            model["domain"]["x"] = serde_json::json!([0, 400]);
            model["domain"]["y"] = serde_json::json!([0, 700]);
            let mut at = &mut model;
            for step in place.split('.') {
                at = match at {
                    Value::Array(list) => list.iter_mut().find(|one| one["id"] == step).unwrap(),
                    other => &mut other[step],
                };
            }
            *at = serde_json::from_str(&text).unwrap();
            let taken = from_json_in(folder.path(), &model).err();
            assert_eq!(taken, None, "{place} = {example}");
            tried += 1;
        }
    }
    assert!(tried >= 20, "{tried}");
}
