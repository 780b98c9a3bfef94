#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod shapes;

use std::f64::consts::PI;

use glam::DVec3;
use shapes::{ball, block, crescent, drum, slab};

use super::*;

const ANGLE: f64 = 0.3;

fn made(tables: &Tables, chord: f64) -> Mesh {
    let fineness = Fineness {
        chord,
        angle: ANGLE,
    };
    triangulate(tables, &fineness).unwrap_or_else(|error| panic!("{error}"))
}

fn all(mesh: &Mesh) -> Vec<Used> {
    (0..mesh.faces.len()).map(|face| (face, false)).collect()
}

/// Places in the triangles of a face: corners, middles of sides, and others.
fn samples(mesh: &Mesh, face: usize) -> impl Iterator<Item = DVec3> + '_ {
    const SHARES: [[f64; 3]; 7] = [
        [1.0, 0.0, 0.0],
        [0.5, 0.5, 0.0],
        [0.0, 0.5, 0.5],
        [0.5, 0.0, 0.5],
        [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
        [0.7, 0.2, 0.1],
        [0.1, 0.25, 0.65],
    ];
    let face = &mesh.faces[face];
    face.triangles.iter().flat_map(move |corners| {
        let points = corners.map(|corner| mesh.points[face.corners[corner].point]);
        SHARES.map(|shares| {
            points
                .iter()
                .zip(shares)
                .map(|(point, share)| *point * share)
                .sum()
        })
    })
}

#[test]
fn a_block_is_twelve_triangles_and_encloses_the_product_of_its_sides() {
    let size = DVec3::new(10_000.0, 50.0, 2.0);
    for corner in [DVec3::ZERO, DVec3::new(456_000.0, 6_782_000.0, -2000.0)] {
        let mesh = made(&block(corner, size), 1.0);
        let counts = mesh.closed(&all(&mesh)).unwrap();
        assert_eq!(
            (
                counts.points,
                counts.triangles,
                counts.euler(),
                counts.touching
            ),
            (8, 12, 2, 0)
        );
        let volume = mesh.volume(&all(&mesh));
        assert!((volume / 1e6 - 1.0).abs() < 1e-12, "{volume}");
    }
}

#[test]
fn a_ball_between_poles_and_along_a_seam_closes_and_misses_its_volume_by_the_square_of_its_sides() {
    let radius = 7.0;
    let exact = 4.0 / 3.0 * PI * radius * radius * radius;
    let mut errors = Vec::new();
    for chord in [0.08, 0.02, 0.005] {
        let tables = ball(DVec3::new(3.0, -2.0, 100.0), radius);
        let mesh = made(&tables, chord);
        let counts = mesh.closed(&all(&mesh)).unwrap();
        assert_eq!((counts.euler(), counts.touching), (2, 0));
        let volume = mesh.volume(&all(&mesh));
        assert!(
            volume < exact && exact - volume < chord * 4.0 * PI * radius * radius,
            "{volume}"
        );
        errors.push(exact - volume);
        let centre = DVec3::new(3.0, -2.0, 100.0);
        for point in samples(&mesh, 0) {
            let off = (point.distance(centre) - radius).abs();
            assert!(off <= chord, "{off} at {point}, chord {chord}");
        }
        for corner in &mesh.faces[0].corners {
            let outward = (mesh.points[corner.point] - centre) / radius;
            assert!(
                corner.normal.distance(outward) < 1e-2,
                "{} at {outward}",
                corner.normal
            );
        }
    }
    // The chord is as the square of a side, so a quarter of the chord is about a quarter of the error.
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.2..3.2).contains(&order), "{errors:?}");
    }
}

#[test]
fn sides_of_a_large_tolerance_still_turn_by_no_more_than_the_angle() {
    let tables = ball(DVec3::ZERO, 1.0);
    let mesh = made(&tables, 50.0);
    let face = &mesh.faces[0];
    let mut sharpest = 1.0_f64;
    for corners in &face.triangles {
        for k in 0..3 {
            let [a, b] = [corners[k], corners[(k + 1) % 3]]
                .map(|corner| mesh.points[face.corners[corner].point]);
            sharpest = sharpest.min(a.dot(b));
        }
    }
    assert!(sharpest.acos() <= ANGLE + 1e-9, "{}", sharpest.acos());
    let volume = mesh.volume(&all(&mesh));
    assert!(volume > 0.95 * 4.0 / 3.0 * PI, "{volume}");
}

#[test]
fn a_drum_with_and_without_a_hole_has_the_points_of_a_ball_and_of_a_ring() {
    for (hole, euler) in [(None, 2), (Some(2.0), 0)] {
        let (radius, height, chord) = (5.0_f64, 3.0, 0.01);
        let tables = drum(radius, hole, height);
        let mesh = made(&tables, chord);
        let counts = mesh.closed(&all(&mesh)).unwrap();
        assert_eq!((counts.euler(), counts.touching), (euler, 0));
        let inner = hole.unwrap_or(0.0_f64);
        let exact = PI * (radius * radius - inner * inner) * height;
        let volume = mesh.volume(&all(&mesh));
        let skin = 2.0 * PI * (radius + inner) * height;
        assert!((volume - exact).abs() < chord * skin, "{volume} {exact}");
    }
}

#[test]
fn a_crescent_much_thinner_than_the_tolerance_keeps_its_sides_in_order() {
    // Between two circles through the same two points; the inner one bows as far as the outer one to within a millimetre.
    for gap in [1.0, 0.1, 1e-3] {
        let tables = crescent(100.0, 20.0, gap, 4.0);
        let mesh = made(&tables, 1.0);
        let counts = mesh.closed(&all(&mesh)).unwrap();
        assert_eq!((counts.euler(), counts.touching), (2, 0), "{gap}");
        assert!(mesh.volume(&all(&mesh)) > 0.0, "{gap}");
        // All triangles of the two flat faces look their way.
        for (face, up) in [(0, -1.0), (1, 1.0)] {
            let own = &mesh.faces[face];
            assert!(!own.triangles.is_empty());
            for corners in &own.triangles {
                let [a, b, c] = corners.map(|corner| mesh.points[own.corners[corner].point]);
                assert!((b - a).cross(c - a).z * up > 0.0, "{gap}: {a} {b} {c}");
            }
        }
    }
}

#[test]
fn a_slab_that_is_thinner_than_the_tolerance_is_not_flat() {
    let (width, length, depth) = (200.0, 1000.0, 0.5);
    let tables = slab(width, length, depth);
    let mut errors = Vec::new();
    // Base and top meet in the two long rims: sides from rim to rim would be common to both.
    for chord in [5.0, 0.1, 0.025] {
        let mesh = made(&tables, chord);
        let counts = mesh.closed(&all(&mesh)).unwrap();
        assert_eq!((counts.euler(), counts.touching), (2, 0));
        let volume = mesh.volume(&all(&mesh));
        let exact = 2.0 / 3.0 * width * depth * length;
        assert!(volume > 0.3 * exact, "{volume} of {exact}");
        errors.push(exact - volume);
    }
    assert!(errors[2] < 0.5 * errors[1], "{errors:?}");
}

#[test]
fn a_face_that_divides_a_shared_edge_elsewhere_leaves_a_gap_that_is_found() {
    let tables = drum(5.0, None, 3.0);
    let mut mesh = made(&tables, 0.05);
    mesh.closed(&all(&mesh)).unwrap();
    // A point of its own in the place of a shared one: nothing moves, and yet nothing fits.
    let rim = tables.vertices.len();
    let place = mesh.points[rim];
    mesh.points.push(place);
    let own = mesh.points.len() - 1;
    let corner = mesh.faces[0]
        .corners
        .iter_mut()
        .find(|corner| corner.point == rim)
        .unwrap();
    corner.point = own;
    let open = mesh.closed(&all(&mesh)).unwrap_err();
    assert!(open.from == place || open.to == place, "{open}");
    assert_ne!(open.along, open.back);
}

#[test]
fn triangles_are_the_same_for_any_number_of_threads() {
    let tables = drum(5.0, Some(2.0), 3.0);
    let fineness = Fineness {
        chord: 0.003,
        angle: 0.1,
    };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| triangulate(&tables, &fineness).unwrap())
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(7));
}

#[test]
fn tolerances_that_are_none_and_tables_that_do_not_fit_are_refused() {
    let tables = block(DVec3::ZERO, DVec3::ONE);
    for (chord, angle, what) in [
        (0.0, 0.3, "chord (m)"),
        (f64::NAN, 0.3, "chord (m)"),
        (f64::INFINITY, 0.3, "chord (m)"),
        (1.0, 0.0, "angle (rad)"),
        (1.0, 2.0, "angle (rad)"),
    ] {
        let error = triangulate(&tables, &Fineness { chord, angle }).unwrap_err();
        assert!(
            matches!(error, MeshError::Fineness { what: named, .. } if named == what),
            "{error}"
        );
    }
    let mut broken = tables;
    broken.edges[3].end = 99;
    let error = triangulate(
        &broken,
        &Fineness {
            chord: 1.0,
            angle: 0.3,
        },
    )
    .unwrap_err();
    assert!(error.to_string().contains("edge 3"), "{error}");
}

#[test]
fn a_surface_that_would_need_too_many_points_is_refused_with_its_place() {
    let tables = ball(DVec3::new(1.0, 2.0, 3.0), 10.0);
    let fineness = Fineness {
        chord: 1e-2,
        angle: 0.3,
    };
    assert!(triangulate::triangulate_within(&tables, &fineness, 100_000).is_ok());
    let error = triangulate::triangulate_within(&tables, &fineness, 100).unwrap_err();
    assert!(
        matches!(
            error,
            MeshError::TooMany {
                face: 0,
                most: 100,
                ..
            }
        ),
        "{error}"
    );
}
