//! What bodies conform to: a horizon or a clinoform, at a depth below it. It is read in `check/conform.rs`.

use std::sync::Arc;

use schemars::JsonSchema;
use serde::Deserialize;

use super::quantity::Quantity;
use crate::features::side::Side;
use crate::model::draws::{Draws, Reason};
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::warp::Warp;

/// What a body conforms to.
#[derive(Clone, Debug, PartialEq)]
pub struct ConformSpec {
    /// The horizon, or the clinoform.
    pub to: Reference,
    /// How the file names it.
    pub name: String,
    /// How far below it the body's level comes to lie.
    pub depth: Quantity,
    /// That level; the body's own if absent.
    pub reference: Option<Quantity>,
    /// How far the body may be from where it should be; by its height if absent.
    pub tolerance: Option<f64>,
}

/// A surface that a body conforms to: each place of the body moves up or down by the surface's elevation there.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Conform")]
pub(crate) struct ConformFile {
    /// The horizon, or one of a set of clinoforms as "lower-3": its whole surface as it was before anything cut it, and beyond its ends as it goes on there.
    pub(crate) to: Field<String>,
    /// How far below the surface the level of the body comes to lie, in metres, negative for above; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) depth: Option<Field<Any>>,
    /// Elevation in the body, as its own keys give it, that comes to lie on the surface; if left out, the rims of a scour or a channel, the centre of an ellipsoid, what a lobe lies on.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) reference: Option<Field<Any>>,
    /// How far the body may be from where it should be, in metres, above 0; a hundredth of its height, but no more than 0.05, if left out.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub(crate) tolerance: Option<Field<f64>>,
}

impl Draws<'_> {
    /// The change of a body that conforms to a surface.
    pub(crate) fn warp(&mut self, spec: &ConformSpec, surface: &Arc<Side>) -> Result<Warp, Reason> {
        Ok(Warp {
            surface: Arc::clone(surface),
            name: spec.name.clone(),
            depth: self.quantity(&spec.depth, "conform.depth")?,
            reference: match &spec.reference {
                Some(reference) => Some(self.quantity(reference, "conform.reference")?),
                None => None,
            },
            tolerance: spec.tolerance,
        })
    }
}
