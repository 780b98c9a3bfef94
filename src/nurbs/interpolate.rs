//! Global interpolation: curves through given points (J19 Eq. 7–9, PT97 §9.2.1).

use super::banded::Banded;
use super::{Curve, CurveError, KnotError, KnotVector};
use glam::DVec3;
use thiserror::Error;

/// How parameters are spread over the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parametrization {
    /// In proportion to the distances between the points (J19 Eq. 7 with a = 1).
    ChordLength,
    /// In proportion to the square roots of the distances (a = 2); calmer at sharp turns.
    Centripetal,
}

/// Why no curve passes through the points.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InterpolateError {
    /// There are too few points for the degree.
    #[error(
        "{found} points are too few for degree {degree}; give at least {needed} or lower the degree"
    )]
    TooFew {
        /// Number of points.
        found: usize,
        /// The degree.
        degree: usize,
        /// The least number that would do.
        needed: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {index} is {value}; coordinates must be finite")]
    Point {
        /// Position in the list.
        index: usize,
        /// The point.
        value: DVec3,
    },
    /// Two consecutive points are one.
    #[error("point {index} is {value}, the same as the previous one; remove one of them")]
    Repeated {
        /// Position in the list.
        index: usize,
        /// The point.
        value: DVec3,
    },
    /// A parameter is not above the one before it.
    #[error(
        "parameter {index} is {value}, not above the previous {previous}; parameters must grow"
    )]
    Parameter {
        /// Position in the list.
        index: usize,
        /// The parameter.
        value: f64,
        /// The parameter before it.
        previous: f64,
    },
    /// A row does not have a point for each parameter.
    #[error("row {row} has {found} points for {needed} parameters; give one for each")]
    Row {
        /// Position of the row.
        row: usize,
        /// Number of its points.
        found: usize,
        /// Number of parameters.
        needed: usize,
    },
    /// Rounding leaves no solution: the spacing of the parameters varies too much.
    #[error(
        "the equations fail at parameter {index}, {value}: neighbouring spacings differ too much; remove points that almost coincide or lower the degree"
    )]
    Singular {
        /// Position in the list.
        index: usize,
        /// The parameter.
        value: f64,
    },
    /// The averaged knots are not a knot vector.
    #[error("the points give an invalid knot vector")]
    Knots(#[from] KnotError),
    /// The solution is not a curve.
    #[error("the points give no finite control points")]
    Curve(#[from] CurveError),
}

/// Parameters from 0 to 1 for the points (J19 Eq. 7–8).
pub fn parameters(
    points: &[DVec3],
    spacing: Parametrization,
) -> Result<Vec<f64>, InterpolateError> {
    if points.len() < 2 {
        return Err(InterpolateError::TooFew {
            found: points.len(),
            degree: 1,
            needed: 2,
        });
    }
    if let Some((index, &value)) = points.iter().enumerate().find(|(_, p)| !p.is_finite()) {
        return Err(InterpolateError::Point { index, value });
    }
    let mut sums = vec![0.0];
    let mut sum = 0.0;
    for (i, pair) in points.windows(2).enumerate() {
        let chord = pair[0].distance(pair[1]);
        if chord == 0.0 {
            return Err(InterpolateError::Repeated {
                index: i + 1,
                value: pair[1],
            });
        }
        sum += match spacing {
            Parametrization::ChordLength => chord,
            Parametrization::Centripetal => chord.sqrt(),
        };
        sums.push(sum);
    }
    Ok(sums.iter().map(|s| s / sum).collect())
}

/// The knot vector whose interior knots are means of `degree` neighbouring parameters (J19 Eq. 9, PT97 Eq. 9.8),
/// which keeps the equations solvable.
pub fn averaged_knots(degree: usize, params: &[f64]) -> Result<KnotVector, InterpolateError> {
    let needed = degree + 1;
    if params.len() < needed.max(2) {
        return Err(InterpolateError::TooFew {
            found: params.len(),
            degree,
            needed,
        });
    }
    for (i, pair) in params.windows(2).enumerate() {
        // A parameter that is not a number fails here too.
        if pair[1].partial_cmp(&pair[0]) != Some(std::cmp::Ordering::Greater) {
            let (value, previous) = (pair[1], pair[0]);
            return Err(InterpolateError::Parameter {
                index: i + 1,
                value,
                previous,
            });
        }
    }
    if degree == 0 {
        return Err(KnotError::Degree { degree }.into());
    }
    let last = params.len() - 1;
    let mut knots = vec![params[0]; needed];
    for own in params[1..last].windows(degree) {
        knots.push(own.iter().sum::<f64>() / degree as f64);
    }
    knots.extend(std::iter::repeat_n(params[last], needed));
    Ok(KnotVector::new(degree, knots)?)
}

/// The curve of the given degree through the points, in their order.
pub fn curve(
    points: &[DVec3],
    degree: usize,
    spacing: Parametrization,
) -> Result<Curve, InterpolateError> {
    let params = parameters(points, spacing)?;
    let (knots, mut rows) = with_parameters(&[points.to_vec()], &params, degree)?;
    Ok(Curve::new(knots, rows.swap_remove(0))?)
}

/// Control points of several curves through several rows of points at the same parameters: one knot vector for all, and
/// the banded system `Q_k = C(ū_k)` factored once. A surface through sections interpolates each control point of the
/// section as one row.
pub fn with_parameters(
    rows: &[Vec<DVec3>],
    params: &[f64],
    degree: usize,
) -> Result<(KnotVector, Vec<Vec<DVec3>>), InterpolateError> {
    let knots = averaged_knots(degree, params)?;
    for (row, points) in rows.iter().enumerate() {
        let (found, needed) = (points.len(), params.len());
        if found != needed {
            return Err(InterpolateError::Row { row, found, needed });
        }
        if let Some((index, &value)) = points.iter().enumerate().find(|(_, p)| !p.is_finite()) {
            return Err(InterpolateError::Point { index, value });
        }
    }
    let matrix = collocation(&knots, params)?;
    let mut solved = rows.to_vec();
    for row in &mut solved {
        solve(&matrix, row);
    }
    Ok((knots, solved))
}

/// Coefficients of the spline functions, on given knots, through rows of values at the knots' Greville abscissae. A
/// function that is a spline on these knots is reproduced.
pub fn at_greville(knots: &KnotVector, rows: &mut [Vec<f64>]) -> Result<(), InterpolateError> {
    let abscissae: Vec<f64> = (0..knots.count()).map(|i| knots.greville(i)).collect();
    let needed = abscissae.len();
    let matrix = collocation(knots, &abscissae)?;
    for (index, row) in rows.iter_mut().enumerate() {
        if row.len() != needed {
            return Err(InterpolateError::Row {
                row: index,
                found: row.len(),
                needed,
            });
        }
        solve(&matrix, row);
    }
    Ok(())
}

/// Coefficients, u-major, of the spline function of two parameters that agrees with `f` at all pairs of Greville
/// abscissae.
pub fn net(
    u: &KnotVector,
    v: &KnotVector,
    f: impl Fn(f64, f64) -> f64,
) -> Result<Vec<f64>, InterpolateError> {
    let (nu, nv) = (u.count(), v.count());
    // One row for each v, solved along u; then the other way round.
    let mut columns: Vec<Vec<f64>> = (0..nv)
        .map(|j| (0..nu).map(|i| f(u.greville(i), v.greville(j))).collect())
        .collect();
    at_greville(u, &mut columns)?;
    let mut rows: Vec<Vec<f64>> = (0..nu)
        .map(|i| columns.iter().map(|column| column[i]).collect())
        .collect();
    at_greville(v, &mut rows)?;
    Ok(rows.concat())
}

/// The factored system of "the spline has these values at these parameters".
fn collocation(knots: &KnotVector, params: &[f64]) -> Result<Banded, InterpolateError> {
    let degree = knots.degree();
    let mut matrix = Banded::zeros(params.len(), degree);
    for (row, &u) in params.iter().enumerate() {
        let basis = knots.basis(u);
        for (j, &value) in basis.values().iter().enumerate() {
            // By Schoenberg & Whitney the entries beyond reach of the diagonal are zero.
            let column = basis.first() + j;
            if column.abs_diff(row) <= degree {
                matrix.set(row, column, value);
            }
        }
    }
    matrix
        .factor()
        .map_err(|index| InterpolateError::Singular {
            index,
            value: params[index],
        })?;
    Ok(matrix)
}

/// Turns values into coefficients.
fn solve<T>(matrix: &Banded, row: &mut [T])
where
    T: Copy + std::ops::Mul<f64, Output = T> + std::ops::SubAssign,
{
    let (first, last) = (row.first().copied(), row.last().copied());
    matrix.solve(row);
    // A clamped curve starts and ends at its outer control points: keep them to the last bit.
    if let (Some(start), Some(end)) = (first, last) {
        row[0] = start;
        let count = row.len();
        row[count - 1] = end;
    }
}
