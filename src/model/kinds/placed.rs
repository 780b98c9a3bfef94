//! Control nets where they are: what sheets and bodies of one's own share.

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::{Value, json};

use super::keys::Keys;
use crate::features::nets::{Joined, NamedNet, Nets, Placement};
use crate::model::draws::{Draws, Reason};
use crate::model::read::{Any, Field};
use crate::model::values::limits::{ANY, AZIMUTH};
use crate::model::values::nets;
use crate::model::values::quantity::Quantity;
use crate::model::values::tuple::Tuple;

/// The keys of what is made of control nets.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlacedFile {
    #[schemars(schema_with = "nets::schema")]
    nets: Field<Any>,
    /// Where the points count from, [x, y, z] in metres; [0, 0, 0] if left out.
    #[schemars(with = "Option<[Quantity; 3]>")]
    at: Option<Field<Any>>,
    /// Direction of the points' y axis in degrees, clockwise from north: they are turned about `at`; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    azimuth_deg: Option<Field<Any>>,
}

/// The table of a kind that is made of control nets, for editors: what it is, and what its nets are.
pub(crate) fn schema(about: &str, nets: &str, generator: &mut SchemaGenerator) -> Schema {
    let mut schema = PlacedFile::json_schema(generator);
    schema.insert("description".to_owned(), json!(about));
    if let Some(own) = schema
        .pointer_mut("/properties/nets")
        .and_then(Value::as_object_mut)
    {
        own.insert("description".to_owned(), json!(nets));
    }
    schema
}

/// Nets, and where they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The nets.
    pub nets: Vec<NamedNet>,
    /// Where their points count from.
    pub at: [Quantity; 3],
    /// Direction of their y axis, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
}

impl Placed {
    /// Draws where they are, moved by a tiny distance (m), and builds them.
    pub(crate) fn draw(&self, nudge: DVec3, draws: &mut Draws<'_>) -> Result<Nets, Reason> {
        let [x, y, z] = &self.at;
        let at = DVec3::new(
            draws.quantity(x, "at.x")?,
            draws.quantity(y, "at.y")?,
            draws.quantity(z, "at.z")?,
        );
        let placement = Placement {
            at: at + nudge,
            azimuth: draws
                .quantity(&self.azimuth_deg, "azimuth_deg")?
                .to_radians(),
        };
        Nets::new(&self.nets, placement).map_err(|error| ("no net", error.to_string()))
    }
}

/// How nets are joined, in words for the report.
pub(crate) fn told(nets: &Nets) -> Vec<String> {
    let told = |joint: &Joined| {
        let Joined {
            name,
            to,
            gap,
            angle,
        } = joint;
        let angle = angle.to_degrees();
        format!(
            "has net {name} joined to {to}: {gap:.1e} m apart at the most, at an angle of up to {angle:.4}°"
        )
    };
    nets.joints.iter().map(told).collect()
}

impl Keys<'_, '_> {
    /// Where what is given in coordinates of its own is placed; at the origin if that is left out.
    pub(super) fn placed_at(&self, at: Option<Field<Any>>) -> Option<[Quantity; 3]> {
        let Some(field) = at else {
            return Some([0.0; 3].map(Quantity::Constant));
        };
        let (node, Any) = field.good()?;
        let place = Tuple {
            what: self.what("at"),
            names: ["x", "y", "z"],
            limits: ANY,
            remedy: "write the three coordinates in [ ], in metres",
        };
        place.read(&self.checker.reader, node)
    }

    /// The nets of the feature, with where they are.
    pub(crate) fn placed(&self) -> Option<Placed> {
        let PlacedFile {
            nets,
            at,
            azimuth_deg,
        } = self.table()?;
        let example = "nets = { points = [[[0, 0, 0], [0, 9, 0]], [[9, 0, 0], [9, 9, 1]]] }";
        let nets = self
            .need(nets, "nets", example)
            .and_then(|(node, Any)| self.checker.nets(node, &self.what("nets")));
        let at = self.placed_at(at);
        let azimuth = self.optional_quantity(azimuth_deg, "azimuth_deg", AZIMUTH);
        Some(Placed {
            nets: nets?,
            at: at?,
            azimuth_deg: azimuth.ok()?.unwrap_or(Quantity::Constant(0.0)),
        })
    }
}
