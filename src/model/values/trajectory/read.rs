//! Trajectories, by their kind.

use super::{
    LikeFile, LineFile, ParametricFile, PointsFile, SineGeneratedFile, TrajectoryFile,
    TrajectorySpec,
};
use crate::model::checker::{Checker, Reported};
use crate::model::domain::Domain;
use crate::model::draft::{Draft, Family};
use crate::model::expression::Expression;
use crate::model::nature::Gives;
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};
use crate::model::values::limits::{ANY, AZIMUTH, Limits, POSITIVE};
use crate::model::values::profile::expression;
use crate::model::values::quantity::{Quantity, quantity};
use crate::nurbs::interpolate::Parametrization;

const KINDS: [&str; 4] = ["line", "points", "sine-generated", "parametric"];
/// Points nearer to each other than this are the same point, as a fraction of the extent of all of them.
const SAME_POINT: f64 = 1e-9;
/// Coordinates that differ by less than this are the same, as a fraction of the greatest.
const SAME_COORDINATE: f64 = 1e-12;
const HIGHEST_DEGREE: usize = 3;

/// The trajectory under examination.
struct Table<'d> {
    node: NodeId,
    draft: &'d Draft,
}

impl Checker<'_> {
    /// The trajectory of one of the features.
    pub(crate) fn trajectory(&self, node: NodeId, family: &Family<'_>) -> Option<TrajectorySpec> {
        let draft = &family.drafts[family.own];
        let name = format!("the trajectory of {}", draft.name);
        if let Some(remedy) = self.table_to_paste(node) {
            let found = self.reader.tree.describe(node);
            let message = format!("expected a table for {name}, found {found}");
            self.reader.wrong(node, message, remedy);
            return None;
        }
        let table = Table { node, draft };
        if self
            .reader
            .tree
            .entries(node)
            .iter()
            .any(|entry| entry.key == "like")
        {
            let spec = self.like(&table, &name, family);
            self.reader.close(node, &name);
            return spec;
        }
        let common: TrajectoryFile = self.reader.table(node)?;
        let (at, kind) = match common.kind {
            Field::Missing => {
                self.reader.wrong(
                    node,
                    format!("{name} has no `kind`"),
                    format!(
                        "add one of {}; or write like = \"another-channel\"",
                        suggest::list(&KINDS)
                    ),
                );
                return None;
            }
            field => field.good()?,
        };
        let known = KINDS.into_iter().find(|known| *known == kind);
        // What was probably meant is checked too, so that one slip hides no other.
        let meant = known.or_else(|| {
            let nearest = suggest::nearest(&kind, &KINDS);
            let remedy = match nearest {
                Some(known) => format!("did you mean \"{known}\"?"),
                None => format!("the kinds are: {}", suggest::list(&KINDS)),
            };
            let message = format!("there is no kind of trajectory {}", quoted(&kind));
            self.reader.wrong(at, message, remedy);
            nearest
        });
        let spec = match meant? {
            "line" => self.line(&table),
            "points" => self.points(&table),
            "sine-generated" => self.sine_generated(&table),
            _ => self.parametric(&table),
        };
        self.reader.close(node, &name);
        spec
    }

    /// What to write in the place of a word, or of a list of points, that is to be a trajectory.
    fn table_to_paste(&self, node: NodeId) -> Option<String> {
        let list = "{ kind = \"points\", points = [[0, 400], [500, 600], [1000, 500]] }";
        let table = match self.reader.tree.value(node) {
            Value::List(_) => list,
            Value::Text(word) => match suggest::nearest(word, &KINDS) {
                Some("line") => "{ kind = \"line\", azimuth_deg = 45 }",
                Some("points") => list,
                Some("parametric") => {
                    "{ kind = \"parametric\", x = \"1000 * t\", y = \"500 + 80 * sin(2 * pi * t)\" }"
                }
                _ => suggest::MEANDERING,
            },
            _ => return None,
        };
        Some(format!("write a table, for example: trajectory = {table}"))
    }

    fn like(&self, table: &Table<'_>, name: &str, family: &Family<'_>) -> Option<TrajectorySpec> {
        let file: LikeFile = self.reader.table(table.node)?;
        let other = file
            .like
            .good()
            .and_then(|(node, text)| self.refer(node, &text, name, Gives::Way, family));
        let offset = self.maybe(file.offset, table, "offset", ANY);
        Some(TrajectorySpec::Like {
            other: other?,
            offset: offset.ok()?.unwrap_or(Quantity::Constant(0.0)),
        })
    }

    /// Says so if a trajectory is written in world coordinates.
    pub(crate) fn note_far_trajectory(
        &mut self,
        node: NodeId,
        trajectory: &TrajectorySpec,
        name: &str,
        domain: &Domain,
    ) {
        let points: Vec<[f64; 2]> = match trajectory {
            TrajectorySpec::Line { from, to } => [from, to].into_iter().filter_map(fixed).collect(),
            TrajectorySpec::Points { points, .. } => points.clone(),
            TrajectorySpec::Heading {
                center: Some(at), ..
            }
            | TrajectorySpec::SineGenerated {
                center: Some(at), ..
            } => fixed(at).into_iter().collect(),
            _ => return,
        };
        self.note_world(node, &points, &format!("the trajectory of {name}"), domain);
    }

    fn line(&self, table: &Table<'_>) -> Option<TrajectorySpec> {
        let file: LineFile = self.reader.table(table.node)?;
        let by_points = file.from.is_some() || file.to.is_some();
        let by_heading =
            file.azimuth_deg.is_some() || file.center.is_some() || file.length.is_some();
        if by_points == by_heading {
            let message = if by_points {
                "has both points and a direction"
            } else {
                "has neither points nor a direction"
            };
            self.reader.wrong(
                table.node,
                format!("the line of {} {message}", table.draft.name),
                "give either `from` and `to`, or `azimuth_deg` with an optional `center` and `length`",
            );
        }
        let from = self.maybe_point(file.from, table, "from");
        let to = self.maybe_point(file.to, table, "to");
        let azimuth = self.maybe(file.azimuth_deg, table, "azimuth_deg", AZIMUTH);
        let center = self.maybe_point(file.center, table, "center");
        let length = self.maybe(file.length, table, "length", POSITIVE);
        if by_points == by_heading {
            return None;
        }
        if by_heading {
            let azimuth_deg = self.given(azimuth.ok()?, table, "azimuth_deg", "azimuth_deg = 45");
            return Some(TrajectorySpec::Heading {
                azimuth_deg: azimuth_deg?,
                center: center.ok()?,
                length: length.ok()?,
            });
        }
        let from = self.given(from.ok()?, table, "from", "from = [0, 500]");
        let to = self.given(to.ok()?, table, "to", "to = [1000, 500]");
        let (from, to) = (from?, to?);
        if from == to && from.iter().all(|c| c.constant().is_some()) {
            self.reader.wrong(
                table.node,
                format!("the line of {} ends where it starts", table.draft.name),
                "give two different points",
            );
            return None;
        }
        Some(TrajectorySpec::Line { from, to })
    }

    fn points(&self, table: &Table<'_>) -> Option<TrajectorySpec> {
        let file: PointsFile = self.reader.table(table.node)?;
        let points = match file.points {
            Field::Missing => {
                self.missing_key(
                    table,
                    "points",
                    "points = [[0, 400], [500, 600], [1000, 500]]",
                );
                None
            }
            field => field
                .good()
                .and_then(|(node, Any)| self.point_list(node, table)),
        };
        let parametrization = match file.parametrization.map(Field::good) {
            None => Some(Parametrization::Centripetal),
            Some(word) => word.and_then(|(node, word)| match word.as_str() {
                "centripetal" => Some(Parametrization::Centripetal),
                "chord-length" => Some(Parametrization::ChordLength),
                _ => {
                    self.reader.wrong(
                        node,
                        format!("there is no parametrization {}", quoted(&word)),
                        "write \"centripetal\" or \"chord-length\"",
                    );
                    None
                }
            }),
        };
        let count = points.as_ref().map_or(usize::MAX, Vec::len);
        let degree = match file.degree.map(Field::good) {
            None => Some(HIGHEST_DEGREE.min(count.saturating_sub(1))),
            Some(given) => given.and_then(|(node, degree)| self.degree(node, degree, count)),
        };
        Some(TrajectorySpec::Points {
            points: points?,
            parametrization: parametrization?,
            degree: degree?,
        })
    }

    fn degree(&self, node: NodeId, degree: u64, points: usize) -> Option<usize> {
        let degree = usize::try_from(degree).unwrap_or(usize::MAX);
        let (problem, remedy) = if !(1..=HIGHEST_DEGREE).contains(&degree) {
            (
                format!("the degree is {degree}; it must lie between 1 and {HIGHEST_DEGREE}"),
                "write 1 for straight pieces, 3 for a smooth curve",
            )
        } else if degree >= points {
            (
                format!(
                    "a curve of degree {degree} needs {} points, but has {points}",
                    degree + 1
                ),
                "add points, or leave the degree out",
            )
        } else {
            return Some(degree);
        };
        self.reader.wrong(node, problem, remedy);
        None
    }

    fn point_list(&self, node: NodeId, table: &Table<'_>) -> Option<Vec<[f64; 2]>> {
        let Value::List(elements) = self.reader.tree.value(node) else {
            self.reader.wrong(
                node,
                format!(
                    "expected a list of points for the trajectory of {}, found {}",
                    table.draft.name,
                    self.reader.tree.describe(node)
                ),
                "write points = [[x, y], [x, y], …]",
            );
            return None;
        };
        let before = self.reader.found();
        if elements.len() < 2 {
            self.reader.wrong(
                node,
                format!(
                    "the trajectory of {} has {} point{}; it needs at least 2",
                    table.draft.name,
                    elements.len(),
                    if elements.len() == 1 { "" } else { "s" }
                ),
                "add points: [[0, 400], [500, 600], [1000, 500]]",
            );
        }
        let read = |&element: &NodeId| Some((element, self.reader.read::<[f64; 2]>(element)?));
        let read: Vec<(NodeId, [f64; 2])> = elements.iter().filter_map(read).collect();
        let [first, ..] = read.as_slice() else {
            return None;
        };
        let away = read
            .iter()
            .map(|(_, [x, y])| (x - first.1[0]).hypot(y - first.1[1]));
        let extent = away.fold(0.0, f64::max);
        let mut points: Vec<[f64; 2]> = Vec::new();
        for (element, [x, y]) in read {
            if let Some(&[a, b]) = points.last()
                && (x - a).hypot(y - b) <= SAME_POINT * extent
            {
                self.reader.wrong(
                    element,
                    format!("the point [{x}, {y}] repeats the one before it"),
                    "remove one of the two",
                );
            }
            points.push([x, y]);
        }
        (self.reader.found() == before).then_some(points)
    }

    fn sine_generated(&self, table: &Table<'_>) -> Option<TrajectorySpec> {
        let file: SineGeneratedFile = self.reader.table(table.node)?;
        let amplitude = self.must(
            file.amplitude,
            table,
            "amplitude",
            "amplitude = 100",
            POSITIVE,
        );
        let wavelength = self.must(
            file.wavelength,
            table,
            "wavelength",
            "wavelength = 500",
            POSITIVE,
        );
        let azimuth_deg = self.must(
            file.azimuth_deg,
            table,
            "azimuth_deg",
            "azimuth_deg = 45",
            AZIMUTH,
        );
        let center = self.maybe_point(file.center, table, "center");
        let phase = self.maybe(file.phase, table, "phase", ANY);
        let length = self.maybe(file.length, table, "length", POSITIVE);
        Some(TrajectorySpec::SineGenerated {
            amplitude: amplitude?,
            wavelength: wavelength?,
            azimuth_deg: azimuth_deg?,
            center: center.ok()?,
            phase: phase.ok()?,
            length: length.ok()?,
        })
    }

    fn parametric(&self, table: &Table<'_>) -> Option<TrajectorySpec> {
        let file: ParametricFile = self.reader.table(table.node)?;
        let x = self.formula(file.x, table, "x", "x = \"1000 * t\"");
        let y = self.formula(file.y, table, "y", "y = \"500 + 80 * sin(2 * pi * t)\"");
        let range = match file.range.map(Field::good) {
            None => Some([0.0, 1.0]),
            Some(given) => given.and_then(|(node, [start, end])| {
                if start < end {
                    return Some([start, end]);
                }
                self.reader.wrong(
                    node,
                    format!("the range of t from {start} to {end} is empty"),
                    "write [smaller, larger]",
                );
                None
            }),
        };
        let ((x_node, x), (y_node, y), range) = (x?, y?, range?);
        let tried = [(x_node, &x), (y_node, &y)].map(|(node, f)| self.try_formula(node, f, range));
        let [Some(xs), Some(ys)] = tried else {
            return None;
        };
        let varies = |values: &[f64]| {
            let greatest = values.iter().map(|v| v.abs()).fold(0.0, f64::max);
            let differs = |v: &f64| (v - values[0]).abs() > SAME_COORDINATE * greatest;
            values.iter().any(differs)
        };
        if !varies(&xs) && !varies(&ys) {
            self.reader.wrong(
                table.node,
                format!("the trajectory of {} stays at one point", table.draft.name),
                "let x or y depend on t",
            );
            return None;
        }
        Some(TrajectorySpec::Parametric { x, y, range })
    }

    fn formula(
        &self,
        field: Field<String>,
        table: &Table<'_>,
        key: &str,
        example: &str,
    ) -> Option<(NodeId, Expression)> {
        if matches!(field, Field::Missing) {
            self.missing_key(table, key, example);
        }
        let (node, text) = field.good()?;
        expression(&self.reader, node, &text, "t").map(|parsed| (node, parsed))
    }

    /// The values of a formula of `t` over its range, if all are finite.
    fn try_formula(&self, node: NodeId, formula: &Expression, range: [f64; 2]) -> Option<Vec<f64>> {
        const STEPS: usize = 256;
        let [start, end] = range;
        (0..=STEPS)
            .map(|step| formula.eval(start + (end - start) * step as f64 / STEPS as f64))
            .collect::<Result<_, _>>()
            .map_err(|error| {
                self.reader.wrong(
                    node,
                    error.to_string(),
                    "the formula must have a finite value all over the range of t",
                );
            })
            .ok()
    }

    fn missing_key(&self, table: &Table<'_>, key: &str, example: &str) {
        let name = format!("the trajectory of {}", table.draft.name);
        self.reader.missing(table.node, &name, key, example);
    }

    fn must(
        &self,
        field: Field<Any>,
        table: &Table<'_>,
        key: &str,
        example: &str,
        limits: Limits,
    ) -> Option<Quantity> {
        if matches!(field, Field::Missing) {
            self.missing_key(table, key, example);
        }
        let (node, Any) = field.good()?;
        let what = format!("the {key} of {}", table.draft.name);
        quantity(&self.reader, node, &what, limits)
    }

    /// `None` where it is left out.
    fn maybe(
        &self,
        field: Option<Field<Any>>,
        table: &Table<'_>,
        key: &str,
        limits: Limits,
    ) -> Result<Option<Quantity>, Reported> {
        match field {
            None => Ok(None),
            Some(field) => self
                .must(field, table, key, "", limits)
                .map(Some)
                .ok_or(Reported),
        }
    }

    fn given<T>(&self, value: Option<T>, table: &Table<'_>, key: &str, example: &str) -> Option<T> {
        if value.is_none() {
            self.missing_key(table, key, example);
        }
        value
    }

    fn maybe_point(
        &self,
        field: Option<Field<Any>>,
        table: &Table<'_>,
        key: &str,
    ) -> Result<Option<[Quantity; 2]>, Reported> {
        let Some(field) = field else {
            return Ok(None);
        };
        let (node, Any) = field.good().ok_or(Reported)?;
        let &[x, y] = self.reader.tree.elements(node) else {
            self.reader.wrong(
                node,
                format!(
                    "expected [x, y] for the {key} of {}, found {}",
                    table.draft.name,
                    self.reader.tree.describe(node)
                ),
                "write the two coordinates in [ ], in metres",
            );
            return Err(Reported);
        };
        let coordinate = |node: NodeId, axis: &str| {
            let what = format!("the {axis} of the {key} of {}", table.draft.name);
            quantity(&self.reader, node, &what, ANY)
        };
        let (x, y) = (coordinate(x, "x"), coordinate(y, "y"));
        match (x, y) {
            (Some(x), Some(y)) => Ok(Some([x, y])),
            _ => Err(Reported),
        }
    }
}

/// A point that is not drawn.
fn fixed([x, y]: &[Quantity; 2]) -> Option<[f64; 2]> {
    Some([x.constant()?, y.constant()?])
}
