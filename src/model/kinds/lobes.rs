//! Lobes that lie on each other, and fill each other's hollows: compensational stacking.

use glam::DVec2;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Frame, Made, Outcome, Part, Site, TakesFrom, VolumeName};
use crate::features::body::Body;
use crate::features::conform::{Target, conform};
use crate::features::fabric::{Fabric, mean_slope};
use crate::features::horizon::Horizon;
use crate::features::lobe::{Lobe, LobeDesign, LobeLines};
use crate::features::shell::Shell;
use crate::features::stacking::{Pile, Region, Stack, filled};
use crate::features::trajectory::azimuth_vector;
use crate::model::checker::Reported;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::{NodeId, Value};
use crate::model::values::limits::{Limits, NOT_NEGATIVE};
use crate::model::values::lobe::{LobeShape, lines_by_age, thin_rims, with_shape};
use crate::model::values::quantity::Quantity;

/// The most lobes of one set.
const MOST_LOBES: u64 = 1000;
const COMPENSATION: f64 = 5.0;
/// Nodes of the surface that a lobe lies on, in its width.
const NODES: f64 = 10.0;
/// How far that reaches beyond the lobe, as a fraction of its plan.
const MARGIN: f64 = 0.15;
/// How far a lobe may be from where its floor says, in deviations of the floor.
const WITHIN: f64 = 0.5;
/// The same where the floor is exact, as a fraction of the thickness; and how far a lobe is sunk there.
const LEAST: f64 = 0.005;

/// How far below the lowest place of what all lobes lie on their hidden bases are, in thicknesses; and how much farther that of each
/// younger one is.
const BELOW: f64 = 0.6;
const STAGGER: f64 = 0.01;
/// Places along the sides of a lobe's plan among which the lowest one is looked for.
const PLACES: usize = 20;

const EROSION: Limits = Limits {
    low: 0.0,
    high: 1.0,
    open: false,
    words: "must lie between 0 and 1 (a fraction of each lobe's thickness)",
};

/// Lobes that lie on each other.
#[derive(Clone, Debug, PartialEq)]
pub struct LobesSpec {
    /// How many.
    pub count: usize,
    /// The shape of each.
    pub shape: LobeShape,
    /// Corners of the polygon in plan in which their middles are; that of the domain if absent.
    pub region: Option<Vec<[f64; 2]>>,
    /// How strongly lobes prefer low places: 0 is not at all.
    pub compensation: Quantity,
    /// How deep each erodes what it lies on, as a fraction of its thickness.
    pub erosion: Quantity,
}

/// Lobes that lie on each other (`count` of them, the first one the oldest): each lies on what is there, and prefers the hollows between older ones.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LobesFile {
    /// Where the middles of lobes may be, in plan: { x = [smaller, larger], y = [smaller, larger] }, or a list of the corners [x, y] of a polygon; that of the domain if left out.
    #[schemars(schema_with = "region")]
    #[serde(default)]
    pub(crate) region: Option<Field<Any>>,
    /// How strongly lobes prefer low places, 0 (not at all) or more (20: always the lowest one); 5 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) compensation: Option<Field<Any>>,
    /// How deep each lobe erodes what it lies on, as a fraction of its thickness from 0 to 1; 0 (older ones stay whole) if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) erosion: Option<Field<Any>>,
}

/// A rectangle in plan.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Rectangle")]
pub(crate) struct RectangleFile {
    /// [west, east].
    pub(crate) x: Field<[f64; 2]>,
    /// [south, north].
    pub(crate) y: Field<[f64; 2]>,
}

fn region(generator: &mut SchemaGenerator) -> Schema {
    let rectangle = RectangleFile::json_schema(generator);
    let corner = json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 });
    let mut schema = rectangle;
    schema.insert("type".to_owned(), serde_json::json!(["object", "array"]));
    schema.insert("items".to_owned(), corner.to_value());
    schema.insert("minItems".to_owned(), 3.into());
    schema
}

impl Kind for LobesSpec {
    const NATURE: Nature = Nature {
        name: "lobes",
        copies: Copies::Members,
        within: Within::Unit {
            remedy: "lobes lie on the base of a unit: name a horizon, or leave `parent` out for the domain",
        },
        children: Children::None {
            what: "a stack of lobes",
            instead: "its unit",
        },
        taking: Taking::ByKind {
            how: "lobes fill what is above older ones",
            remedy: "leave it out; lobes that cut into what they lie on have an `erosion`",
        },
        volumes: Volumes::Many {
            most: MOST_LOBES,
            one: "lobe",
        },
        is_base: false,
        placed_by: "set its `region`",
        apart: "change `thickness` or `region` of {name} a little",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        let needed = ["count", "length", "thickness", "azimuth_deg"];
        with_shape(LobesFile::json_schema(generator), &needed, generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: LobesFile = keys.table()?;
        let count = keys.lobes_count();
        let shape = keys.lobe_shape(false);
        let region = keys.region(file.region);
        let compensation = keys.optional_quantity(file.compensation, "compensation", NOT_NEGATIVE);
        let erosion = keys.optional_quantity(file.erosion, "erosion", EROSION);
        let or =
            |given: Option<Quantity>, default: f64| given.unwrap_or(Quantity::Constant(default));
        Some(Self {
            count: count?,
            shape: shape?,
            region: region.ok()?,
            compensation: or(compensation.ok()?, COMPENSATION),
            erosion: or(erosion.ok()?, 0.0),
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let Frame::Unit(unit) = site.frame else {
            return Err(("no unit", "its parent is no horizon".to_owned()));
        };
        let compensation = draws.quantity(&self.compensation, "compensation")?;
        let erosion = draws.quantity(&self.erosion, "erosion")?;
        let datum = |at: DVec2| unit.height(at.x, at.y);
        let region = self.region_in(site)?;
        let lines = lines_by_age(site.nudge);
        let mut pile = Pile::new(&datum);
        let mut stack: Option<Stack> = None;
        let mut parts = Vec::with_capacity(self.count);
        let common = draws.drawn.clone();
        for number in 1..=self.count {
            let before = draws.drawn.len();
            let shape = draws.lobe_shape(&self.shape, &format!("{number}."), None)?;
            let stack = match &mut stack {
                Some(stack) => stack,
                // Places as dense as the first one is wide.
                none => none.insert(
                    Stack::new(region.clone(), shape.width)
                        .map_err(|error| ("impossible region", error.to_string()))?,
                ),
            };
            let center = next_center(stack, &shape, compensation, number, draws)?;
            let (lobe, shell, slope) = laid(shape.with_center(center), &mut pile, (erosion, lines))
                .map_err(|message| ("impossible lobe", format!("lobe {number}: {message}")))?;
            let body = if erosion > 0.0 {
                shell
            } else {
                // Below the unit, each at a level of its own.
                let depth = shape.thickness * (BELOW + STAGGER * number as f64);
                filled(&shell, lowest(unit, lobe.plan()) - depth)
                    .map_err(|error| ("impossible lobe", format!("lobe {number}: {error}")))?
            };
            stack.lay(&lobe, |at| pile.relief(at));
            let fabric = Fabric::along(azimuth_vector(shape.azimuth)).sheared(slope);
            let own = draws.drawn[before..].iter().map(|(key, value)| {
                let (_, key) = key.split_once('.').unwrap_or(("", key));
                (key.to_owned(), *value)
            });
            parts.push(Part {
                name: format!("-{number}"),
                drawn: common.iter().cloned().chain(own).collect(),
                fabric: Some(fabric),
                from: if erosion > 0.0 {
                    TakesFrom::Anything
                } else {
                    TakesFrom::ParentItself
                },
                ..Part::of(Body::Shell(body))
            });
        }
        Ok(Made::of(parts))
    }

    /// What `7` is.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        VolumeName::numbered(rest, self.count)
    }

    /// Lobes thin out to nothing at their rims.
    fn meshing(made: &[Outcome<'_>]) -> Option<String> {
        thin_rims(made.iter().map(|one| (one.body, one.name)), "stacked lobes")
    }
}

/// Where the middle of the next lobe is; that is what is remembered of the draws.
fn next_center(
    stack: &Stack,
    shape: &LobeDesign,
    compensation: f64,
    number: usize,
    draws: &mut Draws<'_>,
) -> Result<DVec2, Reason> {
    let mut place = |key: &str| draws.uniform(0.0, 1.0, &format!("{number}.{key}"));
    let chosen = [place("cell")?, place("x")?, place("y")?];
    let center = stack.next_center(shape.thickness, compensation, chosen);
    draws.drawn.truncate(draws.drawn.len() - chosen.len());
    for (key, value) in [("center.x", center.x), ("center.y", center.y)] {
        draws.drawn.push((format!("{number}.{key}"), value));
    }
    Ok(center)
}

/// A lobe laid on what is there, which it is part of from then on; its body; and the mean slope of what it lies on. As it is sunk into that, it is made as much thicker
/// and wider: what stands out of a level floor is as thick and as wide as it shall be.
fn laid(
    design: LobeDesign,
    pile: &mut Pile<'_>,
    (erosion, lines): (f64, LobeLines),
) -> Result<(Lobe, Shell, DVec2), String> {
    let plan = design.build().map_err(|error| error.to_string())?.plan();
    let margin = MARGIN * (plan[1] - plan[0]);
    let floor = pile
        .floor([plan[0] - margin, plan[1] + margin], design.width / NODES)
        .map_err(|error| error.to_string())?
        .lowered_by(LEAST * design.thickness);
    let thicker = 1.0 + floor.lowered() / design.thickness;
    let lobe = LobeDesign {
        length: design.length * thicker.sqrt(),
        width: design.width * thicker.sqrt(),
        thickness: design.thickness * thicker,
        ..design
    };
    let lobe = lobe.build().map_err(|error| error.to_string())?;
    let shell = lobe
        .eroding(erosion, lines)
        .map_err(|error| error.to_string())?;
    let target = Target {
        height: &|at| Some(floor.height(at)),
        reference: design.center.z,
        depth: 0.0,
    };
    let tolerance = WITHIN * floor.lowered() / 2.0;
    let made = conform(&shell, &target, tolerance).map_err(|error| error.to_string())?;
    let slope = mean_slope(&|at| floor.height(at), lobe.plan());
    pile.lay(lobe, floor);
    Ok((lobe, made.shell, slope))
}

/// The lowest elevation of a surface over a plan (m), over a grid of places.
fn lowest(surface: &Horizon, [low, high]: [DVec2; 2]) -> f64 {
    let places = (0..PLACES * PLACES).map(|k| {
        let part = DVec2::new((k % PLACES) as f64, (k / PLACES) as f64) / (PLACES - 1) as f64;
        low + (high - low) * part
    });
    let heights = places.map(|at| surface.height(at.x, at.y));
    heights.fold(f64::INFINITY, f64::min)
}

impl LobesSpec {
    /// Where the middles of lobes may be.
    fn region_in(&self, site: &Site<'_>) -> Result<Region, Reason> {
        let region = if let Some(corners) = &self.region {
            Region::new(corners.iter().map(|p| DVec2::from_array(*p)).collect())
        } else {
            let [x, y] = [site.domain.x, site.domain.y];
            Region::rectangle(DVec2::new(x[0], y[0]), DVec2::new(x[1], y[1]))
        };
        region.map_err(|error| ("impossible region", error.to_string()))
    }
}

impl Keys<'_, '_> {
    /// How many lobes there are.
    fn lobes_count(&self) -> Option<usize> {
        let (node, count) = self.draft.count?;
        let Some(node) = node else {
            self.checker
                .reader
                .missing(self.draft.node, &self.draft.name, "count", "count = 20");
            return None;
        };
        if count > MOST_LOBES {
            self.checker.reader.wrong(
                node,
                format!("{} has {count} lobes", self.draft.name),
                format!("write a number from 1 to {MOST_LOBES}"),
            );
            return None;
        }
        usize::try_from(count).ok()
    }

    /// The corners of a region that may be left out.
    fn region(&self, field: Option<Field<Any>>) -> Result<Option<Vec<[f64; 2]>>, Reported> {
        let Some(field) = field else {
            return Ok(None);
        };
        let read = || {
            let (node, Any) = field.good()?;
            match self.checker.reader.tree.value(node) {
                Value::Table(_) => self.rectangle(node),
                Value::List(corners) => {
                    let corners: Vec<Option<[f64; 2]>> = corners
                        .iter()
                        .map(|corner| self.checker.reader.read(*corner))
                        .collect();
                    let corners: Vec<[f64; 2]> = corners.into_iter().collect::<Option<_>>()?;
                    let points = corners.iter().map(|p| DVec2::from_array(*p)).collect();
                    if let Err(error) = Region::new(points) {
                        self.checker.reader.wrong(
                            node,
                            format!("{}: {error}", self.what("region")),
                            "write the corners of a polygon, in order: [[0, 0], [1000, 0], [500, 800]]",
                        );
                        return None;
                    }
                    Some(corners)
                }
                _ => {
                    let found = self.checker.reader.tree.describe(node);
                    self.checker.reader.wrong(
                        node,
                        format!("expected a rectangle or a polygon for {}, found {found}", self.what("region")),
                        "write { x = [0, 1000], y = [0, 800] }, or the corners [[0, 0], [1000, 0], [500, 800]]",
                    );
                    None
                }
            }
        };
        read().map(Some).ok_or(Reported)
    }

    /// The corners of a rectangle.
    fn rectangle(&self, node: NodeId) -> Option<Vec<[f64; 2]>> {
        let reader = &self.checker.reader;
        let what = self.what("region");
        let file: RectangleFile = reader.table(node)?;
        reader.close(node, &what);
        let range = |field: Field<[f64; 2]>, key: &str| {
            let (at, [low, high]) =
                reader.need(field, node, &what, key, &format!("{key} = [0, 1000]"))?;
            if low >= high {
                let what = format!("the `{key}` of {what}");
                self.checker
                    .no_range(at, &what, [low, high], "write [smaller, larger]");
                return None;
            }
            Some([low, high])
        };
        let (x, y) = (range(file.x, "x"), range(file.y, "y"));
        let ([west, east], [south, north]) = (x?, y?);
        Some(vec![
            [west, south],
            [east, south],
            [east, north],
            [west, north],
        ])
    }
}
