//! Everything about the tables that can be checked without evaluating a curve or a surface.
//!
//! The kernel would answer most of these defects with a shape that fails later, far from here.

use super::tables::{OnSurface, TableEdge, TableFace, Tables};
use crate::geometry::{
    Curve, Surface, check_curve, check_pcurve, check_surface, curve_domain, finite, index,
    pcurve_domain,
};

pub(super) fn check(tables: &Tables) -> Result<(), String> {
    each("vertex", &tables.vertices, |vertex| {
        finite("its coordinates", &vertex.point)?;
        tolerance(vertex.tolerance)
    })?;
    each("curve", &tables.curves, curve)?;
    each("surface", &tables.surfaces, check_surface)?;
    each("pcurve", &tables.pcurves, check_pcurve)?;
    each("edge", &tables.edges, |e| edge(tables, e))?;
    each("face", &tables.faces, |f| face(tables, f))?;
    solids(tables)?;
    users(tables)?;
    closed(tables)
}

/// Names the entry that fails.
fn each<T>(
    what: &str,
    entries: &[T],
    check: impl Fn(&T) -> Result<(), String>,
) -> Result<(), String> {
    entries
        .iter()
        .enumerate()
        .try_for_each(|(i, entry)| check(entry).map_err(|e| format!("{what} {i}: {e}")))
}

fn tolerance(value: f64) -> Result<(), String> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(format!(
            "its tolerance is {value}; it must be above 0, and 1e-7 is usual"
        ))
    }
}

fn curve(curve: &Curve) -> Result<(), String> {
    check_curve(curve)?;
    let point = match curve {
        Curve::Line { start, end } => (start == end).then_some(start),
        Curve::BSpline { poles, .. } => poles.iter().all(|p| *p == poles[0]).then(|| &poles[0]),
    };
    match point {
        Some(p) => Err(format!(
            "all of it is the point {p:?}; an edge without length takes no curve"
        )),
        None => Ok(()),
    }
}

fn edge(tables: &Tables, edge: &TableEdge) -> Result<(), String> {
    index("vertex", edge.start, tables.vertices.len())?;
    index("vertex", edge.end, tables.vertices.len())?;
    tolerance(edge.tolerance)?;
    let [first, last] = edge.range;
    if !(first < last && first.is_finite() && last.is_finite()) {
        return Err(format!(
            "its range is {first} to {last}; it must be finite and increase"
        ));
    }
    match edge.curve {
        Some(curve) => {
            index("curve", curve, tables.curves.len())?;
            let (low, high) = curve_domain(&tables.curves[curve]);
            if first < low || high < last {
                return Err(format!(
                    "its range is {first} to {last}; its curve {curve} runs over {low} to {high}"
                ));
            }
        }
        None if edge.start != edge.end => {
            return Err(format!(
                "it has no curve, so it is a point, but it runs from vertex {} to vertex {}",
                edge.start, edge.end
            ));
        }
        None if edge.on.is_empty() => {
            return Err("it has neither a curve nor a pcurve".to_owned());
        }
        None => (),
    }
    for (k, on) in edge.on.iter().enumerate() {
        on_surface(tables, edge, on)?;
        if edge.on[..k].iter().any(|o| o.surface == on.surface) {
            return Err(format!(
                "it lies twice on surface {}; a seam has both pcurves in one entry",
                on.surface
            ));
        }
    }
    Ok(())
}

fn on_surface(tables: &Tables, edge: &TableEdge, on: &OnSurface) -> Result<(), String> {
    index("surface", on.surface, tables.surfaces.len())?;
    if is_plane(tables, on.surface) {
        return Err(format!(
            "it has a pcurve on surface {}, which is a plane; planes take none",
            on.surface
        ));
    }
    if on.reversed == Some(on.forward) {
        return Err(format!(
            "it is a seam of surface {}, but both its pcurves are {}; without a seam, `reversed` is `None`",
            on.surface, on.forward
        ));
    }
    let [first, last] = edge.range;
    for pcurve in [Some(on.forward), on.reversed].into_iter().flatten() {
        index("pcurve", pcurve, tables.pcurves.len())?;
        if let Some((low, high)) = pcurve_domain(&tables.pcurves[pcurve])
            && (first < low || high < last)
        {
            return Err(format!(
                "its range is {first} to {last}; its pcurve {pcurve} runs over {low} to {high}"
            ));
        }
    }
    Ok(())
}

fn is_plane(tables: &Tables, surface: usize) -> bool {
    matches!(tables.surfaces[surface], Surface::Plane { .. })
}

fn face(tables: &Tables, face: &TableFace) -> Result<(), String> {
    index("surface", face.surface, tables.surfaces.len())?;
    tolerance(face.tolerance)?;
    if face.loops.is_empty() {
        return Err("it has no loop".to_owned());
    }
    each("loop", &face.loops, |uses| {
        if uses.is_empty() {
            return Err("it has no edge".to_owned());
        }
        for (edge, _) in uses {
            index("edge", *edge, tables.edges.len())?;
            lies_on(tables, *edge, face.surface)?;
        }
        let ends = |(edge, reversed): (usize, bool)| {
            let edge = &tables.edges[edge];
            if reversed {
                (edge.end, edge.start)
            } else {
                (edge.start, edge.end)
            }
        };
        for (i, this) in uses.iter().enumerate() {
            let next = uses[(i + 1) % uses.len()];
            let (end, start) = (ends(*this).1, ends(next).0);
            if end != start {
                return Err(format!(
                    "it is not closed: edge {} ends at vertex {end}, the next edge {} starts at vertex {start}",
                    this.0, next.0
                ));
            }
        }
        Ok(())
    })
}

/// An edge of a face has a pcurve on the face's surface, unless that is a plane.
fn lies_on(tables: &Tables, edge: usize, surface: usize) -> Result<(), String> {
    let of = &tables.edges[edge];
    if is_plane(tables, surface) {
        if of.curve.is_none() {
            return Err(format!(
                "edge {edge} is a point, which cannot be part of a loop on a plane"
            ));
        }
    } else if !of.on.iter().any(|o| o.surface == surface) {
        return Err(format!(
            "edge {edge} has no pcurve on the B-spline surface {surface}"
        ));
    }
    Ok(())
}

fn solids(tables: &Tables) -> Result<(), String> {
    if tables.solids.is_empty() {
        return Err("there are no solids".to_owned());
    }
    each("solid", &tables.solids, |solid| {
        if solid.shells.is_empty() {
            return Err("it has no shell".to_owned());
        }
        each("shell", &solid.shells, |shell| {
            if shell.is_empty() {
                return Err("it has no face".to_owned());
            }
            shell
                .iter()
                .try_for_each(|(face, _)| index("face", *face, tables.faces.len()))
        })
    })
}

/// A face has a solid on one side or one on each.
fn users(tables: &Tables) -> Result<(), String> {
    let mut users: Vec<[Option<usize>; 2]> = vec![[None; 2]; tables.faces.len()];
    for (s, solid) in tables.solids.iter().enumerate() {
        for (face, reversed) in solid.shells.iter().flatten() {
            let side = &mut users[*face][usize::from(*reversed)];
            if let Some(other) = side {
                let word = if *reversed {
                    "reversed"
                } else {
                    "not reversed"
                };
                return Err(format!(
                    "face {face} is used {word} by solid {other} and again by solid {s}; a face has two sides"
                ));
            }
            *side = Some(s);
        }
    }
    match users.iter().position(|sides| *sides == [None; 2]) {
        Some(face) => Err(format!("face {face} is used by no solid")),
        None => Ok(()),
    }
}

/// In a closed shell an edge is used once in each direction; a seam is used twice by one face, and an edge that is a point, once. The
/// kernel holds a shell that touches itself along an edge to be invalid.
fn closed(tables: &Tables) -> Result<(), String> {
    let mut counts = vec![[0_usize; 2]; tables.edges.len()];
    for (s, solid) in tables.solids.iter().enumerate() {
        for (h, shell) in solid.shells.iter().enumerate() {
            let uses = || {
                shell.iter().flat_map(|(face, turned)| {
                    let edges = tables.faces[*face].loops.iter().flatten();
                    edges.map(move |(edge, reversed)| (*edge, reversed != turned))
                })
            };
            for (edge, backward) in uses() {
                counts[edge][usize::from(backward)] += 1;
            }
            for (edge, _) in uses() {
                let [forward, backward] = counts[edge];
                if counts[edge] != [1, 1] && tables.edges[edge].curve.is_some() {
                    return Err(format!(
                        "shell {h} of solid {s} is not closed, or touches itself: it uses edge {edge} {forward} times forwards and {backward} times backwards, not once each"
                    ));
                }
            }
            for (edge, _) in uses() {
                counts[edge] = [0; 2];
            }
        }
    }
    Ok(())
}
