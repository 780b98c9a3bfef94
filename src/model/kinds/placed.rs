//! Control nets where they are: what sheets and bodies of one's own share.

use glam::DVec3;

use super::keys::Keys;
use crate::features::nets::{Joined, NamedNet, Nets, Placement};
use crate::model::draws::{Draws, Reason};
use crate::model::read::{Any, Field};
use crate::model::values::limits::{ANY, AZIMUTH};
use crate::model::values::quantity::Quantity;
use crate::model::values::tuple::Tuple;

/// Nets, and where they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The nets.
    pub nets: Vec<NamedNet>,
    /// Where their points count from.
    pub at: [Quantity; 3],
    /// Direction of their y axis, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
}

impl Placed {
    /// Draws where they are, moved by a tiny distance (m), and builds them.
    pub(crate) fn draw(&self, nudge: DVec3, draws: &mut Draws<'_>) -> Result<Nets, Reason> {
        let [x, y, z] = &self.at;
        let at = DVec3::new(
            draws.quantity(x, "at.x")?,
            draws.quantity(y, "at.y")?,
            draws.quantity(z, "at.z")?,
        );
        let placement = Placement {
            at: at + nudge,
            azimuth: draws
                .quantity(&self.azimuth_deg, "azimuth_deg")?
                .to_radians(),
        };
        Nets::new(&self.nets, placement).map_err(|error| ("no net", error.to_string()))
    }
}

/// How nets are joined, in words for the report.
pub(crate) fn told(nets: &Nets) -> Vec<String> {
    let told = |joint: &Joined| {
        let Joined {
            name,
            to,
            gap,
            angle,
        } = joint;
        let angle = angle.to_degrees();
        format!(
            "has net {name} joined to {to}: {gap:.1e} m apart at the most, at an angle of up to {angle:.4}°"
        )
    };
    nets.joints.iter().map(told).collect()
}

impl Keys<'_, '_> {
    /// The nets of the feature, with where they are.
    pub(crate) fn placed(
        &self,
        nets: Field<Any>,
        at: Option<Field<Any>>,
        azimuth: Option<Field<Any>>,
    ) -> Option<Placed> {
        let example = "nets = { points = [[[0, 0, 0], [0, 9, 0]], [[9, 0, 0], [9, 9, 1]]] }";
        let nets = self
            .need(nets, "nets", example)
            .and_then(|(node, Any)| self.checker.nets(node, &self.what("nets")));
        let at = match at {
            None => Some([0.0; 3].map(Quantity::Constant)),
            Some(field) => field.good().and_then(|(node, Any)| {
                let place = Tuple {
                    what: self.what("at"),
                    names: ["x", "y", "z"],
                    limits: ANY,
                    remedy: "write the three coordinates in [ ], in metres",
                };
                place.read(&self.checker.reader, node)
            }),
        };
        let azimuth = self.optional_quantity(azimuth, "azimuth_deg", AZIMUTH);
        Some(Placed {
            nets: nets?,
            at: at?,
            azimuth_deg: azimuth.ok()?.unwrap_or(Quantity::Constant(0.0)),
        })
    }
}
