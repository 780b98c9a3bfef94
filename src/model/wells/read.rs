//! Wells are read and checked: all that is wrong with them at once.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3Swizzles};

use super::file::{PATHS, SPACINGS, WellFile};
use super::spec::{DepthUnit, METRE, WellSpec};
use super::stations::{Frame, Start};
use super::survey::Written;
use crate::features::well::{Path, Well, WellError};
use crate::model::checker::Checker;
use crate::model::checker::world::{beyond, size};
use crate::model::domain::Domain;
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};
use crate::model::values::facies::is_id;
use crate::model::values::unit::UNITS;
use crate::nurbs::interpolate::Parametrization;

/// Turns of more degrees for each 30 m are worth a note.
const SHARP: f64 = 10.0;
/// Paths that differ from measured depth by more than this part of it are worth a note.
const MISFIT: f64 = 1e-3;

impl Checker<'_> {
    /// The wells of a model.
    pub(crate) fn wells(
        &mut self,
        field: Option<Field<Any>>,
        domain: Option<&Domain>,
    ) -> Option<Vec<WellSpec>> {
        let Some(field) = field else {
            return Some(Vec::new());
        };
        let (node, Any) = field.good()?;
        let before = self.reader.found();
        let Value::List(nodes) = self.reader.tree.value(node) else {
            self.not_a_list(node, "wells", "[[well]]");
            return None;
        };
        let mut wells = Vec::with_capacity(nodes.len());
        let mut names = BTreeMap::new();
        for node in nodes.clone() {
            self.well(node, &mut names, &mut wells);
        }
        if let Some(domain) = domain {
            for well in &wells {
                self.note_far(node, well, domain);
            }
        }
        (self.reader.found() == before).then_some(wells)
    }

    pub(super) fn not_a_list(&self, node: NodeId, what: &str, example: &str) {
        let found = self.reader.tree.describe(node);
        self.reader.wrong(
            node,
            format!("expected a list of {what}, found {found}"),
            format!("write each as a table {example}"),
        );
    }

    /// An id that no other well has.
    pub(super) fn well_id(
        &self,
        field: Field<String>,
        table: NodeId,
        kind: &str,
        names: &mut BTreeMap<String, NodeId>,
    ) -> Option<String> {
        let what = format!("this {kind}");
        let (node, id) = self
            .reader
            .need(field, table, &what, "id", "id = \"A-1\"")?;
        if !is_id(&id) {
            self.reader.wrong(
                node,
                format!("{} is not an id", quoted(&id)),
                "use letters, digits, `-` and `_`, as \"A-1\"",
            );
            return None;
        }
        if names.insert(id.clone(), node).is_some() {
            self.reader.wrong(
                node,
                format!("there are two {kind}s {}", quoted(&id)),
                "give one of them another id",
            );
            return None;
        }
        Some(id)
    }

    fn well(
        &mut self,
        node: NodeId,
        names: &mut BTreeMap<String, NodeId>,
        wells: &mut Vec<WellSpec>,
    ) {
        let before = self.reader.found();
        let Some(file) = self.reader.table::<WellFile>(node) else {
            return;
        };
        let id = self.well_id(file.id, node, "well", names);
        let what = id.as_ref().map_or_else(
            || "this well".to_owned(),
            |id| format!("well {}", quoted(id)),
        );
        self.reader.close(node, &what);
        let unit = self.depth_unit(file.unit);
        let plan_unit = self.unit(file.plan_unit);
        let (datum, head) = (
            file.datum.and_then(Field::good),
            file.head.and_then(Field::good),
        );
        let world = file.world.and_then(Field::good).map(|(_, world)| world);
        let path = self.path(
            file.path,
            file.parametrization,
            Path::Spline(Parametrization::ChordLength),
            &what,
        );
        let completions = self.completions(file.completions, unit, &what);
        let diameter = self.diameter(file.diameter, &what);
        let sidetracks = self.sidetracks(file.laterals, unit, &what);
        let survey = self
            .reader
            .need(file.survey, node, &what, "survey", "survey = [{ md = 0, inc_deg = 0, azi_deg = 0 }, { md = 900, inc_deg = 0, azi_deg = 0 }]")
            .and_then(|(at, Any)| self.written_survey(at, &format!("the survey of {what}")));
        let Some(survey) = survey.filter(|_| self.reader.found() == before) else {
            return;
        };
        // Coordinates of the model file are the model's, those of other files the world's.
        let is_world = world.unwrap_or(survey.source.is_some() && head.is_none());
        let origin = if is_world {
            DVec3::from_array(self.origin)
        } else {
            DVec3::ZERO
        };
        let datum = datum
            .map(|(_, datum)| datum)
            .or(survey.datum)
            .unwrap_or(0.0)
            * unit.metres;
        let frame = Frame {
            unit: unit.metres,
            plan_unit,
            datum,
            origin,
        };
        let head = head
            .map(|(_, head)| head)
            .or(survey.head.filter(|_| !has_points(&survey)));
        let head = head.map(|head| frame.plan(head).extend(frame.elevation(datum)));
        let Some(path) = path else { return };
        let name = format!("the survey of {what}");
        let Some(stations) = self.stations(&survey, frame, Start::Head(head), &name) else {
            return;
        };
        let made = Well::new(stations, path);
        let Some(well) = self.made(made, &survey, &what) else {
            return;
        };
        let spec = WellSpec {
            name: id.unwrap_or_default(),
            mother: None,
            well,
            path,
            datum,
            sea_level: -origin.z,
            unit,
            completions: Vec::new(),
            diameter,
            source: survey.source,
            place: self.place(node),
        };
        self.with_laterals((node, &what), spec, completions, (sidetracks, frame), wells);
    }

    /// A path, or a defect of its survey.
    pub(super) fn made(
        &self,
        made: Result<Well, WellError>,
        survey: &Written,
        what: &str,
    ) -> Option<Well> {
        let error = match made {
            Ok(well) => return Some(well),
            Err(error) => error,
        };
        let remedy = match &error {
            WellError::NoDirection { .. } => {
                "give md, inc_deg and azi_deg, or write path = \"spline\""
            }
            WellError::Survey(_) => "give two stations at least, in the order of their depths",
            _ => "leave out stations that almost coincide",
        };
        self.reader
            .wrong(survey.node, format!("{what}: {error}"), remedy);
        None
    }

    fn depth_unit(&self, field: Option<Field<String>>) -> DepthUnit {
        let word = match &field {
            Some(Field::Good(_, word)) => Some(word.clone()),
            _ => None,
        };
        let metres = self.unit(field);
        let known = UNITS.iter().find(|(name, _)| word.as_deref() == Some(name));
        known.map_or(METRE, |(name, _)| DepthUnit { name, metres })
    }

    /// How stations are joined.
    pub(super) fn path(
        &self,
        path: Option<Field<String>>,
        spacing: Option<Field<String>>,
        usual: Path,
        what: &str,
    ) -> Option<Path> {
        let known = |field: Option<Field<String>>, words: &[&'static str], key: &str| match field {
            None => Some(None),
            Some(field) => {
                let (node, word) = field.good()?;
                let found = words.iter().find(|known| **known == word);
                if found.is_none() {
                    let message = format!("the {key} of {what} is {}", quoted(&word));
                    self.reader
                        .wrong(node, message, suggest::name(&word, words, key));
                }
                Some(Some((node, *found?)))
            }
        };
        let path = known(path, &PATHS, "path");
        let spacing = known(spacing, &SPACINGS, "parametrization");
        let (path, spacing) = (path?, spacing?);
        let chosen = match path {
            None => usual,
            Some((_, "minimum-curvature")) => Path::MinimumCurvature,
            Some(_) => match usual {
                Path::Spline(_) => usual,
                Path::MinimumCurvature => Path::Spline(Parametrization::ChordLength),
            },
        };
        match (chosen, spacing) {
            (chosen, None) => Some(chosen),
            (Path::Spline(_), Some((_, word))) => Some(Path::Spline(if word == "centripetal" {
                Parametrization::Centripetal
            } else {
                Parametrization::ChordLength
            })),
            (Path::MinimumCurvature, Some((node, _))) => {
                self.reader.wrong(
                    node,
                    format!("{what} has a `parametrization`, and its path is no spline"),
                    "leave it out, or write path = \"spline\"",
                );
                None
            }
        }
    }

    /// Where a well is open, in metres.
    pub(super) fn completions(
        &self,
        field: Option<Field<Any>>,
        unit: DepthUnit,
        what: &str,
    ) -> Vec<(NodeId, [f64; 2])> {
        let Some((node, Any)) = field.and_then(Field::good) else {
            return Vec::new();
        };
        let example =
            "write [[from, to], …] by measured depth, for example: completions = [[2010, 2050]]";
        let Value::List(nodes) = self.reader.tree.value(node) else {
            let found = self.reader.tree.describe(node);
            let message =
                format!("expected a list of ranges for the completions of {what}, found {found}");
            self.reader.wrong(node, message, example);
            return Vec::new();
        };
        let mut all = Vec::with_capacity(nodes.len());
        for node in nodes.clone() {
            let elements = self.reader.tree.elements(node);
            let &[from, to] = elements else {
                let found = self.reader.tree.describe(node);
                let message =
                    format!("expected [from, to] for a completion of {what}, found {found}");
                self.reader.wrong(node, message, example);
                continue;
            };
            let (Some(from), Some(to)) = (self.reader.number(from), self.reader.number(to)) else {
                continue;
            };
            if from < to {
                all.push((node, [from * unit.metres, to * unit.metres]));
            } else {
                self.no_range(
                    node,
                    &format!("a completion of {what}"),
                    [from, to],
                    "write the upper measured depth first",
                );
            }
        }
        all
    }

    /// Completions that lie on a well, in order; those that overlap are one.
    pub(super) fn within(
        &self,
        completions: Vec<(NodeId, [f64; 2])>,
        well: &Well,
        what: &str,
    ) -> Vec<[f64; 2]> {
        let (first, last) = well.range();
        let slack = 1e-6;
        let mut ranges = Vec::with_capacity(completions.len());
        for (node, [from, to]) in completions {
            if from < first - slack || to > last + slack {
                self.reader.wrong(
                    node,
                    format!("the completion from {from} to {to} m is not on {what}, which goes from {first:.2} to {last:.2} m"),
                    "write measured depths of the well; a lateral has completions of its own",
                );
            } else {
                ranges.push([from.max(first), to.min(last)]);
            }
        }
        ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut joined: Vec<[f64; 2]> = Vec::with_capacity(ranges.len());
        for [from, to] in ranges {
            match joined.last_mut() {
                Some(last) if from <= last[1] => last[1] = last[1].max(to),
                _ => joined.push([from, to]),
            }
        }
        joined
    }

    pub(super) fn diameter(&self, field: Option<Field<f64>>, what: &str) -> Option<f64> {
        let (node, diameter) = field?.good()?;
        if diameter > 0.0 {
            return Some(diameter);
        }
        let message = format!("the diameter of {what} is {diameter}; it must be above 0");
        self.reader
            .wrong(node, message, "write it in metres: 8.5 inches are 0.2159");
        None
    }

    /// What a survey that is probably wrong shows.
    pub(super) fn note_quality(&mut self, node: NodeId, spec: &WellSpec) {
        let quality = spec.well.quality();
        let name = quoted(&spec.name);
        if quality.dogleg_deg_30m > SHARP {
            let message = format!(
                "well {name} turns by {:.1}° for each 30 m above {:.1} m of measured depth; more than {SHARP} is rare: check the survey",
                quality.dogleg_deg_30m, quality.dogleg_md
            );
            self.note(node, message);
        }
        if quality.misfit > MISFIT {
            let message = format!(
                "the path of well {name} above {:.1} m of measured depth differs from that depth by {:.3} % of it; check the survey, or give more stations{}",
                quality.misfit_md,
                100.0 * quality.misfit,
                if spec.path == Path::MinimumCurvature {
                    ""
                } else {
                    ", or write path = \"minimum-curvature\""
                }
            );
            self.note(node, message);
        }
    }

    /// A well that never comes near the domain is probably in other coordinates.
    fn note_far(&mut self, node: NodeId, spec: &WellSpec, domain: &Domain) {
        let places = || spec.well.curve().points().iter();
        let out = |p: &DVec3| beyond([p.x, p.y], domain.x, domain.y);
        let nearest = places().map(out).fold(f64::INFINITY, f64::min);
        let name = quoted(&spec.name);
        let [low, high] = domain.z;
        if nearest > 0.0 {
            let origin = DVec3::from_array(self.origin).xy();
            let is_local = |p: &DVec3| {
                beyond((p.xy() - origin).to_array(), domain.x, domain.y) <= size(domain.x, domain.y)
            };
            let is_world = |p: &DVec3| {
                beyond((p.xy() + origin).to_array(), domain.x, domain.y) <= size(domain.x, domain.y)
            };
            let remedy = if nearest > size(domain.x, domain.y) && places().all(is_local) {
                "; its coordinates seem to be those of the world: write world = true"
            } else if nearest > size(domain.x, domain.y) && places().all(is_world) {
                "; its coordinates seem to be the model's own: write world = false"
            } else {
                ""
            };
            self.note(node, format!("well {name} lies beside the domain in plan, {nearest:.0} m from it at least{remedy}"));
        } else if places().all(|p| p.z > high) || places().all(|p| p.z < low) {
            self.note(
                node,
                format!(
                    "well {name} lies above or below the domain, whose z is from {low} to {high}"
                ),
            );
        }
    }
}

/// Whether a survey has positions of its own.
fn has_points(survey: &Written) -> bool {
    survey.forms.contains(&super::survey::Form::Points)
}
