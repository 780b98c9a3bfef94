//! The shape of a lobe: its sizes, its direction, and how it tapers.

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;

use super::limits::{AZIMUTH, Limits, POSITIVE};
use super::quantity::Quantity;
use crate::features::body::{Body, Role};
use crate::features::lobe::{LobeDesign, LobeLines};
use crate::model::checker::Reported;
use crate::model::draws::{Draws, Reason};
use crate::model::kinds::keys::Keys;
use crate::model::read::{Any, Field};
use crate::nurbs::Surface;

/// Length in widths, if the width is left out.
const ASPECT: f64 = 1.5;
/// An angle at which tetrahedra are not flat (degrees).
const STEEP: f64 = 20.0;
const TAPER: f64 = 0.5;
const SKEW: f64 = 0.3;

const SHAPE: Limits = Limits {
    low: -0.9,
    high: 0.9,
    open: false,
    words: "must lie between -0.9 and 0.9",
};

/// The lines of lobes whose contacts coincide and are decided by age (m): away from whatever would run along them.
pub(crate) fn lines_by_age(nudge: f64) -> LobeLines {
    if nudge == 0.0 {
        LobeLines::default()
    } else {
        LobeLines::ASIDE
    }
}

/// The shape of a lobe.
#[derive(Clone, Debug, PartialEq)]
pub struct LobeShape {
    /// Length along the axis; chosen by what it lies at if absent.
    pub length: Option<Quantity>,
    /// Width across; chosen by what it lies at, or two thirds of the length, if absent.
    pub width: Option<Quantity>,
    /// Greatest thickness; chosen by what it lies at if absent.
    pub thickness: Option<Quantity>,
    /// Direction of the axis, downstream, clockwise from north, degrees; chosen by what it lies at if absent.
    pub azimuth_deg: Option<Quantity>,
    /// How much wider it is downstream.
    pub taper: Quantity,
    /// How much thicker it is upstream.
    pub skew: Quantity,
}

/// The keys of a lobe's shape.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LobeShapeFile {
    /// Length along the axis in metres, above 0.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) length: Option<Field<Any>>,
    /// Width across in metres, above 0: that of the ellipse without taper; two thirds of the length if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) width: Option<Field<Any>>,
    /// Greatest thickness in metres, above 0.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) thickness: Option<Field<Any>>,
    /// Direction of the axis, downstream, in degrees, clockwise from north.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) azimuth_deg: Option<Field<Any>>,
    /// How much wider it is downstream than upstream, between -0.9 and 0.9 (0 is an ellipse in plan); 0.5 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) taper: Option<Field<Any>>,
    /// How much thicker it is upstream than downstream, between -0.9 and 0.9; 0.3 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) skew: Option<Field<Any>>,
}

impl Keys<'_, '_> {
    /// The keys of a lobe's shape in the feature's own table; length, thickness and azimuth must be there unless something else says what
    /// they are.
    pub(crate) fn lobe_shape(&self, is_free: bool) -> Option<LobeShape> {
        let file: LobeShapeFile = self.table()?;
        let needed = |field: Option<Field<Any>>, key: &str, example: &str, limits: Limits| {
            if field.is_none() && is_free {
                return Ok(None);
            }
            let field = field.unwrap_or(Field::Missing);
            self.quantity(field, key, example, limits)
                .map(Some)
                .ok_or(Reported)
        };
        let length = needed(file.length, "length", "length = 1350", POSITIVE);
        let width = self.optional_quantity(file.width, "width", POSITIVE);
        let thickness = needed(file.thickness, "thickness", "thickness = 4", POSITIVE);
        let azimuth = needed(file.azimuth_deg, "azimuth_deg", "azimuth_deg = 90", AZIMUTH);
        let taper = self.optional_quantity(file.taper, "taper", SHAPE);
        let skew = self.optional_quantity(file.skew, "skew", SHAPE);
        let or =
            |given: Option<Quantity>, default: f64| given.unwrap_or(Quantity::Constant(default));
        Some(LobeShape {
            length: length.ok()?,
            width: width.ok()?,
            thickness: thickness.ok()?,
            azimuth_deg: azimuth.ok()?,
            taper: or(taper.ok()?, TAPER),
            skew: or(skew.ok()?, SKEW),
        })
    }
}

impl Draws<'_> {
    /// The shape drawn, of a lobe that is nowhere yet, or is like another one but for what is given; the parameters' names begin with a
    /// prefix.
    pub(crate) fn lobe_shape(
        &mut self,
        shape: &LobeShape,
        prefix: &str,
        like: Option<&LobeDesign>,
    ) -> Result<LobeDesign, Reason> {
        let mut draw = |given: Option<&Quantity>, key: &str, default: Option<f64>| match given {
            Some(quantity) => self.quantity(quantity, &format!("{prefix}{key}")),
            None => default.ok_or_else(|| ("impossible lobe", format!("it has no {key}"))),
        };
        let default = |of: fn(&LobeDesign) -> f64| like.map(of);
        let length = draw(shape.length.as_ref(), "length", default(|one| one.length))?;
        let width = default(|one| one.width).unwrap_or(length / ASPECT);
        let degrees = default(|one| one.azimuth.to_degrees());
        Ok(LobeDesign {
            center: DVec3::ZERO,
            length,
            width: draw(shape.width.as_ref(), "width", Some(width))?,
            thickness: draw(
                shape.thickness.as_ref(),
                "thickness",
                default(|one| one.thickness),
            )?,
            azimuth: draw(shape.azimuth_deg.as_ref(), "azimuth_deg", degrees)?.to_radians(),
            taper: draw(Some(&shape.taper), "taper", None)?,
            skew: draw(Some(&shape.skew), "skew", None)?,
        })
    }
}

/// A kind's own table with the keys of a lobe's shape, of which some must be there.
pub(crate) fn with_shape(own: Schema, needed: &[&str], generator: &mut SchemaGenerator) -> Schema {
    let mut shape = LobeShapeFile::json_schema(generator);
    let mut own = own;
    let all = own.get_mut("properties").and_then(Value::as_object_mut);
    if let (Some(own), Some(Value::Object(more))) = (all, shape.remove("properties")) {
        own.extend(more);
    }
    own.insert("required".to_owned(), needed.into());
    own
}

/// What is to be said of lobes, with their names, when they are meshed: at what angle the thinnest rim opens.
pub(crate) fn thin_rims<'a>(
    lobes: impl Iterator<Item = (&'a Body, &'a str)>,
    what: &str,
) -> Option<String> {
    let opening = |body: &Body| {
        let Body::Shell(shell) = body else {
            return None;
        };
        let of = |role: Role| shell.sheets().iter().filter(move |sheet| sheet.0 == role);
        let mut bases = of(Role::Base);
        let angles = of(Role::Top).map(|(_, top)| {
            let (u, (from, to)) = (top.knots_u().domain().1, top.knots_v().domain());
            let outward = |sheet: &Surface| sheet.derivatives(u, f64::midpoint(from, to), 1)[1][0];
            let cap = outward(top);
            // Against its base; of one that is filled down, against the horizontal.
            let base = bases.next();
            cap.angle_between(base.map_or(cap.with_z(0.0), |(_, base)| outward(base)))
        });
        angles.min_by(f64::total_cmp)
    };
    let (angle, name) = lobes
        .filter_map(|(body, name)| Some((opening(body)?.to_degrees(), name)))
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    let stretch = (STEEP / angle).ceil();
    Some(format!(
        "{what} thin out to nothing at their rims, at {angle:.1}° ({name}), and tetrahedra there are as flat. Where that matters, stretch the          model {stretch} times upwards before it is meshed, and the mesh back after"
    ))
}
