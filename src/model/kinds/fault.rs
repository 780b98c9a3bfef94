//! Faults: what lies above one moves against what lies below.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::{Keys, optional};
use super::kind::Kind;
use super::made::{Event, Made, Part, Site, Wall};
use crate::features::body::Body;
use crate::features::fault_surface::FaultSurface;
use crate::features::fault_zone;
use crate::features::motion::{
    Displacement, HeaveDesign, Law, Motion, MotionError, SlipDesign, Variation,
};
use crate::features::profile::Profile as Along;
use crate::model::checker::Reported;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Gives, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::tree::{NodeId, quoted};
use crate::model::values::fault::{FaultSurfaceSpec, fault_surface, fault_surface_schema};
use crate::model::values::limits::{FRACTION, Limits, NOT_NEGATIVE, POSITIVE};
use crate::model::values::profile::Profile;
use crate::model::values::quantity::{Quantity, quantity};

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
    /// Rock along it, younger than its slip.
    pub zone: Option<Zone>,
    /// How far what it moves may be from where it should be (m); by the domain's size if absent.
    pub tolerance: Option<f64>,
}

/// What lies along a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    /// The core's facies, by index.
    pub facies: usize,
    /// The core's thickness (m); by the displacement if absent.
    pub thickness: Option<Quantity>,
    /// What is damaged beside it.
    pub damage: Option<Damage>,
}

/// What is damaged along a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Damage {
    /// Its facies, by index.
    pub facies: usize,
    /// Its width, the core included (m); by the displacement if absent.
    pub width: Option<Quantity>,
    /// The part of it in the hanging wall.
    pub hanging_share: Quantity,
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
    /// Down dip (m); by the length if absent.
    pub height: Option<Quantity>,
    /// How the displacement falls towards it.
    pub law: Law,
}

/// A fault: all that is older and lies above it, in its hanging wall, has moved against what lies below. It parts every older volume in blocks: "bed@f.hw" in the hanging wall of f, "bed@f.fw" in its footwall.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FaultFile {
    /// Where it runs: a plane, a listric surface, a section across it, or heights over the plan.
    #[schemars(schema_with = "fault_surface_schema")]
    #[serde(default)]
    pub(crate) surface: Option<Field<Any>>,
    /// In place of `surface`: the id of an older fault that slips again. What was laid down between the two slips is moved by this one alone.
    pub(crate) on: Option<Field<String>>,
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
    /// Rock along it, younger than its slip: { facies = "gouge", thickness = 0.5 }, with damage = { facies = "fractured", width = 20 } if that is a volume, too.
    #[schemars(with = "Option<ZoneFile>")]
    pub(crate) zone: Option<Field<Any>>,
    /// How far what it moves may be from where it should be, in metres, above 0; a hundred-thousandth of the domain's diagonal if left out. Where the slip is the same everywhere nothing is off.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub(crate) tolerance: Option<Field<f64>>,
}

/// Rock along a fault.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FaultZone")]
pub(crate) struct ZoneFile {
    /// The facies of the core, `ID/core`.
    pub(crate) facies: Field<String>,
    /// Thickness of the core in metres, above 0, half of it to each side; a 66th of the displacement, but 0.1 at least, if left out (Manzocchi et al. 1999).
    #[schemars(with = "Option<Quantity>")]
    pub(crate) thickness: Option<Field<Any>>,
    /// Damaged rock beside the core, as a volume `ID/damage` of its own.
    #[schemars(with = "Option<DamageFile>")]
    pub(crate) damage: Option<Field<Any>>,
}

/// Damaged rock along a fault.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FaultDamage")]
pub(crate) struct DamageFile {
    /// Its facies.
    pub(crate) facies: Field<String>,
    /// Its width in metres, above 0, the core included; as wide as the displacement is long if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) width: Option<Field<Any>>,
    /// The part of it in the hanging wall, 0 to 1; 0.6 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) hanging_share: Option<Field<Any>>,
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
    #[serde(default)]
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
/// Of lines of shear.
const SHEAR: Limits = Limits {
    low: -80.0,
    high: 80.0,
    open: false,
    words: "must lie between -80 and 80 degrees from the vertical, above 0 towards the fault",
};
/// A throw needs a slip this far from level at least, a heave one this far from upright (sine of the angle).
const LEAST_PART: f64 = 1e-3;
/// Length of a tip line for each metre of its height (Nicol et al. 1996).
const ASPECT: f64 = 2.15;
/// Displacement for each metre of a core's thickness (Manzocchi et al. 1999), and the least thickness (m).
const CORE: f64 = 66.0;
const LEAST_CORE: f64 = 0.1;
/// The part of damage in the hanging wall.
const HANGING_SHARE: f64 = 0.6;
/// How far a fault lies aside where contacts coincide, in steps, so that it moves with nothing else.
const ASIDE: f64 = 0.618_033_988_749_895;
/// How far its sheet reaches beyond the domain, in diagonals: it may be moved itself.
const MARGIN: f64 = 0.5;
/// Places along strike at which a function is asked.
const ASKED: u32 = 33;

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
        let is_again = file.on.is_some();
        let surface = match (file.surface, file.on) {
            (surface, None) => keys
                .need(surface.unwrap_or(Field::Missing), "surface", example)
                .and_then(|(node, Any)| fault_surface(keys, node)),
            (None, Some(on)) => on
                .good()
                .and_then(|(node, id)| keys.older_fault(node, &id, "on"))
                .map(FaultSurfaceSpec::Of),
            (Some(surface), Some(_)) => {
                if let Field::Good(node, _) = surface {
                    keys.checker.reader.wrong(
                        node,
                        format!("{} has both `surface` and `on`", keys.draft.name),
                        "keep one: a fault that slips again runs where it did",
                    );
                }
                None
            }
        };
        if let (true, Some(Field::Good(node, _))) = (is_again, &file.ends_on) {
            keys.checker.reader.wrong(
                *node,
                format!("{} has both `on` and `ends_on`", keys.draft.name),
                "leave `ends_on` out: a fault that slips again ends where it did",
            );
        }
        let places = [place(file.tip.as_ref()), place(file.shear_deg.as_ref())];
        let slip = keys.slip([
            ("throw", file.throw),
            ("displacement", file.displacement),
            ("heave", file.heave),
        ]);
        let rake = keys.optional_quantity(file.rake_deg, "rake_deg", RAKE);
        let shear = keys.optional_quantity(file.shear_deg, "shear_deg", SHEAR);
        let share = keys.optional_quantity(file.footwall_share, "footwall_share", FRACTION);
        let tip = given(file.tip, |node| keys.tip(node));
        let ends_on = given(file.ends_on, |node| keys.ends_on(node));
        let zone = given(file.zone, |node| keys.zone(node));
        let tolerance = keys.tolerance(file.tolerance);
        let none = || Quantity::Constant(0.0);
        let (surface, slip) = (surface?, slip?);
        keys.check_form(&surface, &slip, places)?;
        Some(Self {
            surface,
            slip: slip.1,
            rake_deg: rake.ok()?.unwrap_or(Quantity::Constant(-90.0)),
            tip: tip.ok()?,
            shear_deg: shear.ok()?.unwrap_or_else(none),
            footwall_share: share.ok()?.unwrap_or_else(none),
            ends_on: ends_on.ok()?,
            zone: zone.ok()?,
            tolerance: tolerance.ok()?,
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
        let tip = self.tip.as_ref().map(|tip| slipped.tip(tip, draws));
        let tip = tip.transpose()?;
        let hanging = slipped.motion(&along, tip.as_ref(), 1.0 - share)?;
        let rest = if share > 0.0 {
            Some(slipped.motion(&along, tip.as_ref(), -share)?)
        } else {
            None
        };
        let (low, high) = site.domain.corners();
        let margin = MARGIN * low.distance(high);
        let side = surface
            .side(low, high, margin)
            .map_err(|error| ("no fault", error.to_string()))?;
        let zone = match &self.zone {
            Some(zone) => slipped.zone(zone, &along, margin, draws)?,
            None => Vec::new(),
        };
        let wall = Part {
            drawn: draws.taken(),
            ..Part::of(Body::Side(Arc::new(side)))
        };
        Ok(Made {
            event: Some(Event {
                motion: hanging,
                rest,
                is_plane: surface.dip().is_some(),
                is_again: matches!(self.surface, FaultSurfaceSpec::Of(_)),
                surface: Some(surface),
                ends_on: self.ends_on.as_ref().map(|(_, wall)| *wall),
                tolerance: self.tolerance,
            }),
            ..Made::of(std::iter::once(wall).chain(zone).collect())
        })
    }

    fn more_facies(&self) -> Vec<usize> {
        let zone = self.zone.iter();
        zone.flat_map(|zone| {
            let damage = zone.damage.iter().map(|damage| damage.facies);
            std::iter::once(zone.facies).chain(damage)
        })
        .collect()
    }

    fn refers(&self) -> Vec<&Reference> {
        let again = match &self.surface {
            FaultSurfaceSpec::Of(other) => Some(other),
            _ => None,
        };
        let master = self.ends_on.as_ref().map(|(fault, _)| fault);
        again.into_iter().chain(master).collect()
    }
}

impl Keys<'_, '_> {
    /// One of three ways to say how far it has moved.
    fn slip(&self, given: [(&str, Option<Field<Any>>); 3]) -> Option<(NodeId, Slip)> {
        let mut given: Vec<_> = given
            .into_iter()
            .filter_map(|(key, field)| Some((key, field?)))
            .collect();
        if given.len() > 1 {
            let keys: Vec<String> = given.iter().map(|one| format!("`{}`", one.0)).collect();
            if let Field::Good(node, _) = given[1].1 {
                self.checker.reader.wrong(
                    node,
                    format!("{} has {}", self.draft.name, keys.join(" and ")),
                    "keep one: throw and heave are the vertical part and that in plan of the displacement",
                );
            }
            return None;
        }
        let (key, field) = given.pop().unwrap_or(("throw", Field::Missing));
        let (node, profile) = self.profile(field, key, "throw = 20", NOT_NEGATIVE)?;
        let slip = match key {
            "throw" => Slip::Throw(profile),
            "heave" => Slip::Heave(profile),
            _ => Slip::Displacement(profile),
        };
        Some((node, slip))
    }

    fn tip(&mut self, node: NodeId) -> Option<Tip> {
        let what = self.what("tip");
        let reader = &self.checker.reader;
        let file: TipFile = reader.table(node)?;
        reader.close(node, &what);
        let number =
            |at: NodeId, key: &str| quantity(reader, at, &format!("the {key} of {what}"), POSITIVE);
        let length = reader.need(file.length, node, &what, "length", "length = 4000");
        let length = length.and_then(|(at, Any)| number(at, "length"));
        let height = given(file.height, |at| number(at, "height"));
        let law = match file.profile.map(Field::good) {
            None => Some(Law::WalshWatterson),
            Some(None) => None,
            Some(Some((at, word))) => match word.as_str() {
                "walsh-watterson" => Some(Law::WalshWatterson),
                "linear" => Some(Law::Linear),
                "bell" => Some(Law::Bell),
                _ => {
                    reader.wrong(
                        at,
                        format!("there is no profile {} of displacement", quoted(&word)),
                        "write \"walsh-watterson\", \"linear\" or \"bell\"",
                    );
                    None
                }
            },
        };
        Some(Tip {
            length: length?,
            height: height.ok()?,
            law: law?,
        })
    }

    fn zone(&mut self, node: NodeId) -> Option<Zone> {
        let what = self.what("zone");
        let reader = &self.checker.reader;
        let file: ZoneFile = reader.table(node)?;
        reader.close(node, &what);
        let facies = reader.need(file.facies, node, &what, "facies", "facies = \"gouge\"");
        let facies =
            facies.and_then(|(at, name)| self.checker.known_facies(at, &name, self.family.facies));
        let thickness = given(file.thickness, |at| {
            quantity(reader, at, &format!("the thickness of {what}"), POSITIVE)
        });
        let damage = given(file.damage, |at| {
            self.damage(at, &format!("the damage of {what}"))
        });
        Some(Zone {
            facies: facies?,
            thickness: thickness.ok()?,
            damage: damage.ok()?,
        })
    }

    fn damage(&self, node: NodeId, what: &str) -> Option<Damage> {
        let reader = &self.checker.reader;
        let file: DamageFile = reader.table(node)?;
        reader.close(node, what);
        let facies = reader.need(file.facies, node, what, "facies", "facies = \"fractured\"");
        let facies =
            facies.and_then(|(at, name)| self.checker.known_facies(at, &name, self.family.facies));
        let width = given(file.width, |at| {
            quantity(reader, at, &format!("the width of {what}"), POSITIVE)
        });
        let share = given(file.hanging_share, |at| {
            quantity(
                reader,
                at,
                &format!("the hanging_share of {what}"),
                FRACTION,
            )
        });
        Some(Damage {
            facies: facies?,
            width: width.ok()?,
            hanging_share: share.ok()?.unwrap_or(Quantity::Constant(HANGING_SHARE)),
        })
    }

    /// What goes with planes alone, or with bent faults alone.
    fn check_form(
        &self,
        surface: &FaultSurfaceSpec,
        (slip_at, slip): &(NodeId, Slip),
        [tip, shear]: [Option<NodeId>; 2],
    ) -> Option<()> {
        if let FaultSurfaceSpec::Of(_) = surface {
            return Some(());
        }
        let is_plane = matches!(surface, FaultSurfaceSpec::Plane(_));
        let name = &self.draft.name;
        let wrong = |at: NodeId, message: String, remedy: &str| {
            self.checker.reader.wrong(at, message, remedy);
            None
        };
        if !is_plane && !matches!(slip, Slip::Heave(_)) {
            return wrong(
                *slip_at,
                format!("the fault of {name} is bent: its throw differs from place to place"),
                "write heave = …, how far the hanging wall has moved in plan",
            );
        }
        if let Some(tip) = tip {
            if !is_plane {
                return wrong(
                    tip,
                    format!("{name} has a tip, but is no plane"),
                    "leave it out",
                );
            }
            let (Slip::Throw(profile) | Slip::Displacement(profile) | Slip::Heave(profile)) = slip;
            if !matches!(profile, Profile::Quantity(_)) {
                return wrong(
                    tip,
                    format!("{name} has a tip, and a displacement that varies along its strike"),
                    "write one number, the displacement at the fault's point, or leave the tip out",
                );
            }
        }
        match shear {
            Some(at) if is_plane => wrong(
                at,
                format!("{name} has a shear_deg, but slides on a plane, which shears nothing"),
                "leave it out",
            ),
            _ => Some(()),
        }
    }

    /// A fault that comes before it in the list.
    fn older_fault(&self, node: NodeId, id: &str, key: &str) -> Option<Reference> {
        let what = self.what(key);
        let reference = self
            .checker
            .refer(node, id, &what, Gives::Fault, self.family)?;
        if reference.feature > self.family.own {
            self.checker.reader.wrong(
                node,
                format!("{what} names {}, which is younger", quoted(id)),
                "list that fault before it",
            );
            return None;
        }
        Some(reference)
    }

    fn ends_on(&mut self, node: NodeId) -> Option<(Reference, Wall)> {
        let what = self.what("ends_on");
        let file: EndsOnFile = self.checker.reader.table(node)?;
        self.checker.reader.close(node, &what);
        let need = |field, key, example| self.checker.reader.need(field, node, &what, key, example);
        let fault = need(file.fault, "fault", "fault = \"master\"")
            .and_then(|(at, id)| self.older_fault(at, &id, "ends_on"));
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
    pub(super) fn tolerance(&self, field: Option<Field<f64>>) -> Result<Option<f64>, Reported> {
        let Some(field) = field else {
            return Ok(None);
        };
        let (node, tolerance) = field.good().ok_or(Reported)?;
        if tolerance > 0.0 {
            return Ok(Some(tolerance));
        }
        self.checker.reader.wrong(
            node,
            format!(
                "{} is {tolerance}; it must be above 0",
                self.what("tolerance")
            ),
            "write how far what it moves may be from where it should be, in metres, as 0.01",
        );
        Err(Reported)
    }
}

/// What the value of a field that may be left out is read as.
fn given<T>(
    field: Option<Field<Any>>,
    read: impl FnOnce(NodeId) -> Option<T>,
) -> Result<Option<T>, Reported> {
    optional(field, |field| {
        field.good().and_then(|(node, Any)| read(node))
    })
}

/// Where a field stands.
fn place(field: Option<&Field<Any>>) -> Option<NodeId> {
    match field {
        Some(Field::Good(node, _)) => Some(*node),
        _ => None,
    }
}

/// How a hanging wall moves, without how far.
struct Slipped {
    surface: Arc<FaultSurface>,
    /// In the fault's plane from its strike (rad).
    rake: f64,
    /// From the vertical (rad).
    shear: f64,
    /// How much farther it moves (m).
    more: f64,
    domain: [DVec3; 2],
}

impl Slipped {
    /// By places along strike, how far it moves along its slip on a plane, or in plan on what is bent (m).
    fn along(&self, slip: &Slip, draws: &mut Draws<'_>) -> Result<Vec<[f64; 2]>, Reason> {
        let (name, profile) = match slip {
            Slip::Throw(profile) => ("throw", profile),
            Slip::Displacement(profile) => ("displacement", profile),
            Slip::Heave(profile) => ("heave", profile),
        };
        let profile = draws.profile(profile, name)?;
        let (sin, cos) = match self.surface.dip() {
            Some(dip) => dip.sin_cos(),
            None => (1.0, 1.0),
        };
        let of_slip = match slip {
            Slip::Throw(_) => (self.rake.sin() * sin).abs(),
            Slip::Displacement(_) => 1.0,
            Slip::Heave(_) => (self.rake.sin() * cos).abs(),
        };
        if of_slip < LEAST_PART {
            let (what, way) = match slip {
                Slip::Throw(_) => ("throw", "level"),
                _ => ("heave across its strike", "otherwise"),
            };
            return Err((
                "no such slip",
                format!("it has a {what}, but moves {way}; give its `displacement`"),
            ));
        }
        let is_bent = self.surface.dip().is_none();
        if is_bent && !matches!(slip, Slip::Heave(_)) {
            let message = "it slips on a fault that is bent, where throws differ from place to place; give its `heave`".to_owned();
            return Err(("throw of what is bent", message));
        }
        if is_bent && self.rake.cos().abs() > LEAST_PART {
            let message = format!(
                "its rake is {:.1} degrees, but what is bent slides across its strike alone; write -90 or 90",
                self.rake.to_degrees()
            );
            return Err(("rake of what is bent", message));
        }
        let [from, to] = self.strike();
        let at = |fraction: f64| from + (to - from) * fraction;
        let value = |fraction: f64| profile.at(fraction) / of_slip;
        let fractions: Vec<f64> = match &profile {
            Along::Constant(_) => vec![0.0],
            Along::Along(pairs) => pairs.iter().map(|pair| pair.0).collect(),
            Along::Function(_) => (0..ASKED)
                .map(|k| f64::from(k) / f64::from(ASKED - 1))
                .collect(),
        };
        let ends = fractions.iter().map(|fraction| value(*fraction));
        if ends.clone().any(|slip| slip > 0.0)
            && let Some(none) = fractions.iter().find(|fraction| !(value(**fraction) > 0.0))
        {
            return Err((
                "tip in the domain",
                format!(
                    "its {name} is {} m at the fraction {none} of its strike; a fault that ends inside the domain is not modelled: write a {name} above 0 everywhere",
                    profile.at(*none)
                ),
            ));
        }
        let places = fractions
            .iter()
            .map(|fraction| [at(*fraction), value(*fraction) + self.more]);
        Ok(places.collect())
    }

    /// Between which places along strike the domain lies (m).
    fn strike(&self) -> [f64; 2] {
        let (strike, through) = (self.surface.strike(), self.surface.through().xy());
        let [low, high] = self.domain;
        let corners = [
            low.xy(),
            high.xy(),
            DVec2::new(low.x, high.y),
            DVec2::new(high.x, low.y),
        ];
        let along = corners.map(|corner| (corner - through).dot(strike));
        let [least, most] = [f64::min, f64::max].map(|pick| along.into_iter().reduce(pick));
        [least.unwrap_or(0.0), most.unwrap_or(0.0)]
    }

    /// The semi-axes of a tip line, and how displacement falls towards it.
    fn tip(&self, tip: &Tip, draws: &mut Draws<'_>) -> Result<([f64; 2], Law), Reason> {
        let length = draws.quantity(&tip.length, "tip.length")?;
        let height = match &tip.height {
            Some(height) => draws.quantity(height, "tip.height")?,
            None => length / ASPECT,
        };
        let semi_axes = [0.5 * length, 0.5 * height];
        // An ellipse holds a polygon if it holds its corners.
        if let Some((place, r)) = self
            .farthest(semi_axes)
            .filter(|farthest| farthest.1 >= 1.0)
        {
            return Err((
                "tip in the domain",
                format!(
                    "its tip line lies in the domain, near ({:.1}, {:.1}, {:.1}); a fault that ends inside the domain is not modelled: make the tip {:.2} times as large or more",
                    place.x,
                    place.y,
                    place.z,
                    1.01 * r
                ),
            ));
        }
        Ok((semi_axes, tip.law))
    }

    /// The place of the fault in the domain that is farthest from its point, in semi-axes of an ellipse.
    fn farthest(&self, [length, height]: [f64; 2]) -> Option<(DVec3, f64)> {
        let (through, down) = (self.surface.through(), self.surface.down_dip()?);
        let (normal, strike) = (
            self.surface.normal(through),
            self.surface.strike().extend(0.0),
        );
        let [low, high] = self.domain;
        let corner = |k: usize| {
            let part = |axis: usize| if k >> axis & 1 == 1 { high } else { low }[axis];
            DVec3::new(part(0), part(1), part(2))
        };
        let edges = (0..8).flat_map(|k| (0..3).map(move |axis| (k, k ^ (1 << axis))));
        let crossing = |(a, b): (usize, usize)| {
            let (a, b) = (corner(a), corner(b));
            let [da, db] = [a, b].map(|p| (p - through).dot(normal));
            (da * db <= 0.0 && da != db).then(|| a + (b - a) * (da / (da - db)))
        };
        let places = edges.filter_map(crossing).map(|p| {
            let off = p - through;
            (p, (off.dot(strike) / length).hypot(off.dot(down) / height))
        });
        places.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The volumes along the fault: what is damaged, then the core.
    fn zone(
        &self,
        zone: &Zone,
        along: &[[f64; 2]],
        margin: f64,
        draws: &mut Draws<'_>,
    ) -> Result<Vec<Part>, Reason> {
        let slip = along.iter().map(|place| place[1]).fold(0.0, f64::max);
        // In plan, of what is bent: along its dip at its point.
        let displacement = match self.surface.dip() {
            Some(_) => slip,
            None => slip * self.surface.slope(self.surface.through().xy()).hypot(1.0),
        };
        let thickness = match &zone.thickness {
            Some(thickness) => draws.quantity(thickness, "zone.thickness")?,
            None => (displacement / CORE).max(LEAST_CORE),
        };
        let mut parts = Vec::new();
        if let Some(damage) = &zone.damage {
            let width = match &damage.width {
                Some(width) => draws.quantity(width, "zone.damage.width")?,
                None => displacement,
            };
            let share = draws.quantity(&damage.hanging_share, "zone.damage.hanging_share")?;
            let reach = [width * (1.0 - share), width * share];
            if reach.iter().any(|reach| *reach <= 0.5 * thickness) {
                return Err((
                    "no damage beside the core",
                    format!(
                        "its damage reaches {:.3} m into the footwall and {:.3} m into the hanging wall, but its core {:.3} m; make the damage wider",
                        reach[0],
                        reach[1],
                        0.5 * thickness
                    ),
                ));
            }
            parts.push(self.slab("/damage", damage.facies, reach, margin, draws)?);
        }
        let half = [0.5 * thickness; 2];
        parts.push(self.slab("/core", zone.facies, half, margin, draws)?);
        Ok(parts)
    }

    fn slab(
        &self,
        name: &str,
        facies: usize,
        reach: [f64; 2],
        margin: f64,
        draws: &mut Draws<'_>,
    ) -> Result<Part, Reason> {
        let [low, high] = self.domain;
        let tolerance = (0.01 * (reach[0] + reach[1])).min(1e-5 * low.distance(high));
        let shell = fault_zone::slab(&self.surface, reach, self.domain, margin, tolerance);
        let shell = shell.map_err(|error| ("no fault zone", error.to_string()))?;
        Ok(Part {
            name: name.to_owned(),
            facies: Some(facies),
            drawn: draws.taken(),
            ..Part::of(Body::Shell(shell))
        })
    }

    /// The motion of a side that has a share of the slip, with its sign.
    fn motion(
        &self,
        along: &[[f64; 2]],
        tip: Option<&([f64; 2], Law)>,
        share: f64,
    ) -> Result<Motion, Reason> {
        let wrong = |error: MotionError| ("no motion", error.to_string());
        let none = || ("no motion", "its displacement is no number".to_owned());
        if self.surface.dip().is_some() {
            let displacement = match tip {
                None => Displacement::AlongStrike(Variation::through(along).ok_or_else(none)?),
                Some((semi_axes, law)) => Displacement::Elliptic {
                    most: along[0][1],
                    centre: [0.0; 2],
                    semi_axes: *semi_axes,
                    law: *law,
                },
            };
            let design = SlipDesign {
                surface: Arc::clone(&self.surface),
                rake: self.rake,
                displacement,
                share,
                reach: None,
            };
            return design.build().map_err(wrong);
        }
        // Down the dip the hanging wall moves away from the footwall.
        let way = -self.rake.sin().signum() * share;
        let along: Vec<[f64; 2]> = along.iter().map(|[at, heave]| [*at, heave * way]).collect();
        let design = HeaveDesign {
            surface: Arc::clone(&self.surface),
            azimuth: None,
            heave: Variation::through(&along).ok_or_else(none)?,
            shear: self.shear,
            within: self.domain,
        };
        design.build().map_err(wrong)
    }
}
