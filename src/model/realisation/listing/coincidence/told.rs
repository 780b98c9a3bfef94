//! What was decided about horizons that coincide, in words.

use glam::DVec2;

use super::change::Change;
use super::deciding::Deciding;
use crate::features::between::thinner;
use crate::features::horizon::Horizon;
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

    /// Says where the bed between two layers is thinner between the nodes of a grid than it may be, though it is not at them.
    pub(super) fn tell_thinner(
        &mut self,
        older: usize,
        younger: usize,
        bed: &Horizon,
        nodes: &Nodes,
        absence: &Absence,
    ) {
        let Some(found) = thinner(bed, nodes, absence, self.least, self.plan()) else {
            return;
        };
        let name = |at: usize| self.layers[at].name.as_str();
        let does = if found.thickness <= 0.0 {
            "the two surfaces cross there"
        } else {
            "it is there all the same"
        };
        self.decisions.push(format!(
            "the bed between {} and {} is thicker than {:.2e} m at the nodes of its grid, and swings down to {:.2e} m between \
             them, in {} cell{} within x from {} to {}, y from {} to {}; {does}",
            name(older),
            name(younger),
            self.least,
            found.thickness,
            found.cells,
            if found.cells == 1 { "" } else { "s" },
            tidy(found.low.x),
            tidy(found.high.x),
            tidy(found.low.y),
            tidy(found.high.y),
        ));
    }

    /// The plan of the domain.
    fn plan(&self) -> [DVec2; 2] {
        let [x, y] = [self.model.domain.x, self.model.domain.y];
        [0, 1].map(|i| DVec2::new(x[i], y[i]))
    }

    fn tell_extent(&mut self, words: &str, nodes: &Nodes, thickness: &[f64], absence: &Absence) {
        let extent = absence.extent(nodes, thickness, self.plan());
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
