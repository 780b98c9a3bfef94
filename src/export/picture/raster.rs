//! Triangles to pixels: a depth buffer with several samples a pixel, shading and outlines.
//!
//! Why not a library: the rasterisers on crates.io work in single precision and keep colour and depth only, while
//! outlines want to know which body and which triangle each sample shows, and several layers where bodies are
//! transparent. The picture is drawn in bands of rows, each by itself, so that the number of threads cannot matter.
//!
//! Each sample keeps the nearest opaque triangle (ties go to the first), then is shaded by Lambert's law, softened to
//! half as in "half Lambert" shading, with a light from the upper left behind the viewer. Lines are drawn where samples
//! around show another body, another owner, a jump of depth or a crease.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{
    PictureError, Rgb, byte,
    camera::Eye,
    canvas::INK,
    face::{Asked, Face, OPEN},
    solid::Vertex,
};

/// Samples along a pixel's side.
pub(super) const SAMPLES: usize = 3;
/// Rows of pixels in a band.
const BAND: usize = 16;
/// Widest line, in samples to each side.
const WIDEST: usize = 6;
const NONE: u32 = u32::MAX;
/// Neighbouring samples whose normals differ by more than 35° lie on both sides of a crease.
const CREASE_COS: f64 = 0.82;

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
struct Projected {
    object: u32,
    page: [DVec2; 3],
    depth: [f64; 3],
    normals: [DVec3; 3],
    /// One over twice the signed area.
    per_area: f64,
    /// How the depth grows along the page.
    slope: DVec2,
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

    fn depth_at(&self, p: DVec2) -> f64 {
        self.depth[0] + self.slope.dot(p - self.page[0])
    }

    /// The unit normal turned to the viewer.
    fn normal_at(&self, p: DVec2, forward: DVec3) -> DVec3 {
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

struct Scene<'a> {
    drawing: &'a Drawing<'a>,
    eye: &'a Eye,
    triangles: &'a [Projected],
    light: DVec3,
    width: usize,
    reach: usize,
}

/// The nearest opaque thing at a sample.
#[derive(Clone, Copy)]
struct Seen {
    depth: f64,
    triangle: u32,
    label: u32,
}

const NOTHING: Seen = Seen {
    depth: f64::INFINITY,
    triangle: NONE,
    label: OPEN,
};

/// A transparent layer at a sample.
#[derive(Clone, Copy)]
struct Layer {
    sample: usize,
    depth: f64,
    triangle: u32,
}

/// Samples of a band with a margin of `reach` rows above and below.
struct Samples {
    columns: usize,
    rows: usize,
    /// The page's sample row of the first row here; may be negative.
    top: f64,
    seen: Vec<Seen>,
    layers: Vec<Layer>,
    /// The object of each sample's nearest transparent layer.
    veil: Vec<u32>,
}

impl Samples {
    fn place(&self, column: usize, row: usize) -> DVec2 {
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
                        label = face.label(self.eye.stretched_at(p, depth), asked)?;
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

    /// The colour of a sample, premultiplied, each channel 0 to 255.
    fn color(&self, samples: &Samples, lines: &Lines, column: usize, row: usize) -> [f64; 4] {
        let at = row * samples.columns + column;
        let p = samples.place(column, row);
        let seen = samples.seen[at];
        let mut color = if seen.triangle == NONE {
            [0.0; 4]
        } else {
            self.shaded(&seen, p)
        };
        if let Some(line) = &lines.solid[at] {
            color = over(channels(line.color.mixed(INK, line.shade)), 1.0, color);
        }
        let from = samples.layers.partition_point(|layer| layer.sample < at);
        let here = samples.layers[from..]
            .iter()
            .take_while(|layer| layer.sample == at);
        // From the farthest to the nearest.
        let layers: Vec<&Layer> = here.collect();
        for layer in layers.iter().rev() {
            let triangle = &self.triangles[layer.triangle as usize];
            if let Skin::Plain {
                color: own,
                opacity,
            } = self.drawing.objects[triangle.object as usize].skin
            {
                let normal = triangle.normal_at(p, self.eye.forward);
                color = over(self.lit(own, normal), opacity, color);
            }
        }
        if lines.veil.get(at) == Some(&true) {
            color = over(channels(INK), 0.45, color);
        }
        color
    }

    fn base(&self, seen: &Seen) -> Rgb {
        let triangle = &self.triangles[seen.triangle as usize];
        match self.drawing.objects[triangle.object as usize].skin {
            Skin::Plain { color, .. } => color,
            Skin::Owned(_) => self.drawing.colors[seen.label as usize],
        }
    }

    fn shaded(&self, seen: &Seen, p: DVec2) -> [f64; 4] {
        let triangle = &self.triangles[seen.triangle as usize];
        let normal = triangle.normal_at(p, self.eye.forward);
        let base = self.base(seen);
        let lit = match self.drawing.objects[triangle.object as usize].skin {
            Skin::Plain { .. } => self.lit(base, normal),
            // Faces keep close to the legend's colours.
            Skin::Owned(_) => {
                let lit = self.lit(base, normal);
                let flat = channels(base);
                [0, 1, 2].map(|i| 0.5 * flat[i] + 0.5 * lit[i])
            }
        };
        over(lit, 1.0, [0.0; 4])
    }

    /// A colour under the light.
    fn lit(&self, color: Rgb, normal: DVec3) -> [f64; 3] {
        let half = 0.5 + 0.5 * normal.dot(self.light);
        let strength = 0.58 + 0.47 * half * half + 0.03 * normal.z;
        channels(color).map(|channel| {
            if strength <= 1.0 {
                channel * strength
            } else {
                channel + (255.0 - channel) * (strength - 1.0)
            }
        })
    }

    /// The outlines: found between neighbouring samples, then drawn as wide as they shall be.
    fn lines(&self, samples: &Samples) -> Lines {
        let count = samples.seen.len();
        let mut lines = Lines {
            solid: vec![None; count],
            veil: vec![false; samples.veil.len()],
        };
        let offsets = disc(self.reach - 1);
        for row in 0..samples.rows {
            for column in 0..samples.columns {
                let at = row * samples.columns + column;
                let next = [
                    (column + 1, row, column + 1 < samples.columns),
                    (column, row + 1, row + 1 < samples.rows),
                ];
                for (x, y, _) in next.into_iter().filter(|(_, _, inside)| *inside) {
                    let other = y * samples.columns + x;
                    let both = [(column, row), (x, y)];
                    if let Some(line) = self.line_between(samples, both) {
                        for place in both {
                            for i in around(samples, place, &offsets) {
                                // The darkest reason counts, and of equal ones the nearest body.
                                let wins = lines.solid[i].is_none_or(|there| {
                                    (line.shade, -line.depth) > (there.shade, -there.depth)
                                });
                                if wins {
                                    lines.solid[i] = Some(line);
                                }
                            }
                        }
                    }
                    if !lines.veil.is_empty() && samples.veil[at] != samples.veil[other] {
                        for place in both {
                            for i in around(samples, place, &offsets) {
                                lines.veil[i] = true;
                            }
                        }
                    }
                }
            }
        }
        lines
    }

    /// The line between two neighbouring samples, if there is one.
    fn line_between(&self, samples: &Samples, both: [(usize, usize); 2]) -> Option<Line> {
        let [a, b] = both.map(|(column, row)| samples.seen[row * samples.columns + column]);
        if a.triangle == b.triangle && a.label == b.label {
            return None;
        }
        let [p, q] = both.map(|(column, row)| samples.place(column, row));
        let shade = self.shade_between([(p, &a), (q, &b)])?;
        let nearer = if a.depth <= b.depth { a } else { b };
        Some(Line {
            shade,
            depth: nearer.depth,
            color: self.base(&nearer),
        })
    }

    /// How dark a line two neighbouring samples ask for.
    fn shade_between(&self, [(p, a), (q, b)]: [(DVec2, &Seen); 2]) -> Option<f64> {
        if a.triangle == NONE || b.triangle == NONE {
            return (a.triangle != b.triangle).then_some(0.85);
        }
        let [ta, tb] = [a, b].map(|seen| &self.triangles[seen.triangle as usize]);
        if ta.object != tb.object {
            return Some(0.8);
        }
        if a.label != b.label {
            let same = self.base(a) == self.base(b);
            return Some(if same { 0.6 } else { 0.75 });
        }
        // Where each would lie at the other's place, were it to go on.
        let gap = (ta.depth_at(q) - b.depth)
            .abs()
            .min((tb.depth_at(p) - a.depth).abs());
        let slope = ta.slope.length().min(tb.slope.length());
        if gap > 4.0 * (1.0 / self.eye.scale + slope) {
            return Some(0.75);
        }
        let normals = [
            ta.normal_at(p, self.eye.forward),
            tb.normal_at(q, self.eye.forward),
        ];
        (normals[0].dot(normals[1]) < CREASE_COS).then_some(0.55)
    }
}

/// A line's darkness (how far its colour goes towards black), depth and the colour it darkens.
#[derive(Clone, Copy)]
struct Line {
    shade: f64,
    depth: f64,
    color: Rgb,
}

/// The lines of a band, sample by sample.
struct Lines {
    solid: Vec<Option<Line>>,
    /// Around transparent bodies; empty where there are none.
    veil: Vec<bool>,
}

/// Offsets of the samples within a distance.
fn disc(reach: usize) -> Vec<(isize, isize)> {
    let reach = reach.cast_signed();
    let mut offsets = Vec::new();
    for dy in -reach..=reach {
        for dx in -reach..=reach {
            if dx * dx + dy * dy <= reach * reach {
                offsets.push((dx, dy));
            }
        }
    }
    offsets
}

fn around(
    samples: &Samples,
    (column, row): (usize, usize),
    offsets: &[(isize, isize)],
) -> impl Iterator<Item = usize> {
    let (columns, rows) = (samples.columns, samples.rows);
    offsets.iter().filter_map(move |&(dx, dy)| {
        let x = column.checked_add_signed(dx).filter(|&x| x < columns)?;
        let y = row.checked_add_signed(dy).filter(|&y| y < rows)?;
        Some(y * columns + x)
    })
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

fn channels(color: Rgb) -> [f64; 3] {
    [color.0, color.1, color.2].map(f64::from)
}

/// A colour laid over a premultiplied one.
fn over(color: [f64; 3], opacity: f64, below: [f64; 4]) -> [f64; 4] {
    let mix = |i: usize| color[i] * opacity + below[i] * (1.0 - opacity);
    [
        mix(0),
        mix(1),
        mix(2),
        255.0 * opacity + below[3] * (1.0 - opacity),
    ]
}
