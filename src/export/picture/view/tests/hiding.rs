//! What hides what, and what is cut away.

use super::*;

#[test]
fn nearer_bodies_hide_farther_ones() {
    let parts = vec![
        solid_box(1, [20.0, 10.0, 10.0], [80.0, 30.0, 90.0]),
        solid_box(2, [20.0, 60.0, 10.0], [80.0, 80.0, 90.0]),
    ];
    for (azimuth, nearer) in [(180.0, 1), (0.0, 2)] {
        let picture = Picture::of(&scene(camera(azimuth, 0.0), parts.clone()), None);
        assert_eq!(picture.at(0.5, 0.5), Some(nearer));
        assert_eq!(picture.count(3 - nearer), 0.0);
    }
    // From the west the northern one is left and the southern one right.
    let picture = Picture::of(&scene(camera(270.0, 0.0), parts), None);
    assert_eq!(picture.at(0.1, 0.5), Some(2));
    assert_eq!(picture.at(0.9, 0.5), Some(1));
}

#[test]
fn a_plane_cuts_away_exactly_its_side_of_faces_and_bodies() {
    let whole = |p: DVec3| Some(u32::from(p.z > 1000.0));
    let body = solid_box(1, [0.0, 0.0, 0.0], [100.0, 100.0, 100.0]);
    for (removes, left, right) in [(DVec3::X, true, false), (-DVec3::X, false, true)] {
        let mut faces = scene(camera(180.0, 0.0), vec![]);
        let full = Picture::of(&faces, Some(&whole)).count(0);
        let cut = Some(Cut::Plane {
            point: DVec3::new(60.0, 0.0, 0.0),
            removes: removes * 7.0,
        });
        faces.cut = cut;
        let picture = Picture::of(&faces, Some(&whole));
        let kept = if left { 0.6 } else { 0.4 };
        assert!((picture.count(0) / full - kept).abs() < 0.02);
        let mut solid = scene(camera(180.0, 0.0), vec![body.clone()]);
        solid.cut = cut;
        let open = Picture::of(&solid, None);
        assert!((open.count(1) / full - kept).abs() < 0.02);
        // The wire box keeps its place, so columns can be compared.
        let middle = usize::midpoint(picture.low[0], picture.high[0]);
        assert_eq!(left, middle < 220, "{middle}");
        assert_eq!(right, middle > 220);
    }
}

#[test]
fn a_corner_cut_away_leaves_three_quarters_of_the_map_and_shows_what_lies_below() {
    // Sand fills the lower half.
    let owner = |p: DVec3| Some(u32::from(p.z < 50.0));
    let mut block = scene(camera(180.0, 90.0), vec![]);
    let full = Picture::of(&block, Some(&owner)).count(0);
    block.cut = Some(Cut::Corner {
        low: DVec3::new(50.0, 50.0, 30.0),
        high: DVec3::splat(200.0),
    });
    let picture = Picture::of(&block, Some(&owner));
    assert!((picture.count(0) / full - 0.75).abs() < 0.02);
    assert!((picture.count(1) / full - 0.25).abs() < 0.02);
    assert_eq!(picture.at(0.75, 0.25), Some(1), "the north-east");
}

#[test]
fn glass_lets_half_of_what_is_behind_through() {
    let mut front = solid_box(2, [0.0, 0.0, 0.0], [100.0, 10.0, 100.0]);
    let back = solid_box(1, [0.0, 50.0, 0.0], [100.0, 90.0, 100.0]);
    let middle = |parts: Vec<Part>| {
        let png = scene(camera(180.0, 0.0), parts)
            .png(650, 350, None)
            .unwrap();
        let pixels = Pixmap::decode_png(&png).unwrap();
        let pixel = pixels.pixel(225, 150).unwrap();
        [pixel.red(), pixel.green(), pixel.blue()].map(f64::from)
    };
    let (blue, red) = (middle(vec![front.clone()]), middle(vec![back.clone()]));
    front.opacity = 0.5;
    let both = middle(vec![front, back]);
    for i in 0..3 {
        // Front and back of the glass: two layers of one half leave a quarter of what is behind.
        assert!((both[i] - (0.75 * blue[i] + 0.25 * red[i])).abs() < 2.0);
    }
}
