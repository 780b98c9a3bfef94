//! The point of a curve or surface that is closest to a given one, and inversion (the parameters of a point on it).
//!
//! Branch and bound over Bézier pieces: a piece can only hold a closer point than the best so far if its squared
//! distance, a rational Bernstein polynomial, has a coefficient below it. Newton's method sharpens each new best. The
//! distance found exceeds the least one by no more than the tolerance, wherever the point lies.

use super::bezier::{Along, Patch, Region, halves};
use super::derive::binomial;
use super::{Curve, Surface};
use glam::{DVec3, Vec4Swizzles};

/// The closest point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Its parameter.
    pub parameter: f64,
    /// The point.
    pub point: DVec3,
    /// Its distance.
    pub distance: f64,
}

/// The closest point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestOnSurface {
    /// Its parameters u and v.
    pub parameters: (f64, f64),
    /// The point.
    pub point: DVec3,
    /// Its distance.
    pub distance: f64,
}

/// The closest place among some patches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) patch: usize,
    pub(super) s: f64,
    pub(super) t: f64,
    pub(super) distance: f64,
}

/// Tolerances below this fraction of the coordinates are lost in rounding.
const ROUNDING: f64 = 1e-14;

impl Curve {
    /// The point closest to p. Its distance is the least one to within `tolerance` (at least rounding); of several
    /// equally near points, one.
    pub fn closest(&self, p: DVec3, tolerance: f64) -> Closest {
        let pieces = Patch::of_curve(self);
        let found = nearest(
            pieces.iter().map(|(patch, _)| patch),
            p,
            tolerance,
            f64::INFINITY,
        );
        let parameter = found.map_or(self.domain().0, |found| {
            pieces[found.patch].1.at(found.s, found.t).0
        });
        let point = self.point(parameter);
        Closest {
            parameter,
            point,
            distance: point.distance(p),
        }
    }

    /// The parameter of a point on the curve, `None` if p is farther from it than `tolerance`.
    pub fn invert(&self, p: DVec3, tolerance: f64) -> Option<f64> {
        let closest = self.closest(p, 0.25 * tolerance);
        (closest.distance <= tolerance).then_some(closest.parameter)
    }
}

impl Surface {
    /// The point closest to p. Its distance is the least one to within `tolerance` (at least rounding); of several
    /// equally near points, one.
    pub fn closest(&self, p: DVec3, tolerance: f64) -> ClosestOnSurface {
        let pieces = Patch::of_surface(self);
        let found = nearest(
            pieces.iter().map(|(patch, _)| patch),
            p,
            tolerance,
            f64::INFINITY,
        );
        let start = (self.knots_u().domain().0, self.knots_v().domain().0);
        let parameters = found.map_or(start, |found| pieces[found.patch].1.at(found.s, found.t));
        let point = self.point(parameters.0, parameters.1);
        ClosestOnSurface {
            parameters,
            point,
            distance: point.distance(p),
        }
    }

    /// The parameters of a point on the surface, `None` if p is farther from it than `tolerance`.
    pub fn invert(&self, p: DVec3, tolerance: f64) -> Option<(f64, f64)> {
        let closest = self.closest(p, 0.25 * tolerance);
        (closest.distance <= tolerance).then_some(closest.parameters)
    }
}

/// The closest place of some patches to p, if it is nearer than `limit`.
pub(super) fn nearest<'a>(
    patches: impl Iterator<Item = &'a Patch>,
    p: DVec3,
    tolerance: f64,
    limit: f64,
) -> Option<Found> {
    let mut open: Vec<(f64, usize, Patch)> = patches
        .enumerate()
        .map(|(k, patch)| (box_distance(patch, p), k, patch))
        .filter(|(bound, _, _)| *bound < limit)
        .map(|(bound, k, patch)| (bound, k, patch.mapped(|x| x - p)))
        .collect();
    open.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut search = Search {
        best: None,
        limit,
        tolerance: 0.0,
    };
    for (bound, k, patch) in open {
        let (low, high) = patch.hull();
        let reach = low.abs().max(high.abs()).max_element() + p.abs().max_element();
        search.tolerance = tolerance.max(ROUNDING * reach);
        if search.can_improve(bound) {
            search.descend(k, &patch);
        }
    }
    search.best
}

fn box_distance(patch: &Patch, p: DVec3) -> f64 {
    let (low, high) = patch.hull();
    (p - p.clamp(low, high)).length()
}

struct Search {
    best: Option<Found>,
    limit: f64,
    tolerance: f64,
}

impl Search {
    fn bound(&self) -> f64 {
        self.best.map_or(self.limit, |best| best.distance)
    }

    fn can_improve(&self, lower_bound: f64) -> bool {
        match self.best {
            Some(best) => lower_bound < best.distance - self.tolerance,
            None => lower_bound < self.limit,
        }
    }

    /// Searches one patch, whose coordinates are relative to the given point.
    fn descend(&mut self, k: usize, root: &Patch) {
        let mut stack = vec![(root.clone(), Region::UNIT)];
        while let Some((patch, region)) = stack.pop() {
            if !self.can_improve(box_distance(&patch, DVec3::ZERO)) {
                continue;
            }
            let centre = region.at(0.5, 0.5);
            self.offer(k, root, centre);
            if self.everywhere_farther(&patch) {
                continue;
            }
            let (in_u, in_v) = patch.lengths(DVec3::length);
            // Below the tolerance the centre already stands for the whole piece.
            if in_u + in_v <= self.tolerance {
                continue;
            }
            let along = if in_u >= in_v { Along::U } else { Along::V };
            let [low, high] = halves(&patch, &region, along);
            // The nearer half last: it is popped first and tightens the bound for the other.
            let distance = |patch: &Patch| patch.jet(0.5, 0.5).point.length_squared();
            if distance(&low.0) < distance(&high.0) {
                stack.extend([high, low]);
            } else {
                stack.extend([low, high]);
            }
        }
        // What is good enough for the bound can still be made as good as rounding allows.
        if let Some(best) = self.best.as_mut().filter(|best| best.patch == k) {
            (best.s, best.t, best.distance) = sharpen(root, best.s, best.t);
        }
    }

    /// Takes the place, sharpened by Newton's method, if it is the best so far.
    fn offer(&mut self, k: usize, root: &Patch, (s, t): (f64, f64)) {
        let here = root.jet(s, t).point.length();
        if here >= self.bound() {
            return;
        }
        let (s, t, distance) = sharpen(root, s, t);
        self.best = Some(Found {
            patch: k,
            s,
            t,
            distance,
        });
    }

    /// Whether `|A|² - b² w²`, b the best distance less the tolerance, has no negative Bernstein coefficient.
    fn everywhere_farther(&self, patch: &Patch) -> bool {
        let bound = if self.best.is_some() {
            self.bound() - self.tolerance
        } else {
            self.limit
        };
        if bound <= 0.0 {
            return true;
        }
        if !bound.is_finite() {
            return false;
        }
        let (p, q) = (patch.degree_u, patch.degree_v);
        for k in 0..=2 * p {
            for l in 0..=2 * q {
                // The coefficient times its (positive) binomials.
                let mut sum = 0.0;
                for i in k.saturating_sub(p)..=k.min(p) {
                    let in_u = binomial(p, i) * binomial(p, k - i);
                    for j in l.saturating_sub(q)..=l.min(q) {
                        let (a, b) = (patch.control(i, j), patch.control(k - i, l - j));
                        let product = a.xyz().dot(b.xyz()) - bound * bound * a.w * b.w;
                        sum += in_u * binomial(q, j) * binomial(q, l - j) * product;
                    }
                }
                if sum < 0.0 {
                    return false;
                }
            }
        }
        true
    }
}

/// Newton's method for the distance from the origin, kept inside [0, 1]² and never uphill.
fn sharpen(patch: &Patch, mut s: f64, mut t: f64) -> (f64, f64, f64) {
    let mut distance = patch.jet(s, t).point.length();
    for _ in 0..20 {
        let Some(step) = newton_step(patch, s, t) else {
            break;
        };
        let longest = step.0.abs().max(step.1.abs());
        // Next to the foot point the distance is flat to rounding, but the parameters still improve.
        let most = if longest < 1e-5 {
            distance * (1.0 + 1e-14)
        } else {
            distance
        };
        let mut factor = 1.0;
        let mut moved = None;
        for _ in 0..6 {
            let next = (
                (s + factor * step.0).clamp(0.0, 1.0),
                (t + factor * step.1).clamp(0.0, 1.0),
            );
            let length = patch.jet(next.0, next.1).point.length();
            if length < distance || (longest < 1e-5 && length <= most) {
                moved = Some((next, length));
                break;
            }
            factor *= 0.25;
        }
        let Some((next, length)) = moved else { break };
        (s, t, distance) = (next.0, next.1, length);
        if longest < 1e-14 {
            break;
        }
    }
    (s, t, distance)
}

/// The step to where half the squared distance from the origin has no slope: by its second derivatives where they curve
/// upwards, else by the first derivatives alone (Gauss–Newton). `None` in a corner that the descent pushes into.
fn newton_step(patch: &Patch, s: f64, t: f64) -> Option<(f64, f64)> {
    let (jet, [uu, uv, vv]) = patch.second_jet(s, t);
    let slope = (jet.point.dot(jet.du), jet.point.dot(jet.dv));
    // At a side that the descent pushes against, slide along it.
    let blocked = |x: f64, slope: f64| (x <= 0.0 && slope > 0.0) || (x >= 1.0 && slope < 0.0);
    let hold_u = blocked(s, slope.0) || jet.du == DVec3::ZERO;
    let hold_v = blocked(t, slope.1) || jet.dv == DVec3::ZERO;
    let flat = (
        jet.du.length_squared(),
        jet.du.dot(jet.dv),
        jet.dv.length_squared(),
    );
    let bend = (jet.point.dot(uu), jet.point.dot(uv), jet.point.dot(vv));
    let curved = (flat.0 + bend.0, flat.1 + bend.1, flat.2 + bend.2);
    let determinant = |h: (f64, f64, f64)| h.0 * h.2 - h.1 * h.1;
    let choose = |upwards: bool| if upwards { curved } else { flat };
    match (hold_u, hold_v) {
        (true, true) => None,
        (true, false) => Some((0.0, -slope.1 / choose(curved.2 > 0.0).2)),
        (false, true) => Some((-slope.0 / choose(curved.0 > 0.0).0, 0.0)),
        (false, false) => {
            let h = choose(curved.0 > 0.0 && determinant(curved) > 0.0);
            let d = determinant(h);
            let step = (
                (h.1 * slope.1 - h.2 * slope.0) / d,
                (h.1 * slope.0 - h.0 * slope.1) / d,
            );
            (step.0.is_finite() && step.1.is_finite()).then_some(step)
        }
    }
}
