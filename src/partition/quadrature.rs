//! Areas and volumes of trimmed faces, by Green's theorem: an integral over a face is one along its loops of
//! an integral across it.
//!
//! Volumes follow from the divergence theorem, `V = ⅓ ∮ (S − o)·n dA`. A face is integrated once and serves
//! both of its solids, so what two solids share cancels exactly in the sum of all volumes.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::arcs::Arc;
use super::faces::{Face, HalfEdge};
use super::patch::{Along, ORDER, Slice};
use super::sheet::Sheet;
use super::tracks::{Geometry, Source, Tracks};
use crate::nurbs::quadrature::{FIVE, Rule, TEN, THREE, TWO};

/// Integrals over a face.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integral {
    /// Area (m²).
    pub area: f64,
    /// Flux of a third of the position, relative to the middle of the domain, along `S_u × S_v` (m³).
    pub flux: f64,
}

impl Integral {
    fn plus(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            flux: self.flux + other.flux,
        }
    }

    fn times(self, factor: f64) -> Self {
        Self {
            area: self.area * factor,
            flux: self.flux * factor,
        }
    }
}

/// For pieces of computed curves: so short that a curve of degree 5 follows them to the tolerance.
const PIECE: Rule = THREE;
/// The same on rational sheets: beside a pole, what lies across a piece varies faster than the piece does.
const RATIONAL_PIECE: Rule = TEN;

/// Which rule integrates polynomials of a sheet's flux exactly, and others well.
fn rule(degree: usize, rational: bool) -> Rule {
    match (degree, rational) {
        (_, true) => TEN,
        (0 | 1, _) => TWO,
        (2, _) => THREE,
        (3, _) => FIVE,
        _ => TEN,
    }
}

fn integrate(rule: Rule, from: f64, to: f64, mut at: impl FnMut(f64) -> Integral) -> Integral {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let mut sum = Integral::default();
    let mut add = |x: f64, weight: f64| {
        sum = sum.plus(at(middle + half * x).times(weight));
    };
    for &(x, weight) in rule {
        add(x, weight);
        if x != 0.0 {
            add(-x, weight);
        }
    }
    sum.times(half)
}

/// The integrals of all faces.
pub(super) fn integrals(
    geometry: Geometry<'_>,
    tracks: &Tracks,
    arcs: &[Arc],
    faces: &[Face],
) -> Vec<Integral> {
    let middle = 0.5 * (geometry.regions.domain.low + geometry.regions.domain.high);
    faces
        .par_iter()
        .map(|face| of_face(geometry, tracks, arcs, face, middle))
        .collect()
}

fn of_face(
    geometry: Geometry<'_>,
    tracks: &Tracks,
    arcs: &[Arc],
    face: &Face,
    middle: DVec3,
) -> Integral {
    let sheet = &geometry.regions.sheets[face.sheet];
    if let Some([_, normal, _]) = sheet.plane {
        return of_flat_face(geometry, tracks, arcs, face, normal, middle);
    }
    let across = Across::new(sheet, &face.polygons[0], middle);
    let mut sum = Integral::default();
    for own in &face.loops {
        sum = sum.plus(gaps(geometry, tracks, arcs, own, &across));
    }
    for half in face.loops.iter().flatten() {
        let arc = &arcs[half.arc];
        let source = tracks.tracks[arc.track].source;
        let sign = if half.forward { 1.0 } else { -1.0 };
        let outer_rule = match source {
            Source::Crossing(_) if sheet.surface.is_rational() => RATIONAL_PIECE,
            Source::Crossing(_) => PIECE,
            Source::Edge(_) | Source::Pole(_) => across.along,
        };
        let stops = across.stops(geometry, source, half.side, arc.t);
        for pair in stops.windows(2) {
            let own = integrate(outer_rule, pair[0], pair[1], |t| {
                let (at, speed) = geometry.on_sheet(source, half.side, t);
                across.at(at, speed)
            });
            sum = sum.plus(own.times(sign));
        }
    }
    sum
}

/// On a plane the curves in space do: the area is `½ ∮ n·(X × dX)`, and the flux is that times a distance.
fn of_flat_face(
    geometry: Geometry<'_>,
    tracks: &Tracks,
    arcs: &[Arc],
    face: &Face,
    normal: DVec3,
    middle: DVec3,
) -> Integral {
    let mut origin = None;
    let mut area = 0.0;
    for own in &face.loops {
        let mut last: Option<DVec3> = None;
        let mut first = DVec3::ZERO;
        for half in own {
            let arc = &arcs[half.arc];
            let source = tracks.tracks[arc.track].source;
            let stops = geometry.stops(source, arc.t);
            let ends = arc.t.map(|t| geometry.point(source, t));
            let origin = *origin.get_or_insert(ends[0]);
            let (start, end) = if half.forward {
                (ends[0], ends[1])
            } else {
                (ends[1], ends[0])
            };
            match last {
                None => first = start,
                Some(last) => area += 0.5 * normal.dot((last - origin).cross(start - last)),
            }
            last = Some(end);
            let sign = if half.forward { 0.5 } else { -0.5 };
            let is_rational = matches!(source, Source::Edge(edge) if geometry.regions.edges[edge].curve.is_rational());
            let rule = if is_rational { TEN } else { FIVE };
            for pair in stops.windows(2) {
                let own = integrate(rule, pair[0], pair[1], |t| {
                    let (point, tangent) = geometry.point_and_tangent(source, t);
                    Integral {
                        area: normal.dot((point - origin).cross(tangent)),
                        flux: 0.0,
                    }
                });
                area += sign * own.area;
            }
        }
        if let (Some(last), Some(origin)) = (last, origin) {
            area += 0.5 * normal.dot((last - origin).cross(first - last));
        }
    }
    let height = origin.map_or(0.0, |origin| (origin - middle).dot(normal));
    Integral {
        area,
        flux: height * area / 3.0,
    }
}

/// What is between the end of each half-edge and the start of the next: curves are computed to a tolerance, and
/// integrals of loops that do not close would depend on where integrals across start.
fn gaps(
    geometry: Geometry<'_>,
    tracks: &Tracks,
    arcs: &[Arc],
    own: &[HalfEdge],
    across: &Across<'_>,
) -> Integral {
    let ends = |half: &HalfEdge| {
        let arc = &arcs[half.arc];
        let source = tracks.tracks[arc.track].source;
        let ends = arc.t.map(|t| geometry.on_sheet(source, half.side, t).0);
        if half.forward {
            ends
        } else {
            [ends[1], ends[0]]
        }
    };
    let mut sum = Integral::default();
    let mut last = ends(&own[own.len() - 1])[1];
    for half in own {
        let [first, end] = ends(half);
        sum = sum.plus(across.at(0.5 * (last + first), first - last));
        last = end;
    }
    sum
}

/// Integrals across a sheet, in the direction with fewer spans, from a fixed parameter.
struct Across<'a> {
    sheet: &'a Sheet,
    /// The direction: 0 along u, 1 along v.
    axis: usize,
    from: f64,
    middle: DVec3,
    rule: Rule,
    along: Rule,
}

impl<'a> Across<'a> {
    fn new(sheet: &'a Sheet, polygon: &[DVec2], middle: DVec3) -> Self {
        let axis = usize::from(sheet.knots[1].len() < sheet.knots[0].len());
        let degrees = [
            sheet.surface.knots_u().degree(),
            sheet.surface.knots_v().degree(),
        ];
        let rational = sheet.surface.is_rational();
        let sum: f64 = polygon.iter().map(|p| p[axis]).sum();
        Self {
            sheet,
            axis,
            from: sum / polygon.len() as f64,
            middle,
            rule: rule(degrees[axis], rational),
            along: rule(degrees[1 - axis], rational),
        }
    }

    /// Where the integrand along an arc is not smooth: the curve's own pieces, and knots that it passes.
    fn stops(&self, geometry: Geometry<'_>, source: Source, side: usize, t: [f64; 2]) -> Vec<f64> {
        let mut stops = geometry.stops(source, t);
        let running = 1 - self.axis;
        let knots = &self.sheet.knots[running];
        let at = |x: f64| geometry.on_sheet(source, side, x).0[running];
        let mut passed = Vec::new();
        let mut from = at(stops[0]);
        for pair in stops.windows(2) {
            let to = at(pair[1]);
            let slack = 1e-9 * (knots[knots.len() - 1] - knots[0]);
            let (low, high) = (from.min(to) + slack, from.max(to) - slack);
            let first = knots.partition_point(|knot| *knot <= low);
            for knot in knots[first..].iter().take_while(|knot| **knot < high) {
                let (mut before, mut after) = (pair[0], pair[1]);
                for _ in 0..40 {
                    let middle = f64::midpoint(before, after);
                    if (at(middle) < *knot) == (from < to) {
                        before = middle;
                    } else {
                        after = middle;
                    }
                }
                passed.push(f64::midpoint(before, after));
            }
            from = to;
        }
        if !passed.is_empty() {
            stops.extend(passed);
            stops.sort_by(f64::total_cmp);
        }
        stops
    }

    /// The integral across, up to a place, times the speed at which a loop passes along.
    fn at(&self, place: DVec2, speed: DVec2) -> Integral {
        // ∬ f du dv = ∮ (∫ f du) dv = −∮ (∫ f dv) du
        let factor = if self.axis == 0 { speed.y } else { -speed.x };
        if factor == 0.0 {
            return Integral::default();
        }
        let (from, to) = (self.from, place[self.axis]);
        let (low, high) = (from.min(to), from.max(to));
        let knots = &self.sheet.knots[self.axis];
        let inner = knots.iter().copied().filter(|k| *k > low && *k < high);
        let fixed = if self.axis == 0 { Along::V } else { Along::U };
        let mut sum = Integral::default();
        let mut start = low;
        for end in inner.chain([high]) {
            let mut inside = place;
            inside[self.axis] = 0.5 * (start + end);
            let patch = self.sheet.patch_at(inside.x, inside.y);
            let own = match patch.count(fixed) {
                2 => self.span(&patch.slice::<2>(fixed, place[1 - self.axis]), start, end),
                4 => self.span(&patch.slice::<4>(fixed, place[1 - self.axis]), start, end),
                _ => self.span(
                    &patch.slice::<ORDER>(fixed, place[1 - self.axis]),
                    start,
                    end,
                ),
            };
            sum = sum.plus(own);
            start = end;
        }
        sum.times(if to < from { -factor } else { factor })
    }

    /// The integral along a part of a patch's curve.
    fn span<const N: usize>(&self, slice: &Slice<N>, start: f64, end: f64) -> Integral {
        integrate(self.rule, start, end, |x| {
            let (p, along, other) = slice.jet(x);
            let normal = if self.axis == 0 {
                along.cross(other)
            } else {
                other.cross(along)
            };
            Integral {
                area: normal.length(),
                flux: (p - self.middle).dot(normal) / 3.0,
            }
        })
    }
}
