//! Bodies from control nets of one's own: one that is closed, or several that join.

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

/// A body from control nets.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpec {
    /// Its nets, and where they are.
    pub placed: Placed,
}

impl Kind for BodySpec {
    const NATURE: Nature = Nature {
        name: "body",
        copies: Copies::Any,
        within: Within::Anything,
        children: Children::Any,
        taking: Taking::ByRules,
        volumes: Volumes::One,
        is_base: false,
        placed_by: "set its `at`",
        apart: "move {name} by {by} or more (`at`), or its control points there",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        placed::schema(
            "A body from control nets of your own: of one closed net, of two that share their rims, or of any number that join on all sides.",
            "One closed net, or a list of nets; every side of a net is a side of another one or of itself, or a point.",
            generator,
        )
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        keys.placed().map(|placed| Self { placed })
    }

    fn make(&self, _: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let nets = self.placed.draw(DVec3::ZERO, draws)?;
        let shell = nets.inside().map_err(|error: NetsError| {
            let reason = match error {
                NetsError::Itself { .. } => "body passes through itself",
                _ => "body not closed",
            };
            (reason, error.to_string())
        })?;
        Ok(Made {
            decisions: told(&nets),
            ..Made::body(Body::Shell(shell), draws.taken())
        })
    }
}
