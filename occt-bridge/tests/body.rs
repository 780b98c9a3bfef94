//! Bodies from files of other programs: a salt dome in millimetres (build123d 0.12, OpenCASCADE 7.9: a cylinder, a surface of
//! revolution and a plane), a cavern without a unit, and what is no body.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use occt_bridge::{
    BodyError, BodyFormat, BoundaryShape, ShapeKind, Surface, boundary, bounds, read_body, volume,
};

const DOME: &str = include_str!("../../models/salt/salt.step");
const CAVERN: &str = include_str!("../../models/salt/cavern.brep");
const TWO: &str = include_str!("cadquery.step");
const METRES: BodyFormat = BodyFormat::Brep { unit: 1.0 };

/// Ellipsoid of revolution from 0.8 of its half height below its middle to its top, and the stem of 1800 m below.
fn dome_volume() -> f64 {
    // ∫ (1 − s²) ds from −0.8 to 1.
    let bulb = (1.0 - 1.0 / 3.0) - (-0.8 + 0.512 / 3.0);
    PI * (1000.0 * 1000.0 * 500.0 * bulb + 600.0 * 600.0 * 1800.0)
}

#[test]
fn a_body_in_millimetres_is_read_in_metres_with_all_of_its_volume() {
    let body = read_body(DOME.as_bytes(), BodyFormat::Step).unwrap();
    assert_eq!(body.unit.as_deref(), Some("millimetre"));
    assert_eq!(body.faces, 3);
    // The kernel's own integral over a rational spline, asked for 1e-9, does not do better.
    let found = volume(&body.shape, 1e-9).unwrap() / dome_volume();
    assert!(
        (found - 1.0).abs() < 3e-7 && (body.volume / dome_volume() - 1.0).abs() < 3e-7,
        "{found}"
    );
    let size = bounds(&body.shape).unwrap();
    assert!((size.max[2] + 900.0).abs() < 1e-3 && (size.min[2] + 3600.0).abs() < 1e-3);
    assert_eq!(body.shape.kind().unwrap(), ShapeKind::Solid);
    // The edge between stem and bulb, as it was written.
    assert!(body.tolerance < 1e-5, "{}", body.tolerance);
}

#[test]
fn taken_apart_its_surfaces_are_planes_and_splines() {
    for (bytes, format, planes) in [(DOME, BodyFormat::Step, 1), (CAVERN, METRES, 0)] {
        let body = read_body(bytes.as_bytes(), format).unwrap();
        let tables = boundary(&[body.shape]).unwrap();
        let is_plane = |surface: &&Surface| matches!(surface, Surface::Plane { .. });
        assert_eq!(tables.surfaces.iter().filter(is_plane).count(), planes);
        assert_eq!(tables.surfaces.len(), 3);
        assert!(matches!(&tables.shapes[..], [BoundaryShape::Solid(shells)] if shells.len() == 1));
    }
}

#[test]
fn numbers_without_a_unit_are_in_the_one_that_is_said() {
    let exact = PI * 1600.0 * (200.0 + 2.0 * 30.0 / 3.0);
    for unit in [1.0, 0.3048] {
        let body = read_body(CAVERN.as_bytes(), BodyFormat::Brep { unit }).unwrap();
        assert!((body.volume / (exact * unit * unit * unit) - 1.0).abs() < 1e-9);
        assert_eq!(body.unit, None);
    }
}

#[test]
fn a_body_is_made_larger_turned_and_moved_in_this_order() {
    let shape = read_body(CAVERN.as_bytes(), METRES).unwrap().shape;
    let moved = shape.placed(2.0, PI / 2.0, [500.0, -300.0, 10.0]).unwrap();
    let placed = moved.placed(1.0, PI / 2.0, [0.0; 3]).unwrap();
    // A quarter to the left: (500, −300) comes to lie at (300, 500).
    let (a, b) = (bounds(&placed).unwrap(), 1e-3);
    let expected = [[220.0, 380.0], [420.0, 580.0], [-250.0, 270.0]];
    for (axis, [low, high]) in expected.into_iter().enumerate() {
        let found = [a.min[axis], a.max[axis]];
        assert!(
            (found[0] - low).abs() < b && (found[1] - high).abs() < b,
            "{found:?}"
        );
    }
    assert!(shape.placed(0.0, 0.0, [0.0; 3]).is_err());
}

fn refused(bytes: &str, format: BodyFormat) -> BodyError {
    read_body(bytes.as_bytes(), format).unwrap_err()
}

#[test]
fn what_is_no_body_is_told_with_its_reason() {
    let step = BodyFormat::Step;
    let told = |error: &BodyError| error.to_string();
    let error = refused("solid made of words\n", step);
    assert!(matches!(error, BodyError::Unreadable(_)), "{error:?}");
    let error = refused(&DOME[..DOME.len() / 2], step);
    assert!(
        matches!(error, BodyError::Unreadable(_) | BodyError::Empty(_)),
        "{error:?}"
    );
    let error = refused("", METRES);
    assert!(matches!(error, BodyError::Unreadable(_)), "{error:?}");
    let error = refused(DOME, METRES);
    assert!(matches!(error, BodyError::Unreadable(_)), "{error:?}");
    let error = refused(TWO, step);
    assert!(
        matches!(error, BodyError::Several(_)) && told(&error) == "it holds 2 solids",
        "{error:?}"
    );
    // Without the floor of the stem.
    let shell = DOME
        .lines()
        .find(|line| line.contains("CLOSED_SHELL"))
        .unwrap();
    let faces = shell.split_once("(#").unwrap().1.trim_end_matches("));");
    let last = faces.rsplit_once(',').unwrap().1;
    let open = DOME.replace(&format!(",{last}));"), "));");
    assert_ne!(open, DOME);
    let error = refused(&open, step);
    assert!(matches!(error, BodyError::Open(_)), "{error:?}");
    assert!(
        told(&error).contains("1 edge has a face on one side only, one near ("),
        "{error}"
    );
}

#[test]
fn what_is_periodic_comes_back_clamped_and_as_long() {
    let body = read_body(DOME.as_bytes(), BodyFormat::Step).unwrap();
    let tables = boundary(&[body.shape]).unwrap();
    for surface in &tables.surfaces {
        let Surface::BSpline {
            degree_u,
            knots_u,
            poles,
            knots_v,
            degree_v,
            ..
        } = surface
        else {
            continue;
        };
        assert!(knots_u[..=*degree_u].iter().all(|knot| *knot == knots_u[0]));
        assert_eq!(knots_u[0], 0.0);
        let last = knots_u[knots_u.len() - 1];
        assert!((last - 2.0 * PI).abs() < 1e-9, "{last}");
        // Both ends are one curve.
        let columns = knots_v.len() - degree_v - 1;
        let (first, end) = (&poles[..columns], &poles[poles.len() - columns..]);
        for (a, b) in first.iter().zip(end) {
            assert!(
                (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-9),
                "{a:?} {b:?}"
            );
        }
    }
}
