//! The frame around a section or map: heading, axes, end labels, bends, traces and north arrow.

use glam::DVec2;

use super::{
    PictureError, Rgb, byte,
    canvas::{Anchor, Canvas, GREY, INK, Text, pen},
    figure::{Extent, Trace},
    font,
    style::{Style, bold, regular},
    ticks::{Ticks, number},
};

/// Where the raster stands on the page.
pub(super) struct Plot {
    pub(super) low: DVec2,
    pub(super) size: DVec2,
    pub(super) extent: Extent,
}

impl Plot {
    /// The page's point for a point of the extent.
    pub(super) fn at(&self, p: DVec2) -> DVec2 {
        let [width, height] = self.extent.spans();
        let from_left = (p.x - self.extent.horizontal[0]) / width;
        let from_top = (self.extent.vertical[1] - p.y) / height;
        self.low + DVec2::new(from_left, from_top) * self.size
    }

    /// Pixels of the page to a metre along the horizontal axis.
    pub(super) fn metre(&self) -> f64 {
        self.size.x / self.extent.spans()[0]
    }
}

/// Title and notes; returns the lowest y they use.
pub(super) fn heading(
    canvas: &mut Canvas,
    title: &str,
    notes: &[String],
    width: f64,
) -> Result<f64, PictureError> {
    let mut y = 16.0;
    for line in font::wrap(title, bold(22.0), width - 48.0)? {
        y += 24.0;
        canvas.text(&Text::new(24.0, y, &line, bold(22.0)));
    }
    y += 2.0;
    for note in notes {
        for line in font::wrap(note, regular(14.5), width - 48.0)? {
            y += 20.0;
            canvas.text(&Text::new(24.0, y, &line, regular(14.5)).colored(GREY));
        }
    }
    Ok(y + 8.0)
}

/// Bearing of a direction, degrees clockwise from north, 0 to 360.
fn bearing_deg(direction: DVec2) -> f64 {
    direction
        .x
        .atan2(direction.y)
        .to_degrees()
        .rem_euclid(360.0)
}

/// The nearest of the eight winds.
fn wind(direction: DVec2) -> &'static str {
    const WINDS: [&str; 8] = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];
    WINDS[usize::from(byte(bearing_deg(direction) / 45.0)) % 8]
}

/// The line below the title that says how a section runs.
pub(super) fn course(line: &[DVec2], exaggeration: f64) -> String {
    let (first, last) = (line[0], line[line.len() - 1]);
    let place = |p: DVec2| format!("({}, {})", number(p.x, 1.0), number(p.y, 1.0));
    let way = if line.len() == 2 {
        format!(
            "bearing {:03.0}°",
            bearing_deg(last - first).round() % 360.0
        )
    } else {
        format!(
            "fence of {} legs, bends marked by triangles",
            line.len() - 1
        )
    };
    let stretch = if exaggeration == 1.0 {
        "no vertical exaggeration".to_owned()
    } else {
        format!("vertical exaggeration {exaggeration}×")
    };
    format!(
        "{stretch} · from {} to {} m · {way}",
        place(first),
        place(last)
    )
}

pub(super) fn end_labels(
    canvas: &mut Canvas,
    plot: &Plot,
    line: &[DVec2],
    ends: &[String; 2],
) -> Result<(), PictureError> {
    let y = plot.low.y - 9.0;
    let last = line.len() - 1;
    let winds = [wind(line[0] - line[1]), wind(line[last] - line[last - 1])];
    for (i, (end, wind)) in ends.iter().zip(winds).enumerate() {
        let name_width = font::width(end, bold(17.0))?;
        let wind_width = font::width(wind, regular(14.0))?;
        let gap = if end.is_empty() { 0.0 } else { 8.0 };
        let x = if i == 0 {
            plot.low.x
        } else {
            plot.low.x + plot.size.x - name_width - wind_width - gap
        };
        // The name is at the outer end on both sides.
        let [name_x, wind_x] = if i == 0 {
            [x, x + name_width + gap]
        } else {
            [x + wind_width + gap, x]
        };
        canvas.text(&Text::new(name_x, y, end, bold(17.0)));
        canvas.text(&Text::new(wind_x, y, wind, regular(14.0)).colored(GREY));
    }
    Ok(())
}

/// Marks where a fence bends.
pub(super) fn bends(canvas: &mut Canvas, plot: &Plot, line: &[DVec2]) {
    let mut distance = 0.0;
    let [low, high] = plot.extent.horizontal;
    for pair in line.windows(2).take(line.len() - 2) {
        distance += pair[0].distance(pair[1]);
        if distance <= low || distance >= high {
            continue;
        }
        let top = plot.at(DVec2::new(distance, plot.extent.vertical[1]));
        let foot = plot.at(DVec2::new(distance, plot.extent.vertical[0]));
        canvas.line(top, foot, pen(INK, 1.1).dashed(7.0, 5.0).opaque(0.75));
        let wings = [DVec2::ZERO, DVec2::new(-5.0, -9.0), DVec2::new(5.0, -9.0)];
        canvas.polygon(&wings.map(|w| top + w - DVec2::new(0.0, 1.5)), INK, None);
    }
}

/// Both axes; returns the lowest y they use.
pub(super) fn axes(
    canvas: &mut Canvas,
    plot: &Plot,
    titles: [&str; 2],
) -> Result<f64, PictureError> {
    const STYLE: Style = regular(13.0);
    let floor = plot.low.y + plot.size.y;
    canvas.raw(r#"<g id="axes">"#);
    let mut most = (plot.size.x / 70.0).max(1.0);
    let mut ticks = Ticks::new(plot.extent.horizontal, most);
    // Wide numbers want more room: fewer ticks until neighbours stay apart.
    for _ in 0..6 {
        let mut widest = 0.0_f64;
        for &value in &ticks.values {
            widest = widest.max(font::width(&ticks.label(value), STYLE)?);
        }
        let room = plot.size.x * ticks.step / plot.extent.spans()[0];
        if widest + 18.0 <= room || most <= 1.0 {
            break;
        }
        most /= 1.6;
        ticks = Ticks::new(plot.extent.horizontal, most);
    }
    for &value in &ticks.values {
        let x = plot.at(DVec2::new(value, 0.0)).x;
        canvas.line(
            DVec2::new(x, floor),
            DVec2::new(x, floor + 6.0),
            pen(INK, 1.1),
        );
        canvas
            .text(&Text::new(x, floor + 21.0, &ticks.label(value), STYLE).anchored(Anchor::Middle));
    }
    let middle = plot.low + plot.size / 2.0;
    canvas.text(
        &Text::new(middle.x, floor + 43.0, titles[0], regular(14.5)).anchored(Anchor::Middle),
    );
    let ticks = Ticks::new(plot.extent.vertical, (plot.size.y / 34.0).clamp(1.0, 14.0));
    for &value in &ticks.values {
        let y = plot.at(DVec2::new(0.0, value)).y;
        let x = plot.low.x;
        canvas.line(DVec2::new(x - 6.0, y), DVec2::new(x, y), pen(INK, 1.1));
        canvas
            .text(&Text::new(x - 10.0, y + 4.6, &ticks.label(value), STYLE).anchored(Anchor::End));
    }
    let x = plot.low.x - 60.0;
    canvas.text(
        &Text::new(x, middle.y, titles[1], regular(14.5))
            .anchored(Anchor::Middle)
            .turned(-90.0),
    );
    canvas.raw("</g>");
    // A low plot is lower than its axis title is long.
    let title_foot = middle.y + font::width(titles[1], regular(14.5))? / 2.0;
    Ok((floor + 48.0).max(title_foot + 6.0))
}

/// A north arrow of a map: north is up. `at` is the middle of its upper end.
pub(super) fn north_arrow(canvas: &mut Canvas, at: DVec2) {
    canvas.raw(r#"<g id="north-arrow">"#);
    canvas.text(&Text::new(at.x, at.y + 14.0, "N", bold(18.0)).anchored(Anchor::Middle));
    let tip = at + DVec2::new(0.0, 20.0);
    let tail = tip + DVec2::new(0.0, 42.0);
    let wing = |x: f64| tip + DVec2::new(x, 54.0);
    canvas.polygon(&[tip, tail, wing(-14.0)], INK, Some(pen(INK, 1.2)));
    canvas.polygon(
        &[tip, tail, wing(14.0)],
        Rgb(255, 255, 255),
        Some(pen(INK, 1.2)),
    );
    canvas.raw("</g>");
}

pub(super) fn draw_trace(canvas: &mut Canvas, plot: &Plot, trace: &Trace) {
    let line: Vec<DVec2> = trace.line.iter().map(|&p| plot.at(p)).collect();
    canvas.polyline(&line, pen(Rgb(255, 255, 255), 4.5).opaque(0.8));
    canvas.polyline(&line, pen(INK, 1.8));
    let last = line.len() - 1;
    let inside = |p: DVec2| {
        p.clamp(
            plot.low + DVec2::new(18.0, 22.0),
            plot.low + plot.size - DVec2::new(18.0, 10.0),
        )
    };
    for (end, next, name) in [
        (line[0], line[1], &trace.ends[0]),
        (line[last], line[last - 1], &trace.ends[1]),
    ] {
        // Beside the line rather than on it, and inside the frame.
        let along = (next - end).normalize_or_zero();
        let beside = if along.x.abs() > along.y.abs() {
            DVec2::new(0.0, -14.0)
        } else {
            DVec2::new(16.0, 0.0)
        };
        let at = inside(end + along * 14.0 + beside);
        canvas.text(
            &Text::new(at.x, at.y + 6.0, name, bold(17.0))
                .anchored(Anchor::Middle)
                .rimmed(4.0),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn winds_are_where_the_compass_has_them() {
        assert_eq!(wind(DVec2::new(1.0, 1.0)), "NE");
        assert_eq!(wind(DVec2::new(-1.0, 0.01)), "W");
        assert_eq!(wind(DVec2::new(-0.1, 1.0)), "N");
        assert_eq!(wind(DVec2::new(1.0, -1.1)), "SE");
        assert!((bearing_deg(DVec2::new(1.0, 0.0)) - 90.0).abs() < 1e-12);
    }
}
