//! Ellipsoids: concretions, cemented nodules.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Site};
use crate::features::body::Body;
use crate::features::ellipsoid::EllipsoidDesign;
use crate::model::draft::Draft;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::values::limits::{AZIMUTH, PLUNGE, POSITIVE};
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

    const CONFORMS: bool = true;

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        EllipsoidFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: EllipsoidFile = keys.table()?;
        let semi_axes = keys
            .need(file.semi_axes, "semi_axes", "semi_axes = [3, 3, 1]")
            .and_then(|(node, Any)| semi_axes_of(keys.draft).read(&keys.checker.reader, node));
        let center = keys.center(file.center);
        let azimuth = keys.optional_quantity(file.azimuth_deg, "azimuth_deg", AZIMUTH);
        let plunge = keys.optional_quantity(file.plunge_deg, "plunge_deg", PLUNGE);
        if let (Ok(Some((node, center))), Some(axes), Some(domain)) =
            (&center, &semi_axes, keys.domain)
        {
            let longest = axes.iter().map(|axis| axis.support().1);
            keys.note_far_center(*node, center, longest.fold(0.0, f64::max), domain);
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
        let center = site.center(self.center.as_ref(), draws)?;
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
        Ok(Made::body(Body::Ellipsoid(ellipsoid), draws.taken()).at_level(center.z))
    }

    fn wants_interior(&self) -> bool {
        self.center.is_none()
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
