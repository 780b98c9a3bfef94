//! Partition, cells, merge by owner, provenance.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "tests"
)]

mod bodies;

use std::sync::Mutex;

use bodies::measured::{self, cut, youngest_in_first};
use occt_bridge::{
    BridgeError, Cancel, PartitionOptions, Shape, Solids, Threads, box_solid, defects,
    face_integrals, partition, volume,
};

/// Two boxes of 8 m³ that overlap in 1 m³.
fn crossing_boxes() -> Vec<Shape> {
    vec![
        box_solid([0.0; 3], [2.0; 3]).unwrap(),
        box_solid([1.0; 3], [3.0; 3]).unwrap(),
    ]
}

fn volumes(solids: &Solids) -> Vec<f64> {
    let integrals = face_integrals(solids, 1e-9, [0.3, 0.1, -0.2], Threads::All).unwrap();
    measured::volumes(solids, &integrals)
}

#[test]
fn two_crossing_boxes_make_three_cells_with_exact_volumes() {
    let p = cut(&crossing_boxes());
    let inside: Vec<_> = p.cells().iter().map(|c| c.inside.clone()).collect();
    assert_eq!(p.cells().len(), 3);
    assert!(inside.contains(&vec![0]) && inside.contains(&vec![1]) && inside.contains(&vec![0, 1]));
    let solids = p.merge(&[Some(0), Some(1), Some(2)]).unwrap();
    for (cell, found) in p.cells().iter().zip(volumes(&solids)) {
        let exact = if cell.inside.len() == 2 { 1.0 } else { 7.0 };
        assert!((found - exact).abs() < 1e-12, "{found} for {exact}");
    }
    assert_eq!(p.crossing_arguments(), [(0, 1)]);
    assert_eq!(p.interferences(), 6);
    assert!(p.alerts().is_empty() && !p.has_unused_faces());
    assert!(defects(&solids, Threads::All).unwrap().is_empty());
}

#[test]
fn merging_by_owner_removes_the_faces_between_cells_of_one_owner() {
    let p = cut(&crossing_boxes());
    // The union: 8 + 8 - 1.
    let one = p.merge(&[Some(4); 3]).unwrap();
    assert_eq!(one.solids().len(), 1);
    assert_eq!(one.solids()[0].owner, 4);
    assert_eq!(one.solids()[0].shells, 1);
    assert!((volumes(&one)[0] - 15.0).abs() < 1e-12);
    assert!((volume(&one.compound().unwrap(), 1e-9).unwrap() - 15.0).abs() < 1e-12);
    assert!(one.faces().iter().all(|f| f.solids == [0]));
    assert!(defects(&one, Threads::All).unwrap().is_empty());
    // The younger takes its part of the older; what is outside goes.
    let two = p.merge(&youngest_in_first(&p)).unwrap();
    let mut found = volumes(&two);
    found.sort_by(f64::total_cmp);
    assert!((found[0] - 1.0).abs() < 1e-12 && (found[1] - 7.0).abs() < 1e-12);
    assert_eq!(
        two.faces().iter().filter(|f| f.solids.len() == 2).count(),
        3
    );
}

#[test]
fn shared_faces_bound_two_solids_in_opposite_directions() {
    let p = cut(&crossing_boxes());
    let solids = p.merge(&[Some(0), Some(1), Some(2)]).unwrap();
    let mut sides = vec![Vec::new(); solids.faces().len()];
    for solid in solids.solids() {
        for (face, reversed) in &solid.faces {
            sides[*face].push(*reversed);
        }
    }
    for (face, used) in solids.faces().iter().zip(&sides) {
        assert_eq!(face.solids.len(), used.len());
        assert!(used.len() == 1 || used[0] != used[1]);
    }
    assert_eq!(sides.iter().filter(|s| s.len() == 2).count(), 6);
}

#[test]
fn origins_tell_which_side_of_a_face_is_inside_its_argument() {
    let p = cut(&crossing_boxes());
    for cell in p.cells() {
        for (face, reversed) in &cell.faces {
            for origin in &p.faces()[*face].origins {
                assert_eq!(
                    cell.inside.contains(&origin.argument),
                    *reversed != origin.same_orientation,
                );
            }
        }
    }
    // Each of the 12 given faces is there, and three of each box are cut in two.
    let mut found: Vec<_> = p
        .faces()
        .iter()
        .flat_map(|f| f.origins.iter().map(|o| (o.argument, o.face)))
        .collect();
    assert_eq!(found.len(), 18);
    found.sort_unstable();
    found.dedup();
    assert_eq!(found.len(), 12);
    // +x, +y, +z of the first box; -x, -y, -z of the second.
    for (argument, split) in [(0, [1, 3, 5]), (1, [0, 2, 4])] {
        for face in 0..6 {
            let pieces = p
                .faces()
                .iter()
                .filter(|f| {
                    f.origins
                        .iter()
                        .any(|o| (o.argument, o.face) == (argument, face))
                })
                .count();
            assert_eq!(pieces, if split.contains(&face) { 2 } else { 1 });
        }
    }
}

#[test]
fn one_argument_is_its_own_cell() {
    let p = cut(&[box_solid([0.0; 3], [1.0, 2.0, 3.0]).unwrap()]);
    assert_eq!(p.cells().len(), 1);
    assert_eq!(p.cells()[0].inside, [0]);
    assert_eq!(p.faces().len(), 6);
    for (i, face) in p.faces().iter().enumerate() {
        let origin = face.origins[0];
        assert_eq!((origin.argument, origin.face), (0, i));
        assert_eq!(p.cells()[0].faces[i], (i, !origin.same_orientation));
    }
    let solids = p.merge(&[Some(9)]).unwrap();
    assert!((volumes(&solids)[0] - 6.0).abs() < 1e-12);
}

#[test]
fn boxes_that_only_touch_share_their_common_face() {
    let boxes = [
        box_solid([0.0; 3], [1.0; 3]).unwrap(),
        box_solid([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]).unwrap(),
    ];
    let p = cut(&boxes);
    assert_eq!((p.cells().len(), p.faces().len()), (2, 11));
    let common: Vec<_> = p.faces().iter().filter(|f| f.origins.len() == 2).collect();
    assert_eq!(common.len(), 1);
    let [a, b] = common[0].origins[..] else {
        panic!("two origins")
    };
    assert_ne!(a.same_orientation, b.same_orientation);
    assert_eq!((a.face, b.face), (1, 0));
}

#[test]
fn a_body_inside_another_leaves_a_void_with_a_second_shell() {
    let p = cut(&[
        box_solid([0.0; 3], [4.0; 3]).unwrap(),
        box_solid([1.0; 3], [2.0; 3]).unwrap(),
    ]);
    let solids = p.merge(&youngest_in_first(&p)).unwrap();
    let outer = solids.solids().iter().position(|s| s.owner == 0).unwrap();
    assert_eq!(solids.solids()[outer].shells, 2);
    assert!((volumes(&solids)[outer] - 63.0).abs() < 1e-11);
    assert!(defects(&solids, Threads::All).unwrap().is_empty());
}

#[test]
fn a_solid_that_touches_itself_along_an_edge_keeps_its_volume() {
    // Two boxes that have only an edge in common stay two solids; with a third that joins them they are one.
    let boxes = [
        box_solid([0.0; 3], [1.0; 3]).unwrap(),
        box_solid([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]).unwrap(),
        box_solid([0.0, 0.0, 1.0], [2.0, 2.0, 2.0]).unwrap(),
    ];
    let apart = cut(&boxes[..2]);
    assert_eq!(apart.merge(&[Some(0); 2]).unwrap().solids().len(), 2);
    let p = cut(&boxes);
    let owner: Vec<_> = p.cells().iter().map(|_| Some(0)).collect();
    let solids = p.merge(&owner).unwrap();
    assert_eq!(solids.solids().len(), 1);
    assert!((volumes(&solids)[0] - 6.0).abs() < 1e-12);
}

#[test]
fn serial_and_parallel_partitions_are_the_same() {
    let run = |threads| {
        let options = PartitionOptions {
            threads,
            fuzzy: None,
        };
        let p = partition(&crossing_boxes(), &options, &Cancel::new(), &|_| ()).unwrap();
        p.merge(&[Some(0), Some(1), Some(2)])
            .unwrap()
            .to_bytes()
            .unwrap()
    };
    assert!(run(Threads::One) == run(Threads::All));
}

#[test]
fn a_partition_leaves_its_arguments_as_they_were() {
    let boxes = crossing_boxes();
    let before = cut(&boxes)
        .merge(&[Some(0), Some(1), Some(2)])
        .unwrap()
        .to_bytes()
        .unwrap();
    let after = cut(&boxes)
        .merge(&[Some(0), Some(1), Some(2)])
        .unwrap()
        .to_bytes()
        .unwrap();
    assert!(before == after);
}

#[test]
fn a_cancelled_partition_does_not_begin() {
    let cancel = Cancel::new();
    cancel.cancel();
    let furthest = Mutex::new(0.0_f64);
    let result = partition(
        &crossing_boxes(),
        &PartitionOptions::default(),
        &cancel,
        &|fraction| {
            let mut furthest = furthest.lock().unwrap();
            *furthest = furthest.max(fraction);
        },
    );
    assert_eq!(result.unwrap_err(), BridgeError::Cancelled);
    let furthest = furthest.into_inner().unwrap();
    assert!(furthest < 0.5, "it went on to {furthest}");
}

#[test]
fn misuse_is_an_input_error() {
    let boxes = crossing_boxes();
    let run = |shapes: &[Shape], fuzzy| {
        let options = PartitionOptions {
            fuzzy,
            ..PartitionOptions::default()
        };
        partition(shapes, &options, &Cancel::new(), &|_| ())
            .map(|_| ())
            .unwrap_err()
            .to_string()
    };
    assert_eq!(run(&[], None), "partition: no argument was given");
    let twice = [boxes[0].clone(), boxes[0].clone()];
    assert_eq!(run(&twice, None), "partition: argument 1 was given before");
    let compound = occt_bridge::compound(&boxes).unwrap();
    assert_eq!(
        run(&[boxes[0].clone(), compound], None),
        "partition: argument 1 is not a solid"
    );
    assert!(run(&boxes, Some(f64::NAN)).contains("fuzzy"));
    let p = cut(&boxes);
    assert!(
        p.merge(&[Some(0)])
            .unwrap_err()
            .to_string()
            .contains("1 owners for 3 cells")
    );
    assert!(
        p.merge(&[None; 3])
            .unwrap_err()
            .to_string()
            .contains("every cell is dropped")
    );
}
