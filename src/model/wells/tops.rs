//! Tops picked in wells, as a file has them.

use super::spec::{TopSpec, WellSpec};
use crate::data::tops;
use crate::model::checker::Checker;
use crate::model::read::Field;
use crate::model::spec::Feature;
use crate::model::suggest;
use crate::model::tree::quoted;

impl Checker<'_> {
    /// The tops of a file: each of a known well and horizon, and on that well.
    pub(crate) fn tops(
        &self,
        field: Option<Field<String>>,
        wells: &[WellSpec],
        features: &[Feature],
    ) -> Option<Vec<TopSpec>> {
        let Some(field) = field else {
            return Some(Vec::new());
        };
        let (node, file) = field.good()?;
        let bytes = self.bytes_of(node, "the tops", &file)?;
        let before = self.reader.found();
        let file = quoted(&file);
        let read = match tops::read(&bytes) {
            Ok(read) => read,
            Err(error) => {
                let remedy = "write a table with the columns well, horizon and md";
                self.reader
                    .wrong(node, format!("the tops: {file}: {error}"), remedy);
                return None;
            }
        };
        let names: Vec<&str> = wells.iter().map(|well| well.name.as_str()).collect();
        let is_horizon = |feature: &&Feature| feature.kind.base().is_some();
        let horizons: Vec<&str> = features
            .iter()
            .filter(is_horizon)
            .map(|feature| feature.id.as_str())
            .collect();
        let mut all = Vec::with_capacity(read.len());
        for top in read {
            let line = top.line;
            let Some(well) = names.iter().position(|name| *name == top.well) else {
                let message = format!(
                    "the tops: {file}, line {line}: there is no well {}",
                    quoted(&top.well)
                );
                self.reader.wrong(
                    node,
                    message,
                    self.reader
                        .hint(|| suggest::name(&top.well, &names, "wells")),
                );
                continue;
            };
            let horizon = features
                .iter()
                .position(|one| one.id == top.horizon && is_horizon(&one));
            let Some(horizon) = horizon else {
                let message = format!(
                    "the tops: {file}, line {line}: there is no horizon {}",
                    quoted(&top.horizon)
                );
                self.reader.wrong(
                    node,
                    message,
                    self.reader
                        .hint(|| suggest::name(&top.horizon, &horizons, "horizons")),
                );
                continue;
            };
            let spec = &wells[well];
            let md = top.md * spec.unit.metres;
            let (first, last) = spec.well.range();
            if !(md >= first && md <= last) {
                let message = format!(
                    "the tops: {file}, line {line}: a measured depth of {md} m is not on well {}, which goes from {first:.2} to {last:.2} m",
                    quoted(&top.well)
                );
                self.reader.wrong(node, message, "write the measured depth at which the well meets the horizon, in the well's unit");
                continue;
            }
            all.push(TopSpec {
                well,
                horizon,
                md,
                point: spec.well.point(md),
            });
        }
        (self.reader.found() == before).then_some(all)
    }
}
