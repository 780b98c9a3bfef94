//! What was decided about horizons that coincide, in words.

use glam::DVec2;

use super::{Change, Deciding};
use crate::features::pinch_out::{Absence, Nodes};

impl Deciding<'_> {
    /// Says where the bed between two layers is absent, and whose surface is there.
    pub(super) fn tell(
        &mut self,
        older: usize,
        younger: usize,
        nodes: &Nodes,
        thickness: &[f64],
        absence: &Absence,
        stays: usize,
    ) {
        let words = |name: &str, other: &str, stays: &str| {
            format!(
                "the bed between {name} and {other} is absent, and the surface of {stays} stays,"
            )
        };
        let name = |at: usize| self.layers[at].name.as_str();
        let words = words(name(older), name(younger), name(stays));
        self.tell_extent(&words, nodes, thickness, absence);
    }

    pub(super) fn tell_of_base(&mut self, at: usize, change: &Change) {
        let words = format!(
            "what lies between the domain's base and {} is absent",
            self.layers[at].name
        );
        self.tell_extent(&words, &change.nodes, &change.thickness, &change.absence);
    }

    fn tell_extent(&mut self, words: &str, nodes: &Nodes, thickness: &[f64], absence: &Absence) {
        let [x, y] = [self.model.domain.x, self.model.domain.y];
        let plan = [0, 1].map(|i| DVec2::new(x[i], y[i]));
        let extent = absence.extent(nodes, thickness, plan);
        if !(extent.area > 0.0) {
            return;
        }
        self.decisions.push(format!(
            "{words} over {:.0} m² within x from {} to {}, y from {} to {}, where the data have a thickness of no more than \
             {:.2e} m, {:.3} m³ in all",
            extent.area,
            tidy(extent.low.x),
            tidy(extent.high.x),
            tidy(extent.low.y),
            tidy(extent.high.y),
            self.least,
            extent.volume
        ));
    }
}

/// To a centimetre, and without a negative zero.
fn tidy(coordinate: f64) -> f64 {
    (coordinate * 1e2).round() / 1e2 + 0.0
}
