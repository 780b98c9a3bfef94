//! Channel lags: coarse residue on the floor of a channel.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Part, Site, TakesFrom};
use crate::features::body::Body;
use crate::features::extrusion::ExtrusionError;
use crate::features::lag::{CLEARANCE, LagDesign, LagError, THICKEST, THINNEST};
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;
use crate::model::values::limits::Limits;
use crate::model::values::profile::Profile;

/// Height at the thalweg if left out, as a fraction of the depth.
const THICKNESS_FRACTION: f64 = 0.15;
/// How much the top sags with the base if left out.
const SAG_FRACTION: f64 = 0.5;

/// Where it is nearly 0, the lag's top would touch the channel's base.
const THICKNESS: Limits = Limits {
    low: THINNEST,
    high: THICKEST,
    open: false,
    words: "must lie between 0.02 and 0.6 (a fraction of the channel's depth)",
};
const SAG: Limits = Limits {
    low: 0.0,
    high: 0.8,
    open: false,
    words: "must lie between 0 (a level top) and 0.8 (nearly parallel to the channel's base)",
};

/// A lag: the lowest part of a channel's fill.
#[derive(Clone, Debug, PartialEq)]
pub struct LagSpec {
    /// Height at the thalweg, as a fraction of the channel's depth.
    pub thickness_fraction: Profile,
    /// How much the top sags with the channel's base: 0 is level.
    pub sag_fraction: Profile,
    /// Which of several lags of its channel it is, from 0.
    pub order: usize,
}

/// A lag: coarse residue on the floor of a channel (`parent`), along all of its thalweg.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LagFile {
    /// Height of its top above the thalweg, as a fraction of the channel's depth, between 0.02 and 0.6; 0.15 if left out. Its share of the channel's volume is much less.
    #[schemars(with = "Option<Profile>")]
    pub(crate) thickness_fraction: Option<Field<Any>>,
    /// How much its top sags with the channel's base, from 0 (level) to 0.8 (nearly parallel to the base); 0.5 if left out.
    #[schemars(with = "Option<Profile>")]
    pub(crate) sag_fraction: Option<Field<Any>>,
}

impl Kind for LagSpec {
    const NATURE: Nature = Nature {
        name: "lag",
        copies: Copies::OneEach("a lag in its channel"),
        within: Within::Only {
            kind: "channel",
            remedy: "a lag is the lowest part of a channel's fill: name a feature of kind = \"channel\"",
        },
        children: Children::None {
            what: "a lag",
            instead: "its channel",
        },
        taking: Taking::ByKind {
            how: "a lag takes the lowest part of its channel and nothing else",
            remedy: "leave it out",
        },
        volumes: Volumes::One,
        is_base: false,
        placed_by: "change its channel",
        apart: "change `thickness_fraction` or `sag_fraction` of {name} a little",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        LagFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: LagFile = keys.table()?;
        let thickness =
            keys.optional_profile(file.thickness_fraction, "thickness_fraction", THICKNESS);
        let sag = keys.optional_profile(file.sag_fraction, "sag_fraction", SAG);
        let (thickness, sag) = (thickness.ok()?, sag.ok()?);
        let constant = |given: &Option<(NodeId, Profile)>, default: f64| match given {
            None => Some(default),
            Some((_, profile)) => profile.constant(),
        };
        if let (Some(f), Some(g)) = (
            constant(&thickness, THICKNESS_FRACTION),
            constant(&sag, SAG_FRACTION),
        ) && (1.0 - f) * (1.0 - g) < CLEARANCE
        {
            let at = sag.as_ref().or(thickness.as_ref()).map(|given| given.0);
            keys.checker.reader.wrong(
                at.unwrap_or(keys.draft.node),
                format!(
                    "with a thickness_fraction of {f} and a sag_fraction of {g} the top of {} would share its edges with the channel's",
                    keys.draft.name
                ),
                format!("make one of them smaller: (1 − thickness_fraction) (1 − sag_fraction) must be at least {CLEARANCE}"),
            );
            return None;
        }
        let or = |given: Option<(NodeId, Profile)>, default: f64| {
            given.map_or(Profile::from(default), |given| given.1)
        };
        Some(Self {
            thickness_fraction: or(thickness, THICKNESS_FRACTION),
            sag_fraction: or(sag, SAG_FRACTION),
            order: keys.elder_siblings(),
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let reach = site.reach()?;
        let design = LagDesign {
            thickness: draws.profile(&self.thickness_fraction, "thickness_fraction")?,
            sag: draws.profile(&self.sag_fraction, "sag_fraction")?,
            order: self.order,
        };
        let reason = |error: LagError| match &error {
            LagError::Extrusion(carried) if !matches!(**carried, ExtrusionError::Section(..)) => {
                ("surface out of tolerance", error.to_string())
            }
            _ => ("impossible section", error.to_string()),
        };
        let lag = design.build(reach).map_err(reason)?;
        Ok(Made::of(vec![Part {
            from: TakesFrom::ParentItself,
            drawn: draws.taken(),
            ..Part::of(Body::Shell(lag))
        }]))
    }
}
