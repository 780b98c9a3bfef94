//! What a well passes through: where its path crosses the surfaces of a realisation, and which volumes hold it between.
//!
//! Crossings come from geometry, names from the rules: the path is met with every sheet of every body and with the domain's skin
//! ([`crate::nurbs::meet`]), and between two meetings the point evaluator tells what holds the middle. Where that is the same on both sides
//! there was nothing to see, and both are one interval. So boundaries are exact to rounding, and no thin bed is missed.
//!
//! Where a path runs along a surface nearer than [`ALONG`] no side of it is told: it belongs to the youngest volume there. The evaluator is asked
//! at some places of each interval, too; what it says there has never differed, and if it did, the change would be found by halving, and counted.

use glam::DVec3;

use super::spec::WellSpec;
use crate::features::body::Role;
use crate::features::well::{EXACT, Well};
use crate::model::owner::Owners;
use crate::model::realisation::Realisation;
use crate::nurbs::meet::{Meetings, meetings};
use crate::nurbs::pierce::Target;
use crate::nurbs::{Surface, SurfaceError};

/// Distance (m) from a surface below which a path along it is on it.
pub const ALONG: f64 = 1e-6;
/// Intervals shorter than this (m) are kept, and flagged.
pub const THIN: f64 = 1e-3;
/// Places are the same within this fraction of the domain's diagonal.
const SAME: f64 = 1e-13;
/// Ranges in which a path cannot be told from a surface that are shorter than this (m) are touches: of a path with a radius of 5 km
/// that just touches, they are some millimetres.
const TOUCH: f64 = 0.1;
/// How near (m) the volumes lie that are named at a touch.
const BESIDE: f64 = 1e-5;
/// Places of each interval at which the evaluator is asked besides its middle: fractions that no symmetry prefers.
const ASKED: [f64; 5] = [0.043, 0.219, 0.5, 0.761, 0.968];
/// Places of a range along a surface at which it is asked.
const ASKED_ALONG: usize = 200;

/// A part of a well in one volume, or outside of the domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The volume; none outside of the domain.
    pub volume: Option<usize>,
    /// Measured depth of its ends (m).
    pub md: [f64; 2],
    /// Its ends.
    pub ends: [DVec3; 2],
}

impl Interval {
    /// Its length along the hole (m).
    pub fn length(&self) -> f64 {
        self.md[1] - self.md[0]
    }

    /// Whether it is so short that it may be a matter of rounding.
    pub fn is_thin(&self) -> bool {
        self.length() < THIN
    }
}

/// A place where a well leaves a volume for another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// Measured depth (m).
    pub md: f64,
    /// The place.
    pub point: DVec3,
    /// The volume above it, along the hole.
    pub from: Option<usize>,
    /// The volume below it.
    pub to: Option<usize>,
    /// The surfaces that it passes there: the volume whose body has it (none: the domain), and what it is of that.
    pub surfaces: Vec<(Option<usize>, &'static str)>,
}

/// A place where a well touches a surface between volumes and does not pass it.
#[derive(Clone, Debug, PartialEq)]
pub struct Touch {
    /// Measured depth (m).
    pub md: f64,
    /// The place.
    pub point: DVec3,
    /// The volumes that meet there.
    pub volumes: Vec<usize>,
}

/// All that a well passes through.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WellLog {
    /// From its head to its end; neighbours are of different volumes.
    pub intervals: Vec<Interval>,
    /// Between them.
    pub crossings: Vec<Crossing>,
    /// Where it touches.
    pub touches: Vec<Touch>,
    /// Ranges of measured depth in which it runs along a surface (m).
    pub along: Vec<[f64; 2]>,
    /// Changes that the evaluator knows and no surface shows; 0 unless something is wrong.
    pub unexplained: usize,
}

impl WellLog {
    /// The volume at a measured depth (m): at a boundary the one below it.
    pub fn at(&self, md: f64) -> Option<usize> {
        let below = self.intervals.partition_point(|one| one.md[1] <= md);
        let last = self.intervals.last().filter(|one| one.md[1] == md);
        self.intervals
            .get(below)
            .filter(|one| one.md[0] <= md)
            .or(last)?
            .volume
    }
}

/// A surface, and whose it is.
struct Sheet {
    /// None: the domain's.
    volume: Option<usize>,
    role: &'static str,
    surface: Surface,
    bounds: (DVec3, DVec3),
}

/// Finds what wells pass through, in one realisation.
pub struct Logger<'a> {
    owners: &'a Owners,
    realisation: &'a Realisation,
    sheets: Vec<Sheet>,
    /// Within this distance places are the same (m).
    near: f64,
}

/// What is known of a piece besides its ends.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Doubt {
    /// No surface comes near it between them.
    None,
    /// A surface is touched in it.
    Touch,
    /// It runs along a surface.
    Along,
}

/// A range of measured depth in which a path is too near to a surface to tell whether it passes.
struct Near {
    range: [f64; 2],
    sheet: usize,
}

/// A passage through a surface, by measured depth.
struct Passage {
    md: f64,
    sheet: usize,
}

impl<'a> Logger<'a> {
    /// Of a realisation and its evaluator.
    pub fn new(realisation: &'a Realisation, owners: &'a Owners) -> Result<Self, SurfaceError> {
        let mut sheets = Vec::new();
        for instance in &realisation.instances {
            for (role, surface) in instance.body.sheets()? {
                sheets.push(Sheet::new(Some(instance.volume), role.name(), surface));
            }
        }
        let extent = &realisation.extent;
        for (bound, name) in extent
            .bounds()
            .iter()
            .zip(["base of the domain", "top of the domain"])
        {
            let own = bound.iter().flat_map(|side| side.sheets());
            sheets.extend(own.map(|surface| Sheet::new(None, name, surface.clone())));
        }
        let (low, high) = (extent.low(), extent.high());
        for surface in walls(low, high)? {
            sheets.push(Sheet::new(None, "side of the domain", surface));
        }
        let reach = low.abs().max(high.abs()).max_element();
        Ok(Self {
            owners,
            realisation,
            sheets,
            near: SAME * low.distance(high) + 8.0 * f64::EPSILON * reach,
        })
    }

    /// What a well passes through.
    pub fn log(&self, well: &Well) -> WellLog {
        let (passages, near) = self.meetings(well);
        let undecided = joined(near.iter().map(|one| one.range).collect());
        let is_touch = |[from, to]: &[f64; 2]| to - from < TOUCH;
        let along: Vec<[f64; 2]> = undecided
            .iter()
            .copied()
            .filter(|range| !is_touch(range))
            .collect();
        let (first, last) = well.range();
        // Where something may change.
        let mut places: Vec<f64> = passages.iter().map(|one| one.md).collect();
        places.extend(undecided.iter().flatten());
        places.extend([first, last]);
        places.sort_by(f64::total_cmp);
        places.dedup_by(|later, kept| *later - *kept <= self.near);
        if let Some(end) = places.last_mut() {
            *end = last;
        }
        let mut pieces = Pieces::default();
        for pair in places.windows(2) {
            let middle = f64::midpoint(pair[0], pair[1]);
            let holds = |[from, to]: &[f64; 2]| *from <= middle && middle <= *to;
            let doubt = if along.iter().any(holds) {
                Doubt::Along
            } else if undecided.iter().any(holds) {
                Doubt::Touch
            } else {
                Doubt::None
            };
            self.pieces(well, [pair[0], pair[1]], doubt, &mut pieces);
        }
        let intervals = pieces.intervals(well);
        let crossings = self.crossings(&intervals, &passages, &near);
        let touches = undecided.iter().filter(|range| is_touch(range));
        WellLog {
            touches: touches
                .filter_map(|range| self.touch(well, *range, &crossings))
                .collect(),
            unexplained: pieces.unexplained,
            intervals,
            crossings,
            along,
        }
    }

    /// All passages, and the ranges of measured depth in which nothing is decided.
    fn meetings(&self, well: &Well) -> (Vec<Passage>, Vec<Near>) {
        let curve = well.curve();
        let (low, high) = hull(curve.points());
        let (mut passages, mut undecided) = (Vec::new(), Vec::new());
        for (at, sheet) in self.sheets.iter().enumerate() {
            let (from, to) = sheet.bounds;
            if !(low.cmple(to).all() && from.cmple(high).all()) {
                continue;
            }
            let Meetings {
                passages: through,
                undecided: ranges,
            } = meetings(curve, &Target::new(&sheet.surface), self.near);
            passages.extend(through.iter().map(|one| Passage {
                md: well.md(one.along),
                sheet: at,
            }));
            undecided.extend(ranges.iter().map(|range| Near {
                range: range.map(|u| well.md(u)),
                sheet: at,
            }));
        }
        passages.sort_by(|a, b| a.md.total_cmp(&b.md));
        (passages, undecided)
    }

    /// The volume at a place; of a path along a surface the youngest one beside it.
    fn owner(&self, point: DVec3, doubt: Doubt) -> Option<usize> {
        let beside = |distance: f64| {
            self.owners
                .locate(point, distance)
                .map(|location| location.owner)
        };
        let owner = match doubt {
            Doubt::None => self.owners.at(point),
            // On which side of a surface it is there is a matter of rounding.
            Doubt::Touch => beside(10.0 * self.near),
            Doubt::Along => beside(ALONG),
        };
        owner.map(|owner| self.realisation.rules.whole(owner))
    }

    /// The volumes between two places where something may change.
    fn pieces(&self, well: &Well, [from, to]: [f64; 2], doubt: Doubt, pieces: &mut Pieces) {
        let asked: Vec<f64> = if doubt == Doubt::Along {
            (0..ASKED_ALONG)
                .map(|k| (k as f64 + 0.5) / ASKED_ALONG as f64)
                .collect()
        } else {
            ASKED.to_vec()
        };
        let mut known: Option<(f64, Option<usize>)> = None;
        for part in asked {
            let md = from + (to - from) * part;
            let owner = self.owner(well.point(md), doubt);
            if let Some((last, before)) = known
                && before != owner
            {
                let change = self.change(well, [last, md], before, doubt);
                pieces.push(change, before);
                pieces.unexplained += usize::from(doubt == Doubt::None);
            }
            known = Some((md, owner));
        }
        if let Some((_, owner)) = known {
            pieces.push(to, owner);
        }
    }

    /// Where the volume changes between two measured depths, by halving.
    fn change(
        &self,
        well: &Well,
        [mut low, mut high]: [f64; 2],
        above: Option<usize>,
        doubt: Doubt,
    ) -> f64 {
        while high - low > self.near {
            let middle = f64::midpoint(low, high);
            if middle <= low || middle >= high {
                break;
            }
            if self.owner(well.point(middle), doubt) == above {
                low = middle;
            } else {
                high = middle;
            }
        }
        f64::midpoint(low, high)
    }

    fn crossings(
        &self,
        intervals: &[Interval],
        passages: &[Passage],
        near: &[Near],
    ) -> Vec<Crossing> {
        let between = intervals.windows(2).map(|pair| {
            let md = pair[0].md[1];
            // Depths follow from lengths, which are a little less exact than places.
            let same = 10.0 * EXACT + 10.0 * self.near;
            let through = passages
                .iter()
                .filter(|one| (one.md - md).abs() <= same)
                .map(|one| one.sheet);
            let beside = near
                .iter()
                .filter(|one| one.range[0] - same <= md && md <= one.range[1] + same);
            let sheets = through.chain(beside.map(|one| one.sheet));
            let mut surfaces: Vec<_> = sheets
                .map(|sheet| (self.sheets[sheet].volume, self.sheets[sheet].role))
                .collect();
            surfaces.dedup();
            Crossing {
                md,
                point: pair[0].ends[1],
                from: pair[0].volume,
                to: pair[1].volume,
                surfaces,
            }
        });
        between.collect()
    }

    /// A touch, if volumes meet there and the well does not go from one to another.
    fn touch(&self, well: &Well, [from, to]: [f64; 2], crossings: &[Crossing]) -> Option<Touch> {
        let md = f64::midpoint(from, to);
        let is_near = |one: &Crossing| one.md >= from - TOUCH && one.md <= to + TOUCH;
        if crossings.iter().any(is_near) {
            return None;
        }
        let point = well.point(md);
        let volumes = self.owners.locate(point, BESIDE)?.boundary;
        (volumes.len() > 1).then_some(Touch { md, point, volumes })
    }
}

impl WellSpec {
    /// What it passes through.
    pub fn log(&self, logger: &Logger<'_>) -> WellLog {
        logger.log(&self.well)
    }
}

impl Sheet {
    fn new(volume: Option<usize>, role: &'static str, surface: Surface) -> Self {
        Self {
            volume,
            role,
            bounds: hull(surface.net()),
            surface,
        }
    }
}

/// Where each piece ends, with its volume.
#[derive(Default)]
struct Pieces {
    ends: Vec<(f64, Option<usize>)>,
    unexplained: usize,
}

impl Pieces {
    /// Adds a piece, or makes the last one longer.
    fn push(&mut self, to: f64, owner: Option<usize>) {
        match self.ends.last_mut() {
            Some((end, last)) if *last == owner => *end = to,
            _ => self.ends.push((to, owner)),
        }
    }

    fn intervals(&self, well: &Well) -> Vec<Interval> {
        let mut from = well.range().0;
        let mut start = well.point(from);
        let piece = |(to, volume): &(f64, Option<usize>)| {
            let end = well.point(*to);
            let interval = Interval {
                volume: *volume,
                md: [from, *to],
                ends: [start, end],
            };
            (from, start) = (*to, end);
            interval
        };
        self.ends.iter().map(piece).collect()
    }
}

/// Ranges in order, those that overlap as one.
fn joined(mut ranges: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut joined: Vec<[f64; 2]> = Vec::with_capacity(ranges.len());
    for [from, to] in ranges {
        match joined.last_mut() {
            Some(last) if from <= last[1] => last[1] = last[1].max(to),
            _ => joined.push([from, to]),
        }
    }
    joined
}

fn hull(points: &[DVec3]) -> (DVec3, DVec3) {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points
        .iter()
        .fold(empty, |(low, high), p| (low.min(*p), high.max(*p)))
}

/// The six sides of a block, a little beyond its edges.
fn walls(low: DVec3, high: DVec3) -> Result<Vec<Surface>, SurfaceError> {
    let size = high - low;
    let (from, to) = (low - 0.01 * size, high + 0.01 * size);
    let mut walls = Vec::with_capacity(6);
    for axis in 0..3 {
        let (one, other) = ((axis + 1) % 3, (axis + 2) % 3);
        for level in [low[axis], high[axis]] {
            let corner = |a: f64, b: f64| {
                let mut p = DVec3::ZERO;
                p[axis] = level;
                p[one] = a;
                p[other] = b;
                p
            };
            walls.push(Surface::bilinear([
                corner(from[one], from[other]),
                corner(from[one], to[other]),
                corner(to[one], from[other]),
                corner(to[one], to[other]),
            ])?);
        }
    }
    Ok(walls)
}

/// Whether a role is one of a surface of the rock.
pub fn is_geological(role: &str) -> bool {
    ![Role::Start, Role::End, Role::Hidden]
        .iter()
        .any(|one| one.name() == role)
}
