//! GOCAD Well (`.wl`): the path as a polygon in world coordinates, with a marker where it goes from one volume to another.
//!
//! Points are absolute, after the reference `WREF`; of a `PATH`, offsets in plan are read in two ways. Stations and markers are points of
//! the polygon, and no two of its points are more than [`STEP`] apart along the hole: of a turn by 10° in 30 m it misses the path by 3 mm.

use std::fmt::Write as _;

use glam::DVec3;

use crate::model::Model;
use crate::model::realisation::Realisation;
use crate::model::wells::log::WellLog;
use crate::model::wells::spec::WellSpec;

/// The longest step along the hole (m).
pub const STEP: f64 = 2.0;

/// Coordinates are metres, and z points up.
pub(super) const COORDINATES: &str = "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"m\" \"m\" \"m\"\n\
    ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\n";

/// A well as a file.
pub struct GocadWell<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its realisation.
    pub realisation: &'a Realisation,
    /// The well.
    pub spec: &'a WellSpec,
    /// What it passes through.
    pub log: &'a WellLog,
}

impl GocadWell<'_> {
    /// The file.
    pub fn text(&self) -> String {
        let well = &self.spec.well;
        let first = self.place(well.range().0);
        let mut depths: Vec<f64> = well.depths().collect();
        depths.extend(self.log.crossings.iter().map(|one| one.md));
        depths.sort_by(f64::total_cmp);
        depths.dedup();
        let mut out = String::from("GOCAD Well 1\nHEADER {\n");
        let _ = writeln!(out, "name:{}\n}}", one_word(&self.spec.name));
        out.push_str(COORDINATES);
        let _ = writeln!(out, "WREF {first}");
        for md in steps(&depths) {
            let _ = writeln!(out, "VRTX {}", self.place(md));
        }
        for one in &self.log.crossings {
            let name = one.to.map_or("outside", |volume| {
                self.realisation.volumes[volume].name.as_str()
            });
            let _ = writeln!(out, "MRKR {} 0 {:.6}", one_word(name), one.md);
        }
        out.push_str("END\n");
        out
    }

    /// The place at a measured depth, in the world.
    pub(super) fn place(&self, md: f64) -> String {
        let p = self.spec.well.point(md) + DVec3::from_array(self.model.origin);
        format!("{:.6} {:.6} {:.6}", p.x, p.y, p.z)
    }
}

/// These depths, and more between them, so that no two are more than a step apart.
pub(super) fn steps(depths: &[f64]) -> Vec<f64> {
    let mut all: Vec<f64> = depths.iter().take(1).copied().collect();
    for pair in depths.windows(2) {
        let mut from = pair[0];
        while pair[1] - from > STEP {
            from += STEP;
            all.push(from);
        }
        all.push(pair[1]);
    }
    all
}

/// A name without blanks, which would end it.
pub(super) fn one_word(name: &str) -> String {
    deunicode::deunicode(name)
        .chars()
        .map(|c| if c.is_ascii_graphic() { c } else { '_' })
        .collect()
}
