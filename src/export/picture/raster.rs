//! Triangles to pixels: several samples a pixel, shaded and with outlines.
//!
//! The picture is drawn in bands of rows, each by itself, so that the number of threads cannot matter.
//!
//! Samples ([`super::samples`]) are shaded by Lambert's law, softened to half as in "half Lambert" shading, with a light from the
//! upper left behind the viewer. Lines are drawn where samples around show another body, another owner, a jump of depth or a
//! crease ([`super::shading`]).

use rayon::prelude::*;

use super::{
    PictureError, byte,
    samples::{Drawing, Projected, SAMPLES, Scene, Skin},
};

/// Rows of pixels in a band.
const BAND: usize = 16;
/// Widest line, in samples to each side.
const WIDEST: usize = 6;

/// Premultiplied RGBA, row by row from the top.
pub(super) fn draw(
    drawing: &Drawing<'_>,
    width: usize,
    height: usize,
) -> Result<Vec<u8>, PictureError> {
    let eye = drawing.eye.finer(SAMPLES as f64);
    let mut triangles = Vec::new();
    for (i, object) in (0..).zip(&drawing.objects) {
        // A face wins over a body's skin that lies in its plane.
        let bias = match object.skin {
            Skin::Owned(_) => 1e-6 * eye.diagonal,
            Skin::Plain { .. } => 0.0,
        };
        let projected = object.triangles.iter();
        triangles.extend(projected.filter_map(|corners| Projected::new(i, corners, &eye, bias)));
    }
    let reach = line_reach(drawing.line);
    let bands = height.div_ceil(BAND);
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); bands];
    for (i, triangle) in (0..).zip(&triangles) {
        let margin = reach as f64 + 1.0;
        let [low, high] = triangle.rows();
        let (first, last) = (band_of(low - margin), band_of(high + margin));
        for band in members.iter_mut().take(last.saturating_add(1)).skip(first) {
            band.push(i);
        }
    }
    let scene = Scene {
        drawing,
        eye: &eye,
        triangles: &triangles,
        // The higher the viewer, the higher the light; from below it comes along with the viewer.
        light: (-0.45 * eye.right + (0.28 - 0.36 * eye.forward.z) * eye.up - 0.72 * eye.forward)
            .normalize(),
        width,
        reach,
    };
    let rows: Vec<Result<Vec<u8>, PictureError>> = (0..bands)
        .into_par_iter()
        .map(|band| scene.band(band * BAND, BAND.min(height - band * BAND), &members[band]))
        .collect();
    let rows: Result<Vec<Vec<u8>>, PictureError> = rows.into_iter().collect();
    Ok(rows?.concat())
}

/// The band of a row of samples.
fn band_of(row: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturating, and not below zero"
    )]
    let band = (row / (BAND * SAMPLES) as f64).floor().max(0.0) as usize;
    band
}

/// How far outlines look, in samples.
fn line_reach(line: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped"
    )]
    let reach = (line * SAMPLES as f64).round().clamp(1.0, WIDEST as f64) as usize;
    reach
}

impl Scene<'_> {
    fn band(&self, first: usize, rows: usize, members: &[u32]) -> Result<Vec<u8>, PictureError> {
        if members.is_empty() {
            return Ok(vec![0; rows * self.width * 4]);
        }
        let samples = self.samples(first, rows, members)?;
        let lines = self.lines(&samples);
        let mut pixels = Vec::with_capacity(rows * self.width * 4);
        for y in 0..rows {
            for x in 0..self.width {
                let mut sum = [0.0; 4];
                for sy in 0..SAMPLES {
                    for sx in 0..SAMPLES {
                        let column = x * SAMPLES + sx;
                        let row = self.reach + y * SAMPLES + sy;
                        let color = self.color(&samples, &lines, column, row);
                        for (sum, channel) in sum.iter_mut().zip(color) {
                            *sum += channel;
                        }
                    }
                }
                pixels.extend(sum.map(|channel| byte(channel / (SAMPLES * SAMPLES) as f64)));
            }
        }
        Ok(pixels)
    }
}
