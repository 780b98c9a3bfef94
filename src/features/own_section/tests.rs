#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

use super::*;

fn design(degree: usize, points: &[(f64, f64)]) -> OwnDesign {
    OwnDesign {
        points: points.iter().map(|(x, y)| DVec2::new(*x, *y)).collect(),
        degree,
        weights: None,
        knots: None,
        close: Close::Ruled,
        depth: Depth::Scale,
    }
}

const TRAPEZOID: [(f64, f64); 4] = [(-0.5, 0.0), (-0.25, -1.0), (0.25, -1.0), (0.5, 0.0)];
const PARABOLA: [(f64, f64); 3] = [(-0.5, 0.0), (0.0, -2.0), (0.5, 0.0)];

fn half_ellipse() -> OwnDesign {
    OwnDesign {
        weights: Some(vec![1.0, FRAC_1_SQRT_2, 1.0, FRAC_1_SQRT_2, 1.0]),
        knots: Some(vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0]),
        ..design(
            2,
            &[
                (-0.5, 0.0),
                (-0.5, -1.0),
                (0.0, -1.0),
                (0.5, -1.0),
                (0.5, 0.0),
            ],
        )
    }
}

/// Seven points of which the middle three are on a line: the default section.
fn channel() -> OwnDesign {
    design(
        3,
        &[
            (-0.5, 0.0),
            (-0.4, -0.65),
            (-0.225, -1.0),
            (0.0, -1.0),
            (0.225, -1.0),
            (0.4, -0.65),
            (0.5, 0.0),
        ],
    )
}

/// A design's curve as a design of its own.
fn as_design(curve: &Curve) -> OwnDesign {
    OwnDesign {
        points: curve.points().iter().map(|p| p.truncate()).collect(),
        degree: curve.degree(),
        weights: Some(curve.weights().to_vec()),
        knots: Some(curve.knots().as_slice().to_vec()),
        close: Close::Ruled,
        depth: Depth::Scale,
    }
}

#[test]
fn areas_are_those_of_closed_forms() {
    let area = |design: &OwnDesign| OwnSection::new(design).unwrap().area();
    assert!((area(&design(1, &TRAPEZOID)) - 0.75).abs() < 1e-14);
    assert!((area(&design(2, &PARABOLA)) - 2.0 / 3.0).abs() < 1e-14);
    assert!((area(&half_ellipse()) - FRAC_PI_4).abs() < 1e-14);
    // What the integral of the usual section is known to be.
    assert!((area(&channel()) - 0.764_563).abs() < 1e-6);
}

#[test]
fn insertion_and_elevation_leave_areas_and_deepest_places() {
    for own in [design(2, &PARABOLA), half_ellipse(), channel()] {
        let one = OwnSection::new(&own).unwrap();
        let finer = one.curve().insert_knot(0.3, 1).unwrap();
        let higher = one.curve().elevate(2).unwrap();
        for curve in [finer, higher] {
            let other = OwnSection::new(&as_design(&curve)).unwrap();
            assert!((one.area() - other.area()).abs() < 1e-12);
            assert!(one.deepest().distance(other.deepest()) < 1e-6);
        }
    }
}

#[test]
fn the_deepest_place_is_reported_and_may_be_what_the_depth_says() {
    // A cubic does not reach its control points.
    let points = [(-0.5, 0.0), (-0.2, -1.0), (0.4, -1.0), (0.5, 0.0)];
    let plain = OwnSection::new(&design(3, &points)).unwrap();
    assert!((plain.deepest().y + 0.75).abs() < 1e-12);
    let stretched = OwnDesign {
        depth: Depth::Deepest,
        ..design(3, &points)
    };
    let stretched = OwnSection::new(&stretched).unwrap();
    assert!((stretched.curve().point(0.5).y + 1.0).abs() < 1e-12);
    assert_eq!(stretched.deepest().y, -1.0);
    assert!((stretched.area() - plain.area() / 0.75).abs() < 1e-12);
    // Of a level floor it is the middle.
    let floor = OwnSection::new(&design(1, &TRAPEZOID)).unwrap();
    assert!(floor.deepest().distance(DVec2::new(0.0, -1.0)) < 1e-9);
    assert_eq!(floor.corners().len(), 2);
    assert!(
        OwnSection::new(&half_ellipse())
            .unwrap()
            .corners()
            .is_empty()
    );
}

#[test]
fn a_closed_section_has_sides_and_the_area_that_it_goes_around() {
    let square = [
        (0.0, 0.0),
        (0.5, -0.5),
        (0.0, -1.0),
        (-0.5, -0.5),
        (0.0, 0.0),
    ];
    let closed = OwnDesign {
        close: Close::Closed,
        ..design(1, &square)
    };
    let one = OwnSection::new(&closed).unwrap();
    assert!((one.area() - 0.5).abs() < 1e-14);
    let [left, right] = one.sides().map(|u| one.curve().point(u).x);
    assert!((left + 0.5).abs() < 1e-9 && (right - 0.5).abs() < 1e-9);
    let mut back = closed.clone();
    back.points.reverse();
    assert!((OwnSection::new(&back).unwrap().area() - 0.5).abs() < 1e-14);
}

#[test]
fn what_is_no_section_is_refused_with_the_points_number() {
    let refused = |design: OwnDesign| OwnSection::new(&design).unwrap_err().to_string();
    let words = |design: OwnDesign, expected: &[&str]| {
        let said = refused(design);
        for part in expected {
            assert!(said.contains(part), "{said}");
        }
    };
    words(design(3, &PARABOLA), &["3 points", "degree 3 needs 4"]);
    words(design(9, &TRAPEZOID), &["degree is 9"]);
    words(
        design(1, &[(-0.5, 0.0), (0.0, f64::NAN), (0.5, 0.0)]),
        &["point 2"],
    );
    words(
        design(1, &[(-0.5, 0.0), (0.0, -1.0), (0.4, 0.0)]),
        &["point 3, a rim, is [0.4, 0]"],
    );
    words(
        design(1, &[(0.5, 0.0), (0.0, -1.0), (-0.5, 0.0)]),
        &["point 1, a rim", "from left to right"],
    );
    words(
        design(1, &[(-0.5, 0.1), (0.0, -1.0), (0.5, 0.0)]),
        &["point 1, a rim, is [-0.5, 0.1]"],
    );
    words(
        design(1, &[(-0.5, 0.0), (0.0, -1.0), (0.0, -1.0), (0.5, 0.0)]),
        &["points 2 and 3 are the same"],
    );
    // Straight pieces that cross: the second and the fourth.
    let knot = [
        (-0.5, 0.0),
        (-0.2, -1.0),
        (0.3, -0.2),
        (-0.3, -0.3),
        (0.3, -1.0),
        (0.5, 0.0),
    ];
    words(design(1, &knot), &["meets itself near point"]);
    // A cubic loop.
    let loops = [(-0.5, 0.0), (1.5, -1.5), (-1.5, -1.5), (0.5, 0.0)];
    words(design(3, &loops), &["meets itself"]);
    words(
        design(
            1,
            &[
                (-0.5, 0.0),
                (-0.2, -1.0),
                (0.0, 0.3),
                (0.2, -1.0),
                (0.5, 0.0),
            ],
        ),
        &["its own top near point"],
    );
    words(
        design(1, &[(-0.5, 0.0), (0.0, 1.0), (0.5, 0.0)]),
        &["rises above its rims near point 2"],
    );
    let back = [
        (-0.5, 0.0),
        (0.0, -1.0),
        (0.0, -0.5),
        (0.0, -1.0),
        (0.5, 0.0),
    ];
    words(design(1, &back), &["near point"]);
    let two_basins = [
        (-0.5, 0.0),
        (-0.4, -1.0),
        (-0.1, -1.0),
        (-0.1, -0.3),
        (0.1, -0.3),
        (0.1, -1.0),
        (0.4, -1.0),
        (0.5, 0.0),
    ];
    words(design(1, &two_basins), &["sees all of its corners"]);
    // The same with round corners has ends that are ruled from its top.
    assert!(OwnSection::new(&design(3, &two_basins)).is_ok());
    let mut own = half_ellipse();
    own.weights = Some(vec![1.0, 0.0, 1.0, 1.0, 1.0]);
    words(own.clone(), &["weight 2 is 0"]);
    own.weights = Some(vec![1.0; 4]);
    words(own, &["4 weights for 5 points"]);
    let mut own = half_ellipse();
    own.knots = Some(vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    words(own.clone(), &["6 knots", "have 8"]);
    own.knots = Some(vec![0.0, 0.0, 0.0, 0.6, 0.5, 1.0, 1.0, 1.0]);
    words(own, &["knot"]);
    let open = OwnDesign {
        close: Close::Closed,
        ..design(1, &TRAPEZOID)
    };
    words(open, &["point 4, the last one", "ends where it begins"]);
}

#[test]
fn the_sides_of_a_circle_are_at_its_knots_to_the_last_bit() {
    let half = FRAC_1_SQRT_2;
    let circle = OwnDesign {
        close: Close::Closed,
        weights: Some(vec![1.0, half, 1.0, half, 1.0, half, 1.0, half, 1.0]),
        knots: Some(vec![
            0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0,
        ]),
        ..design(
            2,
            &[
                (-0.5, -0.5),
                (-0.5, 0.0),
                (0.0, 0.0),
                (0.5, 0.0),
                (0.5, -0.5),
                (0.5, -1.0),
                (0.0, -1.0),
                (-0.5, -1.0),
                (-0.5, -0.5),
            ],
        )
    };
    let one = OwnSection::new(&circle).unwrap();
    assert!((one.area() - FRAC_PI_4).abs() < 1e-14);
    assert_eq!(one.sides(), [0.0, 0.5]);
    assert!(one.deepest().distance(DVec2::new(0.0, -1.0)) < 1e-12);
    assert!(one.corners().is_empty());
}
