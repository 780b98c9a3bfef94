#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{FRAC_PI_2, PI};

use super::*;
use crate::features::ellipsoid::EllipsoidDesign;
use crate::features::fault_surface::FaultSurface;
use crate::features::lobe::LobeDesign;
use crate::features::motion::{Affine, FoldDesign, FoldShape, HeaveDesign, Variation};

const LOW: DVec3 = DVec3::new(-200.0, -150.0, -120.0);
const HIGH: DVec3 = DVec3::new(500.0, 250.0, 80.0);

fn place(k: u32) -> DVec3 {
    let part = |ratio: f64| (f64::from(k) * ratio).fract();
    let unit = DVec3::new(
        part(0.819_172_513),
        part(0.671_043_607),
        part(0.549_700_478),
    );
    LOW + (HIGH - LOW) * unit
}

fn wavy(level: f64) -> Horizon {
    let rows: Vec<Vec<f64>> = (0..9)
        .map(|j| {
            let height = |i: u32| {
                let (x, y) = (f64::from(i) * 0.9, f64::from(j) * 0.7);
                level + 4.0 * x.sin() + 3.0 * y.cos()
            };
            (0..12).map(height).collect()
        })
        .collect();
    Horizon::grid([-400.0, 700.0], [-300.0, 400.0], &rows).unwrap()
}

fn side(level: f64) -> Arc<Side> {
    Arc::new(Side::horizon(wavy(level), LOW, HIGH).unwrap())
}

fn rollover() -> Motions {
    let surface = FaultSurface::circular(DVec3::new(-20.0, 0.0, 60.0), PI / 3.0, 1.4, 160.0);
    let design = HeaveDesign {
        surface: Arc::new(surface.unwrap()),
        azimuth: None,
        heave: Variation::constant(30.0),
        shear: 0.0,
        within: [LOW, HIGH],
    };
    Motions::from(design.build().unwrap())
}

fn fold(axial_dip_deg: f64, tightness: f64) -> Motions {
    let axial_dip = axial_dip_deg.to_radians();
    let design = FoldDesign {
        through: DVec3::new(150.0, 0.0, -20.0),
        azimuth: 3.0 * FRAC_PI_2,
        axial_dip,
        plunge: 0.0,
        shape: FoldShape::pair(20.0, axial_dip, tightness),
    };
    Motions::from(design.build().unwrap())
}

/// Places at which a moved side and the side of where they were say different things, though they are farther from its sheets than it may
/// be off.
fn wrong(before: &Side, after: &Side, motions: &Motions, within: f64) -> u32 {
    let (mut wrong, mut held) = (0, 0);
    for k in 0..3000 {
        let p = place(k);
        let was = motions.inverse(p);
        let near = [-within, within].map(|by| before.holds(was + by * DVec3::Z));
        if near[0] == near[1] {
            wrong += u32::from(after.holds(p) != near[0]);
            held += u32::from(near[0]);
        }
    }
    assert!(held > 300 && held < 2700, "{held}");
    wrong
}

#[test]
fn shifted_horizons_are_horizons_and_nothing_is_off() {
    let by = DVec3::new(13.0, -7.5, -20.0);
    let (moved, deviation) = side(-20.0)
        .after(
            &Motions::from(Motion::Shift(by)),
            [LOW, HIGH],
            1e-3,
            &Reliefs::default(),
        )
        .unwrap();
    assert_eq!(deviation, 0.0);
    let sheet = moved.plan().unwrap();
    for k in 0..200 {
        let at = place(k).truncate();
        let wanted = wavy(-20.0).height(at.x - by.x, at.y - by.y) + by.z;
        assert!((sheet.height(at) - wanted).abs() < 1e-10);
    }
    assert_eq!(moved.role(), Role::Open("horizon"));
    let level = Arc::new(Side::horizon(Horizon::flat(-10.0).unwrap(), LOW, HIGH).unwrap());
    let (moved, _) = level
        .after(
            &Motions::from(Motion::Shift(by)),
            [LOW, HIGH],
            1e-3,
            &Reliefs::default(),
        )
        .unwrap();
    assert_eq!(moved.level(), Some(-30.0));
}

#[test]
fn beds_keep_their_thickness_by_vertical_shear_to_rounding() {
    let motions = rollover();
    let horizons = [-20.0, -31.5].map(|level| {
        let (moved, deviation) = side(level)
            .after(&motions, [LOW, HIGH], 0.01, &Reliefs::default())
            .unwrap();
        assert!(deviation > 1e-6 && deviation <= 0.01, "{deviation}");
        assert_eq!(wrong(&side(level), &moved, &motions, 0.012), 0);
        moved
    });
    let [upper, lower] = horizons.each_ref().map(|side| side.plan().unwrap());
    for k in 0..500 {
        let at = place(k).truncate();
        assert!((upper.height(at) - lower.height(at) - 11.5).abs() < 1e-9);
    }
}

#[test]
fn upright_folds_leave_heights_and_tight_ones_overhang() {
    for (axial_dip, tightness, is_plan) in
        [(90.0, 0.3, true), (70.0, 0.3, true), (20.0, 8.0, false)]
    {
        let motions = fold(axial_dip, tightness);
        let (moved, deviation) = side(-20.0)
            .after(&motions, [LOW, HIGH], 0.02, &Reliefs::default())
            .unwrap();
        assert!(deviation <= 0.02, "{axial_dip}: {deviation}");
        assert_eq!(moved.plan().is_some(), is_plan, "{axial_dip}");
        assert_eq!(wrong(&side(-20.0), &moved, &motions, 0.2), 0, "{axial_dip}");
        // All places of its sheets come from places of the horizon.
        for sheet in moved.sheets() {
            let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
            for k in 0..400 {
                let at = (place(k) - LOW) / (HIGH - LOW);
                let on = sheet.point(u0 + (u1 - u0) * at.x, v0 + (v1 - v0) * at.y);
                let inside = on.cmpgt(LOW).all() && on.cmplt(HIGH).all();
                let was = motions.inverse(on);
                let miss = was.z - wavy(-20.0).height(was.x, was.y);
                // Off by no more than the tolerance, seen along an upright line, which limbs are far from being across.
                assert!(
                    !inside || miss.abs() < 0.02 * (2.0 + tightness),
                    "{axial_dip}: {miss}"
                );
            }
        }
    }
}

#[test]
fn tilted_levels_are_planes() {
    let level = Arc::new(Side::horizon(Horizon::flat(-10.0).unwrap(), LOW, HIGH).unwrap());
    let motions =
        Motions::from(Affine::tilt(DVec3::new(50.0, 0.0, -10.0), 0.2, FRAC_PI_2).unwrap());
    let (moved, deviation) = level
        .after(&motions, [LOW, HIGH], 1e-3, &Reliefs::default())
        .unwrap();
    assert_eq!(deviation, 0.0);
    for k in 0..50 {
        let at = place(k).truncate();
        let wanted = -10.0 - (at.x - 50.0) * 0.2_f64.tan();
        assert!((moved.height(at).unwrap() - wanted).abs() < 1e-10);
    }
    // A bent one is looked for along upright lines.
    let (moved, deviation) = side(-20.0)
        .after(&motions, [LOW, HIGH], 0.005, &Reliefs::default())
        .unwrap();
    assert!(deviation <= 0.005 && moved.plan().is_some());
    assert_eq!(wrong(&side(-20.0), &moved, &motions, 0.01), 0);
}

/// ∬ z dx dy over all sheets with their outward sides: the volume, by Gauss's theorem with signs by the shell itself.
fn volume(shell: &Shell) -> f64 {
    use crate::nurbs::quadrature;
    let size = (shell.bounds().1 - shell.bounds().0).length();
    let mut sum = 0.0;
    for (_, sheet) in shell.sheets() {
        let middle = |(a, b): (f64, f64)| a + 0.431 * (b - a);
        let (u, v) = (
            middle(sheet.knots_u().domain()),
            middle(sheet.knots_v().domain()),
        );
        let normal = sheet.normal(u, v).unwrap();
        let outward = if shell.contains(sheet.point(u, v) + 1e-5 * size * normal) {
            -1.0
        } else {
            1.0
        };
        for us in sheet.knots_u().distinct().windows(2) {
            for vs in sheet.knots_v().distinct().windows(2) {
                for (u, wu) in quadrature::between(quadrature::EIGHT, us[0].0, us[1].0) {
                    for (v, wv) in quadrature::between(quadrature::EIGHT, vs[0].0, vs[1].0) {
                        let d = sheet.derivatives(u, v, 1);
                        let normal = d[1][0].cross(d[0][1]);
                        sum += outward * wu * wv * normal.z * (d[0][0].z + 20.0);
                    }
                }
            }
        }
    }
    sum
}

#[test]
fn bodies_keep_their_volumes_within_the_deviation() {
    let ellipsoid = EllipsoidDesign {
        center: DVec3::new(150.0, 10.0, -15.0),
        semi_axes: [60.0, 40.0, 15.0],
        azimuth: 0.4,
        plunge: 0.2,
    };
    let lobe = LobeDesign {
        center: DVec3::new(140.0, 0.0, -15.0),
        length: 200.0,
        width: 120.0,
        thickness: 8.0,
        azimuth: 1.0,
        taper: 0.5,
        skew: 0.3,
    };
    let bodies = [
        Body::Ellipsoid(ellipsoid.build().unwrap()),
        Body::Shell(lobe.build().unwrap().shell().unwrap()),
    ];
    for body in bodies {
        let whole = Shell::new(body.sheets().unwrap()).unwrap();
        let before = volume(&whole);
        let tilt = Motions::from(Affine::tilt(DVec3::ZERO, 0.3, 0.5).unwrap());
        for (motions, tolerance) in [
            (rollover(), 0.02),
            (fold(90.0, 0.3), 0.02),
            (fold(30.0, 3.0), 0.1),
            (tilt, 0.02),
        ] {
            let (moved, deviation) = body
                .moved(&motions, [LOW, HIGH], tolerance, &Reliefs::default())
                .unwrap();
            assert!(deviation <= tolerance, "{deviation}");
            let Body::Shell(shell) = moved else {
                unreachable!()
            };
            let after = volume(&shell);
            // Skins are below 30,000 m² and grow where they are folded.
            assert!(
                (after - before).abs() < 4e4 * deviation + 1e-7 * before,
                "{before} {after} {deviation}"
            );
            // What is inside now was inside.
            for k in 0..1500 {
                let p = place(k);
                let was = motions.inverse(p);
                if whole.inside().distance(was, 6.0 * tolerance).is_none() {
                    assert_eq!(shell.contains(p), whole.contains(was), "{p}");
                }
            }
        }
    }
}

#[test]
fn what_is_shifted_stays_what_it_was() {
    let by = DVec3::new(5.0, 6.0, -7.0);
    let motions = Motions::from(Motion::Shift(by));
    let design = EllipsoidDesign {
        center: DVec3::new(1.0, 2.0, 3.0),
        semi_axes: [6.0, 4.0, 2.0],
        azimuth: 0.4,
        plunge: 0.2,
    };
    let body = Body::Ellipsoid(design.build().unwrap());
    let (moved, deviation) = body
        .moved(&motions, [LOW, HIGH], 1e-3, &Reliefs::default())
        .unwrap();
    let Body::Ellipsoid(ellipsoid) = moved else {
        unreachable!()
    };
    assert_eq!(
        (ellipsoid.center(), deviation),
        (DVec3::new(6.0, 8.0, -4.0), 0.0)
    );
    let (same, _) = body
        .moved(&Motions::none(), [LOW, HIGH], 1e-3, &Reliefs::default())
        .unwrap();
    assert_eq!(same, body);
}

#[test]
fn a_fault_that_a_younger_one_displaces_is_two_planes() {
    let older = FaultSurface::planar(DVec3::new(100.0, 0.0, 0.0), PI / 3.0, FRAC_PI_2).unwrap();
    let younger =
        FaultSurface::planar(DVec3::new(160.0, 0.0, 0.0), PI / 3.0, 3.0 * FRAC_PI_2).unwrap();
    let slip = younger.slip(12.0, -FRAC_PI_2).unwrap();
    let motions = Motions::from(Motion::Shift(slip));
    let [low, high] = motions.before([LOW, HIGH]);
    let side = Arc::new(Arc::new(older.clone()).side(low, high, 30.0).unwrap());
    let (moved, deviation) = side
        .after(&motions, [LOW, HIGH], 1e-3, &Reliefs::default())
        .unwrap();
    assert_eq!(deviation, 0.0);
    let normal = older.normal(LOW);
    for k in 0..300 {
        let p = place(k);
        // −D sin(δ_A + δ_B) along its normal.
        let off = normal.dot(p - older.through()) + 12.0 * (2.0 * PI / 3.0).sin();
        assert_eq!(moved.holds(p), off > 0.0);
        let on = p - off * normal;
        let sheet = &moved.sheets()[0];
        assert!(sheet.invert(on, 1e-9).is_some() || !on.cmpgt(LOW).all() || !on.cmplt(HIGH).all());
    }
}
