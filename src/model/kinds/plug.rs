//! Abandonment plugs: mud that fills what a river left.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Part, Site, TakesFrom};
use crate::features::bends::{Bend, bends};
use crate::features::body::Body;
use crate::features::extrusion::ExtrusionError;
use crate::features::plug::{Abandoned, DEEPEST, PlugDesign, PlugError};
use crate::features::reach::Reach;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::values::limits::Limits;
use crate::model::values::quantity::Quantity;

/// Of the channel's depth, width and width, if left out.
const DEPTH_FRACTION: f64 = 0.5;
const WIDTH_FRACTION: f64 = 0.7;
const OFFSET_FRACTION: f64 = 0.1;
/// Bends turn by at least this angle (degrees).
const LEAST_TURN_DEG: f64 = 20.0;
/// More bends than any channel has.
const MOST_BENDS: u64 = 10_000;

/// As deep as the channel, it would touch its base.
const DEPTH: Limits = Limits {
    low: 0.05,
    high: DEEPEST,
    open: false,
    words: "must lie between 0.05 and 0.95 (a fraction of the channel's depth)",
};
/// As wide as the channel, three sheets would share its rims.
const WIDTH: Limits = Limits {
    low: 0.1,
    high: 0.95,
    open: false,
    words: "must lie between 0.1 and 0.95 (a fraction of the channel's width)",
};
const OFFSET: Limits = Limits {
    low: 0.0,
    high: 0.5,
    open: false,
    words: "must lie between 0 and 0.5 (a fraction of the channel's width)",
};

/// A plug: the fill of an abandoned channel.
#[derive(Clone, Debug, PartialEq)]
pub struct PlugSpec {
    /// Depth below the channel's top, as a fraction of the channel's.
    pub depth_fraction: Quantity,
    /// Width as a fraction of the channel's.
    pub width_fraction: Quantity,
    /// How much nearer to the outer bank it lies in the sharpest bend, as a fraction of the channel's width.
    pub offset_fraction: Quantity,
    /// Where it is.
    pub place: PlugPlace,
}

/// Which part of its channel a plug fills.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlugPlace {
    /// From one fraction of the channel's length to another.
    Between(f64, f64),
    /// A bend that was cut off, counted downstream from 1.
    Bend(usize),
}

/// A plug: what fills the upper part of a channel (`parent`) that its river left, most often mud.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlugFile {
    /// Depth below the channel's top, as a fraction of the channel's depth, between 0.05 and 0.95; 0.5 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) depth_fraction: Option<Field<Any>>,
    /// Width at the channel's top, as a fraction of the channel's width, between 0.1 and 0.95; 0.7 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) width_fraction: Option<Field<Any>>,
    /// How much nearer to the outer bank it lies in the channel's sharpest bend, as a fraction of the channel's width, between 0 and 0.5; 0.1 if left out. Elsewhere it is less, as the channel's curvature is.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) offset_fraction: Option<Field<Any>>,
    /// Where it begins, as a fraction of the channel's length; where that begins if left out. Within the channel it begins with an upright face.
    #[schemars(range(min = 0, max = 1))]
    pub(crate) from: Option<Field<f64>>,
    /// Where it ends, as a fraction of the channel's length; where that ends if left out. Within the channel it ends in an upright face.
    #[schemars(range(min = 0, max = 1))]
    pub(crate) to: Option<Field<f64>>,
    /// The bend that was cut off, counted downstream from 1 among those that turn by 20° or more and are longer than two widths: the plug fills this one alone, and thins out to nothing at both of its inflections. Not together with `from` and `to`.
    #[schemars(range(min = 1, max = 10000))]
    pub(crate) bend: Option<Field<u64>>,
}

impl Kind for PlugSpec {
    const NATURE: Nature = Nature {
        name: "plug",
        copies: Copies::OneEach("a plug in its channel"),
        within: Within::Only {
            kind: "channel",
            remedy: "a plug fills the upper part of a channel: name a feature of kind = \"channel\"",
        },
        children: Children::None {
            what: "a plug",
            instead: "its channel",
        },
        taking: Taking::ByKind {
            how: "a plug takes from its channel and from what lies in that, and nothing else",
            remedy: "leave it out",
        },
        volumes: Volumes::One,
        is_base: false,
        placed_by: "change `from`, `to` or `bend` of it, or its channel,",
        apart: "change `depth_fraction` or `width_fraction` of {name} a little",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        PlugFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: PlugFile = keys.table()?;
        let depth = keys.optional_quantity(file.depth_fraction, "depth_fraction", DEPTH);
        let width = keys.optional_quantity(file.width_fraction, "width_fraction", WIDTH);
        let offset = keys.optional_quantity(file.offset_fraction, "offset_fraction", OFFSET);
        let place = keys.plug_place(file.from, file.to, file.bend);
        let or =
            |given: Option<Quantity>, default: f64| given.unwrap_or(Quantity::Constant(default));
        Some(Self {
            depth_fraction: or(depth.ok()?, DEPTH_FRACTION),
            width_fraction: or(width.ok()?, WIDTH_FRACTION),
            offset_fraction: or(offset.ok()?, OFFSET_FRACTION),
            place: place?,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let reach = site.reach()?;
        let design = PlugDesign {
            depth: draws.quantity(&self.depth_fraction, "depth_fraction")?,
            width: draws.quantity(&self.width_fraction, "width_fraction")?,
            offset: draws.quantity(&self.offset_fraction, "offset_fraction")?,
            part: match self.place {
                PlugPlace::Between(from, to) => Abandoned::Between(from, to),
                PlugPlace::Bend(number) => Abandoned::Bend(bend(reach, number)?),
            },
        };
        let reason = |error: PlugError| match &error {
            PlugError::Extrusion(carried) if !matches!(**carried, ExtrusionError::Section(..)) => {
                ("surface out of tolerance", error.to_string())
            }
            _ => ("impossible section", error.to_string()),
        };
        let plug = design.build(reach).map_err(reason)?;
        Ok(Made::of(vec![Part {
            from: TakesFrom::Parent,
            drawn: draws.taken(),
            ..Part::of(Body::Shell(plug))
        }]))
    }
}

/// A bend of a channel by its number.
fn bend(reach: &Reach, number: usize) -> Result<Bend, Reason> {
    let width = reach.design().width.range().1;
    let all = bends(reach.trajectory(), width, LEAST_TURN_DEG.to_radians());
    all.get(number - 1).copied().ok_or_else(|| {
        let message = format!(
            "its channel has {} bends that turn by {LEAST_TURN_DEG}° or more and are longer than two widths, so there is no bend {number}",
            all.len()
        );
        ("no such bend", message)
    })
}

impl Keys<'_, '_> {
    fn plug_place(
        &self,
        from: Option<Field<f64>>,
        to: Option<Field<f64>>,
        bend: Option<Field<u64>>,
    ) -> Option<PlugPlace> {
        let name = &self.draft.name;
        let ends = [&from, &to]
            .into_iter()
            .flatten()
            .find_map(|end| match end {
                Field::Good(at, _) => Some(*at),
                Field::Missing | Field::Bad => None,
            });
        let [start, end] = [(from, 0.0, "from"), (to, 1.0, "to")].map(|(field, default, key)| {
            self.number_in(field, default, [0.0, 1.0], &self.what(key))
        });
        if let Some(bend) = bend {
            let (node, number) = bend.good()?;
            if let Some(at) = ends {
                self.checker.reader.wrong(
                    at,
                    format!("{name} has both a `bend` and a place along its channel"),
                    "a bend begins and ends at its inflections: leave out `from` and `to`, or `bend`",
                );
                return None;
            }
            if !(1..=MOST_BENDS).contains(&number) {
                self.checker.reader.wrong(
                    node,
                    format!("the bend of {name} is {number}"),
                    "bends are counted downstream, from 1",
                );
                return None;
            }
            return usize::try_from(number).ok().map(PlugPlace::Bend);
        }
        let (start, end) = (start?, end?);
        if start >= end {
            self.checker.reader.wrong(
                ends.unwrap_or(self.draft.node),
                format!("{name} begins at {start} of its channel's length and ends at {end}"),
                "`from` must be less than `to`",
            );
            return None;
        }
        Some(PlugPlace::Between(start, end))
    }
}
