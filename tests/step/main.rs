//! STEP as it is written, entity by entity, and as a reader that is not ours has it: `OpenCASCADE`'s.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "../assembled/mod.rs"]
mod assembled;
#[path = "../../occt-bridge/tests/bodies/mod.rs"]
mod bodies;
mod entities;
mod failures;
mod far;
mod flavours;
mod models;
mod seams;
mod text;
mod wires;

use std::path::{Path, PathBuf};

use clinothem::export::ExportError;
use clinothem::export::step::{Content, Document, Exchange, Node, Protocol, assembly, shared};
use occt_bridge::{
    Cancel, LengthUnit, PartitionOptions, ReadPart, Shape, Solids, Threads, boundary, box_solid,
    defects, partition, read_step, read_step_in,
};

/// A part with a layer and a description.
fn part(name: &str, color: [u8; 3], shapes: Vec<usize>) -> Node {
    Node {
        name: name.to_owned(),
        label: None,
        color: Some(color),
        layer: Some(format!("layer of {name}")),
        description: Some("porosity=0.25".to_owned()),
        content: Content::Shapes(shapes),
    }
}

fn group(name: &str, nodes: Vec<Node>) -> Node {
    Node {
        name: name.to_owned(),
        label: None,
        color: None,
        layer: None,
        description: None,
        content: Content::Nodes(nodes),
    }
}

fn document(nodes: Vec<Node>) -> Document {
    Document {
        name: "two boxes".to_owned(),
        system: "clinothem 0.1.0".to_owned(),
        description: "a test".to_owned(),
        protocol: Protocol::Ap214,
        accuracy: 1e-7,
        root: group("model", nodes),
    }
}

/// Every shape a part by itself.
fn parts(count: usize) -> Document {
    document(
        (0..count)
            .map(|i| part(&format!("p{i}"), [7; 3], vec![i]))
            .collect(),
    )
}

fn shapes_of(solids: &Solids) -> Vec<Shape> {
    (0..solids.solids().len())
        .map(|i| solids.shape_of(i).unwrap())
        .collect()
}

/// Arguments cut by each other; the last that holds a place owns it.
fn cut(arguments: &[Shape]) -> Vec<Shape> {
    let options = PartitionOptions::default();
    let cut = partition(arguments, &options, &Cancel::new(), &|_| ()).unwrap();
    let owner: Vec<_> = cut
        .cells()
        .iter()
        .map(|cell| cell.inside.last().copied())
        .collect();
    shapes_of(&cut.merge(&owner).unwrap())
}

/// 1 km and 500 m long, with a face in common.
fn touching_boxes() -> Vec<Shape> {
    cut(&[
        box_solid([0.0; 3], [1000.0, 10.0, 10.0]).unwrap(),
        box_solid([1000.0, 0.0, 0.0], [1500.0, 10.0, 10.0]).unwrap(),
    ])
}

/// A file in a folder of its own.
struct Written {
    folder: tempfile::TempDir,
}

impl Written {
    fn assembly(document: &Document, shapes: &[Shape]) -> Self {
        let file = assembly(document, &boundary(shapes).unwrap());
        Self::of(&file.unwrap())
    }

    fn shared(document: &Document, names: &[&str], shapes: &[Shape]) -> Self {
        let names: Vec<String> = names.iter().map(ToString::to_string).collect();
        let file = shared(document, &names, &boundary(shapes).unwrap());
        Self::of(&file.unwrap())
    }

    fn of(file: &Exchange) -> Self {
        Self::save(|path| {
            file.save(path).unwrap();
            Ok(())
        })
    }

    fn save(write: impl FnOnce(&Path) -> Result<(), ExportError>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        write(&folder.path().join("a.step")).unwrap();
        Self { folder }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("a.step")
    }

    fn text(&self) -> String {
        std::fs::read_to_string(self.path()).unwrap()
    }

    fn read(&self) -> Vec<ReadPart> {
        read_step(&self.path()).unwrap()
    }

    fn read_in(&self, unit: LengthUnit) -> Vec<ReadPart> {
        read_step_in(&self.path(), unit).unwrap()
    }
}

/// The reader's own checker finds nothing wrong.
fn assert_valid(shapes: &[Shape]) {
    let solids = Solids::from_shapes(shapes).unwrap();
    assert_eq!(defects(&solids, Threads::All).unwrap(), []);
}

fn near(found: f64, exact: f64, relative: f64) {
    assert!(
        (found / exact - 1.0).abs() < relative,
        "{found} for {exact}: {:e}",
        found / exact - 1.0
    );
}
