//! Extrusion: a template carried along a trajectory becomes one surface (\[J19\] §2.4.1, Fig. 5–6).
//!
//! u runs across the section, v along the trajectory. Sections stand perpendicular to the trajectory
//! and upright (z is up, no twist). A net of sections put on a sinuous line would cut its bends, so
//! the sections are *interpolated* in v (one knot vector for all rows of control points, parameters
//! proportional to arc length), and where the surface still leaves the trajectory by more than the
//! tolerance, sections are added between.

use glam::{DVec2, DVec3};

use super::trajectory::{Place, Trajectory};
use crate::nurbs::{Curve, CurveError, KnotVector, Surface, SurfaceError, interpolate};

/// Rounds of refinement; each halves the spans that are out of tolerance.
const ROUNDS: usize = 12;
/// Most sections of one surface.
const MOST_SECTIONS: usize = 20_000;
/// Where a span between two sections is compared with the template, as fractions. Uneven, so that a
/// meander as long as the span cannot hide between them.
const PROBES: [f64; 4] = [0.19, 0.41, 0.62, 0.87];

/// A template placed at one fraction of the trajectory.
#[derive(Clone, Debug)]
pub struct PlacedSection {
    /// Control points: x to the right of the trajectory, y = elevation (m).
    pub points: Vec<DVec2>,
    /// How far the surface may leave the template here (m).
    pub tolerance: f64,
}

/// A bend, or a corner, that is too sharp.
fn bend(s: f64, radius: f64, reach: f64) -> String {
    if radius.is_finite() {
        format!(
            "the bend {s:.0} m along the trajectory has a radius of {radius:.1} m, but the section reaches {reach:.1} m"
        )
    } else {
        format!(
            "the corner near {s:.0} m along the trajectory is too sharp for a section that reaches {reach:.1} m"
        )
    }
}

/// Why a template makes no surface along a trajectory.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExtrusionError<E: std::error::Error> {
    /// The template has no section at a place.
    #[error("{1:.0} m along the trajectory: {0}")]
    Section(#[source] E, f64),
    /// The half-width on the inner side of a bend exceeds its radius, or a corner is too sharp for it.
    #[error(
        "{} towards its inside: the surface would fold over itself; {}",
        bend(*s, *radius, *reach),
        if radius.is_finite() { "widen the bend or narrow the section" } else {
            "round the corner (a trajectory through points has corners with `degree = 1` only) or narrow the section"
        }
    )]
    Fold {
        /// Arc length of the bend (m).
        s: f64,
        /// Radius of curvature (m); infinite beside a corner.
        radius: f64,
        /// Half-width towards the inside (m).
        reach: f64,
    },
    /// Two reaches that are not neighbours come closer than a width.
    #[error(
        "reaches {first:.0} m and {second:.0} m along the trajectory come within {distance:.1} m of each other, \
         nearer than the {needed:.1} m that the section takes: the surface would overlap itself at this neck"
    )]
    Neck {
        /// Arc length of the first reach (m).
        first: f64,
        /// Arc length of the second reach (m).
        second: f64,
        /// Distance between them (m).
        distance: f64,
        /// What the two half-widths need (m).
        needed: f64,
    },
    /// The tolerance is not met with the largest number of sections.
    #[error(
        "{0} sections do not bring the surface within its tolerance: make the trajectory or the profiles smoother"
    )]
    TooManySections(usize),
    /// The net could not be interpolated.
    #[error("the sections cannot be interpolated: {0}")]
    Interpolation(String),
}

/// How densely sections are set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Most turning of the trajectory between two sections (rad).
    pub angle: f64,
    /// Whether the template is the same all along: then a straight trajectory needs two sections.
    pub constant: bool,
}

/// What a template is across: its knots, and its weights if it is rational. Both are the same all along.
#[derive(Clone, Debug, PartialEq)]
pub struct Across {
    /// The knots.
    pub knots: KnotVector,
    /// A weight for each control point.
    pub weights: Option<Vec<f64>>,
}

impl From<KnotVector> for Across {
    fn from(knots: KnotVector) -> Self {
        Self {
            knots,
            weights: None,
        }
    }
}

impl Across {
    /// The template's own curve through section coordinates, z = 0.
    pub fn curve(&self, points: &[DVec2]) -> Result<Curve, CurveError> {
        let points = points.iter().map(|p| p.extend(0.0)).collect();
        match &self.weights {
            None => Curve::new(self.knots.clone(), points),
            Some(weights) => Curve::rational(self.knots.clone(), points, weights.clone()),
        }
    }

    /// The surface of rows of control points along a trajectory, one for each of the template's.
    pub(super) fn surface(
        &self,
        along: &KnotVector,
        net: Vec<DVec3>,
    ) -> Result<Surface, SurfaceError> {
        let knots = self.knots.clone();
        match &self.weights {
            None => Surface::new(knots, along.clone(), net),
            Some(weights) => {
                let each = weights.iter();
                let weights = each.flat_map(|w| std::iter::repeat_n(*w, along.count()));
                Surface::rational(knots, along.clone(), net, weights.collect())
            }
        }
    }
}

/// Which rows of control points are compared with the template between sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guides {
    /// The two outer ones and the middle one: rims and thalweg.
    Outline,
    /// Every one.
    All,
}

/// Rows of control points, one for each of the template's, with the knots that they share.
#[derive(Clone, Debug)]
pub(super) struct Carried {
    /// The knots along.
    pub along: KnotVector,
    /// A row along the trajectory for every control point of the template.
    pub rows: Vec<Vec<DVec3>>,
    /// The v of the sections.
    pub sections: Vec<f64>,
}

/// Carries a template along a trajectory.
///
/// `section` gives the template at a fraction 0..1 of the length; every call must return the same
/// number of control points. `across` has the knots across. Returns the surface and the v of its
/// sections: there, and only there, the surface is exactly the template, so flat and upright.
pub fn extrude<E: std::error::Error>(
    trajectory: &Trajectory,
    across: &Across,
    limits: Limits,
    guides: Guides,
    section: &dyn Fn(f64) -> Result<PlacedSection, E>,
) -> Result<(Surface, Vec<f64>), ExtrusionError<E>> {
    let carried = carry(trajectory, limits, &[], guides, section)?;
    let surface = across
        .surface(&carried.along, carried.rows.concat())
        .map_err(|error| ExtrusionError::Interpolation(error.to_string()))?;
    Ok((surface, carried.sections))
}

/// The rows of control points of whatever is carried along a trajectory, with sections at given fractions of its length
/// besides those that are needed.
pub(super) fn carry<E: std::error::Error>(
    trajectory: &Trajectory,
    limits: Limits,
    at: &[f64],
    guides: Guides,
    section: &dyn Fn(f64) -> Result<PlacedSection, E>,
) -> Result<Carried, ExtrusionError<E>> {
    let builder = Builder {
        trajectory,
        section,
        guides,
    };
    builder.check_room()?;
    let mut stations = trajectory.stations(limits.angle);
    for fraction in at {
        include(&mut stations, fraction * trajectory.length());
    }
    if !(limits.constant && trajectory.is_straight()) {
        thicken(&mut stations);
    }
    for _ in 0..ROUNDS {
        let (along, rows) = builder.rows(&stations)?;
        let refined = builder.refine(&stations, &along, &rows)?;
        if refined.len() == stations.len() {
            builder.check_folds(&along, &rows)?;
            let sections = builder.parameters(&stations);
            return Ok(Carried {
                along,
                rows,
                sections,
            });
        }
        stations = refined;
        if stations.len() > MOST_SECTIONS {
            break;
        }
    }
    Err(ExtrusionError::TooManySections(stations.len()))
}

/// Of a station that is asked for: how near another one is replaced by it, as a fraction of the mean spacing.
const SLIVER: f64 = 0.05;

/// Puts a station among the others, in place of an inner one that is nearly there.
fn include(stations: &mut Vec<f64>, s: f64) {
    let last = stations.len() - 1;
    let near = SLIVER * stations[last] / last as f64;
    if !(s > 0.0 && s < stations[last]) {
        return;
    }
    let ends = [stations[0], stations[last]];
    stations.retain(|one| ends.contains(one) || (one - s).abs() > near);
    let at = stations.partition_point(|one| *one < s);
    stations.insert(at, s);
}

/// Fewer than four sections cannot carry a cubic: halve the spans until there are enough.
fn thicken(stations: &mut Vec<f64>) {
    while stations.len() < 5 {
        *stations = halved(stations, |_| true);
    }
}

/// Stations with a new one in the middle of every chosen span.
fn halved(stations: &[f64], chosen: impl Fn(usize) -> bool) -> Vec<f64> {
    let mut result = vec![stations[0]];
    for (i, pair) in stations.windows(2).enumerate() {
        if chosen(i) {
            result.push(f64::midpoint(pair[0], pair[1]));
        }
        result.push(pair[1]);
    }
    result
}

struct Builder<'a, E: std::error::Error> {
    trajectory: &'a Trajectory,
    section: &'a dyn Fn(f64) -> Result<PlacedSection, E>,
    guides: Guides,
}

impl<E: std::error::Error> Builder<'_, E> {
    fn place(&self, s: f64) -> Result<(Place, PlacedSection), ExtrusionError<E>> {
        let section = (self.section)(s / self.trajectory.length())
            .map_err(|error| ExtrusionError::Section(error, s))?;
        Ok((self.trajectory.at(s), section))
    }

    /// v of each station: its fraction of the length.
    fn parameters(&self, stations: &[f64]) -> Vec<f64> {
        let length = self.trajectory.length();
        stations.iter().map(|s| s / length).collect()
    }

    /// Rows of control points, each through all stations, and their common knot vector.
    fn rows(&self, stations: &[f64]) -> Result<(KnotVector, Vec<Vec<DVec3>>), ExtrusionError<E>> {
        let mut rows: Vec<Vec<DVec3>> = Vec::new();
        for &s in stations {
            let (place, section) = self.place(s)?;
            rows.resize_with(section.points.len(), Vec::new);
            for (row, point) in rows.iter_mut().zip(&section.points) {
                row.push(stand(&place, *point));
            }
        }
        let degree = 3.min(stations.len() - 1);
        interpolate::with_parameters(&rows, &self.parameters(stations), degree)
            .map_err(|error| ExtrusionError::Interpolation(error.to_string()))
    }

    /// Stations with new ones where the guides leave the template.
    fn refine(
        &self,
        stations: &[f64],
        along: &KnotVector,
        rows: &[Vec<DVec3>],
    ) -> Result<Vec<f64>, ExtrusionError<E>> {
        let guides = match self.guides {
            Guides::Outline => vec![0, rows.len() / 2, rows.len() - 1],
            Guides::All => (0..rows.len()).collect(),
        };
        let curves = guides
            .iter()
            .map(|&row| Curve::new(along.clone(), rows[row].clone()))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|error| ExtrusionError::Interpolation(error.to_string()))?;
        let length = self.trajectory.length();
        let mut out = vec![false; stations.len() - 1];
        for (span, pair) in stations.windows(2).enumerate() {
            for probe in PROBES {
                let s = pair[0] + (pair[1] - pair[0]) * probe;
                let (place, section) = self.place(s)?;
                let along = place.tangent().extend(0.0);
                for (curve, &row) in curves.iter().zip(&guides) {
                    let miss = curve.point(s / length) - stand(&place, section.points[row]);
                    // What lies along the trajectory is only a shift of parameter.
                    if (miss - along * along.dot(miss)).length() > section.tolerance {
                        out[span] = true;
                    }
                }
            }
        }
        Ok(halved(stations, |span| out[span]))
    }

    /// Bends and necks against the width, before any surface is made.
    fn check_room(&self) -> Result<(), ExtrusionError<E>> {
        let (left, right) = self.trajectory.sharpest();
        let sharpest = left.max(right);
        if sharpest == 0.0 {
            return Ok(());
        }
        let mut reaches = Vec::with_capacity(self.trajectory.places().len());
        for place in self.trajectory.places() {
            let (_, section) = self.place(place.s)?;
            let (low, high) = section
                .points
                .iter()
                .fold((0.0_f64, 0.0_f64), |(low, high), p| {
                    (low.min(p.x), high.max(p.x))
                });
            let reach = if place.curvature > 0.0 { -low } else { high };
            if reach * place.curvature.abs() >= 1.0 {
                let radius = 1.0 / place.curvature.abs();
                return Err(ExtrusionError::Fold {
                    s: place.s,
                    radius,
                    reach,
                });
            }
            reaches.push((-low, high));
        }
        self.check_necks(sharpest, &reaches)
    }

    /// Reaches further apart than a half circle of the sharpest bend must keep their widths apart.
    ///
    /// By Schur's comparison theorem a chord over an arc ℓ ≤ π/κ is at least (2/κ) sin(κℓ/2), so the
    /// two ends of such a half circle are 2/κ apart: more than the section takes once bends do not
    /// fold. Only longer arcs need a look.
    fn check_necks(&self, sharpest: f64, reaches: &[(f64, f64)]) -> Result<(), ExtrusionError<E>> {
        let trajectory = self.trajectory;
        let places = trajectory.places();
        let widest = reaches
            .iter()
            .map(|(left, right)| left.max(*right))
            .fold(0.0, f64::max);
        let apart = std::f64::consts::PI / sharpest;
        let length = trajectory.length();
        // Every place within an eighth of the widest half-width of another is as good as that one.
        let grain = widest / 8.0;
        let reach = |place: &Place, towards: DVec2| {
            let (left, right) = reaches[places
                .partition_point(|p| p.s < place.s)
                .min(places.len() - 1)];
            if place.right().dot(towards) > 0.0 {
                right
            } else {
                left
            }
        };
        let mut s = 0.0;
        while s + apart <= length {
            let a = trajectory.at(s);
            let mut t = s + apart;
            while t <= length {
                let b = trajectory.at(t);
                let across = b.point - a.point;
                let distance = across.length();
                // A chord changes no faster than the arc: nothing nearer than two half-widths can
                // come before the difference.
                let clear = distance - 2.0 * widest;
                if clear < 0.0 {
                    let needed = reach(&a, across) + reach(&b, -across);
                    if distance < needed {
                        return Err(ExtrusionError::Neck {
                            first: s,
                            second: t,
                            distance,
                            needed,
                        });
                    }
                }
                t += clear.max(grain);
            }
            s += grain;
        }
        Ok(())
    }

    /// The finished rows must run forwards everywhere, or the surface folds between its sections.
    fn check_folds(
        &self,
        along: &KnotVector,
        rows: &[Vec<DVec3>],
    ) -> Result<(), ExtrusionError<E>> {
        let length = self.trajectory.length();
        let knots = along.distinct();
        for row in rows {
            let curve = Curve::new(along.clone(), row.clone())
                .map_err(|error| ExtrusionError::Interpolation(error.to_string()))?;
            for span in knots.windows(2) {
                for probe in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let v = span[0].0 + (span[1].0 - span[0].0) * probe;
                    let place = self.trajectory.at(v * length);
                    let velocity = curve.derivatives(v, 1)[1].truncate();
                    if velocity.dot(place.tangent()) <= 0.0 {
                        let radius = 1.0 / place.curvature.abs();
                        let reach = curve.point(v).truncate().distance(place.point);
                        return Err(ExtrusionError::Fold {
                            s: place.s,
                            radius,
                            reach,
                        });
                    }
                }
            }
        }
        Ok(())
    }
}

/// A section's point in space: upright, perpendicular to the trajectory.
pub(super) fn stand(place: &Place, point: DVec2) -> DVec3 {
    (place.point + place.right() * point.x).extend(point.y)
}
