//! Why points make no section.

use crate::nurbs::{CurveError, KnotError};

/// Highest degree that the kernel takes.
pub const LARGEST_DEGREE: usize = 7;

/// Why points make no section. Points are counted from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OwnSectionError {
    /// A degree that is none, or too high.
    #[error("its degree is {0}: it must be 1 (straight pieces) to {LARGEST_DEGREE}")]
    Degree(usize),
    /// Too few points for the degree.
    #[error(
        "it has {count} points, but degree {degree} needs {least} at least: add points or lower the degree"
    )]
    Few {
        /// Points.
        count: usize,
        /// The degree.
        degree: usize,
        /// Points that are needed.
        least: usize,
    },
    /// A coordinate that is none, or far away.
    #[error(
        "point {index} is [{x}, {y}]: x counts in widths from the middle (the rims are at -0.5 and 0.5), y in depths \
         upwards from the rims (so below 0)"
    )]
    Far {
        /// Its number.
        index: usize,
        /// In widths.
        x: f64,
        /// In depths.
        y: f64,
    },
    /// A rim that is not where rims are.
    #[error(
        "point {index}, a rim, is [{x}, {y}]: the first point must be [-0.5, 0] and the last one [0.5, 0], since `width` is \
         the distance between them and points go from left to right"
    )]
    Rim {
        /// Its number.
        index: usize,
        /// In widths.
        x: f64,
        /// In depths.
        y: f64,
    },
    /// A closed section whose ends are apart.
    #[error("point {index}, the last one, is [{x}, {y}]: a closed section ends where it begins")]
    Open {
        /// Its number.
        index: usize,
        /// In widths.
        x: f64,
        /// In depths.
        y: f64,
    },
    /// Two points in one place.
    #[error("points {} and {index} are the same: leave one out", index - 1)]
    Same {
        /// The second one's number.
        index: usize,
    },
    /// A number of weights that is not that of points.
    #[error("it has {count} weights for {points} points: give one for each")]
    Weights {
        /// Weights.
        count: usize,
        /// Points.
        points: usize,
    },
    /// A weight that is none.
    #[error("weight {index} is {value}: weights must be above 0")]
    Weight {
        /// Its number.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// Knots that are none.
    #[error("its knots are wrong: {error}; {points} points of degree {degree} have {} knots", points + degree + 1)]
    Knots {
        /// What is wrong.
        #[source]
        error: KnotError,
        /// Points.
        points: usize,
        /// The degree.
        degree: usize,
    },
    /// Knots for another number of points.
    #[error("it has {count} knots, but {points} points of degree {degree} have {}", points + degree + 1)]
    Count {
        /// Knots.
        count: usize,
        /// Points.
        points: usize,
        /// The degree.
        degree: usize,
    },
    /// It leaves the channel upwards.
    #[error("it rises above its rims near point {index}: all between the rims must be below y = 0")]
    Above {
        /// The nearest point's number.
        index: usize,
    },
    /// It crosses or touches itself.
    #[error(
        "it meets itself near point {first} and near point {second}: a section must not cross or touch itself"
    )]
    Crossing {
        /// The nearest point's number.
        first: usize,
        /// The same of the second place.
        second: usize,
    },
    /// It meets its own top.
    #[error("it meets its own top near point {index}: all between the rims must be below y = 0")]
    Top {
        /// The nearest point's number.
        index: usize,
    },
    /// It stops and turns back.
    #[error(
        "it stops and turns back near point {index}: move that point away from its neighbours' line"
    )]
    Turn {
        /// The nearest point's number.
        index: usize,
    },
    /// Its corners hide from each other.
    #[error(
        "no place inside it sees all of its corners, so the channel's ends cannot be closed: round its corners (`degree = 2` or 3) \
         or make it one basin"
    )]
    Hidden,
    /// It is no curve.
    #[error(transparent)]
    Curve(#[from] CurveError),
}
