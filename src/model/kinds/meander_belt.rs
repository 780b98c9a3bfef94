//! Meander belts: a channel that migrates, position after position.

use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::channel::ChannelSpec;
use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Outcome, Part, Site, TakesFrom, VolumeName};
use crate::features::body::Body;
use crate::features::channel::{ChannelDesign, Origin};
use crate::features::fabric::Fabric;
use crate::features::meander::SineGenerated;
use crate::features::migration::Migration;
use crate::features::profile::Profile as Along;
use crate::model::draws::{Draws, Reason, diagonal};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;
use crate::model::values::bent::BentProfile;
use crate::model::values::limits::{ANY, ASYMMETRY, AZIMUTH, Limits, POSITIVE};
use crate::model::values::quantity::Quantity;
use crate::model::values::trajectory;
use crate::model::values::tuple::Tuple;

/// Positions if left out.
const STEPS: u64 = 6;
/// Most positions.
const MOST_STEPS: u64 = 50;
/// How much higher each position is, in depths, if left out.
const AGGRADATION: f64 = 0.02;
/// How far lines run past the domain, as a fraction of its diagonal in plan; two widths are added.
const OVERSHOOT: f64 = 0.05;
/// As the usual channel's.
const ANGLE_LIMIT_DEG: f64 = 15.0;
const TOLERANCE: f64 = 0.01;

/// With none, positions would touch along their thalwegs.
const RISE: Limits = Limits {
    low: 0.001,
    high: 1.0,
    open: false,
    words: "must lie between 0.001 and 1 (a fraction of the depth)",
};

/// A meander belt.
#[derive(Clone, Debug, PartialEq)]
pub struct MeanderBeltSpec {
    /// Width of the channel's top.
    pub width: Quantity,
    /// Depth of its thalweg.
    pub depth: Quantity,
    /// Offset of its thalweg to the right of the centre, as a fraction of the width.
    pub asymmetry: BentProfile,
    /// Elevation of the first position's top; chosen as a channel's if absent.
    pub top: Option<Quantity>,
    /// Positions.
    pub steps: usize,
    /// Half of peak to peak of the first and of the last position.
    pub amplitude: [Quantity; 2],
    /// Length of one meander along the belt.
    pub wavelength: Quantity,
    /// Direction of the belt, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
    /// A point of the belt's axis; uniform over the domain if absent.
    pub center: Option<[Quantity; 2]>,
    /// Where the first position is in its meander at the centre, as a fraction of a wavelength; uniform if absent.
    pub phase: Option<Quantity>,
    /// How far the last position lies down the valley from the first one.
    pub shift: Quantity,
    /// How much higher each position is than the one before, as a fraction of the depth.
    pub aggradation_fraction: Quantity,
}

/// A meander belt: a meandering channel that migrates. Each position removes the older ones where it crosses them, and what is left of these are scrolls.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeanderBeltFile {
    /// Width of the channel's top in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) width: Field<Any>,
    /// Depth of the channel's deepest point below its top, in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) depth: Field<Any>,
    /// How far right of the centre the deepest point lies, as a fraction of the width, between -0.5 and 0.5; `{ by_curvature = 0.2 }` moves it towards the outer banks of bends; 0 if left out.
    #[schemars(with = "Option<BentProfile>")]
    pub(crate) asymmetry: Option<Field<Any>>,
    /// Elevation of the first position's top in metres; if left out, uniform between where the belt just fits into the domain above its base and below its top.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) top: Option<Field<Any>>,
    /// Positions of the channel; 6 if left out.
    #[schemars(range(min = 2, max = 50))]
    pub(crate) steps: Option<Field<u64>>,
    /// Half of peak to peak of the first and of the last position, [first, last], in metres: meanders grow from one to the other.
    #[schemars(with = "[Quantity; 2]")]
    pub(crate) amplitude: Field<Any>,
    /// Length of one meander along the belt in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) wavelength: Field<Any>,
    /// Direction of the belt in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
    /// A point of the belt's axis, [x, y]; uniform over the domain if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Where in its meander the first position is at the centre, as a fraction of a wavelength; uniform if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) phase: Option<Field<Any>>,
    /// How far down the valley the last position lies from the first one, in metres; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) shift: Option<Field<Any>>,
    /// How much higher each position is than the one before it, as a fraction of the depth, between 0.001 and 1; 0.02 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) aggradation_fraction: Option<Field<Any>>,
}

impl Kind for MeanderBeltSpec {
    const NATURE: Nature = Nature {
        name: "meander-belt",
        copies: Copies::OneEach("a meander belt where it lies: for others write several features"),
        within: Within::Anything,
        children: Children::None {
            what: "a meander belt",
            instead: "a channel",
        },
        taking: Taking::ByRules,
        volumes: Volumes::Many {
            most: MOST_STEPS,
            one: "position",
        },
        is_base: false,
        placed_by: "set its `top` and its `center`",
        apart: "change `top`, `depth`, `width` or `aggradation_fraction` of {name} by {by} or more",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        MeanderBeltFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: MeanderBeltFile = keys.table()?;
        let width = keys.quantity(file.width, "width", "width = 50", POSITIVE);
        let depth = keys.quantity(file.depth, "depth", "depth = 5", POSITIVE);
        let asymmetry = keys.optional_bent_profile(file.asymmetry, "asymmetry", ASYMMETRY);
        let top = keys.optional_quantity(file.top, "top", ANY);
        let steps = keys.steps(file.steps);
        let amplitude = keys
            .need(file.amplitude, "amplitude", "amplitude = [40, 120]")
            .and_then(|(node, Any)| keys.amplitudes(node));
        let wavelength = keys.quantity(file.wavelength, "wavelength", "wavelength = 475", POSITIVE);
        let azimuth = keys.quantity(file.azimuth_deg, "azimuth_deg", "azimuth_deg = 45", AZIMUTH);
        let center = match file.center {
            None => Some(None),
            Some(field) => field
                .good()
                .and_then(|(node, Any)| keys.axis_point(node))
                .map(Some),
        };
        let phase = keys.optional_quantity(file.phase, "phase", ANY);
        let shift = keys.optional_quantity(file.shift, "shift", ANY);
        let rise = keys.optional_quantity(file.aggradation_fraction, "aggradation_fraction", RISE);
        Some(Self {
            width: width?,
            depth: depth?,
            asymmetry: asymmetry.ok()?.unwrap_or(BentProfile::from(0.0)),
            top: top.ok()?,
            steps: steps?,
            amplitude: amplitude?,
            wavelength: wavelength?,
            azimuth_deg: azimuth?,
            center: center?,
            phase: phase.ok()?,
            shift: shift.ok()?.unwrap_or(Quantity::Constant(0.0)),
            aggradation_fraction: rise.ok()?.unwrap_or(Quantity::Constant(AGGRADATION)),
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let domain = site.domain;
        let width = draws.quantity(&self.width, "width")?;
        let depth = draws.quantity(&self.depth, "depth")?;
        let asymmetry = self.asymmetry.draw(draws, "asymmetry")?;
        let rise = depth * draws.quantity(&self.aggradation_fraction, "aggradation_fraction")?;
        let top = if let Some(top) = &self.top {
            draws.quantity(top, "top")?
        } else {
            let lowest = domain.z[0] + depth;
            let highest = domain.z[1] - rise * (self.steps - 1) as f64;
            if !(lowest <= highest) {
                let message = format!(
                    "the belt is {:.2} m high and the domain {:.2} m: make it shallower or give it a `top`",
                    depth + domain.z[1] - highest,
                    domain.z[1] - domain.z[0]
                );
                return Err(("higher than the domain", message));
            }
            draws.uniform(lowest, highest, "top")?
        };
        let overshoot = 2.0 * width + OVERSHOOT * diagonal(domain) + site.beyond();
        let migration = self.migration(site, overshoot, rise, draws)?;
        let drawn = draws.taken();
        let mut parts = Vec::with_capacity(self.steps);
        for at in 0..self.steps {
            let (line, above) = migration
                .position(at)
                .map_err(|error| (trajectory::rejection(&error), of(at, &error)))?;
            let line = Arc::new(line);
            let design = ChannelDesign {
                width: Along::Constant(width),
                depth: Along::Constant(depth),
                own: None,
                asymmetry: asymmetry.clone().along(&line),
                left_angle: None,
                right_angle: None,
                top: Along::Constant(top + above),
                origin: Origin::TopCentre,
                angle_limit: ANGLE_LIMIT_DEG.to_radians(),
                tolerance: TOLERANCE,
            };
            let trough = design
                .build(&line)
                .map_err(|error| (error.reason(), of(at, &error)))?;
            let (low, high) = domain.corners();
            let direction = line.mean_direction(low.truncate(), high.truncate());
            parts.push(Part {
                name: format!("-{}", at + 1),
                fabric: direction.map(Fabric::along),
                from: TakesFrom::Anything,
                drawn: drawn.clone(),
                ..Part::of(Body::Trough(trough))
            });
        }
        Ok(Made::of(parts))
    }

    /// What `3` is.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        VolumeName::numbered(rest, self.steps)
    }

    fn meshing(made: &[Outcome<'_>]) -> Option<String> {
        ChannelSpec::meshing(made)
    }
}

/// What is wrong with a position, from 0.
fn of(at: usize, error: &dyn std::error::Error) -> String {
    format!("position {}: {error}", at + 1)
}

impl MeanderBeltSpec {
    fn migration(
        &self,
        site: &Site<'_>,
        overshoot: f64,
        rise: f64,
        draws: &mut Draws<'_>,
    ) -> Result<Migration, Reason> {
        let domain = site.domain;
        let [first, last] = &self.amplitude;
        let amplitude = draws.quantity(first, "amplitude.first")?;
        let last_amplitude = draws.quantity(last, "amplitude.last")?;
        let wavelength = draws.quantity(&self.wavelength, "wavelength")?;
        let azimuth = draws
            .quantity(&self.azimuth_deg, "azimuth_deg")?
            .to_radians();
        let center = draws.center(self.center.as_ref(), domain, "center")?;
        let phase = match &self.phase {
            Some(phase) => draws.quantity(phase, "phase")?,
            None => draws.uniform(0.0, 1.0, "phase")?,
        };
        let extent = trajectory::extent(None, domain, center, azimuth, overshoot, draws)?;
        Ok(Migration {
            first: SineGenerated {
                amplitude,
                wavelength,
                azimuth,
                center,
                phase,
                extent,
            },
            last_amplitude,
            shift: draws.quantity(&self.shift, "shift")?,
            rise,
            steps: self.steps,
        })
    }
}

impl Keys<'_, '_> {
    fn steps(&self, field: Option<Field<u64>>) -> Option<usize> {
        let Some(field) = field else {
            return usize::try_from(STEPS).ok();
        };
        let (node, number) = field.good()?;
        if (2..=MOST_STEPS).contains(&number) {
            return usize::try_from(number).ok();
        }
        self.checker.reader.wrong(
            node,
            format!("{} has {number} steps", self.draft.name),
            format!("write a number of positions from 2 to {MOST_STEPS}; one is a channel"),
        );
        None
    }

    fn amplitudes(&self, node: NodeId) -> Option<[Quantity; 2]> {
        let tuple = Tuple {
            what: self.what("amplitude"),
            names: ["first", "last"],
            limits: POSITIVE,
            remedy: "write the amplitudes of the first and of the last position in [ ], in metres",
        };
        tuple.read(&self.checker.reader, node)
    }

    fn axis_point(&self, node: NodeId) -> Option<[Quantity; 2]> {
        let tuple = Tuple {
            what: self.what("center"),
            names: ["x", "y"],
            limits: ANY,
            remedy: "write the two coordinates in [ ], in metres",
        };
        tuple.read(&self.checker.reader, node)
    }
}
