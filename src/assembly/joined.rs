//! Closed shells of several sheets as the kernel's topology: a side that two sheets share is one edge, a side that is joined to
//! its own sheet a seam, and one that is a point a pole.

use glam::DVec3;

use super::kernel::{Edge, Face, Topology};
use super::splines::{EXACT, along_u, along_v, curve, spline};
use crate::features::shell::Shell;
use crate::nurbs::{Curve, KnotError, KnotVector, Surface, SurfaceError};

/// Sides that are the same to this fraction of the shell's size are one edge, as they are for the enclosure.
const SAME: f64 = 1e-9;
/// Places along a side at which it is compared with another one.
const COMPARED: [f64; 3] = [0.25, 0.5, 0.75];
/// How far beside a sheet it is asked which side of it is inside, as fractions of the shell's size.
const BESIDE: [f64; 3] = [1e-5, 1e-6, 1e-7];
/// Places of a sheet at which that is asked, along u and v.
const ASKED: [f64; 5] = [0.5, 0.31, 0.67, 0.13, 0.89];

/// Why a shell is no topology.
#[derive(Debug, PartialEq, thiserror::Error)]
pub(crate) enum JoinedError {
    /// Two sides are one edge, but are not run through alike.
    #[error("the sheets {0} and {1} of its shell share a side that they run through differently")]
    Direction(usize, usize),
    /// A sheet has no other knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A sheet with other knots is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// No place of a sheet tells which side of it is inside.
    #[error("neither side of the sheet {0} of its shell is certainly inside")]
    Flat(usize),
}

/// The topology of a closed shell.
pub(crate) fn shell(shell: &Shell) -> Result<Topology, JoinedError> {
    let (low, high) = shell.bounds();
    let size = high.distance(low);
    let mut joining = Joining {
        same: SAME * size,
        topology: Topology {
            vertices: Vec::new(),
            curves: Vec::new(),
            surfaces: Vec::new(),
            edges: Vec::new(),
            faces: Vec::new(),
            tolerance: EXACT,
        },
        sides: Vec::new(),
    };
    for (at, (_, sheet)) in shell.sheets().iter().enumerate() {
        let sheet = &from_0_to_1(sheet)?;
        let reversed = !is_outward(shell, sheet, size).ok_or(JoinedError::Flat(at))?;
        joining.add(at, sheet, reversed)?;
    }
    Ok(joining.topology)
}

/// The same sheet with parameters from 0 to 1: two sheets that share an edge may run through it over different ranges.
fn from_0_to_1(sheet: &Surface) -> Result<Surface, JoinedError> {
    let unit = |knots: &KnotVector| {
        let (first, last) = knots.domain();
        let scaled = knots
            .as_slice()
            .iter()
            .map(|knot| (knot - first) / (last - first));
        KnotVector::new(knots.degree(), scaled.collect())
    };
    let (u, v) = (unit(sheet.knots_u())?, unit(sheet.knots_v())?);
    let net = sheet.net().to_vec();
    Ok(if sheet.is_rational() {
        Surface::rational(u, v, net, sheet.weights().to_vec())?
    } else {
        Surface::new(u, v, net)?
    })
}

/// Whether a sheet's normal points out of the shell.
fn is_outward(shell: &Shell, sheet: &Surface, size: f64) -> Option<bool> {
    let within = |(from, to): (f64, f64), part: f64| from + (to - from) * part;
    BESIDE.iter().find_map(|beside| {
        ASKED
            .iter()
            .flat_map(|u| ASKED.map(|v| (*u, v)))
            .find_map(|(u, v)| {
                let (u, v) = (
                    within(sheet.knots_u().domain(), u),
                    within(sheet.knots_v().domain(), v),
                );
                let (at, step) = (sheet.point(u, v), sheet.normal(u, v)? * beside * size);
                let [behind, before] = [at - step, at + step].map(|beside| shell.contains(beside));
                (behind != before).then_some(behind)
            })
    })
}

/// A side that has its edge.
struct Known {
    sheet: usize,
    curve: Curve,
    edge: usize,
}

/// A topology while sheets are added.
struct Joining {
    same: f64,
    topology: Topology,
    sides: Vec<Known>,
}

impl Joining {
    fn add(&mut self, at: usize, sheet: &Surface, reversed: bool) -> Result<(), JoinedError> {
        let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
        let [start, end] = [v0, v1].map(|v| self.edge(at, sheet.isocurve_v(v)));
        let [left, right] = [u0, u1].map(|u| self.edge(at, sheet.isocurve_u(u)));
        let uses = vec![
            along_u(start?, v0, false),
            along_v(right?, u1, false),
            along_u(end?, v1, true),
            along_v(left?, u0, true),
        ];
        self.topology.faces.push(Face {
            surface: self.topology.surfaces.len(),
            reversed,
            loops: vec![uses],
        });
        self.topology.surfaces.push(spline(sheet));
        Ok(())
    }

    /// The edge of a side: a known one if it is the same. A pole is an edge of its own for each sheet.
    fn edge(&mut self, sheet: usize, side: Curve) -> Result<usize, JoinedError> {
        let (from, to) = side.domain();
        let place = |curve: &Curve, part: f64| {
            let (from, to) = curve.domain();
            curve.point(from + (to - from) * part)
        };
        let alike = |one: &Curve, flip: bool| {
            let of = |part: f64| if flip { 1.0 - part } else { part };
            [0.0, 1.0]
                .iter()
                .chain(&COMPARED)
                .all(|part| place(one, of(*part)).distance(place(&side, *part)) <= self.same)
        };
        let first = side.point(from);
        let is_pole = COMPARED
            .iter()
            .chain(&[1.0])
            .all(|part| place(&side, *part).distance(first) <= self.same);
        if !is_pole {
            for known in &self.sides {
                if alike(&known.curve, false) {
                    return Ok(known.edge);
                }
                if alike(&known.curve, true) {
                    return Err(JoinedError::Direction(known.sheet, sheet));
                }
            }
        }
        let [start, end] = [from, to].map(|at| self.vertex(side.point(at)));
        let edge = self.topology.edges.len();
        self.topology.edges.push(Edge {
            curve: self.topology.curves.len(),
            range: [from, to],
            start,
            end,
        });
        self.topology.curves.push(curve(&side));
        if !is_pole {
            self.sides.push(Known {
                sheet,
                curve: side,
                edge,
            });
        }
        Ok(edge)
    }

    fn vertex(&mut self, point: DVec3) -> usize {
        let vertices = &mut self.topology.vertices;
        let near = |known: &[f64; 3]| DVec3::from_array(*known).distance(point) <= self.same;
        vertices.iter().position(near).unwrap_or_else(|| {
            vertices.push(point.to_array());
            vertices.len() - 1
        })
    }
}

#[cfg(test)]
#[path = "joined_tests.rs"]
mod tests;
