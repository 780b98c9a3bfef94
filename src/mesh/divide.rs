//! Edges divided into chords, once for all faces that meet at them.
//!
//! A chord is as long as the edge's curve and the surfaces on both sides allow: the curve leaves it by no more than the chord
//! tolerance and turns by no more than the angle, and so do the surfaces along the straight line between its ends in their
//! parameters. Where the curve has been asked at places on a course, the longest chord from each is taken, found by doubling.

use std::cell::OnceCell;

use glam::{DVec2, DVec3};
use smallvec::SmallVec;

use super::fineness::{Limits, nearest_on_segment};
use super::tables::{Path, Side};

/// Places that an edge is asked at, at least.
const PLACES: usize = 32;
/// Places between the ends of a chord that are compared with it.
const BETWEEN: usize = 8;
/// How often a stretch between two places may be halved.
const HALVINGS: usize = 10;
/// Chords that an edge may have.
const MOST_CHORDS: usize = 1 << 20;

/// An edge's chords.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Division {
    /// Parameters of the ends of chords, from the edge's start to its end.
    pub(super) parameters: Vec<f64>,
    /// Their points; first and last are the edge's vertices.
    pub(super) points: Vec<DVec3>,
}

impl Division {
    /// How many chords there are.
    pub(super) fn chords(&self) -> usize {
        self.parameters.len() - 1
    }

    /// Halves a chord. Says whether there was anything left to halve.
    pub(super) fn halve(&mut self, chord: usize, curve: &Path) -> bool {
        let [from, to] = [self.parameters[chord], self.parameters[chord + 1]];
        let middle = 0.5 * (from + to);
        if !(from < middle && middle < to) || self.chords() >= MOST_CHORDS {
            return false;
        }
        self.parameters.insert(chord + 1, middle);
        self.points.insert(chord + 1, curve.point(middle));
        true
    }

    /// Halves the longest chords until there are so many.
    pub(super) fn at_least(&mut self, chords: usize, curve: &Path) {
        while self.chords() < chords {
            let length = |at: &usize| self.parameters[at + 1] - self.parameters[*at];
            let longest = (0..self.chords()).max_by(|a, b| length(a).total_cmp(&length(b)));
            if !longest.is_some_and(|longest| self.halve(longest, curve)) {
                break;
            }
        }
    }
}

/// An edge to be divided.
pub(super) struct Course<'a> {
    pub(super) curve: &'a Path,
    pub(super) range: [f64; 2],
    /// Its vertices.
    pub(super) ends: [DVec3; 2],
    pub(super) sides: SmallVec<[Side<'a>; 4]>,
    pub(super) limits: Limits,
}

struct Place {
    t: f64,
    point: DVec3,
    uv: SmallVec<[DVec2; 4]>,
    directions: OnceCell<Directions>,
}

/// The curve's direction, and the surfaces' normals.
struct Directions {
    tangent: Option<DVec3>,
    normals: SmallVec<[Option<DVec3>; 4]>,
}

impl Course<'_> {
    /// Chords that are fine enough.
    pub(super) fn divide(&self) -> Division {
        let places = self.places();
        let mut parameters = vec![self.range[0]];
        let mut points = vec![self.ends[0]];
        let mut push = |place: &Place| {
            parameters.push(place.t);
            points.push(place.point);
        };
        let last = places.len() - 1;
        let mut from = 0;
        while from < last {
            let to = self.reach(&places, from);
            if to == from + 1 {
                self.halved(&places[from], &places[to], HALVINGS, &mut push);
            }
            push(&places[to]);
            from = to;
        }
        Division { parameters, points }
    }

    fn place(&self, t: f64, point: DVec3) -> Place {
        Place {
            t,
            point,
            uv: self.sides.iter().map(|side| side.at(t, point)).collect(),
            directions: OnceCell::new(),
        }
    }

    fn places(&self) -> Vec<Place> {
        let [from, to] = self.range;
        let mut knots = vec![from];
        knots.extend(self.curve.knots(self.range));
        knots.push(to);
        let pieces = PLACES.div_ceil(knots.len() - 1).max(2);
        let mut places = vec![self.place(from, self.ends[0])];
        for pair in knots.windows(2) {
            for k in 1..=pieces {
                let t = if k == pieces {
                    pair[1]
                } else {
                    pair[0] + (pair[1] - pair[0]) * k as f64 / pieces as f64
                };
                let point = if t == to {
                    self.ends[1]
                } else {
                    self.curve.point(t)
                };
                places.push(self.place(t, point));
            }
        }
        places
    }

    /// The farthest place that a chord from another one may end at, or the next.
    fn reach(&self, places: &[Place], from: usize) -> usize {
        let last = places.len() - 1;
        let fits = |to: usize| self.fits(&places[from], &places[to], &places[from + 1..to]);
        let (mut good, mut step) = (from + 1, 2);
        let mut bad = loop {
            let to = (from + step).min(last);
            if to == good {
                return good;
            }
            if !fits(to) {
                break to;
            }
            good = to;
            step *= 2;
        };
        while bad - good > 1 {
            let middle = good.midpoint(bad);
            if fits(middle) {
                good = middle;
            } else {
                bad = middle;
            }
        }
        good
    }

    /// Pushes what is between two neighbouring places, if anything needs to be.
    fn halved(&self, a: &Place, b: &Place, left: usize, push: &mut impl FnMut(&Place)) {
        let t = 0.5 * (a.t + b.t);
        if left == 0 || !(a.t < t && t < b.t) {
            return;
        }
        let middle = self.place(t, self.curve.point(t));
        if self.fits(a, b, std::slice::from_ref(&middle)) {
            return;
        }
        self.halved(a, &middle, left - 1, push);
        push(&middle);
        self.halved(&middle, b, left - 1, push);
    }

    fn fits(&self, a: &Place, b: &Place, between: &[Place]) -> bool {
        let step = between.len().div_ceil(BETWEEN).max(1);
        let is_near = |place: &Place| {
            place
                .point
                .distance(nearest_on_segment(place.point, a.point, b.point))
                <= self.limits.chord
        };
        if !between.iter().step_by(step).all(is_near) {
            return false;
        }
        let length = a.point.distance(b.point);
        let (at_a, at_b) = (self.directions(a), self.directions(b));
        self.limits.turns_little(length, at_a.tangent, at_b.tangent)
            && self.sides.iter().enumerate().all(|(at, side)| {
                let ends = [(a.uv[at], a.point), (b.uv[at], b.point)];
                self.limits
                    .turns_little(length, at_a.normals[at], at_b.normals[at])
                    && self.limits.edge_holds(side.support, ends)
            })
    }

    fn directions<'p>(&self, place: &'p Place) -> &'p Directions {
        place.directions.get_or_init(|| Directions {
            tangent: self.curve.tangent(place.t),
            normals: self
                .sides
                .iter()
                .zip(&place.uv)
                .map(|(side, uv)| side.support.normal(*uv))
                .collect(),
        })
    }
}
