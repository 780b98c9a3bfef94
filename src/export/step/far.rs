//! Models far from the origin, as in world coordinates: what their files need so that readers take them.
//!
//! Readers count in millimetres and take two points to be one within 1e-7 of these, whatever accuracy a file states. At UTM
//! coordinates (6e9 mm) neighbouring numbers are ten times as far apart: `OpenCASCADE`, and with it FreeCAD, Gmsh and others,
//! evaluates the end of an edge's curve in two ways, gets two numbers, and drops the solid. So, where coordinates along an
//! axis are large,
//!
//! - they are multiples of one power of two, with so many bits below it that a product with 1000 and the differences of
//!   neighbouring control points are exact: what is equal stays equal, and both ways give the same number;
//! - the curve of an edge begins and ends at the edge's vertices: in the middle of a longer curve no number is exact;
//! - such curves are polynomial: a quotient is not exact either.
//!
//! UTM coordinates move by less than a tenth of a micrometre; the file states how exact its points are. Models near the origin
//! are written as they are.

mod polynomial;

use glam::DVec3;

use crate::assembly::kernel::{Boundary, BoundaryEdge, Path, Surface};
use crate::assembly::splines::EXACT;
use crate::nurbs::{Curve, KnotVector};

/// Coordinates up to this one (m) are near: there, neighbouring numbers of millimetres are closer by a factor of ten than
/// points that are one.
const NEAR: f64 = 65_536.0;
/// Bits that the largest coordinate has below the step: 1000 = 125 · 8 has seven.
const SPARE: u32 = 7;

/// Makes the geometry of a model fit to be read, if it is far from the origin. Returns how exact its points are (m), for a model
/// whose edges are as far as `tolerance` from where they belong.
pub(super) fn settle(boundary: &mut Boundary, tolerance: f64) -> f64 {
    let Some(lattice) = Lattice::of(boundary) else {
        return EXACT;
    };
    let accuracy = EXACT.max(2.0 * (tolerance + lattice.reach()));
    for vertex in &mut boundary.vertices {
        lattice.settle(vertex);
    }
    for surface in &mut boundary.surfaces {
        match surface {
            Surface::Plane { origin, .. } => lattice.settle(origin),
            Surface::BSpline { poles, .. } => {
                for pole in poles {
                    lattice.settle(pole);
                }
            }
        }
    }
    let mut curves = Vec::with_capacity(boundary.edges.len());
    for edge in &mut boundary.edges {
        let Some(curve) = edge.curve else { continue };
        let ends = [edge.start, edge.end].map(|vertex| boundary.vertices[vertex]);
        let own = lattice.piece(&boundary.curves[curve], edge, ends, accuracy);
        edge.curve = Some(curves.len());
        curves.push(own);
    }
    boundary.curves = curves;
    accuracy
}

/// The places that coordinates are moved to, by axis: multiples of a power of two (m), or all where coordinates are small.
struct Lattice([Option<f64>; 3]);

impl Lattice {
    /// None if the model is near the origin.
    fn of(boundary: &Boundary) -> Option<Self> {
        let mut largest = [0.0_f64; 3];
        let mut see = |point: &[f64; 3]| {
            for (largest, coordinate) in largest.iter_mut().zip(point) {
                *largest = largest.max(coordinate.abs());
            }
        };
        boundary.vertices.iter().for_each(&mut see);
        for surface in &boundary.surfaces {
            if let Surface::BSpline { poles, .. } = surface {
                poles.iter().for_each(&mut see);
            }
        }
        let steps = largest.map(|largest| (largest >= NEAR).then(|| step(largest)));
        steps.iter().any(Option::is_some).then_some(Self(steps))
    }

    /// How far a point may be moved (m).
    fn reach(&self) -> f64 {
        let halves = self.0.map(|step| step.unwrap_or(0.0) / 2.0);
        DVec3::from_array(halves).length()
    }

    fn settle(&self, point: &mut [f64; 3]) {
        for (coordinate, step) in point.iter_mut().zip(self.0) {
            if let Some(step) = step {
                // Without a negative zero.
                *coordinate = (*coordinate / step).round() * step + 0.0;
            }
        }
    }

    /// What an edge is of its curve, between its vertices where that is less than `reach` away.
    fn piece(
        &self,
        curve: &Path<3>,
        edge: &BoundaryEdge,
        ends: [[f64; 3]; 2],
        reach: f64,
    ) -> Path<3> {
        let own = between(curve, edge.range).map(|own| {
            if own.is_rational() {
                polynomial::polynomial(&own, self.reach())
            } else {
                own
            }
        });
        let mut own = own.as_ref().map_or_else(|| curve.clone(), path);
        match &mut own {
            Path::Line { origin, .. } => self.settle(origin),
            Path::BSpline { poles, .. } => {
                for pole in &mut *poles {
                    self.settle(pole);
                }
                let last = poles.len() - 1;
                for (at, end) in [0, last].into_iter().zip(ends) {
                    let gap = DVec3::from_array(poles[at]).distance(DVec3::from_array(end));
                    if gap <= reach {
                        poles[at] = end;
                    }
                }
            }
        }
        own
    }
}

/// The power of two that is so many bits above the last one of a number.
fn step(largest: f64) -> f64 {
    largest.log2().floor().exp2() * f64::EPSILON * f64::from(1_u32 << SPARE)
}

/// A spline between two parameters; none if it is a line, or what our own splines cannot be.
fn between(curve: &Path<3>, range: [f64; 2]) -> Option<Curve> {
    let Path::BSpline {
        degree,
        knots,
        poles,
        weights,
    } = curve
    else {
        return None;
    };
    let vector = KnotVector::new(*degree, knots.clone()).ok()?;
    let points: Vec<DVec3> = poles.iter().copied().map(DVec3::from_array).collect();
    let weights = weights.clone().unwrap_or_else(|| vec![1.0; points.len()]);
    let mut own = Curve::rational(vector, points, weights).ok()?;
    // What is not strictly inside is an end already.
    if let Ok((_, after)) = own.split(range[0]) {
        own = after;
    }
    if let Ok((before, _)) = own.split(range[1]) {
        own = before;
    }
    Some(own)
}

/// A spline as the kernel spells it.
pub(super) fn path(curve: &Curve) -> Path<3> {
    Path::BSpline {
        degree: curve.degree(),
        knots: curve.knots().as_slice().to_vec(),
        poles: curve.points().iter().map(DVec3::to_array).collect(),
        weights: curve.is_rational().then(|| curve.weights().to_vec()),
    }
}
