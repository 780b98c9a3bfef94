//! Sections of one's own: any plane NURBS curve as a channel's cross-section.
//!
//! Points are given as fractions: x of the width (the rims at −½ and ½), y of the depth (0 at the rims, upwards). So a section
//! keeps its shape however width and depth vary along a trajectory, and its knots and weights are the same everywhere. A
//! channel's area is that of the curve times width and depth.
//!
//! Degree 3 does not reach its control points: where the deepest one is meant to be as deep as the channel, the section is
//! stretched ([`Depth::Deepest`]). Three points on a line, the outer two as far from the middle one, pass through that if it is
//! the middle one of 5, 7, 9 … points on uniform knots (\[J19\] §2.4.1).

mod error;

use glam::{DVec2, DVec3};

pub use error::{LARGEST_DEGREE, OwnSectionError};

use super::crossing::crossing;
use super::fan;
use crate::nurbs::quadrature::{TEN, between};
use crate::nurbs::{Curve, KnotVector};

/// Farthest that coordinates may be from 0.
const FARTHEST: f64 = 10.0;
/// How near a section may come to where it must not be, in widths and depths.
const NEAR: f64 = 1e-9;
/// Places that differ by less in height are level, in depths.
const LEVEL: f64 = 1e-13;
/// How near to a knot, as a fraction of all parameters, a place cannot be told from it.
const BESIDE: f64 = 1e-5;
/// Places of each span at which the lowest one is looked for, and halvings after that.
const SEARCHED: usize = 64;
const NARROWED: usize = 60;

/// How a section is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Close {
    /// By a straight line between its ends, the rims: a channel with a top.
    Ruled,
    /// By itself: its last point is its first. A tube.
    Closed,
}

/// What a channel's depth says of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// How long 1 is along y.
    Scale,
    /// How deep the deepest place is.
    Deepest,
}

/// A section's curve as it is given.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnDesign {
    /// Control points in widths and depths, from left to right.
    pub points: Vec<DVec2>,
    /// Degree of the curve.
    pub degree: usize,
    /// Weights of the points; all 1 without any.
    pub weights: Option<Vec<f64>>,
    /// Clamped knots; uniform ones without any.
    pub knots: Option<Vec<f64>>,
    /// How it is closed.
    pub close: Close,
    /// What the depth says.
    pub depth: Depth,
}

/// A section of one's own: a curve that does not cross itself, with rims at y = 0 and all the rest below, or closed.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnSection {
    curve: Curve,
    close: Close,
    deepest: DVec2,
    area: f64,
    corners: Vec<f64>,
}

impl OwnSection {
    /// The section of a design.
    pub fn new(design: &OwnDesign) -> Result<Self, OwnSectionError> {
        check_points(design)?;
        let points = &design.points;
        let knots = knots(design)?;
        let lifted: Vec<DVec3> = points.iter().map(|p| p.extend(0.0)).collect();
        let made = |points: Vec<DVec3>| match &design.weights {
            Some(weights) => Curve::rational(knots.clone(), points, weights.clone()),
            None => Curve::new(knots.clone(), points),
        };
        let mut curve = made(lifted)?;
        check_shape(&curve, design.close)?;
        let mut deepest = lowest(&curve, DVec2::Y);
        if design.depth == Depth::Deepest {
            let stretched = |p: &DVec2| DVec3::new(p.x, p.y / -deepest.y, 0.0);
            curve = made(points.iter().map(stretched).collect())?;
            deepest.y = -1.0;
        }
        let corners = curve.corners();
        let is_one_basin = || {
            let samples = samples(&curve, 24);
            fan::centre(&samples).is_some()
        };
        if (design.close == Close::Closed || !corners.is_empty()) && !is_one_basin() {
            return Err(OwnSectionError::Hidden);
        }
        Ok(Self {
            area: area(&curve).abs(),
            close: design.close,
            deepest,
            corners,
            curve,
        })
    }

    /// The curve, in widths and depths, z = 0.
    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// How it is closed.
    pub fn close(&self) -> Close {
        self.close
    }

    /// Its deepest place, in widths and depths; the middle of a level floor.
    pub fn deepest(&self) -> DVec2 {
        self.deepest
    }

    /// Its area as a fraction of width times depth.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The parameters of its corners.
    pub fn corners(&self) -> &[f64] {
        &self.corners
    }

    /// Of a closed one, the parameters of its leftmost and its rightmost place.
    pub fn sides(&self) -> [f64; 2] {
        [DVec2::X, DVec2::NEG_X].map(|way| lowest_at(&self.curve, way))
    }

    /// Whether it reaches beyond its rims.
    pub fn overhangs(&self) -> bool {
        [DVec2::X, DVec2::NEG_X]
            .into_iter()
            .any(|way| lowest(&self.curve, way).dot(way) < -0.5 - NEAR)
    }

    /// Its control points at a width and depth (m).
    pub fn points(&self, width: f64, depth: f64) -> Vec<DVec2> {
        let scale = DVec2::new(width, depth);
        let points = self.curve.points().iter();
        points.map(|p| p.truncate() * scale).collect()
    }
}

fn check_points(design: &OwnDesign) -> Result<(), OwnSectionError> {
    let OwnDesign { points, degree, .. } = design;
    let (degree, count) = (*degree, points.len());
    if !(1..=LARGEST_DEGREE).contains(&degree) {
        return Err(OwnSectionError::Degree(degree));
    }
    let least = match design.close {
        Close::Ruled => (degree + 1).max(3),
        Close::Closed => (degree + 1).max(4),
    };
    if count < least {
        return Err(OwnSectionError::Few {
            count,
            degree,
            least,
        });
    }
    for (at, p) in points.iter().enumerate() {
        let index = at + 1;
        // Written so that what is no number fails too.
        if !(p.x.abs() <= FARTHEST && p.y.abs() <= FARTHEST) {
            return Err(OwnSectionError::Far {
                index,
                x: p.x,
                y: p.y,
            });
        }
        if at > 0 && points[at - 1] == *p {
            return Err(OwnSectionError::Same { index });
        }
    }
    let (first, last) = (points[0], points[count - 1]);
    match design.close {
        Close::Ruled => {
            for (index, p, x) in [(1, first, -0.5), (count, last, 0.5)] {
                if p != DVec2::new(x, 0.0) {
                    return Err(OwnSectionError::Rim {
                        index,
                        x: p.x,
                        y: p.y,
                    });
                }
            }
        }
        Close::Closed if first != last => {
            return Err(OwnSectionError::Open {
                index: count,
                x: last.x,
                y: last.y,
            });
        }
        Close::Closed => {}
    }
    if let Some(weights) = &design.weights {
        if weights.len() != count {
            return Err(OwnSectionError::Weights {
                count: weights.len(),
                points: count,
            });
        }
        for (at, value) in weights.iter().enumerate() {
            if !(*value > 0.0 && value.is_finite()) {
                return Err(OwnSectionError::Weight {
                    index: at + 1,
                    value: *value,
                });
            }
        }
    }
    Ok(())
}

fn knots(design: &OwnDesign) -> Result<KnotVector, OwnSectionError> {
    let (points, degree) = (design.points.len(), design.degree);
    let wrong = |error| OwnSectionError::Knots {
        error,
        points,
        degree,
    };
    let Some(knots) = &design.knots else {
        return KnotVector::uniform(degree, points).map_err(wrong);
    };
    if knots.len() != points + degree + 1 {
        return Err(OwnSectionError::Count {
            count: knots.len(),
            points,
            degree,
        });
    }
    // From 0 to 1, as all sections are.
    let checked = KnotVector::new(degree, knots.clone()).map_err(wrong)?;
    let (first, last) = checked.domain();
    let unit = knots.iter().map(|knot| (knot - first) / (last - first));
    KnotVector::new(degree, unit.collect()).map_err(wrong)
}

/// It meets neither itself nor its top, and is below that.
fn check_shape(curve: &Curve, close: Close) -> Result<(), OwnSectionError> {
    let near = |u: f64| nearest_point(curve, u);
    let is_closed = close == Close::Closed;
    let mut curves = vec![curve.clone()];
    if !is_closed {
        let ends = [curve.points().len() - 1, 0].map(|at| curve.points()[at]);
        let line = KnotVector::uniform(1, 2).map_err(|error| OwnSectionError::Knots {
            error,
            points: 2,
            degree: 1,
        })?;
        curves.push(Curve::new(line, ends.to_vec())?);
    }
    match crossing(&curves, true) {
        Some([(0, one), (0, other)]) if one == other => {
            return Err(OwnSectionError::Turn { index: near(one) });
        }
        Some([(0, one), (0, other)]) => {
            return Err(OwnSectionError::Crossing {
                first: near(one),
                second: near(other),
            });
        }
        Some([(0, one), _] | [_, (0, one)]) => {
            return Err(OwnSectionError::Top { index: near(one) });
        }
        None | Some(_) => {}
    }
    let highest = lowest_at(curve, DVec2::NEG_Y);
    if !is_closed && curve.point(highest).y > NEAR {
        return Err(OwnSectionError::Above {
            index: near(highest),
        });
    }
    Ok(())
}

/// The number, from 1, of the control point with the most to say at a parameter.
fn nearest_point(curve: &Curve, u: f64) -> usize {
    let knots = curve.knots();
    let distance = |at: &usize| (knots.greville(*at) - u).abs();
    let nearest = (0..knots.count()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.unwrap_or(0) + 1
}

fn samples(curve: &Curve, each: usize) -> Vec<DVec2> {
    let knots = curve.knots().distinct();
    let mut found = Vec::new();
    for span in knots.windows(2) {
        let along = (0..each).map(|i| i as f64 / each as f64);
        found.extend(along.map(|part| {
            let u = span[0].0 + (span[1].0 - span[0].0) * part;
            curve.point(u).truncate()
        }));
    }
    found.push(curve.point(curve.domain().1).truncate());
    found
}

/// The place that is least along a direction; the middle of several.
fn lowest(curve: &Curve, way: DVec2) -> DVec2 {
    curve.point(lowest_at(curve, way)).truncate()
}

/// Its parameter.
fn lowest_at(curve: &Curve, way: DVec2) -> f64 {
    let height = |u: f64| curve.point(u).truncate().dot(way);
    let knots = curve.knots().distinct();
    let mut candidates = Vec::new();
    for span in knots.windows(2) {
        let (from, to) = (span[0].0, span[1].0);
        let at = |i: usize| from + (to - from) * i as f64 / SEARCHED as f64;
        let least = (0..=SEARCHED)
            .min_by(|i, j| height(at(*i)).total_cmp(&height(at(*j))))
            .unwrap_or(0);
        let (mut a, mut b) = (at(least.saturating_sub(1)), at((least + 1).min(SEARCHED)));
        for _ in 0..NARROWED {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if height(c) <= height(d) {
                b = d;
            } else {
                a = c;
            }
        }
        candidates.extend([at(least), f64::midpoint(a, b), from, to]);
    }
    let least = candidates
        .iter()
        .map(|u| height(*u))
        .fold(f64::INFINITY, f64::min);
    let (from, to) = candidates
        .iter()
        .filter(|u| height(**u) <= least + LEVEL)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), u| {
            (low.min(*u), high.max(*u))
        });
    let (first, last) = curve.domain();
    let middle = f64::midpoint(from, to);
    if to - from < BESIDE * (last - first) || height(middle) > least + LEVEL {
        // What is found beside a knot is at the knot: sections are cut there.
        let knot = knots.iter().map(|knot| knot.0).find(|knot| {
            (knot - from).abs() < BESIDE * (last - first) && height(*knot) <= least + NEAR
        });
        return knot.unwrap_or(from);
    }
    // Of a level floor the middle: in space, not in the parameter.
    let half = curve.point(from).midpoint(curve.point(to)).truncate();
    let along = (curve.point(to) - curve.point(from)).truncate();
    let (mut a, mut b) = (from, to);
    for _ in 0..NARROWED {
        let c = f64::midpoint(a, b);
        if (curve.point(c).truncate() - half).dot(along) < 0.0 {
            a = c;
        } else {
            b = c;
        }
    }
    f64::midpoint(a, b)
}

/// ∮ x dy, with the straight line between its ends.
fn area(curve: &Curve) -> f64 {
    // Spans halved often enough for the integrands of quarter ellipses to be exact to rounding.
    const PARTS: usize = 8;
    let mut sum = 0.0;
    for span in curve.knots().distinct().windows(2) {
        let step = (span[1].0 - span[0].0) / PARTS as f64;
        for part in 0..PARTS {
            let from = span[0].0 + step * part as f64;
            for (u, weight) in between(TEN, from, from + step) {
                let motion = curve.derivatives(u, 1);
                sum += weight * motion[0].x * motion[1].y;
            }
        }
    }
    let (from, to) = curve.domain();
    let (first, last) = (curve.point(from), curve.point(to));
    sum + 0.5 * (first.x + last.x) * (first.y - last.y)
}

#[cfg(test)]
mod tests;
