//! Faces: half-edges on every sheet, linked by angle into loops, loops gathered into faces.
//!
//! A half-edge has its face on the left, seen against the sheet's normal. At its end the face goes on along
//! the outgoing half-edge that comes first clockwise from where it came. Loops that turn left are outer
//! ones; the others are holes of the smallest loop around them with the same labels.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec2;
use rayon::prelude::*;

use super::Label;
use super::arcs::Arc;
use super::check::Faults;
use super::polygon::{Outline, holds, signed_area};
use super::tracks::{Geometry, Source, Tracks};

/// One side of an arc on one sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct HalfEdge {
    pub(super) arc: usize,
    pub(super) flap: usize,
    /// Which of the track's sheets it runs on.
    pub(super) side: usize,
    pub(super) forward: bool,
}

/// A face: its sheet, its loops (the outer one first), and the labels on both sides.
#[derive(Clone, Debug)]
pub(super) struct Face {
    pub(super) sheet: usize,
    pub(super) labels: [Label; 2],
    pub(super) loops: Vec<Vec<HalfEdge>>,
    /// The outer loop and the holes as polygons in (u, v).
    pub(super) polygons: Vec<Vec<DVec2>>,
}

/// A half-edge while its sheet is traced.
struct Link {
    half: HalfEdge,
    labels: [Label; 2],
    /// Places on the sheet where it starts and ends.
    from: usize,
    to: usize,
    /// Directions in which it leaves its start, and in which it arrived at its end looked at from there.
    leaving: f64,
    arriving: f64,
    next: Option<usize>,
}

/// Places on a sheet nearer than this part of its parameters are the same.
const SAME_PLACE: f64 = 1e-7;
/// Directions nearer than this are compared by a chord.
const SAME_DIRECTION: f64 = 1e-3;
/// Chords nearer than this are not told apart.
const UNCLEAR: f64 = 1e-7;
/// Points of a straight or long smooth piece in a loop's polygon.
const POLYGON: usize = 6;

/// Loops narrower than this part of their length are looked at more closely.
const NARROW: f64 = 1e-3;
/// How far a polygon's chords may be from the curves, as a part of the loop's width.
const SAG: f64 = 0.1;
/// Most doublings of a polygon's points.
const FINEST: usize = 7;

struct Traced {
    faces: Vec<Face>,
    faults: Faults,
}

/// All faces, sheet by sheet.
pub(super) fn faces(
    geometry: Geometry<'_>,
    tracks: &Tracks,
    arcs: &[Arc],
    faults: &mut Faults,
) -> Vec<Face> {
    let mut by_sheet: Vec<Vec<HalfEdge>> = vec![Vec::new(); geometry.regions.sheets.len()];
    for (index, arc) in arcs.iter().enumerate() {
        let sheets = tracks.tracks[arc.track].sheets;
        for (at, flap) in arc.flaps.iter().enumerate() {
            by_sheet[sheets[flap.side]].push(HalfEdge {
                arc: index,
                flap: at,
                side: flap.side,
                forward: flap.left,
            });
        }
    }
    let traced: Vec<Traced> = by_sheet
        .into_par_iter()
        .enumerate()
        .map(|(sheet, halves)| {
            Tracer {
                geometry,
                tracks,
                arcs,
                sheet,
            }
            .trace(&halves)
        })
        .collect();
    let mut faces = Vec::new();
    for one in traced {
        faults.add(&one.faults);
        faces.extend(one.faces);
    }
    faces
}

struct Tracer<'a> {
    geometry: Geometry<'a>,
    tracks: &'a Tracks,
    arcs: &'a [Arc],
    sheet: usize,
}

impl Tracer<'_> {
    fn trace(&self, halves: &[HalfEdge]) -> Traced {
        let mut faults = Faults::default();
        if halves.is_empty() {
            return Traced {
                faces: Vec::new(),
                faults,
            };
        }
        let (mut links, places) = self.links(halves);
        self.connect(&mut links, places, &mut faults);
        let loops = close(&links, &mut faults);
        // One sheet may have nearly all loops: the domain's top.
        let loops: Vec<(Vec<usize>, Outline, f64)> = loops
            .into_par_iter()
            .map(|one| {
                let polygon = self.fine_polygon(&one, &links);
                let area = signed_area(&polygon);
                (one, Outline::new(polygon, area.abs()), area)
            })
            .collect();
        let mut outer: Vec<(Face, Outline)> = Vec::new();
        let mut holes: Vec<(Vec<usize>, Outline)> = Vec::new();
        for (one, outline, area) in loops {
            let labels = links[one[0]].labels;
            faults.mixed_loops += usize::from(one.iter().any(|at| links[*at].labels != labels));
            if area > 0.0 {
                let face = Face {
                    sheet: self.sheet,
                    labels,
                    loops: vec![one.iter().map(|at| links[*at].half).collect()],
                    polygons: Vec::new(),
                };
                outer.push((face, outline));
            } else {
                holes.push((one, outline));
            }
        }
        for (one, outline) in holes {
            let labels = links[one[0]].labels;
            let home = outer
                .iter_mut()
                .filter(|(face, around)| around.area > outline.area && face.labels == labels)
                .filter(|(_, around)| holds(around, &outline))
                .min_by(|a, b| a.1.area.total_cmp(&b.1.area));
            match home {
                Some((face, _)) => {
                    face.loops
                        .push(one.iter().map(|at| links[*at].half).collect());
                    face.polygons.push(outline.points);
                }
                None => faults.homeless_holes += 1,
            }
        }
        let whole = |(mut face, outline): (Face, Outline)| {
            face.polygons.insert(0, outline.points);
            face
        };
        Traced {
            faces: outer.into_iter().map(whole).collect(),
            faults,
        }
    }

    /// Half-edges with the places that they join, and the number of places.
    fn links(&self, halves: &[HalfEdge]) -> (Vec<Link>, usize) {
        let sheet = &self.geometry.regions.sheets[self.sheet];
        let unit = DVec2::new(sheet.length(0), sheet.length(1));
        // A vertex may lie at several places of a sheet: on both sides of a seam, all along a pole.
        let mut known: BTreeMap<usize, Vec<(DVec2, usize)>> = BTreeMap::new();
        let mut places = 0;
        let mut place = |vertex: usize, at: DVec2| {
            let list = known.entry(vertex).or_default();
            if let Some(found) = list
                .iter()
                .find(|one| ((one.0 - at) / unit).abs().max_element() < SAME_PLACE)
            {
                return found.1;
            }
            list.push((at, places));
            places += 1;
            places - 1
        };
        let mut links = Vec::with_capacity(halves.len());
        for half in halves {
            let arc = &self.arcs[half.arc];
            let source = self.tracks.tracks[arc.track].source;
            let (start, d0) = self.geometry.on_sheet(source, half.side, arc.t[0]);
            let (end, d1) = self.geometry.on_sheet(source, half.side, arc.t[1]);
            let first = place(arc.vertices[0], start);
            let last = place(arc.vertices[1], end);
            let angle = |d: DVec2| (d / unit).to_angle();
            let (from, to, leaving, arriving) = if half.forward {
                (first, last, angle(d0), angle(-d1))
            } else {
                (last, first, angle(-d1), angle(d0))
            };
            links.push(Link {
                half: *half,
                labels: arc.flaps[half.flap].labels,
                from,
                to,
                leaving,
                arriving,
                next: None,
            });
        }
        (links, places)
    }

    fn connect(&self, links: &mut [Link], places: usize, faults: &mut Faults) {
        let mut leaving: Vec<Vec<usize>> = vec![Vec::new(); places];
        for (index, link) in links.iter().enumerate() {
            leaving[link.from].push(index);
        }
        for index in 0..links.len() {
            let link = &links[index];
            let out = &leaving[link.to];
            let next = match out[..] {
                [] => {
                    faults.dead_ends += 1;
                    None
                }
                [only] => Some(only),
                _ => {
                    let (best, clear) = self.first_clockwise(links, link, out);
                    faults.ambiguous += usize::from(!clear);
                    Some(best)
                }
            };
            links[index].next = next;
        }
    }

    /// The outgoing half-edge that comes first clockwise from where a half-edge arrived, and whether that is clear.
    fn first_clockwise(&self, links: &[Link], link: &Link, out: &[usize]) -> (usize, bool) {
        let turn = |angle: f64| (link.arriving - angle).rem_euclid(TAU);
        let near = |turn: f64| turn < SAME_DIRECTION || TAU - turn < SAME_DIRECTION;
        let mut turns: Vec<(f64, bool, usize)> = Vec::with_capacity(out.len());
        for &at in out {
            let other = &links[at].half;
            let back = other.arc == link.half.arc
                && other.side == link.half.side
                && other.forward != link.half.forward;
            let mut turned = turn(links[at].leaving);
            let mut clear = true;
            if back {
                // Straight back is the last choice.
                turned = TAU;
            } else if near(turned) {
                let by_chord = self.by_chord(link, &links[at]);
                clear = by_chord.abs() > UNCLEAR;
                turned = by_chord.rem_euclid(TAU);
            }
            turns.push((turned, clear, at));
        }
        turns.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut clear = turns[0].1;
        if turns[1].0 - turns[0].0 < SAME_DIRECTION {
            let apart = self.leaving_apart(&links[turns[0].2], &links[turns[1].2]);
            clear &= apart.abs() > UNCLEAR;
            // The one that is more to the left leaves first clockwise from behind.
            if apart < 0.0 {
                turns.swap(0, 1);
            }
        }
        (turns[0].2, clear)
    }

    /// The angle of a chord from one end of an arc, at a radius that the two arcs share.
    fn chord(&self, half: &HalfEdge, at_end: bool, radius: f64) -> Option<DVec2> {
        let sheet = &self.geometry.regions.sheets[self.sheet];
        let unit = DVec2::new(sheet.length(0), sheet.length(1));
        let arc = &self.arcs[half.arc];
        let source = self.tracks.tracks[arc.track].source;
        let reverse = half.forward == at_end;
        let at = |part: f64| {
            let part = if reverse { 1.0 - part } else { part };
            let t = arc.t[0] + part * (arc.t[1] - arc.t[0]);
            self.geometry.on_sheet(source, half.side, t).0 / unit
        };
        let origin = at(0.0);
        let (mut low, mut high) = (0.0, 1.0);
        if at(1.0).distance(origin) < radius {
            return None;
        }
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if at(middle).distance(origin) < radius {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(at(high) - origin)
    }

    fn reach(&self, half: &HalfEdge) -> f64 {
        let sheet = &self.geometry.regions.sheets[self.sheet];
        let unit = DVec2::new(sheet.length(0), sheet.length(1));
        let arc = &self.arcs[half.arc];
        let source = self.tracks.tracks[arc.track].source;
        let at = |t: f64| self.geometry.on_sheet(source, half.side, t).0 / unit;
        let middle = at(arc.t[0].midpoint(arc.t[1]));
        at(arc.t[0])
            .distance(middle)
            .min(at(arc.t[1]).distance(middle))
    }

    /// How far clockwise an outgoing arc lies from the one that arrived, both nearly in the same direction.
    fn by_chord(&self, arrived: &Link, leaves: &Link) -> f64 {
        let radius = 0.3 * self.reach(&arrived.half).min(self.reach(&leaves.half));
        let a = self.chord(&arrived.half, true, radius);
        let b = self.chord(&leaves.half, false, radius);
        match (a, b) {
            (Some(a), Some(b)) => -a.angle_to(b),
            _ => 0.0,
        }
    }

    /// How far clockwise the second outgoing arc lies from the first.
    fn leaving_apart(&self, first: &Link, second: &Link) -> f64 {
        let radius = 0.3 * self.reach(&first.half).min(self.reach(&second.half));
        let a = self.chord(&first.half, false, radius);
        let b = self.chord(&second.half, false, radius);
        match (a, b) {
            (Some(a), Some(b)) => -a.angle_to(b),
            _ => 0.0,
        }
    }

    /// A loop's polygon, so fine that its chords are nearer to the curves than the loop is narrow: a bed of a centimetre along
    /// a wall of kilometres lies beside a coarse one.
    fn fine_polygon(&self, one: &[usize], links: &[Link]) -> Vec<DVec2> {
        let sheet = &self.geometry.regions.sheets[self.sheet];
        let unit = DVec2::new(sheet.length(0), sheet.length(1));
        let mut polygon = self.polygon(one, links, 1);
        let around = |polygon: &[DVec2]| -> f64 {
            let next = polygon.iter().cycle().skip(1);
            let legs = polygon.iter().zip(next);
            legs.map(|(a, b)| ((*b - *a) / unit).length()).sum()
        };
        let width = |polygon: &[DVec2]| {
            2.0 * signed_area(polygon).abs() / (unit.x * unit.y) / around(polygon)
        };
        if width(&polygon) > NARROW * around(&polygon) {
            return polygon;
        }
        for finer in (1..=FINEST).map(|step| 1 << step) {
            let fine = self.polygon(one, links, finer);
            // Every second point is new: how far is it from the chord that it halves?
            let sag = fine
                .chunks_exact(2)
                .zip(polygon.iter().cycle().skip(1))
                .map(|(own, next)| {
                    let chord = (*next - own[0]) / unit;
                    let off = chord.perp_dot((own[1] - own[0]) / unit).abs();
                    off / chord.length().max(f64::MIN_POSITIVE)
                })
                .fold(0.0, f64::max);
            polygon = fine;
            if sag < SAG * width(&polygon) {
                break;
            }
        }
        polygon
    }

    /// A loop's polygon, with so many times the usual number of points.
    fn polygon(&self, one: &[usize], links: &[Link], finer: usize) -> Vec<DVec2> {
        let mut polygon = Vec::new();
        for at in one {
            let half = &links[*at].half;
            let arc = &self.arcs[half.arc];
            let source = self.tracks.tracks[arc.track].source;
            let stops = self.geometry.stops(source, arc.t);
            let each = match source {
                Source::Crossing(_) => 2,
                Source::Edge(_) | Source::Pole(_) => 1,
            };
            let each = finer * if stops.len() < POLYGON { POLYGON } else { each };
            let part = |k: usize| k as f64 / each as f64;
            let first = polygon.len();
            for pair in stops.windows(2) {
                let run = self.geometry.run(source, half.side, [pair[0], pair[1]]);
                let place = |k: usize| run.at(pair[0] + (pair[1] - pair[0]) * part(k)).0;
                polygon.extend((0..each).map(place));
            }
            if !half.forward {
                let end = self.geometry.on_sheet(source, half.side, arc.t[1]).0;
                polygon.push(end);
                polygon.remove(first);
                polygon[first..].reverse();
            }
        }
        polygon
    }
}

/// Follows next half-edges into loops.
fn close(links: &[Link], faults: &mut Faults) -> Vec<Vec<usize>> {
    let mut seen = vec![false; links.len()];
    let mut loops = Vec::new();
    for first in 0..links.len() {
        if seen[first] {
            continue;
        }
        let mut own = Vec::new();
        let mut at = Some(first);
        while let Some(link) = at {
            if seen[link] {
                break;
            }
            seen[link] = true;
            own.push(link);
            at = links[link].next;
        }
        // A loop that runs into another one, or ends, is none.
        faults.dead_ends += usize::from(at != Some(first));
        loops.push(own);
    }
    loops
}
