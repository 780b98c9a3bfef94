//! Outlines of the areas of a label raster: from cells to smooth shared lines.
//!
//! The sides between cells of different labels are joined to chains that run from junction to junction; each chain is
//! smoothed (through the middles of its stairs) and simplified (Douglas & Peucker 1973) **once** and then used by the
//! areas on both of its sides, so that neighbouring areas still meet without gap or overlap. Coordinates are in cells,
//! x to the right and y down from the raster's upper left corner.
//!
//! Known limit: an area only one cell wide may lose up to half a cell on each side.

use std::collections::BTreeMap;

use glam::DVec2;

use super::figure::LabelRaster;

/// How far, in cells, a simplified chain may leave the smoothed chain.
const TOLERANCE: f64 = 0.3;

/// What lies on one side of a chain: `None` beyond the raster.
type Side = Option<u32>;
type Corner = (usize, usize);

/// A line between two labels; closed when its ends are equal.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chain {
    pub(super) points: Vec<DVec2>,
    /// The label to the left of the direction of travel (as seen on the page).
    pub(super) left: Side,
    pub(super) right: Side,
    start: Corner,
    end: Corner,
}

/// All outlines of a raster.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outlines {
    pub(super) chains: Vec<Chain>,
}

impl Outlines {
    pub(super) fn of(raster: &LabelRaster) -> Self {
        let mut tracer = Tracer::new(raster);
        let mut chains = Vec::new();
        let (w, h) = (raster.width, raster.height);
        for nodes_only in [true, false] {
            for y in 0..=h {
                for x in 0..=w {
                    let corner = (x, y);
                    if nodes_only && !tracer.is_node(corner) {
                        continue;
                    }
                    for heading in HEADINGS {
                        if tracer.is_open(corner, heading) {
                            chains.push(tracer.follow(corner, heading));
                        }
                    }
                }
            }
        }
        Self { chains }
    }

    /// The closed loops that bound each label's area, to be filled by the even-odd rule.
    pub(super) fn areas(&self) -> BTreeMap<u32, Vec<Vec<DVec2>>> {
        // For each label its chains, directed so that the area is on the left, by where they start.
        let mut starts: BTreeMap<u32, BTreeMap<Corner, Vec<(usize, Direction)>>> = BTreeMap::new();
        for (i, chain) in self.chains.iter().enumerate() {
            let sides = [
                (chain.left, chain.start, Direction::Forward),
                (chain.right, chain.end, Direction::Backward),
            ];
            for (side, start, direction) in sides {
                if let Some(label) = side.filter(|&label| label != LabelRaster::NONE) {
                    let at = starts.entry(label).or_default().entry(start).or_default();
                    at.push((i, direction));
                }
            }
        }
        let mut areas = BTreeMap::new();
        for (label, mut chains) in starts {
            let mut loops = Vec::new();
            while let Some((&first, _)) = chains.iter().next() {
                let mut points = Vec::new();
                let mut at = first;
                // Each junction is left as often as it is reached, so the walk ends where it began.
                while let Some(here) = chains.get_mut(&at) {
                    let next = here.pop();
                    if here.is_empty() {
                        chains.remove(&at);
                    }
                    let Some((i, direction)) = next else { break };
                    let chain = &self.chains[i];
                    let forward = chain.points.iter().copied();
                    match direction {
                        Direction::Forward => points.extend(forward),
                        Direction::Backward => points.extend(forward.rev()),
                    }
                    at = match direction {
                        Direction::Forward => chain.end,
                        Direction::Backward => chain.start,
                    };
                    if at == first {
                        break;
                    }
                }
                points.dedup();
                loops.push(points);
            }
            areas.insert(label, loops);
        }
        areas
    }
}

#[derive(Debug, Clone, Copy)]
enum Direction {
    Forward,
    Backward,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Heading {
    East,
    South,
    West,
    North,
}

const HEADINGS: [Heading; 4] = [Heading::East, Heading::South, Heading::West, Heading::North];

struct Tracer<'a> {
    raster: &'a LabelRaster,
    /// For each corner whether the side to its east and the side to its south still wait to be traced.
    waiting: Vec<[bool; 2]>,
}

impl<'a> Tracer<'a> {
    fn new(raster: &'a LabelRaster) -> Self {
        let mut tracer = Self {
            raster,
            waiting: vec![[false; 2]; (raster.width + 1) * (raster.height + 1)],
        };
        for y in 0..=raster.height {
            for x in 0..=raster.width {
                let at = y * (raster.width + 1) + x;
                for (i, heading) in [Heading::East, Heading::South].into_iter().enumerate() {
                    tracer.waiting[at][i] = tracer.separates((x, y), heading);
                }
            }
        }
        tracer
    }

    fn cell(&self, x: Option<usize>, y: Option<usize>) -> Side {
        let (x, y) = (x?, y?);
        (x < self.raster.width && y < self.raster.height)
            .then(|| self.raster.cells[y * self.raster.width + x])
    }

    /// The labels to the left and right of the side that leaves a corner.
    fn sides(&self, (x, y): Corner, heading: Heading) -> (Side, Side) {
        let (east, south) = (Some(x), Some(y));
        let (west, north) = (x.checked_sub(1), y.checked_sub(1));
        match heading {
            Heading::East => (self.cell(east, north), self.cell(east, south)),
            Heading::South => (self.cell(east, south), self.cell(west, south)),
            Heading::West => (self.cell(west, south), self.cell(west, north)),
            Heading::North => (self.cell(west, north), self.cell(east, north)),
        }
    }

    fn separates(&self, corner: Corner, heading: Heading) -> bool {
        let (left, right) = self.sides(corner, heading);
        left != right
    }

    /// Chains begin and end at junctions, and at the raster's own corners, which stay sharp.
    fn is_node(&self, corner: Corner) -> bool {
        let (x, y) = corner;
        let at_corner = (x == 0 || x == self.raster.width) && (y == 0 || y == self.raster.height);
        let sides = HEADINGS
            .iter()
            .filter(|&&heading| self.separates(corner, heading))
            .count();
        at_corner || (sides != 0 && sides != 2)
    }

    fn slot(&self, (x, y): Corner, heading: Heading) -> Option<(usize, usize)> {
        let (x, y, side) = match heading {
            Heading::East => (x, y, 0),
            Heading::South => (x, y, 1),
            Heading::West => (x.checked_sub(1)?, y, 0),
            Heading::North => (x, y.checked_sub(1)?, 1),
        };
        Some((y * (self.raster.width + 1) + x, side))
    }

    fn is_open(&self, corner: Corner, heading: Heading) -> bool {
        self.slot(corner, heading)
            .is_some_and(|(at, side)| self.waiting[at][side])
    }

    fn follow(&mut self, start: Corner, heading: Heading) -> Chain {
        let (left, right) = self.sides(start, heading);
        let mut corners = vec![start];
        let (mut at, mut heading) = (start, heading);
        loop {
            if let Some((slot, side)) = self.slot(at, heading) {
                self.waiting[slot][side] = false;
            }
            at = match heading {
                Heading::East => (at.0 + 1, at.1),
                Heading::South => (at.0, at.1 + 1),
                Heading::West => (at.0 - 1, at.1),
                Heading::North => (at.0, at.1 - 1),
            };
            corners.push(at);
            let onward = HEADINGS.into_iter().find(|&next| self.is_open(at, next));
            match onward {
                Some(next) if !self.is_node(at) => heading = next,
                _ => break,
            }
        }
        Chain {
            points: smooth(&corners),
            left,
            right,
            start,
            end: at,
        }
    }
}

/// A straight part of a chain.
#[derive(Clone, Copy)]
struct Run {
    start: DVec2,
    direction: DVec2,
    length: f64,
}

impl Run {
    fn at(&self, distance: f64) -> DVec2 {
        self.start + self.direction * distance
    }
}

fn exact(&(x, y): &Corner) -> DVec2 {
    DVec2::new(x as f64, y as f64)
}

fn runs(corners: &[Corner]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for pair in corners.windows(2) {
        let (start, end) = (exact(&pair[0]), exact(&pair[1]));
        match runs.last_mut() {
            Some(run) if run.direction == end - start => run.length += 1.0,
            _ => runs.push(Run {
                start,
                direction: end - start,
                length: 1.0,
            }),
        }
    }
    runs
}

/// A digitised slant is a staircase of runs whose **middles** lie on the slant; a run that is no stair keeps its ends,
/// bevelled by half a cell.
fn smooth(corners: &[Corner]) -> Vec<DVec2> {
    let runs = runs(corners);
    // Too short to tell a stair from a corner: left as it is, so that the area of a single cell survives.
    if corners.len() <= 5 {
        return corners.iter().map(exact).collect();
    }
    let closed = corners[0] == corners[corners.len() - 1];
    let last = runs.len() - 1;
    let mut points = Vec::new();
    for (i, run) in runs.iter().enumerate() {
        let before = (i > 0 || closed).then(|| runs[(i + last) % runs.len()]);
        let after = (i < last || closed).then(|| runs[(i + 1) % runs.len()]);
        let is_step = |other: Run| other.length == 1.0 || run.length == 1.0;
        match (before, after) {
            (Some(before), Some(after)) => {
                let turns = before.direction.perp_dot(run.direction)
                    * run.direction.perp_dot(after.direction);
                if run.length == 1.0 || (turns < 0.0 && is_step(before) && is_step(after)) {
                    points.push(run.at(run.length / 2.0));
                } else {
                    points.extend([run.at(0.5), run.at(run.length - 0.5)]);
                }
            }
            (None, after) => {
                points.push(run.start);
                if after.is_some_and(|after| !is_step(after)) {
                    points.push(run.at(run.length - 0.5));
                }
            }
            (Some(before), None) => {
                if !is_step(before) {
                    points.push(run.at(0.5));
                }
            }
        }
    }
    if !closed {
        points.push(runs[last].at(runs[last].length));
        return simplified(&points, TOLERANCE);
    }
    let far = (0..points.len())
        .max_by(|&a, &b| {
            let distance = |i: usize| points[i].distance_squared(points[0]);
            distance(a).total_cmp(&distance(b))
        })
        .unwrap_or(0);
    let mut ring = simplified(&points[..=far], TOLERANCE);
    let back: Vec<DVec2> = points[far..].iter().copied().chain([points[0]]).collect();
    ring.extend(simplified(&back, TOLERANCE).into_iter().skip(1));
    ring
}

/// Douglas & Peucker's simplification, with a stack instead of recursion.
fn simplified(points: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[points.len() - 1] = true;
    let mut stack = vec![(0, points.len() - 1)];
    while let Some((a, b)) = stack.pop() {
        let chord = points[b] - points[a];
        let mut farthest = (tolerance, None);
        for i in a + 1..b {
            let from = points[i] - points[a];
            // To the segment rather than to its line, so that spikes survive.
            let along = from.dot(chord) / chord.length_squared().max(f64::MIN_POSITIVE);
            let distance = (from - chord * along.clamp(0.0, 1.0)).length();
            if distance > farthest.0 {
                farthest = (distance, Some(i));
            }
        }
        if let (_, Some(i)) = farthest {
            keep[i] = true;
            stack.push((a, i));
            stack.push((i, b));
        }
    }
    let kept = points.iter().zip(keep).filter(|(_, keep)| *keep);
    kept.map(|(point, _)| *point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raster(rows: &[&str]) -> LabelRaster {
        LabelRaster {
            width: rows[0].len(),
            height: rows.len(),
            cells: rows
                .iter()
                .flat_map(|row| row.bytes())
                .map(|c| {
                    if c == b'.' {
                        LabelRaster::NONE
                    } else {
                        u32::from(c - b'a')
                    }
                })
                .collect(),
        }
    }

    fn area(loops: &[Vec<DVec2>]) -> f64 {
        // On the page (y down) a loop with its area on the left has a negative shoelace sum; holes a positive one.
        let twice: f64 = loops
            .iter()
            .flat_map(|ring| (0..ring.len()).map(|i| ring[i].perp_dot(ring[(i + 1) % ring.len()])))
            .sum();
        -twice / 2.0
    }

    #[test]
    fn areas_partition_the_raster() {
        let raster = raster(&["aabbb", "aacbb", "aaabb", "ab.bb", "aaabb"]);
        let areas = Outlines::of(&raster).areas();
        assert_eq!(areas.keys().copied().collect::<Vec<_>>(), [0, 1, 2]);
        let sum: f64 = areas.values().map(|loops| area(loops)).sum();
        // Everything but the one cell of nobody, which keeps between 0 and 1 cell.
        assert!((24.0..=25.0).contains(&sum), "{sum}");
        assert!(areas.values().all(|loops| area(loops) > 0.0));
    }

    #[test]
    fn the_stairs_of_a_straight_slope_become_nearly_straight() {
        let (w, h) = (200, 60);
        let cells = (0..h)
            .flat_map(|y| (0..w).map(move |x| u32::from(4 * y > x)))
            .collect();
        let outlines = Outlines::of(&LabelRaster {
            width: w,
            height: h,
            cells,
        });
        let inner: Vec<_> = outlines
            .chains
            .iter()
            .filter(|chain| chain.left.is_some() && chain.right.is_some())
            .collect();
        assert_eq!(inner.len(), 1);
        let points = &inner[0].points;
        assert!(points.len() < 6, "of some 250 sides: {points:?}");
        for p in points {
            // The raster's half cell; labels change where 4 y' = x' at the middles of the cells.
            assert!((p.y - 0.5 - (p.x - 0.5) / 4.0).abs() < 0.8, "{p}");
        }
    }

    #[test]
    fn a_disc_keeps_its_area_and_its_hole() {
        let (w, h) = (101, 101);
        let cells = (0..h)
            .flat_map(|y| {
                (0..w).map(move |x| {
                    let r = (f64::from(x) - 50.0).hypot(f64::from(y) - 50.0);
                    u32::from(r < 40.0) + u32::from(r < 10.0)
                })
            })
            .collect();
        let areas = Outlines::of(&LabelRaster {
            width: 101,
            height: 101,
            cells,
        })
        .areas();
        let pi = std::f64::consts::PI;
        // Half a cell along the outline is the most that a raster can tell.
        assert!((area(&areas[&1]) - pi * (1600.0 - 100.0)).abs() < 60.0);
        assert!((area(&areas[&2]) - pi * 100.0).abs() < 20.0);
        assert_eq!(areas[&1].len(), 2, "the outer rim and the hole");
    }

    #[test]
    fn diagonal_neighbours_of_one_label_close_their_loops() {
        let areas = Outlines::of(&raster(&["ab", "ba"])).areas();
        assert!((area(&areas[&0]) - 2.0).abs() < 1e-9);
        assert!((area(&areas[&1]) - 2.0).abs() < 1e-9);
    }
}
