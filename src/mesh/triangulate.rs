//! All edges, then all faces; and again where chords turn out to be too coarse.
//!
//! Faces are triangulated in parallel, each by itself, from the divisions of their edges. A face whose chords cross says which ones;
//! these are halved, and the faces at them made anew. Where the triangles of two faces meet side to side away from their edges (the
//! base and the top of something thinner than the tolerance), the side gets a point in each of them, so that a body is never flat.

use std::collections::{BTreeMap, HashMap};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::divide::{Course, Division};
use super::face::{Job, Piece, Unmade};
use super::fineness::{Fineness, Limits};
use super::outline::Origin;
use super::planar::ordered;
use super::tables::Tables;
use super::triangles::{Corner, FaceMesh, Mesh};

/// Points that one face may have.
pub const MOST_POINTS: usize = 4_000_000;
/// How often chords may be halved, and sides divided.
const ROUNDS: usize = 64;

/// Why there are no triangles.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A tolerance is none.
    #[error("the {what} is {value}; it must be above 0{less}", less = if *what == "angle (rad)" { " and below π/2" } else { "" })]
    Fineness {
        /// Which one.
        what: &'static str,
        /// What it is.
        value: f64,
    },
    /// The tables refer to what is not there.
    #[error("the tables do not fit together: {0}")]
    Tables(String),
    /// A face wants too many points.
    #[error(
        "face {face} near {place} needs more than {most} points at a chord tolerance of {chord} m; take a larger one"
    )]
    TooMany {
        /// The face.
        face: usize,
        /// The first point of its outline (m).
        place: DVec3,
        /// The points that it may have.
        most: usize,
        /// The tolerance (m).
        chord: f64,
    },
    /// Parameters of a surface are no numbers.
    #[error("face {face} near {place} has no place ({}, {}) in its surface's parameters", uv.x, uv.y)]
    Number {
        /// The face.
        face: usize,
        /// The first point of its outline (m).
        place: DVec3,
        /// The parameters.
        uv: DVec2,
    },
    /// Chords still are in each other's way after many halvings.
    #[error(
        "the outline of face {face} near {place} crosses itself however finely it is divided; take a smaller chord tolerance than {chord} m"
    )]
    Crossing {
        /// The face.
        face: usize,
        /// The first point of its outline (m).
        place: DVec3,
        /// The tolerance (m).
        chord: f64,
    },
}

/// Triangulates all faces. Neighbours share the points of their edges: what closes by its faces closes by its triangles.
pub fn triangulate(tables: &Tables, fineness: &Fineness) -> Result<Mesh, MeshError> {
    triangulate_within(tables, fineness, MOST_POINTS)
}

/// The same with another number of points that a face may have.
pub(super) fn triangulate_within(
    tables: &Tables,
    fineness: &Fineness,
    most: usize,
) -> Result<Mesh, MeshError> {
    let wrong = |what, value| Err(MeshError::Fineness { what, value });
    if !(fineness.chord > 0.0 && fineness.chord.is_finite()) {
        return wrong("chord (m)", fineness.chord);
    }
    if !(fineness.angle > 0.0 && fineness.angle < std::f64::consts::FRAC_PI_2) {
        return wrong("angle (rad)", fineness.angle);
    }
    if let Some(what) = tables.dangling() {
        return Err(MeshError::Tables(what));
    }
    let mut run = Run::new(tables, fineness, most);
    run.faces()?;
    Ok(run.mesh())
}

/// A side between points of edges: these, its face, its two nodes there, and whether it lies within the face.
type Shared = ((usize, usize), usize, [usize; 2], bool);

struct Run<'a> {
    tables: &'a Tables,
    fineness: &'a Fineness,
    /// Points that a face may have.
    most: usize,
    limits: Limits,
    /// By edge; none of those that are points.
    divisions: Vec<Option<Division>>,
    /// By edge: the faces at it.
    at_edges: Vec<Vec<usize>>,
    pieces: Vec<Option<Piece>>,
    /// By face: places in its parameters that must be points.
    forced: Vec<Vec<DVec2>>,
}

impl<'a> Run<'a> {
    fn new(tables: &'a Tables, fineness: &'a Fineness, most: usize) -> Self {
        let limits = Limits::new(fineness);
        let mut at_edges = vec![Vec::new(); tables.edges.len()];
        let mut uses = vec![Vec::new(); tables.edges.len()];
        for (at, face) in tables.faces.iter().enumerate() {
            for of in face.loops.iter().flatten() {
                uses[of.edge].push((at, *of));
                at_edges[of.edge].push(at);
            }
        }
        // What is divided in two by a point of its own is told from others between the same vertices.
        let mut between: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for edge in tables.edges.iter().filter(|edge| edge.curve.is_some()) {
            *between.entry(ordered(edge.start, edge.end)).or_default() += 1;
        }
        let divide = |(at, edge): (usize, &super::tables::Edge)| {
            let curve = &tables.curves[edge.curve?];
            let course = Course {
                curve,
                range: edge.range,
                ends: [edge.start, edge.end].map(|end| tables.vertices[end]),
                sides: uses[at]
                    .iter()
                    .map(|(face, of)| tables.side(*face, of))
                    .collect(),
                limits,
            };
            let mut division = course.divide();
            let others = between
                .get(&ordered(edge.start, edge.end))
                .copied()
                .unwrap_or(0);
            let chords = match (edge.start == edge.end, others > 1) {
                (true, _) => 3,
                (false, true) => 2,
                (false, false) => 1,
            };
            division.at_least(chords, curve);
            Some(division)
        };
        let edges = tables.edges.par_iter().enumerate();
        Self {
            tables,
            fineness,
            most,
            limits,
            divisions: edges.map(divide).collect(),
            at_edges,
            pieces: vec![None; tables.faces.len()],
            forced: vec![Vec::new(); tables.faces.len()],
        }
    }

    fn faces(&mut self) -> Result<(), MeshError> {
        let mut waiting: Vec<usize> = (0..self.tables.faces.len()).collect();
        for round in 0.. {
            let made: Vec<(usize, Result<Piece, Unmade>)> = waiting
                .par_iter()
                .map(|face| (*face, self.job(*face).triangles()))
                .collect();
            let mut coarse = Vec::new();
            let mut stuck = None;
            for (face, made) in made {
                match made {
                    Ok(piece) => self.pieces[face] = Some(piece),
                    Err(Unmade::Coarse(chords)) => {
                        self.pieces[face] = None;
                        if chords.is_empty() {
                            return Err(self.crossing(face));
                        }
                        stuck = stuck.or(Some(face));
                        coarse.extend(chords);
                    }
                    Err(Unmade::Number(uv)) => {
                        let place = self.place(face);
                        return Err(MeshError::Number { face, place, uv });
                    }
                    Err(Unmade::TooMany) => {
                        return Err(MeshError::TooMany {
                            face,
                            place: self.place(face),
                            most: self.most,
                            chord: self.fineness.chord,
                        });
                    }
                }
            }
            waiting = match stuck {
                Some(face) if round >= ROUNDS => return Err(self.crossing(face)),
                Some(face) => self.halve(coarse).ok_or_else(|| self.crossing(face))?,
                None if round >= 2 * ROUNDS => return Ok(()),
                None => self.divide_common_sides(),
            };
            if waiting.is_empty() {
                return Ok(());
            }
        }
        Ok(())
    }

    fn job(&self, face: usize) -> Job<'_> {
        Job {
            tables: self.tables,
            face,
            divisions: &self.divisions,
            forced: &self.forced[face],
            limits: self.limits,
            most: self.most,
        }
    }

    fn place(&self, face: usize) -> DVec3 {
        let first = self.tables.faces[face].loops.iter().flatten().next();
        first.map_or(DVec3::NAN, |of| {
            self.tables.vertices[self.tables.edges[of.edge].start]
        })
    }

    fn crossing(&self, face: usize) -> MeshError {
        MeshError::Crossing {
            face,
            place: self.place(face),
            chord: self.fineness.chord,
        }
    }

    /// Halves chords; returns the faces to be made anew, or nothing if no chord can be halved.
    fn halve(&mut self, mut chords: Vec<(usize, usize)>) -> Option<Vec<usize>> {
        chords.sort_unstable();
        chords.dedup();
        let mut again = Vec::new();
        // From an edge's end, so that the numbers of those before stay.
        for (edge, chord) in chords.into_iter().rev() {
            let curve = self.tables.edges[edge]
                .curve
                .map(|curve| &self.tables.curves[curve]);
            let division = self.divisions[edge].as_mut();
            if let (Some(division), Some(curve)) = (division, curve)
                && division.halve(chord, curve)
            {
                again.extend(&self.at_edges[edge]);
            }
        }
        if again.is_empty() {
            return None;
        }
        again.extend((0..self.pieces.len()).filter(|face| self.pieces[*face].is_none()));
        again.sort_unstable();
        again.dedup();
        Some(again)
    }

    /// Points by what they are: vertices, then edges, then faces.
    fn numbering(&self) -> Numbering {
        let mut next = self.tables.vertices.len();
        let mut edges = Vec::with_capacity(self.divisions.len());
        for division in &self.divisions {
            edges.push(next);
            next += division
                .as_ref()
                .map_or(0, |division| division.chords() - 1);
        }
        let mut faces = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces {
            faces.push(next);
            let nodes = piece.iter().flat_map(|piece| &piece.nodes);
            next += nodes.filter(|node| node.origin == Origin::Inside).count();
        }
        Numbering {
            edges,
            faces,
            count: next,
        }
    }

    /// Asks for a point on each side within a face that has the same two ends as a side of another face. Returns those faces.
    fn divide_common_sides(&mut self) -> Vec<usize> {
        let numbering = self.numbering();
        // Only sides between points of edges can be common.
        let mut sides: Vec<Shared> = Vec::new();
        for (face, piece) in self.pieces.iter().enumerate() {
            let Some(piece) = piece else { continue };
            let points = numbering.points(face, piece);
            for triangle in &piece.triangles {
                let corners = triangle.corners;
                for k in 0..3 {
                    let nodes = [corners[k], corners[(k + 1) % 3]];
                    let [a, b] = nodes.map(|node| points[node]);
                    let is_of_edges = nodes
                        .iter()
                        .all(|node| piece.nodes[*node].origin != Origin::Inside);
                    if a != b && is_of_edges {
                        sides.push((ordered(a, b), face, nodes, triangle.is_free[k]));
                    }
                }
            }
        }
        sides.sort_unstable();
        let mut again = Vec::new();
        for common in sides.chunk_by(|a, b| a.0 == b.0) {
            let has_free = common.iter().any(|side| side.3);
            // Within one face each side is there twice.
            let is_common = common.len() > 2 && has_free;
            if !is_common {
                continue;
            }
            for (_, face, nodes, is_free) in common {
                let Some(piece) = self.pieces[*face].as_ref().filter(|_| *is_free) else {
                    continue;
                };
                let middle = 0.5 * (piece.nodes[nodes[0]].uv + piece.nodes[nodes[1]].uv);
                if !self.forced[*face].contains(&middle) {
                    self.forced[*face].push(middle);
                    again.push(*face);
                }
            }
        }
        again.sort_unstable();
        again.dedup();
        again
    }

    fn mesh(self) -> Mesh {
        let numbering = self.numbering();
        let mut points = self.tables.vertices.clone();
        points.reserve(numbering.count - points.len());
        for division in self.divisions.iter().flatten() {
            points.extend(&division.points[1..division.chords()]);
        }
        let mut faces = Vec::with_capacity(self.pieces.len());
        for (face, piece) in self.pieces.iter().enumerate() {
            let Some(piece) = piece else {
                faces.push(FaceMesh::default());
                continue;
            };
            let numbers = numbering.points(face, piece);
            let inside = piece
                .nodes
                .iter()
                .filter(|node| node.origin == Origin::Inside);
            points.extend(inside.map(|node| node.point));
            let corners = piece.nodes.iter().zip(&piece.normals).zip(&numbers);
            let corners = corners.map(|((node, normal), point)| Corner {
                point: *point,
                uv: node.uv.to_array(),
                normal: normal.unwrap_or(DVec3::Z),
            });
            let triangles = piece.triangles.iter().map(|triangle| triangle.corners);
            faces.push(FaceMesh {
                corners: corners.collect(),
                triangles: without_folds(triangles, &numbers),
            });
        }
        Mesh { points, faces }
    }
}

/// Triangles without those that are nothing. At a pole and at a seam's ends two corners may be one point: then there is nothing between
/// the other two sides. And around a pole, which has many places in the parameters, two triangles of the same three points may lie
/// back to back: without both of them their neighbours meet.
fn without_folds(
    triangles: impl Iterator<Item = [usize; 3]>,
    numbers: &[usize],
) -> Vec<[usize; 3]> {
    let mut kept: Vec<Option<[usize; 3]>> = Vec::new();
    // By points, beginning with the least: where the triangles are that run that way.
    let mut known: HashMap<[usize; 3], Vec<usize>> = HashMap::new();
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| numbers[corner]);
        if a == b || b == c || c == a {
            continue;
        }
        let [a, b, c] = match a.min(b).min(c) {
            least if least == a => [a, b, c],
            least if least == b => [b, c, a],
            _ => [c, a, b],
        };
        if let Some(other) = known.get_mut(&[a, c, b]).and_then(Vec::pop) {
            kept[other] = None;
            continue;
        }
        known.entry([a, b, c]).or_default().push(kept.len());
        kept.push(Some(corners));
    }
    kept.into_iter().flatten().collect()
}

/// The number of the first point of each edge and of each face.
struct Numbering {
    edges: Vec<usize>,
    faces: Vec<usize>,
    count: usize,
}

impl Numbering {
    /// The points of a piece's nodes.
    fn points(&self, face: usize, piece: &Piece) -> Vec<usize> {
        let mut inside = self.faces[face];
        let number = |origin| match origin {
            Origin::Vertex(vertex) => vertex,
            Origin::Edge(edge, chord) => self.edges[edge] + chord - 1,
            Origin::Inside => {
                inside += 1;
                inside - 1
            }
        };
        piece
            .nodes
            .iter()
            .map(|node| node.origin)
            .map(number)
            .collect()
    }
}
