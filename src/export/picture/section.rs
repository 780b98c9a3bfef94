//! Figures of a vertical section, a fence or a map: who owns each point, with axes, legend and scale.
//!
//! One drawing gives the SVG and the PNG. The cells of a [`LabelRaster`] become areas with smooth shared outlines, each
//! filled with the colour of its facies; a thin darker line follows every change of owner, so that two bodies of the
//! same facies stay distinct. Sections run from left to right along their line and have a vertical exaggeration that the
//! figure keeps exactly; maps have north up and equal scales.

use glam::DVec2;

use super::{
    PictureError, Rgb, SMALLEST_SIDE, Swatch, Volume,
    canvas::{Canvas, Ends, INK, escaped, path, pen},
    check::{check_swatches, finite, range, size, within},
    font,
    legend::Legend,
    outline::Outlines,
    plot::{Plot, axes, bends, course, draw_trace, end_labels, heading, north_arrow},
    scale_bar::ScaleBar,
    ticks::round_down,
};

/// Most cells of a raster: 4096 by 4096.
pub const MOST_CELLS: usize = 1 << 24;

/// Who owns each cell, row by row **from the top** (a section's highest elevation, a map's north), each row from the
/// left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LabelRaster {
    /// Cells in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// An index into [`SectionFigure::volumes`], or [`LabelRaster::NONE`].
    pub cells: Vec<u32>,
}

impl LabelRaster {
    /// The cell is nobody's (beyond the model): left white.
    pub const NONE: u32 = u32::MAX;
}

/// The trace of a section, drawn on a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Names of its two ends: A and A′.
    pub ends: [String; 2],
    /// Its points, easting and northing.
    pub line: Vec<DVec2>,
}

/// What the raster shows.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// A vertical section along a straight line (two points) or a fence along several. `horizontal` of the extent is
    /// then the distance along the line, from 0 at its first point.
    Section {
        /// Points of the line, easting and northing.
        line: Vec<DVec2>,
        /// Names of the two ends, such as A and A′; compass letters are added to them.
        ends: [String; 2],
        /// How many times elevations are stretched against distances.
        vertical_exaggeration: f64,
    },
    /// A plan view at one elevation, or of a surface.
    Map {
        /// Sections to be marked on it.
        traces: Vec<Trace>,
    },
}

/// Which part of the world the raster covers, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Left and right edge: distance along the section, or easting.
    pub horizontal: [f64; 2],
    /// Lower and upper edge: elevation, or northing.
    pub vertical: [f64; 2],
}

/// A figure to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionFigure {
    /// The first line, bold.
    pub title: String,
    /// A line below it; empty for none. Exaggeration and course of a section are added by the figure.
    pub subtitle: String,
    /// A section or a map.
    pub kind: Kind,
    /// What the raster covers.
    pub extent: Extent,
    /// The owner of each cell.
    pub raster: LabelRaster,
    /// What the raster's labels mean.
    pub volumes: Vec<Volume>,
    /// Facies and their colours; the legend shows those that occur in the raster, in this order.
    pub legend: Vec<Swatch>,
}

/// A vertical exaggeration (1, 2, 5, 10, …) with which a section of this length and height fills a figure well: about
/// three times as wide as high.
pub fn fitting_exaggeration(length: f64, height: f64) -> f64 {
    let wanted = length / (3.0 * height);
    if wanted.is_finite() && wanted > 1.0 {
        round_down(wanted).min(1000.0)
    } else {
        1.0
    }
}

impl SectionFigure {
    /// The figure as an SVG document: vectors and text, no raster.
    pub fn svg(&self) -> Result<String, PictureError> {
        let drawing = self.drawing()?;
        Ok(drawing
            .canvas
            .finish(drawing.size.x, drawing.size.y, &self.title))
    }

    /// The figure as a PNG file `width` pixels wide; its height follows from the figure.
    pub fn png(&self, width: u32) -> Result<Vec<u8>, PictureError> {
        size(width, SMALLEST_SIDE)?;
        let drawing = self.drawing()?;
        let scale = f64::from(width) / drawing.size.x;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the cast saturates and `size` refuses what is too large"
        )]
        let height = (drawing.size.y * scale).round() as u32;
        size(width, height)?;
        let mut pixels = resvg::tiny_skia::Pixmap::new(width, height)
            .ok_or_else(|| PictureError::Render(format!("no image of {width} × {height}")))?;
        let svg = drawing.canvas.finish(drawing.size.x, drawing.size.y, "");
        font::draw(&svg, scale, &mut pixels)?;
        font::png(&pixels)
    }

    fn check(&self) -> Result<(), PictureError> {
        range("the extent's horizontal range", self.extent.horizontal)?;
        range("the extent's vertical range", self.extent.vertical)?;
        let LabelRaster {
            width,
            height,
            ref cells,
        } = self.raster;
        within("the raster's width in cells", width as f64, 1.0, 65_536.0)?;
        within("the raster's height in cells", height as f64, 1.0, 65_536.0)?;
        within(
            "the raster's number of cells",
            width as f64 * height as f64,
            1.0,
            MOST_CELLS as f64,
        )?;
        if width * height != cells.len() {
            return Err(PictureError::RasterSize {
                width,
                height,
                cells: cells.len(),
            });
        }
        for (i, &label) in cells.iter().enumerate() {
            if label != LabelRaster::NONE && label as usize >= self.volumes.len() {
                return Err(PictureError::NoSuchEntry {
                    what: format!("cell {} of row {} of the raster", i % width, i / width),
                    index: label as usize,
                    count: self.volumes.len(),
                });
            }
        }
        check_swatches(&self.volumes, &self.legend)?;
        match &self.kind {
            Kind::Section {
                line,
                vertical_exaggeration,
                ..
            } => {
                within(
                    "the vertical exaggeration",
                    *vertical_exaggeration,
                    1e-6,
                    1e6,
                )?;
                check_line("the section's line", line)
            }
            Kind::Map { traces } => traces.iter().try_for_each(|trace| {
                check_line(
                    &format!("the trace {}–{}", trace.ends[0], trace.ends[1]),
                    &trace.line,
                )
            }),
        }
    }

    fn drawing(&self) -> Result<Drawing, PictureError> {
        self.check()?;
        match &self.kind {
            Kind::Section {
                line,
                ends,
                vertical_exaggeration,
            } => self.section(line, ends, *vertical_exaggeration),
            Kind::Map { traces } => self.map(traces),
        }
    }

    /// The swatches whose facies occur in the raster.
    fn swatches(&self) -> Vec<&Swatch> {
        let mut owners = vec![false; self.volumes.len()];
        for &label in &self.raster.cells {
            if let Some(owner) = owners.get_mut(label as usize) {
                *owner = true;
            }
        }
        let occurs = |swatch: usize| {
            let mut volumes = self.volumes.iter().zip(&owners);
            volumes.any(|(volume, occurs)| *occurs && volume.swatch == swatch)
        };
        let swatches = self.legend.iter().enumerate();
        swatches
            .filter(|(i, _)| occurs(*i))
            .map(|(_, swatch)| swatch)
            .collect()
    }

    fn section(
        &self,
        line: &[DVec2],
        ends: &[String; 2],
        exaggeration: f64,
    ) -> Result<Drawing, PictureError> {
        let [length, height] = self.extent.spans();
        // The plot is as wide as the figure allows unless that makes it too high.
        let ratio = height * exaggeration / length;
        let wide = PLOT_WIDTH.min(PLOT_HEIGHT / ratio);
        let plot_size = DVec2::new(wide, wide * ratio);
        if plot_size.min_element() < LEAST_SIDE {
            let equal = length / height;
            return Err(PictureError::OutOfRange {
                what: "the vertical exaggeration, for a section of these measures,".to_owned(),
                value: exaggeration,
                low: equal * LEAST_SIDE / PLOT_WIDTH,
                high: equal * PLOT_HEIGHT / LEAST_SIDE,
            });
        }
        let full = FIGURE_WIDTH.min((wide + LEFT + RIGHT).max(760.0));
        let mut canvas = Canvas::default();
        let notes = [self.subtitle.clone(), course(line, exaggeration)];
        let top = heading(&mut canvas, &self.title, &notes, full)?;
        let left = LEFT + (full - LEFT - RIGHT - wide) / 2.0;
        let plot = Plot {
            low: DVec2::new(left, top + 34.0),
            size: plot_size,
            extent: self.extent,
        };
        self.fill(&mut canvas, &plot);
        end_labels(&mut canvas, &plot, line, ends)?;
        bends(&mut canvas, &plot, line);
        let below = axes(
            &mut canvas,
            &plot,
            ["distance along section (m)", "elevation (m)"],
        )?;
        let bar = ScaleBar::new(plot.metre(), full * 0.22);
        let corner = DVec2::new(LEFT, below + 16.0);
        let bar_width = bar.width + 46.0;
        let legend = Legend::rows(
            &self.swatches(),
            full - LEFT - RIGHT - bar_width - 24.0,
            14.0,
        )?;
        legend.draw(&mut canvas, corner);
        bar.draw(
            &mut canvas,
            DVec2::new(full - RIGHT - bar.width - 16.0, corner.y + 4.0),
        );
        Ok(Drawing::framed(
            &canvas,
            DVec2::new(full, corner.y + legend.height.max(36.0) + 10.0),
        ))
    }

    fn map(&self, traces: &[Trace]) -> Result<Drawing, PictureError> {
        const COLUMN: f64 = 230.0;
        let [width, height] = self.extent.spans();
        let most = DVec2::splat(780.0);
        let scale = (most.x / width).min(most.y / height);
        let plot_size = (DVec2::new(width, height) * scale).max(DVec2::splat(2.0));
        let plot_room = plot_size.x.max(300.0);
        let full = LEFT + plot_room + 34.0 + COLUMN + 24.0;
        let mut canvas = Canvas::default();
        let top = heading(
            &mut canvas,
            &self.title,
            std::slice::from_ref(&self.subtitle),
            full,
        )? + 14.0;
        let plot = Plot {
            low: DVec2::new(LEFT, top),
            size: plot_size,
            extent: self.extent,
        };
        self.fill(&mut canvas, &plot);
        for trace in traces {
            draw_trace(&mut canvas, &plot, trace);
        }
        let below = axes(&mut canvas, &plot, ["easting (m)", "northing (m)"])?;
        let column = DVec2::new(LEFT + plot_room + 34.0, top + 6.0);
        north_arrow(&mut canvas, column + DVec2::new(24.0, 0.0));
        let bar = ScaleBar::new(plot.metre(), COLUMN - 50.0);
        bar.draw(&mut canvas, column + DVec2::new(6.0, 110.0));
        let legend = Legend::column(&self.swatches(), COLUMN, 14.0)?;
        let corner = column + DVec2::new(0.0, 168.0);
        legend.draw(&mut canvas, corner);
        let bottom = below.max(corner.y + legend.height) + 14.0;
        Ok(Drawing::framed(&canvas, DVec2::new(full, bottom)))
    }

    /// The coloured areas and the lines between them.
    fn fill(&self, canvas: &mut Canvas, plot: &Plot) {
        let outlines = Outlines::of(&self.raster);
        let cell = plot.size / DVec2::new(self.raster.width as f64, self.raster.height as f64);
        let place = |points: &[DVec2]| -> Vec<DVec2> {
            points.iter().map(|&p| plot.low + p * cell).collect()
        };
        canvas.raw(r#"<g id="volumes" fill-rule="evenodd" stroke-width="0.4">"#);
        for (label, loops) in outlines.areas() {
            let volume = &self.volumes[label as usize];
            let color = self.legend[volume.swatch].color;
            let d: String = loops
                .iter()
                .map(|ring| path(&place(ring), Ends::Closed))
                .collect();
            canvas.raw(&format!(
                r#"<path d="{d}" fill="{color}" stroke="{color}"><title>{}</title></path>"#,
                escaped(&volume.name)
            ));
        }
        canvas.raw("</g>");
        canvas
            .raw(r#"<g id="outlines" fill="none" stroke-linejoin="round" stroke-linecap="round">"#);
        for chain in &outlines.chains {
            let (Some(left), Some(right)) = (chain.left, chain.right) else {
                continue;
            };
            let colors = [left, right].map(|label| self.color(label));
            let (shade, width) = if colors[0] == colors[1] {
                (0.55, 0.8)
            } else {
                (0.68, 1.0)
            };
            let color = darker(colors[0], colors[1]).mixed(INK, shade);
            canvas.raw(&format!(
                r#"<path d="{}" stroke="{color}" stroke-width="{width}"/>"#,
                path(&place(&chain.points), Ends::Open)
            ));
        }
        canvas.raw("</g>");
        canvas.rect(plot.low, plot.size, None, Some(pen(INK, 1.2)));
    }

    fn color(&self, label: u32) -> Rgb {
        let volume = self.volumes.get(label as usize);
        volume.map_or(Rgb(255, 255, 255), |volume| {
            self.legend[volume.swatch].color
        })
    }
}

/// The darker of two colours, so that a line on a boundary is dark against both.
fn darker(a: Rgb, b: Rgb) -> Rgb {
    let light = |c: Rgb| 2 * u32::from(c.0) + 5 * u32::from(c.1) + u32::from(c.2);
    if light(a) <= light(b) { a } else { b }
}

const FIGURE_WIDTH: f64 = 1200.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 40.0;
const PLOT_WIDTH: f64 = FIGURE_WIDTH - LEFT - RIGHT;
const PLOT_HEIGHT: f64 = 700.0;
/// A plot that is lower or narrower shows nothing.
const LEAST_SIDE: f64 = 4.0;

struct Drawing {
    canvas: Canvas,
    size: DVec2,
}

impl Drawing {
    /// The drawing on white paper.
    fn framed(canvas: &Canvas, size: DVec2) -> Self {
        let size = size.ceil();
        let mut paper = Canvas::default();
        paper.rect(DVec2::ZERO, size, Some(Rgb(255, 255, 255)), None);
        paper.append(canvas);
        Self {
            canvas: paper,
            size,
        }
    }
}

impl Extent {
    /// Width and height.
    pub(super) fn spans(&self) -> [f64; 2] {
        [self.horizontal, self.vertical].map(|[low, high]| high - low)
    }
}

fn check_line(what: &str, line: &[DVec2]) -> Result<(), PictureError> {
    for (i, point) in line.iter().enumerate() {
        finite(&format!("easting of point {i} of {what}"), point.x)?;
        finite(&format!("northing of point {i} of {what}"), point.y)?;
    }
    let problem = if line.len() < 2 {
        "has fewer than two points; give at least its two ends"
    } else if line.windows(2).any(|pair| pair[0] == pair[1]) {
        "has two equal points in a row; remove one of them"
    } else {
        return Ok(());
    };
    Err(PictureError::Shape {
        what: what.to_owned(),
        problem,
    })
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "tests; pixels are found by truncation"
    )]
    use super::*;
    use crate::export::picture::font::regular;
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
}
