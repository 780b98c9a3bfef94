//! Where sheets begin and end, and what they hold.

use super::*;

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
