//! Surfaces, horizons and clinoform sets.

use std::f64::consts::TAU;

use toml::{Table, Value};

use super::draws::{Draws, rounded};
use super::tables::{Block, FACIES, feature, set, table};

/// A smooth field over a block's plan, between about −1 and 1.
pub(super) struct Field {
    waves: Vec<[f64; 4]>,
}

impl Field {
    pub(super) fn new(draws: &mut Draws, block: &Block) -> Self {
        let count = draws.count(1, 4);
        let [x, y, _] = block.size();
        let waves = (0..count)
            .map(|_| {
                let (a, b) = (draws.within(-1.6, 1.6), draws.within(-1.6, 1.6));
                [
                    a / x,
                    b / y,
                    draws.within(0.0, 1.0),
                    draws.within(0.3, 1.0) / count as f64,
                ]
            })
            .collect();
        Self { waves }
    }

    pub(super) fn at(&self, x: f64, y: f64) -> f64 {
        self.waves
            .iter()
            .map(|[a, b, phase, height]| height * (TAU * (a * x + b * y + phase)).sin())
            .sum()
    }
}

/// Heights of a field at the nodes of a grid that holds the block's plan.
pub(super) fn grid(
    block: &Block,
    [columns, rows]: [usize; 2],
    beyond: f64,
    height: impl Fn(f64, f64) -> f64,
) -> Table {
    let range = |[low, high]: [f64; 2]| {
        let more = rounded(beyond * (high - low), 4);
        [low - more, high + more].map(|at| rounded(at, 9))
    };
    let (x, y) = (range(block.x), range(block.y));
    let node = |[low, high]: [f64; 2], at: usize, count: usize| {
        low + (high - low) * at as f64 / (count - 1) as f64
    };
    let heights: Vec<Value> = (0..rows)
        .map(|j| {
            let row: Vec<f64> = (0..columns)
                .map(|i| rounded(height(node(x, i, columns), node(y, j, rows)), 7))
                .collect();
            row.into()
        })
        .collect();
    let grid = table([
        ("x", x.to_vec().into()),
        ("y", y.to_vec().into()),
        ("heights", heights.into()),
    ]);
    table([("grid", grid.into())])
}

/// A surface about an elevation, with so much relief.
pub(super) fn surface(draws: &mut Draws, block: &Block, mean: f64, relief: f64) -> Table {
    match draws.count(0, 9) {
        0 | 1 => table([("level", draws.about(mean, 0.3 * relief))]),
        2 | 3 => {
            let [x, y] = block.at(draws.within(0.2, 0.8), draws.within(0.2, 0.8));
            let through = [x, y, mean].map(|value| rounded(value, 7));
            let dip = (relief / block.across() * draws.within(0.3, 1.5))
                .atan()
                .to_degrees();
            let plane = table([
                ("through", through.to_vec().into()),
                ("dip_deg", rounded(dip, 4).into()),
                ("azimuth_deg", draws.within(0.0, 360.0).into()),
            ]);
            table([("dipping", plane.into())])
        }
        4..=7 => {
            let field = Field::new(draws, block);
            let nodes = [draws.count(2, 9), draws.count(2, 9)];
            let beyond = draws.pick(&[0.0, 0.0, 0.013, 0.17]);
            let noise = draws.pick(&[0.0, 0.0, 0.1]);
            let bumps: Vec<f64> = (0..100).map(|_| noise * draws.within(-1.0, 1.0)).collect();
            let bump = |x: f64, y: f64| {
                let at =
                    (x / block.across() * 531.0 + y / block.across() * 873.0).rem_euclid(100.0);
                bumps
                    .iter()
                    .enumerate()
                    .find(|(i, _)| at < *i as f64 + 1.0)
                    .map_or(0.0, |(_, b)| *b)
            };
            grid(block, nodes, beyond, |x, y| {
                mean + relief * (field.at(x, y) + bump(x, y))
            })
        }
        _ => {
            let field = Field::new(draws, block);
            let count = draws.count(9, 40);
            scattered(
                draws,
                block,
                count,
                (relief, |x, y| mean + relief * field.at(x, y)),
            )
        }
    }
}

pub(super) fn horizon(draws: &mut Draws, block: &Block, id: &str, mean: f64, relief: f64) -> Table {
    let mut horizon = feature(id, "horizon", draws.pick(&FACIES));
    set(&mut horizon, "surface", surface(draws, block, mean, relief));
    if draws.chance(0.3) {
        set(&mut horizon, "relation", "onlapping");
    }
    horizon
}

/// A bed above an older horizon, by its thickness; one that may end has none at some nodes of a grid or some points.
pub(super) fn isochore(
    draws: &mut Draws,
    block: &Block,
    above: &str,
    mean: f64,
    may_end: bool,
) -> Table {
    let form = draws.count(0, 9);
    if form < 3 {
        let thickness = draws.quantity(mean, 0.4);
        return table([("above", above.into()), ("thickness", thickness)]);
    }
    let field = Field::new(draws, block);
    let swing = draws.within(0.1, 0.8);
    let ends = may_end && draws.chance(0.4);
    let thickness = |x: f64, y: f64| {
        let share = if ends {
            0.2 + 2.0 * field.at(x, y)
        } else {
            1.0 + swing * field.at(x, y)
        };
        mean * share.max(0.0)
    };
    let measured = if form < 8 {
        let nodes = [draws.count(2, 9), draws.count(2, 9)];
        let beyond = draws.pick(&[0.0, 0.0, 0.013, 0.17]);
        grid(block, nodes, beyond, thickness)
    } else {
        let count = draws.count(9, 40);
        scattered(draws, block, count, (0.2 * mean, thickness))
    };
    table([("above", above.into()), ("thickness", measured.into())])
}

/// Scattered points on a function over the plan with so much relief.
fn scattered(
    draws: &mut Draws,
    block: &Block,
    count: usize,
    (relief, height): (f64, impl Fn(f64, f64) -> f64),
) -> Table {
    let points: Vec<Value> = (0..count)
        .map(|_| {
            let [x, y] = block.at(draws.within(-0.1, 1.1), draws.within(-0.1, 1.1));
            let place = [x, y, height(x, y)].map(|value| rounded(value, 7));
            place.to_vec().into()
        })
        .collect();
    table([
        ("points", points.into()),
        (
            "tolerance",
            rounded(relief * draws.magnitude(0.02, 0.2), 3).into(),
        ),
    ])
}

/// A clinoform set in the unit of a horizon, or in the background.
pub(super) fn clinoforms(
    draws: &mut Draws,
    block: &Block,
    id: &str,
    parent: Option<&str>,
) -> Table {
    let across = block.across();
    let mut set_of = feature(id, "clinoforms", draws.pick(&FACIES));
    if let Some(parent) = parent {
        set(&mut set_of, "parent", parent);
    }
    let azimuth = draws.within(0.0, 300.0);
    let spacing = across * draws.magnitude(0.1, 0.5);
    let length = across * draws.magnitude(0.15, 1.2);
    set(&mut set_of, "azimuth_deg", draws.quantity(azimuth, 0.1));
    set(&mut set_of, "spacing", draws.quantity(spacing, 0.3));
    set(&mut set_of, "length", draws.quantity(length, 0.4));
    let first = across * draws.magnitude(0.03, 0.4);
    set(&mut set_of, "first", draws.quantity(first, 0.3));
    let shoreline: Vec<Value> = vec![
        rounded(across * draws.magnitude(3.0, 10.0), 4).into(),
        rounded(across * draws.magnitude(5.0, 20.0), 4).into(),
    ];
    set(&mut set_of, "shoreline", shoreline);
    if draws.chance(0.4) {
        set(&mut set_of, "exponent", draws.within(1.0, 2.5));
    }
    if draws.chance(0.4) {
        set(&mut set_of, "toe", draws.within(0.1, 1.0));
    }
    if draws.chance(0.3) {
        set(&mut set_of, "sheets", draws.pick(&[1, 2, 3, 4]));
    }
    let count = draws.count(0, 4);
    if count >= 2 {
        if draws.chance(0.3) {
            set(&mut set_of, "interfingering", "zigzag");
        }
        if draws.chance(0.3) {
            // The greatest least distance stays below the least greatest one.
            let least = across * draws.magnitude(0.04, 0.2);
            let most = least * draws.within(1.3, 3.0);
            let turns: Vec<Value> = vec![draws.quantity(least, 0.1), draws.quantity(most, 0.1)];
            set(&mut set_of, "turns", turns);
        }
        let belts: Vec<Value> = (0..count)
            .map(|at| {
                let mut belt = table([
                    ("name", format!("b{at}").into()),
                    ("facies", draws.pick(&FACIES).into()),
                ]);
                if at + 1 < count {
                    let width = length * draws.magnitude(0.1, 0.5);
                    set(&mut belt, "width", draws.quantity(width, 0.3));
                    if draws.chance(0.7) {
                        let swing = width * draws.within(0.05, 0.4);
                        set(&mut belt, "interfingering", draws.quantity(swing, 0.3));
                    }
                }
                belt.into()
            })
            .collect();
        set(&mut set_of, "belts", belts);
    }
    set_of
}
