//! Imports go downward only: what a layer may name of the others, and who may name the kernel.

use std::collections::BTreeSet;
use std::path::Path as File;

use super::names::{Names, Path};
use super::tree::Tree;

/// Each layer with the layers that it may name besides itself, lowest first.
const LAYERS: [(&str, &[&str]); 10] = [
    ("data", &[]),
    ("nurbs", &[]),
    ("mesh", &["nurbs"]),
    ("features", &["mesh", "nurbs"]),
    ("model", &["features", "nurbs", "data"]),
    ("partition", &["nurbs"]),
    (
        "assembly",
        &["partition", "model", "features", "mesh", "nurbs"],
    ),
    (
        "export",
        &["mesh", "assembly", "model", "features", "nurbs", "data"],
    ),
    ("ensemble", &["export", "assembly", "model"]),
    (
        "cli",
        &[
            "ensemble", "export", "mesh", "assembly", "model", "features", "nurbs",
        ],
    ),
];

/// The only file that may name the kernel's bridge.
const KERNEL: &str = "assembly/kernel.rs";

/// The module at the crate's root, or the other package, that a path of a module leads to.
fn head<'a>(module: &'a Path, path: &'a Path) -> Option<&'a str> {
    let climbs = path.iter().take_while(|name| *name == "super").count();
    let first = match path[0].as_str() {
        "crate" | "clinothem" => path.get(1),
        "super" if climbs < module.len() => module.first(),
        "super" => path.get(climbs),
        _ => path.first(),
    };
    first.map(String::as_str)
}

/// What a file under `src` must not name but does.
fn violations(module: &Path, file: &str, names: &Names) -> BTreeSet<String> {
    let mut wrong = BTreeSet::new();
    let below = LAYERS.iter().find(|(layer, _)| *layer == module[0]);
    for path in &names.named {
        let Some(head) = head(module, path) else {
            continue;
        };
        let is_inside = !matches!(path[0].as_str(), "crate" | "clinothem" | "super");
        if head == "occt_bridge" && file != KERNEL {
            wrong.insert(format!("src/{file} names occt_bridge; only {KERNEL} may"));
        }
        let Some((layer, below)) = below.filter(|_| !is_inside) else {
            continue;
        };
        let is_layer = LAYERS.iter().any(|(other, _)| *other == head);
        if is_layer && head != *layer && !below.contains(&head) {
            wrong.insert(format!("src/{file}: {layer} names {head}"));
        }
    }
    wrong
}

#[test]
fn imports_go_downward_and_only_one_file_names_the_kernel() {
    let tree = Tree::read(&File::new(env!("CARGO_MANIFEST_DIR")).join("src"));
    let modules = || tree.modules.iter().filter(|(path, _)| !path.is_empty());
    let wrong: BTreeSet<String> = modules()
        .chain(&tree.tests)
        .flat_map(|(path, module)| violations(path, &module.file, &module.names))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    // A layer that was renamed would be checked no more, and none may be added beside the list.
    let mut found: BTreeSet<&str> = modules().map(|(path, _)| path[0].as_str()).collect();
    found.remove("main");
    assert_eq!(found, LAYERS.iter().map(|(layer, _)| *layer).collect());
}

fn violations_of(file: &str, text: &str) -> usize {
    let tree = Tree::new(&[(file.to_owned(), text.to_owned())]);
    let (path, module) = tree.modules.first_key_value().unwrap();
    violations(path, &module.file, &module.names).len()
}

#[test]
fn an_import_that_goes_upward_is_found_however_it_is_written() {
    for (path, line) in [
        ("nurbs/curve.rs", "use crate::model::Model;"),
        ("nurbs/curve.rs", "use crate::{features, nurbs::Curve};"),
        ("nurbs/mod.rs", "use super::features::body::Trough;"),
        ("nurbs/mod.rs", "pub use super::features::body::Trough;"),
        ("nurbs/enclosure/tally.rs", "use super::super::super::cli;"),
        ("features/body.rs", "fn f() -> crate::model::Model {}"),
        (
            "features/body.rs",
            "fn f() { assert!(crate::model::is_good()) }",
        ),
        ("model/plan.rs", "use crate :: assembly;"),
        (
            "model/check/mod.rs",
            "use crate::{nurbs::{Curve, Surface}, export};",
        ),
        ("assembly/proof.rs", "use crate::export::report::Report;"),
        ("export/step.rs", "use crate::cli;"),
        (
            "assembly/proof.rs",
            "fn f() { let s = occt_bridge::solid(); }",
        ),
        ("cli/build.rs", "use occt_bridge::Shape;"),
    ] {
        assert_eq!(violations_of(path, line), 1, "{path}: {line}");
    }
}

#[test]
fn imports_that_go_downward_are_no_violation() {
    for (path, line) in [
        ("nurbs/curve.rs", "use crate::nurbs::KnotVector;"),
        ("nurbs/curve.rs", "//! The [model](crate::model) uses it."),
        ("nurbs/enclosure/tally.rs", "use super::super::Surface;"),
        ("features/body.rs", "use crate::nurbs::{Curve, Surface};"),
        ("model/plan.rs", "use super::features_of;"),
        ("assembly/kernel.rs", "use occt_bridge::Cancel;"),
        (
            "cli/build.rs",
            "use crate::{assembly, export::step, model::Model};",
        ),
        ("export/step.rs", "use crate::assembly::kernel;"),
    ] {
        assert_eq!(violations_of(path, line), 0, "{path}: {line}");
    }
}
