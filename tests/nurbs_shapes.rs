//! Curves and surfaces against closed forms: circle, parabola, sphere, and the net of J19 Fig. 3.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "shapes/surfaces.rs"]
mod surfaces;

use clinothem::nurbs::interpolate::{self, Parametrization};
use clinothem::nurbs::{Curve, KnotVector, Surface};
use glam::DVec3;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The circle of radius r about the z axis.
fn circle(r: f64) -> Curve {
    surfaces::moved(&surfaces::circle(), |p| r * p)
}

/// The sphere of radius r about the origin.
fn sphere(r: f64) -> Surface {
    surfaces::mapped(&[surfaces::sphere()], |p| r * p).remove(0)
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

#[test]
fn the_net_of_figure_3_is_smoother_at_degree_3_than_at_degree_2() {
    // How far a derivative jumps where pieces meet, from both sides of the knot.
    let jump = |surface: &Surface, order: usize| {
        let knots = surface.knots_u().distinct();
        let at = |u: f64| surface.derivatives(u, 0.3, order)[order][0];
        let inner = &knots[1..knots.len() - 1];
        inner
            .iter()
            .map(|k| at(k.0 + 1e-9).distance(at(k.0 - 1e-9)))
            .fold(0.0, f64::max)
    };
    let (coarse, smooth) = (fig3(2), fig3(3));
    assert!(jump(&coarse, 1) < 1e-4 && jump(&coarse, 2) > 10.0);
    assert!(jump(&smooth, 1) < 1e-4 && jump(&smooth, 2) < 1e-3 && jump(&smooth, 3) > 10.0);
    assert_eq!(smooth.knots_u().as_slice().len(), 10);
    assert_eq!(smooth.knots_v().as_slice().len(), 8);
}

#[test]
fn a_surface_may_overhang() {
    let surface = fig3(2);
    let mut net = surface.net().to_vec();
    // Pull one row of control points back over its neighbour.
    for point in &mut net[12..16] {
        point.x -= 25.0;
    }
    let (u, v) = (surface.knots_u().clone(), surface.knots_v().clone());
    let surface = Surface::new(u, v, net).unwrap();
    let forward = (0..=100).map(|k| surface.derivatives(f64::from(k) / 100.0, 0.5, 1)[1][0].x);
    let turns = forward
        .collect::<Vec<_>>()
        .windows(2)
        .filter(|x| x[0] * x[1] < 0.0)
        .count();
    assert_eq!(turns, 2);
}

#[test]
fn three_control_points_are_exactly_a_parabola() {
    // z = -D (1 - (2y/W)²): the section of a channel with control points at twice the depth.
    let (width, depth) = (50.0, 4.4);
    let points = vec![
        DVec3::new(0.0, -0.5 * width, 0.0),
        DVec3::new(0.0, 0.0, -2.0 * depth),
        DVec3::new(0.0, 0.5 * width, 0.0),
    ];
    let curve = Curve::new(KnotVector::uniform(2, 3).unwrap(), points).unwrap();
    let z = |y: f64| -depth * (1.0 - (2.0 * y / width).powi(2));
    for k in 0..=40 {
        let u = f64::from(k) / 40.0;
        let derivatives = curve.derivatives(u, 3);
        let y = derivatives[0].y;
        assert!((derivatives[0].z - z(y)).abs() < 1e-14 * width);
        assert!(
            (derivatives[1].z / derivatives[1].y - 8.0 * depth * y / width.powi(2)).abs() < 1e-14
        );
        assert_eq!(derivatives[3], DVec3::ZERO);
    }
    assert_eq!(
        curve.bounds(),
        (DVec3::new(0.0, -25.0, -4.4), DVec3::new(0.0, 25.0, 0.0))
    );
    // Arc length of a parabola: with q = 4D/W, W/2 (√(1+q²) + asinh(q)/q).
    let q = 4.0 * depth / width;
    let length = 0.5 * width * ((1.0 + q * q).sqrt() + q.asinh() / q);
    assert!((curve.length(1e-10) - length).abs() < 1e-10);
}

#[test]
fn a_quarter_of_an_ellipse_has_the_middle_weight_one_over_root_two() {
    let (a, b) = (3000.0, 6000.0);
    let points = vec![
        DVec3::new(a, 0.0, 0.0),
        DVec3::new(a, b, 0.0),
        DVec3::new(0.0, b, 0.0),
    ];
    let weights = vec![1.0, FRAC_1_SQRT_2, 1.0];
    let curve = Curve::rational(KnotVector::uniform(2, 3).unwrap(), points, weights).unwrap();
    for k in 0..=40 {
        let p = curve.point(f64::from(k) / 40.0);
        assert!(((p.x / a).powi(2) + (p.y / b).powi(2) - 1.0).abs() < 1e-14);
    }
    // At the vertex (0, b) the radius of curvature is a²/b.
    let derivatives = curve.derivatives(1.0, 2);
    let curvature = derivatives[1].cross(derivatives[2]).length() / derivatives[1].length().powi(3);
    assert!((curvature - b / (a * a)).abs() < 1e-15);
}

#[test]
fn a_circle_is_as_long_as_two_pi_radii_and_as_wide_as_two() {
    let turn = glam::DMat3::from_euler(glam::EulerRot::XYZ, 0.5, 1.1, -0.4);
    let flat = circle(7.0);
    let points = flat.points().iter().map(|&p| turn * p + 100.0).collect();
    let tilted = Curve::rational(flat.knots().clone(), points, flat.weights().to_vec()).unwrap();
    assert!((tilted.length(1e-9) - 14.0 * PI).abs() < 1e-9);
    // The half-width of a tilted circle along an axis is the radius times the sine of the axis's angle to the normal.
    let half = DVec3::from_array(turn.z_axis.to_array().map(|n| 7.0 * (1.0 - n * n).sqrt()));
    let (low, high) = tilted.bounds();
    assert!(
        (low - (100.0 - half)).abs().max_element() < 1e-7 && low.cmple(100.0 - half + 1e-12).all()
    );
    assert!(
        (high - (100.0 + half)).abs().max_element() < 1e-7
            && high.cmpge(100.0 + half - 1e-12).all()
    );
}

#[test]
fn the_closest_point_of_a_circle_is_straight_outwards() {
    let circle = circle(7.0);
    for k in 0..50 {
        let angle = 0.1 + 0.13 * f64::from(k);
        let outwards = DVec3::new(angle.cos(), angle.sin(), 0.0);
        for distance in [0.5, 6.9, 7.0, 7.1, 50.0] {
            let closest = circle.closest(distance * outwards + 2.0 * DVec3::Z, 1e-10);
            assert!(
                closest.point.distance(7.0 * outwards) < 1e-6,
                "{angle} {distance}"
            );
            assert!((closest.distance - (distance - 7.0_f64).hypot(2.0)).abs() < 1e-10);
        }
    }
    // From the axis every point is as near as the next.
    assert!((circle.closest(2.0 * DVec3::Z, 1e-10).distance - 7.0_f64.hypot(2.0)).abs() < 1e-10);
}

#[test]
fn inversion_finds_the_parameter_that_was_evaluated() {
    let circle = circle(7.0);
    for k in 0..=97 {
        let u = f64::from(k) / 100.0;
        let found = circle.invert(circle.point(u), 1e-9).unwrap();
        assert!((found - u).abs() < 1e-9 || u == 0.0, "{u} {found}");
    }
    let surface = fig3(3);
    for k in 0..=100 {
        let (u, v) = (f64::from(k) / 100.0, f64::from(k * 37 % 101) / 100.0);
        let found = surface.invert(surface.point(u, v), 1e-9).unwrap();
        assert!(
            (found.0 - u).abs() < 1e-9 && (found.1 - v).abs() < 1e-9,
            "{u} {v} {found:?}"
        );
        // A little off along the normal the parameters are the same and the distance is the offset.
        let off = surface.point(u, v) + 0.01 * surface.normal(u, v).unwrap();
        let closest = surface.closest(off, 1e-10);
        assert!((closest.distance - 0.01).abs() < 1e-9);
        assert!((closest.parameters.0 - u).abs() < 1e-5 && (closest.parameters.1 - v).abs() < 1e-5);
        assert_eq!(surface.invert(off, 1e-3), None);
    }
}

#[test]
fn a_sphere_has_its_radius_its_normals_and_its_box() {
    let sphere = sphere(5.0);
    for i in 0..=40 {
        for j in 0..=20 {
            let (u, v) = (f64::from(i) / 40.0, f64::from(j) / 20.0);
            let p = sphere.point(u, v);
            assert!((p.length() - 5.0).abs() < 1e-14 * 5.0);
            // Outwards everywhere, also at the poles, where a whole edge is one point.
            assert!(
                sphere.normal(u, v).unwrap().distance(p / 5.0) < 1e-9,
                "{u} {v}"
            );
        }
    }
    let (low, high) = sphere.bounds();
    assert!((low + 5.0).abs().max_element() < 1e-7 && (high - 5.0).abs().max_element() < 1e-7);
    // The centre is as far from every point: the search must not go through them all.
    assert!((sphere.closest(DVec3::ZERO, 1e-9).distance - 5.0).abs() < 1e-9);
    assert!(
        (sphere.closest(DVec3::new(1.0, 2.0, 8.0), 1e-9).distance - (69.0_f64.sqrt() - 5.0)).abs()
            < 1e-9
    );
}

#[test]
fn swapping_u_and_v_or_running_one_backwards_turns_the_normal_over() {
    let surface = fig3(3);
    let normal = surface.normal(0.3, 0.7).unwrap();
    for turned in [
        surface.transposed().normal(0.7, 0.3),
        surface.reversed_u().normal(0.7, 0.7),
        surface.reversed_v().normal(0.3, 0.3),
    ] {
        assert!(turned.unwrap().distance(-normal) < 1e-12);
    }
    assert_eq!(surface.transposed().transposed(), surface);
}

#[test]
fn a_tangent_is_found_even_where_control_points_coincide() {
    let (a, b) = (DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0));
    let knots = KnotVector::uniform(3, 4).unwrap();
    let curve = Curve::new(knots.clone(), vec![a, a, b, b]).unwrap();
    for u in [0.0, 0.5, 1.0] {
        assert!(
            curve
                .tangent(u)
                .unwrap()
                .distance(DVec3::new(0.6, 0.8, 0.0))
                < 1e-12
        );
    }
    assert_eq!(Curve::new(knots, vec![a; 4]).unwrap().tangent(0.5), None);
}

#[test]
fn edges_of_a_surface_are_its_outer_control_points_to_the_last_bit() {
    let surface = fig3(3);
    assert_eq!(surface.isocurve_u(0.0).points(), &surface.net()[..4]);
    assert_eq!(surface.isocurve_u(1.0).points(), &surface.net()[20..]);
    let last: Vec<DVec3> = surface.net().iter().skip(3).step_by(4).copied().collect();
    assert_eq!(surface.isocurve_v(1.0).points(), last);
    let ruled = Surface::ruled(&surface.isocurve_u(0.0), &surface.isocurve_u(1.0)).unwrap();
    assert_eq!(
        ruled.isocurve_u(1.0).points(),
        surface.isocurve_u(1.0).points()
    );
    assert_eq!((ruled.knots_u().degree(), ruled.knots_v().degree()), (1, 3));
}

#[test]
fn interpolation_of_a_cubic_with_its_own_parameters_gives_the_cubic_back() {
    // The chord lengths of evenly spaced points on a line are even, and a line is every spline's special case.
    let line: Vec<DVec3> = (0..9)
        .map(|k| DVec3::new(2.0, -1.0, 5.0) * f64::from(k))
        .collect();
    let curve = interpolate::curve(&line, 3, Parametrization::ChordLength).unwrap();
    for k in 0..=32 {
        let u = f64::from(k) / 32.0;
        assert!(curve.point(u).distance(DVec3::new(16.0, -8.0, 40.0) * u) < 1e-13 * 45.0);
    }
    // Four points fix one cubic: the polynomial through (k, k³) is the cube itself.
    let params = [0.0, 1.0, 2.5, 4.0];
    let cube = |t: f64| DVec3::new(t, t * t * t, -t * t);
    let rows = vec![params.map(cube).to_vec(), params.map(DVec3::splat).to_vec()];
    let (knots, rows) = interpolate::with_parameters(&rows, &params, 3).unwrap();
    let curve = Curve::new(knots, rows[0].clone()).unwrap();
    for k in 0..=16 {
        let t = 0.25 * f64::from(k);
        assert!(curve.point(t).distance(cube(t)) < 1e-12 * 64.0);
    }
}

#[test]
fn the_parameters_and_averaged_knots_are_those_of_the_nurbs_book() {
    // PT97 Ex. 9.1: points (0,0) (3,4) (-1,4) (-4,0) (-4,-3); chords 5, 4, 5, 3; knot 28/51.
    let points = [(0, 0), (3, 4), (-1, 4), (-4, 0), (-4, -3)]
        .map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0));
    let params = interpolate::parameters(&points, Parametrization::ChordLength).unwrap();
    for (u, expected) in params
        .iter()
        .zip([0.0, 5.0 / 17.0, 9.0 / 17.0, 14.0 / 17.0, 1.0])
    {
        assert!((u - expected).abs() < 1e-15);
    }
    let knots = interpolate::averaged_knots(3, &params).unwrap();
    assert!((knots.as_slice()[4] - 28.0 / 51.0).abs() < 1e-15);
    let params = interpolate::parameters(&points, Parametrization::Centripetal).unwrap();
    let roots = [0.0, 5.0_f64.sqrt(), 2.0, 5.0_f64.sqrt(), 3.0_f64.sqrt()];
    assert!((params[2] - (roots[1] + roots[2]) / roots.iter().sum::<f64>()).abs() < 1e-15);
}
