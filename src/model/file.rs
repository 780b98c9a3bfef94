//! The tables of a model file, as they are written.
//!
//! These types are both the reader (serde) and the published schema (schemars), so neither can drift from the other; the
//! doc comments are what an editor shows. Values of several shapes are [`Any`] here and are told apart in `check`.
#![allow(
    dead_code,
    reason = "the fields named `kind` are read by hand, before it is known which table to read"
)]

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

use super::profile::Profile;
use super::quantity::Quantity;
use super::read::{Any, Field};
use super::schema;
use super::spec::{HorizonSurface, Selector};

/// A surface-based geological model. Lengths in metres, x east, y north, z up; azimuths clockwise from north.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Model")]
pub(crate) struct ModelFile {
    /// What the model is called.
    pub(crate) name: Field<String>,
    /// A sentence or two about the model.
    pub(crate) description: Option<Field<String>>,
    /// Seed of all random draws, a whole number from 0; 1 if left out. The same seed gives the same model.
    pub(crate) seed: Option<Field<u64>>,
    /// Where the local origin lies in the world, [easting, northing] or [easting, northing, elevation] in metres. Recorded in the results, never added to the coordinates.
    #[schemars(schema_with = "schema::origin")]
    #[serde(default)]
    pub(crate) origin: Option<Field<Any>>,
    /// The block that is modelled.
    #[schemars(with = "DomainFile")]
    pub(crate) domain: Field<Any>,
    /// The facies by name: what the volumes are made of.
    #[schemars(with = "BTreeMap<String, FaciesFile>")]
    pub(crate) facies: Field<Any>,
    /// The features, from oldest to youngest.
    #[schemars(schema_with = "schema::features")]
    #[serde(default)]
    pub(crate) feature: Option<Field<Any>>,
}

/// The modelled block. Before any feature, all of it is the volume `background`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Domain")]
pub(crate) struct DomainFile {
    /// [west, east] limits in metres.
    pub(crate) x: Field<[f64; 2]>,
    /// [south, north] limits in metres.
    pub(crate) y: Field<[f64; 2]>,
    /// [base, top] elevations in metres; z points up.
    pub(crate) z: Field<[f64; 2]>,
    /// A base within `z`: below it the model has nothing.
    #[schemars(with = "Option<HorizonSurface>")]
    pub(crate) base: Option<Field<Any>>,
    /// A top within `z`: above it the model has nothing.
    #[schemars(with = "Option<HorizonSurface>")]
    pub(crate) top: Option<Field<Any>>,
    /// A bed thinner than this, in metres, at the nodes of its horizons' grids is absent there; a ten-billionth of the domain's diagonal if left out.
    #[schemars(range(min = 0))]
    pub(crate) least_thickness: Option<Field<f64>>,
    /// The facies of the background.
    pub(crate) facies: Field<String>,
}

/// A facies. Any further key with a number (or [x, y, z]) is a rock property of its own.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "Facies", extend("additionalProperties" = schema::property()))]
pub(crate) struct FaciesFile {
    /// Colour in pictures and files, "#rrggbb".
    #[schemars(regex(pattern = "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$"))]
    pub(crate) color: Option<Field<String>>,
    /// A sentence about the facies.
    pub(crate) description: Option<Field<String>>,
    /// Whether the facies counts as net (reservoir) rock.
    pub(crate) net: Option<Field<bool>>,
    /// Porosity, a fraction from 0 to 1.
    #[schemars(range(min = 0, max = 1))]
    pub(crate) porosity: Option<Field<f64>>,
    /// Permeability in millidarcy: one number, or [x, y, z].
    #[schemars(schema_with = "schema::permeability")]
    #[serde(default)]
    pub(crate) permeability: Option<Field<Any>>,
}

/// What every feature has, whatever its kind.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FeatureFile {
    /// Its name: letters, digits, `-` and `_`; unique in the model.
    #[schemars(regex(pattern = "^[A-Za-z0-9_-]+$"))]
    pub(crate) id: Field<String>,
    /// What it is.
    pub(crate) kind: Field<String>,
    /// Whether it takes part; true if left out.
    pub(crate) enabled: Option<Field<bool>>,
    /// How many are made (of each instance of the parent); 1 if left out.
    #[schemars(range(min = 1, max = 10000))]
    pub(crate) count: Option<Field<u64>>,
    /// Hierarchical level, 1 = largest; if left out, one more than the parent's, or 1.
    #[schemars(range(min = 1, max = 1000))]
    pub(crate) level: Option<Field<u64>>,
    /// Id of the feature that it lies in.
    pub(crate) parent: Option<Field<String>>,
    /// The facies of what it bounds.
    pub(crate) facies: Field<String>,
    /// What it may remove: "older" (the default), "everything", "nothing", or a list of ids, { kind = … }, { level = … }, { facies = … }.
    #[schemars(with = "Option<Selector>")]
    pub(crate) removes: Option<Field<Any>>,
    /// What may remove it: "younger" (the default), "everything", "nothing" or [], or a list as in `removes`.
    #[schemars(with = "Option<Selector>")]
    pub(crate) removed_by: Option<Field<Any>>,
    /// If true, it removes nothing but its parent and the background.
    pub(crate) preserve: Option<Field<bool>>,
}

/// A channel: a section carried along a trajectory.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ChannelFile {
    /// Width of the top in metres.
    #[schemars(with = "Profile")]
    pub(crate) width: Field<Any>,
    /// Depth of the deepest point below the top, in metres.
    #[schemars(with = "Profile")]
    pub(crate) depth: Field<Any>,
    /// How far right of the centre the deepest point lies, as a fraction of the width, between -0.5 and 0.5; 0 if left out.
    #[schemars(with = "Option<Profile>")]
    pub(crate) asymmetry: Option<Field<Any>>,
    /// Angle of the left bank (looking along the trajectory) below the horizontal at the rim, in degrees.
    #[schemars(with = "Option<Profile>")]
    pub(crate) left_angle_deg: Option<Field<Any>>,
    /// Angle of the right bank below the horizontal at the rim, in degrees.
    #[schemars(with = "Option<Profile>")]
    pub(crate) right_angle_deg: Option<Field<Any>>,
    /// Elevation of the top in metres; if left out, uniform between the base of the domain + depth and its top.
    #[schemars(with = "Option<Profile>")]
    pub(crate) top: Option<Field<Any>>,
    /// Which point of the section follows the trajectory: "thalweg" (the default) or "top-centre".
    #[schemars(schema_with = "schema::section_origin")]
    #[serde(default)]
    pub(crate) origin: Option<Field<String>>,
    /// The way that the channel takes, in plan.
    #[schemars(schema_with = "schema::trajectory")]
    pub(crate) trajectory: Field<Any>,
    /// A new section is set where the direction has turned by more than this, in degrees; 15 if left out.
    #[schemars(range(min = 0.1, max = 90))]
    pub(crate) angle_limit_deg: Option<Field<f64>>,
    /// How far thalweg and rims may lie from where they belong, as a fraction of the width; 0.01 if left out.
    #[schemars(range(min = 0.00001, max = 0.5))]
    pub(crate) tolerance_fraction: Option<Field<f64>>,
}

/// An ellipsoid: a concretion or a cemented nodule, closed on all sides.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct EllipsoidFile {
    /// Semi-axes [a, b, c] in metres: a along azimuth and plunge, b level and across it, c at right angles to both (vertical if the plunge is 0).
    #[schemars(with = "[Quantity; 3]")]
    pub(crate) semi_axes: Field<Any>,
    /// Centre, [x, y, z]; if left out, uniform over the domain, or over what the parent has of it.
    #[schemars(with = "Option<[Quantity; 3]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Direction of the first axis in degrees, clockwise from north; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) azimuth_deg: Option<Field<Any>>,
    /// Angle of the first axis below the horizontal in degrees, between -90 and 90; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) plunge_deg: Option<Field<Any>>,
}

/// A horizon: a surface through the whole domain, with a new unit above it, up to the next horizon or the domain's top.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct HorizonFile {
    /// Where it runs.
    #[schemars(schema_with = "schema::horizon_surface")]
    pub(crate) surface: Field<Any>,
    /// "erosive" (the default): its unit takes everything above the surface; "onlapping": only what the unit below and its children hold.
    #[schemars(schema_with = "schema::relation")]
    #[serde(default)]
    pub(crate) relation: Option<Field<String>>,
}

/// Clinoforms: sheets that divide the unit of a horizon (`parent`) into clinothems.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ClinoformsFile {
    /// Id of the horizon that bounds the unit above, or "domain"; if left out, the next horizon, or the domain's top.
    pub(crate) top: Option<Field<String>>,
    /// Direction of progradation in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
    /// Semi-extents of the shoreline's ellipse, [along dip, along strike], in metres; [3000, 6000] if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) shoreline: Option<Field<Any>>,
    /// Plan distance from a clinoform's shoreline to its toe, in metres.
    #[schemars(with = "Quantity")]
    pub(crate) length: Field<Any>,
    /// Distance from a clinoform to the next along the progradation, in metres.
    #[schemars(with = "Quantity")]
    pub(crate) spacing: Field<Any>,
    /// Distance from the domain's landward corner to the first clinoform's shoreline, in metres.
    #[schemars(with = "Quantity")]
    pub(crate) first: Field<Any>,
    /// Exponent of the dip profile; 2 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) exponent: Option<Field<Any>>,
    /// How straight the profile meets its base, from 0 (tangent) to 1 (straight); if left out, 0 between level bounds and 0.3 otherwise.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) toe: Option<Field<Any>>,
    /// How many clinoforms; as many as have their shoreline in the domain if left out.
    #[schemars(range(min = 1, max = 500))]
    pub(crate) sheets: Option<Field<u64>>,
    /// Shape of the boundaries between belts: "smooth" (the default) or "zigzag".
    #[schemars(schema_with = "schema::interfingering")]
    #[serde(default)]
    pub(crate) interfingering: Option<Field<String>>,
    /// Least and greatest distance along strike from one turn of the boundaries between belts to the next, in metres; a thirteenth and
    /// two thirteenths of the strikes that sheets run over if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) turns: Option<Field<Any>>,
    /// Facies belts of each clinothem, from landward to basinward; without them a clinothem is one volume.
    #[schemars(with = "Option<Vec<BeltFile>>", length(min = 1))]
    pub(crate) belts: Option<Field<Any>>,
}

/// A facies belt.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Belt")]
pub(crate) struct BeltFile {
    /// Its name: letters, digits, `-` and `_`; unique in the set.
    #[schemars(regex(pattern = "^[A-Za-z0-9_-]+$"))]
    pub(crate) name: Field<String>,
    /// Its facies.
    pub(crate) facies: Field<String>,
    /// Width along dip in metres; every belt but the last has one.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) width: Option<Field<Any>>,
    /// How far its basinward boundary swings, from peak to peak, in metres; 0 if left out. The last belt has no such boundary.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) interfingering: Option<Field<Any>>,
}

/// The table of a surface: one of `level`, `dipping`, `grid`, `points`, or `above` with `thickness`.
#[derive(Deserialize)]
pub(crate) struct SurfaceFile {
    pub(crate) above: Option<Field<String>>,
    pub(crate) thickness: Option<Field<Any>>,
    pub(crate) level: Option<Field<Any>>,
    pub(crate) dipping: Option<Field<Any>>,
    pub(crate) grid: Option<Field<Any>>,
    pub(crate) points: Option<Field<Any>>,
    pub(crate) tolerance: Option<Field<f64>>,
}

/// The table of a thickness: one of `grid`, `points`.
#[derive(Deserialize)]
pub(crate) struct ThicknessFile {
    pub(crate) grid: Option<Field<Any>>,
    pub(crate) points: Option<Field<Any>>,
    pub(crate) tolerance: Option<Field<f64>>,
}

/// A plane through a point.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Dipping")]
pub(crate) struct DippingFile {
    /// A point of the plane, [x, y, z].
    #[schemars(with = "[Quantity; 3]")]
    pub(crate) through: Field<Any>,
    /// Angle below the horizontal in degrees, from 0 to 89.
    #[schemars(with = "Quantity")]
    pub(crate) dip_deg: Field<Any>,
    /// Direction of the dip in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
}

/// Heights at the nodes of a regular grid, met exactly.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Grid")]
pub(crate) struct GridFile {
    /// [west, east]: x of the first and the last value of a row.
    pub(crate) x: Field<[f64; 2]>,
    /// [south, north]: y of the first and the last row.
    pub(crate) y: Field<[f64; 2]>,
    /// Rows from south to north, each with its heights from west to east; at least 2 × 2.
    #[schemars(with = "Vec<Vec<f64>>", length(min = 2))]
    pub(crate) heights: Field<Any>,
}

/// What every trajectory has.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TrajectoryFile {
    /// What it is.
    pub(crate) kind: Field<String>,
}

/// A straight line: either `from` and `to`, or `azimuth_deg` with an optional `center` and `length`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LineFile {
    /// Start, [x, y].
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) from: Option<Field<Any>>,
    /// End, [x, y].
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) to: Option<Field<Any>>,
    /// Direction in degrees, clockwise from north.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) azimuth_deg: Option<Field<Any>>,
    /// A point of the line, its middle if a length is given; uniform over the domain if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Length in metres; right across the domain if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) length: Option<Field<Any>>,
}

/// A curve through points.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PointsFile {
    /// The points [x, y] in order, at least two.
    #[schemars(with = "Vec<[f64; 2]>", length(min = 2))]
    pub(crate) points: Field<Any>,
    /// How the curve's parameter is spread over the points: "centripetal" (the default) or "chord-length".
    #[schemars(schema_with = "schema::parametrization")]
    #[serde(default)]
    pub(crate) parametrization: Option<Field<String>>,
    /// Degree of the curve, 1 (straight pieces) to 3 (the default), below the number of points.
    #[schemars(range(min = 1, max = 3))]
    pub(crate) degree: Option<Field<u64>>,
}

/// A sine-generated curve: the direction swings as a sine along the way, as meanders do.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SineGeneratedFile {
    /// Half of peak to peak, in metres.
    #[schemars(with = "Quantity")]
    pub(crate) amplitude: Field<Any>,
    /// Length of one meander along the mean direction, in metres.
    #[schemars(with = "Quantity")]
    pub(crate) wavelength: Field<Any>,
    /// Mean direction in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
    /// Middle of the curve, [x, y]; uniform over the domain if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Where the curve is in its meander at the centre, as a fraction of a wavelength; uniform if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) phase: Option<Field<Any>>,
    /// Length along the mean direction in metres; right across the domain if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) length: Option<Field<Any>>,
}

/// Two formulas in `t`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ParametricFile {
    /// x in metres, a formula in t as "1000 * t".
    pub(crate) x: Field<String>,
    /// y in metres, a formula in t as "500 + 80 * sin(2 * pi * t)".
    pub(crate) y: Field<String>,
    /// From which t to which; [0, 1] if left out.
    pub(crate) range: Option<Field<[f64; 2]>>,
}

/// A distribution: one of the five names, and `min` and `max` to truncate a normal or lognormal one.
#[derive(Deserialize)]
pub(crate) struct DistributionFile {
    pub(crate) uniform: Option<Field<[f64; 2]>>,
    pub(crate) triangular: Option<Field<[f64; 3]>>,
    pub(crate) normal: Option<Field<[f64; 2]>>,
    pub(crate) lognormal: Option<Field<[f64; 2]>>,
    pub(crate) discrete: Option<Field<Any>>,
    pub(crate) min: Option<Field<f64>>,
    pub(crate) max: Option<Field<f64>>,
}

/// A formula where a profile is wanted.
#[derive(Deserialize)]
pub(crate) struct ExpressionFile {
    pub(crate) expression: Field<String>,
}

/// An entry of a selector's list that is no id.
#[derive(Deserialize)]
pub(crate) struct PickFile {
    pub(crate) id: Option<Field<String>>,
    pub(crate) kind: Option<Field<String>>,
    pub(crate) level: Option<Field<u64>>,
    pub(crate) facies: Option<Field<String>>,
}
