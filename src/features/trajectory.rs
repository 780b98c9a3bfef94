//! Trajectories: the plan-view lines along which templates are carried (\[J19\] §2.4.1, Fig. 5).
//!
//! Arc length `s` in metres, direction θ in radians counterclockwise from east, curvature κ = dθ/ds
//! (positive turns left). Every kind is kept the same way: samples exact in place, direction and
//! curvature, dense enough that cubic Hermite pieces between them miss the line by less than
//! 10⁻⁶ of the radius of curvature.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use crate::nurbs::interpolate::{self, Parametrization};
use crate::nurbs::quadrature::FIVE_ON_UNIT;

/// Samples in one span of an interpolated curve.
const SAMPLES_PER_SPAN: usize = 32;
/// Samples of a parametric curve.
const PARAMETRIC_SAMPLES: usize = 2048;
/// Least length of a line beside another one, as a fraction of that one's: what is less is a fold, or next to it.
const LEAST_STRETCH: f64 = 0.02;

/// One exactly known place on a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Arc length from the start (m).
    pub s: f64,
    /// Easting and northing (m).
    pub point: DVec2,
    /// Direction θ, continuous along the trajectory (rad).
    pub direction: f64,
    /// Curvature κ (1/m), positive to the left.
    pub curvature: f64,
}

impl Place {
    /// Unit vector along the trajectory.
    pub fn tangent(&self) -> DVec2 {
        DVec2::from_angle(self.direction)
    }

    /// Unit vector to the right, looking down the trajectory.
    pub fn right(&self) -> DVec2 {
        let t = self.tangent();
        DVec2::new(t.y, -t.x)
    }
}

/// A plan-view line with arc length, direction and curvature.
#[derive(Clone, Debug)]
pub struct Trajectory {
    pub(super) places: Vec<Place>,
}

/// Why numbers make no trajectory.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrajectoryError {
    /// Too few distinct points, or a length of zero.
    #[error("the trajectory has no length: give it two different points")]
    NoLength,
    /// A number that is not finite.
    #[error("the trajectory is not finite near {0}: look at its points or expressions")]
    NotFinite(String),
    /// Amplitude too large for the wavelength.
    #[error(
        "no sine-generated curve has amplitude {amplitude:.1} m and wavelength {wavelength:.1} m: \
         its meanders would touch; keep amplitude / wavelength below {largest:.3}"
    )]
    NoMeander {
        /// Half of peak to peak (m).
        amplitude: f64,
        /// Along the belt (m).
        wavelength: f64,
        /// Largest possible ratio.
        largest: f64,
    },
    /// A cusp: the line stops and turns.
    #[error(
        "the trajectory stops and turns at parameter {0:.4}: give it a derivative that is never zero"
    )]
    Cusp(f64),
    /// Far too many meanders.
    #[error(
        "a wavelength of {wavelength} m makes {count:.0} meanders over {extent:.0} m: \
         lengthen it, or give the trajectory a `length`"
    )]
    TooManyMeanders {
        /// Along the belt (m).
        wavelength: f64,
        /// How many fit.
        count: f64,
        /// Extent along the belt (m).
        extent: f64,
    },
    /// A line beside it that would turn back.
    #[error(
        "{offset:.1} m beside the trajectory a line folds at ({:.0}, {:.0}), where that turns with a radius of {radius:.1} m: \
         keep the offset less than that towards the inside of its bends", point.x, point.y
    )]
    Folds {
        /// To the right (m).
        offset: f64,
        /// Where the trajectory is then.
        point: DVec2,
        /// Its radius of curvature there (m).
        radius: f64,
    },
    /// The points could not be interpolated.
    #[error("the trajectory's points cannot be interpolated: {0}")]
    Interpolation(String),
}

impl Trajectory {
    /// The straight line from one point to another.
    pub fn line(from: DVec2, to: DVec2) -> Result<Self, TrajectoryError> {
        let along = to - from;
        let length = along.length();
        if !length.is_finite() {
            return Err(TrajectoryError::NotFinite(format!("{from} – {to}")));
        }
        if length == 0.0 {
            return Err(TrajectoryError::NoLength);
        }
        let direction = along.to_angle();
        let place = |s, point| Place {
            s,
            point,
            direction,
            curvature: 0.0,
        };
        Ok(Self {
            places: vec![place(0.0, from), place(length, to)],
        })
    }

    /// The B-spline through points (\[J19\] Eq. 7–9), of the given degree or less if points are few.
    pub fn through(
        points: &[DVec2],
        degree: usize,
        parametrization: Parametrization,
    ) -> Result<Self, TrajectoryError> {
        if let [from, to] = points {
            return Self::line(*from, *to);
        }
        let lifted: Vec<_> = points.iter().map(|p| p.extend(0.0)).collect();
        let degree = degree.min(points.len().saturating_sub(1));
        let curve = interpolate::curve(&lifted, degree, parametrization)
            .map_err(|error| TrajectoryError::Interpolation(error.to_string()))?;
        let spans: Vec<f64> = curve.knots().distinct().iter().map(|knot| knot.0).collect();
        let mut parameters = vec![spans[0]];
        for span in spans.windows(2) {
            parameters.extend(
                (1..=SAMPLES_PER_SPAN)
                    .map(|i| span[0] + (span[1] - span[0]) * i as f64 / SAMPLES_PER_SPAN as f64),
            );
        }
        Self::from_motion(&parameters, &|t| {
            let d = curve.derivatives(t, 2);
            [d[0].truncate(), d[1].truncate(), d[2].truncate()]
        })
    }

    /// Any plane curve (x(t), y(t)); derivatives are taken by central differences.
    pub fn parametric(
        curve: &dyn Fn(f64) -> DVec2,
        range: [f64; 2],
    ) -> Result<Self, TrajectoryError> {
        let step = (range[1] - range[0]) / PARAMETRIC_SAMPLES as f64;
        let parameters: Vec<f64> = (0..=PARAMETRIC_SAMPLES)
            .map(|i| range[0] + step * i as f64)
            .collect();
        // Differences over a sample's spacing: fourth order, and far from rounding.
        let h = step / 2.0;
        let clamp = |t: f64| {
            t.clamp(
                range[0].min(range[1]) + 2.0 * h,
                range[1].max(range[0]) - 2.0 * h,
            )
        };
        Self::from_motion(&parameters, &|t| {
            let c = clamp(t);
            let f = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| curve(c + k * h));
            let first = (f[0] - f[4] + 8.0 * (f[3] - f[1])) / (12.0 * h);
            let second = (-f[0] - f[4] + 16.0 * (f[1] + f[3]) - 30.0 * f[2]) / (12.0 * h * h);
            // At the two ends the derivatives stem from just inside: continue them linearly.
            [curve(t), first + second * (t - c), second]
        })
    }

    /// From position, velocity and acceleration at increasing parameters.
    pub(super) fn from_motion(
        parameters: &[f64],
        motion: &dyn Fn(f64) -> [DVec2; 3],
    ) -> Result<Self, TrajectoryError> {
        let mut places: Vec<Place> = Vec::with_capacity(parameters.len());
        let mut s = 0.0;
        for (i, &t) in parameters.iter().enumerate() {
            let [point, velocity, acceleration] = motion(t);
            let speed = velocity.length();
            if !(point.is_finite() && speed.is_finite() && acceleration.is_finite()) {
                return Err(TrajectoryError::NotFinite(format!("parameter {t:.4}")));
            }
            if i > 0 {
                let from = parameters[i - 1];
                s += (t - from)
                    * FIVE_ON_UNIT
                        .iter()
                        .map(|(x, w)| w * motion(from + (t - from) * x)[1].length())
                        .sum::<f64>();
            }
            if speed == 0.0 {
                return Err(TrajectoryError::Cusp(t));
            }
            let mut direction = velocity.to_angle();
            if let Some(last) = places.last() {
                // Continuous direction: a turn by more than a right angle in one sample is a cusp.
                direction += TAU * ((last.direction - direction) / TAU).round();
                if (direction - last.direction).abs() > FRAC_PI_2 {
                    return Err(TrajectoryError::Cusp(t));
                }
            }
            let curvature = velocity.perp_dot(acceleration) / speed.powi(3);
            places.push(Place {
                s,
                point,
                direction,
                curvature,
            });
        }
        if !(s > 0.0 && s.is_finite()) {
            return Err(TrajectoryError::NoLength);
        }
        Ok(Self { places })
    }

    /// Arc length (m).
    pub fn length(&self) -> f64 {
        self.places[self.places.len() - 1].s
    }

    /// The samples, in order of arc length.
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// Whether it is one straight line.
    pub fn is_straight(&self) -> bool {
        self.places.iter().all(|place| place.curvature == 0.0)
    }

    /// The place at an arc length, clamped to the trajectory.
    pub fn at(&self, s: f64) -> Place {
        let s = s.clamp(0.0, self.length());
        let after = self
            .places
            .partition_point(|place| place.s <= s)
            .clamp(1, self.places.len() - 1);
        let (a, b) = (&self.places[after - 1], &self.places[after]);
        let h = b.s - a.s;
        let x = (s - a.s) / h;
        let (y, xx) = (1.0 - x, x * x);
        let point = a.point * (y * y * (1.0 + 2.0 * x))
            + b.point * (xx * (3.0 - 2.0 * x))
            + (a.tangent() * (x * y * y) - b.tangent() * (xx * y)) * h;
        // Direction by the same Hermite pieces: its derivative is the curvature.
        let direction = a.direction * (y * y * (1.0 + 2.0 * x))
            + b.direction * (xx * (3.0 - 2.0 * x))
            + (a.curvature * (x * y * y) - b.curvature * (xx * y)) * h;
        Place {
            s,
            point,
            direction,
            curvature: a.curvature * y + b.curvature * x,
        }
    }

    /// The part between two arc lengths (m), which are clamped to the trajectory.
    pub fn between(&self, from: f64, to: f64) -> Result<Self, TrajectoryError> {
        let (from, to) = (from.max(0.0), to.min(self.length()));
        // Written so that a number that is none fails too.
        if !(to > from) {
            return Err(TrajectoryError::NoLength);
        }
        // A sample at an end, to rounding, is that end.
        let rounding = 1e-12 * self.length();
        let inner = |place: &&Place| place.s > from + rounding && place.s < to - rounding;
        let mut places = vec![self.at(from)];
        places.extend(self.places.iter().filter(inner));
        places.push(self.at(to));
        for place in &mut places {
            place.s -= from;
        }
        Ok(Self { places })
    }

    /// The line beside it, some way to the right (m; to the left if less than 0). Where its samples are dense enough for it, they
    /// are for the line beside it, too, unless that turns much more sharply.
    pub fn beside(&self, offset: f64) -> Result<Self, TrajectoryError> {
        if !offset.is_finite() {
            return Err(TrajectoryError::NotFinite(format!("an offset of {offset}")));
        }
        let start = self.places[0].direction;
        let beside = |place: &Place| {
            // Bends to the left are wider on the right.
            let stretch = 1.0 + place.curvature * offset;
            if stretch <= LEAST_STRETCH {
                return Err(TrajectoryError::Folds {
                    offset,
                    point: place.point,
                    radius: 1.0 / place.curvature.abs(),
                });
            }
            Ok(Place {
                // The integral of the stretch: that of curvature is the turn.
                s: place.s + offset * (place.direction - start),
                point: place.point + offset * place.right(),
                direction: place.direction,
                curvature: place.curvature / stretch,
            })
        };
        let places = self.places.iter().map(beside).collect::<Result<_, _>>()?;
        Ok(Self { places })
    }

    /// This line and then another one, which starts where this one ends, in the same direction.
    pub(super) fn followed_by(mut self, next: &Self) -> Self {
        let Some(last) = self.places.pop() else {
            return next.clone();
        };
        // Directions go on: whole turns are none.
        let turns = ((last.direction - next.places[0].direction) / TAU).round() * TAU;
        self.places.extend(next.places.iter().map(|place| Place {
            s: last.s + place.s,
            direction: place.direction + turns,
            ..*place
        }));
        self
    }

    /// Arc lengths of the sections: both ends, and wherever the direction has turned by the limit
    /// since the last one (to and fro counts twice the limit: a gentle meander turns back in time).
    pub fn stations(&self, angle_limit: f64) -> Vec<f64> {
        let mut stations = vec![0.0];
        let mut last = self.places[0].direction;
        let mut turned = 0.0;
        for pair in self.places.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            turned += (b.direction - a.direction).abs();
            while (b.direction - last).abs() > angle_limit {
                let next = last + angle_limit.copysign(b.direction - last);
                let part = ((next - a.direction) / (b.direction - a.direction)).clamp(0.0, 1.0);
                stations.push(a.s + (b.s - a.s) * part);
                last = next;
                turned = (b.direction - last).abs();
            }
            if turned > 2.0 * angle_limit {
                stations.push(b.s);
                last = b.direction;
                turned = 0.0;
            }
        }
        let length = self.length();
        // A last section that is nearly at the end would make a sliver: the end takes its place.
        let sliver = 1e-3 * length / stations.len() as f64;
        if stations.len() > 1 && length - stations[stations.len() - 1] < sliver {
            stations.pop();
        }
        stations.push(length);
        stations
    }

    /// The sharpest bend: largest curvature to the left and to the right (1/m), both at least 0.
    pub fn sharpest(&self) -> (f64, f64) {
        self.places.iter().fold((0.0, 0.0), |(left, right), place| {
            (place.curvature.max(left), (-place.curvature).max(right))
        })
    }
}

/// Unit vector of an azimuth, clockwise from north (rad).
pub fn azimuth_vector(azimuth: f64) -> DVec2 {
    DVec2::new(azimuth.sin(), azimuth.cos())
}

#[cfg(test)]
#[path = "trajectory_tests.rs"]
mod tests;
