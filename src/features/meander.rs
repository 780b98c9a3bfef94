//! Sine-generated curves: the planform of meanders.
//!
//! The sine-generated curve is Langbein & Leopold's (1966): θ(s) = ω sin(2πs/M). With J₀ the Bessel
//! and H₀ the Struve function its wavelength is λ = M·J₀(ω) and its amplitude A = M·H₀(ω)/4, so that
//! A/λ = H₀(ω)/(4 J₀(ω)) gives ω.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::trajectory::{Place, Trajectory, TrajectoryError, azimuth_vector};
use crate::nurbs::quadrature::FIVE_ON_UNIT;

/// Largest sensible ω: meanders touch near 125°.
const LARGEST_OMEGA: f64 = 125.0 / 180.0 * PI;
/// Samples in one wavelength of a sine-generated curve.
const SAMPLES_PER_WAVELENGTH: usize = 128;
/// Most samples of one trajectory: 16 MB. Beyond it the wavelength is too small for the extent.
const MOST_SAMPLES: f64 = 400_000.0;

/// A sine-generated curve's parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SineGenerated {
    /// Half of the peak-to-peak distance across the belt (m).
    pub amplitude: f64,
    /// Length of a meander along the belt (m).
    pub wavelength: f64,
    /// Direction of the belt, clockwise from north (rad).
    pub azimuth: f64,
    /// A point on the belt's axis (m).
    pub center: DVec2,
    /// Phase at that point, as a fraction of a wavelength; 0 is the outermost left-turning point.
    pub phase: f64,
    /// Extent along the axis, from and to, measured from the centre (m).
    pub extent: [f64; 2],
}

impl Trajectory {
    /// A sine-generated curve over an extent of its axis.
    pub fn sine_generated(curve: &SineGenerated) -> Result<Self, TrajectoryError> {
        let SineGenerated {
            amplitude,
            wavelength,
            azimuth,
            center,
            phase,
            extent,
        } = *curve;
        let finite = [
            amplitude, wavelength, azimuth, center.x, center.y, phase, extent[0], extent[1],
        ];
        if finite.iter().any(|value| !value.is_finite()) {
            return Err(TrajectoryError::NotFinite(format!("{curve:?}")));
        }
        let length = extent[1] - extent[0];
        if !(length > 0.0) {
            return Err(TrajectoryError::NoLength);
        }
        let omega = solve_omega(amplitude, wavelength)?;
        let count = length / wavelength;
        if count * SAMPLES_PER_WAVELENGTH as f64 > MOST_SAMPLES {
            return Err(TrajectoryError::TooManyMeanders {
                wavelength,
                count,
                extent: length,
            });
        }
        let meander = Meander::new(omega, wavelength, amplitude);
        let axis = azimuth_vector(azimuth);
        let across = axis.perp();
        let start = phase + extent[0] / wavelength;
        let samples = (count * SAMPLES_PER_WAVELENGTH as f64).ceil().max(1.0);
        let origin = meander.at(phase).point.x;
        let axis_angle = axis.to_angle();
        // Both casts are safe: samples is between 1 and MOST_SAMPLES.
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "bounded above"
        )]
        let samples = samples as usize;
        let places = (0..=samples)
            .map(|i| {
                let turn = start + count * i as f64 / samples as f64;
                let local = meander.at(turn);
                Place {
                    s: (turn - start) * meander.arc,
                    point: center + axis * (local.point.x - origin) + across * local.point.y,
                    direction: axis_angle + local.direction,
                    curvature: local.curvature,
                }
            })
            .collect();
        Ok(Self { places })
    }
}

/// The ω whose sine-generated curve has this amplitude and wavelength.
pub fn solve_omega(amplitude: f64, wavelength: f64) -> Result<f64, TrajectoryError> {
    let ratio = amplitude / wavelength;
    let of = |omega: f64| struve_h0(omega) / (4.0 * bessel_j0(omega));
    let largest = of(LARGEST_OMEGA);
    if !(amplitude >= 0.0 && wavelength > 0.0 && ratio <= largest) {
        return Err(TrajectoryError::NoMeander {
            amplitude,
            wavelength,
            largest,
        });
    }
    // The ratio grows steadily with ω: bisection cannot fail, and 60 halvings reach the last bit.
    let (mut low, mut high) = (0.0, LARGEST_OMEGA);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if of(middle) < ratio {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(f64::midpoint(low, high))
}

/// Bessel function J₀ by its power series: for 0 ≤ x < 3 twenty terms reach rounding.
pub fn bessel_j0(x: f64) -> f64 {
    let mut term = 1.0;
    (1..20).fold(1.0, |sum, k| {
        let k = f64::from(k);
        term *= -(x * x) / (4.0 * k * k);
        sum + term
    })
}

/// Struve function H₀ by its power series, for 0 ≤ x < 3.
pub fn struve_h0(x: f64) -> f64 {
    let mut term = x;
    let sum = (1..20).fold(x, |sum, k| {
        let odd = f64::from(2 * k + 1);
        term *= -(x * x) / (odd * odd);
        sum + term
    });
    sum * 2.0 / PI
}

/// One period of a sine-generated curve along the x axis, tabulated.
struct Meander {
    omega: f64,
    /// Arc length M of a wavelength.
    arc: f64,
    wavelength: f64,
    /// Positions at even fractions of the period.
    table: Vec<DVec2>,
}

impl Meander {
    fn new(omega: f64, wavelength: f64, amplitude: f64) -> Self {
        let arc = wavelength / bessel_j0(omega);
        let n = SAMPLES_PER_WAVELENGTH;
        let mut table = Vec::with_capacity(n + 1);
        let mut point = DVec2::new(0.0, -amplitude);
        table.push(point);
        for i in 0..n {
            point += Self::advance(omega, arc, i as f64 / n as f64, 1.0 / n as f64);
            table.push(point);
        }
        Self {
            omega,
            arc,
            wavelength,
            table,
        }
    }

    /// Displacement over part of a turn, by quadrature of the direction.
    fn advance(omega: f64, arc: f64, from: f64, part: f64) -> DVec2 {
        let sum: DVec2 = FIVE_ON_UNIT
            .iter()
            .map(|(x, w)| DVec2::from_angle(omega * (TAU * (from + part * x)).sin()) * *w)
            .sum();
        sum * (part * arc)
    }

    /// The place after a number of turns (periods), which may be negative.
    fn at(&self, turns: f64) -> Place {
        let (whole, part) = (turns.floor(), turns - turns.floor());
        let n = SAMPLES_PER_WAVELENGTH as f64;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 ≤ part ≤ 1"
        )]
        let i = ((part * n) as usize).min(SAMPLES_PER_WAVELENGTH - 1);
        let from = i as f64 / n;
        let local = self.table[i] + Self::advance(self.omega, self.arc, from, part - from);
        Place {
            s: turns * self.arc,
            point: local + DVec2::new(whole * self.wavelength, 0.0),
            direction: self.omega * (TAU * part).sin(),
            curvature: self.omega * TAU / self.arc * (TAU * part).cos(),
        }
    }
}
