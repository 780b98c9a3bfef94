#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::PI;

use super::*;
use crate::mesh::{Edge, Face};

const CIRCLE: [(f64, f64); 9] = [
    (1.0, 0.0),
    (1.0, 1.0),
    (0.0, 1.0),
    (-1.0, 1.0),
    (-1.0, 0.0),
    (-1.0, -1.0),
    (0.0, -1.0),
    (1.0, -1.0),
    (1.0, 0.0),
];

fn around() -> KnotVector {
    let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
    KnotVector::new(2, knots.to_vec()).unwrap()
}

fn weights() -> impl Iterator<Item = f64> {
    (0..9).map(|k| if k % 2 == 0 { 1.0 } else { 0.5_f64.sqrt() })
}

fn rim(z: f64) -> Path {
    let points = CIRCLE.map(|(x, y)| DVec3::new(x, y, z)).to_vec();
    Path::Spline(Curve::rational(around(), points, weights().collect()).unwrap())
}

/// A cylinder of radius 1 from z = 0 to 2 as CAD programs make it: a wall with a seam, a floor and a top on planes.
fn cylinder() -> (Tables, Vec<(usize, bool)>) {
    let net = CIRCLE.iter();
    let net = net.flat_map(|&(x, y)| [0.0, 2.0].map(|z| DVec3::new(x, y, z)));
    let along = KnotVector::new(1, vec![0.0, 0.0, 2.0, 2.0]).unwrap();
    let twice = weights().flat_map(|w| [w; 2]).collect();
    let wall = Surface::rational(around(), along, net.collect(), twice).unwrap();
    let plane = |z: f64| Support::Plane {
        origin: DVec3::new(0.3, 0.2, z),
        x_axis: DVec3::X,
        y_axis: DVec3::Y,
    };
    let line = |origin: [f64; 2], direction: [f64; 2]| Path::Line {
        origin: DVec3::new(origin[0], origin[1], 0.0),
        direction: DVec3::new(direction[0], direction[1], 0.0),
    };
    let edge = |curve: usize, range: [f64; 2], start: usize, end: usize| Edge {
        curve: Some(curve),
        range,
        start,
        end,
    };
    let of = |edge: usize, reversed: bool, pcurve: Option<usize>| Use {
        edge,
        reversed,
        pcurve,
    };
    let face = |surface: usize, uses: Vec<Use>| Face {
        surface,
        loops: vec![uses],
    };
    let tables = Tables {
        vertices: vec![DVec3::X, DVec3::new(1.0, 0.0, 2.0)],
        curves: vec![
            rim(0.0),
            rim(2.0),
            Path::Line {
                origin: DVec3::X,
                direction: DVec3::Z,
            },
        ],
        pcurves: vec![
            line([0.0, 0.0], [1.0, 0.0]),
            line([0.0, 2.0], [1.0, 0.0]),
            line([4.0, 0.0], [0.0, 1.0]),
            line([0.0, 0.0], [0.0, 1.0]),
        ],
        surfaces: vec![Support::Spline(wall), plane(0.0), plane(2.0)],
        edges: vec![
            edge(0, [0.0, 4.0], 0, 0),
            edge(1, [0.0, 4.0], 1, 1),
            edge(2, [0.0, 2.0], 0, 1),
        ],
        faces: vec![
            face(
                0,
                vec![
                    of(0, false, Some(0)),
                    of(2, false, Some(2)),
                    of(1, true, Some(1)),
                    of(2, true, Some(3)),
                ],
            ),
            face(1, vec![of(0, false, None)]),
            face(2, vec![of(1, false, None)]),
        ],
    };
    (tables, vec![(0, false), (1, true), (2, false)])
}

fn original((tables, uses): (Tables, Vec<(usize, bool)>)) -> Result<Arc<Original>, ImportError> {
    Original::new(tables, &uses, 1e-9, (Vec::new(), 2.0 * PI)).map(Arc::new)
}

fn spread(k: u32) -> DVec3 {
    (DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478) * f64::from(k)).fract()
}

#[test]
fn a_cylinder_of_trimmed_faces_holds_what_its_equation_says_wherever_it_is_placed() {
    let original = original(cylinder()).unwrap();
    for placement in [
        Placement::NONE,
        Placement {
            scale: 250.0,
            azimuth: 1.1,
            at: DVec3::new(431_000.0, 6_521_000.0, -900.0),
        },
    ] {
        let body = Imported::new(&original, placement).unwrap();
        let mut held = 0;
        for k in 1..6000 {
            let own = DVec3::new(-1.5, -1.5, -0.5) + spread(k) * 3.0;
            let inside = own.xy().length() < 1.0 && (0.0..2.0).contains(&own.z);
            assert_eq!(
                body.inside().contains(placement.place(own)),
                inside,
                "{own}"
            );
            held += u32::from(inside);
        }
        assert!((f64::from(held) / 5999.0 - 2.0 * PI / 27.0).abs() < 0.01);
        // On the axis, where rays along z run up to the middle of both planes, and on the seam.
        for z in [0.3, 1.0, 1.9] {
            assert!(
                body.inside()
                    .contains(placement.place(DVec3::new(0.0, 0.0, z)))
            );
            assert!(
                body.inside()
                    .contains(placement.place(DVec3::new(0.999, 0.0, z)))
            );
            assert!(
                !body
                    .inside()
                    .contains(placement.place(DVec3::new(1.001, 0.0, z)))
            );
        }
    }
}

#[test]
fn a_placement_makes_larger_then_turns_clockwise_then_moves() {
    let placement = Placement {
        scale: 2.0,
        azimuth: 90.0_f64.to_radians(),
        at: DVec3::new(100.0, 10.0, 1.0),
    };
    // What pointed north points east.
    let place = placement.place(DVec3::new(0.0, 3.0, 4.0));
    assert!(
        place.distance(DVec3::new(106.0, 10.0, 9.0)) < 1e-12,
        "{place}"
    );
    let place = placement.place(DVec3::new(3.0, 0.0, 0.0));
    assert!(
        place.distance(DVec3::new(100.0, 4.0, 1.0)) < 1e-12,
        "{place}"
    );
}

#[test]
fn faces_that_do_not_close_are_refused_with_the_place() {
    let (mut tables, mut uses) = cylinder();
    tables.faces.pop();
    uses.pop();
    let error = original((tables, uses)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "it is not closed: the edge near [-1.000000, 0.000000, 2.000000] is run along 0 times one way and 1 times the other"
    );
    // The top looks the wrong way.
    let (tables, mut uses) = cylinder();
    uses[2].1 = true;
    let error = original((tables, uses)).unwrap_err();
    assert!(
        matches!(
            error,
            ImportError::Open {
                forward: 0,
                backward: 2,
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn an_edge_beside_its_surface_is_refused_with_the_distance() {
    let (mut tables, uses) = cylinder();
    // The top's plane, and nothing else, a millimetre higher.
    tables.surfaces[2] = Support::Plane {
        origin: DVec3::new(0.3, 0.2, 2.001),
        x_axis: DVec3::X,
        y_axis: DVec3::Y,
    };
    let error = original((tables, uses)).unwrap_err();
    assert!(
        error.to_string().contains("is 1.0e-3 m beside the surface"),
        "{error}"
    );
    // Where a reader has lost the seam, the wall's rim does not close in its parameters.
    let (mut tables, uses) = cylinder();
    tables.faces[0].loops = vec![
        vec![tables.faces[0].loops[0][0]],
        vec![tables.faces[0].loops[0][2]],
    ];
    tables.edges[2].curve = None;
    let error = original((tables, uses)).unwrap_err();
    assert!(
        matches!(
            error,
            ImportError::Loop {
                face: 1,
                source: TrimError::Gap { .. }
            }
        ),
        "{error}"
    );
}
