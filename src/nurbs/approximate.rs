//! Lattices of least squares through very many scattered heights.
//!
//! What is least is `Σ (f(x, y) − z)² + smoothness · ρ · bending`: ρ is the mean number of heights in a cell that has any, and bending
//! the sum of the squared second differences of the coefficients (xx, twice xy, yy), as of cells that are square. Where there are no
//! heights, in holes and beyond their border, the lattice is the plate that bends least.
//!
//! The equations have 49 entries a row, those of 7 × 7 nodes around one. They are solved by conjugate gradients, with a multigrid cycle
//! over lattices of half as many cells each as preconditioner, beginning with the solution on the next coarser one (Briggs, Henson and others 2000, *A Multigrid Tutorial*): splines on a lattice are
//! splines on one with halved cells, so heights and bending of a coarser lattice need no approximation. On the coarsest one the equations are
//! solved directly. All is summed up in the order of the heights, so no number depends on threads.

use std::collections::BTreeMap;
use std::rc::Rc;

use glam::{DVec2, DVec3};

use super::banded::Banded;
use super::lattice::{Lattice, LatticeError, bending};

/// Nodes along one side of the entries of a row, and before its own.
const WIDTH: usize = 7;
const BEFORE: usize = 3;
const ENTRIES: usize = WIDTH * WIDTH;
/// Residuals are small enough at this fraction of the right-hand side, and steps many enough at this number.
const RESIDUAL: f64 = 1e-11;
const STEPS: usize = 50;
/// After so many steps, and twice, four times … as many, it is asked whether there is any use in more.
const FIRST_ASKED: usize = 4;
/// The square root of how many times larger an error's energy is than what a cycle makes of its residual: conjugate gradients with this cycle
/// gain a factor of 1.25 a step, so the condition is about 80.
const CONDITION: f64 = 10.0;
/// Sweeps before and after the coarser lattice.
const SWEEPS: usize = 2;
/// Sides with no more cells are not halved: so few nodes are solved for directly.
const COARSEST: usize = 7;
/// Lattices of more nodes are not kept for others: they would take most of the memory.
const MOST_KEPT: usize = 20_000;
/// Weight of a coefficient's own size, as a fraction of the greatest on the diagonal: what rounding leaves undecided is 0.
const RIDGE: f64 = 1e-13;

/// Heights over a box in plan, to which lattices of any size are fitted.
pub struct Approximation<'a> {
    low: DVec2,
    high: DVec2,
    points: &'a [DVec3],
    kept: BTreeMap<[usize; 2], Rc<Sums>>,
}

/// What heights add to the equations of a lattice.
struct Sums {
    rows: Vec<[f64; ENTRIES]>,
    right: Vec<f64>,
    /// Cells that have heights.
    cells: usize,
}

/// The equations of a lattice.
struct Level {
    counts: [usize; 2],
    rows: Vec<[f64; ENTRIES]>,
}

/// The equations of a lattice and of coarser ones.
struct Cycle {
    levels: Vec<Level>,
    coarsest: Banded,
}

impl<'a> Approximation<'a> {
    /// For heights at places within a box.
    pub fn new(low: DVec2, high: DVec2, points: &'a [DVec3]) -> Result<Self, LatticeError> {
        if !(low.is_finite() && high.is_finite() && high.cmpgt(low).all()) {
            return Err(LatticeError::Extent { low, high });
        }
        if let Some((index, &value)) = points.iter().enumerate().find(|(_, p)| !p.is_finite()) {
            return Err(LatticeError::Point { index, value });
        }
        Ok(Self {
            low,
            high,
            points,
            kept: BTreeMap::new(),
        })
    }

    /// The lattice with so many cells along x and y.
    ///
    /// While it is being solved for, `is_vain` is asked now and then with what it is so far, and about how far heights of that are from
    /// those of the solution, as a root mean square (m). If it says yes, that is what the caller gets.
    pub fn lattice(
        &mut self,
        cells: [usize; 2],
        smoothness: f64,
        mut is_vain: impl FnMut(Lattice, f64) -> bool,
    ) -> Result<Lattice, LatticeError> {
        let counts = cells.map(|count| count + 1);
        let zeros = vec![0.0; counts[0] * counts[1]];
        let frame = Lattice::of_coefficients(self.low, self.high, counts, zeros)?;
        let sums = self.sums(&frame);
        let density = self.points.len() as f64 / sums.cells.max(1) as f64;
        let size = (self.high - self.low) / DVec2::new(cells[0] as f64, cells[1] as f64);
        let stiffness = smoothness * density * size.element_product();
        let cycle = self.cycle(cells, stiffness)?;
        let lattice = |coefficients: Vec<f64>| {
            Lattice::of_coefficients(self.low, self.high, counts, coefficients)
        };
        let number = self.points.len() as f64;
        let coefficients = cycle.solve(0, &sums.right, &mut |so_far, energy| {
            let known = CONDITION * (energy / number).sqrt();
            lattice(so_far.to_vec()).is_ok_and(|so_far| is_vain(so_far, known))
        });
        lattice(coefficients)
    }

    /// The equations of a lattice and all coarser ones, for a stiffness in square metres.
    fn cycle(&mut self, mut cells: [usize; 2], stiffness: f64) -> Result<Cycle, LatticeError> {
        let mut levels = Vec::new();
        loop {
            let counts = cells.map(|count| count + 1);
            let zeros = vec![0.0; counts[0] * counts[1]];
            let frame = Lattice::of_coefficients(self.low, self.high, counts, zeros)?;
            let sums = self.sums(&frame);
            let rows = Rc::try_unwrap(sums).map_or_else(|sums| sums.rows.clone(), |sums| sums.rows);
            let mut level = Level { counts, rows };
            let size = (self.high - self.low) / DVec2::new(cells[0] as f64, cells[1] as f64);
            level.bend(stiffness / size.element_product(), size);
            levels.push(level);
            let coarser = cells.map(halved);
            if coarser == cells {
                break;
            }
            cells = coarser;
        }
        let coarsest = levels
            .last()
            .map_or_else(|| Ok(Banded::zeros(1, 0)), Level::factored)?;
        Ok(Cycle { levels, coarsest })
    }

    fn sums(&mut self, frame: &Lattice) -> Rc<Sums> {
        if let Some(kept) = self.kept.get(&frame.counts()) {
            return Rc::clone(kept);
        }
        let sums = Rc::new(Sums::of(frame, self.points));
        if sums.rows.len() <= MOST_KEPT {
            self.kept.insert(frame.counts(), Rc::clone(&sums));
        }
        sums
    }
}

/// Half as many cells, if that leaves whole ones and they are not few already.
fn halved(cells: usize) -> usize {
    if cells > COARSEST && cells.is_multiple_of(2) {
        cells / 2
    } else {
        cells
    }
}

impl Sums {
    fn of(frame: &Lattice, points: &[DVec3]) -> Self {
        let [nx, ny] = frame.counts();
        let mut rows = vec![[0.0; ENTRIES]; nx * ny];
        let mut right = vec![0.0; nx * ny];
        let mut has_heights = vec![false; nx * ny];
        for point in points {
            let (x, y) = frame.at(point.truncate());
            has_heights[x.span * ny + y.span] = true;
            for (a, n) in x.values[..x.count].iter().enumerate() {
                for (b, m) in y.values[..y.count].iter().enumerate() {
                    let node = (x.first + a) * ny + y.first + b;
                    let weight = n * m;
                    right[node] += weight * point.z;
                    let row = &mut rows[node];
                    for (c, o) in x.values[..x.count].iter().enumerate() {
                        let entry = (BEFORE + c - a) * WIDTH + BEFORE - b;
                        let own = &mut row[entry..entry + y.count];
                        for (sum, p) in own.iter_mut().zip(&y.values) {
                            *sum += weight * o * p;
                        }
                    }
                }
            }
        }
        let cells = has_heights.iter().filter(|has| **has).count();
        Self { rows, right, cells }
    }
}

impl Level {
    /// Adds bending and the ridge.
    fn bend(&mut self, weight: f64, size: DVec2) {
        let ny = self.counts[1];
        // Of cells that are not square the differences along their short side weigh more.
        let slender = size.y / size.x;
        let along = [slender * slender, 1.0, 1.0 / (slender * slender)];
        for (row, axis, own) in bending(self.counts) {
            for &(a, n) in &row {
                for &(b, m) in &row {
                    let (across, up) = (b / ny + BEFORE - a / ny, b % ny + BEFORE - a % ny);
                    self.rows[a][across * WIDTH + up] += weight * along[axis] * own * n * m;
                }
            }
        }
        let diagonal = BEFORE * WIDTH + BEFORE;
        let most = self
            .rows
            .iter()
            .map(|row| row[diagonal])
            .fold(0.0, f64::max);
        for row in &mut self.rows {
            row[diagonal] += RIDGE * most;
        }
    }

    fn factored(&self) -> Result<Banded, LatticeError> {
        let [nx, ny] = self.counts;
        let mut matrix = Banded::zeros(nx * ny, (BEFORE * ny + BEFORE).min(nx * ny - 1));
        for node in 0..nx * ny {
            for (other, value) in self.entries(node) {
                matrix.set(node, other, value);
            }
        }
        matrix
            .factor()
            .map_err(|index| LatticeError::Singular { nx, ny, index })?;
        Ok(matrix)
    }

    /// The entries of a row, with the nodes that they are of.
    fn entries(&self, node: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.runs(node).flat_map(move |(first, entry, count)| {
            (0..count).map(move |k| (first + k, self.rows[node][entry + k]))
        })
    }

    /// The runs of a row: first node, first entry and how many there are.
    fn runs(&self, node: usize) -> impl Iterator<Item = (usize, usize, usize)> + use<> {
        let [nx, ny] = self.counts;
        let (i, j) = (node / ny, node % ny);
        let (from, to) = (j.saturating_sub(BEFORE), (j + BEFORE + 1).min(ny));
        (i.saturating_sub(BEFORE)..(i + BEFORE + 1).min(nx)).map(move |column| {
            let entry = (column + BEFORE - i) * WIDTH + from + BEFORE - j;
            (column * ny + from, entry, to - from)
        })
    }

    /// A row times a vector.
    fn times(&self, node: usize, vector: &[f64]) -> f64 {
        let row = &self.rows[node];
        let [nx, ny] = self.counts;
        let (i, j) = (node / ny, node % ny);
        let is_inner = |at: usize, count: usize| BEFORE <= at && at + BEFORE < count;
        let mut sum = 0.0;
        if is_inner(i, nx) && is_inner(j, ny) {
            // Away from the borders all entries count: with their number as a constant nothing is looped over.
            let (own, _) = row.as_chunks::<WIDTH>();
            for (column, own) in own.iter().enumerate() {
                let others = &vector[(i - BEFORE + column) * ny + j - BEFORE..][..WIDTH];
                sum += own.iter().zip(others).map(|(a, x)| a * x).sum::<f64>();
            }
            return sum;
        }
        for (first, entry, count) in self.runs(node) {
            let own = row[entry..entry + count].iter();
            let others = &vector[first..first + count];
            sum += own.zip(others).map(|(a, x)| a * x).sum::<f64>();
        }
        sum
    }

    /// Lets a node fulfil its equation.
    fn relax(&self, node: usize, right: &[f64], vector: &mut [f64]) {
        let own = self.rows[node][BEFORE * WIDTH + BEFORE];
        vector[node] += (right[node] - self.times(node, vector)) / own;
    }
}

impl Cycle {
    /// The solution of a level: by conjugate gradients, from that of the coarser one. Where there are no heights what is left of the equations
    /// is too small to be told, but the coarser solution is right there already, since the coarsest is exact.
    ///
    /// `is_vain` gets what the solution is so far, and about the energy of what is missing: the sum of the squared differences of the heights,
    /// and more.
    fn solve(
        &self,
        at: usize,
        right: &[f64],
        is_vain: &mut dyn FnMut(&[f64], f64) -> bool,
    ) -> Vec<f64> {
        let level = &self.levels[at];
        if at + 1 == self.levels.len() {
            return self.cycled(at, right);
        }
        let coarser = self.levels[at + 1].counts;
        let start = self.solve(
            at + 1,
            &restricted(right, level.counts, coarser),
            &mut |_, _| false,
        );
        let mut solution = prolonged(&start, coarser, level.counts);
        let mut residual: Vec<f64> = (0..right.len())
            .map(|node| right[node] - level.times(node, &solution))
            .collect();
        let mut direction = self.cycled(at, &residual);
        let mut reduced = dot(&residual, &direction);
        let enough = RESIDUAL * dot(right, right).sqrt();
        let mut asked = FIRST_ASKED;
        for step in 0..STEPS {
            if !(reduced > 0.0 && dot(&residual, &residual).sqrt() > enough) {
                break;
            }
            if step == asked {
                if is_vain(&solution, reduced) {
                    break;
                }
                asked *= 2;
            }
            let image: Vec<f64> = (0..right.len())
                .map(|node| level.times(node, &direction))
                .collect();
            let step = reduced / dot(&direction, &image);
            for (node, (d, i)) in direction.iter().zip(&image).enumerate() {
                solution[node] += step * d;
                residual[node] -= step * i;
            }
            let next = self.cycled(at, &residual);
            let before = std::mem::replace(&mut reduced, dot(&residual, &next));
            for (d, n) in direction.iter_mut().zip(&next) {
                *d = n + reduced / before * *d;
            }
        }
        solution
    }

    /// About what solves the equations of a level: sweeps, the coarser levels, and the same sweeps the other way round.
    fn cycled(&self, at: usize, right: &[f64]) -> Vec<f64> {
        let level = &self.levels[at];
        if at + 1 == self.levels.len() {
            let mut solution = right.to_vec();
            self.coarsest.solve(&mut solution);
            return solution;
        }
        let coarser = self.levels[at + 1].counts;
        let mut vector = vec![0.0; right.len()];
        for _ in 0..SWEEPS {
            for node in 0..right.len() {
                level.relax(node, right, &mut vector);
            }
        }
        let left: Vec<f64> = (0..right.len())
            .map(|node| right[node] - level.times(node, &vector))
            .collect();
        let correction = self.cycled(at + 1, &restricted(&left, level.counts, coarser));
        let correction = prolonged(&correction, coarser, level.counts);
        for (own, more) in vector.iter_mut().zip(correction) {
            *own += more;
        }
        for _ in 0..SWEEPS {
            for node in (0..right.len()).rev() {
                level.relax(node, right, &mut vector);
            }
        }
        vector
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// The coefficients of a spline on a lattice of halved cells: along each axis that has more of them there.
fn prolonged(values: &[f64], from: [usize; 2], to: [usize; 2]) -> Vec<f64> {
    let mut values = values.to_vec();
    let mut counts = from;
    for axis in 0..2 {
        if counts[axis] != to[axis] {
            let mut finer = counts;
            finer[axis] = to[axis];
            let mut refined = vec![0.0; finer[0] * finer[1]];
            along(axis, counts, finer, |coarse, fine, weight| {
                refined[fine] += weight * values[coarse];
            });
            (values, counts) = (refined, finer);
        }
    }
    values
}

/// The transpose of that.
fn restricted(values: &[f64], from: [usize; 2], to: [usize; 2]) -> Vec<f64> {
    let mut values = values.to_vec();
    let mut counts = from;
    for axis in [1, 0] {
        if counts[axis] != to[axis] {
            let mut coarser = counts;
            coarser[axis] = to[axis];
            let mut summed = vec![0.0; coarser[0] * coarser[1]];
            along(axis, coarser, counts, |coarse, fine, weight| {
                summed[coarse] += weight * values[fine];
            });
            (values, counts) = (summed, coarser);
        }
    }
    values
}

/// Which coefficients count for those of halved cells along an axis, and how much: 1/8, 6/8, 1/8 at a node and 1/2, 1/2 between two; at
/// natural ends that is the node's own.
fn along(
    axis: usize,
    coarse: [usize; 2],
    fine: [usize; 2],
    mut pair: impl FnMut(usize, usize, f64),
) {
    let last = coarse[axis] - 1;
    let (rows, own) = (fine[1], coarse[1]);
    for i in 0..fine[0] {
        for j in 0..fine[1] {
            let to = i * rows + j;
            let at = |node: usize| {
                if axis == 0 {
                    node * own + j
                } else {
                    i * own + node
                }
            };
            let node = [i, j][axis];
            let half = node / 2;
            if node % 2 == 1 {
                pair(at(half), to, 0.5);
                pair(at(half + 1), to, 0.5);
            } else if half == 0 || half == last {
                pair(at(half), to, 1.0);
            } else {
                pair(at(half - 1), to, 0.125);
                pair(at(half), to, 0.75);
                pair(at(half + 1), to, 0.125);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    const LOW: DVec2 = DVec2::new(10.0, -5.0);
    const HIGH: DVec2 = DVec2::new(26.0, 7.0);

    /// Heights at places that follow no grid.
    fn scattered(count: u32, height: impl Fn(DVec2) -> f64) -> Vec<DVec3> {
        let places = (0..count).map(|k| {
            let part = DVec2::new(
                (f64::from(k) * 0.618_033_988_75).fract(),
                (f64::from(k) * 0.754_877_666_25).fract(),
            );
            LOW + (HIGH - LOW) * part
        });
        places.map(|at| at.extend(height(at))).collect()
    }

    #[test]
    fn a_spline_on_a_lattice_is_one_on_halved_cells() {
        let wave = |k: i32| (f64::from(k) * 1.3).sin();
        let coarse: Vec<f64> = (0..20).map(wave).collect();
        let one = Lattice::of_coefficients(LOW, HIGH, [5, 4], coarse.clone()).unwrap();
        for counts in [[9, 7], [9, 4], [5, 7]] {
            let fine = prolonged(&coarse, [5, 4], counts);
            let other = Lattice::of_coefficients(LOW, HIGH, counts, fine).unwrap();
            for point in scattered(40, |_| 0.0) {
                let at = 1.2 * point.truncate();
                assert!((one.value(at) - other.value(at)).abs() < 1e-12, "{at}");
            }
        }
    }

    #[test]
    fn many_coefficients_are_those_of_the_direct_solution() {
        // `Lattice::fitted` factors the equations; its smoothness is for a density of 1.
        let points = scattered(900, |at| (0.5 * at.x).sin() * (0.3 * at.y).cos());
        let (counts, smoothness) = ([33, 25], 1e-3);
        let exact = Lattice::fitted(LOW, HIGH, counts, &points, smoothness).unwrap();
        let mut data = Approximation::new(LOW, HIGH, &points).unwrap();
        let frame = Lattice::of_coefficients(LOW, HIGH, counts, vec![0.0; 825]).unwrap();
        let density = 900.0 / Sums::of(&frame, &points).cells as f64;
        let found = data
            .lattice([32, 24], smoothness / density, |_, _| false)
            .unwrap();
        for point in scattered(200, |_| 0.0) {
            let at = point.truncate();
            assert!((exact.value(at) - found.value(at)).abs() < 1e-6, "{at}");
        }
    }

    #[test]
    fn heights_are_known_better_than_it_is_said_while_a_lattice_is_solved_for() {
        let points = scattered(4000, |at| (2.5 * at.x).sin() * (1.7 * at.y).cos());
        let mut data = Approximation::new(LOW, HIGH, &points).unwrap();
        let mut asked = Vec::new();
        let solution = data
            .lattice([64, 48], 1e-7, |so_far, known| {
                asked.push((so_far, known));
                false
            })
            .unwrap();
        assert!(asked.len() >= 3, "asked {} times", asked.len());
        for (so_far, known) in &asked {
            let squares = points.iter().map(|p| {
                let at = p.truncate();
                (so_far.value(at) - solution.value(at)).powi(2)
            });
            let rms = (squares.sum::<f64>() / points.len() as f64).sqrt();
            assert!(rms < *known, "{rms} is not below {known}");
        }
        assert!(
            asked[2].1 < 0.2 * asked[0].1,
            "{} {}",
            asked[0].1,
            asked[2].1
        );
        let first = data.lattice([64, 48], 1e-7, |_, _| true).unwrap();
        assert_eq!(first, asked[0].0);
    }

    #[test]
    fn a_plane_goes_on_as_a_plane_where_there_are_no_heights() {
        let plane = |at: DVec2| 3.0 + 0.2 * at.x - 0.1 * at.y;
        let mut points = scattered(400, plane);
        points.retain(|p| p.x < 14.0);
        let mut data = Approximation::new(LOW, HIGH, &points).unwrap();
        let lattice = data.lattice([64, 48], 1e-6, |_, _| false).unwrap();
        for at in [LOW, HIGH, DVec2::new(26.0, -5.0)] {
            let off = (lattice.value(at) - plane(at)).abs();
            // Three quarters of the plan have no heights; what rounding leaves undecided there is a thousandth of them.
            assert!(off < 0.02, "{at} {off}");
        }
    }
}
