//! Draws every kind of picture from a made-up channel belt: `cargo run --example pictures -- FOLDER`.
//!
//! Nine sinuous channels, the younger cutting the older, in a floodplain of 1000 m × 1000 m × 60 m. The model is a
//! formula, so that the pictures show what the drawing does and nothing else.

use std::{error::Error, f64::consts::TAU, fs, path::Path};

use clinothem::export::picture::{
    Rgb, Swatch, Volume,
    section::{Extent, Kind, LabelRaster, SectionFigure, Trace, fitting_exaggeration},
    view::{Box3, Camera, Cut, Part, Projection, Scene},
};
use glam::{DVec2, DVec3};

const MUD: u32 = 0;

/// A channel that runs east: its axis is a sine, its section a parabola with a flat top.
struct Channel {
    axis: f64,
    amplitude: f64,
    wavelength: f64,
    phase: f64,
    width: f64,
    depth: f64,
    top: f64,
    swatch: usize,
}

impl Channel {
    /// Northing of the axis and its slope.
    fn axis(&self, x: f64) -> (f64, f64) {
        let angle = TAU * (x / self.wavelength + self.phase);
        (
            self.axis + self.amplitude * angle.sin(),
            self.amplitude * TAU / self.wavelength * angle.cos(),
        )
    }

    fn base(&self, across: f64) -> f64 {
        self.top - self.depth * (1.0 - (2.0 * across / self.width).powi(2))
    }

    fn contains(&self, p: DVec3) -> bool {
        let (y, slope) = self.axis(p.x);
        let across = (p.y - y) / slope.hypot(1.0);
        p.z <= self.top && p.z >= self.base(across)
    }
}

fn belt() -> Vec<Channel> {
    let channel = |i: usize, axis, amplitude, wavelength, width, depth, top| Channel {
        axis,
        amplitude,
        wavelength,
        phase: 0.37 * i as f64,
        width,
        depth,
        top,
        swatch: if i % 3 == 2 { 2 } else { 1 },
    };
    vec![
        channel(0, 300.0, 70.0, 620.0, 150.0, 9.0, -44.0),
        channel(1, 640.0, 90.0, 700.0, 180.0, 11.0, -40.0),
        channel(2, 470.0, 60.0, 520.0, 120.0, 8.0, -36.0),
        channel(3, 560.0, 110.0, 760.0, 200.0, 12.0, -29.0),
        channel(4, 380.0, 80.0, 560.0, 140.0, 9.0, -24.0),
        channel(5, 700.0, 60.0, 480.0, 110.0, 7.0, -21.0),
        channel(6, 520.0, 100.0, 640.0, 190.0, 12.0, -11.0),
        channel(7, 330.0, 70.0, 540.0, 130.0, 8.0, -7.0),
        channel(8, 480.0, 95.0, 600.0, 160.0, 10.0, 0.0),
    ]
}

/// The youngest channel that contains the point, else the floodplain.
#[expect(clippy::cast_possible_truncation, reason = "nine channels")]
fn owner(belt: &[Channel], p: DVec3) -> u32 {
    let youngest = belt.iter().rposition(|channel| channel.contains(p));
    youngest.map_or(MUD, |i| 1 + i as u32)
}

fn legend() -> Vec<Swatch> {
    let swatch = |name: &str, color| Swatch {
        name: name.to_owned(),
        color,
    };
    vec![
        swatch("floodplain mudstone", Rgb(0xa9, 0xb3, 0x8f)),
        swatch("channel sandstone", Rgb(0xf4, 0xcf, 0x5b)),
        swatch("heterolithic channel fill", Rgb(0xd9, 0x92, 0x4e)),
    ]
}

fn volumes(belt: &[Channel]) -> Vec<Volume> {
    let mud = Volume {
        name: "floodplain".to_owned(),
        swatch: 0,
    };
    let channels = belt.iter().enumerate().map(|(i, channel)| Volume {
        name: format!("channel/{}", i + 1),
        swatch: channel.swatch,
    });
    [mud].into_iter().chain(channels).collect()
}

/// The point at a distance along a line.
fn along(line: &[DVec2], distance: f64) -> DVec2 {
    let mut left = distance;
    for pair in line.windows(2) {
        let length = pair[0].distance(pair[1]);
        if left <= length {
            return pair[0].lerp(pair[1], left / length);
        }
        left -= length;
    }
    line[line.len() - 1]
}

/// Labels at the middles of the cells of a raster whose rows run down from the top.
fn raster(
    width: usize,
    height: usize,
    extent: Extent,
    label: impl Fn(f64, f64) -> u32,
) -> LabelRaster {
    let at = |[low, high]: [f64; 2], fraction: f64| low + (high - low) * fraction;
    let cells = (0..height).flat_map(|row| {
        let v = at(extent.vertical, 1.0 - (row as f64 + 0.5) / height as f64);
        let label = &label;
        (0..width).map(move |column| {
            label(
                at(extent.horizontal, (column as f64 + 0.5) / width as f64),
                v,
            )
        })
    });
    LabelRaster {
        width,
        height,
        cells: cells.collect(),
    }
}

fn section(belt: &[Channel], line: Vec<DVec2>, title: &str) -> SectionFigure {
    let length = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let extent = Extent {
        horizontal: [0.0, length],
        vertical: [-60.0, 0.0],
    };
    SectionFigure {
        title: title.to_owned(),
        subtitle: String::new(),
        raster: raster(2400, 800, extent, |s, z| {
            owner(belt, along(&line, s).extend(z))
        }),
        kind: Kind::Section {
            line,
            ends: ["A".to_owned(), "A′".to_owned()],
            vertical_exaggeration: fitting_exaggeration(length, 60.0),
        },
        extent,
        volumes: volumes(belt),
        legend: legend(),
        wells: Vec::new(),
    }
}

fn map(belt: &[Channel], traces: Vec<Trace>) -> SectionFigure {
    let extent = Extent {
        horizontal: [0.0, 1000.0],
        vertical: [0.0, 1000.0],
    };
    SectionFigure {
        title: "Channel belt, map at 12 m below the top".to_owned(),
        subtitle: "elevation −12 m".to_owned(),
        raster: raster(1600, 1600, extent, |x, y| {
            owner(belt, DVec3::new(x, y, -12.0))
        }),
        kind: Kind::Map { traces },
        extent,
        volumes: volumes(belt),
        legend: legend(),
        wells: Vec::new(),
    }
}

/// The surface of a channel between x = 0 and x = 1000: base, top and both ends.
fn surface(channel: &Channel, volume: usize, opacity: f64) -> Part {
    const STATIONS: u32 = 160;
    const ACROSS: u32 = 24;
    let row = 2 * ACROSS;
    let mut positions = Vec::new();
    for station in 0..=STATIONS {
        let x = 1000.0 * f64::from(station) / f64::from(STATIONS);
        let (y, slope) = channel.axis(x);
        // Once around the section: along the base, then back along the top.
        for i in 0..row {
            let fraction = f64::from(i % ACROSS) / f64::from(ACROSS);
            let (across, z) = if i < ACROSS {
                let across = channel.width * (fraction - 0.5);
                (across, channel.base(across))
            } else {
                (channel.width * (0.5 - fraction), channel.top)
            };
            positions.push(DVec3::new(x, y + across * slope.hypot(1.0), z));
        }
    }
    let mut triangles = Vec::new();
    for station in 0..STATIONS {
        for i in 0..row {
            let [a, b] = [i, (i + 1) % row].map(|i| station * row + i);
            triangles.extend([[a, b, a + row], [b, b + row, a + row]]);
        }
    }
    let last = STATIONS * row;
    for i in 1..row - 1 {
        triangles.extend([[0, i + 1, i], [last, last + i, last + i + 1]]);
    }
    Part {
        volume,
        positions,
        normals: None,
        triangles,
        opacity,
    }
}

fn scene(belt: &[Channel], title: &str, camera: Camera, cut: Option<Cut>) -> Scene {
    Scene {
        title: title.to_owned(),
        subtitle: String::new(),
        domain: Box3 {
            low: DVec3::new(0.0, 0.0, -60.0),
            high: DVec3::new(1000.0, 1000.0, 0.0),
        },
        parts: belt
            .iter()
            .zip(1..)
            .map(|(channel, volume)| surface(channel, volume, 1.0))
            .collect(),
        volumes: volumes(belt),
        legend: legend(),
        camera,
        cut,
    }
}

fn views(belt: &[Channel], folder: &Path) -> Result<(), Box<dyn Error>> {
    let all = |p: DVec3| Some(owner(belt, p));
    let bodies = |p: DVec3| Some(owner(belt, p)).filter(|&label| label != MUD);
    let above = Camera::from_above(5.0);
    let below = Camera::from_below(5.0);
    let near = Camera {
        projection: Projection::Perspective { distance: 2.5 },
        ..above
    };
    let corner = Cut::Corner {
        low: DVec3::new(-1.0, -1.0, -34.0),
        high: DVec3::new(560.0, 420.0, 1.0),
    };
    let plane = Cut::Plane {
        point: DVec3::new(430.0, 430.0, 0.0),
        removes: DVec3::new(-1.0, -1.0, 0.0),
    };
    let block = scene(
        belt,
        "Channel belt, block diagram with its south-west corner cut away",
        above,
        Some(corner),
    );
    fs::write(folder.join("block.png"), block.png(1600, 1000, Some(&all))?)?;
    let solids = scene(
        belt,
        "Channel belt, sandbodies seen from above",
        above,
        None,
    );
    fs::write(
        folder.join("above.png"),
        solids.png(1600, 1000, Some(&bodies))?,
    )?;
    let solids = scene(
        belt,
        "Channel belt, sandbodies seen from below",
        below,
        None,
    );
    fs::write(
        folder.join("below.png"),
        solids.png(1600, 1000, Some(&bodies))?,
    )?;
    let cut = scene(
        belt,
        "Channel belt, cut along a diagonal plane",
        near,
        Some(plane),
    );
    fs::write(folder.join("cut.png"), cut.png(1600, 1000, Some(&bodies))?)?;
    let mut glass = scene(
        belt,
        "Channel belt, the younger channels as glass",
        above,
        None,
    );
    for part in glass.parts.iter_mut().skip(5) {
        part.opacity = 0.4;
    }
    fs::write(folder.join("glass.png"), glass.png(1200, 1200, None)?)?;
    let map = Camera {
        azimuth_deg: 180.0,
        elevation_deg: 90.0,
        ..above
    };
    fs::write(
        folder.join("top.png"),
        scene(belt, "Channel belt from straight above", map, None).png(1600, 1000, None)?,
    )?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "pictures".to_owned());
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    let belt = belt();
    let across = vec![DVec2::new(500.0, 0.0), DVec2::new(500.0, 1000.0)];
    let fence = vec![
        DVec2::new(60.0, 80.0),
        DVec2::new(420.0, 380.0),
        DVec2::new(640.0, 330.0),
        DVec2::new(930.0, 940.0),
    ];
    let trace = |a: &str, b: &str, line: &[DVec2]| Trace {
        ends: [a.to_owned(), b.to_owned()],
        line: line.to_vec(),
    };
    let figures = [
        (
            "section",
            section(
                &belt,
                across.clone(),
                "Channel belt, section across the flow",
            ),
        ),
        (
            "fence",
            section(&belt, fence.clone(), "Channel belt, fence"),
        ),
        (
            "map",
            map(
                &belt,
                vec![trace("A", "A′", &across), trace("B", "B′", &fence)],
            ),
        ),
    ];
    for (name, figure) in &figures {
        fs::write(folder.join(format!("{name}.svg")), figure.svg()?)?;
        fs::write(folder.join(format!("{name}.png")), figure.png(1600)?)?;
    }
    views(&belt, folder)
}
