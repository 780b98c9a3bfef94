//! Point in closed shell, against solids whose inside is known exactly.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "shapes/surfaces.rs"]
mod surfaces;

use clinothem::nurbs::enclosure::{Enclosure, EnclosureError, Side};
use clinothem::nurbs::interpolate;
use clinothem::nurbs::{Curve, KnotVector, Surface};
use glam::{DMat3, DVec2, DVec3};
use proptest::prelude::*;
use std::f64::consts::TAU;
use surfaces::{circle, cuboid, mapped, moved, revolved};

/// A fixed sequence of points in a box, spread evenly (the R3 sequence of the plastic number's cousin).
fn scattered(count: usize, low: DVec3, high: DVec3) -> impl Iterator<Item = DVec3> {
    let g = 1.220_744_084_605_759_5_f64;
    let step = DVec3::new(1.0 / g, 1.0 / (g * g), 1.0 / (g * g * g));
    (1..=count).map(move |k| low + (high - low) * (0.5 + step * k as f64).fract())
}

fn sphere(place: impl Fn(DVec3) -> DVec3) -> Surface {
    mapped(&[surfaces::sphere()], place).remove(0)
}

fn torus(major: f64, minor: f64) -> Surface {
    let round = circle();
    let points = round.points().iter().zip(round.weights());
    let profile: Vec<_> = points
        .map(|(p, w)| (major + minor * p.x, minor * p.y, *w))
        .collect();
    revolved(&profile, round.knots().as_slice().to_vec())
}

fn box_shell(size: DVec3, place: impl Fn(DVec3) -> DVec3) -> Vec<Surface> {
    mapped(&cuboid(DVec3::ZERO, size), place)
}

#[test]
fn a_sphere_holds_the_points_nearer_than_its_radius() {
    let shell = Enclosure::new(vec![sphere(|p| 10.0 * p)]).unwrap();
    for p in scattered(20_000, DVec3::splat(-11.0), DVec3::splat(11.0)) {
        assert_eq!(shell.contains(p), p.length() < 10.0, "{p}");
    }
    // Above and below the poles, on the seam and on the circles where patches meet.
    for (p, inside) in [
        (DVec3::new(0.0, 0.0, 9.0), true),
        (DVec3::new(0.0, 0.0, -9.0), true),
        (DVec3::new(0.0, 0.0, -11.0), false),
        (DVec3::new(5.0, 0.0, -5.0), true),
        (DVec3::new(5.0, 0.0, -9.0), false),
        (DVec3::new(10.0, 0.0, -5.0), false),
        (DVec3::new(0.0, 0.0, 0.0), true),
    ] {
        assert_eq!(shell.contains(p), inside, "{p}");
    }
}

#[test]
fn points_a_millionth_of_the_radius_off_a_tilted_ellipsoid_are_on_the_right_side() {
    let tilt = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, -0.7, 1.1);
    let axes = DVec3::new(40.0, 15.0, 4.0);
    let centre = DVec3::new(412_300.0, 6_753_000.0, -2_000.0);
    let shell = Enclosure::new(vec![sphere(|p| centre + tilt * (axes * p))]).unwrap();
    for p in scattered(10_000, DVec3::splat(-1.0), DVec3::splat(1.0)) {
        let on = p.normalize();
        for (factor, inside) in [(1.0 - 1e-6, true), (1.0 + 1e-6, false)] {
            assert_eq!(
                shell.contains(centre + tilt * (axes * on * factor)),
                inside,
                "{on} {factor}"
            );
        }
    }
}

#[test]
fn a_torus_holds_the_points_near_its_core_and_none_in_its_hole() {
    let shell = Enclosure::new(vec![torus(10.0, 3.0)]).unwrap();
    let inside = |p: DVec3| DVec2::new(DVec2::new(p.x, p.y).length() - 10.0, p.z).length() < 3.0;
    for p in scattered(
        20_000,
        DVec3::new(-14.0, -14.0, -4.0),
        DVec3::new(14.0, 14.0, 4.0),
    ) {
        assert_eq!(shell.contains(p), inside(p), "{p}");
    }
}

#[test]
fn a_box_holds_its_inside_whichever_way_it_lies() {
    let size = DVec3::new(100.0, 30.0, 7.0);
    let turn = DMat3::from_euler(glam::EulerRot::ZYX, 0.4, 0.9, 0.2);
    for turn in [DMat3::IDENTITY, turn, DMat3::from_rotation_z(0.7)] {
        let shell = Enclosure::new(box_shell(size, |p| turn * p)).unwrap();
        for p in scattered(5_000, -0.2 * size, 1.2 * size) {
            let inside = p.cmpgt(DVec3::ZERO).all() && p.cmplt(size).all();
            assert_eq!(shell.contains(turn * p), inside, "{p}");
        }
    }
}

#[test]
fn a_grid_that_lies_on_a_box_finds_its_faces_edges_and_corners_inside() {
    let size = DVec3::new(4.0, 3.0, 2.0);
    let shell = Enclosure::new(box_shell(size, |p| p)).unwrap();
    for x in -1..=5 {
        for y in -1..=4 {
            for z in -1..=3 {
                let p = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                let inside = p.cmpge(DVec3::ZERO).all() && p.cmple(size).all();
                assert_eq!(shell.contains(p), inside, "{p}");
            }
        }
    }
}

/// A channel-like body: section y(w), depth; a sinuous centre line; the banks overhang by the given factor.
fn channel(overhang: f64, stations: usize) -> Vec<Surface> {
    let section: Vec<(f64, f64)> = vec![
        (-30.0, 0.0),
        (-30.0 - 20.0 * overhang, -4.0),
        (-6.0, -9.0),
        (0.0, -9.0),
        (6.0, -9.0),
        (30.0 + 20.0 * overhang, -4.0),
        (30.0, 0.0),
    ];
    let along: Vec<f64> = (0..stations)
        .map(|k| k as f64 / (stations - 1) as f64)
        .collect();
    let place = |s: f64, across: f64, z: f64| {
        let x = 2000.0 * s;
        let y = 120.0 * (TAU * 2.5 * s).sin();
        let slope = 120.0 * TAU * 2.5 / 2000.0 * (TAU * 2.5 * s).cos();
        let normal = DVec2::new(-slope, 1.0).normalize();
        DVec3::new(x + across * normal.x, y + across * normal.y, z + 0.001 * x)
    };
    let rows: Vec<Vec<DVec3>> = section
        .iter()
        .map(|&(across, z)| along.iter().map(|&s| place(s, across, z)).collect())
        .collect();
    let (v, rows) = interpolate::with_parameters(&rows, &along, 3).unwrap();
    let u = KnotVector::uniform(3, section.len()).unwrap();
    closed(Surface::new(u, v, rows.concat()).unwrap())
}

/// A base with its ruled top and two end caps.
fn closed(base: Surface) -> Vec<Surface> {
    let top = Surface::ruled(&base.isocurve_u(0.0), &base.isocurve_u(1.0)).unwrap();
    let caps = [0.0, 1.0].map(|s| Surface::ruled(&base.isocurve_v(s), &top.isocurve_v(s)).unwrap());
    let [first, last] = caps;
    vec![base, top, first, last]
}

/// The winding number of a fine triangulation of the shell: the oracle knows nothing of rays.
fn winding(triangles: &[[DVec3; 3]], p: DVec3) -> f64 {
    let solid_angle = |&[a, b, c]: &[DVec3; 3]| {
        let (a, b, c) = (a - p, b - p, c - p);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    triangles.iter().map(solid_angle).sum::<f64>() / (2.0 * TAU)
}

fn triangulated(surface: &Surface, nu: usize, nv: usize, flip: bool) -> Vec<[DVec3; 3]> {
    let at = |i: usize, j: usize| surface.point(i as f64 / nu as f64, j as f64 / nv as f64);
    let mut triangles = Vec::new();
    for i in 0..nu {
        for j in 0..nv {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            let [x, y] = [[a, b, c], [a, c, d]];
            let turn = |[a, b, c]: [DVec3; 3]| if flip { [a, c, b] } else { [a, b, c] };
            triangles.extend([turn(x), turn(y)]);
        }
    }
    triangles
}

/// The closed channel as triangles that all face one way: base and top share u, caps run with v.
fn meshed(surfaces: &[Surface]) -> Vec<[DVec3; 3]> {
    let fine = [
        (40, 400, false),
        (1, 400, true),
        (1, 40, false),
        (1, 40, true),
    ];
    let faces = surfaces.iter().zip(fine);
    faces
        .flat_map(|(surface, (nu, nv, flip))| triangulated(surface, nu, nv, flip))
        .collect()
}

#[test]
fn channels_with_and_without_overhanging_banks_agree_with_the_winding_number_of_a_fine_mesh() {
    for overhang in [0.0, 1.0] {
        let surfaces = channel(overhang, 41);
        let triangles = meshed(&surfaces);
        let shell = Enclosure::new(surfaces).unwrap();
        let (low, high) = shell.bounds();
        let mut held = 0;
        for p in scattered(1_500, low, high) {
            let turns = winding(&triangles, p).abs();
            // Where the mesh and the surface may differ, the mesh is no oracle.
            if shell.distance(p, 0.2).is_none() {
                assert!((turns - turns.round()).abs() < 1e-6, "{p} {turns}");
                assert_eq!(shell.contains(p), turns > 0.5, "{p}");
                held += usize::from(turns > 0.5);
            }
        }
        assert!(held > 50, "{held}");
    }
}

#[test]
fn an_open_shell_is_refused_with_its_open_side() {
    let mut surfaces = box_shell(DVec3::ONE, |p| p);
    // The face on top goes; u runs upwards on the first one.
    surfaces.pop();
    let Err(EnclosureError::Open { surface, side, .. }) = Enclosure::new(surfaces) else {
        panic!("an open box is no shell")
    };
    assert_eq!((surface, side), (0, Side::UEnd));
}

#[test]
fn edges_that_run_differently_along_the_same_curve_pair_up() {
    let mut surfaces = box_shell(DVec3::ONE, |p| p);
    surfaces[1] = surfaces[1]
        .elevate_u(1)
        .unwrap()
        .insert_knot_v(0.3, 1)
        .unwrap()
        .reversed_u();
    assert!(Enclosure::new(surfaces).is_ok());
}

#[test]
fn the_distance_to_a_sphere_is_that_to_its_centre_less_the_radius() {
    let shell = Enclosure::new(vec![sphere(|p| 10.0 * p)]).unwrap();
    for p in scattered(300, DVec3::splat(-14.0), DVec3::splat(14.0)) {
        let expected = (p.length() - 10.0).abs();
        match shell.distance(p, 2.0) {
            Some(distance) => assert!((distance - expected).abs() < 1e-7),
            None => assert!(expected >= 2.0 - 1e-7),
        }
    }
}

#[test]
fn a_straight_channel_of_parabolic_section_holds_what_lies_between_parabola_and_top() {
    let (width, depth, length, azimuth) = (50.0, 4.4, 400.0, 0.7_f64);
    let along = DVec3::new(azimuth.sin(), azimuth.cos(), 0.0);
    let across = DVec3::new(azimuth.cos(), -azimuth.sin(), 0.0);
    let section = [(-0.5, 0.0), (0.0, -2.0), (0.5, 0.0)];
    let net = section.iter().flat_map(|&(y, z)| {
        [0.0, 1.0].map(|s| width * y * across + depth * z * DVec3::Z + length * s * along)
    });
    let line = || KnotVector::uniform(1, 2).unwrap();
    let base = Surface::new(KnotVector::uniform(2, 3).unwrap(), line(), net.collect()).unwrap();
    let shell = Enclosure::new(closed(base)).unwrap();
    let (low, high) = shell.bounds();
    for p in scattered(20_000, low, high) {
        let (s, y) = (p.dot(along), p.dot(across));
        let inside =
            s > 0.0 && s < length && p.z < 0.0 && p.z > -depth * (1.0 - (2.0 * y / width).powi(2));
        assert_eq!(shell.contains(p), inside, "{p}");
    }
    // Straight below a rim, on a rim, on the top and next to it.
    for k in 1..40 {
        let s = 10.0 * f64::from(k) * along;
        let rim = s + 0.5 * width * across;
        assert!(!shell.contains(rim - 0.01 * DVec3::Z));
        assert!(!shell.contains(rim + 0.01 * across - 0.001 * DVec3::Z));
        assert!(shell.contains(rim - 0.01 * across - 1e-4 * DVec3::Z));
        assert!(shell.contains(s) && shell.contains(s - 1e-9 * DVec3::Z));
        assert!(!shell.contains(s + 1e-9 * DVec3::Z));
        assert!(
            shell.contains(s - (depth - 1e-9) * DVec3::Z)
                && !shell.contains(s - (depth + 1e-9) * DVec3::Z)
        );
    }
}

#[test]
fn a_tunnel_of_elliptic_section_holds_what_is_within_its_ellipse() {
    // Rational, overhanging over its whole length, closed on itself, with a cap at each end.
    let (a, b, length) = (12.0, 5.0, 80.0);
    let turn = DMat3::from_euler(glam::EulerRot::ZYX, 0.6, 0.05, 0.0);
    let place = |s: f64, x: f64, z: f64| turn * DVec3::new(length * s, a * x, b * z);
    let [start, end] = [0.0, 1.0].map(|s| moved(&circle(), |p| place(s, p.x, p.y)));
    let wall = Surface::ruled(&start, &end).unwrap();
    let caps = [0.0, 1.0].map(|s| {
        let centre = Curve::new(
            KnotVector::uniform(1, 2).unwrap(),
            vec![place(s, 0.0, 0.0); 2],
        )
        .unwrap();
        Surface::ruled(&wall.isocurve_u(s), &centre).unwrap()
    });
    let [first, last] = caps;
    let shell = Enclosure::new(vec![wall, first, last]).unwrap();
    let (low, high) = shell.bounds();
    for p in scattered(20_000, low, high) {
        let own = turn.transpose() * p;
        let inside =
            own.x > 0.0 && own.x < length && (own.y / a).powi(2) + (own.z / b).powi(2) < 1.0;
        assert_eq!(shell.contains(p), inside, "{own}");
    }
    // On the axis, in the planes of the caps' spokes, just inside and outside of each end.
    for s in [-1e-6, 1e-6, 0.5, 1.0 - 1e-6, 1.0 + 1e-6] {
        assert_eq!(
            shell.contains(place(s, 0.0, 0.0)),
            s > 0.0 && s < 1.0,
            "{s}"
        );
    }
}

#[test]
fn points_around_the_rims_of_a_winding_channel_agree_with_a_mesh() {
    let surfaces = channel(0.0, 41);
    let triangles = meshed(&surfaces);
    let shell = Enclosure::new(surfaces.clone()).unwrap();
    for (k, offset) in scattered(400, DVec3::splat(-3.0), DVec3::splat(3.0)).enumerate() {
        // Around the rims, and straight below and above them.
        let rim = surfaces[0].point(f64::from(u8::from(k % 2 == 0)), k as f64 / 400.0);
        for p in [rim + offset, rim + DVec3::Z * offset] {
            if shell.distance(p, 0.1).is_none() {
                assert_eq!(shell.contains(p), winding(&triangles, p).abs() > 0.5, "{p}");
            }
        }
    }
}

#[test]
fn the_answer_does_not_depend_on_orientation_order_or_parameters() {
    let surfaces = channel(1.0, 21);
    let other = vec![
        surfaces[3].elevate_u(1).unwrap(),
        surfaces[0]
            .reversed_u()
            .transposed()
            .insert_knot_u(0.37, 2)
            .unwrap(),
        surfaces[2].reversed_v(),
        surfaces[1].transposed(),
    ];
    let (a, b) = (
        Enclosure::new(surfaces).unwrap(),
        Enclosure::new(other).unwrap(),
    );
    let (low, high) = a.bounds();
    for p in scattered(20_000, low, high) {
        assert_eq!(a.contains(p), b.contains(p), "{p}");
    }
}

#[test]
fn the_same_model_in_millimetres_and_in_kilometres_gives_the_same_answers() {
    let sized = |scale: f64| {
        let scaled = |surface: &Surface| {
            let net = surface.net().iter().map(|&p| p * scale).collect();
            Surface::new(surface.knots_u().clone(), surface.knots_v().clone(), net).unwrap()
        };
        Enclosure::new(channel(1.0, 21).iter().map(scaled).collect()).unwrap()
    };
    let [metres, millimetres, kilometres] = [1.0, 1e3, 1e-3].map(sized);
    let (low, high) = metres.bounds();
    for p in scattered(5_000, low, high) {
        let answer = metres.contains(p);
        assert_eq!(millimetres.contains(1e3 * p), answer, "{p}");
        assert_eq!(kilometres.contains(1e-3 * p), answer, "{p}");
    }
}

#[test]
fn points_far_away_infinite_or_not_numbers_are_outside() {
    let shell = Enclosure::new(vec![sphere(|p| p)]).unwrap();
    for x in [1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert!(!shell.contains(DVec3::new(x, 0.0, 0.0)));
        assert!(!shell.contains(DVec3::new(0.0, 0.0, x)));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn dented_and_twisted_spheres_agree_with_the_winding_number_of_a_fine_mesh(
        pulls in prop::collection::vec((0.6..1.4, -0.25..0.25, -0.25..0.25), 24),
        tilt in -3.0..3.0,
    ) {
        // Move all but the poles, and the seam's two copies alike: 8 columns of 3.
        let ball = sphere(|p| p);
        let turn = DMat3::from_euler(glam::EulerRot::XYZ, tilt, 0.5 * tilt, 0.3);
        let net = ball.net().iter().enumerate().map(|(k, &p)| {
            let (i, j) = ((k / 5) % 8, k % 5);
            let (grow, aside, up) = if (1..4).contains(&j) { pulls[3 * i + j - 1] } else { (1.0, 0.0, 0.0) };
            turn * (p * grow + DVec3::new(aside, -aside, up))
        });
        let (u, v) = (ball.knots_u().clone(), ball.knots_v().clone());
        let ball = Surface::rational(u, v, net.collect(), ball.weights().to_vec()).unwrap();
        let triangles = triangulated(&ball, 64, 48, false);
        let shell = Enclosure::new(vec![ball]).unwrap();
        let (low, high) = shell.bounds();
        for p in scattered(150, low, high) {
            let turns = winding(&triangles, p);
            if shell.distance(p, 0.02).is_none() {
                // The dents may cut through each other: then parity is what counts.
                prop_assert_eq!(shell.contains(p), turns.round().rem_euclid(2.0) == 1.0, "{} {}", p, turns);
            }
        }
    }
}
