//! Distributions that numbers are drawn from.
//!
//! Normal and lognormal distributions are given by the mean and the standard deviation of the quantity itself (not of its
//! logarithm) and may be truncated by `min` and `max`; a truncated draw is repeated until it falls inside, at most
//! [`MAX_REJECTIONS`] times. Uniform and triangular draws invert the distribution function, one number of the stream each.
//!
//! Known limit: lognormal draws use the exponential function of the platform, whose last digit may differ between systems.

mod error;
mod table;

pub use error::{DistributionError, DrawError};
pub(crate) use table::{DistributionSchema, NAMES, distribution, keys, truncation};

use crate::model::stream::Stream;

/// How many draws of a truncated distribution may fall outside before the draw is given up.
///
/// [`Distribution::truncated`] refuses what keeps less than [`LEAST_KEPT`], so giving up has a probability below 10⁻⁴³.
pub const MAX_REJECTIONS: usize = 100_000;

/// The smallest part of a distribution that truncation may keep.
pub const LEAST_KEPT: f64 = 1e-3;

/// A distribution of numbers; its parameters are in order and finite by construction.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    shape: Shape,
    bounds: Bounds,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Uniform {
        min: f64,
        max: f64,
    },
    Triangular {
        min: f64,
        mode: f64,
        max: f64,
    },
    Normal {
        mean: f64,
        sd: f64,
    },
    /// `mu` and `sigma` are the mean and standard deviation of the logarithm.
    LogNormal {
        mu: f64,
        sigma: f64,
    },
    /// Values with their weights, which need not sum to 1.
    Discrete(Vec<(f64, f64)>),
}

/// Where a distribution is truncated; infinite where it is not.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bounds {
    min: f64,
    max: f64,
}

const UNBOUNDED: Bounds = Bounds {
    min: f64::NEG_INFINITY,
    max: f64::INFINITY,
};

fn finite(values: &[f64]) -> Result<(), DistributionError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(DistributionError::NotFinite { value }),
        None => Ok(()),
    }
}

impl Distribution {
    fn unbounded(shape: Shape) -> Self {
        Self {
            shape,
            bounds: UNBOUNDED,
        }
    }

    /// Every number between `min` and `max` is equally likely.
    pub fn uniform(min: f64, max: f64) -> Result<Self, DistributionError> {
        finite(&[min, max])?;
        if min < max {
            Ok(Self::unbounded(Shape::Uniform { min, max }))
        } else {
            Err(DistributionError::Uniform { min, max })
        }
    }

    /// The density rises linearly from `min` to `mode` and falls linearly to `max`.
    pub fn triangular(min: f64, mode: f64, max: f64) -> Result<Self, DistributionError> {
        finite(&[min, mode, max])?;
        if min <= mode && mode <= max && min < max {
            Ok(Self::unbounded(Shape::Triangular { min, mode, max }))
        } else {
            Err(DistributionError::Triangular { min, mode, max })
        }
    }

    /// The normal distribution of the given mean and standard deviation.
    pub fn normal(mean: f64, sd: f64) -> Result<Self, DistributionError> {
        finite(&[mean, sd])?;
        if sd > 0.0 {
            Ok(Self::unbounded(Shape::Normal { mean, sd }))
        } else {
            Err(DistributionError::StandardDeviation { sd })
        }
    }

    /// The lognormal distribution whose own (not its logarithm's) mean and standard deviation are given:
    /// σ² = ln(1 + (sd/mean)²), μ = ln(mean) − σ²/2.
    pub fn lognormal(mean: f64, sd: f64) -> Result<Self, DistributionError> {
        finite(&[mean, sd])?;
        if mean <= 0.0 {
            return Err(DistributionError::LogNormalMean { mean });
        }
        if sd <= 0.0 {
            return Err(DistributionError::StandardDeviation { sd });
        }
        let variance = (sd / mean).powi(2).ln_1p();
        Ok(Self::unbounded(Shape::LogNormal {
            mu: mean.ln() - variance / 2.0,
            sigma: variance.sqrt(),
        }))
    }

    /// One of the given values, each with a probability in proportion to its weight.
    pub fn discrete(values: Vec<(f64, f64)>) -> Result<Self, DistributionError> {
        if values.is_empty() {
            return Err(DistributionError::NoValues);
        }
        for &(value, weight) in &values {
            finite(&[value, weight])?;
            if weight < 0.0 {
                return Err(DistributionError::Weight { value, weight });
            }
        }
        if values.iter().all(|&(_, weight)| weight == 0.0) {
            return Err(DistributionError::NoWeight);
        }
        Ok(Self::unbounded(Shape::Discrete(values)))
    }

    /// The same normal or lognormal distribution, limited to `min` ≤ value ≤ `max` (`None`: no limit on that side).
    pub fn truncated(self, min: Option<f64>, max: Option<f64>) -> Result<Self, DistributionError> {
        if min.is_none() && max.is_none() {
            return Ok(self);
        }
        if !matches!(self.shape, Shape::Normal { .. } | Shape::LogNormal { .. }) {
            return Err(DistributionError::NotTruncatable);
        }
        for value in [min, max].into_iter().flatten() {
            finite(&[value])?;
        }
        let bounds = Bounds {
            min: min.unwrap_or(UNBOUNDED.min),
            max: max.unwrap_or(UNBOUNDED.max),
        };
        if bounds.min >= bounds.max {
            return Err(DistributionError::Limits {
                min: bounds.min,
                max: bounds.max,
            });
        }
        let truncated = Self {
            shape: self.shape,
            bounds,
        };
        let kept = truncated.kept();
        if kept < LEAST_KEPT {
            return Err(DistributionError::Hopeless {
                min: bounds.min,
                max: bounds.max,
                kept,
            });
        }
        Ok(truncated)
    }

    /// The next number of the stream that follows this distribution.
    pub fn sample(&self, stream: &mut Stream) -> Result<f64, DrawError> {
        for _ in 0..MAX_REJECTIONS {
            let value = self.shape.sample(stream);
            if self.bounds.min <= value && value <= self.bounds.max {
                return Ok(value);
            }
        }
        Err(DrawError::Truncation {
            attempts: MAX_REJECTIONS,
            min: self.bounds.min,
            max: self.bounds.max,
        })
    }

    /// The smallest and the largest possible value; infinite where nothing limits it.
    pub fn support(&self) -> (f64, f64) {
        let (min, max) = match &self.shape {
            Shape::Uniform { min, max } | Shape::Triangular { min, max, .. } => (*min, *max),
            Shape::Normal { .. } => (f64::NEG_INFINITY, f64::INFINITY),
            Shape::LogNormal { .. } => (0.0, f64::INFINITY),
            Shape::Discrete(values) => values
                .iter()
                .filter(|&&(_, weight)| weight > 0.0)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &(v, _)| {
                    (lo.min(v), hi.max(v))
                }),
        };
        (min.max(self.bounds.min), max.min(self.bounds.max))
    }

    /// Whether the lower end of the support is itself possible: false for a lognormal distribution that starts at 0.
    pub fn reaches_minimum(&self) -> bool {
        !(matches!(self.shape, Shape::LogNormal { .. }) && self.bounds.min <= 0.0)
    }

    /// The expected value, in closed form (truncated ones too).
    pub fn mean(&self) -> f64 {
        match &self.shape {
            Shape::Uniform { min, max } => f64::midpoint(*min, *max),
            Shape::Triangular { min, mode, max } => (min + mode + max) / 3.0,
            Shape::Normal { mean, sd } => {
                let (a, b) = self.standard_bounds();
                mean + sd * (density(a) - density(b)) / between(a, b)
            }
            Shape::LogNormal { mu, sigma } => {
                let (a, b) = self.standard_bounds();
                (mu + sigma * sigma / 2.0).exp() * between(a - sigma, b - sigma) / between(a, b)
            }
            Shape::Discrete(values) => {
                let total: f64 = values.iter().map(|&(_, weight)| weight).sum();
                values
                    .iter()
                    .map(|&(value, weight)| value * weight)
                    .sum::<f64>()
                    / total
            }
        }
    }

    /// The probability that a draw of the distribution before truncation falls inside the limits.
    fn kept(&self) -> f64 {
        let (a, b) = self.standard_bounds();
        between(a, b)
    }

    /// The limits in standard deviations from the mean, of the logarithm for a lognormal distribution.
    fn standard_bounds(&self) -> (f64, f64) {
        let Bounds { min, max } = self.bounds;
        match &self.shape {
            Shape::Normal { mean, sd } => ((min - mean) / sd, (max - mean) / sd),
            Shape::LogNormal { mu, sigma } => {
                let standard = |limit: f64| (limit.max(0.0).ln() - mu) / sigma;
                (standard(min), standard(max))
            }
            _ => (UNBOUNDED.min, UNBOUNDED.max),
        }
    }
}

impl Shape {
    fn sample(&self, stream: &mut Stream) -> f64 {
        match self {
            Self::Uniform { min, max } => min + (max - min) * stream.unit(),
            Self::Triangular { min, mode, max } => {
                let (u, width) = (stream.unit(), max - min);
                let rising = (mode - min) / width;
                if u < rising {
                    min + (u * width * (mode - min)).sqrt()
                } else {
                    max - ((1.0 - u) * width * (max - mode)).sqrt()
                }
            }
            Self::Normal { mean, sd } => mean + sd * stream.standard_normal(),
            Self::LogNormal { mu, sigma } => (mu + sigma * stream.standard_normal()).exp(),
            Self::Discrete(values) => {
                let total: f64 = values.iter().map(|&(_, weight)| weight).sum();
                let mut rest = stream.unit() * total;
                let mut last = f64::NAN;
                for &(value, weight) in values.iter().filter(|&&(_, weight)| weight > 0.0) {
                    last = value;
                    if rest < weight {
                        break;
                    }
                    rest -= weight;
                }
                last
            }
        }
    }
}

/// The standard normal density.
fn density(x: f64) -> f64 {
    (-x * x / 2.0).exp() / (2.0 * std::f64::consts::PI).sqrt()
}

/// The probability that a standard normal number lies between `a` and `b`, exact far out in either tail.
fn between(a: f64, b: f64) -> f64 {
    // P(X > x) keeps its digits for large x; mirror what lies on the left.
    let above = |x: f64| match x {
        f64::INFINITY => 0.0,
        f64::NEG_INFINITY => 1.0,
        _ => puruspe::erfc(x / std::f64::consts::SQRT_2) / 2.0,
    };
    if b < 0.0 {
        above(-b) - above(-a)
    } else {
        above(a) - above(b)
    }
}

#[cfg(test)]
mod tests;
