//! Properties that hold for every rational curve and surface, on random ones.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use clinothem::nurbs::interpolate::{self, Parametrization};
use clinothem::nurbs::{Curve, KnotVector, Surface};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

/// Coordinates go to ±SIZE; rounding is measured against it.
const SIZE: f64 = 100.0;

fn knots(degrees: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = KnotVector> {
    let spans = prop::collection::vec((0.1..1.0, any::<prop::sample::Index>()), 1..5);
    (degrees, spans, -3.0..3.0).prop_map(|(degree, spans, start)| {
        let mut knots = vec![start; degree + 1];
        let mut last = start;
        for (k, (width, multiplicity)) in spans.iter().enumerate() {
            last += width;
            let inner = multiplicity.index(degree) + 1;
            let times = if k + 1 == spans.len() {
                degree + 1
            } else {
                inner
            };
            knots.extend(std::iter::repeat_n(last, times));
        }
        KnotVector::new(degree, knots).unwrap()
    })
}

fn point() -> impl Strategy<Value = DVec3> {
    let x = || -SIZE..SIZE;
    (x(), x(), x()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn weights(rational: bool, count: usize) -> impl Strategy<Value = Vec<f64>> {
    let range = if rational { 0.3..3.0 } else { 1.0..1.000_000_1 };
    prop::collection::vec(
        range.prop_map(move |w| if rational { w } else { 1.0 }),
        count,
    )
}

fn curve() -> impl Strategy<Value = Curve> {
    (knots(1..=5), any::<bool>()).prop_flat_map(|(knots, rational)| {
        let count = knots.count();
        let net = (
            prop::collection::vec(point(), count),
            weights(rational, count),
        );
        net.prop_map(move |(points, weights)| {
            Curve::rational(knots.clone(), points, weights).unwrap()
        })
    })
}

fn surface() -> impl Strategy<Value = Surface> {
    (knots(1..=3), knots(1..=3), any::<bool>()).prop_flat_map(|(u, v, rational)| {
        let count = u.count() * v.count();
        let net = (
            prop::collection::vec(point(), count),
            weights(rational, count),
        );
        net.prop_map(move |(net, weights)| {
            Surface::rational(u.clone(), v.clone(), net, weights).unwrap()
        })
    })
}

/// Parameters all over a domain, its ends and knots included.
fn parameters(knots: &KnotVector) -> Vec<f64> {
    let (start, end) = knots.domain();
    let mut all: Vec<f64> = (0..=24)
        .map(|k| (start + (end - start) * f64::from(k) / 24.0).min(end))
        .collect();
    all.extend(knots.distinct().iter().map(|d| d.0));
    all
}

fn fraction(knots: &KnotVector, part: f64) -> f64 {
    let (start, end) = knots.domain();
    start + part * (end - start)
}

fn affine(p: DVec3) -> DVec3 {
    let turn = DMat3::from_cols(
        DVec3::new(1.0, 0.3, -0.2),
        DVec3::new(-0.5, 2.0, 0.1),
        DVec3::new(0.4, -0.6, 0.7),
    );
    turn * p + DVec3::new(10.0, -20.0, 30.0)
}

fn same_curve(a: &Curve, b: &Curve, tolerance: f64) -> Result<(), TestCaseError> {
    for u in parameters(a.knots()) {
        let (p, q) = (a.point(u), b.point(u));
        prop_assert!(p.distance(q) <= tolerance, "{} at {u}", p.distance(q));
    }
    Ok(())
}

fn same_surface(a: &Surface, b: &Surface, tolerance: f64) -> Result<(), TestCaseError> {
    for u in parameters(a.knots_u()) {
        for v in parameters(a.knots_v()) {
            let (p, q) = (a.point(u, v), b.point(u, v));
            prop_assert!(p.distance(q) <= tolerance, "{} at {u}, {v}", p.distance(q));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn basis_functions_are_not_negative_and_sum_to_one(knots in knots(1..=7)) {
        for u in parameters(&knots) {
            let basis = knots.basis(u);
            prop_assert!(basis.values().iter().all(|&n| n >= 0.0));
            prop_assert!((basis.values().iter().sum::<f64>() - 1.0).abs() < 1e-14);
            let span = knots.span(u);
            prop_assert_eq!(basis.first() + knots.degree(), span);
            prop_assert!(knots.as_slice()[span] <= u && u <= knots.as_slice()[span + 1]);
            // So every derivative of the sum is zero, and the zeroth derivatives are the functions.
            let derivatives = knots.basis_derivatives(u, 3);
            prop_assert_eq!(derivatives[0].len(), basis.values().len());
            for (a, b) in derivatives[0].iter().zip(basis.values()) {
                prop_assert!((a - b).abs() < 1e-15);
            }
            for row in &derivatives[1..] {
                let largest = row.iter().fold(1.0_f64, |most, n| most.max(n.abs()));
                prop_assert!(row.iter().sum::<f64>().abs() < 1e-13 * largest);
            }
        }
    }

    #[test]
    fn a_polynomial_with_greville_abscissae_as_control_points_is_the_identity(knots in knots(1..=6)) {
        let points = (0..knots.count()).map(|i| DVec3::X * knots.greville(i)).collect();
        let curve = Curve::new(knots, points).unwrap();
        for u in parameters(curve.knots()) {
            let derivatives = curve.derivatives(u, 2);
            prop_assert!((derivatives[0].x - u).abs() < 1e-14 * 10.0);
            prop_assert!((derivatives[1].x - 1.0).abs() < 1e-11);
            prop_assert!(derivatives[2].x.abs() < 1e-8);
        }
    }

    #[test]
    fn moving_the_control_points_of_a_curve_affinely_moves_the_curve(curve in curve()) {
        let points = curve.points().iter().map(|&p| affine(p)).collect();
        let moved = Curve::rational(curve.knots().clone(), points, curve.weights().to_vec()).unwrap();
        for u in parameters(curve.knots()) {
            prop_assert!(moved.point(u).distance(affine(curve.point(u))) < 1e-12 * SIZE);
        }
    }

    #[test]
    fn moving_the_control_points_of_a_surface_affinely_moves_the_surface(surface in surface()) {
        let net = surface.net().iter().map(|&p| affine(p)).collect();
        let (u, v) = (surface.knots_u().clone(), surface.knots_v().clone());
        let moved = Surface::rational(u, v, net, surface.weights().to_vec()).unwrap();
        for u in parameters(surface.knots_u()) {
            for v in parameters(surface.knots_v()) {
                prop_assert!(moved.point(u, v).distance(affine(surface.point(u, v))) < 1e-12 * SIZE);
            }
        }
    }

    #[test]
    fn insertion_elevation_splitting_and_reversal_keep_a_curve(curve in curve(), part in 0.05..0.95) {
        let u = fraction(curve.knots(), part);
        same_curve(&curve, &curve.insert_knot(u, 1).unwrap(), 1e-13 * SIZE)?;
        let w = fraction(curve.knots(), 0.5 * part);
        let refined = curve.refine(&[u, w]).unwrap();
        prop_assert_eq!(refined.knots().count(), curve.knots().count() + 2);
        same_curve(&curve, &refined, 1e-13 * SIZE)?;
        for times in 1..=3 {
            let elevated = curve.elevate(times).unwrap();
            prop_assert_eq!(elevated.degree(), curve.degree() + times);
            prop_assert_eq!(elevated.knots().distinct().len(), curve.knots().distinct().len());
            same_curve(&curve, &elevated, 1e-12 * SIZE)?;
        }
        let (left, right) = curve.split(u).unwrap();
        prop_assert_eq!(left.point(u), right.point(u));
        let (start, end) = curve.domain();
        let reversed = curve.reversed();
        let pieces = curve.bezier_segments();
        prop_assert_eq!(pieces.len() + 1, curve.knots().distinct().len());
        for x in parameters(curve.knots()) {
            let p = curve.point(x);
            let half = if x <= u { &left } else { &right };
            prop_assert!(half.point(x).distance(p) < 1e-12 * SIZE);
            prop_assert!(reversed.point(start + (end - x)).distance(p) < 1e-12 * SIZE);
            for piece in pieces.iter().filter(|c| c.domain().0 <= x && x <= c.domain().1) {
                prop_assert!(piece.point(x).distance(p) < 1e-12 * SIZE);
            }
        }
        let twice = reversed.reversed();
        prop_assert_eq!(twice.points(), curve.points());
        prop_assert_eq!(twice.weights(), curve.weights());
    }

    #[test]
    fn insertion_elevation_splitting_and_reversal_keep_a_surface(surface in surface(), part in 0.05..0.95) {
        let (u, v) = (fraction(surface.knots_u(), part), fraction(surface.knots_v(), 1.0 - part));
        let near = 1e-12 * SIZE;
        same_surface(&surface, &surface.insert_knot_u(u, 1).unwrap(), near)?;
        same_surface(&surface, &surface.insert_knot_v(v, 1).unwrap(), near)?;
        same_surface(&surface, &surface.refine_u(&[u]).unwrap().refine_v(&[v]).unwrap(), near)?;
        same_surface(&surface, &surface.elevate_u(1).unwrap().elevate_v(2).unwrap(), near)?;
        let (low, high) = surface.split_u(u).unwrap();
        let (left, right) = surface.split_v(v).unwrap();
        let turned = (surface.transposed(), surface.reversed_u(), surface.reversed_v());
        let (du, dv) = (surface.knots_u().domain(), surface.knots_v().domain());
        let patches: Vec<_> = surface.bezier_patches().collect();
        for x in parameters(surface.knots_u()) {
            for y in parameters(surface.knots_v()) {
                let p = surface.point(x, y);
                let (part_u, part_v) = (if x <= u { &low } else { &high }, if y <= v { &left } else { &right });
                prop_assert!(part_u.point(x, y).distance(p) < near);
                prop_assert!(part_v.point(x, y).distance(p) < near);
                prop_assert!(turned.0.point(y, x).distance(p) < near);
                prop_assert!(turned.1.point(du.0 + (du.1 - x), y).distance(p) < near);
                prop_assert!(turned.2.point(x, dv.0 + (dv.1 - y)).distance(p) < near);
                let mut held = 0;
                for patch in &patches {
                    let (a, b) = (patch.knots_u().domain(), patch.knots_v().domain());
                    if a.0 <= x && x <= a.1 && b.0 <= y && y <= b.1 {
                        prop_assert!(patch.point(x, y).distance(p) < near);
                        held += 1;
                    }
                }
                prop_assert!(held > 0);
            }
        }
    }

    #[test]
    fn a_control_point_or_weight_acts_on_its_interval_alone(
        curve in curve(), pick in any::<prop::sample::Index>(), to in point(),
    ) {
        let i = pick.index(curve.points().len());
        let knots = curve.knots().as_slice();
        let (from, until) = (knots[i], knots[i + curve.degree() + 1]);
        let last = curve.domain().1;
        let moved = curve.with_control_point(i, to).unwrap();
        let heavier = curve.with_weight(i, 2.0 * curve.weights()[i]).unwrap();
        for u in parameters(curve.knots()) {
            // [u_i, u_{i+p+1}); the last interval holds the end of the domain.
            if u < from || (u >= until && u < last) || (u == last && until < last) {
                prop_assert_eq!(moved.point(u), curve.point(u));
                // Other weights of the same span may be summed in another order of magnitude, but not differently.
                prop_assert!(heavier.point(u).distance(curve.point(u)) < 1e-13 * SIZE);
            }
        }
        let middle = 0.5 * (from + until);
        prop_assert!(to.distance(curve.points()[i]) < 1e-3 || moved.point(middle) != curve.point(middle));
    }

    #[test]
    fn a_control_point_of_a_surface_acts_on_its_rectangle_alone(
        surface in surface(), pick in any::<prop::sample::Index>(), to in point(),
    ) {
        let (u, v) = (surface.knots_u(), surface.knots_v());
        let k = pick.index(surface.net().len());
        let (i, j) = (k / v.count(), k % v.count());
        prop_assert_eq!(surface.control_point(i, j).unwrap(), surface.net()[k]);
        let moved = surface.with_control_point(i, j, to).unwrap();
        let heavier = surface.with_weight(i, j, 2.0 * surface.weights()[k]).unwrap();
        let outside = |knots: &KnotVector, i: usize, u: f64| {
            let (from, until) = (knots.as_slice()[i], knots.as_slice()[i + knots.degree() + 1]);
            let last = knots.domain().1;
            u < from || (u >= until && u < last) || (u == last && until < last)
        };
        for x in parameters(u) {
            for y in parameters(v) {
                if outside(u, i, x) || outside(v, j, y) {
                    prop_assert_eq!(moved.point(x, y), surface.point(x, y));
                    prop_assert!(heavier.point(x, y).distance(surface.point(x, y)) < 1e-13 * SIZE);
                }
            }
        }
    }

    #[test]
    fn derivatives_of_a_curve_are_the_limits_of_differences(curve in curve(), part in 0.0..1.0) {
        // Stay inside a piece: at its ends derivatives may jump.
        let distinct = curve.knots().distinct();
        let h = 1e-5;
        for pair in distinct.windows(2) {
            let u = pair[0].0 + (pair[1].0 - pair[0].0) * (0.05 + 0.9 * part);
            let (before, here, after) = (curve.derivatives(u - h, 3), curve.derivatives(u, 3), curve.derivatives(u + h, 3));
            prop_assert!(here[0].distance(curve.point(u)) < 1e-13 * SIZE);
            for k in 0..3 {
                let slope = (after[k] - before[k]) / (2.0 * h);
                let scale = here.iter().fold(SIZE, |most, d| most.max(d.length()));
                prop_assert!(slope.distance(here[k + 1]) < 1e-4 * scale, "order {}: {} {}", k + 1, slope, here[k + 1]);
            }
        }
    }

    #[test]
    fn derivatives_of_a_surface_are_those_of_its_isoparametric_curves(
        surface in surface(), a in 0.0..=1.0, b in 0.0..=1.0,
    ) {
        let (u, v) = (fraction(surface.knots_u(), a), fraction(surface.knots_v(), b));
        let all = surface.derivatives(u, v, 2);
        let along_v = surface.isocurve_u(u).derivatives(v, 2);
        let along_u = surface.isocurve_v(v).derivatives(u, 2);
        for k in 0..=2 {
            let scale = all[k][0].length().max(all[0][k].length()).max(SIZE);
            prop_assert!(all[k][0].distance(along_u[k]) < 1e-10 * scale);
            prop_assert!(all[0][k].distance(along_v[k]) < 1e-10 * scale);
        }
        prop_assert!(all[0][0].distance(surface.point(u, v)) < 1e-12 * SIZE);
        // The mixed one, as the slope in u of the slope in v.
        let h = 1e-6;
        let distinct = surface.knots_u().distinct();
        if distinct.iter().all(|d| (d.0 - u).abs() > 2.0 * h) {
            let slope = (surface.derivatives(u + h, v, 1)[0][1] - surface.derivatives(u - h, v, 1)[0][1]) / (2.0 * h);
            let scale = all.iter().flatten().fold(SIZE, |most, d| most.max(d.length()));
            prop_assert!(slope.distance(all[1][1]) < 1e-4 * scale);
        }
    }

    #[test]
    fn boxes_hold_their_shape_and_fit_it(curve in curve(), surface in surface()) {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let grow = |(low, high): (DVec3, DVec3), p: DVec3| (low.min(p), high.max(p));
        // So many parameters in every piece, its ends included.
        let fine = |knots: &KnotVector, n: u32| -> Vec<f64> {
            let along = |pair: &[(f64, usize)]| {
                let (start, end) = (pair[0].0, pair[1].0);
                (0..=n).map(move |k| (start + (end - start) * f64::from(k) / f64::from(n)).min(end))
            };
            knots.distinct().windows(2).flat_map(along).collect()
        };
        let (low, high) = curve.bounds();
        let seen = fine(curve.knots(), 500).iter().map(|&u| curve.point(u)).fold(empty, grow);
        prop_assert!(low.cmple(seen.0 + 1e-12 * SIZE).all() && high.cmpge(seen.1 - 1e-12 * SIZE).all());
        // The samples miss an extremum by (step)²/8 times the second derivative.
        prop_assert!((seen.0 - low).max(high - seen.1).max_element() < 1e-3 * SIZE, "{:?} {:?}", (low, high), seen);
        let (low, high) = surface.bounds();
        let across = fine(surface.knots_v(), 40);
        let seen = fine(surface.knots_u(), 40)
            .iter()
            .flat_map(|&u| across.iter().map(move |&v| (u, v)))
            .map(|(u, v)| surface.point(u, v))
            .fold(empty, grow);
        prop_assert!(low.cmple(seen.0 + 1e-12 * SIZE).all() && high.cmpge(seen.1 - 1e-12 * SIZE).all());
        prop_assert!((seen.0 - low).max(high - seen.1).max_element() < 3e-2 * SIZE, "{:?} {:?}", (low, high), seen);
    }

    #[test]
    fn no_sample_of_a_curve_is_nearer_than_its_closest_point(curve in curve(), p in point(), part in 0.0..=1.0) {
        let tolerance = 1e-9 * SIZE;
        let closest = curve.closest(p, tolerance);
        prop_assert_eq!(closest.point, curve.point(closest.parameter));
        prop_assert_eq!(closest.distance, closest.point.distance(p));
        for k in 0..=500 {
            let sample = curve.point(fraction(curve.knots(), f64::from(k) / 500.0));
            prop_assert!(closest.distance <= sample.distance(p) + tolerance);
        }
        let on = curve.point(fraction(curve.knots(), part));
        let u = curve.invert(on, tolerance);
        prop_assert!(u.is_some_and(|u| curve.point(u).distance(on) <= tolerance));
        prop_assert_eq!(curve.invert(DVec3::splat(3.0 * SIZE), tolerance), None);
    }

    #[test]
    fn no_sample_of_a_surface_is_nearer_than_its_closest_point(
        surface in surface(), p in point(), a in 0.0..=1.0, b in 0.0..=1.0,
    ) {
        let tolerance = 1e-9 * SIZE;
        let closest = surface.closest(p, tolerance);
        let (u, v) = closest.parameters;
        prop_assert_eq!(closest.point, surface.point(u, v));
        for x in parameters(surface.knots_u()) {
            for y in parameters(surface.knots_v()) {
                prop_assert!(closest.distance <= surface.point(x, y).distance(p) + tolerance);
            }
        }
        let on = surface.point(fraction(surface.knots_u(), a), fraction(surface.knots_v(), b));
        let found = surface.invert(on, tolerance);
        prop_assert!(found.is_some_and(|(u, v)| surface.point(u, v).distance(on) <= tolerance));
    }

    #[test]
    fn an_interpolated_curve_passes_through_random_points(
        points in prop::collection::vec(point(), 6..40), degree in 1_usize..=5, centripetal in any::<bool>(),
    ) {
        let spacing = if centripetal { Parametrization::Centripetal } else { Parametrization::ChordLength };
        let curve = interpolate::curve(&points, degree, spacing).unwrap();
        let params = interpolate::parameters(&points, spacing).unwrap();
        for (u, q) in params.iter().zip(&points) {
            prop_assert!(curve.point(*u).distance(*q) < 1e-9 * SIZE);
        }
    }

    #[test]
    fn a_ruled_surface_lies_on_the_chords_between_its_curves(a in curve(), b in curve(), part in 0.0..=1.0) {
        let ruled = Surface::ruled(&a, &b).unwrap();
        let (u, v) = (fraction(a.knots(), part), fraction(b.knots(), part));
        prop_assert!(ruled.point(0.0, u).distance(a.point(u)) < 1e-11 * SIZE);
        prop_assert!(ruled.point(1.0, u).distance(b.point(v)) < 1e-11 * SIZE);
        let (from, to) = (ruled.point(0.0, u), ruled.point(1.0, u));
        let (across, whole) = (ruled.point(0.4, u) - from, to - from);
        prop_assert!(across.cross(whole).length() < 1e-11 * SIZE * SIZE);
        prop_assert!(across.dot(whole) >= 0.0 && across.length() <= whole.length());
    }
}
