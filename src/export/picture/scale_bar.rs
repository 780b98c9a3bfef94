//! A bar of a round length.

use glam::DVec2;

use super::{
    Rgb,
    canvas::{Anchor, Canvas, INK, Text, pen},
    style::regular,
    ticks::round_down,
};

/// A bar with its length in metres and its width in pixels of the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ScaleBar {
    length: f64,
    pub(super) width: f64,
}

impl ScaleBar {
    /// The longest round length of at most `limit` pixels where a metre is `metre` pixels.
    pub(super) fn new(metre: f64, limit: f64) -> Self {
        let length = round_down(limit / metre);
        Self {
            length,
            width: length * metre,
        }
    }

    /// Draws the bar with its upper left corner at a point.
    pub(super) fn draw(&self, canvas: &mut Canvas, at: DVec2) {
        canvas.raw(r#"<g id="scale-bar">"#);
        let half = DVec2::new(self.width / 2.0, 7.0);
        let edge = Some(pen(INK, 1.0));
        canvas.rect(at, half, Some(INK), edge);
        let second = at + DVec2::new(half.x, 0.0);
        canvas.rect(second, half, Some(Rgb(255, 255, 255)), edge);
        for (x, label) in [(0.0, "0"), (self.width, self.label().as_str())] {
            let words = Text::new(at.x + x, at.y + 24.0, label, regular(13.0));
            canvas.text(&words.anchored(Anchor::Middle));
        }
        canvas.raw("</g>");
    }

    fn label(&self) -> String {
        if self.length >= 2000.0 {
            format!("{} km", self.length / 1000.0)
        } else {
            format!("{} m", self.length)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_as_long_as_it_says_and_fits() {
        for (metre, limit, label) in [
            (0.65, 170.0, "200 m"),
            (0.01, 170.0, "10 km"),
            (300.0, 170.0, "0.5 m"),
        ] {
            let bar = ScaleBar::new(metre, limit);
            assert_eq!(bar.label(), label);
            assert!(bar.width <= limit && bar.width > limit / 2.6);
            assert!((bar.width / metre - bar.length).abs() < 1e-9);
        }
    }
}
