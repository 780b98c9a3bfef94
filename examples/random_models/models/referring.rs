//! Features that refer to others: tributaries, courses beside others, mouth bars, what conforms to a surface; sections of their own, and sections
//! that follow the bends; layers of units, and horizons from control nets. Nothing is equal by design.
#![allow(clippy::cast_possible_wrap, reason = "counts are small")]

use toml::{Table, Value};

use super::draws::{Draws, rounded};
use super::generic::block;
use super::tables::{Block, FACIES, feature, model as whole, set, table};

/// A model about one river, on a floor that bodies may conform to.
pub(super) fn model(draws: &mut Draws) -> Table {
    let block = block(draws);
    let mut features = vec![floor(draws, &block)];
    if draws.chance(0.4) {
        let mut layers = feature("layers", "trend", facies(draws));
        set(&mut layers, "parent", "floor");
        let steps = draws.count(1, 3);
        set(&mut layers, "steps", steps as i64);
        let way = draws.pick(&["proportional", "base", "top"]);
        set(&mut layers, "between", way);
        if way != "proportional" {
            let apart = block.size()[2] * draws.within(0.03, 0.1);
            set(&mut layers, "spacing", rounded(apart, 5));
        }
        features.push(layers);
    }
    let river = River::drawn(draws, &block);
    features.push(river.feature(draws));
    for number in 0..draws.count(1, 3) {
        let one = match draws.count(0, 6) {
            0 => river.tributary(draws, &block, number),
            1 => river.beside(draws, number),
            2 => river.mouth_bar(draws, number),
            3 => scour_along(draws, &block, number),
            4 => eroding_lobes(draws, &block, number),
            _ => conforming(draws, &block, number),
        };
        // What refers to the river stands before it or after it.
        let place = if draws.chance(0.3) { 1 } else { features.len() };
        let is_younger = one.contains_key("conform") || one.contains_key("parent");
        let place = if is_younger { features.len() } else { place };
        features.insert(place, one);
    }
    whole(block.table("mud"), features)
}

fn facies(draws: &mut Draws) -> &'static str {
    draws.pick(&FACIES[1..])
}

fn numbers(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| rounded(*value, 7)).collect()
}

fn place(draws: &mut Draws, block: &Block) -> Vec<f64> {
    let [x, y] = block.at(draws.within(0.1, 0.9), draws.within(0.1, 0.9));
    numbers(&[x, y])
}

/// A gentle horizon from a control net, with weights or knots of its own, or none.
fn floor(draws: &mut Draws, block: &Block) -> Table {
    let mut floor = feature("floor", "horizon", facies(draws));
    let mean = draws.within(0.2, 0.4);
    let relief = draws.within(0.005, 0.06);
    let rows: Vec<Value> = (0..4)
        .map(|i| {
            let row: Vec<Value> = (0..4)
                .map(|j| {
                    let [x, y] = block.at(f64::from(i) / 2.0 - 0.25, f64::from(j) / 2.0 - 0.25);
                    let z = block.elevation(mean + relief * draws.within(-1.0, 1.0));
                    Value::from(numbers(&[x, y, z]))
                })
                .collect();
            row.into()
        })
        .collect();
    let mut net = table([("degree", 3.into()), ("points", rows.into())]);
    if draws.chance(0.4) {
        let weights: Vec<Value> = (0..4)
            .map(|_| {
                let row: Vec<f64> = (0..4).map(|_| draws.within(0.8, 1.25)).collect();
                row.into()
            })
            .collect();
        set(&mut net, "weights", weights);
    }
    let tolerance = rounded(0.002 * block.size()[2], 2);
    let surface = table([("net", net.into()), ("tolerance", tolerance.into())]);
    set(&mut floor, "surface", surface);
    floor
}

/// A channel that others refer to.
struct River {
    width: f64,
    depth: f64,
    top: f64,
    way: Table,
}

impl River {
    fn drawn(draws: &mut Draws, block: &Block) -> Self {
        let (narrow, height) = (block.narrow(), block.size()[2]);
        let wavelength = narrow * draws.within(0.5, 0.9);
        let width = rounded(wavelength * draws.magnitude(0.04, 0.09), 5);
        let depth = rounded((width * draws.magnitude(0.05, 0.2)).min(0.2 * height), 5);
        let top = rounded(block.elevation(draws.within(0.6, 0.95)), 6);
        let [x, y] = block.at(draws.within(0.4, 0.6), draws.within(0.4, 0.6));
        let mut way = table([
            ("kind", "sine-generated".into()),
            (
                "amplitude",
                rounded(wavelength * draws.within(0.06, 0.16), 5).into(),
            ),
            ("wavelength", rounded(wavelength, 5).into()),
            ("azimuth_deg", draws.within(1.0, 179.0).into()),
            ("center", numbers(&[x, y]).into()),
            ("phase", draws.within(0.0, 1.0).into()),
        ]);
        if draws.chance(0.5) {
            // It ends within the block.
            let length = narrow * draws.within(0.5, 0.8);
            set(&mut way, "length", rounded(length, 5));
        }
        Self {
            width,
            depth,
            top,
            way,
        }
    }

    fn feature(&self, draws: &mut Draws) -> Table {
        let mut river = feature("river", "channel", facies(draws));
        set(&mut river, "width", self.width);
        set(&mut river, "depth", self.depth);
        set(&mut river, "top", self.top);
        set(&mut river, "trajectory", self.way.clone());
        match draws.count(0, 3) {
            0 => {
                let by = table([("by_curvature", draws.within(0.05, 0.2).into())]);
                set(&mut river, "asymmetry", by);
            }
            1 => set(&mut river, "section", section(draws)),
            _ => {}
        }
        river
    }

    /// A channel that joins it.
    fn tributary(&self, draws: &mut Draws, block: &Block, number: usize) -> Table {
        let mut one = feature(&format!("tributary{number}"), "channel", facies(draws));
        set(&mut one, "along", "river");
        set(
            &mut one,
            "width",
            rounded(self.width * draws.within(0.3, 0.7), 5),
        );
        set(
            &mut one,
            "depth",
            rounded(self.depth * draws.within(0.3, 0.6), 5),
        );
        let joins = table([
            ("at", draws.within(0.3, 0.7).into()),
            ("angle_deg", draws.within(35.0, 85.0).into()),
            ("side", draws.pick(&["left", "right"]).into()),
        ]);
        set(&mut one, "joins", joins);
        let azimuth = draws.within(1.0, 359.0);
        let way = table([
            ("kind", "line".into()),
            ("azimuth_deg", azimuth.into()),
            ("length", rounded(0.4 * block.narrow(), 5).into()),
        ]);
        set(&mut one, "trajectory", way);
        one
    }

    /// A channel beside it, higher or lower.
    fn beside(&self, draws: &mut Draws, number: usize) -> Table {
        let mut one = feature(&format!("beside{number}"), "channel", facies(draws));
        let width = rounded(self.width * draws.within(0.5, 1.1), 5);
        set(&mut one, "width", width);
        set(
            &mut one,
            "depth",
            rounded(self.depth * draws.within(0.5, 1.1), 5),
        );
        let top = self.top + self.depth * draws.within(-1.3, 0.3);
        set(&mut one, "top", rounded(top, 6));
        let mut way = table([("like", "river".into())]);
        if draws.chance(0.8) {
            let offset = width * draws.within(-1.4, 1.4);
            set(&mut way, "offset", rounded(offset, 5));
        }
        set(&mut one, "trajectory", way);
        one
    }

    /// A lobe at its end.
    fn mouth_bar(&self, draws: &mut Draws, number: usize) -> Table {
        let mut one = feature(&format!("bar{number}"), "lobe", facies(draws));
        set(&mut one, "mouth_of", "river");
        if draws.chance(0.4) {
            let thickness = rounded(self.depth * draws.within(0.6, 1.6), 5);
            set(&mut one, "thickness", thickness);
        }
        if draws.chance(0.3) {
            let length = rounded(self.width * draws.within(3.0, 8.0), 5);
            set(&mut one, "length", length);
        }
        one
    }
}

/// A section drawn by hand: below its rims, of any degree.
fn section(draws: &mut Draws) -> Table {
    let inner = draws.within(0.1, 0.35);
    let (left, right) = (draws.within(-1.0, -0.5), draws.within(-1.0, -0.5));
    let points: Vec<Value> = [
        [-0.5, 0.0],
        [-inner, left],
        [draws.within(-0.05, 0.05), -1.0],
        [inner, right],
        [0.5, 0.0],
    ]
    .into_iter()
    .map(|p| p.to_vec().into())
    .collect();
    let mut section = table([
        ("degree", (draws.count(1, 3) as i64).into()),
        ("points", points.into()),
    ]);
    if draws.chance(0.3) {
        set(&mut section, "depth_is", "deepest");
    }
    if draws.chance(0.3) {
        let weights: Vec<f64> = (0..5).map(|_| draws.within(0.7, 1.4)).collect();
        set(&mut section, "weights", weights);
    }
    section
}

/// A scour along a bent way, or by its upstream end.
fn scour_along(draws: &mut Draws, block: &Block, number: usize) -> Table {
    let narrow = block.narrow();
    let mut one = feature(&format!("scour{number}"), "scour", facies(draws));
    let length = narrow * draws.within(0.25, 0.5);
    let width = length * draws.within(0.05, 0.12);
    set(
        &mut one,
        "width",
        numbers(&[width, width * draws.within(1.2, 3.0)]),
    );
    let depth = (width * draws.within(0.06, 0.2)).min(0.2 * block.size()[2]);
    set(&mut one, "depth", rounded(depth, 5));
    set(
        &mut one,
        "top",
        rounded(block.elevation(draws.within(0.3, 0.95)), 6),
    );
    let from = place(draws, block);
    if draws.chance(0.3) {
        set(&mut one, "head", from);
        set(&mut one, "length", rounded(length, 5));
        set(&mut one, "azimuth_deg", draws.within(1.0, 359.0));
        return one;
    }
    let angle = draws.within(0.0, std::f64::consts::TAU);
    let along = [angle.cos(), angle.sin()];
    let bend = length * draws.within(-0.12, 0.12);
    let at = |s: f64, aside: f64| {
        let point = [
            from[0] + s * length * along[0] - aside * along[1],
            from[1] + s * length * along[1] + aside * along[0],
        ];
        Value::from(numbers(&point))
    };
    let points = vec![at(0.0, 0.0), at(0.5, bend), at(1.0, 0.0)];
    let way = table([("kind", "points".into()), ("points", points.into())]);
    set(&mut one, "trajectory", way);
    one
}

/// Lobes in a part of the floor, which cut into each other.
fn eroding_lobes(draws: &mut Draws, block: &Block, number: usize) -> Table {
    let (narrow, height) = (block.narrow(), block.size()[2]);
    let mut one = feature(&format!("fan{number}"), "lobes", facies(draws));
    set(&mut one, "parent", "floor");
    set(&mut one, "count", draws.count(2, 4) as i64);
    let length = narrow * draws.within(0.25, 0.45);
    set(&mut one, "length", draws.quantity(length, 0.1));
    set(
        &mut one,
        "thickness",
        rounded(height * draws.within(0.04, 0.1), 5),
    );
    let azimuth = draws.within(10.0, 350.0);
    set(&mut one, "azimuth_deg", draws.about(azimuth, 8.0));
    set(&mut one, "erosion", draws.within(0.05, 0.4));
    set(&mut one, "compensation", draws.within(0.0, 12.0));
    let (low, high) = (block.at(0.2, 0.25), block.at(0.8, 0.75));
    let region = table([
        ("x", numbers(&[low[0], high[0]]).into()),
        ("y", numbers(&[low[1], high[1]]).into()),
    ]);
    set(&mut one, "region", region);
    one
}

/// A body that follows the floor.
fn conforming(draws: &mut Draws, block: &Block, number: usize) -> Table {
    let (narrow, height) = (block.narrow(), block.size()[2]);
    let kind = draws.pick(&["ellipsoid", "lobe", "scour", "channel"]);
    let mut one = feature(&format!("following{number}"), kind, facies(draws));
    let mut conform = table([("to", "floor".into())]);
    match kind {
        "ellipsoid" => {
            let long = narrow * draws.within(0.05, 0.2);
            let thick = height * draws.within(0.02, 0.06);
            let wide = long * draws.within(0.5, 0.9);
            set(&mut one, "semi_axes", numbers(&[long, wide, thick]));
            let [x, y] = block.at(draws.within(0.1, 0.9), draws.within(0.1, 0.9));
            let z = block.elevation(0.5);
            set(&mut one, "center", numbers(&[x, y, z]));
            set(&mut one, "azimuth_deg", draws.within(1.0, 179.0));
            let depth = thick * draws.within(1.2, 2.5);
            set(&mut conform, "depth", rounded(depth, 5));
        }
        "lobe" => {
            set(&mut one, "parent", "floor");
            let length = narrow * draws.within(0.15, 0.4);
            set(&mut one, "length", rounded(length, 5));
            set(
                &mut one,
                "thickness",
                rounded(height * draws.within(0.03, 0.1), 5),
            );
            set(&mut one, "azimuth_deg", draws.within(1.0, 359.0));
            set(&mut one, "center", place(draws, block));
        }
        "scour" => {
            let length = narrow * draws.within(0.2, 0.5);
            let width = length * draws.within(0.08, 0.2);
            set(&mut one, "length", rounded(length, 5));
            set(&mut one, "width", rounded(width, 5));
            let depth = (0.1 * width).min(0.1 * height);
            set(&mut one, "depth", rounded(depth, 5));
            set(&mut one, "azimuth_deg", draws.within(1.0, 359.0));
            set(&mut one, "center", place(draws, block));
        }
        _ => {
            let width = narrow * draws.within(0.04, 0.08);
            set(&mut one, "width", rounded(width, 5));
            let depth = (0.1 * width).min(0.1 * height);
            set(&mut one, "depth", rounded(depth, 5));
            let way = table([
                ("kind", "line".into()),
                ("azimuth_deg", draws.within(1.0, 179.0).into()),
                ("center", place(draws, block).into()),
            ]);
            set(&mut one, "trajectory", way);
            let depth = depth * draws.within(-0.5, 0.5);
            set(&mut conform, "depth", rounded(depth, 4));
        }
    }
    set(&mut one, "conform", conform);
    one
}
