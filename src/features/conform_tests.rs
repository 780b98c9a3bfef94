#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use glam::DVec3;

use super::*;
use crate::features::body::Role;
use crate::features::displace::evened;
use crate::features::lag::LagDesign;
use crate::features::lobe::LobeDesign;
use crate::features::profile::Profile;
use crate::features::reach::tests::{along, design, meander};
use crate::features::scour::{PitAndWing, ScourDesign, constant_area};
use crate::features::trajectory::Trajectory;
use crate::nurbs::{KnotVector, Surface};

fn scour() -> Shell {
    let width = Profile::Along(vec![(0.0, 20.0), (1.0, 60.0)]);
    let design = ScourDesign {
        depth: constant_area(&width, 3.0),
        width,
        section: PitAndWing {
            pit: 0.35,
            wing_depth: 0.25,
        },
        head: 0.15,
        tail: 0.4,
        top: 0.0,
        angle_limit: 0.2,
        tolerance: 0.01,
    };
    let line = Trajectory::line(DVec2::ZERO, DVec2::new(160.0, 120.0)).unwrap();
    design.build(&line).unwrap()
}

fn lobe() -> Shell {
    let design = LobeDesign {
        center: DVec3::new(50.0, -20.0, 0.0),
        length: 300.0,
        width: 140.0,
        thickness: 4.0,
        azimuth: 1.0,
        taper: 0.5,
        skew: 0.3,
    };
    design.build().unwrap().shell().unwrap()
}

fn lag() -> Shell {
    let mut design = design();
    design.top = Profile::Constant(0.0);
    design.tolerance = 0.01;
    let (_, reach) = along(design, meander());
    let lag = LagDesign {
        thickness: Profile::Constant(0.2),
        sag: Profile::Constant(0.5),
        order: 0,
    };
    lag.build(&reach).unwrap()
}

fn wave(at: DVec2) -> f64 {
    -30.0 + 5.0 * (at.x / 90.0).sin() + 3.0 * (at.y / 70.0 + at.x / 200.0).cos()
}

fn to(height: &dyn Fn(DVec2) -> Option<f64>, depth: f64) -> Target<'_> {
    Target {
        height,
        reference: 0.0,
        depth,
    }
}

/// Points of all sheets of a shell, with their roles.
fn points(shell: &Shell) -> Vec<DVec3> {
    let steps = || (0..=12).map(|k| f64::from(k) / 12.0);
    let of = |(_, sheet): &(Role, Surface)| {
        let sheet = sheet.clone();
        let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
        steps().flat_map(move |u| {
            let sheet = sheet.clone();
            steps().map(move |v| sheet.point(u0 + (u1 - u0) * u, v0 + (v1 - v0) * v))
        })
    };
    shell.sheets().iter().flat_map(of).collect()
}

#[test]
fn a_plane_is_followed_exactly_by_any_net() {
    let plane = |at: DVec2| Some(12.0 + 0.1 * at.x - 0.07 * at.y);
    for shell in [scour(), lobe(), lag()] {
        let made = conform(&shell, &to(&plane, 2.0), 1e-9).unwrap();
        assert!(made.deviation < 1e-11, "{}", made.deviation);
        let same = evened(shell.sheets().to_vec(), 1e-6, LEAST_DEGREE).unwrap();
        let most =
            |sheets: &[(Role, Surface)]| sheets.iter().map(|one| one.1.net().len()).sum::<usize>();
        assert!(
            most(made.shell.sheets()) <= 2 * most(&same),
            "no need to refine"
        );
    }
}

#[test]
fn a_curved_surface_is_followed_within_the_tolerance_between_the_probes_too() {
    let height = |at: DVec2| Some(wave(at));
    for (shell, tolerance) in [(scour(), 0.03), (lobe(), 0.03), (lag(), 0.05)] {
        let made = conform(&shell, &to(&height, 0.0), tolerance).unwrap();
        assert!(made.deviation <= tolerance && made.deviation > 1e-9);
        // A place of the conforming shell, moved back, is on the old one.
        let mut checked = 0;
        for p in points(&made.shell) {
            let back = p - wave(p.truncate()) * DVec3::Z;
            let off = shell.inside().distance(back, 10.0 * tolerance).unwrap();
            assert!(off <= 1.5 * tolerance, "{p}: {off}");
            checked += 1;
        }
        assert!(checked > 300);
    }
}

#[test]
fn a_tighter_tolerance_is_met_with_more_control_points() {
    let height = |at: DVec2| Some(wave(at));
    let target = to(&height, 0.0);
    let [coarse, fine] = [0.1, 1e-4].map(|tolerance| conform(&lobe(), &target, tolerance).unwrap());
    let count = |one: &Conformed| one.shell.sheets()[0].1.net().len();
    assert!(fine.deviation <= 1e-4 && count(&fine) > count(&coarse));
}

/// ∬ z dA over the sheets of a role.
fn under(shell: &Shell, role: Role) -> [f64; 2] {
    use crate::nurbs::quadrature;
    let mut sums = [0.0; 2];
    for (_, sheet) in shell.sheets().iter().filter(|sheet| sheet.0 == role) {
        for us in sheet.knots_u().distinct().windows(2) {
            for vs in sheet.knots_v().distinct().windows(2) {
                for (u, wu) in quadrature::between(quadrature::EIGHT, us[0].0, us[1].0) {
                    for (v, wv) in quadrature::between(quadrature::EIGHT, vs[0].0, vs[1].0) {
                        let d = sheet.derivatives(u, v, 1);
                        let area = d[1][0].truncate().perp_dot(d[0][1].truncate()).abs();
                        sums[0] += wu * wv * area * d[0][0].z;
                        sums[1] += wu * wv * area;
                    }
                }
            }
        }
    }
    sums
}

#[test]
fn the_volume_changes_by_no_more_than_the_deviation_times_the_plan_twice() {
    let height = |at: DVec2| Some(wave(at));
    for shell in [scour(), lobe()] {
        let made = conform(&shell, &to(&height, 1.0), 0.02).unwrap();
        let volume = |shell: &Shell| under(shell, Role::Top)[0] - under(shell, Role::Base)[0];
        let plan = under(&shell, Role::Top)[1];
        let (before, after) = (volume(&shell), volume(&made.shell));
        assert!(
            (after - before).abs() <= 2.0 * made.deviation * plan,
            "{before} {after}"
        );
        assert!((after - before).abs() < 0.01 * before);
    }
}

#[test]
fn control_points_moved_by_a_parabola_would_be_off_and_interpolation_is_not() {
    // T = a x²: a uniform cubic whose control points move by T is off by a h²/3 everywhere.
    let knots = KnotVector::uniform(3, 13).unwrap();
    let (a, h) = (1e-3, 100.0 / 10.0);
    let net = (0..2)
        .flat_map(|i| (0..13).map(move |j| (i, j)))
        .map(|(i, j)| DVec3::new(100.0 * knots.greville(j), f64::from(i), 0.0))
        .collect::<Vec<_>>();
    let across = KnotVector::uniform(1, 2).unwrap();
    let flat = Surface::new(across.clone(), knots.clone(), net.clone()).unwrap();
    let moved = net.iter().map(|p| p.with_z(a * p.x * p.x)).collect();
    let by_points = Surface::new(across, knots, moved).unwrap();
    let middle = by_points.point(0.5, 0.5);
    assert!((middle.z - a * middle.x * middle.x - a * h * h / 3.0).abs() < 1e-12);
    let height = |at: DVec2| Some(a * at.x * at.x);
    let target = to(&height, 0.0);
    let displacement = Displacement {
        by: &|place| target.shift(place),
        tolerance: &|_| 1e-12,
        degree: 1,
    };
    let made = displacement.of(&[(Role::Skin, flat)]).unwrap();
    assert!(made.deviation < 1e-13, "{}", made.deviation);
    let interpolated = &made.sheets[0].1;
    assert!((interpolated.point(0.5, 0.5).z - a * middle.x * middle.x).abs() < 1e-13);
}

#[test]
fn where_the_surface_has_no_elevation_the_place_is_told() {
    let ends = |at: DVec2| (at.x < 100.0).then_some(0.0);
    let error = conform(&scour(), &to(&ends, 0.0), 0.01).unwrap_err();
    let ConformError::NoHeight { x, .. } = error else {
        unreachable!("{error}")
    };
    assert!(x >= 100.0);
    let cliff = |at: DVec2| Some(if at.x < 100.0 { 0.0 } else { 5.0 });
    let error = conform(&lobe(), &to(&cliff, 0.0), 0.01).unwrap_err();
    assert!(matches!(error, ConformError::Unreached { .. }), "{error}");
    let level = |_: DVec2| Some(0.0);
    assert!(conform(&lobe(), &to(&level, 0.0), f64::NAN).is_err());
}
