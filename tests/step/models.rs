//! Committed models: what the report says is what a reader finds.

use std::collections::{BTreeMap, BTreeSet};

use clinothem::assembly::Engine;
use clinothem::export::step::{Protocol, write_assembly, write_shared, write_surfaces};
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::nurbs::Surface;
use occt_bridge::{ShapeKind, area, volume};

use super::assembled::{Built, checked, source};
use super::entities::Entities;
use super::{Written, assert_valid, near};

/// Products, solids, voids, faces, edges, vertices: as `OpenCASCADE`'s own writer had them.
type Counts = [usize; 6];

fn counts(entities: &Entities) -> Counts {
    let solids = entities.count("MANIFOLD_SOLID_BREP") + entities.count("BREP_WITH_VOIDS");
    [
        entities.count("PRODUCT"),
        solids,
        entities.count("ORIENTED_CLOSED_SHELL"),
        entities.count("ADVANCED_FACE"),
        entities.count("EDGE_CURVE"),
        entities.count("VERTEX_POINT"),
    ]
}

fn assembly(built: &Built) -> Written {
    let (model, realisation) = (&built.model, &built.realisation);
    let protocol = Protocol::Ap214;
    Written::save(|path| write_assembly(path, model, realisation, &built.assembly, protocol))
}

/// Every piece is a valid part with the model's name, colour, layer and volume.
fn assert_read(built: &Built, written: &Written) {
    let mut read: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for part in written.read() {
        let volume = part.name.split('#').next().unwrap().to_owned();
        read.entry(volume).or_default().push(part);
    }
    let mut solids = 0;
    for (volume, rules) in built.realisation.volumes.iter().enumerate() {
        let pieces = built.assembly.measured.pieces_of(volume);
        let parts = read.remove(&rules.name).unwrap_or_default();
        assert_eq!(parts.len(), pieces.len(), "{}", rules.name);
        let facies = built.model.facies.iter().find(|f| f.name == rules.facies);
        for (part, piece) in parts.iter().zip(pieces) {
            let color = facies.map(|f| [f.color.r, f.color.g, f.color.b]);
            assert_eq!(part.color, color, "{}", part.name);
            assert_eq!(
                part.layer.as_deref(),
                Some(rules.facies.as_str()),
                "{}",
                part.name
            );
            // The reader's integral over a thin rational piece is good to some 1e-8 of it, but ends far away now and then,
            // whatever the accuracy asked for.
            let found = [1e-9, 1e-11].map(|eps| self::volume(&part.shape, eps).unwrap());
            let off = |size: f64| (size - piece.size).abs();
            let [first, second] = found;
            let nearest = if off(second) < off(first) {
                second
            } else {
                first
            };
            near(nearest, piece.size, 3e-8);
            solids += part.shape.count(ShapeKind::Solid).unwrap();
        }
        assert_valid(&parts.iter().map(|p| p.shape.clone()).collect::<Vec<_>>());
    }
    assert!(read.is_empty(), "{read:?}");
    assert_eq!(solids, built.solids());
}

#[test]
fn quickstart_has_the_entities_and_the_volumes_that_it_should() {
    let model = checked(&source("quickstart/quickstart"));
    let built = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
    let written = assembly(&built);
    let entities = Entities::of(&written.text());
    entities.check();
    assert_eq!(counts(&entities), [4, 3, 0, 26, 70, 49]);
    // Surfaces are those of the faces, each there once.
    let surfaces = ["PLANE", "B_SPLINE_SURFACE_WITH_KNOTS"].map(|kind| entities.count(kind));
    assert_eq!(
        surfaces.iter().sum::<usize>(),
        built.assembly.measured.faces
    );
    assert!(surfaces[0] > 0 && surfaces[1] > 0);
    assert_eq!(entities.count("COLOUR_RGB"), 2);
    assert_eq!(entities.count("PRESENTATION_LAYER_ASSIGNMENT"), 2);
    assert_read(&built, &written);
}

#[test]
fn nodules_have_voids_poles_and_rational_surfaces() {
    let model = checked(&source("nodules/nodules"));
    let built = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
    let written = assembly(&built);
    let entities = Entities::of(&written.text());
    entities.check();
    assert_eq!(counts(&entities), [22, 15, 4, 146, 278, 182]);
    assert!(entities.count("(BOUNDED_SURFACE") > 0 && entities.count("(BOUNDED_CURVE") > 0);
    // The wedges of an ellipsoid end in points, which are no edges.
    let lune = |face: &usize| {
        let (_, loops) = entities.face(*face);
        loops.iter().any(|edges| entities.below(*edges).len() == 2)
    };
    assert!(entities.named("ADVANCED_FACE").iter().any(lune));
    assert_read(&built, &written);
}

#[test]
fn rules_of_every_kind_and_both_engines_are_read_as_they_were_built() {
    for name in ["removes", "nested", "protected"] {
        for engine in [Engine::Partition, Engine::Occt] {
            let model = checked(&source(&format!("rules/{name}")));
            let built = Built::new(model, &Selection::default(), engine).unwrap();
            let written = assembly(&built);
            let entities = Entities::of(&written.text());
            entities.check();
            let solids = counts(&entities)[1];
            assert_eq!(solids, built.solids(), "{name}");
            assert_read(&built, &written);
        }
    }
}

/// Of three or four faces around an edge, those on splines keep its curves on them.
fn assert_splines_first(entities: &Entities) {
    let is_plane = |surface: &usize| entities.body(*surface).starts_with("PLANE(");
    let mut around: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for face in entities.named("ADVANCED_FACE") {
        let (surface, loops) = entities.face(face);
        for oriented in loops.iter().flat_map(|edges| entities.below(*edges)) {
            let curve = entities.edge(oriented).1;
            around.entry(curve).or_default().insert(surface);
        }
    }
    let mut crowded = 0;
    for (curve, surfaces) in around {
        let named = entities.below(curve)[1..].to_vec();
        let named: Vec<usize> = named.iter().map(|side| entities.below(*side)[0]).collect();
        let splines = |of: &mut dyn Iterator<Item = &usize>| of.filter(|s| !is_plane(s)).count();
        let wanted = splines(&mut surfaces.iter()).min(2);
        assert_eq!(splines(&mut named.iter()), wanted, "#{curve}");
        assert_eq!(named.len(), surfaces.len().min(2));
        crowded += usize::from(surfaces.len() > 2);
    }
    assert!(crowded > 0);
}

#[test]
fn the_shared_flavour_of_a_model_has_every_face_once() {
    let model = checked(&source("quickstart/quickstart"));
    let built = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
    let (model, realisation) = (&built.model, &built.realisation);
    for protocol in [Protocol::Ap214, Protocol::Ap242] {
        let written =
            Written::save(|path| write_shared(path, model, realisation, &built.assembly, protocol));
        let entities = Entities::of(&written.text());
        entities.check();
        assert_eq!(entities.count("SHELL_BASED_SURFACE_MODEL"), built.solids());
        assert_splines_first(&entities);
        let [all] = &written.read()[..] else {
            panic!("not one part")
        };
        let count = |kind| all.shape.count(kind).unwrap();
        assert_eq!(count(ShapeKind::Face), built.assembly.measured.faces);
        assert_eq!(count(ShapeKind::Edge), built.assembly.measured.edges);
        assert_eq!(count(ShapeKind::Solid), built.solids());
        let size: f64 = built.assembly.measured.pieces.iter().map(|p| p.size).sum();
        near(volume(&all.shape, 1e-9).unwrap(), size, 1e-8);
    }
}

#[test]
fn the_surfaces_of_a_model_are_whole_named_and_coloured() {
    let model = checked(&source("quickstart/quickstart"));
    let built = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
    let (model, realisation) = (&built.model, &built.realisation);
    let written = Written::save(|path| write_surfaces(path, model, realisation, Protocol::Ap214));
    let entities = Entities::of(&written.text());
    entities.check();
    let read = written.read();
    let told: Vec<_> = read
        .iter()
        .map(|p| (p.name.as_str(), p.layer.as_deref()))
        .collect();
    assert_eq!(
        told,
        [
            ("old-channel/base", Some("base")),
            ("old-channel/top", Some("top")),
            ("young-channel/base", Some("base")),
            ("young-channel/top", Some("top")),
        ]
    );
    for part in &read {
        assert!(part.color.is_some());
        assert_eq!(part.shape.count(ShapeKind::Face).unwrap(), 1);
        // A base is longer across than the flat top over it.
        assert!(area(&part.shape, 1e-9).unwrap() > 1000.0);
    }
    for channel in [[0, 1], [2, 3]] {
        let [base, top] = channel.map(|at: usize| area(&read[at].shape, 1e-9).unwrap());
        assert!(base > top && base < 1.2 * top, "{base} {top}");
    }
}

#[test]
fn the_skin_of_a_warped_ellipsoid_is_eight_triangles_between_its_poles_and_its_equator() {
    let model = checked(&source("fig09-warp/fig09-warp"));
    let concretions = Selection {
        without: vec!["scour".to_owned()],
        ..Selection::default()
    };
    let realisation = Realisation::new(&model, &concretions).unwrap();
    let written = Written::save(|path| write_surfaces(path, &model, &realisation, Protocol::Ap214));
    let entities = Entities::of(&written.text());
    // Loops close, end to end.
    entities.check();
    let mut read: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for part in written.read() {
        if let Some(of) = part.name.strip_suffix("/skin") {
            read.entry(of.to_owned()).or_default().push(part.shape);
        }
    }
    assert_eq!(read.len(), 9);
    for instance in &realisation.instances {
        let Some(shapes) = read.get(&realisation.volumes[instance.volume].name) else {
            continue;
        };
        assert_eq!(shapes.len(), 8);
        // Small triangles between points of the sheets, less than the surface by some 1e-5 of it.
        let triangles: f64 = instance
            .body
            .sheets()
            .unwrap()
            .iter()
            .map(|(_, sheet)| area_of_triangles(sheet, 128))
            .sum();
        let area: f64 = shapes.iter().map(|shape| area(shape, 1e-9).unwrap()).sum();
        near(area, triangles, 1e-4);
    }
    // Of its octahedron each face has three edges with a length.
    let edges = |face: usize| entities.below(entities.face(face).1[0]).len();
    let faces = entities.named("ADVANCED_FACE");
    let three = faces.into_iter().filter(|face| edges(*face) == 3);
    assert_eq!(three.count(), 9 * 8);
}

/// The area of the triangles between n × n places of a surface.
fn area_of_triangles(surface: &Surface, n: usize) -> f64 {
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    let at = |i: usize, j: usize| {
        let part = |k: usize| k as f64 / n as f64;
        surface.point(u0 + (u1 - u0) * part(i), v0 + (v1 - v0) * part(j))
    };
    let mut sum = 0.0;
    for i in 0..n {
        for j in 0..n {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            sum += 0.5 * ((b - a).cross(c - a).length() + (c - a).cross(d - a).length());
        }
    }
    sum
}
