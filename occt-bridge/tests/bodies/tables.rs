//! Finished tables of solids whose volumes are known: grids of boxes, a ball in a box, a block with a plug in it.

use occt_bridge::{
    Curve, FaceOrigin, OnSurface, Pcurve, Surface, TableEdge, TableFace, TableSolid, TableVertex,
    Tables,
};

use super::{CIRCLE, CIRCLE_KNOTS, HALF};

pub(crate) type Shell = Vec<(usize, bool)>;

const TOLERANCE: f64 = 1e-7;

fn vertex(t: &mut Tables, point: [f64; 3]) -> usize {
    t.vertices.push(TableVertex {
        point,
        tolerance: TOLERANCE,
    });
    t.vertices.len() - 1
}

fn edge(t: &mut Tables, curve: Option<Curve>, start: usize, end: usize) -> usize {
    let at = t.curves.len();
    t.edges.push(TableEdge {
        curve: curve.is_some().then_some(at),
        range: [0.0, 1.0],
        start,
        end,
        tolerance: TOLERANCE,
        on: Vec::new(),
    });
    t.curves.extend(curve);
    t.edges.len() - 1
}

fn line(t: &mut Tables, start: usize, end: usize) -> usize {
    let curve = Curve::Line {
        start: t.vertices[start].point,
        end: t.vertices[end].point,
    };
    edge(t, Some(curve), start, end)
}

fn pcurve(t: &mut Tables, origin: [f64; 2], direction: [f64; 2]) -> usize {
    t.pcurves.push(Pcurve::Line { origin, direction });
    t.pcurves.len() - 1
}

fn lay(t: &mut Tables, edge: usize, surface: usize, forward: usize, reversed: Option<usize>) {
    t.edges[edge].on.push(OnSurface {
        surface,
        forward,
        reversed,
    });
}

fn face(t: &mut Tables, surface: usize, loops: Vec<Shell>) -> usize {
    let at = t.faces.len();
    t.faces.push(TableFace {
        surface,
        loops,
        tolerance: TOLERANCE,
        origins: vec![FaceOrigin {
            argument: 7,
            face: at,
            same_orientation: at.is_multiple_of(2),
        }],
    });
    at
}

fn plane(t: &mut Tables, origin: [f64; 3], normal: [f64; 3], x_axis: [f64; 3]) -> usize {
    t.surfaces.push(Surface::Plane {
        origin,
        normal,
        x_axis,
    });
    t.surfaces.len() - 1
}

pub(crate) fn solid(t: &mut Tables, owner: usize, shells: Vec<Shell>) {
    t.solids.push(TableSolid { owner, shells });
}

pub(crate) fn turned(shell: &Shell) -> Shell {
    shell.iter().map(|(face, back)| (*face, !back)).collect()
}

/// Appends the vertices, edges and faces of boxes between the coordinates on each axis; returns the faces of each box, x fastest. Faces
/// look along their axis. `curved`: the faces are bilinear B-spline surfaces, not planes.
pub(crate) fn add_grid(t: &mut Tables, at: [&[f64]; 3], curved: bool) -> Vec<Shell> {
    let n = at.map(<[f64]>::len);
    let base = t.vertices.len();
    let index = |i: [usize; 3]| (i[2] * n[1] + i[1]) * n[0] + i[0];
    let points: Vec<[usize; 3]> = (0..n[2])
        .flat_map(|k| (0..n[1]).flat_map(move |j| (0..n[0]).map(move |i| [i, j, k])))
        .collect();
    let step = |i: [usize; 3], axis: usize| -> Option<[usize; 3]> {
        (i[axis] + 1 < n[axis]).then(|| std::array::from_fn(|k| i[k] + usize::from(k == axis)))
    };
    for i in &points {
        vertex(t, std::array::from_fn(|axis| at[axis][i[axis]]));
    }
    let mut edges = vec![[None; 3]; points.len()];
    for i in &points {
        for axis in [0, 1, 2] {
            if let Some(j) = step(*i, axis) {
                edges[index(*i)][axis] = Some(line(t, base + index(*i), base + index(j)));
            }
        }
    }
    // Where the edges of a patch are on it: v = 0, u = 1, v = 1, u = 0.
    let sides = [
        ([0.0, 0.0], [1.0, 0.0]),
        ([1.0, 0.0], [0.0, 1.0]),
        ([0.0, 1.0], [1.0, 0.0]),
        ([0.0, 0.0], [0.0, 1.0]),
    ]
    .map(|(origin, direction)| pcurve(t, origin, direction));
    let mut faces = vec![[None; 3]; points.len()];
    for i in &points {
        for axis in [0, 1, 2] {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            let (Some(ia), Some(ib)) = (step(*i, a), step(*i, b)) else {
                continue;
            };
            let side = |i: [usize; 3], axis: usize| edges[index(i)][axis].unwrap();
            let around = [side(*i, a), side(ia, b), side(ib, a), side(*i, b)];
            let corner = |i: [usize; 3]| t.vertices[base + index(i)].point;
            let surface = if curved {
                let poles = [*i, ib, ia, step(ia, b).unwrap()].map(corner).to_vec();
                t.surfaces.push(bilinear([0.0, 1.0], poles));
                for (e, p) in around.iter().zip(sides) {
                    lay(t, *e, t.surfaces.len() - 1, p, None);
                }
                t.surfaces.len() - 1
            } else {
                let unit = |axis: usize| std::array::from_fn(|k| f64::from(u8::from(k == axis)));
                plane(t, corner(*i), unit(axis), unit(a))
            };
            let uses = around.into_iter().zip([false, false, true, true]);
            faces[index(*i)][axis] = Some(face(t, surface, vec![uses.collect()]));
        }
    }
    points
        .iter()
        .filter(|i| (0..3).all(|axis| step(**i, axis).is_some()))
        .map(|i| {
            (0..3)
                .flat_map(|axis| {
                    let low = faces[index(*i)][axis].unwrap();
                    let high = faces[index(step(*i, axis).unwrap())][axis].unwrap();
                    [(low, true), (high, false)]
                })
                .collect()
        })
        .collect()
}

/// Every box of a grid is a solid, owners counting from 10.
pub(crate) fn grid(at: [&[f64]; 3], curved: bool) -> Tables {
    let mut t = Tables::default();
    for (i, shell) in add_grid(&mut t, at, curved).into_iter().enumerate() {
        solid(&mut t, 10 + i, vec![shell]);
    }
    t
}

/// Degree 1 in both directions, u over the given range and v over 0 to 1; poles at (0, 0), (0, 1), (1, 0), (1, 1).
fn bilinear(u: [f64; 2], poles: Vec<[f64; 3]>) -> Surface {
    Surface::BSpline {
        degree_u: 1,
        degree_v: 1,
        knots_u: vec![u[0], u[0], u[1], u[1]],
        knots_v: vec![0.0, 0.0, 1.0, 1.0],
        poles,
        weights: None,
    }
}

/// A cube of side 10 from the origin with a ball in it, both solids kept: one face, 9 × 5 poles, a seam along x > 0 and two poles.
pub(crate) fn ball_in_box(centre: [f64; 3], radius: f64) -> Tables {
    let mut t = Tables::default();
    let outside = add_grid(&mut t, [&[0.0, 10.0]; 3], false).remove(0);
    // Distance from the axis, height, weight: from the lower pole to the upper.
    let arc = [
        (0.0, -1.0, 1.0),
        (1.0, -1.0, HALF),
        (1.0, 0.0, 1.0),
        (1.0, 1.0, HALF),
        (0.0, 1.0, 1.0),
    ];
    let knots_v = vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
    let place = |x: f64, y: f64, z: f64| {
        [
            centre[0] + radius * x,
            centre[1] + radius * y,
            centre[2] + radius * z,
        ]
    };
    let net = CIRCLE
        .iter()
        .flat_map(|(p, w)| arc.map(|(r, z, weight)| (place(r * p[0], r * p[1], z), w * weight)));
    let (poles, weights) = net.unzip();
    let surface = t.surfaces.len();
    t.surfaces.push(Surface::BSpline {
        degree_u: 2,
        degree_v: 2,
        knots_u: CIRCLE_KNOTS.to_vec(),
        knots_v: knots_v.clone(),
        poles,
        weights: Some(weights),
    });
    let low = vertex(&mut t, place(0.0, 0.0, -1.0));
    let high = vertex(&mut t, place(0.0, 0.0, 1.0));
    let meridian = Curve::BSpline {
        degree: 2,
        knots: knots_v,
        poles: arc.iter().map(|(r, z, _)| place(*r, 0.0, *z)).collect(),
        weights: Some(arc.iter().map(|(_, _, w)| *w).collect()),
    };
    let seam = edge(&mut t, Some(meridian), low, high);
    let below = edge(&mut t, None, low, low);
    let above = edge(&mut t, None, high, high);
    let along_v = [1.0, 0.0].map(|u| pcurve(&mut t, [u, 0.0], [0.0, 1.0]));
    let along_u = [0.0, 1.0].map(|v| pcurve(&mut t, [0.0, v], [1.0, 0.0]));
    lay(&mut t, seam, surface, along_v[0], Some(along_v[1]));
    lay(&mut t, below, surface, along_u[0], None);
    lay(&mut t, above, surface, along_u[1], None);
    let around = vec![(below, false), (seam, false), (above, true), (seam, true)];
    let ball = vec![(face(&mut t, surface, vec![around]), false)];
    let shells = vec![outside, turned(&ball)];
    solid(&mut t, 0, shells);
    solid(&mut t, 1, vec![ball]);
    t
}

/// The unit square between z = 0 and z = 1 + xy/2 (a bilinear patch, u = 2x and v = y), drilled by a cylinder, and its core. One side
/// of the patch is two edges on one curve with one pcurve.
pub(crate) fn drilled_block(centre: [f64; 2], radius: f64) -> Tables {
    let mut t = Tables::default();
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let top = |x: f64, y: f64| [x, y, 1.0 + x * y / 2.0];
    for [x, y] in square {
        vertex(&mut t, [x, y, 0.0]);
    }
    for [x, y] in square {
        vertex(&mut t, top(x, y));
    }
    let middle = vertex(&mut t, top(0.5, 0.0));
    let start = [centre[0] + radius, centre[1]];
    let low = vertex(&mut t, [start[0], start[1], 0.0]);
    let high = vertex(&mut t, top(start[0], start[1]));
    let bottom = [0, 1, 2, 3].map(|i| line(&mut t, i, (i + 1) % 4));
    let up = [0, 1, 2, 3].map(|i| line(&mut t, i, 4 + i));
    let front = line(&mut t, 4, 5);
    let [right, back, left] = [(5, 6), (7, 6), (4, 7)].map(|(a, b)| line(&mut t, a, b));
    let front_too = t.edges.len();
    t.edges.push(TableEdge {
        range: [0.5, 1.0],
        start: middle,
        ..t.edges[front].clone()
    });
    t.edges[front].range = [0.0, 0.5];
    t.edges[front].end = middle;

    let plan = plane(&mut t, [0.0; 3], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]);
    let patch = t.surfaces.len();
    let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];
    t.surfaces.push(bilinear(
        [0.0, 2.0],
        corners.map(|(x, y)| top(x, y)).to_vec(),
    ));
    let sides = [
        ([0.0, 0.0], [2.0, 0.0], vec![front, front_too]),
        ([2.0, 0.0], [0.0, 1.0], vec![right]),
        ([0.0, 1.0], [2.0, 0.0], vec![back]),
        ([0.0, 0.0], [0.0, 1.0], vec![left]),
    ];
    for (origin, direction, edges) in sides {
        let p = pcurve(&mut t, origin, direction);
        for e in edges {
            lay(&mut t, e, patch, p, None);
        }
    }

    let (wall_surface, lower, upper) = drill(centre, radius);
    let wall = t.surfaces.len();
    t.surfaces.push(wall_surface);
    let rim_below = edge(&mut t, Some(lower), low, low);
    let rim_above = edge(&mut t, Some(upper), high, high);
    let seam = line(&mut t, low, high);
    let circle = t.pcurves.len();
    t.pcurves.push(Pcurve::BSpline {
        degree: 2,
        knots: CIRCLE_KNOTS.to_vec(),
        poles: CIRCLE
            .iter()
            .map(|(p, _)| [2.0 * (centre[0] + radius * p[0]), centre[1] + radius * p[1]])
            .collect(),
        weights: Some(CIRCLE.iter().map(|(_, w)| *w).collect()),
    });
    lay(&mut t, rim_above, patch, circle, None);
    for (e, v) in [(rim_below, 0.0), (rim_above, 1.0)] {
        let p = pcurve(&mut t, [0.0, v], [1.0, 0.0]);
        lay(&mut t, e, wall, p, None);
    }
    let ends = [1.0, 0.0].map(|u| pcurve(&mut t, [u, 0.0], [0.0, 1.0]));
    lay(&mut t, seam, wall, ends[0], Some(ends[1]));

    let tops = [
        vec![(front_too, true), (front, true)],
        vec![(right, true)],
        vec![(back, false)],
        vec![(left, false)],
    ];
    let out = [
        [0.0, -1.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
    ];
    let mut block = Vec::new();
    for (i, over) in tops.into_iter().enumerate() {
        let point = t.vertices[i].point;
        let surface = plane(&mut t, point, out[i], [0.0, 0.0, 1.0]);
        let mut around = vec![(bottom[i], false), (up[(i + 1) % 4], false)];
        around.extend(over);
        around.push((up[i], true));
        block.push((face(&mut t, surface, vec![around]), false));
    }
    let below = bottom.iter().rev().map(|e| (*e, true)).collect();
    let above = vec![
        (front, false),
        (front_too, false),
        (right, false),
        (back, true),
        (left, true),
    ];
    let ring_below = face(&mut t, plan, vec![below, vec![(rim_below, false)]]);
    let ring_above = face(&mut t, patch, vec![above, vec![(rim_above, true)]]);
    let disc_below = face(&mut t, plan, vec![vec![(rim_below, true)]]);
    let disc_above = face(&mut t, patch, vec![vec![(rim_above, false)]]);
    let around = vec![
        (rim_below, false),
        (seam, false),
        (rim_above, true),
        (seam, true),
    ];
    let bore = face(&mut t, wall, vec![around]);
    block.extend([(ring_below, false), (ring_above, false), (bore, true)]);
    solid(&mut t, 5, vec![block]);
    let core = vec![(disc_below, false), (disc_above, false), (bore, false)];
    solid(&mut t, 3, vec![core]);
    t
}

/// The cylinder between z = 0 and z = 1 + xy/2, and its rims. Put on the patch, a rational circle of degree 2 is a curve of degree 4:
/// its weights are the circle's squared, and every product of two quadratic Béziers is a quartic one.
fn drill(centre: [f64; 2], radius: f64) -> (Surface, Curve, Curve) {
    let homogeneous: Vec<[f64; 3]> = CIRCLE
        .iter()
        .map(|(p, w)| {
            [
                w * (centre[0] + radius * p[0]),
                w * (centre[1] + radius * p[1]),
                *w,
            ]
        })
        .collect();
    let product = |arc: &[[f64; 3]], a: usize, b: usize| -> [f64; 5] {
        let mut out = [0.0; 5];
        for (i, ci) in [1.0, 2.0, 1.0].into_iter().enumerate() {
            for (j, cj) in [1.0, 2.0, 1.0].into_iter().enumerate() {
                out[i + j] += ci * cj / [1.0, 4.0, 6.0, 4.0, 1.0][i + j] * arc[i][a] * arc[j][b];
            }
        }
        out
    };
    let (mut above, mut weights) = (Vec::new(), Vec::new());
    for quarter in 0..4 {
        let arc = &homogeneous[2 * quarter..2 * quarter + 3];
        let [xw, yw, xy, ww] = [(0, 2), (1, 2), (0, 1), (2, 2)].map(|(a, b)| product(arc, a, b));
        for k in usize::from(quarter > 0)..5 {
            above.push([xw[k] / ww[k], yw[k] / ww[k], 1.0 + xy[k] / ww[k] / 2.0]);
            weights.push(ww[k]);
        }
    }
    let below: Vec<[f64; 3]> = above.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let mut knots = vec![0.0; 5];
    for k in [0.25, 0.5, 0.75, 1.0] {
        knots.extend([k; 4]);
    }
    knots.push(1.0);
    let rim = |poles: &[[f64; 3]]| Curve::BSpline {
        degree: 4,
        knots: knots.clone(),
        poles: poles.to_vec(),
        weights: Some(weights.clone()),
    };
    let wall = Surface::BSpline {
        degree_u: 4,
        degree_v: 1,
        knots_u: knots.clone(),
        knots_v: vec![0.0, 0.0, 1.0, 1.0],
        poles: below
            .iter()
            .zip(&above)
            .flat_map(|(b, a)| [*b, *a])
            .collect(),
        weights: Some(weights.iter().flat_map(|w| [*w, *w]).collect()),
    };
    (wall, rim(&below), rim(&above))
}
