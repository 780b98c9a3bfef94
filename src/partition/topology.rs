//! Finished topology as plain tables that refer to each other by index.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::Label;
use super::faces::{Face as TracedFace, encloses};
use super::hermite::PARTS;
use super::quadrature::Integral;
use super::sheet::Sheet;
use super::solids::{Parts, Solid as JoinedSolid};
use super::tracks::Source;
use crate::nurbs::{Curve, Surface};

/// Vertices, edges, faces and solids.
#[derive(Clone, Debug, Default)]
pub struct Topology {
    /// Vertices.
    pub vertices: Vec<Vertex>,
    /// Curves that edges run along.
    pub curves: Vec<CurveShape>,
    /// Curves in the parameters of surfaces.
    pub plane_curves: Vec<PlaneCurve>,
    /// Edges.
    pub edges: Vec<Edge>,
    /// Surfaces that faces lie on.
    pub sheets: Vec<SheetShape>,
    /// Faces.
    pub faces: Vec<Face>,
    /// Solids, in order of their first faces.
    pub solids: Vec<Solid>,
}

/// A point where edges end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is (m).
    pub point: DVec3,
    /// Farthest of its edges' ends (m).
    pub gap: f64,
}

/// A curve in space.
#[derive(Clone, Debug)]
pub enum CurveShape {
    /// A side that two sheets have in common.
    Known(Curve),
    /// A computed curve of degree 5.
    Computed {
        /// Flat knots.
        knots: Vec<f64>,
        /// Control points.
        points: Vec<DVec3>,
    },
}

/// A curve in the parameters of a surface.
#[derive(Clone, Debug)]
pub enum PlaneCurve {
    /// `origin + t direction`.
    Line {
        /// At t = 0.
        origin: DVec2,
        /// Per unit of t.
        direction: DVec2,
    },
    /// A computed curve of degree 5.
    Computed {
        /// Flat knots.
        knots: Vec<f64>,
        /// Control points.
        points: Vec<DVec2>,
    },
}

/// A piece of a curve between two vertices.
#[derive(Clone, Debug)]
pub struct Edge {
    /// Its curve; `None` if it is the pole of a surface.
    pub curve: Option<usize>,
    /// The parameters of its ends, on the curve and on all plane curves.
    pub range: [f64; 2],
    /// First and last vertex.
    pub ends: [usize; 2],
    /// Farthest of the curve from its surfaces, measured (m).
    pub deviation: f64,
    /// Where it runs on surfaces that are not planes.
    pub on: Vec<OnSheet>,
}

/// An edge on a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OnSheet {
    /// The surface.
    pub sheet: usize,
    /// Its plane curve where a face runs along it forwards, or the only one.
    pub forward: usize,
    /// The plane curve for the other direction, if the edge is a seam.
    pub reversed: Option<usize>,
}

/// A surface, as simple as it is.
#[derive(Clone, Debug)]
pub struct SheetShape {
    /// The region that it bounds.
    pub region: usize,
    /// Its place among the region's surfaces.
    pub place: usize,
    /// Whether `S_u × S_v` points out of the region.
    pub looks_out: bool,
    /// The surface itself.
    pub surface: Surface,
    /// A point, the normal and the direction of u, if it is flat.
    pub plane: Option<[DVec3; 3]>,
}

/// A face: a trimmed piece of a surface.
#[derive(Clone, Debug)]
pub struct Face {
    /// Its surface.
    pub sheet: usize,
    /// The outer loop, then holes; edges with whether they are run through backwards.
    pub loops: Vec<Vec<(usize, bool)>>,
    /// What holds the places behind and in front of it, seen along `S_u × S_v`.
    pub labels: [Label; 2],
    /// Area and flux.
    pub integral: Integral,
    /// Points of it.
    pub samples: Vec<FaceSample>,
}

/// A point inside a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceSample {
    /// The point (m).
    pub point: DVec3,
    /// The unit normal along `S_u × S_v`.
    pub normal: DVec3,
}

/// A connected piece of a volume.
#[derive(Clone, Debug)]
pub struct Solid {
    /// The volume.
    pub label: usize,
    /// The outer shell, then voids; faces with whether the solid's outward normal is against the surface's.
    pub shells: Vec<Vec<(usize, bool)>>,
    /// Its size (m³).
    pub size: f64,
    /// A box that holds its edges (m).
    pub bounds: (DVec3, DVec3),
}

/// Surfaces flatter than this fraction of their size are planes.
const FLAT: f64 = 1e-10;

impl Topology {
    pub(super) fn new(parts: &Parts<'_>, solids: Vec<JoinedSolid>) -> Self {
        let mut builder = Builder {
            parts,
            topology: Self::default(),
            sheets: vec![None; parts.geometry.regions.sheets.len()],
            curves: vec![None; parts.tracks.tracks.len()],
            images: vec![[None; 2]; parts.tracks.tracks.len()],
            vertices: vec![None; parts.tracks.points.len()],
            edges: vec![None; parts.arcs.len()],
        };
        for (face, integral) in parts.faces.iter().zip(parts.integrals) {
            builder.face(face, *integral);
        }
        builder.edges();
        let samples: Vec<Vec<FaceSample>> = parts
            .faces
            .par_iter()
            .map(|face| samples(&parts.geometry.regions.sheets[face.sheet], face))
            .collect();
        let mut topology = builder.topology;
        for (face, samples) in topology.faces.iter_mut().zip(samples) {
            face.samples = samples;
        }
        topology.solids = solids
            .into_iter()
            .map(|solid| {
                let bounds = topology.bounds(parts, &solid);
                Solid { label: solid.label, shells: solid.shells, size: solid.volume, bounds }
            })
            .collect();
        topology
    }

    /// The box of a solid's faces, by points of their loops and, where a face is curved, of its inside.
    fn bounds(&self, parts: &Parts<'_>, solid: &JoinedSolid) -> (DVec3, DVec3) {
        let mut bounds = super::bounds::Bounds::EMPTY;
        for (face, _) in &solid.shells[0] {
            let own = &parts.faces[*face];
            let sheet = &parts.geometry.regions.sheets[own.sheet];
            for place in own.polygons.iter().flatten() {
                bounds = bounds.with(sheet.point(place.x, place.y));
            }
            for sample in &self.faces[*face].samples {
                bounds = bounds.with(sample.point);
            }
        }
        (bounds.low, bounds.high)
    }
}

struct Builder<'a> {
    parts: &'a Parts<'a>,
    topology: Topology,
    sheets: Vec<Option<usize>>,
    curves: Vec<Option<usize>>,
    images: Vec<[Option<usize>; 2]>,
    vertices: Vec<Option<usize>>,
    edges: Vec<Option<usize>>,
}

impl Builder<'_> {
    fn sheet(&mut self, at: usize) -> usize {
        if let Some(known) = self.sheets[at] {
            return known;
        }
        let all = &self.parts.geometry.regions.sheets;
        let sheet = &all[at];
        let first = all.iter().position(|other| other.region == sheet.region).unwrap_or(at);
        self.topology.sheets.push(SheetShape {
            region: sheet.region,
            place: at - first,
            looks_out: sheet.outward > 0.0,
            surface: sheet.surface.clone(),
            plane: plane(sheet),
        });
        let made = self.topology.sheets.len() - 1;
        self.sheets[at] = Some(made);
        made
    }

    fn vertex(&mut self, at: usize) -> usize {
        if let Some(known) = self.vertices[at] {
            return known;
        }
        let point = self.parts.tracks.points[at];
        self.topology.vertices.push(Vertex { point, gap: 0.0 });
        let made = self.topology.vertices.len() - 1;
        self.vertices[at] = Some(made);
        made
    }

    fn face(&mut self, face: &TracedFace, integral: Integral) {
        let sheet = self.sheet(face.sheet);
        let is_plane = self.topology.sheets[sheet].plane.is_some();
        let looks_out = self.topology.sheets[sheet].looks_out;
        let mut loops = Vec::with_capacity(face.loops.len());
        for own in &face.loops {
            let mut uses = Vec::with_capacity(own.len());
            for half in own {
                let arc = &self.parts.arcs[half.arc];
                let is_pole = matches!(self.parts.tracks.tracks[arc.track].source, Source::Pole(_));
                if is_pole && is_plane {
                    continue;
                }
                uses.push((self.edge(half.arc), !half.forward));
            }
            loops.push(uses);
        }
        let [inner, outer] = face.labels;
        self.topology.faces.push(Face {
            sheet,
            loops,
            labels: if looks_out { [inner, outer] } else { [outer, inner] },
            integral,
            samples: Vec::new(),
        });
    }

    fn edge(&mut self, at: usize) -> usize {
        if let Some(known) = self.edges[at] {
            return known;
        }
        let arc = &self.parts.arcs[at];
        let track = &self.parts.tracks.tracks[arc.track];
        let curve = self.curve(arc.track);
        let ends = arc.vertices.map(|vertex| self.vertex(vertex));
        let deviation = match track.source {
            Source::Crossing(index) => self.parts.geometry.crossings.crossings[index].branch.deviation,
            Source::Edge(_) | Source::Pole(_) => 0.0,
        };
        for (end, t) in ends.iter().zip(arc.t) {
            let gap = self.parts.geometry.point(track.source, t).distance(self.topology.vertices[*end].point);
            let vertex = &mut self.topology.vertices[*end];
            vertex.gap = vertex.gap.max(gap);
        }
        self.topology.edges.push(Edge { curve, range: arc.t, ends, deviation, on: Vec::new() });
        let made = self.topology.edges.len() - 1;
        self.edges[at] = Some(made);
        made
    }

    /// Where edges run on the sheets of the faces beside them.
    fn edges(&mut self) {
        for (at, arc) in self.parts.arcs.iter().enumerate() {
            let Some(edge) = self.edges[at] else { continue };
            let sheets = self.parts.tracks.tracks[arc.track].sheets;
            for flap in &arc.flaps {
                let Some(sheet) = self.sheets[sheets[flap.side]] else { continue };
                if self.topology.sheets[sheet].plane.is_some() {
                    continue;
                }
                let image = self.image(arc.track, flap.side);
                let on = &mut self.topology.edges[edge].on;
                match on.iter_mut().find(|one| one.sheet == sheet) {
                    None => on.push(OnSheet { sheet, forward: image, reversed: None }),
                    Some(other) if other.forward == image => {}
                    // A seam: the left side is run along forwards.
                    Some(other) if flap.left => {
                        other.reversed = Some(other.forward);
                        other.forward = image;
                    }
                    Some(other) => other.reversed = Some(image),
                }
            }
        }
    }

    fn curve(&mut self, track: usize) -> Option<usize> {
        if let Some(known) = self.curves[track] {
            return Some(known);
        }
        let geometry = self.parts.geometry;
        let shape = match self.parts.tracks.tracks[track].source {
            Source::Pole(_) => return None,
            Source::Edge(edge) => CurveShape::Known(geometry.regions.edges[edge].curve.clone()),
            Source::Crossing(at) => {
                let (knots, points) = geometry.crossings.crossings[at].branch.spline();
                let place = |p: &[f64; PARTS]| DVec3::new(p[0], p[1], p[2]);
                CurveShape::Computed { knots, points: points.iter().map(place).collect() }
            }
        };
        self.topology.curves.push(shape);
        self.curves[track] = Some(self.topology.curves.len() - 1);
        self.curves[track]
    }

    fn image(&mut self, track: usize, side: usize) -> usize {
        if let Some(known) = self.images[track][side] {
            return known;
        }
        let geometry = self.parts.geometry;
        let source = self.parts.tracks.tracks[track].source;
        let image = match source {
            Source::Crossing(at) => {
                let (knots, points) = geometry.crossings.crossings[at].branch.spline();
                let place = |p: &[f64; PARTS]| DVec2::new(p[3 + 2 * side], p[4 + 2 * side]);
                PlaneCurve::Computed { knots, points: points.iter().map(place).collect() }
            }
            Source::Edge(_) | Source::Pole(_) => {
                let (origin, direction) = geometry.on_sheet(source, side, 0.0);
                PlaneCurve::Line { origin, direction }
            }
        };
        self.topology.plane_curves.push(image);
        let made = self.topology.plane_curves.len() - 1;
        self.images[track][side] = Some(made);
        made
    }
}

/// A point of the plane, its normal and the direction of u, if a sheet is flat.
fn plane(sheet: &Sheet) -> Option<[DVec3; 3]> {
    let middle = |axis: usize| sheet.low(axis) + 0.5 * sheet.length(axis);
    let (point, u, v) = sheet.first_jet(middle(0), middle(1));
    let normal = u.cross(v).try_normalize()?;
    let reach = sheet.bounds().diagonal();
    let flat = sheet
        .surface
        .net()
        .iter()
        .all(|p| (*p - point).dot(normal).abs() <= FLAT * reach);
    flat.then(|| [point, normal, u.normalize()])
}

/// Points inside a face, in the widest gaps between its loops at two heights.
fn samples(sheet: &Sheet, face: &TracedFace) -> Vec<FaceSample> {
    let outer = &face.polygons[0];
    let low = outer.iter().fold(f64::INFINITY, |low, p| low.min(p.y));
    let high = outer.iter().fold(f64::NEG_INFINITY, |high, p| high.max(p.y));
    let mut found = Vec::new();
    for part in [0.381_966, 0.723_607] {
        let y = low + part * (high - low);
        let mut crossings = Vec::new();
        for polygon in &face.polygons {
            let mut b = polygon[polygon.len() - 1];
            for &a in polygon {
                if (a.y > y) != (b.y > y) {
                    crossings.push(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
                }
                b = a;
            }
        }
        crossings.sort_by(f64::total_cmp);
        let widest = crossings
            .chunks_exact(2)
            .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let Some(gap) = widest else { continue };
        let at = DVec2::new(f64::midpoint(gap[0], gap[1]), y);
        // Loops of a faulty arrangement need not lie in each other.
        if !encloses(outer, at) {
            continue;
        }
        let (point, u, v) = sheet.first_jet(at.x, at.y);
        if let Some(normal) = u.cross(v).try_normalize() {
            found.push(FaceSample { point, normal });
        }
    }
    found
}
