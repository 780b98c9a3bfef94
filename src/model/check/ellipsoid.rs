//! Ellipsoids.

use super::feature::Draft;
use super::quantity::{ANY, AZIMUTH, Limits, PLUNGE, POSITIVE, quantity};
use super::tuple::Tuple;
use super::{Checker, Reported};
use crate::model::file::EllipsoidFile;
use crate::model::quantity::Quantity;
use crate::model::read::{Any, Field};
use crate::model::spec::{Domain, EllipsoidSpec};
use crate::model::tree::NodeId;

impl Checker<'_> {
    pub(super) fn ellipsoid(
        &mut self,
        draft: &Draft,
        domain: Option<&Domain>,
    ) -> Option<EllipsoidSpec> {
        let file: EllipsoidFile = self.reader.table(draft.node)?;
        let semi_axes = self
            .reader
            .need(
                file.semi_axes,
                draft.node,
                &draft.name,
                "semi_axes",
                "semi_axes = [3, 3, 1]",
            )
            .and_then(|(node, Any)| semi_axes_of(draft).read(&self.reader, node));
        let center = match file.center {
            None => Ok(None),
            Some(field) => field
                .good()
                .and_then(|(node, Any)| Some((node, center_of(draft).read(&self.reader, node)?)))
                .map(Some)
                .ok_or(Reported),
        };
        let azimuth = self.angle(file.azimuth_deg, draft, "azimuth_deg", AZIMUTH);
        let plunge = self.angle(file.plunge_deg, draft, "plunge_deg", PLUNGE);
        if let (Ok(Some((node, center))), Some(axes), Some(domain)) = (&center, &semi_axes, domain)
        {
            self.note_far_center(*node, center, axes, draft, domain);
        }
        Some(EllipsoidSpec {
            semi_axes: semi_axes?,
            center: center.ok()?.map(|(_, center)| center),
            azimuth_deg: azimuth?,
            plunge_deg: plunge?,
        })
    }

    /// An angle in degrees, 0 if it is left out.
    fn angle(
        &self,
        field: Option<Field<Any>>,
        draft: &Draft,
        key: &str,
        limits: Limits,
    ) -> Option<Quantity> {
        let Some(field) = field else {
            return Some(Quantity::Constant(0.0));
        };
        let (node, Any) = field.good()?;
        let what = format!("the {key} of {}", draft.name);
        quantity(&self.reader, node, &what, limits)
    }

    /// Says so if nothing of an ellipsoid can lie in the domain: not even a sphere of its longest axis.
    fn note_far_center(
        &mut self,
        node: NodeId,
        center: &[Quantity; 3],
        semi_axes: &[Quantity; 3],
        draft: &Draft,
        domain: &Domain,
    ) {
        let reach = semi_axes
            .iter()
            .map(|axis| axis.support().1)
            .fold(0.0, f64::max);
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
                .is_some_and(|(x, y)| self.is_in_world([x, y], domain.x, domain.y));
            let remedy = if in_world {
                "; its center is given in the world: subtract the model's origin"
            } else {
                ""
            };
            self.note(
                node,
                format!(
                    "{} lies outside the domain, so it has no volume{remedy}",
                    draft.name
                ),
            );
        }
    }
}

fn semi_axes_of(draft: &Draft) -> Tuple<'static, 3> {
    Tuple {
        what: format!("the semi_axes of {}", draft.name),
        names: ["first", "second", "third"],
        limits: POSITIVE,
        remedy: "write the three semi-axes (half of length, width and height) in [ ], in metres",
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
