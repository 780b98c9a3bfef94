//! Gradual trends: a channel or a unit in layers.

use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Bound, Frame, Made, Part, Site, TakesFrom, VolumeName};
use crate::features::body::Body;
use crate::features::horizon::Horizon;
use crate::features::side::Side;
use crate::features::trend::{self, Course, LevelsDesign, LevelsError, MOST_SAG};
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::quoted;
use crate::model::values::limits::{Limits, POSITIVE};
use crate::model::values::quantity::Quantity;

/// Surfaces if left out.
const STEPS: u64 = 4;
/// Most surfaces.
const MOST_STEPS: u64 = 50;
/// Places along x and y at which a unit's thickness is asked.
const ASKED: usize = 33;

const SAG: Limits = Limits {
    low: 0.0,
    high: MOST_SAG,
    open: false,
    words: "must lie between 0 (level) and 0.8 (nearly parallel to the channel's base)",
};

/// A gradual trend.
#[derive(Clone, Debug, PartialEq)]
pub struct TrendSpec {
    /// Surfaces between layers.
    pub steps: usize,
    /// How they run.
    pub between: TrendBetween,
    /// What bounds the unit above, of a unit.
    pub top: Bound,
}

/// How the surfaces of a trend run.
#[derive(Clone, Debug, PartialEq)]
pub enum TrendBetween {
    /// In a channel: at parts of its depth, sagging with its base.
    Levels(Quantity),
    /// In a unit: at parts of the way from base to top.
    Proportional,
    /// Parallel to the unit's base, this far from each other.
    Base(Quantity),
    /// Parallel to the unit's top, this far from each other.
    Top(Quantity),
}

/// A gradual trend: its parent, a channel or the unit above a horizon (without a parent: the background), in layers from base to top.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TrendFile {
    /// Surfaces, of which one more are layers; 4 if left out.
    #[schemars(range(min = 1, max = 50))]
    pub(crate) steps: Option<Field<u64>>,
    /// How the surfaces run: "levels" in a channel, at even parts of its depth; in a unit "proportional", at even parts of the way from base to top; "base" or "top", parallel to that, `spacing` apart. "levels" or "proportional" if left out.
    #[schemars(schema_with = "between")]
    #[serde(default)]
    pub(crate) between: Option<Field<String>>,
    /// Distance from one surface to the next in metres, above 0; for "base" and "top" alone.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) spacing: Option<Field<Any>>,
    /// How much the surfaces in a channel sag with its base, from 0 (level, the default) to 0.8.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) sag_fraction: Option<Field<Any>>,
}

fn between(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["levels", "proportional", "base", "top"] })
}

impl Kind for TrendSpec {
    const NATURE: Nature = Nature {
        name: "trend",
        copies: Copies::OneEach("a trend in its parent"),
        within: Within::Anything,
        children: Children::None {
            what: "a trend",
            instead: "what it divides",
        },
        taking: Taking::ByKind {
            how: "a trend divides its parent and removes nothing else",
            remedy: "leave it out",
        },
        volumes: Volumes::Many {
            most: MOST_STEPS + 1,
            one: "layer",
        },
        is_base: false,
        placed_by: "change its parent",
        apart: "change `steps`, `spacing` or `sag_fraction` of {name} a little",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        TrendFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: TrendFile = keys.table()?;
        let steps = keys.layer_surfaces(file.steps);
        let parent = keys.divided();
        let word = match file.between {
            None => Some(None),
            Some(field) => field.good().map(Some),
        };
        let spacing_given = file.spacing.is_some();
        let sag_given = file.sag_fraction.is_some();
        let spacing = keys.optional_quantity(file.spacing, "spacing", POSITIVE);
        let sag = keys.optional_quantity(file.sag_fraction, "sag_fraction", SAG);
        let (parent, word) = (parent?, word?);
        let (spacing, sag) = (spacing.ok()?, sag.ok()?);
        let is_channel = matches!(parent, Divided::Channel);
        let default = if is_channel { "levels" } else { "proportional" };
        let (node, word) = word.map_or((keys.draft.node, default.to_owned()), |given| given);
        let fits = match word.as_str() {
            "levels" => is_channel,
            "proportional" | "base" | "top" => !is_channel,
            _ => {
                keys.checker.reader.wrong(
                    node,
                    format!("there is no way {} for surfaces to run", quoted(&word)),
                    "write \"levels\" in a channel; \"proportional\", \"base\" or \"top\" in a unit",
                );
                return None;
            }
        };
        let wrong = |message: String, remedy: &str| {
            keys.checker.reader.wrong(node, message, remedy);
            None
        };
        let name = &keys.draft.name;
        if !fits {
            let (what, remedy) = if is_channel {
                ("a channel", "write between = \"levels\", or leave it out")
            } else {
                (
                    "a unit",
                    "write \"proportional\" (the default), \"base\" or \"top\"",
                )
            };
            return wrong(
                format!(
                    "{name} divides {what}, in which no surfaces run {}",
                    quoted(&word)
                ),
                remedy,
            );
        }
        if sag_given && !is_channel {
            return wrong(
                format!("{name} divides a unit, but has a `sag_fraction`"),
                "leave it out: surfaces sag in channels alone",
            );
        }
        let is_parallel = matches!(word.as_str(), "base" | "top");
        if spacing_given != is_parallel {
            let (message, remedy) = if is_parallel {
                (
                    format!("{name} has surfaces parallel to a unit's {word}, but no `spacing`"),
                    "say how far they are from each other, as spacing = 2",
                )
            } else {
                (
                    format!(
                        "{name} has a `spacing`, but its surfaces run {}",
                        quoted(&word)
                    ),
                    "leave it out, or write between = \"base\" or \"top\"",
                )
            };
            return wrong(message, remedy);
        }
        let between = match (word.as_str(), spacing) {
            ("base", Some(spacing)) => TrendBetween::Base(spacing),
            ("top", Some(spacing)) => TrendBetween::Top(spacing),
            ("levels", _) => TrendBetween::Levels(sag.unwrap_or(Quantity::Constant(0.0))),
            _ => TrendBetween::Proportional,
        };
        let top = match parent {
            Divided::Unit(top) => top,
            Divided::Channel => Bound::Domain,
        };
        Some(Self {
            steps: steps?,
            between,
            top,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let course = match &self.between {
            TrendBetween::Levels(sag) => {
                let sag = draws.quantity(sag, "sag_fraction")?;
                return self.levels(site, sag, draws);
            }
            TrendBetween::Proportional => Course::Proportional,
            TrendBetween::Base(step) => Course::ParallelToBase(draws.quantity(step, "spacing")?),
            TrendBetween::Top(step) => Course::ParallelToTop(draws.quantity(step, "spacing")?),
        };
        self.unit(site, course, draws)
    }

    fn top(&self) -> Option<Bound> {
        Some(self.top)
    }

    /// What `3` is.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        VolumeName::numbered(rest, self.steps + 1)
    }
}

impl TrendSpec {
    /// Layers of a channel: the last one from the channel itself, each lower one from that above it.
    fn levels(&self, site: &Site<'_>, sag: f64, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let design = LevelsDesign {
            surfaces: self.steps,
            sag,
        };
        let reason = |error: LevelsError| match &error {
            LevelsError::Extrusion(_) | LevelsError::Shell(_) => {
                ("surface out of tolerance", error.to_string())
            }
            _ => ("impossible layers", error.to_string()),
        };
        let tubes = design.build(site.reach()?).map_err(reason)?;
        let drawn = draws.taken();
        let layers = tubes.into_iter().enumerate().rev();
        let parts = layers.enumerate().map(|(place, (at, tube))| {
            let from = match place {
                0 => TakesFrom::ParentItself,
                _ => TakesFrom::Part(place - 1),
            };
            self.layer(at + 1, Body::Shell(tube), from, &drawn)
        });
        Ok(Made::of(parts.collect()))
    }

    /// Layers of a unit: the first one from the unit itself, each higher one from that below it.
    fn unit(&self, site: &Site<'_>, course: Course, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let impossible = |message: String| ("no unit", message);
        let (Frame::Unit(base), Some(top)) = (site.frame, site.top) else {
            return Err(impossible("its base or its top is no horizon".to_owned()));
        };
        if course == Course::Proportional {
            check_thickness(site, [base, top])?;
        }
        let (low, high) = site.room.corners();
        let drawn = draws.taken();
        let mut parts = vec![self.layer(
            1,
            Body::Side(Arc::new(Side::everywhere())),
            TakesFrom::ParentItself,
            &drawn,
        )];
        for (at, surface) in trend::between(base, top, self.steps, course)
            .into_iter()
            .enumerate()
        {
            let side =
                Side::horizon(surface, low, high).map_err(|error| impossible(error.to_string()))?;
            let body = Body::Side(Arc::new(side));
            parts.push(self.layer(at + 2, body, TakesFrom::Part(at), &drawn));
        }
        Ok(Made::of(parts))
    }

    /// One layer, with its place in the whole: properties that follow the trend have their values there.
    fn layer(&self, layer: usize, body: Body, from: TakesFrom, drawn: &[(String, f64)]) -> Part {
        Part {
            name: format!("-{layer}"),
            from,
            drawn: drawn.to_vec(),
            fraction: Some(trend::fraction(layer, self.steps)),
            ..Part::of(body)
        }
    }
}

/// Proportional surfaces of a unit that ends would all meet there.
fn check_thickness(site: &Site<'_>, [base, top]: [&Horizon; 2]) -> Result<(), Reason> {
    let (low, high) = site.room.corners();
    let least = (0..ASKED * ASKED)
        .map(|k| {
            let part = |i: usize| i as f64 / (ASKED - 1) as f64;
            let x = low.x + (high.x - low.x) * part(k % ASKED);
            let y = low.y + (high.y - low.y) * part(k / ASKED);
            (top.height(x, y) - base.height(x, y), x, y)
        })
        .min_by(|a, b| a.0.total_cmp(&b.0));
    match least {
        Some((thickness, x, y)) if !(thickness > 0.0) => Err((
            "unit ends in the domain",
            format!(
                "its unit ends in the domain, as at ({x:.0}, {y:.0}), where surfaces that divide it proportionally would all meet: \
                 write between = \"base\" or \"top\" with a `spacing`"
            ),
        )),
        _ => Ok(()),
    }
}

/// What a trend divides.
enum Divided {
    Channel,
    /// A unit, by what bounds it above.
    Unit(Bound),
}

impl Keys<'_, '_> {
    fn layer_surfaces(&self, field: Option<Field<u64>>) -> Option<usize> {
        let Some(field) = field else {
            return usize::try_from(STEPS).ok();
        };
        let (node, number) = field.good()?;
        if (1..=MOST_STEPS).contains(&number) {
            return usize::try_from(number).ok();
        }
        self.checker.reader.wrong(
            node,
            format!("{} has {number} steps", self.draft.name),
            format!("write a number of surfaces from 1 to {MOST_STEPS}"),
        );
        None
    }

    /// The parent: a channel, or the unit of a horizon up to the next one.
    fn divided(&self) -> Option<Divided> {
        let horizons = self.family.horizons();
        let above = |own: Option<usize>| {
            let next = horizons
                .iter()
                .map(|(at, _)| *at)
                .find(|at| own.is_none_or(|own| *at > own) && self.family.drafts[*at].enabled);
            Divided::Unit(next.map_or(Bound::Domain, Bound::Horizon))
        };
        let Some((node, name)) = &self.draft.parent else {
            return (!self.draft.wrong_parent()).then(|| above(None));
        };
        let &parent = self.family.index.get(name)?;
        if self.family.is_horizon(parent) {
            return Some(above(Some(parent)));
        }
        match self.family.drafts[parent].kind {
            Some(kind) if kind.name == "channel" => Some(Divided::Channel),
            Some(kind) => {
                self.checker.reader.wrong(
                    *node,
                    format!(
                        "{} has the parent {}, which is of the kind {}",
                        self.draft.name,
                        quoted(name),
                        kind.name
                    ),
                    "a trend divides a channel or the unit above a horizon: name a feature of one of these kinds",
                );
                None
            }
            None => None,
        }
    }
}
