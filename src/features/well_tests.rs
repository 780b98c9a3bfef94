#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use super::*;
use crate::features::survey::{Reading, by_angles};

const CHORD: Path = Path::Spline(Parametrization::ChordLength);

fn readings(rows: &[(f64, f64, f64)]) -> Vec<Reading> {
    let reading = |&(md, inclination, azimuth): &(f64, f64, f64)| Reading {
        md,
        inclination: inclination.to_radians(),
        azimuth: azimuth.to_radians(),
    };
    rows.iter().map(reading).collect()
}

/// Vertical, then 3° every 30 m to 90° while turning, then level.
fn survey() -> Vec<Station> {
    let mut rows = vec![(0.0, 0.0, 30.0), (600.0, 0.0, 30.0)];
    for k in 1..=30 {
        rows.push((
            600.0 + 30.0 * f64::from(k),
            3.0 * f64::from(k),
            30.0 + f64::from(k),
        ));
    }
    rows.push((1900.0, 90.0, 60.0));
    by_angles(DVec3::new(100.0, 200.0, 25.0), &readings(&rows)).unwrap()
}

#[test]
fn arcs_have_the_length_of_measured_depth_and_the_directions_of_the_stations() {
    let stations = survey();
    let well = Well::new(stations.clone(), Path::MinimumCurvature).unwrap();
    for pair in stations.windows(2) {
        let (from, to) = (pair[0].md.unwrap(), pair[1].md.unwrap());
        assert!(well.point(to).distance(pair[1].point) < 1e-9);
        assert!(well.tangent(to).distance(pair[1].tangent.unwrap()) < 1e-9);
        let length = well.lengths.between(
            well.parameter(from).unwrap(),
            well.parameter(to).unwrap(),
            1e-10,
        );
        assert!((length - (to - from)).abs() < 1e-8, "{from}: {length}");
    }
    assert!(well.quality().misfit < 1e-10);
    let dogleg = well.quality().dogleg_deg_30m;
    assert!(dogleg > 3.0 && dogleg < 3.2, "{dogleg}");
}

#[test]
fn places_between_stations_of_an_arc_are_those_of_the_circle() {
    // 90° in 300 m: a radius of 600/π.
    let stations = by_angles(
        DVec3::ZERO,
        &readings(&[(0.0, 0.0, 0.0), (300.0, 90.0, 0.0)]),
    )
    .unwrap();
    let well = Well::new(stations, Path::MinimumCurvature).unwrap();
    let radius = 600.0 / std::f64::consts::PI;
    for k in 0..=60 {
        let md = 5.0 * f64::from(k);
        let (sine, cosine) = (md / radius).sin_cos();
        let expected = DVec3::new(0.0, radius * (1.0 - cosine), -radius * sine);
        assert!(well.point(md).distance(expected) < 1e-8, "{md}");
        assert!((well.md(well.parameter(md).unwrap()) - md).abs() < 1e-8);
    }
}

#[test]
fn a_spline_keeps_the_depths_of_its_stations_and_grows_by_its_arc_length_between_them() {
    let stations = survey();
    let well = Well::new(stations.clone(), CHORD).unwrap();
    assert_eq!(well.curve().degree(), 3);
    for station in &stations {
        assert!(well.point(station.md.unwrap()).distance(station.point) < 1e-9);
    }
    let mut last = -1.0;
    for k in 0..=1900 {
        let md = f64::from(k);
        let u = well.parameter(md).unwrap();
        assert!(u > last);
        last = u;
        assert!((well.md(u) - md).abs() < 1e-7, "{md}");
    }
    // Midway in depth is midway in length, by brute force.
    let (a, b) = (stations[10], stations[11]);
    let (from, to) = (a.md.unwrap(), b.md.unwrap());
    let [u0, u1, u2] = [from, f64::midpoint(from, to), to].map(|md| well.parameter(md).unwrap());
    let polygon = |u: f64, v: f64| -> f64 {
        let point = |k: i32| well.curve().point(u + (v - u) * f64::from(k) / 20_000.0);
        (0..20_000).map(|k| point(k).distance(point(k + 1))).sum()
    };
    assert!((polygon(u0, u1) - polygon(u1, u2)).abs() < 1e-6);
    // What the spline leaves the arcs by, where the survey is regular.
    let arcs = Well::new(stations, Path::MinimumCurvature).unwrap();
    let apart = (900..1400).map(|md| {
        well.point(f64::from(md))
            .distance(arcs.point(f64::from(md)))
    });
    let most = apart.fold(0.0, f64::max);
    // A cubic spline misses a circle by about h⁴ κ³ 5/384 within a turn: 6e-5 m here, and more near its ends.
    assert!(most > 1e-5 && most < 1e-3, "{most}");
}

#[test]
fn few_stations_make_straight_and_parabolic_wells() {
    let at = |md, x: f64, z: f64| Station {
        md: Some(md),
        point: DVec3::new(x, 0.0, z),
        tangent: None,
    };
    let two = Well::new(vec![at(0.0, 0.0, 0.0), at(10.0, 0.0, -10.0)], CHORD).unwrap();
    assert_eq!(two.curve().degree(), 1);
    assert!(two.point(3.0).distance(DVec3::new(0.0, 0.0, -3.0)) < 1e-9);
    let three = vec![
        at(0.0, 0.0, 0.0),
        at(10.0, 0.0, -10.0),
        at(20.0, 3.0, -19.0),
    ];
    assert_eq!(Well::new(three, CHORD).unwrap().curve().degree(), 2);
}

#[test]
fn points_without_depths_get_those_of_their_path() {
    let at = |x: f64, z: f64| Station {
        md: None,
        point: DVec3::new(x, 0.0, z),
        tangent: None,
    };
    let well = Well::new(
        vec![at(0.0, 0.0), at(1.0, -9.0), at(4.0, -17.0), at(11.0, -24.0)],
        CHORD,
    )
    .unwrap();
    let (from, to) = well.range();
    assert_eq!(from, 0.0);
    assert!((to - well.curve().length(1e-10)).abs() < 1e-8);
}

#[test]
fn a_lateral_begins_with_its_mothers_control_point_and_along_her_tangent() {
    for path in [CHORD, Path::MinimumCurvature] {
        let plain = Well::new(survey(), path).unwrap();
        for at_md in [750.0, 777.7, 1234.5] {
            let mother = plain.with_junction(at_md).unwrap();
            for k in 0..=100 {
                let md = 19.0 * f64::from(k);
                assert!(mother.point(md).distance(plain.point(md)) < 1e-8, "{md}");
            }
            let (point, tangent) = mother.junction(at_md).unwrap();
            assert!(mother.curve().points().contains(&point));
            assert!(point.distance(plain.point(at_md)) < 1e-8);
            let first = Reading {
                md: at_md,
                inclination: (-tangent.z).acos(),
                azimuth: tangent.x.atan2(tangent.y),
            };
            let mut rows = vec![first];
            for k in 1..=6 {
                rows.push(Reading {
                    md: at_md + 40.0 * f64::from(k),
                    inclination: first.inclination + 0.05 * f64::from(k),
                    azimuth: first.azimuth - 0.1 * f64::from(k),
                });
            }
            let below = by_angles(point, &rows).unwrap();
            let lateral = Well::lateral(&mother, at_md, &below[1..], path).unwrap();
            let own = lateral.curve().points();
            assert_eq!(
                own[0].to_array().map(f64::to_bits),
                point.to_array().map(f64::to_bits)
            );
            let leg = (own[1] - own[0]).normalize();
            assert!(leg.distance(tangent) < 1e-9, "{leg} {tangent}");
            assert_eq!(lateral.range().0, at_md);
            for station in &below[1..] {
                assert!(lateral.point(station.md.unwrap()).distance(station.point) < 1e-8);
            }
            let bore = lateral.bore_from(&mother).unwrap();
            let above = bore[0].points();
            assert_eq!(above[above.len() - 1], own[0]);
            assert_eq!(above, &mother.curve().points()[..above.len()]);
        }
    }
}

#[test]
fn a_depth_where_there_is_no_well_is_refused() {
    let well = Well::new(survey(), CHORD).unwrap();
    assert!(matches!(
        well.with_junction(5000.0),
        Err(WellError::Beyond { .. })
    ));
    assert_eq!(well.parameter(-1.0), None);
}
