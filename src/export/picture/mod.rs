//! Pictures of a model: figures of sections and maps ([`section`]) and views in three dimensions ([`view`]).
//!
//! Both take plain data — labels, colours, coordinates, triangles — and nothing of the model, so that whatever can
//! answer "whose is this point?" can be drawn. Axes, legends and text are composed as SVG and rasterised by `resvg`
//! with an embedded font (Noto Sans, SIL Open Font License 1.1), so that a picture needs neither a display nor
//! installed fonts and is the same, byte for byte, wherever and with however many threads it is drawn.
//!
//! Known limit: the font has Latin, Greek and Cyrillic letters; other scripts appear in the SVG of a figure (its reader's
//! fonts draw them) but not in a PNG.

mod camera;
mod canvas;
pub mod cap;
mod check;
pub mod contact;
mod drawing;
mod face;
mod figure;
mod font;
mod furniture;
mod halfspace;
mod legend;
mod outline;
mod page;
mod plot;
mod raster;
mod samples;
mod scale_bar;
mod scene;
pub mod section;
mod shading;
mod solid;
mod style;
mod ticks;
pub mod view;

use std::fmt;

pub use drawing::rasterised;

/// A colour: red, green, blue, each 0 to 255 in sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rgb(pub u8, pub u8, pub u8);

impl Rgb {
    /// This colour moved by `fraction` (0 to 1) towards `other`.
    #[must_use]
    pub fn mixed(self, other: Self, fraction: f64) -> Self {
        let mix = |a: u8, b: u8| byte(f64::from(a) + (f64::from(b) - f64::from(a)) * fraction);
        Self(
            mix(self.0, other.0),
            mix(self.1, other.1),
            mix(self.2, other.2),
        )
    }
}

impl fmt::Display for Rgb {
    /// As in CSS and SVG: `#rrggbb`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

/// The nearest byte of a value on the scale 0 to 255.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to 0..=255 first"
)]
fn byte(value: f64) -> u8 {
    value.round().clamp(0.0, 255.0) as u8
}

/// An entry of the legend: a facies (or whatever the colours stand for) with its colour.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Swatch {
    /// What the reader is told: "channel sand".
    pub name: String,
    /// Its colour, in the legend and in the picture.
    pub color: Rgb,
}

/// Something with an outline of its own in the picture: one body among others of its facies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Volume {
    /// Its name, shown by a browser when the pointer is on it: "channel/7".
    pub name: String,
    /// Which swatch of the legend gives its colour: an index.
    pub swatch: usize,
}

/// Why a picture could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PictureError {
    /// A coordinate or angle is infinite or not a number.
    #[error("{what} is {value}; a picture needs finite numbers")]
    NotFinite {
        /// Which number.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A number is outside what can be drawn.
    #[error("{what} is {value}; give a value from {low} to {high}")]
    OutOfRange {
        /// Which number.
        what: String,
        /// Its value.
        value: f64,
        /// The least value that can be drawn.
        low: f64,
        /// The greatest value that can be drawn.
        high: f64,
    },
    /// A range that is empty or upside down.
    #[error(
        "{what} goes from {low} to {high}; the first must be below the second, and by more than rounding"
    )]
    EmptyRange {
        /// Which range.
        what: String,
        /// Its first value.
        low: f64,
        /// Its second value.
        high: f64,
    },
    /// The cells don't fill the raster.
    #[error(
        "the raster is {width} × {height} but has {cells} cells; give width × height cells, row by row from the top"
    )]
    RasterSize {
        /// Cells in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Cells that were given.
        cells: usize,
    },
    /// An index that points at nothing.
    #[error("{what} refers to {index}, but there are only {count}; indices begin at 0")]
    NoSuchEntry {
        /// What refers.
        what: String,
        /// The index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A line or box that makes no picture: too few points, nothing left.
    #[error("{what}: {problem}")]
    Shape {
        /// Which line or box.
        what: String,
        /// What is wrong and what to do.
        problem: &'static str,
    },
    /// The drawing could not be turned into pixels.
    #[error("the drawing could not be turned into pixels: {0}; please report this with the input")]
    Render(String),
}

/// Most pixels along a side of a PNG.
pub const LARGEST_SIDE: u32 = 16_384;
/// Fewest pixels along a side of a PNG: below this nothing can be read.
pub const SMALLEST_SIDE: u32 = 64;
/// Most pixels of a PNG (a quarter of a gigabyte while it is drawn).
pub const MOST_PIXELS: u64 = 1 << 26;
