//! Centres: what lies where a point of it is, given or drawn.

use glam::{DVec2, DVec3};

use super::keys::Keys;
use super::made::{Frame, Site};
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
        let [low, high] = self.room();
        let x = draws.uniform(low.x, high.x, "center.x")?;
        let y = draws.uniform(low.y, high.y, "center.y")?;
        let z = match self.warp {
            None => draws.uniform(low.z, high.z, "center.z")?,
            // Where it comes to lie is said by what it conforms to.
            Some(_) => low.z,
        };
        self.in_parent(DVec3::new(x, y, z))
    }
}

impl Site<'_> {
    /// An elevation that is given under a key; or uniform over the domain, but for lengths (m) above its base and below its top that
    /// what lies there takes.
    pub(crate) fn elevation(
        self,
        given: Option<&Quantity>,
        key: &str,
        [below, above]: [f64; 2],
        draws: &mut Draws<'_>,
    ) -> Result<f64, Reason> {
        if let Some(given) = given {
            return draws.quantity(given, key);
        }
        // What conforms to a surface is built anywhere.
        if self.warp.is_some() {
            return Ok(self.domain.z[0]);
        }
        let [base, top] = self.domain.z;
        let (lowest, highest) = (base + below, top - above);
        if !(lowest <= highest) {
            let message = format!(
                "it is {:.2} m high and the domain {:.2} m: make it smaller or give it a `{key}`",
                below + above,
                top - base
            );
            return Err(("higher than the domain", message));
        }
        draws.uniform(lowest, highest, key)
    }

    /// A place in plan that is given as `center`, and an elevation that is given under a key. What is left out is uniform over the
    /// domain, as in [`Self::elevation`], or over what the parent has of it: then the place lies in the parent.
    pub(crate) fn place(
        self,
        center: Option<&[Quantity; 2]>,
        (elevation, key): (Option<&Quantity>, &str),
        margins: [f64; 2],
        draws: &mut Draws<'_>,
    ) -> Result<DVec3, Reason> {
        if let Some(center) = center {
            let at = draws.point(center, "center")?;
            return Ok(at.extend(self.elevation(elevation, key, margins, draws)?));
        }
        let [low, high] = self.room();
        let at = self.anywhere(draws)?;
        let z = match (elevation, self.interior) {
            (None, Some(_)) if self.warp.is_none() => draws.uniform(low.z, high.z, key)?,
            _ => self.elevation(elevation, key, margins, draws)?,
        };
        self.in_parent(at.extend(z))
    }

    /// A place in plan that is uniform over the domain, or over the box of what the parent has of it.
    pub(crate) fn anywhere(self, draws: &mut Draws<'_>) -> Result<DVec2, Reason> {
        let [low, high] = self.room();
        Ok(DVec2::new(
            draws.uniform(low.x, high.x, "center.x")?,
            draws.uniform(low.y, high.y, "center.y")?,
        ))
    }

    /// Whether it is built on the base of the unit that it lies in.
    pub(crate) fn has_floor(self) -> bool {
        self.is_child && self.warp.is_none() && matches!(self.frame, Frame::Unit(_))
    }

    /// The elevation of that base at a place in plan (m).
    pub(crate) fn floor(self, at: DVec2) -> Option<f64> {
        match self.frame {
            Frame::Unit(base) if self.has_floor() => Some(base.height(at.x, at.y)),
            _ => None,
        }
    }

    /// What the domain and the parent, if it is known, have in common: of a parent outside of the domain all of it.
    fn room(self) -> [DVec3; 2] {
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
        [low, high]
    }

    /// A drawn place, if it lies in the parent, or comes to lie there.
    fn in_parent(self, drawn: DVec3) -> Result<DVec3, Reason> {
        let lies = match self.warp {
            None => drawn,
            Some(warp) => drawn.with_z(warp.height(drawn.truncate())?),
        };
        let [base, top] = self.domain.z;
        if self.warp.is_some() && !(base..=top).contains(&lies.z) {
            let message = format!(
                "the centre comes to lie at {lies:.2}, above or below the domain; give it a `center`"
            );
            return Err(("centre outside the domain", message));
        }
        match self.interior {
            Some(parent) if !parent.contains(lies) => Err((
                "centre outside the parent",
                format!("the centre at {lies:.2} is outside the parent; give it a `center`"),
            )),
            _ => Ok(drawn),
        }
    }
}

impl Keys<'_, '_> {
    /// A point in plan that may be left out.
    pub(crate) fn plan_point(
        &self,
        field: Option<Field<Any>>,
        key: &str,
    ) -> Result<Option<[Quantity; 2]>, Reported> {
        let Some(field) = field else {
            return Ok(None);
        };
        let read = || {
            let (node, Any) = field.good()?;
            let point = Tuple {
                what: self.what(key),
                names: ["x", "y"],
                limits: ANY,
                remedy: "write the two coordinates in [ ], in metres",
            };
            point.read(&self.checker.reader, node)
        };
        read().map(Some).ok_or(Reported)
    }

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
