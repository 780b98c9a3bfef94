//! The page: its size, its legend, its bytes, and what is refused.

use super::*;

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
