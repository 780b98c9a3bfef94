//! Profiles: a template's parameter as a function of the fraction of a trajectory's length, 0 to 1.
//!
//! \[J19\] §2.4.1 lets every parameter of a template vary along its trajectory. Values between the
//! entries of a list are linear; beyond its ends the first and the last value hold.

use std::fmt;
use std::sync::Arc;

/// A parameter along a trajectory.
#[derive(Clone)]
pub enum Profile {
    /// The same everywhere.
    Constant(f64),
    /// Pairs of (fraction, value), fractions increasing; linear between them.
    Along(Vec<(f64, f64)>),
    /// Any function of the fraction.
    Function(Arc<dyn Fn(f64) -> f64 + Send + Sync>),
}

/// Fractions at which the extremes of a [`Profile::Function`] are looked for.
const FUNCTION_SAMPLES: usize = 257;

impl Profile {
    /// The value at a fraction of the trajectory's length.
    pub fn at(&self, fraction: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Along(pairs) => piecewise(pairs, fraction),
            Self::Function(function) => function(fraction),
        }
    }

    /// Whether the value is the same everywhere.
    pub fn is_constant(&self) -> bool {
        match self {
            Self::Constant(_) => true,
            Self::Along(pairs) => pairs.windows(2).all(|w| w[0].1 == w[1].1),
            Self::Function(_) => false,
        }
    }

    /// Least and greatest value (of a function: over 257 even fractions).
    pub fn range(&self) -> (f64, f64) {
        let wide = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
        let nothing = (f64::INFINITY, f64::NEG_INFINITY);
        match self {
            Self::Constant(value) => (*value, *value),
            Self::Along(pairs) => pairs.iter().map(|pair| pair.1).fold(nothing, wide),
            Self::Function(function) => (0..FUNCTION_SAMPLES)
                .map(|i| function(i as f64 / (FUNCTION_SAMPLES - 1) as f64))
                .fold(nothing, wide),
        }
    }
}

impl fmt::Debug for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "Constant({value})"),
            Self::Along(pairs) => write!(f, "Along({pairs:?})"),
            Self::Function(_) => write!(f, "Function(..)"),
        }
    }
}

fn piecewise(pairs: &[(f64, f64)], fraction: f64) -> f64 {
    let after = pairs.partition_point(|pair| pair.0 <= fraction);
    match (after.checked_sub(1).map(|i| pairs[i]), pairs.get(after)) {
        (None, None) => f64::NAN,
        (None, Some(first)) => first.1,
        (Some(last), None) => last.1,
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (fraction - a.0) / (b.0 - a.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_linear_between_its_entries_and_constant_beyond_them() {
        let profile = Profile::Along(vec![(0.2, 10.0), (0.6, 30.0)]);
        assert_eq!(profile.at(0.0), 10.0);
        assert!((profile.at(0.3) - 15.0).abs() < 1e-12);
        assert_eq!(profile.at(1.0), 30.0);
        assert_eq!(profile.range(), (10.0, 30.0));
        assert!(!profile.is_constant());
    }

    #[test]
    fn a_function_knows_its_extremes() {
        let profile = Profile::Function(Arc::new(|s| (std::f64::consts::TAU * s).sin()));
        let (low, high) = profile.range();
        assert!((low + 1.0).abs() < 1e-12 && (high - 1.0).abs() < 1e-12);
    }
}
