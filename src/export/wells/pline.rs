//! GOCAD `PLine` (`.pl`): the paths of wells as lines in world coordinates, each a line of its own for every volume that it passes through.
//!
//! Vertices carry the measured depth and the volume's number (as in grids; −1 outside of the domain). Where a line ends the next one begins, so
//! places between volumes are there twice. How near lines are to the path: see [`super::gocad`], whose points these are.

use std::fmt::Write as _;

use super::gocad::{GocadWell, one_word, steps};

/// Of each well an object.
pub fn text(wells: &[GocadWell<'_>]) -> String {
    let mut out = String::new();
    for well in wells {
        write(well, &mut out);
    }
    out
}

fn write(own: &GocadWell<'_>, out: &mut String) {
    out.push_str("GOCAD PLine 1\nHEADER {\n");
    let _ = writeln!(out, "name:{}\n}}", one_word(&own.spec.name));
    out.push_str(super::gocad::COORDINATES);
    out.push_str("PROPERTIES MD VOLUME\nNO_DATA_VALUES -99999 -99999\nESIZES 1 1\nUNITS m none\n");
    let stations: Vec<f64> = own.spec.well.depths().collect();
    let mut vertex = 0;
    for one in &own.log.intervals {
        let [from, to] = one.md;
        let within = stations.iter().filter(|md| **md > from && **md < to);
        let mut depths = vec![from];
        depths.extend(within);
        depths.push(to);
        let volume = one.volume.map_or(-1, usize::cast_signed);
        let first = vertex + 1;
        out.push_str("ILINE\n");
        for md in steps(&depths) {
            vertex += 1;
            let _ = writeln!(out, "PVRTX {vertex} {} {md:.6} {volume}", own.place(md));
        }
        for at in first..vertex {
            let _ = writeln!(out, "SEG {at} {}", at + 1);
        }
    }
    out.push_str("END\n");
}
