//! The page of a view: its layout and its layers.

use glam::DVec2;
use resvg::tiny_skia::Pixmap;

use super::{PictureError, byte, canvas::Canvas, font};

/// Where arrow, scale and legend stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    /// To the right of a wide picture.
    Column,
    /// Below a square or high one.
    Strip,
}

/// The page that text is laid out on: about 1300 by 800, or 900 by 900, whatever the number of pixels.
pub(super) struct Page {
    pub(super) size: DVec2,
    /// Pixels of the picture to one of the page.
    pub(super) scale: f64,
    pixels: [u32; 2],
    pub(super) layout: Layout,
}

impl Page {
    pub(super) fn new(width: u32, height: u32) -> Self {
        let pixels = DVec2::new(f64::from(width), f64::from(height));
        let (layout, least) = if pixels.x > 1.3 * pixels.y {
            (Layout::Column, DVec2::new(1300.0, 700.0))
        } else {
            (Layout::Strip, DVec2::new(900.0, 700.0))
        };
        let scale = (pixels / least).min_element();
        Self {
            size: pixels / scale,
            scale,
            pixels: [width, height],
            layout,
        }
    }

    /// A page that holds a picture alone: each of its pixels is one of the picture.
    pub(super) fn plain(width: u32, height: u32) -> Self {
        Self {
            size: DVec2::new(f64::from(width), f64::from(height)),
            scale: 1.0,
            pixels: [width, height],
            layout: Layout::Strip,
        }
    }

    /// Width and height of the picture.
    pub(super) fn pixels(&self) -> [u32; 2] {
        self.pixels
    }

    /// White paper, then `under`, the image (premultiplied RGBA) and `over`.
    pub(super) fn compose(
        &self,
        under: &Canvas,
        image: &[u8],
        over: &Canvas,
    ) -> Result<Vec<u8>, PictureError> {
        let [width, height] = self.pixels;
        let mut pixels = Pixmap::new(width, height)
            .ok_or_else(|| PictureError::Render(format!("no image of {width} × {height}")))?;
        pixels.fill(resvg::tiny_skia::Color::WHITE);
        let svg = |canvas: &Canvas| canvas.finish(self.size.x, self.size.y, "");
        font::draw(&svg(under), self.scale, &mut pixels)?;
        for (below, above) in pixels
            .data_mut()
            .chunks_exact_mut(4)
            .zip(image.chunks_exact(4))
        {
            let through = 1.0 - f64::from(above[3]) / 255.0;
            for (below, above) in below.iter_mut().zip(above) {
                *below = byte(f64::from(*above) + through * f64::from(*below));
            }
        }
        font::draw(&svg(over), self.scale, &mut pixels)?;
        font::png(&pixels)
    }
}
