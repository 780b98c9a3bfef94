//! Grids that are written come back node for node: an asymmetric one with a hole, in which no order and no sign can be swapped.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use clinothem::data::{Format, Grid, Layout, Reading, read};
use clinothem::export::{cps3, irap, zmap};
use glam::DVec2;

fn grid() -> Grid {
    let height = |entry: usize| -((100 * (entry / 3) + entry % 3) as f64) - 0.25;
    Grid {
        first: DVec2::new(456_000.0, 6_782_000.0),
        step: DVec2::new(10.0, 5.0),
        rotation: 0.0,
        counts: [4, 3],
        heights: (0..12)
            .map(|entry| (entry != 7).then(|| height(entry)))
            .collect(),
    }
}

fn assert_same(text: &str, format: Format) {
    let heights = read(text.as_bytes(), &Reading::default()).unwrap();
    assert_eq!(heights.format, format, "{text}");
    let Layout::Grid(found) = heights.layout else {
        panic!("no grid: {text}");
    };
    let own = grid();
    assert_eq!(found.counts, own.counts);
    assert!(found.first.distance(own.first) < 1e-9 && found.step.distance(own.step) < 1e-9);
    assert_eq!(found.rotation, 0.0);
    for (found, own) in found.heights.iter().zip(&own.heights) {
        assert_eq!(found.is_some(), own.is_some(), "{text}");
        assert!(
            (found.unwrap_or(0.0) - own.unwrap_or(0.0)).abs() < 1e-9,
            "{text}"
        );
    }
}

#[test]
fn irap_classic_comes_back_node_for_node() {
    let text = irap::text(&grid());
    assert_same(&text, Format::Irap);
    // Rows are counted first, and heights go from the south-west to the east.
    assert!(text.starts_with("-996 3 10.000000 5.000000\n456000.000000 456030.000000 6782000.000000 6782010.000000\n4 0.0"));
    let values = text.lines().nth(4).unwrap();
    assert!(
        values.starts_with("-0.2500 -100.2500 -200.2500 -300.2500 -1.2500 -101.2500"),
        "{values}"
    );
}

#[test]
fn zmap_comes_back_node_for_node() {
    let text = zmap::text(&grid(), "top sand, lower", "any");
    assert_same(&text, Format::Zmap);
    // Each column begins a line, at its northern end, in fields of 20.
    let first = text.lines().skip_while(|line| *line != "@").nth(1).unwrap();
    assert_eq!(first, format!("{:20.4}{:20.4}{:20.4}", -2.25, -1.25, -0.25));
    assert!(text.contains("@top_sand__lower HEADER, GRID, 5\n"));
}

#[test]
fn cps3_comes_back_node_for_node() {
    let text = cps3::text(&grid(), "top sand");
    assert_same(&text, Format::Cps3);
    assert!(text.contains("FSLIMI 456000.000000 456030.000000 6782000.000000 6782010.000000 -302.2500 -0.2500\nFSNROW 3 4\n"));
    assert!(text.contains("->top sand\n-2.2500 -1.2500 -0.2500\n"));
}
