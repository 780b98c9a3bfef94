//! Sheets from control nets of one's own, through the whole domain: what lies above them is new.

use std::sync::Arc;

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Site};
use super::placed::{Placed, told};
use crate::features::body::Body;
use crate::features::nets::NetsError;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::values::nets;

/// Where a sheet moves so that contacts which coincide are decided by age: down, and so that its kinks lie on no wall.
const ASIDE: DVec3 = DVec3::new(0.43, 0.31, 1.0);

/// A sheet from control nets.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetSpec {
    /// Its nets, and where they are.
    pub placed: Placed,
}

/// A surface through the whole domain from control nets of your own: the feature takes what lies above it.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SheetFile {
    /// One net, or a list of nets that join; together they have one elevation above every place of the domain.
    #[schemars(schema_with = "nets::schema")]
    pub(crate) nets: Field<Any>,
    /// Where the points count from, [x, y, z] in metres; [0, 0, 0] if left out.
    #[schemars(with = "Option<[crate::model::values::quantity::Quantity; 3]>")]
    pub(crate) at: Option<Field<Any>>,
    /// Direction of the points' y axis in degrees, clockwise from north: they are turned about `at`; 0 if left out.
    #[schemars(with = "Option<crate::model::values::quantity::Quantity>")]
    pub(crate) azimuth_deg: Option<Field<Any>>,
}

impl Kind for SheetSpec {
    const NATURE: Nature = Nature {
        name: "sheet",
        copies: Copies::Any,
        within: Within::Anything,
        children: Children::Any,
        taking: Taking::ByRules,
        volumes: Volumes::One,
        is_base: false,
        placed_by: "set its `at`",
        apart: "move {name} up or down by {by} or more (`at`), or its control points there",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        SheetFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: SheetFile = keys.table()?;
        let placed = keys.placed(file.nets, file.at, file.azimuth_deg)?;
        Some(Self { placed })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let nets = self.placed.draw(site.nudge * ASIDE, draws)?;
        let (low, high) = site.domain.corners();
        let side = nets
            .above(low, high)
            .map_err(|error: NetsError| ("no sheet", error.to_string()))?;
        Ok(Made {
            decisions: told(&nets),
            ..Made::body(Body::Side(Arc::new(side)), draws.taken())
        })
    }
}
