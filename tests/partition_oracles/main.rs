//! The partition kernel against closed forms, and what it says about surfaces that touch.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test fails by panicking"
)]

mod bowls;
mod boxes;
mod cylinders;
#[path = "../shapes/mod.rs"]
mod shapes;
mod spheres;
mod touching;

use clinothem::partition::{CurveShape, Partition};
use glam::DVec3;
use shapes::audit::space_curve;

/// Sizes of curved solids: curves are within 1e-11 of the block's diagonal, quadrature is a little coarser.
const SIZE: f64 = 1e-9;

fn assert_near(value: f64, wanted: f64, part: f64, of: &str) {
    assert!(
        (value - wanted).abs() <= part * wanted.abs(),
        "{of} is {value}, not {wanted}"
    );
}

/// Points of all computed curves.
fn computed(made: &Partition) -> Vec<DVec3> {
    let mut all = Vec::new();
    for shape in &made.topology.curves {
        if let CurveShape::Computed { .. } = shape {
            let curve = space_curve(shape);
            let (from, to) = curve.domain();
            all.extend((0..=200).map(|k| curve.point(from + (to - from) * f64::from(k) / 200.0)));
        }
    }
    assert!(!all.is_empty(), "nothing was computed");
    all
}
