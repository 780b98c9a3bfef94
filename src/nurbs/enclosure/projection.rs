//! A patch seen along a ray: where, if anywhere, the ray crosses it.
//!
//! Coordinates are such that the ray runs in z. Let F(s, t) be the patch's x and y and M its Jacobian matrix at the
//! centre. If `M⁻¹ DF` differs from the identity by at most κ < 1/3 (in the maximum norm, all over the patch), then
//! `F̃ = M⁻¹ F` is one-to-one, its root lies within κ/2 of what the linear map says, and Newton's method, clamped to the
//! unit square, can only stand still at the root, or on the square's side when there is none: a standstill elsewhere would
//! need a step off by more than 2κ/(1 − κ) < 1 of the distance to the root.

use crate::nurbs::bezier::{Jet, Patch, Region};
use glam::{DMat2, DVec2, DVec3, Vec3Swizzles, Vec4Swizzles};

/// Greatest κ, below the 1/3 of the argument above.
const MOST_BENT: f64 = 0.3;

/// The linear map that a patch's projection is close to, and how close.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    centre: DVec2,
    inverse: DMat2,
    /// The root is at most this far, in s or t, from what the linear map says.
    slack: f64,
    /// As far in s and t as the shell's tolerance in x and y, with a margin.
    reach: DVec2,
    height: f64,
    slope: DVec2,
    /// The crossing's height is at most this far from what the linear map says.
    height_error: f64,
    upward: bool,
}

/// What the linear map says of a ray.
pub(super) enum Verdict {
    /// The ray doesn't cross.
    Miss,
    /// The ray crosses, away from the patch's sides; about here.
    Crosses(DVec2),
    /// The patch itself must be asked, from here.
    Near(DVec2),
}

/// Where the ray crosses.
pub(super) struct Crossing {
    pub(super) parameters: (f64, f64),
    /// Parameters nearer than this can't be told apart at the shell's tolerance.
    pub(super) reach: (f64, f64),
    pub(super) height: f64,
    /// Whether the patch's normal has a component along the ray.
    pub(super) upward: bool,
    /// Whether the crossing can't be told from one through a side of the patch.
    pub(super) on_side: bool,
}

impl Crossing {
    /// Turns parameters on the part of a patch into those on the patch.
    pub(super) fn place(&mut self, part: &Region) {
        let (in_u, in_v) = part.lengths();
        self.parameters = part.at(self.parameters.0, self.parameters.1);
        self.reach = (self.reach.0 * in_u, self.reach.1 * in_v);
    }
}

impl Projection {
    /// The linear map, unless the patch is bent too much, seen edge-on, or no larger than the tolerance.
    pub(super) fn new(patch: &Patch, tolerance: f64) -> Option<Self> {
        let Jet { point, du, dv } = patch.jet(0.5, 0.5);
        let jacobian = DMat2::from_cols(du.xy(), dv.xy());
        let determinant = jacobian.determinant();
        // Written so that a determinant that is not a number fails too.
        let regular = determinant.abs() > 1e-9 * du.xy().length() * dv.xy().length();
        if !regular || determinant == 0.0 {
            return None;
        }
        let inverse = jacobian.inverse();
        let rows = DVec2::new(
            inverse.x_axis.x.abs() + inverse.y_axis.x.abs(),
            inverse.x_axis.y.abs() + inverse.y_axis.y.abs(),
        );
        let reach = 8.0 * tolerance * rows;
        let bend = bend(patch, point.xy(), &inverse);
        if !(bend <= MOST_BENT && reach.max_element() < 0.1) {
            return None;
        }
        let slack = 0.5 * bend + reach.max_element() + 1e-9;
        let slope = DVec2::new(du.z, dv.z);
        let steepness = slope.x.abs() + slope.y.abs();
        let height_error = height_error(patch, point.z, slope) + steepness * slack;
        Some(Self {
            centre: point.xy(),
            inverse,
            slack,
            reach,
            height: point.z,
            slope,
            height_error,
            upward: determinant > 0.0,
        })
    }

    /// What the linear map says of the ray upwards from `start`; `near` is the width of the shell itself.
    pub(super) fn judge(&self, start: DVec3, near: f64) -> Verdict {
        let offset = self.inverse * (start.xy() - self.centre);
        let outside = 0.5 + self.slack;
        if offset.x.abs() > outside || offset.y.abs() > outside {
            return Verdict::Miss;
        }
        let above = self.height + self.slope.dot(offset) - start.z;
        let unsure = self.height_error + near;
        if above < -unsure {
            return Verdict::Miss;
        }
        let inside = 0.5 - self.slack;
        if above > unsure && offset.x.abs() < inside && offset.y.abs() < inside {
            return Verdict::Crosses(offset + 0.5);
        }
        Verdict::Near(offset + 0.5)
    }

    /// The crossing of the line through (x, y), from Newton's method on the patch itself; `jet` gives it on [0, 1]².
    pub(super) fn locate(
        &self,
        target: DVec2,
        guess: DVec2,
        tolerance: f64,
        jet: impl Fn(DVec2) -> Jet,
    ) -> Option<Crossing> {
        let mut s = guess.clamp(DVec2::ZERO, DVec2::ONE);
        let mut here = jet(s);
        for round in 0..100 {
            let residual = target - here.point.xy();
            let jacobian = DMat2::from_cols(here.du.xy(), here.dv.xy());
            // Newton's steps are quick; if they circle, the contraction with M can't.
            let step = if round < 12 {
                jacobian.inverse()
            } else {
                self.inverse
            } * residual;
            let next = (s + step).clamp(DVec2::ZERO, DVec2::ONE);
            let moved = (next - s).abs().max_element();
            s = next;
            if moved == 0.0 {
                break;
            }
            here = jet(s);
            if moved < 1e-13 {
                break;
            }
        }
        if (target - here.point.xy()).length() > tolerance {
            return None;
        }
        let inner = s.min(1.0 - s);
        Some(Crossing {
            parameters: (s.x, s.y),
            reach: (self.reach.x, self.reach.y),
            height: here.point.z,
            upward: self.upward,
            on_side: inner.x <= self.reach.x || inner.y <= self.reach.y,
        })
    }
}

/// κ: how far `M⁻¹ DF` is from the identity, bounded by Bernstein coefficients. With `x = X/W` and coordinates relative to
/// the centre, `x_u = (X_u - x W_u) / W`.
fn bend(patch: &Patch, centre: DVec2, inverse: &DMat2) -> f64 {
    let (p, q) = (patch.degree_u, patch.degree_v);
    let (least, most) = patch.weight_range();
    let weighted = |i: usize, j: usize| {
        let h = patch.control(i, j);
        (*inverse * (h.xy() - h.w * centre), h.w)
    };
    let mut worst = [DVec2::ZERO; 2];
    let mut weight_slope = [0.0_f64; 2];
    let mut extent = DVec2::ZERO;
    for i in 0..=p {
        for j in 0..=q {
            let (here, w) = weighted(i, j);
            extent = extent.max(here.abs() / w);
            let legs = [
                (i < p, i + 1, j, p, DVec2::X),
                (j < q, i, j + 1, q, DVec2::Y),
            ];
            for (k, (exists, i, j, degree, unit)) in legs.into_iter().enumerate() {
                if exists {
                    let (there, other) = weighted(i, j);
                    let leg = degree as f64 * (there - here);
                    let off = (leg / least - unit).abs().max((leg / most - unit).abs());
                    worst[k] = worst[k].max(off);
                    weight_slope[k] = weight_slope[k].max(degree as f64 * (other - w).abs());
                }
            }
        }
    }
    let turned = extent * (weight_slope[0] + weight_slope[1]) / least;
    (worst[0] + worst[1] + turned).max_element()
}

/// How far the patch's height is from `height + slope · (s - ½, t - ½)`, by linear precision of the Bernstein polynomials.
fn height_error(patch: &Patch, height: f64, slope: DVec2) -> f64 {
    let (p, q) = (patch.degree_u as f64, patch.degree_v as f64);
    let mut worst = 0.0_f64;
    for i in 0..=patch.degree_u {
        for j in 0..=patch.degree_v {
            let h = patch.control(i, j);
            let at = DVec2::new(i as f64 / p - 0.5, j as f64 / q - 0.5);
            worst = worst.max((h.z / h.w - height - slope.dot(at)).abs());
        }
    }
    // Unequal weights shift the parameters by no more than this.
    let (least, most) = patch.weight_range();
    worst + (slope.x.abs() + slope.y.abs()) * (most - least) / least
}
