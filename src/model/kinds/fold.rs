//! Folds: all that is older moves along axial planes.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Site};
use crate::features::motion::{FoldDesign, FoldShape};
use crate::model::draws::{Draws, Reason};
use crate::model::nature::Nature;
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;
use crate::model::values::limits::{ANY, AZIMUTH, Limits, PLUNGE, POSITIVE};
use crate::model::values::quantity::{Quantity, quantity};

/// A similar fold of all that is older.
#[derive(Clone, Debug, PartialEq)]
pub struct FoldSpec {
    /// A point on an axial plane; the middle of the domain if absent.
    pub through: Option<[Quantity; 3]>,
    /// Where the axial plane dips to, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
    /// How it dips, degrees; 90 is upright.
    pub axial_dip_deg: Quantity,
    /// How the axis plunges in it, degrees.
    pub plunge_deg: Quantity,
    /// The folds along it.
    pub folds: Folds,
    /// How far what it moves may be from where it should be (m); by the domain's size if absent.
    pub tolerance: Option<f64>,
}

/// What folds there are.
#[derive(Clone, Debug, PartialEq)]
pub enum Folds {
    /// Waves.
    Train {
        /// Half of the height along the axial planes (m).
        amplitude: Quantity,
        /// Across the axial planes (m).
        wavelength: Quantity,
        /// Where on the wave the fold's point lies, as a fraction of the wavelength.
        phase: Quantity,
    },
    /// One antiform with its synform.
    Pair {
        /// By how much level beds come to lie higher beyond it (m).
        height: Quantity,
        /// The greatest slope of the displacement along the axial planes.
        tightness: Quantity,
    },
}

/// A similar fold: all that is older has moved along its axial planes, each place by an amount that depends on its distance across them. Volumes are kept.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FoldFile {
    /// A point, [x, y, z], on an axial plane: of a pair in the middle of the limb between antiform and synform. The middle of the domain if left out.
    #[schemars(with = "Option<[Quantity; 3]>")]
    pub(crate) through: Option<Field<Any>>,
    /// Direction in which the axial planes dip, in degrees, clockwise from north; the fold verges the other way, and its axis runs across.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
    /// Dip of the axial planes in degrees, above 0 (recumbent) to 90 (upright, if left out).
    #[schemars(with = "Option<Quantity>")]
    pub(crate) axial_dip_deg: Option<Field<Any>>,
    /// Plunge of the axis in degrees, downwards to the left of the direction of dip; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) plunge_deg: Option<Field<Any>>,
    /// Folds one behind the other: { amplitude = 20, wavelength = 400 }. This or `pair`.
    #[schemars(with = "Option<TrainFile>")]
    pub(crate) train: Option<Field<Any>>,
    /// One antiform with its synform: { height = 60, tightness = 15 }.
    #[schemars(with = "Option<PairFile>")]
    pub(crate) pair: Option<Field<Any>>,
    /// How far what it moves may be from where it should be, in metres, above 0; a hundred-thousandth of the domain's diagonal if left out.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub(crate) tolerance: Option<Field<f64>>,
}

/// A train of folds.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FoldTrain")]
pub(crate) struct TrainFile {
    /// Half of the folds' height, along the axial planes, in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) amplitude: Field<Any>,
    /// Their wavelength across the axial planes, in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) wavelength: Field<Any>,
    /// Where on the wave the fold's point lies, as a fraction of the wavelength, rising where it is 0; 0.25, an antiform, if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) phase: Option<Field<Any>>,
}

/// An antiform with its synform.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FoldPair")]
pub(crate) struct PairFile {
    /// By how much level beds lie higher beyond it, in the direction of vergence's back, in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) height: Field<Any>,
    /// How fast the displacement along the axial planes changes across them at most, above 0; 15 if left out. Level beds overhang where it is above 1/(sin dip · cos dip).
    #[schemars(with = "Option<Quantity>")]
    pub(crate) tightness: Option<Field<Any>>,
}

/// Of axial planes.
const AXIAL: Limits = Limits {
    low: 0.0,
    high: 90.0,
    open: false,
    words: "must lie above 0 (recumbent) and not above 90 degrees (upright)",
};
/// Of a pair.
const USUAL_TIGHTNESS: f64 = 15.0;
/// Of a train, at the fold's point.
const ANTIFORM: f64 = 0.25;

impl Kind for FoldSpec {
    const NATURE: Nature = Nature::event("fold", "a fold moves all that is older");

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        FoldFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: FoldFile = keys.table()?;
        let through = keys.event_point(file.through);
        let azimuth = keys.quantity(file.azimuth_deg, "azimuth_deg", "azimuth_deg = 90", AZIMUTH);
        let axial = keys.optional_quantity(file.axial_dip_deg, "axial_dip_deg", AXIAL);
        let plunge = keys.optional_quantity(file.plunge_deg, "plunge_deg", PLUNGE);
        let folds = match (file.train, file.pair) {
            (Some(train), None) => train.good().and_then(|(node, Any)| keys.train(node)),
            (None, Some(pair)) => pair.good().and_then(|(node, Any)| keys.pair(node)),
            (both, _) => {
                let (node, name) = (keys.draft.node, &keys.draft.name);
                let message = match both {
                    Some(_) => format!("{name} has both `train` and `pair`"),
                    None => format!("{name} has no folds"),
                };
                let remedy =
                    "write train = { amplitude = 20, wavelength = 400 } or pair = { height = 60 }";
                keys.checker.reader.wrong(node, message, remedy);
                None
            }
        };
        let tolerance = keys.tolerance(file.tolerance);
        Some(Self {
            through: through.ok()?,
            azimuth_deg: azimuth?,
            axial_dip_deg: axial.ok()?.unwrap_or(Quantity::Constant(90.0)),
            plunge_deg: plunge.ok()?.unwrap_or(Quantity::Constant(0.0)),
            folds: folds?,
            tolerance: tolerance.ok()?,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let through = site.event_point(self.through.as_ref(), draws)?;
        let azimuth = draws
            .quantity(&self.azimuth_deg, "azimuth_deg")?
            .to_radians();
        let axial_dip = draws
            .quantity(&self.axial_dip_deg, "axial_dip_deg")?
            .to_radians();
        let plunge = draws.quantity(&self.plunge_deg, "plunge_deg")?.to_radians();
        // Where contacts coincide folds are a little higher, so that beds come to lie along none.
        let more = -site.nudge;
        let shape = match &self.folds {
            Folds::Train {
                amplitude,
                wavelength,
                phase,
            } => {
                let wavelength = draws.quantity(wavelength, "train.wavelength")?;
                FoldShape::Train {
                    amplitude: draws.quantity(amplitude, "train.amplitude")? + more,
                    wavelength,
                    phase: draws.quantity(phase, "train.phase")? * wavelength,
                }
            }
            Folds::Pair { height, tightness } => {
                let height = draws.quantity(height, "pair.height")? + more;
                let tightness = draws.quantity(tightness, "pair.tightness")?;
                FoldShape::pair(height, axial_dip, tightness)
            }
        };
        let design = FoldDesign {
            through,
            azimuth,
            axial_dip,
            plunge,
            shape,
        };
        let motion = design
            .build()
            .map_err(|error| ("no fold", error.to_string()))?;
        Ok(Made::moving(motion, self.tolerance))
    }
}

impl Keys<'_, '_> {
    fn train(&self, node: NodeId) -> Option<Folds> {
        let what = self.what("train");
        let reader = &self.checker.reader;
        let file: TrainFile = reader.table(node)?;
        reader.close(node, &what);
        let number = |field: Field<Any>, key: &str, example: &str, limits: Limits| {
            let (at, Any) = reader.need(field, node, &what, key, example)?;
            quantity(reader, at, &format!("the {key} of {what}"), limits)
        };
        let amplitude = number(file.amplitude, "amplitude", "amplitude = 20", POSITIVE);
        let wavelength = number(file.wavelength, "wavelength", "wavelength = 400", POSITIVE);
        let phase = match file.phase {
            None => Some(Quantity::Constant(ANTIFORM)),
            Some(phase) => number(phase, "phase", "", ANY),
        };
        Some(Folds::Train {
            amplitude: amplitude?,
            wavelength: wavelength?,
            phase: phase?,
        })
    }

    fn pair(&self, node: NodeId) -> Option<Folds> {
        let what = self.what("pair");
        let reader = &self.checker.reader;
        let file: PairFile = reader.table(node)?;
        reader.close(node, &what);
        let number = |field: Field<Any>, key: &str, example: &str| {
            let (at, Any) = reader.need(field, node, &what, key, example)?;
            quantity(reader, at, &format!("the {key} of {what}"), POSITIVE)
        };
        let height = number(file.height, "height", "height = 60");
        let tightness = match file.tightness {
            None => Some(Quantity::Constant(USUAL_TIGHTNESS)),
            Some(tightness) => number(tightness, "tightness", ""),
        };
        Some(Folds::Pair {
            height: height?,
            tightness: tightness?,
        })
    }
}
