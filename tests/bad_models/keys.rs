//! Every key that the schema knows, with values that it cannot have: each is refused by its name and at its place.
//!
//! The values go into models that together have every key, so that a new one is asked for here: dates and numbers that are none fit nowhere;
//! texts, lists, tables and huge numbers fit some keys, and must then be no trouble.

use std::collections::{BTreeMap, BTreeSet};

use clinothem::model::{Defect, Defects, Format, Model, Source, schema};
use serde_json::Value as Json;
use toml::{Table, Value};

use super::likes::LIKE;
use super::{BODY, NODULE, SHOREFACE, TOML};

/// Models that together have every key.
const GOOD: [(&str, &str); 22] = [
    ("good.toml", TOML),
    ("body.toml", BODY),
    ("nodule.toml", NODULE),
    ("shoreface.toml", SHOREFACE),
    ("bar.toml", include_str!("bar.toml")),
    ("belt.toml", include_str!("belt.toml")),
    ("clinoform.toml", include_str!("clinoform.toml")),
    ("fault.toml", include_str!("fault.toml")),
    ("folded_beds.toml", include_str!("folded_beds.toml")),
    ("full.toml", include_str!("full.toml")),
    ("kinds.toml", include_str!("kinds.toml")),
    ("lag.toml", include_str!("lag.toml")),
    ("levee.toml", include_str!("levee.toml")),
    ("like.toml", LIKE),
    ("nets.toml", include_str!("nets.toml")),
    ("plug.toml", include_str!("plug.toml")),
    ("reference.toml", include_str!("reference.toml")),
    ("section.toml", include_str!("section.toml")),
    ("trend.toml", include_str!("trend.toml")),
    ("well.toml", include_str!("well.toml")),
    ("rock.toml", include_str!("../../models/rock/rock.toml")),
    (
        "bounds.toml",
        include_str!("../../models/strata/bounds.toml"),
    ),
];

/// What fits no key at all.
const WRONG: [&str; 2] = ["1979-05-27", "nan"];
/// What fits some.
const ODD: [&str; 7] = [
    "\"?!\"",
    "\"\"",
    "[]",
    "{}",
    "{ \"?!\" = 1 }",
    "-1e300",
    "1e300",
];
/// Keys of all features, or of most, each read in one place.
const COMMON: [&str; 15] = [
    "along",
    "conform",
    "count",
    "enabled",
    "facies",
    "id",
    "kind",
    "level",
    "like",
    "name",
    "parent",
    "preserve",
    "properties",
    "removed_by",
    "removes",
];
/// Stands for the value while a model becomes text.
const HERE: &str = "here stands what is wrong";

/// A step into a table or a list.
#[derive(Clone, Debug)]
enum Step {
    Key(String),
    At(usize),
}

/// All places of values below one; of lists of numbers, points and the like the first entry alone.
fn places(value: &Value, path: &mut Vec<Step>, found: &mut Vec<Vec<Step>>) {
    if !path.is_empty() {
        found.push(path.clone());
    }
    let mut below = |step: Step, value: &Value| {
        path.push(step);
        places(value, path, found);
        path.pop();
    };
    match value {
        Value::Table(table) => {
            for (key, value) in table {
                below(Step::Key(key.clone()), value);
            }
        }
        Value::Array(list) => {
            let all = if list.iter().all(Value::is_table) {
                list.len()
            } else {
                1
            };
            for (at, value) in list.iter().enumerate().take(all) {
                below(Step::At(at), value);
            }
        }
        _ => {}
    }
}

/// The same model with the mark at a place; the key is put there if it is not.
fn marked(model: &Table, path: &[Step]) -> Table {
    let mut model = Value::Table(model.clone());
    let mut at = &mut model;
    for step in path {
        at = match step {
            Step::Key(key) => {
                let table = at.as_table_mut().unwrap();
                let none = Value::Boolean(false);
                table.entry(key.clone()).or_insert(none)
            }
            Step::At(index) => &mut at.as_array_mut().unwrap()[*index],
        };
    }
    *at = Value::String(HERE.to_owned());
    let Value::Table(model) = model else {
        unreachable!("a table")
    };
    model
}

/// A model as text: a line for each key of the model and of each feature.
fn written(model: &Table) -> String {
    let line = |(key, value): (&String, &Value)| format!("{key} = {value}\n");
    let is_list = |value: &Value| value.as_array().is_some();
    let features = model.get("feature").filter(|value| is_list(value));
    let own = model
        .iter()
        .filter(|(key, _)| *key != "feature" || features.is_none());
    let mut text: String = own.map(line).collect();
    for feature in features.and_then(Value::as_array).into_iter().flatten() {
        match feature {
            Value::Table(table) => {
                text.push_str("[[feature]]\n");
                text.extend(table.iter().map(line));
            }
            // A feature that is none.
            _ => return model.iter().map(line).collect(),
        }
    }
    text
}

/// What is said of a model with this at a place, which is where the text has the mark; nothing if it is admitted.
fn said(model: &Table, path: &[Step], wrong: &str) -> (Option<Defects>, (usize, usize)) {
    let text = written(&marked(model, path));
    let quoted = format!("{HERE:?}");
    let (before, _) = text.split_once(&quoted).unwrap();
    let line = before.rsplit('\n').next().unwrap();
    let place = (before.matches('\n').count() + 1, line.chars().count() + 1);
    let text = text.replace(&quoted, wrong);
    let source = Source::from_text("keys.toml", text, Format::Toml);
    (Model::check(&source).err(), place)
}

/// The key that a place belongs to.
fn key_of(path: &[Step]) -> &str {
    let keys = path.iter().rev().filter_map(|step| match step {
        Step::Key(key) => Some(key.as_str()),
        Step::At(_) => None,
    });
    keys.into_iter().next().unwrap()
}

/// Whether a word stands in a text by itself.
fn names(text: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + word.len()..].chars().next();
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}

/// What is wrong with how something wrong was told, if anything.
fn fault(model: &Table, path: &[Step], wrong: &str) -> Option<String> {
    let (defects, place) = said(model, path, wrong);
    let Some(defects) = defects else {
        return Some("admitted".to_owned());
    };
    // The value, or, of a key that is unknown with such a value, the key: the text has ` = ` between.
    let key = key_of(path);
    let of_key = (place.0, place.1.saturating_sub(key.chars().count() + 3));
    let at_place = |defect: &&Defect| {
        let at = (defect.place().line, defect.place().column);
        at == place || at == of_key
    };
    let Some(defect) = defects.iter().find(at_place) else {
        return Some(format!("not told at {place:?}: {defects}"));
    };
    let words = format!("{}\n{}", defect.message(), defect.remedy());
    // A point is one of `points`.
    if !names(&words, key) && !names(&words, key.trim_end_matches('s')) {
        return Some(format!("does not name the key: {words}"));
    }
    (defect.remedy().trim().is_empty()).then(|| format!("no remedy: {words}"))
}

fn models() -> impl Iterator<Item = (&'static str, Table)> {
    GOOD.iter()
        .map(|(name, text)| (*name, toml::from_str(text).unwrap()))
}

#[test]
fn what_fits_nowhere_is_refused_at_every_place_by_its_key() {
    let mut faults = Vec::new();
    let mut count = 0;
    for (name, model) in models() {
        let mut found = Vec::new();
        places(&Value::Table(model.clone()), &mut Vec::new(), &mut found);
        for path in found {
            for wrong in WRONG {
                count += 1;
                if let Some(fault) = fault(&model, &path, wrong) {
                    faults.push(format!("{name} {path:?} = {wrong}: {fault}"));
                }
            }
        }
    }
    assert!(count > 1000, "{count}");
    assert!(
        faults.is_empty(),
        "{} of {count}:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

#[test]
fn what_fits_some_places_is_told_where_it_stands_or_admitted() {
    let mut faults = Vec::new();
    for (name, model) in models() {
        let mut found = Vec::new();
        places(&Value::Table(model.clone()), &mut Vec::new(), &mut found);
        for path in found {
            for odd in ODD {
                let (Some(defects), place) = said(&model, &path, odd) else {
                    continue;
                };
                // An id that is none is told with what refers to it; something may be missing in a table.
                let mut places = defects.iter().map(|defect| defect.place().line);
                if !places.any(|line| line == place.0) && !is_named(&path) {
                    faults.push(format!("{name} {path:?} = {odd}: {defects}"));
                }
            }
        }
    }
    assert!(
        faults.is_empty(),
        "{}:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

/// Whether others may refer to what stands there.
fn is_named(path: &[Step]) -> bool {
    matches!(key_of(path), "facies" | "feature" | "id" | "kind")
}

#[test]
fn no_number_of_a_feature_or_the_domain_may_be_huge() {
    // Rock properties may have any unit, and weights count against each other.
    const FREE: [&str; 3] = ["facies", "properties", "weights"];
    let mut faults = Vec::new();
    for (name, model) in models() {
        let mut found = Vec::new();
        places(&Value::Table(model.clone()), &mut Vec::new(), &mut found);
        for path in found {
            let is_free =
                |step: &Step| matches!(step, Step::Key(key) if FREE.contains(&key.as_str()));
            let is_of_domain = matches!(&path[0], Step::Key(key) if key == "domain");
            let is_of_feature = matches!(&path[0], Step::Key(key) if key == "feature");
            if path.iter().any(is_free) || !(is_of_domain || is_of_feature) {
                continue;
            }
            let whole = Value::Table(model.clone());
            let value = path.iter().fold(&whole, |at, step| match step {
                Step::Key(key) => &at[key.as_str()],
                Step::At(index) => &at[*index],
            });
            if !(value.is_integer() || value.is_float()) {
                continue;
            }
            for huge in ["-1e300", "1e300"] {
                if said(&model, &path, huge).0.is_none() {
                    faults.push(format!("{name} {path:?} = {huge}"));
                }
            }
        }
    }
    assert!(
        faults.is_empty(),
        "{}:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

/// The kinds, with the keys that the schema admits for each.
fn keys_by_kind() -> BTreeMap<String, Vec<String>> {
    let schema = schema();
    let mut at = &schema["properties"]["feature"]["items"];
    let mut kinds = BTreeMap::new();
    while let Some(kind) = at["then"]["title"].as_str() {
        let keys = at["then"]["properties"].as_object().unwrap();
        kinds.insert(kind.to_owned(), keys.keys().cloned().collect());
        at = &at["else"];
    }
    // A solid is broken beside its file.
    assert!(kinds.remove("solid").is_some());
    kinds
}

#[test]
fn every_key_of_every_kind_is_refused_by_its_name() {
    let mut faults = Vec::new();
    for (kind, keys) in keys_by_kind() {
        let of_kind: Vec<(Table, usize)> = models()
            .flat_map(|(_, model)| {
                let features = model["feature"].as_array().unwrap();
                let is_it =
                    |at: &usize| features[*at].get("kind").and_then(Value::as_str) == Some(&kind);
                let places: Vec<usize> = (0..features.len()).filter(is_it).collect();
                places.into_iter().map(move |at| (model.clone(), at))
            })
            .collect();
        for key in keys {
            // One that has the key, or any: it may be one that the kind has not.
            let has_it = |one: &&(Table, usize)| one.0["feature"][one.1].get(&key).is_some();
            let found = of_kind.iter().find(has_it).or(of_kind.first());
            let (model, at) = found.unwrap_or_else(|| panic!("no good model has a {kind}"));
            let path = [
                Step::Key("feature".to_owned()),
                Step::At(*at),
                Step::Key(key),
            ];
            for wrong in WRONG {
                if let Some(fault) = fault(model, &path, wrong) {
                    faults.push(format!("{kind} {} = {wrong}: {fault}", key_of(&path)));
                }
            }
        }
    }
    assert!(
        faults.is_empty(),
        "{}:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

/// The keys of all tables in a schema.
fn keys_in(schema: &Json, found: &mut BTreeSet<String>) {
    match schema {
        Json::Object(object) => {
            if let Some(Json::Object(keys)) = object.get("properties") {
                found.extend(keys.keys().cloned());
            }
            for value in object.values() {
                keys_in(value, found);
            }
        }
        Json::Array(list) => list.iter().for_each(|value| keys_in(value, found)),
        _ => {}
    }
}

#[test]
fn every_key_of_the_schema_is_in_a_good_model_and_so_in_broken_ones() {
    let mut known = BTreeSet::new();
    keys_in(&schema(), &mut known);
    // Of editors' files alone, and what another table is found by.
    known.remove("$schema");
    known.remove("$ref");
    // What goes with a file of heights is broken beside such a file.
    for key in super::data::KEYS_OF_FILES
        .iter()
        .chain(super::wells::KEYS_OF_FILES)
        .chain(super::solids::KEYS_OF_SOLIDS)
    {
        assert!(known.remove(*key), "{key}");
    }
    let mut tried = BTreeSet::new();
    let mut by_kind: BTreeSet<(String, String)> = BTreeSet::new();
    for (_, model) in models() {
        let mut found = Vec::new();
        places(&Value::Table(model.clone()), &mut Vec::new(), &mut found);
        tried.extend(found.iter().map(|path| key_of(path).to_owned()));
        for feature in model["feature"].as_array().unwrap() {
            // What is like another feature has that one's kind.
            let Some(kind) = feature.get("kind").and_then(Value::as_str) else {
                continue;
            };
            let keys = feature.as_table().unwrap().keys();
            by_kind.extend(keys.map(|key| (kind.to_owned(), key.clone())));
        }
    }
    let missing: Vec<&String> = known.difference(&tried).collect();
    assert!(missing.is_empty(), "in no good model: {missing:?}");
    // Those that kinds have besides what all features have.
    let common = |key: &String| COMMON.contains(&key.as_str());
    for (kind, keys) in keys_by_kind() {
        for key in keys.iter().filter(|key| !common(key)) {
            let is_given = by_kind.contains(&(kind.clone(), key.clone()));
            assert!(is_given, "no good model has the {key} of a {kind}");
        }
    }
}
