//! Tilts: all that is older turns about a level axis.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Site};
use crate::features::motion::Affine;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::Nature;
use crate::model::read::{Any, Field};
use crate::model::values::limits::{AZIMUTH, PLUNGE};
use crate::model::values::quantity::Quantity;

/// A tilt of all that is older.
#[derive(Clone, Debug, PartialEq)]
pub struct TiltSpec {
    /// A point on the axis; the middle of the domain if absent.
    pub through: Option<[Quantity; 3]>,
    /// How what was level dips afterwards, degrees.
    pub dip_deg: Quantity,
    /// Where to, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
}

/// A tilt: all that is older has turned about a level axis, so that what was level dips.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TiltFile {
    /// A point, [x, y, z], that stays where it is, on the axis; the middle of the domain if left out.
    #[schemars(with = "Option<[Quantity; 3]>")]
    pub(crate) through: Option<Field<Any>>,
    /// How much what was level dips afterwards, in degrees, between -90 and 90.
    #[schemars(with = "Quantity")]
    pub(crate) dip_deg: Field<Any>,
    /// The direction in which it dips then, in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
}

impl Kind for TiltSpec {
    const NATURE: Nature = Nature::event("tilt", "a tilt moves all that is older");

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        TiltFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: TiltFile = keys.table()?;
        let through = keys.event_point(file.through);
        let dip = keys.quantity(file.dip_deg, "dip_deg", "dip_deg = 5", PLUNGE);
        let azimuth = keys.quantity(file.azimuth_deg, "azimuth_deg", "azimuth_deg = 90", AZIMUTH);
        Some(Self {
            through: through.ok()?,
            dip_deg: dip?,
            azimuth_deg: azimuth?,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let through = site.event_point(self.through.as_ref(), draws)?;
        let dip = draws.quantity(&self.dip_deg, "dip_deg")?.to_radians();
        let azimuth = draws
            .quantity(&self.azimuth_deg, "azimuth_deg")?
            .to_radians();
        let motion = Affine::tilt(through, dip, azimuth);
        let motion = motion.map_err(|error| ("no tilt", error.to_string()))?;
        Ok(Made::moving(motion, None))
    }
}
