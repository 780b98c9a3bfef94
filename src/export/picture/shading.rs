//! Light and lines: the colours of a band's samples.
//!
//! Light falls as in [`super::raster`]; lines are found between neighbouring samples and drawn over both.

use glam::{DVec2, DVec3};

use super::{
    Rgb,
    canvas::INK,
    samples::{Layer, NONE, Samples, Scene, Seen, Skin},
};

/// Neighbouring samples whose normals differ by more than 35° lie on both sides of a crease.
const CREASE_COS: f64 = 0.82;

impl Scene<'_> {
    /// The colour of a sample, premultiplied, each channel 0 to 255.
    pub(super) fn color(
        &self,
        samples: &Samples,
        lines: &Lines,
        column: usize,
        row: usize,
    ) -> [f64; 4] {
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
    pub(super) fn lines(&self, samples: &Samples) -> Lines {
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
pub(super) struct Lines {
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
