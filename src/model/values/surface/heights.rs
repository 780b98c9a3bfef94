//! Surfaces from measured heights: on a grid, or at scattered points.

use super::{GridFile, HorizonSurface};
use crate::model::checker::{Checker, Extent};
use crate::model::read::{Any, Field};
use crate::model::tree::{NodeId, Value};

/// Points are on one line if the triangles between them are this thin, as a fraction of their extent.
const THINNEST: f64 = 1e-9;
/// Magnitudes that programs write where there are no data.
pub(super) const NO_DATA: [f64; 9] = [
    999.0,
    999.25,
    9999.0,
    9_999.25,
    32_768.0,
    99_999.0,
    999_999.0,
    9_999_900.0,
    1e30,
];
/// Heights outside of the domain by more than this many times its height are no heights.
pub(super) const ABSURD: f64 = 100.0;

impl Checker<'_> {
    pub(super) fn grid(
        &mut self,
        node: NodeId,
        what: &str,
        extent: Extent,
    ) -> Option<HorizonSurface> {
        let before = self.reader.found();
        let file: GridFile = self.reader.table(node)?;
        let name = format!("the grid of {what}");
        self.reader.close(node, &name);
        let [east, north, _] = self.origin;
        let along = |field: Field<[f64; 2]>, key: &str, needed: Option<[f64; 2]>, origin: f64| {
            let example = format!("{key} = [0, 1000]");
            let (at, range) = self.reader.need(field, node, &name, key, &example)?;
            self.grid_range(at, &name, key, range, needed.map(|needed| (needed, origin)))
        };
        let x = along(file.x, "x", extent.x, east);
        let y = along(file.y, "y", extent.y, north);
        let example = "heights = [[-20, -20], [-21, -22]]";
        let heights = self
            .reader
            .need(file.heights, node, &name, "heights", example)
            .and_then(|(at, Any)| self.heights(at, &name));
        (self.reader.found() == before).then_some(())?;
        Some(HorizonSurface::Grid {
            x: x?,
            y: y?,
            heights: heights?,
        })
    }

    /// The extent of a grid, which must hold the domain's (given with the model's origin along that axis).
    fn grid_range(
        &self,
        node: NodeId,
        name: &str,
        key: &str,
        [low, high]: [f64; 2],
        needed: Option<([f64; 2], f64)>,
    ) -> Option<[f64; 2]> {
        if low >= high {
            let what = format!("the `{key}` of {name}");
            self.no_range(node, &what, [low, high], "write [smaller, larger]");
            return None;
        }
        if let Some(([first, last], origin)) = needed
            && (low > first || high < last)
        {
            let in_world = origin != 0.0 && low - origin <= first && high - origin >= last;
            self.reader.wrong(
                node,
                format!(
                    "{name} reaches from {low} to {high} in {key}, the domain from {first} to {last}"
                ),
                if in_world {
                    format!("these are coordinates in the world; the model's are its own: subtract the origin's {origin}")
                } else {
                    "a surface runs through the whole domain: extend the grid to its limits or beyond".to_owned()
                },
            );
            return None;
        }
        Some([low, high])
    }

    fn heights(&self, node: NodeId, name: &str) -> Option<Vec<Vec<f64>>> {
        let remedy =
            "write rows from south to north, each from west to east: [[-20, -20], [-21, -22]]";
        let Value::List(rows) = self.reader.tree.value(node) else {
            let found = self.reader.tree.describe(node);
            self.reader.wrong(
                node,
                format!("expected a list of rows for the heights of {name}, found {found}"),
                remedy,
            );
            return None;
        };
        let columns = rows
            .first()
            .map_or(0, |&row| self.reader.tree.elements(row).len());
        let flat = rows
            .iter()
            .any(|&row| !matches!(self.reader.tree.value(row), Value::List(_)));
        if !flat && (rows.len() < 2 || columns < 2) {
            self.reader.wrong(
                node,
                format!(
                    "{name} has {} × {columns} heights; it needs at least 2 × 2",
                    rows.len()
                ),
                remedy,
            );
        }
        let read = |(number, &row): (usize, &NodeId)| {
            let Value::List(values) = self.reader.tree.value(row) else {
                let found = self.reader.tree.describe(row);
                self.reader.wrong(
                    row,
                    format!(
                        "expected a list for row {} of the heights of {name}, found {found}",
                        number + 1
                    ),
                    remedy,
                );
                return None;
            };
            if !flat && values.len() != columns {
                self.reader.wrong(
                    row,
                    format!(
                        "row {} of {name} has {} heights, the first row {columns}",
                        number + 1,
                        values.len()
                    ),
                    "give every row as many heights, one for each column",
                );
            }
            let numbers: Vec<Option<f64>> =
                values.iter().map(|&one| self.reader.number(one)).collect();
            numbers.into_iter().collect()
        };
        let rows: Vec<Option<Vec<f64>>> = rows.iter().enumerate().map(read).collect();
        rows.into_iter().collect()
    }

    pub(super) fn scattered(
        &mut self,
        table: NodeId,
        node: NodeId,
        tolerance: Option<Field<f64>>,
        (what, extent): (&str, Extent),
    ) -> Option<HorizonSurface> {
        let tolerance = match tolerance {
            None => {
                self.reader
                    .missing(table, what, "tolerance", "tolerance = 0.1");
                None
            }
            Some(field) => field.good().and_then(|(at, tolerance)| {
                self.above_nothing(at, tolerance, what).then_some(tolerance)
            }),
        };
        let points = self.scattered_points(node, what);
        if let Some(points) = &points {
            self.points_near(node, points, what, extent)?;
        }
        Some(HorizonSurface::Points {
            points: points?,
            tolerance: tolerance?,
        })
    }

    fn scattered_points(&self, node: NodeId, what: &str) -> Option<Vec<[f64; 3]>> {
        let Value::List(elements) = self.reader.tree.value(node) else {
            let found = self.reader.tree.describe(node);
            self.reader.wrong(
                node,
                format!("expected a list of points for {what}, found {found}"),
                "write points = [[x, y, z], [x, y, z], …]",
            );
            return None;
        };
        let points: Vec<Option<[f64; 3]>> = elements
            .iter()
            .map(|&element| self.reader.read(element))
            .collect();
        if elements.len() < 3 {
            let s = if elements.len() == 1 { "" } else { "s" };
            self.reader.wrong(
                node,
                format!(
                    "{what} has {} point{s}; it needs at least 3",
                    elements.len()
                ),
                "add points, or use { level = … } or { dipping = … }",
            );
            return None;
        }
        let points: Vec<[f64; 3]> = points.into_iter().collect::<Option<_>>()?;
        if on_one_line(&points) {
            self.reader.wrong(
                node,
                format!(
                    "the {} points of {what} lie on one line in plan",
                    points.len()
                ),
                "add a point beside it, or use { dipping = … }",
            );
            return None;
        }
        Some(points)
    }
}

/// Whether points lie on one line in plan, or on one point.
pub(super) fn on_one_line(points: &[[f64; 3]]) -> bool {
    let Some(&[x, y, _]) = points.first() else {
        return true;
    };
    let offset = |point: &[f64; 3]| (point[0] - x, point[1] - y);
    let length = |(dx, dy): (f64, f64)| dx.hypot(dy);
    let far = points
        .iter()
        .map(offset)
        .max_by(|a, b| length(*a).total_cmp(&length(*b)));
    let Some((fx, fy)) = far else { return true };
    let extent = length((fx, fy));
    points
        .iter()
        .map(offset)
        .all(|(dx, dy)| (fx * dy - fy * dx).abs() <= THINNEST * extent * extent)
}
