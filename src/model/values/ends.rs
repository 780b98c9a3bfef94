//! Ends: a quantity at the upstream end of something, and perhaps another one at its downstream end.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::json;

use super::limits::Limits;
use super::quantity::{Quantity, quantity};
use super::tuple::Tuple;
use crate::model::draws::{Draws, Reason};
use crate::model::read::Reader;
use crate::model::tables::object;
use crate::model::tree::{NodeId, Value};

/// A quantity at the upstream end, and at the downstream end if that is given too.
#[derive(Clone, Debug, PartialEq)]
pub struct Ends {
    /// At the upstream end.
    pub upstream: Quantity,
    /// At the downstream end; chosen by what has the ends if absent.
    pub downstream: Option<Quantity>,
}

/// One quantity, or two in a list.
pub(crate) fn ends(reader: &Reader<'_>, node: NodeId, what: &str, limits: Limits) -> Option<Ends> {
    if !matches!(reader.tree.value(node), Value::List(_)) {
        return Some(Ends {
            upstream: quantity(reader, node, what, limits)?,
            downstream: None,
        });
    }
    let pair = Tuple {
        what: what.to_owned(),
        names: ["upstream", "downstream"],
        limits,
        remedy: "write one number, or two in [ ]: at the upstream end and at the downstream end",
    };
    let [upstream, downstream] = pair.read(reader, node)?;
    Some(Ends {
        upstream,
        downstream: Some(downstream),
    })
}

impl Draws<'_> {
    /// What was drawn for both ends; nothing for the downstream one if it is not given.
    pub(crate) fn ends(
        &mut self,
        ends: &Ends,
        parameter: &str,
    ) -> Result<(f64, Option<f64>), Reason> {
        let Some(downstream) = &ends.downstream else {
            return Ok((self.quantity(&ends.upstream, parameter)?, None));
        };
        let upstream = self.quantity(&ends.upstream, &format!("{parameter}.upstream"))?;
        let downstream = self.quantity(downstream, &format!("{parameter}.downstream"))?;
        Ok((upstream, Some(downstream)))
    }
}

impl JsonSchema for Ends {
    fn schema_name() -> Cow<'static, str> {
        "Ends".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let quantity = generator.subschema_for::<Quantity>();
        // A number or a distribution is what a quantity is; a list holds two of these.
        let mut schema = object(json!({
            "description": "A quantity, or two: [at the upstream end, at the downstream end].",
            "if": { "type": "array" },
            "then": { "items": quantity, "minItems": 2, "maxItems": 2 },
            "else": quantity,
        }));
        schema.insert("type".to_owned(), json!(["number", "object", "array"]));
        schema.into()
    }
}
