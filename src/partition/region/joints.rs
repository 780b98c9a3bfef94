//! How the sheets of a region join each other, and land on level ones of others.

use glam::DVec3;

use crate::nurbs::Curve;
use crate::partition::bounds::Bounds;
use crate::partition::edge::{Edge, Landing, Side};
use crate::partition::pierce::Segment;
use crate::partition::relations::Relations;
use crate::partition::sheet::{BORDERS, Border, Sheet};

/// A side that has shrunk to a point: the pole of an ellipsoid, the corner of an end face.
#[derive(Clone, Copy, Debug)]
pub(in crate::partition) struct Pole {
    pub(in crate::partition) sheet: usize,
    pub(in crate::partition) border: Border,
    pub(in crate::partition) point: DVec3,
}

/// How far apart sides may be that are the same, as a fraction of the region's size.
const CLOSURE: f64 = 1e-9;

/// How the sheets of a region join.
#[derive(Default)]
pub(super) struct Joints {
    pub(super) edges: Vec<Edge>,
    pub(super) poles: Vec<Pole>,
    /// Sides that join no other.
    pub(super) open: Vec<(usize, Border, Curve)>,
}

/// Pairs the sides of a region's sheets; what is left over is open.
pub(super) fn joints(
    all: &[Sheet],
    bounds: &Bounds,
    region: usize,
    own: std::ops::Range<usize>,
) -> Joints {
    let tolerance = CLOSURE * bounds.diagonal();
    let mut joints = Joints::default();
    for sheet in own {
        for border in BORDERS {
            let surface = &all[sheet].surface;
            let at = all[sheet].at_border(border);
            let curve = if border.axis() == 0 {
                surface.isocurve_u(at)
            } else {
                surface.isocurve_v(at)
            };
            let bounds = Bounds::of(curve.points().iter().copied());
            if bounds.diagonal() <= tolerance {
                let point = curve.points()[0];
                joints.poles.push(Pole {
                    sheet,
                    border,
                    point,
                });
                continue;
            }
            let partner = joints
                .open
                .iter()
                .enumerate()
                .find_map(|(at, other)| Some((at, other.2.proportion(&curve, tolerance)?)));
            let Some((at, (shift, scale))) = partner else {
                joints.open.push((sheet, border, curve));
                continue;
            };
            let (first, first_border, curve) = joints.open.remove(at);
            let side = |sheet: usize, border: Border, shift: f64, scale: f64| Side {
                sheet,
                border,
                shift,
                scale,
            };
            joints.edges.push(Edge {
                segments: segments(&curve),
                bounds,
                curve,
                sides: [
                    side(first, first_border, 0.0, 1.0),
                    side(sheet, border, shift, scale),
                ],
                landing: None,
                region,
            });
        }
    }
    joints
}

/// The edge of an open border that lies on a level sheet of another region, with that sheet.
pub(super) fn landing(
    all: &[Sheet],
    relations: &Relations,
    domain: &Bounds,
    (sheet, border, curve): (usize, Border, Curve),
) -> Option<(usize, Edge)> {
    let region = all[sheet].region;
    let tolerance = CLOSURE * domain.diagonal();
    let bounds = Bounds::of(curve.points().iter().copied());
    if !bounds.grown(tolerance).meets(domain) {
        return None;
    }
    let landing = all.iter().enumerate().find_map(|(at, other)| {
        if other.region == region || !relations.meet(region, other.region) {
            return None;
        }
        let [point, normal, _] = other.plane?;
        let lies = |p: &DVec3| (*p - point).dot(normal).abs() <= tolerance;
        let on_it = curve.points().iter().all(lies);
        on_it.then(|| Landing::on(at, &other.surface)).flatten()
    })?;
    let side = Side {
        sheet,
        border,
        shift: 0.0,
        scale: 1.0,
    };
    // It passes through the sides of the level's neighbours on their very borders.
    let near = |segment: Segment| segment.with_slack(tolerance);
    let edge = Edge {
        segments: segments(&curve).into_iter().map(near).collect(),
        bounds: bounds.grown(tolerance),
        curve,
        sides: [side; 2],
        landing: Some(landing),
        region,
    };
    Some((landing.sheet, edge))
}

fn segments(curve: &Curve) -> Vec<Segment> {
    let segment = |piece: &Curve| {
        let (start, end) = piece.domain();
        let points = piece
            .points()
            .iter()
            .zip(piece.weights())
            .map(|(p, w)| (*p * *w).extend(*w));
        Segment::new(points, [start, end])
    };
    curve.bezier_segments().iter().map(segment).collect()
}
