//! Crossings: where edges pass through sheets, where sheets cross each other, and where three sheets meet.
//!
//! The roots of edges come first, by halving, on their own. Branches are then followed from every root, and
//! must end at roots; what is left to find are branches that close, or that come in from outside. A root is
//! used exactly once from each sheet of its edge: a check that needs no reference.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::Certificates;
use super::along::Along;
use super::bounds::Bounds;
use super::check::{Doubt, Faults};
use super::contours::Contours;
use super::heights::Heights;
use super::hermite::{Branch, End, Node};
use super::march::{March, Stop};
use super::pair::{Pair, Tolerances};
use super::pierce::{Piercing, Root};
use super::region::Regions;
use super::seeds::Search;
use super::sheet::Border;
use super::touch::Touches;
use super::triples::Thirds;

/// An edge passing through a sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeRoot {
    pub(super) edge: usize,
    pub(super) sheet: usize,
    /// The sheet's border, if it lies on that: where two landings cross.
    pub(super) corner: Option<Border>,
    pub(super) root: Root,
}

/// A branch with its two sheets.
#[derive(Clone, Debug)]
pub(super) struct Crossing {
    pub(super) sheets: [usize; 2],
    pub(super) branch: Branch,
}

/// A branch passing through a third sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triple {
    pub(super) crossing: usize,
    pub(super) sheet: usize,
    pub(super) t: f64,
    pub(super) point: DVec3,
    /// Parameters on the branch's sheets.
    pub(super) q: [f64; 4],
}

/// Everything that was found.
#[derive(Debug)]
pub(super) struct Crossings {
    pub(super) roots: Vec<EdgeRoot>,
    pub(super) curves: Vec<Crossing>,
    pub(super) triples: Vec<Triple>,
    /// Regions whose sheets' crossings have faults.
    pub(super) doubtful: Vec<usize>,
    /// Where they are too near each other.
    pub(super) doubts: Vec<Doubt>,
    /// Where a curve was found, whether it is the only one.
    pub(super) certificates: Certificates,
}

/// How to look for crossings.
#[derive(Clone, Copy)]
pub(super) struct Settings<'a> {
    pub(super) tolerances: Tolerances,
    /// Beyond this box nothing is wanted.
    pub(super) clip: Bounds,
    /// Asked now and then whether to stop; what was found until then is of no use.
    pub(super) stop: &'a (dyn Fn() -> bool + Sync),
}

/// How far a branch may be from what it should pass through, as a fraction of the domain's size.
pub(super) const MATCH: f64 = 1e-8;

/// Curves are followed this far beyond the domain, as a fraction of its size each way: one that leaves the domain and
/// comes back soon is one branch.
const FAR: f64 = 0.25;

/// A root as the start of a branch on one pair of sheets.
#[derive(Clone, Copy)]
struct Start {
    root: usize,
    /// Which of the pair's sheets has the edge.
    side: usize,
    border: Border,
    /// And the border of the other one, if it lies on that.
    corner: Option<Border>,
    q: [f64; 4],
    point: DVec3,
    used: bool,
}

impl Start {
    /// Whether it lies on a border of one of the pair's sheets.
    fn is_on(&self, side: usize, border: Border) -> bool {
        let own = if side == self.side {
            Some(self.border)
        } else {
            self.corner
        };
        own == Some(border)
    }
}

struct Traced {
    sheets: [usize; 2],
    crossings: Vec<Crossing>,
    faults: Faults,
    doubts: Vec<Doubt>,
    certificates: Certificates,
}

impl Crossings {
    pub(super) fn find(regions: &Regions, settings: Settings<'_>, faults: &mut Faults) -> Self {
        let roots = edge_roots(regions, settings.tolerances, settings.clip, faults);
        Self::from_roots(regions, roots, settings, faults)
    }

    /// What follows once the roots of all edges are known.
    pub(super) fn from_roots(
        regions: &Regions,
        mut roots: Vec<EdgeRoot>,
        settings: Settings<'_>,
        faults: &mut Faults,
    ) -> Self {
        let far = far(regions, &settings.clip);
        let touches = Touches::find(regions, settings, &far);
        faults.undecided += touches.undecided;
        roots.extend(&touches.roots);
        let Settings {
            tolerances,
            clip,
            stop,
        } = settings;
        let by_pair = by_pair(regions, &roots);
        let traced: Vec<Traced> = pairs(regions, &clip, tolerances)
            .into_par_iter()
            .filter(|_| !stop())
            .map(|sheets| {
                let own = by_pair.get(&sheets).map_or(&[][..], Vec::as_slice);
                trace(regions, sheets, own, &touches, settings)
            })
            .collect();
        let mut crossings = Vec::new();
        let mut doubtful = Vec::new();
        let mut doubts = Vec::new();
        let mut certificates = Certificates::default();
        for one in traced {
            certificates.certain += one.certificates.certain;
            certificates.uncertain += one.certificates.uncertain;
            if !one.faults.is_none() {
                doubtful.extend(one.sheets.map(|sheet| regions.sheets[sheet].region));
            }
            faults.add(&one.faults);
            doubts.extend(one.doubts);
            crossings.extend(one.crossings);
        }
        doubtful.sort_unstable();
        doubtful.dedup();
        if faults.undecided > 0 {
            // Sheets that run along each other: nothing is made of what else was found.
            return Self {
                doubtful,
                doubts,
                roots,
                curves: crossings,
                triples: Vec::new(),
                certificates,
            };
        }
        let found: Vec<(Vec<Triple>, usize)> = (0..crossings.len())
            .into_par_iter()
            .filter(|_| !stop())
            .map(|at| {
                let thirds = Thirds::of(regions, &crossings, at, settings).find();
                (thirds.found, thirds.undecided)
            })
            .collect();
        let mut all = Vec::new();
        for (triples, undecided) in found {
            faults.undecided += undecided;
            all.extend(triples);
        }
        pass_through(regions, &mut crossings, &all, &touches, tolerances);
        Self {
            doubtful,
            doubts,
            certificates,
            roots,
            curves: crossings,
            triples: all,
        }
    }
}

/// Sheets of different regions whose boxes meet.
fn pairs(regions: &Regions, clip: &Bounds, tolerances: Tolerances) -> Vec<[usize; 2]> {
    let sheets = &regions.sheets;
    let mut pairs = Vec::new();
    for (i, a) in sheets.iter().enumerate() {
        if !a.bounds().meets(clip) {
            continue;
        }
        let around = a.bounds().grown(tolerances.curve);
        for (j, b) in sheets.iter().enumerate().skip(i + 1) {
            let near = around.meets(b.bounds()) && b.bounds().meets(clip);
            if near
                && a.region != b.region
                && regions.relations.meet(a.region, b.region)
                && !regions.touch(i, j)
            {
                pairs.push([i, j]);
            }
        }
    }
    pairs
}

pub(super) fn edge_roots(
    regions: &Regions,
    tolerances: Tolerances,
    clip: Bounds,
    faults: &mut Faults,
) -> Vec<EdgeRoot> {
    let of_edge = |edge: usize| {
        let own = &regions.edges[edge];
        let mut roots = Vec::new();
        let mut undecided = 0;
        if !own.bounds.meets(&clip) {
            return (roots, undecided);
        }
        for (sheet, other) in regions.sheets.iter().enumerate() {
            let wanted = other.region != own.region
                && other.bounds().meets(&own.bounds)
                && regions.may_pierce(own.sheets(), sheet);
            if !wanted {
                continue;
            }
            let on_height = own
                .sheets()
                .into_iter()
                .find_map(|at| Heights::of([&regions.sheets[at], other]));
            let matters = |point: DVec3| regions.matter([own.region, other.region], point);
            let (found, doubtful) = if let Some(heights) = on_height {
                let everywhere = [[f64::NEG_INFINITY, f64::INFINITY]];
                let found = Along::new(heights, tolerances, clip, &matters)
                    .within(&own.segments, &everywhere);
                (found.roots, found.undecided)
            } else {
                let found = Piercing::new(&own.segments, other, tolerances, clip, &matters).run();
                (found.roots, found.undecided)
            };
            undecided += doubtful;
            let at = |root| EdgeRoot {
                edge,
                sheet,
                corner: None,
                root,
            };
            roots.extend(found.into_iter().map(at));
        }
        (roots, undecided)
    };
    let found: Vec<_> = (0..regions.edges.len())
        .into_par_iter()
        .map(of_edge)
        .collect();
    let mut roots = Vec::new();
    for (own, undecided) in found {
        faults.undecided += undecided;
        roots.extend(own);
    }
    roots
}

/// The box to which curves are followed.
fn far(regions: &Regions, clip: &Bounds) -> Bounds {
    let beyond = FAR * (regions.domain.high - regions.domain.low);
    Bounds {
        low: clip.low - beyond,
        high: clip.high + beyond,
    }
}

/// The branches of one pair of sheets.
fn trace(
    regions: &Regions,
    sheets: [usize; 2],
    roots: &[(usize, EdgeRoot)],
    touches: &Touches<'_>,
    settings: Settings<'_>,
) -> Traced {
    let pair = Pair::new(sheets.map(|at| &regions.sheets[at]), settings.tolerances);
    if let lifted @ Some(_) = touches.lifted(sheets) {
        return follow(regions, (sheets, pair.lifted(lifted)), roots, settings);
    }
    let traced = follow(regions, (sheets, pair), roots, settings);
    // Sheets that touch one level side by side are too near each other there, however far their landings are apart.
    match touches.lift(sheets) {
        lifted @ Some(_) if !traced.faults.is_none() => {
            follow(regions, (sheets, pair.lifted(lifted)), roots, settings)
        }
        _ => traced,
    }
}

fn follow(
    regions: &Regions,
    (sheets, pair): ([usize; 2], Pair<'_>),
    roots: &[(usize, EdgeRoot)],
    Settings {
        tolerances, clip, ..
    }: Settings<'_>,
) -> Traced {
    let far = far(regions, &clip);
    let mut starts = starts(regions, sheets, roots);
    let stop = |start: &Start| Stop {
        point: start.point,
        q: start.q,
        side: start.side,
        border: start.border,
    };
    let march = March {
        pair,
        far,
        clip,
        stops: starts.iter().map(stop).collect(),
    };
    let own = sheets.map(|sheet| regions.sheets[sheet].region);
    let matters = |point: DVec3| regions.matter(own, point);
    let mut faults = Faults::default();
    let mut branches = Vec::new();
    for at in 0..starts.len() {
        if starts[at].used {
            continue;
        }
        let Some(node) = inwards(&pair, &starts[at]) else {
            continue;
        };
        let Some(mut branch) = march.inwards_from(node, starts[at].root) else {
            continue;
        };
        starts[at].used = true;
        finish(&mut branch, &mut starts, tolerances, &matters, &mut faults);
        branches.push(branch);
    }
    let found = |node: Node| march.through(node);
    let mut doubts = Vec::new();
    let mut certificates = Certificates::default();
    let mut branches = if let Some(heights) = pair.heights {
        let mut search = Contours::new(pair, heights, [clip, far], branches, found, &matters);
        search.run();
        faults.undecided += search.doubts.len();
        doubts = search.doubts;
        search.branches
    } else {
        let twins = regions.are_twins(sheets[0], sheets[1]);
        let mut search = Search::new(pair, clip, branches, found, &matters);
        search.twins = twins;
        search.run();
        // Where a curve may be missed nothing is decided.
        faults.undecided += search.undecided + search.uncertain + usize::from(search.gave_up());
        certificates = Certificates {
            certain: search.certain,
            uncertain: search.uncertain,
        };
        search.branches()
    };
    let first_new = branches
        .iter()
        .position(|branch| !matches!(branch.ends[0], End::AtRoot(_)));
    let new = branches.split_off(first_new.unwrap_or(branches.len()));
    for mut branch in new {
        // Only one branch starts at a root: one that ends at a root of another is the same, seen from a place where the
        // sheets are too nearly parallel to tell.
        if !ends_at_used_root(&branch, &starts, tolerances) {
            finish(&mut branch, &mut starts, tolerances, &matters, &mut faults);
            branches.push(branch);
        }
    }
    let unused = starts.iter().filter(|start| !start.used);
    faults.unused_roots += unused.filter(|start| matters(start.point)).count();
    let crossings = branches
        .into_iter()
        .map(|branch| Crossing { sheets, branch })
        .collect();
    Traced {
        sheets,
        crossings,
        faults,
        doubts,
        certificates,
    }
}

/// Roots with their numbers, by the pairs of sheets, in order, whose curves they begin.
fn by_pair(regions: &Regions, roots: &[EdgeRoot]) -> BTreeMap<[usize; 2], Vec<(usize, EdgeRoot)>> {
    let mut by_pair: BTreeMap<_, Vec<(usize, EdgeRoot)>> = BTreeMap::new();
    for (root, found) in roots.iter().enumerate() {
        for side in regions.edges[found.edge].borders() {
            let sheets = [side.sheet, found.sheet];
            let sheets = [sheets[0].min(sheets[1]), sheets[0].max(sheets[1])];
            let own = by_pair.entry(sheets).or_default();
            // Both sides of an edge may be borders of one sheet.
            if own.last().is_none_or(|last| last.0 != root) {
                own.push((root, *found));
            }
        }
    }
    by_pair
}

/// The starts of the curves of a pair of sheets, of those roots that lie on both.
fn starts(regions: &Regions, sheets: [usize; 2], roots: &[(usize, EdgeRoot)]) -> Vec<Start> {
    let mut starts = Vec::new();
    for &(root, ref found) in roots {
        let edge = &regions.edges[found.edge];
        for side in edge.borders() {
            for own in 0..2 {
                if side.sheet != sheets[own] || found.sheet != sheets[1 - own] {
                    continue;
                }
                let at = side.at(&regions.sheets, found.root.t).0;
                let (a, b) = if own == 0 {
                    (at, found.root.at)
                } else {
                    (found.root.at, at)
                };
                starts.push(Start {
                    root,
                    side: own,
                    border: side.border,
                    corner: found.corner,
                    q: [a.x, a.y, b.x, b.y],
                    point: found.root.point,
                    used: false,
                });
            }
        }
    }
    starts
}

/// The node at a root, running into the sheet that has the edge.
fn inwards(pair: &Pair<'_>, start: &Start) -> Option<Node> {
    let node = pair.node(start.q, None)?;
    let across = node.first[3 + 2 * start.side + start.border.axis()];
    Some(if (across < 0.0) == start.border.is_high() {
        node
    } else {
        node.reversed()
    })
}

/// Whether a branch ends on a border where only roots are that other branches have.
fn ends_at_used_root(branch: &Branch, starts: &[Start], tolerances: Tolerances) -> bool {
    (0..2).any(|which| {
        let End::AtBorder(side, border) = branch.ends[which] else {
            return false;
        };
        let point = branch.end(which).point();
        let mut here = starts.iter().filter(|start| {
            start.is_on(side, border) && start.point.distance(point) < MATCH * tolerances.scale
        });
        here.next().is_some_and(|first| first.used) && here.all(|start| start.used)
    })
}

/// Gives ends on borders their roots.
fn finish(
    branch: &mut Branch,
    starts: &mut [Start],
    tolerances: Tolerances,
    matters: &dyn Fn(DVec3) -> bool,
    faults: &mut Faults,
) {
    for which in 0..2 {
        let End::AtBorder(side, border) = branch.ends[which] else {
            let is_tangent = branch.ends[which] == End::Tangent;
            faults.tangents += usize::from(is_tangent && matters(branch.end(which).point()));
            continue;
        };
        let point = branch.end(which).point();
        let nearest = starts
            .iter_mut()
            .filter(|start| !start.used && start.is_on(side, border))
            .map(|start| (start.point.distance(point), start))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match nearest {
            Some((distance, start)) if distance < MATCH * tolerances.scale => {
                start.used = true;
                branch.ends[which] = End::AtRoot(start.root);
            }
            _ => faults.lost_ends += usize::from(matters(point)),
        }
    }
}

/// Gives branches nodes where they pass through third sheets. Between nodes a branch of sheets that are nearly parallel
/// may be much farther from their curve than from both sheets; three that share a point would pass each other there.
fn pass_through(
    regions: &Regions,
    crossings: &mut [Crossing],
    triples: &[Triple],
    touches: &Touches<'_>,
    tolerances: Tolerances,
) {
    for triple in triples {
        let Crossing { sheets, branch } = &mut crossings[triple.crossing];
        let lifted = touches.lifted(*sheets);
        let pair = Pair::new(sheets.map(|at| &regions.sheets[at]), tolerances).lifted(lifted);
        let towards = branch.in_space(triple.t)[1];
        if let Some(node) = pair.node(triple.q, Some(towards)) {
            branch.insert(triple.t, node);
        }
    }
}
