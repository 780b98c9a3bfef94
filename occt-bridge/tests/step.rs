//! STEP files of another program: a box of 2 × 3 × 4 mm and a pin, 1 mm in radius and 5 mm long, by
//! cadquery 2.8 (OpenCASCADE 7.9). What our own writer makes is read
//! in the tests of the main package.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::path::Path;

use occt_bridge::{BridgeError, ShapeKind, Surface, boundary, bounds, read_step, volume};

#[test]
fn another_programs_file_in_millimetres_is_read_in_metres_with_names_and_colours() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cadquery.step");
    let parts = read_step(&path).unwrap();
    let told: Vec<_> = parts
        .iter()
        .map(|part| (part.path.as_str(), part.name.as_str(), part.color))
        .collect();
    assert_eq!(
        told,
        [
            ("model/box", "box", Some([255, 128, 64])),
            ("model/pin", "pin", None)
        ]
    );
    for (part, exact) in parts.iter().zip([24e-9, 5e-9 * std::f64::consts::PI]) {
        assert_eq!(part.layer, None);
        assert_eq!(part.shape.count(ShapeKind::Solid).unwrap(), 1);
        let found = volume(&part.shape, 1e-9).unwrap();
        assert!((found / exact - 1.0).abs() < 1e-9, "{found} for {exact}");
    }
    // Where it is in the assembly.
    let pin = bounds(&parts[1].shape).unwrap();
    assert!((pin.max[0] - 11e-3).abs() < 1e-6, "{pin:?}");
}

#[test]
fn a_cylinder_by_its_radius_is_taken_apart_as_a_spline_around_its_axis() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cadquery.step");
    let parts = read_step(&path).unwrap();
    assert_eq!(boundary(&[parts[0].shape.clone()]).unwrap().faces.len(), 6);
    let tables = boundary(&[parts[1].shape.clone()]).unwrap();
    let side = tables.surfaces.iter().find_map(|surface| match surface {
        Surface::BSpline { poles, weights, .. } => Some((poles, weights)),
        Surface::Plane { .. } => None,
    });
    let (poles, weights) = side.unwrap();
    assert_eq!(*weights, None);
    // The axis is at x = 10 mm; control points lie a little outside of the circle, its first one on it.
    let radius = |p: &[f64; 3]| (p[0] - 0.01).hypot(p[1]) / 1e-3;
    assert!(
        poles
            .iter()
            .all(|p| (1.0 - 1e-11..1.01).contains(&radius(p)))
    );
    assert!((radius(&poles[0]) - 1.0).abs() < 1e-11);
    let edges = tables.edges.iter().filter(|edge| edge.start == edge.end);
    assert_eq!(edges.count(), 2);
}

#[test]
fn what_is_no_step_file_is_an_io_error_that_names_it() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.step");
    fs::write(&path, "not STEP at all\n").unwrap();
    for path in [Path::new("/nonexistent/a.step"), &path] {
        let error = read_step(path).unwrap_err();
        assert!(matches!(error, BridgeError::Io { .. }), "{error:?}");
        assert!(error.to_string().contains("a.step"), "{error}");
    }
}
