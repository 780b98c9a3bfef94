//! A patch as seen along a line: what its control net says of zeros, and its halves.

use glam::{DVec2, Vec4Swizzles};
use smallvec::SmallVec;

use super::line::Line;
use crate::nurbs::bezier::Patch;
use crate::nurbs::knots::ORDER;

/// How far beyond the borders of a patch, in its parameters, a place still belongs to it: rounding.
const BORDER: f64 = 1e-9;

/// How far beyond its borders the cones of a patch's differences still are apart, if they are by the next number.
const BESIDE: f64 = 1e-2;
/// The greatest product of the slopes of two cones that are apart: 1 would do within the patch.
const APART: f64 = 0.8;

/// What a part of a patch is to a line.
pub(super) enum Verdict {
    /// The line does not pass through it.
    Beside,
    /// It does, once, at these parameters of the view.
    Passes(DVec2),
    Unknown,
}

/// A part of a patch as seen along a line, the line at the origin.
#[derive(Clone, Debug)]
pub(super) struct View {
    rows: usize,
    columns: usize,
    net: SmallVec<[DVec2; 16]>,
    /// The least weight: a distance of one is this much in the net at least.
    weight: f64,
    low: DVec2,
    size: DVec2,
}

impl View {
    pub(super) fn new(patch: &Patch, line: Line) -> Self {
        let origin = line.view(line.through);
        Self {
            rows: patch.degree_u + 1,
            columns: patch.degree_v + 1,
            // First what is subtracted: far from the origin of coordinates that costs no digits.
            net: patch
                .net
                .iter()
                .map(|h| {
                    if h.w == 1.0 {
                        line.view(h.xyz()) - origin
                    } else {
                        (line.view(h.xyz() / h.w) - origin) * h.w
                    }
                })
                .collect(),
            weight: patch.weight_range().0,
            low: DVec2::ZERO,
            size: DVec2::ONE,
        }
    }

    /// Parameters of the patch at parameters of this part.
    pub(super) fn place(&self, at: DVec2) -> DVec2 {
        (self.low + self.size * at).clamp(DVec2::ZERO, DVec2::ONE)
    }

    pub(super) fn extent(&self) -> f64 {
        let (low, high) = hull(&self.net);
        (high - low).max_element() / self.weight
    }

    pub(super) fn judge(&self, near: f64) -> Verdict {
        let near = near * self.weight;
        let (low, high) = hull(&self.net);
        if low.cmpgt(DVec2::splat(near)).any() || high.cmplt(DVec2::splat(-near)).any() {
            return Verdict::Beside;
        }
        let (middle, s, t) = self.jet(DVec2::splat(0.5));
        let determinant = s.perp_dot(t);
        if !(determinant.abs() > 1e-12 * s.length() * t.length()) {
            return Verdict::Unknown;
        }
        // In the parameters of the linear map at the middle: one there is the size of the part.
        let unskewed = |p: DVec2| DVec2::new(p.perp_dot(t), s.perp_dot(p)) / determinant;
        let straight: SmallVec<[DVec2; 16]> = self.net.iter().map(|p| unskewed(*p)).collect();
        let slack = DVec2::new(t.length(), s.length()) * (near / determinant.abs());
        let (low, high) = hull(&straight);
        if low.cmpgt(slack).any() || high.cmplt(-slack).any() {
            return Verdict::Beside;
        }
        if !self.is_injective(&straight) {
            return Verdict::Unknown;
        }
        // The linear map is a good start.
        let Some(at) = self.newton(DVec2::splat(0.5) - unskewed(middle)) else {
            return Verdict::Unknown;
        };
        let within =
            |by: f64| at.cmpge(DVec2::splat(-by)).all() && at.cmple(DVec2::splat(1.0 + by)).all();
        if within(BORDER) {
            Verdict::Passes(at)
        } else if within(BESIDE) {
            // There is one zero here, and it is the neighbour's.
            Verdict::Beside
        } else {
            Verdict::Unknown
        }
    }

    /// Whether the differences of a net along s and along t lie in two cones that are apart.
    fn is_injective(&self, net: &[DVec2]) -> bool {
        let (mut tilt_s, mut tilt_t) = (0.0_f64, 0.0_f64);
        for i in 0..self.rows {
            for j in 0..self.columns {
                let here = net[i * self.columns + j];
                if i + 1 < self.rows {
                    let leg = net[(i + 1) * self.columns + j] - here;
                    if !(leg.x > 0.0) {
                        return false;
                    }
                    tilt_s = tilt_s.max(leg.y.abs() / leg.x);
                }
                if j + 1 < self.columns {
                    let leg = net[i * self.columns + j + 1] - here;
                    if !(leg.y > 0.0) {
                        return false;
                    }
                    tilt_t = tilt_t.max(leg.x.abs() / leg.y);
                }
            }
        }
        tilt_s * tilt_t < APART
    }

    fn newton(&self, mut at: DVec2) -> Option<DVec2> {
        for _ in 0..16 {
            let (g, s, t) = self.jet(at);
            let determinant = s.perp_dot(t);
            if determinant == 0.0 {
                return None;
            }
            let step = DVec2::new(g.perp_dot(t), s.perp_dot(g)) / determinant;
            at -= step;
            if !at.is_finite() || at.abs().max_element() > 4.0 {
                return None;
            }
            // The next step would be the square of it.
            if step.abs().max_element() < 1e-8 {
                return Some(at);
            }
        }
        None
    }

    /// The value and both derivatives. With the usual orders as constants nothing is looped over.
    fn jet(&self, at: DVec2) -> (DVec2, DVec2, DVec2) {
        match (self.rows, self.columns) {
            (2, 2) => self.jet_of::<2, 2>(at),
            (2, 4) => self.jet_of::<2, 4>(at),
            (4, 2) => self.jet_of::<4, 2>(at),
            (4, 4) => self.jet_of::<4, 4>(at),
            _ => self.jet_of::<ORDER, ORDER>(at),
        }
    }

    /// The same; `R` and `C` are the orders, or the most.
    #[inline]
    fn jet_of<const R: usize, const C: usize>(&self, at: DVec2) -> (DVec2, DVec2, DVec2) {
        let rows = if R == ORDER { self.rows } else { R };
        let columns = if C == ORDER { self.columns } else { C };
        let mut values = [DVec2::ZERO; R];
        let mut slopes = [DVec2::ZERO; R];
        for (i, row) in self.net.chunks_exact(columns).take(rows).enumerate() {
            (values[i], slopes[i]) = casteljau::<C>(row, at.y);
        }
        let (value, s) = casteljau::<R>(&values[..rows], at.x);
        (value, s, casteljau::<R>(&slopes[..rows], at.x).0)
    }

    pub(super) fn halves(&self) -> [Self; 2] {
        let leg = |i: usize, j: usize, step: usize| {
            (self.net[i * self.columns + j + step] - self.net[i * self.columns + j]).length()
        };
        let (mut long_s, mut long_t) = (0.0_f64, 0.0_f64);
        for j in 0..self.columns {
            long_s = long_s.max((0..self.rows - 1).map(|i| leg(i, j, self.columns)).sum());
        }
        for i in 0..self.rows {
            long_t = long_t.max((0..self.columns - 1).map(|j| leg(i, j, 1)).sum());
        }
        let along_s = long_s >= long_t;
        let (lines, order, line_step, step) = if along_s {
            (self.columns, self.rows, 1, self.columns)
        } else {
            (self.rows, self.columns, self.columns, 1)
        };
        let (mut low, mut high) = (self.clone(), self.clone());
        for line in 0..lines {
            let at = |k: usize| line * line_step + k * step;
            for round in 1..order {
                for k in 0..order - round {
                    high.net[at(k)] = 0.5 * (high.net[at(k)] + high.net[at(k + 1)]);
                }
                low.net[at(round)] = high.net[at(0)];
            }
        }
        let half = if along_s {
            DVec2::new(0.5, 1.0)
        } else {
            DVec2::new(1.0, 0.5)
        };
        high.low += high.size * (DVec2::ONE - half);
        low.size *= half;
        high.size *= half;
        [low, high]
    }
}

/// Value and derivative of a Bézier curve; `N` is the number of its points, or the most.
#[inline]
fn casteljau<const N: usize>(points: &[DVec2], t: f64) -> (DVec2, DVec2) {
    let degree = points.len() - 1;
    if degree == 0 {
        return (points[0], DVec2::ZERO);
    }
    let mut work = [DVec2::ZERO; N];
    work[..=degree].copy_from_slice(points);
    for round in 1..degree {
        for k in 0..=degree - round {
            work[k] = work[k].lerp(work[k + 1], t);
        }
    }
    (
        work[0] + (work[1] - work[0]) * t,
        (work[1] - work[0]) * degree as f64,
    )
}

fn hull(points: &[DVec2]) -> (DVec2, DVec2) {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    points
        .iter()
        .fold(empty, |(low, high), p| (low.min(*p), high.max(*p)))
}
