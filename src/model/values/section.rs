//! Sections of one's own: a plane NURBS curve as a channel's cross-section.

use std::sync::Arc;

use glam::DVec2;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use crate::features::own_section::{Close, Depth, OwnDesign, OwnSection, OwnSectionError};
use crate::model::checker::Checker;
use crate::model::read::{Any, Field};
use crate::model::tree::{NodeId, Value, quoted};

/// Degree if left out and there are points enough.
const DEGREE: usize = 3;
/// Most points of a section.
const MOST_POINTS: usize = 200;

/// A section of one's own.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Section")]
pub(crate) struct SectionFile {
    /// Control points [x, y] from the left rim to the right one: x in widths from the middle (the rims are at -0.5 and 0.5), y in depths upwards from the rims (0 at the rims, below 0 between).
    #[schemars(with = "Vec<[f64; 2]>", length(min = 3))]
    pub(crate) points: Field<Any>,
    /// Degree of the curve: 1 (straight from point to point), 2, or 3 (the default; less if there are few points).
    #[schemars(range(min = 1, max = 7))]
    pub(crate) degree: Option<Field<u64>>,
    /// A weight above 0 for each point; all 1 if left out.
    #[schemars(with = "Option<Vec<f64>>")]
    pub(crate) weights: Option<Field<Any>>,
    /// Knots, as many as points + degree + 1, the first and the last one degree + 1 times; evenly spaced if left out.
    #[schemars(with = "Option<Vec<f64>>")]
    pub(crate) knots: Option<Field<Any>>,
    /// How it is closed: "ruled" (the default), by a straight top between the rims; or "closed", by itself, with the last point on the first: a tube.
    #[schemars(schema_with = "closing")]
    #[serde(default)]
    pub(crate) close: Option<Field<String>>,
    /// What the channel's depth is: "scale" (the default), how deep y = -1 is; or "deepest", how deep the deepest place of the curve is.
    #[schemars(schema_with = "depth_is")]
    #[serde(default)]
    pub(crate) depth_is: Option<Field<String>>,
}

fn closing(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["ruled", "closed"] })
}

fn depth_is(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["scale", "deepest"] })
}

impl Checker<'_> {
    /// A section of one's own; `what` it is of.
    pub(crate) fn section(&mut self, node: NodeId, what: &str) -> Option<Arc<OwnSection>> {
        let file: SectionFile = self.reader.table(node)?;
        self.reader.close(node, what);
        let points = self.section_points(file.points, node, what);
        let (degree_node, degree) = match file.degree {
            None => (node, None),
            Some(field) => {
                let (node, degree) = field.good()?;
                (node, Some(usize::try_from(degree).unwrap_or(usize::MAX)))
            }
        };
        let weights = self.section_numbers(file.weights, "weights", what);
        let knots = self.section_numbers(file.knots, "knots", what);
        let close = self.section_word(
            file.close,
            what,
            [("ruled", Close::Ruled), ("closed", Close::Closed)],
        );
        let depth = self.section_word(
            file.depth_is,
            what,
            [("scale", Depth::Scale), ("deepest", Depth::Deepest)],
        );
        let (points_node, points) = points?;
        let (weights_node, weights) = weights?.unzip();
        let (knots_node, knots) = knots?.unzip();
        let degree = degree.unwrap_or(DEGREE.min(points.len().saturating_sub(1)));
        let design = OwnDesign {
            points,
            degree,
            weights,
            knots,
            close: close?,
            depth: depth?,
        };
        match OwnSection::new(&design) {
            Ok(section) => {
                if degree > DEGREE {
                    let words = format!(
                        "{what} has degree {degree}: degrees above {DEGREE} have no use, and take longer"
                    );
                    self.note(degree_node, words);
                }
                Some(Arc::new(section))
            }
            Err(error) => {
                let at = match &error {
                    OwnSectionError::Degree(_) => degree_node,
                    OwnSectionError::Few { .. } if degree_node != node => degree_node,
                    OwnSectionError::Weights { .. } | OwnSectionError::Weight { .. } => {
                        weights_node.unwrap_or(node)
                    }
                    OwnSectionError::Knots { .. } | OwnSectionError::Count { .. } => {
                        knots_node.unwrap_or(points_node)
                    }
                    OwnSectionError::Far { index, .. }
                    | OwnSectionError::Rim { index, .. }
                    | OwnSectionError::Open { index, .. }
                    | OwnSectionError::Same { index } => {
                        let elements = self.reader.tree.elements(points_node);
                        elements.get(index - 1).copied().unwrap_or(points_node)
                    }
                    _ => points_node,
                };
                let (message, remedy) = said(&error, what);
                self.reader.wrong(at, message, remedy);
                None
            }
        }
    }

    fn section_points(
        &self,
        points: Field<Any>,
        node: NodeId,
        what: &str,
    ) -> Option<(NodeId, Vec<DVec2>)> {
        let example = "points = [[-0.5, 0], [-0.25, -1], [0.25, -1], [0.5, 0]]";
        let (at, Any) = self.reader.need(points, node, what, "points", example)?;
        let Value::List(elements) = self.reader.tree.value(at) else {
            let found = self.reader.tree.describe(at);
            self.reader.wrong(
                at,
                format!("expected a list of points for {what}, found {found}"),
                format!("write {example}"),
            );
            return None;
        };
        if elements.len() > MOST_POINTS {
            self.reader.wrong(
                at,
                format!("{what} has {} points", elements.len()),
                format!("give {MOST_POINTS} at most: a spline of some tens of points follows any section"),
            );
            return None;
        }
        let point = |element: &NodeId| {
            let [x, y] = *self.reader.tree.elements(*element) else {
                let found = self.reader.tree.describe(*element);
                self.reader.wrong(
                    *element,
                    format!("expected a point [x, y] of {what}, found {found}"),
                    "write two numbers in [ ]: x in widths from the middle, y in depths upwards from the rims",
                );
                return None;
            };
            let (x, y) = (self.reader.number(x), self.reader.number(y));
            Some(DVec2::new(x?, y?))
        };
        // All are looked at before the first wrong one ends it.
        let found: Vec<Option<DVec2>> = elements.iter().map(point).collect();
        Some((at, found.into_iter().collect::<Option<_>>()?))
    }

    /// A list of numbers that may be left out.
    #[allow(
        clippy::option_option,
        reason = "what is wrong is not what is left out"
    )]
    fn section_numbers(
        &self,
        field: Option<Field<Any>>,
        key: &str,
        what: &str,
    ) -> Option<Option<(NodeId, Vec<f64>)>> {
        let Some(field) = field else {
            return Some(None);
        };
        let (at, Any) = field.good()?;
        let Value::List(elements) = self.reader.tree.value(at) else {
            let found = self.reader.tree.describe(at);
            self.reader.wrong(
                at,
                format!("expected a list of numbers for the {key} of {what}, found {found}"),
                "write numbers in [ ]",
            );
            return None;
        };
        let found: Vec<Option<f64>> = elements
            .iter()
            .map(|element| self.reader.number(*element))
            .collect();
        Some(Some((at, found.into_iter().collect::<Option<_>>()?)))
    }

    fn section_word<T: Copy>(
        &self,
        field: Option<Field<String>>,
        what: &str,
        words: [(&str, T); 2],
    ) -> Option<T> {
        let Some(field) = field else {
            return Some(words[0].1);
        };
        let (node, word) = field.good()?;
        let found = words.iter().find(|known| known.0 == word);
        if found.is_none() {
            let remedy = if word == "open" {
                "an open section would divide what it lies in, which horizons and clinoforms do: write \"ruled\" or \"closed\""
                    .to_owned()
            } else {
                format!("write \"{}\" or \"{}\"", words[0].0, words[1].0)
            };
            self.reader.wrong(
                node,
                format!("{} is no way to say this of {what}", quoted(&word)),
                remedy,
            );
        }
        found.map(|known| known.1)
    }
}

/// An error as message and remedy: what stands behind its last colon is the remedy.
fn said(error: &OwnSectionError, what: &str) -> (String, String) {
    let text = error.to_string();
    let (message, remedy) = text
        .rsplit_once(": ")
        .unwrap_or((text.as_str(), "change its points"));
    (format!("{what}: {message}"), remedy.to_owned())
}
