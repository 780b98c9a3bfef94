//! Knot vectors: the parameter values where the pieces of a spline meet.
//!
//! Notation follows PT97 §2.2 and J19 Eq. 2: a curve of degree p with n control points has n + p + 1 knots
//! `u_0 ≤ u_1 ≤ …`. Only clamped vectors are made (the first and the last knot p + 1 times, so that curves start and
//! end at their outer control points), with interior knots at most p times (so that curves are continuous).

use super::basis;
use thiserror::Error;

/// The highest degree that is accepted; the CAD kernel that the models go to stops here too.
pub const MAX_DEGREE: usize = 25;

/// Length of the stack buffers that hold one value for each basis function of a span.
pub(super) const ORDER: usize = MAX_DEGREE + 1;

/// Two knots nearer than this fraction of the larger of the domain's length and its largest parameter are not
/// distinct: dividing by their difference would leave fewer than four digits.
pub(super) const RESOLUTION: f64 = 1e-12;

/// Why a list of numbers is no knot vector.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum KnotError {
    /// The degree is zero or above [`MAX_DEGREE`].
    #[error("the degree is {degree}; use 1 to {MAX_DEGREE}")]
    Degree {
        /// The degree that was given.
        degree: usize,
    },
    /// There are fewer control points than the degree needs.
    #[error(
        "{found} control points are too few for degree {degree}; give at least {needed} or lower the degree"
    )]
    ControlPoints {
        /// The degree that was given.
        degree: usize,
        /// Number of control points.
        found: usize,
        /// The least number that would do.
        needed: usize,
    },
    /// There are fewer knots than the degree needs.
    #[error(
        "{found} knots are too few for degree {degree}; a clamped knot vector has at least {needed}"
    )]
    Length {
        /// The degree that was given.
        degree: usize,
        /// Number of knots.
        found: usize,
        /// The least number that would do.
        needed: usize,
    },
    /// A knot is infinite or not a number.
    #[error("knot {index} is {value}; knots must be finite")]
    NotFinite {
        /// Position in the list.
        index: usize,
        /// The knot.
        value: f64,
    },
    /// A knot is below the one before it.
    #[error("knot {index} is {value}, below the previous knot {previous}; sort the knots")]
    Decreasing {
        /// Position in the list.
        index: usize,
        /// The knot.
        value: f64,
        /// The knot before it.
        previous: f64,
    },
    /// A knot differs from the one before it by too little to calculate with.
    #[error(
        "knot {index} is {value}, almost but not quite the previous knot {previous}; make them equal or move them apart"
    )]
    TooClose {
        /// Position in the list.
        index: usize,
        /// The knot.
        value: f64,
        /// The knot before it.
        previous: f64,
    },
    /// All knots have one value.
    #[error("all knots are {value}; the last must be above the first")]
    EmptyDomain {
        /// The value.
        value: f64,
    },
    /// An end does not have its knot degree + 1 times.
    #[error(
        "knot {index} is {value}; to clamp an end at degree {degree}, repeat its knot {expected} {times} times"
    )]
    NotClamped {
        /// Position in the list.
        index: usize,
        /// The knot.
        value: f64,
        /// What it should be.
        expected: f64,
        /// The degree.
        degree: usize,
        /// How often the end's knot must appear.
        times: usize,
    },
    /// An interior knot appears more often than the degree.
    #[error(
        "interior knot {value} appears {multiplicity} times; at degree {degree} the curve would break there, so repeat it at most {degree} times"
    )]
    Multiplicity {
        /// The knot.
        value: f64,
        /// How often it appears.
        multiplicity: usize,
        /// The degree.
        degree: usize,
    },
}

/// Why a degree cannot be elevated.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ElevateError {
    /// The result would be above [`MAX_DEGREE`].
    #[error("degree {degree} elevated {times} times is above {MAX_DEGREE}; elevate less")]
    Degree {
        /// The degree now.
        degree: usize,
        /// By how much to elevate.
        times: usize,
    },
}

/// A clamped knot vector; holding one proves that it is valid.
#[derive(Clone, Debug, PartialEq)]
pub struct KnotVector {
    degree: usize,
    knots: Vec<f64>,
}

/// The basis functions that are not zero at one parameter.
#[derive(Clone, Copy, Debug)]
pub struct Basis {
    span: usize,
    degree: usize,
    values: [f64; ORDER],
}

impl Basis {
    /// Index of the control point that the first value belongs to.
    pub fn first(&self) -> usize {
        self.span - self.degree
    }

    /// The values, `degree + 1` of them; their sum is one.
    pub fn values(&self) -> &[f64] {
        &self.values[..=self.degree]
    }

    /// The values of cubics, which are most.
    pub(super) fn usual(&self) -> Option<&[f64; 4]> {
        self.values.first_chunk().filter(|_| self.degree == 3)
    }
}

impl KnotVector {
    /// A knot vector from all its knots, ends repeated.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, KnotError> {
        check_degree(degree)?;
        let needed = 2 * (degree + 1);
        if knots.len() < needed {
            return Err(KnotError::Length {
                degree,
                found: knots.len(),
                needed,
            });
        }
        if let Some((index, &value)) = knots.iter().enumerate().find(|(_, k)| !k.is_finite()) {
            return Err(KnotError::NotFinite { index, value });
        }
        let (start, end) = (knots[0], knots[knots.len() - 1]);
        for (i, pair) in knots.windows(2).enumerate() {
            if pair[1] < pair[0] {
                return Err(KnotError::Decreasing {
                    index: i + 1,
                    value: pair[1],
                    previous: pair[0],
                });
            }
        }
        if start == end {
            return Err(KnotError::EmptyDomain { value: start });
        }
        let least = resolution(start, end);
        for (i, pair) in knots.windows(2).enumerate() {
            if pair[1] > pair[0] && pair[1] - pair[0] < least {
                return Err(KnotError::TooClose {
                    index: i + 1,
                    value: pair[1],
                    previous: pair[0],
                });
            }
        }
        let times = degree + 1;
        let not_clamped = |index: usize, expected: f64| KnotError::NotClamped {
            index,
            value: knots[index],
            expected,
            degree,
            times,
        };
        if let Some(index) = (0..times).find(|&i| knots[i] != start) {
            return Err(not_clamped(index, start));
        }
        let last = knots.len() - times;
        if let Some(index) = (last..knots.len()).rev().find(|&i| knots[i] != end) {
            return Err(not_clamped(index, end));
        }
        let vector = Self { degree, knots };
        let distinct = vector.distinct();
        for (k, &(value, multiplicity)) in distinct.iter().enumerate() {
            let outer = k == 0 || k + 1 == distinct.len();
            let allowed = if outer { times } else { degree };
            if multiplicity > allowed {
                return Err(KnotError::Multiplicity {
                    value,
                    multiplicity,
                    degree,
                });
            }
        }
        Ok(vector)
    }

    /// The clamped knot vector on [0, 1] whose interior knots are evenly spaced (J19 Eq. 2).
    pub fn uniform(degree: usize, control_points: usize) -> Result<Self, KnotError> {
        check_degree(degree)?;
        let needed = degree + 1;
        if control_points < needed {
            return Err(KnotError::ControlPoints {
                degree,
                found: control_points,
                needed,
            });
        }
        let pieces = control_points - degree;
        let mut knots = vec![0.0; degree];
        knots.extend((0..=pieces).map(|i| i as f64 / pieces as f64));
        knots.extend(std::iter::repeat_n(1.0, degree));
        Self::new(degree, knots)
    }

    /// Trusts its caller to have kept the invariant.
    pub(super) fn trusted(degree: usize, knots: Vec<f64>) -> Self {
        debug_assert!(knots.len() >= 2 * (degree + 1) && knots.is_sorted());
        Self { degree, knots }
    }

    /// The polynomial degree p of the pieces.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of control points that belong to the vector.
    pub fn count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// All knots, ends repeated.
    pub fn as_slice(&self) -> &[f64] {
        &self.knots
    }

    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.knots.len() - 1])
    }

    /// The parameter moved into the domain.
    pub(super) fn clamp(&self, u: f64) -> f64 {
        let (start, end) = self.domain();
        u.clamp(start, end)
    }

    /// Two parameters nearer than this are one parameter.
    pub(super) fn resolution(&self) -> f64 {
        let (start, end) = self.domain();
        resolution(start, end)
    }

    /// Index i of the span `[u_i, u_{i+1})` that holds u; the last span holds its right end too (PT97 A2.1).
    pub fn span(&self, u: f64) -> usize {
        let interior = &self.knots[self.degree + 1..self.count()];
        self.degree + interior.partition_point(|&knot| knot <= u)
    }

    /// The basis functions that are not zero at u (PT97 A2.2).
    pub fn basis(&self, u: f64) -> Basis {
        let u = self.clamp(u);
        let span = self.span(u);
        let mut values = [0.0; ORDER];
        basis::values(&self.knots, self.degree, span, u, &mut values);
        Basis {
            span,
            degree: self.degree,
            values,
        }
    }

    /// Derivatives of the basis functions of u's span: entry `[k][j]` is the k-th derivative, `k ≤ order`, of basis
    /// function `span(u) - degree + j` (PT97 A2.3). Above the degree they are zero.
    pub fn basis_derivatives(&self, u: f64, order: usize) -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; self.degree + 1]; order + 1];
        self.with_basis_derivatives(u, order, |_, k, values| rows[k].copy_from_slice(values));
        rows
    }

    /// Calls `row(first control point, k, k-th derivatives)` for k up to the lesser of `order` and the degree.
    pub(super) fn with_basis_derivatives(
        &self,
        u: f64,
        order: usize,
        row: impl FnMut(usize, usize, &[f64]),
    ) {
        // Four entries hold the degrees that geology uses; clearing the large tables costs more than the arithmetic.
        if self.degree < 4 {
            self.basis_derivative_rows::<4>(u, order, row);
        } else {
            self.basis_derivative_rows::<ORDER>(u, order, row);
        }
    }

    fn basis_derivative_rows<const N: usize>(
        &self,
        u: f64,
        order: usize,
        mut row: impl FnMut(usize, usize, &[f64]),
    ) {
        let u = self.clamp(u);
        let span = self.span(u);
        let order = order.min(self.degree);
        let mut table = [[0.0; N]; N];
        basis::derivatives(&self.knots, self.degree, span, u, order, &mut table);
        for (k, values) in table[..=order].iter().enumerate() {
            row(span - self.degree, k, &values[..=self.degree]);
        }
    }

    /// The i-th Greville abscissa, the mean of knots `i + 1 … i + p`: where control point i acts most.
    pub fn greville(&self, i: usize) -> f64 {
        let first = (i + 1).min(self.count());
        let own = &self.knots[first..first + self.degree];
        self.clamp(own.iter().sum::<f64>() / self.degree as f64)
    }

    /// Each knot value once, with its multiplicity, from the start to the end of the domain.
    pub fn distinct(&self) -> Vec<(f64, usize)> {
        let mut distinct: Vec<(f64, usize)> = Vec::new();
        for &knot in &self.knots {
            match distinct.last_mut() {
                Some((value, multiplicity)) if *value == knot => *multiplicity += 1,
                _ => distinct.push((knot, 1)),
            }
        }
        distinct
    }
}

fn check_degree(degree: usize) -> Result<(), KnotError> {
    if (1..=MAX_DEGREE).contains(&degree) {
        Ok(())
    } else {
        Err(KnotError::Degree { degree })
    }
}

fn resolution(start: f64, end: f64) -> f64 {
    RESOLUTION * (end - start).max(start.abs()).max(end.abs())
}
