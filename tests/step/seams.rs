//! Closed surfaces: seams, poles, and faces that are all of their surface.

use std::f64::consts::PI;

use occt_bridge::{ShapeKind, Solids, faces, solid, volume};

use super::bodies::tables::{ball_in_box, drilled_block};
use super::bodies::{cylinder_topology, ellipsoid_topology};
use super::entities::Entities;
use super::{Written, assert_valid, document, near, part, parts, shapes_of};

#[test]
fn a_cylinder_has_a_seam_with_two_curves_on_its_surface() {
    let shape = solid(&cylinder_topology([0.0, 5.0], [1.0, 2.0], 3.0)).unwrap();
    let written = Written::assembly(&parts(1), &[shape]);
    let entities = Entities::of(&written.text());
    entities.check();
    let [seam] = entities.named("SEAM_CURVE")[..] else {
        panic!("not one seam")
    };
    let sides = entities.below(seam);
    assert_eq!(entities.below(sides[1])[0], entities.below(sides[2])[0]);
    assert_ne!(sides[1], sides[2]);
    assert_eq!(entities.count("SURFACE_CURVE"), 2);
    assert_eq!(entities.count("VERTEX_LOOP"), 0);
    assert!(
        written
            .text()
            .contains("RATIONAL_B_SPLINE_CURVE((1.,0.7071067811865476,1.,0.7071067811865476,1.,")
    );
    let read = written.read().remove(0).shape;
    assert_valid(std::slice::from_ref(&read));
    assert_eq!(read.count(ShapeKind::Edge).unwrap(), 3);
    near(volume(&read, 1e-10).unwrap(), 45.0 * PI, 1e-9);
}

#[test]
fn an_ellipsoid_in_one_face_is_a_vertex_on_a_whole_surface() {
    let shape = solid(&ellipsoid_topology([1.0, 2.0, 3.0], [4.0, 2.0, 1.0])).unwrap();
    let written = Written::assembly(&parts(1), &[shape]);
    let entities = Entities::of(&written.text());
    entities.check();
    assert_eq!(entities.count("VERTEX_LOOP"), 1);
    assert_eq!(entities.count("EDGE_CURVE"), 0);
    let read = written.read().remove(0).shape;
    assert_valid(std::slice::from_ref(&read));
    near(volume(&read, 1e-10).unwrap(), 8.0 * 4.0 / 3.0 * PI, 1e-9);
}

#[test]
fn a_ball_fills_a_void_of_its_size() {
    let solids = Solids::from_tables(&ball_in_box([4.0, 5.0, 6.0], 2.0)).unwrap();
    let written = Written::assembly(&parts(2), &shapes_of(&solids));
    let entities = Entities::of(&written.text());
    entities.check();
    assert_eq!(entities.count("BREP_WITH_VOIDS"), 1);
    let read: Vec<_> = written.read().into_iter().map(|p| p.shape).collect();
    assert_valid(&read);
    let ball = 4.0 / 3.0 * PI * 8.0;
    near(volume(&read[0], 1e-10).unwrap(), 1000.0 - ball, 1e-9);
    near(volume(&read[1], 1e-10).unwrap(), ball, 1e-9);
}

#[test]
fn a_drilled_block_and_its_core_keep_hole_seam_and_volume_in_both_flavours() {
    // The patch's height over the drill is that above its centre: 1 + xy/2 is harmonic.
    let core = PI * 0.25 * 0.25 * (1.0 + 0.5 * 0.4 / 2.0);
    let exact = [1.0 + 1.0 / 8.0 - core, core];
    let solids = Solids::from_tables(&drilled_block([0.5, 0.4], 0.25)).unwrap();
    let shapes = shapes_of(&solids);
    let written = Written::assembly(&parts(2), &shapes);
    let entities = Entities::of(&written.text());
    entities.check();
    // Each product has the seam of the drill's wall.
    assert_eq!(entities.count("SEAM_CURVE"), 2);
    let read: Vec<_> = written.read().into_iter().map(|p| p.shape).collect();
    assert_valid(&read);
    for ((read, of), exact) in read.iter().zip(&shapes).zip(exact) {
        near(volume(read, 1e-10).unwrap(), exact, 1e-9);
        for kind in [ShapeKind::Face, ShapeKind::Edge, ShapeKind::Vertex] {
            assert_eq!(read.count(kind).unwrap(), of.count(kind).unwrap());
        }
    }
    let written = Written::shared(&document(Vec::new()), &["block", "core"], &shapes);
    let entities = Entities::of(&written.text());
    entities.check();
    assert_eq!(entities.count("SEAM_CURVE"), 1);
    let [all] = &written.read()[..] else {
        panic!("not one part")
    };
    assert_eq!(all.shape.count(ShapeKind::Solid).unwrap(), 2);
    assert_eq!(
        all.shape.count(ShapeKind::Face).unwrap(),
        solids.faces().len()
    );
    // The reader makes some curves on surfaces anew, to its own tolerance.
    near(volume(&all.shape, 1e-10).unwrap(), 1.125, 2e-6);
}

#[test]
fn faces_without_a_solid_are_an_open_shell_whose_faces_are_coloured() {
    let shape = faces(&cylinder_topology([0.0, 5.0], [1.0, 2.0], 3.0)).unwrap();
    let nodes = vec![part("skin", [1, 2, 3], vec![0])];
    let written = Written::assembly(&document(nodes), &[shape]);
    let entities = Entities::of(&written.text());
    entities.check();
    assert_eq!(entities.count("OPEN_SHELL"), 1);
    assert_eq!(entities.count("STYLED_ITEM"), 3);
    assert_eq!(entities.count("MANIFOLD_SURFACE_SHAPE_REPRESENTATION"), 1);
    let read = written.read();
    let [part] = &read[..] else {
        panic!("{read:?}")
    };
    assert_eq!(part.color, Some([1, 2, 3]));
    assert_eq!(part.layer.as_deref(), Some("layer of skin"));
    assert_eq!(part.shape.count(ShapeKind::Face).unwrap(), 3);
}
