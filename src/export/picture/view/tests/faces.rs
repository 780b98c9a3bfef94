//! Faces of the domain show their owners.

use super::*;

#[test]
fn the_south_side_shows_the_owners_as_a_section_does() {
    // Sand in the west, coal on top in the east.
    let owner = |p: DVec3| {
        Some(if p.x < 40.0 {
            1
        } else {
            2 * u32::from(p.z > 70.0)
        })
    };
    let picture = Picture::of(&scene(camera(180.0, 0.0), vec![]), Some(&owner));
    assert_eq!(picture.at(0.2, 0.5), Some(1), "west is left");
    assert_eq!(picture.at(0.8, 0.5), Some(0));
    assert_eq!(picture.at(0.8, 0.1), Some(2), "up is up");
    assert_eq!(picture.at(0.37, 0.9), Some(1));
    assert_eq!(picture.at(0.43, 0.9), Some(0));
    let from_north = Picture::of(&scene(camera(0.0, 0.0), vec![]), Some(&owner));
    assert_eq!(from_north.at(0.8, 0.5), Some(1), "west is right");
}

#[test]
fn faces_ask_for_owners_inside_the_domain_whatever_the_view() {
    // Two beds, and nobody outside: a face that asks there has holes along their boundary, and thick lines around them.
    let domain = Box3 {
        low: DVec3::ZERO,
        high: DVec3::splat(100.0),
    };
    let bed = |p: DVec3| u32::from(p.z > 50.0 + 0.1 * p.x);
    let nobody_outside = |p: DVec3| {
        let inside = p.cmpge(domain.low).all() && p.cmple(domain.high).all();
        inside.then(|| bed(p))
    };
    let everywhere = |p: DVec3| Some(bed(p));
    let perspective = Projection::Perspective { distance: 3.0 };
    for (azimuth, elevation, projection) in [
        (200.0, 28.0, Projection::Orthographic),
        (110.0, 5.0, Projection::Orthographic),
        (20.0, -30.0, Projection::Orthographic),
        (200.0, 28.0, perspective),
    ] {
        let mut seen = camera(azimuth, elevation);
        seen.projection = projection;
        let scene = scene(seen, vec![]);
        let picture = |owner: Owner<'_>| scene.png(240, 180, Some(owner)).unwrap();
        assert!(
            picture(&nobody_outside) == picture(&everywhere),
            "from {azimuth}°, {elevation}° up"
        );
    }
}

#[test]
fn maps_have_north_up_and_views_from_below_are_mirrored() {
    let owner = |p: DVec3| Some(u32::from(p.x > 50.0 && p.y > 50.0));
    let above = Picture::of(&scene(camera(180.0, 90.0), vec![]), Some(&owner));
    let quarters = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)];
    let seen = |picture: &Picture| quarters.map(|(x, y)| picture.at(x, y).unwrap());
    assert_eq!(seen(&above), [0, 1, 0, 0], "north-east is upper right");
    let below = Picture::of(&scene(camera(180.0, -90.0), vec![]), Some(&owner));
    assert_eq!(seen(&below), [0, 0, 0, 1]);
}

#[test]
fn open_faces_let_bodies_be_seen() {
    let owner = |p: DVec3| (p.x > 50.0).then_some(0);
    let body = solid_box(1, [10.0, 10.0, 10.0], [90.0, 90.0, 90.0]);
    let picture = Picture::of(&scene(camera(180.0, 0.0), vec![body]), Some(&owner));
    assert_eq!(picture.at(0.2, 0.5), Some(1));
    assert_eq!(picture.at(0.9, 0.5), Some(0));
}
