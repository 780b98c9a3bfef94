//! Polynomials over a rectangle in Bernstein form: their coefficients bound them, and those of their derivatives.

use smallvec::SmallVec;

use super::patch::ORDER;

/// A polynomial of one variable over [0, 1].
pub(super) type Row = SmallVec<[f64; ORDER]>;

/// Halvings until a root is as exact as numbers are.
const HALVINGS: usize = 60;

/// A polynomial of x and y over a rectangle.
#[derive(Clone, Debug)]
pub(super) struct Scalar {
    /// One more than its degrees.
    orders: [usize; 2],
    /// x-major.
    coefficients: SmallVec<[f64; 16]>,
    /// The rectangle in x and in y.
    pub(super) range: [[f64; 2]; 2],
}

impl Scalar {
    pub(super) fn new(
        orders: [usize; 2],
        coefficients: impl IntoIterator<Item = f64>,
        range: [[f64; 2]; 2],
    ) -> Self {
        Self {
            orders,
            coefficients: coefficients.into_iter().collect(),
            range,
        }
    }

    /// The same polynomial over another rectangle.
    pub(super) fn over(&self, range: [[f64; 2]; 2]) -> Self {
        let mut part = self.clone();
        for (axis, wanted) in range.into_iter().enumerate() {
            if part.range[axis] == wanted {
                continue;
            }
            let [from, to] = part.range[axis];
            let [s, t] = wanted.map(|x| (x - from) / (to - from));
            part.each_line(axis, |line| restrict(line, s, t));
            part.range[axis] = wanted;
        }
        part
    }

    /// The same polynomial with a higher degree.
    fn elevated(mut self, orders: [usize; 2]) -> Self {
        for (axis, order) in orders.into_iter().enumerate() {
            while self.orders[axis] < order {
                let lines: Vec<Row> = (0..self.orders[1 - axis])
                    .map(|at| elevate(&self.line(axis, at)))
                    .collect();
                self.orders[axis] += 1;
                self.coefficients
                    .resize(self.orders[0] * self.orders[1], 0.0);
                for (at, line) in lines.iter().enumerate() {
                    self.set_line(axis, at, line);
                }
            }
        }
        self
    }

    /// The difference of two polynomials over one rectangle.
    pub(super) fn minus(self, other: Self) -> Self {
        let orders = std::array::from_fn(|axis| self.orders[axis].max(other.orders[axis]));
        let (mut own, other) = (self.elevated(orders), other.elevated(orders));
        for (a, b) in own.coefficients.iter_mut().zip(&other.coefficients) {
            *a -= b;
        }
        own
    }

    /// The coefficients along an axis; `at` counts across it.
    fn line(&self, axis: usize, at: usize) -> Row {
        (0..self.orders[axis])
            .map(|k| self.coefficients[self.index(axis, at, k)])
            .collect()
    }

    fn set_line(&mut self, axis: usize, at: usize, line: &[f64]) {
        for (k, value) in line.iter().enumerate() {
            let index = self.index(axis, at, k);
            self.coefficients[index] = *value;
        }
    }

    fn index(&self, axis: usize, at: usize, k: usize) -> usize {
        if axis == 0 {
            k * self.orders[1] + at
        } else {
            at * self.orders[1] + k
        }
    }

    fn each_line(&mut self, axis: usize, change: impl Fn(&mut Row)) {
        for at in 0..self.orders[1 - axis] {
            let mut line = self.line(axis, at);
            change(&mut line);
            self.set_line(axis, at, &line);
        }
    }

    /// Its two halves along an axis.
    pub(super) fn halves(&self, axis: usize) -> [Self; 2] {
        let [from, to] = self.range[axis];
        let middle = from.midpoint(to);
        let (mut low, mut high) = (self.clone(), self.clone());
        for at in 0..self.orders[1 - axis] {
            let [first, second] = halves(&self.line(axis, at));
            low.set_line(axis, at, &first);
            high.set_line(axis, at, &second);
        }
        low.range[axis] = [from, middle];
        high.range[axis] = [middle, to];
        [low, high]
    }

    /// Bounds of its values.
    pub(super) fn values(&self) -> [f64; 2] {
        bounds(self.coefficients.iter().copied())
    }

    /// Bounds of its derivative along an axis.
    pub(super) fn slopes(&self, axis: usize) -> [f64; 2] {
        let degree = self.orders[axis] - 1;
        if degree == 0 {
            return [0.0; 2];
        }
        let rate = degree as f64 / (self.range[axis][1] - self.range[axis][0]);
        let legs = (0..self.orders[1 - axis]).flat_map(|at| {
            (0..degree).map(move |k| {
                self.coefficients[self.index(axis, at, k + 1)]
                    - self.coefficients[self.index(axis, at, k)]
            })
        });
        bounds(legs).map(|leg| leg * rate)
    }

    /// It along a side: the polynomial of the other variable where the axis' variable is least or greatest.
    pub(super) fn side(&self, axis: usize, high: bool) -> Row {
        self.line(1 - axis, if high { self.orders[axis] - 1 } else { 0 })
    }
}

fn bounds(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
        [low.min(x), high.max(x)]
    })
}

/// De Casteljau at a parameter: the polynomial before it and after it.
fn cut(line: &[f64], s: f64) -> [Row; 2] {
    let (mut low, mut high) = (Row::from_slice(line), Row::from_slice(line));
    let degree = line.len() - 1;
    for round in 1..=degree {
        for k in 0..=degree - round {
            high[k] = (1.0 - s) * high[k] + s * high[k + 1];
        }
        low[round] = high[0];
    }
    [low, high]
}

fn halves(line: &[f64]) -> [Row; 2] {
    cut(line, 0.5)
}

/// The polynomial between two parameters. The cut far from the other end comes first: a parameter that is divided by what is
/// next to nothing is far outside.
fn restrict(line: &mut Row, s: f64, t: f64) {
    if t < 0.5 {
        let [_, after] = cut(line, s);
        let [before, _] = cut(&after, (t - s) / (1.0 - s));
        *line = before;
        return;
    }
    if t != 1.0 {
        let [before, _] = cut(line, t);
        *line = before;
    }
    if s != 0.0 {
        let [_, after] = cut(line, s / t);
        *line = after;
    }
}

fn elevate(line: &[f64]) -> Row {
    let order = line.len() as f64;
    (0..=line.len())
        .map(|k| {
            let share = k as f64 / order;
            let before = if k > 0 { line[k - 1] } else { 0.0 };
            let own = if k < line.len() { line[k] } else { 0.0 };
            share * before + (1.0 - share) * own
        })
        .collect()
}

fn value(line: &[f64], s: f64) -> f64 {
    let mut work = Row::from_slice(line);
    for round in 1..line.len() {
        for k in 0..line.len() - round {
            work[k] = (1.0 - s) * work[k] + s * work[k + 1];
        }
    }
    work[0]
}

/// Where a polynomial changes its sign in [0, 1], each once; 0 counts as positive, so that a root at an end that two ranges
/// share is found from one of them at least where the sign changes.
pub(super) fn sign_changes(line: &[f64]) -> SmallVec<[f64; 4]> {
    let mut found = SmallVec::new();
    isolate(line, [0.0, 1.0], HALVINGS, &mut found);
    found
}

fn isolate(line: &[f64], [from, to]: [f64; 2], left: usize, found: &mut SmallVec<[f64; 4]>) {
    let positive = |x: f64| x >= 0.0;
    let ends = [positive(line[0]), positive(line[line.len() - 1])];
    let changes = line
        .windows(2)
        .filter(|pair| positive(pair[0]) != positive(pair[1]))
        .count();
    if changes == 0 {
        return;
    }
    if changes == 1 {
        // Descartes: exactly one.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if positive(value(line, middle)) == ends[0] {
                low = middle;
            } else {
                high = middle;
            }
        }
        found.push(from + (to - from) * f64::midpoint(low, high));
        return;
    }
    if left == 0 {
        if ends[0] != ends[1] {
            found.push(from.midpoint(to));
        }
        return;
    }
    let middle = from.midpoint(to);
    let [low, high] = halves(line);
    isolate(&low, [from, middle], left - 1, found);
    isolate(&high, [middle, to], left - 1, found);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The polynomial `Σ a_ij x^i y^j` by its definition.
    fn sum(a: &[[f64; 4]; 3], x: f64, y: f64) -> f64 {
        let mut total = 0.0;
        for (i, row) in a.iter().enumerate() {
            for (j, c) in row.iter().enumerate() {
                total += c
                    * x.powi(i32::try_from(i).unwrap_or(0))
                    * y.powi(i32::try_from(j).unwrap_or(0));
            }
        }
        total
    }

    /// Its Bernstein form over the unit square: `b_k = Σ_i C(k, i) / C(n, i) a_i` along each axis.
    fn bernstein(a: &[[f64; 4]; 3]) -> Scalar {
        let choose =
            |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
        let mut coefficients = Vec::new();
        for k in 0..3 {
            for l in 0..4 {
                let mut c = 0.0;
                for (i, row) in a.iter().enumerate().take(k + 1) {
                    for (j, own) in row.iter().enumerate().take(l + 1) {
                        c += choose(k, i) / choose(2, i) * choose(l, j) / choose(3, j) * own;
                    }
                }
                coefficients.push(c);
            }
        }
        Scalar::new([3, 4], coefficients, [[0.0, 1.0]; 2])
    }

    const A: [[f64; 4]; 3] = [
        [0.3, -1.0, 0.5, 2.0],
        [1.5, 0.25, -3.0, 0.75],
        [-2.0, 1.0, 0.5, -0.125],
    ];

    #[test]
    fn a_part_that_hardly_reaches_into_the_rectangle_has_the_values_of_the_whole() {
        let whole = Scalar::new([4, 1], [1.0, -2.0, 3.0, 0.5], [[0.0, 15_000.0], [0.0, 1.0]]);
        let near = |x: f64| value(&whole.line(0, 0), x / 15_000.0);
        for range in [
            [-0.03, 6e-12],
            [-6e-12, 0.03],
            [-0.03, 0.0],
            [-1e-13, -1e-13],
            [-40.0, -30.0],
        ] {
            let part = whole.over([range, [0.0, 1.0]]);
            let line = part.line(0, 0);
            for (x, found) in [(range[0], line[0]), (range[1], line[3])] {
                assert!((found - near(x)).abs() < 1e-13, "{range:?}: {found}");
            }
            let [low, high] = part.values();
            let slack = 1e-13 + 2e-3 * (range[1] - range[0]);
            assert!(low > near(range[0]) - slack && high < near(range[0]) + slack);
        }
    }

    #[test]
    fn parts_halves_and_differences_have_the_values_of_the_polynomial_at_their_corners() {
        let whole = bernstein(&A);
        let part = whole.over([[0.2, 0.9], [-0.5, 0.4]]);
        let [low, high] = part.halves(0);
        for (own, x) in [(&low, [0.2, 0.55]), (&high, [0.55, 0.9])] {
            for (i, x) in x.into_iter().enumerate() {
                for (j, y) in [-0.5, 0.4].into_iter().enumerate() {
                    let corner = own.side(0, i == 1)[3 * j];
                    assert!((corner - sum(&A, x, y)).abs() < 1e-13);
                }
            }
        }
        let level = Scalar::new([1, 1], [0.7], [[0.0, 1.0]; 2]);
        let raised = level.minus(whole);
        for (x, y) in [(0.0, 0.0), (1.0, 1.0)] {
            let corner = raised.side(0, x == 1.0)[if y == 1.0 { 3 } else { 0 }];
            assert!((corner - (0.7 - sum(&A, x, y))).abs() < 1e-13);
        }
    }

    #[test]
    fn bounds_hold_all_values_and_slopes() {
        let own = bernstein(&A).over([[0.1, 0.6], [0.3, 0.8]]);
        let (values, slopes) = (own.values(), [own.slopes(0), own.slopes(1)]);
        let h = 1e-6;
        for i in 0..=20 {
            for j in 0..=20 {
                let (x, y) = (0.1 + 0.025 * f64::from(i), 0.3 + 0.025 * f64::from(j));
                let z = sum(&A, x, y);
                assert!(values[0] <= z + 1e-12 && z <= values[1] + 1e-12);
                let dx = (sum(&A, x + h, y) - sum(&A, x - h, y)) / (2.0 * h);
                let dy = (sum(&A, x, y + h) - sum(&A, x, y - h)) / (2.0 * h);
                for (slope, [low, high]) in [dx, dy].into_iter().zip(slopes) {
                    assert!(low - 1e-8 <= slope && slope <= high + 1e-8);
                }
            }
        }
    }

    #[test]
    fn every_change_of_sign_is_found_once() {
        // (s − 0.1)(s − 0.4)(s − 0.4000001) by its values' Bernstein form.
        let [a, b, c] = [0.1, 0.4, 0.400_000_1];
        let powers = [-a * b * c, a * b + a * c + b * c, -(a + b + c), 1.0];
        let line = [
            powers[0],
            powers[0] + powers[1] / 3.0,
            powers[0] + 2.0 * powers[1] / 3.0 + powers[2] / 3.0,
            powers.iter().sum(),
        ];
        let roots = sign_changes(&line);
        assert_eq!(roots.len(), 3);
        for (root, exact) in roots.iter().zip([a, b, c]) {
            assert!((root - exact).abs() < 1e-8, "{root}");
        }
        // A root at a common end belongs to the range where the sign changes.
        assert_eq!(
            sign_changes(&[0.0, 1.0]).len() + sign_changes(&[-1.0, 0.0]).len(),
            1
        );
        // A touch changes no sign.
        assert!(sign_changes(&[1.0, -1.0, 1.0]).len() < 2);
    }
}
