#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use glam::{DVec2, DVec3};

use super::*;
use crate::features::meander::SineGenerated;

const ROOM: Room = Room {
    low: DVec3::new(0.0, 0.0, -20.0),
    high: DVec3::new(1000.0, 800.0, 0.0),
    unit: [-20.0, 0.0],
};

fn design() -> FreeClinoformDesign {
    FreeClinoformDesign {
        height: 20.0,
        length: 300.0,
        steepest: 0.12,
        toe: 0.3,
        crest: 0.0,
        basinward: Basinward::Right,
        azimuth: std::f64::consts::FRAC_PI_2,
    }
}

/// A crest that swings about the line x = 200, going north: basinward is east.
fn crest() -> Trajectory {
    Trajectory::sine_generated(&SineGenerated {
        amplitude: 60.0,
        wavelength: 1500.0,
        azimuth: 0.0,
        center: DVec2::new(200.0, 400.0),
        phase: 0.1,
        extent: [-300.0, 250.0],
    })
    .unwrap()
}

#[test]
fn a_sheet_is_the_sigmoid_between_straight_ends_without_a_kink() {
    let crest = Trajectory::line(DVec2::new(200.0, -50.0), DVec2::new(200.0, 850.0)).unwrap();
    let sheet = design().sheet(&crest, 0.0, 0.0, &ROOM).unwrap();
    let section = sheet.isocurve_v(0.5);
    let slope = sigmoid(20.0, 300.0, 0.12, 0.3).unwrap();
    for k in 0..=20 {
        let u = f64::from(k) / 20.0;
        let (a, b) = (1.0 - u, u);
        let weights = [a * a * a, 3.0 * a * a * b, 3.0 * a * b * b, b * b * b];
        let wanted: DVec2 = slope.iter().zip(weights).map(|(p, w)| *p * w).sum();
        let point = section.point(u);
        // Eastwards from the crest, and as high above the toe.
        assert!((point.x - 200.0 - wanted.x).abs() < 1e-9, "{point}");
        assert!((point.z + 20.0 - wanted.y).abs() < 1e-9, "{point}");
    }
    for joint in [0.0, 1.0] {
        let [before, after] = [-1e-9, 1e-9].map(|by| section.derivatives(joint + by, 1)[1]);
        assert!(before.distance(after) < 1e-4, "{before} {after}");
    }
    let (first, last) = section.domain();
    assert!((section.point(first).z - 1.2).abs() < 1e-9);
    assert!((section.point(last).z + 21.2).abs() < 1e-9);
}

#[test]
fn every_row_is_level_and_the_sheet_reaches_beyond_the_domain_along_strike() {
    let sheet = design().sheet(&crest(), 0.0, 0.0, &ROOM).unwrap();
    let count = sheet.knots_v().count();
    for row in sheet.net().chunks(count) {
        assert!(row.iter().all(|p| p.z == row[0].z));
        assert!(row[0].y < -80.0 && row[count - 1].y > 880.0);
    }
}

#[test]
fn between_two_sheets_lies_their_distance_whatever_the_crest_does() {
    let design = design();
    let [older, younger] = [0.0, 150.0].map(|step| {
        let sheet = design.sheet(&crest(), step, 0.0, &ROOM).unwrap();
        design.side(sheet, &ROOM).unwrap()
    });
    // Along lines to the east what is of one and not of the other is as long as the step.
    for k in 0..40 {
        let part = |ratio: f64| (f64::from(k) * ratio).fract();
        let (y, z) = (800.0 * part(0.754_877_7), -20.0 * part(0.569_840_3));
        let enters = |side: &Side| {
            let (mut low, mut high) = (-1000.0, 2000.0);
            for _ in 0..60 {
                let middle = f64::midpoint(low, high);
                if side.holds(DVec3::new(middle, y, z)) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            low
        };
        assert!((enters(&younger) - enters(&older) - 150.0).abs() < 1e-6);
        assert!(younger.holds(DVec3::new(999.0, y, z)));
    }
}

#[test]
fn a_crest_that_climbs_is_higher_by_its_rise_and_still_leaves_the_unit() {
    let design = FreeClinoformDesign {
        height: 10.0,
        crest: -10.0,
        ..design()
    };
    let sheet = design.sheet(&crest(), 100.0, 4.0, &ROOM).unwrap();
    let section = sheet.isocurve_v(0.3);
    assert!((section.point(0.0).z + 6.0).abs() < 1e-9);
    let (first, last) = section.domain();
    assert!(section.point(first).z > 1.1 && section.point(last).z < -21.1);
}

#[test]
fn crests_that_turn_back_and_sections_that_cannot_be_are_refused() {
    let design = design();
    let back = FreeClinoformDesign {
        azimuth: 0.1,
        ..design
    };
    let refused = back.sheet(&crest(), 0.0, 0.0, &ROOM);
    assert!(matches!(refused, Err(FreeClinoformError::Turned { .. })));
    let level = FreeClinoformDesign { toe: 0.0, ..design };
    let refused = level.sheet(&crest(), 0.0, 0.0, &ROOM);
    assert!(matches!(refused, Err(FreeClinoformError::LevelEnds)));
    let hardly = FreeClinoformDesign {
        steepest: 20.0 / 300.0 * 1.001,
        ..design
    };
    let refused = hardly.sheet(&crest(), 0.0, 0.0, &ROOM);
    assert!(matches!(
        refused,
        Err(FreeClinoformError::NearlyStraight { .. })
    ));
    let tight = Trajectory::through(
        &[
            DVec2::new(200.0, -50.0),
            DVec2::new(320.0, 300.0),
            DVec2::new(320.0, 400.0),
            DVec2::new(200.0, 900.0),
        ],
        3,
        crate::nurbs::interpolate::Parametrization::Centripetal,
    )
    .unwrap();
    let refused = design.sheet(&tight, 0.0, 0.0, &ROOM);
    let folded = matches!(&refused, Err(FreeClinoformError::Extrusion(error)) if matches!(**error, ExtrusionError::Fold { .. }));
    assert!(folded || refused.is_ok(), "{refused:?}");
    assert_eq!(
        Basinward::Left.azimuth(&crest()).map(|a| a < 0.0),
        Some(true)
    );
}
