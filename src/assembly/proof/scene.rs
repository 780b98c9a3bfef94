//! Finished topology as it is handed on: which solid is where, told from its tables alone.
//!
//! A line parallel to an axis passes through the surface of each face where [`crate::nurbs::pierce`] finds it, and through the
//! face if the outline of the face's own curves holds the place. The solids on both sides come from the solids' shells. Nothing that
//! the partition knew on its way is used.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::spline;
use super::tree::{Bounds, Tree};
use crate::nurbs::outline::{Course, Outline};
use crate::nurbs::pierce::{Line, Passage, Target, merged};
use crate::partition::{Face, Topology};

/// A line that meets a face at a smaller sine than this says nothing.
const GRAZING: f64 = 1e-5;

/// At how many heights points inside a face are looked for at most.
const HEIGHTS: u32 = 64;

/// Where a line passes through a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// The coordinate along the line's axis (m).
    pub(super) along: f64,
    pub(super) face: usize,
    /// Whether `S_u × S_v` points forwards there.
    pub(super) forward: bool,
    /// The sine of the angle between line and face.
    pub(super) sine: f64,
}

/// A face with its outline.
struct Located<'a> {
    surface: Shape<'a>,
    outline: Outline<'a>,
}

enum Shape<'a> {
    /// Origin, normal, and two directions in it.
    Plane([DVec3; 4]),
    Spline(Target<'a>),
}

/// Topology in which lines are followed.
pub(super) struct Scene<'a> {
    pub(super) topology: &'a Topology,
    faces: Vec<Located<'a>>,
    tree: Tree<(usize, usize)>,
    /// By face: the solid behind it and the one in front, seen along `S_u × S_v`.
    pub(super) sides: Vec<[Option<usize>; 2]>,
    /// Nearer than this to an edge or a fold a line says nothing (m).
    pub(super) near: f64,
}

/// A plane as origin, normal and two directions.
pub(super) fn frame([origin, normal, x]: [DVec3; 3]) -> [DVec3; 4] {
    [origin, normal, x, normal.cross(x)]
}

/// An edge as a face's loop runs along it, in the parameters of the face's surface; none along a pole of a plane, or
/// where there is no curve.
pub(super) fn course<'a>(
    topology: &'a Topology,
    face: &Face,
    (edge, backwards): (usize, bool),
) -> Option<Course<'a>> {
    let own = &topology.edges[edge];
    let (spline, plane) = if let Some(plane) = topology.sheets[face.sheet].plane {
        let [origin, _, x, y] = frame(plane);
        let spline = spline::of_space(&topology.curves[own.curve?]);
        (spline, Some([origin, x, y]))
    } else {
        let on = own.on.iter().find(|on| on.sheet == face.sheet)?;
        let image = match on.reversed {
            Some(image) if backwards => image,
            _ => on.forward,
        };
        (
            spline::of_plane(&topology.plane_curves[image], own.range),
            None,
        )
    };
    spline.is_sound().then_some(Course {
        spline,
        range: own.range,
        backwards,
        plane,
    })
}

impl<'a> Located<'a> {
    fn new(topology: &'a Topology, face: &Face) -> Self {
        let sheet = &topology.sheets[face.sheet];
        let mut outline = Outline::default();
        for own in &face.loops {
            let courses = own.iter().filter_map(|half| course(topology, face, *half));
            outline.add(courses.collect());
        }
        let surface = match sheet.plane {
            Some(plane) => Shape::Plane(frame(plane)),
            None => Shape::Spline(Target::new(&sheet.surface)),
        };
        Self { surface, outline }
    }

    /// The boxes of the parts of its surface that it lies on.
    fn boxes(&self) -> Vec<(Bounds, usize)> {
        let (low, high) = self.outline.bounds();
        match &self.surface {
            Shape::Plane([origin, _, x, y]) => {
                let corner = |u: f64, v: f64| *origin + *x * u + *y * v;
                let all = [
                    corner(low.x, low.y),
                    corner(high.x, low.y),
                    corner(low.x, high.y),
                    corner(high.x, high.y),
                ];
                let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
                let bounds = all.iter().fold(empty, |(a, b), p| (a.min(*p), b.max(*p)));
                vec![(bounds, 0)]
            }
            Shape::Spline(target) => {
                let meets = |[from, to]: [DVec2; 2]| from.cmple(high).all() && low.cmple(to).all();
                let patches = target.patches().enumerate();
                patches
                    .filter(|(_, (_, range))| meets(*range))
                    .map(|(at, (bounds, _))| (bounds, at))
                    .collect()
            }
        }
    }

    /// Whether it holds a place of its surface, if that is clear of its border.
    fn holds(&self, passage: &Passage, near: f64) -> Option<bool> {
        let area = passage.u.cross(passage.v).length();
        let slack = DVec2::new(passage.v.length(), passage.u.length()) * (near / area);
        self.outline.holds(passage.at, slack)
    }
}

impl<'a> Scene<'a> {
    pub(super) fn new(topology: &'a Topology, near: f64) -> Self {
        let faces: Vec<Located<'a>> = topology
            .faces
            .par_iter()
            .map(|face| Located::new(topology, face))
            .collect();
        let items = faces.iter().enumerate().flat_map(|(index, face)| {
            let boxes = face.boxes().into_iter();
            boxes.map(move |(bounds, patch)| (bounds, (index, patch)))
        });
        let mut sides = vec![[None; 2]; faces.len()];
        for (index, solid) in topology.solids.iter().enumerate() {
            for &(face, reversed) in solid.shells.iter().flatten() {
                sides[face][usize::from(reversed)] = Some(index);
            }
        }
        Self {
            tree: Tree::new(items.collect()),
            topology,
            faces,
            sides,
            near,
        }
    }

    /// Where a line passes through faces, in order; `None` if it comes too near to an edge or grazes something.
    pub(super) fn along(&self, line: Line) -> Option<Vec<Crossing>> {
        let mut met: Vec<(usize, usize)> = Vec::new();
        self.tree.along(line, self.near, |item| {
            met.push(*item);
            true
        });
        met.sort_unstable();
        let mut crossings = Vec::new();
        for own in met.chunk_by(|a, b| a.0 == b.0) {
            let face = &self.faces[own[0].0];
            let found = match &face.surface {
                Shape::Plane(frame) => through_plane(frame, line),
                Shape::Spline(target) => {
                    let mut found = Vec::new();
                    for (_, patch) in own {
                        if !target.pass(*patch, line, self.near, &mut found) {
                            return None;
                        }
                    }
                    merged(found, self.near)
                }
            };
            for passage in found {
                let normal = passage.u.cross(passage.v);
                let sine = normal[line.axis] / normal.length();
                // Also what is not a number: a pole, or a plane along the line.
                if !(sine.abs() > GRAZING) {
                    let apart = (passage.point - line.at(passage.point[line.axis])).length();
                    if apart > self.near {
                        continue;
                    }
                    return None;
                }
                let along = passage.point[line.axis];
                let is_within = line.range[0] <= along && along <= line.range[1];
                if is_within && face.holds(&passage, self.near)? {
                    crossings.push(Crossing {
                        along,
                        face: own[0].0,
                        forward: sine > 0.0,
                        sine: sine.abs(),
                    });
                }
            }
        }
        crossings.sort_by(|a, b| a.along.total_cmp(&b.along).then(a.face.cmp(&b.face)));
        Some(crossings)
    }

    /// Points well inside a face with its normals there, in the middle of its widest gaps at some heights in its parameters.
    pub(super) fn inside(&self, face: usize) -> impl Iterator<Item = (DVec3, DVec3)> {
        let own = &self.faces[face];
        let (low, high) = own.outline.bounds();
        (1..=HEIGHTS).filter_map(move |k| {
            // Multiples of the golden ratio: spread evenly, and on no height that symmetry prefers.
            let part = (f64::from(k) * 0.618_033_988_749_895).fract();
            let at = own.outline.widest(low.y + part * (high.y - low.y))?;
            match &own.surface {
                Shape::Plane([origin, normal, x, y]) => {
                    Some((*origin + *x * at.x + *y * at.y, *normal))
                }
                Shape::Spline(_) => {
                    let surface = &self.topology.sheets[self.topology.faces[face].sheet].surface;
                    let normal = surface.normal(at.x, at.y)?;
                    Some((surface.point(at.x, at.y), normal))
                }
            }
        })
    }

    /// About how wide a face is across its longest extent (m): its area for the distance that its vertices span.
    pub(super) fn width(&self, face: usize) -> f64 {
        let own = &self.topology.faces[face];
        let ends = own.loops.iter().flatten().flat_map(|(edge, _)| {
            let ends = self.topology.edges[*edge].ends;
            ends.map(|end| self.topology.vertices[end].point)
        });
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = ends.fold(empty, |(low, high), p| (low.min(p), high.max(p)));
        own.integral.area / (high - low).length()
    }

    /// Whether a face's outer loop comes first.
    pub(super) fn is_in_order(&self, face: usize) -> bool {
        self.faces[face].outline.is_in_order()
    }

    /// The volume of a solid.
    pub(super) fn label(&self, solid: Option<usize>) -> Option<usize> {
        solid.map(|solid| self.topology.solids[solid].label)
    }

    /// What a crossing leads out of and into.
    pub(super) fn leads(&self, crossing: &Crossing) -> [Option<usize>; 2] {
        let [behind, before] = self.sides[crossing.face];
        if crossing.forward {
            [behind, before]
        } else {
            [before, behind]
        }
    }
}

fn through_plane(&[origin, normal, x, y]: &[DVec3; 4], line: Line) -> Vec<Passage> {
    let start = line.at(0.0);
    let slope = normal[line.axis];
    let passage = |point: DVec3| Passage {
        at: DVec2::new((point - origin).dot(x), (point - origin).dot(y)),
        point,
        u: x,
        v: y,
    };
    if slope.abs() < GRAZING {
        // Along the plane: nowhere, or all along; the point of the plane nearest to where the line is tells.
        let off = normal.dot(line.at(origin[line.axis]) - origin);
        return vec![passage(line.at(origin[line.axis]) - normal * off)];
    }
    vec![passage(line.at(normal.dot(origin - start) / slope))]
}

/// A stretch of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    /// From and to (m); the first one comes from where the line does, and the last one goes as far.
    pub(super) range: [f64; 2],
    /// The solid that holds it.
    pub(super) solid: Option<usize>,
    /// The faces at its ends.
    pub(super) faces: [Option<usize>; 2],
}

/// Where crossings contradict each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Broken {
    /// The coordinate along the line's axis (m).
    pub(super) along: f64,
    /// The solid that the line was in.
    pub(super) within: Option<usize>,
    /// The solid that it should have left there; none was left by the last crossing.
    pub(super) leaves: Option<usize>,
}

/// A line's crossings as stretches, each in one solid. A whole line comes from outside of all solids and ends there; of a part
/// it is not known where it begins.
pub(super) fn stretches(
    scene: &Scene<'_>,
    line: Line,
    mut rest: Vec<Crossing>,
) -> Result<Vec<Stretch>, Broken> {
    let is_whole = line.range[0] == f64::NEG_INFINITY;
    let mut all = Vec::with_capacity(rest.len() + 1);
    let first = rest.first().filter(|_| !is_whole);
    let mut here = Stretch {
        range: line.range,
        solid: first.and_then(|first| scene.leads(first)[0]),
        faces: [None; 2],
    };
    while let Some(first) = rest.first().copied() {
        // Faces nearer to each other than curves are computed to may come in any order.
        let reach = |other: &Crossing| scene.near / first.sine + scene.near / other.sine;
        let next = rest
            .iter()
            .take_while(|other| other.along - first.along <= reach(other))
            .position(|other| scene.leads(other)[0] == here.solid);
        let Some(next) = next else {
            return Err(Broken {
                along: first.along,
                within: here.solid,
                leaves: scene.leads(&first)[0],
            });
        };
        let crossing = rest.remove(next);
        here.range[1] = crossing.along;
        here.faces[1] = Some(crossing.face);
        all.push(here);
        here = Stretch {
            range: [crossing.along, line.range[1]],
            solid: scene.leads(&crossing)[1],
            faces: [Some(crossing.face), None],
        };
    }
    if is_whole && here.solid.is_some() {
        return Err(Broken {
            along: here.range[0],
            within: here.solid,
            leaves: None,
        });
    }
    all.push(here);
    Ok(all)
}
