//! Triangles to pixels: a depth buffer with several samples a pixel, shading and outlines.
//!
//! Why not a library: rasterisers such as `euc` take positions in single precision and keep colour and depth only, while
//! outlines want to know which body, owner and triangle each sample shows, and transparent bodies several layers. The
//! picture is drawn in bands of rows, each by itself, so that the number of threads cannot matter.
//!
//! Each sample keeps the nearest opaque triangle (ties go to the first), then is shaded by Lambert's law, softened to
//! half as in "half Lambert" shading, with a light from the upper left behind the viewer. Lines are drawn where samples
//! around show another body, another owner, a jump of depth or a crease.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{
    PictureError, Rgb, byte,
    camera::Eye,
    face::{Asked, Face, OPEN},
    solid::Vertex,
};

/// Samples along a pixel's side.
pub(super) const SAMPLES: usize = 3;
/// Rows of pixels in a band.
const BAND: usize = 16;
/// Widest line, in samples to each side.
const WIDEST: usize = 6;
pub(super) const NONE: u32 = u32::MAX;

/// Something with an outline: a part or a face.
pub(super) struct Object<'a> {
    pub(super) triangles: Vec<[Vertex; 3]>,
    pub(super) skin: Skin<'a>,
}

/// How an object looks.
pub(super) enum Skin<'a> {
    /// One colour all over, and how much it hides (1: all).
    Plain { color: Rgb, opacity: f64 },
    /// Coloured by owner.
    Owned(&'a Face),
}

/// All that is to be drawn.
pub(super) struct Drawing<'a> {
    pub(super) objects: Vec<Object<'a>>,
    /// Colours by owner.
    pub(super) colors: Vec<Rgb>,
    pub(super) asked: Option<Asked<'a>>,
    pub(super) eye: &'a Eye,
    /// Half the width of outlines in pixels.
    pub(super) line: f64,
}

/// A triangle on the page, whose unit here is a sample.
pub(super) struct Projected {
    pub(super) object: u32,
    page: [DVec2; 3],
    depth: [f64; 3],
    /// How much nearer than it is it counts as.
    bias: f64,
    normals: [DVec3; 3],
    /// One over twice the signed area.
    per_area: f64,
    /// How the depth grows along the page.
    pub(super) slope: DVec2,
}

impl Projected {
    fn new(object: u32, corners: &[Vertex; 3], eye: &Eye, bias: f64) -> Option<Self> {
        let projected = corners.map(|corner| eye.project_stretched(corner.at));
        let page = projected.map(|(page, _)| page);
        let depth = projected.map(|(_, depth)| depth - bias);
        let (ab, ac) = (page[1] - page[0], page[2] - page[0]);
        let area = ab.perp_dot(ac);
        // Seen edge-on it covers nothing.
        if area.abs() < 1e-9 || !area.is_finite() {
            return None;
        }
        let (db, dc) = (depth[1] - depth[0], depth[2] - depth[0]);
        Some(Self {
            object,
            page,
            depth,
            bias,
            normals: corners.map(|corner| corner.normal),
            per_area: 1.0 / area,
            slope: DVec2::new(db * ac.y - dc * ab.y, dc * ab.x - db * ac.x) / area,
        })
    }

    /// Weights of the corners at a point of the page.
    fn weights(&self, p: DVec2) -> [f64; 3] {
        let [a, b, c] = self.page;
        let wb = (p - a).perp_dot(c - a) * self.per_area;
        let wc = (b - a).perp_dot(p - a) * self.per_area;
        [1.0 - wb - wc, wb, wc]
    }

    pub(super) fn depth_at(&self, p: DVec2) -> f64 {
        self.depth[0] + self.slope.dot(p - self.page[0])
    }

    /// The unit normal turned to the viewer.
    pub(super) fn normal_at(&self, p: DVec2, forward: DVec3) -> DVec3 {
        let [a, b, c] = self.weights(p);
        let normal =
            (self.normals[0] * a + self.normals[1] * b + self.normals[2] * c).normalize_or_zero();
        if normal.dot(forward) > 0.0 {
            -normal
        } else {
            normal
        }
    }

    fn rows(&self) -> [f64; 2] {
        let ys = self.page.map(|p| p.y);
        [
            ys.into_iter().fold(f64::INFINITY, f64::min),
            ys.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ]
    }
}

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

pub(super) struct Scene<'a> {
    pub(super) drawing: &'a Drawing<'a>,
    pub(super) eye: &'a Eye,
    pub(super) triangles: &'a [Projected],
    pub(super) light: DVec3,
    width: usize,
    pub(super) reach: usize,
}

/// The nearest opaque thing at a sample.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    pub(super) depth: f64,
    pub(super) triangle: u32,
    pub(super) label: u32,
}

const NOTHING: Seen = Seen {
    depth: f64::INFINITY,
    triangle: NONE,
    label: OPEN,
};

/// A transparent layer at a sample.
#[derive(Clone, Copy)]
pub(super) struct Layer {
    pub(super) sample: usize,
    pub(super) depth: f64,
    pub(super) triangle: u32,
}

/// Samples of a band with a margin of `reach` rows above and below.
pub(super) struct Samples {
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// The page's sample row of the first row here; may be negative.
    top: f64,
    pub(super) seen: Vec<Seen>,
    pub(super) layers: Vec<Layer>,
    /// The object of each sample's nearest transparent layer.
    pub(super) veil: Vec<u32>,
}

impl Samples {
    pub(super) fn place(&self, column: usize, row: usize) -> DVec2 {
        DVec2::new(column as f64 + 0.5, self.top + row as f64 + 0.5)
    }
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

    fn samples(&self, first: usize, rows: usize, members: &[u32]) -> Result<Samples, PictureError> {
        let (columns, rows) = (self.width * SAMPLES, rows * SAMPLES + 2 * self.reach);
        let mut samples = Samples {
            columns,
            rows,
            top: (first * SAMPLES) as f64 - self.reach as f64,
            seen: vec![NOTHING; columns * rows],
            layers: Vec::new(),
            veil: Vec::new(),
        };
        for &index in members {
            self.fill(index, &mut samples)?;
        }
        let Samples { seen, layers, .. } = &mut samples;
        layers.retain(|layer| layer.depth < seen[layer.sample].depth);
        layers.sort_by(|a, b| {
            let by_depth = a.depth.total_cmp(&b.depth);
            a.sample
                .cmp(&b.sample)
                .then(by_depth)
                .then(a.triangle.cmp(&b.triangle))
        });
        if !layers.is_empty() {
            samples.veil = vec![NONE; samples.seen.len()];
            for layer in samples.layers.iter().rev() {
                samples.veil[layer.sample] = self.triangles[layer.triangle as usize].object;
            }
        }
        Ok(samples)
    }

    /// Enters a triangle's samples.
    fn fill(&self, index: u32, samples: &mut Samples) -> Result<(), PictureError> {
        let triangle = &self.triangles[index as usize];
        let object = &self.drawing.objects[triangle.object as usize];
        let [low, high] = triangle.rows().map(|y| y - samples.top);
        for row in span(low, high, samples.rows) {
            let y = samples.top + row as f64 + 0.5;
            let Some([left, right]) = crossing(&triangle.page, y) else {
                continue;
            };
            for column in span(left, right, samples.columns) {
                let p = samples.place(column, row);
                let depth = triangle.depth_at(p);
                let at = row * samples.columns + column;
                if depth >= samples.seen[at].depth {
                    continue;
                }
                let mut label = OPEN;
                match (&object.skin, self.drawing.asked) {
                    (Skin::Owned(face), Some(asked)) => {
                        // Where the face is, not where it counts as: that is outside of the domain, where nobody
                        // owns anything.
                        let place = self.eye.stretched_at(p, depth + triangle.bias);
                        label = face.label(place, asked)?;
                        if label == OPEN {
                            continue;
                        }
                    }
                    (Skin::Plain { opacity, .. }, _) if *opacity < 1.0 => {
                        samples.layers.push(Layer {
                            sample: at,
                            depth,
                            triangle: index,
                        });
                        continue;
                    }
                    _ => {}
                }
                samples.seen[at] = Seen {
                    depth,
                    triangle: index,
                    label,
                };
            }
        }
        Ok(())
    }
}

/// Indices of the samples whose middles lie from `low` to `high`.
fn span(low: f64, high: f64, count: usize) -> std::ops::Range<usize> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped"
    )]
    let clamped = |value: f64| value.clamp(0.0, count as f64) as usize;
    clamped((low - 0.5).ceil())..clamped((high - 0.5).floor() + 1.0)
}

/// Where a row crosses a triangle.
fn crossing(page: &[DVec2; 3], y: f64) -> Option<[f64; 2]> {
    let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..3 {
        let (a, b) = (page[i], page[(i + 1) % 3]);
        if (a.y <= y) != (b.y <= y) {
            // From the upper end always, so that neighbours agree on their common side.
            let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
            let x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
            left = left.min(x);
            right = right.max(x);
        }
    }
    (left <= right).then_some([left, right])
}
