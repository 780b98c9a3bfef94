//! Smooth functions over the plan, from heights on a lattice of even spacing or from scattered heights.
//!
//! Uniform bicubic splines with natural ends (the curvature across a border is zero), continued beyond the lattice by
//! straight lines: twice continuously differentiable everywhere. With coefficients `c_0 … c_{n−1}` along an axis, one for
//! each node, natural ends mean that `c_{−1}, c_0, c_1` lie on a line, and so do the last three: no other unknowns.
//! Functions that are linear in x, in y and in xy are reproduced.

use super::banded::Banded;
use super::interpolate::{self, InterpolateError};
use super::{KnotError, KnotVector};
use glam::{DVec2, DVec3};
use thiserror::Error;

/// Weight of a fitted lattice's own size: nothing but what keeps the equations solvable where no data are.
const RIDGE: f64 = 1e-9;

/// Why heights make no lattice.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum LatticeError {
    /// The lattice has fewer than 2 × 2 nodes, or heights for another number of nodes.
    #[error(
        "there are {found} heights for {nx} × {ny} nodes; give one for each of at least 2 × 2 nodes"
    )]
    Count {
        /// Number of heights.
        found: usize,
        /// Number of nodes along x.
        nx: usize,
        /// Number of nodes along y.
        ny: usize,
    },
    /// The lattice has no width, or a corner is no number.
    #[error(
        "the lattice reaches from {low} to {high}; its second corner must lie beyond the first"
    )]
    Extent {
        /// The first node.
        low: DVec2,
        /// The last node.
        high: DVec2,
    },
    /// A height is infinite or not a number.
    #[error("height ({i}, {j}) is {value}; heights must be finite")]
    Height {
        /// Position along x.
        i: usize,
        /// Position along y.
        j: usize,
        /// The height.
        value: f64,
    },
    /// A scattered point is infinite or not a number.
    #[error("point {index} is {value}; coordinates must be finite")]
    Point {
        /// Position in the list.
        index: usize,
        /// The point.
        value: DVec3,
    },
    /// Rounding leaves no solution.
    #[error(
        "the equations of a lattice of {nx} × {ny} nodes have no solution at node {index}; give a greater smoothness"
    )]
    Singular {
        /// Number of nodes along x.
        nx: usize,
        /// Number of nodes along y.
        ny: usize,
        /// The node.
        index: usize,
    },
}

/// A twice continuously differentiable function over the plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    low: DVec2,
    high: DVec2,
    counts: [usize; 2],
    /// The coefficient of node i along x and j along y is entry `i * ny + j`.
    coefficients: Vec<f64>,
}

/// The nodes whose coefficients count at a place along one axis.
pub(super) struct Weights {
    /// The cell: the node before the place.
    pub(super) span: usize,
    pub(super) first: usize,
    pub(super) values: [f64; 4],
    pub(super) count: usize,
}

impl Lattice {
    /// The lattice with the given heights at its nodes; node i along x and j along y is entry `i * ny + j`.
    pub fn interpolated(
        low: DVec2,
        high: DVec2,
        counts: [usize; 2],
        heights: &[f64],
    ) -> Result<Self, LatticeError> {
        let [nx, ny] = counts;
        check_extent(low, high)?;
        if nx < 2 || ny < 2 || heights.len() != nx * ny {
            let found = heights.len();
            return Err(LatticeError::Count { found, nx, ny });
        }
        if let Some(at) = heights.iter().position(|z| !z.is_finite()) {
            let (i, j, value) = (at / ny, at % ny, heights[at]);
            return Err(LatticeError::Height { i, j, value });
        }
        let singular = |index| LatticeError::Singular { nx, ny, index };
        let mut coefficients = heights.to_vec();
        let along_y = node_system(ny).map_err(singular)?;
        for row in coefficients.chunks_mut(ny) {
            along_y.solve(row);
        }
        let along_x = node_system(nx).map_err(singular)?;
        for j in 0..ny {
            let mut column: Vec<f64> = (0..nx).map(|i| coefficients[i * ny + j]).collect();
            along_x.solve(&mut column);
            for (i, value) in column.into_iter().enumerate() {
                coefficients[i * ny + j] = value;
            }
        }
        Ok(Self {
            low,
            high,
            counts,
            coefficients,
        })
    }

    /// The lattice that makes `Σ (f(x, y) − z)² + smoothness · bending` least, where bending is the sum of the squared
    /// second differences of the coefficients (xx, twice xy, yy).
    pub fn fitted(
        low: DVec2,
        high: DVec2,
        counts: [usize; 2],
        points: &[DVec3],
        smoothness: f64,
    ) -> Result<Self, LatticeError> {
        let [nx, ny] = counts;
        check_extent(low, high)?;
        if nx < 2 || ny < 2 {
            let found = points.len();
            return Err(LatticeError::Count { found, nx, ny });
        }
        if let Some((index, &value)) = points.iter().enumerate().find(|(_, p)| !p.is_finite()) {
            return Err(LatticeError::Point { index, value });
        }
        let mut lattice = Self {
            low,
            high,
            counts,
            coefficients: vec![0.0; nx * ny],
        };
        let mut matrix = Banded::zeros(nx * ny, (3 * ny + 3).min(nx * ny - 1));
        let mut right = vec![0.0; nx * ny];
        for point in points {
            let row = lattice.row(point.truncate());
            for &(a, n) in &row {
                right[a] += n * point.z;
            }
            accumulate(&mut matrix, &row, 1.0);
        }
        for (row, _, weight) in bending(counts) {
            accumulate(&mut matrix, &row, smoothness * weight);
        }
        for node in 0..nx * ny {
            matrix.add(node, node, RIDGE);
        }
        matrix
            .factor()
            .map_err(|index| LatticeError::Singular { nx, ny, index })?;
        matrix.solve(&mut right);
        lattice.coefficients = right;
        Ok(lattice)
    }

    /// The lattice with these coefficients: that of node i along x and j along y is entry `i * ny + j`.
    pub fn of_coefficients(
        low: DVec2,
        high: DVec2,
        counts: [usize; 2],
        coefficients: Vec<f64>,
    ) -> Result<Self, LatticeError> {
        let [nx, ny] = counts;
        check_extent(low, high)?;
        if nx < 2 || ny < 2 || coefficients.len() != nx * ny {
            let found = coefficients.len();
            return Err(LatticeError::Count { found, nx, ny });
        }
        Ok(Self {
            low,
            high,
            counts,
            coefficients,
        })
    }

    /// All values multiplied by a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        for value in &mut scaled.coefficients {
            *value *= factor;
        }
        scaled
    }

    /// The same function elsewhere.
    #[must_use]
    pub fn moved(&self, by: DVec2) -> Self {
        let mut moved = self.clone();
        moved.low += by;
        moved.high += by;
        moved
    }

    /// The value at a place.
    pub fn value(&self, at: DVec2) -> f64 {
        let (x, y) = (self.weights(0, at.x), self.weights(1, at.y));
        let ny = self.counts[1];
        let mut sum = 0.0;
        for (i, n) in x.values[..x.count].iter().enumerate() {
            let own = &self.coefficients[(x.first + i) * ny + y.first..];
            // With their number as a constant nothing is looped over.
            let row = |own: &[f64]| own.iter().zip(&y.values).map(|(c, m)| c * m).sum::<f64>();
            sum += n * match own.first_chunk::<4>() {
                Some(own) if y.count == 4 => row(own),
                _ => row(&own[..y.count]),
            };
        }
        sum
    }

    /// The Bernstein coefficients of the function on the cell between node i along x and j along y and the next ones: along x,
    /// then along y.
    pub fn cell(&self, [i, j]: [usize; 2]) -> [[f64; 4]; 4] {
        let [nx, ny] = self.counts;
        let along_y = |i: usize| bernstein(|j| self.coefficients[i * ny + j], ny, j);
        let columns = [0, 1, 2, 3].map(|b| bernstein(|i| along_y(i)[b], nx, i));
        [0, 1, 2, 3].map(|a| columns.map(|column| column[a]))
    }

    /// The first and the last node.
    pub fn corners(&self) -> (DVec2, DVec2) {
        (self.low, self.high)
    }

    /// The number of nodes along x and along y.
    pub fn counts(&self) -> [usize; 2] {
        self.counts
    }

    /// The sum with another one on the same nodes; `None` if its nodes are others.
    pub fn plus(&self, other: &Self) -> Option<Self> {
        let same = self.low == other.low && self.high == other.high && self.counts == other.counts;
        let sum = |(a, b): (&f64, &f64)| a + b;
        same.then(|| Self {
            coefficients: self
                .coefficients
                .iter()
                .zip(&other.coefficients)
                .map(sum)
                .collect(),
            ..*self
        })
    }

    /// The part of a sum of lattices over a box in plan as a spline function of two parameters, which are fractions of the
    /// box's sides: knots along x and y, coefficients x-major.
    pub fn part(
        sum: &[&Self],
        low: DVec2,
        high: DVec2,
    ) -> Result<(KnotVector, KnotVector, Vec<f64>), InterpolateError> {
        let u = Self::knots(sum, 0, low.x, high.x)?;
        let v = Self::knots(sum, 1, low.y, high.y)?;
        let heights = interpolate::net(&u, &v, |u, v| {
            let at = low + (high - low) * DVec2::new(u, v);
            sum.iter().map(|one| one.value(at)).sum()
        })?;
        Ok((u, v, heights))
    }

    /// Knots from 0 to 1 at the nodes between two coordinates; degree 1 where no lattice has more than two nodes.
    fn knots(sum: &[&Self], axis: usize, from: f64, to: f64) -> Result<KnotVector, KnotError> {
        // A node this near an end, or another lattice's, is left out: the function is smooth enough not to show it.
        const NEAR: f64 = 1e-6;
        let bent = || sum.iter().filter(|one| one.counts[axis] > 2);
        let degree = if bent().next().is_none() { 1 } else { 3 };
        let mut nodes: Vec<f64> = bent()
            .flat_map(|one| {
                let (low, step) = (one.low[axis], one.step(axis));
                (0..one.counts[axis])
                    .map(move |node| (low + step * node as f64 - from) / (to - from))
            })
            .collect();
        nodes.sort_by(f64::total_cmp);
        let mut knots = vec![0.0; degree + 1];
        let mut previous = 0.0;
        for at in nodes {
            if at > previous + NEAR && at < 1.0 - NEAR {
                knots.push(at);
                previous = at;
            }
        }
        knots.extend(std::iter::repeat_n(1.0, degree + 1));
        KnotVector::new(degree, knots)
    }

    fn step(&self, axis: usize) -> f64 {
        (self.high[axis] - self.low[axis]) / (self.counts[axis] - 1) as f64
    }

    /// The nodes' weights at a coordinate: uniform cubic basis functions, with those of the nodes beyond the ends shared
    /// out to the last two.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the number is not negative, and the cast stops at the greatest integer"
    )]
    fn weights(&self, axis: usize, x: f64) -> Weights {
        let count = self.counts[axis];
        let last = count - 1;
        let t = (x - self.low[axis]) / self.step(axis);
        let first = if t > 0.0 { t as usize } else { 0 };
        let span = first.min(count - 2);
        // The cubic basis functions at a place between two nodes.
        let cubics = || {
            let f = t - span as f64;
            let g = 1.0 - f;
            let inner = |f: f64| (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0;
            [g * g * g / 6.0, inner(f), inner(g), f * f * f / 6.0]
        };
        if 0 < span && span + 2 < count {
            // Away from the ends, as most places are.
            return Weights {
                span,
                first: span - 1,
                values: cubics(),
                count: 4,
            };
        }
        let mut weights = Weights {
            span,
            first: span.saturating_sub(1).min(count.saturating_sub(4)),
            values: [0.0; 4],
            count: count.min(4),
        };
        let beyond = t - last as f64;
        if t <= 0.0 {
            weights.add(0, 1.0 - t);
            weights.add(1, t);
        } else if beyond >= 0.0 {
            weights.add(last - 1, -beyond);
            weights.add(last, 1.0 + beyond);
        } else {
            let [before, own, next, after] = cubics();
            weights.add(span, own);
            weights.add(span + 1, next);
            if span == 0 {
                weights.add(0, 2.0 * before);
                weights.add(1, -before);
            } else {
                weights.add(span - 1, before);
            }
            if span + 1 == last {
                weights.add(last, 2.0 * after);
                weights.add(last - 1, -after);
            } else {
                weights.add(span + 2, after);
            }
        }
        weights
    }

    /// What counts at a place along x and along y.
    pub(super) fn at(&self, place: DVec2) -> (Weights, Weights) {
        (self.weights(0, place.x), self.weights(1, place.y))
    }

    /// Which coefficients count at a place, and how much.
    fn row(&self, at: DVec2) -> Vec<(usize, f64)> {
        let (x, y) = (self.weights(0, at.x), self.weights(1, at.y));
        let ny = self.counts[1];
        let mut row = Vec::with_capacity(16);
        for (i, n) in x.values[..x.count].iter().enumerate() {
            for (j, m) in y.values[..y.count].iter().enumerate() {
                row.push(((x.first + i) * ny + y.first + j, n * m));
            }
        }
        row
    }
}

impl Weights {
    fn add(&mut self, node: usize, value: f64) {
        self.values[node - self.first] += value;
    }
}

/// Bernstein coefficients between a node and the next one along an axis; beyond the ends coefficients go on evenly.
fn bernstein(coefficient: impl Fn(usize) -> f64, count: usize, node: usize) -> [f64; 4] {
    let (b, c) = (coefficient(node), coefficient(node + 1));
    let a = match node.checked_sub(1) {
        Some(before) => coefficient(before),
        None => 2.0 * b - c,
    };
    let d = if node + 2 < count {
        coefficient(node + 2)
    } else {
        2.0 * c - b
    };
    [
        (a + 4.0 * b + c) / 6.0,
        (2.0 * b + c) / 3.0,
        (b + 2.0 * c) / 3.0,
        (b + 4.0 * c + d) / 6.0,
    ]
}

fn check_extent(low: DVec2, high: DVec2) -> Result<(), LatticeError> {
    if low.is_finite() && high.is_finite() && high.cmpgt(low).all() {
        Ok(())
    } else {
        Err(LatticeError::Extent { low, high })
    }
}

/// The factored system of "these are the values at the nodes" along one axis.
fn node_system(count: usize) -> Result<Banded, usize> {
    let mut matrix = Banded::zeros(count, 1);
    matrix.set(0, 0, 1.0);
    matrix.set(count - 1, count - 1, 1.0);
    for node in 1..count - 1 {
        matrix.set(node, node - 1, 1.0 / 6.0);
        matrix.set(node, node, 4.0 / 6.0);
        matrix.set(node, node + 1, 1.0 / 6.0);
    }
    matrix.factor()?;
    Ok(matrix)
}

fn accumulate(matrix: &mut Banded, row: &[(usize, f64)], weight: f64) {
    for &(a, n) in row {
        for &(b, m) in row {
            matrix.add(a, b, weight * n * m);
        }
    }
}

/// A second difference of coefficients, along which axes it is (0: x and x, 1: x and y, 2: y and y), and its weight.
type Difference = ([(usize, f64); 4], usize, f64);

/// Second differences of the coefficients.
pub(super) fn bending([nx, ny]: [usize; 2]) -> impl Iterator<Item = Difference> {
    let at = move |i: usize, j: usize| i * ny + j;
    let straight = |[a, b, c]: [usize; 3]| [(a, 1.0), (b, -2.0), (c, 1.0), (c, 0.0)];
    let places = (0..nx).flat_map(move |i| (0..ny).map(move |j| (i, j)));
    places.flat_map(move |(i, j)| {
        let along_x = (i + 2 < nx).then(|| [at(i, j), at(i + 1, j), at(i + 2, j)]);
        let along_y = (j + 2 < ny).then(|| [at(i, j), at(i, j + 1), at(i, j + 2)]);
        let twisted = (i + 1 < nx && j + 1 < ny).then(|| {
            [
                (at(i, j), 1.0),
                (at(i + 1, j), -1.0),
                (at(i, j + 1), -1.0),
                (at(i + 1, j + 1), 1.0),
            ]
        });
        [
            along_x.map(|nodes| (straight(nodes), 0, 1.0)),
            along_y.map(|nodes| (straight(nodes), 2, 1.0)),
            twisted.map(|row| (row, 1, 2.0)),
        ]
        .into_iter()
        .flatten()
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    const LOW: DVec2 = DVec2::new(10.0, -5.0);

    #[test]
    fn along_an_axis_it_is_the_natural_cubic_spline() {
        // Through 0, 1, 0: 3/2 t − 1/2 t³ up to the middle. Constant along y.
        let heights = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0];
        let high = LOW + DVec2::new(2.0, 7.0);
        let lattice = Lattice::interpolated(LOW, high, [3, 2], &heights).unwrap();
        for t in [0.0, 0.3, 0.5, 1.0] {
            let at = LOW + DVec2::new(t, 3.1);
            assert!((lattice.value(at) - (1.5 * t - 0.5 * t * t * t)).abs() < 1e-14);
            let mirrored = LOW + DVec2::new(2.0 - t, 3.1);
            assert!((lattice.value(at) - lattice.value(mirrored)).abs() < 1e-14);
        }
        // Beyond the ends straight, with the slope of 3/2 there.
        assert!((lattice.value(LOW - DVec2::new(4.0, 0.0)) - -6.0).abs() < 1e-14);
        assert!((lattice.value(LOW + DVec2::new(6.0, 9.0)) - -6.0).abs() < 1e-14);
    }

    #[test]
    fn a_part_is_the_same_function_within_the_lattice_and_across_its_borders() {
        let heights: Vec<f64> = (0..35).map(|k| (f64::from(k) * 1.7).sin()).collect();
        let high = LOW + DVec2::new(6.0, 4.0);
        let lattice = Lattice::interpolated(LOW, high, [7, 5], &heights).unwrap();
        let (from, to) = (LOW - DVec2::new(3.0, -1.3), high + DVec2::new(-2.4, 5.0));
        let (u, v, net) = Lattice::part(&[&lattice], from, to).unwrap();
        let nv = v.count();
        for (a, b) in [
            (0.0, 0.0),
            (0.2, 0.9),
            (0.35, 0.33),
            (0.78, 0.1),
            (1.0, 1.0),
        ] {
            let (in_u, in_v) = (u.basis(a), v.basis(b));
            let mut sum = 0.0;
            for (i, n) in in_u.values().iter().enumerate() {
                for (j, m) in in_v.values().iter().enumerate() {
                    sum += n * m * net[(in_u.first() + i) * nv + in_v.first() + j];
                }
            }
            let exact = lattice.value(from + (to - from) * DVec2::new(a, b));
            assert!((sum - exact).abs() < 1e-12, "{a} {b}: {sum} {exact}");
        }
    }

    #[test]
    fn a_sum_of_lattices_is_the_sum_of_their_functions_on_the_nodes_of_both() {
        let wave = |count: i32, rate: f64| -> Vec<f64> {
            (0..count).map(|k| (f64::from(k) * rate).sin()).collect()
        };
        let high = LOW + DVec2::new(6.0, 4.0);
        let one = Lattice::interpolated(LOW, high, [7, 5], &wave(35, 1.7)).unwrap();
        let other = Lattice::interpolated(LOW, high, [4, 2], &wave(8, 0.9)).unwrap();
        assert!(one.plus(&other).is_none());
        let twice = one.plus(&one).unwrap();
        let (from, to) = (LOW - DVec2::new(1.0, 0.3), high + DVec2::new(0.4, 2.0));
        let (u, v, net) = Lattice::part(&[&one, &other], from, to).unwrap();
        let surface = crate::nurbs::Surface::new(
            u,
            v,
            net.iter().map(|z| DVec3::new(0.0, 0.0, *z)).collect(),
        )
        .unwrap();
        for (a, b) in [(0.0, 0.0), (0.2, 0.9), (0.35, 0.33), (0.78, 0.1)] {
            let at = from + (to - from) * DVec2::new(a, b);
            let sum = one.value(at) + other.value(at);
            assert!((surface.point(a, b).z - sum).abs() < 1e-12, "{a} {b}");
            assert!((twice.value(at) - 2.0 * one.value(at)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_stiff_fit_is_the_plane_of_least_squares_and_a_loose_one_passes_the_points() {
        // Corners of a square: the plane of least squares is z = 1/4 + y, missed by 1/4 everywhere.
        let points = [
            (0.0, 0.0, 0.0),
            (2.0, 0.0, 0.5),
            (0.0, 2.0, 2.5),
            (2.0, 2.0, 2.0),
        ]
        .map(DVec3::from);
        let (low, high) = (DVec2::splat(-1.0), DVec2::splat(3.0));
        let stiff = Lattice::fitted(low, high, [7, 9], &points, 1e4).unwrap();
        let loose = Lattice::fitted(low, high, [7, 9], &points, 1e-6).unwrap();
        for p in points {
            let (x, y) = (p.x, p.y);
            assert!(
                (stiff.value(p.truncate()) - (0.25 + y)).abs() < 1e-3,
                "{x} {y}"
            );
            assert!((loose.value(p.truncate()) - p.z).abs() < 1e-3);
        }
    }

    #[test]
    fn numbers_that_make_no_lattice_are_refused() {
        let high = LOW + DVec2::ONE;
        let made =
            |high, counts, heights: &[f64]| Lattice::interpolated(LOW, high, counts, heights);
        assert!(matches!(
            made(high, [1, 2], &[0.0; 2]),
            Err(LatticeError::Count { found: 2, .. })
        ));
        assert!(matches!(
            made(LOW, [2, 2], &[0.0; 4]),
            Err(LatticeError::Extent { .. })
        ));
        assert!(matches!(
            made(high, [2, 2], &[0.0, 0.0, f64::NAN, 0.0]),
            Err(LatticeError::Height { i: 1, j: 0, .. })
        ));
        let point = [DVec3::INFINITY];
        assert!(matches!(
            Lattice::fitted(LOW, high, [2, 2], &point, 1.0),
            Err(LatticeError::Point { index: 0, .. })
        ));
    }
}
