//! Faults: what lies above one moves against what lies below.

use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Event, Made, Site, Wall};
use crate::features::body::Body;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Gives, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::tree::{NodeId, quoted};
use crate::model::values::fault::{FaultSurfaceFile, FaultSurfaceSpec, fault_surface};
use crate::model::values::limits::{Limits, NOT_NEGATIVE};
use crate::model::values::quantity::Quantity;

/// A fault: all that is older and lies above it has moved against what lies below.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultSpec {
    /// Where it runs.
    pub surface: FaultSurfaceSpec,
    /// How far it has moved, along its strike.
    pub slip: Slip,
    /// Which way the hanging wall has moved, in degrees in its plane from the strike: -90 down (normal), 90 up (reverse), 0 and 180 along the
    /// strike (left-lateral, right-lateral).
    pub rake_deg: Quantity,
    /// Its tip line, if its displacement dies out towards one.
    pub tip: Option<Tip>,
    /// Of what is bent: by how much lines of shear lean from the vertical, degrees; antithetic above 0.
    pub shear_deg: Quantity,
    /// The part of the displacement by which the footwall moves, the other way.
    pub footwall_share: Quantity,
    /// The fault on which it ends, and on which side of that it lies.
    pub ends_on: Option<(Reference, Wall)>,
    /// How far what it moves may be from where it should be (m); by the domain's size if absent.
    pub tolerance: Option<f64>,
}

/// How far a fault has moved; by fractions of the domain's extent along strike, where it varies.
#[derive(Clone, Debug, PartialEq)]
pub enum Slip {
    /// Vertically.
    Throw(Profile),
    /// Along its slip.
    Displacement(Profile),
    /// In plan, across its strike.
    Heave(Profile),
}

/// An ellipse in the fault's plane, about its point, along which there is no displacement.
#[derive(Clone, Debug, PartialEq)]
pub struct Tip {
    /// Along strike (m).
    pub length: Quantity,
    /// Down dip (m).
    pub height: Quantity,
    /// How the displacement falls towards it.
    pub law: Law,
}

/// A fault: all that is older and lies above it, in its hanging wall, has moved against what lies below. It parts every older volume in blocks: "bed@f.hw" in the hanging wall of f, "bed@f.fw" in its footwall.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FaultFile {
    /// Where it runs: a plane, a listric surface, a section across it, or heights over the plan.
    #[schemars(schema_with = "fault_surface_schema")]
    pub(crate) surface: Field<Any>,
    /// How far the hanging wall has moved vertically, in metres, not below 0 (which way is said by `rake_deg`): a number, or a list of [fraction, throw] along strike through the domain. This, `displacement` or `heave`.
    #[schemars(with = "Option<Profile>")]
    pub(crate) throw: Option<Field<Any>>,
    /// How far the hanging wall has moved along its slip, likewise.
    #[schemars(with = "Option<Profile>")]
    pub(crate) displacement: Option<Field<Any>>,
    /// How far the hanging wall has moved in plan, away from the footwall if it moves down, likewise. It is what a listric fault needs, or one of heights: there the throw differs from place to place.
    #[schemars(with = "Option<Profile>")]
    pub(crate) heave: Option<Field<Any>>,
    /// Which way the hanging wall has moved, in degrees in the fault's plane from its strike (which has the dip on its right): -90, if left out, is down the dip (a normal fault), 90 up (reverse), 0 left-lateral, 180 right-lateral.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) rake_deg: Option<Field<Any>>,
    /// Of a plane: the tip line, an ellipse about its point towards which the displacement dies out, outside of the domain: { length = 4000, height = 2000 }.
    #[schemars(with = "Option<TipFile>")]
    pub(crate) tip: Option<Field<Any>>,
    /// Of a fault that is bent: by how much the lines along which the hanging wall is sheared lean from the vertical, in degrees, above 0 towards the fault (antithetic); 0, vertical shear, if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) shear_deg: Option<Field<Any>>,
    /// The part of the displacement by which the footwall moves, the other way; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) footwall_share: Option<Field<Any>>,
    /// An older fault on which it ends, and on which side of that it lies: { fault = "master", side = "hanging-wall" }.
    #[schemars(with = "Option<EndsOnFile>")]
    pub(crate) ends_on: Option<Field<Any>>,
    /// How far what it moves may be from where it should be, in metres, above 0; a hundred-thousandth of the domain's diagonal if left out. Where the slip is the same everywhere nothing is off.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub(crate) tolerance: Option<Field<f64>>,
}

/// Where a displacement dies out.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Tip")]
pub(crate) struct TipFile {
    /// Length of the ellipse along strike, in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) length: Field<Any>,
    /// Height of the ellipse down dip, in metres, above 0; its length divided by 2.15 if left out (Nicol et al. 1996).
    #[schemars(with = "Option<Quantity>")]
    pub(crate) height: Option<Field<Any>>,
    /// "walsh-watterson" (the default; 1987), "linear" or "bell": how the displacement falls from the fault's point to the tip line.
    #[schemars(schema_with = "laws")]
    pub(crate) profile: Option<Field<String>>,
}

fn laws(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["walsh-watterson", "linear", "bell"] })
}

/// Where a fault ends.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "EndsOn")]
pub(crate) struct EndsOnFile {
    /// The id of the other fault, which comes before it in the list.
    pub(crate) fault: Field<String>,
    /// "hanging-wall": it lies above the other fault; "footwall": below it.
    pub(crate) side: Field<String>,
}

/// Of a rake.
const RAKE: Limits = Limits {
    low: -180.0,
    high: 180.0,
    open: false,
    words: "must lie between -180 and 180 degrees: -90 is normal, 90 reverse, 0 left-lateral, 180 right-lateral",
};
/// A throw needs a slip this far from level at least (sine of its plunge).
const LEAST_PLUNGE: f64 = 1e-3;

impl Kind for FaultSpec {
    const NATURE: Nature = Nature {
        name: "fault",
        copies: Copies::Any,
        within: Within::Domain {
            why: "a fault moves all that is older",
            remedy: "leave `parent` out; to end it on another fault write ends_on = { fault = \"…\", side = \"hanging-wall\" }",
        },
        children: Children::None {
            what: "a fault",
            instead: "what lies beside the fault",
        },
        taking: Taking::ByKind {
            how: "a fault removes nothing",
            remedy: "leave it out",
        },
        volumes: Volumes::None,
        is_base: false,
        placed_by: "set its `surface`",
        apart: "move {name}, or change its throw, by {by} or more",
    };

    const GIVES: Gives = Gives::Fault;

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        FaultFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: FaultFile = keys.table()?;
        let example =
            "surface = { dipping = { through = [500, 500, -50], dip_deg = 60, azimuth_deg = 90 } }";
        let surface = keys
            .need(file.surface, "surface", example)
            .and_then(|(node, Any)| fault_surface(keys, node));
        let slip = keys.slip([
            ("throw", file.throw),
            ("displacement", file.displacement),
            ("heave", file.heave),
        ]);
        let rake = keys.optional_quantity(file.rake_deg, "rake_deg", RAKE);
        let shear = keys.optional_quantity(file.shear_deg, "shear_deg", SHEAR);
        let share = keys.optional_quantity(file.footwall_share, "footwall_share", FRACTION);
        let tip = good(file.tip, |node| keys.tip(node));
        let ends_on = good(file.ends_on, |node| keys.ends_on(node));
        let tolerance = keys.tolerance(file.tolerance);
        let none = || Quantity::Constant(0.0);
        Some(Self {
            surface: surface?,
            slip: slip?,
            rake_deg: rake.ok()?.unwrap_or(Quantity::Constant(-90.0)),
            tip: tip?,
            shear_deg: shear.ok()?.unwrap_or_else(none),
            footwall_share: share.ok()?.unwrap_or_else(none),
            ends_on: ends_on?,
            tolerance: tolerance?,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        // Where contacts coincide it lies a little aside, and has moved a little more, so that beds come to lie beside none.
        let surface = self.surface.draw(site, site.nudge * ASIDE, draws)?;
        let slipped = Slipped {
            rake: draws.quantity(&self.rake_deg, "rake_deg")?.to_radians(),
            shear: draws.quantity(&self.shear_deg, "shear_deg")?.to_radians(),
            more: -site.nudge,
            surface: Arc::clone(&surface),
            domain: site.domain.corners().into(),
        };
        let share = draws.quantity(&self.footwall_share, "footwall_share")?;
        let along = slipped.along(&self.slip, draws)?;
        let motion = |share: f64| match &self.tip {
            None => slipped.motion(&along, share),
            Some(tip) => slipped.towards_tip(tip, &along, share),
        };
        let [hanging, foot] = [motion(1.0 - share)?, motion(-share)?];
        if let Some(tip) = &self.tip {
            let _ = tip;
        }
        let (low, high) = site.domain.corners();
        let margin = MARGIN * low.distance(high);
        let side = surface
            .side(low, high, margin)
            .map_err(|error| ("no fault", error.to_string()))?;
        Ok(Made {
            event: Some(Event {
                motion: hanging,
                rest: (share > 0.0).then_some(foot),
                is_plane: surface.dip().is_some(),
                ends_on: self.ends_on.as_ref().map(|(_, wall)| *wall),
                tolerance: self.tolerance,
            }),
            ..Made::body(Body::Side(Arc::new(side)), draws.taken())
        })
    }

    fn refers(&self) -> Vec<&Reference> {
        self.ends_on.iter().map(|(fault, _)| fault).collect()
    }
}

impl Keys<'_, '_> {
    fn slip(&self, throw: Option<Field<Any>>, displacement: Option<Field<Any>>) -> Option<Slip> {
        if let (Some(_), Some(Field::Good(node, _))) = (&throw, &displacement) {
            self.checker.reader.wrong(
                *node,
                format!("{} has both `throw` and `displacement`", self.draft.name),
                "keep one: the throw is the vertical part of the displacement",
            );
            return None;
        }
        match displacement {
            Some(field) => self
                .quantity(field, "displacement", "", NOT_NEGATIVE)
                .map(Slip::Displacement),
            None => self
                .quantity(throw.unwrap_or(Field::Missing), "throw", "throw = 20", NOT_NEGATIVE)
                .map(Slip::Throw),
        }
    }

    fn ends_on(&mut self, node: NodeId) -> Option<(Reference, Wall)> {
        let what = self.what("ends_on");
        let file: EndsOnFile = self.checker.reader.table(node)?;
        self.checker.reader.close(node, &what);
        let need = |field, key, example| self.checker.reader.need(field, node, &what, key, example);
        let fault = need(file.fault, "fault", "fault = \"master\"").and_then(|(at, id)| {
            let reference = self.checker.refer(at, &id, &what, Gives::Fault, self.family)?;
            if reference.feature > self.family.own {
                self.checker.reader.wrong(
                    at,
                    format!("{what} names {}, which is younger", quoted(&id)),
                    "list the fault on which it ends before it",
                );
                return None;
            }
            Some(reference)
        });
        let side = need(file.side, "side", "side = \"hanging-wall\"").and_then(|(at, word)| {
            let wall = match word.as_str() {
                "hanging-wall" => Some(Wall::Hanging),
                "footwall" => Some(Wall::Foot),
                _ => None,
            };
            if wall.is_none() {
                self.checker.reader.wrong(
                    at,
                    format!("there is no side {} of a fault", quoted(&word)),
                    "write \"hanging-wall\" (above it) or \"footwall\" (below it)",
                );
            }
            wall
        });
        Some((fault?, side?))
    }

    /// How far what is moved may be off; nothing if it is not said.
    pub(super) fn tolerance(&self, field: Option<Field<f64>>) -> Option<Option<f64>> {
        let Some(field) = field else {
            return Some(None);
        };
        let (node, tolerance) = field.good()?;
        if tolerance > 0.0 {
            return Some(Some(tolerance));
        }
        self.checker.reader.wrong(
            node,
            format!("{} is {tolerance}; it must be above 0", self.what("tolerance")),
            "write how far what it moves may be from where it should be, in metres, as 0.01",
        );
        None
    }
}
