//! Control nets of one's own, and how they are joined.

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::facies::is_id;
use crate::features::join::{Side, Smoothness};
use crate::features::net::{NetDesign, NetError};
use crate::features::nets::{JoinDesign, NamedNet};
use crate::model::checker::Checker;
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};

/// The highest degree of a net: that of the partition's surfaces.
const MOST_DEGREE: usize = 7;
/// Words for sides, in the order of [`side_of`].
const SIDES: [&str; 4] = ["first-row", "last-row", "first-column", "last-column"];

/// A control net.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Net")]
pub(crate) struct NetFile {
    /// Its name, where there are several: letters, digits, `-` and `_`; its number from 1 if left out.
    #[schemars(regex(pattern = "^[A-Za-z0-9_-]+$"))]
    pub(crate) name: Option<Field<String>>,
    /// Rows of control points, [[[x, y, z], …], …], all of one length; at least two rows of two.
    #[schemars(with = "Vec<Vec<[f64; 3]>>", length(min = 2))]
    pub(crate) points: Field<Any>,
    /// Degrees [from row to row, along the rows], 1 to 7, or one number for both; 3, or less where there are few points, if left out.
    #[schemars(schema_with = "degrees")]
    #[serde(default)]
    pub(crate) degree: Option<Field<Any>>,
    /// Weights of the points, above 0, in rows as these; all 1 if left out. The greater, the nearer the surface comes to its point.
    #[schemars(with = "Option<Vec<Vec<f64>>>")]
    pub(crate) weights: Option<Field<Any>>,
    /// Knots [from row to row, along the rows], each all of a clamped knot vector, or [] for even ones; even ones if left out.
    #[schemars(with = "Option<[Vec<f64>; 2]>")]
    pub(crate) knots: Option<Field<Any>>,
    /// An earlier net of the list to which a side of this one is joined.
    #[schemars(with = "Option<JoinFile>")]
    pub(crate) joins: Option<Field<Any>>,
}

/// How a net is joined to an earlier one.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Join")]
pub(crate) struct JoinFile {
    /// Name of the earlier net, which keeps its shape.
    pub(crate) to: Field<String>,
    /// The side of this net that becomes the other one's: "first-row", "last-row", "first-column" or "last-column"; the nearest one if left out.
    #[schemars(schema_with = "sides")]
    #[serde(default)]
    pub(crate) own: Option<Field<String>>,
    /// The side of the other net, likewise; the nearest one if left out.
    #[schemars(schema_with = "sides")]
    #[serde(default)]
    pub(crate) side: Option<Field<String>>,
    /// Whether they go on in each other without an angle; false if left out.
    pub(crate) smooth: Option<Field<bool>>,
}

fn degrees(_: &mut SchemaGenerator) -> Schema {
    let one = json_schema!({ "type": "integer", "minimum": 1, "maximum": MOST_DEGREE });
    json_schema!({ "type": ["integer", "array"], "minimum": 1, "maximum": MOST_DEGREE, "items": one, "minItems": 2, "maxItems": 2 })
}

fn sides(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": SIDES })
}

/// One net, or a list of them, for editors.
pub(crate) fn schema(generator: &mut SchemaGenerator) -> Schema {
    let one = generator.subschema_for::<NetFile>();
    json_schema!({ "anyOf": [one, { "type": "array", "items": one, "minItems": 1 }] })
}

fn side_of(word: &str) -> Option<Side> {
    let all = [Side::UStart, Side::UEnd, Side::VStart, Side::VEnd];
    let at = SIDES.iter().position(|side| *side == word)?;
    Some(all[at])
}

impl Checker<'_> {
    /// One net, or a list of them; `what` names them, as `the nets of feature "fold"`.
    pub(crate) fn nets(&self, node: NodeId, what: &str) -> Option<Vec<NamedNet>> {
        let nodes: &[NodeId] = match self.reader.tree.value(node) {
            Value::Table(_) => std::slice::from_ref(&node),
            Value::List(nodes) if !nodes.is_empty() => nodes,
            _ => {
                let found = self.reader.tree.describe(node);
                self.reader.wrong(
                    node,
                    format!("expected a net, or a list of nets, for {what}, found {found}"),
                    "write { points = [[[x, y, z], …], …] }, or a list of such tables",
                );
                return None;
            }
        };
        let mut names: Vec<String> = Vec::with_capacity(nodes.len());
        let mut all = Vec::with_capacity(nodes.len());
        for (at, &node) in nodes.iter().enumerate() {
            all.push(self.net(node, (what, at, nodes.len()), &mut names));
        }
        all.into_iter().collect()
    }

    /// A net by itself; `of` names what it is that of.
    pub(crate) fn one_net(&self, node: NodeId, of: &str) -> Option<NamedNet> {
        self.net(node, (of, 0, 1), &mut Vec::new())
    }

    /// One of a number of nets.
    fn net(
        &self,
        node: NodeId,
        (of, at, count): (&str, usize, usize),
        names: &mut Vec<String>,
    ) -> Option<NamedNet> {
        let before = self.reader.found();
        let what = if count == 1 {
            format!("the net of {}", of.trim_start_matches("the nets of "))
        } else {
            format!(
                "net {} of {}",
                at + 1,
                of.trim_start_matches("the nets of ")
            )
        };
        let Some(file) = self.reader.table::<NetFile>(node) else {
            names.push(String::new());
            return None;
        };
        self.reader.close(node, &what);
        let name = match file.name.map(Field::good) {
            None => Some((at + 1).to_string()),
            Some(None) => None,
            Some(Some((place, name))) => self.net_name(place, &name, &what, names),
        };
        let joins = file.joins.map(|field| self.join(field, &what, names));
        names.push(name.clone().unwrap_or_default());
        let example = "points = [[[0, 0, 0], [0, 9, 0]], [[9, 0, 0], [9, 9, 1]]]";
        let points = self
            .reader
            .need(file.points, node, &what, "points", example)
            .and_then(|(place, Any)| self.net_points(place, &what));
        let degree = self.net_degree(file.degree, &what);
        let weights = self.numbers(file.weights, &format!("the weights of {what}"));
        let knots = self.net_knots(file.knots, &what);
        if self.reader.found() > before {
            return None;
        }
        let net = NetDesign {
            points: points?,
            degree: degree?,
            weights: weights?.map_or_else(Vec::new, |weights| weights.1),
            knots: knots?,
        };
        if let Err(error) = net.build() {
            let remedy = match &error {
                NetError::Weight { .. } => "leave `weights` out for a surface without them",
                NetError::Knots { .. } | NetError::KnotCount { .. } => {
                    "leave `knots` out for even ones, or lower the `degree`"
                }
                _ => "write rows of points, all of one length",
            };
            self.reader.wrong(node, format!("{what}: {error}"), remedy);
            return None;
        }
        Some(NamedNet {
            name: name?,
            net,
            joins: match joins {
                None => None,
                Some(joins) => Some(joins?),
            },
        })
    }

    fn net_name(&self, node: NodeId, name: &str, what: &str, names: &[String]) -> Option<String> {
        if !is_id(name) {
            self.reader.wrong(
                node,
                format!("the name {} of {what} is no name", quoted(name)),
                "use letters, digits, - and _",
            );
            return None;
        }
        if names.iter().any(|own| own == name) {
            self.reader.wrong(
                node,
                format!("{what} has the name {} of an earlier one", quoted(name)),
                "give each net a name of its own",
            );
            return None;
        }
        Some(name.to_owned())
    }

    fn net_points(&self, node: NodeId, what: &str) -> Option<Vec<Vec<DVec3>>> {
        let remedy = "write rows of points, [[[x, y, z], [x, y, z]], [[x, y, z], [x, y, z]]]";
        let rows = match self.reader.tree.value(node) {
            Value::List(rows) if rows.len() > 1 => rows,
            _ => {
                let found = self.reader.tree.describe(node);
                self.reader.wrong(
                    node,
                    format!("expected a list of two rows or more for the points of {what}, found {found}"),
                    remedy,
                );
                return None;
            }
        };
        let columns = self.reader.tree.elements(rows[0]).len();
        let read = |(number, &row): (usize, &NodeId)| {
            let points = match self.reader.tree.value(row) {
                Value::List(points) if points.len() > 1 => points,
                _ => {
                    let found = self.reader.tree.describe(row);
                    self.reader.wrong(
                        row,
                        format!(
                            "expected a list of two points or more for row {} of {what}, found {found}",
                            number + 1
                        ),
                        remedy,
                    );
                    return None;
                }
            };
            if points.len() != columns {
                self.reader.wrong(
                    row,
                    format!(
                        "row {} of {what} has {} points, the first row {columns}",
                        number + 1,
                        points.len()
                    ),
                    "give every row as many points",
                );
            }
            let points: Vec<Option<[f64; 3]>> = points
                .iter()
                .map(|&point| self.reader.read(point))
                .collect();
            let points: Option<Vec<[f64; 3]>> = points.into_iter().collect();
            Some(points?.into_iter().map(DVec3::from_array).collect())
        };
        let rows: Vec<Option<Vec<DVec3>>> = rows.iter().enumerate().map(read).collect();
        rows.into_iter().collect()
    }

    fn net_degree(&self, field: Option<Field<Any>>, what: &str) -> Option<[Option<usize>; 2]> {
        let Some(field) = field else {
            return Some([None; 2]);
        };
        let (node, Any) = field.good()?;
        let nodes = match self.reader.tree.value(node) {
            Value::List(nodes) if nodes.len() == 2 => [nodes[0], nodes[1]],
            Value::Integer(_) => [node; 2],
            _ => {
                let found = self.reader.tree.describe(node);
                self.reader.wrong(
                    node,
                    format!("expected a degree, or two, for {what}, found {found}"),
                    "write degree = 3, or degree = [from row to row, along the rows]",
                );
                return None;
            }
        };
        let one = |node: NodeId| {
            let degree = self.reader.read::<u64>(node)?;
            let degree = usize::try_from(degree).unwrap_or(usize::MAX);
            if (1..=MOST_DEGREE).contains(&degree) {
                return Some(degree);
            }
            self.reader.wrong(
                node,
                format!(
                    "the degree of {what} is {degree}; it must lie between 1 and {MOST_DEGREE}"
                ),
                "1 is straight between the points, 2 and 3 are smooth",
            );
            None
        };
        let first = one(nodes[0]);
        let second = if nodes[1] == nodes[0] {
            first
        } else {
            one(nodes[1])
        };
        Some([Some(first?), Some(second?)])
    }

    /// Rows of numbers, with their place.
    #[allow(
        clippy::option_option,
        reason = "left out is something else than wrong"
    )]
    fn numbers(
        &self,
        field: Option<Field<Any>>,
        what: &str,
    ) -> Option<Option<(NodeId, Vec<Vec<f64>>)>> {
        let Some(field) = field else {
            return Some(None);
        };
        let (node, Any) = field.good()?;
        let remedy = "write rows of numbers, [[1, 1], [1, 2]]";
        let Value::List(rows) = self.reader.tree.value(node) else {
            let found = self.reader.tree.describe(node);
            let message = format!("expected a list of rows for {what}, found {found}");
            self.reader.wrong(node, message, remedy);
            return None;
        };
        let row = |&row: &NodeId| {
            let Value::List(numbers) = self.reader.tree.value(row) else {
                let found = self.reader.tree.describe(row);
                let message = format!("expected a list of numbers for {what}, found {found}");
                self.reader.wrong(row, message, remedy);
                return None;
            };
            let numbers: Vec<Option<f64>> =
                numbers.iter().map(|&one| self.reader.number(one)).collect();
            numbers.into_iter().collect()
        };
        let rows: Vec<Option<Vec<f64>>> = rows.iter().map(row).collect();
        let rows: Option<Vec<Vec<f64>>> = rows.into_iter().collect();
        Some(Some((node, rows?)))
    }

    fn net_knots(&self, field: Option<Field<Any>>, what: &str) -> Option<[Option<Vec<f64>>; 2]> {
        let Some((node, rows)) = self.numbers(field, &format!("the knots of {what}"))? else {
            return Some([None, None]);
        };
        let found = rows.len();
        let Ok([across, along]) = <[Vec<f64>; 2]>::try_from(rows) else {
            self.reader.wrong(
                node,
                format!("expected two lists for the knots of {what}, found {found}"),
                "write [[knots from row to row], [knots along the rows]]; [] stands for even ones",
            );
            return None;
        };
        Some([across, along].map(|knots| (!knots.is_empty()).then_some(knots)))
    }

    /// How a net is joined to one of those before it.
    fn join(&self, field: Field<Any>, what: &str, names: &[String]) -> Option<JoinDesign> {
        let (node, Any) = field.good()?;
        let file: JoinFile = self.reader.table(node)?;
        let name = format!("the `joins` of {what}");
        self.reader.close(node, &name);
        let example = "to = \"the-earlier-net\"";
        let to = self
            .reader
            .need(file.to, node, &name, "to", example)
            .and_then(|(at, to)| {
                let found = names.iter().position(|own| *own == to);
                if found.is_none() {
                    let remedy = self.reader.hint(|| {
                        let known: Vec<&str> = names.iter().map(String::as_str).collect();
                        suggest::name(&to, &known, "earlier nets")
                    });
                    self.reader.wrong(
                        at,
                        format!(
                            "{what} is joined to {}, which is no net before it",
                            quoted(&to)
                        ),
                        remedy,
                    );
                }
                found
            });
        let side = |field: Option<Field<String>>| {
            let Some(field) = field else {
                return Some(None);
            };
            let (at, word) = field.good()?;
            let side = side_of(&word);
            if side.is_none() {
                self.reader.wrong(
                    at,
                    format!("{} is no side of a net", quoted(&word)),
                    format!("write one of {}", SIDES.map(quoted).join(", ")),
                );
            }
            side.map(Some)
        };
        let (own, side) = (side(file.own), side(file.side));
        let smooth = match file.smooth {
            None => Some(false),
            Some(field) => field.good().map(|(_, smooth)| smooth),
        };
        Some(JoinDesign {
            to: to?,
            own: own?,
            side: side?,
            smoothness: if smooth? {
                Smoothness::Tangent
            } else {
                Smoothness::Edge
            },
        })
    }
}
