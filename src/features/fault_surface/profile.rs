//! Profiles across faults: elevations along the direction in which a fault dips, below the place where it is anchored.

use crate::nurbs::interpolate::{self, InterpolateError};
use crate::nurbs::{Function, KnotError, KnotVector};

/// Pieces of the spline that stands for an exponential, and how many of its characteristic lengths they cover. Cubic interpolation is
/// then within 1e-6 of the depth; beyond, it is flat to 1/160,000 of its dip, and goes on straight.
const PIECES: usize = 96;
const LENGTHS: f64 = 12.0;
/// Most that a spline's degree is.
const DEGREE: usize = 3;

/// A profile z = F(x), x along the direction of dip; straight beyond its ends, and once differentiable everywhere.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Profile {
    /// Straight down to x = 0, then an arc that is level at the depth H, then level.
    Circular {
        /// δ₀ (rad).
        dip: f64,
        /// R = H/(1 − cos δ₀) (m).
        radius: f64,
    },
    /// A spline over its knots, straight beyond them.
    Spline {
        /// The spline.
        function: Function,
        /// Its slopes at both ends.
        slopes: [f64; 2],
    },
}

impl Profile {
    /// The arc that begins with a dip (rad) and is level at a depth (m).
    pub(super) fn circular(dip: f64, depth: f64) -> Self {
        let radius = depth / (1.0 - dip.cos());
        Self::Circular { dip, radius }
    }

    /// F = −H (1 − e^(−x tan δ₀/H)), as a spline.
    pub(super) fn exponential(dip: f64, depth: f64) -> Result<Self, ProfileError> {
        let length = depth / dip.tan();
        let uniform = KnotVector::uniform(DEGREE, PIECES + DEGREE)?;
        let knots = uniform.as_slice().iter().map(|t| t * LENGTHS * length);
        let knots = KnotVector::new(DEGREE, knots.collect())?;
        let f = |x: f64| depth * (-x / length).exp_m1();
        Ok(Self::of(Function::interpolated(&knots, f)?))
    }

    /// Through places (x, z), x growing: a cubic spline, or a line or a parabola through two or three of them.
    pub(super) fn through(places: &[[f64; 2]]) -> Result<Self, ProfileError> {
        let params: Vec<f64> = places.iter().map(|place| place[0]).collect();
        let degree = DEGREE.min(places.len().saturating_sub(1)).max(1);
        let points = places
            .iter()
            .map(|place| glam::DVec3::new(0.0, 0.0, place[1]));
        let rows = [points.collect()];
        let (knots, rows) = interpolate::with_parameters(&rows, &params, degree)?;
        let [row] = &rows[..] else {
            return Err(ProfileError::Empty);
        };
        // The spline itself, by its coefficients: interpolated at its own Greville abscissae it is reproduced.
        let spline = |t: f64| {
            let basis = knots.basis(t);
            let own = row[basis.first()..].iter().zip(basis.values());
            own.map(|(c, n)| c.z * n).sum()
        };
        Ok(Self::of(Function::interpolated(&knots, spline)?))
    }

    fn of(function: Function) -> Self {
        let (knots, c) = (function.knots(), function.coefficients());
        let (p, all, n) = (knots.degree(), knots.as_slice(), c.len());
        // The first and the last leg over their knot spans, times the degree.
        let slope = |a: usize, from: f64, to: f64| (c[a + 1] - c[a]) * p as f64 / (to - from);
        let slopes = [
            slope(0, all[1], all[p + 1]),
            slope(n - 2, all[n - 1], all[n + p - 1]),
        ];
        Self::Spline { function, slopes }
    }

    /// F(x).
    pub(super) fn value(&self, x: f64) -> f64 {
        match self {
            Self::Circular { dip, radius } => {
                let (sin, cos) = dip.sin_cos();
                if x <= 0.0 {
                    return -x * dip.tan();
                }
                let s = (sin - x / radius).max(0.0);
                -radius * ((1.0 - s * s).sqrt() - cos)
            }
            Self::Spline { function, slopes } => {
                let (start, end) = function.knots().domain();
                let beyond = slopes[0] * (x - start).min(0.0) + slopes[1] * (x - end).max(0.0);
                function.value(x) + beyond
            }
        }
    }

    /// F′(x).
    pub(super) fn slope(&self, x: f64) -> f64 {
        match self {
            Self::Circular { dip, radius } => {
                if x <= 0.0 {
                    return -dip.tan();
                }
                let s = (dip.sin() - x / radius).max(0.0);
                -s / (1.0 - s * s).sqrt()
            }
            Self::Spline { function, slopes } => {
                let knots = function.knots();
                let (start, end) = knots.domain();
                if x <= start {
                    return slopes[0];
                }
                if x >= end {
                    return slopes[1];
                }
                let rows = knots.basis_derivatives(x, 1);
                let own = &function.coefficients()[knots.span(x) - knots.degree()..];
                own.iter().zip(&rows[1]).map(|(c, n)| c * n).sum()
            }
        }
    }

    /// The places between which it is not straight.
    pub(super) fn bent(&self) -> [f64; 2] {
        match self {
            Self::Circular { dip, radius } => [0.0, radius * dip.sin()],
            Self::Spline { function, .. } => {
                let (start, end) = function.knots().domain();
                [start, end]
            }
        }
    }

    /// Control points (x, z) with weights along it between two places, with its knots: smooth, and exact. `from` and `to` are outside of
    /// what is bent, or are moved there.
    pub(super) fn net(&self, from: f64, to: f64) -> Result<Net, ProfileError> {
        let [start, end] = self.bent();
        let span = end - start;
        let (from, to) = (from.min(start - 1e-3 * span), to.max(end + 1e-3 * span));
        match self {
            Self::Circular { dip, radius } => {
                let at = |x: f64| [x, self.value(x)];
                let middle = radius * (0.5 * dip).tan();
                let weight = (0.5 * dip).cos();
                let corner = [middle * dip.cos(), -middle * dip.sin()];
                // A speed of the lines that is the arc's at its ends: 2 w |P₁ − P₀| over a domain of one.
                let speed = 2.0 * weight * middle;
                let lengths = [-from / dip.cos(), to - end].map(|length| length / speed);
                let half = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| f64::midpoint(a[k], b[k]));
                let [first, joint, flat, last] = [at(from), at(start), at(end), at(to)];
                let (a, d) = (-lengths[0], 1.0 + lengths[1]);
                Ok(Net {
                    knots: KnotVector::new(2, vec![a, a, a, 0.0, 0.0, 1.0, 1.0, d, d, d])?,
                    points: vec![
                        first,
                        half(first, joint),
                        joint,
                        corner,
                        flat,
                        half(flat, last),
                        last,
                    ],
                    weights: vec![1.0, 1.0, 1.0, weight, 1.0, 1.0, 1.0],
                })
            }
            Self::Spline { function, .. } => {
                let (knots, p) = (function.knots(), function.knots().degree());
                let mut points: Vec<[f64; 2]> = (0..knots.count())
                    .map(|i| [knots.greville(i), function.coefficients()[i]])
                    .collect();
                let mut all = knots.as_slice()[1..].to_vec();
                all.pop();
                // Straight pieces before and after, with control points evenly along them.
                let steps = |a: f64, b: f64, k: usize| a + (b - a) * k as f64 / p as f64;
                let before = (0..p).map(|k| steps(from, start, k));
                let after = (1..=p).map(|k| steps(end, to, k));
                let place = |x: f64| [x, self.value(x)];
                points.splice(0..0, before.map(place).collect::<Vec<_>>());
                points.extend(after.map(place));
                all.splice(0..0, vec![from; p + 1]);
                all.extend(vec![to; p + 1]);
                let weights = vec![1.0; points.len()];
                Ok(Net {
                    knots: KnotVector::new(p, all)?,
                    points,
                    weights,
                })
            }
        }
    }
}

/// A profile as a curve.
pub(super) struct Net {
    pub(super) knots: KnotVector,
    /// (x, z).
    pub(super) points: Vec<[f64; 2]>,
    pub(super) weights: Vec<f64>,
}

/// Why numbers make no profile.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProfileError {
    /// There is nothing to pass through.
    #[error("the profile has no points; give at least two")]
    Empty,
    /// The points cannot be interpolated.
    #[error("the profile cannot be interpolated: {0}")]
    Interpolate(#[from] InterpolateError),
    /// Its knots are none.
    #[error("the profile has no knots: {0}")]
    Knots(#[from] KnotError),
}
