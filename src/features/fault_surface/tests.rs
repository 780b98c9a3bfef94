#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{FRAC_PI_2, PI};

use super::*;

const LOW: DVec3 = DVec3::new(-300.0, -200.0, -500.0);
const HIGH: DVec3 = DVec3::new(1000.0, 350.0, 60.0);
const DIP: f64 = PI / 3.0;

fn all() -> Vec<Arc<FaultSurface>> {
    let through = DVec3::new(20.0, 30.0, 10.0);
    let places = [
        [-100.0, 150.0],
        [0.0, 10.0],
        [150.0, -120.0],
        [400.0, -200.0],
        [700.0, -230.0],
    ];
    let rows: Vec<Vec<f64>> = (0..5)
        .map(|j| {
            (0..6)
                .map(|i| 200.0 - 150.0 * f64::from(i) + 9.0 * f64::from(i * j % 3))
                .collect()
        })
        .collect();
    let grid = Horizon::grid([-400.0, 1100.0], [-300.0, 400.0], &rows).unwrap();
    [
        FaultSurface::planar(through, DIP, 1.0),
        FaultSurface::planar(through, FRAC_PI_2, 0.4),
        FaultSurface::circular(through, DIP, FRAC_PI_2, 400.0),
        FaultSurface::circular(through, 0.9, 5.0, 150.0),
        FaultSurface::exponential(through, DIP, 2.0, 300.0),
        FaultSurface::profile(through, 0.0, &places),
        FaultSurface::profile(through, FRAC_PI_2, &[[0.0, 0.0], [100.0, -80.0]]),
        FaultSurface::graph(grid, DVec2::new(300.0, 0.0), FRAC_PI_2),
    ]
    .into_iter()
    .map(|made| Arc::new(made.unwrap()))
    .collect()
}

fn parts(k: u32) -> DVec3 {
    let part = |ratio: f64| (f64::from(k) * ratio).fract();
    DVec3::new(
        part(0.819_172_513),
        part(0.671_043_607),
        part(0.549_700_478),
    )
}

#[test]
fn sheet_and_side_agree_to_a_nanometre() {
    for fault in all() {
        let sheet = fault.sheet(LOW, HIGH, 40.0).unwrap();
        let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
        for k in 0..300 {
            let at = parts(k);
            let on = sheet.point(u0 + (u1 - u0) * at.x, v0 + (v1 - v0) * at.y);
            let normal = fault.normal(on);
            assert!((normal.length() - 1.0).abs() < 1e-12 && normal.z >= 0.0);
            assert!(fault.is_above(on + 3e-9 * normal), "{fault:?} {on}");
            assert!(!fault.is_above(on - 3e-9 * normal), "{fault:?} {on}");
            if let Some(height) = fault.height(on.truncate()) {
                assert!((height - on.z).abs() < 3e-9);
            }
        }
    }
}

#[test]
fn the_side_is_the_closed_shell_within_the_box_and_the_sheet_covers_it() {
    for fault in all() {
        let side = fault.side(LOW, HIGH, 40.0).unwrap();
        let shell = match side.ends() {
            Ends::Closed(shell) => shell.clone(),
            Ends::Plan(_) => continue,
            _ => unreachable!(),
        };
        let mut both = [0; 2];
        for k in 0..800 {
            let p = LOW + (HIGH - LOW) * parts(k);
            assert_eq!(side.holds(p), shell.contains(p), "{fault:?} {p}");
            both[usize::from(side.holds(p))] += 1;
        }
        assert!(both[0] > 50 && both[1] > 50, "{both:?}");
    }
}

/// No angle between the tangents on both sides of any knot, and no jump of their lengths.
#[test]
fn sheets_have_no_kinks() {
    for fault in all() {
        let sheet = fault.sheet(LOW, HIGH, 40.0).unwrap();
        let inner = sheet.knots_u().distinct();
        for (knot, count) in &inner[1..inner.len() - 1] {
            if *count < sheet.knots_u().degree() {
                continue;
            }
            let (before, after) = sheet.split_u(*knot).unwrap();
            let v = 0.5 * (sheet.knots_v().domain().0 + sheet.knots_v().domain().1);
            let [a, b] = [&before, &after].map(|part| part.derivatives(*knot, v, 1)[1][0]);
            assert!(
                a.distance(b) < 1e-9 * a.length(),
                "{fault:?} {knot} {a} {b}"
            );
        }
    }
}

#[test]
fn the_arc_has_its_radius_and_its_end_in_closed_form() {
    // δ₀ = 60°, H = 400 m: R = 800 m, level from x = 692.8 m on.
    let fault = FaultSurface::circular(DVec3::ZERO, DIP, FRAC_PI_2, 400.0).unwrap();
    let at = |x: f64| fault.height(DVec2::new(x, 17.0)).unwrap();
    assert!((at(-10.0) - 10.0 * DIP.tan()).abs() < 1e-12);
    assert!((at(800.0 * DIP.sin()) + 400.0).abs() < 1e-12 && (at(3000.0) + 400.0).abs() < 1e-12);
    // Every place of the arc is 800 m from its centre, which is above its end.
    let centre = DVec2::new(800.0 * DIP.sin(), 400.0);
    for x in [1.0, 100.0, 350.0, 692.0] {
        assert!((DVec2::new(x, at(x)).distance(centre) - 800.0).abs() < 1e-10);
    }
    assert!((fault.slope(DVec2::new(0.001, 0.0)) + DIP.tan()).abs() < 1e-4);
}

#[test]
fn an_exponential_is_within_a_millionth_of_its_depth() {
    let fault = FaultSurface::exponential(DVec3::ZERO, DIP, FRAC_PI_2, 400.0).unwrap();
    for k in 0..2000 {
        let x = f64::from(k);
        let wanted = 400.0 * (-x * DIP.tan() / 400.0).exp_m1();
        let height = fault.height(DVec2::new(x, 0.0)).unwrap();
        assert!((height - wanted).abs() < 4e-4, "{x}: {height} {wanted}");
    }
}

#[test]
fn profiles_pass_through_their_points() {
    let places = [
        [-100.0, 150.0],
        [0.0, 10.0],
        [150.0, -120.0],
        [400.0, -200.0],
        [700.0, -230.0],
    ];
    let fault = FaultSurface::profile(DVec3::new(1.0, 2.0, 3.0), 0.0, &places).unwrap();
    for [x, z] in places {
        let height = fault.height(DVec2::new(50.0, 2.0 + x)).unwrap();
        assert!((height - 3.0 - z).abs() < 1e-11, "{x}: {height}");
    }
    assert!(FaultSurface::profile(DVec3::ZERO, 0.0, &places[..1]).is_err());
    let back = [[0.0, 0.0], [50.0, -10.0], [40.0, -30.0]];
    assert!(FaultSurface::profile(DVec3::ZERO, 0.0, &back).is_err());
}

#[test]
fn slip_has_the_throw_and_the_heave_of_its_rake() {
    let fault = FaultSurface::planar(DVec3::ZERO, DIP, FRAC_PI_2).unwrap();
    // Dip to the east: strike is north, the dip to the right of it.
    assert!(fault.strike().distance(DVec2::Y) < 1e-15);
    for (rake_deg, wanted) in [
        (-90.0, [0.5, 0.0, -DIP.sin()]),
        (90.0, [-0.5, 0.0, DIP.sin()]),
        (0.0, [0.0, 1.0, 0.0]),
        (180.0, [0.0, -1.0, 0.0]),
    ] {
        let slip = fault.slip(10.0, f64::to_radians(rake_deg)).unwrap();
        assert!(
            slip.distance(10.0 * DVec3::from_array(wanted)) < 1e-12,
            "{rake_deg}: {slip}"
        );
    }
}

#[test]
fn dips_and_depths_that_are_none_are_refused() {
    assert!(FaultSurface::planar(DVec3::ZERO, 0.0, 0.0).is_err());
    assert!(FaultSurface::planar(DVec3::ZERO, 1.6, 0.0).is_err());
    assert!(FaultSurface::planar(DVec3::NAN, 1.0, 0.0).is_err());
    assert!(FaultSurface::circular(DVec3::ZERO, FRAC_PI_2, 0.0, 100.0).is_err());
    assert!(FaultSurface::exponential(DVec3::ZERO, 1.0, 0.0, -1.0).is_err());
}
