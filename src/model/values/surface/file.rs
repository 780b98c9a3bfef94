//! Surfaces from files of heights: found, read, brought to the model's coordinates, and fitted.

mod frame;
mod judged;
mod keys;

use glam::{DVec3, Vec3Swizzles};

use self::frame::Asked;
use super::HorizonSurface;
use super::from_file::{FileSurface, plan};
use super::heights::on_one_line;
use crate::data::{self, Origin, Reading};
use crate::features::coverage::Coverage;
use crate::features::fitted::Fitted;
use crate::model::checker::files::sha256;
use crate::model::checker::{Checker, Extent};
use crate::model::read::Field;
use crate::model::tree::{NodeId, quoted};

pub(super) use self::frame::Measure;
pub(super) use self::keys::FromFile;

impl Checker<'_> {
    /// A surface, or a thickness, from a file.
    pub(super) fn surface_of_file(
        &mut self,
        table: NodeId,
        keys: FromFile,
        tolerance: Option<Field<f64>>,
        (what, measure, extent): (&str, Measure, Extent),
    ) -> Option<HorizonSurface> {
        let read = self.keys_of_file(table, keys, tolerance, (what, measure))?;
        let asked = Asked {
            node: read.node,
            what,
            file: read.file,
            measure,
            frame: read.frame,
            goal: read.goal,
        };
        self.fitted(asked, &read.reading, extent)
    }

    fn fitted(
        &mut self,
        mut asked: Asked<'_>,
        reading: &Reading,
        extent: Extent,
    ) -> Option<HorizonSurface> {
        let (node, what, measure) = (asked.node, asked.what, asked.measure);
        let bytes = self.bytes_of(asked.node, asked.what, &asked.file)?;
        let heights = match data::read(&bytes, reading) {
            Ok(heights) => heights,
            Err(error) => {
                let message = format!("{what}: {}: {error}", quoted(&asked.file));
                self.reader.wrong(node, message, error.remedy());
                return None;
            }
        };
        if measure == Measure::Elevation {
            asked.frame.positive = asked.frame.positive.or(heights.positive);
        }
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
        match measure {
            Measure::Elevation => self.are_heights(&asked, &points, &heights, extent)?,
            Measure::Thickness => self.are_thicknesses_of_file(&asked, &points, extent)?,
        }
        let places: Vec<DVec3> = used.iter().map(|(at, _)| *at).collect();
        let fitted = match Fitted::new(&places, plan, asked.goal) {
            Ok(fitted) => fitted,
            Err(error) => {
                self.not_fitted(&asked, &used, &error);
                return None;
            }
        };
        let coverage = Coverage::of(&places, plan);
        self.note_coverage(&asked, &coverage);
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
}
