//! Areas and volumes of trimmed faces, by Green's theorem: an integral over a face is one along its loops of
//! an integral across it.
//!
//! Volumes follow from the divergence theorem, `V = ⅓ ∮ (S − o)·n dA`. A face is integrated once and serves
//! both of its solids, so what two solids share cancels exactly in the sum of all volumes.
//!
//! Fluxes across polynomial patches are polynomials, and rules are chosen to be exact for them. Areas, what rational patches have, and
//! all that is along computed curves is estimated twice, by a rule and by a poorer one on some of its nodes; what the rule then
//! misses follows from how much they differ ([`missed`]). Errors of all pieces are added up without their signs. Where a face's
//! are too large for [`AREA`] or [`FLUX`] on the domain's skin, or for [`INNER_AREA`] inside, pieces are halved, along its loops and
//! across, until each meets its share. Fluxes of inner faces are never halved for: they cancel in the sum of all volumes, and on
//! polynomial sheets only the computed curves make them inexact. What this does not count is by how much curves deviate from where sheets cross: see `Topology`'s deviation.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::arcs::Arc;
use super::faces::{Face, HalfEdge};
use super::patch::{Along, ORDER, Slice};
use super::sheet::Sheet;
use super::tracks::{Geometry, Source, Tracks};
use crate::nurbs::quadrature::{self, FIVE, Rule, TEN, THREE};

/// Integrals over a face.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integral {
    /// Area (m²).
    pub area: f64,
    /// Flux of a third of the position, relative to the middle of the domain, along `S_u × S_v` (m³).
    pub flux: f64,
    /// By how much the area may be off (m²); see the head of this file.
    pub area_error: f64,
    /// By how much the flux may be off (m³).
    pub flux_error: f64,
}

/// What is summed up on the way: an integral, and the vector area (m²) that it is compared with.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    own: Integral,
    vector: DVec3,
}

impl Sum {
    fn plus(self, other: Self) -> Self {
        Self {
            own: Integral {
                area: self.own.area + other.own.area,
                flux: self.own.flux + other.own.flux,
                area_error: self.own.area_error + other.own.area_error,
                flux_error: self.own.flux_error + other.own.flux_error,
            },
            vector: self.vector + other.vector,
        }
    }

    /// Errors keep their sign: they never make up for each other.
    fn times(self, factor: f64) -> Self {
        Self {
            own: Integral {
                area: self.own.area * factor,
                flux: self.own.flux * factor,
                area_error: self.own.area_error * factor.abs(),
                flux_error: self.own.flux_error * factor.abs(),
            },
            vector: self.vector * factor,
        }
    }
}

/// The error of an area up to which nothing is halved, as a share of it: a tenth of what the proof allows the skin.
const AREA: f64 = 1e-9;
/// The same of a face inside the domain, which is in no sum that the proof compares. Estimates of ordinary faces are far above
/// what they miss: halved to [`AREA`] all the same, areas and volumes of channel belts change by 4e-8 and 1e-8 of themselves,
/// at several times the cost. Terrain so steep that its area was off by 2e-4 has 2e-3.
const INNER_AREA: f64 = 1e-3;
/// The error of a flux up to which nothing is halved, as a share of area times the domain's diagonal: 1e-9 m in a domain of a kilometre.
const FLUX: f64 = 1e-12;
/// How often a piece is halved at most: 2⁻¹² of a span is less than what any curve deviates by.
const HALVINGS: u32 = 12;
/// The same inside the domain. A sliver between nearly parallel sheets is the difference of areas far larger than its own, which
/// no halving makes exact to a share of it.
const INNER_HALVINGS: u32 = 5;

/// A node with its weight, and with that of a poorer rule, to compare with.
type Node = (f64, f64, f64);

/// A rule, and the weights with which some of its nodes make a poorer rule, to compare with.
#[derive(Clone, Copy)]
enum Pair {
    /// Three nodes, and the middle alone.
    ThreeOne,
    /// Five nodes, and the middle with the outermost two (exact up to degree 3).
    FiveThree,
    /// Ten nodes, and six of them (exact up to degree 5).
    TenSix,
}

/// Weights of the poorer rules, as those of the rules are listed.
const ONE: &[f64] = &[2.0, 0.0];
const OUTERMOST: &[f64] = &[1.188_142_245_808_067_3, 0.0, 0.405_928_877_095_966_4];
const SIX: &[f64] = &[
    0.412_203_382_983_834_97,
    0.0,
    0.479_206_679_020_842_4,
    0.0,
    0.108_589_937_995_322_4,
];

/// All nodes: the middle one if there is one, then those on either side of it.
const fn nodes<const N: usize>(rule: Rule, poor: &[f64]) -> [Node; N] {
    let mut nodes = [(0.0, 0.0, 0.0); N];
    let odd = N % 2;
    let mut k = 0;
    while k < N {
        let at = k + odd;
        let (x, weight) = rule[at / 2];
        let x = if at.is_multiple_of(2) { x } else { -x };
        nodes[k] = (x, weight, poor[at / 2]);
        k += 1;
    }
    nodes
}

const THREE_ONE: [Node; 3] = nodes(THREE, ONE);
const FIVE_THREE: [Node; 5] = nodes(FIVE, OUTERMOST);
const TEN_SIX: [Node; 10] = nodes(TEN, SIX);

/// For pieces of computed curves: so short that a curve of degree 5 follows them to the tolerance.
const PIECE: Pair = Pair::ThreeOne;
/// The same on rational sheets: beside a pole, what lies across a piece varies faster than the piece does.
const RATIONAL_PIECE: Pair = Pair::TenSix;

/// How far a piece must go beyond a knot to pass it, as a share of all parameters.
const PASSED: f64 = 1e-9;

/// Which rule integrates polynomials of a sheet's flux exactly (degree 3d − 1), and others well.
fn rule(degree: usize, rational: bool) -> Pair {
    match (degree, rational) {
        (_, true) => Pair::TenSix,
        (0..=2, _) => Pair::ThreeOne,
        (3, _) => Pair::FiveThree,
        _ => Pair::TenSix,
    }
}

/// The highest degree of a polynomial sheet of whose flux [`TEN`] is exact.
const EXACT_DEGREE: usize = 6;

/// How well something is integrated.
#[derive(Clone, Copy, Debug)]
struct Goal {
    /// How often it may be halved yet.
    halvings: u32,
    /// Of the flux, per area (m).
    flux: f64,
    /// Whether fluxes are polynomials that the rule integrates exactly.
    exact: bool,
}

/// By how much a rule may be off whose poorer sibling differs by some amount, where values differ from their mean by another
/// in the mean. With n nodes errors fall as ρ^(−2n) on analytic functions, and the poorer ones have half as many at most, so the
/// ratio counts twice; ten times that, for functions that such a rule hardly resolves.
fn missed(difference: f64, spread: f64) -> f64 {
    if 10.0 * difference < spread {
        10.0 * difference * (difference / spread)
    } else {
        difference
    }
}

/// What is integrated: a [`Sum`] along a loop, and what has no errors yet across.
trait Summand: Copy + Default {
    fn area(&self) -> f64;
    fn flux(&self) -> f64;
    fn vector(&self) -> DVec3;
    fn plus_times(self, other: &Self, factor: f64) -> Self;
    fn sum(self) -> Sum;
}

impl Summand for Sum {
    fn area(&self) -> f64 {
        self.own.area
    }

    fn flux(&self) -> f64 {
        self.own.flux
    }

    fn vector(&self) -> DVec3 {
        self.vector
    }

    fn plus_times(self, other: &Self, factor: f64) -> Self {
        self.plus(other.times(factor))
    }

    fn sum(self) -> Sum {
        self
    }
}

/// A part of a sheet, as one parameter has it.
#[derive(Clone, Copy, Default)]
struct Part {
    area: f64,
    flux: f64,
    vector: DVec3,
}

impl Summand for Part {
    fn area(&self) -> f64 {
        self.area
    }

    fn flux(&self) -> f64 {
        self.flux
    }

    fn vector(&self) -> DVec3 {
        self.vector
    }

    fn plus_times(self, other: &Self, factor: f64) -> Self {
        Self {
            area: self.area + other.area * factor,
            flux: self.flux + other.flux * factor,
            vector: self.vector + other.vector * factor,
        }
    }

    fn sum(self) -> Sum {
        Sum {
            own: Integral {
                area: self.area,
                flux: self.flux,
                ..Integral::default()
            },
            vector: self.vector,
        }
    }
}

fn adaptive<S: Summand>(
    pair: Pair,
    from: f64,
    to: f64,
    goal: Goal,
    at: &mut impl FnMut(f64) -> S,
) -> Sum {
    // With the nodes as constants nothing is looped over or copied.
    match pair {
        Pair::ThreeOne => adaptive_of(&THREE_ONE, from, to, goal, at),
        Pair::FiveThree => adaptive_of(&FIVE_THREE, from, to, goal, at),
        Pair::TenSix => adaptive_of(&TEN_SIX, from, to, goal, at),
    }
}

fn adaptive_of<S: Summand, const N: usize>(
    nodes: &[Node; N],
    from: f64,
    to: f64,
    goal: Goal,
    at: &mut impl FnMut(f64) -> S,
) -> Sum {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let values = nodes.map(|(x, _, _)| at(middle + half * x));
    let mut all = S::default();
    for (value, (_, weight, _)) in values.iter().zip(nodes) {
        all = all.plus_times(value, *weight);
    }
    // Areas beside what the mean normal sees of them: that part is a polynomial.
    let normal = all.vector().normalize_or_zero();
    let areas = values.map(|value| value.area() - value.vector().dot(normal));
    let area_error = off(nodes, &areas, all.area() - all.vector().dot(normal));
    let flux_error = if goal.exact {
        0.0
    } else {
        off(nodes, &values.map(|value| value.flux()), all.flux())
    };
    if goal.halvings > 0 {
        let sizes = values.iter().zip(nodes);
        let size: f64 = sizes.map(|(value, node)| node.1 * value.area().abs()).sum();
        if area_error > 0.5 * AREA * size || flux_error > 0.5 * goal.flux * size {
            let fewer = Goal {
                halvings: goal.halvings - 1,
                ..goal
            };
            // Ten nodes from here on: what needs halving at all is settled by few halvings then.
            return adaptive(Pair::TenSix, from, middle, fewer, at).plus(adaptive(
                Pair::TenSix,
                middle,
                to,
                fewer,
                at,
            ));
        }
    }
    let mut sum = all.sum();
    sum.own.area_error += area_error;
    sum.own.flux_error += flux_error;
    sum.times(half)
}

/// By how much a rule may be off of something with these values and this sum.
fn off<const N: usize>(nodes: &[Node; N], values: &[f64; N], sum: f64) -> f64 {
    let mean = 0.5 * sum;
    let (mut difference, mut spread) = (0.0, 0.0);
    for (value, (_, weight, poor)) in values.iter().zip(nodes) {
        difference += (poor - weight) * value;
        spread += weight * (value - mean).abs();
    }
    missed(f64::abs(difference), spread)
}

/// The integral of something smooth by one rule.
fn integrate(rule: Rule, from: f64, to: f64, at: impl Fn(f64) -> f64) -> f64 {
    quadrature::between(rule, from, to)
        .map(|(x, weight)| weight * at(x))
        .sum()
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
    // First without halving anything, which nearly always does.
    let domain = &geometry.regions.domain;
    let flux = FLUX * (domain.high - domain.low).length();
    let (allowed, most) = if face.labels.contains(&None) {
        ([AREA, flux], HALVINGS)
    } else {
        ([INNER_AREA, f64::INFINITY], INNER_HALVINGS)
    };
    let mut whole = Integral::default();
    for halvings in [0, most] {
        let goal = Goal {
            halvings,
            flux,
            exact: false,
        };
        let across = Across::new(sheet, &face.polygons[0], middle, goal);
        whole = of_curved_face(geometry, tracks, arcs, face, &across);
        let [area, flux] = allowed;
        if whole.area_error <= area * whole.area.abs()
            && whole.flux_error <= flux * whole.area.abs()
        {
            break;
        }
    }
    whole
}

fn of_curved_face(
    geometry: Geometry<'_>,
    tracks: &Tracks,
    arcs: &[Arc],
    face: &Face,
    across: &Across<'_>,
) -> Integral {
    let sheet = across.sheet;
    let mut sum = Sum::default();
    for own in &face.loops {
        sum = sum.plus(gaps(geometry, tracks, arcs, own, across));
    }
    for half in face.loops.iter().flatten() {
        let arc = &arcs[half.arc];
        let source = tracks.tracks[arc.track].source;
        let sign = if half.forward { 1.0 } else { -1.0 };
        let outer = match source {
            Source::Crossing(_) if sheet.surface.is_rational() => RATIONAL_PIECE,
            Source::Crossing(_) => PIECE,
            Source::Edge(_) | Source::Pole(_) => across.along,
        };
        let goal = Goal {
            exact: across.exact && !matches!(source, Source::Crossing(_)),
            ..across.goal
        };
        let stops = across.stops(geometry, source, half.side, arc.t);
        let mut strip: Option<Strip> = None;
        for pair in stops.windows(2) {
            let run = geometry.run(source, half.side, [pair[0], pair[1]]);
            let base = across.base(run.at(0.5 * (pair[0] + pair[1])).0);
            let own = adaptive(outer, pair[0], pair[1], goal, &mut |t| {
                let (at, speed) = run.at(t);
                across.between(base, at, speed)
            });
            sum = sum.plus(own.times(sign));
            // Up to there the integral across depends on the place along alone: once for many pieces.
            let ends = [pair[0], pair[1]].map(|t| run.at(t).0[1 - across.axis]);
            match &mut strip {
                Some(strip) if strip.base == base && across.is_smooth(strip.range[0], ends[1]) => {
                    strip.range[1] = ends[1];
                }
                _ => {
                    let last = strip.replace(Strip { base, range: ends });
                    sum = sum.plus(across.strip(last).times(sign));
                }
            }
        }
        sum = sum.plus(across.strip(strip).times(sign));
    }
    sum.own
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
                    normal.dot((point - origin).cross(tangent))
                });
                area += sign * own;
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
        ..Integral::default()
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
) -> Sum {
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
    let mut sum = Sum::default();
    let mut last = ends(&own[own.len() - 1])[1];
    for half in own {
        let [first, end] = ends(half);
        sum = sum.plus(across.at(0.5 * (last + first), first - last));
        last = end;
    }
    sum
}

/// What lies between where integrals across start and a parameter across, beside a part of a loop.
#[derive(Clone, Copy, Debug)]
struct Strip {
    base: f64,
    /// From and to along the loop.
    range: [f64; 2],
}

/// Integrals across a sheet, in the direction with fewer spans, from a fixed parameter.
struct Across<'a> {
    sheet: &'a Sheet,
    /// The direction: 0 along u, 1 along v.
    axis: usize,
    from: f64,
    middle: DVec3,
    goal: Goal,
    rule: Pair,
    along: Pair,
    /// Whether rules integrate the sheet's flux exactly.
    exact: bool,
}

impl<'a> Across<'a> {
    fn new(sheet: &'a Sheet, polygon: &[DVec2], middle: DVec3, goal: Goal) -> Self {
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
            goal,
            exact: !rational && degrees.iter().all(|degree| *degree <= EXACT_DEGREE),
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
            let slack = PASSED * (knots[knots.len() - 1] - knots[0]);
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

    /// The parameter from which a place is looked at: where integrals start, or the last knot on the way from there.
    fn base(&self, place: DVec2) -> f64 {
        let (from, to) = (self.from, place[self.axis]);
        if self.goal.halvings > 0 {
            // What is halved is right to a share of itself: next to nothing, of what lies beside a knot.
            return from;
        }
        let knots = &self.sheet.knots[self.axis];
        let last = if to < from {
            let next = knots.partition_point(|knot| *knot <= to);
            knots.get(next).filter(|knot| **knot < from)
        } else {
            let next = knots.partition_point(|knot| *knot < to);
            next.checked_sub(1)
                .map(|last| &knots[last])
                .filter(|knot| **knot > from)
        };
        last.copied().unwrap_or(from)
    }

    /// Whether there is no knot between two places along.
    fn is_smooth(&self, from: f64, to: f64) -> bool {
        let knots = &self.sheet.knots[1 - self.axis];
        let (low, high) = (from.min(to), from.max(to));
        let slack = PASSED * (knots[knots.len() - 1] - knots[0]);
        let first = knots.partition_point(|knot| *knot <= low + slack);
        knots.get(first).is_none_or(|knot| *knot >= high - slack)
    }

    /// The integral over a strip.
    fn strip(&self, strip: Option<Strip>) -> Sum {
        let Some(Strip { base, range }) = strip.filter(|strip| strip.base != self.from) else {
            return Sum::default();
        };
        let goal = Goal {
            exact: self.exact,
            ..self.goal
        };
        let (mut place, mut speed) = (DVec2::splat(base), DVec2::ZERO);
        speed[1 - self.axis] = 1.0;
        adaptive(self.along, range[0], range[1], goal, &mut |x| {
            place[1 - self.axis] = x;
            self.between(self.from, place, speed)
        })
    }

    /// The integral across, up to a place, times the speed at which a loop passes along.
    fn at(&self, place: DVec2, speed: DVec2) -> Sum {
        self.between(self.from, place, speed)
    }

    /// The same from another parameter.
    fn between(&self, from: f64, place: DVec2, speed: DVec2) -> Sum {
        // ∬ f du dv = ∮ (∫ f du) dv = −∮ (∫ f dv) du
        let factor = if self.axis == 0 { speed.y } else { -speed.x };
        let to = place[self.axis];
        if factor == 0.0 || from == to {
            return Sum::default();
        }
        let (low, high) = (from.min(to), from.max(to));
        let knots = &self.sheet.knots[self.axis];
        let inner = knots.iter().copied().filter(|k| *k > low && *k < high);
        let fixed = if self.axis == 0 { Along::V } else { Along::U };
        let mut sum = Sum::default();
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
    fn span<const N: usize>(&self, slice: &Slice<N>, start: f64, end: f64) -> Sum {
        let goal = Goal {
            exact: self.exact,
            ..self.goal
        };
        adaptive(self.rule, start, end, goal, &mut |x| {
            let (p, along, other) = slice.jet(x);
            let normal = if self.axis == 0 {
                along.cross(other)
            } else {
                other.cross(along)
            };
            Part {
                area: normal.length(),
                flux: (p - self.middle).dot(normal) / 3.0,
                vector: normal,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The area under a graph of slopes `steep · sin(4x)` over [0, 1], by a rule.
    fn graph(pair: Pair, steep: f64, halvings: u32) -> Integral {
        let goal = Goal {
            halvings,
            flux: 1e-9,
            exact: true,
        };
        let at = |x: f64| {
            let slope = steep * (4.0 * x).sin();
            Sum {
                own: Integral {
                    area: slope.hypot(1.0),
                    ..Integral::default()
                },
                vector: DVec3::new(-slope, 0.0, 1.0),
            }
        };
        adaptive(pair, 0.0, 1.0, goal, &mut { at }).own
    }

    /// Simpson's rule with so many parts that it is right to rounding.
    fn length(steep: f64) -> f64 {
        const PARTS: u32 = 200_000;
        let step = 1.0 / f64::from(PARTS);
        let at = |i: f64| (steep * (4.0 * i * step).sin()).hypot(1.0);
        (0..PARTS)
            .map(|i| {
                let i = f64::from(i);
                step / 6.0 * (at(i) + 4.0 * at(i + 0.5) + at(i + 1.0))
            })
            .sum()
    }

    #[test]
    fn integrals_miss_by_no_more_than_their_errors_where_they_are_taken_for_good_however_steep() {
        let mut good = 0;
        for power in -60..=20 {
            let steep = 1.2_f64.powi(power);
            let wanted = length(steep);
            for (pair, count) in [
                (Pair::ThreeOne, 3),
                (Pair::FiveThree, 5),
                (Pair::TenSix, 10),
            ] {
                let [whole, halved] = [0, HALVINGS].map(|halvings| graph(pair, steep, halvings));
                let words = format!("{steep}, {count} nodes");
                assert!(
                    halved.area_error <= AREA * wanted,
                    "{words}: {}",
                    halved.area_error
                );
                let is_good = whole.area_error <= AREA * wanted;
                good += usize::from(is_good);
                for found in [Some(halved), is_good.then_some(whole)]
                    .into_iter()
                    .flatten()
                {
                    let miss = (found.area - wanted).abs();
                    // Sums of 200,000 parts are right to some 1e-13.
                    let bound = found.area_error + 1e-12 * wanted;
                    assert!(miss <= bound, "{words}: {miss} > {}", found.area_error);
                }
            }
        }
        // Else nothing was tried of those that are not halved.
        assert!(good > 20, "{good}");
    }

    #[test]
    fn poorer_rules_integrate_what_they_are_said_to() {
        let all: [(&[Node], i32); 3] = [(&THREE_ONE, 1), (&FIVE_THREE, 3), (&TEN_SIX, 5)];
        for (nodes, degree) in all {
            for power in 0..=degree {
                let sum: f64 = nodes.iter().map(|(x, _, poor)| poor * x.powi(power)).sum();
                let wanted = if power % 2 == 0 {
                    2.0 / f64::from(power + 1)
                } else {
                    0.0
                };
                assert!((sum - wanted).abs() < 1e-14, "x^{power}: {sum}");
            }
        }
    }
}
