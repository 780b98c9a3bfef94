//! Tracks: all curves that faces may end at, cut at vertices. A vertex is made once and shared by every
//! track that passes through it.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::check::Faults;
use super::crossings::{Crossings, MATCH};
use super::hermite::{End, PieceOn};
use super::pair::Tolerances;
use super::region::Regions;

/// What a track is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    Edge(usize),
    Crossing(usize),
    Pole(usize),
}

/// A cut of a track.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub(super) t: f64,
    pub(super) vertex: usize,
    /// The region that the track enters or leaves there.
    pub(super) region: Option<usize>,
}

/// A curve and its cuts, in order.
#[derive(Clone, Debug)]
pub(super) struct Track {
    pub(super) source: Source,
    pub(super) sheets: [usize; 2],
    pub(super) cuts: Vec<Cut>,
}

/// All tracks and their vertices.
#[derive(Debug)]
pub(super) struct Tracks {
    pub(super) points: Vec<DVec3>,
    pub(super) tracks: Vec<Track>,
}

/// The geometry of tracks.
#[derive(Clone, Copy)]
pub(super) struct Geometry<'a> {
    pub(super) regions: &'a Regions,
    pub(super) crossings: &'a Crossings,
}

/// A smooth piece of a track on one of its sheets.
pub(super) enum Run<'a> {
    Known(Geometry<'a>, Source, usize),
    Piece(PieceOn),
}

impl Run<'_> {
    /// Parameters on the sheet, and their derivative.
    pub(super) fn at(&self, t: f64) -> (DVec2, DVec2) {
        match self {
            Self::Known(geometry, source, side) => geometry.on_sheet(*source, *side, t),
            Self::Piece(piece) => piece.at(t),
        }
    }
}

impl Geometry<'_> {
    /// The point at t.
    pub(super) fn point(&self, source: Source, t: f64) -> DVec3 {
        match source {
            Source::Edge(edge) => self.edge(edge, t).0,
            Source::Crossing(at) => self.crossings.curves[at].branch.in_space(t)[0],
            Source::Pole(at) => self.regions.poles[at].point,
        }
    }

    fn edge(&self, edge: usize, t: f64) -> (DVec3, DVec3) {
        self.regions.edges[edge].segment(t).evaluate(t)
    }

    /// Parameters on one of the track's sheets, and their derivative.
    pub(super) fn on_sheet(&self, source: Source, side: usize, t: f64) -> (DVec2, DVec2) {
        let sheets = &self.regions.sheets;
        match source {
            Source::Edge(edge) => self.regions.edges[edge].on_sheet(side, sheets, t),
            Source::Crossing(at) => {
                let [place, speed] = self.crossings.curves[at].branch.image(side, t);
                (place, speed)
            }
            Source::Pole(at) => {
                let pole = &self.regions.poles[at];
                let sheet = &sheets[pole.sheet];
                let fixed = sheet.at_border(pole.border);
                if pole.border.axis() == 0 {
                    (DVec2::new(fixed, t), DVec2::Y)
                } else {
                    (DVec2::new(t, fixed), DVec2::X)
                }
            }
        }
    }

    /// A smooth piece of a track on one of its sheets.
    pub(super) fn run(&self, source: Source, side: usize, range: [f64; 2]) -> Run<'_> {
        match source {
            Source::Crossing(at) => {
                let branch = &self.crossings.curves[at].branch;
                Run::Piece(branch.piece_on(side, 0.5 * (range[0] + range[1])))
            }
            Source::Edge(_) | Source::Pole(_) => Run::Known(*self, source, side),
        }
    }

    /// Point and derivative at t.
    pub(super) fn point_and_tangent(&self, source: Source, t: f64) -> (DVec3, DVec3) {
        match source {
            Source::Edge(edge) => self.edge(edge, t),
            Source::Crossing(at) => {
                let [point, tangent] = self.crossings.curves[at].branch.in_space(t);
                (point, tangent)
            }
            Source::Pole(at) => (self.regions.poles[at].point, DVec3::ZERO),
        }
    }

    /// The ends of the smooth pieces of a part of a track.
    pub(super) fn stops(&self, source: Source, t: [f64; 2]) -> Vec<f64> {
        let mut stops = vec![t[0]];
        match source {
            Source::Edge(edge) => {
                let starts = self.regions.edges[edge].segments.iter().skip(1);
                let breaks = starts.map(|segment| segment.t[0]);
                stops.extend(breaks.filter(|x| *x > t[0] && *x < t[1]));
            }
            Source::Crossing(at) => {
                stops.extend_from_slice(between(&self.crossings.curves[at].branch.lengths, t));
            }
            Source::Pole(at) => {
                let pole = &self.regions.poles[at];
                let running = 1 - pole.border.axis();
                stops
                    .extend_from_slice(between(&self.regions.sheets[pole.sheet].knots[running], t));
            }
        }
        stops.push(t[1]);
        stops
    }
}

/// Those of some sorted values, without the first and the last one, that lie strictly within a range.
fn between(values: &[f64], range: [f64; 2]) -> &[f64] {
    let inner = &values[1..values.len() - 1];
    let from = inner.partition_point(|x| *x <= range[0]);
    let to = inner.partition_point(|x| *x < range[1]);
    &inner[from..to.max(from)]
}

impl Tracks {
    pub(super) fn new(
        regions: &Regions,
        crossings: &Crossings,
        tolerances: Tolerances,
        faults: &mut Faults,
    ) -> Self {
        let mut all = Self {
            points: Vec::new(),
            tracks: Vec::new(),
        };
        all.add_edges(regions, tolerances);
        let roots: Vec<usize> = crossings
            .roots
            .iter()
            .map(|root| {
                let vertex = all.vertex(root.root.point);
                all.tracks[root.edge].cuts.push(Cut {
                    t: root.root.t,
                    vertex,
                    region: Some(regions.sheets[root.sheet].region),
                });
                vertex
            })
            .collect();
        all.add_poles(regions, tolerances);
        let first = all.tracks.len();
        all.add_crossings(crossings, &roots);
        all.add_landings(regions, crossings, &roots, first, faults);
        all.add_triples(regions, crossings, first, tolerances, faults);
        for track in &mut all.tracks {
            track.cuts.sort_by(|a, b| a.t.total_cmp(&b.t));
        }
        all.part_neighbours(regions);
        all
    }

    /// Of cuts at one place, those are left out whose region others hide there: it is not known in which order they come, and they bound
    /// nothing. So it is where a sheet comes to lie where another one is that is hidden, as beds do on both sides of a fault.
    fn part_neighbours(&mut self, regions: &Regions) {
        let near = MATCH * regions.domain.diagonal();
        for track in &mut self.tracks {
            let points = &self.points;
            let are_one = |a: &Cut, b: &Cut| {
                a.region != b.region && points[a.vertex].distance(points[b.vertex]) <= near
            };
            let cuts = &track.cuts;
            let crowded = |at: usize| {
                let before = at.checked_sub(1).map(|before| &cuts[before]);
                let after = cuts.get(at + 1);
                [before, after]
                    .into_iter()
                    .flatten()
                    .any(|other| are_one(&cuts[at], other))
            };
            let own = track.sheets.map(|sheet| regions.sheets[sheet].region);
            let bounds = |at: usize| {
                let Some(region) = cuts[at].region else {
                    return true;
                };
                let point = points[cuts[at].vertex];
                !crowded(at) || own.iter().any(|own| regions.matter([*own, region], point))
            };
            let kept: Vec<bool> = (0..cuts.len()).map(bounds).collect();
            let mut kept = kept.into_iter();
            track.cuts.retain(|_| kept.next().unwrap_or(true));
        }
    }

    fn vertex(&mut self, point: DVec3) -> usize {
        self.points.push(point);
        self.points.len() - 1
    }

    /// Edges, whose ends are shared within a region.
    fn add_edges(&mut self, regions: &Regions, tolerances: Tolerances) {
        let mut corners: Vec<(usize, DVec3, usize)> = Vec::new();
        for (index, edge) in regions.edges.iter().enumerate() {
            let (start, end) = edge.curve.domain();
            let mut cuts = Vec::new();
            for t in [start, end] {
                let vertex =
                    self.corner(&mut corners, edge.region, edge.curve.point(t), tolerances);
                cuts.push(Cut {
                    t,
                    vertex,
                    region: None,
                });
            }
            self.tracks.push(Track {
                source: Source::Edge(index),
                sheets: edge.sheets(),
                cuts,
            });
        }
    }

    fn corner(
        &mut self,
        corners: &mut Vec<(usize, DVec3, usize)>,
        region: usize,
        point: DVec3,
        tolerances: Tolerances,
    ) -> usize {
        // A region's corners are few, and the last ones are its own.
        let known = corners
            .iter()
            .rev()
            .take_while(|corner| corner.0 == region)
            .find(|corner| corner.1.distance(point) <= 10.0 * tolerances.same);
        if let Some(corner) = known {
            return corner.2;
        }
        let vertex = self.vertex(point);
        corners.push((region, point, vertex));
        vertex
    }

    /// Poles, whose vertices are ends of their region's edges.
    fn add_poles(&mut self, regions: &Regions, tolerances: Tolerances) {
        for (index, pole) in regions.poles.iter().enumerate() {
            let sheet = &regions.sheets[pole.sheet];
            let near = 10.0 * tolerances.same;
            let ends = self
                .tracks
                .iter()
                .zip(&regions.edges)
                .filter_map(|(track, edge)| {
                    if edge.region != sheet.region {
                        return None;
                    }
                    let (start, end) = edge.curve.domain();
                    let cut = track.cuts.iter().find(|cut| {
                        (cut.t == start || cut.t == end)
                            && self.points[cut.vertex].distance(pole.point) <= near
                    });
                    cut.map(|cut| cut.vertex)
                });
            let Some(vertex) = ends.into_iter().next() else {
                continue;
            };
            let running = 1 - pole.border.axis();
            let cut = |t: f64| Cut {
                t,
                vertex,
                region: None,
            };
            self.tracks.push(Track {
                source: Source::Pole(index),
                sheets: [pole.sheet; 2],
                cuts: vec![cut(sheet.low(running)), cut(sheet.high(running))],
            });
        }
    }

    fn add_crossings(&mut self, crossings: &Crossings, roots: &[usize]) {
        for (index, crossing) in crossings.curves.iter().enumerate() {
            let branch = &crossing.branch;
            let length = branch.length();
            let mut cuts = Vec::new();
            if branch.is_closed() {
                let vertex = self.vertex(branch.nodes[0].point());
                cuts.extend([0.0, length].map(|t| Cut {
                    t,
                    vertex,
                    region: None,
                }));
            } else {
                for (which, t) in [(0, 0.0), (1, length)] {
                    let vertex = match branch.ends[which] {
                        End::AtRoot(root) => roots[root],
                        _ => self.vertex(branch.end(which).point()),
                    };
                    cuts.push(Cut {
                        t,
                        vertex,
                        region: None,
                    });
                }
            }
            self.tracks.push(Track {
                source: Source::Crossing(index),
                sheets: crossing.sheets,
                cuts,
            });
        }
    }

    /// Where a landing passes through a third sheet, so does the curve of that sheet and the one landed on.
    fn add_landings(
        &mut self,
        regions: &Regions,
        crossings: &Crossings,
        roots: &[usize],
        first: usize,
        faults: &mut Faults,
    ) {
        let near = MATCH * regions.domain.diagonal();
        for (root, vertex) in crossings.roots.iter().zip(roots) {
            let Some(on) = regions.edges[root.edge].landing else {
                continue;
            };
            let point = root.root.point;
            let own = Some(regions.edges[root.edge].region);
            let pair = [on.sheet.min(root.sheet), on.sheet.max(root.sheet)];
            let [a, b] = pair.map(|sheet| regions.sheets[sheet].region);
            let mut passed = 0;
            for (index, edge) in regions.edges.iter().enumerate() {
                let [c, d] = edge.sheets();
                if [c.min(d), c.max(d)] != pair {
                    continue;
                }
                let closest = edge.curve.closest(point, near);
                if closest.distance <= near {
                    self.cut(index, closest.parameter, *vertex, own);
                    passed += 1;
                }
            }
            for (index, crossing) in crossings.curves.iter().enumerate() {
                if crossing.sheets != pair {
                    continue;
                }
                let (t, distance) = crossing.branch.project(point);
                if distance <= near {
                    self.cut(first + index, t, *vertex, own);
                    passed += 1;
                }
            }
            let wanted = regions.relations.meet(a, b) && regions.domain.holds(point);
            faults.triples += usize::from(wanted && passed != 1);
        }
    }

    /// Common points of three sheets: each must lie on all three of their curves.
    fn add_triples(
        &mut self,
        regions: &Regions,
        crossings: &Crossings,
        first: usize,
        tolerances: Tolerances,
        faults: &mut Faults,
    ) {
        let mut by_sheets: BTreeMap<[usize; 3], Vec<usize>> = BTreeMap::new();
        for (index, triple) in crossings.triples.iter().enumerate() {
            let [a, b] = crossings.curves[triple.crossing].sheets;
            let mut key = [a, b, triple.sheet];
            key.sort_unstable();
            by_sheets.entry(key).or_default().push(index);
        }
        let mut of_pair: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (index, crossing) in crossings.curves.iter().enumerate() {
            of_pair.entry(crossing.sheets).or_default().push(index);
        }
        let domain = regions.domain.grown(tolerances.same);
        for (key, mut left) in by_sheets {
            while let Some(&lead) = left.first() {
                let point = crossings.triples[lead].point;
                let near = |index: &usize| {
                    crossings.triples[*index].point.distance(point) <= 10.0 * tolerances.same
                };
                let (group, rest): (Vec<usize>, Vec<usize>) =
                    left.iter().partition(|index| near(index));
                left = rest;
                let vertex = self.vertex(point);
                let mut pairs = Vec::new();
                for index in group {
                    let triple = &crossings.triples[index];
                    self.cut(
                        first + triple.crossing,
                        triple.t,
                        vertex,
                        Some(regions.sheets[triple.sheet].region),
                    );
                    pairs.push(crossings.curves[triple.crossing].sheets);
                }
                let all = [[key[0], key[1]], [key[0], key[2]], [key[1], key[2]]];
                for (k, pair) in all.iter().enumerate() {
                    let count = pairs.iter().filter(|one| *one == pair).count();
                    let [a, b] = pair.map(|sheet| regions.sheets[sheet].region);
                    if count == 1 || !regions.relations.meet(a, b) {
                        continue;
                    }
                    // A curve that was seen to miss the point is asked for the nearest place on it.
                    let third = Some(regions.sheets[key[2 - k]].region);
                    let repaired = count == 0
                        && of_pair.get(pair).into_iter().flatten().any(|&index| {
                            let (t, distance) = crossings.curves[index].branch.project(point);
                            let close = distance <= 100.0 * tolerances.same;
                            if close {
                                self.cut(first + index, t, vertex, third);
                            }
                            close
                        });
                    // Where sheets of hidden regions run along each other their curves may end.
                    let is_missed = !repaired && domain.holds(point);
                    faults.triples += usize::from(is_missed && regions.matter([a, b], point));
                }
            }
        }
    }

    fn cut(&mut self, track: usize, t: f64, vertex: usize, region: Option<usize>) {
        self.tracks[track].cuts.push(Cut { t, vertex, region });
    }
}
