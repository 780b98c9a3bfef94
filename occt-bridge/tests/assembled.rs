//! Solids from finished tables, against closed forms, and tables that are wrong.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "tests"
)]

mod bodies;

use std::f64::consts::PI;

use bodies::measured;
use bodies::tables::{add_grid, ball_in_box, drilled_block, grid, solid, turned};
use occt_bridge::{
    BridgeError, Classifier, Curve, OnSurface, Pcurve, Position, ShapeKind, Solids, Surface,
    Tables, Threads, defects, face_integrals, read_brep, volume, write_brep,
};

fn volumes(solids: &Solids) -> Vec<f64> {
    let integrals = face_integrals(solids, 1e-10, [0.3, 0.1, 0.2], Threads::One).unwrap();
    measured::volumes(solids, &integrals)
}

fn assert_sound(solids: &Solids, exact: &[f64]) {
    assert_eq!(defects(solids, Threads::One).unwrap(), []);
    let found = volumes(solids);
    assert_eq!(found.len(), exact.len());
    for (found, exact) in found.iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < 1e-9, "{found} for {exact}");
    }
}

fn two_boxes() -> Tables {
    grid([&[0.0, 1.0, 3.0], &[0.0, 1.0], &[0.0, 1.0]], false)
}

#[test]
fn two_boxes_share_the_face_between_them() {
    for curved in [false, true] {
        let tables = grid([&[0.0, 1.0, 3.0], &[0.0, 1.0], &[0.0, 1.0]], curved);
        let solids = Solids::from_tables(&tables).unwrap();
        assert_sound(&solids, &[1.0, 2.0]);
        assert_eq!(solids.faces().len(), 11);
        assert_eq!(solids.edge_count().unwrap(), 20);
        let common: Vec<_> = (0..11)
            .filter(|f| solids.faces()[*f].solids == [0, 1])
            .collect();
        assert_eq!(common.len(), 1);
        for (s, of) in solids.solids().iter().enumerate() {
            assert_eq!(of.owner, 10 + s);
            assert_eq!(of.faces, tables.solids[s].shells.concat());
            assert_eq!(of.shells, 1);
            // The common face is the second box's lower one, the first one's upper.
            assert!(of.faces.contains(&(common[0], s == 1)));
        }
        for (face, table) in solids.faces().iter().zip(&tables.faces) {
            assert_eq!(face.origins, table.origins);
        }
    }
}

#[test]
fn a_brep_file_keeps_what_solids_share() {
    let dir = tempfile::tempdir().unwrap();
    for tables in [two_boxes(), drilled_block([0.5, 0.4], 0.25)] {
        let solids = Solids::from_tables(&tables).unwrap();
        let brep = dir.path().join("all.brep");
        write_brep(&brep, &solids.compound().unwrap()).unwrap();
        let exact: f64 = volumes(&solids).iter().sum();
        let back = read_brep(&brep).unwrap();
        assert_eq!(back.count(ShapeKind::Solid).unwrap(), 2);
        assert_eq!(back.count(ShapeKind::Face).unwrap(), tables.faces.len());
        let found = volume(&back, 1e-10).unwrap();
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} for {exact}");
    }
}

#[test]
fn bytes_give_the_same_solids_back() {
    let solids = Solids::from_tables(&ball_in_box([4.0, 5.0, 6.0], 2.0)).unwrap();
    let bytes = solids.to_bytes().unwrap();
    let back = Solids::from_bytes(&bytes).unwrap();
    assert_eq!(back.solids(), solids.solids());
    assert_eq!(back.faces(), solids.faces());
    assert_eq!(volumes(&back), volumes(&solids));
    assert!(back.to_bytes().unwrap() == bytes);
}

#[test]
fn a_cube_within_a_cube_is_a_void_of_the_outer_one() {
    let mut tables = Tables::default();
    let outer = add_grid(&mut tables, [&[0.0, 4.0]; 3], false).remove(0);
    let inner = add_grid(&mut tables, [&[1.0, 2.0]; 3], true).remove(0);
    solid(&mut tables, 0, vec![outer, turned(&inner)]);
    solid(&mut tables, 1, vec![inner]);
    let solids = Solids::from_tables(&tables).unwrap();
    assert_sound(&solids, &[63.0, 1.0]);
    let shells: Vec<_> = solids.solids().iter().map(|s| s.shells).collect();
    assert_eq!(shells, [2, 1]);
    let mut classifier = Classifier::new(&solids.shape_of(0).unwrap()).unwrap();
    for (at, expected) in [(1.5, Position::Out), (3.0, Position::In)] {
        assert_eq!(classifier.contains([at; 3], 1e-7).unwrap(), expected);
    }
}

#[test]
fn a_rational_ball_with_a_seam_and_two_poles_has_the_volume_of_a_ball() {
    for radius in [0.02, 2.0, 3.9] {
        let solids = Solids::from_tables(&ball_in_box([4.0, 5.0, 6.0], radius)).unwrap();
        let ball = 4.0 / 3.0 * PI * radius.powi(3);
        assert_sound(&solids, &[1000.0 - ball, ball]);
    }
}

#[test]
fn a_hole_in_a_spline_face_takes_the_column_below_it() {
    let (centre, radius) = ([0.5, 0.4], 0.25);
    let solids = Solids::from_tables(&drilled_block(centre, radius)).unwrap();
    // Over a disc the mean of xy is that of its centre.
    let core = PI * radius * radius * (1.0 + centre[0] * centre[1] / 2.0);
    assert_sound(&solids, &[1.125 - core, core]);
    assert_eq!(solids.solids()[1].owner, 3);
    assert_eq!(solids.faces()[8].solids, [0, 1]);
}

#[test]
fn no_vertex_is_narrower_than_its_edges_and_no_edge_than_its_faces() {
    let tolerances = |tables: &Tables| -> Vec<f64> {
        let solids = Solids::from_tables(tables).unwrap();
        let found = face_integrals(&solids, 1e-6, [0.0; 3], Threads::One).unwrap();
        found.iter().map(|f| f.tolerance).collect()
    };
    // An edge along x from the origin: the face x = 0 has none of it but its first vertex.
    let mut tables = two_boxes();
    let along_x = tables.edges.iter().position(|e| e.start == 0).unwrap();
    let far = tables.edges[along_x].end;
    assert!(tables.vertices[far].point[0] > 0.0);
    tables.edges[along_x].tolerance = 1e-5;
    let lowest = tables.solids[0].shells[0][0].0;
    assert!((tolerances(&tables)[lowest] - 1e-5).abs() < 1e-12);
    // A face: its neighbours have its edges, the face x = 3 nothing of it.
    let mut tables = two_boxes();
    tables.faces[lowest].tolerance = 1e-4;
    let found = tolerances(&tables);
    let of = |solid: usize, k: usize| found[tables.solids[solid].shells[0][k].0];
    for neighbour in 2..6 {
        assert!((of(0, neighbour) - 1e-4).abs() < 1e-12);
    }
    assert!((of(1, 1) - 1e-7).abs() < 1e-12);
}

/// What is done to good tables, and words of the error it must give.
type Misuse = (fn(&mut Tables), &'static str);

fn assert_misuse(good: &Tables, table: &[Misuse]) {
    assert!(Solids::from_tables(good).is_ok());
    for (spoil, words) in table {
        let mut bad = good.clone();
        spoil(&mut bad);
        let error = Solids::from_tables(&bad).expect_err(words);
        assert!(matches!(error, BridgeError::Input { .. }), "{error:?}");
        assert!(error.to_string().contains(words), "{error} for {words}");
    }
}

#[test]
fn a_bad_number_or_edge_is_an_error_that_names_the_entry() {
    let table: [Misuse; 14] = [
        (
            |t| t.vertices[3].point[1] = f64::NAN,
            "vertex 3: its coordinates hold NaN",
        ),
        (
            |t| t.vertices[2].tolerance = 0.0,
            "vertex 2: its tolerance is 0",
        ),
        (
            |t| t.edges[4].tolerance = -1.0,
            "edge 4: its tolerance is -1",
        ),
        (
            |t| t.faces[1].tolerance = f64::INFINITY,
            "face 1: its tolerance is inf",
        ),
        (
            |t| {
                t.curves[5] = Curve::Line {
                    start: [1.0; 3],
                    end: [1.0; 3],
                }
            },
            "curve 5: all of it is the point [1.0, 1.0, 1.0]",
        ),
        (
            |t| {
                t.surfaces[0] = Surface::Plane {
                    origin: [0.0; 3],
                    normal: [1.0, 0.0, 0.0],
                    x_axis: [2.0, 0.0, 0.0],
                }
            },
            "surface 0: the normal",
        ),
        (
            |t| {
                t.pcurves[1] = Pcurve::Line {
                    origin: [0.0; 2],
                    direction: [0.0; 2],
                }
            },
            "pcurve 1: the direction",
        ),
        (
            |t| t.edges[2].curve = Some(99),
            "edge 2: names curve 99, but there are 20",
        ),
        (
            |t| t.edges[2].end = 12,
            "edge 2: names vertex 12, but there are 12",
        ),
        (
            |t| t.edges[6].range = [0.5, 1.5],
            "edge 6: its range is 0.5 to 1.5; its curve 6 runs over 0 to 1",
        ),
        (
            |t| t.edges[6].range = [1.0, 0.0],
            "edge 6: its range is 1 to 0; it must",
        ),
        (
            |t| t.edges[3].curve = None,
            "edge 3: it has no curve, so it is a point, but",
        ),
        (
            |t| {
                t.edges[0].on = vec![OnSurface {
                    surface: 0,
                    forward: 0,
                    reversed: None,
                }];
            },
            "edge 0: it has a pcurve on surface 0, which is a plane",
        ),
        (
            |t| {
                t.curves[5] = Curve::BSpline {
                    degree: 1,
                    knots: vec![0.0, 0.0, 0.5, 1.0],
                    poles: vec![[0.0; 3], [1.0; 3]],
                    weights: None,
                }
            },
            "curve 5: the knots are not clamped",
        ),
    ];
    assert_misuse(&two_boxes(), &table);
}

#[test]
fn a_bad_face_or_solid_is_an_error_that_names_the_entry() {
    let table: [Misuse; 13] = [
        (
            |t| t.faces[2].surface = 11,
            "face 2: names surface 11, but there are 11",
        ),
        (|t| t.faces[2].loops.clear(), "face 2: it has no loop"),
        (
            |t| t.faces[2].loops[0][1].1 ^= true,
            "face 2: loop 0: it is not closed: edge",
        ),
        (
            |t| t.faces[4].loops.push(Vec::new()),
            "face 4: loop 1: it has no edge",
        ),
        (
            |t| t.solids[1].shells[0][0].0 = 44,
            "solid 1: shell 0: names face 44, but there are 11",
        ),
        (
            |t| t.solids[0].shells[0][0].1 ^= true,
            "shell 0 of solid 0 is not closed, or touches itself: it uses edge",
        ),
        (|t| t.solids.clear(), "there are no solids"),
        (|t| drop(t.solids.remove(1)), "is used by no solid"),
        (|t| t.solids[1].shells.clear(), "solid 1: it has no shell"),
        (
            |t| t.solids[1].shells.push(Vec::new()),
            "solid 1: shell 1: it has no face",
        ),
        (
            |t| {
                let again = t.solids[0].clone();
                t.solids.push(again);
            },
            "is used reversed by solid 0 and again by solid 2; a face has two sides",
        ),
        (|t| t.solids[1].shells[0].truncate(5), "is used by no solid"),
        (
            // The box without its common face: that face is still used by the other one.
            |t| {
                let common = t.solids[0].shells[0][1].0;
                t.solids[1].shells[0].retain(|(face, _)| *face != common);
            },
            "shell 0 of solid 1 is not closed, or touches itself: it uses edge",
        ),
    ];
    assert_misuse(&two_boxes(), &table);
}

#[test]
fn a_shell_that_touches_itself_along_an_edge_is_two_solids() {
    let mut tables = grid([&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0], &[0.0, 1.0]], false);
    let diagonal = tables.solids.remove(3);
    tables.solids[0].shells[0].extend(diagonal.shells.concat());
    let error = Solids::from_tables(&tables).unwrap_err().to_string();
    assert!(
        error.contains("2 times forwards and 2 times backwards"),
        "{error}"
    );
    let faces = tables.solids[0].shells[0].split_off(6);
    solid(&mut tables, 10, vec![faces]);
    let solids = Solids::from_tables(&tables).unwrap();
    assert_sound(&solids, &[1.0; 4]);
}

#[test]
fn a_bad_pcurve_or_curved_face_is_an_error_that_names_the_entry() {
    // Edges 12, 13 and 14 are the ball's seam and poles, face 6 is the ball.
    let table: [Misuse; 10] = [
        (
            |t| t.edges[13].on.clear(),
            "edge 13: it has neither a curve nor a pcurve",
        ),
        (
            |t| t.edges[12].on.clear(),
            "face 6: loop 0: edge 12 has no pcurve on the B-spline surface 6",
        ),
        (
            |t| {
                let on = t.edges[12].on[0];
                t.edges[12].on.push(on);
            },
            "edge 12: it lies twice on surface 6",
        ),
        (
            |t| t.edges[12].on[0].reversed = Some(4),
            "edge 12: it is a seam of surface 6, but both its pcurves are 4",
        ),
        (
            |t| t.edges[14].on[0].forward = 8,
            "edge 14: names pcurve 8, but there are 8",
        ),
        (
            |t| t.edges[14].on[0].surface = 8,
            "edge 14: names surface 8, but there are 7",
        ),
        (
            |t| {
                t.pcurves[6] = Pcurve::BSpline {
                    degree: 1,
                    knots: vec![0.0, 0.0, 0.9, 0.9],
                    poles: vec![[0.0; 2], [0.9, 0.0]],
                    weights: None,
                }
            },
            "edge 13: its range is 0 to 1; its pcurve 6 runs over 0 to 0.9",
        ),
        (
            |t| t.faces[0].loops.push(vec![(13, false)]),
            "face 0: loop 1: edge 13 is a point, which cannot be part of a loop on a plane",
        ),
        (
            |t| {
                if let Surface::BSpline {
                    weights: Some(w), ..
                } = &mut t.surfaces[6]
                {
                    w[7] = -1.0;
                }
            },
            "surface 6: weight 7 is -1",
        ),
        (
            // Only the kernel finds knots that differ by less than rounding.
            |t| {
                if let Surface::BSpline { knots_u, .. } = &mut t.surfaces[6] {
                    knots_u[6] = 0.500_000_000_000_000_1;
                }
            },
            "surface 6: OpenCASCADE refuses it: Standard_ConstructionError",
        ),
    ];
    assert_misuse(&ball_in_box([4.0, 5.0, 6.0], 2.0), &table);
}
