//! Ellipsoids: concretions, cemented nodules.

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::Kind;
use super::keys::Keys;
use super::made::{Made, Site};
use crate::features::body::Body;
use crate::features::ellipsoid::EllipsoidDesign;
use crate::model::checker::Reported;
use crate::model::domain::Domain;
use crate::model::draft::Draft;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;
use crate::model::values::limits::{ANY, AZIMUTH, PLUNGE, POSITIVE};
use crate::model::values::quantity::Quantity;
use crate::model::values::tuple::Tuple;

/// An ellipsoid: a concretion, a cemented nodule.
#[derive(Clone, Debug, PartialEq)]
pub struct EllipsoidSpec {
    /// Semi-axes: along azimuth and plunge, level across it, at right angles to both.
    pub semi_axes: [Quantity; 3],
    /// The centre; uniform over what the parent has of the domain, or over the domain, if absent.
    pub center: Option<[Quantity; 3]>,
    /// Direction of the first axis in plan, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
    /// Angle of the first axis below the horizontal, degrees.
    pub plunge_deg: Quantity,
}

/// An ellipsoid: a concretion or a cemented nodule, closed on all sides.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct EllipsoidFile {
    /// Semi-axes [a, b, c] in metres, above 0 (half of length, width and height): a along azimuth and plunge, b level and across it, c at right angles to both (vertical if the plunge is 0).
    #[schemars(with = "[Quantity; 3]")]
    pub(crate) semi_axes: Field<Any>,
    /// Centre, [x, y, z]; if left out, uniform over the domain, or, for a child, over what its parent has of it. A centre outside the parent is drawn again and counted.
    #[schemars(with = "Option<[Quantity; 3]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Direction of the first axis in degrees, clockwise from north; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) azimuth_deg: Option<Field<Any>>,
    /// Angle of the first axis below the horizontal in degrees, between -90 and 90; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) plunge_deg: Option<Field<Any>>,
}

impl Kind for EllipsoidSpec {
    const NATURE: Nature = Nature {
        name: "ellipsoid",
        copies: Copies::Any,
        within: Within::Anything,
        children: Children::Any,
        taking: Taking::ByRules,
        volumes: Volumes::One,
        is_base: false,
        placed_by: "set its `center`",
        apart: "move the `center` of {name} by {by} or more, or change its `semi_axes`",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        EllipsoidFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: EllipsoidFile = keys.table()?;
        let semi_axes = keys
            .need(file.semi_axes, "semi_axes", "semi_axes = [3, 3, 1]")
            .and_then(|(node, Any)| semi_axes_of(keys.draft).read(&keys.checker.reader, node));
        let center = match file.center {
            None => Ok(None),
            Some(field) => field
                .good()
                .and_then(|(node, Any)| {
                    let center = center_of(keys.draft).read(&keys.checker.reader, node)?;
                    Some((node, center))
                })
                .map(Some)
                .ok_or(Reported),
        };
        let azimuth = keys.optional_quantity(file.azimuth_deg, "azimuth_deg", AZIMUTH);
        let plunge = keys.optional_quantity(file.plunge_deg, "plunge_deg", PLUNGE);
        if let (Ok(Some((node, center))), Some(axes), Some(domain)) =
            (&center, &semi_axes, keys.domain)
        {
            keys.note_far_center(*node, center, axes, domain);
        }
        let level = || Quantity::Constant(0.0);
        Some(Self {
            semi_axes: semi_axes?,
            center: center.ok()?.map(|(_, center)| center),
            azimuth_deg: azimuth.ok()?.unwrap_or_else(level),
            plunge_deg: plunge.ok()?.unwrap_or_else(level),
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let mut semi_axes = [0.0; 3];
        for ((value, quantity), name) in semi_axes
            .iter_mut()
            .zip(&self.semi_axes)
            .zip(["a", "b", "c"])
        {
            *value = draws.quantity(quantity, &format!("semi_axes.{name}"))?;
        }
        let center = match &self.center {
            Some([x, y, z]) => DVec3::new(
                draws.quantity(x, "center.x")?,
                draws.quantity(y, "center.y")?,
                draws.quantity(z, "center.z")?,
            ),
            None => site.center(draws)?,
        };
        let design = EllipsoidDesign {
            center,
            semi_axes,
            azimuth: draws
                .quantity(&self.azimuth_deg, "azimuth_deg")?
                .to_radians(),
            plunge: draws.quantity(&self.plunge_deg, "plunge_deg")?.to_radians(),
        };
        let ellipsoid = design
            .build()
            .map_err(|error| (error.reason(), error.to_string()))?;
        Ok(Made::body(Body::Ellipsoid(ellipsoid), draws.taken()))
    }

    fn wants_interior(&self) -> bool {
        self.center.is_none()
    }
}

impl Site<'_> {
    /// A point that is uniform over the domain, or over what the parent has of it.
    fn center(self, draws: &mut Draws<'_>) -> Result<DVec3, Reason> {
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
    /// Says so if nothing of an ellipsoid can lie in the domain: not even a sphere of its longest axis.
    fn note_far_center(
        &mut self,
        node: NodeId,
        center: &[Quantity; 3],
        semi_axes: &[Quantity; 3],
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
