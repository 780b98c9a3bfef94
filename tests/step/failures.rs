//! What cannot be written: documents that do not fit their shapes, places that take no file.

use std::path::Path;

use assert_cmd::Command;
use clinothem::export::step::{Content, Document, assembly, shared};
use occt_bridge::{Shape, boundary, box_solid, faces};

use super::{bodies, cut, document, group, part, parts};

fn cube() -> Shape {
    box_solid([0.0; 3], [1.0; 3]).unwrap()
}

fn refusal(document: &Document) -> String {
    let boundary = boundary(&[cube()]).unwrap();
    assembly(document, &boundary).unwrap_err().to_string()
}

#[test]
fn a_document_that_does_not_fit_is_refused_by_the_name_of_the_node() {
    let message = refusal(&document(vec![part("sand", [0; 3], vec![0, 1])]));
    assert!(
        message.contains("\"sand\" names shape 1, but there are 1"),
        "{message}"
    );
    let message = refusal(&document(vec![part("", [0; 3], vec![0])]));
    assert!(message.contains("\"\" is no name"), "{message}");
    let message = refusal(&document(vec![part("empty", [0; 3], Vec::new())]));
    assert!(message.contains("\"empty\" has no shapes"), "{message}");
    let message = refusal(&document(vec![group("belt", Vec::new())]));
    assert!(message.contains("\"belt\" has no parts"), "{message}");
    let wire = |curves: Vec<usize>| {
        let mut wire = part("A-1", [0; 3], Vec::new());
        wire.content = Content::Curves(curves);
        document(vec![wire])
    };
    let message = refusal(&wire(Vec::new()));
    assert!(message.contains("\"A-1\" has no curves"), "{message}");
    let message = refusal(&wire(vec![0, 12]));
    assert!(
        message.contains("\"A-1\" names curve 12, but there are 12"),
        "{message}"
    );
    let mut good = document(vec![part("sand", [0; 3], vec![0])]);
    assert!(assembly(&good, &boundary(&[cube()]).unwrap()).is_ok());
    good.root.content = Content::Nodes(Vec::new());
    assert!(refusal(&good).contains("\"model\" has no parts"));
}

#[test]
fn the_shared_flavour_refuses_voids_faces_and_wrong_numbers_of_names() {
    let names = ["a".to_owned(), "b".to_owned()];
    let refusal = |names: &[String], shapes: &[Shape]| {
        let boundary = boundary(shapes).unwrap();
        let refused = shared(&document(Vec::new()), names, &boundary);
        refused.unwrap_err().to_string()
    };
    let nested = cut(&[
        box_solid([0.0; 3], [4.0; 3]).unwrap(),
        box_solid([1.0; 3], [2.0; 3]).unwrap(),
    ]);
    let message = refusal(&names, &nested);
    assert!(
        message.contains("a has 2 shells") && message.contains("BREP"),
        "{message}"
    );
    let message = refusal(&names, &[cube()]);
    assert!(message.contains("2 names for 1 solids"), "{message}");
    let skin = faces(&bodies::cylinder_topology([0.0, 5.0], [1.0, 2.0], 3.0)).unwrap();
    let message = refusal(&names[..1], &[skin]);
    assert!(message.contains("a is not a solid"), "{message}");
}

#[test]
fn a_place_that_takes_no_file_is_an_error_and_an_earlier_file_stays() {
    let boundary = boundary(&[cube()]).unwrap();
    let file = || assembly(&parts(1), &boundary).unwrap();
    assert!(file().save(Path::new("/nonexistent/a.step")).is_err());
    // A folder of that name is in the way: nothing is left beside it.
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("a.step")).unwrap();
    assert!(file().save(&folder.path().join("a.step")).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn a_disk_that_fills_up_is_told_with_3_and_leaves_nothing() {
    // A limit on the size of files stands for a full disk: the write fails when a part of the file is there.
    let folder = tempfile::tempdir().unwrap();
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/quickstart/quickstart.toml");
    for command in ["surfaces $model -o out.step", "build $model --quiet -o out"] {
        let script = format!("trap '' XFSZ; ulimit -f 40; exec \"$program\" {command}");
        let output = Command::new("sh")
            .args(["-c", &script])
            .env("program", assert_cmd::cargo::cargo_bin!("clinothem"))
            .env("model", &model)
            .current_dir(folder.path())
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{command}: {errors}");
        assert!(errors.contains("cannot write"), "{errors}");
        assert_eq!(
            std::fs::read_dir(folder.path()).unwrap().count(),
            0,
            "{command}"
        );
    }
}
