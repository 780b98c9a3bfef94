//! What the schemas of several tables have in common: forms that exclude each other, and tables whose `kind` says what they are.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use super::read::Field;

impl<T: JsonSchema> JsonSchema for Field<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

/// A table that has exactly one of several forms: each a key that tells it, and the keys that go with that one.
pub(crate) fn forms(
    description: &str,
    properties: &Map<String, Value>,
    forms: &[(&str, &[&str])],
) -> Map<String, Value> {
    let telling = forms.iter().map(|(key, _)| json!({ "required": [key] }));
    let mut table = object(json!({
        "description": description,
        "properties": properties,
        "additionalProperties": false,
        "oneOf": telling.collect::<Vec<_>>(),
    }));
    let mut together = Map::new();
    for (key, others) in forms.iter().filter(|(_, others)| !others.is_empty()) {
        together.insert((*key).to_owned(), json!(others));
        together.extend(
            others
                .iter()
                .map(|other| ((*other).to_owned(), json!([key]))),
        );
    }
    if !together.is_empty() {
        table.insert("dependentRequired".to_owned(), Value::Object(together));
    }
    table
}

/// The keys of a table's value.
pub(crate) fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(keys) => keys,
        _ => Map::new(),
    }
}

/// A table whose `kind` says which keys it has besides those that all have.
///
/// The keys' schemas stand in the table itself, where editors look for what to complete; what is to be there, and what not,
/// depends on the kind. A key that two kinds mean differently has its schema with the kind.
pub(crate) fn by_kind(common: &Schema, kinds: &[(&str, Schema)]) -> Schema {
    by_kind_but(common, kinds, &|_| Vec::new())
}

/// The same of kinds that have not all of the common keys: those are said for each.
pub(crate) fn by_kind_but(
    common: &Schema,
    kinds: &[(&str, Schema)],
    lacking: &dyn Fn(&str) -> Vec<&'static str>,
) -> Schema {
    let mut properties = keys(common);
    for (_, part) in kinds {
        for key in keys(part).keys() {
            properties.insert(key.clone(), shared(key, kinds).0);
        }
    }
    let about = kinds
        .iter()
        .map(|(kind, part)| format!("{kind}: {}", description(part)));
    let kind = json!({
        "description": about.collect::<Vec<_>>().join("\n"),
        "enum": kinds.iter().map(|(kind, _)| *kind).collect::<Vec<_>>(),
    });
    properties.insert("kind".to_owned(), kind);
    let mut table = Map::new();
    for (kind, part) in kinds.iter().rev() {
        let lacking = lacking(kind);
        let common_keys = keys(common).into_iter();
        let common_keys = common_keys.filter(|(key, _)| !lacking.contains(&key.as_str()));
        let allowed = common_keys.chain(keys(part));
        let allowed = allowed.map(|(key, schema)| {
            let has_it_here = keys(part).contains_key(&key) && !shared(&key, kinds).1;
            (
                key,
                if has_it_here {
                    schema
                } else {
                    Value::Bool(true)
                },
            )
        });
        let required: Vec<Value> = [common, part]
            .iter()
            .filter_map(|part| part.get("required")?.as_array().cloned())
            .flatten()
            .filter(|key| key.as_str().is_none_or(|key| !lacking.contains(&key)))
            .collect();
        let rest = std::mem::take(&mut table);
        table = object(json!({
            "if": { "properties": { "kind": { "const": kind } }, "required": ["kind"] },
            "then": {
                "title": kind,
                "properties": allowed.collect::<Map<_, _>>(),
                "required": required,
                "additionalProperties": false,
            },
            "else": rest,
        }));
    }
    table.extend(object(json!({
        "type": "object",
        "properties": properties,
        "required": ["kind"],
    })));
    table.into()
}

/// A table as above, or another one without a `kind`: that which has this key.
pub(crate) fn or_form(by_kind: Schema, key: &str, form: &Schema) -> Schema {
    let mut table = object(by_kind.to_value());
    let own = keys(form);
    let mut properties = table.remove("properties").map_or_else(Map::new, object);
    let allowed: Map<String, Value> = own
        .keys()
        .map(|key| (key.clone(), Value::Bool(true)))
        .collect();
    properties.extend(own);
    let rest = ["if", "then", "else", "required"]
        .into_iter()
        .filter_map(|word| Some((word.to_owned(), table.remove(word)?)));
    let rest: Map<String, Value> = rest.collect();
    table.extend(object(json!({
        "properties": properties,
        "if": { "required": [key] },
        "then": { "title": key, "properties": allowed, "additionalProperties": false },
        "else": rest,
    })));
    table.into()
}

/// Tables as above, or such as have no kind and what else they need from another one, which `like` names.
pub(crate) fn or_like(by_kind: Schema) -> Schema {
    let allowed: Map<String, Value> = keys(&by_kind)
        .into_iter()
        .map(|(key, _)| (key, Value::Bool(true)))
        .collect();
    let mut table = object(by_kind.to_value());
    let like = json!({
        "if": { "required": ["like"] },
        "then": { "properties": allowed, "required": ["id"], "additionalProperties": false },
        "else": { "required": ["kind"] },
    });
    table.remove("required");
    last_else(&mut table, like);
    table.into()
}

/// Puts a schema where all alternatives of a table end.
fn last_else(table: &mut Map<String, Value>, last: Value) {
    match table.get_mut("else") {
        Some(Value::Object(next)) if next.contains_key("if") => last_else(next, last),
        _ => {
            table.insert("else".to_owned(), last);
        }
    }
}

/// A key's schema if all kinds that have it mean the same, or no more than what each says of it; and whether they do.
fn shared(key: &str, kinds: &[(&str, Schema)]) -> (Value, bool) {
    let having: Vec<(&str, Map<String, Value>, String)> = kinds
        .iter()
        .filter_map(|(kind, part)| {
            let mut schema = object(keys(part).remove(key)?);
            let words = schema.remove("description").unwrap_or_default();
            Some((*kind, schema, words.as_str().unwrap_or_default().to_owned()))
        })
        .collect();
    let same = having.windows(2).all(|pair| pair[0].1 == pair[1].1);
    let words: Vec<String> = match having.as_slice() {
        [(_, _, words)] => vec![words.clone()],
        several => several
            .iter()
            .map(|(kind, _, words)| format!("{kind}: {words}"))
            .collect(),
    };
    let mut shown = match having.into_iter().next() {
        Some((_, schema, _)) if same => schema,
        _ => Map::new(),
    };
    shown.insert("description".to_owned(), json!(words.join("\n")));
    (Value::Object(shown), same)
}

/// The keys of a struct's table.
fn keys(schema: &Schema) -> Map<String, Value> {
    schema
        .get("properties")
        .cloned()
        .map_or_else(Map::new, object)
}

fn description(schema: &Schema) -> String {
    let text = schema.get("description").and_then(Value::as_str);
    text.unwrap_or_default().to_owned()
}
