#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::sync::Arc;

use glam::DVec3;

use super::*;
use crate::features::reach::tests::{along, design, meander};
use crate::features::section::ChannelSection;
use crate::nurbs::Curve;

/// Areas of a base and of what is between it and its lag's top, whose x are the same at equal parameters.
fn areas(base: &[DVec2], degree: usize, depth: f64, thickness: f64, sag: f64) -> [f64; 2] {
    let curve = |points: &[DVec2]| {
        let knots = KnotVector::uniform(degree, points.len()).unwrap();
        Curve::new(knots, points.iter().map(|p| p.extend(0.0)).collect()).unwrap()
    };
    let (lower, upper) = (curve(base), curve(&section(base, depth, thickness, sag)));
    let steps = 100_000;
    let at = |k: u32| {
        let u = f64::from(k) / f64::from(steps);
        let (low, high) = (lower.point(u), upper.point(u));
        assert!((low.x - high.x).abs() < 1e-12);
        (low.x, [-low.y, (high.y - low.y).max(0.0)])
    };
    let mut sums = [0.0; 2];
    for k in 0..steps {
        let (a, b) = (at(k), at(k + 1));
        for (which, sum) in sums.iter_mut().enumerate() {
            *sum += 0.5 * (a.1[which] + b.1[which]) * (b.0 - a.0);
        }
    }
    sums
}

#[test]
fn a_parabolas_lag_has_the_area_of_the_closed_form() {
    let (width, depth) = (50.0, 4.4);
    let parabola = [(-25.0, 0.0), (0.0, -8.8), (25.0, 0.0)].map(|(x, y)| DVec2::new(x, y));
    for f in [0.1, 0.25, 0.5_f64] {
        for g in [0.0, 0.5, 0.8] {
            let wanted = 2.0 / 3.0 * width * depth * f.powf(1.5) / (1.0 - (1.0 - f) * g).sqrt();
            let found = areas(&parabola, 2, depth, f, g)[1];
            assert!(
                (found / wanted - 1.0).abs() < 1e-6,
                "{f} {g}: {found} {wanted}"
            );
        }
    }
}

#[test]
fn the_default_sections_lag_has_its_share_of_the_area() {
    let channel = ChannelSection {
        width: 50.0,
        depth: 4.4,
        asymmetry: 0.0,
        left_angle: None,
        right_angle: None,
    };
    let base = channel.control_points().unwrap();
    for (f, shares) in [
        (0.1, [0.04709, 0.05788, 0.07244]),
        (0.2, [0.11958, 0.14168, 0.16671]),
    ] {
        for (g, wanted) in [0.0, 0.5, 0.8].into_iter().zip(shares) {
            let [whole, lag] = areas(&base, 3, 4.4, f, g);
            assert!((whole / (50.0 * 4.4) - 0.764_563).abs() < 1e-6);
            assert!(
                (lag / whole - wanted).abs() < 6e-6,
                "{f} {g}: {}",
                lag / whole
            );
        }
    }
}

fn lag(thickness: Profile, sag: f64) -> LagDesign {
    LagDesign {
        thickness,
        sag: Profile::Constant(sag),
        order: 0,
    }
}

#[test]
fn a_lags_top_has_the_bases_places_and_passes_over_the_thalweg_at_its_thickness() {
    let (channel, reach) = along(design(), meander());
    let lag = lag(Profile::Constant(0.2), 0.5).build(&reach).unwrap();
    let (top, base) = (lag.sheet(Role::Top).unwrap(), channel.base());
    // The sheet goes on beyond both ends, by as many control points as its degree.
    let (own, beyond) = (base.knots_v().count(), base.knots_v().degree());
    let many = top.knots_v().count();
    assert_eq!(many, own + 2 * beyond);
    for i in 0..7 {
        for j in 0..own {
            let (p, q) = (base.net()[i * own + j], top.net()[i * many + beyond + j]);
            assert!(p.truncate().distance(q.truncate()) < 1e-11);
            // −(1−f)(1−g) D + (1−f) g y
            assert!((q.z + 5.0 - (-0.4 * 4.4 + 0.4 * (p.z + 5.0))).abs() < 1e-12);
        }
    }
    for k in 0..=40 {
        let v = f64::from(k) / 40.0;
        let (floor, above) = (base.point(0.5, v), top.point(0.5, v));
        assert!((above - floor - 0.2 * 4.4 * DVec3::Z).length() < 1e-9);
        for u in [0.0, 1.0] {
            assert!((base.point(u, v).z - top.point(u, v).z - 0.4 * 4.4).abs() < 1e-9);
        }
        assert!(lag.contains(floor + 0.5 * DVec3::Z) && !lag.contains(floor + DVec3::Z));
    }
    let roles: Vec<Role> = lag.sheets().iter().map(|sheet| sheet.0).collect();
    assert_eq!(roles.iter().filter(|role| role.is_geological()).count(), 1);
}

#[test]
fn a_lags_thickness_follows_its_profile_between_the_channels_sections_too() {
    let line = super::super::trajectory::Trajectory::line(DVec2::ZERO, DVec2::new(800.0, 0.0));
    let (channel, reach) = along(design(), line.unwrap());
    assert_eq!(channel.sections().len(), 2);
    let wave = |s: f64| 0.2 + 0.1 * (std::f64::consts::TAU * 3.0 * s).sin();
    let lag = lag(Profile::Function(Arc::new(wave)), 0.5);
    let made = lag.build(&reach).unwrap();
    let top = made.sheet(Role::Top).unwrap();
    for k in 0..=50 {
        let v = f64::from(k) / 50.0;
        let rise = top.point(0.5, v).z - channel.base().point(0.5, v).z;
        // The channel's tolerance: a thousandth of its width.
        assert!((rise - wave(v) * 4.4).abs() < 0.05, "{rise} at {v}");
    }
}

#[test]
fn hidden_sheets_of_two_lags_do_not_coincide() {
    let (_, reach) = along(design(), meander());
    let of = |order: usize| {
        let design = LagDesign {
            order,
            ..lag(Profile::Constant(0.1 + 0.1 * order as f64), 0.5)
        };
        design.build(&reach).unwrap().bounds()
    };
    let (one, other) = (of(0), of(1));
    assert!((one.0.z - other.0.z).abs() > 0.01);
    assert!(one.1.cmplt(other.1).any());
}

#[test]
fn borders_stay_outside_of_banks_that_overhang() {
    let mut overhanging = design();
    overhanging.right_angle = Some(Profile::Constant(120_f64.to_radians()));
    let (channel, reach) = along(overhanging, meander());
    let lag = lag(Profile::Constant(0.3), 0.5).build(&reach).unwrap();
    // Whatever of the base is below the lag's top belongs to the lag.
    let trough = Shell::new(channel.sheets().unwrap()).unwrap();
    let mut held = 0;
    for k in 0..=30 {
        let place = reach
            .trajectory()
            .at(reach.trajectory().length() * f64::from(k) / 30.0);
        for x in -60..=60 {
            let at = (place.point + place.right() * f64::from(x) * 0.5).extend(-5.0 - 0.9 * 4.4);
            if trough.contains(at) {
                assert!(lag.contains(at), "{at}");
                held += 1;
            }
        }
    }
    assert!(held > 300);
}

#[test]
fn lags_that_cannot_be_are_refused() {
    let (_, reach) = along(design(), meander());
    let build = |thickness: Profile, sag: f64| lag(thickness, sag).build(&reach);
    for bad in [0.0, -0.1, 0.7, f64::NAN] {
        let error = build(Profile::Constant(bad), 0.5).unwrap_err();
        assert!(error.to_string().contains("thick"), "{error}");
    }
    // Nothing at one place: it would touch the floor.
    let pinching = Profile::Along(vec![(0.0, 0.3), (0.5, 0.0), (1.0, 0.3)]);
    assert!(build(pinching, 0.5).is_err());
    for sag in [-0.1, 0.9, 1.0, f64::NAN] {
        let error = build(Profile::Constant(0.2), sag).unwrap_err();
        assert!(error.to_string().contains("sag"), "{error}");
    }
}
