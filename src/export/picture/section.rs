//! Figures of a vertical section, a fence or a map: who owns each point, with axes, legend and scale.
//!
//! One drawing gives the SVG and the PNG. The cells of a [`LabelRaster`] become areas with smooth shared outlines, each
//! filled with the colour of its facies; a thin darker line follows every change of owner, so that two bodies of the
//! same facies stay distinct. Sections run from left to right along their line and have a vertical exaggeration that the
//! figure keeps exactly; maps have north up and equal scales.

use glam::DVec2;

pub use super::figure::{Extent, Kind, LabelRaster, MOST_CELLS, SectionFigure, Trace};
use super::{
    PictureError, Rgb, SMALLEST_SIDE,
    canvas::{Canvas, Ends, INK, escaped, path, pen},
    check::size,
    drawing::rasterised,
    font,
    legend::Legend,
    outline::Outlines,
    plot::{Plot, axes, bends, course, draw_trace, end_labels, heading, north_arrow},
    scale_bar::ScaleBar,
    ticks::round_down,
};

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

    /// The coloured areas alone, as a PNG file `width` pixels wide and at most as high: to be shown among many others.
    pub fn tile(&self, width: u32) -> Result<Vec<u8>, PictureError> {
        self.check()?;
        size(width, SMALLEST_SIDE)?;
        let [across, up] = self.extent.spans();
        let stretch = match &self.kind {
            Kind::Section {
                vertical_exaggeration,
                ..
            } => *vertical_exaggeration,
            Kind::Map { .. } => 1.0,
        };
        let most = f64::from(width);
        let wanted = DVec2::new(across, up * stretch);
        let scale = most / wanted.max_element();
        let plot = Plot {
            low: DVec2::ZERO,
            size: (wanted * scale).round().max(DVec2::splat(LEAST_SIDE)),
            extent: self.extent,
        };
        let mut canvas = Canvas::default();
        self.fill(&mut canvas, &plot);
        let svg = canvas.finish(plot.size.x, plot.size.y, "");
        rasterised(&svg, plot.size.as_uvec2().to_array(), 1.0)
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
        for well in &self.wells {
            draw_trace(&mut canvas, &plot, well);
        }
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
        for trace in traces.iter().chain(&self.wells) {
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

#[cfg(test)]
#[path = "section_tests.rs"]
mod tests;
