//! What is no knot vector, curve, surface or interpolation problem, and what the messages say about it.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use clinothem::nurbs::interpolate::{self, Parametrization};
use clinothem::nurbs::{Curve, KnotVector, Surface};
use glam::DVec3;

fn line() -> Curve {
    Curve::new(
        KnotVector::uniform(1, 2).unwrap(),
        vec![DVec3::ZERO, DVec3::X],
    )
    .unwrap()
}

#[test]
fn invalid_knot_vectors_are_refused_with_value_place_and_remedy() {
    let nan = f64::NAN;
    for (degree, knots, message) in [
        (0, vec![0.0, 1.0], "the degree is 0; use 1 to 25"),
        (26, vec![0.0; 54], "the degree is 26; use 1 to 25"),
        (
            2,
            vec![0.0, 0.0, 1.0, 1.0],
            "4 knots are too few for degree 2; a clamped knot vector has at least 6",
        ),
        (
            1,
            vec![0.0, 0.0, nan, 1.0, 1.0],
            "knot 2 is NaN; knots must be finite",
        ),
        (
            1,
            vec![0.0, 0.0, 0.7, 0.3, 1.0, 1.0],
            "knot 3 is 0.3, below the previous knot 0.7; sort the knots",
        ),
        (
            1,
            vec![2.0; 4],
            "all knots are 2; the last must be above the first",
        ),
        (
            2,
            vec![0.0, 0.0, 0.5, 1.0, 1.0, 1.0],
            "knot 2 is 0.5; to clamp an end at degree 2, repeat its knot 0 3 times",
        ),
        (
            2,
            vec![0.0, 0.0, 0.0, 0.5, 1.0, 1.0],
            "knot 3 is 0.5; to clamp an end at degree 2, repeat its knot 1 3 times",
        ),
        (
            1,
            vec![0.0, 0.0, 0.5, 0.5, 1.0, 1.0],
            "interior knot 0.5 appears 2 times; at degree 1 the curve would break there, so repeat it at most 1 times",
        ),
        (
            1,
            vec![0.0, 0.0, 0.0, 1.0, 1.0],
            "interior knot 0 appears 3 times; at degree 1 the curve would break there, so repeat it at most 1 times",
        ),
        (
            1,
            vec![0.0, 0.0, 0.5, 0.500_000_000_000_1, 1.0, 1.0],
            "knot 3 is 0.5000000000001, almost but not quite the previous knot 0.5; make them equal or move them apart",
        ),
    ] {
        assert_eq!(
            KnotVector::new(degree, knots).unwrap_err().to_string(),
            message
        );
    }
    assert_eq!(
        KnotVector::uniform(3, 3).unwrap_err().to_string(),
        "3 control points are too few for degree 3; give at least 4 or lower the degree"
    );
}

#[test]
fn control_points_and_weights_must_fit_the_knots() {
    let knots = || KnotVector::uniform(1, 2).unwrap();
    let (a, b) = (DVec3::ZERO, DVec3::X);
    let refused = |points: Vec<DVec3>, weights: Vec<f64>| {
        Curve::rational(knots(), points, weights)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        refused(vec![a], vec![1.0]),
        "there are 1 control points; the knot vector belongs to 2"
    );
    assert_eq!(
        refused(vec![a, b], vec![1.0]),
        "there are 1 weights for 2 control points; give one for each"
    );
    assert_eq!(
        refused(vec![a, b], vec![1.0, 0.0]),
        "weight 1 is 0; weights must be positive and finite"
    );
    assert_eq!(
        refused(vec![a, DVec3::INFINITY], vec![1.0, 1.0]),
        "control point 1 is [inf, inf, inf]; coordinates must be finite"
    );
    assert_eq!(
        line().with_control_point(2, a).unwrap_err().to_string(),
        "there is no control point 2; the curve has 2, counted from 0"
    );
    assert_eq!(
        Surface::new(knots(), knots(), vec![a; 5])
            .unwrap_err()
            .to_string(),
        "there are 5 control points; the knot vectors belong to 2 × 2"
    );
    let surface = Surface::new(knots(), knots(), vec![a, b, DVec3::Y, b + DVec3::Y]).unwrap();
    assert_eq!(
        surface.with_weight(1, 0, -1.0).unwrap_err().to_string(),
        "weight (1, 0) is -1; weights must be positive and finite"
    );
    assert_eq!(
        surface.control_point(0, 2).unwrap_err().to_string(),
        "there is no control point (0, 2); the net has 2 × 2, counted from 0"
    );
}

#[test]
fn knots_go_inside_the_domain_and_no_more_often_than_the_degree() {
    let curve = line().elevate(1).unwrap();
    assert_eq!(
        curve.insert_knot(1.0, 1).unwrap_err().to_string(),
        "knot 1 is not inside the domain from 0 to 1; choose one between them"
    );
    assert_eq!(
        curve.insert_knot(0.5, 3).unwrap_err().to_string(),
        "knot 0.5 is there 0 times and 3 more are asked for; degree 2 allows 2 in all"
    );
    // What can't be told from a knot is that knot.
    let once = curve.insert_knot(0.5, 1).unwrap();
    let twice = once.insert_knot(0.500_000_000_000_000_1, 1).unwrap();
    assert_eq!(twice.knots().distinct(), [(0.0, 3), (0.5, 2), (1.0, 3)]);
    assert!(twice.insert_knot(0.5, 1).is_err());
    assert!(
        curve.split(0.0).is_err() && curve.split(f64::NAN).is_err() && curve.split(2.0).is_err()
    );
    assert_eq!(
        curve.elevate(24).unwrap_err().to_string(),
        "degree 2 elevated 24 times is above 25; elevate less"
    );
}

#[test]
fn points_that_no_curve_passes_through_are_named() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::Y];
    let chord = Parametrization::ChordLength;
    assert_eq!(
        interpolate::curve(&points, 3, chord)
            .unwrap_err()
            .to_string(),
        "point 2 is [1, 0, 0], the same as the previous one; remove one of them"
    );
    assert_eq!(
        interpolate::curve(&points[..2], 3, chord)
            .unwrap_err()
            .to_string(),
        "2 points are too few for degree 3; give at least 4 or lower the degree"
    );
    assert_eq!(
        interpolate::averaged_knots(2, &[0.0, 0.5, 0.5, 1.0])
            .unwrap_err()
            .to_string(),
        "parameter 2 is 0.5, not above the previous 0.5; parameters must grow"
    );
    assert_eq!(
        interpolate::with_parameters(&[points.to_vec()], &[0.0, 0.5, 1.0], 2)
            .unwrap_err()
            .to_string(),
        "row 0 has 4 points for 3 parameters; give one for each"
    );
    assert!(interpolate::parameters(&[DVec3::NAN, DVec3::X], chord).is_err());
    assert!(interpolate::parameters(&[], chord).is_err());
}

#[test]
fn parameters_outside_the_domain_are_moved_to_its_ends() {
    let curve = line();
    assert_eq!(
        (curve.point(-1.0), curve.point(7.0)),
        (DVec3::ZERO, DVec3::X)
    );
    assert!(curve.point(f64::NAN).is_nan());
}
