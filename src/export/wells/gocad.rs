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
        let (first, last) = well.range();
        let origin = DVec3::from_array(self.model.origin);
        let place = |md: f64| {
            let p = well.point(md) + origin;
            format!("{:.6} {:.6} {:.6}", p.x, p.y, p.z)
        };
        let mut depths: Vec<f64> = well.depths().collect();
        depths.extend(self.log.crossings.iter().map(|one| one.md));
        depths.sort_by(f64::total_cmp);
        depths.dedup();
        let mut out = String::from("GOCAD Well 1\nHEADER {\n");
        let _ = writeln!(out, "name:{}\n}}", one_word(&self.spec.name));
        out.push_str("GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"m\" \"m\" \"m\"\n");
        out.push_str("ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\n");
        let _ = writeln!(out, "WREF {}", place(first));
        let _ = writeln!(out, "VRTX {}", place(first));
        for pair in depths.windows(2) {
            let mut from = pair[0];
            while pair[1] - from > STEP {
                from += STEP;
                let _ = writeln!(out, "VRTX {}", place(from));
            }
            let _ = writeln!(out, "VRTX {}", place(pair[1].min(last)));
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
}

/// A name without blanks, which would end it.
fn one_word(name: &str) -> String {
    deunicode::deunicode(name)
        .chars()
        .map(|c| if c.is_ascii_graphic() { c } else { '_' })
        .collect()
}
