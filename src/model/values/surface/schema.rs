//! What editors are told of surfaces.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use super::{DippingFile, GridFile, HorizonSurface};
use crate::data::Format;
use crate::model::tables::{forms, object};
use crate::model::values::nets::NetFile;
use crate::model::values::quantity::Quantity;

impl JsonSchema for HorizonSurface {
    fn schema_name() -> Cow<'static, str> {
        "Surface".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        surface(generator, Map::new())
    }
}

/// A horizon's surface: as that of the domain's base and top, or by its thickness above another horizon.
pub(crate) fn horizon_surface(generator: &mut SchemaGenerator) -> Schema {
    let number = generator.subschema_for::<Quantity>();
    let mut keys = heights(
        generator,
        [
            "Thicknesses at the nodes of a regular grid.",
            "Scattered points [x, y, thickness]",
        ],
    );
    // A thickness points nowhere.
    keys.extend(of_file().into_iter().filter(|(key, _)| key != "positive"));
    let mut thickness = forms(
        "How far above it: a number, a grid of thicknesses, scattered points [x, y, thickness], or a file of thicknesses; in metres, not below 0.",
        &keys,
        &[("grid", &[]), ("points", &[]), ("file", &[])],
    );
    thickness.insert("type".to_owned(), json!("object"));
    go_with_file(&mut thickness, &["points", "file"]);
    let description = thickness.remove("description");
    let thickness = json!({ "description": description, "anyOf": [number, thickness] });
    let above = json!({ "description": "The id of an older horizon above which it lies.", "type": "string" });
    surface(
        generator,
        object(json!({ "above": above, "thickness": thickness })),
    )
}

/// The keys of measured heights, or of what is like them.
fn heights(generator: &mut SchemaGenerator, [grid, points]: [&str; 2]) -> Map<String, Value> {
    let grid = about(grid, generator.subschema_for::<GridFile>());
    let points = json!({
        "description": format!("{points}, at least three, not on one line in plan."),
        "type": "array",
        "items": { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
        "minItems": 3,
    });
    let tolerance = json!({
        "description": "How far the surface may pass above or below a point, a net, or a height of a file, in metres.",
        "type": "number", "exclusiveMinimum": 0,
    });
    object(json!({ "grid": grid, "points": points, "tolerance": tolerance }))
}

fn about(description: &str, mut schema: Schema) -> Schema {
    schema.insert("description".to_owned(), json!(description));
    schema
}

/// The keys of heights from a file, besides `tolerance`.
fn of_file() -> Map<String, Value> {
    let words = Format::ALL.map(Format::word);
    let unit = json!(["m", "ft", "us-ft"]);
    let column = |axis: &str| {
        let description = format!("The column of {axis}: its name in the header, or its number.");
        json!({ "description": description, "type": ["string", "integer"] })
    };
    object(json!({
        "file": {
            "description": "A file of heights; its path begins at the model file's folder. With `tolerance` or `smooth`.",
            "type": "string",
        },
        "format": {
            "description": "How the file is written; found from what it holds if left out.",
            "enum": words,
        },
        "positive": {
            "description": "\"up\": the file has elevations; \"down\": it has depths. If left out, as the file says, and elevations if it says nothing.",
            "enum": ["up", "down"],
        },
        "unit": {
            "description": "The unit of the file's heights: metres (the default), feet of 0.3048 m, or American survey feet of 1200/3937 m.",
            "enum": unit,
        },
        "plan_unit": {
            "description": "The unit of the file's x and y; metres if left out.",
            "enum": unit,
        },
        "world": {
            "description": "Whether the file has coordinates in the world, from which the model's `origin` is subtracted: true (the default) or false.",
            "type": "boolean",
        },
        "columns": {
            "description": "Which columns of a CSV or XYZ file are x, y and z: names of the header, or numbers from 1.",
            "type": "object",
            "properties": { "x": column("x"), "y": column("y"), "z": column("z") },
            "required": ["x", "y", "z"],
            "additionalProperties": false,
        },
        "null": {
            "description": "A height, or a list of heights, that stand in the file for no data, besides what its format says.",
            "type": ["number", "array"],
            "items": { "type": "number" },
        },
        "smooth": {
            "description": "The noise of the file's heights in metres: the surface may miss them by that as root mean square, and does not follow it.",
            "type": "number", "exclusiveMinimum": 0,
        },
    }))
}

/// Says which keys go with a file, and that `tolerance` goes with these forms.
fn go_with_file(table: &mut Map<String, Value>, approximated: &[&str]) {
    let mut together = table
        .remove("dependentRequired")
        .map_or_else(Map::new, object);
    together.insert("points".to_owned(), json!(["tolerance"]));
    for key in of_file().keys().filter(|key| *key != "file") {
        together.insert(key.clone(), json!(["file"]));
    }
    table.insert("dependentRequired".to_owned(), Value::Object(together));
    let has = |key: &str| json!({ "required": [key] });
    let approximated: Vec<Value> = approximated.iter().map(|form| has(form)).collect();
    table.insert(
        "allOf".to_owned(),
        json!([
            { "if": has("tolerance"), "then": { "anyOf": approximated } },
            { "if": has("file"), "then": { "oneOf": [has("tolerance"), has("smooth")] } },
        ]),
    );
}

/// A surface over the whole domain, with what may be given besides.
fn surface(generator: &mut SchemaGenerator, isochore: Map<String, Value>) -> Schema {
    let level = about(
        "Its elevation in metres.",
        generator.subschema_for::<Quantity>(),
    );
    let dipping = about("A plane.", generator.subschema_for::<DippingFile>());
    let mut keys = object(json!({ "level": level, "dipping": dipping }));
    keys.extend(heights(
        generator,
        [
            "Heights at the nodes of a regular grid.",
            "Scattered points [x, y, z]",
        ],
    ));
    let net = about(
        "A control net over the whole domain with one elevation above every place; the surface is within `tolerance` of it (0.01 if left out).",
        generator.subschema_for::<NetFile>(),
    );
    keys.insert("net".to_owned(), net.to_value());
    keys.extend(of_file());
    // What goes with what is said below: `tolerance` goes with points, nets and files.
    let mut telling: Vec<(&str, &[&str])> = vec![
        ("level", &[]),
        ("dipping", &[]),
        ("grid", &[]),
        ("points", &[]),
        ("net", &[]),
        ("file", &[]),
    ];
    if !isochore.is_empty() {
        telling.push(("above", &["thickness"]));
    }
    keys.extend(isochore);
    let mut table = forms(
        "A surface over the whole domain: level, dipping, a grid of heights, scattered points, a control net, or heights from a file.",
        &keys,
        &telling,
    );
    go_with_file(&mut table, &["points", "net", "file"]);
    table.insert("type".to_owned(), json!("object"));
    let examples = json!([
        { "level": -20 },
        { "dipping": { "through": [0, 0, -20], "dip_deg": 1, "azimuth_deg": 90 } },
        { "grid": { "x": [0, 400], "y": [0, 700], "heights": [[-20, -21], [-22, -22]] } },
        { "points": [[0, 0, -21], [400, 0, -20], [0, 700, -22]], "tolerance": 0.1 },
        { "net": { "points": [[[-10, -10, -21], [-10, 710, -22]], [[410, -10, -20], [410, 710, -24]]] } },
        { "file": "top.irap", "tolerance": 0.5, "positive": "down" },
    ]);
    table.insert("examples".to_owned(), examples);
    table.into()
}
