//! What editors are told of rock properties.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use crate::model::tables::{forms, object};
use crate::model::values::distribution::{NAMES, keys, truncation};
use crate::model::values::quantity::Quantity;

/// Stands for the table of a feature's rock properties.
pub(crate) struct Properties;

impl JsonSchema for Properties {
    fn schema_name() -> Cow<'static, str> {
        "Properties".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Rock properties of the feature's own volumes, in the place of those of its facies.",
            "type": "object",
            "properties": Self::keys(generator),
            "additionalProperties": any_property(generator),
        })
    }
}

impl Properties {
    /// The rock properties that have a meaning to the program.
    pub(crate) fn keys(generator: &mut SchemaGenerator) -> Map<String, Value> {
        let net = fraction(
            "Whether it counts as net (reservoir) rock: true, false, or which fraction of it does.",
            generator,
        );
        let mut net = net.clone();
        net.insert("type".to_owned(), json!(["boolean", "number", "object"]));
        net.insert("examples".to_owned(), json!([true, 0.6]));
        let permeability = along(
            "Permeability in millidarcy: one number, given or drawn; [x, y, z]; { dip, strike, normal } along the volume's layers; or { horizontal, vertical_fraction }.",
            Some(0.0),
            generator,
        );
        object(json!({
            "net": net,
            "porosity": fraction("Porosity, a fraction from 0 to 1, given or drawn.", generator),
            "permeability": permeability,
            "vsh": fraction("Volume of shale, a fraction from 0 to 1, given or drawn.", generator),
            "sw": fraction("Water saturation, a fraction of the pores from 0 to 1, given or drawn.", generator),
        }))
    }
}

/// Any further rock property.
pub(crate) fn any_property(generator: &mut SchemaGenerator) -> Value {
    Value::Object(along(
        "A rock property of your own: one number, given or drawn; [x, y, z]; { dip, strike, normal }; or { horizontal, vertical_fraction }.",
        None,
        generator,
    ))
}

/// Telling keys of a number that is drawn, or changes from base to top.
fn telling() -> Vec<(&'static str, &'static [&'static str])> {
    [&NAMES[..], &[("base", &["top"])]].concat()
}

/// The keys of these.
fn graded_keys(generator: &mut SchemaGenerator) -> Map<String, Value> {
    let number = |words: &str, generator: &mut SchemaGenerator| {
        let mut schema = generator.subschema_for::<Quantity>();
        schema.insert("description".to_owned(), json!(words));
        schema
    };
    let mut keys = keys();
    keys.extend(object(json!({
        "base": number("The value at the base of what is divided into layers.", generator),
        "top": number("The value at its top.", generator),
        "scale": {
            "description": "Whether the value or its logarithm changes evenly from base to top; \"log\" of permeabilities, \"linear\" of others if left out.",
            "enum": ["linear", "log"],
        },
    })));
    keys
}

/// A fraction: given, drawn, or from base to top.
fn fraction(description: &str, generator: &mut SchemaGenerator) -> Map<String, Value> {
    let mut table = forms(description, &graded_keys(generator), &telling());
    table.extend(truncation());
    needs_base(&mut table);
    table.extend(object(json!({
        "type": ["number", "object"], "minimum": 0, "maximum": 1,
        "examples": [0.25, { "normal": [0.25, 0.03], "min": 0.1, "max": 0.35 }, { "base": 0.2, "top": 0.1 }],
    })));
    table
}

/// A value that may differ along axes.
fn along(
    description: &str,
    least: Option<f64>,
    generator: &mut SchemaGenerator,
) -> Map<String, Value> {
    // What stands for one of the axes.
    let mut item = forms(
        "A number: given, drawn, or from base to top.",
        &graded_keys(generator),
        &telling(),
    );
    item.extend(truncation());
    needs_base(&mut item);
    item.insert("type".to_owned(), json!(["number", "object"]));
    if let Some(least) = least {
        item.insert("minimum".to_owned(), json!(least));
    }
    let item = Value::Object(item);
    let about = |words: &str| {
        let mut item = item.clone();
        item["description"] = json!(words);
        item
    };
    let mut keys = graded_keys(generator);
    keys.extend(object(json!({
        "dip": about("Down the dip of the layers, or along the flow."),
        "strike": about("Along strike, or across the flow."),
        "normal": normal(&item),
        "horizontal": about("Along x and y."),
        "vertical_fraction": generator.subschema_for::<Quantity>(),
    })));
    keys["vertical_fraction"]["description"] =
        json!("Along z, as a fraction of the horizontal one.");
    let mut telling = telling();
    telling.push(("dip", &["strike", "normal"]));
    telling.push(("horizontal", &["vertical_fraction"]));
    let mut table = forms(description, &keys, &telling);
    table.extend(truncation());
    needs_base(&mut table);
    tell_normal_from_normal(&mut table);
    table.extend(object(json!({
        "type": ["number", "array", "object"],
        "items": item, "minItems": 3, "maxItems": 3,
        "examples": [
            500, [500, 500, 50], { "lognormal": [500, 300] },
            { "horizontal": { "lognormal": [500, 300] }, "vertical_fraction": 0.1 },
            { "dip": 500, "strike": 300, "normal": 10 },
        ],
    })));
    if let Some(least) = least {
        table.insert("minimum".to_owned(), json!(least));
    }
    table
}

/// What `normal` is: a value across the layers where there is a dip, else the name of a distribution.
fn normal(item: &Value) -> Value {
    let mut normal = item.clone();
    normal["description"] = json!(
        "With `dip` and `strike`: across the layers. Alone: the normal distribution of [mean, standard deviation]."
    );
    normal["type"] = json!(["number", "object", "array"]);
    normal["items"] = json!({ "type": "number" });
    normal["minItems"] = json!(2);
    normal["maxItems"] = json!(2);
    normal
}

/// Of the forms that `normal` tells, the distribution is the one without a dip.
fn tell_normal_from_normal(table: &mut Map<String, Value>) {
    let is_along = json!({ "required": ["dip"] });
    if let Some(forms) = table.get_mut("oneOf").and_then(Value::as_array_mut) {
        for form in forms {
            if *form == json!({ "required": ["normal"] }) {
                form["not"] = is_along.clone();
            }
        }
    }
    if let Some(Value::Object(together)) = table.get_mut("dependentRequired") {
        together.remove("normal");
    }
    let only = |words: &str, kinds: Value| json!({ "properties": { "normal": { "description": words, "type": kinds } } });
    let either = json!({
        "if": is_along,
        "then": only("Across the layers.", json!(["number", "object"])),
        "else": only("[mean, standard deviation]", json!("array")),
    });
    table.insert("allOf".to_owned(), json!([either]));
}

/// A scale belongs to what has a base.
fn needs_base(table: &mut Map<String, Value>) {
    table["dependentRequired"]["scale"] = json!(["base"]);
}
