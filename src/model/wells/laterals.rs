//! Laterals and side-tracks: they leave a well, or another lateral, at a control point of its path.

use std::collections::BTreeMap;

use super::file::LateralFile;
use super::spec::{DepthUnit, WellSpec};
use super::stations::{Frame, Start};
use super::survey::Written;
use crate::features::well::Well;
use crate::model::checker::Checker;
use crate::model::read::{Any, Field};
use crate::model::tree::{NodeId, Value, quoted};

/// What a lateral has of its mother: the well or the lateral that it leaves.
struct Mother<'a> {
    index: usize,
    spec: &'a WellSpec,
    frame: Frame,
}

/// What is read of a lateral before its mother has a path.
pub(super) struct Sidetrack {
    node: NodeId,
    what: String,
    id: String,
    at: (NodeId, f64),
    survey: Written,
    path: Option<Field<String>>,
    parametrization: Option<Field<String>>,
    completions: Vec<(NodeId, [f64; 2])>,
    diameter: Option<f64>,
    laterals: Vec<Self>,
}

impl Checker<'_> {
    /// Adds a well, and then its laterals, each with its own: they leave a path that has all their junctions.
    pub(super) fn with_laterals(
        &mut self,
        (node, what): (NodeId, &str),
        mut spec: WellSpec,
        completions: Vec<(NodeId, [f64; 2])>,
        (sidetracks, frame): (Vec<Sidetrack>, Frame),
        wells: &mut Vec<WellSpec>,
    ) {
        spec.completions = self.within(completions, &spec.well, what);
        self.note_quality(node, &spec);
        let mut joined = Vec::with_capacity(sidetracks.len());
        for sidetrack in sidetracks {
            let (at, md) = sidetrack.at;
            match spec.well.with_junction(md * frame.unit) {
                Ok(well) => {
                    spec.well = well;
                    joined.push(sidetrack);
                }
                Err(error) => {
                    let message = format!("{} cannot leave {what} there: {error}", sidetrack.what);
                    self.reader.wrong(
                        at,
                        message,
                        "write a measured depth of the well that it leaves, in the well's unit",
                    );
                }
            }
        }
        let index = wells.len();
        wells.push(spec.clone());
        let mother = Mother {
            index,
            spec: &spec,
            frame,
        };
        for sidetrack in joined {
            self.lateral(sidetrack, &mother, wells);
        }
    }

    /// What is written of the laterals of a well or a lateral.
    pub(super) fn sidetracks(
        &mut self,
        field: Option<Field<Any>>,
        unit: DepthUnit,
        of: &str,
    ) -> Vec<Sidetrack> {
        let Some((node, Any)) = field.and_then(Field::good) else {
            return Vec::new();
        };
        let Value::List(nodes) = self.reader.tree.value(node) else {
            self.not_a_list(
                node,
                &format!("laterals for {of}"),
                "{ id = \"north\", at_md = 900, survey = [ … ] }",
            );
            return Vec::new();
        };
        let mut names = BTreeMap::new();
        let mut all = Vec::with_capacity(nodes.len());
        for node in nodes.clone() {
            all.extend(self.sidetrack(node, unit, of, &mut names));
        }
        all
    }

    fn sidetrack(
        &mut self,
        node: NodeId,
        unit: DepthUnit,
        of: &str,
        names: &mut BTreeMap<String, NodeId>,
    ) -> Option<Sidetrack> {
        let file: LateralFile = self.reader.table(node)?;
        let id = self.well_id(file.id, node, "lateral", names);
        let what = id.as_ref().map_or_else(
            || format!("this lateral of {of}"),
            |id| format!("lateral {} of {of}", quoted(id)),
        );
        self.reader.close(node, &what);
        let at = self
            .reader
            .need(file.at_md, node, &what, "at_md", "at_md = 900");
        let completions = self.completions(file.completions, unit, &what);
        let diameter = self.diameter(file.diameter, &what);
        let laterals = self.sidetracks(file.laterals, unit, &what);
        let survey = self
            .reader
            .need(
                file.survey,
                node,
                &what,
                "survey",
                "survey = [{ md = 930, inc_deg = 10, azi_deg = 45 }]",
            )
            .and_then(|(at, Any)| self.written_survey(at, &format!("the survey of {what}")));
        let (id, at, survey) = (id?, at?, survey?);
        Some(Sidetrack {
            node,
            what,
            id,
            at,
            survey,
            path: file.path,
            parametrization: file.parametrization,
            completions,
            diameter,
            laterals,
        })
    }

    /// Adds a lateral with its own ones; what is wrong with it is told.
    fn lateral(
        &mut self,
        sidetrack: Sidetrack,
        mother: &Mother<'_>,
        wells: &mut Vec<WellSpec>,
    ) -> Option<()> {
        let Sidetrack {
            node,
            what,
            id,
            at: (_, at_md),
            survey,
            path,
            parametrization,
            completions,
            diameter,
            laterals,
        } = sidetrack;
        let spec = mother.spec;
        let path = self.path(path, parametrization, spec.path, &what);
        let name = format!("the survey of {what}");
        let md = at_md * mother.frame.unit;
        let (place, tangent) = (spec.well.point(md), spec.well.tangent(md));
        let stations = self.stations(
            &survey,
            mother.frame,
            Start::Junction(md, place, tangent),
            &name,
        )?;
        let made = Well::lateral(&spec.well, md, &stations, path?);
        let well = self.made(made, &survey, &what)?;
        let lateral = WellSpec {
            name: format!("{}/{id}", spec.name),
            mother: Some(mother.index),
            well,
            path: path?,
            completions: Vec::new(),
            diameter: diameter.or(spec.diameter),
            source: survey.source,
            place: self.place(node),
            ..spec.clone()
        };
        self.with_laterals(
            (node, &what),
            lateral,
            completions,
            (laterals, mother.frame),
            wells,
        );
        Some(())
    }
}
