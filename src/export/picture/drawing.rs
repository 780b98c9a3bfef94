//! Drawings of others as pixels.

use resvg::tiny_skia::{Color, Pixmap};

use super::{PictureError, font};

/// The PNG of an SVG of this size (px), on white, with `fineness` pixels to each of its own.
///
/// # Errors
/// If the SVG cannot be read, or the image would be too large or empty.
pub fn rasterised(svg: &str, size: [u32; 2], fineness: f64) -> Result<Vec<u8>, PictureError> {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the float to integer cast saturates, and what is too large is refused"
    )]
    let [width, height] = size.map(|pixels| (f64::from(pixels) * fineness).round() as u32);
    let mut pixels = Pixmap::new(width, height)
        .ok_or_else(|| PictureError::Render(format!("no image of {width} × {height}")))?;
    pixels.fill(Color::WHITE);
    font::draw(svg, fineness, &mut pixels)?;
    font::png(&pixels)
}
