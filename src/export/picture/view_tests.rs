//! Tests of views.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
use super::*;
use glam::DVec3;
use resvg::tiny_skia::Pixmap;

const GREY_MUD: Rgb = Rgb(0x50, 0x90, 0x50);
const SAND: Rgb = Rgb(0xe0, 0x40, 0x30);
const COAL: Rgb = Rgb(0x30, 0x40, 0xe0);
const PALETTE: [Rgb; 3] = [GREY_MUD, SAND, COAL];

fn camera(azimuth_deg: f64, elevation_deg: f64) -> Camera {
    Camera {
        azimuth_deg,
        elevation_deg,
        vertical_exaggeration: 1.0,
        projection: Projection::Orthographic,
    }
}

fn scene(camera: Camera, parts: Vec<Part>) -> Scene {
    let names = ["mud", "sand", "coal"];
    Scene {
        title: "Test".to_owned(),
        subtitle: String::new(),
        domain: Box3 {
            low: DVec3::ZERO,
            high: DVec3::splat(100.0),
        },
        parts,
        volumes: (0..3)
            .map(|swatch| Volume {
                name: names[swatch].to_owned(),
                swatch,
            })
            .collect(),
        legend: names
            .iter()
            .zip(PALETTE)
            .map(|(name, color)| Swatch {
                name: (*name).to_owned(),
                color,
            })
            .collect(),
        camera,
        cut: None,
    }
}

fn solid_box(volume: usize, low: [f64; 3], high: [f64; 3]) -> Part {
    let bounds = Box3 {
        low: DVec3::from(low),
        high: DVec3::from(high),
    };
    Part {
        volume,
        positions: bounds.corners().to_vec(),
        normals: None,
        triangles: vec![
            [0, 4, 2],
            [2, 4, 6],
            [1, 3, 5],
            [3, 7, 5],
            [0, 1, 4],
            [1, 5, 4],
            [2, 6, 3],
            [3, 6, 7],
            [0, 2, 1],
            [1, 2, 3],
            [4, 5, 6],
            [5, 7, 6],
        ],
        opacity: 1.0,
    }
}

/// The picture without its column: which colour of the palette each pixel has, whatever the light.
struct Picture {
    width: usize,
    hues: Vec<Option<usize>>,
    low: [usize; 2],
    high: [usize; 2],
}

impl Picture {
    fn of(scene: &Scene, owner: Option<Owner<'_>>) -> Self {
        let pixels = Pixmap::decode_png(&scene.png(650, 350, owner).unwrap()).unwrap();
        let width = 520;
        let hues: Vec<Option<usize>> = (0..350)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| {
                let pixel = pixels.pixel(x, y).unwrap();
                let seen = [pixel.red(), pixel.green(), pixel.blue()].map(f64::from);
                let colorful = seen.iter().copied().fold(0.0, f64::max)
                    - seen.iter().copied().fold(255.0, f64::min);
                PALETTE.iter().position(|c| {
                    let own = [c.0, c.1, c.2].map(f64::from);
                    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
                    colorful > 25.0
                        && dot(seen, own) / (dot(seen, seen) * dot(own, own)).sqrt() > 0.98
                })
            })
            .collect();
        let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
        for (i, hue) in hues.iter().enumerate() {
            if hue.is_some() {
                for (axis, at) in [i % width as usize, i / width as usize]
                    .into_iter()
                    .enumerate()
                {
                    low[axis] = low[axis].min(at);
                    high[axis] = high[axis].max(at);
                }
            }
        }
        Self {
            width: width as usize,
            hues,
            low,
            high,
        }
    }

    /// At fractions of what is coloured, from the left and from the top.
    fn at(&self, x: f64, y: f64) -> Option<usize> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "inside"
        )]
        let [column, row] = [(0, x), (1, y)].map(|(axis, f): (usize, f64)| {
            self.low[axis] + (f * (self.high[axis] - self.low[axis]) as f64).round() as usize
        });
        self.hues[row * self.width + column]
    }

    fn count(&self, hue: usize) -> f64 {
        self.hues.iter().filter(|seen| **seen == Some(hue)).count() as f64
    }
}

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
fn open_faces_let_bodies_be_seen() {
    let owner = |p: DVec3| (p.x > 50.0).then_some(0);
    let body = solid_box(1, [10.0, 10.0, 10.0], [90.0, 90.0, 90.0]);
    let picture = Picture::of(&scene(camera(180.0, 0.0), vec![body]), Some(&owner));
    assert_eq!(picture.at(0.2, 0.5), Some(1));
    assert_eq!(picture.at(0.9, 0.5), Some(0));
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

#[test]
fn winding_and_thread_count_do_not_change_a_byte() {
    let owner = |p: DVec3| (p.x + p.y > 90.0).then_some(u32::from(p.z < 50.0));
    let mut block = scene(
        Camera::from_above(2.0),
        vec![solid_box(1, [5.0, 10.0, 20.0], [70.0, 60.0, 70.0])],
    );
    block.parts[0].opacity = 0.7;
    block
        .parts
        .push(solid_box(2, [30.0, 5.0, 40.0], [95.0, 40.0, 80.0]));
    block.cut = Some(Cut::Plane {
        point: DVec3::new(40.0, 40.0, 50.0),
        removes: DVec3::new(-1.0, -1.0, 0.3),
    });
    let drawn = |threads: usize, block: &Scene| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| block.png(400, 300, Some(&owner)).unwrap())
    };
    let one = drawn(1, &block);
    assert!(one == drawn(2, &block));
    assert!(one == drawn(5, &block));
    for part in &mut block.parts {
        for triangle in &mut part.triangles {
            triangle.swap(1, 2);
        }
    }
    let pixels = |png: &[u8]| Pixmap::decode_png(png).unwrap().take();
    let (a, b) = (pixels(&one), pixels(&drawn(2, &block)));
    let differing = a
        .iter()
        .zip(&b)
        .filter(|(a, b)| a.abs_diff(**b) > 1)
        .count();
    // Only where a sample lies on the very rim of a triangle may rounding decide.
    assert!(differing * 1000 < a.len(), "{differing} of {}", a.len());
}

#[test]
fn the_legend_has_what_is_drawn_once_and_in_order() {
    let mut view = scene(
        camera(180.0, 30.0),
        vec![
            solid_box(2, [0.0; 3], [10.0; 3]),
            solid_box(2, [20.0; 3], [30.0; 3]),
            solid_box(1, [40.0; 3], [50.0; 3]),
        ],
    );
    view.parts[2].opacity = 0.0;
    let names = |labels: &[u32]| -> Vec<String> {
        let swatches = view.swatches(&labels.iter().copied().collect());
        swatches.iter().map(|swatch| swatch.name.clone()).collect()
    };
    assert_eq!(names(&[]), ["coal"], "what is hidden is not in the legend");
    assert_eq!(names(&[0, 2]), ["mud", "coal"]);
}

#[test]
fn a_png_has_the_size_that_was_asked_for() {
    let view = scene(Camera::from_above(1.0), vec![]);
    for (width, height) in [(64, 64), (301, 977), (1201, 90)] {
        let pixels = Pixmap::decode_png(&view.png(width, height, None).unwrap()).unwrap();
        assert_eq!((pixels.width(), pixels.height()), (width, height));
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_with_its_place() {
    type Break = fn(&mut Scene);
    let broken: [(Break, &str); 14] = [
        (|s| s.domain.high.z = 0.0, "range of elevations"),
        (|s| s.domain.low.x = f64::NAN, "range of eastings is NaN"),
        (|s| s.camera.azimuth_deg = f64::INFINITY, "azimuth is inf"),
        (|s| s.camera.elevation_deg = 91.0, "from -90 to 90"),
        (
            |s| s.camera.vertical_exaggeration = 0.0,
            "vertical exaggeration is 0",
        ),
        (
            |s| s.camera.projection = Projection::Perspective { distance: 0.2 },
            "distance in diagonals is 0.2",
        ),
        (
            |s| s.parts[0].positions[3].y = f64::NAN,
            "coordinate 1 of point 3 of sand",
        ),
        (
            |s| s.parts[0].positions[3].z = 1e9,
            "coordinate 2 of point 3 of sand",
        ),
        (
            |s| s.parts[0].triangles[5][2] = 8,
            "triangle 5 of sand refers to 8",
        ),
        (|s| s.parts[0].normals = Some(vec![]), "there are only 0"),
        (|s| s.parts[0].volume = 3, "part 0 refers to 3"),
        (|s| s.parts[0].opacity = 1.5, "opacity of sand"),
        (
            |s| {
                s.cut = Some(Cut::Plane {
                    point: DVec3::ZERO,
                    removes: DVec3::ZERO,
                });
            },
            "direction is 0",
        ),
        (
            |s| {
                s.cut = Some(Cut::Corner {
                    low: s.domain.low,
                    high: s.domain.high,
                });
            },
            "leaves nothing",
        ),
    ];
    let whole = |_: DVec3| Some(0);
    for (breaking, words) in broken {
        let mut view = scene(
            Camera::from_above(1.0),
            vec![solid_box(1, [0.0; 3], [9.0; 3])],
        );
        breaking(&mut view);
        let message = view.png(400, 300, Some(&whole)).unwrap_err().to_string();
        assert!(message.contains(words), "{message} / {words}");
    }
    let view = scene(Camera::from_above(1.0), vec![]);
    for (width, height) in [(0, 300), (300, 0), (20_000, 100), (16_384, 16_384)] {
        assert!(view.png(width, height, None).is_err());
    }
    let wrong = |_: DVec3| Some(3);
    let message = view.png(400, 300, Some(&wrong)).unwrap_err().to_string();
    assert!(message.contains("owner of the point"), "{message}");
}
