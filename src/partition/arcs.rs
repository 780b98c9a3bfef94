//! Arcs: tracks between cuts, with the labels of what lies around them. An arc between sectors of one label
//! does not exist, nor does a piece of a sheet between two of them.

use glam::DVec3;
use rayon::prelude::*;

use super::Label;
use super::check::Faults;
use super::landing;
use super::tracks::{Geometry, Source, Tracks};

/// A piece of a sheet beside an arc, and the labels on its region's inner and outer side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Flap {
    /// Which of the track's sheets.
    pub(super) side: usize,
    /// Whether it lies to the left of the arc, seen against the sheet's normal.
    pub(super) left: bool,
    /// Labels inside and outside of the sheet's region.
    pub(super) labels: [Label; 2],
    /// Seen around the arc: which of its two sides meets the flap before and which the flap after, 0 inner, 1 outer.
    pub(super) facing: [usize; 2],
}

/// A piece of a track that bounds something.
#[derive(Clone, Debug)]
pub(super) struct Arc {
    pub(super) track: usize,
    pub(super) t: [f64; 2],
    pub(super) vertices: [usize; 2],
    /// In order around the arc.
    pub(super) flaps: Vec<Flap>,
}

/// What labels a combination of sides: the regions that hold a place, by index.
pub(super) type Labels<'a> = &'a (dyn Fn(&[bool]) -> Label + Sync);

/// Where along an arc its surroundings are asked for: no place that symmetry prefers.
const PROBE: f64 = 0.4837;

/// All arcs that bound something.
pub(super) fn arcs(
    geometry: Geometry<'_>,
    tracks: &Tracks,
    labels: Labels<'_>,
    faults: &mut Faults,
) -> Vec<Arc> {
    let found: Vec<(Vec<Arc>, usize)> = (0..tracks.tracks.len())
        .into_par_iter()
        .map(|track| along(geometry, tracks, track, labels))
        .collect();
    let mut arcs = Vec::new();
    for (own, contradictions) in found {
        faults.sides += contradictions;
        arcs.extend(own);
    }
    arcs
}

/// The arcs of one track, and how often its sides contradict its cuts.
fn along(
    geometry: Geometry<'_>,
    tracks: &Tracks,
    at: usize,
    labels: Labels<'_>,
) -> (Vec<Arc>, usize) {
    let track = &tracks.tracks[at];
    let regions = geometry.regions;
    let own = track.sheets.map(|sheet| regions.sheets[sheet].region);
    let mut arcs = Vec::new();
    let mut contradictions = 0;
    let mut before: Option<Vec<bool>> = None;
    for pair in track.cuts.windows(2) {
        let t = [pair[0].t, pair[1].t];
        if !(t[1] > t[0]) {
            continue;
        }
        let probe = t[0] + PROBE * (t[1] - t[0]);
        let point = geometry.point(track.source, probe);
        let Some(sides) = sides(geometry, own, point) else {
            before = None;
            continue;
        };
        // Outside of the domain nobody asks.
        if let (Some(before), Some(region @ 1..)) = (before.take(), pair[0].region) {
            let flipped = |at: usize| before[at] != sides[at];
            let around = Around { own, labels };
            let contradicts = |at: usize| {
                flipped(at) != (at == region)
                    && around.depend(&before, at)
                    && around.depend(&sides, at)
            };
            contradictions += usize::from(sides[0] && (0..sides.len()).any(contradicts));
        }
        let flaps = if own[0] == own[1] {
            rim(geometry, track.source, own[0], &sides, labels)
        } else if is_landing(geometry, track.source) {
            landing::flaps(geometry, track, probe, &sides, labels)
        } else {
            cross(geometry, track, probe, &sides, labels)
        };
        // On stretches of branches that bound nothing, points of third sheets are not looked for.
        let is_cut = !matches!(track.source, Source::Crossing(_)) || !flaps.is_empty();
        before = is_cut.then_some(sides);
        if !flaps.is_empty() {
            arcs.push(Arc {
                track: at,
                t,
                vertices: [pair[0].vertex, pair[1].vertex],
                flaps,
            });
        }
    }
    (arcs, contradictions)
}

/// The sectors around an arc of some regions.
struct Around<'a> {
    own: [usize; 2],
    labels: Labels<'a>,
}

impl Around<'_> {
    /// Whether any sector's label depends on a region. Where it does not, a region's side tells nothing: an open
    /// sheet's may change without the sheet being passed.
    fn depend(&self, sides: &[bool], region: usize) -> bool {
        let mut with = sides.to_vec();
        [false, true].into_iter().any(|first| {
            [false, true].into_iter().any(|second| {
                with[self.own[0]] = first;
                with[self.own[1]] = second;
                let label = (self.labels)(&with);
                with[region] = !with[region];
                let other = (self.labels)(&with);
                with[region] = !with[region];
                label != other
            })
        })
    }
}

fn is_landing(geometry: Geometry<'_>, source: Source) -> bool {
    matches!(source, Source::Edge(edge) if geometry.regions.edges[edge].landing.is_some())
}

/// Which regions hold a point; the arc's own, those that matter to neither of them and those that others hide are left
/// out. `None` if one of its own is hidden: then nothing changes across it.
fn sides(geometry: Geometry<'_>, own: [usize; 2], point: DVec3) -> Option<Vec<bool>> {
    let regions = geometry.regions;
    let in_domain = own.contains(&0) || regions.inside[0].holds(point);
    if !in_domain {
        return Some(vec![false; regions.inside.len()]);
    }
    regions
        .relations
        .sides(&own, |region| regions.inside[region].holds(point))
}

/// Around an edge of a region: its inside and its outside.
fn rim(
    geometry: Geometry<'_>,
    source: Source,
    region: usize,
    sides: &[bool],
    labels: Labels<'_>,
) -> Vec<Flap> {
    let mut with = sides.to_vec();
    with[region] = true;
    let inner = labels(&with);
    with[region] = false;
    let pair = [inner, labels(&with)];
    if pair[0] == pair[1] {
        return Vec::new();
    }
    let flap = |side: usize, left: bool, facing: [usize; 2]| Flap {
        side,
        left,
        labels: pair,
        facing,
    };
    match source {
        Source::Edge(edge) => {
            let of = &geometry.regions.edges[edge].sides;
            // The inside lies between the first and the second, the outside between the second and the first.
            vec![
                flap(0, of[0].sheet_is_left(), [1, 0]),
                flap(1, of[1].sheet_is_left(), [0, 1]),
            ]
        }
        Source::Pole(pole) => {
            let border = geometry.regions.poles[pole].border;
            vec![flap(0, border.sheet_is_left(), [1, 0])]
        }
        Source::Crossing(_) => Vec::new(),
    }
}

/// Those of an arc's flaps that lie between two labels; none if one sheet only goes on.
pub(super) fn existing(all: impl Iterator<Item = Flap>) -> Vec<Flap> {
    let flaps: Vec<Flap> = all
        .filter(|flap| flap.labels[0] != flap.labels[1])
        .collect();
    // Both halves of one sheet between the same labels: the sheet goes on, without an edge.
    match flaps[..] {
        [first, second] if first.side == second.side && first.labels == second.labels => Vec::new(),
        _ => flaps,
    }
}

/// Around a crossing of two regions' sheets: four sectors.
fn cross(
    geometry: Geometry<'_>,
    track: &super::tracks::Track,
    t: f64,
    sides: &[bool],
    labels: Labels<'_>,
) -> Vec<Flap> {
    let regions = geometry.regions;
    let [a, b] = track.sheets.map(|sheet| &regions.sheets[sheet]);
    let label = |in_a: bool, in_b: bool| {
        let mut with = sides.to_vec();
        with[a.region] = in_a;
        with[b.region] = in_b;
        labels(&with)
    };
    let sector = [
        label(true, true),
        label(true, false),
        label(false, false),
        label(false, true),
    ];
    if sector.iter().all(|one| *one == sector[0]) {
        return Vec::new();
    }
    let tangent = geometry.point_and_tangent(track.source, t).1;
    let normal = |side: usize| {
        let at = geometry.on_sheet(track.source, side, t).0;
        let (_, u, v) = regions.sheets[track.sheets[side]].first_jet(at.x, at.y);
        u.cross(v)
    };
    let (na, nb) = (normal(0), normal(1));
    // Left on a sheet is n × T; is that out of the other's region?
    let left_of_a_is_outside_b = na.cross(tangent).dot(nb) * b.outward > 0.0;
    let left_of_b_is_outside_a = nb.cross(tangent).dot(na) * a.outward > 0.0;
    let flap = |side: usize, outside_other: bool, labels: [Label; 2], facing: [usize; 2]| Flap {
        side,
        left: if side == 0 {
            left_of_a_is_outside_b == outside_other
        } else {
            left_of_b_is_outside_a == outside_other
        },
        labels,
        facing,
    };
    let all = [
        flap(1, false, [sector[0], sector[1]], [0, 1]),
        flap(0, true, [sector[1], sector[2]], [0, 1]),
        flap(1, true, [sector[3], sector[2]], [1, 0]),
        flap(0, false, [sector[0], sector[3]], [1, 0]),
    ];
    existing(all.into_iter())
}
