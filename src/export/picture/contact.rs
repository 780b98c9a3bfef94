//! Contact sheets: many small pictures of one kind on one page, each with a line of words below it.

use glam::DVec2;
use resvg::tiny_skia::{Color, Pixmap, PixmapPaint, Transform};

use super::{
    LARGEST_SIDE, PictureError, Swatch,
    canvas::{Canvas, GREY, Text},
    font,
    legend::Legend,
    plot::heading,
    style::{Style, regular},
};

/// One of the pictures.
#[derive(Clone, Debug)]
pub struct Tile {
    /// A PNG file.
    pub png: Vec<u8>,
    /// The line below it.
    pub caption: String,
}

/// A page of them, row by row in their order.
#[derive(Clone, Debug)]
pub struct ContactSheet {
    /// The first line, bold.
    pub title: String,
    /// A line below it.
    pub subtitle: String,
    /// The pictures.
    pub tiles: Vec<Tile>,
    /// What the colours mean.
    pub legend: Vec<Swatch>,
}

/// Room around the page and between pictures (px).
const MARGIN: f64 = 24.0;
const GAP: f64 = 14.0;
/// Height of the line below a picture.
const LINE: f64 = 22.0;
const CAPTION: Style = regular(13.0);
/// The page is about so many times as wide as high.
const WIDTH_TO_HEIGHT: f64 = 1.4;
/// The least width of a page: that of its heading and legend.
const LEAST_WIDTH: f64 = 600.0;

impl ContactSheet {
    /// The page as a PNG file.
    pub fn png(&self) -> Result<Vec<u8>, PictureError> {
        let pictures = self.pictures()?;
        let cell = pictures.iter().fold(DVec2::ONE, |most, picture| {
            most.max(DVec2::new(
                f64::from(picture.width()),
                f64::from(picture.height()),
            ))
        });
        let step = cell + DVec2::new(GAP, LINE + GAP);
        let columns = columns(pictures.len(), step);
        let rows = pictures.len().div_ceil(columns);
        let width = (2.0 * MARGIN + step.x * columns as f64 - GAP).max(LEAST_WIDTH);
        let mut canvas = Canvas::default();
        let notes = std::slice::from_ref(&self.subtitle);
        let top = heading(&mut canvas, &self.title, notes, width)? + GAP;
        let corner = |at: usize| {
            let place = DVec2::new((at % columns) as f64, (at / columns) as f64);
            DVec2::new(MARGIN, top) + place * step
        };
        for (at, tile) in self.tiles.iter().enumerate() {
            let foot = corner(at) + DVec2::new(0.0, cell.y + LINE * 0.72);
            let lines = font::wrap(&tile.caption, CAPTION, cell.x)?;
            let line = lines.first().map_or("", String::as_str);
            canvas.text(&Text::new(foot.x, foot.y, line, CAPTION).colored(GREY));
        }
        let below = top + step.y * rows as f64;
        let swatches: Vec<&Swatch> = self.legend.iter().collect();
        let legend = Legend::rows(&swatches, width - 2.0 * MARGIN, 14.0)?;
        legend.draw(&mut canvas, DVec2::new(MARGIN, below));
        let height = below + legend.height + MARGIN;
        let mut page = page(width, height)?;
        font::draw(&canvas.finish(width, height, ""), 1.0, &mut page)?;
        for (at, picture) in pictures.iter().enumerate() {
            // Pictures that are lower than the highest one stand on the same line.
            let low = corner(at) + DVec2::new(0.0, cell.y - f64::from(picture.height()));
            let [x, y] = low.round().as_ivec2().to_array();
            page.draw_pixmap(
                x,
                y,
                picture.as_ref(),
                &PixmapPaint::default(),
                Transform::identity(),
                None,
            );
        }
        font::png(&page)
    }

    fn pictures(&self) -> Result<Vec<Pixmap>, PictureError> {
        let read = |tile: &Tile| {
            Pixmap::decode_png(&tile.png).map_err(|error| {
                PictureError::Render(format!("the picture of {}: {error}", tile.caption))
            })
        };
        self.tiles.iter().map(read).collect()
    }
}

/// How many pictures stand in a row.
fn columns(count: usize, step: DVec2) -> usize {
    let wanted = (count as f64 * WIDTH_TO_HEIGHT * step.y / step.x).sqrt();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small number above 0"
    )]
    let columns = wanted.round().max(1.0) as usize;
    columns.min(count.max(1))
}

fn page(width: f64, height: f64) -> Result<Pixmap, PictureError> {
    let side = |length: f64| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the cast saturates, and what is too large is refused"
        )]
        let pixels = length.ceil() as u32;
        (pixels <= LARGEST_SIDE).then_some(pixels)
    };
    let mut page = side(width)
        .zip(side(height))
        .and_then(|(width, height)| Pixmap::new(width, height))
        .ok_or_else(|| {
            PictureError::Render(format!(
                "a contact sheet of {width:.0} × {height:.0} pixels"
            ))
        })?;
    page.fill(Color::WHITE);
    Ok(page)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use crate::export::picture::Rgb;

    fn plain(width: u32, height: u32, color: Color) -> Vec<u8> {
        let mut pixels = Pixmap::new(width, height).unwrap();
        pixels.fill(color);
        pixels.encode_png().unwrap()
    }

    #[test]
    fn every_picture_is_on_the_page_once_and_whole() {
        let colors: Vec<Color> = (0..7)
            .map(|i| Color::from_rgba8(200, 20 + 30 * i, 7, 255))
            .collect();
        let sheet = ContactSheet {
            title: "Belt".to_owned(),
            subtitle: "seven".to_owned(),
            tiles: colors
                .iter()
                .zip(1..)
                .map(|(color, number)| Tile {
                    png: plain(90, 30 + number, *color),
                    caption: format!("{number:04}"),
                })
                .collect(),
            legend: vec![Swatch {
                name: "sand".to_owned(),
                color: Rgb(1, 2, 3),
            }],
        };
        let page = Pixmap::decode_png(&sheet.png().unwrap()).unwrap();
        for (color, number) in colors.iter().zip(1..) {
            let color = color.premultiply().to_color_u8();
            let count = page.pixels().iter().filter(|pixel| **pixel == color);
            assert_eq!(count.count(), 90 * (30 + number));
        }
        let empty = ContactSheet {
            tiles: Vec::new(),
            ..sheet
        };
        Pixmap::decode_png(&empty.png().unwrap()).unwrap();
    }
}
