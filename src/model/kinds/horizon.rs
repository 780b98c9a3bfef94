//! Horizons.

use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Base, Frame, Made, Part, Site, TakesFrom};
use crate::features::body::Body;
use crate::features::side::Side;
use crate::model::checker::Extent;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Gives, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::{NodeId, quoted};
use crate::model::values::honours::HonoursFile;
use crate::model::values::surface::{HorizonSurface, horizon_surface};

/// A horizon: it makes a new unit above it, up to the next horizon or the domain's top.
#[derive(Clone, Debug, PartialEq)]
pub struct HorizonSpec {
    /// Where it runs.
    pub surface: HorizonSurface,
    /// Whether its unit takes from the open unit and its children alone; otherwise it is erosive and takes from everything.
    pub onlapping: bool,
    /// In which reach about its tops it is changed so that it passes through them (m); not at all if absent.
    pub honours: Option<f64>,
}

/// A horizon: a surface through the whole domain, with a new unit above it, up to the next horizon or the domain's top.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct HorizonFile {
    /// Where it runs.
    #[schemars(schema_with = "horizon_surface")]
    pub(crate) surface: Field<Any>,
    /// "erosive" (the default): its unit takes everything above the surface; "onlapping": only what the open unit (that of the horizon before it in the list, or the background) and its children hold; older units and bodies without a parent keep theirs.
    #[schemars(schema_with = "relation")]
    #[serde(default)]
    pub(crate) relation: Option<Field<String>>,
    /// Makes it pass through the model's `tops` of it, which changes it within a reach of each: { reach = 500 }. As it is drawn if left out.
    #[schemars(with = "Option<HonoursFile>")]
    pub(crate) honours_tops: Option<Field<Any>>,
}

fn relation(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["erosive", "onlapping"] })
}

impl Kind for HorizonSpec {
    const NATURE: Nature = Nature {
        name: "horizon",
        copies: Copies::One("a horizon"),
        within: Within::Domain {
            why: "a horizon runs through the whole domain",
            remedy: "leave `parent` out; to take from the open unit alone write relation = \"onlapping\"",
        },
        children: Children::Any,
        taking: Taking::ByKind {
            how: "a horizon takes what lies above it",
            remedy: "leave it out; to spare what is older write relation = \"onlapping\"",
        },
        volumes: Volumes::One,
        is_base: true,
        placed_by: "set its `surface`",
        apart: "raise or lower {name} by {by} or more there",
    };

    const GIVES: Gives = Gives::Sheets;

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        HorizonFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: HorizonFile = keys.table()?;
        let surface = keys
            .need(file.surface, "surface", "surface = { level = -20 }")
            .and_then(|(node, Any)| {
                let what = keys.what("surface");
                let extent = Extent::from(keys.domain);
                keys.checker.surface(node, &what, extent, Some(keys.family))
            });
        let onlapping = match file.relation.map(Field::good) {
            None => Some(false),
            Some(word) => word.and_then(|(node, word)| keys.relation(node, &word)),
        };
        let what = keys.what("honours_tops");
        let honours = keys
            .checker
            .optional_honours(file.honours_tops, &what, surface.as_ref());
        Some(Self {
            surface: surface?,
            onlapping: onlapping?,
            honours,
        })
    }

    /// What lies above the surface that was decided for it.
    fn make(&self, site: &Site<'_>, _: &mut Draws<'_>) -> Result<Made, Reason> {
        let impossible = |message: String| ("no horizon", message);
        let (surface, drawn) = site
            .surface
            .ok_or_else(|| impossible("it is no horizon".to_owned()))?;
        let (low, high) = site.domain.corners();
        let side = Side::horizon(surface.clone(), low, high)
            .map_err(|error| impossible(error.to_string()))?;
        let from = if self.onlapping {
            TakesFrom::OpenUnit
        } else {
            TakesFrom::Anything
        };
        Ok(Made {
            parts: vec![Part {
                from,
                drawn: drawn.to_vec(),
                ..Part::of(Body::Side(Arc::new(side)))
            }],
            frame: Frame::Unit(surface.clone()),
            decisions: match &self.surface {
                HorizonSurface::Net { tolerance, .. } => {
                    vec![format!("follows its control net within {tolerance} m")]
                }
                _ => Vec::new(),
            },
            event: None,
        })
    }

    fn base(&self) -> Option<Base<'_>> {
        Some(Base {
            surface: &self.surface,
            is_onlapping: self.onlapping,
            honours: self.honours,
        })
    }
}

impl Keys<'_, '_> {
    /// Whether it is onlapping.
    fn relation(&self, node: NodeId, word: &str) -> Option<bool> {
        match word {
            "erosive" => Some(false),
            "onlapping" => Some(true),
            _ => {
                self.checker.reader.wrong(
                    node,
                    format!("there is no relation {}", quoted(word)),
                    "write \"erosive\" or \"onlapping\"",
                );
                None
            }
        }
    }
}
