#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use super::*;

/// A net of 4 × 5 points over [0, 3] × [0, 4] whose heights are those of a hump.
fn net() -> NetDesign {
    let row = |i: i32| {
        (0..5)
            .map(|j| {
                let z = if (i, j) == (1, 2) { 9.0 } else { 0.0 };
                DVec3::new(f64::from(i), f64::from(j), z)
            })
            .collect()
    };
    NetDesign {
        points: (0..4).map(row).collect(),
        ..NetDesign::default()
    }
}

#[test]
fn a_net_is_the_surface_of_its_degrees() {
    let surface = net().build().unwrap();
    assert_eq!(
        (surface.knots_u().degree(), surface.knots_v().degree()),
        (3, 3)
    );
    let one = NetDesign {
        degree: [Some(1), Some(1)],
        ..net()
    };
    let surface = one.build().unwrap();
    // Of degree 1 it passes through its control points.
    assert_eq!(surface.point(1.0 / 3.0, 0.5), DVec3::new(1.0, 2.0, 9.0));
    // Bent at every knot somewhere, and divided there all over: parts have whole sides in common.
    assert_eq!(smooth_parts(&surface).unwrap().len(), 12);
    let level = NetDesign {
        points: vec![
            vec![DVec3::ZERO, DVec3::Y, 2.0 * DVec3::Y],
            vec![DVec3::X, DVec3::X + DVec3::Y, DVec3::X + 2.0 * DVec3::Y],
        ],
        degree: [Some(1), Some(1)],
        ..NetDesign::default()
    };
    let level = level.build().unwrap();
    assert_eq!(smooth_parts(&level).unwrap().len(), 1);
    let longer = level.extended_v([0.1, 0.2]).unwrap();
    assert_eq!(smooth_parts(&longer).unwrap().len(), 1);
    assert_eq!(smooth_parts(&net().build().unwrap()).unwrap().len(), 1);
}

#[test]
fn a_greater_weight_draws_the_surface_to_its_point() {
    let height = |weight: f64| {
        let mut weighted = net();
        weighted.weights = vec![vec![1.0; 5]; 4];
        weighted.weights[1][2] = weight;
        let surface = weighted.build().unwrap();
        (0..200)
            .map(|k| surface.point(0.35, 0.4 + 0.001 * f64::from(k)).z)
            .fold(0.0, f64::max)
    };
    let heights = [0.5, 1.0, 4.0, 100.0].map(height);
    assert!(heights.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(heights[3] > 8.5, "{heights:?}");
}

#[test]
fn what_is_no_net_is_refused_by_its_place() {
    let mut ragged = net();
    ragged.points[2].pop();
    assert!(matches!(
        ragged.build(),
        Err(NetError::Ragged {
            row: 3,
            found: 4,
            needed: 5,
            ..
        })
    ));
    let mut weighted = net();
    weighted.weights = vec![vec![1.0; 5]; 4];
    weighted.weights[3][1] = 0.0;
    assert!(matches!(
        weighted.build(),
        Err(NetError::Weight {
            row: 4,
            place: 2,
            ..
        })
    ));
    let few = NetDesign {
        degree: [Some(4), None],
        ..net()
    };
    assert!(matches!(
        few.build(),
        Err(NetError::Knots {
            is_across: true,
            ..
        })
    ));
    let short = NetDesign {
        knots: [None, Some(vec![0.0; 4])],
        ..net()
    };
    assert!(matches!(
        short.build(),
        Err(NetError::KnotCount {
            points: 5,
            degree: 3,
            found: 4,
            ..
        })
    ));
}

#[test]
fn a_fold_in_plan_is_found_and_a_leaning_net_has_none() {
    let mut leaning = net();
    for (i, row) in leaning.points.iter_mut().enumerate() {
        for point in row {
            point.y += 2.0 * i as f64 + 0.3 * point.x * point.x;
        }
    }
    assert_eq!(fold_in_plan(&leaning.build().unwrap()), None);
    leaning.weights = vec![vec![1.0; 5]; 4];
    leaning.weights[1][2] = 2.0;
    assert_eq!(fold_in_plan(&leaning.build().unwrap()), None);
    // A point drawn across its neighbours far enough.
    let mut folded = net();
    folded.points[1][2] = DVec3::new(9.0, 2.0, 9.0);
    let fold = fold_in_plan(&folded.build().unwrap()).unwrap();
    assert!(fold.x > 1.0 && (fold.y - 2.0).abs() < 1.0, "{fold}");
    // The other way round: all of it.
    let turned = net().build().unwrap().reversed_u();
    assert!(fold_in_plan(&turned).is_some());
}
