//! Shapes taken apart: the tables that were put together come back.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "tests"
)]

mod bodies;

use bodies::tables::{ball_in_box, drilled_block, grid};
use occt_bridge::{
    Boundary, BoundaryShape, BridgeError, Cancel, PartitionOptions, Path, Shape, Solids, Surface,
    Tables, boundary, box_solid, compound, faces, partition, solid,
};

fn solids_of(tables: &Tables) -> Vec<Shape> {
    let solids = Solids::from_tables(tables).unwrap();
    (0..tables.solids.len())
        .map(|i| solids.shape_of(i).unwrap())
        .collect()
}

/// Every loop runs from end to end.
fn assert_closed(found: &Boundary) {
    for uses in found.faces.iter().flat_map(|face| &face.loops) {
        let ends: Vec<_> = uses
            .iter()
            .map(|of| {
                let edge = found.edges[of.edge];
                if of.reversed {
                    (edge.end, edge.start)
                } else {
                    (edge.start, edge.end)
                }
            })
            .collect();
        for (i, (_, end)) in ends.iter().enumerate() {
            assert_eq!(*end, ends[(i + 1) % ends.len()].0);
        }
    }
}

/// Control points of the spline surfaces.
fn splines(found: &Boundary) -> Vec<&Vec<[f64; 3]>> {
    let poles = found.surfaces.iter().filter_map(|surface| match surface {
        Surface::BSpline { poles, .. } => Some(poles),
        Surface::Plane { .. } => None,
    });
    poles.collect()
}

#[test]
fn what_two_solids_share_is_there_once() {
    for curved in [false, true] {
        let tables = grid([&[0.0, 1.0, 3.0], &[0.0, 1.0], &[0.0, 1.0]], curved);
        let found = boundary(&solids_of(&tables)).unwrap();
        assert_closed(&found);
        assert_eq!(found.vertices.len(), 12);
        assert_eq!(found.edges.len(), 20);
        assert_eq!(found.faces.len(), 11);
        assert_eq!(found.surfaces.len(), 11);
        let [BoundaryShape::Solid(one), BoundaryShape::Solid(other)] = &found.shapes[..] else {
            panic!("{:?}", found.shapes)
        };
        assert_eq!((one.len(), other.len()), (1, 1));
        let shared: Vec<_> = one[0]
            .iter()
            .filter_map(|(face, reversed)| {
                let (_, too) = other[0].iter().find(|(with, _)| with == face)?;
                Some((*reversed, *too))
            })
            .collect();
        // From two sides.
        assert_eq!(shared.len(), 1);
        assert_ne!(shared[0].0, shared[0].1);
    }
}

#[test]
fn numbers_come_back_as_they_went_in() {
    let tables = drilled_block([0.5, 0.4], 0.25);
    let found = boundary(&solids_of(&tables)).unwrap();
    assert_closed(&found);
    assert_eq!(found.edges.len(), tables.edges.len());
    assert_eq!(found.faces.len(), tables.faces.len());
    for vertex in &tables.vertices {
        assert!(found.vertices.contains(&vertex.point));
    }
    let surfaces = tables.surfaces.iter().filter(|surface| {
        let spline = matches!(surface, Surface::BSpline { .. });
        spline && !found.surfaces.contains(surface)
    });
    assert_eq!(surfaces.count(), 0);
    for curve in &tables.curves {
        if let occt_bridge::Curve::BSpline {
            degree,
            knots,
            poles,
            weights,
        } = curve
        {
            let (degree, knots) = (*degree, knots.clone());
            let (poles, weights) = (poles.clone(), weights.clone());
            let same = Path::BSpline {
                degree,
                knots,
                poles,
                weights,
            };
            assert!(found.curves.contains(&same), "{curve:?}");
        }
    }
    // Edges of a drilled face keep their curves on it; planes have none.
    for face in &found.faces {
        let plane = matches!(found.surfaces[face.surface], Surface::Plane { .. });
        for of in face.loops.iter().flatten() {
            assert_eq!(of.pcurve.is_none(), plane);
        }
    }
}

#[test]
fn a_ball_has_a_seam_with_two_curves_and_two_edges_that_are_points() {
    let found = boundary(&solids_of(&ball_in_box([4.0, 5.0, 6.0], 2.0))).unwrap();
    assert_closed(&found);
    let [BoundaryShape::Solid(cube), BoundaryShape::Solid(ball)] = &found.shapes[..] else {
        panic!("{:?}", found.shapes)
    };
    // The cube's own shell comes first, then the void, which looks into the ball.
    assert_eq!((cube[0].len(), cube[1].len()), (6, 1));
    assert_eq!(ball[0], [(cube[1][0].0, !cube[1][0].1)]);
    let face = &found.faces[ball[0][0].0];
    let around = &face.loops[0];
    let points = around
        .iter()
        .filter(|of| found.edges[of.edge].curve.is_none());
    assert!(points.clone().all(|of| of.pcurve.is_none()));
    assert_eq!(points.count(), 2);
    // u is 1 where the loop runs up along the seam (v grows), 0 where it runs down.
    let seam = around.iter().filter_map(|of| {
        let Path::Line { origin, direction } = &found.pcurves[of.pcurve?] else {
            panic!("{of:?}")
        };
        assert_eq!(*direction, [0.0, 1.0]);
        Some((of.reversed, origin[0]))
    });
    let mut seam: Vec<_> = seam.collect();
    seam.sort_by_key(|(reversed, _)| *reversed);
    assert_eq!(seam, [(false, 1.0), (true, 0.0)]);
}

#[test]
fn pieces_of_a_general_fuse_come_apart_too() {
    let boxes = [
        box_solid([0.0; 3], [4.0; 3]).unwrap(),
        box_solid([1.0; 3], [2.0, 2.0, 6.0]).unwrap(),
    ];
    let cut = partition(
        &boxes,
        &PartitionOptions::default(),
        &Cancel::new(),
        &|_| (),
    )
    .unwrap();
    let owner: Vec<_> = cut
        .cells()
        .iter()
        .map(|cell| {
            cell.inside
                .contains(&0)
                .then(|| cell.inside[cell.inside.len() - 1])
        })
        .collect();
    let solids = cut.merge(&owner).unwrap();
    let shapes: Vec<_> = (0..2).map(|i| solids.shape_of(i).unwrap()).collect();
    let found = boundary(&shapes).unwrap();
    assert_closed(&found);
    // A cube with a shaft from its top: 6 faces, the shaft's 4 walls and its floor; its lid is the shaft's alone.
    assert_eq!(found.faces.len(), 12);
    assert_eq!(found.faces.iter().filter(|f| f.loops.len() == 2).count(), 1);
    assert!(found.curves.iter().all(|c| matches!(c, Path::Line { .. })));
    for (at, face) in found.faces.iter().enumerate() {
        let Surface::Plane { normal, x_axis, .. } = &found.surfaces[face.surface] else {
            panic!("face {at} is no plane")
        };
        let length = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
        assert!((length(normal) - 1.0).abs() < 1e-15 && (length(x_axis) - 1.0).abs() < 1e-15);
    }
}

#[test]
fn faces_that_bound_no_solid_are_faces() {
    let sheet = bodies::cylinder_topology([0.0, 2.0], [0.0, 0.0], 1.0);
    let found = boundary(&[faces(&sheet).unwrap(), solid(&sheet).unwrap()]).unwrap();
    assert!(matches!(&found.shapes[0], BoundaryShape::Faces(of) if of.len() == 3));
    assert!(matches!(&found.shapes[1], BoundaryShape::Solid(of) if of.len() == 1));
    assert_eq!(splines(&found).len(), 2);
}

#[test]
fn a_compound_is_no_solid_but_has_faces() {
    let two = solids_of(&grid([&[0.0, 1.0, 3.0], &[0.0, 1.0], &[0.0, 1.0]], false));
    let found = boundary(&[compound(&two).unwrap()]).unwrap();
    assert!(matches!(&found.shapes[0], BoundaryShape::Faces(of) if of.len() == 12));
}

#[test]
fn nothing_is_an_error() {
    let error = boundary(&[]).unwrap_err();
    assert!(matches!(error, BridgeError::Input { .. }), "{error:?}");
}
