//! Where computed branches pass through third sheets.
//!
//! Most of a branch can lie where one of its two regions makes no difference: a younger body has taken the place, or
//! what the region divides is not there. Nothing is looked for on such stretches; they bound nothing.

use glam::DVec3;

use super::along::Along;
use super::bounds::Bounds;
use super::common::Common;
use super::crossings::{Crossing, MATCH, Settings, Triple};
use super::heights::Heights;
use super::hermite;
use super::pair::{Pair, Tolerances};
use super::pierce::{Piercing, Root, Segment, meets};
use super::region::Regions;

/// A curve of nearly parallel sheets is as near to both as it should be, and farther from its place by the sine of the angle between
/// them: by so many times its deviation …
const ASIDE: f64 = 8.0;
/// … and never by more than this fraction of the domain's size.
const FARTHEST: f64 = 1e-5;

/// Where a stretch is asked on which side of a region it is. It lies on one; but the side of open sheets may change
/// unseen where it does not matter, so more than one place is asked.
const PROBES: [f64; 3] = [0.4837, 0.0213, 0.9742];

/// The third sheets of one branch.
pub(super) struct Thirds<'a> {
    regions: &'a Regions,
    crossing: &'a Crossing,
    /// Its position among all.
    at: usize,
    tolerances: Tolerances,
    clip: Bounds,
    own: [usize; 2],
    segments: Vec<Segment>,
    /// Stretches where both regions may matter, in order.
    live: Vec<[f64; 2]>,
    /// A box that holds them.
    bounds: Bounds,
    pub(super) found: Vec<Triple>,
    /// Places that could not be decided.
    pub(super) undecided: usize,
}

impl<'a> Thirds<'a> {
    pub(super) fn of(
        regions: &'a Regions,
        crossings: &'a [Crossing],
        at: usize,
        Settings {
            tolerances, clip, ..
        }: Settings<'_>,
    ) -> Self {
        let crossing = &crossings[at];
        let branch = &crossing.branch;
        let segments: Vec<Segment> = (0..branch.pieces())
            .map(|piece| {
                let points = branch
                    .control(piece)
                    .map(|c| hermite::space(&c).extend(1.0));
                Segment::new(points, [branch.lengths[piece], branch.lengths[piece + 1]])
            })
            .collect();
        let live = vec![[0.0, branch.length()]];
        Self {
            regions,
            crossing,
            at,
            tolerances,
            clip,
            own: crossing.sheets.map(|sheet| regions.sheets[sheet].region),
            bounds: bounds(&segments, &live),
            segments,
            live,
            found: Vec::new(),
            undecided: 0,
        }
    }

    /// Looks for all of them: first the sheets of what hides the middle of the branch, then of what may hide some of it,
    /// then the others.
    pub(super) fn find(mut self) -> Self {
        let mut order: Vec<(u8, usize)> = Vec::new();
        for region in 0..self.regions.inside.len() {
            if self.own.contains(&region) {
                continue;
            }
            let may_hide = self.may_hide(region);
            if may_hide && self.is_hidden(region, &self.live[0], 1) {
                order.push((0, region));
            } else if self.sheets(region).next().is_some() {
                order.push((if may_hide { 1 } else { 2 }, region));
            }
        }
        order.sort_unstable();
        for (class, region) in order {
            // Less is left of the branch now.
            if class > 0 && self.sheets(region).next().is_none() {
                continue;
            }
            let cuts = self.pierce(region);
            if class < 2 {
                self.cut(region, &cuts);
            }
            if self.live.is_empty() {
                break;
            }
        }
        self
    }

    /// A region's sheets that the branch may pass through.
    fn sheets(&self, region: usize) -> impl Iterator<Item = usize> + use<'a> {
        let (regions, own, bounds) = (self.regions, self.crossing.sheets, self.bounds);
        let is_near = regions.bounds[region].meets(&bounds);
        let sheets = is_near.then(|| regions.sheets_of(region));
        sheets.into_iter().flatten().filter(move |sheet| {
            regions.sheets[*sheet].bounds().meets(&bounds) && regions.may_pierce(own, *sheet)
        })
    }

    /// Whether the branch may be hidden on one side of a region. Not if a sheet of it touches the branch's own: where it
    /// is passed on that contact is not looked for here.
    fn may_hide(&self, region: usize) -> bool {
        let regions = self.regions;
        let hides = |inside: bool| regions.relations.hides(region, inside, &self.own);
        let touches = |sheet: usize| {
            let own = self.crossing.sheets;
            own.iter().any(|own| regions.touch(*own, sheet))
        };
        (hides(false) || hides(true)) && !regions.sheets_of(region).any(touches)
    }

    /// Whether a stretch is hidden by a region wherever it is asked.
    fn is_hidden(&self, region: usize, stretch: &[f64; 2], probes: usize) -> bool {
        let [from, to] = *stretch;
        PROBES[..probes].iter().all(|fraction| {
            let point = self.crossing.branch.in_space(from + fraction * (to - from))[0];
            let inside = self.regions.inside[region].holds(point);
            self.regions.relations.hides(region, inside, &self.own)
        })
    }

    /// Looks for the points on a region's sheets; their places along the branch.
    fn pierce(&mut self, region: usize) -> Vec<f64> {
        let mut cuts = Vec::new();
        for sheet in self.sheets(region) {
            let other = &self.regions.sheets[sheet];
            let on_height = self
                .crossing
                .sheets
                .iter()
                .find_map(|own| Heights::of([&self.regions.sheets[*own], other]));
            let matters = |point: DVec3| {
                let mut own = self.own.iter();
                own.any(|own| self.regions.matter([*own, region], point))
            };
            let (roots, undecided) = if let Some(heights) = on_height {
                let found = Along::new(heights, self.tolerances, self.clip, &matters);
                let found = found.within(&self.segments, &self.live);
                (found.roots, found.undecided)
            } else {
                let clip = self.clip;
                let found = Piercing::new(&self.segments, other, self.tolerances, clip, &matters);
                let found = found.within(&self.live);
                (found.roots, found.undecided)
            };
            self.undecided += undecided;
            for root in roots {
                match self.refine(sheet, &root) {
                    Some(triple) => {
                        cuts.push(triple.t);
                        self.found.push(triple);
                    }
                    None => self.undecided += 1,
                }
            }
        }
        cuts
    }

    /// Cuts what is left of the branch where it passes through a region's sheets, and drops what the region hides.
    fn cut(&mut self, region: usize, cuts: &[f64]) {
        let mut stops = cuts.to_vec();
        stops.sort_unstable_by(f64::total_cmp);
        let mut live: Vec<[f64; 2]> = Vec::new();
        for [from, to] in std::mem::take(&mut self.live) {
            let inner = stops.iter().copied().filter(|t| from < *t && *t < to);
            let ends: Vec<f64> = std::iter::once(from)
                .chain(inner)
                .chain(std::iter::once(to))
                .collect();
            for pair in ends.windows(2) {
                let stretch = [pair[0], pair[1]];
                if self.is_hidden(region, &stretch, PROBES.len()) {
                    continue;
                }
                match live.last_mut() {
                    Some(last) if last[1] == stretch[0] => last[1] = stretch[1],
                    _ => live.push(stretch),
                }
            }
        }
        self.live = live;
        self.bounds = bounds(&self.segments, &self.live);
    }

    /// The common point of three sheets near a root of a computed branch, and its place on the branch.
    fn refine(&self, third: usize, root: &Root) -> Option<Triple> {
        let Self {
            regions,
            crossing,
            tolerances,
            ..
        } = self;
        let sheets = [crossing.sheets[0], crossing.sheets[1], third].map(|at| &regions.sheets[at]);
        let value = crossing.branch.value(root.t);
        let mut common = Common {
            sheets,
            q: [value[3], value[4], value[5], value[6], root.at.x, root.at.y],
        };
        let point = common.find(tolerances)?;
        let near = point.distance(root.point) < 1e-3 * tolerances.scale;
        let (t, distance) = crossing.branch.project(point);
        let [q @ .., _, _] = common.q;
        let triple = Triple {
            crossing: self.at,
            sheet: third,
            t,
            point,
            q,
        };
        let is_on = distance < MATCH * tolerances.scale || distance < self.beside(q);
        (near && is_on).then_some(triple)
    }

    /// How far the branch may be from its place, with these parameters on its sheets (m).
    fn beside(&self, q: [f64; 4]) -> f64 {
        let sheets = self.crossing.sheets.map(|at| &self.regions.sheets[at]);
        let Some(node) = Pair::new(sheets, self.tolerances).node(q, None) else {
            return 0.0;
        };
        let off = self.crossing.branch.deviation.max(self.tolerances.curve) / node.sine;
        (ASIDE * off).min(FARTHEST * self.tolerances.scale)
    }
}

/// A box that holds some stretches of a curve.
fn bounds(segments: &[Segment], stretches: &[[f64; 2]]) -> Bounds {
    let own = segments
        .iter()
        .filter(|segment| meets(segment.t, stretches));
    own.fold(Bounds::EMPTY, |all, segment| all.and(*segment.bounds()))
}
