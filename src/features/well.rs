//! Wells: NURBS curves through the stations of a survey (\[J19\] §2.6, Eq. 7–9, Fig. 2), with measured depth along them.
//!
//! Two paths. A *spline* interpolates all stations, cubic where there are four. *Minimum curvature* joins them by arcs of circles, each an
//! exact rational quadratic: with β the turn and L the length, `P₁ = P₀ + t₁ (L/β) tan(β/2)` has the weight `cos(β/2)`.
//!
//! Stations keep their measured depth; between two of them it grows in proportion to the arc length, so it is monotone and the same
//! whatever the curve's parameter is. Of an arc both are the same; a spline through stations 30 m apart that turn by 3° is longer by
//! some 4e-5 of it.
//!
//! A lateral shares control points with its mother: she gets a knot of full multiplicity where it leaves her, which changes no shape; the
//! control point there is its first one, bit for bit, and its second lies on her tangent. So a bore from the wellhead is her control
//! points up to there, and then its own.

use glam::DVec3;

use super::survey::{self, Station, SurveyError, half_factor, turn};
use crate::nurbs::interpolate::{self, InterpolateError, Parametrization};
use crate::nurbs::{ArcLength, Curve, CurveError, KnotError, KnotVector, RefineError};

/// How stations are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// By a spline through all of them.
    Spline(Parametrization),
    /// By arcs of circles.
    MinimumCurvature,
}

/// To this (m) places are found by their measured depth, and depths by their places.
pub const EXACT: f64 = 1e-9;

/// A degree that is enough for a smooth curvature.
const DEGREE: usize = 3;

/// Why there is no path through some stations.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WellError {
    /// The survey is wrong.
    #[error(transparent)]
    Survey(#[from] SurveyError),
    /// An arc needs directions.
    #[error("station {station} has no direction, and arcs of minimum curvature need one")]
    NoDirection {
        /// Which, from 1.
        station: usize,
    },
    /// A depth at which there is no well.
    #[error("there is nothing at a measured depth of {md} m: it goes from {from} to {to} m")]
    Beyond {
        /// The depth asked for.
        md: f64,
        /// Its first depth.
        from: f64,
        /// Its last depth.
        to: f64,
    },
    /// The spline does not exist.
    #[error("no spline passes through its stations: {0}")]
    Interpolate(#[from] InterpolateError),
    /// There are no knots.
    #[error("its path has no knots: {0}")]
    Knots(#[from] KnotError),
    /// The control points are wrong.
    #[error("its path is no curve: {0}")]
    Curve(#[from] CurveError),
    /// The junction cannot be made.
    #[error("its path cannot be parted: {0}")]
    Refine(#[from] RefineError),
}

/// Where a station is on the path.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mark {
    md: f64,
    u: f64,
    /// The length of the path from here to the next one (m).
    length: f64,
}

/// A path with measured depths.
#[derive(Clone, Debug)]
pub struct Well {
    curve: Curve,
    lengths: ArcLength,
    marks: Vec<Mark>,
    stations: Vec<Station>,
}

/// What is to be said of a survey.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// The greatest turn for each 30 m between two stations (degrees).
    pub dogleg_deg_30m: f64,
    /// The measured depth at which that is: the lower station of both (m).
    pub dogleg_md: f64,
    /// All turns together over the length (degrees/m).
    pub tortuosity_deg_m: f64,
    /// By what part the way is longer than the straight line from its first to its last station.
    pub excess: f64,
    /// Least, mean and greatest distance between stations, along the hole (m).
    pub spacing: [f64; 3],
    /// By what part the path between two stations differs most from their difference in measured depth.
    pub misfit: f64,
    /// The measured depth of the lower one of both (m).
    pub misfit_md: f64,
}

impl PartialEq for Well {
    fn eq(&self, other: &Self) -> bool {
        self.curve == other.curve && self.marks == other.marks && self.stations == other.stations
    }
}

impl Well {
    /// The path through stations.
    pub fn new(stations: Vec<Station>, path: Path) -> Result<Self, WellError> {
        survey::check(&stations)?;
        let (curve, params) = match path {
            Path::Spline(spacing) => spline(&stations, spacing)?,
            Path::MinimumCurvature => arcs(&stations)?,
        };
        Ok(Self::measured(curve, &params, stations))
    }

    /// A lateral from a depth of its mother, through stations below that. The mother has a knot for it already: see
    /// [`Self::with_junction`].
    pub fn lateral(
        mother: &Self,
        at_md: f64,
        below: &[Station],
        path: Path,
    ) -> Result<Self, WellError> {
        let (point, tangent) = mother.junction(at_md)?;
        let first = Station {
            md: Some(at_md),
            point,
            tangent: Some(tangent),
        };
        let mut stations = vec![first];
        stations.extend_from_slice(below);
        survey::check(&stations)?;
        let (curve, params) = match path {
            Path::Spline(spacing) => kicked_off(&stations, tangent, spacing)?,
            Path::MinimumCurvature => arcs(&stations)?,
        };
        // The mother's control point, bit for bit.
        let curve = curve.with_control_point(0, point)?;
        Ok(Self::measured(curve, &params, stations))
    }

    fn measured(curve: Curve, params: &[f64], stations: Vec<Station>) -> Self {
        let lengths = ArcLength::new(&curve);
        let mut marks: Vec<Mark> = Vec::with_capacity(stations.len());
        let mut reached = 0.0;
        for (at, (station, u)) in stations.iter().zip(params).enumerate() {
            if let Some(before) = marks.last_mut() {
                before.length = lengths.between(before.u, *u, 0.01 * EXACT);
                reached += before.length;
            }
            let first = stations[0].md.unwrap_or(0.0);
            let md = station.md.unwrap_or(first + reached);
            debug_assert!(at == 0 || marks[at - 1].md < md);
            marks.push(Mark {
                md,
                u: *u,
                length: 0.0,
            });
        }
        Self {
            curve,
            lengths,
            marks,
            stations,
        }
    }

    /// The same well with a knot of full multiplicity at a depth: its shape is unchanged, and it has a control point there.
    pub fn with_junction(&self, md: f64) -> Result<Self, WellError> {
        let u = self.parameter(md).ok_or_else(|| self.beyond(md))?;
        let (start, end) = self.curve.domain();
        if !(u > start && u < end) {
            return Ok(self.clone());
        }
        let knots = self.curve.knots().distinct();
        let nearest = knots
            .iter()
            .min_by(|a, b| (a.0 - u).abs().total_cmp(&(b.0 - u).abs()));
        let same = 1e-12 * (end - start);
        let (u, present) = match nearest {
            Some((knot, count)) if (knot - u).abs() <= same => (*knot, *count),
            _ => (u, 0),
        };
        let missing = self.curve.degree().saturating_sub(present);
        let curve = if missing == 0 {
            self.curve.clone()
        } else {
            self.curve.insert_knot(u, missing)?
        };
        Ok(Self {
            lengths: ArcLength::new(&curve),
            curve,
            marks: self.marks.clone(),
            stations: self.stations.clone(),
        })
    }

    /// The control point at a depth with a knot of full multiplicity, and the tangent there.
    fn junction(&self, md: f64) -> Result<(DVec3, DVec3), WellError> {
        let u = self.parameter(md).ok_or_else(|| self.beyond(md))?;
        let place = self.curve.point(u);
        let points = self.curve.points();
        let shared = points.iter().min_by(|a, b| {
            a.distance_squared(place)
                .total_cmp(&b.distance_squared(place))
        });
        let tangent = self.curve.tangent(u).unwrap_or(DVec3::NEG_Z);
        Ok((shared.copied().unwrap_or(place), tangent))
    }

    /// The whole bore of a lateral, from its mother's wellhead: her path down to the junction, and then its own.
    pub fn bore_from(&self, mother: &Self) -> Result<Vec<Curve>, WellError> {
        let (md, _) = self.range();
        let u = mother.parameter(md).ok_or_else(|| mother.beyond(md))?;
        let (start, end) = mother.curve.domain();
        let above = if u >= end {
            vec![mother.curve.clone()]
        } else if u > start {
            vec![mother.curve.split(u)?.0]
        } else {
            Vec::new()
        };
        Ok(above.into_iter().chain([self.curve.clone()]).collect())
    }

    fn beyond(&self, md: f64) -> WellError {
        let (from, to) = self.range();
        WellError::Beyond { md, from, to }
    }

    /// The path.
    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// The stations.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// First and last measured depth (m).
    pub fn range(&self) -> (f64, f64) {
        let last = self.marks.len() - 1;
        (self.marks[0].md, self.marks[last].md)
    }

    /// Measured depths of the stations (m).
    pub fn depths(&self) -> impl Iterator<Item = f64> {
        self.marks.iter().map(|mark| mark.md)
    }

    /// The curve's parameter at a measured depth (m); none beyond its ends.
    pub fn parameter(&self, md: f64) -> Option<f64> {
        let (first, last) = self.range();
        if !(md >= first && md <= last) {
            return None;
        }
        let below = self.marks.partition_point(|mark| mark.md <= md);
        let Some(next) = self.marks.get(below) else {
            return Some(self.marks[below - 1].u);
        };
        let own = self.marks[below - 1];
        if md == own.md {
            return Some(own.u);
        }
        let part = (md - own.md) / (next.md - own.md);
        Some(
            self.lengths
                .parameter([own.u, next.u], part * own.length, 0.1 * EXACT),
        )
    }

    /// The measured depth at a parameter of the curve (m).
    pub fn md(&self, u: f64) -> f64 {
        let last = self.marks.len() - 1;
        let below = self
            .marks
            .partition_point(|mark| mark.u <= u)
            .clamp(1, last);
        let (own, next) = (self.marks[below - 1], self.marks[below]);
        if u <= own.u {
            return own.md;
        }
        if u >= next.u {
            return next.md;
        }
        let length = self.lengths.between(own.u, u, 0.1 * EXACT);
        own.md + length / own.length * (next.md - own.md)
    }

    /// The place at a measured depth (m); at an end of it beyond its ends.
    pub fn point(&self, md: f64) -> DVec3 {
        let (first, last) = self.range();
        let u = self.parameter(md.clamp(first, last));
        self.curve.point(u.unwrap_or(self.marks[0].u))
    }

    /// The direction at a measured depth (m).
    pub fn tangent(&self, md: f64) -> DVec3 {
        let (first, last) = self.range();
        let u = self.parameter(md.clamp(first, last));
        self.curve
            .tangent(u.unwrap_or(self.marks[0].u))
            .unwrap_or(DVec3::NEG_Z)
    }

    /// What is to be said of its survey: by measured directions, where there are any, else by those of the path.
    pub fn quality(&self) -> Quality {
        let along = |at: usize| {
            let measured = self.stations[at].tangent;
            measured
                .or_else(|| self.curve.tangent(self.marks[at].u))
                .unwrap_or(DVec3::NEG_Z)
        };
        let spans = self.marks.len() - 1;
        let (first, last) = self.range();
        let mut quality = Quality {
            dogleg_deg_30m: 0.0,
            dogleg_md: first,
            tortuosity_deg_m: 0.0,
            excess: 0.0,
            spacing: [f64::INFINITY, (last - first) / spans as f64, 0.0],
            misfit: 0.0,
            misfit_md: first,
        };
        let mut turned = 0.0;
        for (at, pair) in self.marks.windows(2).enumerate() {
            let apart = pair[1].md - pair[0].md;
            let turn = turn(along(at), along(at + 1)).to_degrees();
            turned += turn;
            if turn / apart * 30.0 > quality.dogleg_deg_30m {
                quality.dogleg_deg_30m = turn / apart * 30.0;
                quality.dogleg_md = pair[1].md;
            }
            let misfit = (pair[0].length / apart - 1.0).abs();
            if misfit > quality.misfit {
                quality.misfit = misfit;
                quality.misfit_md = pair[1].md;
            }
            quality.spacing[0] = quality.spacing[0].min(apart);
            quality.spacing[2] = quality.spacing[2].max(apart);
        }
        quality.tortuosity_deg_m = turned / (last - first);
        let (start, end) = (self.stations[0].point, self.stations[spans].point);
        quality.excess = (last - first) / start.distance(end) - 1.0;
        quality
    }
}

/// A spline through stations, and its parameters at them.
fn spline(stations: &[Station], spacing: Parametrization) -> Result<(Curve, Vec<f64>), WellError> {
    let points: Vec<DVec3> = stations.iter().map(|station| station.point).collect();
    let params = interpolate::parameters(&points, spacing)?;
    let degree = DEGREE.min(points.len() - 1);
    let (knots, mut rows) = interpolate::with_parameters(&[points], &params, degree)?;
    Ok((Curve::new(knots, rows.swap_remove(0))?, params))
}

/// A spline through stations that begins in a direction.
///
/// A further point between the first two stations is free. The spline depends on it linearly, and so does the derivative at its
/// start: two interpolations tell where it has to be for that to be what is wanted.
fn kicked_off(
    stations: &[Station],
    tangent: DVec3,
    spacing: Parametrization,
) -> Result<(Curve, Vec<f64>), WellError> {
    let points: Vec<DVec3> = stations.iter().map(|station| station.point).collect();
    let params = interpolate::parameters(&points, spacing)?;
    let speed = points[0].distance(points[1]) / params[1];
    let mut all = params.clone();
    all.insert(1, 0.5 * params[1]);
    let mut through = points.clone();
    through.insert(1, points[0].midpoint(points[1]));
    let mut response = vec![DVec3::ZERO; through.len()];
    response[1] = DVec3::X;
    let degree = DEGREE.min(through.len() - 1);
    let (knots, rows) = interpolate::with_parameters(&[through.clone(), response], &all, degree)?;
    let curve = Curve::new(knots.clone(), rows[0].clone())?;
    let start = |row: &[DVec3]| {
        let span = knots.as_slice()[degree + 1] - knots.as_slice()[degree];
        (row[1] - row[0]) * (degree as f64 / span)
    };
    let missing = tangent * speed - start(curve.points());
    let by = missing / start(&rows[1]).x;
    let points = rows[0]
        .iter()
        .zip(&rows[1])
        .map(|(own, one)| *own + one.x * by)
        .collect();
    Ok((Curve::new(knots, points)?, params))
}

/// Arcs through stations, with measured depth as parameter.
fn arcs(stations: &[Station]) -> Result<(Curve, Vec<f64>), WellError> {
    let mut params = Vec::with_capacity(stations.len());
    let mut reached = stations[0].md.unwrap_or(0.0);
    let (mut knots, mut points, mut weights) = (Vec::new(), Vec::new(), Vec::new());
    for (at, station) in stations.iter().enumerate() {
        let Some(tangent) = station.tangent else {
            return Err(WellError::NoDirection { station: at + 1 });
        };
        if let Some(before) = at.checked_sub(1).map(|k| stations[k]) {
            let turn = turn(before.tangent.unwrap_or(tangent), tangent);
            let chord = before.point.distance(station.point);
            let along = station.md.map_or(chord, |md| md - reached);
            reached += along;
            points
                .push(before.point + along * half_factor(turn) * before.tangent.unwrap_or(tangent));
            weights.push((0.5 * turn).cos());
        }
        let times = if at == 0 || at + 1 == stations.len() {
            3
        } else {
            2
        };
        knots.extend(std::iter::repeat_n(reached, times));
        params.push(reached);
        points.push(station.point);
        weights.push(1.0);
    }
    let knots = KnotVector::new(2, knots)?;
    Ok((Curve::rational(knots, points, weights)?, params))
}

#[cfg(test)]
#[path = "well_tests.rs"]
mod tests;
