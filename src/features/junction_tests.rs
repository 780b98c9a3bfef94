#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::FRAC_PI_2;

use super::*;
use crate::features::meander::SineGenerated;

/// Eastwards along y = 0.
fn trunk() -> Trajectory {
    Trajectory::line(DVec2::new(-1000.0, 0.0), DVec2::new(1000.0, 0.0)).unwrap()
}

fn junction(angle_deg: f64, bank: Option<Bank>) -> Junction {
    Junction {
        at: 0.6,
        bank,
        angle: angle_deg.to_radians(),
        radius: 90.0,
        clearance: 60.0,
    }
}

fn line(from: [f64; 2], to: [f64; 2]) -> Trajectory {
    Trajectory::line(DVec2::from_array(from), DVec2::from_array(to)).unwrap()
}

#[test]
fn a_tributary_ends_on_the_trunks_line_and_arrives_at_its_angle() {
    let meander = Trajectory::sine_generated(&SineGenerated {
        amplitude: 60.0,
        wavelength: 300.0,
        azimuth: 0.8 * std::f64::consts::PI,
        center: DVec2::new(-100.0, 500.0),
        phase: 0.1,
        extent: [-400.0, 700.0],
    })
    .unwrap();
    for course in [line([-300.0, 700.0], [400.0, 100.0]), meander] {
        for angle in [30.0, 60.0, 90.0] {
            let way = junction(angle, None).join(&course, &trunk()).unwrap();
            let end = way.at(way.length());
            assert!(end.point.distance(DVec2::new(200.0, 0.0)) < 1e-9, "{end:?}");
            // From the left: to the right of east.
            assert!((end.tangent() - DVec2::from_angle(-f64::to_radians(angle))).length() < 1e-9);
            let start = course.places()[0];
            assert!(way.at(0.0).point.distance(start.point) < 1e-9);
            assert!((way.at(0.0).tangent() - start.tangent()).length() < 1e-9);
            // No sharper than three widths, where the course itself is not.
            let sharpest = |line: &Trajectory| {
                let (left, right) = line.sharpest();
                left.max(right)
            };
            let most = sharpest(&course).max(1.0 / 75.0) + 1e-12;
            assert!(sharpest(&way) <= most, "{}", 1.0 / sharpest(&way));
            // All of it on one side.
            for place in way.places() {
                assert!(place.point.y > -1e-9, "{place:?}");
            }
        }
    }
}

#[test]
fn the_way_is_smooth_and_its_arc_length_is_right() {
    let course = line([-300.0, -700.0], [400.0, -100.0]);
    let way = junction(60.0, Some(Bank::Right))
        .join(&course, &trunk())
        .unwrap();
    let mut length = 0.0;
    for pair in way.places().windows(2) {
        let step = pair[1].point - pair[0].point;
        length += step.length();
        let turned = pair[1].direction - pair[0].direction;
        let mean = f64::midpoint(pair[0].curvature, pair[1].curvature);
        assert!(
            (turned - mean * (pair[1].s - pair[0].s)).abs() < 1e-4,
            "{pair:?}"
        );
        assert!((pair[1].curvature - pair[0].curvature).abs() < 2e-3);
    }
    assert!((length / way.length() - 1.0).abs() < 1e-4);
    // It follows its course for a while: the course's first half is its own.
    let half = course.at(0.5 * course.length()).point;
    let nearest = way.places().iter().map(|place| place.point.distance(half));
    let on_line = way.at(0.4 * course.length()).point;
    let along = course.at(0.4 * course.length()).point;
    assert!(on_line.distance(along) < 1e-9, "{on_line} {along}");
    assert!(nearest.fold(f64::INFINITY, f64::min) < 200.0);
}

#[test]
fn courses_that_begin_in_the_trunk_or_on_the_wrong_side_are_refused() {
    let from_right = line([-300.0, -700.0], [400.0, -100.0]);
    let error = junction(60.0, Some(Bank::Left)).join(&from_right, &trunk());
    assert!(matches!(
        error,
        Err(JunctionError::Side {
            side: "right",
            wanted: "left",
            ..
        })
    ));
    let inside = line([-300.0, 20.0], [400.0, 100.0]);
    let error = junction(60.0, None).join(&inside, &trunk());
    assert!(matches!(error, Err(JunctionError::Begins(_))));
    // Two limbs of a meander before the junction.
    let bent = Trajectory::parametric(
        &|t: f64| 150.0 * DVec2::from_angle(FRAC_PI_2 - t),
        [-2.5, 2.5],
    )
    .unwrap();
    let far = line([0.0, -600.0], [0.0, -500.0]);
    let at = Junction {
        at: 0.5,
        ..junction(60.0, None)
    };
    let error = at.join(&far, &bent);
    assert!(error.is_err(), "{error:?}");
}
