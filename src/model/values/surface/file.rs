//! Surfaces from files of heights: found, read, brought to the model's coordinates, and fitted.

use glam::{DVec3, Vec3Swizzles};
use serde::Deserialize;

use super::HorizonSurface;
use super::from_file::{FileSurface, plan};
use super::heights::{ABSURD, NO_DATA, on_one_line};
use crate::data::{self, Format, Heights, Origin, Positive, Reading};
use crate::features::coverage::Coverage;
use crate::features::fitted::{Fitted, Goal};
use crate::features::horizon::HorizonError;
use crate::model::checker::files::sha256;
use crate::model::checker::world::{beyond, size};
use crate::model::checker::{Checker, Extent};
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};
use crate::model::values::unit::UNITS;

/// The keys of a surface from a file, besides `tolerance`.
#[derive(Deserialize)]
pub(super) struct FromFile {
    pub(super) file: Option<Field<String>>,
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

/// How a file's numbers become the model's.
#[derive(Clone, Copy)]
struct Frame {
    positive: Option<Positive>,
    unit: f64,
    plan_unit: f64,
    /// What is subtracted.
    origin: DVec3,
    is_world: bool,
}

/// What a file is and how it is to be taken.
struct Asked<'a> {
    node: NodeId,
    what: &'a str,
    file: String,
    frame: Frame,
    goal: Goal,
}

impl Frame {
    fn local(&self, at: DVec3) -> DVec3 {
        (at.xy() * self.plan_unit).extend(self.sign() * self.unit * at.z) - self.origin
    }

    /// An elevation as the file has it.
    fn raw(&self, z: f64) -> f64 {
        let raw = self.sign() * (z + self.origin.z) / self.unit;
        // As many digits as survive the way here and back.
        format!("{raw:.6e}").parse().unwrap_or(raw)
    }

    /// −1 for depths.
    fn sign(&self) -> f64 {
        match self.positive {
            Some(Positive::Down) => -1.0,
            _ => 1.0,
        }
    }
}

impl FromFile {
    /// The keys that go with a file and are there without one.
    pub(super) fn stray(&self) -> Option<(NodeId, &'static str)> {
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
    /// A surface from a file.
    pub(super) fn surface_of_file(
        &mut self,
        table: NodeId,
        keys: FromFile,
        tolerance: Option<Field<f64>>,
        (what, extent): (&str, Extent),
    ) -> Option<HorizonSurface> {
        let before = self.reader.found();
        let format = keys.format.and_then(Field::good);
        let format = format.and_then(|(node, word)| self.format(node, &word));
        let positive = keys.positive.and_then(Field::good);
        let positive = positive.and_then(|(node, word)| self.positive(node, &word));
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
        let asked = Asked {
            node,
            what,
            file,
            frame: Frame {
                positive,
                unit,
                plan_unit,
                origin,
                is_world,
            },
            goal: goal?,
        };
        let reading = Reading {
            format,
            columns,
            nulls,
        };
        self.fitted(asked, &reading, extent)
    }

    fn fitted(
        &mut self,
        mut asked: Asked<'_>,
        reading: &Reading,
        extent: Extent,
    ) -> Option<HorizonSurface> {
        let (node, what) = (asked.node, asked.what);
        let bytes = self.bytes_of(asked.node, asked.what, &asked.file)?;
        let heights = match data::read(&bytes, reading) {
            Ok(heights) => heights,
            Err(error) => {
                let message = format!("{what}: {}: {error}", quoted(&asked.file));
                self.reader.wrong(node, message, error.remedy());
                return None;
            }
        };
        asked.frame.positive = asked.frame.positive.or(heights.positive);
        let (x, y) = (extent.x?, extent.y?);
        let plan = plan(x, y);
        let all: Vec<(DVec3, Origin)> = heights
            .samples()
            .map(|sample| (asked.frame.local(sample.at), sample.origin))
            .collect();
        self.is_near(&asked, &heights, &all, [x, y])?;
        let [low, high] = Fitted::reach(plan);
        let is_within = |at: &DVec3| at.xy().cmpge(low).all() && at.xy().cmple(high).all();
        let near: Vec<(DVec3, Origin)> = all
            .iter()
            .filter(|(at, _)| is_within(at))
            .copied()
            .collect();
        let of = |samples: &[(DVec3, Origin)]| -> Vec<[f64; 3]> {
            samples.iter().map(|(at, _)| at.to_array()).collect()
        };
        let count = all.len();
        // What lies beside the domain counts where there is too little in it.
        let used = if on_one_line(&of(&near)) { all } else { near };
        let points = of(&used);
        if on_one_line(&points) {
            self.reader.wrong(
                node,
                format!("the {count} heights of {what} lie on one line in plan"),
                "export it with points beside that line",
            );
            return None;
        }
        self.are_heights(&asked, &points, &heights, extent)?;
        let places: Vec<DVec3> = used.iter().map(|(at, _)| *at).collect();
        let fitted = match Fitted::new(&places, plan, asked.goal) {
            Ok(fitted) => fitted,
            Err(error) => {
                self.not_fitted(&asked, &used, &error);
                return None;
            }
        };
        let coverage = Coverage::of(&places, plan);
        self.note_coverage(&asked, &coverage, plan[1].distance(plan[0]));
        Some(HorizonSurface::File(Box::new(FileSurface {
            sha256: sha256(&bytes),
            file: asked.file,
            format: heights.format.name(),
            heights: count,
            nulls: heights.nulls(),
            points,
            goal: asked.goal,
            fitted,
            coverage,
        })))
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

    fn positive(&self, node: NodeId, word: &str) -> Option<Positive> {
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

    /// Data that say nothing of the domain are a defect if they lie far from it, and worth a note if they are near.
    fn is_near(
        &mut self,
        asked: &Asked<'_>,
        heights: &Heights,
        all: &[(DVec3, Origin)],
        [x, y]: [[f64; 2]; 2],
    ) -> Option<()> {
        let distance = |at: DVec3| beyond([at.x, at.y], x, y);
        let nearest = |frame: &Frame| {
            let places = heights.samples().map(|sample| frame.local(sample.at));
            places.map(distance).fold(f64::INFINITY, f64::min)
        };
        let (own, origin) = (nearest(&asked.frame), DVec3::from_array(self.origin));
        if own == 0.0 {
            return Some(());
        }
        let other = Frame {
            origin: if asked.frame.is_world {
                DVec3::ZERO
            } else {
                origin
            },
            ..asked.frame
        };
        let far = size(x, y);
        let remedy = if nearest(&other) <= far && origin.xy() != glam::DVec2::ZERO {
            if asked.frame.is_world {
                "the file has the model's own coordinates, not the world's: write world = false"
                    .to_owned()
            } else {
                "the file has coordinates in the world: leave `world = false` out, so that the origin is subtracted".to_owned()
            }
        } else if own > far && origin.xy() == glam::DVec2::ZERO {
            let low = all
                .iter()
                .fold(DVec3::INFINITY, |low, (at, _)| low.min(*at));
            let round = |value: f64| (value / 100.0).floor() * 100.0;
            format!(
                "if it has coordinates in the world, give the model's place in it, such as origin = [{}, {}]; else set the domain's x and y to where the data are",
                round(low.x - x[0]),
                round(low.y - y[0])
            )
        } else {
            "set the domain's x and y to where the data are, or correct the model's origin"
                .to_owned()
        };
        let message = format!(
            "no height of {} lies in the domain, whose x is from {} to {} and y from {} to {}: the nearest is {own:.0} m away",
            asked.what, x[0], x[1], y[0], y[1]
        );
        if own > far {
            self.reader.wrong(asked.node, message, remedy);
            return None;
        }
        self.note(
            asked.node,
            format!("{message}, so the surface is a guess in all of the domain; {remedy}"),
        );
        Some(())
    }

    /// Heights that stand for no data, and those that are upside down or in another unit, are defects; others beyond the domain are
    /// worth a note.
    fn are_heights(
        &mut self,
        asked: &Asked<'_>,
        points: &[[f64; 3]],
        heights: &Heights,
        extent: Extent,
    ) -> Option<()> {
        let [base, top] = extent.z?;
        let (node, what) = (asked.node, asked.what);
        let lies_beyond = |z: f64| (base - z).max(z - top) / (top - base);
        let place = if points.iter().all(|p| p[2] >= top) {
            Some("above")
        } else if points.iter().all(|p| p[2] <= base) {
            Some("below")
        } else {
            None
        };
        if let Some(place) = place {
            let message =
                format!("{what} lies {place} the domain, whose z range is from {base} to {top}");
            let range = |points: &mut dyn Iterator<Item = f64>| {
                points.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
                    (low.min(z), high.max(z))
                })
            };
            if let Some(remedy) = upside_down(&asked.frame, heights, [base, top]) {
                let (low, high) = range(&mut points.iter().map(|p| p[2]));
                self.reader.wrong(
                    node,
                    format!("{message}: its heights are from {low:.1} to {high:.1}"),
                    remedy,
                );
                return None;
            }
        }
        let is_foreign =
            |z: f64| lies_beyond(z) > ABSURD || lies_beyond(z) > 1.0 && is_usual(&asked.frame, z);
        let mut foreign = points.iter().map(|p| p[2]).filter(|z| is_foreign(*z));
        if let Some(first) = foreign.next() {
            let raw = asked.frame.raw(first);
            self.reader.wrong(
                node,
                format!(
                    "{what} has {} height(s) far outside of the domain's z range from {base} to {top}, such as {raw}",
                    foreign.count() + 1
                ),
                format!("if that means that there are no data, write null = {raw}; else correct it"),
            );
            return None;
        }
        if let Some(place) = place {
            self.note(
                node,
                format!(
                    "{what} lies {place} the domain, whose z range is from {base} to {top}; move the surface, or make the domain's z range larger"
                ),
            );
        }
        Some(())
    }

    fn not_fitted(&self, asked: &Asked<'_>, used: &[(DVec3, Origin)], error: &HorizonError) {
        let what = asked.what;
        let (message, remedy) = match error {
            HorizonError::Unreached {
                index,
                reached,
                tolerance,
                cells,
                ..
            } => {
                let (at, origin) = used[*index];
                (
                    format!(
                        "{what} misses the height at {origin} of {} by {reached:.3} m, more than the tolerance of {tolerance} m, with \
                         {cells} cells along its longer side; that is ({:.1}, {:.1}, {:.2}) in the model",
                        quoted(&asked.file), at.x, at.y, at.z
                    ),
                    "give a greater tolerance, or write smooth = … if the heights have noise; or look for an outlier, or for heights above one another".to_owned(),
                )
            }
            HorizonError::Rough {
                noise,
                reached,
                nodes: [nx, ny],
            } => (
                format!(
                    "the heights of {what} scatter by {reached:.3} m (root mean square) about a surface of {nx} × {ny} control points, more \
                     than smooth = {noise}"
                ),
                format!(
                    "write smooth = {:.3} or more, or look for outliers",
                    1.05 * reached
                ),
            ),
            other => (
                format!("{what}: {other}"),
                "look at the heights near the domain".to_owned(),
            ),
        };
        self.reader.wrong(asked.node, message, remedy);
    }

    /// Says how far a surface goes on where there are no data.
    fn note_coverage(&mut self, asked: &Asked<'_>, coverage: &Coverage, diagonal: f64) {
        let (node, what) = (asked.node, asked.what);
        if coverage.has_holes() {
            self.note(
                node,
                format!(
                    "{what} has holes in its data, up to {:.0} m from the nearest height (these are about {:.0} m apart); they are filled by \
                     the surface that bends least",
                    coverage.filled, coverage.spacing
                ),
            );
        }
        // Half a step of the data is what everybody leaves at the border.
        if coverage.extrapolated > coverage.spacing.min(0.02 * diagonal) {
            self.note(
                node,
                format!(
                    "{what} goes on beyond its data by up to {:.0} m, as the surface that bends least",
                    coverage.extrapolated
                ),
            );
        }
    }
}

/// Whether an elevation is of a magnitude, in the file, that programs write where there are no data.
fn is_usual(frame: &Frame, z: f64) -> bool {
    let raw = ((z + frame.origin.z) / frame.unit).abs();
    NO_DATA.iter().any(|null| (raw - null).abs() <= 1e-6 * null)
}

/// What to do if heights turned upside down, or in feet, would lie in the domain.
fn upside_down(frame: &Frame, heights: &Heights, [base, top]: [f64; 2]) -> Option<String> {
    let turned = match frame.positive {
        Some(Positive::Down) => Positive::Up,
        _ => Positive::Down,
    };
    let fits = |positive: Option<Positive>, unit: f64| {
        let other = Frame {
            positive,
            unit,
            ..*frame
        };
        let mut within = heights.samples().map(|sample| other.local(sample.at).z);
        within.any(|z| (base..=top).contains(&z))
    };
    let turn = match turned {
        Positive::Down => "its numbers are depths: write positive = \"down\"",
        Positive::Up => "its numbers are elevations: write positive = \"up\"",
    };
    let feet = "its heights are in feet: write unit = \"ft\"";
    if fits(Some(turned), frame.unit) {
        Some(turn.to_owned())
    } else if frame.unit == 1.0 && fits(frame.positive, UNITS[1].1) {
        Some(feet.to_owned())
    } else if frame.unit == 1.0 && fits(Some(turned), UNITS[1].1) {
        Some(format!("{turn}; {feet}"))
    } else {
        None
    }
}
