//! Horizons from scattered points that are equal over an area: beds that end as their points say.

use std::fmt::Write as _;

use super::Report;

/// Around the places of the points, and how far the surfaces may miss them (m).
const PLAN: [f64; 2] = [1000.0, 800.0];
const TOLERANCE: f64 = 0.05;

/// A surface that undulates by some metres.
fn undulating(x: f64, y: f64) -> f64 {
    -60.0 + 5.0 * (x / 210.0).sin() + 4.0 * (y / 170.0 + x / 400.0).cos()
}

/// 20 m in the west, evenly less, and nothing east of x = 400.
fn wedge(x: f64) -> f64 {
    (20.0 - x / 20.0).max(0.0)
}

/// Points 50 m from each other, moved a little aside so that they lie on no grid.
fn places() -> Vec<[f64; 2]> {
    let mut places = Vec::new();
    for i in 0..=20_i32 {
        for j in 0..=16_i32 {
            let off = |k: i32| 12.0 * f64::from((i * 7 + j * 11 + k) % 13 - 6) / 6.0;
            places.push([50.0 * f64::from(i) + off(0), 50.0 * f64::from(j) + off(5)]);
        }
    }
    places
}

fn horizon(id: &str, relation: &str, height: impl Fn(f64, f64) -> f64) -> String {
    let mut points = String::new();
    for [x, y] in places() {
        write!(points, "[{x}, {y}, {}], ", height(x, y)).unwrap();
    }
    format!(
        "[[feature]]\nid = \"{id}\"\nkind = \"horizon\"\nfacies = \"rock\"\nrelation = \"{relation}\"\n\
         surface = {{ points = [{points}], tolerance = {TOLERANCE} }}\n"
    )
}

fn report(horizons: &[String]) -> Report {
    let head = "name = \"points\"\n[domain]\nx = [0, 1000]\ny = [0, 800]\nz = [-100, 0]\nfacies = \"rock\"\n[facies.rock]\n";
    Report::of(&format!("{head}{}", horizons.concat()), &[])
}

/// The mean of a function over the plan, by the midpoint rule.
fn mean(f: impl Fn(f64, f64) -> f64) -> f64 {
    const CELLS: u32 = 400;
    let part = |k: u32| (f64::from(k) + 0.5) / f64::from(CELLS);
    let all = (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j)));
    let sum: f64 = all
        .map(|(i, j)| f(PLAN[0] * part(i), PLAN[1] * part(j)))
        .sum();
    sum / f64::from(CELLS * CELLS)
}

/// The bed has the wedge's volume but for what the tolerance leaves, in one piece, and the unit below it its own.
fn assert_wedge(report: &Report, below: impl Fn(f64, f64) -> f64) {
    let area = PLAN[0] * PLAN[1];
    let miss = report.size("h1") / area - mean(|x, _| wedge(x));
    assert!(
        miss.abs() < 2.0 * TOLERANCE,
        "the bed is {miss} m too thick in the mean"
    );
    assert_eq!(report.pieces("h1"), 1);
    assert_eq!(report.pieces("h2"), 1);
    let miss = report.size("background") / area - 100.0 - mean(below);
    assert!(
        miss.abs() < TOLERANCE,
        "what is below is {miss} m too thick in the mean"
    );
}

#[test]
fn a_bed_ends_where_the_younger_points_are_those_of_the_older_surface() {
    for relation in ["erosive", "onlapping"] {
        let report = report(&[
            horizon("h1", "erosive", undulating),
            horizon("h2", relation, |x, y| undulating(x, y) + wedge(x)),
        ]);
        let words = "between h1 and h2 is absent, and the surface of h1 stays";
        assert!(report.decides(words, "m² within x from"));
        assert_wedge(&report, undulating);
    }
}

#[test]
fn an_older_surface_follows_the_unconformity_whose_points_it_has() {
    let older = |x: f64, y: f64| undulating(x, y) - wedge(x);
    let report = report(&[
        horizon("h1", "erosive", older),
        horizon("h2", "erosive", undulating),
    ]);
    let words = "between h1 and h2 is absent, and the surface of h2 stays";
    assert!(report.decides(words, "m² within x from"));
    assert_wedge(&report, older);
}
