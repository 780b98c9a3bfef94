//! Imports go downward only: what a layer may name of the others, and who may name the kernel.
//!
//! The features of Cargo prove that the lower layers build without the kernel; this finds the rest.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::path::{Path, PathBuf};

/// Each layer with the layers that it may name besides itself, lowest first.
const LAYERS: [(&str, &[&str]); 7] = [
    ("nurbs", &[]),
    ("features", &["nurbs"]),
    ("model", &["features", "nurbs"]),
    ("partition", &["nurbs"]),
    ("assembly", &["partition", "model", "features", "nurbs"]),
    ("export", &["assembly", "model", "features", "nurbs"]),
    ("cli", &["export", "assembly", "model", "features", "nurbs"]),
];

/// The only file that may name the kernel's bridge.
const KERNEL: &str = "assembly/kernel.rs";

/// The code without comments and spaces, so that `crate :: x` and a doc link are told apart.
fn code(text: &str) -> String {
    text.lines()
        .map(|line| line.split("//").next().unwrap_or(""))
        .flat_map(str::chars)
        .filter(|c| !c.is_whitespace())
        .collect()
}

/// The modules at the crate's root that a text names: `crate::x`, `crate::{x, y::z}`, `clinothem::x`,
/// and `super::…::x` where that leads to the root.
fn named(text: &str, depth: usize) -> Vec<String> {
    let code = code(text);
    let root = "super::".repeat(depth);
    let mut found = Vec::new();
    for start in ["crate::", "clinothem::", &root] {
        for (at, _) in code.match_indices(start) {
            // `super::super::x` in a file of depth 3 is no way to the root, nor is its tail.
            let climbs = start == root;
            if climbs && (depth == 0 || code[..at].ends_with("super::")) {
                continue;
            }
            found.extend(heads(&code[at + start.len()..]));
        }
    }
    found
}

/// The first names of a path or of a group of paths.
fn heads(path: &str) -> Vec<String> {
    let ident = |text: &str| -> String {
        text.chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect()
    };
    let Some(group) = path.strip_prefix('{') else {
        return vec![ident(path)];
    };
    let (mut found, mut nested, mut from) = (Vec::new(), 0_usize, 0);
    for (at, c) in group.char_indices() {
        match c {
            '{' => nested += 1,
            '}' if nested > 0 => nested -= 1,
            ',' | '}' if nested == 0 => {
                found.push(ident(&group[from..at]));
                from = at + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    found.retain(|name| !name.is_empty());
    found
}

/// What a file under `src` must not name but does.
fn violations(path: &str, text: &str) -> Vec<String> {
    let mut wrong = Vec::new();
    let parts: Vec<&str> = path.split('/').collect();
    // `src/model/rules.rs` is `crate::model::rules`, two below the root; `src/model/mod.rs` is one.
    let depth = parts.len() - usize::from(path.ends_with("/mod.rs"));
    if let Some((layer, below)) = LAYERS.iter().find(|(layer, _)| *layer == parts[0]) {
        for name in named(text, depth) {
            let is_layer = LAYERS.iter().any(|(other, _)| *other == name);
            if is_layer && name != *layer && !below.contains(&name.as_str()) {
                wrong.push(format!("src/{path}: {layer} names {name}"));
            }
        }
    }
    if path != KERNEL && code(text).contains("occt_bridge") {
        wrong.push(format!("src/{path} names occt_bridge; only {KERNEL} may"));
    }
    wrong
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn imports_go_downward_and_only_one_file_names_the_kernel() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    files.sort();
    let mut wrong = Vec::new();
    let mut layers: Vec<String> = Vec::new();
    for file in &files {
        let path = file.strip_prefix(&root).unwrap().to_str().unwrap();
        layers.push(path.split('/').next().unwrap().to_owned());
        wrong.extend(violations(path, &std::fs::read_to_string(file).unwrap()));
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
    // A layer that was renamed would be checked no more.
    for (layer, _) in LAYERS {
        assert!(layers.iter().any(|found| found == layer), "no src/{layer}");
    }
    // Nor may one be added beside the list.
    layers.retain(|layer| !layer.contains('.'));
    layers.retain(|layer| LAYERS.iter().all(|(known, _)| known != layer));
    assert!(layers.is_empty(), "layers that have no place: {layers:?}");
}

#[test]
fn an_import_that_goes_upward_is_found_however_it_is_written() {
    for (path, line) in [
        ("nurbs/curve.rs", "use crate::model::Model;"),
        ("nurbs/curve.rs", "use crate::{features, nurbs::Curve};"),
        ("nurbs/mod.rs", "use super::features::body::Trough;"),
        ("nurbs/enclosure/tally.rs", "use super::super::super::cli;"),
        ("features/body.rs", "fn f() -> crate::model::Model {"),
        ("model/plan.rs", "use crate :: assembly;"),
        (
            "model/check/mod.rs",
            "use crate::{nurbs::{Curve, Surface}, export};",
        ),
        ("assembly/proof.rs", "use crate::export::report::Report;"),
        ("export/step.rs", "use crate::cli;"),
        ("assembly/proof.rs", "let s = occt_bridge::solid();"),
        ("cli/build.rs", "use occt_bridge::Shape;"),
    ] {
        assert_eq!(violations(path, line).len(), 1, "{path}: {line}");
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
        assert_eq!(violations(path, line), [""; 0], "{path}: {line}");
    }
}
