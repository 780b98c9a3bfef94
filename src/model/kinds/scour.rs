//! Scours: pits with wings, narrow and deep upstream, wide and shallow downstream.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Part, Site};
use crate::features::body::Body;
use crate::features::extrusion::ExtrusionError;
use crate::features::fabric::Fabric;
use crate::features::profile::Profile;
use crate::features::scour::{PitAndWing, ScourDesign, ScourError, constant_area};
use crate::features::trajectory::{Trajectory, azimuth_vector};
use crate::model::checker::Reported;
use crate::model::draws::{Draws, Reason, diagonal};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::values::ends::{Ends, ends};
use crate::model::values::limits::{ANY, AZIMUTH, Limits, POSITIVE};
use crate::model::values::quantity::Quantity;
use crate::model::values::trajectory::{self, TrajectorySpec};

/// Width downstream if left out, in that upstream.
const WIDENING: f64 = 3.0;
const PIT_FRACTION: f64 = 0.35;
const WING_DEPTH_FRACTION: f64 = 0.25;
const HEAD_FRACTION: f64 = 0.15;
const TAIL_FRACTION: f64 = 0.4;
/// Most turning from one section to the next (rad).
const ANGLE_LIMIT: f64 = 0.26;
/// How far the base may leave its template, as a fraction of the width or the depth, whichever is less.
const TOLERANCE: f64 = 2e-3;
/// How far the rims of a scour that conforms to a surface stand above it, as a fraction of the depth: the surface ends the scour at
/// an angle, and its top does not run along it.
const PROUD: f64 = 0.02;

const PIT: Limits = Limits {
    low: 0.2,
    high: 0.6,
    open: false,
    words: "must lie between 0.2 and 0.6 (a fraction of the width)",
};
const WING: Limits = Limits {
    low: 0.1,
    high: 0.4,
    open: false,
    words: "must lie between 0.1 and 0.4 (a fraction of the depth)",
};
const END: Limits = Limits {
    low: 0.01,
    high: 0.99,
    open: false,
    words: "must lie between 0.01 and 0.99 (a fraction of the length)",
};

/// A scour.
#[derive(Clone, Debug, PartialEq)]
pub struct ScourSpec {
    /// The way that it takes.
    pub way: Way,
    /// Width between the rims; three times as much downstream if only one is given.
    pub width: Ends,
    /// Depth of the pit; downstream such that the section keeps its area if only one is given.
    pub depth: Ends,
    /// Elevation of the rims; uniform between the domain's base + depth and its top if absent.
    pub top: Option<Quantity>,
    /// Width of the pit as a fraction of the scour's.
    pub pit_fraction: Quantity,
    /// Depth of the wings as a fraction of the pit's.
    pub wing_depth_fraction: Quantity,
    /// Part of the length over which it deepens.
    pub head_fraction: Quantity,
    /// Part of the length over which it ends.
    pub tail_fraction: Quantity,
}

/// The way that a scour takes.
#[derive(Clone, Debug, PartialEq)]
pub enum Way {
    /// Straight down the flow.
    Straight {
        /// Length.
        length: Quantity,
        /// Direction of the flow, clockwise from north, degrees.
        azimuth_deg: Quantity,
        /// Where it is.
        place: Place,
    },
    /// Along a trajectory.
    Along(TrajectorySpec),
}

/// Where a straight scour is.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// Its middle; drawn over the domain, or what the parent has of it, if absent.
    Center(Option<[Quantity; 2]>),
    /// Its upstream end.
    Head([Quantity; 2]),
}

/// A scour: a pit with wings on both sides, narrow and deep upstream, wide and shallow downstream. Its way is straight (`length` and `azimuth_deg`) or a `trajectory`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ScourFile {
    /// Width between the rims in metres, above 0: upstream, or [upstream, downstream]; downstream three times that upstream if left out.
    #[schemars(with = "Ends")]
    pub(crate) width: Field<Any>,
    /// Depth of the pit below the rims in metres, above 0: upstream, or [upstream, downstream]; if one is given, it falls downstream as the width grows, so that sections keep their area.
    #[schemars(with = "Ends")]
    pub(crate) depth: Field<Any>,
    /// Length of a straight scour in metres, above 0.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) length: Option<Field<Any>>,
    /// Direction of the flow of a straight scour in degrees, clockwise from north.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) azimuth_deg: Option<Field<Any>>,
    /// Middle of a straight scour in plan, [x, y]; if neither this nor `head` is given, uniform over the domain, or, for a child, over what its parent has of it.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Upstream end of a straight scour in plan, [x, y].
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) head: Option<Field<Any>>,
    /// The way that it takes in plan, from upstream to downstream, in place of `length`, `azimuth_deg`, `center` and `head`.
    #[schemars(schema_with = "trajectory::schema")]
    #[serde(default)]
    pub(crate) trajectory: Option<Field<Any>>,
    /// Elevation of the rims in metres; if left out, uniform between the base of the domain + depth and its top, or, for a child without a place, within its parent.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) top: Option<Field<Any>>,
    /// Width of the pit as a fraction of the scour's, between 0.2 and 0.6; 0.35 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) pit_fraction: Option<Field<Any>>,
    /// Depth of the wings as a fraction of the pit's, between 0.1 and 0.4; 0.25 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) wing_depth_fraction: Option<Field<Any>>,
    /// Part of the length over which it deepens to its full depth, between 0.01 and 0.99; 0.15 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) head_fraction: Option<Field<Any>>,
    /// Part of the length over which it shallows to nothing, between 0.01 and 0.99; 0.4 if left out. With the head no more than all of it.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) tail_fraction: Option<Field<Any>>,
}

impl Kind for ScourSpec {
    const NATURE: Nature = Nature {
        name: "scour",
        copies: Copies::Any,
        within: Within::Anything,
        children: Children::Any,
        taking: Taking::ByRules,
        volumes: Volumes::One,
        is_base: false,
        placed_by: "set its `top` and its `center` or `head`",
        apart: "change `top` or `depth` of {name} by {by} or more, or move its `center`",
    };

    const CONFORMS: bool = true;

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        ScourFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let mut file: ScourFile = keys.table()?;
        let width = keys.ends(
            std::mem::replace(&mut file.width, Field::Missing),
            "width",
            "width = [20, 60]",
        );
        let depth = keys.ends(
            std::mem::replace(&mut file.depth, Field::Missing),
            "depth",
            "depth = 3",
        );
        let top = keys.optional_quantity(file.top.take(), "top", ANY);
        let pit = keys.optional_quantity(file.pit_fraction.take(), "pit_fraction", PIT);
        let wing =
            keys.optional_quantity(file.wing_depth_fraction.take(), "wing_depth_fraction", WING);
        let head = keys.optional_quantity(file.head_fraction.take(), "head_fraction", END);
        let tail = keys.optional_quantity(file.tail_fraction.take(), "tail_fraction", END);
        let way = keys.scour_way(file);
        let or = |given: Result<Option<Quantity>, Reported>, default: f64| {
            given.map(|given| given.unwrap_or(Quantity::Constant(default)))
        };
        let head = or(head, HEAD_FRACTION);
        let tail = or(tail, TAIL_FRACTION);
        if let (Ok(head), Ok(tail)) = (&head, &tail) {
            keys.check_scour_ends(head, tail)?;
        }
        Some(Self {
            way: way?,
            width: width?,
            depth: depth?,
            top: top.ok()?,
            pit_fraction: or(pit, PIT_FRACTION).ok()?,
            wing_depth_fraction: or(wing, WING_DEPTH_FRACTION).ok()?,
            head_fraction: head.ok()?,
            tail_fraction: tail.ok()?,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let (upstream, downstream) = draws.ends(&self.width, "width")?;
        let width = along(upstream, downstream.unwrap_or(WIDENING * upstream));
        let (deep, shallow) = draws.ends(&self.depth, "depth")?;
        let depth = match shallow {
            Some(shallow) => along(deep, shallow),
            None => constant_area(&width, deep),
        };
        let deepest = deep.max(shallow.unwrap_or(deep));
        let section = PitAndWing {
            pit: draws.quantity(&self.pit_fraction, "pit_fraction")?,
            wing_depth: draws.quantity(&self.wing_depth_fraction, "wing_depth_fraction")?,
        };
        let head = draws.quantity(&self.head_fraction, "head_fraction")?;
        let tail = draws.quantity(&self.tail_fraction, "tail_fraction")?;
        let (trajectory, top) = self.placed(site, deepest, draws)?;
        let design = ScourDesign {
            width,
            depth,
            section,
            head,
            tail,
            top,
            angle_limit: ANGLE_LIMIT,
            tolerance: TOLERANCE,
        };
        let shell = design
            .build(&trajectory)
            .map_err(|error| (reason(&error), error.to_string()))?;
        let (low, high) = site.domain.corners();
        let direction = trajectory.mean_direction(low.truncate(), high.truncate());
        Ok(Made::of(vec![Part {
            drawn: draws.taken(),
            level: Some(top - PROUD * deepest),
            fabric: direction.map(Fabric::along),
            ..Part::of(Body::Shell(shell))
        }]))
    }

    fn refers(&self) -> Vec<&Reference> {
        match &self.way {
            Way::Along(trajectory) => trajectory.refers(),
            Way::Straight { .. } => Vec::new(),
        }
    }

    fn wants_interior(&self) -> bool {
        matches!(
            self.way,
            Way::Straight {
                place: Place::Center(None),
                ..
            }
        )
    }
}

/// Why there is none, in a few words.
fn reason(error: &ScourError) -> &'static str {
    match error {
        ScourError::Ends(_) => "head and tail longer than the scour",
        ScourError::Extrusion(carried) => match **carried {
            ExtrusionError::Fold { .. } => "bend tighter than the half-width",
            ExtrusionError::Neck { .. } => "meander neck narrower than the width",
            ExtrusionError::TooManySections(_) | ExtrusionError::Interpolation(_) => {
                "surface out of tolerance"
            }
            ExtrusionError::Section(..) => "impossible section",
        },
        _ => "impossible scour",
    }
}

/// From one value at the upstream end to another one at the downstream end.
fn along(upstream: f64, downstream: f64) -> Profile {
    Profile::Along(vec![(0.0, upstream), (1.0, downstream)])
}

impl ScourSpec {
    /// Its way and the elevation of its rims (m).
    fn placed(
        &self,
        site: &Site<'_>,
        deepest: f64,
        draws: &mut Draws<'_>,
    ) -> Result<(Trajectory, f64), Reason> {
        let top = self.top.as_ref();
        let (length, azimuth_deg, place) = match &self.way {
            Way::Along(spec) => {
                let top = site.elevation(top, "top", [deepest, 0.0], draws)?;
                let overshoot = 0.05 * diagonal(site.domain) + site.beyond();
                let trajectory = trajectory::trajectory(spec, site, overshoot, draws)?;
                return Ok((trajectory, top));
            }
            Way::Straight {
                length,
                azimuth_deg,
                place,
            } => (length, azimuth_deg, place),
        };
        let length = draws.quantity(length, "length")?;
        let azimuth = draws.quantity(azimuth_deg, "azimuth_deg")?.to_radians();
        let axis = length * azimuth_vector(azimuth);
        let (from, top) = match place {
            Place::Head(head) => {
                let top = site.elevation(top, "top", [deepest, 0.0], draws)?;
                (draws.point(head, "head")?, top)
            }
            Place::Center(center) => {
                let center = site.place(center.as_ref(), (top, "top"), [deepest, 0.0], draws)?;
                (center.truncate() - 0.5 * axis, center.z)
            }
        };
        let line = Trajectory::line(from, from + axis)
            .map_err(|error| ("impossible trajectory", error.to_string()))?;
        Ok((line, top))
    }
}

impl Keys<'_, '_> {
    /// A quantity that must be there, or two.
    fn ends(&self, field: Field<Any>, key: &str, example: &str) -> Option<Ends> {
        let (node, Any) = self.need(field, key, example)?;
        ends(&self.checker.reader, node, &self.what(key), POSITIVE)
    }

    /// A trajectory, or what a straight scour has in its place.
    fn scour_way(&mut self, file: ScourFile) -> Option<Way> {
        let straight = [
            ("length", file.length.is_some()),
            ("azimuth_deg", file.azimuth_deg.is_some()),
            ("center", file.center.is_some()),
            ("head", file.head.is_some()),
        ];
        let given = straight.iter().find(|key| key.1).map(|key| key.0);
        if let Some(field) = file.trajectory {
            let (at, Any) = field.good()?;
            if let Some(key) = given {
                self.checker.reader.wrong(
                    at,
                    format!("{} has both a `trajectory` and `{key}`", self.draft.name),
                    "keep one: `trajectory`, or `length` and `azimuth_deg` with `center` or `head` for a straight scour",
                );
                return None;
            }
            let trajectory = self.checker.trajectory(at, self.family)?;
            if let Some(domain) = self.domain {
                let name = &self.draft.name;
                self.checker
                    .note_far_trajectory(at, &trajectory, name, domain);
            }
            return Some(Way::Along(trajectory));
        }
        let needed = |field: Option<Field<Any>>| field.unwrap_or(Field::Missing);
        let length = self.quantity(needed(file.length), "length", "length = 200", POSITIVE);
        let azimuth = needed(file.azimuth_deg);
        let azimuth = self.quantity(azimuth, "azimuth_deg", "azimuth_deg = 90", AZIMUTH);
        if file.center.is_some()
            && let Some(Field::Good(at, Any)) = &file.head
        {
            self.checker.reader.wrong(
                *at,
                format!("{} has both a `center` and a `head`", self.draft.name),
                "keep one: its middle, or its upstream end",
            );
        }
        let (center, head) = (
            self.plan_point(file.center, "center"),
            self.plan_point(file.head, "head"),
        );
        let place = match (center.ok()?, head.ok()?) {
            (center, None) => Place::Center(center),
            (None, Some(head)) => Place::Head(head),
            (Some(_), Some(_)) => return None,
        };
        Some(Way::Straight {
            length: length?,
            azimuth_deg: azimuth?,
            place,
        })
    }

    /// Head and tail must fit, as far as their least values say.
    fn check_scour_ends(&self, head: &Quantity, tail: &Quantity) -> Option<()> {
        let least = head.support().0 + tail.support().0;
        if least <= 1.0 {
            return Some(());
        }
        self.checker.reader.wrong(
            self.draft.node,
            format!(
                "head and tail of {} take {least} of its length, or more",
                self.draft.name
            ),
            "make head_fraction or tail_fraction smaller: their sum must be 1 or less",
        );
        None
    }
}
