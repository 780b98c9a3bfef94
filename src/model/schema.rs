//! The JSON Schema of the model file, for editors: completion, descriptions and most checks while typing.
//!
//! A value that may have several shapes has the keywords of all of them side by side: each speaks of its own type only
//! (`properties` of tables, `items` of lists). `anyOf` and `oneOf` over tables would do, too, but of what fits none of them
//! a validator can only say so of the whole table, and editors underline a whole feature for one wrong key. For the same
//! reason an unknown key is refused at its own place, and what is missing is said of tables without unknown keys: where a
//! key is misspelt, it is the misspelling that is wrong.

use serde_json::{Map, Value, json};

use super::file::ModelFile;

/// The JSON Schema (2020-12) of the model file.
pub fn schema() -> Value {
    let mut schema = schemars::schema_for!(ModelFile).to_value();
    forbid_null(&mut schema);
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
