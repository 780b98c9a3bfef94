//! What is refused, and how many spans the rest needs.

use super::*;

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
