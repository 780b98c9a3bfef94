#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use super::*;
use crate::features::meander::{SineGenerated, bessel_j0, solve_omega, struve_h0};

fn meander(amplitude: f64, wavelength: f64) -> SineGenerated {
    SineGenerated {
        amplitude,
        wavelength,
        azimuth: FRAC_PI_2,
        center: DVec2::ZERO,
        phase: 0.0,
        extent: [-2.0 * wavelength, 2.0 * wavelength],
    }
}

/// Sinuosity 1/J₀(ω) for the angles tabulated by Langbein and Leopold.
#[test]
fn sinuosity_is_one_over_bessel_j0() {
    for (degrees, sinuosity) in [
        (40.0, 1.134),
        (60.0, 1.344),
        (80.0, 1.758),
        (100.0, 2.690),
        (110.0, 3.700),
    ] {
        let omega = f64::to_radians(degrees);
        assert!(
            (1.0 / bessel_j0(omega) - sinuosity).abs() < 6e-4,
            "{degrees}"
        );
        // The same from the curve itself: arc length over distance travelled.
        let wavelength = 100.0;
        let amplitude = wavelength * struve_h0(omega) / (4.0 * bessel_j0(omega));
        let curve = Trajectory::sine_generated(&meander(amplitude, wavelength)).unwrap();
        let travelled = curve.places()[0]
            .point
            .distance(curve.at(curve.length()).point);
        assert!(
            (curve.length() / travelled - sinuosity).abs() < 6e-4,
            "{degrees}"
        );
    }
}

/// Values of H₀ from Abramowitz & Stegun, Table 12.1.
#[test]
fn struve_h0_meets_the_published_table() {
    for (x, value) in [(0.5, 0.309_555_9), (1.0, 0.568_656_6), (2.0, 0.790_858_8)] {
        assert!((struve_h0(x) - value).abs() < 1e-6, "{x}");
    }
}

#[test]
fn amplitude_and_wavelength_are_those_asked_for() {
    for (amplitude, wavelength) in [(20.0, 475.0), (107.0, 800.0), (200.0, 600.0)] {
        let curve = Trajectory::sine_generated(&meander(amplitude, wavelength)).unwrap();
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..=20_000 {
            let y = curve.at(curve.length() * f64::from(i) / 20_000.0).point.y;
            (low, high) = (low.min(y), high.max(y));
        }
        assert!((low + amplitude).abs() < 1e-4 * amplitude, "{low}");
        assert!((high - amplitude).abs() < 1e-4 * amplitude, "{high}");
        let ends = curve.at(curve.length()).point - curve.places()[0].point;
        assert!((ends.x - 4.0 * wavelength).abs() < 1e-6 * wavelength && ends.y.abs() < 1e-6);
    }
}

#[test]
fn the_sharpest_bend_of_a_sine_generated_curve_has_radius_m_over_two_pi_omega() {
    let (amplitude, wavelength) = (150.0, 500.0);
    let omega = solve_omega(amplitude, wavelength).unwrap();
    let m = wavelength / bessel_j0(omega);
    let curve = Trajectory::sine_generated(&meander(amplitude, wavelength)).unwrap();
    let (left, right) = curve.sharpest();
    assert!((1.0 / left / (m / (TAU * omega)) - 1.0).abs() < 1e-9);
    assert!((1.0 / right / (m / (TAU * omega)) - 1.0).abs() < 1e-9);
}

#[test]
fn a_belt_runs_along_its_azimuth_through_its_centre() {
    let mut curve = meander(0.0, 100.0);
    curve.azimuth = f64::to_radians(30.0);
    curve.center = DVec2::new(500.0, 400.0);
    let line = Trajectory::sine_generated(&curve).unwrap();
    let ends = line.at(line.length()).point - line.places()[0].point;
    assert!((ends.x - 400.0 * 0.5).abs() < 1e-9 && (ends.y - 400.0 * 0.75_f64.sqrt()).abs() < 1e-9);
    assert!((line.at(line.length() / 2.0).point - curve.center).length() < 1e-9);
}

#[test]
fn positions_between_the_samples_lie_on_a_parametric_circle() {
    let radius = 300.0;
    let circle = |t: f64| DVec2::from_angle(t) * radius;
    let arc = Trajectory::parametric(&circle, [0.0, 4.0]).unwrap();
    assert!((arc.length() - 4.0 * radius).abs() < 1e-6);
    for i in 0..=997 {
        let s = arc.length() * f64::from(i) / 997.0;
        let place = arc.at(s);
        assert!((place.point - circle(s / radius)).length() < 1e-6);
        assert!((place.direction - s / radius - FRAC_PI_2).abs() < 1e-6);
        assert!(
            (place.curvature * radius - 1.0).abs() < 1e-4,
            "{}",
            place.curvature * radius
        );
    }
}

#[test]
fn an_interpolated_trajectory_passes_through_its_points() {
    let points: Vec<DVec2> = [(0.0, 0.0), (100.0, 40.0), (220.0, -30.0), (300.0, 10.0)]
        .map(|(x, y)| DVec2::new(x, y))
        .into();
    let curve = Trajectory::through(&points, 3, Parametrization::Centripetal).unwrap();
    for point in &points {
        let nearest = (0..=40_000)
            .map(|i| {
                curve
                    .at(curve.length() * f64::from(i) / 40_000.0)
                    .point
                    .distance(*point)
            })
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.01, "{nearest}");
    }
}

#[test]
fn sections_stand_wherever_the_direction_has_turned_by_the_limit() {
    let arc = Trajectory::parametric(&|t| DVec2::from_angle(t) * 100.0, [0.0, 1.0]).unwrap();
    let stations = arc.stations(f64::to_radians(10.0));
    // One radian is 57.3°: sections at 0, 10, …, 50 and at the end.
    assert_eq!(stations.len(), 7);
    for pair in stations.windows(2) {
        let turned = (arc.at(pair[1]).direction - arc.at(pair[0]).direction).abs();
        assert!(turned <= f64::to_radians(10.0) + 1e-6);
    }
    let line = Trajectory::line(DVec2::ZERO, DVec2::X * 50.0).unwrap();
    assert_eq!(line.stations(0.1), [0.0, 50.0]);
    assert!(line.is_straight());
}

#[test]
fn what_is_no_line_is_refused() {
    assert_eq!(
        Trajectory::line(DVec2::ONE, DVec2::ONE).unwrap_err(),
        TrajectoryError::NoLength
    );
    let cusp = Trajectory::parametric(&|t| DVec2::new(t * t, t * t * t), [-1.0, 1.0]);
    assert!(matches!(cusp.unwrap_err(), TrajectoryError::Cusp(_)));
    let pole = Trajectory::parametric(&|t| DVec2::new(t, 1.0 / t), [0.0, 1.0]);
    assert!(matches!(pole.unwrap_err(), TrajectoryError::NotFinite(_)));
    assert!(matches!(
        Trajectory::sine_generated(&meander(200.0, 50.0)).unwrap_err(),
        TrajectoryError::NoMeander { .. }
    ));
    let tiny = SineGenerated {
        extent: [-1e6, 1e6],
        ..meander(0.001, 0.01)
    };
    assert!(matches!(
        Trajectory::sine_generated(&tiny).unwrap_err(),
        TrajectoryError::TooManyMeanders { .. }
    ));
}

#[test]
fn a_line_beside_an_arc_is_an_arc_with_the_radius_less_or_more() {
    // To the left, so the right is outside.
    let arc = |t: f64| DVec2::new(3.0, -2.0) + 100.0 * DVec2::from_angle(t);
    let line = Trajectory::parametric(&arc, [0.2, 1.7]).unwrap();
    for offset in [-97.0, -30.0, 0.0, 45.0] {
        let beside = line.beside(offset).unwrap();
        let radius = 100.0 + offset;
        assert!(
            (beside.length() - 1.5 * radius).abs() < 1e-7 * radius,
            "{}",
            beside.length()
        );
        for place in beside.places() {
            let away = place.point - DVec2::new(3.0, -2.0);
            assert!((away.length() - radius).abs() < 1e-9);
            // The stretch, of which a curvature is a fraction, magnifies what the line's own is off by.
            assert!((place.curvature * radius - 1.0).abs() < 1e-6 * (100.0 / radius).max(1.0));
            assert!(place.tangent().dot(away).abs() < 1e-6 * radius);
        }
    }
    let error = line.beside(-100.5).unwrap_err();
    assert!(
        matches!(error, TrajectoryError::Folds { radius, .. } if (radius - 100.0).abs() < 1e-3),
        "{error}"
    );
    assert!(line.beside(f64::NAN).is_err());
}

#[test]
fn a_line_beside_a_meander_is_as_far_away_everywhere_and_as_long() {
    // An inflection at both ends: what the bends to the left gain, those to the right lose.
    let meander = Trajectory::sine_generated(&crate::features::meander::SineGenerated {
        amplitude: 100.0,
        wavelength: 475.0,
        azimuth: 1.2,
        center: DVec2::ZERO,
        phase: 0.25,
        extent: [0.0, 950.0],
    })
    .unwrap();
    let beside = meander.beside(40.0).unwrap();
    assert!((beside.length() - meander.length()).abs() < 1e-6);
    for k in 0..=200 {
        let place = beside.at(beside.length() * f64::from(k) / 200.0);
        let nearest = meander
            .places()
            .iter()
            .map(|other| other.point.distance(place.point));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        // Places are some metres apart.
        assert!((nearest - 40.0).abs() < 0.2, "{nearest}");
    }
}
