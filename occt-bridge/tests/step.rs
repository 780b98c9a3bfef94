//! STEP out and in.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "tests"
)]

mod bodies;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use occt_bridge::{
    BridgeError, Cancel, PartitionOptions, Shape, ShapeKind, Solids, StepDocument, StepNode,
    StepSchema, bounds, box_solid, compound, partition, read_step, volume, write_step_assembly,
    write_step_shared,
};

fn touching_boxes() -> Solids {
    let boxes = [
        box_solid([0.0; 3], [1000.0, 10.0, 10.0]).unwrap(),
        box_solid([1000.0, 0.0, 0.0], [1500.0, 10.0, 10.0]).unwrap(),
    ];
    let p = partition(
        &boxes,
        &PartitionOptions::default(),
        &Cancel::new(),
        &|_| (),
    )
    .unwrap();
    p.merge(&[Some(0), Some(1)]).unwrap()
}

fn part(name: &str, color: [u8; 3], shapes: Vec<Shape>) -> StepNode {
    StepNode {
        name: name.to_owned(),
        color: Some(color),
        layer: Some(format!("layer of {name}")),
        description: Some("porosity=0.25".to_owned()),
        shapes,
        children: Vec::new(),
    }
}

fn document(children: Vec<StepNode>) -> StepDocument {
    StepDocument {
        name: "two boxes".to_owned(),
        system: "clinothem 0.1.0".to_owned(),
        description: "a test".to_owned(),
        schema: StepSchema::Ap214,
        root: StepNode {
            name: "model".to_owned(),
            children,
            ..StepNode::default()
        },
    }
}

/// An assembly in an assembly, and a part of two pieces.
fn belt() -> StepDocument {
    let solids = touching_boxes();
    let pieces = vec![
        box_solid([0.0, 20.0, 0.0], [1.0, 21.0, 1.0]).unwrap(),
        box_solid([5.0, 20.0, 0.0], [6.0, 22.0, 1.0]).unwrap(),
    ];
    document(vec![
        part("plain", [200, 190, 120], vec![solids.shape_of(0).unwrap()]),
        StepNode {
            name: "belt".to_owned(),
            children: vec![
                part("sand", [250, 220, 50], vec![solids.shape_of(1).unwrap()]),
                part("mud", [80, 90, 100], pieces),
            ],
            ..StepNode::default()
        },
    ])
}

/// Forty parts in three colours and two layers: more than any hash keeps in order by chance.
fn crowd() -> StepDocument {
    let children = (0..40)
        .map(|i| {
            let x = 3.0 * i as f64;
            let mut node = part(
                &format!("part-{i}"),
                [[9, 9, 9], [99, 9, 9], [9, 99, 9]][i % 3],
                vec![box_solid([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]).unwrap()],
            );
            node.layer = Some(["sand", "mud"][i % 2].to_owned());
            node
        })
        .collect();
    document(children)
}

fn written(document: &StepDocument) -> String {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.step");
    write_step_assembly(&path, document).unwrap();
    fs::read_to_string(path).unwrap()
}

#[test]
fn an_assembly_comes_back_with_names_colours_layers_tree_and_metres() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.step");
    write_step_assembly(&path, &belt()).unwrap();
    if let Ok(keep) = std::env::var("OCCT_BRIDGE_KEEP") {
        fs::copy(&path, keep).unwrap();
    }
    let parts = read_step(&path).unwrap();
    let told: Vec<_> = parts
        .iter()
        .map(|p| (p.path.as_str(), p.color, p.layer.as_deref()))
        .collect();
    assert_eq!(
        told,
        [
            ("model/plain", Some([200, 190, 120]), Some("layer of plain")),
            (
                "model/belt/sand",
                Some([250, 220, 50]),
                Some("layer of sand")
            ),
            ("model/belt/mud", Some([80, 90, 100]), Some("layer of mud")),
        ]
    );
    for (part, exact) in parts.iter().zip([1e5, 5e4, 3.0]) {
        let found = volume(&part.shape, 1e-9).unwrap();
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} for {exact}");
    }
    assert_eq!(parts[2].shape.count(ShapeKind::Solid).unwrap(), 2);
    let b = bounds(&parts[0].shape).unwrap();
    assert!((b.max[0] - 1000.0).abs() < 1e-6, "{b:?}");
}

#[test]
fn the_file_declares_metres_and_its_numbers_are_metres() {
    for schema in [StepSchema::Ap214, StepSchema::Ap242] {
        let mut document = belt();
        document.schema = schema;
        let text = written(&document);
        assert!(text.contains("SI_UNIT($,.METRE.)"));
        assert!(!text.contains(".MILLI.,.METRE."));
        // The corner that the two boxes share, and nothing a thousand times further or nearer.
        assert!(text.contains("(1.E+03,10.,10.)"));
        assert!(!text.contains("E+06") && !text.contains("(1.,1.E-02,1.E-02)"));
        let name = if schema == StepSchema::Ap214 {
            "AUTOMOTIVE_DESIGN"
        } else {
            "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF"
        };
        assert!(text.contains(name));
    }
}

#[test]
fn descriptions_are_those_of_the_products() {
    let text = written(&belt());
    assert!(text.contains("PRODUCT('sand','sand','porosity=0.25'"));
    assert!(text.contains("'clinothem 0.1.0'"));
}

#[test]
fn two_writes_of_one_document_give_the_same_bytes() {
    let document = belt();
    let first = written(&document);
    assert!(first == written(&document));
    // Another document between them moves every counter of the process.
    written(&super_document());
    assert!(first == written(&belt()));
}

fn super_document() -> StepDocument {
    document(vec![
        part(
            "other",
            [1, 2, 3],
            vec![box_solid([0.0; 3], [1.0; 3]).unwrap()],
        ),
        part(
            "third",
            [3, 2, 1],
            vec![box_solid([2.0; 3], [3.0; 3]).unwrap()],
        ),
    ])
}

/// Not a test by itself: `two_processes_give_the_same_bytes` runs it in two.
#[test]
fn child_writes_where_it_is_told() {
    if let Ok(path) = std::env::var("OCCT_BRIDGE_CHILD") {
        let document = if path.ends_with("c.step") {
            crowd()
        } else {
            belt()
        };
        write_step_assembly(Path::new(&path), &document).unwrap();
    }
}

#[test]
fn two_processes_give_the_same_bytes() {
    let dir = tempfile::tempdir().unwrap();
    for name in ["b.step", "c.step"] {
        let texts: Vec<_> = (0..3)
            .map(|i| {
                let path = dir.path().join(format!("{i}-{name}"));
                let status = std::process::Command::new(std::env::current_exe().unwrap())
                    .args(["--exact", "child_writes_where_it_is_told"])
                    .env("OCCT_BRIDGE_CHILD", &path)
                    .output()
                    .unwrap()
                    .status;
                assert!(status.success());
                fs::read_to_string(path).unwrap()
            })
            .collect();
        // The header's name is the document's, not the path.
        assert!(texts[0].contains("two boxes"));
        assert!(texts[0] == texts[1] && texts[0] == texts[2]);
    }
}

#[test]
fn the_shared_flavour_keeps_a_common_face_and_the_assembly_does_not() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("shared.step");
    let solids = touching_boxes();
    let names = ["plain".to_owned(), "sand".to_owned()];
    write_step_shared(
        &path,
        &solids.compound().unwrap(),
        &names,
        &document(Vec::new()),
    )
    .unwrap();
    let count = |path: &Path| {
        let shapes: Vec<_> = read_step(path)
            .unwrap()
            .into_iter()
            .map(|p| p.shape)
            .collect();
        let all = compound(&shapes).unwrap();
        (
            all.count(ShapeKind::Solid).unwrap(),
            all.count(ShapeKind::Face).unwrap(),
        )
    };
    if let Ok(keep) = std::env::var("OCCT_BRIDGE_KEEP_SHARED") {
        fs::copy(&path, keep).unwrap();
    }
    assert_eq!(count(&path), (2, 11));
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("(1.E+03,10.,10.)"));
    assert!(text.contains("'sand'") && text.contains("SI_UNIT($,.METRE.)"));
    let assembly = document(vec![
        part("plain", [1, 2, 3], vec![solids.shape_of(0).unwrap()]),
        part("sand", [3, 2, 1], vec![solids.shape_of(1).unwrap()]),
    ]);
    write_step_assembly(&path, &assembly).unwrap();
    assert_eq!(count(&path), (2, 12));
}

/// Entities of a STEP file by number.
fn entities(text: &str) -> BTreeMap<usize, String> {
    let data = &text[text.find("DATA;").unwrap() + 5..];
    data.split(";\n")
        .filter_map(|line| {
            let (number, body) = line.trim().strip_prefix('#')?.split_once('=')?;
            Some((number.trim().parse().ok()?, body.replace(['\n', ' '], "")))
        })
        .collect()
}

/// References of an entity, in order.
fn references(body: &str) -> Vec<usize> {
    body.split('#')
        .skip(1)
        .map(|rest| {
            let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap();
            rest[..digits].parse().unwrap()
        })
        .collect()
}

/// An entity with everything it refers to written in its place.
fn expanded(entities: &BTreeMap<usize, String>, number: usize) -> String {
    let body = &entities[&number];
    let mut out = String::new();
    for (i, piece) in body.split('#').enumerate() {
        if i == 0 {
            out.push_str(piece);
            continue;
        }
        let digits = piece.find(|c: char| !c.is_ascii_digit()).unwrap();
        out.push_str(&expanded(entities, piece[..digits].parse().unwrap()));
        out.push_str(&piece[digits..]);
    }
    out
}

#[test]
fn the_two_copies_of_a_face_in_an_assembly_are_the_same_to_the_last_digit() {
    let course = |y: f64, phase: f64, top: f64| {
        bodies::Course {
            x: [-60.0, 560.0],
            y,
            slope: 0.1,
            amplitude: 60.0,
            wavelength: 400.0,
            phase,
            top,
            width: 50.0,
            depth: 6.0,
            stations: 20,
            segments: 2,
        }
        .solid()
    };
    let arguments = [
        box_solid([0.0, 0.0, -40.0], [500.0, 500.0, 0.0]).unwrap(),
        course(200.0, 0.3, -15.0),
        course(240.0, 2.5, -13.0),
    ];
    let p = partition(
        &arguments,
        &PartitionOptions::default(),
        &Cancel::new(),
        &|_| (),
    )
    .unwrap();
    let owner: Vec<_> = p
        .cells()
        .iter()
        .map(|c| c.inside.contains(&0).then(|| *c.inside.last().unwrap()))
        .collect();
    let solids = p.merge(&owner).unwrap();
    let shared = solids
        .faces()
        .iter()
        .filter(|f| f.solids.len() == 2)
        .count();
    assert!(shared > 8);
    let parts = (0..solids.solids().len())
        .map(|i| part(&format!("p{i}"), [7; 3], vec![solids.shape_of(i).unwrap()]));
    let text = written(&document(parts.collect()));
    let all = entities(&text);
    // Per face: its surface, its vertices and the curves of its edges in space. (Curves on surfaces name the neighbours, which differ.)
    let mut copies: BTreeMap<String, usize> = BTreeMap::new();
    for body in all.values().filter(|b| b.starts_with("ADVANCED_FACE(")) {
        let of_face = references(body);
        let (surface, bounds) = of_face.split_last().unwrap();
        let mut edges = Vec::new();
        for bound in bounds {
            let edge_loop = references(&all[bound])[0];
            for oriented in references(&all[&edge_loop]) {
                let edge = references(&all[&oriented])[0];
                let [a, b, curve] = references(&all[&edge])[..] else {
                    panic!("{}", all[&edge])
                };
                let in_space = references(&all[&curve])[0];
                edges.push([a, b, in_space].map(|n| expanded(&all, n)).join("|"));
            }
        }
        edges.sort();
        *copies
            .entry(format!("{}|{}", expanded(&all, *surface), edges.join("|")))
            .or_default() += 1;
    }
    assert_eq!(copies.values().filter(|n| **n == 2).count(), shared);
    assert_eq!(copies.len(), solids.faces().len());
}

#[test]
fn a_solid_with_a_void_is_refused_by_the_shared_flavour_and_kept_by_the_assembly() {
    let boxes = [
        box_solid([0.0; 3], [4.0; 3]).unwrap(),
        box_solid([1.0; 3], [2.0; 3]).unwrap(),
    ];
    let p = partition(
        &boxes,
        &PartitionOptions::default(),
        &Cancel::new(),
        &|_| (),
    )
    .unwrap();
    let owner: Vec<_> = p.cells().iter().map(|c| c.inside.last().copied()).collect();
    let solids = p.merge(&owner).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("void.step");
    let all = solids.compound().unwrap();
    let error = write_step_shared(&path, &all, &[], &document(Vec::new())).unwrap_err();
    assert!(error.to_string().contains("2 shells"), "{error}");
    let parts = (0..2).map(|i| part(&format!("p{i}"), [7; 3], vec![solids.shape_of(i).unwrap()]));
    write_step_assembly(&path, &document(parts.collect())).unwrap();
    let mut found: Vec<_> = read_step(&path)
        .unwrap()
        .iter()
        .map(|p| volume(&p.shape, 1e-9).unwrap())
        .collect();
    found.sort_by(f64::total_cmp);
    assert!((found[0] - 1.0).abs() < 1e-12 && (found[1] - 63.0).abs() < 1e-11);
}

#[test]
fn misuse_is_an_error_that_names_the_node() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.step");
    let cube = || box_solid([0.0; 3], [1.0; 3]).unwrap();
    let fails = |children| {
        write_step_assembly(&path, &document(children))
            .unwrap_err()
            .to_string()
    };
    let message = fails(vec![part("Sandkörper", [0; 3], vec![cube()])]);
    assert!(
        message.contains("Sandkörper") && message.contains("ASCII"),
        "{message}"
    );
    assert!(fails(vec![part("", [0; 3], vec![cube()])]).contains("name is empty"));
    assert!(
        fails(vec![part("empty", [0; 3], Vec::new())])
            .contains("\"empty\" has 0 shapes and 0 children")
    );
    let one = cube();
    let twice = vec![
        part("a", [0; 3], vec![one.clone()]),
        part("b", [0; 3], vec![one]),
    ];
    assert!(fails(twice).contains("a shape of \"b\" is used twice"));
    assert!(!path.exists());
}

#[test]
fn an_unwritable_or_unreadable_path_is_an_io_error() {
    let nowhere = Path::new("/nonexistent/a.step");
    let error = write_step_assembly(nowhere, &belt()).unwrap_err();
    assert!(matches!(error, BridgeError::Io { .. }), "{error:?}");
    let solids = touching_boxes().compound().unwrap();
    let error = write_step_shared(nowhere, &solids, &[], &document(Vec::new())).unwrap_err();
    assert!(matches!(error, BridgeError::Io { .. }), "{error:?}");
    let error = read_step(nowhere).unwrap_err();
    assert!(matches!(error, BridgeError::Io { .. }), "{error:?}");
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.step");
    fs::write(&path, "not STEP at all\n").unwrap();
    let error = read_step(&path).unwrap_err();
    assert!(matches!(error, BridgeError::Io { .. }), "{error:?}");
}
