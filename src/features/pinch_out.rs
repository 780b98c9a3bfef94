//! Pinch-outs: where measured thicknesses are nothing over an area, and how a thickness goes on there.
//!
//! A spline through thicknesses of 0 swings about 0, so two horizons that are equal over an area would cross again and
//! again. Where data say 0 nobody asks how far the younger one lies below the older one: there the thickness goes below 0,
//! with the slope that it has beside the area. Then it crosses 0 once, at an angle, between the last node with a thickness
//! and the first one without:
//!
//! ```text
//!  thickness ●                           ring 1, 2: the slope goes on,
//!                ●                       and on for some rings, then each time half of it
//!      0  ───────────╲○─────○─────○──    given
//!                     ╲
//!                       ○───__○_____○    continued
//! ```

use glam::{DVec2, DVec3};

use super::horizon::{Horizon, HorizonError};

/// How far below 0 the first node without a thickness lies at least, as a share of the thickness beside it: the zero line
/// then passes between nodes, not through them, 1/1000 of the way at most.
const BELOW: f64 = 1e-3;
/// Rings of nodes around which the slope goes on as it is; then it is halved from ring to ring.
const STRAIGHT: usize = 4;

/// How many times finer nodes are tried for a thickness that ends, and how many nodes that may be.
const FINER: [usize; 4] = [8, 4, 3, 2];
const MOST_NODES: usize = 20_000;

/// The nodes of a grid: node i along x and j along y is entry `i * counts[1] + j` of a list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nodes {
    /// The first node.
    pub low: DVec2,
    /// The last node.
    pub high: DVec2,
    /// How many there are along x and along y.
    pub counts: [usize; 2],
}

/// The nodes at which there is nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Absence {
    counts: [usize; 2],
    is_absent: Vec<bool>,
}

/// Where there is nothing, and how much of the data was given up for that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Lower corner of a box in plan that holds the cells.
    pub low: DVec2,
    /// Upper corner.
    pub high: DVec2,
    /// The area of the cells (m²).
    pub area: f64,
    /// The volume of the thicknesses there, whatever their signs (m³).
    pub volume: f64,
}

impl Nodes {
    /// The place of an entry.
    pub fn place(&self, entry: usize) -> DVec2 {
        let [nx, ny] = self.counts;
        let part = |k: usize, count: usize| k as f64 / (count - 1) as f64;
        let at = DVec2::new(part(entry / ny, nx), part(entry % ny, ny));
        self.low + (self.high - self.low) * at
    }

    /// A function's values at the nodes.
    pub fn sample(&self, f: impl Fn(DVec2) -> f64) -> Vec<f64> {
        let entries = 0..self.counts[0] * self.counts[1];
        entries.map(|entry| f(self.place(entry))).collect()
    }

    /// A function where it is above 0, and about 0 elsewhere: through ever finer nodes that hold these, as many as are not too
    /// many, so that it swings the less where the function crosses 0. `None` if these are too many already.
    pub fn clamped(&self, function: &Horizon) -> Result<Option<Horizon>, HorizonError> {
        let fits =
            |times: &usize| self.finer(*times).counts.iter().product::<usize>() <= MOST_NODES;
        let Some(times) = FINER.into_iter().find(fits) else {
            return Ok(None);
        };
        let nodes = self.finer(times);
        let values = nodes.sample(|at| function.height(at.x, at.y).max(0.0));
        nodes.interpolated(&values).map(Some)
    }

    /// By how much a clamped function is off where the function is above 0, or about 0.
    pub fn swing(&self, clamped: &Horizon, function: &Horizon) -> f64 {
        let fits =
            |times: &usize| self.finer(*times).counts.iter().product::<usize>() <= MOST_NODES;
        let times = FINER.into_iter().find(fits).unwrap_or(1);
        // Twice as fine: in the middle between the nodes of the one that is clamped.
        let off = self
            .finer(2 * times)
            .sample(|at| clamped.height(at.x, at.y) - function.height(at.x, at.y).max(0.0));
        off.iter().fold(0.0, |most, off| most.max(off.abs()))
    }

    /// These and others between them, so that all are no farther from each other than a spacing (m), or as many as are not too
    /// many.
    #[must_use]
    pub fn as_fine_as(&self, spacing: f64) -> Self {
        let mut nodes = *self;
        loop {
            let step = (nodes.high - nodes.low) / DVec2::from(nodes.counts.map(|n| (n - 1) as f64));
            let finer = nodes.finer(2);
            let is_fine = step.max_element() <= spacing;
            if is_fine || finer.counts.iter().product::<usize>() > MOST_NODES {
                return nodes;
            }
            nodes = finer;
        }
    }

    fn finer(&self, times: usize) -> Self {
        Self {
            counts: self.counts.map(|count| (count - 1) * times + 1),
            ..*self
        }
    }

    /// The function with these values at the nodes.
    pub fn interpolated(&self, values: &[f64]) -> Result<Horizon, HorizonError> {
        let [nx, ny] = self.counts;
        let rows: Vec<Vec<f64>> = (0..ny)
            .map(|j| (0..nx).map(|i| values[i * ny + j]).collect())
            .collect();
        let (x, y) = ([self.low.x, self.high.x], [self.low.y, self.high.y]);
        Horizon::grid(x, y, &rows)
    }
}

/// A mean of some values.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1.0;
    }

    fn value(self) -> Option<f64> {
        (self.count > 0.0).then(|| self.sum / self.count)
    }
}

/// The entries around one, with how far they are along x and y; those that are on the grid.
fn around(entry: usize, counts: [usize; 2]) -> impl Iterator<Item = (usize, [isize; 2])> {
    const STEPS: [[isize; 2]; 8] = [
        [-1, -1],
        [-1, 0],
        [-1, 1],
        [0, -1],
        [0, 1],
        [1, -1],
        [1, 0],
        [1, 1],
    ];
    STEPS
        .into_iter()
        .filter_map(move |step| Some((beside(entry, step, counts)?, step)))
}

/// The entry a step away, if it is on the grid.
fn beside(entry: usize, step: [isize; 2], [nx, ny]: [usize; 2]) -> Option<usize> {
    let i = (entry / ny).checked_add_signed(step[0])?;
    let j = (entry % ny).checked_add_signed(step[1])?;
    (i < nx && j < ny).then_some(i * ny + j)
}

impl Absence {
    /// The nodes at which a thickness is no more than `least`, of an area: of those that hang together, some lie at all four
    /// corners of a cell. A node or a row of nodes alone is a touch.
    pub fn over_areas(thickness: &[f64], counts: [usize; 2], least: f64) -> Self {
        let [nx, ny] = counts;
        let is_nothing: Vec<bool> = thickness.iter().map(|t| t.abs() <= least).collect();
        let mut is_absent = vec![false; thickness.len()];
        let mut reached = Vec::new();
        for i in 0..nx - 1 {
            for j in 0..ny - 1 {
                let first = i * ny + j;
                let cell = [first, first + 1, first + ny, first + ny + 1];
                if cell.iter().all(|entry| is_nothing[*entry]) {
                    reached.extend(cell.iter().filter(|entry| !is_absent[**entry]));
                    for entry in cell {
                        is_absent[entry] = true;
                    }
                }
            }
        }
        while let Some(entry) = reached.pop() {
            for (other, _) in around(entry, counts) {
                if is_nothing[other] && !is_absent[other] {
                    is_absent[other] = true;
                    reached.push(other);
                }
            }
        }
        Self { counts, is_absent }
    }

    /// All nodes at which a thickness is no more than `least`.
    pub fn at_nodes(thickness: &[f64], counts: [usize; 2], least: f64) -> Self {
        let is_absent = thickness.iter().map(|t| *t <= least).collect();
        Self { counts, is_absent }
    }

    /// Whether there is something everywhere.
    pub fn is_empty(&self) -> bool {
        !self.is_absent.contains(&true)
    }

    /// Whether there is nothing anywhere.
    pub fn is_all(&self) -> bool {
        !self.is_absent.contains(&false)
    }

    /// Whether there is nothing at a node.
    pub fn at(&self, entry: usize) -> bool {
        self.is_absent[entry]
    }

    /// The same without some of the nodes.
    #[must_use]
    pub fn without(&self, is_left_out: impl Fn(usize) -> bool) -> Self {
        let own = self.is_absent.iter().enumerate();
        Self {
            counts: self.counts,
            is_absent: own
                .map(|(entry, absent)| *absent && !is_left_out(entry))
                .collect(),
        }
    }

    /// The thicknesses, continued below 0 where there is nothing, by no less than a depth.
    pub fn continued(&self, thickness: &[f64], depth: f64) -> Vec<f64> {
        let mut values = thickness.to_vec();
        let mut is_known: Vec<bool> = self.is_absent.iter().map(|absent| !absent).collect();
        let mut left: Vec<usize> = (0..values.len()).filter(|at| !is_known[*at]).collect();
        for ring in 1.. {
            let found: Vec<(usize, f64)> = left
                .iter()
                .filter_map(|at| Some((*at, self.next(*at, &values, &is_known, ring)?.min(-depth))))
                .collect();
            if found.is_empty() {
                break;
            }
            for (at, value) in found {
                values[at] = value;
                is_known[at] = true;
            }
            left.retain(|at| !is_known[*at]);
        }
        for at in left {
            values[at] = -depth;
        }
        values
    }

    /// The value of a node beside known ones: the mean of what the slopes towards it lead to, where any are known.
    fn next(&self, entry: usize, values: &[f64], is_known: &[bool], ring: usize) -> Option<f64> {
        let mut slower = 1.0;
        for _ in STRAIGHT..ring {
            slower *= 0.5;
        }
        let mut thickest: f64 = 0.0;
        let mut steepest = f64::INFINITY;
        let mut sloping = Mean::default();
        let mut level = Mean::default();
        for (near, step) in around(entry, self.counts).filter(|(near, _)| is_known[*near]) {
            thickest = thickest.max(values[near]);
            level.add(values[near]);
            if let Some(far) = beside(near, step, self.counts).filter(|far| is_known[*far]) {
                let fall = (values[far] - values[near]).max(0.0);
                let continued = values[near] - slower * fall;
                steepest = steepest.min(continued);
                sloping.add(continued);
            }
        }
        let mut mean = sloping.value().or_else(|| level.value())?;
        if ring == 2 {
            // Behind the line it falls as steeply as before it, or it would run along 0.
            mean = mean.min(steepest);
        }
        Some(mean.min(-BELOW * thickest))
    }

    /// How rough heights are in the area and around it: the sum of the squares of their second differences.
    pub fn roughness(&self, heights: &[f64]) -> f64 {
        let near = |entry: usize| {
            self.is_absent[entry]
                || around(entry, self.counts).any(|(near, _)| self.is_absent[near])
        };
        let bend = |entry: usize, step: [isize; 2]| {
            let before = beside(entry, step.map(|k| -k), self.counts);
            let after = beside(entry, step, self.counts);
            before.zip(after).map_or(0.0, |(before, after)| {
                (heights[before] - 2.0 * heights[entry] + heights[after]).powi(2)
            })
        };
        (0..heights.len())
            .filter(|entry| near(*entry))
            .map(|entry| bend(entry, [1, 0]) + bend(entry, [0, 1]))
            .sum()
    }

    /// Where within a plan there is nothing at all corners of a cell, and what the thicknesses there sum up to.
    pub fn extent(&self, nodes: &Nodes, thickness: &[f64], [low, high]: [DVec2; 2]) -> Extent {
        let [nx, ny] = self.counts;
        let mut extent = Extent {
            low: DVec2::INFINITY,
            high: DVec2::NEG_INFINITY,
            area: 0.0,
            volume: 0.0,
        };
        for first in (0..nx - 1).flat_map(|i| (0..ny - 1).map(move |j| i * ny + j)) {
            let corners = [first, first + 1, first + ny, first + ny + 1];
            let from = nodes.place(first).max(low);
            let to = nodes.place(first + ny + 1).min(high);
            let area = (to - from).max(DVec2::ZERO).element_product();
            if area > 0.0 && corners.iter().all(|corner| self.is_absent[*corner]) {
                let mean = corners
                    .iter()
                    .map(|corner| thickness[*corner].abs())
                    .sum::<f64>()
                    / 4.0;
                extent.low = extent.low.min(from);
                extent.high = extent.high.max(to);
                extent.area += area;
                extent.volume += area * mean;
            }
        }
        extent
    }
}

/// A thickness near scattered points, of which those without any say only that there is nothing: it goes below 0 there as
/// those with a thickness say by themselves, but by no more than the greatest of these.
pub fn continued_points(
    points: &[[f64; 3]],
    least: f64,
    given: &Horizon,
    fit: &dyn Fn(&[DVec3]) -> Result<Horizon, HorizonError>,
) -> Result<Horizon, HorizonError> {
    let points: Vec<DVec3> = points
        .iter()
        .map(|point| DVec3::from_array(*point))
        .collect();
    let (thick, none): (Vec<DVec3>, Vec<DVec3>) =
        points.into_iter().partition(|point| point.z > least);
    if none.is_empty() || thick.is_empty() {
        return Ok(given.clone());
    }
    let thickest = thick.iter().map(|point| point.z).fold(0.0, f64::max);
    let by_themselves = fit(&thick)?;
    let below = none.iter().map(|point| {
        let continued = by_themselves.height(point.x, point.y);
        point.with_z(continued.clamp(-thickest, -BELOW * thickest))
    });
    let all: Vec<DVec3> = thick.iter().copied().chain(below).collect();
    fit(&all)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    /// Thicknesses along x, the same in three rows.
    fn along(values: &[f64]) -> Vec<f64> {
        values.iter().flat_map(|value| [*value; 3]).collect()
    }

    fn nodes(columns: usize) -> Nodes {
        Nodes {
            low: DVec2::ZERO,
            high: DVec2::new(100.0 * (columns - 1) as f64, 200.0),
            counts: [columns, 3],
        }
    }

    #[test]
    fn a_straight_wedge_goes_on_straight_through_the_first_node_without_a_thickness() {
        let given = along(&[20.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let nodes = nodes(7);
        let absence = Absence::over_areas(&given, nodes.counts, 1e-6);
        let continued = absence.continued(&given, 1e-6);
        let middle: Vec<f64> = continued.iter().skip(1).step_by(3).copied().collect();
        assert_eq!(&middle[..2], [20.0, 10.0]);
        assert!((middle[2] + 0.01).abs() < 1e-12, "{middle:?}");
        for (ring, fall) in [(3, 10.01), (4, 10.01), (5, 10.01), (6, 5.0)] {
            let own = middle[ring - 1] - middle[ring];
            assert!((own - fall).abs() < 0.02, "{middle:?}");
        }
        // The spline through that is above 0 up to the first node without a thickness, and nowhere after.
        let spline = nodes.interpolated(&continued).unwrap();
        for k in 0..6000 {
            let x = 0.1 * f64::from(k);
            // The line lies 1/1001 of the way from the node, or a hair beside that.
            if (x - 199.9).abs() > 0.15 {
                assert_eq!(spline.height(x, 70.0) > 0.0, x < 199.9, "at {x}");
            }
        }
    }

    #[test]
    fn whatever_the_thicknesses_the_spline_is_not_above_nothing_at_and_beyond_the_first_node_without()
     {
        for edge in [[20.0, 19.9], [5.0, 12.0], [100.0, 0.01], [0.0, 7.0]] {
            let given = along(&[edge[0], edge[1], 0.0, 0.0, 0.0, 0.0]);
            let nodes = nodes(6);
            let absence = Absence::at_nodes(&given, nodes.counts, 1e-6);
            let spline = nodes
                .interpolated(&absence.continued(&given, 1e-6))
                .unwrap();
            for k in 0..=3000 {
                let x = 200.0 + 0.1 * f64::from(k);
                assert!(spline.height(x, 100.0) < 0.0, "{edge:?} at {x}");
            }
            assert!((spline.height(100.0, 100.0) - edge[1]).abs() < 1e-9);
        }
    }

    #[test]
    fn a_clamped_thickness_is_itself_where_there_is_one_and_about_nothing_elsewhere() {
        let given = along(&[20.0, 10.0, 0.0, 0.0, 0.0]);
        let nodes = nodes(5);
        let absence = Absence::at_nodes(&given, nodes.counts, 0.0);
        let continued = nodes.interpolated(&absence.continued(&given, 0.0)).unwrap();
        let clamped = nodes.clamped(&continued).unwrap().unwrap();
        let sum: f64 = (0..4000)
            .map(|k| {
                let x = 0.1 * (f64::from(k) + 0.5);
                let right = (20.0 - x / 10.0).max(0.0);
                // A spline through nodes 12.5 m apart swings by a tenth of what it falls between them.
                assert!((clamped.height(x, 50.0) - right).abs() < 0.15, "at {x}");
                0.1 * clamped.height(x, 50.0)
            })
            .sum();
        assert!((sum / 2000.0 - 1.0).abs() < 2e-3, "{sum}");
        let many = Nodes {
            counts: [200, 200],
            ..nodes
        };
        assert!(many.clamped(&continued).unwrap().is_none());
    }

    #[test]
    fn an_area_has_a_cell_a_node_or_a_row_alone_is_a_touch() {
        let row = along(&[3.0, 0.0, 2.0, 1.0]);
        assert!(Absence::over_areas(&row, [4, 3], 0.0).is_empty());
        assert!(!Absence::at_nodes(&row, [4, 3], 0.0).is_empty());
        // A cell, and a node that hangs on to it.
        let mut given = along(&[3.0, 4.0, 5.0, 6.0]);
        for entry in [0, 1, 3, 4, 8] {
            given[entry] = 1e-3;
        }
        let absence = Absence::over_areas(&given, [4, 3], 1e-2);
        let found: Vec<usize> = (0..12).filter(|entry| absence.at(*entry)).collect();
        assert_eq!(found, [0, 1, 3, 4, 8]);
    }

    #[test]
    fn the_extent_is_that_of_the_cells_within_the_plan() {
        let given = along(&[2.0, 0.5, 0.5, 0.5]);
        let nodes = nodes(4);
        let absence = Absence::at_nodes(&given, nodes.counts, 0.5);
        let plan = [DVec2::ZERO, DVec2::new(220.0, 150.0)];
        let extent = absence.extent(&nodes, &given, plan);
        assert!((extent.area - 120.0 * 150.0).abs() < 1e-9, "{extent:?}");
        assert!((extent.volume - 0.5 * extent.area).abs() < 1e-9);
        assert_eq!((extent.low, extent.high), (DVec2::new(100.0, 0.0), plan[1]));
    }

    #[test]
    fn what_bends_is_rougher_than_what_does_not() {
        let kinked = along(&[20.0, 10.0, 0.0, 0.0, 0.0]);
        let absence = Absence::over_areas(&kinked, [5, 3], 0.0);
        assert!(absence.roughness(&kinked) > 0.0);
        assert_eq!(absence.roughness(&along(&[4.0, 3.0, 2.0, 1.0, 0.0])), 0.0);
    }
}
