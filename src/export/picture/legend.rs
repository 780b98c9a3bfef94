//! The legend: one swatch and one name per facies, in rows or in a column.

use glam::DVec2;

use super::{
    PictureError, Swatch,
    canvas::{Canvas, GREY, Text, pen},
    font::{self, Style, regular},
};

const BOX: DVec2 = DVec2::new(24.0, 15.0);
const GAP: f64 = 9.0;
const LINE: f64 = 1.3;

/// The legend as it will be drawn: its entries placed relative to its upper left corner.
#[derive(Debug, Clone)]
pub(super) struct Legend<'a> {
    entries: Vec<(DVec2, &'a Swatch, Vec<String>)>,
    style: Style,
    pub(super) height: f64,
}

impl<'a> Legend<'a> {
    /// Entries side by side in rows of at most `width`.
    pub(super) fn rows(
        swatches: &[&'a Swatch],
        width: f64,
        text: f64,
    ) -> Result<Self, PictureError> {
        let style = regular(text);
        let row = (text * LINE).max(BOX.y) + 9.0;
        let mut at = DVec2::ZERO;
        let mut tallest = 0.0_f64;
        let mut entries = Vec::new();
        for &swatch in swatches {
            let lines = font::wrap(&swatch.name, style, width - BOX.x - GAP)?;
            let wide = BOX.x + GAP + widest(&lines, style)?;
            if at.x > 0.0 && at.x + wide > width {
                at = DVec2::new(0.0, at.y + tallest);
                tallest = 0.0;
            }
            tallest = tallest.max(row + (lines.len().max(1) - 1) as f64 * text * LINE);
            entries.push((at, swatch, lines));
            at.x += wide + 28.0;
        }
        Ok(Self {
            entries,
            style,
            height: at.y + tallest,
        })
    }

    /// Entries below each other in a column of at most `width`.
    pub(super) fn column(
        swatches: &[&'a Swatch],
        width: f64,
        text: f64,
    ) -> Result<Self, PictureError> {
        let style = regular(text);
        // Smaller text also stands closer.
        let row = (text * LINE).max(BOX.y) + (text - 5.0);
        let mut y = 0.0;
        let mut entries = Vec::new();
        for &swatch in swatches {
            let lines = font::wrap(&swatch.name, style, width - BOX.x - GAP)?;
            let tall = row + (lines.len().max(1) - 1) as f64 * text * LINE;
            entries.push((DVec2::new(0.0, y), swatch, lines));
            y += tall;
        }
        Ok(Self {
            entries,
            style,
            height: y,
        })
    }

    pub(super) fn draw(&self, canvas: &mut Canvas, corner: DVec2) {
        canvas.raw(r#"<g id="legend">"#);
        for (at, swatch, lines) in &self.entries {
            let at = corner + *at;
            canvas.rect(at, BOX, Some(swatch.color), Some(pen(GREY, 0.8)));
            for (i, line) in lines.iter().enumerate() {
                let y = at.y + BOX.y / 2.0 + self.style.size * (0.36 + LINE * i as f64);
                canvas.text(&Text::new(at.x + BOX.x + GAP, y, line, self.style));
            }
        }
        canvas.raw("</g>");
    }
}

fn widest(lines: &[String], style: Style) -> Result<f64, PictureError> {
    let mut widest = 0.0_f64;
    for line in lines {
        widest = widest.max(font::width(line, style)?);
    }
    Ok(widest)
}
