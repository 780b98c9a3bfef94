//! A small SVG writer: shapes and text in pixels of the drawing, y down, with coordinates to a hundredth of a pixel.

use std::fmt::Write as _;

use glam::DVec2;

use super::{
    Rgb,
    style::{FAMILY, Style, Weight},
};

/// Text and axes.
pub(super) const INK: Rgb = Rgb(0x24, 0x24, 0x24);
/// Secondary text and grid lines.
pub(super) const GREY: Rgb = Rgb(0x5c, 0x5c, 0x5c);

/// A number as short text to a hundredth; `writing!` to a string cannot fail.
pub(super) fn n(value: f64) -> String {
    let rounded = (value * 100.0).round() / 100.0 + 0.0;
    format!("{rounded}")
}

/// Text of the user's made safe inside SVG.
pub(super) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\t' | '\n' | '\r' => safe.push(' '),
            // XML has no way to write other control characters, nor these two.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}

/// Where a text stands relative to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text; `at` is on its baseline.
#[derive(Debug, Clone)]
pub(super) struct Text<'a> {
    pub(super) at: DVec2,
    pub(super) words: &'a str,
    pub(super) style: Style,
    pub(super) anchor: Anchor,
    pub(super) color: Rgb,
    /// Clockwise on the page, about `at`.
    pub(super) turned_deg: f64,
    /// A white rim, where the text may stand on something.
    pub(super) rim: f64,
}

impl<'a> Text<'a> {
    pub(super) fn new(x: f64, y: f64, text: &'a str, style: Style) -> Self {
        Self {
            at: DVec2::new(x, y),
            words: text,
            style,
            anchor: Anchor::Start,
            color: INK,
            turned_deg: 0.0,
            rim: 0.0,
        }
    }

    pub(super) fn anchored(mut self, anchor: Anchor) -> Self {
        self.anchor = anchor;
        self
    }

    pub(super) fn colored(mut self, color: Rgb) -> Self {
        self.color = color;
        self
    }

    pub(super) fn turned(mut self, degrees: f64) -> Self {
        self.turned_deg = degrees;
        self
    }

    pub(super) fn rimmed(mut self, width: f64) -> Self {
        self.rim = width;
        self
    }
}

/// How a line looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    pub(super) color: Rgb,
    pub(super) width: f64,
    pub(super) opacity: f64,
    /// Lengths of dash and gap; `None` for a full line.
    pub(super) dash: Option<[f64; 2]>,
}

pub(super) const fn pen(color: Rgb, width: f64) -> Pen {
    Pen {
        color,
        width,
        opacity: 1.0,
        dash: None,
    }
}

impl Pen {
    pub(super) const fn dashed(mut self, dash: f64, gap: f64) -> Self {
        self.dash = Some([dash, gap]);
        self
    }

    pub(super) const fn opaque(mut self, opacity: f64) -> Self {
        self.opacity = opacity;
        self
    }

    fn attributes(self) -> String {
        let mut text = format!(
            r#" stroke="{}" stroke-width="{}""#,
            self.color,
            n(self.width)
        );
        if self.opacity < 1.0 {
            let _ = write!(text, r#" stroke-opacity="{}""#, n(self.opacity));
        }
        if let Some([dash, gap]) = self.dash {
            let _ = write!(text, r#" stroke-dasharray="{} {}""#, n(dash), n(gap));
        }
        text
    }
}

/// The SVG under construction.
#[derive(Debug, Default, Clone)]
pub(super) struct Canvas {
    body: String,
}

impl Canvas {
    pub(super) fn raw(&mut self, text: &str) {
        self.body += text;
        self.body.push('\n');
    }

    pub(super) fn append(&mut self, other: &Self) {
        self.body += &other.body;
    }

    pub(super) fn rect(&mut self, low: DVec2, size: DVec2, fill: Option<Rgb>, edge: Option<Pen>) {
        let fill = fill.map_or_else(|| "none".to_owned(), |color| color.to_string());
        let edge = edge.map_or_else(String::new, Pen::attributes);
        self.raw(&format!(
            r#"<rect x="{}" y="{}" width="{}" height="{}" fill="{fill}"{edge}/>"#,
            n(low.x),
            n(low.y),
            n(size.x),
            n(size.y)
        ));
    }

    pub(super) fn line(&mut self, a: DVec2, b: DVec2, pen: Pen) {
        self.raw(&format!(
            r#"<path d="M{} {}L{} {}" fill="none"{} stroke-linecap="round"/>"#,
            n(a.x),
            n(a.y),
            n(b.x),
            n(b.y),
            pen.attributes()
        ));
    }

    pub(super) fn polyline(&mut self, points: &[DVec2], pen: Pen) {
        self.raw(&format!(
            r#"<path d="{}" fill="none"{} stroke-linejoin="round"/>"#,
            path(points, Ends::Open),
            pen.attributes()
        ));
    }

    pub(super) fn polygon(&mut self, points: &[DVec2], fill: Rgb, edge: Option<Pen>) {
        let edge = edge.map_or_else(String::new, Pen::attributes);
        self.raw(&format!(
            r#"<path d="{}" fill="{fill}"{edge} stroke-linejoin="round"/>"#,
            path(points, Ends::Closed)
        ));
    }

    pub(super) fn text(&mut self, text: &Text<'_>) {
        let anchor = match text.anchor {
            Anchor::Start => "",
            Anchor::Middle => r#" text-anchor="middle""#,
            Anchor::End => r#" text-anchor="end""#,
        };
        let weight = match text.style.weight {
            Weight::Regular => "",
            Weight::Bold => r#" font-weight="bold""#,
        };
        let turned = if text.turned_deg == 0.0 {
            String::new()
        } else {
            format!(
                r#" transform="rotate({} {} {})""#,
                n(text.turned_deg),
                n(text.at.x),
                n(text.at.y)
            )
        };
        let rim = if text.rim > 0.0 {
            format!(
                r##" stroke="#ffffff" stroke-width="{}" stroke-linejoin="round" paint-order="stroke""##,
                n(text.rim)
            )
        } else {
            String::new()
        };
        self.raw(&format!(
            r#"<text x="{}" y="{}" font-size="{}" fill="{}"{anchor}{weight}{rim}{turned}>{}</text>"#,
            n(text.at.x),
            n(text.at.y),
            n(text.style.size),
            text.color,
            escaped(text.words)
        ));
    }

    /// The whole SVG document.
    pub(super) fn finish(&self, width: f64, height: f64, title: &str) -> String {
        let title = if title.is_empty() {
            String::new()
        } else {
            format!("<title>{}</title>\n", escaped(title))
        };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"{FAMILY}\">\n{title}{}</svg>\n",
            self.body,
            w = n(width),
            h = n(height),
        )
    }
}

/// Whether a path comes back to where it began.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ends {
    Open,
    Closed,
}

/// The `d` attribute of a path through points.
pub(super) fn path(points: &[DVec2], ends: Ends) -> String {
    let mut d = String::new();
    for (i, p) in points.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(d, "{}{} {}", if i == 0 { 'M' } else { 'L' }, n(p.x), n(p.y));
    }
    if ends == Ends::Closed {
        d.push('Z');
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_have_no_negative_zero() {
        assert_eq!(n(1.0), "1");
        assert_eq!(n(-0.001), "0");
        assert_eq!(n(2.345_678), "2.35");
        assert_eq!(n(-1.5), "-1.5");
    }

    #[test]
    fn names_cannot_break_out_of_the_svg() {
        assert_eq!(
            escaped("a<b> & \"c\"\u{0}\n"),
            "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd} "
        );
    }
}
