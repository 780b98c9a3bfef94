//! Crevasse splays: what a flood leaves beside a channel, where it has breached the bank.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Part, Site};
use crate::features::body::Body;
use crate::features::fabric::Fabric;
use crate::features::levee::Bank;
use crate::features::reach::Reach;
use crate::features::splay::{Breaches, SplayDesign};
use crate::features::trajectory::azimuth_vector;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::values::bank::{Side, side_schema};
use crate::model::values::limits::{FRACTION, Limits, POSITIVE};
use crate::model::values::quantity::Quantity;

const ANGLE_DEG: f64 = 60.0;
/// Length in the channel's widths.
const LENGTH: f64 = 5.0;
/// Width as a fraction of the length.
const WIDTH: f64 = 0.5;
/// Thickness in the channel's depths.
const THICKNESS: f64 = 0.5;
/// The range of its base's depth below the channel's top, as a fraction of its thickness. It is drawn: of splays with bases at one level
/// these would coincide.
const EROSION: [f64; 2] = [0.05, 0.15];
const TAPER: f64 = 0.4;
const SKEW: f64 = 0.7;

const ANGLE: Limits = Limits {
    low: 10.0,
    high: 90.0,
    open: false,
    words: "must lie between 10 and 90 degrees, from the channel's direction downstream",
};
const SHAPE: Limits = Limits {
    low: -0.9,
    high: 0.9,
    open: false,
    words: "must lie between -0.9 and 0.9",
};

/// A crevasse splay.
#[derive(Clone, Debug, PartialEq)]
pub struct SplaySpec {
    /// Where the bank was breached, as a fraction of the channel's length; somewhere on an outer bank if absent.
    pub at: Option<Quantity>,
    /// Which bank; the outer one if absent.
    pub side: Option<Side>,
    /// Angle between the channel's direction downstream and the axis, degrees.
    pub angle_deg: Quantity,
    /// Length (m); some of the channel's widths if absent.
    pub length: Option<Quantity>,
    /// Width (m); half of the length if absent.
    pub width: Option<Quantity>,
    /// Greatest thickness (m); half of the channel's depth if absent.
    pub thickness: Option<Quantity>,
    /// Depth of the base below the channel's top as a fraction of the thickness; drawn if absent.
    pub erosion_fraction: Option<Quantity>,
    /// How much wider it is downstream.
    pub taper: Quantity,
    /// How much thicker it is upstream.
    pub skew: Quantity,
}

/// A crevasse splay: a lobe of what a flood carried through a breach in the bank of a channel (`along`).
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SplayFile {
    /// Where the bank was breached, as a fraction of the channel's length from 0 to 1; if left out, drawn over the outer banks of its bends in the domain, likelier where they are sharper.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) at: Option<Field<Any>>,
    /// Which bank, looking along the channel: "left" or "right"; the outer one if left out.
    #[schemars(schema_with = "side_schema")]
    #[serde(default)]
    pub(crate) side: Option<Field<String>>,
    /// Angle between the channel's direction downstream and the splay's axis in degrees, between 10 and 90; 60 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) angle_deg: Option<Field<Any>>,
    /// Length in metres, above 0; five of the channel's widths if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) length: Option<Field<Any>>,
    /// Width in metres, above 0; half of the length if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) width: Option<Field<Any>>,
    /// Greatest thickness in metres, above 0; half of the channel's depth if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) thickness: Option<Field<Any>>,
    /// Depth of its base below the channel's top, as a fraction of the thickness between 0 and 1; uniform between 0.05 and 0.15 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) erosion_fraction: Option<Field<Any>>,
    /// How much wider it is downstream than upstream, between -0.9 and 0.9; 0.4 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) taper: Option<Field<Any>>,
    /// How much thicker it is upstream than downstream, between -0.9 and 0.9; 0.7 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) skew: Option<Field<Any>>,
}

impl Kind for SplaySpec {
    const NATURE: Nature = Nature {
        name: "splay",
        copies: Copies::Any,
        within: Within::Along {
            kind: "channel",
            remedy: "splays go along a channel: write along = \"…\" with the id of a feature of kind = \"channel\"",
        },
        children: Children::Any,
        taking: Taking::ByRules,
        volumes: Volumes::One,
        is_base: false,
        placed_by: "set `at`",
        apart: "change `thickness` or `erosion_fraction` of {name} by {by} or more",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        SplayFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: SplayFile = keys.table()?;
        let at = keys.optional_quantity(file.at, "at", FRACTION);
        let side = keys.checker.side(file.side);
        let angle = keys.optional_quantity(file.angle_deg, "angle_deg", ANGLE);
        let length = keys.optional_quantity(file.length, "length", POSITIVE);
        let width = keys.optional_quantity(file.width, "width", POSITIVE);
        let thickness = keys.optional_quantity(file.thickness, "thickness", POSITIVE);
        let erosion = keys.optional_quantity(file.erosion_fraction, "erosion_fraction", FRACTION);
        let taper = keys.optional_quantity(file.taper, "taper", SHAPE);
        let skew = keys.optional_quantity(file.skew, "skew", SHAPE);
        let or =
            |given: Option<Quantity>, default: f64| given.unwrap_or(Quantity::Constant(default));
        Some(Self {
            at: at.ok()?,
            side: side.ok()?,
            angle_deg: or(angle.ok()?, ANGLE_DEG),
            length: length.ok()?,
            width: width.ok()?,
            thickness: thickness.ok()?,
            erosion_fraction: erosion.ok()?,
            taper: or(taper.ok()?, TAPER),
            skew: or(skew.ok()?, SKEW),
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let reach = site.reach()?;
        let (at, bank) = self.breach(site, reach, draws)?;
        let station = reach.station(at);
        let or = |draws: &mut Draws<'_>, given: &Option<Quantity>, name: &str, default: f64| {
            given
                .as_ref()
                .map_or(Ok(default), |given| draws.quantity(given, name))
        };
        let angle = draws.quantity(&self.angle_deg, "angle_deg")?.to_radians();
        let length = or(draws, &self.length, "length", LENGTH * station.width)?;
        let width = or(draws, &self.width, "width", WIDTH * length)?;
        let thickness = or(
            draws,
            &self.thickness,
            "thickness",
            THICKNESS * station.depth,
        )?;
        let erosion = match &self.erosion_fraction {
            Some(erosion) => draws.quantity(erosion, "erosion_fraction")?,
            None => draws.uniform(EROSION[0], EROSION[1], "erosion_fraction")?,
        };
        let design = SplayDesign {
            at,
            bank,
            angle,
            length,
            width,
            thickness,
            erosion,
            taper: draws.quantity(&self.taper, "taper")?,
            skew: draws.quantity(&self.skew, "skew")?,
        };
        let shell = design.shell(reach);
        let shell = shell.map_err(|error| ("impossible splay", error.to_string()))?;
        Ok(Made::of(vec![Part {
            drawn: draws.taken(),
            fabric: Some(Fabric::along(azimuth_vector(design.lobe(reach).azimuth))),
            ..Part::of(Body::Shell(shell))
        }]))
    }
}

impl SplaySpec {
    /// Where the bank was breached, and which one.
    fn breach(
        &self,
        site: &Site<'_>,
        reach: &Reach,
        draws: &mut Draws<'_>,
    ) -> Result<(f64, Bank), Reason> {
        let own = self.side.map(Side::bank);
        if let Some(at) = &self.at {
            let at = draws.quantity(at, "at")?;
            let bank = own.or_else(|| Bank::outer(reach.station(at).place.curvature));
            let bank = bank.ok_or_else(|| {
                let message =
                    "its channel is straight there, so it has no outer bank: set its `side`";
                ("no outer bank", message.to_owned())
            })?;
            return Ok((at, bank));
        }
        let breaches = Breaches::of(reach, &|place| {
            let bank = Bank::outer(place.curvature);
            let [x, y] = place.point.to_array();
            let within = |at: f64, [from, to]: [f64; 2]| (from..=to).contains(&at);
            within(x, site.domain.x)
                && within(y, site.domain.y)
                && own.is_none_or(|own| bank == Some(own))
        });
        let Some(breaches) = breaches else {
            let message = "its channel has no such bend in the domain: set `at`, a fraction of the channel's length, and `side`";
            return Err(("no outer bank", message.to_owned()));
        };
        let draw = draws.uniform(0.0, 1.0, "breach")?;
        Ok(breaches.at(draw))
    }
}
