//! The constrained Delaunay triangulation of a face's polygons: which triangles are inside, and which chords are too coarse.
//!
//! `spade` is exact where it decides (adaptive predicates), and its way to add a constraint that cannot be added is to say so. Then
//! the two chords cross, or one passes through an end of another: finer ones will not.

use std::collections::HashMap;

use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, Point2, PositionInTriangulation, Triangulation,
    mitigate_underflow,
};

use super::outline::{Node, Segment};

/// A node at its place.
#[derive(Clone, Copy, Debug)]
struct Site {
    position: Point2<f64>,
    node: usize,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// A triangulation of nodes in the plane.
pub(super) struct Planar {
    all: ConstrainedDelaunayTriangulation<Site>,
    handles: Vec<FixedVertexHandle>,
    low: DVec2,
    scale: DVec2,
    /// How often loops run from one node to another, by their handles.
    sides: HashMap<(usize, usize), i32>,
}

/// Why polygons cannot be triangulated as they are.
pub(super) enum Refusal {
    /// Chords of edges that are too coarse.
    Coarse(Vec<(usize, usize)>),
    /// Parameters of the surface that are no numbers.
    Number(DVec2),
}

/// The longer one of two chords in conflict is halved, and the other one if it is not much shorter.
const SHORTER: f64 = 0.6;

impl Planar {
    /// All nodes with the polygons as constraints. Lengths in the plane are those in the parameters, from a corner, times a scale.
    pub(super) fn new(
        nodes: &[Node],
        segments: &[Segment],
        low: DVec2,
        scale: DVec2,
    ) -> Result<Self, Refusal> {
        let mut planar = Self {
            all: ConstrainedDelaunayTriangulation::new(),
            handles: Vec::with_capacity(nodes.len()),
            low,
            scale,
            sides: HashMap::new(),
        };
        let mut twins = Vec::new();
        for (at, node) in nodes.iter().enumerate() {
            let before = planar.all.num_vertices();
            planar.insert(at, node)?;
            if planar.all.num_vertices() == before {
                twins.push(planar.handles[at]);
            }
        }
        if !twins.is_empty() {
            let touches = |at: usize| twins.contains(&planar.handles[at]);
            let chords = segments.iter().filter(|s| touches(s.from) || touches(s.to));
            return Err(Refusal::Coarse(chords.filter_map(|s| s.of).collect()));
        }
        let coarse = planar.constrain(nodes, segments);
        if !coarse.is_empty() {
            return Err(Refusal::Coarse(coarse));
        }
        let wrong = planar.wrong(segments);
        if wrong.is_empty() {
            Ok(planar)
        } else {
            Err(Refusal::Coarse(wrong))
        }
    }

    fn position(&self, uv: DVec2) -> Point2<f64> {
        let at = (uv - self.low) * self.scale;
        mitigate_underflow(Point2::new(at.x, at.y))
    }

    fn insert(&mut self, at: usize, node: &Node) -> Result<(), Refusal> {
        let site = Site {
            position: self.position(node.uv),
            node: at,
        };
        let handle = self
            .all
            .insert(site)
            .map_err(|_| Refusal::Number(node.uv))?;
        self.handles.push(handle);
        Ok(())
    }

    /// Adds a node inside; says whether it could be: not on the polygons, and not where another one is.
    pub(super) fn insert_inside(&mut self, at: usize, node: &Node, near: Option<usize>) -> bool {
        let site = Site {
            position: self.position(node.uv),
            node: at,
        };
        let hint = near.map(|near| self.handles[near]);
        let place = match hint {
            Some(hint) => self.all.locate_with_hint(site.position, hint),
            None => self.all.locate(site.position),
        };
        let is_free = match place {
            PositionInTriangulation::OnFace(_) => true,
            PositionInTriangulation::OnEdge(edge) => {
                !self.all.is_constraint_edge(edge.as_undirected())
            }
            _ => false,
        };
        let handle = match hint {
            _ if !is_free => None,
            Some(hint) => self.all.insert_with_hint(site, hint).ok(),
            None => self.all.insert(site).ok(),
        };
        match handle {
            Some(handle) if handle.index() == self.handles.len() => {
                self.handles.push(handle);
                true
            }
            _ => false,
        }
    }

    /// Adds the polygons' sides. Returns the chords that are in each other's way.
    fn constrain(&mut self, nodes: &[Node], segments: &[Segment]) -> Vec<(usize, usize)> {
        let mut by_ends: HashMap<(usize, usize), usize> = HashMap::new();
        let mut coarse = Vec::new();
        let length = |s: &Segment| ((nodes[s.from].uv - nodes[s.to].uv) * self.scale).length();
        let lengths: Vec<f64> = segments.iter().map(length).collect();
        for (at, segment) in segments.iter().enumerate() {
            let [from, to] = [segment.from, segment.to].map(|node| self.handles[node]);
            *self.sides.entry((from.index(), to.index())).or_insert(0) += 1;
            let crossed: Vec<[usize; 2]> = self
                .all
                .get_conflicting_edges_between_vertices(from, to)
                .map(|edge| [edge.from().fix().index(), edge.to().fix().index()])
                .collect();
            if crossed.is_empty() {
                self.all.try_add_constraint(from, to);
                if self.all.exists_constraint(from, to) {
                    by_ends.insert(ordered(from.index(), to.index()), at);
                } else {
                    // It passes through other nodes.
                    coarse.push(at);
                }
                continue;
            }
            for [a, b] in crossed {
                let other = by_ends.get(&ordered(a, b)).copied();
                let own = segment.of.map(|_| at);
                let other = other.filter(|other| segments[*other].of.is_some());
                match (own, other) {
                    (Some(own), Some(other)) => {
                        let longest = lengths[own].max(lengths[other]);
                        coarse.extend(
                            [own, other]
                                .into_iter()
                                .filter(|at| lengths[*at] >= SHORTER * longest),
                        );
                    }
                    (own, other) => coarse.extend(own.or(other)),
                }
            }
        }
        coarse.sort_unstable();
        coarse.dedup();
        coarse
            .into_iter()
            .filter_map(|at| segments[at].of)
            .collect()
    }

    /// How often the loops go around each triangle, by the index of its handle.
    fn windings(&self) -> Vec<Option<i32>> {
        let mut windings: Vec<Option<i32>> = vec![None; self.all.num_all_faces()];
        let outer = self.all.outer_face();
        windings[outer.fix().index()] = Some(0);
        let mut stack: Vec<_> = self.all.convex_hull().map(|edge| edge.fix()).collect();
        // Each is an edge whose left side is known, and whose right side is to be.
        while let Some(edge) = stack.pop() {
            let edge = self.all.directed_edge(edge);
            let (known, other) = (edge.face().fix().index(), edge.rev().face().fix().index());
            let Some(winding) = windings[known].filter(|_| windings[other].is_none()) else {
                continue;
            };
            let [from, to] = [edge.from().fix().index(), edge.to().fix().index()];
            let along = |pair| self.sides.get(&pair).copied().unwrap_or(0);
            windings[other] = Some(if edge.is_constraint_edge() {
                winding - along((from, to)) + along((to, from))
            } else {
                winding
            });
            if let Some(face) = edge.rev().face().as_inner() {
                stack.extend(face.adjacent_edges().map(|edge| edge.fix()));
            }
        }
        windings
    }

    /// Chords around what loops go around neither once nor not at all: polygons that are too coarse to keep their order.
    fn wrong(&self, segments: &[Segment]) -> Vec<(usize, usize)> {
        let windings = self.windings();
        let is_wrong = |face: usize| !matches!(windings[face], Some(0 | 1));
        let mut pairs = Vec::new();
        for edge in self
            .all
            .undirected_edges()
            .filter(|edge| edge.is_constraint_edge())
        {
            let edge = edge.as_directed();
            let faces = [edge.face().fix().index(), edge.rev().face().fix().index()];
            if faces.into_iter().any(is_wrong) {
                pairs.push(ordered(edge.from().fix().index(), edge.to().fix().index()));
            }
        }
        pairs.sort_unstable();
        let touches = |s: &&Segment| {
            let [from, to] = [s.from, s.to].map(|node| self.handles[node].index());
            pairs.binary_search(&ordered(from, to)).is_ok()
        };
        segments
            .iter()
            .filter(touches)
            .filter_map(|s| s.of)
            .collect()
    }

    /// The triangles inside, each counter-clockwise, and which of their sides are free: opposite to the corner of that place.
    pub(super) fn inside(&self) -> Vec<Inside> {
        let windings = self.windings();
        let faces = self.all.inner_faces();
        faces
            .filter(|face| windings[face.fix().index()] == Some(1))
            .map(|face| {
                let edges = face.adjacent_edges();
                Inside {
                    corners: edges.map(|edge| edge.from().data().node),
                    is_free: edges.map(|edge| !edge.is_constraint_edge()),
                }
            })
            .collect()
    }
}

/// A triangle inside of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inside {
    pub(super) corners: [usize; 3],
    /// Whether the side from a corner to the next one is none of the polygons'.
    pub(super) is_free: [bool; 3],
}

pub(super) fn ordered(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}
