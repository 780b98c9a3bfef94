#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

use super::super::frame::FrameError;
use super::*;
use crate::features::horizon::Horizon;

const LOW: DVec3 = DVec3::new(0.0, 0.0, -30.0);
const HIGH: DVec3 = DVec3::new(365.76, 670.56, 0.0);
const AZIMUTHS: [f64; 6] = [0.0, 45.0, 90.0, 180.0, 270.0, 320.0];
/// Table 1 of [J19].
const SHORELINE: Shoreline = Shoreline {
    dip: 3000.0,
    strike: 6000.0,
};

fn frame(azimuth_deg: f64) -> ClinoformFrame {
    ClinoformFrame::new(LOW, HIGH, azimuth_deg.to_radians()).unwrap()
}

fn flat() -> ClinoformUnit {
    let horizon = |z| Horizon::flat(z).unwrap();
    ClinoformUnit::new(horizon(-21.3), horizon(-0.3), LOW, HIGH).unwrap()
}

fn undulating() -> ClinoformUnit {
    let grid = |middle: f64, phase: f64| {
        let height = |i: i32, j: i32| {
            middle + (1.1 * f64::from(i) + phase).sin() * (0.7 * f64::from(j)).cos()
        };
        let rows: Vec<Vec<f64>> = (0..8)
            .map(|j| (0..5).map(|i| height(i, j)).collect())
            .collect();
        Horizon::grid([0.0, 380.0], [0.0, 700.0], &rows).unwrap()
    };
    ClinoformUnit::new(grid(-21.3, 0.0), grid(-1.3, 2.0), LOW, HIGH).unwrap()
}

/// A sheet in the middle of the domain.
fn design(frame: &ClinoformFrame, exponent: f64, toe: f64) -> ClinoformDesign {
    ClinoformDesign {
        origin: frame.first_origin(SHORELINE) + 200.0,
        shoreline: SHORELINE,
        length: 350.0,
        exponent,
        toe,
    }
}

/// z by the formula, at a place in plan; and u there.
fn formula(
    design: &ClinoformDesign,
    unit: &ClinoformUnit,
    azimuth_deg: f64,
    place: DVec2,
) -> (f64, f64) {
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    let off = place - (LOW + HIGH).truncate() / 2.0;
    let (d, q) = (off.x * sin + off.y * cos, off.x * cos - off.y * sin);
    let ellipse = |dip: f64, strike: f64| design.origin + dip * (1.0 - (q / strike).powi(2)).sqrt();
    let top = ellipse(3000.0, 6000.0);
    let toe = ellipse(3000.0 + design.length, 6000.0 + design.length);
    let s = 1.0 - (d - top) / (toe - top);
    let w = if design.exponent == 1.0 {
        s
    } else {
        (1.0 - design.toe) * s.max(0.0).powf(design.exponent) + design.toe * s
    };
    let (base, above) = (
        unit.base().height(place.x, place.y),
        unit.top().height(place.x, place.y),
    );
    (base + w * (above - base), 1.0 - s)
}

/// Places all over the domain's plan.
fn places() -> impl Iterator<Item = DVec2> {
    (0..400).map(|k| {
        let part = |ratio: f64| (f64::from(k) * ratio).fract();
        let part = DVec2::new(part(0.754_877_666), part(0.569_840_291));
        (LOW + (HIGH - LOW) * part.extend(0.0)).truncate()
    })
}

#[test]
fn between_level_horizons_an_exponent_of_2_gives_the_bezier_parabola_of_three_points() {
    for azimuth in AZIMUTHS {
        let frame = frame(azimuth);
        let sheet = Clinoform::new(&design(&frame, 2.0, 0.0), &frame, &flat()).unwrap();
        let surface = sheet.surface();
        assert_eq!(surface.knots_u().degree(), 2);
        assert_eq!(surface.knots_u().count(), 3);
        for part in [-0.9, -0.05, 0.0, 0.6] {
            let q = part * frame.reach();
            let v = (q + frame.reach()) / (2.0 * frame.reach());
            let profile = surface.isocurve_v(v).split(0.0).unwrap().1;
            let local: Vec<DVec3> = profile
                .points()
                .iter()
                .map(|p| frame.local(p.truncate()).extend(p.z + 21.3))
                .collect();
            let ellipse = |dip: f64, strike: f64| {
                frame.first_origin(SHORELINE) + 200.0 + dip * (1.0 - (q / strike).powi(2)).sqrt()
            };
            let (least, most) = (ellipse(3000.0, 6000.0), ellipse(3350.0, 6350.0));
            let bezier = [
                (least, 21.0),
                (f64::midpoint(least, most), 0.0),
                (most, 0.0),
            ];
            for (point, (d, z)) in local.iter().zip(bezier) {
                // The ellipses are splines; q and z are exact.
                assert!((point.x - d).abs() < 1e-3, "{azimuth} {point} {d}");
                assert!((point.y - q).abs() < 1e-9);
                assert!((point.z - z).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn sheets_follow_the_ellipses_of_table_1_within_a_millimetre() {
    for azimuth in AZIMUTHS {
        let frame = frame(azimuth);
        let design = design(&frame, 2.0, 0.0);
        let sheet = Clinoform::new(&design, &frame, &flat()).unwrap();
        assert!(sheet.surface().knots_v().distinct().len() > 14);
        for k in -500..=500 {
            let q = frame.reach() * f64::from(k) / 500.0;
            let ellipse =
                |dip: f64, strike: f64| design.origin + dip * (1.0 - (q / strike).powi(2)).sqrt();
            assert!((sheet.d_top(q) - ellipse(3000.0, 6000.0)).abs() < 1e-3);
            assert!((sheet.d_toe(q) - ellipse(3350.0, 6350.0)).abs() < 1e-3);
        }
    }
}

#[test]
fn sheets_are_within_a_millimetre_of_the_formula_for_every_exponent_toe_and_direction() {
    let (flat, undulating) = (flat(), undulating());
    for azimuth in AZIMUTHS {
        let frame = frame(azimuth);
        for (exponent, toe) in [
            (2.0, 0.0),
            (1.5, 0.0),
            (3.0, 0.0),
            (1.0, 0.0),
            (1.1, 0.0),
            (1.2, 0.3),
            (2.0, 0.3),
            (1.5, 0.3),
            (3.0, 0.3),
            (2.6, 1.0),
        ] {
            for unit in [&flat, &undulating] {
                if toe == 0.0 && exponent > 1.0 && unit.levels().is_none() {
                    continue;
                }
                let design = design(&frame, exponent, toe);
                let sheet = Clinoform::new(&design, &frame, unit).unwrap();
                assert!(sheet.deviation() <= unit.tolerance());
                let (mut worst, mut met): (f64, i32) = (0.0, 0);
                for place in places() {
                    let (z, u) = formula(&design, unit, azimuth, place);
                    let (first, last) = sheet.surface().knots_u().domain();
                    let DVec2 { x: d, y: q } = frame.local(place);
                    if (first + 1e-6..last - 1e-6).contains(&u) {
                        met += 1;
                        let (u, v) = sheet.parameters(d, q);
                        let on = sheet.surface().point(u, v);
                        assert!(on.truncate().distance(place) < 1e-9);
                        worst = worst.max((on.z - z).abs());
                    }
                }
                assert!(met > 50, "{azimuth} {met}");
                assert!(worst < 1.1e-3, "{azimuth} {exponent} {toe}: {worst}");
            }
        }
    }
}

/// A unit between two bent horizons: heights at random on lattices of so many nodes along y.
fn bent(seed: u32, nodes: i32, swing: f64) -> ClinoformUnit {
    let grid = |middle: f64, salt: u32| {
        // Weyl's sequence: any numbers do that are not in step with the lattice.
        let height = |i: i32, j: i32| {
            let step = f64::from(seed * 7 + salt + 1) * 0.618_033_988_749_895;
            let part = (f64::from(i * 31 + j) * step + 0.37 * f64::from(i * j)).fract();
            middle + swing * (2.0 * part - 1.0)
        };
        let rows: Vec<Vec<f64>> = (0..nodes)
            .map(|j| (0..nodes / 2 + 2).map(|i| height(i, j)).collect())
            .collect();
        Horizon::grid([-10.0, 380.0], [-20.0, 700.0], &rows).unwrap()
    };
    ClinoformUnit::new(grid(-21.3, 0), grid(-1.3, 3), LOW, HIGH).unwrap()
}

#[test]
fn sheets_follow_the_formula_between_horizons_of_any_wavelength_and_steepness() {
    let mut finest = 0;
    for (seed, (nodes, swing)) in [
        (4, 3.0),
        (6, 0.5),
        (8, 3.0),
        (11, 1.5),
        (14, 0.3),
        (17, 3.0),
        (21, 1.0),
        (24, 3.0),
    ]
    .into_iter()
    .enumerate()
    {
        let unit = bent(u32::try_from(seed).unwrap(), nodes, swing);
        let azimuth = AZIMUTHS[seed % 6] + 7.0;
        let frame = frame(azimuth);
        let exponent = [2.0, 1.5, 2.7][seed % 3];
        let design = ClinoformDesign {
            length: [350.0, 120.0][seed % 2],
            ..design(&frame, exponent, 0.3)
        };
        let sheet = Clinoform::new(&design, &frame, &unit).unwrap();
        assert!(sheet.deviation() <= unit.tolerance());
        let spans = [sheet.surface().knots_u(), sheet.surface().knots_v()]
            .map(|knots| knots.distinct().len() - 1);
        finest = finest.max(spans[0].max(spans[1]));
        let (first, last) = sheet.surface().knots_u().domain();
        let (mut worst, mut met): (f64, i32) = (0.0, 0);
        for k in 0..40_000 {
            let part = |ratio: f64| (f64::from(k) * ratio).fract();
            let part = DVec2::new(part(0.754_877_666), part(0.569_840_291));
            let place = LOW.truncate() + (HIGH - LOW).truncate() * part;
            let (z, u) = formula(&design, &unit, azimuth, place);
            if (first + 1e-6..last - 1e-6).contains(&u) {
                let v = (frame.local(place).y + frame.reach()) / (2.0 * frame.reach());
                worst = worst.max((sheet.surface().point(u, v).z - z).abs());
                met += 1;
            }
        }
        assert!(met > 5000, "{nodes} nodes: {met}");
        // Measured at places of its own, and with the ellipses' millimetre in plan on slopes of up to 1 in 4.
        assert!(worst < 1.3e-3, "{nodes} nodes, ±{swing} m: {worst}");
    }
    assert!(finest > 64, "no sheet needs more than even spans: {finest}");
}

#[test]
fn horizons_that_are_noise_are_refused_with_the_place_where_they_are() {
    let frame = frame(320.0);
    let unit = bent(5, 90, 3.0);
    let error = Clinoform::new(&design(&frame, 2.0, 0.3), &frame, &unit).unwrap_err();
    let ClinoformError::TooBent { x, y, reached, .. } = error else {
        panic!("{error}");
    };
    assert!(frame.is_near(DVec2::new(x, y), 0.06) && reached > unit.tolerance());
}

#[test]
fn a_sheet_holds_what_is_above_it_to_a_nanometre_and_what_is_basinward_but_nothing_landward() {
    for azimuth in AZIMUTHS {
        let frame = frame(azimuth);
        for (unit, toe) in [(flat(), 0.0), (flat(), 0.3), (undulating(), 0.3)] {
            let design = design(&frame, 2.0, toe);
            let sheet = Clinoform::new(&design, &frame, &unit).unwrap();
            let (first, last) = sheet.surface().knots_u().domain();
            for place in places() {
                let (_, u) = formula(&design, &unit, azimuth, place);
                let middle = place.extend(-10.0);
                if u > last + 1e-5 {
                    assert!(sheet.holds(middle));
                } else if u < first - 1e-5 {
                    assert!(!sheet.holds(middle));
                } else if u > first + 1e-5 && u < last - 1e-5 {
                    // The surface is asked for its own point, by search and not by the frame.
                    let start = place.extend(formula(&design, &unit, azimuth, place).0);
                    let v = (frame.local(place).y + frame.reach()) / (2.0 * frame.reach());
                    let on = sheet.surface().point(u, v);
                    assert!(on.distance(start) < 2e-3);
                    assert!(sheet.holds(on + 1e-9 * DVec3::Z), "{azimuth} {u}");
                    assert!(!sheet.holds(on - 1e-9 * DVec3::Z), "{azimuth} {u}");
                }
            }
        }
    }
}

#[test]
fn sheets_reach_a_twentieth_of_the_height_beyond_the_horizons_or_end_on_a_level_base() {
    for azimuth in AZIMUTHS {
        let frame = frame(azimuth);
        for (unit, exponent, toe) in [
            (flat(), 2.0, 0.0),
            (flat(), 1.5, 0.0),
            (flat(), 2.0, 0.3),
            (undulating(), 2.0, 0.3),
            (undulating(), 1.5, 0.3),
        ] {
            let sheet = Clinoform::new(&design(&frame, exponent, toe), &frame, &unit).unwrap();
            let (first, last) = sheet.surface().knots_u().domain();
            for k in 0..=40 {
                let v = f64::from(k) / 40.0;
                let upper = sheet.surface().point(first, v);
                let near = |p: DVec3| frame.is_near(p.truncate(), 0.0);
                let bounds = |p: DVec3| (unit.base().height(p.x, p.y), unit.top().height(p.x, p.y));
                let (base, top) = bounds(upper);
                assert!(!near(upper) || upper.z - top >= 0.05 * (top - base));
                let lower = sheet.surface().point(last, v);
                let (base, top) = bounds(lower);
                if toe > 0.0 {
                    assert!(!near(lower) || base - lower.z >= 0.05 * (top - base));
                }
            }
            let nv = sheet.surface().knots_v().count();
            let end = &sheet.surface().net()[sheet.surface().net().len() - nv..];
            assert_eq!(end.iter().all(|p| p.z == -21.3), toe == 0.0);
            assert_eq!(last == 1.0, toe == 0.0);
            // All strikes of the domain, and more.
            let strikes = [LOW, HIGH].map(|p| frame.local(p.truncate()).y.abs());
            assert!(frame.reach() > 1.09 * strikes[0].max(strikes[1]));
        }
    }
}

#[test]
fn below_its_base_a_sheet_goes_down_a_sixteenth_of_the_height_but_not_farther_than_half_its_length()
{
    let (frame, unit) = (frame(90.0), flat());
    for (toe, wanted) in [(0.3, 0.06 / 0.3), (0.9, 0.06 / 0.9), (0.01, 0.5)] {
        let design = design(&frame, 2.0, toe);
        let sheet = Clinoform::new(&design, &frame, &unit).unwrap();
        let last = sheet.surface().knots_u().domain().1;
        assert!((last - 1.0 - wanted).abs() < 1e-12, "toe {toe}: {last}");
        // Along its tangent, by the toe's part of the height of 21 m.
        let z = sheet.surface().point(last, 0.5).z;
        assert!((z - (-21.3 - 21.0 * toe * wanted)).abs() < 1e-3, "{z}");
    }
}

#[test]
fn a_sheet_has_an_elevation_from_its_upper_border_to_its_toe_and_none_below_its_base() {
    for (azimuth, unit) in [(320.0, flat()), (45.0, undulating())] {
        let frame = frame(azimuth);
        let design = design(&frame, 2.0, 0.3);
        let sheet = Clinoform::new(&design, &frame, &unit).unwrap();
        for q in [-300.0, 0.0, 250.0] {
            let (top, toe) = (sheet.d_top(q), sheet.d_toe(q));
            assert_eq!(sheet.elevation(toe + 0.01, q), None);
            assert_eq!(sheet.elevation(top - (toe - top), q), None);
            for (d, horizon) in [(top, unit.top()), (toe - 1e-6, unit.base())] {
                let place = frame.place(d, q);
                let off = sheet.elevation(d, q).unwrap() - horizon.height(place.x, place.y);
                assert!(off.abs() < 2e-3, "{off}");
            }
            assert!(sheet.elevation(top - 1.0, q) > sheet.elevation(top, q));
        }
    }
}

#[test]
fn a_tangent_toe_on_a_level_base_stays_on_it_below_an_undulating_top() {
    let base = Horizon::flat(-21.3).unwrap();
    let unit = ClinoformUnit::new(base, undulating().top().clone(), LOW, HIGH).unwrap();
    let frame = frame(320.0);
    let sheet = Clinoform::new(&design(&frame, 2.0, 0.0), &frame, &unit).unwrap();
    let nv = sheet.surface().knots_v().count();
    let net = sheet.surface().net();
    assert!(net[net.len() - nv..].iter().all(|p| p.z == -21.3));
}

#[test]
fn a_shoreline_starts_at_the_most_up_dip_corner_and_has_left_when_no_corner_is_basinward() {
    for azimuth in AZIMUTHS {
        let frame = frame(azimuth);
        let (sin, cos) = azimuth.to_radians().sin_cos();
        let corners = [
            (LOW.x, LOW.y),
            (HIGH.x, LOW.y),
            (LOW.x, HIGH.y),
            (HIGH.x, HIGH.y),
        ]
        .map(|(x, y)| x * sin + y * cos);
        let (least, most) = corners
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), d| {
                (l.min(*d), m.max(*d))
            });
        let extent = most - least;
        let first = frame.first_origin(SHORELINE);
        let (low, high) = frame.dip_range();
        assert!((SHORELINE.at(first, 0.0) - low).abs() < 1e-9);
        assert!((high - low - extent).abs() < 1e-9);
        assert!(!frame.is_beyond(first, SHORELINE));
        // The ellipse lags behind its apex by some metres at the sides.
        assert!(!frame.is_beyond(first + extent - 0.001, SHORELINE));
        assert!(frame.is_beyond(first + extent + 30.0, SHORELINE));
        let place = DVec2::new(120.0, 431.0);
        let local = frame.local(place);
        assert!(frame.place(local.x, local.y).distance(place) < 1e-10);
    }
    // North-west of the centre is basinward for 320°, and strike points north-east.
    let local = frame(320.0).local(DVec2::new(100.0, 500.0));
    assert!(local.x > 0.0 && local.y < 100.0);
    assert!(frame(320.0).strike().x > 0.0 && frame(320.0).strike().y > 0.0);
}

#[test]
fn a_nudged_set_lies_farther_basinwards_at_every_strike() {
    let step = 1e-3;
    for azimuth in AZIMUTHS {
        let azimuth: f64 = azimuth + 3.0;
        let [given, nudged] = [0.0, step]
            .map(|by| ClinoformFrame::nudged(LOW, HIGH, azimuth.to_radians(), by).unwrap());
        let shoreline = |frame: &ClinoformFrame, q: f64| {
            let origin = frame.first_origin(SHORELINE);
            frame.place(SHORELINE.at(origin, q), q)
        };
        for k in -20..=20 {
            let q = 0.9 * given.reach() * f64::from(k) / 20.0;
            // How far the nudged shoreline is from a place on the given one, at that place's strike.
            let place = shoreline(&given, q);
            let local = nudged.local(place);
            let ahead = SHORELINE.at(nudged.first_origin(SHORELINE), local.y) - local.x;
            assert!(
                (0.4..1.7).contains(&(ahead / step)),
                "{azimuth}°, {q}: {ahead}"
            );
        }
    }
}

#[test]
fn a_wide_ellipse_needs_more_spans_and_too_narrow_a_one_is_refused() {
    let frame = frame(90.0);
    let mut design = design(&frame, 2.0, 0.0);
    design.shoreline.strike = 1.4 * frame.reach();
    let sheet = Clinoform::new(&design, &frame, &flat()).unwrap();
    assert!(sheet.surface().knots_v().distinct().len() > 15);
    design.shoreline.strike = 1.000_001 * frame.reach();
    assert!(matches!(
        Clinoform::new(&design, &frame, &flat()),
        Err(ClinoformError::Deviation { spans: 64, .. })
    ));
    design.shoreline.strike = 0.99 * frame.reach();
    assert!(matches!(
        Clinoform::new(&design, &frame, &flat()),
        Err(ClinoformError::Narrow { .. })
    ));
}

#[test]
fn numbers_that_make_no_clinoform_are_refused() {
    let frame = frame(320.0);
    let good = design(&frame, 2.0, 0.3);
    let made = |design: ClinoformDesign| Clinoform::new(&design, &frame, &undulating()).map(|_| ());
    assert_eq!(made(good), Ok(()));
    let length = ClinoformDesign {
        length: 0.0,
        ..good
    };
    assert!(matches!(
        made(length),
        Err(ClinoformError::NotPositive { name: "length", .. })
    ));
    let exponent = ClinoformDesign {
        exponent: -1.0,
        ..good
    };
    assert!(matches!(
        made(exponent),
        Err(ClinoformError::NotPositive {
            name: "exponent",
            ..
        })
    ));
    let exponent = ClinoformDesign {
        exponent: 0.9,
        ..good
    };
    assert_eq!(made(exponent), Err(ClinoformError::Exponent(0.9)));
    let toe = ClinoformDesign { toe: 1.1, ..good };
    assert_eq!(made(toe), Err(ClinoformError::Toe(1.1)));
    let toe = ClinoformDesign { toe: 0.0, ..good };
    assert_eq!(made(toe), Err(ClinoformError::Touching { exponent: 2.0 }));
    let origin = ClinoformDesign {
        origin: f64::INFINITY,
        ..good
    };
    assert_eq!(made(origin), Err(ClinoformError::Origin(f64::INFINITY)));
    let (base, top) = (flat().base().clone(), flat().top().clone());
    assert!(matches!(
        ClinoformUnit::new(top, base, LOW, HIGH),
        Err(FrameError::Nowhere(_))
    ));
    assert!(matches!(
        ClinoformFrame::new(HIGH, LOW, 0.0),
        Err(FrameError::Domain { .. })
    ));
}

#[test]
fn measuring_radially_instead_of_along_dip_changes_sheets_of_table_1_by_less_than_3_millimetres() {
    let frame = frame(320.0);
    for length in [150.0, 900.0] {
        let design = ClinoformDesign {
            length,
            ..design(&frame, 2.0, 0.0)
        };
        let sheet = Clinoform::new(&design, &frame, &flat()).unwrap();
        let mut met = 0;
        for place in places() {
            let local = frame.local(place);
            // Polar coordinates about the origin, φ from the dip axis.
            let (x, y) = (local.x - design.origin, local.y);
            let (phi, r) = (y.atan2(x), x.hypot(y));
            let radius = |a: f64, b: f64| a * b / (b * phi.cos()).hypot(a * phi.sin());
            let least = radius(3000.0, 6000.0);
            let most = radius(3000.0 + length, 6000.0 + length);
            let s = ((most - r) / (most - least)).max(0.0);
            if let Some(z) = sheet.elevation(local.x, local.y) {
                assert!((z - (-21.3 + 21.0 * s * s)).abs() < 3e-3);
                met += 1;
            }
        }
        assert!(met > 50);
    }
}
