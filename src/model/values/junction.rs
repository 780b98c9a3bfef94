//! Junctions: where and how a channel joins the one that it goes along.

use schemars::JsonSchema;
use serde::Deserialize;

use super::bank::{Side, side_schema};
use super::limits::{FRACTION, Limits};
use super::quantity::{Quantity, quantity};
use crate::features::body::Trough;
use crate::features::junction::Junction;
use crate::features::reach::Reach;
use crate::features::trajectory::Trajectory;
use crate::model::checker::Checker;
use crate::model::draws::{Draws, Reason};
use crate::model::interior::Interior;
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;

const ANGLE_DEG: f64 = 60.0;
/// Least radius of the last part of the way, in the tributary's widths, if there is such a way.
const RADIUS: f64 = 3.0;
/// How far a tributary's top is below the trunk's at the junction, as a fraction of its depth: tops at one level would coincide.
const BELOW: f64 = 0.02;
/// Points across the end of a tributary.
const ACROSS: usize = 64;

const ANGLE: Limits = Limits {
    low: 20.0,
    high: 90.0,
    open: false,
    words: "must lie between 20 and 90 degrees, between both directions downstream",
};

/// Where and how a channel joins the one that it goes along.
#[derive(Clone, Debug, PartialEq)]
pub struct Joins {
    /// Where, as a fraction of that one's length.
    pub at: Quantity,
    /// Angle between both directions downstream, degrees.
    pub angle_deg: Quantity,
    /// From which side; from that on which its course begins if absent.
    pub side: Option<Side>,
}

/// Where and how a channel joins the one that it goes along.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Joins")]
pub(crate) struct JoinsFile {
    /// Where, as a fraction of the other channel's length, from 0 to 1.
    #[schemars(with = "Quantity")]
    pub(crate) at: Field<Any>,
    /// Angle between both channels' directions downstream in degrees, between 20 and 90; 60 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) angle_deg: Option<Field<Any>>,
    /// From which side, looking along the other channel: "left" or "right"; that on which its own course begins if left out.
    #[schemars(schema_with = "side_schema")]
    #[serde(default)]
    pub(crate) side: Option<Field<String>>,
}

impl Checker<'_> {
    /// The junction of a feature, described by `of`.
    pub(crate) fn joins(&self, node: NodeId, of: &str) -> Option<Joins> {
        let reader = &self.reader;
        let what = format!("the `joins` of {of}");
        let file: JoinsFile = reader.table(node)?;
        reader.close(node, &what);
        let number = |at: NodeId, key: &str, limits: Limits| {
            quantity(reader, at, &format!("the {key} of {what}"), limits)
        };
        let at = reader
            .need(file.at, node, &what, "at", "at = 0.6")
            .and_then(|(node, Any)| number(node, "at", FRACTION));
        let angle = match file.angle_deg {
            None => Some(Quantity::Constant(ANGLE_DEG)),
            Some(field) => field
                .good()
                .and_then(|(node, Any)| number(node, "angle_deg", ANGLE)),
        };
        let side = self.side(file.side);
        Some(Joins {
            at: at?,
            angle_deg: angle?,
            side: side.ok()?,
        })
    }
}

/// A junction that is drawn.
pub(crate) struct Joining<'a> {
    trunk: &'a Reach,
    at: f64,
    angle: f64,
    side: Option<Side>,
}

impl<'a> Joining<'a> {
    pub(crate) fn draw(
        joins: &Joins,
        trunk: &'a Reach,
        draws: &mut Draws<'_>,
    ) -> Result<Self, Reason> {
        Ok(Self {
            trunk,
            at: draws.quantity(&joins.at, "joins.at")?,
            angle: draws
                .quantity(&joins.angle_deg, "joins.angle_deg")?
                .to_radians(),
            side: joins.side,
        })
    }

    /// The top of a tributary that is so deep (m), if it has none of its own: water surfaces meet.
    pub(crate) fn top(&self, depth: f64) -> f64 {
        self.trunk.station(self.at).middle.y - BELOW * depth
    }

    /// The way of a tributary with this course and width (m).
    pub(crate) fn way(&self, course: &Trajectory, width: f64) -> Result<Trajectory, Reason> {
        let junction = Junction {
            at: self.at,
            bank: self.side.map(Side::bank),
            angle: self.angle,
            radius: RADIUS * width,
            clearance: 0.5 * (self.trunk.station(self.at).width + width),
        };
        junction
            .join(course, self.trunk.trajectory())
            .map_err(|error| ("no way to the junction", error.to_string()))
    }

    /// The end of a tributary must lie inside of the trunk, which hides it. Gives the fraction of its length at which its
    /// trajectory enters the trunk.
    pub(crate) fn mouth(
        &self,
        tributary: &Trough,
        way: &Trajectory,
        inside: &Interior,
        name: &str,
    ) -> Result<f64, Reason> {
        let (base, top) = (tributary.base(), tributary.top());
        for sheet in [base, top] {
            let ((u0, u1), (_, end)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
            for k in 0..=ACROSS {
                let point = sheet.point(u0 + (u1 - u0) * k as f64 / ACROSS as f64, end);
                if !inside.contains(point) {
                    let station = self.trunk.station(self.at);
                    let message = format!(
                        "its end shows outside of {name}, which it joins, at ({:.1}, {:.1}, {:.2}): {name} is {:.1} m wide and {:.2} m deep \
                         there, with its top at {:.2} m; make the tributary narrower or shallower (as a rule at most 0.8 of the depth), \
                         or its top lower",
                        point.x, point.y, point.z, station.width, station.depth, station.middle.y
                    );
                    return Err(("tributary shows outside of its trunk", message));
                }
            }
        }
        // From its end back to the trunk's rim, just below the trunk's top.
        let station = self.trunk.station(self.at);
        let level = station.middle.y - 0.01 * station.depth;
        let steps = 512;
        let outside = (0..steps).rev().find(|step| {
            let place = way.at(way.length() * f64::from(*step) / f64::from(steps));
            !inside.contains(place.point.extend(level))
        });
        Ok(outside.map_or(0.0, |step| f64::from(step) / f64::from(steps)))
    }
}
