//! Whether a horizon passes through the tops that were picked of it.

use schemars::JsonSchema;
use serde::Deserialize;

use super::surface::HorizonSurface;
use crate::model::checker::Checker;
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;

/// How a horizon passes through its tops.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Honours")]
pub(crate) struct HonoursFile {
    /// How far from a top the horizon is changed, in metres.
    pub(crate) reach: Field<f64>,
}

impl Checker<'_> {
    /// The reach (m) in which a horizon with this surface is changed about its tops; `what` names the table.
    pub(crate) fn honours(
        &self,
        node: NodeId,
        what: &str,
        surface: Option<&HorizonSurface>,
    ) -> Option<f64> {
        let file: HonoursFile = self.reader.table(node)?;
        self.reader.close(node, what);
        let (at, reach) = self
            .reader
            .need(file.reach, node, what, "reach", "reach = 500")?;
        if let Some(HorizonSurface::Above { .. }) = surface {
            let message = format!("{what}: its surface is given by a thickness above another one");
            self.reader.wrong(
                node,
                message,
                "let the horizon below it honour its tops, or give this one heights of its own",
            );
            return None;
        }
        if reach > 0.0 {
            return Some(reach);
        }
        let message = format!("the reach of {what} is {reach}; it must be above 0");
        self.reader.wrong(
            at,
            message,
            "write how far from a top the horizon is changed, in metres",
        );
        None
    }

    /// The same of a key that may be left out: nothing if it is, or if it is wrong.
    pub(crate) fn optional_honours(
        &self,
        field: Option<Field<Any>>,
        what: &str,
        surface: Option<&HorizonSurface>,
    ) -> Option<f64> {
        let (node, Any) = field?.good()?;
        self.honours(node, what, surface)
    }
}
