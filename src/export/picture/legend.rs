//! The legend: one swatch and one name per facies, in rows or in a column.

use glam::DVec2;

use super::{
    PictureError, Swatch,
    canvas::{Canvas, GREY, Text, pen},
    font,
    style::{Style, regular},
};

/// Size of a swatch, and the gap to its name, for text of one pixel.
const BOX: DVec2 = DVec2::new(1.71, 1.07);
const GAP: f64 = 0.64;
const LINE: f64 = 1.3;

/// The height of an entry of one line; smaller text also stands closer.
fn row_height(text: f64) -> f64 {
    text * LINE + (text - 5.0)
}

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
        let row = row_height(text);
        let indent = (BOX.x + GAP) * text;
        let mut at = DVec2::ZERO;
        let mut tallest = 0.0_f64;
        let mut entries = Vec::new();
        for &swatch in swatches {
            let lines = font::wrap(&swatch.name, style, width - indent)?;
            let wide = indent + widest(&lines, style)?;
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
        let row = row_height(text);
        let indent = (BOX.x + GAP) * text;
        let mut y = 0.0;
        let mut entries = Vec::new();
        for &swatch in swatches {
            let lines = font::wrap(&swatch.name, style, width - indent)?;
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
            let size = BOX * self.style.size;
            canvas.rect(at, size, Some(swatch.color), Some(pen(GREY, 0.8)));
            for (i, line) in lines.iter().enumerate() {
                let y = at.y + size.y / 2.0 + self.style.size * (0.36 + LINE * i as f64);
                canvas.text(&Text::new(
                    at.x + size.x + GAP * self.style.size,
                    y,
                    line,
                    self.style,
                ));
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use crate::export::picture::Rgb;

    #[test]
    fn entries_stay_within_the_width_and_apart() {
        let swatches: Vec<Swatch> = (1..30)
            .map(|i| Swatch {
                name: format!("facies {}", "of the plain ".repeat(i % 7)),
                color: Rgb(10, 20, 30),
            })
            .collect();
        let swatches: Vec<&Swatch> = swatches.iter().collect();
        for text in [8.0, 14.0] {
            for legend in [
                Legend::rows(&swatches, 500.0, text).unwrap(),
                Legend::column(&swatches, 230.0, text).unwrap(),
            ] {
                assert_eq!(legend.entries.len(), 29);
                let boxes: Vec<[DVec2; 2]> = legend
                    .entries
                    .iter()
                    .map(|(at, _, lines)| {
                        let wide = (BOX.x + GAP) * text + widest(lines, legend.style).unwrap();
                        let high = (lines.len() as f64) * LINE * text;
                        [*at, *at + DVec2::new(wide, high)]
                    })
                    .collect();
                for (i, [low, high]) in boxes.iter().enumerate() {
                    assert!(high.x <= 500.0 && high.y <= legend.height);
                    for [other_low, other_high] in &boxes[..i] {
                        let meet = low.cmplt(*other_high).all() && other_low.cmplt(*high).all();
                        assert!(!meet, "{low} {high} {other_low} {other_high}");
                    }
                }
            }
        }
    }
}
