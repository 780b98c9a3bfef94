//! Text: the embedded font, how wide a text is, and SVG to pixels.

use std::sync::{Arc, LazyLock};

use resvg::{
    tiny_skia::{Pixmap, Transform},
    usvg::{Node, Options, Tree, fontdb},
};

use super::{PictureError, canvas, style::Style};

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    for face in [notosans::REGULAR_TTF, notosans::BOLD_TTF] {
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(face)));
    }
    fonts.set_sans_serif_family("Noto Sans");
    Arc::new(fonts)
});

fn parse(svg: &str) -> Result<Tree, PictureError> {
    let options = Options {
        fontdb: Arc::clone(&FONTS),
        font_family: "Noto Sans".to_owned(),
        ..Options::default()
    };
    Tree::from_str(svg, &options).map_err(|error| PictureError::Render(error.to_string()))
}

/// The width of a text in pixels of the drawing (kerning and ligatures included).
pub(super) fn width(text: &str, style: Style) -> Result<f64, PictureError> {
    // Measured at 100 pixels, since boxes are single precision, and on one line, as it will be drawn.
    let mut drawing = canvas::Canvas::default();
    let measured = Style {
        size: 100.0,
        ..style
    };
    drawing.text(&canvas::Text::new(0.0, 200.0, text, measured));
    let tree = parse(&drawing.finish(100.0, 300.0, ""))?;
    let widest = tree
        .root()
        .children()
        .iter()
        .filter_map(|node| match node {
            Node::Text(text) => Some(f64::from(text.bounding_box().right())),
            _ => None,
        })
        .fold(0.0, f64::max);
    Ok(widest * style.size / 100.0)
}

/// Breaks a text into lines of at most `width` pixels, at spaces where there are any.
pub(super) fn wrap(text: &str, style: Style, limit: f64) -> Result<Vec<String>, PictureError> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let longer = if line.is_empty() {
            word.to_owned()
        } else {
            format!("{line} {word}")
        };
        if width(&longer, style)? <= limit {
            line = longer;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for letter in word.chars() {
            let grown = format!("{line}{letter}");
            if !line.is_empty() && width(&grown, style)? > limit {
                lines.push(std::mem::take(&mut line));
                line.push(letter);
            } else {
                line = grown;
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    Ok(lines)
}

/// Draws an SVG onto pixels, stretched by `scale`.
pub(super) fn draw(svg: &str, scale: f64, pixels: &mut Pixmap) -> Result<(), PictureError> {
    let tree = parse(svg)?;
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the renderer works in single precision"
    )]
    let scale = scale as f32;
    resvg::render(
        &tree,
        Transform::from_scale(scale, scale),
        &mut pixels.as_mut(),
    );
    Ok(())
}

/// The PNG file of an image.
pub(super) fn png(pixels: &Pixmap) -> Result<Vec<u8>, PictureError> {
    pixels
        .encode_png()
        .map_err(|error| PictureError::Render(error.to_string()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]
    use super::super::style::{bold, regular};
    use super::*;

    #[test]
    fn twice_the_text_is_twice_as_wide_and_bold_is_wider() {
        let one = width("sand", regular(14.0)).unwrap();
        let two = width("sandsand", regular(14.0)).unwrap();
        assert!((two - 2.0 * one).abs() < 0.3, "{one} {two}");
        assert!(width("sand", bold(14.0)).unwrap() > one);
        assert!(
            (20.0..45.0).contains(&one),
            "four letters of 14 pixels: {one}"
        );
    }

    #[test]
    fn wrapped_lines_fit_and_keep_every_word() {
        let text = "vertical exaggeration 5 × · from (0, 500) to (1000, 500) m · overbank_and_crevasse_splay_deposits_of_the_floodplain";
        let lines = wrap(text, regular(14.0), 220.0).unwrap();
        assert!(lines.len() > 2);
        for line in &lines {
            assert!(width(line, regular(14.0)).unwrap() <= 220.0, "{line}");
        }
        let letters = |s: &str| s.split_whitespace().collect::<String>();
        assert_eq!(letters(&lines.concat()), letters(text));
    }
}
