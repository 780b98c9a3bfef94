//! What is wrong with heights of a file, or probably not meant.

use glam::{DVec3, Vec3Swizzles};

use super::frame::{Asked, Frame};
use crate::data::{Heights, Origin, Positive};
use crate::features::coverage::Coverage;
use crate::features::horizon::HorizonError;
use crate::model::checker::world::{beyond, size};
use crate::model::checker::{Checker, Extent};
use crate::model::tree::quoted;
use crate::model::values::surface::heights::{ABSURD, NO_DATA};
use crate::model::values::unit::UNITS;

impl Checker<'_> {
    /// Data that say nothing of the domain are a defect if they lie far from it, and worth a note if they are near.
    pub(super) fn is_near(
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

    /// Thicknesses below 0, or of more than the domain is high, are defects.
    pub(super) fn are_thicknesses_of_file(
        &self,
        asked: &Asked<'_>,
        points: &[[f64; 3]],
        extent: Extent,
    ) -> Option<()> {
        let [base, top] = extent.z?;
        let most = top - base;
        let mut wrong = points
            .iter()
            .map(|p| p[2])
            .filter(|value| !(0.0..=most).contains(value));
        let Some(first) = wrong.next() else {
            return Some(());
        };
        let raw = asked.frame.raw(first);
        let feet = UNITS[1].1;
        let is_feet = asked.frame.unit == 1.0
            && first > 0.0
            && points.iter().all(|p| (0.0..=most).contains(&(feet * p[2])));
        let remedy = if is_feet {
            "if they are in feet, write unit = \"ft\"".to_owned()
        } else {
            format!(
                "a bed that is absent has the thickness 0; if that means that there are no data, write null = {raw}"
            )
        };
        self.reader.wrong(
            asked.node,
            format!(
                "{} has {} value(s) below 0 or above the domain's height of {most} m, such as {raw}",
                asked.what,
                wrong.count() + 1
            ),
            remedy,
        );
        None
    }

    /// Heights that stand for no data, and those that are upside down or in another unit, are defects; others beyond the domain are
    /// worth a note.
    pub(super) fn are_heights(
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

    pub(super) fn not_fitted(
        &self,
        asked: &Asked<'_>,
        used: &[(DVec3, Origin)],
        error: &HorizonError,
    ) {
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
    pub(super) fn note_coverage(&mut self, asked: &Asked<'_>, coverage: &Coverage) {
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
        if coverage.reaches_beyond() {
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
