//! Migrating channels: the positions of one meandering river after each other, as belts of scrolls are made.
//!
//! Meanders grow outwards and move down the valley, and the river rises a little as it fills its valley. Position k of m (1 is the
//! oldest) follows a sine-generated line of its own amplitude, with the wavelength and phase of all of them,
//!
//! ```text
//! t = (k − 1)/(m − 1):   amplitude A₁ + (A_m − A₁) t,   t · shift down the valley,   (k − 1) · rise above the first
//! ```
//!
//! Younger positions remove older ones: what is left of position k is a scroll, whose outer side is the inner bank of the next
//! one. The rise is needed: equal sections on lines that cross at a small angle would touch along their thalwegs, and their tops
//! would coincide.

use super::meander::SineGenerated;
use super::trajectory::{Trajectory, TrajectoryError, azimuth_vector};

/// A migrating channel's positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Migration {
    /// The line of the first position.
    pub first: SineGenerated,
    /// Amplitude of the last position (m).
    pub last_amplitude: f64,
    /// How far down the valley the last position is from the first one (m).
    pub shift: f64,
    /// How much higher each position is than the one before it (m).
    pub rise: f64,
    /// Positions.
    pub steps: usize,
}

impl Migration {
    /// The line of a position, from 0, and how much higher it is than the first one (m).
    pub fn position(&self, at: usize) -> Result<(Trajectory, f64), TrajectoryError> {
        let part = if self.steps > 1 {
            at as f64 / (self.steps - 1) as f64
        } else {
            0.0
        };
        let first = &self.first;
        let shift = self.shift * part;
        // Its ends are where those of the first are.
        let [from, to] = first.extent;
        let line = Trajectory::sine_generated(&SineGenerated {
            amplitude: first.amplitude + (self.last_amplitude - first.amplitude) * part,
            center: first.center + azimuth_vector(first.azimuth) * shift,
            extent: [from - shift, to - shift],
            ..*first
        })?;
        Ok((line, self.rise * at as f64))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use glam::DVec2;

    use super::*;

    #[test]
    fn positions_grow_outwards_move_down_the_valley_and_rise() {
        let migration = Migration {
            first: SineGenerated {
                amplitude: 40.0,
                wavelength: 475.0,
                azimuth: FRAC_PI_2,
                center: DVec2::ZERO,
                phase: 0.0,
                extent: [-600.0, 900.0],
            },
            last_amplitude: 120.0,
            shift: 60.0,
            rise: 0.1,
            steps: 5,
        };
        for at in 0..5 {
            let (line, rise) = migration.position(at).unwrap();
            assert!((rise - 0.1 * at as f64).abs() < 1e-12);
            // Phase 0: the outermost left-turning place, now at the shift.
            let apex = line
                .places()
                .iter()
                .filter(|place| (place.point.x - 15.0 * at as f64).abs() < 100.0)
                .max_by(|a, b| a.curvature.total_cmp(&b.curvature))
                .unwrap();
            assert!((apex.point.x - 15.0 * at as f64).abs() < 4.0, "{apex:?}");
            let amplitude = 40.0 + 20.0 * at as f64;
            assert!((apex.point.y.abs() - amplitude).abs() < 0.1, "{apex:?}");
            let places = line.places();
            for (place, x) in [(places[0], -600.0), (places[places.len() - 1], 900.0)] {
                // Along a meander its axis is not run through evenly.
                assert!((place.point.x - x).abs() < 60.0, "{place:?}");
            }
        }
    }
}
