//! OpenCASCADE's own files.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "tests"
)]

use std::fs;
use std::path::Path;

use occt_bridge::{
    BridgeError, Cancel, PartitionOptions, ShapeKind, Solids, Threads, box_solid, compound,
    defects, partition, read_brep, version, volume, write_brep,
};

#[test]
fn a_brep_file_keeps_shared_faces() {
    let boxes = [
        box_solid([0.0; 3], [1.0; 3]).unwrap(),
        box_solid([1.0, 0.0, 0.0], [3.0, 1.0, 1.0]).unwrap(),
    ];
    let p = partition(
        &boxes,
        &PartitionOptions::default(),
        &Cancel::new(),
        &|_| (),
    )
    .unwrap();
    let shape = p.merge(&[Some(0), Some(1)]).unwrap().compound().unwrap();
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.brep");
    write_brep(&path, &shape).unwrap();
    let back = read_brep(&path).unwrap();
    assert_eq!(back.count(ShapeKind::Face).unwrap(), 11);
    assert_eq!(back.count(ShapeKind::Solid).unwrap(), 2);
    assert!((volume(&back, 1e-9).unwrap() - 3.0).abs() < 1e-12);
    // The same shape gives the same bytes.
    let first = fs::read(&path).unwrap();
    write_brep(&path, &shape).unwrap();
    assert!(first == fs::read(&path).unwrap());
}

#[test]
fn a_path_that_cannot_be_used_is_an_io_error() {
    let shape = box_solid([0.0; 3], [1.0; 3]).unwrap();
    let nowhere = Path::new("/nonexistent/a.brep");
    let dir = tempfile::tempdir().unwrap();
    let empty = dir.path().join("empty.brep");
    fs::write(&empty, "").unwrap();
    for result in [
        write_brep(nowhere, &shape),
        read_brep(nowhere).map(|_| ()),
        read_brep(&empty).map(|_| ()),
    ] {
        assert!(matches!(result, Err(BridgeError::Io { .. })), "{result:?}");
    }
}

#[test]
fn a_compound_holds_what_it_was_given_and_needs_something() {
    let boxes = [
        box_solid([0.0; 3], [1.0; 3]).unwrap(),
        box_solid([5.0; 3], [6.0; 3]).unwrap(),
    ];
    let all = compound(&boxes).unwrap();
    assert_eq!(all.kind().unwrap(), ShapeKind::Compound);
    assert_eq!(all.count(ShapeKind::Solid).unwrap(), 2);
    assert!(all.count(ShapeKind::Compound).is_err());
    assert!(matches!(compound(&[]), Err(BridgeError::Input { .. })));
}

#[test]
fn the_version_is_one_that_the_build_accepts() {
    let text = version();
    let mut numbers = text.split('.').map(|n| n.parse::<u32>().unwrap_or(0));
    let found = (numbers.next().unwrap(), numbers.next().unwrap());
    assert!(((7, 6)..(8, 0)).contains(&found), "{text}");
}

#[test]
fn a_vertex_that_is_off_its_edges_is_a_defect_of_its_solid() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.brep");
    let good = box_solid([0.0; 3], [1.0; 3]).unwrap();
    write_brep(&path, &good).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let (head, rest) = text.split_once("Ve\n1e-07\n").unwrap();
    let (_, tail) = rest.split_once('\n').unwrap();
    fs::write(&path, format!("{head}Ve\n1e-07\n0.1 0.2 0.3\n{tail}")).unwrap();
    let broken = read_brep(&path).unwrap();
    let sound = box_solid([5.0; 3], [6.0; 3]).unwrap();
    let solids = Solids::from_shapes(&[sound, broken]).unwrap();
    for threads in [Threads::One, Threads::All] {
        let found = defects(&solids, threads).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].solid, Some(1));
        assert!(found[0].what.contains("vertex"), "{found:?}");
    }
    assert!(
        defects(&Solids::from_shapes(&[good]).unwrap(), Threads::All)
            .unwrap()
            .is_empty()
    );
}
