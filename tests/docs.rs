//! The tables of keys in `docs/model-file.md` say what the schema says.
//!
//! A table follows a line `<!-- keys of PLACE -->`; what it should be is printed where it is not.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::fmt::Write as _;

use clinothem::model::schema;
use serde_json::{Map, Value};

const DOCS: &str = include_str!("../docs/model-file.md");
const MARK: &str = "<!-- keys of ";

/// A table's keys, with those that must be there.
struct Keys {
    properties: Map<String, Value>,
    required: Vec<String>,
}

impl Keys {
    fn of(table: &Value) -> Self {
        // What is missing is asked for where all keys are known ones.
        let demands = table
            .get("required")
            .or_else(|| table["then"].get("required"));
        let required = demands
            .and_then(Value::as_array)
            .cloned()
            .unwrap_or_default();
        Self {
            properties: table["properties"].as_object().cloned().unwrap_or_default(),
            required: required
                .iter()
                .map(|key| key.as_str().unwrap().to_owned())
                .collect(),
        }
    }

    /// Required ones first.
    fn table(&self) -> String {
        let mut text = "| key | | type | meaning |\n|---|---|---|---|\n".to_owned();
        for is_required in [true, false] {
            for (key, value) in &self.properties {
                if self.required.contains(key) != is_required {
                    continue;
                }
                let need = if is_required { "required" } else { "" };
                // Each kind has a chapter of its own.
                let meaning = match key.as_str() {
                    "kind" => "What it is.".to_owned(),
                    _ => value["description"].as_str().expect(key).replace('\n', " "),
                };
                writeln!(
                    text,
                    "| `{key}` | {need} | {} | {meaning} |",
                    kind_of(value)
                )
                .unwrap();
            }
        }
        text
    }
}

/// What a key's value is, in words.
fn kind_of(value: &Value) -> String {
    if let Some(reference) = value.get("$ref").and_then(Value::as_str) {
        return match reference.rsplit('/').next().unwrap() {
            "Quantity" => "quantity".to_owned(),
            "Ends" => "one or two quantities".to_owned(),
            "Profile" | "BentProfile" => "profile".to_owned(),
            "Selector" => "word or list".to_owned(),
            "Surface" => "surface".to_owned(),
            _ => "table".to_owned(),
        };
    }
    if let Some(words) = value.get("enum").and_then(Value::as_array) {
        let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        return words.join(" or ");
    }
    let range = match (value.get("minimum"), value.get("maximum")) {
        (Some(low), Some(high)) => format!(", {low} to {high}"),
        (Some(low), None) => format!(", {low} or more"),
        _ => String::new(),
    };
    match &value["type"] {
        Value::String(name) => match name.as_str() {
            "string" => "text".to_owned(),
            "boolean" => "true or false".to_owned(),
            "integer" => format!("whole number{range}"),
            "number" => format!("number{range}"),
            "array" => list_of(value),
            _ => "table".to_owned(),
        },
        Value::Array(names) if names.iter().any(|name| name == "array") => match &names[0] {
            Value::String(name) if name == "number" => "number or list".to_owned(),
            Value::String(name) if name == "array" && names[1] == "object" => {
                "list or table".to_owned()
            }
            _ => "list".to_owned(),
        },
        Value::Array(names) if names.iter().any(|name| name == "number") => {
            "number, or three".to_owned()
        }
        Value::Array(_) => "list".to_owned(),
        _ => "table".to_owned(),
    }
}

fn list_of(value: &Value) -> String {
    let many = match value.get("minItems").and_then(Value::as_u64) {
        Some(least) if value.get("maxItems").and_then(Value::as_u64) == Some(least) => {
            ["no", "one", "two", "three"][usize::try_from(least).unwrap()]
        }
        _ => "list of",
    };
    match kind_of(&value["items"]).as_str() {
        "quantity" => format!("{many} quantities"),
        "number" => format!("{many} numbers"),
        "text" => format!("{many} names"),
        "list of numbers" | "two numbers" | "three numbers" | "list of lists" => {
            "list of lists".to_owned()
        }
        _ => "list of tables".to_owned(),
    }
}

/// The keys that a kind of feature has besides those that all have.
fn of_kind(schema: &Value, kind: &str, common: &Keys) -> Option<Keys> {
    let table = &schema["properties"]["feature"]["items"];
    let mut at = table;
    while at["then"]["title"] != kind {
        at = at.get("else")?;
    }
    let mut own = Keys::of(&at["then"]);
    own.properties
        .retain(|key, _| !common.properties.contains_key(key));
    for (key, value) in &mut own.properties {
        if *value != Value::Bool(true) {
            continue;
        }
        // A key that several kinds have says of each what it means there.
        value.clone_from(&table["properties"][key]);
        let words = value["description"].as_str().unwrap().to_owned();
        let start = format!("{kind}: ");
        if let Some(own) = words.lines().find_map(|line| line.strip_prefix(&start)) {
            value["description"] = own.into();
        }
    }
    Some(own)
}

/// The keys of a place in the docs.
fn keys_of(schema: &Value, place: &str) -> Keys {
    let defined = |name: &str| Keys::of(&schema["$defs"][name]);
    let common = || {
        let table = &schema["properties"]["feature"]["items"];
        let channel = Keys::of(&table["then"]);
        let ids = [
            "id",
            "kind",
            "name",
            "enabled",
            "count",
            "level",
            "parent",
            "along",
            "facies",
            "properties",
        ];
        let rules = ["conform", "removes", "removed_by", "preserve"];
        let keys = ids.into_iter().chain(rules);
        Keys {
            properties: keys
                .map(|key| (key.to_owned(), table["properties"][key].clone()))
                .collect(),
            required: channel
                .required
                .into_iter()
                .filter(|key| ids.contains(&key.as_str()))
                .collect(),
        }
    };
    match place {
        "a belt" => defined("Belt"),
        "a conform" => defined("Conform"),
        "a drape" => defined("Drape"),
        "a join" => defined("Join"),
        "a net" => defined("Net"),
        "a section" => defined("Section"),
        "a junction" => defined("Joins"),
        "a surface" => defined("Surface"),
        "a well" => defined("Well"),
        "a lateral" => defined("Lateral"),
        "a station" => defined("Station"),
        "a file of stations" => defined("SurveyFile"),
        "a feature" => common(),
        kind => of_kind(schema, kind, &common()).unwrap_or_else(|| panic!("no place {kind}")),
    }
}

/// The places of the docs with a table of keys, and those tables.
fn tables() -> Vec<(&'static str, String)> {
    let marks = DOCS
        .match_indices(MARK)
        .map(|(at, _)| &DOCS[at + MARK.len()..]);
    marks
        .map(|rest| {
            let (place, rest) = rest.split_once(" -->\n").unwrap();
            let lines = rest.lines().take_while(|line| line.starts_with('|'));
            (place, lines.flat_map(|line| [line, "\n"]).collect())
        })
        .collect()
}

#[test]
fn the_docs_tables_of_keys_are_those_of_the_schema() {
    let schema = schema();
    let differing = tables().into_iter().filter_map(|(place, found)| {
        let expected = keys_of(&schema, place).table();
        (found != expected).then(|| format!("{MARK}{place} -->\n{expected}"))
    });
    let differing: Vec<String> = differing.collect();
    assert!(
        differing.is_empty(),
        "these tables should be\n\n{}",
        differing.join("\n")
    );
}

#[test]
fn every_kind_has_its_table_in_the_docs() {
    let schema = schema();
    let kinds = schema["properties"]["feature"]["items"]["properties"]["kind"]["enum"].clone();
    let places: Vec<&str> = tables().iter().map(|table| table.0).collect();
    for kind in kinds.as_array().unwrap() {
        assert!(
            places.contains(&kind.as_str().unwrap()),
            "no table of {kind}"
        );
    }
    assert!(places.contains(&"a belt") && places.contains(&"a feature"));
}
