//! The tables of finished topology, filled face by face.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::bounds::Bounds;
use super::boxes;
use super::faces::{Face as TracedFace, HalfEdge};
use super::hermite::{PARTS, on_sheet};
use super::quadrature::Integral;
use super::slits::{Step, left_out};
use super::solids::{Parts, Solid as JoinedSolid};
use super::topology::{
    CurveShape, Edge, Face, OnSheet, PlaneCurve, SheetShape, Solid, Topology, Vertex,
};
use super::tracks::Source;
use crate::nurbs::Curve;

impl Topology {
    pub(super) fn new(parts: &Parts<'_>, solids: Vec<JoinedSolid>) -> Self {
        let surfaces: Vec<SheetShape> = parts
            .faces
            .par_iter()
            .map(|face| shape(parts, face))
            .collect();
        let curves: Vec<ArcCurves> = (0..parts.arcs.len())
            .into_par_iter()
            .map(|at| arc_curves(parts, at))
            .collect();
        let mut builder = Builder {
            parts,
            curves,
            topology: Self::default(),
            planes: vec![None; parts.geometry.regions.sheets.len()],
            vertices: vec![None; parts.tracks.points.len()],
            edges: vec![None; parts.arcs.len()],
            images: vec![[None; 2]; parts.arcs.len()],
        };
        for ((face, integral), surface) in parts.faces.iter().zip(parts.integrals).zip(surfaces) {
            builder.face(face, *integral, surface);
        }
        let mut topology = builder.topology;
        let boxes: Vec<Bounds> = parts
            .faces
            .par_iter()
            .map(|face| boxes::of_face(&parts.geometry.regions.sheets[face.sheet], face))
            .collect();
        topology.solids = solids
            .into_iter()
            .map(|solid| {
                let faces = solid.shells[0].iter();
                let bounds = faces.fold(Bounds::EMPTY, |all, (face, _)| all.and(boxes[*face]));
                Solid {
                    label: solid.label,
                    shells: solid.shells,
                    size: solid.volume,
                    bounds: (bounds.low, bounds.high),
                }
            })
            .collect();
        topology
    }
}

/// Places along an arc by which loops are compared.
const SAMPLES: usize = 8;

/// The curves of an arc, in space and on both sheets, until they are taken.
struct ArcCurves {
    space: Option<CurveShape>,
    on: [Option<PlaneCurve>; 2],
}

fn arc_curves(parts: &Parts<'_>, at: usize) -> ArcCurves {
    let arc = &parts.arcs[at];
    let geometry = parts.geometry;
    let source = parts.tracks.tracks[arc.track].source;
    if let Source::Crossing(index) = source {
        let (knots, points) = geometry.crossings.curves[index].branch.spline(arc.t);
        let place = |p: &[f64; PARTS]| DVec3::new(p[0], p[1], p[2]);
        let on = |side: usize| {
            Some(PlaneCurve::Computed {
                knots: knots.clone(),
                points: points.iter().map(|p| on_sheet(p, side)).collect(),
            })
        };
        return ArcCurves {
            on: [on(0), on(1)],
            space: Some(CurveShape::Computed {
                points: points.iter().map(place).collect(),
                knots: knots.clone(),
            }),
        };
    }
    // On the level sheet that an edge lands on it is no line; but edges on planes need none.
    let line = |side: usize| {
        let (origin, direction) = geometry.on_sheet(source, side, 0.0);
        Some(PlaneCurve::Line { origin, direction })
    };
    let space = match source {
        Source::Edge(edge) => Some(CurveShape::Known(part(
            &geometry.regions.edges[edge].curve,
            arc.t,
        ))),
        Source::Crossing(_) | Source::Pole(_) => None,
    };
    ArcCurves {
        on: [line(0), line(1)],
        space,
    }
}

struct Builder<'a> {
    parts: &'a Parts<'a>,
    curves: Vec<ArcCurves>,
    topology: Topology,
    /// Flat sheets serve all of their faces.
    planes: Vec<Option<usize>>,
    vertices: Vec<Option<usize>>,
    edges: Vec<Option<usize>>,
    /// By arc and side.
    images: Vec<[Option<usize>; 2]>,
}

impl Builder<'_> {
    fn sheet(&mut self, at: usize, shape: SheetShape) -> usize {
        if let Some(known) = self.planes[at] {
            return known;
        }
        let is_plane = shape.plane.is_some();
        self.topology.sheets.push(shape);
        let made = self.topology.sheets.len() - 1;
        if is_plane {
            self.planes[at] = Some(made);
        }
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

    fn face(&mut self, face: &TracedFace, integral: Integral, shape: SheetShape) {
        let (is_plane, looks_out) = (shape.plane.is_some(), shape.looks_out);
        let sheet = self.sheet(face.sheet, shape);
        let mut loops = Vec::with_capacity(face.loops.len());
        if is_plane {
            for own in self.on_plane(face) {
                let arcs = own
                    .into_iter()
                    .filter_map(|(arc, reversed)| Some((arc?, reversed)));
                loops.push(
                    arcs.map(|(arc, reversed)| (self.edge(arc), reversed))
                        .collect(),
                );
            }
        } else {
            for own in &face.loops {
                let mut uses = Vec::with_capacity(own.len());
                for half in own {
                    let edge = self.edge(half.arc);
                    uses.push((edge, !half.forward));
                    self.place(edge, sheet, half);
                }
                loops.push(uses);
            }
        }
        let [inner, outer] = face.labels;
        self.topology.faces.push(Face {
            sheet,
            loops,
            labels: if looks_out {
                [inner, outer]
            } else {
                [outer, inner]
            },
            integral,
        });
    }

    /// The loops of a face on a plane, which knows no seams and no poles.
    fn on_plane(&self, face: &TracedFace) -> Vec<Vec<Step>> {
        let parts = self.parts;
        let source = |arc: usize| parts.tracks.tracks[parts.arcs[arc].track].source;
        let step = |half: &HalfEdge| {
            let is_pole = matches!(source(half.arc), Source::Pole(_));
            ((!is_pole).then_some(half.arc), !half.forward)
        };
        let loops: Vec<Vec<Step>> = face
            .loops
            .iter()
            .map(|own| own.iter().map(step).collect())
            .collect();
        let size = |own: &[Step]| {
            let arcs = own.iter().filter_map(|step| step.0);
            let points = arcs.flat_map(|arc| {
                let [from, to] = parts.arcs[arc].t;
                (0..=SAMPLES).map(move |k| {
                    let t = from + (to - from) * k as f64 / SAMPLES as f64;
                    parts.geometry.point(source(arc), t)
                })
            });
            let around = Bounds::of(points);
            (around.high - around.low).length()
        };
        left_out(&loops, size)
    }

    fn edge(&mut self, at: usize) -> usize {
        if let Some(known) = self.edges[at] {
            return known;
        }
        let arc = &self.parts.arcs[at];
        let geometry = self.parts.geometry;
        let source = self.parts.tracks.tracks[arc.track].source;
        let deviation = match source {
            Source::Crossing(index) => geometry.crossings.curves[index].branch.deviation,
            Source::Edge(_) | Source::Pole(_) => 0.0,
        };
        let curve = self.curves[at].space.take().map(|curve| {
            self.topology.curves.push(curve);
            self.topology.curves.len() - 1
        });
        let ends = arc.vertices.map(|vertex| self.vertex(vertex));
        for (end, t) in ends.iter().zip(arc.t) {
            let vertex = &mut self.topology.vertices[*end];
            vertex.gap = vertex
                .gap
                .max(geometry.point(source, t).distance(vertex.point));
        }
        self.topology.edges.push(Edge {
            curve,
            range: arc.t,
            ends,
            deviation,
            on: Vec::new(),
        });
        let made = self.topology.edges.len() - 1;
        self.edges[at] = Some(made);
        made
    }

    /// Where an edge runs on the surface of a face beside it.
    fn place(&mut self, edge: usize, sheet: usize, half: &HalfEdge) {
        let image = self.image(half.arc, half.side);
        let on = &mut self.topology.edges[edge].on;
        match on.iter_mut().find(|one| one.sheet == sheet) {
            None => on.push(OnSheet {
                sheet,
                forward: image,
                reversed: None,
            }),
            Some(other) if other.forward == image => {}
            // A seam within one face.
            Some(other) if half.forward => {
                other.reversed = Some(other.forward);
                other.forward = image;
            }
            Some(other) => other.reversed = Some(image),
        }
    }

    fn image(&mut self, at: usize, side: usize) -> usize {
        if let Some(known) = self.images[at][side] {
            return known;
        }
        self.topology
            .plane_curves
            .extend(self.curves[at].on[side].take());
        let made = self.topology.plane_curves.len() - 1;
        self.images[at][side] = Some(made);
        made
    }
}

/// The distinct knots around a range of parameters.
fn around(knots: &[f64], [low, high]: [f64; 2]) -> [f64; 2] {
    let inner = &knots[1..knots.len() - 1];
    let from = inner.partition_point(|knot| *knot <= low);
    let to = inner.partition_point(|knot| *knot < high);
    [knots[from], knots[to + 1]]
}

/// The spans of a curve that hold a range of its parameters: readers get no more than an edge needs.
fn part(curve: &Curve, range: [f64; 2]) -> Curve {
    let knots: Vec<f64> = curve.knots().distinct().iter().map(|knot| knot.0).collect();
    let [from, to] = around(&knots, range);
    // A split at an inner knot cannot fail; if it did, the whole curve serves as well.
    let after = curve
        .split(from)
        .map_or_else(|_| curve.clone(), |halves| halves.1);
    after.split(to).map_or(after, |halves| halves.0)
}

/// The parameters that a face's outer loop stays within, by the control points of its curves.
fn extent(parts: &Parts<'_>, face: &TracedFace) -> [DVec2; 2] {
    let mut places = face.polygons[0].clone();
    for half in &face.loops[0] {
        let arc = &parts.arcs[half.arc];
        if let Source::Crossing(at) = parts.tracks.tracks[arc.track].source {
            let branch = &parts.geometry.crossings.curves[at].branch;
            let (_, points) = branch.spline(arc.t);
            places.extend(points.iter().map(|point| on_sheet(point, half.side)));
        }
    }
    let low = places.iter().fold(DVec2::INFINITY, |low, p| low.min(*p));
    let high = places
        .iter()
        .fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
    [low, high]
}

/// The spans of a face's sheet that hold the face, or its plane.
fn shape(parts: &Parts<'_>, face: &TracedFace) -> SheetShape {
    let sheets = &parts.geometry.regions.sheets;
    let sheet = &sheets[face.sheet];
    let first = sheets
        .iter()
        .position(|other| other.region == sheet.region)
        .unwrap_or(face.sheet);
    let plane = sheet.plane;
    let surface = if plane.is_some() {
        sheet.surface.clone()
    } else {
        let [low, high] = extent(parts, face);
        let range = |axis: usize| around(&sheet.knots[axis], [low[axis], high[axis]]);
        let ([u0, u1], [v0, v1]) = (range(0), range(1));
        let mut part = sheet.surface.clone();
        part = part.split_v(v0).map_or(part, |halves| halves.1);
        part = part.split_v(v1).map_or(part, |halves| halves.0);
        part = part.split_u(u0).map_or(part, |halves| halves.1);
        part.split_u(u1).map_or(part, |halves| halves.0)
    };
    SheetShape {
        region: sheet.region,
        place: face.sheet - first,
        looks_out: sheet.outward > 0.0,
        surface,
        plane,
    }
}
