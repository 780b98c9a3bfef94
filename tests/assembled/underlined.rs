//! What editors underline in a model file by the published schema; no model is made.

use clinothem::model::schema;

/// Where a validator says that a text is wrong, each place once.
pub(crate) fn underlined(text: &str) -> Vec<String> {
    let model: toml::Value = toml::from_str(text).unwrap();
    let validator = jsonschema::validator_for(&schema()).unwrap();
    let mut places: Vec<String> = validator
        .iter_errors(&serde_json::to_value(model).unwrap())
        .map(|error| error.instance_path().to_string())
        .collect();
    places.sort();
    places.dedup();
    places
}
