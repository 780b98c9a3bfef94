//! Surfaces given by their thickness above an older horizon.

use super::file::{FromFile, Measure};
use super::{HorizonSurface, ThicknessFile};
use crate::model::checker::{Checker, Extent};
use crate::model::draft::Family;
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{NodeId, quoted};
use crate::model::values::limits::NOT_NEGATIVE;
use crate::model::values::quantity::quantity;

impl Checker<'_> {
    /// The keys `above` and `thickness` of a surface.
    pub(super) fn above(
        &mut self,
        table: NodeId,
        (above, thickness): (Option<Field<String>>, Option<Field<Any>>),
        (what, extent): (&str, Extent),
        family: Option<&Family<'_>>,
    ) -> Option<HorizonSurface> {
        let horizon = match above {
            None => {
                self.reader
                    .missing(table, what, "above", "above = \"the-older-horizon\"");
                None
            }
            Some(field) => {
                let named = field.good();
                named.and_then(|(node, name)| self.reference(node, &name, what, family))
            }
        };
        let thickness = match thickness {
            None => {
                self.reader
                    .missing(table, what, "thickness", "thickness = 5");
                None
            }
            Some(field) => {
                let given = field.good();
                given.and_then(|(node, Any)| self.thickness(node, what, extent))
            }
        };
        Some(HorizonSurface::Above {
            horizon: horizon?,
            thickness: Box::new(thickness?),
        })
    }

    /// The older horizon above which a surface lies.
    fn reference(
        &self,
        node: NodeId,
        name: &str,
        what: &str,
        family: Option<&Family<'_>>,
    ) -> Option<usize> {
        let Some(family) = family else {
            self.reader.wrong(
                node,
                format!("{what} lies above {}, but it bounds all horizons", quoted(name)),
                "give its heights: level, dipping, grid or points; only the surface of a horizon can be `above` another one",
            );
            return None;
        };
        let older = "name a horizon that comes before it in the list: features follow from oldest to youngest";
        let Some(&horizon) = family.index.get(name) else {
            let remedy = self.reader.hint(|| {
                let horizons = family.horizons();
                let known = horizons.iter().filter(|(at, _)| *at < family.own);
                let known: Vec<&str> = known.map(|(_, id)| *id).collect();
                suggest::name(name, &known, "older horizons")
            });
            self.reader.wrong(
                node,
                format!("{what} lies above {}, which is not a feature", quoted(name)),
                remedy,
            );
            return None;
        };
        let relation = if horizon == family.own {
            "itself".to_owned()
        } else if !family.is_horizon(horizon) {
            // A kind that is none is told where it stands.
            let kind = family.drafts[horizon].kind?.name;
            format!("{}, which is of the kind {kind}", quoted(name))
        } else if horizon > family.own {
            format!("{}, which is younger", quoted(name))
        } else {
            return Some(horizon);
        };
        self.reader
            .wrong(node, format!("{what} lies above {relation}"), older);
        None
    }

    /// A number, a grid, points or a file.
    fn thickness(&mut self, node: NodeId, what: &str, extent: Extent) -> Option<HorizonSurface> {
        let what = format!("the thickness below {what}");
        let has = |key: &str| self.reader.tree.entry(node, key).is_some();
        if !(has("grid") || has("points") || has("file")) {
            let thickness = quantity(&self.reader, node, &what, NOT_NEGATIVE)?;
            return Some(HorizonSurface::Level(thickness));
        }
        let file: ThicknessFile = self.reader.table(node)?;
        let from_file: FromFile = self.reader.table(node)?;
        self.reader.close(node, &what);
        let forms: Vec<&str> = [
            ("grid", file.grid.is_some()),
            ("points", file.points.is_some()),
            ("file", from_file.file.is_some()),
        ]
        .iter()
        .filter(|(_, given)| *given)
        .map(|(name, _)| *name)
        .collect();
        if forms.len() > 1 {
            self.reader.wrong(
                node,
                format!("{what} has {} forms: {}", forms.len(), forms.join(", ")),
                "give one of them",
            );
            return None;
        }
        if let Some((at, key)) = from_file.stray() {
            self.reader.wrong(
                at,
                format!("{what} has a `{key}` without `file`"),
                "remove it: it goes with thicknesses from a file alone",
            );
        }
        let tolerance = file.tolerance;
        if from_file.file.is_some() {
            let as_what = (what.as_str(), Measure::Thickness, extent);
            return self.surface_of_file(node, from_file, tolerance, as_what);
        }
        let grid = self.form(file.grid, |checker, at| checker.grid(at, &what, extent));
        let points = self.form(file.points, |checker, at| {
            checker.scattered(node, at, tolerance, (&what, extent))
        });
        let surface = grid.or(points)?;
        self.are_thicknesses(node, &surface, &what, extent)
            .then_some(surface)
    }

    /// Whether no thickness is below 0, or more than the domain is high; that is told.
    fn are_thicknesses(
        &self,
        node: NodeId,
        surface: &HorizonSurface,
        what: &str,
        extent: Extent,
    ) -> bool {
        let most = extent.z.map_or(f64::INFINITY, |[low, high]| high - low);
        let values: Vec<f64> = match surface {
            HorizonSurface::Grid { heights, .. } => heights.concat(),
            HorizonSurface::Points { points, .. } => points.iter().map(|point| point[2]).collect(),
            _ => return true,
        };
        let is_wrong = |value: &&f64| !(0.0..=most).contains(*value);
        let Some(first) = values.iter().find(is_wrong) else {
            return true;
        };
        let count = values.iter().filter(is_wrong).count();
        self.reader.wrong(
            node,
            format!(
                "{what} has {count} value(s) below 0 or above the domain's height of {most} m, such as {first}"
            ),
            "a bed that is absent has the thickness 0; if the value means that there are no data, give the nodes that have some as \
             `points`",
        );
        false
    }
}
