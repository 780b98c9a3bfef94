//! Volumes of the units between horizons, by an integral over the plan that knows nothing of the program's surfaces,
//! curves and solids: heights are tensor products of natural cubic splines through the grid's nodes, by their second
//! derivatives as in textbooks (Press et al., *Numerical Recipes*, §3.3 and §3.6); who owns what above a place is told from
//! the sorted heights and the rules as docs/model-file.md words them.

use std::collections::BTreeMap;

use toml::{Table, Value};

use crate::models::number;

/// Nodes and weights of Gauss's rule with three points on [0, 1]: exact for what is bicubic.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 4.0 / 9.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];
/// Cells along each side of the plan to begin with, and how often those in which the order of horizons changes are halved.
/// Caps and islands smaller than a cell are missed, and then show in the error: they are found or not with half as many cells.
const CELLS: usize = 640;
const HALVINGS: u32 = 3;

/// What the integral found.
#[derive(serde::Serialize)]
pub(crate) struct Volumes {
    /// By the volumes' names (m³).
    pub(crate) volumes: BTreeMap<String, f64>,
    /// How far halving all cells changed any of them (m³): more than what they are off.
    pub(crate) error: f64,
}

/// The volumes of a model whose features are horizons through grids, levels or planes.
pub(crate) fn volumes(model: &Table) -> Result<Volumes, String> {
    let column = Column::new(model)?;
    let coarse = column.integral(CELLS / 2);
    let fine = column.integral(CELLS);
    let error = coarse
        .iter()
        .zip(&fine)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    Ok(Volumes {
        volumes: column.names.iter().cloned().zip(fine).collect(),
        error,
    })
}

/// A vertical line through the block.
struct Column {
    x: [f64; 2],
    y: [f64; 2],
    z: [f64; 2],
    /// The background's, then the horizons' from oldest to youngest.
    names: Vec<String>,
    heights: Vec<Height>,
    onlapping: Vec<bool>,
}

impl Column {
    fn new(model: &Table) -> Result<Self, String> {
        let domain = model
            .get("domain")
            .and_then(Value::as_table)
            .ok_or("no domain")?;
        if domain.contains_key("base") || domain.contains_key("top") {
            return Err("a domain with a base or top of its own is not integrated".to_owned());
        }
        let features = model
            .get("feature")
            .and_then(Value::as_array)
            .map_or(&[][..], Vec::as_slice);
        let mut column = Self {
            x: pair(domain.get("x"))?,
            y: pair(domain.get("y"))?,
            z: pair(domain.get("z"))?,
            names: vec!["background".to_owned()],
            heights: Vec::new(),
            onlapping: Vec::new(),
        };
        for feature in features {
            if feature.get("kind").and_then(Value::as_str) != Some("horizon") {
                return Err("only horizons are integrated".to_owned());
            }
            if feature.get("enabled").and_then(Value::as_bool) == Some(false) {
                continue;
            }
            let id = feature
                .get("id")
                .and_then(Value::as_str)
                .ok_or("a horizon has no id")?;
            let relation = feature.get("relation").and_then(Value::as_str);
            let surface = feature.get("surface").ok_or("no surface")?;
            let height = if let Some(below) = surface.get("above").and_then(Value::as_str) {
                let below = column.names.iter().position(|name| name == below);
                // The names begin with the background's.
                let below = below.ok_or("a bed above no older horizon")? - 1;
                Height::bed(below, surface.get("thickness").ok_or("no thickness")?)?
            } else {
                Height::new(surface)?
            };
            column.names.push(id.to_owned());
            column.onlapping.push(relation == Some("onlapping"));
            column.heights.push(height);
        }
        Ok(column)
    }

    /// How thick each volume is above a place, and the order of the horizons there.
    fn thickness(&self, x: f64, y: f64) -> (Vec<f64>, Vec<usize>) {
        let mut heights: Vec<f64> = Vec::with_capacity(self.heights.len());
        for height in &self.heights {
            heights.push(height.at(x, y, &heights));
        }
        let mut order: Vec<usize> = (0..heights.len()).collect();
        order.sort_by(|a, b| heights[*a].total_cmp(&heights[*b]).then(a.cmp(b)));
        let mut levels = vec![self.z[0]];
        levels.extend(
            order
                .iter()
                .map(|at| heights[*at].clamp(self.z[0], self.z[1])),
        );
        levels.push(self.z[1]);
        let mut found = vec![0.0; self.names.len()];
        let mut is_above = vec![false; heights.len()];
        for (at, pair) in levels.windows(2).enumerate() {
            found[self.owner(&is_above)] += pair[1] - pair[0];
            if let Some(passed) = order.get(at) {
                is_above[*passed] = true;
            }
        }
        // Where a horizon is below the base or above the top its place among the others is of no account.
        let sides = heights
            .iter()
            .map(|z| usize::from(*z > self.z[0]) + usize::from(*z > self.z[1]));
        let signature = order.iter().copied().chain(sides).collect();
        (found, signature)
    }

    /// Erosive units take everything above their horizon; onlapping ones what the unit before them holds.
    fn owner(&self, is_above: &[bool]) -> usize {
        let mut owner = 0;
        for (at, above) in is_above.iter().enumerate() {
            if *above && (!self.onlapping[at] || owner == at) {
                owner = at + 1;
            }
        }
        owner
    }

    fn integral(&self, cells: usize) -> Vec<f64> {
        let step = |[low, high]: [f64; 2]| (high - low) / cells as f64;
        let size = [step(self.x), step(self.y)];
        let mut sums = vec![0.0; self.names.len()];
        for i in 0..cells {
            for j in 0..cells {
                let low = [
                    self.x[0] + size[0] * i as f64,
                    self.y[0] + size[1] * j as f64,
                ];
                self.cell(low, size, HALVINGS, &mut sums);
            }
        }
        sums
    }

    fn cell(&self, low: [f64; 2], size: [f64; 2], halvings: u32, sums: &mut [f64]) {
        let at = |u: f64, v: f64| self.thickness(low[0] + u * size[0], low[1] + v * size[1]);
        let mut own = vec![0.0; sums.len()];
        let mut orders = Vec::new();
        for (u, a) in GAUSS {
            for (v, b) in GAUSS {
                let (thickness, order) = at(u, v);
                for (sum, part) in own.iter_mut().zip(thickness) {
                    *sum += a * b * size[0] * size[1] * part;
                }
                orders.push(order);
            }
        }
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        let changes = orders.iter().any(|order| *order != orders[0])
            || (halvings > 0 && corners.iter().any(|(u, v)| at(*u, *v).1 != orders[0]));
        if halvings == 0 || !changes {
            for (sum, part) in sums.iter_mut().zip(own) {
                *sum += part;
            }
            return;
        }
        let half = size.map(|side| 0.5 * side);
        for (u, v) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            self.cell(
                [low[0] + u * half[0], low[1] + v * half[1]],
                half,
                halvings - 1,
                sums,
            );
        }
    }
}

/// One horizon.
enum Height {
    Plane {
        rise: [f64; 2],
        at_origin: f64,
    },
    Spline(Spline),
    /// So much above an older one, from the oldest.
    Above(usize, Box<Self>),
}

impl Height {
    fn new(surface: &Value) -> Result<Self, String> {
        if let Some(level) = surface.get("level").and_then(number) {
            return Ok(Self::Plane {
                rise: [0.0; 2],
                at_origin: level,
            });
        }
        if let Some(plane) = surface.get("dipping") {
            let value = |key: &str| {
                plane
                    .get(key)
                    .and_then(number)
                    .ok_or("a plane of drawn numbers")
            };
            let (dip, azimuth) = (
                value("dip_deg")?.to_radians(),
                value("azimuth_deg")?.to_radians(),
            );
            let through = numbers(plane.get("through"))?;
            let rise = [-dip.tan() * azimuth.sin(), -dip.tan() * azimuth.cos()];
            let at_origin = through[2] - rise[0] * through[0] - rise[1] * through[1];
            return Ok(Self::Plane { rise, at_origin });
        }
        let grid = surface
            .get("grid")
            .ok_or("a surface that is no grid, level or plane")?;
        Ok(Self::Spline(Spline::new(grid)?))
    }

    /// A bed above an older horizon, with a thickness at all nodes: how others go on below nothing is the program's affair.
    fn bed(below: usize, thickness: &Value) -> Result<Self, String> {
        let thickness = if let Some(thickness) = number(thickness) {
            Self::Plane {
                rise: [0.0; 2],
                at_origin: thickness,
            }
        } else {
            let grid = thickness
                .get("grid")
                .ok_or("a thickness that is no grid or number")?;
            Self::Spline(Spline::new(grid)?)
        };
        let is_everywhere = match &thickness {
            Self::Spline(spline) => spline.tables[0].iter().all(|value| *value > 0.0),
            Self::Plane { at_origin, .. } => *at_origin > 0.0,
            Self::Above(..) => false,
        };
        if !is_everywhere {
            return Err("a bed that ends is not integrated".to_owned());
        }
        Ok(Self::Above(below, Box::new(thickness)))
    }

    /// Given those of all older ones.
    fn at(&self, x: f64, y: f64, older: &[f64]) -> f64 {
        match self {
            Self::Plane { rise, at_origin } => at_origin + rise[0] * x + rise[1] * y,
            Self::Spline(spline) => spline.at(x, y),
            Self::Above(below, thickness) => older[*below] + thickness.at(x, y, older),
        }
    }
}

/// A natural bicubic spline: heights at the nodes, and their second derivatives along x, along y, and along both.
struct Spline {
    low: [f64; 2],
    step: [f64; 2],
    counts: [usize; 2],
    /// Node i along x and j along y is entry `i * ny + j`.
    tables: [Vec<f64>; 4],
}

impl Spline {
    fn new(grid: &Value) -> Result<Self, String> {
        let (x, y) = (pair(grid.get("x"))?, pair(grid.get("y"))?);
        let rows = grid
            .get("heights")
            .and_then(Value::as_array)
            .ok_or("no heights")?;
        let rows: Vec<Vec<f64>> = rows
            .iter()
            .map(|row| numbers(Some(row)))
            .collect::<Result<_, _>>()?;
        let counts = [rows[0].len(), rows.len()];
        let step = [
            (x[1] - x[0]) / (counts[0] - 1) as f64,
            (y[1] - y[0]) / (counts[1] - 1) as f64,
        ];
        let heights: Vec<f64> = (0..counts[0])
            .flat_map(|i| rows.iter().map(move |row| row[i]))
            .collect();
        let along_x = bent_along_x(&heights, counts, step[0]);
        let along_y = bent_along_y(&heights, counts, step[1]);
        let along_both = bent_along_x(&along_y, counts, step[0]);
        Ok(Self {
            low: [x[0], y[0]],
            step,
            counts,
            tables: [heights, along_x, along_y, along_both],
        })
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the nodes there are"
    )]
    fn at(&self, x: f64, y: f64) -> f64 {
        let place = |axis: usize, at: f64| {
            let t = (at - self.low[axis]) / self.step[axis];
            let first = t.floor().clamp(0.0, self.counts[axis] as f64 - 2.0);
            let (b, a) = (t - first, 1.0 - (t - first));
            let sixth = self.step[axis].powi(2) / 6.0;
            let bent = [(a.powi(3) - a) * sixth, (b.powi(3) - b) * sixth];
            (first as usize, [a, b], bent)
        };
        let (i, straight_x, bent_x) = place(0, x);
        let (j, straight_y, bent_y) = place(1, y);
        let mut sum = 0.0;
        for (table, (along_x, along_y)) in self.tables.iter().zip([
            (straight_x, straight_y),
            (bent_x, straight_y),
            (straight_x, bent_y),
            (bent_x, bent_y),
        ]) {
            for (a, weight) in along_x.iter().enumerate() {
                for (b, other) in along_y.iter().enumerate() {
                    sum += weight * other * table[(i + a) * self.counts[1] + j + b];
                }
            }
        }
        sum
    }
}

/// Second derivatives at the nodes of a natural cubic spline, by the tridiagonal equations.
fn second_derivatives(values: &[f64], step: f64) -> Vec<f64> {
    let n = values.len();
    let mut found = vec![0.0; n];
    let mut upper = vec![0.0; n];
    for i in 1..n - 1 {
        let right = 6.0 * (values[i + 1] - 2.0 * values[i] + values[i - 1]) / (step * step);
        let pivot = 4.0 - upper[i - 1];
        upper[i] = 1.0 / pivot;
        found[i] = (right - found[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        found[i] -= upper[i] * found[i + 1];
    }
    found
}

fn bent_along_y(values: &[f64], [_, ny]: [usize; 2], step: f64) -> Vec<f64> {
    values
        .chunks(ny)
        .flat_map(|row| second_derivatives(row, step))
        .collect()
}

fn bent_along_x(values: &[f64], [nx, ny]: [usize; 2], step: f64) -> Vec<f64> {
    let mut found = vec![0.0; values.len()];
    for j in 0..ny {
        let column: Vec<f64> = (0..nx).map(|i| values[i * ny + j]).collect();
        for (i, bend) in second_derivatives(&column, step).into_iter().enumerate() {
            found[i * ny + j] = bend;
        }
    }
    found
}

fn numbers(value: Option<&Value>) -> Result<Vec<f64>, String> {
    let list = value
        .and_then(Value::as_array)
        .ok_or("a list of numbers is missing")?;
    let found: Option<Vec<f64>> = list.iter().map(number).collect();
    found.ok_or_else(|| "a list holds something that is no number".to_owned())
}

fn pair(value: Option<&Value>) -> Result<[f64; 2], String> {
    let found = numbers(value)?;
    <[f64; 2]>::try_from(found).map_err(|_| "a range is no pair of numbers".to_owned())
}
