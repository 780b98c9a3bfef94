//! GOCAD triangulated surfaces (`.ts`): one part a file, as one TFACE.
//!
//! The word `CNXYZ` after each vertex is what `xtgeo` asks for; GOCAD and others pass over it. Colours are left out, which it
//! refuses. Triangles are counter-clockwise seen from the side to which the surface's normal points.

use std::fmt::Write;

use glam::DVec3;

use super::part::{Part, Parts};
use super::vertical::Vertical;

/// Decimals of coordinates: a micrometre.
const DECIMALS: usize = 6;

/// The file of a part, with coordinates in the world.
pub fn text(parts: &Parts, part: &Part, vertical: Vertical) -> String {
    let positive = match vertical {
        Vertical::Elevation => "Elevation",
        Vertical::Depth => "Depth",
    };
    let mut out = format!(
        "GOCAD TSurf 1\nHEADER {{\nname:{}\n}}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n\
         AXIS_UNIT \"m\" \"m\" \"m\"\nZPOSITIVE {positive}\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n",
        part.name
    );
    let place = |point: &DVec3| {
        let at = *point + parts.origin;
        at.with_z(vertical.of(at.z))
    };
    for (at, point) in part.mesh.positions.iter().map(place).enumerate() {
        let (number, DVec3 { x, y, z }) = (at + 1, point);
        // A string takes whatever is written.
        let _ = writeln!(
            out,
            "VRTX {number} {x:.DECIMALS$} {y:.DECIMALS$} {z:.DECIMALS$} CNXYZ"
        );
    }
    for triangle in part.triangles() {
        let [a, b, c] = triangle.map(|point| u64::from(point) + 1);
        let _ = writeln!(out, "TRGL {a} {b} {c}");
    }
    out.push_str("END\n");
    out
}
