//! Bends of trajectories: from one inflection to the next.

use std::sync::Arc;

use super::profile::Profile;
use super::trajectory::Trajectory;

/// Shortest bend, in widths of the channel.
const SHORTEST: f64 = 2.0;
/// Halvings of an interval that holds an inflection: to the last bit.
const HALVINGS: usize = 60;
/// Curvatures that are at least this part of another one are as sharp.
const LEVEL: f64 = 0.99;
/// A curvature below this, times the width, is none.
const STRAIGHT: f64 = 1e-9;

/// A part of a trajectory that turns one way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// Arc length of its first inflection (m); before the trajectory's start if it is cut off there.
    pub from: f64,
    /// Arc length of its last inflection (m); beyond the trajectory's end if it is cut off there.
    pub to: f64,
    /// Arc length of its sharpest place (m).
    pub apex: f64,
    /// 1 if it turns left, −1 if it turns right. The inner bank is on that side.
    pub turn: f64,
    /// Angle by which the trajectory turns in it (rad).
    pub angle: f64,
}

impl Bend {
    /// Fraction of the way from inflection to inflection.
    pub fn fraction(&self, s: f64) -> f64 {
        (s - self.from) / (self.to - self.from)
    }

    /// How much of a bend it is at an arc length: 0 at the inflections, 1 at a fraction of the way (0 to 1), and a half sine
    /// wave between, its halves stretched smoothly (a Möbius map). Of a sine-generated bend, with the fraction ½, that is its
    /// curvature as a fraction of the greatest.
    pub fn bulge(&self, s: f64, apex: f64) -> f64 {
        let t = self.fraction(s);
        let part = t * (1.0 - apex) / (t * (1.0 - 2.0 * apex) + apex);
        (std::f64::consts::PI * part).sin()
    }
}

/// The bends of a trajectory, downstream, for a channel of some width (m): those that turn by an angle (rad) and are longer
/// than two widths. Of what is cut off by an end of the trajectory those are bends that have their sharpest place on it; they
/// go on beyond the end as far as symmetry about that place tells.
///
/// Curvature is the mean over two widths: what turns to and fro within a channel's width bends no channel.
pub fn bends(trajectory: &Trajectory, width: f64, least_angle: f64) -> Vec<Bend> {
    let length = trajectory.length();
    let curvature = |s: f64| {
        let (from, to) = ((s - width).max(0.0), (s + width).min(length));
        (trajectory.at(to).direction - trajectory.at(from).direction) / (to - from)
    };
    let turn_of = |curvature: f64| {
        if curvature.abs() * width > STRAIGHT {
            curvature.signum()
        } else {
            0.0
        }
    };
    let inflection = |mut a: f64, mut b: f64, turn: f64| {
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(a, b);
            if turn_of(curvature(middle)) == turn {
                a = middle;
            } else {
                b = middle;
            }
        }
        f64::midpoint(a, b)
    };
    let samples: Vec<(f64, f64)> = trajectory
        .places()
        .iter()
        .map(|place| (place.s, curvature(place.s)))
        .collect();
    let mut found = Vec::new();
    for run in samples.chunk_by(|a, b| turn_of(a.1) == turn_of(b.1)) {
        let (first, last) = (run[0], run[run.len() - 1]);
        let turn = turn_of(first.1);
        if turn == 0.0 {
            continue;
        }
        let from = neighbour(&samples, first.0, -1).map(|s| inflection(first.0, s, turn));
        let to = neighbour(&samples, last.0, 1).map(|s| inflection(last.0, s, turn));
        let apex = run.iter().fold(first, |sharpest, own| {
            if own.1.abs() > sharpest.1.abs() {
                *own
            } else {
                sharpest
            }
        });
        let apex = apex.0;
        // Sharpest at an end of the trajectory, and gentler a width farther in.
        let falls = |end: f64, inner: f64| {
            apex == end && curvature(inner).abs() < LEVEL * curvature(end).abs()
        };
        let is_cut_before_its_apex = match (from, to) {
            (None, Some(_)) => falls(0.0, width),
            (Some(_), None) => falls(length, length - width),
            _ => false,
        };
        let angle = trajectory.at(to.unwrap_or(length)).direction
            - trajectory.at(from.unwrap_or(0.0)).direction;
        let (from, to) = match (from, to) {
            (Some(from), Some(to)) => (from, to),
            (Some(from), None) => (from, (2.0 * apex - from).max(length)),
            (None, Some(to)) => ((2.0 * apex - to).min(0.0), to),
            // All of the trajectory is one bend.
            (None, None) => (0.0, length),
        };
        if !is_cut_before_its_apex && angle.abs() >= least_angle && to - from >= SHORTEST * width {
            found.push(Bend {
                from,
                to,
                apex,
                turn,
                angle: angle.abs(),
            });
        }
    }
    found
}

/// The sample next to the one at an arc length.
fn neighbour(samples: &[(f64, f64)], s: f64, step: isize) -> Option<f64> {
    let at = samples.partition_point(|sample| sample.0 < s);
    samples.get(at.checked_add_signed(step)?).map(|one| one.0)
}

/// A parameter that is proportional to a trajectory's curvature: `most` where it turns left most sharply, and −`most` where it
/// turns right as sharply. A channel's asymmetry by curvature moves its thalweg towards the outer banks.
pub fn by_curvature(trajectory: &Arc<Trajectory>, most: f64) -> Profile {
    let (left, right) = trajectory.sharpest();
    let sharpest = left.max(right);
    if sharpest == 0.0 {
        return Profile::Constant(0.0);
    }
    let trajectory = Arc::clone(trajectory);
    Profile::Function(Arc::new(move |fraction| {
        most * trajectory.at(fraction * trajectory.length()).curvature / sharpest
    }))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    use glam::DVec2;

    use super::*;
    use crate::features::meander::{SineGenerated, solve_omega};

    fn meander(phase: f64, wavelengths: f64) -> Trajectory {
        Trajectory::sine_generated(&SineGenerated {
            amplitude: 100.0,
            wavelength: 475.0,
            azimuth: FRAC_PI_2,
            center: DVec2::ZERO,
            phase,
            extent: [0.0, 475.0 * wavelengths],
        })
        .unwrap()
    }

    #[test]
    fn a_sine_generated_line_bends_from_inflection_to_inflection() {
        // Phase 0 is the outermost left-turning point: the first bend is half cut off.
        let line = meander(0.0, 3.0);
        let (half, omega) = (line.length() / 6.0, solve_omega(100.0, 475.0).unwrap());
        let found = bends(&line, 50.0, 20_f64.to_radians());
        assert_eq!(found.len(), 5);
        for (k, bend) in found.iter().enumerate() {
            let k = k as f64;
            assert!((bend.from - (k + 0.5) * half).abs() < 1e-6 * half);
            assert!((bend.to - (k + 1.5) * half).abs() < 1e-6 * half);
            assert_eq!(bend.turn, if k % 2.0 == 0.0 { -1.0 } else { 1.0 });
            assert!((bend.angle - 2.0 * omega).abs() < 1e-6);
            for i in 0..=20 {
                let s = bend.from + (bend.to - bend.from) * f64::from(i) / 20.0;
                let part = line.at(s).curvature.abs() * (line.length() / 3.0) / (TAU * omega);
                assert!((bend.bulge(s, 0.5) - part).abs() < 1e-3);
            }
        }
    }

    #[test]
    fn a_bend_that_is_cut_off_behind_its_apex_goes_on_by_symmetry() {
        let line = meander(0.1, 1.0);
        // From 0.1 to 1.1 wavelengths after a leftmost point: the last bend is cut off 0.1 behind its apex.
        let found = bends(&line, 40.0, 0.3);
        let half = line.length() / 2.0;
        let last = found[found.len() - 1];
        assert_eq!((found.len(), last.turn), (2, 1.0));
        assert!(
            (last.apex - 1.8 * half).abs() < 0.02 * half,
            "{last:?} {half}"
        );
        assert!(
            (last.to - 2.3 * half).abs() < 0.05 * half,
            "{last:?} {half}"
        );
        assert!(last.to > line.length());
        assert!(bends(&line, 40.0, 2.0 * PI).is_empty());
        assert!(bends(&line, 1.2 * half, 0.3).is_empty());
    }

    #[test]
    fn reversing_a_trajectory_reverses_its_bends_and_their_turns() {
        let points = [
            (0.0, 0.0),
            (200.0, 90.0),
            (420.0, -60.0),
            (600.0, 40.0),
            (900.0, 0.0),
        ]
        .map(|(x, y)| DVec2::new(x, y));
        let through = |points: &[DVec2]| {
            let spacing = crate::nurbs::interpolate::Parametrization::ChordLength;
            Trajectory::through(points, 3, spacing).unwrap()
        };
        let back: Vec<DVec2> = points.iter().rev().copied().collect();
        let (there, back) = (through(&points), through(&back));
        let (one, other) = (bends(&there, 30.0, 0.2), bends(&back, 30.0, 0.2));
        assert!(one.len() >= 3 && one.len() == other.len());
        for (a, b) in one.iter().zip(other.iter().rev()) {
            assert_eq!(a.turn, -b.turn);
            assert!((a.from - (back.length() - b.to)).abs() < 1e-4);
            assert!((a.bulge(a.from + 10.0, 0.3) - b.bulge(b.to - 10.0, 0.7)).abs() < 1e-6);
        }
    }

    #[test]
    fn what_wriggles_within_a_width_is_one_bend() {
        // An arc of radius 200 m with a wriggle of 5 cm every 8 m.
        let arc = |t: f64| DVec2::from_angle(t) * (200.0 + 0.05 * (150.0 * t).sin());
        let line = Trajectory::parametric(&arc, [0.0, 2.5]).unwrap();
        let sharpest = line.sharpest();
        assert!(sharpest.1 > 0.0, "the wriggle turns back");
        let found = bends(&line, 30.0, 0.3);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].turn, 1.0);
        assert!(bends(&line, 0.01, 0.3).is_empty());
    }

    #[test]
    fn what_follows_curvature_is_greatest_on_the_right_where_a_line_turns_left() {
        let line = Arc::new(meander(0.0, 2.0));
        let profile = by_curvature(&line, 0.2);
        assert!((profile.at(0.5) - 0.2).abs() < 1e-9);
        assert!((profile.at(0.25) + 0.2).abs() < 1e-9);
        assert!(profile.at(0.375).abs() < 1e-9);
        let straight = Arc::new(Trajectory::line(DVec2::ZERO, DVec2::X).unwrap());
        assert!(by_curvature(&straight, 0.2).is_constant());
    }
}
