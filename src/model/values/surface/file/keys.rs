//! The keys that go with a file of heights, and what they say.

use glam::DVec3;
use serde::Deserialize;

use super::frame::{Frame, Measure};
use crate::data::{Format, Positive, Reading};
use crate::features::fitted::Goal;
use crate::model::checker::Checker;
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};

/// The keys of a surface from a file, besides `tolerance`.
#[derive(Deserialize)]
pub(in crate::model::values::surface) struct FromFile {
    pub(in crate::model::values::surface) file: Option<Field<String>>,
    format: Option<Field<String>>,
    positive: Option<Field<String>>,
    unit: Option<Field<String>>,
    plan_unit: Option<Field<String>>,
    world: Option<Field<bool>>,
    columns: Option<Field<Any>>,
    null: Option<Field<Any>>,
    smooth: Option<Field<f64>>,
}

/// Which column is what.
#[derive(Deserialize)]
struct Columns {
    x: Field<Any>,
    y: Field<Any>,
    z: Field<Any>,
}

/// What the keys say.
pub(super) struct Read {
    pub(super) node: NodeId,
    pub(super) file: String,
    pub(super) reading: Reading,
    pub(super) frame: Frame,
    pub(super) goal: Goal,
}

impl FromFile {
    /// The keys that go with a file and are there without one.
    pub(in crate::model::values::surface) fn stray(&self) -> Option<(NodeId, &'static str)> {
        fn at<T>(field: Option<&Field<T>>) -> Option<NodeId> {
            match field {
                Some(Field::Good(node, _)) => Some(*node),
                _ => None,
            }
        }
        let keys = [
            (at(self.format.as_ref()), "format"),
            (at(self.positive.as_ref()), "positive"),
            (at(self.unit.as_ref()), "unit"),
            (at(self.plan_unit.as_ref()), "plan_unit"),
            (at(self.world.as_ref()), "world"),
            (at(self.columns.as_ref()), "columns"),
            (at(self.null.as_ref()), "null"),
            (at(self.smooth.as_ref()), "smooth"),
        ];
        let first = keys.into_iter().find_map(|(node, key)| Some((node?, key)));
        first.filter(|_| self.file.is_none())
    }
}

impl Checker<'_> {
    /// The keys of a file; `table` is what they stand in.
    pub(super) fn keys_of_file(
        &mut self,
        table: NodeId,
        keys: FromFile,
        tolerance: Option<Field<f64>>,
        (what, measure): (&str, Measure),
    ) -> Option<Read> {
        let before = self.reader.found();
        let format = keys.format.and_then(Field::good);
        let format = format.and_then(|(node, word)| self.format(node, &word));
        let positive = keys.positive.and_then(Field::good);
        let positive =
            positive.and_then(|(node, word)| self.positive(node, &word, (what, measure)));
        let unit = self.unit(keys.unit);
        let plan_unit = self.unit(keys.plan_unit);
        let columns = keys.columns.and_then(Field::good);
        let columns = columns.and_then(|(node, Any)| self.columns(node, what));
        let nulls = keys.null.and_then(Field::good);
        let nulls = nulls.map_or_else(Vec::new, |(node, Any)| self.nulls(node));
        let is_world = keys
            .world
            .and_then(Field::good)
            .is_none_or(|(_, world)| world);
        let goal = self.goal(table, tolerance, keys.smooth, what);
        let (node, file) = keys.file?.good()?;
        if self.reader.found() > before {
            return None;
        }
        let origin = if is_world {
            DVec3::from_array(self.origin)
        } else {
            DVec3::ZERO
        };
        Some(Read {
            node,
            file,
            reading: Reading {
                format,
                columns,
                nulls,
            },
            frame: Frame {
                positive,
                unit,
                plan_unit,
                origin: match measure {
                    Measure::Elevation => origin,
                    Measure::Thickness => origin.with_z(0.0),
                },
                is_world,
            },
            goal: goal?,
        })
    }

    fn format(&self, node: NodeId, word: &str) -> Option<Format> {
        let format = Format::of_word(word);
        if format.is_none() {
            let words = Format::ALL.map(Format::word);
            let remedy = suggest::name(word, &words, "formats");
            let message = format!("there is no format {}", quoted(word));
            self.reader.wrong(node, message, remedy);
        }
        format
    }

    fn positive(
        &self,
        node: NodeId,
        word: &str,
        (what, measure): (&str, Measure),
    ) -> Option<Positive> {
        if measure == Measure::Thickness {
            self.reader.wrong(
                node,
                format!("{what} has a `positive`, and a thickness points nowhere"),
                "remove it: thicknesses are 0 or more",
            );
            return None;
        }
        match word {
            "up" => Some(Positive::Up),
            "down" => Some(Positive::Down),
            _ => {
                let message = format!("heights cannot be positive {}", quoted(word));
                let remedy = "write \"up\" for elevations, \"down\" for depths";
                self.reader.wrong(node, message, remedy);
                None
            }
        }
    }

    fn columns(&self, node: NodeId, what: &str) -> Option<[String; 3]> {
        let name = format!("the columns of {what}");
        let columns: Columns = self.reader.table(node)?;
        self.reader.close(node, &name);
        let example = "columns = { x = \"X\", y = \"Y\", z = \"Z\" }";
        let one = |field: Field<Any>, key: &str| {
            let (at, Any) = self.reader.need(field, node, &name, key, example)?;
            match self.reader.tree.value(at) {
                Value::Text(text) => Some(text.clone()),
                Value::Integer(number) if *number > 0 => Some(number.to_string()),
                _ => {
                    let found = self.reader.tree.describe(at);
                    let message =
                        format!("expected a column's name or number for {name}, found {found}");
                    self.reader.wrong(
                        at,
                        message,
                        "write its name in quotes, or its number from 1",
                    );
                    None
                }
            }
        };
        let (x, y, z) = (
            one(columns.x, "x"),
            one(columns.y, "y"),
            one(columns.z, "z"),
        );
        Some([x?, y?, z?])
    }

    /// One or more numbers, of any size.
    fn nulls(&self, node: NodeId) -> Vec<f64> {
        let nodes = match self.reader.tree.value(node) {
            Value::List(elements) => elements.clone(),
            _ => vec![node],
        };
        let mut nulls = Vec::with_capacity(nodes.len());
        for node in nodes {
            if let Some(null) = self.reader.tree.number(node) {
                nulls.push(null);
            } else {
                let found = self.reader.tree.describe(node);
                let message = format!("expected a number that stands for no data, found {found}");
                self.reader
                    .wrong(node, message, "write it as the file has it: null = -999.25");
            }
        }
        nulls
    }

    /// How near the surface is to be.
    fn goal(
        &self,
        table: NodeId,
        tolerance: Option<Field<f64>>,
        smooth: Option<Field<f64>>,
        what: &str,
    ) -> Option<Goal> {
        let (key, field, goal): (_, _, fn(f64) -> Goal) = match (tolerance, smooth) {
            (Some(_), Some(_)) => {
                self.reader.wrong(
                    table,
                    format!("{what} has a `tolerance` and a `smooth`"),
                    "give one of them: `tolerance` for heights without noise, `smooth` for heights with it",
                );
                return None;
            }
            (Some(field), None) => ("tolerance", field, Goal::Within),
            (None, Some(field)) => ("smooth", field, Goal::Noise),
            (None, None) => {
                self.reader.wrong(
                    table,
                    format!("{what} has neither `tolerance` nor `smooth`"),
                    "write how far the surface may miss a height, in metres, as tolerance = 0.5; of heights with noise, how great that is, as smooth = 0.5",
                );
                return None;
            }
        };
        let (node, number) = field.good()?;
        if number > 0.0 {
            return Some(goal(number));
        }
        self.reader.wrong(
            node,
            format!("the {key} of {what} is {number}; it must be above 0"),
            "write how far the surface may be from the heights, in metres",
        );
        None
    }
}
