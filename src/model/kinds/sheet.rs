//! Sheets from control nets of one's own, through the whole domain: what lies above them is new.

use std::sync::Arc;

use glam::DVec3;
use schemars::{Schema, SchemaGenerator};

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Site};
use super::placed::{self, Placed, told};
use crate::features::body::Body;
use crate::features::nets::NetsError;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};

/// Where a sheet moves so that contacts which coincide are decided by age: down, and so that its kinks lie on no wall.
const ASIDE: DVec3 = DVec3::new(0.43, 0.31, 1.0);

/// A sheet from control nets.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetSpec {
    /// Its nets, and where they are.
    pub placed: Placed,
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
        placed::schema(
            "A surface through the whole domain from control nets of your own: the feature takes what lies above it.",
            "One net, or a list of nets that join; together they have one elevation above every place of the domain.",
            generator,
        )
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        keys.placed().map(|placed| Self { placed })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let nets = self.placed.draw(site.nudge * ASIDE, draws)?;
        let (low, high) = site.room.corners();
        let side = nets
            .above(low, high)
            .map_err(|error: NetsError| ("no sheet", error.to_string()))?;
        Ok(Made {
            decisions: told(&nets),
            ..Made::body(Body::Side(Arc::new(side)), draws.taken())
        })
    }
}
