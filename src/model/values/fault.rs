//! Where faults run: planes, listric surfaces, sections of one's own, and heights over the plan.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::limits::{ANY, AZIMUTH, Limits, POSITIVE};
use super::quantity::{Quantity, quantity};
use super::surface::{self, HorizonSurface};
use super::tuple::Tuple;
use crate::features::fault_surface::{FaultError, FaultSurface};
use crate::model::checker::Extent;
use crate::model::draws::{Draws, Reason};
use crate::model::kinds::keys::Keys;
use crate::model::kinds::made::Site;
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::tree::{NodeId, quoted};

/// Where a fault runs.
#[derive(Clone, Debug, PartialEq)]
pub enum FaultSurfaceSpec {
    /// A plane.
    Plane(FaultPlane),
    /// Flatter and flatter downwards.
    Listric {
        /// Where it passes, and how it dips there.
        plane: FaultPlane,
        /// How far below that point it is level (m).
        depth: Quantity,
        /// How it gets there.
        form: ListricForm,
    },
    /// A section across it, the same along all of its strike.
    Section {
        /// A point on it.
        through: [Quantity; 3],
        /// The direction of its dip, clockwise from north, degrees.
        azimuth_deg: Quantity,
        /// Distances from that point along the dip direction, growing, and heights above it (m).
        points: Vec<[f64; 2]>,
    },
    /// Heights over the plan.
    Heights(Box<HorizonSurface>),
    /// That of an older fault.
    Of(Reference),
}

/// A plane, or what is one at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultPlane {
    /// A point on it.
    pub through: [Quantity; 3],
    /// Its angle below the horizontal, degrees.
    pub dip_deg: Quantity,
    /// The direction of its dip, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
}

/// How a listric fault flattens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ListricForm {
    /// Along an arc of a circle, then level.
    Circular,
    /// Exponentially, level nowhere.
    Exponential,
}

/// The forms of a fault's surface that a horizon has not.
#[derive(Deserialize)]
pub(crate) struct FaultSurfaceFile {
    dipping: Option<Field<Any>>,
    listric: Option<Field<Any>>,
    section: Option<Field<Any>>,
}

/// A plane through a point.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FaultPlane")]
struct FaultPlaneFile {
    /// A point of it, [x, y, z].
    #[schemars(with = "[Quantity; 3]")]
    through: Field<Any>,
    /// Angle below the horizontal in degrees, above 0, 90 at most; 60 if left out.
    #[schemars(with = "Option<Quantity>")]
    dip_deg: Option<Field<Any>>,
    /// Direction of the dip in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    azimuth_deg: Field<Any>,
}

/// A fault that is flatter and flatter downwards, and goes straight up from the point where its dip is given.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Listric")]
struct ListricFile {
    /// A point of it, [x, y, z]; straight above, bent below.
    #[schemars(with = "[Quantity; 3]")]
    through: Field<Any>,
    /// Angle below the horizontal at that point in degrees, above 0 and below 90; 60 if left out.
    #[schemars(with = "Option<Quantity>")]
    dip_deg: Option<Field<Any>>,
    /// Direction of the dip in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    azimuth_deg: Field<Any>,
    /// How far below that point it becomes level, in metres, above 0.
    #[schemars(with = "Quantity")]
    depth: Field<Any>,
    /// "circular" (the default): along an arc that ends level at that depth; "exponential": ever nearer to it.
    #[schemars(schema_with = "form")]
    #[serde(default)]
    form: Option<Field<String>>,
}

/// A section across a fault, the same along all of its strike.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FaultSection")]
struct FaultSectionFile {
    /// A point, [x, y, z], from which the section is measured.
    #[schemars(with = "[Quantity; 3]")]
    through: Field<Any>,
    /// Direction of the dip in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    azimuth_deg: Field<Any>,
    /// Two points or more of the section, [distance along the dip direction, height above the point] in metres, the distances growing.
    points: Field<Vec<[f64; 2]>>,
}

fn form(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["circular", "exponential"] })
}

/// What editors are told of a fault's surface.
pub(crate) fn fault_surface_schema(generator: &mut SchemaGenerator) -> Schema {
    let plane = generator.subschema_for::<FaultPlaneFile>();
    let listric = generator.subschema_for::<ListricFile>();
    let section = generator.subschema_for::<FaultSectionFile>();
    let heights = generator.subschema_for::<HorizonSurface>();
    let one = |key: &str, mut schema: Schema| {
        let about = match key {
            "dipping" => "A plane.",
            "listric" => "Straight above its point, flatter and flatter below it.",
            _ => "A section across it, the same along all of its strike.",
        };
        schema.insert("description".to_owned(), about.into());
        json_schema!({
            "type": "object", "properties": { key: schema }, "required": [key], "additionalProperties": false,
        })
    };
    json_schema!({
        "description": "Where it runs: { dipping = { through, dip_deg, azimuth_deg } }, { listric = { through, dip_deg, azimuth_deg, depth } }, { section = { through, azimuth_deg, points } }, or heights over the plan as a horizon has them.",
        "anyOf": [one("dipping", plane), one("listric", listric), one("section", section), heights],
    })
}

/// Of a plane.
const DIP: Limits = Limits {
    low: 0.0,
    high: 90.0,
    open: false,
    words: "must lie above 0 and not above 90 degrees",
};
/// The usual dip of a normal fault, degrees.
const USUAL_DIP: f64 = 60.0;

/// Reads the surface of a fault.
pub(crate) fn fault_surface(keys: &mut Keys<'_, '_>, node: NodeId) -> Option<FaultSurfaceSpec> {
    let what = keys.what("surface");
    let reader = &keys.checker.reader;
    if reader.tree.number(node).is_some() {
        let found = reader.tree.describe(node);
        reader.wrong(
            node,
            format!("expected a table for {what}, found {found}"),
            "write { dipping = { through = [500, 500, -50], dip_deg = 60, azimuth_deg = 90 } }",
        );
        return None;
    }
    let file: FaultSurfaceFile = reader.table(node)?;
    let given = [
        ("dipping", file.dipping.is_some()),
        ("listric", file.listric.is_some()),
        ("section", file.section.is_some()),
    ];
    let forms: Vec<&str> = given.iter().filter(|one| one.1).map(|one| one.0).collect();
    if forms.is_empty() {
        let extent = Extent::from(keys.domain);
        let surface = keys.checker.surface(node, &what, extent, None)?;
        return Some(FaultSurfaceSpec::Heights(Box::new(surface)));
    }
    reader.close(node, &what);
    if forms.len() > 1 {
        reader.wrong(
            node,
            format!("{what} has {} forms: {}", forms.len(), forms.join(", ")),
            "keep one of them",
        );
        return None;
    }
    let table = |field: Option<Field<Any>>| field.and_then(Field::good).map(|(node, Any)| node);
    match forms[0] {
        "dipping" => {
            let node = table(file.dipping)?;
            let what = format!("the dipping of {what}");
            let plane: FaultPlaneFile = keys.checker.reader.table(node)?;
            keys.checker.reader.close(node, &what);
            let FaultPlaneFile {
                through,
                dip_deg,
                azimuth_deg,
            } = plane;
            plane_of(keys, (node, &what), through, dip_deg, azimuth_deg)
                .map(FaultSurfaceSpec::Plane)
        }
        "listric" => listric(
            keys,
            table(file.listric)?,
            &format!("the listric of {what}"),
        ),
        _ => section(
            keys,
            table(file.section)?,
            &format!("the section of {what}"),
        ),
    }
}

fn number(
    keys: &Keys<'_, '_>,
    (node, of): (NodeId, &str),
    field: Field<Any>,
    key: &str,
    example: &str,
    limits: Limits,
) -> Option<Quantity> {
    let reader = &keys.checker.reader;
    let (at, Any) = reader.need(field, node, of, key, example)?;
    quantity(reader, at, &format!("the {key} of {of}"), limits)
}

fn through(
    keys: &Keys<'_, '_>,
    (node, of): (NodeId, &str),
    field: Field<Any>,
) -> Option<[Quantity; 3]> {
    let reader = &keys.checker.reader;
    let (at, Any) = reader.need(field, node, of, "through", "through = [500, 500, -50]")?;
    let tuple = Tuple {
        what: format!("the through of {of}"),
        names: ["x", "y", "z"],
        limits: ANY,
        remedy: "write a point, as through = [500, 500, -50]",
    };
    tuple.read(reader, at)
}

fn plane_of(
    keys: &Keys<'_, '_>,
    of: (NodeId, &str),
    point: Field<Any>,
    dip: Option<Field<Any>>,
    azimuth: Field<Any>,
) -> Option<FaultPlane> {
    let point = through(keys, of, point);
    let dip = match dip {
        None => Some(Quantity::Constant(USUAL_DIP)),
        Some(dip) => number(keys, of, dip, "dip_deg", "dip_deg = 60", DIP),
    };
    let azimuth = number(
        keys,
        of,
        azimuth,
        "azimuth_deg",
        "azimuth_deg = 90",
        AZIMUTH,
    );
    Some(FaultPlane {
        through: point?,
        dip_deg: dip?,
        azimuth_deg: azimuth?,
    })
}

fn listric(keys: &Keys<'_, '_>, node: NodeId, what: &str) -> Option<FaultSurfaceSpec> {
    let reader = &keys.checker.reader;
    let file: ListricFile = reader.table(node)?;
    reader.close(node, what);
    let of = (node, what);
    let plane = plane_of(keys, of, file.through, file.dip_deg, file.azimuth_deg);
    let depth = number(keys, of, file.depth, "depth", "depth = 400", POSITIVE);
    let form = match file.form.map(Field::good) {
        None => Some(ListricForm::Circular),
        Some(None) => None,
        Some(Some((at, word))) => match word.as_str() {
            "circular" => Some(ListricForm::Circular),
            "exponential" => Some(ListricForm::Exponential),
            _ => {
                reader.wrong(
                    at,
                    format!("there is no form {} of a listric fault", quoted(&word)),
                    "write \"circular\" or \"exponential\"",
                );
                None
            }
        },
    };
    Some(FaultSurfaceSpec::Listric {
        plane: plane?,
        depth: depth?,
        form: form?,
    })
}

fn section(keys: &Keys<'_, '_>, node: NodeId, what: &str) -> Option<FaultSurfaceSpec> {
    let reader = &keys.checker.reader;
    let file: FaultSectionFile = reader.table(node)?;
    reader.close(node, what);
    let of = (node, what);
    let point = through(keys, of, file.through);
    let azimuth_deg = number(
        keys,
        of,
        file.azimuth_deg,
        "azimuth_deg",
        "azimuth_deg = 90",
        AZIMUTH,
    );
    let example = "points = [[-200, 300], [0, 0], [300, -200]]";
    let (at, points) = reader.need(file.points, node, what, "points", example)?;
    let is_good = points.len() >= 2
        && points.iter().flatten().all(|number| number.is_finite())
        && points.windows(2).all(|pair| pair[1][0] > pair[0][0]);
    if !is_good {
        reader.wrong(
            at,
            format!("the points of {what} are fewer than two, or their distances do not grow"),
            format!("write [distance along the dip direction, height], as {example}"),
        );
        return None;
    }
    Some(FaultSurfaceSpec::Section {
        through: point?,
        azimuth_deg: azimuth_deg?,
        points,
    })
}

impl FaultSurfaceSpec {
    /// The surface, drawn, and moved aside by a distance (m) where contacts coincide.
    pub(crate) fn draw(
        &self,
        site: &Site<'_>,
        aside: f64,
        draws: &mut Draws<'_>,
    ) -> Result<Arc<FaultSurface>, Reason> {
        let wrong = |error: FaultError| ("no fault", error.to_string());
        let (low, high) = site.domain.corners();
        let surface = match self {
            Self::Plane(plane) => {
                let (through, dip, azimuth) = plane.draw(draws, "surface.dipping", aside)?;
                FaultSurface::planar(through, dip, azimuth).map_err(wrong)?
            }
            Self::Listric { plane, depth, form } => {
                let (through, dip, azimuth) = plane.draw(draws, "surface.listric", aside)?;
                let depth = draws.quantity(depth, "surface.listric.depth")?;
                match form {
                    ListricForm::Circular => FaultSurface::circular(through, dip, azimuth, depth),
                    ListricForm::Exponential => {
                        FaultSurface::exponential(through, dip, azimuth, depth)
                    }
                }
                .map_err(wrong)?
            }
            Self::Section {
                through,
                azimuth_deg,
                points,
            } => {
                let through = draws.place(through, "surface.section.through")?;
                let azimuth = draws
                    .quantity(azimuth_deg, "surface.section.azimuth_deg")?
                    .to_radians();
                let through = through + aside * towards(azimuth).extend(0.0);
                FaultSurface::profile(through, azimuth, points).map_err(wrong)?
            }
            Self::Of(other) => {
                let event = site.other(other)?.made.event.as_ref();
                let surface = event.and_then(|event| event.surface.clone());
                return surface.ok_or_else(|| {
                    (
                        "no fault",
                        "what it slips on is no fault with a surface".to_owned(),
                    )
                });
            }
            Self::Heights(heights) => {
                let drawn = surface::horizon(heights, site.domain, draws.key);
                let (horizon, drawn) = drawn.map_err(|error| (error.reason, error.message))?;
                draws.drawn.extend(drawn);
                let horizon = horizon.lowered(aside);
                let middle = 0.5 * (low + high).xy();
                // It dips the way that it falls from end to end of the domain.
                let height = |x: f64, y: f64| horizon.height(x, y);
                let fall = DVec2::new(
                    (height(low.x, middle.y) - height(high.x, middle.y)) / (high.x - low.x),
                    (height(middle.x, low.y) - height(middle.x, high.y)) / (high.y - low.y),
                );
                let azimuth = fall.x.atan2(fall.y);
                FaultSurface::graph(horizon, middle, azimuth).map_err(wrong)?
            }
        };
        Ok(Arc::new(surface))
    }
}

impl FaultPlane {
    fn draw(
        &self,
        draws: &mut Draws<'_>,
        name: &str,
        aside: f64,
    ) -> Result<(DVec3, f64, f64), Reason> {
        let through = draws.place(&self.through, &format!("{name}.through"))?;
        let dip = draws.quantity(&self.dip_deg, &format!("{name}.dip_deg"))?;
        let azimuth = draws.quantity(&self.azimuth_deg, &format!("{name}.azimuth_deg"))?;
        let azimuth = azimuth.to_radians();
        let through = through + aside * towards(azimuth).extend(0.0);
        Ok((through, dip.to_radians(), azimuth))
    }
}

/// The unit vector of an azimuth (rad).
fn towards(azimuth: f64) -> DVec2 {
    DVec2::new(azimuth.sin(), azimuth.cos())
}

impl Draws<'_> {
    /// A point in space.
    pub(crate) fn place(
        &mut self,
        place: &[Quantity; 3],
        parameter: &str,
    ) -> Result<DVec3, Reason> {
        let x = self.quantity(&place[0], &format!("{parameter}.x"))?;
        let y = self.quantity(&place[1], &format!("{parameter}.y"))?;
        let z = self.quantity(&place[2], &format!("{parameter}.z"))?;
        Ok(DVec3::new(x, y, z))
    }
}
