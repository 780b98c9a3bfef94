//! Control nets of one's own: points, degrees, weights and knots as someone gives them (\[J19\] §2.2–2.3, Fig. 3).

use glam::{DVec3, DVec4};

use crate::nurbs::{KnotError, KnotVector, RefineError, Surface, SurfaceError};

/// The degree along a direction in which there are enough points, if none is given.
const DEGREE: usize = 3;
/// How often a patch is halved both ways while it is looked for a place in which it folds.
const HALVINGS: usize = 7;

/// Why a net is no sheet. Rows, places in a row and knots are counted from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NetError {
    /// Rows of different lengths.
    #[error(
        "row {row} of its {what} has {found} entries, the first row {needed}; give every row as many"
    )]
    Ragged {
        /// Points or weights.
        what: &'static str,
        /// The row.
        row: usize,
        /// Its entries.
        found: usize,
        /// Those of the first row.
        needed: usize,
    },
    /// Weights are not as many as points.
    #[error("it has {points} rows of points, but {weights} of weights; give each point a weight")]
    WeightRows {
        /// Rows of points.
        points: usize,
        /// Rows of weights.
        weights: usize,
    },
    /// A weight is not positive.
    #[error("the weight of point {place} in row {row} is {value}; weights must be above 0")]
    Weight {
        /// The row.
        row: usize,
        /// The place in it.
        place: usize,
        /// The weight.
        value: f64,
    },
    /// The knots of a direction are none.
    #[error("{}: {error}", if *is_across { "from row to row" } else { "along the rows" })]
    Knots {
        /// Whether they count the rows.
        is_across: bool,
        /// What is wrong.
        error: KnotError,
    },
    /// There are more or fewer knots than points and degree ask for.
    #[error(
        "{} it has {points} points and degree {degree}, so {} knots, but {found} are given: the first and the last one degree + 1 times, \
         and points − degree − 1 between",
        if *is_across { "from row to row" } else { "along the rows" },
        points + degree + 1
    )]
    KnotCount {
        /// Whether they count the rows.
        is_across: bool,
        /// Points in that direction.
        points: usize,
        /// The degree.
        degree: usize,
        /// Knots that are given.
        found: usize,
    },
    /// The net is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// It cannot be divided at its kinks.
    #[error("it cannot be divided at its kinks: {0}")]
    Divide(#[from] RefineError),
}

/// A net as it is given: rows of points, u from row to row and v along them.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct NetDesign {
    /// Control points (m).
    pub points: Vec<Vec<DVec3>>,
    /// Degrees from row to row and along the rows; 3, or less if there are few points, where none is given.
    pub degree: [Option<usize>; 2],
    /// Weights, as many as points; all 1 if there are none.
    pub weights: Vec<Vec<f64>>,
    /// Whole clamped knot vectors; uniform ones where none is given.
    pub knots: [Option<Vec<f64>>; 2],
}

impl NetDesign {
    /// The surface.
    pub fn build(&self) -> Result<Surface, NetError> {
        let columns = self.points.first().map_or(0, Vec::len);
        let even = |what: &'static str, lengths: &mut dyn Iterator<Item = usize>| {
            let mut lengths = lengths.enumerate();
            match lengths.find(|(_, found)| *found != columns) {
                Some((row, found)) => Err(NetError::Ragged {
                    what,
                    row: row + 1,
                    found,
                    needed: columns,
                }),
                None => Ok(()),
            }
        };
        even("points", &mut self.points.iter().map(Vec::len))?;
        let across = self.knots(0, self.points.len())?;
        let along = self.knots(1, columns)?;
        let net = self.points.concat();
        if self.weights.is_empty() {
            return Ok(Surface::new(across, along, net)?);
        }
        if self.weights.len() != self.points.len() {
            return Err(NetError::WeightRows {
                points: self.points.len(),
                weights: self.weights.len(),
            });
        }
        even("weights", &mut self.weights.iter().map(Vec::len))?;
        for (row, weights) in self.weights.iter().enumerate() {
            for (place, &value) in weights.iter().enumerate() {
                if !(value > 0.0 && value.is_finite()) {
                    return Err(NetError::Weight {
                        row: row + 1,
                        place: place + 1,
                        value,
                    });
                }
            }
        }
        let weights = self.weights.concat();
        Ok(Surface::rational(across, along, net, weights)?)
    }

    fn knots(&self, direction: usize, points: usize) -> Result<KnotVector, NetError> {
        let is_across = direction == 0;
        let wrong = |error: KnotError| NetError::Knots { is_across, error };
        let degree =
            self.degree[direction].unwrap_or_else(|| DEGREE.min(points.saturating_sub(1)).max(1));
        let Some(knots) = &self.knots[direction] else {
            return KnotVector::uniform(degree, points).map_err(wrong);
        };
        if knots.len() != points + degree + 1 {
            return Err(NetError::KnotCount {
                is_across,
                points,
                degree,
                found: knots.len(),
            });
        }
        KnotVector::new(degree, knots.clone()).map_err(wrong)
    }
}

/// How different the speeds on both sides of a knot may be for a surface that has no kink there, as a fraction of them.
const NO_KINK: f64 = 1e-9;

/// The parts of a surface between its kinks: knots that are there as often as the degree says, at which its speed jumps somewhere.
pub fn smooth_parts(surface: &Surface) -> Result<Vec<Surface>, NetError> {
    // All of the surface is divided at each, so that parts have whole sides in common.
    let along_u = kinks_along_v(&surface.transposed())?;
    let mut parts = Vec::new();
    for strip in divided_along_v(surface, &kinks_along_v(surface)?)? {
        let own = divided_along_v(&strip.transposed(), &along_u)?;
        parts.extend(own.iter().map(Surface::transposed));
    }
    Ok(parts)
}

/// The v at which a surface has kinks.
fn kinks_along_v(surface: &Surface) -> Result<Vec<f64>, NetError> {
    let knots = surface.knots_v();
    let all = knots.distinct();
    let mut kinks = Vec::new();
    for (knot, count) in &all[1..all.len() - 1] {
        if *count < knots.degree() {
            continue;
        }
        let (before, after) = surface.split_v(*knot)?;
        let ends = [end_speeds(&before, true), end_speeds(&after, false)];
        let greatest = ends.iter().flatten().map(|speed| speed.length());
        let most = NO_KINK * greatest.fold(0.0, f64::max);
        let mut pairs = ends[0].iter().zip(&ends[1]);
        if pairs.any(|(one, other)| one.distance(*other) > most) {
            kinks.push(*knot);
        }
    }
    Ok(kinks)
}

/// The parts of a surface between some v.
fn divided_along_v(surface: &Surface, at: &[f64]) -> Result<Vec<Surface>, NetError> {
    let mut parts = Vec::new();
    let mut rest = surface.clone();
    for v in at {
        let (before, after) = rest.split_v(*v)?;
        parts.push(before);
        rest = after;
    }
    parts.push(rest);
    Ok(parts)
}

/// How fast the rows of a surface run at the end, or at the start, of v, in homogeneous coordinates.
fn end_speeds(surface: &Surface, at_end: bool) -> Vec<DVec4> {
    let knots = surface.knots_v();
    let (q, count, all) = (knots.degree(), knots.count(), knots.as_slice());
    let span = if at_end {
        all[count] - all[count - 1]
    } else {
        all[q + 1] - all[q]
    };
    let first = if at_end { count - 2 } else { 0 };
    let homogeneous = |k: usize| {
        let w = surface.weights()[k];
        (surface.net()[k] * w).extend(w)
    };
    let rows = surface.knots_u().count();
    let speed = |row: usize| {
        let at = row * count + first;
        (homogeneous(at + 1) - homogeneous(at)) * (q as f64 / span)
    };
    (0..rows).map(speed).collect()
}

/// A place at which a surface cannot be told to run one way round in plan: it folds there, or stands upright.
///
/// With homogeneous points P = (w x, w y, w) the plan's Jacobian is det(P, `P_u`, `P_v`)/w³. Its coefficients are sums of determinants of
/// control points and of differences of them: where all of these have one sign, so has the Jacobian. Else the patch is halved.
pub fn fold_in_plan(surface: &Surface) -> Option<DVec3> {
    surface
        .bezier_patches()
        .find_map(|patch| fold_of_patch(&patch, HALVINGS))
}

fn fold_of_patch(patch: &Surface, halvings: usize) -> Option<DVec3> {
    if runs_one_way(patch) {
        return None;
    }
    let ((u0, u1), (v0, v1)) = (patch.knots_u().domain(), patch.knots_v().domain());
    let (u, v) = (f64::midpoint(u0, u1), f64::midpoint(v0, v1));
    let d = patch.derivatives(u, v, 1);
    let turns = |a: DVec3, b: DVec3| a.x * b.y - a.y * b.x;
    if halvings == 0 || !(turns(d[1][0], d[0][1]) > 0.0) {
        return Some(d[0][0]);
    }
    // A patch that cannot be halved is as fine as numbers are.
    let (Ok((low, high)), at) = (patch.split_u(u), d[0][0]) else {
        return Some(d[0][0]);
    };
    for half in [low, high] {
        match half.split_v(v) {
            Ok((a, b)) => {
                for quarter in [a, b] {
                    if let Some(fold) = fold_of_patch(&quarter, halvings - 1) {
                        return Some(fold);
                    }
                }
            }
            Err(_) => return Some(at),
        }
    }
    None
}

/// Whether all coefficients say that a patch runs counterclockwise in plan.
fn runs_one_way(patch: &Surface) -> bool {
    let (nu, nv) = (patch.knots_u().count(), patch.knots_v().count());
    // About the patch's own middle: far from the origin the differences would be lost.
    let middle = patch.net()[(nu / 2) * nv + nv / 2];
    let points: Vec<DVec3> = patch
        .net()
        .iter()
        .zip(patch.weights())
        .map(|(p, w)| ((*p - middle) * *w).with_z(*w))
        .collect();
    let at = |i: usize, j: usize| points[i * nv + j];
    let mut along_u = Vec::new();
    let mut along_v = Vec::new();
    for i in 0..nu {
        for j in 0..nv {
            if i + 1 < nu {
                along_u.push(at(i + 1, j) - at(i, j));
            }
            if j + 1 < nv {
                along_v.push(at(i, j + 1) - at(i, j));
            }
        }
    }
    if patch.is_rational() {
        along_u.iter().all(|a| {
            along_v
                .iter()
                .all(|b| points.iter().all(|p| p.dot(a.cross(*b)) > 0.0))
        })
    } else {
        along_u
            .iter()
            .all(|a| along_v.iter().all(|b| a.x * b.y - a.y * b.x > 0.0))
    }
}

#[cfg(test)]
#[path = "net_tests.rs"]
mod tests;
