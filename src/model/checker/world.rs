//! Coordinates that lie far from the domain: data in world coordinates beside a model in local ones, most of all.

use super::{Checker, Extent};
use crate::model::domain::Domain;
use crate::model::tree::NodeId;

impl Checker<'_> {
    /// Whether a point lies far from the domain, and near it once the model's origin is taken off.
    pub(crate) fn is_in_world(&self, point: [f64; 2], x: [f64; 2], y: [f64; 2]) -> bool {
        let [east, north, _] = self.origin;
        let local = [point[0] - east, point[1] - north];
        beyond(point, x, y) > size(x, y) && beyond(local, x, y) <= size(x, y)
    }

    /// What to do about points that are needed in the domain and lie elsewhere.
    fn remedy_for(&self, points: &[[f64; 2]], x: [f64; 2], y: [f64; 2]) -> String {
        let [east, north, _] = self.origin;
        if points.iter().any(|point| self.is_in_world(*point, x, y)) {
            format!(
                "these are coordinates in the world; the model's are its own: subtract the origin [{east}, {north}]"
            )
        } else {
            "give points in the domain, or set its x and y to where the points are".to_owned()
        }
    }

    /// Points that say nothing of the domain are a defect if they lie far from it, and worth a note if they are near.
    pub(crate) fn points_near(
        &mut self,
        node: NodeId,
        points: &[[f64; 3]],
        what: &str,
        extent: Extent,
    ) -> Option<()> {
        let (Some(x), Some(y)) = (extent.x, extent.y) else {
            return Some(());
        };
        let plan: Vec<[f64; 2]> = points.iter().map(|&[x, y, _]| [x, y]).collect();
        let nearest = plan
            .iter()
            .min_by(|a, b| beyond(**a, x, y).total_cmp(&beyond(**b, x, y)))?;
        let distance = beyond(*nearest, x, y);
        if distance == 0.0 {
            return Some(());
        }
        let ([px, py], [west, east], [south, north]) = (*nearest, x, y);
        let message = format!(
            "no point of {what} lies in the domain, whose x is from {west} to {east} and y from {south} to {north}: the nearest, \
             ({px}, {py}), is {distance:.0} m away"
        );
        let remedy = self.remedy_for(&plan, x, y);
        if distance > size(x, y) {
            self.reader.wrong(node, message, remedy);
            return None;
        }
        self.note(
            node,
            format!("{message}, so the surface is a guess in all of the domain; {remedy}"),
        );
        Some(())
    }

    /// Says so if all of these points are given in world coordinates.
    pub(crate) fn note_world(
        &mut self,
        node: NodeId,
        points: &[[f64; 2]],
        what: &str,
        domain: &Domain,
    ) {
        let in_world = |point: &[f64; 2]| self.is_in_world(*point, domain.x, domain.y);
        if points.is_empty() || !points.iter().all(in_world) {
            return;
        }
        let remedy = self.remedy_for(points, domain.x, domain.y);
        self.note(node, format!("{what} lies far from the domain; {remedy}"));
    }
}

/// How far a point lies outside of a rectangle (m).
pub(crate) fn beyond([px, py]: [f64; 2], x: [f64; 2], y: [f64; 2]) -> f64 {
    let outside = |at: f64, [low, high]: [f64; 2]| (low - at).max(at - high).max(0.0);
    outside(px, x).hypot(outside(py, y))
}

/// The longer side of a rectangle (m).
pub(crate) fn size([west, east]: [f64; 2], [south, north]: [f64; 2]) -> f64 {
    (east - west).max(north - south)
}
