//! Horizons given as grids, interpolated here by natural cubic splines in x and y, and integrated over the plan.

/// A natural bicubic spline through heights at evenly spaced nodes.
pub(crate) struct Grid {
    x: [f64; 2],
    y: [f64; 2],
    /// Rows from south to north.
    heights: Vec<Vec<f64>>,
}

fn pair(value: &toml::Value) -> [f64; 2] {
    let both: Vec<f64> = value.as_array().unwrap().iter().map(number).collect();
    [both[0], both[1]]
}

fn number(value: &toml::Value) -> f64 {
    let float = value.as_float();
    float.unwrap_or_else(|| value.as_integer().unwrap() as f64)
}

/// Second derivatives of the natural cubic spline at nodes one apart.
fn second_derivatives(values: &[f64]) -> Vec<f64> {
    let count = values.len();
    let (mut upper, mut right) = (vec![0.0; count], vec![0.0; count]);
    for i in 1..count - 1 {
        let pivot = 4.0 - upper[i - 1];
        upper[i] = 1.0 / pivot;
        let bend = 6.0 * (values[i - 1] - 2.0 * values[i] + values[i + 1]);
        right[i] = (bend - right[i - 1]) / pivot;
    }
    for i in (1..count - 1).rev() {
        right[i] -= upper[i] * right[i + 1];
    }
    right[count - 1] = 0.0;
    right
}

/// The natural cubic spline at t nodes from the first.
pub(crate) fn at(values: &[f64], t: f64) -> f64 {
    let bends = second_derivatives(values);
    let before = |i: &usize| *i as f64 <= t;
    let i = (0..values.len() - 1).rev().find(before).unwrap_or(0);
    let (b, a) = (t - i as f64, i as f64 + 1.0 - t);
    a * values[i]
        + b * values[i + 1]
        + ((a * a * a - a) * bends[i] + (b * b * b - b) * bends[i + 1]) / 6.0
}

impl Grid {
    /// From a table such as `{ grid = { x, y, heights } }`.
    pub(crate) fn of(surface: &toml::Value) -> Self {
        let grid = &surface["grid"];
        let rows = grid["heights"].as_array().unwrap().iter();
        let heights = rows
            .map(|row| row.as_array().unwrap().iter().map(number).collect())
            .collect();
        Self {
            x: pair(&grid["x"]),
            y: pair(&grid["y"]),
            heights,
        }
    }

    /// Heights at `fine` × `fine` places evenly spread (cell by cell, in their middles) in every cell of the grid.
    fn refined(&self, fine: usize) -> Vec<f64> {
        let places = |cells: usize| (0..cells * fine).map(move |k| (k as f64 + 0.5) / fine as f64);
        let (columns, rows) = (self.heights[0].len() - 1, self.heights.len() - 1);
        let along: Vec<Vec<f64>> = self
            .heights
            .iter()
            .map(|row| places(columns).map(|t| at(row, t)).collect())
            .collect();
        let mut found = Vec::new();
        for i in 0..columns * fine {
            let column: Vec<f64> = along.iter().map(|row| row[i]).collect();
            found.extend(places(rows).map(|t| at(&column, t)));
        }
        found
    }
}

/// ∬ f(heights) over the plan of grids on the same nodes (m³), by midpoints; smooth f: two refinements and Richardson.
pub(crate) fn integral(grids: &[&Grid], f: impl Fn(&[f64]) -> f64) -> f64 {
    let (x, y) = (grids[0].x, grids[0].y);
    let plan = (x[1] - x[0]) * (y[1] - y[0]);
    let mean = |fine: usize| -> f64 {
        let all: Vec<Vec<f64>> = grids.iter().map(|grid| grid.refined(fine)).collect();
        let count = all[0].len();
        let at = |k: usize| f(&all.iter().map(|one| one[k]).collect::<Vec<_>>());
        (0..count).map(at).sum::<f64>() / count as f64
    };
    let (coarse, fine) = (mean(8), mean(16));
    plan * (fine + (fine - coarse) / 3.0)
}

#[test]
fn a_natural_spline_passes_through_its_nodes_and_bends_nowhere_at_its_ends() {
    let values = [3.0, -1.0, 4.0, 1.0, -5.0];
    for (i, value) in values.iter().enumerate() {
        assert!((at(&values, i as f64) - value).abs() < 1e-13);
    }
    let h = 1e-4;
    let bend = at(&values, 0.0) - 2.0 * at(&values, h) + at(&values, 2.0 * h);
    assert!((bend / h / h).abs() < 1e-2, "{bend}");
    // Through 0, 1, 0 it is (3t − t³)/2 on the way up: 5/8 on the average.
    let mean: f64 = (0..1000)
        .map(|k| at(&[0.0, 1.0, 0.0], (f64::from(k) + 0.5) / 500.0))
        .sum();
    assert!((mean / 1000.0 - 0.625).abs() < 1e-6, "{mean}");
}
