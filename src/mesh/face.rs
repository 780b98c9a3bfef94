//! Triangles of one face: its polygons, a grid of its surface's lines, and points where these are not fine enough.

use std::cell::OnceCell;
use std::collections::HashSet;

use glam::{DVec2, DVec3};

use super::divide::Division;
use super::fineness::Limits;
use super::grid;
use super::lines::lines;
use super::outline::{Node, Origin, Outline};
use super::planar::{Inside, Planar, Refusal, ordered};
use super::tables::{Support, Tables};

/// Triangles of a face, counter-clockwise seen against its surface's normal.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) nodes: Vec<Node>,
    /// By node.
    pub(super) normals: Vec<Option<DVec3>>,
    pub(super) triangles: Vec<Inside>,
}

/// Why a face has no triangles yet.
pub(super) enum Unmade {
    /// Chords of edges that must be halved first.
    Coarse(Vec<(usize, usize)>),
    /// Parameters that are no numbers.
    Number(DVec2),
    /// More points than allowed.
    TooMany,
}

/// Passes of refinement.
const PASSES: usize = 40;

/// A face to be triangulated.
pub(super) struct Job<'a> {
    pub(super) tables: &'a Tables,
    pub(super) face: usize,
    pub(super) divisions: &'a [Option<Division>],
    /// Places in its parameters that must be points.
    pub(super) forced: &'a [DVec2],
    pub(super) limits: Limits,
    /// Points that it may have.
    pub(super) most: usize,
}

impl Job<'_> {
    pub(super) fn triangles(&self) -> Result<Piece, Unmade> {
        let support = &self.tables.surfaces[self.tables.faces[self.face].surface];
        let mut outline = Outline::new(self.tables, self.face, self.divisions);
        let (low, high) = (outline.low, outline.high);
        if outline.segments.is_empty() {
            return Ok(Piece {
                nodes: Vec::new(),
                normals: Vec::new(),
                triangles: Vec::new(),
            });
        }
        let (mut inner, mut scale) = (Vec::new(), DVec2::ONE);
        if let Support::Spline(surface) = support {
            let lines = lines(surface, [low.x, high.x], [low.y, high.y], &self.limits);
            outline.divide_poles(&lines);
            if lines[0].len().saturating_mul(lines[1].len()) > self.most {
                return Err(Unmade::TooMany);
            }
            inner = grid::inside(&lines, &outline);
            scale = DVec2::new(cells(&lines[0]), cells(&lines[1]));
        }
        let planar = Planar::new(&outline.nodes, &outline.segments, low, scale);
        let mut mesher = Mesher {
            support,
            limits: self.limits,
            planar: planar.map_err(|refusal| match refusal {
                Refusal::Coarse(chords) => Unmade::Coarse(chords),
                Refusal::Number(uv) => Unmade::Number(uv),
            })?,
            normals: (0..outline.nodes.len()).map(|_| OnceCell::new()).collect(),
            nodes: outline.nodes,
            most: self.most,
        };
        for uv in inner.iter().chain(self.forced) {
            mesher.insert(*uv, None);
        }
        let triangles = mesher.refine()?;
        let normals = (0..mesher.nodes.len()).map(|at| mesher.shown_normal(at, &triangles));
        Ok(Piece {
            normals: normals.collect(),
            nodes: mesher.nodes,
            triangles,
        })
    }
}

/// How many cells of lines there are per unit of a parameter.
fn cells(lines: &[f64]) -> f64 {
    let size = lines[lines.len() - 1] - lines[0];
    if size > 0.0 {
        (lines.len() - 1) as f64 / size
    } else {
        1.0
    }
}

struct Mesher<'a> {
    support: &'a Support,
    limits: Limits,
    planar: Planar,
    nodes: Vec<Node>,
    normals: Vec<OnceCell<Option<DVec3>>>,
    most: usize,
}

impl Mesher<'_> {
    fn insert(&mut self, uv: DVec2, near: Option<usize>) -> bool {
        let node = Node {
            uv,
            point: self.support.point(uv),
            origin: Origin::Inside,
        };
        let is_new = self.planar.insert_inside(self.nodes.len(), &node, near);
        if is_new {
            self.nodes.push(node);
            self.normals.push(OnceCell::new());
        }
        is_new
    }

    fn normal(&self, at: usize) -> Option<DVec3> {
        *self.normals[at].get_or_init(|| self.support.normal(self.nodes[at].uv))
    }

    fn place(&self, at: usize) -> (DVec2, DVec3) {
        (self.nodes[at].uv, self.nodes[at].point)
    }

    /// Adds points where triangles are too far from the surface, or it turns too much along their sides, until none are.
    fn refine(&mut self) -> Result<Vec<Inside>, Unmade> {
        let mut sides = HashSet::new();
        let mut middles = HashSet::new();
        let mut triangles = self.planar.inside();
        for _ in 0..PASSES {
            let mut wanted: Vec<(DVec2, usize)> = Vec::new();
            for triangle in &triangles {
                let [a, b, c] = triangle.corners;
                let mut is_good = true;
                for ((from, to), is_free) in
                    [(a, b), (b, c), (c, a)].into_iter().zip(triangle.is_free)
                {
                    let pair = ordered(from, to);
                    // A side is asked by the first of its triangles.
                    if is_free && sides.insert(pair) && !self.side_holds(pair) {
                        wanted.push((0.5 * (self.nodes[from].uv + self.nodes[to].uv), from));
                        is_good = false;
                    }
                }
                let mut corners = [a, b, c];
                corners.sort_unstable();
                if is_good
                    && !middles.contains(&corners)
                    && !self
                        .limits
                        .middle_holds(self.support, corners.map(|at| self.place(at)))
                {
                    let middle = corners.iter().map(|at| self.nodes[*at].uv).sum::<DVec2>() / 3.0;
                    wanted.push((middle, a));
                }
                if is_good {
                    middles.insert(corners);
                }
            }
            let mut is_finer = false;
            for (uv, near) in wanted {
                is_finer |= self.insert(uv, Some(near));
                if self.nodes.len() > self.most {
                    return Err(Unmade::TooMany);
                }
            }
            if !is_finer {
                break;
            }
            triangles = self.planar.inside();
        }
        Ok(triangles)
    }

    fn side_holds(&self, (a, b): (usize, usize)) -> bool {
        let ends = [self.place(a), self.place(b)];
        let length = ends[0].1.distance(ends[1].1);
        if matches!(self.support, Support::Plane { .. }) {
            return true;
        }
        self.limits
            .turns_little(length, self.normal(a), self.normal(b))
            && self.limits.chord_holds(self.support, ends)
    }

    /// The normal to show at a node: beside it, towards the middle of a triangle, where the surface has none there.
    fn shown_normal(&self, at: usize, triangles: &[Inside]) -> Option<DVec3> {
        const BESIDE: f64 = 1e-3;
        self.normal(at).or_else(|| {
            let triangle = triangles
                .iter()
                .find(|triangle| triangle.corners.contains(&at))?;
            let corners = triangle.corners.map(|corner| self.nodes[corner]);
            let middle = (corners[0].uv + corners[1].uv + corners[2].uv) / 3.0;
            self.support
                .normal(self.nodes[at].uv.lerp(middle, BESIDE))
                .or_else(|| {
                    let [a, b, c] = corners.map(|corner| corner.point);
                    (b - a).cross(c - a).try_normalize()
                })
        })
    }
}
