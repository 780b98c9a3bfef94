#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use super::*;
use crate::nurbs::interpolate::{self, Parametrization};
use crate::nurbs::{KnotVector, Surface};

/// z = bump of a bicubic sheet over [0, 4]², heights up to 1.
fn sheet() -> Surface {
    let knots = KnotVector::uniform(3, 7).unwrap();
    let greville: Vec<f64> = (0..7).map(|i| knots.greville(i)).collect();
    let (a, b) = knots.domain();
    let net = greville.iter().flat_map(|u| {
        greville.iter().map(move |v| {
            let place = |t: f64| 4.0 * (t - a) / (b - a);
            let (x, y) = (place(*u), place(*v));
            DVec3::new(x, y, (1.7 * x).sin() * (1.3 * y).cos())
        })
    });
    Surface::new(knots.clone(), knots.clone(), net.collect()).unwrap()
}

fn height(sheet: &Surface, p: DVec3) -> f64 {
    let (a, b) = sheet.knots_u().domain();
    let at = |x: f64| a + x / 4.0 * (b - a);
    p.z - sheet.point(at(p.x), at(p.y)).z
}

fn line(from: DVec3, to: DVec3) -> Curve {
    Curve::new(KnotVector::uniform(1, 2).unwrap(), vec![from, to]).unwrap()
}

#[test]
fn random_curves_pass_through_a_sheet_where_their_height_above_it_changes_its_sign() {
    let sheet = sheet();
    let target = Target::new(&sheet);
    let mut state = 1_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / 9_007_199_254_740_992.0
    };
    let mut passages = 0;
    for _ in 0..300 {
        let points: Vec<DVec3> = (0..6)
            .map(|_| {
                DVec3::new(
                    0.2 + 3.6 * random(),
                    0.2 + 3.6 * random(),
                    2.4 * random() - 1.2,
                )
            })
            .collect();
        let curve = interpolate::curve(&points, 3, Parametrization::Centripetal).unwrap();
        // Where the spline leaves the sheet's plan there is nothing to compare.
        let within = |p: DVec3| p.x > 0.0 && p.x < 4.0 && p.y > 0.0 && p.y < 4.0;
        let samples = 20_000;
        let at = |k: i32| f64::from(k) / f64::from(samples);
        if !(0..=samples).all(|k| within(curve.point(at(k)))) {
            continue;
        }
        let above = |u: f64| height(&sheet, curve.point(u)) > 0.0;
        let mut expected = Vec::new();
        for k in 0..samples {
            let (mut low, mut high) = (at(k), at(k + 1));
            if above(low) != above(high) {
                for _ in 0..50 {
                    let middle = f64::midpoint(low, high);
                    if above(middle) == above(low) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                expected.push(low);
            }
        }
        let found = meetings(&curve, &target, 1e-9);
        assert!(found.undecided.is_empty());
        let own: Vec<f64> = found.passages.iter().map(|one| one.along).collect();
        assert_eq!(own.len(), expected.len(), "{own:?} {expected:?}");
        for (a, b) in own.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-11, "{a} {b}");
        }
        for one in &found.passages {
            assert!(sheet.point(one.at.x, one.at.y).distance(one.point) < 1e-11);
        }
        passages += own.len();
    }
    assert!(passages > 300, "{passages}");
}

#[test]
fn an_arc_touches_a_plane_at_its_lowest_point_and_a_little_deeper_passes_it_twice() {
    let plane = |z: f64| {
        let knots = KnotVector::uniform(1, 2).unwrap();
        let net =
            [(-3.0, -3.0), (-3.0, 3.0), (3.0, -3.0), (3.0, 3.0)].map(|(x, y)| DVec3::new(x, y, z));
        Surface::new(knots.clone(), knots, net.to_vec()).unwrap()
    };
    // The lower quarter of a unit circle.
    let (w, c) = (0.5_f64.sqrt(), 2.0_f64.sqrt());
    let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]).unwrap();
    let points = vec![
        DVec3::new(-w, 0.1, -w),
        DVec3::new(0.0, 0.1, -c),
        DVec3::new(w, 0.1, -w),
    ];
    let arc = Curve::rational(knots, points, vec![1.0, w, 1.0]).unwrap();
    let below = plane(-1.0);
    let found = meetings(&arc, &Target::new(&below), 1e-9);
    assert!(
        found.passages.is_empty() && found.undecided.len() == 1,
        "{found:?}"
    );
    let [from, to] = found.undecided[0];
    assert!(from <= 0.5 && to >= 0.5 && to - from < 1e-3, "{from} {to}");
    for depth in [1e-2, 1e-4, 1e-6] {
        let (cut, cosine) = (plane(-1.0 + depth), 1.0 - depth);
        let found = meetings(&arc, &Target::new(&cut), 1e-9);
        assert!(found.undecided.is_empty(), "{depth}");
        let half = (1.0 - cosine * cosine).sqrt();
        let x: Vec<f64> = found.passages.iter().map(|one| one.point.x).collect();
        assert_eq!(x.len(), 2, "{depth}");
        assert!((x[0] + half).abs() < 1e-9 && (x[1] - half).abs() < 1e-9);
    }
    assert_eq!(
        meetings(&arc, &Target::new(&plane(-1.0 - 1e-6)), 1e-9),
        Meetings::default()
    );
}

#[test]
fn a_line_in_a_plane_runs_along_it_all_the_way_and_nowhere_else() {
    let sheet = {
        let knots = KnotVector::uniform(1, 2).unwrap();
        let net =
            [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.25));
        Surface::new(knots.clone(), knots, net.to_vec()).unwrap()
    };
    let along = line(DVec3::new(-1.0, 0.3, 0.25), DVec3::new(3.0, 0.4, 0.25));
    let found = meetings(&along, &Target::new(&sheet), 1e-9);
    assert!(found.passages.is_empty());
    assert_eq!(found.undecided.len(), 1, "{found:?}");
    let [from, to] = found.undecided[0];
    assert!(
        (from - 0.25).abs() < 0.02 && (to - 0.5).abs() < 0.02,
        "{from} {to}"
    );
}

#[test]
fn a_place_on_the_border_of_patches_is_found_once_and_a_curve_through_one_place_twice_is_found_twice()
 {
    let sheet = sheet();
    let target = Target::new(&sheet);
    // x = 1 and y = 2 are knots of the sheet.
    let down = line(DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 2.0, -3.0));
    assert_eq!(meetings(&down, &target, 1e-9).passages.len(), 1);
    // There and back on one line.
    let knots = KnotVector::new(1, vec![0.0, 0.0, 1.0, 2.0, 2.0]).unwrap();
    let (top, bottom) = (DVec3::new(1.3, 2.1, 3.0), DVec3::new(1.3, 2.1, -3.0));
    let back = Curve::new(knots, vec![top, bottom, top]).unwrap();
    assert_eq!(meetings(&back, &target, 1e-9).passages.len(), 2);
}
