//! Samples: which triangle each one shows, and what lies over it.
//!
//! Why not a library: rasterisers such as `euc` take positions in single precision and keep colour and depth only, while
//! outlines want to know which body, owner and triangle each sample shows, and transparent bodies several layers.
//!
//! Each sample keeps the nearest opaque triangle; ties go to the first.

use glam::{DVec2, DVec3};

use super::{
    PictureError, Rgb,
    camera::Eye,
    face::{Asked, Face, OPEN},
    halfspace::Vertex,
};

/// Samples along a pixel's side.
pub(super) const SAMPLES: usize = 3;
/// No triangle.
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
    pub(super) fn new(object: u32, corners: &[Vertex; 3], eye: &Eye, bias: f64) -> Option<Self> {
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

    pub(super) fn rows(&self) -> [f64; 2] {
        let ys = self.page.map(|p| p.y);
        [
            ys.into_iter().fold(f64::INFINITY, f64::min),
            ys.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ]
    }
}

pub(super) struct Scene<'a> {
    pub(super) drawing: &'a Drawing<'a>,
    pub(super) eye: &'a Eye,
    pub(super) triangles: &'a [Projected],
    pub(super) light: DVec3,
    pub(super) width: usize,
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
    /// The samples of a band of `rows` rows of pixels, of the triangles that meet it.
    pub(super) fn samples(
        &self,
        first: usize,
        rows: usize,
        members: &[u32],
    ) -> Result<Samples, PictureError> {
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
