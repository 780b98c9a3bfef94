//! Distributions that numbers are drawn from.
//!
//! Normal and lognormal distributions are given by the mean and the standard deviation of the quantity itself (not of its
//! logarithm) and may be truncated by `min` and `max`; a truncated draw is repeated until it falls inside, at most
//! [`MAX_REJECTIONS`] times. Uniform and triangular draws invert the distribution function, one number of the stream each.
//!
//! Known limit: lognormal draws use the exponential function of the platform, whose last digit may differ between systems.

use thiserror::Error;

use super::stream::Stream;

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

/// Why numbers do not describe a distribution.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DistributionError {
    /// A parameter is NaN or infinite.
    #[error("the parameter {value} of a distribution is not a finite number")]
    NotFinite {
        /// The offending parameter.
        value: f64,
    },
    /// A uniform distribution whose minimum is not below its maximum.
    #[error(
        "the minimum {min} of a uniform distribution is not below its maximum {max}; write uniform = [minimum, maximum]"
    )]
    Uniform {
        /// The minimum given.
        min: f64,
        /// The maximum given.
        max: f64,
    },
    /// A triangular distribution whose parameters are not in order.
    #[error(
        "a triangular distribution needs minimum ≤ most likely ≤ maximum, but has {min}, {mode}, {max}; write triangular = [minimum, most likely, maximum]"
    )]
    Triangular {
        /// The minimum given.
        min: f64,
        /// The mode given.
        mode: f64,
        /// The maximum given.
        max: f64,
    },
    /// A standard deviation that is not positive.
    #[error(
        "the standard deviation {sd} is not above 0; write [mean, standard deviation], or a plain number where nothing varies"
    )]
    StandardDeviation {
        /// The standard deviation given.
        sd: f64,
    },
    /// A lognormal mean that is not positive.
    #[error(
        "the mean {mean} of a lognormal distribution is not above 0; give the mean and the standard deviation of the quantity itself, not of its logarithm"
    )]
    LogNormalMean {
        /// The mean given.
        mean: f64,
    },
    /// A discrete distribution without values.
    #[error(
        "a discrete distribution has no values; write discrete = [[value, weight], …] or discrete = [value, …]"
    )]
    NoValues,
    /// A negative weight.
    #[error("the weight {weight} of the value {value} is negative")]
    Weight {
        /// The value with the bad weight.
        value: f64,
        /// The weight given.
        weight: f64,
    },
    /// Weights that sum to nothing.
    #[error("all weights of a discrete distribution are 0")]
    NoWeight,
    /// Truncation limits that are not in order.
    #[error("the lower limit min = {min} is not below the upper limit max = {max}")]
    Limits {
        /// The lower limit given.
        min: f64,
        /// The upper limit given.
        max: f64,
    },
    /// Only normal and lognormal distributions are truncated.
    #[error(
        "min and max truncate normal and lognormal distributions only; a uniform, triangular or discrete one has its limits already"
    )]
    NotTruncatable,
    /// Truncation that keeps next to nothing.
    #[error(
        "the limits min = {min} and max = {max} keep {kept:.1e} of the distribution, less than one draw in a thousand; widen them or move the mean"
    )]
    Hopeless {
        /// The lower limit.
        min: f64,
        /// The upper limit.
        max: f64,
        /// The probability of a draw inside the limits.
        kept: f64,
    },
}

/// Why a number could not be drawn.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DrawError {
    /// A truncated distribution gave no number inside its limits.
    #[error(
        "none of {attempts} draws fell between min = {min} and max = {max}; widen the limits or move the mean"
    )]
    Truncation {
        /// How many numbers were drawn.
        attempts: usize,
        /// The lower limit.
        min: f64,
        /// The upper limit.
        max: f64,
    },
}

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
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::{Distribution, DistributionError};
    use crate::model::quantity::Quantity;
    use crate::model::stream::Stream;

    const DRAWS: usize = 40_000;

    fn draws(distribution: &Distribution) -> Vec<f64> {
        let mut stream = Stream::new(11, "moments", "0", "width", 0);
        (0..DRAWS)
            .map(|_| distribution.sample(&mut stream).unwrap())
            .collect()
    }

    /// Mean and standard deviation of many draws; the mean of n draws errs by sd/√n, here 1/200 of the sd.
    fn moments(values: &[f64]) -> (f64, f64) {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
        (mean, variance.sqrt())
    }

    /// Draws must have the moments of the closed form, within five standard errors, and stay in the support.
    fn assert_moments(distribution: &Distribution, mean: f64, sd: f64) {
        let values = draws(distribution);
        let (drawn_mean, drawn_sd) = moments(&values);
        let error = 5.0 * sd / (DRAWS as f64).sqrt();
        assert!(
            (drawn_mean - mean).abs() < error,
            "mean {drawn_mean}, not {mean}"
        );
        assert!(
            (drawn_sd / sd - 1.0).abs() < 0.04,
            "sd {drawn_sd}, not {sd}"
        );
        let own = distribution.mean();
        assert!(
            (own - mean).abs() < 1e-9 * mean.abs().max(1.0),
            "mean() {own}, not {mean}"
        );
        let (low, high) = distribution.support();
        assert!(values.iter().all(|v| low <= *v && *v <= high));
    }

    #[test]
    fn uniform_draws_have_the_mean_and_spread_of_the_closed_form() {
        let distribution = Distribution::uniform(10.0, 90.0).unwrap();
        assert_moments(&distribution, 50.0, 80.0 / 12_f64.sqrt());
    }

    #[test]
    fn triangular_draws_have_the_mean_and_spread_of_the_closed_form() {
        // Variance (a² + b² + c² − ab − ac − bc)/18 for minimum a, mode b, maximum c.
        let sd = |a: f64, b: f64, c: f64| {
            ((a * a + b * b + c * c - a * b - a * c - b * c) / 18.0).sqrt()
        };
        for [a, b, c] in [
            [50.0, 475.0, 3000.0],
            [15.0, 50.0, 100.0],
            [0.0, 0.0, 1.0],
            [2.0, 5.0, 5.0],
        ] {
            let distribution = Distribution::triangular(a, b, c).unwrap();
            assert_moments(&distribution, (a + b + c) / 3.0, sd(a, b, c));
        }
    }

    #[test]
    fn the_part_below_the_mode_of_a_triangular_distribution_is_its_share_of_the_width() {
        let distribution = Distribution::triangular(50.0, 475.0, 3000.0).unwrap();
        let below = draws(&distribution).iter().filter(|v| **v < 475.0).count();
        let share = below as f64 / DRAWS as f64;
        assert!((share - 425.0 / 2950.0).abs() < 0.01, "{share}");
    }

    #[test]
    fn normal_draws_have_the_given_mean_and_spread() {
        assert_moments(&Distribution::normal(-3.0, 2.0).unwrap(), -3.0, 2.0);
    }

    #[test]
    fn lognormal_draws_have_the_mean_and_spread_of_the_quantity_itself() {
        let distribution = Distribution::lognormal(40.0, 10.0).unwrap();
        assert_moments(&distribution, 40.0, 10.0);
        assert_eq!(distribution.support().0, 0.0);
        assert!(!distribution.reaches_minimum());
    }

    #[test]
    fn a_normal_distribution_cut_at_its_mean_is_half_normal() {
        // Mean μ + σ√(2/π), variance σ²(1 − 2/π).
        let cut = Distribution::normal(10.0, 4.0)
            .unwrap()
            .truncated(Some(10.0), None)
            .unwrap();
        let pi = std::f64::consts::PI;
        assert_moments(
            &cut,
            10.0 + 4.0 * (2.0 / pi).sqrt(),
            4.0 * (1.0 - 2.0 / pi).sqrt(),
        );
        assert_eq!(cut.support(), (10.0, f64::INFINITY));
    }

    #[test]
    fn the_mean_of_a_truncated_lognormal_distribution_agrees_with_its_draws() {
        let cut = Distribution::lognormal(40.0, 20.0)
            .unwrap()
            .truncated(Some(20.0), Some(60.0))
            .unwrap();
        let (mean, sd) = moments(&draws(&cut));
        assert!(
            (mean - cut.mean()).abs() < 5.0 * sd / (DRAWS as f64).sqrt(),
            "{mean}, {}",
            cut.mean()
        );
        assert_eq!(cut.support(), (20.0, 60.0));
    }

    #[test]
    fn discrete_draws_follow_their_weights_and_never_take_a_value_of_weight_zero() {
        let values = vec![(5.0, 1.0), (7.0, 0.0), (10.0, 3.0), (99.0, 0.0)];
        let distribution = Distribution::discrete(values).unwrap();
        let drawn = draws(&distribution);
        let tens = drawn.iter().filter(|v| **v == 10.0).count() as f64 / DRAWS as f64;
        assert!((tens - 0.75).abs() < 0.012, "{tens}");
        assert!(drawn.iter().all(|v| [5.0, 10.0].contains(v)));
        assert_eq!(distribution.support(), (5.0, 10.0));
        assert!((distribution.mean() - 8.75).abs() < 1e-12);
    }

    #[test]
    fn limits_that_keep_next_to_nothing_are_refused_with_the_part_they_keep() {
        // P(Z > 3) = 1.3499e-3 is just enough; P(Z > 3.1) = 9.676e-4 is not, and neither side differs.
        let normal = || Distribution::normal(0.0, 1.0).unwrap();
        assert!(normal().truncated(Some(3.0), None).is_ok());
        assert!(normal().truncated(None, Some(-3.0)).is_ok());
        for refused in [
            normal().truncated(Some(3.1), None),
            normal().truncated(None, Some(-3.1)),
        ] {
            let Err(DistributionError::Hopeless { kept, .. }) = refused else {
                unreachable!("{refused:?}")
            };
            assert!((kept - 9.676e-4).abs() < 1e-7, "{kept}");
        }
    }

    #[test]
    fn the_first_draws_of_every_distribution_never_change() {
        // If this fails, a seed no longer gives the model that it gave: a dependency or the key has changed.
        let first = |distribution: Distribution| {
            Quantity::Random(distribution)
                .sample(&mut Stream::new(7, "channel", "3", "width", 0))
                .unwrap()
        };
        let drawn = [
            first(Distribution::uniform(0.0, 1.0).unwrap()),
            first(Distribution::triangular(15.0, 50.0, 100.0).unwrap()),
            first(Distribution::normal(0.0, 1.0).unwrap()),
            first(Distribution::lognormal(40.0, 10.0).unwrap()),
            first(Distribution::discrete(vec![(1.0, 1.0), (2.0, 1.0), (3.0, 1.0)]).unwrap()),
        ];
        let expected = [
            0.746_511_636_024_250_1,
            67.177_362_280_021_78,
            0.861_088_946_948_030_1,
            47.970_442_823_961_32,
            3.0,
        ];
        assert_eq!(drawn, expected);
    }
}
