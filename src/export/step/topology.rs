//! Solids and faces: vertices, edges, loops, faces and shells on top of the geometry.
//!
//! Products share no topology, so each has its own; the shared flavour is one body. As in the kernel's own files, edges
//! that are points (the poles of an ellipsoid) are left out of loops, and a loop that only runs along a seam and back is a
//! vertex: the face is its whole closed surface.

use std::collections::HashMap;

use super::draft::Draft;
use super::geometry::{Geometry, Side};
use super::part21::{Id, List, Logical};
use crate::assembly::kernel::{BoundaryUse, Shell};

/// Curves on surfaces that an edge may name.
const SIDES: usize = 2;

/// A body, and what of it has been written, by index.
pub(super) struct Topology<'a, 'g> {
    geometry: &'g mut Geometry<'a>,
    vertices: HashMap<usize, Id>,
    edges: HashMap<usize, Id>,
    loops: HashMap<usize, Vec<Id>>,
    /// By edge: where faces of the body use it.
    sides: HashMap<usize, Vec<Side>>,
}

impl<'a, 'g> Topology<'a, 'g> {
    /// A body that consists of these faces; one may be there twice, for its two sides.
    pub(super) fn new(geometry: &'g mut Geometry<'a>, faces: impl Iterator<Item = usize>) -> Self {
        let mut faces: Vec<usize> = faces.collect();
        faces.sort_unstable();
        faces.dedup();
        let mut sides: HashMap<usize, Vec<Side>> = HashMap::new();
        for face in faces {
            let is_plane = geometry.is_plane(face);
            for (l, uses) in geometry.boundary.faces[face].loops.iter().enumerate() {
                for (u, of) in uses.iter().enumerate() {
                    let sides = sides.entry(of.edge).or_default();
                    // On a plane both directions have the same curve.
                    if !(is_plane && sides.iter().any(|side| side.face == face)) {
                        let at = (l, u);
                        sides.push(Side { face, at });
                    }
                }
            }
        }
        Self {
            geometry,
            vertices: HashMap::new(),
            edges: HashMap::new(),
            loops: HashMap::new(),
            sides,
        }
    }

    /// A solid: its outer shell, then voids.
    pub(super) fn solid(&mut self, to: &mut Draft<'a>, shells: &[Shell]) -> Option<Id> {
        let (outer, voids) = shells.split_first()?;
        let outer = self.closed_shell(to, outer);
        let voids: Vec<Id> = voids
            .iter()
            .map(|shell| {
                // Its faces look out of what fills the void; the solid has it the other way round.
                let filling: Shell = shell
                    .iter()
                    .map(|(face, turned)| (*face, !turned))
                    .collect();
                let shell = self.closed_shell(to, &filling);
                to.add(format_args!("ORIENTED_CLOSED_SHELL('',*,{shell},.F.)"))
            })
            .collect();
        Some(if voids.is_empty() {
            to.add(format_args!("MANIFOLD_SOLID_BREP('',{outer})"))
        } else {
            to.add(format_args!("BREP_WITH_VOIDS('',{outer},{})", List(&voids)))
        })
    }

    pub(super) fn closed_shell(&mut self, to: &mut Draft<'a>, shell: &Shell) -> Id {
        let faces = self.faces(to, shell);
        to.add(format_args!("CLOSED_SHELL('',{})", List(&faces)))
    }

    /// The faces of a shell.
    pub(super) fn faces(&mut self, to: &mut Draft<'a>, shell: &Shell) -> Vec<Id> {
        let mut face = |(face, reversed): &(usize, bool)| self.face(to, *face, *reversed);
        shell.iter().map(&mut face).collect()
    }

    /// A face. Its loops run about the surface's normal, so a face against it has them the other way round.
    fn face(&mut self, to: &mut Draft<'a>, face: usize, reversed: bool) -> Id {
        let along = Logical(!reversed);
        let bounds: Vec<Id> = self
            .loops(to, face)
            .iter()
            .map(|id| to.add(format_args!("FACE_BOUND('',{id},{along})")))
            .collect();
        let surface = self.geometry.surface(to, face);
        to.add(format_args!(
            "ADVANCED_FACE('',{},{surface},{along})",
            List(&bounds)
        ))
    }

    fn loops(&mut self, to: &mut Draft<'a>, face: usize) -> Vec<Id> {
        if let Some(loops) = self.loops.get(&face) {
            return loops.clone();
        }
        let boundary = self.geometry.boundary;
        let loops = boundary.faces[face].loops.iter();
        let loops: Vec<Id> = loops.map(|uses| self.write_loop(to, uses)).collect();
        self.loops.insert(face, loops.clone());
        loops
    }

    fn write_loop(&mut self, to: &mut Draft<'a>, uses: &[BoundaryUse]) -> Id {
        let boundary = self.geometry.boundary;
        let edges: Vec<(BoundaryUse, usize)> = uses
            .iter()
            .filter_map(|of| Some((*of, boundary.edges[of.edge].curve?)))
            .collect();
        if let Some(at) = turning_point(&edges) {
            let of = edges.get(at).map_or(uses[0], |(of, _)| *of);
            let edge = boundary.edges[of.edge];
            let vertex = self.vertex(to, if of.reversed { edge.end } else { edge.start });
            return to.add(format_args!("VERTEX_LOOP('',{vertex})"));
        }
        let edges: Vec<Id> = edges
            .iter()
            .map(|(of, curve)| {
                let edge = self.edge(to, of.edge, *curve);
                let along = Logical(!of.reversed);
                to.add(format_args!("ORIENTED_EDGE('',*,*,{edge},{along})"))
            })
            .collect();
        to.add(format_args!("EDGE_LOOP('',{})", List(&edges)))
    }

    fn edge(&mut self, to: &mut Draft<'a>, edge: usize, curve: usize) -> Id {
        if let Some(written) = self.edges.get(&edge) {
            return *written;
        }
        let of = self.geometry.boundary.edges[edge];
        let (start, end) = (self.vertex(to, of.start), self.vertex(to, of.end));
        let curve = self.curve(to, edge, curve);
        let id = to.add(format_args!("EDGE_CURVE('',{start},{end},{curve},.T.)"));
        self.edges.insert(edge, id);
        id
    }

    /// A curve in space with its curves on surfaces. Of more than two faces around an edge, readers can do without the
    /// curves on planes best.
    fn curve(&mut self, to: &mut Draft<'a>, edge: usize, curve: usize) -> Id {
        let mut sides = self.sides.get(&edge).cloned().unwrap_or_default();
        let seam = sides.iter().enumerate().find_map(|(at, side)| {
            let other = sides[..at].iter().find(|other| other.face == side.face)?;
            Some([*other, *side])
        });
        let kind = match seam {
            Some(both) => {
                sides = both.to_vec();
                "SEAM"
            }
            None => "SURFACE",
        };
        if sides.len() > SIDES {
            sides.sort_by_key(|side| self.geometry.is_plane(side.face));
            sides.truncate(SIDES);
        }
        let pcurves: Vec<Id> = sides
            .iter()
            .filter_map(|side| self.geometry.pcurve(to, *side, curve))
            .collect();
        let curve = self.geometry.curve(to, curve);
        to.add(format_args!(
            "{kind}_CURVE('',{curve},{},.PCURVE_S1.)",
            List(&pcurves)
        ))
    }

    fn vertex(&mut self, to: &mut Draft<'a>, vertex: usize) -> Id {
        if let Some(written) = self.vertices.get(&vertex) {
            return *written;
        }
        let point = self.geometry.point(to, vertex);
        let id = to.add(format_args!("VERTEX_POINT('',{point})"));
        self.vertices.insert(vertex, id);
        id
    }
}

/// Where a loop turns round and runs back the way it came, if that is all it does. A loop without edges turns where it is.
fn turning_point(edges: &[(BoundaryUse, usize)]) -> Option<usize> {
    let count = edges.len();
    let edge = |at: usize| edges[at % count].0.edge;
    let turns = |at: usize| (0..count / 2).all(|k| edge(at + k) == edge(at + count - 1 - k));
    match count {
        0 => Some(0),
        _ if count % 2 == 1 => None,
        _ => (0..count).find(|at| turns(*at)),
    }
}
