//! Whether finished topology is closed, by its tables alone: loops, solids, and edges on their surfaces.

use glam::DVec3;
use rayon::prelude::*;

use super::scene::Scene;
use super::spline;
use super::{Check, Prover};
use crate::nurbs::Surface;
use crate::nurbs::spline::Spline;
use crate::partition::{Edge, Topology};

/// Where in a span an edge is measured: at no place that its making prefers.
const PART: f64 = 0.414_213_562;
/// How far beyond a surface's parameters curves on it may go, as a share of their range: rounding.
const BEYOND: f64 = 1e-7;

impl Prover<'_> {
    /// Loops lead from vertex to vertex, and every solid is left along an edge as often as it is entered.
    pub(super) fn closure(&self, topology: &Topology) -> Check {
        let mut wrong = Vec::new();
        let place = |edge: &Edge| topology.vertices[edge.ends[0]].point;
        for (index, face) in topology.faces.iter().enumerate() {
            for own in &face.loops {
                let ends = |&(edge, backwards): &(usize, bool)| {
                    let [from, to] = topology.edges[edge].ends;
                    if backwards { [to, from] } else { [from, to] }
                };
                let after = own.iter().cycle().skip(1);
                let gap = own
                    .iter()
                    .zip(after)
                    .find(|(a, b)| ends(a)[1] != ends(b)[0]);
                if own.is_empty() {
                    wrong.push(format!(
                        "a loop of {} is empty",
                        self.volumes_of(topology, index)
                    ));
                }
                if let Some(((edge, _), _)) = gap {
                    let at = place(&topology.edges[*edge]);
                    wrong.push(format!(
                        "a loop of {} is open at {at:.4}",
                        self.volumes_of(topology, index)
                    ));
                }
            }
        }
        for solid in &topology.solids {
            let mut passes: Vec<(usize, i32)> = Vec::new();
            for &(face, reversed) in solid.shells.iter().flatten() {
                for &(edge, backwards) in topology.faces[face].loops.iter().flatten() {
                    passes.push((edge, if reversed == backwards { 1 } else { -1 }));
                }
            }
            passes.sort_unstable();
            for own in passes.chunk_by(|a, b| a.0 == b.0) {
                // Poles are points: nothing is left along them.
                let is_curve = topology.edges[own[0].0].curve.is_some();
                if is_curve && own.iter().map(|pass| pass.1).sum::<i32>() != 0 {
                    let at = place(&topology.edges[own[0].0]);
                    wrong.push(format!("{} is open at {at:.4}", self.name(solid.label)));
                }
            }
        }
        let count = wrong.len();
        wrong.truncate(5);
        Check {
            name: "edges at which loops or solids are open",
            measured: count as f64,
            bound: 0.0,
            detail: if wrong.is_empty() {
                format!("{} edges", topology.edges.len())
            } else {
                wrong.join(", ")
            },
        }
    }

    /// The first loop of a face is the outer one, and so is the first shell of a solid: readers take them so.
    pub(super) fn nesting(&self, scene: &Scene<'_>) -> Check {
        let topology = scene.topology;
        let mut wrong = Vec::new();
        let flux = |shell: &[(usize, bool)]| {
            let signed = |&(face, reversed): &(usize, bool)| {
                let flux = topology.faces[face].integral.flux;
                if reversed { -flux } else { flux }
            };
            shell.iter().map(signed).sum::<f64>()
        };
        for solid in &topology.solids {
            let mut shells = solid.shells.iter();
            let is_right = shells.next().is_some_and(|outer| flux(outer) > 0.0)
                && shells.all(|void| flux(void) < 0.0);
            if !is_right {
                wrong.push(format!("the shells of {}", self.name(solid.label)));
            }
        }
        for face in 0..topology.faces.len() {
            if !scene.is_in_order(face) {
                wrong.push(format!(
                    "the loops of a face of {}",
                    self.volumes_of(topology, face)
                ));
            }
        }
        Check {
            name: "loops and shells that are not outer ones with what lies in them",
            measured: wrong.len() as f64,
            bound: 0.0,
            detail: wrong.iter().take(5).cloned().collect::<Vec<_>>().join(", "),
        }
    }

    /// No edge is far from the surfaces of faces beside it and from its vertices: measured here, and what its maker says.
    pub(super) fn deviation(&self, topology: &Topology) -> Check {
        let mut beside = vec![Vec::new(); topology.edges.len()];
        for face in &topology.faces {
            for &(edge, backwards) in face.loops.iter().flatten() {
                let own: &mut Vec<(usize, bool)> = &mut beside[edge];
                if !own.contains(&(face.sheet, backwards)) {
                    own.push((face.sheet, backwards));
                }
            }
        }
        let farthest = (0..topology.edges.len())
            .into_par_iter()
            .map(|edge| (off(topology, edge, &beside[edge]), edge))
            .reduce(
                || (0.0, 0),
                |a, b| if b.0 > a.0 || b.0.is_nan() { b } else { a },
            );
        let said = topology.edges.iter().map(|edge| edge.deviation);
        let gaps = topology.vertices.iter().map(|vertex| vertex.gap);
        let said = said.chain(gaps).fold(0.0, f64::max);
        let at = topology
            .edges
            .get(farthest.1)
            .map_or(DVec3::ZERO, |edge| topology.vertices[edge.ends[0]].point);
        Check {
            name: "distance of edges from their surfaces and vertices (m)",
            measured: if farthest.0 > said || farthest.0.is_nan() {
                farthest.0
            } else {
                said
            },
            bound: 1e-9 * (self.plan.high() - self.plan.low()).length(),
            detail: format!("{} edges, farthest that from {at:.4}", topology.edges.len()),
        }
    }

    fn volumes_of(&self, topology: &Topology, face: usize) -> String {
        let names = topology.faces[face].labels.iter().flatten();
        names
            .map(|label| self.name(*label))
            .collect::<Vec<_>>()
            .join(" / ")
    }
}

/// Farthest of an edge from the surfaces of faces that run along it one way or the other, and from its vertices (m).
fn off(topology: &Topology, index: usize, beside: &[(usize, bool)]) -> f64 {
    let edge = &topology.edges[index];
    let Some(curve) = edge.curve else {
        return off_pole(topology, edge, beside);
    };
    let space = spline::of_space(&topology.curves[curve]);
    if !space.is_sound() {
        return f64::INFINITY;
    }
    let breaks = space.breaks(edge.range);
    let mut places = vec![edge.range[0], edge.range[1]];
    places.extend(
        breaks
            .windows(2)
            .map(|pair| pair[0] + PART * (pair[1] - pair[0])),
    );
    let points: Vec<DVec3> = places.iter().map(|t| space.point(*t)).collect();
    let mut farthest: f64 = 0.0;
    let mut note = |distance: f64| {
        farthest = if distance.is_nan() {
            f64::INFINITY
        } else {
            farthest.max(distance)
        };
    };
    for (point, end) in points.iter().zip(edge.ends) {
        note(point.distance(topology.vertices[end].point));
    }
    for &(at, backwards) in beside {
        let sheet = &topology.sheets[at];
        if let Some([origin, normal, _]) = sheet.plane {
            for point in &points {
                note(normal.dot(*point - origin).abs());
            }
            continue;
        }
        let Some(image) = image(topology, edge, at, backwards) else {
            return f64::INFINITY;
        };
        for (t, point) in places.iter().zip(&points) {
            note(on_surface(&sheet.surface, image.point(*t)).distance(*point));
        }
    }
    farthest
}

/// The same of an edge that is a pole: its ends are one point.
fn off_pole(topology: &Topology, edge: &Edge, beside: &[(usize, bool)]) -> f64 {
    let point = topology.vertices[edge.ends[0]].point;
    let mut farthest = point.distance(topology.vertices[edge.ends[1]].point);
    for &(at, backwards) in beside {
        let Some(image) = image(topology, edge, at, backwards) else {
            return f64::INFINITY;
        };
        for t in edge.range {
            let there = on_surface(&topology.sheets[at].surface, image.point(t));
            let apart = there.distance(point);
            farthest = if apart.is_nan() {
                f64::INFINITY
            } else {
                farthest.max(apart)
            };
        }
    }
    farthest
}

/// The point of a surface at parameters; nowhere if they are beyond its own by more than rounding.
fn on_surface(surface: &Surface, at: DVec3) -> DVec3 {
    let within = |x: f64, (low, high): (f64, f64)| {
        let slack = BEYOND * (high - low);
        low - slack <= x && x <= high + slack
    };
    if within(at.x, surface.knots_u().domain()) && within(at.y, surface.knots_v().domain()) {
        surface.point(at.x, at.y)
    } else {
        DVec3::INFINITY
    }
}

/// An edge's curve in the parameters of a surface, where a face runs along it one way or the other.
fn image<'a>(
    topology: &'a Topology,
    edge: &Edge,
    sheet: usize,
    backwards: bool,
) -> Option<Spline<'a>> {
    let on = edge.on.iter().find(|on| on.sheet == sheet)?;
    let image = match on.reversed {
        Some(image) if backwards => image,
        _ => on.forward,
    };
    let spline = spline::of_plane(&topology.plane_curves[image], edge.range);
    spline.is_sound().then_some(spline)
}
