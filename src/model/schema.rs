//! The JSON Schema of the model file, for editors: completion, descriptions and most checks while typing.
//!
//! A value that may have several shapes has the keywords of all of them side by side: each speaks of its own type only
//! (`properties` of tables, `items` of lists). `anyOf` and `oneOf` over tables would do, too, but of what fits none of them
//! a validator can only say so of the whole table, and editors underline a whole feature for one wrong key. For the same
//! reason an unknown key is refused at its own place, and what is missing is said of tables without unknown keys: where a
//! key is misspelt, it is the misspelling that is wrong.
//!
//! What a key is if it is left out stands in its description, for people. Editors offer it from there: so there is one place for
//! it, and a test builds models with and without.

use serde_json::{Map, Value, json};

use super::file::ModelFile;

/// The JSON Schema (2020-12) of the model file.
pub fn schema() -> Value {
    let mut schema = schemars::schema_for!(ModelFile).to_value();
    forbid_null(&mut schema);
    state_defaults(&mut schema);
    point_at_keys(&mut schema);
    schema
}

/// Makes closed tables refuse an unknown key at the key, and ask for what is missing only without such keys.
fn point_at_keys(value: &mut Value) {
    match value {
        Value::Object(object) => {
            object.values_mut().for_each(point_at_keys);
            if object.get("additionalProperties") != Some(&Value::Bool(false)) {
                return;
            }
            let words = "no such key here";
            // The title shows in what validators print of `not`; `errorMessage` is what VS Code says instead.
            let nothing = json!({ "not": { "title": words }, "errorMessage": words });
            object.insert("additionalProperties".to_owned(), nothing);
            let keys = object.get("properties").and_then(Value::as_object);
            let known: Vec<&String> = keys.map(|keys| keys.keys().collect()).unwrap_or_default();
            let known = json!({ "type": "object", "propertyNames": { "enum": known } });
            let demands: Map<String, Value> = ["required", "oneOf", "dependentRequired"]
                .into_iter()
                .filter_map(|demand| Some((demand.to_owned(), object.remove(demand)?)))
                .collect();
            if !demands.is_empty() {
                object.insert("if".to_owned(), known);
                object.insert("then".to_owned(), Value::Object(demands));
            }
        }
        Value::Array(values) => values.iter_mut().for_each(point_at_keys),
        _ => {}
    }
}

/// States the default of each key whose description says one.
fn state_defaults(value: &mut Value) {
    match value {
        Value::Object(object) => {
            if let Some(Value::Object(keys)) = object.get_mut("properties") {
                for key in keys.values_mut().filter_map(Value::as_object_mut) {
                    let words = key.get("description").and_then(Value::as_str);
                    if let Some(default) = words.and_then(default_in) {
                        key.insert("default".to_owned(), default);
                    }
                }
            }
            object.values_mut().for_each(state_defaults);
        }
        Value::Array(values) => values.iter_mut().for_each(state_defaults),
        _ => {}
    }
}

/// The value that a description says a key has if it is left out: `…; 15 if left out`, or `"older" (the default)`. Of a key that
/// kinds describe one by one, all must say the same.
fn default_in(words: &str) -> Option<Value> {
    let mut lines = words.lines().map(|line| {
        if let Some((before, _)) = line.split_once("\" (the default)") {
            let word = before.rsplit('"').next()?;
            return Some(json!(word));
        }
        let (before, _) = line.split_once(" if left out")?;
        let clause = before.rsplit("; ").next()?;
        let value = clause.split(" (").next()?;
        serde_json::from_str(value).ok()
    });
    let first = lines.next()??;
    lines
        .all(|other| other.as_ref() == Some(&first))
        .then_some(first)
}

/// An absent key is left out, never null: drops the null that schemars allows for every optional key.
fn forbid_null(value: &mut Value) {
    match value {
        Value::Object(object) => {
            if object.get("default") == Some(&Value::Null) {
                object.remove("default");
            }
            if let Some(Value::Array(types)) = object.get_mut("type") {
                types.retain(|name| name != "null");
                if let [only] = types.as_slice() {
                    let only = only.clone();
                    object.insert("type".to_owned(), only);
                }
            }
            if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
                choices.retain(|choice| choice != &json!({ "type": "null" }));
                if let [Value::Object(only)] = choices.as_slice() {
                    let only = only.clone();
                    object.remove("anyOf");
                    object.extend(only);
                }
            }
            object.values_mut().for_each(forbid_null);
        }
        Value::Array(values) => values.iter_mut().for_each(forbid_null),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::default_in;
    use serde_json::json;

    #[test]
    fn defaults_are_what_the_words_say_and_nothing_else() {
        for (words, default) in [
            ("Degrees; 15 if left out.", Some(json!(15))),
            (
                "True or false; true if left out. False leaves it out.",
                Some(json!(true)),
            ),
            (
                "Semi-extents; [3000, 6000] if left out.",
                Some(json!([3000, 6000])),
            ),
            ("Bars; 0 (they only grow) if left out.", Some(json!(0))),
            (
                "How: \"straight\" (the default) or \"bent\".",
                Some(json!("straight")),
            ),
            ("Width; right across the domain if left out.", None),
            ("Degree, 1 (straight) to 3 (the default).", None),
            ("if left out, 0 between level bounds", None),
            ("Length in metres.", None),
            ("a: m; 1 if left out.\nb: m; 1 if left out.", Some(json!(1))),
            ("a: m; 1 if left out.\nb: m; 2 if left out.", None),
            ("a: m; 1 if left out.\nb: m.", None),
        ] {
            assert_eq!(default_in(words), default, "{words}");
        }
    }
}
