//! Levees: wedges on the banks of a channel that they go along.

use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Outcome, Part, Site, TakesFrom, VolumeName};
use crate::features::body::Body;
use crate::features::levee::{LeveeDesign, LeveeError, MOST_TAPER, parts};
use crate::features::profile::Profile as Along;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;
use crate::model::values::bank::{Side, sides_schema};
use crate::model::values::limits::{FRACTION, Limits, POSITIVE};
use crate::model::values::profile::Profile;
use crate::model::values::quantity::Quantity;

/// Width in the channel's widths, height and depth in its depths.
const SIZES: [f64; 3] = [1.0, 0.1, 0.3];
const TAPER: u64 = 2;
const TOE: f64 = 0.3;
const BEND_ASYMMETRY: f64 = 0.3;
const THINNING: f64 = 0.3;
/// What turns by less is no bend, and makes no body of its own (rad).
const LEAST_TURN: f64 = 0.35;

const THINNER: Limits = Limits {
    low: 0.0,
    high: 0.9,
    open: false,
    words: "must lie between 0 and 0.9 (a fraction of what it is at the channel's start)",
};

/// A channel's levees.
#[derive(Clone, Debug, PartialEq)]
pub struct LeveeSpec {
    /// On which banks.
    pub sides: Vec<Side>,
    /// Width from crest to toe (m); as wide as the channel if absent.
    pub width: Option<Profile>,
    /// Height of the crest above the channel's top (m); a tenth of its depth if absent.
    pub height: Option<Profile>,
    /// Depth of the base below the channel's top, under the crest (m); three tenths of its depth if absent.
    pub depth: Option<Profile>,
    /// Exponent of the top's fall from crest to toe.
    pub taper: usize,
    /// Gradient at the toe as a fraction of the mean one.
    pub toe: Quantity,
    /// How much wider it is on the outer bank of the sharpest bend, as a fraction.
    pub bend_asymmetry: Quantity,
    /// By what fraction it is smaller at the channel's end.
    pub thinning: Quantity,
}

/// Levees: wedges on the banks of a channel (`along`), which thin away from it.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LeveeFile {
    /// On which banks, looking along the channel: "both" (the default), "left" or "right".
    #[schemars(schema_with = "sides_schema")]
    #[serde(default)]
    pub(crate) sides: Option<Field<String>>,
    /// Width from the crest, just outside of the channel's rim, to the toe, in metres, above 0; the channel's width if left out. Inner banks of bends have less.
    #[schemars(with = "Option<Profile>")]
    pub(crate) width: Option<Field<Any>>,
    /// Height of the crest above the channel's top in metres, above 0; a tenth of the channel's depth if left out.
    #[schemars(with = "Option<Profile>")]
    pub(crate) height: Option<Field<Any>>,
    /// Depth of the base below the channel's top, under the crest, in metres, above 0; three tenths of the channel's depth if left out. The base rises from there to the toe.
    #[schemars(with = "Option<Profile>")]
    pub(crate) depth: Option<Field<Any>>,
    /// How the top falls from crest to toe: 1 (straight) to 5 (most of it beside the crest); 2 if left out.
    #[schemars(range(min = 1, max = 5))]
    pub(crate) taper: Option<Field<u64>>,
    /// Gradient of the top at the toe as a fraction of the mean one, between 0 (level) and 1 (straight); 0.3 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) toe: Option<Field<Any>>,
    /// How much wider it is on the outer bank where the channel bends most sharply, and narrower on the inner one, as a fraction between 0 and 1; 0.3 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) bend_asymmetry: Option<Field<Any>>,
    /// By what fraction width and height are less at the channel's end than at its start, between 0 and 0.9; 0.3 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) thinning: Option<Field<Any>>,
}

impl Kind for LeveeSpec {
    const NATURE: Nature = Nature {
        name: "levee",
        copies: Copies::OneEach("a pair of levees along a channel"),
        within: Within::Along {
            kind: "channel",
            remedy: "levees go along a channel: write along = \"…\" with the id of a feature of kind = \"channel\"",
        },
        children: Children::None {
            what: "a pair of levees",
            instead: "what its channel lies in",
        },
        taking: Taking::ByRules,
        volumes: Volumes::Many {
            most: 2,
            one: "levee",
        },
        is_base: false,
        placed_by: "change its channel",
        apart: "change `width`, `height` or `depth` of {name} by {by} or more",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        LeveeFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: LeveeFile = keys.table()?;
        let sides = keys.checker.sides(file.sides);
        let width = keys.optional_profile(file.width, "width", POSITIVE);
        let height = keys.optional_profile(file.height, "height", POSITIVE);
        let depth = keys.optional_profile(file.depth, "depth", POSITIVE);
        let taper = keys.taper(file.taper);
        let toe = keys.optional_quantity(file.toe, "toe", FRACTION);
        let asymmetry = keys.optional_quantity(file.bend_asymmetry, "bend_asymmetry", FRACTION);
        let thinning = keys.optional_quantity(file.thinning, "thinning", THINNER);
        let plain = |found: Option<(NodeId, Profile)>| found.map(|(_, profile)| profile);
        let or =
            |given: Option<Quantity>, default: f64| given.unwrap_or(Quantity::Constant(default));
        let sides = sides?;
        let names: Vec<&str> = sides.iter().map(|side| side.name()).collect();
        keys.free_names(&names)?;
        Some(Self {
            sides,
            width: plain(width.ok()?),
            height: plain(height.ok()?),
            depth: plain(depth.ok()?),
            taper: taper?,
            toe: or(toe.ok()?, TOE),
            bend_asymmetry: or(asymmetry.ok()?, BEND_ASYMMETRY),
            thinning: or(thinning.ok()?, THINNING),
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let reach = site.reach()?;
        let channel = reach.design();
        let mut size = |given: &Option<Profile>, name: &str, of: &Along, part: f64| match given {
            Some(profile) => draws.profile(profile, name),
            None => Ok(scaled(of, part)),
        };
        let [of_width, of_height, of_depth] = SIZES;
        let design = LeveeDesign {
            width: size(&self.width, "width", &channel.width, of_width)?,
            height: size(&self.height, "height", &channel.depth, of_height)?,
            depth: size(&self.depth, "depth", &channel.depth, of_depth)?,
            taper: self.taper,
            toe: draws.quantity(&self.toe, "toe")?,
            bend_asymmetry: draws.quantity(&self.bend_asymmetry, "bend_asymmetry")?,
            thinning: draws.quantity(&self.thinning, "thinning")?,
        };
        let drawn = draws.taken();
        let mut made = Vec::new();
        let mut decisions = Vec::new();
        for side in &self.sides {
            let (bank, name) = (side.bank(), side.name());
            let mut absent = 0;
            for part in parts(reach, bank, LEAST_TURN) {
                let built = design.build(reach, &part);
                match built
                    .map_err(|error| (reason(&error), format!("its {name} levee: {error}")))?
                {
                    None => absent += 1,
                    Some(shell) if site.meets(shell.bounds()) => made.push(Part {
                        // Bodies of one name are one volume.
                        name: format!("-{name}"),
                        from: TakesFrom::Anything,
                        drawn: drawn.clone(),
                        ..Part::of(Body::Shell(shell))
                    }),
                    Some(_) => {}
                }
            }
            if absent > 0 {
                let bends = if absent == 1 { "bend" } else { "bends" };
                decisions.push(format!(
                    "has no levee on the {name} bank of {absent} {bends}, which leave no room for it"
                ));
            }
        }
        Ok(Made {
            decisions,
            ..Made::of(made)
        })
    }

    /// What `left` is.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        let is_it = |side: &Side| side.name() == rest;
        self.sides.iter().any(is_it).then_some(VolumeName::Volume)
    }

    fn meshing(made: &[Outcome<'_>]) -> Option<String> {
        let first = made.first()?;
        Some(format!(
            "levees thin out to nothing at their toes ({} first): ask for elements of their thickness there, or stretch the \
             vertical before meshing",
            first.name
        ))
    }
}

/// A part of a profile.
fn scaled(of: &Along, part: f64) -> Along {
    match of {
        Along::Constant(value) => Along::Constant(part * value),
        Along::Along(pairs) => Along::Along(pairs.iter().map(|(s, v)| (*s, part * v)).collect()),
        Along::Function(function) => {
            let function = Arc::clone(function);
            Along::Function(Arc::new(move |s| part * function(s)))
        }
    }
}

fn reason(error: &LeveeError) -> &'static str {
    match error {
        LeveeError::Root { .. } => "levee deeper than its channel's bank",
        LeveeError::Extrusion(_) => "surface out of tolerance",
        _ => "impossible levee",
    }
}

impl Keys<'_, '_> {
    fn taper(&self, field: Option<Field<u64>>) -> Option<usize> {
        let number = match field {
            None => TAPER,
            Some(field) => {
                let (node, number) = field.good()?;
                if !(1..=MOST_TAPER as u64).contains(&number) {
                    self.checker.reader.wrong(
                        node,
                        format!("the taper of {} is {number}", self.draft.name),
                        format!("write a number from 1 (straight) to {MOST_TAPER}"),
                    );
                    return None;
                }
                number
            }
        };
        usize::try_from(number).ok()
    }
}
