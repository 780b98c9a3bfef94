//! Tests of views.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod faces;
mod hiding;
mod page;

use super::*;
use glam::DVec3;
use resvg::tiny_skia::Pixmap;

const GREY_MUD: Rgb = Rgb(0x50, 0x90, 0x50);
const SAND: Rgb = Rgb(0xe0, 0x40, 0x30);
const COAL: Rgb = Rgb(0x30, 0x40, 0xe0);
const PALETTE: [Rgb; 3] = [GREY_MUD, SAND, COAL];

fn camera(azimuth_deg: f64, elevation_deg: f64) -> Camera {
    Camera {
        azimuth_deg,
        elevation_deg,
        vertical_exaggeration: 1.0,
        projection: Projection::Orthographic,
    }
}

fn scene(camera: Camera, parts: Vec<Part>) -> Scene {
    let names = ["mud", "sand", "coal"];
    Scene {
        title: "Test".to_owned(),
        subtitle: String::new(),
        domain: Box3 {
            low: DVec3::ZERO,
            high: DVec3::splat(100.0),
        },
        parts,
        volumes: (0..3)
            .map(|swatch| Volume {
                name: names[swatch].to_owned(),
                swatch,
            })
            .collect(),
        legend: names
            .iter()
            .zip(PALETTE)
            .map(|(name, color)| Swatch {
                name: (*name).to_owned(),
                color,
            })
            .collect(),
        camera,
        cut: None,
    }
}

fn solid_box(volume: usize, low: [f64; 3], high: [f64; 3]) -> Part {
    let bounds = Box3 {
        low: DVec3::from(low),
        high: DVec3::from(high),
    };
    Part {
        volume,
        positions: bounds.corners().to_vec(),
        normals: None,
        triangles: vec![
            [0, 4, 2],
            [2, 4, 6],
            [1, 3, 5],
            [3, 7, 5],
            [0, 1, 4],
            [1, 5, 4],
            [2, 6, 3],
            [3, 6, 7],
            [0, 2, 1],
            [1, 2, 3],
            [4, 5, 6],
            [5, 7, 6],
        ],
        opacity: 1.0,
    }
}

/// The picture without its column: which colour of the palette each pixel has, whatever the light.
struct Picture {
    width: usize,
    hues: Vec<Option<usize>>,
    low: [usize; 2],
    high: [usize; 2],
}

impl Picture {
    fn of(scene: &Scene, owner: Option<Owner<'_>>) -> Self {
        let pixels = Pixmap::decode_png(&scene.png(650, 350, owner).unwrap()).unwrap();
        let width = 520;
        let hues: Vec<Option<usize>> = (0..350)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| {
                let pixel = pixels.pixel(x, y).unwrap();
                let seen = [pixel.red(), pixel.green(), pixel.blue()].map(f64::from);
                let colorful = seen.iter().copied().fold(0.0, f64::max)
                    - seen.iter().copied().fold(255.0, f64::min);
                PALETTE.iter().position(|c| {
                    let own = [c.0, c.1, c.2].map(f64::from);
                    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
                    colorful > 25.0
                        && dot(seen, own) / (dot(seen, seen) * dot(own, own)).sqrt() > 0.98
                })
            })
            .collect();
        let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
        for (i, hue) in hues.iter().enumerate() {
            if hue.is_some() {
                for (axis, at) in [i % width as usize, i / width as usize]
                    .into_iter()
                    .enumerate()
                {
                    low[axis] = low[axis].min(at);
                    high[axis] = high[axis].max(at);
                }
            }
        }
        Self {
            width: width as usize,
            hues,
            low,
            high,
        }
    }

    /// At fractions of what is coloured, from the left and from the top.
    fn at(&self, x: f64, y: f64) -> Option<usize> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "inside"
        )]
        let [column, row] = [(0, x), (1, y)].map(|(axis, f): (usize, f64)| {
            self.low[axis] + (f * (self.high[axis] - self.low[axis]) as f64).round() as usize
        });
        self.hues[row * self.width + column]
    }

    fn count(&self, hue: usize) -> f64 {
        self.hues.iter().filter(|seen| **seen == Some(hue)).count() as f64
    }
}
