//! Surfaces over the whole domain: level, dipping, a grid of heights, scattered points, a control net.

use super::file::{FromFile, Measure};
use super::heights::{ABSURD, NO_DATA};
use super::{DippingFile, HorizonSurface, NET_TOLERANCE, SurfaceFile};
use crate::model::checker::{Checker, Extent, Reported};
use crate::model::draft::Family;
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;
use crate::model::values::limits::{ANY, AZIMUTH, DIP, Limits};
use crate::model::values::quantity::{Quantity, quantity};
use crate::model::values::tuple::Tuple;

impl Checker<'_> {
    /// A surface; `what` names it, as `the surface of feature "tarbert"`.
    pub(crate) fn surface(
        &mut self,
        node: NodeId,
        what: &str,
        extent: Extent,
        family: Option<&Family<'_>>,
    ) -> Option<HorizonSurface> {
        if self.reader.tree.number(node).is_some() {
            let found = self.reader.tree.describe(node);
            self.reader.wrong(
                node,
                format!("expected a table for {what}, found {found}"),
                "for a level surface write { level = -20 }",
            );
            return None;
        }
        let file: SurfaceFile = self.reader.table(node)?;
        let from_file: FromFile = self.reader.table(node)?;
        self.reader.close(node, what);
        let forms: Vec<&str> = [
            ("level", file.level.is_some()),
            ("dipping", file.dipping.is_some()),
            ("grid", file.grid.is_some()),
            ("points", file.points.is_some()),
            ("net", file.net.is_some()),
            ("file", from_file.file.is_some()),
            ("above", file.above.is_some() || file.thickness.is_some()),
        ]
        .iter()
        .filter(|(_, given)| *given)
        .map(|(name, _)| *name)
        .collect();
        if forms.len() > 1 || (forms.is_empty() && self.reader.unknown(node).is_empty()) {
            let message = match forms.len() {
                0 => format!("{what} has no form"),
                n => format!("{what} has {n} forms: {}", forms.join(", ")),
            };
            self.reader.wrong(
                node,
                message,
                "give one of level = …, dipping = { … }, grid = { … }, points = [[x, y, z], …], net = { … }, file = \"…\", or of a \
                 horizon above = \"…\" with thickness = …",
            );
        }
        let is_approximated =
            file.points.is_some() || file.net.is_some() || from_file.file.is_some();
        if let (Some(Field::Good(at, _)), false) = (&file.tolerance, is_approximated) {
            self.reader.wrong(
                *at,
                format!("{what} has a `tolerance` without `points`, a `net` or a `file`"),
                "remove it: every other form is met exactly",
            );
        }
        if let Some((at, key)) = from_file.stray() {
            self.reader.wrong(
                at,
                format!("{what} has a `{key}` without `file`"),
                "remove it: it goes with heights from a file alone",
            );
        }
        // All forms are looked at, so that one slip hides no other.
        let level = self.form(file.level, |checker, at| checker.level_at(at, what, extent));
        let dipping = self.form(file.dipping, |checker, at| checker.dipping(at, what));
        let grid = self.form(file.grid, |checker, at| checker.grid(at, what, extent));
        let (tolerance, file_tolerance) = if from_file.file.is_some() {
            (None, file.tolerance)
        } else {
            (file.tolerance, None)
        };
        if let Some(field) = file.net {
            let net = self.surface_net(field, tolerance, what);
            let net = net.filter(|_| forms.len() == 1)?;
            self.note_beyond(node, &net, what, extent);
            return Some(net);
        }
        let points = self.form(file.points, |checker, at| {
            checker.scattered(node, at, tolerance, (what, extent))
        });
        let above = if forms.contains(&"above") {
            self.above(node, (file.above, file.thickness), (what, extent), family)
        } else {
            None
        };
        let measured = if forms == ["file"] {
            let as_what = (what, Measure::Elevation, extent);
            self.surface_of_file(node, from_file, file_tolerance, as_what)
        } else {
            None
        };
        let surface = level
            .or(dipping)
            .or(grid)
            .or(points)
            .or(measured)
            .or(above)?;
        if self.is_no_data(node, &surface, what, extent) {
            return None;
        }
        self.note_beyond(node, &surface, what, extent);
        (forms.len() == 1).then_some(surface)
    }

    /// Whether a height is no height but stands for missing data; that is told. A spline through it would throw the surface
    /// about for many nodes around.
    fn is_no_data(
        &mut self,
        node: NodeId,
        surface: &HorizonSurface,
        what: &str,
        extent: Extent,
    ) -> bool {
        let Some([low, high]) = extent.z else {
            return false;
        };
        let foreign = |z: &&f64| {
            let outside = (low - **z).max(**z - high) / (high - low);
            let is_usual = NO_DATA.contains(&z.abs());
            outside > ABSURD || is_usual && outside > 1.0
        };
        let found: Vec<f64> = match surface {
            HorizonSurface::Grid { heights, .. } => {
                heights.iter().flatten().filter(foreign).copied().collect()
            }
            HorizonSurface::Points { points, .. } => {
                let heights = points.iter().map(|point| &point[2]);
                heights.filter(foreign).copied().collect()
            }
            _ => return false,
        };
        let Some(first) = found.first() else {
            return false;
        };
        self.reader.wrong(
            node,
            format!(
                "{what} has {} height(s) far outside of the domain's z range from {low} to {high}, such as {first}",
                found.len()
            ),
            "if that means that there are no data, give the nodes that have some as `points`; else correct it",
        );
        true
    }

    pub(crate) fn form(
        &mut self,
        field: Option<Field<Any>>,
        read: impl FnOnce(&mut Self, NodeId) -> Option<HorizonSurface>,
    ) -> Option<HorizonSurface> {
        let (node, Any) = field?.good()?;
        read(self, node)
    }

    /// The domain's own base or top, which may be left out.
    pub(crate) fn bounding_surface(
        &mut self,
        field: Option<Field<Any>>,
        key: &str,
        extent: Extent,
    ) -> Result<Option<(NodeId, HorizonSurface)>, Reported> {
        let Some(field) = field else { return Ok(None) };
        let (node, Any) = field.good().ok_or(Reported)?;
        self.surface(node, &format!("the {key} of the domain"), extent, None)
            .map(|surface| Some((node, surface)))
            .ok_or(Reported)
    }

    /// A level base of the domain must lie below a level top.
    pub(crate) fn check_order(
        &self,
        base: Option<&(NodeId, HorizonSurface)>,
        top: Option<&(NodeId, HorizonSurface)>,
    ) {
        if let Some((_, HorizonSurface::Level(base))) = base
            && let Some((node, HorizonSurface::Level(top))) = top
            && base.support().1 >= top.support().0
        {
            let (base, top) = (base.support().1, top.support().0);
            self.reader.wrong(
                *node,
                format!("the top of the domain at {top} is not above its base at {base}"),
                "z points up: lower the base or raise the top",
            );
        }
    }

    fn level_at(&mut self, node: NodeId, what: &str, extent: Extent) -> Option<HorizonSurface> {
        let what = format!("the level of {what}");
        let level = quantity(&self.reader, node, &what, ANY)?;
        let Some([base, top]) = extent.z else {
            return Some(HorizonSurface::Level(level));
        };
        let (low, high) = level.support();
        let (outside, key) = if low <= base {
            (low, "min")
        } else if high >= top {
            (high, "max")
        } else {
            return Some(HorizonSurface::Level(level));
        };
        if outside.is_infinite() {
            self.reader.wrong(
                node,
                format!("the distribution of {what} has no limit on one side; it must lie inside the domain's z range from {base} to {top}"),
                format!("truncate it with {key} = …"),
            );
            return None;
        }
        let verb = match level {
            Quantity::Constant(_) => "is",
            Quantity::Random(_) => "can be",
        };
        self.reader.wrong(
            node,
            format!(
                "{what} {verb} {outside}, not inside the domain's z range from {base} to {top}"
            ),
            format!("choose it above {base} and below {top}, or make the domain's z range larger"),
        );
        None
    }

    fn dipping(&mut self, node: NodeId, what: &str) -> Option<HorizonSurface> {
        let file: DippingFile = self.reader.table(node)?;
        self.reader.close(node, &format!("the `dipping` of {what}"));
        let name = format!("the `dipping` of {what}");
        let through = self
            .reader
            .need(
                file.through,
                node,
                &name,
                "through",
                "through = [0, 0, -20]",
            )
            .and_then(|(at, Any)| {
                let point = Tuple {
                    what: format!("the point that {what} passes through"),
                    names: ["x", "y", "z"],
                    limits: ANY,
                    remedy: "write the three coordinates in [ ], in metres",
                };
                point.read(&self.reader, at)
            });
        let angle = |field: Field<Any>, key: &str, example: &str, limits: Limits| {
            let (at, Any) = self.reader.need(field, node, &name, key, example)?;
            quantity(&self.reader, at, &format!("the {key} of {what}"), limits)
        };
        let dip = angle(file.dip_deg, "dip_deg", "dip_deg = 2", DIP);
        let azimuth = angle(file.azimuth_deg, "azimuth_deg", "azimuth_deg = 90", AZIMUTH);
        Some(HorizonSurface::Dipping {
            through: through?,
            dip_deg: dip?,
            azimuth_deg: azimuth?,
        })
    }

    /// A control net, and how far the surface may be from it.
    fn surface_net(
        &self,
        field: Field<Any>,
        tolerance: Option<Field<f64>>,
        what: &str,
    ) -> Option<HorizonSurface> {
        let net = field.good().and_then(|(at, Any)| self.one_net(at, what));
        let tolerance = match tolerance {
            None => Some(NET_TOLERANCE),
            Some(field) => field.good().and_then(|(at, tolerance)| {
                self.above_nothing(at, tolerance, what).then_some(tolerance)
            }),
        };
        Some(HorizonSurface::Net {
            net: Box::new(net?),
            tolerance: tolerance?,
        })
    }

    /// Whether a tolerance is above 0; else that is told.
    pub(super) fn above_nothing(&self, at: NodeId, tolerance: f64, what: &str) -> bool {
        if tolerance <= 0.0 {
            self.reader.wrong(
                at,
                format!("the tolerance of {what} is {tolerance}; it must be above 0"),
                "write how far the surface may pass from a point, or from its net; for heights on a grid use `grid`",
            );
        }
        tolerance > 0.0
    }

    /// Says so if nothing of a surface lies in the domain.
    fn note_beyond(&mut self, node: NodeId, surface: &HorizonSurface, what: &str, extent: Extent) {
        let Extent {
            x: Some(x),
            y: Some(y),
            z: Some([base, top]),
        } = extent
        else {
            return;
        };
        let heights: Vec<f64> = match surface {
            // What is worth saying of a file is said where that is read.
            HorizonSurface::Level(_) | HorizonSurface::Above { .. } | HorizonSurface::File(_) => {
                return;
            }
            HorizonSurface::Dipping {
                through,
                dip_deg,
                azimuth_deg,
            } => {
                let [cx, cy, cz] = through.each_ref().map(Quantity::constant);
                let (Some(cx), Some(cy), Some(cz), Some(dip), Some(azimuth)) =
                    (cx, cy, cz, dip_deg.constant(), azimuth_deg.constant())
                else {
                    return;
                };
                let (sin, cos) = azimuth.to_radians().sin_cos();
                let fall = dip.to_radians().tan();
                let at = |x: f64, y: f64| cz - fall * ((x - cx) * sin + (y - cy) * cos);
                vec![
                    at(x[0], y[0]),
                    at(x[1], y[0]),
                    at(x[0], y[1]),
                    at(x[1], y[1]),
                ]
            }
            HorizonSurface::Grid { heights, .. } => heights.concat(),
            HorizonSurface::Points { points, .. } => points.iter().map(|point| point[2]).collect(),
            HorizonSurface::Net { net, .. } => net
                .net
                .points
                .iter()
                .flatten()
                .map(|point| point.z)
                .collect(),
        };
        let turned = heights.iter().any(|z| (base..=top).contains(&-z));
        let remedy = if turned {
            "z points up, so depths are negative: turn the sign of its heights"
        } else {
            "move the surface, or make the domain's z range larger"
        };
        let place = if heights.iter().all(|&z| z >= top) {
            "above"
        } else if heights.iter().all(|&z| z <= base) {
            "below"
        } else {
            return;
        };
        self.note(
            node,
            format!(
                "{what} lies {place} the domain, whose z range is from {base} to {top}; {remedy}"
            ),
        );
    }
}
