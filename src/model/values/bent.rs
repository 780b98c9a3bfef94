//! Profiles that may also follow the bends of their trajectory.

use std::borrow::Cow;
use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::{Value as Json, json};

use super::limits::Limits;
use super::profile::{Profile, profile};
use super::quantity::{Quantity, quantity};
use crate::features::bends::by_curvature;
use crate::features::profile::Profile as Along;
use crate::features::trajectory::Trajectory;
use crate::model::draws::{Draws, Reason};
use crate::model::read::{Any, Field, Reader};
use crate::model::tree::NodeId;

/// A profile, or a quantity in proportion to the trajectory's curvature.
#[derive(Clone, Debug, PartialEq)]
pub enum BentProfile {
    /// A profile like any other.
    Profile(Profile),
    /// The value where the trajectory turns left most sharply; as much below 0 where it turns right as sharply, 0 where it is
    /// straight. What is counted to the right lies towards the outer banks so.
    ByCurvature(Quantity),
}

/// The table of the second form.
#[derive(Deserialize)]
pub(crate) struct ByCurvatureFile {
    pub(crate) by_curvature: Field<Any>,
}

/// What was drawn, until the trajectory is known.
#[derive(Clone, Debug)]
pub(crate) enum DrawnBent {
    Along(Along),
    ByCurvature(f64),
}

/// A profile, or one by curvature.
pub(crate) fn bent_profile(
    reader: &Reader<'_>,
    node: NodeId,
    what: &str,
    limits: Limits,
) -> Option<BentProfile> {
    if reader.tree.entry(node, "by_curvature").is_none() {
        return profile(reader, node, what, limits).map(BentProfile::Profile);
    }
    let file: ByCurvatureFile = reader.table(node)?;
    reader.close(node, what);
    let (at, Any) = file.by_curvature.good()?;
    let what = format!("the by_curvature of {what}");
    quantity(reader, at, &what, limits).map(BentProfile::ByCurvature)
}

impl From<f64> for BentProfile {
    fn from(value: f64) -> Self {
        Self::Profile(value.into())
    }
}

impl BentProfile {
    pub(crate) fn draw(&self, draws: &mut Draws<'_>, parameter: &str) -> Result<DrawnBent, Reason> {
        Ok(match self {
            Self::Profile(profile) => DrawnBent::Along(draws.profile(profile, parameter)?),
            Self::ByCurvature(most) => {
                let parameter = format!("{parameter}.by_curvature");
                DrawnBent::ByCurvature(draws.quantity(most, &parameter)?)
            }
        })
    }
}

impl DrawnBent {
    /// The parameter along a trajectory.
    pub(crate) fn along(self, trajectory: &Arc<Trajectory>) -> Along {
        match self {
            Self::Along(profile) => profile,
            Self::ByCurvature(most) => by_curvature(trajectory, most),
        }
    }
}

impl JsonSchema for BentProfile {
    fn schema_name() -> Cow<'static, str> {
        "BentProfile".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let quantity = generator.subschema_for::<Quantity>();
        let mut schema = Profile::json_schema(generator);
        if let Some(Json::Object(keys)) = schema.get_mut("properties") {
            let words = "How much where the trajectory turns most sharply: to the right of the centre where it turns left.";
            keys.insert(
                "by_curvature".to_owned(),
                json!({ "allOf": [quantity], "description": words }),
            );
        }
        if let Some(Json::Array(forms)) = schema.get_mut("oneOf") {
            forms.push(json!({ "required": ["by_curvature"] }));
        }
        let words = "A profile, or { by_curvature = quantity }: that much where the trajectory turns left most sharply, as much below 0 where it turns right as sharply, and 0 where it is straight.";
        schema.insert("description".to_owned(), json!(words));
        schema
    }
}
