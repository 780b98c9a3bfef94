//! Curves and surfaces against closed forms: circle, parabola, sphere, and the net of [J19] Fig. 3.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use clinothem::nurbs::interpolate::{self, Parametrization};
use clinothem::nurbs::{Curve, KnotVector, Surface};
use glam::DVec3;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The circle of radius r about the z axis: four rational quadratic quarters.
fn circle(r: f64) -> Curve {
    let corner = [
        (1, 0),
        (1, 1),
        (0, 1),
        (-1, 1),
        (-1, 0),
        (-1, -1),
        (0, -1),
        (1, -1),
        (1, 0),
    ];
    let points = corner
        .iter()
        .map(|&(x, y)| r * DVec3::new(f64::from(x), f64::from(y), 0.0))
        .collect();
    let weights = (0..9)
        .map(|i| if i % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 })
        .collect();
    let knots = vec![
        0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0,
    ];
    Curve::rational(KnotVector::new(2, knots).unwrap(), points, weights).unwrap()
}

fn fig3(degree: usize) -> Surface {
    let net = (0..24)
        .map(|k| {
            let (i, j) = (f64::from(k / 4), f64::from(k % 4));
            DVec3::new(
                i * 10.0 + 4.0 * (j * 2.0).sin(),
                j * 8.0,
                6.0 * (i * 1.7 + j).cos(),
            )
        })
        .collect();
    let (u, v) = (
        KnotVector::uniform(degree, 6).unwrap(),
        KnotVector::uniform(degree, 4).unwrap(),
    );
    Surface::new(u, v, net).unwrap()
}

#[test]
fn every_point_of_a_rational_quadratic_circle_has_its_radius() {
    let circle = circle(7.0);
    for k in 0..=100 {
        let u = f64::from(k) / 100.0;
        let derivatives = circle.derivatives(u, 2);
        assert!((circle.point(u).length() - 7.0).abs() < 1e-14 * 7.0);
        // The velocity stands on the radius and runs anticlockwise.
        assert!(derivatives[0].dot(derivatives[1]).abs() < 1e-11);
        assert!(derivatives[0].cross(derivatives[1]).z > 0.0);
        // |C' × C''| / |C'|³ is the curvature.
        let curvature =
            derivatives[1].cross(derivatives[2]).length() / derivatives[1].length().powi(3);
        assert!((curvature - 1.0 / 7.0).abs() < 1e-12);
    }
}

#[test]
fn the_net_of_figure_3_has_knot_vectors_of_9_and_7_entries_at_degree_2() {
    let surface = fig3(2);
    assert_eq!(
        surface.knots_u().as_slice(),
        [0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0]
    );
    assert_eq!(
        surface.knots_v().as_slice(),
        [0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0]
    );
}

#[test]
fn an_interpolated_curve_passes_through_its_points() {
    let points: Vec<DVec3> = (0..12)
        .map(f64::from)
        .map(|k| DVec3::new(100.0 * k, 40.0 * (PI * k / 3.0).sin(), k * k))
        .collect();
    for spacing in [Parametrization::ChordLength, Parametrization::Centripetal] {
        for degree in 1..=4 {
            let curve = interpolate::curve(&points, degree, spacing).unwrap();
            let params = interpolate::parameters(&points, spacing).unwrap();
            for (u, q) in params.iter().zip(&points) {
                assert!(curve.point(*u).distance(*q) < 1e-10);
            }
        }
    }
}

#[test]
fn refinement_elevation_splitting_and_reversal_keep_the_shape() {
    let circle = circle(3.0);
    let same = [
        circle.insert_knot(0.3, 2).unwrap(),
        circle.refine(&[0.1, 0.9, 0.6, 0.6]).unwrap(),
        circle.elevate(1).unwrap(),
        circle.elevate(3).unwrap(),
    ];
    let (left, right) = circle.split(0.4).unwrap();
    let pieces = circle.bezier_segments();
    assert_eq!(pieces.len(), 4);
    for k in 0..=60 {
        let u = f64::from(k) / 60.0;
        let p = circle.point(u);
        for curve in &same {
            assert!(curve.point(u).distance(p) < 1e-14);
        }
        let part = if u <= 0.4 { &left } else { &right };
        assert!(part.point(u).distance(p) < 1e-14);
        assert!(circle.reversed().point(1.0 - u).distance(p) < 1e-14);
        let piece = pieces
            .iter()
            .find(|c| c.domain().0 <= u && u <= c.domain().1)
            .unwrap();
        assert!(piece.point(u).distance(p) < 1e-14);
    }
}

#[test]
fn a_ruled_surface_between_unlike_curves_is_straight_across() {
    let ends = vec![DVec3::new(3.0, 0.0, 5.0), DVec3::new(-3.0, 1.0, 6.0)];
    let line = Curve::new(KnotVector::uniform(1, 2).unwrap(), ends).unwrap();
    let circle = circle(3.0);
    let ruled = Surface::ruled(&circle, &line).unwrap();
    for k in 0..=20 {
        let v = f64::from(k) / 20.0;
        assert!(ruled.point(0.0, v).distance(circle.point(v)) < 1e-14);
        assert!(ruled.point(1.0, v).distance(line.point(v)) < 1e-14);
        // The weights of both edges vary alike only at u = 0 and 1; between, the point stays on the chord.
        let (a, b) = (circle.point(v), line.point(v));
        let across = ruled.point(0.3, v) - a;
        assert!(across.cross(b - a).length() < 1e-12);
    }
}
