//! The tables of a model file, as they are written.
//!
//! These types are both the reader (serde) and the published schema (schemars), so neither can drift from the other; the
//! doc comments are what an editor shows. Values of several shapes are [`Any`] here and are told apart in `check`.

use std::borrow::Cow;
use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::colours;
use super::kinds;
use super::read::{Any, Field};
use super::tables::object;
use super::values::property::{Properties, any_property};
use super::values::surface::HorizonSurface;
use super::wells::file::WellFile;

/// A surface-based geological model. Lengths in metres, x east, y north, z up; azimuths clockwise from north.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Model")]
pub(crate) struct ModelFile {
    /// What the model is called.
    pub(crate) name: Field<String>,
    /// A sentence or two about the model.
    pub(crate) description: Option<Field<String>>,
    /// Seed of all random draws, a whole number from 0; 1 if left out. The same seed gives the same model.
    pub(crate) seed: Option<Field<u64>>,
    /// Where the local origin lies in the world, [easting, northing] or [easting, northing, elevation] in metres. Recorded in the results, and subtracted from files of heights in world coordinates; never added to the coordinates of the model.
    #[schemars(schema_with = "origin")]
    #[serde(default)]
    pub(crate) origin: Option<Field<Any>>,
    /// The block that is modelled.
    #[schemars(with = "DomainFile")]
    pub(crate) domain: Field<Any>,
    /// The facies by name: what the volumes are made of.
    #[schemars(with = "BTreeMap<String, FaciesTable>")]
    pub(crate) facies: Field<Any>,
    /// The features, from oldest to youngest.
    #[schemars(schema_with = "kinds::schema")]
    #[serde(default)]
    pub(crate) feature: Option<Field<Any>>,
    /// Wells: curves through the stations of their surveys, of which it is told what they pass through. They change nothing.
    #[schemars(with = "Option<Vec<WellFile>>")]
    pub(crate) well: Option<Field<Any>>,
    /// A table of tops picked in wells: a file with the columns well, horizon and md. It is told how far the horizons are from them.
    pub(crate) tops: Option<Field<String>>,
}

/// The modelled block. Before any feature, all of it is the volume `background`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Domain")]
pub(crate) struct DomainFile {
    /// [west, east] limits in metres.
    pub(crate) x: Field<[f64; 2]>,
    /// [south, north] limits in metres.
    pub(crate) y: Field<[f64; 2]>,
    /// [base, top] elevations in metres; z points up.
    pub(crate) z: Field<[f64; 2]>,
    /// A base within `z`: below it the model has nothing.
    #[schemars(with = "Option<HorizonSurface>")]
    pub(crate) base: Option<Field<Any>>,
    /// A top within `z`: above it the model has nothing.
    #[schemars(with = "Option<HorizonSurface>")]
    pub(crate) top: Option<Field<Any>>,
    /// A bed thinner than this, in metres, at the nodes of its horizons' grids is absent there; a ten-billionth of the domain's diagonal if left out.
    #[schemars(range(min = 0))]
    pub(crate) least_thickness: Option<Field<f64>>,
    /// The facies of the background.
    pub(crate) facies: Field<String>,
}

/// A facies. Any further key with a number, [x, y, z] or a distribution is a rock property of its own.
#[derive(Deserialize, JsonSchema)]
pub(crate) struct FaciesFile {
    /// What it is called where people read, in any alphabet; the table's name if left out.
    pub(crate) name: Option<Field<String>>,
    /// Colour in pictures and files, "#rrggbb" or a colour's name; by the rock that the facies' name says if left out.
    #[schemars(schema_with = "color")]
    #[serde(default)]
    pub(crate) color: Option<Field<String>>,
    /// A sentence about the facies.
    pub(crate) description: Option<Field<String>>,
}

/// Stands for the table of a facies: its own keys, and its rock properties beside them.
struct FaciesTable;

impl JsonSchema for FaciesTable {
    fn schema_name() -> Cow<'static, str> {
        "Facies".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut table = FaciesFile::json_schema(generator);
        let own = table.get("properties").cloned();
        let mut keys = own.map_or_else(Map::new, object);
        keys.extend(Properties::keys(generator));
        table.insert("properties".to_owned(), Value::Object(keys));
        table.insert("additionalProperties".to_owned(), any_property(generator));
        table
    }
}

fn origin(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": ["array", "null"], "items": { "type": "number" }, "minItems": 2, "maxItems": 3,
    })
}

fn color(_: &mut SchemaGenerator) -> Schema {
    let hexadecimal = "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$";
    json_schema!({
        "type": "string",
        "anyOf": [{ "pattern": hexadecimal }, { "enum": colours::names() }],
        "examples": ["#e6c25c", "gold", "grey"],
    })
}
