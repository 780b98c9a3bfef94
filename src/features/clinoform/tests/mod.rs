#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

mod borders;
mod formula;
mod refused;
mod shorelines;

use super::super::frame::{FrameError, Shoreline};
use super::*;
use crate::features::horizon::Horizon;

const LOW: DVec3 = DVec3::new(0.0, 0.0, -30.0);
const HIGH: DVec3 = DVec3::new(365.76, 670.56, 0.0);
const AZIMUTHS: [f64; 6] = [0.0, 45.0, 90.0, 180.0, 270.0, 320.0];

/// Table 1 of [J19].
const SHORELINE: Shoreline = Shoreline {
    dip: 3000.0,
    strike: 6000.0,
};

fn frame(azimuth_deg: f64) -> ClinoformFrame {
    ClinoformFrame::new(LOW, HIGH, azimuth_deg.to_radians()).unwrap()
}

fn flat() -> ClinoformUnit {
    let horizon = |z| Horizon::flat(z).unwrap();
    ClinoformUnit::new(horizon(-21.3), horizon(-0.3), LOW, HIGH).unwrap()
}

fn undulating() -> ClinoformUnit {
    let grid = |middle: f64, phase: f64| {
        let height = |i: i32, j: i32| {
            middle + (1.1 * f64::from(i) + phase).sin() * (0.7 * f64::from(j)).cos()
        };
        let rows: Vec<Vec<f64>> = (0..8)
            .map(|j| (0..5).map(|i| height(i, j)).collect())
            .collect();
        Horizon::grid([0.0, 380.0], [0.0, 700.0], &rows).unwrap()
    };
    ClinoformUnit::new(grid(-21.3, 0.0), grid(-1.3, 2.0), LOW, HIGH).unwrap()
}

/// A sheet in the middle of the domain.
fn design(frame: &ClinoformFrame, exponent: f64, toe: f64) -> ClinoformDesign {
    ClinoformDesign {
        origin: frame.first_origin(SHORELINE) + 200.0,
        shoreline: SHORELINE,
        length: 350.0,
        exponent,
        toe,
    }
}

/// z by the formula, at a place in plan; and u there.
fn formula(
    design: &ClinoformDesign,
    unit: &ClinoformUnit,
    azimuth_deg: f64,
    place: DVec2,
) -> (f64, f64) {
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    let off = place - (LOW + HIGH).truncate() / 2.0;
    let (d, q) = (off.x * sin + off.y * cos, off.x * cos - off.y * sin);
    let ellipse = |dip: f64, strike: f64| design.origin + dip * (1.0 - (q / strike).powi(2)).sqrt();
    let top = ellipse(3000.0, 6000.0);
    let toe = ellipse(3000.0 + design.length, 6000.0 + design.length);
    let s = 1.0 - (d - top) / (toe - top);
    let w = if design.exponent == 1.0 {
        s
    } else {
        (1.0 - design.toe) * s.max(0.0).powf(design.exponent) + design.toe * s
    };
    let (base, above) = (
        unit.base().height(place.x, place.y),
        unit.top().height(place.x, place.y),
    );
    (base + w * (above - base), 1.0 - s)
}

/// Places all over the domain's plan.
fn places() -> impl Iterator<Item = DVec2> {
    (0..400).map(|k| {
        let part = |ratio: f64| (f64::from(k) * ratio).fract();
        let part = DVec2::new(part(0.754_877_666), part(0.569_840_291));
        (LOW + (HIGH - LOW) * part.extend(0.0)).truncate()
    })
}

/// A unit between two bent horizons: heights at random on lattices of so many nodes along y.
fn bent(seed: u32, nodes: i32, swing: f64) -> ClinoformUnit {
    let grid = |middle: f64, salt: u32| {
        // Weyl's sequence: any numbers do that are not in step with the lattice.
        let height = |i: i32, j: i32| {
            let step = f64::from(seed * 7 + salt + 1) * 0.618_033_988_749_895;
            let part = (f64::from(i * 31 + j) * step + 0.37 * f64::from(i * j)).fract();
            middle + swing * (2.0 * part - 1.0)
        };
        let rows: Vec<Vec<f64>> = (0..nodes)
            .map(|j| (0..nodes / 2 + 2).map(|i| height(i, j)).collect())
            .collect();
        Horizon::grid([-10.0, 380.0], [-20.0, 700.0], &rows).unwrap()
    };
    ClinoformUnit::new(grid(-21.3, 0), grid(-1.3, 3), LOW, HIGH).unwrap()
}
