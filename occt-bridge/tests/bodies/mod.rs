//! Spline bodies whose volumes are known: cylinder and ellipsoid (exact, rational) and sinuous channels.
#![allow(dead_code, reason = "each test uses some of them")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::too_many_lines,
    clippy::unnecessary_wraps,
    reason = "tests"
)]

pub(crate) mod measured;
pub(crate) mod tables;

use occt_bridge::{Curve, Edge, EdgeUse, Face, Pcurve, Shape, Surface, Topology, solid};

pub(crate) fn flat(origin: [f64; 2], direction: [f64; 2]) -> Option<Pcurve> {
    Some(Pcurve::Line { origin, direction })
}

pub(crate) fn run(edge: usize, reversed: bool, pcurve: Option<Pcurve>) -> EdgeUse {
    EdgeUse {
        edge,
        reversed,
        pcurve,
    }
}

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Nine poles of the unit circle, with weights; its knots.
const CIRCLE: [([f64; 2], f64); 9] = [
    ([1.0, 0.0], 1.0),
    ([1.0, 1.0], HALF),
    ([0.0, 1.0], 1.0),
    ([-1.0, 1.0], HALF),
    ([-1.0, 0.0], 1.0),
    ([-1.0, -1.0], HALF),
    ([0.0, -1.0], 1.0),
    ([1.0, -1.0], HALF),
    ([1.0, 0.0], 1.0),
];
const CIRCLE_KNOTS: [f64; 12] = [
    0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0,
];

fn circle(at: impl Fn([f64; 2]) -> [f64; 3]) -> Curve {
    Curve::BSpline {
        degree: 2,
        knots: CIRCLE_KNOTS.to_vec(),
        poles: CIRCLE.iter().map(|(p, _)| at(*p)).collect(),
        weights: Some(CIRCLE.iter().map(|(_, w)| *w).collect()),
    }
}

/// Radius r about the line y = cy, z = cz, from x0 to x1; one seam.
pub(crate) fn cylinder_topology(x: [f64; 2], center: [f64; 2], r: f64) -> Topology {
    let at = |x: f64| move |p: [f64; 2]| [x, center[0] + r * p[0], center[1] + r * p[1]];
    let poles = CIRCLE
        .iter()
        .flat_map(|(p, _)| [at(x[0])(*p), at(x[1])(*p)])
        .collect();
    let weights = CIRCLE.iter().flat_map(|(_, w)| [*w, *w]).collect();
    let cap = |x: f64, normal: f64| Surface::Plane {
        origin: [x, center[0], center[1]],
        normal: [normal, 0.0, 0.0],
        x_axis: [0.0, 1.0, 0.0],
    };
    let [a, b] = [at(x[0])([1.0, 0.0]), at(x[1])([1.0, 0.0])];
    let edge = |curve, start, end| Edge {
        curve,
        range: [0.0, 1.0],
        start,
        end,
    };
    Topology {
        vertices: vec![a, b],
        curves: vec![
            circle(at(x[0])),
            circle(at(x[1])),
            Curve::Line { start: a, end: b },
        ],
        surfaces: vec![
            Surface::BSpline {
                degree_u: 2,
                degree_v: 1,
                knots_u: CIRCLE_KNOTS.to_vec(),
                knots_v: vec![0.0, 0.0, 1.0, 1.0],
                poles,
                weights: Some(weights),
            },
            cap(x[0], -1.0),
            cap(x[1], 1.0),
        ],
        edges: vec![edge(0, 0, 0), edge(1, 1, 1), edge(2, 0, 1)],
        faces: vec![
            Face {
                surface: 0,
                reversed: false,
                loops: vec![vec![
                    run(0, false, flat([0.0, 0.0], [1.0, 0.0])),
                    run(2, false, flat([1.0, 0.0], [0.0, 1.0])),
                    run(1, true, flat([0.0, 1.0], [1.0, 0.0])),
                    run(2, true, flat([0.0, 0.0], [0.0, 1.0])),
                ]],
            },
            Face {
                surface: 1,
                reversed: false,
                loops: vec![vec![run(0, true, None)]],
            },
            Face {
                surface: 2,
                reversed: false,
                loops: vec![vec![run(1, false, None)]],
            },
        ],
        tolerance: 1e-7,
    }
}

/// Semi-axes a, one face: a seam and two degenerate edges.
pub(crate) fn ellipsoid_topology(center: [f64; 3], axes: [f64; 3]) -> Topology {
    // A half circle from the south to the north pole.
    let meridian = [
        ([0.0, -1.0], 1.0),
        ([1.0, -1.0], HALF),
        ([1.0, 0.0], 1.0),
        ([1.0, 1.0], HALF),
        ([0.0, 1.0], 1.0),
    ];
    let knots_v = vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
    let at = |p: [f64; 2], m: [f64; 2]| {
        let unit = [m[0] * p[0], m[0] * p[1], m[1]];
        std::array::from_fn::<f64, 3, _>(|i| center[i] + axes[i] * unit[i])
    };
    let mut poles = Vec::new();
    let mut weights = Vec::new();
    for (p, w) in CIRCLE {
        for (m, wm) in meridian {
            poles.push(at(p, m));
            weights.push(w * wm);
        }
    }
    let edge = |curve, start, end| Edge {
        curve,
        range: [0.0, 1.0],
        start,
        end,
    };
    let south = at([1.0, 0.0], [0.0, -1.0]);
    let north = at([1.0, 0.0], [0.0, 1.0]);
    Topology {
        vertices: vec![south, north],
        curves: vec![
            circle(|p| at(p, [0.0, -1.0])),
            circle(|p| at(p, [0.0, 1.0])),
            Curve::BSpline {
                degree: 2,
                knots: knots_v.clone(),
                poles: meridian.iter().map(|(m, _)| at([1.0, 0.0], *m)).collect(),
                weights: Some(meridian.iter().map(|(_, w)| *w).collect()),
            },
        ],
        surfaces: vec![Surface::BSpline {
            degree_u: 2,
            degree_v: 2,
            knots_u: CIRCLE_KNOTS.to_vec(),
            knots_v,
            poles,
            weights: Some(weights),
        }],
        edges: vec![edge(0, 0, 0), edge(1, 1, 1), edge(2, 0, 1)],
        faces: vec![Face {
            surface: 0,
            reversed: false,
            loops: vec![vec![
                run(0, false, flat([0.0, 0.0], [1.0, 0.0])),
                run(2, false, flat([1.0, 0.0], [0.0, 1.0])),
                run(1, true, flat([0.0, 1.0], [1.0, 0.0])),
                run(2, true, flat([0.0, 0.0], [0.0, 1.0])),
            ]],
        }],
        tolerance: 1e-7,
    }
}

/// Clamped uniform knots on 0..1.
pub(crate) fn uniform(degree: usize, poles: usize) -> Vec<f64> {
    let spans = poles - degree;
    let mut knots = vec![0.0; degree];
    knots.extend((0..=spans).map(|i| i as f64 / spans as f64));
    knots.extend(vec![1.0; degree]);
    knots
}

/// What makes a channel: stations along x, swinging about a mean course.
#[derive(Clone, Copy)]
pub(crate) struct Course {
    pub(crate) x: [f64; 2],
    pub(crate) y: f64,
    pub(crate) slope: f64,
    pub(crate) amplitude: f64,
    pub(crate) wavelength: f64,
    pub(crate) phase: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) depth: f64,
    pub(crate) stations: usize,
    pub(crate) segments: usize,
}

impl Course {
    /// Base 3 × 3 with seven control points across, top ruled between its rims; cut at knots into segments that share their surfaces.
    pub(crate) fn topology(&self) -> Topology {
        const ACROSS: [f64; 7] = [-1.0, -0.8, -0.45, 0.0, 0.45, 0.8, 1.0];
        const DOWN: [f64; 7] = [0.0, 0.75, 1.1, 1.15, 1.1, 0.75, 0.0];
        let n = self.stations;
        let tau = std::f64::consts::TAU;
        let mut net = Vec::new();
        for i in 0..n {
            let x = self.x[0] + (self.x[1] - self.x[0]) * i as f64 / (n - 1) as f64;
            let angle = tau * x / self.wavelength + self.phase;
            let y = self.y + self.slope * x + self.amplitude * angle.sin();
            let dy = self.slope + self.amplitude * tau / self.wavelength * angle.cos();
            let scale = self.width / 2.0 / dy.hypot(1.0);
            for (t, d) in ACROSS.iter().zip(DOWN) {
                net.push([x - t * scale * dy, y + t * scale, self.top - self.depth * d]);
            }
        }
        let rim = |j: usize| -> Vec<[f64; 3]> { (0..n).map(|i| net[i * 7 + j]).collect() };
        let knots_u = uniform(3, n);
        let spans = n - 3;
        let cuts: Vec<f64> = (0..=self.segments)
            .map(|k| knots_u[3 + k * spans / self.segments])
            .collect();
        let top_net = rim(0)
            .iter()
            .zip(rim(6))
            .flat_map(|(a, b)| [*a, b])
            .collect();
        let mut t = Topology {
            tolerance: 1e-7,
            ..Topology::default()
        };
        t.surfaces.push(Surface::BSpline {
            degree_u: 3,
            degree_v: 3,
            knots_u: knots_u.clone(),
            knots_v: uniform(3, 7),
            poles: net.clone(),
            weights: None,
        });
        t.surfaces.push(Surface::BSpline {
            degree_u: 3,
            degree_v: 1,
            knots_u: knots_u.clone(),
            knots_v: vec![0.0, 0.0, 1.0, 1.0],
            poles: top_net,
            weights: None,
        });
        for j in [0, 6] {
            t.curves.push(Curve::BSpline {
                degree: 3,
                knots: knots_u.clone(),
                poles: rim(j),
                weights: None,
            });
        }
        // Vertices 2k and 2k + 1, base section edge 2k, top section edge 2k + 1.
        for u in &cuts {
            let section = section_poles(&knots_u, &net, *u);
            let (a, b) = (section[0], section[6]);
            let at = t.vertices.len();
            t.vertices.extend([a, b]);
            for curve in [
                Curve::BSpline {
                    degree: 3,
                    knots: uniform(3, 7),
                    poles: section,
                    weights: None,
                },
                Curve::Line { start: a, end: b },
            ] {
                t.edges.push(Edge {
                    curve: t.curves.len(),
                    range: [0.0, 1.0],
                    start: at,
                    end: at + 1,
                });
                t.curves.push(curve);
            }
        }
        for k in 0..self.segments {
            let rims = t.edges.len();
            for side in 0..2 {
                t.edges.push(Edge {
                    curve: side,
                    range: [cuts[k], cuts[k + 1]],
                    start: 2 * k + side,
                    end: 2 * (k + 1) + side,
                });
            }
            for (surface, reversed) in [(0, true), (1, false)] {
                let cross = |k: usize, reversed| {
                    run(2 * k + surface, reversed, flat([cuts[k], 0.0], [0.0, 1.0]))
                };
                t.faces.push(Face {
                    surface,
                    reversed,
                    loops: vec![vec![
                        run(rims, false, flat([0.0, 0.0], [1.0, 0.0])),
                        cross(k + 1, false),
                        run(rims + 1, true, flat([0.0, 1.0], [1.0, 0.0])),
                        cross(k, true),
                    ]],
                });
            }
        }
        for (k, out) in [(0, -1.0), (self.segments, 1.0)] {
            let (a, b) = (t.vertices[2 * k], t.vertices[2 * k + 1]);
            let across = [b[0] - a[0], b[1] - a[1], 0.0];
            t.faces.push(Face {
                surface: t.surfaces.len(),
                reversed: false,
                loops: vec![vec![
                    run(2 * k, out < 0.0, None),
                    run(2 * k + 1, out > 0.0, None),
                ]],
            });
            t.surfaces.push(Surface::Plane {
                origin: a,
                normal: [out * across[1], -out * across[0], 0.0],
                x_axis: across,
            });
        }
        t
    }

    pub(crate) fn solid(&self) -> Shape {
        solid(&self.topology()).unwrap()
    }
}

/// Control points of the isoparametric curve at u, by de Boor.
fn section_poles(knots: &[f64], net: &[[f64; 3]], u: f64) -> Vec<[f64; 3]> {
    let n = knots.len() - 4;
    let span = (3..n).rev().find(|i| knots[*i] <= u).unwrap();
    (0..7)
        .map(|j| {
            let mut d: Vec<[f64; 3]> = (0..=3).map(|i| net[(span - 3 + i) * 7 + j]).collect();
            for r in 1..=3 {
                for i in (r..=3).rev() {
                    let low = knots[span - 3 + i];
                    let a = (u - low) / (knots[span + 1 + i - r] - low);
                    d[i] = std::array::from_fn(|c| (1.0 - a) * d[i - 1][c] + a * d[i][c]);
                }
            }
            d[3]
        })
        .collect()
}
