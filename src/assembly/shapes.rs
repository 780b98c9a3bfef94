//! Shells as the kernel's topology: shared vertices and edges, several faces on one surface.
//!
//! A trough's base and top are cut into a few faces along the trajectory (long faces are where the
//! general fuse fails first), all on the same surface, with shared edges and exact straight pcurves.
//! Where the trough runs far out of the domain its ends are left off, at sections, where it is flat.

use glam::DVec3;

use super::closed;
use super::kernel::{Edge, EdgeUse, Face, Surface, Topology};
use super::splines::{EXACT, along_u, along_v, curve, spline};
use crate::features::body::{Role, Trough};
use crate::nurbs;

/// How a body is cut for the kernel. None of it changes the shape inside the domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut {
    /// Faces of a trough's base and top along the trajectory, or of a closed surface around it.
    pub(crate) segments: usize,
    /// Sections kept beyond the last one whose span meets the domain.
    pub(crate) overshoot: usize,
}

/// The closed shell of a trough, its ends outside the box `low`–`high` left off.
///
/// With a `level` the top is the plane at this elevation.
pub(crate) fn trough(trough: &Trough, block: [DVec3; 2], cut: Cut, level: Option<f64>) -> Topology {
    let [first, last] = ends(trough, block, cut.overshoot);
    let cuts = cuts(trough.base().knots_v(), first, last, cut.segments);
    Builder::new(trough, &cuts, level).build()
}

/// The topology of one whole sheet as a face, for files of surfaces.
pub(crate) fn sheet(role: Role, surface: &nurbs::Surface) -> Topology {
    // A skin may be a part of the closed surface: what warps one cuts it where it could have creases.
    match role {
        Role::Skin if is_closed(surface) => closed::shell(surface, 1),
        _ => open_sheet(surface),
    }
}

/// Whether a surface is all of a closed one: a seam where u begins and ends, a point at either end of v.
fn is_closed(surface: &nurbs::Surface) -> bool {
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    let [first, last] = [u0, u1].map(|u| surface.isocurve_u(u));
    let mut points = first.points().iter().zip(last.points());
    // Rows of one net: as many points in both.
    let is_seam = first.weights() == last.weights() && points.all(|(a, b)| a.distance(*b) <= EXACT);
    is_seam && [v0, v1].iter().all(|v| is_pole(&surface.isocurve_v(*v)))
}

/// Whether a side is a point.
fn is_pole(side: &nurbs::Curve) -> bool {
    let points = side.points();
    points.iter().all(|p| p.distance(points[0]) <= EXACT)
}

fn open_sheet(surface: &nurbs::Surface) -> Topology {
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    let corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)];
    let sides = [
        surface.isocurve_v(v0),
        surface.isocurve_u(u1),
        surface.isocurve_v(v1),
        surface.isocurve_u(u0),
    ];
    // The sides from corner to corner, as the edges run. At a side that is a point both of its corners are one vertex, or the
    // loop would be open where readers leave out the edge that has no length.
    let ends = [(0, 1), (1, 2), (3, 2), (0, 3)];
    let mut vertex = [0, 1, 2, 3];
    for (side, (start, end)) in sides.iter().zip(ends) {
        if is_pole(side) {
            let (kept, other) = (vertex[start], vertex[end]);
            for own in &mut vertex {
                if *own == other {
                    *own = kept;
                }
            }
        }
    }
    // Corners that are left, numbered without gaps.
    let mut kept: Vec<usize> = vertex.to_vec();
    kept.sort_unstable();
    kept.dedup();
    let number = |corner: usize| kept.partition_point(|k| *k < vertex[corner]);
    let edge = |side: usize, range: (f64, f64)| Edge {
        curve: side,
        range: [range.0, range.1],
        start: number(ends[side].0),
        end: number(ends[side].1),
    };
    let edges = vec![
        edge(0, (u0, u1)),
        edge(1, (v0, v1)),
        edge(2, (u0, u1)),
        edge(3, (v0, v1)),
    ];
    let uses = vec![
        along_u(0, v0, false),
        along_v(1, u1, false),
        along_u(2, v1, true),
        along_v(3, u0, true),
    ];
    Topology {
        vertices: kept
            .iter()
            .map(|corner| corners[*corner])
            .map(|(u, v)| surface.point(u, v).to_array())
            .collect(),
        curves: sides.iter().map(curve).collect(),
        surfaces: vec![spline(surface)],
        edges,
        faces: vec![Face {
            surface: 0,
            reversed: false,
            loops: vec![uses],
        }],
        tolerance: EXACT,
    }
}

/// The range of v that matters: from and to a section.
pub(super) fn ends(trough: &Trough, [low, high]: [DVec3; 2], overshoot: usize) -> [f64; 2] {
    let base = trough.base();
    let (start, end) = base.knots_v().domain();
    let knots = base.knots_v().as_slice();
    let (p, nu, nv) = (
        base.knots_v().degree(),
        base.knots_u().count(),
        base.knots_v().count(),
    );
    // A span of v lies in the hull of the p + 1 columns that influence it.
    let meets = |span: &usize| {
        let columns = span - p..=*span;
        let points = columns.flat_map(|j| (0..nu).map(move |i| base.net()[i * nv + j]));
        let (a, b) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(a, b), q| {
            (a.min(q), b.max(q))
        });
        knots[*span] < knots[span + 1] && a.cmplt(high).all() && b.cmpgt(low).all()
    };
    let inside: Vec<usize> = (p..nv).filter(meets).collect();
    let (Some(&first), Some(&last)) = (inside.first(), inside.last()) else {
        return [start, end];
    };
    let sections = trough.sections();
    let before = sections
        .partition_point(|v| *v <= knots[first])
        .saturating_sub(1 + overshoot);
    let after =
        (sections.partition_point(|v| *v < knots[last + 1]) + overshoot).min(sections.len() - 1);
    [sections[before], sections[after]]
}

/// Where the faces are cut: the two ends, and knots as evenly between as they lie.
fn cuts(knots: &nurbs::KnotVector, first: f64, last: f64, segments: usize) -> Vec<f64> {
    let between: Vec<f64> = knots
        .distinct()
        .iter()
        .map(|k| k.0)
        .filter(|v| *v > first && *v < last)
        .collect();
    let mut cuts = vec![first];
    for k in 1..segments {
        let even = first + (last - first) * k as f64 / segments as f64;
        let nearest = between
            .iter()
            .copied()
            .min_by(|a, b| (a - even).abs().total_cmp(&(b - even).abs()));
        if let Some(v) = nearest.filter(|v| *v > cuts[cuts.len() - 1]) {
            cuts.push(v);
        }
    }
    cuts.push(last);
    cuts
}

/// Lays out a trough's shell: per cut `k` two vertices, a section edge and a top edge; per segment two
/// rim edges, a base face and a top face; two end faces.
struct Builder<'a> {
    trough: &'a Trough,
    cuts: &'a [f64],
    topology: Topology,
}

impl<'a> Builder<'a> {
    fn new(trough: &'a Trough, cuts: &'a [f64], level: Option<f64>) -> Self {
        let top = match level {
            None => spline(trough.top()),
            Some(level) => Surface::Plane {
                origin: [0.0, 0.0, level],
                normal: [0.0, 0.0, 1.0],
                x_axis: [1.0, 0.0, 0.0],
            },
        };
        let topology = Topology {
            vertices: Vec::new(),
            curves: Vec::new(),
            surfaces: vec![spline(trough.base()), top],
            edges: Vec::new(),
            faces: Vec::new(),
            tolerance: EXACT,
        };
        Self {
            trough,
            cuts,
            topology,
        }
    }

    fn build(mut self) -> Topology {
        self.edges();
        self.long_faces();
        self.end_faces();
        self.topology
    }

    // Numbering of edges: sections 0..n, tops n..2n, left rims 2n.., right rims 2n + (n−1)...
    fn section(k: usize) -> usize {
        k
    }
    fn top_line(&self, k: usize) -> usize {
        self.cuts.len() + k
    }
    fn rim(&self, side: usize, k: usize) -> usize {
        2 * self.cuts.len() + side * (self.cuts.len() - 1) + k
    }

    fn edges(&mut self) {
        let (base, rims) = (self.trough.base(), self.trough.rims());
        let (u0, u1) = base.knots_u().domain();
        let t = &mut self.topology;
        t.curves.extend(rims.iter().map(curve));
        for &v in self.cuts {
            t.vertices
                .extend(rims.iter().map(|rim| rim.point(v).to_array()));
        }
        for (k, &v) in self.cuts.iter().enumerate() {
            t.curves.push(curve(&base.isocurve_v(v)));
            t.edges.push(Edge {
                curve: 2 + k,
                range: [u0, u1],
                start: 2 * k,
                end: 2 * k + 1,
            });
        }
        let (s0, s1) = self.trough.top().knots_u().domain();
        for (k, &v) in self.cuts.iter().enumerate() {
            t.curves.push(curve(&self.trough.top().isocurve_v(v)));
            let curve = 2 + self.cuts.len() + k;
            t.edges.push(Edge {
                curve,
                range: [s0, s1],
                start: 2 * k,
                end: 2 * k + 1,
            });
        }
        for side in 0..2 {
            for (k, v) in self.cuts.windows(2).enumerate() {
                let (start, end) = (2 * k + side, 2 * k + 2 + side);
                t.edges.push(Edge {
                    curve: side,
                    range: [v[0], v[1]],
                    start,
                    end,
                });
            }
        }
    }

    /// Base and top of every segment. u runs to the right and v forwards, so both normals point up: the
    /// base's outside is below it.
    fn long_faces(&mut self) {
        let sheets = [(self.trough.base(), true), (self.trough.top(), false)];
        for (surface, (sheet, reversed)) in sheets.into_iter().enumerate() {
            let is_plane = matches!(self.topology.surfaces[surface], Surface::Plane { .. });
            let (u0, u1) = sheet.knots_u().domain();
            for (k, v) in self.cuts.windows(2).enumerate() {
                let across = |k| {
                    if surface == 0 {
                        Self::section(k)
                    } else {
                        self.top_line(k)
                    }
                };
                let mut uses = vec![
                    along_u(across(k), v[0], false),
                    along_v(self.rim(1, k), u1, false),
                    along_u(across(k + 1), v[1], true),
                    along_v(self.rim(0, k), u0, true),
                ];
                if is_plane {
                    for one in &mut uses {
                        one.pcurve = None;
                    }
                }
                self.topology.faces.push(Face {
                    surface,
                    reversed,
                    loops: vec![uses],
                });
            }
        }
    }

    /// The flat, upright ends, bounded by a section and a top line.
    fn end_faces(&mut self) {
        let last = self.cuts.len() - 1;
        for (k, backwards) in [(0, true), (last, false)] {
            let corner = |side: usize| DVec3::from_array(self.topology.vertices[2 * k + side]);
            let right = (corner(1) - corner(0)).normalize_or(DVec3::X);
            let forward = DVec3::Z.cross(right);
            let (normal, x_axis) = if backwards {
                (-forward, right)
            } else {
                (forward, -right)
            };
            let origin = corner(0).to_array();
            self.topology.surfaces.push(Surface::Plane {
                origin,
                normal: normal.to_array(),
                x_axis: x_axis.to_array(),
            });
            let on_plane = |edge, reversed| EdgeUse {
                edge,
                reversed,
                pcurve: None,
            };
            // Counterclockwise about the outward normal.
            let uses = if backwards {
                vec![
                    on_plane(Self::section(k), false),
                    on_plane(self.top_line(k), true),
                ]
            } else {
                vec![
                    on_plane(self.top_line(k), false),
                    on_plane(Self::section(k), true),
                ]
            };
            let surface = self.topology.surfaces.len() - 1;
            self.topology.faces.push(Face {
                surface,
                reversed: false,
                loops: vec![uses],
            });
        }
    }
}
