//! Shapes whose volumes are known in closed form, as tables.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::{DVec2, DVec3};

use crate::mesh::{Edge, Face, Path, Support, Tables, Use};
use crate::nurbs::{Curve, KnotVector, Surface};

/// Lays out tables piece by piece.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) tables: Tables,
}

impl Builder {
    fn vertex(&mut self, point: DVec3) -> usize {
        self.tables.vertices.push(point);
        self.tables.vertices.len() - 1
    }

    fn edge(&mut self, curve: Path, range: [f64; 2], [start, end]: [usize; 2]) -> usize {
        self.tables.curves.push(curve);
        let curve = Some(self.tables.curves.len() - 1);
        let edge = Edge {
            curve,
            range,
            start,
            end,
        };
        self.tables.edges.push(edge);
        self.tables.edges.len() - 1
    }

    fn spline(&mut self, curve: Curve, ends: [usize; 2]) -> usize {
        let (from, to) = curve.domain();
        self.edge(Path::Spline(curve), [from, to], ends)
    }

    fn line(&mut self, ends: [usize; 2]) -> usize {
        let [a, b] = ends.map(|end| self.tables.vertices[end]);
        let length = a.distance(b);
        let path = Path::Line {
            origin: a,
            direction: (b - a) / length,
        };
        self.edge(path, [0.0, length], ends)
    }

    fn pole(&mut self, vertex: usize) -> usize {
        let edge = Edge {
            curve: None,
            range: [0.0, 1.0],
            start: vertex,
            end: vertex,
        };
        self.tables.edges.push(edge);
        self.tables.edges.len() - 1
    }

    fn surface(&mut self, surface: Support) -> usize {
        self.tables.surfaces.push(surface);
        self.tables.surfaces.len() - 1
    }

    fn plane(&mut self, origin: DVec3, x_axis: DVec3, y_axis: DVec3) -> usize {
        self.surface(Support::Plane {
            origin,
            x_axis,
            y_axis,
        })
    }

    /// On a plane.
    fn flat(edge: usize, reversed: bool) -> Use {
        Use {
            edge,
            reversed,
            pcurve: None,
        }
    }

    /// Along `origin + t direction` in the parameters.
    fn on(&mut self, edge: usize, reversed: bool, origin: DVec2, direction: DVec2) -> Use {
        let path = Path::Line {
            origin: origin.extend(0.0),
            direction: direction.extend(0.0),
        };
        self.tables.pcurves.push(path);
        let pcurve = Some(self.tables.pcurves.len() - 1);
        Use {
            edge,
            reversed,
            pcurve,
        }
    }

    fn face(&mut self, surface: usize, loops: Vec<Vec<Use>>) {
        self.tables.faces.push(Face { surface, loops });
    }
}

/// Corners and weights of a whole circle by four quadratic arcs, parameters 0 to 4.
fn circle_net() -> ([DVec2; 9], [f64; 9]) {
    let h = FRAC_1_SQRT_2;
    let net = [
        (1.0, 0.0),
        (1.0, 1.0),
        (0.0, 1.0),
        (-1.0, 1.0),
        (-1.0, 0.0),
        (-1.0, -1.0),
        (0.0, -1.0),
        (1.0, -1.0),
        (1.0, 0.0),
    ];
    (
        net.map(|(x, y)| DVec2::new(x, y)),
        [1.0, h, 1.0, h, 1.0, h, 1.0, h, 1.0],
    )
}

fn circle_knots() -> KnotVector {
    KnotVector::new(
        2,
        vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0],
    )
    .unwrap()
}

/// Straight lines from one curve to another: u along them, v from the first to the second.
fn between(a: &Curve, b: &Curve) -> Surface {
    Surface::ruled(a, b).unwrap().transposed()
}

fn circle(radius: f64, z: f64) -> Curve {
    let (net, weights) = circle_net();
    let points = net.iter().map(|at| (radius * *at).extend(z)).collect();
    Curve::rational(circle_knots(), points, weights.to_vec()).unwrap()
}

pub(super) fn block(corner: DVec3, size: DVec3) -> Tables {
    let mut b = Builder::default();
    let at = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
    for i in 0..8 {
        b.vertex(corner + at(i) * size);
    }
    // Edges by their two corners, the smaller first.
    let mut edges = std::collections::BTreeMap::new();
    for i in 0..8_usize {
        for bit in [1, 2, 4] {
            if i & bit == 0 {
                edges.insert((i, i | bit), b.line([i, i | bit]));
            }
        }
    }
    // Counter-clockwise seen from outside.
    for [p, q, r, s] in [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ] {
        let point = |i: usize| b.tables.vertices[i];
        let axis = |to: usize| (point(to) - point(p)).normalize();
        let (x, y, origin) = (axis(q), axis(s), point(p));
        let surface = b.plane(origin, x, y);
        let sides = [(p, q), (q, r), (r, s), (s, p)].map(|(from, to)| {
            let edge = edges[&(from.min(to), from.max(to))];
            Builder::flat(edge, from > to)
        });
        b.face(surface, vec![sides.to_vec()]);
    }
    b.tables
}

/// One face between two poles, closed along a seam.
pub(super) fn ball(centre: DVec3, radius: f64) -> Tables {
    let h = FRAC_1_SQRT_2;
    let meridian = [
        (0.0, -1.0, 1.0),
        (1.0, -1.0, h),
        (1.0, 0.0, 1.0),
        (1.0, 1.0, h),
        (0.0, 1.0, 1.0),
    ];
    let (round, weights) = circle_net();
    let across = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]).unwrap();
    let net = round
        .iter()
        .flat_map(|at| meridian.map(|(r, z, _)| centre + radius * (r * *at).extend(z)));
    let net = net.collect();
    let weights = weights
        .iter()
        .flat_map(|a| meridian.map(|(_, _, b)| a * b))
        .collect();
    let surface = Surface::rational(circle_knots(), across, net, weights).unwrap();
    let mut b = Builder::default();
    let ends = [
        b.vertex(centre - radius * DVec3::Z),
        b.vertex(centre + radius * DVec3::Z),
    ];
    let seam = b.spline(surface.isocurve_u(0.0), ends);
    let (south, north) = (b.pole(ends[0]), b.pole(ends[1]));
    let of = b.surface(Support::Spline(surface));
    let sides = vec![
        Builder::flat(south, false),
        b.on(seam, false, DVec2::new(4.0, 0.0), DVec2::Y),
        Builder::flat(north, false),
        b.on(seam, true, DVec2::ZERO, DVec2::Y),
    ];
    b.face(of, vec![sides]);
    b.tables
}

/// An upright cylinder about the z axis, with a round hole in its middle if asked.
pub(super) fn drum(radius: f64, hole: Option<f64>, height: f64) -> Tables {
    let mut b = Builder::default();
    let mut loops: [Vec<Vec<Use>>; 2] = [Vec::new(), Vec::new()];
    for (radius, is_hole) in [Some((radius, false)), hole.map(|hole| (hole, true))]
        .into_iter()
        .flatten()
    {
        let rims = [0.0, height].map(|z| circle(radius, z));
        let ends = [0.0, height].map(|z| b.vertex(DVec3::new(radius, 0.0, z)));
        let wall = between(&rims[0], &rims[1]);
        let (v0, v1) = wall.knots_v().domain();
        let [low, high] = [0, 1].map(|k| b.spline(rims[k].clone(), [ends[k]; 2]));
        let seam = b.line(ends);
        // The wall looks away from the axis; the hole's is the same surface with u the other way round.
        let up = DVec2::new(0.0, (v1 - v0) / height);
        if is_hole {
            let wall = wall.reversed_u();
            let of = b.surface(Support::Spline(wall));
            let back = DVec2::new(-1.0, 0.0);
            let sides = vec![
                b.on(low, true, DVec2::new(4.0, v0), back),
                b.on(seam, false, DVec2::new(4.0, v0), up),
                b.on(high, false, DVec2::new(4.0, v1), back),
                b.on(seam, true, DVec2::new(0.0, v0), up),
            ];
            b.face(of, vec![sides]);
        } else {
            let of = b.surface(Support::Spline(wall));
            let sides = vec![
                b.on(low, false, DVec2::new(0.0, v0), DVec2::X),
                b.on(seam, false, DVec2::new(4.0, v0), up),
                b.on(high, true, DVec2::new(0.0, v1), DVec2::X),
                b.on(seam, true, DVec2::new(0.0, v0), up),
            ];
            b.face(of, vec![sides]);
        }
        loops[0].push(vec![Builder::flat(low, !is_hole)]);
        loops[1].push(vec![Builder::flat(high, is_hole)]);
    }
    let [bottom, top] = loops;
    let of = b.plane(DVec3::ZERO, DVec3::Y, DVec3::X);
    b.face(of, bottom);
    let of = b.plane(DVec3::Z * height, DVec3::X, DVec3::Y);
    b.face(of, top);
    b.tables
}

/// A parabola from one place to another in the plane of z, bowed in the direction of +y.
fn bow(half: f64, rise: f64, z: f64) -> Curve {
    let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]).unwrap();
    let net = vec![
        DVec3::new(-half, 0.0, z),
        DVec3::new(0.0, 2.0 * rise, z),
        DVec3::new(half, 0.0, z),
    ];
    Curve::new(knots, net).unwrap()
}

/// An upright prism over what lies between two parabolas from (−half, 0) to (half, 0): bottom, top, and the two walls.
pub(super) fn crescent(half: f64, rise: f64, gap: f64, height: f64) -> Tables {
    let mut b = Builder::default();
    let corners =
        [0.0, height].map(|z| [-1.0, 1.0].map(|x| b.vertex(DVec3::new(x * half, 0.0, z))));
    // The inner one has its knots elsewhere, so that it is divided elsewhere.
    let inner = |z: f64| bow(half, rise - gap, z).refine(&[0.37, 0.71]).unwrap();
    let outer = |z: f64| bow(half, rise, z);
    let lows = [
        b.spline(inner(0.0), corners[0]),
        b.spline(outer(0.0), corners[0]),
    ];
    let highs = [
        b.spline(inner(height), corners[1]),
        b.spline(outer(height), corners[1]),
    ];
    let posts = [0, 1].map(|k| b.line([corners[0][k], corners[1][k]]));
    let of = b.plane(DVec3::ZERO, DVec3::Y, DVec3::X);
    b.face(
        of,
        vec![vec![
            Builder::flat(lows[0], true),
            Builder::flat(lows[1], false),
        ]],
    );
    let of = b.plane(DVec3::Z * height, DVec3::X, DVec3::Y);
    b.face(
        of,
        vec![vec![
            Builder::flat(highs[0], false),
            Builder::flat(highs[1], true),
        ]],
    );
    for (k, (low, high)) in [(inner(0.0), inner(height)), (outer(0.0), outer(height))]
        .into_iter()
        .enumerate()
    {
        let wall = between(&low, &high);
        let up = DVec2::new(0.0, 1.0 / height);
        // u goes along +x, so that the normal looks to −y: out of the inner wall, and into the outer one.
        if k == 0 {
            let of = b.surface(Support::Spline(wall));
            let sides = vec![
                b.on(lows[0], false, DVec2::ZERO, DVec2::X),
                b.on(posts[1], false, DVec2::X, up),
                b.on(highs[0], true, DVec2::Y, DVec2::X),
                b.on(posts[0], true, DVec2::ZERO, up),
            ];
            b.face(of, vec![sides]);
        } else {
            let of = b.surface(Support::Spline(wall.reversed_u()));
            let sides = vec![
                b.on(lows[1], true, DVec2::X, -DVec2::X),
                b.on(posts[0], false, DVec2::X, up),
                b.on(highs[1], false, DVec2::ONE, -DVec2::X),
                b.on(posts[1], true, DVec2::ZERO, up),
            ];
            b.face(of, vec![sides]);
        }
    }
    b.tables
}

/// A straight trough with a parabola as its section under a flat top: base, top, and the two ends.
pub(super) fn slab(width: f64, length: f64, depth: f64) -> Tables {
    let mut b = Builder::default();
    let knots = || KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]).unwrap();
    let section = |y: f64| {
        let net = [(-0.5, 0.0), (0.0, -2.0), (0.5, 0.0)]
            .map(|(x, z)| DVec3::new(x * width, y, z * depth));
        Curve::new(knots(), net.to_vec()).unwrap()
    };
    let base = between(&section(0.0), &section(length));
    let corners =
        [0.0, length].map(|y| [-0.5, 0.5].map(|x| b.vertex(DVec3::new(x * width, y, 0.0))));
    let sections = [0, 1].map(|k| b.spline(section(length * k as f64), corners[k]));
    let across = [0, 1].map(|k| b.line(corners[k]));
    // The rims are splines of many spans, so that they have many points.
    let rims = [0, 1].map(|k| {
        let (from, to) = (
            b.tables.vertices[corners[0][k]],
            b.tables.vertices[corners[1][k]],
        );
        let wiggle = |t: f64| from.lerp(to, t);
        let own = Curve::new(knots(), vec![from, wiggle(0.5), to]).unwrap();
        b.spline(own, [corners[0][k], corners[1][k]])
    });
    // Normal up: the body lies above it, so it is used the other way round.
    let turned = base.reversed_u();
    let of = b.surface(Support::Spline(turned));
    let sides = vec![
        b.on(sections[0], true, DVec2::X, -DVec2::X),
        b.on(rims[0], false, DVec2::X, DVec2::Y),
        b.on(sections[1], false, DVec2::ONE, -DVec2::X),
        b.on(rims[1], true, DVec2::ZERO, DVec2::Y),
    ];
    b.face(of, vec![sides]);
    let of = b.plane(DVec3::ZERO, DVec3::X, DVec3::Y);
    let flat = Builder::flat;
    b.face(
        of,
        vec![vec![
            flat(across[0], false),
            flat(rims[1], false),
            flat(across[1], true),
            flat(rims[0], true),
        ]],
    );
    let of = b.plane(DVec3::ZERO, DVec3::X, DVec3::Z);
    b.face(
        of,
        vec![vec![flat(sections[0], false), flat(across[0], true)]],
    );
    let of = b.plane(DVec3::Y * length, DVec3::Z, DVec3::X);
    b.face(
        of,
        vec![vec![flat(across[1], false), flat(sections[1], true)]],
    );
    b.tables
}
