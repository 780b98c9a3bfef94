//! Knot insertion and refinement: more control points, the same shape (PT97 §5.2–5.3).

use super::{Curve, KnotVector, Surface};
use glam::DVec4;
use thiserror::Error;

/// Why a knot cannot be inserted, or a curve or surface not split there.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RefineError {
    /// The knot is not strictly inside the domain.
    #[error("knot {value} is not inside the domain from {start} to {end}; choose one between them")]
    Outside {
        /// The knot.
        value: f64,
        /// Start of the domain.
        start: f64,
        /// End of the domain.
        end: f64,
    },
    /// The knot would be there more often than the degree.
    #[error(
        "knot {value} is there {present} times and {added} more are asked for; degree {degree} allows {degree} in all"
    )]
    Multiplicity {
        /// The knot.
        value: f64,
        /// How often it is there.
        present: usize,
        /// How often it was to be inserted.
        added: usize,
        /// The degree.
        degree: usize,
    },
}

impl KnotVector {
    /// The knots to insert, sorted and with those that are almost a present knot moved onto it.
    fn checked_insertions(&self, added: &[f64]) -> Result<Vec<f64>, RefineError> {
        let (start, end) = self.domain();
        let distinct = self.distinct();
        let mut sorted = added.to_vec();
        sorted.sort_by(f64::total_cmp);
        let mut last = f64::NAN;
        for value in &mut sorted {
            *value = self.snapped(*value);
            if *value - last < self.resolution() {
                *value = last;
            }
            last = *value;
            if !(*value > start && *value < end) {
                return Err(RefineError::Outside {
                    value: *value,
                    start,
                    end,
                });
            }
        }
        for group in sorted.chunk_by(|a, b| a == b) {
            let value = group[0];
            let present = distinct.iter().find(|d| d.0 == value).map_or(0, |d| d.1);
            if present + group.len() > self.degree() {
                let (added, degree) = (group.len(), self.degree());
                return Err(RefineError::Multiplicity {
                    value,
                    present,
                    added,
                    degree,
                });
            }
        }
        Ok(sorted)
    }

    /// The knot nearest to u if it cannot be told from u, else u itself.
    pub(super) fn snapped(&self, u: f64) -> f64 {
        let knots = self.as_slice();
        let above = knots.partition_point(|&knot| knot < u);
        let near = |&&knot: &&f64| (knot - u).abs() < self.resolution();
        let neighbours = [
            above.checked_sub(1).and_then(|i| knots.get(i)),
            knots.get(above),
        ];
        neighbours
            .iter()
            .flatten()
            .copied()
            .find(near)
            .copied()
            .unwrap_or(u)
    }

    /// How often u is a knot.
    pub(super) fn multiplicity(&self, u: f64) -> usize {
        self.as_slice().iter().filter(|&&knot| knot == u).count()
    }

    /// The vector with the given knots, sorted and strictly inside the domain, merged in.
    fn merged(&self, sorted: &[f64]) -> Self {
        let mut knots = [self.as_slice(), sorted].concat();
        knots.sort_by(f64::total_cmp);
        Self::trusted(self.degree(), knots)
    }

    /// The interior knots that are missing for every piece to be a Bézier segment.
    pub(super) fn missing_for_bezier(&self) -> Vec<f64> {
        let distinct = self.distinct();
        let interior = &distinct[1..distinct.len() - 1];
        let missing = |&(value, count): &(f64, usize)| {
            std::iter::repeat_n(value, self.degree().saturating_sub(count))
        };
        interior.iter().flat_map(missing).collect()
    }
}

/// Control points after insertion of the knots `added`, sorted and strictly inside the domain (PT97 A5.4). Control
/// points that no new knot concerns are copied; the others are convex combinations.
fn refined(knots: &KnotVector, points: &[DVec4], added: &[f64]) -> Vec<DVec4> {
    let (Some(&lowest), Some(&highest)) = (added.first(), added.last()) else {
        return points.to_vec();
    };
    let p = knots.degree();
    let old = knots.as_slice();
    let before = knots.span(lowest);
    let behind = knots.span(highest) + 1;
    let more = added.len();
    let mut new_points = vec![DVec4::ZERO; points.len() + more];
    let mut new_knots = vec![0.0; old.len() + more];
    new_points[..=before - p].copy_from_slice(&points[..=before - p]);
    new_points[behind - 1 + more..].copy_from_slice(&points[behind - 1..]);
    new_knots[..=before].copy_from_slice(&old[..=before]);
    new_knots[behind + p + more..].copy_from_slice(&old[behind + p..]);
    let mut i = behind + p - 1;
    let mut k = i + more;
    for &knot in added.iter().rev() {
        while knot <= old[i] && i > before {
            new_points[k - p - 1] = points[i - p - 1];
            new_knots[k] = old[i];
            k -= 1;
            i -= 1;
        }
        new_points[k - p - 1] = new_points[k - p];
        for l in 1..=p {
            let at = k - p + l;
            let share = new_knots[k + l] - knot;
            if share == 0.0 {
                new_points[at - 1] = new_points[at];
            } else {
                let share = share / (new_knots[k + l] - old[i + l - p]);
                new_points[at - 1] = new_points[at].lerp(new_points[at - 1], share);
            }
        }
        new_knots[k] = knot;
        k -= 1;
    }
    new_points
}

impl Curve {
    /// The same curve with the knot u inserted the given number of times.
    pub fn insert_knot(&self, u: f64, times: usize) -> Result<Self, RefineError> {
        self.refine(&vec![u; times])
    }

    /// The same curve with all the given knots inserted, in any order, repeated as often as wanted.
    pub fn refine(&self, added: &[f64]) -> Result<Self, RefineError> {
        Ok(self.refined(&self.knots().checked_insertions(added)?))
    }

    /// Trusts its caller that the knots are sorted, inside the domain and not too many.
    pub(super) fn refined(&self, added: &[f64]) -> Self {
        let points = refined(self.knots(), &self.homogeneous(), added);
        Self::from_homogeneous(self.knots().merged(added), &points, self.is_rational())
    }
}

impl Surface {
    /// The same surface with the knot inserted in u the given number of times.
    pub fn insert_knot_u(&self, u: f64, times: usize) -> Result<Self, RefineError> {
        self.refine_u(&vec![u; times])
    }

    /// The same surface with the knot inserted in v the given number of times.
    pub fn insert_knot_v(&self, v: f64, times: usize) -> Result<Self, RefineError> {
        self.refine_v(&vec![v; times])
    }

    /// The same surface with all the given knots inserted in u.
    pub fn refine_u(&self, added: &[f64]) -> Result<Self, RefineError> {
        Ok(self.transposed().refine_v(added)?.transposed())
    }

    /// The same surface with all the given knots inserted in v.
    pub fn refine_v(&self, added: &[f64]) -> Result<Self, RefineError> {
        Ok(self.refined_v(&self.knots_v().checked_insertions(added)?))
    }

    /// Trusts its caller that the knots are sorted, inside the domain and not too many.
    pub(super) fn refined_v(&self, added: &[f64]) -> Self {
        let knots = self.knots_v().merged(added);
        self.with_rows(knots, |row| refined(self.knots_v(), row, added))
    }

    /// The surface whose rows of control points in v are replaced by the function's.
    pub(super) fn with_rows(&self, v: KnotVector, change: impl Fn(&[DVec4]) -> Vec<DVec4>) -> Self {
        let net = self.homogeneous();
        let rows: Vec<DVec4> = net
            .chunks(self.knots_v().count())
            .flat_map(change)
            .collect();
        Self::from_homogeneous(self.knots_u().clone(), v, &rows, self.is_rational())
    }
}
