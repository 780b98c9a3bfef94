#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use glam::{DVec2, DVec3};

use super::*;
use crate::features::meander::SineGenerated;

const ROOM: Room = Room {
    low: DVec3::new(0.0, 0.0, -20.0),
    high: DVec3::new(1000.0, 800.0, 0.0),
    unit: [-20.0, 0.0],
    is_level: true,
};

/// Topset, slope and bottomset.
fn three(sheets: Result<Vec<Surface>, FreeClinoformError>) -> [Surface; 3] {
    sheets.unwrap().try_into().unwrap()
}

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
    let [topset, slope, bottomset] = three(design().sheets(&crest, 0.0, 0.0, &ROOM));
    let section = slope.isocurve_v(0.5);
    let wanted = sigmoid(20.0, 300.0, 0.12, 0.3).unwrap();
    for k in 0..=20 {
        let u = f64::from(k) / 20.0;
        let (a, b) = (1.0 - u, u);
        let weights = [a * a * a, 3.0 * a * a * b, 3.0 * a * b * b, b * b * b];
        let wanted: DVec2 = wanted.iter().zip(weights).map(|(p, w)| *p * w).sum();
        let point = section.point(u);
        // Eastwards from the crest, and as high above the toe.
        assert!((point.x - 200.0 - wanted.x).abs() < 1e-9, "{point}");
        assert!((point.z + 20.0 - wanted.y).abs() < 1e-9, "{point}");
    }
    // Across a straight crest the three have one gradient where they meet, and leave the unit by 6 % of its height.
    let tangent = |sheet: &Surface, u: f64| sheet.derivatives(u, 0.5, 1)[1][0].normalize();
    assert!(tangent(&topset, 1.0).distance(tangent(&slope, 0.0)) < 1e-12);
    assert!(tangent(&bottomset, 0.0).distance(tangent(&slope, 1.0)) < 1e-12);
    assert!((topset.point(0.0, 0.5).z - 1.2).abs() < 1e-9);
    assert!((bottomset.point(1.0, 0.5).z + 21.2).abs() < 1e-9);
}

#[test]
fn every_row_is_level_and_the_sheet_reaches_beyond_the_domain_along_strike() {
    for sheet in design().sheets(&crest(), 0.0, 0.0, &ROOM).unwrap() {
        let count = sheet.knots_v().count();
        for row in sheet.net().chunks(count) {
            assert!(row.iter().all(|p| p.z == row[0].z));
            assert!(row[0].y < -39.0 && row[count - 1].y > 839.0);
        }
    }
}

#[test]
fn between_two_sheets_lies_their_distance_whatever_the_crest_does() {
    let design = design();
    let [older, younger] = [0.0, 150.0].map(|step| {
        let sheets = design.sheets(&crest(), step, 0.0, &ROOM).unwrap();
        design.side(&sheets, &ROOM).unwrap()
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
    let [topset, slope, bottomset] = three(design.sheets(&crest(), 100.0, 4.0, &ROOM));
    assert!((slope.point(0.0, 0.3).z + 6.0).abs() < 1e-9);
    assert!(topset.point(0.0, 0.3).z > 1.1 && bottomset.point(1.0, 0.3).z < -21.1);
}

#[test]
fn crests_that_turn_back_and_sections_that_cannot_be_are_refused() {
    let design = design();
    let back = FreeClinoformDesign {
        azimuth: 0.1,
        ..design
    };
    let refused = back.sheets(&crest(), 0.0, 0.0, &ROOM);
    assert!(matches!(refused, Err(FreeClinoformError::Turned { .. })));
    let level = FreeClinoformDesign { toe: 0.0, ..design };
    let lower = level.sheets(&crest(), 0.0, -1.0, &ROOM);
    assert!(matches!(lower, Err(FreeClinoformError::LevelEnds { .. })));
    let bent = Room {
        is_level: false,
        ..ROOM
    };
    let refused = level.sheets(&crest(), 0.0, 0.0, &bent);
    assert!(matches!(refused, Err(FreeClinoformError::LevelEnds { .. })));
    // On level bounds there are two halves, which end on them.
    let halves = level.sheets(&crest(), 0.0, 0.0, &ROOM).unwrap();
    let ends = halves.iter().map(Surface::net);
    let levels: Vec<[f64; 2]> = ends.map(|net| [net[0].z, net[net.len() - 1].z]).collect();
    assert_eq!(levels, [[0.0, -10.0], [-10.0, -20.0]]);
    let hardly = FreeClinoformDesign {
        steepest: 20.0 / 300.0 * 1.001,
        ..design
    };
    let refused = hardly.sheets(&crest(), 0.0, 0.0, &ROOM);
    assert!(matches!(
        refused,
        Err(FreeClinoformError::NearlyStraight { .. })
    ));
    // A bend of 200 m about its inside, which is basinward: shorter than the slope is long.
    let tight = Trajectory::parametric(
        &|t: f64| {
            let (sin, cos) = t.sin_cos();
            DVec2::new(600.0 - 200.0 * cos, 400.0 + 200.0 * sin)
        },
        [-1.0, 1.0],
    );
    let refused = design.sheets(&tight.unwrap(), 0.0, 0.0, &ROOM);
    let is_fold = matches!(&refused, Err(FreeClinoformError::Extrusion(error)) if matches!(**error, ExtrusionError::Fold { .. }));
    assert!(is_fold, "{refused:?}");
    assert_eq!(
        Basinward::Left.azimuth(&crest()).map(|a| a < 0.0),
        Some(true)
    );
}
