//! A face's loops as polygons in its surface's parameters: nodes on edges, each with the point that all faces there share.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::divide::Division;
use super::tables::Tables;

/// What a node is, whatever face it belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Origin {
    /// A vertex.
    Vertex(usize),
    /// The end of so many chords of an edge.
    Edge(usize, usize),
    /// A point inside the face.
    Inside,
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) uv: DVec2,
    pub(super) point: DVec3,
    pub(super) origin: Origin,
}

/// A side of the polygons.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) from: usize,
    pub(super) to: usize,
    /// The edge, and which of its chords it is; none along the pole of a surface, which is one point.
    pub(super) of: Option<(usize, usize)>,
}

/// The loops of a face.
pub(super) struct Outline {
    pub(super) nodes: Vec<Node>,
    pub(super) segments: Vec<Segment>,
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

/// Places of one vertex in the parameters are one if they are closer than this share of the face: curves meet to some 1e-9. Others are
/// a seam's two, or the two ends of a pole.
const SAME: f64 = 1e-5;

impl Outline {
    /// The loops of a face, by the divisions of its edges.
    pub(super) fn new(tables: &Tables, face: usize, divisions: &[Option<Division>]) -> Self {
        let loops: Vec<Vec<Run>> = tables.faces[face]
            .loops
            .iter()
            .map(|uses| {
                let runs = uses.iter().filter_map(|of| {
                    let division = divisions[of.edge].as_ref()?;
                    Some(Run::new(tables, face, of, division))
                });
                runs.collect()
            })
            .collect();
        let all = loops.iter().flatten().flat_map(|run| &run.nodes);
        let (low, high) = all.fold(
            (DVec2::INFINITY, DVec2::NEG_INFINITY),
            |(low, high), node| (low.min(node.uv), high.max(node.uv)),
        );
        let mut outline = Self {
            nodes: Vec::new(),
            segments: Vec::new(),
            low,
            high,
        };
        let mut at_vertices = BTreeMap::new();
        for runs in &loops {
            outline.add(runs, &mut at_vertices);
        }
        outline
    }

    fn is_same(&self, a: DVec2, b: DVec2) -> bool {
        ((a - b).abs() - SAME * (self.high - self.low)).max_element() <= 0.0
    }

    /// The node of a place; that of its vertex, if it is there already.
    fn node(&mut self, node: Node, at_vertices: &mut BTreeMap<usize, Vec<usize>>) -> usize {
        if let Origin::Vertex(vertex) = node.origin {
            let known = at_vertices.entry(vertex).or_default();
            let same = known
                .iter()
                .find(|known| self.is_same(self.nodes[**known].uv, node.uv));
            if let Some(same) = same {
                return *same;
            }
            known.push(self.nodes.len());
        }
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn add(&mut self, runs: &[Run], at_vertices: &mut BTreeMap<usize, Vec<usize>>) {
        let mut last: Option<usize> = None;
        let mut first = None;
        for run in runs {
            for (at, node) in run.nodes.iter().enumerate() {
                let here = self.node(*node, at_vertices);
                first = first.or(Some(here));
                let of = at.checked_sub(1).map(|chord| (run.edge, run.chord(chord)));
                self.segment(last, here, of);
                last = Some(here);
            }
        }
        if let Some(first) = first {
            self.segment(last, first, None);
        }
    }

    fn segment(&mut self, from: Option<usize>, to: usize, of: Option<(usize, usize)>) {
        if let Some(from) = from.filter(|from| *from != to) {
            self.segments.push(Segment { from, to, of });
        }
    }

    /// Divides what runs along poles at lines of equal u and v.
    pub(super) fn divide_poles(&mut self, lines: &[Vec<f64>; 2]) {
        for at in 0..self.segments.len() {
            let Segment { from, to, of } = self.segments[at];
            if of.is_some() {
                continue;
            }
            let (a, b) = (self.nodes[from], self.nodes[to]);
            let along = usize::from((b.uv - a.uv).y.abs() > (b.uv - a.uv).x.abs());
            let (start, end) = (a.uv[along], b.uv[along]);
            let mut between: Vec<f64> = lines[along]
                .iter()
                .map(|line| (line - start) / (end - start))
                .filter(|share| (0.01..0.99).contains(share))
                .collect();
            between.sort_by(f64::total_cmp);
            let mut last = from;
            for share in between {
                let next = self.nodes.len();
                let uv = a.uv.lerp(b.uv, share);
                self.nodes.push(Node { uv, ..a });
                self.segments.push(Segment {
                    from: last,
                    to: next,
                    of,
                });
                last = next;
            }
            self.segments[at].from = last;
        }
    }
}

/// An edge as a loop runs along it.
struct Run {
    edge: usize,
    reversed: bool,
    nodes: Vec<Node>,
}

impl Run {
    fn new(tables: &Tables, face: usize, of: &super::tables::Use, division: &Division) -> Self {
        let edge = tables.edges[of.edge];
        let side = tables.side(face, of);
        let last = division.chords();
        let places = division.parameters.iter().zip(&division.points).enumerate();
        let mut nodes: Vec<Node> = places
            .map(|(at, (t, point))| Node {
                uv: side.at(*t, *point),
                point: *point,
                origin: match at {
                    0 => Origin::Vertex(edge.start),
                    _ if at == last => Origin::Vertex(edge.end),
                    _ => Origin::Edge(of.edge, at),
                },
            })
            .collect();
        if of.reversed {
            nodes.reverse();
        }
        Self {
            edge: of.edge,
            reversed: of.reversed,
            nodes,
        }
    }

    /// The edge's chord that is this one of the run.
    fn chord(&self, at: usize) -> usize {
        if self.reversed {
            self.nodes.len() - 2 - at
        } else {
            at
        }
    }
}
