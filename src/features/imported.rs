//! Bodies from other programs: closed solids of trimmed faces, where a model places them.
//!
//! What a file holds is an [`Original`], about its own origin: faces as tables, and the same solid as the CAD kernel keeps it, which
//! only the general fuse reads. That its faces close is known by its edges: each is run along by two faces, once each way. That the
//! edges are where the surfaces have them is measured. An [`Imported`] is an original made larger, turned and moved; which points lie
//! in it is told by rays through its faces ([`Enclosure::trimmed`]), so no kernel is asked.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::trajectory::azimuth_vector;
use crate::mesh::{Path, Support, Tables, Use};
use crate::nurbs::enclosure::{Enclosure, EnclosureError};
use crate::nurbs::{
    Curve, CurveError, KnotError, KnotVector, Run, Surface, SurfaceError, TrimError, Trimmed,
};

/// Places on each edge at which its curve is compared with the surfaces of its faces.
const ON_EDGE: u32 = 16;
/// How many tolerances of the file they may be apart, …
const TOLERANCES: f64 = 4.0;
/// … and at least which share of the body's size: what splines that stand for other surfaces are off, and rounding.
const LEAST: f64 = 1e-9;
/// By which share of its extent a plane is continued beyond its loops.
const BEYOND: f64 = 1e-3;

/// A solid as a file has it, in metres.
#[derive(Debug, PartialEq)]
pub struct Original {
    tables: Tables,
    /// Whether each face looks against its surface's normal.
    reversed: Vec<bool>,
    /// How far edges may be from their surfaces and their ends (m).
    tolerance: f64,
    /// The solid as the kernel keeps it.
    kernel: Vec<u8>,
    volume: f64,
}

/// Why faces are no body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImportError {
    /// Tables that refer to what is not there.
    #[error("{0}")]
    Dangling(String),
    /// An edge is not run along once each way.
    #[error(
        "it is not closed: the edge near {place:.6} is run along {forward} times one way and {backward} times the other"
    )]
    Open {
        /// The middle of the edge.
        place: DVec3,
        /// How often faces run along it, one way …
        forward: usize,
        /// … and the other.
        backward: usize,
    },
    /// An edge lies beside a surface.
    #[error(
        "the edge near {place:.6} is {distance:.1e} m beside the surface of its face, more than {most:.1e} m: the faces leave a gap"
    )]
    Beside {
        /// Where.
        place: DVec3,
        /// How far (m).
        distance: f64,
        /// How far it may be (m).
        most: f64,
    },
    /// A face whose edges do not follow each other on its surface.
    #[error("face {face}: {source}")]
    Loop {
        /// The face, counted from 1.
        face: usize,
        /// Why.
        source: TrimError,
    },
    /// A face without a curve for one of its edges.
    #[error("face {face} has an edge without a curve on its surface")]
    NoCurve {
        /// The face, counted from 1.
        face: usize,
    },
    /// A spline that is none.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// A surface that is none.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// Knots that are none.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// The faces hold nothing.
    #[error(transparent)]
    Enclosure(#[from] EnclosureError),
}

/// How an original comes to lie in a model: made larger about its own origin, turned about its z axis, moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// How many times as large.
    pub scale: f64,
    /// Direction of its y axis, clockwise from north (rad).
    pub azimuth: f64,
    /// Where its origin comes to lie.
    pub at: DVec3,
}

impl Placement {
    /// As it is.
    pub const NONE: Self = Self {
        scale: 1.0,
        azimuth: 0.0,
        at: DVec3::ZERO,
    };

    /// Where a direction points to then.
    fn turned(&self, d: DVec3) -> DVec3 {
        let north = azimuth_vector(self.azimuth);
        let east = -north.perp();
        (d.x * east + d.y * north).extend(d.z)
    }

    /// Where a point comes to lie.
    pub fn place(&self, p: DVec3) -> DVec3 {
        self.at + self.turned(self.scale * p)
    }
}

impl Original {
    /// Faces that close, each with whether it looks against its surface's normal. `kernel` is the same solid for the general fuse.
    pub fn new(
        tables: Tables,
        uses: &[(usize, bool)],
        tolerance: f64,
        (kernel, volume): (Vec<u8>, f64),
    ) -> Result<Self, ImportError> {
        if let Some(what) = tables.dangling() {
            return Err(ImportError::Dangling(what));
        }
        let mut reversed = vec![false; tables.faces.len()];
        for (face, against) in uses {
            reversed[*face] = *against;
        }
        let original = Self {
            tables,
            reversed,
            tolerance,
            kernel,
            volume,
        };
        original.closes()?;
        original.fits()?;
        // Whatever else may be wrong shows now, and not where it is placed.
        original.placed(&Placement::NONE)?;
        Ok(original)
    }

    /// Its volume (m³), by the kernel's integral.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// How many faces it has.
    pub fn faces(&self) -> usize {
        self.tables.faces.len()
    }

    /// Its faces, each with whether it looks against its surface's normal.
    pub fn uses(&self) -> impl Iterator<Item = (usize, bool)> {
        self.reversed.iter().copied().enumerate()
    }

    /// How far its edges may be from their surfaces (m).
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The solid as the CAD kernel keeps it.
    pub fn kernel(&self) -> &[u8] {
        &self.kernel
    }

    /// Each edge is run along twice, once each way.
    fn closes(&self) -> Result<(), ImportError> {
        let mut counts = vec![[0; 2]; self.tables.edges.len()];
        for (face, reversed) in self.tables.faces.iter().zip(&self.reversed) {
            for own in face.loops.iter().flatten() {
                counts[own.edge][usize::from(own.reversed != *reversed)] += 1;
            }
        }
        for (edge, [forward, backward]) in self.tables.edges.iter().zip(counts) {
            let Some(curve) = edge.curve else { continue };
            if [forward, backward] != [1, 1] {
                let [from, to] = edge.range;
                return Err(ImportError::Open {
                    place: self.tables.curves[curve].point(0.5 * (from + to)),
                    forward,
                    backward,
                });
            }
        }
        Ok(())
    }

    /// Edges are where the surfaces of their faces have them.
    fn fits(&self) -> Result<(), ImportError> {
        let points = self.tables.vertices.iter();
        let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
            (low.min(*p), high.max(*p))
        });
        let most = (TOLERANCES * self.tolerance).max(LEAST * low.distance(high));
        for (at, face) in self.tables.faces.iter().enumerate() {
            let support = &self.tables.surfaces[face.surface];
            for own in face.loops.iter().flatten() {
                let edge = &self.tables.edges[own.edge];
                let Some(curve) = edge.curve else { continue };
                let [from, to] = edge.range;
                for k in 0..=ON_EDGE {
                    let t = from + (to - from) * f64::from(k) / f64::from(ON_EDGE);
                    let place = self.tables.curves[curve].point(t);
                    let on = match (support, own.pcurve) {
                        (Support::Plane { .. }, _) => support.point(flat(support, place)),
                        (Support::Spline(_), Some(pcurve)) => {
                            support.point(self.tables.pcurves[pcurve].point(t).xy())
                        }
                        (Support::Spline(_), None) => {
                            return Err(ImportError::NoCurve { face: at + 1 });
                        }
                    };
                    let distance = on.distance(place);
                    if !(distance <= most) {
                        return Err(ImportError::Beside {
                            place,
                            distance,
                            most,
                        });
                    }
                }
            }
        }
        Ok(())
    }

    /// The tables of the original where a placement has it.
    fn placed(&self, placement: &Placement) -> Result<(Tables, Enclosure), ImportError> {
        let place = |p: DVec3| placement.place(p);
        let mut tables = self.tables.clone();
        tables.vertices.iter_mut().for_each(|p| *p = place(*p));
        for curve in &mut tables.curves {
            *curve = match &*curve {
                Path::Line { origin, direction } => Path::Line {
                    origin: place(*origin),
                    direction: placement.turned(placement.scale * *direction),
                },
                Path::Spline(curve) => Path::Spline(mapped(curve, place)?),
            };
        }
        for surface in &mut tables.surfaces {
            *surface = match &*surface {
                Support::Plane {
                    origin,
                    x_axis,
                    y_axis,
                } => Support::Plane {
                    origin: place(*origin),
                    x_axis: placement.turned(*x_axis),
                    y_axis: placement.turned(*y_axis),
                },
                Support::Spline(surface) => Support::Spline(surface.mapped(|p| place(*p))?),
            };
        }
        let faces = (0..tables.faces.len()).map(|face| trimmed(&tables, face));
        let faces = faces.collect::<Result<Vec<_>, _>>()?;
        // Neighbours may each be off by a tolerance.
        let tolerance = (2.0 * self.tolerance * placement.scale).max(f64::MIN_POSITIVE);
        let inside = Enclosure::trimmed(&faces, tolerance)?;
        Ok((tables, inside))
    }
}

/// A solid of another program where a model has it.
#[derive(Clone, Debug)]
pub struct Imported {
    original: Arc<Original>,
    placement: Placement,
    tables: Arc<Tables>,
    inside: Arc<Enclosure>,
}

impl Imported {
    /// An original where a placement has it.
    pub fn new(original: &Arc<Original>, placement: Placement) -> Result<Self, ImportError> {
        let (tables, inside) = original.placed(&placement)?;
        Ok(Self {
            original: Arc::clone(original),
            placement,
            tables: Arc::new(tables),
            inside: Arc::new(inside),
        })
    }

    /// What it was made of.
    pub fn original(&self) -> &Arc<Original> {
        &self.original
    }

    /// Where it lies.
    pub fn placement(&self) -> Placement {
        self.placement
    }

    /// Its faces.
    pub fn tables(&self) -> &Tables {
        &self.tables
    }

    /// What it holds.
    pub fn inside(&self) -> &Arc<Enclosure> {
        &self.inside
    }

    /// The surfaces of its faces, each as far as the face's loops reach in u and in v.
    pub fn surfaces(&self) -> &[Surface] {
        self.inside.surfaces()
    }

    /// Corners of a box that holds it.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.inside.bounds()
    }

    /// The same, moved.
    pub fn moved(&self, by: DVec3) -> Result<Self, ImportError> {
        let at = self.placement.at + by;
        let placement = Placement {
            at,
            ..self.placement
        };
        Self::new(&self.original, placement)
    }
}

impl PartialEq for Imported {
    /// Two are the same if they are one original at one place.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.original, &other.original) && self.placement == other.placement
    }
}

fn mapped(curve: &Curve, map: impl Fn(DVec3) -> DVec3) -> Result<Curve, CurveError> {
    let points = curve.points().iter().map(|p| map(*p)).collect();
    let knots = curve.knots().clone();
    if curve.is_rational() {
        Curve::rational(knots, points, curve.weights().to_vec())
    } else {
        Curve::new(knots, points)
    }
}

/// The place of a point in the coordinates of a plane; none of a spline is asked for.
fn flat(support: &Support, point: DVec3) -> DVec2 {
    match support {
        Support::Plane {
            origin,
            x_axis,
            y_axis,
        } => {
            let from = point - *origin;
            DVec2::new(from.dot(*x_axis), from.dot(*y_axis))
        }
        Support::Spline(_) => DVec2::ZERO,
    }
}

fn segment([from, to]: [f64; 2], ends: [DVec3; 2]) -> Result<Curve, ImportError> {
    let knots = KnotVector::new(1, vec![from, from, to, to])?;
    Ok(Curve::new(knots, ends.to_vec())?)
}

/// A face as a trimmed surface.
fn trimmed(tables: &Tables, face: usize) -> Result<Trimmed, ImportError> {
    let own = &tables.faces[face];
    let support = &tables.surfaces[own.surface];
    let wrong = |source| ImportError::Loop {
        face: face + 1,
        source,
    };
    let mut loops = Vec::with_capacity(own.loops.len());
    for uses in &own.loops {
        let runs = uses.iter().map(|of| run(tables, face, of));
        let mut runs = runs.collect::<Result<Vec<_>, _>>()?;
        // An edge that is a point is a line in the surface's parameters, between its neighbours' ends.
        let known: Vec<usize> = (0..runs.len()).filter(|at| runs[*at].is_some()).collect();
        for at in 0..runs.len() {
            if runs[at].is_some() {
                continue;
            }
            let before = known.iter().rev().find(|one| **one < at).or(known.last());
            let after = known.iter().find(|one| **one > at).or(known.first());
            let end = |one: Option<&usize>, last: bool| {
                let run = runs[*one?].as_ref()?;
                Some(run.ends()[usize::from(last)])
            };
            let ends = end(before, true).zip(end(after, false));
            let (from, to) = ends.ok_or(ImportError::NoCurve { face: face + 1 })?;
            runs[at] = Some(Run::of(segment(
                [0.0, 1.0],
                [from, to].map(|p| p.extend(0.0)),
            )?));
        }
        loops.push(runs.into_iter().flatten().collect::<Vec<_>>());
    }
    match support {
        Support::Spline(surface) => Trimmed::new(surface.clone(), &loops).map_err(wrong),
        Support::Plane {
            origin,
            x_axis,
            y_axis,
        } => {
            let (low, high) = Trimmed::bounds(&loops).map_err(wrong)?;
            let more = BEYOND * (high - low).max_element();
            let (low, high) = (low - more, high + more);
            let knots = |from: f64, to: f64| KnotVector::new(1, vec![from, from, to, to]);
            let corner = |u: f64, v: f64| *origin + u * *x_axis + v * *y_axis;
            let net = vec![
                corner(low.x, low.y),
                corner(low.x, high.y),
                corner(high.x, low.y),
                corner(high.x, high.y),
            ];
            let (u, v) = (knots(low.x, high.x)?, knots(low.y, high.y)?);
            Trimmed::new(Surface::new(u, v, net)?, &loops).map_err(wrong)
        }
    }
}

/// An edge as a face's loop runs along it, in the parameters of the face's surface; none of an edge that is a point.
fn run(tables: &Tables, face: usize, of: &Use) -> Result<Option<Run>, ImportError> {
    let edge = &tables.edges[of.edge];
    let support = &tables.surfaces[tables.faces[face].surface];
    let path = match (support, edge.curve, of.pcurve) {
        (_, None, None) | (Support::Plane { .. }, None, Some(_)) => return Ok(None),
        (Support::Spline(_), _, Some(pcurve)) => tables.pcurves[pcurve].clone(),
        (Support::Spline(_), Some(_), None) => {
            return Err(ImportError::NoCurve { face: face + 1 });
        }
        (Support::Plane { .. }, Some(curve), _) => {
            let flat = |p: DVec3| flat(support, p).extend(0.0);
            match &tables.curves[curve] {
                Path::Line { .. } => {
                    let ends = edge.range.map(|t| flat(tables.curves[curve].point(t)));
                    Path::Spline(segment(edge.range, ends)?)
                }
                Path::Spline(curve) => Path::Spline(mapped(curve, flat)?),
            }
        }
    };
    let curve = match path {
        Path::Line { .. } => {
            let ends = edge.range.map(|t| path.point(t));
            segment(edge.range, ends)?
        }
        Path::Spline(curve) => curve,
    };
    Ok(Some(Run {
        curve,
        range: edge.range,
        backwards: of.reversed,
    }))
}

#[cfg(test)]
#[path = "imported_tests.rs"]
mod tests;
