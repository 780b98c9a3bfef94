//! Which bodies may hold a place: the domain's block in cells, each with the bodies whose boxes meet it.
//!
//! A place is asked of a few bodies instead of all. What takes everything, and certainly holds a whole cell, leaves no trace of what
//! is older there: of a thousand layers a cell knows those few whose bases pass through it and the one below these.

use glam::DVec3;

use super::interior::Interior;
use super::rules::{BACKGROUND, Rules};

/// Cells along an axis at most.
const MOST_ALONG: f64 = 2048.0;
/// Cells for each body, and in all, at most.
const A_BODY: usize = 8;
const MOST: usize = 1 << 16;
/// Boxes are taken larger by this fraction of the block, far above rounding.
const MARGIN: f64 = 1e-9;

/// The cells of a block.
#[derive(Debug)]
pub(super) struct Cells {
    low: DVec3,
    /// Cells per metre.
    per_metre: DVec3,
    counts: [usize; 3],
    all: Vec<Cell>,
}

/// What may hold a place of a cell.
#[derive(Clone, Debug)]
struct Cell {
    /// The volume that holds all of the cell at some time, whatever was there before.
    first: usize,
    /// The younger ones that may hold a place of it, oldest first.
    younger: Vec<usize>,
}

/// Where a body certainly holds nothing, and where everything.
struct Reach {
    /// A box outside of which it holds nothing.
    low: DVec3,
    high: DVec3,
    /// The elevation above which it holds everything.
    above: f64,
}

impl Reach {
    fn of(interior: &Interior, margin: f64) -> Self {
        let (low, high) = match interior {
            Interior::Shell(_) | Interior::Ellipsoid(_) => interior.bounds(),
            Interior::Side(side) => {
                // Beyond its heights a horizon holds all or nothing; of most other sides nothing is known.
                let [lowest, above] = match side.heights() {
                    Some(heights) => heights,
                    None if side.is_everywhere() => [f64::NEG_INFINITY; 2],
                    None => [f64::NEG_INFINITY, f64::INFINITY],
                };
                return Self {
                    low: DVec3::NEG_INFINITY.with_z(lowest - margin),
                    high: DVec3::INFINITY,
                    above: above + margin,
                };
            }
        };
        Self {
            low: low - margin,
            high: high + margin,
            above: f64::INFINITY,
        }
    }

    /// How long it is undecided along each axis, in a block of this size.
    fn undecided(&self, size: DVec3) -> DVec3 {
        let top = self.high.with_z(self.high.z.min(self.above));
        (top - self.low).min(size)
    }
}

impl Cells {
    pub(super) fn new([low, high]: [DVec3; 2], interiors: &[Interior], rules: &Rules) -> Self {
        let size = high - low;
        let margin = MARGIN * size.length();
        let reaches: Vec<Reach> = interiors
            .iter()
            .map(|interior| Reach::of(interior, margin))
            .collect();
        let counts = counts(&reaches, size);
        let [nx, ny, nz] = counts;
        let empty = Cell {
            first: BACKGROUND,
            younger: Vec::new(),
        };
        let mut made = Self {
            low,
            per_metre: DVec3::new(nx as f64, ny as f64, nz as f64) / size,
            counts,
            all: vec![empty; nx * ny * nz],
        };
        for (at, reach) in reaches.iter().enumerate() {
            let body = at + 1;
            made.add(body, reach, rules.takes_everything(body));
        }
        made
    }

    /// Adds a body, younger than those before.
    fn add(&mut self, body: usize, reach: &Reach, takes_everything: bool) {
        let [from, to] = [reach.low, reach.high].map(|corner| self.place(corner));
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                for z in from[2]..=to[2] {
                    let floor = self.low.z + z as f64 / self.per_metre.z;
                    let place = self.index([x, y, z]);
                    let cell = &mut self.all[place];
                    if takes_everything && floor > reach.above {
                        cell.first = body;
                        cell.younger.clear();
                    } else {
                        cell.younger.push(body);
                    }
                }
            }
        }
    }

    /// The volume that holds a place at some time, and the younger ones that may hold it after that, oldest first.
    pub(super) fn at(&self, point: DVec3) -> (usize, impl Iterator<Item = usize>) {
        let cell = &self.all[self.index(self.place(point))];
        (cell.first, cell.younger.iter().copied())
    }

    /// The cell of a place, or the one nearest to it.
    fn place(&self, point: DVec3) -> [usize; 3] {
        let at = (point - self.low) * self.per_metre;
        std::array::from_fn(|axis| whole(at[axis]).min(self.counts[axis] - 1))
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.counts[1] + y) * self.counts[2] + z
    }
}

/// The whole part of a number; 0 of what is below it, or no number.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a float becomes the nearest whole number that there is"
)]
fn whole(value: f64) -> usize {
    value as usize
}

/// Cells along the axes: about as long as bodies are, but no more of them than there is use for.
fn counts(reaches: &[Reach], size: DVec3) -> [usize; 3] {
    let mean = reaches
        .iter()
        .map(|reach| reach.undecided(size))
        .sum::<DVec3>()
        / reaches.len().max(1) as f64;
    let along = |axis: usize| {
        let wanted = size[axis] / mean[axis].max(size[axis] / MOST_ALONG);
        whole(wanted.min(MOST_ALONG)).max(1)
    };
    let mut counts = [along(0), along(1), along(2)];
    let most = MOST.min(A_BODY * (reaches.len() + 1));
    while counts.iter().product::<usize>() > most {
        if let Some(largest) = counts.iter_mut().max() {
            *largest = largest.div_ceil(2);
        }
    }
    counts
}
