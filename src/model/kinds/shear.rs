//! Simple shear: planes of all that is older slide over one another.

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Site};
use crate::features::motion::Affine;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::Nature;
use crate::model::read::{Any, Field};
use crate::model::tree::quoted;
use crate::model::values::limits::{AZIMUTH, Limits};
use crate::model::values::quantity::Quantity;

/// A simple shear of all that is older.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearSpec {
    /// A point that stays; the middle of the domain if absent.
    pub through: Option<[Quantity; 3]>,
    /// Whether upright planes slide, downwards along the azimuth; otherwise level ones do, those above along the azimuth.
    pub is_upright: bool,
    /// By how much lines across the planes lean afterwards, degrees.
    pub angle_deg: Quantity,
    /// Where to, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
}

/// Simple shear: planes of all that is older have slid over one another. Volumes are kept.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShearFile {
    /// A point, [x, y, z], that stays where it is; the middle of the domain if left out.
    #[schemars(with = "Option<[Quantity; 3]>")]
    pub(crate) through: Option<Field<Any>>,
    /// "level" (the default): level planes slide, those above the point along the azimuth, so that what was upright leans; "upright": upright planes slide, those along the azimuth downwards, so that what was level dips.
    #[schemars(schema_with = "planes")]
    #[serde(default)]
    pub(crate) planes: Option<Field<String>>,
    /// By how much what was at right angles to the planes leans, in degrees, between -80 and 80.
    #[schemars(with = "Quantity")]
    pub(crate) angle_deg: Field<Any>,
    /// The direction, in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
}

fn planes(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["level", "upright"] })
}

/// Of what was at right angles to the planes.
const ANGLE: Limits = Limits {
    low: -80.0,
    high: 80.0,
    open: false,
    words: "must lie between -80 and 80 degrees",
};

impl Kind for ShearSpec {
    const NATURE: Nature = Nature::event("shear", "shear moves all that is older");

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        ShearFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: ShearFile = keys.table()?;
        let through = keys.event_point(file.through);
        let is_upright = match file.planes.map(Field::good) {
            None => Some(false),
            Some(None) => None,
            Some(Some((at, word))) => match word.as_str() {
                "level" => Some(false),
                "upright" => Some(true),
                _ => {
                    keys.checker.reader.wrong(
                        at,
                        format!("there are no planes {}", quoted(&word)),
                        "write \"level\" or \"upright\"",
                    );
                    None
                }
            },
        };
        let angle = keys.quantity(file.angle_deg, "angle_deg", "angle_deg = 10", ANGLE);
        let azimuth = keys.quantity(file.azimuth_deg, "azimuth_deg", "azimuth_deg = 90", AZIMUTH);
        Some(Self {
            through: through.ok()?,
            is_upright: is_upright?,
            angle_deg: angle?,
            azimuth_deg: azimuth?,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let through = site.event_point(self.through.as_ref(), draws)?;
        let slope = draws
            .quantity(&self.angle_deg, "angle_deg")?
            .to_radians()
            .tan();
        let azimuth = draws
            .quantity(&self.azimuth_deg, "azimuth_deg")?
            .to_radians();
        let towards = DVec3::new(azimuth.sin(), azimuth.cos(), 0.0);
        let (normal, by) = if self.is_upright {
            (towards, -slope * DVec3::Z)
        } else {
            (DVec3::Z, slope * towards)
        };
        let motion = Affine::shear(through, normal, by);
        let motion = motion.map_err(|error| ("no shear", error.to_string()))?;
        Ok(Made::moving(motion, None))
    }
}
