//! Sheets follow their formula.

use super::*;

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
