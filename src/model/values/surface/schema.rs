//! What editors are told of surfaces.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use super::{DippingFile, GridFile, HorizonSurface};
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
    let mut thickness = forms(
        "How far above it: a number, a grid of thicknesses, or scattered points [x, y, thickness]; in metres, not below 0.",
        &heights(
            generator,
            [
                "Thicknesses at the nodes of a regular grid.",
                "Scattered points [x, y, thickness]",
            ],
        ),
        &[("grid", &[]), ("points", &["tolerance"])],
    );
    thickness.insert("type".to_owned(), json!("object"));
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
        "description": "How far the surface may pass above or below a point, or a net, in metres.",
        "type": "number", "exclusiveMinimum": 0,
    });
    object(json!({ "grid": grid, "points": points, "tolerance": tolerance }))
}

fn about(description: &str, mut schema: Schema) -> Schema {
    schema.insert("description".to_owned(), json!(description));
    schema
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
    let mut telling: Vec<(&str, &[&str])> = vec![
        ("level", &[]),
        ("dipping", &[]),
        ("grid", &[]),
        ("points", &["tolerance"]),
        ("net", &[]),
    ];
    if !isochore.is_empty() {
        telling.push(("above", &["thickness"]));
    }
    keys.extend(isochore);
    let mut table = forms(
        "A surface over the whole domain: level, dipping, a grid of heights, scattered points, or a control net.",
        &keys,
        &telling,
    );
    table.insert("type".to_owned(), json!("object"));
    let examples = json!([
        { "level": -20 },
        { "dipping": { "through": [0, 0, -20], "dip_deg": 1, "azimuth_deg": 90 } },
        { "grid": { "x": [0, 400], "y": [0, 700], "heights": [[-20, -21], [-22, -22]] } },
        { "points": [[0, 0, -21], [400, 0, -20], [0, 700, -22]], "tolerance": 0.1 },
        { "net": { "points": [[[-10, -10, -21], [-10, 710, -22]], [[410, -10, -20], [410, 710, -24]]] } },
    ]);
    table.insert("examples".to_owned(), examples);
    table.into()
}
