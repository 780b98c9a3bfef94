#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};
use std::sync::Arc;

use glam::DVec3;

use super::*;
use crate::features::meander::SineGenerated;
use crate::features::own_section::{Close, Depth, OwnDesign};

fn design(width: f64, depth: f64) -> ChannelDesign {
    ChannelDesign {
        width: Profile::Constant(width),
        depth: Profile::Constant(depth),
        own: None,
        asymmetry: Profile::Constant(0.0),
        left_angle: None,
        right_angle: None,
        top: Profile::Constant(-10.0),
        origin: Origin::Thalweg,
        angle_limit: 15_f64.to_radians(),
        tolerance: 0.01,
    }
}

fn meander(amplitude: f64, wavelength: f64) -> Trajectory {
    Trajectory::sine_generated(&SineGenerated {
        amplitude,
        wavelength,
        azimuth: FRAC_PI_2,
        center: DVec2::ZERO,
        phase: 0.25,
        extent: [-2.0 * wavelength, 2.0 * wavelength],
    })
    .unwrap()
}

/// Largest distance of a plan-view line from the trajectory's offset, and largest spread of its y.
fn follow(line: impl Fn(f64) -> DVec3, trajectory: &Trajectory, offset: f64) -> (f64, f64, f64) {
    let exact: Vec<DVec2> = (0..=8000)
        .map(|i| trajectory.at(trajectory.length() * f64::from(i) / 8000.0))
        .map(|place| place.point + place.right() * offset)
        .collect();
    let (mut worst, mut low, mut high) = (0.0_f64, f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..=999 {
        let p = line(f64::from(i) / 999.0).truncate();
        let to_segment = |a: DVec2, b: DVec2| {
            let part = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            p.distance(a + (b - a) * part)
        };
        let miss = exact
            .windows(2)
            .map(|w| to_segment(w[0], w[1]))
            .fold(f64::INFINITY, f64::min);
        (worst, low, high) = (worst.max(miss), low.min(p.y), high.max(p.y));
    }
    (worst, low, high)
}

#[test]
fn thalweg_and_rims_follow_the_trajectory_and_keep_amplitude_and_width() {
    for (amplitude, wavelength, width) in [
        (60.0, 400.0, 50.0),
        (150.0, 500.0, 90.0),
        (30.0, 1500.0, 15.0),
    ] {
        let trajectory = meander(amplitude, wavelength);
        let channel = design(width, 4.0).build(&trajectory).unwrap();
        let base = channel.base();
        // The exact offsets are polylines of 8000 pieces: their own error is far below 1 % of the width.
        let within = 0.0101 * width;
        let (thalweg, low, high) = follow(|v| base.point(0.5, v), &trajectory, 0.0);
        assert!(thalweg < within, "thalweg misses by {thalweg}");
        assert!(
            (high - low - 2.0 * amplitude).abs() < 2.0 * within,
            "amplitude {}",
            (high - low) / 2.0
        );
        let left = follow(|v| base.point(0.0, v), &trajectory, -width / 2.0).0;
        let right = follow(|v| base.point(1.0, v), &trajectory, width / 2.0).0;
        assert!(
            left < within && right < within,
            "rims miss by {left} and {right}"
        );
        for i in 0..=50 {
            let v = f64::from(i) / 50.0;
            assert!((base.point(0.5, v).z + 14.0).abs() < 1e-9);
            assert!((base.point(0.0, v).z + 10.0).abs() < 1e-9);
        }
    }
}

#[test]
fn a_straight_constant_channel_needs_two_sections() {
    let line = Trajectory::line(DVec2::ZERO, DVec2::new(300.0, 400.0)).unwrap();
    let channel = design(50.0, 4.4).build(&line).unwrap();
    assert_eq!(channel.base().knots_v().count(), 2);
    assert_eq!(channel.base().knots_u().count(), 7);
    assert_eq!(channel.sections(), [0.0, 1.0]);
    assert_eq!(channel.top().knots_u().degree(), 1);
}

#[test]
fn base_and_top_have_the_same_rims_to_the_last_bit() {
    let channel = design(50.0, 4.4).build(&meander(60.0, 400.0)).unwrap();
    let (base, top) = (channel.base().net(), channel.top().net());
    let n = channel.base().knots_v().count();
    assert_eq!(base[..n], top[..n]);
    assert_eq!(base[6 * n..], top[n..]);
}

#[test]
fn width_and_depth_vary_along_the_channel_as_asked() {
    let line = Trajectory::line(DVec2::ZERO, DVec2::new(1000.0, 0.0)).unwrap();
    let mut varying = design(50.0, 4.0);
    varying.width = Profile::Along(vec![(0.0, 30.0), (1.0, 90.0)]);
    varying.depth = Profile::Function(Arc::new(|s| 4.0 + (std::f64::consts::TAU * s).sin()));
    let base = varying.build(&line).unwrap();
    for i in 0..=40 {
        let v = f64::from(i) / 40.0;
        let (left, right) = (base.base().point(0.0, v), base.base().point(1.0, v));
        let width = 30.0 + 60.0 * v;
        assert!((left.distance(right) - width).abs() < 0.02 * width);
        let depth = 4.0 + (std::f64::consts::TAU * v).sin();
        assert!((base.base().point(0.5, v).z + 10.0 + depth).abs() < 0.01 * width);
    }
}

#[test]
fn the_origin_decides_which_point_of_the_section_follows_the_trajectory() {
    let line = Trajectory::line(DVec2::ZERO, DVec2::new(0.0, 100.0)).unwrap();
    let mut design = design(40.0, 4.0);
    design.asymmetry = Profile::Constant(0.25);
    // Northwards: right is east, so the thalweg is 10 m east of the middle.
    let by_thalweg = design.build(&line).unwrap();
    assert!((by_thalweg.base().point(0.5, 0.5).x).abs() < 1e-9);
    assert!((by_thalweg.base().point(0.0, 0.5).x + 30.0).abs() < 1e-9);
    design.origin = Origin::TopCentre;
    let by_top = design.build(&line).unwrap();
    assert!((by_top.base().point(0.5, 0.5).x - 10.0).abs() < 1e-9);
    assert!((by_top.base().point(0.0, 0.5).x + 20.0).abs() < 1e-9);
}

#[test]
fn a_bend_tighter_than_the_half_width_is_refused() {
    // Radius of the sharpest bend: M/(2πω).
    let trajectory = meander(60.0, 300.0);
    let radius = 1.0 / trajectory.sharpest().0;
    assert!(design(1.9 * radius, 4.0).build(&trajectory).is_ok());
    let error = design(2.1 * radius, 4.0).build(&trajectory).unwrap_err();
    assert!(
        matches!(error, ChannelError::Extrusion(ExtrusionError::Fold { .. })),
        "{error}"
    );
    assert_eq!(error.reason(), "bend tighter than the half-width");
}

#[test]
fn a_neck_narrower_than_the_width_is_refused() {
    // An open ring of radius 200 m whose ends come 2·200·sin(0.075) = 29.97 m near each other.
    let ring = |t: f64| DVec2::from_angle(t) * 200.0;
    let trajectory = Trajectory::parametric(&ring, [0.0, std::f64::consts::TAU - 0.15]).unwrap();
    assert_eq!(design(29.9, 4.0).build(&trajectory).err(), None);
    let error = design(35.0, 4.0).build(&trajectory).unwrap_err();
    assert!(
        matches!(error, ChannelError::Extrusion(ExtrusionError::Neck { .. })),
        "{error}"
    );
}

#[test]
fn a_trajectory_that_crosses_itself_is_refused() {
    let points = [
        (0.0, 0.0),
        (250.0, 0.0),
        (450.0, 120.0),
        (350.0, 300.0),
        (180.0, 200.0),
        (150.0, -250.0),
    ]
    .map(|(x, y)| DVec2::new(x, y));
    let trajectory = Trajectory::through(
        &points,
        3,
        crate::nurbs::interpolate::Parametrization::ChordLength,
    )
    .unwrap();
    let error = design(10.0, 2.0).build(&trajectory).unwrap_err();
    assert!(
        matches!(error, ChannelError::Extrusion(ExtrusionError::Neck { .. })),
        "{error}"
    );
}

#[test]
fn a_corner_that_is_too_sharp_is_called_a_corner() {
    let points = [(0.0, 0.0), (100.0, 0.0), (140.0, 95.0)].map(|(x, y)| DVec2::new(x, y));
    let straight = crate::nurbs::interpolate::Parametrization::ChordLength;
    let trajectory = Trajectory::through(&points, 1, straight).unwrap();
    let error = design(120.0, 4.0).build(&trajectory).unwrap_err();
    assert_eq!(error.reason(), "bend tighter than the half-width");
    let words = error.to_string();
    assert!(
        words.contains("the corner near") && words.contains("round the corner"),
        "{words}"
    );
}

#[test]
fn a_raised_trough_is_the_same_below_its_old_top() {
    let mut overhanging = design(50.0, 5.0);
    overhanging.right_angle = Some(Profile::Constant(120_f64.to_radians()));
    // Rational and upright at its rims; beside one of them the weights differ by more.
    let mut elliptic = design(50.0, 5.0);
    elliptic.own = Some(Arc::new(
        OwnSection::new(&OwnDesign {
            points: [
                (-0.5, 0.0),
                (-0.5, -1.0),
                (0.0, -1.0),
                (0.5, -1.0),
                (0.5, 0.0),
            ]
            .map(|(x, y)| DVec2::new(x, y))
            .to_vec(),
            degree: 2,
            weights: Some(vec![1.0, FRAC_1_SQRT_2, 1.0, 0.3, 1.0]),
            knots: Some(vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0]),
            close: Close::Ruled,
            depth: Depth::Scale,
        })
        .unwrap(),
    ));
    for design in [design(50.0, 5.0), overhanging, elliptic] {
        let channel = design.build(&meander(60.0, 400.0)).unwrap();
        let raised = channel.raised().unwrap();
        for i in 0..=20 {
            for j in 0..=20 {
                let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                assert!((channel.base().point(u, v) - raised.base().point(u, v)).length() < 1e-9);
            }
            let v = f64::from(i) / 20.0;
            let (low, high) = raised.base().knots_u().domain();
            let [left, right] = [raised.base().point(low, v), raised.base().point(high, v)];
            assert!(left.z > -10.0 + 0.1 && right.z > -10.0 + 0.1);
            // No kink at the old rims, nor another speed.
            for rim in [0.0, 1.0] {
                let [a, b] =
                    [-1e-9, 1e-9].map(|du| raised.base().derivatives(rim + du, v, 1)[1][0]);
                assert!((a - b).length() < 1e-4 * a.length(), "{a} {b}");
            }
        }
    }
}
