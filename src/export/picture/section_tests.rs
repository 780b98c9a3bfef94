//! Tests of figures.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "tests; pixels are found by truncation"
)]
use super::*;
use crate::export::picture::style::regular;
use crate::export::picture::{Swatch, Volume};
use resvg::tiny_skia::Pixmap;

const MUD: Rgb = Rgb(0xa0, 0xb0, 0x80);
const SAND: Rgb = Rgb(0xf0, 0xd0, 0x50);
const COAL: Rgb = Rgb(0x30, 0x30, 0x30);

/// Mud, with a sand body (label 1) on the left and up, and another (label 2) that touches it on the right.
fn figure(kind: Kind) -> SectionFigure {
    let (width, height) = (200, 100);
    let cells = (0..height)
        .flat_map(|row| {
            (0..width).map(move |column| match (row, column) {
                (10..40, 20..80) => 1,
                (10..40, 80..120) => 2,
                (80.., 190..) => LabelRaster::NONE,
                _ => 0,
            })
        })
        .collect();
    let volume = |name: &str, swatch| Volume {
        name: name.to_owned(),
        swatch,
    };
    let swatch = |name: &str, color| Swatch {
        name: name.to_owned(),
        color,
    };
    SectionFigure {
        wells: Vec::new(),
        title: "Test <section>".to_owned(),
        subtitle: "made up".to_owned(),
        kind,
        extent: Extent {
            horizontal: [0.0, 1000.0],
            vertical: [-50.0, 0.0],
        },
        raster: LabelRaster {
            width,
            height,
            cells,
        },
        volumes: vec![
            volume("plain", 0),
            volume("channel/1", 1),
            volume("channel/2", 1),
        ],
        legend: vec![
            swatch("mud & silt", MUD),
            swatch("sand", SAND),
            swatch("coal", COAL),
        ],
    }
}

fn vertical(points: &[[f64; 2]]) -> Kind {
    Kind::Section {
        line: points.iter().map(|&p| DVec2::from(p)).collect(),
        ends: ["A".to_owned(), "A′".to_owned()],
        vertical_exaggeration: 5.0,
    }
}

fn straight() -> Kind {
    vertical(&[[0.0, 0.0], [0.0, 1000.0]])
}

fn attribute(tag: &str, name: &str) -> f64 {
    let from = tag.find(&format!(" {name}=\"")).expect(name) + name.len() + 3;
    let to = from + tag[from..].find('"').unwrap();
    tag[from..to].parse().unwrap()
}

/// Upper left corner and size of the frame around the plot, as a reader of the SVG finds it.
fn frame(svg: &str) -> (DVec2, DVec2) {
    let tag = svg
        .lines()
        .find(|line| line.starts_with("<rect") && line.contains("fill=\"none\""))
        .unwrap();
    (
        DVec2::new(attribute(tag, "x"), attribute(tag, "y")),
        DVec2::new(attribute(tag, "width"), attribute(tag, "height")),
    )
}

/// The colour of the PNG at a point of the extent.
fn color_at(figure: &SectionFigure, p: DVec2) -> Rgb {
    let svg = figure.svg().unwrap();
    let (low, size) = frame(&svg);
    let page = attribute(svg.lines().next().unwrap(), "width");
    let pixels = Pixmap::decode_png(&figure.png(900).unwrap()).unwrap();
    let [width, height] = figure.extent.spans();
    let fraction = DVec2::new(
        (p.x - figure.extent.horizontal[0]) / width,
        1.0 - (p.y - figure.extent.vertical[0]) / height,
    );
    let at = (low + size * fraction) * 900.0 / page;
    let pixel = pixels.pixel(at.x as u32, at.y as u32).unwrap();
    Rgb(pixel.red(), pixel.green(), pixel.blue())
}

#[test]
fn colours_stand_where_the_owners_are() {
    let section = figure(straight());
    // Rows count down from elevation 0 in half metres, columns in 5 m.
    assert_eq!(color_at(&section, DVec2::new(250.0, -12.0)), SAND);
    assert_eq!(color_at(&section, DVec2::new(500.0, -12.0)), SAND);
    assert_eq!(color_at(&section, DVec2::new(250.0, -30.0)), MUD);
    assert_eq!(color_at(&section, DVec2::new(800.0, -12.0)), MUD);
    assert_eq!(
        color_at(&section, DVec2::new(980.0, -46.0)),
        Rgb(255, 255, 255)
    );
    let mut map = figure(Kind::Map { traces: vec![] });
    map.extent.vertical = [0.0, 500.0];
    assert_eq!(
        color_at(&map, DVec2::new(250.0, 400.0)),
        SAND,
        "north is up"
    );
    assert_eq!(color_at(&map, DVec2::new(250.0, 100.0)), MUD);
}

#[test]
fn bodies_of_one_facies_are_parted_by_a_darker_line() {
    let on_the_line = color_at(&figure(straight()), DVec2::new(400.0, -12.0));
    let light = |c: Rgb| u32::from(c.0) + u32::from(c.1) + u32::from(c.2);
    assert!(light(on_the_line) + 80 < light(SAND), "{on_the_line}");
}

#[test]
fn the_vertical_exaggeration_is_the_plots_own() {
    for exaggeration in [1.0, 5.0, 40.0] {
        let mut section = figure(straight());
        if let Kind::Section {
            vertical_exaggeration,
            ..
        } = &mut section.kind
        {
            *vertical_exaggeration = exaggeration;
        }
        let (_, size) = frame(&section.svg().unwrap());
        let measured = (size.y / 50.0) / (size.x / 1000.0);
        assert!(
            (measured / exaggeration - 1.0).abs() < 2e-3,
            "{measured} for {exaggeration}"
        );
    }
}

#[test]
fn the_legend_names_each_facies_that_occurs_once() {
    let svg = figure(straight()).svg().unwrap();
    let from = svg.find("<g id=\"legend\">").unwrap();
    let legend = &svg[from..from + svg[from..].find("</g>").unwrap()];
    assert_eq!(legend.matches(">mud &amp; silt<").count(), 1);
    assert_eq!(legend.matches(">sand<").count(), 1, "two bodies, one entry");
    assert!(!legend.contains("coal"), "there is none in the raster");
    assert_eq!(legend.matches("<rect").count(), 2);
    assert!(svg.contains(">Test &lt;section&gt;<"));
}

#[test]
fn ends_carry_the_winds_they_point_to() {
    let svg = figure(straight()).svg().unwrap();
    let place = |text: &str| {
        let line = svg
            .lines()
            .find(|line| line.ends_with(&format!(">{text}</text>")))
            .unwrap();
        attribute(line, "x")
    };
    assert!(place("S") < 200.0 && place("N") > 1000.0);
    assert!(place("A") < place("S") && place("N") < place("A′"));
    assert!(svg.contains("bearing 000°") && svg.contains("exaggeration 5×"));
}

#[test]
fn a_fence_marks_its_bends_at_their_distances() {
    // Legs of 300, 400 and 300 m.
    let fence = vertical(&[[0.0, 0.0], [300.0, 0.0], [300.0, 400.0], [600.0, 400.0]]);
    let svg = figure(fence).svg().unwrap();
    let (low, size) = frame(&svg);
    let marks: Vec<f64> = svg
        .lines()
        .filter(|line| line.contains("stroke-dasharray"))
        .map(|line| {
            let from = line.find("d=\"M").unwrap() + 4;
            line[from..].split(' ').next().unwrap().parse().unwrap()
        })
        .collect();
    assert_eq!(marks.len(), 2);
    assert!((marks[0] - (low.x + 0.3 * size.x)).abs() < 0.1);
    assert!((marks[1] - (low.x + 0.7 * size.x)).abs() < 0.1);
}

#[test]
fn tick_labels_do_not_overlap_even_far_from_the_origin() {
    let mut map = figure(Kind::Map { traces: vec![] });
    map.extent = Extent {
        horizontal: [6_431_000.0, 6_431_800.0],
        vertical: [5_000_000.0, 5_000_400.0],
    };
    let svg = map.svg().unwrap();
    let axes = &svg[svg.find("<g id=\"axes\">").unwrap()..];
    let mut ticks: Vec<(f64, String)> = axes
        .lines()
        .filter(|line| line.contains(">643"))
        .map(|line| {
            let text = line[line.find('>').unwrap() + 1..].split('<').next();
            (attribute(line, "x"), text.unwrap().to_owned())
        })
        .collect();
    ticks.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(ticks.len() >= 4, "{ticks:?}");
    for pair in ticks.windows(2) {
        let half = |text: &str| font::width(text, regular(13.0)).unwrap() / 2.0;
        assert!(pair[0].0 + half(&pair[0].1) < pair[1].0 - half(&pair[1].1));
    }
}

#[test]
fn traces_on_a_map_run_where_they_say() {
    let trace = Trace {
        ends: ["B".to_owned(), "B′".to_owned()],
        line: vec![DVec2::new(100.0, -40.0), DVec2::new(900.0, -10.0)],
    };
    let map = figure(Kind::Map {
        traces: vec![trace],
    });
    let on_it = color_at(&map, DVec2::new(500.0, -25.0));
    assert!(on_it.0 < 0x60 && on_it.1 < 0x60, "{on_it}");
}

#[test]
fn the_same_figure_is_the_same_bytes() {
    let section = figure(straight());
    assert_eq!(section.png(640).unwrap(), section.clone().png(640).unwrap());
    assert_eq!(section.svg().unwrap(), section.clone().svg().unwrap());
}

#[test]
fn what_cannot_be_drawn_is_refused_with_its_place() {
    type Break = fn(&mut SectionFigure);
    let broken: [(Break, &str); 9] = [
        (
            |f| f.extent.horizontal[1] = f64::NAN,
            "horizontal range is NaN",
        ),
        (|f| f.extent.vertical = [0.0, -50.0], "goes from 0 to -50"),
        (|f| f.raster.cells[205] = 7, "cell 5 of row 1"),
        (|f| f.raster.width = 0, "width in cells is 0"),
        (|f| f.raster.width = 199, "199 × 100"),
        (|f| f.raster.height = usize::MAX, "height in cells"),
        (|f| f.volumes[2].swatch = 3, "volume channel/2"),
        (
            |f| f.kind = vertical(&[[0.0, 0.0]]),
            "fewer than two points",
        ),
        (
            |f| f.kind = vertical(&[[0.0, 0.0], [f64::INFINITY, 0.0]]),
            "easting of point 1",
        ),
    ];
    for (breaking, words) in broken {
        let mut section = figure(straight());
        breaking(&mut section);
        let message = section.svg().unwrap_err().to_string();
        assert!(message.contains(words), "{message} / {words}");
        assert!(section.png(800).is_err());
    }
    for width in [0, 1, 60, 20_000, u32::MAX] {
        assert!(figure(straight()).png(width).is_err());
    }
}

#[test]
fn odd_shapes_give_a_figure_or_say_which_exaggeration_would() {
    for (horizontal, vertical) in [
        ([0.0, 1e6], [0.0, 1.0]),
        ([0.0, 1.0], [-4000.0, 0.0]),
        ([0.0, 1e-3], [0.0, 1e-3]),
    ] {
        let mut map = figure(Kind::Map { traces: vec![] });
        let mut section = figure(straight());
        for odd in [&mut map, &mut section] {
            odd.extent = Extent {
                horizontal,
                vertical,
            };
        }
        Pixmap::decode_png(&map.png(800).unwrap()).unwrap();
        match section.png(800) {
            Ok(png) => assert!(Pixmap::decode_png(&png).is_ok()),
            Err(PictureError::OutOfRange { low, high, .. }) => {
                let inside = (low * high).sqrt();
                if let Kind::Section {
                    vertical_exaggeration,
                    ..
                } = &mut section.kind
                {
                    *vertical_exaggeration = inside;
                }
                Pixmap::decode_png(&section.png(800).unwrap()).unwrap();
            }
            Err(other) => panic!("{other}"),
        }
    }
}

#[test]
fn a_fitting_exaggeration_is_round_and_never_shrinks() {
    assert_eq!(fitting_exaggeration(1000.0, 60.0), 5.0);
    assert_eq!(fitting_exaggeration(10_000.0, 100.0), 20.0);
    assert_eq!(fitting_exaggeration(100.0, 100.0), 1.0);
    assert_eq!(fitting_exaggeration(1.0, 0.0), 1.0);
}
