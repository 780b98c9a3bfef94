//! No import goes in a circle: a file that takes from another one, directly or through others, gives nothing to it.

use std::collections::BTreeSet;
use std::path::Path as File;

use super::names::Path;
use super::tree::Tree;

/// Circles that are known, by the files that may be in them. They may only become smaller.
const KNOWN: &[&[&str]] = &[
    &["features/body.rs", "features/shell.rs", "features/side.rs"],
    &[
        "features/motion/affine.rs",
        "features/motion/fold.rs",
        "features/motion/heave.rs",
        "features/motion/mod.rs",
        "features/motion/slip.rs",
    ],
    &["model/check/family.rs", "model/check/feature.rs"],
    &["model/deserialize.rs", "model/read.rs"],
    &[
        "model/domain.rs",
        "model/draws.rs",
        "model/values/surface/draw.rs",
        "model/values/surface/mod.rs",
    ],
    &["model/expression.rs", "model/formula.rs"],
    &[
        "model/kinds/clinoforms.rs",
        "model/kinds/clinoforms/draw.rs",
    ],
    &[
        "model/realisation.rs",
        "model/realisation/apart.rs",
        "model/realisation/listing.rs",
        "model/realisation/listing/blocks.rs",
        "model/realisation/listing/coincidence.rs",
        "model/realisation/listing/volumes.rs",
        "model/realisation/making.rs",
    ],
    &[
        "model/realisation/listing/coincidence/change.rs",
        "model/realisation/listing/coincidence/contact.rs",
        "model/realisation/listing/coincidence/deciding.rs",
        "model/realisation/listing/coincidence/points.rs",
    ],
    &["model/rules.rs", "model/rules/meeting.rs"],
    &[
        "partition/mod.rs",
        "partition/alone.rs",
        "partition/along.rs",
        "partition/arcs.rs",
        "partition/common.rs",
        "partition/contours.rs",
        "partition/crossings.rs",
        "partition/edge.rs",
        "partition/faces.rs",
        "partition/heights.rs",
        "partition/hermite.rs",
        "partition/known.rs",
        "partition/landing.rs",
        "partition/march.rs",
        "partition/pair.rs",
        "partition/pierce.rs",
        "partition/place.rs",
        "partition/quadrature.rs",
        "partition/region.rs",
        "partition/region/joints.rs",
        "partition/region/outward.rs",
        "partition/region/shape.rs",
        "partition/seeds.rs",
        "partition/sheet.rs",
        "partition/solids.rs",
        "partition/topology.rs",
        "partition/touch.rs",
        "partition/tracks.rs",
        "partition/triples.rs",
        "partition/twins.rs",
    ],
];

/// The circles of a package: files that can all be reached from each other.
fn circles(tree: &Tree) -> Vec<BTreeSet<&str>> {
    let paths: Vec<&Path> = tree.modules.keys().collect();
    let count = paths.len();
    let mut leads: Vec<Vec<bool>> = paths
        .iter()
        .map(|path| {
            let taken = tree.taken_by(path);
            paths.iter().map(|other| taken.contains(*other)).collect()
        })
        .collect();
    // Warshall's transitive closure.
    for through in 0..count {
        let onward = leads[through].clone();
        for from in &mut leads {
            if from[through] {
                for (at, leads) in from.iter_mut().enumerate() {
                    *leads |= onward[at];
                }
            }
        }
    }
    let mut found: Vec<BTreeSet<&str>> = Vec::new();
    for one in (0..count).filter(|one| leads[*one][*one]) {
        let circle = (0..count)
            .filter(|other| leads[one][*other] && leads[*other][one])
            .map(|other| tree.modules[paths[other]].file.as_str())
            .collect();
        if !found.contains(&circle) {
            found.push(circle);
        }
    }
    found
}

/// The circles that are in none of the known ones.
fn unknown<'a>(tree: &'a Tree, known: &[&[&str]]) -> Vec<BTreeSet<&'a str>> {
    let mut circles = circles(tree);
    circles.retain(|circle| {
        !known
            .iter()
            .any(|files| circle.iter().all(|file| files.contains(file)))
    });
    circles
}

#[test]
fn no_import_goes_in_a_circle() {
    let root = File::new(env!("CARGO_MANIFEST_DIR"));
    let ours = Tree::read(&root.join("src"));
    let bridge = Tree::read(&root.join("occt-bridge/src"));
    let new = [unknown(&ours, KNOWN), unknown(&bridge, &[])].concat();
    let said: Vec<String> = new.iter().map(|circle| format!("{circle:#?}")).collect();
    assert!(
        new.is_empty(),
        "files import each other in a circle; what they all want goes below them:\n{}",
        said.join("\n")
    );
    let circles = circles(&ours);
    for files in KNOWN {
        let is_there = |file: &&str| circles.iter().any(|circle| circle.contains(*file));
        let gone: Vec<_> = files.iter().filter(|file| !is_there(file)).collect();
        assert!(
            gone.is_empty(),
            "in no circle any more; strike them from the list: {gone:?}"
        );
    }
}

fn tree(files: &[(&str, &str)]) -> Tree {
    let owned = |(file, text): &(&str, &str)| ((*file).to_owned(), (*text).to_owned());
    Tree::new(&files.iter().map(owned).collect::<Vec<_>>())
}

#[test]
fn circles_are_found_however_the_imports_are_written() {
    for (a, b) in [
        ("use crate::b::B; struct A;", "use crate::a::A; struct B;"),
        (
            "use super::b; fn f() -> b::B { b::B }",
            "use super::{a::A}; struct B;",
        ),
        (
            "struct A; fn f() { println!(\"{}\", crate::b::B) }",
            "pub use super::a::A; struct B(A);",
        ),
        (
            "use super::*; struct A; fn f(_: super::B) {}",
            "use crate::A; struct B;",
        ),
    ] {
        let tree = tree(&[
            ("lib.rs", "mod a; mod b; pub use a::A; pub use b::*;"),
            ("a.rs", a),
            ("b.rs", b),
        ]);
        assert_eq!(
            circles(&tree),
            [BTreeSet::from(["a.rs", "b.rs"])],
            "{a} {b}"
        );
        assert!(unknown(&tree, &[&["a.rs", "b.rs", "c.rs"]]).is_empty());
        assert_eq!(unknown(&tree, &[&["a.rs"]]).len(), 1);
    }
}

#[test]
fn imports_one_way_are_no_circle() {
    let tree = tree(&[
        // A façade hands on, and takes nothing.
        ("lib.rs", "mod a; mod b; mod c; pub use a::A; pub use b::B;"),
        (
            "a.rs",
            "/// See [`crate::b::B`].\nstruct A; #[cfg(test)] mod tests { use crate::b::B; }",
        ),
        (
            "b.rs",
            "use crate::A; pub struct B(A); #[cfg(test)] mod tests;",
        ),
        ("b/tests.rs", "use super::B; use crate::c::C;"),
        ("c.rs", "use super::{A, B}; struct C(A, B);"),
    ]);
    assert_eq!(circles(&tree), [] as [BTreeSet<&str>; 0]);
    assert_eq!(tree.modules.len(), 4);
}
