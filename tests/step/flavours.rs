//! The assembly and the shared flavour, of boxes and of bodies that cross.

use std::collections::BTreeMap;

use occt_bridge::{ShapeKind, bounds, box_solid, compound, volume};

use super::entities::Entities;
use super::{
    Written, assert_valid, bodies, cut, document, group, near, part, parts, touching_boxes,
};
use clinothem::export::step::{Document, Protocol};
use occt_bridge::Shape;

/// An assembly in an assembly, and a part of two pieces.
fn belt() -> (Document, Vec<Shape>) {
    let mut shapes = touching_boxes();
    shapes.push(box_solid([0.0, 20.0, 0.0], [1.0, 21.0, 1.0]).unwrap());
    shapes.push(box_solid([5.0, 20.0, 0.0], [6.0, 22.0, 1.0]).unwrap());
    let document = document(vec![
        part("plain", [200, 190, 120], vec![0]),
        group(
            "belt",
            vec![
                part("sand", [250, 220, 50], vec![1]),
                part("mud", [80, 90, 100], vec![2, 3]),
            ],
        ),
    ]);
    (document, shapes)
}

#[test]
fn an_assembly_comes_back_with_names_colours_layers_tree_and_metres() {
    for protocol in [Protocol::Ap214, Protocol::Ap242] {
        let (mut document, shapes) = belt();
        document.protocol = protocol;
        let written = Written::assembly(&document, &shapes);
        Entities::of(&written.text()).check();
        let parts = written.read();
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
            near(volume(&part.shape, 1e-9).unwrap(), exact, 1e-12);
        }
        assert_eq!(parts[2].shape.count(ShapeKind::Solid).unwrap(), 2);
        let b = bounds(&parts[0].shape).unwrap();
        assert!((b.max[0] - 1000.0).abs() < 1e-6, "{b:?}");
    }
}

#[test]
fn the_file_declares_metres_and_its_numbers_are_metres() {
    for (protocol, name) in [
        (
            Protocol::Ap214,
            "'AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'",
        ),
        (
            Protocol::Ap242,
            "'AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }'",
        ),
    ] {
        let (mut document, shapes) = belt();
        document.protocol = protocol;
        let text = Written::assembly(&document, &shapes).text();
        assert!(text.contains("SI_UNIT($,.METRE.)"));
        assert!(!text.contains(".MILLI.,.METRE."));
        // The corner that the two boxes share, and nothing a thousand times further or nearer.
        assert!(text.contains("(1000.,10.,10.)"));
        assert!(!text.contains("1000000.") && !text.contains("(1.,0.01,0.01)"));
        assert!(text.contains(name));
    }
}

#[test]
fn names_are_those_of_the_products_and_identifiers_differ() {
    let (mut document, shapes) = belt();
    document.root.name = "sand".to_owned();
    let text = Written::assembly(&document, &shapes).text();
    assert!(text.contains("PRODUCT('sand','sand','',"));
    assert!(text.contains("PRODUCT('sand #2','sand','porosity=0.25',"));
    assert!(
        text.contains("FILE_NAME('two boxes','1970-01-01T00:00:00',(''),(''),'clinothem 0.1.0'")
    );
    assert!(text.contains("FILE_DESCRIPTION(('a test'),'2;1');"));
    let count = |what: &str| text.matches(what).count();
    assert_eq!(count("=PRODUCT("), 5);
    assert_eq!(count("=NEXT_ASSEMBLY_USAGE_OCCURRENCE("), 4);
    assert_eq!(count("=MANIFOLD_SOLID_BREP("), 4);
    assert_eq!(count("=STYLED_ITEM("), 4);
    assert_eq!(count("=COLOUR_RGB("), 3);
}

#[test]
fn colours_and_layers_that_parts_share_are_there_once() {
    let shapes: Vec<Shape> = (0..40)
        .map(|i| {
            let x = 3.0 * f64::from(i);
            box_solid([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]).unwrap()
        })
        .collect();
    let colors = [[9, 9, 9], [99, 9, 9], [9, 99, 9]];
    let layers = ["sand", "mud"];
    let nodes = (0..40).map(|i| {
        let mut node = part(&format!("part-{i}"), colors[i % 3], vec![i]);
        node.layer = Some(layers[i % 2].to_owned());
        node
    });
    let written = Written::assembly(&document(nodes.collect()), &shapes);
    let entities = Entities::of(&written.text());
    entities.check();
    assert_eq!(entities.count("COLOUR_RGB"), 3);
    assert_eq!(entities.count("PRESENTATION_LAYER_ASSIGNMENT"), 2);
    for (i, read) in written.read().iter().enumerate() {
        assert_eq!(read.color, Some(colors[i % 3]), "{}", read.name);
        assert_eq!(read.layer.as_deref(), Some(layers[i % 2]), "{}", read.name);
    }
}

#[test]
fn the_same_document_gives_the_same_bytes_on_any_number_of_threads() {
    let (document, shapes) = belt();
    let first = Written::assembly(&document, &shapes).text();
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let again = pool.install(|| Written::assembly(&belt().0, &belt().1).text());
        assert!(first == again, "{threads} threads");
    }
}

/// Two sinuous channels that cross in a block.
fn channels() -> Vec<Shape> {
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
    let options = occt_bridge::PartitionOptions::default();
    let cancel = occt_bridge::Cancel::new();
    let cut = occt_bridge::partition(&arguments, &options, &cancel, &|_| ()).unwrap();
    let inside = |c: &occt_bridge::Cell| c.inside.contains(&0).then(|| *c.inside.last().unwrap());
    let owner: Vec<_> = cut.cells().iter().map(inside).collect();
    super::shapes_of(&cut.merge(&owner).unwrap())
}

#[test]
fn the_two_copies_of_a_face_in_an_assembly_are_the_same_to_the_last_digit() {
    let shapes = channels();
    let all_faces = compound(&shapes).unwrap().count(ShapeKind::Face).unwrap();
    let each = shapes.iter().map(|s| s.count(ShapeKind::Face).unwrap());
    let shared = each.sum::<usize>() - all_faces;
    assert!(shared > 8);
    let written = Written::assembly(&parts(shapes.len()), &shapes);
    let all = Entities::of(&written.text());
    all.check();
    // Per face: its surface, its vertices and the curves of its edges in space. (Curves on surfaces name the neighbours, which differ.)
    let mut copies: BTreeMap<String, usize> = BTreeMap::new();
    for face in all.named("ADVANCED_FACE") {
        let (surface, loops) = all.face(face);
        let mut edges = Vec::new();
        for oriented in loops.iter().flat_map(|edges| all.below(*edges)) {
            let edge = all.below(oriented)[0];
            let [a, b, curve] = all.below(edge)[..] else {
                panic!("{}", all.body(edge))
            };
            let in_space = all.below(curve)[0];
            edges.push([a, b, in_space].map(|n| all.expanded(n)).join("|"));
        }
        edges.sort();
        *copies
            .entry(format!("{}|{}", all.expanded(surface), edges.join("|")))
            .or_default() += 1;
    }
    assert_eq!(copies.values().filter(|n| **n == 2).count(), shared);
    assert_eq!(copies.len(), all_faces);
    // What they have in common is written once.
    assert_eq!(
        all.count("PLANE") + all.count("B_SPLINE_SURFACE_WITH_KNOTS"),
        all_faces
    );
    let read: Vec<_> = written.read().into_iter().map(|p| p.shape).collect();
    assert_valid(&read);
    for (back, of) in read.iter().zip(&shapes) {
        near(
            volume(back, 1e-10).unwrap(),
            volume(of, 1e-10).unwrap(),
            1e-9,
        );
        for kind in [ShapeKind::Face, ShapeKind::Edge, ShapeKind::Vertex] {
            assert_eq!(back.count(kind).unwrap(), of.count(kind).unwrap());
        }
    }
}

#[test]
fn the_shared_flavour_keeps_a_common_face_and_the_assembly_does_not() {
    let shapes = touching_boxes();
    let count = |written: &Written| {
        let shapes: Vec<_> = written.read().into_iter().map(|p| p.shape).collect();
        let all = compound(&shapes).unwrap();
        (
            all.count(ShapeKind::Solid).unwrap(),
            all.count(ShapeKind::Face).unwrap(),
        )
    };
    let shared = Written::shared(&document(Vec::new()), &["plain", "sand"], &shapes);
    let entities = Entities::of(&shared.text());
    entities.check();
    assert_eq!(count(&shared), (2, 11));
    let text = shared.text();
    assert!(text.contains("(1000.,10.,10.)"));
    assert!(text.contains("SHELL_BASED_SURFACE_MODEL('sand',"));
    assert!(text.contains("PRODUCT('model','model',''"));
    assert!(text.contains("SI_UNIT($,.METRE.)"));
    assert_eq!(entities.count("ADVANCED_FACE"), 12);
    assert_eq!(entities.count("EDGE_CURVE"), 20);
    assert_eq!(entities.count("PLANE"), 11);
    assert_eq!(count(&Written::assembly(&parts(2), &shapes)), (2, 12));
}

#[test]
fn solids_of_the_shared_flavour_have_their_volumes_and_common_faces() {
    let shapes = channels();
    let names = ["block", "old", "young"];
    let written = Written::shared(&document(Vec::new()), &names[..shapes.len()], &shapes);
    Entities::of(&written.text()).check();
    let read: Vec<_> = written.read().into_iter().map(|p| p.shape).collect();
    let (back, all) = (compound(&read).unwrap(), compound(&shapes).unwrap());
    for kind in [ShapeKind::Solid, ShapeKind::Face, ShapeKind::Edge] {
        assert_eq!(back.count(kind).unwrap(), all.count(kind).unwrap());
    }
    // Some curves on surfaces are not in the file: an edge can name two. The reader makes them anew, to its own tolerance.
    near(
        volume(&back, 1e-10).unwrap(),
        volume(&all, 1e-10).unwrap(),
        1e-7,
    );
}

#[test]
fn a_solid_with_a_void_is_kept_by_the_assembly() {
    let shapes = cut(&[
        box_solid([0.0; 3], [4.0; 3]).unwrap(),
        box_solid([1.0; 3], [2.0; 3]).unwrap(),
    ]);
    let written = Written::assembly(&parts(2), &shapes);
    let entities = Entities::of(&written.text());
    entities.check();
    assert_eq!(entities.count("BREP_WITH_VOIDS"), 1);
    assert_eq!(entities.count("MANIFOLD_SOLID_BREP"), 1);
    // The shell around the void looks out of it, like that of what fills it, and is turned.
    let [void] = entities.named("ORIENTED_CLOSED_SHELL")[..] else {
        panic!("not one void")
    };
    assert!(entities.body(void).ends_with(".F.)"));
    let sense = |shell: usize| {
        let faces = entities.below(shell).into_iter();
        let mut senses: Vec<_> = faces
            .map(|face| (entities.face(face).0, entities.body(face).ends_with(".T.)")))
            .collect();
        senses.sort_unstable();
        senses
    };
    let [filling] = entities.named("MANIFOLD_SOLID_BREP")[..] else {
        panic!("not one filling")
    };
    let [void, filling] = [void, filling].map(|solid| sense(entities.below(solid)[0]));
    assert_eq!(void, filling);
    let read: Vec<_> = written.read().into_iter().map(|p| p.shape).collect();
    assert_valid(&read);
    let mut found: Vec<_> = read.iter().map(|s| volume(s, 1e-9).unwrap()).collect();
    found.sort_by(f64::total_cmp);
    near(found[0], 1.0, 1e-12);
    near(found[1], 63.0, 1e-12);
}
