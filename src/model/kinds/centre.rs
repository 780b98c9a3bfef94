//! Centres: what lies where a point of it is, given or drawn.

use glam::DVec3;

use super::keys::Keys;
use super::made::Site;
use crate::model::checker::Reported;
use crate::model::domain::Domain;
use crate::model::draft::Draft;
use crate::model::draws::{Draws, Reason};
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;
use crate::model::values::limits::ANY;
use crate::model::values::quantity::Quantity;
use crate::model::values::tuple::Tuple;

/// A centre with its place in the file.
pub(crate) type Given = (NodeId, [Quantity; 3]);

impl Site<'_> {
    /// The centre that is given; or a point that is uniform over the domain, or over what the parent has of it.
    pub(crate) fn center(
        self,
        given: Option<&[Quantity; 3]>,
        draws: &mut Draws<'_>,
    ) -> Result<DVec3, Reason> {
        if let Some([x, y, z]) = given {
            return Ok(DVec3::new(
                draws.quantity(x, "center.x")?,
                draws.quantity(y, "center.y")?,
                draws.quantity(z, "center.z")?,
            ));
        }
        let Domain { x, y, z, .. } = *self.domain;
        let corner = |i: usize| DVec3::new(x[i], y[i], z[i]);
        let (mut low, mut high) = (corner(0), corner(1));
        if let Some(parent) = self.interior {
            let (least, most) = parent.bounds();
            (low, high) = (low.max(least), high.min(most));
            // A parent outside the domain has its children there too.
            if !low.cmplt(high).all() {
                (low, high) = (least, most);
            }
        }
        let center = DVec3::new(
            draws.uniform(low.x, high.x, "center.x")?,
            draws.uniform(low.y, high.y, "center.y")?,
            draws.uniform(low.z, high.z, "center.z")?,
        );
        match self.interior {
            Some(parent) if !parent.contains(center) => Err((
                "centre outside the parent",
                format!("the centre at {center:.2} is outside the parent; give it a `center`"),
            )),
            _ => Ok(center),
        }
    }
}

impl Keys<'_, '_> {
    /// A `center` that may be left out, with its place.
    pub(crate) fn center(&self, field: Option<Field<Any>>) -> Result<Option<Given>, Reported> {
        let Some(field) = field else {
            return Ok(None);
        };
        let read = || {
            let (node, Any) = field.good()?;
            let center = center_of(self.draft).read(&self.checker.reader, node)?;
            Some((node, center))
        };
        read().map(Some).ok_or(Reported)
    }

    /// Says so if nothing within a distance of a centre (m) can lie in the domain.
    pub(crate) fn note_far_center(
        &mut self,
        node: NodeId,
        center: &[Quantity; 3],
        reach: f64,
        domain: &Domain,
    ) {
        let limits = [domain.x, domain.y, domain.z];
        let beyond = center.iter().zip(limits).any(|(at, [low, high])| {
            let (least, most) = at.support();
            most + reach <= low || least - reach >= high
        });
        if beyond {
            let [x, y, _] = center;
            let in_world = x
                .constant()
                .zip(y.constant())
                .is_some_and(|(x, y)| self.checker.is_in_world([x, y], domain.x, domain.y));
            let remedy = if in_world {
                "; its center is given in the world: subtract the model's origin"
            } else {
                ""
            };
            self.checker.note(
                node,
                format!(
                    "{} lies outside the domain, so it has no volume{remedy}",
                    self.draft.name
                ),
            );
        }
    }
}

fn center_of(draft: &Draft) -> Tuple<'static, 3> {
    Tuple {
        what: format!("the center of {}", draft.name),
        names: ["x", "y", "z"],
        limits: ANY,
        remedy: "write the three coordinates in [ ], in metres",
    }
}
