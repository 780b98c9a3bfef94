//! Horizons as well tops give them: picked in some wells, interpolated to a grid, little between them.

use toml::{Table, Value};

use super::draws::{Draws, rounded};
use super::strata::{Field, grid};
use super::tables::{Block, FACIES, feature, model as whole, set};

/// How heights come from wells to a grid.
#[derive(Clone, Copy)]
enum Method {
    /// Weights are inverse to the square of the distance.
    Distance,
    /// The surface that bends least through all of them.
    ThinPlate,
}

pub(super) fn model(draws: &mut Draws) -> Table {
    let side = draws.pick(&[10_000.0, 300_000.0]);
    let contrast = draws.magnitude(0.3, 30.0);
    let relief = side * draws.magnitude(0.0005, 0.01);
    let mut block = Block {
        x: [0.0, side],
        y: [0.0, rounded(side * draws.within(0.6, 1.0), 3)],
        z: [0.0, 0.0],
    };
    let wells: Vec<[f64; 2]> = (0..draws.count(20, 60))
        .map(|_| block.at(draws.within(0.0, 1.0), draws.within(0.0, 1.0)))
        .collect();
    let trend = Field::new(draws, &block);
    let count = draws.count(2, 6);
    let beyond = draws.pick(&[0.0, 0.02]);
    let nodes = [draws.count(8, 40), draws.count(8, 40)];
    let method = draws.pick(&[Method::Distance, Method::ThinPlate]);
    let mut depth: Vec<f64> = wells
        .iter()
        .map(|[x, y]| -1000.0 + relief * trend.at(*x, *y))
        .collect();
    let mut features = Vec::new();
    let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
    for at in 0..count {
        if at > 0 {
            // Beds thin out, and picks disagree: some are older than what lies below them.
            let bed = contrast * draws.within(0.0, 1.2);
            for pick in &mut depth {
                *pick += bed + contrast * draws.within(-1.0, 1.0);
            }
        }
        let picks: Vec<[f64; 3]> = wells
            .iter()
            .zip(&depth)
            .map(|([x, y], z)| [*x, *y, rounded(*z, 7)])
            .collect();
        let height = interpolated(&picks, method);
        let own = if draws.chance(0.2) {
            [draws.count(8, 40), draws.count(8, 40)]
        } else {
            nodes
        };
        let surface = grid(&block, own, beyond, height);
        for z in heights(&surface) {
            lowest = z.min(lowest);
            highest = z.max(highest);
        }
        let mut horizon = feature(&format!("h{at}"), "horizon", FACIES[at % FACIES.len()]);
        set(&mut horizon, "surface", surface);
        if draws.chance(0.15) {
            set(&mut horizon, "relation", "onlapping");
        }
        features.push(horizon);
    }
    let margin = 0.3 * (highest - lowest) + 2.0 * contrast;
    block.z = [(lowest - margin).floor(), (highest + margin).ceil()];
    if draws.chance(0.15) {
        // The block's top cuts some of them.
        block.z[1] = rounded(highest - 0.2 * (highest - lowest), 7);
    }
    whole(block.table("mud"), features)
}

/// The heights of a grid.
fn heights(surface: &Table) -> Vec<f64> {
    let rows = surface.get("grid").and_then(|grid| grid.get("heights"));
    rows.and_then(Value::as_array)
        .into_iter()
        .flatten()
        .filter_map(Value::as_array)
        .flatten()
        .filter_map(Value::as_float)
        .collect()
}

fn interpolated(picks: &[[f64; 3]], method: Method) -> Box<dyn Fn(f64, f64) -> f64 + '_> {
    match method {
        Method::Distance => Box::new(move |x, y| {
            let (mut sum, mut all) = (0.0, 0.0);
            for [a, b, z] in picks {
                let square = (x - a).powi(2) + (y - b).powi(2);
                if square == 0.0 {
                    return *z;
                }
                sum += z / square;
                all += 1.0 / square;
            }
            sum / all
        }),
        Method::ThinPlate => {
            let plate = ThinPlate::new(picks);
            Box::new(move |x, y| plate.at(x, y))
        }
    }
}

/// `z = a + b x + c y + Σ wᵢ r² ln r` (Duchon 1977), in units of the greatest coordinate.
struct ThinPlate {
    nodes: Vec<[f64; 2]>,
    unit: f64,
    weights: Vec<f64>,
}

impl ThinPlate {
    fn new(picks: &[[f64; 3]]) -> Self {
        let unit = picks
            .iter()
            .flat_map(|[x, y, _]| [x.abs(), y.abs()])
            .fold(1.0, f64::max);
        let nodes: Vec<[f64; 2]> = picks.iter().map(|[x, y, _]| [x / unit, y / unit]).collect();
        let n = nodes.len();
        let mut rows = vec![vec![0.0; n + 4]; n + 3];
        for i in 0..n {
            for j in 0..n {
                rows[i][j] = Self::kernel(nodes[i], nodes[j]);
            }
            for (k, term) in [1.0, nodes[i][0], nodes[i][1]].into_iter().enumerate() {
                rows[i][n + k] = term;
                rows[n + k][i] = term;
            }
            rows[i][n + 3] = picks[i][2];
        }
        Self {
            weights: solve(rows),
            nodes,
            unit,
        }
    }

    fn kernel([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
        let square = (a - c).powi(2) + (b - d).powi(2);
        if square == 0.0 {
            0.0
        } else {
            0.5 * square * square.ln()
        }
    }

    fn at(&self, x: f64, y: f64) -> f64 {
        let (at, n) = ([x / self.unit, y / self.unit], self.nodes.len());
        let plane = self.weights[n] + self.weights[n + 1] * at[0] + self.weights[n + 2] * at[1];
        let pairs = self.nodes.iter().zip(&self.weights);
        plane
            + pairs
                .map(|(node, w)| w * Self::kernel(at, *node))
                .sum::<f64>()
    }
}

/// Gauss's elimination with partial pivoting; each row ends with its right side.
fn solve(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for column in 0..n {
        let best = (column..n)
            .max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))
            .unwrap_or(column);
        rows.swap(column, best);
        let pivot = rows[column].clone();
        for row in rows.iter_mut().skip(column + 1) {
            let factor = row[column] / pivot[column];
            for (own, other) in row.iter_mut().zip(&pivot).skip(column) {
                *own -= factor * other;
            }
        }
    }
    let mut solution = vec![0.0; n];
    for at in (0..n).rev() {
        let known: f64 = (at + 1..n).map(|k| rows[at][k] * solution[k]).sum();
        solution[at] = (rows[at][n] - known) / rows[at][at];
    }
    solution
}
