//! What is wrong with distributions and draws.

use thiserror::Error;

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
