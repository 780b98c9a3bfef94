//! Splitting at a parameter, and into Bézier segments and patches (PT97 §5.3).

use super::{Curve, KnotVector, RefineError, Surface};

impl KnotVector {
    /// The two vectors that meet at u, which must be an interior knot of full multiplicity, and the index of the
    /// control point that they share.
    fn parted(&self, u: f64) -> (Self, Self, usize) {
        let (degree, knots) = (self.degree(), self.as_slice());
        let first = knots.partition_point(|&knot| knot < u);
        let mut left = knots[..first + degree].to_vec();
        left.push(u);
        let mut right = vec![u];
        right.extend_from_slice(&knots[first..]);
        (
            Self::trusted(degree, left),
            Self::trusted(degree, right),
            first - 1,
        )
    }

    /// The spans of a vector whose interior knots all have full multiplicity, each as a knot vector of its own.
    fn pieces(&self) -> Vec<Self> {
        let distinct = self.distinct();
        let piece = |pair: &[(f64, usize)]| {
            let mut knots = vec![pair[0].0; self.degree() + 1];
            knots.extend(std::iter::repeat_n(pair[1].0, self.degree() + 1));
            Self::trusted(self.degree(), knots)
        };
        distinct.windows(2).map(piece).collect()
    }
}

impl Curve {
    /// The parts before and after u, which must lie strictly inside the domain; both keep their parameters.
    pub fn split(&self, u: f64) -> Result<(Self, Self), RefineError> {
        let u = self.knots().snapped(u);
        let missing = self.degree().saturating_sub(self.knots().multiplicity(u));
        let (start, end) = self.domain();
        if !(u > start && u < end) {
            return Err(RefineError::Outside {
                value: u,
                start,
                end,
            });
        }
        let refined = self.insert_knot(u, missing)?;
        let (left, right, shared) = refined.knots().parted(u);
        let part = |knots, own: std::ops::Range<usize>| {
            let (points, weights) = (&refined.points()[own.clone()], &refined.weights()[own]);
            Self::trusted(knots, points.to_vec(), weights.to_vec(), self.is_rational())
        };
        Ok((
            part(left, 0..shared + 1),
            part(right, shared..refined.points().len()),
        ))
    }

    /// The polynomial or rational pieces, each with as many control points as degree + 1 and its own part of the domain.
    pub fn bezier_segments(&self) -> Vec<Self> {
        let refined = self.refined(&self.knots().missing_for_bezier());
        let degree = self.degree();
        let segment = |(k, knots): (usize, KnotVector)| {
            let own = k * degree..=(k + 1) * degree;
            let (points, weights) = (&refined.points()[own.clone()], &refined.weights()[own]);
            Self::trusted(knots, points.to_vec(), weights.to_vec(), self.is_rational())
        };
        refined
            .knots()
            .pieces()
            .into_iter()
            .enumerate()
            .map(segment)
            .collect()
    }
}

impl Surface {
    /// The parts below and above u, which must lie strictly inside the domain; both keep their parameters.
    pub fn split_u(&self, u: f64) -> Result<(Self, Self), RefineError> {
        let (low, high) = self.transposed().split_v(u)?;
        Ok((low.transposed(), high.transposed()))
    }

    /// The parts below and above v, which must lie strictly inside the domain; both keep their parameters.
    pub fn split_v(&self, v: f64) -> Result<(Self, Self), RefineError> {
        let knots = self.knots_v();
        let v = knots.snapped(v);
        let (start, end) = knots.domain();
        if !(v > start && v < end) {
            return Err(RefineError::Outside {
                value: v,
                start,
                end,
            });
        }
        let missing = knots.degree().saturating_sub(knots.multiplicity(v));
        let refined = self.insert_knot_v(v, missing)?;
        let (left, right, shared) = refined.knots_v().parted(v);
        let last = refined.knots_v().count();
        Ok((
            refined.columns(left, 0..shared + 1),
            refined.columns(right, shared..last),
        ))
    }

    /// The polynomial or rational pieces, u-major, each with its own part of the domain.
    pub fn bezier_patches(&self) -> impl Iterator<Item = Self> + use<> {
        self.bezier_strips().flat_map(|strip| strips(&strip))
    }

    /// The parts between neighbouring knots in u, in which every knot in v is as often there as the degree says: the nets of
    /// the pieces are parts of theirs, and neighbours have their common points. One is made after the other.
    pub fn bezier_strips(&self) -> impl Iterator<Item = Self> + use<> {
        strips(&self.transposed()).map(|strip| {
            let strip = strip.transposed();
            strip.refined_v(&strip.knots_v().missing_for_bezier())
        })
    }

    /// The surface of some columns of the net, with the knots that belong to them.
    fn columns(&self, v: KnotVector, own: std::ops::Range<usize>) -> Self {
        let nv = self.knots_v().count();
        Self::trusted(
            self.knots_u().clone(),
            v,
            columns(self.net(), nv, own.clone()),
            columns(self.weights(), nv, own),
            self.is_rational(),
        )
    }
}

/// The parts between neighbouring knots in v.
fn strips(surface: &Surface) -> impl Iterator<Item = Surface> + use<> {
    let refined = surface.refined_v(&surface.knots_v().missing_for_bezier());
    let degree = refined.knots_v().degree();
    let pieces = refined.knots_v().pieces().into_iter().enumerate();
    pieces.map(move |(k, knots)| refined.columns(knots, k * degree..(k + 1) * degree + 1))
}

/// Some columns of a net with rows of a length.
fn columns<T: Copy>(net: &[T], row: usize, own: std::ops::Range<usize>) -> Vec<T> {
    let mut columns = Vec::with_capacity(net.len() / row * own.len());
    for row in net.chunks(row) {
        columns.extend_from_slice(&row[own.clone()]);
    }
    columns
}
