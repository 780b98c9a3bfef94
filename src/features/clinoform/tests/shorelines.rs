//! Shorelines over a domain.

use super::*;

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
